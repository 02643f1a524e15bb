"""Sums are equal everywhere: each list, LDraw file, the building order and the report, read back by plain readers."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("trimesh", reason="model files are read by the dependency group checks")

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.catalogue import ASSETS, load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.report.outputs import output_texts
from legorize_addon.core.report.report import report
from legorize_addon.core.settings import Settings
from legorize_addon.core.shopping.formats import list_texts
from legorize_addon.core.shopping.shopping_list import shopping_list
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.purchase import price_file
from tests.core.any_bricks import table
from tests.core.shopping.plain_readers import check_sums, list_lots, rows_of

CATALOGUE = load_catalogue()
MODELS = Path(__file__).resolve().parents[3] / "shared" / "models"
SAMPLE = ASSETS / "sample.glb"


def run(path, settings):
    """Return the files of a run and its report."""
    build = legorize(read_mesh(path), settings)
    facts = report(build, CATALOGUE, version="1", mm_per_unit=1000.0)
    return output_texts(build, CATALOGUE, facts, path.stem), facts


@pytest.mark.parametrize("path", [SAMPLE, MODELS / "fox.glb"], ids=lambda path: path.stem)
def test_sums_of_models(path, tmp_path):
    """A model with supports, few lots and prices: whatever is written tells of the same bricks."""
    if not path.exists():
        pytest.skip("the model is not there")
    prices = str(price_file(tmp_path / "prices.csv", CATALOGUE))
    files, facts = run(path, Settings(width=10, layout="fast", prices=prices, few_lots=5.0))
    check_sums(files, facts)
    assert facts["counts"]["bricks"] > 20


def test_lines_that_a_shop_would_not_take():
    """Of 2,500 plates of a kind the shop gets three lines; of every list the sum is the same, one plate is spare."""
    plate, brick = CATALOGUE.part_row("3024"), CATALOGUE.part_row("3001")
    rows = [(plate, n % 50, n // 50, 0, 0, 4, 0, 0, 0) for n in range(2500)] + [(brick, 60, 0, 0, 0, 15, 0, 0, 0)]
    model, nothing = (shopping_list(Assembly(table(each), CATALOGUE), moves=0) for each in (rows, []))
    files = list_texts(model, nothing)
    for name, said in list_lots(files, "").items():
        assert said == {("3024", 4): 2500, ("3001", 15): 1}, name
    assert [int(row["quantity"]) for row in rows_of(files["pick-a-brick.csv"])] == [1, 999, 999, 502]
    assert not [name for name in files if name.startswith("support-")]
