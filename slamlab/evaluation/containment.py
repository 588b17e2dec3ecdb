"""Containment of the truth in the boxes, which set-membership estimation guarantees."""

from slamlab.filters.set_membership.angle_intervals import contains


def inside(box, point):
    """Whether a point (2,) [m] is inside a box (x_min, x_max, y_min, y_max) [m]."""
    return box[0] <= point[0] <= box[1] and box[2] <= point[1] <= box[3]


def outside(bor, pose, landmarks):
    """List the parts of the true state that are outside their boxes or interval. Returns a list of
    "robot", "heading" and ids.

    Parameters
    ----------
    bor : BOR
    pose : (3,) the true pose [m, m, rad]
    landmarks : (n, 2) the true landmarks; their ids are the rows [m]
    """
    found = [] if inside(bor.robot.tolist(), pose) else ["robot"]
    found += [] if contains(bor.heading.tolist(), pose[2]) else ["heading"]
    boxes = zip(bor.ids, bor.boxes().tolist(), strict=True)
    return found + [i for i, box in boxes if not inside(box, landmarks[i])]
