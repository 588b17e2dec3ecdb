# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 02 · Sensors, odometry and simulated worlds
#
# **You will be able to** compute what a range sensor measures in a known world, transform its
# measurements into the world frame, state the noise of a sensor and test this statement on data of a real
# sensor, and derive wheel odometry with its covariance.
#
# **80 minutes** in three parts: what a range sensor measures (25), what errors its measurements have (37), and
# wheel odometry (18). **Before:** lesson [01](01_why_slam.ipynb); two linear equations in two unknowns; the
# standard
# deviation.
#
# The main idea: a simulator is a model of a device, and we can test it like any other model.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Part one is geometry, parts two and three are statistics and motion. If time is
# short, leave out "Motion distortion" and "The covariance of wheel odometry". Students remember the end of part
# two best, where the data of a real device show its principle of measurement. These polls work well: the wall
# behind the sensor, the forgotten minus sign, the three errors of a wheel.

# %% slideshow={"slide_type": "skip"} name="imports" tags=["folded"]
from dataclasses import replace

import numpy as np
import sympy as sp

from classroom.checks import ask, compare
from course.studies import rplidar_a2_noise
from slamlab import views
from slamlab.devices.rplidar.revolutions import robot_frame
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.live.editor import edit_world
from slamlab.models import noise
from slamlab.readings import Scan
from slamlab.simulation import (
    GP2D120,
    RPLIDAR_A2,
    ULTRASONIC,
    DifferentialDrive,
    Scanner,
    Simulator,
    worlds,
)
from slamlab.simulation.differential_drive import arc
from slamlab.simulation.worlds import World

real = rplidar_a2_noise.stored()  # statistics of a real lidar, for part two

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Ray casting: one beam, one wall
#
# A lidar emits light and measures the distance to the surface that reflects it. A *time-of-flight*
# lidar measures the **time of flight** $t$ of a light pulse to the surface and back: with the speed of light
# $c$, the range is $c\,t/2$. A later section explains another principle, triangulation. A **sensor model**
# predicts such a measurement from the pose of the sensor and the world. Its core is **ray casting**:
# computing where a beam first meets a surface.
#
# We choose the sensor as the origin. The beam leaves in the direction $\varphi$, along the unit vector
# $n = (\cos\varphi, \sin\varphi)^{\mathsf T}$, and after a range $r$ it reaches the point $r\,n$. The wall
# goes from $p_1$ to $p_2$. The point at the fraction $\tau$ of its length is $p_1 + \tau\,(p_2 - p_1)$. Where
# beam and wall meet, the two points are the same:
#
# $$ r\,n = p_1 + \tau\,(p_2 - p_1). \tag{02.1} $$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-ray-casting-one-beam-one-wall"
# *For the lecturer:* The usual misconception is that the formula alone decides whether a beam meets a wall.
# Turn the beam away from the wall "behind" and ask for the sign of $r$ before anybody reads the label. If
# time is short, skip the outputs of sympy and show (02.2).

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Two equations, two unknowns
#
# We know the beam and the wall, and solve for $r$ and $\tau$. Written for $x$ and for $y$, (02.1) is a linear
# system of two equations, which the first output below shows. The system has one solution unless its
# determinant is zero. The second output is this solution, $r$ above $\tau$. The denominator is the determinant,
# up to its sign.

# %% slideshow={"slide_type": "fragment"} name="system" tags=["nbval-check-output"]
phi, x_1, y_1, x_2, y_2 = sp.symbols("varphi x_1 y_1 x_2 y_2", real=True)
n, p_1, p_2 = sp.Matrix([sp.cos(phi), sp.sin(phi)]), sp.Matrix([x_1, y_1]), sp.Matrix([x_2, y_2])
M = sp.Matrix.hstack(n, p_1 - p_2)
display(sp.Eq(sp.MatMul(M, sp.Matrix(sp.symbols("r tau"))), p_1, evaluate=False))
r_and_tau = (M.inv() * p_1).applyfunc(sp.simplify)
r_and_tau

