# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 10 · Set-membership SLAM: the BOR filter
#
# **You will be able to** enclose a robot and its map in boxes that are guaranteed to contain the truth,
# as long as certain conditions are met; predict such boxes by interval arithmetic and contract them
# with a measurement; and state the cost of the guarantee, and the consequences of a violated condition.
#
# **90 minutes**, in two parts: how the filter works (50), and what its guarantee is worth (40).
# **Before:** lesson [04](04_models_and_jacobians.ipynb) for the models, lesson
# [06](06_ekf_slam.ipynb) for SLAM, and some trigonometry.
#
# *Key:* an ellipse describes how likely an error is; a box describes the largest possible error.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Part one is a lecture at the board, illustrated by the figures. Part two compares
# the guarantee with the accuracy of the filter. If time is short, leave out "Data association by
# overlap". Reserve ten minutes for "Boxes compared with ellipses"; the class should remember its three
# numbers. For a poll, use the questions on the overlap, on the bent hook, on the motion, and on the
# nearest estimate. In the section on interval arithmetic, ask for which headings the corners are
# sufficient, and at which angles a side of the box no longer moves. At the clipping, ask whether
# another order of the edges gives a different box, and reverse `lines` in the function `cut`. The
# algorithm is a good place for a break.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import textwrap
from dataclasses import replace
from timeit import repeat

import numpy as np
import sympy as sp
from scipy.stats import binom, norm

from classroom.checks import ask, compare
from course.studies import box_containment as study
from course.studies.bound_violations import beyond_bounds, compare_filters, cut_off, one_bad_range
from course.studies.study_command import stored
from slamlab import views
from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.estimators.set_membership_slam import SetMembershipSlam
from slamlab.evaluation import inside
from slamlab.filters.set_membership import BOR, EmptyIntersection
from slamlab.filters.set_membership import angle_intervals as angles
from slamlab.filters.set_membership.clipping import clip
from slamlab.filters.set_membership.contraction import contract_heading, contract_once
from slamlab.filters.set_membership import half_planes
from slamlab.filters.set_membership.intervals import add, around, cosine, product, scaled, width
from slamlab.filters.set_membership.prediction import predict_box, wheels
from slamlab.geometry import wrap
from slamlab.layers import Boxes, Points
from slamlab.models import h
from slamlab.simulation import arc
from slamlab.sources.landmark_runs import LandmarkRun, Loop

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Bounded errors
#
# The maker of a tape measure guarantees that its error is never more than 10 cm. We measure the
# distance of a wall that is 2 m away twelve times. The true distance is *certainly* within 10 cm of
# each reading. All twelve statements are true at the same time, so the true distance lies where all
# twelve intervals overlap.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The answer 5.8 cm is that of statistics with independent errors: let its
# supporters state this assumption. The intersection does not need it, so it also gains less from many
# readings.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-overlap",
    "Each of the twelve intervals is 20 cm wide. **How wide is their overlap?**",
    {
        "1.7 cm: a twelfth of 20 cm": "the width does not depend on the number of readings. "
        "With twelve equal readings the overlap would still be 20 cm wide.",
        "5.8 cm: 20 cm over the root of 12": "the standard deviation of a *mean* decreases in "
        "this way if the errors are independent. Here we compute no mean, and we did not assume "
        "independence.",
        "it depends on the smallest and the largest reading": "the overlap begins at the largest reading "
        "minus 10 cm, and ends at the smallest one plus 10 cm.",
    },
    right="it depends on the smallest and the largest reading",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-overlap"
WALL, BOUND = 2.0, 0.1
tape = WALL + np.random.default_rng(7).uniform(-BOUND, BOUND, 12)
overlap = tape.max() - BOUND, tape.min() + BOUND
for n in (1, 4, 12):
    print(f"{n:2} readings: {100 * (2 * BOUND - np.ptp(tape[:n])):.1f} cm")


# %% slideshow={"slide_type": "fragment"} answers="10-overlap" tags=["folded"]
def common_part(*intervals):
    low, high = zip(*intervals, strict=True)
    return max(low), min(high)


