"""Proof of scores: the judge says the same again, from content, seed and version."""

from dataclasses import dataclass

from slamlab.exercises import catalogue
from slamlab.grading import course_digests, judge, task_judging
from slamlab.grading.evidence import KeptAnswers, NotKept
from slamlab.grading.ledger import contents
from slamlab.grading.rejudging import AT_ONCE, CallsAgain
from slamlab.grading.worker_pool import WorkerStartError


@dataclass(frozen=True)
class Proof:
    """Whether a score is proved.

    Parameters
    ----------
    record : Record
    wrong : str or None, what is not as the judge says
    lacks : str or None, the version that judged it and is not installed
    unproved : str or None, why there is nothing to prove it from
    """

    record: object
    wrong: str | None = None
    lacks: str | None = None
    unproved: str | None = None

    @property
    def proved(self):
        """Whether all of it is as the judge says."""
        return not (self.wrong or self.lacks or self.unproved)


def prove_all(book, secret=None, start=None):
    """Prove the scores of a gradebook.

    Parameters
    ----------
    book : Gradebook
    secret : bytes or None, from which seeds follow; None where it is not at hand
    start : exercise -> worker, or None; None: no code is run, outputs that were kept must do

    Yields
    ------
    Proof, of each attempt that was graded
    """
    graded = [record for record in book.attempts().values() if record.graded]
    for first in range(0, len(graded), AT_ONCE):
        some = graded[first : first + AT_ONCE]
        kept = book.contents(name for record in some for name in record.kept.values())
        yield from (prove(record, kept, secret, start) for record in some)


def prove(record, kept, secret=None, start=None):
    """Prove one score.

    Parameters
    ----------
    record : Record
    kept : dict, hash to bytes
    secret, start : as of :func:`prove_all`

    Returns
    -------
    Proof
    """
    if secret and judge.seed_for(secret, record.exercise, record.sha256).hex() != record.seed:
        return Proof(record, wrong="its seed does not follow from the secret and its content")
    for what, name in record.kept.items():
        if name not in kept or contents.name_of(kept[name]) != name:
            return Proof(record, wrong=f"its {what} are not those that were kept")
    if record.exercise not in catalogue.EXERCISES:
        return Proof(record, lacks=_version(record, "no such exercise"))
    exercise = catalogue.exercise(record.exercise)
    digests = {task.id: course_digests.task_digest(task) for task in exercise.tasks}
    if digests != record.judges:
        others = [id for id in record.judges if record.judges[id] != digests.get(id)]
        return Proof(record, lacks=_version(record, ", ".join(others) or "other tasks"))
    try:
        return _judged_again(record, exercise, kept, start)
    except NotKept as error:
        return Proof(record, unproved=str(error))
    except (contents.ContentError, WorkerStartError) as error:
        return Proof(record, wrong=str(error))


def _judged_again(record, exercise, kept, start):
    answers = KeptAnswers(kept.get(record.kept.get("outputs")), exercise)
    seed = bytes.fromhex(record.seed)
    with CallsAgain(record, exercise, kept, answers, start or _nothing_is_run) as calls:
        verdicts = exercise.verdicts(lambda task: task_judging.judge_task(task, seed, calls.answer))
    for verdict in record.verdicts:
        again = verdicts[verdict.task]
        if _earned(again) != _earned(verdict):
            said = f"{verdict.task} has {verdict.points:g} points, the judge gives {again.points:g}"
            return Proof(record, wrong=said)
    return Proof(record)


def _earned(verdict):
    laws = [(law.name, law.points, law.failed, law.tried) for law in verdict.laws]
    return verdict.points, verdict.max_points, laws


def _nothing_is_run(exercise):
    raise NotKept("its code has to be run for it (--run)")


def _version(record, what):
    versions = ", ".join(f"{name} {number}" for name, number in sorted(record.versions.items()))
    return f"{versions or 'an older version'} ({what})"
