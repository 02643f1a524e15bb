"""What goes on together."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.blocking import column_pairs
from legorize_addon.core.building.items import MOST
from legorize_addon.core.building.units import LARGEST, Hangers, find_units, presses
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.contacts import contact_graph
from tests.core.building.heaps import reached
from tests.core.standing import CATALOGUE, table


def units(*rows, node=None, ground=None, piece=None):
    """Return the units of bricks."""
    bricks = table(*rows)
    level = bricks.corner[:, 2].astype(np.int64)
    node = np.arange(len(bricks)) if node is None else np.array(node)
    ground = level == level.min() if ground is None else np.array(ground)
    pairs = contact_graph(bricks, CATALOGUE).pairs
    return find_units(node, level, pairs, column_pairs(bricks, CATALOGUE), ground=ground, piece=piece)


def groups(found):
    """Return the bricks of each unit."""
    return sorted(np.flatnonzero(found.unit == unit).tolist() for unit in np.unique(found.unit))


def test_standing_bricks_are_units_of_their_own():
    """A tower has one unit a brick, each before the next."""
    found = units(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6))
    assert groups(found) == [[0], [1], [2]]
    assert found.before.tolist() == [[0, 1], [1, 2]]


def test_what_rests_on_a_unit_comes_after_it():
    """Two beams over one hanging plate: one of them takes it along, the other is put onto both later."""
    found = units(("3003", 0, 0, 0), ("3003", 6, 0, 0), ("3010", 0, 0, 3), ("3010", 4, 0, 3), ("3023", 3, 0, 2))
    assert groups(found) == [[0], [1], [2, 4], [3]]
    assert [found.unit[2], found.unit[3]] in found.before.tolist()
    assert not found.pressed.any()


HOOKS = (
    *(("3003", 0, 0, 3 * k) for k in range(3)),
    ("3008", 0, 0, 9),
    ("3008", 0, 1, 9),
    ("3024", 3, 0, 8),
    ("3023", 3, 0, 7, 1),
    ("3024", 2, 1, 8),
    ("3023", 2, 0, 7, 1),
)
"""Two beams; below each hangs a plate that reaches under the other one without touching it."""


def test_units_that_each_wait_for_the_other_are_given_up():
    """Hooks that do not hang together cannot be put on as one: what hangs is pressed from below, what stands is not."""
    found = units(*HOOKS)
    assert np.flatnonzero(found.pressed).tolist() == [5, 6, 7, 8]
    assert groups(found) == [[row] for row in range(9)]
    assert not found.loose.any()


def test_units_that_each_wait_for_the_other_become_one():
    """Hooks that a plate holds together are one sub-assembly, however few other bricks are on the table."""
    across = ("3023", 5, 0, 8, 1)
    found = units(*HOOKS, across)
    assert list(range(3, 10)) in groups(found)
    assert not found.pressed.any()
    # but never all that is on the table, which would be a table of its own again
    found = units(*HOOKS[3:], across, ground=[True] * 2 + [False] * 5)
    assert len(groups(found)) > 1


@pytest.mark.parametrize(("n", "together"), [(52, True), (51, False)])
def test_large_sub_assemblies_are_a_quarter_at_most(n, together):
    """Of more bricks than a step has, a sub-assembly is at most a quarter of all."""
    chains = [("3024", x, y, z) for x, y in ((3, 0), (2, 1)) for z in (8, 7, 6, 5)]
    hooks = (*HOOKS[:5], *chains, ("3023", 3, 0, 4, 1), ("3023", 2, 0, 4, 1), ("3023", 5, 0, 8, 1))
    found = units(*hooks, *(("3003", 0, 6, 3 * k) for k in range(n - len(hooks))))
    assert len(hooks) - 3 == MOST + 1
    assert (list(range(3, len(hooks))) in groups(found)) == together
    assert found.pressed.any() != together


def test_under_a_piece_it_is_pressed():
    """A piece takes nothing along: what hangs from it alone is pressed, after it was joined."""
    bricks = (("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6), ("3024", 3, 0, 5))
    found = units(*bricks, node=[0, 1, 1, 2], ground=[True, False, False, False])
    assert found.pressed.tolist() == [False, False, False, True]
    assert [found.unit[2], found.unit[3]] in found.before.tolist()


def test_pieces_under_which_something_hangs_press():
    """What would have to be pressed under a piece is found before the piece is made."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6), ("3024", 3, 0, 5))
    below = column_pairs(bricks, CATALOGUE)
    assert presses(Assembly(bricks, CATALOGUE), below, np.array([0, 5, 5, 9]))
    assert not presses(Assembly(bricks, CATALOGUE), below, np.arange(4))


