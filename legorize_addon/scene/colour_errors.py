"""How far the bricks' colours are from the texture, and the surface that says so, kept with a build.

The surface on each cell is kept, not the errors alone, so that bricks that are changed by hand are judged as well.
"""

from __future__ import annotations

import base64
import zlib
from typing import TYPE_CHECKING, Any, Final

import bpy
import numpy as np

from .assembly_columns import Columns
from .model import Model
from .state import BUILD_KEY

if TYPE_CHECKING:
    from ..core.unit_bricks import WantedColours

COLOUR_ERROR: Final = "colour_error"
"""Attribute with the colour error of a brick in CIEDE2000, and name of what the panel says of all."""

NO_ERROR: Final = -1.0
"""Error of a brick that shows no surface."""

SURFACE: Final = "surface"
"""Name of the packed surface: about 12 bytes a visible cell."""

_CELL: Final = np.dtype([("cell", "<i2", 3), ("light", "<f2", 3), ("area", "<f2")])


def colour_error_facts(model: Model) -> tuple[Columns, dict[str, Any]]:
    """Return what points and state of a build know of its colours; nothing of a model without a texture.

    Parameters
    ----------
    model : Model

    Returns
    -------
    columns : dict
        ``COLOUR_ERROR``, (n,) float32.
    fields : dict
        ``COLOUR_ERROR``: ``mean``; of the worst brick ``worst``, its error, ``name`` and ``layer``, counted from 1;
        ``SURFACE``.
    """
    if model.wanted is None:
        return {}, {}
    from ..core.measures import colour_errors
    from ..core.report import brick_name, layer_of

    bricks = model.assembly.bricks
    found = colour_errors(bricks, model.assembly.catalogue, model.wanted)
    told: dict[str, Any] = {}
    if found.worst >= 0:
        told = {
            "mean": found.mean,
            "worst": float(found.error[found.worst]),
            "name": brick_name(model.assembly, found.worst),
            "layer": layer_of(bricks, found.worst),
        }
    column = np.where(np.isnan(found.error), np.float32(NO_ERROR), found.error)
    return {COLOUR_ERROR: column}, {COLOUR_ERROR: told, SURFACE: _packed(model.wanted)}


def colour_error_of(build: bpy.types.Collection) -> dict[str, Any]:
    """Return what the panel says of a build's colours, see :func:`colour_error_facts`; empty if nothing is known."""
    found = build[BUILD_KEY].get(COLOUR_ERROR)
    return {} if found is None else dict(found.to_dict())


def surface_of(build: bpy.types.Collection) -> WantedColours | None:
    """Return the surface on the cells of a build; None of an image, a brick model or an earlier version."""
    found = build[BUILD_KEY].get(SURFACE)
    if not found:
        return None
    from ..core.unit_bricks import WantedColours

    plates, text = str(found).split(" ", 1)
    table = np.frombuffer(zlib.decompress(base64.b85decode(text)), dtype=_CELL)
    return WantedColours(
        cell=table["cell"].astype(np.int16),
        plates=int(plates),
        light=table["light"].astype(np.float32),
        area=table["area"].astype(np.float32),
    )


def _packed(wanted: WantedColours) -> str:
    table = np.empty(len(wanted), dtype=_CELL)
    table["cell"], table["light"], table["area"] = wanted.cell, wanted.light, wanted.area
    return f"{wanted.plates} {base64.b85encode(zlib.compress(table.tobytes())).decode('ascii')}"
