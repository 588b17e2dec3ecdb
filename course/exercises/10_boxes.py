# %% [markdown]
# # 10 · Boxes: exercise
#
# **You will be able to** write a bounded filter, piece by piece, that never loses the truth: the
# box after a drive, the edges of a sighting, the clip, the heading over the seam; and you will have
# put them together.
#
# **70 minutes. Before:** lesson 10.
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and tells you which law is broken.
#
# Metres and radians throughout. A **box** is `[x_min, x_max, y_min, y_max]`, a **heading**
# `[right, left]`: every direction met going counter-clockwise from right to left. `right` lies in
# (−π, π], `left` is not less than `right` and may be more than π. A sighting is `z = [r, β]`, off by
# at most `bounds = [d_r, d_β]`.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import attempt, check
from slamlab.geometry import wrap
from slamlab.layers import Boxes, Points

# %% [markdown]
# ## The box after a drive
#
# A robot somewhere in `box`, with any heading θ from right to left, drives a way w (from `way[0]` to
# `way[1]`) in the direction θ + δ (δ from `direction[0]` to `direction[1]`):
#
# $$x' = x + w\cos(\theta+\delta),\qquad y' = y + w\sin(\theta+\delta)$$
#
# **Predict first.** The robot looks east, give or take 0.5 rad, and drives 1 m. What is the largest
# x' − x? Do the two ends of the heading tell you?
#
# **Your task.** The smallest box that holds every place where it may be. A way may be negative: the
# robot backs. Hint: write `cosine_range(low, high)` first; what is the sine's?


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
# 500 drives and your box. No point may lie outside, and each side should be touched.


# %%
@attempt
def _():
    rng, heading, way = np.random.default_rng(1), (-0.7, 0.5), (0.8, 1.2)
    box = predict(np.zeros(4), np.array(heading), np.array(way), np.zeros(2))
    w, theta = rng.uniform(*zip(way, heading, strict=True), (500, 2)).T
    fig, ax = views.axes("500 drives", size=(5, 4))
    views.draw(ax, Points("samples", np.column_stack([w * np.cos(theta), w * np.sin(theta)])))
    views.draw(ax, Boxes("your box", [box]))
    views.legend(ax)
    views.show(fig, alt="500 end points of drives on an arc and your box round them.")


# %% [markdown]
# ## The edges of a sighting
#
# The robot sees an object at `z`, off by at most `bounds`. Its heading is known up to
# `[right, left]`, so it looks along `direction` = middle of the heading + β, give or take
# **d_abs** = d_β + half of (left − right). Here d_abs is well below π/2.
#
# The places where the object may be lie between four **edges**: *far* and *near* stand across
# `direction`, *left* and *right* are rays at `direction` ± d_abs. An edge is a row `[a, b, c]`: it
# allows a x + b y ≤ c, and (a, b) points out.
#
# **Predict first.** How far from the robot is the near edge: r − d_r? Draw the piece of a ring, and
# look at its inner corners. Then: the robot is not at one point but somewhere in its box. Which
# point of the box decides how far each edge must be moved out?
#
# **Your task.** The four rows far, near, left, right (in this order), moved out for the robot's box.


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
# Your edges round four pieces of rings, one from each corner of the robot's box. The shaded sides
# are forbidden; nothing orange may lie in them.


# %%
@attempt
def _():
    box, z, bounds = np.array([-0.3, 0.3, -0.2, 0.2]), np.array([2.5, 0.3]), np.array([0.3, 0.1])
    heading = np.array([-0.1, 0.5])
    lines = edges(z, bounds, heading, box)
    direction, d_abs = heading.mean() + z[1], bounds[1] + 0.3
    fig, ax = views.boxes.scene("Your edges", (-0.8, 4, -1, 3.2))
    for corner in [(x, y) for x in box[:2] for y in box[2:]]:
        ring = (2.2, 2.8), (direction - d_abs, direction + d_abs)
        views.boxes.sector(ax, corner, *ring, alpha=0.2)
    views.draw(ax, Boxes("robot", [box]))
    views.boxes.edges(ax, lines, ("far", "near", "left", "right"))
    ax.legend(loc="upper left")
    views.show(fig, alt="Four pieces of rings between your four edges.")


# %% [markdown]
# ## Clip, then enclose
#
# An edge leaves a part of a box. What is left may have five corners; the filter keeps the smallest
# box round it.
#
# **Predict first.** a and b are both positive. Which side of the box moves: left, right, lower,
# upper? How far right may x be, and for which y of the box is most allowed? What if a is negative,
# or zero?
#
# **Your task.** That smallest box, or `None` where no place of the box is allowed.


# %%
def clip(box, edge):
    """The smallest box round what an edge leaves of a box.

    box : (4,) x_min, x_max, y_min, y_max [m];  edge : (3,) a, b, c; a x + b y <= c is allowed
    returns (4,) [m], or None where nothing is left
    """
    ### BEGIN SOLUTION
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
    ### END SOLUTION


