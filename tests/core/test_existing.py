"""Brick models of others: read, judged and laid again; our own files give the same bricks back."""

from __future__ import annotations

import csv
import io
from collections import Counter
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from legorize_addon.core.existing import Existing, moved_up, without_overlaps
from legorize_addon.core.files.ldraw import write_ldr
from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.pipeline import judge, legorize
from legorize_addon.core.report.checks import failed_checks
from legorize_addon.core.report.outputs import output_texts
from legorize_addon.core.report.report import report
from legorize_addon.core.report.summary import summary
from legorize_addon.core.settings import Settings
from tests.core.any_bricks import CATALOGUE, multiset, table
from tests.core.foreign import FILES, along
from tests.core.half_studs.tower import tower
from tests.core.layout.test_again import shown
from tests.core.textured import painted
from tests.core.textured import table as table_mesh

ONE = CATALOGUE.part_row("3005")
FAST = Settings(layout="fast")
BEST = {
    "running-bond.ldr": (102, 12, 50), "stacked-columns.ldr": (60, 12, 20), "random-sizes.ldr": (190, 2, 40),
    "all-ones.ldr": (271, 57, 70), "plates-and-bricks.ldr": (192, 32, 24), "turned-sub-models.ldr": (160, 40, 40),
    "nested.mpd": (64, 16, 12), "unknown-parts.ldr": (96, 24, 20), "off-lattice.ldr": (60, 12, 12),
    "direct-colours.ldr": (128, 64, 12),
}  # fmt: skip
"""Of each file its bricks, its components, and how many bricks a good layout needs at most."""


def existing(text):
    """Return what is read of a text."""
    found = read_ldraw(text, CATALOGUE)
    return Existing.of(found)


def facts_of(model):
    """Return the report of a model."""
    facts = report(model, CATALOGUE, version="1", mm_per_unit=1000.0)
    return facts | {"failed_checks": failed_checks(facts)}


@pytest.mark.parametrize("name", FILES)
def test_files_of_others_are_judged_and_laid_again(name):
    """Every brick is read, the verdict is confirmed, the report is whole; laid again it is the same in fewer parts."""
    given = existing(FILES[name]())
    bricks, components, most = BEST[name]
    judged, better = (judge(given, FAST, again=again) for again in (False, True))
    assert len(judged.bricks) == len(given.bricks) == bricks
    assert judged.graph.n_components == components
    assert judged.stability.check()
    assert (judged.stability.verdict is Verdict.COLLAPSES) == (name == "all-ones.ldr")
    assert len(better.bricks) <= most
    assert better.stability.verdict is Verdict.STABLE
    assert better.stability.check()
    lasting = moved_up(better.bricks)
    assert shown(lasting.take(lasting.role < 4)) == shown(moved_up(given.bricks))
    facts = facts_of(judged)
    assert facts["counts"]["bricks"] == bricks
    assert "input" not in facts
    assert facts["left_out_parts"] == ({"60592": 2, "60623": 1} if name == "unknown-parts.ldr" else {})
    assert summary(facts, "out", ["model.ldr"])[0].startswith(f"Model: {bricks} bricks in")
    files = output_texts(judged, CATALOGUE, facts, name)
    assert {"model.ldr", "model.mpd", "build_order.csv", "parts.csv", "bricklink.xml"} <= set(files)
    assert not [file for file in files if file.startswith("tables")]
    check_sums(files)


def check_sums(files):
    """Compare every list with the bricks of the .ldr, lot by lot, by readers of the standard library."""
    wanted = Counter(
        (words[14].removesuffix(".dat"), int(words[1]))
        for words in (line.split() for line in files["model.ldr"].splitlines())
        if words[:1] == ["1"]
    )
    colours = {colour.code: colour for colour in CATALOGUE.colours}
    tables = {name: list(csv.DictReader(io.StringIO(text))) for name, text in files.items() if name.endswith(".csv")}
    assert Counter({(row["part"], int(row["colour"])): int(row["count"]) for row in tables["parts.csv"]}) == wanted
    assert {(row["Part"], int(row["Color"])): int(row["Quantity"]) for row in tables["rebrickable.csv"]} == {
        (part, colours[code].rebrickable): count for (part, code), count in wanted.items()
    }
    for rows in ([(row["LdrawId"], int(row["LDrawColorId"]), int(row["Qty"])) for row in tables["studio.csv"]],):
        assert {(part, code): count for part, code, count in rows} == wanted
    elements = {row["element"]: (row["part"], int(row["colour"])) for row in tables["parts.csv"]}
    bought = Counter()
    for row in tables["pick-a-brick.csv"]:
        bought[elements[row["elementId"]]] += int(row["quantity"])
    assert bought == Counter({lot: count for lot, count in wanted.items() if lot in elements.values()})
    items = [{field.tag: field.text for field in item} for item in ElementTree.fromstring(files["bricklink.xml"])]
    named = {(each["ITEMID"], int(each["COLOR"])): int(each["REMARKS"].split(": ")[-1].split(",")[0]) for each in items}
    assert named == {(part, colours[code].bricklink): count for (part, code), count in wanted.items()}
    figures = {row["figure"]: row["value"] for row in tables["totals.csv"]}
    assert int(figures["bricks"]) == wanted.total()


@pytest.fixture(scope="module")
def own():
    """Return our own model of a table, with its supports, and its files."""
    build = legorize(painted(table_mesh(), 4), Settings(width=16, layout="fast", hanging=0))
    assert len(build.supports.removed)
    return build, output_texts(build, CATALOGUE, {}, "table")


