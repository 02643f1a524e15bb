"""What is kept of runs, for how long, and what a later run reaches."""

from __future__ import annotations

import numpy as np

from legorize_addon.core import memo as module
from legorize_addon.core.memo import Memo, plainly, reached

SIZE = 10_000


def kept(memo: Memo, *numbers: int) -> list[int]:
    """Run a work for each number; return for which it was done."""
    done = []
    trial = memo.trial()
    for number in numbers:

        def work(number=number):
            done.append(number)
            return np.full(SIZE, number)

        assert trial.call("fill", (number,), work)[0] == number
    memo.keep(trial)
    return done


def test_a_work_is_done_once():
    """In one run and in later ones; what is not kept is not known; all is forgotten on demand."""
    memo = Memo()
    assert kept(memo, 1, 2, 1) == [1, 2]
    assert kept(memo, 2, 3) == [3]
    memo.trial().call("fill", (9,), lambda: 9)
    assert kept(memo, 9) == [9]
    afresh = memo.trial(afresh=True)
    assert afresh.call("fill", (1,), lambda: "anew") == "anew"
    memo.clear()
    assert len(memo) == memo.nbytes == 0
    assert kept(memo, 1) == [1]
    assert plainly("fill", (1,), lambda: "plain") == "plain"


def test_memory_is_bounded_and_told():
    """What was used longest ago goes first; shared arrays count once."""
    memo = Memo(limit=int(3.5 * SIZE * 8))
    kept(memo, 1, 2, 3)
    assert 3 * SIZE * 8 <= memo.nbytes < 3.1 * SIZE * 8
    kept(memo, 1)
    kept(memo, 4)
    assert len(memo) == 3
    assert memo.nbytes <= memo.limit
    assert kept(memo, 1, 3, 4) == []
    assert kept(memo, 2) == [2]
    shared, two = np.zeros(SIZE), Memo()
    trial = two.trial()
    for number in range(5):
        trial.call("share", (number,), lambda: shared)
    two.keep(trial)
    assert two.nbytes < 1.2 * SIZE * 8


def test_a_result_is_weighed_once(monkeypatch):
    """What was weighed when it was kept first counts as much later; one that went and comes back is weighed again."""
    memo, weighed = Memo(limit=int(2.5 * SIZE * 8)), []
    weigh = module._weights
    monkeypatch.setattr(module, "_weights", lambda entry: weighed.append(entry.inputs[0]) or weigh(entry))
    kept(memo, 1, 2)
    before = memo.nbytes
    kept(memo, 2, 1)
    assert (weighed, memo.nbytes) == ([1, 2], before)
    kept(memo, 3)
    kept(memo, 2)
    assert weighed == [1, 2, 3, 2]
    memo.clear()
    kept(memo, 3)
    assert weighed[-1] == 3


def test_a_result_larger_than_the_memory_is_not_kept():
    """It would push out all others for nothing."""
    memo = Memo(limit=100)
    assert kept(memo, 1) == [1]
    assert (len(memo), memo.nbytes) == (0, 0)


def test_what_a_change_reaches():
    """A step whose answers differ, all that were given its results, and those that draw random numbers after it."""
    trial = Memo().trial()
    cells, bricks = np.zeros(3), np.ones(3)
    for stage, inputs, asked, output, left in (
        ("mesh", (), {"settings.width": 48}, cells, {}),
        ("colours", (cells,), {"rng": 1}, bricks, {"rng": 2}),
        ("hollow", (cells,), {"settings.shell": 1}, cells, {}),
        ("layout", (), {"rng": 2}, np.zeros(4), {"rng": 3}),
        ("supports", (bricks,), {"settings.supports": "best"}, np.zeros(5), {}),
    ):
        trial.stage = stage
        trial.add(stage, inputs, asked, output, **left)
    now = {"settings.width": 48, "rng": 1, "settings.shell": 1, "settings.supports": "best"}

    def after(**changes):
        return reached(trial.steps(), (now | {f"settings.{name}": value for name, value in changes.items()}).get)

    assert after() == ()
    assert after(supports="none") == ("supports",)
    assert after(shell=2) == ("hollow",)
    assert after(width=8) == ("mesh", "colours", "hollow", "layout", "supports")
    now["rng"] = 5
    assert after() == ("colours", "layout", "supports")
