"""Linear Gaussian system (double integrator): cart with distance [m] and speed [m/s] as state."""

import numpy as np

T = 0.5  # time step [s]
F = np.array([[1, T], [0, 1]])  # state transition matrix; Equation (03.8)
G = np.array([[T**2 / 2], [T]])  # control matrix, of an acceleration [m/s²]; Equation (03.8)
Q = np.diag([0.02, 0.05]) ** 2  # covariance of the process noise
H = np.array([[1.0, 0.0]])  # measurement matrix: a range finder measures the distance
R = np.array([[0.3**2]])  # covariance of the measurement noise
START_X, START_P = np.array([2.0, 0.0]), np.diag([0.4, 0.3]) ** 2  # prior

STEPS = 60
CONTROLS = np.zeros((STEPS, 1))  # control inputs: accelerate for 3 s, roll, brake [m/s²]
CONTROLS[:6], CONTROLS[44:50] = 0.3, -0.3


def simulate_runs(rng, runs, blocked=slice(24, 36)):
    """Simulate runs of x ← F x + G u + q and z = H x + ε. Equations (03.7) and (03.12).

    Returns states (runs, 60, 2) and measurements (runs, 60, 1) with NaN in ``blocked`` steps.
    """
    x = rng.multivariate_normal(START_X, START_P, runs)
    truth = np.empty((runs, STEPS, 2))
    for step, u in enumerate(CONTROLS):
        x = x @ F.T + G @ u + rng.multivariate_normal([0, 0], Q, runs)
        truth[:, step] = x
    zs = truth @ H.T + rng.normal(0, np.sqrt(R.item()), (runs, STEPS, 1))
    zs[:, blocked] = np.nan
    return truth, zs
