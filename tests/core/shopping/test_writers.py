"""The lists that shops read, read back by readers of the standard library: every number the shop's own."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings

from legorize_addon.core.shopping import writers
from legorize_addon.core.shopping.lots import priced
from legorize_addon.core.shopping.shopping_list import shopping_list
from tests.core.shopping.wanted import CATALOGUE, assembly_of, bought, read_csv

unhurried = settings(deadline=None, max_examples=50)


def wanted_of(pairs, title="Fox", catalogue=CATALOGUE):
    """Return the list of bricks of the given (part row, LDraw code)."""
    return shopping_list(assembly_of(pairs, catalogue), title=title)


def by_shop(pairs, colour):
    """Return how many bricks of each (part number, colour number of a shop) there are."""
    rows = [
        (CATALOGUE.parts[row].number, getattr(CATALOGUE.colours[CATALOGUE.colour_row(code)], colour))
        for row, code in pairs
    ]
    return Counter(rows)


@unhurried
@given(bought)
def test_every_list_holds_every_brick(pairs):
    """Lot by lot, each list has the bricks of the model; BrickLink's also the spare ones that it tells of."""
    wanted = wanted_of(pairs)
    plain = read_csv(writers.plain_csv(wanted))
    assert Counter({(row["part"], int(row["colour"])): int(row["count"]) for row in plain}) == by_shop(pairs, "code")
    rows = read_csv(writers.rebrickable_csv(wanted))
    assert Counter({(row["Part"], int(row["Color"])): int(row["Quantity"]) for row in rows}) == by_shop(
        pairs, "rebrickable"
    )
    rows = read_csv(writers.studio_csv(wanted))
    studio = Counter({(row["BLItemNo"], int(row["BLColorId"])): int(row["Qty"]) for row in rows})
    assert studio == by_shop(pairs, "bricklink")
    assert sum(int(row["Qty"]) * float(row["Weight"]) for row in rows) == pytest.approx(wanted.mass)
    assert sum(float(row["mass_g"]) for row in plain) == pytest.approx(wanted.mass)
    found = Counter()
    for item in ElementTree.fromstring(writers.bricklink_xml(wanted)):
        fields = {field.tag: field.text for field in item}
        model, _, spare = fields["REMARKS"].removeprefix("Fox: ").partition(", ")
        assert int(fields["MINQTY"]) == int(model) + int((spare or "0").removesuffix(" spare"))
        found[fields["ITEMID"], int(fields["COLOR"])] += int(model)
    assert found == by_shop(pairs, "bricklink")


@unhurried
@given(bought)
def test_pick_a_brick_has_every_element(pairs):
    """Element by element, the order has the bricks of the model, with the older number beside the newest."""
    rows = read_csv(writers.pick_a_brick_csv(wanted_of(pairs)))
    found = Counter()
    for row in rows:
        found[int(row["elementId"])] += int(row["quantity"])
        place = np.argwhere(CATALOGUE.element == int(row["elementId"]))
        assert len(place) == 1
        assert int(row["secondElementId"] or 0) == CATALOGUE.second_element[tuple(place[0])]
    places = [(row, CATALOGUE.colour_row(code)) for row, code in pairs]
    wanted = Counter(int(CATALOGUE.element[place]) for place in places if CATALOGUE.element[place])
    assert found == wanted


@pytest.mark.parametrize(("count", "lines"), [(1, [1]), (999, [999]), (1000, [999, 1]), (2500, [999, 999, 502])])
def test_lines_above_the_shop_s_limit_are_split(count, lines):
    """No line orders more than 999 bricks, and none is lost."""
    rows = read_csv(writers.pick_a_brick_csv(wanted_of([(0, 4)] * count)))
    assert [(row["elementId"], int(row["quantity"])) for row in rows] == [("300521", number) for number in lines]


