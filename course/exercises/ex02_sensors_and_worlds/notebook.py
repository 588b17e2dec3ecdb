# %% [markdown]
# # Exercise 02 · Sensors, odometry and simulated worlds
#
# **You will be able to** compute the range that a lidar beam and an ultrasonic sensor measure,
# simulate measurement noise and dropouts, evaluate the likelihood of a scan by the beam model, and
# estimate the noise of a sensor from readings that contain outliers.
#
# **60 minutes. Before:** lesson [02 · Sensors, odometry and simulated worlds](../notebooks/02_sensors_and_worlds.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check draws random inputs and tries special cases.
# It names the law that your answer breaks. When you are stuck, `hint("02-ray-wall")` asks a guiding
# question. Cells marked `@attempt` draw figures with your functions.
#
# All lengths are in metres and all angles in radians, counter-clockwise from the x axis, unless a
# task states otherwise. A pose is `[x, y, θ]`. A function must not change its arguments, because its
# caller still needs them.

# %%
import numpy as np
from scipy.special import ndtr

from classroom.checks import ask, attempt, check
from slamlab import layers, views

# %% [markdown]
# ## 1 · Ray casting: one beam, one wall
#
# A beam leaves the point $p$ in the direction $\varphi$. A wall is a row `[x1, y1, x2, y2]`: a
# segment from $p_1 = (x_1, y_1)$ to $p_2 = (x_2, y_2)$. In the lesson the sensor is at the origin.
# Here it may be at any point.
#
# Make a sketch first. Draw a beam that passes beside a wall, and a beam that points away from a
# wall. What are $r$ and $\tau$ of (02.1) in each case?
#
# **Your task.** Return the range at which the beam meets the wall, in metres. Return `np.inf` if
# the beam does not meet the wall, because the wall lies behind the sensor, the beam passes beside the wall, or the two
# are parallel. The check accepts an error of 1 µm. A wall may be a few centimetres or a hundred metres long. The
# direction $\varphi$ may be any number, also beyond a whole turn. Beams and walls may be parallel to the x or y axis.
# For $\varphi = 0$ a wall on the line of the beam is also parallel. In other directions rounding would decide, so there
# is no such wall. The point $p$ never lies on a wall, and no beam meets the end of a wall exactly.


