"""Greedy with penalties: large bricks that lie across the seams of the layer below and not upon them.

References
----------
The penalty functions of the field (R. Gower et al. 1998, P. Petrovic 2001, after
J. W. Kim, K. K. Kang and J. H. Lee, "Survey on automated LEGO assembly
construction", WSCG 2014): few bricks, bonds over seams, and no seam on a seam.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from scripts.research.rules import Index, by_key
from scripts.research.seams import Layer

BRIDGE: Final = 0.25
COINCIDE: Final = 0.25
"""What bridging a seam gains and continuing one loses, in studs."""

_SCALE: Final = 1000


def staggered(layer: Layer, rng: np.random.Generator) -> Index:
    """Lay a layer, the least penalty first.

    Parameters
    ----------
    layer : Layer
    rng : numpy.random.Generator
        Decides between equals.

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements.
    """
    n = len(layer.cells)
    bridges = np.array([each.bit_count() for each in layer.bridged])
    coincide = np.array([len(each) for each in layer.rim])
    gain = layer.problem.placements.size + BRIDGE * bridges - COINCIDE * coincide
    keys = np.rint(_SCALE * gain).astype(np.int64) * n + rng.permutation(n)
    return by_key(lambda *_: keys)(layer.problem, rng)
