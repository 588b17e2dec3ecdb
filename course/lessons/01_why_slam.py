# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 01 · Why SLAM
#
# **Afterwards you will be able to** compute a trajectory by dead reckoning, predict how fast its
# error grows with the distance, explain why its map is not consistent, and state what SLAM estimates.
#
# **55 minutes.** **Before:** [00 · Start here](00_start_here.ipynb); sine, cosine and the standard
# deviation, as taught at school.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* this lesson has one main idea: a map is only as good as the poses from which it
# is drawn. Poll the class on the first question before you run any cell. If time is short, leave
# out "Random errors": the exercise returns to this subject.

# %% slideshow={"slide_type": "skip"} name="imports" tags=["folded"]
from itertools import accumulate

import numpy as np

from classroom.checks import ask, compare
from course.studies import intel_maps
from slamlab import estimators, sources, views
from slamlab.estimators import run
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation.differential_drive import arc

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Odometry, poses and frames
#
# A robot drives one lap around a rectangular block, through a corridor that is 2 m wide. Can the robot compute
# its position by counting the turns of its wheels? Each of its two driven wheels has a counter (an *encoder*).
# The robot also carries a lidar, which measures the distance to the walls in 400 directions.
#
# The **pose** of a robot is its position and its heading, $x$, $y$ and $\theta$. The pose is given in the **world
# frame** (also *global frame* or *map frame*), a coordinate system that does not move. The robot measures in
# its own coordinate system, the **robot frame** (also *body frame*). The origin of this frame is the middle
# between the two wheels, its $x$ axis points ahead, and its $y$ axis points to the left.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-odometry-poses-and-frames"
# *For the lecturer:* Collect guesses in metres before you show the question. Students usually conclude from
# 0.3 % of wheel size that the position is wrong by 0.3 %. In the figure, point at the beginning of the lap,
# where both trajectories still coincide.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Readings
#
# The poses over time are the **trajectory** (also *path*). At short intervals the robot delivers a
# *reading*, which has two parts:
#
# - the **odometry**: an estimate of the motion since the last reading, computed from the encoders
#   and given in the robot frame of the last reading. The estimate of one such motion is an **odometry increment**;
# - the **scan**: the distances that the lidar measured during one revolution.
#
# The robot is simulated, so its true trajectory is known. The true trajectory is called the **ground truth**.

# %% name="one-reading" tags=["code"]
robot = sources.open("sim:corridor", np.random.default_rng(3))
readings = list(robot)
forward, left, turn = readings[100].odometry
scan = readings[100].scan
print(f"{len(readings)} readings; the odometry and the scan of number 100:")
print(f"  {100 * forward:.1f} cm ahead, {100 * left:.1f} cm to the left")
print(f"  turned by {np.degrees(turn):.2f}°")
print(f"  {scan.valid.sum()} of {len(scan.ranges)} beams came back")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Dead reckoning
#
# Where is the robot? It can compose its odometry increments, so that each increment begins where the previous
# one ended. This method is called **dead reckoning**, a term of sailors who have no land in sight. If the robot
# is at pose $a$ and
# makes a step $b$, measured in its own frame, the new pose is
#
# $$ a \oplus b = \left( \begin{pmatrix} x_a \\ y_a \end{pmatrix} + \mathrm{Rot}(\theta_a)
# \begin{pmatrix} x_b \\ y_b \end{pmatrix},\; \theta_a + \theta_b \right), \tag{01.1} $$
#
# where $\mathrm{Rot}(\theta)$ rotates a vector by the angle $\theta$ from the robot frame to the
# world frame: after every turn, "ahead" is a different direction in the world. The sum of the angles
# is wrapped to the interval from −π to π. The operation $\oplus$ is called **pose composition**. The library
# `slamlab` computes it with `compose(a, b)`.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** A robot stands at the position (1 m, 2 m) with heading 90°. It drives half a metre
# straight ahead. Write down its new pose as an array of $x$, $y$ and $\theta$ (in radians).

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
new_pose = ...  # np.array([x, y, theta])
compare(new_pose, compose(np.array([1.0, 2.0, np.pi / 2]), np.array([0.5, 0.0, 0.0])))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# new_pose = np.array([1.0, 2.5, np.pi / 2])
# ```
#
# At 90° the robot faces along the $y$ axis of the world, so "ahead" adds to $y$.
#
# </details>

# %% slideshow={"slide_type": "subslide"} name="ask-gap"
ask(
    "01-gap",
    "This is a good robot: its wheels differ in size by 0.3 %, the distance between them is "
    "known with an error of 1 %, and they slip a little. The lap is 42 m long and ends exactly "
    "where "
    "it began. **By how much does dead reckoning miss the start?**",
    {
        "by about 10 cm": "this would be 0.3 % of the distance, as if only lengths were wrong.",
        "by about half a metre": "you are right to expect more than 0.3 % of the distance, but "
        "the real error is far larger.",
        "by more than 2 m": "unequal wheels also turn the robot, and a heading error bends the "
        "whole trajectory after it.",
    },
    right="by more than 2 m",
)


