# %% [markdown]
# # Exercise 11 · Samples
#
# **You will be able to** localise a robot with a cloud of samples, weigh samples that were drawn from another
# density than they should have been, and find a robot again that somebody carried off.
#
# **60 minutes. Before:** lesson [11 · Samples](../notebooks/11_samples.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below it, as
# often as you like. A check tries random inputs and inputs at the edges of what the text promises. Where a law is
# broken it shows a small input that breaks it, and `hint("11-weigh")` in a cell of your own leads on.
#
# All lengths are in metres, all angles in radians. `rows` (n, 3) are samples of the pose, one `[x, y, θ]` a row. A
# drive is `u = [d, Δθ]`. `z` (m, 2) are ranges and bearings of the landmarks `p` (m, 2). There is at least one sample
# and at least one landmark. All headings and bearings that you are given lie in $(-\pi, \pi]$. Random numbers come from
# `rng`, a `numpy.random.Generator`, and from nowhere else. No function may change the arrays it is given, because
# whoever called it still needs them.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import ask, attempt, check
from slamlab.geometry import wrap
from slamlab.models import f_odometry, h

# %% [markdown]
# You may use `h(x, p)`, the range and bearing of landmarks p (m, 2) from **one** pose x (3,), or of **one** landmark
# p (2,) from many poses x (n, 3); `f_odometry(x, u)`, one pose after a drive; and `wrap(angle)`, which brings angles
# into $(-\pi, \pi]$.
#
# The next cell has three functions that are ready to use. Read them. In `move` each sample drives along the heading that
# *it* has, with *its own* draw of the wheels' noise, whose covariance is C (2, 2).


# %%
def move(rows, u, C, rng):
    """The samples (n, 3) after a drive with noisy wheels."""
    d, turn = rng.multivariate_normal(u, C, len(rows)).T
    x, y, theta = rows.T
    return np.column_stack([x + d * np.cos(theta), y + d * np.sin(theta), wrap(theta + turn)])


def normalise(logs):
    """Weights (n,) that sum to one, from logarithms of weights of any size."""
    weights = np.exp(logs - np.max(logs))
    return weights / np.sum(weights)


def effective_size(weights):
    """How many equal samples the weighted ones are worth."""
    return 1 / np.sum(weights**2)


# %% [markdown]
# ## 1 · Weigh
#
# How well does a sample $x_i$ explain the scan? Each of the $m$ sightings errs independently of the others, with the
# covariance $R$, so the logarithms of their likelihoods add up:
#
# $$\ell_i = \sum_{j=1}^{m} -\tfrac12\, v_{ij}^{\mathsf T} R^{-1} v_{ij}, \qquad v_{ij} = z_j - h(x_i, p_j).$$

# %%
ask(
    "ex11-float",
    "A lidar has 400 beams, and each is two standard deviations off in range and in bearing. Its "
    "likelihood is $e^{\\ell}$ with $\\ell = -1600$. **What does a float make of it?**",
    {
        "about $10^{-35}$": "so small is it for twenty landmarks. For 400 beams it is far smaller still.",
        "exactly 0, and its logarithm is $-\\infty$": "no float but 0 is smaller than 5e-324. If all samples get 0, nothing tells the better ones "
        "from the worse.",
        "a small number, known to 16 digits": "a float has 16 digits down to some 2e-308. This number is about 1e-695.",
    },
    right="exactly 0, and its logarithm is $-\\infty$",
)

# %% [markdown]
# **Your task.** Return the logarithms $\ell_i$ of all samples. A constant that all samples share does not matter. Samples
# may be many metres off, so never compute a likelihood itself: it would be zero. Range and bearing may err together. Some
# arrays hold whole numbers.


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
# ## 2 · Draw, with a comb
#
# Draw as many samples as there are, sample $i$ with the probability $w_i$. Lay the weights end to end on a rod of length
# one, and hold a comb over it. The comb has $n$ teeth, $1/n$ apart, and *one* random number shifts the whole comb: its first
# tooth stands anywhere from 0 to $1/n$, no place likelier than another. Each tooth picks the sample above whose piece it stands.

# %%
ask(
    "ex11-comb",
    "One of ten samples weighs 0.35. **How many copies of it may the comb make?**",
    {
        "any number from 0 to 10": "so it is if each of the ten draws has a random number of its own.",
        "3 or 4": "a piece of 0.35 is longer than three steps of the comb and shorter than four.",
        "always 4": "3.5 is rounded up or down, and the shift of the comb decides which.",
    },
    right="3 or 4",
)

# %% [markdown]
# **Your task.** Return the rows that are drawn, as indices from 0 to $n - 1$, in any order. Weights may be zero. They sum
# to one, but for rounding, and rounding may leave the end of the last piece a hair below one. (`np.cumsum` gives the ends of
# the pieces, and `np.searchsorted` finds a piece.)


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
# Here are your eight draws from eight weights, beside the copies that the weights ask for.


# %%
@attempt
def _():
    weights = np.array([0.28, 0.05, 0.17, 0.02, 0.12, 0.21, 0.04, 0.11])
    picked = np.bincount(draw(weights, np.random.default_rng(3)), minlength=8)
    print("asked for", 8 * weights)
    print("drawn    ", picked)


