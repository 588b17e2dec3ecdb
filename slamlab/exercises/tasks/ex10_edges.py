"""Exercise 10, edges: each line touches the places that may be seen, and cuts off none of them."""

import numpy as np

from slamlab.exercises.drives.ex10 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex10_motions import boxes

ROWS = 24
CLOSE = 1e-4  # [m]
FINE = 401  # odd: the middle direction is tried, too


def inputs(rng):
    """Sightings of every direction, d_abs well below a right angle."""
    right = rng.uniform(-np.pi, np.pi, ROWS)
    return {
        "z": np.column_stack([rng.uniform(1.5, 4, ROWS), rng.uniform(-2.5, 2.5, ROWS)]),
        "bounds": np.column_stack([rng.uniform(0.1, 0.4, ROWS), rng.uniform(0.05, 0.2, ROWS)]),
        "heading": np.column_stack([right, right + rng.uniform(0.3, 0.9, ROWS)]),
        "box": boxes(rng, ROWS, low=0.1, high=0.4),
    }


def sighting(given):
    """Direction and d_abs, (n,) each [rad]."""
    right, left = given["heading"].T
    return (right + left) / 2 + given["z"][:, 1], (left - right) / 2 + given["bounds"][:, 1]


def normals(direction, d_abs):
    """(n, 4, 2) where far, near, left and right edge point to."""
    turned = [direction, direction + np.pi, direction + d_abs + np.pi / 2]
    turned.append(direction - d_abs - np.pi / 2)
    angles = np.stack(turned, axis=1)
    return np.stack([np.cos(angles), np.sin(angles)], axis=-1)


def places(given):
    """(n, k, 2) what may be seen from the box's corners, by trying."""
    direction, d_abs = sighting(given)
    angle = np.linspace(direction - d_abs, direction + d_abs, FINE, axis=-1)
    r = given["z"][:, :1] + given["bounds"][:, :1] * [-1, 1]
    u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    seen = (r[:, :, None, None] * u[:, None]).reshape(len(r), -1, 2)
    x, y = given["box"][:, [0, 0, 1, 1]], given["box"][:, [2, 3, 2, 3]]
    corners = np.stack([x, y], axis=-1)
    return (corners[:, :, None] + seen[:, None]).reshape(len(r), -1, 2)


def unit(rows):
    """Half-planes (n, 4, 3) with normals of length one."""
    return rows / np.hypot(rows[..., :1], rows[..., 1:2])


def _point_out(given, out):
    return np.abs(unit(out["result"])[..., :2] - normals(*sighting(given))).max(axis=(1, 2)) < CLOSE


def _touches(*which):
    """A law: these edges are moved out just as far as the places that may be seen."""

    def holds(given, out):
        rows = unit(out["result"])[:, which]
        farthest = np.einsum("nki,nei->nek", places(given), rows[..., :2]).max(axis=2)
        return (np.abs(rows[..., 2] - farthest) < CLOSE).all(axis=1)

    return holds


# ---- mistakes: the wrong formula, computed on the same inputs --------------------------------


def formed(given, direction=None, d_abs=None, pushed="out", near="cos", far=None):
    """The four edges, right or with a piece of them changed."""
    right_direction, right_d = sighting(given)
    direction = right_direction if direction is None else direction
    d_abs = right_d if d_abs is None else d_abs
    n = normals(direction, d_abs)
    (r, _), (dr, _) = given["z"].T, given["bounds"].T
    nearest = {"cos": (r - dr) * np.cos(d_abs), "plain": r - dr, "plus": (r + dr) * np.cos(d_abs)}
    c = np.zeros((len(r), 4))
    c[:, 0] = (r + dr) if far is None else far(r, dr, d_abs)
    c[:, 1] = -nearest[near]
    return np.concatenate([n, (c + _push(given["box"], n, pushed))[..., None]], axis=2)


def _push(box, n, how):
    """(n, 4) by how much each edge is moved by the box."""
    if how == "not":
        return 0.0
    if how == "middle":
        return np.einsum("nei,ni->ne", n, np.column_stack([box[:, :2].mean(1), box[:, 2:].mean(1)]))
    ends = [n[..., [k]] * box[:, None, 2 * k : 2 * k + 2] for k in (0, 1)]
    pick = np.max if how == "out" else np.min
    return sum(pick(each, axis=2) for each in ends)


