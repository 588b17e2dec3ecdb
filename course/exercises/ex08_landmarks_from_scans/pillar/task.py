"""Task 08-pillar: a circle by linear least squares, and the circle with the most inliers."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law, equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex08_landmarks_from_scans.calls import CALLS
from course.exercises.ex08_landmarks_from_scans.lines import across, direction

BAND, LARGEST, NEEDED = 0.04, 0.5, 16  # [m], [m]
TRIES = 60
"""A guess gets the whole pillar with a chance of 0.29 or more where 30 of 42 readings are of it:
that
none of these many does is less likely than 1e-8. Elsewhere the number is chosen alike."""
CLEAR = 2 * LARGEST + 2 * BAND
"""No reading of a wall is nearer to the pillar [m]: no circle that may be found has readings of
both."""
NEAR = 0.12, 0.18
"""So far off the circle are the other readings about a pillar, within and without [m]: no circle
that
has the whole arc within the band has one of these."""
GUESSES = 300  # of the judge's own, which are always the same


def arcs(rng, n, k, noise=0.01, half=1.3, radius=(0.25, 0.45), away=(1.5, 4.0)):
    """Readings (n, k, 2) of the visible side of pillars, their centres (n, 2), radii (n,)."""
    bearing, r = rng.uniform(-np.pi, np.pi, n), rng.uniform(*radius, n)
    centre = rng.uniform(*away, (n, 1)) * direction(bearing)
    turn = np.linspace(-half, half, k) + rng.uniform(-0.5, 0.5, (n, k)) * half / k
    off = r[:, None] + noise * rng.uniform(-1, 1, (n, k))
    return centre[:, None] - off[..., None] * direction(bearing[:, None] + turn), centre, r


def _wall(rng, centre, radius, k):
    bearing = np.arctan2(centre[1], centre[0]) + rng.uniform(-0.4, 0.4)
    rho = centre @ direction(bearing) + radius + CLEAR + rng.uniform(0.0, 0.4)
    normal = direction(bearing)
    along = centre @ across(normal) + np.linspace(-1.6, 1.6, k) + rng.uniform(-0.05, 0.05, k)
    return rho * normal + along[:, None] * across(normal) + rng.uniform(-0.01, 0.01, (k, 2))


def clouds(rng, kinds, tries=TRIES, arc=7, near=NEAR, radius=(0.25, 0.45)):
    """Shuffled readings, and arcs; ``kinds`` counts per cloud those of the pillar, of a wall, and
    of others (low, high) ``near`` the circle [m]."""
    points, needed = [], []
    for on, behind, loose in kinds:
        pillar, (centre,), (size,) = arcs(rng, 1, max(on, 1), noise=0.0015, radius=radius)
        seen = np.arctan2(*-centre[::-1]) + rng.uniform(-0.7, 0.7, loose)
        off = rng.choice([-1.0, 1.0], (loose, 1)) * rng.uniform(*near, (loose, 1))
        others = centre + (size + off) * direction(seen)
        points.append(
            rng.permutation(np.vstack([pillar[0, :on], _wall(rng, centre, size, behind), others]))
        )
        needed.append(float(min(NEEDED, max(len(points[-1]), 3))))
    n = len(kinds)
    return {
        "arc": arcs(rng, n, arc)[0],
        "points": np.array(points),
        "band": np.full(n, BAND),
        "largest": np.full(n, LARGEST),
        "needed": np.array(needed),
        "tries": np.full(n, float(tries)),
        "seed": rng.integers(0, 2**31, n).astype(float),
    }


def mixed(rng):
    """Clouds with and without a pillar."""
    return clouds(rng, [(30, 8, 4)] * 4 + [(0, 32, 10)] * 2)


def _across_the_band(rng):
    """Readings at a distance of 0.75 bands from the circle, and others just beyond the band."""
    # Beside each of these, two lie within on the other side of the circle, too far away for one
    # band to hold them all: no circle has as many inliers as the pillar's own.
    found = clouds(rng, [(24, 0, 18)] * 2, 230)
    for points in found["points"]:
        pillar, (centre,), (radius,) = arcs(rng, 1, 24, noise=0.0)
        seen = np.arctan2(*-centre[::-1]) + np.linspace(-1, 1, 6) + rng.uniform(-0.1, 0.1, 6)
        side = rng.permutation([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
        at = np.concatenate([seen - 0.02, seen + 0.02, seen])
        off = BAND * np.concatenate([-0.75 * side, -0.75 * side, 1.35 * side])
        others = centre + (radius + off)[:, None] * direction(at)
        points[:] = rng.permutation(np.vstack([pillar[0], others]))
    return found


def _few(rng):
    # of fewer than three points no circle can be made
    return clouds(rng, [(2, 0, 0)] * 2)


def _at_the_edge(rng):
    # another circle has other inliers
    return clouds(rng, [(24, 0, 16)] * 4, near=(0.8 * BAND, 1.2 * BAND))


def _at_the_limit(rng):
    # hypotheses are below and above `largest`, the refitted circle is above
    found = clouds(rng, [(30, 8, 0)] * 2)
    outputs = {"inside": most(found)}
    return found | {"largest": np.array([r for _, _, r in _refits(found, outputs)]) - 1e-4}


def _by_turns(rng):
    # no two of the pillar's readings are neighbours
    found = clouds(rng, [(24, 24, 0)] * 2, 230)
    for points, inside in zip(found["points"], most(found), strict=True):
        points[::2], points[1::2] = points[inside], points[~inside]
    return found


def _on_a_grid(rng):
    # the wall's readings are exactly collinear
    found = clouds(rng, [(30, 0, 0)] * 2, 90)
    wall = np.column_stack([np.full(20, 6.0), np.arange(-10, 10) * 0.5])
    found["points"] = np.concatenate([found["points"], np.tile(wall, (2, 1, 1))], axis=1)
    return found


def circles(points):
    """Centres and radii (n, 3), least squares of 2 c·p + d = |p|² for points (n, k, 2)."""
    middle = points.mean(axis=1, keepdims=True)  # to solve it there is the same, and rounds less
    p = points - middle
    A = np.concatenate([2 * p, np.ones((*p.shape[:2], 1))], axis=-1)
    c = np.einsum("nik,nk->ni", np.linalg.pinv(A, rcond=1e-9), np.square(p).sum(axis=-1))
    radius = np.sqrt(np.maximum(c[:, 2] + np.square(c[:, :2]).sum(axis=-1), 0))
    return np.column_stack([c[:, :2] + middle[:, 0], radius])


def _through(three):
    a, b = three[:, 1] - three[:, 0], three[:, 2] - three[:, 0]
    twice = 2 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])  # 0 on one line: then nothing is near
    aa, bb = (np.square(side).sum(axis=1, keepdims=True) for side in (a, b))
    with np.errstate(all="ignore"):
        centre = (across(a) * bb - across(b) * aa) / twice[:, None]
    return three[:, 0] + centre, np.linalg.norm(centre, axis=1)


@once
def most(inputs):
    """Inliers (n, k) bool of the circle with most; none where too few."""
    rng, found = np.random.default_rng(8), []
    for points, band, largest, needed in zip(
        *(inputs[name] for name in ("points", "band", "largest", "needed")), strict=True
    ):
        inside = np.zeros((1, len(points)), dtype=bool)
        if len(points) >= 3:
            three = rng.random((GUESSES, len(points))).argsort(axis=1)[:, :3]
            centre, radius = _through(points[three])
            off = np.linalg.norm(points - centre[:, None], axis=-1) - radius[:, None]
            inside = (np.abs(off) <= band) & (radius <= largest)[:, None]
        best = inside[inside.sum(axis=1).argmax()]
        found.append(best & (best.sum() >= needed))
    return np.array(found)


def _found(inputs):
    inside = most(inputs).astype(float)
    return {"found": inside.any(axis=1).astype(float), "inside": inside}


def _refits(inputs, outputs):
    """Per cloud the circle of the returned inliers."""
    for points, inside in zip(inputs["points"], outputs["inside"].astype(bool), strict=True):
        yield circles(points[None, inside])[0] if inside.sum() >= 3 else np.full(3, np.inf)


def _refitted(inputs, outputs):
    """Whether a found circle fits its own inliers, and None stands only where no pillar is."""
    pairs = zip(_refits(inputs, outputs), outputs["pillar"], strict=True)
    good = np.array([np.abs(best - circle).max() < 1e-6 for best, circle in pairs])
    return np.where(outputs["found"] > 0, good, ~most(inputs).any(axis=1))


def _why_not(inputs, outputs):
    k = np.flatnonzero(~_refitted(inputs, outputs))[0]
    circle, best = outputs["pillar"][k], [*_refits(inputs, outputs)][k]
    if not outputs["found"][k]:
        return "The scan contains a pillar, but your result is None."
    if not np.isfinite(best).all():
        count = outputs["inside"][k].sum()
        return f"inside has {count:.0f} readings, but a circle needs at least three."
    own, fitted = (f"({x:.3f}, {y:.3f}) m and {r:.3f} m" for x, y, r in (circle, best))
    return f"Centre and radius are {own}, but the fit to your points inside gives {fitted}."


def _judged_again(inputs, outputs):
    """Whether every inside is that of the refitted circle, and some circle is not its fit."""
    centre, radius = outputs["pillar"][:, None, :2], outputs["pillar"][:, 2:]
    off = np.linalg.norm(inputs["points"] - centre, axis=-1) - radius
    same = (np.abs(off) <= inputs["band"][:, None]) == outputs["inside"]
    return same.all() and not _refitted(inputs, outputs)[outputs["found"] > 0].all()


def _unknown(inputs):
    x, y, radius = circles(inputs["arc"]).T
    return {"d [m²]": radius**2 - x**2 - y**2}


def _inliers(inputs):
    return {"inliers of the best hypothesis (0: no pillar)": most(inputs).sum(axis=1)}


PILLAR = Task(
    id="08-pillar",
    title="RANSAC for a round pillar",
    call=CALLS["08-pillar"],
    inputs=mixed,
    shapes=lambda inputs: {
        "circle": (len(inputs["arc"]), 3),
        "found": inputs["points"].shape[:1],
        "pillar": (len(inputs["points"]), 3),
        "inside": inputs["points"].shape[:2],
    },
    laws=(
        equals(
            "circle",
            1.5,
            "fit_circle solves 2 c·p + d = |p|² for c and d by least squares",
            lambda inputs: {"circle": circles(inputs["arc"])},
            asks="Which coefficients do c_x, c_y and d have in the equation of one point? How do "
            "you compute the radius from c and d?",
            step=_unknown,
        ),
        equals(
            "inside",
            2,
            "inside is True for all readings of the pillar, and for no others",
            _found,
            asks="Which hypotheses do you reject, and which of the others is the best? How far "
            "from its circle may an inlier be?",
            after=("circle",),
            step=_inliers,
        ),
        Law(
            "refitted",
            1,
            "centre and radius are the result of fit_circle for the points inside",
            _refitted,
            why=_why_not,
            asks="A sample has three readings. To which readings do you fit the final circle?",
            after=("circle", "inside"),
            step=_inliers,
        ),
    ),
    probes=(
        Probe("three points", lambda rng: clouds(rng, [(3, 0, 0)] * 6, tries=1, arc=3)),
        Probe("fewer than three points", _few, ("inside", "refitted")),
        Probe("a wall exactly on one line", _on_a_grid, ("inside", "refitted")),
        Probe(
            "more readings of a wall than of the pillar",
            lambda rng: clouds(rng, [(24, 26, 0)], 230),
        ),
        Probe("a pillar and a wall whose readings alternate", _by_turns, ("inside", "refitted")),
        Probe("a pillar of the largest radius", _at_the_limit, ("inside", "refitted")),
        Probe("readings near the limits of the band", _at_the_edge, ("refitted",)),
        Probe(
            "a thin pillar",
            lambda rng: clouds(rng, [(30, 8, 0)] * 2, radius=(0.05, 0.07)),
            ("inside", "refitted"),
        ),
        Probe(
            "many readings near the pillar",
            # about a small one, a circle within it may have more readings than it
            lambda rng: clouds(rng, [(24, 0, 16)] * 2, 120, radius=(0.35, 0.45)),
        ),
        Probe("a hundred readings", lambda rng: clouds(rng, [(75, 21, 4)], 48, arc=100)),
        Probe(
            "a pillar with exactly as many readings as needed",
            lambda rng: clouds(rng, [(16, 2, 2)], 40),
        ),
        Probe(
            "a pillar with one reading fewer than needed", lambda rng: clouds(rng, [(15, 3, 2)], 40)
        ),
        Probe("readings just inside and just outside the band", _across_the_band),
    ),
    may_round=False,
    diagnoses=(
        Diagnosis(
            "inside-judged-again",
            "Refit, then report the readings to which you refitted: do not compute the inliers "
            "again.",
            _judged_again,
            "readings near the limits of the band",
            asks="To which readings did you refit the circle, and which ones are True in inside?",
        ),
    ),
    begins=(
        "Which equation does a reading at (1, 0) give for c_x, c_y and d?",
        "How many readings determine a circle? How do you draw so many different "
        "readings with rng?",
    ),
)
