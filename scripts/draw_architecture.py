"""Draw the two pictures of the architecture page from the code's own imports.

::

    python3 scripts/draw_architecture.py            write docs/pictures/*.svg
    python3 scripts/draw_architecture.py --check    end with 1 if a picture is out
    of date

``packages.svg`` shows which package imports which: every package stands above
all that it imports. ``data-flow.svg`` shows the stages of ``core/pipeline.py`` in
their order, the packages that each of them calls, and the files that come out.
Both are read from the syntax trees, so the code is not run and the standard
library is enough; the same code gives the same bytes.
"""

from __future__ import annotations

import argparse
import ast
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Final, NamedTuple
from xml.sax.saxutils import escape

ROOT: Final = Path(__file__).resolve().parents[1]
PACKAGE: Final = ROOT / "legorize_addon"
PICTURES: Final = ROOT / "docs" / "pictures"

ALONE: Final = ("core.build", "core.stages", "core.drafting", "core.erecting", "core.pipeline")
"""Modules that the picture shows like packages: they join the stages."""

Graph = Mapping[str, frozenset[str]]

STYLE: Final = (
    "text{font:13px sans-serif;fill:#222}.small{font-size:11px;fill:#555}.head{font-weight:bold}"
    "rect{fill:#fff;stroke:#667;stroke-width:1}.core{fill:#e8f1fb}.blender{fill:#fdf0dc}.file{fill:#eef7e8}"
    "path{fill:none;stroke:#99a;stroke-width:1}.flow{stroke:#445;stroke-width:1.5}.far{stroke-dasharray:5 3}"
)


WIDE: Final = 420
"""Width of a stage's box: as wide as the longest list of packages needs."""


class Box(NamedTuple):
    """A box with a name, its middle and its width."""

    name: str
    x: float
    y: float
    width: float
    kind: str


# ---------------------------------------------------------------- reading


def packages() -> dict[str, list[Path]]:
    """Return the files of every package by its dotted name; modules beside packages belong to their folder."""
    found: dict[str, list[Path]] = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        module = ".".join(path.relative_to(PACKAGE).with_suffix("").parts)
        found.setdefault(module if module in ALONE else module.rpartition(".")[0], []).append(path)
    return found


def relative_imports(path: Path) -> Iterator[tuple[str, str]]:
    """Yield (package, name) of every relative import, the package as a dotted name."""
    here = path.parent.relative_to(PACKAGE).parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = [*here[: len(here) - node.level + 1], *(node.module or "").split(".")]
            yield from ((".".join(part for part in base if part), name.name) for name in node.names)


def owner(target: str, name: str, known: Iterable[str]) -> str:
    """Return the package that an import reaches, whether it names the package or a module inside."""
    for candidate in (f"{target}.{name}".lstrip("."), target, target.rpartition(".")[0]):
        if candidate in known:
            return candidate
    raise ValueError(f"{target}.{name} is no part of the package")


def import_graph() -> dict[str, frozenset[str]]:
    """Return which packages each package imports from; the shared modules at the roots are left out."""
    files = packages()
    graph = {}
    for package, paths in files.items():
        used = {owner(target, name, files) for path in paths for target, name in relative_imports(path)}
        graph[package] = frozenset(used - {package, "core", ""})
    return {package: used for package, used in graph.items() if package not in ("", "core")}


def levels(graph: Graph) -> dict[str, int]:
    """Return the level of each package: 0 if it imports none, else one above the highest that it imports."""
    level: dict[str, int] = {}

    def height(package: str, path: tuple[str, ...] = ()) -> int:
        if package in path:
            raise ValueError(f"Packages import each other: {' -> '.join((*path, package))}.")
        if package not in level:
            level[package] = 1 + max((height(used, (*path, package)) for used in graph[package]), default=-1)
        return level[package]

    for package in graph:
        height(package)
    return level


def reduced(graph: Graph) -> dict[str, frozenset[str]]:
    """Return the graph without the imports that a longer way implies, so that the picture stays readable."""
    below: dict[str, frozenset[str]] = {}
    for package in sorted(graph, key=levels(graph).__getitem__):
        below[package] = graph[package].union(*(below[used] for used in graph[package]))
    return {
        package: frozenset(used for used in those if not any(used in below[other] for other in those))
        for package, those in graph.items()
    }


def stages() -> list[tuple[str, tuple[str, ...]]]:
    """Return (name, packages) of each stage of the pipeline in order; a name that comes again is left out."""
    modules = root_modules("pipeline")
    known = {name.removeprefix("core.") for name in packages() if name not in ALONE}
    found: dict[str, dict[str, None]] = {}
    for name, block, module in stage_blocks(modules["pipeline"].functions["_legorize"], "pipeline", modules, set()):
        called = dict.fromkeys(calls(block, module, modules, set()))
        found.setdefault(name, {}).update({package: None for package in called if package in known})
    return [(name, tuple(used)) for name, used in found.items()]


