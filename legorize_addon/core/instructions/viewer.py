"""The bricks of a booklet for its page in three dimensions, as small as they can be."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..building import Action, Steps
from ..model import NOBODY, Bricks, Catalogue, Part, column_facts, lines, outline, stud_columns, stud_middles, turned
from .lots import shown_rgb
from .panels import built_at_once

NEVER: Final = 0xFFFF
"""Step of what does not happen."""

_CORNER_BOXES: Final = (
    ((0, 0, 2, 1), (0, 1, 1, 1)),
    ((0, 0, 2, 1), (1, 1, 1, 1)),
    ((0, 1, 2, 1), (1, 0, 1, 1)),
    ((0, 1, 2, 1), (0, 0, 1, 1)),
)
"""The two boxes of a corner part by quarter turn: x, y, studs along x and y."""


def viewer_data(
    bricks: Bricks,
    catalogue: Catalogue,
    steps: Steps,
    *,
    temporary: Mask,
    tint: tuple[int, int, int],
    names: Mapping[int, str],
    pages: Mapping[int, int],
) -> str:
    """Return what the page in three dimensions has to know, as JSON.

    Parameters
    ----------
    bricks : Bricks
        Model and supports, n rows.
    catalogue : Catalogue
    steps : Steps
    temporary : (n,) bool array
        Bricks that are taken out again, which are tinted.
    tint : tuple of three int
    names : mapping of int to str
        Names of the submodels.
    pages : mapping of int to int
        The first step on the page of each step.

    Returns
    -------
    str
        Tables of numbers in base 64, little end first.
    """
    boxes, box_brick = _boxes(bricks, catalogue)
    ramps, ramp_brick = _ramps(bricks, catalogue)
    studs, stud_brick = _studs(bricks, catalogue)
    colour = shown_rgb(bricks, catalogue, temporary, tint)
    moves, count = steps.moves, len(steps.submodels)
    removed = np.full(len(bricks), NEVER)
    removals = moves.action == Action.REMOVE
    removed[moves.brick[removals]] = moves.step[removals]
    joined = np.full(count, NEVER)
    joins = moves.action == Action.JOIN
    joined[moves.submodel[joins]] = moves.step[joins]
    content: dict[str, Any] = {
        "boxes": _packed(boxes, "<f4"),
        "studs": _packed(studs, "<f4"),
        "ramps": _packed(ramps, "<f4"),
        "brick": _packed(np.concatenate([box_brick, stud_brick, ramp_brick]), "<u4"),
        "colour": _packed(colour, "u1"),
        "placed": _packed(_known(moves.step_of(len(bricks))), "<u2"),
        "removed": _packed(removed, "<u2"),
        "owner": _packed(_known(steps.submodel_of(len(bricks))), "<u2"),
        "parent": [max(each.parent, 0) for each in steps.submodels],
        "joined": joined.tolist(),
        "names": [built_at_once(steps, names, each.number) for each in steps.submodels],
        "table": [step.submodel for step in steps],
        "page": [pages[number] + 1 for number in range(len(steps))],
    }
    return json.dumps(content, separators=(",", ":"))


def _known(rows: NDArray[np.int32]) -> Ints:
    return np.where(rows == NOBODY, NEVER, rows).astype(np.int64)


def _packed(numbers: Ints | Floats, kind: str) -> str:
    return b64encode(np.ascontiguousarray(numbers).astype(kind).tobytes()).decode()


def _studs(bricks: Bricks, catalogue: Catalogue) -> tuple[Floats, Ints]:
    """Return where the studs begin, (n, 3) cells; and the brick of each."""
    brick, columns = stud_columns(bricks, catalogue)
    facts = column_facts(bricks, catalogue)
    # from the corner of a cell as large as a stud's square
    tops = np.column_stack([stud_middles(bricks, catalogue) - 0.5, columns[:, 2] + facts.high - facts.low])
    return tops[facts.stud], brick[facts.stud].astype(np.int64)


def _boxes(bricks: Bricks, catalogue: Catalogue) -> tuple[Floats, Ints]:
    """Return the boxes that bricks consist of, (n, 6): lowest corner and size in cells; and the brick of each."""
    boxes, owner = [], []
    rows = zip(bricks.part.tolist(), (bricks.turn % 4).tolist(), _corners(bricks).tolist(), strict=True)
    for row, (number, turn, (x, y, z)) in enumerate(rows):
        part = catalogue.parts[number]
        if part.shaped:
            continue
        across, deep = (part.width, part.length) if turn % 2 else (part.length, part.width)
        for u, v, wide, long in _CORNER_BOXES[turn] if part.corner else ((0, 0, across, deep),):
            boxes.append((x + u, y + v, z, wide, long, part.height))
            owner.append(row)
    return np.array(boxes, dtype=np.float64).reshape(-1, 6), np.array(owner, dtype=np.int64)


def _corners(bricks: Bricks) -> Floats:
    """Return the lowest corners of bricks in cells, (n, 3)."""
    corners: Floats = bricks.corner + bricks.shift
    return corners


def _ramps(bricks: Bricks, catalogue: Catalogue) -> tuple[Floats, Ints]:
    """Return the straight pieces of bricks that fall or have slanted sides, (n, 11), and the brick of each.

    Of each piece its lowest corner and size in cells, how high of its size the bottom is at the start and at the end
    of an axis, how high the top, and the axis: 0 for x, 1 for y. With slanted sides the same along x of the sides at
    low and at high y, and 2.
    """
    found, owner = [], []
    sloped = np.flatnonzero(np.array([part.shaped for part in catalogue.parts])[bricks.part])
    corners = _corners(bricks)
    for row in sloped.tolist():
        pieces = _pieces(catalogue.parts[bricks.part[row]], int(bricks.turn[row]) % 4)
        found += [(*(piece[:3] + corners[row]), *piece[3:]) for piece in pieces]
        owner += [row] * len(pieces)
    return np.array(found, dtype=np.float64).reshape(-1, 11), np.array(owner, dtype=np.int64)


@cache
def _pieces(part: Part, turn: int) -> tuple[Floats, ...]:
    """Return the straight pieces of a part that is no box, from its corner."""
    if part.wedge:
        return tuple(_strips(turned(part, turn, outline(part)), part.height))
    top, bottom = (np.array(line) for line in lines(part))
    places = np.unique(np.concatenate([top[:, 0], bottom[:, 0]]))
    found = []
    for start, end in pairwise(places.tolist()):
        # a little inside, where undersides have steps
        inner = np.array([start, end]) + np.array([1e-9, -1e-9])
        low, high = (np.interp(inner, *line.T) for line in (bottom, top))
        corners = turned(part, turn, np.array([(start, 0.0), (end, float(part.width))]))
        size = np.array([*np.ptp(corners, axis=0), high.max() - low.min()])
        level = (np.concatenate([low, high]) - low.min()) / size[2]
        if turn > 1:
            level = level[[1, 0, 3, 2]]
        found.append(np.array([*corners.min(axis=0), low.min(), *size, *level, turn % 2]))
    return tuple(found)


def _strips(corners: Floats, height: int) -> Iterator[Floats]:
    """Yield the pieces into which lines along y through its corners cut a convex outline."""
    sides = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    along = sides[:, 1, 0] - sides[:, 0, 0]
    for start, end in pairwise(np.unique(corners[:, 0]).tolist()):
        within = (sides[:, :, 0].min(axis=1) <= start) & (sides[:, :, 0].max(axis=1) >= end)
        # counter-clockwise, the side at low y runs along x and the other one back
        low = np.interp([start, end], *sides[within & (along > 0)][0].T)
        high = np.interp([start, end], *sides[within & (along < 0)][0, ::-1].T)
        size = np.array([end - start, high.max() - low.min(), height])
        level = (np.concatenate([low, high]) - low.min()) / size[1]
        yield np.array([start, low.min(), 0, *size, *level, 2])
