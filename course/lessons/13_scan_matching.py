# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 13 · Scan matching
#
# **You will be able to** derive the motion that lays one cloud of points over another, follow ICP round by
# round, say when it should stop and what leads it astray, and judge a match: from how far off it finds home,
# how sure it is, and in which direction it knows nothing.
#
# **95 minutes**, in two parts: how ICP works (52), and what a match is worth (43).
# **Before:** lesson [01](01_why_slam.ipynb) for poses and scans, lesson [03](03_kalman_filter.ipynb) for
# covariances.
#
# *Key:* if we knew the pairs, we could compute the motion. If we knew the motion, we could find the
# pairs. So we guess one of them, and improve both in turn.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Each part is a lecture. Part one is derived at the board as far as (13.4); "Watch it" and the
# fans are its pictures. Part two stands alone for a class that believes part one. If time is short, leave out
# "When to stop" and "Four places, one map". For a poll: the questions on what can grow, on poses that are right
# already, on the wall ahead, and on the corridor.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from dataclasses import replace

import numpy as np
import sympy as sp
from scipy.spatial import cKDTree

from slamlab import views
from slamlab.checks import ask
from slamlab.geometry import between, compose, transform, wrap
from slamlab.layers import Points, Poses, Segments
from slamlab.scanmatching import match, normals, point_to_line, point_to_point, rigid_fit
from slamlab.simulation import RPLIDAR_A2
from slamlab.sources import simulation
from slamlab.studies import intel_maps
from slamlab.worlds import World, box, ring

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Two scans of one place
#
# A robot stands in a polygon of cardboard walls, with a box and a cylinder in it. It scans, turns
# by −45°, drives 27.3 cm, and scans again. Its odometry is badly wrong: it says −35° and 15 cm.
# (All scans in this lesson are simulated, except in the last section of part two.)

# %% slideshow={"slide_type": "skip"}
run = simulation("polygon-wrong", np.random.default_rng(1))
readings = list(run)
first, second = readings[0].scan.points(), readings[1].scan.points()
guess, true_motion = readings[1].odometry, between(*run.truth.poses[:2])


def off(pose, truth=true_motion):
    """How far a pose lies from the truth: millimetres, degrees."""
    dx, dy, turn = between(truth, pose)
    return 1000 * np.hypot(dx, dy), abs(np.degrees(turn))


def told(pose, truth=true_motion):
    """The same in words."""
    return "{:.0f} mm and {:.1f}° off".format(*off(pose, truth))


