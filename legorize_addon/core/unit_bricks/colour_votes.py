"""The colour of every visible unit brick, from the surface near to it.

References
----------
Paper, section "Colour of a unit brick": the colour with the greatest length of
trajectory, over the brick's own square and those of its eight neighbours that
belong to no other brick of the same trajectory.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints, Mask
from ..colours import SurfaceColours, ciede2000, lab_from_srgb
from ..model import COLOUR_ANY, Catalogue
from ..units import BRICK, STUD
from .occlusion import occluded
from .surface_samples import SurfaceSamples
from .visibility import nearest_faces, reached_by_air

Codes = NDArray[np.int16]

CLEAR: Final = 22.0
"""CIEDE2000 difference from which a border between two colours is clearly visible."""


@dataclass(frozen=True, slots=True, eq=False)
class Ballot:
    """How the surface around visible cells votes for their colours.

    Attributes
    ----------
    codes : (k,) int16 array
        The colours there are, rising.
    votes : (n_seen, k) float64 array
        Weight of each colour at each cell, in the order of ``np.nonzero(seen)``.
    score : (n_seen, k) float64 array
        The colour with the greatest score wins.
    difference : (k, k) float64 array
        CIEDE2000: row by what takes the code, column by the brick.
    weight : (n_seen,) float64 array or None
        How many times more than usual the surface of each cell counts; None where all cells count alike.
    """

    codes: Codes
    votes: Floats
    score: Floats
    difference: Floats
    weight: Floats | None = None

    @property
    def cost(self) -> Floats:
        """Mean difference of each cell's surface from each colour, 0 where there is no vote, (n_seen, k).

        Where surface counts at least twice as much as usual, differences count up to a clear one: of an eye and the
        white around it a cell takes one or the other, and no grey between them.
        """
        total = self.votes.sum(axis=1, keepdims=True)
        cost: Floats = self.votes @ self.difference
        if self.weight is not None:
            cost = np.where(self.weighted[:, None], self.votes @ np.minimum(self.difference, CLEAR), cost)
        return cost / np.where(total > 0, total, 1)

    @property
    def factor(self) -> Floats:
        """How many times as much as usual the surface of each cell counts, shape (n_seen,)."""
        return np.ones(len(self.votes)) if self.weight is None else 1 + self.weight

    @property
    def weighted(self) -> Mask:
        """Cells whose surface counts at least twice as much as usual, shape (n_seen,)."""
        return np.zeros(len(self.votes), bool) if self.weight is None else self.weight >= 1

    def winners(self, seen: Mask, height: float = BRICK) -> Codes:
        """Return the colour of each cell, given which they are and how high in mm, (n_seen,)."""
        return winning_colours(self.codes, self.votes, self.score, seen, height)


def cost_in(cost: Floats, shown: Mask, codes: Codes, wanted: Codes) -> Floats:
    """Look up what plates cost in colours.

    Parameters
    ----------
    cost : (n, 3, k) float64 array
        Of each plate in each colour.
    shown : (n, 3) bool array
        Plates that have a colour; others cost nothing.
    codes : (k,) int16 array
        The colours, rising.
    wanted : (n, m, 3) int16 array
        LDraw codes to look up.

    Returns
    -------
    (n, m, 3) float64 array
        Infinite in a colour that is not among them, as nobody voted for it.
    """
    place = np.searchsorted(codes, wanted)
    there = np.append(codes, np.int16(COLOUR_ANY))[place] == wanted
    found = np.take_along_axis(cost, np.minimum(place, len(codes) - 1).transpose(0, 2, 1), axis=2).transpose(0, 2, 1)
    return np.where(shown[:, None], np.where(there, found, np.inf), 0.0)


def likeliest_colours(
    samples: SurfaceSamples,
    air: Mask,
    seen: Mask,
    catalogue: Catalogue,
    surface: SurfaceColours | None = None,
) -> Ballot:
    """Let all the surface on the outer faces of visible cells vote for the colour most like it.

    Each sample that can be seen counts for the cell with the nearest outer face.
    A cell takes the one of its colours that differs least, weighted by area, from
    all of them: where one colour covers most of it that is the most frequent
    one, and where many shades meet the one in their middle.

    Parameters
    ----------
    samples : SurfaceSamples
    air, seen : (n_layers, n_y, n_x) bool arrays
        Cells of the air around the model, and those to colour.
    catalogue : Catalogue
    surface : SurfaceColours, optional
        The texels that the bricks' colours stand for, to compare with these
        themselves.

    Returns
    -------
    Ballot
    """
    shown = samples.at(reached_by_air(samples, seen.shape) & ~occluded(samples))
    cell = nearest_faces(shown.place, shown.sides, seen, air)
    counts = shown.area if shown.weight is None else shown.area * (1 + shown.weight)
    codes, votes = count_votes(cell, shown.colour, counts, seen)
    difference = colour_differences(codes, catalogue, surface)
    # a colour that the cell does not have at all is never chosen
    ballot = Ballot(codes, votes, np.where(votes > 0, -votes @ difference, -np.inf), difference)
    weight = cell_weights(cell, shown, seen)
    if weight is None:
        return ballot
    ballot = replace(ballot, weight=weight)
    return replace(ballot, score=np.where(votes > 0, -ballot.cost, -np.inf))


def cell_weights(cell: Ints, samples: SurfaceSamples, seen: Mask) -> Floats | None:
    """Return the mean weight of the surface of each visible cell, given the cell of each sample, -1 for none.

    Parameters
    ----------
    cell : (n,) int64 array
    samples : SurfaceSamples
    seen : (n_layers, n_y, n_x) bool array

    Returns
    -------
    (n_seen,) float64 array or None
        0 where a cell has no surface; None where the samples have no weights.
    """
    if samples.weight is None:
        return None
    there = cell >= 0
    area, weighted = (
        np.bincount(cell[there], each[there], seen.size)[seen.ravel()]
        for each in (samples.area, samples.area * samples.weight)
    )
    weights: Floats = weighted / np.where(area > 0, area, 1)
    return weights


def colour_differences(codes: Codes, catalogue: Catalogue, surface: SurfaceColours | None) -> Floats:
    """Return how different the surface behind one brick colour looks from each brick colour.

    Orange fur that becomes brown bricks may be closer to red than brown is, so texels are compared where they are
    known.

    Parameters
    ----------
    codes : (k,) int16 array
        LDraw codes, each that of a texel where there is a surface.
    catalogue : Catalogue
    surface : SurfaceColours or None
        None compares the bricks with each other.

    Returns
    -------
    (k, k) float64 array
        CIEDE2000: row by what takes the code, column by the brick.
    """
    bricks = lab_from_srgb(catalogue.rgb[[catalogue.colour_row(int(code)) for code in codes]])
    if surface is None or len(codes) == 0:
        return ciede2000(bricks[:, None], bricks[None])
    centres = ciede2000(lab_from_srgb(surface.centres)[:, None], bricks[None])
    return np.stack([centres[surface.codes == code].mean(axis=0) for code in codes])


def count_votes(cell: Ints, colour: Codes, weight: Floats, seen: Mask) -> tuple[Codes, Floats]:
    """Sum up weights by visible cell and colour.

    Parameters
    ----------
    cell : (n,) int64 array
        Flat index of a cell, -1 for none.
    colour : (n,) int16 array
        LDraw codes; ``COLOUR_ANY`` is not counted.
    weight : (n,) float64 array
    seen : (n_layers, n_y, n_x) bool array

    Returns
    -------
    codes : (k,) int16 array
        The colours there are, rising.
    votes : (n_seen, k) float64 array
    """
    number = np.full(seen.size, -1, dtype=np.int64)
    number[seen.ravel()] = np.arange(int(seen.sum()))
    target = np.where(cell >= 0, number[cell], -1)
    valid = (target >= 0) & (colour != COLOUR_ANY)
    codes, column = np.unique(colour[valid], return_inverse=True)
    size = int(seen.sum()) * len(codes)
    votes = np.bincount(target[valid] * len(codes) + column.ravel(), weight[valid], size)
    return codes, votes.reshape(int(seen.sum()), len(codes))


def winning_colours(codes: Codes, votes: Floats, score: Floats, seen: Mask, height: float = BRICK) -> Codes:
    """Return the colour with the best score of each cell, or that of the nearest cell with votes.

    Parameters
    ----------
    codes : (k,) int16 array
    votes, score : (n_seen, k) float64 arrays
    seen : (n_layers, n_y, n_x) bool array
    height : float
        Height of a cell in mm.

    Returns
    -------
    (n_seen,) int16 array
        ``COLOUR_ANY`` where no cell at all has votes.
    """
    voted = votes.sum(axis=1) > 0
    if not voted.any():
        return np.full(len(votes), COLOUR_ANY, dtype=np.int16)
    colour = codes[score.argmax(axis=1)]
    if not voted.all():
        place = np.argwhere(seen) * np.array([height, STUD, STUD])
        nearest = cKDTree(place[voted]).query(place[~voted])[1]
        colour[~voted] = colour[voted][nearest]
    return colour
