# %% [markdown]
# # Exercise 02 · Sensors and worlds
#
# **You will be able to** cast the ray of a lidar and the cone of an ultrasonic sensor, place what a
# real device says in the world, simulate its noise, and find the size of that noise in readings of
# a room in which people walk about.
#
# **60 minutes. Before:** lesson [02 · Sensors and worlds](../notebooks/02_sensors_and_worlds.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs, and inputs at the edge of what the task
# promises, and tells you which law is broken. When you are stuck, `hint("02-ray-wall")` asks a
# question that leads on. Cells marked `@attempt` show your functions at work.
#
# All lengths are in metres and all angles in radians, counter-clockwise from the x axis, unless a
# task says otherwise. A pose is `[x, y, θ]`. Leave the arguments of a function as they are: whoever
# called it still needs them.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import ask, attempt, check

# %% [markdown]
# ## 1 · A beam and a wall
#
# A beam leaves the point $p$ in the direction $\varphi$. A wall is a row `[x1, y1, x2, y2]`: it
# goes from $p_1 = (x_1, y_1)$ to $p_2 = (x_2, y_2)$ and ends there. In the lesson the sensor stood
# at the origin; here it may stand anywhere.
#
# A sketch helps. Draw a beam that passes beside a wall, and one that flies away from it. What are $r$
# and $\tau$ of (02.1) in each case?
#
# **Your task.** How far does the beam fly until it meets the wall? Return `np.inf` where it does
# not: the wall lies behind, or the beam passes beside it, or runs parallel to it.
#
# The wall has a length, of centimetres or of a hundred metres, and $\varphi$ may be any number,
# also one beyond a whole turn. Beams and walls may run along x or y. A wall that lies on the beam's
# own line counts as parallel. No beam just touches the end of a wall.


# %% name="ray-wall"
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
# A beam that crosses three walls reports the nearest, and one that meets nothing within `range_max`
# reports NaN. With your `ray_wall` this takes two lines, and we have written them for you. Move the
# sensor about in Smolec's second situation, and watch what it cannot see.


# %% name="scan"
def scan(p, directions, walls, range_max):
    """What a range sensor at p (2,) reports of walls (w, 4): ranges (n,), NaN for nothing."""
    nearest = np.array([min(ray_wall(p, phi, wall) for wall in walls) for phi in directions])
    return np.where(nearest <= range_max, nearest, np.nan)


# %% name="situation"
@attempt
def _():
    from slamlab.worlds import situation_2

    walls = situation_2().walls
    directions = np.linspace(-np.pi, np.pi, 180, endpoint=False)

    def draw(x, y, range_max):
        ranges = scan(np.array([x, y]), directions, walls, range_max)
        ends = np.column_stack([x + ranges * np.cos(directions), y + ranges * np.sin(directions)])
        fig, ax = views.axes(f"{np.isfinite(ranges).sum()} of 180 beams came back", size=(8, 5.4))
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
# ## 2 · The first echo
#
# An ultrasonic sensor has a **cone** in place of a beam. It hears everything that lies less than
# `half` to either side of its axis $\varphi$, and it reports the nearest place of all, because its
# echo is the first to come back. The lesson showed what this does to a door. Now compute it.
#
# If you fire a thousand beams into the cone, you come close to the answer, but a thin post may
# stand between two of them. The nearest place can be found exactly, because it is one of only three
# kinds. A wall's places are $p_1 + \tau\,(p_2 - p_1)$ with $0 \le \tau \le 1$, as in the lesson,
# and their distance from $p$ has one least value along the line.
#
# Draw a cone, and a wall whose nearest place to the sensor lies (1) between its ends and in the cone,
# (2) between its ends and beside the cone, (3) at one end. Which place of the wall is heard first in
# each case?
#
# **Your task.** How far is the nearest place of all walls that lies in the cone? Return `np.inf`
# where there is none. A wall sends an echo from each of its places, at whatever slant it is hit.
#
# `half` lies between 1° and 80°, and $\varphi$ may be any number. There may be many walls, or none
# at all (then `walls` has the shape (0, 4)). They may run along x or y, point straight at the
# sensor, cross the whole cone, reach behind the sensor, or be as thin as a post. But each has a
# length, none comes nearer to $p$ than 10 cm, and none just touches the rim of the cone.


# %% name="echo"
def echo(p, phi, half, walls):
    """How far an ultrasonic sensor hears.

    p : (2,) where it stands [m];  phi : the axis of its cone [rad]
    half : half of the cone's angle [rad];  walls : (w, 4) rows x1, y1, x2, y2 [m]
    returns a distance [m], or np.inf
    """
    ### BEGIN SOLUTION
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            place = a + s * w
            distance = np.hypot(place[0], place[1])
            if place @ axis >= np.cos(half) * distance:
                nearest = min(nearest, distance)
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
    ### END SOLUTION


# %%
check("02-echo")

# %% [markdown]
# Here a door like that of the lesson is heard by your cone, in 91 directions. Choose another width
# of the cone: when does the door close?


