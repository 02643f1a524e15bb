"""Laying by a fixed rule: whatever has the greatest key where it lies, until nothing fits."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.layout.problem.candidates import Candidates
from legorize_addon.core.layout.problem.problem import Problem

Index = NDArray[np.intp]
Way = Callable[[Problem, np.random.Generator], Index]


def by_key(key: Callable[[Problem, np.random.Generator], Index]) -> Way:
    """Return a way that lays whatever has the greatest key where it lies, until nothing fits."""

    def way(problem: Problem, rng: np.random.Generator) -> Index:
        keys, covered, candidates = (
            key(problem, rng).astype(np.int64),
            np.zeros_like(problem.required),
            Candidates.of(problem.placements),
        )
        chosen = [candidates.rows[:0]]
        while len(candidates.rows):
            won = candidates.only(candidates.winners(keys[candidates.rows], len(covered)))
            chosen.append(won.rows)
            covered[won.cells] = True
            candidates = candidates.clear_of(covered)
        return np.concatenate(chosen)

    return way


def largest(problem: Problem, rng: np.random.Generator) -> Index:
    """Return keys by size, then by chance."""
    n = len(problem.placements)
    return problem.placements.size * n + rng.permutation(n)


def largest_in_rows(problem: Problem, rng: np.random.Generator) -> Index:
    """Return keys by size, then by shape, y and x: the same shapes side by side leave fewer gaps than by chance."""
    del rng
    n = len(problem.placements)
    return problem.placements.size * n + np.arange(n)[::-1]
