"""What became of a mesh: keys that only a model of a mesh has, and numbers that agree with its cells."""

from __future__ import annotations

import json

import pytest

from legorize_addon.core.model.bricks import Role
from legorize_addon.core.report.mesh_facts import facts_of_mesh, hollow_ratio
from tests.core.report.test_report import build_of


def test_facts_are_plain_and_of_the_mesh() -> None:
    """A block of 6 x 4 x 2 bricks: its extent, its cells, its transform, as plain JSON."""
    build = build_of([("3001", 1, 1, 0, 4, Role.SHELL)])
    facts = facts_of_mesh(build, 1000.0)
    assert json.loads(json.dumps(facts)) == facts
    assert facts["grid"] == {"x": 6, "y": 4, "layers": 2}
    assert facts["hollowing"]["solid"] == 6 * 4 * 2 * 3
    assert facts["input"]["triangles"] == 1
    assert len(facts["mesh_to_ldraw"]) == 4


def test_hollow_ratio_is_the_share_without_bricks() -> None:
    """Of 144 cells a 2 x 4 brick fills 24; a support fills none that count."""
    rows = [("3001", 1, 1, 0, 4, Role.SHELL)]
    assert hollow_ratio(build_of(rows)) == pytest.approx(1 - 24 / 144)
    assert hollow_ratio(build_of([*rows, ("3001", 1, 1, 3, 4, Role.SUPPORT_INSIDE)])) == pytest.approx(1 - 24 / 144)
