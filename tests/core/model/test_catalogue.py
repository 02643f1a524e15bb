"""The catalogue: sizes, orientations, colours, and who makes what in which colour."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.catalogue import ASSETS, footprint, load_catalogue, read_catalogue
from legorize_addon.core.model.unit_grid import COLOUR_ANY

CATALOGUE = load_catalogue()
BRICKS = ["3005", "3004", "3622", "3010", "3009", "3008", "2357", "3003", "3002", "3001", "2456", "3007"]
PLATES = ["3024", "3023", "3623", "3710", "3666", "3460", "2420", "3022", "3021", "3020", "3795", "3034"]
TALL = ["14716", "22886", "30145", "30144"]
TILES = ["3070b", "3069b", "63864", "2431", "6636", "4162", "3068b", "26603", "87079"]
LARGE_PLATES = ["3031", "3032", "3035", "3958", "3036", "41539"]
BASES = ["91405", "3867", "3811", "4186"]
SLOPES = [
    "3040b", "3039", "4286", "54200", "85984", "3665", "3660",
    "3038", "3037", "3298", "3297", "60477", "60481", "3678b", "4460b", "3684", "4287", "3747b",
    "11477", "15068", "50950", "24309", "61678", "93606",
]  # fmt: skip

JUMPERS = ["15573", "87580"]
WEDGES = ["26601", "2450", "24307", "24299", "43722", "43723", "41769", "41770", "65426", "65429", "51739"]

TABLES = ("parts.csv", "colours.csv", "availability.csv")


@pytest.fixture
def copied_assets(tmp_path):
    """Return a folder with copies of the three tables, to be damaged."""
    for name in TABLES:
        (tmp_path / name).write_bytes((ASSETS / name).read_bytes())
    return tmp_path


def test_parts_are_the_bricks_the_plates_and_the_tall_ones():
    """The catalogue lists 12 bricks, 12 plates of the same footprints and 4 tall bricks, in this order; then others."""
    assert [part.number for part in CATALOGUE.parts] == (
        BRICKS + PLATES + TALL + TILES + LARGE_PLATES + BASES + SLOPES + JUMPERS + WEDGES
    )
    assert [part.height for part in CATALOGUE.parts][:47] == [3] * 12 + [1] * 12 + [9] * 4 + [1] * 19
    for brick, plate in zip(CATALOGUE.parts[:12], CATALOGUE.parts[12:24], strict=True):
        assert (brick.length, brick.width, brick.corner) == (plate.length, plate.width, plate.corner)


def test_what_parts_are_laid_for():
    """Models are built of bricks and plates, their surface of slopes and tiles; large plates bear mosaics of tiles."""
    number = np.array([part.number for part in CATALOGUE.parts])
    assert number[CATALOGUE.used_for("model")].tolist() == BRICKS + PLATES + TALL
    assert number[CATALOGUE.used_for("tiles")].tolist() == TILES
    assert number[CATALOGUE.used_for("plates")].tolist() == LARGE_PLATES
    assert number[CATALOGUE.used_for("base")].tolist() == BASES
    assert number[CATALOGUE.used_for("surface")].tolist() == TILES + SLOPES + JUMPERS + WEDGES
    assert CATALOGUE.exists[~np.isin(number, WEDGES)].any(axis=1).all()


def test_tiles_are_smooth_and_baseplates_flat_below():
    """No studs are on tiles, cheese slopes and curves; a baseplate clutches nothing below; all else does both."""
    number = np.array([part.number for part in CATALOGUE.parts])
    assert number[~CATALOGUE.studs].tolist() == [*TILES, "54200", "85984", *SLOPES[-6:]]
    assert number[~CATALOGUE.sockets].tolist() == ["3867", "3811", "4186"]


def test_tiles_are_made_wherever_one_and_two_studs_are():
    """Every colour of the catalogue has tiles of one stud and of two: any picture can be laid in any palette."""
    for tile in ("3070b", "3069b"):
        assert CATALOGUE.exists[CATALOGUE.part_row(tile)].all()


def test_footprint_areas_follow_from_the_titles():
    """A part titled "Brick 2 x 4" covers eight cells, a corner part three, and is as high as its title says."""
    for part in (each for each in CATALOGUE.parts if not each.shaped):
        sides = [int(word) for word in part.title.split() if word.isdigit()]
        assert len(footprint(part, 0)) == (3 if part.corner else sides[0] * sides[1])
        assert sorted(sides[:2]) == [part.width, part.length]
        assert part.corner == part.title.endswith("Corner")
        brick = 3 * (sides[2] if len(sides) > 2 else 1)
        assert part.height == (brick if part.title.startswith("Brick") else 1)
        words = {"tile": "Tile", "baseplate": "Baseplate", "jumper": "Jumper"}
        assert part.title.split()[0] in words.get(part.profile, "Brick Plate")


def test_masses_grow_with_the_parts():
    """Of two parts of the same width and height the longer one is heavier; every mass names its source."""
    for part in CATALOGUE.parts:
        assert part.mass > 0
        assert part.mass_source
        for other in CATALOGUE.parts:
            same_series = (other.width, other.height, other.profile) == (part.width, part.height, part.profile)
            same_series &= not part.wedge
            assert not same_series or (part.mass > other.mass) == (part.length > other.length)


def test_every_colour_can_build_a_model():
    """Each colour has 1 x 1 and 1 x 2 parts, half of the bricks, and two thirds of bricks and plates together."""
    for number in ("3005", "3004", "3024", "3023"):
        assert CATALOGUE.exists[CATALOGUE.part_row(number)].all()
    height = np.array([part.height for part in CATALOGUE.parts])
    assert (CATALOGUE.exists[height == 3].sum(axis=0) >= 6).all()
    assert (CATALOGUE.exists[(height <= 3) & CATALOGUE.used_for("model")].sum(axis=0) >= 16).all()


def test_colours_are_sorted_and_unique():
    """Codes ascend strictly, and no two colours share a name, a value or a shop's number."""
    assert (np.diff(CATALOGUE.codes) > 0).all()
    for key in ("name", "rgb", "bricklink", "rebrickable", "lego"):
        values = [getattr(colour, key) for colour in CATALOGUE.colours]
        assert len(set(values)) == len(values)


