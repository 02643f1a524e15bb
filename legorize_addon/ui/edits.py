"""Changes by hand: picked bricks are recoloured, locked, swapped, forbidden or deleted, and laid anew at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, Final

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, IntProperty, StringProperty
from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d
from mathutils import Vector

from ..core.edits import Edit, check_edit, edit_of
from ..core.errors import EditError
from ..core.model import Assembly, load_catalogue
from ..core.units import STUD
from ..scene import positions, read_bricks, state_of, world_from_mm
from ..view import Changed, brick_under, change, edits_of, outcomes_in, show_changed, touching, without
from .current import current_build
from .export import title_of
from .tab import redraw
from .weakest import look_at
from .working import OnBuild

if TYPE_CHECKING:
    from ..core.statics import Stability

TESTED: Final = 20_000
"""Bricks up to which a change is tested by forces at once; larger models are tested when their steps are planned."""

KINDS: Final = [
    ("recolour", "Recolour", "Give the cells of the bricks another colour, whatever bricks they are in"),
    ("lock", "Lock", "Lay the same bricks there again, whatever is built anew"),
    ("forbid", "Forbid", "Lay other parts there"),
    ("delete", "Delete", "Leave the cells empty"),
]


class LegorizeEdit(bpy.types.PropertyGroup):
    """A row of the list of changes; its name says what and where."""

    what: StringProperty()
    reason: StringProperty()
    kind: StringProperty()
    number: IntProperty()


class Editing(OnBuild):
    """What changes the bricks that are picked."""

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Change them."""
        return self.reported(self._change, context)

    def _change(self, context: bpy.types.Context) -> set[str]:
        build = current_build(context.scene)
        changed = change(build, self._edits(build, _picked(build)))
        shown = show_edits(context, build, changed)
        self.report({"INFO"}, told(shown, changed))
        for sentence in changed.refused:
            self.report({"WARNING"}, sentence)
        return {"FINISHED"}

    def _edits(self, build: bpy.types.Collection, rows: Sequence[int]) -> list[Edit]:
        raise NotImplementedError


def _picked(build: bpy.types.Collection) -> list[int]:
    """Return the bricks that are picked, at least one."""
    rows = state_of(build).picked
    if not rows:
        raise EditError("Nothing is picked: choose the tool Edit Bricks and click on a brick.")
    return rows


def told(build: bpy.types.Collection, changed: Changed) -> str:
    """Say what came of changes: how many there are, and whether the model stands."""
    check, count = state_of(build).check, len(changed.edits)
    more = f" ({changed.dropped} earlier replaced)" if changed.dropped else ""
    stands = check.get("sentence", "Not tested: plan the steps to know whether it stands")
    return f"{'1 change' if count == 1 else f'{count} changes'} by hand{more}. {stands}."


def show_edits(context: bpy.types.Context, build: bpy.types.Collection, changed: Changed) -> bpy.types.Collection:
    """Show a build after changes, with its lists."""
    from .parts import list_parts, lists_of

    scene = context.scene
    selected = [thing for thing in context.selected_objects if thing == state_of(build).root]
    shown = show_changed(
        scene, build, changed, name=title_of(build), detail=scene.legorize.detail, stability=_tested(build, changed)
    )
    scene.legorize.build = shown
    if selected:
        state_of(shown).root.select_set(True)
        context.view_layer.objects.active = state_of(shown).root
    list_parts(shown, lists_of(shown)[0].lots)
    list_edits(shown)
    redraw(context)
    return shown


def _tested(build: bpy.types.Collection, changed: Changed) -> Stability | None:
    """Test bricks by forces, as far as that is quick."""
    from ..core.statics import Effort, stability

    if len(changed.bricks) > TESTED:
        return None
    settings = state_of(build).settings
    clutch = float(settings.get("clutch", 0.7))
    return stability(Assembly(changed.bricks, load_catalogue()), clutch=clutch, effort=Effort(programme=0))


def list_edits(build: bpy.types.Collection) -> None:
    """Fill the list of changes of a build, with the reasons of those that do not fit."""
    build.legorize_edits.clear()
    for number, outcome in enumerate(outcomes_in(build)):
        row = build.legorize_edits.add()
        row.number = number
        row.name, row.what = outcome.edit.told(load_catalogue()), outcome.edit.what(load_catalogue())
        row.reason, row.kind = outcome.reason, outcome.edit.kind


