"""Every setting, once.

The name, type, default, limits, text and panel group of a setting are in one
place: its field here. Range checks, Blender's property group, the sidebar and the
flags of the command line are all generated from these fields. The order of the
fields is the order in the panel.
"""

from __future__ import annotations

from dataclasses import Field, dataclass, field, fields
from functools import cache
from typing import Any, Final, Literal, get_args, get_type_hints

from .errors import SettingsError

SEPARATOR: Final = ";"
"""Between the names of several files in one setting."""


def setting(
    default: Any,
    text: str,
    *,
    group: str,
    low: float | None = None,
    high: float | None = None,
    was: str = "",
    files: int = 0,
) -> Any:
    """Declare a setting.

    Parameters
    ----------
    default : bool, int, float or str
        Value if none is given.
    text : str
        One sentence for the tooltip and the command line's help.
    group : str
        Section of the panel.
    low, high : float, optional
        Limits of a number, both allowed values.
    was : str, optional
        Name that it had in an earlier version: still read from scenes and the
        command line, with a remark.
    files : int, optional
        How many files a text may name, separated by ``;``: none, one or several.

    Returns
    -------
    Field
        A dataclass field that carries the above as metadata.
    """
    metadata = {"text": text, "group": group, "low": low, "high": high, "was": was, "files": files}
    return field(default=default, metadata=metadata)


