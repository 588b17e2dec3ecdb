"""Late policy: due dates, grace period and late penalty, from a TOML file or the course file.

grace_minutes = 10
per_day = 0.1        # share of the points earned, for each started day
at_most = 0.5
[due]
"04" = 2026-12-01T23:59:00+01:00
"""

import math
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import number, points
from classroom.grading import toml_files
from classroom.grading.local_times import local_time

HIGHEST = {"per_day": 1, "at_most": 1, "grace_minutes": 366 * 24 * 60}
"""The settings of a late penalty, each with its largest value."""


class LatePolicyError(Exception):
    """The late-policy file cannot be used; the message states why."""


@dataclass(frozen=True)
class LatePolicy:
    """The rules for the late penalty on a submission's points."""

    due: dict  # exercise to its due date, with its time zone
    per_day: float = 0.0  # share of the points earned, for each started day
    at_most: float = 1.0  # share, the largest penalty
    grace_minutes: float = 0.0  # after the due date [min]
    extensions: dict = field(default_factory=dict)  # (student, exercise) to the student's due date

    def due_for(self, exercise, student=None):
        """Return the due date; an extension to an earlier time than the due date has no effect."""
        due, extended = self.due.get(exercise), self.extensions.get((student, exercise))
        return max(due, extended) if due and extended else due or extended

    def lateness(self, exercise, handed_in, student=None):
        """Return the Lateness of a submission, or None if it is not late; ``handed_in`` is ISO 8601
        with a time zone, or None.
        """
        due = self.due_for(exercise, student)
        if due is None or handed_in is None:
            return None
        # by UTC, because Python ignores clock changes between times of one zone
        when, utc = datetime.fromisoformat(handed_in).astimezone(due.tzinfo), due.astimezone(UTC)
        if when.astimezone(UTC) - utc <= timedelta(minutes=self.grace_minutes):
            return None
        due = utc.astimezone(due.tzinfo)
        by_clock = when.replace(tzinfo=None) - due.replace(tzinfo=None)
        return Lateness(self, due, when, max(1, math.ceil(by_clock / timedelta(days=1))))

    def stored(self, student=None):
        """Return plain data to store with a mark, with extensions applied."""
        exercises = {*self.due, *(id for who, id in self.extensions if who == student)}
        due = {id: self.due_for(id, student).isoformat() for id in sorted(exercises)}
        return {"due": due} | {name: getattr(self, name) for name in HIGHEST}

    @classmethod
    def restored(cls, stored):
        due = {id: datetime.fromisoformat(when) for id, when in stored["due"].items()}
        return cls(**(stored | {"due": due}))


@dataclass(frozen=True)
class Lateness:
    """How late a submission is. Days are counted on the clock of the due date's time zone, so a day
    on which this clock changes is one day, too.
    """

    policy: LatePolicy
    due: datetime
    handed_in: datetime
    days: int  # that have started since the due date

    @property
    def share(self):
        """The share of the points earned that is subtracted."""
        return min(self.policy.at_most, self.policy.per_day * self.days)

    def sentence(self, earned):
        """State the penalty and its reasons; ``earned`` are the points before the penalty."""
        policy, days = self.policy, "1 day" if self.days == 1 else f"{self.days} days"
        grace = f" (up to {number(policy.grace_minutes)} minutes later without a penalty)"
        due, when = (local_time(t, t.tzinfo, named=True) for t in (self.due, self.handed_in))
        share, each, most = map(_percent, (self.share, policy.per_day, policy.at_most))
        return (
            f"Late penalty: {points(earned * self.share)} ({share} of {number(earned)}). Due on "
            f"{due}{grace * bool(policy.grace_minutes)}; submitted on {when}: {days} late, "
            f"as each started day counts. A day costs {each} of the points earned, all days "
            f"together at most {most}."
        )


def _percent(share):
    return f"{number(round(100 * share, 6))} %"


NO_PENALTY = LatePolicy({})


def load(path):
    settings = toml_files.read(path, LatePolicyError)
    due = settings.pop("due", None)
    if not isinstance(due, dict) or not due:
        raise LatePolicyError(
            f'{path}: there are no due dates. Add [due] and "04" = 2026-12-01T23:59:00+01:00'
        )
    for exercise, when in due.items():
        if exercise not in catalogue.EXERCISES:
            known = ", ".join(catalogue.EXERCISES)
            raise LatePolicyError(
                f"{path}: due: exercise {exercise!r} does not exist; the exercises are {known}"
            )
        if not isinstance(when, datetime) or when.tzinfo is None:
            raise LatePolicyError(
                f"{path}: due.{exercise} must be a time with its zone, such as …T23:59:00+01:00"
            )
    return LatePolicy(due, **check_penalty(settings, path))


def check_penalty(settings, path):
    """Check settings and return them. Raises LatePolicyError for an unknown name or an invalid
    value.
    """
    for name, value in settings.items():
        if name not in HIGHEST:
            raise LatePolicyError(
                f"{path}: setting {name!r} does not exist; the settings are {', '.join(HIGHEST)}"
            )
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if not is_number or not 0 <= value <= HIGHEST[name]:  # nan is not, either
            in_minutes = name == "grace_minutes"
            span = "from 0 to 527 040 minutes (one year)" if in_minutes else "a share from 0 to 1"
            raise LatePolicyError(f"{path}: {name} must be {span}, not {value!r}")
    return settings
