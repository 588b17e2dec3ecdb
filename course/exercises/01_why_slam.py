# %% [markdown]
# # Exercise 01 · Why SLAM
#
# **You will be able to** chain the steps that wheels report into a track, say how one pose looks from
# another, and predict how far a robot goes astray that only counts its steps. Then you will do this
# for a drive of any shape, and mend the track of a robot that came home now and then.
#
# **60 minutes. Before:** lesson [01 · Why SLAM](../notebooks/01_why_slam.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, and then run the check
# below it, as often as you like. A check tries random inputs and inputs at the edges. It says which
# law is broken, shows the smallest case that breaks it, and names the mistake if it knows it. Cells
# marked `@attempt` draw. They say "not attempted yet" until your functions are there, because every
# picture below is made by **your** functions.
#
# Now and then a question asks what you expect. Nobody grades it; your answer opens the cells that show
# what comes out.
#
# Lengths are in metres and angles in radians. A pose is `[x, y, θ]`, an array of three numbers. Its
# heading $\theta$ is counter-clockwise from +x and lies between $-\pi$ and $\pi$. No function may
# change its arguments: whoever called it still needs them.

# %%
from itertools import pairwise

import numpy as np

from slamlab import views, worlds
from slamlab.checks import ask, attempt, check
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import RPLIDAR_A2

# %% [markdown]
# ## 1 · One step
#
# After each step the odometry reports what the robot did, **as seen from where it was before**:
# `[forward, left, turn]`, in metres, metres and radians. A robot at `[2, 1, π/2]` looks along +y, so
# after a step `[0.5, 0, 0]` it stands at `[2, 1.5, π/2]`.
#
# Return the new pose: this is $\mathrm{pose} \oplus \mathrm{step}$ of (01.1), written out. Mind two
# things. The step was measured in the frame of the *old* pose, and the new heading has to lie between
# $-\pi$ and $\pi$ again.
#
# A step may be of any length, forward or back, to the left or to the right, and it may be no step at
# all. Its turn lies between $-\pi$ and $\pi$.


