"""Task 02-beam: the log-likelihood of a scan by the beam model."""

import numpy as np
from scipy.special import ndtr

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex02_sensors_and_worlds.calls import CALLS

HIT, SHORT, NONE, RANDOM = range(4)
TOLERANCE = 1e-6
ROUGHLY = 0.3  # a wrong density is judged elsewhere; one that underflows is off by far more
ANY = (0.2, 0.5)  # least and largest weight of a part before normalisation


def scans(rng, count=6, beams=9, parts=(HIT, SHORT, NONE, RANDOM), error=(0.1, 0.5), off=1.0):
    """Scans of ``beams`` readings, by causes that ``parts`` lists. error : σ / range;
    off : factor of the noise of hits.
    """
    weights = np.zeros((count, 4))
    weights[:, list(parts)] = rng.uniform(*ANY, (count, len(parts)))
    weights /= weights.sum(axis=1, keepdims=True)
    most, error = rng.uniform(4, 8, count), rng.uniform(*error, count)
    rate, wall = rng.uniform(0.3, 2, count), most[:, None] * rng.uniform(0.1, 0.97, (count, beams))
    cause = rng.permuted(np.resize(parts, (count, beams)), axis=1)
    noise = np.clip(rng.standard_normal((count, beams)), -2, 2)
    hit = wall + off * error[:, None] * wall * noise
    beyond = (hit <= 0.02) | (hit >= 0.98 * most[:, None])  # no reading is at an end
    hit = np.where(beyond, wall - 0.3 * error[:, None] * wall, hit)
    short = wall * rng.uniform(0.05, 0.9, wall.shape)
    anywhere = most[:, None] * rng.uniform(0.05, 0.95, wall.shape)
    read = np.select(
        [cause == HIT, cause == SHORT, cause == RANDOM], [hit, short, anywhere], np.nan
    )
    return {
        "ranges": read,
        "expected": wall,
        "weights": weights,
        "error": error,
        "rate": rate,
        "range_max": most,
    }


def _far(rng):
    """Readings dozens of σ from the wall, which only the Gaussian explains."""
    i = scans(rng, 4, 6, (HIT, NONE), (0.01, 0.01), 0.5)
    seen = np.isfinite(i["ranges"])
    return i | {"ranges": np.where(seen, i["expected"] * rng.uniform(0.3, 0.7, seen.shape), np.nan)}


def _impossible(rng):
    """No return, with the weight 0; a reading beyond the wall, where only short is left."""
    lost, long = scans(rng, 2, 5, (HIT, RANDOM)), scans(rng, 2, 5, (SHORT, NONE))
    lost["ranges"][:, 2] = np.nan
    long["ranges"][:, 1] = (long["expected"][:, 1] + long["range_max"]) / 2
    return {name: np.concatenate([lost[name], long[name]]) for name in lost}


@once
def densities(i):
    """Logarithms of the densities of hit, short, random (3, k, n), of the weights (4, k, 1)."""
    r, wall, most = i["ranges"], i["expected"], i["range_max"][:, None]
    sigma, rate = i["error"][:, None] * wall, i["rate"][:, None]
    inside = ndtr((most - wall) / sigma) - ndtr(-wall / sigma)
    hit = -0.5 * ((r - wall) / sigma) ** 2 - np.log(np.sqrt(2 * np.pi) * sigma * inside)
    short = np.log(rate) - rate * r - np.log(-np.expm1(-rate * wall))
    random = np.where(np.isnan(r), np.nan, -np.log(most))
    with np.errstate(divide="ignore"):
        weights = np.log(i["weights"]).T[:, :, None]
    return np.stack([hit, np.where(r > wall, -np.inf, short), random]), weights


def want(i):
    parts, weights = densities(i)
    lost = np.isnan(i["ranges"])
    logs = np.where(lost, weights[[NONE]], weights[[HIT, SHORT, RANDOM]] + parts)
    beams = np.where(lost, weights[NONE], np.logaddexp.reduce(logs, axis=0))
    log = beams.sum(axis=1)
    finite = np.where(np.isfinite(log), 1.0, -1.0)
    return {"log": np.where(finite > 0, log, 0.0), "finite": finite}


