"""What the add-on shows, in other languages, by Blender's own mechanism.

A catalogue is a file ``assets/translations/LANGUAGE.json``, named as Blender
names the language. It has two tables from English to that language: "Operator"
for the names of operators, which Blender looks up apart from all others, and "*"
for the rest. Texts with numbers are translated with ``{}`` in their places.
Remarks and errors of the core stay English.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

import bpy

from ..core.model import ASSETS

FOLDER: Final = ASSETS / "translations"
DEFAULT: Final = "*"
OPERATOR: Final = "Operator"
CONTEXTS: Final = (DEFAULT, OPERATOR)

Messages = dict[tuple[str, str], str]
"""Translations by context and English text, as Blender wants them."""


def catalogue_files() -> dict[str, Path]:
    """Return the files of the catalogues by language."""
    return {path.stem: path for path in sorted(FOLDER.glob("*.json"))}


def read_messages(path: Path) -> Messages:
    """Return what a catalogue has.

    Parameters
    ----------
    path : pathlib.Path
        JSON file of the two tables.

    Returns
    -------
    Messages
    """
    tables = json.loads(path.read_text(encoding="utf-8"))
    return {(context, text): said for context in CONTEXTS for text, said in tables[context].items()}


def register() -> None:
    """Give Blender all catalogues, so that another language shows at once."""
    found = {language: read_messages(path) for language, path in catalogue_files().items()}
    bpy.app.translations.register(__name__, found)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.app.translations.unregister(__name__)
