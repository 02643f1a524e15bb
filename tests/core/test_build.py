"""The result of a run: its bricks and their graph are those of its assembly."""

from __future__ import annotations

from legorize_addon.core.model.bricks import Role
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.solids import box


def test_bricks_are_those_of_the_assembly():
    """Nothing that is taken out again is among them, and the graph is theirs."""
    build = legorize(box((0, 0, 0), (60, 60, 60)), Settings(width=6))
    assert build.bricks is build.assembly.bricks
    assert build.graph is build.assembly.graph
    assert len(build.graph.component) == len(build.bricks)
    assert not (build.bricks.role == Role.SUPPORT_OUTSIDE).any()
