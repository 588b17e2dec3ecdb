# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 06 · EKF-SLAM: the MAK filter
#
# **You will be able to** build EKF-SLAM from its three steps, say for every block of its covariance
# where it comes from, watch a whole map learn when a loop closes, and tell when the filter stops
# being honest.
#
# **60 minutes. Before:** lessons [03](03_kalman_filter.ipynb) (update, NEES),
# [04](04_models_and_jacobians.ipynb) (the models $f$, $h$, $g$ and their Jacobians) and
# [05](05_two_easy_halves.ipynb) (two halves that cannot take turns).
#
# *Key:* one state, one covariance: what robot and map have in common is kept.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The first half builds the filter. Derive its three steps in front of the class
# with block matrices, and let them name each block before it appears. The second half drives it round
# a loop. If time is short, leave out "One lie" and "News that no sensor brings". MAK stands for
# map-augmented Kalman filter; elsewhere it is called EKF-SLAM. For a poll: the questions on the second
# look, on strangers, and on the ellipses at the closing.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from dataclasses import replace
from functools import lru_cache

import numpy as np
import sympy as sp

from slamlab import models, views
from slamlab.checks import ask
from slamlab.derivation import blockwise, derive, symmetric
from slamlab.estimators import run
from slamlab.estimators.mak_slam import MakSlam, predict
from slamlab.evaluation import band, correlation, nees
from slamlab.filters import MAK
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from slamlab.studies import broken_slam, consistency, two_halves

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## A second look
#
# A robot does not quite know where it is: its position is off by $\sigma = 0.15$ m, its heading by
# 0.08 rad. It sees a landmark 5 m away for the first time and enters it into its map. A moment later,
# without having moved, it looks again.
#
# How far will the second sight be from what the robot expects? The sensor's bearings err by 0.02 rad,
# and the robot's heading by four times as much.

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-second",
    "A robot with a heading off by **0.08 rad** placed a landmark and looks again. Its sensor's "
    "bearings are off by **0.02 rad**. How large is the innovation of the second bearing?",
    {
        "about 0.08 rad: as large as the heading's error": "the robot expects the landmark where it "
        "put it, and it put it there with this very heading. The error cancels.",
        "about 0.03 rad: as large as two errors of the sensor": "one for each look; the robot's own "
        "error is in the landmark as well, and the difference does not show it.",
        "zero: the robot has not moved": "it would be zero if the sensor did not err.",
    },
    right="about 0.03 rad: as large as two errors of the sensor",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A thousand robots look twice
#
# We let 1000 robots do it. They all believe the same pose, and each is really somewhere else. Beside
# them we ask two filters what innovation they expect. One keeps $P_{\mathrm ri}$, the covariance between
# the errors of robot and landmark; the other has thrown it away.

# %% slideshow={"slide_type": "fragment"}
BELIEVED, SEEN = np.array([0, 0, 0.4]), np.array([5.0, 0.8])
R = np.diag([0.1, 0.02]) ** 2


def innovations(P_rr):
    """Innovations (1000, 2) of the second look, of robots that are really off by P_rr."""
    rng = np.random.default_rng(6)
    poses = rng.multivariate_normal(BELIEVED, P_rr, 1000)
    first, second = rng.multivariate_normal([0, 0], R, (2, 1000))
    landmarks = models.g(poses, SEEN - first)
    v = models.h(poses, landmarks) + second - models.h(BELIEVED, models.g(BELIEVED, SEEN))
    return np.column_stack([v[:, 0], wrap(v[:, 1])])


# %% slideshow={"slide_type": "fragment"}
def expected(P_rr):
    """The covariance S of that innovation: without the robot's share in the landmark, and with it."""
    mak = MAK(BELIEVED, P_rr)
    mak.add(["a"], [SEEN], R)
    apart = mak.P
    apart[:3, 3:] = apart[3:, :3] = 0
    step = mak.update(["a"], [SEEN], R)
    return step.H @ apart @ step.H.T + R, step.S


# %% slideshow={"slide_type": "subslide"} answers="06-second" tags=["folded"]
def second_look(place_sigma, heading_sigma):
    P_rr = np.diag([place_sigma, place_sigma, heading_sigma]) ** 2
    v, (apart, together) = innovations(P_rr), expected(P_rr)
    fig, ax = views.chart("innovation of the range [m]", "innovation of the bearing [rad]")
    fig.set_size_inches(7, 4)
    layers = {
        "1000 robots": Points("sample", v),
        "without $P_{ri}$": Ellipses("naive", [[0, 0]], [apart]),
        "with $P_{ri}$": Ellipses("corrected", [[0, 0]], [together]),
    }
    for label, layer in layers.items():
        views.draw(ax, layer, linewidth=2, label=label)
    ax.set(xlim=(-1.5, 1.5), ylim=(-0.5, 0.5))
    views.legend(ax, loc="upper right")
    return fig


views.explore(
    second_look,
    lambda place_sigma, heading_sigma: (
        f"With a doubt of {place_sigma:.2f} m and {heading_sigma:.2f} rad the robots' innovations "
        "stay as small as the sensor's noise and fill the ellipse of the filter with P_ri; the one "
        "without it grows with the doubt."
    ),
    place_sigma=(0.0, 0.3, 0.15),
    heading_sigma=(0.0, 0.15, 0.08),
)
P_doubt = np.diag([0.15, 0.15, 0.08]) ** 2
sigma_seen = innovations(P_doubt)[:, 1].std()
sigma_apart, sigma_together = (np.sqrt(S[1, 1]) for S in expected(P_doubt))

# %% [markdown] slideshow={"slide_type": "subslide"} answers="06-second"
# The innovations of the 1000 robots' bearings scatter by {= sigma_seen:.3f =} rad. The filter that
# keeps $P_{\mathrm ri}$ expects {= sigma_together:.3f =} rad, the other one {= sigma_apart:.3f =}.
# Move the sliders: however wrong the robots are, their innovations stay as small, because each
# landmark is misplaced *with* its robot.
#
# The filter without $P_{\mathrm ri}$ gets an innovation far smaller than it expected, and concludes
# that its pose must be good. It has learned nothing of the kind. That is what became of lesson 05's
# careful student.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Say it with a boat. You are lost at sea, you throw a buoy overboard and measure how
# far away it is. However often you measure, you will not find out where you are.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## One state for robot and map
#
# An innovation depends on the robot's error *and* on the landmark's, and also on what the two errors have in
# common (05.2). No filter for the robot alone holds that, and no filter for the landmark. So we put
# everything that is unknown into **one** state, with one covariance:
#
# $$x = \begin{bmatrix} x_{\mathrm r} \\ p_1 \\ \vdots \\ p_N \end{bmatrix}, \qquad
# P = \begin{bmatrix} P_{\mathrm{rr}} & P_{\mathrm r1} & \cdots & P_{\mathrm rN} \\
# P_{1\mathrm r} & P_{11} & \cdots & P_{1N} \\ \vdots & \vdots & \ddots & \vdots \\
# P_{N\mathrm r} & P_{N1} & \cdots & P_{NN} \end{bmatrix}. \tag{06.1}$$
#
# The MAK thesis calls this the *map-augmented* Kalman filter. It has $3 + 2N$ numbers in its state, and in $P$
# the square of that.

