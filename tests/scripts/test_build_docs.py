"""The documentation: what is generated from the code, and that pages name all that the code writes."""

from __future__ import annotations

import ast
import re
from dataclasses import fields
from pathlib import Path

from legorize_addon.core.settings import Settings
from scripts import build_docs, draw_architecture, run

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
CORE = ROOT / "legorize_addon" / "core"
PAGES = sorted(DOCS.rglob("*.md"))
PACKAGES = sorted((ROOT / "legorize_addon").rglob("__init__.py"))


def read(name: str) -> str:
    """Return the text of a page."""
    return (DOCS / name).read_text(encoding="utf-8")


def test_every_setting_is_described() -> None:
    """The page of settings has each one with its own text, its group, and the flags by which it is set."""
    page = build_docs.settings_page()
    for entry in fields(Settings):
        name = entry.name.replace("_", "-")
        assert f"*{build_docs.plain(entry.metadata['name'])}*: `--{name}" in page
        assert build_docs.plain(entry.metadata["text"]) in page
        assert all(build_docs.plain(f"{word}: {text}") in page for word, text in entry.metadata["words"].items())
        assert f"## {entry.metadata['group']}\n" in page
    assert "`--hollow, --no-hollow`" in page
    assert "`--width INT`\n" in page
    assert "from 1 to 1000." in page


def test_every_flag_of_the_script_is_described() -> None:
    """The flags that are no settings are read off the script, each with a sentence."""
    found = {each.name.split()[0]: each.text for each in build_docs.own_flags()}
    text = (ROOT / "scripts" / "legorize.py").read_text(encoding="utf-8")
    written = set(re.findall(r'add_argument\(\s*"(--[\w-]+)"', text))
    assert written
    assert written <= found.keys()
    assert "IN" in found
    assert all(re.fullmatch(r"[A-Z`].*\.", each) for each in found.values())


def test_texts_are_taken_literally() -> None:
    """Signs that mean something to Markdown are kept as they are."""
    assert build_docs.plain("a*b_c [d] <e>") == r"a\*b\_c \[d\] \<e\>"


def test_reference_has_every_package() -> None:
    """One page for each package of the core, with all that it offers; and one for each shared module."""
    pages = build_docs.reference_pages()
    packages = {".".join(path.parent.relative_to(CORE).parts) for path in CORE.rglob("__init__.py")} - {""}
    assert {f"{name}.rst" for name in packages} <= pages.keys()
    assert {"pipeline.rst", "settings.rst", "errors.rst"} <= pages.keys()
    for name in packages:
        for offered in build_docs.offered_names(CORE.joinpath(*name.split("."))):
            assert re.search(rf"^\.\. auto\w+:: legorize_addon\.core\.[\w.]+\.{offered}$", pages[f"{name}.rst"], re.M)


def test_names_are_looked_up_where_they_are_defined() -> None:
    """A class, a function and a constant, each in its own module."""
    assert build_docs.origin(CORE / "mesh" / "__init__.py", "TriangleMesh")[0] == "autoclass"
    assert build_docs.origin(CORE / "slicing" / "__init__.py", "slice_mesh")[0] == "autofunction"
    kind, module = build_docs.origin(CORE / "statics" / "__init__.py", "GRAVITY")
    assert (kind, module.startswith("legorize_addon.core.statics.")) == ("autodata", True)


def test_every_output_file_is_described() -> None:
    """Whoever adds a file to the outputs says on a page what is in it."""
    assert not [name for name in draw_architecture.output_files() if name.split("/")[0] not in read("files.md")]


def test_every_key_of_the_report_is_described() -> None:
    """Whoever adds a key says on a page what it means."""
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in sorted((CORE / "report").glob("*.py"))]
    functions = [node for tree in trees for node in tree.body if isinstance(node, ast.FunctionDef)]
    makers = [each for each in functions if each.name == "report" or each.name.startswith("facts_of_")]
    assert len(makers) >= 3
    returned = [node.value for each in makers for node in ast.walk(each) if isinstance(node, ast.Return)]
    # what is put in by two stars comes from another of these functions
    keys = {ast.literal_eval(key) for each in returned for key in each.keys if key is not None}
    assert len(keys) > 10
    assert keys <= set(re.findall(r"`(\w+)`", read("report.md")))


def test_pages_name_files_that_exist() -> None:
    """A path of the repository that a page shows is there."""
    texts = {path.name: path.read_text(encoding="utf-8") for path in (*PAGES, ROOT / "CONTRIBUTING.md")}
    pattern = r"`((?:legorize_addon|scripts|tests|assets|docs)/[\w./-]+)`"
    named = {(page, path) for page, text in texts.items() for path in re.findall(pattern, text)}
    assert len(named) > 20
    # a word in capitals stands for any name
    missing = {(page, path) for page, path in named if not (ROOT / re.sub(r"[A-Z]{5,}.*", "", path)).exists()}
    assert not missing


def test_packages_of_the_architecture_page_exist() -> None:
    """The table of packages lists every package that there is, and no other."""
    named = set(re.findall(r"^\| `([\w/]+)` \|", read("architecture.md"), re.M))
    there = {path.parent.relative_to(ROOT / "legorize_addon").as_posix() for path in PACKAGES}
    assert named == {name for name in there if name not in (".", "core") and name.count("/") < 2}


def test_pages_point_to_sources_only() -> None:
    """Links out of the site lead to publications, by their DOI."""
    hosts = {host for path in PAGES for host in re.findall(r"https?://([\w.-]+)", path.read_text(encoding="utf-8"))}
    assert hosts <= {"doi.org"}


def test_commands_of_the_pages_exist() -> None:
    """Every command of scripts/run.py that a text shows is one that it knows."""
    texts = [path.read_text(encoding="utf-8") for path in (*PAGES, ROOT / "CONTRIBUTING.md")]
    shown = {command for text in texts for command in re.findall(r"scripts/run\.py (\w+)", text)}
    assert {"test", "docs", "check", "window", "zip", "python"} <= shown
    assert shown <= set(run.COMMANDS)
