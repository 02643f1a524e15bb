"""What the learned fill did, by the four steps of the paper's framework: how many samples, and how long.

References
----------
Paper, "Overall framework of the proposed larger sized bricks determination model":
example preparation, extraction of feature values, generation of the classification
model, classification.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from ...model import Fill, UnitGrid
from ..problem import Index
from .fill import Choice
from .grading import ENERGIES, GRADES, Grader, relative
from .simulation import Outcome


class FillLog:
    """Counts and CPU seconds.

    Attributes
    ----------
    decisions : int
        Times that the machine chose one of several.
    candidates : int
        Fills that were simulated and classified.
    grades : (3,) intp array
        How many of the chosen ones it held to be of each grade.
    vectors : int
        Support vectors of the machine.
    facts : dict of str to str
        Of the file of samples.
    seconds : dict of str to float
        CPU seconds of "training", "filling" and, within this, "classification".
    """

    def __init__(self) -> None:
        """Begin a log."""
        self.decisions = self.candidates = self.vectors = 0
        self.grades: Index = np.zeros(len(GRADES), dtype=np.intp)
        self.seconds: dict[str, float] = {}
        self.facts: dict[str, str] = {}

    @contextmanager
    def timed(self, name: str) -> Iterator[None]:
        """Add the CPU seconds of what is done to those of its name."""
        start = time.process_time()
        yield
        self.seconds[name] = self.seconds.get(name, 0.0) + time.process_time() - start

    def watched(self, grader: Grader) -> Choice:
        """Return the choice of a machine that is counted."""
        self.vectors = len(grader.vectors)

        def choose(outcome: Outcome, candidates: Index, rng: np.random.Generator) -> Index:
            with self.timed("classification"):
                chosen = grader.choose(outcome, candidates, rng)
                several = np.flatnonzero((candidates >= 0).sum(axis=1) > 1)
                above = relative(outcome, candidates)[several, chosen[several]]
                kinds, count = np.unique(above, axis=0, return_counts=True)
                self.grades += np.bincount(grader.grades(kinds), count, len(GRADES)).astype(np.intp)
            self.decisions += len(several)
            self.candidates += int((candidates[several] >= 0).sum())
            return chosen

        return choose

    def sentences(self, shell: UnitGrid, before: float, n_bricks: int) -> tuple[str, str, str, str]:
        """Say what was done in each step.

        Parameters
        ----------
        shell : UnitGrid
            The hollowed model.
        before : float
            CPU seconds from the mesh to that.
        n_bricks : int
            Bricks that were laid.

        Returns
        -------
        (str, str, str, str)
        """
        layers, seconds = len(shell.cover), {"training": 0.0, "filling": 0.0, "classification": 0.0, **self.seconds}
        needed, maybe = (int(np.count_nonzero(shell.cover == cover)) for cover in (Fill.REQUIRED, Fill.OPTIONAL))
        held = ", ".join(f"{count:,} {grade}" for count, grade in zip(self.grades.tolist(), GRADES, strict=True))
        return (
            f"Step 1, example preparation: {needed:,} cells of {layers} layers to be filled and {maybe:,} that may be, "
            f"{before:.1f} s; examples of the machine: {self.facts.get('samples', 'unknown')}.",
            f"Step 2, feature extraction: {len(ENERGIES)} energies of {self.candidates:,} simulated fills, "
            f"{seconds['filling'] - seconds['classification']:.1f} s.",
            f"Step 3, classification model: C {self.facts.get('C')}, gamma {self.facts.get('gamma')}, "
            f"{self.vectors:,} support vectors, "
            f"{self.facts.get('cross-validation', 'not judged')}, {seconds['training']:.1f} s.",
            f"Step 4, classification: {self.decisions:,} decisions for {n_bricks:,} bricks, the chosen ones held to be "
            f"{held}, {seconds['classification']:.1f} s.",
        )
