# %% [markdown]
# # Exercise 10 · Set-membership SLAM: the BOR filter
#
# **You will be able to** write the steps of a set-membership filter: the prediction of a box, the
# edges of a measurement, and the contraction of a heading, also across ±π. You will compute what is
# guaranteed if some measurements are outliers, and find out how small boxes can be without excluding
# a feasible pose.
#
# **60 minutes for tasks 1 to 4, and 45 for task 5. Before:** lesson [10 · Set-membership SLAM: the BOR filter](../notebooks/10_set_membership_slam.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check tries random inputs and special cases that
# the text allows. If your answer breaks a law, the check shows a small input that breaks it.
# `hint("10-predict")` in a cell of your own asks a guiding question.
#
# All lengths are in metres, all angles in radians. A **box** is `[x_min, x_max, y_min, y_max]`, and
# it may be a single point. A **heading** is an interval `[right, left]`. It extends
# counter-clockwise from right to left, as in (10.2). In the arguments, `right` lies in $(-\pi,
# \pi]$, and `left` is at least `right` and may be larger than $\pi$. A measurement `z = [r, β]` is
# a range and a bearing. The error of the range is at most $d_r$, and the error of the bearing is at
# most $d_\beta$. Together they are `bounds = [d_r, d_β]`. Arguments are arrays of floats, or
# numbers. A function must not change its arguments.

# %%
import numpy as np

from classroom.checks import ask, attempt, check
from slamlab import views
from slamlab.geometry import wrap
from slamlab.layers import Boxes, Points

# %% [markdown]
# ## 1 · Prediction of the box
#
# The robot's position is in `box`, and its heading $\theta$ is in `heading`. The robot drives a distance $d$, between `way[0]`
# and `way[1]`, in the direction $\theta + \delta$, with $\delta$ between `direction[0]` and `direction[1]`. By (10.3)
#
# $$x' = x + d\cos(\theta+\delta),\qquad y' = y + d\sin(\theta+\delta).$$
#
# **Your task.** Return the smallest box that contains every possible position of the robot after
# the motion. The distance is negative if the robot drives backwards. Any interval may have zero width. The interval of
# $\theta + \delta$ may be wider than a whole turn, and $\delta$ may be several turns, such as 14 rad. The check allows
# an error of $10^{-8}$ m for each side, also for distances of 200 km.
#
# Interval arithmetic gives this box in three steps: the *interval of directions* $\theta+\delta$; the
# *range of its cosine and its sine*; the *products* of these ranges with the interval of $d$, which
# are added to the box. For the second step first write a function `cosine_range(low, high)`. How can
# you compute the range of the sine with this function?


