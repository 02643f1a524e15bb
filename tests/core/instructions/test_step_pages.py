"""The pages of the steps."""

from __future__ import annotations

import pytest

from legorize_addon.core.instructions import step_pages as module
from legorize_addon.core.instructions.canvas import Group, Text
from legorize_addon.core.instructions.paper import PAPERS, Cell
from legorize_addon.core.instructions.picture import MM
from legorize_addon.core.instructions.step_pages import LARGEST, scales, step_pages
from tests.core.instructions.built import arm, pair
from tests.core.instructions.test_panels import panels_of


def numbers(items):
    """Yield the large texts, which are the numbers of the steps, in the order in which they are drawn."""
    for item in items:
        if isinstance(item, Group):
            yield from numbers(item.items)
        elif isinstance(item, Text) and item.bold and item.size == 9.0:
            yield item.text


@pytest.mark.parametrize("paper", PAPERS.values())
@pytest.mark.parametrize("model", [arm, pair])
def test_all_steps_come_in_order(model, paper):
    """No step is left out, none comes twice, and pages know which they begin with."""
    plan = model()
    pages = list(step_pages(panels_of(plan), paper, 5))
    shown = [number for page in pages for number in numbers(page.items)]
    steps = [int(number.rstrip("abcdefgh")) for number in shown]
    assert steps == sorted(steps)
    assert set(steps) == set(range(1, len(plan.steps) + 1))
    assert len(set(shown)) == len(shown)
    for page in pages:
        assert next(numbers(page.items)).rstrip("abcdefgh") == str(page.step + 1)
    assert pages[0].title == "Step 1"


def test_small_pictures_share_a_page():
    """Steps of a small model do not take a page each."""
    plan = arm()
    assert len(list(step_pages(panels_of(plan), PAPERS["A4"], 1))) < len(plan.steps)


def test_nothing_jumps():
    """All steps on one table have one scale, no larger than is told."""
    panels = panels_of(pair())
    found = [panel for shot in panels.shots for panel in panels.of(shot)]
    made = scales(panels, found, PAPERS["A4"])
    assert set(made) == {each.number for each in panels.steps.submodels}
    assert all(0 < scale <= LARGEST for scale in made.values())


def test_progress_rises_to_the_end():
    """Progress is told, and rises."""
    told = []
    list(step_pages(panels_of(arm()), PAPERS["A4"], 1, lambda _, share: told.append(share)))
    assert told == sorted(told)
    assert told[0] == 0.0
    assert told[-1] > 0.4


def test_pictures_of_large_models_fill_their_pages(monkeypatch):
    """A picture that has a page for itself is larger than the scale of its table, if that is small."""
    monkeypatch.setattr(module, "scales", lambda panels, *_: dict.fromkeys(range(len(panels.steps.submodels)), 0.05))
    monkeypatch.setattr(module, "READABLE", 0.3)
    monkeypatch.setattr(Cell, "halves", None)
    pages = list(step_pages(panels_of(arm()), PAPERS["A4"], 1))
    for page in pages:
        [panel] = [item for item in page.items if isinstance(item, Group)]
        *_, picture = panel.items
        assert picture.matrix[0] == pytest.approx(0.3 * MM)
