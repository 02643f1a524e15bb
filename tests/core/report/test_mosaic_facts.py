"""The report of a mosaic, and its files."""

from __future__ import annotations

import json

import numpy as np

from legorize_addon.core.pipeline import legorize_image
from legorize_addon.core.report.checks import failed_checks
from legorize_addon.core.report.outputs import CERTAIN, output_texts
from legorize_addon.core.report.report import report
from legorize_addon.core.report.summary import summary
from legorize_addon.core.settings import Settings
from tests.core.mosaic.pictures import CATALOGUE, painted


def made(**options):
    """Return a mosaic of four colours, and its report."""
    codes = np.repeat(np.repeat(np.array([[4, 15], [1, 14]], np.int16), 10, axis=0), 10, axis=1)
    mosaic = legorize_image(painted(codes), Settings(width=20, **options))
    return mosaic, report(mosaic, CATALOGUE, version="1", mm_per_unit=1000.0)


def test_figures_follow_from_the_bricks():
    """Counts, base, likeness and seams, by counting again."""
    mosaic, facts = made(border=1)
    json.dumps(facts, allow_nan=False)
    assert facts["mosaic"]["border"] == 1
    assert facts["mosaic"]["columns"] == facts["mosaic"]["rows"] == 18
    assert facts["input"] == {"pixels": [20, 20]}
    assert facts["grid"] == {"x": 20, "y": 20, "layers": 1}
    assert facts["counts"]["bricks"] == len(mosaic.bricks) == sum(facts["counts"]["by_part"].values())
    base = mosaic.bricks.role == 1
    assert sum(facts["mosaic"]["base"].values()) == base.sum()
    lower, upper = mosaic.graph.pairs.T
    across = [len(set(lower[upper == row])) > 1 for row in np.flatnonzero(~base)]
    assert facts["mosaic"]["parts_across_seams"] == sum(across)
    assert facts["mosaic"]["difference_from_afar"] < 3


def test_a_good_mosaic_fails_no_check():
    """The same checks as for models, and the same last words."""
    _, facts = made()
    assert failed_checks(facts) == []
    assert "proven to stand; every check passed" in summary(facts | {"failed_checks": []}, "out", CERTAIN)[2]


def test_files_of_a_mosaic():
    """All that every build has, the parts by tiles, and no table of the paper."""
    mosaic, facts = made()
    files = output_texts(mosaic, CATALOGUE, facts, "A picture")
    assert set(CERTAIN) | {"tiles.csv", "bricklink.xml"} <= set(files)
    assert not any(name.startswith(("tables/", "support")) for name in files)
    assert "4162.dat" in files["model.ldr"]
