"""Files of samples: none is changed, and a new version has all before it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.layout.lay import lay
from legorize_addon.core.layout.learning import own_samples
from legorize_addon.core.layout.learning.own_samples import EACH, learn_more, learned_table, samples_text, version_of
from legorize_addon.core.layout.learning.sample_file import MOST_SAMPLES
from legorize_addon.core.layout.learning.svm import LEVELS, NO_EXCHANGES, read, shipped
from legorize_addon.core.layout.learning.svm_training import train
from scripts.research.training_models import built
from tests.core.layout.cells import CATALOGUE, brick_grid


@pytest.fixture(scope="module")
def model():
    """Return a model that the shipped machine did not learn from."""
    return built("tower", 200)


@pytest.fixture(scope="module")
def more(model):
    """Return the shipped samples and those of the model."""
    rng = np.random.default_rng(4)
    return learn_more(samples_text(""), [model], CATALOGUE, rng, names=["my\ntower"], version=2)


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
    again = learn_more(shipped_before, [model], CATALOGUE, np.random.default_rng(4), names=["my tower"], version=2)
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

    assert laid(exchanges=shipped()) == laid()
    assert laid(exchanges=NO_EXCHANGES) != laid()


def test_too_small_models_are_refused():
    """A model in which nothing can be saved teaches nothing, which is said."""
    grid = brick_grid(np.full((1, 2, 4), 4))
    bricks = lay(grid, CATALOGUE, rng=np.random.default_rng(0))
    with pytest.raises(BuildError, match="0 samples of 30"):
        learn_more(samples_text(""), [(grid, bricks)], CATALOGUE, np.random.default_rng(0), names=["one"], version=2)


def test_a_full_file_is_not_learned_on(model):
    """A file takes no more samples than may be read again, which is said before the work."""
    table = samples_text("").splitlines()
    rows = [line for line in table if line[:1].isdigit()]
    full = "\n".join([*table, *(rows * 20)[: MOST_SAMPLES - len(rows)]])
    with pytest.raises(BuildError, match=f"full with {MOST_SAMPLES} samples"):
        learn_more(full, [model], CATALOGUE, np.random.default_rng(0), names=["one"], version=2)


@pytest.mark.parametrize(("name", "room"), [("MOST_SAMPLES", 20 + EACH), ("MOST_MODELS", 6)])
def test_a_file_is_filled_up_to_its_limits(model, monkeypatch, name, room):
    """Twenty samples of five models and those of one more fit just in; with room for one less they do not."""
    rows = [f"{number},{pays},0,{number + 4},{pays},2" for number in range(5) for pays in (0, 1, 0, 1)]
    text = "\n".join(["# C: 1.0", "# gamma: 1.0", *rows])

    def drawn(*_):
        raise InterruptedError("it fits")

    monkeypatch.setattr(own_samples, "samples_of", drawn)
    for limit, told in ((room, InterruptedError), (room - 1, BuildError)):
        monkeypatch.setattr(own_samples, name, limit)
        with pytest.raises(told, match=r"it fits|full with 20 samples"):
            learn_more(text, [model], CATALOGUE, np.random.default_rng(0), names=["one"], version=2)


def test_folds_of_one_kind_can_be_judged(model):
    """Where all samples that pay are from one model, the machine that never saw it takes nothing for paying."""
    rows = [f"{number},{int(number == 0)},0,{number + 4},1,2" for number in range(5) for _ in range(4)]
    text = "\n".join(["# C: 1.0", "# gamma: 1.0", *rows])
    more = learn_more(text, [model], CATALOGUE, np.random.default_rng(0), names=["one"], version=2)
    assert len(read(more)[0].pays) == len(rows) + EACH
    samples = read(text)[0]
    trained = train(samples, np.random.default_rng(0), costs=[1.0], gammas=[1.0])
    assert trained.confusion.tolist() == [[16, 0], [4, 0]]
