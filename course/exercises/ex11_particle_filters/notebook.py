# %% [markdown]
# # Exercise 11 · Particle filters
#
# **You will be able to** localise a robot with a particle set, compute importance weights for particles from another
# proposal, write a step of FastSLAM, and relocalise a kidnapped robot.
#
# **60 minutes. Before:** lesson [11 · Particle filters](../notebooks/11_particle_filters.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check tries random inputs and special cases that
# the text allows, such as a single particle. If your answer breaks a law, the check shows a small
# input that breaks it. `hint("11-draw")` in a cell of your own asks a guiding question.
#
# All lengths are in metres, all angles in radians. `rows` (n, 3) are particles, one pose `[x, y,
# θ]` in each row. A control input from odometry is `u = [d, Δθ]`. `z` (m, 2) are measured ranges
# and bearings of the landmarks `p` (m, 2). Row `j` of `z` belongs to row `j` of `p`, so the data
# association is known. The inputs contain at least one particle and one landmark. All given
# headings and bearings are in $(-\pi, \pi]$. Take random numbers only from `rng`, a
# `numpy.random.Generator`. A function must not change its arguments.

# %%
import numpy as np

from classroom.checks import ask, attempt, check
from slamlab import layers, views
from slamlab.geometry import wrap
from slamlab.models import f_odometry, h

# %% [markdown]
# You may use three functions. `h(x, p)` returns the range and bearing of landmarks p (m, 2) from
# **one** pose x (3,), or of **one** landmark p (2,) from many poses x (n, 3). `f_odometry(x, u)` is
# the motion model for one pose. `wrap(angle)` returns the angle in $(-\pi, \pi]$.
#
# The next cell contains four given functions. Read them first. `move` samples the motion model:
# each particle moves along *its own* heading, with *its own* odometry noise of covariance C (2, 2).
# `log_likelihoods` returns the logarithm of (11.5) for each particle, except for a constant that is
# equal for all particles. `normalise` is (11.7), and `effective_size` is (11.6).


# %%
def move(rows, u, C, rng):
    """Particles (n, 3) sampled from the motion model."""
    d, turn = rng.multivariate_normal(u, C, len(rows)).T
    x, y, theta = rows.T
    return np.column_stack([x + d * np.cos(theta), y + d * np.sin(theta), wrap(theta + turn)])


def log_likelihoods(rows, p, z, R):
    """Log-likelihoods (n,) of a scan of the landmarks p (m, 2), given each particle."""
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z, strict=True):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return logs


def normalise(logs):
    """Normalised weights (n,) from the logarithms of weights of any size, (11.7)."""
    weights = np.exp(logs - np.max(logs))
    return weights / np.sum(weights)


def effective_size(weights):
    """Effective sample size of normalised weights."""
    return 1 / np.sum(weights**2)


# %% [markdown]
# ## 1 · Systematic resampling
#
# Resampling draws $n$ new particles from $n$ particles, particle $i$ with the probability $w_i$.
# Put the weights one after the other on a line of length 1: each weight is a segment of this line.
# Systematic resampling uses $n$ positions on the line, at distances of $1/n$. *One* random number
# shifts all positions: the first position is uniformly distributed between 0 and $1/n$. Each
# position selects the particle of the segment that contains the position.

# %%
ask(
    "ex11-comb",
    "One of ten particles has the weight 0.35. **How many copies of this particle can systematic resampling draw?**",
    {
        "any number from 0 to 10": "that is right for multinomial resampling, which uses a separate random number for each of the ten draws.",
        "3 or 4": "the segment has the length 0.35. The distance of the positions is 0.1, so the segment contains three or four of them.",
        "always 4": "the expected number is 3.5. The random shift decides whether the number is 3 or 4.",
    },
    right="3 or 4",
)

# %% [markdown]
# **Your task.** Return the drawn rows as indices from 0 to $n - 1$, in any order. Weights may be
# zero. Their sum is one except for rounding, so the last segment may end slightly below one, and
# a position may lie beyond it. Such a position must select the last particle. (`np.cumsum` gives
# the ends of the segments, and `np.searchsorted` finds the segment of a position.) The number of
# copies of particle $i$ must be $n w_i$, rounded up or down, for every seed, and $n w_i$ on average
# over many seeds. The same seed must give the same indices.


