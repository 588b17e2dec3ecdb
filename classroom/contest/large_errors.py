"""Find the first large error of an estimate, its position on the trajectory, and its cause."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between

DISTANCE, MAX_ERROR = (
    5.0,
    0.25,
)  # distance travelled, and the largest error over it that is allowed [m, m]
CARRIED = 1.5  # a longer step means that the robot was carried [m]


@dataclass(frozen=True)
class LargeError:
    """A large error of an estimate at one reading."""

    reading: int  # counted from 1
    metres: float  # distance travelled [m]
    error: float  # position error over the last 5 m travelled [m]; NaN if there is no pose
    turn: float  # heading error over the same distance [rad]
    carried: bool = False  # whether the robot was carried within this distance

    @property
    def description(self):
        where = f"At reading {self.reading}, after {self.metres:.1f} m,"
        if np.isnan(self.error):
            return f"{where} there was no finite pose."
        error = f"the error of the motion over the last {DISTANCE:g} m was {self.error:.2f} m"
        if self.carried:
            return (
                f"{where} the robot had just been carried, and the estimate did not follow: "
                f"{error}."
            )
        cause = (
            f"mainly a heading error of {np.degrees(abs(self.turn)):.1f}°"
            if abs(self.turn) * DISTANCE / 2 > self.error / 2
            else "mainly a position error, not a heading error"
        )
        return f"{where} {error}, more than {MAX_ERROR:g} m: {cause}."


def first_large_error(online, truth, metres):
    """Return the first LargeError of the online poses, or None.

    online, truth : (n, 3) [m, m, rad]. metres : (n,) distance travelled before each reading [m]."""
    # relative to the last pose that is at least DISTANCE back, or to the first pose
    first = np.maximum(np.searchsorted(metres, metres - DISTANCE, side="right") - 1, 0)
    with np.errstate(invalid="ignore"):
        error = between(between(truth[first], truth), between(online[first], online))
        off = np.hypot(error[:, 0], error[:, 1])
        left = np.flatnonzero(~(off <= MAX_ERROR))
    if not len(left):
        return None
    j = int(left[0])
    steps = np.hypot(*np.diff(truth[first[j] : j + 1, :2], axis=0).T)
    carried = bool((steps > CARRIED).any())
    return LargeError(j + 1, float(metres[j]), float(off[j]), float(error[j, 2]), carried)
