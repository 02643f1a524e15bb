"""Dominant colours of the textures, and the brick colours that stand for them.

References
----------
Paper, Algorithm 1 (k-means over the texels, every texel takes its nearest
centre); G. Sharma, W. Wu and E. N. Dalal, "The CIEDE2000 color-difference
formula", Color Research and Application 30(1), 2005.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from ..arrays import Floats, Mask
from ..errors import SettingsError
from ..mesh import TriangleMesh
from ..model import Catalogue
from .brick_difference import brick_differences
from .counted import Counted, count_colours, packed, unpacked
from .difference import lab_from_srgb
from .replacing import replaced
from .texels import border_table, boxes_varied, texel_at, texels_at

_SAMPLES: Final = 30_000
"""Texels sampled for the clustering; more change the centres by less than a byte."""

_ITERATIONS: Final = 20

Bytes = NDArray[np.uint8]
Codes = NDArray[np.int16]


@dataclass(frozen=True, slots=True, eq=False)
class SurfaceColours:
    """The brick colour of every texel.

    Attributes
    ----------
    centres : (m, 3) uint8 array
        Dominant colours, sRGB.
    codes : (m,) int16 array
        LDraw code of the brick colour that stands for each dominant colour.
    labels : tuple of (h, w) uint8 arrays
        Dominant colour of every texel, one array an image; row 0 is v = 0.
    borders : tuple of (h + 1, w + 1) int32 arrays
        Summed-area tables of the texels whose brick colour differs from that of
        the texel to the right or above, before a user replaced any.
    clamp : (n_images,) bool array
        Whether coordinates outside an image take its edge texel; else it repeats.
    nearest : (m,) int16 array, optional
        What stood for each dominant colour before a user replaced brick colours.
    """

    centres: Bytes
    codes: Codes
    labels: tuple[Bytes, ...]
    borders: tuple[NDArray[np.int32], ...]
    clamp: Mask
    nearest: Codes | None = None

    def replaced(self, pairs: Mapping[int, int]) -> SurfaceColours:
        """Return the same with some brick colours replaced by others, LDraw codes by LDraw codes."""
        if not pairs:
            return self
        return replace(self, codes=replaced(self.codes, pairs), nearest=self.codes)

    def at(self, image: NDArray[np.integer], uv: Floats) -> Codes:
        """Return the brick colours at points of the images.

        Parameters
        ----------
        image : (k,) int array
            Image of each point.
        uv : (k, 2) float64 array
            Image coordinates.

        Returns
        -------
        (k,) int16 array
            LDraw codes.
        """
        found = np.zeros(len(image), dtype=np.int16)
        for row, labels in enumerate(self.labels):
            here = np.flatnonzero(image == row)
            column, line = texel_at(uv.take(here, axis=0), labels.shape, clamp=bool(self.clamp[row]))
            found[here] = self.codes[labels[line, column]]
        return found

    def varied(self, image: NDArray[np.integer], low: Floats, high: Floats) -> Mask:
        """Return whether boxes of an image may hold more than one brick colour.

        Parameters
        ----------
        image : (k,) int array
        low, high : (k, 2) float64 arrays
            Corners of the boxes in image coordinates.

        Returns
        -------
        (k,) bool array
            False only where one colour fills the box; boxes across the rim of an
            image that repeats count as varied unless the image has one colour.
        """
        found = np.zeros(len(image), dtype=bool)
        for row, table in enumerate(self.borders):
            if table[-1, -1] == 0:
                continue
            here = np.flatnonzero(image == row)
            boxes = low.take(here, axis=0), high.take(here, axis=0)
            found[here] = boxes_varied(table, *boxes, clamp=bool(self.clamp[row]))
        return found

    def of_faces(self, mesh: TriangleMesh) -> Codes:
        """Return the one brick colour of each face, -1 where it may have several, shape (n_f,)."""
        a, b, c = np.moveaxis(mesh.uvs, 1, 0)
        varied = self.varied(mesh.face_image, np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c))
        return np.where(varied, np.int16(-1), self.at(mesh.face_image, (a + b + c) / 3))

    def image(self, row: int) -> Bytes:
        """Return an image with every texel replaced by its brick's dominant colour, (h, w, 3) uint8."""
        return self.centres[self.labels[row]]


