# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 00 · Start here
#
# **Afterwards you will be able to** run a lesson, predict a result before you run its cell, move the
# sliders, complete the cells called *Your turn*, check an exercise, read the symbols and units of
# the first lessons, and get help.
#
# **20 minutes.** You need no earlier lesson. Some Python and school trigonometry are helpful.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* let everybody run the set-up check before the class begins. The most important thing here
# is the habit of predicting: everybody writes down a number before running a cell.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Is everything installed?
#
# Click into the next cell and press **Shift+Enter**: the cell runs, and the next cell is selected.
# The cell looks for Python and for every package that the course needs. If a package is missing, the cell
# prints what to do.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-is-everything-installed"
# *For the lecturer:* Most failures come from a JupyterLab that was not started by `python lab.py`. Ask
# everybody to raise a hand when all lines have a tick, and begin only then.

# %% name="setup-check"
from classroom.checks import setup_check

setup_check.report()

# %% [markdown]
# If every line has a tick, continue. If you see `No module named 'slamlab'`, this notebook does not use the
# Python of the course. Close the notebook, run `python lab.py` in the folder of the project, and open the
# notebook in the JupyterLab that appears.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## How a lesson works
#
# Most sections have the same steps: a **question**, your **prediction**, a cell to **run**, and an
# **explanation**. You learn most from the prediction. So make a prediction before you run a cell, even if you
# have to guess.
#
# Try it. A lidar stands in a room, turns once, and measures 400 distances, one every 0.9°. On average only one
# in 200 beams gets no return, because that beam meets a black or shiny surface. Run the next
# cell, type a number, and press *answer*.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-how-a-lesson-works"
# *For the lecturer:* Insist that everybody writes down a number before you run the cell. Ask why 397 is not a
# wrong prediction either: the number of lost beams is random, with a standard deviation of $\sqrt 2$.

# %% name="ask-beams"
from classroom.checks import ask, compare

ask(
    "00-beams",
    "**How many of the 400 beams have a return?**",
    right=398,
    tolerance=2,
    unit="beams",
    reason="on average one beam in 200 is lost, which is 2 of 400. The number in a single scan "
    "is random.",
    wrong={
        380: "this would be one lost beam in 20, not in 200.",
        200: "a lidar that lost half of them would be broken: a room has walls on all sides.",
    },
)

# %% slideshow={"slide_type": "fragment"} name="first-scan" answers="00-beams" tags=["nbval-check-output"]
import numpy as np

from slamlab import views
from slamlab.geometry import transform
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import RPLIDAR_A2, worlds

rng = np.random.default_rng(7)
room, pose = worlds.room(), np.array([1.0, 0.0, 0.5])
scan = RPLIDAR_A2.scan(room, pose, rng)
print(f"{scan.valid.sum()} of {len(scan.ranges)} beams came back")

# %% [markdown] slideshow={"slide_type": "fragment"}
# This lidar is simulated. It loses beams about as often as the real lidar of lesson 02. All random numbers in
# the course come from a generator `rng` whose seed is written in the cell, so you get the number that is printed
# here. With a seed other than 7 you may get a different number.
#
# The next question has choices. The cell below it contains the answer and is folded: it opens when you
# have chosen an answer, or when you click on its dots.

# %% slideshow={"slide_type": "subslide"} name="ask-missing"
ask(
    "00-missing",
    "The lidar measures in every direction. **Which parts of the room will be missing from the "
    "picture?**",
    {
        "what is far away": "in a room, far walls return the beam as well as near ones.",
        "what stands behind something": "a beam ends where it first meets a surface.",
        "nothing: it turns all round": "the lidar does turn all round, but its beams do not pass "
        "through a table.",
    },
    right="what stands behind something",
)