def _as_degrees(given):
    direction, d_abs = sighting(given)
    return formed(given, np.radians(direction), np.radians(d_abs))


def _inside_out(given):
    return -formed(given)


def answers_with(*formulas):
    """Whether the result is what one of these formulas gives, lengths of normals left aside."""

    def matches(given, out):
        rows = unit(out["result"])
        return any(np.allclose(rows, unit(wrong(given)), atol=1e-4) for wrong in formulas)

    return matches


def _with(**changes):
    return lambda given: formed(given, **{k: v(given) for k, v in changes.items()})


EDGES = Task(
    id="10-edges",
    title="The edges of a sighting",
    drive=DRIVES["10-edges"],
    inputs=inputs,
    shapes={"result": (4, 3)},
    laws=(
        Law("normals", 1, "far, near, left and right point out, in this order", _point_out),
        Law("far", 1, "the far edge touches the farthest place that may be seen", _touches(0)),
        Law("near", 2, "the near edge touches the nearest place and cuts off none", _touches(1)),
        Law("sides", 1, "left and right touch what may be seen, cutting none off", _touches(2, 3)),
    ),
    diagnoses=(
        Diagnosis(
            "near-without-cosine",
            "The near edge stands at r − d_r and cuts off the two ends of the inner arc: they come "
            "nearer, to (r − d_r) cos d_abs.",
            answers_with(lambda g: formed(g, near="plain")),
        ),
        Diagnosis(
            "near-plus",
            "The near edge is made from r + d_r: nothing beyond the far edge would be allowed.",
            answers_with(lambda g: formed(g, near="plus")),
        ),
        Diagnosis(
            "far-cosine",
            "The far edge has a cosine: straight ahead the arc reaches r + d_r itself. Only the "
            "near edge has to stand back.",
            answers_with(lambda g: formed(g, far=lambda r, dr, d: (r + dr) * np.cos(d))),
        ),
        Diagnosis(
            "not-pushed",
            "These are the edges as seen from the origin. The robot stands anywhere in its box: "
            "push each edge out by the most that a·x + b·y can be there.",
            answers_with(lambda g: formed(g, pushed="not")),
        ),
        Diagnosis(
            "pushed-by-middle",
            "The edges are those seen from the middle of the box. From its other points more may "
            "be seen: push by the farthest point, another one for each edge.",
            answers_with(lambda g: formed(g, pushed="middle")),
        ),
        Diagnosis(
            "pulled-in",
            "The edges are moved by the least of a·x + b·y over the box: what is seen from its far "
            "points is cut off. Take the most.",
            answers_with(lambda g: formed(g, pushed="in")),
        ),
        Diagnosis(
            "inside-out",
            "Every edge allows just what it should forbid: (a, b) must point out of the region, "
            "with a x + b y ≤ c allowed.",
            answers_with(_inside_out),
        ),
        Diagnosis(
            "sides-exchanged",
            "Left and right have changed places: left is counter-clockwise, at direction + d_abs.",
            answers_with(lambda g: formed(g)[:, [0, 1, 3, 2]]),
        ),
        Diagnosis(
            "heading-width-forgotten",
            "The half-width is d_β alone. The heading is not known either: d_abs = d_β + half of "
            "left − right.",
            answers_with(_with(d_abs=lambda g: g["bounds"][:, 1])),
        ),
        Diagnosis(
            "whole-width",
            "The heading's whole width is added to d_β: d_θ is half of it, as it counts from the "
            "middle.",
            answers_with(_with(d_abs=lambda g: g["bounds"][:, 1] + np.ptp(g["heading"], axis=1))),
        ),
        Diagnosis(
            "bound-forgotten",
            "The half-width is the heading's alone: the bearing is off by d_β, too.",
            answers_with(_with(d_abs=lambda g: np.ptp(g["heading"], axis=1) / 2)),
        ),
        Diagnosis(
            "heading-forgotten",
            "The edges look along the bearing, which counts from the robot's heading: in the world "
            "the direction is heading + bearing.",
            answers_with(_with(direction=lambda g: g["z"][:, 1])),
        ),
        Diagnosis(
            "degrees",
            "The angles are in radians already, and np.cos wants radians.",
            answers_with(_as_degrees),
        ),
    ),
)