# %% name="ray-wall"
def ray_wall(p, phi, wall):
    """Range from p to a wall along a beam.

    p : (2,) start of the beam [m];  phi : its direction [rad]
    wall : (4,) x1, y1, x2, y2 [m];  returns a range [m], or np.inf
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
# If a beam crosses several walls, the sensor reports the nearest one. If the beam meets no wall
# within `range_max`, the sensor reports NaN. The function `scan` below does this with your
# `ray_wall`. Move the sensor in Smolec's second situation. Which walls are hidden (occlusion)?


# %% name="scan"
def scan(p, directions, walls, range_max):
    """Ranges (n,) that a sensor at p (2,) measures to walls (w, 4); NaN for no return."""
    nearest = np.array([min(ray_wall(p, phi, wall) for wall in walls) for phi in directions])
    return np.where(nearest <= range_max, nearest, np.nan)


# %% name="situation"
@attempt
def _():
    from slamlab.simulation.worlds import situation_2

    walls = situation_2().walls
    directions = np.linspace(-np.pi, np.pi, 180, endpoint=False)

    def draw(x, y, range_max):
        ranges = scan(np.array([x, y]), directions, walls, range_max)
        ends = np.column_stack([x + ranges * np.cos(directions), y + ranges * np.sin(directions)])
        fig, ax = views.axes(f"{np.isfinite(ranges).sum()} beams have a return", size=(8, 5.4))
        views.draw(ax, layers.Segments("walls", walls))
        views.draw(ax, layers.Points("scan", ends), markersize=6)
        views.draw(ax, layers.Poses("robot", [[x, y, 0]]))
        return fig

    views.explore(
        draw,
        alt="Your scan in an irregular room: some walls are hidden, and some are too far away.",
        x=(-5.0, 1.7, -0.5),
        y=(-4.5, 1.4, 0.4),
        range_max=(1.0, 8.0, 4.5),
    )


# %% [markdown]
# ## 2 · An ultrasonic sensor: the first echo
#
# An ultrasonic sensor sends out a **cone** of sound. Its field of view reaches `half` to either
# side of its axis $\varphi$. It measures the distance to the nearest point in the cone, because the
# echo of this point returns first. The lesson showed the effect of the cone on a scan of a door. In
# this task you compute this effect.
#
# A thousand beams in the cone give an approximate answer, but a thin post may stand between two
# beams. You can compute the exact answer, because there are only three kinds of nearest points. The
# points of a wall are $p_1 + \tau\,(p_2 - p_1)$ with $0 \le \tau \le 1$, as in the lesson. Along
# the line of the wall, their distance from $p$ has a single minimum.
#
# Draw a cone and three walls. The nearest point of the first wall lies between its ends and in the
# cone. The nearest point of the second wall lies between its ends and outside the cone. The nearest
# point of the third wall is one of its ends. From which point of each wall does the first echo
# come?
#
# **Your task.** Return the distance in metres from $p$ to the nearest point of all walls that lies
# in the cone. Return `np.inf` if no such point exists. Every point of a wall returns an echo, at any angle of
# incidence. The check accepts an error of 1 µm. `half` lies between 1° and 80°, and $\varphi$ may be any number. There
# may be many walls, or no wall (then `walls` has the shape (0, 4)). Walls may be parallel to the x or y axis, point at
# the sensor, cross the whole cone, extend behind the sensor, or be as short as the width of a post. Each wall has a
# length above zero and is at least 10 cm from $p$. You need not decide whether a point on the edge of the cone belongs
# to the cone: the ends of a wall are at least 0.01 rad from both edges, and so is the foot of the perpendicular from
# $p$ if it lies on the wall. Nearest points between the ends of a wall earn 1 point, ends 1.5, and nearest points on
# the edge of the cone 2, if those between the ends are right, too.


# %% name="echo"
def echo(p, phi, half, walls):
    """Distance from which an ultrasonic sensor receives its first echo.

    p : (2,) position of the sensor [m];  phi : axis of its cone [rad]
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
# In the next figure your sensor scans a door as in the lesson, in 91 directions. Change the width
# of the cone. From which width on does the door look closed?


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
        alt="An ultrasonic scan by your function in front of a door; a wide cone closes the door.",
        cone_in_degrees=(2, 40, 25),
    )


# %% [markdown]
# ## 3 · Measurement noise and dropouts
#
# This task simulates a simple sensor. The standard deviation of its noise is proportional to the
# range: the noise of a range $r$ is normally distributed, with mean 0 and standard deviation
# `error` · $r$. Some beams have no return: each beam is lost with the probability `dropouts`,
# independently of the other beams and of its range.

# %%
ask(
    "ex02-variance",
    "Suppose that `error` is 0.01. **What is the variance of a reading at 10 m?**",
    right=0.01,
    tolerance=0.002,
    unit="m²",
    reason="σ is 1 % of 10 m, which is 0.1 m, and the variance is its square.",
    wrong={
        0.1: "this is σ, in metres. The variance is its square.",
        0.0001: "this is the square of `error`. First multiply `error` by the range of 10 m.",
    },
)

# %% [markdown]
# **Your task.** Return noisy readings (n,) in metres of true ranges. Draw all random numbers from
# the generator `rng`, so that the same seed gives the same result. If a range is NaN, the reading
# must be NaN. A scan may have any number of beams, also zero. `error` may be 0 to 0.25, and
# `dropouts` may be any number from 0 to 1, both included. The check judges thousands of readings:
#
# - the mean and the standard deviation of their relative errors (reading divided by range, minus
#   1), separately for near and for far walls;
# - the number of dropouts among the beams whose true range is not NaN; in many short scans also the
#   variance of this number; and whether other beams are lost with another seed;
# - the NaNs: no reading may replace a range that is NaN;
# - the seed: the same seed must give the same readings, and another seed must give other readings.
#
# The check allows deviations of six standard deviations, so a correct answer practically never
# fails by chance.


