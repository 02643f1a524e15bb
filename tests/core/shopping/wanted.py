"""Bricks to buy, made by code, for the tests of lists."""

from __future__ import annotations

import csv
import io

import numpy as np
from hypothesis import strategies as st

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import load_catalogue

CATALOGUE = load_catalogue()

bought = st.lists(
    st.tuples(st.integers(0, len(CATALOGUE.parts) - 1), st.sampled_from(CATALOGUE.codes.tolist())), max_size=60
)
"""Pairs of part row and LDraw code."""


def assembly_of(pairs, catalogue=CATALOGUE):
    """Return bricks of the given (part row, LDraw code), all in one place."""
    part, colour = np.array(pairs, np.int16).reshape(-1, 2).T
    n = len(part)
    zero = np.zeros(n, np.uint8)
    bricks = Bricks(part, np.zeros((n, 3), np.int32), zero, colour, zero, zero.astype(np.int16), zero.astype(np.int32))
    return Assembly(bricks, catalogue)


def read_csv(text):
    """Return the rows of a CSV text as dictionaries."""
    return list(csv.DictReader(io.StringIO(text, newline="")))
