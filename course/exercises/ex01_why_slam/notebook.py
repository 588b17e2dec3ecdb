# %% [markdown]
# # Exercise 01 · Why SLAM
#
# **You will be able to** compute a trajectory from odometry increments, express one pose in the frame
# of another, and compute how far a robot drifts under dead reckoning, on a straight run and on any run.
# At the end you will correct the trajectory of a robot by loop closures.
#
# **60 minutes. Before:** lesson [01 · Why SLAM](../notebooks/01_why_slam.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, and then run the check
# below it. You can repeat this as often as you like. A check draws random inputs and tries special
# cases. It names the law that your answer breaks and shows the smallest case that breaks it. When
# you are stuck, run `hint("01-next-pose")` in a cell of your own: it asks a question about your
# mistake; run it again for more. Cells marked `@attempt` draw figures with **your** functions. They
# print "not attempted yet" until you have written these functions.
#
# Some questions ask what you expect. They are not graded. After your answer, the cells with the
# result become visible.
#
# Lengths are in metres and angles in radians. A pose is `[x, y, θ]`, an array of three numbers. Its
# heading $\theta$ is measured counter-clockwise from +x and lies between $-\pi$ and $\pi$. A
# function must not change its arguments, because its caller still needs them.

# %%
from itertools import pairwise

import numpy as np

from classroom.checks import ask, attempt, check
from slamlab import views
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import RPLIDAR_A2, worlds

# %% [markdown]
# ## 1 · Pose composition
#
# After each step the odometry reports one increment, **in the robot frame of the pose before the
# step**: `[forward, left, turn]`, in metres, metres and radians. A robot at `[2, 1, π/2]` faces
# along +y. After a step `[0.5, 0, 0]` its pose is `[2, 1.5, π/2]`.
#
# **Your task.** Return the new pose (3,): $\mathrm{pose} \oplus \mathrm{step}$ of (01.1). The check
# judges the position and the heading. A step may have any length and any direction, and it may be
# zero. Its turn lies between $-\pi$ and $\pi$.


# %% name="next-pose"
def next_pose(pose, step):
    """The pose after a step.

    pose : (3,) x [m], y [m], θ [rad]
    step : (3,) forward [m], left [m], turn [rad], in the robot frame of pose
    returns (3,) x [m], y [m], θ [rad] in [-π, π]
    """
    ### BEGIN SOLUTION
    x, y, theta = pose
    forward, left, turn = step
    c, s = np.cos(theta), np.sin(theta)
    heading = theta + turn
    return np.array(
        [
            x + c * forward - s * left,
            y + s * forward + c * left,
            np.arctan2(np.sin(heading), np.cos(heading)),
        ]
    )
    ### END SOLUTION


# %%
check("01-next-pose")

# %% [markdown]
# Dead reckoning composes such steps: each step begins at the pose where the previous step ended.
# The function `track` below does this with your `next_pose`. `tour` returns the steps of one lap
# round a corridor, half a metre each, with a quarter turn at each of the four corners. The odometry
# reports every quarter turn too large by the angle `corner_error`. This is a systematic error, for
# example caused by a worn tyre.


# %% name="tour"
def track(start, steps):
    """The trajectory (n + 1, 3) of n steps; the start (3,) is its first pose."""
    poses = [start]
    for step in steps:
        poses.append(next_pose(poses[-1], step))
    return np.array(poses)


def tour(corner_error=0.0):
    """Steps (84, 3) of one lap round the corridor; corner_error in radians."""
    legs = [24, 16, 26, 16, 2]
    steps = np.zeros((sum(legs), 3))
    steps[:, 0] = 0.5
    steps[np.cumsum(legs[:-1]) - 1, 2] = np.pi / 2 + corner_error
    return steps


START = np.zeros(3)
WALLS = Segments("walls", worlds.corridor().outline())

