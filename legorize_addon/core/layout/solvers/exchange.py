"""Better bricks by exchange: lay one placement, let the bricks in its way give up cells.

A move lays a placement and takes away every brick that it cuts. Where such a
brick leaves required cells behind, one brick covers them again, or, if that is
allowed, several; the move counts if the bricks laid cost less than those taken
away. Moves that do not touch the same bricks or cells are made together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ...arrays import Floats, Mask
from ..problem import Index, Problem, pattern_bits
from .greedy import cover

_PASSES: Final = 4
"""Rounds of moves against the smallest bricks; later ones find next to nothing."""

_NOTHING: Final = -1
_SEVERAL: Final = -2
"""Instead of the row of a placement: none is needed, more than one is."""

_LEAST_GAIN: Final = 1e-6
"""Bricks that a move has to save; keeps rounding errors from going in circles."""


def fewer_small(problem: Problem, chosen: Index, rng: np.random.Generator) -> Index:
    """Get rid of bricks of one cell where moves can.

    Parameters
    ----------
    problem : Problem
        The sheet.
    chosen : (n_bricks,) intp array
        Rows of the placements that lie there.
    rng : numpy.random.Generator
        Decides between moves of the same gain.

    Returns
    -------
    intp array
        Rows of the placements that lie there now; they cover the same required cells.
    """
    size = problem.placements.size
    for _ in range(_PASSES):
        single = np.zeros(len(problem.required), dtype=bool)
        single[problem.placements.cells[problem.placements.start[chosen[size[chosen] == 1]]]] = True
        offered = problem.placements.through(single)
        offered = offered[size[offered] > 1]
        better = exchange(problem, chosen, offered, rng) if len(offered) else chosen
        if better is chosen:
            break
        chosen = better
    return chosen


def exchange(
    problem: Problem,
    chosen: Index,
    offered: Index,
    rng: np.random.Generator,
    *,
    reward: Floats | None = None,
    patch: float = np.inf,
) -> Index:
    """Make the moves that pay, one round.

    Parameters
    ----------
    problem : Problem
        The sheet.
    chosen : (n_bricks,) intp array
        Rows of the placements that lie there, without overlaps.
    offered : (n_moves,) intp array
        Rows of the placements to try.
    rng : numpy.random.Generator
        Decides between moves of the same gain.
    reward : (n_moves,) float64 array, optional
        Bricks that a move is worth besides what it saves.
    patch : float
        What to reckon, in bricks, where the rest of a cut brick needs several;
        infinite to make no such moves.

    Returns
    -------
    intp array
        Rows of the placements that lie there now; `chosen` itself if no move pays.
    """
    moves = _Moves.of(problem, chosen, offered)
    rests = _Rests.of(problem, chosen, moves, patch)
    gain = _saved(problem, chosen, offered, moves, rests) + (0 if reward is None else reward)
    gain[gain <= _LEAST_GAIN] = 0
    if not gain.any():
        return chosen
    made = _independent(moves, gain, len(chosen), rng)
    cut = made[moves.of_cut]
    # moves that are made cut different bricks, so all of their rests can be laid
    staying = np.ones(len(chosen), dtype=bool)
    staying[moves.brick[cut]] = False
    laid = rests.row[cut]
    patched = _patched(problem, rests.cell[(cut & (rests.row == _SEVERAL))[rests.of_cell]], rng)
    return np.concatenate([chosen[staying], offered[made], laid[laid >= 0], patched])


def gains(problem: Problem, chosen: Index, offered: Index) -> Floats:
    """Compute what each move would save by itself.

    Parameters
    ----------
    problem : Problem
        The sheet.
    chosen : (n_bricks,) intp array
        Rows of the placements that lie there, without overlaps.
    offered : (n_moves,) intp array
        Rows of the placements to try.

    Returns
    -------
    (n_moves,) float64 array
        Bricks; minus infinity where the rest of a cut brick needs several.
    """
    moves = _Moves.of(problem, chosen, offered)
    return _saved(problem, chosen, offered, moves, _Rests.of(problem, chosen, moves, np.inf))


def _saved(problem: Problem, chosen: Index, offered: Index, moves: _Moves, rests: _Rests) -> Floats:
    """Return the cost of the bricks that each move takes away, less that of those it lays, (n_moves,)."""
    less = problem.cost[chosen[moves.brick]] - rests.cost
    return np.bincount(moves.of_cut, weights=less, minlength=len(offered)) - problem.cost[offered]


def _patched(problem: Problem, cells: Index, rng: np.random.Generator) -> Index:
    """Cover the required cells among those given, with bricks that lie on no others."""
    inside = np.zeros(len(problem.required), dtype=bool)
    inside[cells] = True
    found = problem.placements
    rows = np.flatnonzero(found.totals(inside) == found.size)
    return rows[cover(replace(problem, placements=found.take(rows), cost=problem.cost[rows]), rng)]


@dataclass(frozen=True, slots=True, eq=False)
class _Moves:
    """Which bricks and which free cells each move takes.

    Attributes
    ----------
    cell, of_cell : (n_entries,) intp arrays
        Cells of the new placements, and the move each belongs to.
    free : (n_entries,) bool array
        Whether no brick lies on the cell.
    brick, of_cut : (n_cuts,) intp arrays
        Bricks (positions in `chosen`) that the new placements cut, and the move
        each belongs to; sorted, each pair once.
    """

    cell: Index
    of_cell: Index
    free: Mask
    brick: Index
    of_cut: Index

    @classmethod
    def of(cls, problem: Problem, chosen: Index, offered: Index) -> _Moves:
        """Look up what lies where the offered placements would."""
        cell = problem.placements.cells[problem.placements.entries(offered)]
        of_cell = np.repeat(np.arange(len(offered)), problem.placements.size[offered])
        brick = problem.owner(chosen)[cell]
        free = brick < 0
        cuts = np.unique((of_cell * len(chosen) + brick)[~free])
        of_cut, cut_brick = np.divmod(cuts, max(len(chosen), 1))
        return cls(cell, of_cell, free, cut_brick, of_cut)


@dataclass(frozen=True, slots=True, eq=False)
class _Rests:
    """What is left of each brick that a move cuts.

    Attributes
    ----------
    row : (n_cuts,) intp array
        The placement that covers it, ``_NOTHING`` where no required cell is left
        over, ``_SEVERAL`` where no single placement does.
    cost : (n_cuts,) float64 array
        Its cost, in bricks.
    cell, of_cell : (n_entries,) intp arrays
        Cells left over, and the cut that each belongs to.
    """

    row: Index
    cost: Floats
    cell: Index
    of_cell: Index

    @classmethod
    def of(cls, problem: Problem, chosen: Index, moves: _Moves, patch: float) -> _Rests:
        """Find for each cut the placement that covers what is left of the brick."""
        cut_rows = chosen[moves.brick]
        cell = problem.placements.cells[problem.placements.entries(cut_rows)]
        of_cell = np.repeat(np.arange(len(cut_rows)), problem.placements.size[cut_rows])
        n_cells = len(problem.required)
        # a cell of a cut brick is left if the move that cuts it does not take it
        taken = np.sort(moves.of_cell * n_cells + moves.cell)
        wanted = moves.of_cut[of_cell] * n_cells + cell
        left = taken[np.minimum(np.searchsorted(taken, wanted), len(taken) - 1)] != wanted
        cell, of_cell = cell[left], of_cell[left]
        needed = problem.required[cell]
        # first all that is left, then only what must be covered: optional cells can be dropped
        rows = np.stack(
            [
                _fitting(problem, cell, of_cell, len(cut_rows)),
                _fitting(problem, cell[needed], of_cell[needed], len(cut_rows)),
            ]
        )
        costs = np.where(rows >= 0, problem.cost[rows], patch)
        best = costs.argmin(axis=0)
        row, cost = (np.take_along_axis(each, best[None], axis=0)[0] for each in (rows, costs))
        done = np.bincount(of_cell[needed], minlength=len(cut_rows)) == 0
        row[row < 0] = _SEVERAL
        row[done], cost[done] = _NOTHING, 0
        return cls(row, cost, cell, of_cell)


def _fitting(problem: Problem, cell: Index, group: Index, n_groups: int) -> Index:
    """Return for each group of cells the placement that covers exactly these, -1 where there is none."""
    at = problem.corner[cell]
    corner = np.full((n_groups, 3), np.iinfo(np.int16).max, dtype=np.intp)
    for axis in range(3):
        np.minimum.at(corner[:, axis], group, at[:, axis])
    x, y, _ = (at - corner[group]).T
    bits = pattern_bits(x, y, problem.shapes.side)
    pattern = np.zeros(n_groups, dtype=bits.dtype)
    np.add.at(pattern, group, bits)
    known = problem.shapes.pattern
    order = np.argsort(known)
    shape = order[np.minimum(np.searchsorted(known, pattern, sorter=order), len(known) - 1)]
    return np.where(known[shape] == pattern, problem.placements.find(shape, corner), -1)


def _independent(moves: _Moves, gain: Floats, n_bricks: int, rng: np.random.Generator) -> Mask:
    """Choose the moves with a gain that gain most among all that take the same brick or free cell."""
    move = np.concatenate([moves.of_cut, moves.of_cell[moves.free]])
    taken = np.concatenate([moves.brick, n_bricks + moves.cell[moves.free]])
    rank = np.empty(len(gain), dtype=np.intp)
    rank[np.lexsort((rng.permutation(len(gain)), gain))] = np.arange(len(gain))
    rank[gain <= 0] = -1
    highest = np.full(taken.max(initial=0) + 1, -1)
    np.maximum.at(highest, taken, rank[move])
    lost = np.bincount(move[highest[taken] != rank[move]], minlength=len(gain))
    winning: Mask = (rank >= 0) & (lost == 0)
    return winning