@dataclass(frozen=True, kw_only=True, slots=True)
class Settings:
    """What a user can choose. Wrong values are refused with one sentence."""

    # fmt: off
    size_by: Literal["width", "height", "scale", "cm", "parts", "budget"] = setting(
        "width", "Which of the numbers below sets the size of the model.", group="Size")
    width: int = setting(
        48, "Studs along the longer horizontal side; of a mosaic with its border.", group="Size", low=1, high=1000)
    height: int = setting(
        40, "Height of the model in bricks.", group="Size", low=1, high=1000)
    scale: float = setting(
        10.0, "Scale factor: 10 keeps the object's own size, 5 halves it (k in section 3 of the paper).",
        group="Size", low=1e-4, high=1e6)
    cm: float = setting(
        38.4, "Longest side of the model in cm; of a mosaic with its border.", group="Size", low=0.8, high=800.0)
    parts: int = setting(
        1000, "Largest number of parts: the model becomes as large as it can, which takes several builds; temporary "
        "supports do not count.", group="Size", low=1, high=1_000_000)
    budget: float = setting(
        50.0, "Largest price of the model and its supports, in the currency of the price file: the model becomes as "
        "large as it can, which takes several builds.", group="Size", low=0.01, high=1e6)
    up: Literal["auto", "x", "y", "z"] = setting(
        "auto", "Axis of the object that points up; auto keeps the object as it is in Blender, and decides by the "
        "shape for files that do not say (.obj, .ply, .stl).", group="Size")

    colours: int = setting(
        256, "Largest number of dominant colours to find in the textures; similar ones become one brick colour "
        "(Algorithm 1 of the paper).",
        group="Colours", low=1, high=256)
    sampling: Literal["surface", "image"] = setting(
        "surface", "Whether texels count by the surface that they cover, or every texel of the image counts once "
        "(as in the paper).", group="Colours")
    palette: str = setting(
        "", "LDraw codes of the colours to use, separated by commas or spaces; empty for all that are made today.",
        group="Colours")
    one_to_one: bool = setting(
        False, "Give each dominant colour a brick colour of its own.", group="Colours")
    cell_colour: Literal["likeness", "longest"] = setting(
        "likeness", "Whether a brick takes the colour closest to all of its surface, or the colour with the "
        "greatest length of trajectory (as in the paper).", group="Colours")
    fine_texture: Literal["mean", "texels"] = setting(
        "mean", "What to do with textures that change within a stud, such as checkers and noise: take their mean, "
        "as seen from afar, or the colour that wins on each brick.", group="Colours")
    dithering: Literal["none", "ordered", "diffusion"] = setting(
        "none", "How to show shades that no brick has: each brick in the closest colour, colours mixed in a fixed "
        "pattern, or each brick's error passed on to the next ones (for flat pictures and reliefs).",
        group="Colours")
    least_alpha: float = setting(
        0.5, "Smallest alpha of a surface that is built: glass and the clear parts of leaves and decals are left "
        "out; 0 builds everything.", group="Colours", low=0.0, high=1.0)

    cusp: float = setting(
        3.2, "Largest cusp height in mm with one slice per brick; a smaller value gives three slices more often.",
        group="Slicing", low=0.1, high=9.6)
    chord_deviation: float = setting(
        0.0, "Largest distance in mm between a simplified trajectory and the cut of the mesh.", group="Slicing",
        low=0.0, high=4.0)

    plates: Literal["none", "pays", "all"] = setting(
        "pays", "Where to use plates instead of bricks: nowhere, where they pay, or wherever the surface cuts "
        "through a brick.", group="Detail")
    plate_gain: float = setting(
        0.2, "Error that plates must save to pay, as a share of a brick's volume or of a clear colour difference on "
        "its faces.", group="Detail", low=0.0, high=1.0)
    fewer_parts: float = setting(
        0.3, "Error, as above, to accept for one part less: neighbours then share plates and colours; 0 lets every "
        "column decide by itself.", group="Detail", low=0.0, high=2.0)
    layer_difference: float = setting(
        0.1, "Share by which trajectories of neighbouring layers may differ in length or area before these layers "
        "are sliced plate by plate.", group="Detail", low=0.0, high=1.0)
    critical_angle: float = setting(
        45.0, "Largest slope in degrees from the vertical that bricks carry by themselves; wider steps get offset "
        "bricks in their own colours.", group="Detail", low=1.0, high=89.0)
    backing: int = setting(
        0, "Layers or rows of bricks that hold a flat picture or relief together from behind.", group="Detail",
        low=0, high=16)

    mosaic: Literal["tiles", "plates", "bricks"] = setting(
        "tiles", "What a mosaic of an image is made of: smooth tiles, plates, or bricks.", group="Mosaic")
    mosaic_base: Literal["auto", "baseplates", "plates"] = setting(
        "auto", "What a mosaic lies on: baseplates of 16, 32 or 48 studs, large plates of any size, or baseplates "
        "where they fit exactly.", group="Mosaic")
    base_colour: int = setting(
        71, "LDraw code of the base's colour.", group="Mosaic", low=0, high=32767)
    border: int = setting(
        0, "Width in studs of a border around a mosaic.", group="Mosaic", low=0, high=100)
    border_colour: int = setting(
        0, "LDraw code of the border's colour.", group="Mosaic", low=0, high=32767)
    background: int = setting(
        -1, "LDraw code of the colour behind the clear parts of an image; -1 leaves the base bare there.",
        group="Mosaic", low=-1, high=32767)

    keep_thin: bool = setting(
        True, "Keep legs, ears and walls that cover less than half a stud.", group="Bricks")
    symmetric: bool = setting(
        True, "Centre the grid on the model, so that a symmetric object becomes a symmetric model.", group="Bricks")
    hollow: bool = setting(
        True, "Leave the inside empty.", group="Bricks")
    shell: int = setting(
        1, "Thickness of the shell in studs; one more stud inwards may be used.",
        group="Bricks", low=1, high=100)
    hollow_rule: Literal["both", "upper"] = setting(
        "both", "Whether a layer is compared with the layers above and below to find what must stay, or only with "
        "the one above (as in the paper).", group="Bricks")
    ceilings: Literal["cheaper", "corbels", "pillars", "free"] = setting(
        "cheaper", "What carries ceilings inside the model while it is built: walls that lean inwards, pillars, "
        "whichever takes fewer bricks, or nothing.", group="Bricks")
    open_bottom: bool = setting(
        False, "Leave the bottom of the model open.", group="Bricks")
    layout: Literal["fast", "standard", "exact"] = setting(
        "standard", "How much work goes into few and well bonded bricks: a quick choice, linear programmes, or the "
        "fewest bricks that can be found, which takes several times as long.", group="Bricks")

    goal: Literal["fewest", "cheapest"] = setting(
        "fewest", "Whether the layout has as few bricks as it can, or costs as little as it can by the price file.",
        group="Parts")
    prices: str = setting(
        "", "Price file: a CSV file with the columns part, colour and price, a price guide, or the inventory of a "
        "store as CSV or BrickLink's XML.", group="Parts", files=1)
    unpriced: Literal["estimate", "exclude"] = setting(
        "estimate", "What to do with parts that the price file does not have in a colour: use the median price of the "
        "part in other colours, or of its mass, or do not build with them.", group="Parts")
    owned: str = setting(
        "", "Inventories of parts that you own, separated by semicolons: lists of Rebrickable or BrickLink, CSV or "
        "XML.", group="Parts", files=2)
    owned_use: Literal["only", "first"] = setting(
        "only", "Whether to build with owned parts only, if need be in other colours, or to use them first and list "
        "what is missing.", group="Parts")
    few_lots: float = setting(
        0.0, "Largest colour difference (CIEDE2000) at which lots of one or two bricks take the colour of another lot "
        "of their part; 0 leaves all colours. Not together with owned parts.", group="Parts", low=0.0, high=100.0)
    mass_weight: float = setting(
        0.0, "How many bricks the layout may add to save one gram; 0 counts bricks alone.", group="Parts",
        low=0.0, high=10.0)

    learned: bool = setting(
        True, "Let the fast layout exchange bricks as a trained support vector machine proposes.",
        group="Learning")
    learned_from: str = setting(
        "", "Training file, as written by Learn from Models; empty for the built-in training.", group="Learning")

    supports: Literal["best", "tree", "columns", "beams", "none"] = setting(
        "best", "Temporary supports under overhangs while the model is built: the best of all kinds, trees, "
        "columns, beams on pillars, or none.", group="Supports")
    hanging: int = setting(
        3, "How many plates deep bricks may hang under others while the model is built; 0 puts a support under "
        "every brick.", group="Supports", low=0, high=30)
    split: int = setting(
        1, "Largest number of pieces to build separately and join, where that saves a fifth of the supports.",
        group="Supports", low=1, high=8)

    clutch: float = setting(
        0.7, "Pull in N that the friction of one contact point of a stud bears; new bricks bear 0.98, worn ones 0.7.",
        group="Check", low=0.05, high=5.0, was="hold")
    spare: float = setting(
        0.2, "Share of this pull to leave unused: plates are laid across joints that need more, and pillars kept where "
        "plates do not help.", group="Check", low=0.0, high=0.9)

    prove_steps: bool = setting(
        False, "Test by forces whether the model stands after every building step, with its supports; this takes "
        "several times as long as everything else.", group="Check")

    limit_size: int = setting(
        300, "Longest side in cm of a model that is built without asking; the command line refuses larger ones.",
        group="Limits", low=1, high=1_000_000)
    limit_bricks: int = setting(
        50_000, "Estimated number of bricks up to which a model is built without asking.", group="Limits",
        low=1, high=100_000_000)
    limit_memory: int = setting(
        6000, "Estimated memory in MB up to which a model is built without asking.", group="Limits",
        low=200, high=10_000_000)

    seed: int = setting(
        0, "Seed of all random numbers: the same seed gives the same model.", group="Run", low=0, high=2**31 - 1)
    # fmt: on

    def __post_init__(self) -> None:
        """Refuse values of a wrong type or out of range, and settings that exclude each other."""
        for entry in fields(self):
            _check(entry, getattr(self, entry.name))
        if self.open_bottom and not self.hollow:
            raise SettingsError(
                "open_bottom is on but hollow is off: a solid model has no open bottom; turn hollow on or "
                "open_bottom off."
            )
        if self.dithering != "none" and (self.one_to_one or self.cell_colour == "longest"):
            other = "one_to_one is on" if self.one_to_one else "cell_colour is 'longest'"
            raise SettingsError(
                f"dithering is {self.dithering!r} but {other}: they exclude each other; change one of them."
            )
        if self.hollow_rule == "upper" and not self.hollow:
            raise SettingsError("hollow_rule is 'upper' but hollow is off: turn hollow on, or set the rule to 'both'.")


