"""Pose graph: keyframe poses and landmarks as nodes, relative measurements as edges (factors)."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from slamlab.posegraph import marginal_covariances
from slamlab.posegraph.optimisation import NO_KERNEL, STEP_TOLERANCE, LeastSquaresProblem, optimise
from slamlab.posegraph.outlier_rejection import reject_outliers
from slamlab.posegraph.robust_kernels import PHI, Truncated
from slamlab.posegraph.rotation_first import initial_poses, place_landmarks

WORLD = -1  # number of the world frame, the first node of a prior


class Edge(NamedTuple):
    """Edge (factor) of a pose graph: a measured relative pose; see ``PoseGraph.add_edge``.

    i is ``WORLD`` for a prior. For a position (landmark, prior), the third entry of ``measured``
    and the third row and column of ``information`` are zero, because the heading was not measured.
    """

    i: int
    j: int
    measured: np.ndarray
    information: np.ndarray
    robust: bool


class PoseGraph:
    """Pose graph: nodes are poses, edges are measured relative poses (odometry and loop closures).

    ``poses`` (n, 3) are the first nodes. ``fixed`` is the set of fixed nodes, initially
    pose 0, which fixes the gauge (gauge freedom). ``landmarks`` are the nodes without heading.
    """

    def __init__(self, poses=()):
        self.fixed = {0}
        self.landmarks = set()
        self.edges, self.dropped = [], set()  # dropped: numbers of the rejected edges
        self._poses = np.array(poses, dtype=float).reshape(-1, 3)
        self._count = len(self._poses)

    def __len__(self):
        return self._count

    @property
    def poses(self):
        """Poses (n, 3) [m, m, rad], writable: initial guesses; after ``optimise``, the optimum.

        The row of a landmark contains its position and 0.
        """
        return self._poses[: self._count]

    @poses.setter
    def poses(self, poses):
        poses = np.asarray(poses, dtype=float)
        if poses.shape != (self._count, 3):
            raise ValueError(f"expected {self._count} poses (n, 3), not shape {poses.shape}")
        self._poses[: self._count] = poses

    def add_pose(self, pose):
        """Add a pose (node) with a guess (3,) [m, m, rad]; return its number. Raises ValueError."""
        pose = _check_finite(pose, (3,), "a pose must be x, y and theta")
        if self._count == len(self._poses):
            self._poses = np.concatenate([self._poses, np.empty((max(64, self._count), 3))])
        self._poses[self._count] = pose
        self._count += 1
        return self._count - 1

    def add_landmark(self, position):
        """Add a landmark (node) with a guess (2,) [m]; return its number. Raises ValueError."""
        number = self.add_pose([*_check_finite(position, (2,), "a landmark must be x and y"), 0.0])
        self.landmarks.add(number)
        return number

    def add_edge(self, i, j, measured, information, robust=False):
        """Add an edge (factor): the measured relative pose (3,) [m, m, rad] of j relative to i.

        information : information matrix (3, 3) of the residual, in the frame at the end of
        ``measured`` as in g2o, see ``edge_error.information``; robust : whether it may be an
        outlier. For a landmark j, measured is (2,) and information (2, 2). Raises ValueError.
        """
        if not (0 <= i < self._count and 0 <= j < self._count and i != j):
            raise ValueError(
                f"an edge must connect two of the poses 0 to {self._count - 1}, not {i} and {j}: "
                "add the poses first"
            )
        where = f"edge {i} to {j}"
        if i in self.landmarks:
            raise ValueError(f"{where}: an edge must lead from a pose to a landmark")
        size = 2 if j in self.landmarks else 3
        self._append(where, i, j, size, measured, information, robust)

    def add_prior(self, i, measured, information, robust=False):
        """Add a prior on node i: its measured pose (3,) in the world frame, or position (2,).

        information : like that of ``add_edge``; zeros for components that were not measured. Raises
        ValueError.
        """
        where = f"prior on {i}"
        if not 0 <= i < self._count:
            raise ValueError(f"{where}: the graph has only the poses 0 to {self._count - 1}")
        size = 2 if i in self.landmarks or np.size(measured) == 2 else 3
        self._append(where, WORLD, i, size, measured, information, robust)

    def _append(self, where, i, j, size, measured, information, robust):
        what = ["a position must be x and y", "a relative pose must be x, y and theta"][size - 2]
        z, whole = np.zeros(3), np.zeros((3, 3))
        z[:size] = _check_finite(measured, (size,), f"{where}: {what}")
        whole[:size, :size] = _check_information(information, size, where, partial=i == WORLD)
        self.edges.append(Edge(int(i), int(j), z, whole, bool(robust)))

    def initialise(self):
        """Set the poses to the guess of two linear problems, headings first, from the edges without
        robust kernel, unless the present poses have a lower cost. Return whether they were set.

        Every pose must be connected to a fixed pose by such edges. Raises ValueError.
        """
        problem, numbers = self._problem(), np.arange(self._count)
        landmark = np.isin(numbers, list(self.landmarks))
        pairs = problem.pairs
        used = (pairs[:, 0] != WORLD) & ~landmark[pairs[:, 1]] & ~problem.robust
        _check_connected(pairs[used], ~(np.isin(numbers, list(self.fixed)) | landmark))
        roots = {i: self.poses[i] for i in self.fixed - self.landmarks}
        edges = pairs[used], problem.measured[used], problem.information[used]
        poses = initial_poses(self._count, *edges, roots)
        place_landmarks(poses, pairs, problem.measured, landmark)
        before, after = (
            np.where(problem.robust, Truncated().cost(chi2), chi2).sum()
            for chi2 in (problem.errors(guess)[1] for guess in (self.poses, poses))
        )
        if after < before:
            self.poses = poses
        return bool(after < before)

    def optimise(self, max_iterations=100, phi=PHI, tolerance=STEP_TOLERANCE, kernel=None):
        """Optimise the poses by nonlinear least squares, Σ eᵀΛe; returns an Optimum.

        Robust edges that contradict the others are rejected: their cost is ``phi`` (truncated least
        squares, several starts), and ``dropped`` contains their numbers. With a ``kernel`` of
        ``robust_kernels``, only the local minimum near the present poses is found. tolerance :
        squared length of the last step, in standard deviations. Raises ValueError if a pose is not
        finite or not connected.
        """
        problem, settings = self._problem(), (max_iterations, tolerance)
        if kernel is not None or not problem.robust.any():
            self.dropped, kernel = set(), kernel or NO_KERNEL
            self.poses, optimum = optimise(problem, self.poses, *settings, kernel)
            return optimum
        before = np.isin(np.arange(len(self.edges)), list(self.dropped))
        fixed = np.array([i for i in self.fixed if i < self._count], dtype=int)
        found = reject_outliers(problem, self.poses, fixed, before, phi, settings)
        self.poses, optimum = found
        self.dropped = set(np.flatnonzero(optimum.weights == 0).tolist())
        return optimum

    def covariances(self, nodes=None):
        """Return marginal covariances (n, 3, 3) at the optimum, 0 for fixed nodes; if ``nodes`` is
        given, only of these nodes.

        The third row and column of a landmark are 0. Raises ValueError.
        """
        nodes = np.arange(self._count) if nodes is None else np.asarray(nodes, dtype=int)
        return marginal_covariances.covariances(self._accepted(), self.poses, nodes)

    def squared_mahalanobis(self, i, j, measured, information):
        """Return squared Mahalanobis distances of loop-closure candidates (edges), at the optimum.

        True edges give χ² with 3 degrees of freedom. Arguments: as in ``add_edge``, or arrays (c,).
        """
        pairs = np.column_stack(np.broadcast_arrays(np.atleast_1d(i), np.atleast_1d(j)))
        z = np.broadcast_to(np.asarray(measured, dtype=float), (len(pairs), 3))
        R = np.linalg.inv(np.asarray(information, dtype=float))
        at = self._accepted(), self.poses, pairs
        distances = marginal_covariances.squared_mahalanobis(*at, z, R)
        return distances if np.ndim(i) else float(distances[0])

    def _accepted(self):
        return self._problem().select(~np.isin(np.arange(len(self.edges)), list(self.dropped)))

    def _problem(self):
        if not np.isfinite(self.poses).all():
            bad = np.flatnonzero(~np.isfinite(self.poses).all(axis=1))
            raise ValueError(f"the guess of pose {bad[0]} is not finite")
        free = np.ones((self._count, 3), dtype=bool)
        free[[i for i in self.fixed if i < self._count]] = False
        pairs = np.array([(edge.i, edge.j) for edge in self.edges], dtype=int).reshape(-1, 2)
        _check_connected(pairs, free[:, 0])
        free[list(self.landmarks), 2] = False
        return LeastSquaresProblem(
            pairs,
            np.array([edge.measured for edge in self.edges]).reshape(-1, 3),
            np.array([edge.information for edge in self.edges]).reshape(-1, 3, 3),
            np.array([edge.robust for edge in self.edges], dtype=bool),
            free,
        )


def smallest_eigenvalues(information):
    """Return least eigenvalues of symmetric matrices (m, k, k), divided by the largest entries."""
    scale = np.abs(information).max(axis=(1, 2), initial=0)
    scaled = information / np.where(scale > 0, scale, 1)[:, None, None]
    return np.linalg.eigvalsh(scaled)[:, 0]


def components(pairs, count):
    """Number the connected components; return one number per node, then the world frame's."""
    pairs = pairs % (count + 1)
    links = coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(count + 1,) * 2)
    return connected_components(links, directed=False)[1]


def _check_finite(numbers, shape, what):
    array = np.asarray(numbers, dtype=float)
    if array.shape != shape or not np.isfinite(array).all():
        raise ValueError(f"{what}, all finite, not {numbers!r}")
    return array.copy()


def _check_information(information, size, where, partial):
    what = f"{where}: the information must have {size} rows of {size} numbers"
    information = _check_finite(information, (size, size), what)
    if np.abs(information - information.T).max() > 1e-6 * np.abs(information).max():
        raise ValueError(f"{where}: the information must be symmetric")
    least = smallest_eigenvalues(information[None])[0]
    if not (least > 0 or (partial and least > -1e-9 and information.any())):
        raise ValueError(
            f"{where}: the information is singular or negative; if a direction was not measured "
            "(degenerate), give it a small information"
        )
    return information


def _check_connected(pairs, free):
    group = components(pairs, len(free))
    loose = np.flatnonzero(~np.isin(group[:-1], group[np.append(~free, True)]))
    if len(loose):
        raise ValueError(
            f"{len(loose)} of {len(free)} poses are not connected to a fixed pose by edges (first: "
            f"pose {loose[0]}): add the missing edge"
        )
