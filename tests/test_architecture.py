"""The floor plan: which package may import which, and that nothing reaches past what a package offers."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from pathlib import Path
from typing import Final, NamedTuple

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE: Final = "legorize_addon"

ORDER: Final = (
    "core.on_demand",
    "core.arrays",
    "core.units",
    "core.errors",
    "core.safe_text",
    "core.progress",
    "core.native",
    "core.sameness",
    "core.memo",
    "core.setting",
    "core.exclusions",
    "core.settings",
    "core.settings_file",
    "core.presets",
    "core.geometry",
    "core.model",
    "core.stock",
    "core.mesh",
    "core.colours",
    "core.texturing",
    "core.slicing",
    "core.unit_bricks",
    "core.shell",
    "core.slopes",
    "core.half_studs",
    "core.layout.problem",
    "core.layout.solvers",
    "core.layout.learning",
    "core.layout.joining",
    "core.layout",
    "core.edits",
    "core.mosaic",
    "core.statics",
    "core.building",
    "core.supports",
    "core.owned",
    "core.measures",
    "core.shopping",
    "core.instructions",
    "core.files.sources",
    "core.files",
    "core.ldraw",
    "core.estimate",
    "core.limits",
    "core.build",
    "core.method",
    "core.report",
    "core.part_choice",
    "core.run",
    "core.painting",
    "core.stages",
    "core.strength",
    "core.by_hand",
    "core.slope_stages",
    "core.tile_stages",
    "core.half_stages",
    "core.drafting",
    "core.preview",
    "core.beyond",
    "core.mosaic_estimate",
    "core.mosaic_stages",
    "core.erecting",
    "core.fitting",
    "core.shortage",
    "core.existing",
    "core.pipeline",
    "core",
    "scene",
    "reading",
    "view",
    "render",
    "ui",
    "",
)
"""The rooms, lowest first: each imports only from those before it. "" is the entry of the add-on itself."""

OPEN: Final = ("core", "")
"""Rooms whose modules are rooms of their own: anybody above may import them by name."""


class Import(NamedTuple):
    """One name that a module imports from the package itself."""

    file: str
    line: int
    source: str
    """Dotted name of the importing module, without the package's own name."""
    target: str
    """Dotted name of the module or package that the name comes from."""
    name: str


def modules() -> dict[str, Path]:
    """Return the files of all modules by dotted name, without the package's own; a package has its folder's name."""
    found = {}
    for path in sorted((ROOT / PACKAGE).rglob("*.py")):
        parts = path.relative_to(ROOT / PACKAGE).with_suffix("").parts
        found[".".join(part for part in parts if part != "__init__")] = path
    return found


MODULES: Final = modules()


def is_package(module: str) -> bool:
    """Whether a module is the ``__init__`` of a folder."""
    return MODULES[module].name == "__init__.py"


def folder(module: str) -> str:
    """Return the package in which a module's relative imports begin."""
    return module if is_package(module) else module.rpartition(".")[0]


def room(module: str) -> str:
    """Return the entry of the order to which a module belongs."""
    return module if module in ORDER else folder(module)