def _step(i):
    parts, weights = densities(i)
    names = ("hit", "short", "random")
    shown = {f"density of {name}": np.exp(part) for name, part in zip(names, parts, strict=True)}
    return shown | {"log of all weights": weights[..., 0].T}


def _law(name, points, says, asks, **more):
    more = {"main": False, "tolerance": TOLERANCE, "step": _step} | more
    return equals(name, points, says, want, asks=asks, **more)


def _only(part, **more):
    return lambda rng: scans(rng, 4, 5, (part,), **more)


def _promised(i):
    """Weights sum to one, and no reading is at an end of a density."""
    r, wall, most = i["ranges"], i["expected"], i["range_max"][:, None]
    apart = (r > 0.01) & (r < most - 0.01) & (abs(r - wall) > 1e-6) | np.isnan(r)
    walls = (wall > 0.1) & (wall < most)
    sums = abs(i["weights"].sum(axis=1) - 1) < 1e-9
    return (apart & walls).all(axis=1) & sums & (i["error"] > 0) & (i["rate"] > 0)


MIXED = ("mixture",)

BEAM = Task(
    id="02-beam",
    title="The likelihood of a scan",
    call=CALLS["02-beam"],
    inputs=scans,
    shapes=lambda i: {"log": i["error"].shape, "finite": i["error"].shape},
    laws=(
        _law(
            "hit",
            1,
            "a scan of hits alone has the right log-likelihood",
            "How large is the integral of your density over all readings from 0 to `range_max`, if "
            "the wall is close to `range_max`, and if `error` is 0.5?",
        ),
        _law(
            "short",
            1,
            "a scan of objects in front of the wall has the right log-likelihood",
            "By which factor does your density decrease over one metre? How large is its integral "
            "from 0 to the wall, and what is the density behind it?",
        ),
        _law(
            "mixture",
            1.5,
            "a scan with all four causes has the right log-likelihood",
            "A beam has one cause, but you do not know which. And all beams of a scan occur "
            "together. Where do you add probabilities, and where do you multiply them?",
            main=True,
            after=("hit", "short"),
        ),
        _law(
            "far",
            1,
            "the log-likelihood is finite and nearly right if the likelihood is zero as a float",
            "What is np.exp(-1000) as a float? Which of your intermediate results are so small?",
            tolerance=ROUGHLY,
        ),
        _law(
            "impossible",
            0.5,
            "the log-likelihood is −∞ if a reading is impossible, and only then",
            "What is the product of 0 and the logarithm of 0 as floats? What should it be here?",
            alone=False,
        ),
    ),
    probes=(
        Probe("hits alone", _only(HIT), ("hit",)),
        Probe("hits alone, of an accurate sensor", _only(HIT, error=(0.005, 0.02)), ("hit",)),
        Probe("short ranges alone", _only(SHORT), ("short",)),
        Probe("no return at all", _only(NONE), MIXED),
        Probe("random ranges alone", _only(RANDOM), MIXED),
        Probe("one beam", lambda rng: scans(rng, 4, 1), MIXED),
        Probe("no beam", lambda rng: scans(rng, 2, 0), MIXED),
        Probe("readings far from the wall", _far, ("far",)),
        Probe("two thousand beams", lambda rng: scans(rng, 2, 2000), ("far",)),
        Probe("impossible readings", _impossible, ("impossible",)),
    ),
    parts=lambda i, o: {"log": np.arcsinh(o["log"]), "finite": o["finite"]},  # small logs count
    may_round=_promised,
    begins=(
        "Take a single beam that has no return. What is its probability?",
        "Take a single reading, of a sensor whose only cause is hit. Which density has it, and "
        "over which readings must the integral of this density be one?",
    ),
)