# %%
ask(
    "ex01-lap",
    "The odometry reports every length correctly, but at each of the four corners the reported "
    "turn is 3° too large. **After the lap of 42 m, how far is the position by dead reckoning from "
    "the start?**",
    right=1.4,
    tolerance=0.3,
    unit="m",
    reason="the heading error reaches 12° only after the last corner, and the lap leads back to its start.",
    wrong={
        8.7: "this would be right for a straight run of 42 m with a heading error of 12°. But the "
        "error grows at each corner, and the trajectory leads back to the start.",
        2.2: "this is the effect of one error of 3° at the start of a straight run of 42 m. Here "
        "there are four errors, and the trajectory leads back to the start.",
        0: "this is the true position. The trajectory by odometry is not closed.",
    },
)


# %% name="lap" answers="ex01-lap"
@attempt
def _():
    fig, ax = views.axes("One lap, 3° too much at each corner")
    views.draw(ax, WALLS)
    views.draw(ax, Poses("truth", track(START, tour())), label="ground truth")
    views.draw(ax, Poses("naive", track(START, tour(np.radians(3)))), label="dead reckoning")
    views.legend(ax, loc="center")
    views.show(
        fig,
        alt="The true trajectory is closed; the trajectory of dead reckoning leaves the corridor.",
    )


# %% [markdown] answers="ex01-lap"
# The true trajectory is closed. The trajectory of dead reckoning crosses the walls. After four
# corners its heading is wrong by 12°, and it does not return to its start.

# %% [markdown]
# The scans are taken from the *true* poses, but the map is drawn from the *estimated* poses. The function
# `place` transforms the points of a scan to the world frame by (01.3). Move the slider, and look at the
# outer wall near the start, where the lap ends. How small must the error be for a consistent map?


# %% name="map"
def place(pose, points):
    """Points of a scan (n, 2), transformed from the robot frame to the world frame."""
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    return points @ np.array([[cos, sin], [-sin, cos]]) + pose[:2]


@attempt
def _():
    world, rng = worlds.corridor(), np.random.default_rng(1)
    truth = track(START, tour())[::2]
    scans = [RPLIDAR_A2.scan(world, pose, rng).points()[::3] for pose in truth]

    def draw(corner_error_in_degrees):
        reckoned = track(START, tour(np.radians(corner_error_in_degrees)))[::2]
        maps = {"ground-truth poses": truth, "poses by dead reckoning": reckoned}
        panels = {}
        for title, poses in maps.items():
            xy = np.vstack([place(p, s) for p, s in zip(poses, scans, strict=True)])
            panels[title] = [Points("map", xy), Poses("robot", poses)]
        return views.side_by_side(panels)[0]

    views.explore(
        draw,
        alt="On the left the corridor with sharp walls, on the right the same scans with blurred walls.",
        corner_error_in_degrees=(-6, 6, 3),
    )


# %% [markdown]
# The scans are the same in both maps. The left map is consistent. In the right map, every wall that
# was measured twice appears twice, and the corridor is not closed. The lidar is not the cause: **a
# map is only as accurate as the poses from which it is drawn**.

# %% [markdown]
# ## 2 · The relative pose
#
# How large is the gap between the start and the end of the lap? To compute this gap, we express the
# last pose in the frame of the first pose.
#
# **Your task.** Return pose $b$ in the frame of pose $a$, (3,): the distance ahead of $a$, the
# distance to the left of $a$, and the turn from the heading of $a$ to the heading of $b$. This is
# the inverse of `next_pose`: if a robot at $a$ makes the returned step, it reaches $b$. The check
# judges the position and the turn. The two poses may have any positions, also the same position,
# and any headings. The turn must lie between $-\pi$ and $\pi$.


# %% name="seen-from"
def seen_from(a, b):
    """Pose b in the frame of pose a.

    a, b : (3,) x [m], y [m], θ [rad], both in the world frame
    returns (3,) ahead [m], left [m], turn [rad] in [-π, π]
    """
    ### BEGIN SOLUTION
    c, s = np.cos(a[2]), np.sin(a[2])
    dx, dy = b[0] - a[0], b[1] - a[1]
    turn = b[2] - a[2]
    return np.array([c * dx + s * dy, -s * dx + c * dy, np.arctan2(np.sin(turn), np.cos(turn))])
    ### END SOLUTION


# %%
check("01-seen-from")


