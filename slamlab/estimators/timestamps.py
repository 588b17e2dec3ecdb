"""Timestamp anomalies of a log (repeated, going back, gaps), which change no estimate."""

import numpy as np

GAP_FACTOR = 5.0  # times the median period of the readings: a gap [1]
MEDIAN_WINDOW = 20  # readings of which the median period is taken
MIN_PERIOD = 0.1  # a shorter median period is taken for this [s]


def timestamp_anomaly(times, time):
    """The timestamp anomaly of a reading: repeated, going back, or after a gap.

    A clock that went back and returns to where the timestamps had been has left no gap.

    Parameters
    ----------
    times : list of float, the timestamps so far [s]
    time : float [s]

    Returns
    -------
    str, empty where there is none
    """
    if not times:
        return ""
    if time == times[-1]:
        return "timestamps repeated"
    if time < times[-1]:
        return "timestamps going back"
    if len(times) < 2:
        return ""
    last = times[-MEDIAN_WINDOW:]
    since = time - max(last)
    if since <= GAP_FACTOR * MIN_PERIOD:  # nearly always: a median of each step would be dear
        return ""
    usual = max(np.median(np.abs(np.diff(last))), MIN_PERIOD)
    return "gaps" if since > GAP_FACTOR * usual else ""