# %% name="noisy"
def noisy(ranges, error, dropouts, rng):
    """Readings of a noisy sensor.

    ranges : (n,) true [m]; NaN for no return;  error : standard deviation / range [1]
    dropouts : probability that a beam is lost [1];  rng : numpy.random.Generator
    returns (n,) [m]; NaN for no return
    """
    ### BEGIN SOLUTION
    measured = ranges + error * ranges * rng.standard_normal(len(ranges))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
    ### END SOLUTION


# %%
check("02-noise")

# %% [markdown]
# ## 4 · The likelihood of a scan
#
# How well does a scan agree with the ranges that ray casting predicts? The beam model (02.12) answers
# this question. Each beam has one of four causes, with the probabilities `weights`:
#
# - **hit**: the reading of the wall, with the noise of task 3. The density is that of a Gaussian about
#   the expected range $r^\star$ with σ = `error` · $r^\star$, but *only between 0 and* `range_max`;
# - **short**: an object in front of the wall. The density decreases as $e^{-\lambda r}$, *only between
#   0 and* $r^\star$, with λ = `rate` in 1/m;
# - **no return**: the reading is NaN;
# - **random**: the density is uniform between 0 and `range_max`.
#
# Each of the three densities integrates to one over its interval. Which factor does this need in the
# first one, if the wall is at `range_max`? And in the second one? (`ndtr(t)` is the distribution
# function of the standard normal distribution: the integral of its density from −∞ to $t$.)

# %%
ask(
    "ex02-float",
    "A scan has 400 beams without outliers. Each reading errs by two standard deviations, and each "
    "density is about 0.02 per metre. **Which floating-point number represents the likelihood of "
    "the scan?**",
    {
        "about $10^{-34}$": "that is the likelihood of twenty such beams. The likelihood of 400 beams is far smaller.",
        "exactly 0, and its logarithm is $-\\infty$": "the smallest positive float is about 5e-324, and $0.02^{400}$ is about 1e-680.",
        "a small number, known to 16 digits": "a float has 16 digits down to about 2e-308. This number is about 1e-680.",
    },
    right="exactly 0, and its logarithm is $-\\infty$",
)

# %% [markdown]
# **Your task.** Return the natural logarithm of the likelihood of a scan, whose beams are independent.
# Its error must be at most $10^{-6}$ of the result. A weight may be 0. Return `-np.inf` if a reading is impossible,
# such as NaN where the weight of no return is 0. A scan may have thousands of beams, or none, and a reading may be so
# far from the wall that its density is zero as a float. All readings and all walls are between 0 and `range_max`, and
# no reading equals its expected range. `error` is at most 0.5.
#
# | law | what must be right | points |
# | --- | --- | --- |
# | hit | the density of hits: scans without other causes | 1 |
# | short | the density of short ranges: scans without other causes | 1 |
# | mixture | scans with all four causes | 1.5 |
# | far | long scans, and readings that are dozens of σ from the wall (an error of 30 % is allowed) | 1 |
# | impossible | impossible readings (only together with other laws) | 0.5 |


# %% name="log-likelihood"
def log_likelihood(ranges, expected, weights, error, rate, range_max):
    """Logarithm of the likelihood of a scan by the beam model.

    ranges : (n,) measured [m], NaN for no return;  expected : (n,) ranges of the walls [m]
    weights : (4,) of hit, short, no return, random, which sum to one;  error : σ / expected range [1]
    rate : λ of short ranges [1/m];  range_max : largest range [m];  returns a number
    """
    ### BEGIN SOLUTION
    lost = np.isnan(ranges)
    r, wall = ranges[~lost], expected[~lost]
    sigma = error * wall
    inside = ndtr((range_max - wall) / sigma) - ndtr(-wall / sigma)
    with np.errstate(divide="ignore"):
        hit, short, none, random = np.log(weights)
    hit = hit - 0.5 * ((r - wall) / sigma) ** 2 - np.log(np.sqrt(2 * np.pi) * sigma * inside)
    short = short + np.log(rate) - rate * r - np.log(1 - np.exp(-rate * wall))
    short = np.where(r < wall, short, -np.inf)
    random = np.full(len(r), random - np.log(range_max))
    beams = np.logaddexp(np.logaddexp(hit, short), random)
    return np.sum(beams) + (none * lost.sum() if lost.any() else 0)
    ### END SOLUTION


