"""Outputs whose numbers hang on a processor's rounding are compared nearly, by nbval.

A cell tagged ``nearly`` beside ``nbval-check-output`` must print the stored words, and numbers that
differ from the stored ones by at most a third, or by two units of their last digit. All other cells
must print what is stored. ``course/perturbed_rounding`` shows which cells need it.
"""

import re
from itertools import zip_longest

from nbval.plugin import IPyNbCell

TAG = "nearly"
NUMBER = re.compile(r"\s*[-+−]?\d[\d,]*\.?\d*(?:e[-+]?\d+)?")
exactly = IPyNbCell.compare_outputs


def value(number):
    """A printed number, and one unit of its last digit."""
    plain = number.strip().replace(",", "").replace("−", "-")
    mantissa, _, power = plain.partition("e")
    digits = len(mantissa.partition(".")[2])
    return float(plain), 10.0 ** (int(power or 0) - digits)


def near(a, b):
    """Whether two printed numbers differ by rounding only."""
    (a, unit), (b, other) = value(a), value(b)
    return abs(a - b) <= max(max(abs(a), abs(b)) / 3, 2.01 * max(unit, other))


def settled(found, stored):
    """What was printed, each number that is near the stored one replaced by it."""
    theirs = iter(NUMBER.findall(stored))

    def settle(match):
        number = next(theirs, None)
        return number if number is not None and near(match[0], number) else match[0]

    return NUMBER.sub(settle, found)


def texts(output):
    """The texts of one output, each with the dictionary and the key that hold it."""
    places = [(output, "text"), (output.get("data", {}), "text/plain")]
    return [(holder, key) for holder, key in places if key in holder]


def compare(cell, test, ref, skip_compare=None):
    """Compare a cell's outputs as nbval does, numbers nearly if it is tagged so."""
    if TAG in cell.cell.metadata.get("tags", []):
        for found, stored in zip_longest(test, ref, fillvalue={}):
            for (holder, key), (true, _) in zip(texts(found), texts(stored), strict=False):
                if key in true:
                    holder[key] = settled(holder[key], true[key])
    return exactly(cell, test, ref, skip_compare)


IPyNbCell.compare_outputs = compare
