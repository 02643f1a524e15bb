"""Pieces apart and building steps: what is seen is what the moves say, and no brick changes."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import bpy
import numpy as np
import pytest

from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.moves import Action, Moves
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.steps import Steps
from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY, Bricks, Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import CELL_SIZE
from legorize_addon.core.statics.stability import stability
from legorize_addon.core.units import BRICK, STUD
from legorize_addon.render.contact_sheet import MARGIN, even_steps, render_contact_sheet, tiled
from legorize_addon.scene.assembly_columns import JOINED, NEVER, REMOVED, TIER, assembly_columns
from legorize_addon.scene.brick_points import NO_MARGIN, box_corners, positions
from legorize_addon.scene.brick_tree import EXPLODE, STEPS, TREE_KEY
from legorize_addon.scene.builds import point_objects
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.instancing import bricks_modifier
from legorize_addon.scene.section import Section
from legorize_addon.scene.state import BUILD_KEY
from legorize_addon.scene.verdict import check_lines
from legorize_addon.view.heat_map import heat_of, show_heat_map
from legorize_addon.view.steps import explode, exploded, n_pieces, n_steps, steps_done
from legorize_addon.view.visibility import (
    corners_while_building,
    cut_away,
    roles_shown,
    show_layers,
    show_role,
    show_steps,
    shown_bricks,
    shown_corners,
)
from tests.blender.bricks import assert_same, content, instances, show, table

CATALOGUE = load_catalogue()
ONE, BEAM = CATALOGUE.part_row("3005"), CATALOGUE.part_row("3008")
RED, WHITE = 4, 15
OUTSIDE = int(Role.SUPPORT_OUTSIDE)


def storeys(*pieces: int) -> list[tuple[int, ...]]:
    """Return the rows of arms on posts, one on another, each a piece; then those of a support below each arm."""
    model, supports = [], []
    for storey, piece in enumerate(pieces):
        low = 6 * storey
        model += [(ONE, 0, 0, low, 0, RED, 0, piece), (BEAM, 0, 0, low + 3, 0, RED, 0, piece)]
        supports += [(ONE, 7, 0, low, 0, WHITE, OUTSIDE, piece)]
    return model + supports


def with_steps(rows: list[tuple[int, ...]]) -> tuple[Bricks, Steps]:
    """Return bricks and the order in which they are built."""
    bricks = table(rows)
    outside = bricks.role == Role.SUPPORT_OUTSIDE
    pairs = building_contacts(Assembly(bricks, CATALOGUE), temporary=outside).pairs
    steps = plan_steps(bricks, CATALOGUE, pairs, temporary=outside)
    return replace(bricks, step=steps.moves.step_of(len(bricks))), steps


def show_storeys(*pieces: int, **changes) -> tuple[bpy.types.Collection, Bricks, Steps]:
    """Show arms on posts with their building order."""
    bricks, steps = with_steps(storeys(*pieces))
    return show(bricks, steps=steps, **changes), bricks, steps


def seen() -> list[list[float]]:
    """Return where the viewport shows bricks, in order."""
    return sorted(np.round(matrix[:3, 3].astype(np.float64), 2).tolist() for _, _, matrix in instances())


def feet(bricks: Bricks, way: object = (0, 0, 0)) -> list[list[float]]:
    """Return the middles of the bricks' lower faces, moved, in order."""
    return sorted(np.round(positions(bricks, CATALOGUE) + way, 2).tolist())


def walked(moves: Moves, steps: int) -> tuple[list[int], set[int]]:
    """Return the rows of the bricks that are there after some steps, and the pieces that were joined."""
    there, joined = set(), {0}
    for action, brick, piece, step in zip(moves.action, moves.brick, moves.piece, moves.step, strict=True):
        if step >= steps:
            break
        if action == Action.PLACE:
            there.add(int(brick))
        elif action == Action.REMOVE:
            there.remove(int(brick))
        else:
            joined.add(int(piece))
    return sorted(there), joined


