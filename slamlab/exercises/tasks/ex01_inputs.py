"""Inputs of exercise 01: poses anywhere, steps in any direction, tours that close, one wall."""

import numpy as np

POSES = 30
TRACKS, STEPS = 12, 8
SCANS, ON_WALL, ELSEWHERE = 20, 4, 5


def poses(rng, n=POSES):
    """(n, 3) poses within 10 m, headed anywhere."""
    return np.column_stack([rng.uniform(-10, 10, (n, 2)), rng.uniform(-np.pi, np.pi, n)])


def steps(rng, *shape):
    """(*shape, 3) steps: forward or back, to the left or right, and a turn; none of them small."""
    size = rng.uniform([0.3, 0.3, 0.3], [2.0, 2.0, 1.5], (*shape, 3))
    return size * rng.choice([-1.0, 1.0], (*shape, 3))


def pose_and_step(rng):
    """Poses and steps; two thirds of the turns cross ±π."""
    pose, step = poses(rng), steps(rng, POSES)
    third = POSES // 3
    pose[:third, 2] = rng.uniform(2.5, 3.1, third)
    step[:third, 2] = rng.uniform(0.8, 1.5, third)
    pose[third : 2 * third, 2] = rng.uniform(-3.1, -2.5, third)
    step[third : 2 * third, 2] = rng.uniform(-1.5, -0.8, third)
    return {"pose": pose, "step": step}


def start_and_steps(rng):
    """Starts and tracks; the first half of the tracks are tours round a closed polygon."""
    track = steps(rng, TRACKS, STEPS)
    corners = rng.uniform(-5, 5, (TRACKS // 2, STEPS)) + 1j * rng.uniform(
        -5, 5, (TRACKS // 2, STEPS)
    )
    sides = np.roll(corners, -1, axis=1) - corners
    turns = np.angle(np.roll(sides, -1, axis=1) / sides)
    track[: TRACKS // 2] = np.stack([np.abs(sides), np.zeros(sides.shape), turns], axis=-1)
    return {"start": poses(rng, TRACKS), "steps": track}


def pose_and_points(rng):
    """Poses, and what they see: first some points of one wall, the same for all, then others."""
    pose = poses(rng, SCANS)
    along, corner = np.exp(1j * rng.uniform(0, np.pi)), complex(*rng.uniform(3, 9, 2))
    wall = corner + along * rng.uniform(-4, 4, (SCANS, ON_WALL))
    seen = (wall - (pose[:, :1] + 1j * pose[:, 1:2])) * np.exp(-1j * pose[:, 2:])
    points = rng.uniform(0.3, 6, (SCANS, ON_WALL + ELSEWHERE, 2))
    points *= rng.choice([-1.0, 1.0], points.shape)
    points[:, :ON_WALL] = np.stack([seen.real, seen.imag], axis=-1)
    return {"pose": pose, "points": points}


def two_poses(rng):
    """Pairs of poses; in two thirds of them the plain difference of headings leaves (-π, π]."""
    a, b = poses(rng), poses(rng)
    third = POSES // 3
    a[:third, 2], b[:third, 2] = rng.uniform(1.8, 3.1, third), rng.uniform(-3.1, -1.8, third)
    between = slice(third, 2 * third)
    a[between, 2], b[between, 2] = -rng.uniform(1.8, 3.1, third), rng.uniform(1.8, 3.1, third)
    return {"a": a, "b": b}


def straight_drives(rng):
    """Straight drives in threes: any; with twice the error; with four times as many steps."""
    n = rng.permutation(np.arange(6, 13)).astype(float)
    d, sigma = rng.uniform(0.2, 0.9, n.size), rng.uniform(0.002, 0.006, n.size)
    return {
        "n": np.stack([n, n, 4 * n], axis=1).ravel(),
        "d": np.repeat(d, 3),
        "sigma": np.stack([sigma, 2 * sigma, sigma], axis=1).ravel(),
    }
