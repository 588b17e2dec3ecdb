"""Small planar graphs as text, and their solution.

It is of dense least squares on the same factors, written here apart from slamlab's.
"""

from dataclasses import dataclass, field, replace

import numpy as np
from hypothesis import strategies as st
from scipy.optimize import least_squares

ORDER = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]  # of g2o's information entries
TORO_ORDER = [(0, 0), (0, 1), (1, 1), (2, 2), (0, 2), (1, 2)]


@dataclass
class Factors:
    """A small planar graph: guesses of nodes by id, and measurements as (ids…, z, information)."""

    poses: dict = field(default_factory=dict)
    landmarks: dict = field(default_factory=dict)
    edges: list = field(default_factory=list)
    observation_vectors: list = field(default_factory=list)
    priors: list = field(default_factory=list)
    fixed: set = field(default_factory=set)

    def solution(self):
        """Poses and landmarks of least squares by id, the optimal χ²; heading kept in [−π, π]."""
        free = [name for name in (*self.poses, *self.landmarks) if name not in self.fixed]
        given = self.poses | self.landmarks
        sizes = [len(given[name]) for name in free]

        def unpack(x):
            return given | dict(zip(free, np.split(x, np.cumsum(sizes)[:-1]), strict=True))

        def residuals(x):
            at, out = unpack(x), []
            for i, j, z, L in self.edges:
                out.append(np.linalg.cholesky(L).T @ seen(seen(at[i], at[j]), z, back=True))
            for i, j, z, L in self.observation_vectors:
                out.append(np.linalg.cholesky(L).T @ (seen(at[i], [*at[j], 0])[:2] - z))
            for i, z, L in self.priors:
                whole = len(z) == 3
                e = seen(at[i], z, back=True) if whole else np.array(at[i][:2]) - z
                out.append(psd_root(L) @ e)
            return np.concatenate(out)

        start = np.concatenate([np.array(given[name], float) for name in free])
        best = least_squares(residuals, start, method="trf", xtol=1e-14, ftol=1e-14, gtol=1e-14)
        return unpack(best.x), 2 * best.cost


def seen(a, b, back=False):
    """Pose b as seen from a; with back a as seen from b."""
    a, b = (b, a) if back else (a, b)
    c, s = np.cos(a[2]), np.sin(a[2])
    dx, dy, turn = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    turn = np.arctan2(np.sin(turn), np.cos(turn))
    return np.array([c * dx + s * dy, c * dy - s * dx, turn])


def psd_root(information):
    values, vectors = np.linalg.eigh(information)
    return (vectors * np.sqrt(np.maximum(values, 0))).T


def spread(rng, size):
    """A full information matrix."""
    mixed = np.eye(size) + rng.uniform(-0.5, 0.5, (size, size))
    return mixed @ np.diag(rng.uniform(5, 200, size)) @ mixed.T


RNG = np.random.default_rng(5)
TRUE = {k: np.array([2 * k % 7, 0.3 * k * k, 0.8 * k - 2]) for k in range(6)}
TRUE[0] = np.zeros(3)
POINTS = {10: np.array([1.0, 4.0]), 11: np.array([5.0, -1.0]), 12: np.array([3.0, 6.0])}


def measured(i, j):
    return seen(TRUE[i], TRUE[j]) + RNG.normal(0, [0.1, 0.1, 0.05])


RING = Factors(
    poses={k: pose + (k > 0) * RNG.normal(0, 0.1, 3) for k, pose in TRUE.items()},
    edges=[
        (i, j, measured(i, j), spread(RNG, 3))
        for i, j in [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0), (4, 1), (2, 5)]
    ],
    fixed={0},
)
WITH_LANDMARKS = replace(
    RING,
    landmarks={name: place + RNG.normal(0, 0.1, 2) for name, place in POINTS.items()},
    observation_vectors=[
        (i, j, seen(TRUE[i], [*POINTS[j], 0])[:2] + RNG.normal(0, 0.1, 2), spread(RNG, 2))
        for i, j in [(0, 10), (1, 10), (2, 11), (3, 11), (4, 12), (5, 12), (0, 12), (5, 10)]
    ],
)
UNFIXED = replace(RING, fixed=set())
PRIOR = replace(UNFIXED, priors=[(2, np.array([3.0, 1.0, 0.4]), spread(RNG, 3))])
GPS = replace(
    UNFIXED, priors=[(k, TRUE[k][:2] + RNG.normal(0, 0.1, 2), spread(RNG, 2)) for k in (0, 2, 5)]
)


def text(factors, vertices=True, toro=False, name=str, number=repr, order="vfe"):
    """The lines of a file, its numbers as ``number`` writes them, ids as ``name``."""

    def row(word, ids, numbers):
        return " ".join([word, *map(name, ids), *(number(float(n)) for n in numbers)])

    def entries(information):
        order = (TORO_ORDER if toro else ORDER) if len(information) == 3 else ORDER[:2] + ORDER[3:4]
        return [information[cell] for cell in order]

    pose, edge = ("VERTEX2", "EDGE2") if toro else ("VERTEX_SE2", "EDGE_SE2")
    parts = {
        "v": [row(pose, [k], p) for k, p in factors.poses.items()]
        + [row("VERTEX_XY", [k], p) for k, p in factors.landmarks.items()],
        "f": [row("FIX", [k], []) for k in sorted(factors.fixed)],
        "e": [row(edge, (i, j), [*z, *entries(L)]) for i, j, z, L in factors.edges]
        + [
            row("EDGE_SE2_XY", (i, j), [*z, *entries(L)])
            for i, j, z, L in factors.observation_vectors
        ],
    }
    for i, z, L in factors.priors:
        word = "EDGE_PRIOR_SE2" if len(z) == 3 else "EDGE_PRIOR_SE2_XY"
        word = "EDGE_PRIOR_XY" if i in factors.landmarks else word
        parts["e"].append(row(word, [i], [*z, *entries(L)]))
    rows = [line for part in order if vertices or part != "v" for line in parts[part]]
    return "".join(line + "\n" for line in rows)


def many(factors, **options):
    return text(factors, **options).encode()


numbers = st.floats(-1e6, 1e6)
