"""Colours of the whole course, a colour-blind-safe palette: one a meaning, in one table.

Marks that carry a meaning have a contrast of 3:1 to white paper, letters 4.5:1 (WCAG 2.2, success
criteria 1.4.11 and 1.4.3). Meanings whose colours look alike to somebody differ in their marks.
"""

from dataclasses import dataclass

import numpy as np
from matplotlib.colors import to_rgb


@dataclass(frozen=True)
class Meaning:
    """What a colour stands for.

    Parameters
    ----------
    colour : str, #RRGGBB
    mark : str, what it is drawn as: a dash of lines (solid, dashed, dotted, dashdot), dots, arrow,
        fill
    says : str, the meaning in words
    """

    colour: str
    mark: str
    says: str


MEANINGS = {
    "truth": Meaning("#000000", "solid", "what is so: the true way, the true value"),
    "walls": Meaning("#8A8A8A", "solid", "the walls of the world"),
    "naive": Meaning("#B83A00", "solid", "odometry alone; what goes wrong"),
    "predicted": Meaning("#7B52C7", "dashed", "what is believed before a measurement"),
    "corrected": Meaning("#005FA3", "solid", "what is believed after it; the result"),
    "map": Meaning("#005FA3", "dots", "the points of the map; the scan that stays"),
    "scan": Meaning("#CC7F00", "dots", "what is measured"),
    "landmark": Meaning("#00774F", "solid", "landmarks, and the doubt of them"),
    "robot": Meaning("#B5489A", "arrow", "the robot, and the doubt of it"),
    "sample": Meaning("#B5489A", "dots", "samples (particles)"),
    "box": Meaning("#3794CF", "solid", "boxes of the bounded filter"),
    "before": Meaning("#8A8A8A", "dashed", "what was, beside what is now"),
    "limit": Meaning("#8A8A8A", "dashdot", "a bound that a curve is held against"),
    "perpendicular": Meaning("#8A8A8A", "dotted", "from the origin to the foot of a wall"),
    "guide": Meaning("#BBBBBB", "fill", "nothing of its own: grids, fills, help lines"),
}
COLOURS = {name: meaning.colour for name, meaning in MEANINGS.items()}
IN_LEGENDS = {"naive": "odometry alone", "corrected": "estimate"}  # else a layer's name itself
DASHES = {  # of those whose lines are told apart by more than their colour
    name: meaning.mark
    for name, meaning in MEANINGS.items()
    if meaning.mark in ("dashed", "dotted", "dashdot")
}

# series of a chart that have no meaning of their own: colour, dash, marker
SERIES = [
    (COLOURS["corrected"], "solid", "o"),
    (COLOURS["naive"], "dashed", "s"),
    (COLOURS["landmark"], "dotted", "^"),
    (COLOURS["truth"], "dashdot", "D"),
]


def in_legends(name):
    """What a legend says of a layer or curve that has no other label than its name.

    Parameters
    ----------
    name : str, such as "naive"

    Returns
    -------
    str, such as "odometry alone"
    """
    return IN_LEGENDS.get(name, name)


def luminance(colour):
    """Relative luminance of a colour, from 0 (black) to 1 (white), as WCAG 2.2 defines it.

    Parameters
    ----------
    colour : what matplotlib takes for one

    Returns
    -------
    float [1]
    """
    encoded = np.array(to_rgb(colour))
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def contrast(colour, ground="#FFFFFF"):
    """Contrast ratio (L₁ + 0.05) / (L₂ + 0.05) of two colours' luminances, WCAG 2.2.

    Parameters
    ----------
    colour, ground : what matplotlib takes for colours

    Returns
    -------
    float, from 1 to 21
    """
    low, high = sorted([luminance(colour), luminance(ground)])
    return (high + 0.05) / (low + 0.05)
