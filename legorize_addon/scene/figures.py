"""What a build keeps of its size, its stability and its building for the panel, as plain values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.building import Steps
from ..core.model import Bricks, Catalogue, Role
from ..core.units import PLATES_PER_BRICK
from .brick_points import sizes
from .verdict import check_of

if TYPE_CHECKING:
    from ..core.statics import Stability


def figures(
    bricks: Bricks, stability: Stability | None, steps: Steps | None, catalogue: Catalogue
) -> dict[str, dict[str, Any]]:
    """Return what the panel says of a build.

    Parameters
    ----------
    bricks : Bricks
        Model and supports, supports that are taken out at the end.
    stability : Stability, optional
        Of the model, or of all bricks.
    steps : Steps, optional
        The building order.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    dict
        ``summary``, see :func:`summary`; ``check``, see
        :func:`~legorize_addon.scene.verdict.check_of`, and ``building``, see
        :func:`building_figures`, empty where nothing is known.
    """
    return {
        "summary": summary(bricks, catalogue),
        "check": {} if stability is None else check_of(stability, bricks.take(np.arange(len(stability.margin)))),
        "building": {} if steps is None else building_figures(bricks, steps, catalogue),
    }


def n_layers(bricks: Bricks) -> int:
    """Return the number of brick layers, empty ones included."""
    return int(bricks.corner[:, 2].max()) // PLATES_PER_BRICK + 1


def summary(bricks: Bricks, catalogue: Catalogue) -> dict[str, int | float]:
    """Return the figures of the finished model: bricks, parts, colours, size in studs, mass in grams."""
    finished = bricks.role != Role.SUPPORT_OUTSIDE
    bricks = bricks.take(finished) if finished.any() else bricks
    low = bricks.corner[:, :2]
    studs = (low + sizes(bricks.part, bricks.turn, catalogue)).max(axis=0) - low.min(axis=0)
    return {
        "bricks": len(bricks),
        "parts": len(np.unique(bricks.part)),
        "colours": len(np.unique(bricks.colour)),
        "studs_x": int(studs[0]),
        "studs_y": int(studs[1]),
        "layers": n_layers(bricks),
        "mass": float(catalogue.mass[bricks.part].sum()),
    }


def building_figures(bricks: Bricks, steps: Steps, catalogue: Catalogue) -> dict[str, int | float]:
    """Return the figures of the supports and of the building.

    Parameters
    ----------
    bricks : Bricks
        Model and supports.
    steps : Steps
        How they are built.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    dict
        ``removed`` and ``removed_mass``, the bricks of supports that are taken
        out and their grams; ``kept``, those that stay; ``pieces``; ``steps``.
    """
    outside = bricks.role == Role.SUPPORT_OUTSIDE
    return {
        "removed": int(outside.sum()),
        "removed_mass": float(catalogue.mass[bricks.part[outside]].sum()),
        "kept": int(np.isin(bricks.role, (Role.SUPPORT_INSIDE, Role.SUPPORT_KEPT)).sum()),
        "pieces": len(np.unique(bricks.piece)),
        "steps": len(steps),
    }