# %%
check("02-beam")

# %% [markdown]
# The figure shows your density of one beam. Move the wall to `range_max`. The integral of the
# density is the probability of a return, 0.9, wherever the wall is.


# %% name="density"
@attempt
def _():
    r = np.linspace(0, 8, 1602)[1:-1]

    def draw(wall, error):
        weights = np.array([0.6, 0.2, 0.1, 0.1])
        given = np.array([wall + 1e-6]), weights, error, 0.5, 8.0
        density = np.exp([log_likelihood(np.array([each]), *given) for each in r])
        title = f"integral {density.sum() * (r[1] - r[0]):.2f}"
        fig, _ = views.curves(r, {"density": density}, "range [m]", "density [1/m]", title)
        return fig

    views.explore(
        draw,
        alt="The density of one beam: a peak at the wall, and a decrease in front of it.",
        wall=(1.0, 7.9, 5.0),
        error=(0.02, 0.3, 0.05),
    )


# %% [markdown]
# ## 5 · Noise estimated in a busy room
#
# This task is the inverse problem: how large is the `error` of a sensor if only its readings are
# known? A sensor does not move and scans $k$ times. The result is an array $(k, n)$, with a row for
# each scan and a column for each beam. Each column holds repeated readings of *one* wall, at an
# unknown distance.
#
# In a quiet room you can compute `error` in two lines: it is the standard deviation of each column,
# divided by the mean of the column.


# %% name="quiet-fit"
def quiet_fit(scans):
    """The error of a sensor in a quiet room: standard deviation / range, over all beams."""
    share = scans / scans.mean(axis=0) - 1
    return np.sqrt(np.sum(share**2) / (share.size - scans.shape[1]))  # a mean for each beam


# %% [markdown]
# This room is not quiet, and the sensor has a low resolution:
#
# - **Outliers.** People walk through the room. A person blocks each reading with the probability
#   `blocked`, from 0 to 0.4. A blocked reading is uniformly distributed between 0 and the range of
#   the wall.
# - **Noise.** Every other reading is $r + \varepsilon$, where $r$ is the range of the beam's wall. The noise
#   $\varepsilon$ is normally distributed with mean 0 and standard deviation `error` · $r$.
# - **Quantisation.** The sensor rounds all readings to whole multiples of `step`, which is 1 to 8
#   cm. For near walls `step` is larger than the noise, and all readings of a wall may be equal.
#
# The walls are 1 to 9 m away, and `error` lies between 0.002 and 0.03. The array contains at least
# 24 scans of at least twelve beams, and no dropouts.

# %%
ask(
    "ex02-person",
    "Twenty readings of a wall at 5 m have an error of 5 cm each, and one outlier is the range of "
    "a person at 0.5 m. **How large is the standard deviation of all 21 readings?**",
    right=0.97,
    tolerance=0.15,
    unit="m",
    reason="the outlier has an error of 4.5 m. A standard deviation contains the squares of the "
    "errors, so the outlier contributes far more than the twenty other readings. The result of "
    "quiet_fit would be about twenty times too large.",
    wrong={
        0.05: "this is the standard deviation of the twenty good readings. But the error of the "
        "outlier is ninety times as large, and a standard deviation contains the square of this "
        "error.",
        0.26: "this is the mean absolute error of the 21 readings. A standard deviation uses the "
        "mean of the squared errors.",
    },
)