# %% [markdown]
# ## 3 · Localise
#
# This is one step of Monte Carlo localisation in a known map:
#
# 1. Move every sample.
# 2. Multiply its weight by the likelihood, (11.5), and let the weights sum to one.
# 3. If the cloud is now worth less than half its samples, (11.6), draw anew. All weights are equal then.
#
# **Your task.** Return the samples and the weights after the step. The weights that you are given are positive and sum to
# one. All samples may be metres off, and the wheels may hardly err at all. The check stops after 10 s.


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
# Watch 3000 samples that begin anywhere, in a room with four landmarks that have names.


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
# ## 4 · Samples from another drawing
#
# The lesson drew each sample by the wheels' noise, and so its weight was the likelihood alone. With a sharp sensor
# that is a waste: most samples land where the sighting says that the robot cannot be. So somebody looked at the sighting
# *first*, and sent each sample where the sighting wants it. Sample $i$ drove a $u_i = [d, \Delta\theta]$ that was drawn from
# a Gaussian of its own, with the mean $m_i$ and the covariance $D_i$. The wheels are as they were: they drive $u$,
# with noise of the covariance $C$.
#
# You know where each sample stood before and where it stands after its drive. (It drove along the heading that it had,
# forwards or backwards, and then turned by less than half a turn.)
#
# Two cases to think of. A sample made a drive that the drawing prefers ten times as much as the wheels do: how much should it count?
# Two samples made the same drive, but one drew it from a narrow hill, the other from a hill four times as wide: may the two weigh the
# same?
#
# **Your task.** The given weights are positive and hold everything that was seen. Multiply them by
# what (11.4) asks for here, and let them sum to one. Some samples may lie so many $\sigma$ off that
# their densities are too small for a float.


# %%
def reweigh(before, after, weights, u, C, m, D):
    """Weights of samples that were driven by drives from other Gaussians.

    before, after : (n, 3) poses;  weights : (n,) positive;  u : (2,), C : (2, 2) of the wheels
    m : (n, 2), D : (n, 2, 2) means and covariances that each sample's drive was drawn with
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
# ## 5 · Found again
#
# A robot drives in a room of 10 m by 8 m, whose middle is the origin. In every step it sees *one* of six posts, and knows
# which, with the noise $R$. But one sighting in ten is false: its range is then any number from 0 to 10 m, and its
# bearing any angle. Once in a drive of thirty steps, nobody knows when, somebody lifts the robot and sets it down at
# least three metres away, somewhere in the room, looking in any direction.
#
# At the beginning the cloud is where the robot is. Your `localise` follows it well until the robot is carried off. The
# lesson threw strangers anywhere in the room. But here a stranger must hit three numbers, there are only 300 samples, and one
# sighting tells two of the numbers.

# %%
ask(
    "ex11-odd",
    "All samples agree, and expect a post at 5 m. It is seen at 3 m. **Which is likelier: that this "
    "sighting is false, or that somebody has carried the robot off just now?**",
    {
        "a false sighting, about three times": "one sighting in ten is false, and one step in thirty is a kidnapping. In either case the post "
        "may be seen almost anywhere.",
        "a kidnapping: true sightings are never 2 m off": "true ones are not. But one sighting in ten is not true.",
        "both are as likely": "one step in thirty is a kidnapping. How many sightings in thirty are false?",
    },
    right="a false sighting, about three times",
)

# %% [markdown]
# And if the next post is odd, too? From which poses could the first sighting have been made? If you draw some of these
# poses, with which density do you draw them (task 4)?
#
# **Your task.** Write a step that finds the robot again soon, and that false sightings do not lead astray. Any method
# will do. It gets as many samples as it must return, with weights that are not negative, and all that it knows of the
# past is in them: sixteen robots drive in turn. Each is scored by how far its samples are from it on average, each sample
# counted by its weight. The check stops after 10 s.

# %%
ROOM, REACH, GHOSTS = np.array([10.0, 8.0]), 10.0, 0.1


# %%
def find_again(rows, weights, u, C, p, z, R, rng):
    """One step: drive u with noise C, see the post p at z with noise R, if it is no ghost.

    rows : (n, 3);  weights : (n,);  u : (2,);  C : (2, 2);  p, z : (1, 2);  R : (2, 2)
    returns rows (n, 3), weights (n,)
    """
    ### BEGIN SOLUTION
    n, carried = len(rows), 0.01
    rows = move(rows, u, C, rng)
    # strangers: all poses that could have made this sighting, on a ring round the post
    r, beta = rng.multivariate_normal(z[0], R, n).T
    angle = rng.uniform(-np.pi, np.pi, n)
    x, y = p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle)
    strangers = np.column_stack([x, y, wrap(angle + np.pi - beta)])
    inside = np.all(np.abs(strangers[:, :2]) < ROOM / 2, axis=1)
    # on the ring the density of drawing is the likelihood / (2π r); anywhere, it is 1 / (area · 2π)
    real = np.exp(log_likelihoods(rows, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    seen = (1 - GHOSTS) * real + GHOSTS / (REACH * 2 * np.pi)
    odd = (1 - GHOSTS) * inside * np.abs(r) / np.prod(ROOM) / n
    together = np.concatenate([(1 - carried) * weights * seen, carried * odd])
    picked = draw(together / np.sum(together), rng)[rng.integers(2) :: 2]
    return np.vstack([rows, strangers])[picked], np.full(n, 1 / n)
    ### END SOLUTION


# %%
check("11-kidnapped")

# %% [markdown]
# In this drive the robot is carried off after step 12. The picture shows how far the samples are from it on average, each
# counted by its weight.


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
    views.show(fig, alt="The error of localise and that of find_again over thirty steps.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other inputs.
#
# **Next:** in lesson [12 · Three filters](../notebooks/12_three_filters.ipynb) samples, boxes and ellipses drive one
# robot.
