# %% [markdown]
# # Exercise 10 · Boxes
#
# **You will be able to** write the pieces of a filter that does not lose the truth: the box after a drive, the
# edges of a sighting, and the heading over the seam. You will derive what is left of a box by a sensor that
# measures nothing but a range, and find out how small boxes can be made without losing anything.
#
# **60 minutes. Before:** lesson [10 · Boxes](../notebooks/10_boxes.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below it, as
# often as you like. A check tries random inputs and inputs at the edges of what the text promises. Where a law is
# broken it shows a small input that breaks it, and `hint("10-predict")` in a cell of your own leads on.
#
# All lengths are in metres, all angles in radians. A **box** is `[x_min, x_max, y_min, y_max]`, and it may be a single
# point. A **heading** is `[right, left]`: every direction that one meets going counter-clockwise from right to
# left. `right` lies in $(-\pi, \pi]$; `left` is not less than `right`, and may be more than $\pi$. A
# sighting is `z = [r, β]`. Its range is off by at most $d_r$ and its bearing by at most $d_\beta$, together
# `bounds = [d_r, d_β]`. Arguments are arrays of floats, or numbers. No function may change the arrays it is given, because
# whoever called it still needs them.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import ask, attempt, check
from slamlab.geometry import wrap
from slamlab.layers import Boxes, Points

# %% [markdown]
# ## 1 · The box after a drive
#
# A robot is somewhere in `box`, and its heading $\theta$ anywhere from right to left. It drives a distance $d$, from
# `way[0]` to `way[1]`, in the direction $\theta + \delta$, with $\delta$ from `direction[0]` to `direction[1]`. By (10.3)
#
# $$x' = x + d\cos(\theta+\delta),\qquad y' = y + d\sin(\theta+\delta).$$
#
# **Your task.** Return the smallest box that holds every place where the robot may be afterwards. The distance may be
# negative, when the robot backs. Any of the intervals may have no width; heading and direction together may be wider than
# a whole turn; and a direction may be several turns, such as 14 rad. It helps to write a function
# `cosine_range(low, high)` first. How do you get the sine's from it?


# %%
def predict(box, heading, way, direction):
    """The box after a drive.

    box : (4,) x_min, x_max, y_min, y_max [m];  heading : (2,) right, left [rad]
    way : (2,) low, high [m];  direction : (2,) low, high, relative to the heading [rad]
    returns (4,) x_min, x_max, y_min, y_max [m]
    """
    ### BEGIN SOLUTION

    def cosine_range(low, high):
        def met(angle):
            return (angle - low) % (2 * np.pi) <= high - low

        ends = np.cos([low, high])
        return (-1 if met(np.pi) else ends.min(), 1 if met(0) else ends.max())

    low, high = heading[0] + direction[0], heading[1] + direction[1]
    cosines, sines = cosine_range(low, high), cosine_range(low - np.pi / 2, high - np.pi / 2)
    dx, dy = np.outer(way, cosines), np.outer(way, sines)
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
    ### END SOLUTION


# %%
check("10-predict")

# %% [markdown]
# These are 500 drives and your box. No point may lie outside, and there should be points near each side.


# %%
@attempt
def _():
    rng, heading, way = np.random.default_rng(1), (-0.7, 0.5), (0.8, 1.2)
    box = predict(np.zeros(4), np.array(heading), np.array(way), np.zeros(2))
    w, theta = rng.uniform(*zip(way, heading, strict=True), (500, 2)).T
    fig, ax = views.axes("500 drives", size=(8, 5))
    ends = np.column_stack([w * np.cos(theta), w * np.sin(theta)])
    views.draw(ax, Points("sample", ends), label="samples")
    views.draw(ax, Boxes("your box", [box]))
    views.legend(ax)
    views.show(fig, alt=f"{len(w)} end points of drives on an arc and your box round them.")


