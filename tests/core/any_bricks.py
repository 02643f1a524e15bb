"""Bricks of all kinds for the tests of LDraw files."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.catalogue import load_catalogue

CATALOGUE = load_catalogue()
LONGEST = max(part.length for part in CATALOGUE.parts)
SMALL = [row for row, part in enumerate(CATALOGUE.parts) if part.length <= 8]
"""Rows of the parts that models and mosaics are made of; a baseplate among them would make most tests slow."""

ORIENTATIONS = [(row, turn) for row, part in enumerate(CATALOGUE.parts) for turn in range(part.turns)]


def table(rows):
    """Return bricks from rows of part, x, y, z, turn, colour, role, piece, step."""
    part, x, y, z, turn, colour, role, piece, step = np.array(rows, np.int64).reshape(-1, 9).T
    return Bricks(
        part=part.astype(np.int16),
        corner=np.stack([x, y, z], axis=1).astype(np.int32),
        turn=turn.astype(np.uint8),
        colour=colour.astype(np.int16),
        role=role.astype(np.uint8),
        piece=piece.astype(np.int16),
        step=step.astype(np.int32),
    )


def _room(row):
    return 5 * row + LONGEST * sum(large not in SMALL for large in range(row + 1))


def everything():
    """Return every part in each of its orientations, a part per row of the plan and a step each."""
    codes = CATALOGUE.codes
    return table(
        [
            (row, 10 * turn, _room(row), row % 4, turn, codes[number % len(codes)], 0, 0, row)
            for number, (row, turn) in enumerate(ORIENTATIONS)
        ]
    )


def multiset(bricks, *, steps=True):
    """Return the bricks as sorted rows, turns reduced by the parts' symmetry; those of jumpers by how they look."""
    looks = [1 + (part.length != part.width) if part.jumper else part.turns for part in CATALOGUE.parts]
    turns = np.array(looks)[bricks.part]
    columns = [bricks.part, bricks.corner, bricks.turn % turns, bricks.colour, bricks.role, bricks.piece]
    rows = np.column_stack([*columns, bricks.step] if steps else columns)
    return sorted(map(tuple, rows.tolist()))


@st.composite
def any_bricks(draw):
    """Draw bricks of all kinds, overlapping or not, with steps 0, 1, 2, ... without gaps."""
    columns = [
        st.sampled_from(SMALL),
        *(st.integers(-99, 99) for _ in range(3)),
        st.integers(0, 3),
        st.sampled_from(CATALOGUE.codes.tolist()),
        st.sampled_from([int(role) for role in Role]),
        st.integers(0, 3),
        st.integers(0, 4),
    ]
    bricks = draw(st.lists(st.tuples(*columns), max_size=25))
    steps = sorted({brick[-1] for brick in bricks})
    return table([(*brick[:-1], steps.index(brick[-1])) for brick in bricks])
