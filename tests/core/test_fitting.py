"""The search for the largest model with a number of parts: on laws of growth that are known, even and uneven."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.estimate import counted_size, estimate
from legorize_addon.core.fitting import CLOSE, HASTY, WHOLE, fit
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.progress import silent
from legorize_addon.core.settings import Settings
from legorize_addon.core.stock.prices import Prices
from tests.core.any_bricks import CATALOGUE, table
from tests.core.solids import box
from tests.core.textured import painted

MESH = box((0, 0, 0), (40, 30, 20))


@dataclass(frozen=True)
class Made:
    """What the search reads of a build."""

    bricks: object
    settings: Settings
    prices: Prices | None = None
    notes: tuple[str, ...] = ()
    supports: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(removed=table([])))
    assembly: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(catalogue=CATALOGUE))


def maker(law, *, more=1.0, seen=None):
    """Return what builds models of so many parts as a law has for their scale, and more if they are built whole."""

    def make(mesh, settings, progress):
        progress("any", 1.0)
        count = round(law(settings.scale) * (1.0 if settings.supports == "none" else more))
        if seen is not None:
            seen.append((settings, count))
        return Made(table([(0, 0, 0, 0, 0, 4, 0, 0, 0)]).take(np.zeros(max(count, 1), dtype=np.intp)), settings)

    return make


def found(law, parts, **options):
    """Return how many parts the model has that is found."""
    return len(fit(MESH, Settings(size_by="parts", parts=parts), maker(law, **options), silent).bricks)


@given(st.floats(0.2, 5), st.floats(1.2, 3), st.floats(1, 1.3), st.integers(300, 5000))
def test_even_growth_is_met_within_three_percent(factor, power, more, parts):
    """A power law of any exponent, with more parts where it is built whole, is met in few models."""
    seen = []
    assert CLOSE * parts <= found(lambda scale: factor * scale**power, parts, more=more, seen=seen) <= parts
    assert len(seen) <= HASTY + WHOLE


@given(st.integers(300, 5000), st.floats(0, 6.28))
def test_uneven_growth_is_never_above(parts, phase):
    """Where a larger model may have fewer parts, the best that was seen is taken, and none above the number."""
    seen = []
    many = found(lambda scale: 3 * scale**2 * (1 + 0.02 * math.sin(40 * math.log(scale) + phase)), parts, seen=seen)
    assert many == max(count for settings, count in seen if settings.supports != "none" and count <= parts)
    assert many >= CLOSE * parts


def test_what_no_size_meets_is_as_near_as_can_be():
    """Parts in steps of a fifth: the step below the number."""
    law = lambda scale: 100 * 1.2 ** math.floor(math.log(scale**2, 1.2))  # noqa: E731 - a formula
    assert found(law, 1000) == round(100 * 1.2**12)


def test_too_few_parts_are_refused():
    """If no model is small enough, the sentence says how many the smallest has."""
    with pytest.raises(SettingsError, match=r"^parts is 5, but the smallest model found has 12: allow more parts\.$"):
        found(lambda scale: 12, 5)


def test_money_needs_prices():
    """A budget without a price file is refused."""
    with pytest.raises(SettingsError, match=r"^size_by is 'budget' but prices is empty: .*\.$"):
        fit(MESH, Settings(size_by="budget"), maker(lambda scale: scale), silent)


def test_budget_counts_supports():
    """Each part costs 0.2, and each model has ten supports: 40 buy the model of 190 parts."""
    price = Prices(np.full(CATALOGUE.exists.shape, 0.2), np.ones(CATALOGUE.exists.shape, bool), "EUR", 0)
    plain = maker(lambda scale: scale**2)

    def make(mesh, settings, progress):
        build = plain(mesh, settings, progress)
        ten = SimpleNamespace(removed=build.bricks.take(np.zeros(10, dtype=np.intp)))
        return replace(build, prices=price, supports=ten)

    made = fit(MESH, Settings(size_by="budget", budget=40.0, prices="p.csv"), make, silent)
    assert CLOSE * 40 <= 0.2 * (len(made.bricks) + 10) <= 40
    assert "of at most 40.00 EUR" in made.notes[-1]


def test_search_begins_where_the_estimate_has_the_number():
    """The estimate of the first size is the number of parts, whichever way up the mesh is."""
    for up in ("auto", "x"):
        first = counted_size(MESH, Settings(size_by="parts", parts=800, up=up))
        assert estimate(MESH, first).bricks == pytest.approx(800, rel=0.03)
        assert estimate(MESH, Settings(size_by="parts", parts=800, up=up)).bricks == pytest.approx(800, rel=0.03)


def test_a_real_model_keeps_to_the_number():
    """A box of at most 16 parts has nearly so many, keeps the settings, and says so."""
    settings, shares = Settings(size_by="parts", parts=16), []
    made = legorize(painted(MESH, 4), settings, lambda _, share: shares.append(share))
    assert 0.7 * 16 <= len(made.bricks) <= 16
    assert made.settings == settings
    assert f"The model has {len(made.bricks)} of at most 16 parts" in made.notes[-1]
    assert shares == sorted(shares)
