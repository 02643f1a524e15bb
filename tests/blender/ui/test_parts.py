"""The table of parts and the lists of the panel."""

from __future__ import annotations

import csv
import json
from collections import Counter
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.progress import silent
from legorize_addon.core.report.outputs import output_texts
from legorize_addon.core.shopping.formats import FORMATS
from legorize_addon.scene.builds import point_objects
from legorize_addon.scene.collections import read_bricks
from legorize_addon.scene.instancing import GHOST_KEY
from legorize_addon.scene.state import BUILD_KEY, state_of
from legorize_addon.ui.current import current_build
from legorize_addon.ui.export import Exporting, proposed_path
from legorize_addon.ui.parts import places
from legorize_addon.ui.requests import build_request, chosen_sources
from legorize_addon.ui.settings_properties import settings_of
from legorize_addon.view.lots import shown_lot
from tests.blender.builders import add_table_on_one_leg
from tests.core.foreign import nested_document, unknown_parts

pytestmark = pytest.mark.usefixtures("addon")
NAMED = {"export_ldr": ".ldr", "export_mpd": ".mpd", "render_still": ".png", "export_list": ".csv"}


@pytest.fixture
def build():
    """Return the build of a table on one leg, with supports that are taken out."""
    add_table_on_one_leg()
    settings = bpy.context.scene.legorize.settings
    settings.width, settings.layout, settings.hanging = 12, "fast", 0
    bpy.ops.legorize.build()
    return current_build(bpy.context.scene)


def lots(bricks):
    """Return how many bricks of each (part number, colour code) there are."""
    parts = load_catalogue().parts
    return Counter((parts[part].number, int(code)) for part, code in zip(bricks.part, bricks.colour, strict=True))


def test_table_is_the_model(build):
    """Lot by lot the rows are the bricks of the finished model, in every order; refreshed they are the same."""
    bricks = read_bricks(build)
    wanted = lots(bricks.take(bricks.role != Role.SUPPORT_OUTSIDE))
    for _ in range(2):
        assert {(row.number, row.code): row.count for row in build.legorize_lots} == wanted
        build.legorize_lots[0].count = 99
        assert bpy.ops.legorize.list_parts() == {"FINISHED"}


@pytest.mark.parametrize(("order", "ranked"), [("part", "abc"), ("colour", "cab"), ("count", "bca"), ("price", "acb")])
def test_rows_are_sorted(order, ranked):
    """By name, by colour, most bricks first, dearest lot first and those without a price last."""
    rows = [
        SimpleNamespace(name="a", code=4, colour_name="Red", count=1, price=9.0),
        SimpleNamespace(name="b", code=15, colour_name="White", count=8, price=-1.0),
        SimpleNamespace(name="c", code=0, colour_name="Black", count=2, price=0.1),
    ]
    found = places(rows, order)
    assert "".join(rows[found.index(place)].name for place in range(3)) == ranked


def test_click_selects_exactly_the_bricks(build):
    """The points of the lot are selected, and no others; all other parts are glass, until all are shown again."""
    row = max(build.legorize_lots, key=lambda each: each.count)
    before = {variant.name: variant.material_slots[0].material for variant in state_of(build).parts.objects}
    bpy.context.scene.legorize.heat_map = True
    build.legorize_lot = list(build.legorize_lots).index(row)
    assert not bpy.context.scene.legorize.heat_map
    assert shown_lot(build) == (row.number, row.code)
    chosen = []
    for points in point_objects(build):
        picked = np.empty(len(points.data.vertices), bool)
        points.data.vertices.foreach_get("select", picked)
        part, colour = (np.empty(len(picked), np.int32) for _ in range(2))
        for name, values in (("part", part), ("colour", colour)):
            points.data.attributes[name].data.foreach_get("value", values)
        numbers = np.array(state_of(build).part_numbers)[part]
        np.testing.assert_array_equal(picked, (numbers == row.number) & (colour == row.code))
        chosen.append(picked.sum())
    assert sum(chosen) >= row.count > 0
    glass = [variant for variant in state_of(build).parts.objects if GHOST_KEY in variant.material_slots[0].material]
    assert len(glass) == len(before) - 1
    assert bpy.ops.legorize.show_all_lots() == {"FINISHED"}
    assert {variant.name: variant.material_slots[0].material for variant in state_of(build).parts.objects} == before
    assert shown_lot(build) is None
    assert not bpy.ops.legorize.show_all_lots.poll()