def test_colour_numbers_of_the_known_traps():
    """Where the systems number a colour differently, each gets its own number."""
    numbers = {
        colour.name: (colour.code, colour.bricklink, colour.rebrickable, colour.lego) for colour in CATALOGUE.colours
    }
    assert numbers["Olive Green"] == (330, 155, 326, 330)
    assert numbers["Yellowish Green"] == (326, 158, 158, 326)
    assert numbers["Vibrant Yellow"] == (368, 236, 1062, 368)
    assert numbers["Dark Purple"] == (85, 89, 85, 268)
    assert numbers["Light Bluish Gray"] == (71, 86, 71, 194)


def test_element_numbers_belong_to_one_pair_each():
    """Only pairs that exist have an element number, and no number stands for two pairs."""
    assert not CATALOGUE.element[~CATALOGUE.exists].any()
    known = CATALOGUE.element[CATALOGUE.element > 0]
    assert len(np.unique(known)) == len(known)


def test_exists_in_broadcasts_and_knows_the_gaps():
    """Black has all bricks, Dark Turquoise no 2 x 2 corner; a free colour fits, an unknown one never."""
    rows = np.array([CATALOGUE.part_row("3001"), CATALOGUE.part_row("2357")])
    table = CATALOGUE.exists_in(rows[:, None], np.array([0, 3, COLOUR_ANY, 999, -2]))
    assert table.tolist() == [[True, True, True, False, False], [True, False, True, False, False]]


def test_exists_in_agrees_with_the_table():
    """Looked up by LDraw code, every pair reads as it stands in the table."""
    rows = np.arange(len(CATALOGUE.parts))[:, None]
    np.testing.assert_array_equal(CATALOGUE.exists_in(rows, CATALOGUE.codes), CATALOGUE.exists)


def test_rows_are_found_by_number_alias_and_code():
    """A part is found by its number and by the other numbers LDraw files use, a colour by its code."""
    assert CATALOGUE.parts[CATALOGUE.part_row("3023b")].number == "3023"
    assert [CATALOGUE.part_row(part.number) for part in CATALOGUE.parts] == list(range(len(CATALOGUE.parts)))
    assert [CATALOGUE.colour_row(code) for code in CATALOGUE.codes] == list(range(len(CATALOGUE.colours)))
    np.testing.assert_array_equal(CATALOGUE.rgb[CATALOGUE.colour_row(4)], [0xB4, 0, 0])


def test_unknown_part_or_colour_is_refused():
    """A part or colour that is not in the catalogue is named in the error."""
    with pytest.raises(BuildError, match="Part 4070 is not"):
        CATALOGUE.part_row("4070")
    with pytest.raises(BuildError, match="Colour 6 is not"):
        CATALOGUE.colour_row(6)


def test_the_catalogue_is_read_once():
    """Loading again gives the same object."""
    assert load_catalogue() is CATALOGUE


@pytest.mark.parametrize("name", TABLES)
def test_missing_table_is_named(copied_assets, name):
    """Without one of the tables the error names the file."""
    (copied_assets / name).unlink()
    with pytest.raises(BuildError, match=name):
        read_catalogue(copied_assets)


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("parts.csv", "9999,Brick 1 x 2,1,2,3,box,model,1.0,somebody,"),
        ("parts.csv", "9999,Brick 1 x 2,two,1,3,box,model,1.0,somebody,"),
        ("parts.csv", "9999,Brick 1 x 2,2,1,3,round,model,1.0,somebody,"),
        ("parts.csv", "9999,Brick 1 x 2,2,1,3,box,vehicles,1.0,somebody,"),
        ("parts.csv", "9999,Brick 1 x 2"),
        ("colours.csv", "900,Wrong,#12345,1,2,3"),
        ("colours.csv", "900,Wrong,#123456,,2,3"),
        ("availability.csv", "9999,0,1"),
        ("availability.csv", "3005,900,1"),
    ],
)
def test_damaged_line_is_named(copied_assets, name, line):
    """A line that cannot be understood is named by file and number."""
    path = copied_assets / name
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join([*lines, line, ""]), encoding="utf-8")
    with pytest.raises(BuildError, match=rf"{name}, line {len(lines) + 1} is wrong"):
        read_catalogue(copied_assets)
