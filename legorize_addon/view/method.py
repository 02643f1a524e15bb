"""The steps of the method in a scene: trajectories, unit bricks and hollowing as a model of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Literal, NamedTuple

import bpy
from mathutils import Matrix

from ..core.model import Assembly, load_catalogue
from ..core.units import STUD
from ..scene import Detail, Model, Source, add_lines, builds, line_objects, show_build, state_of
from .visibility import roles_shown, show_role

if TYPE_CHECKING:
    from ..core.build import Draft
    from ..core.method import Shown

Step = Literal["trajectories", "unit-bricks", "hollowing"]

STEPS: Final[dict[Step, tuple[str, str]]] = {
    "trajectories": ("Trajectories", "The coloured outlines of every slice"),
    "unit-bricks": ("Unit Bricks", "The initial model: one brick or plate of 1 x 1 for each cell that is seen"),
    "hollowing": (
        "Hollowing",
        "The cells that hollowing leaves: those that are seen in their colours, those that carry grey, pillars inside "
        "red, those that may be built tan",
    ),
}
"""What can be shown: its name and a sentence."""

STEP_KEY: Final = "legorize_method"
"""Key, on a build, of the name of the model whose steps it shows."""

GAP: Final = 4
"""Studs between a model and its steps, which stand beside it."""


class MethodView(NamedTuple):
    """What is shown of the method.

    Attributes
    ----------
    step : {"trajectories", "unit-bricks", "hollowing"}
        Trajectories are in the scene in any case, but shown at first for the first alone.
    lines : {"sides", "colours"}
        How trajectories are coloured.
    beside : bool
        Whether it stands beside the place of the model, not in it.
    """

    step: Step
    lines: Shown
    beside: bool = True


def show_method(
    scene: bpy.types.Scene,
    draft: Draft,
    name: str,
    *,
    view: MethodView,
    mm_per_unit: float,
    detail: Detail = "low",
) -> bpy.types.Collection:
    """Put a step of the method into a scene, in place of the one shown before; layers, roles and section work on it.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene that gets the collection.
    draft : Draft
    name : str
        Of the model.
    view : MethodView
    mm_per_unit : float
        World mm per Blender unit.
    detail : {"low", "high"}, optional
        Detail of the part meshes.

    Returns
    -------
    bpy.types.Collection
        A build.

    Raises
    ------
    BuildError
        There are no cells.
    """
    from ..core.method import hollowed_model, initial_model, trajectory_lines

    catalogue, step = load_catalogue(), view.step
    bricks = hollowed_model(draft.hollow, catalogue) if step == "hollowing" else initial_model(draft.grid, catalogue)
    earlier = [build for build in builds(scene) if build.get(STEP_KEY) == name]
    model = Model(Assembly(bricks, catalogue), draft.grid.origin, draft.scale, mm_per_unit)
    shown = show_build(scene, model, Source(f"{name} {step.replace('-', ' ')}"), detail=detail, replaces=earlier)
    shown[STEP_KEY] = name
    add_lines(shown, trajectory_lines(draft, catalogue, shown=view.lines))
    if view.beside and not earlier:
        root = state_of(shown).root
        away = (draft.grid.colour.shape[3] + GAP) * STUD
        root.matrix_basis = root.matrix_basis @ Matrix.Translation((away, 0.0, 0.0))
    show_trajectories(shown, visible=step == "trajectories")
    if step == "trajectories":
        for role in roles_shown(shown):
            show_role(shown, role, visible=False)
    return shown


def shows_step(build: bpy.types.Collection) -> bool:
    """Return whether a build is a step of the method: a view, which nobody builds, so that nothing is known of it."""
    return STEP_KEY in build


def has_trajectories(build: bpy.types.Collection) -> bool:
    """Return whether a build has trajectories."""
    return bool(line_objects(build))


def trajectories_shown(build: bpy.types.Collection) -> bool:
    """Return whether trajectories of a build are shown."""
    return any(not thing.hide_render for thing in line_objects(build))


def show_trajectories(build: bpy.types.Collection, *, visible: bool) -> None:
    """Show or hide the trajectories of a build, in the viewport and in renders."""
    for thing in line_objects(build):
        thing.hide_viewport = thing.hide_render = not visible
