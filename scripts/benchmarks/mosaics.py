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
        Without any: a picture of the sample, and a logo.
    widths : sequence of int
        Studs along the longer side.
    kind : {"tiles", "plates", "bricks"}

    Returns
    -------
    list of Table
    """
    given = {path.stem: _opened(path) for path in images} or {"photograph": _opened(PHOTOGRAPH), "logo": logo()}
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
