"""Builds of meshes with weights: what is weighted becomes likelier, in the order of the stages and with a memo."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.drafting import draft_model
from legorize_addon.core.memo import Memo
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.solids import sphere
from tests.core.textured import rgb_of, textured

BLACK, WHITE = 0, 15
QUICK = Settings(width=10, weight="eyes", layout="fast", supports="none", strengthen=False)


def face(share: float):
    """Return a white ball with two black eyes of a share of a stud in front, which are weighted."""
    ball = sphere(80, 40.0)
    image = np.broadcast_to(rgb_of([WHITE])[0], (64, 64, 3)).copy()
    # image coordinates are x and z, in sixty-fourths of ten studs; behind it is white all over
    size = max(1, round(6.4 * share))
    for x in (22, 42 - size):
        image[40 : 40 + size, x : x + size] = rgb_of([BLACK])[0]
    uvs = ball.vertices[ball.faces][:, :, [0, 2]] / 80 + 0.5
    uvs[ball.vertices[ball.faces][:, :, 1].mean(axis=1) > 0] = 0.01
    x, y, z = 64 * (ball.vertices.T / 80 + 0.5)
    eyes = (
        (y < 32)
        & (z >= 40)
        & (z <= 40 + size)
        & np.any([(x >= at) & (x <= at + size) for at in (22, 42 - size)], axis=0)
    )
    return replace(textured(ball, image, uvs, clamp=True), weight=eyes.astype(float))


def black_cells(mesh, settings) -> int:
    """Count the columns of cells that become black."""
    return int((draft_model(mesh, settings).grid.colour == BLACK).any(axis=1).sum())


def test_eyes_smaller_than_their_cells_stay_white_unless_they_count():
    """Eyes of .6 x .6 studs go; if they count four times as much, there are two; without a name no weight counts."""
    mesh = face(0.6)
    assert black_cells(replace(mesh, weight=None), replace(QUICK, weight="")) == 0
    assert black_cells(mesh, replace(QUICK, weight="")) == 0
    assert black_cells(mesh, QUICK) == 2


def test_eyes_are_found_without_paint():
    """Eyes of 1.2 x 1.2 studs are features, and not made smaller; where edges and thin parts count, as before."""
    mesh, plain = replace(face(1.2), weight=None), replace(QUICK, weight="")
    assert black_cells(mesh, plain) == 2
    assert black_cells(mesh, replace(plain, features="shapes")) == 2
    assert black_cells(mesh, replace(plain, features="colours")) == 4


def test_a_weight_of_nothing_is_told():
    """Where all weights are 0, a remark says so, and the model is the one without; no remark without a name."""
    mesh = face(0.6)
    empty = legorize(replace(mesh, weight=np.zeros(len(mesh.vertices))), QUICK)
    without = legorize(replace(mesh, weight=None), replace(QUICK, weight=""))
    said = "The weight 'eyes' is 0 everywhere: no part of the surface counts more than others."
    assert [said in each.notes for each in (empty, without)] == [True, False]
    np.testing.assert_array_equal(empty.bricks.corner, without.bricks.corner)


def test_an_update_of_the_weight_is_a_build():
    """With a memo of other weights and another emphasis, a model is the same as one that is built afresh."""
    mesh, memo = face(1.5), Memo()
    for own, settings in (
        (replace(mesh, weight=0.5 * mesh.weight), QUICK),
        (mesh, QUICK),
        (mesh, replace(QUICK, emphasis=6.0)),
        (mesh, replace(QUICK, features="all")),
    ):
        trial = memo.trial()
        found, fresh = legorize(own, settings, trial=trial), legorize(own, settings)
        memo.keep(trial)
        for name in ("part", "corner", "colour"):
            np.testing.assert_array_equal(getattr(found.bricks, name), getattr(fresh.bricks, name))
