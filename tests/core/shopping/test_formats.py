"""The table of formats, and which lists a model gets."""

from __future__ import annotations

from dataclasses import replace

from legorize_addon.core.shopping.formats import FORMATS, list_texts
from legorize_addon.core.shopping.shopping_list import shopping_list
from tests.core.shopping.wanted import CATALOGUE, assembly_of, read_csv

NOTHING = shopping_list(assembly_of([]))


def test_formats_have_names_of_their_own():
    """No two formats share key, label or file, and each file says what it is by its end."""
    for name in ("key", "label", "file"):
        assert len({getattr(kind, name) for kind in FORMATS}) == len(FORMATS)
    assert {kind.file.split(".")[-1] for kind in FORMATS} == {"csv", "xml"}


def test_every_format_is_written():
    """A model gets a list in each format, and one with supports a second one of these."""
    model, supports = (shopping_list(assembly_of([(0, 4)] * count)) for count in (3, 2))
    names = {kind.file for kind in FORMATS}
    assert set(list_texts(model, NOTHING)) == names
    texts = list_texts(model, supports)
    assert set(texts) == names | {f"support-{name}" for name in names}
    for name, count in (("parts.csv", "3"), ("support-parts.csv", "2")):
        assert [row["count"] for row in read_csv(texts[name])] == [count]


def test_nothing_to_buy_gives_no_list():
    """No bricks, no lists: an empty file would be taken for one that got lost."""
    assert list_texts(NOTHING, NOTHING) == {}


def test_lot_without_element_number_is_left_out_and_named():
    """A lot whose number is not known is in every list but one, which names it; alone, it makes no such list."""
    element = CATALOGUE.element.copy()
    element[0, CATALOGUE.colour_row(4)] = 0
    gap = replace(CATALOGUE, element=element)
    [shop] = [kind for kind in FORMATS if kind.key == "pick-a-brick"]
    wanted = shopping_list(assembly_of([(0, 4), (0, 4), (1, 4)], gap))
    assert [(lot.part.number, lot.count) for lot in shop.left_out(wanted)] == [("3005", 2)]
    assert [row["quantity"] for row in read_csv(shop.text(wanted))] == ["1"]
    assert not [kind for kind in FORMATS if kind != shop and kind.left_out(wanted)]
    alone = shopping_list(assembly_of([(0, 4)], gap))
    assert shop.file not in list_texts(alone, NOTHING)
