"""Task 15-gate: the squared Mahalanobis distance of a proposed loop, and whether it passes."""

from dataclasses import replace

import numpy as np
from scipy.stats import chi2

from classroom.exercises.correctness_laws import Law, equals, once
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex15_pose_graph_slam.calls import CALLS
from course.exercises.ex15_pose_graph_slam.edges import sized
from course.exercises.ex15_pose_graph_slam.step.graphs import (
    LONG,
    drawn_information,
    graphs,
    split,
    whitened,
)
from slamlab.geometry import between, compose, inverse, wrap
from slamlab.posegraph.edge_error import error
from slamlab.posegraph.edge_jacobians import J_i, J_j

GRAPH = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (1, 3)]
ENDS = [(0, 4), (5, 0), (0, 2), (3, 0), (1, 4), (5, 2), (2, 5), (4, 1), (3, 5), (5, 4)]
SHARP = 1000.0  # factor of the information, for σ of 1 to 5 cm or 0.5° to 3°
BOUNDS = np.array([[2, 3], [3, 4], [1, 2], [4, 6], [0, 1], [6, 7]])
LEVELS = 0.9, 0.95, 0.99
MARGIN = 0.02  # relative, between a d² and its gate


def proposals(rng, ends=ENDS, pairs=GRAPH, across=True):
    """A graph of least cost and a proposed loop for each pair of ends. Their d² lie between
    the gates of BOUNDS in turn; number 7 is far beyond all gates.
    across : whether the headings of pose i and pose j lie on both sides of π
    """
    given = graphs(rng, len(ends), pairs, noise=0.0, off=0.0)
    given["information"] *= SHARP
    rows, (i, j) = np.arange(len(ends)), np.transpose(ends)
    if across:
        theta = given["poses"][rows, [i, j], 2]
        half = wrap(theta[1] - theta[0]) / 2
        turn = np.outer(wrap(np.pi - half - theta[0]), [0, 0, 1])
        given["poses"] = compose(turn[:, None], given["poses"])
    J = np.array([whitened(*row)[0][:, 3:] for row in zip(*given.values(), strict=True)])
    gates = chi2.ppf(rng.choice(LEVELS, (len(ends), 1)), np.arange(1, 7))
    gates = np.column_stack([np.zeros(len(ends)), gates])
    loops = {"poses": given["poses"], "H": J.mT @ J, "pair": np.array(ends)}
    loops |= {
        "z": np.zeros((len(ends), 3)),
        "information": SHARP * np.array([drawn_information(rng) for _ in ends]),
    }
    bounds = np.column_stack([gates, 2 * gates[:, -1]])[rows[:, None], BOUNDS[rows % len(BOUNDS)]]
    e, seen = sized(rng, 0.02, 0.06, (len(ends), 3)), between(*given["poses"][rows, [i, j]])
    for _ in range(5):  # d² is nearly quadratic in e
        loops = loops | {"z": compose(seen, inverse(e))}
        e = e * np.sqrt(bounds @ [0.4, 0.6] / want(loops)["d2"])[:, None]
    return loops | {"gates": gates}


@once
def terms(given):
    """v (k, 3), J without pose 0 (k, 3, 3n − 3), and Λ_x⁻¹ Jᵀ, of each loop."""
    rows, (i, j) = np.arange(len(given["pair"])), given["pair"].astype(int).T
    ends = given["poses"][rows, i], given["poses"][rows, j], given["z"]
    J = np.zeros((len(rows), given["poses"].shape[1], 3, 3))
    J[rows, i], J[rows, j] = J_i(*ends), J_j(*ends)
    J = J.swapaxes(1, 2).reshape(len(rows), 3, -1)[..., 3:]
    return error(*ends), J, np.linalg.solve(given["H"], J.mT)


@once
def want(given):
    v, J, PJt = terms(given)
    S = J @ PJt + np.linalg.inv(given["information"])
    d2 = np.sum(v * np.linalg.solve(S, v[..., None])[..., 0], axis=1)
    return {"d2": d2}


