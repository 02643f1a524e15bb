"""The booklet as a whole."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest

from legorize_addon.core.errors import Cancelled
from legorize_addon.core.instructions.booklet import Booklet
from legorize_addon.core.instructions.paper import PAPERS
from tests.core.any_bricks import CATALOGUE
from tests.core.instructions.built import arm, pair


def booklet_of(plan, paper="A4"):
    """Return the booklet of a model."""
    return Booklet(plan.bricks, CATALOGUE, plan.steps, temporary=plan.temporary, title="Arm & co", paper=PAPERS[paper])


@pytest.mark.parametrize("paper", PAPERS)
@pytest.mark.parametrize("model", [arm, pair])
def test_both_files_have_the_same_pages(model, paper, tmp_path):
    """There is a page in the one for each in the other, of the paper that was asked for."""
    html, pdf = tmp_path / "a.html", tmp_path / "a.pdf"
    booklet_of(model(), paper).write(html, pdf)
    text = html.read_text(encoding="utf-8")
    drawn = re.findall(r"<svg .*?</svg>", text, re.DOTALL)
    assert pdf.read_bytes().startswith(b"%PDF")
    assert len(drawn) == len(list(booklet_of(model(), paper).pages()))
    wide, high = PAPERS[paper]
    for each in drawn:
        root = ElementTree.fromstring(each)
        assert root.get("width") == f"{wide:g}mm"
        assert root.get("height") == f"{high:g}mm"
    names = re.findall(r'id="([^"]+)"', text)
    assert len(names) == len(set(names))
    used = set(re.findall(r'(?:href="#|url\(#)([^")]+)', text))
    assert used <= set(names)


def test_one_file_alone(tmp_path):
    """Either file can be left out, and the same model gives the same files."""
    for name in ("one", "two"):
        booklet_of(pair()).write(tmp_path / f"{name}.html", None)
        booklet_of(pair()).write(None, tmp_path / f"{name}.pdf")
    assert (tmp_path / "one.html").read_bytes() == (tmp_path / "two.html").read_bytes()
    assert (tmp_path / "one.pdf").read_bytes() == (tmp_path / "two.pdf").read_bytes()
    assert len(list(tmp_path.iterdir())) == 4


def test_it_can_be_stopped(tmp_path):
    """A word of progress may end it."""

    def stop(stage, share):
        if share > 0.3:
            raise Cancelled

    with pytest.raises(Cancelled):
        booklet_of(arm()).write(tmp_path / "a.html", tmp_path / "a.pdf", stop)
    assert not (tmp_path / "a.pdf").exists()


def test_progress_goes_from_0_to_the_end():
    """It never goes back."""
    told = []
    list(booklet_of(arm()).pages(lambda _, share: told.append(share)))
    assert told == sorted(told)
    assert told[0] == 0.0
    assert told[-1] > 0.9
