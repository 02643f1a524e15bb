"""Whatever is chosen as a file of samples either can be learned from, or is refused with one sentence."""

from __future__ import annotations

import os
import re
from pathlib import Path

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError, SettingsError
from legorize_addon.core.layout.learning.own_samples import learned_table, samples_text
from legorize_addon.core.layout.learning.sample_file import MOST_BYTES, MOST_SAMPLES, _shown, facts_and_rows, text_of
from legorize_addon.core.layout.learning.svm import LEVELS, Machine, read, table_of
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.solids import box

HEAD = "# C: 1.0\n# gamma: 8.0\nmodel,pays,units,hold,cuts,area\n"
ROWS = "0,1,0,8,2,5\n0,0,3,8,2,9\n"
GOOD = HEAD + ROWS

TEXTS = {
    "empty": ("", "is empty"),
    "blank": (" \n\n", "is empty"),
    "words": ("one,two\n1,x\n", "has 2 columns in line 1, where model,pays,units,hold,cuts,area are expected"),
    "comment": ("# C\n" + GOOD, "line 1 that begins with #"),
    "no table": ("# C: 1.0\n# gamma: 8.0\n", "has no samples"),
    "no gamma": ("# C: 1.0\n" + ROWS, "has no value for gamma"),
    "no C": ("# gamma: 1.0\n" + ROWS, "has no value for C"),
    **{
        f"C {value}": (GOOD.replace("C: 1.0", f"C: {value}"), "for C, where a number from 1e-06 to 1e\\+06 is needed")
        for value in ("abc", "", "nan", "inf", "-inf", "0", "-1.0", "1e300", "1e-300", "1,0", "64.0,,,,")
    },
    **{
        f"gamma {value}": (GOOD.replace("gamma: 8.0", f"gamma: {value}"), f"'{value}' for gamma")
        for value in ("abc", "nan", "inf", "0", "-1.0", "1e300")
    },
    "two values": ("# C: 2.0\n" + GOOD, "gives two different values for 'C'"),
    "version": ("# version: two\n" + GOOD, "has 'two' for version"),
    "version below": ("# version: -2\n" + GOOD, "has '-2' for version"),
    "missing column": (HEAD + "0,1,0,8,2\n0,0,3,8,2\n", "has 5 columns in line 4"),
    "extra column": (GOOD + "0,0,3,8,2,9,1\n", "has 7 columns in line 6"),
    "half a row": (GOOD + "0,0,3", "has 3 columns in line 6"),
    "other columns": (
        GOOD.replace("units,hold", "hold,units"),
        "has its columns in line 3 in a wrong order, instead of model,pays",
    ),
    "semicolons": (HEAD + ROWS.replace(",", ";"), "has 1 column in line 4"),
    "level above": (HEAD + "0,1,4,8,2,5\n" + ROWS, "has '4' for units in line 4, where a whole number from 0 to 3"),
    "level below": (GOOD + "0,1,0,-1,2,5\n", "has '-1' for hold in line 6"),
    "level far above": (GOOD + "0,1,0,8,70000,5\n", "has '70000' for cuts"),
    "level endless": (GOOD + f"0,1,0,8,2,{'9' * 5000}\n", "for area in line 6"),
    "fraction": (GOOD + "0,1,0,8.5,2,5\n", "has '8.5' for hold"),
    "no number": (GOOD + "0,1,0,nan,2,5\n", "has 'nan' for hold"),
    "other digits": (GOOD + "0,1,0,\u0668,2,5\n", "for hold in line 6"),
    "label": (GOOD + "0,2,0,8,2,5\n", "has '2' for pays"),
    "word for a label": (GOOD + "0,yes,0,8,2,5\n", "has 'yes' for pays"),
    "model": (GOOD + "40000,1,0,8,2,5\n", "has '40000' for model"),
    "model below": (GOOD + "-1,1,0,8,2,5\n", "has '-1' for model"),
    "one kind": (HEAD + "0,1,0,8,2,5\n" * 3, "has 3 samples of one kind"),
    "contradictions": (HEAD + ROWS + "0,0,0,8,2,5\n0,1,3,8,2,9\n", "contradict each other"),
    "too many": (HEAD + ROWS * (MOST_SAMPLES // 2 + 1), f"has more than {MOST_SAMPLES} samples"),
    "too large": (GOOD + "\n" * MOST_BYTES, "is larger than 2 MB"),
}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where a file may be written."""
    return tmp_path / "samples.csv"


def refusal(path: Path | str) -> str:
    """Return the sentence with which a file is refused."""
    with pytest.raises(SettingsError) as refused:
        learned_table(str(path))
    sentence = str(refused.value)
    assert sentence.startswith(f"learned_from is {str(path)!r}, which ")
    assert sentence.endswith(": choose a file that Learn from Models wrote, or leave it empty.")
    assert "\n" not in sentence
    assert len(sentence) < 300 + len(str(path))
    return sentence


@pytest.mark.parametrize("name", TEXTS)
def test_a_wrong_text_is_refused(name: str, path: Path):
    """One sentence says what is wrong, and in which line."""
    text, words = TEXTS[name]
    path.write_text(text, encoding="utf-8")
    assert re.search(words, refusal(path))


@pytest.mark.parametrize(
    "content",
    [
        b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 20,
        GOOD.encode("utf-16"),
        ("# models: caf\xe9\n" + GOOD).encode("latin-1"),
        b"\xff" * 100,
    ],
)
def test_what_is_no_text_is_refused(content: bytes, path: Path):
    """Pictures and other encodings are told apart from text."""
    path.write_bytes(content)
    assert "is not text in UTF-8" in refusal(path)


def test_null_bytes_are_refused(path: Path):
    """They are text in UTF-8, but no sample."""
    path.write_bytes(b"\0" * 1000)
    assert "in line 1" in refusal(path)


def test_what_is_no_file_is_refused(tmp_path: Path):
    """Folders, devices without an end, pipes nobody writes to, links in a circle, missing files, impossible names."""
    pipe, circle = tmp_path / "pipe", tmp_path / "circle"
    os.mkfifo(pipe)
    circle.symlink_to(circle)
    assert "is a folder" in refusal(tmp_path)
    assert "is a device or a pipe" in refusal(pipe)
    assert "is a device or a pipe" in refusal("/dev/zero")
    assert "cannot be opened" in refusal(circle)
    assert "cannot be opened" in refusal(tmp_path / "gone.csv")
    assert "cannot be opened" in refusal("x" * 5000)
    assert "has a character in its name" in refusal("a\0b")


def test_a_file_that_may_not_be_read_is_refused(path: Path, monkeypatch: pytest.MonkeyPatch):
    """The reason of the system is told."""
    path.write_text(GOOD, encoding="utf-8")

    def denied(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", denied)
    assert "cannot be opened (Permission denied)" in refusal(path)


def test_a_large_file_is_not_read(path: Path):
    """Ten gigabytes of nothing are refused after the first two megabytes."""
    with path.open("wb") as file:
        file.truncate(10 * 1024**3)
    assert "is larger than 2 MB" in refusal(path)


@pytest.mark.parametrize("text", ["\ufeff" + GOOD, GOOD.replace("\n", "\r\n"), GOOD.replace(",", " , ") + "\n\n"])
def test_what_other_programs_make_of_a_good_file_is_read(text: str, path: Path):
    """A byte order mark, other line ends and blanks change nothing."""
    path.write_bytes(text.encode())
    np.testing.assert_array_equal(learned_table(str(path)), table_of(GOOD))


def test_samples_that_stand_there_several_times_weigh_more():
    """Repeated and contradicting rows are what models give; most of them decide."""
    level = (0, 8, 2, 5)
    assert level in {tuple(row) for row in read(GOOD)[0].levels.tolist()}
    against = HEAD + ROWS * 5 + "0,0,0,8,2,5\n" * 2
    assert table_of(against)[level]
    assert not table_of(HEAD + ROWS * 2 + "0,0,0,8,2,5\n" * 5)[level]


def test_equal_samples_are_learned_as_one():
    """Ten times the same samples with a tenth of the cost give the machine of the samples once."""
    samples, _ = read(samples_text(""))
    points = np.stack(np.unravel_index(np.arange(0, np.prod(LEVELS), 7), LEVELS), axis=1).astype(np.int16)
    once = Machine.of(samples, c=8.0, gamma=0.5)
    often = Machine.of(samples.take(np.repeat(np.arange(len(samples.pays)), 10)), c=0.8, gamma=0.5)
    np.testing.assert_allclose(often.decision(points), once.decision(points), atol=1e-3)
    assert len(often.svc.dual_coef_[0]) <= len(np.unique(np.column_stack([samples.levels, samples.pays]), axis=0))


def test_a_fitting_without_an_end_is_told(path: Path, monkeypatch: pytest.MonkeyPatch):
    """Parameters for which the machine does not settle give a sentence after a bounded number of steps."""
    monkeypatch.setattr("legorize_addon.core.layout.learning.svm._MOST_STEPS", 2000)
    path.write_text(re.sub("(?m)^# C: .*$", "# C: 8192", samples_text("")), encoding="utf-8")
    with pytest.raises(BuildError, match="does not converge with C = 8192 and gamma = 8"):
        learned_table(str(path))


@pytest.mark.parametrize(("layout", "learned"), [("fast", True), ("fast", False), ("standard", True), ("exact", True)])
def test_a_wrong_file_is_refused_before_the_work(layout: str, learned: bool, path: Path):
    """The file is read before the mesh is, also where its samples are not asked for."""
    path.write_text("nothing", encoding="utf-8")
    chosen, begun = Settings(layout=layout, learned=learned, learned_from=str(path)), []
    with pytest.raises(SettingsError, match="learned_from"):
        legorize(box(), chosen, lambda stage, _: begun.append(stage))
    assert not begun


@pytest.mark.parametrize(("length", "shown"), [(19, "x" * 19), (20, "x" * 20), (21, "x" * 17 + "...")])
def test_long_values_are_cut_to_twenty_characters(length, shown):
    """A value from a file is shown whole if it is short."""
    assert _shown("x" * length) == repr(shown)


def test_a_file_of_samples():
    """What is written is read: facts and rows."""
    text = text_of({"C": "1.0", "gamma": "2.0", "what": "a test"}, ("model", "a"), [[0, 3], [1, 4]])
    facts, rows = facts_and_rows(text, ("model", "a"), (10, 10))
    assert facts["what"] == "a test"
    assert rows.tolist() == [[0, 3], [1, 4]]
