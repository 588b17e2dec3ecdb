# %% [markdown]
# # 02 · Sensors and worlds: exercise
#
# **You will be able to** cast the rays of a range sensor, place what a real device says in the
# world, simulate noise, and find its size again in recordings.
#
# **40 minutes. Before:** lesson [02](../notebooks/02_sensors_and_worlds.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and tells you which law is broken. Cells
# marked `@attempt` show your functions at work.
#
# Metres and radians, counter-clockwise from +x, unless a task says otherwise. A pose is `[x, y, θ]`.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import attempt, check

# %% [markdown]
# ## 1 · A beam and a wall
#
# A beam leaves the point **p** in the direction φ. A wall is a row `[x1, y1, x2, y2]`: it goes from
# (x1, y1) to (x2, y2) and ends there.
#
# **Predict first.** A wall stands behind the sensor. What does the formula for the crossing of two
# lines say about it, and what must a sensor say?
#
# **Your task.** How far does the beam fly until it meets the wall? `np.inf` where it does not: the
# wall lies behind, or the beam passes beside it, or runs parallel to it.


# %%
def ray_wall(p, phi, wall):
    """How far a beam flies to a wall.

    p : (2,) where the beam starts [m];  phi : its direction [rad]
    wall : (4,) x1, y1, x2, y2 [m];  returns a distance [m], or np.inf
    """
    ### BEGIN SOLUTION
    u_x, u_y = np.cos(phi), np.sin(phi)
    w_x, w_y = wall[2] - wall[0], wall[3] - wall[1]
    d_x, d_y = wall[0] - p[0], wall[1] - p[1]
    determinant = u_x * w_y - u_y * w_x
    if determinant == 0:
        return np.inf
    t = (d_x * w_y - d_y * w_x) / determinant
    s = (d_x * u_y - d_y * u_x) / determinant
    return t if t >= 0 and 0 <= s <= 1 else np.inf
    ### END SOLUTION


# %%
check("02-ray-wall")

# %% [markdown]
# One beam turns past one wall: the dots are where your function says that it meets it.


# %%
@attempt
def _():
    p, wall = np.array([0.3, 0.2]), np.array([1.0, -1.2, 2.2, 1.6])
    directions = np.radians(np.arange(-180, 180, 4))
    ranges = np.array([ray_wall(p, phi, wall) for phi in directions])
    hit = np.isfinite(ranges)
    ends = p + ranges[hit, None] * np.column_stack([np.cos(directions), np.sin(directions)])[hit]
    fig, ax = views.axes(f"{hit.sum()} of {len(hit)} beams meet the wall", size=(5, 4))
    views.draw(ax, layers.Segments("walls", [wall]))
    views.draw(ax, layers.Points("scan", ends), markersize=7)
    views.draw(ax, layers.Poses("robot", [[*p, 0]]))
    views.show(fig, alt="Dots where the beams of your function meet the wall.")


# %% [markdown]
# ## 2 · A scan
#
# **Predict first.** A beam crosses three walls. Which distance does the sensor report? And if the
# nearest of them is farther than it can see?
#
# **Your task.** The range of each beam: the nearest wall, and NaN where there is none within
# `range_max`. Use your `ray_wall`.


# %%
def scan(p, directions, walls, range_max):
    """What a range sensor reports.

    p : (2,) where it stands [m];  directions : (n,) of its beams [rad]
    walls : (w, 4) rows x1, y1, x2, y2 [m];  range_max : how far it sees [m]
    returns (n,) ranges [m]; NaN where nothing came back
    """
    ### BEGIN SOLUTION
    nearest = np.array([min(ray_wall(p, phi, wall) for wall in walls) for phi in directions])
    return np.where(nearest <= range_max, nearest, np.nan)
    ### END SOLUTION


# %%
check("02-scan")

# %% [markdown]
# Your sensor in Smolec's second situation. Move it about, and watch what it cannot see.


# %%
@attempt
def _():
    from slamlab.worlds import situation_2

    walls = situation_2().walls
    directions = np.linspace(-np.pi, np.pi, 180, endpoint=False)

    def draw(x, y, range_max):
        ranges = scan(np.array([x, y]), directions, walls, range_max)
        ends = np.column_stack([x + ranges * np.cos(directions), y + ranges * np.sin(directions)])
        fig, ax = views.axes(f"{np.isfinite(ranges).sum()} of 180 beams came back", size=(6, 4.5))
        views.draw(ax, layers.Segments("walls", walls))
        views.draw(ax, layers.Points("scan", ends), markersize=6)
        views.draw(ax, layers.Poses("robot", [[x, y, 0]]))
        return fig

    views.explore(
        draw,
        alt="Your scan in an irregular room: some walls are hidden, some too far.",
        x=(-5.0, 1.7, -0.5),
        y=(-4.5, 1.4, 0.4),
        range_max=(1.0, 8.0, 4.5),
    )


