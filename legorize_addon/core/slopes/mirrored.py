"""Slopes of symmetric models: each one with its mirror image, or neither."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Ints, Mask
from .candidates import Candidates, rows
from .forms import Form
from .site import Site


def in_pairs(site: Site, among: tuple[Form, ...], found: Candidates, axis: int) -> tuple[Candidates, Ints]:
    """Let candidates and their mirror images be chosen together.

    Parameters
    ----------
    site : Site
    among : tuple of Form
        In all their turns.
    found : Candidates
        By ascending form, then place.
    axis : int
        2 for x or 1 for y, along which the model is mirrored in its middle.

    Returns
    -------
    found : Candidates
        Those that do not get in the way of their images, each as good as both are on average. One without an image is
        left out, unless the shape is another one there.
    pair : (n,) int64 array
        The same number for a candidate and its image.
    """
    there, image = _images(site, among, found, axis)
    keep = np.where(there, _apart(site, among, found, axis), _differs(site, among, found, axis))
    score = np.where(there, (found.score + found.score[image]) / 2, found.score)
    pair = np.where(there, np.minimum(image, np.arange(len(image))), np.arange(len(image)))
    return replace(found, score=score).take(keep), pair[keep]


def _images(site: Site, among: tuple[Form, ...], found: Candidates, axis: int) -> tuple[Mask, Ints]:
    """Return which candidates have an image among them, and its row."""
    known = {(form.part, form.turn): row for row, form in enumerate(among)}
    # the other one of a pair of wedge plates may be forbidden
    form = np.array([known.get(each.images[2 - axis], -1) for each in among])[found.form]
    reach = np.array([each.cells[:, axis].max() for each in among])[found.form]
    place = _flipped(site, found.place, axis) - reach * _step(site, axis)
    size = int(np.prod(site.shape))
    keys, wanted = found.form * size + found.place, form * size + place
    row = np.minimum(np.searchsorted(keys, wanted), max(len(keys) - 1, 0))
    return (keys[row] == wanted) & (form >= 0), row


def _apart(site: Site, among: tuple[Form, ...], found: Candidates, axis: int) -> Mask:
    """Return which candidates do not get in the way of their images; those that are their own do not."""
    apart = np.ones(len(found.form), bool)
    for which, claimed, kept in rows(site, among, found):
        image = _flipped(site, claimed, axis)
        own = (np.sort(image, axis=1) == np.sort(claimed, axis=1)).all(axis=1)
        meets = (image[:, :, None] == np.concatenate([claimed, kept], axis=1)[:, None]).any(axis=(1, 2))
        apart[which] = own | ~meets
    return apart


def _differs(site: Site, among: tuple[Form, ...], found: Candidates, axis: int) -> Mask:
    """Return which candidates lie where the shape is not its own image."""
    same = np.ones(len(site.solid), bool)
    for cells in (site.solid, site.required):
        same &= cells == np.flip(cells.reshape(site.shape), axis).reshape(-1)
    differs = np.zeros(len(found.form), bool)
    for which, claimed, kept in rows(site, among, found):
        differs[which] = ~(same[claimed].all(axis=1) & same[kept].all(axis=1))
    return differs


def _flipped(site: Site, cells: Ints, axis: int) -> Ints:
    """Return the images of flat cells."""
    step = _step(site, axis)
    along = cells // step % site.shape[axis]
    images: Ints = cells + (site.shape[axis] - 1 - 2 * along) * step
    return images


def _step(site: Site, axis: int) -> int:
    """Return how far neighbours along an axis are from each other among the flattened cells."""
    return site.shape[2] if axis == 1 else 1
