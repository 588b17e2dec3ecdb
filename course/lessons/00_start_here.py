# %% [markdown] slideshow={"slide_type": "slide"}
# # 00 · Start here
#
# **Afterwards you will be able to** run a lesson, predict before you run, move its sliders, check
# an exercise, read every symbol and unit of the course, and get help.
#
# 15 min. You need nothing before; a little Python and some school trigonometry help.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* run the set-up check before the class comes in. With *View → Presentation
# Mode* the letters grow. The one thing to get across here is the habit of predicting: let everybody
# write a number down before the first scan is run.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Is everything there?
#
# Click into the next cell and press **Shift+Enter**: the cell runs and the next one is selected. It
# looks at Python and at every package the course rests on, and says what to do where one is not
# right.

# %% name="setup-check"
from slamlab.checks import setup_check

setup_check.report()

# %% [markdown]
# A tick on every line: go on. If instead you see `ModuleNotFoundError: No module named 'slamlab'`,
# the notebook runs on another Python than the course's: close it, run `make lab` in the project's
# folder (Windows: `python lab.py`), and open it in the JupyterLab that comes up.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## How a lesson works
#
# Each section goes the same way: a **question**, your **prediction**, a cell to **run**, an
# **explanation**. The prediction is the part that teaches: write it down before you run, even if it
# is a guess. A cell that is run without a prediction is a film.
#
# Try it. A lidar turns once in a room and measures 400 distances, 0.9° apart. It is a good one, but
# now and then a beam gets lost on something black or shiny.
#
# The next cell asks for your prediction. Run it, type a number, press *answer*: you are told why it
# is right or what you may have thought of. Then run the cell after it and see.

# %% name="ask-beams"
from slamlab.checks import ask

ask(
    "00-beams",
    "**Predict:** how many of the 400 beams come back?",
    right=398,
    tolerance=1.5,
    unit="beams",
    reason="of the surfaces in front of it a good lidar misses fewer than one in a hundred.",
    wrong={
        400: "all of them would be a perfect lidar; a beam gets lost now and then.",
        200: "half of them would be a broken lidar: a room has walls on all sides.",
    },
)

# %% name="first-scan" tags=["nbval-check-output"]
import numpy as np

from slamlab import views, worlds
from slamlab.geometry import transform
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import RPLIDAR_A2

rng = np.random.default_rng(7)
room, pose = worlds.room(), np.array([1.0, 0.0, 0.5])
scan = RPLIDAR_A2.scan(room, pose, rng)
print(f"{scan.valid.sum()} of {len(scan.ranges)} beams came back")

# %% [markdown]
# Of the surfaces in front of it a real lidar of this kind misses fewer than one in a hundred: that
# was measured (lesson 02), and the simulated one does the same. Everything random in the course
# comes from a generator `rng` with a written-down seed, so you get the number printed here. Change
# the 7 and you get another one.
#
# A prediction may also be a choice. The picture that answers this one is folded until you have
# chosen, or ask to see it: a click on the dots below its cell opens it, too.

# %% name="ask-missing"
ask(
    "00-missing",
    "**Predict:** the lidar sees in every direction. Which parts of the room will be missing from "
    "the picture?",
    {
        "what is far away": "walls twelve metres off come back as well as those at one metre.",
        "what stands behind something": "a beam ends where it first meets a surface.",
        "nothing: it turns all round": "it turns all round, but it does not see through a table.",
    },
    right="what stands behind something",
)

# %% name="first-picture" answers="00-missing"
fig, ax = views.axes("One turn of the lidar in a room")
views.draw(ax, Segments("walls", room.outline()), lw=0.8)
views.draw(ax, Points("scan", transform(pose, scan.points())))
views.draw(ax, Poses("robot", pose))
views.legend(ax, loc="upper right")
views.show(fig, alt="Walls of a room in grey; a scan's points lie on those that face the lidar.")

# %% [markdown]
# The points lie on what faces the lidar. Behind the table in the middle, the cupboards and the
# pillars there is nothing: **a scan is never the room, it is what one place sees of it**. That is
# why a robot has to drive, and why it has to know where it was.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Sliders
#
# Many figures have sliders. Drag one, or click on it and use the arrow keys; the figure is drawn
# when you let go. In a notebook that was not run you see the figure without its sliders: run the
# cell. **Predict:** where must the lidar stand to see the cupboard at the left wall?


# %% name="first-slider"
def look(x, y):
    """The room and what a lidar at x, y sees of it."""
    seen = RPLIDAR_A2.scan(room, [x, y, 0.0], np.random.default_rng(7))
    fig, ax = views.axes(f"Seen from ({x:.1f} m, {y:.1f} m)")
    views.draw(ax, Segments("walls", room.outline()), lw=0.8)
    views.draw(ax, Points("scan", transform([x, y, 0.0], seen.points())))
    views.draw(ax, Poses("robot", np.array([x, y, 0.0])))
    return fig


