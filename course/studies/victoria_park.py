"""``python -m course.studies.victoria_park``: EKF-SLAM, FastSLAM and batch least squares on the
Victoria Park log with known data association (lesson 07). The log is not part of the course."""

import argparse
import sys
from dataclasses import dataclass
from functools import cache
from itertools import groupby
from pathlib import Path
from time import process_time

import numpy as np

from course.studies.study_command import TABLES
from slamlab import sources
from slamlab.evaluation import nees
from slamlab.filters.compressed_ekf import CompressedEKF
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_models import LandmarkModel
from slamlab.filters.particle_filters.fastslam import FastSLAM
from slamlab.filters.particle_filters.particle_set import ParticleSet
from slamlab.filters.submap_joining import JoinedMap
from slamlab.geometry import compose, matrix, transform, wrap
from slamlab.posegraph import PoseGraph, edge_error
from slamlab.sources import SourceError, gtsam_text

TABLE = TABLES / "victoria_park.npz"
EVERY, CHECKPOINTS = 30, 20  # poses of a stored trajectory; batch optima along the log
REACH = 60.0  # of the compressed filter's region [m]
SUBMAP, PARTICLES = 100, 300  # poses of a submap; particles of FastSLAM
TURN = np.array([[0.0, -1.0], [1.0, 0.0]])  # rotation by 90°


def rotation(angle):
    """Rotation matrix (2, 2)."""
    return matrix([0, 0, angle])[:2, :2]


def h(x, p):
    """Position (..., 2) of landmarks p (..., 2) in the frame of the pose x (3,)."""
    return (p - x[:2]) @ rotation(x[2])


def g(x, z):
    """Inverse measurement model: position (..., 2) of landmarks measured at z (..., 2)."""
    return transform(x, z)


def _H(x, p):
    H_p = np.broadcast_to(rotation(x[2]).T, (len(p), 2, 2))
    turned = -h(x, p) @ TURN.T  # ∂h/∂θ
    return np.concatenate([-H_p, turned[..., None]], axis=2), H_p


def _J(x, z):
    J_z = np.broadcast_to(rotation(x[2]), (len(z), 2, 2))
    turned = (g(x, z) - x[:2]) @ TURN.T
    return np.concatenate([np.broadcast_to(np.eye(2), J_z.shape), turned[..., None]], axis=2), J_z


class CartesianEkfSlam(MAK):
    """EKF-SLAM with landmarks in front of the robot, measured in x and y in the robot's frame."""

    def __init__(self, first_estimates):
        kind = LandmarkModel(h, g, _H, _J)
        super().__init__(np.zeros(3), np.zeros((3, 3)), first_estimates=first_estimates, kind=kind)

    def _linearise(self, rows, z):
        _, H, columns = super()._linearise(rows, z)
        return (z - h(self.x[:3], self.x[rows].reshape(-1, 2))).ravel(), H, columns


class EkfSlam:
    """EKF-SLAM that is driven by the measurements of the log."""

    def __init__(self, first_estimates=False):
        self.filter = CartesianEkfSlam(first_estimates)

    def move(self, z, covariance):
        """Predict by an increment z (3,) of odometry and its covariance, in the robot's frame."""
        _predict(self.filter, self.filter.pose, z, covariance)

    def observe(self, ids, z, R):
        """Update known landmarks, and add new ones, by their positions z (m, 2) in its frame."""
        ids, known = np.array(ids), np.isin(ids, self.filter.ids)
        for add_or_update, some in ((self._update, known), (self.filter.add, ~known)):
            if some.any():
                add_or_update(ids[some].tolist(), z[some], R[some])

    def _update(self, ids, z, R):
        self.filter.update(ids, z, R)

    def estimate(self):
        """Return the robot's pose (3,) and its covariance (3, 3)."""
        return self.filter.pose, self.filter.block([0, 1, 2])


def _predict(slam, pose, z, covariance):
    C = np.eye(3)
    C[:2, :2] = rotation(pose[2])
    slam.predict(compose(pose, z), C @ covariance @ C.T)


