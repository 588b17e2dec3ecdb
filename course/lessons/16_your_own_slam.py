# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 16 · Your own SLAM
#
# **You will be able to** measure a SLAM of your own as the field does: by relations instead of positions, by
# its map, by its honesty; compare two versions on the same drives; and find out which part of it earns
# its keep, without being fooled by luck.
#
# **52 minutes. Before:** lesson [03](03_kalman_filter.ipynb) for NEES, lesson
# [13](13_scan_matching.ipynb) for matching, lesson [15](15_closing_the_loop.ipynb) for loops.
#
# *Key:* what is not measured does not improve, and a single look is no measurement.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This lesson is about measuring, and the project begins after it. Play "Whose frame?" and
# "The best of many" in full: these two ideas change how a class works. For a poll: the question on the
# one wrong turn, that on the map full of points, and that on fifty versions. `slamlab contest` holds the
# contest; docs/contest.md says how.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import numpy as np

from slamlab import views
from slamlab.checks import ask
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.icp_slam import IcpSlam
from slamlab.geometry import between, compose
from slamlab.layers import Poses, Segments
from slamlab.project.baselines import ROBOT, Baseline
from slamlab.project.drawing import draw_world
from slamlab.project.drive_errors import aligned, map_score, relative_errors
from slamlab.project.driving import drive
from slamlab.project.points import NEES_BAND, claim_cost
from slamlab.project.scores import prepare
from slamlab.project.world_families import FAMILIES, Family

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Whose frame?
#
# Here is a building that has been drawn at random, with furniture, and a drive through it. We know
# the truth, because it is a simulation. A SLAM answers with poses; how good are they?
#
# The first idea is to take the mean distance between where the robot was and where the SLAM says it
# was. Let us try it on a SLAM that makes a single mistake: it misjudges *one* turn by a few
# degrees, and does everything else right.

# %% slideshow={"slide_type": "fragment"}
world = draw_world(FAMILIES["plain"], np.random.default_rng([16, 0]), 30.0)
truth, metres = world.truth.poses, world.metres
walls = Segments("walls", world.floor.outline())
print(f"{len(world)} readings, {metres[-1]:.0f} m of way, {len(walls.rows)} walls")

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-once",
    "One SLAM misjudges its very first turn by 10°, another one its very last turn by 10°. "
    "Everything else is right. **Which of the two is the better SLAM?**",
    {
        "the second: its poses are nearer to the truth": "they are, since there is hardly any way left on "
        "which the mistake could show. That is luck of the drive, not skill.",
        "the first: what came after averages its mistake out": "nothing averages it out: all poses after "
        "it are turned by the same 10°, however many there are.",
        "neither": "each made one mistake of the same size. A measure that tells them apart measures "
        "where on the drive it happened.",
    },
    right="neither",
)


# %% slideshow={"slide_type": "subslide"} answers="16-once"
def with_one_wrong_turn(at, degrees):
    """The true poses, but for one turn that is misjudged."""
    steps = between(truth[:-1], truth[1:])
    steps[at, 2] += np.radians(degrees)
    poses = [truth[0]]
    for step in steps:
        poses.append(compose(poses[-1], step))
    return np.array(poses)


# %% slideshow={"slide_type": "fragment"} answers="16-once"
def two_measures(poses):
    """Mean distance from the truth, and mean error of pieces 5 m long [m]."""
    away = np.hypot(*(poses - truth)[:, :2].T)
    return away.mean(), relative_errors(poses, truth, metres, 5.0).mean()


# %% slideshow={"slide_type": "fragment"} answers="16-once"
def one_wrong_turn(at, degrees):
    poses = with_one_wrong_turn(at, degrees)
    away, e = two_measures(poses)
    title = f"mean distance from the truth {away:.2f} m; mean error of pieces 5 m long {e:.3f} m"
    shown = [walls, Poses("truth", truth), Poses("corrected", poses)]
    fig, _ = views.side_by_side({title: shown}, size=(9, 5))
    return fig