# %% [markdown]
# **Your task.** Estimate `error` and `blocked`, and return both. Any method is allowed. These
# questions may help:
#
# - To distinguish outliers from readings of the wall, you need the standard deviation that you want
#   to estimate. How can you begin with an initial guess and improve it iteratively?
# - Quantisation adds an error that is uniformly distributed between minus half a step and plus half
#   a step. What is the variance of this error? What is the variance of noise and quantisation
#   together?
# - Which beams contain more information about `error`: the beams of near walls or the beams of far
#   walls? Should all beams have the same weight?
#
# The check draws eighty sensors with 24 scans of 24 beams each. The check stops after 10 s. It
# judges the factor by which `error` is too large or too small, and the difference between your
# `blocked` and the *probability* that a reading is blocked. (The fraction of blocked readings in a
# single array differs from this probability by chance.) Both numbers must be below their limits:
#
# | row | factor of `error` | difference of `blocked` | judged | points |
# | --- | --- | --- | --- | --- |
# | 1 | 1.35 | 0.04 | the medians over all sensors | 0.5 |
# | 2 | 1.17 | 0.03 | the medians over all sensors | 1 |
# | 3 | 1.08 | 0.03 | the medians over all sensors, and the quarter with the coarsest steps | 1.5 |
# | 4 | 1.16 | 0.06 | each sensor: at least 62 of the 80 must be below both limits; and the same quarter | 2 |
#
# The points of all rows that you reach are added. Leaving the arguments unchanged is worth another
# 0.5 points. Row 4 has wider limits than row 3, because it judges the single sensors and not their
# medians. You can reach it without row 3. In both rows the *quarter* of the sensors with the largest
# ratio of `step` to `error` must not have a common bias: the geometric mean of the estimated `error`
# divided by the right one must be between 0.87 and 1.05 (single ratios count as 0.74 to 1.35 at
# most). The limits of row 1 must also hold for six sensors without outliers (30 scans of 12 beams,
# `step` about 1 cm), and for twelve sensors with 40 scans of 12 beams.


# %% name="busy-fit"
def busy_fit(scans, step):
    """Noise of a sensor and rate of outliers, from readings in a busy room.

    scans : (k, n) ranges [m], a row for each scan, a column for each beam; multiples of step
    step : quantisation step of the sensor [m]
    returns error (standard deviation / range) [1] and blocked (probability of an outlier) [1]
    """
    ### BEGIN SOLUTION
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(12):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2  # the others are outliers
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
# The next cell simulates sensors with known parameters, so that you can test your method. The title
# compares your `blocked` with the fraction of outliers among the 576 readings of this array, which
# differs from the probability by about 0.02. Choose another random seed, more outliers or a larger
# quantisation step. In which cases does your method fail, and how large is its error?


# %% name="readings"
@attempt
def _():
    def draw(seed, blocked, step_in_cm):
        rng, step, error = np.random.default_rng(int(seed)), step_in_cm / 100, 0.01
        walls = np.sort(rng.uniform(1, 9, 24))
        scans = walls * (1 + error * rng.standard_normal((24, 24)))
        people = rng.random(scans.shape) < blocked
        scans = step * np.rint(np.where(people, walls * rng.random(scans.shape), scans) / step)
        found = busy_fit(scans, step)
        title = f"error {found[0]:.4f}, true {error} (quiet_fit: {quiet_fit(scans):.2f});"
        title += f"  blocked {found[1]:.2f}, true {people.mean():.2f}"
        fig, ax = views.chart("beam", "reading [m]", title, (9, 4))
        beam = np.tile(np.arange(24), (24, 1))
        ax.plot(beam[people], scans[people], ".", color=views.COLOURS["naive"], label="outliers")
        ax.plot(beam[~people], scans[~people], ".", color=views.COLOURS["corrected"], label="wall")
        views.legend(ax)
        return fig

    views.explore(
        draw,
        alt="Readings of each beam: the readings of the wall lie close together, and the outliers lie below them.",
        seed=(0, 20, 3),
        blocked=(0.0, 0.4, 0.2),
        step_in_cm=(1, 8, 4),
    )


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** lesson [03 · The Kalman filter](../notebooks/03_kalman_filter.ipynb) uses such variances
# to combine a measurement with a prior estimate.
