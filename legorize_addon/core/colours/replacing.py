"""Brick colours that a user replaces by others."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ..errors import SettingsError
from ..model import Catalogue


def replacements(text: str, catalogue: Catalogue) -> dict[int, int]:
    """Return which colours are replaced by which.

    Parameters
    ----------
    text : str
        As ``"Tan = Dark Tan, 4 = 15"``: names or LDraw codes; of two that are about the same colour the later one
        counts.
    catalogue : Catalogue

    Returns
    -------
    dict of int to int
        LDraw codes; empty for an empty text.

    Raises
    ------
    SettingsError
        A pair or a colour cannot be understood.
    """
    known = {colour.name.lower(): colour.code for colour in catalogue.colours}
    known |= {str(colour.code): colour.code for colour in catalogue.colours}
    found = {}
    for pair in filter(None, map(str.strip, re.split("[,;]", text))):
        names = [" ".join(name.lower().split()) for name in pair.split("=")]
        if len(names) != 2:
            raise SettingsError(
                f"replace_colours has {pair!r}: write two colours with = between them, as Tan=Dark Tan."
            )
        for name in names:
            if name not in known:
                raise SettingsError(
                    f"replace_colours names {name!r}, which is no colour made today: use its name, such as Dark Tan, "
                    "or its LDraw code."
                )
        found[known[names[0]]] = known[names[1]]
    return found


def replaced(codes: NDArray[np.int16], pairs: Mapping[int, int]) -> NDArray[np.int16]:
    """Return LDraw codes with some of them replaced, all at once: two colours can change places."""
    made = codes.copy()
    for one, other in pairs.items():
        made[codes == one] = other
    return made


def replacements_text(pairs: Mapping[int, int], catalogue: Catalogue) -> str:
    """Return the setting for some replacements, by the names of the colours."""
    names = {colour.code: colour.name for colour in catalogue.colours}
    return ", ".join(f"{names[one]} = {names[other]}" for one, other in pairs.items() if one != other)