class CompressedEkfSlam(EkfSlam):
    """EKF-SLAM that updates landmarks farther than REACH only when the robot leaves a region."""

    def __init__(self):
        super().__init__()
        self._compressed = CompressedEKF(self.filter)
        self._compressed.focus([])

    def move(self, z, covariance):
        _predict(self._compressed, self._compressed.local.pose, z, covariance)

    def observe(self, ids, z, R):
        if not set(ids) <= set(self._compressed.local.ids):
            self._compressed.settle()
            super().observe(ids, z, R)
            away = np.hypot(*(self.filter.landmarks() - self.filter.pose[:2]).T)
            self._compressed.focus(np.array(self.filter.ids)[away < REACH].tolist())
        else:
            self._compressed.update(ids, z, R)

    def estimate(self):
        return self._compressed.local.pose, self._compressed.local.block([0, 1, 2])


class SubmapSlam(EkfSlam):
    """Submap joining: after SUBMAP poses, a new EKF begins at pose 0 with P = 0."""

    def __init__(self):
        super().__init__()
        self.joined, self._count = JoinedMap(), 0

    def move(self, z, covariance):
        if self._count == SUBMAP:
            self.joined.join(self.filter)
            self.filter, self._count = CartesianEkfSlam(False), 0
        super().move(z, covariance)
        self._count += 1

    def estimate(self):
        """Return the pose and its covariance, by the joined map and the current submap."""
        base, (pose, P) = self.joined.pose, super().estimate()
        A, C = np.eye(3), matrix([0, 0, base[2]])
        A[:2, 2] = TURN @ C[:2, :2] @ pose[:2]
        return compose(base, pose), A @ self.joined.P[:3, :3] @ A.T + C @ P @ C.T


class ParticleSlam(EkfSlam):
    """FastSLAM with ranges and bearings; the covariance is that of the particles' poses."""

    def __init__(self):
        self._rng = np.random.default_rng(0)
        self.filter = FastSLAM(self._rng, PARTICLES)

    def move(self, z, covariance):
        slam = self.filter
        steps = self._rng.multivariate_normal(z, covariance, PARTICLES)
        slam.robot = ParticleSet(compose(slam.robot.rows, steps), slam.robot.weights)

    def observe(self, ids, z, R):
        x, y = z.T
        r = np.hypot(x, y)
        J = np.array([[x / r, y / r], [-y / r**2, x / r**2]]).transpose(2, 0, 1)
        R = J @ R @ J.transpose(0, 2, 1)
        super().observe(ids, np.column_stack([r, np.arctan2(y, x)]), (R + R.mT) / 2)

    def estimate(self):
        w, rows = self.filter.robot.weights, self.filter.robot.rows
        mean = w @ rows
        mean[2] = np.angle(w @ np.exp(1j * rows[:, 2]))
        d = rows - mean
        d[:, 2] = wrap(d[:, 2])
        return mean, (w * d.T) @ d


METHODS = {
    "standard": EkfSlam,
    "first estimates": lambda: EkfSlam(first_estimates=True),
    "compressed": CompressedEkfSlam,
    "submaps": SubmapSlam,
    "FastSLAM": ParticleSlam,
}
FILTERS = list(METHODS)[:2]  # whose maps are stored


@dataclass(frozen=True)
class FilterRun:
    """Result of a filter: poses (n, 3), their P (n, 3, 3), the filter at the end, and its CPU time
    [s]."""

    poses: np.ndarray
    P: np.ndarray
    filter: object
    seconds: float


def run(slam, measurements):
    """Run SLAM, one of METHODS, on measurements in the order of their time; return a FilterRun."""
    estimates, seconds = [(np.zeros(3), np.zeros((3, 3)))], 0.0
    for (_, of_landmarks), group in groupby(measurements, lambda each: (each.i, each.of_landmark)):
        _, ids, z, covariances = zip(*group, strict=True)
        began = process_time()
        if of_landmarks:
            slam.observe(ids, np.array(z), np.array(covariances))
        else:
            slam.move(z[0], covariances[0])
        seconds += process_time() - began
        estimates[len(estimates) - of_landmarks :] = [slam.estimate()]
    return FilterRun(*map(np.array, zip(*estimates, strict=True)), slam.filter, seconds)


@dataclass(frozen=True)
class Batch:
    """Batch optimum: poses (n, 3), landmarks (N, 2) in the order of their first measurement, the
    marginal covariances of the last pose (3, 3) and of the landmarks (N, 2, 2), and χ²."""

    poses: np.ndarray
    landmarks: np.ndarray
    P_last: np.ndarray
    P_landmarks: np.ndarray
    chi2: float