def offered(package: str) -> list[str]:
    """Return the names that a package's ``__all__`` lists."""
    for node in ast.parse(MODULES[package].read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return list(ast.literal_eval(node.value))
    return []


def imports(module: str) -> Iterator[Import]:
    """Yield every name that a module imports from the package, wherever the statement stands."""
    file = MODULES[module].relative_to(ROOT).as_posix()
    for node in ast.walk(ast.parse(MODULES[module].read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = folder(module).split(".") if folder(module) else []
            base = base[: len(base) - node.level + 1] + (node.module.split(".") if node.module else [])
            for each in node.names:
                yield Import(file, node.lineno, module, ".".join(base), each.name)


IMPORTS: Final = [each for module in MODULES for each in imports(module)]


def reached(each: Import) -> str:
    """Return the module that an import reaches: the one of this name, unless the package offers something so called."""
    inner = f"{each.target}.{each.name}".lstrip(".")
    return inner if inner in MODULES and each.name not in offered(each.target) else each.target


def between_rooms() -> dict[str, set[str]]:
    """Return the rooms that each room imports from."""
    graph: dict[str, set[str]] = {name: set() for name in ORDER}
    for each in IMPORTS:
        graph[room(each.source)].add(room(reached(each)))
    return {name: others - {name} for name, others in graph.items()}


def test_every_room_is_in_the_order() -> None:
    """No package and no root module is missing in the order, and the order names nothing that is not there."""
    assert {room(module) for module in MODULES} == set(ORDER)


def test_imports_are_found() -> None:
    """The checks below would pass on nothing: a few imports that have to be seen."""
    graph = between_rooms()
    assert len(IMPORTS) > 500
    assert "core.layout.problem" in graph["core.layout.solvers"]
    assert {"core.mesh", "core.supports", "core.report"} <= graph["core.pipeline"] | graph["core.stages"]
    assert "scene" in graph["ui"]


def test_imports_go_down() -> None:
    """Each room imports only from those that stand before it in the order."""
    rank = {name: number for number, name in enumerate(ORDER)}
    upwards = [each for each in IMPORTS if rank[room(reached(each))] > rank[room(each.source)]]
    assert not [f"{each.file}:{each.line} imports {reached(each)}" for each in upwards]


def test_rooms_have_no_circle() -> None:
    """No room imports itself by way of others."""
    try:
        list(TopologicalSorter(between_rooms()).static_order())
    except CycleError as error:
        pytest.fail(" <- ".join(error.args[1]))


def test_only_offered_names_are_imported() -> None:
    """From another package come the names of its ``__all__`` alone, never a module inside it."""
    beyond = []
    for each in IMPORTS:
        if room(each.source) == room(reached(each)) or folder(each.source) == reached(each):
            continue
        if room(reached(each)) in OPEN or (reached(each) in ORDER and not is_package(reached(each))):
            continue
        if not (is_package(each.target) and each.name in offered(each.target)):
            beyond.append(f"{each.file}:{each.line} takes {each.name} of {each.target or PACKAGE}")
    assert not beyond


def test_packages_offer_what_they_list() -> None:
    """``__all__`` is sorted, without repeats, and lists exactly what the ``__init__`` imports from its own modules."""
    for package in (name for name in MODULES if is_package(name) and name not in OPEN):
        inside = [each for each in IMPORTS if each.source == package and f"{each.target}.".startswith(f"{package}.")]
        own = {each.name for each in inside}
        listed = offered(package)
        assert set(listed) == own, package
        assert len(listed) == len(set(listed)), package


def test_nothing_is_offered_in_vain() -> None:
    """Every name that a package of the core offers is used outside it: by another room, a script or a test."""
    outside = [*(ROOT / "scripts").rglob("*.py"), *(ROOT / "tests").rglob("*.py")]
    words = {name for path in outside for name in _words(path)}
    for package in (name for name in MODULES if is_package(name) and name.startswith("core.")):
        taken = {each.name for each in IMPORTS if each.target == package and room(each.source) != package}
        assert not set(offered(package)) - taken - words, package


def _words(path: Path) -> Iterator[str]:
    """Yield the names that a file outside the package imports."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            yield from (each.name for each in node.names)


def test_order_is_read_from_both_ends() -> None:
    """An import that goes up is seen: with two rooms changed round, the order does not hold."""
    graph = between_rooms()
    direct = [(low, high) for low, high in pairwise(ORDER) if low in graph[high]]
    assert direct
    rank = {name: number for number, name in enumerate(ORDER)}
    for low, high in direct:
        changed = {**rank, low: rank[high], high: rank[low]}
        assert [used for used in graph[high] if changed[used] > changed[high]]
