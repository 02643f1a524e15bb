"""Bricks in mixed colours: pictures that lie and stand, reliefs, and bodies of other shapes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.colours.difference import linear_from_srgb
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.unit_bricks.dithering import remarks_on_dithering
from tests.core.afar import difference_from_afar
from tests.core.solids import box, joined, sphere
from tests.core.textured import rgb_of, textured

WIDE, HIGH = 20, 12
MIXED = ["ordered", "diffusion"]


def gradient() -> np.ndarray:
    """Return a picture that changes colour along both sides, (12, 20, 3) uint8; row 0 is at the bottom."""
    y, x = np.mgrid[:HIGH, :WIDE]
    return np.stack([255 - x * 6, 80 + y * 8, 40 + x * 9], axis=-1).astype(np.uint8)


def photo() -> np.ndarray:
    """Return a picture with soft shades, a bright disc and a dark ground, as of a landscape, (12, 20, 3) uint8."""
    y, x = np.mgrid[:HIGH, :WIDE]
    sky = np.stack([150 + y * 5, 160 + y * 3, 190 + y], axis=-1)
    hills = 70 + 20 * np.sin(x / 4) + 12 * np.sin(x / 1.7 + y)
    ground = np.stack([hills + 20, hills + 35, hills - 20], axis=-1)
    sun = np.hypot(x - 14, y - 8) < 3
    image = np.where((y < 5 + 2 * np.sin(x / 5))[..., None], ground, sky)
    return np.clip(np.where(sun[..., None], [250, 215, 120], image), 0, 255).astype(np.uint8)


def picture(image, *, standing=False, thick=9.6) -> TriangleMesh:
    """Make a slab of one brick, lying or standing, with a picture right through it."""
    high, wide = image.shape[:2]
    size = (8 * wide, thick, 9.6 * high) if standing else (8 * wide, 8 * high, thick)
    return projected(box((0, 0, 0), size), image, 2 if standing else 1)


def projected(mesh: TriangleMesh, image, axis=2) -> TriangleMesh:
    """Lay an image over a mesh along x and another axis."""
    low, size = mesh.vertices.min(axis=0), np.ptp(mesh.vertices, axis=0)
    share = ((mesh.vertices - low) / size)[mesh.faces]
    return textured(mesh, image, share[..., [0, axis]], clamp=True)


class ReachedError(Exception):
    """The unit bricks are there."""

    def __init__(self, grid: UnitGrid) -> None:
        super().__init__()
        self.grid = grid


def built(mesh, dithering, **options) -> UnitGrid:
    """Run the stages up to the unit bricks."""

    def stop(_, grid):
        raise ReachedError(grid)

    settings = Settings(dithering=dithering, **{"width": WIDE} | options)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("legorize_addon.core.drafting.close_overhangs", stop)
        with pytest.raises(ReachedError) as reached:
            legorize(mesh, settings)
    return reached.value.grid


def front(grid: UnitGrid, *, standing=False) -> np.ndarray:
    """Return the colours of the front of a slab, one each stud and brick, (12, 20)."""
    colour = grid.colour.reshape(-1, *grid.colour.shape[2:])
    solid = colour != COLOUR_EMPTY
    axis = 1 if standing else 0
    first = solid.argmax(axis=axis) if standing else len(solid) - 1 - solid[::-1].argmax(axis=0)
    found = np.take_along_axis(colour, np.expand_dims(first, axis), axis=axis).squeeze(axis)
    found = found[np.ix_(solid.any(axis=axis).any(axis=1), solid.any(axis=axis).any(axis=0))]
    return found[1::3] if standing else found


@pytest.mark.parametrize("kind", MIXED)
@pytest.mark.parametrize("image", [gradient(), photo()], ids=["gradient", "photo"])
@pytest.mark.parametrize("standing", [False, True], ids=["lying", "standing"])
def test_pictures_are_nearer_from_afar(kind, image, standing):
    """What smoothing would make of one colour stays mixed up to the grid that is laid."""
    mesh, goal = picture(image, standing=standing), linear_from_srgb(image)
    plain, mixed = (difference_from_afar(front(built(mesh, each), standing=standing), goal) for each in ("none", kind))
    assert mixed < 0.7 * plain


@pytest.mark.parametrize("kind", MIXED)
def test_checker_of_brick_colours_stays(kind):
    """Where every stud has a colour that bricks have, nothing is mixed."""
    y, x = np.mgrid[:HIGH, :WIDE]
    codes = np.where((x // 4 + y // 4) % 2, 4, 15)
    image = rgb_of(codes.ravel()).reshape(HIGH, WIDE, 3)
    found = front(built(picture(image), kind, fewer_parts=0.0))
    np.testing.assert_array_equal(found, front(built(picture(image), "none", fewer_parts=0.0)))
    np.testing.assert_array_equal(found, codes)


@pytest.mark.parametrize("kind", MIXED)
def test_checker_finer_than_a_stud_is_mixed_of_its_colours(kind):
    """A checker of black and white, four squares a stud, looks like a half of each, not like one grey."""
    y, x = np.mgrid[: 4 * HIGH, : 4 * WIDE]
    image = rgb_of(np.where((x + y) % 2, 0, 15).ravel()).reshape(4 * HIGH, 4 * WIDE, 3)
    found = front(built(picture_of_studs(image), kind, palette="0,15"))
    assert (found == 15).mean() == pytest.approx(0.5, abs=0.08)
    assert len(np.unique(front(built(picture_of_studs(image), "none", palette="0,15")))) == 1


def picture_of_studs(image) -> TriangleMesh:
    """Make a lying slab with a picture of four texels a stud."""
    return projected(box((0, 0, 0), (8 * WIDE, 8 * HIGH, 9.6)), image, 1)


@pytest.mark.parametrize("kind", MIXED)
def test_two_runs_are_equal(kind):
    """Nothing in it is random."""
    one, two = (built(picture(photo()), kind) for _ in range(2))
    assert one.colour.tobytes() == two.colour.tobytes()


@pytest.mark.parametrize("kind", MIXED)
def test_seed_does_not_matter(kind):
    """The mixture goes by the texels, not by the dominant colours that were drawn."""
    one, two = (front(built(picture(gradient()), kind, seed=seed, plates="none")) for seed in (0, 7))
    np.testing.assert_array_equal(one, two)


def test_none_leaves_the_likeliest_colours(monkeypatch):
    """Without dithering no light is looked at: the colours are those of the votes, as the default's are."""
    usual = built(picture(photo()), Settings().dithering)

    def refuse(*_):
        raise AssertionError

    monkeypatch.setattr("legorize_addon.core.unit_bricks.generation.dither", refuse)
    assert built(picture(photo()), "none").colour.tobytes() == usual.colour.tobytes()


