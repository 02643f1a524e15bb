"""Random cases: the same number gives the same case, and whatever can go wrong in one is told."""

from __future__ import annotations

import csv
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("trimesh", reason="benchmarks need the dependency group checks")
pytest.importorskip("shapely", reason="benchmarks need the dependency group checks")

from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts import benchmark
from scripts.benchmarks.fuzz import GOOD, MEMORY, run
from scripts.benchmarks.fuzz_bricks import STRANGE, document, outcome_of_bricks
from scripts.benchmarks.fuzz_cases import BODIES, case
from scripts.benchmarks.fuzz_checks import faults, faults_of_bricks, same
from tests.core.solids import box


def endless(_seed: int, _number: int) -> tuple[str, str]:
    """Come to no end."""
    while True:
        pass


def greedy(_seed: int, _number: int) -> tuple[str, str]:
    """Take more memory than there may be."""
    return "built", str(np.zeros(2 * MEMORY, dtype=np.uint8).sum())


def broken(_seed: int, _number: int) -> tuple[str, str]:
    """Fail."""
    raise KeyError("no such brick")


@pytest.fixture(scope="module")
def build():
    """Return a small model."""
    return legorize(box((0, 0, 0), (40, 32, 30)), Settings(width=5, supports="none"))


def test_one_case(tmp_path):
    """The command builds a case and writes what came of it."""
    assert benchmark.main(["fuzz", "--cases", "1", "--out", str(tmp_path)]) == 0
    with next(tmp_path.rglob("outcomes.csv")).open(encoding="utf-8") as file:
        [row] = csv.DictReader(file)
    assert row["outcome"] in GOOD
    assert row["cases"] == "1"


def test_hostile_brick_models(tmp_path):
    """Every kind of strange document comes up, and each is built or refused in a sentence."""
    assert benchmark.main(["fuzz-bricks", "--cases", "1", "--out", str(tmp_path)]) == 0
    kinds = set()
    for number in range(30):
        kinds.add(document(0, number)[0])
        assert outcome_of_bricks(0, number)[0] in GOOD, number
    assert kinds == set(STRANGE)


def test_what_goes_wrong_is_told():
    """A traceback is told with its place, too much memory as such; the process that looks on goes on."""
    told = run(0, 0, broken)
    assert told["outcome"] == "traceback"
    assert "no such brick" in told["what"]
    assert "test_fuzz.py" in told["what"]
    assert run(0, 0, greedy)["outcome"] == "too large"


def test_what_does_not_end_is_told(monkeypatch):
    """A case that takes too long is ended and told."""
    monkeypatch.setattr("scripts.benchmarks.fuzz.SECONDS", 1)
    assert run(0, 0, endless)["outcome"] == "endless"


def test_numbers_name_cases():
    """Seed and number give the case again, another number another one; every kind of body comes."""
    (name, mesh, settings), (again, same_mesh, same_settings) = case(3, 5), case(3, 5)
    assert (name, settings) == (again, same_settings)
    np.testing.assert_array_equal(mesh.vertices, same_mesh.vertices)
    assert case(3, 6)[2] != settings
    assert {case(0, number)[0].split()[0] for number in range(200)} == set(BODIES)


def test_a_good_build_has_no_faults(build):
    """A box that was built as it should be breaks no rule, and is the same as itself."""
    assert faults(build, load_catalogue()) == []
    assert same(build, build)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda bricks: bricks.take(np.arange(1, len(bricks))), "cells that must be built are empty"),
        (lambda bricks: bricks.take(np.append(np.arange(len(bricks)), 0)), "cells are in more than one brick"),
        (
            lambda bricks: replace(bricks, corner=bricks.corner + np.int32([1, 0, 0])),
            "cells are built that must be empty",
        ),
        (lambda bricks: replace(bricks, colour=np.full_like(bricks.colour, 13)), "never made in their colour"),
        (
            lambda bricks: replace(bricks, colour=np.full_like(bricks.colour, 4)),
            "show a colour that none of their cells",
        ),
    ],
)
def test_broken_rules_are_found(build, change, words: str):
    """Bricks that are missing, doubled, moved or painted are found."""
    wrong = replace(build, assembly=replace(build.assembly, bricks=change(build.bricks)))
    assert any(words in fault for fault in faults_of_bricks(wrong, load_catalogue()))
    assert not same(build, replace(build, notes=(*build.notes, "more")))


def test_cases_are_small():
    """No body gets wider than 100 studs, however flat it is: what takes long is not what these cases look for."""
    for number in range(60):
        _, mesh, settings = case(0, number)
        x, y, z = np.ptp(mesh.vertices, axis=0)
        size = settings.width if settings.size_by == "width" else settings.height * 1.2 * max(x, y) / z
        assert size <= 100, number
