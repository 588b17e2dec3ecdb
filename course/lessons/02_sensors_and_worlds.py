# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 02 · Sensors and worlds
#
# **You will be able to** compute what a range sensor sees of a world, carry its readings into the
# world's frame, say how wrong they are and why, and compare a simulated sensor with a real one.
#
# **60 minutes** in two parts: what a sensor sees (23), and how it errs (37). **Before:** lesson
# [01](01_why_slam.ipynb); two linear equations in two unknowns; the standard deviation.
#
# *Key:* a simulator is a claim about a device, and it can be tested like any other claim.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Part one is geometry, part two is statistics; each fits a lecture of its own.
# If time is short, leave out "Move a wall" and "Three sensors, one place". What the class will
# remember is the end of part two, where the numbers of a real device reveal how it works. Polls
# that work well: the wall behind the sensor, the forgotten minus, the three errors of a wheel.

# %% slideshow={"slide_type": "skip"} name="imports" tags=["folded"]
from dataclasses import replace

import numpy as np
import sympy as sp

from slamlab import views, worlds
from slamlab.checks import ask
from slamlab.devices.rplidar.revolutions import robot_frame
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.readings import Scan
from slamlab.simulation import (
    GP2D120,
    RPLIDAR_A2,
    ULTRASONIC,
    DifferentialDrive,
    Scanner,
    Simulator,
)
from slamlab.studies import a2_at_rest
from slamlab.views.editor import edit_world
from slamlab.worlds import World

real = a2_at_rest.stored()  # statistics of a real lidar, for part two

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## One beam, one wall
#
# A lidar sends out a beam of light and measures how far it flies until it meets something. A
# simulated lidar has no light, so we have to compute where beam and wall meet.
#
# Put the origin into the sensor. The beam flies in the direction $\varphi$, along the unit vector
# $n = (\cos\varphi, \sin\varphi)^{\mathsf T}$, and after a range $r$ it is at the point $r\,n$. The
# wall goes from $p_1$ to $p_2$, and a share $\tau$ of it leads to $p_1 + \tau\,(p_2 - p_1)$. Beam
# and wall meet where the two are the same point:
#
# $$ r\,n = p_1 + \tau\,(p_2 - p_1). \tag{02.1} $$

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Two equations, two unknowns
#
# We know the beam and the wall, and look for $r$ and $\tau$. Written for $x$ and for $y$, (02.1) is
# a linear system. With the unknowns on the left, its matrix is

# %% slideshow={"slide_type": "fragment"} name="system" tags=["nbval-check-output"]
phi, x_1, y_1, x_2, y_2 = sp.symbols("varphi x_1 y_1 x_2 y_2", real=True)
n, p_1, p_2 = sp.Matrix([sp.cos(phi), sp.sin(phi)]), sp.Matrix([x_1, y_1]), sp.Matrix([x_2, y_2])
M = sp.Matrix.hstack(n, p_1 - p_2)
sp.Eq(sp.MatMul(M, sp.Matrix(sp.symbols("r tau"))), p_1, evaluate=False)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Such a system has one solution unless its determinant is zero. The first line below is $r$, and
# the second is $\tau$; below the fraction bar you find the determinant, up to its sign:

# %% slideshow={"slide_type": "fragment"} name="solution" tags=["nbval-check-output"]
r_and_tau = (M.inv() * p_1).applyfunc(sp.simplify)
r_and_tau

# %% slideshow={"slide_type": "subslide"} name="ask-meet"
ask(
    "02-meet",
    "A beam is a ray: it flies forwards only. A wall is a segment: it ends. But (02.1) knows only "
    "two *lines*. **A wall stands behind the sensor, across the beam's line. What does the "
    "formula say?**",
    {
        "the determinant is zero": "this happens when beam and wall are parallel; these two lines do "
        "cross.",
        "r is below zero": "to reach the crossing, the beam would have to fly backwards.",
        "τ is below 0 or above 1": "then the lines would cross beyond the ends of the wall. Here they "
        "cross between them, but behind the sensor.",
        "nothing unusual: r is its distance": "the size is right, the sign is not; a sensor that "
        "ignores it sees through the back of its head.",
    },
    right="r is below zero",
)

# %% slideshow={"slide_type": "fragment"} name="four-walls" answers="02-meet" tags=["folded"]
FOUR_WALLS = {
    "in the way": (2.0, -0.5, 1.5, 2.5),
    "behind": (-1.5, 0.5, -0.5, -1.5),
    "beside": (2.8, -1.5, 2.6, 0.3),
    "parallel": (0.0, 0.8, 2 * np.cos(np.radians(25)), 0.8 + 2 * np.sin(np.radians(25))),
}
crossing = sp.lambdify((phi, x_1, y_1, x_2, y_2), list(r_and_tau))


def four_walls(beam_in_degrees, sensor_x):
    """The four walls, what the formula says of each, and how far the beam really flies."""
    turn, shift = np.radians(np.float64(beam_in_degrees)), np.array([sensor_x, 0])
    ahead = np.array([np.cos(turn), np.sin(turn)])
    flown = World(list(FOUR_WALLS.values())).cast(shift, [turn])[0]
    meets = f"meets a wall after r = {flown:.2f} m" if flown < np.inf else "meets nothing"
    layers = [
        Segments("walls", list(FOUR_WALLS.values())),
        Segments("scan", [[*shift, *(shift + min(flown, 4) * ahead)]]),
        Poses("robot", [[*shift, turn]]),
    ]
    fig, (ax,) = views.side_by_side({f"The beam {meets}": layers}, size=(8, 5))
    for name, wall in FOUR_WALLS.items():
        with np.errstate(divide="ignore"):
            r, tau = crossing(turn, *(np.array(wall) - [*shift, *shift]))
        told = f"{name}\nr = {r:.2f}, τ = {tau:.2f}" if abs(r) < 99 else f"{name}\nno crossing"
        ax.annotate(told, wall[2:], xytext=(7, 0), textcoords="offset points", va="center")
    ax.margins(0.12)
    return fig


