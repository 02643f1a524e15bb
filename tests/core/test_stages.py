"""What the settings mean for the stages."""

from __future__ import annotations

import pytest

from legorize_addon.core.estimate import AGAIN
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.progress import Overall, silent
from legorize_addon.core.settings import Settings
from legorize_addon.core.stages import Run, brace, carry, check_stability, make_plan, strengthen_joints
from tests.core.standing import CATALOGUE, table


def run_of(**options) -> Run:
    """Return a run that begins."""
    return Run.of(Settings(**options), Overall({"layout": 1.0}, silent))


def test_same_seed_same_numbers():
    """The random numbers of a run follow from its seed alone."""
    first, second, other = (run_of(seed=seed).rng.random(4).tolist() for seed in (3, 3, 4))
    assert first == second != other


def test_supports_of_the_parts_of_the_paper():
    """A pillar that stays, and a tree under a wide top, are made of the paper's bricks alone; others of all parts."""
    bricks = table(*(("3003", 15, 2, 3 * k) for k in range(3)), *(("3007", x, y, 9) for x in (0, 8) for y in (0, 2, 4)))
    floating = table(("3003", 0, 0, 0), ("3003", 0, 0, 12))
    sizes = {}
    for parts in ("all", "paper"):
        run = run_of(support_parts=parts, supports="tree", hanging=0)
        made = make_plan(run, Assembly(bricks, CATALOGUE)).removed
        kept = carry(run, Assembly(floating, CATALOGUE)).bricks.take([2, 3, 4][: 3 if parts == "paper" else 1])
        sizes[parts] = {CATALOGUE.parts[part].number for part in (*made.part, *kept.part)}
    assert "14716" in sizes["all"]
    assert sizes["paper"] <= {"3005", "3004", "3622", "3010", "3009", "3003", "3002", "3001", "2456", "3007", "3008",
                              "30145", "30144"}  # fmt: skip
    assert "3007" in sizes["paper"]


def test_nothing_is_strengthened_if_that_is_not_wanted():
    """No plates are laid across joints and no pillars put under what is weak: it is only told how it stands."""
    run = run_of(strengthen=False)
    bricks = table(
        *(("3001", 4 * k, 0, 3 * k) for k in range(1)), *(("3009", 2 + 3 * k, 0, 3 + 3 * k) for k in range(6))
    )
    assembly = Assembly(bricks, CATALOGUE)
    assert strengthen_joints(run, bricks, None) == (bricks, None, None)
    weak = check_stability(run, assembly, None)
    assert weak.verdict is not Verdict.STABLE
    assert brace(run, assembly, weak) == (assembly, weak)


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


@pytest.mark.parametrize(("supports", "pillars"), [("best", 1), ("none", 0)])
def test_floating_bricks_get_pillars_if_there_may_be_supports(supports: str, pillars: int):
    """A brick in the air is carried by a pillar, or left where it is and told."""
    floating = Assembly(table(("3003", 0, 0, 0), ("3003", 0, 0, 6)), CATALOGUE)
    run = run_of(supports=supports)
    assembly = carry(run, floating)
    found = check_stability(run, assembly, None)
    assert (assembly.bricks.role == Role.SUPPORT_KEPT).sum() == pillars
    assert bool(len(found.unsupported)) != bool(pillars)
