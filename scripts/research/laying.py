"""A model laid by one method: the time it takes, whether it is right, and how good it is."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from legorize_addon.core.layout.problem.problem import owners, with_margins
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY, Bricks
from legorize_addon.core.model.catalogue import Catalogue
from legorize_addon.core.model.contacts import ContactGraph, contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, Fill, UnitGrid
from legorize_addon.core.shopping import count_lots, not_made
from scripts.benchmarks.clock import least_seconds
from scripts.benchmarks.layout_figures import articulations, coinciding_seams, colours_lost, single
from scripts.benchmarks.tables import Row
from scripts.research.baselines import Lay
from scripts.research.energies import energies


@dataclass(frozen=True, slots=True, eq=False)
class Laid:
    """A model laid by one method.

    Attributes
    ----------
    bricks : Bricks
    links : ContactGraph
    faults : int
        Cells without or with a wrong brick, and bricks that are not made.
    seconds : float
        Of the processor, to lay and to verify.
    """

    bricks: Bricks
    links: ContactGraph
    faults: int
    seconds: float


def timed(way: Lay, shell: UnitGrid, catalogue: Catalogue, *, seed: int, repeats: int) -> Laid:
    """Lay and verify a model, and take the time.

    Parameters
    ----------
    way : callable
        The method.
    shell : UnitGrid
        A hollowed model of bricks.
    catalogue : Catalogue
    seed : int
        Of everything random.
    repeats : int
        Runs, of which the fastest counts.

    Returns
    -------
    Laid
    """
    done: list[tuple[Bricks, ContactGraph, int]] = []

    def run() -> None:
        bricks = way(shell, catalogue, np.random.default_rng(seed))
        links = contact_graph(bricks, catalogue)
        done.append((bricks, links, faults(shell, bricks, links, catalogue)))

    [seconds] = least_seconds(run, repeats=repeats)
    return Laid(*done[-1], seconds)


def faults(shell: UnitGrid, bricks: Bricks, links: ContactGraph, catalogue: Catalogue) -> int:
    """Count what is wrong with a layout.

    Parameters
    ----------
    shell : UnitGrid
        What it was to be a layout of.
    bricks : Bricks
    links : ContactGraph
        The same as cells.
    catalogue : Catalogue

    Returns
    -------
    int
        Cells that are claimed twice, bare, built in vain or of another colour,
        and bricks that are not made in theirs.
    """
    solid = with_margins(shell.solid, False)
    built = owners(links, solid.shape) != NOBODY
    required = with_margins(shell.cover == Fill.REQUIRED, False)
    _, wrong = colours_lost(with_colour_where_built(shell), bricks, links)
    pairs = sum(lot.count for lot in not_made(count_lots(Assembly(bricks, catalogue))))
    return links.collisions + int((required & ~built).sum()) + int((built & ~solid).sum()) + wrong + pairs


def with_colour_where_built(shell: UnitGrid) -> UnitGrid:
    """Return a grid that shows colours only where something has to be built."""
    return replace(shell, colour=np.where(shell.cover == Fill.REQUIRED, shell.colour, np.int16(COLOUR_ANY)))


def cells_of(shell: UnitGrid) -> int:
    """Count the cells of a model of bricks that have to be built."""
    return int((shell.cover == Fill.REQUIRED).all(axis=1).sum())


def figures(laid: Laid, catalogue: Catalogue) -> Row:
    """Return the figures that both tables have."""
    bricks, links = laid.bricks, laid.links
    return {
        "single": float(single(bricks, catalogue).mean()),
        "articulation": articulations(bricks, links) / len(bricks),
        "seams": coinciding_seams(links),
        "components": links.n_components,
        "floating": links.n_floating,
        "nothing_beneath": nothing_beneath(bricks, links),
        **energies(bricks, links, catalogue),
        "faults": laid.faults,
        "tc_s": laid.seconds,
    }


def nothing_beneath(bricks: Bricks, links: ContactGraph) -> int:
    """Count the bricks that rest on nothing when a model is built upwards: neither on the ground nor on a brick."""
    resting = bricks.corner[:, 2] == bricks.corner[:, 2].min()
    resting[links.pairs[:, 1]] = True
    return int((~resting).sum())
