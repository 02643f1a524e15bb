"""The command that makes the paper's tables, and the models of its five kinds."""

from __future__ import annotations

import csv
import json
from types import SimpleNamespace

import numpy as np
import pytest

from legorize_addon.core.mesh.triangle_mesh import repair
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts import benchmark
from scripts.benchmarks.kept import Kept
from scripts.research import accuracy, claim_figures, paper_case, paper_tables
from scripts.research.claims import claims
from scripts.research.five_kinds import KINDS
from scripts.research.layout_goals import GREEDY
from scripts.research.layouts import METHODS, SHELL
from scripts.research.paper_case import FIELD, LEARNED, NO_OPTIONAL, PAPER_RULE
from scripts.research.paper_tables import TITLES
from tests.core.overhanging import overhanging
from tests.core.solids import box


def write_obj(path, mesh):
    """Write a mesh as a file."""
    lines = [f"v {x} {z} {-y}" for x, y, z in mesh.vertices.tolist()]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in mesh.faces.tolist()]
    path.write_text("\n".join(lines), encoding="utf-8")
    return str(path)


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    """Return the rows of all tables of two models, one of which needs no support, and the JSON file."""
    folder = tmp_path_factory.mktemp("tables")
    quick = pytest.MonkeyPatch()
    # those that search, and the machine, take longer than all others together
    some = [*list(paper_case.methods())[:3], (METHODS[GREEDY], GREEDY, SHELL)]
    quick.setattr(paper_case, "methods", lambda: some)
    quick.setattr(claim_figures, "TRUTH", 64)
    quick.setattr(accuracy, "POINTS", 2000)
    meshes = {"table": overhanging(100.0)["table"], "block": box((0, 0, 0), (60, 60, 12))}
    paths = [write_obj(folder / f"{name}.obj", mesh) for name, mesh in meshes.items()]
    assert benchmark.main(["tables", *paths, "--width", "12", "--seed", "3", "--out", str(folder / "out")]) == 0
    quick.undo()
    found = {}
    for path in (folder / "out").glob("*.csv"):
        with path.open(encoding="utf-8", newline="") as file:
            found[path.stem] = list(csv.DictReader(file))
    return found, json.loads((folder / "out" / "tables.json").read_text(encoding="utf-8"))


def test_all_tables_are_written(tables):
    """CSV and JSON say the same, with seed, version and width."""
    found, facts = tables
    assert set(found) == set(TITLES) == set(facts["tables"])
    [run] = facts["tables"]["tables_run"]
    assert (run["seed"], run["width"]) == (3, 12)
    assert run["models"] == "table, block"
    assert "plates none" in run["bricks_alone"]
    assert "layout learned" in run["as_published"]
    assert run["legorize"]
    assert {name: len(rows) for name, rows in found.items()} == {
        name: len(rows) for name, rows in facts["tables"].items()
    }


def test_a_run_goes_on_part_by_part(tmp_path, monkeypatch):
    """What a run without time leaves out the next one measures, and what was measured is not measured again."""
    calls = []
    rows = {"one": {"tables_3": []}, "two": {"tables_3": []}}
    monkeypatch.setattr(
        paper_tables, "parts", lambda case: {name: lambda name=name: calls.append(name) or rows[name] for name in rows}
    )
    options = paper_case.Options(12, 0, 1)

    def found(minutes):
        return paper_tables.kept_parts(tmp_path / "model.obj", options, Kept(tmp_path, minutes))

    Kept(tmp_path, 0.0).row("model-12-0-1-one", lambda: calls.append("before") or {"tables_3": "[]"})
    assert found(-1.0) == {}
    assert calls == ["before"]
    rows["two"] = {
        "tables_3": [{"nb": 3, "mass_g": 2.0, "tc_of": "layout"}],
        "tables_claim_figures": [{"h": 1}, {"g": 2}],
    }
    whole = found(0.0)
    assert calls == ["before", "two"]
    start = {"model": "model", "studs": 12}
    assert whole["tables_claim_figures"] == [start | {"h": 1, "g": 2}]
    assert whole["tables_3"] == [start | {"nb": 3, "mass_g": 2.0, "tc_of": "layout", "more_bricks": 0, "more_g": 0}]


