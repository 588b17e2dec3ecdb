# %% [markdown]
# # Exercise 01 · Why SLAM
#
# You write five short functions. With them a robot drives round a corridor, believes its wheels,
# and draws a map that does not fit together. Nothing is drawn for you: every picture below is made
# by **your** functions, so it is right as soon as they are.
#
# - Replace each `raise NotImplementedError(...)` by your code and run the cell.
# - Run the cell with `check(...)` below it. It tries your function on random inputs and says which
#   laws hold, and what the mistake is where it knows it.
# - Cells marked `@attempt` draw. They say "not attempted yet" until your functions are there.
#
# About 40 minutes. You need the lesson [01 · Why SLAM](../notebooks/01_why_slam.ipynb) before.
# Metres and radians everywhere; a pose is `[x, y, θ]` with θ counter-clockwise from +x.

# %%
import numpy as np

from slamlab import views, worlds
from slamlab.checks import attempt, check
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import RPLIDAR_A2

# %% [markdown]
# ## 1 · One step
#
# After each step the odometry reports what the robot did **as seen from where it was before**:
# `[forward, left, turn]`, in metres, metres and radians. A robot at `[2, 1, π/2]` looks along +y;
# after a step `[0.5, 0, 0]` it stands at `[2, 1.5, π/2]`.
#
# Return the new pose. Two things to think of: the step was measured in the frame of the *old* pose,
# and a heading lies between −π and π.


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
# ## 2 · Dead reckoning
#
# Chain the steps: each begins where the one before ended. Return **all** poses, the start first, so
# that n steps make n + 1 rows. Use your `next_pose`.


# %% name="track"
def track(start, steps):
    """The poses along a drive.

    start : (3,) x [m], y [m], θ [rad]
    steps : (n, 3) forward [m], left [m], turn [rad], each in the frame of the pose before
    returns (n + 1, 3), the start in the first row
    """
    ### BEGIN SOLUTION
    poses = [start]
    for step in steps:
        poses.append(next_pose(poses[-1], step))
    return np.array(poses)
    ### END SOLUTION


# %%
check("01-track")

# %% [markdown]
# Now drive round the corridor. `tour` gives the steps of one lap, half a metre each, with a quarter
# turn at each of the four corners. With `corner_error` the odometry reports every quarter turn a
# little too large, as a robot with a worn tyre does.
#
# **Before you run it:** with 3° too much at each corner, how far from its start will the robot
# believe to be after the lap of 42 m? Write a number down.


# %% name="tour"
def tour(corner_error=0.0):
    """Steps (84, 3) of one lap round the corridor; corner_error in radians."""
    legs = [24, 16, 26, 16, 2]
    steps = np.zeros((sum(legs), 3))
    steps[:, 0] = 0.5
    steps[np.cumsum(legs[:-1]) - 1, 2] = np.pi / 2 + corner_error
    return steps


START = np.zeros(3)
WALLS = Segments("walls", worlds.corridor().outline())


@attempt
def _():
    fig, ax = views.axes("One lap, 3° too much at each corner")
    views.draw(ax, WALLS)
    views.draw(ax, Poses("truth", track(START, tour())))
    views.draw(ax, Poses("naive", track(START, tour(np.radians(3)))), label="odometry")
    ax.legend(loc="center")
    views.show(fig, alt="The true lap closes; the lap of the odometry leaves the corridor.")


# %% [markdown]
# The true lap closes. The odometry's lap runs through the walls: after four corners it is 12° off,
# and it does not come back to where it began.

# %% [markdown]
# ## 3 · The map
#
# The lidar reports points in the robot's frame: x ahead, y to the left. Put them where they belong
# in the world: turned by the robot's heading, then moved to where it stands. The points stand in
# rows; mind that when you turn them by a matrix (the conventions in
# [00](../notebooks/00_start_here.ipynb) say how).


# %% name="place"
def place(pose, points):
    """A scan's points in the world.

    pose : (3,) x [m], y [m], θ [rad]
    points : (n, 2) in the robot's frame [m]
    returns (n, 2) in the world [m]
    """
    ### BEGIN SOLUTION
    x, y, theta = pose
    c, s = np.cos(theta), np.sin(theta)
    R = np.array([[c, -s], [s, c]])
    return points @ R.T + np.array([x, y])
    ### END SOLUTION