# %% [markdown]
# ## 2 · The edges of a sighting
#
# The robot sees an object at `z`, off by at most `bounds`. Its heading is known up to
# `[right, left]`, so it looks in the `direction` that is the middle of the heading plus $\beta$, and by (10.5) that
# is off by at most $d_{\mathrm{abs}} = d_\beta + (\text{left} - \text{right})/2$.
#
# The places where the object may be lie between four **edges**. *Far* and *near* stand at a right angle to
# `direction`; *left* and *right* are the rays at `direction` $\pm\, d_{\mathrm{abs}}$. An edge is a row
# `[a, b, c]`. It allows the places with $a x + b y \le c$, and its vector $(a, b)$, the lesson's $n$, points out.
#
# A sketch helps. Draw the sector of a ring, and its near edge. But the robot is not at one point; it is somewhere in its
# box. Which point of the box decides how far each edge must be pushed out?
#
# **Your task.** Return four rows, for far, near, left and right in this order, pushed out for the robot's box.
# Here $d_{\mathrm{abs}}$ is well below $\pi/2$, and $r$ is not less than $d_r$. Bounds may be 0, and the heading
# may be known exactly. The length of $(a, b)$ does not matter.


# %%
def edges(z, bounds, heading, box):
    """The edges of all places that may be seen so from somewhere in a box.

    z : (2,) range [m], bearing [rad];  bounds : (2,) the most that they are off
    heading : (2,) right, left [rad];  box : (4,) of the robot [m]
    returns (4, 3) rows a, b, c of far, near, left, right; a x + b y <= c is allowed
    """
    ### BEGIN SOLUTION
    direction = (heading[0] + heading[1]) / 2 + z[1]
    d_abs = bounds[1] + (heading[1] - heading[0]) / 2
    left, right = direction + d_abs, direction - d_abs
    rows = np.array(
        [
            [np.cos(direction), np.sin(direction), z[0] + bounds[0]],
            [-np.cos(direction), -np.sin(direction), -(z[0] - bounds[0]) * np.cos(d_abs)],
            [-np.sin(left), np.cos(left), 0],
            [np.sin(right), -np.cos(right), 0],
        ]
    )
    for row in rows:
        a, b, _ = row
        row[2] += max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])
    return rows
    ### END SOLUTION


# %%
check("10-edges")


# %% [markdown]
# These are your edges round four sectors, one from each corner of the robot's box. The shaded sides are
# forbidden, and nothing orange may lie in them.


# %%
@attempt
def _():
    box, z, bounds = np.array([-0.3, 0.3, -0.2, 0.2]), np.array([2.5, 0.3]), np.array([0.3, 0.1])
    heading = np.array([-0.1, 0.5])
    lines = edges(z, bounds, heading, box)
    direction, d_abs = heading.mean() + z[1], bounds[1] + 0.3
    fig, ax = views.boxes.scene("Your edges", (-1.6, 4.8, -1, 3.2), size=(8, 5.6))
    for corner in [(x, y) for x in box[:2] for y in box[2:]]:
        ring = (2.2, 2.8), (direction - d_abs, direction + d_abs)
        views.boxes.sector(ax, corner, *ring, alpha=0.2)
    views.draw(ax, Boxes("robot", [box]))
    views.boxes.edges(ax, lines, ("far", "near", "left", "right"))
    views.legend(ax, loc="upper left")
    views.show(fig, alt="Four pieces of rings between your four edges.")


# %% [markdown]
# ## 3 · The heading
#
# Wherever the robot is in its box and the object in its own, the bearing in the world from the one to the other lies
# between two extremes. The robot has measured the bearing relative to its heading, as `bearing`, off by at most `bound`. What
# does (10.10) leave of the heading?
#
# The extreme bearings are among those that lead from a corner of one box to a corner of the other.

# %%
ask(
    "ex10-west",
    "The object is due west of the robot, and the bearings that lead from box to box run from 3.1 "
    "through $\\pi$ to −3.1. **How is this written as an interval `[right, left]`?**",
    {
        "[−3.1, 3.1]": "that is nearly the whole round: every direction that one meets going counter-clockwise from "
        "−3.1, through 0, to 3.1.",
        "[3.1, −3.1]": "counter-clockwise from 3.1 is right, but left is not to be less than right.",
        "[3.1, 3.18]": "counter-clockwise from 3.1, and −3.1 is 3.18 on the same turn.",
        "[−3.18, −3.1]": "these are the right directions, but right has to lie above −π.",
    },
    right="[3.1, 3.18]",
)

# %% [markdown]
# **Your task.** Return the heading after the sighting, `[right, left]`; where the boxes overlap it is what it was. Boxes
# either overlap or are clearly apart; they never just touch. The sighting agrees with the heading, and what they have in
# common is one piece, never two. The bearing lies in $(-\pi, \pi]$. You have `wrap`: compare angles only after you have
# counted them from one of them.


