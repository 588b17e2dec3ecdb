"""The mark of a submission: what the judge found, what was changed by hand, what lateness cost."""

from dataclasses import dataclass, replace

from slamlab.grading import late
from slamlab.grading.records import Record


@dataclass(frozen=True)
class Mark:
    """How many points a submission gets, and why.

    Parameters
    ----------
    record : Record
    points : task to points, changes by hand included
    by_hand : task to the reason of such a change
    late : float, points taken for lateness
    """

    record: Record
    points: dict[str, float]
    by_hand: dict[str, str]
    late: float

    @property
    def total(self):
        """Points in the end, None where nothing could be graded."""
        return sum(self.points.values()) - self.late if self.points else None

    @property
    def note(self):
        """One line: what the judge noted, what was changed, what lateness cost."""
        changed = [
            f"{task} set to {self.points[task]:g}: {why}" for task, why in self.by_hand.items()
        ]
        late = [f"{self.late:g} taken for lateness"] if self.late else []
        return "; ".join([*filter(None, [self.record.note]), *changed, *late])


def mark(record, adjustments=None, policy=late.NONE):
    """The mark of one submission.

    Points set by hand count also for what could not be graded.

    Parameters
    ----------
    record : Record
    adjustments : (submission, task) to (points, reason)
    policy : Policy

    Returns
    -------
    Mark
    """
    points = {verdict.task: verdict.points for verdict in record.verdicts}
    by_hand = {}
    for (submission, task), (value, reason) in (adjustments or {}).items():
        if submission == record.submission:
            points[task], by_hand[task] = value, reason
    if by_hand and record.exercise is None:
        record = replace(record, exercise=min(by_hand)[:2])
    taken = policy.taken(record.exercise, record.handed_in, sum(points.values()))
    return Mark(record, points, by_hand, taken)
