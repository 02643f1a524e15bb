"""What the page in three dimensions knows."""

from __future__ import annotations

import json
from base64 import b64decode

import numpy as np
import pytest

from legorize_addon.core.building.moves import Action
from legorize_addon.core.instructions.panels import submodel_names
from legorize_addon.core.instructions.shots import shots
from legorize_addon.core.instructions.viewer import NEVER, _boxes, _ramps, _studs, viewer_data
from legorize_addon.core.model import columns, lines, outline, solid, turned
from legorize_addon.core.model.catalogue import footprint
from tests.core.any_bricks import CATALOGUE, everything
from tests.core.instructions.built import arm, pair


def data_of(plan):
    """Return the data of a model, and its tables of numbers."""
    text = viewer_data(
        plan.bricks, CATALOGUE, plan.steps, temporary=plan.temporary, tint=(1, 2, 3),
        names=submodel_names(plan.steps), pages={number: number // 2 * 2 for number in range(len(plan.steps))},
    )  # fmt: skip
    found = json.loads(text)
    kinds = {"boxes": "<f4", "studs": "<f4", "brick": "<u4", "colour": "u1"}
    kinds |= {"placed": "<u2", "removed": "<u2", "owner": "<u2"}
    return found, {name: np.frombuffer(b64decode(found[name]), kind) for name, kind in kinds.items()}


def there(found, numbers, step):
    """Return the bricks on the table of a step, by the rule of the page."""
    table, shown = found["table"][step], []
    for brick, (placed, removed, owner) in enumerate(
        zip(*(numbers[name].tolist() for name in ("placed", "removed", "owner")), strict=True)
    ):
        came, at = placed, owner
        if came > step or removed < step:
            continue
        while at not in (table, 0):
            came, at = max(came, found["joined"][at]), found["parent"][at]
        if at == table and came <= step:
            shown.append(brick)
    return shown


@pytest.mark.parametrize("model", [arm, pair])
def test_steps_show_what_the_booklet_shows(model):
    """On the table of each step are the bricks of its picture, those that are being taken out included."""
    plan = model()
    found, numbers = data_of(plan)
    for shot in shots(plan.steps, temporary=plan.temporary):
        expected = np.union1d(shot.stays, shot.new).tolist()
        assert there(found, numbers, shot.step.number) == expected


def test_parts_become_boxes():
    """The boxes of each brick cover its cells, and every stud is on one."""
    bricks = everything()
    boxes, owner = _boxes(bricks, CATALOGUE)
    for row in range(len(bricks)):
        part = CATALOGUE.parts[bricks.part[row]]
        if part.shaped:
            assert row not in owner
            continue
        cells = {
            (x + i - bricks.corner[row, 0], y + j - bricks.corner[row, 1])
            for x, y, _, wide, long, _ in boxes[owner == row].tolist()
            for i in range(int(wide))
            for j in range(int(long))
        }
        assert cells == {tuple(cell) for cell in footprint(part, int(bricks.turn[row])).tolist()}
        assert (boxes[owner == row, 5] == part.height).all()


def test_studs_of_the_page_are_those_of_the_parts():
    """Each square of a part with studs has one; tiles have none."""
    bricks = everything()
    plan = [(int(part), int(turn)) for part, turn in zip(bricks.part, bricks.turn, strict=True)]
    expected = sum(np.count_nonzero(columns(CATALOGUE.parts[part], turn).stud) for part, turn in plan)
    assert len(_studs(bricks, CATALOGUE)[0]) == expected


def test_slopes_become_ramps_of_their_volume():
    """The pieces of a slope fill its bounding box from side to side, have its volume, and are highest where it is."""
    bricks = everything()
    ramps, owner = _ramps(bricks, CATALOGUE)
    for row in range(len(bricks)):
        part, mine = CATALOGUE.parts[bricks.part[row]], ramps[owner == row]
        assert part.shaped == bool(len(mine))
        if not part.sloped:
            continue
        turn = int(bricks.turn[row])
        low, high = mine[:, :2].min(axis=0), (mine[:, :2] + mine[:, 3:5]).max(axis=0)
        assert low.tolist() == bricks.corner[row, :2].tolist()
        assert (high - low).tolist() == [*((part.width, part.length) if turn % 2 else (part.length, part.width))]
        volume = mine[:, 3:6].prod(axis=1) * (mine[:, 8] + mine[:, 9] - mine[:, 6] - mine[:, 7]) / 2
        assert volume.sum() == pytest.approx(
            solid(part, turn, 32, 32).mean() * part.length * part.width * part.height, rel=0.02
        )
        # where the high end is
        first = mine[np.argmin(mine[:, turn % 2]) if turn < 2 else np.argmax(mine[:, turn % 2])]
        assert first[2] + first[5] * first[9 if turn > 1 else 8] == pytest.approx(
            bricks.corner[row, 2] + lines(part)[0][0][1]
        )


def test_wedge_plates_become_strips_of_their_outline():
    """The strips of a wedge plate lie within its box, and their area is that of its outline."""
    bricks = everything()
    ramps, owner = _ramps(bricks, CATALOGUE)
    for row in range(len(bricks)):
        part, mine = CATALOGUE.parts[bricks.part[row]], ramps[owner == row]
        if not part.wedge:
            continue
        turn = int(bricks.turn[row])
        assert (mine[:, 10] == 2).all()
        assert (mine[:, 5] == part.height).all()
        corners = turned(part, turn, outline(part)) + bricks.corner[row, :2]
        low, high = mine[:, :2].min(axis=0), (mine[:, :2] + mine[:, 3:5]).max(axis=0)
        assert np.concatenate([low, high]) == pytest.approx([*corners.min(axis=0), *corners.max(axis=0)])
        area = mine[:, 3] * mine[:, 4] * (mine[:, 8] + mine[:, 9] - mine[:, 6] - mine[:, 7]) / 2
        x, y = corners.T
        assert area.sum() == pytest.approx((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)
        # every corner of the outline is one of a strip
        ends = [(x + t * wide, y + level * deep) for x, y, _, wide, deep, _, *levels, _ in mine.tolist()
                for t, level in zip((0, 1, 0, 1), levels, strict=True)]  # fmt: skip
        for corner in corners:
            assert np.abs(np.array(ends) - corner).sum(axis=1).min() < 1e-9


def test_tables_fit_together():
    """There is a brick for each box and stud, a colour for each brick, a name for each submodel."""
    plan = arm()
    found, numbers = data_of(plan)
    n = len(plan.bricks)
    assert len(numbers["boxes"]) // 6 + len(numbers["studs"]) // 3 == len(numbers["brick"])
    assert numbers["brick"].max() == n - 1
    assert len(numbers["colour"]) == 3 * n
    assert len(found["names"]) == len(found["parent"]) == len(plan.steps.submodels)
    assert len(found["table"]) == len(found["page"]) == len(plan.steps)
    assert (numbers["removed"] != NEVER).sum() == plan.temporary.sum()
    removals = plan.steps.moves.action == Action.REMOVE
    assert set(numbers["removed"][plan.temporary]) == set(plan.steps.moves.step[removals].tolist())
