"""The text files of a build."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.report.outputs import output_texts
from legorize_addon.core.settings import Settings
from legorize_addon.core.shopping.formats import FORMATS
from tests.core.solids import box
from tests.core.textured import painted


def test_every_file_has_its_contents() -> None:
    """The model in LDraw, its order, its parts for the shops, its tables; the report as it was given."""
    build = legorize(painted(box([0.0, 0.0, 0.0], [4.0, 3.0, 2.0]), 4), Settings(width=4))
    files = output_texts(build, load_catalogue(), {"some": "facts"}, "box")
    assert json.loads(files["report.json"]) == {"some": "facts"}
    bricks = [line for line in files["model.ldr"].splitlines() if line.startswith("1 ")]
    assert len(bricks) == len(build.bricks)
    assert {name.split("/")[0] for name in files} >= {"model.mpd", "build_order.csv", "parts.csv", "tables"}


def test_shops_get_no_empty_list() -> None:
    """A model without supports has no list of supports; one with supports has each of its lists for them too."""
    catalogue = load_catalogue()
    plain = legorize(painted(box([0.0, 0.0, 0.0], [4.0, 3.0, 2.0]), 4), Settings(width=4))
    lists = {kind.file for kind in FORMATS}
    names = set(output_texts(plain, catalogue, {}, "box"))
    assert lists < names
    assert not [name for name in names if name.startswith("support")]
    role = plain.supports.bricks.role.copy()
    role[:2] = Role.SUPPORT_OUTSIDE
    bricks = replace(plain.supports.bricks, role=role)
    hanging = replace(plain, supports=replace(plain.supports, assembly=Assembly(bricks, plain.assembly.catalogue)))
    files = output_texts(hanging, catalogue, {}, "box")
    tables = {"tables/table_2.csv", "tables/table_4.csv"}
    assert set(files) - names == {f"support-{name}" for name in lists} | tables
    for kind in ("rebrickable", "pick-a-brick"):
        rows = csv.DictReader(io.StringIO(files[f"support-{kind}.csv"]))
        assert sum(int(row.get("Quantity") or row["quantity"]) for row in rows) == 2
    bare = replace(catalogue, element=np.zeros_like(catalogue.element))
    everything = names | tables | {f"support-{name}" for name in lists}
    assert set(output_texts(hanging, bare, {}, "box")) == everything - {"pick-a-brick.csv", "support-pick-a-brick.csv"}


@pytest.mark.parametrize(
    "title", ["STEP", "FILE x.ldr", "!LEGORIZE ROLE SHELL PIECE 3", "a\n1 4 0 0 0\x85 x\u2028y", "=1+1"]
)
def test_titles_change_nothing(title: str) -> None:
    """Whatever the model is called, the files are read as those of a box."""
    catalogue = load_catalogue()
    build = legorize(painted(box([0.0, 0.0, 0.0], [4.0, 3.0, 2.0]), 4), Settings(width=4))
    plain, named = (output_texts(build, catalogue, {}, name) for name in ("box", title))
    for name in ("model.ldr", "model.mpd"):
        lines = [files[name].split("\r\n") for files in (plain, named)]
        assert [line for line in lines[0] if "box" not in line] == [
            other for line, other in zip(*lines, strict=True) if "box" not in line
        ]
        for other in (line for line, before in zip(lines[1], lines[0], strict=True) if "box" in before):
            assert other.split()[1].isalpha()
            assert other.split()[1] not in ("STEP", "FILE")
    [head, row] = csv.reader(io.StringIO(named["tables/table_3.csv"], newline=""))
    assert len(head) == len(row)
    assert not row[0].startswith("=")
