"""Cover, signs, parts, last page."""

from __future__ import annotations

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from legorize_addon.core.building.steps import Kind
from legorize_addon.core.instructions import front_pages
from legorize_addon.core.instructions.canvas import Group, Text
from legorize_addon.core.instructions.fonts import width
from legorize_addon.core.instructions.front_pages import (
    DISCLAIMER,
    SUPPORT_PARTS,
    cover,
    how_to_read,
    last_page,
    parts_pages,
)
from legorize_addon.core.instructions.lettering import Title
from legorize_addon.core.instructions.paper import MARGIN, PAPERS
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.progress import duration
from legorize_addon.core.shopping.shopping_list import shopping_list
from legorize_addon.core.supports.assembly_plan import plan_assembly
from tests.core.any_bricks import CATALOGUE, table
from tests.core.instructions.built import PART, arm, leaning, pair
from tests.core.instructions.test_panels import panels_of

A4 = PAPERS["A4"]


def texts(items):
    """Yield all texts of a page."""
    for item in items:
        if isinstance(item, Group):
            yield from texts(item.items)
        elif isinstance(item, Text):
            yield item.text


def test_the_cover_tells_size_parts_steps_and_time():
    """The arm is 13 studs wide, 4 deep, 8 bricks high."""
    plan = arm()
    shown = list(texts(cover(panels_of(plan), Title("Arm"), A4).items))
    bricks = int((~plan.temporary).sum())
    assert "Arm" in shown
    assert "10 x 3 x 8 cm" in shown
    assert f"{bricks} bricks" in shown
    assert f"{len(plan.steps)} steps" in shown
    # the same time as the report's, which counts what is taken out, too
    seconds = shopping_list(Assembly(plan.bricks, CATALOGUE), moves=len(plan.moves)).seconds
    assert f"about {duration(seconds)}" in shown
    assert f"with {plan.temporary.sum()} support bricks to take out" in shown


def test_the_cover_of_a_brick_is_in_the_singular():
    """One brick is one kind in one colour, put down in one step."""
    one = plan_assembly(Assembly(table([(PART["3001"], 0, 0, 0, 0, 4, 0, 0, 0)]), CATALOGUE), deepest=0)
    shown = list(texts(cover(panels_of(one), Title("One"), A4).items))
    assert {"1 brick", "1 kind in 1 colour", "1 step", "no supports"} <= set(shown)


@pytest.mark.parametrize("model", [arm, pair])
def test_the_parts_list_has_all_bricks(model):
    """The counts add up to the bricks of the model, and those of supports to the supports."""
    plan = model()
    shown = [text for page in parts_pages(panels_of(plan), A4, 3) for text in texts(page.items)]
    heads = [row for row, text in enumerate(shown) if text in ("Parts", SUPPORT_PARTS)]
    lists = [shown[low:high] for low, high in pairwise([*heads, len(shown)])]
    counts = [sum(int(text[:-1]) for text in one if text.endswith("x") and text[:-1].isdigit()) for one in lists]
    expected = [int((~plan.temporary).sum()), int(plan.temporary.sum())]
    assert counts == [count for count in expected if count]
    assert [one[1] for one in lists] == [f"{count} brick{'s' * (count != 1)}" for count in counts]


@pytest.mark.parametrize("name", ["A4", "Letter"])
def test_headings_keep_away_from_the_list_before(name):
    """The heading of the supports is a good deal below the last line above it, and what follows is below it."""
    [page] = parts_pages(panels_of(arm()), PAPERS[name], 3)
    groups = [item for item in page.items if isinstance(item, Group)]
    [heading] = [item for item in page.items if isinstance(item, Text) and item.text == SUPPORT_PARTS]
    lows = [group.matrix[5] + max(each.y for each in group.items if isinstance(each, Text)) for group in groups]
    above = max(low for low in lows if low < heading.y)
    assert heading.y - heading.size - above >= 5
    assert any(group.matrix[5] > heading.y for group in groups)


