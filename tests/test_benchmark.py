"""The benchmark: what it reads, what it would find wrong, and every command once on a small box."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

trimesh = pytest.importorskip("trimesh", reason="benchmarks need the dependency group checks")
pytest.importorskip("shapely", reason="benchmarks need the dependency group checks")
Image = pytest.importorskip("PIL.Image", reason="benchmarks need pillow")

from legorize_addon.core.errors import BuildError, MeshError  # noqa: E402
from legorize_addon.core.model.catalogue import load_catalogue  # noqa: E402 - after the packages that may be missing
from legorize_addon.core.model.contacts import contact_graph  # noqa: E402
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid  # noqa: E402
from legorize_addon.core.pipeline import legorize  # noqa: E402
from legorize_addon.core.settings import Settings  # noqa: E402
from legorize_addon.core.slicing.slices import slice_mesh  # noqa: E402
from legorize_addon.core.slicing.trajectories import link_loops  # noqa: E402
from scripts import benchmark  # noqa: E402
from scripts.benchmarks import clock, goals, hollowing, judge, kept, layout_figures, meshes, slicing, steps, surface  # noqa: E402
from scripts.benchmarks.stablelego import placed  # noqa: E402
from scripts.benchmarks.tables import Table  # noqa: E402
from tests.core.test_pipeline import STAGES  # noqa: E402

RED, BLUE = (180, 0, 0), (30, 90, 168)
JUDGED = {
    "parts": 1, "collision_cells": 0, "unread_parts": 0, "mirrored": False,
    "surface_to_brick_mean": 0.3, "surface_to_brick_p95": 0.5, "surface_lost_share": 0.0, "volume_ratio": 1.0,
    "colour_error_mean": 8.0, "colour_error_floor": 7.0, "colour_wrong_share": 0.0,
    "components": 1, "floating_bricks": 0,
}  # fmt: skip


@pytest.fixture
def box(tmp_path: Path) -> Path:
    """Return a file with a box of 2 x 1 x 0.5 m, the half at low x red and the other blue."""
    body = trimesh.creation.box([2.0, 0.5, 1.0])
    image = Image.new("RGB", (2, 1))
    image.putdata([RED, BLUE])
    uv = np.column_stack([body.vertices[:, 0] / 4 + 0.5, np.full(len(body.vertices), 0.5)])
    body.visual = trimesh.visual.TextureVisuals(
        uv, material=trimesh.visual.material.PBRMaterial(baseColorTexture=image)
    )
    path = tmp_path / "box.glb"
    path.write_bytes(body.export(file_type="glb"))
    return path


def test_glb_stands_upright_in_mm(box: Path) -> None:
    """The y axis of the file becomes z, metres become mm, and the image keeps its bytes."""
    mesh = meshes.read_mesh(box)
    np.testing.assert_allclose(np.ptp(mesh.vertices, axis=0), [2000, 1000, 500])
    assert [tuple(texel) for texel in mesh.images[0][0].tolist()] == [RED, BLUE]


def test_colour_factor_is_linear(tmp_path: Path) -> None:
    """A glTF factor of one half is half the light: sRGB 188, not 128."""
    body = trimesh.creation.box([1.0, 1.0, 1.0])
    material = trimesh.visual.material.PBRMaterial(baseColorFactor=[0.5, 0.5, 0.5, 1.0])
    body.visual = trimesh.visual.TextureVisuals(np.zeros((8, 2)), material=material)
    (tmp_path / "grey.glb").write_bytes(body.export(file_type="glb"))
    assert meshes.read_mesh(tmp_path / "grey.glb").images[0].tolist() == [[[188, 188, 188]]]


def test_colours_of_vertices_are_refused(tmp_path: Path) -> None:
    """What the reader does not know is said, not painted grey."""
    body = trimesh.creation.box([1.0, 1.0, 1.0])
    body.visual.vertex_colors = np.arange(32).reshape(8, 4).astype(np.uint8)
    body.export(tmp_path / "painted.ply")
    with pytest.raises(MeshError, match="coloured by its vertices"):
        meshes.read_mesh(tmp_path / "painted.ply")


def test_subdivided_mesh_is_the_same_surface(box: Path) -> None:
    """Quartering keeps area and volume, and image coordinates stay tied to places."""
    mesh = meshes.read_mesh(box)
    fine = meshes.subdivided(mesh, 1000)
    assert len(fine.faces) == 12 * 4**3
    coarse, finer = meshes.as_trimesh(mesh), meshes.as_trimesh(fine)
    assert finer.area == pytest.approx(coarse.area)
    assert finer.volume == pytest.approx(coarse.volume)
    np.testing.assert_allclose(fine.uvs[..., 0], fine.vertices[fine.faces][..., 0] / 4000 + 0.5)


def test_wrong_area_is_found(box: Path) -> None:
    """Areas agree with the reference's, and one that is off by a millionth shows."""
    model = meshes.prepared(box, Settings(width=20))
    trajectories = link_loops(model.mesh, slice_mesh(model.mesh, slicing.even_heights(model.mesh, 4)), model.surface)
    areas = trajectories.areas()
    assert slicing.area_error(trajectories, areas) < slicing.AREA_ERROR
    assert slicing.area_error(trajectories, areas * (1 + 1e-6)) == pytest.approx(1e-6)


