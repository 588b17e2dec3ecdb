"""Classic mistakes in a map of little filters, computed on the same sightings."""

import numpy as np

from slamlab import models
from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex05_batch import deviations, gain, placed, same_covariance
from slamlab.geometry import wrap
from slamlab.models import jacobians


def each_landmark(inputs, estimate):
    """An estimate from each landmark's own sightings: (xs, zs, R) -> p, P."""
    p, P = [], []
    for xs, ids, zs, R in runs_of(inputs):
        found = [estimate(xs[ids == id], zs[ids == id], R) for id in np.unique(ids)]
        p.append([one[0] for one in found])
        P.append([one[1] for one in found])
    return np.array(p), np.array(P)


def runs_of(inputs):
    """xs, ids, zs and R of each run."""
    return zip(*(inputs[name] for name in ("xs", "ids", "zs", "R")), strict=True)


def little_filter(xs, zs, R, first=placed, start=1, keep_P=False):
    """One landmark's filter over its sightings, with what can be done wrong in it."""
    p, P = (part[0] for part in first(xs[:1], zs[:1], R[None]))
    for x, z in zip(xs[start:], zs[start:], strict=True):
        p, after = _corrected(p, P, x, z, R)
        P = P if keep_P else after
    return p, P


def _corrected(p, P, x, z, R):
    v = z - models.h(x, p)
    v[1] = wrap(v[1])
    K, S = (part[0] for part in gain(P[None], jacobians.H_landmark(x, p)[None], R[None]))
    return p + K @ v, P - K @ S @ K.T


def raw_R(xs, zs, R):
    """A new landmark that takes R for its P."""
    return placed(xs, zs, R)[0], R


def pose_of_start(inputs):
    """Inputs as if all had been seen from the first pose."""
    return inputs | {"xs": np.broadcast_to(inputs["xs"][:, :1], inputs["xs"].shape)}


def all_updated(inputs):
    """Maps whose every known landmark is corrected by every sighting."""
    p, P = [], []
    for xs, ids, zs, R in runs_of(inputs):
        beliefs = {}
        for x, id, z in zip(xs, ids.tolist(), zs, strict=True):
            known = list(beliefs) if id in beliefs else []
            if not known:
                beliefs[id] = tuple(part[0] for part in placed(x[None], z[None], R[None]))
            for other in known:
                beliefs[other] = _corrected(*beliefs[other], x, z, R)
        p.append([beliefs[id][0] for id in sorted(beliefs)])
        P.append([beliefs[id][1] for id in sorted(beliefs)])
    return np.array(p), np.array(P)


def made_by(name, hint, maps_of):
    """A diagnosis: the maps are what another procedure makes."""

    def matches(inputs, outputs):
        p, P = maps_of(inputs)
        near = np.abs(outputs["p"] - p) <= 1e-3 * deviations(P)
        return near.all() and same_covariance(outputs["P"], P).all()

    return Diagnosis(name, hint, matches)


def by_each(**changes):
    return lambda i: each_landmark(i, lambda *seen: little_filter(*seen, **changes))
