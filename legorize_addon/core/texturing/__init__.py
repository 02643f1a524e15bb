"""Textures at the size of the model: what can be seen of them, how finely, and in which colours."""

from __future__ import annotations

from .box_means import box_means
from .cutouts import remarks_on_unseen, seen_part
from .features import with_features
from .reduced_images import reduce_images

__all__ = [
    "box_means",
    "reduce_images",
    "remarks_on_unseen",
    "seen_part",
    "with_features",
]