# %%
def sharpen(heading, robot, box, bearing, bound):
    """The heading after a sighting.

    heading : (2,) right, left [rad];  robot, box : (4,) the robot's and the object's box [m]
    bearing, bound : float, measured relative to the heading, and the most it is off [rad]
    returns (2,) right, left [rad]
    """
    ### BEGIN SOLUTION
    apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]
    if not apart:
        return heading
    seen = [
        np.arctan2(v - y, u - x)
        for x in robot[:2]
        for y in robot[2:]
        for u in box[:2]
        for v in box[2:]
    ]
    off = [wrap(angle - seen[0]) for angle in seen]
    right, left = seen[0] + min(off) - bearing - bound, seen[0] + max(off) - bearing + bound
    # both intervals on the same turn: their middles less than half a turn apart
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    return np.array([max(heading[0], right + turns), min(heading[1], left + turns)])
    ### END SOLUTION


# %%
check("10-heading")

# %% [markdown]
# ## 4 · A range alone
#
# A radio beacon is timed, or an echo is. Either tells how far away the object is, and nothing about its direction. The range is
# `r`, off by at most `bound`. Now the possible places fill a whole ring, and there is no direction across which an edge
# could stand. Yet the question behind (10.9) can be asked here as well: *which point leaves most room?*
#
# Let $(\Delta x, \Delta y)$ be the object's place minus the robot's. All that the range says is
#
# $$(r - d_r)^2 \;\le\; \Delta x^2 + \Delta y^2 \;\le\; (r + d_r)^2,$$
#
# with `bound` for $d_r$, and with 0 for $r - d_r$ if that is negative. The two boxes say between which numbers
# $\Delta x$ lies, and $\Delta y$ independently of it.

# %%
ask(
    "ex10-ring",
    "A robot stands at the origin, and the range is exactly 2 m. The object is known to be in the box "
    "$-3 \\le x \\le 3$, $0 \\le y \\le 1$. **Which is the smallest box that is left?**",
    {
        "$-3 \\le x \\le 3$, $0 \\le y \\le 1$: a range has no direction": "nothing is known of its direction. But nothing that is 3 m to the side is 2 m away.",
        "$-2 \\le x \\le 2$, $0 \\le y \\le 1$": "two pieces of the circle cross the box, one on either side, and one box has to hold both.",
        "$1.73 \\le x \\le 2$, $0 \\le y \\le 1$": "so it is on the right. But on the left the circle crosses the box as well.",
    },
    right="$-2 \\le x \\le 2$, $0 \\le y \\le 1$",
)

# %% [markdown]
# For which $\Delta y$ can $|\Delta x|$ be largest, and for which can it be smallest? Some $\Delta x$ are negative and
# some positive, and the robot's place is not known. What does that make of the object's $x$?
#
# **Your task.** Return the smallest box round all places of `box` that have such a distance from some place of
# `robot`, or `None` where there is no such place. The two boxes may overlap. `r` and `bound` are not
# negative, and `r` may be less than `bound`. Circles never just touch a box, so it is always clear what is left.


# %%
def ring(robot, box, r, bound):
    """What a range leaves of an object's box.

    robot, box : (4,) x_min, x_max, y_min, y_max of the robot and of the object [m]
    r, bound : float, the range, and the most that it is off [m]
    returns (4,) [m], or None where nothing is left
    """
    ### BEGIN SOLUTION
    near, far = max(r - bound, 0), r + bound

    def apart(k):
        low, high = box[k] - robot[k + 1], box[k + 1] - robot[k]
        return max(0, low, -high), max(-low, high)

    def left_along(k, across):
        least, most = apart(across)
        if least > far:
            return None
        # most is left for |dx| where |dy| is least, and the least of it where |dy| is most
        outer, inner = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - most**2, 0))
        sides = (robot[k] - outer, robot[k + 1] - inner), (robot[k] + inner, robot[k + 1] + outer)
        pieces = [(max(low, box[k]), min(high, box[k + 1])) for low, high in sides]
        kept = [(low, high) for low, high in pieces if low <= high]
        return (kept[0][0], kept[-1][1]) if kept else None

    x, y = left_along(0, 2), left_along(2, 0)
    return None if x is None or y is None else np.array([*x, *y])
    ### END SOLUTION


