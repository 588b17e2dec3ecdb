"""What lateness costs, by a small file that the course writes.

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


class WrongPolicy(Exception):
    """The file cannot be used; the text says why."""


@dataclass(frozen=True)
class Policy:
    """What is taken from the points of a submission that came late.

    Parameters
    ----------
    due : exercise to the time it is due, with its zone
    per_day : float, share of the points earned, for every day begun
    at_most : float, share
    grace_minutes : float
    """

    due: dict
    per_day: float = 0.0
    at_most: float = 1.0
    grace_minutes: float = 0.0

    def taken(self, exercise, handed_in, points):
        """Points taken.

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


NONE = Policy({})


def load(path):
    """A policy from its file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Policy

    Raises
    ------
    WrongPolicy
    """
    try:
        told = tomllib.loads(path.read_text("utf-8"))
    except OSError as error:
        raise WrongPolicy(f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise WrongPolicy(f"{path}: {error}") from None
    due = told.pop("due", None)
    if not isinstance(due, dict) or not due:
        raise WrongPolicy(
            f'{path}: say when what is due: [due] and "04" = 2026-12-01T23:59:00+01:00'
        )
    for exercise, when in due.items():
        if not isinstance(when, datetime) or when.tzinfo is None:
            raise WrongPolicy(
                f"{path}: due.{exercise} is a time with its zone, such as …T23:59:00+01:00"
            )
    for name, value in told.items():
        if name not in ("per_day", "at_most", "grace_minutes"):
            raise WrongPolicy(f"{path}: there is no setting {name!r}")
        most = math.inf if name == "grace_minutes" else 1
        if not isinstance(value, int | float) or isinstance(value, bool) or not 0 <= value <= most:
            range = "not negative" if name == "grace_minutes" else "a share from 0 to 1"
            raise WrongPolicy(f"{path}: {name} is {range}, not {value!r}")
    return Policy(due, **told)
