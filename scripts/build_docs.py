"""Build the documentation as a site of static pages: ``python3 scripts/run.py docs``.

The texts are in ``docs``. They are copied to ``out/docs/source``, and generated pages are written beside them: the
flags of the command line, the names that each package of the core offers. Sphinx makes ``out/docs/html`` from that.
Warnings are errors, so that a missing name or a page without links is found here. Blender is not needed.
"""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import Field, fields
from pathlib import Path
from typing import Final, NamedTuple

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from legorize_addon.core.setting import help_text  # noqa: E402 - after the path
from legorize_addon.core.settings import Settings, choices, setting_type  # noqa: E402 - after the path

OUT: Final = ROOT / "out" / "docs"
CORE: Final = ROOT / "legorize_addon" / "core"
SHARED: Final = ("pipeline", "build", "settings", "setting", "errors", "progress", "units", "arrays")
"""Modules beside the packages of the core, in the order of their pages."""


class Flag(NamedTuple):
    """A flag of the command line that is not a setting."""

    name: str
    text: str


# ---------------------------------------------------------------- flags


def settings_page() -> str:
    """Return the page of all settings, by the groups of the panel."""
    lines = [
        "# Settings",
        "",
        "This page is generated from `legorize_addon/core/settings.py`, where each setting is declared once. The panel",
        "and the command line have the same settings: first stands the name in the panel, then the flag. A setting",
        "that is on or off has two flags, `--name` and `--no-name`.",
    ]
    group = None
    for entry in fields(Settings):
        if entry.metadata["group"] != group:
            group = entry.metadata["group"]
            lines += ["", f"## {group}"]
        lines += [
            "",
            f"*{plain(entry.metadata['name'])}*: `{flag(entry)}`",
            f": {plain(help_text(entry))} {limits(entry)}",
        ]
    return "\n".join([*lines, ""])


def flag(entry: Field[object]) -> str:
    """Return the flag of a setting with what follows it."""
    name = f"--{entry.name.replace('_', '-')}"
    kind, words = setting_type(entry), choices(entry)
    if kind is bool:
        return f"{name}, --no-{name[2:]}"
    return f"{name} {{{','.join(words)}}}" if words else f"{name} {kind.__name__.upper()}"


def limits(entry: Field[object]) -> str:
    """Return the default of a setting and, for numbers, its limits."""
    if setting_type(entry) is bool:
        return f"Default: {'on' if entry.default else 'off'}."
    low, high = entry.metadata["low"], entry.metadata["high"]
    default = f"Default: `{entry.default}`" if entry.default != "" else "Default: empty"
    return f"{default}." if low is None else f"{default}; from {low:g} to {high}."


def plain(text: str) -> str:
    """Return a text whose signs Markdown takes for nothing else."""
    return "".join(f"\\{sign}" if sign in "\\`*_{}[]<>$|" else sign for sign in text)


def flags_page() -> str:
    """Return the list of the flags that are not settings, as ``scripts/legorize.py`` declares them."""
    lines = [line for each in own_flags() for line in (f"`{each.name}`", f": {plain(each.text)}", "")]
    return "\n".join(lines)


def own_flags() -> Iterator[Flag]:
    """Yield the flags that the script adds by itself, in the order of its text."""
    tree = ast.parse((ROOT / "scripts" / "legorize.py").read_text(encoding="utf-8"))
    found = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and is_argument(node)]
    for node in sorted(found, key=lambda node: node.lineno):
        given = {word.arg: word.value for word in node.keywords}
        name, metavar = ast.literal_eval(node.args[0]), given.get("metavar")
        shown = f" {ast.literal_eval(metavar)}" if metavar and name.startswith("-") else ""
        text = ast.literal_eval(given["help"]) if "help" in given else ""
        yield Flag((ast.literal_eval(metavar) if metavar and not shown else name) + shown, sentence(text))


def is_argument(node: ast.Call) -> bool:
    """Whether a call adds an argument whose name stands in the text."""
    added = isinstance(node.func, ast.Attribute) and node.func.attr == "add_argument"
    return added and bool(node.args) and isinstance(node.args[0], ast.Constant)


def sentence(text: str) -> str:
    """Return a help text as a sentence."""
    text = text.replace("%%", "%")
    return f"{text[:1].upper()}{text[1:]}{'' if text.endswith('.') else '.'}"


# ---------------------------------------------------------------- reference