def test_methods_are_those_of_the_paper_and_ours():
    """Ours by three rules, the learned fill by two, the methods of the field by theirs and on our cells."""
    ways = [(method, rule) for _, method, rule in paper_case.methods()]
    assert len(ways) == len(set(ways))
    assert [method for method, _ in ways].count(LEARNED) == 2
    for name in FIELD:
        assert [method for method, _ in ways].count(name) == 2
        assert (name, NO_OPTIONAL) in ways
    assert ways[:3] == [("standard", rule) for rule in ("ours", NO_OPTIONAL, PAPER_RULE)]


def test_rows_compare_with_the_first_one(tables):
    """Each row of Table 3 is sound, and says how much more it takes than our layout with our rule."""
    rows = [row for row in tables[1]["tables"]["tables_3"] if row["model"] == "block"]
    assert [row["method"] for row in rows] == [
        *("standard", "standard", "standard", GREEDY, "default, whole build", "as published, whole build"),
    ]
    assert not any(row["faults"] for row in rows)
    assert all(0 <= row["hor"] < 1 and row["nb"] > 0 and row["mass_g"] > 0 for row in rows)
    ours, required = rows[:2]
    assert ours["more_bricks"] == ours["more_g"] == 0
    assert required["more_bricks"] == required["nb"] - ours["nb"]
    assert required["hor"] >= ours["hor"]


def test_supports_are_of_models_that_need_them(tables):
    """Tables 2 and 4 know the table alone; its trees as built are those that are taken out; percentages are whole."""
    found = tables[1]["tables"]
    assert {row["model"] for row in found["tables_4"]} == {"table"} == {row["model"] for row in found["tables_2"]}
    built = {row["supports"]: row["bricks"] for row in found["tables_4"]}["tree as built"]
    assert built > 0
    assert all(row["bricks"] > 0 and row["weight_g"] > 0 for row in found["tables_4"])
    for row in found["tables_2"]:
        assert sum(value for name, value in row.items() if name.count("x") == 2) == pytest.approx(100)
    assert {row["supports"] for row in found["tables_4_built"]} <= {"taken out", "stay inside", "stay outside"}


def test_models_with_supports_of_different_kinds():
    """A kind that one model does not use is nothing there, and the rows are those of one table."""
    rows = paper_tables.same_columns([{"model": "one", "1x1": 3}, {"model": "other", "1x1": 2, "2x4x3": 1}])
    assert rows == [{"model": "one", "1x1": 3, "2x4x3": 0}, {"model": "other", "1x1": 2, "2x4x3": 1}]


def rows_of(model, bricks, tree):
    """Return rows of Tables 3, 1 and 4 of a made-up model."""
    row = {"model": model, "hor": 0.1, "tc_s": 1.0, "components": 1, "floating": 0, "nb": 100}
    layouts = [row | {"method": "standard", "hollowing": rule} for rule in ("ours", NO_OPTIONAL, PAPER_RULE)]
    layouts += [
        row | {"method": name, "hollowing": rule, "nb": bricks, "tc_s": 5.0, "floating": 2}
        for name in FIELD
        for rule in ("shell of 2", NO_OPTIONAL)
    ]
    layouts.append(row | {"method": "default, whole build", "hollowing": "ours"})
    sizes = {f"Brick {size}": 10.0 for size in ("1 x 1", "1 x 2", "2 x 4", "2 x 6", "2 x 8")}
    weights = {"full": 100.0, "sparse": 70.0, "tree": tree}
    supports = [{"model": model, "supports": way, "weight_g": weight} for way, weight in weights.items()]
    return layouts, [{"model": model, "colour": "all"} | sizes], supports


def figures_of(model, **others):
    """Return what else is measured of a made-up model that keeps all claims but for what is given."""
    saves = dict.fromkeys((f"h12_saves_of_{name}" for name in ("largest", "random", "chance", "shuffled")), 0.5)
    row = {"model": model, "h2_points_share": 0.1, "h10_iou": None, "h10_sound_met": True} | saves
    row |= {"h6_singles": 10, "h6_singles_largest_first": 20, "h6_free_share": 0.01}
    row |= {f"h1_{way}_mm": 4.0 for way in ("bricks", "bricks_centres", "plates_centres")} | {"h1_plates_mm": 3.0}
    row |= {f"h1_{way}_iou": 0.8 for way in ("bricks", "bricks_centres", "plates", "plates_centres")}
    return row | {"h9_stuck": 0, "h9_split_saves": None} | others


