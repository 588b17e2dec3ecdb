"""Drives of exercise 11: generators are made from seeds, runs of a filter step by step."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows

MOST = 1e8  # no right answer is larger; how much larger a wrong one is says no more
AGAIN = 20  # seeds drawn twice: one draw comes out the same by chance now and then


def moved(functions, inputs):
    """Call move twice with the same seed, then with another one.

    Parameters
    ----------
    functions : "move"
    inputs : rows (k, n, 3), u (k, 2), C (k, 2, 2), seed (k,)

    Returns
    -------
    {"moved": (k, 3, n, 3)}

    Raises
    ------
    StudentError : "malformed"
    """
    move, found = functions["move"], []
    for samples, u, C, seed in rows(inputs):
        calls = []
        for other in (0, 0, 1):
            rng = np.random.default_rng([int(seed), other])
            calls.append(_shaped(move(samples.copy(), u.copy(), C.copy(), rng), "move", samples))
        found.append(calls)
    return {"moved": np.array(found)}


def weighed(functions, inputs):
    """Call log_likelihoods on every scan; what is not finite is flagged.

    Parameters
    ----------
    functions : "log_likelihoods"
    inputs : rows (k, n, 3), p (k, m, 2), z (k, m, 2), R (k, 2, 2)

    Returns
    -------
    {"logs": (k, n) 0 where not finite, "finite": (k, n)}

    Raises
    ------
    StudentError : "malformed"
    """
    return _flagged(
        _vector(functions["log_likelihoods"](*row), "log_likelihoods", len(row[0]))
        for row in rows(inputs)
    )


def normalised(functions, inputs):
    """Call normalise on logarithms, and on weights of the judge's effective_size.

    Parameters
    ----------
    functions : "normalise", "effective_size"
    inputs : logs (k, n), weights (k, n)

    Returns
    -------
    {"logs": (k, n) weights, 0 where not finite, "finite": (k, n), "sizes": (k,)}

    Raises
    ------
    StudentError : "malformed"
    """
    normalise, effective_size = functions["normalise"], functions["effective_size"]
    weights, sizes = [], []
    for logs, own in rows(inputs):
        weights.append(_vector(normalise(logs), "normalise", len(logs)))
        size = numbers(effective_size(own), "effective_size")
        if size.size != 1:
            raise StudentError(
                "malformed", f"effective_size returned shape {size.shape}, expected one number"
            )
        if not np.isfinite(size).all():
            raise StudentError("malformed", "effective_size returned NaN or infinity")
        sizes.append(size.item())
    return _flagged(weights) | {"sizes": np.array(sizes)}


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
            _copies(draw(weights.copy(), np.random.default_rng(int(seed))), len(weights))
            for seed in (*seeds, *seeds[:AGAIN])
        ]
        copies.append(calls[: len(seeds)])
        again.append(calls[len(seeds) :])
    return {"copies": np.array(copies), "again": np.array(again)}


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
    found = {"rows": [], "weights": []}
    for samples, weights, us, C, p, zs, R, seed in rows(inputs):
        rng, belief, clouds = np.random.default_rng(int(seed)), (samples, weights), []
        for u, z in zip(us, zs, strict=True):
            cloud = (part.copy() for part in belief)
            step = functions["localise"](*cloud, u, C.copy(), p.copy(), z, R.copy(), rng)
            belief = _belief(step, samples)
            clouds.append(belief)
        for name, parts in zip(found, zip(*clouds, strict=True), strict=True):
            found[name].append(np.array(parts))
    return {name: np.array(parts) for name, parts in found.items()}


def _belief(pair, samples):
    if not isinstance(pair, tuple | list) or len(pair) != 2:
        raise StudentError("malformed", "localise: expected a pair, rows and weights")
    rows_, weights = pair
    rows_ = _shaped(rows_, "localise's rows", samples)
    weights = _vector(weights, "localise's weights", len(samples))
    if not (np.isfinite(rows_).all() and np.isfinite(weights).all()):
        raise StudentError("malformed", "localise returned NaN or infinity")
    if (weights < 0).any():
        raise StudentError("malformed", "localise's weights: one is negative")
    return rows_, weights


def _shaped(value, name, like):
    array = numbers(value, name)
    if array.shape != like.shape:
        turned = " (transposed?)" if array.shape == like.shape[::-1] else ""
        raise StudentError(
            "malformed", f"{name} returned shape {array.shape}, expected {like.shape}{turned}"
        )
    return array


def _vector(value, name, n):
    array = numbers(value, name)
    if array.shape != (n,):
        raise StudentError("malformed", f"{name} returned shape {array.shape}, expected ({n},)")
    return array


def _copies(value, n):
    drawn = _vector(value, "draw", n)
    if not (np.isfinite(drawn).all() and (drawn == np.floor(drawn)).all()):
        raise StudentError("malformed", "draw returned other than whole numbers: give indices")
    if drawn.min() < 0 or drawn.max() >= n:
        raise StudentError(
            "malformed", f"draw returned index {drawn.max():.0f} of {n} samples: 0 to {n - 1}"
        )
    return np.bincount(drawn.astype(int), minlength=n)


def _flagged(vectors):
    logs = np.array(list(vectors))
    finite = np.isfinite(logs)
    logs = np.where(finite, np.clip(logs, -MOST, MOST), 0.0)
    return {"logs": logs, "finite": finite.astype(float)}


DRIVES = {
    "11-move": Drive(("move",), run=moved),
    "11-weigh": Drive(("log_likelihoods",), run=weighed),
    "11-normalise": Drive(("normalise", "effective_size"), run=normalised),
    "11-draw": Drive(("draw",), run=drawn),
    "11-localise": Drive(("localise",), run=localised),
}