def test_open_loop_is_found(box: Path) -> None:
    """A point beside the surface shows by its distance, and a loop that is missing by its triangles."""
    model = meshes.prepared(box, Settings(width=20))
    heights = slicing.even_heights(model.mesh, 4)
    loops = link_loops(model.mesh, slice_mesh(model.mesh, heights), model.surface)
    assert slicing.left_out(model.mesh, heights, loops) == 0
    assert slicing.farthest_stray(model.mesh, heights, loops) < slicing.STRAY
    torn = loops.points.copy()
    torn[3] -= 0.25 * np.sign(torn[3])
    stray = slicing.farthest_stray(model.mesh, heights, replace(loops, points=torn))
    assert 0.25 <= stray <= 0.25 * np.sqrt(2)
    fewer = replace(loops, face=np.where(loops.edge_loop == 1, -1, loops.face))
    assert slicing.left_out(model.mesh, heights, fewer) == 8


def test_heights_of_vertices_are_vertices(box: Path) -> None:
    """Planes through vertices lie exactly on some, and never at the two ends."""
    mesh = meshes.subdivided(meshes.read_mesh(box), 1000)
    heights = slicing.vertex_heights(mesh, 5)
    assert 0 < len(heights) <= 5
    assert np.isin(heights, mesh.vertices[:, 2]).all()
    assert mesh.vertices[:, 2].min() < heights.min() <= heights.max() < mesh.vertices[:, 2].max()


