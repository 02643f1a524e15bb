"""Every text that the add-on shows has its translation in every language."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

import bpy
import pytest

from legorize_addon.ui import menus, translations
from legorize_addon.ui.translations import DEFAULT, OPERATOR, Messages, catalogue_files, read_messages
from legorize_addon.view import STEPS

pytestmark = pytest.mark.usefixtures("addon")

PACKAGE = Path(translations.__file__).parents[1]
LANGUAGES = ("de_DE", "es", "fr_FR", "ja_JP", "zh_HANS")
MARKS = {"iface", "rpt", "tip", "n"}
"""Functions whose first argument is a text to translate: Blender's, under the names that all modules give them."""

SAME = {
    *("Legorize", "X", "Y", "Z", "cm", "A4", "11 x 8.5 inches", "297 x 210 mm"),
    *("BrickLink Studio", "BrickLink Wanted List", "LEGO Pick a Brick", "Rebrickable"),
}
"""Names and measures, which are the same in every language."""

OF_BLENDER = {"filepath", "check_existing", "remove_name", "remove_active", "name"}
"""Properties that Blender's own base classes bring, with Blender's translations."""

WORDS_OF_BLENDER = {
    "de_DE": {"Auto": "Auto", "Image": "Bild", "Play": "Wiedergabe", "Samples": "Abtastwerte", "Show": "Anzeigen"},
    "es": {"Auto": "Auto", "Delete": "Borrar", "Image": "Imagen", "Off": "Desactivado", "Weight": "Influencia"},
    "fr_FR": {"Auto": "Auto", "Play": "Lecture", "Samples": "Échantillons", "Show": "Afficher", "Weight": "Poids"},
    "ja_JP": {"Image": "画像", "Play": "再生", "Samples": "サンプル数", "Weight": "ウェイト"},
    "zh_HANS": {"Image": "图像", "Off": "关闭", "Play": "播放", "Seed": "随机种", "Weight": "权重"},
}
"""What Blender 4.3 calls the same things, by its own catalogues; words that mean something else there are left out."""

WORD_INSIDE = {
    r"\bframes?\b": {"de_DE": "einzelbild", "es": "fotograma", "fr_FR": "frame", "ja_JP": "フレーム", "zh_HANS": "帧"},
}
"""English words, and what stands for them inside of longer texts."""

SECOND_WORDS = {"ja_JP": ("部品",)}
"""What must not stand for a thing, since another word does so everywhere else."""

Text = tuple[str, str]
"""Context and English text."""


def classes(kind: type) -> Iterator[type]:
    """Yield our registered classes of a kind of Blender's."""
    for each in kind.__subclasses__():
        if each.__module__.startswith(PACKAGE.name) and getattr(each, "is_registered", False):
            yield each
        yield from classes(each)


def of_properties(rna: Any) -> Iterator[Text]:
    """Yield the names and tooltips of properties, and of their choices."""
    for each in rna.properties:
        if each.identifier in {"rna_type", *OF_BLENDER} or each.is_hidden or each.name == each.identifier:
            continue
        yield each.translation_context, each.name
        yield DEFAULT, each.description
        for item in each.enum_items if each.type == "ENUM" else ():
            yield each.translation_context, item.name
            yield DEFAULT, item.description


def registered() -> Iterator[Text]:
    """Yield what Blender draws by itself."""
    # menus of presets have the name of the one that was chosen last
    for kind in (bpy.types.Panel, bpy.types.PropertyGroup, bpy.types.AddonPreferences):
        for each in set(classes(kind)):
            yield DEFAULT, getattr(each, "bl_label", "")
            if kind in (bpy.types.PropertyGroup, bpy.types.AddonPreferences):
                yield from of_properties(each.bl_rna)
    live = bpy.types.WindowManager.bl_rna.properties["legorize_live"]
    yield from ((DEFAULT, live.name), (DEFAULT, live.description))
    for each in set(classes(bpy.types.Operator)):
        yield OPERATOR, each.bl_label
        yield DEFAULT, getattr(each, "bl_description", "")
        module, name = each.bl_idname.split(".")
        yield from of_properties(getattr(getattr(bpy.ops, module), name).get_rna_type())


