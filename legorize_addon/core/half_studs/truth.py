"""Models set apart again: every brick gets its half studs, and what was true on one grid is looked at anew."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..model import (
    Assembly,
    Bricks,
    Role,
    Rows,
    collisions_between_grids,
    column_facts,
    components,
    contact_graph,
    stud_columns,
)
from ..units import PLATES_PER_BRICK
from .halves import Halves
from .regions import Region

_ALONG_Y: Final = (..., slice(None, -1), slice(None)), (..., slice(1, None), slice(None))


class HalfStudsError(Exception):
    """A model does not hold where it lies on jumpers.

    Attributes
    ----------
    regions : tuple of Region
        Those with which it does not.
    """

    def __init__(self, regions: tuple[Region, ...]) -> None:
        super().__init__(regions)
        self.regions = regions


def set_apart(assembly: Assembly, halves: Halves) -> Assembly:
    """Give every brick the half studs of its cells, and supports those of what they carry.

    Parameters
    ----------
    assembly : Assembly
        Drawn together; bricks, jumpers, and all supports.
    halves : Halves

    Returns
    -------
    Assembly
        The same bricks.

    Raises
    ------
    HalfStudsError
        Bricks lie in cells of several half studs, or touch across otherwise than by a jumper, or collide.
    """
    bricks = assembly.bricks
    half, several = _of_bricks(assembly, halves)
    several &= bricks.role != Role.SUPPORT_OUTSIDE
    half, torn = _of_supports(assembly, half)
    apart = Assembly(replace(bricks, half=half.astype(np.uint8)), assembly.catalogue)
    lost, collide = _untrue(assembly, apart.bricks)
    wrong = np.unique(np.concatenate([np.flatnonzero(several), torn, lost]))
    if len(wrong) or collide:
        raise HalfStudsError(halves.near(bricks.corner[wrong, 2].astype(np.int64) // PLATES_PER_BRICK))
    return apart


def check_apart(solid: Mask, halves: Halves) -> None:
    """Make sure that no brick could cover cells of several half studs.

    Parameters
    ----------
    solid : (n_layers, 3, n_y, n_x) bool array
        The cells of a model that is drawn together.
    halves : Halves

    Raises
    ------
    HalfStudsError
        Cells of different half studs lie beside each other.
    """
    layers = []
    for one, other in (((..., slice(None, -1)), (..., slice(1, None))), _ALONG_Y):
        touches = (solid[one] & solid[other]).any(axis=1)
        differs = halves.half[: len(solid)][one] != halves.half[: len(solid)][other]
        layers.append(np.flatnonzero((touches & differs).any(axis=(1, 2))))
    wrong = np.unique(np.concatenate(layers))
    if len(wrong):
        raise HalfStudsError(halves.near(wrong))


def lies_in_several(assembly: Assembly, halves: Halves) -> Mask:
    """Tell which bricks lie in cells of several half studs, (n,)."""
    return _of_bricks(assembly, halves)[1]


def _of_bricks(assembly: Assembly, halves: Halves) -> tuple[Ints, Mask]:
    """Return the half studs of the first cell of each brick, (n, 2), and which bricks have cells with others."""
    brick, squares = stud_columns(assembly.bricks, assembly.catalogue)
    facts = column_facts(assembly.bricks, assembly.catalogue)
    cells = squares.astype(np.int64)
    ends = []
    for level in (squares[:, 2], squares[:, 2] + facts.high - facts.low - 1):
        cells[:, 2] = level // PLATES_PER_BRICK
        ends.append(halves.at(cells))
    own = np.zeros((len(assembly), 2), np.int64)
    own[brick[::-1]] = ends[0][::-1]
    wrong = (ends[0] != own[brick]).any(axis=1) | (ends[1] != own[brick]).any(axis=1)
    several = np.zeros(len(assembly), bool)
    several[brick[wrong]] = True
    return own, several


def _of_supports(assembly: Assembly, half: Ints) -> tuple[Ints, Ints]:
    """Return the half studs of all bricks, those of supports as what they carry, and rows that one cannot carry."""
    support = assembly.bricks.role == Role.SUPPORT_OUTSIDE
    lower, upper = assembly.graph.pairs.T
    # supports stand on the ground, with nothing of the model below them
    group = components(assembly.graph.pairs[support[lower] & support[upper]], len(assembly))
    carries = support[lower] & ~support[upper]
    of, carried = group[lower[carries]], upper[carries]
    found = np.full((len(assembly), 2), -1)
    found[of[::-1]] = half[carried[::-1]]
    torn = carried[(half[carried] != found[of]).any(axis=1)]
    mine = support & (found[group] >= 0).all(axis=1)
    return np.where(mine[:, None], found[group], half), torn.astype(np.int64)


def _untrue(assembly: Assembly, apart: Bricks) -> tuple[Ints, bool]:
    """Return the upper bricks of contacts that are not what they seemed, and whether bricks collide that did not."""
    links = contact_graph(apart, assembly.catalogue)
    # supports of a piece may lie where other pieces will be
    collide = links.collisions > collisions_between_grids(assembly.bricks, assembly.catalogue)
    n = len(assembly)
    before, after = (_keyed(each.pairs, each.studs, n) for each in (assembly.graph, links))
    return np.setdiff1d(before, after) // 64 % n, collide


def _keyed(pairs: Rows, studs: Rows, n: int) -> Ints:
    """Return contacts as numbers: lower and upper brick, and how many studs they share, up to 63."""
    keys: Ints = (pairs[:, 0].astype(np.int64) * n + pairs[:, 1]) * 64 + np.minimum(studs, 63)
    return keys
