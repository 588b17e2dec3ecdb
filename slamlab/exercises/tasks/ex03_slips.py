"""Classic mistakes in the whole filter, recognised by running the filter with a line changed."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks import ex03_laws as law


def filtered(i, step):
    """x (drives, steps, n) and P (steps, n, n) of a filter, all drives at once.

    Parameters
    ----------
    i : inputs
    step : (inputs, x, P, z) -> belief to go on with, belief to report
    """
    x, P = np.tile(i["x"], (len(i["z"]), 1)), i["P"]
    xs, Ps = [], []
    for k in range(i["z"].shape[1]):
        (x, P), (told_x, told_P) = step(i, x, P, i["z"][:, k])
        xs.append(told_x)
        Ps.append(told_P)
    return np.stack(xs, axis=1), np.array(Ps)


def _predict(i, x, P):
    return x @ i["F"].T, i["F"] @ P @ i["F"].T + i["Q"]


def _update(i, x, P, z):
    S = i["H"] @ P @ i["H"].T + i["R"]
    K = P @ i["H"].T @ np.linalg.inv(S)
    return x + (z - x @ i["H"].T) @ K.T, P - K @ S @ K.T


def _right(i, x, P, z):
    return (_update(i, *_predict(i, x, P), z),) * 2


def _update_first(i, x, P, z):
    return (_predict(i, *_update(i, x, P, z)),) * 2


def _update_first_told(i, x, P, z):
    updated = _update(i, x, P, z)
    return _predict(i, *updated), updated


def _prediction_told(i, x, P, z):
    predicted = _predict(i, x, P)
    return _update(i, *predicted, z), predicted


def _never_updated(i, x, P, z):
    return (_predict(i, x, P),) * 2


def _never_predicted(i, x, P, z):
    return (_update(i, x, P, z),) * 2


def _begins_again(i, x, P, z):
    return _right(i, np.tile(i["x"], (len(x), 1)), i["P"], z)


def _P_begins_again(i, x, P, z):
    return _right(i, x, i["P"], z)


def _P_never_updated(i, x, P, z):
    x, P = _predict(i, x, P)
    return ((_update(i, x, P, z)[0], P),) * 2


def _x_not_moved(i, x, P, z):
    return (_update(i, x, _predict(i, x, P)[1], z),) * 2


def _Q_forgotten(i, x, P, z):
    return (_update(i, x @ i["F"].T, i["F"] @ P @ i["F"].T, z),) * 2


def _as(*steps):
    """Whether the answer is that of the filter with one of these steps."""

    def matches(i, o):
        for step in steps:
            xs, Ps = filtered(i, step)
            if law.close(o["x"], xs).all() and law.close(o["P"], Ps[None]).all():
                return True
        return False

    return matches


def _one_object(i, o):
    """The same array put into the list again and again, and changed in place."""
    return any(np.ptp(o[name], axis=1).max() == 0 for name in ("x", "P"))


def _start_told(i, o):
    xs, _ = filtered(i, _right)
    return np.allclose(o["x"][:, 0], i["x"]) and np.allclose(o["x"][:, 1:], xs[:, :-1])


MISTAKES = (
    Diagnosis(
        "start-told",
        "The start stands first and the last belief is missing: tell the belief after each "
        "measurement.",
        _start_told,
    ),
    Diagnosis(
        "wrong-order",
        "The first measurement was taken in before the first step. The start is the belief "
        "before the cart moves: predict first, then update.",
        _as(_update_first, _update_first_told),
    ),
    Diagnosis(
        "predictions-told",
        "These are the predictions. Tell the beliefs after each update.",
        _as(_prediction_told),
    ),
    Diagnosis(
        "never-updated",
        "No measurement has entered: predict only. Update with each row of zs.",
        _as(_never_updated),
    ),
    Diagnosis(
        "never-predicted",
        "The cart stands still in your filter: predict before each update.",
        _as(_never_predicted),
    ),
    Diagnosis(
        "begins-again",
        "Each step begins with the start again. Go on with the belief of the step before.",
        _as(_begins_again, _P_begins_again),
    ),
    Diagnosis(
        "P-never-updated",
        "x goes on from update to update, and P is only predicted: it grows and grows. Keep "
        "both results of the update.",
        _as(_P_never_updated),
    ),
    Diagnosis(
        "x-not-moved",
        "P is predicted and x is not: x has to be moved by F in each step, too.",
        _as(_x_not_moved),
    ),
    Diagnosis(
        "Q-forgotten",
        "Q is missing in the prediction: the filter grows surer and surer, and stops to listen.",
        _as(_Q_forgotten),
    ),
    Diagnosis(
        "one-object",
        "All your beliefs are the same: a list holds the same array again and again, and it "
        "was changed in place. Write x = x + …, not x += …, or append a copy.",
        _one_object,
    ),
)
