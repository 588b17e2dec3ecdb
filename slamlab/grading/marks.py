"""The mark (grade) of a submission: the judge's points, manual overrides, late penalty."""

from dataclasses import dataclass, replace

from slamlab.grading.late_policy import NO_PENALTY, LatePolicy
from slamlab.grading.records import Record


@dataclass(frozen=True)
class Mark:
    """The mark of a submission: its points after overrides and late penalty, and why.

    Parameters
    ----------
    record : Record
    points : task to points, manual overrides included
    override_reasons : task to the reason of its override
    late_penalty : float, points deducted by the late policy
    remarks : tuple of str, what somebody wrote to the student by hand
    """

    record: Record
    points: dict[str, float]
    override_reasons: dict[str, str]
    late_penalty: float
    remarks: tuple[str, ...] = ()

    @property
    def total(self):
        """Total points after the late penalty, None where nothing could be graded."""
        return sum(self.points.values()) - self.late_penalty if self.points else None

    @property
    def note(self):
        """One line: the judge's note, the overrides, the late penalty, the remarks."""
        changed = [
            f"{task} set to {self.points[task]:g}: {why}"
            for task, why in self.override_reasons.items()
        ]
        late = [f"{self.late_penalty:g} taken for lateness"] if self.late_penalty else []
        said = [" ".join(remark.split()) for remark in self.remarks]
        return "; ".join([*filter(None, [self.record.note]), *changed, *late, *said])


def mark(record, overrides=None, policy=None, remarks=None):
    """Compute the mark of one submission from record, overrides and late policy.

    Points set by hand count also for what could not be graded.

    Parameters
    ----------
    record : Record
    overrides : (submission, task) to (points, reason)
    policy : LatePolicy or None, for the one that was stored with the record
    remarks : submission to tuple of str, see :mod:`slamlab.grading.remarks`

    Returns
    -------
    Mark
    """
    points = {verdict.task: verdict.points for verdict in record.verdicts}
    override_reasons = {}
    for (submission, task), (value, reason) in (overrides or {}).items():
        mine = record.exercise in (None, task[:2])  # it may be another exercise's, handed in twice
        if submission == record.submission and mine:
            points[task], override_reasons[task] = value, reason
    if override_reasons and record.exercise is None:
        record = replace(record, exercise=min(override_reasons)[:2])
    if policy is None:
        policy = LatePolicy.restored(record.policy) if record.policy else NO_PENALTY
    earned = sum(points.values())
    taken = policy.penalty(record.exercise, record.handed_in, earned, record.student)
    told = (remarks or {}).get(record.submission, ())
    return Mark(record, points, override_reasons, taken, told)
