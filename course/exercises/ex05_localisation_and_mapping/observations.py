"""Beliefs, measurements and runs for exercise 05, and the reference filter."""

import numpy as np

from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians


def T(M):
    return np.swapaxes(M, -1, -2)


def either_sign(rng, low, high, size=None):
    """Numbers of magnitude between low and high."""
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


def covariances(rng, sigmas):
    """Covariances (n, k, k) with standard deviations (n, k) and correlations of all sizes."""
    n, k = np.shape(sigmas)
    roots = rng.standard_normal((n, k, k + 2))
    P = roots @ T(roots)
    unit = sigmas / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * unit[:, :, None] * unit[:, None, :]


def beliefs(rng, rows):
    """Poses (rows, 3) and their covariances."""
    x = np.column_stack([either_sign(rng, 0.5, 5, (rows, 2)), either_sign(rng, 0.3, 2.8, rows)])
    sigmas = np.column_stack([rng.uniform(0.08, 0.2, (rows, 2)), rng.uniform(0.04, 0.1, rows)])
    return x, covariances(rng, sigmas)


def each(function, *stacks):
    """The function of each row, stacked."""
    return np.array([function(*row) for row in zip(*stacks, strict=True)])


def driven(x, us):
    """The poses (n, 3) after each of the drives (n, 2)."""
    poses = []
    for u in us:
        x = models.f_odometry(x, u)
        poses.append(x)
    return np.array(poses)


def filtered(x, P, us, ids, zs, landmarks, C, R):
    """The filter's beliefs after every step of one run: xs (n, 3), Ps (n, 3, 3)."""
    xs, Ps = [], []
    for u, id, z in zip(us, ids.astype(int), zs, strict=True):
        A, W = jacobians.A_odometry(x, u), jacobians.W_odometry(x, u)
        x, P = models.f_odometry(x, u), A @ P @ A.T + W @ C @ W.T
        if id >= 0:
            H = jacobians.H_robot(x, landmarks[id])
            v = z - models.h(x, landmarks[id])
            v[1] = wrap(v[1])
            S = H @ P @ H.T + R
            K = np.linalg.solve(S, H @ P).T
            x, P = x + K @ v, P - K @ S @ K.T
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)


# The truth is in no array: the errors of start and odometry have mean 0 over a kind of robots
ROBOTS, STEPS, LANDMARKS = 30, 40, 6
LIES, AT_FIRST = 0.3, 4  # fraction of outliers; so many measurements begin, half of them outliers
PLACE, WHEELS, EYES = 0.2, np.array([0.03, 0.02]), np.array([0.08, 0.03])  # standard deviations


def robots(rng, count=ROBOTS, steps=STEPS, landmarks=LANDMARKS, lies=LIES, better=(1, 1)):
    """Robots on one trajectory with any initial heading, each with its own errors and outliers;
    ``better`` divides the standard deviations of odometry and sensor."""
    wheels, eyes = WHEELS / better[0], EYES / better[1]
    turns = either_sign(rng, 1, 1) * rng.uniform(0.1, 0.3, steps)
    us = np.column_stack([rng.uniform(0.3, 0.6, steps), turns])
    start = np.array([*rng.uniform(-3, 3, 2), rng.uniform(-2.5, 2.5)])
    way = driven(start, us)
    around = rng.uniform(-np.pi, np.pi) + np.arange(landmarks) * 2 * np.pi / landmarks
    around += rng.uniform(-0.25, 0.25, landmarks)
    far = rng.uniform(3, 5, (landmarks, 1)) * np.column_stack([np.cos(around), np.sin(around)])
    places, seen = way[:, :2].mean(axis=0) + far, rng.random(steps) < 0.8
    ids = np.where(seen, rng.integers(landmarks, size=steps), -1)
    zs = models.h(way, places[ids]) + eyes * rng.standard_normal((count, steps, 2))
    lie = rng.random((count, steps)) < lies
    for step in np.flatnonzero(seen)[:AT_FIRST]:
        lie[:, step] = rng.permutation(np.arange(count) % 2 == 0) & (lies > 0)
    lie |= ~seen  # means nothing
    zs[lie] = np.stack([rng.uniform(1, 6, lie.sum()), rng.uniform(-4, 4, lie.sum())], axis=-1)
    zs[..., 1] = wrap(zs[..., 1])
    # not wrapped, so that their mean is the true one: who is off by a half-turn is off either way
    headings = start[2] + rng.permutation(((np.arange(count) + 0.5) / count * 2 - 1) * np.pi)
    x = np.column_stack([start[:2] + PLACE * _errors(rng, count, 2), headings])
    told = us + wheels * _errors(rng, count, 2 * steps).reshape(count, steps, 2)
    P = np.diag([PLACE**2, PLACE**2, np.pi**2 / 3])
    inputs = {
        "x": x, "P": P, "us": told, "ids": ids, "zs": zs, "landmarks": places,
        "C": np.diag(wheels**2), "R": np.diag(eyes**2),
    }  # fmt: skip
    own = "x", "us", "zs"
    return {n: a if n in own else np.repeat(a[None], count, axis=0) for n, a in inputs.items()}


def _errors(rng, count, size):
    # their mean over the robots of a kind is 0
    errors = rng.standard_normal((count, size))
    return (errors - errors.mean(axis=0)) * np.sqrt(count / (count - 1))


def with_wrapped_heading(name):
    """Parts of outputs: poses of this name with headings in (−π, π]."""

    def parts(inputs, outputs):
        x = outputs[name].copy()
        x[..., 2] = wrap(x[..., 2])
        return {**outputs, name: x}

    return parts
