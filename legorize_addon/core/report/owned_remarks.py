"""What a model takes from the owned parts, in sentences."""

from __future__ import annotations

import numpy as np

from ..model import Assembly
from ..stock import Owned


def remarks_on_owned(owned: Owned | None, everything: Assembly) -> tuple[str, ...]:
    """Say how many bricks are owned, and how many are missing.

    Parameters
    ----------
    owned : Owned or None
        None if no inventory was given.
    everything : Assembly
        The model and its supports.

    Returns
    -------
    tuple of str
        One or two sentences, none without an inventory.
    """
    if owned is None:
        return ()
    bricks, catalogue = everything.bricks, everything.catalogue
    used = np.zeros(owned.count.shape, dtype=np.int64)
    np.add.at(used, (bricks.part, catalogue.colour_rows(bricks.colour)), 1)
    missing = np.maximum(used - owned.count, 0)
    told = f"Of the {len(bricks)} bricks of the model and its supports "
    if not missing.any():
        sentences = [f"{told}all are owned."]
    else:
        sentences = [
            f"{told}{len(bricks) - missing.sum()} are owned; {missing.sum()} of {np.count_nonzero(missing)} lots are "
            "missing."
        ]
    if owned.others:
        sentences.append(f"{owned.others} of the owned parts are no plain bricks or plates, and were not used.")
    return tuple(sentences)
