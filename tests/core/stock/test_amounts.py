"""Prices as people and programs write them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.stock.amounts import amount, currency


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("0.05", 0.05),
        ("0,05", 0.05),
        (",5", 0.5),
        ("0,1234 €", 0.1234),
        ("US $1,234.50", 1234.5),
        ("1.234,5 EUR", 1234.5),
        ("1'234.5", 1234.5),
        ("1 234,5", 1234.5),
        ("1.234.567", 1234567.0),
        ("~EUR 0.0123", 0.0123),
        ("12", 12.0),
        ("", None),
        ("none", None),
        ("-1.0000", None),
    ],
)
def test_numbers_are_read_in_every_spelling(text, number):
    """The last of comma and point is the decimal one; what is negative or no number is none."""
    assert amount(text) == number


@given(st.integers(0, 10**9), st.sampled_from(".,"))
def test_what_was_written_is_read(number, point):
    """Four digits after the point or comma come back."""
    assert amount(f"{number // 10**4}{point}{number % 10**4:04}") == pytest.approx(number / 10**4)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("0,05 €", "EUR"), ("EUR 0.05", "EUR"), ("US $0.05", "USD"), ("$0.05", "USD"), ("CA $1", "CAD"), ("£1", "GBP"),
        ("1 Kč", "CZK"), ("0.05", ""),
    ],
)  # fmt: skip
def test_currencies(text, code):
    """Codes and signs are recognised, and nothing where there is none."""
    assert currency(text) == code
