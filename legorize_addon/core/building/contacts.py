"""Which bricks touch while a model is built: supports only touch what stands on the same table."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Ints, Mask
from ..model import Assembly, ContactGraph, Rows, contact_graph


@dataclass(frozen=True, slots=True, eq=False)
class BuildingContacts:
    """Contacts of bricks on their way.

    Attributes
    ----------
    pairs : (n_pairs, 2) int32 array
        Lower and upper brick of each contact.
    studs : (n_pairs,) int32 array
        Studs that the two share.
    collisions : int
        Most cells that more than one brick claims at the same time.
    """

    pairs: Rows
    studs: Rows
    collisions: int


def building_contacts(assembly: Assembly, *, temporary: Mask, model: ContactGraph | None = None) -> BuildingContacts:
    """Find the contacts of a model in pieces, each with its supports.

    Parameters
    ----------
    assembly : Assembly
        Model and supports, n rows. The supports of a piece above 0 may lie in
        cells of other pieces, which they never meet.
    temporary : (n,) bool array
        Bricks of supports.
    model : ContactGraph, optional
        Of the others, in their order, where it is known.

    Returns
    -------
    BuildingContacts
    """
    stays = np.flatnonzero(~temporary)
    if model is None:
        model = contact_graph(assembly.bricks.take(stays), assembly.catalogue)
    found = [_wanted(model, stays, np.ones(len(stays), dtype=bool))]
    for number in np.unique(assembly.bricks.piece[temporary]).tolist():
        # those of the first piece are still there when the others are joined
        with_it = ~temporary if number == 0 else ~temporary & (assembly.bricks.piece == number)
        rows = np.flatnonzero(with_it | (temporary & (assembly.bricks.piece == number)))
        graph = contact_graph(assembly.bricks.take(rows), assembly.catalogue)
        found.append(_wanted(graph, rows, temporary[rows]))
    return BuildingContacts(
        pairs=np.concatenate([each.pairs for each in found]),
        studs=np.concatenate([each.studs for each in found]),
        collisions=max(each.collisions for each in found),
    )


def _wanted(graph: ContactGraph, rows: Ints, wanted: Mask) -> BuildingContacts:
    """Return the contacts in a graph of some bricks, given by their rows, of which one at least is wanted."""
    kept = wanted[graph.pairs].any(axis=1)
    return BuildingContacts(rows[graph.pairs[kept]].astype(np.int32), graph.studs[kept], graph.collisions)
