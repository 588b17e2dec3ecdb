"""Task 12-decide: the wall follower's next step, judged by the rules of the listing, mended."""

import numpy as np

from slamlab.exercises.drives.ex12 import DOINGS, DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

SCAN, LEFT, RIGHT, DRIVE = range(len(DOINGS))
FAR, NEAR, STEP = 0.25, 0.18, 0.04


def moments(rng, each=8):
    """Every doing beside a near, a middling and a far wall, and beside none; driven some of a step.

    A third of the drives have come to their end.
    """
    ranges = [(0.06, 0.17), (0.185, 0.245), (0.255, 0.28)]
    rows = []
    for doing in (SCAN, LEFT, RIGHT, DRIVE):
        for low, high in ranges:
            for k in range(each):
                driven = rng.uniform(0.005, 0.035) if k % 3 else rng.uniform(0.041, 0.05)
                rows.append((doing, rng.uniform(low, high), driven if doing == DRIVE else 0.0))
        rows.append((doing, np.inf, 0.02 if doing == DRIVE else 0.0))
    doing, reading, driven = np.array(rows)[rng.permutation(len(rows))].T
    return {"doing": doing, "reading": reading, "driven": driven}


def decided(doing, reading, driven, far=FAR, near=NEAR):
    """What comes next, a moment at a time."""
    if doing in (SCAN, LEFT) and reading > far:
        return LEFT
    if doing in (SCAN, LEFT, RIGHT):
        return RIGHT if reading < near else DRIVE
    return DRIVE if driven < STEP and reading > near else SCAN


def _all(inputs, rule):
    return np.array([rule(*row) for row in zip(*inputs.values(), strict=True)])


def _law(which):
    """Decisions in some of the moments are those of the listing."""

    def holds(inputs, outputs):
        rows = which(inputs["doing"], inputs["reading"], inputs["driven"])
        return (outputs["result"] == _all(inputs, decided))[rows]

    return holds


# ---- mistakes: the same rules with a slip ------------------------------------------------------


def mirrored(doing, reading, driven):
    right = decided(doing, reading, driven)
    return {LEFT: RIGHT, RIGHT: LEFT}.get(right, right)


def turns_back(doing, reading, driven):
    """Forgets that it was turning right."""
    return decided(LEFT if doing == RIGHT else doing, reading, driven)


def drives_on(doing, reading, driven):
    """Or for and in the loop of the drive."""
    if doing == DRIVE:
        return DRIVE if driven < STEP or reading > NEAR else SCAN
    return decided(doing, reading, driven)


def blind(doing, reading, driven):
    """Drives its step whatever it reads."""
    if doing == DRIVE:
        return DRIVE if driven < STEP else SCAN
    return decided(doing, reading, driven)


def endless(doing, reading, driven):
    """Drives as long as the wall is not near."""
    if doing == DRIVE:
        return DRIVE if reading > NEAR else SCAN
    return decided(doing, reading, driven)


def turns_at_the_wheel(doing, reading, driven):
    """Corrects while driving, without a scan."""
    if doing == DRIVE and driven < STEP:
        return decided(SCAN, reading, driven)
    return decided(doing, reading, driven)


def swapped_limits(doing, reading, driven):
    """While turning; a drive has one limit only."""
    limits = {} if doing == DRIVE else {"far": NEAR, "near": FAR}
    return decided(doing, reading, driven, **limits)


def one_turn(doing, reading, driven):
    """After a turn to the left it drives, however near the wall is."""
    if doing == LEFT and reading <= FAR:
        return DRIVE
    return decided(doing, reading, driven)


def memoryless(doing, reading, driven):
    """Asks the reading only, in every doing but the drive's end."""
    if doing == DRIVE and driven >= STEP:
        return SCAN
    return decided(SCAN, reading, driven)


HINTS = {
    "mirrored": (
        "Left and right have changed places: the wall is on the left, so too far means turn left.",
        mirrored,
    ),
    "turns-back": (
        "While turning right it turns back left when the wall is far. In the listing the loop that "
        "turns left is over by then: from 'right' there are only 'right' and 'drive'.",
        turns_back,
    ),
    "or-for-and": (
        "It drives on while *one* of the two holds. Both have to: less than 4 cm driven *and* the "
        "wall farther than 0.18 m.",
        drives_on,
    ),
    "blind": (
        "A drive never looks at the wall: at 0.18 m or less it has to stop and scan.",
        blind,
    ),
    "endless": ("A drive never ends by its length: after 4 cm it has to stop and scan.", endless),
    "no-scan": (
        "While driving it turns when the wall is too near or too far. In the listing a drive only "
        "ends, and what comes then is a scan.",
        turns_at_the_wheel,
    ),
    "limits-swapped": (
        "The two limits have changed places: above 0.25 m is too far, below 0.18 m is too near.",
        swapped_limits,
    ),
    "one-turn": (
        "Once it has turned left it drives. If it turned too far, and the wall is nearer than "
        "0.18 m now, it has to turn right first.",
        one_turn,
    ),
    "memoryless": (
        "It decides by the reading alone. What it is doing matters: who turns right does not turn "
        "left again, and a drive that meets the wall ends with a scan.",
        memoryless,
    ),
}


def _slipped(rule):
    return lambda inputs, outputs: (outputs["result"] == _all(inputs, rule)).all()


DECIDE = Task(
    id="12-decide",
    title="The follower decides",
    drive=DRIVES["12-decide"],
    inputs=moments,
    shapes={"result": ()},
    laws=(
        Law(
            "too far",
            1,
            "after a scan, and while turning left: beyond 0.25 m turn left",
            _law(lambda doing, reading, driven: (doing <= LEFT) & (reading > FAR)),
        ),
        Law(
            "too near",
            1,
            "unless it drives: nearer than 0.18 m turn right",
            _law(lambda doing, reading, driven: (doing <= RIGHT) & (reading < NEAR)),
        ),
        Law(
            "at hand",
            1,
            "between the two it drives, and after a turn to the right from 0.18 m on",
            _law(
                lambda doing, reading, driven: (
                    (doing <= RIGHT) & (reading > NEAR) & ((doing == RIGHT) | (reading < FAR))
                )
            ),
        ),
        Law(
            "driving",
            1,
            "it drives on until 4 cm are driven",
            _law(lambda doing, reading, driven: (doing == DRIVE) & (reading > NEAR)),
        ),
        Law(
            "stopping",
            1,
            "a drive at the wall ends with a scan",
            _law(lambda doing, reading, driven: (doing == DRIVE) & (reading < NEAR)),
        ),
    ),
    diagnoses=tuple(Diagnosis(name, hint, _slipped(rule)) for name, (hint, rule) in HINTS.items()),
)