@dataclass(frozen=True, slots=True, eq=False)
class Dominant:
    """The dominant colours of a mesh's images, before there are bricks' colours for them.

    Attributes
    ----------
    centres : (m, 3) uint8 array
        sRGB.
    labels : tuple of (h, w) uint8 arrays
        Dominant colour of every texel, one array an image; row 0 is v = 0.
    clamp : (n_images,) bool array
        Whether coordinates outside an image take its edge texel; else it repeats.
    """

    centres: Bytes
    labels: tuple[Bytes, ...]
    clamp: Mask

    def as_bricks(self, catalogue: Catalogue, *, palette: Codes, one_to_one: bool) -> SurfaceColours:
        """Find the bricks' colours for them, see :func:`brick_colours`."""
        codes = brick_colours(self.centres, catalogue, palette=palette, one_to_one=one_to_one)
        borders = tuple(border_table(codes[image]) for image in self.labels)
        return SurfaceColours(self.centres, codes, self.labels, borders, self.clamp)


def surface_colours(
    mesh: TriangleMesh,
    catalogue: Catalogue,
    *,
    n_colours: int,
    palette: Codes,
    one_to_one: bool,
    rng: np.random.Generator,
    texels: Counted | None = None,
) -> SurfaceColours:
    """Find the dominant colours of a mesh's images and the bricks' colours for them.

    Parameters
    ----------
    mesh : TriangleMesh
    catalogue : Catalogue
    n_colours : int
        Largest number of dominant colours.
    palette : (k,) int16 array
        LDraw codes to choose from.
    one_to_one : bool
        Give every dominant colour a brick colour of its own.
    rng : numpy.random.Generator
    texels : Counted, optional
        The texels that count; without them those of the mesh's images, each by
        the surface that it covers.

    Returns
    -------
    SurfaceColours

    Raises
    ------
    SettingsError
        If a one-to-one choice has fewer brick colours than dominant colours.

    References
    ----------
    Paper, Algorithm 1.
    """
    found = image_colours(mesh, n_colours=n_colours, rng=rng, texels=texels)
    return found.as_bricks(catalogue, palette=palette, one_to_one=one_to_one)


def image_colours(
    mesh: TriangleMesh, *, n_colours: int, rng: np.random.Generator, texels: Counted | None = None
) -> Dominant:
    """Find the dominant colours of a mesh's images, with the parameters of :func:`surface_colours`."""
    counted = count_colours(_surface_texels(mesh, rng)) if texels is None else texels
    centres = dominant_colours(counted, n_colours=n_colours, rng=rng)
    return Dominant(centres, _nearest_centres(mesh.images, centres), mesh.image_clamp)


def dominant_colours(counted: Counted, *, n_colours: int, rng: np.random.Generator) -> Bytes:
    """Return at most ``n_colours`` dominant colours of some texels.

    Parameters
    ----------
    counted : Counted
        The texels.
    n_colours : int
    rng : numpy.random.Generator

    Returns
    -------
    (m, 3) uint8 array
        Sorted; the texels' own colours where there are no more than asked for.

    References
    ----------
    Paper, Algorithm 1, line 1.
    """
    if len(counted.counts) <= n_colours:
        return _rounded(counted)
    # loading it takes longer than building a small model, and plain colours do not need it
    from sklearn.cluster import KMeans

    found = KMeans(n_clusters=n_colours, n_init=1, max_iter=_ITERATIONS, random_state=int(rng.integers(2**31))).fit(
        counted.means, sample_weight=counted.counts
    )
    # the means anew: sums of whole numbers are exact, in whatever order the threads add
    columns = [np.bincount(found.labels_, column).astype(np.int64) for column in (*counted.totals.T, counted.counts)]
    totals, weight = np.stack(columns[:3], axis=1), columns[3]
    return _rounded(Counted(totals[weight > 0], weight[weight > 0]))


