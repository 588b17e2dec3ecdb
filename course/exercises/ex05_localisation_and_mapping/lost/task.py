"""Task 05-lost: global localisation with outliers. Any method is allowed."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex05_localisation_and_mapping.calls import CALLS
from course.exercises.ex05_localisation_and_mapping.observations import (
    EYES,
    driven,
    robots,
    with_wrapped_heading,
)
from slamlab.evaluation import nees
from slamlab.geometry import wrap

LATE, JUDGED = 10, 25  # steps at the end in which a robot is localised, and in which P is judged
LOCALISED = 0.4  # largest rms error of the position of a robot that is localised [m]
ENOUGH = 53 / 60  # over 100 seeds three right programs find at least 55, a median of nine 37 to 53
PRECISE = np.array([1.5, 6.0])  # by so much odometry and sensor of a second set are better
PARTS = {"pose": np.s_[:3], "position": np.s_[:2], "heading": np.s_[2:]}
FREE = "four landmarks, no outliers"
# of the median NEES: right programs have 2.4 to 3.6, for a kind 2.3 to 3.8, 1.4 to 2.5, 0.6 to 1.3
LEAST, MOST = np.array([2.3, *[1.9, 1.3, 0.5] * 2]), np.array([3.7, *[4.5, 2.8, 1.6] * 2])


def both_kinds(rng):
    """Robots, and as many with better odometry and sensors."""
    kinds = robots(rng), robots(rng, better=PRECISE)
    return {name: np.concatenate([kind[name] for kind in kinds]) for name in kinds[0]}


def _kinds(inputs):
    precise = inputs["R"][:, 0, 0] < EYES[0] ** 2 / 2
    return [kind for kind in (~precise, precise) if kind.any()]


@once
def _off(inputs, outputs):
    off = outputs["xs"].copy()
    for kind in _kinds(inputs):
        off[kind] -= driven(*(inputs[name][kind].mean(axis=0) for name in ("x", "us")))
    off[..., 2] = wrap(off[..., 2])
    return off


def offs(inputs, outputs):
    """Root mean square position error of the last steps [m], (k,)."""
    late = _off(inputs, outputs)[:, -LATE:, :2]
    return np.sqrt(np.square(late).sum(axis=-1).mean(axis=-1))


@once
def typical_nees(inputs, outputs):
    """Medians over the localised robots of the mean NEES: of the pose of all, and of the parts for
    each kind; NaN if there is none, or if a P is no covariance of a filter."""
    found = offs(inputs, outputs) < LOCALISED
    off, P = (array[:, -JUDGED:] for array in (_off(inputs, outputs), outputs["Ps"]))

    def median(robots, at):
        if not robots.any() or _defect(inputs, outputs):  # P may have no inverse
            return np.nan
        return np.median(nees(off[robots][..., at], P[robots][..., at, at]).mean(axis=1))

    of_kinds = [median(found & kind, at) for kind in _kinds(inputs) for at in PARTS.values()]
    return np.array([median(found, PARTS["pose"]), *of_kinds])


@once
def _defect(inputs, outputs):
    """Why the P of the localised robots are no covariances of a filter, a sentence or ""."""
    P = outputs["Ps"][offs(inputs, outputs) < LOCALISED]
    late = P[:, -JUDGED:]
    if (np.linalg.eigvalsh(P) <= 0).any():
        return "Not every P of localised robots is positive definite (all 40 steps)."
    if not late[..., ~np.eye(3, dtype=bool)].any(axis=-1).all():
        return "Some P of localised robots are diagonal: they contain no correlations."
    if (np.ptp(late, axis=1).max(axis=(-2, -1)) < 0.01 * late.max(axis=(1, 2, 3))).any():
        return "P of a localised robot is the same in all of the last 25 steps."
    return ""


def _consistent(inputs, outputs):
    value = typical_nees(inputs, outputs)
    return np.all((value >= LEAST) & (value <= MOST))


def _misfit(*pairs):
    """Match localised robots whose P is (too small, too large) in some of the medians."""

    def matches(inputs, outputs):
        value = typical_nees(inputs, outputs)
        found = np.mean(offs(inputs, outputs) < LOCALISED) >= 0.6
        beyond = bool((value > MOST).any()), bool((value < LEAST).any())
        return found and not _consistent(inputs, outputs) and beyond in pairs

    return matches


def _believing(inputs, outputs):
    off = offs(inputs, outputs)
    return np.mean(off < LOCALISED) < 0.3 and np.median(off) > 0.6 and off.max() < 6


def _some_led_astray(inputs, outputs):
    off = offs(inputs, outputs)
    return 0.3 <= np.mean(off < LOCALISED) < ENOUGH and np.median(off[off >= 0.4]) > 1.5


def _one_step_off(inputs, outputs):
    off = offs(inputs, outputs)
    return off.min() > 0.25 and off.max() < 0.8


def _why(inputs, outputs):
    off, value = offs(inputs, outputs), typical_nees(inputs, outputs)
    fits = _defect(inputs, outputs)
    if not fits and (off < LOCALISED).any():
        fits = f"The median of their mean NEES is {value[0]:.3g} for the pose. "
        for kind, of_kind in zip(("usual", "better"), value[1:].reshape(-1, 3), strict=False):
            parts = (f"{part} {one:.3g}" for part, one in zip(PARTS, of_kind, strict=True))
            all_parts = "none is localised" if np.isnan(of_kind[0]) else ", ".join(parts)
            fits += f"With {kind} sensors: {all_parts}. "
    return (
        f"{np.sum(off < LOCALISED)} of {len(off)} robots are localised (error below 0.4 m at the "
        f"end). The median error of all is {np.median(off):.2f} m, the largest {off.max():.2f} m. "
        f"{fits}".strip()
    )


def _on_the_way(inputs):
    seen = np.flatnonzero(inputs["ids"][0] >= 0)[:4]
    places = inputs["landmarks"][0][inputs["ids"][0, seen].astype(int)]
    return {
        "distances by the map from the start to the first landmarks [m]": np.linalg.norm(
            places - inputs["x"][0, :2], axis=1
        ),
        "their measured ranges [m]": inputs["zs"][0, seen, 0],
    }


def _step(name, points, share, says, asks, knows=False):
    def holds(inputs, outputs):
        found = np.mean(offs(inputs, outputs) < LOCALISED)
        return found >= share and (not knows or _consistent(inputs, outputs))

    return Law(name, points, says, holds, why=_why, asks=asks, step=_on_the_way)


STEPS_UP = (
    _step(
        "better", 0.5, 0.3, "at the end, 18 robots of 60 are localised: the error is below 0.4 m",
        "Which measurements agree with each other if the heading is right? And if it is wrong?",
    ),
    _step(
        "good", 1, 0.6, "36 robots of 60 are localised",
        "Assume a heading. After some steps, how can you detect whether this heading was right?",
    ),
    _step(
        "found", 1.5, ENOUGH, "53 robots of 60 are localised",
        "From how many measurements do you choose the heading, and how many may be outliers?",
    ),
    _step(
        "consistent", 2, ENOUGH,
        "53 robots of 60 are localised, and their P is consistent (the limits are in the text)",
        "How does P change if you accept an outlier, and how does the error change?", knows=True,
    ),
)  # fmt: skip


LOST = Task(
    id="05-lost",
    title="Make it better: global localisation with outliers",
    needs=("05-locate", "05-localise"),
    call=CALLS["05-lost"],
    inputs=both_kinds,
    shapes=lambda inputs: {
        "xs": (*inputs["ids"].shape, 3),
        "Ps": (*inputs["ids"].shape, 3, 3),
    },
    laws=STEPS_UP,
    diagnoses=(
        Diagnosis(
            "heading-of-the-start",
            "Most robots have an error of metres. Does the estimate keep the initial heading, or a "
            "heading from an outlier? Try so many initial headings that one is nearly right. If "
            "you do: by which number do you choose? A rejected measurement must count against its "
            "heading, but each by the same amount, so that one outlier does not decide.",
            lambda inputs, outputs: np.median(offs(inputs, outputs)) > 1.5,
            asks="With which headings does your filter begin? With which of them do the first "
            "measurements agree?",
        ),
        Diagnosis(
            "every-observation-believed",
            "The headings may be right, but hardly any position is right. Do you use every "
            "measurement, even the outliers? Compare each innovation with S before the update.",
            _believing,
            asks="How large is the innovation of an outlier, compared with S? What does your "
            "filter do with it?",
        ),
        Diagnosis(
            "heading-by-few-observations",
            "Some robots are localised, and others have an error of metres: probably their heading "
            "is wrong. Either you tried no initial heading near the right one, or a few outliers "
            "decided about it. With a wrong heading, a gate also rejects correct measurements.",
            _some_led_astray,
            asks="Which initial headings do you try? How many measurements decide about the "
            "heading, and by how much does a single outlier change this decision?",
        ),
        Diagnosis(
            "another-step",
            "The errors of all robots are about as large as one step. Row k of your result must be "
            "the belief after control input k and its measurement.",
            _one_step_off,
            asks="To which step does the first row of your result belong?",
        ),
        Diagnosis(
            "P-too-small",
            "P is too small for the errors of the localised robots. Either a noise is missing or "
            "smaller than C and R, or x has an error that P does not contain: for example from "
            "outliers, or from a measurement used twice or before its control input.",
            _misfit((True, False)),
            asks="Which lines make P smaller? Which errors of x does your P not contain?",
        ),
        Diagnosis(
            "P-too-large",
            "P is too large for the errors of the localised robots, perhaps in one component. "
            "Either a noise is larger than C and R, P belongs to a less accurate estimate than x, "
            "or a component has another unit.",
            _misfit((False, True)),
            asks="Is P the covariance of the x that you return? Which noises does it contain?",
        ),
        Diagnosis(
            "P-made-up",
            "P is not the covariance of your estimates. In each step, P must contain the variances "
            "and correlations of x, y and θ, for accurate sensors as well as for others.",
            _misfit((True, True), (False, False)),
            asks="How does your method compute P in each step? How large are the errors of "
            "position and heading, compared with σ in your P?",
        ),
        Diagnosis(
            "rejects-without-outliers",
            "Few robots are localised even without outliers. Either your filter rejects correct "
            "measurements (is each difference of bearings wrapped?), or it chooses the heading by "
            "too few of them.",
            lambda inputs, outputs: np.mean(offs(inputs, outputs) < LOCALISED) < 0.3,
            on=FREE,
            asks="How many correct measurements does your filter reject, and which ones?",
        ),
    ),
    probes=(Probe(FREE, lambda rng: robots(rng, 6, 25, 4, 0.0), ("better",)),),
    parts=with_wrapped_heading("xs"),
    may_round=False,
    begins=(
        "If the heading at the start were known, which of your functions would do the rest?",
        "How can you tell by the next measurements that a heading was wrong?",
    ),
)