def test_palette_is_kept_and_used():
    """Only colours of the palette are mixed, also those that no dominant colour became."""
    grey = np.full((HIGH, WIDE, 3), 120, np.uint8)
    found = built(picture(grey), "ordered", palette="0,15,4")
    assert {0, 15} <= set(np.unique(front(found))) <= {0, 15, 4}
    assert len(np.unique(front(built(picture(grey), "none", palette="0,15,4")))) == 1


@pytest.mark.parametrize("options", [{}, {"fewer_parts": 2.0}, {"plates": "none"}, {"plates": "all"}])
def test_nothing_settles_the_mixture_again(options):
    """However much fewer parts are worth, the mixture is the same on a slab of one colour."""
    shade = np.broadcast_to(np.array([200, 90, 60], np.uint8), (HIGH, WIDE, 3))
    found = front(built(picture(shade), "ordered", **options))
    np.testing.assert_array_equal(found, front(built(picture(shade), "ordered", plates="none")))
    assert len(np.unique(found)) > 1


def test_walls_and_roofs_have_the_same_shares():
    """Every side of a cube of one shade is the same mixture, in a pattern that lies in that side."""
    cube = projected(box((0, 0, 0), (128, 128, 115.2)), np.full((4, 4, 3), 120, np.uint8))
    build = built(cube, "ordered", width=16, palette="0,15")
    planes = build.colour.reshape(-1, *build.colour.shape[2:])
    solid = planes != COLOUR_EMPTY
    planes = planes[np.ix_(*(solid.any(axis=axes) for axes in ((1, 2), (0, 2), (0, 1))))]
    roof, walls = planes[-1, 4:12, 4:12], planes[1::3]
    sides = [roof, walls[2:10, 0, 4:12], walls[2:10, -1, 4:12], walls[2:10, 4:12, 0]]
    shares = [(side == 15).mean() for side in sides]
    assert 0.05 < shares[0] < 0.5
    np.testing.assert_allclose(shares, shares[0])


def test_relief_passes_errors_on_across_its_steps():
    """Two levels of one picture are one raster; walls between them do not colour what is in front."""
    low, high = box((0, 0, 0), (160, 96, 9.6)), box((48, 24, 9.6), (112, 72, 19.2))
    mesh = projected(joined(low, high), gradient(), 1)
    plain, mixed = (
        difference_from_afar(front(built(mesh, kind)), linear_from_srgb(gradient())) for kind in ("none", "diffusion")
    )
    assert mixed < 0.7 * plain


def test_other_shapes_are_mixed_in_a_pattern_and_told():
    """A ball has no raster: it is dithered as by the other way, with one sentence."""
    ball = projected(sphere(8, 40.0), gradient())
    ordered, diffusion = (legorize(ball, replace(SMALL, dithering=kind)) for kind in MIXED)
    np.testing.assert_array_equal(ordered.hollow.colour, diffusion.hollow.colour)
    np.testing.assert_array_equal(ordered.bricks.colour, diffusion.bricks.colour)
    assert [note for note in diffusion.notes if "dither" in note] == list(remarks_on_dithering(ball, "diffusion"))
    assert len(remarks_on_dithering(ball, "diffusion")) == 1
    assert not [note for note in ordered.notes if "dither" in note]


SMALL = Settings(width=8, layout="fast", supports="none")


def test_flat_pictures_get_no_remark():
    """There diffusion does what it says."""
    assert remarks_on_dithering(picture(photo()), "diffusion") == ()
    assert remarks_on_dithering(sphere(), "none") == ()


def test_backing_and_diffusion_go_together():
    """A picture that is backed has the same front as one that is not."""
    plain, backed = (front(built(picture(photo()), "diffusion", backing=depth)) for depth in (0, 1))
    np.testing.assert_array_equal(plain, backed)


@pytest.mark.parametrize("other", [{"one_to_one": True, "colours": 8}, {"cell_colour": "longest"}])
def test_choices_that_a_mixture_cannot_keep_are_refused(other):
    """One sentence names both settings."""
    with pytest.raises(SettingsError, match=f"dithering is 'ordered' but {next(iter(other))}"):
        Settings(dithering="ordered", **other)