# %%
check("10-clip")

# %% [markdown]
# A slanted edge through a box, and what your clip keeps.


# %%
@attempt
def _():
    box, edge = np.array([0.0, 3.0, 0.0, 2.0]), (0.6, 0.8, 1.2)
    kept = clip(box, edge)
    fig, ax = views.boxes.scene("Your clip", (-0.8, 3.8, -0.8, 2.8))
    views.draw(ax, Boxes("before", [box]), color=views.COLOURS["guide"])
    if kept is not None:
        views.draw(ax, Boxes("after", [kept]), color=views.COLOURS["corrected"], linewidth=2.5)
    views.boxes.edges(ax, [edge], ("far",))
    ax.legend(loc="upper right")
    views.show(fig, alt="A box, a slanted edge, and the smaller box that your clip returns.")


# %% [markdown]
# ## The heading
#
# Wherever the robot is in its box and the object in its own, the bearing in the world from one to
# the other lies between two extremes. The robot measured the bearing `bearing` relative to its
# heading, off by at most `bound`. What is left of the heading?
#
# The extreme bearings are among those from a corner of one box to a corner of the other.
#
# **Predict first.** The object is due west: bearings of 3.1 and of −3.1. Which of the two is the
# right one, which the left? And what does the sighting say when the two boxes overlap?
#
# **Your task.** The heading after the sighting, `[right, left]`. What heading and sighting have in
# common is one piece here, never two. `wrap` is at hand: compare angles only after counting them
# from one of them.


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
# ## A whole sighting
#
# Now put it together: **object, robot, heading**, in this order.
#
# 1. The object's box is cut by the edges seen from the robot's box.
# 2. The robot's box is cut by the edges seen the other way, from the object's *new* box: the same
#    sighting with the heading turned by π.
# 3. The heading is sharpened by the two new boxes.
#
# `cut` is given. If it returns `None` for either box, return `None`: somebody broke a promise.
#
# **Predict first.** A robot hardly knows its heading: left − right is 4 rad. What would the four
# edges cut off? What may you still do with the sighting? (Only where d_abs < π/2 may boxes be cut.)
#
# **Your task.** What is believed after one sighting. The check lets ten robots look at four objects,
# three times each. Four of them begin nearly without a heading.


# %%
def cut(box, lines):
    """A box clipped by one edge after the other; None where nothing is left."""
    for line in lines:
        if box is not None:
            box = clip(box, line)
    return box


def see(robot, heading, box, z, bounds):
    """What is believed after a sighting of an object.

    robot, box : (4,) the robot's and the object's box [m];  heading : (2,) right, left [rad]
    z : (2,) range [m], bearing [rad];  bounds : (2,) the most that they are off
    returns robot (4,), heading (2,), box (4,); or None where nothing is left
    """
    ### BEGIN SOLUTION
    if bounds[1] + (heading[1] - heading[0]) / 2 < np.pi / 2:
        box = cut(box, edges(z, bounds, heading, robot))
        if box is None:
            return None
        robot = cut(robot, edges(z, bounds, np.add(heading, np.pi), box))
        if robot is None:
            return None
    return robot, sharpen(heading, robot, box, z[1], bounds[1]), box
    ### END SOLUTION


# %%
check("10-see")

# %% [markdown]
# Your filter on a robot that looks round: four objects, one of them hardly known. Light is before,
# strong is after twelve sightings; the crosses are the truth.


# %%
@attempt
def _():
    rng, pose, bounds = np.random.default_rng(3), np.array([0.1, -0.2, 0.4]), np.array([0.1, 0.05])
    objects = np.array([[2.5, 0.8], [-0.8, 2.4], [-2.6, -0.5], [0.9, -2.9]])
    half = np.array([[0.1], [0.1], [0.1], [1.2]])
    before = np.hstack([objects - half, objects + half])[:, [0, 2, 1, 3]]
    robot, heading, boxes = np.array([-0.4, 0.5, -0.7, 0.3]), np.array([0.1, 0.8]), before.copy()
    start = robot
    for i in np.tile(np.arange(4), 3):
        d = objects[i] - pose[:2]
        z = np.array([np.hypot(*d), wrap(np.arctan2(d[1], d[0]) - pose[2])])
        z += rng.uniform(-1, 1, 2) * bounds
        robot, heading, boxes[i] = see(robot, heading, boxes[i], z, bounds)
    fig, ax = views.axes("Before and after twelve sightings", size=(6, 5))
    views.draw(ax, Boxes("before", [start, *before]), color=views.COLOURS["guide"])
    views.draw(ax, Boxes("after", [robot, *boxes]), color=views.COLOURS["corrected"])
    views.draw(ax, Points("truth", [pose[:2], *objects]), marker="x", markersize=7, mew=2)
    ax.legend(loc="upper right")
    views.show(fig, alt="Boxes before and after twelve sightings; the truth is inside of all.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. The next lesson drops boxes and ellipses for a cloud of samples.