def test_least_time_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two functions take turns, and of each the fastest turn counts."""
    order: list[str] = []
    ticks = iter([0, 5, 5, 7, 7, 10, 10, 16])
    monkeypatch.setattr(clock.time, "process_time", lambda: next(ticks))
    assert clock.least_seconds(lambda: order.append("a"), lambda: order.append("b"), repeats=2) == [3, 2]
    assert order == ["a", "b", "a", "b"]


def test_table_marks_missed_goals() -> None:
    """Only a goal that is missed is bold; what does not exist is a dash."""
    lines = Table("t", "T", ({"name": "x", "ratio": 12.3456, "met": False, "closed": False, "limit": None},)).markdown()
    assert "| x | 12.35 | **no** | no | – |" in lines  # noqa: RUF001 - a dash


def run(tmp_path: Path, *arguments: object) -> dict[str, list[dict[str, object]]]:
    """Run a benchmark and return its tables, of each of which there is a CSV file with as many rows."""
    assert benchmark.main([*map(str, arguments), "--out", str(tmp_path / "out")]) == 0
    tables = json.loads((tmp_path / "out" / f"{arguments[0]}.json").read_text())["tables"]
    for name, rows in tables.items():
        with (tmp_path / "out" / f"{name}.csv").open(newline="") as file:
            assert len(list(csv.DictReader(file))) == len(rows)
    return tables


def test_slicing_command(box: Path, tmp_path: Path) -> None:
    """Rows for every number of triangles and planes; all loops of a box are closed and right."""
    tables = run(tmp_path, "slicing", box, "--triangles", 0, 200, "--planes", 3, 5, "--repeats", 1)
    assert [(row["triangles"], row["planes"]) for row in tables["slicing_speed"]] == [
        (12, 3),
        (12, 5),
        (192, 3),
        (192, 5),
    ]
    assert all(row["met"] for row in tables["slicing_checks"])


def test_units_command(box: Path, tmp_path: Path) -> None:
    """A box that fills its cells is exact, and all of its cells have the colour that dense sampling finds."""
    tables = run(tmp_path, "units", box, "--width", 16, "--points", 100_000, "--triangles", 0, "--repeats", 1)
    [occupancy] = tables["units_occupancy"]
    assert occupancy["differing"] == 0
    # 16 x 8 studs and 32 mm high: the fourth layer is a third full
    assert occupancy["exact_cells"] == 16 * 8 * 3
    assert [row["rule"] for row in tables["units_colours"]] == ["likeness", "longest"]
    assert all(row["visible_equal"] == 1 for row in tables["units_colours"])


def test_pipeline_command(box: Path, tmp_path: Path) -> None:
    """One row a width; the seconds of the stages add up."""
    tables = run(tmp_path, "pipeline", box, "--widths", 8, 16)
    assert [row["studs"] for row in tables["pipeline_results"]] == [8, 16]
    for row in tables["pipeline_times"]:
        stages = [row[name] for name in STAGES]
        assert sum(stages) == pytest.approx(row["total_s"])


def test_judge_command_keeps_what_it_knows_of_the_peer(box: Path, tmp_path: Path) -> None:
    """Judge and peer are run as programs; the peer only if there is no judgement of it yet."""
    folder = tmp_path / "judge"
    folder.mkdir()
    judging = f"import sys, pathlib\npathlib.Path(sys.argv[5]).write_text({json.dumps(JUDGED)!r})\n"
    (folder / "judge.py").write_text(judging)
    (folder / "peer_voxels.py").write_text("import sys\nopen(sys.argv[3], 'a').write('x')\n")
    for _ in range(2):
        tables = run(tmp_path, "judge", box, "--judge", folder, "--width", 8)
    assert [row["whose"] for row in tables["judge"]] == ["ours", "peer"]
    assert (tmp_path / "out" / "peer" / "box-8.ldr").read_text() == "x"
    [ratios] = tables["judge_ratios"]
    assert (ratios["sound_met"], ratios["colour_met"], ratios["volume_met"]) == (True, False, True)


def test_points_on_outer_faces() -> None:
    """A plate has nine points on each level face and three on each upright one; faces of a sealed hollow have none."""
    points, cell = surface.outer_faces(np.ones((1, 1, 1), dtype=bool))
    assert (cell == 0).all()
    level = points[np.isin(points[:, 2], (0, 1))]
    assert len(level) == 18
    np.testing.assert_allclose(np.unique(level[:, :2].round(9)), np.array([1, 3, 5]) / 6)
    upright = points[points[:, 2] == 0.5]
    assert len(upright) == 12
    assert (np.isin(upright[:, :2], (0, 1)).sum(axis=1) == 1).all()
    hollow = np.ones((3, 3, 3), dtype=bool)
    hollow[1, 1, 1] = False
    assert len(surface.outer_faces(hollow)[0]) == 2 * 9 * 9 + 4 * 9 * 3


def test_hidden_surface_is_not_measured(tmp_path: Path) -> None:
    """Of a box within a box only the outer one counts, and bricks that fill it are near everywhere."""
    scene = trimesh.Scene([trimesh.creation.box([side, side, side]) for side in (0.96, 0.48)])
    (tmp_path / "boxes.glb").write_bytes(scene.export(file_type="glb"))
    build = legorize(meshes.read_mesh(tmp_path / "boxes.glb"), Settings(width=12))
    seen = surface.seen_surface(build, 20_000)
    middle = build.mesh.vertices.mean(axis=0)
    # inside lies a quarter as much
    assert len(seen.points) == pytest.approx(20_000 / 1.25, rel=1e-3)
    # 12 studs are 10 bricks high
    np.testing.assert_allclose(np.abs(seen.points - middle).max(axis=1), 48)
    like = surface.likeness(seen, build, load_catalogue())
    assert like.p95 <= np.hypot(1 / 6, 0.2)
    assert like.lost == 0


def test_detail_command(box: Path, tmp_path: Path) -> None:
    """Of a box as high as ten plates, bricks miss the top by a plate and plates miss nothing."""
    tables = run(tmp_path, "detail", box, "--widths", 16)
    none, pays, every = tables["detail"]
    assert [row["allowed"] for row in (none, pays, every)] == ["none", "pays", "all"]
    # between the points of the faces lies a third of a stud, or a plate
    between = round(np.hypot(1 / 6, 0.2), 3)
    assert none["surface_p95"] >= 0.4 > between >= pays["surface_p95"] == every["surface_p95"]
    assert none["surface_lost"] == every["floating"] == none["plates"] == 0 < every["plates"]
    assert every["components"] == 1
    [gains, mean] = tables["detail_gains"]
    assert gains["all_mean"] == mean["all_mean"] == pytest.approx(1 - every["surface_mean"] / none["surface_mean"])
    assert gains["kept_share"] == gains["plates_share"] == 1
    assert (gains["distance_met"], gains["colour_met"], gains["pays_met"]) == (True, True, None)
    assert (mean["distance_met"], mean["pays_met"]) == (True, False)


def test_detail_asks_the_judge(box: Path, tmp_path: Path) -> None:
    """Each way is judged from a file of its own; a judge who sees no difference sees no gain."""
    judging = f"import sys, pathlib\npathlib.Path(sys.argv[5]).write_text({json.dumps(JUDGED)!r})\n"
    (tmp_path / "judge.py").write_text(judging)
    tables = run(tmp_path, "detail", box, "--widths", 8, "--judge", tmp_path)
    assert len({path.read_text() for path in (tmp_path / "out" / "detail").glob("box-8-*.ldr")}) > 1
    assert [row["surface_p95"] for row in tables["detail"]] == [0.5, 0.5, 0.5]
    gains, mean = tables["detail_gains"]
    assert (gains["all_mean"], gains["kept_share"], gains["distance_met"]) == (0, None, True)
    assert (mean["distance_met"], mean["colour_met"], mean["pays_met"]) == (False, False, None)


def red_cube(side: int) -> UnitGrid:
    """Return a solid cube of unit bricks."""
    cells = np.ones((side, 3, side, side), dtype=bool)
    return UnitGrid(
        colour=np.where(cells, 4, 0).astype(np.int16),
        cover=np.where(cells, Fill.REQUIRED, Fill.EMPTY).astype(np.uint8),
        role=np.zeros(cells.shape, dtype=np.uint8),
        origin=np.zeros(3),
    )


def test_fixed_shell_is_two_cells() -> None:
    """All but the inner five cubed of nine cubed must be built, and nothing else may."""
    shell = hollowing.fixed_shell(red_cube(9))
    assert (shell.cover == Fill.REQUIRED).sum() == 3 * (9**3 - 5**3)
    assert (shell.cover != Fill.OPTIONAL).all()


def test_holes_and_loose_cells_are_found() -> None:
    """A missing cell of the shell lets the air in; what is left above an empty layer has lost the ground."""
    cube = red_cube(5)
    assert hollowing.soundness(cube, cube) == {"behind_holes": 0, "cut_off": 0, "sound_met": True}
    torn = red_cube(5)
    torn.cover[2, 1, 0, 2] = Fill.EMPTY
    assert hollowing.soundness(cube, torn) == {"behind_holes": 1, "cut_off": 0, "sound_met": False}
    torn.cover[2] = Fill.EMPTY
    assert hollowing.soundness(cube, torn) == {"behind_holes": 75, "cut_off": 150, "sound_met": False}


def test_hollowing_command(tmp_path: Path) -> None:
    """The walls of a cube stay, one cell thick, and no more than what carries its ceiling beside them."""
    trimesh.creation.box([0.96, 0.96, 0.96]).export(tmp_path / "cube.glb")
    row, mean = run(tmp_path, "hollowing", tmp_path / "cube.glb", "--width", 24)["hollowing"]
    assert row["solid"] == 24 * 24 * 60
    wall, twice = (1 - (24 - 2 * cells) ** 2 * (20 - 2 * cells) / (24 * 24 * 20) for cells in (1, 2))
    assert wall <= row["must_share"] == mean["must_share"] < twice
    assert row["bricks"] < 1.2 * row["fixed_bricks"]
    assert row["mass_g"] < row["fixed_mass_g"]
    assert row["mass_saved"] == pytest.approx(1 - row["mass_g"] / row["fixed_mass_g"])
    assert (row["added_share"], row["sound_met"]) == (0, True)


def test_stability_command(tmp_path: Path) -> None:
    """A box stands with proof, and all cases of the StableLego article end as the article says."""
    trimesh.creation.box([0.96, 0.48, 0.48]).export(tmp_path / "beam.glb")
    tables = run(tmp_path, "stability", tmp_path / "beam.glb", "--widths", 12, "--repeats", 1)
    [row] = tables["stability"]
    assert (row["verdict"], row["cautious"], row["floating"]) == ("stable", "stable", 0)
    assert (row["check_met"], row["time_met"], row["faster_met"]) == (True, True, None)
    assert row["residual"] <= 1e-8
    assert len(tables["stability_cases"]) == 9
    assert all(case["met"] for case in tables["stability_cases"])
    standing = [stair["levels"] for stair in tables["stability_stairs"] if stair["at_0.98"] == "stable"]
    assert standing == list(range(14, 20))


def test_what_a_layout_is_like() -> None:
    """Two pillars carry a beam: none of them has to; a tower needs all below its top. One seam of two is covered."""
    catalogue = load_catalogue()
    bricks = placed(
        [("3003", 0, 0, 0, 0), ("3003", 2, 0, 0, 0), ("3003", 0, 0, 3, 0), ("3003", 2, 0, 3, 0), ("3001", 0, 0, 6, 0)],
        catalogue,
    )
    links = contact_graph(bricks, catalogue)
    # the pillars carry the beam both: without one the other still does
    assert layout_figures.articulations(bricks, links) == 0
    assert layout_figures.coinciding_seams(links) == 0.5
    tower = bricks.take(np.array([0, 2, 4]))
    assert layout_figures.articulations(tower, contact_graph(tower, catalogue)) == 2
    # the middle one carries nothing but what is left out
    top = np.array([False, False, True])
    assert layout_figures.articulations(tower, contact_graph(tower, catalogue), top) == 1


def test_forced_small_bricks_are_counted_apart() -> None:
    """Of a red row with a blue cell in it, only the blue one can be nothing but a 1 x 1."""
    catalogue = load_catalogue()
    grid = red_cube(1)
    row = replace(grid, **{name: np.repeat(getattr(grid, name), 5, axis=3) for name in ("colour", "cover", "role")})
    row.colour[0, :, 0, 1] = 1
    assert np.argwhere(layout_figures.alone(row, catalogue)).tolist() == [[0, 0, 0], [0, 0, 1]]
    assert layout_figures.must_cells(row) == 5
    bricks = placed([("3005", x, 0, 0, 0) for x in range(5)], catalogue)
    assert layout_figures.single(bricks, catalogue).all()
    assert layout_figures.forced_singles(bricks, row, catalogue).tolist() == [True, True, False, False, False]
    # three red cells in a row need none
    assert layout_figures.fewest_singles(bricks, row, catalogue) == 2
    # all bricks are red: the blue cell is lost, and so is what is not built
    assert layout_figures.colours_lost(row, bricks, contact_graph(bricks, catalogue)) == (15, 3)
    fewer = bricks.take(np.arange(4))
    assert layout_figures.colours_lost(row, fewer, contact_graph(fewer, catalogue)) == (15, 6)


def test_seams_between_colours_are_counted_apart() -> None:
    """No part lies across the edge of two colours; a wall that is parted there throughout could not be bonded."""
    catalogue = load_catalogue()
    grid = red_cube(2)
    grid.colour[..., 1] = 1
    bricks = placed([("3004", x, 0, 3 * z, 1) for z in range(2) for x in range(2)], catalogue)
    links = contact_graph(bricks, catalogue)
    along_y, along_x = layout_figures.edges_to_bridge(grid, links, catalogue)
    assert along_y[:, 0].all()
    assert not along_x.any()
    assert layout_figures.coinciding_seams(links) == 1
    assert layout_figures.coinciding_seams(links, np.stack([along_y, along_x])) == 0


def test_fewest_small_bricks_is_a_bound_that_a_cross_reaches() -> None:
    """A cross of five cells needs two 1 x 1 at least, whichever part lies across its middle."""
    catalogue = load_catalogue()
    grid = red_cube(3)
    cross = np.array([[0, 1, 0], [1, 1, 1], [0, 1, 0]], dtype=bool)
    outside = ~np.broadcast_to(cross, grid.cover.shape)
    colour, cover = np.where(outside, COLOUR_EMPTY, grid.colour), np.where(outside, Fill.EMPTY, grid.cover)
    five = replace(grid, colour=colour.astype(np.int16), cover=cover.astype(np.uint8))
    bricks = placed([("3005", x, y, 3 * z, 0) for z in range(3) for y, x in np.argwhere(cross).tolist()], catalogue)
    assert layout_figures.fewest_singles(bricks, five, catalogue) == 3 * 2


def test_exponent_is_fitted_within_models() -> None:
    """Seconds that grow with the cells to the 1.5 give 1.5, whatever the factor of each model."""
    costs = [
        {"model": model, "must": required, "layout": factor * required**1.5}
        for model, factor in (("a", 1e-6), ("b", 3e-5))
        for required in (100, 1000, 20_000)
    ]
    assert goals.exponent(costs) == pytest.approx(1.5)
    assert goals.exponent(costs[:1]) is None


def test_missed_goals_are_named() -> None:
    """A goal names the model and the size that miss it; goals of some sizes are asked of no other one."""
    fine = {goal.figure: goal.most for goal in goals.GOALS} | {"at_0.98": "stable", "at_0.7": "collapses"}
    rows = [{"model": "a", "studs": 24, **fine, "ratio": 1.5}, {"model": "a", "studs": 48, **fine, "single_free": 0.03}]
    cost = {"studs": 48, "total_s": 3.0, "limit_s": 2.0, "time_met": False, "layout_us": 50.0, "layout_met": True}
    costs = [{"model": "a", "must": 10, "layout": 0.1, "memory_mb": 90.0, **cost}]
    met = {row["goal"]: row for row in goals.goals_met(rows, costs)}
    assert {name for name, row in met.items() if row["met"] is False} == {
        "1 x 1 beyond the fewest that are proven to be forced",
        "CPU seconds of the whole way, by their limit",
    }
    assert met["1 x 1 beyond the fewest that are proven to be forced"]["not_by"] == "a 48"
    assert met["bricks to the bound, after repair at 48 and 96 studs"]["kept_by"] == "1 of 1"
    assert met["certified at 0.7 N"]["kept_by"] == "0 of 2"
    assert met["CPU seconds of the whole way, by their limit"]["worst"] == 1.5


def test_goals_command(tmp_path: Path) -> None:
    """A leaning arm stands on pillars and is named with the reason; every case has figures, costs and memory."""
    foot, arm = trimesh.creation.box([0.16, 0.16, 0.48]), trimesh.creation.box([1.6, 0.16, 0.48])
    arm.apply_translation([0.72, 0, 0.48])
    both = trimesh.util.concatenate([foot, arm])
    both.apply_transform(trimesh.transformations.rotation_matrix(-np.pi / 2, [1, 0, 0]))
    both.export(tmp_path / "arm.glb")
    tables = run(tmp_path, "goals", tmp_path / "arm.glb", "--widths", 20, 10)
    assert [row["studs"] for row in tables["goals"]] == [10, 20]
    for row in tables["goals"]:
        assert row["bound"] <= row["bricks"]
        assert (row["floating"], row["not_made"], row["colours_lost"]) == (0, 0, 0)
        assert (row["at_0.98"], row["by_itself"]) == ("stable", "collapses")
        assert row["pillars"] > 0
    for row in tables["goals_costs"]:
        assert row["layout_us"] == pytest.approx(1e6 * (row["layout"] + row["ties"]) / row["must"])
        assert row["memory_mb"] > 50
    assert [row["model"] for row in tables["goals_fallen"]] == ["arm", "arm"]
    assert all("tips over" in row["reason"] for row in tables["goals_fallen"])


def test_judge_wants_the_bricks(tmp_path: Path) -> None:
    """A folder of results without the model is one sentence."""
    with pytest.raises(BuildError, match=r"has no cow/model\.ldr: run"):
        judge.found_bricks(tmp_path, "cow")
    (tmp_path / "cow.ldr").touch()
    assert judge.found_bricks(tmp_path, "cow").name == "cow.ldr"


def test_failed_judge_is_one_sentence(box: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What the judge says last is the end of the sentence; the exit status is 1."""
    (tmp_path / "judge.py").write_text("raise SystemExit('no such brick')\n")
    assert benchmark.main(["judge", str(box), "--judge", str(tmp_path), "--width", "8", "--out", str(tmp_path)]) == 1
    assert capsys.readouterr().err.endswith("judge.py failed on " + str(box) + ": no such brick\n")