# %% name="next-pose"
def next_pose(pose, step):
    """The pose after a step.

    pose : (3,) x [m], y [m], θ [rad]
    step : (3,) forward [m], left [m], turn [rad], in the frame of pose
    returns (3,) x [m], y [m], θ [rad] in (-π, π]
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
# Dead reckoning chains such steps: each begins where the one before ended. Here it is, ready to use,
# with your `next_pose` inside. `tour` gives the steps of one lap round a corridor, half a metre each,
# with a quarter turn at each of the four corners. With `corner_error` the odometry reports every
# quarter turn a little too large, as that of a robot with a worn tyre does.


# %% name="tour"
def track(start, steps):
    """The poses (n + 1, 3) along a drive of n steps; the start (3,) is the first."""
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
    "The odometry reports every length correctly, and 3° too much at each of the four corners. "
    "**After "
    "the lap of 42 m, how far from its start does the robot believe itself to be?**",
    right=1.4,
    tolerance=0.3,
    unit="m",
    reason="the heading ends 12° off, but the errors come one by one, and a lap turns back to where it began.",
    wrong={
        8.7: "that would be right if the heading were 12° off on all 42 m, straight ahead. But the "
        "errors come one by one, and the path turns back.",
        2.2: "that is what one error of 3° does at the start of a straight drive of 42 m. Here "
        "there are four, and the path turns back.",
        0: "that is where it really is. But the robot believes its odometry, and four such sides "
        "do not close.",
    },
)


# %% name="lap" answers="ex01-lap"
@attempt
def _():
    fig, ax = views.axes("One lap, 3° too much at each corner")
    views.draw(ax, WALLS)
    views.draw(ax, Poses("truth", track(START, tour())))
    views.draw(ax, Poses("naive", track(START, tour(np.radians(3)))), label="odometry")
    views.legend(ax, loc="center")
    views.show(fig, alt="The true lap closes; the lap of the odometry leaves the corridor.")


# %% [markdown] answers="ex01-lap"
# The true lap closes. The lap of the odometry runs through the walls: after four corners its heading
# is wrong by 12°, and it does not come back to where it began.

# %% [markdown]
# The scans are taken where the robot *is*, but the map is drawn where the robot *believes* it is.
# `place` puts the points of a scan into the world, as the lesson did by (01.3). Move the slider, and
# look at the outer wall at the start, where the lap ends. How small must the error be for you to call
# the map good?


# %% name="map"
def place(pose, points):
    """A scan's points (n, 2), given in the robot's frame, in the world."""
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    return points @ np.array([[cos, sin], [-sin, cos]]) + pose[:2]


@attempt
def _():
    world, rng = worlds.corridor(), np.random.default_rng(1)
    truth = track(START, tour())[::2]
    scans = [RPLIDAR_A2.scan(world, pose, rng).points()[::3] for pose in truth]

    def draw(corner_error_in_degrees):
        believed = track(START, tour(np.radians(corner_error_in_degrees)))[::2]
        maps = {"where the robot is": truth, "where it believes it is": believed}
        panels = {}
        for title, poses in maps.items():
            xy = np.vstack([place(p, s) for p, s in zip(poses, scans, strict=True)])
            panels[title] = [Points("map", xy), Poses("robot", poses)]
        return views.side_by_side(panels)[0]

    views.explore(
        draw,
        alt="Left the corridor with sharp walls, right the same scans, smeared.",
        corner_error_in_degrees=(-6, 6, 3),
    )


# %% [markdown]
# The scans and the robot are the same. On the left they agree. On the right, every wall that was seen
# twice stands twice, and the corridor does not close. Nothing is wrong with the lidar: **a map is only
# as good as the poses it is drawn from**.

# %% [markdown]
# ## 2 · The gap
#
# How well does the lap close? Ask from its start: where is the end, seen from there? Return pose $b$
# as seen from pose $a$: how far ahead of $a$ it lies, how far to the left of $a$, and how much $a$
# would have to turn to look where $b$ looks. This undoes `next_pose`.
#
# The two poses may be anywhere, also in one place, and they may look anywhere. The turn has to lie
# between $-\pi$ and $\pi$.


# %% name="seen-from"
def seen_from(a, b):
    """Pose b in the frame of pose a.

    a, b : (3,) x [m], y [m], θ [rad], both in the world
    returns (3,) ahead [m], left [m], turn [rad] in (-π, π]
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
# Three degrees are hardly visible, and they open a gap of 1.4 m. The gap grows with the error.

# %% [markdown]
# ## 3 · How errors grow
#
# Let all errors now be due to chance. The robot drives **straight**: $n$ steps of $d$ metres, and
# **after** each step its heading errs a little more, each time by an independent random angle with
# mean 0 and standard deviation $\sigma$, `sigma` in the code. How far sideways of the line will it be
# at the end? Return the standard deviation in metres, for small angles ($\sin e \approx e$).
#
# Which of the steps does the first error bend, which the second, and which the last? How far sideways
# does one error lead, and how do the variances of independent errors add? The answer has to be exact
# for few steps as well: $n^3/3$ is not good enough.
#
# There may be no step at all or a thousand of them, and `d` or `sigma` may be 0.


# %% name="drift"
def drift(n, d, sigma):
    """How far sideways a straight drive ends, one standard deviation.

    n : int, steps
    d : float, length of a step [m]
    sigma : float, standard deviation of the heading error picked up after each step [rad]
    returns float [m]
    """
    ### BEGIN SOLUTION
    bends = np.arange(n)
    return sigma * d * np.sqrt(np.sum(bends**2))
    ### END SOLUTION


# %%
check("01-drift")

