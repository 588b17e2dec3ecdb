"""Pose graphs, graph SLAM's back end: relative-pose measurements and optimised poses.

Read in this order:

- ``edge_error``, ``edge_jacobians``, ``edge_symbolic``: one factor, a measured relative pose, and
  the information of its error
- ``pose_graph``: PoseGraph, the nodes and edges
- ``normal_equations``, ``optimisation``: sparse Gauss-Newton; ``robust_kernel``: outlier loops
- ``marginal_covariances``: how well a pose is known; ``g2o``: files
"""

from slamlab.posegraph.optimisation import Optimum
from slamlab.posegraph.pose_graph import Edge, PoseGraph

__all__ = ["Edge", "Optimum", "PoseGraph"]
