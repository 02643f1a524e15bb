"""Shares of stages become one share of the whole run, and a time left."""

from __future__ import annotations

import pytest

from legorize_addon.core.progress import Meter, Overall, duration, part


def told_by(seconds, *stages):
    """Return what is told while stages run, each a name and the shares that it tells."""
    told: list[tuple[str, float]] = []
    overall = Overall(seconds, lambda stage, share: told.append((stage, share)))
    for name, shares in stages:
        with overall.stage(name) as progress:
            for share in shares:
                progress(name, share)
    overall.finish()
    return told


def test_shares_are_weighed_by_the_seconds():
    """A stage of three quarters of the time begins at a quarter, and is half done at five eighths."""
    told = told_by({"first": 1.0, "second": 3.0}, ("first", [0.5]), ("second", [0.5]))
    assert told == [
        *[("first", 0.0), ("first", 0.125), ("first", 0.25)],
        *[("second", 0.25), ("second", 0.625), ("second", 1.0)],
        ("second", 1.0),
    ]


def test_a_stage_that_tells_less_than_before_holds_the_share():
    """Shares that begin again within a stage, leave [0, 1], or come from a stage done twice never go back."""
    stages = ("long", [0.5, 0.1, 0.9, -1.0, 7.0]), ("short", [0.3]), ("long", [0.2]), ("unheard of", [0.5])
    shares = [share for _, share in told_by({"long": 3.0, "short": 1.0}, *stages)]
    assert shares == sorted(shares)
    assert shares[0] == 0
    assert shares[-1] == 1
    assert max(shares) == 1


def test_what_did_not_come_is_done_at_the_end():
    """If a stage is left out, the share still ends at 1."""
    told = told_by({"first": 1.0, "perhaps": 1.0}, ("first", []))
    assert told[-2:] == [("first", 0.5), ("first", 1.0)]


def test_parts_tell_the_name_of_their_own():
    """A part of a stage may have its own name and its own share from 0 to 1."""
    told: list[tuple[str, float]] = []
    overall = Overall({"layout": 1.0}, lambda stage, share: told.append((stage, share)))
    with overall.stage("layout") as progress:
        part(progress, 0.5, 0.75)("connection", 0.5)
    assert told[1] == ("connection", 0.625)


def test_nothing_expected_divides_by_nothing():
    """Stages that nobody expected to take time are told all the same."""
    assert told_by({}, ("first", [0.5]))[-1] == ("first", 1.0)


def test_time_left_is_told_from_the_second_stage_on():
    """A quarter done in 10 s leaves 30 s; in the first stage nobody knows."""
    now = [100.0]
    meter = Meter(lambda: now[0])
    assert meter.told == ("Starting", 0.0)
    assert meter.seconds_left is None
    meter("first", 0.0)
    now[0] += 4
    meter("first", 0.2)
    assert meter.seconds_left is None
    now[0] += 6
    meter("second", 0.25)
    assert meter.told == ("second", 0.25)
    assert meter.seconds_left == pytest.approx(30)
    now[0] += 10
    assert meter.seconds_left == pytest.approx(60)
    meter("second", 1.0)
    assert meter.seconds_left == 0


def test_time_left_goes_by_what_is_done_since_a_new_start():
    """What cannot be foreseen is not told; then 100 frames of 3 s take 300 s, however short the rest of the bar is."""
    now = [0.0]
    meter = Meter(lambda: now[0])
    meter("first", 0.0)
    meter.leave_open()
    now[0] = 10
    meter("second", 0.5)
    assert meter.seconds_left is None
    meter("film", 0.8)
    now[0] = 20
    meter.start_anew()
    meter("film", 0.8)
    assert meter.seconds_left is None
    for frame in (1, 40, 99):
        now[0] = 20 + 3 * frame
        meter("film", 0.8 + 0.2 * frame / 100)
        assert meter.seconds_left == pytest.approx(3 * (100 - frame))
    meter("film", 1.0)
    assert meter.seconds_left == 0


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.2, "1 s"), (44.6, "45 s"), (60, "1 min"), (200, "3 min"), (5400, "1.5 h")]
)
def test_durations_are_short(seconds, words):
    """A time left fits beside a progress bar."""
    assert duration(seconds) == words