# %% [markdown]
# ## 3 · What the device says
#
# An RPLIDAR reports rows of **degrees**, counted **clockwise** from its front, and
# **millimetres**; 0 mm means that nothing came back. Its front looks along its own +x. It is
# mounted on the robot at the pose `mount`, given in the robot's frame; the robot stands at `pose`
# in the world.
#
# **Predict first.** The sensor sits on the robot's rear and looks backwards: mount = [−0.2, 0, π].
# The robot stands at the origin and looks along +y. Where in the world is a wall that the sensor
# reports at 90° and 1000 mm?
#
# **Your task.** The points in the world, one row for each reading that came back.


# %%
def to_points(degrees, millimetres, mount, pose):
    """A device's readings as points in the world.

    degrees : (n,) clockwise from the sensor's front;  millimetres : (n,); 0 for nothing
    mount : (3,) the sensor in the robot's frame;  pose : (3,) the robot in the world
    returns (k, 2) points in the world [m], one for each reading that came back, in their order
    """

    ### BEGIN SOLUTION
    def carry(frame, points):
        c, s = np.cos(frame[2]), np.sin(frame[2])
        return points @ np.array([[c, s], [-s, c]]) + frame[:2]

    back = millimetres > 0
    beta, r = -np.radians(degrees[back]), millimetres[back] / 1000
    in_sensor = np.column_stack([r * np.cos(beta), r * np.sin(beta)])
    return carry(pose, carry(mount, in_sensor))
    ### END SOLUTION


# %%
check("02-to-points")

# %% [markdown]
# A robot turns on the spot and scans a room five times, with its sensor 30 cm off its centre. If
# all is right, five scans make one room.


# %%
@attempt
def _():
    from slamlab.geometry import compose
    from slamlab.worlds import room

    mount, degrees = np.array([0.3, 0.1, 0.5]), np.arange(0.0, 360.0, 2.0)
    fig, ax = views.axes("Five scans, turned on the spot", size=(6, 4.5))
    for turn in (0.0, 0.4, 0.8, 1.2, 1.6):
        pose = np.array([0.5, 0.2, turn])
        eye = compose(pose, mount)
        millimetres = 1000 * room().cast(eye[:2], eye[2] - np.radians(degrees))
        points = to_points(degrees, millimetres.round(), mount, pose)
        views.draw(ax, layers.Points("scan", points), markersize=5)
    views.show(fig, alt="Five scans from five headings, placed by your function.")


# %% [markdown]
# ## 4 · Noise
#
# A real range errs by a share of itself: its standard deviation is `error * r`. And some beams
# return nothing: each is lost with the probability `dropouts`, whatever the others do.
#
# **Predict first.** error = 0.01. How far off is a reading at 10 m typically? What is its
# *variance*?
#
# **Your task.** Noisy ranges, all chance from the generator `rng`: with the same seed the same
# result. What was NaN already stays NaN.


# %%
def noisy(ranges, error, dropouts, rng):
    """Ranges as a real sensor would report them.

    ranges : (n,) true [m]; NaN where there is nothing;  error : standard deviation / range [1]
    dropouts : probability that a beam is lost [1];  rng : numpy.random.Generator
    returns (n,) [m]; NaN where nothing came back
    """
    ### BEGIN SOLUTION
    measured = ranges + error * ranges * rng.standard_normal(len(ranges))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
    ### END SOLUTION


# %%
check("02-noise")

# %% [markdown]
# ## 5 · How noisy was it?
#
# Now the way back. A sensor stands still and scans k times: an array of shape (k, n), a row a scan,
# a column a beam. Each column holds repeated readings of *one* distance, which you do not know.
#
# Some beams look into the open and **never** return anything: that is no dropout but the room.
# Leave these columns out. Every other NaN is a dropout.
#
# **Predict first.** `scans.std()` of the whole array: what does it measure, mostly?
#
# **Your task.** Estimate the error (standard deviation as a share of the range) and the share of
# dropouts. Use all the beams: one alone says little.


# %%
def fit(scans):
    """How noisy a sensor is, from repeated scans at rest.

    scans : (k, n) ranges [m], a row a scan; NaN where nothing came back
    returns error (standard deviation / range) [1] and dropouts (share of readings lost) [1]
    """
    ### BEGIN SOLUTION
    seen = scans[:, ~np.isnan(scans).all(axis=0)]
    lost = np.isnan(seen)
    share = seen / np.nanmean(seen, axis=0) - 1
    freedom = (~lost).sum() - seen.shape[1]  # a mean was fitted for each beam
    return np.sqrt(np.nansum(share**2) / freedom), lost.mean()
    ### END SOLUTION


# %%
check("02-fit")

# %% [markdown]
# There and back: your `noisy` makes scans, your `fit` looks at them.


# %%
@attempt
def _():
    rng, truth = np.random.default_rng(3), np.linspace(0.5, 9.0, 60)
    truth[20:25] = np.nan
    for error, dropouts in [(0.004, 0.03), (0.01, 0.1), (0.03, 0.3)]:
        scans = np.array([noisy(truth, error, dropouts, rng) for _ in range(40)])
        found = fit(scans)
        print(f"made with {error:.3f} and {dropouts:.2f}, found {found[0]:.4f} and {found[1]:.3f}")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. The next lesson, [03 · The Kalman
# filter](../notebooks/03_kalman_filter.ipynb), asks what such numbers are for: how much a reading
# is worth against what one believed before.
