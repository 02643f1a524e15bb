"""Maps of hollowing."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.method.hollowing_maps import hollowing_maps, kinds_of, support_cells
from legorize_addon.core.method.sheet import Sheet
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid
from tests.core.any_bricks import CATALOGUE, table
from tests.core.instructions.test_layer_maps import texts

PART = {part.number: row for row, part in enumerate(CATALOGUE.parts)}


def block():
    """Return a solid block of 7 x 7 cells and two layers, and what is left of it: a shell, a ring, and nothing."""
    colour = np.full((2, 3, 9, 9), COLOUR_EMPTY, dtype=np.int16)
    colour[:, :, 1:8, 1:8] = COLOUR_ANY
    role, cover = np.zeros(colour.shape, np.uint8), np.where(colour == COLOUR_ANY, np.uint8(Fill.REQUIRED), np.uint8(0))
    ring = np.ones((9, 9), dtype=bool)
    ring[2:7, 2:7] = False
    colour[:, :, ring & (colour[0, 0] == COLOUR_ANY)] = 4
    solid = UnitGrid(colour=colour, cover=cover, role=role, origin=np.zeros(3))
    left, fill = colour.copy(), cover.copy()
    fill[:, :, 2:7, 2:7] = Fill.OPTIONAL
    fill[:, :, 3:6, 3:6], left[:, :, 3:6, 3:6] = Fill.EMPTY, COLOUR_EMPTY
    return solid, UnitGrid(colour=left, cover=fill, role=role, origin=np.zeros(3))


def test_every_column_is_of_one_kind():
    """24 are seen, 16 may be built, 9 are left out; nothing else is."""
    solid, shell = block()
    kinds = kinds_of(solid, shell, 0)
    assert {name: int(cells.sum()) for name, cells in kinds.items() if cells.any()} == {
        "seen": 24,
        "may be built": 16,
        "left out": 9,
    }
    total = sum(cells.astype(int) for cells in kinds.values())
    np.testing.assert_array_equal(total, solid.solid[0].any(axis=0))


def test_supports_stand_in_their_layers():
    """A tall support stands in all layers that it reaches, a plate in one; outside of the grid nothing is drawn."""
    solid, _ = block()
    bricks = table(
        [
            (PART["3005"], 0, 0, 0, 0, 15, 4, 0, 0),
            (PART["3005"], 0, 0, 3, 0, 15, 4, 0, 0),
            (PART["3023"], 7, 0, 4, 0, 15, 4, 0, 0),
            (PART["3023"], 8, 8, 0, 0, 15, 4, 0, 0),
        ]
    )
    cells = support_cells(Assembly(bricks, CATALOGUE), solid)
    assert np.argwhere(cells).tolist() == [[0, 0, 0], [0, 8, 8], [1, 0, 0], [1, 0, 7], [1, 0, 8]]


def test_pages_count_what_they_show():
    """A page a layer, with the number of columns of each kind."""
    solid, shell = block()
    supports = Assembly(table([(PART["3005"], 0, 0, 3, 0, 15, 4, 0, 0)]), CATALOGUE)
    first, second = hollowing_maps(solid, shell, supports, sheet=Sheet.of(9, 9), catalogue=CATALOGUE)
    assert {"Layer 1", "24 seen of 49, 25 not needed", "may be built: 16", "left out: 9"} <= set(texts(first.items))
    assert "support outside: 1" in set(texts(second.items))
    assert not [text for text in texts(first.items) if text.startswith("support")]
