"""Late policy: due dates, grace period and late penalty, from a small TOML file of the course.

grace_minutes = 10
per_day = 0.1        # of the points earned, for every day begun
at_most = 0.5

[due]
"04" = 2026-12-01T23:59:00+01:00
"""

import math
import tomllib
from dataclasses import dataclass
from datetime import datetime, timedelta


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
    """

    due: dict
    per_day: float = 0.0
    at_most: float = 1.0
    grace_minutes: float = 0.0

    def penalty(self, exercise, handed_in, points):
        """The late penalty of a submission, in points.

        Parameters
        ----------
        exercise : str
        handed_in : str or None, the time in ISO's form with its zone
        points : float, earned

        Returns
        -------
        float
        """
        if exercise not in self.due or handed_in is None:
            return 0.0
        late = datetime.fromisoformat(handed_in) - self.due[exercise]
        if late <= timedelta(minutes=self.grace_minutes):
            return 0.0
        days = math.ceil(late / timedelta(days=1))
        return points * min(self.at_most, self.per_day * days)


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
    try:
        told = tomllib.loads(path.read_text("utf-8"))
    except OSError as error:
        raise LatePolicyError(f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise LatePolicyError(f"{path}: {error}") from None
    due = told.pop("due", None)
    if not isinstance(due, dict) or not due:
        raise LatePolicyError(
            f'{path}: say when what is due: [due] and "04" = 2026-12-01T23:59:00+01:00'
        )
    for exercise, when in due.items():
        if not isinstance(when, datetime) or when.tzinfo is None:
            raise LatePolicyError(
                f"{path}: due.{exercise} is a time with its zone, such as …T23:59:00+01:00"
            )
    for name, value in told.items():
        if name not in ("per_day", "at_most", "grace_minutes"):
            raise LatePolicyError(f"{path}: there is no setting {name!r}")
        most = math.inf if name == "grace_minutes" else 1
        if not isinstance(value, int | float) or isinstance(value, bool) or not 0 <= value <= most:
            range = "not negative" if name == "grace_minutes" else "a share from 0 to 1"
            raise LatePolicyError(f"{path}: {name} is {range}, not {value!r}")
    return LatePolicy(due, **told)