def test_each_shop_gets_its_own_colour_number():
    """Olive Green is 330 for LDraw, 155 for BrickLink and 326 for Rebrickable."""
    row = CATALOGUE.part_row("3001")
    wanted = wanted_of([(row, 330)] * 3)
    [lot] = wanted.lots
    [line] = read_csv(writers.plain_csv(wanted))
    assert line == {
        "part": "3001", "title": "Brick 2 x 4", "colour": "330", "colour_name": "Olive Green", "count": "3",
        "mass_g": "6.48", "element": str(lot.element), "second_element": str(lot.second_element or ""),
        "price": "", "cost": "",
    }  # fmt: skip
    assert writers.rebrickable_csv(wanted) == "Part,Color,Quantity\n3001,326,3\n"
    second = lot.second_element or ""
    assert writers.pick_a_brick_csv(wanted) == f"elementId,quantity,secondElementId\n{lot.element},3,{second}\n"
    [item] = ElementTree.fromstring(writers.bricklink_xml(wanted))
    assert {field.tag: field.text for field in item} == {
        "ITEMTYPE": "P", "ITEMID": "3001", "COLOR": "155", "MINQTY": "3", "CONDITION": "X", "REMARKS": "Fox: 3",
        "NOTIFY": "N",
    }  # fmt: skip
    [line] = read_csv(writers.studio_csv(wanted))
    assert line == {
        "BLItemNo": "3001", "ElementId": str(lot.element), "LdrawId": "3001", "PartName": "Brick 2 x 4",
        "BLColorId": "155", "LDrawColorId": "330", "ColorName": "Olive Green", "ColorCategory": "Solid Colors",
        "Qty": "3", "Weight": "2.16",
    }  # fmt: skip


@pytest.mark.parametrize(("number", "extra"), [("3005", 1), ("3024", 1), ("3004", 0), ("14716", 0)])
def test_small_parts_get_one_spare(number, extra):
    """A 1 x 1 brick or plate, which is easily lost, is bought once more; what is longer or taller is not."""
    [item] = ElementTree.fromstring(writers.bricklink_xml(wanted_of([(CATALOGUE.part_row(number), 15)] * 4)))
    fields = {field.tag: field.text for field in item}
    assert fields["MINQTY"] == str(4 + extra)
    assert fields["REMARKS"] == ("Fox: 4, 1 spare" if extra else "Fox: 4")


@pytest.mark.parametrize("title", ["", "<a&b>\x00\ud800]]>", "=1+1", "x" * 5000, "a\nb"])
def test_any_title_is_well_formed(title):
    """Whatever the model is called, the list begins with its root, can be encoded and parsed, and its remarks fit."""
    text = writers.bricklink_xml(wanted_of([(0, 4)], title))
    assert text.startswith("<INVENTORY")
    [item] = ElementTree.fromstring(text.encode("utf-8"))
    assert len({field.tag: field.text for field in item}["REMARKS"]) < 255


def test_wanted_list_has_no_declaration():
    """BrickLink's list starts with its root element, also when it is empty."""
    assert writers.bricklink_xml(wanted_of([])).startswith("<INVENTORY")


def test_prices_are_shown_where_they_are_known():
    """The table has the price of one brick and of the lot, and the totals their sum and what it leaves out."""
    wanted = wanted_of([(0, 4)] * 3 + [(1, 4)])
    assert "price" not in [row["figure"] for row in read_csv(writers.totals_csv(wanted))]
    wanted = replace(wanted, lots=priced(wanted.lots, lambda part, _: {"3005": 0.07}.get(part.number)))
    rows = read_csv(writers.plain_csv(wanted))
    assert [(row["price"], row["cost"]) for row in rows] == [("0.0700", "0.2100"), ("", "")]
    figures = {row["figure"]: row["value"] for row in read_csv(writers.totals_csv(wanted))}
    assert (figures["price"], figures["bricks_without_price"]) == ("0.2100", "1")


def test_totals_say_size_weight_and_time():
    """Of 133 bricks 1 x 1 in two colours in one place."""
    rows = read_csv(writers.totals_csv(wanted_of([(0, 4)] * 100 + [(0, 15)] * 33)))
    assert {row["figure"]: (row["value"], row["unit"]) for row in rows} == {
        "bricks": ("133", ""), "lots": ("2", ""), "parts": ("1", ""), "colours": ("2", ""), "mass": ("57.19", "g"),
        "studs_x": ("1", "studs"), "studs_y": ("1", "studs"), "plates": ("3", "plates"), "size_x": ("0.8", "cm"),
        "size_y": ("0.8", "cm"), "size_z": ("1.0", "cm"), "building_time": ("21", "min"),
    }  # fmt: skip
