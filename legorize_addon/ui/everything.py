"""The folder with all that is known of a model: lists, LDraw files, report, booklet and maps, as a run writes it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import bpy
from bpy.app.translations import pgettext_rpt as rpt
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..core.model import Assembly, Role, load_catalogue
from ..core.progress import Progress, part
from ..scene import read_bricks, state_of, steps_of, title_for
from .current import current_build
from .export import chosen_path, title_of
from .instructions import PAPER_ITEMS, OnPaper, unfinished
from .parts import lists_of

if TYPE_CHECKING:
    from ..core.building import Steps
    from ..core.instructions import Title
    from ..core.model import Bricks
    from ..core.shopping import ShoppingList


@dataclass(frozen=True, slots=True, eq=False)
class FolderRequest:
    """A folder to write.

    Attributes
    ----------
    bricks : Bricks
        Model and supports.
    steps : Steps
        How they are built.
    lists : (ShoppingList, ShoppingList)
        What to buy for the model and for its supports.
    texts : mapping of str to str
        Files that were kept with the model.
    title : Title
        Name of the model.
    paper : str
        A key of the papers.
    notes : tuple of str
        What was said of the model when it was built.
    booklet, maps : bool
        Whether the booklet and the layer maps are written, too.
    folder : pathlib.Path
    """

    bricks: Bricks
    steps: Steps
    lists: tuple[ShoppingList, ShoppingList]
    texts: Mapping[str, str]
    title: Title
    paper: str
    notes: tuple[str, ...]
    booklet: bool
    maps: bool
    folder: Path

    def work(self, progress: Progress) -> tuple[Path]:
        """Write all files, or none; no Blender in here."""
        from ..core.files import new_folder, write_ldr, write_mpd
        from ..core.shopping import list_texts

        whole = Assembly(self.bricks, load_catalogue())
        finished = whole.take(self.bricks.role != Role.SUPPORT_OUTSIDE)
        texts = {
            "model.ldr": write_ldr(finished, name="model.ldr", title=self.title.text, follow="model.mpd"),
            "model.mpd": write_mpd(whole, self.steps, name="model.ldr", title=self.title.text),
            **list_texts(*self.lists),
            **self.texts,
        }
        with new_folder(self.folder, names=texts) as fresh:
            for name, text in texts.items():
                (fresh / name).parent.mkdir(exist_ok=True)
                (fresh / name).write_text(text, encoding="utf-8", newline="")
            self._draw(fresh, progress)
        return (self.folder,)

    def _draw(self, fresh: Path, progress: Progress) -> None:
        """Write what is printed."""
        from ..core.instructions import PAPERS, Booklet, layer_files, layer_pages

        temporary, catalogue, paper = self.bricks.role == Role.SUPPORT_OUTSIDE, load_catalogue(), PAPERS[self.paper]
        if self.maps:
            (fresh / "layers").mkdir()
            pages = layer_pages(
                self.bricks, catalogue, temporary=temporary, paper=paper, progress=part(progress, 0.0, 0.2)
            )
            for name, text in layer_files(pages):
                (fresh / "layers" / name).write_text(text, encoding="utf-8", newline="")
        if self.booklet:
            from ..core.unit_bricks import said_of_feet

            made = Booklet(
                self.bricks, catalogue, self.steps, temporary=temporary, title=self.title, paper=paper,
                remarks=said_of_feet(self.notes),
            )  # fmt: skip
            unfinished().write(made, fresh / "instructions.html", fresh / "instructions.pdf", part(progress, 0.2, 1.0))


class LEGORIZE_OT_export_folder(OnPaper, bpy.types.Operator):
    """Write all that is known of the build that the panel shows into a folder."""

    bl_idname = "legorize.export_folder"
    bl_label = "Export Everything"
    bl_description = (
        "Write the model as LDraw, all lists of parts, those of the supports, the building order, the report, the "
        "booklet and the layer maps into a folder"
    )
    bl_options = {"REGISTER"}
    suffix = " legorized"
    kept = ("filepath", "paper", "booklet", "maps")

    filepath: StringProperty(subtype="DIR_PATH")
    chosen: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    booklet: BoolProperty(name="Booklet", description="Write the booklet of the building steps, too", default=True)
    maps: BoolProperty(name="Layer Maps", description="Write a map of each layer, too", default=True)
    paper: EnumProperty(name="Paper", description="Size of the pages", items=PAPER_ITEMS)

    def _take_order(self, context: bpy.types.Context) -> FolderRequest:
        build = current_build(context.scene)
        return FolderRequest(
            bricks=read_bricks(build), steps=steps_of(build), lists=lists_of(build), texts=state_of(build).texts,
            title=title_for(title_of(build)), paper=self.paper, notes=tuple(state_of(build).notes),
            booklet=self.booklet, maps=self.maps, folder=chosen_path(self),
        )  # fmt: skip

    def _show(self, context: bpy.types.Context, order: FolderRequest, paths: tuple[Path, ...]) -> set[str]:
        if "report.json" not in order.texts:
            told = rpt("Built by an earlier version: its report is not known, build it again for that.")
            self.report({"WARNING"}, told)
        if order.booklet and order.title.lost:
            self.report({"WARNING"}, order.title.lost)
        return super()._show(context, order, paths)


register, unregister = bpy.utils.register_classes_factory((LEGORIZE_OT_export_folder,))
