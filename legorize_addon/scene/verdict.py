"""What the panel says about whether a model stands."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n

from ..core.arrays import Ints
from ..core.model import Assembly, Bricks, Role, Verdict, load_catalogue

if TYPE_CHECKING:
    from ..core.statics import Stability

ICONS: Final = {"stable": "CHECKMARK", "wedged": "ERROR", "collapses": "CANCEL", "undecided": "QUESTION"}
UNCHECKED: Final = n("Not checked: legorize the object again to check whether the model stands.")


def judged_rows(stability: Stability, bricks: Bricks) -> Ints:
    """Return the rows of the bricks that a proof is about: all, or those that are not taken out again."""
    if len(stability.margin) == len(bricks):
        return np.arange(len(bricks))
    return np.flatnonzero(bricks.role != Role.SUPPORT_OUTSIDE)


def check_of(stability: Stability, bricks: Bricks) -> dict[str, Any]:
    """Return what a build keeps of the proof, as plain values.

    Parameters
    ----------
    stability : Stability
        Verdict and margins.
    bricks : Bricks
        These bricks, maybe with supports that are taken out again.

    Returns
    -------
    dict
        ``verdict``, a word; ``sentence``; ``floating``, the number of bricks that
        hang in the air; of the weakest of the others ``weakest``, its row,
        ``name``, its colour and part, ``layer``, counted from 1, and ``left``,
        its margin.
    """
    from ..core.report import brick_name, layer_of

    rows = judged_rows(stability, bricks)
    standing = np.setdiff1d(np.arange(len(rows)), stability.unsupported)
    weakest = int(standing[stability.margin[standing].argmin()])
    left, weakest = float(stability.margin[weakest]), int(rows[weakest])
    return {
        "verdict": stability.verdict.value,
        "sentence": _sentence(stability, bricks.take(rows), left),
        "floating": len(stability.unsupported),
        "weakest": weakest,
        "name": brick_name(Assembly(bricks, load_catalogue()), weakest),
        "layer": layer_of(bricks, weakest),
        "left": left,
    }


def check_lines(check: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """Return the lines of the panel with the icon of each.

    Parameters
    ----------
    check : mapping, optional
        Made by :func:`check_of`; empty or None for a model that was not checked.

    Returns
    -------
    list of (str, str)
    """
    if not check:
        return [(UNCHECKED, "QUESTION")]
    lines = [(check["sentence"], ICONS[check["verdict"]])]
    if check["floating"]:
        lines.append((iface("Bricks that hang in the air: {}").format(check["floating"]), "ERROR"))
    # builds of earlier versions know the number alone
    name = check.get("name", iface("brick {}").format(check["weakest"]))
    weakest = iface("Weakest: {} in layer {}, {}").format(name, check["layer"], _left(check["left"]))
    return [*lines, (weakest, "BLANK1")]


def _sentence(stability: Stability, bricks: Bricks, left: float) -> str:
    if stability.standing is Verdict.UNDECIDED:
        return iface("Not decided: there is no proof that it stands, and none that it collapses")
    if stability.standing is Verdict.COLLAPSES:
        return iface("Collapses: proven, {}").format(_how(stability, bricks))
    proof = iface("proven, no brick needs more than {:.0f} % of its friction").format(100 - 100 * left)
    if len(stability.unsupported):
        return iface("Collapses: bricks hang in the air; the others stand: {}").format(proof)
    if stability.standing is Verdict.WEDGED:
        return iface("Stands only while neighbours press on each other: {}").format(proof)
    return iface("Stands by its studs alone: {}").format(proof)


def _how(stability: Stability, bricks: Bricks) -> str:
    if not len(stability.torn):
        return iface("it tips over")
    from ..core.report import brick_name, layer_of

    first = int(stability.torn[0].max())
    name = brick_name(Assembly(bricks, load_catalogue()), first)
    return iface("first at the {} in layer {}").format(name, layer_of(bricks, first))


def _left(margin: float) -> str:
    if margin < 0:
        return iface("short of {:.0f} % of its friction").format(-margin * 100)
    return iface("at least {:.0f} % of its friction left").format(margin * 100)
