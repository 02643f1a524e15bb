"""What the .blend keeps of the user's choices: the settings, and what is shown of a build."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from ..core.model import Role
from ..scene import builds
from ..view import roles_shown, show_role
from . import view_values
from .current import current_build
from .settings_properties import LegorizeSettings, label
from .view_choices import CUT_ITEMS, LINE_ITEMS, NUMBER_ITEMS, ROLE_TEXTS


def _is_build(self: bpy.types.PropertyGroup, collection: bpy.types.Collection) -> bool:
    return collection in builds(self.id_data)


def _role_property(role: Role) -> Any:
    """Return the Blender property that shows or hides a role."""

    def is_shown(self: bpy.types.PropertyGroup) -> bool:
        """Return whether the current build shows the role."""
        build = current_build(self.id_data)
        return bool(build) and roles_shown(build).get(role, False)

    def show(self: bpy.types.PropertyGroup, visible: bool) -> None:
        """Show or hide the role in the current build."""
        build = view_values.whole_build(self)
        if build and role in roles_shown(build):
            show_role(build, role, visible=visible)

    text = f"Show {ROLE_TEXTS[role]}, in the viewport and in renders"
    return BoolProperty(name=label(role.name), description=text, get=is_shown, set=show)


LegorizeRoles = type(
    "LegorizeRoles",
    (bpy.types.PropertyGroup,),
    {
        "__doc__": "Which roles of bricks are shown.",
        "__annotations__": {role.name.lower(): _role_property(role) for role in Role},
    },
)


class LegorizeView(bpy.types.PropertyGroup):
    """What the scene shows of which build, and the settings of the next one."""

    settings: PointerProperty(type=LegorizeSettings)
    image: PointerProperty(type=bpy.types.Image, name="Image", description="The image that becomes a mosaic")
    build: PointerProperty(
        type=bpy.types.Collection,
        poll=_is_build,
        update=view_values.take_settings,
        name="Model",
        description="The brick model that these panels show",
    )
    top_layer: IntProperty(
        name="Top layer",
        description="Highest layer of bricks that is shown, in the viewport and in renders",
        min=1,
        get=view_values.top_layer,
        set=view_values.set_top_layer,
    )
    single_layer: BoolProperty(
        name="Only this layer",
        description="Show the top layer alone, without those below it",
        get=view_values.single_layer,
        set=view_values.set_single_layer,
    )
    show_sources: BoolProperty(
        name="Show original",
        description="Show the original objects, which building hides; removing the model shows them again",
        update=view_values.update_sources,
    )
    ghost: BoolProperty(
        name="Original as ghost",
        description="Show the wires of the original objects over the bricks, in the viewport only",
        get=view_values.ghost,
        set=view_values.set_ghost,
    )
    numbers: EnumProperty(
        name="Numbers",
        description="Write numbers on the bricks that are seen, or on those of the step that is shown; in the viewport "
        "only",
        items=NUMBER_ITEMS,
    )
    roles: PointerProperty(type=LegorizeRoles)
    section_axis: EnumProperty(
        name="Section",
        description="Cut the model open at right angles to this axis; bricks beyond the cut are hidden, not removed",
        items=CUT_ITEMS,
        get=view_values.section_axis,
        set=view_values.set_section_axis,
    )
    section_at: FloatProperty(
        name="Cut at",
        description=(
            "Position of the cut, as a share of the model's extent; bricks are hidden if their centre lies beyond it"
        ),
        subtype="FACTOR",
        min=0.0,
        max=1.0,
        get=view_values.section_at,
        set=view_values.set_section_at,
    )
    section_flip: BoolProperty(
        name="Other side",
        description="Hide the bricks on the other side of the cut",
        get=view_values.section_flip,
        set=view_values.set_section_flip,
    )
    exploded: FloatProperty(
        name="Explode",
        description="Distance between the pieces, as a share of the model's height, in the viewport and in renders",
        subtype="FACTOR",
        min=0.0,
        max=1.0,
        get=view_values.apart,
        set=view_values.set_apart,
    )
    by_steps: BoolProperty(
        name="Building steps",
        description="Show the model after a number of building steps, with its supports; pieces that are not joined "
        "yet stand beside it",
        get=view_values.by_steps,
        set=view_values.set_by_steps,
    )
    step: IntProperty(
        name="Step",
        description="Number of building steps that are done, in the viewport and in renders",
        min=1,
        get=view_values.step,
        set=view_values.set_step,
    )
    highlight: BoolProperty(
        name="Highlight step",
        description="Show the bricks placed before the step in pale colours, and supports tinted",
        default=True,
        update=view_values.update_highlight,
    )
    heat_map: BoolProperty(
        name="Heat map",
        description="Colour each brick by the friction that it has left, in the viewport and in renders: green much, "
        "yellow half, red none, black loaded beyond its friction, magenta hangs in the air",
        get=view_values.heat_map,
        set=view_values.set_heat_map,
    )
    lines: EnumProperty(
        name="Trajectories",
        description="Colours of the trajectories that are shown or written next",
        items=LINE_ITEMS,
    )
    trajectories: BoolProperty(
        name="Show trajectories",
        description="Show the trajectories of the layers that are shown, in the viewport and in renders",
        get=view_values.trajectories,
        set=view_values.set_trajectories,
    )
    detail: EnumProperty(
        name="Detail",
        description="How finely the parts are drawn; low keeps very large models fast",
        items=[
            ("low", "Low", "Plain boxes with eight-sided studs"),
            ("high", "High", "Bevelled edges, round studs, hollow from below"),
        ],
        default="high",
        update=view_values.update_detail,
    )


classes = (LegorizeSettings, LegorizeRoles, LegorizeView)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register the property groups and hang them on the scene."""
    _register_classes()
    bpy.types.Scene.legorize = PointerProperty(type=LegorizeView)
    # not of a scene: an undo leaves it, and no file keeps it
    bpy.types.WindowManager.legorize_said = StringProperty(options={"SKIP_SAVE"})


def unregister() -> None:
    """Undo :func:`register`."""
    del bpy.types.WindowManager.legorize_said
    del bpy.types.Scene.legorize
    _unregister_classes()