# %%
check("10-ring")

# %% [markdown]
# A ring crosses this box twice. The dots are places that agree with the range for some place of the robot. None may lie
# outside of what you keep, and there should be dots near each side.


# %%
@attempt
def _():
    rng, robot, box = np.random.default_rng(4), [-0.3, 0.3, -0.2, 0.2], [-2.6, 2.8, 0.6, 1.6]
    kept = ring(np.array(robot), np.array(box), 2.0, 0.1)
    stands, place = (rng.uniform(b[::2], b[1::2], (20_000, 2)) for b in (robot, box))
    agree = place[np.abs(np.hypot(*(place - stands).T) - 2.0) <= 0.1]
    fig, ax = views.boxes.scene("Your ring", (-3.6, 3.8, -1.2, 3.4), size=(8, 5.4))
    views.draw(ax, Points("sample", agree), label="samples")
    views.draw(ax, Boxes("robot", [robot]))
    views.draw(ax, Boxes("before", [box]))
    if kept is not None:
        views.draw(ax, Boxes("after", [kept]), color=views.COLOURS["corrected"], linewidth=2.5)
    views.legend(ax, loc="upper right")
    views.show(
        fig, alt="Places on two arcs within a box, and the smaller box that your ring returns."
    )


# %% [markdown]
# ## 5 · As small as can be
#
# A robot stands somewhere in its box and looks round once. It sees objects whose places are known
# exactly. `look` takes in the sightings one after the other, as the lesson does. The robot's box is cut by the edges seen from
# the object, that is with the heading turned by $\pi$; then the heading is sharpened. Where $d_{\mathrm{abs}}$ is a right
# angle or more, four edges would cut off places that are possible, so there the box is left as it is.


# %%
def clip(box, edge):
    """The smallest box round what an edge leaves of a box, or None, as in the lesson."""
    x_min, x_max, y_min, y_max = box
    a, b, c = edge
    least_ax, least_by = min(a * x_min, a * x_max), min(b * y_min, b * y_max)
    if least_ax + least_by > c:
        return None
    if a > 0:
        x_max = min(x_max, (c - least_by) / a)
    elif a < 0:
        x_min = max(x_min, (c - least_by) / a)
    if b > 0:
        y_max = min(y_max, (c - least_ax) / b)
    elif b < 0:
        y_min = max(y_min, (c - least_ax) / b)
    return np.array([x_min, x_max, y_min, y_max])


def cut(box, lines):
    """A box clipped by one edge after the other; None where nothing is left."""
    for line in lines:
        if box is not None:
            box = clip(box, line)
    return box


def look(robot, heading, objects, z, bounds):
    """Robot and heading after one round through all sightings; None where nothing is left."""
    for thing, sight in zip(objects, z, strict=True):
        box = np.repeat(thing, 2)
        if bounds[1] + (heading[1] - heading[0]) / 2 < np.pi / 2:
            robot = cut(robot, edges(sight, bounds, np.add(heading, np.pi), box))
            if robot is None:
                return None
        heading = sharpen(heading, robot, box, sight[1], bounds[1])
        if heading[1] < heading[0]:
            return None
    return robot, heading


# %% [markdown]
# This is sound, and it gives much away. After one round the box and the heading are some five times as wide as they need to
# be. Round after round, until nothing shrinks any more, they are still three times as wide.
#
# Two things make them wide. The edges are drawn for *all* headings from right to
# left at once: what would they look like if the heading were known ten times as well? And after each
# edge a box is put round what is left: which places come back by that?
#
# **Your task.** Return the smallest box and heading that you can *guarantee*, by any method. Every pose that agrees with all
# sightings, and with the box and the heading given, has to be inside. This is checked, on many robots, for the poses farthest
# out. Besides, the average width of your boxes and headings is compared with the smallest there are: no wider than those of
# `look` earns half a point, and at most 1.85, 1.6 and 1.4 times as wide as the smallest earns more, step by step.
#
# There may be one object, many, or none at all, and they may stand in the robot's box. left − right
# is at most 4 rad. Ranges and bearings are off by at most `bounds`, which are above 0, and no range is
# less than its bound. Bearings lie in $(-\pi, \pi]$. Some pose always agrees with everything. A robot
# should not take longer than a tenth of a second. The check stops after 20 s.


