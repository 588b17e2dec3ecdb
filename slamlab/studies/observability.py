"""What all sightings of a run together say of its first state, by a filter's own Jacobians."""

import numpy as np

from slamlab.estimators.mak_slam import Q_arc
from slamlab.filters.mak import MAK
from slamlab.geometry import compose
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from slamlab.studies import two_halves
from slamlab.studies.shared_errors import rigid_motions


def stacked_sightings(first_estimates, noise=1.0, seed=7):
    """Stack H_k A_k … A_1 of a run round three landmarks, all of them in sight.

    Equation (07.16).

    Parameters
    ----------
    first_estimates : bool, which Jacobians, see :class:`MAK`
    noise : float, how many times the usual noise of wheels and sensor; 0 is an exact drive
    seed : int

    Returns
    -------
    (2m, 9) the stack, (9,) the first state
    """
    usual = Loop()
    errs = {
        name: noise * getattr(usual, name)
        for name in ("v_sigma", "omega_sigma", "range_sigma", "bearing_sigma")
    }
    loop = Loop(landmarks=3, radius=2, spread=1, range_max=20, steps=30, **errs)
    run = LandmarkRun(loop, np.random.default_rng(seed))
    R = two_halves.R(LandmarkRun(usual, np.random.default_rng(seed)))
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


def whole_scene(state):
    """Directions in which robot and landmarks move together, so that all looks the same.

    Parameters
    ----------
    state : (3 + 2N,) pose and landmarks

    Returns
    -------
    (3 + 2N, 3) : shifts along x and y, turn about the origin; columns of length 1
    """
    points = rigid_motions(state.reshape(-1)[np.r_[0, 1, 3 : len(state)]].reshape(-1, 2))
    scene = np.insert(points, 2, [0, 0, 1], axis=0)
    return scene / np.linalg.norm(scene, axis=0)
