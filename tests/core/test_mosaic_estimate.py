"""What a mosaic will come to."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.mosaic_estimate import estimate_mosaic
from legorize_addon.core.pipeline import legorize_image
from legorize_addon.core.settings import Settings
from tests.core.mosaic.pictures import CATALOGUE, painted


@pytest.mark.parametrize("kind", ["tiles", "bricks"])
def test_estimate_is_near(kind):
    """Size and bricks of a rich picture are near what is expected, and so are the stages."""
    rng = np.random.default_rng(0)
    mosaic = legorize_image(painted(rng.choice(CATALOGUE.codes, (24, 24))), Settings(width=24, mosaic=kind))
    expected = estimate_mosaic(mosaic.canvas.size, mosaic.settings)
    assert expected.studs == (24, 24)
    assert expected.cm == pytest.approx((19.2, 19.2, 1.28 if kind == "bricks" else 0.64))
    assert 0.5 < expected.bricks / len(mosaic.bricks) < 2
    assert list(expected.stages) == list(mosaic.timings)


def test_estimate_of_a_wall_is_near():
    """One that stands: its height in bricks, twice the cells, and the stages of a model."""
    rng = np.random.default_rng(0)
    settings = Settings(width=24, standing=True, feet=False)
    mosaic = legorize_image(painted(rng.choice(CATALOGUE.codes, (24, 24))), settings)
    expected = estimate_mosaic(mosaic.canvas.size, settings)
    assert (expected.studs, expected.layers) == ((24, 2), 20)
    assert expected.cm == pytest.approx((19.2, 1.6, 19.2))
    assert 0.5 < expected.bricks / len(mosaic.bricks) < 2
    assert list(expected.stages) == list(mosaic.timings)


def test_a_proof_takes_longer():
    """It is among the stages only where it is asked for."""
    usual, proven = (estimate_mosaic((48, 48), Settings(prove_steps=proof)) for proof in (False, True))
    assert proven.seconds > 2 * usual.seconds