views.explore(
    look,
    alt="From the right of the room the table hides the left of it; sliders move the lidar.",
    x=(-1.2, 5.2, 3.6),
    y=(-1.4, 2.2, 0.9),
)

# %% [markdown]
# From here the table in the middle hides the left of the room: not one point lies on the cupboard.
# Move the lidar past the table, to the left or to the top, and the cupboard's front appears.
#
# When a notebook gets muddled, because cells ran out of order, choose *Kernel → Restart Kernel and
# Run All Cells*. Nothing can be broken: `slamlab reset lesson-00` in a terminal (*File → New →
# Terminal*) brings this lesson back as it was handed out, `slamlab reset 04` exercise 04, and
# `slamlab reset 04-camera` one of its tasks. What you had written is kept in a file beside it.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## How an exercise works
#
# At the end of each lesson you find its exercise. You fill in functions; below each stands a cell
# such as `check("01-next-pose")`. It tries your function on random inputs, and on inputs at the edge
# of what the text promises, and judges it by **laws**: a robot must move as far as its step is long,
# a derivative must be what finite differences say. So any right solution passes, however it is
# written.
#
# Where a law is broken you see the smallest input that breaks it, with what your function returned
# and what the law wants. Where a classic mistake is recognised, you are told which one: degrees for
# radians, a turn the wrong way, a transposed matrix. `hint("01-next-pose")` in a cell of your own asks
# a question that leads on; called again, it shows a step on the way. One law holds everywhere: a
# function leaves the arrays it is given as they are.
#
# Check, and ask for hints, as often as you like; nobody counts. Your points are those of a fresh run on other random inputs; nothing
# else is hidden. `slamlab check NOTEBOOK` in a terminal does the same for a whole notebook.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Conventions
#
# | | here | not |
# | --- | --- | --- |
# | lengths | metres | millimetres, centimetres |
# | angles | radians, wrapped to (−π, π] | degrees (only in text and on axes) |
# | time | seconds | |
# | turning | counter-clockwise is positive | clockwise, as many devices count |
# | robot's frame | x ahead, y to the left | y ahead, as in the eMIR's documents |
# | points | one a row, `(n, 2)` | one a column |
# | matrices | act on columns: `p' = R p`; rows of points take `points @ R.T` | |
# | uncertainty | covariances, in units squared | standard deviations, unless it says so |
#
# Devices and files speak their own units. They are converted once, where they enter.

# %% name="frames"
views.show(
    views.frames(pose=np.array([2.5, 1.0, np.radians(25)]), landmark=np.array([5.0, 4.5])),
    alt="World and robot frames; heading θ from the world's x axis, bearing β from the robot's.",
)

# %% [markdown]
# The heading θ is measured from the world's x axis to the robot's, the bearing β from the robot's x
# axis to the landmark, both counter-clockwise. The landmark stands at angle θ + β as seen in the
# world.
#
# **Predict:** the robot turns on the spot by +90°. What becomes of θ, of β, of r?

# %% name="turn-on-the-spot" tags=["nbval-check-output"]
from slamlab import models

landmark = np.array([5.0, 4.5])
for theta in (25, 115):
    r, beta = models.h(np.array([2.5, 1.0, np.radians(theta)]), landmark)
    print(f"θ = {theta:3d}°   r = {r:.2f} m   β = {np.degrees(beta):6.1f}°")

# %% [markdown]
# The bearing loses what the heading gains, the range does not care. A robot that misjudges its
# heading therefore misjudges the direction of **everything** it sees. Remember that in lesson 01.

