"""What the .blend keeps of the user's choices: the settings, and what is shown of a build."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from ..core.model import Role, load_catalogue
from ..scene import (
    Section,
    builds,
    damage,
    ghost_shown,
    own_parts,
    point_objects,
    set_detail,
    show_ghost,
    show_sources,
    state_of,
)
from ..view import (
    cut_away,
    explode,
    exploded,
    has_margins,
    heat_map_shown,
    highlight_step,
    n_steps,
    roles_shown,
    section_of,
    show_heat_map,
    show_layers,
    show_role,
    show_steps,
    show_trajectories,
    steps_done,
    trajectories_shown,
)
from .settings_properties import LegorizeSettings, label, take_kept
from .view_choices import CUT_ITEMS, CUTS, LINE_ITEMS, NUMBER_ITEMS, ROLE_TEXTS


def current_build(scene: bpy.types.Scene) -> bpy.types.Collection | None:
    """Return the build that the panel shows: the one chosen, else the newest; None without any."""
    there = builds(scene)
    return scene.legorize.build if scene.legorize.build in there else next(reversed(there), None)


def _is_build(self: bpy.types.PropertyGroup, collection: bpy.types.Collection) -> bool:
    return collection in builds(self.id_data)


def _whole_build(self: bpy.types.PropertyGroup) -> bpy.types.Collection | None:
    """Return the build that the panel shows if there is one and it is not damaged."""
    build = current_build(self.id_data)
    return None if build is None or damage(build) else build


def _top_layer(self: bpy.types.PropertyGroup) -> int:
    build = current_build(self.id_data)
    return state_of(build).top_layer if build else 1


def _set_top_layer(self: bpy.types.PropertyGroup, value: int) -> None:
    build = _whole_build(self)
    if build:
        top = max(1, min(value, state_of(build).layers))
        show_layers(self.id_data, build, top, single=state_of(build).single_layer)


def _single_layer(self: bpy.types.PropertyGroup) -> bool:
    build = current_build(self.id_data)
    return bool(build) and state_of(build).single_layer


def _set_single_layer(self: bpy.types.PropertyGroup, value: bool) -> None:
    build = _whole_build(self)
    if build:
        show_layers(self.id_data, build, state_of(build).top_layer, single=value)


def _section(self: bpy.types.PropertyGroup) -> Section:
    build = current_build(self.id_data)
    return section_of(build) if build else Section()


def _cut(self: bpy.types.PropertyGroup, **changes: Any) -> None:
    build = _whole_build(self)
    if build:
        cut_away(build, replace(section_of(build), **changes))


def _section_axis(self: bpy.types.PropertyGroup) -> int:
    return CUTS.index(_section(self).axis)


def _set_section_axis(self: bpy.types.PropertyGroup, value: int) -> None:
    _cut(self, axis=CUTS[value])


def _section_at(self: bpy.types.PropertyGroup) -> float:
    return _section(self).at


def _set_section_at(self: bpy.types.PropertyGroup, value: float) -> None:
    _cut(self, at=value)


def _section_flip(self: bpy.types.PropertyGroup) -> bool:
    return _section(self).flip


def _set_section_flip(self: bpy.types.PropertyGroup, value: bool) -> None:
    _cut(self, flip=value)


def _heat_map(self: bpy.types.PropertyGroup) -> bool:
    build = current_build(self.id_data)
    return bool(build) and heat_map_shown(build)


def _set_heat_map(self: bpy.types.PropertyGroup, value: bool) -> None:
    build = _whole_build(self)
    if build and has_margins(build):
        show_heat_map(build, visible=value)


def _exploded(self: bpy.types.PropertyGroup) -> float:
    build = current_build(self.id_data)
    return exploded(build) if build else 0.0


def _set_exploded(self: bpy.types.PropertyGroup, value: float) -> None:
    build = _whole_build(self)
    if build and n_steps(build):
        explode(build, value)


def _step(self: bpy.types.PropertyGroup) -> int:
    build = current_build(self.id_data)
    return steps_done(build) or n_steps(build) if build else 0


def _set_step(self: bpy.types.PropertyGroup, value: int) -> None:
    build = _whole_build(self)
    if build and n_steps(build):
        show_steps(build, max(1, min(value, n_steps(build))))
        highlight_step(build, visible=self.highlight)


def _by_steps(self: bpy.types.PropertyGroup) -> bool:
    build = current_build(self.id_data)
    return bool(build) and bool(steps_done(build))


def _set_by_steps(self: bpy.types.PropertyGroup, value: bool) -> None:
    build = _whole_build(self)
    if build and n_steps(build):
        show_steps(build, _step(self) if value else 0)
        highlight_step(build, visible=value and self.highlight)


def _update_highlight(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    _set_by_steps(self, _by_steps(self))


def _update_sources(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    build = current_build(self.id_data)
    if build:
        show_sources(build, visible=self.show_sources)


def _ghost(self: bpy.types.PropertyGroup) -> bool:
    build = current_build(self.id_data)
    return bool(build) and ghost_shown(build)


def _set_ghost(self: bpy.types.PropertyGroup, value: bool) -> None:
    build = current_build(self.id_data)
    if build:
        self["show_sources"] = False
        show_ghost(build, visible=value)


def _update_detail(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    build = _whole_build(self)
    if build:
        own_parts(state_of(build), point_objects(build))
        set_detail(state_of(build).parts, load_catalogue(), self.detail)


def _take_settings(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Let the panel have the settings of the build that it shows; limits are the user's, not a build's."""
    if self.build is not None:
        take_kept(self.settings, state_of(self.build).settings)


