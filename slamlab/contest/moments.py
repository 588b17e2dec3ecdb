"""The first moment at which an estimate leaves its band: what went wrong, where, and how."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between

WAY, BAND = 5.0, 0.25  # over so much of way the error may be so large [m, m]
CARRIED = 1.5  # a step that no robot drives [m]


@dataclass(frozen=True)
class Moment:
    """A moment of a drive.

    Parameters
    ----------
    reading : int, counted from 1
    metres : float, of way until then [m]
    error : float, over the last 5 m of way [m]; NaN where there is no pose
    turn : float, error of the heading over them [rad]
    carried : bool, whether the robot had been carried on the way
    """

    reading: int
    metres: float
    error: float
    turn: float
    carried: bool = False

    @property
    def says(self):
        """The moment in a sentence."""
        place = f"At reading {self.reading}, after {self.metres:.1f} m of way,"
        if np.isnan(self.error):
            return f"{place} there was no finite pose any more."
        if self.carried:
            return (
                f"{place} the robot had just been carried to another place, and the estimate had "
                f"not noticed: the motion over the last {WAY:g} m was off by {self.error:.2f} m."
            )
        how = (
            f"mostly by its heading, which was off by {np.degrees(abs(self.turn)):.1f}°"
            if abs(self.turn) * WAY / 2 > self.error / 2
            else "more by its place than by its heading"
        )
        return (
            f"{place} the motion over the last {WAY:g} m was off by {self.error:.2f} m, more than "
            f"the {BAND:g} m of the band: {how}."
        )


def first_moment(online, truth, metres):
    """The first moment at which the poses given online left the band.

    Parameters
    ----------
    online, truth : (n, 3) [m, m, rad]
    metres : (n,) way driven before each reading [m]

    Returns
    -------
    Moment, or None where they never did
    """
    # from the last pose that is a whole way back, or from the first
    first = np.maximum(np.searchsorted(metres, metres - WAY, side="right") - 1, 0)
    with np.errstate(invalid="ignore"):
        error = between(between(truth[first], truth), between(online[first], online))
        off = np.hypot(error[:, 0], error[:, 1])
        left = np.flatnonzero(~(off <= BAND))
    if not len(left):
        return None
    j = int(left[0])
    steps = np.hypot(*np.diff(truth[first[j] : j + 1, :2], axis=0).T)
    carried = bool((steps > CARRIED).any())
    return Moment(j + 1, float(metres[j]), float(off[j]), float(error[j, 2]), carried)
