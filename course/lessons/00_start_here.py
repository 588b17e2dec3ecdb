# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 00 · Start here
#
# **Afterwards you will be able to** run a lesson, predict before you run, move its sliders, check
# an exercise, read the symbols and units of the first lessons, and get help.
#
# **20 minutes.** You need nothing before; a little Python and some school trigonometry help.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* let everybody run the set-up check before the class begins. The one thing to
# get across here is the habit of predicting: nobody runs a cell before a number is written down.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Is everything there?
#
# Click into the next cell and press **Shift+Enter**: the cell runs, and the next one is selected.
# It looks at Python and at every package that the course needs, and says what to do where something
# is missing.

# %% name="setup-check"
from slamlab.checks import setup_check

setup_check.report()

# %% [markdown]
# If everything has its tick, go on. If you see `No module named 'slamlab'`, this notebook runs
# on another Python than that of the course. Close it, run `python lab.py` in the folder of the
# project, and open it in the JupyterLab that comes up.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## How a lesson works
#
# Each section takes the same steps: a **question**, your **prediction**, a cell to **run**, an
# **explanation**. It is the prediction that teaches. Make one before you run, even if it is a
# guess: without it, you only watch.
#
# Try it. A lidar stands in a room, turns once, and measures 400 distances, one every 0.9°. It is a
# good lidar, but now and then a beam is lost on something black or shiny. Run the next cell, type a
# number, and press *answer*.

# %% name="ask-beams"
from slamlab.checks import ask

ask(
    "00-beams",
    "**How many of the 400 beams come back?**",
    right=398,
    tolerance=1.5,
    unit="beams",
    reason="of the surfaces in front of it a good lidar misses fewer than one in a hundred.",
    wrong={
        400: "all of them would be a perfect lidar; a beam gets lost now and then.",
        200: "half of them would be a broken lidar: a room has walls on all sides.",
    },
)

# %% slideshow={"slide_type": "fragment"} name="first-scan" answers="00-beams" tags=["nbval-check-output"]
import numpy as np

from slamlab import views, worlds
from slamlab.geometry import transform
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import RPLIDAR_A2

rng = np.random.default_rng(7)
room, pose = worlds.room(), np.array([1.0, 0.0, 0.5])
scan = RPLIDAR_A2.scan(room, pose, rng)
print(f"{scan.valid.sum()} of {len(scan.ranges)} beams came back")

# %% [markdown] slideshow={"slide_type": "fragment"}
# This lidar is simulated, with the losses of a real one. All random numbers in the course come from
# a generator `rng` whose seed is written in the cell, so you get the number that is printed here.
# With another seed than 7 you may get another one.
#
# The next question has choices. The cell below it, which answers it, is folded: it opens when you
# have chosen, or when you click on its dots.

# %% slideshow={"slide_type": "subslide"} name="ask-missing"
ask(
    "00-missing",
    "The lidar sees in every direction. **Which parts of the room will be missing from the picture?**",
    {
        "what is far away": "in a room, walls far away come back as well as near ones.",
        "what stands behind something": "a beam ends where it first meets a surface.",
        "nothing: it turns all round": "it turns all round, but it does not see through a table.",
    },
    right="what stands behind something",
)

