"""What the setting of the tops does: nothing by default, tiles where studs show, and the model stands as before."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.edits import Edit, Edits, edit_of
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.files import write_ldr
from legorize_addon.core.ldraw import read_ldraw
from legorize_addon.core.memo import Memo
from legorize_addon.core.model import Verdict, load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.tile_stages import _weak
from tests.core.any_bricks import multiset
from tests.core.solids import sphere

CATALOGUE = load_catalogue()
SETTINGS = Settings(width=10, surface="tiles")
MESH = sphere(10)


def tiles(build):
    """Tell which bricks are tiles."""
    return np.array([part.profile == "tile" for part in CATALOGUE.parts])[build.bricks.part]


def cells(build):
    """Return which cells are filled in which colour, supports left out."""
    return np.append(build.bricks.colour, -1)[build.graph.owner]


@pytest.fixture(scope="module")
def plain():
    """Build a ball with studs."""
    return legorize(MESH, replace(SETTINGS, surface="studs"))


@pytest.fixture(scope="module")
def memo():
    """Return a memo, which the builds of this module fill."""
    return Memo()


@pytest.fixture(scope="module")
def ball(memo):
    """Build it with tiles."""
    trial = memo.trial()
    build = legorize(MESH, SETTINGS, trial=trial)
    memo.keep(trial)
    return build


def test_same_outline_and_as_strong(plain, ball):
    """Tiles hold nothing, the cells and colours stay, and the model is proven to stand; a note says what they take."""
    assert not tiles(plain).any()
    assert np.count_nonzero(tiles(ball)) > 4
    assert (cells(ball) == cells(plain)).all()
    assert not np.isin(ball.graph.pairs[:, 0], np.flatnonzero(tiles(ball))).any()
    assert ball.graph.n_components == 1
    assert ball.stability.stable
    assert ball.stability.check()
    assert ball.stability.margin.min() >= SETTINGS.spare
    assert CATALOGUE.exists_in(ball.bricks.part, ball.bricks.colour).all()
    assert ball.supports.walk.buildable
    (told,) = (note for note in ball.notes if note.startswith("Tiles hide"))
    assert f"with {len(ball.bricks) - len(plain.bricks)} additional parts." in told


def test_only_what_fails_stays_whole(ball):
    """What bears too little, or moves in a collapse, stays whole, but not what moves in no proof of one."""
    found, n = ball.stability, len(ball.bricks)
    every = replace(found, standing=Verdict.UNDECIDED, yielding=np.ones((n, 6)))
    assert not _weak(ball.assembly, every, np.arange(n), n).any()
    margin = found.margin.copy()
    margin[n // 2] = -0.1
    touching = {n // 2, *ball.graph.pairs[(ball.graph.pairs == n // 2).any(axis=1)].ravel().tolist()}
    assert set(np.flatnonzero(_weak(ball.assembly, replace(every, margin=margin), np.arange(n), n))) == touching
    assert _weak(ball.assembly, replace(every, standing=Verdict.COLLAPSES), np.arange(n), n).all()


def test_files_are_read_back(ball):
    """The LDraw file has the tiles, with their steps."""
    read = read_ldraw(write_ldr(ball.assembly, name="ball.ldr", title="Ball"), CATALOGUE)
    assert multiset(read.bricks) == multiset(ball.bricks)
    assert not read.left_out


@pytest.fixture(scope="module")
def every():
    """Build it with all tops smooth."""
    return legorize(MESH, replace(SETTINGS, tops="all"))


def test_all(plain, ball, every):
    """With all tops smooth fewer studs are left, for more parts."""
    assert len(every.bricks) > len(ball.bricks) >= len(plain.bricks)
    assert (cells(every) == cells(plain)).all()
    assert every.stability.stable


@pytest.mark.usefixtures("ball")
def test_an_update_lays_nothing_again(memo, every):
    """Other tops reach only what follows the proof of the layout, and give what a build afresh gives."""
    trial = memo.trial()
    again = legorize(MESH, replace(SETTINGS, tops="all"), trial=trial)
    assert multiset(again.bricks) == multiset(every.bricks)
    known = {id(entry) for entry in memo.entries}
    new = {entry.stage for entry in trial.entries if id(entry) not in known}
    assert "pieces" in new
    assert new <= {"pieces", "supports", "stability"}


def test_what_edits_laid_keeps_its_studs(ball):
    """A plate that is locked does not become a tile, and a part that is forbidden there is not laid."""
    rows = np.flatnonzero(tiles(ball))[:2].tolist()
    plate = {tile: row for row, part in enumerate(CATALOGUE.parts) if (tile := same_size(part)) is not None}
    locked = edit_of("lock", ball.bricks, rows[0], CATALOGUE)
    locked = replace(locked, part=CATALOGUE.parts[plate[ball.bricks.part[rows[0]]]].number)
    forbidden = edit_of("forbid", ball.bricks, rows[1], CATALOGUE)
    edits: tuple[Edit, ...] = (locked, forbidden)
    build = legorize(MESH, SETTINGS, edits=Edits(edits, ball.scale, tuple(ball.grid.origin.tolist())))
    assert not [each.reason for each in build.outcomes if each.reason]


def same_size(part):
    """Return the row of the tile of a plate's size, or None."""
    if part.use != "model" or part.height != 1 or part.corner:
        return None
    sizes = {(tile.length, tile.width): row for row, tile in enumerate(CATALOGUE.parts) if tile.profile == "tile"}
    return sizes.get((part.length, part.width))


def test_owned_tiles(tmp_path):
    """If nothing can be bought, there are as many tiles as are owned, in place of plates of their size."""
    (tmp_path / "owned.csv").write_text(
        "Part,Color,Quantity\n"
        + "".join(f"{part.number},71,500\n" for part in CATALOGUE.parts if part.use == "model")
        + "3070b,71,2\n3069b,71,1\n"
    )
    build = legorize(MESH, replace(SETTINGS, owned=str(tmp_path / "owned.csv")))
    assert 0 < np.count_nonzero(tiles(build)) <= 3


def test_what_leaves_no_place_for_tiles():
    """Tiles without tiles, and tiles without plates, are refused; slopes may do without."""
    for other in ({"tops": "studs"}, {"plates": "none"}):
        with pytest.raises(SettingsError, match=f"surface is 'tiles' but {next(iter(other))} is"):
            Settings(surface="tiles", **other)
        assert not Settings(surface="slopes", **other).smooth
    assert Settings(surface="slopes").smooth
    assert not Settings().smooth