# %% name="gap" answers="ex01-lap"
@attempt
def _():
    for degrees in (1, 2, 3, 6):
        lap = track(START, tour(np.radians(degrees)))
        ahead, left, turn = seen_from(lap[0], lap[-1])
        print(
            f"{degrees}° a corner: the lap ends {ahead:+.2f} m ahead, {left:+.2f} m to the left, "
            f"turned by {np.degrees(turn):+.0f}°"
        )


# %% [markdown] answers="ex01-lap"
# An error of 3° is hardly visible, but it causes a gap of 1.4 m. The gap grows with the error.

# %% [markdown]
# ## 3 · Drift on a straight run
#
# In this task all errors are random. The robot drives **straight ahead** in $n$ steps of $d$
# metres. **After** each step its heading gets an independent random error, with mean 0 and standard
# deviation $\sigma$ (`sigma` in the code). The robot does not correct this error.
#
# **Your task.** Return the standard deviation of the final position perpendicular to the line, in
# metres, for small angles ($\sin e \approx e$).
#
# An error changes the direction of all steps that follow it. How many steps follow the first error,
# how many follow the second error, and how many follow the last error? How far does a single error
# move the end sideways? How do the variances of independent errors add? The check allows a relative
# error of 0.02 %, also for few steps. The approximation $n^3/3$ in (01.6) is not accurate enough.
# `n` may be 0 or as large as 1000, and `d` or `sigma` may be 0.


# %% name="drift"
def drift(n, d, sigma):
    """Standard deviation of the final position across the line, on a straight run.

    n : int, number of steps
    d : float, length of a step [m]
    sigma : float, standard deviation of the heading error made after each step [rad]
    returns float [m]
    """
    ### BEGIN SOLUTION
    bends = np.arange(n)
    return sigma * d * np.sqrt(np.sum(bends**2))
    ### END SOLUTION


# %%
check("01-drift")

# %% [markdown]
# The next cell compares your formula with a simulation: 300 robots drive 60 steps of half a metre,
# each with its own heading errors of σ = 1° per step.


# %% name="drift-drives"
@attempt
def _():
    rng, n, d, sigma = np.random.default_rng(3), 60, 0.5, np.radians(1.0)
    lengths = d * np.arange(n + 1)
    title = "300 robots, heading errors of σ = 1° per step"
    fig, ax = views.chart("distance driven [m]", "position across the line [m]", title)
    spread, ends = np.array([drift(k, d, sigma) for k in range(n + 1)]), []
    for robot in range(300):
        steps = np.column_stack([np.full(n, d), np.zeros(n), sigma * rng.standard_normal(n)])
        across = track(START, steps)[:, 1]
        ends.append(across[-1])
        label = "robots" if robot == 0 else None
        ax.plot(lengths, across, color=views.COLOURS["naive"], lw=0.4, alpha=0.4, label=label)
    for sign, label in ((2, "your ± 2 standard deviations"), (-2, None)):
        ax.plot(lengths, sign * spread, color=views.COLOURS["truth"], lw=2, label=label)
    views.legend(ax, loc="upper left")
    held = np.mean(np.abs(ends) <= 2 * spread[-1])
    alt = f"{len(ends)} trajectories spread; {100 * held:.0f} % end between the formula's curves."
    views.show(fig, alt=alt)


# %% [markdown]
# With a correct formula, 289 of the 300 robots end between your two curves. The expected number is
# 95 %, which is 285. The drift grows faster than the distance: after twice the distance it is
# nearly three times as large.

# %% [markdown]
# ## 4 · Drift on any run
#
# Real trajectories are not straight. In this task the robot drives along any trajectory, with the
# two kinds of random errors of the lesson:
#
# - Each step is longer or shorter **in the direction in which the robot moved**. The relative error
#   of its length is random and independent, with mean 0 and standard deviation `length_error` (0.02
#   is 2 %).
# - After each step, also after the last step, an independent random heading error turns the
#   remaining trajectory. It has mean 0 and standard deviation `heading_error`, in radians.
#
# **Your task.** `poses` is the planned trajectory, with the start first. Return the standard
# deviations of the final position in $x$ and in $y$, (2,) in metres, for small errors: use $\sin e \approx e$ and $\cos
# e \approx 1$, and neglect products of two errors. The check allows an error of 0.03 % of each of the two numbers, also
# on runs of $10^{12}$ m, where finite differences are too inaccurate.
#
# On the straight run you computed how far *one* error moves the end, and then added the variances.
# Do the same here. A heading error at pose $k$ rotates the rest of the trajectory about this pose,
# without changing its shape. In which direction does the end move, and how far? A robot may also
# move sideways, so use the positions of the poses and not their headings.

