"""Course file: ``course.toml`` says once what every command of a term needs to know."""

from dataclasses import dataclass, field
from datetime import date, datetime, time
from pathlib import Path
from zoneinfo import ZoneInfo

from slamlab.exercises import catalogue
from slamlab.grading import toml_files
from slamlab.grading.late_policy import LatePolicy, LatePolicyError, check_penalty
from slamlab.grading.lti import settings as lti_settings
from slamlab.grading.sandbox import LEVELS

NAME = "course.toml"
YEARS = range(1990, 2200)  # what is beyond is a slip of the keyboard
ATTEMPTS = ("last", "best")
_TEXTS = ("name", "time_zone", "roster", "results", "secret", "isolation", "attempts", "gradebook")
_PLACES = ("roster", "results", "secret")
_TABLES = ("late", "exercises", "extensions", "lti")
_OF_EXERCISE = ("due", "canvas")


class TermError(Exception):
    """Something of a term cannot be used; the text says what, and why."""


class CourseFileError(TermError):
    """The course file cannot be used; the text says why, and what may stand there."""


@dataclass(frozen=True)
class Course:
    """What a course file says.

    Parameters
    ----------
    zone : ZoneInfo, of times without a zone of their own, and of those shown
    roster : Path, the table of who is enrolled
    results : Path, the folder that everything is written to
    secret : Path, what the inputs are drawn from
    exercises : tuple of str, numbers of those that are graded, in order
    due : exercise to the time it is due, with its zone; those without are not there
    canvas : exercise to the column of its assignment in Canvas' gradebook
    extensions : (student, exercise) to the time it is due for that student
    late : the settings of the penalty, see :class:`LatePolicy`
    isolation : str, the level of the sandbox
    attempts : str, which attempt counts, one of ATTEMPTS
    gradebook : str or None, the URL of its database
    name : str, of the course
    lti : lti.settings.Settings or None, where the LMS offers its services
    """

    zone: ZoneInfo
    roster: Path
    results: Path
    secret: Path
    exercises: tuple
    due: dict
    canvas: dict
    extensions: dict = field(default_factory=dict)
    late: dict = field(default_factory=dict)
    isolation: str = "strict"
    attempts: str = "last"
    gradebook: str | None = None
    name: str = ""
    lti: lti_settings.Settings | None = None

    def policy(self, extensions=None):
        """The late policy, with the extensions of the course file and of the roster.

        Parameters
        ----------
        extensions : (student, exercise) to time, the roster's; of two the later one counts

        Returns
        -------
        LatePolicy
        """
        both = dict(extensions or {})
        for key, when in self.extensions.items():
            both[key] = max(when, both.get(key, when))
        return LatePolicy(self.due, **self.late, extensions=both)


def load(file):
    """Load a course file; places in it are seen from its folder.

    Parameters
    ----------
    file : Path

    Returns
    -------
    Course

    Raises
    ------
    CourseFileError
    """
    told = toml_files.read(file, CourseFileError)
    try:
        return _course(told, file)
    except (ValueError, LatePolicyError) as error:
        said = str(error.args[0])
        raise CourseFileError(said if said.startswith(str(file)) else f"{file}: {said}") from None


