"""Settings refuse what is out of range, in one sentence that names the number and the limits."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, fields, replace
from typing import get_args

import numpy as np
import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings, choices, has_effect, setting_type
from legorize_addon.core.statics.equilibrium import SPARE
from legorize_addon.core.statics.forces import CAUTIOUS_HOLD
from tests.core.solids import sphere

ENTRIES = {entry.name: entry for entry in fields(Settings)}
NUMBERS = [name for name, entry in ENTRIES.items() if setting_type(entry) in (int, float)]
WORDS = [name for name, entry in ENTRIES.items() if choices(entry)]


def test_default_clutch_is_the_cautious_one():
    """A model is built for bricks that bear as little as any that were measured, with a fifth to spare."""
    assert Settings().clutch == CAUTIOUS_HOLD
    assert Settings().spare == SPARE


def refusal(name, value) -> str:
    """Return the sentence that refuses a value."""
    with pytest.raises(SettingsError) as refused:
        Settings(**{name: value})
    return str(refused.value)


@pytest.mark.parametrize("name", ENTRIES)
def test_every_setting_is_told_to_the_user(name):
    """A text of one sentence, a group, and for numbers both limits around the default."""
    entry = ENTRIES[name]
    assert entry.metadata["text"].endswith(".")
    assert entry.metadata["group"]
    assert entry.metadata["name"][0].isupper()
    if name in NUMBERS:
        assert entry.metadata["low"] <= entry.default <= entry.metadata["high"]


@pytest.mark.parametrize("name", NUMBERS)
def test_limits_are_allowed_and_what_lies_beyond_is_refused(name):
    """Both limits are good values; the next number beyond is refused with the number, the limits and a full stop."""
    low, high = ENTRIES[name].metadata["low"], ENTRIES[name].metadata["high"]
    assert getattr(Settings(**{name: low}), name) == low
    assert getattr(Settings(**{name: high}), name) == high
    whole = setting_type(ENTRIES[name]) is int
    for beyond in (low - 1, high + 1) if whole else (np.nextafter(low, -np.inf), np.nextafter(high, np.inf)):
        assert refusal(name, beyond) == f"{name} is {beyond}: choose a value from {low} to {high}."


@pytest.mark.parametrize("name", [name for name in NUMBERS if setting_type(ENTRIES[name]) is float])
def test_real_numbers_may_be_whole_but_never_nan_or_infinite(name):
    """A whole number is a real one; what is not a finite number is refused."""
    whole = int(ENTRIES[name].metadata["high"])
    assert getattr(Settings(**{name: whole}), name) == whole
    for value in (np.nan, np.inf, -np.inf):
        assert refusal(name, value).startswith(f"{name} is ")


@pytest.mark.parametrize(
    ("name", "value", "kind"),
    [
        ("width", 4.0, "int"),
        ("width", True, "int"),
        ("width", "48", "int"),
        ("width", None, "int"),
        ("scale", "10", "float"),
        ("scale", True, "float"),
        ("hollow", 1, "bool"),
        ("hollow", "yes", "bool"),
        ("palette", 4, "str"),
    ],
)
def test_values_of_another_type_are_refused(name, value, kind):
    """Nothing is converted behind the user's back."""
    assert refusal(name, value) == f"{name} is {value!r}: give it a value of type {kind}."


@pytest.mark.parametrize("name", WORDS)
def test_words_are_those_listed(name):
    """Each listed word has its meaning and is allowed, and another one is refused with the list."""
    words = choices(ENTRIES[name])
    assert words == get_args(setting_type(ENTRIES[name]))
    assert all(getattr(Settings(**{name: word}), name) == word for word in words)
    assert refusal(name, "else") == f"{name} is 'else': choose one of {', '.join(words)}."
    assert refusal(name, None).endswith(".")


def test_settings_cannot_be_changed():
    """Settings are fixed once made."""
    with pytest.raises(FrozenInstanceError):
        Settings().width = 3  # type: ignore[misc]


def test_what_is_not_a_word_has_no_choices():
    """Only settings of listed words have choices."""
    assert WORDS
    assert all(not choices(entry) for name, entry in ENTRIES.items() if name not in WORDS)


@pytest.mark.parametrize(("first", "second"), [("open_bottom", True), ("hollow_rule", "upper")])
def test_settings_that_contradict_each_other_are_refused(first, second):
    """What shapes a hollow model is refused for a solid one, in one sentence that names both settings."""
    with pytest.raises(SettingsError, match=rf"^{first} .* hollow is off.*\.$"):
        Settings(hollow=False, **{first: second})
    assert getattr(Settings(**{first: second}), first) == second


def test_a_setting_waits_for_the_one_that_it_needs():
    """A number counts with its choice, and what shapes the inside where there is an inside."""
    assert has_effect(ENTRIES["width"], Settings())
    assert not has_effect(ENTRIES["cm"], Settings())
    assert has_effect(ENTRIES["shell"], Settings())
    assert not has_effect(ENTRIES["shell"], Settings(hollow=False))
    assert has_effect(ENTRIES["goal"], Settings(prices="prices.csv"))
    assert not has_effect(ENTRIES["goal"], Settings())
    assert not has_effect(ENTRIES["slope_price"], Settings())
    assert has_effect(ENTRIES["slope_price"], Settings(surface="slopes"))
    assert has_effect(ENTRIES["slope_price"], Settings(half_studs=True))
    assert not has_effect(ENTRIES["emphasis"], Settings())
    assert has_effect(ENTRIES["emphasis"], Settings(weight="face"))
    assert has_effect(ENTRIES["emphasis"], Settings(features="colours"))


NEEDY = [name for name, entry in ENTRIES.items() if entry.metadata["needs"]]


def others(name):
    """Return values of a setting beside its default."""
    entry = ENTRIES[name]
    if choices(entry):
        return [word for word in choices(entry) if word != entry.default]
    return [not entry.default] if setting_type(entry) is bool else [entry.metadata["low"], entry.metadata["high"]]


@pytest.mark.parametrize("name", NEEDY)
def test_what_a_setting_needs_is_another_one(name):
    """The other one is there, and has the words."""
    other, *words = ENTRIES[name].metadata["needs"]
    assert other in ENTRIES
    assert other != name
    assert set(words) <= set(choices(ENTRIES[other]))
    also = ENTRIES[name].metadata["also"]
    assert not also or setting_type(ENTRIES[also]) is bool or "none" in choices(ENTRIES[also])


SHAPED = ["plate_gain", "fewer_parts", "layer_difference", "shell", "ceilings", "learned"]


@pytest.mark.parametrize("name", SHAPED)
def test_a_grey_setting_changes_nothing(name):
    """Where a setting is said to have no effect, the bricks are the same whatever its value."""
    other = ENTRIES[name].metadata["needs"][0]
    for value in others(other):
        settings = Settings(size_by="cm", cm=3.2, **{other: value})
        if has_effect(ENTRIES[name], settings):
            continue
        first = legorize(sphere(), settings)
        for changed in others(name):
            again = legorize(sphere(), replace(settings, **{name: changed}))
            assert np.array_equal(again.bricks.corner, first.bricks.corner)
            assert np.array_equal(again.bricks.part, first.bricks.part)
