"""Mosaics of a photograph and a logo: how like they are from afar, and of how many parts.

The plain mosaic is what most programs make: the mean of the pixels' bytes on each
stud, the colour of the palette that is nearest by its bytes, a tile of one stud.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps

from legorize_addon.core.build import Mosaic
from legorize_addon.core.colours import chosen_palette
from legorize_addon.core.model import Catalogue, load_catalogue
from legorize_addon.core.mosaic import Goal, Picture, picture_of, seen_from_afar
from legorize_addon.core.pipeline import legorize_image
from legorize_addon.core.settings import Settings
from legorize_addon.core.texturing import box_means

from .clock import seconds
from .tables import Row, Table

PHOTOGRAPH: Final = Path(__file__).resolve().parents[2] / "assets" / "readme.png"

WAYS: Final = {
    "nearest": {},
    "texels": {"fine_texture": "texels"},
    "ordered": {"dithering": "ordered"},
    "diffusion": {"dithering": "diffusion"},
}
"""Settings of our mosaics."""

_PIXELS: Final = 960
"""Of the sides of the logo."""


def measure(images: Sequence[Path], *, widths: Sequence[int], kind: str) -> list[Table]:
    """Make mosaics.

    Parameters
    ----------
    images : sequence of Path
        Without any: a picture of the sample, a portrait made by code, and a logo.
    widths : sequence of int
        Studs along the longer side.
    kind : {"tiles", "plates", "bricks"}

    Returns
    -------
    list of Table
    """
    own = {"photograph": _opened(PHOTOGRAPH), "portrait": portrait(), "logo": logo()}
    given = {path.stem: _opened(path) for path in images} or own
    rows = [row for name, picture in given.items() for width in widths for row in _rows(name, picture, width, kind)]
    title = (
        f"Mosaics of {kind}: mean CIEDE2000 to the image, both blurred over a stud; parts with the base; met: one "
        "piece that lies, and every step can be built"
    )
    return [Table("mosaics", title, tuple(rows))]


def logo() -> Picture:
    """Return a drawing of plain colours with round and straight edges."""
    y, x = np.mgrid[:_PIXELS, :_PIXELS] / _PIXELS - 0.5
    rgb = np.full((_PIXELS, _PIXELS, 3), 255, dtype=np.uint8)
    rgb[np.hypot(x, y) < 0.46] = (25, 50, 90)
    rgb[np.hypot(x, y) < 0.40] = (244, 244, 244)
    rgb[(np.abs(x) < 0.06) & (np.abs(y) < 0.33) | (np.abs(y) < 0.06) & (np.abs(x) < 0.33)] = (180, 0, 0)
    for at_x, at_y, colour in (
        (-1, 1, (250, 200, 10)),
        (1, 1, (0, 133, 43)),
        (-1, -1, (214, 121, 35)),
        (1, -1, (68, 26, 145)),
    ):
        rgb[np.hypot(x - 0.18 * at_x, y - 0.18 * at_y) < 0.07] = colour
    return picture_of(rgb)


def portrait() -> Picture:
    """Return what a camera makes of a face: skin in soft light, hair, a blurred background, noise of its sensor."""
    rng = np.random.default_rng(0)
    y, x = np.mgrid[:_PIXELS, :_PIXELS] / _PIXELS * 2 - 1
    colour = np.array([90.0, 120, 110]) + (60 * y - 20 * x)[..., None] * [0.6, 0.9, 1.1]
    for _ in range(12):
        at = rng.uniform(-1, 1, 2)
        colour += (40 * np.exp(-30 * ((x - at[0]) ** 2 + (y - at[1]) ** 2)))[..., None] * rng.uniform(0, 1, 3)
    colour = _painted(colour, x / 0.75, (y + 0.95) / 0.42, [60, 62, 95], [15, 15, 25], edge=0.05)
    colour = _painted(colour, x / 0.50, (y - 0.14) / 0.62, [58, 38, 26], [26, 20, 14], edge=0.08)
    colour = _painted(colour, x / 0.17, (y + 0.52) / 0.28, [196, 140, 112], [40, 36, 34], edge=0.05)
    colour = _painted(colour, x / 0.38, (y - 0.02) / 0.50, [224, 172, 142], [44, 46, 44], edge=0.03)
    for side in (-1, 1):
        colour = _painted(colour, (x - 0.16 * side) / 0.09, (y - 0.1) / 0.035, [238, 232, 226], [10, 10, 10], edge=0.1)
        colour = _painted(colour, (x - 0.16 * side) / 0.035, (y - 0.1) / 0.035, [70, 50, 38], [10, 10, 10], edge=0.1)
        colour = _painted(colour, (x - 0.16 * side) / 0.12, (y - 0.2) / 0.018, [70, 46, 32], [10, 8, 6], edge=0.2)
        colour = _painted(colour, (x - 0.2 * side) / 0.12, (y + 0.14) / 0.1, [226, 150, 130], [20, 20, 18], edge=0.9)
    colour = _painted(colour, x / 0.055, (y + 0.08) / 0.1, [206, 146, 118], [30, 26, 22], edge=0.8)
    colour = _painted(colour, x / 0.13, (y + 0.27) / 0.035, [176, 84, 82], [30, 16, 16], edge=0.2)
    noisy = colour + rng.normal(0, 6, colour.shape) + rng.normal(0, 4, colour.shape[:2])[..., None]
    return picture_of(np.clip(np.rint(noisy), 0, 255).astype(np.uint8))


def _painted(
    colour: NDArray[np.float64],
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    own: Sequence[float],
    shade: Sequence[float],
    *,
    edge: float,
) -> NDArray[np.float64]:
    """Paint an ellipse, lit from the upper left, with a soft edge of a share of its radius."""
    share = np.clip((1 + edge - np.hypot(x, y)) / (2 * edge), 0, 1)[..., None]
    lit = np.asarray(own) + np.clip(y - x, -1.5, 1.5)[..., None] * np.asarray(shade) * 0.8
    painted: NDArray[np.float64] = colour * (1 - share) + lit * share
    return painted


def _opened(path: Path) -> Picture:
    with Image.open(path) as image:
        pixels = np.asarray(ImageOps.exif_transpose(image).convert("RGBA"))[::-1]
    return picture_of(pixels[..., :3], pixels[..., 3])


def _rows(name: str, picture: Picture, width: int, kind: str) -> Iterator[Row]:
    catalogue = load_catalogue()
    for way, options in WAYS.items():
        settings = Settings(width=width, mosaic=kind, **options)
        made: list[Mosaic] = []
        taken = seconds(lambda settings=settings, made=made: made.append(legorize_image(picture, settings)))
        [mosaic] = made
        if way == "nearest":
            plain = _plain(picture, mosaic.goal, catalogue)
            yield {
                "image": name, "studs": f"{mosaic.canvas.columns} x {mosaic.canvas.rows}", "way": "plain",
                "difference": seen_from_afar(mosaic.goal, plain, catalogue), "parts": plain.size, "cpu_s": None,
                "parts_across_seams": None, "met": None,
            }  # fmt: skip
        graph, found = mosaic.graph, mosaic.supports.walk
        whole = (graph.n_components, graph.collisions, graph.n_floating) == (1, 0, 0)
        base = mosaic.bricks.role == 1
        lower, upper = graph.pairs.T
        across = np.bincount(upper[base[lower]], minlength=len(base)) > 1
        yield {
            "image": name, "studs": f"{mosaic.canvas.columns} x {mosaic.canvas.rows}", "way": way,
            "difference": seen_from_afar(mosaic.goal, mosaic.colour, catalogue), "parts": len(mosaic.bricks),
            "cpu_s": taken, "parts_across_seams": int(across.sum()),
            "met": bool(whole and mosaic.stability.stands and found.buildable),
        }  # fmt: skip


def _plain(picture: Picture, goal: Goal, catalogue: Catalogue) -> NDArray[np.int16]:
    """Return the colours of a plain mosaic."""
    palette = chosen_palette("", catalogue)
    rgb = catalogue.rgb[np.searchsorted(catalogue.codes, palette)].astype(float)
    bytes_ = np.stack(
        [box_means(picture.rgb[..., channel].astype(float), goal.there.shape) for channel in range(3)], -1
    )
    return palette[((bytes_[:, :, None] - rgb) ** 2).sum(axis=-1).argmin(axis=-1)]
