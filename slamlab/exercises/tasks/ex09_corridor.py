"""Runs for exercise 09: a corridor, whose walls stand in one direction only, driven many times.

Nothing that is seen tells how far the robot has come: what a right filter knows along the corridor
is what the start and the wheels know. All runs share the world; noise is their own.
"""

import numpy as np

from slamlab import models
from slamlab.exercises.tasks.ex06.beliefs import either_sign
from slamlab.exercises.tasks.ex06.runs import LANDMARKS as WALLS
from slamlab.exercises.tasks.ex06.runs import STEPS, measured
from slamlab.exercises.tasks.ex06.runs import least_squares as least_squares_of
from slamlab.exercises.tasks.ex06.runs import truth as truth_of
from slamlab.filters.landmark_models import LINES
from slamlab.geometry import wrap

# left and right as far as a door, then beyond it; the last wall is never first in a scan
SCANS = np.array([[1, -1], [0, 1], [0, -1], [1, 2], [2, 0], [-1, -1], [2, 3], [2, 3]])
WHEELS, EYES = np.array([0.025, 0.01]), np.array([0.015, 0.008])  # σ of d, Δθ and of ρ', α'
START = np.array([0.02, 0.025, 0.01])  # σ of the start [m, m, rad]


def runs(rng):
    """One corridor and one way through it; the truth is in no array, but the middle of all runs."""
    start = np.array([*either_sign(rng, 0.5, 3, 2), either_sign(rng, 0.3, 2.5)])
    weave = 0.12 * np.array([1, -1, -1, 1, 1, -1, -1, 1]) * rng.choice([-1, 1])
    drives = np.column_stack([rng.uniform(0.5, 0.8, STEPS), weave * rng.uniform(0.5, 1, STEPS)])
    side = start[2] + np.array([1, -1, 1, -1]) * np.pi / 2
    walls = models.g_line(
        np.array([*start[:2], 0.0]), np.column_stack([rng.uniform(0.9, 1.6, WALLS), wrap(side)])
    )
    return measured(rng, start, drives, walls, SCANS, (START, WHEELS, EYES), LINES)


def truth(inputs):
    """Start, drives, way and walls that all runs have in common."""
    return truth_of(inputs, LINES)


def least_squares(inputs):
    """(n, n) covariance at the end, of all that was measured, linearised at the truth."""
    return least_squares_of(inputs, LINES)
