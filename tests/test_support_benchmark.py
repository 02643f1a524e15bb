"""The benchmark of supports: its fixtures and its tables."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

trimesh = pytest.importorskip("trimesh", reason="benchmarks need the dependency group checks")
pytest.importorskip("shapely", reason="benchmarks need the dependency group checks")

from scripts import benchmark  # noqa: E402 - after the packages that may be missing
from tests.core.overhanging import overhanging  # noqa: E402


@pytest.mark.parametrize("name", ["table", "t_shape", "arch", "box_car"])
def test_fixtures_are_closed_and_stand(name: str) -> None:
    """Each is watertight, as long as asked for, and stands on less than it covers."""
    mesh = overhanging(250.0)[name]
    body = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    assert body.is_watertight
    assert body.is_winding_consistent
    np.testing.assert_allclose(np.ptp(mesh.vertices, axis=0).max(), 250.0)
    under = (mesh.vertices[mesh.faces][..., 2] == 0).all(axis=1)
    assert 0 < body.area_faces[under].sum() < 0.5 * np.prod(np.ptp(mesh.vertices, axis=0)[:2])


def test_supports_command(tmp_path: Path) -> None:
    """Every kind is weighed on every model, trees against the reference, and percentages are whole."""
    path = tmp_path / "bar.glb"
    path.write_bytes(trimesh.creation.box([2.0, 0.5, 1.0]).export(file_type="glb"))
    assert benchmark.main(["supports", str(path), "--width", "24", "--repeats", "1", "--out", str(tmp_path)]) == 0
    tables = json.loads((tmp_path / "supports.json").read_text(encoding="utf-8"))["tables"]
    ways = ["full", "sparse", "columns", "beams", "tree", "tree as built"]
    models = ["bar", "table", "t_shape", "arch", "box_car"]
    weighed = tables["supports_table_4"]
    assert [(row["model"], row["supports"]) for row in weighed] == [(model, way) for model in models for way in ways]
    assert all((row["bricks"] > 0) == (row["weight_g"] > 0) for row in weighed)
    assert all((row["bricks"] > 0) == (row["contacts"] > 0) for row in weighed if row["supports"] == "full")
    bar, table, *_, median = tables["supports_trees"]
    assert bar["tree_bricks_to_full"] is None
    trees = {row["model"]: row["bricks"] for row in weighed if row["supports"] == "tree as built"}
    full = {row["model"]: row["bricks"] for row in weighed if row["supports"] == "full"}
    assert table["tree_bricks_to_full"] == trees["table"] / full["table"]
    assert median["met"] == (median["tree_bricks_to_full"] <= 0.45 and median["tree_weight_to_full"] <= 0.5)
    bricks = {(row["model"], row["supports"]): row["bricks"] for row in weighed}
    for counts, shares in zip(tables["supports_table_2"], tables["supports_table_2_volume"], strict=True):
        n = bricks[counts.pop("model"), counts.pop("supports")]
        assert sum(counts.values()) == n
        percent = [shares[size] for size in counts]
        assert sum(percent) == pytest.approx(100, abs=0.01) if n else set(percent) == {None}
