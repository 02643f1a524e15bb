"""The pictures of the architecture page: drawn from the code, and up to date."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from scripts import draw_architecture


def test_pictures_are_up_to_date(capsys: pytest.CaptureFixture[str]) -> None:
    """Whoever changes an import, a stage or an output file draws the pictures anew."""
    assert draw_architecture.main(["--check"]) == 0, capsys.readouterr().err


def test_check_sees_an_old_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A picture that is missing or changed is named, with the command that mends it; drawing mends it."""
    assert draw_architecture.main(["--check"], tmp_path) == 1
    assert draw_architecture.main([], tmp_path) == 0
    assert draw_architecture.main(["--check"], tmp_path) == 0
    (tmp_path / "packages.svg").write_text("<svg/>")
    capsys.readouterr()
    assert draw_architecture.main(["--check"], tmp_path) == 1
    assert capsys.readouterr().err == "packages.svg is out of date: run python3 scripts/draw_architecture.py.\n"


def test_pictures_are_drawings() -> None:
    """Both are well-formed, and show what must be in them."""
    for content in draw_architecture.pictures().values():
        assert ElementTree.fromstring(content).tag.endswith("svg")
    assert ">layout / solvers<" in draw_architecture.packages_svg()
    flow = draw_architecture.flow_svg()
    assert flow.index(". mesh<") < flow.index(". layout<") < flow.index(">model.ldr<")


def test_every_package_stands_above_what_it_imports() -> None:
    """The level of a package is higher than that of each package that it imports."""
    graph = draw_architecture.import_graph()
    level = draw_architecture.levels(graph)
    assert all(level[package] > level[used] for package, those in graph.items() for used in those)


def test_levels_refuse_a_circle() -> None:
    """Packages that import each other have no picture, but a sentence."""
    graph = {"a": frozenset({"b"}), "b": frozenset({"a"})}
    with pytest.raises(ValueError, match=r"^Packages import each other: a -> b -> a\.$"):
        draw_architecture.levels(graph)


def test_lines_that_others_imply_are_left_out() -> None:
    """Of a -> b -> c and a -> c only the first two are drawn."""
    graph = {"a": frozenset({"b", "c"}), "b": frozenset({"c"}), "c": frozenset()}
    assert draw_architecture.reduced(graph) == {"a": frozenset({"b"}), "b": frozenset({"c"}), "c": frozenset()}
