"""What was learned from samples: which placements are worth an exchange.

After the fast tier has laid a sheet, few of the placements left over would make
it better: about two in a thousand. Computing what all of them save takes ten
times as long as the laying. A support vector machine selects them by what each
would change locally in the paper's four energies.

============  =======================================================================
change        what is counted
============  =======================================================================
units         1 x 1 bricks that it takes away (minimum unit connection)
hold          what the bricks in its way cost for their bonding, less its own (stability)
cuts          parts of bricks that it leaves behind (in place of symmetry, which is no
              matter of a single brick: bricks should go as a whole)
area          bricks that it takes away, a part of one counting in proportion (efficiency)
============  =======================================================================

All four are whole numbers of few values. So the machine's answers to all of them are computed once, and a placement
costs only a look-up in a table.

References
----------
Paper, sections on features and on the SVM; C.-C. Chang and C.-J. Lin, "LIBSVM:
a library for support vector machines", ACM TIST 2(3), 2011 (in scikit-learn).
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats, Mask
from ...errors import BuildError
from ...model import ASSETS, NOBODY
from ..problem import Index, Problem, segment_sums
from ..solvers import exchange
from .energies import gauss_normalised
from .sample_file import MOST_MODELS, check_both_kinds, facts_and_rows, parameter

if TYPE_CHECKING:
    from sklearn.svm import SVC

Levels = NDArray[np.int16]

NAMES: Final = ("units", "hold", "cuts", "area")
LEVELS: Final = (4, 16, 16, 24)
"""Number of values of each change."""

COLUMNS: Final = ("model", "pays", *NAMES)
"""Of a file of samples."""

_PER_BRICK: Final = 48
"""A brick in whole numbers: every number of cells that a part has divides it."""

_HOLD: Final = 1 << 10
"""Costs of one brick, in whole numbers."""

_STEPS: Final = (1, _HOLD // 8, _PER_BRICK // 2, _PER_BRICK // 6)
_LOW: Final = (0, -_HOLD, 0, 0)
"""Width of a level of each change, and where the lowest begins."""

_FIELD: Final = 16
"""Bits of each of the numbers that are summed up as one."""

_N_JOINED: Final = np.array([0, 1, 1, 2, -1, 0, 0, 1], dtype=np.int8)
"""Neighbours along x (bit 0) and y (bit 1) in one brick, less the square (bit 2)."""

_PASSES: Final = 2
"""Rounds of exchanges; later ones find next to nothing."""

_TOLERANCE: Final = 1e-6
"""Tolerance of the training: tight, so that rounding of different computers does not show."""

_MOST_STEPS: Final = 2_000_000
"""Steps of the fitting: the shipped samples take 570,000 at the hardest C and gamma of the search (512 and 8)."""


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """What placements would change, and whether they turned out to pay.

    Attributes
    ----------
    levels : (n, 4) int16 array
        Changes in the order of ``NAMES``.
    pays : (n,) bool array
        Whether laying the placement saves anything.
    model : (n,) int16 array
        Number of the model that each sample is from.
    """

    levels: Levels
    pays: Mask
    model: NDArray[np.int16]

    def take(self, rows: Index | Mask) -> Samples:
        """Return some of the samples."""
        return Samples(self.levels[rows], self.pays[rows], self.model[rows])


@dataclass(frozen=True, slots=True, eq=False)
class Machine:
    """A trained support vector machine.

    Attributes
    ----------
    mean, deviation : (4,) float64 arrays
        Of the samples, for the Gauss normalisation.
    svc : SVC
        The machine, on normalised changes.
    """

    mean: Floats
    deviation: Floats
    svc: SVC

    @classmethod
    def of(cls, samples: Samples, *, c: float, gamma: float) -> Machine:
        """Train a machine.

        Parameters
        ----------
        samples : Samples
            Of both classes.
        c, gamma : float
            Cost of a sample on the wrong side, and how narrow the kernel is.

        Returns
        -------
        Machine

        Raises
        ------
        BuildError
            The training does not converge.
        """
        mean, deviation = (measure(samples.levels, axis=0, dtype=np.float64) for measure in (np.mean, np.std))
        # loading it takes longer than building a small model, and only the fast layout needs it
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.svm import SVC

        svc = SVC(C=c, gamma=gamma, kernel="rbf", tol=_TOLERANCE, max_iter=_MOST_STEPS)
        # equal samples get a weight: the same machine, and faster
        kind, weight = np.unique(np.column_stack([samples.levels, samples.pays]), axis=0, return_counts=True)
        with warnings.catch_warnings():
            # that it did not converge is reported below
            warnings.simplefilter("ignore", ConvergenceWarning)
            svc.fit(gauss_normalised(kind[:, :-1].astype(np.float64), mean, deviation), kind[:, -1] == 1, weight)
        if svc.fit_status_:
            raise BuildError(
                f"Training does not converge with C = {c:g} and gamma = {gamma:g}: choose a file with a "
                "smaller C, or leave learned_from empty."
            )
        return cls(mean, deviation, svc)

    def decision(self, levels: Levels) -> Floats:
        """Return the decision values of changes, (n,); positive for what should pay."""
        normalised = gauss_normalised(levels.astype(np.float64), self.mean, self.deviation)
        values: Floats = self.svc.decision_function(normalised)
        return values

    def table(self) -> Mask:
        """Predict for all possible changes.

        Returns
        -------
        (4, 16, 16, 24) bool array
            Whether a placement with these changes is worth an exchange.
        """
        points = np.indices(LEVELS, dtype=np.int16).reshape(len(LEVELS), -1).T
        return (self.decision(points) > 0).reshape(LEVELS)


NO_EXCHANGES: Final = np.zeros(LEVELS, dtype=bool)
"""A table that proposes nothing."""
NO_EXCHANGES.setflags(write=False)


def improved(problem: Problem, chosen: Index, rng: np.random.Generator, table: Mask | None = None) -> Index:
    """Make the exchanges that pay among those that a table proposes.

    Parameters
    ----------
    problem : Problem
        The sheet.
    chosen : (n_bricks,) intp array
        Rows of the placements that lie there.
    rng : numpy.random.Generator
        Decides between exchanges of the same gain.
    table : (4, 16, 16, 24) bool array, optional
        As :meth:`Machine.table`; by default what was learned before.

    Returns
    -------
    intp array
        Rows of the placements that lie there now. They cover the same must
        cells and cost no more.
    """
    worth = shipped() if table is None else table
    for _ in range(_PASSES):
        offered = np.flatnonzero(worth[tuple(changes(problem, chosen).T)])
        better = exchange(problem, chosen, offered, rng)
        if better is chosen:
            break
        chosen = better
    return chosen


def changes(problem: Problem, chosen: Index) -> Levels:
    """Compute what each placement would change if it replaced the bricks in its way.

    Parameters
    ----------
    problem : Problem
        The sheet.
    chosen : (n_bricks,) intp array
        Rows of the placements that lie there.

    Returns
    -------
    (n, 4) int16 array
        Levels of the changes named in ``NAMES``, from 0 to below ``LEVELS``.
    """
    found, owner = problem.placements, problem.owner(chosen)
    extra = np.rint((problem.cost - 1 - (found.size == 1)) * _HOLD).astype(np.int64)
    # the last brick is nobody's: free cells find it at -1
    size = np.append(found.size[chosen], 1)
    of_brick = (
        ((np.append(extra[chosen], 0) // size) << 2 * _FIELD)
        + (np.append(_PER_BRICK // found.size[chosen], 0) << _FIELD)
        + np.append(found.size[chosen] == 1, False)
    )
    sums = segment_sums(of_brick[owner][found.cells], found.start[1:])
    units, area = sums & ((1 << _FIELD) - 1), (sums >> _FIELD) & ((1 << _FIELD) - 1)
    clutch = (sums >> 2 * _FIELD) - extra
    cuts = _PER_BRICK * _n_bricks(problem, owner) - area
    measured = np.stack([units, clutch, cuts, area], axis=1)
    return np.clip((measured - _LOW) // _STEPS, 0, np.array(LEVELS) - 1).astype(np.int16)


def _n_bricks(problem: Problem, owner: Index) -> NDArray[np.int64]:
    """Count the bricks in the way of each placement, (n,).

    What a placement has in common with a brick is in one piece without holes;
    so the cells, less the pairs of neighbours in one brick, plus the squares of
    four in one brick, are the number of bricks (Euler's formula). Only corner
    parts that are hooked into each other meet in two places, and count twice.
    """
    found, among = problem.placements, problem.shapes
    # bits of what a cell has in common with its neighbours, and of the neighbours that the placement covers too
    x, y = among.inner.astype(np.uint8)
    common = _same_brick(problem, owner)[found.cells] & (x | y << 1 | (x & y) << 2)[found.in_shapes(among)]
    count = (owner >= 0)[found.cells] - _N_JOINED[common]
    return segment_sums(count, found.start[1:])


def _same_brick(problem: Problem, owner: Index) -> NDArray[np.uint8]:
    """Tell of each cell whether the next along x, the next along y, and the square of four lie in its brick.

    Returns
    -------
    (n_cells,) uint8 array
        Sums of 1, 2 and 4.
    """
    sheets = problem.sheets
    plane = np.full(sheets.colour.shape, NOBODY, dtype=np.intp)
    plane.reshape(-1)[sheets.cells] = owner
    plane = np.pad(plane, ((0, 0), (0, 1), (0, 1)), constant_values=NOBODY)
    here = plane[:, :-1, :-1]
    along_x, along_y, across = (here == other for other in (plane[:, :-1, 1:], plane[:, 1:, :-1], plane[:, 1:, 1:]))
    bits = along_x.astype(np.uint8) | along_y.astype(np.uint8) << 1 | (along_x & along_y & across).astype(np.uint8) << 2
    same: NDArray[np.uint8] = np.where(here == NOBODY, 0, bits).reshape(-1)[sheets.cells]
    return same


@cache
def shipped() -> Mask:
    """Return the table of the machine that is trained on the samples in ``assets/layout_svm.csv``."""
    return table_of((ASSETS / "layout_svm.csv").read_text(encoding="utf-8"))


def table_of(text: str) -> Mask:
    """Return what the machine of the text of a file of samples proposes, as :meth:`Machine.table`."""
    samples, facts = read(text)
    return Machine.of(samples, c=parameter(facts, "C"), gamma=parameter(facts, "gamma")).table()


def read(text: str) -> tuple[Samples, Mapping[str, str]]:
    """Read what :func:`~.svm_training.written` wrote.

    Parameters
    ----------
    text : str
        Lines of ``# name: value``, among them C and gamma, then a table.

    Returns
    -------
    samples : Samples
        Of both kinds.
    facts : mapping of str to str
        Where the samples are from, C and gamma.

    Raises
    ------
    SampleFileError
        It is no such text, or a machine cannot learn from it.
    """
    facts, rows = facts_and_rows(text, COLUMNS, (MOST_MODELS, 2, *LEVELS))
    samples = Samples(rows[:, 2:], rows[:, 1] == 1, rows[:, 0])
    check_both_kinds(samples.levels, samples.pays)
    return samples, facts
