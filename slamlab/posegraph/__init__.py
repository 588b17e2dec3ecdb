"""Pose graphs: measured motions between poses, loops included, and the poses that fit best."""

from slamlab.posegraph.graph import Edge, PoseGraph
from slamlab.posegraph.optimise import Optimum

__all__ = ["Edge", "Optimum", "PoseGraph"]
