"""The report: plain JSON, and numbers that agree with the bricks."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from types import SimpleNamespace

import numpy as np
import pytest

from legorize_addon.core.build import Build, Cut
from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb
from legorize_addon.core.mesh.triangle_mesh import Repairs, TriangleMesh
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.report.report import report
from legorize_addon.core.settings import Settings
from legorize_addon.core.shell.hollowing import hollow
from legorize_addon.core.slicing.layer_differences import Marks
from legorize_addon.core.statics.stability import stability
from legorize_addon.core.supports.assembly_plan import plan_assembly
from legorize_addon.core.unit_bricks.offset_rings import Offsets, offset_rings
from legorize_addon.core.unit_bricks.wanted_colours import WantedColours, wanted_colours
from tests.core.solids import box
from tests.core.textured import painted, rgb_of, stages

CATALOGUE = load_catalogue()


def grid_of(solid):
    """Return a red grid of whole unit bricks from a mask of shape (layers, y, x)."""
    cells = np.repeat(solid[:, None], 3, axis=1)
    return UnitGrid(
        colour=np.where(cells, 4, COLOUR_EMPTY).astype(np.int16),
        cover=np.where(cells, Fill.REQUIRED, Fill.EMPTY).astype(np.uint8),
        role=np.zeros(cells.shape, np.uint8),
        origin=np.array([-8.0, 16.0, 3.2]),
    )


def offsets_of(grid, *, plates):
    """Return what closes the horizontal faces of a grid, by plates or by bricks."""
    levels = grid.solid.reshape(-1, *grid.solid.shape[2:]) if plates else grid.solid[:, 0]
    return offset_rings(levels, height=3.2 if plates else 9.6, critical_angle=45.0)


def build_of(rows):
    """Return a build of a solid 6 x 4 x 2 block with bricks from rows of part number, x, y, z, colour, role."""
    n = len(rows)
    bricks = Bricks(
        part=np.array([CATALOGUE.part_row(row[0]) for row in rows], np.int16),
        corner=np.array([row[1:4] for row in rows], np.int32),
        turn=np.zeros(n, np.uint8),
        colour=np.array([row[4] for row in rows], np.int16),
        role=np.array([row[5] for row in rows], np.uint8),
        piece=np.zeros(n, np.int16),
        step=np.zeros(n, np.int32),
    )
    mesh = TriangleMesh(
        vertices=np.eye(3),
        faces=np.array([[0, 1, 2]], np.int32),
        uvs=np.zeros((1, 3, 2)),
        face_image=np.zeros(1, np.int32),
        images=(np.zeros((1, 1, 3), np.uint8),),
        image_clamp=np.ones(1, bool),
    )
    supports = plan_assembly(Assembly(bricks, CATALOGUE), wish="none", deepest=3)
    solid = np.zeros((3, 6, 8), bool)
    solid[:2, 1:5, 1:7] = True
    cut = stages(painted(box((4, 28, 0), (36, 52, 19.2)), 4))
    slices = SimpleNamespace(heights=cut.heights)
    return Build(
        settings=Settings(seed=7),
        surface=None,
        mesh=mesh,
        repairs=Repairs(**{entry.name: 0 for entry in fields(Repairs)} | {"watertight": True}),
        scale=0.5,
        turn=np.eye(4),
        trajectories=cut.trajectories,
        cut=Cut(slices=slices, layer=np.array([0, 1], np.int32), plate=np.ones(2, np.int8), marks=None),
        offsets=offsets_of(grid_of(solid), plates=False),
        grid=grid_of(solid),
        hollow=grid_of(solid),
        wanted=wanted_colours(cut.mesh, grid_of(solid).solid, grid_of(solid).origin, plates=False),
        assembly=Assembly(bricks, CATALOGUE),
        stability=stability(Assembly(bricks, CATALOGUE)),
        supports=supports,
        joints=(),
        prices=None,
        owned=None,
        proof=None,
        notes=("A remark.",),
        timings={"slicing": 0.25},
    )


@pytest.fixture(scope="module")
def described():
    """Return the report of two red bricks on each other, a plate, and a corner on a support."""
    rows = [
        ("3001", 1, 1, 0, 4, Role.SHELL),
        ("3001", 2, 2, 3, 4, Role.INSIDE),
        ("2357", 6, 3, 3, 3, Role.SHELL),
        ("3020", 1, 3, 0, 15, Role.PLATE),
        ("3005", 6, 4, 0, 15, Role.SUPPORT_KEPT),
    ]
    return report(build_of(rows), CATALOGUE, version="1.2.3", mm_per_unit=1000.0)


def test_report_is_plain_json(described):
    """Written and read again the report is the same: nothing in it is an array or a number JSON does not have."""
    assert json.loads(json.dumps(described, allow_nan=False)) == described


def test_report_repeats_what_it_was_given(described):
    """Version, seed, settings, notes and times stand as they were handed in."""
    assert described["version"] == "1.2.3"
    assert described["seed"] == described["settings"]["seed"] == 7
    assert described["settings"]["width"] == Settings().width
    assert described["notes"] == ["A remark."]
    assert described["timings_s"] == {"slicing": 0.25}
    assert described["input"]["triangles"] == described["input"]["images"] == 1
    assert described["input"]["watertight"] is True
    assert "watertight" not in described["input"]["repairs"]


def test_counts_agree_with_the_bricks(described):
    """Bricks are counted by part, by colour and by role; the unit bricks are those of the solid block."""
    counts = described["counts"]
    assert counts["bricks"] == sum(counts["by_part"].values()) == sum(counts["by_colour"].values()) == 5
    assert counts["by_part"] == {"3005": 1, "2357": 1, "3001": 2, "3020": 1}
    assert counts["by_colour"] == {"3": 1, "4": 2, "15": 2}
    assert (counts["plates"], counts["support_outside"], counts["support_inside"]) == (1, 1, 0)
    assert counts["unit_bricks_before"] == 6 * 4 * 2
    assert described["grid"] == {"x": 6, "y": 4, "layers": 2}


def test_mass_and_hollow_ratio(described):
    """The mass is that of all bricks; of 144 cells the model's bricks fill 24 + 24 + 6 + 8: the corner sticks out."""
    masses = [CATALOGUE.parts[CATALOGUE.part_row(number)].mass for number in ("3001", "3001", "2357", "3020", "3005")]
    assert described["mass_g"] == pytest.approx(sum(masses))
    assert described["hollow_ratio"] == pytest.approx(1 - 62 / 144, abs=1e-4)