rows = {f"reading {k + 1}": around(z, BOUND) for k, z in enumerate(tape)}
rows["overlap"] = overlap
fig, _ = views.boxes.intervals(rows, WALL, "distance [m]", "", size=(8, 4.4))
views.show(
    fig,
    f"{len(tape)} intervals, each of which contains the true distance, and their overlap, "
    f"{100 * width(overlap):.1f} cm wide, which contains it.",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-overlap"
# Every interval contains the true distance (dashed line), so the overlap contains it, too. With
# readings $z_k$ whose error is at most $d_z$, the overlap is the interval
#
# $$\left[\; \max_k z_k - d_z,\;\; \min_k z_k + d_z \;\right]. \tag{10.1}$$
#
# Only the smallest and the largest reading determine the overlap; the other readings have no effect.
# This method is **set-membership estimation**, also called **bounded-error** estimation. The estimate
# is the **feasible set**: all values that agree with every measurement and every bound. **Two estimates
# are combined by their intersection.** (In this lesson a $d$ with a subscript is a bound: the largest
# possible error of that quantity.)

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Another tape measure has a bound of only 5 cm. Its three readings are `z`. What is the
# feasible set?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
z, d_z = np.array([3.02, 2.97, 3.04]), 0.05
feasible = ...  # low and high, by (10.1), as [low, high]
compare(feasible, common_part(*(around(each, d_z) for each in z)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# z, d_z = np.array([3.02, 2.97, 3.04]), 0.05
# feasible = [z.max() - d_z, z.min() + d_z]
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Bounds need neither zero mean nor independence
#
# Now the hook of the tape is bent, and *every* reading is about 7.5 cm too long. This error is still
# within the guaranteed 10 cm. For comparison, somebody uses a Kalman filter with the standard deviation
# of a uniform error, 10 cm$/\sqrt 3 = 5.8$ cm, and computes the mean of all twelve readings. The filter
# assumes independent errors, so the mean has $\sigma = 5.8$ cm$/\sqrt{12} = 1.7$ cm.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the supporters of the mean say which errors a mean removes. In the figure,
# first move `too_long_by` beyond the bound, where nobody notices the violation, and then increase the
# scatter until the intersection is empty.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-bent",
    "Every reading is 6 to 9 cm too long. **Which interval contains the true distance: the "
    "overlap, or the mean $\\pm\\, 2\\sigma$, with $\\sigma = 1.7$ cm?**",
    {
        "both": "the error of the mean is about 7.5 cm, which is more than four times its σ of "
        "1.7 cm.",
        "only the overlap": "no error exceeds its bound, so every interval contains the true "
        "distance.",
        "only the mean": "a mean reduces errors that are independent from reading to reading. "
        "These errors all have the same sign.",
        "neither": "each error is within its bound, and the overlap requires nothing else.",
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
    title = "" if low <= high else "the intersection is empty"
    last = len(rows) - len(z)
    fig, ax = views.boxes.intervals(rows, WALL, "distance [m]", "", title, last, size=(8, 4.6))
    ax.set(xlim=(1.75, 2.4))
    return fig


# %% slideshow={"slide_type": "fragment"} answers="10-bent"
views.explore(
    bent_tape,
    lambda too_long_by, scatter: (
        f"Twelve intervals, shifted to the right by {100 * too_long_by:.1f} cm with a scatter of "
        f"{100 * scatter:.1f} cm; with the first values the overlap is wide and contains the "
        "truth, but the interval of the mean does not."
    ),
    too_long_by=(0.0, 0.15, 0.075),
    scatter=(0.0, 0.2, 0.015),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-bent"
# The interval of the mean is narrow and wrong; the overlap is wide and right. Move the first slider
# beyond 0.1 m: the bound is violated, the overlap does not contain the true distance, and the readings
# do not show this. The intersection can be empty only if the readings scatter widely. An empty
# intersection proves that a bound is violated.
#
# A bound does not require errors to be independent, of zero mean, or Gaussian, and it treats systematic
# and random errors alike. So the guarantee of a filter with boxes needs no covariances. Lesson 07
# showed that an ellipse becomes wrong if the filter ignores a common error. A filter with boxes may
# ignore it, because a box allows for every combination of errors, including the worst. Part two shows
# the disadvantage.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The state: boxes, and an interval of angles
#
# The filter is called BOR in the MAK thesis, one of the sources of this course. Its state has two parts:
#
# - for the robot, a box from $x_{\min}$ to $x_{\max}$ and from $y_{\min}$ to $y_{\max}$, and an interval of headings;
# - for each landmark, a box.
#
# So the filter stores four numbers for each landmark, and no numbers for pairs of landmarks.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Draw the circle and mark 170° and −170°. Students want to sort the ends: ask
# which of the two arcs between them is then meant. Skip the cell if time is short.

# %% [markdown] slideshow={"slide_type": "subslide"}
# Intervals of angles have a special difficulty. Consider a heading between 170° and 190°. The wrapped
# ends of this interval are 170° and −170°. But all angles between −170° and 170° lie outside it.
#
# So we never sort the ends. An interval extends from its **right** end counter-clockwise to its
# **left** end. The right end is in $(-\pi, \pi]$, and the left end is the right end plus the width,
# even if the sum exceeds $\pi$. An angle $\theta$ is inside the interval if
#
# $$(\theta - \text{right}) \bmod 2\pi \;\le\; \text{left} - \text{right}. \tag{10.2}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
right, left = np.radians([170, 190])
low, high = sorted([wrap(right), wrap(left)])
for degrees in (180, 0):
    theta = np.radians(degrees)
    by_sorting, by_equation = low <= wrap(theta) <= high, angles.contains((right, left), theta)
    print(f"{degrees:3}° inside?  sorted ends: {by_sorting!s:5}  (10.2): {by_equation}")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=11
# ## Prediction by interval arithmetic
#
# A robot of this course drives a distance $d$ in the direction of its heading plus an angle $\delta$, and turns
# by $\Delta\theta$:
#
# $$x' = x + d\cos(\theta+\delta),\quad y' = y + d\sin(\theta+\delta),\quad \theta' = \theta+\Delta\theta.
# \tag{10.3}$$
#
# (If the robot drives an arc, $d$ is its chord, and $\delta = \Delta\theta/2$. For a steered robot
# whose reference point is the steered wheel, $\delta$ is the steering angle.) Each of these quantities
# is known only within an interval. We want the smallest box that contains every possible position of
# the robot after the motion.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* If time is short, show only the question, (10.4) and the figure; the derivative
# and the two printed checks are for reading.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-ahead",
    "A robot at the origin is headed along $x$, to within 0.5 rad. It drives exactly 1 m. **In which "
    "range is its $x'$?**",
    {
        "it is 0.88: both ends of the heading give it": "both ends give the same value, because "
        "the cosine is even. But the heading can also be anywhere between the two ends.",
        "from 0.88 to 1": "the ends of the heading interval give the smallest value; the middle "
        "of the interval gives the largest.",
        "from 0.5 to 1.5": "the heading error is at most half a radian, but the distance is "
        "exactly 1 m, so $x'$ cannot exceed 1.",
    },
    right="from 0.88 to 1",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-ahead"
# ### The range of a cosine
#
# $\cos(\pm 0.5) = 0.878$, so the two ends alone would give exactly 0.878 for $x'$. But a robot with the
# heading 0 reaches $x' = 1$. A sine or a cosine can have an extremum *inside* the interval. The
# derivative shows where an extremum can be:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="10-ahead"
angle = sp.symbols("theta", real=True)
sp.solveset(sp.diff(sp.cos(angle), angle), angle)

# %% [markdown] slideshow={"slide_type": "subslide"}
# On an interval of angles the cosine has its largest value at an end, unless an angle $2\pi k$ with an
# integer $k$ is inside; then the largest value is 1. The cosine has its smallest value at an end,
# unless an angle $\pi + 2\pi k$ is inside; then the smallest value is −1. Equation (10.2) determines
# which angles are inside. The sine is the cosine of an angle that is smaller by $\pi/2$.
#
# Is the rule right? We compare it with the cosines of a thousand angles of each interval:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for span in [(-0.5, 0.5), (1, 2), (2, 4), (3, 7)]:
    tried = np.cos(np.linspace(*span, 1000))
    ends = np.round([tried.min(), tried.max()], 3)
    print(span, "rule", np.round(cosine(span), 3), " tried", ends)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Interval arithmetic
#
# Computing with intervals instead of numbers is called **interval arithmetic**. The distance is
# uncertain as well, and it is negative if the robot reverses. What is the range of a product
# $\xi\kappa$ if $\xi$ is between −1 and 2, and $\kappa$ between −3 and 1? For a fixed $\kappa$ the
# product is linear in $\xi$, and a linear function has its extrema at the ends of an interval. The same
# is true with $\xi$ and $\kappa$ exchanged. So the four pairs of ends suffice, if $\xi$ and $\kappa$
# may vary independently:
#
# $$[\xi_1, \xi_2] \cdot [\kappa_1, \kappa_2] = \left[\min_{i,j} \xi_i \kappa_j,\;\; \max_{i,j} \xi_i \kappa_j\right].
# \tag{10.4}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print([xi * kappa for xi in (-1, 2) for kappa in (-3, 1)], "→", product((-1, 2), (-3, 1)))

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** One quantity is within $[2, 3]$, another within $[0.5, 1]$. In which interval is the first minus the second?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
difference = ...  # [low, high]
compare(difference, add((2, 3), scaled(-1, (0.5, 1))))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# difference = [2 - 1, 3 - 0.5]
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# Equation (10.3) needs only sums, products, and the ranges of sine and cosine. The result is the
# smallest possible box *if $d$, $\delta$ and $\Delta\theta$ are bounded independently*: then no
# uncertain quantity occurs twice in $x'$, or twice in $y'$. (For a robot with two wheels these
# quantities are not independent; the first *Deeper* section shows the consequence.)


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def after_a_motion(heading_within, distance_within):
    heading, distance = around(0.0, heading_within), around(1.0, distance_within)
    box, _ = predict_box((0, 0, 0, 0), heading, distance, (0, 0), (0, 0))
    tried = np.random.default_rng(1).uniform(-1, 1, (2, 800))
    d, theta = 1 + distance_within * tried[0], heading_within * tried[1]
    x, y = np.outer(distance, np.cos(heading)), np.outer(distance, np.sin(heading))
    by_corners = [x.min(), x.max(), y.min(), y.max()]
    fig, ax = views.boxes.scene(None, (-2.2, 2.2, -1.5, 1.5), size=(8, 5))
    ends = Points("sample", np.transpose(d * [np.cos(theta), np.sin(theta)]))
    views.draw(ax, ends, label="possible positions")
    views.draw(ax, Boxes("corrected", [box]), linewidth=2, label="interval arithmetic")
    views.draw(ax, Boxes("naive", [by_corners]), linewidth=2, label="corners only")
    views.legend(ax, loc="upper left")
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    after_a_motion,
    lambda heading_within, distance_within: (
        f"Motions of a metre, within {distance_within:.2f} m and {heading_within:.2f} rad, end on "
        "an arc; the box by interval arithmetic contains all of them, and the box of the corners "
        "cuts off the front of the arc."
    ),
    heading_within=(0.0, 3.2, 0.8),
    distance_within=(0.0, 0.5, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The box of the corners excludes the front of the arc and most of the positions. The box by interval
# arithmetic touches the set of positions on all sides. Widen the headings to more than 90° on either
# side, and then to 180°: one extremum after the other moves from an end of the interval into its
# interior.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## The feasible set of a measurement
#
# The robot observes a landmark at the range $r$, with an error of at most $d_r$, and at the bearing
# $\beta$, with an error of at most $d_\beta$. In the world frame, the direction of the landmark is
# $\theta + \beta$. The heading $\theta$ is known only within an interval of half-width $d_\theta$. The
# errors of bearing and heading can have the same sign. So the direction differs from the middle
# direction by at most
#
# $$d_{\mathrm{abs}} = d_\beta + d_\theta. \tag{10.5}$$

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Sketch the sector and let the class draw the four edges. The usual mistake is a
# near edge that touches the inner arc in its middle and cuts off the two corners. The exercise needs
# the same idea.

# %% [markdown] slideshow={"slide_type": "subslide"}
# From one point, the feasible set of the landmark's position is a sector of a ring. The intersection of
# sectors is difficult to compute, but that of half-planes is easy. A **half-plane** consists of all
# points on one side of a straight line, its **edge**. So we enclose the sector by four edges that do
# not cut off any part of it: this is an **outer approximation**. Two edges contain the rays at
# $\pm\, d_{\mathrm{abs}}$ from the middle direction. The *far* and the *near* edge are perpendicular to
# that direction.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The heading is between 0.1 and 0.5 rad, and the bearing was measured as 0.3 rad, within
# 0.05 rad. By how much can the direction in the world frame differ from the middle direction?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
heading, d_beta = (0.1, 0.5), 0.05
d_abs = ...  # by (10.5)
compare(d_abs, half_planes.absolute_bearing(heading, (2.0, 0.3), (0.1, d_beta))[1])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# heading, d_beta = (0.1, 0.5), 0.05
# d_abs = d_beta + (heading[1] - heading[0]) / 2
# ```
#
# </details>

# %% slideshow={"slide_type": "subslide"}
ask(
    "10-near",
    "How far from the robot can the **near edge** be at most, if it must not cut anything off?",
    {
        "at $r - d_r$": "the middle of the inner arc has this distance. But the ends of the arc "
        "are nearer, measured along the middle direction.",
        "a little nearer than $r - d_r$": "the inner corners of the sector are nearer, along the middle "
        "direction, than the middle of the inner arc.",
        "at $r - d_r - d_{\\mathrm{abs}}$": "metres and radians cannot be added.",
    },
    right="a little nearer than $r - d_r$",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-near"
# ### The near edge, derived
#
# A point of the sector has a range $r'$ and is at an angle $\varphi$ from the middle direction, with
# $|\varphi| \le d_{\mathrm{abs}}$. Along the middle direction it is $r' \cos\varphi$ away. How does that change with
# $r'$ and with $\varphi$?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="10-near"
r_, phi = sp.symbols("r' varphi", positive=True)
sp.diff(r_ * sp.cos(phi), r_), sp.diff(r_ * sp.cos(phi), phi)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-near"
# As long as $|\varphi|$ is less than a right angle, this distance increases with $r'$ and decreases
# with $|\varphi|$. So it is largest in the middle of the outer arc and smallest at the two ends of the
# inner one:
#
# $$\text{far: } r + d_r, \qquad \text{near: } (r - d_r) \cos d_{\mathrm{abs}}. \tag{10.6}$$
#
# (Where $d_r > r$, read 0 for $r - d_r$.)


# %% slideshow={"slide_type": "subslide"} answers="10-near" tags=["folded"]
NAMES = "far", "near", "left", "right"


def one_measurement(range_within, d_abs):
    lost = 100 * cut_off(range_within, d_abs)
    fig, ax = views.boxes.scene(
        f"{lost:.0f} % of the set's points are cut off", (-3.5, 4.5, -2.5, 2.5), size=(8, 5.2)
    )
    ring, directions = around(2.0, range_within), (-d_abs, d_abs)
    views.boxes.sector(ax, (0, 0), ring, directions, "feasible set")
    views.boxes.edges(ax, half_planes.sector_edges(2.0, range_within, 0.0, d_abs), NAMES)
    views.legend_below(fig)
    return fig


# the area between the chord and the arc of 1.6 m, as a share of the set's
without_cosine = 100 * 1.6**2 * (np.tan(0.6) - 0.6) / (0.6 * (2.4**2 - 1.6**2))

# %% slideshow={"slide_type": "fragment"} answers="10-near"
views.explore(
    one_measurement,
    lambda range_within, d_abs: (
        f"A sector of a ring, deep {2 * range_within:.1f} m and wide {2 * d_abs:.2f} rad, with four edges "
        f"that cut {100 * cut_off(range_within, d_abs):.0f} % of its points off; their shaded sides are excluded."
    ),
    range_within=(0.0, 1.0, 0.4),
    d_abs=(0.0, 3.0, 0.6),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-near"
# The near edge passes through the two inner corners, and the four edges do not cut off any feasible
# point. Between edges and arcs some infeasible points are included, because the edges are straight. So
# the result is wider than necessary, but never wrong. Without the cosine the near edge would cut off
# {= without_cosine:.0f =} % of the area of this sector, and no later measurement could restore this
# part.
#
# Now widen $d_{\mathrm{abs}}$ beyond a right angle: the edges are wrong there. A *Deeper* section explains why. For such
# measurements `BOR` uses only the range: the landmark is in the robot's box, enlarged by $r + d_r$ on each side.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## From a box: the Minkowski sum
#
# An edge is a line with a normal $n$, a vector of length one that points outwards. For a robot at the
# position $t$, a point $p$ is feasible if
#
# $$n^{\mathsf T} (p - t) \le c, \tag{10.7}$$
#
# where $c$ is the *signed* distance of the line from the robot along $n$. For the far edge $n$ is the middle direction, and $c = r + d_r > 0$. For the
# near edge $n$ points back to the robot, and $c = -(r - d_r) \cos d_{\mathrm{abs}} < 0$. For the two rays $c = 0$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Move a paper square (the robot's box) along an edge at the board: its farthest
# corner draws the shifted edge. The one sentence to remember is the question about the weakest
# condition.

# %% [markdown] slideshow={"slide_type": "subslide"}
# The position of the robot within its box is unknown. A point may be excluded only if it is excluded
# for *every* $t$ in the box. So we shift the edge outwards, by the largest value of $n^{\mathsf T} t$
# in the box:
#
# $$n^{\mathsf T} p \;\le\; c + \max_{t \,\in\, \text{box}} n^{\mathsf T} t. \tag{10.8}$$
#
# All sums of a point of one set and a point of another form the **Minkowski sum** of the two sets. Equation (10.8) is the edge of the Minkowski sum of the
# half-plane and the robot's box.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The Minkowski sum of two boxes is a box again. The robot is in the box `robot`, and the
# position of the landmark relative to the robot is in the box `offset`. Which box contains the
# landmark?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
robot, offset = np.array([-0.4, 0.4, -0.2, 0.2]), np.array([1.9, 2.1, 0.4, 0.8])
landmark = ...  # [x_min, x_max, y_min, y_max]
compare(landmark, [*add(robot[:2], offset[:2]), *add(robot[2:], offset[2:])])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# robot, offset = np.array([-0.4, 0.4, -0.2, 0.2]), np.array([1.9, 2.1, 0.4, 0.8])
# landmark = robot + offset
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Clipping a box by an edge
#
# Now an edge $n^{\mathsf T} p \le c$ (already shifted outwards) cuts the landmark's box. The remaining
# part can have five corners, but the filter stores only boxes. So we use another outer approximation,
# its smallest enclosing box (the *interval hull*). What is the largest $x$ of this box? A point is
# feasible if $n_x x \le c - n_y y$. This condition is weakest where $n_y y$ has its smallest value in
# the box:
#
# $$n_x\, x \;\le\; c - \min_{y} n_y\, y, \qquad n_y\, y \;\le\; c - \min_{x} n_x\, x. \tag{10.9}$$
#
# *For which point of the box is the condition weakest?* This question is the key to the filter, and to
# its exercise.


# %% slideshow={"slide_type": "subslide"}
# the landmark's box after some of the four edges
LANDMARK, SEEN, WITHIN, GUESS = (2.6, 0.55), (2.6, 0.24), (0.15, 0.06), (0.8, 4.2, -1.6, 3.8)


def cut(edges_used, robot_within, heading_within):
    """The robot's box, the edges, and the landmark's box after the clipping."""
    robot = (*around(0, robot_within), *around(0, 0.6 * robot_within))
    d_abs, box = WITHIN[1] + heading_within, GUESS
    lines = half_planes.edges(SEEN, WITHIN, SEEN[1], d_abs, robot)[:edges_used]
    for line in lines:
        box = clip(box, line)
    return robot, lines, box


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def cut_step_by_step(**how):
    robot, lines, box = cut(**how)
    area = width(box[:2]) * width(box[2:])
    fig, ax = views.boxes.scene(f"{area:.1f} m² are left", (-3.4, 5.4, -1.8, 4), size=(8, 5.4))
    named = {"robot's box": ("robot", robot), "landmark's box before": ("before", GUESS)}
    for label, (name, row) in (named | {"landmark's box now": ("box", box)}).items():
        views.draw(ax, Boxes(name, [row]), linewidth=2, label=label)
    views.draw(ax, Points("truth", [LANDMARK]), markersize=12, label="true landmark")
    views.boxes.edges(ax, lines, NAMES[: len(lines)])
    views.legend(ax, loc="upper left")
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    cut_step_by_step,
    lambda edges_used, robot_within, heading_within: (
        f"The landmark's box after {edges_used} edges; robot known within {robot_within:.2f} m "
        f"and {heading_within:.2f} rad. With a larger robot's box the edges shift outwards; the "
        "true landmark remains inside."
    ),
    play="edges_used",
    edges_used=(0, 4, 4),
    robot_within=(0.0, 1.0, 0.3),
    heading_within=(0.0, 1.2, 0.3),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Go back to 0 edges and press ▶. The left edge excludes all points above it; the new upper side is at
# the height at which the edge crosses the right side of the box. The upper left corner remains in the
# box, although the edge excludes it, because a box has no inclined sides. Then widen the robot's box or
# its heading interval. If the robot's own box is wide, a measurement restricts the landmark only a
# little.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Contracting the robot's box and heading
#
# If the landmark is at some range and direction from the robot, then the robot is at the same range and
# in the opposite direction from the landmark. So the same four edges cut the robot's box, rotated by
# $\pi$ and shifted outwards by the *landmark's* box. We test this with a landmark that is known within
# 1 m, and with a landmark of a map that is known within 5 cm. Which sides of the robot's box will move?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students expect the well-known landmark to move all four sides. Ask why the
# opposite side does not move: the near edge would move it, but the cosine in (10.6) makes this edge
# too weak here. If time is short, only state (10.10).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# contract the robot's box by a landmark known within 1 m, and within 5 cm
robot, d_abs = (-0.4, 0.4, -0.25, 0.25), WITHIN[1] + 0.3
for known_within in (1.0, 0.05):
    target = (*around(LANDMARK[0], known_within), *around(LANDMARK[1], known_within))
    box = robot
    for line in half_planes.reversed_edges(SEEN, WITHIN, SEEN[1], d_abs, target):
        box = clip(box, line)
    print(f"landmark within {known_within:.2f} m: robot's box", np.round(box, 2))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first landmark does not restrict the robot's box. The second one shows that the robot cannot be
# farther away than $r + d_r$: one side of its box moves. Here a landmark with a larger uncertainty than
# the robot cannot contract the robot's box.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Contracting the heading
#
# Which directions are possible? For all positions of the robot and the landmark in their boxes, the
# direction from the robot to the landmark is between two extremes. The robot measured this direction
# relative to its heading, as $\beta$, to within $d_\beta$. So the heading is one of those directions
# minus the measured bearing:
#
# $$\theta \;\in\; [\text{bearings from box to box}] - [\beta - d_\beta,\ \beta + d_\beta]. \tag{10.10}$$
#
# If the boxes overlap, every direction is possible, and the measurement does not restrict the heading.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
bearings = angles.bearing_interval(robot, target)
after = contract_heading((-0.4, 0.25), robot, target, SEEN, WITHIN)
print("bearings", np.round(bearings, 2), " heading before [-0.4, 0.25], after", np.round(after, 2))

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
fig, ax = views.boxes.scene(None, (-1, 4, -1.2, 1.6), size=(8, 4.6))
views.boxes.directions(ax, (0, 0), bearings, 3.0, "possible bearings, from the middle")
views.draw(ax, Boxes("robot", [robot]), linewidth=2, label="robot's box")
views.draw(ax, Boxes("landmark", [target]), linewidth=2, label="landmark's box")
for x0, x1, y0, y1 in ([0.4, 2.55, -0.25, 0.6], [-0.4, 2.65, 0.25, 0.5]):
    ax.plot([x0, x1], [y0, y1], color=views.COLOURS["before"], zorder=0)
views.legend(ax, loc="upper left")
views.show(
    fig,
    f"Bearings from {bearings[0]:.2f} to {bearings[1]:.2f} rad lead from the robot's box to the "
    "landmark's; drawn from the middle of the robot's box, this sector is much wider than the "
    "landmark.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The sector is much wider than the landmark's box, because its sides are parallel to the two extreme
# lines from box to box (both grey). Each of these lines joins a corner of one box to a corner of the
# other.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Constraint propagation
#
# **Contraction** means to reduce a box with a constraint, without excluding any feasible point. The
# measurement is one constraint on three sets. A narrower heading interval means a smaller
# $d_{\mathrm{abs}}$. Then the measurement contracts both boxes further, and the smaller boxes contract
# the heading interval. Contracting all sets in turn until they no longer change is called **constraint
# propagation**. The filter iterates as long as some side shrinks by more than 1 %, at most 20 times.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students expect that the iteration ends at the smallest possible box. It ends
# where the two approximations gain nothing more; ask why smaller pieces of the box would gain more.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
state = (-1.14, 1.14, -0.14, 0.14), (-0.89, 0.89), (2.57, 2.63, 0.52, 0.58)
for k in range(5):
    box, heading, _ = state
    area = width(box[:2]) * width(box[2:])
    print(f"iteration {k}: robot {area:.3f} m², heading {width(heading):.3f} rad")
    state = contract_once(*state, (2.7, 0.2), (0.05, 0.02))

# %% [markdown] slideshow={"slide_type": "fragment"}
# After a few iterations the sets no longer shrink. This does not mean that the boxes are the smallest
# ones that can be guaranteed. Each iteration contains two approximations: the edges are valid for all
# headings of the interval at once, and after each edge a box replaces the remaining set. (The boxes
# become smaller if a box is divided into pieces and each piece is contracted, as in *SIVIA*, set
# inversion via interval analysis. In the exercise you make them as small as possible.)

# %% [markdown] slideshow={"slide_type": "subslide"}
# > **Algorithm: set-membership filter** (BOR, MAK thesis 5.2; Schweppe 1968, contraction as in Jaulin 2009)
# >
# > *Input:* box and heading interval of the robot, boxes of the landmarks; odometry with intervals of $d, \delta, \Delta\theta$; a
# > measurement $z = (r, \beta)$ of landmark $j$ with bounds $d_r, d_\beta$
# >
# > 1. *Predict:* the robot's box and heading by (10.3), in interval arithmetic.
# > 2. If landmark $j$ is new: its box encloses all positions at $r \pm d_r$, $\theta + \beta \pm d_\beta$ from the robot's box. Stop.
# > 3. $d_{\mathrm{abs}} \leftarrow d_\beta + d_\theta$, (10.5), and the edges (10.6). (If $d_{\mathrm{abs}} \ge \pi/2$: only the range.)
# > 4. *Contract* the landmark's box: shift the edges outwards by the robot's box, (10.8), and clip the
# >    landmark's box, (10.9).
# > 5. *Contract* the robot's box: the same edges rotated by $\pi$, shifted outwards by the landmark's
# >    box.
# > 6. *Contract* the heading by (10.10).
# > 7. If a set is empty, report that a condition was violated. If a side shrank by more than 1 %, go to 3, at most 20 times.
# >
# > *Output:* boxes that contain the truth, if the input boxes contain it, every error is within its bound, and
# > landmark $j$ is the right one

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# predict, initialise and update on a run of 60 steps
run = study.BoundedRun(study.BoundedNoise(), np.random.default_rng(4), 60)
bor = run.filter()
for motion, measurements in run:
    bor.predict(*motion)
    for i, z in measurements:
        (bor.update if i in bor else bor.add)(i, z, run.world.seeing)
sides = ", ".join(f"{100 * width(bor.robot[k : k + 2]):.0f} cm" for k in (0, 2))
print(f"{len(bor)} landmarks; sides of the robot's box {sides}")
print("the robot is inside its box:", inside(bor.robot, run.pose))

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Part two: the guarantee
#
# **Claim.** The truth is *never* outside its box if
#
# - the initial box and the initial heading interval contain the truth,
# - every error stays within its bound; effects that the models of motion and sensor omit count as errors, too,
# - every measurement is associated with the right landmark, and landmarks do not move,
# - rounding is outward (the code widens each bound by $10^{-10}$).
#
# The claim says never, and not in 5 % of the steps. We test this claim by trying to refute it. Each of
# the following 200 worlds is drawn at random. They include three motion models; bounds from a tenth of
# a millimetre to a metre; errors that fill the interval between their bounds, or are always at a bound;
# landmarks in one cluster; headings that wrap, or are completely unknown.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class list the conditions before you show them; the initial box and the
# rounding are nearly always forgotten. The sections that follow violate the conditions one at a time.

# %% slideshow={"slide_type": "subslide"}
ask(
    "10-never",
    "A filter with ellipses runs in these 200 worlds as well, 60 steps in each. Suppose that it is consistent: its 95 % "
    "ellipses contain the robot in 95 % of the steps. **In how many of the 12 000 steps is it outside its ellipse?**",
    right=600,
    tolerance=100,
    unit="steps",
    reason="a consistent 95 % ellipse does not contain the robot in 5 % of the steps.",
    wrong={
        0: "then the ellipse would be larger than stated. The robot is outside a consistent 95 % ellipse in 5 % of the steps."
    },
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="10-never"
runs = [study.violations(seed, steps=60) for seed in range(200)]
for name in ("steps", "outside", "empty"):
    print(f"{name:8}", views.grouped(sum(each[name] for each in runs)))
table = stored("box_containment")
print(f"\n{table['command'].split(' --jobs')[0]}")
print({name: table["counted"][name] for name in ("steps", "observations", "outside", "empty")})

# %% [markdown] slideshow={"slide_type": "fragment"}
# The truth was never outside a box, and no intersection was empty. The same study with 5000 worlds is
# stored with the course, and you can run it again with the printed command. In its
# {= table["counted"]["steps"] =} steps the truth was outside {= table["counted"]["outside"] =} times. A
# guarantee is easy to test: a single counterexample proves that the program has a bug. But a million
# steps without a counterexample are not a proof; the derivations above are the proof. (Such a run has
# found a bug, in the intersection of two full circles.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## One outlier
#
# Now we violate a bound once. The map is known. In step 20, *one* range is an **outlier**: it is too long by more than its
# bound. All other errors stay within their bounds. The runs have 40 steps.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Look at the third column of numbers: the dangerous outliers are the small ones.
# Students expect a larger outlier to be more dangerous, because it is in least squares.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-lie",
    "One range is too long by **1.5 times** its bound, in each of 40 runs. **What happens in most of them?**",
    {
        "the filter detects it at once: the intersection is empty": "the intersection is empty "
        "if the outlier is large. But most boxes are larger than necessary, so a small outlier "
        "is still compatible with them.",
        "it detects it later, when correct measurements contradict the box": "this happens with "
        "larger outliers: a correct measurement contradicts a box only if the error of the box "
        "is large.",
        "it never detects it": "neither this intersection nor any later one is empty. In a "
        "third of these runs the truth has been cut off.",
    },
    right="it never detects it",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-lie"
# 40 runs for each size of the outlier
print("off by   at once   later   never, truth out   never, truth in")
undetected, steps_out = {}, {}
for times in (1.5, 2, 3, 5):
    found = [one_bad_range(seed, times) for seed in range(40)]
    at_once = sum(when == 0 for when, _ in found)
    later = sum(when is not None and when > 0 for when, _ in found)
    unnoticed = [steps for when, steps in found if when is None]  # with the truth outside
    undetected[times], steps_out[times] = sum(n > 0 for n in unnoticed), max(unnoticed, default=0)
    kept = len(unnoticed) - undetected[times]
    print(f"{times:5} ×  {at_once:6}  {later:6}  {undetected[times]:15}  {kept:16}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-lie"
# A gross outlier leaves an empty intersection and is reported at once. A small outlier is more
# dangerous, because it is still compatible with the box: at 1.5 and at 2 times the bound, the truth was
# cut off without any report in {= undetected[1.5] =} and {= undetected[2] =} of the 40 runs. No
# measurement can restore the excluded part of a set. (In these runs the truth was inside again after at
# most {= max(steps_out.values()) =} steps, because each motion widens the box. A landmark's box never
# grows.)
#
# When the filter does detect a contradiction, it names the landmark, suggests what to do, and changes nothing:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="10-lie"
bor = BOR((0, 0, 0, 0), (0, 0), {4: (2, 2, 0, 0)})
try:
    bor.update(4, (2.6, 0.0), (0.2, 0.1))
except EmptyIntersection as error:
    print(textwrap.fill(str(error), 90))

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-lie"
# The estimator `bor` ignores such a measurement, shows *lost* in its status, and gives no guarantee
# from then on. There are two solutions: widen all bounds and process the log again; or assume that a
# few of many measurements are outliers, and keep the positions that agree with all measurements except
# these few (Jaulin's *relaxed intersection*, which you compute in the exercise).

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Data association by overlap
#
# The guarantee requires the correct data association. If the measurements have no ids, the filter uses
# a rule. If the feasible set of the measurement overlaps the box of exactly one landmark, the
# measurement is associated with it. If the set overlaps no box, the landmark is new. If it overlaps
# several boxes, the filter ignores the measurement and counts it.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Act the scene with three chairs. The question separates two kinds of guarantee:
# all noise is within its bounds, and the result is still wrong.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-chair",
    "A chair that is not in the map is 60 cm behind a post that is in the map. The robot's box extends half a metre to each side of its "
    "middle; the robot is 40 cm ahead of the middle, towards the post. It observes the chair. All errors are within "
    "their bounds. **What happens to the robot's box?**",
    {
        "it does not change: the chair is a new landmark": "the feasible set of the chair "
        "includes the post, because the robot's box is large. So the measurement of the chair "
        "is associated with the post.",
        "it gets smaller, and contains the robot": "the box gets smaller. But the edges that "
        "cut it belong to a landmark that was not observed.",
        "it gets smaller, and the robot is outside": "for some poses in the box, the "
        "measurement can come from the post, so no set becomes empty and no fault is reported.",
    },
    right="it gets smaller, and the robot is outside",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-chair"
before, true_pose, chair = (-0.5, 0.5, -0.5, 0.5), np.array([0.4, 0.0, 0.0]), np.array([2.6, 0.1])
bor = BOR(before, (-0.1, 0.1), {"post": (2.0, 2.0, 0.0, 0.0)})
print("associated with:", bor.associate_and_update(h(true_pose, chair), (0.05, 0.02)))
print("the robot's box contains the robot:", inside(bor.robot, true_pose))

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
views.show(fig, "The robot's box shrinks to its left end, and the true robot is outside of it.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-chair"
# The box is small, and the true robot is outside it, although no error exceeded its bound. The filter
# reported no fault. A guarantee holds only if all of its conditions hold. Here the data association was
# wrong, while the bounds of the noise were correct.
#
# The rule can also amplify an uncertainty. If the boxes are wide, a feasible set overlaps more of them.
# So more measurements are ambiguous and ignored, and the boxes become even wider. Lesson 12 shows the
# consequences in eighty runs.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Boxes compared with ellipses
#
# A filter with boxes and a filter with ellipses (MAK, from lesson 06) process the same readings. These
# come from ten simulated runs of 150 steps, nearly two laps, with a robot and a sensor five times as
# accurate as in lesson 06. The noise is Gaussian, so no bound is certain; we use $3\sigma$. We also
# compare them with odometry alone.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class write down the three errors before the cell runs. The middle of a
# box is no estimate: ask what the filter minimises (nothing), and why the box is then so wide.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-nearest",
    "Use the middle of the robot's box as an estimate of its position. **Which estimate is nearest to the truth, and "
    "which is farthest from it?**",
    {
        "ellipse nearest, then box, then odometry": "the box uses the sensor, so its error "
        "should be smaller than that of odometry. But its middle is not an optimal estimate: it "
        "moves whenever a single side moves.",
        "box nearest, then ellipse, then odometry": "the box has the stronger guarantee, but a guarantee for "
        "the worst case says little about the usual case.",
        "ellipse nearest, then odometry, then box": "the filter does not move the middle of a "
        "box towards the robot's most likely position. It only ensures that the box contains "
        "the robot.",
    },
    right="ellipse nearest, then odometry, then box",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="10-nearest"
# position errors of both filters and of odometry, in ten runs
BETTER = Loop(v_sigma=0.004, omega_sigma=0.0024, range_sigma=0.02, bearing_sigma=np.radians(0.4))
sources = [LandmarkRun(replace(BETTER, steps=150), np.random.default_rng(k)) for k in range(10)]
results = [compare_filters(source) for source in sources]
NAMED = {"box": "box's middle", "ellipse": "ellipse", "wheels": "odometry"}
rms = {name: 100 * np.array([each.rms()[name] for each in results]) for name in NAMED}
for name, e in rms.items():
    spread = f"{e.min():.1f} to {e.max():.1f}"
    print(f"{NAMED[name]:12} rms error {np.median(e):4.1f} cm (median of 10 runs, {spread})")
half_side = 100 * np.median([each.half_side.mean() for each in results])
out = sum(each.outside.any() for each in results)
worse = np.sum(rms["box"] > rms["wheels"])
print(f"half a side of the box: {half_side:.0f} cm; runs in which any truth was outside: {out}")

# %% slideshow={"slide_type": "subslide"} answers="10-nearest" tags=["folded"]
first = results[0]
fig, _ = views.side_by_side(
    {"boxes, bounds of 3σ": first.box.layers(), "95 % ellipses": first.ellipse.layers()},
    size=(9, 4.4),
)
views.show(
    fig,
    "The same run twice: landmarks' boxes with sides of metres on the left, where the robot's "
    f"box has a half side of {first.half_side.mean():.1f} m on average; on the right ellipses "
    "that are hardly visible.",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="10-nearest"
# The truth was inside all boxes in all ten runs. But the error of the box's middle was larger than that
# of odometry alone in {= worse =} of 10 runs, by a factor of
# {= np.median(rms["box"] / rms["wheels"]):.1f =} in the median. The error of the ellipse was smaller
# than that of odometry by a factor of {= np.median(rms["wheels"] / rms["ellipse"]):.1f =} in the
# median. A box that extends {= half_side:.0f =} cm to either side on average easily contains the truth.
#
# So do not use the middle of a box as an estimate. A box only shows where the robot *cannot* be.

# %% slideshow={"slide_type": "subslide"} answers="10-nearest" tags=["folded"]
curves = {NAMED[name]: first.errors[name] for name in ("ellipse", "wheels", "box")}
curves["half a side of the box"] = first.half_side
fig, ax = views.curves(range(151), curves, "step", "position error, half side [m]", size=(8, 4.2))
for line in ax.lines[2:]:
    line.set_color(views.COLOURS["box"])
views.legend(ax)
views.show(
    fig,
    f"The box's half side rises to {first.half_side.max():.1f} m and falls at the loop closure; "
    f"the errors stay below it: the error of the box is at most {first.errors['box'].max():.1f} "
    f"m, that of the ellipse {first.errors['ellipse'].max():.2f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-nearest"
# The half side increases while the robot drives through unknown parts of the environment, and decreases
# at the **loop closure**, where known landmarks come back into view. The error mostly stays far below
# the half side, because the worst case hardly ever happens.
#
# Why is the box so wide? Bounds add up, while independent errors of zero mean partly cancel. Suppose that the error of one step has the standard deviation $\sigma$ and the
# bound $k\sigma$. After $m$ steps without a measurement,
#
# $$\text{the bound is } m k\, \sigma, \qquad \text{the standard deviation is } \sqrt m\, \sigma, \tag{10.11}$$
#
# so the bound is $k\sqrt m$ standard deviations. We check this with a thousand simulated robots after
# 600 steps:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="10-nearest"
# a thousand robots after 600 steps: standard deviation and bound
m, k, sigma = 600, 3, BETTER.v_sigma
ends = np.random.default_rng(6).normal(0, sigma, (1000, m)).sum(axis=1)
ratio = m * k * sigma / ends.std()
print(
    f"bound {m * k * sigma:.1f} m, σ of 1000 robots {ends.std():.2f} m: {ratio:.0f} times as much"
)
print(f"by (10.11) {k * np.sqrt(m):.0f}; the largest error of all is {np.abs(ends).max():.2f} m")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## A loop closure does not correct a map of boxes
#
# In the first of these runs the loop closes between the steps 60 and 84. Half a side of the robot's box shrinks from
# {= first.half_side[60]:.1f =} m to {= first.half_side[84]:.1f =} m. Landmarks 5 to 8 were observed before, and they are out of view during all these steps.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class read the last three columns first, and then the boxes, which stay
# equal to the last digit. This table is the shortest reason for the covariances of lesson 07.

# %% slideshow={"slide_type": "fragment"}
ask(
    "10-loop",
    "**How does the loop closure change the landmarks that are out of view?**",
    {
        "their boxes and their ellipses shrink": "an ellipse shrinks, because its error is "
        "correlated with the robot's error. But the filter with boxes stores no correlations.",
        "their ellipses shrink, their boxes do not change": "a landmark's box changes only when "
        "that landmark is measured.",
        "neither changes: they were not measured": "in lesson 07, landmarks that were not "
        "measured improved as well, through the cross-covariances.",
    },
    right="their ellipses shrink, their boxes do not change",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output", "code"] answers="10-loop"
model, table_of = (sources[0].robot, sources[0].sensor), {}
box, ellipse = SetMembershipSlam(*model, sigmas=3.0), EkfSlam(*model)
for step, reading in enumerate(sources[0]):
    box.step(reading)
    ellipse.step(reading)
    boxes = dict(zip(box.filter.ids, box.filter.boxes(), strict=True))
    if step in (60, 84, 150):
        for i in (5, 6, 7, 8):
            P = ellipse.filter.block(ellipse.filter.rows([i]))
            half = np.mean([width(boxes[i][:2]), width(boxes[i][2:])]) / 2
            table_of[i, step] = half, 100 * np.sqrt(np.trace(P))
print(
    "landmark   half a side of the box [m]     √trace P [cm]\n       step 60     84    150        60   84   150"
)
for i in (5, 6, 7, 8):
    halves, sigmas = zip(*(table_of[i, step] for step in (60, 84, 150)), strict=True)
    print(f"{i:8}", *(f"{half:6.3f}" for half in halves), "  ", *(f"{s:5.1f}" for s in sigmas))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="10-loop"
# The ellipses shrink to about half their size without a single measurement of these landmarks. The
# boxes keep their width to the last digit until the end of the run. When the robot measures these
# landmarks again, its box has grown again, to a half side of {= first.half_side[119]:.1f =} to
# {= first.half_side[134]:.1f =} m, so it cannot contract their boxes. This result agrees with lesson
# 07: **without correlations, a loop closure corrects only the landmarks that are measured.** This is
# the disadvantage of storing only four numbers for each landmark.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Choosing bounds for Gaussian noise
#
# How many $\sigma$ should a bound have? A bound of fewer $\sigma$ gives smaller boxes. But how often is
# a bound then violated, how often is the truth outside a box, and how often does the filter detect it?
# We use the same ten runs:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The misconception is that $3\sigma$ is practically certain. Ask for the number
# of errors in one run before the *Your turn* cell: with 1350 of them, some are nearly always beyond
# their bound.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the ten runs again, with bounds of 1σ, 2σ and 3σ
by_sigmas = {k: [compare_filters(source, k) for source in sources] for k in (1, 2)} | {3: results}
beyond = {k: [beyond_bounds(source, k) for source in sources] for k in by_sigmas}
print("bound   errors beyond it, per run   runs outside   detected in   rms of the middle")
for k, each in by_sigmas.items():
    outs, counts = [one for one in each if one.outside.any()], [count for count, _ in beyond[k]]
    detected = sum(bool(one.box.lost) for one in outs)
    middle = 100 * np.median([one.rms()["box"] for one in each])
    print(
        f"{k:4}σ {min(counts):15} to {max(counts):3} {len(outs):17} {detected:13} {middle:15.0f} cm"
    )
out_at_2 = [one for one in by_sigmas[2] if one.outside.any()]
values, at_3 = beyond[3][0][1], sum(count for count, _ in beyond[3])

# %% [markdown] slideshow={"slide_type": "fragment"}
# Each run has about {= values =} errors of odometry and measurements. Even at $3\sigma$ some errors
# exceeded their bound in every run ({= at_3 =} in all), so the guarantee covers *none* of the ten runs.
# The truth was nevertheless in its box, because most boxes are larger than necessary. But this margin
# is not a guarantee.
#
# At $2\sigma$ the truth was outside a box in {= len(out_at_2) =} runs, and the filter detected a
# violation in {= sum(bool(one.box.lost) for one in out_at_2) =} of them. An empty intersection proves
# that a bound was violated, but a violated bound does not always cause an empty intersection. **So a
# run without a report does not prove that all bounds were correct.** Choose wide bounds.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** A Gaussian error is beyond $3\sigma$ with the probability `p`. How probable is a run of 1350 independent errors in which
# *no* bound is violated?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
p = 2 * norm.sf(3)
no_violation = ...  # a probability
compare(no_violation, binom.pmf(0, 1350, p))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# p = 2 * norm.sf(3)
# no_violation = (1 - p) ** 1350
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## A systematic error violates the noise model of the ellipse
#
# So far the noise was independent from step to step, as the filter with ellipses assumes. Now suppose
# that a gyroscope has a bias: the rotation in *every* step is measured $1.5\sigma$ too high, and the
# odometry has no other error. This bias is within $3\sigma$, the bound of the box.
#
# We plot the error of each estimate as a ratio. For the box, it is the error divided by half a side (in
# $x$ or in $y$, whichever ratio is larger). For the 95 % ellipse, it is the error divided by the radius
# in the direction of the error. If the ratio is above 1, the robot is outside. (The plot omits the
# ellipse in the first ten steps, in which it is nearly a point.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students expect the filter with the violated assumption to have the larger
# error. Here it is inconsistent and still more accurate: let them say for which task they would
# prefer which filter.


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
STEADY = LandmarkRun(replace(BETTER, steps=160, v_sigma=0, omega_sigma=0), np.random.default_rng(3))


def biased(sigmas, bias):
    return compare_filters(STEADY, sigmas, BETTER.robot, bias * BETTER.omega_sigma)


def shares(bias_in_sigmas, bound_in_sigmas):
    each = biased(bound_in_sigmas, bias_in_sigmas)
    shares = {"95 % ellipse": each.ellipse_share, "box": each.box_share}
    label = "error / radius or half side [1]"
    fig, ax = views.curves(np.arange(len(STEADY)), shares, "step", label, size=(8, 4.4))
    ax.lines[1].set_color(views.COLOURS["box"])
    ax.axhline(1, color=views.COLOURS["limit"], linestyle="dashdot", label="outside above this")
    ax.set(ylim=(0, 5))
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    shares,
    lambda bias_in_sigmas, bound_in_sigmas: (
        f"With a bias of {bias_in_sigmas:.1f}σ and bounds of {bound_in_sigmas:.1f}σ; with the "
        "first values the error of the ellipse becomes much larger than its radius, and that of "
        "the box stays below its half side."
    ),
    bias_in_sigmas=(0.0, 4.0, 1.5),
    bound_in_sigmas=(1.0, 4.0, 3.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The ellipse (solid) is overconfident while the robot drives through unknown parts of the environment:
# the error is several times its radius. The box (dashed) stays well below 1. How often was the robot
# outside, and which estimate was nearer to the truth?

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
steady = biased(3.0, 1.5)
drawn = np.isfinite(steady.ellipse_share)
misses = np.sum(steady.ellipse_share[drawn] > 1), np.sum(steady.box_share[drawn] > 1)
print(f"robot outside in {misses[0]} of {drawn.sum()} steps: ellipse;  in {misses[1]}: box")
print({NAMED[name]: f"rms error {100 * error:.0f} cm" for name, error in steady.rms().items()})

# %% [markdown] slideshow={"slide_type": "fragment"}
# The bias violates the assumption of the ellipse, but not that of the box. If you set the first
# slider higher than the second, the bias violates both. (An EKF can also estimate such a bias as an additional state variable.)
#
# Nevertheless, the ellipse has a smaller error in this run, although it is overconfident. So use
# **boxes if bounds are known and a single miss is dangerous**, for example near a cliff, or if a proof
# is required. Use **ellipses if the noise is known and accuracy is important.**

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# F. C. Schweppe, "Recursive state estimation: unknown but bounded errors and system inputs", *IEEE Transactions on Automatic
# Control* 13(1), 1968: filters that require only a bound.
#
# R. E. Moore, *Interval Analysis*, Prentice-Hall, 1966: interval arithmetic.
#
# M. Di Marco, A. Garulli, A. Giannitrapani and A. Vicino, "A set theoretic approach to dynamic robot localization and mapping",
# *Autonomous Robots* 16(1), 2004: SLAM with boxes.
#
# L. Jaulin, "Robust set-membership state estimation; application to underwater robotics", *Automatica* 45(1), 2009: bounds
# that some measurements can violate.
#
# **Read next:** L. Jaulin, "A nonlinear set membership approach for the localization and map building of underwater robots", *IEEE
# Transactions on Robotics* 25(1), 2009.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can use set-membership estimation: you can predict a box by interval arithmetic, and contract
# boxes with the edges of a measurement. You can compute with intervals of angles across ±180°. You can
# state the conditions of a guarantee and its cost.
#
# **What comes next:** [lesson 11](11_particle_filters.ipynb) uses a set of particles instead of a box
# or an ellipse. In [lesson 12](12_three_filters.ipynb) all three filters run on the same robot.
#
# The sections below this one are optional.
#
# **Exercise:** [10 · Set-membership SLAM: the BOR filter](../exercises/ex10_set_membership_slam.ipynb).
# You program the intervals, the edges and the contraction of the heading, compute what is guaranteed
# if some measurements are outliers, and make the boxes as small as possible.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the dependency problem
#
# Let $d$ be between 0 and 1. What is the range of $d - d$? The difference is always 0. But interval
# arithmetic gives $[0, 1] - [0, 1] = [-1, 1]$, because it treats the two $d$ as independent. This
# effect is the *dependency problem*. (A related problem is the *wrapping effect*: in every step a box
# with sides parallel to the axes encloses a rotated box.)
#
# If each uncertain quantity occurs only **once**, the result is exact. The steered robot satisfies this
# condition. For a robot with two wheels, their distances $s_l$ and $s_r$ determine both the length of
# the arc, $(s_l + s_r)/2$, from which the chord $d$ follows, and the rotation, $(s_r - s_l)/B$. So each
# of the two distances occurs twice in $x'$. The box is still guaranteed, but wider than necessary:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* One line at the board suffices: $x - x$ and $x \cdot x$ for $x$ in $[-1, 1]$. In
# interval arithmetic the second gives $[-1, 1]$ instead of $[0, 1]$.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the predicted box of a robot with two wheels, and 20 000 sampled motions
left_path, right_path = (0.28, 0.32), (0.33, 0.37)
box, _ = predict_box((0, 0, 0, 0), (0, 0), *wheels(left_path, right_path, 0.3))
rolled = np.random.default_rng(2).uniform(*zip(left_path, right_path, strict=True), (20_000, 2))
ends = np.array([arc(*paths, 0.3) for paths in rolled])
for name, k in (("x", 0), ("y", 1)):
    ratio = width(box[2 * k : 2 * k + 2]) / np.ptp(ends[:, k])
    print(f"{name}: {ratio:.1f} times as wide as the range of 20 000 samples")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: beyond a right angle
#
# Equation (10.6) was derived for angles below $\pi/2$. Which error results if the heading is hardly
# known, and $d_{\mathrm{abs}}$ is larger than $\pi/2$? We use the four edges nevertheless, and compute
# the share of the feasible points that they cut off.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask why the near edge changes sides: the cosine in (10.6) becomes negative. The
# lesson for programs is that a formula needs its range of validity in the code.

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
half_widths = np.linspace(0.2, 3.1, 60)
lost = [100 * cut_off(0.2, d_abs) for d_abs in half_widths]
curves = {"feasible points": lost}
fig, ax = views.curves(half_widths, curves, "$d_{abs}$ [rad]", "cut off [%]", size=(8, 3.6))
ax.axvline(np.pi / 2, color=views.COLOURS["limit"], linestyle="dashdot", label="π/2")
views.legend(ax)
views.show(
    fig, f"No point is cut off up to a right angle; {lost[-1]:.0f} % are cut off at half a turn."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Up to a right angle no point is cut off. For larger angles the near edge changes sides, and the region
# between the two rays is no longer the intersection of two half-planes. At 180°, nearly every feasible
# point is cut off.
#
# So the four edges are used **only where $d_{\mathrm{abs}} < \pi/2$**. For larger angles, `BOR` uses a
# condition that is true for any bearing: the landmark is in the robot's box, enlarged by $r + d_r$ on
# each side. This condition is important, because with it a robot with an unknown heading can estimate
# its heading from a known landmark.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: two intervals of angles may meet twice
#
# What is the intersection of the headings "from −150° to 150°" and "from 120° to 240°"? On a circle,
# two intervals can overlap at both ends:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class find two arcs on a circle whose intersection has two pieces; three
# pieces are impossible with two arcs.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
wide, behind = (angles.angle_interval(*np.radians(ends)) for ends in ([-150, 150], [120, 240]))
pieces = angles.intersection(wide, behind)
print([tuple(int(angle) for angle in np.degrees(piece).round()) for piece in pieces])

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
fig, ax = views.boxes.scene(None, (-2.4, 2.4, -1.5, 1.5), size=(8, 5))
for name, interval, radius in (("box", wide, 1.0), ("scan", behind, 1.3)):
    colour, label = views.COLOURS[name], {"box": "wide", "scan": "behind"}[name]
    views.boxes.directions(ax, (0, 0), interval, radius, label, facecolor=colour, edgecolor=colour)
views.legend(ax, loc="upper right")
views.show(
    fig, "Two sectors of a circle overlap at the upper left and the lower left, with a gap between."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The filter stores only one interval, so it uses the smallest one that encloses both pieces. In this
# example the result is the whole second interval: it is wider than necessary, but never wrong.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: time and memory
#
# The filter stores four numbers for each landmark, and a measurement changes one landmark and the
# robot. If the data association is known, the time of an update does not depend on the number of
# landmarks. To find the association, the filter has to test all boxes.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The memory columns are computed, and the times are measured on your machine. Ask
# how large the map of a city could be with each filter.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def seconds_of(call, n=50):
    return min(repeat(call, number=n, repeat=7)) / n


def cost(N):
    """Microseconds of an update among N landmarks, and of its data association."""
    at = np.random.default_rng(N).uniform(-np.sqrt(N) / 2, np.sqrt(N) / 2, (N, 2))
    bor = BOR((0, 0, 0, 0), (0, 0), {i: (x, x, y, y) for i, (x, y) in enumerate(at)}, N)
    i = int(np.hypot(*at.T).argmin())
    z, bounds = h(np.zeros(3), at[i]), (0.1, 0.05)
    known = seconds_of(lambda: bor.update(i, z, bounds))
    return 1e6 * known, 1e6 * seconds_of(lambda: bor.overlapping(z, bounds))


# %% slideshow={"slide_type": "fragment"}
# time of an update and of an association, and memory, for N landmarks
print("      N   update   association   memory of BOR   of MAK (06)")
for N in (100, 10_000, 100_000):
    known, find = cost(N)
    memory = 32 * N / 1e3, 8 * (3 + 2 * N) ** 2 / 1e6
    kB, MB = (f"{views.grouped(f'{each:.1f}'):>9}" for each in memory)
    find = views.grouped(f"{find:.0f}")
    print(f"{views.grouped(N):>7}  {known:4.0f} µs   {find:>8} µs   {kB} kB {MB} MB")

# %% [markdown] slideshow={"slide_type": "fragment"}
# If the data association is known, the time is constant. The time to find the landmark among $N$
# landmarks grows with $N$, but slowly at first, because numpy compares many boxes at once. A spatial
# index would avoid this growth. The last two columns compare the memory: with correlations it grows
# with $N^2$, and with boxes in proportion to $N$.