# %% slideshow={"slide_type": "fragment"} answers="16-once"
views.explore(
    one_wrong_turn,
    lambda at, degrees: (
        f"A floor plan with the true way and an estimate that turns away from it by {degrees}° at "
        f"reading {at} and stays at that angle."
    ),
    at=(8, len(truth) - 18, 8),
    degrees=(-20, 20, 10),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-once"
# Move `at`: as the mistake of 10° moves towards the end, the mean distance from the truth falls from
# {= two_measures(with_one_wrong_turn(8, 10))[0]:.2f =} m to
# {= two_measures(with_one_wrong_turn(len(truth) - 18, 10))[0]:.2f =} m. The other number, which we define next,
# stays near {= np.mean([two_measures(with_one_wrong_turn(k, 10))[1] for k in range(8, len(truth) - 18)]):.2f =} m,
# wherever the mistake is made.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Relations
#
# A SLAM chooses its own frame, and a mistake turns all of that frame. So we do not compare poses.
# We compare **relations**: where pose $x_j$ lies as seen from pose $x_i$. The error of a relation
# is what is left when the true one is undone; a star marks the truth:
#
# $$e_{ij} = \ominus\left(\ominus x^*_i \oplus x^*_j\right) \oplus \left(\ominus x_i \oplus x_j\right).
# \tag{16.1}$$
#
# The two poses are a certain distance apart, measured along the drive, such as 5 m, and we take the
# mean length of $e_{ij}$'s position over all such pairs. One wrong turn spoils only the pairs that
# have it between them.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Short, middle, long
#
# How far apart should the two poses be? Each distance asks a different question. We let the
# package's own estimators drive through five such buildings: the wheels alone; `plain`, the ICP of
# lesson 13 without its safeguards; `icp`, with them; and `graph`, with and without loops. Each is
# handed one reading after the other, as yours will be.

# %% slideshow={"slide_type": "fragment"}
SMALL = Family("small", plans=(("crrc", "crc"),))  # four rooms at most
arenas = [prepare(draw_world(SMALL, np.random.default_rng([16, k]), 25.0)) for k in range(5)]
VARIANTS = {
    "plain": lambda: Baseline(IcpSlam(plain=True)),
    "no loops": lambda: Baseline(GraphSlam(ROBOT, loops=False)),
}
drives = [
    dict(arena.drives) | {name: drive(make, arena.readings) for name, make in VARIANTS.items()}
    for arena in arenas
]
NAMES = "odometry", "plain", "icp", "no loops", "graph"


# %% slideshow={"slide_type": "fragment"}
ask(
    "16-lengths",
    "`graph` with its loops and without them: **over which length will their errors differ most?**",
    {
        "over 1 m": "there both do the same: they match a scan with what was seen lately. No loop lies "
        "within one metre.",
        "over 5 m": "a loop that is closed moves each of the steps a little. Five metres gather only a few.",
        "over 20 m": "a long piece gathers the drift of many steps, and that is what a loop takes away.",
    },
    right="over 20 m",
)


# %% slideshow={"slide_type": "subslide"} answers="16-lengths"
def errors_over(way, name):
    """Mean relative error over a length, in each building (k,) [m]."""
    found = []
    for arena, own in zip(arenas, drives, strict=True):
        poses, true = own[name].trajectory, arena.world.truth.poses
        found.append(relative_errors(poses, true, arena.world.metres, way).mean())
    return np.array(found)


# %% slideshow={"slide_type": "fragment"} answers="16-lengths" tags=["folded"]
lengths = np.array([0.5, 1, 2, 5, 10, 20])
errors = {
    name: np.array([errors_over(way, name).mean() for way in lengths])
    for name in ("graph", "odometry", "icp", "no loops")
}
fig, ax = views.curves(lengths, errors, "length of the pieces [m]", "mean error [m]", size=(9, 4.4))
ax.set(xscale="log", yscale="log", xticks=lengths, xticklabels=[f"{way:g}" for way in lengths])
views.legend(ax, loc="upper left")
views.show(
    fig,
    f"Four curves that rise with the length of the pieces: odometry to {errors['odometry'][-1]:.1f} m over "
    f"{lengths[-1]:g} m, icp to {errors['icp'][-1]:.3f} m, graph without loops to {errors['no loops'][-1]:.3f} m, "
    f"graph to {errors['graph'][-1]:.3f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-lengths"
# Over 1 m the two differ by {= 1000 * abs(errors["no loops"][1] - errors["graph"][1]):.1f =} mm,
# over 20 m by {= 1000 * (errors["no loops"][-1] - errors["graph"][-1]):.0f =} mm. A short piece
# shows the noise of a match, a long one shows drift, and whether loops are closed. The project
# takes 1, 5 and 20 m, with equal weight. Since a difficult drive is difficult for everyone, what
# counts is the *factor* by which your errors are smaller than those of the wheels on the same
# drive.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Is the map right?
#
# A map is a heap of points. Two things may be wrong with it: walls that the robot has seen are
# missing, and there are points where no wall is. The map score takes the share of the walls that
# are in the map, and subtracts the share of the points that lie on no wall:
#
# $$\text{score} = \frac{\text{walls with a point within 5 cm}}{\text{walls that were seen}}
# - \frac{\text{points more than 15 cm off all walls}}{\text{points}}. \tag{16.2}$$
#
# Walls are counted every 10 cm, and at most one point in each cell of 5 cm, so that copies of a
# point do not count.

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-map",
    "Somebody hands in a map with a point in **every** cell of 5 cm, all over the building. **What is its "
    "score?**",
    {
        "1: each wall has a point": "the first share is 1 indeed. But the second one is subtracted.",
        "about 0.3": "the first share is 1. Some 70 of 100 cells of a furnished building lie more than "
        "15 cm off all walls, and they are subtracted.",
        "0: nothing was measured": "a score knows nothing of how a map was made. That is why the project "
        "lets a map count no more than the trajectory it is drawn along.",
    },
    right="about 0.3",
)

# %% slideshow={"slide_type": "subslide"} answers="16-map"
seen, all_walls = arenas[0].walls
low, high = all_walls.min(axis=0), all_walls.max(axis=0)
full = np.stack(np.meshgrid(*(np.arange(a, b, 0.05) for a, b in zip(low, high, strict=True))), -1)
graph = drives[0]["graph"]

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="16-map"
maps = {
    "the walls themselves": seen,
    "the walls, 10 cm beside": seen + np.array([0.1, 0.0]),
    "a point everywhere": full.reshape(-1, 2),
    "graph, laid on the truth": compose(
        aligned(graph.trajectory, arenas[0].world.truth.poses),
        np.pad(graph.points, ((0, 0), (0, 1))),
    )[:, :2],
}
for name, points in maps.items():
    print(f"{name:25} {map_score(points, seen, all_walls):5.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-map"
# A flood of points is worth {= map_score(maps["a point everywhere"], seen, all_walls):.2f =}, a map
# that was drawn by `graph` {= map_score(maps["graph, laid on the truth"], seen, all_walls):.2f =}.
# Ten centimetres cost half: walls that run along the shift keep their points, the others lose them.
# In the project a map counts no more than the trajectory that it is drawn along, so floods gain
# nothing there. Before it is scored, a map is laid on the truth by the rigid motion that brings the
# *trajectory* nearest to the true one, because the choice of a frame is nobody's merit and nobody's
# fault.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Do you know how sure you are?
#
# A robot that has to pass a door wants to know how far its pose may be off. You may claim a covariance $P$
# for each pose, at the moment when you give it. Lesson 03 has the test of such a claim, NEES; with the error
# $e$ of the pose,
#
# $$\text{NEES} = e^\top P^{-1} e, \tag{16.3}$$
#
# which is 3 on average if $P$ is true, because a pose has three components.

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-half",
    "Your true errors have the covariance $P$. You claim standard deviations that are **half** as large. "
    "**What is your mean NEES?**",
    right=12,
    tolerance=0.5,
    reason="half of σ is a quarter of the variance. Its inverse is four times as large, and 4 · 3 = 12.",
    wrong={
        6: "twice the NEES would be half of the variance. You halved σ.",
        1.5: "to claim less doubt is to be *over*confident, and that makes NEES larger.",
        3: "that is the mean for a claim that is true.",
    },
)


# %% slideshow={"slide_type": "subslide"} answers="16-half"
def claimed(sigma):
    """What it costs to claim ``sigma`` times the true standard deviations."""
    claims = np.geomspace(0.05, 20, 200)
    costs = {"cost of the claim": [claim_cost(3 / s**2) for s in claims]}
    fig, ax = views.curves(claims, costs, "claimed over true σ", "points", size=(9, 4))
    ax.plot(sigma, claim_cost(3 / sigma**2), "o", color=views.COLOURS["robot"], markersize=11)
    ax.set(xscale="log", title=f"NEES {3 / sigma**2:.3g}: {claim_cost(3 / sigma**2):.1f} points")
    return fig


# %% slideshow={"slide_type": "fragment"} answers="16-half"
views.explore(
    claimed,
    lambda sigma: (
        f"Points lost over claimed σ: none between {np.sqrt(3 / NEES_BAND[1]):.1f} and "
        f"{np.sqrt(3 / NEES_BAND[0]):.1f} times the true one, more to both sides; a dot at {sigma:g}."
    ),
    sigma=(0.1, 10.0, 0.5),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-half"
# A claim costs nothing while σ is stated at most {= np.sqrt(NEES_BAND[1] / 3):.1f =} times too
# small, or {= np.sqrt(3 / NEES_BAND[0]):.1f =} times too large. The band is wide, from
# {= NEES_BAND[0]:.2f =} to {= NEES_BAND[1]:.1f =}, because neighbouring errors of a drive are
# alike: a drive tells little more than one draw, and 95 of 100 draws of a χ² with three degrees of
# freedom lie there. If you claim nothing, you lose nothing. If you claim to be exact, you lose 20
# points.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Where honest doubt comes from
#
# - While only the wheels speak, $P$ grows with each step, as in lesson 04.
# - A matched scan makes the *step* certain, but not the pose: the step's doubt is added to that of
#   the pose before.
# - Neighbouring points of a scan share their errors. A hundred points that err alike are worth one.
# - A loop makes the pose as sure as the old pose was, and the match between them.
#
# When you have a formula, compare it with your errors in practice worlds, and scale it until NEES
# is 3. This is not cheating: it is calibration.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Two versions, the same worlds
#
# You have changed something. Is it better now? Here are the errors over 20 m of `graph` in five buildings, with
# its loops and without. Buildings differ more than the versions do: one is easy for both, another one hard
# for both.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"]
e = {name: errors_over(20.0, name) for name in NAMES}
for name in ("no loops", "graph"):
    print(f"{name:>9}:", "  ".join(f"{error:.3f}" for error in e[name]), "m")

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-paired",
    "The means of both versions have wide intervals, and the intervals overlap. **What follows?**",
    {
        "the versions cannot be told apart": "that would follow if each had driven in other buildings. Here "
        "most of the spread is that of the buildings, and both share it.",
        "nothing yet: look at the differences, building by building": "what is hard for both cancels in "
        "the difference, and the interval of the mean difference is much narrower.",
        "the better mean is better": "five buildings are few: a mean alone says nothing of luck.",
    },
    right="nothing yet: look at the differences, building by building",
)

# %% slideshow={"slide_type": "subslide"} answers="16-paired"
drawn = np.random.default_rng(0).integers(len(arenas), size=(4000, len(arenas)))
without, with_loops = np.log(e["no loops"]), np.log(e["graph"])
intervals = {
    "no loops": np.quantile(np.exp(without[drawn].mean(axis=1)), [0.025, 0.975]),
    "graph": np.quantile(np.exp(with_loops[drawn].mean(axis=1)), [0.025, 0.975]),
    "ratio": np.quantile(np.exp((without - with_loops)[drawn].mean(axis=1)), [0.025, 0.975]),
}
for name, (low, high) in intervals.items():
    print(f"{name:>9}: from {low:.3f} to {high:.3f}")

# %% slideshow={"slide_type": "fragment"} answers="16-paired" tags=["folded"]
number = np.arange(1, len(arenas) + 1)
pair = {name: e[name] for name in ("graph", "no loops")}
fig, ax = views.curves(number, pair, "building", "error over 20 m [m]", size=(9, 4))
ax.set(ylim=(0, 1.35 * max(e["no loops"])))
views.legend(ax, loc="upper left", ncols=2)
views.show(
    fig,
    f"Errors in five buildings: without loops {e['no loops'].min():.3f} to {e['no loops'].max():.3f} m, "
    f"with loops {e['graph'].min():.3f} to {e['graph'].max():.3f} m, below it building by building.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-paired"
# The first two intervals are wide, and they overlap. Yet without loops the errors are larger by a
# factor between {= intervals["ratio"][0]:.1f =} and {= intervals["ratio"][1]:.1f =}, far from 1. We
# took logarithms, since errors differ by factors, and we drew the buildings with replacement, *the
# same ones for both*. This is the **paired bootstrap**, and a contest uses it to tell its ranks
# apart.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Draw two lists of five numbers at the board, and cover the lines between them. Ask for a
# verdict. Then draw the lines. A class that has met the paired t-test will call it out.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Ablation: one thing at a time
#
# A SLAM has parts, and you will have built each of them with effort. Which of them helps? Take out **one**,
# leave everything else, and drive the same worlds. Our five variants are such a row, from nothing to all.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"]
print(f"{'':>9} {'1 m':>7} {'5 m':>7} {'20 m':>7}   map")
for name in NAMES:
    found = [a.judge(own[name]).measures for a, own in zip(arenas, drives, strict=True)]
    over = np.mean([m.errors for m in found], axis=0)
    print(
        f"{name:>9}",
        *(f"{error:7.3f}" for error in over),
        f"{np.mean([m.map for m in found]):5.2f}",
    )

# %% [markdown] slideshow={"slide_type": "fragment"}
# Read it from top to bottom. A matcher that pairs every point, `plain`, is worse than the wheels:
# these buildings have doors, and what only one of two scans has seen must not be paired. With its
# safeguards, as in `icp`, matching brings the errors over 20 m down from the
# {= np.mean(e["odometry"]):.1f =} m of the wheels to {= np.mean(e["icp"]):.2f =} m. Loops take away
# more than half of what `graph` has left without them, and hardly show over 1 m. A part that shows
# nowhere can go: it costs time, and one day it will break.
#
# Decide *before* you look which worlds and which number will settle the question.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## The best of many
#
# Suppose that you try many versions, and none of them is truly better than another. Their scores still
# differ, by luck of the worlds. You keep the best one, and its score is what you tell your friends.

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-best",
    "Fifty versions are equally good. The luck of the worlds moves each score by a standard deviation of "
    "3 points. **By how much will the best of the fifty seem better than it is?**",
    {
        "by nothing: luck cancels": "it cancels in the mean of all fifty, not in the one that was chosen "
        "*because* it was lucky.",
        "by about 3 points": "that is how far a single score lies off, give or take. The largest of fifty lies "
        "farther out.",
        "by about 7 points": "the largest of fifty normal numbers lies 2.2 standard deviations out on average.",
    },
    right="by about 7 points",
)


# %% slideshow={"slide_type": "subslide"} answers="16-best"
STUDENTS, SPREAD = 1000, 15.0  # who try; of a version's points between worlds


# %% slideshow={"slide_type": "fragment"} answers="16-best" tags=["folded"]
def best_of(versions, worlds):
    """How much better the best of some equally good versions seems to each student."""
    luck = np.random.default_rng(1).standard_normal((STUDENTS, versions))
    luck = luck * SPREAD / np.sqrt(worlds)
    best = luck.max(axis=1)
    fig, ax = views.chart("points that the best one seems better", "students", size=(9, 4))
    ax.hist(best, np.arange(-15, 45, 1), color=views.COLOURS["corrected"])
    ax.set(
        title=f"best of {versions}, {worlds} worlds: {best.mean():.1f} points by luck",
        ylim=(0, 420),
    )
    return fig


# %% slideshow={"slide_type": "fragment"} answers="16-best"
views.explore(
    best_of,
    lambda versions, worlds: (
        f"Histogram over {STUDENTS} students of what the best of {versions} equally good versions seems better in "
        f"{worlds} worlds: all by luck."
    ),
    versions=(1, 100, 50),
    worlds=(1, 100, 25),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-best"
# In one world a version's points vary by 15 here, so in 25 worlds its score varies by 3. With one version
# nothing is gained by luck; with fifty, 7 points; in few worlds far more. More worlds help, fewer tries help,
# and one thing helps for certain: **a world that you have not used for choosing**.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Worlds that nobody has seen
#
# - Choose by some practice worlds, say `seed=1`, as often as you like. Then measure the score in
#   others, once.
# - A contest draws its worlds from bits that nobody knows beforehand. A hash of these bits is
#   published first, so that nobody can choose them afterwards either.
# - A board that is open for weeks can be climbed by luck: hand in fifty versions, and keep the
#   best. The **Ladder** shows a new score only where it is better by more than luck, and otherwise
#   the old one.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## What to try first
#
# 1. **Drive the template** and look at the picture. Know the wheels' errors before you mend them.
# 2. **Match each scan with the last ones**, beginning where the wheels say; leave out pairs that lie far
#    apart. This is the largest step of all, as the table has shown.
# 3. **Keep keyframes**, one every metre or so. Matching with the scan before gathers the noise of every match.
# 4. **Doubt a match.** In a bare corridor it slides along the walls; after lost scans it may begin too
#    far off. Then believe the wheels for a step.
# 5. **Close loops** with a graph, and give its poses back in `trajectory()`.
# 6. **Claim a covariance** last, when your errors have become what they will be.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### And what hurts
#
# | it happens | what it looks like | try |
# | --- | --- | --- |
# | a false loop | the whole map folds at once | verify twice, weigh it down (lesson 15) |
# | people walk by | walls with hair | drop pairs that do not fit |
# | ranges 1 % too long | all is well over 1 m, bent over 20 m | compare with the wheels' metres |
# | carried away | two maps on top of each other | search the whole map for the scan |
# | out of time | the last worlds are lost | thin the points, match with less |
#
# Look at the *first* moment at which things go wrong: most of what goes wrong later only follows from it.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Carried away
#
# The odometry does not notice it, but the scan does. Match it with what was seen lately, beginning where the
# wheels lead, and count the share of its points that then lie near a wall. In five buildings of the family
# `kidnapped` it was less than a fifth for the first scan after the jump. In ten other
# buildings, with people or lost scans in them, it was more than a third for every scan, unless scans
# had been lost just before.
#
# The project's solution begins a second map at such a scan. It tries each new keyframe at all places of the
# first map, in 24 directions, and when two keyframes in a row have been found at places that agree, it joins the maps. In
# those five buildings this earns 100 points; without it the same code had between 40 and 60.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can say how good a SLAM is, over short pieces and long ones, by its map and by what it says
# about its own errors; compare two versions fairly; find the part that helps; and avoid being
# fooled by the best of many.
#
# **Literature.** R. Kümmerle and others, "On measuring the accuracy of SLAM algorithms", Autonomous Robots, 2009:
# relations. A. Geiger, P. Lenz, R. Urtasun, "Are we ready for autonomous driving?", CVPR 2012: errors over lengths,
# and hidden truth. B. Efron, "Bootstrap methods: another look at the jackknife", Annals of Statistics, 1979. A. Blum,
# M. Hardt, "The Ladder: a reliable leaderboard for machine learning competitions", ICML 2015. Read Kümmerle
# next.
#
# **What comes next:** [the project](../exercises/ex16_your_own_slam.ipynb). You start from a class
# that already drives, pass three milestones, and end in worlds that nobody has seen.
