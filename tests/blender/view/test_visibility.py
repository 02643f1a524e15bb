"""Layers, roles and sections show parts of a build in the viewport and in renders, and change no brick."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import CELL_SIZE
from legorize_addon.scene.brick_points import box_corners, middles
from legorize_addon.scene.brick_tree import HIDDEN_ROLES, brick_tree
from legorize_addon.scene.builds import ROLE_KEY, builds, layers_of, point_objects
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.instancing import bricks_modifier, change_tree
from legorize_addon.scene.section import AXES, Section
from legorize_addon.scene.state import BUILD_KEY
from legorize_addon.view.visibility import cut_away, roles_shown, section_of, show_layers, show_role, shown_bricks
from scripts import benchmark
from tests.blender.bricks import assert_same, content, instances, random_table, show, table

CATALOGUE = load_catalogue()
ONE = CATALOGUE.part_row("3005")
ALL_ROLES = [(ONE, int(role), 0, 3 * layer, 0, 4, role) for layer in range(3) for role in Role]


def tower(n: int) -> Bricks:
    """Return a tower of n small bricks."""
    return table([(ONE, 0, 0, 3 * layer, 0, 4) for layer in range(n)])


def places() -> list[list[float]]:
    """Return where the viewport shows bricks, in order; Blender evaluates also what the outliner's eye hides."""
    found = bpy.context.evaluated_depsgraph_get().object_instances
    shown = [
        np.array(entry.matrix_world, dtype=np.float64)[:3, 3]
        for entry in found
        if entry.is_instance and entry.parent.original.visible_get()
    ]
    return sorted(np.round(place, 2).tolist() for place in shown)


def feet(bricks: Bricks) -> list[list[float]]:
    """Return the middles of the bricks' lower faces, in order."""
    low = middles(bricks, CATALOGUE)
    low[:, 2] = bricks.corner[:, 2] * CELL_SIZE[2]
    return sorted(np.round(low, 2).tolist())


@pytest.mark.parametrize("top", [1, 2, 4, 9])
def test_upper_layers_are_hidden(top: int) -> None:
    """Just the layers below the top one are shown, by the eye and in renders; the bricks stay."""
    bricks = tower(4)
    build = show(bricks)
    show_layers(bpy.context.scene, build, top)
    hidden = [index >= top for index in range(4)]
    assert [layer.hide_render for layer in layers_of(build)] == hidden
    entry = bpy.context.view_layer.layer_collection.children[build.name]
    assert [child.hide_viewport for child in entry.children] == hidden
    assert [points.visible_get() for points in point_objects(build)] == [not hide for hide in hidden]
    assert_same(read_bricks(build), bricks)
    assert len(shown_bricks(build)) == min(top, 4)
    show_layers(bpy.context.scene, build, 4)
    assert not any(layer.hide_render for layer in layers_of(build))


def test_other_collections_are_left_alone() -> None:
    """A collection that the user put into a build keeps its flags."""
    build = show(tower(3))
    mine = bpy.data.collections.new("mine")
    mine.hide_render = True
    build.children.link(mine)
    show_layers(bpy.context.scene, build, 1)
    show_layers(bpy.context.scene, build, 3)
    assert mine.hide_render


@pytest.mark.parametrize("role", list(Role))
def test_a_role_is_hidden_in_all_layers(role: Role) -> None:
    """Hiding a role hides its bricks alone, in all layers, in the viewport and in renders; showing is the inverse."""
    bricks = table(ALL_ROLES)
    build = show(bricks)
    assert roles_shown(build) == dict.fromkeys(Role, True)
    for _ in range(2):
        show_role(build, role, visible=False)
        assert places() == feet(bricks.take(bricks.role != role))
        assert_same(shown_bricks(build), bricks.take(bricks.role != role))
    assert_same(read_bricks(build), bricks)
    assert [other for other, shown in roles_shown(build).items() if not shown] == [role]
    show_role(build, role, visible=True)
    assert places() == feet(bricks)
    assert_same(shown_bricks(build), bricks)


def test_supports_are_hidden_as_objects() -> None:
    """View All does not frame what is hidden; an object that shows nothing would make it zoom out."""
    build = show(table(ALL_ROLES))
    show_role(build, Role.SUPPORT_OUTSIDE, visible=False)
    hidden = [points for points in point_objects(build) if points.hide_viewport]
    assert hidden
    assert all(points[ROLE_KEY] == Role.SUPPORT_OUTSIDE for points in hidden)


