"""Where maps lie on their pages."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.method.sheet import MARGIN, Sheet, squares


@pytest.mark.parametrize(("n_x", "n_y"), [(10, 7), (7, 10), (200, 3), (3, 200), (1, 1)])
def test_maps_fit_and_are_seen_from_above(n_x, n_y):
    """All cells lie on an A4 page beside the legend, as large as they can, and no map is a mirror image."""
    sheet = Sheet.of(n_x, n_y)
    a, b, c, d, e, f = sheet.matrix
    corners = np.array([(0, 0), (n_x, 0), (0, n_y), (n_x, n_y)])
    page = corners @ np.array([(a, b), (c, d)]) + (e, f)
    assert page.min() >= MARGIN - 1e-9
    assert (page.max(axis=0) <= (297 - MARGIN, 210 - MARGIN)).all()
    # y goes down on the page
    assert a * d - b * c == pytest.approx(-(sheet.cell**2))
    assert sheet.turned == (n_y > n_x)


def test_squares_are_the_cells_of_a_mask():
    """Each is one unit wide, from the cell's lower corner."""
    cells = np.zeros((3, 4), dtype=bool)
    cells[2, 1] = cells[0, 3] = True
    path = squares(cells)
    boxes = [(part.min(axis=0).tolist(), part.max(axis=0).tolist()) for part in path.points.reshape(-1, 4, 2)]
    assert boxes == [([3, 0], [4, 1]), ([1, 2], [2, 3])]