# %%
def narrow(robot, heading, objects, z, bounds):
    """The smallest box and heading that can be guaranteed after some sightings.

    robot : (4,) box of the robot [m];  heading : (2,) right, left [rad]
    objects : (n, 2) their places [m];  z : (n, 2) range [m] and bearing [rad] of each
    bounds : (2,) the most that ranges and bearings are off
    returns robot (4,), heading (2,)
    """
    ### BEGIN SOLUTION

    def rest(corners, edge):
        """Corners of what an edge leaves of a polygon: no box is put round it."""
        a, b, c = edge
        kept = []
        for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1], strict=True):
            here, there = c - a * x - b * y, c - a * u - b * v
            if here >= 0:
                kept.append((x, y))
            if (here >= 0) != (there >= 0):
                t = here / (here - there)
                kept.append((x + t * (u - x), y + t * (v - y)))
        return kept

    def possible(piece):
        """Corners of all places that agree with a heading of a piece."""
        x_min, x_max, y_min, y_max = robot
        corners = [(x_min, y_min), (x_max, y_min), (x_max, y_max), (x_min, y_max)]
        for place, sight in zip(objects, z, strict=True):
            for edge in edges(sight, bounds, np.add(piece, np.pi), np.repeat(place, 2)):
                corners = rest(corners, edge)
            if not corners:
                break
        return corners

    for _ in range(2):  # the second time the pieces are pieces of what the first has left
        ends = np.linspace(*heading, 25)
        pieces = [(piece, possible(piece)) for piece in np.column_stack([ends[:-1], ends[1:]])]
        x, y = np.array([corner for _, corners in pieces for corner in corners]).T
        angles = [piece for piece, corners in pieces if corners]
        robot = np.array([x.min(), x.max(), y.min(), y.max()])
        heading = np.array([angles[0][0], angles[-1][1]])
    return robot, heading
    ### END SOLUTION


# %%
check("10-narrow")

# %% [markdown]
# This is one of those robots. The dots are poses that agree with everything. The smallest box has them all inside, and
# dots near every side.


# %%
@attempt
def _():
    rng, pose, bounds = np.random.default_rng(3), np.array([0.1, -0.2, 0.4]), np.array([0.15, 0.04])
    objects = np.array([[2.5, 0.8], [-0.8, 2.4], [-2.6, -0.5]])
    d = objects - pose[:2]
    z = np.column_stack([np.hypot(*d.T), wrap(np.arctan2(d[:, 1], d[:, 0]) - pose[2])])
    z += rng.uniform(-1, 1, (3, 2)) * bounds
    robot, heading = np.array([-0.4, 0.5, -0.7, 0.3]), np.array([-0.3, 0.9])
    yours = narrow(robot.copy(), heading.copy(), objects.copy(), z.copy(), bounds.copy())
    poses = rng.uniform(*np.reshape([*robot, *heading], (3, 2)).T, (300_000, 3))
    for (x, y), seen in zip(objects, z, strict=True):
        dx, dy = x - poses[:, 0], y - poses[:, 1]
        off = np.hypot(dx, dy) - seen[0], wrap(np.arctan2(dy, dx) - poses[:, 2] - seen[1])
        poses = poses[(np.abs(off) <= bounds[:, None]).all(axis=0)]
    fig, ax = views.boxes.scene("Yours, and one round", (-0.9, 1.6, -0.9, 0.6), size=(8, 5.2))
    views.draw(ax, Points("sample", poses[:, :2]), label="agree with all")
    for name, box, colour in (("before", robot, "before"), ("yours", yours[0], "corrected")):
        views.draw(ax, Boxes(name, [box]), color=views.COLOURS[colour], linewidth=2.5)
    one_round = look(robot, heading, objects, z, bounds)[0]
    views.draw(ax, Boxes("one round", [one_round]), color=views.COLOURS["naive"])
    views.legend(ax, loc="upper right")
    views.show(
        fig, alt="Poses that agree with all, your box round them, and the wider ones before."
    )


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other inputs.
# **Next:** [lesson 11](../notebooks/11_samples.ipynb) drops boxes and ellipses for a cloud of samples.
