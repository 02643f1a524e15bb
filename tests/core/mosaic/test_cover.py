"""What covers the base: every stud once, in its colour, in one piece."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from legorize_addon.core.mosaic.base import lay_base
from legorize_addon.core.mosaic.cover import cover_base
from tests.core.mosaic.pictures import CATALOGUE

KINDS = ("tiles", "plates", "bricks")
HEIGHT = {"tiles": 1, "plates": 1, "bricks": 3}


def laid(colour, kind="tiles", base="auto", tier="standard"):
    """Cover a base that fits."""
    colour = np.asarray(colour, np.int16)
    ground = lay_base(colour.shape[::-1], base, 71, CATALOGUE)
    return ground, cover_base(colour, ground, kind, CATALOGUE, tier=tier, rng=np.random.default_rng(0))


def shown(bricks):
    """Return the colour of each stud as it is seen from above."""
    graph = contact_graph(bricks, CATALOGUE)
    assert graph.collisions == 0
    return np.where(graph.owner[1] >= 0, bricks.colour[graph.owner[1]], COLOUR_EMPTY)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("tier", ["fast", "standard", "exact"])
def test_every_stud_in_its_colour(kind, tier):
    """What is seen is the picture, of parts of the kind that are made in their colours."""
    choice = np.array([4, 15, COLOUR_EMPTY], np.int16)
    colour = np.random.default_rng(3).choice(choice, (16, 16), p=[0.6, 0.3, 0.1])
    base, found = laid(colour, kind, tier=tier)
    np.testing.assert_array_equal(shown(found.bricks), colour)
    surface = found.bricks.take(np.arange(len(base), len(found.bricks)))
    assert CATALOGUE.exists_in(surface.part, surface.colour).all()
    parts = [CATALOGUE.parts[part] for part in surface.part.tolist()]
    assert {part.height for part in parts} == {HEIGHT[kind]}
    assert {part.studs for part in parts} == {kind != "tiles"}
    assert (found.changed, found.added) == (0, 0)


@pytest.mark.parametrize("kind", ["tiles", "plates"])
def test_areas_of_one_colour_take_large_parts(kind):
    """One colour over a baseplate takes hardly more than the largest parts would."""
    _, found = laid(np.full((16, 16), 15), kind)
    largest = 8 if kind == "tiles" else 64
    assert len(found.bricks) - 1 <= 1.25 * 256 / largest


def test_parts_join_the_base():
    """In one colour, parts lie across the seams of the base by themselves."""
    base, found = laid(np.full((24, 20), 4), base="plates")
    assert len(base) > 1
    assert contact_graph(found.bricks, CATALOGUE).n_components == 1
    assert (found.changed, found.added) == (0, 0)


@pytest.mark.parametrize("kind", KINDS)
def test_a_chequerboard_is_joined_by_one_colour_at_each_seam(kind):
    """Where no two neighbours have one colour, one stud changes for each part that was loose."""
    colour = np.where(np.indices((20, 40)).sum(axis=0) % 2, 4, 15)
    base, found = laid(colour, kind, base="plates")
    assert contact_graph(found.bricks, CATALOGUE).n_components == 1
    assert found.changed == len(base) - 1
    assert (shown(found.bricks) != colour).sum() == found.changed


def test_studs_change_where_it_is_seen_least():
    """Of all neighbours across a seam those are joined whose colours are nearest."""
    colour = np.where(np.indices((16, 20)).sum(axis=0) % 2, 0, 15)
    colour[5, 15:17] = 71, 72
    base, found = laid(colour, base="plates")
    assert len(base) > 1
    changed = np.argwhere(shown(found.bricks) != colour).tolist()
    assert [5, 15] in changed or [5, 16] in changed


def test_a_bare_seam_is_covered():
    """An island on one of two plates: parts in the base's colour join the others."""
    colour = np.full((16, 20), COLOUR_EMPTY)
    colour[4:8, 2:6] = 4
    base, found = laid(colour, base="plates")
    assert len(base) > 1
    assert contact_graph(found.bricks, CATALOGUE).n_components == 1
    assert found.added >= 2
    assert found.changed == 0


def test_same_seed_same_mosaic():
    """Two runs lay the same bricks in the same order."""
    colour = np.random.default_rng(1).choice(np.array([4, 15], np.int16), (16, 24))
    first, second = (laid(colour, base="plates")[1].bricks for _ in range(2))
    for name in ("part", "corner", "turn", "colour"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))


def test_colours_without_a_small_part_are_refused():
    """The sentence names the colour."""
    exists = CATALOGUE.exists.copy()
    exists[CATALOGUE.part_row("3070b"), CATALOGUE.colour_row(4)] = False
    catalogue = replace(CATALOGUE, exists=exists)
    base = lay_base((2, 2), "plates", 71, catalogue)
    red = np.full((2, 2), 4, np.int16)
    with pytest.raises(SettingsError, match="leave colour 4 out"):
        cover_base(red, base, "tiles", catalogue, tier="fast", rng=np.random.default_rng(0))