def _of_loop(given):
    pair, z, information = split(given["loop"]).values()
    d2 = want(given | {"pair": pair, "z": z, "information": information})["d2"]
    return {"d2": d2, "accepted": d2 <= given["gates"][:, 3]}


def _fixed(given):
    """(k,) bool: whether one of the two poses is pose 0."""
    return (given["pair"] == 0).any(axis=1)


def _terms(given):
    v, J, PJt = terms(given)
    return {"v": v, "the part of S that the errors of the graph give": J @ PJt}


_D2 = equals(
    "d2",
    1.5,
    "d2 is vᵀ S⁻¹ v of a loop between two poses that both have errors",
    want,
    asks="Pose i and pose j are both behind an inaccurate turn. By how much does this turn change "
    "pose j in the frame of pose i?",
    step=_terms,
)


def _of(law, rows):
    """A law that holds for rows of another kind."""
    return replace(law, holds=lambda given, out: law.holds(given, out) | ~rows(given))


def _decided(given, out):
    return out["accepted"] == (out["d2"] <= given["gates"][:, 3])


def _why(given, out):
    k = np.flatnonzero(~_decided(given, out))[0]
    says = {0.0: "rejected", 1.0: "accepted"}.get(out["accepted"][k], out["accepted"][k])
    return f"a loop with your d2 of {out['d2'][k]:.4g} is {says}"


def _parts(given, out):
    # a decision can be right for a wrong d2
    return {"d2": out["d2"], "decision": out["accepted"] - (out["d2"] <= given["gates"][:, 3])}


def _plausible(given):
    """Whether all matrices are still positive definite, and d² has the size of the gates."""
    sure = [np.linalg.eigvalsh(given[name])[:, 0] > 0 for name in ("H", "information")]
    gates, d2 = given["gates"], want(given)["d2"]
    clear = np.abs(d2 - gates[:, 3]) > MARGIN * gates[:, 3]
    return np.logical_and.reduce(
        [*sure, clear, d2 < 2 * gates[:, 6], *(np.diff(gates, axis=1) > 0).T]
    )


GATE = Task(
    id="15-gate",
    title="Gating a loop closure",
    call=CALLS["15-gate"],
    inputs=proposals,
    shapes=lambda given: {"d2": (len(given["z"]),), "accepted": (len(given["z"]),)},
    laws=(
        _of(
            replace(
                _D2,
                name="fixed",
                points=1,
                says="d2 is vᵀ S⁻¹ v of a loop from or to pose 0, which is fixed",
                asks="Pose 0 has no error. Which columns of J belong to the other pose, and which "
                "rows of H?",
            ),
            _fixed,
        ),
        _of(_D2, lambda given: ~_fixed(given)),
        Law(
            "accepted",
            0.5,
            "a loop is accepted if d2 is within the gate of its number of degrees of freedom",
            _decided,
            why=_why,
            asks="Of how many independent standard normal numbers is d² the sum of squares, if the "
            "loop is true?",
            step="Print d2 beside all gates, and count the numbers in v.",
            alone=False,
        ),
    ),
    needs=("15-jacobians",),
    references=(Reference("gate_loop", "poses H loop gates", _of_loop, "d2 accepted"),),
    parts=_parts,
    begins=(
        "Which errors does the residual of a true loop contain, and which of them does Λ describe?",
        "How does a small error of each pose change the residual?",
        "Where in H do you find pose i, if the rows of pose 0 are removed?",
    ),
    probes=(
        Probe("two poses and one edge", lambda rng: proposals(rng, [(0, 1)], GRAPH[:1])),
        Probe("headings far from π", lambda rng: proposals(rng, ENDS[::3], across=False)),
        Probe("three poses and two edges", lambda rng: proposals(rng, [(1, 2), (2, 1)], GRAPH[:2])),
        Probe("nine poses", lambda rng: proposals(rng, [(8, 4), (0, 8), (1, 8)], LONG)),
    ),
    may_round=_plausible,
)
