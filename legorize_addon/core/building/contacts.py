"""Which bricks touch while a model is built: supports only touch what stands on the same table."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Ints, Mask
from ..model import Assembly, Bricks, Catalogue, ContactGraph, Rows, contact_graph


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


def building_contacts(assembly: Assembly, *, temporary: Mask) -> BuildingContacts:
    """Find the contacts of a model in pieces, each with its supports.

    Parameters
    ----------
    assembly : Assembly
        Model and supports, n rows. The supports of a piece above 0 may lie in
        cells of other pieces, which they never meet.
    temporary : (n,) bool array
        Bricks of supports.

    Returns
    -------
    BuildingContacts
    """
    stays = np.flatnonzero(~temporary)
    found = [_among(assembly.bricks, assembly.catalogue, stays, np.ones(len(stays), dtype=bool))]
    for number in np.unique(assembly.bricks.piece[temporary]).tolist():
        # those of the first piece are still there when the others are joined
        with_it = ~temporary if number == 0 else ~temporary & (assembly.bricks.piece == number)
        rows = np.flatnonzero(with_it | (temporary & (assembly.bricks.piece == number)))
        found.append(_among(assembly.bricks, assembly.catalogue, rows, temporary[rows]))
    return BuildingContacts(
        pairs=np.concatenate([each.pairs for each in found]),
        studs=np.concatenate([each.studs for each in found]),
        collisions=max(each.collisions for each in found),
    )


def _among(bricks: Bricks, catalogue: Catalogue, rows: Ints, wanted: Mask) -> BuildingContacts:
    """Return the contacts among some bricks of which one at least is wanted."""
    graph: ContactGraph = contact_graph(bricks.take(rows), catalogue)
    kept = wanted[graph.pairs].any(axis=1)
    return BuildingContacts(rows[graph.pairs[kept]].astype(np.int32), graph.studs[kept], graph.collisions)
