"""Prices and quantities as people and programs write them: decimal comma or point, with or without a currency."""

from __future__ import annotations

import re
from typing import Final

_SIGNS: Final = {"€": "EUR", "£": "GBP", "$": "USD", "¥": "JPY", "zł": "PLN", "kč": "CZK", "₩": "KRW", "₹": "INR"}
"""Currencies by their signs; the dollar is the American one unless letters before it say otherwise."""

_LETTERED: Final = {
    "US": "USD",
    "CA": "CAD",
    "C": "CAD",
    "AU": "AUD",
    "A": "AUD",
    "NZ": "NZD",
    "HK": "HKD",
    "SG": "SGD",
}
_NUMBER: Final = re.compile(r"[0-9][0-9.,'’\u00a0\u202f ]*|[.,][0-9]+")  # noqa: RUF001 - an apostrophe of thousands
_CODE: Final = re.compile(r"\b[A-Z]{3}\b")
_DOLLAR: Final = re.compile(r"\b([A-Z]{1,2}) ?\$")


def amount(text: str) -> float | None:
    """Return the number of a price or quantity, None if there is none or it is negative.

    Parameters
    ----------
    text : str
        Such as ``0,05``, ``US $1,234.50``, ``1.234,5 EUR``.

    Returns
    -------
    float or None
        The last of comma and point is the decimal one, unless it occurs twice: then it divides thousands.
    """
    found = _NUMBER.search(text)
    if found is None or text[: found.start()].rstrip().endswith("-"):
        return None
    digits = re.sub(r"['’\u00a0\u202f ]", "", found.group())  # noqa: RUF001 - an apostrophe of thousands
    point = max(digits.rfind("."), digits.rfind(","))
    if point < 0:
        return float(digits)
    again = digits.count(digits[point]) > 1
    whole, rest = (digits, "") if again else (digits[:point], digits[point + 1 :])
    return float(f"{re.sub('[.,]', '', whole) or 0}.{re.sub('[.,]', '', rest) or 0}")


def currency(text: str) -> str:
    """Return the code of the currency that a price is in, empty if it does not say."""
    if lettered := _DOLLAR.search(text.upper()):
        return _LETTERED.get(lettered.group(1), "USD")
    if code := _CODE.search(text):
        return code.group()
    return next((code for sign, code in _SIGNS.items() if sign in text.casefold()), "")
