"""Rejudging: all stored attempts by the tasks and laws that are installed now.

What did not change keeps its verdict; what did is judged from the outputs that were kept. A
notebook's code is run again only where they are not, or where it is asked in another way now.
"""

import json
from dataclasses import dataclass, replace

from slamlab.exercises import catalogue
from slamlab.grading import course_digests, gradebook_rows, isolation, judge, task_judging
from slamlab.grading.evidence import Evidence, KeptAnswers, NotKept
from slamlab.grading.ledger import chains, contents
from slamlab.grading.worker_client import WorkerClient
from slamlab.grading.worker_pool import WorkerPool, WorkerStartError

AT_ONCE = 100  # attempts whose contents are in memory


@dataclass(frozen=True)
class Rejudged:
    """An attempt before and after.

    Parameters
    ----------
    before : Record
    after : Record, the same where it could not be judged again
    ran : bool, whether its code was run
    problem : str or None, why it could not be judged again
    """

    before: object
    after: object
    ran: bool = False
    problem: str | None = None

    @property
    def changed(self):
        """Whether any verdict is another one."""
        return self.before.verdicts != self.after.verdicts


class LazyWorkers:
    """A pool of workers that is made, and its sandbox tested, when the first one is needed.

    Parameters
    ----------
    level : str, of isolation
    """

    def __init__(self, level):
        self.level, self._pool = level, None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._pool:
            self._pool.close()

    def start(self, exercise):
        """Start a worker, see :meth:`WorkerPool.start`."""
        if self._pool is None:
            isolation.ensure_level(self.level)
            self._pool = WorkerPool(self.level)
        return self._pool.start(exercise)


def rejudge_all(book, workers, exercises=None):
    """Judge the attempts of a gradebook again.

    Parameters
    ----------
    book : Gradebook
    workers : LazyWorkers or WorkerPool
    exercises : container of str or None, those that are judged; None for all

    Yields
    ------
    Rejudged, of each attempt that had been graded
    """
    graded = [r for r in book.attempts().values()
              if r.graded and (exercises is None or r.exercise in exercises)]  # fmt: skip
    for start in range(0, len(graded), AT_ONCE):
        some = graded[start : start + AT_ONCE]
        kept = book.contents(name for record in some for name in record.kept.values())
        yield from (rejudge(record, kept, workers) for record in some)


def rejudge(record, kept, workers):
    """Judge one attempt again.

    Parameters
    ----------
    record : Record, graded
    kept : dict, hash to bytes
    workers : LazyWorkers or WorkerPool

    Returns
    -------
    Rejudged
    """
    if record.exercise not in catalogue.EXERCISES:
        return Rejudged(record, record, problem=f"there is no exercise {record.exercise} any more")
    exercise = catalogue.exercise(record.exercise)
    try:
        return _rejudge(record, exercise, kept, workers)
    except (contents.ContentError, NotKept, WorkerStartError) as error:
        return Rejudged(record, record, problem=str(error))


def kept_cells(record, kept):
    """The cells of a notebook that were kept.

    Parameters
    ----------
    record : Record
    kept : dict, hash to bytes

    Returns
    -------
    list of (number, source)

    Raises
    ------
    NotKept
    """
    data = kept.get(record.kept.get("cells"))
    if data is None:
        raise NotKept("its cells were not kept: grade it again from its file, with --regrade")
    return [tuple(cell) for cell in json.loads(contents.unpacked(data))]


def _rejudge(record, exercise, kept, workers):
    known = {verdict.task: verdict for verdict in record.verdicts}
    digests = {task.id: course_digests.task_digest(task) for task in exercise.tasks}
    if digests == record.judges:
        return Rejudged(record, record)
    answers = KeptAnswers(kept.get(record.kept.get("outputs")), exercise)
    with CallsAgain(record, exercise, kept, answers, workers.start) as calls:

        def judge_one(task):
            before = known.get(task.id)
            if before and before.kind != "needs" and record.judges.get(task.id) == digests[task.id]:
                return before
            return task_judging.judge_task(task, bytes.fromhex(record.seed), calls.answer)

        verdicts = tuple(exercise.verdicts(judge_one).values())
    after = replace(
        record,
        verdicts=verdicts,
        judges=digests,
        versions=judge.versions(),
        titles={task.id: task.title for task in exercise.tasks},
    )
    if calls.ran and (data := calls.evidence.packed()):
        name = contents.name_of(data)
        after = replace(after, kept=after.kept | {"outputs": name}, isolation=workers.level)
    else:
        name = data = None
    plain = json.loads(chains.canonical(gradebook_rows.stored(after)["record"]))
    after = replace(gradebook_rows.stored_record(plain), contents={name: data} if data else {})
    return Rejudged(record, after, calls.ran)


class CallsAgain:
    """Answers as they were kept; a worker runs the notebook's code for those that were not.

    Parameters
    ----------
    record : Record
    exercise : Exercise
    kept : dict, hash to bytes
    answers : KeptAnswers
    start : exercise -> worker
    """

    def __init__(self, record, exercise, kept, answers, start):
        self._record, self._exercise, self._kept = record, exercise, kept
        self._answers, self._start, self._client = answers, start, None
        self.evidence = Evidence(exercise, answers)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        if self._client:
            self._client.__exit__(*error)

    @property
    def ran(self):
        """bool, whether code was run."""
        return self._client is not None

    def answer(self, task, call, sets):
        """The answers to a call, see :func:`task_judging.judge_task`."""
        try:
            return self._answers.answer(task, call, sets)
        except NotKept:
            if self._client is None:
                cells = kept_cells(self._record, self._kept)
                self._client = WorkerClient(self._exercise, cells, self._start)
        return task_judging.answer_of(self._client, self.evidence, task, call, sets)
