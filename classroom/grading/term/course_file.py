"""Course file ``course.toml``: the settings of a term for all commands."""

from dataclasses import dataclass, field
from datetime import UTC, date, datetime, time
from pathlib import Path
from zoneinfo import ZoneInfo

from classroom.exercises import catalogue
from classroom.grading import toml_files
from classroom.grading.late_policy import LatePolicy, LatePolicyError, check_penalty
from classroom.grading.lti import settings as lti_settings
from classroom.grading.sandbox import LEVELS

NAME = "course.toml"
YEARS = range(1990, 2200)  # other years are typing errors
ATTEMPTS = ("last", "best")
HINTS = ("in steps", "at once")
_TEXTS = ("name", "time_zone", "roster", "results", "secret", "isolation", "attempts", "gradebook",
          "hints")  # fmt: skip
_PATHS = ("roster", "results", "secret")
_TABLES = ("late", "exercises", "extensions", "lti")
_OF_EXERCISE = ("due", "canvas")


class TermError(Exception):
    """A part of a term cannot be used; the message states which part, and why."""


class CourseFileError(TermError):
    """The course file cannot be used; the message states why, and what is allowed."""


@dataclass(frozen=True)
class Course:
    """The settings in a course file."""

    zone: ZoneInfo  # of times without a zone, and of shown times
    roster: Path  # the table of enrolled students
    results: Path  # the folder of all output
    secret: Path  # from which inputs are drawn
    exercises: tuple  # numbers of the graded exercises, in order
    due: dict  # exercise to its due date with a zone, if it has one
    canvas: dict  # exercise to the column of its assignment in Canvas' gradebook
    extensions: dict = field(default_factory=dict)  # (student, exercise) to the due date
    late: dict = field(default_factory=dict)  # settings of the late penalty
    isolation: str = "strict"  # the sandbox's level
    attempts: str = "last"  # which attempt counts, one of ATTEMPTS
    hints: str = "in steps"  # one of HINTS; used in a student's course folder
    gradebook: str | None = None  # the URL of its database
    name: str = ""
    lti: lti_settings.Settings | None = None

    def policy(self, extensions=None):
        """Return the late policy with the extensions in the course file and the roster; the later
        of two extensions counts.
        """
        both = dict(extensions or {})
        for key, when in self.extensions.items():
            both[key] = max(when, both.get(key, when))
        return LatePolicy(self.due, **self.late, extensions=both)

    def warnings(self, policy):
        """List due dates that the clock skips or shows twice, and extensions without effect."""
        found = [clock_warning(when, f"due date of exercise {id}") for id, when in self.due.items()]
        for (student, id), when in policy.extensions.items():
            name, due = f"extension of {student} in exercise {id}", policy.due_for(id, student)
            found.append(clock_warning(when, name))
            if due != when:
                times = f"{when:%Y-%m-%d %H:%M} is before the due date {due:%Y-%m-%d %H:%M}"
                found.append(f"{name}: {times}, so it has no effect")
        return tuple(filter(None, found))


def load(file):
    """Read a course file. Raises CourseFileError."""
    settings = toml_files.read(file, CourseFileError)
    try:
        return _course(settings, file)
    except (ValueError, LatePolicyError) as error:
        text = str(error.args[0])
        raise CourseFileError(text if text.startswith(str(file)) else f"{file}: {text}") from None


