"""What a build will come to is known before, near enough."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import legorize_addon.core.estimate as module
from legorize_addon.core.errors import MeshError, SettingsError
from legorize_addon.core.estimate import AGAIN, Measured, estimate, estimate_of
from legorize_addon.core.mosaic_estimate import estimate_mosaic
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.solids import box, mesh_of, sheet, sphere
from tests.core.textured import blob, table, torus

GOLDEN = Path(__file__).parents[1] / "golden" / "estimates.json"
MESHES = {"box": box((0, 0, 0), (30, 20, 25)), "ball": sphere(16), "torus": torus(), "table": table(), "blob": blob(8)}


BUILDS = {
    "ball": (sphere(16), Settings(width=48)),
    "large ball": (sphere(16), Settings(width=192, prove_steps=True)),
    "painted": (blob(8), Settings(width=32, layout="exact")),
    "solid box": (MESHES["box"], Settings(width=64, layout="fast", hollow=False)),
}


def test_fitted_figures_are_those_of_the_golden_file():
    """Bricks, memory and seconds follow from coefficients that were fitted to builds, and change only with a new fit.

    After ``scripts/benchmark.py budget``, with other coefficients, write the file anew: it is ``figures()`` as JSON.
    """
    expected = json.loads(GOLDEN.read_text(encoding="utf-8"))
    found = figures()
    assert list(found) == list(expected)
    for name, values in found.items():
        assert values == pytest.approx(expected[name], rel=1e-6), name


def figures():
    """Return what is estimated of some builds."""
    made = {name: estimate(mesh, settings) for name, (mesh, settings) in BUILDS.items()}
    made["picture"] = estimate_mosaic((48, 32), Settings(mosaic="bricks", layout="fast", prove_steps=True))
    return {name: {"bricks": each.bricks, "megabytes": each.megabytes, **each.stages} for name, each in made.items()}


@pytest.mark.parametrize("options", [{}, {"plates": "none"}, {"hollow": False}], ids=str)
@pytest.mark.parametrize("name", MESHES)
def test_bricks_and_cells_are_near_what_is_built(name, options):
    """The cells of the grid are right to a quarter, the number of bricks to half of it."""
    settings = Settings(width=32, supports="none", strengthen=False, **options)
    expected, build = estimate(MESHES[name], settings), legorize(MESHES[name], settings)
    assert expected.cells == pytest.approx(build.grid.solid.size, rel=0.25)
    assert 1 / 1.5 < expected.bricks / len(build.bricks) < 1.5
    layers = build.grid.solid.any(axis=(1, 2, 3)).sum()
    assert abs(expected.layers - layers) <= 1


def test_a_mesh_is_measured_once_for_all_settings(monkeypatch):
    """What was measured gives the estimates of the mesh, without its triangles, also of sizes that are searched."""
    measured = Measured.of(MESHES["blob"], "auto")
    chosen = (Settings(width=24), Settings(size_by="parts", parts=500), Settings(size_by="scale", scale=3.0))
    expected = [estimate(MESHES["blob"], each) for each in chosen]
    monkeypatch.setattr(Measured, "of", None)
    assert [estimate_of(measured, each) for each in chosen] == expected


def test_triangles_are_measured_in_any_portions(monkeypatch):
    """Area and volume are sums over all triangles, however many are taken at a time."""
    whole = Measured.of(MESHES["blob"], "auto")
    monkeypatch.setattr(module, "_AT_ONCE", 7)
    parts = Measured.of(MESHES["blob"], "auto")
    found, expected = ((each.flat, each.curved, each.volume) for each in (parts, whole))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


def test_size_is_that_of_the_settings():
    """A box of 30 x 20 x 25 is 24 studs, 16 studs and 20 cm / 1.2 high if it shall be 24 studs wide."""
    found = estimate(MESHES["box"], Settings(width=24))
    assert found.studs == pytest.approx((24, 16))
    assert found.cm == pytest.approx((19.2, 12.8, 16.0))
    assert found.layers == 17
    by_height = estimate(MESHES["box"], Settings(size_by="height", height=10))
    assert by_height.layers == 10
    assert by_height.cm[2] == pytest.approx(9.6)


def test_size_is_that_of_the_turned_mesh():
    """Of a box of 30 x 20 x 25 the axis that points up gives the height."""
    for up, cm in (("x", (25, 20, 30)), ("y", (30, 25, 20)), ("z", (30, 20, 25)), ("auto", (30, 20, 25))):
        found = estimate(MESHES["box"], Settings(size_by="height", height=10, up=up))
        assert found.cm == pytest.approx(np.array(cm) * 9.6 / cm[2])


def test_everything_grows_with_the_size():
    """Twice the width is more of everything, and about four times the bricks."""
    small, large = (estimate(MESHES["ball"], Settings(width=width)) for width in (48, 96))
    assert large.bricks == pytest.approx(4 * small.bricks, rel=0.01)
    assert large.cells == pytest.approx(8 * small.cells, rel=0.1)
    assert large.megabytes > small.megabytes
    assert large.seconds > 3 * small.seconds


def test_stages_are_those_that_come():
    """Every stage of a run has its expected seconds, in the order in which the stages are told."""
    settings = Settings(width=12, prove_steps=True)
    told: list[str] = []
    legorize(MESHES["ball"], settings, lambda stage, share: told.append(stage))
    expected = [name for name in estimate(MESHES["ball"], settings).stages if not name.endswith(AGAIN)]
    assert [name for name in dict.fromkeys(told) if name != "connection"] == expected
    assert expected[-1] == "proof"


def test_settings_that_take_longer_are_expected_to():
    """The exact layout and the proof of all steps take longer, the quick layout less; a solid model has more bricks."""
    times = [estimate(MESHES["ball"], Settings(layout=tier)).seconds for tier in ("fast", "standard", "exact")]
    assert times == sorted(times)
    assert estimate(MESHES["ball"], Settings(prove_steps=True)).seconds > 2 * times[1]
    solid, hollow = (estimate(MESHES["ball"], Settings(hollow=hollow)).bricks for hollow in (False, True))
    assert solid > 1.5 * hollow


def test_what_lies_about_does_not_count():
    """Vertices without a face change nothing, and a sheet without volume has its bricks."""
    mesh = MESHES["box"]
    more = mesh_of(np.concatenate([mesh.vertices, [[1e6, 0, 0]]]), mesh.faces)
    assert estimate(more, Settings()).studs == estimate(mesh, Settings()).studs
    assert estimate(sheet(), Settings(width=24)).bricks > 10


@pytest.mark.parametrize(
    ("mesh", "options", "kind"),
    [
        (mesh_of(box().vertices, []), {}, MeshError),
        (mesh_of(np.where(box().vertices == 1, np.nan, 0), box().faces), {}, MeshError),
        (mesh_of(box().vertices * 0, box().faces), {}, MeshError),
        (sheet(), {"size_by": "height"}, SettingsError),
    ],
)
def test_what_cannot_be_built_is_not_estimated(mesh, options, kind):
    """What is refused anyway is refused here in the same words."""
    with pytest.raises(kind) as early:
        estimate(mesh, Settings(**options))
    with pytest.raises(kind) as late:
        legorize(mesh, Settings(**options))
    assert str(early.value) == str(late.value)
