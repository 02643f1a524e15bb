"""Own files of samples of the learned fill: none is changed, and a new version has all before it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError, SettingsError
from legorize_addon.core.layout.learning import own_grades
from legorize_addon.core.layout.learning.grade_training import train_grades, written_grades
from legorize_addon.core.layout.learning.grading import read_graded
from legorize_addon.core.layout.learning.own_grades import (
    grades_text,
    grades_version,
    learn_more_grades,
    learned_grader,
)
from tests.core.layout.cells import CATALOGUE, brick_grid
from tests.core.layout.learning.test_grading import some

TEXT = written_grades(
    train_grades(some(54), np.random.default_rng(0), costs=[8.0], gammas=[0.5]), {"models": "five", "what": "a test"}
)


def learned(seed: int = 4, n: int = 7) -> str:
    """Return the samples so far and those of a sponge."""
    grid = brick_grid(np.where(np.random.default_rng(2).random((1, n, n)) < 0.8, 4, -2))
    rng = np.random.default_rng(seed)
    return learn_more_grades(TEXT, [grid], CATALOGUE, rng, names=["my\nsponge"], version=2)


@pytest.fixture(scope="module")
def more() -> str:
    """Return a new version."""
    return learned()


def test_a_new_version_has_all_samples_before_it(more: str) -> None:
    """The old samples come first, then as many new ones of each grade, none twice; C and gamma stay."""
    (old, facts), (new, said) = read_graded(TEXT), read_graded(more)
    n = len(old.grade)
    np.testing.assert_array_equal(new.energies[:n], old.energies)
    assert len(set(np.bincount(new.grade[n:], minlength=3).tolist())) == 1
    assert set(new.model[n:]) == {old.model.max() + 1}
    assert len(np.unique(new.energies, axis=0)) == len(new.grade) > n
    assert (said["C"], said["gamma"]) == (facts["C"], facts["gamma"])
    assert (grades_version(TEXT), grades_version(more)) == (1, 2)
    assert said["models"] == "those of version 1 (five), then my sponge"
    assert learned() == more


def test_the_chosen_file_decides(more: str, tmp_path: Path) -> None:
    """Without a file the shipped machine decides, with one its own."""
    path = tmp_path / "more.csv"
    path.write_text(more, encoding="utf-8")
    (own, facts), (built_in, _) = learned_grader(str(path)), learned_grader("")
    assert facts["version"] == "2"
    assert len(own.vectors) != len(built_in.vectors)


def test_wrong_files_are_refused(tmp_path: Path) -> None:
    """A missing file, and one of the fast layout, give a sentence each."""
    with pytest.raises(SettingsError, match="cannot be opened"):
        grades_text(str(tmp_path / "gone.csv"))
    other = tmp_path / "exchanges.csv"
    other.write_text("# C: 8\n# gamma: 8\nmodel,pays,units\n0,1,2\n", encoding="utf-8")
    with pytest.raises(SettingsError, match="for the learned layout"):
        grades_text(str(other))


def test_too_few_and_too_many_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """A model of a single stud teaches nothing; a full file takes no more."""
    with pytest.raises(BuildError, match="choose more or larger models"):
        learned(n=1)
    monkeypatch.setattr(own_grades, "MOST_SAMPLES", 60)
    with pytest.raises(BuildError, match="is full with 54 samples"):
        learned()
