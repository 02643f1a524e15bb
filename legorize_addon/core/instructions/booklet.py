"""The booklet: its pages, and the two files that show them."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from ..arrays import Mask
from ..building import Steps
from ..model import Bricks, Catalogue
from ..progress import Progress, part, silent
from .canvas import Page
from .front_pages import cover, how_to_read, last_page, parts_pages
from .html import html_file
from .layer_maps import map_pages
from .lettering import Title
from .lots import rgb_of
from .panels import Panels, submodel_names
from .paper import Paper
from .pdf import Document, content_of
from .shades import tint_for
from .step_pages import largest_picture, step_pages
from .svg import svg
from .viewer import viewer_data


class Booklet:
    """The booklet of a model.

    Parameters
    ----------
    bricks : Bricks
        Model and supports, n rows.
    catalogue : Catalogue
    steps : Steps
        How they are built.
    temporary : (n,) bool array
        Bricks that are taken out again.
    title : str or Title
        Name of the model; a text is drawn in the fonts of PDF readers.
    paper : Paper
    remarks : sequence of str
        What else a builder should know.
    """

    def __init__(
        self,
        bricks: Bricks,
        catalogue: Catalogue,
        steps: Steps,
        *,
        temporary: Mask,
        title: str | Title,
        paper: Paper,
        remarks: Sequence[str] = (),
    ) -> None:
        self._tint = tint_for(rgb_of(bricks.take(~temporary), catalogue))
        self._bricks, self._catalogue, self._steps = bricks, catalogue, steps
        self._temporary, self._paper, self._remarks = temporary, paper, tuple(remarks)
        self._title = Title(title) if isinstance(title, str) else title
        self._wanted, self._done = (False, False), list[_Drawn]()

    @property
    def fingerprint(self) -> str:
        """The same for booklets of the same pages."""
        bricks, moves, title = self._bricks, self._steps.moves, self._title
        shape = () if title.outlines is None else (title.outlines.points,)
        tables = [getattr(table, name) for table in (bricks, moves) for name in table.__slots__]
        submodels = [(each.number, each.kind, each.parent, each.piece, each.like) for each in self._steps.submodels]
        rows = [each.rows for each in self._steps.submodels]
        half = () if bricks.half is None else (bricks.half,)
        arrays = [np.ascontiguousarray(each) for each in (*tables, *half, *rows, self._temporary, *shape)]
        found = hashlib.sha256(
            repr((title.text, self._paper, self._remarks, submodels, [each.shape for each in arrays])).encode()
        )
        for each in arrays:
            found.update(each.tobytes())
        return found.hexdigest()

    def pages(self, progress: Progress = silent, *, skip: int = 0) -> Iterator[Page]:
        """Draw the pages: cover, signs, parts, steps, layer maps, finished model.

        Parameters
        ----------
        progress : Progress
        skip : int
            Pages from the first one on that are not drawn.

        Yields
        ------
        Page
        """
        paper, temporary, panels = self._paper, self._temporary, self._panels
        yield from self._front[skip:]
        count = len(self._front)
        for page in step_pages(panels, paper, count + 1, part(progress, 0.0, 0.85), skip=skip - count):
            count += 1
            if page is not None:
                yield page
        yield from map_pages(
            self._bricks, self._catalogue, temporary=temporary, paper=paper, first=count + 1, skip=max(skip - count, 0),
            progress=part(progress, 0.85, 1.0),
        )  # fmt: skip
        yield last_page(panels, self._title, paper)

    @cached_property
    def _panels(self) -> Panels:
        room = largest_picture(self._paper)
        return Panels(self._bricks, self._catalogue, self._steps, self._temporary, self._tint, room)

    @cached_property
    def _front(self) -> list[Page]:
        """The pages before the steps, which are few."""
        panels, paper = self._panels, self._paper
        return [
            cover(panels, self._title, paper),
            how_to_read(panels, paper, 2, self._remarks),
            *parts_pages(panels, paper, 3),
        ]

    def write(self, html: Path | None, pdf: Path | None, progress: Progress = silent) -> None:
        """Write the booklet, drawing every page once.

        If `progress` stops it, the pages so far are kept: called again, it goes on with the next one.

        Parameters
        ----------
        html, pdf : pathlib.Path or None
            Files to write; what is None is left out.
        progress : Progress
        """
        wanted = (html is not None, pdf is not None)
        if wanted != self._wanted:
            self._wanted, self._done = wanted, []
        document = Document(self._title.text)

        def shown() -> Iterator[tuple[Page, str]]:
            """Yield the pages for the web, and put each into the other document on the way."""
            for each in self._all(progress):
                if pdf is not None:
                    document.add(each.page, each.pdf)
                yield each.page, each.svg

        if html is None:
            for _ in shown():
                pass
        else:
            with html.open("w", encoding="utf-8", newline="") as file:
                file.writelines(html_file(shown(), self._title.text, self._viewer, len(self._steps)))
        if pdf is not None:
            pdf.write_bytes(document.data())
        self._done = []

    def _all(self, progress: Progress) -> Iterator[_Drawn]:
        """Yield all pages as they are drawn; those that were before are kept."""
        yield from self._done
        in_html, in_pdf = self._wanted
        for page in self.pages(progress, skip=len(self._done)):
            text = svg(page, name=f"p{len(self._done)}-") if in_html else ""
            drawn = _Drawn(replace(page, items=()), text, content_of(page) if in_pdf else b"")
            self._done.append(drawn)
            yield drawn

    def _viewer(self, pages: Mapping[int, int]) -> str:
        return viewer_data(
            self._bricks, self._catalogue, self._steps,
            temporary=self._temporary, tint=self._tint, names=submodel_names(self._steps), pages=pages,
        )  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class _Drawn:
    """A page as it is written, without its items."""

    page: Page
    svg: str
    pdf: bytes


class Unfinished:
    """The booklet that was begun last and stopped: the same one, asked for again, goes on where it was."""

    def __init__(self) -> None:
        self._kept: Booklet | None = None

    def write(self, booklet: Booklet, html: Path | None, pdf: Path | None, progress: Progress = silent) -> None:
        """Write a booklet, see :meth:`Booklet.write`; if it was stopped before, its first pages are there."""
        if self._kept is None or self._kept.fingerprint != booklet.fingerprint:
            self._kept = booklet
        self._kept.write(html, pdf, progress)
        self._kept = None
