"""Observability of SLAM: which part of the first state a run's observations determine, according to
a filter's Jacobians."""

import numpy as np

from course.studies import localisation_and_mapping
from course.studies.landmark_correlations import rigid_motions
from slamlab.estimators.ekf_slam import Q_arc
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import compose
from slamlab.sources.landmark_runs import LandmarkRun, Loop


def observability_matrix(first_estimates, noise=1.0, seed=7):
    """Return the observability matrix, the stack of H_k A_k … A_1 (2m, 9), of a run round three
    landmarks, with either kind of Jacobians, and the first state (9,). Equation (07.16).

    ``noise`` multiplies all standard deviations.
    """
    usual = Loop()
    errs = {
        name: noise * getattr(usual, name)
        for name in ("v_sigma", "omega_sigma", "range_sigma", "bearing_sigma")
    }
    loop = Loop(landmarks=3, radius=2, spread=1, range_max=20, steps=30, **errs)
    run = LandmarkRun(loop, np.random.default_rng(seed))
    R = localisation_and_mapping.R(LandmarkRun(usual, np.random.default_rng(seed)))
    mak = MAK(np.zeros(3), np.zeros((3, 3)), first_estimates=first_estimates)
    since_start, rows = np.eye(9), []
    for reading in run:
        ids, z = reading.observations.ids.tolist(), reading.observations.z
        if not mak.ids:
            mak.add(ids, z, R)
            first = mak.x.copy()
            continue
        Q = Q_arc(mak.pose, reading.odometry, run.robot)
        A = mak.predict(compose(mak.pose, reading.odometry), Q)
        since_start[:3] = A @ since_start[:3]
        step = mak.update(ids, z, R)
        H = np.zeros((len(step.H), 9))
        H[:, step.columns] = step.H
        rows.append(H @ since_start)
    return np.vstack(rows), first


def rigid_scene_motions(state):
    """Return the unit directions (3 + 2N, 3) of rigid motions of robot and landmarks: along x,
    along y, rotation about the origin."""
    points = rigid_motions(state.reshape(-1)[np.r_[0, 1, 3 : len(state)]].reshape(-1, 2))
    scene = np.insert(points, 2, [0, 0, 1], axis=0)
    return scene / np.linalg.norm(scene, axis=0)