def test_only_roles_that_occur_are_offered() -> None:
    """A build knows which roles it has."""
    build = show(table([(ONE, 0, 0, 0, 0, 4), (ONE, 0, 0, 3, 0, 4, Role.OFFSET)]))
    assert list(roles_shown(build)) == [Role.SHELL, Role.OFFSET]


def test_roles_and_layers_do_not_meddle() -> None:
    """The layer slider shows no hidden role, and a role that comes back shows no hidden layer."""
    bricks = table(ALL_ROLES)
    build = show(bricks)
    show_role(build, Role.PLATE, visible=False)
    show_layers(bpy.context.scene, build, 1)
    show_layers(bpy.context.scene, build, 2)
    lower = bricks.corner[:, 2] < 6
    assert places() == feet(bricks.take(lower & (bricks.role != Role.PLATE)))
    assert_same(shown_bricks(build), bricks.take(lower & (bricks.role != Role.PLATE)))
    show_role(build, Role.PLATE, visible=True)
    assert places() == feet(bricks.take(lower))


def as_before(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Give objects of one role each the form that they had before trees knew of roles."""
    tree = brick_tree().copy()
    tree.interface.remove(next(socket for socket in tree.interface.items_tree if socket.name == HIDDEN_ROLES))
    for points in point_objects(build):
        change_tree(bricks_modifier(points), tree)
        points["legorize_role"] = points.data.attributes["role"].data[0].value
    return point_objects(build)


@pytest.mark.parametrize("odd", ["edited", "emptied", "without roles"])
def test_roles_of_points_that_cannot_be_read(odd: str) -> None:
    """Points in Edit Mode, or changed by hand, stop no role from being hidden; all others are."""
    build = show(table(ALL_ROLES))
    before = places()
    points = point_objects(build)[0]
    if odd == "edited":
        bpy.context.view_layer.objects.active = points
        bpy.ops.object.mode_set(mode="EDIT")
    elif odd == "emptied":
        points.data.clear_geometry()
    else:
        points.data.attributes.remove(points.data.attributes["role"])
    try:
        show_role(build, Role.PLATE, visible=False)
    finally:
        if odd == "edited":
            bpy.ops.object.mode_set(mode="OBJECT")
    assert not roles_shown(build)[Role.PLATE]
    bpy.context.view_layer.update()
    plates = [place for place in before if place[0] == feet(table([ALL_ROLES[list(Role).index(Role.PLATE)]]))[0][0]]
    rest = [place for place in places() if place in plates]
    # without their roles, the first three are taken for those of the first role
    assert len(rest) == (1 if odd == "without roles" else 0)


def test_roles_keep_what_the_user_hid() -> None:
    """An object that the user hid is hidden after its role was switched off and on; the eye is not touched at all."""
    for change in (point_objects, as_before):
        for each in builds(bpy.context.scene):
            clear_build(bpy.context.scene, each)
        build = show(table([(ONE, 0, 0, 3 * layer, 0, 4) for layer in range(4)]))
        first, second, third, _ = change(build)
        first.hide_viewport, second.hide_render = True, True
        third.hide_set(True)
        for visible in (False, True):
            show_role(build, Role.SHELL, visible=visible)
            assert third.hide_get()
        flags = [(points.hide_viewport, points.hide_render) for points in (first, second, third)]
        assert flags == [(True, False), (False, True), (False, False)]
        assert len(shown_bricks(build)) == 3


def test_roles_of_earlier_versions() -> None:
    """Each of their objects has a role of its own, and is hidden itself; also if the tree has changed since."""
    bricks = table([(ONE, 0, 0, 3 * layer, 0, 4, Role.PLATE if layer else Role.SHELL) for layer in range(3)])
    build = show(bricks)
    found = as_before(build)
    for changed in (False, True):
        show_role(build, Role.PLATE, visible=False)
        assert [points.hide_render for points in found] == [False, True, True]
        assert len(shown_bricks(build)) == len(places()) == 1
        for points in found if changed else ():
            change_tree(bricks_modifier(points), brick_tree())
        show_role(build, Role.PLATE, visible=True)
        assert not any(points.hide_render for points in found)
        assert len(shown_bricks(build)) == len(places()) == 3


def test_hidden_roles_and_steps_show_what_both_do() -> None:
    """Roles stay hidden whatever else is shown, and all of them at once leave nothing to export."""
    bricks = table(ALL_ROLES)
    build = show(bricks)
    hidden = (Role.SHELL, Role.OFFSET, Role.SUPPORT_KEPT)
    for role in hidden:
        show_role(build, role, visible=False)
    left = bricks.take(~np.isin(bricks.role, hidden))
    assert places() == feet(left)
    cut_away(build, Section("z", 0.5))
    lower = left.take(expected(left, Section("z", 0.5)))
    assert places() == feet(lower)
    assert_same(shown_bricks(build), lower)
    for role in Role:
        show_role(build, role, visible=False)
    with pytest.raises(BuildError, match="no bricks to show"):
        shown_bricks(build)


def expected(bricks: Bricks, section: Section) -> np.ndarray:
    """Return which bricks a section shows, from the shares of their middles along the axis."""
    along = AXES.index(section.axis)
    corners = box_corners(bricks, CATALOGUE)[:, along]
    middle = middles(bricks, CATALOGUE)[:, along]
    plane = corners.min() + section.at * np.ptp(corners)
    return middle >= plane - 1e-6 if section.flip else middle <= plane + 1e-6


@pytest.mark.parametrize("flip", [False, True])
@pytest.mark.parametrize("axis", AXES)
def test_section_hides_what_lies_beyond(axis: str, flip: bool) -> None:
    """Shown are the bricks whose middle has at most the share, in the viewport as in the table; the data stay."""
    bricks = random_table(400)
    build = show(bricks, origin=(-70.0, 33.3, 5.1), scale=0.37, mm_per_unit=1000.0)
    unit = 0.37 * 1000.0
    for at in (0.0, 0.123, 0.5, 0.75, 1.0):
        section = Section(axis, at, flip)
        cut_away(build, section)
        assert section_of(build) == section
        shown = bricks.take(expected(bricks, section))
        seen = sorted(np.round(matrix[:3, 3] * unit - (-70.0, 33.3, 5.1), 1).tolist() for _, _, matrix in instances())
        np.testing.assert_allclose(seen, np.round(feet(shown), 1).reshape(-1, 3).tolist() or seen[:0], atol=0.15)
        if len(shown):
            assert_same(shown_bricks(build), shown)
    assert_same(read_bricks(build), bricks)
    cut_away(build, Section())
    assert len(instances()) == len(shown_bricks(build)) == 400


@pytest.mark.parametrize("axis", AXES)
def test_two_sides_add_up(axis: str) -> None:
    """What a cut shows and what the flipped cut shows are together all bricks; only those on the plane are in both."""
    bricks = random_table(300, seed=3)
    build = show(bricks)
    for at in (0.25, 0.5, 0.6):
        counts = []
        for flip in (False, True):
            cut_away(build, Section(axis, at, flip))
            counts.append(len(instances()))
            assert counts[-1] == len(shown_bricks(build))
        both = expected(bricks, Section(axis, at)) & expected(bricks, Section(axis, at, flip=True))
        assert sum(counts) == len(bricks) + both.sum()
        assert min(counts) > 0


@pytest.mark.parametrize(("axis", "step"), [("x", 8.0), ("y", 8.0), ("z", 9.6)])
def test_bricks_on_the_plane_are_shown(axis: str, step: float) -> None:
    """Of nine bricks in a row the one in the middle is shown from both sides of a cut through it."""
    along = AXES.index(axis)
    build = show(table([(ONE, *np.insert([0, 0], along, i * (3 if axis == "z" else 1)), 0, 4) for i in range(9)]))
    for flip, kept in [(False, range(5)), (True, range(4, 9))]:
        cut_away(build, Section(axis, 0.5, flip))
        start = 0.0 if axis == "z" else step / 2
        np.testing.assert_allclose([place[along] for place in places()], [start + step * i for i in kept], atol=0.01)


def test_level_cut_goes_by_the_middle_of_the_height() -> None:
    """A tall brick whose foot lies below a level cut and whose middle above is hidden; a plate beside it is not."""
    tall, plate = CATALOGUE.part_row("14716"), CATALOGUE.part_row("3024")
    build = show(table([(tall, 0, 0, 0, 0, 4), (plate, 1, 0, 0, 0, 4)]))
    cut_away(build, Section("z", 0.4))
    assert [mesh["legorize_mesh"] for mesh, _, _ in instances()] == ["3024 high"]


def test_section_goes_with_layers_and_roles() -> None:
    """Shown is what layers, roles and the cut all show."""
    bricks = table(ALL_ROLES)
    build = show(bricks)
    show_layers(bpy.context.scene, build, 2)
    show_role(build, Role.INSIDE, visible=False)
    cut_away(build, Section("x", 0.5))
    kept = (bricks.corner[:, 2] < 6) & (bricks.role != Role.INSIDE) & (2 * bricks.corner[:, 0] < len(Role))
    assert places() == feet(bricks.take(kept))
    assert_same(shown_bricks(build), bricks.take(kept))


def test_cut_goes_with_the_model() -> None:
    """A model that was moved and turned after the cut is still cut at the same bricks."""
    build = show(table([(ONE, x, 0, 0, 0, 4) for x in range(10)]))
    cut_away(build, Section("x", 0.3))
    build[BUILD_KEY]["root"].matrix_world = Matrix.Translation((500, -20, 7)) @ Matrix.Rotation(2.0, 4, "Z")
    assert len(instances()) == 3


def test_plane_may_be_moved_by_hand() -> None:
    """The table of what is shown follows the plane itself, which may stand askew."""
    build = show(table([(ONE, x, y, 0, 0, 4) for x in range(6) for y in range(6)]))
    cut_away(build, Section("x", 0.5))
    plane = build[BUILD_KEY]["plane"]
    plane.location, plane.rotation_euler = (24.0, 24.0, 0.0), (0.0, np.pi / 2, np.pi / 4)
    # x + y <= 48 mm: below the diagonal of the square, which bricks with five steps together lie beside or on
    assert len(instances()) == len(shown_bricks(build))
    assert 15 <= len(instances()) <= 21


def test_section_survives_a_file(tmp_path) -> None:
    """A saved .blend opens with the same cut and the same hidden roles."""
    build = show(table(ALL_ROLES))
    cut_away(build, Section("x", 0.5, flip=True))
    show_role(build, Role.OFFSET, visible=False)
    before, name = places(), build.name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    build = bpy.data.collections[name]
    assert places() == before
    assert section_of(build) == Section("x", 0.5, flip=True)
    show_role(build, Role.OFFSET, visible=True)
    assert len(places()) == len(before) + 3


def test_nothing_left_is_said() -> None:
    """A cut that hides all bricks, and roles of which none is left, are sentences."""
    build = show(tower(2))
    cut_away(build, Section("z", 0.0))
    with pytest.raises(BuildError, match="hides all bricks"):
        shown_bricks(build)
    cut_away(build, Section())
    show_role(build, Role.SHELL, visible=False)
    with pytest.raises(BuildError, match="no bricks to show"):
        shown_bricks(build)


def test_cut_build_is_cleared_as_a_whole() -> None:
    """Removing a cut build with a hidden role leaves nothing behind."""
    before = content()
    build = show(table(ALL_ROLES))
    cut_away(build, Section("y", 0.5))
    show_role(build, Role.SHELL, visible=False)
    clear_build(bpy.context.scene, build)
    assert content() == before


def test_sliders_move_fifty_thousand_bricks(tmp_path) -> None:
    """The benchmark tells a time for each slider; whether it is short, is the benchmark's to say."""
    assert benchmark.main(["sliders", "--out", str(tmp_path)]) == 0
    [[made], rows] = json.loads((tmp_path / "sliders.json").read_text(encoding="utf-8"))["tables"].values()
    assert made["cpu_seconds"] > 0
    assert made["mb_of_file"] > 0
    assert isinstance(made["mb_of_memory"], float)  # after other tests nothing more need be taken
    sliders = [
        "top layer",
        "only this layer",
        "section x",
        "section y",
        "section z",
        "explode",
        "step",
        "a role's switch",
        "supports",
        *(f"section {axis} without supports" for axis in "xyz"),
    ]
    assert [row["slider"] for row in rows] == sliders
    assert all(row["median_ms"] > 0 and row["median_cpu_ms"] > 0 for row in rows)
    [build] = builds(bpy.context.scene)
    assert len(shown_bricks(build)) == 50_000
