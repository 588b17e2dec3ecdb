"""Task 08-segments: walls of rooms with clutter, scored by the fraction of right labels."""

import functools

import numpy as np
from scipy.optimize import linear_sum_assignment

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex08_landmarks_from_scans.calls import CALLS
from course.exercises.ex08_landmarks_from_scans.segments.rooms import counts, scans, walls

STEPS = {
    "some": (
        0.7,
        0.5,
        "Which lines does your function find, and how many readings of clutter "
        "have the label of a wall?",
        "Print how many labels your result has, and how many readings each label has. A scan shows "
        "six to ten walls, and about three quarters of its readings belong to them.",
    ),
    "most": (
        0.84,
        1,
        "How wide is your band at short and at long range, compared with σ of a range there?",
        "Choose a near and a distant wall, both at nearly normal incidence. Divide the distances "
        "of their readings from the line by the ranges. The quotients have about the same standard "
        "deviation for both walls.",
    ),
    "nearly": (
        0.88,
        1.5,
        "Which labels are wrong: those near corners, of clutter near a wall, or of a wall with two "
        "labels?",
        "Choose one wall and one of its corners. Print the labels of the wall's readings, and the "
        "distances of the ten readings nearest to the corner from both lines.",
    ),
    "well": (
        0.92,
        1.5,
        "Which walls do you split in two or miss: short walls, distant walls, or "
        "walls at oblique incidence?",
        "Print ρ and α of all your lines of one scan. Two lines with nearly the same ρ and α are "
        "probably one wall.",
    ),
}
"""Law's name to the score asked for, points, question, step. Labels by blocks of beams reach 0.45,
windows of 25 readings
nothing, RANSAC with a fixed band 0.77, with one that grows with the range 0.91."""


def tables(inputs, outputs):
    points, labels = inputs["points"], outputs["labels"].astype(int)
    return _tables(points.tobytes(), labels.tobytes(), points.shape)


@functools.lru_cache(maxsize=4)  # every law asks for them
def _tables(points, labels, shape):
    points, labels = np.frombuffer(points), np.frombuffer(labels, dtype=int)
    pairs = zip(labels.reshape(shape[:2]), walls(points.reshape(shape)), strict=True)
    return [counts(got, want) for got, want in pairs]


def share(table):
    """Share of right readings; each found wall matches one true wall at most."""
    rows, columns = linear_sum_assignment(-table[:-1, :-1])
    right = table[:-1, :-1][rows, columns].sum()
    return 2 * right / (table[:-1].sum() + table[:, :-1].sum())


def mean_share(inputs, outputs):
    return np.mean([share(table) for table in tables(inputs, outputs)])


def _step(name, wanted, points, question, step):
    return Law(
        name,
        points,
        f"the mean score (F1) over the scans is at least {wanted}",
        lambda inputs, outputs: bool(mean_share(inputs, outputs) >= wanted),
        why=lambda inputs, outputs: (
            f"the mean score is {mean_share(inputs, outputs):.3f}; {wanted} is required"
        ),
        asks=f"Plot a scan with a colour for each label. {question}",
        step=step,
    )


# ---- what goes wrong ---------------------------------------------------------------------------


def _of_all(measure):
    return lambda inputs, outputs: np.mean([measure(table) for table in tables(inputs, outputs)])


def _labelled(table):
    return table[-1, :-1].sum() / max(table[-1].sum(), 1)


def _unlabelled(table):
    return table[:-1, -1].sum() / max(table[:-1].sum(), 1)


def _split(table):
    """Share of walls with a fifth or more in two labels."""
    of = table[:-1, :-1] / table[:-1].sum(axis=1, keepdims=True)
    return np.mean((of > 0.2).sum(axis=1) > 1)


def _merged(table):
    """Share of labels with a fifth or more of two walls."""
    of = table[:-1, :-1] / table[:-1].sum(axis=1, keepdims=True)
    return np.mean((of > 0.2).sum(axis=0) > 1) if of.shape[1] else 0.0


def _over(measure, limit):
    return lambda inputs, outputs: _of_all(measure)(inputs, outputs) > limit


SEGMENTS = Task(
    id="08-segments",
    title="Segmentation of a scan",
    call=CALLS["08-segments"],
    inputs=scans,
    shapes=lambda inputs: {"labels": inputs["points"].shape[:2]},
    laws=tuple(_step(name, *step) for name, step in STEPS.items()),
    diagnoses=(
        Diagnosis(
            "merged",
            "Many of your labels contain readings of two or more walls. Each wall must have its "
            "own label.",
            _over(_merged, 0.3),
            asks="Choose a label with many readings, and plot these readings. On how many "
            "straight lines do they lie?",
        ),
        Diagnosis(
            "missed",
            "Many readings of walls have the label −1. If you draw samples, one with an outlier "
            "has few inliers: use more trials, samples of fewer readings, or a band that grows "
            "with the noise. Other methods must also join the parts of one wall.",
            _over(_unlabelled, 0.25),
            asks="Plot the readings with the label −1. Which of them lie on a wall, and how "
            "far are they from your nearest line?",
        ),
        Diagnosis(
            "clutter",
            "Most readings of clutter have the label of a wall. A reading that is too far from "
            "every line must have the label −1.",
            _over(_labelled, 0.5),
            asks="Plot the readings of one label. How far from its line are the most distant ones?",
        ),
        Diagnosis(
            "split",
            "Many walls have two or more labels. All readings on one straight line belong to one "
            "wall, even if an object covers the middle of the wall.",
            _over(_split, 0.3),
            asks="Plot the labels along one long wall. Where does the label change, and what "
            "is there?",
        ),
    ),
    probes=(
        Probe(
            "another lidar, of 300 beams and less noise",
            lambda rng: scans(rng, 2, beams=300, share=0.008),
            ("some",),
        ),
    ),
    may_round=False,
    needs=("08-fit-line",),
    begins=(
        "How many readings are near the line through the readings 0 and 6 of a scan?",
        "Which readings are left for the next line when you have found the first one?",
    ),
)
