"""The paper's literal colour of a unit brick: greatest trajectory length around it.

References
----------
Paper, section "Colour of a unit brick": the squares that take part are the
brick's own and its eight neighbours that a trajectory passes, without the former
and the latter brick on the trajectory and without the inner square.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..colours import SurfaceColours
from ..model import Catalogue
from ..slicing import Pieces, Trajectories
from .colour_votes import Ballot, colour_differences, count_votes
from .surface_samples import SurfaceSamples, inner_cells

_STEPS = np.array([(0, y, x) for y in (-1, 0, 1) for x in (-1, 0, 1)])
"""The square itself (number 4) and its eight neighbours, along layer, y and x."""

_OWN = 4


class Crossings(NamedTuple):
    """Where trajectories cross the grid.

    Attributes
    ----------
    trajectories : Trajectories
    pieces : Pieces
        The trajectories' edges, cut at the grid.
    standing : (n,) int64 array
        Piece of each of the first samples.
    """

    trajectories: Trajectories
    pieces: Pieces
    standing: Ints


def longest_colours(
    crossings: Crossings,
    samples: SurfaceSamples,
    solid: Mask,
    seen: Mask,
    catalogue: Catalogue,
    surface: SurfaceColours | None = None,
) -> Ballot:
    """Let trajectories vote, by their length, for the colours of the visible cells that they pass.

    Cells that no trajectory passes, on level surface, take the colour with most
    surface in them.

    Parameters
    ----------
    crossings : Crossings
    samples : SurfaceSamples
        Those of pieces first, then other surface.
    solid, seen : (n_layers, n_y, n_x) bool arrays
        Cells of the model, and those to colour.
    catalogue : Catalogue
    surface : SurfaceColours, optional
        The texels that the bricks' colours stand for.

    Returns
    -------
    Ballot
    """
    trajectories, pieces, standing = crossings
    n = len(standing)
    brick = inner_cells(samples, solid)
    excluded = excluded_neighbours(trajectories, pieces.edge[standing], brick[:n], solid.shape)
    cell, entry = participants(samples.cell[:n], brick[:n], excluded, solid)
    length = pieces.length[standing]
    codes, votes = count_votes(
        np.concatenate([cell, brick[n:]]),
        np.concatenate([samples.colour[:n][entry], samples.colour[n:]]),
        # level surface decides only where no trajectory does
        np.concatenate([length[entry], samples.area[n:] * 1e-9]),
        seen,
    )
    return Ballot(codes, votes, votes, colour_differences(codes, catalogue, surface))


def excluded_neighbours(
    trajectories: Trajectories, edge: Ints, brick: Ints, shape: tuple[int, ...]
) -> NDArray[np.uint16]:
    """Return the neighbours that are the former or the latter brick on a trajectory.

    Parameters
    ----------
    trajectories : Trajectories
    edge : (n,) int64 array
        Edge of each piece, in the order of the trajectories.
    brick : (n,) int64 array
        Flat index of the brick of each piece, -1 for none.
    shape : tuple of int
        Cells along layer, y and x.

    Returns
    -------
    (n_layers * n_y * n_x,) uint16 array
        Bit i set: the neighbour at ``_STEPS[i]`` does not take part.
    """
    excluded = np.zeros(int(np.prod(shape)), dtype=np.uint16)
    placed = np.flatnonzero(brick >= 0)
    loop, cell = trajectories.edge_loop[edge[placed]], brick[placed]
    if len(cell) == 0:
        return excluded
    new = np.ones(len(cell), dtype=bool)
    new[1:] = (cell[1:] != cell[:-1]) | (loop[1:] != loop[:-1])
    loop, cell = loop[new], cell[new]
    first = np.flatnonzero(np.diff(loop, prepend=-1))
    last = np.append(first[1:], len(loop)) - 1
    latter = np.append(cell[1:], cell[0])
    latter[last] = cell[first]
    for here, there in ((cell, latter), (latter, cell)):
        step = np.array(np.unravel_index(there, shape)) - np.array(np.unravel_index(here, shape))
        near = (step[0] == 0) & (np.abs(step[1:]) <= 1).all(axis=0) & (here != there)
        bit = (1 << ((step[1] + 1) * 3 + step[2] + 1)[near]).astype(np.uint16)
        np.bitwise_or.at(excluded, here[near], bit)
    return excluded


def participants(square: Ints, brick: Ints, excluded: NDArray[np.uint16], solid: Mask) -> tuple[Ints, Ints]:
    """Return for which cells each piece of trajectory counts.

    Parameters
    ----------
    square : (n, 3) int64 array
        Square that each piece lies in: layer, y, x.
    brick : (n,) int64 array
        Flat index of the brick that each piece bounds, -1 for none.
    excluded : uint16 array
        Neighbours that do not take part, from ``excluded_neighbours``.
    solid : (n_layers, n_y, n_x) bool array

    Returns
    -------
    cell, entry : (m,) int64 arrays
        Flat index of a cell and the piece that counts for it.
    """
    passed = np.zeros(solid.size, dtype=bool)
    passed[brick[brick >= 0]] = True
    cells, entries = [], []
    for number, step in enumerate(_STEPS):
        # the piece lies at +step from the cell it may count for
        cell = square - step
        inside = np.flatnonzero(((cell >= 0) & (cell < solid.shape)).all(axis=1))
        flat = np.ravel_multi_index(tuple(cell[inside].T), solid.shape)
        counts = passed[flat] & (excluded[flat] >> number & 1 == 0)
        if number != _OWN:
            # a solid neighbour behind the brick is its inner square, unless it bounds the model itself
            own = np.ravel_multi_index(tuple(square[inside].T), solid.shape)
            counts &= ~solid.ravel()[own] | passed[own]
        cells.append(flat[counts])
        entries.append(inside[counts])
    return np.concatenate(cells), np.concatenate(entries)