class LEGORIZE_OT_pick(OnBuild, bpy.types.Operator):
    """Pick the brick under the mouse."""

    bl_idname = "legorize.pick"
    bl_label = "Pick Brick"
    bl_description = "Pick the brick under the mouse, to change it; with Shift, pick one more or one less"
    bl_options = {"UNDO", "INTERNAL"}

    extend: BoolProperty(options={"SKIP_SAVE"})
    menu: BoolProperty(options={"SKIP_SAVE"})
    row: IntProperty(default=-1, options={"SKIP_SAVE"})

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Pick what the mouse is on."""
        region, view = context.region, context.region_data
        if view is None:
            return {"CANCELLED"}
        at = (event.mouse_region_x, event.mouse_region_y)
        found = brick_under(context, region_2d_to_origin_3d(region, view, at), region_2d_to_vector_3d(region, view, at))
        if found is None:
            self.row = -1
        else:
            context.scene.legorize.build, self.row = found
        done = self.execute(context)
        if self.menu and state_of(current_build(context.scene)).picked:
            bpy.ops.wm.call_menu("INVOKE_DEFAULT", name="LEGORIZE_MT_edit")
        return done

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Pick the brick of a row, or nothing."""
        state = state_of(current_build(context.scene))
        before = set(state.picked)
        if self.menu and self.row in before:
            return {"FINISHED"}
        own = {self.row} - {-1}
        state.picked = sorted(before ^ own if self.extend else own)
        redraw(context)
        return {"FINISHED"}


class LEGORIZE_OT_edit(Editing, bpy.types.Operator):
    """Change the picked bricks."""

    bl_idname = "legorize.edit"
    bl_label = "Change Bricks"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(name="Kind", items=KINDS)
    code: IntProperty(name="Colour", description="LDraw code of the new colour", default=-1)

    @classmethod
    def description(cls, context: bpy.types.Context, properties: Any) -> str:
        """Return the tooltip of the kind, and the name of the colour."""
        text = next(text for kind, _, text in KINDS if kind == properties.kind)
        if properties.kind != "recolour" or properties.code < 0:
            return text
        catalogue = load_catalogue()
        return f"{text}: {catalogue.colours[catalogue.colour_row(properties.code)].name}"

    def _edits(self, build: bpy.types.Collection, rows: Sequence[int]) -> list[Edit]:
        bricks, colour = read_bricks(build), self.code if self.kind == "recolour" and self.code >= 0 else None
        made = [edit_of(self.kind, bricks, row, load_catalogue(), colour) for row in rows]
        for each in made:
            check_edit(each, load_catalogue())
        return made


@cache
def _listed() -> list[tuple[str, str, str]]:
    """Return the parts that can be laid by hand; kept, since Blender needs the texts to stay alive."""
    return [(part.number, part.title, "") for part in load_catalogue().parts if part.use in ("model", "tiles")]


def _part_items(self: Any, context: bpy.types.Context) -> list[tuple[str, str, str]]:
    return _listed()


