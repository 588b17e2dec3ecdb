"""Autograder (judge) of one submission: inputs from a secret seed, a worker, verdicts, a Record."""

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

from classroom.grading import (
    course_digests,
    preflight,
    submissions,
    suspicious_code,
    task_judging,
)
from classroom.grading.gradebook_rows import attempt_key
from classroom.grading.ledger import contents
from classroom.grading.records import Record
from classroom.grading.stored_answers import AnswerRecorder
from classroom.grading.submissions import Submission, SubmissionError
from classroom.grading.worker_client import WorkerClient
from classroom.grading.worker_pool import WorkerPool, WorkerStartError
from slamlab import __version__

MIN_SECRET_BYTES = 16  # length of the secret [bytes]


def load_secret(file: Path, make=False) -> bytes:
    """Read the secret from which seeds are derived; ``make`` creates a missing secret that only its
    owner can read. Raises SubmissionError.
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
    """Create a secret atomically; if two processes each create a secret, the first one is kept."""
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
    """Return the secret seed of a submission (HMAC-SHA256); equal content gives equal seeds."""
    return hmac.digest(secret, f"{exercise_id} {sha256}".encode(), hashlib.sha256)


def grade_submission(
    submission: Submission, secret: bytes, workers: WorkerPool, default=None, known=None, stop=None
) -> Record:
    """Grade a submission; return its Record, with a reason if it could not be graded. ``default``,
    if given, is the exercise of all submissions. ``known`` attempts (dict from key to Record) are
    not graded again. Setting ``stop`` ends all waiting.
    """
    names = {name: getattr(submission, name) for name in ("student", "number", "handed_in")}
    names |= {"submission": submission.name, "sha256": submission.sha256}
    names["exercise"] = submission.taken_as or (default and default.zfill(2))
    known = known or {}
    try:
        notebook = submissions.read_notebook(submission)
        note = (submission.note,) if submission.note else ()
        names |= {"sha256": notebook.sha256, "notes": (*notebook.notes, *note)}
        exercise = submissions.identify_exercise(submission, notebook, default)
        seed = seed_for(secret, exercise.id, notebook.sha256)
        names |= {"exercise": exercise.id, "seed": seed.hex()}
        before = known.get(attempt_key(submission.name, notebook.sha256, names["seed"]))
        if before:
            whose = {name: names[name] for name in ("student", "number", "handed_in")}
            return replace(before, **whose)
        names["signs"] = suspicious_code.signs(notebook.cells)
        return Record(**names, **judge_notebook(exercise, notebook.cells, seed, workers, stop))
    except SubmissionError as error:
        return Record(**names, reason=str(error))
    except WorkerStartError as error:
        return Record(**names, reason=str(error), failed=True)
    except Exception as error:  # an error of the grader must not end the run
        reason = f"the grader failed: {type(error).__name__}: {error}"
        return Record(**names, reason=reason, failed=True)


def judge_notebook(
    exercise, cells, seed: bytes, workers: WorkerPool, stop=None, unredacted=False
) -> dict:
    """Judge cells, given as (number, source), and return fields of a Record. If ``unredacted``,
    messages of failures may reveal inputs. Raises WorkerStartError.
    """
    begin, judging = time.monotonic(), time.thread_time()
    recorder = AnswerRecorder(exercise)
    with WorkerClient(exercise, cells, workers.start, stop, unredacted) as client:

        def answer(task, call, sets, references):
            return task_judging.answer_of(client, recorder, task, call, sets, references)

        def judge_one(task, references):
            return task_judging.judge_task(task, seed, answer, references, unredacted)

        verdicts = exercise.verdicts(judge_one)
    seconds = {"wall": time.monotonic() - begin}
    seconds |= {"judge_cpu": time.thread_time() - judging, "worker_cpu": client.cpu}
    return {
        "verdicts": tuple(verdicts.values()),
        "cells": preflight.explained(client.problems, cells, exercise),
        "isolation": workers.level,
        "versions": versions(),
        "judges": {task.id: course_digests.task_digest(task) for task in exercise.tasks},
        "seconds": {name: round(value, 3) for name, value in seconds.items()},
        "titles": {task.id: task.title for task in exercise.tasks},
        **_kept(cells, recorder),
    }


def _kept(cells, recorder):
    """Return the contents to store, as hashes by name and bytes by hash."""
    text = json.dumps([list(cell) for cell in cells]).encode()
    both = {"cells": contents.packed(text), "outputs": recorder.packed()}
    kept = {name: contents.name_of(data) for name, data in both.items() if data}
    return {"kept": kept, "contents": {kept[name]: both[name] for name in kept}}


@functools.cache
def versions():
    libraries = {name: importlib.metadata.version(name) for name in ("numpy", "sympy")}
    return {"slamlab": __version__, "python": platform.python_version()} | libraries
