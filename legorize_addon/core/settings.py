"""Every setting, once.

The name, type, default, limits, texts and panel group of a setting are in one
place: its field here. Range checks, Blender's property group, the sidebar and the
flags of the command line are all generated from these fields. The order of the
fields is the order in the panel, whose groups are what one sees.
"""

from __future__ import annotations

from dataclasses import Field, dataclass, fields
from functools import cache
from typing import Any, Literal, get_type_hints

from .exclusions import refuse_excluding
from .setting import check_value, setting


@dataclass(frozen=True, kw_only=True, slots=True)
class Settings:
    """What a user can choose. Wrong values are refused with one sentence."""

    # fmt: off
    size_by: Literal["width", "height", "scale", "cm", "parts", "budget"] = setting(
        "width", "Size by", "What sets the size of the model.", group="Size", words={
            "width": "studs along the longer horizontal side", "height": "bricks from bottom to top",
            "scale": "a factor on the object's own size", "cm": "the longest side in cm",
            "parts": "the largest model of so many parts", "budget": "the largest model for a price"})
    width: int = setting(
        48, "Width (studs)", "Studs along the longer horizontal side; of a mosaic with its border.", group="Size",
        limits=(1, 1000), needs=("size_by", "width"))
    height: int = setting(
        40, "Height (bricks)", "Height of the model in bricks.", group="Size", limits=(1, 1000),
        needs=("size_by", "height"))
    scale: float = setting(
        10.0, "Scale", "Scale factor: 10 keeps the object's own size, 5 halves it.", group="Size", limits=(1e-4, 1e6),
        needs=("size_by", "scale"))
    cm: float = setting(
        38.4, "Size (cm)", "Longest side of the model; of a mosaic with its border.", group="Size",
        limits=(0.8, 800.0), needs=("size_by", "cm"))
    parts: int = setting(
        1000, "Parts at most", "Largest number of parts: the model becomes as large as it can, which takes several "
        "builds; temporary supports do not count.", group="Size", limits=(1, 1_000_000), needs=("size_by", "parts"))
    budget: float = setting(
        50.0, "Price at most", "Largest price of the model and its supports, in the currency of the price file: the "
        "model becomes as large as it can, which takes several builds.", group="Size", limits=(0.01, 1e6),
        needs=("size_by", "budget"))
    up: Literal["auto", "x", "y", "z"] = setting(
        "auto", "Up axis", "Axis of the object that points up.", group="Size", words={
            "auto": "as the object stands in Blender; for files that do not say (.obj, .ply, .stl), decided by shape",
            "x": "the x axis", "y": "the y axis", "z": "the z axis"})

    palette: str = setting(
        "", "Palette", "LDraw codes of the colours to use, separated by commas or spaces; empty for all that are made "
        "today.", group="Colours")
    replace_colours: str = setting(
        "", "Replace colours", "Brick colours of models of meshes to replace by others, by names or LDraw codes, such "
        "as Tan = Dark Tan, 4 = 15; empty for none.", group="Colours")
    colours: int = setting(
        256, "Dominant colours", "Largest number of dominant colours to find in the textures; similar ones become one "
        "brick colour.", group="Colours", limits=(1, 256))
    sampling: Literal["surface", "image"] = setting(
        "surface", "Count texels", "How texels count when dominant colours are found.", group="Colours", words={
            "surface": "by the surface that they cover", "image": "every texel of the image counts once"})
    one_to_one: bool = setting(
        False, "One to one", "Give each dominant colour a brick colour of its own.", group="Colours")
    cell_colour: Literal["likeness", "longest"] = setting(
        "likeness", "Colour of a brick", "Which colour a brick takes.", group="Colours", words={
            "likeness": "the one closest to all of its surface",
            "longest": "the one with the greatest length of trajectory in it"})
    keep_specks: bool = setting(
        False, "Keep specks", "Keep the colour of single bricks that hardly differs from those around, or that their "
        "surface does not have: mixtures at the borders of patches.", group="Colours",
        needs=("cell_colour", "likeness"))
    fine_texture: Literal["mean", "texels"] = setting(
        "mean", "Fine textures", "What to do with textures that change within a stud, such as checkers and noise.",
        group="Colours", words={
            "mean": "their mean, as seen from afar", "texels": "the colour that wins on each brick"})
    dithering: Literal["none", "ordered", "diffusion"] = setting(
        "none", "Dithering", "How to show shades that no brick has.", group="Colours", words={
            "none": "each brick in the closest colour", "ordered": "colours mixed in a fixed pattern",
            "diffusion": "each brick's error is passed on to the next ones, for flat pictures and reliefs"})
    least_alpha: float = setting(
        0.5, "Least alpha", "Smallest alpha of a surface that is built: glass and the clear parts of leaves and decals "
        "are left out; 0 builds everything.", group="Colours", limits=(0.0, 1.0))

    plates: Literal["none", "pays", "all"] = setting(
        "pays", "Plates", "Where to use plates instead of bricks.", group="Shape", words={
            "none": "nowhere", "pays": "where they pay", "all": "wherever the surface cuts through a brick"})
    surface: Literal["studs", "tiles", "slopes"] = setting(
        "studs", "Surface", "What the surface is made of.", group="Shape", words={
            "studs": "bricks and plates alone", "tiles": "tiles as well, where studs would show on top",
            "slopes": "tiles, and slopes where they come closer to the shape"})
    tops: Literal["studs", "smooth", "all"] = setting(
        "smooth", "Tops", "Which studs on top become tiles; those that hold something always stay.", group="Shape",
        words={"studs": "none", "smooth": "those of whole plates, and others where a few parts more hide many",
               "all": "all that can be seen, however many parts that takes"}, needs=("surface", "tiles", "slopes"))
    slope_price: float = setting(
        1.0, "Price of slopes", "Volume that slopes, or half studs, must save for each part that they add, in "
        "studs a plate high.", group="Shape", limits=(0.0, 10.0), needs=("surface", "slopes"), also="half_studs")
    plate_gain: float = setting(
        0.2, "Gain of plates", "Error that plates must save to pay, as a share of a brick's volume or of a clear "
        "colour difference on its faces.", group="Shape", limits=(0.0, 1.0), needs=("plates", "pays"))
    fewer_parts: float = setting(
        0.3, "Fewer parts", "Error, measured as in Gain of plates, to accept for one part less: neighbours then share "
        "plates and colours; 0 lets every column decide by itself.", group="Shape", limits=(0.0, 2.0),
        needs=("plates", "pays"))
    layer_difference: float = setting(
        0.1, "Layer difference", "Share by which trajectories of neighbouring layers may differ in length or area "
        "before these layers are sliced plate by plate.", group="Shape", limits=(0.0, 1.0), needs=("plates", "pays"))
    cusp: float = setting(
        3.2, "Cusp height (mm)", "Largest cusp height with one slice per brick; a smaller value gives three slices "
        "more often.", group="Shape", limits=(0.1, 9.6))
    chord_deviation: float = setting(
        0.0, "Chord deviation (mm)", "Largest distance between a simplified trajectory and the cut of the mesh.",
        group="Shape", limits=(0.0, 4.0))
    keep_thin: bool = setting(
        True, "Keep thin parts", "Keep legs, ears and walls that cover less than half a stud.", group="Shape")
    weight: str = setting(
        "", "Weight", "Vertex group, or attribute of points, that says where likeness counts more, as on eyes and "
        "letters: from 0, as elsewhere, to 1; empty for none.", group="Shape")
    features: Literal["none", "colours", "shapes", "all"] = setting(
        "none", "Features", "What counts more by itself, as if it were painted with a weight.", group="Shape", words={
            "none": "nothing", "colours": "small patterns such as eyes, letters and logos",
            "shapes": "edges and thin parts such as horns, ears and beaks",
            "all": "small patterns, edges and thin parts"})
    emphasis: float = setting(
        3.0, "Emphasis", "How much more than elsewhere likeness counts where the weight is 1: with 3, four times as "
        "much.", group="Shape", limits=(0.0, 100.0), needs=("weight",), also="features")
    symmetric: bool = setting(
        True, "Symmetric", "Centre the grid on the model, so that a symmetric object becomes a symmetric model.",
        group="Shape")
    grid_fit: Literal["none", "shifts", "sizes"] = setting(
        "none", "Fit of the grid", "Where the grid of studs lies over the model.", group="Shape", words={
            "none": "in its middle, or as in the paper", "shifts": "where it fits best, by quarters of a stud and of a "
            "plate; a symmetric model stays so", "sizes": "the same, also of a size up to 3 % smaller or larger if it "
            "is set in studs, bricks or cm"})
    half_studs: bool = setting(
        False, "Half studs", "Shift parts such as a head or a tail by half a stud, on jumper plates, where that comes "
        "closer to the shape: it must save as much for each part as slopes.", group="Shape")
    superposition: Literal["median", "middle"] = setting(
        "median", "Ends of plates", "Where a brick ends if its three plates end at different places.", group="Shape",
        words={"median": "between the two others, which keeps its volume",
               "middle": "where the middle plate does, whatever its neighbours do"},
        needs=("plates", "pays"))
    critical_angle: float = setting(
        45.0, "Critical angle (degrees)", "Largest slope from the vertical that bricks carry by themselves; wider "
        "steps get offset bricks in their own colours.", group="Shape", limits=(1.0, 89.0))
    backing: int = setting(
        0, "Backing (layers)", "Layers or rows of bricks that hold a flat picture or relief together from behind.",
        group="Shape", limits=(0, 16))

    hollow: bool = setting(
        True, "Hollow", "Leave the inside empty.", group="Inside")
    shell: int = setting(
        1, "Shell (studs)", "Thickness of the shell; one more stud inwards may be used.", group="Inside",
        limits=(1, 100), needs=("hollow",))
    hollow_rule: Literal["both", "upper"] = setting(
        "both", "Compare with", "Which layers a layer is compared with to find what must stay.", group="Inside",
        words={"both": "those above and below", "upper": "only the one above"}, needs=("hollow",))
    ceilings: Literal["cheaper", "corbels", "pillars", "free"] = setting(
        "cheaper", "Ceilings", "What carries ceilings inside the model while it is built.", group="Inside", words={
            "cheaper": "walls or pillars, whichever takes fewer bricks", "corbels": "walls that lean inwards",
            "pillars": "pillars", "free": "nothing"}, needs=("hollow",))
    open_bottom: bool = setting(
        False, "Open bottom", "Leave the bottom of the model open.", group="Inside", needs=("hollow",))

    layout: Literal["fast", "standard", "exact", "learned"] = setting(
        "standard", "Layout", "How much work goes into few and well bonded bricks.", group="Bricks", words={
            "fast": "a quick choice", "standard": "linear programmes",
            "exact": "the fewest bricks that can be found, which takes several times as long",
            "learned": "a trained machine chooses every brick, layer by layer, as in the paper"})
    learned: bool = setting(
        True, "Use learning", "Let the fast layout try only those exchanges of bricks that a trained support vector "
        "machine proposes.", group="Bricks", needs=("layout", "fast"))
    learned_from: str = setting(
        "", "Training file", "Training file of the layout, as written by Learn from Models; empty for the built-in "
        "training.", group="Bricks", needs=("layout", "fast", "learned"))
    mass_weight: float = setting(
        0.0, "Bricks per gram", "How many bricks the layout may add to save one gram; 0 counts bricks alone.",
        group="Bricks", limits=(0.0, 10.0))
    seed: int = setting(
        0, "Seed", "Seed of all random numbers: the same seed gives the same model.", group="Bricks",
        limits=(0, 2**31 - 1))

    goal: Literal["fewest", "cheapest"] = setting(
        "fewest", "Goal", "What the layout aims at.", group="Parts", words={
            "fewest": "as few bricks as it can", "cheapest": "as low a price as it can, by the price file"},
        needs=("prices",))
    prices: str = setting(
        "", "Price file", "Price file: a CSV file with the columns part, colour and price, a price guide, or the "
        "inventory of a store as CSV or BrickLink's XML.", group="Parts", files=1)
    unpriced: Literal["estimate", "exclude"] = setting(
        "estimate", "Without price", "What to do with parts that the price file does not have in a colour.",
        group="Parts", words={
            "estimate": "take the median price of the part in other colours, or of its mass",
            "exclude": "do not build with them"}, needs=("prices",))
    owned: str = setting(
        "", "Owned parts", "Inventories of parts that you own, separated by semicolons: lists of Rebrickable or "
        "BrickLink, CSV or XML.", group="Parts", files=2)
    owned_use: Literal["only", "first"] = setting(
        "only", "Use owned parts", "How to use the parts that you own.", group="Parts", words={
            "only": "nothing else, if need be in other colours", "first": "first, and list what is missing"},
        needs=("owned",))
    few_lots: float = setting(
        0.0, "Few lots (CIEDE2000)", "Largest colour difference at which lots of one or two bricks take the colour of "
        "another lot of their part; where no colour is close they become other parts of the model; 0 leaves all lots. "
        "Not together with owned parts.", group="Parts",
        limits=(0.0, 100.0))

    supports: Literal["best", "tree", "columns", "beams", "none"] = setting(
        "best", "Supports", "Temporary supports under overhangs while the model is built.", group="Supports", words={
            "best": "the best of all kinds", "tree": "trees", "columns": "columns", "beams": "beams on pillars",
            "none": "none"})
    support_parts: Literal["all", "paper"] = setting(
        "all", "Parts of supports", "What supports are made of.", group="Supports", words={
            "all": "all bricks and plates",
            "paper": "the eleven bricks of the paper and long ones under wide undersides, single plates where these "
            "do not reach"}, needs=("supports", "best", "tree", "columns", "beams"))
    feet: bool = setting(
        True, "Feet", "Put feet at the ground on both sides of walls and posts that would fall over at a touch; they "
        "stay.", group="Supports")
    hanging: int = setting(
        3, "Hanging (plates)", "How many plates deep bricks may hang under others while the model is built; 0 puts a "
        "support under every brick.", group="Supports", limits=(0, 30))
    split: int = setting(
        1, "Pieces at most", "Largest number of pieces to build separately and join, where that saves a fifth of the "
        "supports.", group="Supports", limits=(1, 8))

    clutch: float = setting(
        0.7, "Clutch (N)", "Pull that the friction of one contact point of a stud bears; new bricks bear 0.98, worn "
        "ones 0.7.", group="Strength", limits=(0.05, 5.0), was="hold")
    spare: float = setting(
        0.2, "Spare", "Share of this pull to leave unused: plates are laid across joints that need more, and pillars "
        "kept where plates do not help.", group="Strength", limits=(0.0, 0.9))
    strengthen: bool = setting(
        True, "Strengthen", "Lay plates across weak joints and add pillars until the model stands with that share to "
        "spare; without it the report only says whether it stands.", group="Strength")
    prove_steps: bool = setting(
        False, "Prove steps", "Test by forces whether the model stands after every building step, with its supports; "
        "this takes several times as long as everything else.", group="Strength")

    mosaic: Literal["tiles", "plates", "bricks"] = setting(
        "tiles", "Made of", "What a mosaic of an image is made of.", group="Mosaic", words={
            "tiles": "smooth tiles", "plates": "plates", "bricks": "bricks"})
    standing: bool = setting(
        False, "Standing", "Build a mosaic as a wall of bricks that stands, two studs deep, instead of one that lies "
        "on a base.", group="Mosaic")
    mosaic_base: Literal["auto", "baseplates", "plates"] = setting(
        "auto", "Base", "What a mosaic lies on.", group="Mosaic", words={
            "auto": "baseplates where they fit exactly, else large plates",
            "baseplates": "baseplates of 16, 32 or 48 studs", "plates": "large plates of any size"})
    base_colour: int = setting(
        71, "Base colour", "LDraw code of the base's colour.", group="Mosaic", limits=(0, 32767))
    border: int = setting(
        0, "Border (studs)", "Width of a border around a mosaic.", group="Mosaic", limits=(0, 100))
    border_colour: int = setting(
        0, "Border colour", "LDraw code of the border's colour.", group="Mosaic", limits=(0, 32767),
        needs=("border",))
    background: int = setting(
        -1, "Background", "LDraw code of the colour behind the clear parts of an image; -1 leaves the base bare there.",
        group="Mosaic", limits=(-1, 32767))

    limit_size: int = setting(
        300, "Size (cm)", "Longest side of a model that is built without asking; the command line refuses larger "
        "ones.", group="Limits", limits=(1, 1_000_000))
    limit_bricks: int = setting(
        50_000, "Bricks", "Estimated number of bricks up to which a model is built without asking.", group="Limits",
        limits=(1, 100_000_000))
    limit_memory: int = setting(
        6000, "Memory (MB)", "Estimated memory up to which a model is built without asking.", group="Limits",
        limits=(200, 10_000_000))
    # fmt: on

    def __post_init__(self) -> None:
        """Refuse values of a wrong type or out of range, and settings that exclude each other."""
        for entry in fields(self):
            check_value(entry, setting_type(entry), getattr(self, entry.name))
        refuse_excluding(self)

    @property
    def smooth(self) -> bool:
        """Whether there may be tiles on top, which are as high as plates."""
        return self.surface != "studs" and self.tops != "studs" and self.plates != "none"

    @property
    def supported(self) -> bool:
        """Whether there may be supports at all."""
        return self.supports != "none"


def setting_type(entry: Field[Any]) -> Any:
    """Return the resolved type of a setting: bool, int, float, str or a Literal."""
    return _types()[entry.name]


@cache
def _types() -> dict[str, Any]:
    return get_type_hints(Settings)


def choices(entry: Field[Any]) -> tuple[str, ...]:
    """Return the allowed words of a setting; empty if it is not a choice of words."""
    return tuple(entry.metadata["words"])


def has_effect(entry: Field[Any], values: Any) -> bool:
    """Tell whether other settings let a setting have an effect.

    Parameters
    ----------
    entry : Field
        The setting.
    values : Settings or object with the same attributes
        All settings.
    """
    if not entry.metadata["needs"]:
        return True
    name, *words = entry.metadata["needs"]
    value, also = getattr(values, name), entry.metadata["also"]
    switched = bool(also) and getattr(values, also) not in (False, "none")
    return (value in words if words else bool(value)) or switched
