"""Task 08-segments: whose readings they are, in rooms with clutter, scored by the share that is
right."""

import functools

import numpy as np
from scipy.optimize import linear_sum_assignment

from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex08.rooms import counts, scans, walls

STEPS = {"some": (0.7, 0.5), "most": (0.84, 1), "nearly": (0.88, 1.5), "well": (0.92, 1.5)}
"""Law's name to the share asked for, and its points. Labels by blocks of beams reach 0.45,
windows of
25 readings nothing, RANSAC with a fixed band 0.77, with one that grows with the range 0.91."""


def tables(inputs, outputs):
    """The counts of each scan."""
    points, labels = inputs["points"], outputs["labels"].astype(int)
    return _tables(points.tobytes(), labels.tobytes(), points.shape)


@functools.lru_cache(maxsize=4)  # every law asks for them
def _tables(points, labels, shape):
    points, labels = np.frombuffer(points), np.frombuffer(labels, dtype=int)
    pairs = zip(labels.reshape(shape[:2]), walls(points.reshape(shape)), strict=True)
    return [counts(got, want) for got, want in pairs]


def share(table):
    """Share of the readings that are right: each wall found stands for one true wall at most."""
    rows, columns = linear_sum_assignment(-table[:-1, :-1])
    right = table[:-1, :-1][rows, columns].sum()
    return 2 * right / (table[:-1].sum() + table[:, :-1].sum())


def mean_share(inputs, outputs):
    """The mean over all scans."""
    return np.mean([share(table) for table in tables(inputs, outputs)])


def _step(name, wanted, points):
    return Law(
        name,
        points,
        f"a share of {wanted} of the readings is right, on average over the scans",
        lambda inputs, outputs: bool(mean_share(inputs, outputs) >= wanted),
        why=lambda inputs, outputs: (
            f"the share is {mean_share(inputs, outputs):.3f}; {wanted} is asked for"
        ),
        asks="Draw a scan with a colour for each label. Which readings are wrong: those near "
        "corners, "
        "those far away, those of clutter, or those of whole walls?",
    )


# ---- what goes wrong ---------------------------------------------------------------------------


def _of_all(measure):
    """The mean of a measure of the counts, over all scans."""
    return lambda inputs, outputs: np.mean([measure(table) for table in tables(inputs, outputs)])


def _labelled(table):
    return table[-1, :-1].sum() / max(table[-1].sum(), 1)


def _unlabelled(table):
    return table[:-1, -1].sum() / max(table[:-1].sum(), 1)


def _split(table):
    """Share of the walls of which two labels have a fifth and more each."""
    of = table[:-1, :-1] / table[:-1].sum(axis=1, keepdims=True)
    return np.mean((of > 0.2).sum(axis=1) > 1)


def _merged(table):
    """Share of the labels that have a fifth and more of two walls."""
    of = table[:-1, :-1] / table[:-1].sum(axis=1, keepdims=True)
    return np.mean((of > 0.2).sum(axis=0) > 1) if of.shape[1] else 0.0


def _over(measure, limit):
    return lambda inputs, outputs: _of_all(measure)(inputs, outputs) > limit


SEGMENTS = Task(
    id="08-segments",
    title="All walls of a scan",
    drive=DRIVES["08-segments"],
    inputs=scans,
    shapes=lambda inputs: {"labels": inputs["points"].shape[:2]},
    laws=tuple(_step(name, *step) for name, step in STEPS.items()),
    diagnoses=(
        Diagnosis(
            "merged",
            "Many of your walls hold readings of two of the room's or more: where one wall ends "
            "and "
            "the next begins, the line has to change.",
            _over(_merged, 0.3),
        ),
        Diagnosis(
            "missed",
            "Many readings of walls are said to be of none. A guess that clutter spoils finds "
            "nobody who "
            "agrees: guess more often, or from fewer readings; and let the band grow with the "
            "noise.",
            _over(_unlabelled, 0.25),
        ),
        Diagnosis(
            "clutter",
            "Most readings of clutter are said to be of a wall. Who is too far from every line is "
            "of no wall: −1.",
            _over(_labelled, 0.5),
        ),
        Diagnosis(
            "split",
            "Many walls are cut into two pieces or more. All readings of one straight line are of "
            "one "
            "wall, also where something stands before its middle.",
            _over(_split, 0.3),
        ),
    ),
    probes=(
        Probe(
            "another lidar, of 300 beams and less noise",
            lambda rng: scans(rng, 2, beams=300, share=0.008),
            ("some",),
        ),
    ),
    rounds=False,
)