# %% [markdown] slideshow={"slide_type": "subslide"}
# Now the innovation depends on the error of *the state* and on the sensor's noise, and on nothing else.
# That is all lesson 03 asked for, so its filter can be used as it is. We only have to say what its
# matrices look like in each of three steps:
#
# | step | when | what it does to the state |
# | --- | --- | --- |
# | **predict** | the robot has moved | changes the robot's three numbers |
# | **augment** | a landmark is seen for the first time | appends two numbers |
# | **update** | a landmark is seen again | corrects all numbers |

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The three in pictures

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
STARS = np.array([[1.2, 1.6], [2.6, 1.9], [3.6, 0.6], [2.4, -0.9]])
rng, R_STAR = np.random.default_rng(1), np.diag([0.1, 0.04]) ** 2
WAYS = {"truth": np.array([1.3, -0.1, 0.0]), "predicted": np.array([1.3, 0.25, 0.2])}
seen = [models.h(pose, STARS) for pose in (np.zeros(3), WAYS["truth"])]
seen = [z + rng.multivariate_normal([0, 0], R_STAR, len(STARS)) for z in seen]
one = MAK(np.zeros(3), np.zeros((3, 3)))
one.add(range(4), seen[0], R_STAR)
maps = [one.landmarks()]
one.predict(WAYS["predicted"], np.diag([0.2, 0.3, 0.15]) ** 2)
one.update(range(4), seen[1], R_STAR)
maps.append(one.landmarks())
still_off = 100 * np.hypot(*(one.pose - WAYS["truth"])[:2])
was_off = 100 * np.hypot(*(WAYS["predicted"] - WAYS["truth"])[:2])

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
believed = [Poses("predicted", [WAYS["predicted"]]), Poses("truth", [WAYS["truth"]])]
placed = Points("scan", models.g(WAYS["predicted"], seen[1]))
pictures = {
    "augment": [Points("landmark", maps[0]), Poses("truth", [np.zeros(3)])],
    "predict, then look": [Points("landmark", maps[0]), placed, *believed],
    "update": [Points("landmark", maps[1]), *believed, Poses("corrected", [one.pose])],
}
fig, _ = views.side_by_side(pictures, size=(11, 4.2))
for marks in fig.findobj(lambda artist: getattr(artist, "get_marker", str)() == "."):
    marks.set(marker="*", markersize=10)
