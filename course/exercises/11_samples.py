# %% [markdown]
# # Exercise 11 · Samples
#
# **You will be able to** localise a robot with a cloud of samples, every part of it written by you:
# move, weigh, normalise, draw.
#
# **45 minutes. Before:** lesson [11 · Samples](../notebooks/11_samples.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs, says which law is broken, and what the
# mistake is where it knows it.
#
# Metres and radians. `rows` (n, 3) are samples of the pose, one `[x, y, θ]` a row. `u = [d, Δθ]` is a
# drive, `z` (m, 2) are ranges and bearings of the landmarks `p` (m, 2). Random numbers come from
# `rng`, a `numpy.random.Generator`, and from nowhere else.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import attempt, check
from slamlab.geometry import wrap
from slamlab.models import f_odometry, h

# %% [markdown]
# What there is: `h(x, p)`, range and bearing of landmarks p (m, 2) from **one** pose x (3,), or of
# **one** landmark p (2,) from many poses x (n, 3); `f_odometry(x, u)`, one pose driven; and
# `wrap(angle)`, which brings angles into (−π, π].
#
# ## 1 · Move
#
# Every sample drives: the distance along the heading **it** has, then the turn. The wheels err: what
# a sample really drives is u and noise with the covariance C (2, 2).
#
# **Predict first.** All samples stand on one place. After the drive, where are they if all of them
# get the same draw of the noise? What would the cloud then say about the doubt?
#
# **Your task.** The moved samples. C is generic: d and Δθ may err together.
# (`rng.multivariate_normal` takes a mean, a covariance, and how many.)


# %%
def move(rows, u, C, rng):
    """The samples after a drive with noisy wheels.

    rows : (n, 3);  u : (2,) d [m], Δθ [rad];  C : (2, 2) covariance of u;  rng : Generator
    returns (n, 3)
    """
    ### BEGIN SOLUTION
    d, turn = rng.multivariate_normal(u, C, len(rows)).T
    x, y, theta = rows.T
    return np.column_stack([x + d * np.cos(theta), y + d * np.sin(theta), wrap(theta + turn)])
    ### END SOLUTION


# %%
check("11-move")

# %% [markdown]
# 400 samples that know their place and hardly their heading. Your cloud bends, and it bends round
# the right point.


# %%
@attempt
def _():
    rng = np.random.default_rng(11)
    rows = rng.normal(0, [0.02, 0.02, 0.4], (400, 3))
    moved = move(rows, np.array([2.0, 0.3]), np.diag([0.1, 0.05]) ** 2, rng)
    way = layers.Poses("without noise", [np.zeros(3), f_odometry(np.zeros(3), [2.0, 0.3])])
    fig, _ = views.cloud(moved, {"its covariance": np.cov(moved.T)}, layers=[way])
    views.show(fig, alt="A cloud of 400 moved samples, and its covariance's ellipse.")


# %% [markdown]
# ## 2 · Weigh
#
# How likely does a sample find the scan? Every sighting errs by itself, with the covariance R (2, 2):
#
# $$l_i = \sum_{j=1}^{m} -\tfrac12\, v_{ij}^{\mathsf T} R^{-1} v_{ij}, \qquad
# v_{ij} = z_j - h(x_i, p_j)$$
#
# **Predict first.** Twenty landmarks, every one two standard deviations off in range and bearing.
# What is exp(l)? And the same for 400 beams of a lidar? What is the logarithm of what is left?
#
# **Your task.** The logarithms l_i, for all samples. A constant that all samples share does not
# matter. No likelihood of its own should ever be computed: it would be zero.


# %%
def log_likelihoods(rows, p, z, R):
    """Logarithm of the likelihood of a scan, given each sample.

    rows : (n, 3);  p : (m, 2) landmarks;  z : (m, 2) where each is seen;  R : (2, 2)
    returns (n,)
    """
    ### BEGIN SOLUTION
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z, strict=True):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return logs
    ### END SOLUTION


# %%
check("11-weigh")