class Module(NamedTuple):
    """A module at the core's root: its syntax tree, its functions, and the module that each imported name is from."""

    tree: ast.Module
    functions: dict[str, ast.FunctionDef]
    source: dict[str, str]


def root_modules(first: str) -> dict[str, Module]:
    """Return a module at the core's root and all of its neighbours there that it reaches by imports."""
    found: dict[str, Module] = {}
    left = [first]
    while left:
        name = left.pop()
        path = PACKAGE / "core" / f"{name}.py"
        if name in found or not path.exists():
            continue
        tree = ast.parse(path.read_text(encoding="utf-8"))
        imports = [
            node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module
        ]
        source = {each.asname or each.name: str(node.module) for node in imports for each in node.names}
        found[name] = Module(tree, {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}, source)
        left += sorted(set(source.values()))
    return found


def stage_blocks(
    node: ast.AST, here: str, modules: Mapping[str, Module], seen: set[tuple[str, str]]
) -> Iterator[tuple[str, ast.With, str]]:
    """Yield (name, block, module) of every ``with run.stage(name)`` as the run comes to it, in functions as well."""
    if isinstance(node, ast.With):
        call = node.items[0].context_expr
        if isinstance(call, ast.Call) and ast.unparse(call.func) == "run.stage":
            yield ast.literal_eval(call.args[0]), node, here
            return
    if isinstance(node, ast.Name):
        for place, function in reached(node.id, here, modules, seen):
            yield from stage_blocks(function, place, modules, seen)
    for child in ast.iter_child_nodes(node):
        yield from stage_blocks(child, here, modules, seen)


def calls(node: ast.AST, here: str, modules: Mapping[str, Module], seen: set[tuple[str, str]]) -> Iterator[str]:
    """Yield the packages whose names a block uses, those inside functions at the core's root included."""
    if isinstance(node, ast.Name):
        place = modules[here].source.get(node.id, here)
        if place not in modules:
            yield place
        for module, function in reached(node.id, here, modules, seen):
            yield from calls(function, module, modules, seen)
    for child in ast.iter_child_nodes(node):
        yield from calls(child, here, modules, seen)


def reached(
    name: str, here: str, modules: Mapping[str, Module], seen: set[tuple[str, str]]
) -> Iterator[tuple[str, ast.FunctionDef]]:
    """Yield (module, function) at the core's root that a name in a module stands for, if it was not seen before."""
    place = modules[here].source.get(name, here)
    if place in modules and name in modules[place].functions and (place, name) not in seen:
        seen.add((place, name))
        yield place, modules[place].functions[name]


def output_files() -> list[str]:
    """Return the names of the text files that a build writes, as ``core/report/outputs.py`` lists them."""
    tree = ast.parse((PACKAGE / "core" / "report" / "outputs.py").read_text(encoding="utf-8"))
    texts = [node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str)]
    names = [text for text in texts if re.fullmatch(r"[\w/-]+\.[a-z]{2,5}", text)]
    return [*dict.fromkeys(names), *(["tables/*.csv"] if any(text.startswith("tables/") for text in texts) else [])]


# ---------------------------------------------------------------- drawing


def packages_svg() -> str:
    """Return the picture of the packages."""
    graph = import_graph()
    level = levels(graph)
    rows: dict[int, list[str]] = {}
    for package in sorted(graph, key=lambda name: (name.startswith("core"), name)):
        rows.setdefault(level[package], []).append(package)
    top, width = max(level.values()), 980
    boxes = {}
    for number, names in rows.items():
        wide = [24 + 7.2 * len(shown(name)) for name in names]
        gap = (width - sum(wide)) / (len(names) + 1)
        # boxes of neighbouring rows are not to stand in one line, nor any beyond the picture
        left = gap + min(max(40 * (number % 4) - 60, -0.6 * gap), 0.6 * gap)
        for name, size in zip(names, wide, strict=True):
            kind = "core" if name.startswith("core") else "blender"
            boxes[name] = Box(name, left + size / 2, 40 + 70 * (top - number), size, kind)
            left += size + gap
    lines = [
        line(boxes[package], boxes[used]) for package, those in sorted(reduced(graph).items()) for used in sorted(those)
    ]
    height = 40 + 70 * top + 90
    legend = text(20, height - 38, "blue: core, without Blender; yellow: Blender's side", "small") + text(
        20, height - 20, "A line goes from a package down to what it imports. What other lines imply is left out.",
        "small",
    )  # fmt: skip
    return svg(width, height, [*lines, *map(box, boxes.values()), legend], "Packages and their imports")


def shown(package: str) -> str:
    """Return a package's name as the picture shows it."""
    return package.removeprefix("core.").replace(".", " / ")


