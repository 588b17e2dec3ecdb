"""Runs of a kidnapped robot in a hall of bays that look alike, also after half a turn.

Two runs are exchanged at the kidnapping; each has a twin with opposite odometry errors.
"""

import numpy as np

from slamlab.geometry import between, compose, wrap

BAYS, BAY = 3, 4.0  # number of bays, and width and depth of each [m]
ALIKE, APART, EDGE = 5, 0.7, 0.2  # posts common to all bays; least distances [m]
REACH, SEEN, PHANTOMS = 2.0, 0.8, 0.7  # range [m], share detected, false measurements per scan
EYES, WHEELS = np.array([0.03, 0.02]), np.array([0.02, 0.01, 0.02])  # σ of z, of a motion
MOST = 14  # measurements per scan, at most
STEPS, STEP = 30, 0.35  # readings of a run, distance between two [m]
LIFTED, SPAN = 4, 3  # hall k: one of SPAN readings from LIFTED + SPAN k is the first one after it
TRIED = 16  # pairs of paths; the pair with the least informative kidnapping is used


def drives(rng, lifted=6, calm=0):
    """Four runs in each hall.
    lifted, calm : halls with and without a kidnapping. start (d, 3), motions (d, STEPS, 3),
    measurements (d, STEPS, MOST, 2), counts (d, STEPS), posts (d, n, 2).
    """
    first = [LIFTED + SPAN * k for k in range(lifted)] + [None] * calm
    halls = [_hall(rng, each) for each in first]
    return {name: np.concatenate([hall[name] for hall in halls]) for name in halls[0]}


def _hall(rng, first):
    posts, own = _posts(rng)
    tried = [np.array([_way(rng), _way(rng)]) for _ in range(TRIED if first else 1)]
    ways = max(tried, key=lambda ways: _hidden(ways, own, first or 1).max())
    motions = between(ways[:, :-1], ways[:, 1:])
    errors = WHEELS * rng.standard_normal(motions.shape)
    truth = ways[:, 1:].copy()
    if first:
        at = first - 1 + np.argmax(_hidden(ways, own, first))
        errors[:, at] = 0
        truth[:, at:] = truth[::-1, at:]
        motions[:, at + 1 :] = motions[::-1, at + 1 :]
    told = np.stack([motions + errors, motions - errors], axis=1).reshape(4, STEPS, 3)
    scans = [[_scan(rng, pose, posts) for pose in truth[k // 2]] for k in range(4)]
    return {
        "start": np.repeat(ways[:, 0], 2, axis=0),
        "motions": told,
        "measurements": np.array([[scan for scan, _ in drive] for drive in scans]),
        "counts": np.array([[count for _, count in drive] for drive in scans]),
        "posts": np.tile(posts, (4, 1, 1)),
    }


def _hidden(ways, own, first):
    # distance to the nearest unique post in two successive scans, which must not show the bay
    far = np.linalg.norm(ways[:, 1:, None, :2] - own, axis=3).min(axis=(0, 2))
    return np.minimum(far[:-1], far[1:])[first - 1 : first - 1 + SPAN]


def truth(i):
    """The true poses (d, STEPS, 3), and (d, STEPS) bool, whether after a kidnapping."""
    pairs = i["motions"].reshape(-1, 2, 2, *i["motions"].shape[1:])
    same = (pairs[:, :, 0] == pairs[:, :, 1]).all(axis=(1, 3))  # twins agree at the kidnapping
    since = np.where(same.any(axis=1), same.argmax(axis=1), same.shape[1])[:, None]
    steps = np.arange(same.shape[1])
    told = pairs.mean(axis=2)
    told = np.where((steps > since)[:, None, :, None], told[:, ::-1], told)
    pose, ways = i["start"].reshape(-1, 2, 2, 3)[:, :, 0], []
    for k in steps:
        pose = compose(pose, told[:, :, k])
        ways.append(pose)
    ways, after = np.stack(ways, axis=2), steps >= since
    ways = np.where(after[:, None, :, None], ways[:, ::-1], ways)
    return np.repeat(ways.reshape(-1, *ways.shape[2:]), 2, axis=0), np.repeat(after, 4, axis=0)


def _posts(rng):
    """All posts, and the unique post of each bay; the others are alike, also after half a turn."""
    pairs = [np.full(2, BAY / 2)]  # in the middle; then pairs, opposite each other
    for place in rng.uniform(EDGE, BAY - EDGE, (2000, 2)):
        if len(pairs) < ALIKE + 2 * BAYS and _apart(place, [*pairs, BAY - place]):
            pairs += [place, BAY - place]
    own = pairs[ALIKE::2]  # no two are at the same position, also after half a turn
    bays = [np.array([*pairs[:ALIKE], own[k]]) + np.array([k * BAY, 0]) for k in range(BAYS)]
    return rng.permutation(np.concatenate(bays)), np.array([bay[-1] for bay in bays])


def _apart(place, others):
    return all(np.hypot(*(place - other)) > APART for other in others)


def _way(rng):
    a, b = BAYS * BAY / 2, BAY / 2
    share, shares = rng.uniform(0, 2 * np.pi), []
    step = rng.choice([-STEP, STEP]) * rng.uniform(0.8, 1.2, STEPS + 2)
    for way in step:
        shares.append(share)
        share += way / np.hypot((a - 0.9) * np.sin(share), 1.2 * np.cos(share))
    t = np.array(shares)
    x = a + (a - 0.9 + 0.2 * np.sin(3 * t)) * np.cos(t)
    y = b + (1.2 + 0.2 * np.cos(2 * t)) * np.sin(t)
    ahead = np.arctan2(np.diff(y), np.diff(x)) + rng.normal(0, 0.05, STEPS + 1)
    return np.column_stack([x[:-1], y[:-1], wrap(ahead)])


def _scan(rng, pose, posts):
    off = posts - pose[:2]
    r, beta = np.hypot(*off.T), np.arctan2(off[:, 1], off[:, 0]) - pose[2]
    near = (r < REACH) & (rng.random(len(r)) < SEEN)
    real = np.column_stack([r, beta])[near] + EYES * rng.standard_normal((near.sum(), 2))
    n = rng.poisson(PHANTOMS)
    phantoms = np.column_stack([REACH * np.sqrt(rng.random(n)), rng.uniform(-np.pi, np.pi, n)])
    z = rng.permutation(np.concatenate([real, phantoms]))[:MOST]
    z[:, 1] = wrap(z[:, 1])
    return np.concatenate([z, np.zeros((MOST - len(z), 2))]), len(z)
