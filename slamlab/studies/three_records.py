"""What is recorded of one filter on one drive through the arena: errors, association, boxes."""

from dataclasses import dataclass

import numpy as np

from slamlab.filters.bor.angle_intervals import contains
from slamlab.geometry import transform
from slamlab.models.observation import g

LOST = 0.12  # a filter farther off is lost: by the robot's width it would hit the wall [m]
SAME_CORNER = 0.06  # half of what the arena's nearest corners are apart [m]


@dataclass(frozen=True)
class Record:
    """One filter on one drive.

    Parameters
    ----------
    errors : (n,) how far off the position is after each scan [m]
    landmarks : int, in its map at the end
    false : int, observations taken for a corner that they are not of; None where none is taken
    duplicates : int, landmarks of a corner that is one already; None as before
    widths : (n,) the robot's box, its wider side [m]; None where there are no boxes
    outside : int, scans with the true pose outside of the robot's box or heading; None as before
    reported : bool, whether boxes contradicted each other, so that the filter said it is lost;
        None as before
    """

    errors: np.ndarray
    landmarks: int
    false: int | None = None
    duplicates: int | None = None
    widths: np.ndarray | None = None
    outside: int | None = None
    reported: bool | None = None


def record(slam, source, readings):
    """Run a filter over a drive.

    Parameters
    ----------
    slam : Estimator, fresh
    source : ArenaRun
    readings : its own, with corners

    Returns
    -------
    Record
    """
    places, boxes = [], []
    for reading, pose in zip(readings, source.truth.poses, strict=True):
        slam.step(reading)
        for i, k in getattr(slam, "named", {}).items():
            places.append((i, g(pose, slam.observations.z[k])))
        if hasattr(getattr(slam, "filter", None), "heading"):
            boxes.append((slam.filter.robot, slam.filter.heading, pose))
    errors = np.hypot(*(slam.trajectory().poses - source.truth.poses)[:, :2].T)
    landmarks = len(slam.filter.ids) if hasattr(slam, "filter") else 0
    corners = np.unique(source.world.walls.reshape(-1, 2).round(9), axis=0)
    told = association_errors(places, corners) if hasattr(slam, "named") else {}
    if boxes:
        told["widths"] = np.array([np.diff(robot)[::2].max() for robot, _, _ in boxes])
        told["outside"] = sum(not holds(*each) for each in boxes)
        told["reported"] = bool(slam.lost)
    return Record(errors, landmarks, **told)


def association_errors(places, corners):
    """Count false associations and duplicate landmarks, by where things were seen in truth.

    A sighting is of another corner than its landmark where it lies more than ``SAME_CORNER`` from
    where that was first seen, and nearest to another true corner; either alone may be one corner
    seen badly, or where the lines of two boxes cross. Two landmarks first seen nearer to each other
    than that are of one corner.

    Parameters
    ----------
    places : list of (id, (2,) place of the sighting, from the true pose [m]), as they came
    corners : (k, 2) true corners [m]

    Returns
    -------
    dict: false, duplicates
    """
    first, false, duplicates = {}, 0, 0

    def nearest(place):
        return np.hypot(*(corners - place).T).argmin()

    for i, place in places:
        if i in first:
            apart = np.hypot(*(place - first[i])) > SAME_CORNER
            false += apart and nearest(place) != nearest(first[i])
            continue
        duplicates += any(np.hypot(*(place - p)) < SAME_CORNER for p in first.values())
        first[i] = place
    return {"false": int(false), "duplicates": int(duplicates)}


def holds(robot, heading, pose):
    """Whether a box (4,) and an interval of headings (2,) hold a pose (3,)."""
    x, y, theta = pose
    inside = robot[0] <= x <= robot[1] and robot[2] <= y <= robot[3]
    return bool(inside and contains(heading, theta))


def scan_points(source, poses):
    """All scans of a drive, drawn where a filter believed the robot was: the thesis' figures.

    Parameters
    ----------
    source : ArenaRun
    poses : (n, 3), of each scan [m, m, rad]

    Returns
    -------
    (k, 2) [m]
    """
    scans = zip(source, poses, strict=True)
    return np.concatenate([transform(pose, reading.scan.points()) for reading, pose in scans])


def summary(errors, laps=3):
    """Summary of one run of one filter: RMS error, strayed, lost.

    Lost is who is off by more than ``LOST`` at the end; it was lost from where it last went so far
    off. Strayed is who ever was.

    Parameters
    ----------
    errors : (n,) of position [m]
    laps : int, rounds of the drive, of as many scans each

    Returns
    -------
    dict: laps_m at the end of each, rms_m, before_m the root mean square before it strayed [m],
    strayed, lost, and lost_at, the share of the way driven until it was lost, or None
    """
    far = errors > LOST
    before = errors[: int(np.argmax(far))] if far.any() else errors
    last_good = np.flatnonzero(~far)[-1]  # there is one: every run begins at the truth
    return {
        "laps_m": [float(errors[len(errors) * lap // laps - 1]) for lap in range(1, laps + 1)],
        "rms_m": float(np.sqrt(np.mean(errors**2))),
        "before_m": float(np.sqrt(np.mean(before**2))),
        "strayed": bool(far.any()),
        "lost": bool(far[-1]),
        "lost_at": float(last_good + 1) / len(errors) if far[-1] else None,
    }


def nearer(first, second):
    """Whether one filter has the smaller error until either strays.

    Parameters
    ----------
    first, second : (n,) errors on the same drive [m]

    Returns
    -------
    bool
    """
    far = np.maximum(first, second) > LOST
    way = slice(int(np.argmax(far)) if far.any() else len(far))
    return bool(np.sum(first[way] ** 2) < np.sum(second[way] ** 2))
