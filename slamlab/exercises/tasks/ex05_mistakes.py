"""Classic mistakes in an EKF's update, the same for a pose and for a landmark."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex05_batch import (
    deviations,
    gain,
    innovation,
    same_covariance,
    same_mean,
    sandwich,
    times,
    turned,
)


def mean_of(state, name, hint, *wrong, rows=np.s_[:]):
    """A diagnosis: the mean equals one of the wrong formulas, in some of the rows."""

    def matches(inputs, outputs):
        sigma = deviations(inputs["P"])
        return any(
            same_mean(outputs[state], w(inputs), sigma, heading=state == "x")[rows].all()
            for w in wrong
        )

    return Diagnosis(name, hint, matches)


def covariance_of(name, hint, *wrong):
    """A diagnosis: the covariance equals one of the wrong formulas."""
    return Diagnosis(
        name, hint, lambda i, o: any(same_covariance(o["P"], w(i)).all() for w in wrong)
    )


def diagnoses(state, H_of, behind):
    """The classic mistakes of an update.

    Parameters
    ----------
    state : "x" or "p", whose belief is updated
    H_of : inputs -> (n, 2, k)
    behind : slice of the rows whose landmark is behind the robot

    Returns
    -------
    tuple of Diagnosis
    """

    def parts(i, R=None):
        H = H_of(i)
        K, S = gain(i["P"], H, i["R"] if R is None else R)
        return K, S, H

    def v(i, wrapped=True):
        return innovation(i["x"], i["p"], i["z"], wrapped)

    def stepped(i, K, sign=1, wrapped=True):
        return i[state] + sign * times(K, v(i, wrapped))

    def other_R(R_of):
        return lambda i: stepped(i, parts(i, R_of(i))[0])

    def minus(M):
        return lambda i: i["P"] - M(i)

    def round_the_circle(i):
        off = v(i, wrapped=False)
        off[:, 1] %= 2 * np.pi
        return i[state] + times(parts(i)[0], off)

    return (
        mean_of(
            state,
            "from-zero",
            "% (2π) brings the innovation's bearing into [0, 2π): what is a little to the right "
            "becomes almost a full turn. It belongs in (−π, π]: wrap.",
            round_the_circle,
        ),
        mean_of(
            state,
            "unwrapped",
            "The innovation's bearing leaves (−π, π]: a landmark right behind, expected at 179° "
            "and seen at −179°, is 2° off, not 358°. Wrap the difference, in radians.",
            lambda i: stepped(i, parts(i)[0], wrapped=False),
            rows=behind,
        ),
        mean_of(
            state,
            "sign",
            "The correction goes the wrong way. The innovation is measured minus predicted, "
            "z − h(x, p), and H is the derivative by what is being updated: H_robot for a pose, "
            "H_landmark for a landmark.",
            lambda i: stepped(i, parts(i)[0], sign=-1),
        ),
        mean_of(
            state,
            "degrees",
            "The innovation's bearing is in degrees, while R and H count in radians.",
            lambda i: i[state] + times(parts(i)[0], v(i) * [1, 180 / np.pi]),
        ),
        mean_of(
            state,
            "no-S",
            "The gain lacks S⁻¹: P Hᵀ v has not even the right unit. The innovation counts by how "
            "surprising it is, and S says so.",
            lambda i: stepped(i, i["P"] @ turned(H_of(i))),
        ),
        mean_of(
            state,
            "R-forgotten",
            "S lacks R: the measurement is believed as if it had no noise.",
            other_R(lambda i: 0 * i["R"]),
        ),
        mean_of(
            state,
            "standard-deviation",
            "R holds variances already: look where you take a root or a square of it.",
            other_R(lambda i: np.sqrt(i["R"])),
            other_R(lambda i: i["R"] @ i["R"]),
        ),
        mean_of(
            state,
            "correction-only",
            "K v is the correction, not the new estimate: add it to what was believed. (Smolec's "
            "(15) prints it so.)",
            lambda i: times(parts(i)[0], v(i)),
        ),
        covariance_of(
            "P-not-updated",
            "P came back as it went in. A sighting takes doubt away: by K S Kᵀ.",
            lambda i: i["P"],
        ),
        covariance_of(
            "P-added",
            "K S Kᵀ is added to P. A sighting can only take doubt away.",
            lambda i: i["P"] + sandwich(*parts(i)[:2]),
        ),
        covariance_of(
            "S-inverted",
            "Between K and Kᵀ belongs S, not its inverse: K has S⁻¹ in it already.",
            minus(lambda i: sandwich(parts(i)[0], np.linalg.inv(parts(i)[1]))),
        ),
        covariance_of(
            "P-missing",
            "P − K H lacks a P. It is (I − K H) P, which is P − K S Kᵀ.",
            minus(lambda i: parts(i)[0] @ parts(i)[2]),
            lambda i: np.eye(i["P"].shape[1]) - parts(i)[0] @ parts(i)[2],
        ),
        covariance_of(
            "half-of-joseph",
            "(I − K H) P (I − K H)ᵀ is the first half of Joseph's form. Without + K R Kᵀ the "
            "measurement's noise is left out.",
            lambda i: sandwich(np.eye(i["P"].shape[1]) - parts(i)[0] @ parts(i)[2], i["P"]),
        ),
    )
