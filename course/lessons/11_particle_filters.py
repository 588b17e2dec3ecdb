# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 11 · Particle filters
#
# **You will be able to** represent a posterior by a set of particles; derive how particles are moved,
# weighted and resampled; localise a robot whose initial pose is unknown; state how many particles are
# necessary, and which errors occur with too few; and build maps with particles.
#
# **90 minutes**, in two parts: localisation (58) and SLAM (32). **Before:** lesson
# [03](03_kalman_filter.ipynb) for the Kalman filter, lesson [05](05_localisation_and_mapping.ipynb) for the known map; for
# part two, lesson [07](07_correlations.ipynb).
#
# *Key:* a Gaussian has one mode. A particle set can represent several modes if it has enough particles
# for each of them.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The lesson needs two lectures. The main result of the first is that a particle set
# can lose a mode by chance. Return to this result when landmarks drift in part two, because the cause
# is the same. If time is short, leave out "Log-likelihoods against underflow" and "The Bayes filter".
# For a poll, use the questions on the corners, on fewer particles, on the unlikely motion, on the
# better sensor, and on the landmark that is out of view. A program with a wrong weight still runs: ask
# how one can detect such an error. One has to compare the result with a filter that is known to be
# exact.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from functools import cache

import numpy as np
import sympy as sp
from scipy.ndimage import distance_transform_edt, map_coordinates
from scipy.stats import binom, norm

from classroom.checks import ask, compare
from course.studies import particle_filter_1d as rail
from course.studies import independent_particle_sets as sets
from course.studies.global_localisation import CORNERS, HIGH, LOW, MAP, POST, START, STEP, WALLS
from course.studies.global_localisation import WHEELS, R, evidence, film, look, near
from course.studies.paired_statistics import percent, share_interval
from course.studies.study_command import stored
from slamlab import models, views
from slamlab.estimators.landmark_observations import observed_landmarks
from slamlab.estimators.particle_filter_slam import montecarlo
from slamlab.filters import MCL
from slamlab.filters.particle_filters import likelihood
from slamlab.filters.particle_filters.fastslam import FastSLAM
from slamlab.filters.particle_filters.motion_sampling import sample_motion
from slamlab.filters.particle_filters.particle_set import ParticleSet, uniform
from slamlab.filters.particle_filters.resampling import multinomial, systematic, systematic_at
from slamlab.filters.particle_filters.importance_weights import effective_sample_size, normalise
from slamlab.geometry import compose, transform
from slamlab.layers import Ellipses, Points, Poses, Particles
from slamlab.models import RobotModel
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import Scanner

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Global localisation: a multimodal posterior
#
# A robot stands in a room of 6 m by 4 m, and its position is unknown. The robot has a map with four
# corners and a post, and measures the ranges and bearings of the four corners, which all look alike.
# The post looks like a corner, but the sensor can observe it only at close range.
#
# The robot repeatedly drives a short distance and measures again.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-where",
    "The robot has observed the four corners a few times, and has not come near the post. **Where can it be?**",
    {
        "at one place: four distances determine it": "they would determine it if we knew which "
        "distance belongs to which corner.",
        "at two places": "a rotation of the room by 180° maps its corners onto each other. The "
        "measurements are the same from both places, as long as the post is out of range from "
        "both.",
        "at four places, one for each corner": "the room is longer than it is wide: a rotation by 90° does not "
        "map it onto itself.",
        "anywhere": "the distances to four corners exclude nearly the whole room.",
    },
    right="at two places",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-where"
# So the posterior is **multimodal**: its density has two maxima, its **modes**. A Gaussian has only one
# mode. We represent the posterior by a **particle set**. Each **particle** (also *sample* or
# *hypothesis*) is one possible pose, with a weight.
#
# Finding the pose without any initial estimate is called **global localisation**. We begin with 10 000
# particles in the whole room, with headings in all directions. Each particle moves like the robot.
# Particles that agree with the measurements are copied; the other particles are dropped. This part
# derives these steps of a **particle filter**. First we look at its result.


