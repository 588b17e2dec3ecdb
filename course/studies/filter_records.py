"""Record of a filter on a run through the arena: errors, association errors, box containment."""

from dataclasses import dataclass

import numpy as np

from slamlab.evaluation.containment import inside
from slamlab.filters.set_membership.angle_intervals import contains
from slamlab.geometry import transform
from slamlab.models.observation import g

LOST = 0.12  # error beyond which a filter is lost: the robot's width, so it would hit the wall [m]
SAME_CORNER = 0.06  # half the distance of the arena's nearest corners [m]


@dataclass(frozen=True)
class Record:
    """One filter on one run.

    Position ``errors`` (n,) [m]; number of ``landmarks`` at the end; ``false`` associations;
    ``duplicates``, the number of landmarks that repeat a corner; ``widths`` (n,) [m], the box's
    wider side; number of scans with the true pose ``outside``; whether the filter ``reported`` that
    it is lost. Values are None for a filter without its own association or without boxes.
    """

    errors: np.ndarray
    landmarks: int
    false: int | None = None
    duplicates: int | None = None
    widths: np.ndarray | None = None
    outside: int | None = None
    reported: bool | None = None


def record(slam, source, readings):
    """Run a new Estimator on an ArenaRun whose readings with corners are given."""
    observed, boxes = [], []
    for reading, pose in zip(readings, source.truth.poses, strict=True):
        slam.step(reading)
        for i, k in getattr(slam, "associated", {}).items():
            observed.append((i, g(pose, slam.observations.z[k])))
        if hasattr(getattr(slam, "filter", None), "heading"):
            boxes.append((slam.filter.robot, slam.filter.heading, pose))
    errors = np.hypot(*(slam.trajectory().poses - source.truth.poses)[:, :2].T)
    landmarks = len(slam.filter.ids) if hasattr(slam, "filter") else 0
    corners = np.unique(source.world.walls.reshape(-1, 2).round(9), axis=0)
    more = association_errors(observed, corners) if hasattr(slam, "associated") else {}
    if boxes:
        more["widths"] = np.array([np.diff(robot)[::2].max() for robot, _, _ in boxes])
        more["outside"] = sum(not holds(*each) for each in boxes)
        more["reported"] = bool(slam.lost)
    return Record(errors, landmarks, **more)


def association_errors(observed, corners):
    """Count "false" associations and "duplicates" among observed positions, (id, (2,) from the true
    pose [m]).

    An association is false if the position is more than ``SAME_CORNER`` from the landmark's first
    position and is nearest to another true corner. Landmarks first observed within ``SAME_CORNER``
    of each other are duplicates.
    """
    first, false, duplicates = {}, 0, 0

    def nearest(place):
        return np.hypot(*(corners - place).T).argmin()

    for i, place in observed:
        if i in first:
            apart = np.hypot(*(place - first[i])) > SAME_CORNER
            # one condition alone may be a noisy corner, or a crossing of two boxes' lines
            false += apart and nearest(place) != nearest(first[i])
            continue
        duplicates += any(np.hypot(*(place - p)) < SAME_CORNER for p in first.values())
        first[i] = place
    return {"false": int(false), "duplicates": int(duplicates)}


def holds(robot, heading, pose):
    """Return whether a box (4,) and an interval of headings (2,) contain a pose (3,)."""
    return bool(inside(robot, pose) and contains(heading, pose[2]))


def scan_points(source, poses):
    """Transform all scans of a run by a filter's poses (n, 3); return points (k, 2) [m], as in the
    thesis."""
    scans = zip(source, poses, strict=True)
    return np.concatenate([transform(pose, reading.scan.points()) for reading, pose in scans])


def summary(errors, laps=3):
    """Summarise position errors (n,) [m].

    "laps_m": error at each lap's end; "rms_m"; "strayed": whether the error ever exceeded ``LOST``;
    "before_m": RMS until it strayed; "lost": whether the error exceeds ``LOST`` at the end;
    "lost_at": share of the run before it was lost, or None.
    """
    far = errors > LOST
    before = errors[: int(np.argmax(far))] if far.any() else errors
    last_good = np.flatnonzero(~far)[-1]  # it exists: every run begins at the truth
    return {
        "laps_m": [float(errors[len(errors) * lap // laps - 1]) for lap in range(1, laps + 1)],
        "rms_m": float(np.sqrt(np.mean(errors**2))),
        "before_m": float(np.sqrt(np.mean(before**2))),
        "strayed": bool(far.any()),
        "lost": bool(far[-1]),
        "lost_at": float(last_good + 1) / len(errors) if far[-1] else None,
    }


def nearer(first, second):
    """Return whether the first estimate has smaller errors (n,) until either estimate strays."""
    far = np.maximum(first, second) > LOST
    until = slice(int(np.argmax(far)) if far.any() else len(far))
    return bool(np.sum(first[until] ** 2) < np.sum(second[until] ** 2))
