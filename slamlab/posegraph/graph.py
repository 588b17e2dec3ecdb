"""Pose graphs: poses in the plane, measured motions between them, and what fits them best."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from slamlab.posegraph import marginals, scaling
from slamlab.posegraph.optimise import Problem, optimise


class Edge(NamedTuple):
    """A measured motion between two poses; see ``PoseGraph.add_edge``."""

    i: int
    j: int
    measured: np.ndarray
    information: np.ndarray
    robust: bool


class PoseGraph:
    """Poses, and edges that say how one lies as seen from another.

    ``fixed`` holds the poses that stay where they are, at first only pose 0: edges alone leave it
    open where the whole graph lies. ``edges`` is the list of what was added.
    """

    def __init__(self):
        self.fixed = {0}
        self.edges = []
        self._poses, self._count = np.empty((64, 3)), 0

    def __len__(self):
        return self._count

    @property
    def poses(self):
        """(n, 3) guesses, after ``optimise`` the best poses [m, m, rad]; may be written to."""
        return self._poses[: self._count]

    @poses.setter
    def poses(self, poses):
        poses = np.asarray(poses, dtype=float)
        if poses.shape != (self._count, 3):
            raise ValueError(f"{self._count} poses are needed, not an array {poses.shape}")
        self._poses[: self._count] = poses

    def add_pose(self, pose):
        """Add a pose.

        Parameters
        ----------
        pose : (3,) first guess [m, m, rad]

        Returns
        -------
        int, its number: 0, 1, 2 …

        Raises
        ------
        ValueError : not three finite numbers
        """
        pose = _finite(pose, (3,), "a pose is x, y and theta")
        if self._count == len(self._poses):
            self._poses = np.concatenate([self._poses, np.empty_like(self._poses)])
        self._poses[self._count] = pose
        self._count += 1
        return self._count - 1

    def add_edge(self, i, j, measured, information, robust=False):
        """Add what was measured: how pose j lies as seen from pose i.

        Parameters
        ----------
        i, j : int, poses added before
        measured : (3,) [m, m, rad]
        information : (3, 3) inverse of the measurement's covariance
        robust : bool, whether it may turn out to be false, as a loop's closure may; it is then
            weighed by dynamic covariance scaling (:mod:`slamlab.posegraph.scaling`)

        Raises
        ------
        ValueError : no such poses; not finite; the information is no inverse of a covariance
        """
        if not (0 <= i < self._count and 0 <= j < self._count and i != j):
            raise ValueError(
                f"an edge joins two poses of 0 to {self._count - 1}, not {i} with {j}: add the "
                "poses first"
            )
        measured = _finite(measured, (3,), f"edge {i} to {j}: a motion is x, y and theta")
        information = _information(information, f"edge {i} to {j}")
        self.edges.append(Edge(int(i), int(j), measured, information, bool(robust)))

    def optimise(self, max_rounds=100, phi=scaling.PHI):
        """Move the poses to where they fit the edges best: least Σ eᵀΛe, robust edges by ρ.

        Parameters
        ----------
        max_rounds : int; each solves one sparse linear system
        phi : float, Φ: the χ² up to which a robust edge counts in full [1]

        Returns
        -------
        Optimum

        Raises
        ------
        ValueError : a pose is not finite, no chain of edges ties it to a fixed one, or the edges
            together leave it open
        """
        poses, optimum = optimise(self._problem(), self.poses, max_rounds, phi)
        self.poses = poses
        return optimum

    def covariances(self, phi=scaling.PHI):
        """How well each pose is known, to be called at the optimum: the blocks of H⁻¹.

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
        return marginals.covariances(self._problem(), self.poses, phi)

    def surprise(self, i, j, measured, information, phi=scaling.PHI):
        """Squared Mahalanobis distance of measured motions that are not in the graph (yet).

        What drift explains is no surprise: a true edge has a χ² of 3 degrees of freedom. To be
        called at the optimum.

        Parameters
        ----------
        i, j : int, or (c,) int
        measured : (3,), or (c, 3) [m, m, rad]
        information : (3, 3) or (c, 3, 3)
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
        distances = marginals.surprise(self._problem(), self.poses, pairs, z, R, phi)
        return distances if np.ndim(i) else float(distances[0])

    def _problem(self):
        """The edges as arrays, checked."""
        if not np.isfinite(self.poses).all():
            bad = np.flatnonzero(~np.isfinite(self.poses).all(axis=1))
            raise ValueError(f"the guess of pose {bad[0]} is not finite")
        free = np.ones(self._count, dtype=bool)
        free[[i for i in self.fixed if i < self._count]] = False
        pairs = np.array([(edge.i, edge.j) for edge in self.edges], dtype=int).reshape(-1, 2)
        _tied(pairs, free)
        return Problem(
            pairs,
            np.array([edge.measured for edge in self.edges]).reshape(-1, 3),
            np.array([edge.information for edge in self.edges]).reshape(-1, 3, 3),
            np.array([edge.robust for edge in self.edges], dtype=bool),
            free,
        )


def _finite(numbers, shape, what):
    array = np.asarray(numbers, dtype=float)
    if array.shape != shape or not np.isfinite(array).all():
        raise ValueError(f"{what}, finite numbers, not {numbers!r}")
    return array.copy()


def _information(information, where):
    """An information matrix as the inverse of some covariance must be."""
    information = _finite(information, (3, 3), f"{where}: the information has 3 rows of 3")
    if np.abs(information - information.T).max() > 1e-6 * np.abs(information).max():
        raise ValueError(f"{where}: the information must be symmetric")
    if not np.linalg.eigvalsh(information)[0] > 0:
        raise ValueError(
            f"{where}: the information is singular or negative; where a direction was not "
            "measured, give it a little"
        )
    return information


def _tied(pairs, free):
    """Refuse poses that no chain of edges ties to a fixed one."""
    count = len(free)
    links = coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(count, count))
    _, group = connected_components(links, directed=False)
    loose = np.flatnonzero(~np.isin(group, group[~free]))
    if len(loose):
        raise ValueError(
            f"{len(loose)} of {count} poses, pose {loose[0]} first, hang on no chain of edges "
            "from a fixed pose: add the edge that is missing"
        )
