"""Evaluation: trajectory errors, consistency, wall extraction.

Read in this order:

- ``time_association``: pairs of timestamps; ``trajectory_error``: ATE and RPE
- ``text_table``: numbers in text files; ``relations``: relative ground truth
- ``trajectory_files``, ``trajectory_formats``: TUM, EuRoC, KITTI; ``planar_projection``: 3-D poses
- ``consistency``: NEES, NIS; ``pose_nees``: twist; ``correlation_matrix``; ``containment``: boxes
- ``wall_extraction_metrics``: recall and precision of line extraction
"""

from slamlab.evaluation.consistency import Consistency, band, consistency, nees, nis
from slamlab.evaluation.containment import inside, outside
from slamlab.evaluation.correlation_matrix import correlation
from slamlab.evaluation.pose_nees import pose_nees, twist
from slamlab.evaluation.relations import Relations, RelationsError, load_relations, relations_error
from slamlab.evaluation.trajectory_error import TrajectoryError, absolute_error, relative_error
from slamlab.evaluation.trajectory_files import load_trajectory, save_tum
from slamlab.evaluation.wall_extraction_metrics import precision_metres, recall_metres

__all__ = ["Consistency", "Relations", "RelationsError", "TrajectoryError", "absolute_error"]
__all__ += ["band", "consistency", "correlation", "inside", "load_relations", "load_trajectory"]
__all__ += ["nees", "nis", "outside", "pose_nees", "precision_metres", "recall_metres"]
__all__ += ["relations_error", "relative_error", "save_tum", "twist"]
