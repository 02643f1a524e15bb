"""The parts of a build: a table to sort and to click on, and the lists that people and shops read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import bpy
from bpy.app.translations import pgettext_rpt as rpt
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    StringProperty,
)

from ..core.errors import BuildError
from ..core.model import Assembly, Colour, Part, Role, load_catalogue
from ..core.shopping import FORMATS, Lot, ShoppingList, priced, shopping_list
from ..scene import damage, read_bricks, steps_of
from ..view import can_highlight, hide_tint, highlight_step, show_lot, shown_lot
from .current import current_build
from .export import Exporting, chosen_path, title_of, written
from .working import OnBuild

if TYPE_CHECKING:
    from ..core.build import Finished

UNKNOWN: Final = -1.0
"""Price of a lot whose price nobody knows."""

ORDERS: Final[dict[str, Callable[[Any], Any]]] = {
    "part": lambda row: (row.name, row.code),
    "colour": lambda row: (row.colour_name, row.name),
    "count": lambda row: (-row.count, row.name),
    "price": lambda row: (-row.price * row.count if row.price >= 0 else 1.0, row.name),
}
"""What rows of the table are sorted by, each from its most useful end."""


def _show_lot(self: bpy.types.Collection, context: bpy.types.Context) -> None:
    if damage(self) or not 0 <= self.legorize_lot < len(self.legorize_lots):
        return
    row = self.legorize_lots[self.legorize_lot]
    hide_tint(self)
    if can_highlight(self):
        highlight_step(self, visible=False)
    show_lot(self, (row.number, row.code))


class LegorizeLot(bpy.types.PropertyGroup):
    """A row of the table of parts; its name is that of the part."""

    number: StringProperty()
    code: IntProperty()
    colour_name: StringProperty()
    rgb: FloatVectorProperty(subtype="COLOR_GAMMA", size=3, min=0.0, max=1.0)
    count: IntProperty()
    price: FloatProperty(default=UNKNOWN)


def list_parts(build: bpy.types.Collection, lots: Sequence[Lot]) -> None:
    """Keep the lots of a build with it, for the table."""
    build.legorize_lots.clear()
    for lot in lots:
        row = build.legorize_lots.add()
        row.name, row.number, row.code = lot.part.title, lot.part.number, lot.colour.code
        row.colour_name, row.count = lot.colour.name, lot.count
        row.rgb = [byte / 255 for byte in lot.colour.rgb]
        row.price = UNKNOWN if lot.price is None else lot.price


def list_parts_of(build: bpy.types.Collection, made: Finished) -> None:
    """Keep the lots of a model that was just made, with their prices if there are any."""
    from ..core.report import wanted_lists

    list_parts(build, wanted_lists(made, load_catalogue(), "")[0].lots)


def lists_of(build: bpy.types.Collection) -> tuple[ShoppingList, ShoppingList]:
    """Return what to buy for a build and for its supports, with the prices that the table has.

    Raises
    ------
    BuildError
        No brick is left.
    """
    bricks, catalogue, title = read_bricks(build), load_catalogue(), title_of(build)
    removed = bricks.role == Role.SUPPORT_OUTSIDE
    try:
        moves = len(steps_of(build).moves)
    except BuildError:
        # of an earlier version, or with deleted bricks
        moves = None
    model = shopping_list(Assembly(bricks.take(~removed), catalogue), title=title, moves=moves)
    supports = shopping_list(Assembly(bricks.take(removed), catalogue), title=f"{title}, supports", moves=0)
    one, other = (_priced(each, build) for each in (model, supports))
    return one, other


def _priced(wanted: ShoppingList, build: bpy.types.Collection) -> ShoppingList:
    prices = {(row.number, row.code): row.price for row in build.legorize_lots if row.price >= 0}

    def price(part: Part, colour: Colour) -> float | None:
        """Return what the table says."""
        return prices.get((part.number, colour.code))

    return replace(wanted, lots=priced(wanted.lots, price))


class LEGORIZE_UL_lots(bpy.types.UIList):
    """The table of parts: swatch, part, colour, count, price."""

    def draw_item(self, context: Any, layout: Any, data: Any, item: Any, icon: int, active: Any) -> None:
        """Draw a row."""
        row = layout.split(factor=0.1)
        row.prop(item, "rgb", text="")
        row = row.split(factor=0.42)
        row.label(text=item.name)
        row = row.split(factor=0.6)
        row.label(text=item.colour_name)
        row.label(text=f"{item.count}" + (f"   {item.price:.2f}" if item.price >= 0 else ""))

    def filter_items(self, context: bpy.types.Context, data: Any, name: str) -> tuple[list[int], list[int]]:
        """Return no filter, and the place of each row in the order that is chosen."""
        rows = getattr(data, name)
        shown = bpy.types.UI_UL_list.filter_items_by_name(self.filter_name, self.bitflag_filter_item, rows, "name")
        return shown, places(rows, data.legorize_lot_order)


def places(rows: Sequence[Any], order: str) -> list[int]:
    """Return the place of each row of the table if it is sorted."""
    ranked = sorted(range(len(rows)), key=lambda row: ORDERS[order](rows[row]))
    found = [0] * len(ranked)
    for place, row in enumerate(ranked):
        found[row] = place
    return found


class LEGORIZE_OT_show_all(OnBuild, bpy.types.Operator):
    """Show all bricks again."""

    bl_idname = "legorize.show_all_lots"
    bl_label = "Show All Bricks"
    bl_description = "Show all bricks in their own colours again, after a row of the table was chosen"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether some are hidden."""
        return super().poll(context) and shown_lot(current_build(context.scene)) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Show them."""
        return self.reported(self._show_all, current_build(context.scene))

    def _show_all(self, build: bpy.types.Collection) -> set[str]:
        show_lot(build, None)
        return {"FINISHED"}


class LEGORIZE_OT_list_parts(OnBuild, bpy.types.Operator):
    """Fill the table of parts of a build that has none, or whose bricks were changed."""

    bl_idname = "legorize.list_parts"
    bl_label = "List Parts"
    bl_description = "Count the parts of the model for the table"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Fill it."""
        return self.reported(self._list, current_build(context.scene))

    def _list(self, build: bpy.types.Collection) -> set[str]:
        list_parts(build, lists_of(build)[0].lots)
        return {"FINISHED"}


