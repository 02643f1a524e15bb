"""The building order as a table that others can follow."""

from __future__ import annotations

import csv
import io
from collections import Counter
from dataclasses import replace

import numpy as np

from legorize_addon.core.files.build_order_csv import COLUMNS, build_order_csv
from legorize_addon.core.files.ldraw import write_ldr
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.supports.assembly_plan import plan_assembly
from tests.core.standing import CATALOGUE, table


def followed(text):
    """Follow a table to its end; return its rows and the lines of the bricks that are left."""
    rows = list(csv.DictReader(io.StringIO(text)))
    left = Counter()
    for row in rows:
        if row["action"] == "place":
            left[row["ldraw"]] += 1
        elif row["action"] == "remove":
            left[row["ldraw"]] -= 1
            assert left[row["ldraw"]] >= 0
        else:
            assert row["action"] == "join"
            assert (row["ldraw"], row["onto"]) == ("", "model")
        assert row["pressed"] in "01"
        assert row["by_hand"] in "01"
    return rows, +left


def test_end_of_the_table_is_the_model():
    """Placed less removed is exactly the file of the model, supports named by their role."""
    bricks = table(("3004", 0, 0, 0), ("3004", 0, 0, 3), ("3004", 0, 0, 6), ("3008", 4, 0, 6), ("3008", 0, 0, 9))
    found = plan_assembly(Assembly(bricks, CATALOGUE), wish="tree", deepest=3)
    rows, left = followed(build_order_csv(found.steps, Assembly(found.bricks, CATALOGUE), by_hand=found.by_hand))
    model = write_ldr(found.final, name="m.ldr", title="m")
    assert left == Counter(line for line in model.splitlines() if line.startswith("1 "))
    assert tuple(rows[0]) == COLUMNS
    assert rows[0]["step"] == "1"
    removed = [row for row in rows if row["action"] == "remove"]
    assert removed
    assert {row["role"] for row in removed} == {Role.SUPPORT_OUTSIDE.name.lower()}


def test_joins_name_the_piece():
    """A piece that is joined has a row of its own after all its bricks."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6))
    found = plan_assembly(Assembly(replace(bricks, piece=np.array([0, 1, 1], np.int16)), CATALOGUE), deepest=3)
    rows, _ = followed(build_order_csv(found.steps, Assembly(found.bricks, CATALOGUE), by_hand=found.by_hand))
    assert [(row["action"], row["piece"]) for row in rows] == [
        ("place", "0"),
        ("place", "1"),
        ("place", "1"),
        ("join", "1"),
    ]
