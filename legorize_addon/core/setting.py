"""How a setting is declared, and what its declaration says.

The names, types, defaults, limits, texts and places of all settings are in the
fields of :class:`~.settings.Settings`; here is what a field can say.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import Field, field
from typing import Any, Final, TypedDict, Unpack, get_args

from .errors import SettingsError

SEPARATOR: Final = ";"
"""Between the names of several files in one setting."""


class Rare(TypedDict, total=False):
    """What few settings need.

    Attributes
    ----------
    needs : tuple of str
        Another setting, and its words with which this one has an effect; a
        setting alone must be on, above 0 or not empty.
    also : str
        A switch, or a choice other than "none", that gives it an effect as well.
    was : str
        Name that it had in an earlier version: still read from scenes and the
        command line, with a remark.
    files : int
        How many files a text may name, separated by ``;``: none, one or several.
    """

    needs: tuple[str, ...]
    also: str
    was: str
    files: int


def setting(
    default: Any,
    name: str,
    text: str,
    *,
    group: str,
    limits: tuple[float, float] | None = None,
    words: Mapping[str, str] | None = None,
    **rare: Unpack[Rare],
) -> Any:
    """Declare a setting.

    Parameters
    ----------
    default : bool, int, float or str
        Value if none is given.
    name : str
        As the panel shows it; a number's unit stands behind it in parentheses.
    text : str
        One sentence for the tooltip and the command line's help.
    group : str
        Section of the panel.
    limits : (float, float), optional
        Of a number, both allowed values.
    words : mapping of str to str, optional
        What each word of a choice means, in half a sentence.
    **rare
        See :class:`Rare`.

    Returns
    -------
    Field
        A dataclass field that carries the above as metadata.
    """
    low, high = limits or (None, None)
    metadata: dict[str, Any] = {"name": name, "text": text, "group": group, "low": low, "high": high}
    metadata |= {"words": words or {}, "needs": (), "also": "", "was": "", "files": 0, **rare}
    return field(default=default, metadata=metadata)


def help_text(entry: Field[Any]) -> str:
    """Return what a setting is and what each of its words means, in sentences."""
    words = "; ".join(f"{word}: {meaning}" for word, meaning in entry.metadata["words"].items())
    return f"{entry.metadata['text']} {words}." if words else str(entry.metadata["text"])


def renamed(entry: Field[Any]) -> str:
    """Return the remark for a setting that was given by its earlier name."""
    return f"The setting {entry.metadata['was']} is now called {entry.name}: its value was used."


def check_value(entry: Field[Any], expected: Any, value: Any) -> None:
    """Refuse a value that a setting cannot have.

    Parameters
    ----------
    entry : Field
        The setting.
    expected : type
        Its type: bool, int, float, str or a Literal.
    value : object

    Raises
    ------
    SettingsError
        The value is of another type, no word of the choice, or beyond the limits.
    """
    words = get_args(expected)
    if words:
        if value not in words:
            raise SettingsError(f"{entry.name} is {value!r}: choose one of {', '.join(words)}.")
        return
    if not isinstance(value, (int, float) if expected is float else expected) or (
        isinstance(value, bool) and expected is not bool
    ):
        raise SettingsError(f"{entry.name} is {value!r}: give it a value of type {expected.__name__}.")
    low, high = entry.metadata["low"], entry.metadata["high"]
    # the negated form also refuses not-a-number
    if low is not None and not low <= value <= high:
        raise SettingsError(f"{entry.name} is {value}: choose a value from {low} to {high}.")
