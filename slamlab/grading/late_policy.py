"""Late policy: due dates, grace period and late penalty, from a small TOML file or the course's.

grace_minutes = 10
per_day = 0.1        # of the points earned, for every day begun
at_most = 0.5

[due]
"04" = 2026-12-01T23:59:00+01:00
"""

import math
from dataclasses import dataclass, field
from datetime import datetime, timedelta

from slamlab.exercises import catalogue
from slamlab.grading import toml_files

HIGHEST = {"per_day": 1, "at_most": 1, "grace_minutes": 366 * 24 * 60}
"""The settings of a penalty, and the most that each may be."""


class LatePolicyError(Exception):
    """The late policy's file cannot be used; the text says why."""


@dataclass(frozen=True)
class LatePolicy:
    """A late policy: the penalty on the points of a late submission.

    Parameters
    ----------
    due : exercise to the time it is due, with its zone
    per_day : float, share of the points earned, for every day begun
    at_most : float, share, the largest penalty
    grace_minutes : float, grace period after the due date [min]
    extensions : (student, exercise) to the time it is due for that student
    """

    due: dict
    per_day: float = 0.0
    at_most: float = 1.0
    grace_minutes: float = 0.0
    extensions: dict = field(default_factory=dict)

    def due_for(self, exercise, student=None):
        """When an exercise is due for a student; None where it never is."""
        return self.extensions.get((student, exercise), self.due.get(exercise))

    def penalty(self, exercise, handed_in, points, student=None):
        """The late penalty of a submission, in points.

        Parameters
        ----------
        exercise : str
        handed_in : str or None, the time in ISO's form with its zone
        points : float, earned
        student : str or None, whose extensions count

        Returns
        -------
        float
        """
        due = self.due_for(exercise, student)
        if due is None or handed_in is None:
            return 0.0
        late = datetime.fromisoformat(handed_in) - due
        if late <= timedelta(minutes=self.grace_minutes):
            return 0.0
        days = math.ceil(late / timedelta(days=1))
        return points * min(self.at_most, self.per_day * days)

    def stored(self, student=None):
        """The policy as it is stored with a student's mark: plain data, extensions applied."""
        exercises = {*self.due, *(id for who, id in self.extensions if who == student)}
        due = {id: self.due_for(id, student).isoformat() for id in sorted(exercises)}
        return {"due": due} | {name: getattr(self, name) for name in HIGHEST}

    @classmethod
    def restored(cls, stored):
        """The policy that :meth:`stored` made plain."""
        due = {id: datetime.fromisoformat(when) for id, when in stored["due"].items()}
        return cls(**(stored | {"due": due}))


NO_PENALTY = LatePolicy({})


def load(path):
    """Load a late policy from its TOML file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    LatePolicy

    Raises
    ------
    LatePolicyError
    """
    told = toml_files.read(path, LatePolicyError)
    due = told.pop("due", None)
    if not isinstance(due, dict) or not due:
        raise LatePolicyError(
            f'{path}: say when what is due: [due] and "04" = 2026-12-01T23:59:00+01:00'
        )
    for exercise, when in due.items():
        if exercise not in catalogue.EXERCISES:
            known = ", ".join(catalogue.EXERCISES)
            raise LatePolicyError(f"{path}: due: no exercise {exercise!r}; there are {known}")
        if not isinstance(when, datetime) or when.tzinfo is None:
            raise LatePolicyError(
                f"{path}: due.{exercise} is a time with its zone, such as …T23:59:00+01:00"
            )
    return LatePolicy(due, **check_penalty(told, path))


def check_penalty(told, path):
    """Check the settings of a penalty, read from a file.

    Parameters
    ----------
    told : dict, name to value
    path : Path, for the error

    Returns
    -------
    dict, the same

    Raises
    ------
    LatePolicyError : there is no such setting, or it has no such value
    """
    for name, value in told.items():
        if name not in HIGHEST:
            raise LatePolicyError(
                f"{path}: there is no setting {name!r}; there are {', '.join(HIGHEST)}"
            )
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if not is_number or not 0 <= value <= HIGHEST[name]:  # nan is not, either
            a_year = name == "grace_minutes"
            span = "from 0 to a year's minutes, 527 040" if a_year else "a share from 0 to 1"
            raise LatePolicyError(f"{path}: {name} is {span}, not {value!r}")
    return told