# %% [markdown]
# Does this happen? Let 300 robots drive 60 steps of half a metre, each with its own errors of 1° a
# step, and lay your formula over them.


# %% name="drift-drives"
@attempt
def _():
    rng, n, d, sigma = np.random.default_rng(3), 60, 0.5, np.radians(1.0)
    lengths = d * np.arange(n + 1)
    fig, ax = views.chart("way driven [m]", "sideways of the line [m]", "300 robots, 1° a step")
    spread, ends = np.array([drift(k, d, sigma) for k in range(n + 1)]), []
    for robot in range(300):
        steps = np.column_stack([np.full(n, d), np.zeros(n), sigma * rng.standard_normal(n)])
        sideways = track(START, steps)[:, 1]
        ends.append(sideways[-1])
        label = "robots" if robot == 0 else None
        ax.plot(lengths, sideways, color=views.COLOURS["naive"], lw=0.4, alpha=0.4, label=label)
    for sign, label in ((2, "your ± 2 standard deviations"), (-2, None)):
        ax.plot(lengths, sign * spread, color=views.COLOURS["truth"], lw=2, label=label)
    views.legend(ax, loc="upper left")
    held = np.mean(np.abs(ends) <= 2 * spread[-1])
    views.show(
        fig, alt=f"{len(ends)} tracks fan out; {100 * held:.0f} % end between the formula's curves."
    )


# %% [markdown]
# Most tracks stay between your two curves: 289 of the 300 robots end there, where 95 % would be
# 285. The fan opens faster than the distance grows: after twice the distance the drift is nearly
# three times as large.

# %% [markdown]
# ## 4 · Any drive
#
# No robot drives straight for long. Now it drives along any path, and its wheels err in both of the
# ways that the lesson tells apart:
#
# - each step is longer or shorter **in the direction in which the robot moved**, by an independent
#   random share of its length with mean 0 and standard deviation `length_error` (0.02 is 2 %);
# - after each step, also after the last one, all that follows is turned by an independent random
#   angle with mean 0 and standard deviation `heading_error`, in radians.
#
# `poses` is the track as it was meant, with the start first. How far off will the end be in $x$, and
# how far in $y$? Return both standard deviations, for small errors: $\sin e \approx e$,
# $\cos e \approx 1$, and products of two errors count nothing.
#
# For the straight drive you asked what *one* error does to the end, and then added up the variances.
# Do the same here. An error of heading at pose $k$ turns the whole rest of the track about that pose,
# as if it were cut from cardboard. Which way does the end go, and how far? A robot may also move
# sideways, so look at where its poses lie and not at where it looks.

# %%
ask(
    "ex01-harm",
    "A lap ends where it began, and a single error of heading is made at one of its poses. **Where "
    "along the lap does it do most harm to the end?**",
    {
        "at the beginning: all that follows is turned": "all of it is turned, about the place where the error was made. But the end of the lap lies just "
        "there, and stays.",
        "half way round": "what counts is how far the end lies from the place of the error, and on a lap it is farthest "
        "away from the other side.",
        "shortly before the end: nothing can make up for it": "nothing does, but only a short "
        "stretch is left that it can bend.",
        "the same everywhere": "each error turns all that follows by the same angle. But how far the end moves by that depends "
        "on how far away it is.",
    },
    right="half way round",
)

# %% [markdown]
# A track has one pose or more. Poses may lie in one place, because a robot may turn on the spot, and
# the errors may be 0.