class LEGORIZE_OT_export_list(Exporting, bpy.types.Operator):
    """Write the parts of the build that the panel shows as a list."""

    bl_idname = "legorize.export_list"
    bl_label = "Export Parts List"
    bl_description = "Write what to buy as a list that people, shops or other programs read"
    bl_options = {"REGISTER"}
    filter_glob: StringProperty(default="*.csv;*.xml", options={"HIDDEN"})
    kind: EnumProperty(
        name="Format", description="Who reads the list", items=[(kind.key, kind.label, "") for kind in FORMATS]
    )
    of_supports: BoolProperty(
        name="Supports", description="List the temporary supports instead of the finished model", default=False
    )

    @property
    def filename_ext(self) -> str:
        """How the name of the file ends, by the format."""
        return Path(self._format.file).suffix

    @property
    def _format(self) -> Any:
        return next(each for each in FORMATS if each.key == self.kind)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Write the file."""
        return self.reported(self._write, current_build(context.scene))

    def _write(self, build: bpy.types.Collection) -> set[str]:
        from ..core.files import write_whole

        path, wanted = chosen_path(self), lists_of(build)[self.of_supports]
        if not self._format.has_any(wanted):
            what = "temporary supports" if self.of_supports else "parts that this shop has a number for"
            raise BuildError(f"There are no {what}: choose another list.")
        write_whole(path, self._format.text(wanted))
        self.report(*written(path, build))
        left = sum(lot.count for lot in self._format.left_out(wanted))
        if left:
            told = rpt("Bricks whose element number is not known are not in the list: {}.").format(left)
            self.report({"WARNING"}, told)
        return {"FINISHED"}


classes = (
    LegorizeLot,
    LEGORIZE_UL_lots,
    LEGORIZE_OT_show_all,
    LEGORIZE_OT_list_parts,
    LEGORIZE_OT_export_list,
)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register the classes, and hang the table on builds, which keep it in the file."""
    _register_classes()
    bpy.types.Collection.legorize_lots = CollectionProperty(type=LegorizeLot)
    bpy.types.Collection.legorize_lot = IntProperty(
        name="Lot", description="Click on a row to see its bricks through all others", update=_show_lot, default=-1
    )
    bpy.types.Collection.legorize_lot_order = EnumProperty(
        name="Sort by",
        description="What the rows of the table are sorted by",
        items=[(name, name.capitalize(), "") for name in ORDERS],
        default="count",
    )


def unregister() -> None:
    """Undo :func:`register`."""
    del bpy.types.Collection.legorize_lot_order
    del bpy.types.Collection.legorize_lot
    del bpy.types.Collection.legorize_lots
    _unregister_classes()