# %%
def predict(box, heading, way, direction):
    """Predicted box of the robot, after a motion.

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
# The dots are the end points of 500 random motions. All dots must be in your box, and some should
# be near each side.


# %%
@attempt
def _():
    rng, heading, way = np.random.default_rng(1), (-0.7, 0.5), (0.8, 1.2)
    box = predict(np.zeros(4), np.array(heading), np.array(way), np.zeros(2))
    w, theta = rng.uniform(*zip(way, heading, strict=True), (500, 2)).T
    fig, ax = views.axes("500 motions", size=(8, 5))
    ends = np.column_stack([w * np.cos(theta), w * np.sin(theta)])
    views.draw(ax, Points("sample", ends), label="end points")
    views.draw(ax, Boxes("your box", [box]))
    views.legend(ax)
    views.show(fig, alt=f"{len(w)} end points of motions on an arc, and your box around them.")


# %% [markdown]
# ## 2 · The edges of a measurement
#
# The robot measures a landmark at `z`, with errors of at most `bounds`. Its heading is in
# `[right, left]`. The middle `direction` to the landmark is the middle of the heading interval
# plus $\beta$. (In task 1 `direction` is an interval relative to the heading. Here `direction` is
# a single angle in the world frame.) By (10.5) the true direction differs from this middle
# direction by at most $d_{\mathrm{abs}} = d_\beta + (\text{left} - \text{right})/2$.
#
# Four **edges** enclose the possible positions of the landmark. The *far* and the *near* edge are
# perpendicular to `direction`. The *left* edge is the ray at `direction` $+\, d_{\mathrm{abs}}$,
# and the *right* edge is the ray at `direction` $-\, d_{\mathrm{abs}}$. An edge is a row `[a, b,
# c]`. It allows the points with $a x + b y \le c$. Its normal $(a, b)$, which is $n$ in the lesson,
# points out of the sector.
#
# Proceed in three steps: `direction` and $d_{\mathrm{abs}}$; the *normal* of each edge, and its $c$ for a
# robot at the origin; the *shift* of $c$ by the robot's box (10.8). Draw the sector and its near edge,
# (10.6). Which point of the box gives the maximum in (10.8) for each edge? You may also compare several
# points of the sector and of the box, if the points of the maximum are among them.
#
# **Your task.** Return four rows, in the order far, near, left, right, moved outwards by the
# robot's box (10.8). The far and the near edge touch the sector, as in (10.6). In this task
# $d_{\mathrm{abs}}$ is below 1.3 rad, and $r$ is at least $d_r$. Bounds may be 0, and heading and
# box may have zero width. $(a, b)$ may have any positive length: the check divides each row by
# it. Then it allows an error of $10^{-6}$ for $a$ and $b$, and of $10^{-6}$ times the size of the
# coordinates for $c$.


# %%
def edges(z, bounds, heading, box):
    """Edges of all positions of a landmark that agree with a measurement from a box.

    z : (2,) range [m], bearing [rad];  bounds : (2,) largest errors of the two
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
# The figure shows four sectors, one from each corner of the robot's box, and your edges. Each edge
# excludes its shaded side. Your edges must not exclude any part of a sector (orange).


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
    views.draw(ax, Boxes("robot's box", [box]), color=views.COLOURS["truth"])
    views.boxes.edges(ax, lines, ("far", "near", "left", "right"))
    views.legend(ax, loc="upper left")
    views.show(fig, alt="Four sectors of rings between your four edges.")


# %% [markdown]
# ## 3 · Contraction of the heading
#
# The robot can be anywhere in its box, and the landmark can be anywhere in its own box. The
# direction from the robot to the landmark, in the world frame, then lies between two extremes. The
# robot measures `bearing`, relative to its heading, with an error of at most `bound`. Which
# headings are feasible by (10.10)?
#
# Each extreme direction goes from a corner of the robot's box to a corner of the landmark's box.

# %%
ask(
    "ex10-west",
    "The landmark is due west of the robot. The directions from box to box extend from 3.1 through "
    "$\\pi$ to −3.1. **How do you write this interval as `[right, left]`?**",
    {
        "[−3.1, 3.1]": "this interval is nearly a whole turn, because it extends counter-clockwise "
        "from −3.1, through 0, to 3.1.",
        "[3.1, −3.1]": "the interval does begin at 3.1, but left must not be less than right.",
        "[3.1, 3.18]": "the interval begins at 3.1, and −3.1 plus a whole turn is 3.18.",
        "[−3.18, 3.1]": "this interval is a whole turn, because −3.18 and 3.1 are the same direction.",
    },
    right="[3.1, 3.18]",
)

# %% [markdown]
# **Your task.** Return the contracted heading, `[right, left]`. If the boxes overlap, return the
# heading unchanged. The two boxes either overlap or have a clear distance; they never just touch.
# The measurement agrees with the heading, and the intersection of the two heading intervals is
# always one interval. The bearing lies in $(-\pi, \pi]$. The given heading interval may be wider
# than $\pi$, but the widths of both heading intervals together are less than $2\pi$.
#
# Proceed in four steps: the two *extreme directions*; the *heading by the measurement alone* that follows
# from them, `bearing` and `bound`; this interval on the *same turn* as the given heading; the
# *intersection* of both intervals.
#
# Two angles that differ by $2\pi$ are the same direction. All directions from box to box lie within half
# a turn, so in the first step you can choose one direction and `wrap` the differences of the others from
# it. For a heading interval this is wrong if it is wider than $\pi$: in the third step move the interval
# as a whole, by adding the same multiple of $2\pi$ to both ends, until the middles of both intervals
# differ by less than $\pi$.
#
# The check allows an error of $10^{-7}$ rad for each end, modulo $2\pi$, also if the heading is
# unchanged. So a result on another turn is right, but left must be at least right.