# %%
check("01-place")

# %% [markdown]
# The scans are taken where the robot *is*. The map is drawn where the robot *believes* to be.
# **Before you run it:** what will the outer wall look like at the start, where the lap ends? Then
# move the slider: which error is small enough for you to call the map good?


# %% name="map"
@attempt
def _():
    world, rng = worlds.corridor(), np.random.default_rng(1)
    truth = track(START, tour())[::2]
    scans = [RPLIDAR_A2.scan(world, pose, rng).points()[::3] for pose in truth]

    def draw(corner_error_in_degrees):
        believed = track(START, tour(np.radians(corner_error_in_degrees)))[::2]
        maps = {"where the robot is": truth, "where it believes to be": believed}
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
# Same scans, same robot. On the left they agree; on the right every wall that was seen twice stands
# twice, and the corridor does not close. Nothing is wrong with the lidar: **a map is as good as the
# poses it is drawn from**.

# %% [markdown]
# ## 4 · The gap
#
# How well does the lap close? Ask from the start: where, seen from there, is the end? Return pose b
# as seen from pose a: how far ahead of a, how far to the left of a, and how much a would have to
# turn to look where b looks. It is the way back of `next_pose`.


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


# %% name="gap"
@attempt
def _():
    for degrees in (1, 2, 3, 6):
        lap = track(START, tour(np.radians(degrees)))
        ahead, left, turn = seen_from(lap[0], lap[-1])
        print(
            f"{degrees}° a corner: the lap ends {ahead:+.2f} m ahead, {left:+.2f} m to the left, "
            f"turned by {np.degrees(turn):+.0f}°"
        )


# %% [markdown]
# Three degrees, which no eye sees, open a gap of 1.4 m, and the gap grows with the error. Was your
# number near?

# %% [markdown]
# ## 5 · How errors grow
#
# A constant error is bad luck; chance alone is bad enough. The robot drives **straight**: `n` steps
# of `d` metres, and **after** each step its heading is off by a little more, each time by an
# independent random angle with mean 0 and standard deviation `sigma`. How far sideways of the line
# will it be at the end? Return the standard deviation in metres, for small angles (sin e ≈ e).
#
# Hint: number the errors. The first one bends n − 1 steps, the second n − 2, …, the last none. How
# far sideways does one error lead, and how do the variances of independent errors add?


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
# Does it happen? Let 300 robots drive 60 steps of half a metre, each with its own errors of 1° a
# step, and lay your formula over them.


# %% name="drift-drives"
@attempt
def _():
    rng, n, d, sigma = np.random.default_rng(3), 60, 0.5, np.radians(1.0)
    lengths = d * np.arange(n + 1)
    fig, ax = views.chart("way driven [m]", "sideways of the line [m]", "300 robots, 1° a step")
    for robot in range(300):
        steps = np.column_stack([np.full(n, d), np.zeros(n), sigma * rng.standard_normal(n)])
        sideways = track(START, steps)[:, 1]
        label = "robots" if robot == 0 else None
        ax.plot(lengths, sideways, color=views.COLOURS["naive"], lw=0.4, alpha=0.4, label=label)
    spread = np.array([drift(k, d, sigma) for k in range(n + 1)])
    for sign, label in ((2, "your ± 2 standard deviations"), (-2, None)):
        ax.plot(lengths, sign * spread, color="black", lw=2, label=label)
    ax.legend(loc="upper left")
    views.show(fig, alt="Three hundred tracks fan out; the formula's curves hold 95 % of them.")


# %% [markdown]
# Nearly all tracks stay between your two curves: about 285 of 300 end there. The fan opens faster
# than the way grows: twice the way, nearly three times the drift. No better wheel changes that, it
# only delays it. Something must look at the **walls** and notice that they have been seen before.
# That is SLAM, and the rest of the course.
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws
# other inputs. Hand it in as it is.
