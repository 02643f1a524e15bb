"""Check that a release can be made from this tree, and build its zips.

::

    python3 scripts/run.py release v0.2.0 [--platform linux-x64 ...] [--out dist]

The tag must be the version in ``blender_manifest.toml``, stand on the commit
that is checked out, and have a dated section of its own at the top of
CHANGELOG.md; CITATION.cff must have the same version and date; nothing may be
changed and not committed. Then ``scripts/build_extension.py`` builds and validates
the zips. Nothing is pushed or published: the next steps are printed. Exit status:
0 built; 1 not ready, with a line for each reason.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.build_extension import PYTHONS, TAGS, build  # noqa: E402 - found through the line above

SECTION: Final = re.compile(r"^## \[(.+?)\](?: - (\S+))?\s*$", re.MULTILINE)
DATE: Final = re.compile(r"\d{4}-\d\d-\d\d")


def main(arguments: list[str] | None = None) -> int:
    """Check, build, and say what to do next."""
    parser = argparse.ArgumentParser(description="Check that a release can be made, and build it.")
    parser.add_argument("tag", help="the release's tag, such as v0.2.0")
    parser.add_argument("--platform", choices=TAGS, action="append", help="default: every platform")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder for the zips")
    chosen = parser.parse_args(arguments)
    faults = list(reasons(chosen.tag, ROOT))
    for fault in faults:
        print(fault, file=sys.stderr)
    if faults:
        return 1
    platforms = chosen.platform or list(TAGS)
    # for every Python of Blender, and half as large for each
    zips = [path for python in (None, *PYTHONS) for path in build(platforms, chosen.out, python=python)]
    print(next_steps(chosen.tag, zips))
    return 0


def reasons(tag: str, root: Path) -> Iterator[str]:
    """Yield a sentence for each reason why a tree cannot be released under a tag."""
    version = str(tomllib.loads((root / "blender_manifest.toml").read_text(encoding="utf-8"))["version"])
    if tag != f"v{version}":
        yield f"The tag {tag} is not v{version}, the version in blender_manifest.toml: change one of them."
    yield from changelog_faults(version, (root / "CHANGELOG.md").read_text(encoding="utf-8"))
    date = date_of(version, (root / "CHANGELOG.md").read_text(encoding="utf-8"))
    yield from citation_faults(version, date, (root / "CITATION.cff").read_text(encoding="utf-8"))
    yield from git_faults(tag, root)


def changelog_faults(version: str, text: str) -> Iterator[str]:
    """Yield what is wrong with the changelog: the version must have the newest section, and a date."""
    sections = SECTION.findall(text)
    if version not in [name for name, _ in sections]:
        yield f"CHANGELOG.md has no section [{version}]: add one with the date of the release."
    elif sections[0][0] != version:
        yield f"The newest section of CHANGELOG.md is [{sections[0][0]}], not [{version}]: move its lines there."
    elif not DATE.fullmatch(sections[0][1]):
        yield f"The section [{version}] of CHANGELOG.md has no date: write ## [{version}] - YEAR-MONTH-DAY."


def date_of(version: str, text: str) -> str:
    """Return the date of a version's section, empty where there is none."""
    return next((date for name, date in SECTION.findall(text) if name == version), "")


def citation_faults(version: str, date: str, text: str) -> Iterator[str]:
    """Yield what is wrong with the software's own version and date in CITATION.cff."""
    for key, value in (("version", version), ("date-released", date)):
        found = re.search(rf"^{key}: *\"?([^\"\n]*)\"?$", text, re.MULTILINE)
        if value and (found is None or found[1].strip() != value):
            yield f"CITATION.cff does not have {key}: {value}: set it."


def git_faults(tag: str, root: Path) -> Iterator[str]:
    """Yield what is wrong with the working tree and the tag."""
    if git(root, "status", "--porcelain"):
        yield "There are uncommitted changes: commit or stash them."
    if not git(root, "tag", "--list", tag):
        yield f"There is no tag {tag}: create it with git tag -a {tag}."
    elif git(root, "rev-list", "-n", "1", tag) != git(root, "rev-parse", "HEAD"):
        yield f"The tag {tag} is on another commit: check that one out."


def git(root: Path, *words: str) -> str:
    """Return what a git command prints."""
    return subprocess.run(["git", *words], cwd=root, check=True, capture_output=True, text=True).stdout.strip()


def next_steps(tag: str, zips: list[Path]) -> str:
    """Return what is left to do by hand."""
    files = "\n".join(f"    {path}" for path in zips)
    return (
        f"Built and validated:\n{files}\nNext:\n"
        "    1. Install one of them in a Blender, and legorize something.\n"
        f"    2. git push origin {tag}\n"
        f"    3. Make a release of {tag}: its section of CHANGELOG.md as the text, and the zips as files."
    )


if __name__ == "__main__":
    sys.exit(main())