def line(above: Box, below: Box) -> str:
    """Return the line of an import with its head; one that passes other rows is dashed."""
    y, x, end = above.y + 15, below.x, below.y - 15
    bend = (y + end) / 2
    mark = ' class="far"' if end - y > 70 else ""
    way = f"M{above.x:.0f} {y:.0f}C{above.x:.0f} {bend:.0f} {x:.0f} {bend:.0f} {x:.0f} {end:.0f}"
    return f'<path{mark} d="{way}"/><path d="M{x - 4:.0f} {end - 6:.0f}L{x:.0f} {end:.0f}L{x + 4:.0f} {end - 6:.0f}"/>'


def box(each: Box) -> str:
    """Return a box with its name."""
    left = each.x - each.width / 2
    return (
        f'<rect class="{each.kind}" x="{left:.0f}" y="{each.y - 15:.0f}" width="{each.width:.0f}" height="30" rx="4"/>'
        f'<text x="{each.x:.0f}" y="{each.y + 5:.0f}" text-anchor="middle">{escape(shown(each.name))}</text>'
    )


def flow_svg() -> str:
    """Return the picture of the data flow."""
    rows = stages()
    width, left, y = 880, 40, 40
    parts = [big(left, y, WIDE, "file", "mesh file or objects of a scene", "reading")]
    for number, (name, used) in enumerate(rows, 1):
        y += 64
        parts.append(arrow(left + WIDE / 2, y - 64 + 44, y))
        parts.append(big(left, y, WIDE, "core", f"{number}. {name}", ", ".join(used)))
    y += 64
    parts.append(arrow(left + WIDE / 2, y - 64 + 44, y))
    parts.append(big(left, y, WIDE, "core", "Build: the result of every stage", "build"))
    files = output_files()
    top = y - 19 * max(len(files) - 1, 0) - 60
    parts.append(f'<path class="flow" d="M{left + WIDE} {y + 22}H{left + WIDE + 80}"/>')
    parts.append(f'<rect class="file" x="{left + WIDE + 80}" y="{top}" width="300" height="{y + 44 - top}" rx="4"/>')
    parts.append(text(left + WIDE + 96, top + 22, "text files (files, report)", "head"))
    parts += [text(left + WIDE + 96, top + 44 + 19 * row, name) for row, name in enumerate(files)]
    parts.append(arrow(left + WIDE / 2, y + 44, y + 64))
    parts.append(big(left, y + 64, WIDE, "blender", "bricks in the scene, pictures", "scene, view, render"))
    return svg(width, y + 64 + 70, parts, "From the mesh to the files")


def big(x: float, y: float, width: float, kind: str, head: str, below: str) -> str:
    """Return a box of two lines."""
    return (
        f'<rect class="{kind}" x="{x}" y="{y}" width="{width}" height="44" rx="4"/>'
        + text(x + 16, y + 18, head, "head")
        + text(x + 16, y + 35, below, "small")
    )


def arrow(x: float, start: float, end: float) -> str:
    """Return a short line downwards with a head."""
    return f'<path class="flow" d="M{x:.0f} {start}V{end}M{x - 4:.0f} {end - 6}L{x:.0f} {end}L{x + 4:.0f} {end - 6}"/>'


def text(x: float, y: float, words: str, kind: str = "") -> str:
    """Return a line of text."""
    mark = f' class="{kind}"' if kind else ""
    return f'<text{mark} x="{x:.0f}" y="{y:.0f}">{escape(words)}</text>'


def svg(width: float, height: float, parts: Iterable[str], title: str) -> str:
    """Return the document."""
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" role="img">'
    return "\n".join([head, f"<title>{escape(title)}</title>", f"<style>{STYLE}</style>", *parts, "</svg>", ""])


# ---------------------------------------------------------------- command line


def pictures() -> dict[str, str]:
    """Return the contents of the pictures by file name."""
    return {"packages.svg": packages_svg(), "data-flow.svg": flow_svg()}


def stale(folder: Path) -> list[str]:
    """Return the names of the pictures in a folder that are missing or not what the code says."""
    drawn = pictures()
    return [name for name in drawn if not (folder / name).exists() or (folder / name).read_text() != drawn[name]]


def main(arguments: list[str] | None = None, folder: Path = PICTURES) -> int:
    """Draw or check, and return the exit status."""
    parser = argparse.ArgumentParser(description="Draw the pictures of the architecture page.")
    parser.add_argument("--check", action="store_true", help="write nothing; end with 1 if a picture is out of date")
    if parser.parse_args(arguments).check:
        old = stale(folder)
        for name in old:
            print(f"{name} is out of date: run python3 scripts/draw_architecture.py.", file=sys.stderr)
        return 1 if old else 0
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in pictures().items():
        (folder / name).write_text(content, encoding="utf-8", newline="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
