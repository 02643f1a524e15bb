"""The machine of the learned fill: it predicts what scikit-learn does, and its samples are as they should be."""

from __future__ import annotations

import re

import numpy as np
import pytest
from sklearn.svm import SVC

from legorize_addon.core.layout.learning.cross_validation import FOLDS
from legorize_addon.core.layout.learning.energies import gauss_normalised
from legorize_addon.core.layout.learning.grade_training import GRADE_COSTS, GRADE_GAMMAS, train_grades
from legorize_addon.core.layout.learning.grading import (
    ENERGIES,
    GRADES,
    MOST,
    Graded,
    Grader,
    drawn_best,
    grader_of,
    read_graded,
    relative,
    shipped_grader,
)
from legorize_addon.core.layout.learning.sample_file import SampleFileError
from legorize_addon.core.layout.learning.simulation import Outcome
from legorize_addon.core.model import ASSETS

TEXT = (ASSETS / "fill_svm.csv").read_text(encoding="utf-8")
HEAD = "# C: 8\n# gamma: 0.5\nmodel,grade,units,stability,symmetry,efficiency\n"


def some(n=90, seed=0):
    """Return samples that can be told apart, more or less."""
    rng = np.random.default_rng(seed)
    grade = np.arange(n) % 3
    energies = rng.integers(0, 900, (n, 4)) + 700 * grade[:, None]
    return Graded(energies.astype(np.int16), grade.astype(np.int16), (np.arange(n) // 9).astype(np.int16))


def test_the_shipped_samples():
    """500 of each grade, of four energies, from 30 models, no two alike: so no kind of two grades."""
    samples, facts = read_graded(TEXT)
    assert np.bincount(samples.grade).tolist() == [500, 500, 500]
    assert samples.energies.shape == (1500, 4)
    assert len(np.unique(samples.model)) == 30
    assert len(np.unique(samples.energies, axis=0)) == len(samples.grade)
    assert {"made by", "seed", "models", "versions", "C", "gamma", "cross-validation", "confusion"} <= set(facts)


def test_averages_are_those_of_the_confusion():
    """The averages that the file tells follow from its confusion; C and gamma are the best of those it lists."""
    _, facts = read_graded(TEXT)
    confusion = np.array(facts["confusion"].split(), dtype=int).reshape(3, 3)
    assert confusion.sum(axis=1).tolist() == [500, 500, 500]
    micro = np.trace(confusion) / confusion.sum()
    f1 = 2 * np.diag(confusion) / (confusion.sum(axis=0) + confusion.sum(axis=1))
    told = f"{FOLDS} folds by model, micro F1 {micro:.3f}, macro F1 {f1.mean():.3f}"
    assert facts["cross-validation"] == told
    tried = re.findall(r"\(([\d.]+), ([\d.]+)\) ([\d.]+)", facts["shares of right answers by (C, gamma)"])
    assert len(tried) == len(GRADE_COSTS) * len(GRADE_GAMMAS)
    best = max(tried, key=lambda each: float(each[2]))
    assert (float(best[0]), float(best[1])) == (float(facts["C"]), float(facts["gamma"]))
    assert float(best[2]) == pytest.approx(micro, abs=5e-4)


def test_models_that_were_held_back_are_told_better_than_by_chance():
    """Five folds by model again, drawn otherwise: about as many right answers as the file tells, a third by chance."""
    samples, facts = read_graded(TEXT)
    again = train_grades(samples, np.random.default_rng(1), costs=[float(facts["C"])], gammas=[float(facts["gamma"])])
    assert again.micro == pytest.approx(float(facts["cross-validation"].split("micro F1 ")[1][:5]), abs=0.03)


def test_prediction_is_that_of_scikit_learn():
    """On all shipped samples: the values of all pairs to 1e-6, and the same grades."""
    samples, facts = read_graded(TEXT)
    machine = grader_of(TEXT)
    points = gauss_normalised(samples.energies.astype(float), machine.mean, machine.deviation)
    svc = SVC(C=float(facts["C"]), gamma=float(facts["gamma"]), tol=1e-6, decision_function_shape="ovo")
    svc.fit(points, samples.grade)
    np.testing.assert_allclose(machine.decision(samples.energies), svc.decision_function(points), atol=1e-6)
    np.testing.assert_array_equal(machine.grades(samples.energies), svc.predict(points))


def test_what_is_learned_says_more_than_chance():
    """The shipped machine prefers what ends with the least of everything."""
    least, much = np.zeros((1, 4), np.int16), np.array([[0, 2000, 1000, 1500]], np.int16)
    assert shipped_grader().scores(least)[0] > shipped_grader().scores(much)[0]
    assert shipped_grader().grades(much)[0] == GRADES.index("poor")


def test_energies_are_taken_above_the_least_candidate():
    """In thousandths, within limits; what is no candidate does not count."""
    energies = np.zeros((2, 3, 4))
    energies[0, :, 1] = 3.0, 2.5, 0.0
    energies[1, :, 3] = 100.0, 0.0, 0.0
    above = relative(Outcome(energies, energies[..., 0]), np.array([[4, 5, -1], [1, 2, 3]]))
    assert above[0, :, 1].tolist() == [500, 0, 0]
    assert above[1, :, 3].tolist() == [MOST, 0, 0]


def test_the_best_candidate_is_chosen():
    """By the machine's score, never one that is not there; any of equal ones."""
    machine = Grader.of(some(), c=8.0, gamma=0.5)
    energies = np.zeros((2, 4, len(ENERGIES)))
    energies[0, 0], energies[1, 1:] = 2.0, 2.0
    candidates = np.array([[0, 1, 2, -1], [0, 1, 2, 3]])
    rng, outcome = np.random.default_rng(0), Outcome(energies, energies[..., 0])
    drawn = np.array([machine.choose(outcome, candidates, rng) for _ in range(30)])
    assert set(drawn[:, 0]) == {1, 2}
    assert set(drawn[:, 1]) == {0}


def test_equal_scores_are_drawn_by_chance():
    """Each as often as the others: the order of the candidates decides nothing."""
    score, candidates = np.tile([0.5, 0.7, 0.7, 0.7, 0.9], (3000, 1)), np.tile([0, 1, 2, 3, -1], (3000, 1))
    drawn = np.bincount(drawn_best(score, candidates, np.random.default_rng(0)), minlength=5)
    assert drawn[[0, 4]].tolist() == [0, 0]
    assert drawn[1:4] == pytest.approx(1000, abs=100)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (HEAD + "0,0,1,2,3,4\n", "all 3 grades"),
        (HEAD + "0,3,1,2,3,4\n", "for grade in line 4"),
        (HEAD + f"0,0,1,2,3,{MOST + 1}\n", "for efficiency in line 4"),
    ],
)
def test_wrong_files_are_refused(text, fault):
    """With what is wrong and where."""
    with pytest.raises(SampleFileError, match=fault):
        read_graded(text)
