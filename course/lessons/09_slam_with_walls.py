# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 09 · SLAM with walls: line landmarks
#
# **You will be able to** run a whole EKF-SLAM system on the walls of a building, name the uncertain
# parameters of a line landmark, merge two landmarks that represent the same wall, and measure how a fault in one
# part of the system affects the rest.
#
# **75 minutes** in two parts: the system (38), and its faults (37). **Before:** lessons
# [03](03_kalman_filter.ipynb) (NEES), [06](06_ekf_slam.ipynb) (EKF-SLAM) and
# [08](08_landmarks_from_scans.ipynb) (lines of a scan, data association).
#
# *Key:* the input of the filter must be what the sensor measured, and nothing else.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Each part fits into one lecture. The first part ends with the live view, in which
# students can steer the robot. Before the second part, let the class rank the faults in "Faults, one at
# a time" by the harm they expect, and compare the ranking with the results at the end. For a poll, use
# the questions on the initialised wall, the merging, the foot point and the harm. The system is that of
# Smolec's master's thesis.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from copy import deepcopy
from dataclasses import replace
from functools import cache, partial

import numpy as np
import sympy as sp
from IPython.display import Markdown

from classroom.checks import ask, compare
from course.studies import corridor, line_extraction_errors, wall_slam_faults
from course.studies.study_command import stored
from course.studies.wall_slam_loop import WallLoop, tally
from slamlab import estimators, live, models, views
from slamlab.estimators.wall_merging import ends_of
from slamlab.estimators.wall_slam import GATE, WallSlam
from slamlab.evaluation import band, nees
from slamlab.filters import MAK
from slamlab.filters.landmark_models import LINES
from slamlab.filters.landmark_merging import merge, squared_difference
from slamlab.geometry import compose, transform, wrap
from slamlab.landmarks.downsampling import DownsampledPoints
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.sonar_lines import fit_cone, sonar_lines
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import ULTRASONIC
from slamlab.simulation.worlds import World
from slamlab.sources import simulation
from slamlab.sources.simulated_robot import THESIS_LIDAR

ORIGIN = [[0, 0, 0.4, 0], [0, 0, 0, 0.4]]  # the axes of the world

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Dead reckoning in two buildings
#
# A robot drives through two simulated buildings. *Situation 1* has rooms off a corridor; *situation 2* is
# one irregular room with a slanted wall. The robot has a lidar with a range error of 1 % (σ), and wheels
# that slip a little, at random.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The median counts, not the picture: its run ends near its start by chance. Let
# the class find in the left panel where the heading error is largest, and why the end hardly shows
# it.

# %% slideshow={"slide_type": "fragment"}
# both simulated tours, dead reckoning, and a stored table of 60 runs
sources = {
    name: simulation(name, np.random.default_rng(1)) for name in ("situation-1", "situation-2")
}
odometry = {
    name: estimators.run(source, estimators.DeadReckoning()).trajectory.poses
    for name, source in sources.items()
}
driven_m = {n: np.hypot(*np.diff(s.truth.poses[:, :2], axis=0).T).sum() for n, s in sources.items()}
step_at_most = np.abs([reading.odometry for reading in sources["situation-2"]]).max(axis=0)
many = stored("wall_slam_variants")["situations"]  # the same tours, simulated with 60 seeds

# %% [markdown] slideshow={"slide_type": "fragment"}
# The tour of situation 1 is {= driven_m["situation-1"]:.0f =} m long.

# %% slideshow={"slide_type": "fragment"}
ask(
    "09-odometry",
    "How far off is dead reckoning at the end of the tour of situation 1, in the median of 60 such runs?",
    {
        "some centimetres: random slips cancel": "errors of the distance nearly cancel. But an "
        "error of the heading rotates the whole trajectory after it.",
        "one to two metres": "the heading has an error of some degrees, and each further metre "
        "increases the position error.",
        "about ten metres, a quarter of the tour": "for such an error the estimated heading "
        "would have to be wrong during most of the tour. But these wheels slip only a little, "
        "at random, to both sides.",
    },
    right="one to two metres",
)