# %%
ask(
    "ex01-harm",
    "A lap ends at its start, and a single heading error occurs at one of its poses. **At which "
    "pose of the lap does this error move the end farthest?**",
    {
        "at the beginning: the error turns the whole lap": "the error turns the whole lap about "
        "its start. But the end of the lap has the same position as the start, so it does not move.",
        "half way round": "the end moves by the angle times its distance from the position of the "
        "error. This distance is largest after half of the lap.",
        "shortly before the end: nothing can correct it": "no later step corrects the error, but "
        "the error turns only the short rest of the lap.",
        "the same everywhere": "each error turns the rest of the lap by the same angle. But the "
        "motion of the end depends on its distance from the position of the error.",
    },
    right="half way round",
)

# %% [markdown]
# A trajectory has one or more poses. Several poses may have the same position, because a robot may
# turn on the spot. Each of the two standard deviations may be 0.


# %% name="miss"
def miss(poses, length_error, heading_error):
    """Standard deviations of the final position of a run, in x and in y.

    poses : (n + 1, 3) the planned trajectory, the start first [m, m, rad]
    length_error : float, standard deviation of each step's relative length error
    heading_error : float, standard deviation of the heading error made after each step [rad]
    returns (2,) along the world's x and y axes [m]
    """
    ### BEGIN SOLUTION
    xy = poses[:, :2]
    step = np.diff(xy, axis=0)
    to_end = xy[-1] - xy[1:]
    turned = to_end[:, ::-1] * [-1, 1]
    variance = length_error**2 * np.sum(step**2, axis=0)
    variance += heading_error**2 * np.sum(turned**2, axis=0)
    return np.sqrt(variance)
    ### END SOLUTION


# %%
check("01-miss")

# %% [markdown]
# The next cell compares your result with a simulation: 400 robots drive the lap, with length errors
# of 2 % and heading errors of 1° per step. The rectangle extends from the start by twice your
# standard deviations to each side.


# %% name="ends"
@attempt
def _():
    rng, lap = np.random.default_rng(5), track(START, tour())
    ends = []
    for _ in range(400):
        steps = tour()
        steps[:, 0] *= 1 + 0.02 * rng.standard_normal(len(steps))
        steps[:, 2] += np.radians(1) * rng.standard_normal(len(steps))
        ends.append(track(START, steps)[-1])
    x, y = 2 * np.asarray(miss(lap, 0.02, np.radians(1)))
    sides = [[-x, -y, x, -y], [x, -y, x, y], [x, y, -x, y], [-x, y, -x, -y]]
    fig, ax = views.axes("End positions of 400 laps, your ± 2 standard deviations", size=(6, 4.5))
    views.draw(ax, Points("naive", np.array(ends)[:, :2]))
    views.draw(ax, Segments("corrected", sides))
    views.show(fig, alt="End positions round the start, most of them inside a rectangle.")


# %% [markdown]
# With a correct formula, 18 of the 400 robots end to the left or right of the rectangle, and 11 end
# above or below it. In each direction the expected number is 18, with a standard deviation of about
# 4, so both numbers agree with the formula. The errors in $x$ and $y$ are correlated. Two standard
# deviations cannot describe this correlation, but a covariance matrix can (lesson 03).
#
# The next figure shows how far a single error of 1° moves the end, for each pose of the lap.


