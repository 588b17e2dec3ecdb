"""EKF-SLAM (the MAK filter), compared with one copy of P, a textbook's dense EKF and filterpy's
EKF.

A step is one prediction and one scan of four known landmarks; P has 3 + 2N rows of float64.
"""

import sys

import numpy as np
from filterpy.kalman import ExtendedKalmanFilter

from benchmarks.common import cpu_times, main, row, speed_rows
from slamlab import models
from slamlab.filters.compressed_ekf import CompressedEKF
from slamlab.filters.data_association import nearest_neighbours
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import wrap
from slamlab.models import jacobians

TITLE = "EKF-SLAM: predict + 4 updates (CPU time, one thread, methods taking turns)"
SIZES = (50, 200, 500, 1000, 2000)
TEXTBOOK, FILTERPY = 1000, 500  # landmarks up to which they are run; both grow as N³
QUICK_FILTERPY = 200
GROWTH_FROM = 500  # below it, calls cost more than arithmetic
COMPARED = (  # besides everything with the copy: who, with whom
    ("slamlab", "textbook dense EKF"),
    ("slamlab", "filterpy EKF"),
    ("slamlab, compressed", "slamlab"),
)
REGION, REGION_STEPS = 25, 100  # compressed filter: landmarks around, steps until it moves on
Q, R = np.diag([1e-6, 1e-6, 1e-7]), np.diag([0.01, 0.001])  # process, measurement noise


def scene(N):
    """Make a test scene: a filter with N landmarks, the ids of four landmarks, and their
    observation."""
    rng = np.random.default_rng(N)
    mak = MAK([0.3, -0.2, 0.4], np.diag([0.02, 0.03, 0.01]), N)
    mak.add(range(N), np.column_stack([rng.uniform(1, 20, N), rng.uniform(-3, 3, N)]), R)
    ids = rng.choice(N, 4, replace=False).tolist()
    return mak, ids, models.h(mak.pose, mak.landmarks()[ids])


def h_and_H(x, ids):
    """Return the dense observation of four landmarks: h (8,) and H (8, n)."""
    H, z = np.zeros((2 * len(ids), len(x))), np.empty((len(ids), 2))
    for k, i in enumerate(ids):
        own = slice(3 + 2 * i, 5 + 2 * i)
        z[k] = models.h(x, x[own])
        H[2 * k : 2 * k + 2, :3] = jacobians.H_robot(x, x[own])
        H[2 * k : 2 * k + 2, own] = jacobians.H_landmark(x, x[own])
    return z.ravel(), H


def residual(z, expected):
    """Return the innovation z − h with wrapped bearings."""
    v = z - expected
    v[1::2] = wrap(v[1::2])
    return v


def dense_noise(n, m):
    """Return process noise Q of the state (n, n) and measurement noise R of the scan (2m, 2m)."""
    whole = np.zeros((n, n))
    whole[:3, :3] = Q
    return whole, np.kron(np.eye(m), R)


class Textbook:
    """A textbook's dense EKF: whole matrices, P ← (I − K H) P."""

    def __init__(self, mak, ids, z):
        self.x, self.P, self.ids, self.z = mak.x.copy(), mak.P, ids, z.ravel()
        self.Q, self.R = dense_noise(len(self.x), len(ids))

    def step(self):
        A = np.eye(len(self.x))
        P = A @ self.P @ A.T + self.Q
        h, H = h_and_H(self.x, self.ids)
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + self.R)
        self.x = self.x + K @ residual(self.z, h)
        self.P = (np.eye(len(P)) - K @ H) @ P


class Filterpy:
    """filterpy's EKF, which is not specific to landmarks."""

    def __init__(self, mak, ids, z):
        self.ids, self.z = ids, z.ravel()
        self.ekf = ExtendedKalmanFilter(len(mak.x), z.size)
        self.ekf.x, self.ekf.P = mak.x.copy(), mak.P
        self.ekf.Q, self.ekf.R = dense_noise(len(mak.x), len(ids))

    def step(self):
        self.ekf.predict()
        self.ekf.update(
            self.z,
            lambda x: h_and_H(x, self.ids)[1],
            lambda x: h_and_H(x, self.ids)[0],
            residual=residual,
        )

    @property
    def P(self):
        return self.ekf.P


def compressed_round(mak):
    """Time the compressed EKF in one region: focus, steps and global update, divided by the
    steps."""
    rng = np.random.default_rng(1)
    region = rng.choice(mak.ids, REGION, replace=False).tolist()
    z = models.h(mak.pose, mak.landmarks()[region[:4]])
    compressed = CompressedEKF(mak)

    def live():
        compressed.focus(region)
        for _ in range(REGION_STEPS):
            compressed.predict(compressed.local.pose, Q)
            compressed.update(region[:4], z, R)
        compressed.settle()

    return live


def same_first_step(mak, ids, z, peers):
    """Check that the methods' first steps agree, so that all are timed for the same work."""
    mak.predict(mak.pose, Q)
    mak.update(ids, z, R)
    for name, peer in peers.items():
        peer.step()
        np.testing.assert_allclose(peer.P, mak.P, rtol=1e-6, atol=1e-9, err_msg=name)


def times_of_size(N, quick):
    """Return {method: median CPU time} for a map of N landmarks [s]."""
    mak, ids, z = scene(N)
    peers = {}
    filterpy_to = QUICK_FILTERPY if quick else FILTERPY
    if N <= TEXTBOOK:
        peers["textbook dense EKF"] = Textbook(mak, ids, z)
    if filterpy_to >= N:
        peers["filterpy EKF"] = Filterpy(mak, ids, z)
    same_first_step(mak, ids, z, peers)
    source = mak.P
    target = np.empty_like(source)

    def step():
        mak.predict(mak.pose, Q)
        mak.update(ids, z, R)

    methods = {
        "np.copyto(P)": lambda: np.copyto(target, source),
        "slamlab": step,
        "slamlab, association of 4": lambda: nearest_neighbours(mak, z, R),
        **{name: peer.step for name, peer in peers.items()},
    }
    times = cpu_times(methods, quick)
    if N >= GROWTH_FROM:
        whole = cpu_times({"compressed": compressed_round(scene(N)[0])}, quick, 3.0)
        times["slamlab, compressed"] = whole["compressed"] / REGION_STEPS
    return times


def exponent(times, method):
    """Fit the growth exponent b of time = a Nᵇ for sizes at which arithmetic dominates."""
    sizes = [N for N in SIZES if N >= GROWTH_FROM]
    return np.polyfit(np.log(sizes), np.log([times[N][method] for N in sizes]), 1)[0]


def run(quick):
    """Make rows for all sizes, relative to one copy of P and to the peers, and for the growth."""
    times = {N: times_of_size(N, quick) for N in SIZES}
    rows = []
    for N, found in times.items():
        rows += speed_rows(f"N = {N}", found, COMPARED)
    for method in ("slamlab", "slamlab, association of 4", "slamlab, compressed"):
        b = exponent(times, method)
        rows.append(row(f"growth exponent, {method}, N = 500…2000", b, "", "N²", 2 / b))
    return rows


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.mak"))