# %% slideshow={"slide_type": "subslide"} answers="09-odometry" tags=["folded"]
shown = {
    f"{name}, {driven_m[name]:.0f} m": [
        Segments("walls", source.world.outline()),
        Poses("truth", source.truth.poses),
        Poses("naive", odometry[name]),
    ]
    for name, source in sources.items()
}
fig, _ = views.side_by_side(shown, size=(9, 4.6), shared=False)
turned_off = np.degrees(
    np.abs(wrap(odometry["situation-1"] - sources["situation-1"].truth.poses)[:, 2])
)
views.show(
    fig,
    "A corridor with rooms, and an irregular room. The trajectories of dead reckoning deviate "
    f"from the true ones, in situation 1 by up to {turned_off.max():.0f} degrees, and pass "
    "through walls.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="09-odometry"
# In 60 runs the median error at the end is {= 100 * many["situation-1"]["odometry"]["final_m"]:.0f =}
# cm, and the largest is {= 100 * many["situation-1"]["odometry"]["final_m_worst"]:.0f =} cm. The final
# error of the run in the picture is only
# {= 100 * np.hypot(*(odometry["situation-1"] - sources["situation-1"].truth.poses)[-1, :2]):.0f =} cm,
# by chance. Its heading error grows to {= turned_off.max():.0f =}°, mostly early in the tour. But a
# round trip that is rotated as a whole about its start still ends at its start.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## One step of EKF-SLAM with walls
#
# You know all the parts except the last one. One step of the whole system executes them in this order:
#
# | step | what happens | lesson |
# |---|---|---|
# | **predict** | odometry moves the pose, and $P$ grows | 06 |
# | **extract** | feature extraction: the scan's lines, each with its covariance $R$ | 08 |
# | **associate** | data association: which line belongs to which wall of the map? | 08 |
# | **update** | walls that are observed again correct the whole state | 06 |
# | **initialise** | track management: new lines become tentative landmarks; after three observations they enter the map | 08 |
# | **merge** | two landmarks that represent the same wall become one | here |
#
# Why do new lines not enter the map at once? A line can be a **false measurement**, that is, a
# measurement that does not come from a landmark: for example, a line fitted to a round pillar or to a
# person. All false measurements together are called **clutter**.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Point at the grey boxes of the figure: what the filter discards limits what it
# can correct later. If time is short, show only the table and the figure.

# %% [markdown] slideshow={"slide_type": "subslide"}
# The class `WallLoop` of `course.studies` implements this small system, and its step has the structure
# of the table. The caller extracts the lines. They do not depend on the map, so later we can use the
# same lines for systems with a fault.
#
# ```python
# def step(self, odometry, found):
#     self.predict(odometry)
#     known, new = self.associate(found)
#     self.update(known)
#     self.initialise(new, known)
#     self.merge()
# ```
#
# The world frame of the map is the frame of the first pose, whose $P$ is 0. The lines of the first scan
# enter the map at once; otherwise the map would be empty, and no line could be associated. So false
# measurements of the first scan enter the map, too.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What the filter keeps, and what it discards
#
# Guess first: the lidar measures about a hundred thousand ranges on the tour. How many components does
# the state have at the end?

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
found = {name: wall_slam_faults.extracted_lines(source) for name, source in sources.items()}
count = tally(sources["situation-1"], found["situation-1"])
step, kept, lost = (partial(views.Box, kind) for kind in ("step", "kept", "lost"))
boxes = {
    "wheels": views.Box("device", "wheels", 0.65, 2.9, 1.1),
    "lidar": views.Box("device", "lidar", 0.65, 1.75, 1.1),
    "predict": step("predict", 2.55, 2.9, 1.2),
    "extract": step("extract", 2.55, 1.75, 1.2),
    "associate": step("associate", 4.3, 2.325, 1.15, 1.85),
    "update": step("update", 6.2, 2.9, 1.0),
    "initialise": step("initialise", 6.95, 1.75, 1.15),
    "merge": step("merge", 8.55, 2.9, 1.0),
    "map": kept("pose, walls (ρ, α), and their $P$;\nwhere each was seen", 5.5, 4.3, 7.2, 0.8),
    "waiting": kept("tentative\nwalls", 8.55, 1.75, 1.2, 0.75),
    "ranges": lost("all ranges, once\nthe lines are found", 2.45, 0.5, 1.85, 0.75),
    "unclear": lost("a wall's second line,\nor one that fits badly", 4.7, 0.5, 2.1, 0.75),
    "unseen": lost("not seen again\nin 3 scans", 8.4, 0.5, 1.5, 0.75),
}

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
flows = [
    ("wheels", "predict", f"{count['steps']}\nsteps"),
    ("lidar", "extract", f"{count['ranges']}\nranges"),
    ("extract", "associate", f"{count['lines']}\nlines"),
    ("associate", "update", f"{count['known']}\nknown"),
    ("associate", "initialise", f"{count['new']} new"),
    ("associate", "unclear", f"{count['unclear']}"),
    ("=map", "initialise", f"{count['entered']} enter"),
    ("=map", "merge", f"{count['merged']} merged"),
    *(("=map", name, "") for name in ("predict", "update")),
    *(("map", "associate", ""), ("=waiting", "initialise", "")),
    *(("extract", "ranges", ""), ("waiting", "unseen", "")),
]
views.show(
    views.process(boxes, flows, (9.3, 4.9)),
    f"The data flow of the system: {count['ranges']} ranges become {count['lines']} lines, of "
    f"which {count['known']} are known walls and {count['new']} new; the final map has "
    f"{count['walls']} walls. Pose, walls and tentative walls are kept; ranges, ambiguous lines "
    "and walls not seen again are discarded.",
)
size = 3 + 2 * count["walls"]
different = len(np.tril_indices(size)[0])

# %% [markdown] slideshow={"slide_type": "fragment"}
# The numbers are those of the whole tour of situation 1. Only the data in blue frames are kept for the
# next step. At the end of the tour the map has {= count["walls"] =} walls, so the state has {= size =}
# components. The filter keeps neither scans nor earlier poses. So it cannot undo a wrong association,
# because the scan is not available later. The SLAM of lesson 15 keeps scans and poses, and can undo
# wrong associations.
#
# **Your turn.** $P$ has `size` rows and columns and is symmetric. How many different numbers does $P$
# contain?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
numbers_in_P = ...  # from size
compare(numbers_in_P, different)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# numbers_in_P = size * (size + 1) // 2
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Line landmarks
#
# A wall is stored as a **line landmark** (also *wall landmark*), in **Hessian normal form**: all points $(a, b)$ with
# $a \cos\alpha + b \sin\alpha = \rho$. Its two parameters are $\rho$ and $\alpha$; the ends of the wall are stored
# outside the filter. The robot at $x, y, \theta$ measures the wall's distance $\rho'$, and the direction $\alpha'$ of
# its normal relative to the heading. Lesson 08 derived
#
# $$ \rho' = \rho - x \cos\alpha - y \sin\alpha, \qquad \alpha' = \alpha - \theta. \tag{09.1} $$
#
# This is the measurement model $h$. To initialise a new landmark we need the inverse measurement model
# $g$. We obtain it by solving (09.1) for the wall:
#
# $$ \alpha = \theta + \alpha', \qquad \rho = \rho' + x \cos\alpha + y \sin\alpha. \tag{09.2} $$
#
# Here $\rho$ may be negative: the normal points away from the position from which the wall was first
# *observed*, and the world's origin may lie on the other side of the wall. Do not reverse the normal,
# because (09.1) also holds for negative $\rho$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Demonstrate the question with a long rod as the wall: it stays 2 m in front of a
# person (the robot) and turns with the person, and its distance from a mark on the floor (the
# origin), 5 m to the side, changes. Students who choose "only α" read ρ as a distance from the robot.

# %% slideshow={"slide_type": "subslide"}
ask(
    "09-pivot",
    "A robot knows its position exactly, 5 m to the side of the world's origin, and its heading with a σ of 2°. It "
    "measures a wall 2 m straight ahead (without any error) and initialises it by (09.2). What is uncertain?",
    {
        "only α: ρ′ was measured, and the position is known": "ρ′ is the distance from the robot. ρ is the "
        "distance from the world's origin, 5 m to the side, and it changes when the line is rotated.",
        "α and ρ, with independent errors": "the heading error is the only error. A single "
        "error cannot cause two independent errors.",
        "α and ρ, both because of the same error": "the wall is rotated about the robot: the "
        "error of α equals the heading error, and the error of ρ is the heading error times a "
        "lever arm.",
    },
    right="α and ρ, both because of the same error",
)


# %% slideshow={"slide_type": "fragment"} answers="09-pivot" tags=["folded"]
def initialised(metres_aside, heading_sigma_in_degrees):
    """Twenty robots with heading errors only initialise the same wall, 2 m ahead."""
    theta = np.radians(heading_sigma_in_degrees) * np.random.default_rng(9).normal(size=20)
    walls = np.array([models.g_line([0, metres_aside, t], [2.0, 0]) for t in theta])
    along = np.array([[-1.5, 8.0]])
    ends = np.concatenate([ends_of(wall, along).reshape(-1, 4) for wall in walls])
    title = f"standard deviation of ρ {100 * walls[:, 0].std():.1f} cm, "
    title += f"of α {np.degrees(wrap(walls[:, 1])).std():.1f}°"
    fig, (ax,) = views.panels([title], (8.2, 6))
    ax.set_aspect("equal", adjustable="box")
    layers = {
        "the wall, as 20 robots initialise it": Segments("landmark", ends),
        "2 m around the robot": Segments(
            "perpendicular", World(circles=[(0.0, metres_aside, 2.0)]).outline()
        ),
        "origin of the world": Segments("truth", ORIGIN),
        "robot": Poses("robot", [[0, metres_aside, 0]]),
    }
    for label, layer in layers.items():
        views.draw(ax, layer, label=label, linewidth=0.8)
    ax.set(xlim=(-4, 6), ylim=(-1.5, 7.2))
    views.legend_below(fig)
    return fig


J_pose, _ = LINES.J(np.array([0, 5.0, 0]), np.array([[2.0, 0]]))
sigma_by_J = abs(J_pose[0, 0, 2]) * np.radians(2)

# %% slideshow={"slide_type": "subslide"} answers="09-pivot"
views.explore(
    initialised,
    lambda metres_aside, heading_sigma_in_degrees: (
        f"Twenty lines in front of a robot that stands {metres_aside:.1f} m from the origin; "
        "they touch one circle around the robot."
    ),
    metres_aside=(0.0, 5.0, 5.0),
    heading_sigma_in_degrees=(0.0, 5.0, 2.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="09-pivot"
# All lines touch a circle around the robot, whose radius is the measured $\rho'$. But their distances
# from the origin differ. If you move the robot to the origin, $\rho$ becomes certain. This does not
# mean that the wall is known better: its uncertainty in front of the robot is the same. Only the lever
# arm has become zero, that is, the robot's distance from the origin *along the wall*.
#
# The filter represents this dependence by the Jacobians of (09.2) and by the covariance of $\rho$ and
# $\alpha$. You derive the Jacobians in the exercise.
#
# **Your turn.** The robot in the picture stands 5 m to the side of the origin, and $\sigma$ of its heading is 2°.
# Compute $\sigma$ of $\rho$ in metres, to first order.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
sigma_rho = ...  # lever arm times σ of the heading in radians
compare(sigma_rho, sigma_by_J)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# sigma_rho = 5.0 * np.radians(2.0)
# ```
#
# The library computes the same number from its Jacobian. The standard deviation over the 20 random
# robots above is close to this number.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Landmark merging
#
# Suppose that the robot observes two pieces of a wall through two doors. It has not observed the part
# between them, so the pieces enter the map as two landmarks. Later the robot enters the room, and both
# pieces grow until they touch.
#
# Now the filter has to combine the two landmarks into one. This step is called **landmark merging** (also
# *landmark fusion*). No sensor measures that two landmarks are equal, but the filter can process this
# information like a measurement (lesson 06) of the difference $\Delta = l_j - l_i$, with the value
# zero.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Many students want a large $R$ because the decision may be wrong. Separate the
# two steps: the test (09.4) decides, and after the decision the information is certain. Ask against
# which mistake each of the three conditions protects.

# %% slideshow={"slide_type": "fragment"}
ask(
    "09-merge",
    "The filter is given the measurement that the difference of two landmarks is zero. What covariance R does "
    "this measurement have?",
    {
        "the lidar's": "P already includes the lidar's measurements of each wall. The new "
        "information does not come from a scan.",
        "a large one, for we may be mistaken": "then two nearly equal walls would remain. A "
        "test has to decide beforehand whether they are the same wall.",
        "zero": "a wall is equal to itself without any error, so this measurement has no noise.",
    },
    right="zero",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="09-merge"
# With $R = 0$ the covariance of the innovation is $S = H P H^{\mathsf T}$ alone, and the update of
# lesson 06 becomes
#
# $$ P \leftarrow P - P H^{\mathsf T} (H P H^{\mathsf T})^{-1} H P,
# \qquad H = \begin{bmatrix} 0 & \cdots & {-I} & \cdots & I & \cdots \end{bmatrix}. \tag{09.3} $$
#
# After this update the two landmarks are equal without any uncertainty, and the filter removes one of
# them. A wrong merge cannot be undone, while a missed merge can be made up for after the next scan. So
# the filter tests three conditions before it merges: the pieces have to be parallel within 3°, to touch
# or nearly touch (within 0.5 m), and to pass a narrow gate,
#
# $$ \Delta^{\mathsf T} (H P H^{\mathsf T})^{-1} \Delta < 9.21, \tag{09.4} $$
#
# which two pieces of one wall fail in 1 % of the cases, if $P$ is correct and the errors are Gaussian.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="09-merge"
# initialise two pieces of one wall and a door, then merge the pieces
mak = MAK(np.zeros(3), np.diag([0.02, 0.02, 0.01]) ** 2, kind=LINES)
R_PIECE = np.diag([0.01, 0.01]) ** 2
mak.add(["left", "right"], [[2.0, 1.57], [2.03, 1.56]], R_PIECE)
mak.add(["door"], [[1.0, 0.0]], R_PIECE)
P_before = mak.P.copy()
sigma = np.sqrt(np.diag(P_before))
print(f"squared distance of the two: {squared_difference(mak, 'left', 'right'):.1f}")
merge(mak, "left", "right")
now = np.sqrt(np.diag(mak.P))
print(f"σ of ρ of the left wall: {100 * sigma[3]:.2f} → {100 * now[3]:.2f} cm")
print(f"σ of the robot's heading: {sigma[2]:.4f} → {now[2]:.4f} rad")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="09-merge"
# After the merge, the variance of the wall is smaller than that of either piece. The variance of the heading is
# unchanged: both pieces were initialised with the same heading, so their difference gives no information on it.
#
# The two *sides* of a wall remain two landmarks. Their normals point away from the positions from which
# they were observed, so their directions differ by 180°. In addition, a real wall has a thickness. The
# test before each merge keeps the two sides apart: their directions do not agree within 3°.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
H = np.zeros((2, 9))  # of the pose, left, right and door
H[:, 3:5], H[:, 5:7] = -np.eye(2), np.eye(2)
expected = mak.P[np.ix_([0, 1, 2, 3, 4, 3, 4, 5, 6], [0, 1, 2, 3, 4, 3, 4, 5, 6])]  # right is left

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** `P_before` (9, 9) is the covariance of the pose and the walls left, right and door, before the
# merge. `H` (2, 9) is the matrix of (09.3). Compute the covariance after the merge, before *right* is removed.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
P_merged = ...  # by (09.3)
compare(P_merged, expected)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# S = H @ P_before @ H.T
# P_merged = P_before - P_before @ H.T @ np.linalg.inv(S) @ H @ P_before
# ```
#
# The rows of *left* and *right* are equal now: both represent the same wall.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The whole tour
#
# Now the robot drives both tours with the system. We store the estimated pose, its covariance and the
# map after each step. Guess first: how large will the position error be, compared with dead reckoning?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students take the small error of the pose as a proof of consistency. The map of
# situation 2 is the counterexample: it is overconfident although the pose is not.


# %% slideshow={"slide_type": "fragment"}
poses, P, maps, loops = {}, {}, {}, {}
for name, source in sources.items():
    loops[name] = WallLoop(source)
    poses[name], P[name], maps[name] = wall_slam_faults.driven(source, loops[name], found[name])


def position_error(name, estimated):
    """Error of the position after each step [cm]."""
    return 100 * np.hypot(*(estimated - sources[name].truth.poses)[:, :2].T)


scans = {name: [reading.scan.points() for reading in source] for name, source in sources.items()}


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def maps_up_to(situation, step):
    """Both maps up to a step: every 20th scan's points, and the walls of the filter."""
    step = min(step, len(scans[situation]) - 1)
    layers = {}
    for what, role, estimated in (
        ("odometry", "naive", odometry[situation]),
        ("SLAM", "corrected", poses[situation]),
    ):
        shots = [transform(estimated[k], scans[situation][k]) for k in range(0, step + 1, 20)]
        title = f"{what}: error {position_error(situation, estimated)[step]:.1f} cm"
        layers[title] = [Points("scan", np.vstack(shots)), Poses(role, estimated[: step + 1])]
    layers[title].append(Segments("landmark", maps[situation][step]))
    return views.side_by_side(layers, size=(9, 4.6))[0]


# %% slideshow={"slide_type": "subslide"}
views.explore(
    maps_up_to,
    lambda situation, step: (
        f"Two maps of {situation} at step {step}: with odometry each wall appears many times, "
        "rotated; with SLAM each wall appears once, with a green line through its points."
    ),
    situation=list(sources),
    step=(0, 289, 289),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With odometry each wall appears many times, each time rotated a little more. With SLAM each wall
# appears once, and the doors are visible as gaps. Change the step to see how walls enter the map, grow
# and merge.

# %% [markdown] slideshow={"slide_type": "subslide"} minutes=6
# ### Accuracy and consistency of the pose

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
trajectories = {"odometry": ("naive", odometry), "SLAM": ("corrected", poses)}
errors = {
    what: [position_error(name, estimated[name]) for name in sources]
    for what, (_, estimated) in trajectories.items()
}
fig, ax = views.chart("step", "error of the position [cm]", None, (9, 4.4))
for what, (role, _) in trajectories.items():
    for name, error, dash in zip(sources, errors[what], ("-", "--"), strict=True):
        ax.plot(error[1:], dash, color=views.COLOURS[role], label=f"{name}, {what}")
ax.set(yscale="log")
views.legend_below(fig)
worst = {what: max(map(np.max, both)) for what, both in errors.items()}
rms = {what: np.sqrt([np.mean(each**2) for each in both]) for what, both in errors.items()}
gain = rms["odometry"] / rms["SLAM"]
views.show(
    fig,
    f"On a logarithmic axis, the error of odometry rises to {worst['odometry']:.0f} cm, and that "
    f"of SLAM to {worst['SLAM']:.1f} cm at most.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The axis is logarithmic. In these two runs the error with SLAM stays below
# {= np.ceil(worst["SLAM"]):.0f =} cm, and its root mean square is {= min(gain):.0f =} to
# {= max(gain):.0f =} times smaller than that of odometry. A single reading of this lidar has a $\sigma$
# of 5 cm at 5 m. But each line is fitted to
# {= np.median([len(line.beams) for seen in found["situation-1"] for line in seen]):.0f =} readings (in
# the median), and the {= len(maps["situation-1"][-1]) =} walls of the map combine {= count["known"] =}
# associated lines.
#
# Is the filter consistent? A single run gives little evidence, since the errors of neighbouring steps
# are correlated. Over 60 runs the mean NEES of the pose is
# {= many["situation-1"]["(ρ, α), first estimates"]["nees"]:.2f =} in situation 1 and
# {= many["situation-2"]["(ρ, α), first estimates"]["nees"]:.2f =} in situation 2. For a consistent
# filter the expected value is 3, and the mean of 60 independent values is between
# {= stored("wall_slam_variants")["band_95"][0]:.2f =} and
# {= stored("wall_slam_variants")["band_95"][1]:.2f =} in 95 % of cases. (Each run's value is itself a
# mean over its steps from the tenth on, so the test is lenient.) These values are no evidence against
# consistency. This filter uses first-estimates Jacobians (lesson 06); with standard Jacobians the NEES
# is {= many["situation-1"]["(ρ, α), standard"]["nees"]:.2f =} and
# {= many["situation-2"]["(ρ, α), standard"]["nees"]:.2f =}, about the same.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** `error_end` (3,) is the error of the pose at the end of the tour of situation 1, with its angle
# wrapped, and `P_end` (3, 3) is its covariance. Compute the NEES of this one pose.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
error_end = wall_slam_faults.errors(sources["situation-1"], poses["situation-1"])[-1]
P_end = P["situation-1"][-1]
nees_end = ...  # one number
compare(nees_end, nees(error_end, P_end))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# error_end = wall_slam_faults.errors(sources["situation-1"], poses["situation-1"])[-1]
# P_end = P["situation-1"][-1]
# nees_end = error_end @ np.linalg.inv(P_end) @ error_end
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Accuracy and consistency of the map
#
# In a simulation the true lines are known. We compare each wall of the final map with the nearest true line. The
# errors of the walls of one map are correlated, so we test them together. The NEES of the *whole* map uses all of its
# covariance. For a consistent filter its expected value is the number of entries, two for each wall.

# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"]
faulty = stored("wall_slam_faults")  # 12 runs of both situations, without a fault and with one
MANY = faulty["seeds"][1] + 1
for name, loop in loops.items():
    off, per_entry = wall_slam_faults.map_errors(sources[name], loop)
    rms_rho, rms_alpha = 1000 * np.sqrt(np.mean(off**2, axis=0))
    print(
        f"{name}: {len(off):2} walls, RMS error of ρ {rms_rho:.1f} mm, of α {rms_alpha:.1f} mrad;",
        end=" ",
    )
    print(f"NEES of the map {off.size * per_entry:.0f}, entries {off.size}")
map_nees = {
    key: [faulty["situations"][name]["as it should be"][key] for name in sources]
    for key in ("map_nees", "map_nees_drawn")
}
band_1, band_2 = (np.array(band(2 * n, MANY)) / (2 * n) for n in (17, 9))  # median numbers of walls
negative = {name: int(np.sum(loop.mak.landmarks()[:, 0] < 0)) for name, loop in loops.items()}

# %% [markdown] slideshow={"slide_type": "subslide"}
# The errors of the walls are a few millimetres. But one NEES for each situation gives little evidence.
# So we divide the NEES of the map by the number of its entries, and compute the mean over {= MANY =}
# runs. For a consistent filter the expected value is 1.
#
# - Situation 1: {= map_nees["map_nees"][0]:.2f =}; 95 % interval {= band_1[0]:.2f =} to {= band_1[1]:.2f =}.
# - Situation 2: {= map_nees["map_nees"][1]:.2f =}; 95 % interval {= band_2[0]:.2f =} to {= band_2[1]:.2f =}.
#
# The mean of situation 1 is at the upper end of its interval. That of situation 2 is far above: this map is
# overconfident, although the pose is not.
#
# Does the filter cause this, or do the extracted lines? The same runs were repeated with the errors of
# the lines drawn at random from their $R$. Then the means are {= map_nees["map_nees_drawn"][0]:.2f =}
# and {= map_nees["map_nees_drawn"][1]:.2f =}, and they are no evidence against the filter. So feature
# extraction makes errors that $R$ does not include. Probably these errors repeat from scan to scan; a
# filter averages out only independent errors.
#
# Of the walls, {= negative["situation-1"] =} in situation 1 and {= negative["situation-2"] =} in situation 2 have a
# negative $\rho$.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Live: drive it yourself
#
# Choose a simulation and press **run**. In the first two, the robot drives the tour, and then you can
# steer it with the arrow keys; in those "by hand" you steer it from the beginning. Click the picture
# first. The points of all scans are orange, and the walls of the map are green. The picture shows the
# robot with its 95 % ellipse if the ellipse is large enough to be visible. (Without a running kernel
# you see a still picture.)
#
# Try to make the robot's pose uncertain. In which corner of the building is this easiest?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The ellipse is mostly too small to be seen: ask why, before you look for a place
# where it grows. Let a student steer while the class predicts in which direction the ellipse will be
# long.


# %% slideshow={"slide_type": "fragment"}
# the simulations of the buttons, and the curve of the error
def error_of(pair):
    """Error of the estimated position now [cm]."""
    return 100 * np.hypot(*(pair.estimator.pose - pair.source.truth.poses[pair.count - 1])[:2])


buttons = {
    f"Simulation {n}{hand}": partial(simulation, f"situation-{n}", tour=not hand)
    for hand in ("", ", by hand")
    for n in (1, 2)
}

# %% slideshow={"slide_type": "subslide"}
seen_live = live.watch(
    buttons,
    partial(estimators.make, "walls"),
    "Rooms off a corridor, half of them seen: orange points, green walls, the robot in the upper room.",
    steps=60,
    extra=lambda pair: [Segments("axes", [[0, 0, 1, 0], [0, 0, 0, 1]])],
    curves={"error [cm]": {"corrected": error_of}},
    title="Rooms and walls",
    seed=1,
    size=(900, 340),
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# It is hard to make the pose uncertain here: two walls that are not parallel determine the position,
# and one wall determines the heading. The section "A corridor without ends" shows an environment in
# which the walls do not determine the position.
#
# *This is a good place for a break.*

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# # Part two: faults and their effects
#
# ## Foot points as measurements
#
# The EKF-SLAM of lesson 06 uses point landmarks. Can it use one point of each wall, the **foot point**
# of the perpendicular from the world's origin? Every wall has a foot point, which can be computed from
# the measured line and the pose. The filter of lesson 06 can use its range and bearing as a
# measurement. Smolec's program uses foot points in this way.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Before the vote, let one student walk along a wall of the hall and point at the
# foot point of that wall, seen from a fixed origin: it does not move. The word *zero* sounds good to
# the class; ask what a filter concludes from an innovation that is always zero.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
fig, (ax,) = views.panels([None], (9, 4.4))
layers = {
    "wall": Segments("walls", [[2.4, 2, 6, 2]]),
    "measured: ρ′": Segments("scan", [[4, 0.3, 4, 2]]),
    "perpendicular": Segments("perpendicular", [[0, 0, 0, 2]]),
    "given to the filter": Segments("naive", [[4, 0.3, 0, 2]]),
    "foot point": Points("landmark", [[0, 2]]),
    "origin of the world": Segments("truth", ORIGIN),
    "robot": Poses("robot", [[4, 0.3, 0]]),
}
for label, layer in layers.items():
    views.draw(ax, layer, label=label)
ax.margins(0.12)
views.legend_below(fig)
views.show(
    fig,
    "A wall above the robot. A line straight up to the wall shows its measured distance; the "
    "foot point lies far to the left, above the origin, beyond the end of the wall.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# But no sensor *measures* a foot point. The foot point may even lie beyond the end of the wall. And the
# program computes it with the filter's own estimate of the pose.

# %% slideshow={"slide_type": "subslide"}
ask(
    "09-foot",
    "The robot has slipped 10 cm along a wall, and its odometry has not measured this; its "
    "estimated heading is right. From its scan and its estimated pose it computes the foot "
    "point of the wall. How large is the error of this foot point along the wall?",
    {
        "10 cm, as that of the robot": "a measured point would have this error. But a foot "
        "point is not measured: it lies opposite the world's origin for every position of the "
        "robot.",
        "10 cm, in the opposite direction": "the points of the wall move in this direction in "
        "the robot's frame, but the lidar cannot distinguish one point of a bare wall from the "
        "next.",
        "zero": "this is the problem. The foot point agrees exactly with the map along the "
        "wall, and the filter treats this agreement as information.",
    },
    right="zero",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="09-foot"
# Let the estimated position have the error $e$, while the heading is right and the sensor has no noise.
# Let $n$ and $n_\perp$ be the unit vectors across the wall and along it. How does this error change the
# computed foot point?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="09-foot"
x, y, rho, alpha, e_x, e_y = sp.symbols("x y rho alpha e_x e_y", real=True)
n = sp.Matrix([sp.cos(alpha), sp.sin(alpha)])
n_along = sp.Matrix([-sp.sin(alpha), sp.cos(alpha)])
position, e = sp.Matrix([x, y]), sp.Matrix([e_x, e_y])
measured = rho - n.dot(position)  # (09.1): from where the robot really is
foot = (measured + n.dot(position + e)) * n  # (09.2): from its estimated position
moved = sp.simplify(foot - rho * n)
sp.simplify(n.dot(moved)), sp.simplify(n_along.dot(moved))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="09-foot"
# The error of the computed foot point is the component of $e$ across the wall; along the wall it is zero:
#
# $$ \text{foot} - \rho\, n = (n^{\mathsf T} e)\, n. \tag{09.5} $$
#
# Across the wall its error equals that of the robot, so relative to the robot the wall is at the
# measured $\rho'$: this component is a real measurement. Along the wall the foot point agrees with the
# predicted one for every error $e$. **So along the wall the foot point always confirms the filter's
# estimate.** The update assumes that the sensor's noise is independent of the state's error, but here
# it is not.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** A robot at $(4, 0.3)$ with heading 0 measures the wall in the picture, at $\rho' = 1.7$
# m and $\alpha' = 90°$. The position estimated by its filter has the error `e_position`. By how much
# does the foot point move? Give an array of two numbers, in metres.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
n_wall, e_position = np.array([0.0, 1.0]), np.array([0.1, 0.05])
foot_moved = ...  # by (09.5)
compare(foot_moved, corridor.foot_points(models.g_line([4.1, 0.35, 0], [1.7, np.pi / 2])) - [0, 2])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# n_wall, e_position = np.array([0.0, 1.0]), np.array([0.1, 0.05])
# foot_moved = (n_wall @ e_position) * n_wall
# ```
#
# The error of 10 cm along the wall has no effect.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## A corridor without ends
#
# A long corridor shows the effect clearly. It has two walls, left and right, and no scan depends on the
# robot's position along the corridor. So this direction is **unobservable** from the walls (also
# *degenerate*). The robot drives 10 m in 100 steps.

# %% slideshow={"slide_type": "fragment"}
ask(
    "09-corridor",
    "Each of the 100 steps slips by $\\sigma = 1$ cm, independently. What σ along the corridor should "
    "a consistent filter have at the end?",
    right=10.0,
    tolerance=1.0,
    unit="cm",
    reason="variances add up: 100 times 1 cm² is 100 cm². The walls give no information along the corridor.",
    wrong={
        100.0: "this would be the sum of 100 slips in the same direction; for independent "
        "slips, the variances add up.",
        1.0: "this is the σ of one step. Which wall could correct the other steps?",
        0.0: "the walls determine the position across the corridor, but not along it.",
    },
)


# %% slideshow={"slide_type": "fragment"} answers="09-corridor" tags=["folded"]
runs_in_corridor = cache(corridor.simulate_runs)  # each of 15 runs, lines or foot points
line_runs, foot_runs = (runs_in_corridor(15, measured, 0.01, False) for measured in (True, False))
at_the_end = runs_in_corridor(15, False, 0.01, True)


def in_the_corridor(slip_in_cm, wall_at_the_end):
    shown = {"(ρ, α)": ("corrected", True), "foot points": ("naive", False)}
    driven, colours = np.arange(1, 101) / 10, views.COLOURS
    fig, ax = views.chart("driven [m]", "error and σ along the corridor [cm]", None, (9, 4.8))
    for name, (role, measured) in shown.items():
        runs = runs_in_corridor(15, measured, slip_in_cm / 100, wall_at_the_end)
        ax.plot(driven, 100 * runs.errors, color=colours[role], label=f"{name}: RMS error")
        ax.plot(
            driven, 100 * runs.claimed, "--", color=colours[role], label=f"{name}: σ of the filter"
        )
    ax.plot(
        driven, 100 * runs.wheels, "-.", color=colours["limit"], label="odometry alone: RMS error"
    )
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"} answers="09-corridor"
views.explore(
    in_the_corridor,
    lambda slip_in_cm, wall_at_the_end: (
        f"The wheels slip {slip_in_cm:.1f} cm per step. With lines, error and σ grow together; "
        "with foot points σ stays near zero while the error grows."
    ),
    slip_in_cm=(0.2, 3.0, 1.0),
    wall_at_the_end=False,
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="09-corridor"
# With $(\rho, \alpha)$ the RMS error and $\sigma$ grow together, like the error of odometry: they are
# {= 100 * line_runs.errors[-1]:.0f =} and {= 100 * line_runs.claimed[-1]:.0f =} cm at the end. (These
# are only 15 runs; the expected error is 10 cm.) With foot points, the filter's $\sigma$ is
# {= 100 * foot_runs.claimed[-1]:.1f =} cm and its error {= 100 * foot_runs.errors[-1]:.0f =} cm. This
# error is larger than that of odometry alone, which is {= 100 * foot_runs.wheels[-1]:.0f =} cm. At
# every scan the foot points confirm the filter's own estimate, so $P$ shrinks without any information.
# The literature calls this *spurious information gain*; its result is an overconfident, inconsistent
# filter.
#
# Now add a wall at the end of the corridor. This wall reduces the error of both filters. With foot
# points the error is then {= 100 * at_the_end.errors[-1]:.1f =} cm, and $\sigma$ is still
# {= 100 * at_the_end.claimed[-1]:.1f =} cm.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Somebody will propose a larger $R$. A larger $R$ delays the overconfidence but
# does not prevent it: $R$ is the covariance of an error that is independent from scan to scan, and this
# error is not independent. Others propose a Jacobian of the foot point with respect to the sensor's
# measurement and the pose. This method is equivalent to $(\rho, \alpha)$.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Foot points in rooms
#
# Rooms have walls in more than one direction. Are foot points less harmful there? We simulated both
# tours with 60 seeds, and all estimators used the same readings.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Compare the columns of the median and of the worst run. In situation 1 a paper
# that reported only the median would call foot points an improvement over odometry.


# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"]
def in_words(size):
    """A NEES with three digits, or grouped where it has more."""
    return f"{size:.3g}" if size < 999.5 else views.grouped(round(size))


names = {
    "odometry": "odometry",
    "foot points, grown lines": "foot points",
    "(ρ, α), first estimates": "(ρ, α)",
}
rows = [
    "| situation | landmarks | error at the end, median | of the worst run | mean NEES |",
    "|---" * 5 + "|",
]
for situation, variants in many.items():
    for key, name in names.items():
        row = variants[key]
        lengths = [f"{100 * row[error]:.1f} cm" for error in ("final_m", "final_m_worst")]
        size = in_words(row["nees"]) if "nees" in row else ""
        rows.append(f"| {situation[-1]} | {name} | {' | '.join(lengths)} | {size} |")
Markdown("\n".join(rows))

# %% [markdown] slideshow={"slide_type": "subslide"}
# In situation 2, where walls in many directions surround the robot, the final error of runs with foot
# points is {= 100 * many["situation-2"]["foot points, grown lines"]["final_m"]:.0f =} cm in the median,
# which is far smaller than that of odometry. But the filter is overconfident: a NEES of
# {= many["situation-2"]["foot points, grown lines"]["nees"]:.0f =} means errors about
# {= np.sqrt(many["situation-2"]["foot points, grown lines"]["nees"] / 3):.0f =} times as large as $P$
# implies. In situation 1, with its corridor, the final error is
# {= 100 * many["situation-1"]["foot points, grown lines"]["final_m"]:.0f =} cm in the median run and
# {= many["situation-1"]["foot points, grown lines"]["final_m_worst"]:.1f =} m in the worst run; with
# odometry these errors are {= 100 * many["situation-1"]["odometry"]["final_m"]:.0f =} cm and
# {= many["situation-1"]["odometry"]["final_m_worst"]:.1f =} m. With foot points the error of the median
# run is smaller but that of the worst run is larger, and $P$ does not show this: the NEES is in the
# thousands.
#
# A map for human readers should show the points of the scans, not the walls. With $(\rho, \alpha)$ the
# RMS distance of the drawn points from the true walls is
# {= 100 * many["situation-1"]["(ρ, α), first estimates"]["map_m"]:.1f =} cm in situation 1; with the
# true poses it is {= 100 * many["situation-1"]["true poses"]["map_m"]:.1f =} cm. So the noise of the
# lidar is much larger than the effect of the pose errors.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Faults, one at a time
#
# Other faults seem less serious. We insert one fault at a time into the working system, and run it
# again. These are some of the faults:
#
# - **Degrees:** the state's angles are in degrees, and the Jacobians are those for radians.
# - **y = m x + c:** lines are fitted by ordinary least squares (08.1), which cannot produce a vertical line.
# - **Never merged:** pieces of one wall remain several landmarks.
# - **Associated before prediction:** the lines of the new scan are associated with the map as predicted
#   from the *old* pose; the motion is predicted afterwards.
# - **Placed before prediction:** new walls, too, are initialised from the old pose.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let each student write a ranking before the table appears. Most put the degrees
# first, because 57 is a large factor; ask which faults change $P$ only and which change the map.

# %% slideshow={"slide_type": "fragment"}
ask(
    "09-harm",
    "Which of these faults does the most harm to the robot's *position*?",
    {
        "degrees in the Jacobians": "this fault seems the worst, as lever arms are 57 times too "
        "long. But the innovation still has the right sign, and mainly P becomes wrong.",
        "y = m x + c": "lines with a large error fail the gate. The lines with a small error do "
        "the harm.",
        "pieces never merged": "their covariances are right, so the main disadvantage is a "
        "longer computing time.",
        "walls placed before prediction": "these walls are at wrong positions in the map. The "
        "map itself is wrong, and the robot is localised in it.",
    },
    right="walls placed before prediction",
)

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"] answers="09-harm"
tours = [faulty["situations"][name] for name in ("situation-1", "situation-2")]
rows = [
    "| fault | error, sit. 1 | NEES | walls | error, sit. 2 | NEES | walls |",
    "|---" * 7 + "|",
]
for name in tours[0]:
    cells = [
        f"{100 * t[name]['rms_m']:.1f} cm | {in_words(t[name]['nees']) if 'nees' in t[name] else ''} "
        f"| {t[name].get('walls', np.nan):.0f}"
        for t in tours
    ]
    shown_as = name.replace("a x + b", "m x + c")
    rows.append(f"| {shown_as} | {' | '.join(cells)} |".replace("nan", ""))
Markdown("\n".join(rows))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="09-harm"
# The table summarises {= MANY =} runs of both situations. It gives the median RMS error of the
# position, the median number of walls, and the mean NEES of the pose. If $P$ is right, the NEES is 3 on
# average, and the mean of so many independent values lies between {= faulty["band_95"][0]:.1f =} and
# {= faulty["band_95"][1]:.1f =} in 95 % of cases.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="09-harm"
# ### What the table shows
#
# With walls placed before prediction, the pose estimate diverges: its error is
# {= 100 * tours[1]["placed before prediction"]["rms_m"]:.0f =} cm in situation 2, where that of odometry is
# {= 100 * tours[1]["odometry"]["rms_m"]:.0f =} cm. With degrees the error is smaller than with odometry, but the NEES
# is {= tours[1]["degrees in the Jacobians"]["nees"]:.0f =}. So lines of true walls fail the gate and enter the map
# again: it has {= tours[1]["degrees in the Jacobians"]["walls"]:.0f =} walls instead of
# {= tours[1]["as it should be"]["walls"]:.0f =}.
#
# In this table a wrong Jacobian or a slightly wrong line does not make the pose estimate diverge. Such
# a fault makes $P$ wrong, and a wrong $P$ affects another part of the system: associations fail, and
# walls enter the map twice. A wall placed from the old pose has a more serious effect. No
# measurement was made from this pose, so the map itself is wrong, and each update fits the pose to the wrong map.
#
# The other rows have these faults. *Infinite lines*: the association ignores the ends of walls. *First
# found*: it uses the first wall within the gate, not the nearest. *New at first observation*: lines
# enter the map at once. *Windows, first observation*: in addition, a line is fitted only to the
# readings of a RANSAC window, not to all readings of the wall (lesson 08).


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def run_with_fault(fault, situation, observations, gate):
    """The system with one fault on the lines found before; its poses, their NEES and RMS error."""
    source = sources[situation]
    loop = wall_slam_faults.VARIANTS[fault](source)
    loop.tentative.min_observations, loop.gate, loop.ambiguity_gate = observations, gate, 4 * gate
    estimated, P, _ = wall_slam_faults.driven(source, loop, found[situation])
    errors = wall_slam_faults.errors(source, estimated)
    rms = 100 * np.sqrt(np.mean(np.sum(errors[:, :2] ** 2, axis=1)))
    return loop, estimated, nees(errors[10:], P[10:]).mean(), rms


def with_fault(fault, situation, **chosen):
    """The map and the trajectory of a system with one fault."""
    source = sources[situation]
    loop, estimated, mean_nees, rms = run_with_fault(fault, situation, **chosen)
    title = f"RMS error {rms:.1f} cm, NEES {in_words(mean_nees)}, {len(loop.mak.ids)} walls"
    truth = Segments("walls", source.world.outline()), Poses("truth", source.truth.poses)
    layers = [*truth, Segments("landmark", loop.segments()), Poses("corrected", estimated)]
    return views.side_by_side({title: layers}, size=(8, 4.8))[0]


own_lines = "y = a x + b", "windows, first observation"  # these find lines of their own
FAULTS = [name for name in reversed(wall_slam_faults.VARIANTS) if name not in own_lines]

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Try a fault yourself
#
# Choose a fault, and change the number of observations that confirms a wall, and the gate. Does a wider
# gate reduce the effect of any of these faults? Do more observations before the confirmation reduce it?

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
views.explore(
    with_fault,
    lambda fault, situation, observations, gate: (
        f"The map of {situation}, {fault}: landmarks in green over the grey walls, the estimated trajectory "
        "in blue over the true one in black."
    ),
    fault=FAULTS,
    situation=["situation-2", "situation-1"],
    observations=(1, 8, 3),
    gate=(2.0, 60.0, GATE),
)
by_gate = {
    gate: run_with_fault("degrees in the Jacobians", "situation-2", 3, gate)
    for gate in (GATE, 60.0)
}

# %% [markdown] slideshow={"slide_type": "fragment"}
# In the first picture each wall appears many times, and the blue trajectory deviates from the black
# one. With degrees in the Jacobians, a gate of 60 leaves {= len(by_gate[60.0][0].mak.ids) =} walls in
# the map of situation 2 and a NEES of {= by_gate[60.0][2]:.0f =}; the usual gate of {= GATE =} leaves
# {= len(by_gate[GATE][0].mak.ids) =} walls and a NEES of {= by_gate[GATE][2]:.0f =}. So a wider gate
# reduces the effect a little. But the fault is in $P$, and a gate cannot correct it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Prediction before association
#
# Why is the order so important? Between two scans this robot drives up to
# {= 100 * step_at_most[0]:.0f =} cm or turns by up to {= np.degrees(step_at_most[2]):.0f =}°. The
# sensor measures lines from the *current* pose.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Point at the two numbers of the output: no line is associated during the turns,
# yet the error at the end is small. Ask which figure would have shown the fault in a code review:
# none, but the share of associated lines does.

# %% slideshow={"slide_type": "fragment"}
ask(
    "09-order",
    "Lines are associated with the walls as predicted from the pose *before* the motion; all "
    "later steps are right. The robot turns by 17° from one scan to the next. What happens "
    "during this turn?",
    {
        "nothing: the update corrects what the association missed": "an update needs associated "
        "lines. A line without an association corrects nothing.",
        "most lines fit no wall, so only odometry is used": "their directions differ by 17° "
        "from all walls, far beyond the gate. They become tentative walls, and no update "
        "corrects the heading.",
        "lines are associated with the next wall around the corner": "walls of a room mostly "
        "meet at 90°, and a line with an error of 17° is near none of them.",
    },
    right="most lines fit no wall, so only odometry is used",
)

# %% slideshow={"slide_type": "subslide"} answers="09-order" tags=["folded"]
room, seen_lines = sources["situation-2"], found["situation-2"]
turning = np.array([abs(reading.odometry[2]) > 0.1 for reading in room])


def while_turning(make):
    """Share of the lines that are associated while the robot turns, and largest error of θ [°]."""
    loop, associated, update = make(room), [], make.update
    loop.update = lambda known: (associated.append(len(known)), update(loop, known))
    estimated, _, _ = wall_slam_faults.driven(room, loop, seen_lines)
    share = np.sum(np.array(associated)[turning]) / sum(
        len(seen_lines[k]) for k in np.flatnonzero(turning)
    )
    return share, np.degrees(np.abs(wall_slam_faults.errors(room, estimated)[:, 2]).max())


both = "as it should be", "associated before prediction"
shares = {name: while_turning(wall_slam_faults.VARIANTS[name]) for name in both}

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="09-order"
for name, (share, heading) in shares.items():
    print(f"{name:28} lines associated in turns: {100 * share:3.0f} %;", end=" ")
    print(f"heading off by up to {heading:.1f}°")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="09-order"
# While the robot turns, hardly any line is associated. When it drives straight on, lines are associated
# again and correct most of the error: the RMS error of the position is
# {= 100 * tours[1]["associated before prediction"]["rms_m"]:.1f =} cm instead of
# {= 100 * tours[1]["as it should be"]["rms_m"]:.1f =} cm. So a picture of the map would not show the
# fault. If walls are also *placed* before the motion is predicted, no update corrects the error.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Relocalisation after wheel slip
#
# Now we consider a fault of the robot: the wheels slip at a door sill, and the robot turns by 29°, but
# odometry does not measure this turn. Hardly any line fits the map any more, so the lines are
# initialised as new walls. **Relocalisation** finds the pose in the old map again. `WallSlam`, the
# library's version of the system, searches with a particle filter (lesson 11) around the estimated
# pose. When the scans fit the old map at the poses of the particles, the new walls are discarded, and
# the pose of the filter is set to the mean and covariance of the particles. How large is the position
# error at the end of situation 2, without relocalisation and with it?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask how a filter can notice the slip at all: its own innovations stay small,
# because it initialises new walls instead of updating old ones. The number of new walls in a known
# place is the symptom.


# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"]
def after_slip(slam, relocalise, turned=0.5):
    """Final position error [cm] and number of walls, when odometry misses a turn [rad]."""
    slam = deepcopy(slam)
    slam.relocalise = relocalise
    for k, reading in enumerate(readings[SLIP:]):
        if k == 0:
            reading = replace(reading, odometry=compose(reading.odometry, [0, 0, -turned]))
        slam.step(reading)
    error = 100 * np.hypot(*(slam.pose - room.truth.poses[-1])[:2])
    return error, len(slam.filter.ids)


SLIP, readings = 60, list(room)
before_slip = WallSlam(room.robot, room.sensor, np.random.default_rng(0))
for reading in readings[:SLIP]:
    before_slip.step(reading)
slipped = {relocalise: after_slip(before_slip, relocalise) for relocalise in (False, True)}
for relocalise, (error, count_of_walls) in slipped.items():
    how = "with" if relocalise else "without"
    print(
        f"{how:7} relocalisation: error at the end {error:5.1f} cm, {count_of_walls} walls in the map"
    )

# %% [markdown] slideshow={"slide_type": "fragment"}
# Without relocalisation the filter builds a second map over the first map, rotated relative to it. This
# relocalisation is local: it searches only within the distance that the wheels can slip in a short
# time. A robot that is carried elsewhere needs *global localisation* (lesson 11).

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Limits of line landmarks
#
# **Curved walls.** From each position, a few short lines are fitted to the near side of a round tower,
# and from the next position, different lines. These false measurements move around the tower as the
# robot passes it. For the filter, a landmark that moves with the robot is evidence that the robot
# stands still. Lesson 13 matches whole scans without landmarks.
#
# **Clutter.** People, bags and moving chairs cause lines that are observed only for a short time. Track
# management keeps these lines out of the map. But it does not reject a cart that stands still for a
# minute. The exercise has three such objects.
#
# **Other sensors.** `WallSlam` can use the lines of any sensor. In a *Deeper* section below, an
# ultrasonic sensor measures the walls of a room.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask for an environment in which this filter would fail at once: a forest, a
# round hall, a crowd. The section can be skipped if the exercise is discussed, since its three
# objects show the same.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# R. Smith, M. Self and P. Cheeseman, "Estimating uncertain spatial relationships in robotics", in
# *Autonomous Robot Vehicles*, Springer, 1990: EKF-SLAM.
#
# J. J. Leonard and H. F. Durrant-Whyte, *Directed Sonar Sensing for Mobile Robot Navigation*, Kluwer,
# 1992: walls from ultrasound, and regions of constant depth.
#
# J. A. Castellanos, J. M. M. Montiel, J. Neira and J. D. Tardós, "The SPmap: a probabilistic framework
# for simultaneous localization and map building", *IEEE Transactions on Robotics and Automation*
# 15(5), 1999: SLAM with the walls of a laser's scans.
#
# **Read next:** S. Thrun, W. Burgard and D. Fox, *Probabilistic Robotics*, MIT Press, 2005, chapter 10,
# on EKF-SLAM with unknown correspondences.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can run EKF-SLAM on the walls of a building, name the uncertain parameters of a line landmark,
# merge pieces of one wall, and search for the cause of a fault in the input of the filter.
#
# **What comes next:** [lesson 10](10_set_membership_slam.ipynb) estimates the state when only bounds of
# the errors are known, and no probabilities.
#
# The sections below this one are optional.
#
# **Exercise:** [09 · SLAM with walls: line landmarks](../exercises/ex09_slam_with_walls.ipynb). You initialise a
# wall, manage its track, merge two landmarks of one wall, compute where it ends, and build a map without false walls.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: thinning the points of a map
#
# The filter's map consists of a dozen lines. For human readers we draw the points of the scans, but
# there are too many of them. So the program draws a point only if its distance from every point drawn
# before is more than 60 mm. A direct implementation compares each new point with all points drawn so
# far. With a grid of cells 60 mm wide it is enough to search nine cells: the cell of the point and the
# eight around it.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask why three points fit into a cell, and not four: points in the four corners
# are exactly 60 mm apart, and the rule asks for more.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
thinned = DownsampledPoints(0.06)
for points, pose in zip(scans["situation-2"], room.truth.poses, strict=True):
    thinned.add(transform(pose, points))
offered = sum(map(len, scans["situation-2"]))
most = np.unique(np.floor(thinned.xy / 0.06), axis=0, return_counts=True)[1].max()
print(f"{views.grouped(offered)} points offered, {len(thinned.xy)} drawn, at most {most} in a cell")

# %% [markdown] slideshow={"slide_type": "fragment"}
# A cell of 60 mm can contain at most three points if any two of them are more than 60 mm apart. So a
# new point needs at most 27 comparisons for a map of any size; here it needs at most {= 9 * most =}
# instead of {= len(thinned.xy) =}.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the covariance after selecting inliers
#
# RANSAC *selects* a line's readings: those within $c = 2.8\,\sigma$ of the line that is fitted to them. Is
# $R = \big(\sum J^{\mathsf T} J / \sigma^2\big)^{-1}$ of lesson 08 still the covariance of that line?
#
# Let the line have the error $e$, with all lengths in units of $\sigma$. The refit moves it by the mean of
# $\varepsilon - e$ over the readings in its band, and the band moves along with the line. Per
# reading, this correction is
#
# $$ \psi(e) = \int_{e - c}^{e + c} (\varepsilon - e)\,
# \varphi(\varepsilon)\, d\varepsilon, \tag{09.6} $$
#
# with the normal density $\varphi$. Its *gain* is the rate at which $-\psi$ grows with $e$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* For a class that knows M-estimators. The surprise is the sign: the band that
# follows the line makes the estimate less accurate than the number of inliers suggests.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
# the integral, its derivative, and the variance of a reading's contribution
c, noise, e = sp.symbols("c varepsilon e", positive=True)
density = sp.exp(-(noise**2) / 2) / sp.sqrt(2 * sp.pi)
psi = sp.integrate((noise - e) * density, (noise, e - c, e + c))
slope = sp.simplify(-sp.diff(psi, e).subs(e, 0))
variance = sp.simplify(sp.integrate(noise**2 * density, (noise, -c, c)))
share = sp.integrate(density, (noise, -c, c))
print("gain − variance of a reading's contribution:", sp.simplify(slope - variance))
factor = float((share / slope).subs(c, 2.8))
slope

# %% [markdown] slideshow={"slide_type": "fragment"}
# If the band did not move, the gain would be the share of readings in it, which is the second term. But
# the band moves with the line, so readings leave it on one side and enter it on the other. This reduces
# the gain. The variance of such an estimate (an *M-estimator*) is the variance of a reading's
# contribution divided by the squared gain. The cell above shows that the variance of the contribution
# equals the gain. So the true variance is 1/gain, whereas $R$ uses 1/share. The true variance is
# {= 100 * (factor - 1):.1f =} % larger, and the library multiplies $R$ by this factor.
#
# Is the result consistent? At true poses we compute the NEES of each line with its $R$. A line has two parameters, so
# the expected value is 2.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name in sources:
    sizes = line_extraction_errors.squared_errors(sources[name], found[name])
    mean, of_mean = sizes.mean(), sizes.std() / np.sqrt(len(sizes))
    print(
        f"{name}: NEES {mean:.2f} ± {of_mean:.2f}, without the factor {factor * mean:.2f};", end=" "
    )
    print(f"beyond the gate {100 * np.mean(sizes > GATE):.1f} % instead of 0.1 %")

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the factor, $R$ is correct to within a few percent. A likely cause of the remaining difference is
# that some lines include one or two readings of the adjacent wall at a corner. In one scan the effect
# is small. But such errors repeat, and the NEES of the map shows them.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a round tower
#
# A round tower of 1.5 m radius stands beside the robot's path. Move the robot, and observe which lines
# are found.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Move the robot slowly past the tower and let the class follow one green line: it
# moves along with the robot. Ask what an EKF concludes about the robot's motion.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def tower(robot_x):
    world, pose = World(circles=[(3.0, 2.0, 1.5)]), np.array([robot_x, -0.5, 0.0])
    rng = np.random.default_rng(2)
    flats = lines(THESIS_LIDAR.scan(world, pose, rng), THESIS_LIDAR.model, rng)
    ends = [transform(pose, line.ends) for line in flats]
    longer = [[*(1.5 * a - 0.5 * b), *(1.5 * b - 0.5 * a)] for a, b in ends]
    layers = (
        Segments("walls", world.outline()),
        Segments("landmark", longer),
        Poses("robot", [pose]),
    )
    fig, (ax,) = views.side_by_side({f"walls found: {len(flats)}": layers}, size=(8.5, 4.8))
    ax.set_aspect("equal", adjustable="box")
    ax.set(xlim=(-0.5, 6.5), ylim=(-0.8, 3.7))
    return fig


views.explore(
    tower,
    lambda robot_x: (
        f"From x = {robot_x:.1f} m, some straight lines touch the near side of a circle."
    ),
    robot_x=(0.0, 6.0, 1.5),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# From each position, different lines are found, and they move with the robot. Two solutions are a
# landmark model for round objects (a centre and a radius), and SLAM without landmarks, as in lesson 13.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: line landmarks from an ultrasonic sensor
#
# An ultrasonic sensor on a servo measures in 37 directions. In each direction it receives the echo of
# the nearest surface within a **cone** of 25° (lesson 02). Walls in its scans look curved. Can they
# still be landmarks?
#
# Consider one straight wall at the distance $\rho$, with its normal in the direction $\alpha$. Which
# range does a beam with the half opening angle $\delta$ measure in the direction $\beta$? As long as
# the cone contains the foot of the perpendicular from the robot, this foot is the nearest point.
# Otherwise the nearest point is the intersection of the cone's edge and the wall:
#
# $$ r(\beta) = \frac{\rho}{\cos u}, \qquad |u| = \max(0, |\beta - \alpha| - \delta). \tag{09.7} $$

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students take the flat arcs of the echoes for walls. Draw the cone at the board,
# and move it past the foot of the perpendicular: the range is constant as long as the foot is inside.

# %% slideshow={"slide_type": "subslide"}
SONAR, half_cone = ULTRASONIC.model, ULTRASONIC.model.half_cone
rho_1, alpha_1 = 1.5, np.radians(15)
one_wall = World(ends_of((rho_1, alpha_1), [[-1.6, 1.6]]).reshape(-1, 4))
echo = ULTRASONIC.scan(one_wall, np.zeros(3), np.random.default_rng(1))
fine = np.radians(np.linspace(-45, 75, 400))
by_cone = rho_1 / np.cos(np.maximum(np.abs(fine - alpha_1) - half_cone, 0))

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
shapes = {"a ray would measure": rho_1 / np.cos(fine - alpha_1), "a cone, (09.7)": by_cone}
fig, ax = views.curves(
    np.degrees(fine), shapes, "direction β of the beam [°]", "range [m]", size=(9, 4.6)
)
ax.plot(
    np.degrees(echo.angles),
    echo.ranges,
    "o",
    color=views.COLOURS["scan"],
    label="simulated readings",
)
ax.set(xlim=(-45, 75), ylim=(1.3, 2.6))
views.legend(ax, loc="upper center")
wide = 2 * np.degrees(half_cone)
views.show(
    fig,
    f"The range of a wall over the direction is constant for {wide:.0f} degrees and steep on "
    "both sides.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The flat piece is {= wide:.0f =}° wide at any distance: a *region of constant depth* (Leonard and
# Durrant-Whyte). We find the two unknowns by least squares, which needs the derivatives of (09.7)
# with respect to $\rho$ and $\alpha$. On the flat piece they are 1 and 0. Beyond it, where $\beta > \alpha + \delta$,
# they are

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
rho, alpha, beta, delta = sp.symbols("rho alpha beta delta", positive=True)
r = rho / sp.cos(beta - alpha - delta)
sp.Matrix([[sp.diff(r, rho), sp.simplify(sp.diff(r, alpha))]])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, width in (("flat piece alone", half_cone), ("10° more, either side", half_cone + 0.18)):
    near = np.abs(echo.angles - alpha_1) <= width
    _, R = fit_cone(echo.angles[near], echo.ranges[near], SONAR, alpha_1, rho_1)
    sigma = "infinite" if R is None else f"{np.degrees(np.sqrt(R[1, 1])):.1f}°"
    print(f"{name:22} {near.sum():2} readings: σ of α is {sigma}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The flat piece gives the distance, but no information on the direction. The rising pieces on both sides give the
# direction, so the fit includes them as far as they extend.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A room


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
sonar_run = simulation("room-ultrasonic", np.random.default_rng(4))
echoes = [reading.scan for reading in sonar_run]


def sonar_walls(step, least_rise_in_degrees):
    """The room, the echoes at a step of the run, and the walls fitted to them."""
    pose, scan = sonar_run.truth.poses[step], echoes[step]
    fitted = sonar_lines(scan, SONAR, np.radians(least_rise_in_degrees))
    layers = [
        Segments("walls", sonar_run.world.outline()),
        Points("scan", transform(pose, scan.points())),
        Segments("landmark", [transform(pose, line.ends).ravel() for line in fitted]),
        Poses("robot", [pose]),
    ]
    fig, (ax,) = views.side_by_side({f"walls found: {len(fitted)}": layers}, size=(8, 5.2))
    ax.lines[0].set_markersize(6)
    return fig


views.explore(
    sonar_walls,
    lambda step, least_rise_in_degrees: f"The room and arcs of echoes in it, at step {step}.",
    step=(0, len(echoes) - 1, 22),
    least_rise_in_degrees=(0, 30, 25),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The measured points deviate from the walls towards the robot, but the green line that is fitted to
# them lies on its wall. An edge or a table leg also causes a flat piece, but on both sides of it the
# range rises faster. So readings count as a wall only if they follow (09.7) over 25° beyond the flat
# piece. With a lower limit, some lines lie on no wall.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What the limit of 25° gains
#
# Guess first: without any limit, which share of the lines lies on no wall?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# false lines by the least rise, and echoes by the angle of incidence
sound = stored("ultrasound_walls")
print(f"{sound['seeds'][1] + 1} runs, at true poses")
for row in sound["slopes"]:
    wrong = row["no_wall"] / row["lines"]
    print(
        f"at least {row['degrees']:2}° of rise: {row['lines']:4} lines, {100 * wrong:4.1f} % on no wall"
    )
print("a smooth wall reflects the sound away at large angles of incidence")
for row in sound["incidences"]:
    counts = f"{views.grouped(row['echoes'])} echoes, {row['lines']:4} lines"
    print(f"echoes up to {row['degrees']:2}° of incidence: {counts}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Without the limit nearly every fifth line is a false measurement. With the limit, a little more than
# half of the lines remain, and nearly all of them are correct. Smooth walls are another limitation: if
# the sensor receives only echoes at up to 10° of incidence, only flat pieces remain, and these give no
# direction.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### SLAM with the ultrasonic sensor
#
# `WallSlam` can use these lines without any change. For comparison we run it with a sensor model
# without the cone, so that RANSAC treats the echoes as points on walls. Guess first: which has the
# largest error, odometry alone, RANSAC or the cone model?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# odometry, RANSAC's lines and the cone model: medians over the runs
rows = ["| landmarks | RMS error | more than odometry | better in |", "|---" * 4 + "|"]
runs_of_it = sound["seeds"][1] + 1
for name, row in sound["drives"].items():
    more = "{:+.0f} cm ({:+.0f} to {:+.0f})".format(
        *(100 * row[key] for key in ("more_m", "low_m", "high_m"))
    )
    more = "" if name == "odometry" else f"{more} | {row['better']:.0f} of {runs_of_it}"
    rows.append(f"| {name} | {100 * row['rms_m']:.0f} cm | {more or ' | '} |")
Markdown("\n".join(rows))

# %% [markdown] slideshow={"slide_type": "fragment"}
# (The table shows medians over {= runs_of_it =} runs, with 95 % intervals; the third column is the
# median of the paired differences.) RANSAC (*lidar's lines* in the table) finds many lines, which
# follow the curved arcs of echoes. These lines move with the robot and make the pose less accurate than
# that of odometry. The cone model finds about {= sound["drives"]["cone model"]["walls"]:.0f =} walls,
# and its error is {= -100 * sound["drives"]["cone model"]["more_m"]:.0f =} cm smaller than that of
# odometry in the median.
#
# Is the filter with the cone model consistent? The wheels of this robot have permanently different
# radii, and at the last of five times the mean NEES is {= sound["nees"]["cone model"][-1]:.1f =}, above
# the band of {= sound["band_95"][0]:.1f =} to {= sound["band_95"][1]:.1f =}. If the wheels only slip at
# random, the mean NEES is {= sound["nees"]["cone model, wheels slip"][-1]:.1f =}. So most of the
# inconsistency comes from the odometry model.
#
# Even then the NEES is {= max(sound["nees"]["cone model, wheels slip"]):.1f =} at one of these times,
# just after a turn. This value is a little above the band. The noise model is correct in this case, but
# an uncertain heading spreads the positions along an arc, and a Gaussian in $x$, $y$ cannot represent
# an arc. Measured along arcs, the largest of the five values is
# {= max(sound["nees_along_arcs"]["cone model, wheels slip"]):.1f =} (`evaluation.pose_nees`).
