"""Models set apart again: every brick gets its half studs, and what was true on one grid is looked at anew."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Ints
from ..model import Assembly, Bricks, Rows, collisions_between_grids, contact_graph
from .planes import Plane, halves_at


class HalfStudsError(Exception):
    """A model does not hold where it lies on jumpers.

    Attributes
    ----------
    levels : tuple of int
        Of the planes at which it does not.
    """

    def __init__(self, levels: tuple[int, ...]) -> None:
        super().__init__(levels)
        self.levels = levels


def set_apart(assembly: Assembly, planes: tuple[Plane, ...]) -> Assembly:
    """Give every brick the half studs of its level.

    Parameters
    ----------
    assembly : Assembly
        Drawn together; bricks, jumpers, and all supports.
    planes : tuple of Plane
        From below.

    Returns
    -------
    Assembly
        The same bricks.

    Raises
    ------
    HalfStudsError
        Bricks reach through a plane, or touch across one otherwise than by a jumper, or collide.
    """
    bricks = assembly.bricks
    half = halves_at(bricks.corner[:, 2].astype(np.int64), planes)
    apart = Assembly(replace(bricks, half=half.astype(np.uint8)), assembly.catalogue)
    wrong = {*_across(assembly, planes), *_untrue(assembly, apart.bricks, planes)}
    if wrong:
        raise HalfStudsError(tuple(sorted(wrong)))
    return apart


def _across(assembly: Assembly, planes: tuple[Plane, ...]) -> list[int]:
    """Return the levels of planes that bricks reach through."""
    low = assembly.bricks.corner[:, 2]
    high = low + assembly.height
    return [plane.level for plane in planes if ((low < plane.level) & (high > plane.level)).any()]


def _untrue(assembly: Assembly, apart: Bricks, planes: tuple[Plane, ...]) -> list[int]:
    """Return the levels of planes at which contacts are not what they seemed; of all if bricks collide."""
    links = contact_graph(apart, assembly.catalogue)
    levels = [plane.level for plane in planes]
    # supports of a piece may lie where other pieces will be
    if links.collisions > collisions_between_grids(assembly.bricks, assembly.catalogue):
        return levels
    n = len(assembly)
    before, after = (_keyed(each.pairs, each.studs, n) for each in (assembly.graph, links))
    # the level of a plane is that of the brick above it
    gone = np.setdiff1d(before, after) // 64 % n
    return np.intersect1d(apart.corner[gone, 2], levels).tolist() if len(gone) else []


def _keyed(pairs: Rows, studs: Rows, n: int) -> Ints:
    """Return contacts as numbers: lower and upper brick, and how many studs they share, up to 63."""
    keys: Ints = (pairs[:, 0].astype(np.int64) * n + pairs[:, 1]) * 64 + np.minimum(studs, 63)
    return keys
