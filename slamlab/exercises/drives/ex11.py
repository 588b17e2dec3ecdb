"""Drives of exercise 11: generators are made from seeds, runs of a filter step by step."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, rows, shaped

MOST = 1e8  # no right answer is larger; how much larger a wrong one is says no more
AGAIN = 20  # seeds drawn twice: one draw comes out the same by chance now and then


def weighed(functions, inputs):
    """Call log_likelihoods on every scan; what is not finite is flagged: NaN 0, −∞ −1, ∞ −2.

    Parameters
    ----------
    functions : "log_likelihoods"
    inputs : rows (k, n, 3), p (k, m, 2), z (k, m, 2), R (k, 2, 2)

    Returns
    -------
    {"logs": (k, n) 0 where not finite, "finite": (k, n) 1 or the flag}

    Raises
    ------
    StudentError : "malformed"
    """
    name, call = next(iter(functions.items()))
    logs = np.array([shaped(call(*row), f"{name}'s array", (len(row[0]),)) for row in rows(inputs)])
    finite = np.select([np.isfinite(logs), logs == -np.inf, logs == np.inf], [1.0, -1.0, -2.0])
    logs = np.where(finite > 0, np.clip(logs, -MOST, MOST), 0.0)
    return {"logs": logs, "finite": finite}


def drawn(functions, inputs):
    """Call draw for every seed, and once more for the first of them.

    Parameters
    ----------
    functions : "draw"
    inputs : weights (k, n), seeds (k, s)

    Returns
    -------
    {"copies": (k, s, n) how often each was drawn, "again": (k, AGAIN, n) the first seeds anew}

    Raises
    ------
    StudentError : "malformed" when a call returns other than n indices
    """
    draw, copies, again = functions["draw"], [], []
    for weights, seeds in rows(inputs):
        calls = [
            _copies(draw(weights, np.random.default_rng(int(seed))), len(weights))
            for seed in (*seeds, *seeds[:AGAIN])
        ]
        copies.append(calls[: len(seeds)])
        again.append(calls[len(seeds) :])
    return {"copies": np.array(copies), "again": np.array(again)}


def _copies(value, n):
    found = shaped(value, "draw's array", (n,))
    if not (np.isfinite(found).all() and (found == np.floor(found)).all()):
        raise StudentError("malformed", "draw returned other than whole numbers: give indices")
    if found.min() < 0 or found.max() >= n:
        wrong = found.min() if found.min() < 0 else found.max()
        raise StudentError(
            "malformed", f"draw returned index {wrong:.0f} of {n} samples: 0 to {n - 1}"
        )
    return np.bincount(found.astype(int), minlength=n)


def localised(functions, inputs):
    """Call localise on every run, step by step.

    Parameters
    ----------
    functions : "localise"
    inputs : rows (k, n, 3), weights (k, n), us (k, t, 2), C (k, 2, 2), p (k, m, 2),
        zs (k, t, m, 2), R (k, 2, 2), seed (k,)

    Returns
    -------
    {"rows": (k, t, n, 3), "weights": (k, t, n)}

    Raises
    ------
    StudentError : "malformed" when a step does not return samples and weights
    """
    found = []
    for samples, weights, us, C, p, zs, R, seed in rows(inputs):
        steps = _steps(functions, (samples, weights), us, C, [p] * len(us), zs, R, seed)
        found.append(zip(*steps, strict=True))
    samples, weights = zip(*found, strict=True)
    return {"rows": np.array(samples), "weights": np.array(weights)}


def kept(functions, inputs):
    """Call find_again on all runs in turn, step by step, beginning with equal weights.

    So what a step has kept elsewhere than in its samples is of another run.

    Parameters
    ----------
    functions : "find_again"
    inputs : rows (k, n, 3), us (k, t, 2), C (k, 2, 2), ps (k, t, 1, 2), zs (k, t, 1, 2),
        R (k, 2, 2), seed (k,), world (k,)

    Returns
    -------
    {"places": (k, t, n, 2), "weights": (k, t, n)}

    Raises
    ------
    StudentError : "malformed" when a step does not return samples and weights
    """
    runs = [
        _steps(functions, (samples, np.full(len(samples), 1 / len(samples))), *told)
        for samples, *told, _ in rows(inputs)
    ]
    in_turn = list(zip(*runs, strict=True))
    places = np.array([[samples[:, :2] for samples, _ in beliefs] for beliefs in in_turn])
    weights = np.array([[weights for _, weights in beliefs] for beliefs in in_turn])
    return {"places": places.swapaxes(0, 1), "weights": weights.swapaxes(0, 1)}


def _steps(functions, belief, us, C, ps, zs, R, seed):
    """Yield the samples (n, 3) and weights (n,) after each step of one run."""
    name, step = next(iter(functions.items()))
    rng, shapes = np.random.default_rng(int(seed)), [part.shape for part in belief]
    for u, p, z in zip(us, ps, zs, strict=True):
        belief = _belief(step(*belief, u, C, p, z, R, rng), name, shapes)
        yield belief


def _belief(pair, name, shapes):
    if not isinstance(pair, tuple | list) or len(pair) != 2:
        raise StudentError("malformed", f"{name} must end with: return rows, weights")
    samples, weights = (
        shaped(part, f"{name}'s {which}", shape)
        for part, which, shape in zip(pair, ("rows", "weights"), shapes, strict=True)
    )
    if not (np.isfinite(samples).all() and np.isfinite(weights).all()):
        raise StudentError("malformed", f"{name} returned NaN or infinity")
    if (weights < 0).any() or not weights.any():
        raise StudentError("malformed", f"{name}'s weights: one is negative, or all are zero")
    return samples, weights


DRIVES = {
    "11-weigh": Drive(("log_likelihoods",), weighed),
    "11-draw": Drive(("draw",), drawn),
    "11-localise": Drive(("localise",), localised),
    "11-proposal": Drive(("reweigh",)),
    "11-kidnapped": Drive(("find_again",), kept),
}
