"""Options of estimators by name: what each takes, and which values it may have.

Plain data, so that a command line can list them without importing a filter.
"""

from dataclasses import dataclass
from math import isfinite

MAX_SAMPLES = 100_000  # of a particle filter; more take gigabytes, and minutes a step


@dataclass(frozen=True)
class Choice:
    """An option that is one of several words.

    Parameters
    ----------
    help : str, what it says
    values : tuple of str, the first is the default
    """

    help: str
    values: tuple[str, ...]

    @property
    def range(self):
        """str, which values it may have."""
        return " or ".join(self.values)

    def parsed(self, value):
        """The word; ValueError where it is another one."""
        if value not in self.values:
            raise ValueError
        return value


@dataclass(frozen=True)
class Number:
    """An option that is a number.

    Parameters
    ----------
    help : str, what it says
    low : float, the least it may be
    kind : type, int for a whole number
    below : float, what it has to stay below; of a whole number it is one too many
    """

    help: str
    low: float
    kind: type = float
    below: float = float("inf")

    @property
    def range(self):
        """str, which values it may have."""
        kind, most = "a number", f" to below {self.below}"
        if self.kind is int:
            kind, most = "a whole number", f" to {self.below - 1}"
        return f"{kind} from {self.low}" + most * isfinite(self.below)

    def parsed(self, value):
        """The number, of a text too; ValueError where it is none or out of range."""
        number = float(value)
        if not self.low <= number < self.below or self.kind(number) != number:
            raise ValueError
        return self.kind(number)


OPTIONS = {
    "bounds": Choice(
        "bounds of boxes: honest ones hold but for a chance, tuned ones are chosen by results",
        ("honest", "tuned"),
    ),
    "names": Choice(
        "who names the corners of scans: EKF-SLAM run beside, or the filter its own",
        ("mak", "own"),
    ),
    "close": Number(
        "metres from their mean within which all samples of a landmark lie when it is frozen to "
        "a point; 0 for never (0.05)",
        low=0.0,
    ),
    "samples": Number(
        "samples of the robot (montecarlo 1000, fastslam 200)",
        low=1,
        kind=int,
        below=MAX_SAMPLES + 1,
    ),
    "relocalise": Choice("whether a robot whose wheels slipped is looked for", ("yes", "no")),
    "mends": Choice("mends of the listing: as it is printed, or with all of them", ("none", "all")),
    "smoothing": Number("share of the last shown pose that the next keeps (0)", low=0.0, below=1.0),
}
TAKES = {
    "mak": ("smoothing",),
    "mak-first-estimates": ("smoothing",),
    "bor": ("bounds", "names"),
    "montecarlo": ("names", "close", "samples"),
    "fastslam": ("names", "samples"),
    "walls": ("relocalise",),
    "walls-foot": ("mends",),
}
"""The options of each estimator; of those that are not here, none."""


def checked(estimator, options):
    """Check the options of an estimator, numbers given as text included.

    Parameters
    ----------
    estimator : str, its name
    options : {str: value}

    Returns
    -------
    {str: value}, words and numbers

    Raises
    ------
    ValueError : one that it does not take, or a value that is none of its values
    """
    found = {}
    for name, value in options.items():
        if name not in TAKES.get(estimator, ()):
            takes = ", ".join(TAKES.get(estimator, ())) or "none"
            who = f"; {' and '.join(takers(name))} would" if name in OPTIONS else ""
            raise ValueError(f"{estimator} does not take the option {name} (it takes {takes}){who}")
        try:
            found[name] = OPTIONS[name].parsed(value)
        except (ValueError, TypeError, OverflowError):
            allowed = OPTIONS[name].range
            raise ValueError(f"{name} of {estimator} is {allowed}, not {value!r}") from None
    return found


def takers(option):
    """List of the estimators that take an option."""
    return [estimator for estimator, names in TAKES.items() if option in names]
