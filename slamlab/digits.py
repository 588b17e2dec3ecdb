"""Whole numbers as the course writes them: 1000 together, 10 000 in groups of three digits."""

import re

# five digits and more, but in names, times, fractions, addresses and behind a decimal point
_LARGE = re.compile(r"(?<![\w.,/:#=^])(?<!\w-)\d{5,}(?![\w/:])")


def grouped(told):
    """A number or a text, its whole numbers of five digits and more in groups of three.

    Parameters
    ----------
    told : int, float or str

    Returns
    -------
    str
    """
    return _LARGE.sub(lambda found: f"{int(found[0]):,}".replace(",", " "), str(told))
