"""What the settings mean for the stages."""

from __future__ import annotations

import pytest

from legorize_addon.core.estimate import AGAIN
from legorize_addon.core.progress import Overall, silent
from legorize_addon.core.settings import Settings
from legorize_addon.core.stages import Run


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
