"""Verdict on a task: the results of its laws, the points, the diagnosis and its hint."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class LawResult:
    """The result of one law (test); ``failed`` of ``tried`` inputs broke it.

    ``where`` names the sets of inputs that broke it, each with the exception met there, or None.
    """

    name: str
    says: str
    points: float
    max_points: float
    failed: int
    tried: int
    where: Mapping[str, str | None] = field(default_factory=dict)


@dataclass(frozen=True)
class Verdict:
    """The verdict (result) on one task.

    Parameters
    ----------
    task : str, the task's id
    points, max_points : float
    laws : results of the laws, empty when nothing could be judged
    diagnosis, hint : str or None, the mistake recognised
    problem : str or None, why nothing could be judged, in words for the student
    kind : str or None, the kind of that problem
    case : str or None, the smallest input on which a law fails, told in a notebook only
    """

    task: str
    points: float
    max_points: float
    laws: tuple[LawResult, ...] = ()
    diagnosis: str | None = None
    hint: str | None = None
    problem: str | None = None
    kind: str | None = None
    case: str | None = None

    @property
    def full(self):
        """Whether the task is passed: every point was earned."""
        return self.problem is None and all(law.failed == 0 for law in self.laws)

    @property
    def solved(self):
        """Whether tasks that need this one can be judged: its answers are right."""
        return self.problem is None and all(
            law.failed == 0 for law in self.laws if law.name != "unchanged"
        )