# %% name="harm" answers="ex01-harm"
@attempt
def _():
    n = len(tour())
    harm = []
    for k in range(n):
        steps = tour()
        steps[k, 2] += np.radians(1)
        harm.append(100 * np.hypot(*track(START, steps)[-1, :2]))
    title = "One heading error of 1° on a lap of 42 m"
    fig, ax = views.chart("error made after [m]", "motion of the end [cm]", title)
    ax.plot(0.5 * np.arange(1, n + 1), harm, color=views.COLOURS["truth"])
    views.show(fig, alt="A curve that is zero at both ends of the lap and highest in the middle.")


# %% [markdown] answers="ex01-harm"
# The effect depends on the straight distance from the position of the error to the end, and not on
# the distance driven. An error in the middle of the lap moves the end farthest. An error at the
# start turns the whole lap about its start. The end of the lap has the same position as the start,
# so it does not move. **A loop closure therefore gives little information about heading errors near
# the start or the end of the lap, and much information about heading errors in the middle.**

# %% [markdown]
# ## 5 · Make it better: loop closure at a dock
#
# Better wheels reduce drift, but they do not remove it. The robot must recognise that it **has
# returned to a known place**: this is a loop closure. The simplest method is a dock, which holds
# the robot in a fixed pose. Whenever the robot is docked, its pose is known exactly: it is the
# start pose.
#
# A robot drives laps round a house, to the left or to the right, and each lap ends in the dock.
# After the last lap it may continue to drive. Its odometry has three errors:
#
# - A systematic error: because of a worn tyre, **every reported turn is the true turn times a
#   constant factor**. For one half of the robots the factor lies between 0.82 and 0.99, so every
#   turn is reported too small. For the other half it lies between 1.01 and 1.18, so every turn is
#   reported too large. The factor is the same in the whole run. It is unknown and different for
#   each robot.
# - A random error of the turn of each step, with mean 0 and a standard deviation of 0.01 rad
#   (0.6°). It also occurs in steps without a turn.
# - A random relative error of the length of each step, with mean 0 and a standard deviation of
#   1.5 %.
#
# **Your task.** Return an estimated trajectory of the whole run, $(n + 1, 3)$, with the smallest
# possible position error. Any method is allowed. These questions may help:
#
# - What is the pose of the robot whenever it is docked? Is it enough to start again from this pose?
# - The lap by odometry is not closed. How large is the gap in position, and how large is the gap in
#   heading? In which steps did these errors occur, and how would you distribute the two gaps over
#   the steps?
# - How large is the sum of all turns in a lap? How large is this sum by odometry?
# - Which error is the same in all laps of a run? How can you use this for the steps after the last
#   lap, which do not end in the dock?
#
# A run has one or more laps. Each lap is a round trip to the left or to the right in steps of about
# half a metre. The robot leaves the dock with the heading of the start pose. At the end of a lap it
# turns in the dock until it has this heading again. This turn is part of the last step of the lap.
# The first lap consists of the rows 0 to `docked[0] - 1` of `steps`, and the next one of the rows
# `docked[0]` to `docked[1] - 1`. The sum of the true turns of a lap is exactly $2\pi$ (a lap to the
# left) or $-2\pi$ (a lap to the right). A house has four corners, but the corners may not be right
# angles, and the walls are not exactly straight. The robot does not slip sideways. A run may end
# with its last lap.
#
# The check scores only positions: the root mean square (rms) position error over all poses of
# sixteen runs. The true trajectory and `docked` are the same in all of these runs, but each robot
# has its own errors. Each call of your function gets one run. The rms error of dead reckoning is
# about 4 m. A reference solution, which uses all of the above, has an rms error of about 0.1 m. The
# check stops after 10 s.
#
# | rms position error | points |
# | --- | --- |
# | below 2.2 m | 0.5 |
# | below 1 m | 2 |
# | in the laps at most 1.15 times, and after the last lap at most 1.7 times, that of the reference solution | 3 |
#
# The points of all rows that you reach are added. Leaving the arguments unchanged is worth another
# 0.5 points. The limit of the first row must also hold for four runs with a single lap and nothing
# after it, and for four runs with five laps.


