"""Which parts a user owns, from lists of Rebrickable and BrickLink, added up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Ints
from ..errors import SettingsError
from ..model import Catalogue
from .amounts import amount
from .lots import lots
from .tables import column, read_table

_QUANTITIES: Final = ("quantity", "qty", "minqty", "qtyfilled", "count", "amount", "number", "pieces")


@dataclass(frozen=True, slots=True, eq=False)
class Owned:
    """How many of each part there are in each colour.

    Attributes
    ----------
    count : (n_parts, n_colours) int64 array
    others : int
        Parts of the files that are not in the catalogue, and so cannot be used.
    """

    count: Ints
    others: int


def read_owned(paths: Sequence[str], catalogue: Catalogue) -> Owned:
    """Read inventories and add them up.

    Parameters
    ----------
    paths : sequence of str
        CSV or XML files; the same file twice counts twice.
    catalogue : Catalogue

    Returns
    -------
    Owned

    Raises
    ------
    SettingsError
        A file cannot be read, has no column of parts, colours or quantities, or a quantity that is no whole number, or
        no file has any part of the catalogue.
    """
    count, others = np.zeros(catalogue.exists.shape, dtype=np.int64), 0
    for path in paths:
        rows = read_table(path, "owned")
        found = lots(rows, catalogue, path, "owned")
        name = column({key: "" for row in rows for key in row}, _QUANTITIES)
        if name is None:
            raise SettingsError(f"owned is {path!r}, which has no column for a quantity: name it quantity.")
        for line, row in enumerate(rows, 2):
            many = amount(row.get(name, ""))
            if many is None or not many.is_integer():
                raise SettingsError(
                    f"owned is {path!r}, which has {row.get(name, '')!r} for a quantity in row {line}: "
                    "give a whole number."
                )
            lot = found.of(row)
            if lot is None:
                others += int(many)
            else:
                count[lot] += int(many)
    if not count.any():
        files = " and ".join(map(repr, paths))
        raise SettingsError(
            f"owned is {files}, which has none of the {catalogue.used_for('model').sum()} parts that models are built "
            "of: give an inventory with plain bricks and plates."
        )
    return Owned(count, others)
