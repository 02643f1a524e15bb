"""The paper's tables of one model."""

from __future__ import annotations

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import SUPPORTS, Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.report.paper_tables import paper_tables
from legorize_addon.core.report.report import report
from legorize_addon.core.settings import Settings
from tests.core.overhanging import overhanging

CATALOGUE = load_catalogue()


@pytest.fixture(scope="module")
def built():
    """Return a model with supports."""
    return legorize(overhanging(100.0)["t_shape"], Settings(width=32))


def rows(build, number):
    """Return the rows of a table."""
    text = paper_tables(build, CATALOGUE, name="tee")[f"table_{number}.csv"]
    return list(csv.DictReader(io.StringIO(text)))


@pytest.mark.parametrize("number", [1, 2])
def test_percentages_sum_up(built, number):
    """The volumes of all parts are the whole, and the counts are those of the report."""
    found = rows(built, number)
    assert sum(float(row["volume_percent"]) for row in found) == pytest.approx(100, abs=0.01)
    facts = report(built, CATALOGUE, version="1", mm_per_unit=1000.0)
    stay = int(np.isin(built.bricks.role, SUPPORTS).sum())
    wanted = {1: facts["counts"]["bricks"] - stay, 2: facts["supports"]["removed"] + stay}
    assert sum(int(row["count"]) for row in found) == wanted[number]


def test_one_row_for_the_model(built):
    """Tables 3 and 4 hold the report's figures."""
    facts = report(built, CATALOGUE, version="1", mm_per_unit=1000.0)
    [layout], [supports, *_] = rows(built, 3), rows(built, 4)
    assert float(layout["hollow_ratio"]) == facts["hollow_ratio"]
    assert int(layout["bricks"]) == facts["counts"]["bricks"]
    assert float(layout["seconds"]) > 0
    assert (supports["model"], supports["method"], supports["supports"]) == ("tee", "tree", "taken out")
    assert int(supports["bricks"]) == facts["supports"]["removed"] > 0
    assert float(supports["weight_g"]) == facts["supports"]["removed_mass_g"]


def test_supports_that_stay_are_a_row_of_their_own(built):
    """They are counted apart from those that are taken out; where none are taken out, theirs is the only row."""
    role = built.bricks.role.copy()
    role[:3] = (Role.SUPPORT_INSIDE, Role.SUPPORT_KEPT, Role.SUPPORT_INSIDE)
    staying = replace(built, assembly=Assembly(replace(built.bricks, role=role), CATALOGUE))
    found = {row["supports"]: row for row in rows(staying, 4)}
    assert list(found) == ["taken out", "stay"]
    assert found["taken out"]["bricks"] == str(len(built.supports.removed))
    assert found["stay"]["bricks"] == "3"
    assert float(found["stay"]["weight_g"]) == pytest.approx(CATALOGUE.mass[built.bricks.part[:3]].sum(), abs=0.01)


def test_model_without_supports_has_no_tables_of_them():
    """There is nothing to compare."""
    build = legorize(overhanging(100.0)["arch"], Settings(width=12, supports="none"))
    assert sorted(paper_tables(build, CATALOGUE, name="arch")) == ["table_1.csv", "table_3.csv"]
