"""Grading one submission: inputs from a secret, a worker, verdicts, a record."""

import functools
import hashlib
import hmac
import importlib.metadata
import os
import platform
import secrets
import time
from dataclasses import replace
from pathlib import Path

from slamlab import __version__
from slamlab.checks.drives import StudentError
from slamlab.grading import kinship, submissions
from slamlab.grading.client import Client
from slamlab.grading.records import Record
from slamlab.grading.rows import key
from slamlab.grading.submissions import Submission, Unreadable
from slamlab.grading.workers import CannotStart, Workers

SHORTEST_SECRET = 16


def secret_from(file: Path, make=False) -> bytes:
    """The secret that inputs are drawn from.

    Parameters
    ----------
    file : Path
    make : bool, whether to make one where there is none, readable by its owner only

    Raises
    ------
    Unreadable
    """
    if make and not file.exists():
        handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(handle, "w") as stream:
            stream.write(secrets.token_hex(32) + "\n")
    try:
        secret = file.read_bytes().strip()
    except OSError as error:
        raise Unreadable(f"the secret {file} cannot be read: {error.strerror}") from None
    if len(secret) < SHORTEST_SECRET:
        raise Unreadable(f"the secret {file} is shorter than {SHORTEST_SECRET} bytes")
    return secret


def seed_for(secret: bytes, exercise_id: str, sha256: str) -> bytes:
    """The seed of a submission: the same for the same content, unknown without the secret."""
    return hmac.digest(secret, f"{exercise_id} {sha256}".encode(), hashlib.sha256)


def grade(
    submission: Submission, secret: bytes, workers: Workers, default=None, known=None, stop=None
) -> Record:
    """Grade a submission, whatever it is.

    Parameters
    ----------
    submission : Submission
    secret : bytes
    workers : Workers
    default : str or None, the exercise of notebooks that do not tell it
    known : attempt's key to Record, which are not graded again; None for none
    stop : threading.Event or None; once it is set, nothing is waited for any more

    Returns
    -------
    Record, with a reason where it could not be graded
    """
    names = {name: getattr(submission, name) for name in ("student", "number", "handed_in")}
    names["submission"] = submission.name
    known = known or {}
    try:
        notebook = submissions.read(submission)
        names |= {"sha256": notebook.sha256, "notes": notebook.notes}
        exercise = submissions.exercise_of(submission, notebook, default)
        seed = seed_for(secret, exercise.id, notebook.sha256)
        names |= {"exercise": exercise.id, "seed": seed.hex()}
        before = known.get(key(submission.name, notebook.sha256, names["seed"]))
        if before:
            return replace(before, handed_in=submission.handed_in)
        names["fingerprints"] = kinship.fingerprints(notebook.cells, exercise)
        return Record(**names, **judge(exercise, notebook.cells, seed, workers, stop))
    except Unreadable as error:
        return Record(**names, reason=str(error))
    except CannotStart as error:
        return Record(**names, reason=str(error), failed=True)
    except Exception as error:  # a fault of the grader's own must not end the class
        reason = f"the grader failed: {type(error).__name__}: {error}"
        return Record(**names, reason=reason, failed=True)


def judge(exercise, cells, seed: bytes, workers: Workers, stop=None, tell=False) -> dict:
    """Judge a notebook's cells with the inputs of a seed.

    Parameters
    ----------
    exercise : Exercise
    cells : (number, source) in order
    seed : bytes
    workers : Workers
    stop : threading.Event or None
    tell : bool, whether failures are told in full, which tells of the inputs, too

    Returns
    -------
    what a Record holds of it, by field name

    Raises
    ------
    CannotStart
    """
    begin, judging = time.monotonic(), time.thread_time()
    with Client(exercise, cells, workers.start, stop, tell) as client:

        def judge_one(task):
            inputs = task.draw(seed)
            try:
                return task.judge(inputs, client.run(task, inputs))
            except StudentError as error:
                return task.failed(error.kind, error.message)

        verdicts = exercise.verdicts(judge_one)
    seconds = {"wall": time.monotonic() - begin}
    seconds |= {"judge_cpu": time.thread_time() - judging, "worker_cpu": client.cpu}
    return {
        "verdicts": tuple(verdicts.values()),
        "cells": dict(sorted(client.problems.items())),
        "isolation": workers.level,
        "versions": versions(),
        "seconds": {name: round(value, 3) for name, value in seconds.items()},
        "titles": {task.id: task.title for task in exercise.tasks},
    }


@functools.cache
def versions():
    """The versions of what graded."""
    libraries = {name: importlib.metadata.version(name) for name in ("numpy", "sympy")}
    return {"slamlab": __version__, "python": platform.python_version()} | libraries
