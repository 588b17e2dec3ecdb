# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 11 · Samples
#
# **You will be able to** keep a belief as a cloud of samples; derive how samples are moved, weighed and drawn anew;
# find a robot that does not know where it is; say how many samples that takes, and what goes wrong with too few; and
# build maps from samples, knowing what they forget.
#
# **90 minutes**, in two parts: where is the robot (56), and what is the map (34). **Before:** lesson
# [03](03_kalman_filter.ipynb) for the Kalman filter, lesson [05](05_two_easy_halves.ipynb) for the known map; for
# part two, lesson [07](07_correlations.ipynb).
#
# *Key:* a Gaussian has one hill. A cloud can have as many hills as its samples suffice for.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Two lectures. The heart of the first is the cloud that decides without a reason; come back to it
# when objects drift in part two, for it is the same thing. If time is short, leave out "Weights that are all zero"
# and "A room of two places". For a poll: the questions on the corners, on fewer samples, on the unlikely drive, on
# the better sensor, and on the object that nobody sees.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from functools import cache

import numpy as np
import sympy as sp

from slamlab import models, views
from slamlab.checks import ask
from slamlab.estimators.montecarlo_slam import montecarlo
from slamlab.filters import MCL
from slamlab.filters.montecarlo import likelihood
from slamlab.filters.montecarlo.motion_sampling import sample_motion
from slamlab.filters.montecarlo.particles import ParticleSet, uniform
from slamlab.filters.montecarlo.resampling import multinomial, systematic, systematic_at
from slamlab.filters.montecarlo.weights import normalise
from slamlab.geometry import compose
from slamlab.layers import Ellipses, Points, Poses, Samples
from slamlab.models import RobotModel
from slamlab.studies import sampled_rail as rail
from slamlab.studies import sets_apart
from slamlab.studies.sampled_room import CORNERS, HIGH, LOW, MAP, POST, START, STEP, WALLS
from slamlab.studies.sampled_room import WHEELS, R, evidence, film, near
from slamlab.studies.study_command import stored

many = stored("samples")  # the table of a long study
runs = many["runs"]

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Which corner is that?
#
# A robot stands in a room of 6 m by 4 m and does not know where. It has a map with four corners and
# a post. It sees the four corners, and they all look alike. The post looks just like a corner, but
# it is seen only from near by.
#
# The robot drives a little and looks, again and again.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-where",
    "The robot has looked at the four corners a few times, and has not come near the post. **Where may it be?**",
    {
        "at one place: four distances fix it": "they would, if we knew which distance belongs to which corner.",
        "at two places": "turn the room by half a turn, and its corners lie on one another again. What the "
        "robot sees is the same from both places, as long as the post is out of sight from both.",
        "at four places, one for each corner": "the room is longer than it is wide: a quarter of a turn does not "
        "bring it back onto itself.",
        "anywhere": "the distances to four corners rule out nearly all of the room.",
    },
    right="at two places",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-where"
# So the belief has two hills, and no Gaussian has two. We keep it as a **cloud of samples**: guesses, each of which
# is a full pose. (The literature calls them particles, and the filter a particle filter.)
#
# We begin with 10 000 samples all over the room, in all directions. Each sample drives as the robot drives. A sample
# that explains what is seen multiplies; one that does not dies out. How that is done is the subject of this part.
# First we watch it.


