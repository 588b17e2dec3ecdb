"""Robots among known objects, and the feasible poses, all of which a sound box holds."""

import functools

import numpy as np

from course.exercises.ex10_set_membership_slam.boxes import boxes_around, off, wrapped

ROWS, OBJECTS = 10, 4
AGREE = 1 - 1e-9  # share of the bounds that a pose may use: agreement does not hang on rounding
DIRECTIONS = np.concatenate([np.eye(3), -np.eye(3)])
SEEK, CLIMB, TRIES = 400, 30, 40  # rounds at most, and tries in each


def inputs(rng, n=ROWS, objects=OBJECTS, far=(1.5, 4), half=(0.6, 1.2)):
    """Robots in their boxes; every other one has errors near their bounds."""
    pose = np.column_stack([rng.uniform(-3, 3, (n, 2)), rng.uniform(-np.pi, np.pi, n)])
    return observations(rng, pose, objects, far, half)


def observations(rng, pose, objects=OBJECTS, far=(1.5, 4), half=(0.6, 1.2)):
    """What robots at poses (n, 3) know and measure."""
    n = len(pose)
    round_about = np.arange(objects) * 2 * np.pi / max(objects, 1) + rng.uniform(
        -np.pi, np.pi, (n, 1)
    )
    angle, r = round_about + rng.uniform(-0.6, 0.6, (n, objects)), rng.uniform(*far, (n, objects))
    bounds = np.column_stack([rng.uniform(0.1, 0.25, n), rng.uniform(0.02, 0.05, n)])
    errors = rng.uniform(-1, 1, (n, objects, 2))
    errors[::2] = np.sign(errors[::2]) * rng.uniform(0.7, 1, errors[::2].shape)
    z = np.stack([r, angle - pose[:, 2:]], axis=-1) + errors * bounds[:, None]
    z[..., 1] = off(z[..., 1])
    size, wide = rng.uniform(0.4, 0.8, (n, 2)), rng.uniform(*half, n)
    middle = pose[:, :2] + rng.uniform(-0.8, 0.8, (n, 2)) * size
    before = wide * (1 + rng.uniform(-0.8, 0.8, n))
    return {
        "robot": boxes_around(middle, size),
        "heading": wrapped(pose[:, 2] - before, 2 * wide),
        "objects": pose[:, None, :2]
        + r[..., None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1),
        "z": z,
        "bounds": bounds,
    }


def _known(given):
    """(n, 3) middles and half-widths of what is known before."""
    sides = np.hstack([given["robot"], given["heading"]]).reshape(-1, 3, 2)
    return sides.mean(axis=2), np.ptp(sides, axis=2) / 2


def share(given, poses):
    """(n, k) largest share of any bound that poses (n, k, 3) need: feasible up to 1."""
    middle, half = _known(given)
    needed = (np.abs(poses - middle[:, None]) / half[:, None]).max(axis=-1)
    (d_r, d_beta), (px, py, theta) = given["bounds"].T[..., None], np.moveaxis(poses, -1, 0)
    for k in range(given["objects"].shape[1]):
        x, y = given["objects"][:, k, :1] - px, given["objects"][:, k, 1:] - py
        r = np.hypot(x, y) - given["z"][:, k, :1]
        bearing = off(np.arctan2(y, x) - theta - given["z"][:, k, 1:])
        for each in (np.abs(r) / d_r, np.abs(bearing) / d_beta):
            np.maximum(needed, each, out=needed)
    return needed


def extremes(given):
    """(n, 6, 3) farthest feasible poses found along x, y, θ, −x, −y, −θ; NaN if none is.
    All robots have the same tries: no row depends on others.
    """
    return _extremes(
        tuple((name, a.shape, np.asarray(a, float).tobytes()) for name, a in given.items())
    )


