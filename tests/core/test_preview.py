"""A preview: whole bricks in the size that was asked for, or smaller where that would take too long."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core import preview as module
from legorize_addon.core.errors import LimitError
from legorize_addon.core.memo import Memo
from legorize_addon.core.mesh import TriangleMesh
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.preview import Preview, preview, thinned
from legorize_addon.core.settings import Settings
from tests.core.solids import box, sphere


def made(mesh: TriangleMesh, memo: Memo | None = None, **chosen) -> tuple[Preview, int]:
    """Make a preview; return it, and in how many parts."""
    work, parts = preview(mesh, Settings(**chosen), memo or Memo()), 1
    while True:
        try:
            next(work)
        except StopIteration as end:
            return end.value, parts
        parts += 1


@pytest.mark.parametrize(
    "size",
    [
        {"width": 12},
        {"size_by": "height", "height": 10},
        {"size_by": "cm", "cm": 9.6},
        {"size_by": "scale", "scale": 16},
    ],
)
def test_it_has_the_size_of_the_model(size) -> None:
    """Grid, scale and covered cells are those of a build with whole bricks, up to rounding of the two ways to scale."""
    mesh = sphere(4, radius=30)
    found, _ = made(mesh, **size)
    build = legorize(mesh, Settings(**size, plates="none", layout="fast", feet=False, supports="none"))
    assert found.scale == pytest.approx(build.scale)
    np.testing.assert_allclose(found.origin, build.origin)
    assert found.studs == found.shown == 12
    low = build.bricks.corner.min(axis=0)
    np.testing.assert_array_equal(found.bricks.corner.min(axis=0), low)


def test_a_memo_changes_nothing() -> None:
    """A change of settings gives what a first preview of them gives."""
    mesh, memo = sphere(4, radius=30), Memo()
    made(mesh, memo, width=12)
    for chosen in ({"width": 14}, {"width": 14, "shell": 2}, {"width": 12, "colours": 3}):
        again, first = made(mesh, memo, **chosen)[0], made(mesh, **chosen)[0]
        np.testing.assert_array_equal(again.bricks.corner, first.bricks.corner)
        np.testing.assert_array_equal(again.bricks.part, first.bricks.part)
        np.testing.assert_array_equal(again.bricks.colour, first.bricks.colour)


@pytest.mark.parametrize("refused", [False, True])
def test_what_is_prepared_stays_for_the_next_one(monkeypatch, *, refused: bool) -> None:
    """Also if the preview is dropped after its first part, or refused: the next one prepares nothing again."""
    mesh, memo = sphere(3, radius=30), Memo()
    work = preview(mesh, Settings(width=12), memo)
    next(work)
    if refused:
        monkeypatch.setattr(module, "SECONDS", 0.0)
        with pytest.raises(LimitError):
            next(work)
        monkeypatch.undo()
    work.close()
    prepared = memo.entries
    names = {entry.name for entry in prepared}
    assert {name.rpartition(".")[2] for name in names} >= {"thinned", "prepare_mesh", "find_colours"}
    made(mesh, memo, width=16)
    assert {entry for entry in memo.entries if entry.name in names} == set(prepared)


def test_a_mesh_is_measured_once_for_all_numbers_of_parts(monkeypatch) -> None:
    """A slider of parts asks only what was measured before, and gives what a first preview gives."""
    mesh, memo = sphere(3, radius=30), Memo()
    made(mesh, memo, size_by="parts", parts=60)
    first, _ = made(mesh, size_by="parts", parts=90)
    monkeypatch.setattr(module.Measured, "of", None)
    again, _ = made(mesh, memo, size_by="parts", parts=90)
    np.testing.assert_array_equal(again.bricks.corner, first.bricks.corner)
    assert again.scale == first.scale


def test_what_takes_too_long_is_shown_smaller() -> None:
    """Twice the size takes no longer than what is shown; the height stays in proportion."""
    mesh = sphere(4, radius=30)
    found, _ = made(mesh, width=400)
    assert found.studs == 400
    assert 20 < found.shown < 100
    assert found.scale == pytest.approx(found.shown * 8 / 60, rel=0.05)
    assert np.ptp(found.bricks.corner[:, 0]) <= found.shown


def test_what_cannot_be_shown_is_refused(monkeypatch) -> None:
    """No preview has fewer than some studs because of the time it takes."""
    monkeypatch.setattr(module, "SECONDS", 0.01)
    with pytest.raises(LimitError, match="too large for a live preview: press Update"):
        made(sphere(3), width=24)


def test_images_are_thinned() -> None:
    """Every n-th texel stays, alpha with it; small images stay as they are."""
    mesh = box((0, 0, 0), (8, 8, 9.6))
    large = np.arange(2000 * 1000 * 3, dtype=np.uint8).reshape(2000, 1000, 3)
    plain = TriangleMesh(
        mesh.vertices, mesh.faces, mesh.uvs, mesh.face_image, (large, large[:1, :1]), np.zeros(2, dtype=bool),
        (large[..., 0], None),
    )  # fmt: skip
    found = thinned(plain)
    step = round((2_000_001 / module.TEXELS) ** 0.5)
    np.testing.assert_array_equal(found.images[0], large[step // 2 :: step, step // 2 :: step])
    np.testing.assert_array_equal(found.opacities[0], found.images[0][..., 0])
    assert found.images[1] is plain.images[1]
    assert thinned(mesh).images == mesh.images
