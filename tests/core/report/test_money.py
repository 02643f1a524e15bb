"""What a model costs in report and lists."""

from __future__ import annotations

import csv
import io

import pytest

from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.progress import silent
from legorize_addon.core.report.money import price_facts
from legorize_addon.core.report.outputs import output_texts
from legorize_addon.core.settings import Settings
from tests.core.solids import box
from tests.core.textured import painted

CATALOGUE = load_catalogue()


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    """Return a box built by a price file that knows two lots."""
    path = tmp_path_factory.mktemp("prices") / "prices.csv"
    path.write_text("part;colour;price\n3001;4;0,10 EUR\n3004;4;0,05 EUR\n")
    mesh = painted(box([0.0, 0.0, 0.0], [4.0, 3.0, 2.0]), 4)
    return legorize(mesh, Settings(width=6, prices=str(path), goal="cheapest"))


def test_sums_of_report_lists_and_remarks_agree(build):
    """The report, the list for people and the remark name one sum, and the bound is not above it."""
    facts = price_facts(build, CATALOGUE, silent)
    texts = output_texts(build, CATALOGUE, {}, "box")
    rows = list(csv.DictReader(io.StringIO(texts["parts.csv"])))
    assert sum(float(row["cost"]) for row in rows) == pytest.approx(facts["model"], abs=1e-3)
    assert f"the model costs {facts['model']:.2f} EUR" in " ".join(build.notes)
    assert 0 < facts["least_possible"] <= facts["model"] + 1e-9
    assert facts["at_most_more_percent"] == pytest.approx(
        100 * (facts["model"] / facts["least_possible"] - 1), abs=0.02
    )
    assert facts["currency"] == "EUR"
    known = {("3001", "4"), ("3004", "4")}
    guessed = [row for row in rows if (row["part"], row["colour"]) not in known]
    assert facts["estimated_bricks"] == sum(int(row["count"]) for row in guessed)
    assert facts["estimated"] == pytest.approx(sum(float(row["cost"]) for row in guessed), abs=1e-3)


def test_nothing_is_proven_unless_wanted(build):
    """Without the bound, its keys are empty."""
    facts = price_facts(build, CATALOGUE, None)
    assert facts["least_possible"] is facts["at_most_more_percent"] is None


def test_without_a_price_file_nothing_is_said():
    """No prices in the lists, no facts, no remark."""
    plain = legorize(painted(box(), 4), Settings(width=3))
    assert price_facts(plain, CATALOGUE, None) is None
    assert not [note for note in plain.notes if "price" in note]
    assert next(csv.DictReader(io.StringIO(output_texts(plain, CATALOGUE, {}, "box")["parts.csv"])))["cost"] == ""