# %% slideshow={"slide_type": "fragment"} name="first-picture" answers="00-missing"
fig, ax = views.axes("One revolution of the lidar in a room", size=(8, 5.4))
views.draw(ax, Segments("walls", room.outline()), lw=0.8)
views.draw(ax, Points("scan", transform(pose, scan.points())))
views.draw(ax, Poses("robot", pose))
views.legend(ax, loc="upper right")
views.show(
    fig, alt="Walls of a room in grey; the points of a scan lie on the walls that face the lidar."
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="00-missing"
# The points lie on the surfaces that face the lidar. No points lie behind the table in the middle, the
# cupboards and the pillars: **a scan never contains the whole room, only what can be seen
# from one position**. To map the whole room, a robot has to drive, and it has to know where it took
# each scan.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Sliders
#
# Many figures have sliders. Drag a slider, or click on it and use the arrow keys. When you release the slider,
# the figure is drawn again. (If the sliders of a figure are missing, run its cell.)
#
# Predict before you drag: from which position can the lidar measure the cupboard at the left wall?


# %% name="first-slider"
# draw the room, and the scan of a lidar at x, y
def look(x, y):
    """The room, and the scan of a lidar at x, y."""
    seen = RPLIDAR_A2.scan(room, [x, y, 0.0], np.random.default_rng(7))
    fig, ax = views.axes(f"Scan taken at ({x:.1f} m, {y:.1f} m)", size=(8, 5.4))
    views.draw(ax, Segments("walls", room.outline()), lw=0.8)
    views.draw(ax, Points("scan", transform([x, y, 0.0], seen.points())))
    views.draw(ax, Poses("robot", np.array([x, y, 0.0])))
    views.legend(ax, loc="upper right")
    return fig


# %% name="first-slider-picture"
views.explore(
    look,
    alt="From the right of the room the table hides the cupboard at the left; sliders move the "
    "lidar.",
    x=(-1.2, 5.2, 3.6),
    y=(-1.4, 2.2, 0.9),
)

# %% [markdown]
# From this position, the table in the middle hides much of the left wall, and no point lies on the cupboard.
# Move the lidar past the table, to the left or to the top, and the front of the cupboard appears.
#
# If the results of a notebook are wrong because its cells ran out of order, choose *Kernel → Restart Kernel and
# Run All Cells*. To restore the original notebook, type `slamlab reset lesson-00` in a terminal (*File
# → New → Terminal*). The command keeps your own version in a file beside the original one.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## How an exercise works
#
# Every lesson from 01 on has an exercise. You write functions, and below each of them is a cell
# such as `check("01-next-pose")`. The check calls your function with random inputs, and with edge
# cases that the text allows. It tests whether the results obey **laws**. For example, a robot must move exactly
# the length of its step. So every correct solution passes, however it is written.
#
# If a law is broken, you see the smallest input that breaks it, what your function returned, and
# what the law requires. If the check recognises a mistake, it reports this.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-how-an-exercise-works"
# *For the lecturer:* Show one failing check in exercise 01: change a sign in a function, and read the report
# of the check aloud. If time is short, skip the second slide.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Checks, hints, points
#
# - Run `hint("01-next-pose")` in a cell of your own. The first hint asks a question that helps you to continue.
#   The next hint shows an intermediate step.
# - Run checks and ask for hints as often as you like: the course does not count them. Your points come
#   from a fresh run of the checks with other random inputs, and no other part of the checks is hidden.
# - One law holds for all functions: a function must not change its input arrays.
# - In a terminal, `slamlab check NOTEBOOK` checks a whole notebook, and `slamlab reset 01` restores
#   exercise 01 as it was.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Conventions
#
# | what | here | not |
# | --- | --- | --- |
# | lengths | metres | millimetres, centimetres |
# | angles | radians, from −π to π | degrees (only in text and on axes) |
# | rotation | counter-clockwise is positive | clockwise, as many devices count |
# | robot frame | x ahead, y to the left | y ahead |
# | points | one per row, `(n, 2)` | one per column |
#
# Devices and files use other units. The program converts these units once, where it reads the data.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-conventions"
# *For the lecturer:* Let everybody point with an arm: ahead is $x$, to the left is $y$, and a positive turn
# goes to the left. Students who know compasses or computer graphics expect clockwise angles.

# %% slideshow={"slide_type": "subslide"} name="frames"
views.show(
    views.frames(pose=np.array([2.5, 1.0, np.radians(25)]), landmark=np.array([5.0, 4.5])),
    alt="World and robot frames; heading θ from the world's x axis, bearing β from the robot's.",
)

# %% [markdown]
# Positions of landmarks are given in the *world frame*, which does not move. The lidar measures in the
# *robot frame*, which moves with the robot. The **heading** $\theta$ is the angle from the $x$ axis of the
# world frame to that of the robot frame. The **bearing** $\beta$ is the angle from the $x$ axis of the
# robot frame to the landmark. Both angles are counted counter-clockwise, so in the world frame the landmark lies in
# the direction $\theta + \beta$, at a distance $r$, the **range**.

# %% slideshow={"slide_type": "subslide"} name="ask-turn"
ask(
    "00-turn",
    "The robot turns on the spot by +90°. **How does the bearing $\\beta$ of the landmark "
    "change?**",
    {
        "it grows by 90°": "the heading grows; the landmark stays where it is, and the robot "
        "turns past it.",
        "it shrinks by 90°": "θ + β, the direction in the world frame, does not change.",
        "it stays": "the bearing would stay the same if the landmark turned along with the robot.",
    },
    right="it shrinks by 90°",
)

# %% slideshow={"slide_type": "fragment"} name="turn-on-the-spot" answers="00-turn" tags=["nbval-check-output"]
from slamlab import models

landmark = np.array([5.0, 4.5])
for theta in (25, 115):
    r, beta = models.h(np.array([2.5, 1.0, np.radians(theta)]), landmark)
    print(f"θ = {theta:3d}°   r = {r:.2f} m   β = {np.degrees(beta):6.1f}°")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="00-turn"
# The bearing decreases by as much as the heading increases, and the range does not change. A robot
# whose heading is wrong therefore computes a wrong direction in the world frame for **everything**
# that it measures. Lesson 01 starts from this fact.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Your turn
#
# Some cells contain three dots. Replace them with your own expression, then run the cell:
# the last line of the cell compares your value with the right value. Below the cell you can open the answer.

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Your turn.** The robot above has turned to a heading of 115°. In which direction of the world frame
# does the landmark lie? Compute it in degrees, from 115 and the variable `beta` of the cell above,
# which is in radians.

# %% slideshow={"slide_type": "fragment"} name="your-first-turn" tags=["your-turn"]
direction = ...  # in degrees
compare(direction, np.degrees(np.arctan2(4.5 - 1.0, 5.0 - 2.5)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# direction = 115 + np.degrees(beta)
# ```
#
# This is θ + β = 54.5°, the same direction as before the turn. The last line of the cell computes the right
# value from the two positions.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1 name="first-notation"
# ## The symbols of the first lessons
#
# Names in the code are the symbols of the text.
#
# | Symbol | In the code | What it is |
# | --- | --- | --- |
# | $x$ | `x` | pose of the robot: $x$, $y$, $\theta$ |
# | $a$, $b$ | `a`, `b` | any two poses |
# | $a \oplus b$ | `geometry.compose(a, b)` | pose $b$, which is given relative to $a$, in the frame in which $a$ is given |
# | $\ominus a \oplus b$ | `geometry.between(a, b)` | pose $b$ relative to pose $a$ |
# | $\mathrm{Rot}(\theta)$ | | the matrix that rotates a vector by $\theta$ |
# | $r$, $\beta$ | `r`, `beta` | range and bearing of a measured point |
# | $\sigma$ | | a standard deviation; $\sigma^2$ is the variance |
#
# Every lesson explains its symbols where it uses them first. Some letters have several meanings, as in
# the literature: $x$ is the pose and also its first coordinate. The appendix
# [Notation](notation.ipynb) lists the symbols and these letters, and the appendix
# [Glossary](glossary.ipynb) lists the terms. With the cursor after a name in a cell, **Shift+Tab**
# shows its documentation.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-symbols-of-the-first-lessons"
# *For the lecturer:* Do not read the table aloud. Let two students act out $a \oplus b$, and ask in whose
# frame $b$ is given.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2 name="map-of-lessons"
# ## Map of the lessons
#
# | no. | lesson | subject | time of the lesson | of the exercise |
# | --- | --- | --- | --- | --- |
# | 00 | [Start here](00_start_here.ipynb) | how a lesson and an exercise work; frames, units and symbols | 20 min | |
# | 01 | [Why SLAM](01_why_slam.ipynb) | dead reckoning, drift, and why a map drawn from it is not consistent | 55 min | 60 min |
# | 02 | [Sensors, odometry and simulated worlds](02_sensors_and_worlds.ipynb) | ray casting, the noise and the likelihood of a range, and wheel odometry with its covariance | 80 min | 60 min |
# | 03 | [The Kalman filter](03_kalman_filter.ipynb) | the Kalman filter and the Bayes filter derived; the consistency of a filter tested, and its Q and R tuned | 105 min | 60 min |
# | 04 | [Motion and measurement models, Jacobians and the EKF](04_models_and_jacobians.ipynb) | how a robot moves and measures: models, Jacobians and covariance propagation, derived and tested; the EKF | 80 min | 60 min |
# | 05 | [Localisation and mapping, apart](05_localisation_and_mapping.ipynb) | EKF localisation in a known map, mapping with known poses, and why two EKFs in turn are not consistent | 60 min | 60 min |
# | 06 | [EKF-SLAM: the MAK filter](06_ekf_slam.ipynb) | robot and map in one EKF: every block of its covariance derived, and a loop closed | 60 min | 60 min |
# | 07 | [Correlations, consistency and cost of EKF-SLAM](07_correlations.ipynb) | why the correlations of robot and landmarks cannot be dropped, what they cost, and sparser alternatives | 90 min | 60 min |

# %% [markdown] slideshow={"slide_type": "notes"} name="note-map-of-the-lessons"
# *For the lecturer:* State which lessons your course uses and when. Lessons 03 to 06 build on each other, so
# none of these four can be left out.

# %% [markdown] slideshow={"slide_type": "subslide"} name="map-of-lessons-2"
# | no. | lesson | subject | time of the lesson | of the exercise |
# | --- | --- | --- | --- | --- |
# | 08 | [Landmarks from scans: feature extraction and data association](08_landmarks_from_scans.ipynb) | lines and corners extracted from a scan, and associated with the landmarks of the map | 85 min | 60 min |
# | 09 | [SLAM with walls: line landmarks](09_slam_with_walls.ipynb) | a whole EKF-SLAM system in two buildings; its faults, measured one at a time | 75 min | 60 min |
# | 10 | [Set-membership SLAM: the BOR filter](10_set_membership_slam.ipynb) | a filter that guarantees bounds instead of covariances, and the effect of one violated bound | 90 min | 60 min |
# | 11 | [Particle filters](11_particle_filters.ipynb) | a particle set represents a multimodal posterior; Monte Carlo localisation and FastSLAM | 90 min | 60 min |
# | 12 | [Three filters on one robot](12_three_filters.ipynb) | set-membership, Kalman and particle filters on the same logs, compared over eighty simulated runs | 97 min | 60 min |
# | 13 | [Scan matching: ICP](13_scan_matching.ipynb) | aligning two scans with unknown correspondences: ICP, its convergence and its covariance | 104 min | 60 min |
# | 14 | [Devices and live SLAM: RPLIDAR and eMIR](14_devices_and_live_slam.ipynb) | from the bytes of a lidar and a robot to a live map, with real devices or their emulators | 115 min | 60 min |
# | 15 | [Pose-graph SLAM: closing the loop](15_pose_graph_slam.ipynb) | pose graphs optimised, loop closures found and verified, false ones rejected; a real building | 98 min | 60 min |
# | 16 | [Your own SLAM: benchmarks and evaluation](16_your_own_slam.ipynb) | metrics, paired comparison, ablation and selection bias; the project that the course leads to | 60 min | 180 min |
#
# Read the lessons in the order of their numbers. The theses that this course follows contain errors; the
# appendix [In print](in_print.ipynb) lists them.

# %% [markdown] slideshow={"slide_type": "skip"} tags=["lecturer"]
# ## If you give the lecture
#
# Every lesson is also a set of slides, with live cells and sliders: press **Lecture** in the toolbar.
# Derivations appear line by line when you press a key, and the speaker's notes are in separate cells.
# [docs/lecturing.md](../docs/lecturing.md) lists the keys and describes how to rehearse.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## Your progress
#
# The course stores your answers and the results of your checks in the file `progress.json` beside the folders
# of the notebooks. The course does not send these data to any other computer. The head of each notebook shows
# your progress
# in its tasks and questions. The next cell shows your progress in all notebooks. The command `slamlab progress`
# in a terminal shows it, too.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-your-progress"
# *For the lecturer:* Students often ask whether the lecturer sees their answers. Nobody sees them before the
# students hand in a notebook.

# %% name="progress"
from classroom import coursework

coursework.show_progress()

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Help
#
# - **A function:** Shift+Tab after its name, or `help(name)`, shows its equation, and the shape and
#   unit of each argument.
# - **A check that fails:** read its first ✗ line, which names the broken law, then the case below it,
#   and call your function with that input yourself.
# - **A cell that fails:** the last line of the message names the error.
# - **Everything else:** read the `README.md` of the project, or ask the person who gave you the course.
#
# **What comes next:** [01 · Why SLAM](01_why_slam.ipynb). A robot drives around a corridor and returns
# to its start, but its map does not close.
