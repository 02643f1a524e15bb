"""Settings that exclude each other."""

from __future__ import annotations

from typing import Any

from .errors import SettingsError


def refuse_excluding(settings: Any) -> None:
    """Refuse settings that exclude each other.

    Parameters
    ----------
    settings : Settings
        Each of them has a value that it may have.

    Raises
    ------
    SettingsError
        Two of them contradict each other, in one sentence.
    """
    if settings.open_bottom and not settings.hollow:
        raise SettingsError(
            "open_bottom is on but hollow is off: a solid model has no open bottom; turn hollow on or open_bottom off."
        )
    if settings.dithering != "none" and (settings.one_to_one or settings.cell_colour == "longest"):
        other = "one_to_one is on" if settings.one_to_one else "cell_colour is 'longest'"
        raise SettingsError(
            f"dithering is {settings.dithering!r} but {other}: they exclude each other; change one of them."
        )
    if settings.surface == "slopes" and settings.layout == "learned":
        raise SettingsError(
            "surface is 'slopes' but layout is 'learned', which lays nothing around slopes: choose another layout."
        )
    if settings.surface == "tiles" and not settings.smooth:
        other = "plates is 'none'" if settings.plates == "none" else "tops is 'studs'"
        raise SettingsError(f"surface is 'tiles' but {other}, which leaves no place for tiles: change one of the two.")
    if settings.half_studs and (settings.plates == "none" or settings.layout == "learned"):
        other = "plates is 'none'" if settings.plates == "none" else "layout is 'learned'"
        raise SettingsError(f"half_studs is on but {other}: jumpers need plates around them; change one of them.")
    if settings.hollow_rule == "upper" and not settings.hollow:
        raise SettingsError("hollow_rule is 'upper' but hollow is off: turn hollow on, or set the rule to 'both'.")