# %% slideshow={"slide_type": "fragment"} name="dead-reckoning" answers="01-gap" tags=["nbval-check-output"]
def dead_reckoning(increments):
    """All poses of a run that begins at the origin: increments (n, 3) to poses (n + 1, 3)."""
    return np.array(list(accumulate(increments, compose, initial=np.zeros(3))))


truth = robot.truth.poses
reckoned = dead_reckoning([reading.odometry for reading in readings[1:]])
gap = between(truth[-1], reckoned[-1])
print(f"misses the start by {np.hypot(*gap[:2]):.1f} m, heading off by {np.degrees(gap[2]):.0f}°")

# %% slideshow={"slide_type": "subslide"} name="dead-reckoning-picture" answers="01-gap" tags=["folded"]
fig, ax = views.axes("One lap of the corridor", size=(8, 5.6))
views.draw(ax, Segments("walls", robot.world.outline()))
views.draw(ax, Poses("truth", truth), label="ground truth")
views.draw(ax, Poses("naive", reckoned), label="dead reckoning")
views.legend(ax, loc="center")
views.show(
    fig,
    alt="The true trajectory closes; the trajectory by dead reckoning veers off on the first side, "
    f"crosses walls and ends {np.hypot(*gap[:2]):.1f} m from its start.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-gap"
# The ground truth, in black, closes. The trajectory by dead reckoning veers off more and more, crosses walls
# and ends {= np.hypot(*gap[:2]):.1f =} m away from its start. An error that accumulates
# like this with the distance is called **drift**. For comparison, 0.3 % of 42 m is only
# {= 100 * 0.003 * 42:.0f =} cm. The gap is {= np.hypot(*gap[:2]) / (0.003 * 42):.0f =} times as
# large, so errors in the *lengths* of the increments cannot cause the gap. Errors in the **directions** of the
# increments cause it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The heading error of unequal wheels
#
# While the robot moves, its left wheel rolls a distance $s_{\mathrm{left}}$ and its right one
# $s_{\mathrm{right}}$, on two circles about one centre. The radii of the circles differ by the
# distance $B$ between the wheels, and an arc is its radius times its angle. The heading therefore
# changes by
#
# $$ \Delta\theta = \frac{s_{\mathrm{right}} - s_{\mathrm{left}}}{B}. \tag{01.2} $$
#
# If one wheel is a little larger than the robot assumes, the computed difference is wrong, and (01.2) divides
# it by a $B$ of only 30 cm. (Lesson [02](02_sensors_and_worlds.ipynb) returns to such a robot, which
# is called a *differential drive*.)

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-heading-error-of-unequal-wheels"
# *For the lecturer:* Roll two coins of different size, joined by a pencil as their axle, over the desk: they
# drive an arc. Students tend to forget the division by $B$, so ask what a wider robot would change.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The left wheel rolls 19 cm and the right one 21 cm, and the wheels are 30 cm apart.
# By how many radians does the heading change?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
heading_change = ...  # (01.2), in radians
compare(heading_change, arc(0.19, 0.21, 0.3)[2])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# heading_change = (0.21 - 0.19) / 0.3
# ```
#
# The robot turns by 0.067 rad, or nearly 4°, to the left, because the right wheel rolled farther.
#
# </details>

# %% name="ask-turn"
ask(
    "01-turn",
    "The wheels differ by 0.3 %, and they are 0.3 m apart. **By how many degrees is the heading "
    "wrong after 42 m, by (01.2)?**",
    right=24.0,
    tolerance=1.0,
    unit="°",
    reason="0.003 · 42 m / 0.3 m is 0.42 rad, which is 24°.",
    wrong={
        0.42: "this is the angle in radians.",
        0.57: "this is the error after one metre, and the robot drives 42 of them.",
        0.126: "this is the difference of the two distances in metres; divide it by B.",
        1.08: "this is 0.3 % of a full turn, but the angle depends on the distance and on B.",
    },
)

# %% slideshow={"slide_type": "fragment"} name="turn" answers="01-turn" tags=["nbval-check-output"]
turned = np.degrees(robot.robot.turn_per_metre)
print(f"{turned:.2f}° per metre add up to {42 * turned:.0f}° in 42 m")
print(f"in the run above the heading at the end was off by {np.degrees(gap[2]):.0f}°")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-turn"
# In this run the unequal wheels explain {= 42 * turned:.0f =} of the
# {= abs(np.degrees(gap[2])):.0f =} degrees; slip and the wrong distance between the wheels cause the
# rest. An error of length changes the position once, when it occurs. An error of heading **stays**, and from then
# on every step goes in the wrong direction.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## A map from poses and scans
#
# The scans are good: at 4 m the standard deviation of this lidar is about
# {= 100 * np.hypot(0.001 * 4, robot.sensor.range_curvature * 4**2):.0f =} cm. A **map** is a model of
# the surroundings in the world frame; the simplest map is the set of all scan points. To draw this map, we
# rotate and shift each scan according to the pose from which it was taken, and draw all scans in one frame. If
# this pose
# is $x$, $y$, $\theta$, a point $p_{\mathrm{r}}$, given in the robot frame, has the world coordinates
#
# $$ p = \begin{pmatrix} x \\ y \end{pmatrix} + \mathrm{Rot}(\theta)\, p_{\mathrm{r}}, \tag{01.3} $$
#
# which is the position part of (01.1). The library computes $p$ with `transform(pose, points)`. A wrong pose
# puts all points of its scan in the wrong place.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-a-map-from-poses-and-scans"
# *For the lecturer:* Let the class transform one point by hand, first the rotation and then the shift; the
# opposite order is the usual mistake. If time is short, skip the *Your turn*.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Place the points of `scan`, the scan of reading 100, in the world frame, from the pose
# computed by dead reckoning. The points in the robot frame are `scan.points()`.


# %% slideshow={"slide_type": "fragment"} name="place-scan" tags=["folded"]
def map_from(poses, readings):
    """The points (n, 2) of all scans, each placed by its pose."""
    each = zip(poses, readings, strict=True)
    return np.vstack([transform(pose, reading.scan.points()) for pose, reading in each])


# %% slideshow={"slide_type": "-"} tags=["your-turn"]
placed = ...  # the points of scan in the world frame
compare(placed, map_from(reckoned[[100]], [readings[100]]))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# placed = transform(reckoned[100], scan.points())
# ```
#
# </details>

# %% slideshow={"slide_type": "subslide"} name="ask-smear"
ask(
    "01-smear",
    "We draw the same scans twice: from the true poses, and from the poses by dead reckoning. "
    "The robot "
    "passed the corner at the lower left when it set out **and** when it came back. **What will "
    "the "
    "second map show?**",
    {
        "one corridor with thicker walls": "lidar noise would have this effect, but the errors "
        "of the poses are metres.",
        "two corridors, one across the other": "each pass draws the corridor where dead reckoning "
        "places the robot.",
        "points all over the place": "neighbouring poses agree well with each other, so each "
        "pass alone gives a sharp corridor.",
    },
    right="two corridors, one across the other",
)


# %% slideshow={"slide_type": "fragment"} name="two-maps-picture" answers="01-smear" tags=["folded"]
fig, _ = views.side_by_side(
    {
        "ground-truth poses": [Points("map", map_from(truth, readings))],
        "poses by dead reckoning": [Points("naive", map_from(reckoned, readings))],
    },
    size=(9, 4.5),
)
views.show(
    fig,
    alt="Left: a sharp rectangular corridor. Right: the same scans, smeared, and at the lower "
    "left a "
    "second corridor across the first.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-smear"
# In the left map, the points of all {= len(readings) =} scans lie on the same walls. In the right map, the long
# walls are smeared, and at the lower left two corridors cross where the building has only one: **the ends of
# the lap do not meet**. Both maps use the same scans; only the poses differ. A **consistent map** (also *globally
# consistent*) contains every wall once, even where the robot came back after a long drive. The left map is
# consistent, the right one is not. (A consistent *filter* is a different concept, which lesson 03 defines.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Systematic errors and calibration
#
# How exact would the wheels have to be? We take perfect odometry and add one of two errors on purpose:
#
# - *Ada's* robot reports every step **2 % too long**;
# - the wheels of *Ben's* robot **differ by 0.1 %**, so by (01.2) its heading drifts a little with every metre,
#   always in the same direction.
#
# An error that repeats in every step is a *systematic error* (also *bias*).

# %% [markdown] slideshow={"slide_type": "notes"} name="note-systematic-errors-and-calibration"
# *For the lecturer:* Draw both laps on the board as polygons before the question: Ada's sides are too long,
# Ben's corners are not right angles. Ask what a *negative* difference of Ben's wheels does, and then move the
# slider below zero.

# %% slideshow={"slide_type": "subslide"} name="ask-closes"
ask(
    "01-closes",
    "**Whose lap does not close?**",
    {
        "Ada's": "all four sides become too long by the same factor, so the lap is larger, but it "
        "closes.",
        "Ben's": "the sides keep their lengths, but the direction error of each side is larger "
        "than that of the side before.",
        "both": "a lap that is larger by 2 % on all sides still ends where it began.",
        "neither": "0.1 % is small, but B is small, too, and the drift accumulates over 42 m.",
    },
    right="Ben's",
)

# %% slideshow={"slide_type": "subslide"} name="wheels-slider"
# perfect odometry, and both systematic errors added to it
increments = between(truth[:-1], truth[1:])  # perfect odometry
lengths = np.hypot(increments[:, 0], increments[:, 1])


def with_bias(differ, longer):
    """Perfect odometry with the bias of unequal wheels and of steps too long, both in %: poses."""
    drift = np.outer(lengths, [0, 0, differ / 100 / robot.robot.base])
    scale = 1 + longer / 100
    return dead_reckoning(increments * [scale, scale, 1] + drift)


def end_error(differ, longer=0.0):
    """How far from its start such a lap ends [m]."""
    return np.hypot(*(with_bias(differ, longer)[-1] - truth[-1])[:2])


# %% name="wheels-needed"
tried = np.linspace(0, 0.1, 51)
errors = [end_error(differ) for differ in tried]
needed = np.interp(0.1, errors, tried)  # for an error of 10 cm


# %% name="wheels-slider-picture"
def map_with_bias(wheels_differ_by_percent, steps_too_long_by_percent):
    """The map of a robot whose odometry has a bias."""
    poses = with_bias(wheels_differ_by_percent, steps_too_long_by_percent)
    layers = [Points("map", map_from(poses[::3], readings[::3])), Poses("naive", poses)]
    error = end_error(wheels_differ_by_percent, steps_too_long_by_percent)
    return views.side_by_side({f"misses its start by {error:.2f} m": layers}, size=(8, 5.6))[0]


# %% slideshow={"slide_type": "subslide"} name="wheels-explore"
views.explore(
    map_with_bias,
    alt=f"Ben's map: the lap misses its start by {end_error(0.1):.1f} m, and the ends of the corridor "
    "do not meet.",
    wheels_differ_by_percent=(-0.3, 0.3, 0.1),
    steps_too_long_by_percent=(-5.0, 5.0, 0.0),
)

# %% [markdown]
# At first you see Ben's map: the lap misses its start by {= end_error(0.1):.1f =} m, and the ends of the
# corridor do not meet. Move the first slider to 0 and the second to 2 to see Ada's map: her lap closes, but the
# map is too large. Ben's robot misses its start by no more than 10 cm only if its wheels agree to
# {= needed:.3f =} %. For a wheel of 10 cm this tolerance is {= 1000 * needed:.0f =} thousandths of a
# millimetre.
#
# Wear, or another load, changes the radius of a tyre by more than this. But we can measure a systematic error
# and then remove it from the odometry. This procedure is called *calibration*; lesson
# [14](14_devices_and_live_slam.ipynb) calibrates a robot.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The array `ada`, with columns for $x$, $y$ and $\theta$, contains the odometry
# increments of Ada's robot. Remove the systematic error from these increments. (The turns in the third column
# have no error.)

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
ada = increments * [1.02, 1.02, 1.0]
calibrated = ...  # from ada
compare(calibrated, between(truth[:-1], truth[1:]))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# ada = increments * [1.02, 1.02, 1.0]
# calibrated = ada / [1.02, 1.02, 1.0]
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Random errors: how drift grows
#
# A *random error* differs from step to step, so calibration cannot remove it. Let 2000 robots
# drive straight ahead in steps of half a metre. Each step has a random error. We consider two kinds of errors:
#
# - its **length** is wrong by 2 %, which is 1 cm;
# - after it, the **heading** is wrong by 1°, and the robot keeps this heading.
#
# The 2 % and the 1° are standard deviations. The errors are independent, and their means are zero.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-random-errors-how-drift-grows"
# *For the lecturer:* Most students who choose 4 have the systematic errors in mind. Ask whether the errors of
# two steps can cancel. If you leave out this section, leave out the next two as well.

# %% slideshow={"slide_type": "subslide"} name="ask-growth"
ask(
    "01-growth",
    "The robots drive 5 m, and then 20 m: four times as far. Errors of length cause an error along "
    "the line, errors of heading an error across it. **By what factors do the standard deviations "
    "of these errors grow?**",
    {
        "along 4, across 4": "this would be right if all errors had the same sign.",
        "along 2, across 2": "this is right for lengths; but an early error of heading rotates "
        "all steps after it.",
        "along 2, across 8": "variances of independent errors add, and each error of heading "
        "rotates all steps that follow.",
        "along 4, across 16": "random errors partly cancel: they do not all have the same sign.",
    },
    right="along 2, across 8",
)


# %% slideshow={"slide_type": "fragment"} name="spread" answers="01-growth"
# end positions of robots that aim straight ahead and make random errors
def straight_runs(distance, length_error, heading_error, rng, robots=2000, step=0.5):
    """End positions of robots that aim straight ahead: (robots, 2), along and across [m]."""
    n = round(distance / step)
    lengths = step * (1 + length_error * rng.standard_normal((robots, n)))
    errors = heading_error * rng.standard_normal((robots, n))
    headings = np.cumsum(errors, axis=1) - errors  # a step is driven before its error is made
    steps = lengths * [np.cos(headings), np.sin(headings)]
    return steps.sum(axis=2).T


# %% slideshow={"slide_type": "fragment"} name="spread-table" answers="01-growth" tags=["nbval-check-output"]
rng = np.random.default_rng(2)
print("standard deviation caused by errors of")
for distance in (5, 20, 80):
    along, _ = straight_runs(distance, 0.02, 0.0, rng).std(axis=0)
    _, across = straight_runs(distance, 0.0, np.radians(1), rng).std(axis=0)
    print(f"{distance:3d} m   length: {100 * along:4.0f} cm   heading: {100 * across:5.0f} cm")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The variance of the position after n steps
#
# Why is an error of heading worse than an error of length? Errors of **length** partly cancel. They are
# independent, so their variances add. If the length error of each step has the variance $\sigma_d^2$, the
# variance after $n$ steps is
#
# $$ \operatorname{Var}(\text{along}) = n\, \sigma_d^2. \tag{01.4} $$
#
# The standard deviation is the root of this variance. It grows as $\sqrt{n}$: over four times the distance, it
# becomes twice as large.
#
# For the **heading**, we consider a single error first. The error rotates the whole rest of the trajectory
# about the point where the error occurs, as if the rest were a rigid body.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-variance-of-the-position-after-n-ste"
# *For the lecturer:* Turn a long ruler a little about its beginning, and then about a point near its end. Ask
# when the tip moves more: (01.5) adds such a turn for each step.

# %% slideshow={"slide_type": "subslide"} name="ask-bends"
ask(
    "01-bends",
    "A robot drives three steps of length $d$. After each of them, including the last one, its "
    "heading gets an independent small error of variance $\\sigma^2$. **What is the variance "
    "of its final position, across the intended line, in units of $\\sigma^2 d^2$?**",
    {
        "3": "this would be right if every error moved the end by the same length.",
        "5": "the first error rotates two steps, the second error one, and the last none: 4 + 1 "
        "+ 0.",
        "9": "this is (2 + 1 + 0)²: the errors themselves add up only if all have the same sign.",
        "14": "9 + 4 + 1 would mean that the last error rotates a step, but that error occurs "
        "after the last step.",
    },
    right="5",
)

# %% slideshow={"slide_type": "fragment"} name="bends" answers="01-bends" tags=["nbval-check-output"]
across = straight_runs(3 * 0.5, 0.0, 0.01, rng, robots=200_000)[:, 1]
print(f"200 000 robots: {across.var() / (0.01 * 0.5) ** 2:.1f} σ² d²")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The sum of all errors
#
# When the $k$-th error $e_k$ occurs, $n - k$ of the $n$ steps remain. The error rotates all of these steps. If
# all angles are small, it moves the end sideways by the angle times the total length of the remaining steps:
#
# $$ \text{across} = d \sum_{k=1}^{n} (n - k)\, e_k. \tag{01.5} $$
#
# The errors are independent, so the variances of the terms add. A sum of squares up to $n$ grows
# like the area under a parabola, and for many steps
#
# $$ \operatorname{Var}(\text{across}) = \sigma^2 d^2 \sum_{k=1}^{n} (n-k)^2
# \approx \tfrac{1}{3}\, \sigma^2 d^2\, n^3. \tag{01.6} $$
#
# The standard deviation grows as $n\sqrt{n}$: over four times the distance, it becomes eight times as
# large. So a heading error is worse than an error of length. (For 5 steps the
# sum is 30 and $n^3/3$ is 42, so the root of the approximation is still 18 % too large.)

# %% slideshow={"slide_type": "subslide"} name="growth"
distances = np.array([2.5, 5, 10, 20, 40, 80])
n = distances / 0.5
theory = {"(01.4)": 0.02 * 0.5 * n**0.5, "(01.6)": np.radians(1) * 0.5 * (n**3 / 3) ** 0.5}
along = [straight_runs(each, 0.02, 0.0, rng)[:, 0].std() for each in distances]
across = [straight_runs(each, 0.0, np.radians(1), rng)[:, 1].std() for each in distances]
slow, fast = (np.polyfit(np.log(distances), np.log(each), 1)[0] for each in (along, across))

# %% slideshow={"slide_type": "-"} name="growth-picture" tags=["folded"]
fig, _ = views.growth(
    distances,
    {"length errors of 2 %": along, "heading errors of 1°": across},
    theory,
    "distance driven [m]",
    "standard deviation of the position [m]",
    "End positions of 2000 robots",
    size=(8, 5),
)
views.show(
    fig,
    f"The effect of length errors rises with slope {slow:.1f}, that of heading errors with {fast:.1f}.",
)

# %% [markdown]
# On doubly logarithmic axes a power law is a straight line, and its exponent is the slope of this line:
# {= slow:.1f =} for length errors, {= fast:.1f =} for heading errors. After 5 m both standard deviations are
# still small. After
# 80 m the standard deviation due to heading errors is {= across[-1] / along[-1]:.0f =} times that due to
# length errors. **Errors that accumulate grow without bound.**

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Use the powers of (01.4) and (01.6). If the robots drive 16 times as far, by what
# factors do the standard deviations along and across the line grow?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
factors = ...  # along, across
compare(factors, [each[5] / each[1] for each in theory.values()])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# factors = 16**0.5, 16**1.5
# ```
#
# The factors are 4 and 64. The figure above shows them between 5 m and 80 m.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## The distribution of the end position
#
# The figure shows the end positions of 800 such robots. At first the robots have heading errors only. Increase
# the distance: the end positions form an arc, because a robot that has veered to one side has advanced less
# along the line. Then set the heading error to 0 and increase the length error.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-distribution-of-the-end-position"
# *For the lecturer:* Ask before you drag: is the arc bent towards the start or away from it? Lesson 04
# replaces this arc by an ellipse, so let the class describe its shape in words.


# %% name="cloud" tags=["folded"]
def end_positions(distance_in_metres, heading_error_in_degrees, length_error_in_percent):
    """The end positions of 800 runs that were planned straight ahead."""
    errors = length_error_in_percent / 100, np.radians(heading_error_in_degrees)
    ends = straight_runs(distance_in_metres, *errors, np.random.default_rng(1), robots=800)
    along, across = ends.std(axis=0)
    title = f"standard deviation along the line {along:.2f} m, across it {across:.2f} m"
    fig, ax = views.axes(title, size=(8, 5.2))
    line = [[0, 0, 0], [distance_in_metres, 0, 0]]
    views.draw(ax, Poses("truth", line), label="planned trajectory")
    views.draw(ax, Points("naive", ends), label="end positions", markersize=4)
    views.legend(ax, loc="upper left")
    return fig


# %% name="cloud-picture"
views.explore(
    end_positions,
    alt="End positions of robots that aimed straight ahead: an arc across the line, bent towards "
    "the start.",
    distance_in_metres=(5, 80, 30),
    heading_error_in_degrees=(0.0, 3.0, 1.5),
    length_error_in_percent=(0.0, 20.0, 0.0),
)

# %% [markdown]
# Over 30 m, heading errors with a σ of 1.5° per step cause a standard deviation of
# {= straight_runs(30, 0, np.radians(1.5), np.random.default_rng(1), 800)[:, 1].std():.2f =} m across the line.
# Length errors with a σ of as much as 20 % of a step cause only
# {= straight_runs(30, 0.2, 0, np.random.default_rng(1), 800)[:, 0].std():.2f =} m along it. An ellipse does not describe an arc well; lessons 04 and 11 return to this shape.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Scan matching corrects the odometry
#
# The scans also contain information about the motion, because the walls do not move between two readings. The
# robot can therefore compute the motion that aligns the new scan with the old one. This method is called *scan
# matching*. It works where the walls determine the motion. A single plain wall does not determine it: a scan
# that is shifted along the wall fits equally well.
#
# An *estimator* is a program that computes poses and a map from readings. The estimator `icp` matches scans: it
# starts from the odometry and corrects the motion until the walls coincide. Lesson
# [13](13_scan_matching.ipynb) explains how. We give it the same readings as before.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-scan-matching-corrects-the-odometry"
# *For the lecturer:* Before the table appears, ask in which direction a bare corridor does not determine the
# motion. Point at the first row of numbers: *ahead*, `icp` is no better than odometry. These cells take
# longest, so run them before the lecture.

# %% slideshow={"slide_type": "subslide"} name="ask-cure"
ask(
    "01-cure",
    "**By how much does the trajectory of `icp` miss the start of the lap?**",
    {
        "not at all": "each match has a small error, and these errors accumulate.",
        "by about ten centimetres": "the walls determine the heading far better than the wheels "
        "do.",
        "by as much as dead reckoning, since it starts from the odometry": "it does start "
        "from the odometry, but the walls correct each step before the next one begins.",
    },
    right="by about ten centimetres",
)

# %% slideshow={"slide_type": "fragment"} name="cure" answers="01-cure"
# the same readings, mapped by scan matching
matched = run(robot, estimators.make("icp", robot))
estimated = matched.trajectory.poses
for name, poses in {"dead reckoning": reckoned, "icp": estimated}.items():
    ahead, left, turn = between(truth[-1], poses[-1])
    print(
        f"{name:14}  misses by {100 * np.hypot(ahead, left):5.1f} cm and {np.degrees(turn):5.1f}°"
    )

# %% slideshow={"slide_type": "fragment"} name="cure-picture" answers="01-cure" tags=["folded"]
miss = 100 * np.hypot(*between(truth[-1], estimated[-1])[:2])
fig, _ = views.side_by_side(
    {
        "odometry alone": [Points("naive", map_from(reckoned, readings))],
        "odometry and scan matching": [Points("corrected", map_from(estimated, readings))],
    },
    size=(9, 4.5),
)
views.show(
    fig,
    alt=f"Left: the smeared corridor. Right: the sharp corridor by icp, closed to {miss:.0f} cm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-cure"
# Both maps use the same odometry and the same scans. In the right map the walls are sharp, and the trajectory
# misses its start by {= miss:.0f =} cm; the trajectory by dead reckoning misses it by
# {= 100 * np.hypot(*gap[:2]):.0f =} cm. One lap may be an exception. So we drive three more laps, and examine
# single steps as well.


# %% slideshow={"slide_type": "subslide"} name="more-laps" tags=["code"]
def step_errors(poses, truth):
    """Median errors of the steps of a trajectory: ahead [mm], to the side [mm], heading [°]."""
    off = between(between(truth[:-1], truth[1:]), between(poses[:-1], poses[1:]))
    return np.median(np.abs(off), axis=0) * [1e3, 1e3, np.degrees(1)]


laps = [(robot.truth.poses, matched)]
for seed in (0, 1, 2):
    lap = sources.open("sim:corridor", np.random.default_rng(seed))
    laps.append((lap.truth.poses, run(lap, estimators.make("icp", lap))))

# %% slideshow={"slide_type": "-"} name="more-laps-table"
# the errors of each lap, and of a step
ends, steps = [], []  # of each lap: by odometry, by icp
for true, result in laps:
    trajectories = result.naive.poses, result.trajectory.poses
    ends.append([np.hypot(*between(true[-1], poses[-1])[:2]) for poses in trajectories])
    steps.append([step_errors(poses, true) for poses in trajectories])
    print("misses by {:.2f} m with odometry, by {:.2f} m with icp".format(*ends[-1]))
per_step = np.mean(steps, axis=0)
for name, (ahead, side, heading) in zip(("odometry", "icp"), per_step, strict=True):
    print(f"{name:8}  a step: {ahead:.1f} mm ahead, {side:.1f} mm to the side, {heading:.3f}°")

# %% [markdown]
# In {= sum(by_icp < by_odometry for by_odometry, by_icp in ends) =} of {= len(ends) =} laps `icp` ends
# nearer to the start than dead reckoning does. The last two lines print the median errors of the steps,
# averaged over the laps. *Ahead*, `icp` is no better than the odometry: the lidar measures mostly plain walls,
# and a shift along a plain wall does not change the scan. To the side, the error of `icp` is smaller by a
# factor of {= per_step[0, 1] / per_step[1, 1]:.0f =}, and in the *heading* by a factor of
# {= per_step[0, 2] / per_step[1, 2]:.0f =}. The heading errors had caused most of the drift. But the errors of
# `icp` accumulate, too, so its trajectory also drifts, only more slowly.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## A real robot: the Intel data set
#
# A simulator contains only the effects that its author knows. So we now use a log of a real robot, which many
# papers on SLAM have used. A robot drove
# for {= intel_maps.stored().minutes:.0f =} minutes through the Intel Research Lab in Seattle, along
# the same corridors several times. Dirk Hähnel recorded odometry and scans of 180 beams. We use
# {= intel_maps.stored().readings =} scans of his log, about one every
# {= intel_maps.stored().path_length / intel_maps.stored().readings:.1f =} m. We may not redistribute the
# log, but you get the points of two maps that we computed from it: one by dead reckoning, and one by `icp` with
# the same settings as above.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-a-real-robot-the-intel-data-set"
# *For the lecturer:* Give the class a minute to find a wall that appears twice. Ask how far apart in time the
# two visits were. Students call the right map good; it is right in each room, but not as a whole.

# %% slideshow={"slide_type": "subslide"} name="ask-again"
ask(
    "01-again",
    "`icp` compares each scan only with the most recent ones. **The robot comes back to a "
    "corridor after ten minutes. How will this corridor appear in the map?**",
    {
        "once, and sharper": "more scans would make it sharper if the robot recognised the "
        "corridor.",
        "twice, side by side or crossing": "the drift of ten minutes separates the two visits, "
        "and nothing removes it.",
        "not at all": "all scans are drawn; none is rejected because it contradicts another.",
    },
    right="twice, side by side or crossing",
)

# %% slideshow={"slide_type": "fragment"} name="intel-maps" answers="01-again" tags=["nbval-check-output"]
intel = intel_maps.stored()
width = {name: np.ptp(intel.points[name], axis=0).max() for name in ("odometry", "icp")}
print(f"a path of {intel.path_length:.0f} m by odometry, {intel.readings} scans")
print(f"larger side of the map: {width['odometry']:.0f} m (odometry), {width['icp']:.0f} m (icp)")

# %% slideshow={"slide_type": "subslide"} name="intel-picture" answers="01-again" tags=["folded"]
fig, _ = views.side_by_side(
    {
        "odometry alone": [Points("naive", intel.points["odometry"])],
        "odometry and scan matching": [Points("corrected", intel.points["icp"])],
    },
    size=(9, 4.6),
    shared=False,
)
views.show(
    fig,
    f"Left: a tangle, {width['odometry']:.0f} m long. Right: rooms round a ring, {width['icp']:.0f} m "
    "across; many walls appear twice.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-again"
# The two maps have different scales: the left map is {= width["odometry"]:.0f =} m long, the right one
# {= width["icp"]:.0f =} m. With odometry alone, the laps are rotated relative to each other, and no
# room can be recognised. The right map shows a building. This log has no ground truth, but Kümmerle and others
# (2009) computed relative poses by matching scans of this log, and checked the results by hand. We compare with
# {= intel.relations =} of these relative poses. On average, the translations by dead reckoning are wrong by
# {= intel.off["odometry"]:.1f =} m, and the translations by `icp` by {= intel.off["icp"]:.2f =} m.
#
# But many walls of the right map appear twice, so this map is not consistent. The estimator **does not
# recognise a place that the robot has visited before**. Recognising such a place, and correcting the trajectory
# with this knowledge, is called **loop closure** (also *closing the loop*). Lesson 15 adds loop closure.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Simultaneous localisation and mapping
#
# - To place a scan on the map, the robot needs its **pose**. Estimating the pose in a known map is
#   called *localisation*.
# - To correct its pose, it needs a **map**. Estimating a map from known poses is called *mapping*.
# - At the start, the robot has neither. From the same readings it must estimate both the trajectory and the map:
#   *simultaneous localisation and mapping* (SLAM). The result should be a consistent map.
#
# The robot must also know **how uncertain** its estimates are. The position of a wall that was measured from an
# uncertain pose is uncertain, too. A loop closure can therefore correct the last pose, the earlier poses of the
# loop, and all walls that were mapped from these poses. The next lessons derive the equations for such
# corrections.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* ask which parts of the two maps by scan matching the class would trust, and why.
# Give the class time to look at the double walls of the real map: lesson 15 corrects them by loop closure.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## Literature
#
# - Randall Smith, Matthew Self and Peter Cheeseman, *Estimating uncertain spatial relationships in
#   robotics*, 1990: robot and landmarks in one estimate, with the correlations of their errors.
# - John Leonard and Hugh Durrant-Whyte, *Simultaneous map building and localization for an
#   autonomous mobile robot*, IROS 1991.
# - Johann Borenstein and Liqiang Feng, *Measurement and correction of systematic odometry errors in
#   mobile robots*, IEEE Transactions on Robotics and Automation, 1996: how to calibrate odometry.
# - Rainer Kümmerle and others, *On measuring the accuracy of SLAM algorithms*, Autonomous Robots,
#   2009: the measured relative poses of the Intel log.
#
# **Read next:** Hugh Durrant-Whyte and Tim Bailey, *Simultaneous localization and mapping: part I*,
# IEEE Robotics & Automation Magazine, 2006.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-literature"
# *For the lecturer:* The method of Borenstein and Feng measures the errors of a robot like Ben's from laps in
# both directions. With a real robot it is a good student project.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What comes next
#
# In the exercise you draw such maps with your own functions:
# [exercise 01](../exercises/ex01_why_slam.ipynb), 60 min. The exercise asks how drift grows on a trajectory of
# any shape, and how a robot can correct its trajectory if it sometimes returns to a known place.
#
# Then [02 · Sensors, odometry and simulated worlds](02_sensors_and_worlds.ipynb) examines the scans: what a
# sensor measures in a room, and what errors these measurements have.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-what-comes-next"
# *For the lecturer:* Close with one question: why does a wall appear twice, although every scan is good?
# Everybody should be able to answer it in one sentence.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the Intel log on your own computer
#
# These commands, in a terminal, fetch the log (3.7 MB) from where it is published, and compute both
# maps from its readings:
#
#     slamlab data get intel
#     slamlab run intel --estimator icp --out intel-map
#
# With `--estimator graph` the second command runs the estimator of lesson 15, which closes loops.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-intel-log-on-your-own-compute"
# *For the lecturer:* The download needs a network, and both commands take a while. Run them before the
# lecture if you want to show the maps.
