"""What is larger than the limits allow is refused before the work, and what is not passes."""

from __future__ import annotations

import pytest

from legorize_addon.core.errors import BuildError, LimitError
from legorize_addon.core.estimate import estimate
from legorize_addon.core.limits import check_limits, check_size, within_limits
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.settings import Settings
from tests.core.any_bricks import CATALOGUE
from tests.core.any_bricks import table as bricks_of
from tests.core.solids import box, mesh_of, sphere
from tests.core.textured import blob, table, torus

MESHES = (box((0, 0, 0), (30, 20, 25)), sphere(16), torus(), table(), blob(8))
ONE = CATALOGUE.part_row("3005")
POLE = box((0, 0, 0), (0.2, 0.2, 8.0))


def refusal(mesh, settings):
    """Return the sentence with which a model is refused before the work."""
    with pytest.raises(LimitError) as refused:
        check_limits(estimate(mesh, settings), settings)
    return str(refused.value)


def test_a_thin_pole_is_refused_with_its_height():
    """A pole forty times as high as wide would be 15 m high: the sentence says so, and which width would do."""
    sentence = refusal(POLE, Settings())
    assert sentence.startswith("The model would be 15 m high (1,600 layers) on 48 x 48 studs, have about 4")
    assert sentence.endswith("choose a width of 9 or less, or raise limit_size to 1600.")
    assert ". " not in sentence
    for width in (9, 48):
        settings = Settings(width=width, limit_size=1600 if width == 48 else Settings().limit_size)
        check_limits(estimate(POLE, settings), settings)


def test_a_lying_pole_is_refused_by_its_length():
    """If the height is asked for, the width may be what nobody expects."""
    lying = mesh_of(POLE.vertices[:, [2, 1, 0]], POLE.faces)
    sentence = refusal(lying, Settings(size_by="height", height=40))
    assert "1,920 x 48 studs" in sentence
    assert "choose a height of 7 or less" in sentence


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"limit_bricks": 100}, "raise limit_bricks to"),
        ({"limit_memory": 200, "width": 150}, "raise limit_memory to"),
        ({"limit_size": 10, "limit_bricks": 100}, "raise limit_size to 39 and limit_bricks to"),
        ({"size_by": "scale", "scale": 1e3, "limit_size": 100}, "choose a scale of"),
    ],
    ids=str,
)
def test_limits_can_be_raised(options, words):
    """Each limit is named where it is passed, and settings that were raised as the sentence says pass."""
    ball, settings = sphere(16, 20.0), Settings(**options)
    assert words in refusal(ball, settings)
    raised = within_limits(estimate(ball, settings), settings)
    check_limits(estimate(ball, raised), raised)
    assert raised.width == settings.width


def test_what_no_limit_allows_is_not_offered():
    """A model of kilometres cannot be had by any limit, and no number is longer than it says something."""
    sentence = refusal(POLE, Settings(size_by="scale", scale=1e6, limit_size=1_000_000))
    assert "raise" not in refusal(mesh_of(POLE.vertices * 1e6, POLE.faces), Settings(size_by="scale", scale=1e6))
    assert len(sentence) < 300


@pytest.mark.parametrize("width", [48, 192])
def test_usual_models_pass(width):
    """A ball, a ring, a table and a box of the usual sizes are built without a question."""
    for mesh in MESHES:
        settings = Settings(width=width)
        check_limits(estimate(mesh, settings), settings)


@pytest.mark.parametrize(
    ("rows", "changes", "error", "message"),
    [
        ([], {}, BuildError, "There are no bricks"),
        ([(0, 0, 0), (10**6, 0, 0)], {}, LimitError, "800,001 cm long, more than the limit of 300 cm"),
        ([(0, 0, 0), (0, 0, 10**6)], {}, LimitError, "320,001 cm long"),
        ([(0, 0, 0)] * 11, {"limit_bricks": 10}, LimitError, "has 11 bricks, more than the limit of 10"),
        ([(0, 0, 0), (370, 370, 900)], {"limit_memory": 200}, LimitError, "would take about 4,4.. MB"),
    ],
)
def test_models_above_the_limits_are_refused(rows, changes, error, message):
    """Too far apart, too many, too much memory: one sentence, before anything is computed."""
    bricks = bricks_of([(ONE, *row, 0, 4, 0, 0, 0) for row in rows])
    with pytest.raises(error, match=message):
        check_size(bricks, Settings(**changes))


def test_supports_alone_are_no_model():
    """What is taken out again leaves nothing: a file of supports is refused, one with a brick that stays is not."""
    rows = [(ONE, 0, 0, 0, 0, 4, int(Role.SUPPORT_OUTSIDE), 0, 0), (ONE, 0, 0, 3, 0, 4, 0, 0, 0)]
    with pytest.raises(BuildError, match="There are no bricks"):
        check_size(bricks_of(rows[:1]), Settings())
    check_size(bricks_of(rows), Settings())
