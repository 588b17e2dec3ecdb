"""Colours: a colour-blind-safe palette, one colour for each meaning. The contrast with white is at
least 3:1 for lines and 4.5:1 for text (WCAG 2.2, 1.4.11 and 1.4.3).
"""

from dataclasses import dataclass

import numpy as np
from matplotlib.colors import to_rgb


@dataclass(frozen=True)
class Meaning:
    """A colour (#RRGGBB), its mark (line style, dots, arrow, fill), and a description."""

    colour: str
    mark: str
    description: str


MEANINGS = {
    "truth": Meaning("#000000", "solid", "ground truth: the true trajectory or value"),
    "walls": Meaning("#8A8A8A", "solid", "the walls of the world"),
    "naive": Meaning("#B83A00", "solid", "odometry alone; errors"),
    "predicted": Meaning("#7B52C7", "dashed", "prior: the estimate before a measurement"),
    "corrected": Meaning("#005FA3", "solid", "posterior: the estimate after the measurement"),
    "map": Meaning("#005FA3", "dots", "points of the map; the reference scan"),
    "scan": Meaning("#CC7F00", "dots", "measurements"),
    "landmark": Meaning("#00774F", "solid", "landmarks, and their covariance"),
    "robot": Meaning("#B5489A", "arrow", "the robot, and its covariance"),
    "sample": Meaning("#B5489A", "dots", "particles (samples)"),
    "box": Meaning("#3794CF", "solid", "boxes of the set-membership filter"),
    "before": Meaning("#8A8A8A", "dashed", "an earlier state, for comparison"),
    "limit": Meaning("#8A8A8A", "dashdot", "a bound with which a curve is compared"),
    "perpendicular": Meaning("#8A8A8A", "dotted", "line from the origin to a wall's foot point"),
    "guide": Meaning("#BBBBBB", "fill", "grids, fills, auxiliary lines"),
}
COLOURS = {name: meaning.colour for name, meaning in MEANINGS.items()}
IN_LEGENDS = {"naive": "odometry alone", "corrected": "estimate"}  # others: the layer's name
DASHES = {  # line styles other than solid
    name: meaning.mark
    for name, meaning in MEANINGS.items()
    if meaning.mark in ("dashed", "dotted", "dashdot")
}

# chart series without a fixed meaning: colour, line style, marker
SERIES = [
    (COLOURS["corrected"], "solid", "o"),
    (COLOURS["naive"], "dashed", "s"),
    (COLOURS["landmark"], "dotted", "^"),
    (COLOURS["truth"], "dashdot", "D"),
]


def in_legends(name):
    """Return the legend entry for a layer's name."""
    return IN_LEGENDS.get(name, name)


def luminance(colour):
    """Return the relative luminance as defined in WCAG 2.2, from 0 (black) to 1 (white)."""
    encoded = np.array(to_rgb(colour))
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def contrast(colour, ground="#FFFFFF"):
    """Return the contrast ratio of WCAG 2.2, (L₁ + 0.05) / (L₂ + 0.05), from 1 to 21."""
    low, high = sorted([luminance(colour), luminance(ground)])
    return (high + 0.05) / (low + 0.05)
