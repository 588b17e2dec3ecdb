"""How good an estimate is: against the truth, against published relations."""

from slamlab.evaluation.relations import Relations, RelationsError, load_relations, relations_error
from slamlab.evaluation.trajectory import TrajectoryError, absolute_error, relative_error

__all__ = [
    "Relations",
    "RelationsError",
    "TrajectoryError",
    "absolute_error",
    "load_relations",
    "relations_error",
    "relative_error",
]
