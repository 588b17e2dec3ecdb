"""Task 08-joint: the largest association whose pairs are compatible together."""

from itertools import product

import numpy as np
from scipy.stats import chi2

from classroom.exercises.correctness_laws import Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex08_landmarks_from_scans.associate.task import nearest_first
from course.exercises.ex08_landmarks_from_scans.calls import CALLS
from course.exercises.ex08_landmarks_from_scans.lines import covariances
from slamlab.geometry import wrap

CLOSE = 1e-6  # relative error of a d²
MARGIN = 0.01  # relative, between a d² and its gate, and between the best two associations
EACH, DRAWN = 3, 300


def inputs(rng):
    """Scenes in which the nearest walls are right, or not compatible, or too many."""
    given = scenes(rng, DRAWN)
    given["z"][::2, 2, 0] += 2 * np.pi  # of no wall: ranges are not to be wrapped
    given = clear(given)
    kinds = _kinds(given).values()
    return _rows(given, np.concatenate([np.flatnonzero(kind)[:EACH] for kind in kinds]))


def scenes(rng, rows, m=3, N=4, first=(-np.pi, np.pi), map_errors=1.0, pose_errors=1.0):
    """Scenes after an inaccurate turn; walls 0 and 1, 2 and 3, … are nearly the same."""
    pair = np.arange(N) // 2
    alpha = wrap(
        rng.uniform(*first, (rows, 1))
        + 1.4 * pair
        + np.cumsum(rng.uniform(0.1, 0.3, (rows, N)), axis=1)
    )
    rho = 1.5 + 0.7 * pair + rng.uniform(0, 0.1, (rows, N))
    pose = rng.uniform(-2, 2, (rows, 3))
    H = np.zeros((rows, N, 2, 3 + 2 * N))
    c, s = np.cos(alpha + pose[:, 2:]), np.sin(alpha + pose[:, 2:])
    H[:, :, 0, 0], H[:, :, 0, 1], H[:, :, 1, 2] = -c, -s, -1
    for j in range(N):
        H[:, j, :, 3 + 2 * j : 5 + 2 * j] = np.eye(2)
        H[:, j, 0, 4 + 2 * j] = pose[:, 0] * s[:, j] - pose[:, 1] * c[:, j]
    sigma = np.concatenate(
        [pose_errors * np.array([0.05, 0.05, 0.15]), map_errors * np.tile([0.03, 0.02], N)]
    )
    A = sigma[:, None] * (np.eye(len(sigma)) + 0.3 * rng.standard_normal((rows, *[len(sigma)] * 2)))
    R = covariances(rng, (rows,), (0.02, 0.04), (0.02, 0.04))
    expected = np.stack([rho, alpha], axis=-1)
    z = np.zeros((rows, m, 2))
    for row in range(rows):
        error = A[row] @ rng.standard_normal(len(sigma))
        of = rng.permutation(np.arange(max(m, N)) % max(N, 1))[:m]
        noise = rng.multivariate_normal(np.zeros(2), R[row], m)
        noise[rng.random(m) < 0.2] += [0.0, 0.25]  # a false measurement, or another wall
        if N:
            z[row] = expected[row, of] + H[row, of] @ error + noise
    z[..., 1] = wrap(z[..., 1])
    level = rng.choice([0.9, 0.95, 0.99], (rows, 1))
    gates = np.column_stack([np.zeros(rows), chi2.ppf(level, np.arange(1, 2 * max(m, 1) + 1))])
    return {"z": z, "expected": expected, "H": H, "P": A @ A.mT, "R": R, "gates": gates}


def _rows(given, which):
    return {name: array[which] for name, array in given.items()}


