"""Every list and LDraw file of a run, read by a few lines of the standard library: what each says of each lot.

A lot is the number of a part and LDraw's code of its colour; shops' numbers of colours and elements are looked up in
the assets, which are read here as they lie on the disk.
"""

from __future__ import annotations

import csv
import io
from collections import Counter
from xml.etree import ElementTree

from legorize_addon.core.model.catalogue import ASSETS

SMALL = {"3005", "3024"}
"""The 1 x 1 brick and plate, of which one is spare."""


def rows_of(text):
    """Return the rows of a CSV text."""
    return list(csv.DictReader(io.StringIO(text)))


def colours_by(column):
    """Return LDraw's code by a shop's number of a colour."""
    rows = rows_of((ASSETS / "colours.csv").read_text(encoding="utf-8"))
    return {row[column]: int(row["code"]) for row in rows}


def ldr_lots(text):
    """Count the parts of an LDraw model or document; sub-models as often as they are called from the first one."""
    models, name = {"": []}, ""
    for line in text.splitlines():
        words = line.split()
        if words[:2] == ["0", "FILE"]:
            name = " ".join(words[2:])
            models[name] = []
        elif words[:1] == ["1"]:
            models[name].append((int(words[1]), " ".join(words[14:])))
    names = [each for each in models if each or models[each]]

    def unfold(model):
        """Count the parts of a model."""
        found = Counter()
        for colour, called in models[model]:
            if called in models:
                found.update(unfold(called))
            else:
                found[called.removesuffix(".dat"), colour] += 1
        return found

    return unfold(names[0])


def order_lots(text):
    """Count what is placed and what is taken out again by the building order."""
    placed, removed = Counter(), Counter()
    for row in rows_of(text):
        words = row["ldraw"].split()
        if words:
            {"place": placed, "remove": removed}[row["action"]][words[14].removesuffix(".dat"), int(words[1])] += 1
    return placed, removed


def list_lots(files, prefix):
    """Return what each list says of each lot, by its name; lists that are not there say nothing.

    BrickLink's is without the spare ones, which are checked here, and Pick a Brick's without parts that it has no
    number for, whose lines may not be longer than its shop takes.
    """
    found = {}
    plain = rows_of(files.get(f"{prefix}parts.csv", "part"))
    found["parts.csv"] = Counter({(row["part"], int(row["colour"])): int(row["count"]) for row in plain})
    codes = colours_by("rebrickable")
    rows = rows_of(files.get(f"{prefix}rebrickable.csv", "Part"))
    found["rebrickable.csv"] = Counter({(row["Part"], codes[row["Color"]]): int(row["Quantity"]) for row in rows})
    rows = rows_of(files.get(f"{prefix}studio.csv", "Qty"))
    found["studio.csv"] = Counter({(row["LdrawId"], int(row["LDrawColorId"])): int(row["Qty"]) for row in rows})
    codes, wanted = colours_by("bricklink"), Counter()
    for item in ElementTree.fromstring(files.get(f"{prefix}bricklink.xml", "<INVENTORY/>")):
        field = {each.tag: each.text for each in item}
        wanted[field["ITEMID"], codes[field["COLOR"]]] += int(field["MINQTY"]) - (field["ITEMID"] in SMALL)
    found["bricklink.xml"] = wanted
    lot_of = {row["element"]: (row["part"], int(row["colour"])) for row in plain if row["element"]}
    bought = Counter({lot: found["parts.csv"][lot] for lot in set(found["parts.csv"]) - set(lot_of.values())})
    for row in rows_of(files.get(f"{prefix}pick-a-brick.csv", "quantity")):
        assert 1 <= int(row["quantity"]) <= 999
        bought[lot_of[row["elementId"]]] += int(row["quantity"])
    found["pick-a-brick.csv"] = bought
    return found


def check_sums(files, facts):
    """Check that all lists, files and figures of a run tell of the same bricks, lot by lot, supports apart."""
    model, everything = ldr_lots(files["model.ldr"]), ldr_lots(files["model.mpd"])
    placed, removed = order_lots(files["build_order.csv"])
    assert placed == everything
    assert placed - removed == model
    assert removed - placed == Counter()
    for prefix, lots in (("", model), ("support-", removed)):
        for name, said in list_lots(files, prefix).items():
            assert said == lots, prefix + name
        totals = {row["figure"]: row["value"] for row in rows_of(files.get(f"{prefix}totals.csv", "figure"))}
        assert int(totals.get("bricks", 0)) == lots.total()
        assert int(totals.get("lots", 0)) == len(lots)
    by_part, by_colour = Counter(), Counter()
    for (part, colour), count in model.items():
        by_part[part] += count
        by_colour[str(colour)] += count
    assert facts["counts"]["bricks"] == model.total()
    assert Counter(facts["counts"]["by_part"]) == by_part
    assert Counter(facts["counts"]["by_colour"]) == by_colour
    assert facts["supports"]["removed"] == removed.total()
    mass = sum(float(row["mass_g"]) for row in rows_of(files["parts.csv"]))
    assert abs(facts["mass_g"] - mass) <= 0.01 * len(model)
    no_number = {(each["part"], each["colour"]): each["count"] for each in facts["unknown_elements"]["pairs"]}
    plain = rows_of(files["parts.csv"])
    assert no_number == {(row["part"], int(row["colour"])): int(row["count"]) for row in plain if not row["element"]}
    if facts["price"]:
        cost = sum(float(row["cost"]) for row in plain if row["cost"])
        assert abs(facts["price"]["model"] - cost) <= 0.01 * len(model)
