"""Whether two texts say the same: words exactly, numbers within a relative tolerance."""

import re

NUMBER = re.compile(r"(?<![A-Za-z0-9_.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![A-Za-z0-9_])")


def last_digit(number: str) -> float:
    """What one unit of the last decimal written is worth: 0.01 in `3.42`, 10 in `1.2e2`; 0 for whole numbers,
    which have the relative tolerance alone."""
    mantissa, _, exponent = number.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals) if decimals else 0.0


def same_number(old: str, new: str, tolerance: float) -> bool:
    """One unit of the last decimal is always allowed where there is a tolerance: rounding may go either way."""
    if old == new:
        return True
    if tolerance == 0:
        return False
    a, b = float(old), float(new)
    return abs(a - b) <= tolerance * max(abs(a), abs(b)) + 1.001 * max(last_digit(old), last_digit(new))


def same_text(old: str, new: str, tolerance: float) -> bool:
    def words(text: str) -> list[str]:
        return NUMBER.sub("#", text).split()

    if words(old) != words(new):
        return False
    pairs = zip(NUMBER.findall(old), NUMBER.findall(new), strict=True)
    return all(same_number(a, b, tolerance) for a, b in pairs)
