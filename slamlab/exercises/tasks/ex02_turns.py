"""A lidar's turns of which some readings did not come back, and the points made of the others."""

import numpy as np


def turns(rng, count, readings, empty):
    """What the device says; a reading that did not come back is 0 mm.

    Parameters
    ----------
    rng : numpy.random.Generator
    count, readings, empty : int, how many turns, readings of each, and of these without an answer

    Returns
    -------
    degrees, millimetres : (count, readings)
    """
    degrees = np.sort(rng.uniform(0, 360, (count, readings)), axis=1)
    millimetres = rng.uniform(300, 6000, (count, readings))
    for row in millimetres:
        row[rng.choice(readings, empty, replace=False)] = 0
    return degrees, millimetres


def back(i, values):
    """(n, k) of all readings to (n, k - empty) of those that came back."""
    return values[i["millimetres"] > 0].reshape(len(values), -1)


def points(i, o):
    """(n, k - empty) complex: the points of readings that came back, whether others were kept."""
    z = o["points"][..., 0] + 1j * o["points"][..., 1]
    found = np.full_like(back(i, z), np.nan)
    for row, (count, came) in enumerate(zip(o["count"], i["millimetres"] > 0, strict=True)):
        if count == came.sum():
            found[row] = z[row, : came.sum()]
        elif count == len(came):
            found[row] = z[row, came]
    return found
