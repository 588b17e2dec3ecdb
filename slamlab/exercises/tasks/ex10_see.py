"""Exercise 10, whole sightings: the truth is never outside, and the boxes do shrink."""

from functools import partial
from math import pi

import numpy as np

from slamlab.exercises.drives.ex10 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex10_runs import RUNS, SIGHTS, runs, truth
from slamlab.filters.bor.angle_intervals import midpoint
from slamlab.filters.bor.clipping import clip_all
from slamlab.filters.bor.contraction import contract_heading
from slamlab.filters.bor.half_planes import offset_edge
from slamlab.filters.bor.intervals import width
from slamlab.geometry import wrap

ROUNDING = 1e-7  # [m], [rad]
SHARP = 1.15  # how much wider than ours things may be, on average
UNKNOWN = -1.0
NAMES = "robot", "heading", "object"


def ours(given, **changes):
    """What a filter believes after each sighting, right or with a piece of it changed.

    Parameters
    ----------
    given : of :func:`runs`
    changes : of :func:`_seen`

    Returns
    -------
    dict of arrays as the drive brings them back
    """
    found = {name: np.zeros((RUNS, SIGHTS, n)) for name, n in zip(NAMES, (4, 2, 4), strict=True)}
    found["left"] = np.zeros((RUNS, SIGHTS))
    for run in range(RUNS):
        robot, heading = given["robot"][run].tolist(), given["heading"][run].tolist()
        objects = given["objects"][run].tolist()
        for k, i in enumerate(given["which"][run]):
            after = _seen(
                robot, heading, objects[i], given["z"][run, k], given["bounds"][run], **changes
            )
            if after is None or after[1] is None:
                # from a heading of which nothing is left others may go on otherwise
                found["left"][run, k:] = 0 if after is None else UNKNOWN
                break
            robot, heading, objects[i] = after
            for name, value in zip(NAMES, after, strict=True):
                found[name][run, k] = value
            found["left"][run, k] = 1
    return found


def _seen(
    robot, heading, box, z, bounds, guard=True, turned=pi, clips="both", sharpens="always", by=None
):
    """One sighting: object, robot, heading.

    guard : bool, leave boxes alone from a right angle on; turned : float, by what the sighting is
    turned for the robot; clips : "both", "object" or "robot"; sharpens : the heading
    "always", "never" or "near", below a right angle;
    by : "own", the robot's edges are pushed by the robot's box
    """
    direction, d_abs = midpoint(heading) + z[1], bounds[1] + width(heading) / 2
    if d_abs < pi / 2 or not guard:
        new = clip_all(box, _lines(z, bounds, direction, d_abs, robot)) if clips != "robot" else box
        if new is None:
            return None
        around, box = robot if by == "own" else new, new
        if clips != "object":
            robot = clip_all(robot, _lines(z, bounds, direction + turned, d_abs, around))
        if robot is None:
            return None
    if sharpens == "always" or (sharpens == "near" and d_abs < pi / 2):
        heading = contract_heading(heading, robot, box, z, bounds)
    return robot, heading, box


def _lines(z, bounds, direction, d_abs, around):
    """Far, near, left and right edge, whatever d_abs."""
    (r, _), (dr, _) = z, bounds
    normals = direction, direction + pi, direction + d_abs + pi / 2, direction - d_abs - pi / 2
    out = r + dr, -(r - dr) * np.cos(d_abs), 0.0, 0.0
    return [
        offset_edge(np.cos(angle), np.sin(angle), c, around)
        for angle, c in zip(normals, out, strict=True)
    ]


def _never_outside(given, out):
    """Pose and object are inside after every sighting of each run."""
    pose, places = truth(given)
    seen = places[np.arange(RUNS)[:, None], given["which"].astype(int)]
    right, left = np.moveaxis(out["heading"], -1, 0)
    wide = np.mod(left - right + ROUNDING, 2 * pi) - ROUNDING
    wide = np.where(left - right >= 2 * pi - ROUNDING, 2 * pi, wide)
    turn = np.mod(pose[:, None, 2] - right + ROUNDING, 2 * pi)
    ok = _inside(out["robot"], pose[:, None, :2]) & _inside(out["object"], seen)
    return (ok & (turn <= wide + 2 * ROUNDING) & (out["left"] > 0)).all(axis=1)


def _inside(box, point):
    low, high = box[..., ::2] - ROUNDING, box[..., 1::2] + ROUNDING
    return ((low <= point) & (point <= high)).all(axis=-1)


def _as_sharp(given, out):
    """After the last sighting nothing is much wider than ours, over all runs."""
    right = ours(given)
    sizes = [
        [(last[:, 1::2] - last[:, ::2]).mean() for last in (found[name][:, -1] for name in NAMES)]
        for found in (out, right)
    ]
    return bool(
        (out["left"] > 0).all() and (np.array(sizes[0]) <= SHARP * np.array(sizes[1])).all()
    )


def _is(given, out, **changes):
    """Whether the answer is what the filter with these changes gives, as far as it comes."""
    wrong = ours(given, **changes)
    far, known = wrong["left"] > 0, wrong["left"] != UNKNOWN
    turn = wrap(out["heading"][far] - wrong["heading"][far])
    alike = [np.abs(out[name] - wrong[name])[far] for name in ("robot", "object")]
    ends = (out["left"][known] == wrong["left"][known]).all()
    return ends and all((np.abs(off) < 1e-6).all() for off in (turn, *alike))


def _mistake(name, hint, **changes):
    return Diagnosis(name, hint, partial(_is, **changes))


SEE = Task(
    id="10-see",
    title="A whole sighting",
    drive=DRIVES["10-see"],
    inputs=runs,
    shapes={
        "robot": (RUNS, SIGHTS, 4),
        "heading": (RUNS, SIGHTS, 2),
        "object": (RUNS, SIGHTS, 4),
        "left": (RUNS, SIGHTS),
    },
    laws=(
        Law("guarantee", 2, "robot, heading and object are never outside", _never_outside),
        Law("sharp", 1, "robot, heading and objects are narrowed down as they can be", _as_sharp),
    ),
    diagnoses=(
        _mistake(
            "no-guard",
            "The boxes are clipped where d_abs ≥ π/2, too. There four half-planes cut off places "
            "that are possible: leave both boxes as they are, the heading may still be sharpened.",
            guard=False,
        ),
        Diagnosis(
            "robot-cut-away",
            "Nothing is left of the robot's box as soon as it is cut. The robot is seen from the "
            "object: the edges are pushed by the object's new box, and look the other way, "
            "heading + π.",
            lambda given, out: _is(given, out, turned=0.0) or _is(given, out, by="own"),
        ),
        _mistake(
            "robot-left",
            "The robot's box comes back as it was. The sighting says where the robot can be, too.",
            clips="object",
        ),
        _mistake(
            "object-left",
            "The object's box comes back as it was.",
            clips="robot",
        ),
        _mistake(
            "heading-left",
            "The heading comes back as it was: sharpen it by the two boxes.",
            sharpens="never",
        ),
        _mistake(
            "heading-waits",
            "Where d_abs ≥ π/2 the heading comes back as it was. Only the edges fail there: the "
            "boxes still say which bearings are possible.",
            sharpens="near",
        ),
        Diagnosis(
            "none",
            "see returned None for a sighting that fits. Is there a return at its end? Or did some "
            "clip leave nothing of a box: then look which edges, from which box, clip which box.",
            lambda given, out: bool((out["left"] == 0).any()),
        ),
    ),
    needs=("10-edges", "10-clip", "10-heading"),
)
