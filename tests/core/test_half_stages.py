"""What the setting of half studs does: a tower between the studs of its block stands where it is, and all holds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.edits import Edit, Edits
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.files.ldraw import write_ldr
from legorize_addon.core.half_stages import remarks_on_half_studs, with_half_studs
from legorize_addon.core.half_studs import Region
from legorize_addon.core.half_studs.truth import HalfStudsError
from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.shopping.shopping_list import extent
from legorize_addon.core.supports.pillars import LooseError
from tests.core.half_studs.tower import BLOCK, table, tower
from tests.core.solids import box, joined

REGIONS = (Region(3, 9, True, 4, (1, 0)), Region(1, 5, False, 2, (1, 0)))
SETTINGS = Settings(width=6, half_studs=True, hollow=False)


@pytest.fixture(scope="module", params=[(0.5, 0.0), (0.5, 0.5)], ids=["along x", "both ways"])
def build(request):
    """Build a tower off the studs."""
    return request.param, legorize(tower(*request.param), SETTINGS)


def test_remarks_on_parts_without_a_layer_below_or_a_side(build):
    """What lies as the rest does within a region is not told of; a part may begin on the ground."""
    _, found = build
    halves = found.halves
    told = remarks_on_half_studs(halves, found.bricks, found.assembly.catalogue)
    inner = replace(halves, regions=(*halves.regions, Region(2, 3, False, 1, (0, 0))))
    assert remarks_on_half_studs(inner, found.bricks, found.assembly.catalogue) == told
    whole = replace(halves, regions=(Region(0, 3, True, 1, (1, 0)),))
    assert remarks_on_half_studs(whole, found.bricks, found.assembly.catalogue)[0] == (
        "A part from the ground up lies half a stud aside along x."
    )


def test_the_tower_stands_where_it_is(build):
    """Its bricks fill 3 x 3 studs at the place in the mesh, on jumpers, in one component that is proven to stand."""
    off, found = build
    [region] = found.halves.regions
    assert (region.low, region.high, region.half) == (BLOCK, BLOCK + 3, tuple(int(2 * each) for each in off))
    bricks = found.bricks
    above = bricks.corner[:, 2] >= 3 * BLOCK
    low = (bricks.corner + bricks.shift)[:, :2]
    # where the block begins, the mesh does
    assert (low[above].min(axis=0) - low.min(axis=0)).tolist() == [1 + off[0], 1 + off[1]]
    assert extent(found.assembly.take(above)) == (3, 3, 12)
    assert found.graph.collisions == 0
    assert found.graph.n_components == 1
    assert found.stability.stable
    assert found.supports.walk.buildable
    jumpers = np.array([part.jumper for part in found.assembly.catalogue.parts])[bricks.part]
    assert set(bricks.corner[jumpers, 2].tolist()) == {3 * BLOCK - 1}
    assert any(f"{jumpers.sum()} jumpers hold" in note for note in found.notes)


def test_its_file_is_read_back(build):
    """Contacts, places and half studs come back; the file has places between those of studs."""
    _, found = build
    catalogue = found.assembly.catalogue
    read = read_ldraw(write_ldr(found.assembly, name="tower.ldr", title="tower"), catalogue).bricks
    assert len(read) == len(found.bricks)
    links = contact_graph(read, catalogue)
    assert links.collisions == 0
    assert sorted(links.studs.tolist()) == sorted(found.graph.studs.tolist())
    places = [each.corner + each.shift for each in (found.bricks, read)]
    ours, theirs = (each[np.lexsort(each.T)] - each.min(axis=0) for each in places)
    assert ours.tolist() == theirs.tolist()


def test_none_by_default():
    """Without the setting all lies on one grid, and bricks know of no half studs."""
    found = legorize(tower(), replace(SETTINGS, half_studs=False))
    assert found.halves is None
    assert found.bricks.half is None


@pytest.mark.parametrize("other", [{"plates": "none"}, {"layout": "learned"}])
def test_what_it_excludes_is_refused(other):
    """Jumpers need plates around them, and a layout that lays around what is there."""
    with pytest.raises(SettingsError, match="half_studs is on but"):
        replace(SETTINGS, **other)


def test_without_jumpers_it_is_refused(tmp_path):
    """Where only owned parts may be laid and none is a jumper, one sentence says so."""
    owned = tmp_path / "owned.csv"
    owned.write_text("Part,Color,Quantity\n3024,15,1000\n3023,15,1000\n3005,15,1000\n", encoding="utf-8")
    with pytest.raises(SettingsError, match="do not have all of 15573, 87580, 3070b"):
        legorize(tower(), replace(SETTINGS, owned=str(owned), owned_use="only"))


def test_jumpers_have_colours_of_the_model(build):
    """No other colour has to be bought for them."""
    found = legorize(tower(0.5, 0.0), replace(SETTINGS, palette="4"))
    assert found.halves is not None
    assert set(found.bricks.colour.tolist()) == {4}


def test_edits_by_hand_are_refused():
    """They are made in windows of one grid."""
    edits = Edits((Edit("delete", "3005", 0, (1, 1, 1), 4),), scale=10.0)
    with pytest.raises(SettingsError, match="edits by hand"):
        legorize(tower(), SETTINGS, edits=edits)


def test_regions_that_do_not_hold_are_given_up(build):
    """They are barred and the model is made anew, until it holds; the layers are told."""
    tried = []

    def make(barred, mesh, settings, progress):
        tried.append(barred)
        progress("layout", 0.5)
        if len(tried) < 3:
            raise HalfStudsError((REGIONS[len(tried) - 1],))
        return build[1]

    told = []
    found = with_half_studs(make, None, SETTINGS, lambda stage, share: told.append(share))
    assert tried == [(), (REGIONS[0].key,), tuple(sorted(each.key for each in REGIONS))]
    assert "at layer 3, 6" in found.notes[-1]
    assert told == sorted(told)


def test_a_leg_between_the_studs_stands_by_itself():
    """One leg of a table lies half a stud off, the rest does not; all holds, and what carries the top is built."""
    found = legorize(table(0.5), replace(SETTINGS, width=8, surface="slopes"))
    [region] = found.halves.regions
    assert (region.low, region.upwards) == (0, False)
    off = found.bricks.half[:, 0] != found.bricks.half[found.bricks.corner[:, 2].argmax(), 0]
    low = (found.bricks.corner + found.bricks.shift)[off & (found.bricks.role < 4)]
    assert np.ptp(low[:, 0]) <= 1
    assert low[:, 2].max() < 3 * BLOCK
    assert found.graph.collisions == 0
    assert found.graph.n_components == 1
    assert found.supports.walk.buildable
    assert found.stability.stable
    assert any(f"up to layer {region.high + 1} lies half a stud aside along x" in note for note in found.notes)


def test_without_a_region_nothing_lies_off():
    """On its studs a table is built as without half studs."""
    found = legorize(table(0.0), replace(SETTINGS, width=8))
    assert found.halves is None
    assert found.bricks.half is None


def test_feet_beside_half_studs():
    """A thin high tower between the studs gets feet, for which the grid grows, and all holds."""
    mesh = joined(box((0, 0, 0), (64, 16, 19.2)), box((12, 0, 19.2), (36, 16, 192)))
    found = legorize(mesh, Settings(width=8, half_studs=True, feet=True, slope_price=0.2))
    assert any(note.startswith("Feet of") for note in found.notes)
    assert found.halves is not None
    assert found.stability.stable
    assert found.halves.half.shape == found.grid.solid[:, 0].shape


def test_what_lies_loose_on_tiles_has_no_half_studs(monkeypatch):
    """Where nothing can hold what lies over a plane of jumpers, the region there is given up."""

    def carry(run, assembly):
        """Find something loose in the layer above jumpers, if there are any."""
        jumpers = np.array([part.jumper for part in assembly.catalogue.parts])[assembly.bricks.part]
        if jumpers.any():
            raise LooseError(assembly.bricks.corner[jumpers, 2] + 1)
        return assembly

    monkeypatch.setattr("legorize_addon.core.erecting.carry", carry)
    found = legorize(tower(), SETTINGS)
    assert found.halves is None
    assert [note for note in found.notes if note.startswith("Half studs were given up")]
