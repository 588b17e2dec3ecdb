"""Rows of the table that compares filters: Records of many runs, compared with odometry."""

import numpy as np

from course.studies.filter_records import nearer, summary
from course.studies.paired_statistics import (
    mcnemar_test,
    median_interval,
    paired_difference,
    share_interval,
)


def row(records, odometry, monte_carlo):
    """Make one row from the Records of a filter, odometry and Monte Carlo on the same runs.

    The row contains (value, low, high) of medians, differences [m] and shares, the counts for the
    shares, and each run's RMS error.
    """
    found, alone = ([summary(each.errors) for each in runs] for runs in (records, odometry))
    strayed, lost = (sum(each[key] for each in found) for key in ("strayed", "lost"))
    laps, naive = (np.array([each["laps_m"] for each in many]).T for many in (found, alone))
    rms, naive_rms = ([each["rms_m"] for each in many] for many in (found, alone))
    pairs = list(zip(records, monte_carlo, strict=True))
    return {
        "runs": len(records),
        "runs_strayed": strayed,
        "runs_lost": lost,
        "rms_m": median_interval(rms),
        "rms_each_m": [round(each, 4) for each in rms],
        "before_m": median_interval([each["before_m"] for each in found]),
        "laps_m": [median_interval(lap) for lap in laps],
        "lap_3_minus_lap_1_m": paired_difference(laps[-1], laps[0]),
        "rms_minus_odometry_m": paired_difference(rms, naive_rms),
        "laps_minus_odometry_m": [
            paired_difference(*pair) for pair in zip(laps, naive, strict=True)
        ],
        "nearer_than_odometry": share_interval(int(np.sum(np.less(rms, naive_rms))), len(rms)),
        "nearer_than_monte_carlo": share_interval(
            sum(nearer(mine.errors, other.errors) for mine, other in pairs), len(pairs)
        ),
        "strayed": share_interval(strayed, len(found)),
        "lost": share_interval(lost, len(found)),
        "lost_only_it_only_odometry_p": mcnemar_test(
            *([e["lost"] for e in m] for m in (found, alone))
        ),
        "lost_of_strayed": share_interval(lost, strayed) if strayed else None,
        "landmarks": round(float(np.mean([each.landmarks for each in records])), 1),
        "association": _association(records),
        "box": _box(records),
    }


def _association(records):
    """Sum the association errors; return None if the filter uses given associations."""
    if records[0].false is None:
        return None
    return {
        "false": sum(each.false for each in records),
        "runs_with_false": sum(each.false > 0 for each in records),
        "duplicates": sum(each.duplicates for each in records),
    }


def _box(records):
    """Summarise the widths of the robot's box and the true poses outside it; return None if the
    filter has no box."""
    if records[0].widths is None:
        return None
    ends = zip(*(summary(each.widths)["laps_m"] for each in records), strict=True)
    return {
        "scans": sum(len(each.widths) for each in records),
        "scans_outside": sum(each.outside for each in records),
        "runs_outside": sum(each.outside > 0 for each in records),
        "runs_outside_reported": sum(each.outside > 0 and each.reported for each in records),
        "widest_m": median_interval([float(each.widths.max()) for each in records]),
        "laps_m": [median_interval(end) for end in ends],
    }


def rows(results):
    """Return {name: row} for many runs, each {name: Record}."""
    runs = {name: [result[name] for result in results] for name in results[0]}
    return {name: row(each, runs["odometry"], runs["Monte Carlo"]) for name, each in runs.items()}