def test_what_nothing_holds_is_loose():
    """A brick in the air is named."""
    assert units(("3003", 0, 0, 0), ("3003", 9, 0, 3)).loose.tolist() == [False, True]


def test_rank_decides_who_takes_along_what_hangs():
    """Of two beams of one level over a plate, the one of the lesser rank takes it along."""
    bricks = table(("3003", 0, 0, 0), ("3003", 6, 0, 0), ("3010", 0, 0, 3), ("3010", 4, 0, 3), ("3023", 3, 0, 2))
    level = bricks.corner[:, 2].astype(np.int64)
    pairs, below = contact_graph(bricks, CATALOGUE).pairs, column_pairs(bricks, CATALOGUE)
    for first, expected in ((2, [2, 4]), (3, [3, 4])):
        rank = (np.arange(5) != first).astype(np.int64)
        found = find_units(np.arange(5), level, pairs, below, ground=level == 0, hangers=Hangers(rank))
        assert expected in groups(found)


def test_what_leans_is_left_to_others():
    """Of two beams over a plate the first takes it along, but not if it leans with it and the other does not."""
    rows = ("3003", 0, 0, 0), ("3003", 6, 0, 0), ("3010", 0, 0, 3), ("3010", 4, 0, 3), ("3023", 3, 0, 2)
    bricks = table(*rows)
    level = bricks.corner[:, 2].astype(np.int64)
    pairs = contact_graph(bricks, CATALOGUE).pairs
    below = column_pairs(bricks, CATALOGUE)
    for leaning, expected in (((), [2, 4]), ((2,), [3, 4]), ((3,), [2, 4]), ((2, 3), [2, 4])):
        hangers = Hangers(np.zeros(5, np.int64), lambda nodes, leaning=leaning: nodes[0] in leaning)
        found = find_units(np.arange(5), level, pairs, below, ground=level == 0, hangers=hangers)
        assert groups(found)[2 if expected[0] == 2 else 3] == expected


def test_a_brick_takes_along_what_a_piece_would_leave_to_be_pressed():
    """Under a beam of a piece and a single beam of the same level, a plate goes with the single one."""
    bricks = (
        *(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6)),
        *(("3003", 6, 0, 0), ("3003", 6, 0, 3), ("3010", 4, 0, 6), ("3023", 3, 0, 5)),
    )
    found = units(*bricks, node=[0, 1, 1, 2, 3, 4, 5], ground=[True, False, False, True, False, False, False])
    assert not found.pressed.any()
    assert [5, 6] in groups(found)


