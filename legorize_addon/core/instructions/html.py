"""The booklet as one HTML file: all pages, and a page in three dimensions, without anything from elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from html import escape
from pathlib import Path
from typing import Final

from .canvas import Page

_HERE: Final = Path(__file__).parent

_VIEWER: Final = """<section id="viewer" aria-label="Model in three dimensions">
<canvas></canvas>
<div class="bar"><button data-do="back">Back</button><input type="range" min="1" value="1" aria-label="Step">
<button data-do="next">Next</button><button data-do="play">Play</button><button data-do="page">Show page</button></div>
<div class="bar"><output></output><label><input type="checkbox" checked> what was there before is pale</label></div>
<p>Drag to turn, Shift-drag or two fingers to move, wheel or pinch to zoom, double click to look from the front again;
arrow keys go from step to step.</p>
</section>
"""

_LINKS: Final = ("Parts", "Step 1", "Layer maps", "Finished")
"""Pages with an entry of their own in the bar on top."""


def html_file(
    pages: Iterable[tuple[Page, str]], title: str, viewer: Callable[[Mapping[int, int]], str], n_steps: int
) -> Iterator[str]:
    """Write the booklet as HTML, piece by piece, so that it need not be kept.

    Parameters
    ----------
    pages : iterable of (Page, str)
        Each page, and how it is drawn as SVG: its items are not looked at.
    title : str
        Name of the model.
    viewer : callable
        Returns the data of the page in three dimensions for the first step on the page of each step.
    n_steps : int

    Yields
    ------
    str
        Which one after the other are the file.
    """
    yield _head(title)
    firsts: list[int] = []
    for number, (page, drawn) in enumerate(pages):
        anchor = f"step-{page.step + 1}" if page.step is not None else _anchor(page.title) or f"page-{number + 1}"
        size = f"contain-intrinsic-size:auto {1120 * page.height / page.width:.0f}px"
        yield f'<section class="page" id="{anchor}" style="{size}">'
        yield f"{drawn}</section>\n"
        if number == 0:
            yield _VIEWER
        if page.step is not None:
            firsts.append(page.step)
    shown = {step: max(first for first in firsts if first <= step) for step in range(n_steps)} if firsts else {}
    # a closing tag inside of a name would end the script
    yield f'<script type="application/json" id="bricks">{viewer(shown).replace("<", chr(92) + "u003c")}</script>\n'
    yield f"<script>{_text('viewer.js')}</script>\n</body>\n</html>\n"


def _anchor(title: str) -> str:
    return title.lower().replace(" ", "-") if title in _LINKS else ""


def _head(title: str) -> str:
    name = escape(title)
    links = "".join(f'<a href="#{link.lower().replace(" ", "-")}">{link.removesuffix(" 1")}</a>' for link in _LINKS)
    links = links.replace(">Step<", ">Steps<")
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<title>{name}: building instructions</title>\n"
        f'<meta name="viewport" content="width=device-width, initial-scale=1">\n<style>{_text("booklet.css")}</style>\n'
        f'</head>\n<body>\n<header><b>{name}</b><a href="#viewer">3D</a>{links}</header>\n'
    )


def _text(name: str) -> str:
    return (_HERE / name).read_text(encoding="utf-8")
