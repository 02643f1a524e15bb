"""Maps of wide models show the place that is worked on."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.canvas import Group, Text
from legorize_addon.core.instructions.layer_maps import SMALLEST, layer_pages
from legorize_addon.core.instructions.layers import layers_of
from legorize_addon.core.instructions.map_frame import Frame, map_room
from legorize_addon.core.instructions.paper import PAPERS
from legorize_addon.core.instructions.zoom import AROUND, locator, zoomed
from tests.core.any_bricks import CATALOGUE, table
from tests.core.instructions.built import BRICK, PLATE

A4 = PAPERS["A4"]


def wide(deep=60):
    """Return a floor of 120 studs with a low stack in one corner of it."""
    floor = [(BRICK, 4 * x, 2 * y, 0, 0, 4, 0, 0, 0) for x in range(30) for y in range(deep // 2)]
    return table([*floor, (PLATE, 100, 8, 3, 0, 1, 0, 0, 1), (PLATE, 104, 8, 3, 0, 1, 0, 0, 1),
                  *((BRICK, 100, 8, z, 0, 1, 0, 0, 1) for z in (4, 7))])  # fmt: skip


def texts(items):
    """Yield all texts, with their sizes."""
    for item in items:
        if isinstance(item, Group):
            yield from texts(item.items)
        elif isinstance(item, Text):
            yield item.text, item.size


def parts(bricks, least=2.75):
    """Return the layers as they are zoomed."""
    whole = Frame.of(bricks, CATALOGUE, 66.0, A4, actual_size=False)
    return zoomed(layers_of(bricks, CATALOGUE), bricks, CATALOGUE, whole, map_room(66.0, A4), least), whole


@pytest.mark.parametrize("deep", [20, 60, 200])
def test_every_brick_is_on_one_map_and_large_enough(deep):
    """Parts of a layer have all of its bricks once, each within its box, and a stud is at least as large as asked."""
    bricks = wide(deep)
    found, whole = parts(bricks)
    assert sorted(np.concatenate([each.new for each in found]).tolist()) == list(range(len(bricks)))
    for each in found:
        frame = Frame.of_box(each.box, whole, 66.0, A4)
        assert frame.stud >= 2.75 * 0.9
        assert frame.turned == whole.turned
        assert (frame.first == whole.low).all()
        assert (bricks.corner[each.new, :2] >= frame.low).all()
        assert (bricks.corner[each.new, :2] + (4, 2) <= frame.high).all()
        others = (
            np.setdiff1d(np.flatnonzero(bricks.corner[:, 2] == 0), each.new)
            if each.title.startswith("Layer 1,")
            else []
        )
        assert set(others) <= set(each.through.tolist())


def test_what_is_small_has_one_map_around_it():
    """Two plates on a wide floor are shown with two studs around them."""
    [plates] = [each for each in parts(wide())[0] if each.title == "Layer 2"]
    assert plates.box == ((100 - AROUND, 8 - AROUND), (108 + AROUND, 10 + AROUND))


def test_small_models_stay_as_they_are():
    """Nothing is cut where letters can be read anyway."""
    bricks = table([(BRICK, 4 * x, 0, 0, 0, 4, 0, 0, 0) for x in range(10)])
    assert all(each.box is None for each in parts(bricks)[0])


def test_the_small_picture_says_where_it_is():
    """It has the shape of the whole, and the box lies in it as the part in the whole."""
    bricks = wide()
    found, whole = parts(bricks)
    [plates] = [each for each in found if each.title == "Layer 2"]
    *_, box = locator(plates, bricks, CATALOGUE, whole, (24.0, 11.0))
    scale = min(24 / 120, 11 / 60)
    low, high = box.points.min(axis=0), box.points.max(axis=0)
    assert low.tolist() == pytest.approx([98 * scale, (60 - 12) * scale])
    assert high.tolist() == pytest.approx([110 * scale, (60 - 6) * scale])


def test_letters_of_wide_models_can_be_read():
    """Every map has letters of its lots on bricks, none smaller than can be read, and says which part it shows."""
    bricks = wide()
    pages = list(layer_pages(bricks, CATALOGUE, temporary=np.zeros(len(bricks), bool), paper=A4))
    assert len(pages) > 2
    for page in pages:
        sizes = [size for text, size in texts(page.items) if text == "A"]
        assert len(sizes) > 1 + (page.title == pages[0].title)
        assert min(sizes) >= SMALLEST * 0.9
    assert pages[0].title == f"Layer 1, part 1 of {len(pages) - 3}"
