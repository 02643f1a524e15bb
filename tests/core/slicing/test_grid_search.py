"""The grid is laid where the mesh fills its cells best, keeps a symmetric model's middle, and may change its size."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.mesh import scale_mesh
from legorize_addon.core.slicing import LEEWAY, best_grid, fit_grid, grid_search, slice_mesh
from legorize_addon.core.slicing.coverage import covered_area
from legorize_addon.core.slicing.grid_search import PARTS
from legorize_addon.core.slicing.trajectories import linked
from legorize_addon.core.units import BRICK, PLATE, STUD
from tests.core.solids import box, joined, sphere

QUARTER = STUD / PARTS


def error(mesh, grid):
    """Return the cells, as plates, by which the grid errs: a plain sum over all of them."""
    n = 3 * grid.n_layers
    heights = grid.origin[2] + (np.arange(n) + 0.5) * PLATE
    area = covered_area(linked(mesh.faces, slice_mesh(mesh, heights)), n, grid.origin[:2], grid.n_y, grid.n_x)
    return sum(min(share, 1 - share) for share in (area / 64).ravel())


def covers(mesh, grid) -> bool:
    """Tell whether a free cell is left on every side."""
    low, high = mesh.vertices.min(axis=0)[:2], mesh.vertices.max(axis=0)[:2]
    end = grid.origin[:2] + STUD * np.array([grid.n_x, grid.n_y])
    return bool((grid.origin[:2] <= low - STUD + 1e-6).all() and (end >= high + STUD - 1e-6).all())


def bridge():
    """Return a beam of seven studs on posts of one stud, half a stud inside its ends."""
    posts = [box((x, 0, 0), (x + 8, 8, 5 * BRICK)) for x in (4.0, 44.0)]
    return joined(*posts, box((0, 0, 5 * BRICK), (56, 8, 6 * BRICK)))


def test_posts_between_two_rows_become_one_row_in_the_middle_of_the_model():
    """Half filled in two rows on the usual grid, they fill one row wholly on the other; the image stays the image."""
    mesh = bridge()
    usual, (best, factor) = fit_grid(mesh, symmetric=True, plates=True), best_grid(mesh, symmetric=True, plates=True)
    # two half cells for each plate of two posts, and afterwards for each plate of the beam
    assert error(mesh, usual) == pytest.approx(2 * 15)
    assert error(mesh, best) == pytest.approx(3)
    assert factor == 1
    assert best.origin[0] + STUD * best.n_x / 2 == pytest.approx(28)
    assert best.n_x == usual.n_x + 1
    assert covers(mesh, best)


def test_a_grid_that_is_as_good_stays():
    """Where the usual grid has no error, no other one is taken."""
    mesh = box((3, -2, 5), (3 + 13 * 8, -2 + 6 * 8, 5 + 7 * BRICK))
    usual, (best, factor) = fit_grid(mesh, symmetric=True), best_grid(mesh, symmetric=True, plates=False, leeway=LEEWAY)
    assert (best.origin == usual.origin).all()
    assert best.shape == usual.shape
    assert factor == 1


@pytest.mark.parametrize(("width", "factor"), [(10.2, 10 / 10.2), (9.8, 10 / 9.8), (9.6, 1.03), (10, 1)])
def test_size_changes_to_whole_studs_and_no_further_than_allowed(width, factor):
    """A cube whose sides are near whole studs is made a little smaller or larger."""
    mesh = box((0, 0, 0), (width * 8, width * 8, width * 9.6))
    grid, found = best_grid(mesh, symmetric=True, plates=True, leeway=LEEWAY)
    assert found == pytest.approx(factor)
    assert covers(scale_mesh(mesh, found), grid)
    assert best_grid(mesh, symmetric=True, plates=True)[1] == 1


def test_a_ball_keeps_its_size_and_its_planes():
    """Other ones save a little of the error of round surface by chance."""
    mesh = sphere(16, 9.3 * STUD)
    best, factor = best_grid(mesh, symmetric=True, plates=True, leeway=LEEWAY)
    assert factor == 1
    assert best.origin[2] == pytest.approx(fit_grid(mesh, symmetric=True, plates=True).origin[2])


@pytest.mark.parametrize(("long", "tried"), [(48, [47 / 48, 49 / 48]), (10.2, [10 / 10.2]), (24, 6)])
def test_sizes_of_whole_studs_come_first(long, tried):
    """Steps of one per cent are tried only where no whole number of studs is near."""
    found = grid_search._factors(box((0, 0, 0), (8 * long, 40, 40)), LEEWAY)
    assert sorted(found) == pytest.approx(tried) if isinstance(tried, list) else len(found) == tried


@pytest.mark.parametrize(
    ("errors", "factor"),
    [
        ({1.0: 100}, 1.0),
        ({0.97: 96.5}, 1.0),
        ({0.97: 95.5}, 0.97),
        ({1.03: 94.0}, 1.0),
        ({1.03: 93.0}, 1.03),
        ({1.03: 94.0, 0.97: 95.5}, 0.97),
        ({1.03: 93.0, 0.97: 95.5}, 1.03),
    ],
)
def test_a_larger_size_has_to_save_more(monkeypatch, errors, factor):
    """Four per cent for a smaller one, and as much more as a larger one is larger."""
    mesh = box((0, 0, 0), (80, 80, 96))

    def found(_mesh, size, *_level, **_settings):
        error = {1.0: 100.0, **errors}.get(round(size, 2), 99.0)
        return grid_search._Found(fit_grid(mesh, symmetric=True), size, error)

    monkeypatch.setattr(grid_search, "_shifted", found)
    assert best_grid(mesh, symmetric=True, plates=True, leeway=LEEWAY)[1] == pytest.approx(factor)


@pytest.mark.parametrize(("low", "raised"), [(15.0, 0), (14.75, -1), (15.25, 1), (15.4, 1), (15.1, 0)])
def test_planes_lie_where_level_surface_is(low, raised):
    """The top of a table lies between two planes, whatever the height of its legs."""
    legs = [box((x, y, 0), (x + 8, y + 8, low * PLATE)) for x in (0.0, 88.0) for y in (0.0, 88.0)]
    mesh = joined(*legs, box((0, 0, low * PLATE), (96, 96, (low + 3) * PLATE)))
    usual, (best, _) = fit_grid(mesh, symmetric=True, plates=True), best_grid(mesh, symmetric=True, plates=True)
    assert best.origin[2] - usual.origin[2] == pytest.approx(raised * PLATE / PARTS)
    assert best.origin[2] + best.n_layers * BRICK >= (low + 3) * PLATE - 1e-9
    bricks = best_grid(mesh, symmetric=True, plates=False)[0]
    assert bricks.origin[2] == pytest.approx(fit_grid(mesh, symmetric=True).origin[2])


sides = st.floats(10, 60)


@settings(max_examples=10)
@given(st.tuples(sides, sides, sides), st.tuples(sides, sides, sides), st.tuples(sides, sides))
def test_no_shift_is_better(first, second, beside):
    """Of two boxes somewhere, plain sums over the sixteen shifts show none that is half a per cent better."""
    # side by side: where bodies overlap, the shares of quarters say more than those of cells
    place = (first[0] + beside[0], beside[1], 0)
    mesh = joined(box((0, 0, 0), first), box(place, np.add(place, second)))
    usual, (best, _) = fit_grid(mesh, symmetric=False), best_grid(mesh, symmetric=False, plates=False)
    assert covers(mesh, best)
    steps = (best.origin[:2] - usual.origin[:2]) / QUARTER
    assert steps == pytest.approx(np.round(steps))
    others = []
    for y, x in np.ndindex(PARTS, PARTS):
        origin = usual.origin - [QUARTER * x, QUARTER * y, 0]
        others.append(error(mesh, replace(usual, origin=origin, n_x=usual.n_x + 1, n_y=usual.n_y + 1)))
    # where the ground follows the base, layers differ
    if best.origin[2] == usual.origin[2]:
        assert error(mesh, best) <= min(others) / 0.995 + 1e-6


def test_the_grid_fits_what_is_weighted():
    """Of two legs half a stud apart from each other's rows, the one that counts more lies on the studs."""
    legs = [box((x, 0, 0), (x + 8, 8, 5 * BRICK)) for x in (0.0, 44.0)]
    mesh = joined(*legs)
    for painted in range(2):
        weight = np.repeat(np.arange(2) == painted, 8).astype(float)
        grid, _ = best_grid(replace(mesh, weight=weight), symmetric=False, plates=True)
        assert error(legs[painted], grid) < error(legs[1 - painted], grid) / 2
