"""What a build in the scene is made of, and what it came from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy

from ..core.building import Steps
from ..core.model import Assembly
from ..core.settings import Settings

if TYPE_CHECKING:
    from ..core.statics import Stability
    from ..core.unit_bricks import WantedColours


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """Bricks with their place in the world, and what is known of them.

    Attributes
    ----------
    assembly : Assembly
        The bricks, supports that are taken out among them.
    origin : sequence of three float
        Corner of the grid in model mm.
    scale : float
        Model mm per world mm.
    mm_per_unit : float
        World mm per Blender unit.
    stability : Stability or None
        Whether these bricks stand, row by row, for the panel and the heat map;
        supports that are taken out again may be left out.
    steps : Steps or None
        The order in which these bricks are built, for the panel and the steps.
    wanted : WantedColours or None
        The surface on the cells of a mesh's model, for the view of colour errors.
    """

    assembly: Assembly
    origin: Sequence[float]
    scale: float
    mm_per_unit: float
    stability: Stability | None = None
    steps: Steps | None = None
    wanted: WantedColours | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """What a model was made of.

    Attributes
    ----------
    name : str
        For the collection.
    objects : sequence of bpy.types.Object
        They are hidden, not changed, and shown again when the build is removed.
    settings : Settings or None
        What the model was made with, kept for the file's reader.
    notes : sequence of str
        Remarks to show beside the result.
    """

    name: str
    objects: Sequence[bpy.types.Object] = ()
    settings: Settings | None = None
    notes: Sequence[str] = ()
