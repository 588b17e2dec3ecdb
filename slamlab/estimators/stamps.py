"""What is odd about the stamps of readings. Poses hang on none; whoever looks at the log wants to
know."""

import numpy as np

PAUSE = 5.0  # times the usual time between readings: a gap
RECENT = 20  # readings that tell what is usual
SHORTEST = 0.1  # more often nobody need read [s]


def odd_stamp(times, time):
    """What is odd about a stamp.

    Who went back and returns to where the stamps had been has left no gap.

    Parameters
    ----------
    times : list of float, the stamps so far [s]
    time : float [s]

    Returns
    -------
    str, empty where nothing is
    """
    if not times:
        return ""
    if time == times[-1]:
        return "stamps repeated"
    if time < times[-1]:
        return "stamps going back"
    if len(times) < 2:
        return ""
    last = times[-RECENT:]
    usual = max(np.median(np.abs(np.diff(last))), SHORTEST)
    return "gaps" if time - max(last) > PAUSE * usual else ""
