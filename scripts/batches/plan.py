"""From a folder of models and a grid of settings to the runs of a batch."""

from __future__ import annotations

import hashlib
import json
import re
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import product
from pathlib import Path
from typing import Any, Final
from urllib.parse import unquote

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.files.sources.pictures import PICTURES
from legorize_addon.core.settings import Settings, choices, setting_type

from .work import Task

MESHES: Final = (".blend", ".fbx", ".glb", ".gltf", ".obj", ".ply", ".stl")
SIZES: Final = ("width", "height", "scale", "cm")
"""Settings of which a run takes one: each chooses itself in ``size_by``."""

_LONGEST: Final = 60
"""Letters of the name of a run; longer ones are cut and get a checksum."""

Grid = Mapping[str, Sequence[Any]]


@dataclass(frozen=True, slots=True)
class Run:
    """One model with one choice of settings.

    Attributes
    ----------
    model : Path
    name : str
        Model and varied settings, as a path with ``/``.
    varied : dict of str to any
        Settings of which the grid has several values.
    words : tuple of str
        Flags for the script.
    """

    model: Path
    name: str
    varied: dict[str, Any]
    words: tuple[str, ...]


def models_in(folder: Path, out: Path) -> list[Path]:
    """Return the models in a folder and below, by name; images only where there are no meshes at all.

    Raises
    ------
    SettingsError
        There is no folder, or nothing in it that can be read.
    """
    if not folder.is_dir():
        raise SettingsError(f"There is no folder {folder}: name one with models.")
    inside = [
        path for path in sorted(folder.rglob("*")) if path.is_file() and out.resolve() not in path.resolve().parents
    ]
    for kinds in (MESHES, PICTURES):
        found = [path for path in inside if path.suffix.lower() in kinds]
        # images beside meshes are their textures
        if found:
            return found
    raise SettingsError(f"There is nothing in {folder} that can be read: put models or images there.")