def _rounded(counted: Counted) -> Bytes:
    """Return the colours as bytes, each once."""
    return unpacked(np.unique(packed(np.round(counted.means).astype(np.uint8))))


def brick_colours(centres: Bytes, catalogue: Catalogue, *, palette: Codes, one_to_one: bool = False) -> Codes:
    """Return the brick colour nearest to each colour by CIEDE2000.

    Parameters
    ----------
    centres : (m, 3) uint8 array
        sRGB.
    catalogue : Catalogue
    palette : (k,) int16 array
        LDraw codes to choose from.
    one_to_one : bool
        Choose different codes for all colours, with the least sum of differences.

    Returns
    -------
    (m,) int16 array
        LDraw codes.

    Raises
    ------
    SettingsError
        If a one-to-one choice has fewer brick colours than dominant colours.
    """
    difference = brick_differences(lab_from_srgb(centres)[:, None], palette, catalogue)
    if not one_to_one:
        nearest: Codes = palette[difference.argmin(axis=1)]
        return nearest
    if len(centres) > len(palette):
        raise SettingsError(
            f"{len(centres)} dominant colours need as many brick colours, but there are {len(palette)}: set colours "
            f"to at most {len(palette)}, allow a larger palette, or turn one_to_one off."
        )
    chosen: Codes = palette[linear_sum_assignment(difference)[1]]
    return chosen


def chosen_palette(text: str, catalogue: Catalogue) -> Codes:
    """Return the LDraw codes that a palette setting names; all default colours where it is empty.

    Raises
    ------
    SettingsError
        If a word is not the code of a colour that can be bought.
    """
    if not text.strip():
        return catalogue.codes
    known = {str(int(code)): code for code in catalogue.codes}
    words = text.replace(",", " ").split()
    unknown = [word for word in words if word not in known]
    if unknown or not words:
        raise SettingsError(
            f"The palette names {', '.join(unknown) or 'nothing'}: use LDraw codes of colours made today, such as "
            f"{', '.join(list(known)[:5])}."
        )
    return np.unique(np.array([known[word] for word in words], dtype=np.int16))


def _surface_texels(mesh: TriangleMesh, rng: np.random.Generator) -> Bytes:
    """Return texels drawn evenly over the surface, and more where it counts more, (n, 3) uint8."""
    area = np.linalg.norm(mesh.normals, axis=1)
    if mesh.weight is not None:
        area *= 1 + mesh.weight[mesh.faces].mean(axis=1)
    # evenly spaced samples instead of independent ones: every face gets exactly
    # its share
    comb = (np.arange(_SAMPLES) + rng.random()) / _SAMPLES * area.sum()
    face = np.minimum(np.searchsorted(np.cumsum(area), comb), len(area) - 1)
    a, b = rng.random((2, _SAMPLES))
    root = np.sqrt(a)
    weight = np.stack([1 - root, root * (1 - b), root * b], axis=1)
    uv = (mesh.uvs[face] * weight[:, :, None]).sum(axis=1)
    return texels_at(mesh, mesh.face_image[face], uv)


def _nearest_centres(images: tuple[Bytes, ...], centres: Bytes) -> tuple[Bytes, ...]:
    """Return the nearest centre of every texel by squared distance in sRGB, one (h, w) uint8 array an image.

    References
    ----------
    Paper, Algorithm 1, lines 3 to 12.
    """
    # each colour is classified once, however many texels have it; a table of all 2^24 is faster than sorting
    table = np.zeros(1 << 24, dtype=np.uint8)
    for image in images:
        table[packed(image).ravel()] = 1
    colours = np.flatnonzero(table).astype(np.uint32)
    target = centres.astype(np.float32)
    half_norm = (target**2).sum(axis=1) / 2
    for start in range(0, len(colours), 1 << 18):
        part = colours[start : start + (1 << 18)]
        table[part] = (unpacked(part).astype(np.float32) @ target.T - half_norm).argmax(axis=1)
    return tuple(table[packed(image)] for image in images)
