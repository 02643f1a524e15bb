"""What the settings mean for the stages."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from legorize_addon.core import stages
from legorize_addon.core.estimate import AGAIN
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.progress import Overall, silent
from legorize_addon.core.run import Run
from legorize_addon.core.settings import Settings
from legorize_addon.core.supports import SAVING
from scripts.research.five_kinds import KINDS
from tests.core.solids import box
from tests.core.textured import painted


def run_of(**options) -> Run:
    """Return a run that begins."""
    return Run.of(Settings(**options), Overall({"layout": 1.0}, silent))


def test_same_seed_same_numbers():
    """The random numbers of a run follow from its seed alone."""
    first, second, other = (run_of(seed=seed).rng.random(4).tolist() for seed in (3, 3, 4))
    assert first == second != other


def test_palette_of_the_settings():
    """The codes that were asked for, and all of today's colours if none were."""
    assert run_of(palette="4, 15").palette.tolist() == [4, 15]
    assert len(run_of().palette) > 30


def test_what_is_done_again_counts_to_what_it_repeats():
    """Seconds are noted by stage, each once, and a stage that fails has none."""
    run = run_of()
    for name in ("layout", f"layout{AGAIN}"):
        with run.stage(name):
            assert name == "layout" or run.timings["layout"] >= 0
    with pytest.raises(ZeroDivisionError), run.stage("ties"):
        raise ZeroDivisionError
    assert list(run.timings) == ["layout"]


@pytest.mark.parametrize("dithering", ["none", "ordered"])
def test_replaced_colours_are_built(dithering):
    """No brick has a colour that was replaced, mixed from others or not, and those that were hold the other one."""
    mesh = painted(box([0.0, 0.0, 0.0], [4.0, 3.0, 2.0]), 4)
    plain = legorize(mesh, Settings(width=8, dithering=dithering))
    code = int(np.bincount(plain.bricks.colour).argmax())
    other = next(each for each in (4, 15, 1) if each not in plain.bricks.colour)
    made = legorize(mesh, Settings(width=8, dithering=dithering, replace_colours=f"{code}={other}"))
    assert code not in made.grid.colour
    assert (made.grid.colour == other).sum() > 0
    assert code in plain.grid.colour


def test_a_model_is_split_where_that_saves_supports():
    """Not where it was only expected to: a figure that takes more supports in two pieces stays whole, and says so."""
    whole, found = (legorize(KINDS["character"](), Settings(width=14, hanging=0, split=most)) for most in (1, 2))
    saved = 1 - len(found.supports.removed) / len(whole.supports.removed)
    assert saved >= SAVING if len(found.supports.pieces) > 1 else saved == 0
    assert len(found.joints) == len(found.supports.pieces) - 1
    told = [note for note in found.notes if "stays in one piece" in note]
    assert len(told) == (len(found.supports.pieces) == 1)


def test_the_next_cut_is_tried_where_one_saves_too_little(monkeypatch):
    """Cuts are barred from the last one on; what hangs in the air weighs more than supports."""
    barred = []

    def made(number, in_air=0):
        return SimpleNamespace(removed=range(number), walk=SimpleNamespace(in_air=range(in_air)))

    plans = {"whole": made(10, in_air=1), "first": made(9, in_air=1), "second": made(20)}
    cuts = {frozenset(): ("first", (SimpleNamespace(level=3), SimpleNamespace(level=9)))}
    cuts[frozenset({9})] = ("second", (SimpleNamespace(level=6),))
    monkeypatch.setattr(stages, "make_plan", lambda run, assembly, kinds: plans[assembly])
    monkeypatch.setattr(stages, "cut_pieces", lambda run, whole, no: barred.append(no) or cuts.get(no, (whole, ())))
    assert stages.plan_pieces(run_of(), "whole", *cuts[frozenset()]) == (plans["second"], cuts[frozenset({9})][1])
    assert barred == [frozenset({9})]
    plans["second"] = made(10, in_air=1)
    assert stages.plan_pieces(run_of(), "whole", *cuts[frozenset()]) == (plans["whole"], ())
    assert barred[1:] == [frozenset({9}), frozenset({9, 6})]
    # without supports nobody counts them
    assert stages.plan_pieces(run_of(supports="none"), "whole", *cuts[frozenset()])[0] == plans["first"]


def test_no_cut_is_planned_in_vain(monkeypatch):
    """Of more cuts than may be tried, each is planned once, and each plan is weighed."""
    planned = []

    def plan(run, assembly, kinds):
        planned.append(assembly)
        return SimpleNamespace(removed=range(10), walk=SimpleNamespace(in_air=()))

    monkeypatch.setattr(stages, "make_plan", plan)
    monkeypatch.setattr(stages, "cut_pieces", lambda run, whole, no: (len(no), (SimpleNamespace(level=len(no)),)))
    assert stages.plan_pieces(run_of(), "whole", 0, (SimpleNamespace(level=0),))[1] == ()
    assert planned == [0, "whole", *range(1, stages.CUTS)]
