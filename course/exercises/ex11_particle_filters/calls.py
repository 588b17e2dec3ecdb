"""Function calls of exercise 11, particle filters: seeds become generators."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_shaped_array,
)

MOST = 1e8  # clips wrong answers; no right answer is larger
AGAIN = 20  # seeds drawn twice: a single draw may be the same by chance


def call_log_likelihoods(functions, inputs):
    """Call "log_likelihoods" for each scan; return {"logs": (k, n), 0 where not finite,
    "finite": (k, n), 1, or 0 for NaN, −1 for −∞, −2 for ∞}. Raise StudentError for wrong shapes.
    """
    name, call = next(iter(functions.items()))
    logs = np.array(
        [
            to_shaped_array(call(*row), f"{name}'s array", (len(row[0]),))
            for row in argument_rows(inputs)
        ]
    )
    finite = np.select([np.isfinite(logs), logs == -np.inf, logs == np.inf], [1.0, -1.0, -2.0])
    logs = np.where(finite > 0, np.clip(logs, -MOST, MOST), 0.0)
    return {"logs": logs, "finite": finite}


def call_draw(functions, inputs):
    """Call "draw" for each seed; return {"copies": (k, s, n), "again": (k, AGAIN, n)}; "again"
    repeats the first seeds. Raise StudentError unless "draw" returns n indices.
    """
    draw, copies, again = functions["draw"], [], []
    for weights, seeds in argument_rows(inputs):
        calls = [
            _count_copies(draw(weights, np.random.default_rng(int(seed))), len(weights))
            for seed in (*seeds, *seeds[:AGAIN])
        ]
        copies.append(calls[: len(seeds)])
        again.append(calls[len(seeds) :])
    return {"copies": np.array(copies), "again": np.array(again)}


def _count_copies(value, n):
    found = to_shaped_array(value, "draw's array", (n,))
    if not (np.isfinite(found).all() and (found == np.floor(found)).all()):
        raise StudentError("malformed", "draw must return integer indices")
    if found.min() < 0 or found.max() >= n:
        wrong = found.min() if found.min() < 0 else found.max()
        raise StudentError(
            "malformed", f"draw returned the index {wrong:.0f}, expected 0 to {n - 1}"
        )
    return np.bincount(found.astype(int), minlength=n)


def call_localise(functions, inputs):
    """Call "localise" step by step; return {"rows": (k, t, n, 3), "weights": (k, t, n)}.
    Raise StudentError for any other shape.
    """
    found = []
    for rows, weights, us, C, p, zs, R, seed in argument_rows(inputs):
        steps = _run_steps(functions, (rows, weights), us, C, [p] * len(us), zs, R, seed)
        found.append(zip(*steps, strict=True))
    rows, weights = zip(*found, strict=True)
    return {"rows": np.array(rows), "weights": np.array(weights)}


def call_find_again(functions, inputs):
    """Call "find_again" for all runs in turn, so that data which it stores outside its particles is
    from another run. Return {"places": (k, t, n, 2), "weights": (k, t, n)}. Raise StudentError.
    """
    runs = [
        _run_steps(functions, (rows, np.full(len(rows), 1 / len(rows))), *rest)
        for rows, *rest, _ in argument_rows(inputs)
    ]
    in_turn = list(zip(*runs, strict=True))
    places = np.array([[rows[:, :2] for rows, _ in estimates] for estimates in in_turn])
    weights = np.array([[weights for _, weights in estimates] for estimates in in_turn])
    return {"places": places.swapaxes(0, 1), "weights": weights.swapaxes(0, 1)}


def _run_steps(functions, particles, us, C, ps, zs, R, seed):
    name, step = next(iter(functions.items()))
    rng, shapes = np.random.default_rng(int(seed)), [part.shape for part in particles]
    for u, p, z in zip(us, ps, zs, strict=True):
        particles = _check_particles(step(*particles, u, C, p, z, R, rng), name, shapes)
        yield particles


def _check_particles(pair, name, shapes):
    if not isinstance(pair, tuple | list) or len(pair) != 2:
        raise StudentError("malformed", f"{name} must end with: return rows, weights")
    rows, weights = (
        to_shaped_array(part, f"{name}'s {which}", shape)
        for part, which, shape in zip(pair, ("rows", "weights"), shapes, strict=True)
    )
    if not (np.isfinite(rows).all() and np.isfinite(weights).all()):
        raise StudentError("malformed", f"{name} returned NaN or infinity")
    if (weights < 0).any() or not weights.any():
        raise StudentError("malformed", f"{name}'s weights: one weight is negative, or all are 0")
    return rows, weights


CALLS = {
    "11-weigh": FunctionCall(("log_likelihoods",), call_log_likelihoods),
    "11-draw": FunctionCall(("draw",), call_draw),
    "11-localise": FunctionCall(("localise",), call_localise),
    "11-proposal": FunctionCall(("reweigh",)),
    "11-kidnapped": FunctionCall(("find_again",), call_find_again),
}