def test_claims_are_judged_on_every_model():
    """Thirteen claims in order; a model with more bricks, or heavier trees, is named."""
    good, bad = rows_of("good", 110, 59.0), rows_of("bad", 101, 60.0)
    layouts, volumes, supports = (one + other for one, other in zip(good, bad, strict=True))
    others = [figures_of("good", h9_split_saves=0.2), figures_of("bad")]
    found = {row["claim"]: row for row in claims(layouts, volumes, supports, others, FIELD)}
    assert list(found) == [f"H{number}" for number in range(1, 14)]
    assert found["H5"]["not_by"] == found["H8"]["not_by"] == "bad"
    assert found["H5"]["met"] is False
    assert {row["kept_by"] for name, row in found.items() if name not in ("H5", "H8")} == {"2 of 2"}


@pytest.mark.parametrize(
    ("claim", "figure"),
    [
        ("H1", {"h1_plates_mm": 3.1}),
        ("H1", {"h1_bricks_centres_mm": 3.9}),
        ("H1", {"h1_plates_centres_iou": 0.9}),
        ("H2", {"h2_points_share": 0.21}),
        ("H6", {"h6_singles": 11}),
        ("H6", {"h6_free_share": 0.04}),
        ("H9", {"h9_stuck": 1}),
        ("H9", {"h9_split_saves": 0.1}),
        ("H10", {"h10_sound_met": False}),
        ("H10", {"h10_iou": 0.89}),
        ("H12", {"h12_saves_of_largest": 0.07}),
        ("H12", {"h12_saves_of_random": 0.3}),
        ("H12", {"h12_saves_of_shuffled": 0.04}),
    ],
)
def test_claims_beside_the_tables(claim, figure):
    """Each figure that misses its goal breaks its claim and no other one."""
    layouts, volumes, supports = rows_of("model", 110, 59.0)
    rows = claims(layouts, volumes, supports, [figures_of("model", **figure)], FIELD)
    assert [row["claim"] for row in rows if not row["met"]] == [claim]


def test_open_meshes_are_not_compared_with_centre_points():
    """Only their distances count."""
    none = {f"h1_{way}_{what}": None for way in ("bricks_centres", "plates_centres") for what in ("mm", "iou")}
    layouts, volumes, supports = rows_of("model", 110, 59.0)
    rows = claims(layouts, volumes, supports, [figures_of("model", **none)], FIELD)
    assert all(row["met"] for row in rows)


def test_voxelization_takes_so_many_samples_that_it_errs_no_more(monkeypatch):
    """The share of the points is that of the samples with which it is as good."""

    def dense(cut, solid, seen, points, seed=0):
        assert isinstance(points, int)
        return cut.bricks()[seen] - (points < 32 * seen.sum())

    monkeypatch.setattr(claim_figures, "_dense", dense)
    given = SimpleNamespace(mesh=box((0, 0, 0), (60, 60, 12)), build=SimpleNamespace(settings=Settings(width=8)))
    row = claim_figures.FIGURES["H2"](given)
    assert row["h2_samples_a_voxel"] == 32
    assert row["h2_wrong"] == 0
    assert row["h2_wrong_by_samples"] == 1
    assert row["h2_points_share"] == row["h2_points"] / (32 * row["h2_surface_voxels"])


def test_figures_of_the_claims(tables):
    """A table of a hundred mm: plates help, supports come out, nothing is cut off, the machine beats chance."""
    found = {row["model"]: row for row in tables[1]["tables"]["tables_claim_figures"]}
    assert set(found) == {"table", "block"}
    row = found["table"]
    assert row["h1_plates_mm"] < row["h1_bricks_mm"]
    assert row["h10_iou"] is None
    assert 0 < row["h2_points_share"] < 0.2
    assert row["h9_stuck"] == 0
    assert row["h10_sound_met"]
    assert row["h12_saves_of_random"] > 0


@pytest.mark.parametrize("kind", list(KINDS))
def test_kinds_are_closed_and_coloured(kind):
    """Each is made of closed bodies that look outwards, in several colours, and stands on its lowest point."""
    mesh = KINDS[kind]()
    mended, repairs = repair(mesh)
    assert repairs.watertight
    corners = mesh.vertices[mesh.faces]
    assert np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() > 0
    assert len(mended.faces) > 100
    assert mesh.images[0].shape[1] >= 4


def test_small_kinds_are_built():
    """The fox stands in one piece."""
    build = legorize(KINDS["fox"](), Settings(width=12, layout="fast"))
    assert build.graph.n_components == 1
    assert build.stability.stable
