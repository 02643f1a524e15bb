"""How a picture of a step is laid out."""

from __future__ import annotations

from dataclasses import replace

import pytest

from legorize_addon.core.building.moves import Action
from legorize_addon.core.instructions.canvas import Group, Text
from legorize_addon.core.instructions.lattice import View
from legorize_addon.core.instructions.panel_layout import header, panel_items, title_of
from tests.core.instructions.built import arm, leaning, pair
from tests.core.instructions.test_panels import panels_of


def texts(items):
    """Yield all texts."""
    for item in items:
        if isinstance(item, Group):
            yield from texts(item.items)
        elif isinstance(item, Text):
            yield item.text


def all_panels(model):
    """Return the pictures of a model, and the list of them."""
    panels = panels_of(model())
    return panels, [panel for shot in panels.shots for panel in panels.of(shot)]


@pytest.mark.parametrize("model", [arm, pair])
def test_numbers_and_parts_stand_above(model):
    """Each picture has its number, and the counts of its parts."""
    panels, found = all_panels(model)
    for panel in found:
        top = header(panels, panel, 130.0)
        shown = list(texts(top.items))
        assert shown[0] == f"{panel.shot.step.number + 1}{panel.letter}"
        counts = [int(text[:-1]) for text in shown[1:] if text.endswith("x") and text[:-1].isdigit()]
        # how often something is built stands before the counts
        times = panel.shot.step.times
        assert sum(counts) == len(panel.placed) + (times if times > 1 else 0)
        assert top.height > 0


def test_titles_say_what_is_done():
    """Supports are taken out, pieces put on, and what is built by itself has its name."""
    panels, found = all_panels(arm)
    titles = [title_of(panels, panel) for panel in found if panel.shot.step.action == Action.REMOVE]
    assert set(titles) == {"Take out the supports"}
    panels, found = all_panels(pair)
    assert "Put on piece 2" in [title_of(panels, panel) for panel in found]
    assert "Piece 2" in [title_of(panels, panel) for panel in found]


def test_supports_are_looked_at_from_below_without_turning_the_model():
    """What is taken out below is called so, and not as if the model were laid on its back."""
    panels, found = all_panels(arm)
    panel = next(panel for panel in found if panel.shot.step.action == Action.REMOVE)
    shown = set(texts(header(panels, replace(panel, view=View(0, below=True), turned=None), 130.0).items))
    assert "seen from below" in shown
    assert "turn over" not in shown
    assert "seen from below" not in set(texts(header(panels, panel, 130.0).items))


def test_signs_are_explained_by_a_word():
    """A turned picture says so."""
    for model in (arm, pair):
        panels, found = all_panels(model)
        for panel in found:
            shown = set(texts(header(panels, panel, 130.0).items))
            assert ("turn" in shown or "turn over" in shown) == (panel.turned is not None)
            assert ("not shown here" in shown) == (len(panel.left_out) > 0)


def test_what_would_fall_over_is_to_be_held():
    """The picture of a sub-assembly that leans says so, those of the model do not."""
    panels, found = all_panels(leaning)
    held = {panel.shot.submodel for panel in found if "hold" in texts(header(panels, panel, 130.0).items)}
    assert ({panel.shot.submodel for panel in found}, held) == ({0, 1}, {1})


def test_pictures_stay_in_their_cells():
    """A picture that is too large for its scale is drawn smaller."""
    panels, found = all_panels(arm)
    for scale in (0.2, 5.0):
        *_, picture = panel_items(panels, found[-1], 100.0, 80.0, scale)
        a, _, _, d, e, f = picture.matrix
        made = panels.picture(found[-1])
        assert e + a * made.low[0] >= -1e-9
        assert e + a * made.high[0] <= 100 + 1e-9
        assert f + d * made.high[1] <= 80 + 1e-9