views.show(
    fig,
    "A robot places four landmarks. Driven on by its wheels, it sees all four beside where it placed "
    f"them. The update brings it from {was_off:.0f} cm to {still_off:.0f} cm beside its true place.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Stars are landmarks. From an exactly known pose the robot places four of them. Then it drives, and
# its wheels lead it astray. What it sees now (orange) lies beside all four, and in the same way: that
# one robot is wrong is likelier than that four landmarks are. The update moves it back, to within
# {= still_off:.0f =} cm of its true place instead of {= was_off:.0f =} cm. It does not get there: the
# sensor errs, too.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Predict: the landmarks stand still
#
# The robot drives, and the map does not. So the step of the whole state is the robot's own step $f$, and
# for the landmarks it is nothing at all:
#
# $$x_{\mathrm r} \leftarrow f(x_{\mathrm r}, u), \qquad p_i \leftarrow p_i. \tag{06.2}$$

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-drive",
    "The robot drives 30 cm and sees nothing. Which blocks of $P$ change?",
    {
        "only the robot's own, $P_{\\mathrm{rr}}$": "that one changes. But the robot's error now "
        "turns into another one, and so does what it shares with each landmark.",
        "$P_{\\mathrm{rr}}$, and what robot and landmarks share, $P_{\\mathrm ri}$": "the landmarks' "
        "own blocks stay: driving tells nothing about the map.",
        "all blocks": "no landmark moves and none is seen, so nothing is learned or lost about the map.",
    },
    right="$P_{\\mathrm{rr}}$, and what robot and landmarks share, $P_{\\mathrm ri}$",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The Jacobian of (06.2) holds lesson 04's $A$ for the robot and ones for the map. One landmark $i$ is enough
# to see the pattern.

# %% slideshow={"slide_type": "fragment"}
P_rr, P_ii, Q, R_ = symmetric("P_rr", 3), symmetric("P_ii", 2), symmetric("Q", 3), symmetric("R", 2)
P_ri, A = sp.MatrixSymbol("P_ri", 3, 2), sp.MatrixSymbol("A", 3, 3)
O, I = sp.ZeroMatrix, sp.Identity
P = sp.BlockMatrix([[P_rr, P_ri], [P_ri.T, P_ii]])
J_drive = sp.BlockMatrix([[A, O(3, 2)], [O(2, 3), I(2)]])
noise = sp.BlockMatrix([[Q, O(3, 2)], [O(2, 3), O(2, 2)]])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-drive"
driven = derive("P", J_drive * P * J_drive.T + noise, "the recipe of lesson 03")
driven.step("multiply block by block", blockwise)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The noise of the motion belongs to the robot alone, so it enters in the corner and nowhere else:
#
# $$P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + Q, \qquad P_{\mathrm ri} \leftarrow A P_{\mathrm ri},
# \qquad P_{ij} \leftarrow P_{ij}. \tag{06.3}$$
#
# What robot and landmark have in common is carried along by $A$, and nothing is added to it, while
# the robot's own doubt grows by $Q$. The map's blocks stay as they are: driving teaches nothing about the map, and
# spoils nothing in it.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-drive"
mak = MAK(np.zeros(3), P_doubt)
mak.add(range(100), np.tile([5.0, 0.8], (100, 1)), R)
STEP, Q_STEP = np.array([0.3, 0.01, 0.1]), np.diag([0.02, 0.01, 0.012]) ** 2
before = mak.P
mak.predict(compose(mak.pose, STEP), Q_STEP)
changed = np.sum(before != mak.P)
print(f"100 landmarks: a drive changes {changed} of the {views.grouped(before.size)} numbers in P")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-drive"
# These are the 9 of the corner and 8 for each landmark, in a stripe along two edges. So the time
# that a drive costs grows with $N$, not with $N^2$.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Augment: a landmark is born
#
# A new landmark $n$ is placed where lesson 04's $g$ puts it, from the robot's pose and the sight $z$:
#
# $$p_n = g(x_{\mathrm r}, z). \tag{06.4}$$
#
# Two errors go into it: that of the pose, through the Jacobian $J_{\mathrm r}$ of $g$, and that of
# the sight, through $J_z$. No other estimate changes.

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-strangers",
    "The robot knows landmark $i$ and now places landmark $n$. No single sight ever showed both. "
    "Is $P_{ni}$, the covariance of their errors, zero?",
    {
        "yes: nothing was measured between them": "no measurement is needed: the robot's error is "
        "in both of them.",
        "no, if the robot shares an error with $i$": "whatever the robot shares with $i$ it hands on "
        "to $n$, which it places.",
        "no: in one state everything is related": "a landmark that was placed from an exactly known "
        "pose is related to nobody.",
    },
    right="no, if the robot shares an error with $i$",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# Before the landmark is placed there are three uncertain things: robot, landmark $i$, and the sight. The sight's
# noise is new, so it shares nothing with the others. Afterwards there are the robot, $i$ and $n$.

# %% slideshow={"slide_type": "fragment"}
J_r, J_z = sp.MatrixSymbol("J_r", 2, 3), sp.MatrixSymbol("J_z", 2, 2)
J_new = sp.BlockMatrix([[I(3), O(3, 2), O(3, 2)], [O(2, 3), I(2), O(2, 2)], [J_r, O(2, 2), J_z]])
P_z = sp.BlockMatrix([[P_rr, P_ri, O(3, 2)], [P_ri.T, P_ii, O(2, 2)], [O(2, 3), O(2, 2), R_]])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-strangers"
grown = derive("P", J_new * P_z * J_new.T, "the same recipe; rows: robot, i, n")
grown.step("multiply block by block", blockwise)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The corner is new: the pose's error and the sight's, each carried over by its Jacobian.
#
# $$P_{nn} = J_{\mathrm r} P_{\mathrm{rr}} J_{\mathrm r}^{\mathsf T} + J_z R J_z^{\mathsf T}. \tag{06.5}$$
#
# The other new blocks follow one rule. The new landmark is tied to the others only through the robot, so **its rows
# are the robot's rows, carried over by $J_{\mathrm r}$**:
#
# $$P_{n\mathrm r} = J_{\mathrm r} P_{\mathrm{rr}}, \qquad P_{ni} = J_{\mathrm r} P_{\mathrm ri}. \tag{06.6}$$

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Do 2000 robots agree?
#
# (06.6) says that the errors of $i$ and $n$ go together, though no sight ever compared the two. We test it on
# robots that really err.
# Each has placed landmark $i$, drives on, and places $n$.

# %% slideshow={"slide_type": "fragment"}
R_SHARP, Z_NEW = np.diag([0.05, 0.01]) ** 2, np.array([3.0, -0.9])
mak = MAK([0, 0, 0.4], np.diag([0.15, 0.15, 0.06]) ** 2)
mak.add(["i"], [[4.0, 0.8]], R_SHARP)
mak.predict(compose(mak.pose, [1.0, 0.1, 0.2]), Q_STEP)
rng = np.random.default_rng(6)
states = rng.multivariate_normal(mak.x, mak.P, 2000)  # what is really so: robot, i
sights = rng.multivariate_normal(Z_NEW, R_SHARP, 2000)
samples = np.hstack([states, models.g(states[:, :3], sights)])
mak.add(["n"], [Z_NEW], R_SHARP)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-strangers"
sigma = np.sqrt(np.diag(mak.P))
off = np.abs(np.cov(samples.T) - mak.P) / np.outer(sigma, sigma)
for name, rows in {"P_nn": np.s_[5:, 5:], "P_nr": np.s_[5:, :3], "P_ni": np.s_[5:, 3:5]}.items():
    print(f"{name}: robots and formula differ by at most {off[rows].max():.2f} of the two σ")
rho_in = correlation(mak.P)[4, 6]

# %% slideshow={"slide_type": "subslide"} answers="06-strangers" tags=["folded"]
pair = mak.P[np.ix_([4, 6], [4, 6])]
claims = {"$P$ with $P_{ni}$": pair, "$P_{ni}$ forgotten": np.diag(np.diag(pair))}
fig, ax = views.cloud(
    samples[:500][:, [4, 6]], claims, "An old landmark and a new one", size=(8, 5)
)
ax.set(xlabel="y of landmark i [m]", ylabel="y of landmark n [m]")
views.show(
    fig,
    f"The robots form a streak that leans (correlation {rho_in:.2f}); the ellipse with P_ni covers it, "
    "and the upright one without P_ni does not.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-strangers"
# Where landmark $i$ lies farther up than believed, so does $n$: the correlation is {= rho_in:.2f =}. The same robot
# placed both. Without $P_{ni}$ the filter would expect cases that hardly ever happen, at the upper left, and rule
# out some that do, at the upper right.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The covariance grows
#
# Here is a small story. The robot starts at an exactly known pose, sees landmark $a$, drives on for 3 m, and sees
# landmark $b$. After each event we draw its **correlations**, $P_{ij} / (\sigma_i \sigma_j)$. They have no
# unit, so positions, headings and landmarks fit into one picture.
#
# Look for the white blocks at each of the three moments: why is nothing shared there?

# %% slideshow={"slide_type": "fragment"}
Q_SLIP, moments = np.diag([0.05, 0.03, 0.02]) ** 2, {}
story = MAK(np.zeros(3), np.zeros((3, 3)))
story.add(["a"], [[2.0, 0.9]], R_SHARP)
moments["a is placed"] = correlation(story.P)
for _ in range(10):
    story.predict(compose(story.pose, STEP), Q_SLIP)
moments["3 m are driven"] = correlation(story.P)
story.add(["b"], [[2.5, 0.5]], R_SHARP)
moments["b is placed"] = correlation(story.P)

# %% slideshow={"slide_type": "subslide"}
fig, _ = views.correlations(moments, ["robot", "a", "b"])
views.show(
    fig,
    "At first only a's own block has a colour; after the drive the robot's own block, too; then b, "
    "coloured against the robot and white against a.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Landmark $a$ was placed from an exact pose. The only error in it is the sensor's, which it shares
# with nothing else. Driving colours the robot's own block, because its heading and its place err
# together. Then $b$ is born as a relative of the robot, and still a stranger to $a$: the robot has
# nothing of $a$'s error to hand on.
#
# What has to happen before the last white blocks get a colour?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Update: who learns?
#
# Landmark $i$ is seen again. What is expected of it, $h(x_{\mathrm r}, p_i)$, depends on five numbers of the state:
# three of the robot and two of the landmark. So most columns of its Jacobian are zero:
#
# $$H = \begin{bmatrix} H_{\mathrm r} & 0 & \cdots & H_{\mathrm p} & \cdots & 0 \end{bmatrix}. \tag{06.7}$$
#
# The robot comes first in the state, so $H_{\mathrm r}$ comes first in $H$. $H_{\mathrm p}$ stands where landmark
# $i$ stands.

# %% slideshow={"slide_type": "subslide"}
ask(
    "06-unseen",
    "In the story, the robot turns round and sees $a$ again, to the left of where it expected it. "
    "Nobody looks at $b$. What happens to the estimate of $b$?",
    {
        "nothing: $H$ is zero at $b$": "$H$ is, but the gain is $P H^{\\mathsf T} S^{-1}$, and $P$ "
        "relates $b$ to the robot.",
        "it moves, and grows surer": "the robot learns how wrong it is, and with that how wrong "
        "everything is that it placed.",
        "it moves, but stays as unsure as it was": "what moves an estimate takes part of its doubt "
        "away: $K S K^{\\mathsf T}$ is subtracted.",
    },
    right="it moves, and grows surer",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The gain is $K = P H^{\mathsf T} S^{-1}$. $H$ has only two blocks that are not zero, so each row of the gain has two
# terms. For a landmark $j$ that nobody looked at, lesson 05 has found (05.12):
#
# $$K_j = \left( P_{j\mathrm r} H_{\mathrm r}^{\mathsf T} + P_{ji} H_{\mathrm p}^{\mathsf T} \right) S^{-1}. \tag{06.8}$$
#
# So it learns through what it shares with the robot, and through what it shares with the landmark in sight. Only a
# landmark that is related to neither learns nothing. With this gain the update is lesson 03's, for all
# $3 + 2N$ numbers at once:
#
# $$x \leftarrow x + K v, \qquad P \leftarrow P - K S K^{\mathsf T}. \tag{06.9}$$
#
# Angles are wrapped, as always: the bearing in $v$, and the heading in $x$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Three things usually go wrong when students write this. The bearing in $v$ is not wrapped; the
# heading is not wrapped after the correction; the gain is applied to the robot and the landmark in sight only. The
# exercise notices the first and the last. It lets the second pass, since headings that differ by $2\pi$ are the
# same heading.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The story goes on
#
# The robot turns round, drives 1.5 m back, and sees $a$ again, 0.2 rad to the left of where it expects it.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-unseen"
story.predict(compose(story.pose, [0, 0, np.pi]), Q_SLIP)
for _ in range(5):
    story.predict(compose(story.pose, STEP * [1, 1, 0]), Q_SLIP)
x, P_was = story.x.copy(), story.P
z = models.h(x[:3], x[3:5]) + np.array([0, 0.2])
story.update(["a"], [z], R_SHARP)
parts = {"robot": np.s_[:2], "a": np.s_[3:5], "b": np.s_[5:7]}
far = {name: 100 * np.hypot(*(story.x - x)[rows]) for name, rows in parts.items()}
for name, rows in parts.items():
    was, now = (100 * np.sqrt(np.trace(each[rows, rows])) for each in (P_was, story.P))
    print(f"{name:5} moves {far[name]:4.1f} cm, its σ goes from {was:4.1f} to {now:4.1f} cm")

# %% slideshow={"slide_type": "subslide"} answers="06-unseen" tags=["folded"]
fig, ax = views.axes("Landmark a was seen again", size=(8, 6))
for name, label, mean, cov in [
    ("predicted", "predicted", x, P_was),
    ("corrected", "corrected", story.x, story.P),
]:
    ellipses = Ellipses(
        name, [mean[s] for s in parts.values()], [cov[s, s] for s in parts.values()]
    )
    views.draw(ax, ellipses, label=label)
moves = [[*x[rows], *story.x[rows]] for rows in parts.values()]
views.draw(ax, Segments("truth", moves), linewidth=2.5, label="moved")
for name, rows in parts.items():
    ax.annotate(name, story.x[rows], xytext=(18, 12), textcoords="offset points", fontsize=12)
views.legend(ax)
views.show(
    fig,
    f"The ellipses of the robot and of b shrink, and both move, by {far['robot']:.0f} and "
    f"{far['b']:.0f} cm; a moves by {far['a']:.1f} cm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-unseen"
# Nobody looked at $b$, and yet it moved by {= far["b"]:.0f =} cm and grew surer. It had been placed
# by the robot, and the robot has learned how wrong it was. $a$ moved by {= far["a"]:.1f =} cm only,
# because it was known well already: the information went from $a$ to those that needed it.

# %% slideshow={"slide_type": "subslide"} answers="06-unseen"
pictures = {"before a is seen again": correlation(P_was), "after": correlation(story.P)}
fig, _ = views.correlations(pictures, ["robot", "a", "b"], size=(9, 4.5))
weakest = np.abs(pictures["after"][5:7, 3:5]).max()
views.show(
    fig,
    "Before the update a is white against all others; after it every block has a colour, and that of "
    f"a and b reaches {weakest:.2f}.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-unseen"
# After one update no block is white. From now on everyone is related to everyone, which is why $P$ cannot be kept as
# $N$ little matrices. Lesson 07 asks what happens to those who try.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Once round a loop
#
# These three steps are the whole filter. In each step of a run, the robot **predicts** its drive, **updates** by the
# landmarks that it knows, and **augments** by those that are new. The package has the filter as `MAK`, and
# `MakSlam` drives it through a run.
#
# The run is simulated: a circle of 4 m radius with twenty landmarks, of which the robot sees those within 2.5 m. Once
# round takes 84 steps, and we drive 100.

# %% slideshow={"slide_type": "fragment"}
LOOP = Loop(steps=100)
source = LandmarkRun(LOOP, np.random.default_rng(16))
kept = []  # the filter after each step


def keep(reading, slam):
    kept.append(slam.filter.marginal(slam.filter.ids))  # a copy


result = run(source, MakSlam(source.robot, source.sensor), keep)

# %% slideshow={"slide_type": "subslide"}
ask(
    "06-drift",
    "The robot starts exactly known, and drives round once among landmarks it has never seen. How "
    "does its position error develop until it comes back to the first ones?",
    {
        "it stays small: there is always a landmark in sight": "but each was placed by the robot itself. "
        "A map of its own making cannot tell it where it is.",
        "it grows, if mostly more slowly than odometry's": "each landmark is held for a while and then "
        "replaced by newer ones, each placed with the error of that moment.",
        "it grows exactly as odometry's does": "while a landmark stays in sight, it does tell how far "
        "the robot has moved since.",
    },
    right="it grows, if mostly more slowly than odometry's",
)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-drift"
runs = [LandmarkRun(LOOP, np.random.default_rng(seed)) for seed in range(20)]
drives = [broken_slam.drive(one, MAK(np.zeros(3), np.zeros((3, 3)))) for one in runs]
steps_before = np.s_[:70]


def rms_before(poses, one):
    return np.sqrt(np.mean(np.sum((poses - one.truth.poses)[steps_before, :2] ** 2, axis=1)))


by_filter = np.array([rms_before(poses, one) for (poses, _), one in zip(drives, runs, strict=True)])
by_wheels = np.array([rms_before(two_halves.by_wheels(one), one) for one in runs])
print(f"20 runs, 70 steps: median error {np.median(by_filter):.2f} m, ", end="")
print(f"wheels {np.median(by_wheels):.2f} m; smaller in {np.sum(by_filter < by_wheels)} runs")


# %% slideshow={"slide_type": "subslide"} answers="06-drift" tags=["folded"]
def distance(poses):
    return np.hypot(*(poses - source.truth.poses)[:, :2].T)


own, wheels = distance(result.trajectory.poses), distance(result.naive.poses)
claimed = [np.sqrt(np.trace(each.block([0, 1]))) for each in kept]
errors = {"the filter's error": own, "odometry's error": wheels, "the filter's σ": claimed}
fig, ax = views.curves(np.arange(101), errors, "step", "position [m]", size=(9, 4.5))
views.show(
    fig,
    f"The filter's error grows to {own.max():.1f} m at step {own.argmax()} and falls to "
    f"{100 * own[-1]:.0f} cm, its σ with it; odometry's error goes on growing to {wheels[-1]:.1f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-drift"
# While all landmarks are new, the filter drifts: a map of its own making cannot tell the robot
# where it is. In this run its error reaches {= own.max():.1f =} m. In
# {= np.sum(by_filter < by_wheels) =} of 20 such runs it drifts less than the wheels. It *knows*
# that it drifts, because its σ grows along with its error. And then, at step
# {= own.argmax() + 1 =}, something happens that odometry has no part in.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## The loop closes
#
# The robot has come nearly round, and the landmarks that it saw first come into view again.

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-shrink",
    "The robot sees its first landmarks again. Whose ellipses shrink in the next six steps?",
    {
        "those of the landmarks it sees now": "they are the surest of the whole map and have least to learn.",
        "those of the last ones, which it has just left": "theirs do; but are they the only ones to have "
        "been placed by a robot that was wrong?",
        "those of nearly all landmarks": "the robot's error is in everything that it placed, and it has "
        "just found out how large that error is.",
    },
    right="those of nearly all landmarks",
)

# %% slideshow={"slide_type": "fragment"}
first = set(kept[0].ids)
closing = next(k for k in range(40, 101) if set(source.seen(source.truth.poses[k])) & first)
before, after = kept[closing - 1], kept[closing + 5]


# %% slideshow={"slide_type": "fragment"} answers="06-shrink" tags=["folded"]
def map_of(source, mak, way, naive, k):
    """The map after step k, beside the truth: layers by their labels."""
    return {
        "true way": Poses("truth", source.truth.poses[: k + 1]),
        "odometry alone": Poses("naive", naive[: k + 1]),
        "the filter's way": Poses("corrected", way[: k + 1]),
        "true landmarks": Points("truth", source.landmarks[mak.ids]),
        "landmarks, 95 %": Ellipses("landmark", mak.landmarks(), mak.blocks()[2]),
        "robot, 95 %": Ellipses("robot", [mak.x[:2]], [mak.block([0, 1])]),
    }


def draw_map(ax, layers):
    for label, layer in layers.items():
        cross = {"marker": "+", "mew": 1, "markersize": 7} if label == "true landmarks" else {}
        views.draw(ax, layer, label=label, **cross)


def at(k):
    return map_of(source, kept[k], result.trajectory.poses, result.naive.poses, k)


# %% slideshow={"slide_type": "subslide"} answers="06-shrink" tags=["folded"]
titles = [f"step {closing - 1}: about to close", f"step {closing + 5}: closed"]
fig, both = views.panels(titles, size=(11, 5.5))
for ax, k in zip(both, (closing - 1, closing + 5), strict=True):
    draw_map(ax, at(k))
views.legend_below(fig)


def areas(mak):
    """The landmarks' ellipses, in the order of the older map: their areas but for a factor."""
    return np.sqrt(np.linalg.det(mak.blocks()[2]))[: len(before.ids)]


shrunk = 1 - areas(after) / areas(before)
views.show(
    fig,
    f"Before the closing the ellipses grow along the loop; six steps later {np.sum(shrunk > 0.2)} of "
    f"{len(shrunk)} are smaller by a fifth or more.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-shrink"
# {= np.sum(shrunk > 0) =} of {= len(shrunk) =} ellipses shrank within six steps, among them those on the far side,
# which have long been out of sight. In the order in which the landmarks were found, they lost this share of their
# area:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-shrink"
print(" ".join(f"{100 * share:.0f} %" for share in shrunk))
print(
    f"the robot's error fell from {100 * own[closing - 1]:.0f} to {100 * own[closing + 5]:.0f} cm"
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The first landmarks, placed from a pose that was almost exact, had little to learn. Those that were placed late,
# by a robot that was far from sure, learned most. How does the filter know whom to tell? It is written in $P$.
#
# Step through the run, and watch the map and its correlations side by side.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is the moment of the lesson; leave time for it. Ask whether a program that stores each
# landmark with a 2 × 2 covariance of its own could do the same.


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def at_step(step):
    mak = kept[step]
    fig, (left, right) = views.panels([f"step {step}", "correlations"], (11, 5.2), shared=False)
    for ax in (left, right):
        ax.set_aspect("equal", adjustable="box")
    draw_map(left, at(step))
    left.set(xlim=(-6.5, 6.5), ylim=(-2.8, 10.5))
    views.correlation(correlation(mak.P), ["r", *map(str, range(len(mak.ids)))], ax=right)
    right.set(xlabel="landmarks, first to last found", ylabel=None)
    views.colour_bar(right)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    at_step,
    lambda step: (
        f"The map after step {step}, with {len(kept[step].ids)} landmarks: early ones share little "
        "with the others; the later one was found, the deeper its colours."
    ),
    play="step",
    step=(1, 100, closing - 1),
)
rho = np.abs(correlation(before.P))
of_two = np.kron(1 - np.eye(5), np.ones((2, 2))) > 0  # of different landmarks
early, late = rho[3:13, 3:13][of_two].mean(), rho[-10:, -10:][of_two].mean()

# %% [markdown] slideshow={"slide_type": "fragment"}
# You begin just before the closing. The landmarks stand in the order in which they were found. The first are pale:
# the correlations between the first five are {= early:.2f =} on average. Those between the last five are
# {= late:.2f =}, since each was placed with the error that the robot had by then. Now play on: at the closing
# almost every block changes, even those of pairs which were never in view together.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## How far it sees, how well it counts
#
# Does the filter tell the truth about itself? NEES is 3 on average where $P$ is right, and larger
# where the filter is too sure. In the runs so far, the robot sees 2.5 m far, and its turns err by
# 0.7° a second.
#
# We now let it see less far, and give it worse wheels. The filter is told of both, exactly.

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-honest",
    "The robot sees only **1.5 m** far, and its turns are **2.5 times** as noisy. The filter knows both numbers. "
    "Does it still tell the truth about its error?",
    {
        "yes: it knows every noise, and it keeps every correlation": "that would be enough if $f$ and $h$ were "
        "linear, or the errors small beside the distances to the landmarks.",
        "no, it is too sure": "at the closing the robot is off by nearly as much as it can see, and no "
        "straight line describes what such an error does to a bearing.",
        "no, it is too modest": "more noise makes $P$ larger, and rightly so: the errors are larger, too.",
    },
    right="no, it is too sure",
)


# %% slideshow={"slide_type": "fragment"}
@lru_cache(4)
def driven_with(sight, turn_noise):
    """12 runs of a loop with this sight [m] and noise of its turns [°/s]; poses and covariances."""
    loop = replace(LOOP, range_max=sight, omega_sigma=np.radians(turn_noise))
    runs = [LandmarkRun(loop, np.random.default_rng(seed)) for seed in range(12)]
    filters = [MAK(np.zeros(3), np.zeros((3, 3))) for _ in runs]
    return [
        (one, *broken_slam.drive(one, mak), mak) for one, mak in zip(runs, filters, strict=True)
    ]


SETTLED, LIMITS = 10, band(3, 12)  # P is zero at first: NEES means nothing yet


def mean_nees(drives):
    return two_halves.mean_nees([each[:3] for each in drives], SETTLED)


# %% slideshow={"slide_type": "fragment"} answers="06-honest" tags=["folded"]
by_sight = {sight: driven_with(sight, 1.8) for sight in (1.5, 4.0)}
short, far_sighted = map(mean_nees, by_sight.values())
better = {
    sight: sum(
        two_halves.rms(one, way) < two_halves.rms(one, two_halves.by_wheels(one))
        for one, way, *_ in each
    )
    for sight, each in by_sight.items()
}
peak = SETTLED + short.argmax()


def off_at_closing(one, way, *_):
    """How far off the robot is just before it sees one of its first landmarks again [m]."""
    in_sight = [set(one.seen(pose)) for pose in one.truth.poses]
    first = set.union(*in_sight[:10])
    k = next(k for k in range(50, 101) if in_sight[k] & first)
    return np.hypot(*(way - one.truth.poses)[k - 1, :2])


at_closing = {
    sight: np.median([off_at_closing(*each) for each in drives])
    for sight, drives in by_sight.items()
}

# %% slideshow={"slide_type": "subslide"} answers="06-honest" tags=["folded"]
as_before = mean_nees(driven_with(2.5, 0.7))


def sight_and_noise(sight, turn_noise):
    drives = driven_with(sight, turn_noise)
    one, way, _, mak = drives[4]
    values = mean_nees(drives)
    fig, (left, right) = views.panels(["one of 12 runs", "all 12 runs"], (11, 5.2), shared=False)
    left.set_aspect("equal", adjustable="box")
    draw_map(left, map_of(one, mak, way, two_halves.by_wheels(one), 100))
    right.set_aspect("auto")
    steps = np.arange(SETTLED, 101)
    right.plot(steps, values, color=views.COLOURS["corrected"], lw=2, label="chosen robot")
    before = views.COLOURS["before"]
    right.plot(steps, as_before, color=before, lw=2, ls="dashed", label="2.5 m, 0.7°/s")
    views.band(right, *LIMITS, "95 % band")
    right.set(
        xlabel="step", ylabel="mean NEES [1]", yscale="log", ylim=(1, max(100, 1.5 * values.max()))
    )
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="06-honest"
views.explore(
    sight_and_noise,
    lambda sight, turn_noise: (
        f"With a sight of {sight:.1f} m and turns that err by {turn_noise:.1f}° a second: the map of one run, "
        "and the mean NEES of all beside that of the first robot, which stays near its band."
    ),
    sight=(1.0, 5.0, 1.5),
    turn_noise=(0.2, 3.0, 1.8),
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="06-honest"
# With a short sight and poor wheels, NEES is {= short.mean():.1f =} on average, and {= short.max():.0f =} at
# its peak. With the same wheels and a sight of 4 m it is {= far_sighted.mean():.1f =}; the first robot's was
# {= as_before.mean():.1f =}. The robot's error is smaller than the wheels' in {= better[1.5] =} of the 12 runs with
# the short sight, and in {= better[4.0] =} with the long one.
#
# No block is missing here. The peak is at step {= peak =}, as the loop closes. When the robot sees its first
# landmarks again, it is off by {= at_closing[1.5]:.1f =} m (median), and they stand at most 1.5 m away. Over such
# an error a bearing does not follow a straight line. With a sight of 4 m it is off by {= at_closing[4.0]:.2f =} m.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Are the Jacobians taken at the wrong place?
#
# A filter takes them where it believes that the robot is. We can be kinder, and take them at the truth, which only a
# simulation knows.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
worse = replace(LOOP, range_max=1.5, omega_sigma=np.radians(1.8))
tried = [consistency.errors_of(seed, worse) for seed in range(12)]


def nees_with(jacobians):
    return np.mean([nees(*(each[SETTLED:] for each in one[jacobians][:2])) for one in tried])


print(f"mean NEES: Jacobians at the estimate {nees_with('standard'):.1f}, ", end="")
print(f"at the truth {nees_with('ideal'):.1f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# It does not help here; it makes things worse. Over errors as large as this no straight line will
# do, wherever it touches the curve. What helps is to keep the errors small. Seeing farther does so
# in two ways: more landmarks hold the heading, and the loop closes earlier. Lesson 07 shows a case
# in which the place of the Jacobians does matter.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Neighbouring steps of a run share their errors, so an excursion beyond the
# band is one event, not ten. `python -m slamlab.studies.consistency` drives a hundred runs of seven
# rounds each, with standard, first-estimates and ideal Jacobians on the same readings, and writes
# the table.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## The order matters

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-order",
    "Somebody's program first places the new landmarks of a scan, then predicts the drive, then updates. The "
    "robot drives 0.3 m a step. What happens?",
    {
        "nothing: in the end all three steps are done": "the sight was made *after* the drive; it is placed from "
        "a pose that the robot had left.",
        "the errors average out over many sights": "the displacement is the same for each "
        "landmark, a step backwards along the path, and so it is no noise.",
        "landmarks end up a step behind, and $P$ does not know it": "the filter then bends the "
        "robot to a map "
        "that it believes too much.",
    },
    right="landmarks end up a step behind, and $P$ does not know it",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-order"
ten = runs[:10]
right_order = broken_slam.at_the_end(ten)
wrong_order = broken_slam.at_the_end(ten, places_first=True)
last = [(two_halves.by_wheels(one) - one.truth.poses)[-1, :2] for one in ten]
wheels_last = np.sqrt(np.mean(np.sum(np.square(last), axis=1)))
print(f"{'10 runs, at the end':28} map [m]  robot [m]  claimed [m]  NEES")
table = {"predict, update, augment": right_order, "augment, predict, update": wrong_order}
for name, end in table.items():
    print(f"{name:28} {end.landmarks:6.2f} {end.robot:10.2f} {end.claimed:12.2f} {end.nees:7.1f}")
print(f"{'wheels alone':28} {wheels_last:17.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-order"
# The map errs {= wrong_order.landmarks / right_order.landmarks:.1f =} times as much, and NEES is
# {= wrong_order.nees:.0f =} instead of {= right_order.nees:.1f =}. The map still looks like a map, and the robot is
# still better than its wheels. Such a mistake survives unless somebody computes NEES.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## One lie
#
# Everyone learns from every sight. What if a sight is false? We go back to the moment when the loop closes, and let
# the sensor report an old landmark farther away than it is.

# %% slideshow={"slide_type": "fragment"}
readings = list(source)
NOISE = two_halves.R(source)


def told(k, lie):
    """The filter after the drive of step k + 1 and one sight of the oldest landmark, long by `lie`."""
    mak = kept[k].marginal(kept[k].ids)
    predict(mak, readings[k + 1], source.robot)
    seen = readings[k + 1].observations
    known = [j for j, id in enumerate(seen.ids) if id in mak.ids]
    j = min(known, key=lambda j: mak.ids.index(seen.ids[j]))
    return mak, mak.update([seen.ids[j]], [seen.z[j] + [lie, 0]], NOISE)


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def one_lie(range_too_long_by):
    (mak, step), (honest, _) = told(closing - 1, range_too_long_by), told(closing - 1, 0.0)
    fig, ax = views.axes(f"NIS of this sight: {step.nis:.1f}", size=(8, 6))
    moves = np.hstack([honest.landmarks(), mak.landmarks()])
    layers = map_of(source, mak, [mak.pose], [], closing)
    del layers["odometry alone"], layers["the filter's way"]
    draw_map(ax, layers | {"moved by the lie": Segments("naive", moves)})
    views.draw(ax, Poses("robot", mak.pose), label="robot")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    one_lie,
    lambda range_too_long_by: (
        f"A single sight that is {range_too_long_by:.1f} m too long moves the robot and the landmarks that it "
        "placed late, far out of their ellipses when the lie is large."
    ),
    range_too_long_by=(0.0, 3.0, 2.0),
)
nis = [told(k, 0.0)[1].nis for k in range(1, 100)]
(lied, lie_step), (honest, _) = told(closing - 1, 2.0), told(closing - 1, 0.0)
carried = np.hypot(*(lied.landmarks() - honest.landmarks()).T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# One lie of 2 m carries {= np.sum(carried > 0.3) =} of the {= len(carried) =} landmarks off by more than 0.3 m, one
# of them by {= carried.max():.1f =} m. The ellipses are as small as if the sight had been true, since the new $P$
# in (06.9) does not depend on $v$.
#
# But the filter could have known. $S$ is computed before anybody looks, and it says how large an innovation may be.
# Lesson 03's $v^{\mathsf T} S^{-1} v$ (NIS) is 2 on average for an honest sight. In {= len(nis) =} steps of this
# run the oldest landmark in sight had {= np.mean(nis):.1f =} on average, and at most {= max(nis):.0f =}. The lie of
# 2 m has {= lie_step.nis:.0f =}.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## News that no sensor brings
#
# Nothing in (06.8) and (06.9) insists on a range and a bearing. They need an $h$ of the state, its Jacobian $H$
# over the *whole* state, and an $R$. A surveyor tells the robot where landmark $b$ of our story stands, to a
# centimetre. Then $h$ is $p_b$ itself: $H$ has ones in $b$'s columns, and zeros everywhere else. (`correct` takes
# $H$ without its columns of zeros, and is told which columns are left.)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
place, R_PLAN = story.landmarks()[1] + [0.03, -0.04], np.eye(2) * 0.01**2
x, sigma = story.x.copy(), np.sqrt(np.diag(story.P))
story.correct(place - x[5:7], np.eye(2), story.rows(["b"]), R_PLAN)
now = np.sqrt(np.diag(story.P))
for name, rows in parts.items():
    moved, was, is_now = np.hypot(*(story.x - x)[rows]), *(np.hypot(*s[rows]) for s in (sigma, now))
    print(f"{name:5} moves {100 * moved:.1f} cm, σ from {100 * was:.1f} to {100 * is_now:.1f} cm")

# %% [markdown] slideshow={"slide_type": "subslide"}
# The robot moves as well, though nobody saw anything. The more precise the news, the smaller its
# $R$. If the news is certain, $R$ is zero, and that will do as long as $S$ can be inverted.
#
# A landmark can also leave: a chair may have been moved. Its rows and columns of $x$ and $P$ are struck out, and
# that is all. Nobody else changes, and what the landmark once taught the others stays with them.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_left = story.P[np.ix_([0, 1, 2, 5, 6], [0, 1, 2, 5, 6])]
story.remove(["a"])
print("left:", story.ids, " P of robot and b unchanged:", np.array_equal(story.P, P_left))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# R. Smith, M. Self and P. Cheeseman, "Estimating uncertain spatial relationships in robotics", in *Autonomous Robot
# Vehicles*, Springer, 1990: the state that holds robot and map, with all its covariances.
#
# M. W. M. G. Dissanayake, P. Newman, S. Clark, H. F. Durrant-Whyte and M. Csorba, "A solution to the simultaneous
# localization and map building (SLAM) problem", *IEEE Transactions on Robotics and Automation* 17(3), 2001: why the
# correlations have to be kept, and where they lead.
#
# S. J. Julier and J. K. Uhlmann, "A counter example to the theory of simultaneous localization and map building",
# *IEEE International Conference on Robotics and Automation*, 2001: EKF-SLAM grows too sure.
#
# **Read next:** H. Durrant-Whyte and T. Bailey, "Simultaneous localization and mapping: part I", *IEEE Robotics and
# Automation Magazine* 13(2), 2006.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can build EKF-SLAM from three steps, name every block of its covariance and who made it, watch a loop close, and
# tell by NEES when the filter is too sure of itself.
#
# **What comes next:** [lesson 07](07_correlations.ipynb) looks at the white and the coloured
# blocks: why correlations cannot be dropped, what they cost, and how some of that cost can be
# avoided.
#
# The sections below this one are optional.
#
# **Exercise:** [06 · EKF-SLAM](../exercises/ex06_ekf_slam.ipynb). You write augment, update and the whole filter,
# tell it that two of its landmarks are one, and keep it from believing lies.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: may P start at zero?
#
# In this lesson it does: the map's frame begins where the robot stands, so nothing about its pose is in doubt.
# Smolec warns of it (section 2.6): without some doubt on the diagonal of $P$ a singular matrix often turns up, so
# put some there, even if you believe the start. Does anything go wrong with zero, and what does the doubt do?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_DOUBT = np.diag([0.1, 0.1, np.radians(5)]) ** 2
doubting = broken_slam.at_the_end(ten, P_start=P_DOUBT)
print(f"{'10 runs, at the end':28} map [m]  robot [m]  claimed [m]  NEES")
for name, end in {"P starts at zero": right_order, "P starts at 10 cm, 5°": doubting}.items():
    print(f"{name:28} {end.landmarks:6.2f} {end.robot:10.2f} {end.claimed:12.2f} {end.nees:7.1f}")

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
maks = {
    name: MAK(np.zeros(3), start) for name, start in [("zero", 0 * P_DOUBT), ("doubt", P_DOUBT)]
}
for mak in maks.values():
    broken_slam.drive(source, mak)
zero, doubt = (each.landmarks() for each in maks.values())
between = [np.hypot(*(each[:, None] - each).T) for each in (zero, doubt)]  # all distances in a map
print(f"landmarks differ by up to {100 * np.hypot(*(zero - doubt).T).max():.0f} cm,", end=" ")
print(f"distances between landmarks by up to {100 * np.abs(between[0] - between[1]).max():.0f} cm")

# %% [markdown] slideshow={"slide_type": "subslide"}
# Nothing goes wrong with zero. What is inverted is $S = H P H^{\mathsf T} + R$, and $R$ alone keeps it regular. Only
# those who invert $P$ itself, as NEES does, have to wait for the first steps.
#
# The doubt buys nothing here. Both maps have the same shape, but for a few centimetres; the second is shifted and
# turned as a whole, and its claims grow with its errors. It is honest about a question that nobody asked: where the
# start lies in a frame that begins there. Doubt belongs in $P$ when the frame is given from outside, say by a map
# that was there before the robot.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: how the package saves time
#
# `MAK` computes (06.9) with less work than it is written with. $P$ is symmetric, so one triangle of it is kept. And a
# scan of $m$ landmarks is a single update: with the Cholesky factor $L$ of $S = L L^{\mathsf T}$ and
# $M = P H^{\mathsf T} L^{-\mathsf T}$ (`B` in the code) it is $P \leftarrow P - M M^{\mathsf T}$, for which neither a
# gain nor an inverse is needed.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
mak = kept[60].marginal(kept[60].ids)
P_then, seen = mak.P, mak.ids[-3:]
step = mak.update(seen, models.h(mak.pose, mak.landmarks()[-3:]) + np.array([0.05, 0.01]), NOISE)
print("B", step.B.shape, " K", step.K.shape)
print(f"B Bᵀ and K S Kᵀ agree: {np.allclose(step.B @ step.B.T, step.K @ step.S @ step.K.T)}")
print(f"P − B Bᵀ is the new P: {np.allclose(mak.P, P_then - step.B @ step.B.T)}")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a calm display
#
# The EKF note adds a step: after the update, a recursive filter smooths what is *shown*. Its
# formula is lost in our copy. The plainest one keeps a share $\lambda$ of the old gap between the
# pose that is shown and the estimate:
#
# $$x_{\text{shown}} \leftarrow x_{\text{shown}} \oplus o, \qquad x_{\text{shown}} \leftarrow \hat x + \lambda\,(x_{\text{shown}} - \hat x), \tag{06.10}$$
#
# where $o$ is the motion told by the wheels. A landmark stands still, so it has only the second half. `MakSlam`
# offers both. Is what is shown more accurate for some $\lambda > 0$, or only calmer?


# %% slideshow={"slide_type": "fragment"}
def shown(share, count=6):
    """Error of the shown pose once the loop is closed, its jumps, error of shown landmarks [cm]."""
    squares = []
    for one in runs[:count]:
        slam = MakSlam(one.robot, one.sensor, smoothing=share, landmark_smoothing=share)
        way = run(one, slam).trajectory.poses
        driven = compose(way[:-1], [reading.odometry for reading in list(one)[1:]])
        landmarks = slam.landmarks() - one.landmarks[slam.filter.ids]
        pairs = [(way - one.truth.poses)[84:], way[1:] - driven, landmarks]
        squares.append([np.mean(np.sum(each[:, :2] ** 2, axis=1)) for each in pairs])
    return 100 * np.sqrt(np.mean(squares, axis=0))


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
smoothed = {share: shown(share) for share in (0.0, 0.5, 0.8, 0.95)}
for share, (error, jump, landmark) in smoothed.items():
    print(f"λ {share:.2f}: pose off by {error:4.1f} cm, jumps by {jump:3.1f} cm; ", end="")
    print(f"landmarks off by {landmark:.1f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# What is shown is calmer, but in none of these cases more accurate. The estimate has made use of
# every measurement so far, and mixing the old gap into it brings back what the last one has just
# refuted. For a display the calm may be worth that; a controller should get the estimate.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: without a notebook
#
# The same filter runs from a terminal. `sim:landmarks` drives about seven rounds, and with `--out FOLDER` the command
# also writes the trajectory, the map and a summary.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-ignore-output"]
import subprocess
import sys

command = [sys.executable, "-c", "from slamlab.cli import main; main()"]  # slamlab, anywhere
words = ["run", "sim:landmarks", "--estimator", "mak"]
print(subprocess.run(command + words, capture_output=True, text=True).stdout)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print
#
# Optional: how our two sources print this lesson's formulas. (Smolec's program is printed in
# figures only. We know what it does from line numbers and prose, so the last row may do it an
# injustice.)
#
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | Smolec, prediction | "$P$ is updated with $A$" | (06.3), with $Q$ and $P_{\mathrm ri}$ | too sure; wrong relations |
# | Smolec (18) | $P_{ni} = J_{\mathrm r} (P_{\mathrm ri})^{\mathsf T}$ | $J_{\mathrm r} P_{\mathrm ri}$, (06.6) | shapes do not fit |
# | MAK thesis (4.9) | $H = [\,0\;\; 0\;\; H_{\mathrm r}\;\; H_{\mathrm p}\;\; 0 \cdots]$ | (06.7) | shapes do not fit |
# | Smolec (15) | $x = K v$ | $x + K v$, (06.9) | the map collapses |
# | Smolec, update | $P$ is left as it was | (06.9) | never sure, worse map |
# | Smolec, program | predicts after placing | "The order matters" | landmarks a step behind |

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
swung = sp.block_collapse(J_drive * P * J_drive.T)
print("prediction, right − printed:", sp.block_collapse(driven.result - swung).blocks[0, 0])
H_r, H_p = sp.MatrixSymbol("H_r", 2, 3), sp.MatrixSymbol("H_p", 2, 2)
blocks = sp.BlockMatrix([[P_rr, P_ri, P_ri], [P_ri.T, P_ii, P_ii], [P_ri.T, P_ii, P_ii]])
for name, formula in {
    "(18)": lambda: J_r * P_ri.T,
    "(4.9)": lambda: sp.BlockMatrix([[O(2, 3), O(2, 2), H_r, H_p]]) * blocks,
}.items():
    try:
        print(name, formula().shape)
    except sp.ShapeError:
        print(name, "is refused: the shapes do not fit")

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output", "nearly"]
forgetful = broken_slam.at_the_end(ten, broken_slam.Forgetful)
never = broken_slam.at_the_end(ten, broken_slam.NeverSurer)
print(f"{'10 runs, at the end':28} map [m]  robot [m]  claimed [m]  NEES")
table = {"the filter": right_order, "x = K v": forgetful, "P is never updated": never}
for name, end in table.items():
    # where P is nearly singular the last digits are this processor's rounding
    told_nees = f"{end.nees:7.1f}" if end.nees < 1000 else "  > 1000"
    print(f"{name:28} {end.landmarks:6.2f} {end.robot:10.2f} {end.claimed:12.2f} {told_nees}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# With (15) each update throws the robot and the map to near zero, and the error becomes as large as the loop.
# Without the update of $P$ the filter listens to each sight as if it knew nothing. Its NEES is far *below* 3: it
# is much too modest, and its map errs {= never.landmarks / right_order.landmarks:.1f =} times as much.
#
# (18) would be right if $P_{\mathrm ri}$ named the block below the diagonal. Where all blocks are square, both
# readings multiply, and no program complains about the wrong one.
