"""The booklet: its pages, and the two files that show them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from ..arrays import Mask
from ..building import Steps
from ..model import Bricks, Catalogue
from ..progress import Progress, part, silent
from .canvas import Page
from .front_pages import cover, how_to_read, last_page, parts_pages
from .html import html_file
from .layer_maps import map_pages
from .lots import rgb_of
from .panels import Panels, submodel_names
from .paper import Paper
from .pdf import Document
from .shades import tint_for
from .step_pages import step_pages
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
    title : str
        Name of the model.
    paper : Paper
    """

    def __init__(
        self, bricks: Bricks, catalogue: Catalogue, steps: Steps, *, temporary: Mask, title: str, paper: Paper
    ) -> None:
        self._tint = tint_for(rgb_of(bricks.take(~temporary), catalogue))
        self._bricks, self._catalogue, self._steps = bricks, catalogue, steps
        self._temporary, self._title, self._paper = temporary, title, paper

    def pages(self, progress: Progress = silent) -> Iterator[Page]:
        """Draw the pages: cover, signs, parts, steps, layer maps, finished model.

        Parameters
        ----------
        progress : Progress

        Yields
        ------
        Page
        """
        paper, temporary = self._paper, self._temporary
        panels = Panels(self._bricks, self._catalogue, self._steps, temporary, self._tint)
        count = 0
        for page in (cover(panels, self._title, paper), how_to_read(panels, paper, 2), *parts_pages(panels, paper, 3)):
            yield page
            count += 1
        for page in step_pages(panels, paper, count + 1, part(progress, 0.0, 0.85)):
            yield page
            count += 1
        last = part(progress, 0.85, 1.0)
        yield from map_pages(
            self._bricks, self._catalogue, temporary=temporary, paper=paper, first=count + 1, progress=last
        )
        yield last_page(panels, self._title, paper)

    def write(self, html: Path | None, pdf: Path | None, progress: Progress = silent) -> None:
        """Write the booklet, drawing every page once.

        Parameters
        ----------
        html, pdf : pathlib.Path or None
            Files to write; what is None is left out.
        progress : Progress
        """
        document = Document(self._title)

        def shown() -> Iterator[Page]:
            for page in self.pages(progress):
                if pdf is not None:
                    document.add(page)
                yield page

        if html is None:
            for _ in shown():
                pass
        else:
            with html.open("w", encoding="utf-8", newline="") as file:
                file.writelines(html_file(shown(), self._title, self._viewer, len(self._steps)))
        if pdf is not None:
            pdf.write_bytes(document.data())

    def _viewer(self, pages: Mapping[int, int]) -> str:
        return viewer_data(
            self._bricks, self._catalogue, self._steps,
            temporary=self._temporary, tint=self._tint, names=submodel_names(self._steps), pages=pages,
        )  # fmt: skip
