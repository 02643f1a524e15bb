"""What a model takes from the owned parts: exact counts in report, lists and remarks, and nothing overdrawn."""

from __future__ import annotations

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.errors import PartsError
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.report.outputs import output_texts
from legorize_addon.core.report.ownership import colour_differences, lot_facts, owned_facts, used_lots
from legorize_addon.core.settings import Settings
from tests.core.owned_box import CATALOGUE, used
from tests.core.solids import box
from tests.core.textured import painted

MESH = painted(box([0.0, 0.0, 0.0], [4.0, 3.0, 3.0]), 4)


def inventory(folder, lots):
    """Write an inventory of (part, LDraw code, count)."""
    path = folder / "owned.csv"
    path.write_text("part,colour,quantity\n" + "".join(f"{part},{code},{count}\n" for part, code, count in lots))
    return str(path)


def beyond(build):
    """Return how many bricks of each lot go beyond the owned ones, supports included."""
    return np.maximum(used(build.supports.bricks) - build.owned.count, 0)


def test_only_owned_parts(tmp_path):
    """Few red parts and more dark red ones: nothing is overdrawn, and the report says how colours differ."""
    lots = [("3003", 4, 6), ("3003", 320, 20), ("3004", 4, 3), ("3004", 320, 40), ("3005", 320, 20), ("3001", 320, 6)]
    build = legorize(MESH, Settings(width=5, plates="none", owned=inventory(tmp_path, lots)))
    facts = owned_facts(build, CATALOGUE)
    assert beyond(build).sum() == facts["missing"] == facts["missing_lots"] == 0
    assert facts["used"] == len(build.supports.bricks)
    assert 0 < facts["other_colour_percent"] <= 100
    assert facts["colour_difference"] == pytest.approx(colour_differences(build, CATALOGUE).mean(), abs=1e-3)
    assert any(note.endswith("all are owned.") for note in build.notes)
    assert not [name for name in output_texts(build, CATALOGUE, {}, "box") if name.startswith("missing")]


def test_owned_parts_first(tmp_path):
    """What is missing is listed for people and shops, exactly what goes beyond the inventory."""
    build = legorize(MESH, Settings(width=6, owned=inventory(tmp_path, [("3001", 4, 2)]), owned_use="first"))
    texts = output_texts(build, CATALOGUE, {}, "box")
    rows = csv.DictReader(io.StringIO(texts["missing-parts.csv"]))
    listed = {(row["part"], int(row["colour"])): int(row["count"]) for row in rows}
    wanted = {
        (CATALOGUE.parts[part].number, CATALOGUE.colours[colour].code): int(count)
        for (part, colour), count in np.ndenumerate(beyond(build))
        if count
    }
    assert listed == wanted
    assert owned_facts(build, CATALOGUE)["missing"] == sum(wanted.values())
    assert {"missing-bricklink.xml", "missing-rebrickable.csv"} < set(texts)
    np.testing.assert_array_equal(used_lots(Assembly(build.supports.bricks, CATALOGUE)), used(build.supports.bricks))


@pytest.mark.parametrize(
    ("lots", "words"),
    [
        ([("3005", 4, 9)], r"the model fills \d+ studs of a plate's height, and all owned .* together 27"),
        ([("3007", 4, 90)], r"of the \d+ bricks .* are missing \(\d+ Brick .*\), although 90 are owned"),
    ],
)
def test_too_few_parts_are_told_in_one_sentence(tmp_path, lots, words):
    """It names what is missing and how much, and what to do: too small a volume, or the wrong parts."""
    with pytest.raises(PartsError, match=rf"^The owned parts do not suffice: {words}: choose a smaller size, .*\.$"):
        legorize(MESH, Settings(width=4, plates="none", owned=inventory(tmp_path, lots)))


def test_several_inventories_count_together(tmp_path):
    """Files are separated by semicolons."""
    path = inventory(tmp_path, [("3003", 4, 60), ("3004", 4, 60), ("3005", 4, 60)])
    build = legorize(MESH, Settings(width=3, plates="none", owned=f"{path}; {path}"))
    assert build.owned.count.sum() == 360


def test_nothing_without_an_inventory():
    """No facts, no lists, no remark."""
    build = legorize(MESH, Settings(width=3))
    assert owned_facts(build, CATALOGUE) is None
    assert not [note for note in build.notes if "owned" in note]
    assert owned_facts(replace(build, owned=None), CATALOGUE) is None


def test_few_lots_are_counted():
    """The report counts lots and small lots of the model, and says what they cost in likeness; else nothing."""
    build = legorize(MESH, Settings(width=4, few_lots=20.0))
    facts, used_now = lot_facts(build, CATALOGUE), used(build.bricks)
    assert facts["lots"] == (used_now > 0).sum() >= facts["small_lots"] == ((used_now > 0) & (used_now <= 2)).sum()
    assert facts["colour_difference"] == pytest.approx(colour_differences(build, CATALOGUE).mean(), abs=1e-3)
    assert lot_facts(replace(build, settings=Settings()), CATALOGUE) is None
