"""Evaluation: trajectory errors, consistency, wall extraction.

Read in this order:

- ``time_association``: pairs of timestamps; ``trajectory_error``: ATE and RPE
- ``text_table``: numbers in text files; ``relations``: relative ground truth
- ``trajectory_files``, ``trajectory_formats``: TUM, EuRoC, KITTI; ``planar_projection``: 3-D poses
- ``consistency``: NEES, NIS; ``pose_nees``: twist; ``correlation_matrix``; ``containment``: boxes
- ``wall_extraction_metrics``: recall and precision of line extraction
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".consistency": ["Consistency", "band", "consistency", "nees", "nis"],
        ".containment": ["inside", "outside"],
        ".correlation_matrix": ["correlation"],
        ".pose_nees": ["pose_nees", "twist"],
        ".relations": ["Relations", "RelationsError", "load_relations", "relations_error"],
        ".trajectory_error": ["TrajectoryError", "absolute_error", "relative_error"],
        ".trajectory_files": ["load_trajectory", "save_tum"],
        ".wall_extraction_metrics": ["precision_metres", "recall_metres"],
    },
)