# %% [markdown] slideshow={"slide_type": "slide"} name="notation"
# ## Notation
#
# Names in the code are the symbols of the text. A row without a function is an argument of those
# with one. This table is tested: each function exists and returns that shape.
#
# | Symbol | In the code | Shape | Unit | What it is |
# | --- | --- | --- | --- | --- |
# | x | `x` | (3,) | m, m, rad | pose of the robot: x, y, θ |
# | u | `u` | (2,) | m, rad | control: distance d and turn Δθ; steered robot: speed V [m/s], angle γ [rad] |
# | p | `p` | (2,) | m | a landmark's position |
# | z | `z` | (2,) | m, rad | one observation: range r and bearing β |
# | a, b | `a`, `b` | (3,) | m, m, rad | any two poses |
# | l | `line` | (2,) | m, rad | a wall's line: its distance ρ from the origin, the direction α of its normal |
# | f | `models.f_odometry(x, u)` | (3,) | m, m, rad | motion: the pose after driving d and turning Δθ |
# | f | `models.f_steered(x, u, B, T)` | (3,) | m, m, rad | motion of a steered robot with wheel base B in time T |
# | h | `models.h(x, p)` | (2,) | m, rad | observation: range and bearing of a landmark |
# | g | `models.g(x, z)` | (2,) | m | the landmark that was observed: the inverse of h |
# | A | `jacobians.A_odometry(x, u)` | (3, 3) | | ∂f/∂x |
# | A | `jacobians.A_steered(x, u, B, T)` | (3, 3) | | ∂f/∂x of the steered robot |
# | W | `jacobians.W_odometry(x, u)` | (3, 2) | | ∂f/∂u |
# | W | `jacobians.W_steered(x, u, B, T)` | (3, 2) | | ∂f/∂u of the steered robot |
# | H | `jacobians.H_robot(x, p)` | (2, 3) | | ∂h/∂x, the robot's part of H |
# | H | `jacobians.H_landmark(x, p)` | (2, 2) | | ∂h/∂p, the landmark's part of H |
# | J_xr | `jacobians.J_xr(x, z)` | (2, 3) | | ∂g/∂x: a new landmark moves with the robot |
# | J_z | `jacobians.J_z(x, z)` | (2, 2) | | ∂g/∂z: a new landmark moves with its observation |
# | h | `models.h_line(x, line)` | (2,) | m, rad | distance and direction of a wall's line, seen from a pose |
# | g | `models.g_line(x, z)` | (2,) | m, rad | the line that was seen: the inverse of h |
# | H | `jacobians.H_robot_line(x, line)` | (2, 3) | | ∂h/∂x of a line |
# | H | `jacobians.H_line(x, line)` | (2, 2) | | ∂h/∂l of a line |
# | J_xr | `jacobians.J_xr_line(x, z)` | (2, 3) | | ∂g/∂x of a line |
# | J_z | `jacobians.J_z_line(x, z)` | (2, 2) | | ∂g/∂z of a line |
# | C | `noise.C_odometry(u, distance_error, turn_error)` | (2, 2) | m², rad² | covariance of the control |
# | C | `noise.C_wheels(u, slip, base)` | (2, 2) | m², rad² | the same of two wheels that slip at random |
# | Q | `noise.Q(W, C)` | (3, 3) | m², rad² | covariance a motion adds to the pose: W C Wᵀ |
# | R | `noise.R(r, range_error, bearing_sigma)` | (2, 2) | m², rad² | covariance of one observation |
# | | `geometry.wrap(angle)` | () | rad | the same angle in (−π, π] |
# | a ⊕ b | `geometry.compose(a, b)` | (3,) | m, m, rad | pose b, given in a's frame, in the frame a is given in |
# | ⊖ a | `geometry.inverse(a)` | (3,) | m, m, rad | the pose that undoes a |
# | ⊖ a ⊕ b | `geometry.between(a, b)` | (3,) | m, m, rad | pose b as seen from pose a |
# | T | `geometry.matrix(a)` | (3, 3) | | homogeneous matrix of a pose |
# | | `geometry.from_matrix(T)` | (3,) | m, m, rad | the pose of a homogeneous matrix |
# | | `geometry.transform(a, points)` | (n, 2) | m | points (n, 2) of a's frame in the frame a is given in |
#
# A filter holds a belief `b` of n numbers and takes in m measured ones (lesson 03 derives it); its
# update returns a new belief and a `step` that says what it was made of:
#
# | Symbol | In the code | Shape | What it is |
# | --- | --- | --- | --- |
# | x | `b.x` | (n,) | the mean: what is believed |
# | P | `b.P` | (n, n) | its covariance: how wrong that may be |
# | F, Q | `linear.predict(b, F, Q)` | (n, n) | time passes: x becomes F x, and noise of covariance Q is added |
# | H, R | `linear.update(b, z, H, R)` | (m, n), (m, m) | a measurement z of H x, with noise of covariance R |
# | v | `step.innovation` | (m,) | measured minus predicted: z − H x |
# | S | `step.S` | (m, m) | covariance of v: H P Hᵀ + R |
# | K | `step.K` | (n, m) | the gain: P Hᵀ S⁻¹; x grows by K v |
# | | `step.nis` | () | vᵀ S⁻¹ v: m on average while the filter is consistent |
#
# A graph of poses (lesson 15) holds edges z between poses i and j; its letters are those of its books,
# so H and b mean something else there:
#
# | Symbol | In the code | Shape | What it is |
# | --- | --- | --- | --- |
# | e | `edges.error(x_i, x_j, z)` | (3,) | how far pose j is from where pose i and z say it is |
# | A | `jacobians.J_i(x_i, x_j, z)` | (3, 3) | ∂e/∂x_i |
# | B | `jacobians.J_j(x_i, x_j, z)` | (3, 3) | ∂e/∂x_j |
#
# Put the cursor behind a name in any cell and press **Shift+Tab** to read what it does.

