"""Which edits by hand a model no longer has, in sentences and in figures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from ..edits import Outcome
from ..model import Catalogue

SHOWN: Final = 12
"""Edits that have a sentence of their own; the report has all of them."""


def remarks_on_edits(outcomes: Sequence[Outcome], catalogue: Catalogue) -> tuple[str, ...]:
    """Say which edits no longer fit, where and why.

    Parameters
    ----------
    outcomes : sequence of Outcome
        Of all edits.
    catalogue : Catalogue

    Returns
    -------
    tuple of str
        A sentence each, and one on how many more there are; none if all of them hold.
    """
    lost = [each.sentence(catalogue) for each in outcomes if each.reason]
    if len(lost) <= SHOWN:
        return tuple(lost)
    return (*lost[:SHOWN], f"{len(lost) - SHOWN} more edits no longer fit: see edits in report.json.")


def edit_facts(outcomes: Sequence[Outcome], catalogue: Catalogue) -> dict[str, Any]:
    """Return how many edits there are, and what does not hold of them.

    Parameters
    ----------
    outcomes : sequence of Outcome
        Of all edits.
    catalogue : Catalogue

    Returns
    -------
    dict
        ``made``, their number; ``unfitting``, a list of objects with ``edit``, its number from 1, ``what`` and
        ``reason``.
    """
    return {
        "made": sum(not each.reason for each in outcomes),
        "unfitting": [
            {"edit": number, "what": each.edit.told(catalogue), "reason": each.reason}
            for number, each in enumerate(outcomes, start=1)
            if each.reason
        ],
    }