def test_own_files_give_the_same_bricks_back(own):
    """The finished model of the .ldr; of the .mpd all bricks with their supports, and the same steps."""
    build, files = own
    for name, wanted in (("model.ldr", build.supports.final_alone.bricks), ("model.mpd", build.supports.bricks)):
        found = judge(existing(files[name]), build.settings)
        assert multiset(found.supports.bricks, steps=False) == multiset(wanted, steps=False)
        assert found.stability.verdict is build.stability.verdict
    assert len(found.supports.steps) == len(build.supports.steps)
    assert found.supports.walk.buildable
    # written and read again it is the same model
    again = output_texts(found, CATALOGUE, {}, "table")["model.mpd"]
    assert multiset(existing(again).bricks, steps=False) == multiset(build.supports.bricks, steps=False)


def test_lists_of_our_own_model_are_its_bricks(own):
    """With temporary supports, which are in lists of their own, every list has the bricks of the finished model."""
    build, files = own
    check_sums(files)
    removed = csv.DictReader(io.StringIO(files["support-parts.csv"]))
    assert sum(int(row["count"]) for row in removed) == len(build.supports.removed)


def test_models_with_half_studs_stay_as_they_are():
    """They are neither laid again nor given supports, which stand on one grid; both are told."""
    build = legorize(tower(0.5, 0.0), Settings(width=6, half_studs=True, hollow=False))
    found = judge(existing(write_ldr(build.assembly, name="a.ldr", title="a")), build.settings, again=True)
    assert len(found.bricks) == len(build.bricks)
    assert not len(found.supports.removed)
    assert any("cannot be laid again" in note for note in found.notes)
    assert any("No supports are planned" in note for note in found.notes)


def test_own_model_laid_again_keeps_no_supports(own):
    """Temporary supports are not part of what is laid again; new ones are planned."""
    build, files = own
    found = judge(existing(files["model.mpd"]), build.settings, again=True)
    assert len(found.bricks) <= len(build.bricks)
    assert found.supports.walk.buildable


def test_laid_again_for_less_money(tmp_path):
    """Where small bricks are nearly free, a wall of 1 x 4 is laid again in more of them, and the price is told."""
    (tmp_path / "prices.csv").write_text(
        "part,colour,price,currency\n3010,4,1.00,EUR\n3004,4,0.01,EUR\n3005,4,0.02,EUR\n", encoding="utf-8"
    )
    wall = [along(0, 0, 0, 4), along(4, 0, 0, 4), along(0, 0, 3, 2), along(2, 0, 3, 4), along(6, 0, 3, 2)]
    given = existing("\n".join(wall))
    options = {"prices": str(tmp_path / "prices.csv"), "unpriced": "exclude"}
    fewest = judge(given, Settings(**options), again=True)
    cheapest = judge(given, Settings(**options, goal="cheapest"), again=True)
    assert fewest.notes[0] == "No better layout than that of 5 bricks was found: the model stays as it is."
    assert len(cheapest.bricks) > 5
    count, cost = len(cheapest.bricks), cheapest.prices.each(cheapest.bricks, CATALOGUE).sum()
    assert cheapest.notes[0] == f"Laid again in {count} bricks for {cost:.2f} EUR instead of 5 bricks for 3.02 EUR."
    assert cost < 3.02
    assert cheapest.graph.n_components == 1


def test_laid_again_for_less_mass():
    """Where grams count, a heavier layout in fewer bricks is not better: told with what both weigh."""
    given = existing("\n".join(along(x, 0, 0, 1) for x in range(4)) + "\n" + along(0, 0, 3, 4))
    found = judge(given, Settings(layout="fast", mass_weight=0.1), again=True)
    before, after = (CATALOGUE.mass[bricks.part].sum() for bricks in (given.bricks, found.bricks))
    assert found.notes[0] == f"Laid again in 2 bricks of {after:.1f} g instead of 5 bricks of {before:.1f} g."


def test_steps_of_the_author_or_new_ones():
    """A wall of two courses in an order of its own keeps it, unless new steps are asked for."""
    lines = [f"1 4 {10 + 20 * x} {-24 * z} 10 1 0 0 0 1 0 0 0 1 3005.dat\n0 STEP" for x in range(3) for z in (1, 2)]
    given = existing("\n".join(lines))
    kept, planned = (judge(given, FAST, steps=steps) for steps in ("file", "new"))
    assert kept.supports.moves.step_of(6).tolist() == list(range(6))
    assert len(planned.supports.steps) < 6
    assert kept.supports.walk.buildable
    # without steps there is nothing to keep
    assert len(judge(replace(given, has_steps=False), FAST).supports.steps) < 6


def test_overlapping_bricks_are_left_out():
    """Of three bricks of which the middle one lies in both others the first and the last stay, and it is told."""
    bricks = table([(CATALOGUE.part_row("3004"), x, 0, 0, 0, 4, 0, 0, 0) for x in (0, 1, 2)])
    kept, notes = without_overlaps(bricks, CATALOGUE)
    assert kept.corner[:, 0].tolist() == [0, 2]
    assert notes == ("1 brick lies in others, left out.",)
    assert without_overlaps(kept, CATALOGUE) == (kept, ())
    assert "2 bricks lie in others, left out." in judge(Existing(bricks.take(np.array([0, 0, 0]))), FAST).notes


def test_models_below_the_ground_are_moved_up():
    """No coordinate is negative afterwards; a model that has none stays where it is."""
    bricks = table([(ONE, -3, 2, -4, 0, 4, 0, 0, 0), (ONE, 0, 0, 5, 0, 4, 0, 0, 0)])
    assert moved_up(bricks).corner.tolist() == [[0, 2, 0], [3, 0, 9]]
    fine = table([(ONE, 3, 2, 4, 0, 4, 0, 0, 0)])
    assert moved_up(fine) is fine
