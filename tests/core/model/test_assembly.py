"""The model as one object: what follows from its bricks is theirs, and found once."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.contacts import contact_graph
from tests.core.standing import CATALOGUE, table


def model() -> Assembly:
    """Return a 2 x 4 brick with a plate of 1 x 1 on its far end."""
    return Assembly(table(("3001", 0, 0, 0), ("3024", 3, 1, 3)), CATALOGUE)


def test_what_follows_from_the_bricks():
    """Heights, masses and middles are those of the parts where they lie."""
    assembly = model()
    parts = [CATALOGUE.parts[CATALOGUE.part_row(number)] for number in ("3001", "3024")]
    assert len(assembly) == 2
    assert assembly.height.tolist() == [part.height for part in parts] == [3, 1]
    np.testing.assert_allclose(assembly.mass, [part.mass for part in parts])
    np.testing.assert_allclose(assembly.middles, [[2, 1], [3.5, 1.5]])
    weight = assembly.mass / assembly.mass.sum()
    np.testing.assert_allclose(assembly.centre_of_mass, [2 * weight[0] + 3.5 * weight[1], weight[0] + 1.5 * weight[1]])


def test_graph_is_found_once():
    """The graph is that of the bricks, and the same object whenever it is asked for."""
    assembly = model()
    assert assembly.graph is assembly.graph
    assert assembly.graph.pairs.tolist() == contact_graph(assembly.bricks, CATALOGUE).pairs.tolist() == [[0, 1]]


@pytest.mark.parametrize("rows", [np.array([1]), np.array([False, True])])
def test_some_bricks_are_a_model_of_their_own(rows):
    """Rows or a mask, in the same catalogue."""
    alone = model().take(rows)
    assert alone.bricks.corner.tolist() == [[3, 1, 3]]
    assert alone.graph.n_components == 1


def test_more_bricks_come_behind():
    """The own bricks keep their rows; without any more it is the same model."""
    assembly = model()
    more = assembly.with_more([table(("3005", 8, 8, 0)), table(("3005", 9, 9, 0))])
    assert more.bricks.corner[:, 0].tolist() == [0, 3, 8, 9]
    assert more.graph.n_components == 3
    assert assembly.with_more([]) is assembly
