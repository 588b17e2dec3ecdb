"""Options (parameters) of the estimators, as plain data: listing them does not import filters."""

from dataclasses import dataclass
from math import isfinite

MAX_PARTICLES = 100_000  # of a particle filter; more take gigabytes, and minutes a step


@dataclass(frozen=True)
class Choice:
    """An option whose value is one of a few words; the first word is the default."""

    help: str
    values: tuple[str, ...]

    @property
    def range(self):
        return " or ".join(self.values)

    @property
    def default(self):
        return self.values[0]

    def parsed(self, value):
        if value not in self.values:
            raise ValueError
        return value


@dataclass(frozen=True)
class Number:
    """An option that is a number of type ``kind`` in [low, below); ``default`` is its text."""

    help: str
    low: float
    default: str
    unit: str = ""
    kind: type = float
    below: float = float("inf")

    @property
    def range(self):
        kind, most = "a number", f" to below {self.below}"
        if self.kind is int:
            kind, most = "a whole number", f" to {self.below - 1}"
        return f"{kind} from {self.low}" + most * isfinite(self.below)

    def parsed(self, value):
        """Convert a value or its text to a number. Raises ValueError if it is out of range."""
        number = float(value)
        if not self.low <= number < self.below or self.kind(number) != number:
            raise ValueError
        return self.kind(number)


OPTIONS = {
    "bounds": Choice(
        "Bounds of the errors: conservative bounds contain them with high probability",
        ("conservative", "tuned"),
    ),
    "association": Choice(
        "Data association of the corners: by a parallel EKF-SLAM, or by the filter", ("ekf", "own")
    ),
    "freeze_distance": Number(
        "Distance from the mean at which a landmark's particles freeze (0: never)",
        low=0.0,
        default="0.05",
        unit="m",
    ),
    "particles": Number(
        "Number of particles of the robot",
        low=1,
        kind=int,
        below=MAX_PARTICLES + 1,
        default="1000, of fastslam 200",
    ),
    "relocalise": Choice("Whether the robot is relocalised after its wheels slip", ("yes", "no")),
    "corrections": Choice("Corrections of the thesis' printed listing", ("none", "all")),
    "smoothing": Number(
        "Weight of the last displayed pose in the next one", low=0.0, below=1.0, default="0"
    ),
}
TAKES = {
    "mak": ("smoothing",),
    "mak-first-estimates": ("smoothing",),
    "bor": ("bounds", "association"),
    "montecarlo": ("association", "freeze_distance", "particles"),
    "fastslam": ("association", "particles"),
    "walls": ("relocalise",),
    "walls-foot-points": ("corrections",),
}
"""The options of each estimator; an estimator that is not listed has no options."""


def checked(estimator, options):
    """Parse an estimator's options {name: value}. Raises ValueError if an option is not allowed."""
    found = {}
    for name, value in options.items():
        if name not in TAKES.get(estimator, ()):
            takes = ", ".join(TAKES.get(estimator, ())) or "none"
            others = f"; use it with {' or '.join(takers(name))}" if name in OPTIONS else ""
            raise ValueError(
                f"{estimator} does not take the option {name} (it takes {takes}){others}"
            )
        try:
            found[name] = OPTIONS[name].parsed(value)
        except (ValueError, TypeError, OverflowError):
            allowed = OPTIONS[name].range
            raise ValueError(f"{name} of {estimator} must be {allowed}, not {value!r}") from None
    return found


def takers(option):
    """Return the names of the estimators that have the given option."""
    return [estimator for estimator, names in TAKES.items() if option in names]
