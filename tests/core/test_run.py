"""A run with a memo gives exactly what it gives without one."""

from __future__ import annotations

from dataclasses import fields, replace

import pytest
from hypothesis import given
from hypothesis import settings as budget
from hypothesis import strategies as st

from legorize_addon.core.build import Build
from legorize_addon.core.errors import Cancelled, LegorizeError
from legorize_addon.core.files import write_ldr, write_mpd
from legorize_addon.core.memo import Memo, reached
from legorize_addon.core.model import Assembly, load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.progress import Overall, silent
from legorize_addon.core.run import Run
from legorize_addon.core.settings import Settings, choices
from tests.core.textured import split_at_x, table

MESH = split_at_x(table(leg=16.0))
"""Of two colours, with a table top that needs supports."""

START = Settings(width=6, cm=5.0, palette="0 1 4 15 70", layout="fast")


def files_of(build: Build) -> tuple[str, str]:
    """Return the files that must be the same byte for byte."""
    whole = Assembly(build.supports.bricks, load_catalogue())
    return (
        write_ldr(build.supports.final_alone, name="model.ldr", title="t", follow="model.mpd"),
        write_mpd(whole, build.supports.steps, name="model.ldr", title="t"),
    )


def updated(memo: Memo, settings: Settings) -> Build:
    """Run with what is known, and keep what comes of it."""
    trial = memo.trial()
    build = legorize(MESH, settings, trial=trial)
    memo.keep(trial)
    return build


def other_value(name: str):
    """Return another value of a setting than it has at the start; None for what has no effect without files."""
    entry = next(entry for entry in fields(Settings) if entry.name == name)
    value, special = (
        getattr(START, name),
        {"palette": "0 1 4 15 72", "width": 8, "parts": 30, "replace_colours": "4=1", "weight": "face"},
    )
    if name in special:
        return special[name]
    if entry.metadata["files"] or name == "learned_from" or {"prices", "owned"} & {*entry.metadata["needs"]}:
        return None
    if choices(entry):
        words = [
            word
            for word in choices(entry)
            if word not in (value, "height", "scale", "budget", "learned", "parts", "cheapest")
        ]
        return words[0]
    if isinstance(value, bool):
        return not value
    if isinstance(value, float):
        return min(value * 1.5 + 0.05, entry.metadata["high"])
    return value + 1


WALKED = tuple(
    entry.name
    for entry in fields(Settings)
    if entry.metadata["group"] not in ("Mosaic", "Limits") and other_value(entry.name) is not None
)


@pytest.fixture(scope="module")
def base() -> Memo:
    """Return what a run with the settings of the start leaves."""
    memo = Memo()
    updated(memo, START)
    return memo


@pytest.mark.parametrize("name", WALKED)
def test_every_setting_by_itself(base, name):
    """An update after a change of one setting is a full run with it."""
    try:
        changed = replace(START, **{name: other_value(name)})
        full = files_of(legorize(MESH, changed))
    except LegorizeError:
        return
    assert files_of(legorize(MESH, changed, trial=base.trial())) == full


CHANGES = st.sampled_from(
    [
        {"supports": "tree"},
        {"supports": "none"},
        {"hanging": 0},
        {"palette": "1 4 70"},
        {"palette": "0 15"},
        {"colours": 1},
        {"plates": "none"},
        {"symmetric": False},
        {"seed": 3},
        {"layout": "standard"},
        {"support_parts": "paper"},
        {"split": 3},
        {"clutch": 0.05},
        {"mass_weight": 0.5},
        {"few_lots": 5.0},
        {},
    ]
)


@budget(max_examples=3, deadline=None)
@given(st.lists(CHANGES, min_size=2, max_size=2))
def test_random_updates_are_full_runs(changes):
    """However settings change one after the other, with a memo that is too small for all, too."""
    memo, settings = Memo(limit=1_000_000), START
    for change in changes:
        settings = replace(settings, **change)
        assert files_of(updated(memo, settings)) == files_of(legorize(MESH, settings))
        assert memo.nbytes <= memo.limit


def test_an_update_does_what_is_reached(base):
    """Nothing for the same settings, the supports alone for other supports; a tooltip can say so before."""
    trial = base.trial()
    legorize(MESH, START, trial=trial)
    steps = trial.steps()
    assert set(trial.entries) <= set(base.entries)

    def stages(**changes):
        run = Run.of(replace(START, **changes), Overall({}, silent))
        return reached(steps, run.answer)

    assert stages() == ()
    assert stages(supports="tree") == ("supports",)
    assert stages(split=2)[-2:] == ("pieces", "supports")
    assert stages(width=7)[0] == "mesh"
    assert "mesh" not in stages(palette="4 15")
    assert "mesh" not in stages(seed=1)


def test_a_cancelled_update_leaves_the_memo(base):
    """What it found until then is not known afterwards."""
    before, trial = (len(base), base.nbytes), base.trial()

    def stop(stage, share):
        if stage == "layout":
            raise Cancelled

    with pytest.raises(Cancelled):
        legorize(MESH, replace(START, plates="none"), stop, trial=trial)
    assert (len(base), base.nbytes) == before
    assert len(trial.entries) > 3


def test_what_a_machine_decided_is_told_again():
    """The learned layout tells what it did, also where it is taken over from an earlier run."""
    memo, learned = Memo(), replace(START, layout="learned")
    first = updated(memo, learned)
    again = updated(memo, replace(learned, supports="tree"))
    told = [[note for note in build.notes if "machine" in note] for build in (first, again)]
    assert told[0] == told[1] != []


def test_nested_works_tell_the_larger_one(base):
    """A work inside another one is known by itself, and what it asks for counts for the larger one as well."""

    def small(run: Run) -> float:
        return run.rng.random() + run.settings.width

    def large(run: Run) -> tuple[float, float, int]:
        return run.once(small), run.rng.random(), run.settings.hanging

    def runs(trial, **changes):
        run = Run.of(replace(START, **changes), Overall({}, silent), trial)
        return run.once(large), run.rng.random()

    memo = Memo()
    for changes, n_new in (({}, 2), ({}, 0), ({"hanging": 5}, 1), ({"width": 9}, 2), ({"seed": 2}, 2)):
        trial, before = memo.trial(), len(memo)
        assert runs(trial, **changes) == runs(None, **changes)
        memo.keep(trial)
        assert len(memo) - before == n_new
    [least] = [entry for entry in memo.entries if entry.name.endswith("small")][:1]
    assert set(least.asked) == {"rng", "settings.width"}
    largest = [entry for entry in memo.entries if entry.name.endswith("large")]
    assert set(largest[-1].asked) == {"rng", "settings.width", "settings.hanging"}
