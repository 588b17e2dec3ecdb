"""The mark (final grade, score) of a submission: autograded points, overrides, late penalty."""

from dataclasses import dataclass, replace

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import number
from classroom.exercises.verdict_text import points as with_unit
from classroom.grading.late_policy import NO_PENALTY, Lateness, LatePolicy
from classroom.grading.records import Record
from classroom.grading.remarks import ANY, of_record


@dataclass(frozen=True)
class Mark:
    """A submission's points after overrides and late penalty."""

    record: Record
    points: dict[str, float]  # of each task, manual overrides included
    override_reasons: dict[str, str]  # of each task that has one
    decided: frozenset = frozenset()  # tasks set by hand, also those set back to the autograder's
    lateness: Lateness | None = None
    remarks: tuple[str, ...] = ()  # comments and answers that graders wrote to the student
    remarked: bool = False  # whether graders wrote or deleted remarks on this attempt
    others: tuple[str, ...] = ()  # sentences on other attempts of the student

    @property
    def late_penalty(self):
        """Points deducted by the late policy."""
        return sum(self.points.values()) * self.lateness.share if self.lateness else 0.0

    @property
    def total(self):
        """Points after the late penalty, or None if nothing could be graded."""
        return sum(self.points.values()) - self.late_penalty if self.points else None

    @property
    def overrides(self):
        """A sentence on each task whose points were set by hand, and on tasks without points."""
        set_by_hand = [
            f"{self.title(task)}: set by hand to {with_unit(self.points[task])} ({why})"
            for task, why in self.override_reasons.items()
        ]
        return [*set_by_hand, *([self.without_points] if self.without_points else [])]

    @property
    def without_points(self):
        """A sentence on the tasks of an ungraded submission that have no points, or ""."""
        known = self.record.exercise in catalogue.EXERCISES
        if self.record.graded or not self.points or not known:
            return ""
        tasks = [task.id for task in catalogue.exercise(self.record.exercise).tasks]
        missing = [self.title(task) for task in tasks if task not in self.points]
        return f"These tasks have no points and count as 0: {', '.join(missing)}" * bool(missing)

    @property
    def late(self):
        """The sentence on the late penalty, or ""."""
        earned = sum(self.points.values())
        return self.lateness.sentence(earned) if self.late_penalty else ""

    @property
    def sentences(self):
        """The feedback comment that Moodle shows, as a list of sentences."""
        record = [self.record.note] if self.record.note else []
        late = [self.late] if self.late else []
        return [*record, *self.overrides, *late, *self.others, *self.remarks]

    @property
    def note(self):
        """The feedback comment on one line."""
        return "; ".join(" ".join(text.split()).rstrip(".") for text in self.sentences)

    def title(self, task):
        """Return a task's title at grading time; if it is unknown, the installed task's title or
        the id.
        """
        if task in self.record.titles:
            return self.record.titles[task]
        try:
            return catalogue.task(task).title
        except KeyError:
            return task

    def outcome(self):
        """Return a clause on the attempt's points, or on the reason why it has none."""
        if self.total is None:
            return f"it {self.record.note}"
        if self.record.unsolved and not self.override_reasons:
            return "it contains no solution"
        most = f" of {number(self.record.max_score)}" if self.record.graded else ""
        return f"it would earn {number(round(self.total, 6))}{most} points"


def mark(record, overrides=None, policy=None, remarks=None):
    """Return the Mark of a record. ``overrides`` and ``remarks`` are those of :class:`Gradebook`.
    If ``policy`` is None, the policy stored with the record applies.
    """
    judged = {verdict.task: verdict.points for verdict in record.verdicts}
    by_hand = {}
    for (submission, sha256, task), change in (overrides or {}).items():
        mine = record.exercise in (None, task[:2])  # a file may be graded as two exercises
        if submission == record.submission and sha256 in (ANY, record.sha256) and mine:
            by_hand[task] = change
    set_points = {task: value for task, (value, _) in by_hand.items() if value is not None}
    if set_points and record.exercise is None:
        record = replace(record, exercise=min(set_points)[:2])
    if policy is None:
        policy = LatePolicy.restored(record.policy) if record.policy else NO_PENALTY
    written = of_record(remarks or {}, record)
    return Mark(
        record,
        points=judged | set_points,
        override_reasons={task: by_hand[task][1] for task in set_points},
        decided=frozenset(by_hand),
        lateness=policy.lateness(record.exercise, record.handed_in, record.student),
        remarks=tuple(text for texts in written for text in texts),
        remarked=bool(written),
    )