def read_grid(path: Path) -> dict[str, list[Any]]:
    """Return the settings and their values of a JSON or TOML file.

    Raises
    ------
    SettingsError
        It cannot be read, or is not a table of settings.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
        found = tomllib.loads(text) if path.suffix.lower() == ".toml" else json.loads(text)
    except OSError as error:
        raise SettingsError(f"{path} cannot be read ({error.strerror}): name a file with a grid.") from error
    except ValueError as error:
        raise SettingsError(f"{path} is no {path.suffix.lstrip('.').upper() or 'JSON'} file ({error}).") from error
    if not isinstance(found, dict):
        raise SettingsError(f"{path} is no table: give it settings, each with one value or a list of values.")
    return {name.replace("-", "_"): value if isinstance(value, list) else [value] for name, value in found.items()}


def check_grid(grid: Grid) -> None:
    """Refuse names that are no settings, values of the wrong kind, and several ways to set the size.

    Raises
    ------
    SettingsError
    """
    known = {entry.name: entry for entry in fields(Settings)}
    for name, values in grid.items():
        if name not in known:
            raise SettingsError(f"There is no setting {name}: choose one that legorize.py --help lists.")
        if not values:
            raise SettingsError(f"{name} has no value in the grid: give it one, or leave it out.")
        for value in values:
            kind = setting_type(known[name])
            if choices(known[name]) and value not in choices(known[name]):
                raise SettingsError(f"{name} is {value!r}: choose of {', '.join(choices(known[name]))}.")
            if kind in (bool, int, float, str) and not _fits(value, kind):
                raise SettingsError(f"{name} is {value!r}: give it a value of type {kind.__name__}.")
    sizes = [name for name in SIZES if name in grid]
    if len(sizes) > 1:
        raise SettingsError(f"The grid sets the size by {' and '.join(sizes)}: choose one of them.")


def _fits(value: Any, kind: type) -> bool:
    if isinstance(value, bool) or kind is bool:
        return isinstance(value, bool) and kind is bool
    return isinstance(value, (int, float) if kind is float else kind)


def runs_of(models: Sequence[Path], folder: Path, grid: Grid, flags: Sequence[str]) -> list[Run]:
    """Return each model with each choice of the grid.

    Parameters
    ----------
    models : sequence of Path
        In `folder`.
    folder : Path
    grid : mapping of str to sequence
        Settings and their values.
    flags : sequence of str
        More flags for every run.

    Returns
    -------
    list of Run
        Model by model. Names are different, also where letters had to be replaced.
    """
    names, found = list(grid), []
    for model in models:
        for values in product(*(dict.fromkeys(grid[name]) for name in names)):
            chosen = dict(zip(names, values, strict=True))
            varied = {name: value for name, value in chosen.items() if len(dict.fromkeys(grid[name])) > 1}
            words = [word for name, value in chosen.items() for word in _flag(name, value)]
            name = "/".join((_plain(model.relative_to(folder).as_posix()), _plain(_label(varied))))
            found.append(Run(model, name, varied, (*words, *flags)))
    return found


def _label(varied: Mapping[str, Any]) -> str:
    return "_".join(f"{name}-{value}" for name, value in varied.items()) or "run"


def _plain(text: str) -> str:
    """Return a text as a name for a folder: letters, digits, dots, dashes; a checksum tells equal ones apart."""
    plain = re.sub(r"[^\w.-]+", "_", text, flags=re.ASCII)
    if plain == text and len(plain) <= _LONGEST:
        return plain
    return f"{plain[:_LONGEST]}-{hashlib.sha256(text.encode(errors='surrogateescape')).hexdigest()[:8]}"


def _flag(name: str, value: Any) -> Iterator[str]:
    flag = name.replace("_", "-")
    if isinstance(value, bool):
        yield f"--{flag}" if value else f"--no-{flag}"
    else:
        # a value may begin with a minus
        yield f"--{flag}={value}"


def tasks_of(runs: Sequence[Run], out: Path, *, program: Sequence[str], version: str, stop: Path) -> list[Task]:
    """Return what is to be started for each run.

    Parameters
    ----------
    runs : sequence of Run
    out : Path
        Folder of the batch.
    program : sequence of str
        What starts the script, with the script.
    version : str
        Of the add-on.
    stop : Path
        File that ends all runs.

    Returns
    -------
    list of Task
    """
    checksum = {model: checksum_of(model) for model in dict.fromkeys(run.model for run in runs)}
    found = []
    for run in runs:
        made_of = [checksum[run.model], version, run.model.name, *run.words]
        key = hashlib.sha256("\0".join(made_of).encode(errors="surrogateescape")).hexdigest()
        results = out / "runs" / run.name
        command = (*program, str(run.model.resolve()), "--out", str(results), "--tag", key, *run.words)
        found.append(Task(run.name, key, command, str(out), str(stop)))
    return found


_NAMED: Final = re.compile(
    rb'(?:"uri"\s*:\s*"([^"]+)"|^\s*(?:mtllib|map_\w+|bump|disp|norm)\s+(?:-\S+\s+\S+\s+)*(\S.*?)\s*$)', re.M
)
"""What .gltf, .obj and .mtl files name: buffers, images, materials."""


def checksum_of(model: Path) -> str:
    """Return the checksum of a file and of the files beside it that it names."""
    total, waiting, seen = hashlib.sha256(), [model.resolve()], set[Path]()
    while waiting:
        path = waiting.pop()
        if path in seen or not path.is_file():
            continue
        seen.add(path)
        content = path.read_bytes()
        total.update(hashlib.sha256(content).digest())
        if path.suffix.lower() in (".gltf", ".obj", ".mtl"):
            names = [(one or other).decode(errors="replace") for one, other in _NAMED.findall(content)]
            waiting += [path.parent / unquote(name) for name in names if not name.startswith("data:")]
    return total.hexdigest()


def program_of(blender: str | None, script: Path) -> tuple[str, ...]:
    """Return the words that start the script: in this Python, or in a Blender program."""
    return (blender, "-b", "-P", str(script), "--") if blender else (sys.executable, str(script))
