"""The judge (autograder) of one submission: inputs from a secret seed, worker, verdicts, record."""

import functools
import hashlib
import hmac
import importlib.metadata
import json
import os
import platform
import secrets
import time
from dataclasses import replace
from pathlib import Path

from slamlab import __version__
from slamlab.grading import course_digests, hostile_signs, submissions, task_judging
from slamlab.grading.evidence import Evidence
from slamlab.grading.gradebook_rows import attempt_key
from slamlab.grading.ledger import contents
from slamlab.grading.records import Record
from slamlab.grading.submissions import Submission, SubmissionError
from slamlab.grading.worker_client import WorkerClient
from slamlab.grading.worker_pool import WorkerPool, WorkerStartError

MIN_SECRET_BYTES = 16  # length of the secret [bytes]


def load_secret(file: Path, make=False) -> bytes:
    """Load the secret from which the seeds of the random inputs are derived.

    Parameters
    ----------
    file : Path
    make : bool, whether to make one where there is none, readable by its owner only

    Raises
    ------
    SubmissionError
    """
    if make and not file.exists():
        _make_secret(file)
    try:
        secret = file.read_bytes().strip()
    except OSError as error:
        raise SubmissionError(f"the secret {file} cannot be read: {error.strerror}") from None
    if len(secret) < MIN_SECRET_BYTES:
        raise SubmissionError(f"the secret {file} is shorter than {MIN_SECRET_BYTES} bytes")
    return secret


def _make_secret(file):
    """Make a secret, whole or not at all; of two that are made at once the first one stays."""
    partial = file.with_name(f".{file.name}.{os.getpid()}.part")
    try:
        with os.fdopen(os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600), "w") as made:
            made.write(secrets.token_hex(32) + "\n")
        try:
            os.link(partial, file)
        except FileExistsError:
            return
        except OSError:  # a file system without links
            os.replace(partial, file)
    finally:
        partial.unlink(missing_ok=True)


def seed_for(secret: bytes, exercise_id: str, sha256: str) -> bytes:
    """The secret seed of a submission (HMAC-SHA256): the same for the same content."""
    return hmac.digest(secret, f"{exercise_id} {sha256}".encode(), hashlib.sha256)


def grade_submission(
    submission: Submission, secret: bytes, workers: WorkerPool, default=None, known=None, stop=None
) -> Record:
    """Grade one submission, readable or not.

    Parameters
    ----------
    submission : Submission
    secret : bytes
    workers : WorkerPool
    default : str or None, the exercise that all are to be of
    known : attempt's key to Record, which are not graded again; None for none
    stop : threading.Event or None; once it is set, nothing is waited for any more

    Returns
    -------
    Record, with a reason where it could not be graded
    """
    names = {name: getattr(submission, name) for name in ("student", "number", "handed_in")}
    names["submission"] = submission.name
    names["exercise"] = default and default.zfill(2)
    known = known or {}
    try:
        notebook = submissions.read_notebook(submission)
        said = (submission.note,) if submission.note else ()
        names |= {"sha256": notebook.sha256, "notes": (*notebook.notes, *said)}
        exercise = submissions.identify_exercise(submission, notebook, default)
        seed = seed_for(secret, exercise.id, notebook.sha256)
        names |= {"exercise": exercise.id, "seed": seed.hex()}
        before = known.get(attempt_key(submission.name, notebook.sha256, names["seed"]))
        if before:
            whose = {name: names[name] for name in ("student", "number", "handed_in")}
            return replace(before, **whose)
        names["signs"] = hostile_signs.signs(notebook.cells)
        return Record(**names, **judge_notebook(exercise, notebook.cells, seed, workers, stop))
    except SubmissionError as error:
        return Record(**names, reason=str(error))
    except WorkerStartError as error:
        return Record(**names, reason=str(error), failed=True)
    except Exception as error:  # a fault of the grader's own must not end the class
        reason = f"the grader failed: {type(error).__name__}: {error}"
        return Record(**names, reason=reason, failed=True)


def judge_notebook(
    exercise, cells, seed: bytes, workers: WorkerPool, stop=None, unredacted=False
) -> dict:
    """Run a notebook's cells in a worker and judge all tasks with the inputs of a seed.

    Parameters
    ----------
    exercise : Exercise
    cells : (number, source) in order
    seed : bytes
    workers : WorkerPool
    stop : threading.Event or None
    unredacted : bool, whether failures are told without redaction, which reveals inputs, too

    Returns
    -------
    what a Record holds of it, by field name

    Raises
    ------
    WorkerStartError
    """
    begin, judging = time.monotonic(), time.thread_time()
    evidence = Evidence(exercise)
    with WorkerClient(exercise, cells, workers.start, stop, unredacted) as client:

        def answer(task, call, sets):
            return task_judging.answer_of(client, evidence, task, call, sets)

        verdicts = exercise.verdicts(
            lambda task: task_judging.judge_task(task, seed, answer, unredacted)
        )
    seconds = {"wall": time.monotonic() - begin}
    seconds |= {"judge_cpu": time.thread_time() - judging, "worker_cpu": client.cpu}
    return {
        "verdicts": tuple(verdicts.values()),
        "cells": dict(sorted(client.problems.items())),
        "isolation": workers.level,
        "versions": versions(),
        "judges": {task.id: course_digests.task_digest(task) for task in exercise.tasks},
        "seconds": {name: round(value, 3) for name, value in seconds.items()},
        "titles": {task.id: task.title for task in exercise.tasks},
        **_kept(cells, evidence),
    }


def _kept(cells, evidence):
    """What is kept of an attempt: hashes by name, and the bytes by these."""
    text = json.dumps([list(cell) for cell in cells]).encode()
    both = {"cells": contents.packed(text), "outputs": evidence.packed()}
    kept = {name: contents.name_of(data) for name, data in both.items() if data}
    return {"kept": kept, "contents": {kept[name]: both[name] for name in kept}}


@functools.cache
def versions():
    """The versions of the grading software: slamlab, Python, numpy, sympy."""
    libraries = {name: importlib.metadata.version(name) for name in ("numpy", "sympy")}
    return {"slamlab": __version__, "python": platform.python_version()} | libraries
