"""Rejudge all stored attempts with the currently installed tasks and laws. Changed tasks are judged
from stored outputs; code runs again only if the stored outputs do not suffice.
"""

import json
from dataclasses import dataclass, replace

from classroom.exercises import catalogue
from classroom.grading import course_digests, gradebook_rows, isolation, judge, task_judging
from classroom.grading.ledger import chains, contents
from classroom.grading.stored_answers import AnswerRecorder, NotStored, StoredAnswers
from classroom.grading.worker_client import WorkerClient
from classroom.grading.worker_pool import WorkerPool, WorkerStartError

BATCH_SIZE = 100  # attempts whose contents are in memory at a time


@dataclass(frozen=True)
class Rejudged:
    """An attempt before and after rejudging; both are equal if it could not be rejudged."""

    before: object
    after: object
    ran: bool = False  # whether its code was run
    problem: str | None = None  # why it could not be rejudged

    @property
    def changed(self):
        return self.before.verdicts != self.after.verdicts


class LazyWorkerPool:
    """A worker pool that is created and tested when the first worker is needed."""

    def __init__(self, level):
        self.level, self._pool = level, None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._pool:
            self._pool.close()

    def start(self, exercise):
        if self._pool is None:
            isolation.ensure_level(self.level)
            self._pool = WorkerPool(self.level)
        return self._pool.start(exercise)


def rejudge_all(book, workers, exercises=None):
    """Yield a Rejudged for each graded attempt of some exercises (default: all)."""
    graded = [r for r in book.attempts().values()
              if r.graded and (exercises is None or r.exercise in exercises)]  # fmt: skip
    for start in range(0, len(graded), BATCH_SIZE):
        some = graded[start : start + BATCH_SIZE]
        kept = book.contents(name for record in some for name in record.kept.values())
        yield from (rejudge(record, kept, workers) for record in some)


def rejudge(record, kept, workers):
    if record.exercise not in catalogue.EXERCISES:
        problem = f"exercise {record.exercise} no longer exists"
        return Rejudged(record, record, problem=problem)
    exercise = catalogue.exercise(record.exercise)
    try:
        return _rejudge(record, exercise, kept, workers)
    except (contents.ContentError, NotStored, WorkerStartError) as error:
        return Rejudged(record, record, problem=str(error))


def stored_cells(record, kept):
    """Return the stored cells as (number, source). Raises NotStored."""
    data = kept.get(record.kept.get("cells"))
    if data is None:
        raise NotStored("its cells are not stored; grade it again from its file with --regrade")
    return [tuple(cell) for cell in json.loads(contents.unpacked(data))]


def _rejudge(record, exercise, kept, workers):
    known = {verdict.task: verdict for verdict in record.verdicts}
    digests = {task.id: course_digests.task_digest(task) for task in exercise.tasks}
    if digests == record.judges:
        return Rejudged(record, record)
    answers = StoredAnswers(kept.get(record.kept.get("outputs")), exercise)
    with AnswerSource(record, exercise, kept, answers, workers.start) as calls:

        def judge_one(task, references):
            before, seed = known.get(task.id), bytes.fromhex(record.seed)
            names = tuple(reference.function for reference in references)
            unchanged = record.judges.get(task.id) == digests[task.id]
            if before and unchanged and before.replaced == names:
                return before
            return task_judging.judge_task(task, seed, calls.answer, references)

        verdicts = tuple(exercise.verdicts(judge_one).values())
    after = replace(
        record,
        verdicts=verdicts,
        judges=digests,
        versions=judge.versions(),
        titles={task.id: task.title for task in exercise.tasks},
    )
    if calls.ran and (data := calls.recorder.packed()):
        name = contents.name_of(data)
        after = replace(after, kept=after.kept | {"outputs": name}, isolation=workers.level)
    else:
        name = data = None
    plain = json.loads(chains.canonical(gradebook_rows.stored(after)["record"]))
    after = replace(gradebook_rows.stored_record(plain), contents={name: data} if data else {})
    return Rejudged(record, after, calls.ran)


class AnswerSource:
    """Provides stored answers, and runs the notebook's code in a worker for missing answers."""

    def __init__(self, record, exercise, kept, answers, start):
        self._record, self._exercise, self._kept = record, exercise, kept
        self._answers, self._start, self._client = answers, start, None
        self.recorder = AnswerRecorder(exercise, answers)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        if self._client:
            self._client.__exit__(*error)

    @property
    def ran(self):
        return self._client is not None

    def answer(self, task, call, sets, references=()):
        try:
            return self._answers.answer(task, call, sets, references)
        except NotStored:
            if self._client is None:
                cells = stored_cells(self._record, self._kept)
                self._client = WorkerClient(self._exercise, cells, self._start)
        return task_judging.answer_of(self._client, self.recorder, task, call, sets, references)