def test_published_command(box: Path, tmp_path: Path) -> None:
    """Both ways are built without a failed check and read back; prices are shares of the default's."""
    tables = run(tmp_path, "published", box, "--widths", 8)
    default, published = tables["published"]
    assert [default["way"], published["way"]] == ["default", "as published"]
    assert default["met"]
    assert published["met"]
    price, median = tables["published_price"]
    assert price["bricks"] == median["bricks"] == published["bricks"] / default["bricks"]


def test_updates_command(box: Path, tmp_path: Path) -> None:
    """A row for each change, with its share of a full run, and one for each preview."""
    assert benchmark.main(["updates", str(box), "--width", "8", "--repeats", "1", "--out", str(tmp_path)]) == 0
    updates, previews = json.loads((tmp_path / "updates.json").read_text(encoding="utf-8"))["tables"].values()
    assert [row["change"] for row in updates][:3] == ["supports none", "supports columns", "colours 7 to 5"]
    for row in updates:
        assert row["share"] == pytest.approx(row["update_s"] / row["full_s"])
        assert row["goal_met"] == (row["share"] <= row["goal"])
        assert row["bricks"] > 0
    assert [row["preview"] for row in previews] == ["the first", "another size"]
    assert all(row["cpu_s"] > 0 for row in previews)