@pytest.mark.parametrize("pieces", [(0,), (0, 1), (0, 2, 1)])
def test_steps_show_what_the_moves_say(pieces: tuple[int, ...]) -> None:
    """After each number of steps, bricks placed and not taken out are seen: joined ones in place, others aside."""
    build, bricks, building = show_storeys(*pieces)
    aside = assembly_columns(Assembly(bricks, CATALOGUE), building)["aside"]
    assert n_steps(build) == len(building)
    # back and forth: only what changes is evaluated again
    for steps in [*range(1, n_steps(build) + 1), 3, n_steps(build), 1, 2]:
        show_steps(build, steps)
        rows, joined = walked(building.moves, steps)
        there = bricks.take(np.array(rows))
        way = np.where(np.isin(there.piece, list(joined))[:, None], 0.0, aside[rows])
        assert seen() == feet(there, way)
        assert_same(shown_bricks(build), there)
        corners = box_corners(there, CATALOGUE) + np.repeat(way, 8, axis=0)
        np.testing.assert_allclose(shown_corners(build), corners, atol=1e-4)
    show_steps(build, 0)
    assert seen() == feet(bricks)
    assert_same(read_bricks(build), bricks)


def test_after_the_last_step_the_model_is_finished() -> None:
    """All that stays is in place then, and all supports are gone."""
    build, bricks, _ = show_storeys(0, 1)
    show_steps(build, n_steps(build))
    assert seen() == feet(bricks.take(bricks.role != Role.SUPPORT_OUTSIDE))


def test_pieces_stand_on_the_table_side_by_side() -> None:
    """Until they are joined, pieces stand on the ground, and no two of them overlap."""
    bricks, building = with_steps(storeys(0, 2, 1))
    columns = assembly_columns(Assembly(bricks, CATALOGUE), building)
    corners = (box_corners(bricks, CATALOGUE) + np.repeat(columns["aside"], 8, axis=0)).reshape(-1, 8, 3)
    boxes = [corners[bricks.piece == piece].reshape(-1, 3) for piece in (0, 2, 1)]
    assert [box[:, 2].min() for box in boxes] == [0.0, 0.0, 0.0]
    for left, right in pairwise(boxes):
        assert left[:, 0].max() + STUD <= right[:, 0].min()
    cells = columns["aside"] / CELL_SIZE
    np.testing.assert_allclose(cells, np.rint(cells), atol=1e-9)


def test_columns_follow_the_moves() -> None:
    """Tiers go by height, not by number; supports are removed and pieces joined when the moves say so."""
    bricks, building = with_steps(storeys(0, 2, 1))
    columns = assembly_columns(Assembly(bricks, CATALOGUE), building)
    assert columns[TIER].tolist() == [{0: 0, 2: 1, 1: 2}[piece] for piece in bricks.piece.tolist()]
    assert ((columns[REMOVED] == NEVER) == (bricks.role != Role.SUPPORT_OUTSIDE)).all()
    assert (columns[REMOVED] > bricks.step).all()
    assert ((columns[JOINED] == NOBODY) == (bricks.piece == 0)).all()
    moves = building.moves
    joins = np.flatnonzero(moves.action == Action.JOIN)
    for join in joins.tolist():
        assert set(columns[JOINED][bricks.piece == moves.piece[join]].tolist()) == {int(moves.step[join])}


@pytest.mark.parametrize("share", [0.25, 1.0])
def test_pieces_are_lifted_by_their_tier(share: float) -> None:
    """Each piece is lifted by a share of the height for each piece below it; at 0 all are in place again."""
    build, bricks, building = show_storeys(0, 2, 1)
    tier = assembly_columns(Assembly(bricks, CATALOGUE), building)[TIER]
    way = np.outer(tier, (0, 0, share * 6 * BRICK))
    assert n_pieces(build) == 3
    explode(build, share)
    assert exploded(build) == share
    assert seen() == feet(bricks, way)
    np.testing.assert_allclose(shown_corners(build), box_corners(bricks, CATALOGUE) + np.repeat(way, 8, axis=0))
    assert_same(read_bricks(build), bricks)
    explode(build, 0.0)
    assert seen() == feet(bricks)


def test_camera_has_room_for_all_steps() -> None:
    """What is to be seen in any step lies within the corners that a camera takes in for all of them."""
    build, _, _ = show_storeys(0, 1)
    explode(build, 0.5)
    room = corners_while_building(build)
    for steps in range(n_steps(build) + 1):
        show_steps(build, steps)
        corners = shown_corners(build)
        assert (corners.min(axis=0) >= room.min(axis=0) - 1e-6).all()
        assert (corners.max(axis=0) <= room.max(axis=0) + 1e-6).all()


