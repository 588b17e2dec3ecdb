"""Pose graph: keyframe poses as nodes, relative-pose measurements as edges (factors)."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from slamlab.posegraph import marginal_covariances, robust_kernel
from slamlab.posegraph.optimisation import STEP_TOLERANCE, Problem, optimise


class Edge(NamedTuple):
    """Edge (factor) of a pose graph: a measured relative pose; see ``PoseGraph.add_edge``."""

    i: int
    j: int
    measured: np.ndarray
    information: np.ndarray
    robust: bool


class PoseGraph:
    """Pose graph: nodes are poses, edges measured relative poses (odometry and loop closures).

    ``fixed`` holds the poses that stay where they are, at first only pose 0: edges alone leave it
    open where the whole graph lies (gauge freedom). ``edges`` is the list of what was added.
    """

    def __init__(self):
        self.fixed = {0}
        self.edges = []
        self._poses, self._count = np.empty((64, 3)), 0

    def __len__(self):
        return self._count

    @property
    def poses(self):
        """Poses (n, 3): initial guesses, after ``optimise`` the best [m, m, rad]; writable."""
        return self._poses[: self._count]

    @poses.setter
    def poses(self, poses):
        poses = np.asarray(poses, dtype=float)
        if poses.shape != (self._count, 3):
            raise ValueError(f"{self._count} poses are needed, not an array {poses.shape}")
        self._poses[: self._count] = poses

    def add_pose(self, pose):
        """Add a pose (node).

        Parameters
        ----------
        pose : (3,) initial guess [m, m, rad]

        Returns
        -------
        int, its number: 0, 1, 2 …

        Raises
        ------
        ValueError : not three finite numbers
        """
        pose = _check_finite(pose, (3,), "a pose is x, y and theta")
        if self._count == len(self._poses):
            self._poses = np.concatenate([self._poses, np.empty_like(self._poses)])
        self._poses[self._count] = pose
        self._count += 1
        return self._count - 1

    def add_edge(self, i, j, measured, information, robust=False):
        """Add an edge (factor): the measured relative pose of j as seen from i.

        Parameters
        ----------
        i, j : int, poses added before
        measured : (3,) [m, m, rad]
        information : (3, 3) information matrix of the residual e, in the frame that ``measured``
            leads to (as in GTSAM and g2o); ``edge_error.information`` makes it of the covariance
            of ``measured``, which is in the frame of pose i
        robust : bool, whether it may be an outlier, as a loop closure may; it is then
            weighed by dynamic covariance scaling (:mod:`slamlab.posegraph.robust_kernel`)

        Raises
        ------
        ValueError : no such poses; not finite; the information is no inverse of a covariance
        """
        if not (0 <= i < self._count and 0 <= j < self._count and i != j):
            raise ValueError(
                f"an edge joins two poses of 0 to {self._count - 1}, not {i} with {j}: add the "
                "poses first"
            )
        where = f"edge {i} to {j}"
        measured = _check_finite(measured, (3,), f"{where}: a relative pose is x, y and theta")
        information = _check_information(information, where)
        self.edges.append(Edge(int(i), int(j), measured, information, bool(robust)))

    def optimise(self, max_rounds=100, phi=robust_kernel.PHI, tolerance=STEP_TOLERANCE):
        """Optimise the poses (nonlinear least squares): least Σ eᵀΛe, robust edges by ρ.

        Parameters
        ----------
        max_rounds : int; each solves one sparse linear system
        phi : float, Φ: the χ² up to which a robust edge counts in full [1]
        tolerance : float, a step ends it whose squared length in standard deviations is less [1]

        Returns
        -------
        Optimum

        Raises
        ------
        ValueError : a pose is not finite, no chain of edges ties it to a fixed one, or the edges
            together leave it open
        """
        poses, optimum = optimise(self._problem(), self.poses, max_rounds, phi, tolerance)
        self.poses = poses
        return optimum

    def covariances(self, phi=robust_kernel.PHI):
        """Marginal covariance of each pose, to be called at the optimum: the blocks of H⁻¹.

        Parameters
        ----------
        phi : float, as for ``optimise``

        Returns
        -------
        (n, 3, 3) of x, y and theta [m, m, rad], zero for a fixed pose

        Raises
        ------
        ValueError : as ``optimise``
        """
        return marginal_covariances.covariances(self._problem(), self.poses, phi)

    def squared_mahalanobis(self, i, j, measured, information, phi=robust_kernel.PHI):
        """Squared Mahalanobis distance of candidate edges (loop closures): chi-square (χ²) test.

        Drift is accounted for: a true edge has a χ² of 3 degrees of freedom. To be called at the
        optimum.

        Parameters
        ----------
        i, j : int, or (c,) int
        measured : (3,), or (c, 3) [m, m, rad]
        information : (3, 3) or (c, 3, 3) of the residual, as for ``add_edge``
        phi : float, as for ``optimise``

        Returns
        -------
        float or (c,) [1]

        Raises
        ------
        ValueError : as ``optimise``
        """
        pairs = np.column_stack(np.broadcast_arrays(np.atleast_1d(i), np.atleast_1d(j)))
        z = np.broadcast_to(np.asarray(measured, dtype=float), (len(pairs), 3))
        R = np.linalg.inv(np.asarray(information, dtype=float))
        at = self._problem(), self.poses, pairs
        distances = marginal_covariances.squared_mahalanobis(*at, z, R, phi)
        return distances if np.ndim(i) else float(distances[0])

    surprise = squared_mahalanobis  # name in the first edition

    def _problem(self):
        """Least-squares problem of the edges, checked."""
        if not np.isfinite(self.poses).all():
            bad = np.flatnonzero(~np.isfinite(self.poses).all(axis=1))
            raise ValueError(f"the guess of pose {bad[0]} is not finite")
        free = np.ones(self._count, dtype=bool)
        free[[i for i in self.fixed if i < self._count]] = False
        pairs = np.array([(edge.i, edge.j) for edge in self.edges], dtype=int).reshape(-1, 2)
        _check_connected(pairs, free)
        return Problem(
            pairs,
            np.array([edge.measured for edge in self.edges]).reshape(-1, 3),
            np.array([edge.information for edge in self.edges]).reshape(-1, 3, 3),
            np.array([edge.robust for edge in self.edges], dtype=bool),
            free,
        )


def _check_finite(numbers, shape, what):
    array = np.asarray(numbers, dtype=float)
    if array.shape != shape or not np.isfinite(array).all():
        raise ValueError(f"{what}, finite numbers, not {numbers!r}")
    return array.copy()


def _check_information(information, where):
    """Check an information matrix: symmetric and positive definite."""
    information = _check_finite(information, (3, 3), f"{where}: the information has 3 rows of 3")
    if np.abs(information - information.T).max() > 1e-6 * np.abs(information).max():
        raise ValueError(f"{where}: the information must be symmetric")
    if not np.linalg.eigvalsh(information)[0] > 0:
        raise ValueError(
            f"{where}: the information is singular or negative; where a direction was not "
            "measured (degenerate), give it a little"
        )
    return information


def _check_connected(pairs, free):
    """Check that every pose is connected to a fixed one by edges."""
    count = len(free)
    links = coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(count, count))
    _, group = connected_components(links, directed=False)
    loose = np.flatnonzero(~np.isin(group, group[~free]))
    if len(loose):
        raise ValueError(
            f"{len(loose)} of {count} poses, pose {loose[0]} first, are not connected to a "
            "fixed pose by any chain of edges: add the missing edge"
        )
