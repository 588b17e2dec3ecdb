# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 10 · Boxes
#
# **You will be able to** keep a robot and its map in boxes that hold the truth for certain, as long as two
# conditions hold; predict such boxes and cut them by a sighting; and say what the certainty costs and
# what becomes of it when a condition breaks.
#
# **90 minutes**, in two parts: how the filter works (48), and what its promise is worth (42).
# **Before:** lesson [04](04_models_and_jacobians.ipynb) for the models, lesson
# [06](06_ekf_slam.ipynb) for SLAM, and some trigonometry.
#
# *Key:* an ellipse says how likely an error is, and a box says how large it can be at most.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Part one is a lecture at the board, with the pictures beside it. Part two is an
# argument: a guarantee against accuracy. If time is short, leave out "Beyond a right angle" and "Who was
# seen?". Keep ten minutes for "Box beside ellipse"; the class should go home with its three numbers.
# For a poll: the questions on the overlap, on the bent hook, on the drive, and on who is nearest.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import textwrap
from dataclasses import replace
from timeit import repeat

import numpy as np
import sympy as sp

from slamlab import views
from slamlab.checks import ask
from slamlab.filters.bor import BOR, EmptyIntersection
from slamlab.filters.bor.angle_intervals import angle_interval, bearing_interval, contains
from slamlab.filters.bor.angle_intervals import intersection
from slamlab.filters.bor.clipping import clip
from slamlab.filters.bor.contraction import contract_heading, contract_once
from slamlab.filters.bor.half_planes import edges, reversed_edges, sector_edges
from slamlab.filters.bor.intervals import around, cosine, product, width
from slamlab.filters.bor.prediction import predict_box, wheels
from slamlab.geometry import wrap
from slamlab.layers import Boxes, Points
from slamlab.models import h
from slamlab.simulation import arc
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from slamlab.studies import boxes as study
from slamlab.studies.boxes import inside
from slamlab.studies.broken_bounds import cut_off, objects_made, one_bad_range, race
from slamlab.studies.study_command import stored

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## A bound is a promise
#
# A tape measure is never off by more than 10 cm; its maker promises that. We measure a wall that is 2 m
# away, twelve times. Each reading says that the wall is *surely* within 10 cm of it. All twelve are right
# at once, so the wall stands where all twelve intervals overlap.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-overlap",
    "Each of the twelve intervals is 20 cm wide. **How wide is their overlap?**",
    {
        "1.7 cm: a twelfth of 20 cm": "twelve readings do not share out one interval among them. Twelve "
        "equal readings would leave all 20 cm.",
        "5.8 cm: 20 cm over the root of 12": "that is how the doubt of a *mean* shrinks if the errors are "
        "independent. Nobody takes a mean here, and nobody said independent.",
        "it depends on the smallest and the largest reading": "the overlap begins at the largest reading "
        "less 10 cm, and ends at the smallest one plus 10 cm.",
    },
    right="it depends on the smallest and the largest reading",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-overlap"
WALL, BOUND = 2.0, 0.1
tape = WALL + np.random.default_rng(7).uniform(-BOUND, BOUND, 12)
overlap = tape.max() - BOUND, tape.min() + BOUND
for n in (1, 4, 12):
    print(f"{n:2} readings: {100 * (2 * BOUND - np.ptp(tape[:n])):.1f} cm")

# %% slideshow={"slide_type": "fragment"} answers="10-overlap"
rows = {f"reading {k + 1}": around(z, BOUND) for k, z in enumerate(tape)}
rows["overlap"] = overlap
fig, _ = views.boxes.intervals(rows, WALL, "distance [m]", "", size=(8, 4.4))
views.show(
    fig,
    f"{len(tape)} intervals, each of which crosses the true distance, and their overlap, "
    f"{100 * width(overlap):.1f} cm wide, which holds it.",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-overlap"
# Every bar crosses the dashed truth, so the overlap holds it, too. With readings $z_k$ that are off by at
# most $d_z$, it is the interval
#
# $$\left[\; \max_k z_k - d_z,\;\; \min_k z_k + d_z \;\right]. \tag{10.1}$$
#
# Only the two outermost readings count, and the others add nothing. This is the idea of the whole lesson:
# **an estimate is a set, and two estimates are combined by taking what they have in common.**
#
# (In this lesson a $d$ with a subscript is a bound: the most by which that quantity can be off.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## What a bound does not ask for
#
# Now the hook of the tape is bent, and *every* reading is some 7.5 cm too long. This is still within the
# promised 10 cm. Beside us stands somebody who uses a Kalman filter, with the standard deviation of a
# uniform error, 10 cm$/\sqrt 3$, and who takes the mean of all twelve readings.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-bent",
    "Every reading is 6 to 9 cm too long. **Which claim holds the wall: the overlap, or the mean "
    "$\\pm\\, 2\\sigma$?**",
    {
        "both": "the mean is some 7.5 cm off, and its σ has shrunk by the root of twelve.",
        "only the overlap": "no reading is off by more than promised, so no interval misses the wall.",
        "only the mean": "a mean gets rid of errors that differ from reading to reading. These all "
        "point the same way.",
        "neither": "each reading keeps its promise, and nothing else is needed for the overlap.",
    },
    right="only the overlap",
)


# %% slideshow={"slide_type": "subslide"} answers="10-bent" tags=["folded"]
def bent_tape(too_long_by, scatter):
    z = WALL + too_long_by + scatter * np.random.default_rng(7).uniform(-1, 1, 12)
    rows = {f"reading {k + 1}": around(each, BOUND) for k, each in enumerate(z)}
    rows["mean ± 2σ"] = around(z.mean(), 2 * BOUND / np.sqrt(3 * len(z)))
    low, high = z.max() - BOUND, z.min() + BOUND
    if low <= high:
        rows["overlap"] = low, high
    said = "" if low <= high else "the intervals have nothing in common"
    last = len(rows) - len(z)
    fig, ax = views.boxes.intervals(rows, WALL, "distance [m]", "", said, last, size=(8, 4.6))
    ax.set(xlim=(1.75, 2.4))
    return fig


