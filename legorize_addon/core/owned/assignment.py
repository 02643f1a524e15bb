"""Which owned lot each brick is taken from: a transport problem for each part.

Bricks of one part that shall have one colour are a source, the owned lots of the
part are sinks. Taking a brick in another colour costs what the colours differ, on
the cells that are seen. Sources that the lots cannot serve are missing.

References
----------
F. L. Hitchcock, "The distribution of a product from several sources to numerous localities", J. Math. Phys. 20, 1941.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import ndimage
from scipy.optimize import linprog
from scipy.sparse import csr_array

from ..arrays import Floats, Ints, Mask
from ..colours import ciede2000, lab_from_srgb
from ..geometry import outer_air
from ..model import NOBODY, Assembly, Bricks, Catalogue, ContactGraph, ground_of

_MISSING: Final = 1e6
"""Cost of a brick that no lot can serve: above all differences of colour together."""


@dataclass(frozen=True, slots=True, eq=False)
class Assigned:
    """Bricks and the lots that they are taken from.

    Attributes
    ----------
    colour : (n,) int16 array
        LDraw code of each brick.
    missing : (n,) bool array
        Bricks that no owned lot can serve; they keep their colour.
    scarcity : (n_parts, n_colours) float64 array
        What one more brick of a lot would be worth, in differences of colour times cells.
    """

    colour: Ints
    missing: Mask
    scarcity: Floats


def differences(catalogue: Catalogue) -> Floats:
    """Return how different the colours of the catalogue look, CIEDE2000, (n_colours, n_colours)."""
    lab = lab_from_srgb(catalogue.rgb)
    return np.asarray(ciede2000(lab[:, None], lab[None]))


def visible_cells(graph: ContactGraph) -> Ints:
    """Count the cells of each brick that the outer air touches, a plate high, (n,)."""
    # cells on the ground cannot be seen from below
    owner = graph.owner[ground_of(graph.owner != NOBODY) :]
    owner = np.pad(owner, ((0, 1), (1, 1), (1, 1)), constant_values=NOBODY)
    there = owner != NOBODY
    seen = ndimage.binary_dilation(outer_air(there), border_value=0) & there
    return np.bincount(owner[seen], minlength=len(graph.component))


def assign(assembly: Assembly, visible: Ints, count: Ints, *, keep: bool) -> Assigned:
    """Take bricks from owned lots.

    Parameters
    ----------
    assembly : Assembly
        Bricks in the colours that they shall have.
    visible : (n,) int array
        Cells of each brick that are seen; a brick without any may have any colour.
    count : (n_parts, n_colours) int64 array
        Owned bricks.
    keep : bool
        Whether bricks that are seen keep their colour; else they may get one that is close.

    Returns
    -------
    Assigned
        No lot is taken from more often than it has bricks.
    """
    bricks, catalogue = assembly.bricks, assembly.catalogue
    colour, missing = bricks.colour.astype(np.int64), np.zeros(len(bricks), dtype=bool)
    scarcity, apart = np.zeros(count.shape), differences(catalogue)
    if keep:
        apart = np.where(np.eye(len(apart), dtype=bool), 0.0, np.inf)
    for part in np.unique(bricks.part).tolist():
        rows = np.flatnonzero(bricks.part == part)
        column, left, worth = _of_part(bricks.take(rows), visible[rows], count[part], apart, catalogue)
        colour[rows[~left]] = catalogue.codes[column[~left]]
        missing[rows[left]] = True
        scarcity[part] = worth
    return Assigned(colour, missing, scarcity)


def _of_part(
    bricks: Bricks, visible: Ints, count: Ints, apart: Floats, catalogue: Catalogue
) -> tuple[Ints, Mask, Floats]:
    """Return the colour rows of bricks of one part, which are missing, and what one more of each lot is worth."""
    wanted = np.where(visible > 0, catalogue.colour_rows(bricks.colour), -1)
    # the least visible bricks of a source are the first to change their colour
    order = np.lexsort((np.arange(len(bricks)), -visible, wanted))
    source, first, size = np.unique(wanted[order], return_index=True, return_counts=True)
    mean = np.array([visible[order][at : at + n].mean() for at, n in zip(first, size, strict=True)])
    lots = np.flatnonzero(count)
    with np.errstate(invalid="ignore"):
        cost = np.where(source[:, None] < 0, 0.0, apart[source][:, lots] * np.maximum(mean, 1)[:, None])
    taken, worth = _transport(cost, size, count[lots])
    column, left = np.full(len(bricks), -1, dtype=np.int64), np.zeros(len(bricks), dtype=bool)
    for row, (at, n) in enumerate(zip(first.tolist(), size.tolist(), strict=True)):
        by_cost = np.argsort(cost[row], kind="stable")
        given = np.repeat(np.append(lots[by_cost], -1), np.append(taken[row, by_cost], n - taken[row].sum()))
        column[order[at : at + n]], left[order[at : at + n]] = given, given < 0
    scarce = np.zeros(len(count))
    scarce[lots] = worth
    return column, left, scarce


def _transport(cost: Floats, size: Ints, count: Ints) -> tuple[Ints, Floats]:
    """Return how many bricks of each source come from each lot, and what one more of each lot is worth."""
    possible = np.isfinite(cost)
    source, lot = possible.nonzero()
    if not len(source):
        return np.zeros(cost.shape, dtype=np.int64), np.zeros(len(count))
    n, one = len(source), np.ones(len(source))
    supply = csr_array((one, (lot, np.arange(n))), shape=(len(count), n + len(size)))
    # the last columns are bricks that are missing
    row = np.append(source, np.arange(len(size)))
    served = csr_array((np.ones(len(row)), (row, np.arange(len(row)))), shape=(len(size), len(row)))
    found = linprog(
        np.append(cost[possible], np.full(len(size), _MISSING)),
        A_ub=supply, b_ub=count.astype(float), A_eq=served, b_eq=size.astype(float),
        method="highs-ds",
    )  # fmt: skip
    taken = np.zeros(cost.shape, dtype=np.int64)
    # the matrix is totally unimodular, so the corner that the simplex method finds is whole
    taken[source, lot] = np.rint(found.x[:n]).astype(np.int64)
    return taken, np.minimum(-found.ineqlin.marginals, _MISSING)