# %% slideshow={"slide_type": "fragment"} name="first-picture" answers="00-missing"
fig, ax = views.axes("One turn of the lidar in a room", size=(8, 5.4))
views.draw(ax, Segments("walls", room.outline()), lw=0.8)
views.draw(ax, Points("scan", transform(pose, scan.points())))
views.draw(ax, Poses("robot", pose))
views.legend(ax, loc="upper right")
views.show(fig, alt="Walls of a room in grey; a scan's points lie on those that face the lidar.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="00-missing"
# The points lie on what faces the lidar. Behind the table in the middle, the cupboards and the
# pillars there is nothing: **a scan is never the whole room, only what can be seen of it from one
# place**. This is why a robot has to drive, and why it has to know where it took each scan.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Sliders
#
# Many figures have sliders. Drag one, or click on it and use the arrow keys; the figure is drawn
# anew when you let go. (Where you see a figure without its sliders, run its cell.)
#
# Before you drag: where must the lidar stand to see the cupboard at the left wall?


# %% name="first-slider"
def look(x, y):
    """The room and what a lidar at x, y sees of it."""
    seen = RPLIDAR_A2.scan(room, [x, y, 0.0], np.random.default_rng(7))
    fig, ax = views.axes(f"Seen from ({x:.1f} m, {y:.1f} m)", size=(8, 5.4))
    views.draw(ax, Segments("walls", room.outline()), lw=0.8)
    views.draw(ax, Points("scan", transform([x, y, 0.0], seen.points())))
    views.draw(ax, Poses("robot", np.array([x, y, 0.0])))
    return fig


# %% name="first-slider-picture"
views.explore(
    look,
    alt="From the right of the room the table hides the left of it; sliders move the lidar.",
    x=(-1.2, 5.2, 3.6),
    y=(-1.4, 2.2, 0.9),
)

# %% [markdown]
# From here the table in the middle hides the left of the room: not one point lies on the cupboard.
# Move the lidar past the table, to the left or to the top, and the front of the cupboard appears.
#
# If a notebook gets muddled because its cells ran out of order, choose *Kernel → Restart Kernel and
# Run All Cells*. And should you want it back as it was handed out, type `slamlab reset lesson-00`
# in a terminal (*File → New → Terminal*). What you had written is kept in a file beside it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## How an exercise works
#
# Every lesson from 01 on has an exercise. You write functions; below each of them stands a cell
# such as `check("01-next-pose")`. It tries your function on random inputs, and on inputs at the
# edges of what the text promises, and judges it by **laws**, such as: a robot moves exactly as far
# as its step is long. So every right solution passes, however it is written.
#
# Where a law is broken, you see the smallest input that breaks it, what your function returned, and
# what the law wants. If the mistake is a classic one, you are told which.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Checks, hints, points
#
# - `hint("01-next-pose")`, in a cell of your own, asks a question that leads on. Call it again, and
#   it shows a step on the way.
# - Check and ask for hints as often as you like: nobody counts. Your points come from a fresh run on
#   other random inputs, and nothing else is hidden.
# - One law holds everywhere: a function must not change the arrays that it is given.
# - In a terminal, `slamlab check NOTEBOOK` checks a whole notebook, and `slamlab reset 01` brings
#   exercise 01 back as it was.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Conventions
#
# | what | here | not |
# | --- | --- | --- |
# | lengths | metres | millimetres, centimetres |
# | angles | radians, from −π to π | degrees (only in text and on axes) |
# | turning | counter-clockwise is positive | clockwise, as many devices count |
# | robot's frame | x ahead, y to the left | y ahead |
# | points | one per row, `(n, 2)` | one per column |
#
# Devices and files use units of their own. These are converted once, where the data enter the
# program.

# %% slideshow={"slide_type": "subslide"} name="frames"
views.show(
    views.frames(pose=np.array([2.5, 1.0, np.radians(25)]), landmark=np.array([5.0, 4.5])),
    alt="World and robot frames; heading θ from the world's x axis, bearing β from the robot's.",
)

# %% [markdown]
# The **heading** $\theta$ leads from the world's x axis to the robot's. The **bearing** $\beta$
# leads from the robot's x axis to the landmark. Both are counter-clockwise, so in the world the
# landmark stands in the direction $\theta + \beta$.

# %% slideshow={"slide_type": "subslide"} name="ask-turn"
ask(
    "00-turn",
    "The robot turns on the spot by +90°. **What becomes of the bearing $\\beta$ of the landmark?**",
    {
        "it grows by 90°": "the heading grows; the landmark stays, and the robot turns past it.",
        "it shrinks by 90°": "θ + β, the direction in the world, stays what it was.",
        "it stays": "it would stay if the landmark turned along with the robot.",
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
# The bearing loses what the heading gains, and the range $r$ does not change. A robot that
# misjudges its heading therefore misjudges the direction of **everything** that it sees. Lesson 01
# starts from here.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1 name="first-notation"
# ## The symbols of the first lessons
#
# Names in the code are the symbols of the text, and a letter means the same in all lessons.
#
# | Symbol | In the code | What it is |
# | --- | --- | --- |
# | $x$ | `x` | pose of the robot: $x$, $y$, $\theta$ |
# | $a$, $b$ | `a`, `b` | any two poses |
# | $a \oplus b$ | `geometry.compose(a, b)` | pose $b$, which is given relative to $a$, in the frame in which $a$ is given |
# | $\ominus a \oplus b$ | `geometry.between(a, b)` | pose $b$ as seen from pose $a$ |
# | $\mathrm{Rot}(\theta)$ | | the matrix that rotates a vector by $\theta$ |
# | $r$, $\beta$ | `r`, `beta` | range and bearing of what is seen |
# | $\sigma$ | | a standard deviation; $\sigma^2$ is the variance |
#
# Later lessons explain their symbols where they use them. All of them stand in the
# [appendix](#Appendix:-notation). With the cursor behind a name in a cell, **Shift+Tab** shows what
# it does.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2 name="map-of-lessons"
# ## Map of the lessons
#
# | no. | lesson | what it shows | lesson | exercise |
# | --- | --- | --- | --- | --- |
# | 00 | [Start here](00_start_here.ipynb) | how all this works | 20 min | |
# | 01 | [Why SLAM](01_why_slam.ipynb) | a robot that believes its wheels draws a map that does not close | 45 min | 60 min |
# | 02 | [Sensors and worlds](02_sensors_and_worlds.ipynb) | how a lidar, an infrared and an ultrasonic scanner see a room, and how a real one errs | 60 min | 60 min |
# | 03 | [The Kalman filter](03_kalman_filter.ipynb) | predict, measure, correct: the gain derived, and what the filter says about its own error tested | 60 min | 60 min |
# | 04 | [Models and Jacobians](04_models_and_jacobians.ipynb) | how a robot moves and measures, and what becomes of a small error: derived, not taken on trust | 60 min | 60 min |
# | 05 | [Two easy halves](05_two_easy_halves.ipynb) | a known map locates the robot, and known poses draw the map, but doing both in turn is not SLAM | 50 min | 60 min |
# | 06 | [EKF-SLAM: the MAK filter](06_ekf_slam.ipynb) | robot and map in one filter, every block of its covariance built before your eyes | 60 min | 60 min |
# | 07 | [Correlations](07_correlations.ipynb) | why what robot and landmarks share cannot be dropped, what it costs, and ways out | 90 min | 60 min |

# %% [markdown] slideshow={"slide_type": "subslide"} name="map-of-lessons-2"
# | no. | lesson | what it shows | lesson | exercise |
# | --- | --- | --- | --- | --- |
# | 08 | [Landmarks from scans](08_landmarks_from_scans.ipynb) | table legs, walls and corners found in a scan, and which of them were seen before | 75 min | 60 min |
# | 09 | [SLAM with walls](09_slam_with_walls.ipynb) | a whole thesis system, driven live through two buildings; its flaws measured and mended | 60 min | 60 min |
# | 10 | [Boxes](10_boxes.ipynb) | a filter that promises bounds, not likelihoods, and what one broken promise does | 90 min | 60 min |
# | 11 | [Samples](11_samples.ipynb) | a cloud of guesses that can say "here or there", which no ellipse can | 90 min | 60 min |
# | 12 | [Three filters, one robot](12_three_filters.ipynb) | box, ellipse and samples on the same three laps of a small robot, over eighty drives | 90 min | 60 min |
# | 13 | [Scan matching](13_scan_matching.ipynb) | laying one scan over another until it fits, though nobody knows which points belong together | 95 min | 60 min |
# | 14 | [The eMIR system](14_the_emir_system.ipynb) | from bytes on a wire to a live map: a real lidar and robot, or their emulators, driven by you | 100 min | 60 min |
# | 15 | [Closing the loop](15_closing_the_loop.ipynb) | a place seen again mends the whole map: a graph of poses, loops true and false, a real building | 80 min | 60 min |
# | 16 | [Your own SLAM](16_your_own_slam.ipynb) | how to measure a SLAM of your own, and not be fooled by luck; the project that the course leads to | 52 min | 180 min |
#
# They are numbered in the order in which to read them.

# %% [markdown] slideshow={"slide_type": "skip"} tags=["lecturer"]
# ## If you give the lecture
#
# Every lesson is also its slides, with live cells and sliders: press **Lecture** in the toolbar.
# Derivations open one line at a key press, and the speaker's notes stand in cells of their own.
# [docs/lecturing.md](../docs/lecturing.md) has the keys, and how to rehearse.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## How far you are
#
# What you answer and check is kept in the file `progress.json` beside the folders of the notebooks,
# and nowhere else: nothing leaves your computer. The head of each notebook shows its own tasks and
# questions. The next cell shows all of them, and so does `slamlab progress` in a terminal.

# %% name="progress"
from slamlab import coursework

coursework.show_progress()

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Where help is
#
# - **A function:** Shift+Tab behind its name, or `help(name)`, shows its equation, and the shape and
#   unit of each argument.
# - **A check that fails:** read its first ✗ line, which says which law is broken, then the case
#   below it, and try your function on that input by hand.
# - **A cell that fails:** the last line of the message says what went wrong.
# - **Everything else:** the `README.md` of the project, and whoever gave you the course.
#
# **What comes next:** [01 · Why SLAM](01_why_slam.ipynb). A robot drives round a corridor and comes
# home, but its map does not.

# %% [markdown] slideshow={"slide_type": "skip"} name="letters"
# ## Appendix: notation
#
# **A letter has one meaning** in all lessons, exercises and docstrings. Capital letters are
# matrices, unless it says otherwise. A roman subscript $\mathrm{r}$ is the robot: of a covariance
# $P$, the block of the robot's pose is $P_{\mathrm{rr}}$. A hat, as in $\hat{x}$, marks an estimate.
#
# | Letter | What it means |
# | --- | --- |
# | $x$ | the state: the robot's pose $x$, $y$, $\theta$, and with it, from lesson 06 on, the map; $y$ and $\theta$ mean nothing else |
# | $a$, $b$ | any two poses |
# | $u$ | control: distance $d$ and turn $\Delta\theta$; of a steered robot the speed $V$ and the angle $\gamma$ |
# | $s$ | distance that a wheel rolls |
# | $o$ | motion that the wheels report, as a pose in the robot's frame |
# | $B$ | distance between wheels, or axles [m] |
# | $T$ | time of a step [s]; with a pose as its subscript, $T_a$, the pose's homogeneous matrix |
# | $\mathrm{Rot}$ | $\mathrm{Rot}(\theta)$ rotates by the angle $\theta$ |
# | $p$ | a point or landmark in the world; $p_{\mathrm{r}}$ in the frame of the robot |
# | $l$ | a wall's line: its distance $\rho$ from the origin, the direction $\alpha$ of its normal |
# | $z$ | a measurement: of a landmark, range $r$ and bearing $\beta$ |
# | $r$ | range, and nothing else |
# | $f$ | model of the motion: the next pose |
# | $h$ | model of the observation: what is measured |
# | $g$ | the inverse of $h$: where the landmark is that was measured |
# | $A$ | Jacobian of the motion with respect to the pose; $A_k$ leads from step $k-1$ to $k$, and products are $A_k \cdots A_1$ |
# | $W$ | Jacobian of the motion with respect to the control |
# | $H$ | Jacobian of the observation |
# | $J$ | any other Jacobian, named by its subscript: $J_{\mathrm{r}}$ of $g$ with respect to the robot, $J_z$ with respect to the measurement |
# | $F$ | matrix of a linear motion |
# | $P$ | covariance of what is believed, and nothing else |
# | $C$ | covariance of the noise of the control |
# | $q$ | process noise, of covariance $Q$ |
# | $Q$ | covariance of the process noise: $W C W^\top$ |
# | $\varepsilon$ | noise of a sensor, of covariance $R$ |
# | $R$ | covariance of the noise of a sensor |
# | $v$ | innovation: measured minus predicted |
# | $S$ | covariance of the innovation: $H P H^\top + R$ |
# | $K$ | gain: $P H^\top S^{-1}$ |
# | $\Lambda$ | information: the inverse of a covariance |
# | $\sigma$ | standard deviation |
# | $w$ | weight, of a sample for instance |
# | $e$ | error: of a step, or of an edge between two poses |
# | $k$ | number of a step; $i$, $j$ number landmarks or poses |
# | $n$, $m$, $N$ | how many there are; $N$ of landmarks or samples; in lessons 02 and 05 $n$ is also a direction |
# | $d$ | distance that the odometry reports; with a subscript, such as $d_{\mathrm{abs}}$, a bound on an error |
# | $c$, $\kappa$ | constants, named where they are used |
# | $\tau$ | share of the distance between two points |
# | $\iota$ | angle under which a beam meets a wall |
# | $U$ | voltage of an infrared sensor |
# | $\Phi$ | how much contradiction a robust weight allows an edge |
# | $\Pr$ | probability, or its density; $\mathrm{Bel}$ is that of a pose, after all that was seen |
# | $\ell$ | logarithm of a weight that is not yet divided by the sum of all |
# | $\delta$ | a small step, such as one of Gauss and Newton |
# | $\psi$ | angle as a lidar counts it, clockwise |
#
# A few letters are used in one derivation only, such as $s$ (a share of the gain) in lesson 03, $\lambda$ in
# lesson 06, $B$, $C$, $D$, $M$, $O$ and the sums $\varphi$, $\psi$, $\vartheta$ in lesson 07, $M$, $U$, $V$ and
# $\gamma$ in lesson 13, or $\pi$ and $\eta$ in lesson 15. They are defined where they stand.

# %% [markdown] slideshow={"slide_type": "skip"} name="notation"
# ### In the code
#
# Names in the code are those letters. A row without a function is an argument of those with one.
# Units are metres and radians, and their squares in covariances.
#
# | Symbol | In the code | Shape | Unit | What it is |
# | --- | --- | --- | --- | --- |
# | $x$ | `x` | (3,) | m, m, rad | pose of the robot: $x$, $y$, $\theta$ |
# | $u$ | `u` | (2,) | m, rad | control: distance and turn; of a steered robot speed [m/s] and angle |
# | $p$ | `p` | (2,) | m | a landmark's position |
# | $z$ | `z` | (2,) | m, rad | one observation: range and bearing |
# | $a$, $b$ | `a`, `b` | (3,) | m, m, rad | any two poses |
# | $l$ | `line` | (2,) | m, rad | a wall's line |
# | $f$ | `models.f_odometry(x, u)` | (3,) | m, m, rad | the pose after driving a distance and turning |
# | $f$ | `models.f_steered(x, u, B, T)` | (3,) | m, m, rad | the pose of a steered robot with wheel base $B$ after time $T$ |
# | $h$ | `models.h(x, p)` | (2,) | m, rad | range and bearing of a landmark |
# | $g$ | `models.g(x, z)` | (2,) | m | the landmark that was observed |
# | $A$ | `jacobians.A_odometry(x, u)` | (3, 3) | | $\partial f/\partial x$ |
# | $A$ | `jacobians.A_steered(x, u, B, T)` | (3, 3) | | the same of the steered robot |
# | $W$ | `jacobians.W_odometry(x, u)` | (3, 2) | | $\partial f/\partial u$ |
# | $W$ | `jacobians.W_steered(x, u, B, T)` | (3, 2) | | the same of the steered robot |
# | $H$ | `jacobians.H_robot(x, p)` | (2, 3) | | $\partial h/\partial x$, the robot's part of $H$ |
# | $H$ | `jacobians.H_landmark(x, p)` | (2, 2) | | $\partial h/\partial p$, the landmark's part of $H$ |
# | $J_{\mathrm{r}}$ | `jacobians.J_xr(x, z)` | (2, 3) | | $\partial g/\partial x$: a new landmark moves with the robot |
# | $J_z$ | `jacobians.J_z(x, z)` | (2, 2) | | $\partial g/\partial z$: a new landmark moves with its observation |
# | $h$ | `models.h_line(x, line)` | (2,) | m, rad | distance and direction of a wall's line, seen from a pose |
# | $g$ | `models.g_line(x, z)` | (2,) | m, rad | the line that was seen |
# | $H$ | `jacobians.H_robot_line(x, line)` | (2, 3) | | $\partial h/\partial x$ of a line |
# | $H$ | `jacobians.H_line(x, line)` | (2, 2) | | $\partial h/\partial l$ of a line |
# | $J_{\mathrm{r}}$ | `jacobians.J_xr_line(x, z)` | (2, 3) | | $\partial g/\partial x$ of a line |
# | $J_z$ | `jacobians.J_z_line(x, z)` | (2, 2) | | $\partial g/\partial z$ of a line |
# | $C$ | `noise.C_odometry(u, distance_error, turn_error)` | (2, 2) | m², rad² | covariance of the control |
# | $C$ | `noise.C_wheels(u, slip, base)` | (2, 2) | m², rad² | the same of two wheels that slip at random |
# | $Q$ | `noise.Q(W, C)` | (3, 3) | m², rad² | what the control's noise adds to the pose's covariance |
# | $R$ | `noise.R(r, range_error, bearing_sigma)` | (2, 2) | m², rad² | covariance of one observation |
# | | `geometry.wrap(angle)` | () | rad | the same angle between −π and π |
# | $a \oplus b$ | `geometry.compose(a, b)` | (3,) | m, m, rad | pose $b$, which is given relative to $a$, in the frame in which $a$ is given |
# | $\ominus a$ | `geometry.inverse(a)` | (3,) | m, m, rad | the pose that undoes $a$ |
# | $\ominus a \oplus b$ | `geometry.between(a, b)` | (3,) | m, m, rad | pose $b$ as seen from pose $a$ |
# | $T_a$ | `geometry.matrix(a)` | (3, 3) | | homogeneous matrix of a pose |
# | | `geometry.from_matrix(T)` | (3,) | m, m, rad | the pose of a homogeneous matrix |
# | | `geometry.transform(a, points)` | (n, 2) | m | points (n, 2) of the frame of $a$ in the frame in which $a$ is given |
#
# A filter holds a belief of $n$ numbers, `b` in the code, and takes in $m$ measured ones. Its update
# returns a new belief and a `step` that says what it was made of:
#
# | Symbol | In the code | Shape | What it is |
# | --- | --- | --- | --- |
# | $x$ | `b.x` | (n,) | the mean: what is believed |
# | $P$ | `b.P` | (n, n) | its covariance: how wrong that may be |
# | $F$, $Q$ | `linear.predict(b, F, Q)` | (n, n) | time passes: $x$ becomes $F x$, and noise of covariance $Q$ is added |
# | $H$, $R$ | `linear.update(b, z, H, R)` | (m, n), (m, m) | a measurement $z$ of $H x$, with noise of covariance $R$ |
# | $v$ | `step.innovation` | (m,) | measured minus predicted: $z - H x$ |
# | $S$ | `step.S` | (m, m) | covariance of $v$ |
# | $K$ | `step.K` | (n, m) | the gain; $x$ grows by $K v$ |
# | | `step.nis` | () | $v^\top S^{-1} v$: $m$ on average if $S$ is just right, less if the filter is too modest, more if it is too sure |
#
# A graph of poses (lesson 15) holds edges: an edge $z$ says where pose $j$ is, seen from pose $i$.
#
# | Symbol | In the code | Shape | What it is |
# | --- | --- | --- | --- |
# | $e$ | `edges.error(x_i, x_j, z)` | (3,) | how far pose $j$ is from where pose $i$ and $z$ say it is |
# | $J_i$ | `jacobians.J_i(x_i, x_j, z)` | (3, 3) | $\partial e/\partial x_i$ |
# | $J_j$ | `jacobians.J_j(x_i, x_j, z)` | (3, 3) | $\partial e/\partial x_j$ |

# %% [markdown] slideshow={"slide_type": "skip"}
# ## Appendix: what the sources print wrong
#
# The theses that this course rests on hold slips that would spoil a program. Each lesson closes with
# its own; [In print](in_print.ipynb) has them all in one place.

# %% [markdown] slideshow={"slide_type": "skip"}
# ## Appendix: the field's words
#
# The course speaks as the literature does. Each term stands with one sentence, the file of the package
# that does it, the lesson that teaches it and, where the sources of the course (or its first edition)
# have a word of their own, that word.
#
# {{glossary}}