def test_connection_and_unavailable_parts(described):
    """The corner rests on the support; the plate is loose; the corner was never made in Dark Turquoise."""
    assert described["connection"] == {"components": 3, "floating": 0, "collisions": 0}
    assert described["unavailable_part_colours"] == {
        "bricks": 1,
        "pairs": [{"part": "2357", "colour": 3, "count": 1}],
    }
    assert described["unknown_elements"] == described["unavailable_part_colours"]


def test_matrix_belongs_to_grid_scale_and_units(described):
    """The corner of the grid, taken back to scene units, is the origin of the LDraw file."""
    corner = np.array([-8.0, 16.0, 3.2]) / 0.5 / 1000.0
    np.testing.assert_allclose(np.array(described["mesh_to_ldraw"]) @ [*corner, 1], [0, 0, 0, 1], atol=1e-12)


def test_matrix_turns_as_the_mesh_was_turned():
    """Of a mesh that was turned about its foot the matrix begins with that turn, in units of the scene."""
    build = build_of([("3001", 1, 1, 0, 4, Role.SHELL)])
    turn = np.array([[1, 0, 0, 50], [0, 0, -1, 60], [0, 1, 0, 70], [0, 0, 0, 1]], dtype=float)
    turned = report(replace(build, turn=turn), CATALOGUE, version="", mm_per_unit=10.0)["mesh_to_ldraw"]
    turned = np.array(turned)
    plain = np.array(report(build, CATALOGUE, version="", mm_per_unit=10.0)["mesh_to_ldraw"])
    np.testing.assert_allclose(turned @ [1, 2, 3, 1], plain @ [1 + 5, -3 + 6, 2 + 7, 1])


def described_grid(grid, **changes):
    """Return the report of a build, in bricks, whose unit bricks and more are others."""
    changes = {"grid": grid, "offsets": offsets_of(grid, plates=False)} | changes
    build = replace(build_of([("3001", 1, 1, 0, 4, Role.SHELL)]), **changes)
    return report(build, CATALOGUE, version="", mm_per_unit=1.0)


def test_detail_counts_layers_and_columns():
    """A plate alone and a brick of two colours are columns of plates; marks are counted by criterion, or unknown."""
    grid = grid_of(np.ones((4, 5, 6), bool))
    grid.cover[1, 0, 2, 3], grid.colour[1, 0, 2, 3] = Fill.EMPTY, COLOUR_EMPTY
    grid.colour[3, 1, :2, 0] = 15
    marks = Marks(number=np.array([0, 1, 1, 0], bool), length=np.ones(4, bool), area=np.zeros(4, bool))
    layer, slices = np.array([0, 1, 1, 1, 2, 3, 3, 3], np.int32), SimpleNamespace(heights=np.zeros(8))
    cut = Cut(slices=slices, layer=layer, plate=np.ones(8, np.int8), marks=marks)
    assert described_grid(grid, cut=cut)["detail"] == {
        "layers": 4,
        "marked_by_number": 2,
        "marked_by_length": 4,
        "marked_by_area": 0,
        "sliced_in_plates": 2,
        "layers_in_plates": 2,
        "columns_of_plates": 3,
    }
    unmarked = described_grid(grid_of(np.ones((2, 3, 3), bool)))["detail"]
    assert unmarked["marked_by_number"] is unmarked["marked_by_length"] is unmarked["marked_by_area"] is None
    assert unmarked["layers_in_plates"] == unmarked["columns_of_plates"] == 0


def test_order_is_buildable_if_all_steps_are_and_the_model_is_left(described):
    """What counts the steps and the end apart agrees with the verdict on the whole order."""
    building = described["building"]
    done = described["buildable_steps"] == building["steps"] and building["ends_as_model"]
    assert building["buildable"] == done


