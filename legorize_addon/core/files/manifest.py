"""Which files of a folder a run wrote: the report lists them with checksums.

So the next run knows which files it may remove, a reader can check that all files are of one run, and files that the
user has changed are kept.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from hashlib import sha256
from pathlib import Path, PurePosixPath
from typing import Final

from ..errors import BuildError

REPORT: Final = "report.json"
FILES: Final = "files"
"""The report's entry: names, with / between folders, to SHA-256 as hexadecimal digits."""


def seal(folder: Path) -> None:
    """Write the list of a folder's files into its report, if it has one."""
    report = folder / REPORT
    if report.is_file():
        facts = json.loads(report.read_text(encoding="utf-8"))
        facts[FILES] = {name: checksum(folder / name) for name in names_in(folder) if name != REPORT}
        report.write_text(json.dumps(facts, indent=2, allow_nan=False) + "\n", encoding="utf-8", newline="")


def names_in(folder: Path) -> list[str]:
    """Return the names of all files below a folder, ascending, the report last."""
    names = (file.relative_to(folder).as_posix() for file in folder.rglob("*") if not file.is_dir())
    return sorted(names, key=lambda name: (name == REPORT, name))


def listed(folder: Path) -> dict[str, str]:
    """Return what an earlier run's report lists; nothing if there is no such report.

    Parameters
    ----------
    folder : pathlib.Path
        May be missing.

    Returns
    -------
    dict of str to str
        Checksums by name, of names that stay in the folder.
    """
    try:
        files = json.loads((folder / REPORT).read_text(encoding="utf-8"))[FILES]
        return {name: str(files[name]) for name in files if _inside(name)}
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        # it is not a list of ours
        return {}


def ours(folder: Path) -> set[str]:
    """Return the names of the files that are still as an earlier run wrote them, and its report."""
    files = listed(folder)
    same = {name for name, digest in files.items() if _is_file(folder / name, digest)}
    return same | {REPORT} if files else set()


def refuse_strangers(folder: Path, names: Iterable[str]) -> None:
    """Refuse to replace files that no earlier run wrote.

    Raises
    ------
    BuildError
        A file or link in the folder has one of the names, and its report does not list it.
    """
    if _of_first_version(folder):
        return
    files = listed(folder)
    known = {*files, REPORT} if files else set()
    for name in names:
        if name not in known and os.path.lexists(folder / name):
            what = "a folder" if (folder / name).is_dir() else "a file that no earlier run wrote"
            raise BuildError(f"{folder / name} is {what}: move it away, or choose another folder for the results.")


def _of_first_version(folder: Path) -> bool:
    """Return whether the results in a folder are those of version 0.1.0, whose report had no list of files."""
    try:
        facts = json.loads((folder / REPORT).read_text(encoding="utf-8"))
        return FILES not in facts and facts["schema"] == 1 and isinstance(facts["version"], str)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return False


def changed(folder: Path) -> list[str]:
    """Return the names of the files that were changed after an earlier run wrote them, ascending."""
    return sorted(name for name in listed(folder).keys() - ours(folder) if _is_file(folder / name))


def checksum(file: Path) -> str:
    """Return the SHA-256 of a file as hexadecimal digits."""
    digest = sha256()
    with file.open("rb") as stream:
        while block := stream.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


def _is_file(path: Path, digest: str = "") -> bool:
    """Return whether a file exists, with a certain content if one is given; an unreadable file is not one of ours."""
    try:
        return path.is_file() and not path.is_symlink() and digest in ("", checksum(path))
    except OSError:
        return False


def _inside(name: str) -> bool:
    path = PurePosixPath(name)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts and "\\" not in name
