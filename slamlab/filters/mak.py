"""MAK, the map-augmented Kalman filter: EKF-SLAM with every correlation kept (MAK thesis, 4.3).

State [x_r p_1 … p_N]. Lesson 06 builds the textbook form; this one does the same on one triangle
of P in place: a scan of m landmarks costs one symmetric update of rank 2m.
"""

import numpy as np
from scipy.linalg.blas import dgemm, dtrsm
from scipy.linalg.lapack import dpotrf

from slamlab import jacobians, models
from slamlab.filters.step import Step, covariance, vector
from slamlab.filters.triangle import Triangle
from slamlab.geometry import wrap


class MAK:
    """A robot and the landmarks it has seen, in one Gaussian.

    Parameters
    ----------
    x : (3,) pose at the start [m, m, rad]
    P : (3, 3) its covariance
    capacity : int, landmarks to allocate memory for; more may come
    first_estimates : bool, take every Jacobian at the first estimate of what it is taken at
        (Huang, Mourikis, Roumeliotis 2010), which keeps the filter from gaining false certainty
    drop_cross_terms_for_demonstration : bool, throw the correlations away after each step;
        the filter is then wrong, which is what lesson 07 shows

    Raises
    ------
    ValueError
    """

    def __init__(
        self, x, P, capacity=100, *, first_estimates=False, drop_cross_terms_for_demonstration=False
    ):
        self.first_estimates = first_estimates
        self.drop_cross_terms = drop_cross_terms_for_demonstration
        self._P = Triangle(covariance("P", P, 3), 3 + 2 * capacity)
        self._x = np.empty(3 + 2 * capacity)
        self._x[:3] = vector("x", x, 3)
        self._predicted = self._x[:2].copy()
        self._first = np.empty((0, 2))
        self._row: dict[int, int] = {}

    @property
    def x(self):
        """(3 + 2N,) pose, then landmarks in the order of :attr:`ids`."""
        return self._x[: self._P.n]

    @property
    def pose(self):
        """(3,) [m, m, rad], a copy."""
        return self._x[:3].copy()

    @property
    def P(self):
        """(3 + 2N, 3 + 2N) the covariance, a copy with both triangles."""
        return self._P.full()

    @property
    def ids(self):
        """The landmarks' ids, in the order of the state."""
        return list(self._row)

    def landmarks(self):
        """(N, 2) the landmarks' means [m], a copy."""
        return self.x[3:].reshape(-1, 2).copy()

    def rows(self, ids):
        """Where landmarks stand in x and P.

        Parameters
        ----------
        ids : (m,) ids

        Returns
        -------
        (2m,) int

        Raises
        ------
        ValueError : an id that is not in the map, or one twice
        """
        ids = self._distinct(ids)
        unknown = [i for i in ids if i not in self._row]
        if unknown:
            raise ValueError(f"ids: {unknown} are not in the map; add them first")
        first = np.array([self._row[i] for i in ids], dtype=int)
        return (first[:, None] + np.arange(2)).ravel()

    def predict(self, x, Q):
        """Move: only the robot's rows and columns change.

        P_rr ← A P_rr Aᵀ + Q,  P_ri ← A P_ri, where A = [[1, 0, −Δy], [0, 1, Δx], [0, 0, 1]] for
        every motion that is driven in the robot's own frame, Δ being its displacement.

        Parameters
        ----------
        x : (3,) the new pose f(pose, u) [m, m, rad]
        Q : (3, 3) covariance of the motion

        Returns
        -------
        (3, 3) A

        Raises
        ------
        ValueError
        """
        x, Q = vector("x", x, 3), covariance("Q", Q, 3)
        start = self._predicted if self.first_estimates else self._x[:2]
        A = np.eye(3)
        A[0, 2], A[1, 2] = start[1] - x[1], x[0] - start[0]
        L = self._P.lower
        P_rr = np.tril(L[:3, :3]) + np.tril(L[:3, :3], -1).T
        L[:3, :3] = A @ P_rr @ A.T + Q
        L[3:, :3] = L[3:, :3] @ A.T
        self._x[:3] = x[0], x[1], wrap(x[2])
        self._predicted = x[:2].copy()
        return A

    def update(self, ids, z, R):
        """See landmarks again, all of one scan at once.

        P ← P − K S Kᵀ with K = P Hᵀ S⁻¹, as P − B Bᵀ with B = P Hᵀ L⁻ᵀ and S = L Lᵀ.

        Parameters
        ----------
        ids : (m,) which
        z : (m, 2) range [m], bearing [rad]
        R : (2, 2) of each, or (m, 2, 2)

        Returns
        -------
        Step

        Raises
        ------
        ValueError : nothing was changed
        """
        rows = self.rows(ids)
        m = len(rows) // 2
        z, R = _observations(z, R, m)
        v, H, index = self._linearise(rows, z)
        PHt = dgemm(1.0, self._P.columns(index), H, trans_b=1)
        S = H @ PHt[index]
        S.reshape(m, 2, m, 2)[np.arange(m), :, np.arange(m)] += R
        root, failed = dpotrf(S, lower=1, clean=1)
        if failed:
            raise ValueError("R: S = H P Hᵀ + R is singular; give R a positive variance")
        B = dtrsm(1.0, root, PHt, side=1, lower=1, trans_a=1, overwrite_b=1)
        self._x[: self._P.n] += B @ dtrsm(1.0, root, v[:, None], lower=1)[:, 0]
        self._x[2] = wrap(self._x[2])
        self._P.subtract(B)
        self._forget_cross_terms()
        return Step(v, S, root, B, H, index)

    def add(self, ids, z, R):
        """See landmarks for the first time: the state grows (Smolec (16), (17)).

        P_nn = J_xr P_rr J_xrᵀ + J_z R J_zᵀ,  P_n· = J_xr P_r·

        Parameters
        ----------
        ids : (k,) new ids
        z : (k, 2) range [m], bearing [rad]
        R : (2, 2) of each, or (k, 2, 2)

        Raises
        ------
        ValueError : an id that is in the map already; nothing was changed
        """
        ids = self._distinct(ids)
        known = [i for i in ids if i in self._row]
        if known:
            raise ValueError(f"ids: {known} are in the map already; update them instead")
        z, R = _observations(z, R, len(ids))
        n, k = self._P.n, 2 * len(ids)
        J_xr = jacobians.J_xr(self._x[:3], z).reshape(k, 3)
        J_z = jacobians.J_z(self._x[:3], z)
        cross = J_xr @ self._P.columns([0, 1, 2]).T
        corner = cross[:, :3] @ J_xr.T
        m = np.arange(len(ids))
        corner.reshape(len(ids), 2, len(ids), 2)[m, :, m] += J_z @ R @ J_z.transpose(0, 2, 1)
        self._P.append(cross, corner)
        if n + k > len(self._x):
            self._x = np.concatenate([self._x, np.empty(n + k)])
        p = models.g(self._x[:3], z)
        self._x[n : n + k] = p.ravel()
        self._first = np.vstack([self._first, p])
        self._row.update({i: n + 2 * j for j, i in enumerate(ids)})
        self._forget_cross_terms()

    def remove(self, ids):
        """Drop landmarks; nobody else's mean or covariance changes.

        Parameters
        ----------
        ids : (k,) which

        Raises
        ------
        ValueError
        """
        rows = self.rows(ids)
        x = np.delete(self.x, rows)
        self._x[: len(x)] = x
        self._first = np.delete(self._first, (rows[::2] - 3) // 2, axis=0)
        self._P.delete(rows)
        left = [i for i in self._row if i not in set(ids)]
        self._row = {i: 3 + 2 * j for j, i in enumerate(left)}

    def block(self, rows):
        """(k, k) the covariance of some rows of the state, such as those of :meth:`rows`."""
        return self._P.block(np.asarray(rows))

    def part(self, ids):
        """The robot and some of its landmarks, as a filter of their own.

        Parameters
        ----------
        ids : (k,) which

        Returns
        -------
        MAK

        Raises
        ------
        ValueError
        """
        rows = np.concatenate([[0, 1, 2], self.rows(ids)])
        part = MAK(self.pose, np.eye(3), 0, first_estimates=self.first_estimates)
        part._x, part._P = self._x[rows], Triangle(self.block(rows))
        part._predicted = self._predicted.copy()
        part._first = self._first[(rows[3::2] - 3) // 2]
        part._row = {i: 3 + 2 * k for k, i in enumerate(ids)}
        return part

    def settle(self, rows, part, phi, psi, theta):
        """Take back a part that went on alone, and bring the rest up to date.

        P_AB ← φ P_AB,  P_BB ← P_BB − P_BA ψ P_AB,  x_B ← x_B + P_BA θ (see CompressedMAK)

        Parameters
        ----------
        rows : (k,) the part's rows in this filter
        part : MAK of size k
        phi, psi : (k, k)
        theta : (k,)
        """
        rest = np.setdiff1d(np.arange(self._P.n), rows)
        P_A = self._P.columns(rows)
        self._x[rest] += P_A[rest] @ theta
        self._x[rows] = part.x
        values, vectors = np.linalg.eigh(psi)
        self._P.subtract(np.asfortranarray(P_A @ (vectors * np.sqrt(np.maximum(values, 0)))))
        self._P.put(rows, P_A @ phi.T, part.P)
        self._predicted = part._predicted.copy()

    def _linearise(self, rows, z):
        """Innovation (2m,), H over the columns it touches (2m, 3 + 2m), and those columns."""
        m = len(z)
        p = self._x[rows].reshape(m, 2)
        v = z - models.h(self._x[:3], p)
        v[:, 1] = wrap(v[:, 1])
        if self.first_estimates:
            p = self._first[(rows[::2] - 3) // 2]
        H_r = jacobians.H_robot(self._x[:3], p)
        H = np.zeros((m, 2, 3 + 2 * m))
        H[:, :, :3] = H_r
        blocks = H[:, :, 3:].reshape(m, 2, m, 2)
        blocks[np.arange(m), :, np.arange(m)] = -H_r[:, :, :2]
        index = np.concatenate([[0, 1, 2], rows])
        return v.ravel(), H.reshape(2 * m, -1), index

    def _forget_cross_terms(self):
        if self.drop_cross_terms:
            L = self._P.lower
            L[3:, :3] = 0
            own = np.repeat(np.arange((self._P.n - 3) // 2), 2)
            L[3:, 3:][own[:, None] != own] = 0

    def _distinct(self, ids):
        ids = list(ids)
        twice = sorted({i for i in ids if ids.count(i) > 1}) if len(set(ids)) < len(ids) else []
        if twice:
            raise ValueError(f"ids: {twice} stand more than once in one scan")
        return ids


def _observations(z, R, m):
    """z as (m, 2) and R as (m, 2, 2), checked."""
    z, R = np.asarray(z, dtype=float), np.asarray(R, dtype=float)
    if z.shape != (m, 2):
        raise ValueError(f"z has shape {z.shape}, expected ({m}, 2): a row for each id")
    if R.shape not in ((2, 2), (m, 2, 2)):
        raise ValueError(f"R has shape {R.shape}, expected (2, 2) or ({m}, 2, 2)")
    if not (np.isfinite(z).all() and np.isfinite(R).all()):
        raise ValueError("z or R holds NaN or infinity")
    if (z[:, 0] <= 0).any():
        raise ValueError("z: a range is not positive")
    a, b, c, d = R[..., 0, 0], R[..., 0, 1], R[..., 1, 0], R[..., 1, 1]
    if (b != c).any() or (a < 0).any() or (d < 0).any() or (a * d < b * c).any():
        raise ValueError("R is no covariance: it must be symmetric and positive semidefinite")
    return z, np.broadcast_to(R, (m, 2, 2))
