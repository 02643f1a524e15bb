"""Where training files are stored, and the relative name by which a scene finds one on every machine.

A name that begins with // is relative to the .blend, as everywhere in Blender;
any other one without a folder is a file beside the .blend or, if there is none,
in the user's own folder. Blender empties that folder when the extension is
removed, so a saved scene keeps its samples beside it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

import bpy

from ..core.errors import BuildError

STEM: Final = "samples_v"
"""Beginning of the names of the files; the version follows."""


def resolved(name: str) -> str:
    """Return the path of a file of samples.

    Parameters
    ----------
    name : str
        What a scene keeps; empty for the samples that are shipped.

    Returns
    -------
    str
        Empty, or a path that is absolute; nothing may lie there.
    """
    if not name or (Path(name).is_absolute() and not name.startswith("//")):
        return name
    if name.startswith("//"):
        return bpy.path.abspath(name)
    places = [Path(bpy.path.abspath("//")), own_folder()] if bpy.data.filepath else [own_folder()]
    found = next((place for place in places if (place / name).is_file()), places[-1])
    return str(found / name)


def new_file(version: int) -> tuple[Path, str]:
    """Return where the next file of samples goes, and its name for the scene: beside the .blend, if that is saved."""
    name = f"{STEM}{version}.csv"
    if bpy.data.filepath:
        return Path(bpy.path.abspath("//")) / name, f"//{name}"
    return own_folder() / name, name


def own_folder() -> Path:
    """Return the user's folder for what was learned, which an update of the extension leaves alone.

    Raises
    ------
    BuildError
        It cannot be made.
    """
    # the extension itself: this package lies in it
    extension = ".".join(__package__.split(".")[:3])
    try:
        folder = bpy.utils.extension_path_user(extension, path="learned", create=True)
    except ValueError:
        # run from its sources, and not installed as an extension
        folder = bpy.utils.user_resource("CONFIG", path="legorize", create=True)
    except OSError as error:
        raise BuildError(
            f"Blender's user folder cannot be created ({error.strerror}): check its permissions."
        ) from error
    if not folder:
        raise BuildError("Blender has no user folder: set one in the preferences.")
    return Path(folder)


def own_versions() -> list[int]:
    """Return the versions in the user's folder and beside the .blend, ascending, after a 0."""
    folders = [own_folder(), *([Path(bpy.path.abspath("//"))] if bpy.data.filepath else [])]
    names = {path.stem.removeprefix(STEM) for folder in folders for path in folder.glob(f"{STEM}*.csv")}
    return [0, *sorted(int(name) for name in names if name.isdecimal())]