def test_files_are_named_like_the_model(build, tmp_path):
    """Whatever is exported: the file browser proposes the model's name, beside the scene's own file."""
    asked = []
    manager = SimpleNamespace(fileselect_add=lambda operator: asked.append(operator.filepath))
    context = SimpleNamespace(scene=bpy.context.scene, window_manager=manager)
    made = [each for each in Exporting.__subclasses__() if issubclass(each, bpy.types.Operator)]
    assert {each.bl_idname for each in made} == {f"legorize.{name}" for name in NAMED}
    for each in made:
        suffix = getattr(each, "filename_ext", ".csv")
        operator = SimpleNamespace(filename_ext=suffix if isinstance(suffix, str) else ".csv", filepath="old.txt")
        assert Exporting.invoke(operator, context, None) == {"RUNNING_MODAL"}
    name = build.name.removeprefix("Legorize ")
    assert asked == [f"{name}{suffix}" for suffix in NAMED.values()]
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    assert proposed_path(name, ".ldr") == str(tmp_path / f"{name}.ldr")
    # a slash is no folder, and what Windows refuses is not proposed; names of all languages are
    assert proposed_path('Maus/Katze: "Mäuse" 2.5', ".ldr") == str(tmp_path / "Maus_Katze_ _Mäuse_ 2.5.ldr")


def test_every_list_is_exported(build, tmp_path):
    """Each format is written as the folder has it; supports have lists of their own; all sums are the model's."""
    assert bpy.ops.legorize.export_folder(filepath=str(tmp_path / "all")) == {"FINISHED"}
    names = {kind.file for kind in FORMATS}
    there = {path.relative_to(tmp_path / "all").as_posix() for path in (tmp_path / "all").rglob("*") if path.is_file()}
    rest = {"model.ldr", "model.mpd", "build_order.csv", "report.json", "instructions.html", "instructions.pdf"}
    tables = {f"tables/table_{number}.csv" for number in range(1, 5)}
    maps = {name for name in there if name.startswith("layers/")}
    assert there - maps == rest | tables | names | {f"support-{name}" for name in names}
    facts = json.loads((tmp_path / "all" / "report.json").read_text())
    assert set(facts["files"]) == there - {"report.json"}
    assert facts["counts"]["bricks"] == state_of(build).summary["bricks"]
    assert len(maps) >= facts["grid"]["layers"]
    for kind in FORMATS:
        for prefix, supports in (("", False), ("support-", True)):
            path = tmp_path / f"{prefix}{kind.file}"
            assert bpy.ops.legorize.export_list(filepath=str(path), kind=kind.key, of_supports=supports) == {"FINISHED"}
            assert path.read_bytes() == (tmp_path / "all" / path.name).read_bytes()
    model = read_ldraw((tmp_path / "all" / "model.ldr").read_text(), load_catalogue()).bricks
    with (tmp_path / "parts.csv").open(newline="", encoding="utf-8") as file:
        assert {(row["part"], int(row["colour"])): int(row["count"]) for row in csv.DictReader(file)} == lots(model)


def test_folder_is_that_of_the_command_line(build, tmp_path):
    """What the panel writes of a model, the core writes of the same build, but for times in the report."""
    assert bpy.ops.legorize.export_folder(filepath=str(tmp_path / "all"), booklet=False, maps=False) == {"FINISHED"}
    context = bpy.context
    order = build_request(context, chosen_sources(context), settings_of(context.scene.legorize.settings))
    made = order.work(silent)
    facts = json.loads(made.texts["report.json"])
    files = output_texts(made, load_catalogue(), facts, order.name)
    there = {path.relative_to(tmp_path / "all").as_posix() for path in (tmp_path / "all").rglob("*") if path.is_file()}
    assert there == set(files)
    for name in there - {"report.json", "tables/table_3.csv"}:
        assert (tmp_path / "all" / name).read_bytes().decode() == files[name], name
    written = json.loads((tmp_path / "all" / "report.json").read_text())
    for each in (written, facts):
        each.pop("timings_s")
        each.pop("files", None)
    assert written == facts


