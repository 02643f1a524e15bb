"""What alpha hides is not built: faces are cut along the texels that are seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh, repair
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.texturing.cutouts import cut_unseen, remarks_on_unseen
from tests.core.solids import box, sheet
from tests.core.textured import rgb_of, textured


def disc(n: int = 64, radius: float = 0.4) -> np.ndarray:
    """Return the alpha of a disc in the middle of an image."""
    place = (np.arange(n) + 0.5) / n - 0.5
    return np.where(np.hypot(place, place[:, None]) < radius, 255, 0).astype(np.uint8)


def card(alpha: np.ndarray, *, clamp: bool = False, repeats: float = 1.0) -> TriangleMesh:
    """Return a green unit square under an image with alpha."""
    flat = sheet(1, 1)
    image = np.broadcast_to(rgb_of([2])[0], (*alpha.shape, 3)).copy()
    # what is hidden is black
    image[alpha == 0] = 0
    return replace(textured(flat, image, flat.uvs * repeats, clamp=clamp), opacities=(alpha,))


def area(mesh: TriangleMesh) -> float:
    """Return the area of a mesh."""
    return float(np.linalg.norm(mesh.normals, axis=1).sum() / 2)


def test_a_disc_is_cut_out_of_its_square() -> None:
    """The area is that of the disc, no point lies farther out than the finest side, and the neighbours stay joined."""
    seen, share = cut_unseen(card(disc(256)), least=0.5, finest=1 / 64)
    assert area(seen) == pytest.approx(np.pi * 0.16, rel=0.01)
    assert share == pytest.approx(1 - np.pi * 0.16, abs=0.005)
    assert np.hypot(*(seen.vertices[:, :2] - 0.5).T).max() < 0.4 + 1 / 64
    _, repairs = repair(seen, fill=False)
    # cut without tearing: one piece whose only rim is the outline of the disc
    assert (repairs.bodies, repairs.non_manifold_edges) == (1, 0)
    assert repairs.open_edges < 8 * 64


def test_faces_far_from_the_border_stay_large() -> None:
    """The work goes along the border, not over the area: half the side length takes about twice the faces."""
    counts = [len(cut_unseen(card(disc(512)), least=0.5, finest=side)[0].faces) for side in (1 / 32, 1 / 64)]
    assert counts[1] < 2.6 * counts[0]


def test_normals_and_image_coordinates_are_those_of_the_face() -> None:
    """Every part looks the way of its face, and its image coordinates are those of its place."""
    seen, _ = cut_unseen(card(disc()), least=0.5, finest=0.1)
    assert (seen.normals[:, 2] > 0).all()
    np.testing.assert_allclose(seen.uvs, seen.vertices[seen.faces][..., :2], atol=1e-12)


@pytest.mark.parametrize(("alpha", "least", "left"), [(38, 0.5, 0), (38, 0.1, 1), (128, 0.5, 1), (127, 0.5, 0)])
def test_panes_are_left_out_below_the_least_alpha(alpha: int, least: float, left: int) -> None:
    """A pane of constant alpha goes or stays as a whole, beside what is opaque."""
    pane = card(np.full((1, 1), alpha, dtype=np.uint8))
    both = replace(
        pane,
        vertices=np.concatenate([pane.vertices, np.add(pane.vertices, (0, 0, 1))]),
        faces=np.concatenate([pane.faces, pane.faces + 4]),
        uvs=np.concatenate([pane.uvs, pane.uvs]),
        face_image=np.array([0, 0, 1, 1], dtype=np.int32),
        images=(pane.images[0], rgb_of([4])[None]),
        image_clamp=np.array([True, True]),
        opacities=(pane.opacities[0], None),
    )
    seen, share = cut_unseen(both, least=least, finest=0.1)
    assert len(seen.faces) == 2 + 2 * left
    assert share == pytest.approx(0.5 * (1 - left))


def test_repeated_images_repeat_their_alpha_and_others_keep_their_edge() -> None:
    """Four repeats show four discs; an image that ends in its edge texels shows one."""
    repeated, _ = cut_unseen(card(disc(), repeats=2.0), least=0.5, finest=1 / 64)
    assert area(repeated) == pytest.approx(np.pi * 0.16, rel=0.02)
    once, _ = cut_unseen(card(disc(), repeats=2.0, clamp=True), least=0.5, finest=1 / 64)
    assert area(once) == pytest.approx(np.pi * 0.16 / 4, rel=0.02)


def test_texels_finer_than_parts_count_by_their_share() -> None:
    """A fence much finer than the parts stays whole if most of it is seen, and is not seen if most is not."""
    fence = np.zeros((8, 8), dtype=np.uint8)
    fence[:6] = 255
    seen, _ = cut_unseen(card(fence, repeats=1000.0), least=0.5, finest=0.2)
    assert area(seen) == pytest.approx(1.0)
    hidden = card(255 - fence, repeats=1000.0)
    assert cut_unseen(hidden, least=0.5, finest=0.2) == (hidden, 1.0)


def test_a_model_of_which_nothing_is_seen_is_built() -> None:
    """Some exporters write an alpha of 0 into all materials: the model is as without alpha, and that is said."""
    mesh = replace(box((0, 0, 0), (40, 32, 30)), opacities=(np.zeros((1, 1), dtype=np.uint8),))
    hidden, opaque = (legorize(mesh, Settings(width=5, least_alpha=least)) for least in (0.5, 0.0))
    np.testing.assert_array_equal(hidden.grid.colour, opaque.grid.colour)
    said = "The whole surface has an alpha below 0.5: it is built as if it were opaque."
    assert [said in build.notes for build in (hidden, opaque)] == [True, False]


def test_everything_is_built_at_zero() -> None:
    """At 0 the mesh comes back as it was; so does one without alpha."""
    mesh = card(disc())
    assert cut_unseen(mesh, least=0.0, finest=0.1)[0] is mesh
    opaque = replace(mesh, opacities=())
    assert cut_unseen(opaque, least=0.5, finest=0.1)[0] is opaque


def test_the_work_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """No more parts than the bound are made, and what is not cut any more is decided by its share."""
    monkeypatch.setattr("legorize_addon.core.texturing.cutouts._MOST_PARTS", 500)
    seen, _ = cut_unseen(card(disc(512)), least=0.5, finest=1e-3)
    assert len(seen.faces) <= 502
    assert area(seen) == pytest.approx(np.pi * 0.16, rel=0.1)


def test_a_leaf_is_built_as_a_disc_in_its_own_colour() -> None:
    """An upright card with a disc becomes a disc of green bricks alone, as wide as was asked for; that is told."""
    upright = card(disc())
    upright = replace(upright, vertices=upright.vertices[:, [0, 2, 1]] * 100)
    build = legorize(upright, Settings(width=20, seed=1))
    assert set(build.bricks.colour[build.bricks.role == 0].tolist()) == {2}
    solid = build.grid.solid.any(axis=(1, 2))
    assert solid.any(axis=0).sum() == 20
    widths = solid.sum(axis=1)
    # a disc: narrow below and above, wide in the middle; the card would be 20 studs wide everywhere
    assert widths[[0, -1]].max() < 12 < widths[len(widths) // 2]
    assert sum("alpha" in note for note in build.notes) == 1


def test_a_closed_body_with_a_window_keeps_its_walls() -> None:
    """A box whose front has a large clear window is an open box, with walls all around."""
    body = box((0, 0, 0), (40, 40, 40))
    front = np.flatnonzero(body.normals[:, 1] < 0)
    alpha = np.full((64, 64), 255, dtype=np.uint8)
    alpha[16:48, 16:48] = 0
    image = np.ones(len(body.faces), dtype=np.int32)
    image[front] = 0
    uvs = body.vertices[body.faces][..., [0, 2]] / 40
    mesh = replace(
        body, uvs=uvs, face_image=image,
        images=(np.full((64, 64, 3), 255, np.uint8), rgb_of([4])[None]),
        image_clamp=np.array([True, True]), opacities=(alpha, None),
    )  # fmt: skip
    build = legorize(mesh, Settings(width=16))
    solid = build.grid.solid.any(axis=1)
    middle = solid[solid.shape[0] // 2]
    wall = np.zeros_like(middle)
    wall[1:-1, 1:-1] = True
    wall[2:-2, 2:-2] = False
    wall[1, 5:-5] = False
    np.testing.assert_array_equal(middle, wall)


def test_the_sentence_on_what_is_left_out() -> None:
    """Nothing is said where nothing was left out; else the share is told."""
    assert remarks_on_unseen(0.0, least=0.5) == ()
    assert remarks_on_unseen(0.254, least=0.5)[0].startswith("25 % ")
    assert remarks_on_unseen(0.001, least=0.5)[0].startswith("Less than 1 % ")


def test_weights_stay_at_their_places() -> None:
    """A card whose weight rises along x has it there after its clear parts are cut off."""
    whole = card(disc())
    low, size = whole.vertices[:, 0].min(), np.ptp(whole.vertices[:, 0])
    seen, _ = cut_unseen(replace(whole, weight=(whole.vertices[:, 0] - low) / size), least=0.5, finest=0.1)
    assert len(seen.weight) == len(seen.vertices) != len(whole.vertices)
    np.testing.assert_allclose(seen.weight, (seen.vertices[:, 0] - low) / size, atol=1e-12)
