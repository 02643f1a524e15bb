"""The benchmark of layouts: the methods of the field lay correctly, and every table is made once on a small box."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

trimesh = pytest.importorskip("trimesh", reason="benchmarks need the dependency group checks")
pytest.importorskip("shapely", reason="benchmarks need the dependency group checks")
pytest.importorskip("networkx", reason="benchmarks need networkx")

from legorize_addon.core.errors import BuildError  # noqa: E402
from legorize_addon.core.layout.learning import energies as features  # noqa: E402
from legorize_addon.core.model.bricks import NOBODY, Bricks  # noqa: E402
from legorize_addon.core.model.catalogue import load_catalogue  # noqa: E402 - after the packages that may be missing
from legorize_addon.core.model.contacts import contact_graph  # noqa: E402
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid  # noqa: E402
from scripts import benchmark  # noqa: E402
from scripts.research import annealing, baselines, layout_goals, merging, peer, rules, tiling, volumes  # noqa: E402
from scripts.research.baselines import LayerWay  # noqa: E402
from scripts.research.energies import energies  # noqa: E402
from scripts.research.laying import faults, nothing_beneath  # noqa: E402
from scripts.research.layouts import METHODS, without_corners  # noqa: E402
from scripts.research.seams import EQUAL, FEW, Layer  # noqa: E402
from tests.core.standing import CATALOGUE, table  # noqa: E402

RED, WHITE = 4, 15

FIELD = [name for name in METHODS if name.startswith("B")]


def grid_of(colour: np.ndarray) -> UnitGrid:
    """Return a model of bricks, all of which must be built, given the colours by layer, y and x."""
    plates = np.repeat(colour[:, None], 3, axis=1).astype(np.int16)
    cover = np.where(plates != COLOUR_EMPTY, Fill.REQUIRED, Fill.EMPTY).astype(np.uint8)
    return UnitGrid(plates, cover, np.zeros(plates.shape, dtype=np.uint8), np.zeros(3))


def blob() -> UnitGrid:
    """Return a lump of four layers in two colours with cells of any colour and holes."""
    rng = np.random.default_rng(5)
    colour = rng.choice([RED, RED, RED, WHITE, COLOUR_ANY, COLOUR_ANY], size=(4, 9, 7))
    colour[rng.random(colour.shape) < 0.1] = COLOUR_EMPTY
    return grid_of(colour)


def laid(name: str, grid: UnitGrid, seed: int = 0) -> Bricks:
    """Lay a model by a method."""
    return METHODS[name](grid, load_catalogue(), np.random.default_rng(seed))


@pytest.mark.parametrize("name", METHODS)
def test_layouts_are_right_and_repeatable(name: str) -> None:
    """Every cell has one brick of its colour that is made in it, and the same seed gives the same bricks."""
    grid, catalogue = blob(), load_catalogue()
    bricks, again = laid(name, grid), laid(name, grid)
    assert faults(grid, bricks, contact_graph(bricks, catalogue), catalogue) == 0
    np.testing.assert_array_equal(bricks.corner, again.corner)
    np.testing.assert_array_equal(bricks.part, again.part)


def test_faults_are_found() -> None:
    """A brick taken away, laid twice or painted is a fault for each of its cells, three plates high."""
    grid, catalogue = grid_of(np.full((1, 4, 4), RED)), load_catalogue()
    bricks = laid(FIELD[1], grid)
    n = 3 * 8
    assert len(bricks) == 2
    for rows, wrong in (([0], 2 * n), ([0, 0, 1], n)):
        some = bricks.take(np.array(rows))
        assert faults(grid, some, contact_graph(some, catalogue), catalogue) == wrong
    painted = Bricks(*(getattr(bricks, each) for each in Bricks.__slots__))
    painted.colour[0] = WHITE
    assert faults(grid, painted, contact_graph(painted, catalogue), catalogue) == n


def test_merging_is_maximal() -> None:
    """No two bricks of a random merge could be one."""
    grid, catalogue = blob(), load_catalogue()
    problem = baselines.posed(grid, catalogue)
    rows = merging.merged(problem, np.random.default_rng(1))
    unions, keys = merging.Unions(problem.shapes), problem.placements.key[rows].tolist()
    known = set(problem.placements.key.tolist())
    assert len(rows) < len(problem.required)
    sheet = problem.placements.corner[rows, 2]
    pairs = [(a, b) for a in range(len(rows)) for b in range(a) if sheet[a] == sheet[b]]
    assert not [pair for pair in pairs if unions.key(*(keys[each] for each in pair)) in known]


def test_unions_are_symmetric() -> None:
    """Two bricks make the same whichever is named first."""
    problem = baselines.posed(grid_of(np.full((1, 4, 8), RED)), load_catalogue())
    unions, keys = merging.Unions(problem.shapes), problem.placements.key.tolist()[::7]
    assert all(unions.key(one, other) == unions.key(other, one) for one in keys for other in keys)


def test_largest_in_rows_fills_an_area_without_gaps() -> None:
    """A wall of 16 x 4 studs takes four of the largest bricks; by chance it takes more."""
    problem = baselines.posed(grid_of(np.full((1, 4, 16), RED)), load_catalogue())
    rng = np.random.default_rng(0)
    assert len(rules.by_key(rules.largest_in_rows)(problem, rng)) == 4
    assert len(rules.by_key(rules.largest)(problem, rng)) > 4


def layers_met(way: LayerWay, grid: UnitGrid) -> Iterator[tuple[Layer, np.ndarray]]:
    """Yield all layers of a model and their layouts."""
    met: list[tuple[Layer, np.ndarray]] = []

    def watched(layer: Layer, rng: np.random.Generator) -> np.ndarray:
        chosen = way(layer, rng)
        met.append((layer, chosen))
        return chosen

    baselines.upwards(watched)(grid, load_catalogue(), np.random.default_rng(0))
    return iter(met)


def test_energies_are_the_papers() -> None:
    """Efficiency is the paper's but for corner parts; symmetry is never less, as it takes one axis alone."""
    for layer, chosen in layers_met(tiling.tiled, blob()):
        found = layer.problem.placements
        _, aesthetics, efficiency = layer.energies(chosen)
        assert efficiency == pytest.approx(features.efficiency(found.size[chosen], np.zeros(len(chosen), dtype=bool)))
        owner = np.full(layer.problem.sheets.colour.shape[1:], NOBODY)
        owner.reshape(-1)[layer.problem.sheets.cells] = layer.problem.owner(chosen)
        assert aesthetics >= features.symmetry(owner, found.colour[chosen]) - 1e-12