# %% name="miss"
def miss(poses, length_error, heading_error):
    """How far the end of a drive is off, one standard deviation in x and one in y.

    poses : (n + 1, 3) the drive as it was meant, the start first [m, m, rad]
    length_error : float, standard deviation of each step's error, as a share of its length
    heading_error : float, standard deviation of the turn picked up after each step [rad]
    returns (2,) in the world's x and in its y [m]
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
# Let 400 robots drive the lap, with 2 % and 1° a step, and lay a frame over where they end. It reaches
# twice your standard deviations to all four sides of the start.


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
    fig, ax = views.axes("Where 400 laps end, and your ± 2 standard deviations", size=(6, 4.5))
    views.draw(ax, Points("naive", np.array(ends)[:, :2]))
    views.draw(ax, Segments("corrected", sides))
    views.show(fig, alt="A cloud of ends round the start, in a frame that holds most of them.")


# %% [markdown]
# Of the 400 robots 18 leave the frame at its left or right side, and 11 at its top or bottom. Two
# standard deviations should lose 18 each time, give or take four, so your formula fits. The cloud
# leans to one side, which two numbers cannot say. A covariance can, from lesson 03 on.
#
# Here is what a single error of 1° does to the end, made at each pose of the lap.


# %% name="harm" answers="ex01-harm"
@attempt
def _():
    n = len(tour())
    harm = []
    for k in range(n):
        steps = tour()
        steps[k, 2] += np.radians(1)
        harm.append(100 * np.hypot(*track(START, steps)[-1, :2]))
    fig, ax = views.chart("error of 1° made after [m]", "moves the end by [cm]", "One lap of 42 m")
    ax.plot(0.5 * np.arange(1, n + 1), harm, color=views.COLOURS["truth"])
    views.show(fig, alt="A curve that is zero at both ends of the lap and highest half way round.")


# %% [markdown] answers="ex01-harm"
# What counts is the straight line from the error to the end, and not the path that was driven
# between them. An error at the far side of the building is the worst. One that is made at the start
# turns the whole lap about its beginning, and the end of the lap lies just there, so it stays where
# it is: **a lap that closes proves little about its headings at the start, and much about those
# half way round**.

# %% [markdown]
# ## 5 · Make it better: home again
#
# Better wheels change none of this, they only delay it. Something must notice that the robot **has
# been here before**. The simplest such thing is a dock: it holds the robot in one place, and it
# clicks. Whenever the robot is docked, its pose is known exactly: it is the pose at the start.
#
# A robot drives laps of a house, to the left or to the right, and each lap ends in the dock. After
# the last one it may drive on. Its wheels err in three ways:
#
# - a worn tyre makes it report **every turn too large, or every turn too small, by one factor** of 1 %
#   to 18 %. The factor is the same for the whole drive, but each robot has its own, and nobody knows
#   it;
# - besides, each turn errs at random, with a standard deviation of 0.01 rad (0.6°);
# - the length of each step errs at random, with a standard deviation of 1.5 %.
#
# Return the best track of the whole drive that you can. Any method goes. These questions may help:
#
# - Where is the robot whenever it is docked? Is it enough to start afresh from there?
# - The lap that the wheels report does not close. By how much does it miss its start in place, and by
#   how much in heading? Which of the steps in between are to blame, and how would you share out both?
# - By how much does a robot turn altogether in a lap? And by how much did this one say it did?
# - What do the laps of one drive have in common, and what does this say about the path after the
#   last lap, which no dock corrects?
#
# Only places are scored: how far all poses of all tracks are off (the root of the mean square,
# rms). Sixteen robots drive one route. Points come in three steps: for less than 2.2 m, for less
# than 0.7 m and for less than 0.165 m. Dead reckoning is off by about 4 m.
# The check stops after 10 s.
#
# There is at least one lap. Each lap is a round trip to the left or to the right in steps of about
# half a metre, and all its turns together, including the one in the dock, are one full turn. A
# house has four corners, but no corner need be a right angle and no wall quite straight. The robot
# does not slip sideways. There may be any number of laps, and perhaps nothing follows the last one.


# %% name="home"
def home(start, steps, docked):
    """The best track of a drive that came back to its start now and then.

    start : (3,) the known pose at the beginning, in the dock
    steps : (n, 3) forward [m], left [m], turn [rad], as the wheels tell them
    docked : list of int, rows of the track at which the robot was docked again, ascending
    returns (n + 1, 3), the start first
    """
    ### BEGIN SOLUTION
    steps = steps.copy()
    laps = list(zip([0, *docked[:-1]], docked, strict=True))
    told = np.array([steps[i:j, 2].sum() for i, j in laps])
    truly = 2 * np.pi * np.sign(told)
    steps[:, 2] /= told @ truly / (truly @ truly)  # the factor that fits all laps best
    poses = [np.array([start])]
    for (i, j), turned in zip(laps, truly, strict=True):
        lap = steps[i:j].copy()
        lap[:, 2] += (turned - lap[:, 2].sum()) / len(lap)
        told_lap = track(start, lap)
        gap = start[:2] - told_lap[-1, :2]
        told_lap[:, :2] += np.linspace(0, 1, len(told_lap))[:, None] * gap
        poses.append(told_lap[1:])
    poses.append(track(start, steps[docked[-1] :])[1:])
    return np.concatenate(poses)
    ### END SOLUTION


# %%
check("01-home")

# %% [markdown]
# Here are drives of your own, with the truth beside them. Move the slider.


# %% name="at-home"
def laps_of_a_house(seed):
    """The true steps of three laps and a way beyond, as the wheels tell them, and the dockings."""
    rng, laps = np.random.default_rng(seed), []
    for side in [*rng.permutation([1, 1, -1]), 0]:
        a, b = rng.uniform(4, 6, 2)
        corners = np.array([0, 2, 2 + 1j * b, 2 - a + 1j * b, 2 - a, 0])
        corners[1:-1] += rng.uniform(-0.6, 0.6, 4) + 1j * rng.uniform(-0.6, 0.6, 4)
        if side == 0:
            corners = corners[:-1] * 1.2  # the way beyond is not closed
        z = [np.linspace(p, q, round(2 * abs(q - p)), endpoint=False) for p, q in pairwise(corners)]
        ways = np.diff(np.append(np.concatenate(z), corners[-1]))
        turns = np.angle(np.roll(ways, -1) / ways)
        laps.append(np.column_stack([abs(ways), 0 * turns, turns if side >= 0 else -turns]))
    truly, docked = np.concatenate(laps), np.cumsum([len(lap) for lap in laps[:3]]).tolist()
    told = truly * [1, 1, 1 + rng.choice([-1, 1]) * rng.uniform(0.01, 0.18)]
    told[:, 0] *= 1 + 0.015 * rng.standard_normal(len(told))
    told[:, 2] += 0.01 * rng.standard_normal(len(told))
    return truly, told, docked


@attempt
def _():
    def draw(drive):
        truly, told, docked = laps_of_a_house(drive)
        truth = track(START, truly)
        tracks = {"dead reckoning": track(START, told), "your track": home(START, told, docked)}
        shown = {}
        for (title, poses), name in zip(tracks.items(), ("naive", "corrected"), strict=True):
            off = np.sqrt(np.mean(np.sum((np.asarray(poses) - truth)[:, :2] ** 2, axis=1)))
            title = f"{title}: {off:.2f} m off"
            shown[title] = [Poses("truth", truth), Poses(name, np.asarray(poses))]
        return views.side_by_side(shown, size=(9, 4))[0]

    views.explore(
        draw,
        alt="Three laps as told by wheels, and as mended, over the true ones.",
        drive=(0, 20, 3),
    )


# %% [markdown]
# The click of a dock says nothing about wheels. Yet it has told you how worn a tyre is, and it has put
# right hundreds of poses in the past. A robot has no dock in every room, but it sees **walls**, and it
# can notice that it has seen them before. This is SLAM, and the rest of the course.
#
# **Next:** lesson [02 · Sensors and worlds](../notebooks/02_sensors_and_worlds.ipynb). Save the
# notebook first. The cell below then says what the grader will say about it; the grader draws other
# inputs. Hand it in as it is.
