"""The folder of the results: written as a whole, or left as it was."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Final

from ..errors import BuildError
from .manifest import refuse_strangers, seal
from .paths import named, one_slash
from .publishing import finish, replace_folder
from .workplace import PREFIX, alone, clear_abandoned, workplace

NEW: Final = "new"
"""Where new files are written in the temporary folder."""


@contextmanager
def new_folder(out: Path, *, names: Collection[str] = ()) -> Iterator[Path]:
    """Yield a folder to write into; its contents become the results at the end, if nothing failed.

    Parameters
    ----------
    out : pathlib.Path
        Folder of the results; it may be missing, or a link to a folder. The
        user's own files in it stay. Files of an earlier run are replaced if they
        have the results' names, and removed if this one does not write them, as
        far as that run's ``report.json`` lists them and they are unchanged.
    names : collection of str, optional
        Files that will certainly be written: whether they may is known before
        the work.

    Yields
    ------
    pathlib.Path
        An empty folder on the same disk. If it has a ``report.json`` in the
        end, the list of all files is added to it.

    Raises
    ------
    BuildError
        The folder cannot be written, or something stands in the way of a file,
        such as one of the user's that has its name.
    """
    named(str(out), "folder", BuildError)
    with writing(out):
        target = one_slash(os.path.realpath(out))
        if os.path.lexists(target) and not target.is_dir():
            raise BuildError(f"{out} is a file, not a folder: choose another name.")
        near = _near(target)
        for place in {near, _nearest(target), target.parent}:
            clear_up(place)
        refuse_strangers(target, names)
    with ExitStack() as stack:
        with writing(out):
            work = stack.enter_context(workplace(near))
            # with the folders above it that are missing: one step makes them all
            fresh = work / NEW / target.relative_to(_nearest(target.parent))
            fresh.mkdir(parents=True)
        yield fresh
        with writing(out), alone(near):
            seal(fresh)
            _publish(work, fresh, target)


def temporary_of(folder: Path) -> Path:
    """Return the temporary folder in which a folder to write into lies."""
    return next(above for above in folder.parents if above.name.startswith(PREFIX))


def clear_up(place: Path) -> None:
    """Finish and remove what killed runs left in a folder, if it exists."""
    if place.is_dir():
        with alone(place):
            clear_abandoned(place, finish)


def _publish(work: Path, fresh: Path, target: Path) -> None:
    if target.is_dir():
        replace_folder(work, fresh, target)
        return
    above = _nearest(target)
    first = target.relative_to(above).parts[0]
    missing = work / NEW / target.relative_to(above)
    if missing != fresh:
        # another process has created a part of the folders meanwhile
        missing.parent.mkdir(parents=True, exist_ok=True)
        fresh.rename(missing)
    (work / NEW / first).rename(above / first)


def _nearest(folder: Path) -> Path:
    """Return a folder, or the first one above it that exists."""
    return next(each for each in (folder, *folder.parents) if os.path.lexists(each))


def _near(target: Path) -> Path:
    """Return the folder in which to make the temporary one: beside the results, else where they are to be."""
    if not target.is_dir():
        return _nearest(target)
    above = target.parent
    same_disk = target.stat().st_dev == above.stat().st_dev and not target.is_mount()
    # processes whose working folder it is, such as the shell of this run, must find it again
    worked_in = Path(os.path.realpath(os.curdir)).is_relative_to(target)
    return above if same_disk and os.access(above, os.W_OK | os.X_OK) and not worked_in else target


@contextmanager
def writing(out: Path) -> Iterator[None]:
    """Turn a failure of the file system into a sentence."""
    try:
        yield
    except OSError as error:
        raise BuildError(f"The folder {out} cannot be written ({error.strerror}): choose another one.") from error