def _course(settings, file):
    _refuse_unknown("", settings, (*_TEXTS, *_TABLES))
    for name in _TEXTS:
        if not isinstance(settings.get(name, ""), str):
            raise ValueError(f"{name} must be text in quotes, not {settings[name]!r}")
        if not settings.get(name, "").isprintable():
            raise ValueError(f"{name} contains an unprintable character: {settings[name]!r}")
    for name in _PATHS:
        if settings.get(name) == "":
            raise ValueError(f"{name} must be the name of a file or folder, not empty")
    for name in _TABLES:
        if not isinstance(settings.get(name, {}), dict):
            raise ValueError(f"{name} must be a table, [{name}], not {settings[name]!r}")
    zone = _zone(settings.get("time_zone"))
    exercises = settings.get("exercises", {})
    if not exercises:
        raise ValueError("list the graded exercises, such as [exercises.04]")
    for id, table in exercises.items():
        _refuse_unknown_exercise("exercises", id, catalogue.EXERCISES)
        _refuse_unknown(f"exercises.{id}.", table, _OF_EXERCISE)
        if not isinstance(table.get("canvas", ""), str):
            raise ValueError(f"exercises.{id}.canvas must be a Canvas column's title in quotes")
    due = {id: parse_time(table["due"], zone, f"exercises.{id}.due")
           for id, table in sorted(exercises.items()) if "due" in table}  # fmt: skip
    extensions = {}
    for id, table in settings.get("extensions", {}).items():
        _refuse_unknown_exercise("extensions", id, exercises)
        if not isinstance(table, dict):
            raise ValueError(f"extensions.{id} must be a table of students, not {table!r}")
        for student, when in table.items():
            extensions[student, id] = parse_time(when, zone, f"extensions.{id}.{student}")
    folder = file.parent
    paths = {name: folder / settings.get(name, default)
             for name, default in (("roster", "roster.csv"), ("results", "results"))}  # fmt: skip
    paths["secret"] = (
        folder / settings["secret"] if "secret" in settings else paths["results"] / "secret"
    )
    return Course(
        zone=zone,
        **paths,
        exercises=tuple(sorted(exercises)),
        due=due,
        canvas={id: table["canvas"] for id, table in exercises.items() if "canvas" in table},
        extensions=extensions,
        late=check_penalty(settings.get("late", {}), f"{file}: late"),
        isolation=_one_of("isolation", settings.get("isolation", "strict"), LEVELS),
        attempts=_one_of("attempts", settings.get("attempts", "last"), ATTEMPTS),
        hints=_one_of("hints", settings.get("hints", "in steps"), HINTS),
        gradebook=settings.get("gradebook"),
        name=settings.get("name", ""),
        lti=lti_settings.settings(settings["lti"], folder) if "lti" in settings else None,
    )


def parse_time(when, zone, name):
    """Parse a time with a zone, from TOML or text; a date without a time means the end of that day.
    Raises ValueError.
    """
    try:
        if isinstance(when, str):
            text = when.strip()
            when = date.fromisoformat(text) if len(text) == 10 else datetime.fromisoformat(text)
        if type(when) is date:
            when = datetime.combine(when, time(23, 59, 59))
        if not isinstance(when, datetime) or when.year not in YEARS:
            raise ValueError
        if when.tzinfo:
            return when.astimezone(zone)
        # a clock may show the time twice or not at all: the later reading counts
        return max((when.replace(tzinfo=zone, fold=k) for k in (0, 1)), key=datetime.timestamp)
    except ValueError:
        raise ValueError(
            f"{name} must be a time such as 2026-12-01T23:59:00 or 2026-12-01, not {_shown(when)}"
        ) from None


def clock_warning(when, name):
    """Return a warning if the clock skips a time or shows it twice, or ""."""
    real = when.astimezone(UTC).astimezone(when.tzinfo)
    if real.replace(tzinfo=None) != when.replace(tzinfo=None):
        return f"{name}: the clock skips {when:%Y-%m-%d %H:%M}; {real:%H:%M} counts"
    if when.fold:
        return f"{name}: the clock shows {when:%Y-%m-%d %H:%M} twice; the later time counts"
    return ""


def _shown(value):
    return str(value) if isinstance(value, date) else repr(value)


def _zone(name):
    if not name:
        raise ValueError('the time zone is missing; set it, as in time_zone = "Europe/Zagreb"')
    try:
        return ZoneInfo(name)
    except (ValueError, OSError, KeyError):  # ZoneInfoNotFoundError is a KeyError
        raise ValueError(
            f"time zone {name!r} does not exist; a valid one is Europe/Zagreb"
        ) from None


def _one_of(name, value, allowed):
    if value not in allowed:
        raise ValueError(f"{name} must be {' or '.join(allowed)}, not {value!r}")
    return value


def _refuse_unknown(path, table, allowed):
    if not isinstance(table, dict):
        raise ValueError(f"{path.rstrip('.')} must be a table, not {table!r}")
    for name in table:
        if name not in allowed:
            raise ValueError(
                f"setting {path}{name} does not exist; the settings are {', '.join(allowed)}"
            )


def _refuse_unknown_exercise(table, id, known):
    if id not in known:
        raise ValueError(
            f"{table}: exercise {id!r} does not exist; the exercises are {', '.join(known)}"
        )
