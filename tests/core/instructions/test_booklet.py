"""The booklet as a whole."""

from __future__ import annotations

import hashlib
import re
from xml.etree import ElementTree

import pytest

from legorize_addon.core.building import steps_of
from legorize_addon.core.errors import Cancelled
from legorize_addon.core.instructions import booklet
from legorize_addon.core.instructions.booklet import Booklet, Unfinished
from legorize_addon.core.instructions.layer_maps import layer_files, layer_pages
from legorize_addon.core.instructions.panels import Panels
from legorize_addon.core.instructions.paper import PAPERS
from legorize_addon.core.instructions.pdf import _written
from legorize_addon.core.instructions.svg import svg
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from tests.core.any_bricks import CATALOGUE, table
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


@pytest.mark.parametrize("at", [0.1, 0.36, 0.6, 0.9])
@pytest.mark.parametrize("model", [arm, pair])
def test_what_was_stopped_goes_on(model, at, tmp_path, monkeypatch):
    """No page is drawn twice, no step is looked at twice, and the files are those of a run that was not stopped."""
    booklet_of(model()).write(tmp_path / "whole.html", tmp_path / "whole.pdf")
    n_pages = len(list(booklet_of(model()).pages()))
    written, looked = [], []
    content, scenes = booklet.content_of, Panels._scenes
    monkeypatch.setattr(booklet, "content_of", lambda page: written.append(page.title) or content(page))

    def look(self, shot, first):
        looked.append((shot.step.number, shot.submodel))
        return scenes(self, shot, first)

    monkeypatch.setattr(Panels, "_scenes", look)

    def stop(stage, share):
        if share >= at:
            raise Cancelled

    desk = Unfinished()
    with pytest.raises(Cancelled):
        desk.write(booklet_of(model()), tmp_path / "a.html", tmp_path / "a.pdf", stop)
    n_before, n_looked = len(written), len(looked)
    desk.write(booklet_of(model()), tmp_path / "a.html", tmp_path / "a.pdf")
    assert n_before >= 3
    assert len(written) == n_pages
    assert len(looked) == len(set(looked)) >= n_looked
    for suffix in ("html", "pdf"):
        assert (tmp_path / f"a.{suffix}").read_bytes() == (tmp_path / f"whole.{suffix}").read_bytes()


def test_another_booklet_begins_anew(tmp_path):
    """Pages of another model, name or paper are never taken over; nor are those of one that is finished."""
    made = [booklet_of(arm()), booklet_of(arm(), "Letter"), booklet_of(pair()), booklet_of(arm())]
    assert len({each.fingerprint for each in made}) == 3
    assert made[0].fingerprint == made[3].fingerprint

    def stop(stage, share):
        if share > 0.5:
            raise Cancelled

    desk = Unfinished()
    with pytest.raises(Cancelled):
        desk.write(made[0], None, tmp_path / "a.pdf", stop)
    desk.write(made[2], None, tmp_path / "a.pdf")
    made[2].write(None, tmp_path / "b.pdf")
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()


def test_progress_goes_from_0_to_the_end():
    """It never goes back."""
    told = []
    list(booklet_of(arm()).pages(lambda _, share: told.append(share)))
    assert told == sorted(told)
    assert told[0] == 0.0
    assert told[-1] > 0.9


LOOKS = {
    "booklet": "b5c22eb6a2ecf834",
    "letter": "224f3c0efd458236",
    "print": "c6e3537cd768b3d9",
    "maps": "1702066b920b4d47",
    "actual size": "f92504fa044bd8ba",
    "viewer": "03f21d620ad213be",
}
"""What the pages of a small model look like, as digests. Margins, sizes of texts and colours are choices: who changes
one looks at the pages that the test below has written, and puts the new digest here."""


def gate():
    """Return a gate of many kinds of parts and colours: on supports, with what hangs, and a piece put on at the end."""
    part = {part.number: row for row, part in enumerate(CATALOGUE.parts)}
    corners = [(10 * x, 2 * y) for x in (0, 1) for y in (0, 1)]
    rows = [
        *((part["3003"], *corner, 3 * z, 0, (4, 0, 15)[z % 3], 0, 0, 0) for corner in corners for z in range(4)),
        *((part["3007"], 0, 2 * y, 12, 0, 14, 0, 0, 0) for y in (0, 1)),
        *((part["3010"], 8, y, 12, 0, 2, 0, 0, 0) for y in range(4)),
        *((part["3024"], 5, 3 * y, 11, 0, 1, 0, 0, 0) for y in (0, 1)),
        *((part["3005"], 7, 2 * y, 3 * z, 0, 72, int(Role.SUPPORT_OUTSIDE), 0, 0) for y in (0, 1) for z in range(4)),
        *((part["3001"], 4 * x, 2 * y, 15, 0, 25, 0, 1, 0) for x in range(3) for y in (0, 1)),
        *((part["3020"], 2 + 4 * x, 2 * y, 18, 0, 71, 0, 1, 0) for x in range(2) for y in (0, 1)),
        (part["3024"], 0, 0, 18, 0, 19, 0, 1, 0),
    ]  # fmt: skip
    return table(rows)


def test_pages_look_as_they_did(tmp_path):
    """Booklet, layer maps and the page in three dimensions of a small model are drawn to the last number as before."""
    bricks = gate()
    temporary = bricks.role == Role.SUPPORT_OUTSIDE
    steps = steps_of(Assembly(bricks, CATALOGUE))
    made = [
        Booklet(bricks, CATALOGUE, steps, temporary=temporary, title="Gate", paper=PAPERS[paper])
        for paper in ("A4", "Letter")
    ]
    pages = list(made[0].pages())
    maps = [
        layer_pages(bricks, CATALOGUE, temporary=temporary, paper=PAPERS["A4"], actual_size=actual)
        for actual in (False, True)
    ]
    texts = {
        "booklet": "\n".join(map(svg, pages)),
        "letter": "\n".join(map(svg, made[1].pages())),
        "print": "\n".join(part.decode("latin-1") for page in pages for part in _written(page.items)),
        "maps": "".join(text for _, text in layer_files(maps[0])),
        "actual size": "".join(text for _, text in layer_files(maps[1])),
        "viewer": made[0]._viewer(dict.fromkeys(range(len(steps)), 1)),
    }
    found = {name: hashlib.sha256(text.encode()).hexdigest()[:16] for name, text in texts.items()}
    if found != LOOKS:
        made[0].write(tmp_path / "gate.html", tmp_path / "gate.pdf")
    assert found == LOOKS, f"pages look different: look at {tmp_path}, and if they shall, put these digests into LOOKS"