# %%
def draw(weights, rng):
    """Systematic (low-variance) resampling.

    weights : (n,) that sum to one;  rng : Generator;  returns (n,) indices
    """
    ### BEGIN SOLUTION
    n = len(weights)
    teeth = (rng.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth, side="right"), n - 1)
    ### END SOLUTION


# %%
check("11-draw")

# %% [markdown]
# The next cell resamples eight particles. It prints the expected numbers of copies, $n w$, and your
# numbers of copies.


# %%
@attempt
def _():
    weights = np.array([0.28, 0.05, 0.17, 0.02, 0.12, 0.21, 0.04, 0.11])
    picked = np.bincount(draw(weights, np.random.default_rng(3)), minlength=8)
    print("n w  ", 8 * weights)
    print("drawn", picked)


# %% [markdown]
# ## 2 · Monte Carlo localisation
#
# This is one step of Monte Carlo localisation in a known map:
#
# 1. *Predict:* move every particle.
# 2. *Update and normalise:* multiply each weight by the likelihood, (11.5), and divide by the sum.
# 3. *Resample* if the effective sample size (11.6) is now less than $n/2$. All weights are then $1/n$.
#
# **Your task.** Return the particles and the weights after the step. The given weights are
# positive and sum to one. All particles may be metres from the true pose. If your
# `draw` is wrong, the check uses a correct one in its place. The check stops after 10 s. It judges
# the following:
#
# - In all runs, the ratios of the new weights of a step that did not resample must be right
#   within $10^{-6}$, the weights must sum to one, and after each step the effective sample size
#   must be at least $n/2$.
# - In some runs the odometry noise is nearly zero ($\sigma = 10^{-9}$), so the check knows where
#   each particle moves. There each row must be a moved particle within $10^{-6}$. Rows may be
#   resampled only if the effective sample size is less than $n/2$, and then the numbers of copies
#   must agree with $n w$ (any unbiased method of resampling agrees).
# - In the other runs, the check compares 2000 particles with a Kalman filter that is exact for
#   these runs. The error of the weighted mean, in units of the Kalman filter's standard
#   deviations, must have a root mean square below 0.12 over all runs, steps and components. From
#   the second step on, the variances of the particles, divided by those of the Kalman filter,
#   must be 0.9 to 1.1 on average.


# %%
def localise(rows, weights, u, C, p, z, R, rng):
    """One step: control input u with covariance C, measurements z of landmarks p with covariance R.

    rows : (n, 3);  weights : (n,);  u : (2,);  C : (2, 2);  p, z : (m, 2);  R : (2, 2)
    returns rows (n, 3), weights (n,)
    """
    ### BEGIN SOLUTION
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
    ### END SOLUTION


# %%
check("11-localise")

# %% [markdown]
# The next cell begins with 3000 random particles in a room with four landmarks. The data
# association is known.


# %%
@attempt
def _():
    rng, p = np.random.default_rng(11), np.array([[3, 2], [-3, 2], [-3, -2], [2, -2]])
    rows = rng.uniform([-3, -2, -np.pi], [3, 2, np.pi], (3000, 3))
    weights, truth, u = np.full(3000, 1 / 3000), np.array([-1.5, -1.0, 0.4]), np.array([0.4, 0.1])
    C, R, clouds = np.diag([0.04, 0.04]) ** 2, np.diag([0.4, 0.25]) ** 2, {}
    for k in range(6):
        if k in (0, 1, 5):
            samples = layers.Particles("samples", rows, weights)
            clouds[f"after {k}"] = [samples, layers.Poses("truth", truth)]
        truth = f_odometry(truth, u)
        z = h(truth, p) + rng.multivariate_normal([0, 0], R, 4)
        rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    fig, _ = views.side_by_side(clouds, size=(10, 3))
    views.show(
        fig,
        alt="The particles at the start, after one step and after five steps, and the true pose.",
    )


