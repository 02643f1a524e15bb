"""Looks: sets of settings with a name and a sentence, for those who do not want to know every setting."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

from .errors import SettingsError


@dataclass(frozen=True, slots=True)
class Preset:
    """Settings that belong together.

    Attributes
    ----------
    name : str
        As the panel shows it.
    text : str
        One sentence for the tooltip and the command line's help.
    values : mapping of str to object
        Settings by name; all others keep their defaults.
    """

    name: str
    text: str
    values: Mapping[str, Any]


PRESETS: Final[Mapping[str, Preset]] = MappingProxyType(
    {
        "desk": Preset("Desk Model", "As large as a hand, for an afternoon of building.", {"width": 24}),
        "display": Preset("Display", "The usual size for a shelf, with plates where they pay.", {}),
        "detail": Preset(
            "Finest Detail",
            "Plates wherever the surface or the colour asks for them, however many parts that takes.",
            {"plates": "all", "fewer_parts": 0.0},
        ),
        "smooth": Preset(
            "Smooth Surface",
            "Slopes where the surface is inclined, tiles where studs would show, and the grid of studs where it fits "
            "best, at a size up to 3 % smaller or larger: closer to the shape, for some more parts.",
            {"surface": "slopes", "grid_fit": "sizes"},
        ),
        "bricks": Preset("Bricks Only", "Bold and quick to build: whole bricks, without plates.", {"plates": "none"}),
        "cheapest": Preset(
            "Cheapest",
            "As few parts as the shape allows: small differences in shape and colour are given up for them.",
            {"plate_gain": 0.4, "fewer_parts": 1.0, "layout": "exact"},
        ),
        "paper": Preset(
            "As Published",
            "Each step as in the paper: seven dominant colours of the whole image, longest trajectories, the layer "
            "above alone, the learned fill, trees of eleven bricks, nothing strengthened; weaker than the default.",
            {
                "colours": 7,
                "sampling": "image",
                "cell_colour": "longest",
                "fine_texture": "texels",
                "chord_deviation": 0.4,
                "fewer_parts": 0.0,
                "superposition": "middle",
                "symmetric": False,
                "hollow_rule": "upper",
                "ceilings": "pillars",
                "layout": "learned",
                "supports": "tree",
                "support_parts": "paper",
                "strengthen": False,
                "feet": False,
            },
        ),
    }
)
"""Every preset by the word that chooses it on the command line."""


def follows(settings: Mapping[str, Any], word: str) -> bool:
    """Tell whether settings are those of a preset, whatever they say beside it."""
    return all(settings[name] == value for name, value in preset_values(word).items())


def preset_values(word: str) -> dict[str, Any]:
    """Return the settings of a preset, by name.

    Raises
    ------
    SettingsError
        There is no such preset.
    """
    if word not in PRESETS:
        raise SettingsError(f"There is no preset {word!r}: choose one of {', '.join(PRESETS)}.")
    return dict(PRESETS[word].values)