# %% slideshow={"slide_type": "subslide"} answers="11-where" tags=["folded"]
def scene(cloud, truth, title):
    """The room, at most 1500 of the samples, and a Gaussian of the same mean and covariance."""
    some, b = slice(None, None, len(cloud.rows) // 1500 + 1), cloud.moments
    layers = {"walls": WALLS, "corners, post": Points("landmark", MAP)}
    layers["samples"] = Samples("sample", cloud.rows[some], cloud.weights[some])
    layers["a Gaussian, 95 %"] = Ellipses("naive", [b.x[:2]], [b.P[:2, :2]])
    layers["true robot"] = Poses("truth", truth)
    fig, ax = views.axes(title, size=(9, 5.6))
    for label, layer in layers.items():
        views.draw(ax, layer, label=label)
    ax.set(xlim=(-6.5, 6.5), ylim=(-3.5, 3.5), adjustable="box")  # the same in every step
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="11-where"
drive = cache(lambda samples: film(samples, seed=2))
way = np.array([truth[:2] for _, truth in drive(10_000)])
from_the_post, opposite_from_it = np.hypot(*(np.stack([way, -way]) - POST[0]).T).T
post_seen = np.argmax(from_the_post < 1.2)  # the first step from which it is seen


def at_step(samples, step):
    cloud, truth = drive(samples)[step]
    return scene(cloud, truth, f"{samples} samples after {step} steps")


def long_axis(samples, step):
    """How long the Gaussian's ellipse is [m]."""
    P = drive(samples)[step][0].moments.P[:2, :2]
    return 2 * np.sqrt(5.99 * np.linalg.eigvalsh(P)[1])


# %% slideshow={"slide_type": "subslide"} answers="11-where"
views.explore(
    at_step,
    lambda samples, step: (
        f"{samples} samples after {step} steps: {100 * near(*drive(samples)[step]):.0f} % of the weight lies near the true "
        f"robot, {100 * near(drive(samples)[step][0], -drive(samples)[step][1]):.0f} % near the opposite place; the "
        f"ellipse of one Gaussian is {long_axis(samples, step):.1f} m long."
    ),
    play="step",
    samples=[10_000, 1000, 200, 50],
    step=(0, 36, 4),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-where"
# There are two clusters, one round the robot and one at the opposite place. The ellipse shows a
# Gaussian with the mean and the covariance of the cloud. All that it can say is "in the middle,
# give or take the length of the room", and in the middle there is no robot and no sample.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-where"
# Press ▶. In step {= post_seen =} the robot comes within sight of the post. There is a post on one side of the room
# only, so one of the clusters dies.
#
# To ask such a belief something, we compute a sum. How likely is it that the robot is in some area?
# Add the weights $w_i$ of the samples $x_i$ that are there:
#
# $$\Pr(x \text{ in the area}) \;\approx\; \textstyle\sum_i w_i \quad \text{over all } i \text{ with } x_i \text{ in the area.} \tag{11.1}$$
#
# (All $n$ weights together are one.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what the EKF of lesson 05 would do here. It would have to start somewhere.
# If it starts in the robot's half of the room, it finds the robot; if it starts in the other half,
# it finds the opposite place, with an ellipse just as small.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="11-where"
print("step   near the robot   near the opposite place   near the mean")
for step in (0, 4, 8, 36):
    cloud, truth = drive(10_000)[step]
    places = truth, -truth, cloud.moments.x
    print(f"{step:3}", *(f"{100 * near(cloud, place):16.0f} %" for place in places))

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## A cloud that is too small
#
# Until step {= post_seen =} the robot sees hardly anything that could tell the two places apart. That it does *not*
# see the post tells nothing either: the post is seen from 1.2 m, and until then neither place is so near. (The opposite
# place never comes nearer than {= opposite_from_it.min():.1f =} m.) With 10 000 samples, both clusters lived that long.
# Now we take 200, on the same drive.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-few",
    "**What becomes of the two clusters of 200 samples before the post is seen?**",
    {
        "both stay, drawn more coarsely": "nothing that is seen prefers one of them. But which samples multiply is decided "
        "by lot, and with few samples luck decides much.",
        "one dies out: the wrong one": "nothing has been seen yet by which anybody could know the wrong one.",
        "one dies out, and chance decides which": "each drawing moves the balance a little, to either side. Once a cluster is "
        "empty, nothing brings it back.",
    },
    right="one dies out, and chance decides which",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="11-few"
few = [film(200, seed, steps=10)[-1] for seed in range(100)]
at_robot = np.array([near(cloud, truth) for cloud, truth in few])
opposite = np.array([near(cloud, -truth) for cloud, truth in few])
counts = sum(at_robot > 0.98), sum(opposite > 0.98), sum(np.minimum(at_robot, opposite) > 0.02)
print(f"{len(few)} clouds of 200 samples, after 10 steps:")
print("at the robot only {}, at the opposite place only {}, at both {}".format(*counts))
reasons = np.percentile([evidence(seed, steps=10) for seed in range(100)], [5, 95])

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-few"
# After ten steps, only {= counts[2] =} of the {= len(few) =} clouds still have samples at both
# places. {= counts[0] =} have decided for the robot's place and {= counts[1] =} for the opposite
# one (of the other {= len(few) - sum(counts) =}, some samples lie elsewhere), and *what they have
# seen gives them no reason to decide*: in 90 of the 100 drives, all ten looks together are between
# {= reasons[0]:.2f =} and {= reasons[1]:.2f =} times as likely from where the robot is as from the
# opposite place. When the post comes into sight, a cloud at the wrong place cannot change over: it
# has no sample at the right one.

# %% slideshow={"slide_type": "subslide"} answers="11-few"
found = many["found"]
rows = {f"{n} samples": share for n, share in found.items()}
fig, _ = views.shares({"found": rows}, f"share of {runs} drives found", size=(8, 4.2))
shown = ", ".join(f"{name} in {100 * share[0]:.0f} %" for name, share in rows.items())
views.show(fig, f"The robot is found by {shown} of the drives; the intervals are wide.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-few"
# These are {= runs =} drives for each number of samples, with 95 % intervals, some {= 36 - post_seen =} steps after
# the post came into sight. With a few hundred samples the outcome is about that of a coin toss. Go
# back to the slider of the first section and choose fewer samples: the cloud looks just as sure of
# itself.
#
# **How many samples are enough?** Enough to have many of them at every place that must not be forgotten.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## To predict, drive
#
# What does a step do to the samples? Lesson 04 has carried a belief through the motion $f$ by its
# Jacobian. Afterwards the belief of the EKF is an ellipse with the centre and the covariance
#
# $$\hat x' = f(\hat x, u), \qquad P' = A P A^{\mathsf T} + Q. \tag{11.2}$$
#
# Samples need no Jacobian. Every sample drives by itself, each with *its own* draw of the wheels'
# noise. Suppose that a robot knows its heading only to $\sigma = 0.5$ rad, and drives 3 m. We send
# 1500 samples along.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-banana",
    "The ellipse (11.2) claims to hold 95 of 100 robots. **How many does it hold here?**",
    right=50,
    tolerance=12,
    unit="of 100",
    reason="the robots lie along a bent arc, and the ellipse is straight: about half of them are beside it.",
    wrong={
        95: "it would, if the motion were linear. But it bends the line of headings into an arc.",
        0: "the robots whose heading is nearly right do end up in it, and most of them are not far off.",
    },
)


# %% slideshow={"slide_type": "subslide"} answers="11-banana"
def driven(heading_sigma, samples):
    """Samples after 3 m, the EKF's ellipse, and the share of the samples in it."""
    rng, sigmas = np.random.default_rng(11), np.array([0.05, 0.05, heading_sigma])
    start = rng.normal(0, sigmas, (samples, 3))
    ends = sample_motion(start, [3.0, 0, 0], RobotModel(0.02, 0, 0), rng)
    A, Q = np.array([[1, 0, 0], [0, 1, 3.0], [0, 0, 1]]), np.diag([0.06, 0, 0]) ** 2
    P = (A @ np.diag(sigmas**2) @ A.T + Q)[:2, :2]
    off = ends[:, :2] - [3.0, 0.0]
    share = np.mean(np.sum(off @ np.linalg.inv(P) * off, axis=1) < 5.99)  # 95 % of a Gaussian
    return ends, P, share


# %% slideshow={"slide_type": "fragment"} answers="11-banana" tags=["folded"]
def banana(heading_sigma, samples):
    ends, P, share = driven(heading_sigma, samples)
    title = f"the ellipse holds {100 * share:.0f} % of the samples"
    ellipses = {"the samples' own covariance": np.cov(ends[:, :2].T)}
    fig, ax = views.cloud(ends, ellipses, title, size=(8, 5.6))
    views.draw(ax, Ellipses("naive", [[3, 0]], [P]), label="EKF, (11.2)", linewidth=2)
    ax.set(xlim=(-4, 6), ylim=(-4.2, 4.2), adjustable="box")
    views.legend(ax, loc="upper left")
    return fig


# %% slideshow={"slide_type": "subslide"} answers="11-banana"
views.explore(
    banana,
    lambda heading_sigma, samples: (
        f"{samples} samples on an arc, for a heading sigma of {heading_sigma:.2f} rad; the EKF's ellipse, upright at "
        f"the end of the straight way, holds {100 * driven(heading_sigma, samples)[2]:.0f} % of them."
    ),
    heading_sigma=(0.02, 1.5, 0.5),
    samples=(10, 3000, 1500),
)
share = driven(0.5, 1500)[2]

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-banana"
# The samples form a banana. The EKF's ellipse touches it where the heading is right, and holds
# {= 100 * share:.0f =} % of the samples where it claims 95. Its centre, at $x = 3$ m, is where the
# robot arrives if it looks exactly straight ahead; on average it gets only
# {= driven(0.5, 1500)[0][:, 0].mean():.2f =} m far, because every wrong heading shortens the way
# along $x$.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-banana"
# Now make the heading sharper: with $\sigma = 0.1$ the ellipse holds {= 100 * driven(0.1, 1500)[2]:.0f =} %, with
# 0.05 it holds {= 100 * driven(0.05, 1500)[2]:.0f =}. Then take fewer samples: a hundred still make a banana, and ten
# make a few scattered dots.
#
# So the cloud gets the shape right *if it has enough samples*, and the ellipse gets it right *if
# the heading is known well enough*.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## A room of two places
#
# What must happen to the samples when something is seen? We derive it where everything can be written down. A robot
# is in one of two rooms, 1 or 2. We are given what was believed, how it moves, and how likely each room lets it see
# what it saw.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
believed = dict(zip("12", sp.symbols("Bel_1 Bel_2", positive=True), strict=True))
sees = dict(zip("12", sp.symbols("see_1 see_2", positive=True), strict=True))
goes = {way: sp.Symbol(f"go_{way}", positive=True) for way in ("11", "12", "21", "22")}
story = {old + new: believed[old] * goes[old + new] * sees[new] for old, new in goes}
story["12"]

# %% [markdown] slideshow={"slide_type": "fragment"}
# This is the probability of one story: the robot *was* in room 1, *went* to room 2, and *saw* there what it saw.
# There are four such stories. It did see what it saw, so we divide by the sum of all four; and we add up those that
# end in room 2.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
total = sp.Symbol("total", positive=True)  # the sum of all four stories
sp.factor(story["12"] + story["22"]) / total

# %% [markdown] slideshow={"slide_type": "fragment"}
# Read it from the bracket outwards: move what was believed, then multiply by the likelihood of what
# was seen. If the robot can be not only in two rooms but anywhere, the sum becomes an integral:
#
# $$\mathrm{Bel}(x_k) \;\propto\; \Pr(z_k \mid x_k) \int \Pr(x_k \mid x_{k-1}, u_k)\,
# \mathrm{Bel}(x_{k-1})\, dx_{k-1}. \tag{11.3}$$
#
# ($\mathrm{Bel}(x_k)$ is the belief after step $k$, and $\Pr$ of a continuous quantity is its
# density. The factor that is left out is one over the sum of all stories. It makes the belief sum
# to one.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## The weight
#
# We *have* samples of the integral in (11.3): take samples of the old belief, and let each drive
# with noise. We *want* samples of the left side. We have drawn from one density and want another,
# so not all samples may count the same. A sample that was drawn twice as often as it should have
# been must count half:
#
# $$w_i \;\propto\; \frac{\text{density that is wanted, at } x_i}{\text{density that } x_i \text{ was drawn from, at }
# x_i}. \tag{11.4}$$
#
# This is **importance sampling**, and the density that we draw from is called the proposal. Let us see it on a line,
# before we use it.


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def normal(x, mean, sigma):
    return np.exp(-(((x - mean) / sigma) ** 2) / 2) / (np.sqrt(2 * np.pi) * sigma)


def on_a_line(drawn_mean, drawn_sigma):
    x = np.random.default_rng(1).normal(drawn_mean, drawn_sigma, 60)
    w = normal(x, 0, 1) / normal(x, drawn_mean, drawn_sigma)
    s, told = np.linspace(-5, 5, 200), f"mean {x.mean():.2f}, by weights {w @ x / w.sum():.2f}"
    hills = {"wanted": normal(s, 0, 1), "drawn from": normal(s, drawn_mean, drawn_sigma)}
    fig, ax = views.curves(s, hills, "x [1]", "density, weight [1]", told, size=(8, 4.4))
    ax.vlines(x, 0, 0.8 * w / w.max(), color=views.COLOURS["sample"], label="samples, by weight")
    ax.set(ylim=(0, 1.6))
    views.legend(ax, ncols=3, loc="upper center")
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    on_a_line,
    lambda drawn_mean, drawn_sigma: (
        f"Samples from a Gaussian of mean {drawn_mean:.1f} and sigma {drawn_sigma:.1f} as bars as high as their "
        "weights; the higher the wanted Gaussian is beside this one, the longer they are."
    ),
    drawn_mean=(-3.0, 3.0, 1.5),
    drawn_sigma=(0.3, 3.0, 1.5),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The samples were drawn too far to the right, and their weights correct that: the bars are long
# where the wanted hill is higher than the hill they came from. Make the hill that we draw from
# narrow, and move it to the side: then one or two samples carry all the weight, and the weighted
# mean is worth little. Weights can correct samples that exist; where none was drawn, there is
# nothing to weigh.

# %% slideshow={"slide_type": "subslide"}
ask(
    "11-weight",
    "Two samples end at equally good places: both explain the sighting equally well. One got there by a likely drive, the other by a "
    "drive that the wheels seldom make. **How should they weigh?**",
    {
        "the seldom one less": "seldom drives are drawn seldom. If they weighed less, too, they would be punished twice.",
        "both the same": "how likely a drive is shows in how many samples make it.",
        "the seldom one more": "it was drawn as seldom as it is wanted, so nothing has to be made up for.",
    },
    right="both the same",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="11-weight"
predicted, sees_z = sp.symbols("predicted sees_z", positive=True)
wanted, drawn_from = sees_z * predicted, predicted
wanted / drawn_from

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-weight"
# By (11.3) the wanted density is the predicted one times the likelihood, and we drew from the predicted one. It
# cancels:
#
# $$w_i \;\propto\; \Pr(z \mid x_i). \tag{11.5}$$
#
# **The weight is the likelihood and nothing else**, provided that the samples were moved by the noise of the wheels.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Programs that get this wrong still run. Ask how one would notice: it takes a
# comparison with a filter that is known to be exact.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-weight"
# ### Is that so?
#
# On a rail, with Gaussian noise, the Kalman filter is exact, so it can be the judge. A robot makes twelve steps of a
# metre, and measures its place after each. One cloud of 20 000 samples weighs by (11.5); the other one multiplies the
# density of the drive into the weight as well.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="11-weight"
zs = rail.measured(seed=1)
told = {}
for rule in (rail.RIGHT, rail.TWICE):
    told[rule] = rail.by_samples(zs, np.random.default_rng(2), 20_000, rule)
for name, noise in {"Kalman": rail.Q, "Kalman, half of Q": rail.Q / 2}.items():
    told[name] = rail.by_kalman(zs, noise)
for name, (mean, sigma) in told.items():
    print(f"{name:20} {mean:6.2f} m ± {100 * sigma:.1f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-weight"
# The cloud with the right weight agrees with the Kalman filter. The other one agrees with a Kalman filter that
# believes in *half the motion noise*: it is too sure of itself. (Why half? See the first *Deeper* section.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## What is a cloud worth?
#
# After weighing, some samples carry much and others hardly anything. The **effective sample size** says how many
# equal samples the cloud would be worth:
#
# $$n_{\mathrm{eff}} = \frac{1}{\sum_i w_i^2}. \tag{11.6}$$
#
# With $n$ equal weights it is $n$; if one sample carries everything, it is 1.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-worth",
    "A cloud of 500 samples is spread by half a metre. It sees one landmark, first with a sensor whose range is good to 30 cm, then with "
    "one that is good to 3 cm. **Which cloud is worth more samples afterwards?**",
    {
        "that of the better sensor": "the belief gets sharper. But the cloud is no denser than it was, and fewer of its samples fit.",
        "that of the worse sensor": "the fewer samples fit, the fewer carry the belief. A sensor can be too good for a cloud.",
        "both the same: 500": "there are 500 rows in both. But weights of nearly zero add nothing to a sum.",
    },
    right="that of the worse sensor",
)


# %% slideshow={"slide_type": "subslide"} answers="11-worth"
def weighed(range_sigma, samples):
    """A cloud that has seen one landmark."""
    rows = np.random.default_rng(6).normal(0, [0.5, 0.5, 0.1], (samples, 3))
    mark, R_one = np.array([[3.0, 1.0]]), np.diag([range_sigma, 0.05]) ** 2
    logs = likelihood.of_scan(rows, mark, models.h(np.zeros(3), mark), R_one[None])
    return ParticleSet(rows, normalise(logs)[0]), mark


# %% slideshow={"slide_type": "fragment"} answers="11-worth" tags=["folded"]
def worth(range_sigma, samples):
    cloud, mark = weighed(range_sigma, samples)
    layers = {"samples, area by weight": Samples("sample", cloud.rows, cloud.weights)}
    layers |= {"landmark": Points("landmark", mark), "true robot": Poses("truth", np.zeros(3))}
    title = f"worth {cloud.effective_sample_size:.0f} of {samples} samples"
    fig, ax = views.axes(title, size=(8, 5))
    for label, layer in layers.items():
        views.draw(ax, layer, label=label)
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"} answers="11-worth"
views.explore(
    worth,
    lambda range_sigma, samples: (
        f"{samples} samples round the robot, worth {weighed(range_sigma, samples)[0].effective_sample_size:.0f} after a "
        f"sighting whose range is good to {100 * range_sigma:.0f} cm; the better one fits it, the larger it is."
    ),
    range_sigma=(0.01, 0.5, 0.03),
    samples=(50, 3000, 500),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-worth"
# With a range good to 3 cm only a thin arc of samples is left, worth
# {= weighed(0.03, 500)[0].effective_sample_size:.0f =} of the 500. With 30 cm the cloud is worth
# {= weighed(0.3, 500)[0].effective_sample_size:.0f =}. So we either take more samples, or draw them
# where the sighting puts the robot, and correct for that by (11.4). The exercise does the latter.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Weights that are all zero
#
# One landmark was seen. A lidar sees hundreds of things, and the likelihoods of independent sightings multiply. Let a
# good sensor (5 cm, 1°) see twenty landmarks, and let three samples be half a metre off. What is their likelihood?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(4)
places, R_fine = rng.uniform(-8, 8, (20, 2)), np.diag([0.05, np.radians(1)]) ** 2
z = models.h(np.zeros(3), places) + rng.multivariate_normal([0, 0], R_fine, 20)
off = np.array([[0.5, 0, 0], [0.5002, 0, 0], [0.5, 0, 0.0001]])
logs = likelihood.of_scan(off, places, z, np.tile(R_fine, (20, 1, 1)))
print("logarithms of the likelihoods:", logs.round(1), "  likelihoods:", np.exp(logs))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Below about $e^{-745}$ a float is zero. All three likelihoods are, and 0/0 is no weight. The same
# would happen to every sample of a cloud that is a little off, and the whole cloud would be lost.

# %% [markdown] slideshow={"slide_type": "subslide"}
# But only ratios matter. So we keep the logarithms $\ell_i$ of the likelihoods, and take the largest one out before
# we compute any exponential:
#
# $$w_i = \frac{e^{\ell_i}}{\sum_j e^{\ell_j}} = \frac{e^{\ell_i - \max \ell}}{\sum_j e^{\ell_j - \max \ell}}. \tag{11.7}$$
#
# The largest term is now $e^0 = 1$, so the sum cannot be zero. The package does it in `normalise`:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print("weights             ", normalise(logs)[0].round(4))
print("all lower by 100 000", normalise(logs - 1e5)[0].round(4))

# %% [markdown] slideshow={"slide_type": "fragment"}
# All three samples are wrong, but the one that is a little less wrong has the largest weight. From
# there the cloud can move on towards the truth.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Drawing anew: tickets or a comb
#
# Samples that weigh next to nothing cost time and tell us nothing. So we draw $n$ new samples from
# the old ones, sample $i$ with the probability $w_i$: the good ones are copied, the bad ones
# vanish, and all weights are equal again. This is **resampling**. Lay the weights end to end on a
# rod. There are two ways to draw:
#
# - **tickets** (multinomial): $n$ random numbers, and each picks the piece on which it falls;
# - **a comb** (systematic): $n$ teeth at equal distances, and *one* random number that shifts them
#   all.


# %% slideshow={"slide_type": "subslide"}
w8 = np.array([0.28, 0.05, 0.17, 0.02, 0.12, 0.21, 0.04, 0.11])


def rod(shift_of_the_comb, seed_of_the_tickets):
    tickets = np.sort(np.random.default_rng(seed_of_the_tickets).random(8))
    copies = np.sum(systematic_at(w8, 8, shift_of_the_comb) == 0), np.sum(tickets < w8[0])
    told = "copies of sample 0: {} by the comb, {} by tickets".format(*copies)
    picks = {"comb": np.linspace(0, 0.875, 8) + shift_of_the_comb / 8, "tickets": tickets}
    return views.wheel(w8, picks, told, size=(9, 3.6))[0]


# %% slideshow={"slide_type": "fragment"}
views.explore(
    rod,
    lambda shift_of_the_comb, seed_of_the_tickets: (
        f"A rod of eight weights; the comb's teeth stand evenly over it, shifted by {shift_of_the_comb:.2f} of their "
        f"distance; the tickets of seed {seed_of_the_tickets} stand where chance has put them."
    ),
    shift_of_the_comb=(0.0, 0.99, 0.3),
    seed_of_the_tickets=(1, 40, 3),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Shift the comb from one end to the other. Sample 0 asks for $8 \cdot 0.28 = 2.24$ copies, and gets
# 2 or 3, never fewer and never more. With tickets it may get any number, and a good sample may be
# left out.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
variance = {}
for name, draw in {"tickets": multinomial, "comb": systematic}.items():
    rngs = (np.random.default_rng(seed) for seed in range(4000))
    copies = np.array([np.bincount(draw(w8, 8, rng), minlength=8) for rng in rngs])
    variance[name] = copies.var(axis=0)
    print(f"{name:8} mean copies {copies.mean(axis=0).round(2)}")
for name, each in variance.items():
    print(f"{name:8} variance    {each.round(2)}")
ratio = variance["comb"] / variance["tickets"]

# %% [markdown] slideshow={"slide_type": "fragment"}
# Both are fair on average. The comb's variance is smaller for each of these eight samples: from
# {= ratio.min():.2f =} to {= ratio.max():.2f =} of that of the tickets, and
# {= variance["comb"].sum() / variance["tickets"].sum():.2f =} for all together. It gains little
# where a sample asks for much less than one copy, because either way that sample then gets one copy
# or none.
#
# Every drawing also loses samples for good. So the filter draws only when it pays: if $n_{\mathrm{eff}}$ falls below
# $n/2$.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## All of it
#
# This is **Monte Carlo localisation**: move every sample with noise of its own, weigh it by the
# likelihood, and draw anew when few samples carry the belief. The package has it as `MCL`. If it is
# told which corner is which, it finds the robot soon:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng, truth = np.random.default_rng(8), START
mcl = MCL(uniform(5000, LOW, HIGH, rng), CORNERS, rng)
for _ in range(10):
    truth = compose(truth, STEP)
    mcl.predict(STEP, WHEELS)
    mcl.update(models.h(truth, CORNERS) + rng.multivariate_normal([0, 0], R, 4), R, ids=range(4))
error = np.hypot(*(mcl.cloud.moments.x - truth)[:2])
print(f"10 steps with names: off by {100 * error:.0f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In the first section the corners had no names. Then, for each sample, a sighting may be of any of
# the $N$ things in the map, all equally likely, and the sample's likelihood is the mean over all of
# them:
#
# $$\Pr(z \mid x_i) = \frac{1}{N} \sum_{j=1}^{N} \Pr(z \mid x_i, p_j). \tag{11.8}$$
#
# Every sample has its own opinion about which corner is seen, and wrong opinions die out with their
# samples. No association is ever decided for the whole cloud.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Carried off
#
# After 25 steps somebody lifts the robot and sets it down elsewhere in the room, at least 2.5 m away. (The post is
# now seen from everywhere.) A cloud of 500 samples has followed it until then. This is the problem of the **kidnapped
# robot**, and to find it again is called relocalisation.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-carried",
    "**What does the cloud do in the 35 steps that follow?**",
    {
        "it spreads until it holds the robot again": "a sample moves by what the wheels say, and a little noise. Nothing in the "
        "step spreads a cloud because it is wrong.",
        "it stays wrong, mostly": "copies of samples that are elsewhere are elsewhere, too. Only what is in the cloud can multiply.",
        "it says that it is lost": "weights are made to sum up to one. The least bad sample is the best, however bad it is.",
    },
    right="it stays wrong, mostly",
)


# %% slideshow={"slide_type": "subslide"} answers="11-carried" tags=["folded"]
@cache
def errors_of(strangers, seed):
    """How far the cloud's mean is off, after each of 60 steps."""
    pictures = film(500, seed, 60, reach=9.0, strangers=strangers, carried=25)
    return [np.hypot(*(cloud.moments.x - truth)[:2]) for cloud, truth in pictures]


def carried_off(strangers, drive):
    curves = {f"{strangers} strangers in every step": errors_of(strangers, drive)}
    curves |= {"no strangers": errors_of(0, drive)}
    fig, ax = views.curves(np.arange(61), curves, "step", "error [m]", size=(8, 4.2))
    ax.axvline(25.5, color=views.COLOURS["limit"], linestyle="dashdot", label="carried off")
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="11-carried"
views.explore(
    carried_off,
    lambda strangers, drive: (
        f"The error of the mean: {errors_of(0, drive)[-1]:.1f} m at the end without strangers, "
        f"{errors_of(strangers, drive)[-1]:.1f} m with {strangers} of them in every step."
    ),
    strangers=(1, 250, 50),
    drive=(0, 20, 2),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-carried"
# Without strangers there is usually no sample where the robot is, and no way to get one. The cure:
# in every step, some samples are replaced by **strangers**, poses thrown anywhere into the room. If
# one of them explains what is seen much better than the others do, it is copied many times.

# %% slideshow={"slide_type": "subslide"} answers="11-carried"
again = {f"{k} strangers": share["found"] for k, share in many["strangers"].items()}
fig, _ = views.shares({"found": again}, f"share of {runs} drives found again", size=(8, 3.8))
price = {k: row["error before"] for k, row in many["strangers"].items()}  # [m]
shown = ", ".join(f"with {name} in {100 * share[0]:.0f} %" for name, share in again.items())
views.show(fig, f"The robot is found again {shown} of the drives.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-carried"
# Without strangers {= 100 * again["0 strangers"][0]:.0f =} % of the robots were found again. With 5 strangers in
# every step it was {= 100 * again["5 strangers"][0]:.0f =} %, with 25 it was {= 100 * again["25 strangers"][0]:.0f =}
# %, and with 50, a tenth of the samples, it was {= 100 * again["50 strangers"][0]:.0f =} %.
#
# Strangers replace samples that follow the robot, so we expect them to cost accuracy. In this room
# no such cost can be seen: before the robot was carried off, the mean was off by
# {= 100 * price["0"][0]:.0f =} cm without strangers (median of the drives), by
# {= 100 * price["50"][0]:.0f =} cm with 50, and by {= 100 * price["250"][0]:.0f =} cm with 250. The
# room of the exercise is larger, so there a stranger hits the right pose less often.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Standing still
#
# The same loss happens slowly to a robot that does not move. Each drawing loses samples, and without motion there is
# no noise that makes new ones. We count how many different samples are left of 1000:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(9)
mcl, left = MCL(ParticleSet.unweighted(rng.normal(0, [0.3, 0.3, 0.1], (1000, 3))), CORNERS, rng), {}
for look in range(1, 61):
    z = models.h(np.zeros(3), CORNERS) + rng.multivariate_normal([0, 0], R, 4)
    mcl.update(z, R, ids=range(4))
    left[look] = len(np.unique(mcl.cloud.rows, axis=0))
print("different samples after", {look: left[look] for look in (1, 5, 20, 60)})

# %% [markdown] slideshow={"slide_type": "fragment"}
# This is called **impoverishment**. A cloud that has made up its mind cannot change it. A filter
# can add a little noise to samples that do not move, which is called roughening. In part two the
# package does so. *This is a good place for a break.*

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A good place to end the first lecture. Homework: would you add strangers if you knew that nobody
# carries robots? (They also mend a wrong start.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Part two: and the map?
#
# SLAM asks for the landmarks as well. (This part calls them objects.) Why not take samples of everything at once: of
# the pose, three numbers, and of $N$ objects, two numbers each?

# %% [markdown] slideshow={"slide_type": "fragment"}
# Say that ten samples in a row are enough for one number. For the pose alone it takes
# $10 \cdot 10 \cdot 10$ of them, because one sample sets all three numbers at once. Each further
# number asks for ten times as many. With ten objects there are 23 numbers, and it takes $10^{23}$
# samples.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### One set for each
#
# The MAK thesis has a way out, its algorithm 2: *one set of samples for the robot, and one for each object.* A
# thousand for the pose and 300 for every object, however many there are.
#
# But to weigh a sample of the robot we need to know where the object is, and to weigh a sample of
# the object we need to know where the robot is. We know neither. So whenever another place is
# needed, the algorithm takes **random samples of its set**.

# %% [markdown] slideshow={"slide_type": "subslide"}
# With $m$ such partners $p_1, \ldots, p_m$, drawn anew for every sample $x_i$ of the robot, its weight is the mean
#
# $$w_i \;\propto\; \frac{1}{m} \sum_{j=1}^{m} \Pr(z \mid x_i, p_j), \tag{11.9}$$
#
# and the other way round for the object's samples. The thesis takes one partner; the package takes ten, for less
# noise. A new object's samples stand where random poses would have seen it. We drive a simulated lap among ten
# objects.

# %% slideshow={"slide_type": "subslide"}
lap = sets_apart.lap(12)
slam, pictures = montecarlo(lap), {}
for k, reading in enumerate(lap):
    slam.step(reading)
    pictures[k] = slam.layers()
way_off = np.hypot(*(slam.pose - lap.truth.poses[-1])[:2])
rows = [slam.filter.ids.index(i) for i in slam.filter.frozen]
misses = slam.filter.landmarks()[rows] - lap.landmarks[list(slam.filter.frozen)]
beside = np.hypot(*misses.T).mean()


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def sets_after(readings):
    names = "sets of objects", "frozen objects", "believed way", "set of the robot"
    layers = {"true way": Poses("truth", lap.truth.poses[: readings + 1])}
    layers |= dict(zip(names, pictures[readings], strict=True))
    fig, ax = views.axes(f"After {readings} readings", size=(9, 6))
    squares = {"frozen objects": {"marker": "s", "markersize": 7}}
    for label, layer in layers.items():
        views.draw(ax, layer, label=label, **squares.get(label, {}))
    crosses = {"marker": "+", "markersize": 12, "mew": 1.5, "label": "true objects"}
    views.draw(ax, Points("truth", lap.landmarks), **crosses)
    ax.set(xlim=(-7.5, 7.5), ylim=(-2.5, 10.5), adjustable="box")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"}
views.explore(
    sets_after,
    lambda readings: (
        f"The true and the believed way after {readings} of {len(lap) - 1} readings; clouds of samples of the objects "
        f"seen so far, beside the crosses of the true ones; frozen to points: {len(pictures[readings][1].xy)}."
    ),
    play="readings",
    readings=(0, len(lap) - 1, 52),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Every object is a cloud. At first it is as wide as the robot's doubt and the sensor's together,
# and it shrinks while the object is seen. Press ▶ and look where the crosses are. The clouds shrink
# *beside* them: when the last sample of an object lies within 5 cm of the mean, the object is
# frozen to a point, and the frozen ones are {= 100 * beside:.0f =} cm off on average. The robot
# believes them, and its way ends {= 100 * way_off:.0f =} cm from the true one.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## What do the sets forget?
#
# The robot's place is in doubt by 30 cm along its way. It measures to 5 cm how far ahead an object
# is, and from this the object's set is made. From then on the two sets are kept apart.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class recall lesson 07 first: what did the block of $P$ between robot and landmark do?
# Then ask where in two sets of samples such a thing could be written down.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-forget",
    "**How well do the two sets, kept apart, still know the range between robot and object?**",
    {
        "to 5 cm: it has just been measured": "each pair did know it, but nobody keeps the pairs. A random partner is a "
        "wrong partner.",
        "to some 30 cm, the robot's doubt": "the object's set has inherited the same 30 cm, and the two no longer go together.",
        "to more than 40 cm": "two doubts of 30 cm that nothing ties together make 30 cm times the root of two.",
    },
    right="to more than 40 cm",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="11-forget"
rng = np.random.default_rng(13)
poses = rng.normal(0, [0.3, 0.3, 0.0], (5000, 3))
seen = models.g(poses, np.array([2.0, 0.0]) + rng.normal(0, [0.05, 0.02], (5000, 2)))
known = {}
for name, places in {"as they were made": seen, "random partners": rng.permutation(seen)}.items():
    known[name] = 100 * models.h(poses, places)[:, 0].std()
    together = np.corrcoef(poses[:, 0], places[:, 0])[0, 1]
    print(f"{name:18} range known to {known[name]:2.0f} cm, correlation {together:5.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-forget"
# A robot sample that stands 30 cm too far back is now paired with an object sample that was made
# from a robot 30 cm too far ahead. So the range, known to {= known["as they were made"]:.0f =} cm,
# is now known to {= known["random partners"]:.0f =}. Each set by itself is as good as before. What
# they knew *together* is gone. It is the block $P_{\mathrm{r}i}$ of lesson 07, once more.
#
# And with every reading the two sets learn from each other as if their errors were independent.
# Lesson 07 has shown what this leads to: a belief that is too sure.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-forget"
# Is it? We drive {= runs =} laps, with the wheels alone, with the EKF of lesson 06, and with sets. How far off are
# they (the root mean square of the position's error along the way, the absolute trajectory error), and how often is
# the true pose outside of the region that should hold it 95 times in 100?

# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"] answers="11-forget"
maps = many["maps"]


def row(name):
    """A line of the table: the error, that minus odometry's on the same lap, how often outside."""
    found = maps[name]
    line = f"{name:22} {100 * found['rms'][0]:3.0f} cm"
    if "outside" in found:
        more, outside = found["against odometry"][0], found["outside"][0]
        line += f" {100 * more:+14.0f} cm {100 * outside:7.0f} %"
    print(line)


worse = maps[sets_apart.SETS]["against EKF"]  # [m]
HEAD = f"{f'median of {runs} laps':22}  error  minus odometry's  outside"
print(HEAD)
for name in (sets_apart.WHEELS, sets_apart.EKF, sets_apart.SETS, sets_apart.ONE):
    row(name)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-forget"
# Both filters beat the wheels. The sets err somewhat more than the EKF: on the same lap by {= 100 * worse[0]:.0f =}
# cm in the median of the differences, which is not the difference of the medians (95 % interval {= 100 * worse[1]:.0f =} to {= 100 * worse[2]:.0f =} cm). But what they *say* of
# their error is worth nothing. An honest filter has the true pose outside of its region in 5 % of the readings. With
# the EKF it is {= 100 * maps["EKF"]["outside"][0]:.0f =} %, with sets {= 100 * maps["sets"]["outside"][0]:.0f =} %,
# and more partners change little.
#
# Samples as such are not to blame for that. It is the price of keeping the sets apart.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Objects that nobody looks at
#
# Algorithm 2 as it stands draws *every* set anew in *every* step, whether the object has been seen or not. Take an
# object that is out of sight for long: all its samples keep the same weight.

# %% slideshow={"slide_type": "fragment"}
ask(
    "11-unseen",
    "Nothing is learned about the object, and its set is drawn anew, by tickets, 300 times. **What becomes of the set?**",
    {
        "nothing: the draws are fair": "they are fair on average. A walk by the toss of a coin is fair on average, too, and leads away.",
        "it gets wider, since nothing is learned": "copies stand where their parents stand. Drawing never widens a set.",
        "its mean walks away, and it gets narrower": "every draw loses some samples by chance. The mean of those that are left is another one, "
        "and they are spread less.",
    },
    right="its mean walks away, and it gets narrower",
)


# %% slideshow={"slide_type": "subslide"} answers="11-unseen" tags=["folded"]
@cache
def unseen(samples):
    return sets_apart.drawn_anew(samples, 300, 0.1, np.random.default_rng(14))


def drift(samples):
    draws, (walked, claimed) = np.arange(1, 301), unseen(samples)
    lines = {"what the set claims": claimed, "how far its mean has walked": walked}
    lines["(11.10)"] = np.sqrt(2 * 0.1**2 * (1 - (1 - 1 / samples) ** draws))
    told = f"{samples} samples, drawn anew 300 times"
    fig, ax = views.curves(draws, lines, "draws", "root mean square [m]", told, size=(8, 4.2))
    views.legend(ax, loc="lower right")
    return fig


# %% slideshow={"slide_type": "fragment"} answers="11-unseen"
views.explore(
    drift,
    lambda samples: (
        f"Sets of {samples} samples, drawn anew: at the end the mean has walked {unseen(samples)[0][-1]:.3f} m "
        f"and the set claims {unseen(samples)[1][-1]:.3f} m."
    ),
    samples=(50, 600, 300),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="11-unseen"
# The mean walks, and the set gets surer of itself. Each draw takes the share $1/n$ of the variance and turns it into
# error. If a set has the variance $\sigma^2$ at first, in $x$ and in $y$ together, the mean square of the mean's way
# after $k$ draws is
#
# $$\mathrm{E}\, |\bar x_k - \bar x_0|^2 = \left(1 - \left(1 - \tfrac1n\right)^k\right) \sigma^2, \tag{11.10}$$
#
# which is the dotted curve of the picture. (The second *Deeper* section derives it.) Biologists call it genetic drift.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="11-unseen"
# You have seen drift before: the two clusters of the first section were such a population, since
# hardly anything that was seen told them apart. When the cloud was small, one of them drifted to
# zero.
#
# There are two cures, and the package uses both: it does not draw the set of an object that was not
# seen, and it draws by a comb, which returns each of $n$ equal samples exactly once.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Freezing
#
# The thesis has a third cure: if *all* samples of an object lie close together, take their mean for
# the truth from then on. The object becomes a point. Nothing is left to draw, so nothing can drift,
# and there is less to compute. But how close is close enough?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print(HEAD)
for name in (sets_apart.SETS, *sets_apart.FROZEN.values()):
    row(name)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Frozen at 10 cm, the sets do as well and as badly as before. Frozen at 80 cm, they err by
# {= 100 * maps[sets_apart.FROZEN[0.8]]["rms"][0]:.0f =} cm instead of
# {= 100 * maps[sets_apart.SETS]["rms"][0]:.0f =}: an object that is frozen early keeps the error that it has then,
# and from then on the robot believes it. The thesis gives no number; the package waits for 5 cm.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Samples where they are needed
#
# Lesson 05: if the robot's poses are *known*, the objects are independent of one another, and each needs a little
# Kalman filter of its own. Now look at one sample of the robot. With its ancestors it is a whole **way**, a guess of
# all poses. Given the way $x_{1:k}$, the objects $p_1, \ldots, p_N$ are independent, so no cross terms are missing:
#
# $$\mathrm{Bel}(x_{1:k}, p_1, \ldots, p_N) = \mathrm{Bel}(x_{1:k}) \prod_{j=1}^{N} \mathrm{Bel}(p_j \mid x_{1:k}). \tag{11.11}$$
#
# So take samples of the way, and give **each sample a map of its own**, made of little Kalman filters. What the
# samples have in common, and where they differ, *is* the correlation. The filter is called FastSLAM.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
print(HEAD)
for name in (sets_apart.EKF, sets_apart.SETS, *sets_apart.FAST.values()):
    row(name)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With 1000 samples FastSLAM errs about as much as the EKF, and the true pose is outside in
# {= 100 * maps[sets_apart.FAST[1000]]["outside"][0]:.0f =} % of the readings instead of the
# {= 100 * maps["sets"]["outside"][0]:.0f =} of the sets: the correlations are back. It is still
# surer than it should be, and with 100 samples much more so
# ({= 100 * maps[sets_apart.FAST[100]]["outside"][0]:.0f =} %). Each drawing leaves fewer different
# beginnings of the way, and when the loop closes, the filter can only choose among those that are
# left. This is impoverishment again.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# N. J. Gordon, D. J. Salmond and A. F. M. Smith, "Novel approach to nonlinear/non-Gaussian Bayesian state
# estimation", *IEE Proceedings F* 140(2), 1993: the filter of samples that are moved, weighed and drawn anew.
#
# F. Dellaert, D. Fox, W. Burgard and S. Thrun, "Monte Carlo localization for mobile robots", *IEEE International
# Conference on Robotics and Automation*, 1999: a robot that finds itself in a known map.
#
# J. S. Liu and R. Chen, "Sequential Monte Carlo methods for dynamic systems", *Journal of the American Statistical
# Association* 93(443), 1998: when to draw anew.
#
# M. Montemerlo, S. Thrun, D. Koller and B. Wegbreit, "FastSLAM: a factored solution to the simultaneous localization
# and mapping problem", *AAAI*, 2002: samples of ways, each with a map of its own.
#
# **Read next:** S. Thrun, W. Burgard and D. Fox, *Probabilistic Robotics*, MIT Press, 2005, chapters 4 and 8.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## What you can do now
#
# | what | how |
# | --- | --- |
# | move | every sample, each with noise of its own |
# | weigh | by the likelihood alone, in logarithms, the largest taken out |
# | draw | by weight, with a comb, when $n_{\mathrm{eff}} < n/2$ |
# | clouds are good at | bent beliefs, several hills, sightings without names |
# | and bad at | sharp sensors, many dimensions, changing their mind |
# | sets with random partners | cheap, and far too sure of themselves |
#
# **What comes next:** in [lesson 12](12_three_filters.ipynb) boxes, ellipses and samples drive the same robot.
#
# The sections below this one are optional.
#
# **Exercise:** [11 · Samples](../exercises/ex11_samples.ipynb). You weigh, draw and localise,
# correct for samples that were drawn from the wrong density, and find a robot again that somebody
# carried off.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: why half the noise?
#
# In "The weight", a cloud that multiplied the density of the drive into its weights behaved like a Kalman filter with
# half of $Q$. Samples are drawn by that density, and then weighed by it once more, so it counts squared. What is the
# square of a Gaussian?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
q, Q = sp.symbols("q Q", positive=True)
hill = sp.exp(-(q**2) / (2 * Q))
sp.simplify(hill**2 / hill.subs(Q, Q / 2))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The quotient is 1: the square of a Gaussian of variance $Q$ is, but for its height, a Gaussian of
# variance $Q/2$. So the mistake is not a small one: a filter that makes it takes the wheels'
# $\sigma$ to be smaller by the root of two than it is.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: what a draw does to a set
#
# Draw $n$ times, independently, from $n$ equal samples with the variance $\sigma_k^2$ (divided by
# $n$, not by $n - 1$). The mean of the draws has the variance $\sigma_k^2/n$ round the mean of the
# samples. That is the step of the walk. By just as much, the spread of the draws round *their own*
# mean is smaller,
#
# $$\mathrm{E}\,\sigma_{k+1}^2 = \left(1 - \tfrac1n\right) \sigma_k^2, \tag{11.12}$$
#
# so that step and spread together are what the spread was. The walk's steps are uncorrelated, their variances add up
# to a geometric series, and that is (11.10). Two samples show it exactly, for there are only four ways to draw:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
one, other = sp.symbols("x_1 x_2", real=True)
ways = [(one, one), (one, other), (other, one), (other, other)]
spread = [sum((x - sum(way) / 2) ** 2 for x in way) / 2 for way in ways]
sp.simplify(sum(spread) / 4 / spread[1])

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print
#
# Optional: what the MAK thesis prints of its algorithms, in its section 5.3, and what comes of it.
#
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | 5.3.2, algorithm 1 | "the sample with the largest weight" | draw by weight | the cloud is no belief |
# | algorithm 1, steps 2 and 4 | $\Pr(x_k \mid x_{k-1}, u_k)$ in the weight | (11.5) | half the motion noise |
# | 5.3.2, Bayes | the last observation is missing on the left side | (11.3) | none |
#
# The thesis' own text says "by its weight", and in the last row an index may have been lost in printing.


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
for rule in (rail.RIGHT, rail.TWICE, rail.LARGEST):
    mean, sigma = rail.by_samples(zs, np.random.default_rng(2), 20_000, rule)
    print(f"{rule:20} {mean:6.2f} m ± {100 * sigma:4.1f} cm")
largest, right = (mean, sigma), rail.by_kalman(zs)
print(f"{'Kalman':20} {right[0]:6.2f} m ± {100 * right[1]:4.1f} cm")
bel_2 = (story["12"] + story["22"]) / sum(story.values())
print("the belief depends on what was just seen:", sp.simplify(bel_2.diff(sees["2"])) != 0)

# %% [markdown] slideshow={"slide_type": "fragment"}
# If all samples go on from the one with the largest weight, all that was believed before is thrown
# away except for one point. On this drive its mean is {= 100 * abs(largest[0] - right[0]):.0f =} cm
# off that of the Kalman filter, whose $\sigma$ is {= 100 * right[1]:.0f =} cm, and it claims
# {= 100 * largest[1]:.0f =} cm. The last row harms nobody who derives (11.3), for the belief must
# depend on what was just seen.
