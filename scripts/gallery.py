"""Build models of the five kinds that the paper shows, our way and the paper's, and take their pictures.

::

    blender -b -P scripts/gallery.py -- OUT [--kind KIND ...] [--width STUDS] [--resolution PIXELS]
    python scripts/gallery.py OUT ...        where Blender is installed as the module bpy

OUT gets a picture of each kind built by default and as published, of the fox
with each kind of support, of the off-road vehicle cut open both ways,
``gallery.csv`` with what each takes, and, if all kinds were asked for,
``kinds.jpg``: all pictures on one sheet. The models are made on the spot, see
``research/five_kinds.py``.
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

import bpy  # noqa: E402 - after the path, as what follows
import numpy as np  # noqa: E402

from legorize_addon.core.build import Build  # noqa: E402
from legorize_addon.core.measures.lower_bound import lower_bound  # noqa: E402
from legorize_addon.core.model.bricks import SUPPORTS, Role  # noqa: E402
from legorize_addon.core.model.catalogue import load_catalogue  # noqa: E402
from legorize_addon.core.pipeline import legorize  # noqa: E402
from legorize_addon.core.presets import preset_values  # noqa: E402
from legorize_addon.core.report.mesh_facts import hollow_ratio  # noqa: E402
from legorize_addon.core.settings import Settings  # noqa: E402
from legorize_addon.reading.quiet import quiet  # noqa: E402
from legorize_addon.render.still import render_still  # noqa: E402
from legorize_addon.scene.collections import clear_build  # noqa: E402
from legorize_addon.scene.model import Source  # noqa: E402
from legorize_addon.scene.section import Section  # noqa: E402
from legorize_addon.view.show_result import show_result  # noqa: E402
from legorize_addon.view.visibility import cut_away, roles_shown, show_role  # noqa: E402
from scripts.research.five_kinds import KINDS  # noqa: E402

SAMPLES: Final = 16
"""Light paths a pixel: pictures for a page, not for print."""

OWN: Final[dict[str, dict[str, Any]]] = {"relief": {"backing": 2}}
"""Settings of a kind that are not the default: a relief is held together from behind."""


SHEET: Final = (
    ("character default", "character as published", "off_road default", "off_road as published", "fox tree"),
    ("relief default", "relief as published", "off_road cut open", "off_road as published cut open", "fox columns"),
    ("tiger default", "tiger as published", "fox default", "fox as published", "fox beams"),
)
"""Rows of the sheet: the way of the paper to the right of the default, supports at the end."""

QUALITY: Final = 90
"""Of the sheet as JPEG."""


class Shot(NamedTuple):
    """A picture to take.

    Attributes
    ----------
    kind, way : str
        What is built, and how it is called.
    settings : dict
        That differ from the default.
    supports : bool
        Whether the temporary supports are shown.
    cut : bool
        Whether it is cut open along its length.
    """

    kind: str
    way: str
    settings: dict[str, Any]
    supports: bool = False
    cut: bool = False


def shots(kinds: Sequence[str]) -> Iterator[Shot]:
    """Yield the pictures of some kinds."""
    for kind in kinds:
        own = OWN.get(kind, {})
        yield Shot(kind, "default", own)
        yield Shot(kind, "as published", preset_values("paper"))
        if kind == "off_road":
            yield Shot(kind, "cut open", own, cut=True)
            yield Shot(kind, "as published cut open", preset_values("paper"), cut=True)
        if kind == "fox":
            yield from (
                Shot(kind, way, {"supports": way, "hanging": 0}, supports=True) for way in ("tree", "columns", "beams")
            )


def main(arguments: Sequence[str]) -> int:
    """Take all pictures and return the exit status."""
    options = parser().parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    rows = []
    for shot in shots(options.kind or list(KINDS)):
        settings = Settings(**{"width": options.width, **shot.settings})
        build = legorize(KINDS[shot.kind](), settings)
        rows.append(row(shot, build))
        print(", ".join(f"{name} {value}" for name, value in rows[-1].items()), flush=True)
        take(build, shot, picture(options.out, f"{shot.kind} {shot.way}"), options.resolution)
    if not options.kind:
        put_together(options.out)
    with (options.out / "gallery.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return 0


def row(shot: Shot, build: Build) -> dict[str, Any]:
    """Return what a model takes."""
    catalogue = load_catalogue()
    stays = sum(build.bricks.role == role for role in SUPPORTS).sum()
    removed = build.supports.removed
    return {
        "kind": shot.kind,
        "way": shot.way,
        "bricks": len(build.bricks),
        "bound": lower_bound(build.hollow, catalogue),
        "mass_g": round(float(build.assembly.mass.sum()), 1),
        "hollow_ratio": round(hollow_ratio(build), 3),
        "supports_out": len(removed),
        "supports_out_g": round(float(catalogue.mass[removed.part].sum()), 1),
        "supports_stay": int(stays),
        "components": build.graph.n_components,
        "floating": build.graph.n_floating,
        "verdict": build.stability.verdict.value,
        "cpu_s": round(sum(build.timings.values()), 2),
    }


def take(build: Build, shot: Shot, path: Path, resolution: int) -> None:
    """Render a model."""
    scene = bpy.context.scene
    shown = show_result(scene, build, Source(shot.kind), mm_per_unit=10.0)
    if shot.supports and Role.SUPPORT_OUTSIDE in roles_shown(shown):
        show_role(shown, Role.SUPPORT_OUTSIDE, visible=True)
    if shot.cut:
        cut_away(shown, Section(axis="x", at=0.5))
    size = (resolution, resolution * 3 // 4)
    with quiet():
        render_still(scene, path, samples=SAMPLES, resolution=size, view="section" if shot.cut else "front_right")
    clear_build(scene, shown)


def picture(folder: Path, name: str) -> Path:
    """Return the file of a picture."""
    return folder / f"{name.replace(' ', '_')}.png"


def put_together(folder: Path) -> Path:
    """Write all pictures of a folder, in half their size, as one sheet; return its file."""
    rows = [np.concatenate([_halved(picture(folder, name)) for name in names], axis=1) for names in SHEET]
    # the rows of Blender's images come from below
    pixels = np.concatenate(rows[::-1])
    sheet = bpy.data.images.new("sheet", pixels.shape[1], pixels.shape[0])
    sheet.pixels.foreach_set(pixels.ravel())
    sheet.filepath_raw, sheet.file_format = str(folder / "kinds.jpg"), "JPEG"
    sheet.save(quality=QUALITY)
    bpy.data.images.remove(sheet)
    return folder / "kinds.jpg"


def _halved(path: Path) -> np.ndarray:
    """Return the pixels (height, width, 4) of a picture, each the mean of four."""
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    whole: np.ndarray = pixels.reshape(height // 2, 2, width // 2, 2, 4).mean(axis=(1, 3))
    return whole


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    made = argparse.ArgumentParser(prog="gallery.py", description="Build and render the five kinds of the paper.")
    made.add_argument("out", metavar="OUT", type=Path, help="folder for the pictures")
    made.add_argument("--kind", choices=tuple(KINDS), action="append", help="only this one; can be given several times")
    made.add_argument("--width", type=int, default=32, help="studs along the longer side (default: %(default)s)")
    made.add_argument("--resolution", type=int, default=480, help="width of the pictures (default: %(default)s)")
    return made


if __name__ == "__main__":
    start = sys.argv.index("--") + 1 if "--" in sys.argv else 1
    sys.exit(main(sys.argv[start:]))