def test_steps_go_with_layers_roles_and_cut() -> None:
    """Shown is what the steps, the layers, the roles and the cut all show; a cut goes by places in the model."""
    build, bricks, building = show_storeys(0, 1)
    explode(build, 1.0)
    show_steps(build, n_steps(build) - 2)
    show_layers(bpy.context.scene, build, 3)
    show_role(build, Role.SUPPORT_OUTSIDE, visible=False)
    cut_away(build, Section("x", 0.25))
    rows, _ = walked(building.moves, n_steps(build) - 2)
    there = bricks.take(np.array(rows))
    kept = (there.corner[:, 2] < 9) & (there.role != Role.SUPPORT_OUTSIDE) & (there.part == ONE)
    assert 0 < kept.sum() < len(there)
    assert_same(shown_bricks(build), there.take(kept))


def test_supports_are_seen_while_they_stand() -> None:
    """Hidden supports appear with the steps, and are hidden again with the whole model; shown ones stay shown."""
    build, _, _ = show_storeys(0)
    for visible in (False, True):
        show_role(build, Role.SUPPORT_OUTSIDE, visible=visible)
        for steps in (1, 2, n_steps(build)):
            show_steps(build, steps)
            assert roles_shown(build)[Role.SUPPORT_OUTSIDE]
        show_steps(build, 0)
        assert roles_shown(build)[Role.SUPPORT_OUTSIDE] == visible


def test_both_survive_a_file(tmp_path: Path) -> None:
    """A saved .blend opens with the same step and the same way apart, and both can be undone there."""
    build, bricks, _ = show_storeys(0, 1)
    show_role(build, Role.SUPPORT_OUTSIDE, visible=False)
    explode(build, 0.5)
    show_steps(build, 4)
    before, name = seen(), build.name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    build = bpy.data.collections[name]
    assert (seen(), steps_done(build), exploded(build)) == (before, 4, 0.5)
    show_steps(build, 0)
    explode(build, 0.0)
    assert not roles_shown(build)[Role.SUPPORT_OUTSIDE]
    show_role(build, Role.SUPPORT_OUTSIDE, visible=True)
    assert seen() == feet(bricks)


def make_old(build: bpy.types.Collection) -> None:
    """Make a build one of an earlier version: its tree had no such inputs, and it knew nothing of building."""
    tree = bricks_modifier(point_objects(build)[0]).node_group
    for socket in [socket for socket in tree.interface.items_tree if socket.name in (EXPLODE, STEPS)]:
        tree.interface.remove(socket)
    tree[TREE_KEY] = 3
    del build[BUILD_KEY]["building"]


def test_builds_of_earlier_versions_go_on(addon: None) -> None:
    """What does not know its steps is shown, read and removed as ever; its sliders do nothing, functions say why."""
    before = content()
    bricks = table(storeys(0, 1))
    old = show(bricks, name="old")
    make_old(old)
    view = bpy.context.scene.legorize
    view.exploded, view.by_steps, view.step = 1.0, True, 2
    assert (view.exploded, view.by_steps) == (0.0, False)
    for change in (explode, show_steps):
        with pytest.raises(BuildError, match="legorize the object again"):
            change(old, 1)
    assert_same(shown_bricks(old), bricks)
    np.testing.assert_allclose(shown_corners(old), box_corners(bricks, CATALOGUE))
    new, _, _ = show_storeys(0, 1, name="new")
    explode(new, 1.0)
    assert len(instances()) == 2 * len(bricks)
    clear_build(bpy.context.scene, old)
    clear_build(bpy.context.scene, new)
    assert content() == before


def test_sliders_keep_to_the_panels_build(addon: None) -> None:
    """The sliders show and change the panel's build, within its steps; the step waits until it is switched on."""
    view = bpy.context.scene.legorize
    build, bricks, _ = show_storeys(0, 1)
    whole = n_steps(build)
    assert (view.by_steps, view.step, view.exploded) == (False, whole, 0.0)
    view.by_steps = True
    assert len(instances()) == (bricks.role != Role.SUPPORT_OUTSIDE).sum()
    view.step = 1
    assert (view.step, len(instances())) == (1, len(walked(with_steps(storeys(0, 1))[1].moves, 1)[0]))
    view.step = 999
    assert view.step == whole
    view.by_steps = False
    assert len(instances()) == len(bricks)
    view.exploded = 0.5
    assert view.exploded == exploded(build) == 0.5


