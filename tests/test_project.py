"""The house rules that can be read off the files of the repository."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path
from statistics import median, quantiles

ROOT = Path(__file__).resolve().parents[1]
CORE = ROOT / "legorize_addon" / "core"
READERS = (
    *(
        "pipeline",
        "preview",
        "drafting",
        "existing",
        "run",
        "painting",
        "stages",
        "strength",
        "slope_stages",
        "tile_stages",
        "mosaic_stages",
        "mosaic_estimate",
        "build",
        "estimate",
    ),
    *("part_choice", "limits", "fitting", "shortage", "half_stages", "settings_file"),
)
"""Modules of the core that know the settings."""
PACKAGE = sorted((ROOT / "legorize_addon").rglob("*.py"))
SOURCES = [*PACKAGE, *(path for name in ("docs", "scripts", "tests") for path in sorted((ROOT / name).rglob("*.py")))]
FOLDERS = (".ci", ".github", "assets", "docs", "legorize_addon", "scripts", "tests")
TEXTS = [
    *(path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*"))),
    *(path for kind in ("*.md", "*.toml", "*.cff", ".git?*", ".pre-commit*") for path in sorted(ROOT.glob(kind))),
]
BINARY = {".blend", ".dat", ".glb", ".jpg", ".npz", ".png", ".pyc"}
# sources of facts and standards that a text may point to; an index of packages is none
HOSTS = {
    *("keepachangelog.com", "semver.org", "doi.org", "www.ldraw.org", "library.ldraw.org", "rebrickable.com"),
    "www.w3.org",  # the name of a standard of pictures
}
MACHINE_PATHS = re.compile(r"(?<![\w./~$}])/(root|work|home|Users|tmp)/")


def trees(paths: list[Path]) -> Iterator[tuple[str, ast.Module]]:
    """Yield (name, syntax tree) of every file."""
    for path in paths:
        yield path.relative_to(ROOT).as_posix(), ast.parse(path.read_text(encoding="utf-8"))


def imported(tree: ast.Module) -> Iterator[str]:
    """Yield the absolute names that a module imports, wherever the statement stands."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield str(node.module)


def functions(tree: ast.Module) -> Iterator[tuple[str, int]]:
    """Yield (name, lines without the docstring) of every function."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            first = node.body[0]
            documented = ast.get_docstring(node) is not None
            docstring = first.end_lineno - first.lineno + 1 if documented else 0
            yield node.name, node.end_lineno - node.lineno + 1 - docstring


def manifest() -> dict[str, object]:
    """Return the manifest of the extension."""
    return tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))


def test_version_stands_in_changelog() -> None:
    """The newest section of the changelog is the manifest's version."""
    sections = re.findall(r"^## \[(.+?)\] - \d{4}-\d\d-\d\d$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert sections[0] == manifest()["version"]


def test_version_is_written_once() -> None:
    """No second version number in pyproject.toml."""
    assert "project" not in tomllib.loads((ROOT / "pyproject.toml").read_text())


def test_manifest_names_no_wheels() -> None:
    """Wheels and platforms belong to the staged copy; no key is empty; texts end without a full stop."""
    keys = manifest()
    assert not {"wheels", "platforms", "build"} & keys.keys()
    assert all(keys.values())
    for text in (keys["tagline"], *keys["permissions"].values()):
        assert len(text) <= 64
        assert text[-1].isalnum()


def test_pins_are_exact() -> None:
    """Every requirement names one version, and Blender's numpy is never shipped."""
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text())["dependency-groups"]
    pins = [pin for group in groups.values() for pin in group if isinstance(pin, str)]
    assert all(re.fullmatch(r"[\w-]+==[\w.]+", pin) for pin in pins)
    shipped = [pin for name, group in groups.items() if name.startswith("runtime") for pin in group]
    assert shipped
    assert not [pin for pin in shipped if isinstance(pin, str) and pin.startswith("numpy")]


def test_core_imports_without_blender() -> None:
    """All of the core can be imported, and Blender does not come with it."""
    names = [".".join(path.relative_to(ROOT).with_suffix("").parts) for path in sorted(CORE.rglob("*.py"))]
    code = f"import importlib, sys\nfor name in {names!r}: importlib.import_module(name)\n"
    code += "sys.exit('bpy' in sys.modules or 'mathutils' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, timeout=120)


def test_package_imports_itself_relatively() -> None:
    """An installed extension goes by another name, so nothing in the package says its own."""
    assert not [name for name, tree in trees(PACKAGE) for module in imported(tree) if module.startswith("legorize")]


def test_core_has_no_import_cycle() -> None:
    """The modules of the core can be put in an order in which each imports earlier ones only."""
    graph = {}
    for name, tree in trees(sorted(CORE.rglob("*.py"))):
        folder = Path(name).parent
        used = set()
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.level:
                base = folder.parents[node.level - 2] if node.level > 1 else folder
                module = base.joinpath(*(node.module or "").split("."))
                used |= {f"{module}.py"} if node.module else {f"{module / each.name}.py" for each in node.names}
        graph[name] = used
    order = list(TopologicalSorter(graph).static_order())
    assert len(order) >= len(graph)