# %% [markdown]
# ## 3 · Importance weights for another proposal
#
# In the lesson, each particle is sampled from the motion model, so its weight is multiplied by the
# likelihood only. If the sensor is accurate, most of these particles are useless, because the
# measurement is unlikely at their poses. A better proposal uses the measurement *before* it
# samples. Here particle $i$ moved by its own control input $u_i = [d, \Delta\theta]$. This input
# was sampled from a Gaussian with the mean $m_i$ and the covariance $D_i$, the **proposal**. The
# motion model is as before: a Gaussian with the mean $u$, from odometry, and the covariance $C$.
#
# You know the pose of each particle before and after its motion, but not its $u_i$. (The particle
# first moved along its old heading, forwards or backwards. Then it turned by less than $\pi$.)
#
# Consider two cases. First, the density of a particle's motion is ten times as large under the
# proposal as under the motion model. How should the weight of this particle change? Second, two
# particles made the same motion. One motion was sampled from a narrow Gaussian, and the other from
# a Gaussian that is four times as wide. Should both particles have the same weight?
#
# **Your task.** The given weights are positive, and they already include the likelihood of all
# measurements. Multiply them by the importance weight (11.4) of the motion, and normalise them.
# Some motions may be so many $\sigma$ from a mean that their densities are too small for a float.


# %%
def reweigh(before, after, weights, u, C, m, D):
    """Weights of particles whose motions were sampled from other Gaussians.

    before, after : (n, 3) poses;  weights : (n,) positive;  u : (2,), C : (2, 2) of the motion model
    m : (n, 2), D : (n, 2, 2) mean and covariance of each particle's proposal
    returns (n,) weights that sum to one
    """
    ### BEGIN SOLUTION
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    logs = np.log(weights)
    for k in range(len(e)):
        v, w = e[k] - u, e[k] - m[k]
        logs[k] += 0.5 * (w @ np.linalg.inv(D[k]) @ w - v @ np.linalg.inv(C) @ v)
        logs[k] += 0.5 * np.log(np.linalg.det(D[k]))
    return normalise(logs)
    ### END SOLUTION


# %%
check("11-proposal")

# %% [markdown]
# ## 4 · One step of FastSLAM
#
# So far the map was known. In FastSLAM each particle has *its own* map. Here the map is a single
# landmark. Given its trajectory, particle $i$ estimates this landmark with its own small EKF, as a
# Gaussian with the mean $\hat p_i$ and the covariance $P_i$. So the pose is sampled, and the map is
# computed in closed form: this is a **Rao–Blackwellised particle filter** (11.11).
#
# If the pose of a particle is right, which two errors does its innovation contain? Now consider two
# particles that both expect exactly the measurement that is made. One knows its landmark within
# 1 cm, the other within 1 m. Which of them gave the measurement the higher probability density?
#
# **Your task.** Move the particles, update the map of each particle by the measurement $z$ of its
# landmark, and multiply each weight by the likelihood of $z$ under the pose *and the map* of this
# particle. Do not resample. The given weights are positive and sum to one, and your weights must
# sum to one, too. Some particles expect the landmark so far away from $z$ that their likelihoods are
# zero as floats. $C$ may be nearly zero. A landmark is never closer than 20 cm to a particle. You
# may compute derivatives numerically.
#
# | law | what must hold | points |
# | --- | --- | --- |
# | moved | if $\sigma = 10^{-9}$ for odometry: each pose moves by $u$ along its own heading (only together with other laws) | 0.5 |
# | map | in the same runs: $\hat p_i$ and $P_i$ after the update | 1 |
# | weights | in the same runs: the weights | 1 |
# | far | the weights, if all likelihoods are zero as floats | 0.5 |
# | sampled | if odometry is noisy: the errors of $d$ and $\Delta\theta$ of 1500 particles have the mean 0 and the covariance $C$ within six standard deviations of chance, and the map or the weights belong to the returned poses | 1 |
#
# Numbers may have a relative error of $10^{-5}$, compared with the largest number of the array.


