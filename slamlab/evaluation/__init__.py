"""How good an estimate is: against the truth, against published relations, against its own P."""

from slamlab.evaluation.consistency import Consistency, band, consistency, nees, nis
from slamlab.evaluation.correlation import correlation
from slamlab.evaluation.relations import Relations, RelationsError, load_relations, relations_error
from slamlab.evaluation.trajectory import TrajectoryError, absolute_error, relative_error
from slamlab.evaluation.tum import load_tum, save_tum
from slamlab.evaluation.walls import precision_metres, recall_metres

__all__ = [
    "Consistency",
    "Relations",
    "RelationsError",
    "TrajectoryError",
    "absolute_error",
    "band",
    "consistency",
    "correlation",
    "load_relations",
    "load_tum",
    "nees",
    "nis",
    "precision_metres",
    "recall_metres",
    "relations_error",
    "relative_error",
    "save_tum",
]