def test_energies_of_whole_models() -> None:
    """A 2 x 8 alone has nothing above or below; two on each other have one side each; two studs across are a pair."""
    alone, both = (table(*(("3007", 0, 0, 3 * level) for level in range(n))) for n in (1, 2))
    assert list(energies(alone, contact_graph(alone, CATALOGUE), CATALOGUE).values()) == [0, 2, 2, 0, 0]
    found = energies(both, contact_graph(both, CATALOGUE), CATALOGUE)
    assert (found["e_vertical"], found["e_horizontal"]) == (1, 2)
    pair = table(("3005", 0, 0, 0), ("3005", 1, 1, 0))
    found = energies(pair, contact_graph(pair, CATALOGUE), CATALOGUE)
    assert (found["e_unit_connection"], found["e_efficiency"], found["e_symmetry"]) == (1, 1, 1)


def test_seams_are_bridged_or_coincide() -> None:
    """Each seam of the layer below lies inside one brick, or on the rim of two."""
    above_first = list(layers_met(tiling.tiled, blob()))[1:]
    assert all(layer.near for layer, _ in above_first)
    for layer, chosen in above_first:
        inside = [layer.bridged[row] for row in chosen]
        rims = np.bincount(np.concatenate([layer.rim[row] for row in chosen]).astype(int), minlength=len(layer.near))
        bridged = sum(inside)
        assert bridged.bit_count() == sum(each.bit_count() for each in inside)
        assert [2 * (not bridged >> seam & 1) for seam in range(len(layer.near))] == rims.tolist()


def test_seam_costs_by_the_next_bridge() -> None:
    """A tenth beside a bridge, a half farther along the line, and all of it without a bridge."""
    # two rows of 2 x 4 end at x = 4 below; above, one brick lies across at y = 0 and 1
    grid = grid_of(np.full((2, 8, 8), RED))
    catalogue = load_catalogue()
    problem = list(baselines.layers(baselines.posed(grid, catalogue)))[1]
    below = np.tile(np.repeat(np.arange(2, dtype=np.int32), 4), (8, 1))
    layer = Layer.of(problem, below)
    assert len(layer.near) == 8
    bridged = 0b11
    assert [layer.penalty(seam, bridged) for seam in range(2, 8)] == [0.1, 0.1, 0.5, 0.5, 0.5, 0.5]
    assert layer.penalty(5, 0) == 1.0


