"""Numbers with their nouns, in singular and plural, in the language of the window."""

from __future__ import annotations

from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n


def count_of(number: int, one: str, more: str, shown: str = "") -> str:
    """Return a number with its noun.

    Parameters
    ----------
    number : int
    one, more : str
        English texts that have translations: that of one, and that of all other numbers, with ``{}`` in its place.
    shown : str, optional
        How the number is written, by default in digits.

    Returns
    -------
    str
    """
    return iface(one) if number == 1 else iface(more).format(shown or number)


def bricks(number: int, shown: str = "") -> str:
    """Return a number of bricks."""
    return count_of(number, n("1 brick"), n("{} bricks"), shown)


def layers(number: int) -> str:
    """Return a number of layers."""
    return count_of(number, n("1 layer"), n("{} layers"))


def kinds_of_parts(number: int) -> str:
    """Return a number of kinds of parts."""
    return count_of(number, n("1 kind of part"), n("{} kinds of parts"))


def colours(number: int) -> str:
    """Return a number of colours."""
    return count_of(number, n("1 colour"), n("{} colours"))


def steps(number: int) -> str:
    """Return a number of building steps."""
    return count_of(number, n("1 building step"), n("{} building steps"))


def slices(number: int) -> str:
    """Return a number of slices."""
    return count_of(number, n("1 slice"), n("{} slices"))


def extent(wide: int, deep: int, high: int) -> str:
    """Return a size in studs and layers."""
    return iface("{} x {} studs, {}").format(wide, deep, layers(high))
