"""Models for which too few parts are owned get fewer plates, of which people have few, and in the end none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from .build import Build
from .errors import PartsError
from .fitting import Making
from .mesh import TriangleMesh
from .progress import Progress, part
from .settings import Settings

GAINS: Final = (0.4, 0.6, 0.8)
"""Errors that plates must save to pay, tried one after the other."""


def with_enough_parts(make: Making, mesh: TriangleMesh, settings: Settings, progress: Progress) -> Build:
    """Build a model, with fewer plates if the owned parts do not suffice.

    Parameters
    ----------
    make : callable
        Builds a model.
    mesh : TriangleMesh
    settings : Settings
    progress : Progress

    Returns
    -------
    Build
        With the settings that were given, and a remark if it has fewer plates.

    Raises
    ------
    PartsError
        The owned parts do not suffice without plates either.
    """
    told = [0.0]

    def telling(stage: str, share: float) -> None:
        """Keep the share that was told, which never decreases."""
        told[0] = share
        progress(stage, share)

    try:
        return make(mesh, settings, telling)
    except PartsError as error:
        first = error
    for changed, sentence in _with_fewer_plates(settings):
        try:
            build = make(mesh, changed, part(telling, told[0], 1.0))
        except PartsError:
            continue
        return replace(build, settings=settings, notes=(*build.notes, sentence))
    raise first


def _with_fewer_plates(settings: Settings) -> Iterator[tuple[Settings, str]]:
    """Yield settings with fewer and fewer plates, and what to say of each."""
    if settings.plates == "none":
        return
    for gain in GAINS:
        if settings.plates == "all" or settings.plate_gain < gain:
            yield (
                replace(settings, plates="pays", plate_gain=gain),
                f"The owned parts do not suffice as it was set: plates are only where they save an error of {gain} "
                "(plate_gain).",
            )
    yield (
        # neither tiles nor jumpers are there without plates
        replace(
            settings,
            plates="none",
            half_studs=False,
            surface="studs" if settings.surface == "tiles" else settings.surface,
        ),
        "The owned parts do not suffice with plates: the model was built of bricks alone.",
    )
