# %% [markdown]
# # Exercise 12 · Three filters, one robot
#
# **You will be able to** turn the ticks of two encoders into a motion, follow a wall with one
# infrared eye, say from when on a run is lost, and say how sure a share of lost runs is.
#
# **60 minutes. Before:** lesson [12 · Three filters, one robot](../notebooks/12_three_filters.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and says which law is broken, and what the
# mistake is where it knows it.
#
# Metres and radians; a motion is `[x, y, θ]` in the frame of the pose before it.

# %%
import numpy as np

from slamlab import views, worlds
from slamlab.checks import attempt, check
from slamlab.geometry import compose
from slamlab.layers import Poses, Segments

# %% [markdown]
# ## 1 · From ticks to a motion
#
# The robot has two driven wheels, `base` metres apart, each with an encoder. Both wheels roll
# evenly: `left` and `right` ticks, each of `tick` metres. Its middle then drives an arc of length
# $d = (l + r)/2$ and turns by $\Delta\theta = (r - l)/\text{base}$, all the while.
#
# Where is it at the end? The lesson has the chord of that arc: how long it is, and where it points.
# **Mind** the robot that drives straight on: what is sin 0 / 0 to your computer?


# %% name="odometry"
def odometry(left, right, tick, base):
    """The motion that two encoders tell of.

    left, right : ticks of the wheels, negative when rolling back;  tick : way of one [m]
    base : distance of the wheels [m];  returns (3,) x, y, θ in the frame of the pose before
    """
    ### BEGIN SOLUTION
    l, r = left * tick, right * tick
    turn = (r - l) / base
    chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
    ### END SOLUTION


# %%
check("12-odometry")

# %% [markdown]
# A robot whose right wheel rolls a little farther with every step. **Before you run it:** what
# curve will it drive?


# %% name="spiral"
@attempt
def _():
    poses = [np.zeros(3)]
    for k in range(60):
        poses.append(compose(poses[-1], odometry(200, 200 + 4 * k, 0.0002, 0.1)))
    fig, ax = views.axes("A right wheel that rolls farther and farther", size=(5.5, 4))
    views.draw(ax, Poses("naive", poses), label="by your odometry")
    views.legend(ax)
    views.show(fig, alt="The track of a robot that turns left more and more.")


# %% [markdown]
# It winds itself up to the left: each step turns a little more than the one before.

# %% [markdown]
# ## 2 · The follower decides
#
# The robot keeps a wall on its left. Its scanner looks 45° to the left and reads a range (`inf`
# where nothing comes back). The rules of the thesis' listing, mended:
#
# 1. After a **scan**: turn **left** as long as the reading is beyond 0.25 m.
# 2. Then turn **right** as long as it is below 0.18 m.
# 3. Then **drive** as long as less than 0.04 m are driven *and* the reading is beyond 0.18 m.
# 4. Then stop and **scan**.
#
# The loops stand one behind the other: what was left is not entered again before the next scan.
# Write this as a decision: what is being done now, what is read, how far the present drive has
# come; what is to be done next?


# %% name="decide"
def decide(doing, reading, driven):
    """What the robot does next: "scan", "left", "right" or "drive".

    doing : what it has been doing, one of these four;  reading : 45° to the left [m], maybe inf
    driven : since the present drive began [m], 0 when it does not drive
    """
    ### BEGIN SOLUTION
    if doing in ("scan", "left") and reading > 0.25:
        return "left"
    if doing != "drive":
        return "right" if reading < 0.18 else "drive"
    return "drive" if driven < 0.04 and reading > 0.18 else "scan"
    ### END SOLUTION


# %%
check("12-decide")

# %% [markdown]
# Your decisions at the wheel, in the arena of cardboard boxes. The sensor here is perfect.
# **Before you run it:** which way round will the robot go?


