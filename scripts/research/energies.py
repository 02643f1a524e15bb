"""The paper's energies of layouts: how well bricks hold to others, mirror each other, and how few they are."""

from __future__ import annotations

from typing import Final

import numpy as np

from legorize_addon.core.layout.learning import energies as features
from legorize_addon.core.model.bricks import NOBODY, Bricks
from legorize_addon.core.model.catalogue import Catalogue
from legorize_addon.core.model.contacts import ContactGraph

ENERGIES: Final = ("e_unit_connection", "e_vertical", "e_horizontal", "e_symmetry", "e_efficiency")
"""The paper's energies of a layer."""


def energies(bricks: Bricks, links: ContactGraph, catalogue: Catalogue) -> dict[str, float]:
    """Return the paper's energies of a layout, layer by layer, on average over its bricks; lower is better.

    Parameters
    ----------
    bricks : Bricks
        All of one height.
    links : ContactGraph
        The same as cells.
    catalogue : Catalogue

    Returns
    -------
    dict
        Of the layers by themselves, and of what holds them to those below and
        above; the ground holds nothing.
    """
    levels, layer = np.unique(bricks.corner[:, 2], return_inverse=True)
    height = catalogue.parts[int(bricks.part[0])].height
    planes = np.pad(links.owner, ((height, height), (0, 0), (0, 0)), constant_values=NOBODY)
    corner = np.array([part.corner for part in catalogue.parts])[bricks.part]
    size = np.bincount(links.owner[links.owner != NOBODY], minlength=len(bricks)) // height
    rows = []
    for number, level in enumerate(levels.tolist()):
        mine = np.flatnonzero(layer == number)
        own = np.full(len(bricks) + 1, NOBODY, dtype=np.int32)
        own[mine] = np.arange(len(mine))
        owner, colour = own[planes[level + height]], bricks.colour[mine]
        below, above = planes[level + height - 1], planes[level + 2 * height]
        rows.append(
            (
                features.minimum_unit_connection(owner, colour),
                features.vertical_stability(owner, len(mine), above != NOBODY, below != NOBODY),
                features.horizontal_stability(owner, len(mine), above, below),
                features.symmetry(owner, colour),
                features.efficiency(size[mine], corner[mine]),
            )
        )
    mean = np.average(rows, axis=0, weights=np.bincount(layer))
    return dict(zip(ENERGIES, mean.tolist(), strict=True))