def test_margins_are_those_of_the_model() -> None:
    """A proof of the model alone goes with its rows: supports are grey on the heat map, and no one's weakest brick."""
    bricks, building = with_steps(storeys(0))
    model = bricks.take(bricks.role != Role.SUPPORT_OUTSIDE)
    found = stability(Assembly(model, CATALOGUE))
    build = show(bricks, steps=building, stability=found)
    alone = show(model, stability=found, name="alone")
    assert check_lines(build[BUILD_KEY]["check"]) == check_lines(alone[BUILD_KEY]["check"])
    clear_build(bpy.context.scene, alone)
    show_heat_map(build, visible=True)
    grey = f"Heat {heat_of(np.array([NO_MARGIN]))[0]}"
    found_grey = [matrix[:3, 3].astype(np.float64) for _, name, matrix in instances() if name == grey]
    assert sorted(np.round(place, 2).tolist() for place in found_grey) == feet(
        bricks.take(bricks.role == Role.SUPPORT_OUTSIDE)
    )
    assert len(instances()) == len(bricks)


def test_summary_is_that_of_the_finished_model() -> None:
    """Bricks, mass and size leave out what is taken out again, which is counted by itself."""
    build, bricks, building = show_storeys(0, 1)
    model = bricks.take(bricks.role != Role.SUPPORT_OUTSIDE)
    alone = show(model, name="alone")[BUILD_KEY]["summary"].to_dict()
    assert build[BUILD_KEY]["summary"].to_dict() == alone
    figures = build[BUILD_KEY]["building"].to_dict()
    mass = CATALOGUE.mass[bricks.part].sum() - alone["mass"]
    assert figures.pop("removed_mass") == pytest.approx(mass)
    assert figures.pop("moves") == len(building.moves)
    assert figures == {"removed": 2, "kept": 0, "pieces": 2, "steps": len(building)}


@pytest.mark.parametrize(("n", "pictures", "expected"), [(10, 5, [2, 4, 6, 8, 10]), (3, 9, [1, 2, 3]), (78, 1, [78])])
def test_pictures_are_spread_evenly(n: int, pictures: int, expected: list[int]) -> None:
    """Steps are evenly spaced and end with the last one; there are no more pictures than steps."""
    assert even_steps(n, pictures) == expected


def test_tiles_go_row_by_row() -> None:
    """The first picture is at the top left, the next ones to its right, then below; what is left over is white."""
    shades = np.linspace(0.1, 0.5, 5)
    sheet = tiled([np.full((2, 3, 4), shade, dtype=np.float32) for shade in shades])
    assert sheet.shape == (2 * 2 + MARGIN, 3 * 3 + 2 * MARGIN, 4)
    corners = sheet[:: -(2 + MARGIN), :: 3 + MARGIN, 0]
    np.testing.assert_allclose(corners.ravel(), [*shades, 1.0])


def test_contact_sheet(tmp_path: Path) -> None:
    """The sheet has a picture for each step asked for, with more and more bricks; the build is as it was before."""
    build, _, _ = show_storeys(*[0] * 9)
    show_role(build, Role.SUPPORT_OUTSIDE, visible=False)
    before, whole = content(), seen()
    path = tmp_path / "sheet.png"
    render_contact_sheet(bpy.context.scene, build, path, pictures=4, samples=2, resolution=(60, 40))
    assert (content(), seen(), steps_done(build)) == (before, whole, 0)
    with pytest.raises(BuildError, match="cannot be written"):
        render_contact_sheet(bpy.context.scene, build, tmp_path / "no" / "a.png", pictures=1)
    assert [file.name for file in tmp_path.iterdir()] == ["sheet.png"]
    image = bpy.data.images.load(str(path))
    assert tuple(image.size) == (2 * 60 + MARGIN, 2 * 40 + MARGIN)
    pixels = np.array(image.pixels[:]).reshape(2 * 40 + MARGIN, 2 * 60 + MARGIN, 4)[::-1]
    frames = [pixels[y : y + 40, x : x + 60] for y in (0, 40 + MARGIN) for x in (0, 60 + MARGIN)]
    red = [int((frame[..., 0] > 1.5 * frame[..., 1:3].max(axis=-1)).sum()) for frame in frames]
    assert red[0] < red[-1]
    assert red == sorted(red)
