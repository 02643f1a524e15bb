"""What a colour that a user replaces does to cells and bricks, and when a layout may be painted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.drafting import draft_model
from legorize_addon.core.model import COLOUR_ANY, Role, load_catalogue
from legorize_addon.core.painting import NotMadeError, cells_to_lay, paint_bricks, paint_cells, paint_draft
from legorize_addon.core.progress import Overall, silent
from legorize_addon.core.run import Run
from legorize_addon.core.settings import Settings
from tests.core.standing import table as bricks_of
from tests.core.textured import split_at_x, table

CATALOGUE = load_catalogue()
RED, BLUE, LAVENDER = 4, 1, 31


def run_of(**options) -> Run:
    """Return a run that begins."""
    return Run.of(Settings(**options), Overall({}, silent))


@pytest.fixture(scope="module")
def cells():
    """Return the cells of a table whose halves are red and blue."""
    return draft_model(split_at_x(table(leg=16.0)), Settings(width=12)).hollow


def test_a_draft_is_painted(cells):
    """Cells, loops and what stands for the texture's colours have the new one; what was nearest is still known."""
    mesh = split_at_x(table(leg=16.0))
    plain, made = (draft_model(mesh, Settings(width=12, replace_colours=text)) for text in ("", "4=2"))
    for one, other in (
        (plain.hollow.colour, made.hollow.colour),
        (plain.grid.colour, made.grid.colour),
        (plain.trajectories.colour, made.trajectories.colour),
        (plain.surface.codes, made.surface.codes),
    ):
        assert (one == RED).any()
        np.testing.assert_array_equal(np.where(one == RED, 2, one), other)
    np.testing.assert_array_equal(made.surface.nearest, plain.surface.codes)
    assert paint_draft(run_of(), plain) is plain


def test_what_does_not_come_from_the_surface_keeps_its_colour(cells):
    """Pillars inside and supports outside, also in the very colour that is replaced."""
    run = run_of(replace_colours="4=2")
    role = np.where(cells.colour == RED, np.uint8(Role.SUPPORT_INSIDE), cells.role)
    np.testing.assert_array_equal(paint_cells(run, replace(cells, role=role)).colour, cells.colour)


def test_bricks_are_painted_as_far_as_they_are_made():
    """All of a colour but supports are; a brick of eight studs is not made in lavender, one of four is."""
    bricks = bricks_of(("3001", 0, 0, 0), ("3001", 4, 0, 0), ("3001", 8, 0, 0))
    bricks = replace(
        bricks,
        colour=np.array([RED, BLUE, RED], dtype=np.int16),
        role=np.array([Role.SHELL, Role.SHELL, Role.SUPPORT_OUTSIDE], dtype=np.uint8),
    )
    assert paint_bricks(run_of(replace_colours="4=31"), bricks).colour.tolist() == [LAVENDER, BLUE, RED]
    assert paint_bricks(run_of(replace_colours="4=1, 1=4"), bricks).colour.tolist() == [BLUE, RED, RED]
    assert paint_bricks(run_of(), bricks) is bricks
    long = replace(bricks, part=np.full(3, CATALOGUE.part_row("3007"), dtype=np.int16))
    assert not CATALOGUE.exists_in(long.part[0], LAVENDER)
    with pytest.raises(NotMadeError):
        paint_bricks(run_of(replace_colours="4=31"), long)


@pytest.mark.parametrize(
    ("text", "last"),
    [
        ("", False),
        ("4=2", True),
        ("4=1, 1=4", True),
        # nothing of the model has the colour
        ("14=2", True),
        # two colours become one, and what lies beside each other may be one brick
        ("4=1", False),
        ("4=2, 1=2", False),
        # hidden bricks have it as well
        ("71=2", False),
    ],
)
def test_when_a_layout_may_be_painted(cells, text, last):
    """Where colours stay apart and no other bricks have the colour."""
    found, may = cells_to_lay(run_of(replace_colours=text), cells)
    assert may is last
    np.testing.assert_array_equal(found.colour, cells.colour)


def test_parts_that_only_the_new_colour_has(cells):
    """What fits into the cells may save bricks, so that they are laid anew: bricks of 1 x 8 are not made in 379."""
    row = CATALOGUE.part_row("3008")
    assert not CATALOGUE.exists_in(row, 379)
    assert CATALOGUE.exists_in(row, 2)
    run = run_of(replace_colours="379=2")
    for width, last in ((7, True), (8, False)):
        colour = np.full((1, 3, 1, width), 379, dtype=np.int16)
        solid = np.ones(colour.shape, dtype=np.uint8)
        flat = replace(cells, colour=colour, cover=2 * solid, role=0 * solid)
        assert cells_to_lay(run, flat)[1] is last
        # along y as well
        turned = replace(flat, **{name: np.swapaxes(getattr(flat, name), 2, 3) for name in ("colour", "cover", "role")})
        assert cells_to_lay(run, turned)[1] is last
        # free cells beside one of the colour count, all free ones do not
        mixed, free = (np.full_like(colour, COLOUR_ANY) for _ in range(2))
        mixed[..., 0], free[..., 0] = 379, RED
        assert cells_to_lay(run, replace(flat, colour=mixed))[1] is last
        assert cells_to_lay(run, replace(flat, colour=free))[1]


def test_other_choices_of_parts_lay_anew(cells):
    """Where lots, a machine, or tiles that the new colour alone has decide between parts."""
    assert not cells_to_lay(run_of(replace_colours="4=2", few_lots=5.0), cells)[1]
    assert not cells_to_lay(run_of(replace_colours="4=2", layout="learned"), cells)[1]
    tiles = [row for row, part in enumerate(CATALOGUE.parts) if part.use != "model"]
    made = CATALOGUE.exists_in(np.array(tiles)[:, None], CATALOGUE.codes)
    more, fewer = CATALOGUE.codes[made.sum(axis=0).argmax()], CATALOGUE.codes[made.sum(axis=0).argmin()]
    colour = np.where(cells.colour == RED, fewer, np.where(cells.colour == BLUE, np.int16(-1), cells.colour))
    few = replace(cells, colour=colour.astype(np.int16))
    assert not cells_to_lay(run_of(replace_colours=f"{fewer}={more}", surface="tiles"), few)[1]