# %% name="door"
@attempt
def _():
    walls = np.array(
        [
            *[(-2, -1, 3, -1), (3, -1, 3, 2), (-2, 2, -2, -1), (-2, 3.5, 3, 3.5)],
            *[(3, 2, 0.5, 2), (-0.5, 2, -2, 2)],  # between these two: the door
        ]
    )
    p, directions = np.array([0.2, 0.0]), np.linspace(0, np.pi, 91)

    def draw(cone_in_degrees):
        half = np.radians(cone_in_degrees / 2)
        ranges = np.array([echo(p, phi, half, walls) for phi in directions])
        ends = p + ranges[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])
        fig, ax = views.axes(f"a cone of {cone_in_degrees:.0f}°", size=(8, 5))
        views.draw(ax, layers.Segments("walls", walls))
        views.draw(ax, layers.Points("scan", ends[np.isfinite(ranges)]), markersize=7)
        views.draw(ax, layers.Poses("robot", [[*p, np.pi / 2]]))
        return fig

    views.explore(
        draw,
        alt="What your ultrasonic sensor draws in front of a door, which a wide cone closes.",
        cone_in_degrees=(2, 40, 25),
    )


# %% [markdown]
# ## 3 · What the device says
#
# An RPLIDAR reports **degrees**, counted **clockwise** from its front, and **millimetres**, where 0
# means that nothing came back. Its front looks along its own x axis. It is mounted on the robot at
# the pose `mount`, given in the robot's frame, and the robot stands at `pose` in the world. (02.5)
# leads from frame to frame.

# %%
ask(
    "ex02-mount",
    "The sensor sits on the robot's rear and looks backwards: `mount` is $(-0.2, 0, \\pi)$. The robot "
    "stands at the origin and looks along +y. The sensor reports a wall at 90° and 1000 mm. **Where "
    "in the world is that wall?** (metres)",
    {
        "at (1, −0.2)": "that would be right if the device counted counter-clockwise. It counts "
        "clockwise from its own front.",
        "at (−1, 0.2)": "the sensor is behind the robot's centre, and the robot looks along +y: so it is at y = −0.2.",
        "at (−1, −0.2)": "clockwise from a front that looks backwards is the robot's left, and that is −x here.",
        "at (−0.2, 1)": "that is the place in the robot's frame. The robot itself looks along +y.",
    },
    right="at (−1, −0.2)",
)

# %% [markdown]
# **Your task.** Return the points in the world, one row for each reading that came back.
#
# A scan may have any number of readings, even none, and it may be that none of them came back. Then
# there are no rows, and an empty list will do as well. What came back may be as near as a
# millimetre or as far as 40 m. A scan may begin at any angle, so the degrees need not ascend. Keep
# the order of the readings.


# %% name="to-points"
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
# A robot turns on the spot and scans a room five times, with its sensor more than 30 cm off its
# centre. If all is right, five scans make one room.


# %% name="five-scans"
@attempt
def _():
    from slamlab.geometry import compose
    from slamlab.worlds import room

    mount, degrees = np.array([0.3, 0.1, 0.5]), np.arange(0.0, 360.0, 2.0)
    fig, ax = views.axes("Five scans, turned on the spot", size=(8, 5.4))
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
# Let us simulate a simple sensor. Its range errs by a share of itself, so that the standard
# deviation of a range $r$ is `error` times $r$. And some beams return nothing: each is lost with
# the probability `dropouts`, whatever happens to the others.

# %%
ask(
    "ex02-variance",
    "Let `error` be 0.01. **What is the variance of a reading at 10 m?**",
    right=0.01,
    tolerance=0.002,
    unit="m²",
    reason="σ is 1 % of 10 m, hence 0.1 m, and the variance is its square.",
    wrong={
        0.1: "that is σ, in metres. The variance is its square.",
        0.0001: "that is the square of the share. The share is of 10 m.",
    },
)

# %% [markdown]
# **Your task.** Make true ranges noisy. Take all chance from the generator `rng`, so that the same
# seed gives the same result. What was NaN already stays NaN.
#
# A scan may have any number of beams, even none. `error` may be 0, and `dropouts` anything from 0
# to 1, both included.


# %% name="noisy"
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
# ## 5 · A busy room
#
# Now we turn the question round: how large is a sensor's `error`, if all that we have is its
# readings? A sensor stands still and scans $k$ times, which makes an array of shape $(k, n)$, with
# a row for each scan and a column for each beam. Each column holds repeated readings of *one* wall,
# at a distance that you do not know.
#
# In a quiet room this takes two lines: the spread of each column about its mean, as a share of that
# mean.


# %% name="quiet-fit"
def quiet_fit(scans):
    """The error of a sensor in a quiet room: standard deviation / range, over all beams."""
    share = scans / scans.mean(axis=0) - 1
    return np.sqrt(np.sum(share**2) / (share.size - scans.shape[1]))  # a mean for each beam