# %%
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    """One step of FastSLAM with one landmark, without resampling.

    rows : (n, 3);  weights : (n,);  p : (n, 2), P : (n, 2, 2) the landmark of each particle
    u : (2,), C : (2, 2) odometry;  z : (2,) measurement of the landmark;  R : (2, 2)
    returns rows (n, 3), weights (n,), p (n, 2), P (n, 2, 2)
    """
    ### BEGIN SOLUTION
    rows = move(rows, u, C, rng)
    logs, means, covariances = np.log(weights), np.empty(p.shape), np.empty(P.shape)
    for i, x in enumerate(rows):
        d = p[i] - x[:2]
        q = d @ d
        H = np.array([d / np.sqrt(q), [-d[1] / q, d[0] / q]])
        v = z - h(x, p[i])
        v[1] = wrap(v[1])
        S = H @ P[i] @ H.T + R
        K = P[i] @ H.T @ np.linalg.inv(S)
        means[i] = p[i] + K @ v
        covariances[i] = P[i] - K @ S @ K.T
        logs[i] -= 0.5 * (v @ np.linalg.inv(S) @ v + np.log(np.linalg.det(S)))
    return rows, normalise(logs), means, covariances
    ### END SOLUTION


# %%
check("11-fastslam")

# %% [markdown]
# In the figure a robot drives on a circle and measures one landmark. Particles with other poses have other maps.


# %%
@attempt
def _():
    rng, n, mark, u = np.random.default_rng(11), 200, np.array([1.0, 3.0]), np.array([0.5, 0.15])
    truth, rows, weights = np.zeros(3), np.zeros((n, 3)), np.full(n, 1 / n)
    p, P = np.tile(mark + 0.2, (n, 1)), np.tile(0.3**2 * np.eye(2), (n, 1, 1))
    C, R = np.diag([0.05, 0.04]) ** 2, np.diag([0.3, 0.1]) ** 2
    for _ in range(12):
        truth = f_odometry(truth, rng.multivariate_normal(u, C))
        z = h(truth, mark) + rng.multivariate_normal([0, 0], R)
        rows, weights, p, P = fast_slam(rows, weights, p, P, u, C, z, R, rng)
    fig, ax = views.axes("FastSLAM after twelve steps, without resampling", size=(7, 4))
    views.draw(ax, layers.Particles("samples", rows, weights))
    views.draw(ax, layers.Points("maps", p))
    views.draw(ax, layers.Poses("truth", truth))
    views.legend(ax)
    views.show(fig, alt="Particles with their landmarks after twelve steps, and the true pose.")


# %% [markdown]
# ## 5 · Relocalise a kidnapped robot
#
# A robot moves in a room of 10 m by 8 m. The centre of the room is the origin. In every step the
# robot measures *one* of six posts, with known data association and the noise $R$. With a
# probability of 0.1 the measurement is false. The range of a false measurement is uniform between 0
# and 10 m, and its bearing is uniform over all angles. Once in a run of thirty steps, at an unknown
# time, the robot is kidnapped: somebody moves it to a random pose in the room, at least three
# metres away.
#
# At the start the particles are near the robot. Until the kidnapping, your `localise` tracks the
# robot well. The lesson injected random particles anywhere in the room. Here such a particle is
# rarely right, because all three components of its pose must be right and there are only 300
# particles. One measurement determines two of these three components.

# %%
ask(
    "ex11-odd",
    "All particles agree, and the expected range of a post is 5 m. The measured range is 3 m. **Which is more probable: "
    "that this measurement is false, or that the robot has just been kidnapped?**",
    {
        "a false measurement, about three times": "one measurement in ten is false, and the robot "
        "is kidnapped in one step of thirty. In both cases almost any range and bearing is "
        "possible.",
        "a kidnapping: true measurements are never 2 m off": "true measurements are never 2 m off, but one measurement in ten is false.",
        "both are equally probable": "one step in thirty is a kidnapping. How many measurements in thirty are false?",
    },
    right="a false measurement, about three times",
)

