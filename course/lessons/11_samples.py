# %% [markdown] slideshow={"slide_type": "slide"}
# # 11 · Samples
#
# **You will be able to** keep a belief as a cloud of samples, derive and run Monte Carlo
# localisation, say which two lines of the thesis' algorithm are wrong and prove it, keep the
# weights from underflowing, draw with little noise, and build a map from sets of samples, knowing
# what they forget.
#
# **90 minutes** (55 for localisation, 35 for maps). **Before:** lesson 03 for Bayes and Kalman,
# lesson 05 for the known map; lesson 07 for what a correlation is worth.
#
# Source: MAK thesis, section 5.3.
#
# *Key:* a Gaussian has one hill. A cloud has as many as you have samples for.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Two lectures. The first ends with the kidnapped robot; its heart is the run
# against the Kalman filter, where the printed algorithm fails by exactly a factor of two. The
# second is the thesis' own idea, sets with random partners: let the class say what is lost before
# the table says it.

# %% slideshow={"slide_type": "skip"}
from functools import partial
from time import process_time

import numpy as np
import sympy as sp

from slamlab import models, views
from slamlab.estimators import MakSlam
from slamlab.estimators.montecarlo_slam import fastslam, montecarlo
from slamlab.evaluation import absolute_error, nees
from slamlab.filters import linear_kalman
from slamlab.filters.montecarlo import likelihood
from slamlab.filters.montecarlo.particles import uniform
from slamlab.filters import MCL
from slamlab.filters.montecarlo.motion_sampling import sample_motion
from slamlab.filters.montecarlo.resampling import multinomial, systematic
from slamlab.filters.montecarlo.weights import effective_sample_size, normalise
from slamlab.geometry import compose, wrap
from slamlab.models import RobotModel
from slamlab.layers import Ellipses, Points, Poses, Samples, Segments
from slamlab.simulation import arc
from slamlab.sources.landmark_runs import LandmarkRun, Loop

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Which corner is that?
#
# A room, 6 m by 4 m, with a robot in it that does not know where it is. It has a map: four corners
# and a post. It sees corners, and they all look alike; the post it recognises no better, and only
# from near by.
#
# **Question.** After a few looks round, where may the robot be? **Predict**, and say what an ellipse
# would look like that holds your answer.

# %% slideshow={"slide_type": "fragment"}
CORNERS, POST = np.array([[3, 2], [-3, 2], [-3, -2], [3, -2]]), np.array([[1.6, 0.7]])
MAP = np.vstack([CORNERS, POST])
WALLS = Segments("walls", np.hstack([CORNERS, np.roll(CORNERS, -1, axis=0)]))
R = np.diag([0.3, np.radians(15)]) ** 2
WHEELS = RobotModel(distance_error=0.1, turn_error=0.1, turn_per_metre=0.1)
STEP = arc(0.10, 0.15, 0.75)  # 12 cm on, a little to the left


def look(truth, rng, reach=1.2):
    """Ranges and bearings of what is seen, without names."""
    seen = MAP if models.h(truth, POST)[0, 0] < reach else CORNERS
    return models.h(truth, seen) + rng.multivariate_normal([0, 0], R, len(seen))


# %% [markdown] slideshow={"slide_type": "fragment"}
# 20 000 guesses, all over the room and in all directions. Every guess drives as the robot does,
# and is kept or dropped by how well it explains what is seen. How that is done is this lesson's
# business; first watch it.


# %% slideshow={"slide_type": "fragment"}
def watch(steps, n, seed, strangers=0, carried=None, reach=1.2):
    """A film: the cloud and the true pose after every step."""
    rng, truth = np.random.default_rng(seed), np.array([-1.8, -1.2, -0.3])
    mcl = MCL(uniform(n, [-3, -2], [3, 2], rng), MAP, rng)
    film = [(mcl.cloud, truth)]
    for k in range(steps):
        if k == carried:
            truth = np.array([-1.5, 1.2, -2.0])
        truth = sample_motion(truth[None], STEP, WHEELS, rng)[0]
        mcl.predict(STEP, WHEELS)
        mcl.update(look(truth, rng, reach), R)
        if strangers:
            mcl.insert(uniform(strangers, [-3, -2], [3, 2], rng))
        film.append((mcl.cloud, truth))
    return film


