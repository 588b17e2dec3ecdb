"""Exercise 01, the task of chaining steps: dead reckoning."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex01_inputs as make
from slamlab.exercises.tasks.ex01_laws import between, place_of, same_angle, small, towards


def _chained(start, steps):
    """Start and steps as the track they make: (n, k + 1) complex [m] and headings [rad]."""
    headings = np.cumsum(np.column_stack([start[:, 2], steps[..., 2]]), axis=1)
    moves = place_of(steps) * towards(headings[:, :-1])
    return np.cumsum(np.column_stack([place_of(start), moves]), axis=1), headings


def _tracks(o, z, headings):
    """Whether the tracks returned are those given."""
    got = o["result"]
    return got.shape[:2] == z.shape and bool(
        small(place_of(got) - z).all() and same_angle(got[..., 2], headings).all()
    )


def _if_complete(law):
    """The law where there is a pose for the start and each step; broken everywhere else."""

    def holds(i, o):
        complete = o["result"].shape[1] == i["steps"].shape[1] + 1
        return law(i, o["result"]) if complete else np.zeros(len(i["steps"]), bool)

    return holds


def _follows_steps(i, track):
    moved, turned = between(track[:, :-1], track[:, 1:])
    return small(moved - place_of(i["steps"])) & same_angle(turned, i["steps"][..., 2])


def _comes_home(i, track):
    tours = slice(0, make.TRACKS // 2)
    first, last = i["start"][tours], track[tours, -1]
    return small(place_of(last) - place_of(first)) & same_angle(last[:, 2], first[:, 2])


def _summed(i, o):
    rows = np.concatenate([i["start"][:, None], i["steps"]], axis=1).cumsum(axis=1)
    return _tracks(o, place_of(rows), rows[..., 2])


def _unchained(i, o):
    each = np.stack([_chained(i["start"], s[:, None])[0][:, 1] for s in _columns(i)], axis=1)
    got = place_of(o["result"])[:, -each.shape[1] :]
    return got.shape == each.shape and small(got - each).all()


def _columns(i):
    return np.moveaxis(i["steps"], 1, 0)


def _all_alike(i, o):
    return o["result"].shape[1] > 1 and small(o["result"] - o["result"][:, -1:]).all()


def _part(rows):
    """Diagnosis of a track that is right but holds only these rows."""

    def matches(i, o):
        z, headings = _chained(i["start"], i["steps"])
        return _tracks(o, z[:, rows], headings[:, rows])

    return matches


TRACK = Task(
    id="01-track",
    title="Dead reckoning",
    drive=DRIVES["01-track"],
    inputs=make.start_and_steps,
    shapes={"result": (None, 3)},
    laws=(
        Law(
            "start",
            1,
            "the track begins with the start",
            _if_complete(
                lambda i, track: (
                    small(place_of(track[:, 0]) - place_of(i["start"]))
                    & same_angle(track[:, 0, 2], i["start"][:, 2])
                )
            ),
        ),
        Law(
            "steps",
            2,
            "each pose, seen from the one before, is the step",
            _if_complete(_follows_steps),
        ),
        Law(
            "home",
            1,
            "a tour round a closed polygon ends where it began",
            _if_complete(_comes_home),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "start missing",
            "The start is missing: n steps make n + 1 poses, the start being the first.",
            _part(slice(1, None)),
        ),
        Diagnosis(
            "last step missing",
            "The last pose is missing: n steps make n + 1 poses. Append after each step.",
            _part(slice(None, -1)),
        ),
        Diagnosis(
            "one pose many times",
            "All rows are the same pose. You probably change one array in place and append it "
            "again and again: a list holds the array itself, not a copy.",
            _all_alike,
        ),
        Diagnosis(
            "not chained",
            "Every step begins at the start. Each must begin where the one before ended.",
            _unchained,
        ),
        Diagnosis(
            "added up",
            "The steps are added up as they are. Each is measured in the frame of the pose before "
            "it: use next_pose.",
            _summed,
        ),
        Diagnosis(
            "start ignored",
            "The track begins at the origin instead of at the start.",
            lambda i, o: _tracks(o, *_chained(np.zeros_like(i["start"]), i["steps"])),
        ),
    ),
    needs=("01-next-pose",),
)
