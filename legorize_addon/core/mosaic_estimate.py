"""An estimate of a mosaic before it is made."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from .estimate import PROOF, TIERS, Estimate
from .mosaic import DEEP
from .settings import Settings
from .units import BRICK, MM_PER_CM, PLATE, PLATES_PER_BRICK, STUD

_BRICKS: Final = 0.6
"""Parts to a stud of a photograph in mixed colours."""

_SECONDS: Final = MappingProxyType(
    {"colours": (0.2, 1e-5), "layout": (0.1, 1e-4), "stability": (0.05, 4e-5), "supports": (0.1, 3e-4)}
)
"""CPU seconds of the stages, and more for each stud."""

_MEGABYTES: Final = (130.0, 0.02)
"""Peak of the resident memory of a process, and more for each stud."""


def estimate_mosaic(studs: tuple[int, int], settings: Settings) -> Estimate:
    """Estimate a mosaic of an image.

    Parameters
    ----------
    studs : (int, int)
        Along x and y, with the border.
    settings : Settings

    Returns
    -------
    Estimate
        If the image is so rich in colours that most parts have one or two studs.
    """
    cells = studs[0] * studs[1]
    seconds = {name: constant + each * cells for name, (constant, each) in _SECONDS.items()}
    seconds["layout"] *= TIERS[settings.layout]
    if settings.prove_steps:
        seconds["proof"] = PROOF * sum(seconds.values())
    if settings.standing:
        return _of_wall(studs, seconds, settings)
    plates = 1 + (PLATES_PER_BRICK if settings.mosaic == "bricks" else 1)
    return Estimate(
        studs=(float(studs[0]), float(studs[1])),
        layers=-(-plates // PLATES_PER_BRICK),
        cm=(studs[0] * STUD / MM_PER_CM, studs[1] * STUD / MM_PER_CM, plates * PLATE / MM_PER_CM),
        cells=float(cells),
        bricks=round(_BRICKS * cells),
        megabytes=_MEGABYTES[0] + _MEGABYTES[1] * cells,
        stages=seconds,
    )


_WALL: Final = MappingProxyType({"layout": 6e-4, "ties": 1e-5, "strengthening": 5e-5, "bracing": 1e-5})
"""CPU seconds of the stages of a wall for each stud, more than for a mosaic that lies."""


def _of_wall(studs: tuple[int, int], seconds: Mapping[str, float], settings: Settings) -> Estimate:
    """Estimate a mosaic that stands."""
    cells = studs[0] * studs[1]
    order = ("colours", "layout", "ties", "strengthening", "stability", "bracing", "supports", "proof")
    stages = {
        name: seconds.get(name, 0.0) + TIERS[settings.layout] * _WALL.get(name, 0.0) * cells
        for name in order
        if name in {*seconds, *_WALL}
    }
    return Estimate(
        studs=(float(studs[0]), float(DEEP)),
        layers=studs[1],
        cm=(studs[0] * STUD / MM_PER_CM, DEEP * STUD / MM_PER_CM, studs[1] * BRICK / MM_PER_CM),
        cells=float(DEEP * cells),
        bricks=round(_BRICKS * cells),
        megabytes=_MEGABYTES[0] + DEEP * _MEGABYTES[1] * cells,
        stages=stages,
    )
