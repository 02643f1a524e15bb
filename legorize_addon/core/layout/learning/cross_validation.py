"""How the parameters of a machine are chosen: by what machines say of models that they were not trained on."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from ...arrays import Mask
from ...errors import BuildError
from ..problem import Index

FOLDS: Final = 5

S = TypeVar("S")
"""Kind of samples."""

Labels = NDArray[np.bool_] | NDArray[np.integer]


@dataclass(frozen=True, slots=True, eq=False)
class Trained(Generic[S]):
    """The outcome of a training.

    Attributes
    ----------
    samples : S
        What was learned from.
    c, gamma : float
        The best of the grid.
    grid : mapping of (C, gamma) to float
        Share of right answers in the cross-validation (the micro-average F1).
    micro, macro : float
        F1 of the best, averaged over samples and over classes.
    confusion : (n_classes, n_classes) intp array
        Rows: the classes in ascending order; columns: what the machine held them for.
    """

    samples: S
    c: float
    gamma: float
    grid: Mapping[tuple[float, float], float]
    micro: float
    macro: float
    confusion: Index

    def facts(self, counts: str) -> dict[str, str]:
        """Return what a file of samples says of its training.

        Parameters
        ----------
        counts : str
            How many samples there are of each class.

        Returns
        -------
        dict of str to str
        """
        scores = f"micro F1 {self.micro:.3f}, macro F1 {self.macro:.3f}"
        return {
            "samples": counts,
            "C": repr(self.c),
            "gamma": repr(self.gamma),
            "cross-validation": f"{FOLDS} folds by model, {scores}",
            "confusion": " ".join(map(str, self.confusion.ravel())),
        }


def cross_validated(
    samples: S,
    label: Labels,
    model: NDArray[np.int16],
    said: Callable[[Mask, float, float], Labels],
    rng: np.random.Generator,
    *,
    costs: Sequence[float],
    gammas: Sequence[float],
) -> Trained[S]:
    """Choose C and gamma by cross-validation; samples of one model are never on both sides.

    Parameters
    ----------
    samples : S
        From at least five models.
    label : (n,) array
        The class of each sample.
    model : (n,) int16 array
        Number of the model that each sample is from.
    said : callable
        From which samples are left out, C and gamma to what a machine says of these when it is trained on the others.
    rng : numpy.random.Generator
        Deals the models out to the folds.
    costs, gammas : sequence of float
        The grid of C and gamma.

    Returns
    -------
    Trained
        Of equal pairs the first one counts: the smoothest machine.

    Raises
    ------
    BuildError
        There are fewer models than folds.
    """
    # loading it takes longer than building a small model, which does not need it
    from sklearn.metrics import confusion_matrix, f1_score

    fold = folds(model, rng)

    def answers(c: float, gamma: float) -> Labels:
        found = np.zeros_like(label)
        for number in range(FOLDS):
            out = fold == number
            found[out] = said(out, c, gamma)
        return found

    every = {(c, gamma): answers(c, gamma) for c in costs for gamma in gammas}
    grid = {pair: float(np.mean(each == label)) for pair, each in every.items()}
    c, gamma = max(grid, key=lambda pair: grid[pair])
    best = every[c, gamma]
    return Trained(
        samples=samples,
        c=c,
        gamma=gamma,
        grid=grid,
        micro=float(f1_score(label, best, average="micro")),
        macro=float(f1_score(label, best, average="macro")),
        confusion=confusion_matrix(label, best, labels=np.unique(label)),
    )


def folds(model: NDArray[np.int16], rng: np.random.Generator) -> Index:
    """Deal models out to folds, (n,): the fold of each sample.

    Parameters
    ----------
    model : (n,) int16 array
        Number of the model that each sample is from.
    rng : numpy.random.Generator
        Shuffles.

    Returns
    -------
    (n,) intp array
        From 0 to below ``FOLDS``.

    Raises
    ------
    BuildError
        There are fewer models than folds.
    """
    numbers, row = np.unique(model, return_inverse=True)
    if len(numbers) < FOLDS:
        raise BuildError(f"The samples are from {len(numbers)} models: train on at least {FOLDS} models.")
    dealt: Index = rng.permutation(len(numbers))[row] % FOLDS
    return dealt