def reference_pages() -> dict[str, str]:
    """Return the pages of the reference by file name: one for each package and each shared module of the core."""
    names = [path.parent.relative_to(CORE) for path in sorted(CORE.rglob("__init__.py"))]
    packages = [".".join(name.parts) for name in names if name.parts]
    pages = {f"{name}.rst": package_page(name) for name in packages}
    pages |= {f"{name}.rst": module_page(name) for name in SHARED if (CORE / f"{name}.py").exists()}
    entries = [name.removesuffix(".rst") for name in pages]
    head = [
        "Reference",
        "=========",
        "",
        "What each package of the core offers. Everything else in a package is private.",
        "",
    ]
    tree = [".. toctree::", "   :maxdepth: 1", "", *(f"   {name}" for name in entries)]
    return {**pages, "index.rst": "\n".join([*head, *tree, ""])}


def package_page(name: str) -> str:
    """Return the page of a package: its own text, then every name that it offers."""
    package = CORE.joinpath(*name.split("."))
    body = [f".. automodule:: legorize_addon.core.{name}", "   :no-members:", ""]
    for offered in offered_names(package):
        kind, module = origin(package / "__init__.py", offered)
        inside = ["   :members:"] if kind in ("autoclass", "automodule") else []
        if kind == "automodule":  # some of what is in it may be offered by itself, too
            inside.append("   :no-index:")
        body += [f".. {kind}:: {module}.{offered}", *inside, ""]
    return page(name, body)


def offered_names(package: Path) -> list[str]:
    """Return the names in the ``__all__`` of a package."""
    for node in ast.parse((package / "__init__.py").read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return list(ast.literal_eval(node.value))
    return []


def origin(file: Path, name: str) -> tuple[str, str]:
    """Return Sphinx's directive for a name, and the module that defines it, looked up along the imports."""
    body = ast.parse(file.read_text(encoding="utf-8")).body
    # what is loaded on demand is imported for the checker of types alone
    body += [each for node in body if isinstance(node, ast.If) for each in node.body]
    for node in body:
        if isinstance(node, ast.ImportFrom) and node.level and name in {each.name for each in node.names}:
            if node.module is None:  # a module of the package, offered as such
                return "automodule", dotted(file)
            folder = file.parents[node.level - 1].joinpath(*(node.module or "").split("."))
            return origin(folder / "__init__.py" if folder.is_dir() else folder.with_suffix(".py"), name)
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name == name:
            return ("autoclass" if isinstance(node, ast.ClassDef) else "autofunction"), dotted(file)
        if isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            if name in {ast.unparse(target) for target in targets}:
                return "autodata", dotted(file)
    raise ValueError(f"{file} defines no {name}")


def dotted(file: Path) -> str:
    """Return the dotted name of a module by its file."""
    parts = file.relative_to(ROOT).with_suffix("").parts
    return ".".join(part for part in parts if part != "__init__")


def module_page(name: str) -> str:
    """Return the page of a shared module with all that it documents."""
    return page(name, [f".. automodule:: legorize_addon.core.{name}", "   :members:", ""])


def page(name: str, body: list[str]) -> str:
    """Return a page with its title."""
    return "\n".join([name, "=" * len(name), "", *body])


# ---------------------------------------------------------------- building


def lay_out(source: Path) -> None:
    """Copy the texts and write the generated pages beside them."""
    shutil.rmtree(source, ignore_errors=True)
    shutil.copytree(ROOT / "docs", source, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("CONTRIBUTING.md", "CHANGELOG.md"):
        shutil.copy(ROOT / name, source)
    (source / "settings.md").write_text(settings_page(), encoding="utf-8")
    (source / "flags.txt").write_text(flags_page(), encoding="utf-8")
    (source / "reference").mkdir()
    for name, text in reference_pages().items():
        (source / "reference" / name).write_text(text, encoding="utf-8")


def main(arguments: list[str] | None = None) -> int:
    """Build the pages and return the exit status of Sphinx; more arguments go to it."""
    lay_out(OUT / "source")
    sphinx = [sys.executable, "-m", "sphinx", "-b", "html", "-W", "--keep-going", "-q"]
    more = sys.argv[1:] if arguments is None else arguments
    line = [*sphinx, "-d", str(OUT / "doctrees"), *more, str(OUT / "source"), str(OUT / "html")]
    status = subprocess.run(line, env={**os.environ, "LEGORIZE_ROOT": str(ROOT)}, check=False).returncode
    if not status:
        print(OUT / "html" / "index.html")
    return status


if __name__ == "__main__":
    sys.exit(main())