def _course(told, file):
    _refuse_unknown("", told, (*_TEXTS, *_TABLES))
    for name in _TEXTS:
        if not isinstance(told.get(name, ""), str):
            raise ValueError(f"{name} is text in quotes, not {told[name]!r}")
        if not told.get(name, "").isprintable():
            raise ValueError(f"{name} holds a character that cannot be printed: {told[name]!r}")
    for name in _PLACES:
        if told.get(name) == "":
            raise ValueError(f"{name} is the name of a file or folder, not empty")
    for name in _TABLES:
        if not isinstance(told.get(name, {}), dict):
            raise ValueError(f"{name} is a table, [{name}], not {told[name]!r}")
    zone = _zone(told.get("time_zone"))
    exercises = told.get("exercises", {})
    if not exercises:
        raise ValueError("say which exercises are graded, such as [exercises.04]")
    for id, settings in exercises.items():
        _refuse_unknown_exercise("exercises", id, catalogue.EXERCISES)
        _refuse_unknown(f"exercises.{id}.", settings, _OF_EXERCISE)
        if not isinstance(settings.get("canvas", ""), str):
            raise ValueError(f"exercises.{id}.canvas is text in quotes: Canvas' column")
    due = {id: moment(table["due"], zone, f"exercises.{id}.due")
           for id, table in sorted(exercises.items()) if "due" in table}  # fmt: skip
    extensions = {}
    for id, table in told.get("extensions", {}).items():
        _refuse_unknown_exercise("extensions", id, exercises)
        if not isinstance(table, dict):
            raise ValueError(f"extensions.{id} is a table of students, not {table!r}")
        for student, when in table.items():
            extensions[student, id] = moment(when, zone, f"extensions.{id}.{student}")
    places = {name: file.parent / told.get(name, default)
              for name, default in (("roster", "roster.csv"), ("results", "results"))}  # fmt: skip
    return Course(
        zone=zone,
        **places,
        secret=file.parent / told["secret"] if "secret" in told else places["results"] / "secret",
        exercises=tuple(sorted(exercises)),
        due=due,
        canvas={id: table["canvas"] for id, table in exercises.items() if "canvas" in table},
        extensions=extensions,
        late=check_penalty(told.get("late", {}), f"{file}: late"),
        isolation=_one_of("isolation", told.get("isolation", "strict"), LEVELS),
        attempts=_one_of("attempts", told.get("attempts", "last"), ATTEMPTS),
        gradebook=told.get("gradebook"),
        name=told.get("name", ""),
        lti=lti_settings.settings(told["lti"], file.parent) if "lti" in told else None,
    )


def moment(when, zone, name):
    """A time of TOML or text as one with a zone; a date alone lasts to the end of its day.

    Parameters
    ----------
    when : datetime, date or str such as "2026-12-01 23:59"
    zone : ZoneInfo, of times that tell none
    name : str, for the error

    Returns
    -------
    datetime

    Raises
    ------
    ValueError : it is no time
    """
    try:
        if isinstance(when, str):
            text = when.strip()
            when = date.fromisoformat(text) if len(text) == 10 else datetime.fromisoformat(text)
        if type(when) is date:
            when = datetime.combine(when, time(23, 59, 59))
        if not isinstance(when, datetime) or when.year not in YEARS:
            raise ValueError
        return when if when.tzinfo else when.replace(tzinfo=zone)
    except ValueError:
        raise ValueError(
            f"{name} is a time such as 2026-12-01T23:59:00 or 2026-12-01, not {_shown(when)}"
        ) from None


def _shown(value):
    return str(value) if isinstance(value, date) else repr(value)


def _zone(name):
    if not name:
        raise ValueError('say the time zone of the course, such as time_zone = "Europe/Zagreb"')
    try:
        return ZoneInfo(name)
    except (ValueError, OSError, KeyError):  # ZoneInfoNotFoundError is a KeyError
        raise ValueError(f"there is no time zone {name!r}; one is Europe/Zagreb") from None


def _one_of(name, value, allowed):
    if value not in allowed:
        raise ValueError(f"{name} is {' or '.join(allowed)}, not {value!r}")
    return value


def _refuse_unknown(path, table, allowed):
    if not isinstance(table, dict):
        raise ValueError(f"{path.rstrip('.')} is a table, not {table!r}")
    for name in table:
        if name not in allowed:
            raise ValueError(f"there is no setting {path}{name}; there are {', '.join(allowed)}")


def _refuse_unknown_exercise(table, id, known):
    if id not in known:
        raise ValueError(f"{table}: no exercise {id!r}; there are {', '.join(known)}")
