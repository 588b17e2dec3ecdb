"""Pose graphs, the back end of graph SLAM.

Read in this order:

- ``edge_error``, ``edge_jacobians``, ``edge_symbolic``: residual of one edge (factor)
- ``pose_graph``: nodes and edges
- ``normal_equations``; ``optimisation``: sparse Gauss-Newton, Levenberg-Marquardt
- ``outlier_rejection``: rejects false loops, with ``outlier_search`` and ``spanning_tree``;
  ``robust_kernels``
- ``marginal_covariances``: marginal covariance of each pose
- ``g2o``: g2o files, with ``g2o_parser`` and ``graph_builder``
- ``rotation_first``: initial poses from edges; ``gauge``: gauge freedom, fixed nodes
"""

from slamlab.posegraph.optimisation import Optimum
from slamlab.posegraph.pose_graph import Edge, PoseGraph

__all__ = ["Edge", "Optimum", "PoseGraph"]
