"""Colours of LDraw files to those of the catalogue: by code, else the closest one."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from ..arrays import Ints
from ..colours import ciede2000, lab_from_srgb
from ..errors import BuildError
from ..files import MAIN_COLOUR
from ..model import ASSETS, Catalogue
from .flatten import EDGE_COLOUR
from .lines import DIRECT, rgb_of

UNKNOWN: Final = 71
"""LDraw code of Light Bluish Gray, for parts without a colour, or of one that nobody has defined."""


@dataclass(frozen=True, slots=True)
class Replaced:
    """A colour that the catalogue does not have.

    Attributes
    ----------
    code : int
        As in the file.
    by : int
        Code of the colour that stands for it.
    known : bool
        Whether its value is known, so that this is the closest one.
    count : int
        Parts.
    """

    code: int
    by: int
    known: bool
    count: int


def brick_colours(
    codes: Ints, catalogue: Catalogue, defined: Mapping[int, tuple[int, int, int]]
) -> tuple[Ints, tuple[Replaced, ...]]:
    """Return colours of the catalogue.

    Parameters
    ----------
    codes : (n,) int64 array
        Of a file: codes, and direct colours.
    catalogue : Catalogue
    defined : mapping of int to (int, int, int)
        Codes that the file defines.

    Returns
    -------
    colours : (n,) int64 array
        Codes of the catalogue.
    replaced : tuple of Replaced
        Those that were not, by code.
    """
    kinds, row, count = np.unique(codes, return_inverse=True, return_counts=True)
    table = kinds.copy()
    replaced = []
    for place, (code, number) in enumerate(zip(kinds.tolist(), count.tolist(), strict=True)):
        if code in catalogue.codes and code not in (MAIN_COLOUR, EDGE_COLOUR):
            continue
        value = value_of(code, defined)
        table[place] = UNKNOWN if value is None else closest(value, catalogue)
        replaced.append(Replaced(code, int(table[place]), value is not None, number))
    return table[row.reshape(-1)], tuple(replaced)


def value_of(code: int, defined: Mapping[int, tuple[int, int, int]]) -> tuple[int, int, int] | None:
    """Return the sRGB bytes of a colour: direct, defined by the file, or of LDraw's own table; None if unknown."""
    if code in (MAIN_COLOUR, EDGE_COLOUR):
        return None
    if any(base <= code < base + 0x1000000 for base in DIRECT):
        return rgb_of(code)
    return defined.get(code) or other_colours().get(code)


def closest(rgb: tuple[int, int, int], catalogue: Catalogue) -> int:
    """Return the code of the colour of the catalogue that looks most like a value."""
    wanted, there = (lab_from_srgb(np.array(each, np.uint8)) for each in (rgb, catalogue.rgb))
    return int(catalogue.codes[ciede2000(there, wanted).argmin()])


@cache
def other_colours() -> dict[int, tuple[int, int, int]]:
    """Return the values of LDraw's colours that the catalogue does not have, read once.

    Raises
    ------
    BuildError
        The table is missing or damaged.
    """
    path = ASSETS / "other_colours.csv"
    try:
        rows = csv.DictReader(path.read_text(encoding="utf-8").splitlines())
        return {int(row["code"]): rgb_of(int(row["rgb"].removeprefix("#"), 16)) for row in rows}
    except (OSError, KeyError, ValueError) as error:
        raise BuildError(f"{path} cannot be read ({error}): install the add-on again.") from error