# %% [markdown]
# ## 3 · Normalise, and count
#
# $$w_i = \frac{e^{l_i}}{\sum_j e^{l_j}}, \qquad n_\text{eff} = \frac{1}{\sum_i w_i^2}$$
#
# **Predict first.** l = (−2000, −2001). What are the two weights? What does the formula give, typed
# as it stands? Which number may you take off both logarithms without changing a weight?
#
# **Your task.** Both. The weights must be right for logarithms of any size.


# %%
def normalise(logs):
    """Weights that sum to one, from logarithms of weights.

    logs : (n,);  returns (n,)
    """
    ### BEGIN SOLUTION
    weights = np.exp(logs - np.max(logs))
    return weights / np.sum(weights)
    ### END SOLUTION


# %%
def effective_size(weights):
    """How many equal samples the weighted ones are worth: 1 / Σ w².

    weights : (n,) that sum to one;  returns a number from 1 to n
    """
    ### BEGIN SOLUTION
    return 1 / np.sum(weights**2)
    ### END SOLUTION


# %%
check("11-normalise")

# %% [markdown]
# ## 4 · Draw, with a comb
#
# Draw as many samples as there are, sample i with probability w_i. Lay the weights end to end on a
# rod of length one, and hold a comb over it: n teeth, 1/n apart, the first at u/n. *One* random
# number u from [0, 1) shifts them all. Each tooth picks the sample that it falls on.
#
# **Predict first.** Ten samples, and one of them weighs 0.35. How many copies may it get from the
# comb? And how many may it get from ten random numbers, one for each draw?
#
# **Your task.** The rows drawn, as indices. (`np.cumsum` gives the ends of the pieces,
# `np.searchsorted` finds the piece. Rounding may leave the last end a hair below one.)


# %%
def draw(weights, rng):
    """Low-variance resampling.

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
# Eight weights, and your eight draws beside the copies that the weights ask for.


# %%
@attempt
def _():
    weights = np.array([0.28, 0.05, 0.17, 0.02, 0.12, 0.21, 0.04, 0.11])
    picked = np.bincount(draw(weights, np.random.default_rng(3)), minlength=8)
    print("asked for", 8 * weights)
    print("drawn    ", picked)


# %% [markdown]
# ## 5 · Localise
#
# One step of Monte Carlo localisation in a known map, with your functions:
#
# 1. move every sample;
# 2. multiply its weight by the likelihood (lesson 11: by nothing else), and normalise;
# 3. if the cloud is now worth less than half its samples, draw anew; all weights are equal then.
#
# **Predict first.** What becomes of the weights of the step before, if nothing was drawn then?
#
# **Your task.** The samples and the weights after the step.


# %%
def localise(rows, weights, u, C, p, z, R, rng):
    """One step: drive u with noise C, see landmarks p at z with noise R.

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
# And watch it: 3000 samples that know nothing, four landmarks with names, five steps.


# %%
@attempt
def _():
    rng, p = np.random.default_rng(11), np.array([[3, 2], [-3, 2], [-3, -2], [2, -2]])
    rows = rng.uniform([-3, -2, -np.pi], [3, 2, np.pi], (3000, 3))
    weights, truth, u = np.full(3000, 1 / 3000), np.array([-1.5, -1.0, 0.4]), np.array([0.4, 0.1])
    C, R, clouds = np.diag([0.04, 0.04]) ** 2, np.diag([0.4, 0.25]) ** 2, {}
    for k in range(6):
        if k in (0, 1, 5):
            samples = layers.Samples("samples", rows, weights)
            clouds[f"after {k}"] = [samples, layers.Poses("truth", truth)]
        truth = f_odometry(truth, u)
        z = h(truth, p) + rng.multivariate_normal([0, 0], R, 4)
        rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    fig, _ = views.side_by_side(clouds, size=(10, 3))
    views.show(fig, alt="The cloud at the start, after one step and after five, and the true pose.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. The next lesson lets samples, boxes and ellipses drive one robot.
