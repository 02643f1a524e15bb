"""The result of every stage of a run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields

import numpy as np
from numpy.typing import NDArray

from .arrays import Floats
from .building import Proof
from .colours import SurfaceColours
from .edits import NO_EDITS, Edits, Outcome
from .half_studs import Halves
from .mesh import Repairs, TriangleMesh
from .model import Assembly, Bricks, ContactGraph, UnitGrid
from .mosaic import Canvas, Covered, Goal
from .settings import Settings
from .slicing import Marks, Slices, Trajectories
from .statics import Stability
from .stock import Owned, Prices
from .supports import AssemblyPlan, Joint
from .unit_bricks import Offsets, WantedColours
from .units import STUD


@dataclass(frozen=True, slots=True, eq=False)
class Cut:
    """The cut of the mesh.

    Attributes
    ----------
    slices : Slices
    layer : (n_slices,) int32 array
        Brick layer of every slice.
    plate : (n_slices,) int8 array
        Plate of that layer whose middle the slice is.
    marks : Marks or None
        Layers that differ from their neighbours, where plates were asked for.
    """

    slices: Slices
    layer: NDArray[np.int32]
    plate: NDArray[np.int8]
    marks: Marks | None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Draft:
    """What is known of a model of a mesh before its bricks are laid: the result of every stage until then.

    Attributes
    ----------
    mesh : TriangleMesh
        The repaired mesh in the size of the model, in mm.
    repairs : Repairs
        What was repaired.
    scale : float
        Model mm per world mm.
    turn : (4, 4) float64 array
        From world mm to those of the mesh that stands upright, before it is scaled.
    surface : SurfaceColours
        The brick colour of every texel.
    cut : Cut
        The mesh cut in slices.
    trajectories : Trajectories
        The coloured loops.
    offsets : Offsets
        What closes horizontal faces.
    grid : UnitGrid
        All unit bricks, before hollowing.
    hollow : UnitGrid
        Required and optional cells.
    wanted : WantedColours
        The surface on each cell that shows it, whatever colour the cell has.
    halves : Halves or None
        Where parts lie half a stud off the rest; mesh, cut, cells and what follows from them are drawn together.
    """

    mesh: TriangleMesh
    repairs: Repairs
    scale: float
    turn: Floats
    surface: SurfaceColours
    cut: Cut
    trajectories: Trajectories
    offsets: Offsets
    grid: UnitGrid
    hollow: UnitGrid
    wanted: WantedColours
    halves: Halves | None = None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Finished:
    """A brick model with all that is known of it, whoever laid its bricks.

    Attributes
    ----------
    settings : Settings
        What was asked for.
    scale : float
        Model mm per world mm.
    assembly : Assembly
        The layout, with the pillars that stay in it, and the step in which each
        brick is placed.
    stability : Stability
        Whether they stand, and the proof.
    supports : AssemblyPlan
        Their supports while they are built, and the building order.
    joints : tuple of Joint
        Between the pieces of a split model.
    prices : Prices or None
        What parts cost, where a price file was given.
    owned : Owned or None
        Which parts the user has, where inventories were given.
    proof : Proof or None
        Whether every building step stands by forces, where that was asked for.
    notes : tuple of str
        Sentences for the user.
    timings : mapping of str to float
        CPU seconds by stage.
    texts : mapping of str to str
        Contents of files that are kept for later, by name, where somebody keeps them.
    """

    settings: Settings
    scale: float
    assembly: Assembly
    stability: Stability
    supports: AssemblyPlan
    joints: tuple[Joint, ...]
    prices: Prices | None
    owned: Owned | None
    proof: Proof | None
    notes: tuple[str, ...]
    timings: Mapping[str, float]
    texts: Mapping[str, str] = field(default_factory=dict)

    @property
    def bricks(self) -> Bricks:
        """The bricks of the finished model."""
        return self.assembly.bricks

    @property
    def graph(self) -> ContactGraph:
        """How they touch."""
        return self.assembly.graph

    @property
    def origin(self) -> Floats:
        """Corner of cell 0 in mm of the scaled model, (3,)."""
        return np.zeros(3)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Judged(Finished):
    """A model whose bricks lay already.

    Attributes
    ----------
    corner : (3,) float64 array
        Of cell 0 in mm of the model.
    left_out : mapping of str to int
        Numbers of parts that the catalogue does not have, and how many of each there were.
    """

    corner: Floats
    left_out: Mapping[str, int]

    @property
    def origin(self) -> Floats:
        """Corner of cell 0 in mm of the model, (3,)."""
        return self.corner


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Build(Finished):
    """A model of a mesh: the result of every stage.

    Attributes
    ----------
    mesh : TriangleMesh
        The repaired mesh in the size of the model, in mm.
    repairs : Repairs
        What was repaired.
    turn : (4, 4) float64 array
        From world mm to those of the mesh that stands upright, before it is scaled.
    surface : SurfaceColours
        The brick colour of every texel.
    cut : Cut
        The mesh cut in slices.
    trajectories : Trajectories
        The coloured loops.
    offsets : Offsets
        What closes horizontal faces.
    grid : UnitGrid
        All unit bricks, before hollowing.
    hollow : UnitGrid
        Required and optional cells.
    wanted : WantedColours
        The surface on each cell that shows it, whatever colour the cell has.
    halves : Halves or None
        Where parts lie half a stud off the rest; mesh, cut and cells are drawn together, the bricks are not.
    edits : Edits
        Changes by hand that were made.
    outcomes : tuple of Outcome
        What became of each of them.
    unedited : Bricks or None
        The layout before them.
    beyond : mapping of str to int
        Of a model made as in the paper: the repairs that the paper does not have, counted.
    """

    mesh: TriangleMesh
    repairs: Repairs
    turn: Floats
    surface: SurfaceColours
    cut: Cut
    trajectories: Trajectories
    offsets: Offsets
    grid: UnitGrid
    hollow: UnitGrid
    wanted: WantedColours

    halves: Halves | None = None
    edits: Edits = NO_EDITS
    outcomes: tuple[Outcome, ...] = ()
    unedited: Bricks | None = None
    beyond: Mapping[str, int] = field(default_factory=dict)

    @property
    def draft(self) -> Draft:
        """What was known before the bricks were laid; its cells are those that they cover in the end."""
        return Draft(**{entry.name: getattr(self, entry.name) for entry in fields(Draft)})

    @property
    def origin(self) -> Floats:
        """Corner of cell [0, 0, 0, 0] of the grid in mm, in the coordinates of the scaled mesh."""
        return self.grid.origin


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Mosaic(Finished):
    """A mosaic of an image: the result of every stage.

    Attributes
    ----------
    pixels : (int, int)
        Width and height of the image.
    canvas : Canvas
        Studs of the image and its border.
    goal : Goal
        What the studs of the image should look like.
    colour : (rows, columns) int16 array
        LDraw code of each stud of the image, before the base was joined.
    covered : Covered
        Base and surface as they were laid.
    """

    pixels: tuple[int, int]
    canvas: Canvas
    goal: Goal
    colour: NDArray[np.int16]
    covered: Covered

    @property
    def origin(self) -> Floats:
        """Corner of the mosaic in mm, (3,): it lies around the origin, or stands there."""
        across, deep = self.canvas.size
        if self.settings.standing:
            deep = int(self.assembly.graph.low[1]) + self.assembly.graph.owner.shape[1]
        return np.array([-across * STUD / 2, -deep * STUD / 2, 0.0])