def test_tiling_is_never_worse_with_more_memory() -> None:
    """A* with room for all tilings of a small layer finds one as good as with room for few, and better than greedy."""

    def energy(way: LayerWay) -> float:
        [(layer, chosen)] = layers_met(way, grid_of(np.full((1, 5, 7), RED)))
        return float(np.dot(EQUAL, layer.energies(chosen)))

    wide, narrow = (energy(lambda layer, rng, most=most: tiling.tiled(layer, rng, most)) for most in (50_000, 16))
    greedy = energy(lambda layer, rng: rules.by_key(rules.largest_in_rows)(layer.problem, rng))
    assert wide <= narrow + 1e-12
    assert wide < greedy


def test_annealing_keeps_count_and_never_ends_worse_than_it_began() -> None:
    """The energy that is kept up to date is that of the layout, and the best layout met is returned."""
    for layer, chosen in layers_met(annealing.annealed, blob()):
        start = rules.by_key(rules.largest_in_rows)(layer.problem, np.random.default_rng(0))
        energy = [float(np.dot(FEW, layer.energies(each))) for each in (start, chosen)]
        assert energy[1] <= energy[0] + 1e-9
        state = annealing._State(layer, start)
        for row in range(0, len(layer.cells), 5):
            state.exchange(row)
        now = layer.energies(np.array(sorted(state.laid)))
        assert state.energy == pytest.approx(float(np.dot(FEW, now)))


def test_shells_of_the_field() -> None:
    """Two cells of a cube of nine stay, and nothing may be built within; columns add to a shell of one."""
    cube = grid_of(np.full((9, 9, 9), RED))
    shell = baselines.shell_of(cube, 2, columns=False)
    assert (shell.cover == Fill.REQUIRED).sum() == 3 * (9**3 - 5**3)
    assert (shell.cover != Fill.OPTIONAL).all()
    bare, carried = (baselines.shell_of(cube, 1, columns=columns) for columns in (False, True))
    assert (bare.cover == Fill.REQUIRED).sum() < (carried.cover == Fill.REQUIRED).sum() < 3 * 9**3


def test_bricks_on_nothing_are_counted() -> None:
    """Of a T, what sticks out on both sides rests on nothing, unless one brick lies across."""
    colour = np.full((2, 1, 9), COLOUR_EMPTY)
    colour[0, 0, 4] = colour[1] = RED
    grid, catalogue = grid_of(colour), load_catalogue()
    bricks = laid(FIELD[1], grid)
    assert len(bricks) == 3
    assert nothing_beneath(bricks, contact_graph(bricks, catalogue)) == 1
    colour[1, 0, ::2] = WHITE
    bricks = laid(FIELD[1], grid_of(colour))
    assert nothing_beneath(bricks, contact_graph(bricks, catalogue)) == 8


def test_percentages_are_volumes() -> None:
    """A red 2 x 8 and a white 2 x 2 share the volume four to one."""
    colour = np.full((1, 2, 10), RED)
    colour[..., 8:] = WHITE
    catalogue = load_catalogue()
    bricks = laid(FIELD[1], grid_of(colour))
    red, white, every = volumes.volume_rows({"model": "x"}, bricks, catalogue)
    assert (red["code"], red["Brick 2 x 8"], red["all"]) == (RED, 80, 80)
    assert (white["code"], white["Brick 2 x 2"]) == (WHITE, 20)
    assert (every["all"], every["sum_met"]) == (100, True)
    assert [row["all"] for row in volumes.count_rows({}, bricks, catalogue)] == [1, 1, 2]


def test_corner_parts_can_be_left_out() -> None:
    """Without them an L of three cells takes two bricks."""
    colour = np.full((1, 2, 2), RED)
    colour[0, 1, 1] = COLOUR_EMPTY
    counts = [
        len(METHODS["standard"](grid_of(colour), catalogue, np.random.default_rng(0)))
        for catalogue in (load_catalogue(), without_corners(load_catalogue()))
    ]
    assert counts == [1, 2]


