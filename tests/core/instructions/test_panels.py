"""The pictures of all steps of a model."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.steps import Kind
from legorize_addon.core.instructions.lattice import FRONT, View
from legorize_addon.core.instructions.panel_layout import title_of
from legorize_addon.core.instructions.panels import Panels, built_at_once, submodel_names
from legorize_addon.core.instructions.shades import SUPPORT_TINT
from legorize_addon.core.instructions.sightlines import ENOUGH
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.supports.assembly_plan import plan_assembly
from tests.core.any_bricks import CATALOGUE, table
from tests.core.instructions.built import BRICK, LONG, PART, arm, pair

PLATE = PART["3024"]


def panels_of(plan):
    """Return the pictures of a model."""
    return Panels(plan.bricks, CATALOGUE, plan.steps, plan.temporary, SUPPORT_TINT)


@pytest.mark.parametrize("model", [arm, pair])
def test_pictures_show_all_bricks_well(model):
    """Each brick is new in one picture, listed there, and seen well enough."""
    panels = panels_of(model())
    listed = []
    for shot in panels.shots:
        found = panels.of(shot)
        assert [panel.letter for panel in found] == (["a", "b", "c", "d"][: len(found)] if len(found) > 1 else [""])
        assert [panel.last for panel in found] == [False] * (len(found) - 1) + [True]
        for panel in found:
            assert not np.isin(panel.new, panel.stays).any()
            if shot.step.action != Action.REMOVE:
                listed += panel.placed.tolist()
                shares = panel.shares[np.isin(panel.new, panel.placed)]
                assert (shares >= ENOUGH).all()
    assert sorted(listed) == list(range(len(panels.bricks)))


@pytest.mark.parametrize("model", [arm, pair])
def test_pictures_are_as_large_as_is_said(model):
    """The size by which pages are divided is that of the picture, without what is only drawn in outline."""
    panels = panels_of(model())
    for shot in panels.shots:
        for panel in panels.of(shot):
            picture = panels.picture(panel)
            if not len(panel.left_out):
                assert picture.size.tolist() == panel.size.tolist()
            assert (picture.size >= panel.size).all()


def test_the_first_picture_of_a_table_is_not_turned():
    """Nobody turns what is not there yet."""
    panels = panels_of(pair())
    for shot in panels.shots:
        first = panels.of(shot)[0]
        if not len(shot.before):
            assert first.turned is None


def test_small_sub_assemblies_are_pictures_of_the_step_that_puts_them_on():
    """An arm with a plate below its end: 1a shows the two, and in what follows they are put on."""
    bricks = table([(BRICK, 0, 0, 0, 0, 4, 0, 0, 0), (LONG, 0, 0, 3, 0, 4, 0, 0, 0), (PLATE, 7, 0, 2, 0, 4, 0, 0, 0)])
    panels = panels_of(plan_assembly(Assembly(bricks, CATALOGUE), deepest=3))
    inner, outer = panels.shots
    [first], last = panels.of(inner), panels.of(outer)[-1]
    assert (first.letter, first.last, title_of(panels, first)) == ("a", False, "Sub-assembly 1")
    assert first.new.tolist() == [2, 1]
    assert last.letter > "a"
    assert last.last
    assert outer.came.tolist() == [2, 1]
    assert inner.step is outer.step


def test_submodels_have_names_in_their_order():
    """Pieces have their numbers, sub-assemblies are counted as they are begun, the model has no name."""
    steps = pair().steps
    names = submodel_names(steps)
    assert names[0] == ""
    assert "Piece 2" in names.values()
    small = [each.like for each in steps.submodels if each.kind == Kind.SUBASSEMBLY]
    assert len({name for name in names.values() if name.startswith("Sub-assembly")}) == len(set(small))


def test_the_finished_model_has_its_own_colours():
    """The picture of the cover shows no tint."""
    panels = panels_of(arm())
    picture = panels.whole(FRONT, np.flatnonzero(~panels.temporary))
    assert picture.size.min() > 0


def test_what_lay_on_its_back_stands_again_for_what_comes_from_above():
    """Supports are taken out from below; what is put on next is seen from above, and the model is turned over."""
    panels = panels_of(arm())
    shot = next(shot for shot in panels.shots if len(shot.before) and not shot.step.pressed)
    panels._views[shot.submodel] = View(1, below=True)
    first = panels.of(shot)[0]
    assert not first.view.below
    assert first.turned == View(1, below=True)


def test_a_look_from_below_does_not_move_the_model(monkeypatch):
    """After supports were taken out below, the model is seen from where it was seen before."""
    panels = panels_of(arm())
    shot = next(shot for shot in panels.shots if shot.step.action == Action.REMOVE)
    panels._views[shot.submodel] = View(3)
    below = panels.stage.scene(shot.stays, shot.placed, View(0, below=True))
    monkeypatch.setattr(panels, "_scenes", lambda *_: [below])
    [panel] = panels.of(shot)
    assert panel.view.below
    assert panel.turned is None
    assert panels._views[shot.submodel] == View(3)


def test_equal_pieces_are_named_together():
    """What two pieces are built on says which; each is put on by its own name."""
    floor = [(LONG, 0, 2 * y, 0, 0, 4, 0, 0, 0) for y in range(4)]
    feet = [(BRICK, 4 * k, 2, 3 * z, 0, 1, 0, 1 + k, 0) for k in range(2) for z in (1, 2, 3)]
    plan = plan_assembly(Assembly(table([*floor, *feet]), CATALOGUE), deepest=3)
    names = submodel_names(plan.steps)
    assert [built_at_once(plan.steps, names, number) for number in (0, 1)] == ["", "Pieces 2 and 3"]
    panels = panels_of(plan)
    found = [panel for shot in panels.shots for panel in panels.of(shot)]
    titles = [title_of(panels, panel) for panel in found]
    assert [title for title in titles if "iece" in title] == ["Pieces 2 and 3", "Put on piece 2", "Put on piece 3"]
    assert [panel.shot.times for panel in found if title_of(panels, panel) == "Pieces 2 and 3"] == [2]
