"""The buttons that write the booklet and the layer maps, drawn in a worker thread."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import bpy
from bpy.app.translations import pgettext_rpt as rpt
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..core.model import Role, load_catalogue
from ..core.progress import Progress
from ..scene import hand_remark, read_bricks, state_of, steps_of, title_for
from .current import current_build
from .export import chosen_path, proposed_path, title_of
from .working import Browsing, OnBuild

if TYPE_CHECKING:
    from ..core.building import Steps
    from ..core.instructions import Title, Unfinished
    from ..core.model import Bricks

PAPER_ITEMS: Final = [("A4", "A4", "297 x 210 mm"), ("Letter", "Letter", "11 x 8.5 inches")]


@dataclass(frozen=True, slots=True, eq=False)
class BookletRequest:
    """A booklet to write.

    Attributes
    ----------
    bricks : Bricks
        Model and supports.
    steps : Steps
        How they are built.
    title : Title
        Name of the model.
    paper : str
        A key of the papers.
    path : pathlib.Path
        Of the HTML file; the PDF is written beside it.
    notes : tuple of str
        What was said of the model when it was built.
    """

    bricks: Bricks
    steps: Steps
    title: Title
    paper: str
    path: Path
    notes: tuple[str, ...] = ()

    @property
    def files(self) -> tuple[Path, Path]:
        """The two files."""
        return self.path.with_suffix(".html"), self.path.with_suffix(".pdf")

    def work(self, progress: Progress) -> tuple[Path, Path]:
        """Write both files, or none; no Blender in here."""
        from ..core.files import replacing
        from ..core.instructions import PAPERS, Booklet
        from ..core.unit_bricks import said_of_feet

        html, pdf = self.files
        supports = self.bricks.role == Role.SUPPORT_OUTSIDE
        catalogue, paper = load_catalogue(), PAPERS[self.paper]
        made = Booklet(
            self.bricks, catalogue, self.steps, temporary=supports, title=self.title, paper=paper,
            remarks=said_of_feet(self.notes),
        )  # fmt: skip
        with replacing(html) as new_html, replacing(pdf) as new_pdf:
            unfinished().write(made, new_html, new_pdf, progress)
        return html, pdf


@cache
def unfinished() -> Unfinished:
    """Return what keeps the pages of a booklet that was stopped, until Blender is closed or another one is written."""
    from ..core.instructions import Unfinished

    return Unfinished()


@dataclass(frozen=True, slots=True, eq=False)
class MapsRequest:
    """Layer maps to write.

    Attributes
    ----------
    bricks : Bricks
        Model and supports.
    paper : str
        A key of the papers.
    actual_size : bool
        Whether they are in the size of the bricks.
    folder : pathlib.Path
        For the files.
    """

    bricks: Bricks
    paper: str
    actual_size: bool
    folder: Path

    def work(self, progress: Progress) -> tuple[Path]:
        """Write all files, or none; no Blender in here."""
        from ..core.files import new_folder
        from ..core.instructions import PAPERS, layer_files, layer_pages

        supports = self.bricks.role == Role.SUPPORT_OUTSIDE
        pages = layer_pages(
            self.bricks, load_catalogue(), temporary=supports, paper=PAPERS[self.paper], actual_size=self.actual_size,
            progress=progress,
        )  # fmt: skip
        with new_folder(self.folder) as fresh:
            for name, text in layer_files(pages, PAPERS[self.paper]):
                (fresh / name).write_text(text, encoding="utf-8", newline="")
        return (self.folder,)


class OnPaper(OnBuild, Browsing):
    """What is drawn of the build that the panel shows, into a file that is asked for first.

    Attributes
    ----------
    suffix : str
        Of the name that is proposed.
    """

    suffix = ""
    _timer = None

    def propose(self, context: bpy.types.Context) -> None:
        """Name the file like the model, beside the scene's own."""
        self.filepath = proposed_path(title_of(current_build(context.scene)), self.suffix)

    def _show(self, context: bpy.types.Context, order: Any, paths: tuple[Path, ...]) -> set[str]:
        self.report({"INFO"}, rpt("Wrote {}.").format(", ".join(map(str, paths))))
        build = current_build(context.scene)
        if build and (remark := hand_remark(build)):
            self.report({"WARNING"}, remark)
        return {"FINISHED"}


class LEGORIZE_OT_booklet(OnPaper, bpy.types.Operator):
    """Write the booklet of the build that the panel shows."""

    bl_idname = "legorize.booklet"
    bl_label = "Write Booklet"
    bl_description = (
        "Write building instructions: parts, a picture of each step, layer maps, as a PDF and as an HTML file with a "
        "page in three dimensions"
    )
    bl_options = {"REGISTER"}
    suffix = ".html"
    kept = ("filepath", "paper")

    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.html", options={"HIDDEN"})
    chosen: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    paper: EnumProperty(name="Paper", description="Size of the pages", items=PAPER_ITEMS)

    def _take_order(self, context: bpy.types.Context) -> BookletRequest:
        build = current_build(context.scene)
        title, notes = title_for(title_of(build)), tuple(state_of(build).notes)
        return BookletRequest(read_bricks(build), steps_of(build), title, self.paper, chosen_path(self), notes)

    def _show(self, context: bpy.types.Context, order: BookletRequest, paths: tuple[Path, ...]) -> set[str]:
        if order.title.lost:
            self.report({"WARNING"}, order.title.lost)
        return super()._show(context, order, paths)


class LEGORIZE_OT_layer_maps(OnPaper, bpy.types.Operator):
    """Write the layer maps of the build that the panel shows."""

    bl_idname = "legorize.layer_maps"
    bl_label = "Write Layer Maps"
    bl_description = "Write a map of each layer into a folder: its bricks in colour, on what lies below"
    bl_options = {"REGISTER"}
    suffix = " layers"
    kept = ("filepath", "paper", "actual_size")

    filepath: StringProperty(subtype="FILE_PATH")
    chosen: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    paper: EnumProperty(name="Paper", description="Size of the pages", items=PAPER_ITEMS)
    actual_size: BoolProperty(
        name="Actual size", description="Draw in the size of the bricks, to lay these on the prints", default=False
    )

    def _take_order(self, context: bpy.types.Context) -> MapsRequest:
        bricks = read_bricks(current_build(context.scene))
        return MapsRequest(bricks, self.paper, self.actual_size, chosen_path(self))


classes = (LEGORIZE_OT_booklet, LEGORIZE_OT_layer_maps)
register, unregister = bpy.utils.register_classes_factory(classes)
