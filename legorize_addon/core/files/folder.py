"""The folder of the results: all of it is there in the end, or it is as it was before."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from ..errors import BuildError


@contextmanager
def new_folder(out: Path) -> Iterator[Path]:
    """Yield a folder to write into; what it holds moves to ``out`` at the end, and only if all went well."""
    if out.exists() and not out.is_dir():
        raise BuildError(f"{out} is a file, not a folder: choose another name.")
    # on the same disk, so that moving is renaming
    near = next(folder for folder in (out, *out.absolute().parents) if folder.exists())
    with ExitStack() as stack:
        with writing(out):
            temporary = stack.enter_context(tempfile.TemporaryDirectory(prefix=".legorize-", dir=near))
            folder = Path(temporary) / "results"
            folder.mkdir()
        yield folder
        with writing(out):
            publish(folder, out)


def publish(folder: Path, out: Path) -> None:
    """Rename a folder, or all of its files if the new name is taken by a folder."""
    if not out.exists():
        out.parent.mkdir(parents=True, exist_ok=True)
        folder.rename(out)
        return
    files = sorted(file.relative_to(folder) for file in folder.rglob("*") if file.is_file())
    for taken in (out / file for file in files):
        if taken.is_dir():
            raise BuildError(f"{taken} is a folder: move it away, or choose another folder for the results.")
    for file in files:
        (out / file).parent.mkdir(exist_ok=True)
        os.replace(folder / file, out / file)


@contextmanager
def writing(out: Path) -> Iterator[None]:
    """Turn a failure of the file system into a sentence."""
    try:
        yield
    except OSError as error:
        raise BuildError(f"The folder {out} cannot be written ({error.strerror}): choose another one.") from error
