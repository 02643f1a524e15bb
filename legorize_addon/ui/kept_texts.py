"""The files of a run that bricks alone do not tell: made when a model is made, and kept with it."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from ..core.model import load_catalogue

if TYPE_CHECKING:
    from ..core.build import Finished

Kind = TypeVar("Kind", bound="Finished")


@cache
def version() -> str:
    """Return the version, which stands in the manifest beside the package alone."""
    manifest = Path(__file__).resolve().parents[2] / "blender_manifest.toml"
    return str(tomllib.loads(manifest.read_text(encoding="utf-8"))["version"])


def with_texts(build: Kind, *, title: str, remarks: Sequence[str], mm_per_unit: float) -> Kind:
    """Return a model with those files of a run that its bricks alone do not tell; no Blender in here.

    Parameters
    ----------
    build : Finished
    title : str
        Name of the model.
    remarks : sequence of str
        What could not be read literally.
    mm_per_unit : float
        World mm per Blender unit.

    Returns
    -------
    Finished
    """
    from ..core.report import failed_checks, later_texts, report

    catalogue, told = load_catalogue(), replace(build, notes=(*remarks, *build.notes))
    facts = report(told, catalogue, version=version(), mm_per_unit=mm_per_unit)
    facts |= {"failed_checks": failed_checks(facts)}
    return replace(build, texts=later_texts(told, catalogue, facts, title))