# %% name="home"
def home(start, steps, docked):
    """The estimated trajectory of a run that returned to its start several times.

    start : (3,) the known pose at the beginning, in the dock
    steps : (n, 3) forward [m], left [m], turn [rad], by odometry
    docked : list of int, rows of the trajectory at which the robot was docked again, ascending
    returns (n + 1, 3), the start first
    """
    ### BEGIN SOLUTION
    steps = steps.copy()
    laps = list(zip([0, *docked[:-1]], docked, strict=True))
    reported = np.array([steps[i:j, 2].sum() for i, j in laps])
    truly = 2 * np.pi * np.sign(reported)
    steps[:, 2] /= reported @ truly / (truly @ truly)  # least-squares fit of the factor to all laps
    poses = [np.array([start])]
    for (i, j), turned in zip(laps, truly, strict=True):
        lap = steps[i:j].copy()
        lap[:, 2] += (turned - lap[:, 2].sum()) / len(lap)
        chained = track(start, lap)
        gap = start[:2] - chained[-1, :2]
        chained[:, :2] += np.linspace(0, 1, len(chained))[:, None] * gap
        poses.append(chained[1:])
    poses.append(track(start, steps[docked[-1] :])[1:])
    return np.concatenate(poses)
    ### END SOLUTION


# %%
check("01-home")

# %% [markdown]
# Here you can test your method on simulated runs with known ground truth. Move the slider.


# %% name="at-home"
def laps_of_a_house(seed):
    """Three laps and some more steps: the true steps, the steps by odometry, and the rows
    docked."""
    rng, laps = np.random.default_rng(seed), []
    for side in [*rng.permutation([1, 1, -1]), 0]:
        a, b = rng.uniform(4, 6, 2)
        corners = np.array([0, 2, 2 + 1j * b, 2 - a + 1j * b, 2 - a, 0])
        corners[1:-1] += rng.uniform(-0.6, 0.6, 4) + 1j * rng.uniform(-0.6, 0.6, 4)
        if side == 0:
            corners = corners[:-1] * 1.2  # the steps after the last lap do not close
        z = [np.linspace(p, q, round(2 * abs(q - p)), endpoint=False) for p, q in pairwise(corners)]
        moves = np.diff(np.append(np.concatenate(z), corners[-1]))
        turns = np.angle(np.roll(moves, -1) / moves)
        laps.append(np.column_stack([abs(moves), 0 * turns, turns if side >= 0 else -turns]))
    truly, docked = np.concatenate(laps), np.cumsum([len(lap) for lap in laps[:3]]).tolist()
    reported = truly * [1, 1, 1 + rng.choice([-1, 1]) * rng.uniform(0.01, 0.18)]
    reported[:, 0] *= 1 + 0.015 * rng.standard_normal(len(reported))
    reported[:, 2] += 0.01 * rng.standard_normal(len(reported))
    return truly, reported, docked


@attempt
def _():
    def draw(run):
        truly, steps, docked = laps_of_a_house(run)
        truth = track(START, truly)
        estimates = track(START, steps), home(START, steps, docked)
        names, shown = {"dead reckoning": "naive", "your trajectory": "corrected"}, {}
        for (title, name), poses in zip(names.items(), estimates, strict=True):
            rms = np.sqrt(np.mean(np.sum((np.asarray(poses) - truth)[:, :2] ** 2, axis=1)))
            title = f"{title}: rms error {rms:.2f} m"
            shown[title] = [Poses("truth", truth), Poses(name, np.asarray(poses))]
        return views.side_by_side(shown, size=(9, 4))[0]

    views.explore(
        draw,
        alt="Three laps: by dead reckoning, corrected by your function, and the true laps.",
        run=(0, 20, 3),
    )


# %% [markdown]
# A dock does not measure the wheels. But with the dock you calibrated the odometry and corrected
# hundreds of past poses. Most rooms have no dock, but a robot measures **walls**, and the robot can
# recognise walls that it has mapped before. This is SLAM, the subject of the course.
#
# **Next:** lesson [02 · Sensors, odometry and simulated
# worlds](../notebooks/02_sensors_and_worlds.ipynb). Save the notebook first. The cell below then
# shows the result of the grader. The grader draws other inputs. Submit the notebook without further
# changes.
