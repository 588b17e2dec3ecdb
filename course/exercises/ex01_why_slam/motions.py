"""Poses and steps for exercise 01, and the laws of a task that answers with a pose."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import ROUNDING, equals
from slamlab.geometry import compose, wrap

QUARTERS = np.array([0.0, np.pi / 2, np.pi, -np.pi / 2])
"""Headings along the axes [rad]."""


def poses(rng, count):
    return np.column_stack([rng.uniform(-10, 10, (count, 2)), rng.uniform(-np.pi, np.pi, count)])


def steps(rng, *shape):
    """Steps (*shape, 3), none of their components small."""
    size = rng.uniform([0.3, 0.3, 0.3], [2.0, 2.0, 1.5], (*shape, 3))
    return size * rng.choice([-1.0, 1.0], (*shape, 3))


def turned_beyond(rng, count, least, most):
    """Pairs of angles (count,) of one sign whose sum leaves (-π, π]."""
    side = np.where(np.arange(count) % 2, 1.0, -1.0)
    return side * rng.uniform(2.5, 3.1, count), side * rng.uniform(least, most, count)


def chain(start, moves):
    """The poses (n + 1, 3) from a start by steps (n, 3)."""
    track = [start]
    for step in moves:
        track.append(compose(track[-1], step))
    return np.array(track)


def laws_of_a_pose(want, places, heading, asks, step, turned):
    """Three laws of a returned pose: position, heading, wrapped heading; ``asks`` are their
    questions, ``turned`` the step of the third."""
    at = {"result": np.s_[:2]}, {"result": np.s_[2]}
    place = equals("place", 3, places, want, parts=at[0], asks=asks[0], step=step)
    turn = equals(
        "heading", 1, heading, want, parts=at[1], angles={"result": 2}, asks=asks[1], step=step
    )

    def within(inputs, outputs):
        # both −π and π are half a turn; rounding may carry a heading just beyond
        small = np.abs(outputs["result"][:, 2]) <= np.pi + ROUNDING
        return turn.holds(inputs, outputs) & small

    says = "this angle lies between −π and π"
    wrapped = replace(turn, name="wrapped", says=says, holds=within, asks=asks[2], step=turned)
    return place, turn, replace(wrapped, after=(turn.name,))


def parts_of_a_pose(inputs, outputs):
    found = outputs["result"]
    half = np.abs(np.abs(found[:, 2]) - np.pi) < ROUNDING
    return {
        "x": found[:, 0],
        "y": found[:, 1],
        "heading": np.where(half, np.pi, wrap(found[:, 2])),
        "beyond π": np.where(half, 0.0, found[:, 2] - wrap(found[:, 2])),
    }