def test_goals_count_models() -> None:
    """Four of five models suffice where that is the goal; a mean is one figure; limits belong to it."""
    models = {str(value): {"standard": {"figure": float(value)}} for value in range(5)}
    goal = layout_goals.Goal("H", "", layout_goals.our("figure"), 3)
    assert layout_goals.row_of(goal, models, "")["met"] is False
    most = layout_goals.Goal("H", "", layout_goals.our("figure"), 3, share=0.8)
    row = layout_goals.row_of(most, models, "")
    assert (row["met"], row["not_by"], row["worst"]) == (True, "4", 4.0)
    mean = layout_goals.Goal("H", "", layout_goals.our("figure"), 2, most=False, mean=True)
    assert layout_goals.row_of(mean, models, "")["met"] is True


def test_peer_gets_the_cells_as_they_are() -> None:
    """By x, y and layer; any colour and nothing have the peer's numbers."""
    codes = peer.codes_of(grid_of(np.array([[[RED, COLOUR_ANY, COLOUR_EMPTY], [WHITE, WHITE, RED]]])))
    assert codes.shape == (3, 2, 1)
    assert codes[:, 0, 0].tolist() == [RED, peer.ANY, peer.EMPTY]
    assert codes[:, 1, 0].tolist() == [WHITE, WHITE, RED]


def stand_in(folder: Path, body: str) -> Path:
    """Write a program that takes the arguments of a Python and runs a few lines instead."""
    program = folder / "peer_python"
    program.write_text(f"#!{sys.executable}\nimport sys, json\n{body}\n", encoding="utf-8")
    program.chmod(0o755)
    return program


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a script with a shebang")
def test_peer_that_fails_is_one_sentence(tmp_path: Path) -> None:
    """What it says last is the end; one that takes too long is none."""
    grid = grid_of(np.full((1, 2, 2), RED))
    with pytest.raises(BuildError, match="no such strategy"):
        peer.laid_by_peer(stand_in(tmp_path, "sys.exit('no such strategy')"), grid, "x", "bare")
    slow = stand_in(tmp_path, "import time; time.sleep(60)")
    assert peer.laid_by_peer(slow, grid, "x", "whole", limit=0.2) is None


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a script with a shebang")
def test_layouts_command(tmp_path: Path) -> None:
    """All methods on a box: no faults, percentages of 100, and a peer that lays unit bricks loses by its count."""
    trimesh.creation.box([0.48, 0.48, 0.48]).export(tmp_path / "cube.glb")
    facts = "{'version': '0', 'bricks': 10**4, 'seconds': 10**3, 'components': 1, 'floating': 0}"
    python = stand_in(tmp_path, f"print('noise'); print(json.dumps({facts}))")
    arguments = ["layouts", tmp_path / "cube.glb", "--width", 6, "--peer", python, "--out", tmp_path]
    assert benchmark.main([*map(str, arguments)]) == 0
    tables = json.loads((tmp_path / "layouts.json").read_text(encoding="utf-8"))["tables"]
    for name, rows in tables.items():
        with (tmp_path / f"{name}.csv").open(newline="", encoding="utf-8") as file:
            assert len(list(csv.DictReader(file))) == len(rows)
    assert [row["method"] for row in tables["layouts"]] == list(METHODS)
    assert all(row["faults"] == 0 and row["to_bound"] >= 1 for row in tables["layouts"])
    shells = {row["hollowing"]: row["hor"] for row in tables["table_3"]}
    assert shells["shell of 2"] == pytest.approx(2 * 2 * 1 / (6 * 6 * 5))
    assert shells["shell of 1 and columns"] > shells["shell of 2"]
    ours = [row["nb"] for row in tables["table_3"] if row["method"] == "standard"]
    assert [row["all"] for row in tables["table_1_counts"] if row["colour"] == "all"] == ours
    assert [row["sum_met"] for row in tables["table_1"]][-1] is True
    assert {row["strategy"] for row in tables["layouts_peer"]} == set(peer.STRATEGIES)
    assert all(row["met"] for row in tables["layouts_goals"] if row["goal"] == "peer")
    [run] = tables["layouts_run"]
    assert (run["width"], run["seed"], run["open_tilings"]) == (6, 0, tiling.OPEN)
