"""Small heaps of bricks for the tests of the building order, and their cells counted one by one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tests.core.standing import CATALOGUE, table

PARTS = ("3005", "3004", "3003", "3024", "3023", "3010")


def heap(seed, *, most=14, n_pieces=1, size=(7, 7, 9)):
    """Return bricks at random, turned and not, that do not overlap; each in one of some pieces."""
    rng = np.random.default_rng(seed)
    rows, taken = [], set()
    for _ in range(int(rng.integers(1, most + 1))):
        turn, number = int(rng.integers(2)), str(rng.choice(PARTS))
        part = CATALOGUE.parts[CATALOGUE.part_row(number)]
        wide, deep = (part.width, part.length) if turn else (part.length, part.width)
        place = [
            int(rng.integers(0, most + 1 - side)) for most, side in zip(size, (wide, deep, part.height), strict=True)
        ]
        cells = box_cells(*place, wide, deep, part.height)
        if not cells & taken:
            taken |= cells
            rows.append((number, *place, turn))
    bricks = table(*rows)
    return replace(bricks, piece=rng.integers(0, n_pieces, len(rows)).astype(np.int16))


def box_cells(x, y, z, wide, deep, high):
    """Return the cells of a box."""
    return {(x + i, y + j, z + k) for i in range(wide) for j in range(deep) for k in range(high)}


def cells_of(bricks):
    """Return the cells (x, y, z) of each brick, one set a brick; bricks are boxes."""
    found = []
    for part, turn, corner in zip(bricks.part.tolist(), bricks.turn.tolist(), bricks.corner.tolist(), strict=True):
        shape = CATALOGUE.parts[part]
        sides = (shape.width, shape.length) if turn % 2 else (shape.length, shape.width)
        found.append(box_cells(*corner, *sides, shape.height))
    return found


def shared_studs(lower, upper):
    """Return how many cells of one brick lie on top of another one's."""
    high = max(z for *_, z in lower)
    return (
        len({(x, y, z + 1) for x, y, z in lower if z == high} & upper) if high + 1 == min(z for *_, z in upper) else 0
    )


def reached(begun, links):
    """Return all that hangs together with what is given, over links in both directions."""
    found, more = set(), set(begun)
    while more:
        found |= more
        more = {b for pair in links for a, b in (pair, pair[::-1]) if a in found} - found
    return found