# %% slideshow={"slide_type": "subslide"} name="four-walls-picture" answers="02-meet"
views.explore(
    four_walls,
    "A beam and four walls, beside each its r and τ: only the wall in the way is met.",
    beam_in_degrees=(-180, 180, 25),
    sensor_x=(-1.0, 3.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-meet"
# The wall behind has $r < 0$, and the one beside the beam has $\tau > 1$. The parallel one has no
# crossing: its determinant is zero.

# %% [markdown] slideshow={"slide_type": "fragment"} name="beam-meets-wall"
# The beam meets a wall where
#
# $$ r \ge 0 \quad\text{and}\quad 0 \le \tau \le 1. \tag{02.2} $$
#
# Turn the beam until it meets "behind" or "beside", and watch which of the numbers changes.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Many beams, many walls
#
# A scan has hundreds of beams, and each of them asks every wall. The nearest answer wins: what
# stands behind it is hidden. In the package this is `World.cast`. It first finds the
# interval of directions that each wall fills, because only the beams inside it can meet the wall.
#
# What the sensor delivers is a list of ranges $r$, one for each bearing $\beta$. With
#
# $$ p_{\mathrm s} = (r \cos\beta,\; r \sin\beta)^{\mathsf T}, \tag{02.3} $$
#
# where $\mathrm s$ stands for the sensor's frame, the list becomes a picture.

# %% slideshow={"slide_type": "subslide"} name="ask-arc"
ask(
    "02-arc",
    "A robot stands beside a long straight wall and plots the raw list, with $r$ upwards over "
    "$\\beta$. "
    "**What does the wall look like?**",
    {
        "a straight line": "the wall is straight in x and y. Over the bearing, its range grows "
        "faster and faster to either side.",
        "level: the wall's distance does not change": "the distance of the wall is the "
        "shortest of its ranges; every other beam flies farther.",
        "an arc, lowest where the beam meets the wall at a right angle": "to either side the beams "
        "hit the wall at a slant, farther off.",
        "an arc, highest where the beam meets the wall at a right angle": "there the wall is "
        "nearest, so the range is least.",
    },
    right="an arc, lowest where the beam meets the wall at a right angle",
)


# %% slideshow={"slide_type": "fragment"} name="polar" answers="02-arc" tags=["folded"]
def ideal(beams):
    """A lidar that makes no errors."""
    return Scanner(beams=beams, range_error=0.0)


def two_pictures(beams, heading_in_degrees):
    """A scan of the room, as ranges over bearings and as points in the sensor's frame."""
    pose = np.array([0, 0, np.radians(heading_in_degrees)])
    seen = ideal(beams).scan(worlds.room(), pose, np.random.default_rng(0))
    fig, (left, right) = views.panels(["r over β", "x and y"], (10, 4.6), shared=False)
    left.plot(np.degrees(seen.angles), seen.ranges, ".", color=views.COLOURS["scan"], markersize=3)
    left.set(aspect="auto", xlabel="bearing β [degrees]", ylabel="range r [m]", ylim=(0, 6.5))
    views.draw(right, Points("scan", seen.points()), markersize=5)
    views.draw(right, Poses("robot", [[0, 0, 0]]))
    right.set(aspect="equal", adjustable="box", xlim=(-6, 6), ylim=(-6, 6))
    return fig


# %% slideshow={"slide_type": "subslide"} name="polar-picture" answers="02-arc"
views.explore(
    two_pictures,
    "Left ranges over bearings, in arcs and jumps; right the same readings as points along walls.",
    beams=(40, 3600, 400),
    heading_in_degrees=(-180, 180, 0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-arc"
# On the left every straight wall is an arc. Where two walls meet, two arcs meet; where something
# hides what is behind it, $r$ *jumps*. Turn the robot, and the left picture slides sideways, while
# the right one turns the other way: in its own frame the robot never turns.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Sparse and dense
#
# A straight wall at the distance $\rho$ whose normal points in the direction $\alpha$ is seen at
# the bearing $\beta$ under the *angle of incidence* $\iota = \beta - \alpha$, which is zero where
# the beam meets the wall at a right angle (*square on*). Its range is
#
# $$ r = \frac{\rho}{\cos\iota}. \tag{02.4} $$
#
# Two beams that lie a small angle $\Delta\beta$ apart hit it $r\,\Delta\beta / \cos\iota$ apart.
# With 400 beams this is {= 1000 * 3 * np.radians(0.9):.0f =} mm on a wall 3 m ahead, but
# {= 100 * 8 * np.radians(0.9) / np.cos(np.radians(70)):.0f =} cm on one 8 m away that is seen at
# $\iota = 70°$. Set the slider to 40 beams: some walls are left with two or three points, and
# nobody could tell where they end. At the other end of the slider are 3600 beams, as many as Smolec
# simulates in one of the theses on which this course is built.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## What a beam cannot see
#
# Even a perfect sensor sees little of a building. Most walls stand behind others, which is called
# *occlusion*, or beyond the sensor's range. Here are four rooms off a corridor, whose doors face
# each other: Smolec's *situation 1*. What share of all its walls is in sight from the middle of one
# room? And where must the robot stand to see most? Think of a place before you move it there.


# %% slideshow={"slide_type": "fragment"} name="sight"
flat = worlds.situation_1()
ends = [(wall[:2], wall[2:]) for wall in flat.walls]
places = [np.linspace(p, q, round(np.hypot(*(q - p)) / 0.05)) for p, q in ends]
places = np.vstack(places)  # every 5 cm along the walls


def in_sight(x, y):
    """Which of the places on the walls a sensor at (x, y) sees, and their share of all."""
    way = places - [x, y]
    distance = np.hypot(*way.T)
    free = flat.cast((x, y), np.arctan2(way[:, 1], way[:, 0])) > distance - 1e-6
    return free, 100 * free.mean()


# %% slideshow={"slide_type": "-"} name="sight-drawing"
def draw_sight(x, y):
    """The building, and what is in sight of it."""
    free, share = in_sight(x, y)
    fig, ax = views.axes(f"{share:.0f} % of the walls in sight", size=(8, 5.4))
    views.draw(ax, Segments("walls", flat.outline()))
    views.draw(ax, Points("in sight", places[free]), markersize=6)
    views.draw(ax, Poses("robot", [[x, y, 0]]))
    return fig


# %% slideshow={"slide_type": "-"} name="sight-picture"
views.explore(
    draw_sight,
    lambda x, y: (
        f"From ({x:.1f} m, {y:.1f} m) {in_sight(x, y)[1]:.0f} % of the walls are in sight: near ones, "
        "and strips behind doors."
    ),
    x=(-1.9, 7.9, 0.1),
    y=(-1.9, 7.4, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# From the middle of a room, {= in_sight(0.1, 0.1)[1]:.0f =} % of the walls are in sight: those of
# the room itself and, through its door, strips of what lies behind. The door, at $(0, 2)$, shows
# {= in_sight(0.1, 2.0)[1]:.0f =} %. We tried a place every half a metre, and none shows more than
# {= max(in_sight(x, y)[1] for x in np.arange(-1.9, 8, 0.5) for y in np.arange(-1.9, 7.5, 0.5)):.0f =}
# %. A map puts together what no single place shows, and for this it needs poses.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Sensor, robot, world
#
# A reading is made in the frame of the *sensor*. The sensor sits on the *robot*, seldom in its
# middle, and the robot stands somewhere in the *world*. So two poses lie between a reading and the
# map: the sensor's *mount* $b$, given in the robot's frame, and the robot's pose $x$. We go from
# the inside out, and apply (01.3) twice:
#
# $$ p_{\mathrm r} = \begin{pmatrix} x_b \\ y_b \end{pmatrix} + \mathrm{Rot}(\theta_b)\,
# p_{\mathrm s}, \qquad
# p = \begin{pmatrix} x \\ y \end{pmatrix} + \mathrm{Rot}(\theta)\, p_{\mathrm r}. \tag{02.5} $$
#
# Both at once are one step with the pose of the sensor in the world, which is $x \oplus b$.

# %% slideshow={"slide_type": "subslide"} name="mounted" tags=["nbval-check-output", "code"]
mount = np.array([0.2, 0.0, np.pi / 2])  # 20 cm ahead of the middle, looks to the left
pose = np.array([2.0, 1.0, np.pi / 2])  # at (2, 1), looks along +y
in_sensor = np.array([[3.0, 0.0]])  # 3 m, straight ahead
in_robot = transform(mount, in_sensor)
print("in the robot's frame:", in_robot[0].round(3))
print("in the world:        ", transform(pose, in_robot)[0].round(3))
print("both at once:        ", transform(compose(pose, mount), in_sensor)[0].round(3))
print("the wrong way round: ", transform(compose(mount, pose), in_sensor)[0].round(3))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Check the first two lines by hand. The last one is a point, too, and no error message tells you
# that it means nothing.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Do it with your body. You are the robot, your outstretched left arm is the
# sensor; let the class say where the wall is when you turn. Then show the figure with five scans.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A forgotten mount
#
# A single scan looks right whatever mount you believe in; the whole picture is just shifted. So let
# the robot turn on the spot and lay five scans on one table. Its sensor sits 20 cm ahead of the
# middle, but the program believes that it sits *in* the middle:


# %% slideshow={"slide_type": "fragment"} name="five-scans" tags=["folded"]
def five_scans(believed_ahead, believed_turn_in_degrees):
    """Five scans from five headings, placed with a mount that may be wrong."""
    true, rng = np.array([0.2, 0.0, 0.0]), np.random.default_rng(0)
    believed = np.array([believed_ahead, 0.0, np.radians(believed_turn_in_degrees)])
    fig, ax = views.axes("Five scans of one room, turned on the spot", size=(8, 5.2))
    for turn in np.radians([0, 70, 140, 210, 280]):
        stands = np.array([0.5, 0.2, turn])
        seen = ideal(400).scan(worlds.room(), compose(stands, true), rng).points()
        placed = transform(compose(stands, believed), seen)
        views.draw(ax, Points("scan", placed), markersize=4)
    return fig


# %% slideshow={"slide_type": "-"} name="five-scans-picture"
views.explore(
    five_scans,
    lambda believed_ahead, believed_turn_in_degrees: (
        f"Five scans with a mount believed {believed_ahead:.2f} m ahead, and turned by "
        f"{believed_turn_in_degrees:.0f}°: the walls lie on each other only if both are right."
    ),
    believed_ahead=(0.0, 0.4, 0.0),
    believed_turn_in_degrees=(-20.0, 20.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Every wall stands there several times, because the five scans were taken from five places. Move
# the first slider to 0.20, and they fall on each other. Now try the second slider. If the robot
# never moved, would you notice that the mount is turned?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## What the device says
#
# An RPLIDAR reports *degrees*, counted *clockwise* from its front, *millimetres*, and 0 for
# "nothing came back". The course speaks of radians, counter-clockwise, metres and NaN. A program
# that converts here and there will one day convert twice, so the package converts in one place,
# where readings enter:

# %% slideshow={"slide_type": "fragment"} name="robot-frame" tags=["nbval-check-output", "code"]
angles, ranges = robot_frame(angle_deg=[0.0, 90.0, 270.0], range_mm=[1500.0, 800.0, 0.0])
print(np.degrees(angles), "degrees,", ranges, "m")

# %% slideshow={"slide_type": "subslide"} name="ask-minus"
ask(
    "02-minus",
    "Somebody forgets that the device counts clockwise: every bearing has the wrong sign. The robot "
    "scans, turns by 40° on the spot, scans again, and lays both scans out. **By how much are "
    "the two turned against each other?**",
    {
        "not at all: both are mirrored alike": "both are mirrored, but each in its own frame, and the "
        "frame has turned.",
        "by 40°": "this is what forgetting the *turn* would do. With the wrong sign, the map also "
        "turns the wrong way.",
        "by 80°": "the mirrored room turns by 40° to the wrong side, and the pose adds 40° more.",
    },
    right="by 80°",
)


# %% slideshow={"slide_type": "fragment"} name="minus" answers="02-minus" tags=["folded"]
def two_scans(turned_by_degrees, minus_forgotten):
    """Two scans before and after a turn on the spot, placed with the right or the wrong sign."""
    fig, ax = views.axes("Two scans of one room from one place", size=(8, 5.4))
    for turn, name in ((0, "map"), (np.radians(turned_by_degrees), "naive")):
        stands = np.array([0, 0, turn])
        seen = ideal(400).scan(worlds.room(), stands, np.random.default_rng(0))
        angles = -seen.angles if minus_forgotten else seen.angles
        placed = transform(stands, Scan(angles, seen.ranges).points())
        label = "first scan" if name == "map" else "after the turn"
        views.draw(ax, Points(name, placed), label=label, markersize=4)
    views.draw(ax, Poses("robot", [[0, 0, 0]]))
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "subslide"} name="minus-picture" answers="02-minus"
views.explore(
    two_scans,
    lambda turned_by_degrees, minus_forgotten: (
        f"Two scans before and after a turn by {turned_by_degrees}°: "
        + (f"mirrored, and {2 * turned_by_degrees}° apart." if minus_forgotten else "they agree.")
    ),
    turned_by_degrees=(0, 90, 40),
    minus_forgotten=True,
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-minus"
# Each mirrored scan looks like a room, only another one, and nobody would notice. After the turn
# the two disagree, and they disagree by *twice* the turn. So test a driver with a robot that turns.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Move a wall, watch the scan
#
# This is Smolec's *situation 2*, and what a lidar at the origin sees of it. Drag a corner, or
# choose it with Tab and move it with the arrow keys; click into the rows to change numbers or to
# add a wall. *Undo* takes back the last change.
#
# Pull the corner $(-2.4, -3.2)$ to the right: does more of the bay in the lower left come into
# sight, or less? And which points vanish when you add the pillar `-1 -1 0.2`?


# %% slideshow={"slide_type": "fragment"} name="editor"
def seen_from_the_origin(world):
    return RPLIDAR_A2.scan(world, np.zeros(3), np.random.default_rng(2)).points()


editor = edit_world(
    worlds.situation_2(),
    "An irregular room with one slanted wall, and what a lidar near its upper right sees of it.",
    scan=seen_from_the_origin,
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The bay is half hidden behind the corner. Pulled to the right, the corner hides less of it. The
# pillar hides a strip behind itself that widens with distance. With
# `worlds.save(editor.world, "mine.txt")` you keep what you drew; you could measure your own room.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Part two: how a sensor errs
#
# *This is a good place for a break.*
#
# So far our lidar has made no errors. A real one errs in three ways: its range is off by a random
# amount, its beam flies a little beside the bearing that it reports, and some beams return nothing
# at all. Before we look at a real device, let us make a **first guess**, with round numbers for an
# RPLIDAR A2. The end of the lesson puts it to the test.

# %% slideshow={"slide_type": "fragment"} name="guess" tags=["nbval-check-output", "code"]
guess = Scanner(beams=400, range_error=0.004, bearing_sigma=np.radians(0.1), dropouts=0.03)
print(f"range: σ = {100 * guess.range_error:.1f} % of r")
print(f"bearing: σ = {np.degrees(guess.bearing_sigma):.1f}°")
print(f"lost: {100 * guess.dropouts:.0f} % of the beams")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What a bearing's error does to the range
#
# A tenth of a degree sounds like nothing. But a beam that flies a little aside meets the wall
# elsewhere, and a wall that is seen at a slant is farther off there. How much farther per radian,
# as a share of the range? We differentiate (02.4):

# %% slideshow={"slide_type": "fragment"} name="slope" tags=["nbval-check-output"]
rho, iota = sp.symbols("rho iota", positive=True)
r_wall = rho / sp.cos(iota)
sp.simplify(sp.diff(r_wall, iota) / r_wall)

# %% [markdown] slideshow={"slide_type": "fragment"}
# So a small error of the bearing changes the range by $r \tan\iota$ times itself. If the range has
# an error of its own, $c_1 r$, the two are independent, and their variances add:
#
# $$ \sigma^2 = (c_1\, r)^2 + (r \tan\iota\;\sigma_\beta)^2. \tag{02.6} $$

# %% slideshow={"slide_type": "subslide"} name="ask-slant"
ask(
    "02-slant",
    "$\\sigma_\\beta$ is 0.1°, and the beam meets a wall at $\\iota = 80°$, where $\\tan\\iota$ is "
    "5.7. **How large is the part of $\\sigma$ that the bearing contributes, in per cent of $r$?**",
    right=1.0,
    tolerance=0.06,
    unit="% of r",
    reason="0.1° is 0.00175 rad; times 5.7 this is 0.0099, more than twice the 0.4 % of the range "
    "itself.",
    wrong={
        0.57: "this is 5.7 · 0.1 with degrees in it: a derivative counts in radians.",
        57: "this is 5.7 · 0.1 in degrees, times 100: a derivative counts in radians.",
        0.17: "this is the error of the bearing itself, without the slant.",
        0.01: "this is the share; in per cent it is a hundred times larger.",
        1.07: "this is both parts together; the question asks for that of the bearing alone.",
    },
)


# %% slideshow={"slide_type": "fragment"} name="slant" answers="02-slant" tags=["folded"]
hall = worlds.corridor()
bearings = guess.angles
straight = hall.cast((0, 0), bearings)
incidence = np.arctan(abs(hall.cast((0, 0), bearings + 1e-6) - straight) / 1e-6 / straight)


def at_rest(bearing_error_in_degrees, range_error_in_percent):
    """The spread of 300 readings of each beam in a corridor, over the incidence; and (02.6)."""
    c_1, sigma_beta = range_error_in_percent / 100, np.radians(bearing_error_in_degrees)
    rng = np.random.default_rng(2)
    device = replace(guess, range_max=20.0, range_error=c_1, bearing_sigma=sigma_beta)
    ranges = np.array([device.scan(hall, np.zeros(3), rng).ranges for _ in range(300)])
    shares = 100 * np.nanstd(ranges, axis=0) / straight
    at = np.radians(np.linspace(0, 84, 100))
    law = 100 * np.hypot(c_1, np.tan(at) * sigma_beta)
    title = "Spread of 300 readings of each beam"
    fig, ax = views.chart("angle of incidence ι [degrees]", "σ / r [%]", title, (8, 4))
    ax.plot(np.degrees(incidence), shares, ".", color=views.COLOURS["scan"], label="simulated")
    ax.plot(np.degrees(at), law, color=views.COLOURS["truth"], label="(02.6)")
    ax.set(ylim=(0, 2.5), xlim=(0, 86))
    views.legend(ax, loc="upper left")
    return fig


# %% slideshow={"slide_type": "subslide"} name="slant-picture" answers="02-slant"
views.explore(
    at_rest,
    lambda bearing_error_in_degrees, range_error_in_percent: (
        "The spread of each beam lies on a curve that begins at "
        f"{range_error_in_percent:.1f} % of the range and rises at a slant."
    ),
    bearing_error_in_degrees=(0.0, 0.3, 0.1),
    range_error_in_percent=(0.0, 1.0, 0.4),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-slant"
# The marks lie on the curve: 0.4 % square on, and more than twice as much beyond 80°. A few lie far
# above it. These are beams that pass close to an edge and meet now the near surface, now the one
# behind it; no bell curve describes them.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## An infrared sensor: a voltage falls
#
# The robot of the MAK thesis, another source of this course, carries a Sharp GP2D120. It sends out
# infrared light and looks, from a few centimetres to the side, at the angle under which the spot on
# the wall appears. This is called *triangulation*. The farther the wall, the less the angle still
# changes, and the sensor's voltage $U$ behaves roughly as
#
# $$ U = \frac{\kappa}{r}. \tag{02.7} $$
#
# Its noise $\sigma_U$ is always the same. What does it do to the range? Solve for $r$,
# differentiate, and put (02.7) in again:

# %% slideshow={"slide_type": "fragment"} name="voltage" tags=["nbval-check-output"]
U, kappa, sigma_U, r = sp.symbols("U kappa sigma_U r", positive=True)
sp.Abs(sp.diff(kappa / U, U)).subs(U, kappa / r) * sigma_U

# %% [markdown] slideshow={"slide_type": "fragment"}
# The error grows with the **square** of the range:
#
# $$ \sigma = c_2\, r^2 \quad\text{with}\quad c_2 = \sigma_U / \kappa. \tag{02.8} $$
#
# With $\kappa = 0.12$ V m and 15 mV of noise, it is {= 1000 * 0.125 * 0.05**2:.1f =} mm at 5 cm and
# {= 1000 * 0.125 * 0.28**2:.0f =} mm at 28 cm. Keep this square in mind.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Three sensors, one place
#
# An *ultrasonic* sensor sends out a cone of sound and hears the first echo, from whatever direction
# in the cone it comes. Here a lidar, the infrared sensor and an ultrasonic sensor look at the MAK
# thesis' arena of cardboard boxes, from the same place. Look for three things: which sensor shows
# most, which shows only what is near, and what becomes of corners in the third picture.

# %% slideshow={"slide_type": "fragment"} name="three-sensors" tags=["folded"]
arena, stands = worlds.arena(), np.array([-0.12, -0.2, np.radians(100)])
devices = {"lidar": RPLIDAR_A2, "infrared": GP2D120, "ultrasonic": ULTRASONIC}
layers, back = {}, {}
for name, device in devices.items():
    points = device.scan(arena, stands, np.random.default_rng(1)).points()
    back[name] = len(points)
    hits = Points("scan", transform(stands, points))
    title = f"{name}: {len(points)} of {device.beams} back"
    layers[title] = [Segments("walls", arena.outline()), hits, Poses("robot", [stands])]
fig, drawn = views.side_by_side(layers, size=(11, 3.8))
for ax in drawn:
    ax.lines[0].set_markersize(6)
views.show(fig, "The lidar sees most walls sharply, infrared only the near ones, sound round arcs.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The lidar draws whatever is in sight beyond its least range of
# {= 100 * RPLIDAR_A2.range_min:.0f =} cm. Of {= GP2D120.beams =} infrared readings only
# {= back["infrared"] =} come back, from walls nearer than {= 100 * GP2D120.range_max:.0f =} cm, and
# even these scatter a little. The ultrasonic sensor draws arcs, because a whole fan of directions
# hears the same nearest place: corners become round, and notches are filled.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## The door that sound does not see
#
# An ultrasonic sensor stands in a room, 2 m in front of the middle of an open door. The
# door is 1 m wide, and beyond it there is a second wall.

# %% slideshow={"slide_type": "fragment"} name="ask-door"
ask(
    "02-door",
    "The sensor looks straight at the door's middle. **How wide may its cone be at most, for it to "
    "hear the wall beyond and not the door posts?**",
    right=28.0,
    tolerance=0.9,
    unit="°",
    reason="the posts stand arctan(0.5 / 2) = 14° to either side; a wider cone hears them first.",
    wrong={
        14: "this is how far the posts stand off to one side; the cone reaches to both.",
        26.6: "this is arctan(1 / 2), but each post stands only half the door's width off to its "
        "side.",
        53: "half of the door lies on each side: arctan(0.5 / 2), and twice that.",
        25: "this is the cone of a common sensor. Compute the angle of the posts.",
    },
)


# %% slideshow={"slide_type": "fragment"} name="door" answers="02-door" tags=["folded"]
DOOR = World(
    [
        *[(-2, -1.5, 3, -1.5), (3, -1.5, 3, 2), (-2, 2, -2, -1.5), (-2, 3.5, 3, 3.5)],
        *[(3, 2, 0.5, 2), (-0.5, 2, -2, 2)],  # between these two: the door
    ]
)


def heard(cone_in_degrees, metres_to_the_door):
    """A scan by sound: where the sensor stands, its points, how many lie beyond the door."""
    device = replace(ULTRASONIC, cone=np.radians(cone_in_degrees), beams=91)
    stands = np.array([0, 2 - metres_to_the_door, np.pi / 2])
    points = transform(stands, device.scan(DOOR, stands, np.random.default_rng(0)).points())
    return stands, points, np.sum(points[:, 1] > 2.5)


def by_sound(cone_in_degrees, metres_to_the_door):
    """What an ultrasonic scanner with that cone draws in front of a door."""
    stands, points, beyond = heard(cone_in_degrees, metres_to_the_door)
    fig, ax = views.axes(f"{beyond} of 91 directions hear through the door", size=(8, 5))
    views.draw(ax, Segments("walls", DOOR.walls), lw=3)
    views.draw(ax, Points("scan", points), markersize=7)
    views.draw(ax, Poses("robot", [stands]))
    return fig


# %% slideshow={"slide_type": "subslide"} name="door-picture" answers="02-door"
views.explore(
    by_sound,
    lambda cone_in_degrees, metres_to_the_door: (
        f"A wall with a door, heard from {metres_to_the_door:.1f} m by a cone of "
        f"{cone_in_degrees}°: the wider the cone, the narrower the door."
    ),
    cone_in_degrees=(0, 40, 25),
    metres_to_the_door=(1.0, 3.0, 2.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-door"
# At 25°, only {= heard(25, 2)[2] =} of the 91 directions hears through the door, and the wall comes
# out bent. At 0°, where the sensor is a lidar, {= heard(0, 2)[2] =} do. From
# {= next(cone for cone in range(40) if heard(cone, 2)[2] == 0) =}° on the door is shut: a robot
# that maps by sound walls itself in. Drive nearer, and it opens again.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Odometry is a sensor, too
#
# An *encoder* is a disc with slots on the axle of a wheel. A light barrier looks through the slots
# and counts how often it gets light. One such count is a *tick*.


# %% slideshow={"slide_type": "fragment"} name="encoder" tags=["folded"]
views.explore(
    lambda slots, turned_by_degrees: views.encoder(slots, np.radians(turned_by_degrees)),
    lambda slots, turned_by_degrees: (
        f"A disc with {slots} slots that has turned by {turned_by_degrees}°, and the pulses of its "
        f"light barrier: {int(slots * turned_by_degrees / 360)} ticks."
    ),
    slots=(4, 40, 12),
    turned_by_degrees=(0, 360, 220),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Three errors arise. Only whole ticks are counted. The wheel *slips*, and then it turns farther
# than it travels, or less far. And a tick is taken for the wheel's circumference divided by the
# number of slots, which is wrong if the wheel is larger than believed.

# %% slideshow={"slide_type": "subslide"} name="ask-wheels"
ask(
    "02-wheels",
    "Robots drive 1 m, 4 m and 16 m straight ahead, and count their ticks. **How do the three "
    "errors of the measured distance grow?**",
    {
        "all in proportion to the distance": "only the wrong wheel repeats its error in every "
        "metre, always to the same side.",
        "ticks and slip with its root, the wheel in proportion": "the slip does; but ticks do not "
        "add up. What one metre leaves of a tick is counted in the next.",
        "ticks not at all, slip with its root, the wheel in proportion": "a tick is gained or lost "
        "once; slips partly cancel; a wrong wheel is wrong in every metre.",
        "ticks not at all, slip and wheel in proportion": "slips would have to go to the same side "
        "every time.",
    },
    right="ticks not at all, slip with its root, the wheel in proportion",
)


# %% slideshow={"slide_type": "fragment"} name="wheels" answers="02-wheels" tags=["folded", "nbval-check-output"]
def odometry_errors(robot, way, rng):
    """How much longer a way is believed to be than it was, of 200 robots [mm]: mean, spread."""
    found = []
    for _ in range(200):
        drive, excess = Simulator(robot, rng), 0.0
        for seconds in [*[1.25] * (2 * way), 0.1 * rng.random()]:  # half a metre each
            before = drive.pose
            believed = drive.step(0.4, 0.0, seconds)
            excess += believed[0] - between(before, drive.pose)[0]
        found.append(1000 * excess)
    return np.mean(found), np.std(found)


exact, rng = DifferentialDrive(tick=1e-6), np.random.default_rng(4)
spoiled = {"ticks of 5 mm": {"tick": 0.005}, "slip": {"slip": 0.01}}
spoiled["wheels 1 % larger"] = {"left_scale": 1.01, "right_scale": 1.01}
wheel_errors = {
    name: [odometry_errors(replace(exact, **error), way, rng) for way in (1, 4, 16)]
    for name, error in spoiled.items()
}
for name, errors in wheel_errors.items():
    told = [f"{round(mean):4} ± {spread:2.0f}" for mean, spread in errors]
    print(f"{name:18}", "  ".join(told), "mm after 1, 4, 16 m")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-wheels"
# Over sixteen times the distance the ticks err by as little as before, slip by
# {= wheel_errors["slip"][2][1] / wheel_errors["slip"][0][1]:.1f =} times as much, and the wrong
# wheel by
# {= wheel_errors["wheels 1 % larger"][2][0] / wheel_errors["wheels 1 % larger"][0][0]:.0f =} times.
# The last is a *bias*: it can be calibrated away, as lesson 01 said. A filter that takes all three
# for independent noise is right about one of them.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## A real lidar
#
# Now to a real RPLIDAR A2. Somebody placed one in a room, recorded {= len(real["turns"][0]) =},
# {= len(real["turns"][1]) =} and {= len(real["turns"][2]) =} turns, and published the recordings.
# They are not ours to give away. You get statistics of them, in a table that comes with the course,
# and every number below is computed from this table, in front of you.

# %% slideshow={"slide_type": "fragment"} name="first-turn" tags=["folded"]
walk = np.array(real["first_turn"]) * a2_at_rest.CELL
simulated = RPLIDAR_A2.scan(worlds.room(), np.zeros(3), np.random.default_rng(3))
fig, _ = views.side_by_side(
    {
        "a real A2, first turn": [Points("scan", walk)],
        "RPLIDAR_A2 in a simulated room": [Points("scan", simulated.points())],
    },
    size=(10, 4.6),
    shared=False,
)
views.show(
    fig, "Left a real room, open at the top to a far wall that looks frayed; right our room."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# On the left you see a room some {= np.ptp(walk[np.abs(walk[:, 1]) < 2, 0]):.0f =} m wide, open at
# the top to a hallway that ends {= walk[:, 1].max():.0f =} m away. (Points are rounded to
# {= 100 * a2_at_rest.CELL:.0f =} cm.) At first sight the two scans are alike.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The number of points a turn
#
# The simulated device has {= RPLIDAR_A2.beams =} beams, always in the same directions. How many
# does the real one have?

# %% slideshow={"slide_type": "fragment"} name="points-a-turn" tags=["nbval-check-output", "code"]
for number, sizes in enumerate(real["turns"], 1):
    print(f"recording {number}: {sizes[0]} points in the first turn, {sizes[-1]} in the last")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The device measures at a steady rate, and in each recording its motor is still gaining speed, so
# that fewer and fewer measurements fit into a turn. Neither the number of beams nor their
# directions are fixed. Whoever compares beam 17 with beam 17 of the next turn compares two
# different places.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## How large is the noise?
#
# The truth is unknown, but the device stands still. So we can compare each reading $r$ with what
# the turn *before* said of its bearing. There it lies a share $\tau$ of the way between two
# readings $r_1$ and $r_2$; if these belong to one smooth surface, a straight line between them will
# do:
#
# $$ \Delta r = r - \bigl((1 - \tau)\, r_1 + \tau\, r_2\bigr). \tag{02.9} $$
#
# Three noises meet in this difference, so its variance is
#
# $$ \operatorname{Var}(\Delta r) = \bigl(1 + (1 - \tau)^2 + \tau^2\bigr)\, \sigma^2. \tag{02.10} $$
#
# We divide $\Delta r$ by the root of the bracket, and what is left errs as one reading does.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Two answers
#
# The package does so for {= real["errors"]["readings"] =} readings (`a2_at_rest.repeats`). There are
# two ways to estimate $\sigma$ from what is left: by the root of the mean square, or by the *median* of the
# absolute values. For a bell curve this median is $0.674\,\sigma$, so 1.483 times the median is
# $\sigma$ again.

# %% slideshow={"slide_type": "fragment"} name="two-answers" tags=["nbval-check-output", "code"]
print(f"by the mean square: σ = {100 * real['errors']['rms']:.2f} % of r")
print(f"by the median:      σ = {100 * real['errors']['median']:.2f} % of r")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first number is where our guess of 0.4 % comes from. If all errors came from one bell curve,
# as wide everywhere, the two would agree. They do not: most readings are better than the mean
# square says, and some are far worse. (Errors beyond 3 %, such as those of people who walk through
# a beam, are left out of the first number.) Which are the worse ones?

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Those at a slant
#
# By (02.6) a reading at a slant is worse. Is this true of the real device? We take ranges of 2 to 4
# m only, sort them by incidence, and compare with (02.6): $c_1$ from the readings that look square
# on, and $\sigma_\beta = 0.1°$ from our guess.

# %% slideshow={"slide_type": "fragment"} name="by-slant" tags=["nbval-check-output", "code"]
tan, share = (np.array(real["by_slant"][name]) for name in ("slant", "share"))
predicted = np.hypot(share[0], tan * np.radians(0.1))
for low, *both in zip(a2_at_rest.SLANTS[:-1], 100 * share, 100 * predicted, strict=True):
    print("{:2} to {}°: σ = {:.2f} % of r, (02.6) says {:.2f} %".format(low, low + 15, *both))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The real device gets worse at a slant. Up to 60°, (02.6) is off by
# {= 100 * abs(share / predicted - 1)[:4].max():.0f =} % at most; beyond, the device is worse than
# predicted. Less light comes back from a slanted wall, too, and these data cannot tell the two
# apart.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Does the noise grow like the range?
#
# Now leave out the readings at a slant ($\tan\iota \ge \tfrac12$). The data sheet, Smolec (who
# simulates 1 %) and our guess agree in one thing: they all name *one* share of the range, for all
# ranges.

# %% slideshow={"slide_type": "fragment"} name="ask-far"
ask(
    "02-far",
    "Over all ranges, the median gave a σ of about 0.25 % of the range. **How does this share compare "
    "near by, at 2.4 m, and far away, at 11.5 m?**",
    {
        "it is the same: σ is a share of the range": "this is what everybody simulates, and it "
        "is what we are about to test.",
        "it is smaller far away: whole millimetres matter less there": "true of the rounding, but a "
        "millimetre is little even at 2.4 m.",
        "it is larger far away": "so σ grows faster than the range itself.",
    },
    right="it is larger far away",
)

# %% slideshow={"slide_type": "fragment"} name="by-range" answers="02-far" tags=["nbval-check-output"]
r_class, share_class = (np.array(real["by_range"][name]) for name in ("range", "share"))
for r, share in zip(r_class, share_class, strict=True):
    print(f"{r:4.1f} m: σ = {100 * share:.2f} % of r, which are {1000 * share * r:4.1f} mm")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Find the law by hand
#
# Let us give the noise both parts that we have met, one that grows with the range and one with
# its square:
#
# $$ \sigma^2 = (c_1\, r)^2 + (c_2\, r^2)^2. \tag{02.11} $$
#
# Here is our first guess. Move the sliders until the curve runs through the marks.


# %% slideshow={"slide_type": "fragment"} name="by-hand" answers="02-far" tags=["folded"]
def law(r, c_1, c_2):
    return np.hypot(c_1, c_2 * r)


def by_hand(c_1_in_percent, c_2_in_mm_per_square_metre):
    """The real device's σ / r over the range, and (02.11) with these constants."""
    constants = c_1_in_percent / 100, c_2_in_mm_per_square_metre / 1000
    off = np.exp(abs(np.log((law(r_class, *constants) + 1e-6) / share_class)).max())
    r = np.linspace(2, 12, 100)
    title = f"At worst, the curve is off by a factor of {off:.2f}"
    fig, ax = views.curves(
        r, {"(02.11)": 100 * law(r, *constants)}, "range r [m]", "σ / r [%]", title, (8, 4.4)
    )
    ax.plot(r_class, 100 * share_class, "o", color=views.COLOURS["truth"], label="real A2")
    ax.axhline(0.75, color=views.COLOURS["limit"], linestyle="dashdot", label="data sheet")
    ax.set_ylim(0, 1.3)
    views.legend(ax, loc="upper left", ncols=3)
    return fig


# %% slideshow={"slide_type": "subslide"} name="by-hand-picture" answers="02-far"
views.explore(
    by_hand,
    lambda c_1_in_percent, c_2_in_mm_per_square_metre: (
        f"The real device's share rises from {100 * share_class[0]:.2f} % to "
        f"{100 * share_class[-1]:.2f} %; a curve with c₁ = {c_1_in_percent:.2f} % and "
        f"c₂ = {c_2_in_mm_per_square_metre:.2f} mm/m²."
    ),
    c_1_in_percent=(0.0, 1.0, 0.4),
    c_2_in_mm_per_square_metre=(0.0, 1.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-far"
# The guess fits at {= np.interp(0.004, share_class[4:], r_class[4:]):.1f =} m and nowhere else. At
# {= r_class[0]:.1f =} m the real device is {= 0.004 / share_class[0]:.1f =} times better, and at
# {= r_class[-1]:.1f =} m {= share_class[-1] / 0.004:.1f =} times worse. The data sheet's 0.75 %
# lies above all marks: it is a promise, not a description.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Find it by least squares
#
# Divide (02.11) by $r^2$. The square of the share, $\sigma^2/r^2 = c_1^2 + c_2^2\, r^2$, is a
# straight line over $r^2$, and a line can be fitted:

# %% slideshow={"slide_type": "fragment"} name="least-squares" tags=["nbval-check-output", "code"]
squares = np.polyfit(r_class**2, share_class**2, 1, w=1 / share_class**2)
c_2, c_1 = np.sqrt(squares)
print(f"fitted: c₁ = {100 * c_1:.2f} %, c₂ = {1000 * c_2:.2f} mm/m²")
off = law(r_class, c_1, c_2) / share_class
print(f"from {off.min():.2f} to {off.max():.2f} times the real σ")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The part with $r^2$ is what the data ask for. Where have we met it before?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## The fingerprint
#
# By (02.8) noise that grows with $r^2$ is what a sensor makes that measures $1/r$. If the A2 is
# one, and counts $1/r$ in whole steps of some size, then $r$ comes in steps, too. A small step of
# $1/r$ is a step of $r$ that is $r^2$ times as large. We can look for these steps: which values of
# $r$, in millimetres, ever occur?

# %% slideshow={"slide_type": "fragment"} name="fingerprint" tags=["nbval-check-output", "code"]
for (low, high), values in zip(a2_at_rest.WINDOWS, real["steps"], strict=True):
    step, r = np.median(np.diff(values)), (low + high) / 2
    print(f"{low:4.1f} m: {values[:5]} …  step {step:2.0f} mm, step / r² = {step / r**2:.2f} mm/m²")

# %% [markdown] slideshow={"slide_type": "fragment"}
# At 11 m a range is {= np.diff(real["steps"][3]).min() =} or {= np.diff(real["steps"][3]).max() =}
# mm from the next, and nothing in between *ever* occurs in {= sum(map(len, real["turns"])) =}
# turns. At 7 m the step is {= np.median(np.diff(real["steps"][2])):.0f =} mm, at 4.6 m
# {= np.median(np.diff(real["steps"][1])):.0f =} mm: each time about
# {= np.median(np.diff(real["steps"][3])) / 11.2**2:.1f =} mm/m² times $r^2$. (At 3 m it drowns in
# the whole millimetres of the recording.) The steps of $r$ grow as equal steps of $1/r$ do, so the
# device measures $1/r$: it triangulates, as the infrared sensor does. We needed no data sheet; the
# numbers told us.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is the one moment of detective work, so give it time. Let the class
# compute the step at 11 m from that at 7 m before you run the cell. Can the method be trusted? The
# simulated `RPLIDAR_A2` has no steps, and its neighbouring values are mostly a millimetre apart, at
# 7 m as at 3 m.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Readings that never come
#
# {= 100 * real["empty"]["readings"]:.1f =} % of the real device's readings are empty, and so our
# guess drops 3 % of its beams, each by chance.

# %% slideshow={"slide_type": "fragment"} name="ask-empty"
ask(
    "02-empty",
    "**Where in a turn are the real device's empty readings?**",
    {
        "anywhere, as with the guess": "it is the simplest way to simulate them, and the picture "
        "will refute it.",
        "in the same directions, turn after turn": "they look past edges, through the open side, or "
        "at something that the device cannot see.",
        "in a few bad turns": "then the device would fail for a moment; it hardly ever does.",
    },
    right="in the same directions, turn after turn",
)

# %% slideshow={"slide_type": "subslide"} name="empties" answers="02-empty" tags=["folded"]
title = "Each empty reading of 22 turns; below them, one simulated turn"
fig, ax = views.chart("bearing [degrees]", "turn", title, (10, 4))
for number, bearings_empty in enumerate(real["empty"]["bearings"]):
    ax.plot(bearings_empty, [number] * len(bearings_empty), "|", color=views.COLOURS["truth"])
chance = guess.scan(worlds.room(), np.zeros(3), np.random.default_rng(7))
lost = np.degrees(chance.angles[np.isnan(chance.ranges)]) % 360
ax.plot(lost, [-3] * len(lost), "|", color=views.COLOURS["scan"])
rows = {-3: "simulated", 0: "0", 5: "5", 10: "10", 15: "15", 20: "20"}
ax.set(xlim=(0, 360), yticks=list(rows), yticklabels=list(rows.values()))
views.show(fig, "Empty readings stand above each other in a few directions, turn after turn.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-empty"
# They stand in columns. The slanted line is the edge of a person who walks by. So most empties are
# no failures; they say "nothing here that I can see", and that is knowledge. A **dropout** is an
# empty reading where there *is* a surface. Where the turns before and after both saw one,
# {= 100 * real["empty"]["lost"][1]:.1f =} % of the readings are empty; where only the turn before
# is asked, people included, it is {= 100 * real["empty"]["lost"][0]:.1f =} %. The truth lies
# between the two, far below 3 %.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## What the simulator has, and what it lacks
#
# From now on we use the preset `RPLIDAR_A2`. It comes from a finer fit than ours, over all ranges
# and slants at once. A claim about a device has to be tested, so we set preset and guess into
# simulated rooms of all sizes and treat their scans as we treated the real ones:


# %% slideshow={"slide_type": "fragment"} name="bench"
def on_the_bench(device, distance):
    """σ / r of a simulated device at rest, its walls at that distance, measured as above."""
    square = World(worlds.box((0, 0), (2 * distance, 2 * distance)))
    device, rng = replace(device, range_max=20.0), np.random.default_rng(9)
    rows = a2_at_rest.repeats([device.scan(square, np.zeros(3), rng) for _ in range(20)])
    return a2_at_rest.by_range(rows, edges=(0.9 * distance, 1.2 * distance))["share"][0]


benches = {
    name: np.array([on_the_bench(device, distance) for distance in r_class])
    for name, device in {"RPLIDAR_A2": RPLIDAR_A2, "first guess": guess}.items()
}

# %% slideshow={"slide_type": "-"} name="bench-picture" tags=["folded"]
shown = {name: 100 * shares for name, shares in benches.items()}
labels = "range r [m]", "σ / r [%]", "At rest, by the median"
fig, ax = views.curves(r_class, shown, *labels, size=(8, 4))
ax.plot(r_class, 100 * share_class, "o", color=views.COLOURS["truth"], label="real A2")
ax.set_ylim(0, 0.9)
views.legend(ax, loc="upper left")
apart = max(benches["RPLIDAR_A2"] / share_class, key=lambda ratio: abs(np.log(ratio)))
views.show(
    fig, "The preset rises with the range as the real device does; the first guess stays level."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The preset follows the real device; at worst, its σ is {= apart:.2f =} times the real one. The
# guess is level. Where would a filter that believed in the guess suffer, near by or far away?

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A list of what is missing
#
# | of the real device | in the simulator |
# | --- | --- |
# | σ grows with $r^2$ | yes |
# | worse at a slant | yes, up to 60° |
# | steps of $1/r$, {= np.diff(real["steps"][3]).max() =} mm at 11 m | no |
# | dropouts | by chance, {= 100 * RPLIDAR_A2.dropouts:.1f =} % everywhere |
# | empties past edges and into the open | only beyond the range |
# | number and directions of beams change | no |
# | errors that repeat from turn to turn | no, and a device at rest cannot tell |
# | dark, shiny, transparent surfaces | no, and these recordings cannot tell |
#
# A simulator need not have everything. Its user must know what it lacks.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which of the rows matter for a filter, which has to weigh a near reading
# against a far one, and which for a map of free space.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## Who had the idea
#
# - Kurt Konolige and others, *A low-cost laser distance sensor*, ICRA 2008: a turning lidar that
#   triangulates, and why its error grows with the square of the range.
# - John Leonard and Hugh Durrant-Whyte, *Directed Sonar Sensing for Mobile Robot Navigation*, 1992: what
#   a cone of sound sees of walls and corners.
# - Frank Hampel, *The influence curve and its role in robust estimation*, Journal of the American
#   Statistical Association, 1974: the spread as the median gives it.
#
# **Read next:** Sebastian Thrun, Wolfram Burgard and Dieter Fox, *Probabilistic Robotics*, 2005,
# chapter 6, on how range finders err among people and edges.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What comes next
#
# You can compute what a sensor sees, carry it into the world, and test what somebody claims about
# its noise.
#
# **Exercise:** [cast rays, hear echoes, place a scan, and find the noise of a sensor in a busy
# room](../exercises/ex02_sensors_and_worlds.ipynb), 60 minutes.
#
# **Next:** every reading is a little wrong, and so is every belief about the robot. How much weight
# does each deserve? [03 · The Kalman filter](03_kalman_filter.ipynb) derives it. What stands below
# is optional.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a round pillar
#
# Table legs and pillars are circles. Let the centre lie $\xi$ *along* the beam and $\eta$ *beside*
# it, and let $\varrho$ be the radius. The point at range $r$ is on the circle where
#
# $$ (r - \xi)^2 + \eta^2 = \varrho^2. \tag{02.12} $$

# %% slideshow={"slide_type": "fragment"} name="pillar" tags=["nbval-check-output"]
r, xi, eta, radius = sp.symbols("r xi eta varrho", positive=True)
sp.solve(sp.Eq((r - xi) ** 2 + eta**2, radius**2), r)

# %% slideshow={"slide_type": "fragment"} name="tower" tags=["nbval-check-output"]
tower = World(circles=[(3.0, 0.0, 0.5)])
for story, x, y in [("from outside", 0, 0.3), ("from inside", 3.1, 0.3), ("passing by", 0, 0.7)]:
    roots = 3 - x + np.array([-1, 1]) * np.sqrt(0.25 - y**2 + 0j)
    print(f"{story:13} roots {roots.round(3)}, cast {tower.cast((x, y), [0.0])[0]:.3f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# A sensor reports the nearest root that is not behind it: the first from outside, the second from
# inside, say in a round tower. Complex roots mean that the beam passes by.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a world is a text file
#
# Four numbers are a wall, three a circle, and `#` begins a comment. So you can measure your own
# room, write it down, read it with `worlds.load`, and see what a lidar sees of it.

# %% slideshow={"slide_type": "fragment"} name="world-file" tags=["nbval-check-output"]
MY_ROOM = """
-1 -1  3 -1    # four walls and a pillar
 3 -1  3  2
 3  2 -1  2
-1  2 -1 -1
1.5 0.8 0.3
"""
mine = worlds.parse(MY_ROOM, "my room")
print(len(mine.walls), "walls,", len(mine.circles), "circle")
again = worlds.parse(worlds.text_of(mine), "again")
print("written and read again, the same:", np.array_equal(mine.walls, again.walls))

# %% [markdown] slideshow={"slide_type": "fragment"}
# What should a program say to a wall without length, to a word in place of a number, to a line with
# five numbers? At least which line it is, and what is wrong with it:

# %% slideshow={"slide_type": "fragment"} name="broken-files" tags=["nbval-check-output"]
for line in ("1 1 1 1", "0 0 one 2", "0 0 1 1 1", "2 2 -0.1", "0 0 1 nan"):
    try:
        worlds.parse(MY_ROOM + line, "my room")
    except ValueError as refused:
        print(refused)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: your own copy of the recordings
#
# `sources.recording("rplidar-a2-1")` says where the recordings are published and where to put them.
# This line, in a terminal, then makes the table of this lesson from them:
#
#     python -m slamlab.studies.a2_at_rest --out my-a2.json

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print: the beam's quadrant (optional)
#
# You need this only if you read the original.
#
# | Where | Printed | Right | Harm |
# | --- | --- | --- | --- |
# | Smolec, chapter 3, simulated lidar | the crossing counts if it lies in the same quadrant as the beam | if $r \ge 0$, (02.2) | a beam along an axis lies in no quadrant; what becomes of it is left to rounding |

# %% slideshow={"slide_type": "fragment"} name="quadrants" tags=["nbval-check-output"]
for degrees in (0, 25, 90, 180, 270):
    n = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))]).round(9)
    meeting = 3.0 * n  # with a wall that stands across the beam, 3 m away
    same = bool(np.all(n * meeting > 0))
    print(f"{degrees:3}°: same quadrant {same!s:5}  r = {n @ meeting:.0f} m, so it is met")
