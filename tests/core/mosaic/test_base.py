"""Bases of mosaics: whole, and of few parts."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.mosaic.base import lay_base
from tests.core.mosaic.pictures import CATALOGUE

GREY, RED, BLACK = 71, 4, 0


def numbers(base):
    """Return the part numbers of a base, sorted."""
    return sorted(CATALOGUE.parts[part].number for part in base.part.tolist())


def covered(base):
    """Return the studs of a base, (y, x), none of them twice."""
    graph = contact_graph(base, CATALOGUE)
    assert graph.collisions == 0
    return graph.owner[0] >= 0


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ((48, 48), ["4186"]),
        ((32, 32), ["3811"]),
        ((96, 96), ["4186"] * 4),
        ((64, 32), ["3811"] * 2),
        ((80, 48), ["3811", "3867", "3867", "4186"]),
    ],
)
def test_baseplates_where_they_fit(size, expected):
    """Of all guillotine cuts the fewest baseplates are taken."""
    base = lay_base(size, "auto", GREY, CATALOGUE)
    assert numbers(base) == expected
    assert covered(base).shape == size[::-1]
    assert covered(base).all()


@pytest.mark.parametrize("size", [(1, 1), (50, 40), (3, 31), (17, 16), (48, 48)])
def test_large_plates_make_any_size(size):
    """They cover the rectangle and nothing else, each made in the colour."""
    base = lay_base(size, "plates", GREY, CATALOGUE)
    assert covered(base).shape == size[::-1]
    assert covered(base).all()
    assert CATALOGUE.exists_in(base.part, base.colour).all()
    assert CATALOGUE.sockets[base.part].all()


def test_a_base_of_baseplates_may_be_larger():
    """Each side is the next multiple of 16."""
    assert covered(lay_base((33, 16), "baseplates", GREY, CATALOGUE)).shape == (16, 48)


def test_auto_takes_plates_in_colours_without_baseplates():
    """Black has no baseplate; red has none of 16 studs."""
    for colour in (BLACK, RED):
        assert numbers(lay_base((16, 16), "auto", colour, CATALOGUE)) == ["91405"]
    with pytest.raises(SettingsError, match="No baseplates that make up 16 x 16 studs are made in Red"):
        lay_base((16, 16), "baseplates", RED, CATALOGUE)


def test_no_fewer_parts_by_trying_all_cuts():
    """The number of parts is that of a search over all guillotine cuts, done in another way."""
    sizes = {
        (part.length, part.width)
        for row, part in enumerate(CATALOGUE.parts)
        if part.height == 1 and part.profile == "box" and CATALOGUE.exists_in(row, GREY)
    }
    sizes |= {size[::-1] for size in sizes}
    fewest = {}
    for wide, deep in product(range(1, 13), repeat=2):
        cuts = [fewest[at, deep] + fewest[wide - at, deep] for at in range(1, wide)]
        cuts += [fewest[wide, at] + fewest[wide, deep - at] for at in range(1, deep)]
        fewest[wide, deep] = 1 if (wide, deep) in sizes else min(cuts)
    for size in ((7, 5), (11, 11), (12, 9), (10, 1)):
        assert len(lay_base(size, "plates", GREY, CATALOGUE)) == fewest[size]


def test_base_is_what_nobody_sees():
    """It lies on plate 0, as the inside of the model."""
    base = lay_base((20, 20), "plates", GREY, CATALOGUE)
    assert (base.corner[:, 2] == 0).all()
    assert (base.role == 1).all()
    assert np.unique(base.colour).tolist() == [GREY]