def test_only_the_pipeline_knows_the_order() -> None:
    """Stages never take the settings, and none knows the pipeline."""
    for name, tree in trees(sorted(CORE.rglob("*.py"))):
        used = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.level}
        assert "pipeline" not in used, name
        readers = tuple(f"core/{each}.py" for each in READERS)
        assert "settings" not in used or name.endswith(readers), name


def test_every_setting_is_used() -> None:
    """No setting that neither the stages nor the estimate before them read."""
    [(_, settings)] = trees([CORE / "settings.py"])
    readers = [
        tree for _, tree in trees([CORE / f"{name}.py" for name in READERS if name not in ("build", "settings_file")])
    ]
    [fields] = [node.body for node in settings.body if isinstance(node, ast.ClassDef) and node.name == "Settings"]
    names = {node.target.id for node in fields if isinstance(node, ast.AnnAssign)}
    assert names
    assert names <= {node.attr for tree in readers for node in ast.walk(tree) if isinstance(node, ast.Attribute)}


def test_search_path_is_left_alone() -> None:
    """An add-on shares its interpreter with others: nothing in the package touches where modules come from."""
    for name, tree in trees(PACKAGE):
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                assert (node.value.id, node.attr) not in {("sys", "path"), ("sys", "modules")}, f"{name}:{node.lineno}"


def test_no_module_keeps_state() -> None:
    """No empty list, dict or set waits at module level to be filled."""
    for name, tree in trees(PACKAGE):
        for node in tree.body:
            value = ast.unparse(node.value) if isinstance(node, (ast.Assign, ast.AnnAssign)) and node.value else ""
            assert value not in {"[]", "{}", "list()", "dict()", "set()"}, f"{name}:{node.lineno}"


def test_dataclasses_are_frozen() -> None:
    """Every dataclass of the core is frozen, and slotted unless it keeps what it was asked for."""
    for name, tree in trees(sorted(CORE.rglob("*.py"))):
        for node in ast.walk(tree):
            for mark in node.decorator_list if isinstance(node, ast.ClassDef) else ():
                text = ast.unparse(mark)
                if text.startswith("dataclass"):
                    assert "frozen=True" in text, f"{name}:{node.name}"
                    assert "slots=True" in text or "cached_property" in ast.unparse(node), f"{name}:{node.name}"


def test_sizes() -> None:
    """Modules up to 300 lines that are not blank; functions up to 50, nine of ten up to 30, half of them up to 10."""
    assert not [path for path in PACKAGE if len(re.findall(r"^.*\S", path.read_text(encoding="utf-8"), re.M)) > 300]
    lengths = {f"{name}:{function}": lines for name, tree in trees(PACKAGE) for function, lines in functions(tree)}
    assert not {name: lines for name, lines in lengths.items() if lines > 50}
    assert quantiles(lengths.values(), n=10)[-1] <= 30
    assert median(lengths.values()) <= 10


def test_every_core_module_has_its_tests() -> None:
    """Beside each module of the core that computes something stands a file of tests named after it."""
    modules = {Path(name).stem for name, tree in trees(sorted(CORE.rglob("*.py"))) if list(functions(tree))}
    tests = {path.stem.removeprefix("test_") for path in (ROOT / "tests" / "core").rglob("test_*.py")}
    assert not modules - tests


def test_no_module_is_called_utils() -> None:
    """A name says what is inside."""
    assert not [path for path in SOURCES if re.search("util|helper|misc|common", path.stem)]


def test_texts_name_no_machine() -> None:
    """No path of one machine and no address but those of standards and data sources."""
    texts = {path: path.read_text(encoding="utf-8") for path in TEXTS if path.is_file() and path.suffix not in BINARY}
    assert len(texts) > 20
    assert not [path for path, text in texts.items() if MACHINE_PATHS.search(text)]
    assert {host for text in texts.values() for host in re.findall(r"https?://([\w.-]+)", text)} <= HOSTS


def test_readme_commands_exist() -> None:
    """Every command of scripts/run.py that the README shows is one that it knows."""
    shown = set(re.findall(r"scripts/run\.py (\w+)", (ROOT / "README.md").read_text(encoding="utf-8")))
    known = (ROOT / "scripts" / "run.py").read_text(encoding="utf-8")
    assert {"sample", "test"} <= shown
    assert all(f'"{command}"' in known for command in shown)


def test_the_core_loads_no_package_that_most_models_do_without() -> None:
    """Plain colours and the usual layout need no scikit-learn, which loads longer than a small model is built."""
    code = "import sys, legorize_addon.core.pipeline, legorize_addon.core.report; sys.exit('sklearn' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False)
    assert done.returncode == 0