# %% [markdown] slideshow={"slide_type": "slide"} name="map-of-lessons"
# ## Map of the lessons
#
# | | lesson | what it shows | lesson | exercise |
# | --- | --- | --- | --- | --- |
# | 00 | [Start here](00_start_here.ipynb) | how all this works | 15 min | |
# | 01 | [Why SLAM](01_why_slam.ipynb) | a robot that believes its wheels draws a map that does not close | 40 min | 60 min |
# | 02 | [Sensors and worlds](02_sensors_and_worlds.ipynb) | how a lidar, an infrared and an ultrasonic scanner see a room, and how a real one errs | 60 min | 60 min |
# | 03 | [The Kalman filter](03_kalman_filter.ipynb) | predict, measure, correct: the gain derived, the filter's word about its own error tested | 60 min | 60 min |
# | 04 | [Models and Jacobians](04_models_and_jacobians.ipynb) | how a robot moves and measures, and how errors pass through: derived, not believed | 90 min | 60 min |
# | 05 | [Two easy halves](05_two_easy_halves.ipynb) | a known map locates the robot, known poses draw the map; both in turn is not SLAM | 50 min | 60 min |
# | 06 | [EKF-SLAM: the MAK filter](06_ekf_slam.ipynb) | robot and map in one filter, every block of its covariance built before your eyes | 80 min | 60 min |
# | 07 | [Correlations](07_correlations.ipynb) | why what robot and landmarks share cannot be dropped, what it costs, and ways out | 100 min | 60 min |
# | 08 | [Landmarks from scans](08_landmarks_from_scans.ipynb) | table legs, walls and corners found in a scan, and which of them were seen before | 75 min | 60 min |
# | 09 | [SLAM with walls](09_slam_with_walls.ipynb) | a whole thesis system, driven live through two buildings; its flaws measured and mended | 90 min | 60 min |
# | 10 | [Boxes](10_boxes.ipynb) | a filter that promises bounds, not likelihoods, and what one broken promise does | 90 min | 60 min |
# | 11 | [Samples](11_samples.ipynb) | a cloud of guesses that can say "here or there", which no ellipse can | 90 min | 60 min |
# | 12 | [Three filters, one robot](12_three_filters.ipynb) | box, ellipse and samples on the same three laps of a small robot, over eighty drives | 90 min | 60 min |
# | 13 | [Scan matching](13_scan_matching.ipynb) | laying one scan over another until it fits, though nobody knows which points belong together | 120 min | 60 min |
# | 14 | [The eMIR system](14_the_emir_system.ipynb) | from bytes on a wire to a live map: a real lidar and robot, or their emulators, driven by you | 110 min | 60 min |
# | 15 | [Closing the loop](15_closing_the_loop.ipynb) | a place seen again mends the whole map: a graph of poses, loops true and false, a real building | 100 min | 60 min |
#
# They are numbered in the order in which to read them.

# %% [markdown] slideshow={"slide_type": "skip"} tags=["lecturer"]
# ## If you give the lecture
#
# Every lesson is also a set of slides, with live cells and sliders; derivations open one line per
# key press, and speaker's notes stand in cells of their own. `python lab.py --lecture` adds the
# slideshow to JupyterLab; [docs/lecturing.md](../docs/lecturing.md) says which keys to press and
# how to see your notes. *View → Appearance → Presentation Mode* makes everything larger without it.

# %% [markdown]
# ## How far you are
#
# What you answer and check is kept in the file `progress.json` beside the folders of the notebooks,
# and nowhere else: nothing leaves your computer. The head of each notebook shows its own tasks and
# questions; the next cell, and `slamlab progress` in a terminal, show all of them.

# %% name="progress"
from slamlab import coursework

coursework.show_progress()

# %% [markdown]
# ## Where help is
#
# - **A function:** Shift+Tab behind its name, or `help(name)`. Every one says its equation, the shape and
#   the unit of each argument.
# - **A check that fails:** read its first ✗ line, which says what law broke, then the case below it:
#   try your function on that input by hand. `hint("…")` with the task's name leads on.
# - **A cell that fails:** the last line of the message says what went wrong; *Kernel → Restart Kernel
#   and Run All Cells* mends what came from cells run out of order.
# - **Everything else:** the `README.md` of the project, and who gave you the course.
#
# **What comes next:** [01 · Why SLAM](01_why_slam.ipynb). A robot drives round a corridor and comes
# home, but its map does not.

# %% [markdown] slideshow={"slide_type": "skip"}
# ## Appendix: the field's words
#
# The course speaks as the literature does. Each term stands with one sentence, the file of the package
# that does it, the lesson that teaches it and, where the sources of the course (or its first edition)
# have a word of their own, that word.
#
# {{glossary}}
