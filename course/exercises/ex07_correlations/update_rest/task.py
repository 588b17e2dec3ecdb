"""Task of exercise 07: update of landmarks that are not measured, by their correlations."""

import numpy as np

from classroom.exercises.correctness_laws import Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex07_correlations.beliefs import EXACT, covariances
from course.exercises.ex07_correlations.calls import CALLS


def _drawn(rng, n=8, size=9, seen=4, shared=True, exact=False, news=True, scale=1):
    inputs = {
        "x": rng.uniform(-6, 6, (n, size)),
        "P": covariances(rng, scale * rng.uniform(0.1, 1, (n, size))),
        "seen": np.array([rng.permutation(size)[:seen] for _ in range(n)], dtype=float),
    }
    after = {"x_seen": np.zeros((n, seen)), "P_seen": np.zeros((n, seen, seen))}
    for row in range(n):
        s = inputs["seen"][row].astype(int)
        if not shared:
            rest = np.setdiff1d(np.arange(size), s)
            inputs["P"][row][np.ix_(s, rest)] = inputs["P"][row][np.ix_(rest, s)] = 0
        P = inputs["P"][row][np.ix_(s, s)]
        H = rng.standard_normal((seen + 1, seen)) * news
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + rng.uniform(0.05, 0.3) * np.eye(seen + 1))
        found = (np.eye(seen) - K @ H) @ P * (not exact)
        after["P_seen"][row] = (found + found.T) / 2
        spread = np.linalg.cholesky(P) if news else 0 * P
        after["x_seen"][row] = inputs["x"][row, s] + spread @ rng.standard_normal(seen)
    return inputs | after


def _heard(inputs):
    """x + G (x_seen − x_s) and P − G (P_ss − P_seen) Gᵀ, with G = P_xs P_ss⁻¹."""
    x, P = inputs["x"].copy(), inputs["P"].copy()
    for row, s in enumerate(inputs["seen"].astype(int)):
        own = P[row][np.ix_(s, s)]
        G = np.linalg.solve(own, P[row][s]).T
        x[row] += G @ (inputs["x_seen"][row] - x[row, s])
        P[row] -= G @ (own - inputs["P_seen"][row]) @ G.T
    return {"x": x, "P": P}


def _follows(inputs):
    P, seen = inputs["P"], inputs["seen"].astype(int)
    pairs = zip(P, seen, strict=True)
    return {"P of all entries with those in view": np.array([P[:, s] for P, s in pairs])}


@once
def _blocks(inputs, outputs):
    k, size = inputs["seen"].shape[1], inputs["x"].shape[1]
    order = [np.r_[s, np.setdiff1d(np.arange(size), s)] for s in inputs["seen"].astype(int)]
    x = np.array([x[o] for x, o in zip(outputs["x"], order, strict=True)])
    P = np.array([P[np.ix_(o, o)] for P, o in zip(outputs["P"], order, strict=True)])
    return {
        "x": x,
        "seen": P[:, :k, :k],
        "cross": np.concatenate(
            [P[:, :k, k:].reshape(len(P), -1), P[:, k:, :k].reshape(len(P), -1)], 1
        ),
        "rest": P[:, k:, k:],
    }


def _same(*parts):
    def holds(inputs, outputs):
        got, want = _blocks(inputs, outputs), _blocks(inputs, _heard(inputs))
        # in units of the whole: where everything is in sight a block may be empty or 0
        whole = (
            np.abs(inputs["x" if parts == ("x",) else "P"])
            .reshape(len(inputs["x"]), -1)
            .max(axis=1)
        )
        off = np.hstack([np.abs(got[p] - want[p]).reshape(len(whole), -1) for p in parts])
        return off.max(axis=1, initial=0) <= EXACT * whole

    return holds


def _wanted(name):
    return lambda inputs: {name: _heard(inputs)[name]}


UPDATE_REST = Task(
    id="07-update-rest",
    title="Update of landmarks that are not measured",
    call=CALLS["07-update-rest"],
    inputs=_drawn,
    shapes=lambda inputs: {
        "x": (None, inputs["x"].shape[1]),
        "P": (None, *inputs["P"].shape[1:]),
    },
    probes=(
        Probe("a single entry in view", lambda rng: _drawn(rng, 3, seen=1)),
        Probe("all entries in view", lambda rng: _drawn(rng, 3, seen=9)),
        Probe("a state of two entries", lambda rng: _drawn(rng, 3, size=2, seen=1)),
        Probe("a state of 23 entries", lambda rng: _drawn(rng, 2, size=23, seen=7)),
        Probe("large numbers", lambda rng: _drawn(rng, 3, scale=30)),
        Probe("P_seen = 0", lambda rng: _drawn(rng, 3, exact=True)),
        Probe("nothing measured", lambda rng: _drawn(rng, 3, news=False)),
        Probe(
            "other entries that are uncorrelated with those in view",
            lambda rng: _drawn(rng, 3, shared=False),
        ),
    ),
    laws=(
        # x follows as after an exact sight of the entries: an update pasted here has it right
        Law(
            "means",
            0.5,
            "the entries of x in view are x_seen, and the others change by G times the change of "
            "the entries in view",
            _same("x"),
            want=_wanted("x"),
            asks="The errors of a landmark and of the robot are correlated. The robot's estimate "
            "is corrected by 10 cm. By how much is the landmark's estimate corrected, and which "
            "covariances determine this, those before or those after the measurements?",
            step=_follows,
        ),
        Law(
            "cross",
            2,
            "P of the entries in view is P_seen, and their cross-covariance with the others is G "
            "P_seen",
            _same("seen", "cross"),
            want=_wanted("P"),
            asks="The error of an entry is G times the errors in view, plus a remainder that is "
            "uncorrelated with them. What is the cross-covariance of this error with the errors "
            "in view?",
            step=_follows,
        ),
        Law(
            "rest",
            2,
            "the covariance of the others decreases by G (P_ss − P_seen) Gᵀ",
            _same("rest"),
            want=_wanted("P"),
            asks="The covariance of the entries in view decreased by P_ss − P_seen. By how much "
            "does the covariance of G x̃_s decrease?",
            step=_follows,
        ),
    ),
    parts=_blocks,
    may_round=False,  # P_seen belongs to P: rounded apart they are no belief before and after
    begins=(
        "The errors of two numbers are correlated. One of the errors turns out to be 1. Which "
        "value do you expect for the other?",
        "Which blocks of P describe the entries in view, the others, and both together?",
    ),
)
