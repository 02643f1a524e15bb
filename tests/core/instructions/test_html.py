"""The booklet as one file."""

from __future__ import annotations

import re
from html.parser import HTMLParser

from legorize_addon.core.instructions.canvas import Page, Text
from legorize_addon.core.instructions.html import html_file
from legorize_addon.core.instructions.svg import svg


class Reader(HTMLParser):
    """Collects names of elements, links and addresses."""

    def __init__(self):
        """Begin with nothing."""
        super().__init__()
        self.names, self.links, self.sources, self.open = [], [], [], []

    def handle_starttag(self, tag, attrs):
        """Note an element."""
        found = dict(attrs)
        self.names += [found["id"]] if "id" in found else []
        self.links += [found["href"]] if tag == "a" else []
        self.sources += [found["src"]] if "src" in found else []
        if tag not in ("meta", "input", "path", "use"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        """Close an element; those inside must be closed."""
        if tag not in ("path", "use"):
            assert self.open.pop() == tag


def file_of(title="Box", data='{"a":1}'):
    """Return a file of a few pages, and what it was asked for."""
    asked = []
    pages = [
        Page(10, 10, [Text("x", 0, 0, 1)], "Cover"),
        Page(10, 10, [], "Parts"),
        Page(10, 10, [], "Step 1", 0),
        Page(10, 10, [], "Step 4", 3),
        Page(10, 10, [], "Layer maps"),
        Page(10, 10, [], "Finished"),
    ]

    def viewer(shown):
        asked.append(dict(shown))
        return data

    drawn = [(page, svg(page, name=f"p{number}-")) for number, page in enumerate(pages)]
    return "".join(html_file(drawn, title, viewer, 5)), asked


def test_links_lead_to_pages():
    """Every link of the bar leads to a page, and no name is there twice."""
    text, asked = file_of()
    reader = Reader()
    reader.feed(text)
    assert not reader.open
    assert len(reader.names) == len(set(reader.names))
    assert {"step-1", "step-4", "parts", "layer-maps", "finished", "viewer", "bricks"} <= set(reader.names)
    assert all(link.removeprefix("#") in reader.names for link in reader.links)
    assert asked == [{0: 0, 1: 0, 2: 0, 3: 3, 4: 3}]


def test_nothing_is_loaded_from_elsewhere():
    """The file needs no other file and no network."""
    text, _ = file_of()
    reader = Reader()
    reader.feed(text)
    assert not reader.sources
    addresses = set(re.findall(r"\w+://[\w./]+", text))
    assert addresses == {"http://www.w3.org/2000/svg"}
    assert "@import" not in text
    assert "url(" not in text.split("</style>")[0]


def test_names_do_no_harm():
    """Whatever a model is called is text, and does not end the script."""
    text, _ = file_of("</title><script>alert(1)</script>", '{"names":["</script>"]}')
    assert "<script>alert" not in text
    assert text.count("</script>") == 2
