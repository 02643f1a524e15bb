"""Settings as one JSON object, to be kept beside a model, changed by programs, and read again."""

from __future__ import annotations

import json
from dataclasses import asdict, fields
from difflib import get_close_matches
from typing import Any

from .errors import SettingsError
from .setting import renamed
from .settings import Settings


def settings_text(settings: Settings) -> str:
    """Return all settings as JSON, in the order of the panel.

    Parameters
    ----------
    settings : Settings
        They are written whole, so that a later version with other defaults builds the same.

    Returns
    -------
    str
        With a newline at the end.
    """
    return json.dumps(asdict(settings), indent=2, ensure_ascii=False) + "\n"


def read_settings(text: str) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Return the settings that a JSON text names, and remarks on those with an earlier name.

    Parameters
    ----------
    text : str
        An object with some or all settings by name, or a report, whose settings
        are taken.

    Returns
    -------
    values : dict
        Settings by name, with their values as they stand there; those that are
        not named are missing. :class:`~.settings.Settings` checks the values.
    remarks : tuple of str
        One sentence for each setting that was given by an earlier name.

    Raises
    ------
    SettingsError
        It is not JSON, not an object, or names something that is no setting.
    """
    try:
        read = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise SettingsError(f"The settings are not valid JSON ({error}): mend the file.") from error
    if isinstance(read, dict) and isinstance(read.get("settings"), dict):
        read = read["settings"]
    if not isinstance(read, dict):
        raise SettingsError('The settings are not an object: write them as {"width": 48}.')
    earlier = {entry.metadata["was"]: entry for entry in fields(Settings) if entry.metadata["was"]}
    remarks = tuple(renamed(earlier[name]) for name in read if name in earlier)
    values = {earlier[name].name if name in earlier else name: value for name, value in read.items()}
    known = [entry.name for entry in fields(Settings)]
    for name in values:
        if name not in known:
            raise SettingsError(f"There is no setting {name!r}{_near(name, known)}")
    return values, remarks


def _near(name: str, known: list[str]) -> str:
    near = get_close_matches(name, known, n=1)
    return f": did you mean {near[0]!r}?" if near else ": leave it out."
