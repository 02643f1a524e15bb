"""The machine of the learned fill: how good a brick is, by what the simulation behind it ends with.

Each brick that could be laid next is given four numbers, one for each of the paper's
energies: how much more the energy sums up to, over the bricks of the filled window,
than behind the candidate where it is least. A support vector machine with three
classes tells what that means for the best fill there is.

References
----------
Paper, sections on features and on LIBSVM; C.-C. Chang and C.-J. Lin, "LIBSVM: a
library for support vector machines", ACM TIST 2(3), 2011 (in scikit-learn).
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats
from ...errors import BuildError
from ...model import ASSETS
from ..problem import Index
from .energies import gauss_normalised
from .sample_file import MOST_MODELS, SampleFileError, facts_and_rows, parameter
from .simulation import Outcome

Whole = NDArray[np.int16]

GRADES: Final = ("best", "good", "poor")
ENERGIES: Final = ("units", "stability", "symmetry", "efficiency")
COLUMNS: Final = ("model", "grade", *ENERGIES)
"""Of a file of samples."""

PER_BRICK: Final = 1000
"""Energies are kept in thousandths."""

MOST: Final = 16_000
"""Larger differences count as this one."""

_WORTH: Final = np.array([1.0, 0.2, -1.0])
"""What each grade is worth."""

_PAIRS: Final = ((0, 1), (0, 2), (1, 2))
_TOLERANCE: Final = 1e-6
_MOST_STEPS: Final = 2_000_000
_DECIMALS: Final = 6
"""Digits in which values of the machine count: rounding of different computers must not decide."""


@dataclass(frozen=True, slots=True, eq=False)
class Graded:
    """Candidates, and how good each turned out to be.

    Attributes
    ----------
    energies : (n, 4) int16 array
        Thousandths above the least, in the order of ``ENERGIES``.
    grade : (n,) int16 array
        Row in ``GRADES``.
    model : (n,) int16 array
        Number of the model that each is from.
    """

    energies: Whole
    grade: Whole
    model: Whole

    def take(self, rows: Index | NDArray[np.bool_]) -> Graded:
        """Return some of them."""
        return Graded(self.energies[rows], self.grade[rows], self.model[rows])


def relative(outcome: Outcome, candidates: Index) -> Whole:
    """Return how far the energies behind each candidate are above the least of its window.

    Parameters
    ----------
    outcome : Outcome
    candidates : (n_windows, n_candidates) intp array
        -1 where there is none.

    Returns
    -------
    (n_windows, n_candidates, 4) int16 array
        Thousandths.
    """
    there = (candidates >= 0)[..., None]
    least = np.where(there, outcome.energies, np.inf).min(axis=1, keepdims=True)
    above = np.where(there, outcome.energies - np.where(np.isfinite(least), least, 0), 0)
    rounded: Whole = np.rint(np.clip(above * PER_BRICK, 0, MOST)).astype(np.int16)
    return rounded


def drawn_best(score: Floats, candidates: Index, rng: np.random.Generator) -> Index:
    """Return the candidate of the highest score in each window, one of equal ones by chance: order must not decide.

    Parameters
    ----------
    score : (n_windows, n_candidates) float64 array
    candidates : (n_windows, n_candidates) intp array
        -1 where there is none.
    rng : numpy.random.Generator

    Returns
    -------
    (n_windows,) intp array
    """
    there = np.where(candidates >= 0, score, -np.inf)
    best: Index = np.where(there == there.max(axis=1, keepdims=True), rng.random(there.shape), -1).argmax(axis=1)
    return best


@dataclass(frozen=True, slots=True, eq=False)
class Grader:
    """A trained machine, as arrays.

    Attributes
    ----------
    mean, deviation : (4,) float64 arrays
        Of the samples, for the Gauss normalisation.
    gamma : float
        How narrow the kernel is.
    vectors : (n_vectors, 4) float64 array
        Normalised samples that count.
    weights : (n_vectors, 3) float64 array
        Of each, for best against good, best against poor, good against poor.
    offset : (3,) float64 array
        What is added.
    """

    mean: Floats
    deviation: Floats
    gamma: float
    vectors: Floats
    weights: Floats
    offset: Floats

    @classmethod
    def of(cls, samples: Graded, *, c: float, gamma: float) -> Grader:
        """Train a machine.

        Parameters
        ----------
        samples : Graded
            Of all three grades.
        c, gamma : float
            Cost of a sample on the wrong side, and how narrow the kernel is.

        Returns
        -------
        Grader

        Raises
        ------
        BuildError
            The training does not converge.
        """
        # loading it takes longer than building a small model
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.svm import SVC

        mean, deviation = (measure(samples.energies, axis=0, dtype=np.float64) for measure in (np.mean, np.std))
        svc = SVC(C=c, gamma=gamma, kernel="rbf", tol=_TOLERANCE, max_iter=_MOST_STEPS)
        with warnings.catch_warnings():
            # that it did not converge is reported below
            warnings.simplefilter("ignore", ConvergenceWarning)
            svc.fit(gauss_normalised(samples.energies.astype(np.float64), mean, deviation), samples.grade)
        if svc.fit_status_:
            raise BuildError(f"Training does not converge with C = {c:g} and gamma = {gamma:g}: choose a smaller C.")
        return cls(
            mean, deviation, gamma, svc.support_vectors_, _weights(svc.dual_coef_, svc.n_support_), svc.intercept_
        )

    def decision(self, energies: Whole) -> Floats:
        """Return the values of the three pairs of grades, (n, 3); positive for the better grade."""
        points = gauss_normalised(energies.astype(np.float64), self.mean, self.deviation)
        square = (points**2).sum(axis=1)[:, None] + (self.vectors**2).sum(axis=1) - 2 * points @ self.vectors.T
        values: Floats = np.exp(-self.gamma * square) @ self.weights + self.offset
        return values

    def grades(self, energies: Whole) -> Index:
        """Return the grade of each, (n,): the one that wins most pairs, the better one of equals."""
        values = self.decision(energies)
        votes = np.zeros((len(values), len(GRADES)), dtype=np.intp)
        for pair, (one, other) in zip(values.T, _PAIRS, strict=True):
            votes[:, one] += pair > 0
            votes[:, other] += pair <= 0
        return votes.argmax(axis=1)

    def scores(self, energies: Whole) -> Floats:
        """Return how good each is, (n,): what the grades are worth, by the values of their pairs."""
        worth = np.array([_WORTH[one] - _WORTH[other] for one, other in _PAIRS])
        scores: Floats = np.round(self.decision(energies) @ worth, _DECIMALS)
        return scores

    def choose(self, outcome: Outcome, candidates: Index, rng: np.random.Generator) -> Index:
        """Choose a candidate for each window, as :data:`~.fill.Choice`; one of equal ones by chance."""
        above = relative(outcome, candidates)
        # many end alike, and the machine is asked once for each kind
        codes = above.reshape(-1, above.shape[2]).astype(np.int64) @ (np.int64(1) << np.array([45, 30, 15, 0]))
        _, first, kind = np.unique(codes, return_index=True, return_inverse=True)
        score = self.scores(above.reshape(-1, above.shape[2])[first])[kind.reshape(-1)].reshape(candidates.shape)
        return drawn_best(score, candidates, rng)


def _weights(dual: Floats, n_support: Index) -> Floats:
    """Spread the coefficients of LIBSVM, which follow the classes, over the pairs of classes."""
    of = np.repeat(np.arange(len(GRADES)), n_support)
    weights = np.zeros((dual.shape[1], len(_PAIRS)))
    for column, (one, other) in enumerate(_PAIRS):
        weights[of == one, column] = dual[other - 1, of == one]
        weights[of == other, column] = dual[one, of == other]
    return weights


def read_graded(text: str) -> tuple[Graded, dict[str, str]]:
    """Read what :func:`~.grade_training.written_grades` wrote.

    Parameters
    ----------
    text : str
        Lines of ``# name: value``, among them C and gamma, then a table.

    Returns
    -------
    samples : Graded
    facts : dict of str to str
        Where the samples are from, C and gamma.

    Raises
    ------
    SampleFileError
        It is no such text, or has not all grades.
    """
    facts, rows = facts_and_rows(text, COLUMNS, (MOST_MODELS, len(GRADES), *(MOST + 1,) * len(ENERGIES)))
    if len(np.unique(rows[:, 1])) < len(GRADES):
        raise SampleFileError(f"has not samples of all {len(GRADES)} grades")
    return Graded(rows[:, 2:], rows[:, 1], rows[:, 0]), dict(facts)


@lru_cache(maxsize=4)
def grader_of(text: str) -> Grader:
    """Return the machine of the text of a file of samples."""
    samples, facts = read_graded(text)
    return Grader.of(samples, c=parameter(facts, "C"), gamma=parameter(facts, "gamma"))


@cache
def shipped_grader() -> Grader:
    """Return the machine that is trained on the samples in ``assets/fill_svm.csv``."""
    return grader_of((ASSETS / "fill_svm.csv").read_text(encoding="utf-8"))
