"""The formats of lists: a new one is a row here and a function in :mod:`.writers`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from . import writers
from .lots import Lot
from .shopping_list import ShoppingList


@dataclass(frozen=True, slots=True)
class ListFormat:
    """A kind of list.

    Attributes
    ----------
    key : str
        Name in programs and on the command line.
    label : str
        Name for people.
    file : str
        Usual name of the file.
    text : callable
        Returns the text for a :class:`~.shopping_list.ShoppingList`.
    lists : callable
        Whether the format can list a lot.
    """

    key: str
    label: str
    file: str
    text: Callable[[ShoppingList], str]
    lists: Callable[[Lot], bool] = writers.any_lot

    def left_out(self, wanted: ShoppingList) -> tuple[Lot, ...]:
        """Return the lots that the format cannot list, to be bought elsewhere."""
        return tuple(lot for lot in wanted.lots if not self.lists(lot))

    def has_any(self, wanted: ShoppingList) -> bool:
        """Tell whether there is anything to list."""
        return any(map(self.lists, wanted.lots))


FORMATS: Final = (
    ListFormat("plain", "Table (CSV)", "parts.csv", writers.plain_csv),
    ListFormat("bricklink", "BrickLink Wanted List", "bricklink.xml", writers.bricklink_xml),
    ListFormat("rebrickable", "Rebrickable", "rebrickable.csv", writers.rebrickable_csv),
    ListFormat("pick-a-brick", "LEGO Pick a Brick", "pick-a-brick.csv", writers.pick_a_brick_csv, writers.has_element),
    ListFormat("studio", "BrickLink Studio", "studio.csv", writers.studio_csv),
    ListFormat("totals", "Size, Weight and Time", "totals.csv", writers.totals_csv),
)


def list_texts(model: ShoppingList, supports: ShoppingList) -> dict[str, str]:
    """Return all lists of a model and of what is taken out of it again, by the names of their files.

    Supports have lists of their own, ``support-parts.csv`` and so on. A list
    that would have nothing in it is left out.
    """
    return {
        f"{prefix}{kind.file}": kind.text(wanted)
        for prefix, wanted in (("", model), ("support-", supports))
        for kind in FORMATS
        if kind.has_any(wanted)
    }
