"""Files of samples: none is changed, a new version has all before it, and what is no such file is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError, SettingsError
from legorize_addon.core.layout import lay
from legorize_addon.core.layout.learning import EACH, learned_more, learned_table, samples_text, version_of
from legorize_addon.core.layout.svm import LEVELS, read, shipped
from scripts.train_layout import built

from .cells import CATALOGUE, brick_grid


@pytest.fixture(scope="module")
def model():
    """Return a model that the shipped machine did not learn from."""
    return built("tower", 200)


@pytest.fixture(scope="module")
def more(model):
    """Return the shipped samples and those of the model."""
    rng = np.random.default_rng(4)
    return learned_more(samples_text(""), [model], CATALOGUE, rng, names=["my\ntower"], version=2)


def test_a_new_version_has_all_samples_before_it(more):
    """The new file begins with the old samples, then come those of the model, half of which pay."""
    (old, facts), (new, said) = read(samples_text("")), read(more)
    n = len(old.pays)
    for name in ("levels", "pays", "model"):
        np.testing.assert_array_equal(getattr(new, name)[:n], getattr(old, name))
    assert set(new.model[n:]) == {old.model.max() + 1}
    assert len(new.pays) == n + EACH
    assert new.pays[n:].sum() == EACH // 2
    assert (said["C"], said["gamma"]) == (facts["C"], facts["gamma"])
    assert (version_of(samples_text("")), version_of(more)) == (1, 2)
    assert said["models"].endswith("then my tower")
    assert "5 folds by model, micro F1" in said["cross-validation"]


def test_same_models_same_file(model, more):
    """The same seed gives the same file; the shipped one is as it was."""
    shipped_before = samples_text("")
    again = learned_more(shipped_before, [model], CATALOGUE, np.random.default_rng(4), names=["my tower"], version=2)
    assert again == more
    assert samples_text("") == shipped_before


def test_the_chosen_file_decides(more, model, tmp_path: Path):
    """Without a file the shipped machine proposes; another file proposes otherwise, and its layout is its own."""
    np.testing.assert_array_equal(learned_table(""), shipped())
    path = tmp_path / "more.csv"
    path.write_text(more, encoding="utf-8")
    table = learned_table(str(path))
    assert table.shape == LEVELS
    assert (table != shipped()).any()
    grid, _ = model

    def laid(**options):
        bricks = lay(grid, CATALOGUE, rng=np.random.default_rng(0), tier="fast", **options)
        return bricks.part.tolist(), bricks.corner.tolist()

    assert laid(table=shipped()) == laid()
    assert laid(table=np.zeros(LEVELS, dtype=bool)) == laid(learned=False) != laid()
    assert laid(table=table, learned=False) == laid(learned=False)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (None, "cannot be read as samples"),
        ("", "cannot be read as samples"),
        ("# C\n", "cannot be read as samples"),
        ("one,two\n1,x\n", "cannot be read as samples"),
        ("# C: 1.0\n0,1,0,8,2,5\n0,0,0,8,2,5\n", "lacks C, gamma"),
        ("# C: 1.0\n# gamma: 8.0\n0,1,0,8,2,5\n", "samples of both kinds"),
    ],
)
def test_what_is_no_file_of_samples_is_refused(text: str | None, words: str, tmp_path: Path):
    """A missing, empty or other file, and samples that nothing can be learned from, give a sentence."""
    path = tmp_path / "samples.csv"
    if text is not None:
        path.write_text(text, encoding="utf-8")
    with pytest.raises(SettingsError, match=words) as refused:
        learned_table(str(path))
    assert str(refused.value).endswith("or leave it empty.")


def test_too_small_models_are_refused():
    """A model in which nothing can be saved teaches nothing, which is said."""
    grid = brick_grid(np.full((1, 2, 4), 4))
    bricks = lay(grid, CATALOGUE, rng=np.random.default_rng(0))
    with pytest.raises(BuildError, match="0 samples of 30"):
        learned_more(samples_text(""), [(grid, bricks)], CATALOGUE, np.random.default_rng(0), names=["one"], version=2)