# %% [markdown]
# What can you conclude if the next measurement is unexpected, too? From which poses is the first
# measurement possible? If you sample some of these poses, which density has your proposal (task 3)?
#
# **Your task.** Write a step that relocalises the robot soon and is robust against false
# measurements. Any method is allowed. The number of particles must not change. Weights must not
# be negative, and not all of them may be 0. All that the function knows about earlier steps must
# be in `rows` and `weights`. Do not use global variables or attributes: the check calculates
# sixteen runs at the same time, so the next call of `find_again` belongs to another run. If
# your `draw` is wrong, the check uses a correct one in its place. The check stops after 10 s.
#
# *Near* means within 0.5 m of the robot. The *search* is the ten steps that follow the
# kidnapping. The error of a step is the weighted mean distance of the particles from the robot.
# The error of a run is the mean error of its steps before and after the search.
#
# | law | what must hold | points |
# | --- | --- | --- |
# | 1 | in at least 60 % of the runs, more than 50 % of the weight is near, averaged over the last five steps of the run | 1 |
# | 2 | at least 50 % of the weight is near, averaged over all steps of the search and all runs | 0.5 |
# | 3 | law 2, and the median error of the runs is at most 0.6 m | 2 |
# | 4 | law 2, and without the two worst of the sixteen runs, the mean error of the runs is at most 0.3 m | 2 |
#
# Each law adds its points, whether or not the laws above it hold, except that laws 3 and 4
# contain law 2. Law 2 earns no points alone. Together with 0.5 points for unchanged arguments,
# these are the 6 points of the task.

# %%
ROOM, REACH, OUTLIERS = np.array([10.0, 8.0]), 10.0, 0.1


# %%
def find_again(rows, weights, u, C, p, z, R, rng):
    """One step: control input u with covariance C, measurement z (true or false) of the post p.

    rows : (n, 3);  weights : (n,);  u : (2,);  C : (2, 2);  p, z : (1, 2);  R : (2, 2)
    returns rows (n, 3), weights (n,)
    """
    ### BEGIN SOLUTION
    n, carried = len(rows), 0.01
    rows = move(rows, u, C, rng)
    # random particles on a ring around the post: poses from which z could have been measured
    r, beta = rng.multivariate_normal(z[0], R, n).T
    angle = rng.uniform(-np.pi, np.pi, n)
    x, y = p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle)
    random_particles = np.column_stack([x, y, wrap(angle + np.pi - beta)])
    inside = np.all(np.abs(random_particles[:, :2]) < ROOM / 2, axis=1)
    # the proposal's density on the ring is likelihood / (2π r), a kidnapped robot's 1 / (area · 2π)
    real = np.exp(log_likelihoods(rows, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    seen = (1 - OUTLIERS) * real + OUTLIERS / (REACH * 2 * np.pi)
    odd = (1 - OUTLIERS) * inside * np.abs(r) / np.prod(ROOM) / n
    together = np.concatenate([(1 - carried) * weights * seen, carried * odd])
    picked = draw(together / np.sum(together), rng)[rng.integers(2) :: 2]
    return np.vstack([rows, random_particles])[picked], np.full(n, 1 / n)
    ### END SOLUTION


# %%
check("11-kidnapped")

# %% [markdown]
# In this run the robot is kidnapped after step 12. The figure shows the weighted mean distance of
# the particles from the robot.


# %%
@attempt
def _():
    posts = np.array([[4.5, 3.5], [-4.5, 3.5], [-4.5, -3.5], [4.5, -3.5], [1.0, 3.0], [-2.0, -3.2]])
    C, R, errors = np.diag([0.04, 0.04]) ** 2, np.diag([0.15, 0.06]) ** 2, {}
    for name, step in (("find_again", find_again), ("localise", localise)):
        rng, truth = np.random.default_rng(3), np.array([-2.0, -1.0, 0.3])
        rows, weights, off = rng.normal(truth, 0.15, (300, 3)), np.full(300, 1 / 300), []
        own = np.random.default_rng(4)
        for k in range(30):
            truth = np.array([2.5, 1.0, 3.0]) if k == 12 else truth
            u, p = np.array([0.25, 0.2]), posts[[k * 5 % 6]]
            truth = f_odometry(truth, rng.multivariate_normal(u, C))
            z = h(truth, p) + rng.multivariate_normal([0, 0], R, 1)
            z = z if k not in (5, 9, 24) else np.array([[6.0, -1.0]])
            rows, weights = step(rows, weights, u, C, p, z, R, own)
            off.append(weights @ np.hypot(*(rows[:, :2] - truth[:2]).T) / np.sum(weights))
        errors[name] = off
    fig, _ = views.curves(np.arange(1, 31), errors, "step", "error [m]", "Kidnapped after step 12")
    views.show(fig, alt="The errors of localise and of find_again over thirty steps.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** in lesson [12 · Three filters on one robot](../notebooks/12_three_filters.ipynb)
# set-membership, Kalman and particle filters run on the same robot.
