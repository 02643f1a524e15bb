"""The command that makes the paper's tables, and the models of its five kinds."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest

from legorize_addon.core.mesh.triangle_mesh import repair
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts import benchmark
from scripts.research import paper_tables
from scripts.research.claims import claims
from scripts.research.five_kinds import KINDS
from scripts.research.layout_goals import GREEDY
from scripts.research.layouts import METHODS, SHELL
from scripts.research.paper_tables import FIELD, LEARNED, NO_OPTIONAL, PAPER_RULE, TITLES
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
    some = [*list(paper_tables.methods())[:3], (METHODS[GREEDY], GREEDY, SHELL)]
    quick.setattr(paper_tables, "methods", lambda: some)
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
    assert run["legorize"]
    assert {name: len(rows) for name, rows in found.items()} == {
        name: len(rows) for name, rows in facts["tables"].items()
    }


def test_methods_are_those_of_the_paper_and_ours():
    """Ours by three rules, the learned fill by two, the methods of the field by theirs and on our cells."""
    ways = [(method, rule) for _, method, rule in paper_tables.methods()]
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


def test_claims_are_judged_on_every_model():
    """Twelve claims in order; a model with more bricks, or heavier trees, is named."""
    good, bad = rows_of("good", 110, 59.0), rows_of("bad", 101, 60.0)
    found = {row["claim"]: row for row in claims(*(one + other for one, other in zip(good, bad, strict=True)), FIELD)}
    assert list(found) == ["H1", "H2", "H3", "H4", "H5", "H7", "H8", "H9", "H10", "H11", "H12", "H13"]
    assert found["H5"]["not_by"] == found["H8"]["not_by"] == "bad"
    assert found["H5"]["met"] is False
    assert found["H3"]["kept_by"] == found["H11"]["kept_by"] == found["H13"]["kept_by"] == "2 of 2"
    assert all(row["met"] is None for row in found.values() if row["measured_by"] != "benchmark.py tables")


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