def _trajectories(self: bpy.types.PropertyGroup) -> bool:
    build = current_build(self.id_data)
    return bool(build) and trajectories_shown(build)


def _set_trajectories(self: bpy.types.PropertyGroup, value: bool) -> None:
    build = _whole_build(self)
    if build:
        show_trajectories(build, visible=value)


def _role_property(role: Role) -> Any:
    """Return the Blender property that shows or hides a role."""

    def is_shown(self: bpy.types.PropertyGroup) -> bool:
        """Return whether the current build shows the role."""
        build = current_build(self.id_data)
        return bool(build) and roles_shown(build).get(role, False)

    def show(self: bpy.types.PropertyGroup, visible: bool) -> None:
        """Show or hide the role in the current build."""
        build = _whole_build(self)
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
        update=_take_settings,
        name="Model",
        description="The brick model that these panels show",
    )
    top_layer: IntProperty(
        name="Top layer",
        description="Highest layer of bricks that is shown, in the viewport and in renders",
        min=1,
        get=_top_layer,
        set=_set_top_layer,
    )
    single_layer: BoolProperty(
        name="Only this layer",
        description="Show the top layer alone, without those below it",
        get=_single_layer,
        set=_set_single_layer,
    )
    show_sources: BoolProperty(
        name="Show original",
        description="Show the original objects, which building hides; removing the model shows them again",
        update=_update_sources,
    )
    ghost: BoolProperty(
        name="Original as ghost",
        description="Show the wires of the original objects over the bricks, in the viewport only",
        get=_ghost,
        set=_set_ghost,
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
        get=_section_axis,
        set=_set_section_axis,
    )
    section_at: FloatProperty(
        name="Cut at",
        description=(
            "Position of the cut, as a share of the model's extent; bricks are hidden if their centre lies beyond it"
        ),
        subtype="FACTOR",
        min=0.0,
        max=1.0,
        get=_section_at,
        set=_set_section_at,
    )
    section_flip: BoolProperty(
        name="Other side",
        description="Hide the bricks on the other side of the cut",
        get=_section_flip,
        set=_set_section_flip,
    )
    exploded: FloatProperty(
        name="Explode",
        description="Distance between the pieces, as a share of the model's height, in the viewport and in renders",
        subtype="FACTOR",
        min=0.0,
        max=1.0,
        get=_exploded,
        set=_set_exploded,
    )
    by_steps: BoolProperty(
        name="Building steps",
        description="Show the model after a number of building steps, with its supports; pieces that are not joined "
        "yet stand beside it",
        get=_by_steps,
        set=_set_by_steps,
    )
    step: IntProperty(
        name="Step",
        description="Number of building steps that are done, in the viewport and in renders",
        min=1,
        get=_step,
        set=_set_step,
    )
    highlight: BoolProperty(
        name="Highlight step",
        description="Show the bricks placed before the step in pale colours, and supports tinted",
        default=True,
        update=_update_highlight,
    )
    heat_map: BoolProperty(
        name="Heat map",
        description="Colour each brick by the friction that it has left, in the viewport and in renders: green much, "
        "yellow half, red none, black loaded beyond its friction, magenta hangs in the air",
        get=_heat_map,
        set=_set_heat_map,
    )
    lines: EnumProperty(
        name="Trajectories",
        description="Colours of the trajectories that are shown or written next",
        items=LINE_ITEMS,
    )
    trajectories: BoolProperty(
        name="Show trajectories",
        description="Show the trajectories of the layers that are shown, in the viewport and in renders",
        get=_trajectories,
        set=_set_trajectories,
    )
    detail: EnumProperty(
        name="Detail",
        description="How finely the parts are drawn; low keeps very large models fast",
        items=[
            ("low", "Low", "Plain boxes with eight-sided studs"),
            ("high", "High", "Bevelled edges, round studs, hollow from below"),
        ],
        default="high",
        update=_update_detail,
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
