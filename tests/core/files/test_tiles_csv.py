"""The parts of each tile of a mosaic."""

from __future__ import annotations

import csv
import io
from collections import Counter
from dataclasses import replace

import numpy as np

from legorize_addon.core.files.tiles_csv import tiles_csv
from legorize_addon.core.model.assembly import Assembly
from tests.core.any_bricks import CATALOGUE, table

TILE = CATALOGUE.part_row("3070b")


def rows_of(*places):
    """Return the lines for red tiles of one stud at some places, on a baseplate of 48 studs."""
    rows = [(CATALOGUE.part_row("4186"), 0, 0, 0, 0, 71, 1, 0, 0)]
    rows += [(TILE, x, y, 1, 0, 4, 0, 0, 0) for x, y in places]
    return list(csv.DictReader(io.StringIO(tiles_csv(Assembly(table(rows), CATALOGUE)))))


def test_parts_are_listed_by_tile():
    """Rows and columns count from the front left; the base is by itself."""
    found = rows_of((0, 0), (15, 15), (16, 0), (47, 47))
    assert [(row["row"], row["column"], row["part"], row["count"]) for row in found] == [
        ("0", "0", "4186", "1"),
        ("1", "1", "3070b", "2"),
        ("1", "2", "3070b", "1"),
        ("3", "3", "3070b", "1"),
    ]


def test_every_brick_is_in_one_tile():
    """The sum of all lines is the model, of a small mosaic too."""
    rng = np.random.default_rng(0)
    places = [(int(x), int(y)) for x, y in rng.permutation(np.argwhere(np.ones((48, 48))))[:200]]
    count = Counter()
    for row in rows_of(*places):
        count[row["part"]] += int(row["count"])
    assert count == {"4186": 1, "3070b": 200}
    small = table([(TILE, x, 0, 0, 0, 4, 0, 0, 0) for x in range(5)])
    assert "1,1,3070b" in tiles_csv(Assembly(replace(small), CATALOGUE))
