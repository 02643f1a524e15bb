"""What the settings mean for whether a model stands."""

from __future__ import annotations

from dataclasses import replace

import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.stages import make_plan
from legorize_addon.core.statics.stability import stability
from legorize_addon.core.strength import (
    brace,
    carry,
    check_final,
    check_stability,
    check_strong,
    strengthen_joints,
    take_fewer_lots,
)
from scripts.benchmarks.stablelego import stair
from tests.core.any_bricks import table as bricks_of
from tests.core.owned.test_other_parts import apart, brick
from tests.core.standing import CATALOGUE, table
from tests.core.test_stages import run_of


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
    assert brace(run, assembly, weak, None) == (assembly, weak)


@pytest.mark.parametrize(("supports", "pillars"), [("best", 1), ("none", 0)])
def test_floating_bricks_get_pillars_if_there_may_be_supports(supports: str, pillars: int):
    """A brick in the air is carried by a pillar, or left where it is and told."""
    floating = Assembly(table(("3003", 0, 0, 0), ("3003", 0, 0, 6)), CATALOGUE)
    run = run_of(supports=supports)
    assembly = carry(run, floating)
    found = check_stability(run, assembly, None)
    assert (assembly.bricks.role == Role.SUPPORT_KEPT).sum() == pillars
    assert bool(len(found.unsupported)) != bool(pillars)


def test_supports_that_stay_change_the_proof_where_they_stand():
    """With more bricks, the forces of a stair stay those of its proof; what is no proof is not begun from."""
    run, stairs = run_of(), Assembly(table(*stair(2)), CATALOGUE)
    found = check_stability(run, stairs, None)
    assert found.iterations
    more = stairs.with_more([table(("3003", 20, 0, 0), ("3003", 20, 0, 3))])
    again = check_final(run, more, found)
    assert again.stable
    assert again.iterations == 0
    assert again.margin[: len(stairs)] == pytest.approx(found.margin)
    assert check_final(run, more, replace(found, standing=Verdict.UNDECIDED)).iterations


def test_what_pillars_will_carry_is_not_tested_before():
    """A tower that tips over is known to from its ties: it is tested if nothing may stand under it, or was added."""
    assembly = Assembly(table(("3003", 0, 0, 0), ("3007", 0, 0, 3)), CATALOGUE)
    sparing = stability(assembly, clutch=0.56)
    assert check_strong(run_of(), assembly, sparing) is None
    assert check_strong(run_of(supports="none"), assembly, sparing) is not None
    assert check_strong(run_of(), assembly.with_more([table(("3003", 20, 0, 0))]), sparing) is not None
    braced, found = brace(run_of(), assembly, None, sparing)
    assert found.stable
    assert len(braced) > len(assembly)


def test_fewer_lots_only_where_the_model_stands_as_well():
    """A 1 x 6 is split if it is asked for; not where the two halves would fall off what the whole one hangs on."""
    rows = [brick(4, 0), brick(4, 4), brick(6, 0, course=1), *apart(2, 4)]
    assembly = Assembly(bricks_of(rows), CATALOGUE)
    found = stability(assembly)
    assert take_fewer_lots(run_of(), assembly, found) == (assembly, found, ())
    other, again, said = take_fewer_lots(run_of(few_lots=1.0), assembly, found)
    assert said == ("For fewer lots 1 brick was split into parts that the model has anyway.",)
    assert len(other) == len(assembly) + 1
    assert again.stable
    # a mast on the middle of the beam, and heavy ends that hang on it
    held = [brick(2, 2), brick(6, 0, course=1), *apart(2, 4)]
    ends = [brick(8, 0, y, course) for course in (2,) for y in (0,)]
    model = Assembly(bricks_of([*held, *ends, *apart(8, y=40)]), CATALOGUE)
    before = stability(model)
    after, _, _ = take_fewer_lots(run_of(few_lots=1.0), model, before)
    assert stability(after).stands >= before.stands