def test_cells_that_trajectories_pass_are_counted(described):
    """A rectangle whose sides pass the middles of cells leaves one corner of four of them inside, two of ten."""
    n_slices = len(stages(painted(box((4, 28, 0), (36, 52, 19.2)), 4)).heights)
    assert described["pass_through"] == {"type_1": 4 * n_slices, "type_2": 10 * n_slices, "type_3": 0}


def test_colours_are_compared_with_the_surface(described):
    """A red block's red bricks are right; the white ones beside them are the worst."""
    red, white = (lab_from_srgb(rgb_of([code]))[0] for code in (4, 15))
    told = described["colour_error"]
    assert told["worst"] == pytest.approx(ciede2000(red, white), abs=0.01)
    assert 0 < told["mean"] < told["worst"]
    assert told["judged"] > 1
    nothing = WantedColours(np.zeros((0, 3), np.int16), 3, np.zeros((0, 3), np.float32), np.zeros(0, np.float32))
    unseen = described_grid(grid_of(np.ones((1, 4, 4), bool)), wanted=nothing)["colour_error"]
    assert unseen == {"mean": None, "worst": None, "brick": None, "judged": 0}


def test_offsets_are_counted():
    """Trajectories, bricks and visible cells left alone are those of all levels together."""
    ring = np.zeros((2, 4, 4), np.uint16)
    ring[1, 1:3, 1:3] = [[1, 1], [1, 2]]
    alone = np.zeros(ring.shape, bool)
    alone[0, 0] = True
    offsets = Offsets(ring=ring, left_alone=alone, trajectories=np.array([0, 2]))
    facts = described_grid(grid_of(np.ones((2, 4, 4), bool)), offsets=offsets)
    assert facts["offsets"] == {"trajectories": 2, "bricks": 4, "left_alone": 4}


@pytest.mark.parametrize("plates", [False, True])
def test_overhangs_are_counted_by_kind(plates):
    """A beam and a slab stick out of a pillar, a cube floats: by plates as by bricks one of each kind."""
    solid = np.zeros((4, 9, 12), bool)
    solid[:3, 4, 4] = True
    solid[1, 4, 5:8] = True
    solid[2, 4:7, :4] = True
    solid[3, 0, 11] = True
    grid = grid_of(solid)
    facts = described_grid(grid, offsets=offsets_of(grid, plates=plates))
    assert facts["overhangs"] == {"point": 1, "edge": 1, "face": 1}


def test_hollowing_counts_cells_and_cases():
    """Of a cube of seven, five cubed are no shell, of which three cubed stay empty; a step is case (a)."""
    grid = grid_of(np.ones((7, 7, 7), bool))
    hollowing = described_grid(grid, hollow=hollow(grid, shell=1))["hollowing"]
    assert hollowing["solid"] == 3 * 7**3
    assert hollowing["must"] == 3 * (7**3 - 5**3)
    assert hollowing["may"] == 3 * (5**3 - 3**3)
    assert hollowing["cases"] == {"inside": 0, "crossing": 0, "covering": 12, "apart": 0}
    upper = described_grid(grid, settings=Settings(hollow_rule="upper"))["hollowing"]
    assert upper["cases"]["covering"] == 6
    step = grid_of(np.arange(5) < np.array([4, 2])[:, None, None] * np.ones((1, 3, 1)))
    by_bricks, by_plates = (
        described_grid(step, offsets=offsets_of(step, plates=plates))["hollowing"]["cases"] for plates in (False, True)
    )
    assert by_bricks == {"inside": 1, "crossing": 0, "covering": 1, "apart": 0}
    assert by_plates == {"inside": 1, "crossing": 0, "covering": 9, "apart": 0}


def test_verdict_is_told_with_its_proof(described):
    """The report names the verdict, the weakest bricks and the friction, and that the proof was confirmed."""
    told = described["stability"]
    assert told["verdict"] in ("stable", "wedged", "collapses", "undecided")
    assert told["stable"] == (told["verdict"] in ("stable", "wedged"))
    assert told["by_studs_alone"] == (told["verdict"] == "stable")
    assert any("pieces that are not joined" in reason for reason in told["reasons"])
    assert told["clutch_n"] == 0.7
    assert told["proof_confirmed"] is True
    assert told["components"] == described["connection"]["components"]
    assert told["worst_margin"] <= 1


def test_bound_is_told_where_it_is_asked_for(described):
    """No layout has fewer bricks than the bound; without the proof both figures are there, and empty."""
    told = described["layout"]
    assert told == {"tier": "standard", "fewest_possible": None, "at_most_more_percent": None}
    heard: list[str] = []
    proven = report(
        build_of([("3001", 1, 1, 0, 4, Role.SHELL)]),
        CATALOGUE,
        version="",
        mm_per_unit=1.0,
        with_bound=True,
        progress=lambda stage, share: heard.append(stage),
    )
    fewest = proven["layout"]["fewest_possible"]
    assert fewest >= 1
    assert proven["layout"]["at_most_more_percent"] == pytest.approx(100 * (1 / fewest - 1), abs=0.01)
    assert set(heard) == {"bound"}