def test_budget_command(box: Path, tmp_path: Path) -> None:
    """One row a build, with the estimate beside what it took, and the errors over all of them."""
    tables = run(tmp_path, "budget", box, "--widths", 12)
    [row] = tables["budget"]
    assert row["bricks_ratio"] == pytest.approx(row["bricks_expected"] / row["bricks"])
    assert 50 < row["megabytes"] < 5000
    assert [error["what"] for error in tables["budget_errors"]] == ["bricks", "seconds", "megabytes"]


def test_steps_are_counted_and_judged(box: Path) -> None:
    """A small box meets every goal of the steps; its figures are those of its build."""
    build = legorize(meshes.read_mesh(box), Settings(width=8))
    found = steps.figures(build)
    assert found["bricks"] == len(build.bricks)
    assert found["afloat"] == found["pressed"] == found["cramped"] == 0
    assert found["components"] == found["pieces"] == 1
    assert found["steps"] == len(build.supports.steps)


def test_rows_are_measured_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What a run that ended early has measured, the next one of the same program takes over, and only that."""
    made: list[str] = []

    def rows(minutes: float) -> list[object]:
        table = kept.Kept(tmp_path / "rows", minutes)
        return [table.row(name, lambda name=name: made.append(name) or {"n": len(made)}) for name in ("a", "b")]

    assert rows(1e-9) == [[], []]
    assert rows(0) == rows(1e-9) == [[{"n": 1}], [{"n": 2}]]
    assert made == ["a", "b"]
    monkeypatch.setattr(kept, "program", lambda: "another")
    assert rows(1e-9) == [[], []]


def test_mirrored_parts_far_apart_in_the_order_are_found() -> None:
    """Of two pairs, one is placed in neighbouring steps and one is not."""
    bricks = placed([("3003", x, 0, z, 0) for x in (0, 8) for z in (0, 3)], load_catalogue())
    assert steps.mirrored(bricks, np.array([0, 1, 1, 5], np.int32)) == 0.5
    assert steps.mirrored(bricks.take(np.array([0, 3])), np.array([0, 1], np.int32)) is None


def test_mosaics_are_nearer_than_a_plain_one(tmp_path: Path) -> None:
    """Each image has a plain row and four of ours, which are one piece; mixed colours are the nearest from afar."""
    ramp = np.broadcast_to(np.linspace(0, 255, 60), (40, 60)).astype(np.uint8)
    Image.fromarray(np.stack([ramp, ramp[:, ::-1], ramp], axis=-1)).save(tmp_path / "ramp.png")
    rows = run(tmp_path, "mosaics", tmp_path / "ramp.png", "--widths", 24)["mosaics"]
    difference = {row["way"]: row["difference"] for row in rows}
    assert list(difference) == ["plain", "nearest", "texels", "ordered", "diffusion"]
    assert difference["diffusion"] < difference["nearest"] < difference["plain"]
    assert all(row["met"] for row in rows[1:])
