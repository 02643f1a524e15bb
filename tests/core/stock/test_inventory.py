"""Inventories of owned parts, added up over files of several programs."""

from __future__ import annotations

import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.stock.inventory import read_owned
from tests.core.any_bricks import CATALOGUE

RED_BRICK = CATALOGUE.part_row("3001"), CATALOGUE.colour_row(4)


def written(folder, *texts):
    """Return the paths of files with some texts."""
    paths = [folder / f"{number}.csv" for number in range(len(texts))]
    for path, text in zip(paths, texts, strict=True):
        path.write_text(text, encoding="utf-8")
    return [str(path) for path in paths]


def test_files_are_added_up(tmp_path):
    """Rebrickable, BrickLink and Studio count together; parts that we do not build with are counted apart."""
    found = read_owned(
        written(
            tmp_path,
            "Part,Color,Quantity,Is Spare\n3001,4,2,False\n3001,4,1,True\n3626,14,5,False\n",
            "<INVENTORY><ITEM><ITEMTYPE>P</ITEMTYPE><ITEMID>3001</ITEMID><COLOR>5</COLOR><MINQTY>4</MINQTY></ITEM>"
            "<ITEM><ITEMTYPE>M</ITEMTYPE><ITEMID>3001</ITEMID><COLOR>5</COLOR><MINQTY>9</MINQTY></ITEM></INVENTORY>",
            "BLItemNo,ElementId,LdrawId,PartName,BLColorId,LDrawColorId,ColorName,ColorCategory,Qty,Weight\n"
            "3001,,3001,Brick 2 x 4,5,4,Red,Solid Colors,8,2.16\n",
        ),
        CATALOGUE,
    )
    assert (found.count[RED_BRICK], found.count.sum(), found.others) == (15, 15, 14)


def test_the_same_file_twice_counts_twice(tmp_path):
    """Two boxes of one kind are one file given twice."""
    [path] = written(tmp_path, "part,colour,quantity\n3001,4,2\n")
    assert read_owned([path, path], CATALOGUE).count[RED_BRICK] == 4


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("part,colour\n3001,4\n", "no column for a quantity"),
        ("part,colour,quantity\n3001,4,many\n", "'many' for a quantity in row 2"),
        ("part,colour,quantity\n3001,4,1.5\n", "'1.5' for a quantity"),
        ("part,colour,quantity\n9999,4,3\n", "none of the 28 parts"),
    ],
)
def test_bad_files_get_one_sentence(tmp_path, text, words):
    """What is wrong and what to do."""
    with pytest.raises(SettingsError, match=rf"^owned is .*{words}.*: .*\.$"):
        read_owned(written(tmp_path, text), CATALOGUE)