def batch(measurements, poses, landmarks):
    """Compute the Batch optimum from a guess: poses (n, 3), and a dict of landmarks by id."""
    graph, guess = PoseGraph(), iter(poses)
    nodes = {measurements[0].i: graph.add_pose(next(guess))}
    for i, j, z, covariance in measurements:
        if len(z) == 3:
            nodes[j] = graph.add_pose(next(guess))
            information = edge_error.information(z, covariance)
        else:
            if j not in nodes:
                nodes[j] = graph.add_landmark(landmarks[j])
            information = np.linalg.inv(covariance)
        graph.add_edge(nodes[i], nodes[j], z, information)
    optimum, trees = graph.optimise(), sorted(graph.landmarks)
    of_poses = np.delete(np.arange(len(graph)), trees)
    P = graph.covariances(nodes=[of_poses[-1], *trees])
    ends = graph.poses[of_poses], graph.poses[trees, :2]
    return Batch(*ends, P[0], P[1:, :2, :2], optimum.chi2)


def study():
    """Compute the arrays to store; raise SourceError if the recording is missing."""
    measurements = gtsam_text.load(sources.recording("victoria-park"))
    odometry = [each for each in measurements if not each.of_landmark]
    observed = len(measurements) - len(odometry)
    runs = {name: run(method(), measurements) for name, method in METHODS.items()}
    guess = runs["first estimates"]
    landmarks = dict(zip(guess.filter.ids, guess.filter.landmarks(), strict=True))
    best = batch(measurements, guess.poses, landmarks)
    poses, checks = _checkpoints(measurements, runs, landmarks)
    kept = {
        "counts": [len(best.poses), observed, len(landmarks)],
        "chi2": [best.chi2, 2 * (observed - len(landmarks))],
        "odometry": run(EkfSlam(), odometry).poses[::EVERY],
        "batch": best.poses[::EVERY],
        "batch trees": best.landmarks,
        "batch trees P": best.P_landmarks,
        "checkpoints": poses,
    }
    for name, each in runs.items():
        kept[f"{name} checkpoints"] = checks[name]
        kept[f"{name} seconds"] = each.seconds
    for name in FILTERS:
        kept[name] = runs[name].poses[::EVERY]
        kept[f"{name} trees"] = runs[name].filter.landmarks()
        kept[f"{name} trees P"] = runs[name].filter.blocks()[2]
    return kept


def _checkpoints(measurements, runs, landmarks):
    """Compare each method's pose with the Batch optimum of all measurements up to this pose.

    Returns rows of the pose's number and the σ of the batch [m]; and, for each method, rows of its
    distance from the batch optimum, its σ [m], and the NEES of the difference by the method's P and
    by the batch's.
    """
    starts = [k for k, each in enumerate(measurements) if not each.of_landmark]
    ends = [*starts[1:], len(measurements)]  # of the measurements up to each pose
    poses, rows = [], {name: [] for name in runs}
    for number in np.linspace(0, len(starts), CHECKPOINTS + 1)[1:].astype(int):
        guess = runs["first estimates"].poses[: number + 1]
        best = batch(measurements[: ends[number - 1]], guess, landmarks)
        poses.append([number, _sigma(best.P_last)])
        for name, each in runs.items():
            error, P = each.poses[number] - best.poses[-1], each.P[number]
            error[2] = wrap(error[2])
            own = nees(error, P) if np.linalg.det(P) > 0 else np.inf  # one particle has P = 0
            rows[name].append([np.hypot(*error[:2]), _sigma(P), own, nees(error, best.P_last)])
    return poses, rows


def _sigma(P):
    """Standard deviation of the position, √trace [m]."""
    return np.sqrt(np.trace(P[:2, :2]))


@cache
def stored():
    """Load the stored arrays, a dict."""
    with np.load(TABLE) as kept:
        return {name: kept[name].astype(float) for name in kept}


def main(argv=None):
    command = argparse.ArgumentParser(prog="python -m course.studies.victoria_park")
    command.add_argument("--out", type=Path, default=TABLE, help="the file to write")
    asked = command.parse_args(argv)
    try:
        kept = study()
        kept = {name: np.asarray(each, dtype=np.float32) for name, each in kept.items()}
        np.savez_compressed(asked.out, **kept)
    except (SourceError, OSError) as error:
        print(f"{command.prog}: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