def test_model_without_its_report_is_written_all_the_same(build, tmp_path):
    """A file of an earlier version kept no report: the rest is written, with a remark."""
    del build[BUILD_KEY]["texts"]
    assert bpy.ops.legorize.export_folder(filepath=str(tmp_path / "all"), booklet=False, maps=False) == {"FINISHED"}
    assert not (tmp_path / "all" / "report.json").exists()
    assert (tmp_path / "all" / "model.mpd").exists()


def test_list_of_nothing_is_refused(tmp_path):
    """A model without supports has no list of them: one sentence, and no file."""
    (tmp_path / "m.ldr").write_text(unknown_parts())
    bpy.ops.legorize.open_ldraw(filepath=str(tmp_path / "m.ldr"))
    with pytest.raises(RuntimeError, match="There are no temporary supports"):
        bpy.ops.legorize.export_list(filepath=str(tmp_path / "s.csv"), kind="plain", of_supports=True)
    assert not (tmp_path / "s.csv").exists()


def test_opened_model_has_all_that_ours_have(tmp_path):
    """A document of somebody else: bricks, verdict, heat map, steps, table, remarks; written again it is the same."""
    (tmp_path / "tower.mpd").write_text(nested_document(), newline="")
    assert bpy.ops.legorize.open_ldraw(filepath=str(tmp_path / "tower.mpd")) == {"FINISHED"}
    build = current_build(bpy.context.scene)
    bricks = read_bricks(build)
    assert build.name == "Legorize tower"
    assert len(bricks) == 64
    assert state_of(build).check["verdict"] == "stable"
    assert state_of(build).building["steps"] == 16
    assert "16 parts are mirrored" in state_of(build).notes[0]
    assert sum(row.count for row in build.legorize_lots) == 64
    bpy.context.scene.legorize.heat_map = True
    bpy.context.scene.legorize.by_steps = True
    assert bpy.ops.legorize.export_ldr(filepath=str(tmp_path / "again.ldr")) == {"FINISHED"}
    found = read_ldraw((tmp_path / "again.ldr").read_text(), load_catalogue()).bricks
    assert sorted(found.corner.tolist()) == sorted(bricks.corner.tolist())
    # a stud is 8 cm wide in the scene
    assert state_of(build).unit_per_mm == pytest.approx(0.01)


def test_laid_again_takes_the_place(tmp_path):
    """The model has fewer bricks in the same place, instead of the earlier one; an own model keeps its source."""
    (tmp_path / "tower.mpd").write_text(nested_document(), newline="")
    bpy.ops.legorize.open_ldraw(filepath=str(tmp_path / "tower.mpd"))
    extent = state_of(current_build(bpy.context.scene)).extent
    assert bpy.ops.legorize.again() == {"FINISHED"}
    build = current_build(bpy.context.scene)
    assert len(read_bricks(build)) < 20
    assert state_of(build).extent == extent
    assert len([each for each in bpy.data.collections if each.name.startswith("Legorize tower")]) == 1
    assert state_of(build).notes[0].startswith("Laid again in ")


def test_own_model_laid_again_keeps_its_place(build):
    """Sources, origin and scale stay; there are no more bricks than before."""
    state, bricks = state_of(build), read_bricks(build)
    before = (state.origin, state.unit_per_mm, [entry.source for entry in state.sources])
    count = (bricks.role != Role.SUPPORT_OUTSIDE).sum()
    assert bpy.ops.legorize.again() == {"FINISHED"}
    after = state_of(current_build(bpy.context.scene))
    assert (after.origin, pytest.approx(after.unit_per_mm), [entry.source for entry in after.sources]) == before
    assert after.summary["bricks"] <= count


@pytest.mark.parametrize(("name", "message"), [("m.txt", "is no LDraw file"), ("m.ldr", "no brick that can be read")])
def test_wrong_files_are_refused(name, message, tmp_path):
    """One sentence, and the scene is as it was."""
    (tmp_path / name).write_text("0 nothing\n")
    before = len(bpy.data.objects)
    with pytest.raises(RuntimeError, match=message):
        bpy.ops.legorize.open_ldraw(filepath=str(tmp_path / name))
    assert len(bpy.data.objects) == before