@functools.lru_cache(maxsize=16)
def _extremes(key):
    given = {name: np.frombuffer(data).reshape(shape) for name, shape, data in key}
    middle, half = _known(given)
    start = _agreeing(given, middle[:, None], half[:, None])
    mirrored = _agreeing(given, _mirrored(given, start), 0.02 * half[:, None], SEEK // 10)
    scale = np.repeat(half[:, None] / 2, 6, axis=1)
    found, others = (_farthest(given, np.repeat(a, 6, axis=1), scale) for a in (start, mirrored))
    far, farther = ((a * DIRECTIONS).sum(axis=-1) for a in (found, others))
    better = (share(given, others) <= 1) & (farther > far)
    found[better] = others[better]
    found[(share(given, found) > 1).any(axis=1)] = np.nan
    return found


def _mirrored(given, poses):
    """Poses (n, 1, 3) mirrored in the line through the first two objects: all ranges to objects on
    this line stay the same, and the heading is that of the least error of bearings. A single object
    mirrors in itself, and turns the heading by π."""
    first, along = given["objects"][:, :1], np.diff(given["objects"][:, :2], axis=1)
    if not along.size:
        back = poses[..., 2:] + np.pi * np.sign(_known(given)[0][:, None, 2:] - poses[..., 2:])
        return np.dstack([2 * first - poses[..., :2], back]) if first.size else poses
    off_line = poses[..., :2] - first
    across = along[..., ::-1] * [-1, 1] / np.hypot(along[..., :1], along[..., 1:])
    aside = (off_line * across).sum(axis=-1, keepdims=True)
    place = poses[..., :2] - 2 * aside * across
    x, y = np.moveaxis(given["objects"] - place, -1, 0)
    turn = off(np.arctan2(y, x) - poses[..., 2] - given["z"][..., 1])
    heading = poses[:, 0, 2] + (turn.min(axis=1) + turn.max(axis=1)) / 2
    return np.concatenate([place, heading[:, None, None]], axis=-1)


def islands(rng, n=16):
    """Robots near the line between two objects: a second, small set of feasible poses lies on the
    other side of this line. From there, bearings are wrong by 0.98 of their bound."""
    toward, heading = rng.uniform(-np.pi, np.pi, (2, n))
    r, bounds = rng.uniform(1.8, 2.2, (n, 2)), np.tile([0.001, 0.15], (n, 1))
    aside = 0.98 * bounds[:, 1] / (1 / r).sum(axis=1) * rng.choice([-1, 1], n)
    pose = np.column_stack([rng.uniform(-3, 3, (n, 2)), heading])
    c, s = np.cos(toward)[:, None], np.sin(toward)[:, None]
    u, v = r * [1, -1], np.repeat(aside[:, None], 2, axis=1)
    objects = pose[:, None, :2] + np.stack([u * c - v * s, u * s + v * c], axis=-1)
    x, y = np.moveaxis(objects - pose[:, None, :2], -1, 0)
    z = np.stack([np.hypot(x, y), off(np.arctan2(y, x) - heading[:, None])], axis=-1)
    return {
        "robot": boxes_around(pose[:, :2], rng.uniform(0.5, 0.8, (n, 2))),
        "heading": wrapped(heading - 0.8, np.full(n, 1.6)),
        "objects": objects,
        "z": z,
        "bounds": bounds,
    }


def both_sides(rng, n=4):
    """Robots in long boxes around a single object, with feasible poses on both sides of it."""
    given = inputs(rng, n, 1)
    r, heading = given["z"][:, 0, 0], rng.uniform(-np.pi, np.pi, n)
    half = np.column_stack([1.2 * r, rng.uniform(0.1, 0.2, n)])
    wide = np.pi + rng.uniform(0.4, 0.8, n)
    given["z"][:, 0, 1] = off(-heading - rng.uniform(0.2, 0.3, n))
    return given | {
        "robot": boxes_around(given["objects"][:, 0], half),
        "heading": wrapped(heading, wide),
    }


def _agreeing(given, best, scale, rounds=SEEK):
    """(n, 1, 3) feasible poses, by tries round the best so far."""
    rng = np.random.default_rng(0)
    for k in range(rounds):
        agrees = (share(given, best) <= AGREE)[:, 0]
        if agrees.all():
            break
        spread = scale * 0.75 ** (k % 20) * rng.standard_normal((TRIES, 3))
        tries = np.concatenate([best, best + spread], axis=1)
        first = np.where(agrees, 0, share(given, tries).argmin(axis=1))
        best = np.take_along_axis(tries, first[:, None, None], axis=1)
    return best


def _farthest(given, best, scale):
    """(n, 6, 3) feasible poses, each the farthest of tries round the one before."""
    rng = np.random.default_rng(1)
    for _ in range(CLIMB):
        spread = scale[:, :, None] * rng.standard_normal((len(DIRECTIONS), TRIES, 3))
        tries = np.concatenate([best[:, :, None], best[:, :, None] + spread], axis=2)
        agrees = share(given, tries.reshape(len(best), -1, 3)).reshape(tries.shape[:-1]) <= AGREE
        out = np.where(agrees, (tries * DIRECTIONS[:, None]).sum(axis=-1), -np.inf)
        first = out.argmax(axis=2)
        best = np.take_along_axis(tries, first[..., None, None], axis=2)[:, :, 0]
        scale = scale * np.where(first > 0, 1.1, 0.6)[..., None]
    return best


def tightest(given):
    """(n, 3) widths of the smallest box and heading found: the true ones are a bit wider."""
    found = extremes(given)
    return np.stack([found[:, k, k] - found[:, k + 3, k] for k in range(3)], axis=-1)


def outside_each(given, out):
    """(n, 6) how far feasible poses lie outside; below 0 inside."""
    x, y, angle = np.moveaxis(extremes(given), -1, 0)
    (x0, x1, y0, y1), (right, left) = out["robot"].T[..., None], out["heading"].T[..., None]
    by = [
        x0 - x,
        x - x1,
        y0 - y,
        y - y1,
        np.abs(off(angle - (right + left) / 2)) - (left - right) / 2,
    ]
    return np.nan_to_num(np.max(by, axis=0), nan=-1.0)
