"""The task of exercise 07 about what is learned of a landmark out of sight: hearsay."""

import numpy as np

from slamlab.exercises.drives.ex07 import DRIVES
from slamlab.exercises.law import Law, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex07.beliefs import EXACT, covariances


def _drawn(rng, n=8, size=9, seen=4, shared=True, exact=False, news=True, scale=1):
    """States, which entries were in sight, and what sights of these alone made of them."""
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
    """Each entry follows those in sight as it always did; what does not follow them stays.

    x + G (x_seen − x_s) and P − G (P_ss − P_seen) Gᵀ, where G x_s is the best guess of x from x_s.
    """
    x, P = inputs["x"].copy(), inputs["P"].copy()
    for row, s in enumerate(inputs["seen"].astype(int)):
        own = P[row][np.ix_(s, s)]
        G = np.linalg.solve(own, P[row][s]).T
        x[row] += G @ (inputs["x_seen"][row] - x[row, s])
        P[row] -= G @ (own - inputs["P_seen"][row]) @ G.T
    return {"x": x, "P": P}


def _follows(inputs):
    """G, by which the state follows the entries in sight."""
    P, seen = inputs["P"], inputs["seen"].astype(int)
    pairs = zip(P, seen, strict=True)
    return {"P of all with those in sight": np.array([P[:, s] for P, s in pairs])}


@once
def _blocks(inputs, outputs):
    """x and P, the entries in sight first: x, what P says of them, of them and the rest, the
    rest."""
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
    """Whether these blocks are as wanted, row by row."""

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


HEARSAY = Task(
    id="07-hearsay",
    title="What one hears of a landmark out of sight",
    drive=DRIVES["07-hearsay"],
    inputs=_drawn,
    shapes=lambda inputs: {
        "x": (None, inputs["x"].shape[1]),
        "P": (None, *inputs["P"].shape[1:]),
    },
    probes=(
        Probe("a single entry in sight", lambda rng: _drawn(rng, 3, seen=1)),
        Probe("all entries in sight", lambda rng: _drawn(rng, 3, seen=9)),
        Probe("a state of two entries", lambda rng: _drawn(rng, 3, size=2, seen=1)),
        Probe("a state of 23 entries", lambda rng: _drawn(rng, 2, size=23, seen=7)),
        Probe("large numbers", lambda rng: _drawn(rng, 3, scale=30)),
        Probe("P_seen = 0", lambda rng: _drawn(rng, 3, exact=True)),
        Probe("no news", lambda rng: _drawn(rng, 3, news=False)),
        Probe("a rest that shares nothing", lambda rng: _drawn(rng, 3, shared=False)),
    ),
    laws=(
        # x follows as after an exact sight of the entries: an update pasted here has it right
        Law(
            "means",
            0.5,
            "x follows: those in sight are as told, the others move as far as they share their "
            "error",
            _same("x"),
            want=_wanted("x"),
            asks="A landmark's error and the robot's are known to go together. The robot turns "
            "out to "
            "be 10 cm further left: where is the landmark now to be expected?",
            step=_follows,
        ),
        Law(
            "cross",
            2,
            "P of those in sight is as told, and what the others share with them shrinks alike",
            _same("seen", "cross"),
            want=_wanted("P"),
            asks="If an entry is G times those in sight, plus something that shares nothing with "
            "them: "
            "what is its covariance with them?",
            step=_follows,
        ),
        Law(
            "rest",
            2,
            "the others grow surer by just what was learned, seen through what they share",
            _same("rest"),
            want=_wanted("P"),
            asks="Those in sight grew surer by P_ss − P_seen. What does G make of that?",
            step=_follows,
        ),
    ),
    parts=_blocks,
    rounds=False,  # P_seen belongs to P: rounded apart they are no belief before and after
)