# %%
def sharpen(heading, robot, box, bearing, bound):
    """Heading after a measurement.

    heading : (2,) right, left [rad];  robot, box : (4,) boxes of robot and landmark [m]
    bearing, bound : float, measured relative to the heading, and its largest error [rad]
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
    # both intervals on the same turn: their middles differ by less than half a turn
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    return np.array([max(heading[0], right + turns), min(heading[1], left + turns)])
    ### END SOLUTION


# %%
check("10-heading")

# %% [markdown]
# ## 4 · Measurements with outliers
#
# The robot measures $n$ known landmarks. Each measurement alone gives a box that contains the robot,
# if its errors are within their bounds. A measurement whose box does not contain the robot is an
# **outlier**. A single outlier can exclude the robot from the intersection of all boxes, or leave no
# intersection. So we assume that *at most $q$* of the $n$ measurements are outliers. Then the robot
# is in at least $n - q$ of the boxes. All positions that are in at least $n - q$ boxes form the
# **relaxed intersection** (Jaulin 2009).

# %%
ask(
    "ex10-relaxed",
    "Six measurements have a relaxed intersection for $q = 1$ that is not empty. **What is guaranteed?**",
    {
        "At most one of the six measurements is an outlier.": "the boxes of two outliers can meet the other boxes by chance, so the relaxed intersection need not be empty.",
        "The robot is in the relaxed intersection.": "this is true only under the assumption. If two measurements are outliers, the robot is in four boxes only.",
        "If at most one measurement is an outlier, the robot is in the relaxed intersection.": "the robot is then in at least five boxes. Nothing in the boxes proves the assumption.",
        "Five measurements are correct, and their boxes are those that meet.": "it is possible that all six measurements are correct, or that other five boxes meet elsewhere.",
    },
    right="If at most one measurement is an outlier, the robot is in the relaxed intersection.",
)

# %% [markdown]
# The relaxed intersection can have several pieces, and it need not be a box. A filter that stores one
# box takes the smallest box around all pieces.
#
# **Your task.** Return the smallest box that contains the whole relaxed intersection. Also return $n$
# flags: true if the measurement is an outlier *for certain*, wherever in the relaxed intersection the
# robot is. If the relaxed intersection is empty, more than $q$ measurements are outliers: then
# return only `None`, not a pair.
#
# $0 \le q < n \le 30$. Thirty boxes have 30 million subsets of twenty boxes, too many to try all: the
# check stops after 10 s. A box contains its sides.
#
# | judged, in relaxed intersections of one or several pieces, or empty | points |
# | --- | --- |
# | the box, with an error of at most $10^{-7}$ m for each side | 2 |
# | all flags, also where an outlier meets the box that you return, but no piece | 1.5 |
# | `None` if the relaxed intersection is empty, and only then | 0.5 |


# %%
def relaxed(boxes, q):
    """Box around all positions that are in all boxes except q, and the certain outliers.

    boxes : (n, 4) x_min, x_max, y_min, y_max [m];  q : int, largest number of outliers
    returns box (4,) [m], outliers (n,) of bool; or None if more than q are outliers
    """
    ### BEGIN SOLUTION
    x_min, x_max, y_min, y_max = np.transpose(boxes)

    def relaxed_corners(xs, ys):
        """Points (x, y) of the relaxed intersection, and in which boxes they are."""
        points = np.array([(x, y) for x in xs for y in ys])
        x, y = points.T[..., None]
        within = (x_min <= x) & (x <= x_max) & (y_min <= y) & (y <= y_max)
        kept = within.sum(axis=1) >= len(boxes) - q
        return points[kept], within[kept]

    # each piece is an intersection of boxes, so its corners are on sides of perhaps two boxes
    low, within = relaxed_corners(x_min, y_min)
    high, _ = relaxed_corners(x_max, y_max)
    if not len(low):
        return None
    box = np.array([low[:, 0].min(), high[:, 0].max(), low[:, 1].min(), high[:, 1].max()])
    return box, ~within.any(axis=0)
    ### END SOLUTION


# %%
check("10-relaxed")

# %% [markdown]
# In the figure two of six measurements are outliers, and $q = 2$. The dots are positions that are in
# at least four boxes. All dots must be in your box, and some should be near each side.


# %%
@attempt
def _():
    rng, robot, half = np.random.default_rng(5), np.zeros(2), np.array([0.6, 0.4])
    middles = robot + rng.uniform(-0.9, 0.9, (6, 2)) * half
    middles[:2] += [[1.1, 0.3], [-0.4, 0.9]]
    boxes = np.stack([middles - half, middles + half], axis=2).reshape(6, 4)
    found = relaxed(boxes.copy(), 2)
    points = rng.uniform(-2, 2, (20_000, 2))
    inside = (boxes[:, ::2] <= points[:, None]) & (points[:, None] <= boxes[:, 1::2])
    agree = points[inside.all(axis=2).sum(axis=1) >= 4]
    fig, ax = views.boxes.scene("Your box", (-1.8, 2.2, -1.2, 1.6), size=(8, 5.4))
    views.draw(ax, Points("sample", agree), label="in four boxes")
    views.draw(ax, Boxes("before", boxes), label="six measurements")
    if found is not None:
        views.draw(ax, Boxes("yours", [found[0]]), color=views.COLOURS["corrected"], linewidth=2.5)
    views.draw(ax, Points("truth", [robot]), label="true position", marker="X", markersize=10)
    views.legend(ax, loc="upper right")
    views.show(fig, alt="Six boxes, the positions that are in four of them, and your box.")


# %% [markdown]
# ## 5 · The smallest guaranteed box and heading
#
# A robot is somewhere in its box and measures landmarks whose positions are known exactly. `look`
# processes the measurements one after the other, as the lesson does. `look` clips the robot's box
# by the edges from the landmark, with the heading turned by $\pi$. Then it contracts the heading.
# `look` returns `None` if the box becomes empty, or if `sharpen` returns left < right. If
# $d_{\mathrm{abs}}$ is a right angle or more, four edges would exclude feasible positions, so
# `look` does not change the box.


# %%
def clip(box, edge):
    """Smallest box around the part of a box that an edge allows, or None, as in the lesson."""
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


def clip_polygon(corners, edge):
    """Corners (x, y) of the part of a convex polygon that an edge allows; [] if none remains."""
    a, b, c = edge
    kept = []
    for (x, y), (u, v) in zip(corners, [*corners[1:], *corners[:1]], strict=True):
        here, there = c - a * x - b * y, c - a * u - b * v
        if here >= 0:
            kept.append((x, y))
        if (here >= 0) != (there >= 0):
            t = here / (here - there)
            kept.append((x + t * (u - x), y + t * (v - y)))
    return kept


def cut(box, lines):
    """A box clipped by one edge after the other; None if it becomes empty."""
    for line in lines:
        if box is not None:
            box = clip(box, line)
    return box


def look(robot, heading, objects, z, bounds):
    """Robot and heading after one pass over all measurements; None if one becomes empty."""
    for landmark, measured in zip(objects, z, strict=True):
        box = np.repeat(landmark, 2)
        if bounds[1] + (heading[1] - heading[0]) / 2 < np.pi / 2:
            robot = cut(robot, edges(measured, bounds, np.add(heading, np.pi), box))
            if robot is None:
                return None
        heading = sharpen(heading, robot, box, measured[1], bounds[1])
        if heading[1] < heading[0]:
            return None
    return robot, heading


# %% [markdown]
# The results of `look` are guaranteed, but not tight. After one pass, box and heading are about
# five times as wide as the smallest possible box and heading. If you repeat `look` until nothing
# shrinks any more, they are still two to four times as wide, depending on the robots.
#
# In task 3 the measurement always agrees with the heading. If you call `sharpen` or `look` with
# only a part of the heading interval, it may not agree. What your `sharpen` returns then is not
# specified in task 3, so test it before you use it in this way.
#
# There are two reasons for the large width, and each has its method. First, the edges must hold for *all*
# headings of the interval at once. *Slicing* divides the interval into pieces that are processed
# separately. Second, after each edge a box replaces the remaining set. *Polygon clipping* (Sutherland and
# Hodgman) keeps the remaining polygon instead: `clip_polygon` clips it by one edge. Both can be *repeated*
# with the smaller box and heading. What must the result contain, of which pieces? Another method is to
# divide the box of all poses $(x, y, \theta)$ into small cells, and to exclude those that certainly contain
# no feasible pose.
#
# **Your task.** Return the smallest box and heading that you can *guarantee*, by any method. A
# pose is **feasible** if it agrees with all measurements and with the given box and heading.
# Every feasible pose must be inside; the check allows an error of $10^{-6}$ m and rad. The check
# searches the extreme feasible poses of ten robots, so it knows the smallest possible widths
# approximately. It computes three ratios, for $x$, for $y$ and for the heading: the sum of your
# widths over all robots, divided by the sum of the reference widths. The *mean ratio* is the mean
# of these three. Each row of the table that you reach adds its points. No row counts if a
# feasible pose is outside.
#
# | step | reference widths | mean ratio of at most | points |
# | --- | --- | --- | --- |
# | 1 | after one pass of `look` | 1 | 0.5 |
# | 2 | smallest ones that the check found | 1.85 | 1 |
# | 3 | smallest ones that the check found | 1.6 | 1.5 |
# | 4 | smallest ones that the check found | 1.4 | 2 |
#
# Together with 0.5 points for unchanged arguments, these are the 5.5 points of the task. The check also tries special
# cases. There every feasible pose must be inside, too, but the reference widths are those of the given box and heading.
# Special cases with two robots count for step 1 only. Three cases with more robots count for all steps. In two of them
# there are two separate sets of feasible poses, such as on both sides of a single landmark, and one of these sets may
# be so small that random samples miss it.
#
# The number of landmarks may be zero, one, or more, and landmarks may be in the robot's box. left
# − right is at most 4 rad. `bounds` are above 0, and no range is less than its bound. Bearings
# lie in $(-\pi, \pi]$. At least one pose is always feasible. A call of `narrow` should take at
# most 0.1 s. If your `edges` or your `sharpen` is wrong, the check uses a correct one in its place.
# The check stops after 20 s.


# %%
def narrow(robot, heading, objects, z, bounds):
    """Smallest box and heading that can be guaranteed after some measurements.

    robot : (4,) box of the robot [m];  heading : (2,) right, left [rad]
    objects : (n, 2) landmarks [m];  z : (n, 2) range [m] and bearing [rad] of each
    bounds : (2,) largest errors of ranges and bearings
    returns robot (4,), heading (2,)
    """
    ### BEGIN SOLUTION

    def possible(piece):
        """Corners of all positions that agree with some heading of a piece."""
        x_min, x_max, y_min, y_max = robot
        corners = [(x_min, y_min), (x_max, y_min), (x_max, y_max), (x_min, y_max)]
        for place, z_object in zip(objects, z, strict=True):
            for edge in edges(z_object, bounds, np.add(piece, np.pi), np.repeat(place, 2)):
                corners = clip_polygon(corners, edge)
            if not corners:
                break
        return corners

    for _ in range(2):  # the second time, cut the heading that the first has left
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
# The figure shows one such robot. The dots are positions of feasible poses. Your box must contain all
# dots. A box of full marks can be up to 1.4 times as wide as the smallest one, so a side may be beside the dots.


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
    fig, ax = views.boxes.scene(
        "Your box, and one pass of look", (-0.5, 0.95, -0.75, 0.35), size=(8, 5.8)
    )
    views.draw(ax, Points("sample", poses[:, :2]), label="feasible poses")
    for name, box, colour in (("before", robot, "before"), ("yours", yours[0], "corrected")):
        views.draw(ax, Boxes(name, [box]), color=views.COLOURS[colour], linewidth=2.5)
    one_round = look(robot, heading, objects, z, bounds)[0]
    views.draw(ax, Boxes("one pass", [one_round]), color=views.COLOURS["naive"])
    views.legend(ax, loc="upper right")
    views.show(
        fig,
        alt="Feasible poses, your box around them, and wider boxes: before, and after one pass.",
    )


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** [lesson 11](../notebooks/11_particle_filters.ipynb) replaces boxes and ellipses by a set
# of particles.