def _two_by_two(rng):
    """Three pairs of which every two are compatible, but not all three."""
    given = scenes(rng, 8, N=3, map_errors=0.05, pose_errors=0.05)
    each = (given["gates"][:, 6] / 3 + given["gates"][:, 4] / 2)[:, None] / 2 * [0.95, 1, 1.05]
    angle = rng.uniform(-np.pi, np.pi, each.shape)
    white = np.sqrt(each)[..., None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    off = np.linalg.cholesky(given["R"])[:, None] @ white[..., None]
    given["z"] = given["expected"] + off[..., 0]
    given["z"][..., 1] = wrap(given["z"][..., 1])
    return clear(given)


def distances(given, walls):
    """Joint d² (rows, a) of associations (rows, a, m), −1 for no wall; its numbers are then 0."""
    rows, m = np.arange(len(given["z"]))[:, None, None], given["z"].shape[1]
    none = walls < 0
    v = given["z"][:, None] - _at(given["expected"], rows, walls)
    v[..., 1] = wrap(v[..., 1])
    v[none] = 0
    H = _at(given["H"], rows, walls)
    H[none] = 0
    v, H = v.reshape(*v.shape[:2], 2 * m), H.reshape(*H.shape[:2], 2 * m, H.shape[-1])
    S = H @ given["P"][:, None] @ H.mT
    for i in range(0, 2 * m, 2):
        S[..., i : i + 2, i : i + 2] += given["R"][:, None]
    return (v * np.linalg.solve(S, v[..., None])[..., 0]).sum(axis=-1)


def _at(array, rows, walls):
    """array[row, wall], with a row of zeros for −1."""
    padded = np.pad(array, [(0, 0), (0, 1), *[(0, 0)] * (array.ndim - 2)])
    return padded[rows, walls]


def _singles(given):
    """d² (rows, m, N) of each pair alone."""
    rows, m, N = *given["z"].shape[:2], given["expected"].shape[1]
    walls = np.full((m, N, m), -1)
    walls[np.arange(m), :, np.arange(m)] = np.arange(N)
    return distances(given, np.tile(walls.reshape(m * N, m), (rows, 1, 1))).reshape(rows, m, N)


def faults(given, walls):
    """What is wrong with associations (rows, a, m): (rows, a) each, by its name."""
    alone = _at(_singles(given).mT, np.arange(len(walls))[:, None, None], walls)
    own = np.diagonal(alone, axis1=2, axis2=3).max(axis=2, initial=0)
    same = (walls[..., None] == walls[..., None, :]) & (walls >= 0)[..., None]
    k = (walls >= 0).sum(axis=2)
    return {
        "a wall is used twice": same.sum(axis=(2, 3)) > k,
        "a pair alone is outside its gate": own > given["gates"][:, 2:3],
        "all pairs jointly are outside their gate": distances(given, walls) > _gate(given, k),
    }


def _gate(given, k):
    return np.take_along_axis(given["gates"], 2 * k, axis=1)


@once
def ranked(given):
    """All associations (rows, a, m), joint d² and number of pairs, and which are compatible."""
    (rows, m), N = given["z"].shape[:2], given["expected"].shape[1]
    walls = np.array(list(product(range(-1, N), repeat=m)), dtype=int)
    walls = np.tile(walls, (rows, 1, 1))
    wrong = np.logical_or.reduce(list(faults(given, walls).values()))
    return walls, distances(given, walls), (walls >= 0).sum(axis=2), ~wrong


@once
def want(given):
    """The best associations: {"pairs": (rows, m) −1 for None, "d2": (rows,)}."""
    walls, d2, k, right = ranked(given)
    best = np.where(right, d2 - 1e6 * k, np.inf).argmin(axis=1)
    rows = np.arange(len(walls))
    return {"pairs": walls[rows, best].astype(float), "d2": d2[rows, best]}


def clear(given):
    """Rows in which no d² is near its gate, and no two associations are equally good."""
    _, d2, k, right = ranked(given)
    gates, best = _gate(given, k), want(given)["d2"]
    near = (np.abs(d2 - gates) <= MARGIN * gates) & (k > 0)
    first, second = np.sort(np.where(right, d2 - 1e6 * k, np.inf), axis=1)[:, :2].T
    return _rows(given, ~near.any(axis=1) & (second - first > MARGIN * (1 + best)))


def _kinds(given):
    """By what an association must attend to."""
    best, (walls, d2, k, fits) = want(given), ranked(given)
    right, near, gates = best["pairs"].astype(int), _nearest(given), given["gates"]
    most = (right >= 0).sum(axis=1)[:, None]
    better = (k > most) | ((k == most) & (d2 < best["d2"][:, None]))
    twice, alone, jointly = faults(given, walls).values()
    outside = better & ~twice & ~alone & jointly
    alpha = np.take_along_axis(given["expected"][..., 1], np.maximum(right, 0), axis=1)
    fewer, same = most[:, 0] < (near >= 0).sum(axis=1), (right == near).all(axis=1)
    return {
        "nearest": same & (near >= 0).all(axis=1),
        "others as many": ~same & ~fewer,
        "fewer": fewer,
        "several": (fits & (k == most)).sum(axis=1) > 1,
        "across π": ((np.abs(given["z"][..., 1] - alpha) > np.pi) & (right >= 0)).any(axis=1),
        "a wall twice": (better & twice & ~alone & ~jointly).any(axis=1),
        "a pair outside its gate": (better & ~twice & alone & ~jointly).any(axis=1),
        "in the sum of gates": (outside & (d2 <= k * gates[:, 2:3])).any(axis=1),
        "in the largest gate": (outside & (d2 <= gates[:, -1:])).any(axis=1),
    }


def _nearest(given):
    S = given["H"] @ given["P"][:, None] @ given["H"].mT + given["R"][:, None]
    scenes = {name: given[name] for name in ("z", "expected")}
    return nearest_first(scenes | {"S": S, "gate": given["gates"][:, 2]})["pairs"]


def _own(given, out):
    """Joint d² of the returned associations, whether each is returned, and whether half of the
    scenes with two compatible pairs have two: a single pair has no joint d²."""
    right, best = distances(given, out["pairs"].astype(int)[:, None])[:, 0], want(given)["pairs"]
    several, of = (((pairs >= 0).sum(axis=1) > 1).sum() for pairs in (out["pairs"], best))
    enough = 2 * several >= of
    return right, enough & (np.abs(out["d2"] - right) <= CLOSE * (1 + right)), enough


def _why_distance(given, out):
    right, same, enough = _own(given, out)
    k = np.flatnonzero(~same)[0]
    if not enough:
        return "a compatible association with two pairs exists"
    return f"the pairs that you return have a joint d² of {right[k]:.4g}, not {out['d2'][k]:.4g}"


def _why_not(given, out):
    wrong = faults(given, out["pairs"].astype(int)[:, None])
    return next(fault for fault, where in wrong.items() if where.any())


def _compatible(given, out):
    wrong = faults(given, out["pairs"].astype(int)[:, None])
    return ~np.logical_or.reduce(list(wrong.values()))[:, 0]


def _covariance(given):
    """S of the first scene's best pairs."""
    pairs = want(given)["pairs"][0].astype(int)
    H = given["H"][0][pairs[pairs >= 0]]
    rows = H.reshape(2 * len(H), given["P"].shape[1])
    S = rows @ given["P"][0] @ rows.T + np.kron(np.eye(len(H)), given["R"][0])
    return {"S of the right pairs": S} if len(H) else {}


def _counts(given):
    _, _, k, right = ranked(given)
    return {
        "pairs of each compatible association": np.sort(np.where(right, k, -1))[:, ::-1][
            :, : right.sum(axis=1).min()
        ]
    }


def _numbers(given):
    return {"d² of each measurement (row) and wall (column) alone": _singles(given)}


JOINT = Task(
    id="08-joint",
    title="Joint compatibility",
    call=CALLS["08-joint"],
    inputs=inputs,
    shapes=lambda given: {"pairs": given["z"].shape[:2], "d2": (len(given["z"]),)},
    laws=(
        Law(
            "distance",
            1.5,
            "d2 is the joint d² of all returned pairs, which are two or more in half of the scenes "
            "where two are compatible",
            lambda given, out: _own(given, out)[1],
            why=_why_distance,
            asks="Do you return two pairs wherever two are compatible? If so, stack their "
            "innovations: which numbers must be wrapped, which errors do the pairs have in common, "
            "and where in S does each error stand?",
            step=_covariance,
        ),
        Law(
            "compatible",
            0.5,
            "each pair alone and all pairs together are within their gates, and no wall is used "
            "twice",
            _compatible,
            why=_why_not,
            asks="How many degrees of freedom does the joint d² of three pairs have?",
            step=_numbers,
            alone=False,
        ),
        Law(
            "best",
            1.5,
            "no compatible association has more pairs, or as many and a smaller joint d²",
            lambda given, out: (out["pairs"] == want(given)["pairs"]).all(axis=1),
            want=want,
            asks="The nearest wall of one measurement is not compatible with the nearest wall of "
            "another. Which associations do you try next?",
            step=_counts,
        ),
    ),
    probes=(
        Probe("a single measurement", lambda rng: clear(scenes(rng, 8, m=1))),
        Probe("walls behind the robot", lambda rng: clear(scenes(rng, 8, m=2, first=(2.8, 3.0)))),
        Probe("a map without errors", lambda rng: clear(scenes(rng, 8, m=2, map_errors=0.0))),
        Probe("pairs that are compatible two by two", _two_by_two),
        Probe("more measurements than walls", lambda rng: clear(scenes(rng, 6, m=3, N=2))),
        Probe("an empty map", lambda rng: scenes(rng, 2, m=2, N=0)),
        Probe("an empty scan", lambda rng: scenes(rng, 2, m=0)),
    ),
    may_round=False,
    begins=(
        "Two innovations are stacked to a vector of four numbers. Which blocks does its "
        "covariance S have?",
        "How many associations are there of two measurements with three walls, if a measurement "
        "can also belong to none?",
    ),
)
