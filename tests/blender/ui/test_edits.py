"""Changes by hand in the scene: picked, made, kept over every way to build anew, taken back."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest

from legorize_addon.core.edits import edit_of, outcomes_of, read_edits
from legorize_addon.core.ldraw import read_ldraw
from legorize_addon.core.model import contact_graph
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.scene import colour_error_of, read_bricks, state_of
from legorize_addon.ui.current import current_build
from legorize_addon.ui.edit_tool import LEGORIZE_WT_edit
from legorize_addon.ui.edits import show_edits
from legorize_addon.view import change, edits_of, outcomes_in
from tests.blender.builders import add_table_on_one_leg
from tests.core.any_bricks import multiset
from tests.core.edits.models import random_edits

pytestmark = pytest.mark.usefixtures("addon")
CATALOGUE = load_catalogue()
BLUE = 1


@pytest.fixture
def build():
    """Return the build of a table on one leg."""
    add_table_on_one_leg()
    settings = bpy.context.scene.legorize.settings
    settings.width, settings.layout, settings.hanging = 12, "fast", 0
    bpy.ops.legorize.build()
    return now()


def now():
    """Return the build that is there now."""
    return current_build(bpy.context.scene)


def pick(*rows):
    """Pick bricks, as clicks with Shift do."""
    bpy.ops.legorize.pick(row=-1)
    for row in rows:
        bpy.ops.legorize.pick(row=row, extend=True)


def final(build):
    """Return the bricks of the finished model."""
    bricks = read_bricks(build)
    return bricks.take(bricks.role != Role.SUPPORT_OUTSIDE)


def test_clicks(build):
    """A click picks one brick, with Shift one more or less, beside the model none; a menu keeps what is picked."""
    for row, options, picked in [
        (3, {}, [3]),
        (5, {"extend": True}, [3, 5]),
        (3, {"extend": True}, [5]),
        (7, {"extend": True}, [5, 7]),
        (5, {"menu": True}, [5, 7]),
        (2, {"menu": True}, [2]),
        (-1, {}, []),
    ]:
        assert bpy.ops.legorize.pick(row=row, **options) == {"FINISHED"}
        assert state_of(build).picked == picked


def test_nothing_is_picked(build):
    """One sentence says what to do, and nothing changes."""
    before = multiset(read_bricks(build))
    for attempt in (lambda: bpy.ops.legorize.edit(kind="lock"), bpy.ops.legorize.edit_automatic):
        with pytest.raises(RuntimeError, match="Nothing is picked"):
            attempt()
    assert multiset(read_bricks(now())) == before


def test_models_with_half_studs_are_left_alone(build, monkeypatch):
    """One sentence says why, and nothing changes."""
    bricks = read_bricks(build)
    apart = replace(bricks, half=np.ones((len(bricks), 2), np.uint8))
    monkeypatch.setattr("legorize_addon.view.edited.read_bricks", lambda build: apart)
    pick(3)
    with pytest.raises(RuntimeError, match="has half studs"):
        bpy.ops.legorize.edit(kind="lock")
    monkeypatch.undo()
    assert multiset(read_bricks(now())) == multiset(bricks)


def test_recoloured_and_taken_back(build):
    """The bricks have the colour at once, the model is tested, and taken back it is as it was."""
    bpy.context.scene.legorize.top_layer = 3
    before, place = multiset(final(build), steps=False), state_of(build).root.matrix_world.copy()
    pick(3, 4)
    assert bpy.ops.legorize.edit(kind="recolour", code=BLUE) == {"FINISHED"}
    edited = now()
    assert (final(edited).colour == BLUE).sum() == 2
    assert [row.reason for row in edited.legorize_edits] == ["", ""]
    assert "Stands by its studs" in state_of(edited).check["sentence"]
    assert state_of(edited).root.matrix_world == place
    assert state_of(edited).top_layer == 3
    assert state_of(edited).settings["width"] == 12
    assert sum(lot.count for lot in edited.legorize_lots) == len(final(edited))
    # supports of another model are none of this one
    assert len(final(edited)) == len(read_bricks(edited))
    bpy.ops.legorize.edit_frame(number=1)
    assert state_of(now()).picked == [4]
    bpy.ops.legorize.edit_automatic()
    assert len(edits_of(now())) == 1
    bpy.ops.legorize.edit_remove(number=0)
    assert multiset(final(now()), steps=False) == before
    assert not len(now().legorize_edits)


def test_each_kind(build):
    """Locked, laid by force, forbidden and deleted: each is in the bricks, which still hang together."""
    locked = edit_of("lock", read_bricks(build), 3, CATALOGUE)
    pick(3)
    bpy.ops.legorize.edit(kind="lock")
    for kind, attempt in (
        ("force", lambda: bpy.ops.legorize.edit_swap(part="3005")),
        ("forbid", lambda: bpy.ops.legorize.edit(kind="forbid")),
        ("delete", lambda: bpy.ops.legorize.edit(kind="delete")),
    ):
        bricks = final(now())
        taken = {cell for each in edits_of(now()).edits for cell in each.cells(CATALOGUE)}
        free = [
            row
            for row in range(len(bricks))
            if taken.isdisjoint(edit_of("lock", bricks, row, CATALOGUE).cells(CATALOGUE))
            and (kind == "force") <= (CATALOGUE.height[bricks.part[row]] == 3)
        ]
        # the highest brick holds nothing
        pick(free[-1])
        assert attempt() == {"FINISHED"}
    assert [each.kind for each in edits_of(now()).edits] == ["lock", "force", "forbid", "delete"]
    assert not [each.reason for each in outcomes_in(now()) if each.reason]
    assert len(locked.rows_of(final(now()), CATALOGUE)) == 1
    assert contact_graph(final(now()), CATALOGUE).n_components == 1


def test_what_cannot_be_done_changes_nothing(build):
    """A part in a place without hold is refused in one sentence."""
    before = multiset(read_bricks(build))
    pick(3)
    with pytest.raises(RuntimeError, match=r"Not done: Lay Brick 1 x 1 .* because it would stand out of the grid"):
        bpy.ops.legorize.edit_swap(part="3005", along_x=16)
    assert multiset(read_bricks(now())) == before
    assert not state_of(now()).edits[0]


def test_a_hundred_survive(build, tmp_path):
    """Built anew, with another seed too, each is in the bricks and the exported file, or told in the list."""
    show_edits(bpy.context, build, change(build, random_edits(final(build), 100, 1)))
    edits = list(edits_of(now()).edits)
    assert len(edits) > 30
    for seed in (0, 3):
        bpy.context.scene.legorize.settings.seed = seed
        bpy.ops.legorize.build()
        assert list(edits_of(now()).edits) == edits
        rows = now().legorize_edits
        assert len(rows) == len(edits)
        target = tmp_path / f"{seed}.ldr"
        bpy.ops.legorize.export_ldr(filepath=str(target))
        written = read_ldraw(target.read_text(encoding="utf-8"), CATALOGUE).bricks
        for bricks in (final(now()), written):
            reasons = [each.reason for each in outcomes_of(bricks, CATALOGUE, edits, {})]
            assert [bool(each) for each in reasons] == [bool(row.reason) for row in rows]
        assert sum(not row.reason for row in rows) > 0.6 * len(edits)


def test_steps_are_planned_anew(build):
    """The bricks as they are get their steps, and the changes stay with them."""
    pick(3)
    bpy.ops.legorize.edit(kind="recolour", code=BLUE)
    assert not state_of(now()).steps
    before, errors = multiset(final(now()), steps=False), colour_error_of(now())
    bpy.ops.object.select_all(action="DESELECT")
    assert bpy.ops.legorize.plan_steps() == {"FINISHED"}
    assert state_of(now()).steps
    assert bpy.context.selected_objects == [state_of(now()).root]
    # the surface that colours are compared with stays with the model, which has the worst brick by hand
    assert colour_error_of(now()) == errors
    assert errors["name"].startswith("Blue")
    assert multiset(final(now()), steps=False) == before
    assert [row.reason for row in now().legorize_edits] == [""]
    bpy.ops.legorize.edit_remove(number=-1)
    assert not (final(now()).colour == BLUE).any()


def test_in_another_size(build):
    """The list keeps them and says why they do not fit; in the first size they are made again."""
    pick(3)
    bpy.ops.legorize.edit(kind="recolour", code=BLUE)
    edits, settings = state_of(now()).edits[0], bpy.context.scene.legorize.settings
    settings.width = 14
    bpy.ops.legorize.build()
    assert "another size" in now().legorize_edits[0].reason
    pick(3)
    with pytest.raises(RuntimeError, match="kept for another size"):
        bpy.ops.legorize.edit(kind="lock")
    settings.width = 12
    bpy.ops.legorize.build()
    assert now().legorize_edits[0].reason == ""
    assert read_edits(state_of(now()).edits[0], CATALOGUE).edits == read_edits(edits, CATALOGUE).edits


def test_a_later_change_takes_the_place_of_an_earlier_one(build):
    """Recoloured twice, a brick has one change in the list."""
    for code in (BLUE, 4):
        pick(3)
        bpy.ops.legorize.edit(kind="recolour", code=code)
    assert [each.colour for each in edits_of(now()).edits] == [4]


def test_numbers_that_are_not_there(build):
    """A change that the list does not have cannot be shown or taken back."""
    for attempt in (bpy.ops.legorize.edit_frame, bpy.ops.legorize.edit_remove):
        with pytest.raises(RuntimeError, match="no change with the number 5"):
            attempt(number=5)


def test_the_tool_is_there():
    """It is registered in Object Mode, and its clicks call what it should."""
    from bl_ui.space_toolsystem_toolbar import VIEW3D_PT_tools_active

    # groups of tools are lists of them, and so is each of them of its fields
    listed = [
        item if hasattr(item, "idname") else next(iter(item or ()), None)
        for item in VIEW3D_PT_tools_active._tools["OBJECT"]
    ]
    tools = [tool.idname for tool in listed if hasattr(tool, "idname")]
    assert LEGORIZE_WT_edit.bl_idname in tools
    assert {name for name, *_ in LEGORIZE_WT_edit.bl_keymap} == {"legorize.pick"}


def test_a_saved_file_keeps_them(build, tmp_path):
    """Changes, what the model would be without them, and the list are in the .blend."""
    before = multiset(final(build), steps=False)
    pick(3)
    bpy.ops.legorize.edit(kind="recolour", code=BLUE)
    path = str(tmp_path / "edited.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert len(now().legorize_edits) == len(edits_of(now())) == 1
    bpy.ops.legorize.edit_remove(number=0)
    assert multiset(final(now()), steps=False) == before


def test_undo(build):
    """One step back, a change was never made."""
    bpy.ops.ed.undo_push(message="built")
    before = multiset(final(build), steps=False)
    pick(3)
    bpy.ops.legorize.edit(kind="recolour", code=BLUE)
    bpy.ops.ed.undo_push(message="edited")
    bpy.ops.ed.undo()
    assert multiset(final(now()), steps=False) == before
    assert not state_of(now()).edits[0]