def test_figures_of_the_cover_stand_apart():
    """As far behind a long figure as behind a short one, for readers whose letters are wider."""
    page = cover(panels_of(arm()), Title("Arm"), A4)
    figures = [item for item in page.items if isinstance(item, Text) and item.y > A4.height - 34]
    values, whats = figures[::2], figures[1::2]
    ends = [
        value.x + max(width(value.text, value.size, bold=True), width(what.text, what.size))
        for value, what in zip(values, whats, strict=True)
    ]
    gaps = np.array([value.x for value in values[1:]]) - ends[:-1]
    assert gaps.min() > 10
    assert np.ptp(gaps) < 1e-9
    assert ends[-1] < A4.width


def test_long_lists_go_on(monkeypatch):
    """Lists that do not fit on a page go on on the next one, with their heading; numbers go on, too."""
    [page] = parts_pages(panels_of(arm()), A4, 3)
    monkeypatch.setattr(front_pages, "_CELL", (120.0, 80.0))
    pages = list(parts_pages(panels_of(arm()), A4, 3))
    assert len(pages) > 1
    assert pages[0].title == "Parts"
    assert [list(texts(each.items))[-1] for each in pages] == [str(3 + number) for number in range(len(pages))]
    entries = [text for each in pages for text in texts(each.items) if text.endswith("x") and text[:-1].isdigit()]
    assert sorted(entries) == sorted(text for text in texts(page.items) if text.endswith("x") and text[:-1].isdigit())


def test_only_signs_that_occur_are_explained():
    """A model without supports and pieces needs few words."""
    with_all = " ".join(texts(how_to_read(panels_of(arm()), A4, 2).items))
    assert "Supports" in with_all
    plan = pair()
    assert plan.temporary.sum() == 0
    without = " ".join(texts(how_to_read(panels_of(plan), A4, 2).items))
    assert "Supports" not in without
    assert "by itself" in without
    assert "Hold what" not in without
    assert "Hold what" in " ".join(texts(how_to_read(panels_of(leaning()), A4, 2).items))


def test_remarks_stand_below_the_signs():
    """Each in as many lines as it needs, none over another or over the rim."""
    remarks = ["Feet of 2 studs are part of the model. " * 6, "Something else."]
    page = how_to_read(panels_of(arm()), A4, 2, remarks)
    shown = " ".join(texts(page.items))
    assert all(each.strip() in shown for each in remarks)
    lines = [item for item in page.items if isinstance(item, Text) and item.size == 5]
    heights = [line.y for line in lines]
    assert heights == sorted(heights)
    assert min(np.diff(heights)) >= 6
    assert all(width(line.text, 5) <= A4.width - 20 for line in lines)


def test_the_last_page_has_the_line_about_the_trademark():
    """One line, and two pictures from other sides."""
    page = last_page(panels_of(arm()), Title("Arm"), A4)
    shown = list(texts(page.items))
    assert DISCLAIMER in shown
    assert "trademark" in DISCLAIMER
    assert len([item for item in page.items if isinstance(item, Group)]) == 2


def test_long_names_are_cut():
    """A name that does not fit on the cover is cut."""
    shown = list(texts(cover(panels_of(arm()), Title("very long name " * 20), A4).items))
    assert shown[0].endswith("...")
    assert np.all([len(text) < 200 for text in shown])


@pytest.mark.parametrize("name", ["A4", "Letter"])
def test_all_signs_and_remarks_fit_on_their_page(name):
    """A model that has every sign, and feet on both axes: nothing is off the page, nor on what is above it."""
    plan = panels_of(arm())
    every = SimpleNamespace(
        temporary=plan.temporary,
        tint=plan.tint,
        steps=SimpleNamespace(
            moves=SimpleNamespace(pressed=np.array([True])), submodels=[SimpleNamespace(kind=Kind.SUBASSEMBLY)]
        ),
        held={1},
        shots=[0],
        loose=lambda shot: True,
        may_lift=lambda shot: True,
    )
    page = how_to_read(every, PAPERS[name], 2, ["Feet of two studs carry it at the front and at the back, " * 4] * 2)
    lines = [item.y for item in page.items if isinstance(item, Text) and item.size == 5]
    assert max(lines) < PAPERS[name].height - MARGIN
    assert np.diff(lines).min() > 5
