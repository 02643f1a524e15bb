"""The shared tables: what a grid calls solid, and rows of bricks taken out."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from legorize_addon.core.model.bricks import Bricks


def bricks(n: int) -> Bricks:
    """Make a table of n rows, each value telling its row."""
    row = np.arange(n)
    kinds = {"part": np.int16, "corner": np.int32, "turn": np.uint8, "colour": np.int16, "role": np.uint8,
             "piece": np.int16, "step": np.int32}  # fmt: skip
    columns = {name: row.astype(kind) for name, kind in kinds.items()}
    columns["corner"] = np.column_stack([row, row, row]).astype(np.int32)
    return Bricks(**columns, half=np.column_stack([row % 2, row // 2 % 2]).astype(np.uint8))


@pytest.mark.parametrize("rows", [np.array([3, 0, 3]), np.array([True, False, True, False, True]), np.zeros(0, int)])
def test_rows_are_taken_from_every_column(rows):
    """Taking rows, by number or by mask, takes them from all columns and keeps the kinds of numbers."""
    table = bricks(5)
    taken = table.take(rows)
    assert len(taken) == len(np.arange(5)[rows])
    for entry in fields(Bricks):
        before, after = getattr(table, entry.name), getattr(taken, entry.name)
        np.testing.assert_array_equal(after, before[rows])
        assert after.dtype == before.dtype
