"""The verdict on a task: results of its laws, points, recognised mistake and hint."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace


@dataclass(frozen=True)
class LawResult:
    """The result of one law: ``failed`` of ``tried`` inputs break the law."""

    name: str
    says: str
    points: float
    max_points: float
    failed: int
    tried: int
    where: Mapping[str, str | None] = field(default_factory=dict)  # sets: exception or None


@dataclass(frozen=True)
class Verdict:
    """The verdict (result) on one task."""

    task: str
    points: float
    max_points: float
    laws: tuple[LawResult, ...] = ()  # empty if nothing could be judged
    diagnosis: str | None = None  # name of the recognised mistake
    hint: str | None = None
    problem: str | None = None  # why nothing could be judged, a message for the student
    kind: str | None = None  # of that problem
    replaced: tuple[str, ...] = ()  # wrong functions of earlier tasks that right ones replaced
    question: str | None = None  # about a recognised mistake, or ""; in a notebook only
    case: str | None = None  # text of the smallest failing case; in a notebook only

    @property
    def full(self):
        return self.problem is None and all(law.failed == 0 for law in self.laws)

    def explained_by(self, mistake):
        """Return the verdict with a recognised mistake, its hint and its question."""
        named = {"diagnosis": mistake.name, "hint": mistake.hint}
        return replace(self, **named, question=mistake.asks)

    @property
    def carried(self):
        """State which functions were replaced, or "" if the task was not tried with any."""
        if not self.replaced or self.kind == "not attempted":
            return ""
        names = " and ".join(f"{name}()" for name in self.replaced)
        return f"tried with {'a ' * (len(self.replaced) == 1)}correct {names} in place of yours"