# %% name="drive"
@attempt
def _():
    arena, doing, driven, poses = worlds.arena(), "scan", 0.0, [np.zeros(3)]
    for _ in range(700):
        x, y, theta = poses[-1]
        reading = arena.cast((x, y), [theta + np.pi / 4])[0]
        doing = decide(doing, reading if reading < 0.28 else np.inf, driven)
        step = {"left": [0, 0, 0.1], "right": [0, 0, -0.1], "drive": [0.01, 0, 0]}
        poses.append(compose(poses[-1], step.get(doing, [0, 0, 0])))
        driven = driven + 0.01 if doing == "drive" else 0.0
    fig, ax = views.axes("Along the left wall", size=(6, 4.6))
    views.draw(ax, Segments("walls", arena.outline()))
    views.draw(ax, Poses("truth", poses), label="your robot")
    views.legend(ax)
    views.show(fig, alt="The arena of boxes and the track of the robot in it.")


# %% [markdown]
# Clockwise, about 15 cm off the wall and round its corners. If it turns on the spot or runs into a
# wall, the check above says why.

# %% [markdown]
# ## 3 · Lost, and since when
#
# How far a filter's position is off, reading by reading. A run **strays** where that is beyond a
# limit. It is **lost** if it is beyond the limit at the end, and it was lost *from the first
# reading on from which it never came back*.
#
# Return the number of that reading, counted from 0, or −1 if the run is not lost.


# %% name="lost-since"
def lost_since(errors, limit):
    """The first reading from which the error stays beyond the limit to the end, or -1.

    errors : (n,) [m];  limit : [m];  returns a whole number
    """
    ### BEGIN SOLUTION
    near = np.flatnonzero(errors <= limit)
    if len(near) == 0:
        return 0
    return near[-1] + 1 if near[-1] < len(errors) - 1 else -1
    ### END SOLUTION


# %%
check("12-lost")

# %% [markdown]
# Three made-up runs. **Before you run it:** which of them are lost, and since when?


# %% name="three-runs"
@attempt
def _():
    k = np.arange(60)
    runs = {
        "it wobbles": 0.05 + 0.03 * np.sin(k / 4),
        "it comes back": 0.03 + 0.3 * np.exp(-(((k - 25) / 6) ** 2)),
        "it drifts away": 0.045 + 0.0001 * k**2 + 0.05 * np.sin(k / 3),
    }
    dated = {f"{name}: {lost_since(run, 0.12):.0f}": run for name, run in runs.items()}
    fig, ax = views.curves(k, dated, "reading", "error of the position [m]", "Lost since when?")
    ax.axhline(0.12, color=views.COLOURS["guide"])
    views.show(fig, alt="Errors of three runs over time, and the limit of 0.12 m.")


# %% [markdown]
# Only the last one is lost. It strays, comes back for some readings, and is lost from the last time
# on that it crosses the limit.

# %% [markdown]
# ## 4 · How sure is a share?
#
# Of n runs, k were lost. The share k/n is only an estimate of the true share p. Return an interval
# that holds p in 95 % of all studies.
#
# If p is the true share, k/n scatters by $\sqrt{p\,(1-p)/n}$ about it. So hold every p for possible
# whose k/n is at most z = 1.96 such deviations off:
#
# $$\Big(\frac kn - p\Big)^2 \le z^2\,\frac{p\,(1-p)}{n}$$
#
# It is a quadratic inequality: its two ends are what is asked for.


# %% name="interval"
def interval(k, n):
    """The 95 % interval of a share of which k in n were counted.

    k, n : whole numbers, 0 ≤ k ≤ n;  returns low, high
    """
    ### BEGIN SOLUTION
    z = 1.96
    middle = (k / n + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(k / n * (1 - k / n) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return max(middle - half, 0.0), min(middle + half, 1.0)
    ### END SOLUTION


# %%
check("12-interval")

# %% [markdown]
# **Before you run it:** the thesis lost one run in six. Between which shares may the true one lie?
# And what would 13 in 80 say?


# %% name="one-in-six"
@attempt
def _():
    for k, n in ((1, 6), (0, 6), (13, 80)):
        low, high = interval(k, n)
        print(f"{k:2} of {n:2}: {k / n:4.0%}, truly {low:.0%} to {high:.0%}")


# %% [markdown]
# "Once in six" may be anything from one in thirty to more than half. That is why the thesis' author
# says himself that six sets are too few, and why the lesson drives eighty times.
