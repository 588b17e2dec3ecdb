"""Judge one task: draw inputs from a seed, get a worker's or stored answers, give a verdict."""

from dataclasses import replace

from classroom.exercises.function_calls import StudentError
from classroom.exercises.references import ReferenceCalls
from classroom.exercises.run_task import add_mistake_and_hint
from classroom.exercises.task import OPEN_SEED
from classroom.grading import redaction
from classroom.grading.stored_answers import GRADED, OPEN


def answer_of(client, recorder, task, call, sets, references):
    """Return a worker's answers and record them (see :meth:`AnswerRecorder.keep`). Raises
    StudentError or WorkerStartError.
    """
    calls = ReferenceCalls(references)
    try:
        answers = client.run(task, sets, calls)
    except StudentError as error:
        recorder.keep(task, call, sets, error, calls)
        raise
    recorder.keep(task, call, sets, answers, calls)
    return answers


def judge_task(task, seed: bytes, answer, references=(), unredacted=False):
    """Return the Verdict on a task. ``answer(task, call, sets, references)`` must return answers,
    of a worker or stored, or raise StudentError. ``references`` replace functions of earlier tasks.
    """

    def answered(call, seed):
        sets = task.draw_inputs(seed)
        return sets, answer(task, call, sets, references)

    try:
        verdict = task.judge(*answered(GRADED, seed))
        if verdict.problem and not unredacted:
            verdict = replace(verdict, problem=redaction.redact_measured(verdict.problem))
        if verdict.full:
            return verdict
        verdict = add_mistake_and_hint(task, verdict, lambda: answered(OPEN, OPEN_SEED))
        return replace(verdict, question=None)
    except StudentError as error:
        return task.failed(error.kind, error.message)