# %% slideshow={"slide_type": "fragment"} answers="10-bent"
views.explore(
    bent_tape,
    lambda too_long_by, scatter: (
        f"Twelve intervals, all {100 * too_long_by:.1f} cm too far to the right but for a scatter of "
        f"{100 * scatter:.1f} cm; at first the overlap is wide and holds the truth, the mean does not."
    ),
    too_long_by=(0.0, 0.15, 0.075),
    scatter=(0.0, 0.2, 0.015),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-bent"
# The mean is sure and wrong, and the overlap is wide and right. Move the first slider beyond 0.1 m:
# the promise is broken, the overlap misses the wall, and no reading gives that away. Only with much
# scatter may the intervals have nothing in common, and then you know that the promise is broken.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Why a box needs no correlations
#
# A bound does not ask whether errors are independent, centred, or Gaussian. It asks one thing:
# never more than this. It makes no difference between a systematic error and a random one.
#
# That is why a filter of boxes keeps no covariances. Lesson 07 has shown what goes wrong in an ellipse when
# a common error is forgotten. A box has nothing to forget, for it allows for every way in which the errors
# could act together, the worst included.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask who would have taken the mean, and what the mean needs. Do not hurry here: the rest of
# the lesson is this idea in two dimensions and with angles.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The state: boxes, and an interval of angles
#
# The filter is called BOR in the MAK thesis, one of the two from which this course has its filters.
# Its state consists of two parts:
#
# - for the robot, a box from $x_{\min}$ to $x_{\max}$ and from $y_{\min}$ to $y_{\max}$, and an
#   interval of headings;
# - for each object, which is this lesson's word for a landmark, a box.
#
# That makes four numbers for each object, and none for a pair of objects. An interval of angles
# needs some care, because angles go round.

# %% [markdown] slideshow={"slide_type": "subslide"}
# Take a heading between 170° and 190°. Wrapped, its ends are 170° and −170°. The angles between the
# smaller and the larger of these two are all the wrong headings, and none of the right ones.
#
# So we never sort the ends. An interval goes from its **right** end counter-clockwise to its **left** end;
# right lies in $(-\pi, \pi]$, and left is right plus the width, even beyond $\pi$. An angle $\theta$ is inside
# if, counted counter-clockwise from right, it comes before left:
#
# $$(\theta - \text{right}) \bmod 2\pi \;\le\; \text{left} - \text{right}. \tag{10.2}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
right, left = np.radians([170, 190])
low, high = sorted([wrap(right), wrap(left)])
for degrees in (180, 0):
    theta = np.radians(degrees)
    sorted_says, says = low <= wrap(theta) <= high, contains((right, left), theta)
    print(f"{degrees:3}°: sorted ends say {sorted_says!s:5}  right to left says {says}")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=11
# ## Prediction: how far at most?
#
# Every robot of this course drives a distance $d$ in the direction of its heading plus some $\delta$, and turns
# by $\Delta\theta$:
#
# $$x' = x + d\cos(\theta+\delta),\quad y' = y + d\sin(\theta+\delta),\quad \theta' = \theta+\Delta\theta.
# \tag{10.3}$$
#
# (For a steered robot $\delta$ is its steering angle.) Each of these is known within an interval only. We want the
# smallest box that holds every place where the robot can be afterwards.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-ahead",
    "A robot at the origin looks east, give or take 0.5 rad. It drives exactly 1 m. **Between which "
    "numbers does its $x'$ lie?**",
    {
        "it is 0.88: both ends of the heading give it": "they do, for the cosine is even. But the robot "
        "may also look somewhere between the two ends.",
        "from 0.88 to 1": "an end of the heading gives the least, and straight ahead, which is no end, "
        "the most.",
        "from 0.5 to 1.5": "the heading is off by half a radian, but the way is exactly 1 m: nobody gets "
        "farther than that.",
    },
    right="from 0.88 to 1",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-ahead"
# ### Corners are not enough
#
# $\cos(\pm 0.5) = 0.878$, so a program that tries only the two ends says that $x'$ *is* 0.878. But
# a robot that looks straight ahead gets to 1. A sine or a cosine can have its extreme *inside* the
# interval. The slope tells where that can be:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="10-ahead"
angle = sp.symbols("theta", real=True)
sp.solveset(sp.diff(sp.cos(angle), angle), angle)

# %% [markdown] slideshow={"slide_type": "subslide"}
# So over an interval of angles the cosine has its largest value at an end, unless a multiple of $2\pi$ lies inside;
# then it is 1. It has its smallest value at an end, unless $\pi$ lies inside, or $\pi$ and whole turns; then it is
# −1. (10.2) tells what lies inside. The sine is the cosine of an angle that is smaller by $\pi/2$.
#
# Does the rule hold? We compare it with a thousand angles of each interval:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for span in [(-0.5, 0.5), (1, 2), (2, 4), (3, 7)]:
    tried = np.cos(np.linspace(*span, 1000))
    print(
        span, "rule", np.round(cosine(span), 3), " tried", np.round([tried.min(), tried.max()], 3)
    )

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Products: try all four
#
# The distance is uncertain as well, and negative when the robot backs. What is the range of a product $\xi\kappa$ if
# $\xi$ lies between −1 and 2, and $\kappa$ between −3 and 1? For a fixed $\kappa$ it is a straight line in $\xi$, and a
# straight line has its extremes at the ends. The same holds the other way round. So here the ends do suffice, all four
# pairs of them:
#
# $$[\xi_1, \xi_2] \cdot [\kappa_1, \kappa_2] = \left[\min_{i,j} \xi_i \kappa_j,\;\; \max_{i,j} \xi_i \kappa_j\right].
# \tag{10.4}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print([xi * kappa for xi in (-1, 2) for kappa in (-3, 1)], "→", product((-1, 2), (-3, 1)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Sums, products, and the ranges of sine and cosine: that is all that (10.3) needs. The result is the smallest box there
# is, because no uncertain quantity stands twice in $x'$, or twice in $y'$. (The first *Deeper* section shows why this
# matters.)


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def after_a_drive(heading_within, distance_within):
    heading, distance = around(0.0, heading_within), around(1.0, distance_within)
    box, _ = predict_box((0, 0, 0, 0), heading, distance, (0, 0), (0, 0))
    tried = np.random.default_rng(1).uniform(-1, 1, (2, 800))
    d, theta = 1 + distance_within * tried[0], heading_within * tried[1]
    x, y = np.outer(distance, np.cos(heading)), np.outer(distance, np.sin(heading))
    by_corners = [x.min(), x.max(), y.min(), y.max()]
    fig, ax = views.boxes.scene(None, (-2.2, 2.2, -1.5, 1.5), size=(8, 5))
    views.draw(
        ax, Points("sample", np.transpose(d * [np.cos(theta), np.sin(theta)])), label="drives"
    )
    views.draw(ax, Boxes("corrected", [box]), linewidth=2, label="intervals")
    views.draw(ax, Boxes("naive", [by_corners]), linewidth=2, label="corners only")
    views.legend(ax, loc="upper left")
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    after_a_drive,
    lambda heading_within, distance_within: (
        f"Drives of a metre, give or take {distance_within:.2f} m and {heading_within:.2f} rad, end on an arc; "
        "the intervals' box holds them all, the corners' box cuts the arc off ahead."
    ),
    heading_within=(0.0, 3.2, 0.8),
    distance_within=(0.0, 0.5, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The corners' box cuts off the front of the arc, and most of the drives with it. The intervals' box touches the drives
# on all sides. Widen the heading beyond a right angle, and then to half a turn: one extreme after the other moves from the
# ends of the interval into it.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask for which headings the corners do suffice. Then let the class find, with the first
# slider, the angles at which a side of the box stops moving.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## A sighting leaves a region
#
# The robot sees an object at the range $r$, off by at most $d_r$, and at the bearing $\beta$, off by at most
# $d_\beta$. In the world it sees it in the direction $\theta + \beta$. The heading $\theta$ is only known within an
# interval, with half the width $d_\theta$. Both errors may point the same way, so the direction is off by at most
#
# $$d_{\mathrm{abs}} = d_\beta + d_\theta. \tag{10.5}$$
#
# Seen from one point, the places where the object can be form a sector of a ring.

# %% [markdown] slideshow={"slide_type": "subslide"}
# Sectors are awkward to intersect. Half-planes are easy: a half-plane is everything on one side of
# a straight line, its **edge**. So we put four edges round the sector in such a way that no part of
# it is lost. Two of them are the rays at $\pm\, d_{\mathrm{abs}}$ off the middle direction. The
# *far* and the *near* edge stand at a right angle to that direction.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-near",
    "How far from the robot can the **near edge** stand at most, if it must cut nothing off?",
    {
        "at $r - d_r$": "the middle of the inner arc is as far away as that. Look at the ends of the "
        "arc: along the middle direction they come less far.",
        "a little nearer than $r - d_r$": "the inner corners of the sector lie nearer, along the middle "
        "direction, than the middle of the inner arc.",
        "at $r - d_r - d_{\\mathrm{abs}}$": "metres and radians cannot be added.",
    },
    right="a little nearer than $r - d_r$",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-near"
# ### The near edge, derived
#
# A place of the sector has a range $r'$ and lies at an angle $\varphi$ off the middle direction, with
# $|\varphi| \le d_{\mathrm{abs}}$. Along the middle direction it is $r' \cos\varphi$ away. How does that change with
# $r'$ and with $\varphi$?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="10-near"
r_, phi = sp.symbols("r' varphi", positive=True)
sp.diff(r_ * sp.cos(phi), r_), sp.diff(r_ * sp.cos(phi), phi)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-near"
# As long as $|\varphi|$ is less than a right angle, it grows with $r'$ and shrinks with $|\varphi|$. So it is largest in
# the middle of the outer arc and smallest at the two ends of the inner one:
#
# $$\text{far: } r + d_r, \qquad \text{near: } (r - d_r) \cos d_{\mathrm{abs}}. \tag{10.6}$$
#
# (Where $d_r > r$, read 0 for $r - d_r$.)

# %% slideshow={"slide_type": "fragment"}
NAMES = "far", "near", "left", "right"


# %% slideshow={"slide_type": "subslide"} answers="10-near"
def one_sighting(range_within, d_abs):
    lost = 100 * cut_off(range_within, d_abs)
    fig, ax = views.boxes.scene(f"{lost:.0f} % are cut off", (-3.5, 4.5, -2.5, 2.5), size=(8, 5.2))
    ring, angles = around(2.0, range_within), (-d_abs, d_abs)
    views.boxes.sector(ax, (0, 0), ring, angles, "possible places")
    views.boxes.edges(ax, sector_edges(2.0, range_within, 0.0, d_abs), NAMES)
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="10-near"
views.explore(
    one_sighting,
    lambda range_within, d_abs: (
        f"A sector of a ring, deep {2 * range_within:.1f} m and wide {2 * d_abs:.2f} rad, with four edges "
        f"that cut {100 * cut_off(range_within, d_abs):.0f} % of it off; their shaded sides are forbidden."
    ),
    range_within=(0.0, 1.0, 0.4),
    d_abs=(0.0, 3.0, 0.6),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-near"
# The near edge runs through the two inner corners, and the four edges cut nothing off. Between
# edges and arcs some places are let in that are not possible: this is the price of straight lines.
# The result is less sharp, but never wrong. Now widen $d_{\mathrm{abs}}$, beyond a right angle.
# Part two will come back to what happens there.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-near"
rng = np.random.default_rng(5)
r, phi = rng.uniform(1.6, 2.4, 10_000), rng.uniform(-0.6, 0.6, 10_000)
for name, near in {"r − d_r": 1.6, "(r − d_r) cos d_abs": 1.6 * np.cos(0.6)}.items():
    print(f"near edge at {name:20}: {100 * np.mean(r * np.cos(phi) < near):4.1f} % cut off")
forgot = np.mean(r * np.cos(phi) < 1.6)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-near"
# Without the cosine the near edge cuts off {= 100 * forgot:.0f =} % of the places of this sector,
# and nothing brings them back.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## From a box, not from a point
#
# An edge is a line with a direction that points out. Call that direction $n$, a vector of length one. A place $p$ is
# allowed, seen from a robot at the place $t$, if
#
# $$n^{\mathsf T} (p - t) \le c, \tag{10.7}$$
#
# and $c$ is the distance of the line from the robot. For the far edge $n$ is the middle direction, and $c$ is
# $r + d_r$. In code an edge is a row of three numbers: the two of $n$, and $c$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# We do not know where in its box the robot stood. A place may only be excluded if it is excluded from *every* $t$ in the
# box. So we push the edge out, by as much as any $t$ could ask for:
#
# $$n^{\mathsf T} p \;\le\; c + \max_{t \,\in\, \text{box}} n^{\mathsf T} t. \tag{10.8}$$
#
# $n^{\mathsf T} t$ is a sum of two terms, one with $t_x$ and one with $t_y$. Each is largest at an end, so the maximum is at
# a corner: the one that lies farthest out in the direction $n$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Clip, then enclose
#
# Now an edge $n^{\mathsf T} p \le c$ cuts the object's box. What is left may have five corners, and
# we have only boxes, so we take the smallest box round it. How far to the right can it reach? A
# place is allowed if $n_x x \le c - n_y y$. This leaves the most room for $x$ where $n_y y$ is as
# small as it can be in the box:
#
# $$n_x\, x \;\le\; c - \min_{y} n_y\, y, \qquad n_y\, y \;\le\; c - \min_{x} n_x\, x. \tag{10.9}$$
#
# *Which point leaves most room?* This question is the key to the filter, and to its exercise.


# %% slideshow={"slide_type": "subslide"}
OBJECT, SEEN, WITHIN, GUESS = (2.6, 0.55), (2.6, 0.24), (0.15, 0.06), (0.8, 4.2, -1.6, 3.8)


def cut(edges_used, robot_within, heading_within):
    """The robot's box, the edges, and what they leave of the object's box."""
    robot = (*around(0, robot_within), *around(0, 0.6 * robot_within))
    lines = edges(SEEN, WITHIN, SEEN[1], WITHIN[1] + heading_within, robot)[:edges_used]
    box = GUESS
    for line in lines:
        box = clip(box, line)
    return robot, lines, box


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def cut_step_by_step(**how):
    robot, lines, box = cut(**how)
    area = width(box[:2]) * width(box[2:])
    fig, ax = views.boxes.scene(f"{area:.1f} m² are left", (-3.4, 5.4, -1.8, 4), size=(8, 5.4))
    named = {"robot": ("robot", robot), "object before": ("before", GUESS)}
    for label, (name, row) in (named | {"object now": ("box", box)}).items():
        views.draw(ax, Boxes(name, [row]), linewidth=2, label=label)
    views.draw(ax, Points("truth", [OBJECT]), markersize=12, label="true object")
    views.boxes.edges(ax, lines, NAMES[: len(lines)])
    views.legend(ax, loc="upper left")
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    cut_step_by_step,
    lambda edges_used, robot_within, heading_within: (
        f"The object's box after {edges_used} edges; robot known within {robot_within:.2f} m and "
        f"{heading_within:.2f} rad. Edges push out as the robot's box grows; the true object stays inside."
    ),
    play="edges_used",
    edges_used=(0, 4, 4),
    robot_within=(0.0, 1.0, 0.3),
    heading_within=(0.0, 1.2, 0.3),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Go back to 0 edges and press ▶. The left edge forbids what lies above it; the box ends where that
# edge leaves the box on the right. The upper left corner stays, though it is forbidden: a box has
# no slanted sides. Then widen the robot's box or its heading, and see how little is learned about
# the object from a robot that hardly knows where it is.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask whether another order of the edges gives another box. Try it: reverse
# `lines` in the function `cut`.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The robot learns, too
#
# If the robot sees the object in some direction, then the object "sees" the robot in the opposite one, at the same range.
# So the robot's box is cut by the same four edges, turned by $\pi$, and pushed out by the
# *object's* box. We try it with an object known within 1 m, and with one from a map, known within 5 cm:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
robot, d_abs = (-0.4, 0.4, -0.25, 0.25), WITHIN[1] + 0.3
for known_within in (1.0, 0.05):
    target = (*around(OBJECT[0], known_within), *around(OBJECT[1], known_within))
    box = robot
    for line in reversed_edges(SEEN, WITHIN, SEEN[1], d_abs, target):
        box = clip(box, line)
    print(f"object within {known_within:.2f} m: robot's box", np.round(box, 2))

# %% [markdown] slideshow={"slide_type": "fragment"}
# From the first object the robot learns nothing. From the second it learns that it cannot be
# farther away than $r + d_r$: one side of its box moves. An object that is known less well than the
# robot cannot help it here.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The heading: which bearings are possible at all?
#
# Wherever the robot is in its box and the object is in its own, the direction from the one to the other lies between two
# extremes. The robot measured it relative to its heading, as $\beta$, within $d_\beta$. So the heading is one of those
# directions less the measured bearing:
#
# $$\theta \;\in\; [\text{bearings from box to box}] - [\beta - d_\beta,\ \beta + d_\beta]. \tag{10.10}$$
#
# If the boxes overlap, every direction is possible, and the sighting says nothing about the heading.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
bearings = bearing_interval(robot, target)
after = contract_heading((-0.4, 0.25), robot, target, SEEN, WITHIN)
print("bearings", np.round(bearings, 2), " heading before [-0.4, 0.25], after", np.round(after, 2))

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
fig, ax = views.boxes.scene(None, (-1, 4, -1.2, 1.6), size=(8, 4.6))
views.boxes.directions(ax, (0, 0), bearings, 3.0, "possible bearings, from the middle")
views.draw(ax, Boxes("robot", [robot]), linewidth=2)
views.draw(ax, Boxes("landmark", [target]), linewidth=2, label="object")
for x0, x1, y0, y1 in ([0.4, 2.55, -0.25, 0.6], [-0.4, 2.65, 0.25, 0.5]):
    ax.plot([x0, x1], [y0, y1], color=views.COLOURS["before"], zorder=0)
views.legend(ax, loc="upper left")
views.show(
    fig,
    f"Bearings from {bearings[0]:.2f} to {bearings[1]:.2f} rad lead from the robot's box to the object's; drawn "
    "from the middle of the robot's box they cover far more than the object.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The slice is much wider than the object, since its sides are parallel to the steepest and the
# flattest line from box to box (grey). Each of these lines joins a corner of one box to a corner of
# the other.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Again while it shrinks
#
# A sharper heading means a smaller $d_{\mathrm{abs}}$. That cuts the object's box and the robot's more, which
# sharpens the heading further. So the filter goes round, as long as some side shrinks by more than 1 %.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
state = (-1.14, 1.14, -0.14, 0.14), (-0.89, 0.89), (2.57, 2.63, 0.52, 0.58)
for k in range(5):
    box, heading, _ = state
    area = width(box[:2]) * width(box[2:])
    print(f"round {k}: robot {area:.3f} m², heading {width(heading):.3f} rad")
    state = contract_once(*state, (2.7, 0.2), (0.05, 0.02))

# %% [markdown] slideshow={"slide_type": "subslide"}
# Soon nothing shrinks any more. That does not mean that the boxes are now the smallest that could
# be guaranteed. Each round gives away two things: the edges are drawn for all headings of the
# interval at once, and after each edge a box is put round what is left. The exercise asks what can
# be won back.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The filter
#
# This is all of it. A step **predicts** the robot's box by (10.3), **updates** by every object that
# is seen again, and **adds** every object that is new. A new object gets the box of all places
# where it can be. This box is computed like a prediction, since a range in some direction is like a
# drive in that direction. *This is a good place for a break.*

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Part two: the guarantee
#
# **Claim.** If every noise stays within its bounds, and every sighting is of the object that it is taken for, then the
# truth is *never* outside of its box. We mean never, and not 95 % of the time.
#
# How does one test a "never"? By trying to break it. Each of the following 200 worlds is drawn anew: three ways
# to drive; bounds from a tenth of a millimetre to a metre; noise that fills its bounds, or always sits at an end of
# them; objects in one heap; headings that wrap, or are wholly unknown.

# %% slideshow={"slide_type": "subslide"}
ask(
    "10-never",
    "A filter with ellipses drives through these 200 worlds as well, 60 steps in each. Suppose its ellipses "
    "are honest, and hold 95 %. **In how many of the 12 000 steps is the robot outside of its ellipse?**",
    right=600,
    tolerance=100,
    unit="steps",
    reason="an honest 95 % ellipse leaves the robot outside in 5 % of the steps: that is what 95 % means.",
    wrong={
        0: "then it would be larger than it claims. An honest 95 % ellipse is left in 5 % of the steps."
    },
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="10-never"
runs = [study.violations(seed, steps=60) for seed in range(200)]
for name in ("steps", "outside", "empty"):
    print(f"{name:8}", views.grouped(sum(each[name] for each in runs)))

# %% [markdown] slideshow={"slide_type": "subslide"}
# No truth lay outside of any box, and no intersection was empty. The same study over 5000 worlds is stored with the
# course. You can run it again, with the command that the next cell prints:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
table = stored("boxes")
assert table["command"].startswith(f"python -m {study.__name__} "), "the command must be there"
print(table["command"].split(" --jobs")[0])
print({name: table["counted"][name] for name in ("steps", "sightings", "outside", "empty")})

# %% [markdown] slideshow={"slide_type": "fragment"}
# In {= table["counted"]["steps"] =} steps the truth was outside {= table["counted"]["outside"] =} times. A guarantee is
# a wonderful thing to test. A single counterexample is a bug, and no statistics can excuse it.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Such a run has found a bug. Two intervals of a whole turn have two pieces in common, and one of them
# is a single angle; an early form of the filter took that one for the whole intersection.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Beyond a right angle
#
# (10.6) was derived for angles below $\pi/2$. What if the robot hardly knows its heading, and $d_{\mathrm{abs}}$ is larger
# than that? We draw the four edges all the same, and count the possible places that they cut off.

# %% slideshow={"slide_type": "fragment"}
half_widths = np.linspace(0.2, 3.1, 60)
shares = {"possible places": [100 * cut_off(0.2, d_abs) for d_abs in half_widths]}
fig, ax = views.curves(half_widths, shares, "$d_{abs}$ [rad]", "cut off [%]", size=(8, 3.6))
ax.axvline(np.pi / 2, color=views.COLOURS["limit"], linestyle="dashdot", label="π/2")
views.legend(ax)
lost = shares["possible places"]
views.show(fig, f"None is cut off up to a right angle, and {lost[-1]:.0f} % are at half a turn.")

# %% [markdown] slideshow={"slide_type": "subslide"}
# Up to a right angle nothing is lost. Beyond it the near edge changes sides, and the region between
# the two rays is no longer the intersection of two half-planes. At half a turn, nearly every
# possible place is cut off. (The slider of "A sighting leaves a region" shows how.)

# %% [markdown] slideshow={"slide_type": "subslide"}
# So the four edges are used **only where $d_{\mathrm{abs}} < \pi/2$**. Beyond, `BOR` uses what is
# true for any bearing: the object is within $r + d_r$ of the robot. That is a square round the
# robot's box. This matters, because it lets a robot that has lost its heading find it again from an
# object that it knows.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## One bad bound
#
# Now we break the promise, once. The map is known. In step 20, *one* range is too long by some times its
# bound, and all other noise stays within its own. We drive 20 steps more.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-lie",
    "One range is off by **twice** its bound, in each of 40 runs. **What happens in most of them?**",
    {
        "the filter notices at once: nothing fits": "it does if the lie is large. But most boxes have some "
        "room to spare, and a small lie fits in.",
        "it notices later, when honest sightings contradict the box": "that happens, but seldom: an honest "
        "sighting contradicts only a box that is quite wrong.",
        "it never notices": "the intersection is not empty, and neither are any that follow. In "
        "about half of these runs the truth has been cut off.",
    },
    right="it never notices",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-lie"
print("off by   at once   later   never, truth out   never, truth in")
silent = {}
for times in (1.5, 2, 3, 5):
    found = [one_bad_range(seed, times) for seed in range(40)]
    at_once = sum(when == 0 for when, _ in found)
    later = sum(when is not None and when > 0 for when, _ in found)
    out, kept = (sum(when is None and o == was for when, o in found) for was in (True, False))
    silent[times] = out
    print(f"{times:5} ×  {at_once:6}  {later:6}  {out:15}  {kept:16}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-lie"
# A gross lie leaves nothing in common and is reported at once. A small one slips in. In between lies the danger: twice
# the bound cut the truth off in {= silent[2] =} of 40 runs without any report, and what was cut off never comes back.

# %% [markdown] slideshow={"slide_type": "subslide"}
# When the filter does notice, it says which object, and what to do, and changes nothing:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
bor = BOR((0, 0, 0, 0), (0, 0), {4: (2, 2, 0, 0)})
try:
    bor.update(4, (2.6, 0.0), (0.2, 0.1))
except EmptyIntersection as error:
    print(textwrap.fill(str(error), 90))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The estimator `bor` leaves such a sighting out, says *lost* in its status, and promises nothing from there on. Two ways out
# are known: widen all bounds and run the log again, or allow that some of many readings may lie, and keep
# what all but a few of them have in common (Jaulin's *relaxed intersection*).

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Who was seen?
#
# The second condition was that the filter knows which object it sees. If nobody tells it, it uses a
# rule. If the region of the sighting overlaps the box of one object, it is that object. If it
# overlaps none, the object is new. If it overlaps several, the sighting is ignored, and counted.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-chair",
    "A chair that is not in the map stands 60 cm behind a post that is. The robot, known within half a metre, "
    "sees the chair. All noise keeps its bounds. **What becomes of the robot's box?**",
    {
        "it stays as it was: the chair is a new object": "the region of the chair reaches over the post, since "
        "the robot does not know so well where it stands. So it is taken for the post.",
        "it gets smaller, and holds the robot": "it gets smaller. But it is cut by the edges of an object "
        "that was not seen.",
        "it gets smaller, and the robot is outside": "some pose explains the sighting by the post, so "
        "nothing is empty and nothing is reported.",
    },
    right="it gets smaller, and the robot is outside",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-chair"
before, true_pose, chair = (-0.5, 0.5, -0.5, 0.5), np.array([0.4, 0.0, 0.0]), np.array([2.6, 0.1])
bor = BOR(before, (-0.1, 0.1), {"post": (2.0, 2.0, 0.0, 0.0)})
print("taken for:", bor.take(h(true_pose, chair), (0.05, 0.02)))
print("the robot's box holds the robot:", inside(bor.robot, true_pose))

# %% slideshow={"slide_type": "fragment"} answers="10-chair" tags=["folded"]
fig, ax = views.boxes.scene(None, (-0.8, 3.2, -0.7, 0.7), size=(8, 3.6))
for name, row in (("before", before), ("corrected", bor.robot)):
    views.draw(
        ax, Boxes(name, [row]), label=f"robot's box {'after' if name != 'before' else name}", lw=2
    )
things = (
    ("landmark", "post", (2.0, 0.0)),
    ("naive", "chair", chair),
    ("truth", "true robot", (0.4, 0.0)),
)
for meaning, label, at in things:
    views.draw(ax, Points(meaning, [at]), markersize=12, label=label)
views.legend_below(fig)
views.show(fig, "The robot's box shrinks to its left end, and the true robot stands outside of it.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-chair"
# The box is small, and the true robot stands outside of it, though no noise was out of bounds and nothing was
# reported.

# %% [markdown] slideshow={"slide_type": "subslide"}
# This rule can start a vicious circle. The wider the boxes are, the more of them a region overlaps.
# So more sightings are ambiguous and are ignored, and the boxes become wider still. Lesson 12
# counts what this does on eighty drives.
#
# So a guarantee is no better than its weakest condition. Here it was the name of the object, and
# not the noise.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=11
# ## Box beside ellipse
#
# A filter with boxes and one with ellipses (lesson 06's MAK) get the same readings: ten simulated runs of 150 steps, nearly two
# rounds, with a robot and a sensor five times as good as in lesson 06. The noise is Gaussian, so no bound is safe for ever; we
# take $3\sigma$. And there is a third competitor: the wheels alone, with no sensor at all.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-nearest",
    "Take the middle of the robot's box as the box's estimate of its position. **Who is nearest to the truth, and "
    "who is farthest from it?**",
    {
        "ellipse nearest, then box, then wheels": "the box uses the sensor, so it should beat the wheels. But its "
        "middle is no best guess: it moves whenever any one side moves.",
        "box nearest, then ellipse, then wheels": "the box has the stronger claim, but a claim that must hold in "
        "the worst case says little about the usual case.",
        "ellipse nearest, then wheels, then box": "nothing draws the middle of a box to where the robot is "
        "likely to be. The box was made to hold the robot, and that it does.",
    },
    right="ellipse nearest, then wheels, then box",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-nearest"
BETTER = Loop(v_sigma=0.004, omega_sigma=0.0024, range_sigma=0.02, bearing_sigma=np.radians(0.4))
sources = [LandmarkRun(replace(BETTER, steps=150), np.random.default_rng(k)) for k in range(10)]
races = [race(source) for source in sources]
off = {name: 100 * np.array([each.rms()[name] for each in races]) for name in races[0].rms()}
for name, errors in off.items():
    print(
        f"{name:8} off by {np.median(errors):4.1f} cm (median of 10 runs, {errors.min():.1f} to {errors.max():.1f})"
    )
half_side = 100 * np.median([each.half_side.mean() for each in races])
broken = sum(each.outside.any() for each in races)
worse = np.sum(off["box"] > off["wheels"])
print(f"half a side of the box: {half_side:.0f} cm; runs in which any truth was outside: {broken}")

# %% slideshow={"slide_type": "subslide"} answers="10-nearest" tags=["folded"]
first = races[0]
fig, _ = views.side_by_side(
    {"boxes, 3σ": first.box.layers(), "ellipses, 95 %": first.ellipse.layers()}, size=(9, 4.4)
)
views.show(
    fig,
    f"The same run twice: landmarks' boxes of metres on the left, where the robot's box has a half side of "
    f"{first.half_side.mean():.1f} m on average; on the right ellipses that hardly show.",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-nearest"
# The box kept its promise in all ten runs. But its middle was farther off than the wheels alone in {= worse =} of 10, by
# {= np.median(off["box"] / off["wheels"]):.1f =} times in the median, while the ellipse was
# {= np.median(off["wheels"] / off["ellipse"]):.0f =} times nearer than the wheels. A box that claims so
# little, {= half_side:.0f =} cm to either side, is easily right.
#
# So do not take the middle of a box for an estimate. A box says where the robot *cannot* be.

# %% slideshow={"slide_type": "subslide"} answers="10-nearest" tags=["folded"]
names = {"ellipse": "ellipse", "wheels": "wheels", "box": "box's middle"}
curves = {label: first.errors[name] for name, label in names.items()}
curves["half a side of the box"] = first.half_side
fig, ax = views.curves(range(151), curves, "step", "errors, claim [m]", size=(8, 4.2))
for line in ax.lines[2:]:
    line.set_color(views.COLOURS["box"])
views.legend(ax)
views.show(
    fig,
    f"The box's claim rises to {first.half_side.max():.1f} m and falls when the loop closes; the errors stay "
    f"below it, the box's at most {first.errors['box'].max():.1f} m, the ellipse's {first.errors['ellipse'].max():.2f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-nearest"
# The claim rises while the robot crosses unknown ground, and falls where known objects come back
# into sight. The error mostly stays far below the claim, since the worst case hardly ever happens.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Why so wide?
#
# Bounds add up, while independent errors partly cancel. Let one step err with the standard deviation $\sigma$, and let its
# bound be $k\sigma$. After $m$ steps without a sighting,
#
# $$\text{the bound is } m k\, \sigma, \qquad \text{the standard deviation is } \sqrt m\, \sigma, \tag{10.11}$$
#
# so the bound is $k\sqrt m$ standard deviations. Do a thousand robots that drive 600 steps agree?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
m, k, sigma = 600, 3, BETTER.v_sigma
drifts = np.random.default_rng(6).normal(0, sigma, (1000, m)).sum(axis=1)
ratio = m * k * sigma / drifts.std()
print(
    f"bound {m * k * sigma:.1f} m, σ of 1000 robots {drifts.std():.2f} m: {ratio:.0f} times as much"
)
print(
    f"by the formula {k * np.sqrt(m):.0f}; the farthest robot of all is {np.abs(drifts).max():.2f} m off"
)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## How many sigmas are enough?
#
# A bound of fewer sigmas gives smaller boxes. How often is the truth then outside of some box, and how often does the filter
# find out? These are the same ten runs:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
by_sigmas = {k: [race(source, k) for source in sources] for k in (1, 2)} | {3: races}
for k, each in by_sigmas.items():
    out = [one for one in each if one.outside.any()]
    told, middle = (
        sum(bool(one.box.lost) for one in out),
        np.median([one.rms()["box"] for one in each]),
    )
    print(
        f"{k}σ: outside in {len(out):2} of 10 runs, reported in {told}; middle off by {100 * middle:.0f} cm"
    )
out_at_2 = [one for one in by_sigmas[2] if one.outside.any()]

# %% [markdown] slideshow={"slide_type": "fragment"}
# At $2\sigma$ the promise was broken in {= len(out_at_2) =} runs, and the filter reported
# {= sum(bool(one.box.lost) for one in out_at_2) =} of them. An empty intersection proves that a bound was broken, but a broken
# bound need not leave anything empty. **No report is no proof.** So take wide bounds.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## When the ellipse was told wrong
#
# So far the noise was what the ellipse had been told: independent from step to step. Now let a gyroscope have a bias: the turn of
# *every* step is measured $1.5\sigma$ too high, and there is no other error of the odometry. This is within $3\sigma$, as the box was told.
#
# We draw how far each estimate is off, as a share of its claim: of half a side of the box, and of the radius of the 95 % ellipse.
# Above 1 the robot is outside.


# %% slideshow={"slide_type": "subslide"}
STEADY = LandmarkRun(replace(BETTER, steps=160, v_sigma=0, omega_sigma=0), np.random.default_rng(3))


def biased(sigmas, bias):
    return race(STEADY, sigmas, BETTER.robot, bias * BETTER.omega_sigma)


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def shares_of_claims(bias_in_sigmas, bound_in_sigmas):
    each = biased(bound_in_sigmas, bias_in_sigmas)
    shares = {"95 % ellipse": each.ellipse_share, "box": each.box_share}
    fig, ax = views.curves(
        np.arange(len(STEADY)), shares, "step", "off by, share of claim [1]", size=(8, 4.4)
    )
    ax.lines[1].set_color(views.COLOURS["box"])
    ax.axhline(1, color=views.COLOURS["limit"], linestyle="dashdot", label="outside above this")
    ax.set(ylim=(0, 5))
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    shares_of_claims,
    lambda bias_in_sigmas, bound_in_sigmas: (
        f"With a bias of {bias_in_sigmas:.1f}σ and bounds of {bound_in_sigmas:.1f}σ; at first the ellipse's "
        "error climbs far above its claim, and the box's stays below."
    ),
    bias_in_sigmas=(0.0, 4.0, 1.5),
    bound_in_sigmas=(1.0, 4.0, 3.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The ellipse (blue) claims far too little while the robot drives over unknown ground: its error is
# several times its claim. The box stays well below 1. How often was the robot outside, and who was
# nearer to it?

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
steady = biased(3.0, 1.5)
misses = np.sum(steady.ellipse_share > 1), np.sum(steady.box_share > 1)
print(f"robot outside in {misses[0]} of {len(STEADY)} steps: ellipse;  in {misses[1]}: box")
print({name: f"off by {100 * error:.0f} cm" for name, error in steady.rms().items()})

# %% [markdown] slideshow={"slide_type": "fragment"}
# The bias breaks the assumption behind the ellipse, but not the one behind the box. Set the first
# slider higher than the second, and it breaks both.
#
# Still, look at the errors of this run: the ellipse, although it is far too sure of itself, is
# nearer to the truth. So use **boxes where bounds are known and a wrong claim is costly**, near a
# cliff, or in a proof, and **ellipses where the noise is known and accuracy counts.**

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# F. C. Schweppe, "Recursive state estimation: unknown but bounded errors and system inputs", *IEEE Transactions on Automatic
# Control* 13(1), 1968: filters that ask for a bound and nothing else.
#
# R. E. Moore, *Interval Analysis*, Prentice-Hall, 1966: arithmetic with intervals.
#
# M. Di Marco, A. Garulli, A. Giannitrapani and A. Vicino, "A set theoretic approach to dynamic robot localization and mapping",
# *Autonomous Robots* 16(1), 2004: SLAM with boxes.
#
# L. Jaulin, "Robust set-membership state estimation; application to underwater robotics", *Automatica* 45(1), 2009: bounds
# that some readings may break.
#
# **Read next:** L. Jaulin, "A nonlinear set membership approach for the localization and map building of underwater robots", *IEEE
# Transactions on Robotics* 25(1), 2009.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can bound a drive that starts anywhere in a box, cut boxes by the edges of a sighting, handle
# intervals of angles across ±180°, and say what a guarantee rests on and what it costs.
#
# **What comes next:** [lesson 11](11_samples.ipynb) keeps neither a box nor an ellipse, but a cloud of samples. In
# [lesson 12](12_three_filters.ipynb) all three drive the same robot.
#
# The sections below this one are optional.
#
# **Exercise:** [10 · Boxes](../exercises/ex10_boxes.ipynb). You write the intervals, the edges and the heading, find out what a
# range alone leaves of a box, and make the boxes as small as they can be.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: when is an interval the tightest?
#
# Let $d$ lie between 0 and 1. What is the range of $d - d$? Of course it is 0. But by intervals it is
# $[0, 1] - [0, 1] = [-1, 1]$. Intervals forget that both $d$ are the same one.
#
# Where each uncertain quantity stands **once**, nothing can be forgotten, and the result is exact. That is so for the steered robot.
# Two wheels that roll $s_l$ and $s_r$ give both the distance, $(s_l + s_r)/2$, and the turn, $(s_r - s_l)/B$. So each of
# them stands twice in $x'$. The box is still sound, but wider than it need be:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
left_way, right_way = (0.28, 0.32), (0.33, 0.37)
box, _ = predict_box((0, 0, 0, 0), (0, 0), *wheels(left_way, right_way, 0.3))
rolled = np.random.default_rng(2).uniform(*zip(left_way, right_way, strict=True), (20_000, 2))
ends = np.array([arc(*ways, 0.3) for ways in rolled])
for name, k in (("x", 0), ("y", 1)):
    ratio = width(box[2 * k : 2 * k + 2]) / np.ptp(ends[:, k])
    print(f"{name}: {ratio:.1f} times as wide as what 20 000 drives fill")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: two intervals of angles may meet twice
#
# What have the headings "from −150° to 150°" and "from 120° to 240°" in common? On a circle two intervals can overlap at both ends:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
wide, behind = angle_interval(*np.radians([-150, 150])), angle_interval(*np.radians([120, 240]))
pieces = intersection(wide, behind)
print([tuple(int(angle) for angle in np.degrees(piece).round()) for piece in pieces])

# %% slideshow={"slide_type": "fragment"}
fig, ax = views.boxes.scene(None, (-2.4, 2.4, -1.5, 1.5), size=(8, 5))
for name, interval, radius in (("box", wide, 1.0), ("scan", behind, 1.3)):
    colour, label = views.COLOURS[name], {"box": "wide", "scan": "behind"}[name]
    views.boxes.directions(ax, (0, 0), interval, radius, label, facecolor=colour, edgecolor=colour)
views.legend(ax, loc="upper right")
views.show(
    fig, "Two slices of a circle overlap at the upper left and the lower left, with a gap between."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The filter has room for one interval, so it takes the smallest one that encloses both pieces. Here
# that is the whole second interval: it is wider than it need be, but never wrong.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: what it costs
#
# There are four numbers an object, and a sighting changes one object and the robot. Its time does not depend on the number of
# objects, if somebody says *who* was seen. To find out, all boxes have to be asked.


# %% slideshow={"slide_type": "fragment"}
def seconds_of(call, n=50):
    return min(repeat(call, number=n, repeat=7)) / n


def cost(N):
    """Microseconds of a sighting among N objects: known who; and to find out who."""
    at = np.random.default_rng(N).uniform(-np.sqrt(N) / 2, np.sqrt(N) / 2, (N, 2))
    bor = BOR((0, 0, 0, 0), (0, 0), {i: (x, x, y, y) for i, (x, y) in enumerate(at)}, N)
    i = int(np.hypot(*at.T).argmin())
    z, bounds = h(np.zeros(3), at[i]), (0.1, 0.05)
    known = seconds_of(lambda: bor.update(i, z, bounds))
    return 1e6 * known, 1e6 * seconds_of(lambda: bor.overlapping(z, bounds))


# %% slideshow={"slide_type": "fragment"}
print("      N   known   find out   memory of BOR   of MAK (06)")
for N in (100, 10_000, 100_000):
    known, find = cost(N)
    memory = 32 * N / 1e3, 8 * (3 + 2 * N) ** 2 / 1e6
    kB, MB = (f"{views.grouped(f'{each:.1f}'):>9}" for each in memory)
    print(f"{views.grouped(N):>7}  {known:4.0f} µs   {find:6.0f} µs   {kB} kB {MB} MB")

# %% [markdown] slideshow={"slide_type": "fragment"}
# If the object is known, the time is constant. To find it among $N$ costs a time that grows with
# $N$, though slowly at first, since numpy compares quickly. A spatial index would cure that. The
# last two columns compare the memory: with correlations it grows with the square of $N$, and with
# boxes in proportion to $N$.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print
#
# Optional: what the MAK thesis prints of this filter, in its section 5.2, and what came of it.
#
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | 5.2.3 | the heading's left end comes first | 5.2.4 has right first; one order, (10.2) | all wrong headings, no right one |
# | 5.2.6 | four edges, for any $d_{\mathrm{abs}}$ | only below $\pi/2$ | the truth is cut off |
# | 5.2.9, 5.2.10 | of several objects nothing is said; then: a new one | ignore the sighting | duplicates |
# | 5.2.9 | holds the text on the heading, and cites 5.2.7 | belongs to 5.2.8, means 5.2.6 | none |
# | 5.2 | the cost of a sighting does not change | only if it is known who is seen | see "What it costs" |
# | 5.2 | nothing on empty intersections | report them | lost without a word |

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
true_heading, heading = 0.05, (-0.1, 0.2)
swapped = angle_interval(heading[1], heading[0] + 2 * np.pi)  # left read as right
print("5.2.3 read as 5.2.4 holds the heading:", contains(swapped, true_heading))
print(f"edges at d_abs = 2.5 cut off {100 * cut_off(0.2, 2.5):.0f} % of what is possible")


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for rule, several_are_new in {"ignored": False, "a new one": True}.items():
    made = [objects_made(seed, several_are_new) for seed in range(10)]
    print(f"of several {rule:9}: {np.median(made):5.1f} objects for 6 (median of 10 runs)")

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the printed rule every ambiguous sighting adds an object, which makes the next one more ambiguous.