# %% [markdown]
# Our room is not quiet, and the sensor is cheap:
#
# - **People** walk about. Each reading is blocked with the probability `blocked`, from 0 to 0.4, and
#   then it is anywhere between the sensor and the wall, every distance being equally likely.
# - Otherwise the reading is $r + \varepsilon$, where $r$ is the distance of the beam's wall, and the
#   noise $\varepsilon$ is normal with the standard deviation `error` times $r$.
# - The sensor **rounds** what it reports to whole multiples of `step`, which is 1 to 8 cm. For near
#   walls this is more than the noise, and all readings may be the same.
#
# The walls are 1 to 9 m away, and `error` lies between 0.002 and 0.03. There are 24 scans or more,
# and twelve beams or more. No reading is missing.

# %%
ask(
    "ex02-person",
    "Twenty readings of a wall at 5 m are each 5 cm off, and one reading is of a person at 0.5 m. "
    "**How large is the standard deviation of all 21?**",
    right=0.97,
    tolerance=0.15,
    unit="m",
    reason="one reading that is 4.5 m off outweighs twenty good ones, because each counts by its square. "
    "quiet_fit would be wrong twentyfold.",
    wrong={
        0.05: "that is what the twenty good ones say. But the single bad one is ninety times as "
        "far off, and counts by its square.",
        0.26: "that is the mean of how far the 21 readings are from 5 m. A standard deviation takes the mean of "
        "the squares.",
    },
)

# %% [markdown]
# **Your task.** Estimate `error` and `blocked` as well as you can, by any method. A few questions
# may help:
#
# - How can a person be told from the wall, when the spread of the wall's readings is just what you are
#   looking for? May you guess it, and do better in a second round?
# - A number that is rounded to steps errs by up to half a step, every error being equally likely. What
#   is the variance of such an error, and what is the variance of noise and rounding together?
# - Which beams tell most about `error`, those of near walls or those of far ones? Does each of them
#   deserve the same weight?
#
# We try forty sensors. An answer is judged by the factor by which `error` is off, and by the
# difference of `blocked`. Points come in four steps. For the first three the *median* over all
# sensors counts: a factor of 1.35, 1.17 and 1.08 (and a difference of 0.04, 0.03 and 0.03). The
# last step asks that 31 of the 40 be within a factor of 1.16 (and 0.06). The check stops after 10 s.


# %% name="busy-fit"
def busy_fit(scans, step):
    """How noisy a sensor in a busy room is.

    scans : (k, n) ranges [m], a row a scan, a column a beam; whole multiples of step
    step : what the sensor rounds to [m]
    returns error (standard deviation / range) [1] and blocked (share of readings of people) [1]
    """
    ### BEGIN SOLUTION
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(12):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2  # the others are people
        count = wall.sum(axis=0)
        r = np.where(count > 0, (wall * scans).sum(axis=0) / np.maximum(count, 1), r)
        freedom = np.maximum(count - 1, 0)  # a mean was fitted for each beam
        # the sum of squares is expected to be the sum of freedom · ((error r)² + step² / 12)
        noise = np.sum(wall * (scans - r) ** 2) - np.sum(freedom) * step**2 / 12
        error = max(np.sqrt(max(noise, 0) / np.sum(freedom * r**2)), 0.001)
    return error, 1 - wall.mean()
    ### END SOLUTION


# %%
check("02-busy-room")

# %% [markdown]
# Here are sensors whose truth is known, so that you can try your method. Choose another number,
# more people, or coarser steps, and look where your method goes wrong, and by how much.


# %% name="readings"
@attempt
def _():
    def draw(number, blocked, step_in_cm):
        rng, step, error = np.random.default_rng(int(number)), step_in_cm / 100, 0.01
        walls = np.sort(rng.uniform(1, 9, 24))
        scans = walls * (1 + error * rng.standard_normal((24, 24)))
        people = rng.random(scans.shape) < blocked
        scans = step * np.rint(np.where(people, walls * rng.random(scans.shape), scans) / step)
        found = busy_fit(scans, step)
        told = f"error {found[0]:.4f} instead of {error}, quiet_fit says {quiet_fit(scans):.2f};"
        told += f"  blocked {found[1]:.2f} instead of {people.mean():.2f}"
        fig, ax = views.chart("beam", "reading [m]", told, (9, 4))
        beam = np.tile(np.arange(24), (24, 1))
        ax.plot(beam[people], scans[people], ".", color=views.COLOURS["naive"], label="people")
        ax.plot(beam[~people], scans[~people], ".", color=views.COLOURS["corrected"], label="wall")
        views.legend(ax)
        return fig

    views.explore(
        draw,
        alt="Readings of each beam: those of walls lie close together, those of people below them.",
        number=(0, 20, 3),
        blocked=(0.0, 0.4, 0.2),
        step_in_cm=(1, 8, 4),
    )


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it, though the grader
# draws other inputs. The next lesson, [03 · The Kalman
# filter](../notebooks/03_kalman_filter.ipynb), asks what such numbers are for: how much is a
# reading worth, compared with what one believed before?
