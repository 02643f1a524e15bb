"""New files replace those of an earlier run, all of them or none.

Where the system can let two folders change places, that is one step: the new
folder also gets links to the user's own files, and no reader ever sees a
mixture. Elsewhere files are moved one by one, after a list of the moves was
written: if a move fails all are undone, and if a run is killed the next one
finishes its moves.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path, PurePosixPath
from typing import Final

from ..errors import BuildError
from .exchange import exchange
from .manifest import names_in, ours, refuse_strangers
from .workplace import JOURNAL

OLD: Final = "old"
"""Where files that are replaced wait in the temporary folder, by number."""


@dataclass(frozen=True, slots=True)
class Moves:
    """What has to be moved, as the journal holds it.

    Attributes
    ----------
    target : str
        The folder of the results, as seen from the temporary folder.
    fresh : str
        The folder of the new files, as seen from the temporary folder.
    files : tuple of str
        Names of the new files, the report last.
    stale : tuple of str
        Names of files of an earlier run that the new one does not have.
    """

    target: str
    fresh: str
    files: tuple[str, ...]
    stale: tuple[str, ...]

    @classmethod
    def planned(cls, work: Path, fresh: Path, target: Path) -> Moves:
        """Find the files to move.

        Raises
        ------
        BuildError
            A folder stands where a file has to be, or the other way round, or
            a file that no earlier run wrote.
        """
        files = names_in(fresh)
        for name in files:
            _check_way(target, name)
        refuse_strangers(target, files)
        stale = sorted(ours(target) - set(files))
        return cls(os.path.relpath(target, work), os.path.relpath(fresh, work), tuple(files), tuple(stale))

    @classmethod
    def read(cls, work: Path) -> Moves:
        """Return the moves that have begun out of a temporary folder."""
        stored = json.loads((work / JOURNAL).read_text(encoding="utf-8"))
        return cls(stored["target"], stored["fresh"], tuple(stored["files"]), tuple(stored["stale"]))

    def begin(self, work: Path) -> None:
        """Write the journal: from here on the new files win."""
        (work / OLD).mkdir()
        partial = work / "journal.part"
        partial.write_text(json.dumps(asdict(self)), encoding="utf-8")
        os.replace(partial, work / JOURNAL)


def replace_folder(work: Path, fresh: Path, target: Path) -> None:
    """Let new files take the place of those of an earlier run in a folder that exists.

    Parameters
    ----------
    work : pathlib.Path
        Temporary folder.
    fresh : pathlib.Path
        The new files, in the temporary folder.
    target : pathlib.Path
        The folder of the results. What is not an earlier run's in it stays.

    Raises
    ------
    BuildError, OSError
        Something is in the way; all is as it was before.
    """
    moves = Moves.planned(work, fresh, target)
    if not _exchanged(work, fresh, target, moves):
        moves.begin(work)
        carry_out(work, moves)


def carry_out(work: Path, moves: Moves) -> None:
    """Make the remaining moves of the journal; undo all if one fails, or if the run is to stop."""
    target = work / moves.target
    try:
        for row, name in enumerate((*moves.stale, *moves.files)):
            _move(work, moves, row, name)
    except BaseException:
        _take_back(work, moves)
        raise
    finally:
        for name in moves.stale:
            _remove_empty(target, name)
    (work / JOURNAL).unlink()


def finish(work: Path) -> None:
    """Finish the moves of a killed run: its new files are there in the end or, if that is impossible, the old ones."""
    moves = Moves.read(work)
    if not (work / moves.target).is_dir():
        # moved or removed meanwhile
        (work / JOURNAL).unlink()
        return
    with suppress(OSError):
        carry_out(work, moves)


def _move(work: Path, moves: Moves, row: int, name: str) -> None:
    new, old, place = work / moves.fresh / name, work / OLD / str(row), work / moves.target / name
    if name in moves.stale:
        if os.path.lexists(place) and not os.path.lexists(old):
            os.replace(place, old)
    elif os.path.lexists(new):
        if os.path.lexists(place) and not os.path.lexists(old):
            os.replace(place, old)
        place.parent.mkdir(parents=True, exist_ok=True)
        os.replace(new, place)


def _take_back(work: Path, moves: Moves) -> None:
    for row, name in reversed(list(enumerate((*moves.stale, *moves.files)))):
        new, old, place = work / moves.fresh / name, work / OLD / str(row), work / moves.target / name
        if name in moves.files and not os.path.lexists(new):
            os.replace(place, new)
        if os.path.lexists(old):
            place.parent.mkdir(parents=True, exist_ok=True)
            os.replace(old, place)
        _remove_empty(work / moves.target, name)
    (work / JOURNAL).unlink()


def _remove_empty(target: Path, name: str) -> None:
    """Remove the folders of a file, if nothing is left in them."""
    for folder in list(PurePosixPath(name).parents)[:-1]:
        with suppress(OSError):
            (target / folder).rmdir()


def _check_way(target: Path, name: str) -> None:
    for folder in list(PurePosixPath(name).parents)[:-1]:
        if os.path.lexists(target / folder) and not (target / folder).is_dir():
            raise BuildError(f"{target / folder} is a file: move it away, or choose another folder for the results.")
    if (target / name).is_dir():
        raise BuildError(f"{target / name} is a folder: move it away, or choose another folder for the results.")
    if (target / name).exists() and not (target / name).is_file():
        raise BuildError(f"{target / name} is a device or a pipe: choose another folder for the results.")


def _exchanged(work: Path, fresh: Path, target: Path, moves: Moves) -> bool:
    """Let the folders change places, if they may and can; what was the folder of the results is then temporary."""
    own = {*moves.files, *moves.stale}
    folders = {str(folder) for name in own for folder in list(PurePosixPath(name).parents)[:-1]}
    try:
        users = list(_users(target, own, folders))
        if work.is_relative_to(target) or not (_alike(fresh, target) and _linked(users, target, fresh)):
            return False
    except OSError:
        return False
    if not exchange(fresh, target):
        for name in users:
            (fresh / name).unlink()
        return False
    _bring(fresh, target, own, folders)
    return True


def _users(target: Path, own: set[str], folders: set[str], within: str = "") -> Iterator[str]:
    """Yield the names of the user's files.

    Raises
    ------
    NotADirectoryError
        There is something that cannot have a second name: a folder of the
        user's, a device, or a link in the place of a folder of results.
    """
    with os.scandir(target / within) as entries:
        for entry in entries:
            name = f"{within}/{entry.name}" if within else entry.name
            if name in folders and entry.is_dir(follow_symlinks=False):
                yield from _users(target, own, folders, name)
            elif name not in own:
                if name in folders or not (entry.is_file(follow_symlinks=False) or entry.is_symlink()):
                    raise NotADirectoryError(name)
                yield name


def _alike(fresh: Path, target: Path) -> bool:
    """Give the new folder the permissions of the old one; return whether it then has the same owners."""
    one, other = fresh.stat(), target.stat()
    if (one.st_uid, one.st_gid, one.st_dev) != (other.st_uid, other.st_gid, other.st_dev):
        return False
    shutil.copystat(target, fresh)
    return True


def _linked(users: Sequence[str], target: Path, fresh: Path) -> bool:
    """Give the user's files a second name in the new folder; if that fails, none of them has one."""
    done = []
    try:
        for name in users:
            (fresh / name).parent.mkdir(parents=True, exist_ok=True)
            os.link(target / name, fresh / name, follow_symlinks=False)
            done.append(name)
    except (OSError, NotImplementedError):
        for name in done:
            (fresh / name).unlink()
        return False
    return True


def _bring(before: Path, target: Path, own: set[str], folders: set[str]) -> None:
    """Move files that were saved in the old folder between the links and the exchange into the new one."""
    with suppress(NotADirectoryError):
        for name in list(_users(before, own, folders)):
            there = target / name
            if not os.path.lexists(there) or not os.path.samestat((before / name).lstat(), there.lstat()):
                os.replace(before / name, there)