def setting_type(entry: Field[Any]) -> Any:
    """Return the resolved type of a setting: bool, int, float, str or a Literal."""
    return _types()[entry.name]


@cache
def _types() -> dict[str, Any]:
    return get_type_hints(Settings)


def choices(entry: Field[Any]) -> tuple[str, ...]:
    """Return the allowed words of a setting; empty if it is not a choice of words."""
    return tuple(str(choice) for choice in get_args(setting_type(entry)))


def renamed(entry: Field[Any]) -> str:
    """Return the remark for a setting that was given by its earlier name."""
    return f"The setting {entry.metadata['was']} is now called {entry.name}: its value was used."


def _check(entry: Field[Any], value: Any) -> None:
    words = choices(entry)
    if words:
        if value not in words:
            raise SettingsError(f"{entry.name} is {value!r}: choose one of {', '.join(words)}.")
        return
    expected = setting_type(entry)
    if not isinstance(value, (int, float) if expected is float else expected) or (
        isinstance(value, bool) and expected is not bool
    ):
        raise SettingsError(f"{entry.name} is {value!r}: give it a value of type {expected.__name__}.")
    low, high = entry.metadata["low"], entry.metadata["high"]
    # the negated form also refuses not-a-number
    if low is not None and not low <= value <= high:
        raise SettingsError(f"{entry.name} is {value}: choose a value from {low} to {high}.")
