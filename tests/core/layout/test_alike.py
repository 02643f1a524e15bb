"""Symmetric models are laid symmetrically where that is cheap."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.building.mirror import mirror_images
from legorize_addon.core.layout import alike
from legorize_addon.core.layout.alike import Alike
from legorize_addon.core.layout.lay import FILLER, Manner, lay
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.progress import silent
from tests.core.layout.test_symmetric import CATALOGUE, grid_of, symmetric_grid


def laid(grid, burden=lambda bricks: 0.0):
    """Return a free layout and what is made of it."""
    rng = np.random.default_rng(1)
    free = lay(grid, CATALOGUE, rng=rng)
    search = Alike(grid, CATALOGUE, rng=rng, manner=Manner("standard"), filler=FILLER, burden=burden)
    return free, *search.lay(free, silent)


def test_a_block_is_laid_alike(monkeypatch):
    """Every brick has an image, the parts are no more than allowed, and all hangs together."""
    monkeypatch.setattr(alike, "DEARER", 0.5)
    grid = grid_of(np.full((4, 3, 10, 14), 4))
    free, bricks, cells = laid(grid)
    assert cells.solid.sum() == grid.solid.sum()
    assert (mirror_images(bricks, CATALOGUE) != NOBODY).all()
    assert len(bricks) <= 1.5 * len(free)
    assert contact_graph(bricks, CATALOGUE).n_components == 1


def test_dear_symmetry_is_left():
    """Where parts or supports would be more than the limit, the layout that came is given back."""
    grid = symmetric_grid(1, 3, 9)
    free, bricks, _ = laid(grid)
    assert bricks is free
    block = grid_of(np.full((4, 3, 10, 14), 4))
    seen = []

    def burden(bricks):
        seen.append(bricks)
        return 0.0 if len(seen) > 1 else 1000.0

    free, bricks, cells = laid(block, burden)
    assert bricks is free
    assert cells is block


def test_cells_without_an_image_are_laid_as_well(monkeypatch):
    """Something small on one side alone is covered, and the rest is symmetric."""
    monkeypatch.setattr(alike, "DEARER", 1.0)
    colour = np.full((5, 3, 10, 14), 4)
    colour[4] = -2
    colour[4, :, 4, 2] = 15
    grid = grid_of(colour)
    _, bricks, _ = laid(grid)
    graph = contact_graph(bricks, CATALOGUE)
    assert graph.collisions == 0
    assert np.count_nonzero(graph.owner != NOBODY) == grid.solid.sum()
    assert np.count_nonzero(mirror_images(bricks, CATALOGUE) == NOBODY) == 1


def test_models_without_symmetry_stay():
    """A stair on a slope both ways comes back as it went in."""
    colour = np.full((3, 3, 6, 9), -2)
    for step in range(3):
        colour[step, :, step:, 3 * step :] = 4
    free, bricks, _ = laid(grid_of(colour))
    assert bricks is free
