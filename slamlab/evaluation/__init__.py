"""Evaluation: trajectory errors (ATE, RPE, relations), consistency (NEES, NIS), wall extraction.

Read in this order:

- ``trajectory_error``: ATE and RPE; ``relations``: where no full ground truth is known
- ``consistency``: NEES, NIS, χ² band; ``pose_nees``: of poses, along arcs
- ``correlation_matrix``: a covariance free of units
- ``wall_extraction``: recall and precision; ``tum_files``: trajectories as files
"""

from slamlab.evaluation.consistency import Consistency, band, consistency, nees, nis
from slamlab.evaluation.correlation_matrix import correlation
from slamlab.evaluation.pose_nees import pose_nees, twist
from slamlab.evaluation.relations import Relations, RelationsError, load_relations, relations_error
from slamlab.evaluation.trajectory_error import TrajectoryError, absolute_error, relative_error
from slamlab.evaluation.tum_files import load_tum, save_tum
from slamlab.evaluation.wall_extraction import precision_metres, recall_metres

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
    "pose_nees",
    "precision_metres",
    "recall_metres",
    "relations_error",
    "relative_error",
    "save_tum",
    "twist",
]
