"""Verify scores: the judge must reproduce the scores from the same content, seed and version."""

from dataclasses import dataclass

from classroom.exercises import catalogue
from classroom.grading import course_digests, judge, task_judging
from classroom.grading.ledger import contents
from classroom.grading.rejudging import BATCH_SIZE, AnswerSource
from classroom.grading.stored_answers import NotStored, StoredAnswers
from classroom.grading.worker_pool import WorkerStartError


@dataclass(frozen=True)
class ScoreVerification:
    """The result of verifying a score."""

    record: object
    wrong: str | None = None  # how it differs from the judge's result
    lacks: str | None = None  # the version that judged it and is not installed
    unverified: str | None = None  # why it cannot be verified

    @property
    def verified(self):
        return not (self.wrong or self.lacks or self.unverified)


def verify_all(book, secret=None, start=None):
    """Yield a ScoreVerification of each graded attempt. Student code runs only if ``start``, a
    function from exercise to worker, is given.
    """
    graded = [record for record in book.attempts().values() if record.graded]
    for first in range(0, len(graded), BATCH_SIZE):
        some = graded[first : first + BATCH_SIZE]
        kept = book.contents(name for record in some for name in record.kept.values())
        yield from (verify(record, kept, secret, start) for record in some)


def verify(record, kept, secret=None, start=None):
    if secret and judge.seed_for(secret, record.exercise, record.sha256).hex() != record.seed:
        return ScoreVerification(record, wrong="its seed does not match its content and the secret")
    for what, name in record.kept.items():
        if name not in kept or contents.name_of(kept[name]) != name:
            return ScoreVerification(record, wrong=f"its stored {what} are missing or altered")
    if record.exercise not in catalogue.EXERCISES:
        return ScoreVerification(record, lacks=_version(record, "no such exercise"))
    exercise = catalogue.exercise(record.exercise)
    digests = {task.id: course_digests.task_digest(task) for task in exercise.tasks}
    if digests != record.judges:
        others = [id for id in record.judges if record.judges[id] != digests.get(id)]
        return ScoreVerification(record, lacks=_version(record, ", ".join(others) or "other tasks"))
    try:
        return _judged_again(record, exercise, kept, start)
    except NotStored as error:
        return ScoreVerification(record, unverified=str(error))
    except (contents.ContentError, WorkerStartError) as error:
        return ScoreVerification(record, wrong=str(error))


def _judged_again(record, exercise, kept, start):
    answers = StoredAnswers(kept.get(record.kept.get("outputs")), exercise)
    seed = bytes.fromhex(record.seed)
    with AnswerSource(record, exercise, kept, answers, start or _refuse_to_run) as calls:
        verdicts = exercise.verdicts(
            lambda task, references: task_judging.judge_task(task, seed, calls.answer, references)
        )
    for verdict in record.verdicts:
        again = verdicts[verdict.task]
        if _earned(again) != _earned(verdict):
            wrong = (
                f"{verdict.task} has {verdict.points:g} points; the judge gives {again.points:g}"
            )
            return ScoreVerification(record, wrong=wrong)
    return ScoreVerification(record)


def _earned(verdict):
    laws = [(law.name, law.points, law.failed, law.tried) for law in verdict.laws]
    return verdict.points, verdict.max_points, laws


def _refuse_to_run(exercise):
    raise NotStored("its outputs are not stored; use --run to run its code")


def _version(record, what):
    versions = ", ".join(f"{name} {number}" for name, number in sorted(record.versions.items()))
    return f"{versions or 'an older version'} ({what})"