def drawn() -> Iterator[Text]:
    """Yield the texts that the code draws or reports."""
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call):
                continue
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            context = OPERATOR if name == "operator" else DEFAULT
            shown = [(context, each.value) for each in node.keywords if each.arg in {"text", "heading"}]
            if name in MARKS:
                shown += [(DEFAULT, each) for each in node.args[:1]]
            texts = [(where, each.value) for where, each in shown if isinstance(each, ast.Constant)]
            if name == "stage" and isinstance(node.args[0], ast.Constant):
                texts.append((DEFAULT, node.args[0].value.capitalize()))
            yield from texts
    yield from ((OPERATOR, text) for entries in menus.ENTRIES.values() for _, text, _ in entries)
    for name, sentence in STEPS.values():
        yield from ((OPERATOR, name), (DEFAULT, name), (DEFAULT, sentence))


@cache
def all_texts() -> list[Text]:
    """Return everything that is to be translated."""
    return sorted({(context, text) for context, text in (*registered(), *drawn()) if text and text not in SAME})


def as_json(texts: list[Text]) -> str:
    """Return texts as they would stand in a catalogue, to be copied from there."""
    groups = groupby(sorted(texts), key=lambda entry: entry[0])
    return json.dumps({context: {text: "" for _, text in found} for context, found in groups}, indent=1)


def messages(language: str) -> Messages:
    """Return the catalogue of a language."""
    return read_messages(catalogue_files()[language])


def fields(text: str) -> list[str]:
    """Return the places for numbers in a text."""
    return sorted(re.findall(r"\{[^}]*\}", text))


def test_languages_are_there() -> None:
    """There is a catalogue for each language that is promised."""
    assert tuple(catalogue_files()) == LANGUAGES


@pytest.mark.parametrize("language", LANGUAGES)
def test_nothing_is_missing(language: str) -> None:
    """Each text has its translation; the message of a failure is what to add."""
    known = messages(language)
    missing = [text for text in all_texts() if not known.get(text)]
    assert not missing, f"Add to assets/translations/{language}.json:\n{as_json(missing)}"


@pytest.mark.parametrize("language", LANGUAGES)
def test_nothing_is_left_over(language: str) -> None:
    """No catalogue has what is shown no more, where it would hide that a text was changed."""
    left = sorted(messages(language).keys() - set(all_texts()))
    assert not left, f"Take out of assets/translations/{language}.json:\n{as_json(left)}"


@pytest.mark.parametrize("language", LANGUAGES)
def test_things_are_called_as_in_blender(language: str) -> None:
    """What has a name in Blender's own windows has the same name in ours."""
    known = {text: said for (context, text), said in messages(language).items() if context == DEFAULT}
    words = WORDS_OF_BLENDER[language]
    assert {text: known[text] for text in words} == words


@pytest.mark.parametrize("language", LANGUAGES)
def test_one_word_for_one_thing(language: str) -> None:
    """A thing has the same name in all texts of a language."""
    wrong = []
    for (_, text), said in messages(language).items():
        for word, names in WORD_INSIDE.items():
            if re.search(word, text, re.IGNORECASE) and names[language] not in said.lower():
                wrong.append((text, said))
        wrong += [(text, said) for other in SECOND_WORDS.get(language, ()) if other in said]
    assert wrong == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_numbers_keep_their_places(language: str) -> None:
    """A translation has the same places for numbers; a tooltip has no full stop, since Blender adds one."""
    wrong = [(text, said) for (_, text), said in messages(language).items() if fields(text) != fields(said)]
    assert wrong == []


def test_no_text_is_put_together_where_it_is_drawn() -> None:
    """A text with a number in it is looked up before the number is put in: what comes after cannot be found."""
    wrong = []
    for path in sorted((PACKAGE / "ui").glob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                shown = [each.value for each in node.keywords if each.arg in {"text", "heading"}]
                if getattr(node.func, "attr", "") == "report":
                    shown += node.args[1:]
                wrong += [f"{path.name}:{node.lineno}" for each in shown if letters(each)]
    assert wrong == []


def letters(node: ast.AST) -> bool:
    """Whether a text with places for values has words of its own."""
    parts = node.values if isinstance(node, ast.JoinedStr) else []
    return any(isinstance(part, ast.Constant) and re.search("[A-Za-z]{2}", part.value) for part in parts)