class LEGORIZE_OT_edit_swap(Editing, bpy.types.Operator):
    """Lay another part by force in the place of the picked bricks."""

    bl_idname = "legorize.edit_swap"
    bl_label = "Swap Part"
    bl_description = "Lay a part by force where the picked brick lies, whatever lies around it; turn and move it below"
    bl_options = {"REGISTER", "UNDO"}
    bl_property = "part"

    part: EnumProperty(name="Part", items=_part_items)
    turn: IntProperty(name="Quarter Turns", min=0, max=3, options={"SKIP_SAVE"})
    along_x: IntProperty(name="Studs along X", min=-16, max=16, options={"SKIP_SAVE"})
    along_y: IntProperty(name="Studs along Y", min=-16, max=16, options={"SKIP_SAVE"})
    plates: IntProperty(name="Plates up", min=-9, max=9, options={"SKIP_SAVE"})

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Ask for the part."""
        context.window_manager.invoke_search_popup(self)
        return {"FINISHED"}

    def _edits(self, build: bpy.types.Collection, rows: Sequence[int]) -> list[Edit]:
        bricks, catalogue = read_bricks(build), load_catalogue()
        made = []
        for row in rows:
            brick = edit_of("force", bricks, row, catalogue)
            x, y, z = brick.cell
            cell = (x + self.along_x, y + self.along_y, z + self.plates)
            made.append(replace(brick, part=self.part, turn=(brick.turn + self.turn) % 4, cell=cell))
            check_edit(made[-1], catalogue)
        return made


class LEGORIZE_OT_edit_automatic(OnBuild, bpy.types.Operator):
    """Take back what was changed where the picked bricks lie."""

    bl_idname = "legorize.edit_automatic"
    bl_label = "Back to Automatic"
    bl_description = "Take back all changes by hand where the picked bricks lie"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Take them back."""
        return self.reported(self._take_back, context)

    def _take_back(self, context: bpy.types.Context) -> set[str]:
        build = current_build(context.scene)
        numbers = touching(build, _picked(build))
        if not numbers:
            raise EditError("Nothing was changed by hand there: pick a brick that was.")
        changed = without(build, numbers)
        self.report({"INFO"}, told(show_edits(context, build, changed), changed))
        return {"FINISHED"}


class LEGORIZE_OT_edit_remove(OnBuild, bpy.types.Operator):
    """Take back a change of the list, or all of them."""

    bl_idname = "legorize.edit_remove"
    bl_label = "Take Back"
    bl_description = "Take this change back: the bricks there are laid as they would be without it"
    bl_options = {"REGISTER", "UNDO"}

    number: IntProperty(name="Number", description="From 0; -1 for all of them", default=-1, min=-1)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Take it back."""
        return self.reported(self._take_back, context)

    def _take_back(self, context: bpy.types.Context) -> set[str]:
        build = current_build(context.scene)
        there = range(len(edits_of(build)))
        gone = list(there) if self.number < 0 else [self.number]
        if not gone or gone[-1] not in there:
            raise EditError(f"There is no change with the number {self.number}: there are {len(there)}.")
        changed = without(build, gone)
        self.report({"INFO"}, told(show_edits(context, build, changed), changed))
        return {"FINISHED"}


class LEGORIZE_OT_edit_frame(OnBuild, bpy.types.Operator):
    """Turn the view to a change, and pick the bricks there."""

    bl_idname = "legorize.edit_frame"
    bl_label = "Show Change"
    bl_description = "Turn the view to the place of this change, and pick the bricks that lie there"
    bl_options = {"REGISTER", "UNDO"}

    number: IntProperty(name="Number", description="From 0", min=0)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Show it."""
        return self.reported(self._frame, context)

    def _frame(self, context: bpy.types.Context) -> set[str]:
        build = current_build(context.scene)
        edits = edits_of(build)
        if self.number >= len(edits):
            raise EditError(f"There is no change with the number {self.number}: there are {len(edits)}.")
        edit, catalogue, bricks = edits.edits[self.number], load_catalogue(), read_bricks(build)
        cells = edit.cells(catalogue)
        state_of(build).picked = [
            row
            for row in range(len(bricks))
            if not cells.isdisjoint(edit_of("delete", bricks, row, catalogue).cells(catalogue))
        ]
        [place] = positions(edit.brick(catalogue), catalogue)
        look_at(context, world_from_mm(build) @ Vector(place), state_of(build).root.matrix_world.median_scale * STUD)
        redraw(context)
        return {"FINISHED"}


classes = (
    LegorizeEdit,
    LEGORIZE_OT_pick,
    LEGORIZE_OT_edit,
    LEGORIZE_OT_edit_swap,
    LEGORIZE_OT_edit_automatic,
    LEGORIZE_OT_edit_remove,
    LEGORIZE_OT_edit_frame,
)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register the classes, and hang the list on builds, which keep it in the file."""
    _register_classes()
    bpy.types.Collection.legorize_edits = CollectionProperty(type=LegorizeEdit)
    bpy.types.Collection.legorize_edit = IntProperty(name="Change", description="Chosen row of the list of changes")


def unregister() -> None:
    """Undo :func:`register`."""
    del bpy.types.Collection.legorize_edit
    del bpy.types.Collection.legorize_edits
    _unregister_classes()