# %% slideshow={"slide_type": "subslide"} answers="11-where" tags=["folded"]
def scene(particles, truth, title):
    """The room, at most 1500 of the particles, and a Gaussian of the same mean and covariance."""
    some, b = slice(None, None, len(particles.rows) // 1500 + 1), particles.moments
    layers = {"walls": WALLS, "corners, post": Points("landmark", MAP)}
    layers["particles"] = Particles("sample", particles.rows[some], particles.weights[some])
    layers["a Gaussian, 95 % ellipse"] = Ellipses("naive", [b.x[:2]], [b.P[:2, :2]])
    layers["true robot"] = Poses("truth", truth)
    fig, ax = views.axes(title, size=(9, 5.6))
    for label, layer in layers.items():
        views.draw(ax, layer, label=label)
    ax.set(xlim=(-6.5, 6.5), ylim=(-3.5, 3.5), adjustable="box")  # the same in every step
    views.legend_below(fig)
    return fig


def at_step(particles, step):
    return scene(*run_with(particles)[step], f"{particles} particles after {step} steps")


def long_axis(particles, step):
    """The length of the Gaussian's 95 % ellipse [m]."""
    P = run_with(particles)[step][0].moments.P[:2, :2]
    return 2 * np.sqrt(5.99 * np.linalg.eigvalsh(P)[1])


# the particle set and the true pose after each of 36 steps
run_with = cache(lambda particles: film(particles, seed=2))
trajectory = np.array([truth[:2] for _, truth in run_with(10_000)])
to_post, opposite_to_post = np.hypot(*(np.stack([trajectory, -trajectory]) - POST[0]).T).T
post_seen = np.argmax(to_post < 1.2)  # the first step from which the post is observed

# %% slideshow={"slide_type": "subslide"} answers="11-where"
views.explore(
    at_step,
    lambda particles, step: (
        f"{particles} particles after {step} steps: {100 * near(*run_with(particles)[step]):.0f} % of the weight is near "
        f"the true robot, {100 * near(run_with(particles)[step][0], -run_with(particles)[step][1]):.0f} % near the opposite "
        f"place; the ellipse of one Gaussian is {long_axis(particles, step):.1f} m long."
    ),
    play="step",
    particles=[10_000, 1000, 200, 50],
    step=(0, 36, 4),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-where"
# There are two clusters of particles, one around the robot and one at the opposite place. The ellipse
# shows a Gaussian with the mean and the covariance of the particle set. Its centre is the middle of the
# room, which contains neither the robot nor any particles.
#
# Press ▶. In step {= post_seen =} the robot comes within range of the post. Only one side of the room has
# a post, so one of the clusters disappears.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-where"
# How probable is it that the robot is in some area? With a particle set, such a probability is a sum.
# Add the weights $w_i$ of the particles $x_i$ that are in the area:
#
# $$\Pr(x \text{ in the area}) \;\approx\; \textstyle\sum_i w_i \quad \text{over all } i \text{ with } x_i \text{ in the area.} \tag{11.1}$$
#
# (All $n$ weights add up to one. In the table, *near* means within 0.8 m.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what the EKF of lesson 05 would do here. It needs an initial estimate. If it
# starts near the robot, it tracks the robot; if it starts near the opposite place, it tracks that
# place, and its ellipse is equally small.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="11-where"
print("step   near the robot   near the opposite place   near the mean")
for step in (0, 4, 8, 36):
    particles, truth = run_with(10_000)[step]
    places = truth, -truth, particles.moments.x
    print(f"{step:3}", *(f"{100 * near(particles, place):16.0f} %" for place in places))

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** After 8 steps, how probable is it that the robot is in the left half of the room, where $x < 0$? Use
# `particles.rows`, whose columns are $x, y, \theta$, and `particles.weights`.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
particles, truth = run_with(10_000)[8]
left_half = ...  # a sum of weights, by (11.1)
compare(left_half, np.histogram(particles.rows[:, 0], [-9, 0], weights=particles.weights)[0][0])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# particles, truth = run_with(10_000)[8]
# left_half = particles.weights[particles.rows[:, 0] < 0].sum()
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Too few particles: a mode is lost by chance
#
# Until step {= post_seen =} hardly any measurement distinguishes the two places. The fact that the post
# is *not* observed is no evidence either: the sensor observes it only within 1.2 m, and until then both
# places are farther away. (The opposite place never comes closer than {= opposite_to_post.min():.2f =}
# m.) With 10 000 particles, both modes exist until then. Now we use 200 particles on the same run.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The tempting answer is that the wrong mode disappears. Before the vote, ask
# which measurement so far speaks against it; afterwards compare with drawing balls from an urn and
# putting back copies of those drawn.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-few",
    "**How do the two modes of a set of 200 particles change before the post is observed?**",
    {
        "both remain, with fewer particles each": "no measurement favours one of them. But the "
        "filter chooses the particles to be copied at random, and with few particles chance has "
        "a large effect.",
        "one disappears: the wrong one": "no measurement so far shows which mode is wrong.",
        "one disappears, and chance decides which": "each resampling changes the share of both "
        "modes a little, at random. A mode without particles cannot get any new ones.",
    },
    right="one disappears, and chance decides which",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="11-few"
# 100 sets of 200 particles, after 10 steps
few = [film(200, seed, steps=10)[-1] for seed in range(100)]
at_robot = np.array([near(particles, truth) for particles, truth in few])
opposite = np.array([near(particles, -truth) for particles, truth in few])
counts = sum(at_robot > 0.98), sum(opposite > 0.98), sum(np.minimum(at_robot, opposite) > 0.02)
print(f"{len(few)} sets of 200 particles, after 10 steps:")
print("at the robot only {}, at the opposite place only {}, at both {}".format(*counts))
ratios = np.percentile([evidence(seed, steps=10) for seed in range(100)], [5, 95])

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-few"
# After ten steps, only {= counts[2] =} of the {= len(few) =} sets still have more than 2 % of their
# weight at each of the two places. Of the other sets, {= counts[0] =} have particles only at the
# robot's place, and {= counts[1] =} only at the opposite place. (In the remaining
# {= len(few) - sum(counts) =} sets, some particles are at other places.) *The measurements do not
# favour either place.* In 90 of the 100 runs, the ratio of the likelihoods of all ten scans from the
# two places is between {= ratios[0]:.2f =} and {= ratios[1]:.2f =}. When the post comes into range, a
# set that has lost the correct mode cannot return to it, because it has no particle there.

# %% slideshow={"slide_type": "subslide"} answers="11-few" tags=["folded"]
many = stored("particle_filters")  # the table of a long study
runs = many["runs"]
# the runs with 500 particles in which the set follows the robot until the kidnapping
followed = round(runs * many["injected"]["0"]["followed"][0])
found = many["found"]
rows = {f"{n} particles": share for n, share in found.items()}
fig, _ = views.shares({"found": rows}, f"share of {runs} runs found", size=(8, 4.2))
shown = ", ".join(f"{name} in {100 * share[0]:.0f} %" for name, share in rows.items())
views.show(fig, f"The robot is found with {shown} of the runs; the intervals are wide.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-few"
# The figure shows the results of {= runs =} runs for each number of particles, with 95 % intervals,
# some {= 36 - post_seen =} steps after the post came into range. (*Found*: more than half of the weight
# is within 0.8 m of the robot.) With a few hundred particles the result is nearly random. Return to the
# slider of the first section and choose fewer particles: the only remaining cluster looks equally
# certain.
#
# **How many particles are enough?** A multimodal posterior needs many of them at every mode that must not be lost. (A *Deeper*
# section adapts their number during the run.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Prediction: sampling the motion model
#
# How does a motion change the particles? Lesson 04 propagated an estimate through the motion model $f$
# with its Jacobian. The predicted estimate of the EKF is an ellipse with the centre and the covariance
#
# $$\hat x' = f(\hat x, u), \qquad P' = A P A^{\mathsf T} + Q. \tag{11.2}$$
#
# Particles need no Jacobian. Every particle moves separately, with *its own* random sample of the
# odometry noise. Suppose that the heading of a robot is known only with $\sigma = 0.5$ rad, and that it
# drives 3 m. We move 1500 particles in the same way.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let a few students say where 95 of 100 robots are before they see the picture.
# Then reduce `heading_sigma` to 0.1: the ellipse is nearly right again, so the fault is the size of
# the error and not the Gaussian as such.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-banana",
    "The ellipse (11.2) should contain 95 of 100 robots. **How many does it contain here?**",
    right=50,
    tolerance=12,
    unit="of 100",
    reason="the robots lie along an arc, and the long axis of the ellipse is straight: about "
    "half of the robots are outside.",
    wrong={
        95: "this would be right if the motion were linear. But different headings spread the "
        "robots along an arc.",
        0: "the robots whose heading error is small are in the ellipse, and most of the others "
        "are close to it.",
    },
)


# %% slideshow={"slide_type": "subslide"} answers="11-banana"
# particles after 3 m, and their share in the EKF's ellipse
def after_3_m(heading_sigma, particles):
    """Particles after 3 m, the EKF's covariance, and the share of the particles in its ellipse."""
    rng, sigmas = np.random.default_rng(11), np.array([0.05, 0.05, heading_sigma])
    start = rng.normal(0, sigmas, (particles, 3))
    ends = sample_motion(start, [3.0, 0, 0], RobotModel(0.02, 0, 0), rng)
    A, Q = np.array([[1, 0, 0], [0, 1, 3.0], [0, 0, 1]]), np.diag([0.06, 0, 0]) ** 2
    P = (A @ np.diag(sigmas**2) @ A.T + Q)[:2, :2]
    off = ends[:, :2] - [3.0, 0.0]
    share = np.mean(np.sum(off @ np.linalg.inv(P) * off, axis=1) < 5.99)  # 95 % of a Gaussian
    return ends, P, share


# %% slideshow={"slide_type": "fragment"} answers="11-banana" tags=["folded"]
def banana(heading_sigma, particles):
    ends, P, share = after_3_m(heading_sigma, particles)
    title = f"the EKF's ellipse contains {100 * share:.0f} % of the particles"
    own, mean = np.cov(ends[:, :2].T), ends[:, :2].mean(axis=0)
    layers = {"particles": Points("sample", ends[:, :2])}
    layers["the particles' own covariance, 95 % ellipse"] = Ellipses("corrected", [mean], [own])
    layers["EKF, (11.2), 95 % ellipse"] = Ellipses("naive", [[3, 0]], [P])
    fig, ax = views.axes(title, size=(8, 5.6))
    for label, layer in layers.items():
        views.draw(ax, layer, label=label)
    ax.set(xlim=(-4, 6), ylim=(-4.2, 4.2), adjustable="box")
    views.legend(ax, loc="upper left")
    return fig


share = after_3_m(0.5, 1500)[2]

# %% slideshow={"slide_type": "subslide"} answers="11-banana"
views.explore(
    banana,
    lambda heading_sigma, particles: (
        f"{particles} particles on an arc, for a heading sigma of {heading_sigma:.2f} rad; the EKF's "
        f"ellipse contains {100 * after_3_m(heading_sigma, particles)[2]:.0f} % of them."
    ),
    heading_sigma=(0.02, 1.5, 0.5),
    particles=(10, 3000, 1500),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-banana"
# The particles form an arc (often called a *banana*). The EKF's ellipse touches the arc where the
# heading error is zero, and contains {= 100 * share:.0f =} % of the particles instead of 95 %. Its
# centre, at $x = 3$ m, is the position that the robot reaches with the heading 0. On average it
# advances only {= after_3_m(0.5, 1500)[0][:, 0].mean():.2f =} m, because every heading error shortens
# the path along $x$.
#
# With $\sigma = 0.1$ the ellipse contains {= 100 * after_3_m(0.1, 1500)[2]:.0f =} %, and with 0.05 it
# contains {= 100 * after_3_m(0.05, 1500)[2]:.0f =} %. Now use fewer particles: ten particles do not
# show the shape of the arc. So the particle set approximates the correct shape *if there are enough
# particles*, and the linearised ellipse approximates it *if the heading error is small enough*.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The Bayes filter
#
# How must a measurement change the particles? We derive this for a case that is simple enough to write
# down completely. A robot is in one of two rooms, 1 or 2. Three things are given: the previous belief,
# the probability of each motion, and the likelihood of the measurement in each room. By the Markov
# assumption (lesson 03) the motion depends only on the previous room, and the measurement only on the
# room in which it is made. So the three factors multiply:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* If you keep this section, let the class enumerate the four cases at the board,
# and cover the two that end in room 1. The integral in (11.3) is the same sum.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
before = dict(zip("12", sp.symbols("Bel_1 Bel_2", positive=True), strict=True))
measures = dict(zip("12", sp.symbols("z_1 z_2", positive=True), strict=True))
moves = {pair: sp.Symbol(f"move_{pair}", positive=True) for pair in ("11", "12", "21", "22")}
case = {old + new: before[old] * moves[old + new] * measures[new] for old, new in moves}
total = sp.Symbol("total", positive=True)  # the sum of all four cases
case["12"], sp.factor(case["12"] + case["22"]) / total

# %% [markdown] slideshow={"slide_type": "subslide"}
# The first expression is the probability of one case: the robot *was* in room 1, *moved* to room 2, and
# *measured* $z$ there. There are four cases. We divide by the sum of all four, since the measurement
# $z$ is given, and add up the two cases that end in room 2. The result is the second expression.
#
# The sum in the bracket is the prediction; the factor before it is the likelihood of the measurement.
# If the robot can be anywhere, the sum becomes an integral. The result is the **Bayes filter**:
#
# $$\mathrm{Bel}(x_k) \;\propto\; \Pr(z_k \mid x_k) \int \Pr(x_k \mid x_{k-1}, u_k)\,
# \mathrm{Bel}(x_{k-1})\, dx_{k-1}. \tag{11.3}$$
#
# ($\mathrm{Bel}(x_k)$, the belief, is the posterior density after step $k$, and $\Pr$ of a continuous quantity is its
# density. The omitted factor makes the posterior integrate to one.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=11
# ## Importance sampling
#
# We *have* particles of the integral in (11.3): they are particles of the old posterior, each moved
# with its own noise. We *want* particles of the left side. So we sample from one density $q$, the
# **proposal**, and want the mean of some function $a(x)$ under another density $\pi$, the **target**
# (*proposal distribution* and *target distribution* in full). If we multiply and divide by $q$, the
# mean under $\pi$ becomes a mean under $q$, which $n$ particles $x_i$ from $q$ can estimate:
#
# $$\int a(x)\, \pi(x)\, dx = \int a(x)\, \frac{\pi(x)}{q(x)}\, q(x)\, dx \;\approx\; \frac1n \sum_{i=1}^{n} w_i\, a(x_i), \qquad
# w_i = \frac{\pi(x_i)}{q(x_i)}. \tag{11.4}$$
#
# This method is **importance sampling**, and $w_i$ is the **importance weight**: the target density
# divided by the proposal density. The method requires $q > 0$ wherever $\pi > 0$. If a factor of $\pi$
# is unknown, as in (11.3), divide by $\sum_i w_i$ instead of $n$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Show the four proposals first and the definition afterwards. The narrow proposal
# is the memorable case: all 500 estimates agree, and all are wrong. Most students who answer the
# question on the rare motion wrongly count the motion twice.

# %% [markdown] slideshow={"slide_type": "subslide"}
# How accurate is the estimate? As an example, we estimate the probability that a standard Gaussian
# variable exceeds 3. Let $a(x)$ be 1 where $x > 3$, and 0 elsewhere. We compute 500 estimates from each
# of four proposals, with 1000 particles for each estimate.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def normal(x, mean, sigma):
    return np.exp(-(((x - mean) / sigma) ** 2) / 2) / (np.sqrt(2 * np.pi) * sigma)


def weighted(mean, sigma, size, seed=1):
    """Particles from a Gaussian proposal, and their importance weights for N(0, 1)."""
    x = np.random.default_rng(seed).normal(mean, sigma, size)
    return x, normal(x, 0, 1) / normal(x, mean, sigma)


def mean_square_of(mean, sigma, size):
    x, w = weighted(mean, sigma, size)
    return w @ x**2 / size


def on_a_line(proposal_mean, proposal_sigma):
    x, w = weighted(proposal_mean, proposal_sigma, 60)
    s, title = np.linspace(-5, 5, 200), f"mean {x.mean():.2f}, weighted {w @ x / w.sum():.2f}"
    densities = {"target": normal(s, 0, 1), "proposal": normal(s, proposal_mean, proposal_sigma)}
    fig, ax = views.curves(s, densities, "x [1]", "density, weight [1]", title, size=(8, 4.4))
    ax.vlines(x, 0, 0.8 * w / w.max(), color=views.COLOURS["sample"], label="weights, scaled")
    ax.set(ylim=(0, 1.6))
    views.legend(ax, ncols=3, loc="upper center")
    return fig


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# 500 estimates from each of four proposals
print(f"true: {norm.sf(3):.5f}\nproposal    mean estimate    σ of an estimate   estimates of 0")
error_of = {}
for mean, sigma in ((0, 1), (3, 1), (0, 3), (0, 0.5)):
    x, w = weighted(mean, sigma, (500, 1000))
    estimates = np.mean(w * (x > 3), axis=1)
    error_of[mean, sigma] = estimates.std() / norm.sf(3)
    line = f"N({mean}, {sigma}²)", f"{estimates.mean():.5f}", f"{100 * error_of[mean, sigma]:.0f} %"
    print("{:10} {:>14} {:>18}".format(*line), f"{100 * np.mean(estimates == 0):17.0f} %")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first row samples the target itself. Few particles are beyond 3, and a single estimate has a
# standard deviation of {= 100 * error_of[0, 1]:.0f =} % of the true value. The second proposal is good:
# its particles are where $a(x)\, \pi(x)$ is large, and this reduces the standard deviation to
# {= 100 * error_of[3, 1]:.0f =} %. The wide proposal is less accurate, but it also works. The narrow
# proposal fails: none of its particles is beyond 3, and all its estimates are zero. **Weights correct
# particles that exist. Weights cannot replace missing particles.**

# %% slideshow={"slide_type": "subslide"}
views.explore(
    on_a_line,
    lambda proposal_mean, proposal_sigma: (
        f"Particles from a Gaussian of mean {proposal_mean:.1f} and sigma {proposal_sigma:.1f}, drawn "
        "as bars. The lengths of the bars are proportional to the weights."
    ),
    proposal_mean=(-3.0, 3.0, 1.5),
    proposal_sigma=(0.3, 3.0, 1.5),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The proposal is too far to the right, and the weights correct this: the bars are long where the target
# is higher than the proposal. Make the proposal narrow, and move it to the side: then one or two
# particles have nearly the whole weight, and the weighted mean is unreliable.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** These particles are from the proposal N(1.5, 1.5²). Estimate the mean of $x^2$ under the target N(0, 1). (The
# true value is 1.)

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
x, w = weighted(1.5, 1.5, 10_000)
mean_square = ...  # by (11.4), with a(x) = x²
compare(mean_square, mean_square_of(1.5, 1.5, 10_000))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# x, w = weighted(1.5, 1.5, 10_000)
# mean_square = np.mean(w * x**2)
# ```
#
# </details>

# %% slideshow={"slide_type": "subslide"}
ask(
    "11-weight",
    "Each particle is moved by a sample of the motion model. The measurement is equally likely "
    "from two particles. One particle made a likely motion, the other a motion that the "
    "odometry noise seldom causes. They had equal weights before. **Which weights do they get?**",
    {
        "the one with the rare motion gets less": "rare motions are sampled rarely. If their "
        "weight were also smaller, their low probability would be counted twice.",
        "both get the same": "the number of particles that make a motion already represents its "
        "probability.",
        "the one with the rare motion gets more": "it was sampled as rarely as the target "
        "requires, so its weight needs no correction.",
    },
    right="both get the same",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="11-weight"
predicted, likelihood_of_z, w_before = sp.symbols("predicted likelihood w_before", positive=True)
target, proposal = likelihood_of_z * predicted, predicted
w_before * target / proposal

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-weight"
# By (11.3) the target is the predicted density times the likelihood, and the proposal is the predicted
# density. The predicted density cancels in the importance weight. If a particle already has a weight,
# this weight remains as a factor:
#
# $$w_i \;\leftarrow\; w_i \cdot \Pr(z \mid x_i), \quad \text{then divide all weights by their sum.} \tag{11.5}$$
#
# **The new factor is only the likelihood**, provided that the particles were moved by sampling the
# motion model. If all weights were equal before, as they are directly after resampling, the new weight
# is the likelihood itself.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-weight"
# ### A check against the Kalman filter
#
# We check (11.5) with an example. For a robot on a rail, with Gaussian noise, the Kalman filter is
# exact, so it can serve as the reference. The robot makes twelve steps of one metre, and measures its
# position after each step. One set of 20 000 particles is weighted by (11.5). In the other set, the
# weight is also multiplied by the density of the motion.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="11-weight"
# two particle filters and two Kalman filters, with the same measurements
zs = rail.measured(seed=1)
estimates = {}
for rule in (rail.RIGHT, rail.TWICE):
    estimates[rule] = rail.by_samples(zs, np.random.default_rng(2), 20_000, rule)
for name, noise in {"Kalman": rail.Q, "Kalman, half of Q": rail.Q / 2}.items():
    estimates[name] = rail.by_kalman(zs, noise)
NAMES = {rail.RIGHT: "particles, (11.5)", rail.TWICE: "particles, motion twice"}
for name, (mean, sigma) in estimates.items():
    print(f"{NAMES.get(name, name):24} {mean:6.2f} m, σ {100 * sigma:.1f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-weight"
# The set with the correct weight agrees with the Kalman filter. The other set agrees with a Kalman
# filter that assumes *half the process noise*: it is overconfident. (The first *Deeper* section derives
# the factor of one half.)

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Three particles have the weights `w_old`. The measurement has the likelihoods `l`. What
# are the new weights?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
w_old, l = np.array([0.5, 0.3, 0.2]), np.array([0.1, 0.4, 0.4])
w_new = ...  # by (11.5)
compare(w_new, ParticleSet(np.zeros((3, 2)), w_old).reweighted(np.log(l))[0].weights)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# w_old, l = np.array([0.5, 0.3, 0.2]), np.array([0.1, 0.4, 0.4])
# w_new = w_old * l / np.sum(w_old * l)
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Degeneracy and the effective sample size
#
# If the importance weights are multiplied by likelihoods step after step, a few particles get nearly
# the whole weight. This is called **degeneracy**. The degeneracy is measured by the **effective sample
# size** (also *effective number of particles*): the approximate number of equally weighted, independent
# particles that would give an estimate of the same accuracy,
#
# $$n_{\mathrm{eff}} = \frac{1}{\sum_i w_i^2}. \tag{11.6}$$
#
# With $n$ equal weights it is $n$; if one particle has the whole weight, it is 1. The next cell moves
# and weights 1000 particles on the rail twelve times, without any resampling:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students expect a better sensor to help in every filter. Move `range_sigma` from
# 30 cm to 1 cm and watch the number of visible particles; ask what a real program does with a very
# accurate lidar (fewer beams, or a larger σ than the true one).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# 1000 particles, twelve steps without resampling
rng = np.random.default_rng(2)
x, w = rng.normal(0, 1, 1000), np.full(1000, 1 / 1000)
for step, z in enumerate(zs, start=1):
    x = x + 1 + rng.normal(0, np.sqrt(rail.Q), 1000)
    w = w * np.exp(-((z - x) ** 2) / (2 * rail.R))
    w = w / w.sum()
    if step in (1, 4, 8, 12):
        n_eff = effective_sample_size(w)
        print(f"step {step:2}: n_eff {n_eff:4.0f}, largest weight {100 * w.max():4.1f} %")

# %% slideshow={"slide_type": "subslide"}
ask(
    "11-worth",
    "A set of 500 particles has a standard deviation of half a metre. It observes one landmark, "
    "in one case with a range noise of $\\sigma = 30$ cm, in the other case with $\\sigma = 3$ "
    "cm. **Which set has the larger $n_{\\mathrm{eff}}$ afterwards?**",
    {
        "that of the better sensor": "the posterior gets narrower. But the density of the "
        "particles is the same as before, and fewer of them agree with the measurement.",
        "that of the worse sensor": "with the better sensor, fewer particles agree with the "
        "measurement and represent the posterior.",
        "both the same: 500": "both sets have 500 particles. But particles with weights of "
        "nearly zero contribute almost nothing to an estimate.",
    },
    right="that of the worse sensor",
)


# %% slideshow={"slide_type": "subslide"} answers="11-worth"
def observed(range_sigma, particles):
    """A particle set that has observed one landmark."""
    rows = np.random.default_rng(6).normal(0, [0.5, 0.5, 0.1], (particles, 3))
    mark, R_one = np.array([[3.0, 1.0]]), np.diag([range_sigma, 0.05]) ** 2
    logs = likelihood.of_scan(rows, mark, models.h(np.zeros(3), mark), R_one[None])
    return ParticleSet(rows, normalise(logs)[0]), mark


# %% slideshow={"slide_type": "fragment"} answers="11-worth" tags=["folded"]
def effective(range_sigma, particles):
    weighted_set, mark = observed(range_sigma, particles)
    drawn = Particles("sample", weighted_set.rows, weighted_set.weights)
    layers = {"particles, area by weight": drawn}
    layers |= {"landmark": Points("landmark", mark), "true robot": Poses("truth", np.zeros(3))}
    title = f"{particles} particles, n_eff = {weighted_set.effective_sample_size:.0f}"
    fig, ax = views.axes(title, size=(8, 5))
    for label, layer in layers.items():
        views.draw(ax, layer, label=label)
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"} answers="11-worth"
views.explore(
    effective,
    lambda range_sigma, particles: (
        f"{particles} particles, drawn larger with a larger weight. After a measurement of a range with "
        f"a sigma of {100 * range_sigma:.0f} cm, the effective sample size is "
        f"{observed(range_sigma, particles)[0].effective_sample_size:.0f}."
    ),
    range_sigma=(0.01, 0.5, 0.03),
    particles=(50, 3000, 500),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-worth"
# With $\sigma = 3$ cm for the range, only the particles on a thin arc have large weights, and
# $n_{\mathrm{eff}}$ is {= observed(0.03, 500)[0].effective_sample_size:.0f =} of 500. With
# $\sigma = 30$ cm it is {= observed(0.3, 500)[0].effective_sample_size:.0f =}. So we either use more
# particles, or a proposal that depends on the measurement, with weights by (11.4). The exercise uses
# such a proposal.
#
# $n_{\mathrm{eff}}$ is an estimate from the weights alone. It detects neither copies of particles nor a
# particle set at a wrong place. A set that contains only the wrong mode can also have a large
# $n_{\mathrm{eff}}$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the effective sample size of this set from its weights `w`.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
w = observed(0.1, 500)[0].weights
n_eff = ...  # by (11.6)
compare(n_eff, observed(0.1, 500)[0].effective_sample_size)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# w = observed(0.1, 500)[0].weights
# n_eff = 1 / np.sum(w**2)
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Log-likelihoods against underflow
#
# The last example had one landmark. A lidar measures with hundreds of beams, and the likelihoods of
# independent measurements are multiplied. Suppose that an accurate sensor (5 cm, 1°) observes twenty
# landmarks, and that three particles are half a metre from the true pose. What are their weights?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what 0/0 becomes in the program before you show the remedy. The trick that
# subtracts the maximum is the one that students meet again in machine learning (softmax).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# log-likelihoods, likelihoods and weights of three particles
rng = np.random.default_rng(4)
places, R_fine = rng.uniform(-8, 8, (20, 2)), np.diag([0.05, np.radians(1)]) ** 2
z = models.h(np.zeros(3), places) + rng.multivariate_normal([0, 0], R_fine, 20)
off = np.array([[0.5, 0, 0], [0.5002, 0, 0], [0.5, 0, 0.0001]])
logs = likelihood.of_scan(off, places, z, np.tile(R_fine, (20, 1, 1)))
print("log-likelihoods", logs.round(1), "  likelihoods", np.exp(logs))
print("weights by (11.7)   ", normalise(logs)[0].round(4))
print("all lower by 100 000", normalise(logs - 1e5)[0].round(4))

# %% [markdown] slideshow={"slide_type": "fragment"}
# A floating-point number below about $e^{-745}$ is rounded to zero: this is *underflow*. All three
# likelihoods are zero, and 0/0 is undefined. But the weights depend only on the ratios of the
# likelihoods. So we compute with the log-likelihoods $\ell_i$, and subtract the largest one before we
# compute any exponential:
#
# $$w_i = \frac{e^{\ell_i}}{\sum_j e^{\ell_j}} = \frac{e^{\ell_i - \max \ell}}{\sum_j e^{\ell_j - \max \ell}}. \tag{11.7}$$
#
# (If the weights were unequal before, $\ell_i$ includes $\ln w_i$.) The largest term is now $e^0 = 1$,
# so the sum cannot be zero. All three particles have large errors, but the particle with the smallest
# error has the largest weight. (Real beams are *not* independent: an error of one wall in the map
# affects many beams. Then a product of hundreds of likelihoods makes a particle set overconfident. So
# use few beams, or multiply $\ell_i$ by a factor below 1.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Resampling: multinomial or systematic
#
# Particles with very small weights need computing time but contribute almost nothing. So we draw $n$
# new particles from the old ones, particle $i$ with the probability $w_i$. Particles with large weights
# are copied, those with small weights disappear, and all weights are equal again. This step is
# **resampling**; it removes the degeneracy. Suppose that the weights are pieces of a line of length 1.
# There are two methods to draw:
#
# - **multinomial resampling** uses $n$ independent random numbers, each of which selects the piece of
#   the line in which it lies;
# - **systematic resampling** (also *low-variance resampling*) uses $n$ positions at equal distances,
#   and *one* random number that shifts all of them.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class count the copies of particle 0 while you shift the systematic
# positions. A common error is the belief that systematic resampling is biased because it draws only
# one random number.


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
w8 = np.array([0.28, 0.05, 0.17, 0.02, 0.12, 0.21, 0.04, 0.11])


def resampling(systematic_shift, multinomial_seed):
    independent = np.sort(np.random.default_rng(multinomial_seed).random(8))
    copies = np.sum(systematic_at(w8, 8, systematic_shift) == 0), np.sum(independent < w8[0])
    title = "copies of particle 0: {} by systematic, {} by multinomial resampling".format(*copies)
    picks = {
        "systematic": np.linspace(0, 0.875, 8) + systematic_shift / 8,
        "multinomial": independent,
    }
    return views.wheel(w8, picks, title, size=(9, 3.6))[0]


# %% slideshow={"slide_type": "fragment"}
views.explore(
    resampling,
    lambda systematic_shift, multinomial_seed: (
        "Eight weights on a line; the systematic positions have equal distances, shifted by "
        f"{systematic_shift:.2f}; the multinomial positions of seed {multinomial_seed} are random."
    ),
    systematic_shift=(0.0, 0.99, 0.3),
    multinomial_seed=(1, 40, 3),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Shift the systematic positions from one end to the other. Particle 0 should have $8 \cdot 0.28 = 2.24$
# copies, and it gets either 2 or 3. With multinomial resampling it can get any number of copies, and a
# particle with a large weight can be lost.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
# copies of each particle by both methods, in 4000 draws
variance = {}
for name, draw in {"multinomial": multinomial, "systematic": systematic}.items():
    rngs = (np.random.default_rng(seed) for seed in range(4000))
    copies = np.array([np.bincount(draw(w8, 8, rng), minlength=8) for rng in rngs])
    variance[name] = copies.var(axis=0)
    print(f"{name:12} mean copies {copies.mean(axis=0).round(2)}")
for name, each in variance.items():
    print(f"{name:12} variance    {each.round(2)}")
ratio = variance["systematic"] / variance["multinomial"]

# %% [markdown] slideshow={"slide_type": "fragment"}
# Both methods are unbiased. The variance of systematic resampling is smaller for each of these eight
# particles: the ratio to the variance of multinomial resampling is between {= ratio.min():.2f =} and
# {= ratio.max():.2f =}. For the sums over all eight particles it is
# {= variance["systematic"].sum() / variance["multinomial"].sum():.2f =}. The advantage of systematic
# resampling is small if a particle should have much less than one copy: with both methods this particle
# nearly always gets one copy or none.
#
# With unequal weights, each resampling also loses particles permanently. So the filter resamples only
# if $n_{\mathrm{eff}}$ falls below $n/2$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** In multinomial resampling the number of copies of particle $i$ is binomial: $n$ draws, each of which is $i$ with
# the probability $w_i$. Compute the variance of the number of copies for each of the eight particles, and compare it with the table above.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
variances = ...  # from w8 and n = 8
compare(variances, binom(8, w8).var())

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# variances = 8 * w8 * (1 - w8)
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The particle filter, and Monte Carlo localisation
#
# > **Algorithm: particle filter** (Gordon, Salmond and Smith 1993; *Probabilistic Robotics*, table 4.3). With a known map it is
# > **Monte Carlo localisation**, MCL (Dellaert et al. 1999; table 8.2)
# >
# > *Input:* particles $x_i$ with weights $w_i$, $i = 1, \ldots, n$; odometry $u$; measurement $z$; for MCL the map $p_{1:N}$
# >
# > 1. *Predict:* for each $i$, sample $x_i \sim \Pr(x' \mid x_i, u)$ from the motion model, with its own noise.
# > 2. *Update:* $w_i \leftarrow w_i \cdot \Pr(z \mid x_i, p_{1:N})$, (11.5), computed with logarithms.
# > 3. *Normalise:* $w_i \leftarrow w_i / \sum_j w_j$, (11.7).
# > 4. $n_{\mathrm{eff}} \leftarrow 1 / \sum_i w_i^2$, (11.6).
# > 5. *Resample* if $n_{\mathrm{eff}} < n/2$: draw $n$ particles, $x_i$ with the probability $w_i$; then $w_i \leftarrow 1/n$.
# >
# > *Output:* particles and weights; as a point estimate their weighted mean, if there is only one mode

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class find the step that makes the filter different from a histogram
# filter, and the step that may be left out at times. Point at the error and the σ in the output: with
# 1000 particles the filter is far too confident.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "code"]
def localised(n, seed):
    """The position error after ten steps with known data association, and its σ by the particles."""
    rng, truth = np.random.default_rng([8, seed]), START
    mcl = MCL(uniform(n, LOW, HIGH, rng), CORNERS, rng)
    for _ in range(10):
        truth = compose(truth, STEP)
        mcl.predict(STEP, WHEELS)
        z = models.h(truth, CORNERS) + rng.multivariate_normal([0, 0], R, 4)
        mcl.update(z, R, ids=range(4))
    b = mcl.particles.moments
    return np.hypot(*(b.x - truth)[:2]), np.sqrt(np.trace(b.P[:2, :2]))


for n in (1000, 8000):
    error, sigma = np.sqrt(np.mean(np.square([localised(n, k) for k in range(40)]), axis=0))
    print(f"{views.grouped(n):>6} particles: error {100 * error:.0f} cm, σ {100 * sigma:.0f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The values are root mean squares over 40 runs from an unknown start; $\sigma$ is the root of the trace
# of the position's covariance. The filter is overconfident, but much less so with more particles: in a
# small set, hardly any particle starts near the robot's pose.
#
# In the first section the data association of the corners was unknown. Then each measurement can come
# from any of the $N$ landmarks in the map, all equally likely, and its likelihood is the mean over all
# of them:
#
# $$\Pr(z \mid x_i) = \frac{1}{N} \sum_{j=1}^{N} \Pr(z \mid x_i, p_j). \tag{11.8}$$
#
# So the data association is *marginalised*: no particle ever decides which corner it observed. (The likelihoods of the
# measurements of a scan are multiplied. The library adds a small constant density for false measurements.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The kidnapped robot, and random particles
#
# After 25 steps somebody lifts the robot and puts it down elsewhere in the room, at least 2.5 m away.
# (The sensor can now observe the post from the whole room.) Until then, a set of 500 particles has
# tracked the robot in {= followed =} of {= runs =} runs. This situation is the **kidnapped robot**
# problem, and finding the robot again is called **relocalisation**.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-carried",
    "**How does the particle set change in the next 35 steps?**",
    {
        "it spreads until it contains the robot again": "a particle moves by the odometry and a "
        "little noise. No step of the algorithm spreads a particle set because it is wrong.",
        "in most runs it remains wrong": "the filter can only copy existing particles, and a "
        "copy is at the same wrong place as its original.",
        "its weights show that the robot is lost": "the weights are normalised. So the best of "
        "the wrong particles has the largest weight, even if its error is large.",
    },
    right="in most runs it remains wrong",
)


# %% slideshow={"slide_type": "subslide"} answers="11-carried" tags=["folded"]
@cache
def errors_of(random_particles, run):
    """The error of the weighted mean, after each of 60 steps."""
    pictures = film(500, run, 60, reach=9.0, injected=random_particles, carried=25)
    return [np.hypot(*(particles.moments.x - truth)[:2]) for particles, truth in pictures]


def kidnapped(random_particles, run):
    curves = {f"{random_particles} random particles a step": errors_of(random_particles, run)}
    curves |= {"no random particles": errors_of(0, run)}
    fig, ax = views.curves(np.arange(61), curves, "step", "position error [m]", size=(8, 4.2))
    ax.axvline(25.5, color=views.COLOURS["limit"], linestyle="dashdot", label="kidnapped")
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="11-carried"
views.explore(
    kidnapped,
    lambda random_particles, run: (
        f"The error of the mean: {errors_of(0, run)[-1]:.1f} m at the end without random particles, "
        f"{errors_of(random_particles, run)[-1]:.1f} m with {random_particles} of them in every step."
    ),
    random_particles=(1, 250, 50),
    run=(0, 20, 2),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-carried"
# Usually no particle is near the robot, and the filter cannot create one there. The solution is
# **random-particle injection**: in every step, some particles are replaced by **random particles**,
# that is, random poses in the whole room. If a random particle agrees with the measurements much better
# than the others, it is copied many times. *Augmented MCL* computes the number of random particles from
# the mean likelihood of the set (see *Deeper*).

# %% slideshow={"slide_type": "subslide"} answers="11-carried" tags=["folded"]
again = {f"{k} random particles": share["found"] for k, share in many["injected"].items()}
fig, _ = views.shares({"found": again}, f"share of {runs} runs relocalised", size=(8, 3.8))
price = {k: row["error before"] for k, row in many["injected"].items()}  # [m]
shown = ", ".join(f"with {name} in {100 * share[0]:.0f} %" for name, share in again.items())
views.show(fig, f"The robot is relocalised {shown} of the runs.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-carried"
# Without random particles the robot was relocalised in {= 100 * many["injected"]["0"]["found"][0]:.0f =} % of the runs. With 5 of 500
# in every step it was relocalised in {= 100 * many["injected"]["5"]["found"][0]:.0f =} %, and with 50 in
# {= 100 * many["injected"]["50"]["found"][0]:.0f =} %.
#
# Random particles replace particles that track the robot, so we expect a loss of accuracy. In this room
# the results show no such loss. Before the kidnapping, the error of the mean was
# {= 100 * price["0"][0]:.0f =} cm without random particles (median of the runs),
# {= 100 * price["50"][0]:.0f =} cm with 50, and {= 100 * price["250"][0]:.0f =} cm with 250. The room
# of the exercise is larger, so a random particle is less often near the correct pose.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Sample impoverishment
#
# A particle set also loses diversity if the robot stands still. Each resampling drops some particles,
# and without motion no noise creates different ones. We count how many of 1000 different particles
# remain:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# how many different particles remain while the robot stands still?
rng = np.random.default_rng(9)
mcl, left = MCL(ParticleSet.unweighted(rng.normal(0, [0.3, 0.3, 0.1], (1000, 3))), CORNERS, rng), {}
for scan in range(1, 61):
    z = models.h(np.zeros(3), CORNERS) + rng.multivariate_normal([0, 0], R, 4)
    mcl.update(z, R, ids=range(4))
    left[scan] = len(np.unique(mcl.particles.rows, axis=0))
print("different particles after", {scan: left[scan] for scan in (1, 5, 20, 60)})
print(f"effective sample size {mcl.particles.effective_sample_size:.0f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# This is **sample impoverishment**: resampling removes the degeneracy, but it reduces the diversity of
# the set. (If no particle is left near the true pose, this is also called *particle deprivation*.) The
# effective sample size $n_{\mathrm{eff}}$ does not show this effect, since it depends on the weights
# and not on the poses. One solution is **roughening**: add a little noise to all particles after each
# resampling. In part two the library uses roughening for sets that do not move. *This is a good place
# for a break.*

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is a good place to end the first lecture. A question for homework: would you
# inject random particles if you knew that the robot will never be kidnapped? (Random particles also
# correct a wrong initial estimate.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Part two: particle-filter SLAM, one set for each landmark
#
# SLAM estimates the landmarks as well. Can we sample the whole state at once: the pose with its three
# components, and $N$ landmarks with two components each?
#
# Suppose that ten particles are enough for one component. Then the pose alone needs
# $10 \cdot 10 \cdot 10$ particles, because every combination of its three components needs its own
# particle. Each further component increases the number by a factor of ten. With ten landmarks the state
# has 23 components, which need $10^{23}$ particles.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask for the number of particles of a map with ten landmarks before you show
# $10^{23}$. In the animation, point at one cross: its particle set shrinks beside it.

# %% [markdown] slideshow={"slide_type": "subslide"}
# The MAK thesis avoids this with its algorithm 2: *one particle set for the robot, and an independent
# one for each landmark.* This algorithm uses a thousand poses and 300 positions for each landmark, for
# any number of landmarks.
#
# But the weight of a pose depends on the position of the landmark, and the weight of a landmark's
# particle depends on the pose of the robot. Both are unknown. So the algorithm uses **random particles
# of the other set** as partners. With $M$ such partners $p_1, \ldots, p_M$, drawn independently for
# every pose $x_i$, the likelihood is the mean
#
# $$\Pr(z \mid x_i) \;\approx\; \frac{1}{M} \sum_{j=1}^{M} \Pr(z \mid x_i, p_j), \tag{11.9}$$
#
# and vice versa for the landmark's particles. The thesis uses one partner; the library uses ten to
# reduce the noise. The particles of a new landmark are computed from its measurement and from random
# poses of the robot's set. We simulate a lap past ten landmarks.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
# SLAM with independent particle sets on a lap; the drawing after each reading
lap = sets.lap(12)
slam, pictures = montecarlo(lap), {}
for k, reading in enumerate(lap):
    slam.step(reading)
    pictures[k] = slam.layers()
final_error = np.hypot(*(slam.pose - lap.truth.poses[-1])[:2])
rows = [slam.filter.ids.index(i) for i in slam.filter.frozen]
off = slam.filter.landmarks()[rows] - lap.landmarks[list(slam.filter.frozen)]
frozen_error = np.hypot(*off.T).mean()


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def sets_after(readings):
    names = "landmarks' particles", "frozen landmarks", "estimated trajectory", "robot's particles"
    layers = {"true trajectory": Poses("truth", lap.truth.poses[: readings + 1])}
    layers |= dict(zip(names, pictures[readings], strict=True))
    fig, ax = views.axes(f"After {readings} readings", size=(9, 6))
    squares = {"frozen landmarks": {"marker": "s", "markersize": 7}}
    for label, layer in layers.items():
        views.draw(ax, layer, label=label, **squares.get(label, {}))
    crosses = {"marker": "+", "markersize": 12, "mew": 1.5, "label": "true landmarks"}
    views.draw(ax, Points("truth", lap.landmarks), **crosses)
    ax.set(xlim=(-7.5, 7.5), ylim=(-2.5, 10.5), adjustable="box")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"}
views.explore(
    sets_after,
    lambda readings: (
        f"Trajectories after {readings} of {len(lap) - 1} readings; particles of landmarks, beside the "
        f"true landmarks (crosses); landmarks frozen to points: {len(pictures[readings][1].xy)}."
    ),
    play="readings",
    readings=(0, len(lap) - 1, 52),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Every landmark is a particle set. At first its variance is that of the robot's position and of the
# measurement together, and it shrinks while the landmark is observed. Press ▶ and compare the sets with
# the crosses, the true landmarks. The sets shrink to points *beside* the crosses. When the last
# particle of a landmark is within 5 cm of the mean, the landmark is frozen to a point. In this run the
# frozen landmarks have an average error of {= 100 * frozen_error:.0f =} cm. The robot is localised with
# these landmarks, and its trajectory ends {= 100 * final_error:.0f =} cm from the true one.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Independent sets lose the correlations
#
# The robot's position has $\sigma = 30$ cm along its path. The robot measures the range of a landmark
# straight ahead with $\sigma = 5$ cm, and the landmark's set is created from this measurement. From
# then on the two sets are separate.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Act it with two students who are tied together by a rope of fixed length: both
# may stand anywhere, but together. Exchanging the partners removes the rope.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-forget",
    "**What is the standard deviation of the range between robot and landmark, computed from the two separate sets?**",
    {
        "5 cm: it has just been measured": "within each pair of particles the range has this σ, "
        "but the pairs are not stored. A random partner does not belong to the same pair.",
        "some 30 cm, that of the robot": "the landmark's set also has a σ of 30 cm, and in the "
        "separate sets the two errors are independent.",
        "more than 40 cm": "the difference of two independent errors of 30 cm has a σ of 30 cm "
        "times the root of two.",
    },
    right="more than 40 cm",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="11-forget"
# 5000 poses with the landmarks that they initialised, and with random partners
rng = np.random.default_rng(13)
poses = rng.normal(0, [0.3, 0.3, 0.0], (5000, 3))
landmark = models.g(poses, np.array([2.0, 0.0]) + rng.normal(0, [0.05, 0.02], (5000, 2)))
range_sigma = {}
for name, places in ("as initialised", landmark), ("random partners", rng.permutation(landmark)):
    range_sigma[name] = 100 * models.h(poses, places)[:, 0].std()
    correlation = np.corrcoef(poses[:, 0], places[:, 0])[0, 1]
    print(f"{name:16} σ of the range {range_sigma[name]:2.0f} cm, correlation {correlation:5.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-forget"
# A pose that is 30 cm too far back can now be paired with a landmark that was initialised from a pose
# 30 cm too far ahead. So $\sigma$ of the range was {= range_sigma["as initialised"]:.0f =} cm, and now
# it is {= range_sigma["random partners"]:.0f =} cm. Each set alone is as accurate as before, but their
# correlation, the block $P_{\mathrm{r}i}$ of lesson 07, is lost.
#
# With every reading the two sets are updated as if their errors were independent. As lesson 07 showed,
# the result is an overconfident estimate.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-forget"
# We test whether the estimate is overconfident here. We simulate {= runs =} laps with odometry alone,
# with the EKF of lesson 06, and with independent sets. The error is the absolute trajectory error: the
# root mean square of the position error along the run (not aligned). The table shows its median over
# the laps. *Outside* is the share of all readings at which the true pose is outside the 95 % region.

# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"] answers="11-forget"
maps = many["maps"]


def row(name):
    """Print a row of the table: the error, its difference from odometry, the share outside."""
    line = f"{name.replace('sets', 'independent sets'):34} {100 * maps[name]['rms'][0]:3.0f} cm"
    if "outside" in maps[name]:
        more, outside = maps[name]["against odometry"][0], maps[name]["outside"]
        line += f" {100 * more:+14.0f} cm   {percent(outside)}"
    print(line)


HEAD = f"{f'{runs} laps':34}  error  minus odometry's  outside, 95 % interval"
print(HEAD)
for name in (sets.WHEELS, sets.EKF, sets.SETS, sets.ONE):
    row(name)
worse = {name: maps[name]["against EKF"] for name in (sets.SETS, sets.FAST[1000])}  # [m]
outside = {name: 100 * maps[name]["outside"][0] for name in maps if "outside" in maps[name]}

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-forget"
# Both filters have smaller errors than odometry. On the same lap the independent sets have a larger
# error than the EKF, by {= 100 * worse[sets.SETS][0]:.0f =} cm (the median of the paired differences,
# which is not the difference of the medians; 95 % interval {= 100 * worse[sets.SETS][1]:.0f =} to
# {= 100 * worse[sets.SETS][2]:.0f =} cm). But their covariance is far too small. With a consistent
# filter the true pose is outside in 5 % of the readings. With the EKF this share is
# {= outside[sets.EKF]:.0f =} %, and with independent sets {= outside[sets.SETS]:.0f =} %. More partners
# change it only a little.
#
# The main cause is that the sets are separate: FastSLAM, at the end of this part, keeps the
# correlations, and its share is far smaller. Too few particles increase the overconfidence further.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Resampling without measurements: a landmark drifts
#
# As published, algorithm 2 resamples *every* set in *every* step, whether the landmark is observed or not. Consider a
# landmark that is out of view for a long time: all its particles keep the same weight.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is the loss of a mode again, now with positions instead of modes. Ask why
# an unbiased procedure can still ruin a single run.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-unseen",
    "The landmark is not measured, and its set is resampled 300 times by multinomial "
    "resampling. **How does the set change?**",
    {
        "it does not change: resampling is unbiased": "resampling is correct on average. But a "
        "random walk is also unbiased, and it still moves away from its start.",
        "it gets wider, since nothing is measured": "copies are at the positions of the "
        "originals, so resampling cannot create a wider set.",
        "its mean drifts away, and it gets narrower": "each resampling loses some particles by "
        "chance. The remaining particles have a different mean, and on average a smaller "
        "variance.",
    },
    right="its mean drifts away, and it gets narrower",
)


# %% slideshow={"slide_type": "subslide"} answers="11-unseen" tags=["folded"]
@cache
def unobserved(particles):
    return sets.resampled_drift(particles, 300, 0.1, np.random.default_rng(15))


def drift(particles):
    times, (walked, radius) = np.arange(1, 301), unobserved(particles)
    lines = {"√trace of the set's covariance": radius}
    lines["distance of its mean from the start"] = walked
    lines["(11.10)"] = np.sqrt(2 * 0.1**2 * (1 - (1 - 1 / particles) ** times))
    title = f"{particles} particles, resampled 300 times"
    fig, ax = views.curves(times, lines, "resamplings", "rms value [m]", title, size=(8, 4.2))
    views.legend(ax, loc="lower right")
    return fig


# %% slideshow={"slide_type": "fragment"} answers="11-unseen"
views.explore(
    drift,
    lambda particles: (
        f"{particles} particles: at the end the mean has moved by {unobserved(particles)[0][-1]:.3f} m, "
        f"and the √trace of the covariance is {unobserved(particles)[1][-1]:.3f} m."
    ),
    particles=(50, 600, 300),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-unseen"
# The mean drifts, and the set becomes overconfident. On average, each resampling removes the share $1/n$ of the variance and
# adds it to the error. The dotted curve shows the distance that results, (11.10).

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-unseen"
# If the initial variance of a set is $\sigma^2$, in $x$ and in $y$ together, the mean square distance
# of its mean from the start after $k$ resamplings is
#
# $$\mathrm{E}\, |\bar x_k - \bar x_0|^2 = \left(1 - \left(1 - \tfrac1n\right)^k\right) \sigma^2, \tag{11.10}$$
#
# as a *Deeper* section derives. Biologists call this effect genetic drift. Genetic
# drift also occurred in the first section: hardly any measurement distinguished the two modes, and in a
# small set the weight of one mode drifted to zero.
#
# There are two solutions, and the library uses both. It does not resample the set of a landmark that
# was not observed, and it uses systematic resampling, which returns each of $n$ equally weighted
# particles exactly once.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=11
# ## Rao–Blackwellised particle filter: FastSLAM
#
# As lesson 05 showed, if the robot's poses are *known*, the landmarks are independent of one another,
# and each needs only a small Kalman filter. Now consider one particle of the robot. Together with its
# earlier poses it represents a whole **trajectory**, a hypothesis about all poses. *Given* the
# trajectory $x_{1:k}$, the landmarks $p_1, \ldots, p_N$ are conditionally independent:
#
# $$\Pr(x_{1:k}, p_{1:N} \mid z_{1:k}, u_{1:k}) = \Pr(x_{1:k} \mid z_{1:k}, u_{1:k}) \prod_{j=1}^{N} \Pr(p_j \mid x_{1:k}, z_{1:k}).
# \tag{11.11}$$
#
# (This assumes known data association, independent measurement noise, and landmarks that are
# independent before the first measurement.) So it is enough to sample the first factor, and to compute
# the others with Kalman filters. A filter that samples a part of the state and computes the rest in
# closed form is called a **Rao–Blackwellised particle filter**. If **each particle's map** consists of
# small EKFs, which linearise, the filter is called **FastSLAM**. No cross-covariance is stored: the
# correlations are contained in the *differences* between the particles and their maps.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students look for the covariance between two landmarks and do not find it. Ask
# how it could be computed from the particles. If time is short, leave out the box of the algorithm
# and keep the table.

# %% [markdown] slideshow={"slide_type": "subslide"}
# > **Algorithm: FastSLAM 1.0** (Montemerlo et al. 2002; *Probabilistic Robotics*, table 13.1), known data association
# >
# > *Input:* $n$ particles, each with a pose $x_i$, a weight $w_i$, and for each of its landmarks a mean $\hat p_{ij}$ and a covariance $P_{ij}$ (2 × 2);
# > odometry $u$; a measurement $z$ of landmark $j$ with covariance $R$. For each particle $i$:
# >
# > 1. *Predict:* sample $x_i \sim \Pr(x' \mid x_i, u)$.
# > 2. If landmark $j$ is new: $\hat p_{ij} \leftarrow g(x_i, z)$, $P_{ij} \leftarrow J_z R J_z^{\mathsf T}$, and go to 6.
# > 3. *Innovation:* $v = z - h(x_i, \hat p_{ij})$, $S = H P_{ij} H^{\mathsf T} + R$, with $H = \partial h / \partial p$.
# > 4. *Weight:* $w_i \leftarrow w_i \cdot \mathcal N(v;\, 0, S)$.
# > 5. *EKF update of the landmark:* $K = P_{ij} H^{\mathsf T} S^{-1}$, $\hat p_{ij} \leftarrow \hat p_{ij} + K v$, $P_{ij} \leftarrow (I - K H) P_{ij}$.
# > 6. *Normalise* all weights; *resample* if $n_{\mathrm{eff}} < n/2$. A copy of a particle includes a copy of its map.
# >
# > *Output:* $n$ trajectories with their maps, and weights

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "code"]
fast = FastSLAM(np.random.default_rng(16), particles=100)
for reading in lap:
    fast.predict(reading.odometry, lap.robot)
    seen = observed_landmarks(reading, lap.sensor, rng)
    known = np.isin(seen.ids, fast.ids)
    for step, rows in ((fast.update, known), (fast.add, ~known)):
        if rows.any():
            step(seen.ids[rows], seen.z[rows], seen.R[rows])
b = fast.robot.moments
print(f"{len(fast.ids)} landmarks in each of {len(fast.p)} particles")
end = 100 * np.hypot(*(b.x - lap.truth.poses[-1])[:2]), 100 * np.sqrt(np.trace(b.P[:2, :2]))
print("last position: error {:.0f} cm, √trace of its covariance {:.0f} cm".format(*end))

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
# the laps of the last table, with FastSLAM
print(HEAD)
for name in (sets.EKF, sets.SETS, *sets.FAST.values()):
    row(name)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With 1000 particles FastSLAM's error is larger than the EKF's on the same lap, by
# {= 100 * worse[sets.FAST[1000]][0]:.0f =} cm (median of the paired differences, 95 % interval
# {= 100 * worse[sets.FAST[1000]][1]:.1f =} to {= 100 * worse[sets.FAST[1000]][2]:.1f =} cm; the medians
# in the table do not show it). The true pose is outside in {= outside[sets.FAST[1000]]:.0f =} % of the
# readings, instead of {= outside[sets.SETS]:.0f =} % with independent sets, because FastSLAM represents
# the correlations. FastSLAM is still overconfident, especially with 100 particles
# ({= outside[sets.FAST[100]]:.0f =} %; see the last position of the single run above). Each resampling
# reduces the number of different beginnings of the trajectory. At the loop closure the filter can only
# choose among the remaining ones. This is another case of sample impoverishment. (*FastSLAM 2.0*
# reduces it by a proposal that uses the measurement as well.)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# N. J. Gordon, D. J. Salmond and A. F. M. Smith, "Novel approach to nonlinear/non-Gaussian Bayesian state
# estimation", *IEE Proceedings F* 140(2), 1993: particles that are moved, weighted, resampled and roughened.
#
# F. Dellaert, D. Fox, W. Burgard and S. Thrun, "Monte Carlo localization for mobile robots", *IEEE International
# Conference on Robotics and Automation*, 1999: global localisation in a known map.
#
# J. S. Liu and R. Chen, "Sequential Monte Carlo methods for dynamic systems", *Journal of the American Statistical
# Association* 93(443), 1998: when to resample.
#
# D. Fox, "Adapting the sample size in particle filters through KLD-sampling", *International Journal of Robotics Research*
# 22(12), 2003.
#
# M. Montemerlo, S. Thrun, D. Koller and B. Wegbreit, "FastSLAM: a factored solution to the simultaneous localization
# and mapping problem", *AAAI*, 2002: particles that represent trajectories, each with its own map.
#
# **Read next:** S. Thrun, W. Burgard and D. Fox, *Probabilistic Robotics*, MIT Press, 2005, chapters 4, 8 and 13.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## What you can do now
#
# | what | how |
# | --- | --- |
# | predict | sample the motion model, each particle with its own noise |
# | update | multiply the weight by the likelihood, using logarithms from which the largest is subtracted |
# | resample | systematically, when $n_{\mathrm{eff}} < n/2$ |
# | particles are suitable for | non-Gaussian and multimodal posteriors, unknown data association |
# | particles are unsuitable for | very accurate sensors, many dimensions, modes without particles |
# | independent sets with random partners | fast, but far too confident |
# | FastSLAM | a Rao–Blackwellised particle filter: particles that represent trajectories, each with its own map |
#
# **What comes next:** in [lesson 12](12_three_filters.ipynb) set-membership, Kalman and particle filters run on the same robot.
#
# The sections below this one are optional.
#
# **Exercise:** [11 · Particle filters](../exercises/ex11_particle_filters.ipynb). You resample and localise,
# correct for particles from another proposal, write a step of FastSLAM, and relocalise a kidnapped robot.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the density of the motion, counted twice
#
# In "Importance sampling", the weights of one particle set were also multiplied by the density of the
# motion, and the set agreed with a Kalman filter with half of $Q$. The particles are sampled from this
# density and then weighted by it again, so the filter uses its square. What is the square of a
# Gaussian?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask how one could find this error in a program without the Kalman filter as a
# reference: the estimate is plausible, only the σ is too small.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
q, Q = sp.symbols("q Q", positive=True)
density = sp.exp(-(q**2) / (2 * Q))
sp.simplify(density**2 / density.subs(Q, Q / 2))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The quotient is 1: except for its height, the square of a Gaussian of variance $Q$ is a Gaussian of
# variance $Q/2$. So the error is not small: the $\sigma$ of the odometry is effectively too small by a
# factor of $\sqrt 2$.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the variance after resampling
#
# Draw $n$ times, independently, from $n$ equally weighted particles with the variance $\sigma_k^2$
# (divided by $n$, not by $n - 1$). The mean of the draws has the variance $\sigma_k^2/n$ about the mean
# of the particles. This is one step of the random walk. The variance of the draws about *their own*
# mean is smaller by the same amount,
#
# $$\mathrm{E}\,\sigma_{k+1}^2 = \left(1 - \tfrac1n\right) \sigma_k^2, \tag{11.12}$$
#
# so that the sum of the two equals the previous variance. The steps are uncorrelated, and their
# variances add up to a geometric series, which gives (11.10). For two particles we can check (11.12)
# exactly, because there are only four possible draws:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The two-particle case is short enough for the board: two of the four draws lose
# a particle.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
one, other = sp.symbols("x_1 x_2", real=True)
draws = [(one, one), (one, other), (other, one), (other, other)]
variances_of = [sum((x - sum(pair) / 2) ** 2 for x in pair) / 2 for pair in draws]
sp.simplify(sum(variances_of) / 4 / variances_of[1])

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: freezing a landmark
#
# The MAK thesis has another solution against drift: if *all* particles of a landmark are close
# together, their mean is treated as the true position from then on. The landmark becomes a point, and a
# point cannot drift. But which distance should be the threshold?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what the filter claims about a frozen landmark (a variance of zero), and
# which measurement could correct it (none).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print(HEAD)
for name in (sets.SETS, *sets.FROZEN.values()):
    row(name)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With landmarks frozen at 10 cm, the results are about the same as without freezing. With landmarks
# frozen at 80 cm, the error is {= 100 * maps[sets.FROZEN[0.8]]["rms"][0]:.0f =} cm instead of
# {= 100 * maps[sets.SETS]["rms"][0]:.0f =} cm. A landmark that is frozen early keeps the error that it
# has at that time, and this error affects the robot's pose from then on. The thesis gives no threshold;
# the library uses 5 cm.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: KLD-sampling, an adaptive number of particles
#
# A posterior that is spread over the whole room needs many particles; a posterior that is concentrated
# around one pose needs few. Divide the space of poses into bins, and count the $k$ bins that contain
# particles. **KLD-sampling** uses the smallest number of particles that keeps the Kullback–Leibler
# divergence between the sampled and the true distribution over these bins (for independent samples)
# below $\varepsilon$ with probability $1 - \delta$:
#
# $$n = \frac{k-1}{2\varepsilon} \left(1 - \frac{2}{9(k-1)} + \sqrt{\frac{2}{9(k-1)}}\; z_{1-\delta}\right)^3. \tag{11.13}$$
#
# Here $z_{1-\delta}$ is the quantile of the standard Gaussian. (The formula approximates the $\chi^2$ quantile with $k - 1$ degrees of
# freedom, divided by $2\varepsilon$.) The formula gives an **adaptive number of particles** in every step. We use bins of 0.5 m, 0.5 m and 15°.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students often take $n$ from (11.13) as a guarantee that the robot is found. It
# bounds one draw; the loss of a mode is an effect of many.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# bins with particles in the run of the first section, and n by (11.13)
def kld_sample_size(k, epsilon=0.05, delta=0.01):
    a = 2 / (9 * (k - 1))
    return (k - 1) / (2 * epsilon) * (1 - a + np.sqrt(a) * norm.isf(delta)) ** 3


for step in (0, 4, 8, 36):
    bins = np.floor(run_with(10_000)[step][0].rows / [0.5, 0.5, np.radians(15)])
    k = len(np.unique(bins, axis=0))
    print(f"step {step:2}: {k:4} bins, n = {views.grouped(round(kld_sample_size(k)))}")

# %% [markdown] slideshow={"slide_type": "subslide"}
# At the start, more particles are needed than the 10 000 of the first section. A few steps later a few hundred are enough. So we start 20
# runs with 10 000 particles, and resample to the $n$ of (11.13) after every step.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "folded"]
def adaptive(seed, steps=36):
    """The mean number of particles, whether both modes exist after 10 steps, and whether the robot is found."""
    world, rng = np.random.default_rng([seed, 0]), np.random.default_rng([seed, 1])
    truth, mcl, sizes = START, MCL(uniform(10_000, LOW, HIGH, rng), MAP, rng), []
    for step in range(1, steps + 1):
        truth = sample_motion(truth[None], STEP, WHEELS, world)[0]
        mcl.predict(STEP, WHEELS)
        mcl.update(look(truth, world, 1.2), R)
        rows, weights = mcl.particles.rows, mcl.particles.weights
        bins = np.floor(rows / [0.5, 0.5, np.radians(15)])
        n = int(kld_sample_size(max(2, len(np.unique(bins, axis=0)))))
        mcl.particles = ParticleSet.unweighted(rows[systematic(weights, n, rng)])
        sizes.append(n)
        if step == 10:
            both = min(near(mcl.particles, truth), near(mcl.particles, -truth)) > 0.02
    return np.mean(sizes), both, near(mcl.particles, truth) > 0.5


sizes, both, found_by_kld = np.transpose([adaptive(seed) for seed in range(20)])
print(f"mean n after the start: {sizes.mean():.0f}", end="; ")
found_share = percent(share_interval(int(found_by_kld.sum()), 20))
print(f"both modes after 10 steps: {both.sum():.0f} of 20; found: {found_share}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# With {= sizes.mean():.0f =} particles on average the robot is found in
# {= found_share =} of 20 runs. With a constant number of 200 it was found in
# {= percent(found["200"]) =} of the {= runs =} runs above. This suggests that the large number of particles is needed
# mostly at the start. But (11.13)
# bounds the error of *one* draw. It does not prevent the loss of a mode over many resamplings: in
# {= 20 - both.sum():.0f =} of the 20 runs one mode was lost within ten steps.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: augmented MCL, how many random particles?
#
# A particle set at a wrong place does not agree with the measurements: the mean likelihood
# $\bar w = \sum_i w_i \Pr(z \mid x_i)$ decreases. But a single outlier also reduces $\bar w$. So
# **augmented MCL** computes a slow and a fast running mean of $\bar w$, with the rates
# $\alpha_{\mathrm{slow}} \ll \alpha_{\mathrm{fast}}$:
# $w_{\mathrm{slow}} \leftarrow w_{\mathrm{slow}} + \alpha_{\mathrm{slow}} (\bar w - w_{\mathrm{slow}})$,
# and likewise $w_{\mathrm{fast}}$. The filter replaces the share
# $\max(0,\, 1 - w_{\mathrm{fast}} / w_{\mathrm{slow}})$ of the particles by random particles
# (*Probabilistic Robotics*, table 8.3).

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The result is worth showing: in this room the adaptive rule relocalises the
# robot less often than a constant share. Ask in which environment it would be better.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def replaced_share(slow, fast, w, slow_rate=0.02, fast_rate=0.1):
    return max(0, 1 - (fast + fast_rate * (w - fast)) / (slow + slow_rate * (w - slow)))


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "folded"]
def augmented(seed, constant=None, n=500, slow_rate=0.02, fast_rate=0.1):
    """The share of random particles in each of 60 steps, and whether the robot is relocalised.

    The share may be constant."""
    world, rng = np.random.default_rng([seed, 0]), np.random.default_rng([seed, 1])
    truth, slow, fast, shares = START, None, None, []
    mcl = MCL(ParticleSet.unweighted(rng.normal(truth, [0.2, 0.2, 0.1], (n, 3))), MAP, rng)
    for k in range(60):
        truth = np.array([1.2, 0.9, 2.5]) if k == 25 else truth  # kidnapped
        truth = sample_motion(truth[None], STEP, WHEELS, world)[0]
        mcl.predict(STEP, WHEELS)
        w = np.exp(mcl.update(look(truth, world, 9.0), R))  # the mean likelihood
        slow = w if slow is None else slow + slow_rate * (w - slow)
        fast = w if fast is None else fast + fast_rate * (w - fast)
        shares.append(max(0, 1 - fast / slow) if constant is None else constant)
        if count := round(n * shares[-1]):
            mcl.insert(uniform(count, LOW, HIGH, rng))
    return shares, near(mcl.particles, truth) > 0.5


shares, relocalised = zip(*(augmented(seed) for seed in range(20)), strict=True)
shares, relocalised = 100 * np.array(shares), np.array(relocalised)
print(f"random particles before the kidnapping     {shares[:, 5:25].mean():3.0f} %")
print(f"10 to 25 steps after it                    {shares[:, 35:50].mean():3.0f} %")
print(f"at the end, in runs with a relocalisation  {shares[relocalised, 50:].mean():3.0f} %")
same = sum(augmented(seed, constant=0.1)[1] for seed in range(20))
print(f"relocalised: {sum(relocalised)} of 20; with a constant share of a tenth: {same} of 20")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The share of random particles rises after the kidnapping, and falls again in the runs in which the
# robot was found. In this room the share is not zero before the kidnapping, either. Few and noisy
# measurements make $\bar w$ fluctuate, so $w_{\mathrm{fast}}$ is often below $w_{\mathrm{slow}}$ by
# chance. A constant share of a tenth relocalises the robot in {= same =} of the same 20 runs; augmented
# MCL relocalises it in {= sum(relocalised) =}.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The running means are `slow` and `fast`, and a scan has the mean likelihood `w`. Which
# share of the particles does augmented MCL now replace? Use the rates 0.02 and 0.1.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
slow, fast, w = 0.30, 0.28, 0.05
replaced = ...  # after updating both running means
compare(replaced, replaced_share(slow, fast, w))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# slow, fast, w = 0.30, 0.28, 0.05
# next_slow, next_fast = slow + 0.02 * (w - slow), fast + 0.1 * (w - fast)
# replaced = max(0, 1 - next_fast / next_slow)
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the likelihood field
#
# How likely is a *lidar scan* from the pose of a particle? The beam model casts a ray for every beam of
# every particle, and compares the expected range with the measured range. A **likelihood field** needs
# no ray casting. For every cell of the map, the program computes once the distance to the nearest
# obstacle: this is the map's **distance transform**. Then it transforms the end point of each beam by
# the particle's pose, and reads its distance $d$ from the field. With the standard deviation $\sigma$
# of the noise and a small probability $\gamma$ of false measurements, the log-likelihood is
# $\ell_i = \sum \ln\bigl((1-\gamma)\, e^{-d^2/2\sigma^2} + \gamma\bigr)$ over all beams (*Probabilistic
# Robotics*, section 6.4).

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Point at the steps in the curve of ray casting, and ask what a beam does when
# the particle moves past the edge of a table leg. Two rooms that share a thin wall show what the
# field ignores.

# %% slideshow={"slide_type": "fragment"}
# a room with table legs, its distance transform on a grid of 5 cm, and a scan of 60 beams
room, SIDE, pose = worlds.by_name("table-legs"), 0.05, np.array([0.0, -0.5, 0.4])
walls, t = room.outline(), np.linspace(0, 1, 400)[:, None, None]
points = (walls[:, :2] * (1 - t) + walls[:, 2:] * t).reshape(-1, 2)
corner = points.min(axis=0) - 0.5
free = np.ones(np.ceil((np.ptp(points, axis=0) + 1) / SIDE).astype(int))
free[tuple(((points - corner) / SIDE).astype(int).T)] = 0
distance = SIDE * distance_transform_edt(free)
scan = Scanner(beams=60, range_error=0, range_sigma=0.03).scan(room, pose, np.random.default_rng(3))


# %% slideshow={"slide_type": "subslide"}
# the log-likelihood of the scan from a pose, by the field and by ray casting
def log_likelihood(d, sigma=0.1, false_share=0.1):
    return np.log((1 - false_share) * np.exp(-(d**2) / (2 * sigma**2)) + false_share).sum()


def by_field(x):
    cells = (transform(x, scan.points()) - corner) / SIDE - 0.5
    return log_likelihood(map_coordinates(distance, cells.T, order=1, mode="nearest"))


def by_ray_casting(x):
    expected = room.cast(x[:2], x[2] + scan.angles[scan.valid])
    return log_likelihood(scan.ranges[scan.valid] - expected)


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
shifts = np.linspace(-1, 1, 401)
models_of_scan = {"likelihood field": by_field, "ray casting": by_ray_casting}
logs = {
    name: np.array([of(pose + np.array([0, shift, 0])) for shift in shifts])
    for name, of in models_of_scan.items()
}
modes = {name: np.sum((l[1:-1] > l[:-2]) & (l[1:-1] > l[2:])) for name, l in logs.items()}
jump = {name: np.abs(np.diff(l)).max() for name, l in logs.items()}
fig, ax = views.curves(shifts, logs, "particle's y − true y [m]", "log-likelihood [1]", size=(8, 4))
views.show(
    fig,
    f"Both curves have their maximum near the true pose; the likelihood field has {modes['likelihood field']} local maxima, "
    f"ray casting {modes['ray casting']}.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Along this line of particles, ray casting has {= modes["ray casting"] =} local maxima, and the
# likelihood field has {= modes["likelihood field"] =}. Between neighbours 5 mm apart, the
# log-likelihood changes by up to {= jump["ray casting"]:.1f =} with ray casting and
# {= jump["likelihood field"]:.1f =} with the field. A ray that narrowly misses a table leg gives an
# entirely different range, whereas the end point of the measured beam is still near the leg. A particle
# set of finite density needs a smooth likelihood. The disadvantage of the field is that it ignores the
# space *through* which a beam passed: it does not detect a wall between the particle and the end point.
