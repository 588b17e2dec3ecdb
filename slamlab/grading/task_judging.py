"""Judging one task: inputs of a seed, answers of a worker or as they were kept, a verdict."""

from dataclasses import replace

from slamlab.exercises.drives import StudentError
from slamlab.exercises.run_task import recognised
from slamlab.exercises.task import OPEN_SEED
from slamlab.grading import redaction
from slamlab.grading.evidence import GRADED, OPEN


def answer_of(client, evidence, task, call, sets):
    """What a worker answers to a call, kept as evidence.

    Parameters
    ----------
    client : WorkerClient
    evidence : Evidence
    task, call, sets : as of :meth:`Evidence.keep`

    Returns
    -------
    set's name to name to array, or to the StudentError met there

    Raises
    ------
    StudentError, WorkerStartError
    """
    try:
        answers = client.run(task, sets)
    except StudentError as error:
        evidence.keep(task, call, sets, error)
        raise
    evidence.keep(task, call, sets, answers)
    return answers


def judge_task(task, seed: bytes, answer, unredacted=False):
    """Judge one task with the inputs of a seed.

    Parameters
    ----------
    task : Task
    seed : bytes
    answer : (task, call, sets) -> answers, of a worker or as they were kept; may raise StudentError
    unredacted : bool

    Returns
    -------
    Verdict
    """

    def answered(call, seed):
        sets = task.draw(seed)
        return sets, answer(task, call, sets)

    try:
        verdict = task.judge(*answered(GRADED, seed))
        if verdict.problem and not unredacted:
            verdict = replace(verdict, problem=redaction.redact_measured(verdict.problem))
        return (
            verdict
            if verdict.full
            else recognised(task, verdict, lambda: answered(OPEN, OPEN_SEED))
        )
    except StudentError as error:
        return task.failed(error.kind, error.message)
