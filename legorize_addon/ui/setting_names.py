"""Sentences of the core name settings as flags do; in the window they name them as the panel does."""

from __future__ import annotations

import re
from dataclasses import fields
from typing import Final

from bpy.app.translations import pgettext_iface as iface

from ..core.settings import Settings

_ENTRIES: Final = {entry.name: entry for entry in fields(Settings) if "_" in entry.name}
"""Those whose name is no word by itself: the others read as well in a sentence, and differ by a capital at most."""

_NAMED: Final = re.compile(rf"(?<![\w/\\.'\"-])({'|'.join(_ENTRIES)})(?![\w/\\'\"-]|\.\w)")
"""A setting in a sentence, not in the path of a file nor in a flag."""


def as_in_panel(sentence: str) -> str:
    """Return a sentence with the names that settings have in the panel, each with the group where it stands."""
    return _NAMED.sub(_label, sentence)


def _label(found: re.Match[str]) -> str:
    said = _ENTRIES[found[1]].metadata
    return f"{iface(said['group'])} > {iface(said['name'])}"
