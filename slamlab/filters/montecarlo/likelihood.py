"""Observation likelihood (measurement model): Gaussian log-likelihoods of all particles."""

import numpy as np

from slamlab.geometry import wrap
from slamlab.models.observation import h

BLOCK = 2048  # particles at a time, so that the work stays in the processor's cache


def log_gaussian(v, S):
    """Gaussian log-density: log N(v; 0, S), N = exp(−vᵀ S⁻¹ v / 2) / (2π √det S).

    Parameters
    ----------
    v : (..., 2)
    S : (..., 2, 2), broadcast against v

    Returns
    -------
    (...)
    """
    a, b, d = S[..., 0, 0], S[..., 0, 1], S[..., 1, 1]
    det = a * d - b * b
    r, beta = v[..., 0], v[..., 1]
    squared = (d * r * r - 2 * b * r * beta + a * beta * beta) / det
    return -0.5 * (squared + np.log(det)) - np.log(2 * np.pi)


def of_observation(x, p, z, R):
    """Log-likelihood log p(z | x, p) of one observation, for pairs of a pose and a landmark.

    Parameters
    ----------
    x : (..., 3) poses [m, m, rad]
    p : (..., 2) positions of the landmark, broadcast against the poses [m]
    z : (2,) range [m] and bearing [rad]
    R : (2, 2)

    Returns
    -------
    (...)
    """
    v = z - h(x, p)
    v[..., 1] = wrap(v[..., 1])
    return log_gaussian(v, R)


def of_scan(x, p, z, R):
    """Log-likelihood of a scan, known data association: Σ_j log N(z_j; h(x, p_j), R_j).

    A landmark seen along its measured bearing lies at (a, b) with b = 0, so that the innovation is
    r − √(a² + b²) and −atan2(b, a), wrapped already. (a, b) of all poses and landmarks is one
    product of matrices, [cos θ, sin θ, t] of the pose (t turned by −θ) with numbers of the
    landmark.

    Parameters
    ----------
    x : (n, 3) poses [m, m, rad]
    p : (m, 2) landmarks [m]
    z : (m, 2) range [m] and bearing [rad] of each
    R : (m, 2, 2)

    Returns
    -------
    (n,)
    """
    c, s = np.cos(x[:, 2]), np.sin(x[:, 2])
    poses = np.stack([c, s, c * x[:, 0] + s * x[:, 1], c * x[:, 1] - s * x[:, 0]], axis=1)
    (px, py), (cb, sb) = p.T, (np.cos(z[:, 1]), np.sin(z[:, 1]))
    a = [cb * px + sb * py, cb * py - sb * px, -cb, -sb]
    b = [cb * py - sb * px, -cb * px - sb * py, sb, -cb]
    landmarks, m = np.hstack([a, b]), len(p)
    # vᵀ R⁻¹ v = r²/R_rr + (β − R_rβ/R_rr r)²/D, D being what R_ββ keeps once r is known
    skew = R[:, 0, 1] / R[:, 0, 0]
    D = R[:, 1, 1] - R[:, 0, 1] * skew
    logs = np.empty(len(x))
    for k in range(0, len(x), BLOCK):
        ab = poses[k : k + BLOCK] @ landmarks
        beta = -np.arctan2(ab[:, m:], ab[:, :m])
        ab *= ab
        r = z[:, 0] - np.sqrt(ab[:, :m] + ab[:, m:])
        beta -= skew * r
        r *= r
        beta *= beta
        logs[k : k + BLOCK] = r @ (-0.5 / R[:, 0, 0]) + beta @ (-0.5 / D)
    return logs - 0.5 * np.log(R[:, 0, 0] * D).sum() - m * np.log(2 * np.pi)


def of_unassociated_scan(x, p, z, R, clutter=1e-3):
    """Log-likelihood log p(z | x) of a scan of unknown data association, for every pose.

    Σ_k log( (1/m) Σ_j N(z_k; h(x, p_j), R_k) + clutter ): each pose has its own association, and
    clutter, which is no landmark of the map, costs every pose alike. Equation (11.8), and clutter.

    Parameters
    ----------
    x : (n, 3) poses [m, m, rad]
    p : (m, 2) landmarks [m]
    z : (k, 2) range [m] and bearing [rad]
    R : (k, 2, 2)
    clutter : float, density of false observations [1/(m rad)]

    Returns
    -------
    (n,)
    """
    total = np.zeros(len(x))
    for one, noise in zip(z, R, strict=True):
        density = np.exp(of_observation(x[:, None], p, one, noise))
        total += np.log(density.mean(axis=1) + clutter)
    return total