class Plain:
    """The rules of units in plain words, over sets of nodes and of pairs."""

    def __init__(self, node, level, pairs, below, ground, rank, piece):
        self.nodes = sorted(set(node))
        self.pairs, self.blocks = (
            {(node[a], node[b]) for a, b in those if node[a] != node[b]} for those in (pairs, below)
        )
        self.piece = {each: any(piece[k] for k in range(len(node)) if node[k] == each) for each in self.nodes}
        self.level = {each: min(level[k] for k, other in enumerate(node) if other == each) for each in self.nodes}
        self.rank = {each: max((k, rank[k]) for k, other in enumerate(node) if other == each)[1] for each in self.nodes}
        self.held, self.pressed, self.hanger = set(), set(), {}
        self.unit = {each: {each} for each in self.nodes}
        self.hold({node[k] for k in range(len(node)) if ground[k]})
        asked = set()
        while left := self.asking - asked:
            head = min(left, key=lambda each: (self.piece[each], self.level[each], self.rank[each], each))
            asked.add(head)
            self.take(head)
        while self.untie():
            pass

    def hold(self, found):
        """Hold what is given and all that rests on it; each of them is asked what hangs below it."""
        self.asking = getattr(self, "asking", set())
        while found := found - self.held:
            self.held |= found
            self.asking |= found
            found = {upper for lower, upper in self.pairs if lower in found}

    def take(self, head):
        """Let a brick take along what hangs below it, or a piece have it pressed."""
        chain = [head]
        for each in chain:
            for one in sorted(lower for lower, upper in self.pairs if upper == each):
                if one not in self.held and one not in self.hanger:
                    self.hanger[one] = each
                    chain.append(one)
        whole = any(self.piece[each] for each in chain)
        for each in chain[1:]:
            if whole:
                self.pressed.add(each)
            else:
                self.join({each, head})
        self.held |= set(chain)
        self.hold({upper for lower, upper in self.pairs if lower in chain[1:]})

    def join(self, nodes):
        """Make the units of some nodes one."""
        whole = set().union(*(self.unit[each] for each in nodes))
        self.unit.update(dict.fromkeys(whole, whole))

    def root(self, each):
        """Return what is not pressed, from which a node hangs."""
        return self.root(self.hanger[each]) if each in self.pressed else each

    def before(self):
        """Return which nodes must come before which."""
        found = {(self.hanger[each], each) for each in self.pressed}
        for lower, upper in self.blocks:
            if lower not in self.pressed or self.root(lower) != self.root(upper):
                found |= {(lower, upper)} | ({(lower, self.root(upper))} if upper in self.pressed else set())
        return {(a, b) for a, b in found if a != b}

    def untie(self):
        """Make units that wait for each other one, or press what hangs among them; tell whether any changed."""
        edges = {(min(self.unit[a]), min(self.unit[b])) for a, b in self.before()}
        after = {each: {each} for each in self.nodes}
        for _ in self.nodes:
            for one, other in edges:
                after[one] |= after[other]
        heads = {min(unit) for unit in self.unit.values()}
        knots = {frozenset(b for b in after[a] if a in after[b]) for a in heads}
        changes = []
        for knot in sorted(knots, key=min):
            members = set().union(*(self.unit[each] for each in knot))
            if len(knot) == 1:
                continue
            inside = [pair for pair in self.pairs if members.issuperset(pair)]
            one = not any(self.piece[each] for each in members) and not members & self.pressed
            few = len(members) <= min(max(LARGEST * len(self.nodes), MOST), len(self.nodes) - 1)
            if one and few and reached([min(members)], inside) == members:
                self.join(members)
                changes.append(knot)
            else:
                self.unit.update({each: {each} for each in members})
                hanging = {each for each in members if each in self.hanger} - self.pressed
                self.pressed |= hanging
                changes += [knot] * bool(hanging)
        return bool(changes)


@settings(deadline=None, max_examples=120)
@given(st.integers(0, 10**6))
def test_units_are_those_of_the_plain_rules(seed):
    """Bricks at random levels, some of them in pieces, many hanging, some of which wait for each other."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 22))
    level = np.sort(rng.integers(0, rng.choice([3, 6]), n))
    below = np.sort(rng.integers(0, n, (int(rng.integers(0, 2 * n)), 2)), axis=1)
    below = np.unique(below[level[below[:, 0]] < level[below[:, 1]]], axis=0).astype(np.int32)
    pairs = below[rng.random(len(below)) < 0.8]
    node = np.unique(np.where(rng.random(n) < rng.choice([0, 0.2]), n // 2, np.arange(n)), return_inverse=True)[1]
    ground, rank = level == 0, rng.integers(0, 3, n)
    ground &= rng.random(n) < rng.choice([0.4, 1])
    piece = (np.bincount(node) > 1)[node]
    told = {"piece": piece | (node == rng.integers(0, n))} if rng.random() < 0.5 else {}
    found = find_units(node, level, pairs, below, ground=ground, hangers=Hangers(rank), **told)
    columns = (each.tolist() for each in (node, level, pairs, below, ground, rank, told.get("piece", piece)))
    plain = Plain(*columns)
    expected = [
        [row for row in range(n) if node[row] in unit]
        for unit in map(set, {frozenset(each) for each in plain.unit.values()})
    ]
    assert groups(found) == sorted(expected)
    assert found.pressed.tolist() == [each in plain.pressed for each in node.tolist()]
    assert found.loose.tolist() == [each not in plain.held for each in node.tolist()]
    of_node = {each: int(unit) for each, unit in zip(node.tolist(), found.unit.tolist(), strict=True)}
    assert {tuple(pair) for pair in found.before.tolist()} == {
        (of_node[a], of_node[b]) for a, b in plain.before() if of_node[a] != of_node[b]
    }


def test_a_piece_of_one_brick_takes_nothing_along():
    """What hangs from it is pressed under it; and a piece that hangs is put on after what it hangs from."""
    bricks = (("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3010", 0, 0, 6), ("3024", 3, 0, 5))
    for row in (2, 3):
        found = units(*bricks, piece=np.arange(4) == row)
        assert found.pressed.tolist() == [False, False, False, True]
        assert groups(found) == [[0], [1], [2], [3]]
