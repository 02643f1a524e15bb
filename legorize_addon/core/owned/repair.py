"""The exact repair: sheets with too many bricks of a part are laid anew within what is owned.

Each sheet is a covering problem with one more row a part: not more of it than the
rest of the model leaves. What still goes beyond is paid for dearly, so that every
sheet laid anew lowers the overdraft of the whole model as far as it can alone.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import csc_array, eye_array, hstack, vstack

from ..arrays import Ints, Mask
from ..layout.problem import (
    GROUND,
    Candidates,
    Problem,
    Sheets,
    brick_table,
    gather,
    placements,
    pose,
    shapes,
)
from ..model import COLOUR_ANY, COLOUR_EMPTY, NOBODY, Assembly, Bricks, ground_of
from ..units import PLATES_PER_BRICK
from .assignment import visible_cells

_OVER: Final = 20.0
"""What a brick beyond the owned ones costs, in bricks."""

_NODES: Final = 500
"""Nodes of branch and bound for one sheet. A limit in seconds would give other bricks on another machine."""

_PASSES: Final = 3
"""Times that all sheets are tried."""


def repair_parts(assembly: Assembly, owned: Ints) -> Assembly:
    """Lay sheets anew until no part lies more often than it is owned, or nothing helps any more.

    Parameters
    ----------
    assembly : Assembly
        Without collisions.
    owned : (n_parts,) int64 array
        Bricks of each part, of all colours together.

    Returns
    -------
    Assembly
        Covers the same cells; the same object if nothing was changed. The overdraft is never greater than before.
    """
    for _ in range(_PASSES):
        before = _over(assembly.bricks, owned)
        if not before:
            break
        for level, height in _worst(assembly, owned):
            assembly = _better(assembly, _relaid(assembly, owned, level, height), owned)
        assembly = _better(assembly, _in_plates(assembly, owned), owned)
        if _over(assembly.bricks, owned) == before:
            break
    return assembly


def _over(bricks: Bricks, owned: Ints) -> int:
    """Return how many bricks go beyond the owned ones."""
    return int(np.maximum(np.bincount(bricks.part, minlength=len(owned)) - owned, 0).sum())


def _better(old: Assembly, new: Assembly | None, owned: Ints) -> Assembly:
    """Return the one that is less overdrawn, and does not fall apart more than before."""
    if new is None or _over(new.bricks, owned) >= _over(old.bricks, owned):
        return old
    return new if new.graph.n_components <= old.graph.n_components else old


def _worst(assembly: Assembly, owned: Ints) -> list[tuple[int, int]]:
    """Return level and height of the sheets with bricks of overdrawn parts, those with most of them first."""
    bricks, height = assembly.bricks, assembly.height
    over = np.bincount(bricks.part, minlength=len(owned)) > owned
    rows = np.flatnonzero(over[bricks.part])
    sheet, count = np.unique(np.column_stack([bricks.corner[rows, 2], height[rows]]), axis=0, return_counts=True)
    return [
        (int(level), int(high)) for level, high in sheet[np.argsort(-count, kind="stable")] if high <= PLATES_PER_BRICK
    ]


def _relaid(assembly: Assembly, owned: Ints, level: int, height: int) -> Assembly | None:
    """Lay the bricks of one sheet anew within what the rest of the model leaves; None if there is no way."""
    bricks, catalogue = assembly.bricks, assembly.catalogue
    over = np.bincount(bricks.part, minlength=len(owned)) > owned
    if not over[bricks.part].any():
        return None
    # slopes, tiles and jumpers were chosen for their place
    out = (bricks.corner[:, 2] == level) & (assembly.height == height) & catalogue.used_for("model")[bricks.part]
    if not out.any():
        return None
    problem = _problem(assembly, out, level, height)
    left = np.maximum(owned - np.bincount(bricks.part[~out], minlength=len(owned)), 0)
    part = problem.shapes.part[problem.placements.shape].astype(np.int64)
    chosen = _solved(problem, part, left)
    if chosen is None:
        return None
    laid = brick_table(problem, chosen)
    laid = replace(laid, corner=laid.corner + assembly.graph.low)
    return Assembly(gather([bricks.take(~out), laid]), catalogue)


def _problem(assembly: Assembly, out: Mask, level: int, height: int) -> Problem:
    """Return the problem of laying some bricks of one sheet anew."""
    bricks, catalogue, graph = assembly.bricks, assembly.catalogue, assembly.graph
    # planes count from the lowest cell of the graph, after an empty one
    owner = np.pad(graph.owner, ((1, 1), (0, 0), (0, 0)), constant_values=NOBODY)
    level -= int(graph.low[2])
    required = owner != NOBODY
    here = owner[level + 1]
    inside = (here != NOBODY) & out[here]
    colour = np.where(visible_cells(graph) > 0, bricks.colour, np.int16(COLOUR_ANY))
    sheets = Sheets(
        height=height,
        level=np.array([level], dtype=np.int32),
        colour=np.where(inside, colour[here], np.int16(COLOUR_EMPTY))[None],
        required=inside[None],
        role=np.where(inside, bricks.role[here], np.uint8(0))[None],
    )
    codes = np.unique(bricks.colour[out])
    among = shapes(catalogue, height, codes, int(codes[0]))
    owner[: ground_of(required)] = GROUND
    return pose(sheets, among, placements(sheets, among), owner, required)


def _solved(problem: Problem, part: Ints, left: Ints) -> Ints | None:
    """Return the cheapest placements that cover a sheet and go beyond what is left as little as can be."""
    found = problem.placements
    candidates = Candidates.of(found)
    kinds = np.unique(part)
    n, start = len(found), np.append(0, np.cumsum(candidates.size))
    covers = csc_array((np.ones(len(found.cells)), found.cells, start), shape=(len(problem.required), n))
    counts = csc_array((np.ones(n), (np.searchsorted(kinds, part), np.arange(n))), shape=(len(kinds), n))
    # a column a part for what goes beyond
    matrix = vstack(
        [hstack([covers, csc_array((len(problem.required), len(kinds)))]), hstack([counts, -eye_array(len(kinds))])]
    )
    low = np.append(np.ones(len(problem.required)), np.full(len(kinds), -np.inf))
    high = np.append(np.ones(len(problem.required)), left[kinds].astype(float))
    solved = milp(
        np.append(np.maximum(problem.cost, 0.01), np.full(len(kinds), _OVER)),
        constraints=LinearConstraint(matrix.tocsc(), low, high),
        bounds=Bounds(0, np.append(np.ones(n), np.full(len(kinds), np.inf))),
        integrality=np.append(np.ones(n), np.zeros(len(kinds))),
        options={"node_limit": _NODES, "mip_rel_gap": 0.01},
    )
    return None if solved.x is None else np.flatnonzero(solved.x[:n] > 0.5)


def _in_plates(assembly: Assembly, owned: Ints) -> Assembly | None:
    """Put three plates in place of bricks that go beyond the owned ones, as far as plates are left."""
    bricks, catalogue = assembly.bricks, assembly.catalogue
    plate = {
        (each.length, each.width, each.corner): row
        for row, each in enumerate(catalogue.parts)
        if each.height == 1 and each.use == "model"
    }
    used = np.bincount(bricks.part, minlength=len(owned))
    free, rows, flat = np.maximum(owned - used, 0), [], []
    for part in np.flatnonzero(used > owned).tolist():
        form = catalogue.parts[part]
        other = plate.get((form.length, form.width, form.corner))
        if form.height != PLATES_PER_BRICK or other is None:
            continue
        many = min(int(used[part] - owned[part]), int(free[other]) // PLATES_PER_BRICK)
        rows += np.flatnonzero(bricks.part == part)[:many].tolist()
        flat += [other] * many
        free[other] -= PLATES_PER_BRICK * many
    if not rows:
        return None
    cut = bricks.take(np.array(rows))
    layers = [_moved(cut, np.array(flat), up) for up in range(PLATES_PER_BRICK)]
    return Assembly(gather([bricks.take(np.delete(np.arange(len(bricks)), rows)), *layers]), catalogue)


def _moved(bricks: Bricks, part: Ints, up: int) -> Bricks:
    """Return bricks as other parts, some plates higher."""
    return replace(bricks, part=part.astype(bricks.part.dtype), corner=bricks.corner + np.array([0, 0, up], np.int32))