film = watch(36, 20_000, seed=5)


# %% slideshow={"slide_type": "slide"}
def frame(step):
    cloud, truth = film[step]
    some = Samples("sample", cloud.rows[::12], cloud.weights[::12])  # enough to see
    mean = Ellipses("a Gaussian", [cloud.moments.x[:2]], [cloud.moments.P[:2, :2]])
    fig, ax = views.axes(f"After {step} steps", size=(7.4, 4.4))
    for layer, style in (
        (WALLS, {}),
        (Points("landmark", MAP), {"markersize": 10, "label": "corners, post"}),
        (some, {}),
        (mean, {"color": views.COLOURS["naive"], "linestyle": "dashed"}),
        (Poses("truth", truth), {}),
    ):
        views.draw(ax, layer, **style)
    views.legend(ax, loc="upper left", bbox_to_anchor=(1, 1))
    return fig


views.explore(
    frame,
    "Two clusters of samples, one round the true robot, one at the opposite place of the room; one "
    "large ellipse round both has its middle where nobody is.",
    play="step",
    step=(0, len(film) - 1, 9),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** two clusters. Turn the room by half a turn and its corners lie on one another: no number
# of looks at corners can tell the two places apart. The ellipse says what a Gaussian can say of
# this: "in the middle, give or take the room". Nobody is in the middle.
#
# Press ▶: near step 24 the robot comes within sight of the post. There is one on its side of the
# room only, and one of the clusters dies.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print("step   near the truth   near its mirror   in the middle")
for step in (0, 3, 9, 36):
    cloud, truth = film[step]
    places = truth[:2], -truth[:2], cloud.moments.x[:2]
    near = [np.hypot(*(cloud.rows[:, :2] - place).T) < 0.8 for place in places]
    print(f"{step:3}", *(f"{cloud.weights[rows].sum():15.0%}" for rows in near))

# %% [markdown] slideshow={"slide_type": "fragment"}
# A question to a belief is a sum over samples: *how likely is the robot within 0.8 m of here?* Add
# the weights of those that are.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what the EKF of lesson 05 would do here. It would have to start somewhere:
# in the right half it finds the robot, in the other it finds the mirror image, with the same small
# ellipse.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## To predict, drive
#
# Lesson 04 carried a covariance through f by its Jacobian. A cloud needs no Jacobian: drive every
# sample, *each with its own* draw of the wheels' noise.
#
# **Predict:** a heading known to 0.5 rad only, 3 m ahead. What shape has the cloud?

# %% slideshow={"slide_type": "fragment"}
rng = np.random.default_rng(11)
start = rng.normal(0, [0.05, 0.05, 0.5], (1500, 3))
ends = sample_motion(start, [3.0, 0, 0], RobotModel(distance_error=0.02), rng)
A = np.array([[1, 0, 0], [0, 1, 3.0], [0, 0, 1]])
P = A @ np.diag([0.05, 0.05, 0.5]) ** 2 @ A.T + np.diag([0.06, 0, 0]) ** 2
title = "3 m with a heading in doubt"
fig, ax = views.cloud(ends, {"its own covariance": np.cov(ends.T)}, title, size=(5.2, 4.4))
views.draw(ax, Ellipses("A P Aᵀ + Q", [[3.0, 0]], [P[:2, :2]]), color=views.COLOURS["naive"])
views.legend(ax, loc="lower left")
views.show(fig, "A cloud bent to a banana; the linearised ellipse is a straight upright line.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** a banana. The EKF's ellipse stands upright at a place where the robot is hardly ever: it
# is the banana's tangent. The cloud is right without any mathematics, if it has samples enough.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Bayes, for two places
#
# What do we do to the samples when something is seen? Derive it where one can write everything
# down: a robot in one of two rooms, a or b. Three things are given: what is believed before, how it
# moves, how likely it sees what it saw.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
before = dict(zip("ab", sp.symbols("Bel_a Bel_b", positive=True), strict=True))
goes = {old + new: sp.Symbol(f"p_{old}{new}", positive=True) for old in "ab" for new in "ab"}
sees = dict(zip("ab", sp.symbols("l_a l_b", positive=True), strict=True))
joint = {old + new: before[old] * goes[old + new] * sees[new] for old in "ab" for new in "ab"}
joint["ab"]

# %% [markdown] slideshow={"slide_type": "fragment"}
# That is the probability that it *was* in a, *went* to b, and *saw* z there. It did see z: so divide
# by the sum of all four stories, and add up those that end in b.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Bel_b = (joint["ab"] + joint["bb"]) / sum(joint.values())
k = 1 / sum(joint.values())
sp.factor(Bel_b / k)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Read it from right to left: move what was believed (the sum in brackets), then weigh by the
# likelihood. With places in between, the sum becomes an integral, and this is the thesis' (5.1):
#
# $$\operatorname{Bel}(x_t) = k\; p(z_t \mid x_t) \int p(x_t \mid x_{t-1}, u_{t-1})\,
# \operatorname{Bel}(x_{t-1})\, dx_{t-1}$$
#
# (The Bayes formula above it in the thesis has y with index t−1 on its left side: it must be t+1,
# the observation just made. The index may be lost in printing.)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The weight
#
# We *have* samples of the integral: draw one of Bel(x_{t−1}), move it with noise. We *want* samples
# of the left side. A sample drawn from q, where p is wanted, must count p/q times:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x = sp.Symbol("x")
predicted, likely, k = sp.Function("pred")(x), sp.Function("p_z")(x), sp.Symbol("k")
wanted, drawn_from = k * likely * predicted, predicted
sp.simplify(wanted / drawn_from)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **The weight is the likelihood p(z | x), and nothing else.** The motion is in the samples already:
# where the robot is likely to go, there are many of them. The constant k falls out when the weights
# are made to sum to one.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The algorithm as printed
#
# The thesis' algorithm 1, in our words, for every sample:
#
# 1. choose the sample **with the largest weight**,
# 2. compute its new place, **and p(x_t | x_{t−1}, u)**,
# 3. compute p(z_t | x_t),
# 4. compute Bel(x_t), **that is, from both**; at the end normalise.
#
# Its own explanation says "by its weight", not "the largest". Two errata, then, by our derivation.
# But who is right is not a matter of taste: on a rail, with Gaussian noise, the Kalman filter is
# *exact*.
#
# **Predict** for each of the two: will the belief be too wide, too narrow, or off?

# %% slideshow={"slide_type": "fragment"}
Q, R_1 = 0.04, 0.25  # variances of a step of 1 m on a rail, and of a measured place [m²]


def algorithm_1(zs, rng, n, rule="mended"):
    """Mean and variance of the cloud after the measurements zs."""
    x, w = rng.normal(0, 1, n), np.full(n, 1 / n)
    for z in zs:
        chosen = np.full(n, x[w.argmax()]) if rule == "largest" else rng.choice(x, n, p=w)
        x = chosen + 1 + rng.normal(0, np.sqrt(Q), n)
        w = np.exp(-((z - x) ** 2) / (2 * R_1))
        if rule == "motion in the weight":
            w *= np.exp(-((x - chosen - 1) ** 2) / (2 * Q))
        w /= w.sum()
    return w @ x, w @ (x - w @ x) ** 2


# %% slideshow={"slide_type": "fragment"}
def kalman(zs, Q):
    """The same by the filter of lesson 03."""
    b, I = linear_kalman.belief([0], [[1]]), np.eye(1)
    for z in zs:
        b = linear_kalman.predict(b, I, I * Q, I, [1])
        b, _ = linear_kalman.update(b, [z], I, I * R_1)
    return b.x[0], b.P[0, 0]


def rail(seed, steps=12):
    """The true last place and the measurements on the way."""
    rng = np.random.default_rng(seed)
    truth = rng.normal(0, 1) + np.cumsum(1 + rng.normal(0, np.sqrt(Q), steps))
    return truth[-1], truth + rng.normal(0, np.sqrt(R_1), steps)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
_, zs = rail(1)
rules = ("mended", "motion in the weight", "largest")
for rule in rules:
    mean, variance = algorithm_1(zs, np.random.default_rng(2), 20_000, rule)
    print(f"{rule:22} {mean:6.2f} m ± {np.sqrt(variance):.2f} m")
for name, noise in (("Kalman", Q), ("Kalman with Q/2", Q / 2)):
    mean, variance = kalman(zs, noise)
    print(f"{name:22} {mean:6.2f} m ± {np.sqrt(variance):.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the mended algorithm is the Kalman filter. With p(x_t | x_{t−1}, u) in the weight it is a
# Kalman filter *with half the motion noise*, to the centimetre. The largest weight gives something
# else altogether.
#
# Why exactly half? The samples are drawn by that density and then weighed by it once more:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
e, q = sp.symbols("e Q", positive=True)
once = sp.exp(-(e**2) / (2 * q))
sp.simplify(once**2 - once.subs(q, q / 2))

# %% [markdown] slideshow={"slide_type": "fragment"}
# A density squared is the density of half the variance. So the printed filter believes in wheels
# better than they are. And drawing the largest only makes every sample a child of one: whatever else
# was possible is forgotten, each time.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for rule in rules:
    squares = []
    for seed in range(300):
        truth, zs = rail(seed)
        mean, variance = algorithm_1(zs, np.random.default_rng(seed), 400, rule)
        squares.append((mean - truth) ** 2 / variance)
    print(f"{rule:22} NEES {np.mean(squares):.1f} (1 expected)")

# %% [markdown] slideshow={"slide_type": "fragment"}
# 300 runs (lesson 03's test): the mended one is honest, the other two are surer than they may be.
# Half the motion's noise looks harmless in one run; a filter that says so believes old samples more
# than new measurements, in every step.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A likelihood too small for a float
#
# Twenty landmarks, seen to 5 cm and 1°. A likelihood is the product of forty densities. **Question.**
# A sample half a metre off: how large is its weight?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(4)
many, fine = rng.uniform(-8, 8, (20, 2)), np.diag([0.05, np.radians(1)]) ** 2
z = models.h(np.zeros(3), many) + rng.multivariate_normal([0, 0], fine, 20)
off = np.array([[0.5, 0, 0], [0.5002, 0, 0], [0.5, 0, 0.0001]])
logs = likelihood.of_scan(off, many, z, np.tile(fine, (20, 1, 1)))
with np.errstate(invalid="ignore"):
    print("logarithms", logs.round(0), " weights", np.exp(logs) / np.exp(logs).sum())
print("e^-745 =", np.exp(-745.0), "  e^-746 =", np.exp(-746.0))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Below e⁻⁷⁴⁵ a float is zero. If *every* sample is a little off, all weights are zero, and 0/0 is no
# weight. The cloud has not said that it is lost; it has said nothing.
#
# But only ratios matter. Keep the logarithms, and take out the largest before the exponential:
#
# $$w_i = \frac{e^{l_i}}{\sum_j e^{l_j}} = \frac{e^{l_i - \max l}}{\sum_j e^{l_j - \max l}}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
shifted = np.exp(logs - logs.max())
print("weights", (shifted / shifted.sum()).round(6), " slamlab:", normalise(logs)[0].round(6))
print("moved by −100 000:", normalise(logs - 1e5)[0].round(6))

# %% [markdown] slideshow={"slide_type": "fragment"}
# This is called **log-sum-exp**. Three bad samples, but one is a little less bad, and has its weight:
# the cloud can still crawl to the truth.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is the most common bug in particle filters that "work in the simulation":
# with five landmarks it never shows. Ask how many beams a lidar has.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What is a cloud worth?
#
# Weights differ; some samples carry all, others are ballast. The **effective sample size** counts:
#
# $$n_\text{eff} = \frac{1}{\sum w_i^2}$$
#
# n equal weights give n; one weight of 1 gives 1. **Predict:** 500 samples, spread by 0.5 m. They see
# one landmark, the better the sensor the better? Move the slider.


# %% slideshow={"slide_type": "fragment"}
def weighed(sensor):
    rng = np.random.default_rng(6)
    rows = rng.normal(0, [0.5, 0.5, 0.1], (500, 3))
    mark, noise = np.array([[3.0, 1.0]]), np.diag([sensor, 0.05]) ** 2
    logs = likelihood.of_scan(rows, mark, models.h(np.zeros(3), mark), noise[None])
    weights, _ = normalise(logs)
    worth = f"range to {100 * sensor:.0f} cm: worth {effective_sample_size(weights):.0f} of 500"
    fig, ax = views.axes(worth, size=(5.6, 3.8))
    views.draw(ax, Samples("sample", rows, weights))
    views.draw(ax, Points("landmark", mark), markersize=10)
    views.legend(ax, loc="upper left")
    return fig


views.explore(
    weighed,
    "Samples round the origin, a few of them large, most of them dots: a handful carries all.",
    sensor=(0.01, 0.5, 0.03),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** a dot's area is its weight. With a range good to 3 cm a thin arc of samples is left, the
# rest is ballast. Move right: a *worse* sensor leaves more samples in play. A sensor that is much
# finer than the samples are dense starves the cloud; that is a limit of samples, not of the sensor.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Drawing anew: tickets or a comb
#
# Ballast is replaced by copies of what is likely: draw n samples, each with probability w_i. Two
# ways to draw:
#
# - **tickets** (multinomial): n random numbers, each picks where it falls;
# - **a comb** (systematic, low-variance): *one* random number, and n teeth 1/n apart.

# %% slideshow={"slide_type": "fragment"}
w = np.array([0.28, 0.05, 0.17, 0.02, 0.12, 0.21, 0.04, 0.11])
rng = np.random.default_rng(3)
tickets, u = np.sort(rng.random(8)), rng.random()
picks = {"comb": (u + np.arange(8)) / 8, "tickets": tickets}
fig, _ = views.wheel(w, picks, "Eight draws by eight weights")
views.show(fig, "A rod of eight weights; a comb's teeth stand evenly on it, tickets in heaps.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** each needle picks the piece below it. The comb cannot miss a piece longer than 1/8, and
# gives each n·w copies, rounded up or down. Tickets heap up by chance, and leave out what they
# should not.
#
# **Predict:** both give sample 0 on average 8 · 0.28 = 2.24 copies. How far does either stray?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, draw in (("tickets", multinomial), ("comb", systematic)):
    copies = [np.bincount(draw(w, 8, np.random.default_rng(s)), minlength=8) for s in range(4000)]
    mean, variance = np.mean(copies, axis=0)[0], np.var(copies, axis=0)[0]
    print(f"{name:8} copies of sample 0: mean {mean:.2f}, variance {variance:.2f}")
print(f"by hand:  n w (1 − w) = {8 * 0.28 * 0.72:.2f};  2 or 3 copies: {0.24 * 0.76:.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Both are fair; the comb adds a ninth of the noise. And every draw loses samples for good, so draw
# only when it pays: when n_eff falls below n/2.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## All of it
#
# Twelve lines. The film at the start was made by these, and nothing else but speed.


# %% slideshow={"slide_type": "fragment"}
def localise(rows, weights, odometry, p, z, R, rng):
    """One step in a known map, landmark p[j] being seen at z[j]."""
    rows = sample_motion(rows, odometry, WHEELS, rng)
    logs = np.log(weights)
    for place, one in zip(p, z, strict=True):
        v = one - models.h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    weights = np.exp(logs - logs.max())
    weights /= weights.sum()
    if effective_sample_size(weights) < len(rows) / 2:
        rows = rows[systematic(weights, len(rows), rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng, truth = np.random.default_rng(8), np.array([-1.8, -1.2, -0.3])
rows, weights = uniform(5000, [-3, -2], [3, 2], rng).rows, np.full(5000, 1 / 5000)
for _ in range(10):
    truth = compose(truth, STEP)
    z = models.h(truth, CORNERS) + rng.multivariate_normal([0, 0], R, 4)
    rows, weights = localise(rows, weights, STEP, CORNERS, z, R, rng)
error = np.hypot(*(weights @ rows[:, :2] - truth[:2]))
print(f"corners with names, 10 steps: {100 * error:.0f} cm off")

# %% [markdown] slideshow={"slide_type": "fragment"}
# With names there is one cluster only. In the film there were none: then a sample's likelihood is
# the *mean* over all landmarks that it may have been. Each sample has its own opinion of which
# corner it sees; the wrong opinions die with their samples. No association is ever decided.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The kidnapped robot
#
# At step 25 somebody lifts the robot and puts it elsewhere. **Predict:** what becomes of the cloud?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A good place to stop after the first lecture. Homework question: would you add
# strangers if you knew that nobody carries robots? (They also repair a wrong start.)

# %% slideshow={"slide_type": "fragment"}
errors = {}
for name, strangers in (("500 samples", 0), ("450 and 50 strangers", 50)):
    film_2 = watch(60, 500, seed=2, strangers=strangers, carried=25, reach=9.0)
    errors[name] = [np.hypot(*(cloud.moments.x - truth)[:2]) for cloud, truth in film_2]
title = "Carried off at step 25"
fig, ax = views.curves(np.arange(61), errors, "step", "error [m]", title, size=(6, 3.2))
views.show(
    fig, "Without strangers the error stays above two metres; with them it falls within ten steps."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** no sample is left where the robot now is, and copies of samples elsewhere never get there.
# A cloud that has made up its mind cannot change it: **impoverishment**. The cure costs a tenth of
# the samples: in every step 50 of them are thrown anywhere, in case. One of these soon explains what
# is seen much better than all the others, and has many children.
#
# The same happens slowly to a robot that stands still. Each drawing loses samples; nothing makes new
# ones:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(9)
rows, weights = rng.normal(0, [0.3, 0.3, 0.1], (1000, 3)), np.full(1000, 1e-3)
still, left = np.zeros(3), []
for _ in range(60):
    z = models.h(np.zeros(3), CORNERS) + rng.multivariate_normal([0, 0], R, 4)
    rows, weights = localise(rows, weights, still, CORNERS, z, R, rng)
    left.append(len(np.unique(rows, axis=0)))
print("different samples after 1, 5, 20, 60 looks:", [left[k - 1] for k in (1, 5, 20, 60)])

# %% [markdown] slideshow={"slide_type": "slide"}
# ## And the map?
#
# SLAM asks for the landmarks, too. **Question.** Why not samples of the whole state, pose and N
# landmarks? Say each of its 3 + 2N numbers needs ten values to be covered:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for N in (0, 1, 3, 10):
    print(f"{N:2} landmarks: 10^{3 + 2 * N} samples")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The thesis' way out, **algorithm 2**: *one set for the robot, one for each object.* 1000 samples
# and 300 for each object, whatever N. But the robot's set is weighed by where object 4 is, which
# nobody knows; and that of object 4 by where the robot is. So: **whenever a place of another is
# needed, take a random sample of its set.**


# %% slideshow={"slide_type": "fragment"}
def weigh_object(places, poses, z, R, rng):
    """Log weights of an object's samples: each has a random pose for partner."""
    partners = poses[rng.integers(len(poses), size=len(places))]
    v = z - models.h(partners, places)
    v[:, 1] = wrap(v[:, 1])
    return -0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)


# %% [markdown] slideshow={"slide_type": "fragment"}
# What the thesis leaves open is our choice, and `slamlab`'s docstrings say so: a new object's samples
# stand where random poses would have seen it; each sample has ten partners, not one (less noise);
# sets that are not seen are left alone; a set that was drawn anew without moving is shaken in a way
# that keeps its mean and covariance.

# %% slideshow={"slide_type": "fragment"}
LAP = Loop(landmarks=10, steps=100, range_max=3.0, v_sigma=0.03, omega_sigma=0.02)
lap = LandmarkRun(LAP, np.random.default_rng(12))
TRUE_OBJECTS = Points("truth", lap.landmarks)
slam, frames = montecarlo(lap), []
for k, reading in enumerate(lap):
    slam.step(reading)
    if k % 4 == 0:
        frames.append((k, slam.layers()))


# %% slideshow={"slide_type": "slide"}
def sets(picture):
    k, (objects, frozen, way, robot) = frames[picture]
    fig, ax = views.axes(f"After {k} readings", size=(7, 5.2))
    for layer, style in (
        (Poses("truth", lap.truth.poses[: k + 1]), {}),
        (objects, {"color": views.COLOURS["sample"], "label": "sets of objects"}),
        (robot, {"color": views.COLOURS["scan"], "label": "set of the robot"}),
        (frozen, {"markersize": 9, "label": "frozen objects"}),
        (way, {"label": "mean of the robot's set"}),
        (TRUE_OBJECTS, {"label": "true objects", "marker": "+", "markersize": 11, "mew": 1.5}),
    ):
        views.draw(ax, layer, **style)
    ax.set(xlim=(-7, 7), ylim=(-3, 11), adjustable="box")
    views.legend(ax, loc="upper left", bbox_to_anchor=(1, 1))
    return fig


views.explore(
    sets,
    "The robot half way round its loop; small clouds of samples, one for each object, those seen "
    "last beside the crosses of the true objects; the estimated way beside the true one.",
    play="picture",
    picture=(0, len(frames) - 1, 13),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** each object is a cloud, born as wide as the robot's doubt and the sensor's, and shrinking
# while it is seen. The robot's orange cloud hardly grows.
#
# Too good? Look where the crosses lie, and press ▶: the clouds late on the way have shrunk *beside*
# them, and the blue way leaves the black one. (The green dots at the end are "frozen": soon.)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What do the sets forget?
#
# Lesson 07: two estimates that one sighting corrects share its error, and P_ri says so. **Predict:**
# where is P_ri in a set for the robot and a set for the object? What did lesson 07's filter do when
# it was dropped?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(13)
poses = rng.normal(0, [0.3, 0.3, 0.0], (5000, 3))
seen = models.g(poses, np.tile([2.0, 0.0], (5000, 1)) + rng.normal(0, [0.05, 0.02], (5000, 2)))
shuffled = rng.permutation(seen)
for name, places in (("pairs as they were made", seen), ("random partners", shuffled)):
    ranges = models.h(poses, places)[:, 0]
    print(f"{name:24} correlation {np.corrcoef(poses[:, 0], places[:, 0])[0, 1]:5.2f}", end="")
    print(f"   range between the two {ranges.mean():.2f} ± {ranges.std():.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"}
# A random partner is a *wrong* partner: the robot 30 cm to the left is asked about the object that
# the robot 30 cm to the right had seen. What was known to 5 cm, the range between the two, is now
# known to 40 cm. Each set alone is as before. Only *together* they knew more.
#
# And then the sets learn from each other, as if they had never met, again with every reading:

# %% slideshow={"slide_type": "fragment"}
HAIR = 1e-8 * np.eye(3)  # a cloud of equal samples has no width at all
DRIVES = [LandmarkRun(LAP, np.random.default_rng(seed)) for seed in range(12)]


def judged(make):
    """Root mean square error of the pose [m], its NEES (median), and CPU time a reading [ms]."""
    errors, values, start = [], [], process_time()
    for drive in DRIVES:
        slam = make(drive)
        for k, reading in enumerate(drive):
            slam.step(reading)
            if k % 10 == 9:
                b = pose_belief(slam.filter)
                off = b.x - drive.truth.poses[k]
                off[2] = wrap(off[2])
                values.append(nees(off, b.P + HAIR))
        errors.append(absolute_error(slam.trajectory(), drive.truth).translation)
    ms = 1e3 * (process_time() - start) / (len(DRIVES) * len(lap))
    return np.sqrt(np.mean(np.square(errors))), np.median(values), ms


# %% slideshow={"slide_type": "fragment"}
def pose_belief(filter):
    """What a filter believes of the pose: a Gaussian, or its cloud's mean and covariance."""
    if hasattr(filter, "robot"):
        return filter.robot.moments
    return linear_kalman.Belief(filter.pose, filter.blocks()[0])


found = {
    "EKF": judged(lambda drive: MakSlam(drive.robot, drive.sensor)),
    "sets": judged(partial(montecarlo, close=0)),
    "sets, one partner": judged(partial(montecarlo, close=0, partners=1)),
}

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, (error, value, _) in found.items():
    print(f"{name:18} error {100 * error:3.0f} cm   NEES, median {value:5.1f} (2.4 expected)")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the sets' error is not much larger than the EKF's; the thesis found them coarser, and so
# they are. But what they *say* of their error is wrong by far: lesson 07's filter without cross
# terms, once more. Nothing here is a fault of samples; it is the price of keeping sets apart.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Objects that nobody looks at
#
# The thesis: estimates of objects that are long out of sight "tend to move away from their true
# position". **Question.** Why should they? Nothing is learned of them. What does algorithm 2 do to
# *every* set, in *every* step?
#
# It draws anew. Draw 300 times from 300 equal samples, by tickets:

# %% slideshow={"slide_type": "fragment"}
rng, n, steps, sigma = np.random.default_rng(14), 300, 300, 0.1
moves, widths = np.zeros((200, steps)), np.zeros((200, steps))
for k, walk in enumerate(moves):
    places = rng.normal(0, sigma, (n, 2))
    first = places.mean(axis=0)
    for t in range(steps):
        places = places[multinomial(np.full(n, 1 / n), n, rng)]
        walk[t], widths[k, t] = np.sum((places.mean(axis=0) - first) ** 2), places.var()
kept = (1 - 1 / n) ** np.arange(1, steps + 1)  # share of the variance that is left, by theory

# %% slideshow={"slide_type": "fragment"}
lines = {
    "how far the mean has walked": np.sqrt(moves.mean(axis=0)),
    "by theory": np.sqrt(2 * sigma**2 * (1 - kept)),
    "what the set believes of its error": np.sqrt(2 * widths.mean(axis=0)),
}
title = "An object out of sight, drawn anew each step"
fig, _ = views.curves(np.arange(steps), lines, "step", "[m]", title, size=(6.2, 3.4))
views.show(fig, "The set's mean walks off while its width falls; theory and samples agree.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** without any news the mean walks away, and the set grows *surer*. Fair draws are fair on
# average only; a random walk is fair on average, too. (Geneticists know it: drift in small
# populations.) Each draw takes 1/n of the variance and turns it into error.
#
# Two cures. A comb over equal weights gives each sample back, once: no walk at all. And `slamlab`
# leaves unseen sets alone. The thesis' own cure is the next one.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Stabilisation
#
# *When all samples of an object lie close together, call their place right and calculate with it
# from then on.* The object is a point: nothing to draw, nothing to drift, less to compute.
#
# **Predict** what happens when "close" is large.

# %% slideshow={"slide_type": "fragment"}
frozen = {close: judged(partial(montecarlo, close=close)) for close in (0.1, 0.3, 0.8)}

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print(f"never frozen:     error {100 * found['sets'][0]:3.0f} cm, NEES {found['sets'][1]:6.1f}")
for close, (error, value, _) in frozen.items():
    print(f"closer than {close:.1f} m: error {100 * error:3.0f} cm, NEES {value:6.1f}")

# %% slideshow={"slide_type": "fragment"}
for name, ms in {"never": found["sets"][2], **{c: v[2] for c, v in frozen.items()}}.items():
    print(f"frozen at {name}: {ms:.1f} ms a reading")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** frozen early, an object keeps for ever the error it had then, and the robot learns it:
# error and NEES rise. Frozen late it costs nothing, and saves time. Which is which depends on how
# good the sensor is; the thesis gives no number, and ours is 5 cm.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Look ahead: samples where they are needed
#
# Lesson 05: when the robot's poses are *known*, its landmarks are independent of one another, a
# little Kalman filter each. Now look at one sample. It is a *way*, a guess of all poses. **Given the
# way**, the landmarks are independent: no cross terms are missing, because there are none.
#
# So: samples of the way; and **each sample has its own map** of little filters. What the samples
# share, and where they differ, *is* the correlation. (Rao and Blackwell: what can be computed need
# not be drawn. The filter is called FastSLAM.)

# %% slideshow={"slide_type": "fragment"}
found["FastSLAM, 100"] = judged(partial(fastslam, samples=100))
found["FastSLAM, 1000"] = judged(partial(fastslam, samples=1000))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, (error, value, _) in found.items():
    print(f"{name:18} error {100 * error:3.0f} cm   NEES, median {value:5.1f} (2.4 expected)")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** with 1000 samples NEES comes near to what it should be: the correlations are back. With
# 100 it runs out of ways: each draw leaves fewer first halves, and a loop that closes can only
# choose among the few that are left. Impoverishment again, and the reason for better versions
# (draw the pose with a look at the measurement first).

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What you can do now
#
# | | |
# |---|---|
# | predict | drive every sample, each with its own noise |
# | weigh | by the likelihood alone; logarithms; take out the largest; normalise |
# | draw | by weight, with a comb, when n_eff < n/2 |
# | samples are good at | bananas, two clusters, names unknown |
# | and bad at | fine sensors, many dimensions, changing their mind |
# | sets with random partners | cheap, not much worse, and far too sure |
#
# **Next:** in [12 · Three filters, one robot](12_three_filters.ipynb) boxes, ellipses and samples
# drive the same robot.
#
# **Exercise:** [samples](../exercises/ex11_samples.ipynb).
