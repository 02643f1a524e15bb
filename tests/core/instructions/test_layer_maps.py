"""Layer maps: every brick on one of them, on what it lies."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.instructions.canvas import Group, Path, Text
from legorize_addon.core.instructions.layer_maps import MAPS, layer_files, layer_pages, map_pages
from legorize_addon.core.instructions.lots import lots_of, rgb_of
from legorize_addon.core.instructions.paper import PAPERS
from legorize_addon.core.instructions.shades import SUPPORT_TINT, tint_for
from legorize_addon.core.model.bricks import Role
from tests.core.any_bricks import CATALOGUE, table
from tests.core.instructions.built import BRICK, PART, arm, pair, tower


def texts(items):
    """Yield all texts of a page."""
    for item in items:
        if isinstance(item, Group):
            yield from texts(item.items)
        elif isinstance(item, Text):
            yield item.text


def paths(items):
    """Yield all paths of a page."""
    for item in items:
        if isinstance(item, Group):
            yield from paths(item.items)
        elif isinstance(item, Path):
            yield item


def test_pages_name_lots_and_hatch_supports():
    """A page lists part, colour and count, and hatches supports alone."""
    bricks = tower()
    temporary = bricks.role == Role.SUPPORT_OUTSIDE
    pages = list(layer_pages(bricks, CATALOGUE, temporary=temporary, paper=PAPERS["A4"]))
    assert len(pages) == 3
    assert all((page.width, page.height) == (297.0, 210.0) for page in pages)
    assert {"1x", "Brick 2 x 4", "Red", "A", "1", "FRONT"} <= set(texts(pages[0].items))
    strokes = [{paint.stroke for path in paths(page.items) for paint in path.paints} for page in pages]
    assert [SUPPORT_TINT in each for each in strokes] == [True, False, False]


@pytest.mark.parametrize(
    "bricks", [tower(), arm().assembly.bricks, pair().assembly.bricks], ids=["tower", "arm", "pair"]
)
def test_counts_of_all_maps_are_the_parts_list(bricks):
    """A map a layer of each piece; what is counted on them is every lot of the model, as often as it has bricks."""
    pages = list(layer_pages(bricks, CATALOGUE, temporary=np.zeros(len(bricks), dtype=bool), paper=PAPERS["A4"]))
    assert len(pages) == len(np.unique(np.column_stack([bricks.piece, bricks.corner[:, 2]]), axis=0))
    counted: Counter[tuple[str, str]] = Counter()
    for page in pages:
        said = list(texts(page.items))
        for place, text in enumerate(said):
            if re.fullmatch(r"\d+x", text):
                counted[said[place + 1], said[place + 2]] += int(text[:-1])
    lots, _ = lots_of(bricks, CATALOGUE)
    names = [(CATALOGUE.parts[lot.part].title, CATALOGUE.colours[lot.colour].name) for lot in lots]
    assert counted == Counter(dict(zip(names, (lot.count for lot in lots), strict=True)))
    assert counted.total() == len(bricks)


def test_supports_have_the_tint_of_the_booklet():
    """On an orange model the hatching is not orange."""
    bricks = replace(tower(), colour=np.full(5, 25, dtype=np.int16))
    temporary = bricks.role == Role.SUPPORT_OUTSIDE
    page = next(layer_pages(bricks, CATALOGUE, temporary=temporary, paper=PAPERS["A4"]))
    tint = tint_for(rgb_of(bricks, CATALOGUE))
    assert tint != SUPPORT_TINT
    strokes = {paint.stroke for path in paths(page.items) for paint in path.paints}
    assert tint in strokes
    assert SUPPORT_TINT not in strokes


def test_actual_size_is_8_mm_a_stud():
    """At actual size a stud is 8 mm on the page, which grows with the model."""
    wide = table([(BRICK, x, 0, 0, 0, 4, 0, 0, 0) for x in range(0, 96, 4)])
    page = next(layer_pages(wide, CATALOGUE, temporary=np.zeros(24, bool), paper=PAPERS["Letter"], actual_size=True))
    assert page.width > 96 * 8
    [plan] = [item for item in page.items if isinstance(item, Group) and abs(item.matrix[0]) == 8]
    assert plan.matrix[3] == -8


def test_progress_rises():
    """Each map is told before it is drawn."""
    told = []

    def watch(stage, share):
        told.append(share)

    bricks = tower()
    pages = layer_pages(bricks, CATALOGUE, temporary=np.zeros(5, bool), paper=PAPERS["A4"], progress=watch)
    assert len(list(pages)) == 3
    assert told == sorted(told)
    assert told[0] == 0.0


def test_files_are_numbered():
    """Maps are files by number from below, each an SVG of its own."""
    pages = layer_pages(tower(), CATALOGUE, temporary=np.zeros(5, bool), paper=PAPERS["A4"])
    files = dict(layer_files(pages))
    assert list(files) == ["001.svg", "002.svg", "003.svg"]
    assert all(text.startswith("<svg ") and text.endswith("</svg>\n") for text in files.values())


@pytest.mark.parametrize(("across", "deep", "rows"), [(12, 12, 3), (48, 72, 1)])
def test_small_maps_share_a_page(across, deep, rows):
    """Maps of small models lie on one page, those of large ones alone; all are there."""
    places = [(x, y, z) for x in range(0, across, 4) for y in range(0, deep, 4) for z in range(0, 12, 3)]
    bricks = table([(BRICK, *place, 0, 4, 0, 0, 0) for place in places])
    none = np.zeros(len(bricks), bool)
    pages = list(map_pages(bricks, CATALOGUE, temporary=none, paper=PAPERS["A4"], first=9))
    assert len(pages) == -(-4 // rows)
    assert pages[0].title == MAPS
    shown = [text for page in pages for text in texts(page.items)]
    assert [text for text in shown if text.startswith("Layer ")] == [f"Layer {number}" for number in range(1, 5)]
    assert "9" in shown


def test_a_mosaic_has_a_map_for_each_tile():
    """Its own bricks, numbers of the whole, and a small picture of where it lies; the base has one map."""
    tops = [(PART["3005"], x, y, 1, 0, 4 if x < 16 else 15, 0, 0, 0) for x in range(0, 32, 4) for y in range(0, 16, 4)]
    bricks = table([(PART["3811"], 0, 0, 0, 0, 71, 0, 0, 0), *tops])
    temporary = np.zeros(len(bricks), dtype=bool)
    base, first, second = layer_pages(bricks, CATALOGUE, temporary=temporary, paper=PAPERS["A4"])
    assert "Baseplate 32 x 32" in set(texts(base.items))
    assert {"16x", "Red", "1", "16"} <= set(texts(first.items))
    assert {"16x", "White", "17", "32"} <= set(texts(second.items))
    assert "Red" not in set(texts(second.items))
    assert len(list(map_pages(bricks, CATALOGUE, temporary=temporary, paper=PAPERS["A4"], first=1))) >= 1
