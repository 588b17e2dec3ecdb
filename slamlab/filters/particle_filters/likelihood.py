"""Measurement likelihood (observation likelihood): Gaussian log-likelihoods for all particles."""

import numpy as np

from slamlab.filters.landmark_models import difference
from slamlab.models.observation import h

BLOCK = 2048  # particles at a time, so that the data fit into the cache


def log_gaussian(v, S):
    """Compute log N(v; 0, S), N = exp(−vᵀ S⁻¹ v / 2) / (2π √det S); v (..., 2), S (..., 2, 2)."""
    a, b, d = S[..., 0, 0], S[..., 0, 1], S[..., 1, 1]
    det = a * d - b * b
    r, beta = v[..., 0], v[..., 1]
    squared = (d * r * r - 2 * b * r * beta + a * beta * beta) / det
    return -0.5 * (squared + np.log(det)) - np.log(2 * np.pi)


def of_observation(x, p, z, R):
    """Log-likelihood log p(z | x, p) of z (2,) for poses x (..., 3) and landmarks p (..., 2)."""
    return log_gaussian(difference(z, h(x, p)), R)


def of_scan(x, p, z, R):
    """Log-likelihood (n,) of a scan with known association: Σ_j log N(z_j; h(x, p_j), R_j).

    In a frame along the measured bearing, the landmark has the position (a, b), and the innovation
    is r − √(a² + b²), −atan2(b, a). One product of poses and landmarks gives all (a, b).
    """
    c, s = np.cos(x[:, 2]), np.sin(x[:, 2])
    poses = np.stack([c, s, c * x[:, 0] + s * x[:, 1], c * x[:, 1] - s * x[:, 0]], axis=1)
    (px, py), (cb, sb) = p.T, (np.cos(z[:, 1]), np.sin(z[:, 1]))
    a = [cb * px + sb * py, cb * py - sb * px, -cb, -sb]
    b = [cb * py - sb * px, -cb * px - sb * py, sb, -cb]
    landmarks, m = np.hstack([a, b]), len(p)
    # vᵀ R⁻¹ v = r²/R_rr + (β − R_rβ/R_rr r)²/D, D the conditional variance of β given r
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
    """Compute the log-likelihood (n,) of a scan with unknown data association and clutter (false
    measurements). Equation (11.8).

    Σ_k log( (1/m) Σ_j N(z_k; h(x, p_j), R_k) + clutter ), a density [1/(m rad)]
    """
    total = np.zeros(len(x))
    for one, noise in zip(z, R, strict=True):
        density = np.exp(of_observation(x[:, None], p, one, noise))
        total += np.log(density.mean(axis=1) + clutter)
    return total
