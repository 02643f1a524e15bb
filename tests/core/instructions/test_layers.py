"""Layers: every brick is laid in one of them, on what it lies."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings

from legorize_addon.core.building.tiles import tile_places
from legorize_addon.core.instructions.layers import by_tiles, layers_of
from legorize_addon.core.model.contacts import contact_graph
from tests.core.any_bricks import CATALOGUE, any_bricks, table
from tests.core.instructions.built import BRICK, PART, tower


@settings(deadline=None, max_examples=50)
@given(any_bricks())
def test_every_brick_is_new_once(bricks):
    """Each brick is laid on exactly one map, on bricks whose tops are where it begins."""
    layers = layers_of(bricks, CATALOGUE)
    assert sorted(row for layer in layers for row in layer.new.tolist()) == list(range(len(bricks)))
    height = np.array([part.height for part in CATALOGUE.parts])[bricks.part]
    for layer in layers:
        [level] = set(bricks.corner[layer.new, 2].tolist())
        [piece] = set(bricks.piece[layer.new].tolist())
        assert (bricks.corner[layer.below, 2] + height[layer.below] == level).all()
        assert (bricks.piece[np.concatenate([layer.below, layer.through])] == piece).all()


def test_what_a_brick_lies_on_is_below_it():
    """The contacts of a model are those between what is new and what is below."""
    bricks = tower()
    pairs = {tuple(pair) for pair in contact_graph(bricks, CATALOGUE).pairs.tolist()}
    for lower, upper in pairs:
        layer = next(each for each in layers_of(bricks, CATALOGUE) if upper in each.new)
        assert lower in layer.below


def test_titles_tell_layers_and_plates():
    """Layers are counted from 1, what begins above them by plates."""
    assert [layer.title for layer in layers_of(tower(), CATALOGUE)] == ["Layer 1", "Layer 2", "Layer 2, 1 plate up"]
    pieces = table([(BRICK, 0, 0, 0, 0, 4, 0, 0, 0), (BRICK, 0, 0, 30, 0, 4, 0, 3, 0)])
    assert [layer.title for layer in layers_of(pieces, CATALOGUE)] == ["Piece 1, Layer 1", "Piece 2, Layer 1"]


def test_layers_of_a_mosaic_are_divided_into_tiles():
    """Each tile has its own bricks, and the others to lie between; a layer of few bricks stays whole."""
    brick = PART["3005"]
    tops = [(brick, x, y, 1, 0, 4, 0, 0, 0) for x in range(0, 32, 4) for y in range(0, 16, 4)]
    bricks = table([(PART["3811"], 0, 0, 0, 0, 71, 0, 0, 0), *tops])
    base, *tiles = by_tiles(layers_of(bricks, CATALOGUE), tile_places(bricks, CATALOGUE))
    assert (base.title, base.tile) == ("Layer 1", None)
    assert [each.tile for each in tiles] == [(0, 0), (0, 1)]
    assert tiles[1].title == "Layer 1, 1 plate up, tile 2 of row 1"
    for each in tiles:
        assert (bricks.corner[each.new, 0] // 16 == each.tile[1]).all()
        assert sorted([*each.new, *each.through]) == list(range(1, 33))