# %% slideshow={"slide_type": "subslide"}
title = f"laid over each other by odometry: {told(guess)}"
fig, _ = views.overlay(first, transform(guess, second), title=title, size=(8, 5))
views.show(
    fig, f"The walls of the polygon twice: the second scan is turned and shifted, {told(guess)}."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# You see the same walls twice, and you can easily imagine turning the second scan until it fits.
# Nobody told you which point of one scan belongs to which point of the other. How can a machine
# find the motion?

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-same-spots",
    "Each scan has 398 points. Suppose the second one is laid over the first by the *true* motion. **How many of "
    "its points then lie within a millimetre of a point of the first scan?**",
    {
        "nearly all of them": "the walls lie on each other. But the beams of the second scan leave from another "
        "place, and hit the walls where they hit.",
        "about half: some walls were seen once only": "walls that were seen once are a small part of this. On walls "
        "that were seen twice, the beams hit different spots as well.",
        "a handful, by chance": "two scans share walls, and not points. The pairs that we shall speak of do not exist; "
        "a nearest point only stands for the wall that it is on.",
    },
    right="a handful, by chance",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-same-spots"
apart, _ = cKDTree(first).query(transform(true_motion, second))
print(f"within 1 mm: {np.sum(apart < 1e-3)} of {len(second)} points")
print(f"half of them lie farther than {1000 * np.median(apart):.0f} mm from the nearest point")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-same-spots"
# So hardly any point has a true partner. We begin as if all of them had one, since this leads to a
# formula that we need. We shall see what it costs, and part two does without it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## If the pairs were known
#
# Suppose that the point $a_i$ of the second scan, the **source**, is the same spot as the point
# $b_i$ of the first scan, the **target**. (In this lesson $a$ and $b$ are points, and not poses.)
# Which rotation and which shift $t$ lay the source over the target? We look for those with the
# least sum of squares:
#
# $$E(\theta, t) = \sum_i \left|\,\mathrm{Rot}(\theta)\,a_i + t - b_i\,\right|^2. \tag{13.1}$$
#
# We let three pairs of symbols stand for all.

# %% slideshow={"slide_type": "subslide"}
theta, t_x, t_y = sp.symbols("theta t_x t_y", real=True)
a = sp.Matrix(2, 3, sp.symbols("a_x1:4 a_y1:4", real=True))
b = sp.Matrix(2, 3, sp.symbols("b_x1:4 b_y1:4", real=True))
Rot = sp.Matrix([[sp.cos(theta), -sp.sin(theta)], [sp.sin(theta), sp.cos(theta)]])
t, ones = sp.Matrix([t_x, t_y]), sp.ones(1, 3)


def squares(M):
    return sum(entry**2 for entry in M)


E = squares(Rot * a + t * ones - b)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### First the shift
#
# Where $E$ is least, its slopes along $t_x$ and $t_y$ are zero. These are two linear equations, and
# the machine solves them. We claim that
#
# $$t = \bar b - \mathrm{Rot}(\theta)\,\bar a, \tag{13.2}$$
#
# where a bar means the mean of all points, their **centroid**. In words: whatever the rotation, the two centroids land
# on each other. The solution less the claim:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
best_t = sp.solve([E.diff(t_x), E.diff(t_y)], [t_x, t_y], dict=True)[0]
mean_a, mean_b = a * ones.T / 3, b * ones.T / 3
sp.simplify(t.subs(best_t) - (mean_b - Rot * mean_a)).T

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Then the rotation
#
# Now we count all points from their centroids, $a_i' = a_i - \bar a$ and $b_i' = b_i - \bar b$. Then the shift drops out
# of (13.1). A rotation changes no length, so of each square only the mixed term depends on $\theta$:
#
# $$E = \sum_i |a_i'|^2 + \sum_i |b_i'|^2 - 2\Bigl(\cos\theta \sum_i a_i' \cdot b_i' + \sin\theta \sum_i a_i' \times
# b_i'\Bigr). \tag{13.3}$$
#
# Here $a \times b$ is $a_x b_y - a_y b_x$. The difference of both sides:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
a_c, b_c = a - mean_a * ones, b - mean_b * ones
dot = sum(a_c[0, i] * b_c[0, i] + a_c[1, i] * b_c[1, i] for i in range(3))
cross = sum(a_c[0, i] * b_c[1, i] - a_c[1, i] * b_c[0, i] for i in range(3))
gain = sp.cos(theta) * dot + sp.sin(theta) * cross
sp.simplify(E.subs(best_t) - (squares(a_c) + squares(b_c) - 2 * gain))

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-valleys",
    "The clouds have 400 pairs. **How many minima can $E$ have, as $\\theta$ goes once round?**",
    {
        "one": "however many pairs there are, their terms add up to one cosine and one sine, and so to one wave.",
        "up to 400: one a pair": "each pair has an angle of its own that suits it best. But a sum of waves that are "
        "all one turn long is again one such wave.",
        "two, half a turn apart": "half a turn away from the minimum, each cosine has changed its sign: there is the "
        "maximum.",
    },
    right="one",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-valleys"
# ### One valley
#
# The parenthesis in (13.3) is one wave in $\theta$. It has one maximum in a full turn, where the tangent of $\theta$ is
# the sine's factor over the cosine's:
#
# $$\theta = \operatorname{atan2}\Bigl(\sum_i a_i' \times b_i',\; \sum_i a_i' \cdot b_i'\Bigr). \tag{13.4}$$
#
# So with known pairs there is nothing to search and no false minimum to be caught in. However many
# points there are, two sums determine the angle. Points far from the centroid count for more, since
# a turn moves them more.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Does it work?
#
# We make pairs that we know: we carry the first scan back by the true motion, and add 5 mm of noise. The package's
# `rigid_fit` returns the motion of (13.2) and (13.4).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
noise = 0.005 * np.random.default_rng(2).standard_normal(first.shape)
known = transform(between(true_motion, np.zeros(3)), first) + noise
paired = rigid_fit(known, first)
print("found", np.round(paired, 4), " true", np.round(true_motion, 4))
print("{:.1f} mm and {:.2f}° off".format(*off(paired)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The noise of {= len(first) =} pairs averages out. Most textbooks find the rotation by a singular
# value decomposition. In the plane it gives the same angle, and in space it is the usual way; the
# first *Deeper* section shows it, and the trap that it holds.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Two derivatives answer the question "why centroids?"; it is not a convention.
# Complex numbers make (13.4) one line: θ is the argument of the sum of conj(a′) b′.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## ICP: the pairs are not known
#
# Now nobody tells us the pairs. The idea of **iterative closest point**, ICP, is to guess them. Each round has four
# steps:
#
# 1. carry the source by the pose that we believe in;
# 2. pair each of its points with the **nearest** target point;
# 3. find the best motion of these pairs, by (13.2) and (13.4);
# 4. put this motion on top of the pose.
#
# Step 3 sees points that have been carried already, so its motion is one in the target's frame. It goes on the left:
# the new pose is *motion* $\oplus$ *pose*.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
watched = point_to_point(second, first, guess, history=True)
print("odometry:", told(guess))
print(f"ICP:      {told(watched.pose)}, after {watched.rounds} rounds")

# %% [markdown] slideshow={"slide_type": "fragment"}
# At the start most pairs are wrong, and still the match comes out {= off(guess)[0] / off(watched.pose)[0]:.0f =} times
# nearer to the truth than odometry. Why does a fit to wrong pairs help?

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-can-grow",
    "After every round we measure the distances of all pairs. **What can grow from one round to the next?**",
    {
        "nothing: every round improves every measure": "a fit makes one measure as small as it can be. Others may "
        "pay for it.",
        "the sum of their squares, but not their mean": "the fit of step 3 makes exactly this sum as small as it can "
        "be for its pairs, and nearest partners can only make it smaller.",
        "their mean, but not the sum of their squares": "the fit lowers squares. It gladly makes many short pairs a "
        "little longer to make one long pair much shorter, and then the mean grows.",
        "both, since the pairs change": "the pairs do change, but only to partners that are nearer.",
    },
    right="their mean, but not the sum of their squares",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-can-grow"
# ### Downhill in both halves
#
# Let $d_i$ be the length of pair $i$ before a round, and $d_i'$ after it. In between, the pose is
# already the new one, but the pairs are still the old ones; call the length of pair $i$ then
# $\hat d_i$. Then
#
# $$\sum_i d_i'^{\,2} \;\le\; \sum_i \hat d_i^{\,2} \;\le\; \sum_i d_i^{\,2}. \tag{13.5}$$
#
# The right step holds because the fit takes the *least* sum of squares that these pairs allow. The left one holds because
# a nearest partner is no farther than the old one. Nothing like this holds for the mean of the lengths.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-can-grow"
# We watch 60 runs from bad first guesses, and count where each measure grew:


# %% slideshow={"slide_type": "fragment"} answers="13-can-grow"
def lengths(look):
    """Lengths of the pairs in a round [m]."""
    source, target = look.pairs.T
    return np.hypot(*(transform(look.pose, second[source]) - first[target]).T)


rng, runs = np.random.default_rng(0), []
for _ in range(60):
    wrong = [*rng.uniform(-0.6, 0.6, 2), rng.uniform(-np.pi, np.pi)]
    start = true_motion + wrong
    runs.append(point_to_point(second, first, start, tolerance=1e-15, history=True).history)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-can-grow"
measures = {"sum of squares": lambda d: np.sum(d**2), "mean length": np.mean}
grew = {}
for name, measure in measures.items():
    values = [np.array([measure(lengths(look)) for look in looks]) for looks in runs]
    grew[name] = sum(np.any(np.diff(v) > 1e-9 * v[:-1]) for v in values)
    print(f"{name:14} grew at some time in {grew[name]:2} of {len(runs)} runs")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-can-grow"
# The sum of squares never grew, as (13.5) demands. There are only so many ways to pair two clouds, and none comes back
# once a smaller sum has been reached. So ICP always ends, in *a* valley. Whether it is the right one, (13.5) does not say.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Prove (13.5) at the board, one inequality at a time, and ask for each what it
# would need to hold for another measure. The section "When to stop" comes back to it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Watch it
#
# Each grey line is a pair. The guess by odometry is turned 10° too far to the left. Look at round 0
# first: where are the lines long, and which way do they pull? Then go on, round by round. After
# that, try a worse heading.


# %% slideshow={"slide_type": "subslide"}
def in_round(round, heading_off):
    start = [*guess[:2], true_motion[2] + np.radians(heading_off)]
    looks = point_to_point(second, first, start, history=True).history
    return looks[min(round, len(looks) - 1)]


def watch(round, heading_off):
    now = in_round(round, heading_off)
    title = f"round {round}: {told(now.pose)}"
    return views.overlay(first, transform(now.pose, second), now.pairs, title, (8, 5))[0]


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
views.explore(
    watch,
    lambda round, heading_off: (
        f"Grey lines from each point of the second scan to the nearest of the first, in round {round} from a "
        f"guess {heading_off}° off: the scans lie {told(in_round(round, heading_off).pose)}."
    ),
    play="round",
    round=(0, 40, 1),
    heading_off=(-180, 180, 10),
)
shift, turn = 1 - np.divide(off(watched.history[1].pose), off(guess))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first round took away {= 100 * shift:.0f =} % of the error of the place, but only {= 100 * turn:.0f =} % of that of the
# heading. Along a wall, a point's nearest partner is *beside* it, and not where it came from. The pairs pull the walls
# together, but they hold them back from sliding into place.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
errors = np.array([off(look.pose) for look in watched.history])
lines = {
    "mean length of the pairs [mm]": 1000 * np.array([look.error for look in watched.history]),
    "place off [mm]": errors[:, 0],
    "heading off [0.1°]": 10 * errors[:, 1],
}
fig, ax = views.curves(np.arange(len(errors)), lines, "round", "length, error", size=(8, 4))
views.show(
    fig,
    f"All three fall fast, then slowly, and end above zero: at {1000 * watched.error:.0f} mm, {errors[-1, 0]:.0f} mm "
    f"and {errors[-1, 1]:.1f}°.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# At the end the pairs are still {= 1000 * watched.error:.0f =} mm long, although the lidar is far better than that. There
# are two reasons. The beams hit different spots of a wall; and some walls were seen from one place only.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class find the largest error of the heading from which the match still
# succeeds. They will meet this idea again in part two, as the basin.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## When to stop
#
# A loop needs a rule to end by. Two come to mind. **A bound:** stop as soon as the mean length of the pairs is small
# enough. **A change:** stop as soon as it has hardly changed in a round.

# %% slideshow={"slide_type": "fragment"}
ask(
    "13-bound",
    "The lidar errs by a millimetre or two. So we let ICP go on **until the mean length of the pairs is below "
    "2 mm**. What happens on the polygon?",
    {
        "it stops when the match is good to two millimetres": "the lengths of the pairs are not the error of the pose. "
        "Even at the true pose, half of the pairs are longer than 5 mm.",
        "it never stops": "beams that hit a wall at different spots stay apart, however good the pose. The bound lies "
        "below what can be reached.",
        "it stops too early": "that is what a bound does that is too large. This one is too small.",
    },
    right="it never stops",
)


# %% slideshow={"slide_type": "subslide"} answers="13-bound"
def first_stop(looks, rule):
    """The round after which a rule (mean length now, before) says stop; None: never."""
    means = [look.error for look in looks]
    return next((k for k in range(1, len(means)) if rule(means[k], means[k - 1])), None)


RULES = {
    "below 2 mm": lambda now, before: now < 2e-3,
    "below 50 mm": lambda now, before: now < 50e-3,
    "change below 1 mm": lambda now, before: abs(now - before) < 1e-3,
    "change below 0.001 mm": lambda now, before: abs(now - before) < 1e-6,
}

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-bound"
looks = point_to_point(second, first, guess, tolerance=1e-15, history=True).history
for name, rule in RULES.items():
    k = first_stop(looks, rule)
    print(f"{name:22}", f"after {k:2} rounds: {told(looks[k].pose)}" if k else "never stops")

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-bound"
# A bound has to be guessed, and both guesses are bad: 2 mm is never reached, and 50 mm is reached
# too soon, with most of the turn still to come. The change tells when more rounds hardly help,
# whatever the noise. But its tolerance has to be small, because ICP creeps: with a tolerance of 1
# mm it stops before the turn is done.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What the change of a mean cannot promise
#
# By (13.5) the *squares* go down to the end. The loop looks at the *mean length*, which may fall, turn round and rise.
# While it turns round, it hardly changes. Did that end any of our 60 runs too early?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
early = []
for looks in runs:
    k = first_stop(looks, RULES["change below 0.001 mm"])
    early.append(off(looks[k].pose, looks[-1].pose)[0] if k else 0.0)
early = np.array(early)
print(f"stopped more than 1 mm before the end: {np.sum(early > 1)} of {len(runs)} runs")
print(f"at most {early.max():.0f} mm before it")

# %% [markdown] slideshow={"slide_type": "fragment"}
# It did so in {= np.sum(early > 1) =} of {= len(runs) =} runs from these bad guesses. A loop that
# goes on until no pair changes any more has (13.5) on its side.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Both rules have their place. The change ends the loop; the length that is left says whether to
# believe the match. Pairs that are far longer than expected, after convergence, mean the wrong valley.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Four places, one map
#
# The robot scans the polygon from four places. We match each scan with the one before, beginning from what odometry says of
# the step, and put the pose together from all matches so far. Beside it runs the pose by odometry alone.


# %% slideshow={"slide_type": "skip"} tags=["folded"]
def walk(source, matcher):
    """Poses (n, 3) by odometry alone and by matching, and the scans."""
    naive, corrected, scans = [np.zeros(3)], [np.zeros(3)], []
    for reading in source:
        points = reading.scan.points()
        if scans:
            naive.append(compose(naive[-1], reading.odometry))
            step = matcher(points, scans[-1], reading.odometry).pose
            corrected.append(compose(corrected[-1], step))
        scans.append(points)
    return np.array(naive), np.array(corrected), scans


def laid(name, poses, scans):
    """A track and the map it makes, as layers."""
    xy = np.vstack([transform(pose, scan) for pose, scan in zip(poses, scans, strict=True)])
    return [Points(name, xy), Poses("robot", poses)]


def maps_of(source, matcher):
    """A figure of both maps, and how far both poses are off at the end [mm], [°]."""
    *tracks, scans = walk(source, matcher)
    named = dict(zip(("naive", "corrected"), tracks, strict=True))
    ends = {name: off(poses[-1], source.truth.poses[-1]) for name, poses in named.items()}
    titles = {"naive": "odometry alone", "corrected": "with ICP"}
    shown = {
        f"{titles[name]}: {ends[name][0]:.0f} mm off": laid(name, poses, scans)
        for name, poses in named.items()
    }
    return views.side_by_side(shown, size=(10, 4.6))[0], ends


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
fig, by_wrong = maps_of(simulation("polygon-wrong", np.random.default_rng(1)), point_to_point)
views.show(
    fig,
    f"Odometry alone: four polygons askew, {by_wrong['naive'][0]:.0f} mm off at the end. With ICP: one polygon, "
    f"{by_wrong['corrected'][0]:.0f} mm off.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# On the left four polygons lie askew, a shape that cannot exist. On the right stands one polygon with its box and its
# cylinder.

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-right-already",
    "Now the same four scans, but the odometry is **exactly right**. **How far off is the last pose after ICP?**",
    {
        "0 mm: at the truth all is as near as it can be": "the truth is not where the sum of squares is least. Walls "
        "that were seen only once have no partner, but they get one, and it pulls.",
        "a millimetre or so: the noise of the lidar": "the noise averages out, as with known pairs. What does not "
        "average out are pairs that are wrong in the same way.",
        "about as far as from the wrong odometry": "ICP forgets its first guess once that is near enough. From both "
        "starts it goes into the same valley, and the bottom of this valley is not the truth.",
    },
    right="about as far as from the wrong odometry",
)

# %% slideshow={"slide_type": "fragment"} answers="13-right-already"
fig, by_right = maps_of(simulation("polygon", np.random.default_rng(1)), point_to_point)
views.show(
    fig,
    f"True odometry alone: a sharp map, {by_right['naive'][0]:.0f} mm off. With ICP: walls doubled, "
    f"{by_right['corrected'][0]:.0f} mm off.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-right-already"
# ICP made it *worse*: {= by_right["corrected"][0]:.0f =} mm off, and {= by_wrong["corrected"][0]:.0f =} mm from the wrong
# odometry. Look at the lower walls on the right: they are thicker. Something pulls the scans off the truth, and it is not
# noise.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## What only one scan saw
#
# ICP pairs **every** source point. A point that the target never saw has no partner, but it is
# given one all the same, and that pair pulls.
#
# We make it worse. Many robots have a scanner that looks ahead only, over half a turn. After a turn of −45° a quarter of
# what it sees is new.

# %% slideshow={"slide_type": "fragment"}
ask(
    "13-new-quarter",
    "ICP starts **from the true motion**; all it could do is stay there. **How far off does it end?**",
    {
        "it stays within 1°": "a quarter of its pairs is wrong, and none of these is wrong by chance: all of "
        "them pull to the same side.",
        "some 9° off": "what is new lies at one side of the scan. Its points are tied to the outermost "
        "points of the old scan, and turn the whole.",
        "45° off: one scan on the other, beam by beam": "the walls that were seen twice pull back. The end is a "
        "balance between the two.",
    },
    right="some 9° off",
)

# %% slideshow={"slide_type": "subslide"} answers="13-new-quarter"
ahead = replace(RPLIDAR_A2, field_of_view=np.pi, beams=200)
half = [r.scan.points() for r in simulation("polygon", np.random.default_rng(1), lidar=ahead)]


def trimmed(share_kept, heading_off):
    start = true_motion + np.array([0, 0, np.radians(heading_off)])
    return point_to_point(half[1], half[0], start, keep=share_kept, history=True)


def fans(share_kept, heading_off):
    end = trimmed(share_kept, heading_off).history[-1]
    title = f"the shortest {100 * share_kept:.0f} % of the pairs: {told(end.pose)}"
    return views.overlay(half[0], transform(end.pose, half[1]), end.pairs, title, (8, 5))[0]


# %% slideshow={"slide_type": "fragment"} answers="13-new-quarter" tags=["folded"]
views.explore(
    fans,
    lambda share_kept, heading_off: (
        f"Half a turn's scans with the shortest {100 * share_kept:.0f} % of their pairs, "
        f"{told(trimmed(share_kept, heading_off).pose)}; with all pairs, fans of lines end on a few points."
    ),
    share_kept=(0.1, 1.0, 1.0),
    heading_off=(-90, 90, 0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-new-quarter"
# See the **fans**: dozens of points that the first scan never saw are tied to its outermost points. They drag the whole
# scan round until their pull and that of the walls are in balance. Odometry was right, and the noise is small. It is
# the *method* that is {= off(trimmed(1.0, 0).pose)[1]:.0f =}° off.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-new-quarter"
# ### Trim
#
# The fans are the longest pairs. So in every round we sort the pairs by length, and fit only the shortest share of them: this
# is **trimmed ICP**. Move the first slider from 1 down to 0.8, and the fans let go. (The inequality (13.5) still holds, for
# the sum over the shortest share.)
#
# Will less always be better? Keep a tenth only, and then start with the heading 10° off.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="13-new-quarter"
print("share kept    from the truth        from 10° off")
by_share = {}
for share in (1.0, 0.9, 0.8, 0.7, 0.5, 0.3, 0.1):
    by_share[share] = [off(trimmed(share, start).pose) for start in (0, 10)]
    ends = ["{:5.0f} mm, {:4.1f}°".format(*end) for end in by_share[share]]
    print(f"{share:10.1f}    {ends[0]:20}  {ends[1]}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-new-quarter"
# Started from the truth, a tenth of the pairs seems best. But the shortest pairs are those that fit
# *already*, so a fit to only a few of them changes little: from 10° off, a share of 0.1 ends
# {= by_share[0.1][1][1]:.0f =}° off. The right share depends on the overlap, which nobody knows
# beforehand.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class say, before the slider moves, which points the fans end on. Here
# about three quarters of the scans overlap, and shares of 0.7 to 0.8 did well. Other ways to the
# same end are a largest length for pairs, and robust weights.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Part two: across the wall
#
# *This is a good place for a break.*
#
# Two scans hit a wall at different spots. So how far a point lies from its partner **along** the
# wall means nothing. We have seen what counting it does: it holds the walls back. So let us count
# the distance **across** the wall alone. With $n_i$, the direction across the wall at the partner
# $b_i$, a vector of length one, it is
#
# $$e_i = n_i^{\mathsf T} (\mathrm{Rot}(\theta)\,a_i + t - b_i). \tag{13.6}$$

# %% slideshow={"slide_type": "subslide"}
across = normals(first)
spikes = np.hstack([first, first + 0.12 * across])[::6]
layers = [Segments("normals", spikes[~np.isnan(spikes).any(axis=1)]), Points("map", first)]
fig, _ = views.side_by_side({"the first scan and its normals": layers}, size=(8, 5))
views.show(
    fig,
    "Short lines at every sixth point stand across the walls of the first scan. At corners they are slanted, between "
    "the directions of both walls.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# A line through each point and its neighbours gives the direction across, its **normal**. At a corner the neighbours lie
# on two walls, so the normal is slanted. Where they lie along no line there is none, as for
# {= np.isnan(across).any(axis=1).sum() =} of these {= len(first) =} points, and pairs without a normal are left out.

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-wall-ahead",
    "All points of a scan lie on **one straight wall, square ahead** of the robot, with $x$ ahead and $y$ to the "
    "left. **About which unknowns do the distances across it tell something?**",
    {
        "$x$ alone": "a turn lifts one end of the wall and lowers the other. This shows across the wall, too.",
        "$x$ and $\\theta$": "a step to the side slides the wall along itself, and changes no distance across it.",
        "$x$ and $y$, but not $\\theta$": "a step to the side slides the wall along itself. A turn lifts one end of it.",
        "all three": "a straight wall looks the same after a step to the side.",
    },
    right="$x$ and $\\theta$",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-wall-ahead"
# ### What a small motion does to $e$
#
# Shift the pose by $d_x$ and $d_y$, and turn it by $d_\theta$ about the robot, which stands at $t$. What turns is the
# **arm** from the robot to the point, $\mathrm{arm}_i = \mathrm{Rot}(\theta)\,a_i$. The slopes of $e$, where there is no motion yet:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-wall-ahead"
d_x, d_y, d_theta = sp.symbols("d_x d_y d_theta", real=True)
n, arm, at, partner = (
    sp.Matrix(sp.symbols(f"{name}_x {name}_y", real=True)) for name in ("n", "arm", "t", "b")
)
point = at + sp.Matrix([d_x, d_y]) + Rot.subs(theta, d_theta) * arm
e = n.T * (point - partner)
e.jacobian([d_x, d_y, d_theta]).subs(d_theta, 0)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-wall-ahead"
# So each pair has a row of three slopes:
#
# $$J_i = \begin{bmatrix} n_x & n_y & \mathrm{arm}_i \times n_i \end{bmatrix}. \tag{13.7}$$
#
# A shift counts the more, the more squarely it meets the wall; a turn counts by the length of its
# lever. For a wall square ahead, $n = (1, 0)$: the second slope is zero, and the third is not.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The step
#
# The tidy solution is gone: (13.3) needed both components of each distance. But for a small motion $\delta = (d_x, d_y,
# d_\theta)$ every $e_i$ becomes $e_i + J_i\,\delta$. We stack all pairs. The sum of squares is a bowl in $\delta$, and
# at its bottom the slope is zero:
#
# $$J^{\mathsf T}(e + J\delta) = 0 \quad\Longrightarrow\quad \delta = -(J^{\mathsf T}J)^{-1} J^{\mathsf T} e. \tag{13.8}$$
#
# There are three unknowns, whatever the number of points. A turn is not linear in $d_\theta$, so
# the step is not exact. We take it, pair again, and step again.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Censi (2008) still solves one round in closed form, by a quartic; most people
# take this Gauss-Newton step. The exercise asks for a step in the robot's frame, with odometry in
# the sum: derive (13.7) at the board, and leave the rest to the students.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## How much faster, how much better?
#
# Plain ICP took two dozen rounds on the polygon. The package's `point_to_line` does more than step across walls. It has
# **gates**: pairs that are too long (more than 1 m at first, 10 cm at last) or whose walls point elsewhere are dropped.
# And it weighs down pairs that are far apart across the wall. To tell what comes of which, we also run it *bare*: its
# limits so wide that they drop no pair and weigh none down. The same two scans, the same first guess, four methods:

# %% slideshow={"slide_type": "fragment"}
# heading off after each round, from the same first guess, by four methods
WIDE = {"gate": (1e3, 1e3), "normal_gate": np.pi}  # [m], [rad]
METHODS = {
    "point to point": point_to_point,
    "trimmed, 80 %": lambda p, q, start, **how: point_to_point(p, q, start, keep=0.8, **how),
    "point to line": point_to_line,
    "bare": lambda p, q, start, **how: point_to_line(p, q, start, **WIDE, **how),
}

turned = {}
for name, matcher in METHODS.items():
    looks = matcher(second, first, guess, history=True).history[:21]
    turned[name] = np.pad([off(look.pose)[1] for look in looks], (0, 21 - len(looks)), "edge")

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
fig, ax = views.curves(np.arange(21), turned, "round", "heading off [°]", size=(8, 4.2))
ax.set_yscale("log")
views.legend(ax)
views.show(
    fig,
    f"Point to line is at most {turned['point to line'][2:].max():.3f}° off from round two on, and bare at most "
    f"{turned['bare'][3:].max():.3f}° from round three on; the others creep down, to "
    f"{turned['trimmed, 80 %'][20]:.1f}° and {turned['point to point'][20]:.1f}° in twenty.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Each gridline is ten times less. After three rounds, point to line is {= turned["point to line"][3]:.2f =}° off, and
# {= turned["bare"][3]:.2f =}° when it is bare. Plain ICP is {= turned["point to point"][3]:.1f =}° off by then, and at
# {= turned["point to point"][20]:.1f =}° after twenty. So the speed comes from the distances across the walls: what is
# counted along them no longer holds them back.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Ten seeds, three steps each
#
# We let all of them, and `match`, the package's best matcher (more of it below), match ten simulated drives through the
# polygon, with both scanners. Each drive has three steps, the same wrong odometry, and new noise in its scans.


# %% slideshow={"slide_type": "fragment"}
def steps_off(matcher, lidar, seeds=10):
    """How far the steps of odometry, and of a matcher, are off: (n, 2) each [mm], [°]."""
    found = []
    for seed in range(seeds):
        source = simulation("polygon-wrong", np.random.default_rng(seed), lidar=lidar)
        *tracks, _ = walk(source, matcher)
        true, *steps = (between(p[:-1], p[1:]) for p in (source.truth.poses, *tracks))
        found += [[off(p, q) for p, q in zip(step, true, strict=True)] for step in steps]
    return np.concatenate(found[::2]), np.concatenate(found[1::2])


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
medians, nearer = {}, {}
for width, lidar in {"whole turn": RPLIDAR_A2, "half a turn": ahead}.items():
    for name, matcher in (METHODS | {"match": match}).items():
        wheels, matched = steps_off(matcher, lidar)
        medians[width, name] = np.median(matched, axis=0)
        nearer[width, name] = np.sum(np.all(matched < wheels, axis=1))
        words = "median {:5.1f} mm, {:.2f}°".format(*medians[width, name])
        print(
            f"{width:>11}, {name:14}: {words}; beats odometry in {nearer[width, name]} of 30 steps"
        )
print("odometry: median {:.0f} mm, {:.1f}°".format(*np.median(wheels, axis=0)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# This odometry is so bad that every method beats it, in place and in heading, in
# {= "each" if min(nearer.values()) == 30 else f"{min(nearer.values())} or more" =} of the 30 steps.
# With the whole turn, distances across the walls alone, *bare*, bring the median from
# {= medians["whole turn", "point to point"][0]:.0f =} mm to {= medians["whole turn", "bare"][0]:.1f =} mm. With half a
# turn they are still {= medians["half a turn", "bare"][0]:.0f =} mm off, and plain ICP
# {= medians["half a turn", "point to point"][0]:.0f =} mm: what only one scan saw drags both. Trimming takes most of
# that away, if the share suits. So do gates and weights: with them, point to line is
# {= medians["half a turn", "point to line"][0]:.1f =} mm off. No share has to be chosen then, but limits have.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## How bad may the first guess be?
#
# ICP goes downhill from where it starts. The guesses that lead home are its **basin**. Below, 24 matches start with
# headings all round, and each line is one of them: a fan of matches. Those that end within 5 cm and 2° of the truth have
# come **home**.


# %% slideshow={"slide_type": "subslide"}
def home(pose, truth=true_motion):
    return off(pose, truth)[0] < 50 and off(pose, truth)[1] < 2


def fan_of(method, share_kept, metres_off):
    """24 matches from all headings: the headings' errors by round [°], and who came home."""
    matcher, tracks = METHODS[method], []
    for degrees in range(-180, 180, 15):
        start = true_motion + np.array([metres_off, 0, np.radians(degrees)])
        how = {"keep": share_kept, "max_rounds": 40, "history": True}
        looks = matcher(second, first, start, **how).history
        turns = np.unwrap([wrap(look.pose[2] - true_motion[2]) for look in looks])
        tracks.append((np.degrees(turns), home(looks[-1].pose)))
    return tracks


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def fan(method, share_kept, metres_off):
    tracks = fan_of(method, share_kept, metres_off)
    title = f"{sum(came for _, came in tracks)} of {len(tracks)} come home"
    fig, ax = views.chart("round", "heading off [°]", title, size=(8, 4.8))
    for turns, came in tracks:
        name, line = ("corrected", "solid") if came else ("naive", "dashed")
        ax.plot(turns, color=views.COLOURS[name], linestyle=line)
    ax.plot([], color=views.COLOURS["corrected"], label="comes home")
    ax.plot([], color=views.COLOURS["naive"], linestyle="dashed", label="gets lost")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
views.explore(
    fan,
    lambda method, share_kept, metres_off: (
        f"Errors of the heading by round, of matches {method} that begin all round, {metres_off:.2f} m off: "
        f"{sum(came for _, came in fan_of(method, share_kept, metres_off))} come home, the others end elsewhere."
    ),
    method=["point to point", "point to line"],
    share_kept=(0.3, 1.0, 1.0),
    metres_off=(0.0, 1.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The blue lines run together to zero. The red ones end in false valleys, where the error no longer
# changes either. Now change the method, the share, and the place of the start. Which of them makes
# the blue bundle narrower?

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-basin",
    "Point to line was far more accurate than plain point to point. **Whose basin is larger, if the guess is wrong in "
    "place and heading?**",
    {
        "that of point to line: it is simply better": "near home, what it drops or weighs down is what leads astray. "
        "Far from home nearly all pairs are long, and among those are the ones that would lead it back.",
        "that of point to point": "it creeps. But all of its pairs pull, however long they are, and so it is led "
        "home from a metre away.",
        "they are the same: both pair nearest points": "they pair alike, but one of them drops pairs and weighs "
        "others down.",
    },
    right="that of point to point",
)

# %% slideshow={"slide_type": "subslide"} answers="13-basin"
places = [r.scan.points() for r in simulation("polygon", np.random.default_rng(1))]
true_steps = between(run.truth.poses[:-1], run.truth.poses[1:])
degrees_off, metres_off = [0, 15, 30, 45, 60, 90, 180], [0, 0.25, 0.5, 1.0]


def share_home(matcher, degrees, metres, rng, tries=3):
    """The share of guesses so far off that lead home, in directions drawn by lot."""
    came = []
    for k in np.arange(tries) % 3:
        way, sign = rng.uniform(-np.pi, np.pi), rng.choice([-1, 1])
        wrong = [metres * np.cos(way), metres * np.sin(way), sign * np.radians(degrees)]
        end = matcher(places[k + 1], places[k], true_steps[k] + wrong).pose
        came.append(home(end, true_steps[k]))
    return np.mean(came)


# %% slideshow={"slide_type": "subslide"} answers="13-basin" tags=["folded"]
basins = {}
for name in ("point to point", "bare", "point to line", "match"):
    rng, matcher = np.random.default_rng(0), (METHODS | {"match": match})[name]  # same guesses
    table = [[share_home(matcher, row, x, rng) for x in metres_off] for row in degrees_off]
    basins[name] = np.array(table)
fig, _ = views.cells(
    basins, metres_off, degrees_off, "place off [m]", "heading off [°]", size=(11, 4.2)
)
shares = ", ".join(f"{name} {100 * np.mean(table):.0f} %" for name, table in basins.items())
views.show(fig, f"Shares that come home, by how far the guess is off; over all cells {shares}.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-basin"
# Up to 30° plain ICP comes home in {= 100 * basins["point to point"][:3].mean():.0f =} % of these tries, three in each cell, even from a
# metre away, and point to line in {= 100 * basins["point to line"][:3].mean():.0f =} %. When it is bare, it is
# {= 100 * basins["bare"][:3].mean():.0f =} %. So up to there it is not the distances across the walls that make its basin
# smaller, but the gates and weights, which keep out what only one scan saw. From 45° and 60°, plain ICP comes home in
# {= 100 * basins["point to point"][3:5].mean():.0f =} %, bare in {= 100 * basins["bare"][3:5].mean():.0f =} %, and point
# to line in {= 100 * basins["point to line"][3:5].mean():.0f =} %; farther off, none of them does. The last, `match`, came
# home in {= 100 * basins["match"].mean():.0f =} % of all tries. It has a trick.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Know that you are lost
#
# `match` **judges** its own result: do enough points lie on the other scan's walls? Does a point stand where a beam of the
# other scan went through? If the result looks poor, it tries all turns and all places on a coarse grid, and starts again from the
# best of them. Without the search:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for degrees in (0, 30, 60, 120):
    start = compose(true_motion, [0, 0, np.radians(degrees)])
    end = match(second, first, start, search=0)
    print(f"{degrees:3}° off: {told(end.pose):>20}: {end.verdict}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Where it is lost it says so, and says why. The mean length of the pairs alone cannot tell that.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The search correlates two grids by FFT, for every turn all shifts at once;
# `python -m benchmarks.icp` tells what it costs. In a rectangular hall it finds two equally good
# answers, half a turn apart. Ask what should decide between them.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## How sure is a match?
#
# A filter (lesson 06) or a graph of poses (lesson 15) has to weigh a match, so it needs a covariance. Where does the error
# come from? At the end of the loop the step (13.8) is zero. Noise $\varepsilon$ on the distances moves the bottom of the
# bowl, by the same formula:
#
# $$\delta = -(J^{\mathsf T}J)^{-1} J^{\mathsf T} \varepsilon. \tag{13.9}$$

# %% [markdown] slideshow={"slide_type": "subslide"}
# As in lesson 03, the covariance of the pose is the expected value of $\delta\,\delta^{\mathsf T}$. Let the noises be independent,
# each with the variance $\sigma^2$; then that of $\varepsilon\,\varepsilon^{\mathsf T}$ is $\sigma^2 I$, and
#
# $$P = (J^{\mathsf T}J)^{-1} J^{\mathsf T}\,\sigma^2 I\,J\,(J^{\mathsf T}J)^{-1} = \sigma^2 (J^{\mathsf T}J)^{-1} = \Lambda^{-1}.
# \tag{13.10}$$
#
# $\Lambda = J^{\mathsf T}J / \sigma^2$ is the **information**: what all walls together tell about $x$, $y$ and $\theta$.
# More pairs, squarer walls and longer arms all add to it.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### One match against a hundred
#
# A robot swerves by 30 cm along a corridor, with a cupboard ahead. We simulate its two scans a hundred times, each time with
# new noise, and match them.

# %% slideshow={"slide_type": "fragment"}
corridor = [[-60, -1, 60, -1], [-60, 1.2, 60, 1.2]]
cupboard = ring([(2, 0.2), (3, 0.2), (3, 1.19), (2, 1.19)])
here, there = np.array([[0, 0, -0.2], [0.3, 0, 0.2]])
moved_by = between(here, there)


def two_looks(walls, rng):
    """The scan after moving and the one before."""
    return [RPLIDAR_A2.scan(World(walls), pose, rng).points() for pose in (there, here)]


rng, furnished = np.random.default_rng(0), np.vstack([corridor, cupboard])
hundred = [match(*two_looks(furnished, rng), [0.2, 0, 0.3]) for _ in range(100)]

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
errors = np.array([m.pose for m in hundred]) - moved_by
told_by_one = hundred[0].covariance * 1e6
claims = {"told by the first match": told_by_one, "of the hundred": 1e6 * np.cov(errors.T)}
fig, ax = views.cloud(1000 * errors, claims, size=(8, 4.8))
ax.set(xlabel="error of x [mm]", ylabel="error of y [mm]")
ax.lines[0].set(markersize=7, alpha=1, label="errors of a hundred matches")
views.legend(ax)
spread = np.sqrt(np.linalg.eigvalsh(np.cov(errors[:, :2].T)))
ratio = spread[1] / spread[0]
views.show(
    fig,
    f"A slanted cloud of a hundred errors, {ratio:.1f} times as long as wide, and two ellipses of nearly the same shape.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Along the corridor the matches scatter {= ratio:.1f =} times as far as across it, since only the
# cupboard's short side holds them there. And the solid ellipse, which a **single** match claims for
# itself, is nearly the dashed one, which took a hundred matches. (The axes are those of the robot,
# which looks 11° to the right of the corridor.)

# %% [markdown] slideshow={"slide_type": "subslide"}
# How near is nearly? Lesson 03 has a number for it: NEES, the squared error, measured by what each match claims. With three
# unknowns its mean should be 3, and for a hundred honest matches it lies between 2.5 and 3.5 in 95 % of all
# cases.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
nees = [d @ np.linalg.solve(m.covariance, d) for d, m in zip(errors, hundred, strict=True)]
print(f"mean NEES of the hundred: {np.mean(nees):.1f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# That is outside: these matches claim standard deviations that are about
# {= 100 * (1 - np.sqrt(3 / np.mean(nees))):.0f =} % too small. A filter can live with that; with a
# factor of ten it could not. There are errors that no covariance of this kind knows of: walls that
# are not straight, a robot that moves while it scans, and the wrong valley.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The corridor that slides along itself
#
# Now we take the cupboard away. Two straight walls are left, 120 m long. The robot moved by 30 cm, but odometry says 0 cm
# in one try and 60 cm in another.

# %% slideshow={"slide_type": "fragment"}
ask(
    "13-corridor",
    "Nothing but two straight walls. Odometry is off by 30 cm along them. **What should a good matcher return?**",
    {
        "the true 30 cm: its noise is only millimetres": "no beam says anything of the way along the walls: both pictures "
        "fit equally well.",
        "an error: this match failed": "the walls do fix two things, the place across the corridor and the heading. "
        "It would be a pity to throw them away.",
        "odometry along the walls, the walls across, and a warning": "what the walls fix is fixed, what they do not "
        "fix is left as it was, and whoever uses the match is told so.",
    },
    right="odometry along the walls, the walls across, and a warning",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="13-corridor"
bare = two_looks(corridor, np.random.default_rng(0))
slid = [match(*bare, between(here, [way, 0, 0.1])) for way in (0.0, 0.6)]
for way, m in zip((0, 60), slid, strict=True):
    along, aside, _ = np.abs(compose(here, m.pose) - there)
    print(f"odometry says {way:2} cm: {100 * along:.0f} cm off along, {100 * aside:.0f} cm across")
    print(f"                       {m.verdict}")

# %% slideshow={"slide_type": "subslide"} answers="13-corridor" tags=["folded"]
shown = {
    f"odometry says {way} cm": [
        Points("map", bare[1]),
        Points("scan", transform(m.pose, bare[0])),
        Poses("robot", [m.pose]),
        Poses("truth", [moved_by]),
    ]
    for way, m in zip((0, 60), slid, strict=True)
}
fig, (ax, _) = views.side_by_side(shown, size=(10, 4.6))
ax.set(xlim=(-3, 3), ylim=(-2.4, 2.4))
views.show(
    fig,
    "The same two walls twice, covered by both scans; the matched robot stands behind the true one on the left, and "
    "ahead of it on the right.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-corridor"
# Both pictures fit equally well, and nobody could say from them which one is right. The matcher
# left the guess along the walls as it was, corrected the rest, and **said so**.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-corridor"
# It reads that off the information. All normals point across the corridor, so one **eigenvalue** of $\Lambda$ is next to
# nothing, and its direction is the free one. As a share of the largest:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-corridor"
for name, m in {"with the cupboard": hundred[0], "bare": slid[0]}.items():
    seen = m.observability
    share = seen.eigenvalues[0] / seen.eigenvalues[-1]
    print(f"{name:>17}: {share:.4f}, {seen.in_words() or 'all is fixed'}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-corridor"
# The bare corridor's share is not quite zero, because the normals are noisy, and a crooked normal
# seems to see a bit of the way along. The matcher knows how noisy the normals are, and discounts
# just that. What it cannot find in the walls must come from somewhere else: from odometry, or from
# a door farther on.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A round silo leaves the turn free. Let the class build one with `World` and ask `match` for its verdict.
# Plain ICP says nothing in the bare corridor: it drifts to some place along it and reports that the error stands still.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## A real robot
#
# So far all scans were simulated. In the Intel Research Lab a real robot drove for
# {= intel_maps.stored().minutes:.0f =} minutes. Its {= intel_maps.stored().readings =} scans look
# ahead over half a turn. We matched each scan with what was seen just before, once by plain ICP,
# and once across walls, with gates and weights. The log is not ours to give away, but its map and
# the errors are kept with the course.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
intel = intel_maps.stored()
fig, _ = views.side_by_side(
    {"Intel Research Lab, estimator icp": [Points("map", intel.points["icp"])]}, size=(8, 5.6)
)
views.show(
    fig,
    f"A floor plan {np.ptp(intel.points['icp'], axis=0).max():.0f} m across: rooms on both sides of a corridor that goes "
    "round; some walls stand twice.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Scans matched across walls give a floor plan. But where the robot comes back, walls stand twice: a
# matcher does not know that it has been in a place before.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### How good is that?
#
# Nobody knows the true poses. But Kümmerle and others published **relations**: how one pose lies as seen from another,
# checked by hand. Over the {= intel.relations =} of them that belong to our scans, the poses are off by

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name in ("odometry", "icp-plain", "icp"):
    print(
        f"{name:>9}: {intel.off[name]:.2f} m and {np.degrees(intel.turned[name]):4.1f}° on average"
    )

# %% [markdown] slideshow={"slide_type": "fragment"}
# On this drive plain ICP is no better than the wheels, and its headings are worse. The polygon
# suggests why: with half a turn in view, what is new after each turn drags the match off. The
# robust matcher is {= intel.off["odometry"] / intel.off["icp"]:.0f =} times nearer than the wheels.
# This is one drive of one robot, but a real one.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* `python -m slamlab.studies.intel_maps` makes the numbers and the map again, where the recording is at hand.
# Only relations whose two stamps lie within 2 ms of a scan are counted.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# P. J. Besl and N. D. McKay, "A method for registration of 3-D shapes", *IEEE Transactions on Pattern Analysis and Machine
# Intelligence* 14(2), 1992: ICP, and why it ends.
#
# Y. Chen and G. Medioni, "Object modelling by registration of multiple range images", *Image and Vision Computing* 10(3),
# 1992: distances across the surface.
#
# K. S. Arun, T. S. Huang and S. D. Blostein, "Least-squares fitting of two 3-D point sets", *IEEE Transactions on Pattern
# Analysis and Machine Intelligence* 9(5), 1987: the rotation by the SVD.

# %% [markdown] slideshow={"slide_type": "subslide"}
# F. Lu and E. Milios, "Robot pose estimation in unknown environments by matching 2D range scans", *Journal of Intelligent and
# Robotic Systems* 18, 1997: scans of robots.
#
# D. Chetverikov, D. Svirko, D. Stepanov and P. Krsek, "The trimmed iterative closest point algorithm", ICPR 2002.
#
# A. Censi, "An accurate closed-form estimate of ICP's covariance", ICRA 2007.
#
# **Read next:** A. Censi, "An ICP variant using a point-to-line metric", ICRA 2008.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can lay two clouds over each other with and without known pairs, choose a rule to stop by,
# mend ICP where scans overlap only in part, step across walls instead of to points, and say of a
# match how sure it is and where it knows nothing.
#
# **What comes next:** every match is a little off, and over many matches the errors add up, as those of odometry do, only more slowly.
# [Lesson 14](14_the_emir_system.ipynb) puts ICP on a live robot; [lesson 15](15_closing_the_loop.ipynb) closes the loop.
#
# **Exercise:** [13 · Scan matching](../exercises/ex13_scan_matching.ipynb). You write ICP, trim it, let odometry and walls decide
# together, and match two scans that share only half.
#
# The sections below this one are optional.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the rotation by an SVD
#
# In space a rotation has three angles, and there is no arctangent for them. There is another way,
# which works in any dimension. All that it needs to know about the pairs is one small matrix,
#
# $$M = \sum_i a_i'\, b_i'^{\mathsf T}, \qquad \sum_i b_i'^{\mathsf T}\,\mathrm{Rot}\, a_i' = \operatorname{tr}(\mathrm{Rot}\, M),
# \tag{13.11}$$
#
# and this trace is the parenthesis in (13.3). Every matrix is a turn, a stretch and a turn:
# $M = U D V^{\mathsf T}$, with orthonormal $U$ and $V$, and with
# $D = \operatorname{diag}(D_1 \ge D_2 \ge 0)$. (The three letters have this meaning in this section
# only.)

# %% [markdown] slideshow={"slide_type": "subslide"}
# We write the rotation as $\mathrm{Rot} = V Z U^{\mathsf T}$; every rotation can be written in this
# way, with some orthonormal $Z$. A trace does not change when its last factor is moved to the
# front:
#
# $$\operatorname{tr}(\mathrm{Rot}\, M) = \operatorname{tr}(V Z U^{\mathsf T}\, U D V^{\mathsf T}) = \operatorname{tr}(Z D). \tag{13.12}$$
#
# In the plane $Z$ is a rotation by some $\varphi$, or a mirror. What is the trace for each?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
phi = sp.symbols("varphi", real=True)
D_1, D_2 = sp.symbols("D_1 D_2", nonnegative=True)
Z_turn = Rot.subs(theta, phi)
for Z in (Z_turn, Z_turn * sp.diag(1, -1)):
    print(sp.factor((Z * sp.diag(D_1, D_2)).trace()))

# %% [markdown] slideshow={"slide_type": "subslide"}
# Both are greatest at $\varphi = 0$. The trace is $D_1 + D_2$ there for the rotation, and
# $D_1 - D_2$ for the mirror. So $Z = I$ is best, and $V U^{\mathsf T}$ is the best **orthonormal**
# matrix.
#
# Here is the trap. $V U^{\mathsf T}$ may itself be a mirror, with the determinant −1. For
# $\mathrm{Rot}$ to be a rotation, $Z$ then has to be a mirror, and the trace loses least if the −1
# stands at the smallest singular value:
#
# $$\mathrm{Rot} = V \begin{bmatrix} 1 & 0\\ 0 & \det(V U^{\mathsf T})\end{bmatrix} U^{\mathsf T}. \tag{13.13}$$

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-mirror",
    "A robot stands before **one straight wall**, and looks twice without moving. All that differs is the noise. **How "
    "often is $V U^{\\mathsf T}$ a mirror?**",
    {
        "never: nothing in the world is seen mirrored": "across the wall there is nothing but noise, and noise does not "
        "know left from right.",
        "in about half of the cases": "if points that stuck out of the wall in the first look lie "
        "behind it in the second, the mirror is the better fit. That is as likely as not.",
        "only if all points lie exactly on a line": "then both fit equally well. With noise, one of them fits better, "
        "and it may be the mirror.",
    },
    right="in about half of the cases",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-mirror"
rng, along = np.random.default_rng(7), np.linspace(-1.0, 1.0, 15)


def look_at_wall():
    return np.column_stack([along, 1.0 + 0.01 * rng.standard_normal(15)])


pairs_of_looks = [(look_at_wall(), look_at_wall()) for _ in range(1000)]
crossed = [(p - p.mean(axis=0)).T @ (q - q.mean(axis=0)) for p, q in pairs_of_looks]
mirrors = np.linalg.det(crossed) < 0  # det M has the sign of det V Uᵀ
print(f"{mirrors.sum()} of {len(mirrors)} are mirrors")

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-mirror"
# What would a mirror do? We take one of these pairs of looks. The best mirror is the best rotation
# of a source that we have mirrored before. Beside the wall a chest of drawers stands to the left,
# and both fits carry it along.

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"] answers="13-mirror"
old, new = pairs_of_looks[np.flatnonzero(mirrors)[0]]
things = np.vstack([ring([(-0.15, 0), (0.15, 0), (0, 0.35)]), box((-0.7, 0.6), (0.4, 0.25))])
fig, ax = views.axes(None, size=(8, 4.6))
views.draw(ax, Points("wall", np.vstack([old, new])), markersize=6)
for name, flip in {"naive": [1, -1], "corrected": [1, 1]}.items():
    fitted = rigid_fit(old * flip, new)
    ends = transform(fitted, things.reshape(-1, 2) * flip).reshape(-1, 4)
    rms = 1000 * np.sqrt(np.mean(np.sum((transform(fitted, old * flip) - new) ** 2, axis=1)))
    words = "mirror" if flip[1] < 0 else "rotation"
    views.draw(ax, Segments(name, ends), label=f"{words}: {rms:.2f} mm left")
for name, place in {"robot": (0.2, 0.1), "chest": (-0.45, 0.7)}.items():
    ax.text(*place, name, va="center")
views.legend_below(fig)
views.show(fig, "Mirrored, robot and chest lie behind the wall; rotated, in front of it.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-mirror"
# The mirror fits the wall a little better, and robot and chest stand inside out *behind* it. The
# rotation fits nearly as well, and nothing has moved. A robot often looks at one long wall, so the
# determinant is no mere detail.

# %% [markdown] slideshow={"slide_type": "subslide"}
# In the plane (13.13) and (13.4) must agree, since both are the best rotation. `rigid_fit` computes (13.13):

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
most = 0.0
for p, q in rng.standard_normal((1000, 2, 8, 2)):
    p_c, q_c = p - p.mean(axis=0), q - q.mean(axis=0)
    cross_sum = np.sum(p_c[:, 0] * q_c[:, 1] - p_c[:, 1] * q_c[:, 0])
    angle = np.arctan2(cross_sum, np.sum(p_c * q_c))
    most = max(most, abs(wrap(angle - rigid_fit(p, q)[2])))
print("a thousand random clouds never differ by more than 1e-12 rad:", most < 1e-12)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a covariance one step further
#
# (13.10) takes all distances for independent and equally noisy. They are not. A far point is
# measured less well than a near one, and a point of the target contributes to the normals of all
# its neighbours. Censi takes this into account: with the gradient $\gamma$ of the sum of squares at
# its minimum, and the measured ranges $z$ of both scans,
#
# $$P = \Lambda^{-1}\, \frac{\partial \gamma}{\partial z}\, \operatorname{cov}(z)\, \frac{\partial \gamma}{\partial z}^{\mathsf T} \Lambda^{-1},
# \tag{13.14}$$
#
# where $\Lambda$ is the derivative of $\gamma$ with respect to the pose. With equal, independent noise on the distances it is (13.10)
# again. It is what `match(...).covariance` returns.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print
#
# Optional: what Tuček's thesis prints of ICP in its chapter 3 and in its listings, and what comes of it.
#
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | §3.1, step 5 | go on while the error is above a bound | stop on its change, as `icp.py` does | it never ends, or ends too soon: see "When to stop" |
# | `icp.py` | tolerance 0.001, no unit | its data are in millimetres | read as metres it stops before the turn is done |
# | `slam.py` | the second scan is only remembered | the first is map *and* previous scan | the first motion is lost |
# | `slam.py` | a scan of fewer than three points clears the previous one | keep it | the next motion is lost |


# %% slideshow={"slide_type": "subslide"} tags=["code"]
def as_printed(source, matcher):
    """Tuček's add_new_scan and calculate_transformation, in their own logic."""
    points, previous, current = None, None, np.zeros(3)
    for scan, odometry in source:
        if points is None:
            points = scan
        elif previous is None or len(scan) < 3:
            previous = scan if len(scan) >= 3 else None
        else:
            current = compose(current, matcher(scan, previous, odometry).pose)
            points = np.vstack([points, transform(current, scan)])
            previous = scan
    return current, points


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
scans = [(reading.scan.points(), reading.odometry) for reading in readings]
printed, printed_map = as_printed(scans, point_to_line)
_, mended, _ = walk(run, point_to_line)
nothing = (np.empty((0, 2)), np.zeros(3))
cleared, _ = as_printed([*scans[:3], nothing, scans[3]], point_to_line)
poses = {"truth": run.truth.poses[-1], "mended": mended[-1], "as printed": printed}
for name, pose in (poses | {"and one empty scan": cleared}).items():
    print(f"{name:>18}: {pose[0]:.2f} m, {pose[1]:.2f} m, {np.degrees(pose[2]):.0f}°")

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
shown = {
    "as printed": {"as printed": Points("naive", printed_map), "robot": Poses("robot", [printed])},
    "mended": laid("corrected", mended, [scan for scan, _ in scans]),
}
fig, _ = views.side_by_side(shown, size=(10, 4.6))
apart = abs(np.degrees(printed[2] - mended[-1][2]))
views.show(fig, f"As printed: two polygons, turned by {apart:.0f}°. Mended: one polygon.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first motion is lost, all that follows hangs on the wrong place, and the second scan is in no map, although every match was good. The
# thesis' figures 3.15 and 3.17 show one polygon, so they cannot come from this listing.