# %% slideshow={"slide_type": "subslide"} name="ask-meet"
ask(
    "02-meet",
    "A beam is a ray, which goes forwards only. A wall is a segment, which has two ends. But "
    "(02.1) describes two *lines*. **A wall stands behind the sensor, across the line of the "
    "beam. What does the formula give?**",
    {
        "the determinant is zero": "the determinant is zero if beam and wall are parallel; these "
        "two lines cross.",
        "r is below zero": "the crossing lies behind the sensor, and the beam goes forwards only.",
        "τ is below 0 or above 1": "then the lines would cross beyond the ends of the wall. Here they "
        "cross between the ends, but behind the sensor.",
        "nothing unusual: r is its distance": "the absolute value is right, but the sign is "
        "negative; a simulator that ignores the sign returns ranges of walls behind the beam.",
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
    """The four walls, r and τ of each, and the range of the beam."""
    turn, shift = np.radians(np.float64(beam_in_degrees)), np.array([sensor_x, 0])
    ahead = np.array([np.cos(turn), np.sin(turn)])
    cast = World(list(FOUR_WALLS.values())).cast(shift, [turn])[0]
    meets = f"meets a wall after r = {cast:.2f} m" if cast < np.inf else "meets nothing"
    layers = [
        Segments("walls", list(FOUR_WALLS.values())),
        Segments("scan", [[*shift, *(shift + min(cast, 4) * ahead)]]),
        Poses("robot", [[*shift, turn]]),
    ]
    fig, (ax,) = views.side_by_side({f"The beam {meets}": layers}, size=(8, 5))
    for name, wall in FOUR_WALLS.items():
        with np.errstate(divide="ignore"):
            r, tau = crossing(turn, *(np.array(wall) - [*shift, *shift]))
        label = f"{name}\nr = {r:.2f}, τ = {tau:.2f}" if abs(r) < 99 else f"{name}\nno crossing"
        ax.annotate(label, wall[2:], xytext=(7, 0), textcoords="offset points", va="center")
    ax.margins(0.12)
    return fig


# %% slideshow={"slide_type": "subslide"} name="four-walls-picture" answers="02-meet"
views.explore(
    four_walls,
    "A beam and four walls; a label at each wall gives its r and τ, and the title the beam's range.",
    beam_in_degrees=(-180, 180, 25),
    sensor_x=(-1.0, 3.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} name="beam-meets-wall" answers="02-meet"
# The wall "behind" has $r < 0$, and the wall "beside" has $\tau > 1$. The wall "parallel" has no crossing: its
# determinant is zero. The beam meets a wall where
#
# $$ r \ge 0 \quad\text{and}\quad 0 \le \tau \le 1. \tag{02.2} $$
#
# Turn the beam until it meets the wall "behind" or "beside", and observe which of the two numbers changes.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## A scan: ranges over bearings
#
# A scan has hundreds of beams. We intersect each beam with every wall and keep the nearest hit: this hit hides
# all surfaces behind it (*occlusion*). The library does this in `World.cast`. The function first finds the
# interval of
# directions that each wall covers, because only the beams inside it can meet the wall.
#
# The sensor returns a list of ranges $r$, one for each bearing $\beta$ of its **field of view**, the
# sector that it covers. Here the field of view is 360°. With
#
# $$ p_{\mathrm s} = (r \cos\beta,\; r \sin\beta)^{\mathsf T}, \tag{02.3} $$
#
# where $\mathrm s$ stands for the sensor frame, the list becomes a set of points.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-a-scan-ranges-over-bearings"
# *For the lecturer:* Draw the axes of $r$ over $\beta$ on the board, and let a student draw the wall before
# the poll; most draw a straight line. Then ask in which direction the left plot will shift when the robot
# turns.

# %% slideshow={"slide_type": "subslide"} name="ask-arc"
ask(
    "02-arc",
    "A robot stands beside a long straight wall and plots the raw list, $r$ against "
    "$\\beta$. "
    "**What does the wall look like?**",
    {
        "a straight line": "the wall is straight in x and y. Plotted against the bearing, its "
        "range grows more and more steeply to either side.",
        "level: the wall's distance does not change": "the distance of the wall is "
        "the shortest range; all other ranges are longer.",
        "an arc, lowest where the beam meets the wall at a right angle": "to either side the "
        "beams hit the wall farther away, at a larger angle of incidence.",
        "an arc, highest where the beam meets the wall at a right angle": "at this bearing the "
        "wall is nearest, so the range is shortest.",
    },
    right="an arc, lowest where the beam meets the wall at a right angle",
)


# %% slideshow={"slide_type": "subslide"} name="polar" answers="02-arc" tags=["folded"]
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


views.explore(
    two_pictures,
    "Left: ranges over bearings, with arcs and jumps. Right: the same scan as points along walls.",
    beams=(40, 3600, 400),
    heading_in_degrees=(-180, 180, 0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-arc"
# In the left plot every straight wall is an arc. Where two walls meet, two arcs meet; at the edge of a surface
# that hides another surface, $r$ *jumps*. Turn the robot: the left plot shifts sideways, and the right plot
# rotates
# in the direction opposite to the robot, because the robot frame turns with the robot.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Angle of incidence and point spacing
#
# A straight wall stands at the distance $\rho$, and its normal points in the direction $\alpha$. The beam
# at the bearing $\beta$ meets it under the **angle of incidence** $\iota = \beta - \alpha$, measured from
# the normal. The range is
#
# $$ r = \frac{\rho}{\cos\iota}. \tag{02.4} $$
#
# Two beams that are a small angle $\Delta\beta$ apart hit the wall $r\,\Delta\beta / \cos\iota$ apart.
# With 400 beams this is {= 1000 * 3 * np.radians(0.9):.0f =} mm on a wall 3 m ahead, but
# {= 100 * 8 * np.radians(0.9) / np.cos(np.radians(70)):.0f =} cm on a wall 8 m away at $\iota = 70°$. With 40
# beams some walls get only two or three points, too few to find the ends of these walls. Smolec's thesis, one of
# the sources of this course, simulates 3600 beams.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** A long wall stands 3 m ahead ($\alpha = 0$). Compute its range at each bearing `beta`.

# %% slideshow={"slide_type": "fragment"} name="turn-ranges" tags=["your-turn"]
beta = np.radians([-60, -30, 0, 30, 60])
ranges = ...  # an array of five ranges
compare(ranges, World([(3, -20, 3, 20)]).cast((0, 0), beta))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# beta = np.radians([-60, -30, 0, 30, 60])
# ranges = 3 / np.cos(beta)
# ```
#
# These ranges form the arc of the question: 3 m at its lowest point, and 6 m at 60°.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Three frames: sensor, robot, world
#
# A scan is measured in the **sensor frame**. The sensor is mounted on the *robot*, seldom at its centre, and the
# robot stands somewhere in the *world*. So we need two poses to place a measurement in the map: the pose of the
# sensor in the robot frame, its *mount* $b$, and the robot's pose $x$ in the world frame. We apply (01.3)
# twice, first with the mount, then with the robot's pose:
#
# $$ p_{\mathrm r} = \begin{pmatrix} x_b \\ y_b \end{pmatrix} + \mathrm{Rot}(\theta_b)\,
# p_{\mathrm s}, \qquad
# p = \begin{pmatrix} x \\ y \end{pmatrix} + \mathrm{Rot}(\theta)\, p_{\mathrm r}. \tag{02.5} $$
#
# One transformation with the sensor's pose in the world frame, $x \oplus b$, gives the same result.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-three-frames-sensor-robot-world"
# *For the lecturer:* Use your body: you are the robot, and your outstretched left arm is the sensor. Ask the
# class for the direction of the wall while you turn.

# %% slideshow={"slide_type": "subslide"} name="mounted" tags=["nbval-check-output", "code"]
mount = np.array([0.2, 0.0, np.pi / 2])  # 20 cm ahead of the middle, faces left
pose = np.array([2.0, 1.0, np.pi / 2])  # at (2, 1), faces along +y
in_sensor = np.array([[3.0, 0.0]])  # 3 m, straight ahead
in_robot = transform(mount, in_sensor)
in_world = transform(pose, in_robot)
print("in the robot frame:", in_robot[0].round(3))
print("in the world frame:", in_world[0].round(3))

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Check both printed lines by hand. Then compute the point in the world frame in one step, from
# `in_sensor` with `transform` and `compose`.

# %% slideshow={"slide_type": "fragment"} name="turn-frames" tags=["your-turn"]
at_once = ...
compare(at_once, in_world)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# at_once = transform(compose(pose, mount), in_sensor)
# ```
#
# With `compose(mount, pose)` you also get a point. This point is meaningless, but you get no error message.
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A wrong mount
#
# A single scan looks right with any assumed mount, because a wrong mount only shifts or rotates the whole scan.
# So let the robot turn on the spot and draw five scans into one map. The sensor is mounted 20 cm ahead of the
# middle of the robot, but the program assumes that the sensor is *in* the middle:


# %% slideshow={"slide_type": "subslide"} name="five-scans" tags=["folded"]
def five_scans(assumed_ahead, assumed_turn_in_degrees):
    """Five scans from five headings, placed with a mount that may be wrong."""
    true, rng = np.array([0.2, 0.0, 0.0]), np.random.default_rng(0)
    assumed = np.array([assumed_ahead, 0.0, np.radians(assumed_turn_in_degrees)])
    fig, ax = views.axes("Five scans of one room by a robot that turns on the spot", size=(8, 5.2))
    for turn in np.radians([0, 70, 140, 210, 280]):
        stands = np.array([0.5, 0.2, turn])
        seen = ideal(400).scan(worlds.room(), compose(stands, true), rng).points()
        placed = transform(compose(stands, assumed), seen)
        views.draw(ax, Points("scan", placed), label="points of the five scans", markersize=4)
    views.draw(ax, Poses("robot", [[0.5, 0.2, 0.0]]), label="robot, at its first heading")
    views.legend_below(fig)
    return fig


views.explore(
    five_scans,
    lambda assumed_ahead, assumed_turn_in_degrees: (
        f"Five scans with the mount assumed {assumed_ahead:.2f} m ahead, and rotated by "
        f"{assumed_turn_in_degrees:.0f}°: the walls coincide only if both are right."
    ),
    assumed_ahead=(0.0, 0.4, 0.0),
    assumed_turn_in_degrees=(-20.0, 20.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Every wall appears several times. The sensor was at five positions on a circle, and the program puts all of
# them at the centre of this circle. Move the first slider to 0.20, and the walls coincide. Estimating the mount
# in this way is an *extrinsic calibration*. Now move the second slider. Could you detect the rotation of the
# mount if the robot never moved?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Units and signs of a device
#
# An RPLIDAR reports angles in *degrees*, counted *clockwise* from its front, ranges in *millimetres*, and the
# range 0 for "no return". The course uses radians, counted counter-clockwise, metres and NaN. If a program
# converts units in several places, it may convert a value twice. So the library converts them in one place,
# where it receives the readings:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-units-and-signs-of-a-device"
# *For the lecturer:* Ask who could notice the mistake in a single scan, and let the class invent a test that
# finds it. (The robot turns on the spot between two scans.)

# %% slideshow={"slide_type": "fragment"} name="robot-frame" tags=["nbval-check-output", "code"]
angles, ranges = robot_frame(angle_deg=[0.0, 90.0, 270.0], range_mm=[1500.0, 800.0, 0.0])
print(np.degrees(angles), "degrees,", ranges, "m")

# %% slideshow={"slide_type": "subslide"} name="ask-minus"
ask(
    "02-minus",
    "A program ignores that the device counts clockwise: every bearing has the wrong sign. The robot "
    "scans, turns by 40° on the spot, scans again, and draws both into one map. **By how much "
    "are the two scans rotated relative to each other?**",
    {
        "not at all: both are mirrored alike": "both scans are mirrored, but each in its own "
        "frame, and the frame has turned.",
        "by 40°": "this would be the effect of ignoring the *turn*. With the wrong sign, the "
        "scan also turns in the wrong direction.",
        "by 80°": "the mirrored room turns by 40° in the wrong direction, and the pose adds 40° more.",
    },
    right="by 80°",
)


# %% slideshow={"slide_type": "subslide"} name="minus" answers="02-minus" tags=["folded"]
def two_scans(turned_by_degrees, minus_forgotten):
    """Two scans before and after a turn on the spot, placed with the right or the wrong sign."""
    fig, ax = views.axes("Two scans of one room from one position", size=(8, 5.4))
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
# Each mirrored scan looks like the scan of a plausible room. Only a person who knows the room will notice the
# mistake. After the turn the two scans are rotated relative to each other by *twice* the turn. So test a driver
# with a robot that turns.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Motion distortion
#
# A scan takes time: a tenth of a second at 10 revolutions per second. During this time a robot at 0.5 m/s moves
# by 5 cm, and a robot that rotates at 90°/s turns by 9°. Each beam therefore starts from a different pose. If
# all
# ranges are drawn from one pose, the scan shows **motion distortion** (also *skew*; the *rolling
# shutter* of a camera has the same effect).
# The left plot draws all points of a scan from the pose of its first beam; the right plot draws each point from
# the pose of its own beam:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-motion-distortion"
# *For the lecturer:* If time is short, leave out this section. Otherwise set the speed to zero and keep the
# rotation: the class sees that rotation distorts the far walls most.


# %% slideshow={"slide_type": "subslide"} name="motion" tags=["folded"]
def scan_in_motion(v, omega, turn_time=0.1):
    """Points of a scan of the moving lidar: from its first pose, and deskewed."""
    angles, shares = ideal(400).angles, np.arange(400) / 400
    left, right = (v + np.array([-1, 1]) * omega * 0.15) * turn_time  # of both wheels [m]
    poses = np.array([arc(s * left, s * right, 0.3) for s in shares])
    room, beams = worlds.room(), zip(poses, angles, strict=True)
    ranges = np.array([room.cast(pose[:2], [pose[2] + angle])[0] for pose, angle in beams])
    points = Scan(angles, ranges).points()
    return points, np.array([transform(*each) for each in zip(poses, points, strict=True)])


def draw_motion(v, omega_in_degrees):
    distorted, deskewed = scan_in_motion(v, np.radians(omega_in_degrees))
    layers = {"from one pose": distorted, "deskewed": deskewed}
    return views.side_by_side(
        {name: [Points("scan", points)] for name, points in layers.items()}, size=(9, 4.6)
    )[0]


views.explore(
    draw_motion,
    lambda v, omega_in_degrees: (
        f"A scan at {v:.1f} m/s and {omega_in_degrees}°/s. Right, deskewed: the walls are straight. "
        "Left: the walls are bent and do not meet behind the robot, unless it stands still."
    ),
    v=(0.0, 1.0, 0.5),
    omega_in_degrees=(-180, 180, 90),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# In the left plot the scan does not close behind the robot, where its first and last beams meet. The correction
# in the right plot is called **deskewing**. Deskewing requires the motion during the scan, for example from
# odometry. The
# simulated scans of the next lessons are cast from one pose, so they have no motion distortion. The
# scans of the emulated lidar in lesson 14 have it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Part two: systematic and random errors
#
# *This is a good place for a break.*
#
# So far our lidar has made no errors. The measurements of a real lidar have **systematic and random errors**. A **random
# error** differs from one measurement to the next. Its mean is zero, and its **variance** $\sigma^2$ states how
# large it typically is.
# The random error of a sensor is called **measurement noise**. A **systematic error** repeats in each
# measurement, and a constant systematic error is a **bias**. Averaging reduces independent random errors; a
# systematic
# error needs calibration. An **outlier** is a measurement whose error has another cause and is far beyond the noise.
#
# Before we examine a real device, we make a **first guess** of its sensor model, with round numbers for an
# RPLIDAR A2. The model has noise in the range and in the direction of each beam, and *dropouts*, beams without
# a return. Part two tests this guess on data.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-part-two-systematic-and-random-errors"
# *For the lecturer:* Students confuse the two kinds. Ask for the kind of error of a ruler with a worn end, of
# a trembling hand, and of a clock that is five minutes fast.

# %% slideshow={"slide_type": "fragment"} name="guess" tags=["nbval-check-output", "code"]
guess = Scanner(beams=400, range_error=0.004, bearing_sigma=np.radians(0.1), dropouts=0.03)
print(f"range: σ = {100 * guess.range_error:.1f} % of r")
print(f"bearing: σ = {np.degrees(guess.bearing_sigma):.1f}°")
print(f"lost: {100 * guess.dropouts:.0f} % of the beams")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### From the error of a bearing to an error of the range
#
# An error of a tenth of a degree seems negligible. But a beam with a bearing error meets the wall at another
# point. At a large angle of incidence this point can be much farther away. By what share of the range does the
# range change per radian of bearing error? We differentiate (02.4):

# %% slideshow={"slide_type": "fragment"} name="slope" tags=["nbval-check-output"]
rho, iota = sp.symbols("rho iota", positive=True)
r_wall = rho / sp.cos(iota)
sp.simplify(sp.diff(r_wall, iota) / r_wall)

# %% [markdown] slideshow={"slide_type": "fragment"}
# So a small error of the bearing changes the range by $r \tan\iota$ times this error, to first order.
# The range measurement also has a noise of its own; let its standard deviation be $c_1 r$. If the two errors
# are independent, their variances add:
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
        0.57: "this is 5.7 · 0.1, computed in degrees: the derivative holds for radians.",
        57: "this is 5.7 · 0.1 in degrees, times 100: the derivative holds for radians.",
        0.17: "this is the error of the bearing itself, without the angle of incidence.",
        0.01: "this is the share of r; in per cent the number is a hundred times larger.",
        1.07: "this is both parts together; the question asks for the part of the bearing alone.",
    },
)

# %% slideshow={"slide_type": "fragment"} name="slant" answers="02-slant" tags=["folded"]
hall = worlds.corridor()
bearings = guess.angles
straight = hall.cast((0, 0), bearings)
incidence = np.arctan(abs(hall.cast((0, 0), bearings + 1e-6) - straight) / 1e-6 / straight)


def at_rest(bearing_error_in_degrees, range_error_in_percent):
    """σ of 300 ranges of each beam in a corridor, over the incidence; and (02.6)."""
    c_1, sigma_beta = range_error_in_percent / 100, np.radians(bearing_error_in_degrees)
    rng = np.random.default_rng(2)
    device = replace(guess, range_max=20.0, range_error=c_1, bearing_sigma=sigma_beta)
    ranges = np.array([device.scan(hall, np.zeros(3), rng).ranges for _ in range(300)])
    shares = 100 * np.nanstd(ranges, axis=0) / straight
    at = np.radians(np.linspace(0, 84, 100))
    law = 100 * np.hypot(c_1, np.tan(at) * sigma_beta)
    title = "Standard deviation of 300 ranges of each beam"
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
        "The σ of each beam lies on a curve that begins at "
        f"{range_error_in_percent:.1f} % of the range and rises with the angle of incidence."
    ),
    bearing_error_in_degrees=(0.0, 0.3, 0.1),
    range_error_in_percent=(0.0, 1.0, 0.4),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-slant"
# Most marks lie on the curve: 0.4 % at normal incidence, and more than twice as much beyond 80°. The other
# marks belong to beams that pass close to an edge or a corner, and meet sometimes one surface, sometimes the
# other. The errors of these beams are not Gaussian. A real beam has a width, and can even return ranges between
# the two surfaces, **mixed pixels**.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## An infrared sensor: triangulation
#
# The robot of the MAK thesis, another source of this course, carries a Sharp GP2D120 on a servo, with a field
# of view of 178°. The sensor emits infrared light. A detector at a small distance to the side, the *baseline*,
# measures the angle at which the spot on the wall appears. This method is called **triangulation**. The farther
# away the wall is, the less the angle changes with the range. The sensor's voltage $U$ is roughly
#
# $$ U = \frac{\kappa}{r}. \tag{02.7} $$
#
# Let the noise $\sigma_U$ of the voltage be the same at every range. How does this noise affect the range? We
# solve for $r$, differentiate, and insert (02.7) again:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-an-infrared-sensor-triangulation"
# *For the lecturer:* Hold up a finger and look at it with one eye, then with the other: the jump of the
# finger is the angle that the detector measures. Ask how the jump changes at twice the distance.

# %% slideshow={"slide_type": "fragment"} name="voltage" tags=["nbval-check-output"]
U, kappa, sigma_U, r = sp.symbols("U kappa sigma_U r", positive=True)
sigma_of_range = sp.Abs(sp.diff(kappa / U, U)).subs(U, kappa / r) * sigma_U
sigma_at = sp.lambdify(r, sigma_of_range.subs({kappa: 0.12, sigma_U: 0.015}))
sigma_of_range

# %% [markdown] slideshow={"slide_type": "fragment"}
# To first order, the noise grows with the **square** of the range:
#
# $$ \sigma = c_2\, r^2 \quad\text{with}\quad c_2 = \sigma_U / \kappa. \tag{02.8} $$
#
# A later section uses this result again.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** For $\kappa = 0.12$ V m and $\sigma_U = 15$ mV, compute $\sigma$ in metres at 5 cm, 10 cm and
# 28 cm.

# %% slideshow={"slide_type": "fragment"} name="turn-voltage" tags=["your-turn"]
sigmas = ...  # a list or an array of three numbers [m]
compare(sigmas, sigma_at(np.array([0.05, 0.1, 0.28])))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# sigmas = 0.015 / 0.12 * np.square([0.05, 0.1, 0.28])
# ```
#
# The σ is {= 1000 * 0.125 * 0.05**2:.1f =} mm at 5 cm and {= 1000 * 0.125 * 0.28**2:.0f =} mm at 28 cm.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## An ultrasonic sensor: a wide beam
#
# An *ultrasonic* sensor emits a cone of sound. It measures the time of flight of the first echo, from
# any direction in the cone. In our example the sensor stands in a room, 2 m in front of the middle of an open
# door. The door is 1 m wide, and a second wall stands beyond it. In our model every surface in the cone
# returns an echo. (A real smooth wall reflects sound like a mirror, and at a large angle of incidence it
# returns none.)

# %% [markdown] slideshow={"slide_type": "notes"} name="note-an-ultrasonic-sensor-a-wide-beam"
# *For the lecturer:* If the class answers 14°, ask whether the cone opens to one side only. On the slider,
# first set the cone to 0° and let the class describe the difference.

# %% slideshow={"slide_type": "fragment"} name="ask-door"
ask(
    "02-door",
    "The sensor points at the middle of the door. **How wide may its cone be at most, so that it "
    "measures the wall beyond the door and not the door posts?**",
    right=28.0,
    tolerance=0.9,
    unit="°",
    reason="the posts stand arctan(0.5 / 2) = 14° to either side; a wider cone receives "
    "its first echo from them.",
    wrong={
        14: "this is the angle to one post; the cone extends to both sides.",
        26.6: "this is arctan(1 / 2), but each post is only half the door's width to the side.",
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


def echoes(cone_in_degrees, metres_to_the_door):
    """An ultrasonic scan: the sensor's pose, its points, how many lie beyond the door."""
    device = replace(ULTRASONIC, cone=np.radians(cone_in_degrees), beams=91)
    stands = np.array([0, 2 - metres_to_the_door, np.pi / 2])
    points = transform(stands, device.scan(DOOR, stands, np.random.default_rng(0)).points())
    return stands, points, np.sum(points[:, 1] > 2.5)


def by_ultrasound(cone_in_degrees, metres_to_the_door):
    """What an ultrasonic scanner with that cone draws in front of a door."""
    stands, points, beyond = echoes(cone_in_degrees, metres_to_the_door)
    fig, ax = views.axes(f"{beyond} of 91 directions measure through the door", size=(8, 5))
    views.draw(ax, Segments("walls", DOOR.walls), lw=3)
    views.draw(ax, Points("scan", points), markersize=7)
    views.draw(ax, Poses("robot", [stands]))
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"} name="door-picture" answers="02-door"
views.explore(
    by_ultrasound,
    lambda cone_in_degrees, metres_to_the_door: (
        f"A wall with a door, measured from {metres_to_the_door:.1f} m with a cone of "
        f"{cone_in_degrees}°: with a wider cone the door appears narrower."
    ),
    cone_in_degrees=(0, 40, 25),
    metres_to_the_door=(1.0, 3.0, 2.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-door"
# With a cone of 25°, the sensor measures through the door in only {= echoes(25, 2)[2] =} of the 91 directions,
# and the wall appears bent. With 0°, a beam as thin as that of a lidar, it measures through the door in
# {= echoes(0, 2)[2] =} directions. From {= next(cone for cone in range(40) if echoes(cone, 2)[2] == 0) =}° on,
# the door appears closed in the robot's map. If the robot drives nearer, the door appears again.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## A real lidar
#
# Now we examine data of a real RPLIDAR A2. Three published recordings of an A2 in a room contain
# {= len(real["turns"][0]) =}, {= len(real["turns"][1]) =} and {= len(real["turns"][2]) =} turns (revolutions of
# its head). We may not redistribute the recordings. Instead, the course contains a table of their statistics,
# and the cells below compute every number from this table.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-a-real-lidar"
# *For the lecturer:* Ask for differences between the two scans before you name any. The number and the
# directions of the beams cannot be seen in the picture.

# %% slideshow={"slide_type": "fragment"} name="first-turn" tags=["folded"]
first_turn = np.array(real["first_turn"]) * rplidar_a2_noise.CELL
simulated = RPLIDAR_A2.scan(worlds.room(), np.zeros(3), np.random.default_rng(3))
fig, _ = views.side_by_side(
    {
        "a real A2, first turn": [Points("scan", first_turn)],
        "RPLIDAR_A2 in a simulated room": [Points("scan", simulated.points())],
    },
    size=(9, 4.6),
    shared=False,
)
views.show(
    fig, "Left: a real room, open at the top, with a far wall that looks frayed. Right: our room."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# On the left you see a room some {= np.ptp(first_turn[np.abs(first_turn[:, 1]) < 2, 0]):.0f =} m wide, open at
# the top to a hallway that ends {= first_turn[:, 1].max():.0f =} m away. (Points are rounded to
# {= 100 * rplidar_a2_noise.CELL:.0f =} cm, and the two pictures have different scales.) At first sight the two
# scans look similar. The simulated device has {= RPLIDAR_A2.beams =} beams, always in the same directions. How
# many beams does the real device have?

# %% slideshow={"slide_type": "fragment"} name="points-a-turn" tags=["nbval-check-output", "code"]
for number, sizes in enumerate(real["turns"], 1):
    print(f"recording {number}: {sizes[0]} points in the first turn, {sizes[-1]} in the last")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In all three recordings the last turn has fewer points than the first. The device measures at a steady rate,
# so its motor is still gaining speed. Neither the number of beams nor their directions are fixed. Beam 17 of
# one turn and beam 17 of the next turn point in different directions.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## How large is the noise?
#
# The true ranges are unknown, but the device stands still. So we can compare each range $r$ with the ranges of
# the turn *before* at the same bearing. This bearing lies between two beams of the turn before, with the ranges
# $r_1$ and $r_2$, at a share $\tau$ of the angle between them. If both beams meet the same smooth surface, we
# can interpolate linearly between the two ranges:
#
# $$ \Delta r = r - \bigl((1 - \tau)\, r_1 + \tau\, r_2\bigr). \tag{02.9} $$
#
# The noise of three ranges enters this difference. If the noises are independent and all three ranges have the
# same $\sigma$, the variance is
#
# $$ \operatorname{Var}(\Delta r) = \bigl(1 + (1 - \tau)^2 + \tau^2\bigr)\, \sigma^2. \tag{02.10} $$
#
# We divide $\Delta r$ by the square root of the factor of $\sigma^2$, so the result has the $\sigma$ of one range. An error
# that is the same in both turns cancels. So the result contains the random errors only.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-how-large-is-the-noise"
# *For the lecturer:* Ask what (02.9) cannot show: an error that repeats in every turn cancels, so the result
# contains no bias. If time is short, state (02.10) without its derivation.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Two estimates of σ
#
# The course computes these results for {= real["errors"]["readings"] =} ranges (`rplidar_a2_noise.repeats`).
# We can estimate $\sigma$ from them in two ways: by the root of the mean square, or by the *median* of the
# absolute values. For a Gaussian error this median is $0.674\,\sigma$, so 1.483 times the median is an estimate
# of $\sigma$.
# The second estimate is *robust*: outliers hardly change it.

# %% slideshow={"slide_type": "fragment"} name="two-answers" tags=["nbval-check-output", "code"]
print(f"by the mean square: σ = {100 * real['errors']['rms']:.2f} % of r")
print(f"by the median:      σ = {100 * real['errors']['median']:.2f} % of r")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first number, rounded, is our guess of 0.4 %. If the relative errors of all ranges had one Gaussian
# density, the two numbers would agree. They differ: most errors are smaller than the mean square suggests, and
# some are far larger. (The first number leaves out errors beyond 3 %, for example of beams that a person
# crossed.) Which measurements have the large errors?

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Noise over the angle of incidence
#
# By (02.6) the noise grows with the angle of incidence. Does the noise of the real device grow in this way? We
# take ranges of 2 to 4 m only, sort them into classes of incidence, and compare with (02.6). We take $c_1$ from
# the class with the smallest incidence, and $\sigma_\beta = 0.1°$ from our guess.

# %% slideshow={"slide_type": "fragment"} name="by-slant" tags=["nbval-check-output", "code"]
tan, share = (np.array(real["by_slant"][name]) for name in ("slant", "share"))
predicted = np.hypot(share[0], tan * np.radians(0.1))
for low, *both in zip(rplidar_a2_noise.INCIDENCES[:-1], 100 * share, 100 * predicted, strict=True):
    print("{:2} to {}°: σ = {:.2f} % of r, (02.6) predicts {:.2f} %".format(low, low + 15, *both))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The noise of the real device grows with the incidence. Up to 60°, (02.6) is off by
# {= 100 * abs(share / predicted - 1)[:4].max():.0f =} % at most; beyond 60°, the noise is larger than predicted.
# At a large incidence the device also receives less light, and these data cannot separate the two causes.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Does the noise grow like the range?
#
# Now leave out the ranges at a large incidence ($\tan\iota \ge \tfrac12$). Smolec's thesis gives 0.75 % of the
# range for the A2 and simulates 1 %. The data sheet of a similar model, the A1, gives "<1 % of the distance" as
# the resolution over the whole range. A resolution is not a σ. Our guess is 0.4 %. All these statements give *one*
# share for all ranges.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-does-the-noise-grow-like-the-range"
# *For the lecturer:* Take the poll before you show the table; a constant share is the natural guess, because
# data sheets state one number. Let a student fit the curve with the sliders before you show the least
# squares.

# %% slideshow={"slide_type": "fragment"} name="ask-far"
ask(
    "02-far",
    "Over all ranges, the median gave a σ of about 0.25 % of the range. **How does this share "
    "differ between near ranges, about 2.4 m, and far ones, about 11.5 m?**",
    {
        "it is the same: σ is a share of the range": "this is the model of our guess; the "
        "next cell tests it.",
        "it is smaller far away: whole millimetres matter less there": "the share of the rounding "
        "does decrease, but a millimetre is little even at 2.4 m.",
        "it is larger far away": "so σ grows faster than the range itself.",
    },
    right="it is larger far away",
)

# %% slideshow={"slide_type": "fragment"} name="by-range" answers="02-far" tags=["nbval-check-output"]
r_class, share_class = (np.array(real["by_range"][name]) for name in ("range", "share"))
for r, share in zip(r_class, share_class, strict=True):
    print(f"{r:4.1f} m: σ = {100 * share:.2f} % of r, which are {1000 * share * r:4.1f} mm")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A model with two parameters, fitted by hand
#
# Our model of the noise has both parts that we have derived. One part grows with the range, and the other part
# with the square of the range:
#
# $$ \sigma^2 = (c_1\, r)^2 + (c_2\, r^2)^2. \tag{02.11} $$
#
# At first the next figure shows our first guess. Can you find constants with which the curve runs through all
# marks?


# %% slideshow={"slide_type": "fragment"} name="by-hand" answers="02-far" tags=["folded"]
def law(r, c_1, c_2):
    return np.hypot(c_1, c_2 * r)


def by_hand(c_1_in_percent, c_2_in_mm_per_m2):
    """The real device's σ / r over the range, and (02.11) with these constants."""
    constants = c_1_in_percent / 100, c_2_in_mm_per_m2 / 1000
    off = np.exp(abs(np.log((law(r_class, *constants) + 1e-6) / share_class)).max())
    r = np.linspace(2, 12, 100)
    title = f"The curve and the marks differ by a factor of up to {off:.2f}"
    fig, ax = views.curves(
        r, {"(02.11)": 100 * law(r, *constants)}, "range r [m]", "σ / r [%]", title, (8, 4.4)
    )
    ax.plot(r_class, 100 * share_class, "o", color=views.COLOURS["truth"], label="real A2")
    ax.axhline(0.75, color=views.COLOURS["limit"], linestyle="dashdot", label="0.75 % (Smolec)")
    ax.set_ylim(0, 1.3)
    views.legend(ax, loc="upper left", ncols=3)
    return fig


# %% slideshow={"slide_type": "subslide"} name="by-hand-picture" answers="02-far"
views.explore(
    by_hand,
    lambda c_1_in_percent, c_2_in_mm_per_m2: (
        f"σ / r of the real device rises from {100 * share_class[0]:.2f} % to "
        f"{100 * share_class[-1]:.2f} %; a curve with c₁ = {c_1_in_percent:.2f} % and "
        f"c₂ = {c_2_in_mm_per_m2:.2f} mm/m²."
    ),
    c_1_in_percent=(0.0, 1.0, 0.4),
    c_2_in_mm_per_m2=(0.0, 1.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-far"
# The guess fits at {= np.interp(0.004, share_class[4:], r_class[4:]):.1f =} m and at no other range. At
# {= r_class[0]:.1f =} m the σ of the real device is smaller by a factor of
# {= 0.004 / share_class[0]:.1f =}, and at {= r_class[-1]:.1f =} m larger by
# {= share_class[-1] / 0.004:.1f =}. Smolec's 0.75 % lies above all marks. So this number is a safe bound on σ
# and not an estimate of σ. Single errors can still exceed 0.75 %: at {= r_class[-1]:.1f =} m this bound is only
# {= 0.0075 / share_class[-1]:.1f =} σ.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The same model by least squares
#
# Divide (02.11) by $r^2$. The square of the share, $\sigma^2/r^2 = c_1^2 + c_2^2\, r^2$, is a straight line as
# a function of $r^2$, and we can fit this line to the data. The fitted $c_2$ is far from zero. Which of the
# sensors above has a noise with a part $c_2\, r^2$?

# %% slideshow={"slide_type": "fragment"} name="least-squares" tags=["nbval-check-output", "code"]
squares = np.polyfit(r_class**2, share_class**2, 1, w=1 / share_class**2)
c_2, c_1 = np.sqrt(squares)
print(f"fitted: c₁ = {100 * c_1:.2f} %, c₂ = {1000 * c_2:.2f} mm/m²")
off = law(r_class, c_1, c_2) / share_class
print(f"from {off.min():.2f} to {off.max():.2f} times the σ measured")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Steps in the ranges
#
# By (02.8), noise that grows with $r^2$ is typical of a sensor that measures $1/r$. Suppose that the A2 is such
# a sensor, and that it counts $1/r$ in whole steps of some size (**quantisation**). Then its ranges $r$ have
# steps, too: a small step of $1/r$ causes a step of $r$ that is $r^2$ times as large. We can search the data
# for such steps. Which values of $r$, in millimetres, occur near 7 m?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-steps-in-the-ranges"
# *For the lecturer:* Plan enough time here. Students may ask whether this method can be trusted. The
# simulated `RPLIDAR_A2` has no coarse steps: its neighbouring values are mostly a millimetre apart, both at 3
# m and at 7 m.

# %% slideshow={"slide_type": "fragment"} name="steps-at-7" tags=["nbval-check-output", "code"]
r_7, r_11 = (sum(rplidar_a2_noise.WINDOWS[k]) / 2 for k in (2, 3))
step_7 = np.median(np.diff(real["steps"][2]))
q = 1 / r_7 - 1 / (r_7 + step_7 / 1000)  # the step of 1/r [1/m]
longer_step = 1000 * (1 / (1 / r_11 - q) - r_11)  # the same q, at r_11 [mm]
print(f"near {r_7:.1f} m: {real['steps'][2][:6]} …  median step {step_7:.0f} mm")

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** If the A2 measures $1/r$ in equal steps, how large is the step at `r_11`, in millimetres?
# Compute it from `step_7`, `r_7` and `r_11`.

# %% slideshow={"slide_type": "fragment"} name="turn-steps" tags=["your-turn"]
step_11 = ...
compare(step_11, longer_step, tolerance=0.01)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# step_11 = step_7 * np.square(r_11 / r_7)
# ```
#
# </details>

# %% slideshow={"slide_type": "fragment"} name="fingerprint" tags=["nbval-check-output", "code"]
for (low, high), values in zip(rplidar_a2_noise.WINDOWS, real["steps"], strict=True):
    step, r = np.median(np.diff(values)), (low + high) / 2
    print(f"{low:4.1f} m: {values[:5]} …  step {step:2.0f} mm, step / r² = {step / r**2:.2f} mm/m²")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Near {= r_11:.1f =} m, neighbouring values of the range are {= np.diff(real["steps"][3]).min() =} or
# {= np.diff(real["steps"][3]).max() =} mm apart, close to the prediction (the step at 7 m is itself rounded).
# No range in between occurs in any of the {= sum(map(len, real["turns"])) =} turns. Each step is about
# {= np.median(np.diff(real["steps"][3])) / r_11**2:.1f =} mm/m² times $r^2$. (At 3 m, the recording rounds to
# whole millimetres, which hides the step.) Equal steps of $1/r$ would cause exactly this growth. The simplest
# explanation is that the device measures $1/r$ by triangulation, as the infrared sensor does. We reach this
# conclusion from the data alone. (The data sheet of the A1 agrees with the conclusion: it calls the A1 a
# triangulation range system, whose resolution changes with the distance.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Missing returns
#
# {= 100 * real["empty"]["readings"]:.1f =} % of the real device's beams have no return. So our guess drops 3 %
# of its beams at random.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-missing-returns"
# *For the lecturer:* Before you explain the figure, ask what a column of marks means, and what the slanted
# line could be. If time is short, show the figure alone.

# %% slideshow={"slide_type": "fragment"} name="ask-empty"
ask(
    "02-empty",
    "**In which directions does the real device have beams without a return?**",
    {
        "anywhere, as with the guess": "random dropouts are the simplest simulation, but the "
        "figure shows a pattern.",
        "in the same directions, turn after turn": "these beams pass edges, leave through the "
        "open side, or meet something that the device cannot detect.",
        "in a few bad turns": "then the whole device would fail for a moment, which is very rare.",
    },
    right="in the same directions, turn after turn",
)

# %% slideshow={"slide_type": "subslide"} name="empties" answers="02-empty" tags=["folded"]
title = "Beams without a return in 22 turns; below them, one simulated turn"
fig, ax = views.chart("bearing [degrees]", "number of the turn", title, (9, 4))
for number, bearings_empty in enumerate(real["empty"]["bearings"]):
    ax.plot(bearings_empty, [number] * len(bearings_empty), "|", color=views.COLOURS["truth"])
chance = guess.scan(worlds.room(), np.zeros(3), np.random.default_rng(7))
lost = np.degrees(chance.angles[np.isnan(chance.ranges)]) % 360
ax.plot(lost, [-3] * len(lost), "|", color=views.COLOURS["scan"])
rows = {-3: "simulated", 0: "0", 5: "5", 10: "10", 15: "15", 20: "20"}
ax.set(xlim=(0, 360), yticks=list(rows), yticklabels=list(rows.values()))
views.show(
    fig,
    "The beams without a return form columns: they have a few directions, the same in each turn.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-empty"
# The marks form columns. The slanted line moves from turn to turn, as the outline of a walking person would. So
# most missing returns are not failures of the device. They mean that the device cannot detect a surface in this
# direction, and this is information, too. A **dropout** is a missing return although the beam meets a surface.
# Consider beams for which the turns before and after both measured a surface in the same direction:
# {= 100 * real["empty"]["lost"][1]:.1f =} % of these beams have no return. If we require only the turn before,
# moving people included, the share is {= 100 * real["empty"]["lost"][0]:.1f =} %. The true share probably lies
# between the two numbers, and both are far below 3 %.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## What the simulator models, and what it lacks
#
# From now on our sensor model is the preset `RPLIDAR_A2`. Its parameters come from a finer fit to the same
# recordings, over ranges and angles of incidence at once. Does the noise of the simulator agree with the data?
# We let the preset and the guess scan simulated square rooms, one room for each mark, and evaluate these scans
# like the real scans:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-what-the-simulator-models-and-what-it-la"
# *For the lecturer:* The question on the slide has the answer: at far ranges, where the true σ is larger than
# that of the guess. Let the class name two missing effects before you show the table.


# %% slideshow={"slide_type": "subslide"} name="bench" tags=["folded"]
def on_the_bench(device, distance):
    """σ / r of a simulated device at rest, its walls at that distance, measured as above."""
    square = World(worlds.box((0, 0), (2 * distance, 2 * distance)))
    device, rng = replace(device, range_max=20.0), np.random.default_rng(9)
    rows = rplidar_a2_noise.repeats([device.scan(square, np.zeros(3), rng) for _ in range(20)])
    return rplidar_a2_noise.by_range(rows, edges=(0.9 * distance, 1.2 * distance))["share"][0]


benches = {
    name: np.array([on_the_bench(device, distance) for distance in r_class])
    for name, device in {"RPLIDAR_A2": RPLIDAR_A2, "first guess": guess}.items()
}


in_percent = {name: 100 * shares for name, shares in benches.items()}
labels = "range r [m]", "σ / r [%]", "At rest, by the median"
fig, ax = views.curves(r_class, in_percent, *labels, size=(8, 4))
ax.plot(r_class, 100 * share_class, "o", color=views.COLOURS["truth"], label="real A2")
ax.set_ylim(0, 0.9)
views.legend(ax, loc="upper left")
apart = max(benches["RPLIDAR_A2"] / share_class, key=lambda ratio: abs(np.log(ratio)))
views.show(
    fig,
    "σ / r of the preset rises with the range like the real device's; the first guess is constant.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The σ of the preset is close to that of the real device; in the worst case it is {= apart:.2f =} times the
# measured σ. (The preset was fitted to these recordings. Only a recording in another room could test it on new
# data.) The guess has a constant share. If a filter uses the guess as its measurement noise, at which ranges is
# it overconfident?

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What is missing
#
# | of the real device | in the simulator |
# | --- | --- |
# | σ grows with $r^2$ | yes |
# | larger noise at a large angle of incidence | as in (02.6), too little beyond 60° |
# | steps of $1/r$, {= np.diff(real["steps"][3]).max() =} mm at 11 m | no |
# | dropouts | by chance, {= 100 * RPLIDAR_A2.dropouts:.1f =} % everywhere |
# | no return past edges and into the open | only beyond the range |
# | mixed pixels at edges | no, its beams have no width |
# | number and directions of beams change | no |
# | motion distortion | no, a scan is cast from one pose |
# | systematic errors, the same in each turn | no, and a device at rest cannot show them |
# | dark, shiny, transparent surfaces | no, and these recordings cannot show them |
#
# A simulator need not model every effect. But its user must know which effects are missing, and which of them
# matter for the task. For a filter, the ratio of the noise at near and far ranges matters; for a map of free
# space, the missing returns matter.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## The likelihood of a range
#
# So far we have predicted ranges from a pose. A filter needs the reverse: the sensor has measured $r$, and ray
# casting in the map from a pose $x$ gives $r^\star$. How well do $r$ and $r^\star$ agree? The density
# $p(r \mid x)$ with the measured $r$ inserted, as a function of
# the pose, is the **likelihood** of the pose. The **beam model** of a range finder is a weighted sum of four
# densities, with weights $w$ that add up to 1:
#
# $$ p(r \mid x) = w_{\text{hit}}\, p_{\text{hit}} + w_{\text{short}}\, p_{\text{short}} + w_{\max}\, p_{\max} +
# w_{\text{rand}}\, p_{\text{rand}}. \tag{02.12} $$
#
# | part | what happened | density over $r$ |
# | --- | --- | --- |
# | hit | the wall of the map, with measurement noise | Gaussian about $r^\star$, σ as in (02.11) |
# | short | a person or another object that is not in the map | decreases exponentially between 0 and $r^\star$ |
# | max | no return | all weight at the largest range |
# | rand | other outliers, such as mixed pixels | uniform |
#
# Such a sensor model is called robust: without the last three parts a single outlier would reduce the
# likelihood of the true pose to nearly zero. Lesson 11 weights particles by likelihoods.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-likelihood-of-a-range"
# *For the lecturer:* Draw the four densities over one axis on the board, because the slide has only the
# table. The usual mistake is to read the likelihood as a density of the pose; as a function of the pose, its
# integral need not be one.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Part three: wheel encoders
#
# *This is another good place for a break.*
#
# An **encoder** is a disc with slots on the axle of a wheel. A light barrier counts how often light passes
# through a slot. One such count is a *tick*. The robot computes its odometry from ticks. So odometry is a
# measurement, too, and it has errors.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-part-three-wheel-encoders"
# *For the lecturer:* In the poll, many students add up the tick errors of all metres. Ask what happens to the
# part of a tick that was not counted at the end of the first metre.

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
# Three errors arise. The encoder counts whole ticks only (quantisation). The wheel **slips**: its rim turns
# farther than the wheel travels, or less far. The length of a tick is computed as the wheel's circumference
# divided by the number of slots, so it is wrong if the wheel is larger than assumed.

# %% slideshow={"slide_type": "subslide"} name="ask-wheels"
ask(
    "02-wheels",
    "Robots drive 1 m, 4 m and 16 m straight ahead, and count their ticks. The slip of each short "
    "piece is random: independent of the others, with mean 0. **How do the three errors of the "
    "measured distance grow? (For the slip, consider σ.)**",
    {
        "all in proportion to the distance": "only the wrong wheel repeats its error in every "
        "metre, always with the same sign.",
        "ticks and slip with its root, the wheel in proportion": "this is right for slip and "
        "wheel, but tick errors do not add up: the next metre counts the rest of a tick.",
        "ticks not at all, slip with its root, the wheel in proportion": "at most one tick is "
        "wrong; slips partly cancel; a wrong wheel size causes the same error in every metre.",
        "ticks not at all, slip and wheel in proportion": "the slip would need the same sign "
        "every time, as on a floor that is slippery throughout.",
    },
    right="ticks not at all, slip with its root, the wheel in proportion",
)


# %% slideshow={"slide_type": "fragment"} name="wheels" answers="02-wheels" tags=["folded", "nbval-check-output"]
def odometry_errors(robot, distance, rng):
    """Errors of the distance measured by 200 robots [mm]: mean, standard deviation."""
    errors = []
    for _ in range(200):
        simulator, excess = Simulator(robot, rng), 0.0
        for seconds in [*[1.25] * (2 * distance), 0.1 * rng.random()]:  # half a metre each
            before = simulator.pose
            measured = simulator.step(0.4, 0.0, seconds)
            excess += measured[0] - between(before, simulator.pose)[0]
        errors.append(1000 * excess)
    return np.mean(errors), np.std(errors)


exact, rng = DifferentialDrive(tick=1e-6), np.random.default_rng(4)
faults = {"ticks of 5 mm": {"tick": 0.005}, "slip": {"slip": 0.01}}
faults["wheels 1 % larger"] = {"left_scale": 1.01, "right_scale": 1.01}
wheel_errors = {
    name: [odometry_errors(replace(exact, **fault), distance, rng) for distance in (1, 4, 16)]
    for name, fault in faults.items()
}
for name, errors in wheel_errors.items():
    rows = [f"{round(mean):4} ± {sigma:2.0f}" for mean, sigma in errors]
    print(f"{name:18}", "  ".join(rows), "mm (mean ± σ) after 1, 4, 16 m")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="02-wheels"
# When the distance is sixteen times as long, the tick error stays the same. The σ of the slip is
# {= wheel_errors["slip"][2][1] / wheel_errors["slip"][0][1]:.1f =} times as large, and the error of the
# wrong wheel
# {= wheel_errors["wheels 1 % larger"][2][0] / wheel_errors["wheels 1 % larger"][0][0]:.0f =} times as
# large. The error of the wrong wheel is systematic, so calibration can remove it (lesson 01). A filter that
# models all
# three errors as independent noise is right only for the slip.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Differential drive: from two wheels to an arc
#
# A **differential drive** has two driven wheels on one axle, a distance $B$ apart. In one step the wheels roll
# the distances $s_{\mathrm l}$ and $s_{\mathrm r}$. If both roll without slip, the robot turns at each
# moment about one point
# on the line of the axle, the **instantaneous centre of rotation** (ICR, or ICC). We assume that the ratio of
# the wheel speeds is constant during a step. Then this point stays where it is. Let $\ell$ be its distance
# from the middle of the axle, positive to the left. All points turn by the same angle $\Delta\theta$, so the
# wheels travel
#
# $$ s_{\mathrm l} = (\ell - \tfrac B2)\,\Delta\theta, \qquad s_{\mathrm r} = (\ell + \tfrac B2)\,\Delta\theta. \tag{02.13} $$
#
# The middle of the axle travels the distance $d$, half the sum of the two. The difference gives the turn, as in
# (01.2):
#
# $$ d = \ell\,\Delta\theta = \frac{s_{\mathrm l} + s_{\mathrm r}}{2}, \qquad
# \Delta\theta = \frac{s_{\mathrm r} - s_{\mathrm l}}{B}. \tag{02.14} $$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-differential-drive-from-two-wheels-to-an"
# *For the lecturer:* The answers to the two questions on the slide: the centre is the wheel that stands
# still; with opposite wheels it is the middle of the axle. Show both with two fingers on the desk.

# %% slideshow={"slide_type": "subslide"} name="wheel-arcs" tags=["folded"]
BASE = 0.3  # B, the distance between the wheels [m]


def wheel_arcs(s_left, s_right):
    """The paths of both wheels and of the middle of the axle, the chord and the ICR."""
    d, turn = (s_left + s_right) / 2, (s_right - s_left) / BASE
    path = np.array([arc(s * s_left, s * s_right, BASE) for s in np.linspace(0, 1, 60)])
    fig, ax = views.axes(f"d = {d:.2f} m, Δθ = {np.degrees(turn):.0f}°", size=(8, 5))
    wheels = [[0, BASE / 2], [0, -BASE / 2]]
    left, right = np.array([transform(pose, wheels) for pose in path]).transpose(1, 2, 0)
    lines = [(left, "-", "corrected", "left wheel"), (right, "--", "naive", "right wheel")]
    lines.append((path[[0, -1], :2].T, ":", "limit", "chord"))
    if abs(turn) > 0.05:
        lines.append(([[0], [d / turn]], "x", "limit", "instantaneous centre of rotation"))
    views.draw(ax, Poses("truth", path), label="middle of the axle")
    for xy, style, name, label in lines:
        ax.plot(*xy, style, color=views.COLOURS[name], markersize=9, label=label)
    views.legend(ax, loc="upper left")
    return fig


views.explore(
    wheel_arcs,
    lambda s_left, s_right: (
        f"The left wheel rolls {s_left:.2f} m, the right one {s_right:.2f} m: the wheels and the middle "
        "of the axle follow arcs about one centre."
    ),
    s_left=(-0.4, 0.8, 0.4),
    s_right=(-0.4, 0.8, 0.7),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Where is the instantaneous centre of rotation if one wheel stands still? Where is it if both wheels roll
# equally far, but in opposite directions?
#
# The middle of the axle follows an arc of the length $d$. In the robot frame the arc ends
# $\ell\sin\Delta\theta$ ahead and $\ell\,(1 - \cos\Delta\theta)$ to the left. The *chord* is the straight line
# to this end; it is shorter than the arc, and its direction is $\Delta\theta/2$ to the left. With the length
# $d_{\mathrm c}$ of the chord, the odometry increment is therefore
#
# $$ o = \Bigl(d_{\mathrm c}\cos\tfrac{\Delta\theta}2,\; d_{\mathrm c}\sin\tfrac{\Delta\theta}2,\; \Delta\theta\Bigr),
# \qquad d_{\mathrm c} = d\,\frac{\sin(\Delta\theta/2)}{\Delta\theta/2}. \tag{02.15} $$
#
# If $\Delta\theta$ goes to zero, the fraction goes to 1, and the arc becomes a straight line.

# %% slideshow={"slide_type": "subslide"} name="chord" tags=["nbval-check-output", "code"]
d, turn = sp.symbols("d Δθ", positive=True)
ell, chord = d / turn, d * sp.sin(turn / 2) / (turn / 2)
ahead = ell * sp.sin(turn) - chord * sp.cos(turn / 2)
to_the_left = ell * (1 - sp.cos(turn)) - chord * sp.sin(turn / 2)
print("arc − chord:", sp.simplify(ahead), "ahead,", sp.simplify(to_the_left), "to the left")
print("limit of the chord for a small turn:", sp.limit(chord, turn, 0))

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The covariance of wheel odometry
#
# How uncertain are $d$ and $\Delta\theta$? Let the slip of the two wheels be independent, with mean 0 and variances
# $\sigma_{\mathrm l}^2$ and $\sigma_{\mathrm r}^2$. By (02.14), $(d, \Delta\theta)$ is the matrix $J$ times $(s_{\mathrm l}, s_{\mathrm r})$, and the same matrix transforms the errors $e$ of the two distances. The covariance of $J e$ is $J$ times the covariance of
# $e$ times $J^{\mathsf T}$ (lesson 03 derives this rule):

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-covariance-of-wheel-odometry"
# *For the lecturer:* Ask for the sign of the correlation in a curve to the right. (It is negative.) If time
# is short, leave out this section: lesson 04 uses a diagonal covariance.

# %% slideshow={"slide_type": "fragment"} name="covariance" tags=["nbval-check-output", "code"]
B, s_l, s_r = sp.symbols("B sigma_l sigma_r", positive=True)
J = sp.Matrix([[sp.Rational(1, 2), sp.Rational(1, 2)], [-1 / B, 1 / B]])
sp.simplify(J * sp.diag(s_l**2, s_r**2) * J.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# $$ C = \begin{bmatrix}
# \frac{\sigma_{\mathrm l}^2 + \sigma_{\mathrm r}^2}{4} & \frac{\sigma_{\mathrm r}^2 - \sigma_{\mathrm l}^2}{2B}
# \\[2pt]
# \frac{\sigma_{\mathrm r}^2 - \sigma_{\mathrm l}^2}{2B} & \frac{\sigma_{\mathrm l}^2 + \sigma_{\mathrm r}^2}{B^2}
# \end{bmatrix} \tag{02.16} $$
#
# The slip of each wheel enters both $d$ and $\Delta\theta$, so the two errors are *correlated* unless the
# variances are equal. The slips of short pieces are independent, so their sum has a variance proportional to
# the distance, $\sigma^2 = \varsigma^2\,|s|$, as in the question above. So in a curve the outer wheel has the
# larger variance. In a curve to the left the correlation is positive: if the measured $d$ is too long, the
# measured turn tends to be too large.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The wheels roll 0.20 m and 0.26 m, with $B = 0.3$ m and $\varsigma = 0.01\ \sqrt{\mathrm m}$,
# so the σ of the slip is 1 cm after one metre.
# Compute the covariance $C$ of $(d, \Delta\theta)$ from `J_wheels` and `variances`.

# %% slideshow={"slide_type": "fragment"} name="turn-covariance" tags=["your-turn"]
J_wheels = np.array([[1 / 2, 1 / 2], [-1 / 0.3, 1 / 0.3]])
variances = 1e-4 * np.array([0.20, 0.26])  # ς² |s| of both wheels [m²]
C = ...  # a 2 × 2 array
compare(C, noise.C_wheels((0.23, 0.2), slip=0.01, base=0.3))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# J_wheels = np.array([[1 / 2, 1 / 2], [-1 / 0.3, 1 / 0.3]])
# variances = 1e-4 * np.array([0.20, 0.26])
# C = J_wheels @ np.diag(variances) @ J_wheels.T
# ```
#
# The σ of $d$ is {= 1000 * np.sqrt(noise.C_wheels((0.23, 0.2), 0.01, 0.3)[0, 0]):.1f =} mm, and the σ of
# $\Delta\theta$ is {= np.degrees(np.sqrt(noise.C_wheels((0.23, 0.2), 0.01, 0.3)[1, 1])):.1f =}°.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## The motion models of this course
#
# A **motion model** computes the next pose from the pose and a control input or an odometry increment. (With
# its noise it is a density of the next pose, as in lesson 03.) The course uses four:
#
# | motion model | input | path in a step | lessons |
# | --- | --- | --- | --- |
# | two wheels | $s_{\mathrm l}$, $s_{\mathrm r}$ | arc, (02.14) and (02.15) | simulated robots of 01, 02, 12 |
# | velocity | $v$, $\omega$ for a time $T$ | the same arc: $d = vT$, $\Delta\theta = \omega T$ | simulated laps of 05–07, 10 |
# | odometry increment | $o = (\Delta x, \Delta y, \Delta\theta)$ in the robot frame | any path: $x \oplus o$ | 01, 05–07, 13, 15 |
# | distance and turn | $d$, $\Delta\theta$ | straight, then turn | 04 |
#
# The first two models describe a differential drive and yield an increment $o$ by (02.15). The last model
# approximates the arc by a straight line and a turn. It is simple to differentiate, but its end lies about
# $d\,\Delta\theta/2$ to the side of the arc's end:
# {= 100 * np.abs(arc(0.20, 0.26, 0.3) - [0.23, 0, 0.2])[1]:.1f =} cm for the wheels above, in one step. The shorter
# the steps, the smaller the error.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-motion-models-of-this-course"
# *For the lecturer:* Students confuse a control input with an odometry increment. The increment is a
# measurement, which the filter uses in place of the control input.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## Literature
#
# - Kurt Konolige and others, *A low-cost laser distance sensor*, ICRA 2008: a rotating lidar that triangulates,
#   and why its error grows with the square of the range.
# - John Leonard and Hugh Durrant-Whyte, *Directed Sonar Sensing for Mobile Robot Navigation*, 1992: what a
#   sonar with a wide cone measures of walls and corners.
# - Frank Hampel, *The influence curve and its role in robust estimation*, Journal of the American
#   Statistical Association, 1974: estimating σ by the median.
# - Johann Borenstein and Liqiang Feng, *Measurement and correction of systematic odometry errors in mobile
#   robots*, IEEE Transactions on Robotics and Automation 12(6), 1996: how to calibrate wheels.
#
# **Read next:** Sebastian Thrun, Wolfram Burgard and Dieter Fox, *Probabilistic Robotics*, 2005, chapter 5
# on motion models and chapter 6 on the beam model.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-literature"
# *For the lecturer:* If a student asks whether cheap lidars triangulate: the device in the paper by Konolige
# and others was built for a robot vacuum cleaner.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## Summary
#
# You can compute a scan by ray casting and transform it into the world frame. You can test a statement about the
# noise of a sensor. You can also compute odometry and its covariance from the distances of two wheels.
#
# **Exercise:** [cast rays, simulate echoes and noise, evaluate the likelihood of a scan, and estimate the noise of a
# sensor in a busy room](../exercises/ex02_sensors_and_worlds.ipynb), 60 minutes.
#
# **Next:** every measurement has noise, and the estimate of the pose is uncertain, too. How much weight should
# each of them get? [03 · The Kalman filter](03_kalman_filter.ipynb) derives this weight. The sections below
# this one are
# optional.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-summary"
# *For the lecturer:* Before you show it, ask which of the three errors of a wheel can be removed by
# calibration, and which one a filter may model as independent noise.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: occlusion
#
# Even a perfect sensor measures only a small part of a building. Most walls are hidden behind other walls
# (*occlusion*) or are beyond the sensor's range. The next figure shows Smolec's *situation 1*: four rooms
# beside a corridor, with doors that face each other. What share of all walls is visible from near the middle of
# one room? From which position is the largest share visible? Choose a position before you move the robot there.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-occlusion"
# *For the lecturer:* This works as a game: each student names a position, and the largest visible share wins.
# The grid search at the end gives the best one.

# %% slideshow={"slide_type": "subslide"} name="visible"
# which spots on the walls are visible from (x, y)
flat = worlds.situation_1()
ends = [(wall[:2], wall[2:]) for wall in flat.walls]
spots = [np.linspace(p, q, round(np.hypot(*(q - p)) / 0.05)) for p, q in ends]
spots = np.vstack(spots)  # every 5 cm along the walls


def visible(x, y):
    """Which spots on the walls are visible from (x, y), and their share of all [%]."""
    offset = spots - [x, y]
    distance = np.hypot(*offset.T)
    free = flat.cast((x, y), np.arctan2(offset[:, 1], offset[:, 0])) > distance - 1e-6
    return free, 100 * free.mean()


# %% slideshow={"slide_type": "-"} name="visible-picture" tags=["folded"]
def draw_visible(x, y):
    """The building, and what is visible of it."""
    free, share = visible(x, y)
    fig, ax = views.axes(f"{share:.0f} % of the walls are visible", size=(8, 5.4))
    views.draw(ax, Segments("walls", flat.outline()))
    views.draw(ax, Points("scan", spots[free]), label="visible", markersize=6)
    views.draw(ax, Poses("robot", [[x, y, 0]]))
    views.legend_below(fig)
    return fig


views.explore(
    draw_visible,
    lambda x, y: (
        f"From ({x:.1f} m, {y:.1f} m) {visible(x, y)[1]:.0f} % of the walls are visible: near ones, "
        "and strips behind doors."
    ),
    x=(-1.9, 7.9, 0.1),
    y=(-1.9, 7.4, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# From near the middle of a room, {= visible(0.1, 0.1)[1]:.0f =} % of the walls are visible: the walls of the
# room itself and, through its door, strips of the walls behind it. From the door, at $(0, 2)$,
# {= visible(0.1, 2.0)[1]:.0f =} % are visible. On a grid of half a metre, the largest
# visible share of any position is
# {= max(visible(x, y)[1] for x in np.arange(-1.9, 8, 0.5) for y in np.arange(-1.9, 7.5, 0.5)):.0f =} %.
# A map combines many scans, because no single scan shows the whole building, and the combination needs poses.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: three sensors in one arena
#
# A lidar, the infrared sensor and an ultrasonic sensor scan the arena of the MAK thesis, which consists of
# cardboard boxes, from the same pose. Which sensor measures most walls? Which sensor measures near walls only?
# How do corners appear in the third plot? The fields of view are 360°, 178° and 180°.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-three-sensors-in-one-arena"
# *For the lecturer:* Ask which of the three sensors cannot see a corner, and which one is useless in the
# middle of a large room.

# %% slideshow={"slide_type": "fragment"} name="three-sensors" tags=["folded"]
arena, stands = worlds.arena(), np.array([-0.12, -0.2, np.radians(100)])
devices = {"lidar": RPLIDAR_A2, "infrared": GP2D120, "ultrasonic": ULTRASONIC}
layers, back = {}, {}
for name, device in devices.items():
    points = device.scan(arena, stands, np.random.default_rng(1)).points()
    back[name] = len(points)
    hits = Points("scan", transform(stands, points))
    title = f"{name}: {len(points)} of {device.beams}"
    layers[title] = [Segments("walls", arena.outline()), hits, Poses("robot", [stands])]
fig, drawn = views.side_by_side(layers, size=(9.5, 3.8))
for ax in drawn:
    ax.lines[0].set_markersize(6)
views.show(
    fig,
    "Lidar: most walls, sharply drawn. Infrared: near walls only. Ultrasonic: round arcs.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The title of each plot gives the number of beams with a return. The lidar draws every visible wall beyond its
# minimum range of
# {= 100 * RPLIDAR_A2.range_min:.0f =} cm. Of {= GP2D120.beams =} infrared beams only {= back["infrared"] =} have a
# return, from walls nearer than {= 100 * GP2D120.range_max:.0f =} cm, and even these scatter a little. The
# ultrasonic sensor draws arcs, because it measures the same nearest point in many neighbouring directions. So
# corners become round, and notches disappear.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a round pillar
#
# In the plane of the scan, table legs and pillars are circles. Let the centre of a circle lie at the distance
# $\xi$ *along* the beam and $\eta$ *beside* the beam, and let $\varrho$ be its radius. The point at range $r$
# is on the circle if
#
# $$ (r - \xi)^2 + \eta^2 = \varrho^2. \tag{02.17} $$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-a-round-pillar"
# *For the lecturer:* Let the class name the three cases (outside, inside, passing by) and guess the kind of
# the roots before the cell prints them.

# %% slideshow={"slide_type": "fragment"} name="pillar" tags=["nbval-check-output"]
r, xi, eta, radius = sp.symbols("r xi eta varrho", positive=True)
sp.solve(sp.Eq((r - xi) ** 2 + eta**2, radius**2), r)

# %% slideshow={"slide_type": "fragment"} name="tower" tags=["nbval-check-output"]
tower = World(circles=[(3.0, 0.0, 0.5)])
for story, x, y in [("from outside", 0, 0.3), ("from inside", 3.1, 0.3), ("passing by", 0, 0.7)]:
    roots = 3 - x + np.array([-1, 1]) * np.sqrt(0.25 - y**2 + 0j)
    print(f"{story:13} roots {roots.round(3)}, cast {tower.cast((x, y), [0.0])[0]:.3f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The sensor measures the smallest root that is not negative. Outside the circle, this is the first root;
# inside, for example in a round tower, it is the second root. Complex roots mean that the beam misses the
# circle.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: move a wall, watch the scan
#
# The next cell shows Smolec's *situation 2* and the scan of a lidar at the origin. Drag a corner, or choose it
# with Tab and move it with the arrow keys; click into the rows to change numbers or to add a wall. *Undo*
# reverses the last change.
#
# Drag the corner $(-2.4, -3.2)$ to the right: is more of the bay in the lower left visible, or less? Which
# points disappear when you add the pillar `-1 -1 0.2`?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-move-a-wall-watch-the-scan"
# *For the lecturer:* Let the class choose the place of the pillar and state which points will disappear
# before you add it.


# %% slideshow={"slide_type": "fragment"} name="editor"
# situation 2 in an editor, with the scan of a lidar at the origin
def scan_from_the_origin(world):
    return RPLIDAR_A2.scan(world, np.zeros(3), np.random.default_rng(2)).points()


editor = edit_world(
    worlds.situation_2(),
    "An irregular room with one slanted wall, and the scan of a lidar near its upper right.",
    scan=scan_from_the_origin,
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The corner hides half of the bay. If you drag the corner to the right, it hides less of the bay. The pillar
# hides a strip of the room that widens with distance. With `worlds.save(editor.world, "mine.txt")` you save
# your world in a file.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a world is a text file
#
# Four numbers define a wall, three define a circle, and `#` begins a comment. So you can measure your own room,
# write the numbers in a file, read the file with `worlds.load`, and simulate a lidar in this room.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-a-world-is-a-text-file"
# *For the lecturer:* A good homework: measure a room with a folding rule, write its file, and bring it to the
# next lecture.

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
# How should a program respond to a wall of zero length, to a word in place of a number, or to a line with five
# numbers? It should at least report the number of the line and the mistake in this line:

# %% slideshow={"slide_type": "fragment"} name="broken-files" tags=["nbval-check-output"]
for line in ("1 1 1 1", "0 0 one 2", "0 0 1 1 1", "2 2 -0.1", "0 0 1 nan"):
    try:
        worlds.parse(MY_ROOM + line, "my room")
    except ValueError as refused:
        print(refused)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: your own copy of the recordings
#
# These commands, in a terminal, fetch the recordings (0.8 MB) from where they are published, and compute
# the table of this lesson from them:
#
#     slamlab data get --lesson 2
#     python -m course.studies.rplidar_a2_noise --out my-a2.json

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-your-own-copy-of-the-recordings"
# *For the lecturer:* The commands need a network. Run them before the lecture, not in it.
