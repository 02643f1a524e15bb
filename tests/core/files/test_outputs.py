"""The text files of a build."""

from __future__ import annotations

import json

from legorize_addon.core.catalogue import load_catalogue
from legorize_addon.core.files.outputs import texts
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.solids import box
from tests.core.textured import painted


def test_every_file_has_its_contents() -> None:
    """The model in LDraw, its order, its parts for the shops, its tables; the report as it was given."""
    build = legorize(painted(box([0.0, 0.0, 0.0], [4.0, 3.0, 2.0]), 4), Settings(width=4))
    files = texts(build, load_catalogue(), {"some": "facts"}, "box")
    assert json.loads(files["report.json"]) == {"some": "facts"}
    bricks = [line for line in files["model.ldr"].splitlines() if line.startswith("1 ")]
    assert len(bricks) == len(build.bricks)
    assert {name.split("/")[0] for name in files} >= {"model.mpd", "build_order.csv", "parts.csv", "tables"}
