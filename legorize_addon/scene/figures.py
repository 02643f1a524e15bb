"""What a build keeps of its size, its stability and its building for the panel, as plain values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.building import Steps
from ..core.model import Assembly, Bricks, Role
from ..core.units import PLATES_PER_BRICK
from .brick_points import sizes
from .kept_steps import stored_steps
from .verdict import check_of

if TYPE_CHECKING:
    from ..core.statics import Stability


def figures(assembly: Assembly, stability: Stability | None, steps: Steps | None) -> dict[str, dict[str, Any]]:
    """Return what the panel says of a build.

    Parameters
    ----------
    assembly : Assembly
        Model and supports, supports that are taken out at the end.
    stability : Stability, optional
        Of the model, or of all bricks.
    steps : Steps, optional
        The building order.

    Returns
    -------
    dict
        ``summary``, see :func:`summary`; ``check``, see
        :func:`~legorize_addon.scene.verdict.check_of`, and ``building``, see
        :func:`building_figures`, and ``steps``, see
        :func:`~legorize_addon.scene.kept_steps.stored_steps`, empty where nothing is known.
    """
    return {
        "summary": summary(assembly),
        "check": {} if stability is None else check_of(stability, assembly.bricks),
        "building": {} if steps is None else building_figures(assembly, steps),
        "steps": {} if steps is None else stored_steps(steps),
    }


def n_layers(bricks: Bricks) -> int:
    """Return the number of brick layers, empty ones included."""
    return int(bricks.corner[:, 2].max()) // PLATES_PER_BRICK + 1


def summary(assembly: Assembly) -> dict[str, int | float]:
    """Return the figures of the finished model: bricks, parts, colours, size in studs, mass in grams."""
    bricks, catalogue = assembly.bricks, assembly.catalogue
    finished = bricks.role != Role.SUPPORT_OUTSIDE
    bricks = bricks.take(finished) if finished.any() else bricks
    low = (bricks.corner + bricks.shift)[:, :2]
    studs = np.ceil((low + sizes(bricks.part, bricks.turn, catalogue)).max(axis=0) - low.min(axis=0))
    return {
        "bricks": len(bricks),
        "parts": len(np.unique(bricks.part)),
        "colours": len(np.unique(bricks.colour)),
        "studs_x": int(studs[0]),
        "studs_y": int(studs[1]),
        "layers": n_layers(bricks),
        "mass": float(catalogue.mass[bricks.part].sum()),
    }


def building_figures(assembly: Assembly, steps: Steps) -> dict[str, int | float]:
    """Return the figures of the supports and of the building.

    Parameters
    ----------
    assembly : Assembly
        Model and supports.
    steps : Steps
        How they are built.

    Returns
    -------
    dict
        ``removed`` and ``removed_mass``, the bricks of supports that are taken
        out and their grams; ``kept``, those that stay; ``pieces``; ``steps``;
        ``moves``, how often a brick or an assembly is taken in hand.
    """
    outside = assembly.bricks.role == Role.SUPPORT_OUTSIDE
    return {
        "removed": int(outside.sum()),
        "removed_mass": float(assembly.catalogue.mass[assembly.bricks.part[outside]].sum()),
        "kept": int(np.isin(assembly.bricks.role, (Role.SUPPORT_INSIDE, Role.SUPPORT_KEPT)).sum()),
        "pieces": len(np.unique(assembly.bricks.piece)),
        "steps": len(steps),
        "moves": len(steps.moves),
    }
