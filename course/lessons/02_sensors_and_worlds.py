# %% [markdown] slideshow={"slide_type": "slide"}
# # 02 · Sensors and worlds
#
# **You will be able to** compute what a range sensor sees of a world, bring its readings from the
# device's units and frame into the world's, say how wrong they are and why, and hold a simulated
# sensor against recordings of the real one.
#
# **60 minutes** (20 for rays, 20 for frames, noise and three sensors, 20 for the real device).
# **Before:** lesson 01; 2×2 linear systems; standard deviation.
#
# Sources: Smolec, chapter 3; Tuček, chapter 2; MAK thesis, chapter 6; the EKF note.
#
# *Key:* a simulator is a claim about a device. It can be tested like any other.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Three parts that stand alone: rays and walls (geometry), frames and noise
# (what every driver gets wrong once), the real device (statistics). If time is short, leave out
# circles and the text file. The last part is the one they will remember: bring it.

# %% slideshow={"slide_type": "skip"}
import contextlib
import tempfile
import time
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import sympy as sp

from slamlab import sources, views, worlds
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.readings import Scan
from slamlab.simulation import GP2D120, RPLIDAR_A2, ULTRASONIC, Scanner
from slamlab.simulation import DifferentialDrive, Simulator
from slamlab.worlds import World
from slamlab.views.editor import edit_world
from slamlab.worlds.files import WorldFileError

# %% [markdown] slideshow={"slide_type": "slide"}
# ## One beam, one wall
#
# A lidar measures how far a beam flies until it meets something. In a simulator somebody has to
# compute that.
#
# **Question.** The beam leaves the point **p** in the direction **u**; the wall goes from **a** to
# **b**. Where do they meet?
#
# A point on the beam is p + t·u, a point on the wall a + s·w with w = b − a. They meet where the
# two are equal, which is two equations, one for x and one for y, in two unknowns:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
t, s = sp.symbols("t s", real=True)
p, a = sp.Matrix(sp.symbols("p_x p_y")), sp.Matrix(sp.symbols("a_x a_y"))
u, w = sp.Matrix(sp.symbols("u_x u_y")), sp.Matrix(sp.symbols("w_x w_y"))
sp.Eq(p + t * u, a + s * w, evaluate=False)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Unknowns to the left, with d = a − p for the way to the wall's beginning:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
d = sp.Matrix(sp.symbols("d_x d_y"))
M = sp.Matrix.hstack(u, -w)
sp.Eq(sp.MatMul(M, sp.Matrix([t, s])), d, evaluate=False)

# %% [markdown] slideshow={"slide_type": "fragment"}
# A 2×2 system is solved by its determinant:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
-M.det()

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.simplify(M.inv() * d).applyfunc(sp.factor)

# %% [markdown] slideshow={"slide_type": "slide"}
# The first line is t, how far the beam flies (|u| = 1, so t is in metres). The second is s, where
# on the wall: 0 at its beginning, 1 at its end.
#
# **Predict:** here are four walls round a sensor at the origin with its beam at 25°. For which does
# the formula give a t below zero, an s outside 0 to 1, a determinant of zero?

# %% slideshow={"slide_type": "fragment"}
beam = np.radians(25)
four = {
    "in the way": (2.0, -0.5, 1.5, 2.5),
    "behind": (-1.5, 0.5, -0.5, -1.5),
    "beside": (2.8, -1.5, 2.6, 0.3),
    "parallel": (0.0, 0.8, 2 * np.cos(beam), 0.8 + 2 * np.sin(beam)),
}
layers = [Segments("walls", list(four.values())), Poses("robot", [[0, 0, beam]])]
fig, (ax,) = views.side_by_side({"Four walls and one beam": layers}, size=(6, 4))
flight = [[0, 0, 3.6 * np.cos(beam), 3.6 * np.sin(beam)]]
views.draw(ax, Segments("scan", flight), linestyle="--")
for name, wall in four.items():
    ax.annotate(name, wall[2:], xytext=(6, 4), textcoords="offset points")
ax.margins(0.15)
views.show(fig, "A beam: one wall crosses it, the others lie behind, beside, along.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** only the wall "in the way" is met. The other three are ways in which the *lines* cross,
# or do not, while beam and wall never touch.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def meet(place, direction, wall):
    """t and s of the point where the beam's line crosses the wall's line."""
    a, b = np.array(wall[:2]), np.array(wall[2:])
    u = np.array([np.cos(direction), np.sin(direction)])
    system = np.column_stack([u, a - b])
    if abs(np.linalg.det(system)) < 1e-12:
        return np.inf, np.nan
    return np.linalg.solve(system, a - place)


for name, wall in four.items():
    print("{:12} t = {:5.2f}   s = {:5.2f}".format(name, *meet(np.zeros(2), beam, wall)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# So the beam meets the wall when **t ≥ 0** and **0 ≤ s ≤ 1**; a determinant of zero means parallel.
# Smolec asks instead whether the crossing lies in the same quadrant as the beam. That is t ≥ 0 in
# other words, except for a beam along an axis, which lies in no quadrant.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## All beams, all walls
#
# A scan has hundreds of beams, and a beam that crosses three walls reports one.
#
# **Predict:** which of the three? And what is left of a beam that crosses none?


# %% slideshow={"slide_type": "fragment"}
def scan_by_loops(place, directions, walls):
    """Every beam against every wall, the nearest wins: as one writes it first."""
    ranges = np.full(len(directions), np.inf)
    for i, phi in enumerate(directions):
        u_x, u_y = np.cos(phi), np.sin(phi)
        for a_x, a_y, b_x, b_y in walls:
            w_x, w_y, d_x, d_y = b_x - a_x, b_y - a_y, a_x - place[0], a_y - place[1]
            determinant = u_x * w_y - u_y * w_x
            if determinant != 0:
                t = (d_x * w_y - d_y * w_x) / determinant
                s = (d_x * u_y - d_y * u_x) / determinant
                if t >= 0 and 0 <= s <= 1:
                    ranges[i] = min(ranges[i], t)
    return ranges


# %% [markdown] slideshow={"slide_type": "fragment"}
# Smolec's simulator is such a pair of loops, with 3600 beams 0.1° apart. The package's `World.cast`
# does the same. **Predict:** the largest difference between the two, and how many times faster the
# package is on 3600 beams and some 20 walls.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
bare_room = World(worlds.room().walls)
turn = np.radians(np.arange(0.05, 360, 0.1))
by_loops = scan_by_loops((0, 0), turn, bare_room.walls)
difference = abs(by_loops - bare_room.cast((0, 0), turn)).max()
print(f"{len(turn)} beams, {len(bare_room.walls)} walls: largest difference {difference:.9f} m")


# %% slideshow={"slide_type": "fragment"}
def seconds(task, rounds=3):
    """The shortest of a few runs [s]."""
    taken = []
    for _ in range(rounds):
        begin = time.perf_counter()
        task()
        taken.append(time.perf_counter() - begin)
    return min(taken)


loops = seconds(lambda: scan_by_loops((0, 0), turn, bare_room.walls))
package = seconds(lambda: bare_room.cast((0, 0), turn), rounds=20)
print(f"loops {1000 * loops:.0f} ms, package {1000 * package:.2f} ms: {loops / package:.0f} times")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The same numbers, hundreds of times sooner. Two ideas do it. Seen from the sensor, a wall fills an
# interval of directions, and only beams inside it can meet it: the others are never asked. And what
# is left is one list of (wall, beam) pairs that NumPy works off at once.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The factor depends on the machine; expect some hundreds. Ask what the
# loops cost with twice the walls (twice), and the package (hardly more: near walls hide the others,
# and each asks only the beams that can meet it). `python -m benchmarks.raycast` measures it.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A round pillar
#
# Table legs and pillars are circles: centre c, radius R. A point of the beam lies on the circle
# when its distance from c is R. Let m be how far c lies *along* the beam, h how far *beside* it:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
m, h, R = sp.symbols("m h R", positive=True)
on_circle = sp.Eq((t - m) ** 2 + h**2, R**2)
on_circle

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict:** how many solutions? Which one does a lidar report from outside, which from inside
# (say, in a round tower)? When is there none?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.solve(on_circle, t)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
tower = World(circles=[(3.0, 0.0, 0.5)])
for story, x, y in [("from outside", 0, 0.3), ("from inside", 3.1, 0.3), ("passing by", 0, 0.7)]:
    by_formula = [3 - x - np.sqrt(0.25 - y**2 + 0j), 3 - x + np.sqrt(0.25 - y**2 + 0j)]
    print(f"{story:13} roots {np.round(by_formula, 3)}, cast {tower.cast((x, y), [0.0])[0]:.3f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The nearest root that is not behind: the first from outside, the second from inside. Complex roots
# mean that the beam passes by.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A scan, as the sensor knows it
#
# A scan is a list of ranges over angles. It becomes a picture by x = r cos β, y = r sin β.
#
# **Predict:** what does a *straight* wall look like when you plot r over β?

# %% slideshow={"slide_type": "fragment"}
room = worlds.room()
NOTHING = {"range_error": 0.0, "range_curvature": 0.0, "bearing_sigma": 0.0, "dropouts": 0.0}
ideal = replace(RPLIDAR_A2, **NOTHING)
seen = ideal.scan(room, np.zeros(3), np.random.default_rng(0))
fig, (left, right) = views.panels(["polar: r over β", "Cartesian"], (10, 4), shared=False)
left.plot(np.degrees(seen.angles), seen.ranges, ".", color=views.COLOURS["scan"], markersize=3)
left.set(aspect="auto", xlabel="bearing β [degrees]", ylabel="range r [m]")
views.draw(right, Segments("walls", room.outline()))
views.draw(right, Points("scan", seen.points()), markersize=5)
views.draw(right, Poses("robot", [[0, 0, 0]]))
views.show(fig, "Left, ranges over angles in arcs and jumps; right, the same as points on walls.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** left, every straight wall is an arc, r = d / cos(β − α), lowest where the sensor looks at
# it square on; where two walls meet, two arcs meet in a point. Where something hides what is behind
# it, r *jumps*. On the right, only parts of walls have points on them: what is behind the table is
# not known.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Sensor, robot, world
#
# A reading is made in the frame of the **sensor**. The sensor sits on the **robot**, seldom in its
# middle. The robot stands somewhere in the **world**. Each step is a pose: the sensor's `mount` on
# the robot, the robot's `pose` in the world.
#
# **Predict:** the sensor sits 20 cm ahead of the robot's centre and looks to the left (+90°). The
# robot stands at (2, 1) and looks along +y. A reading says: 3 m, straight ahead. Where is the wall?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
mount, pose = np.array([0.2, 0.0, np.pi / 2]), np.array([2.0, 1.0, np.pi / 2])
in_sensor = np.array([[3.0, 0.0]])
in_robot = transform(mount, in_sensor)
in_world = transform(pose, in_robot)
print("in the robot's frame:", in_robot[0].round(3), "  in the world:", in_world[0].round(3))
print("at once:", transform(compose(pose, mount), in_sensor)[0].round(3))
print("the wrong way round:", transform(compose(mount, pose), in_sensor)[0].round(3))

# %% [markdown] slideshow={"slide_type": "fragment"}
# From the inside out: first the mount, then the pose. `compose(pose, mount)` is where the sensor
# itself stands in the world; turned round, it is nowhere.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Do it with the body: you are the robot, your outstretched left arm the sensor.
# A mount forgotten by 20 cm shows in no single scan; turn on the spot, and walls become doubled.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What the device says
#
# An RPLIDAR reports **degrees**, counted **clockwise** from its front, **millimetres**, and 0 for
# "nothing came back". Tuček's programs take its front for +y. `slamlab` knows metres, radians,
# counter-clockwise, front +x, NaN for nothing. All that is converted in **one** place:


# %% slideshow={"slide_type": "fragment"}
def from_device(degrees, millimetres):
    """A Scan from an RPLIDAR's rows: clockwise degrees to radians, mm to m, 0 to NaN."""
    ranges = np.where(millimetres > 0, millimetres / 1000, np.nan)
    return Scan(np.radians(-degrees), ranges)


def as_device(scan):
    """What the device would have said: the way back, for the experiment below."""
    return np.degrees(-scan.angles) % 360, np.nan_to_num(1000 * scan.ranges)


# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict:** somebody forgets the minus. What is wrong with a *single* scan then? Would you notice
# it on the screen? And what happens when the robot turns on the spot by 40° and scans again?

# %% slideshow={"slide_type": "fragment"}
views_of_room = [(np.zeros(3), "map"), (np.array([0, 0, np.radians(40)]), "naive")]
fig, panels = views.panels(["clockwise, converted", "the minus forgotten"], (10, 4.5))
for panel, sign in zip(panels, (1, -1), strict=True):
    for stands, colour in views_of_room:
        degrees, mm = as_device(ideal.scan(room, stands, np.random.default_rng(0)))
        points = transform(stands, from_device(sign * degrees, mm).points())
        label = "first scan" if colour == "map" else "turned by 40°"
        views.draw(panel, Points(colour, points), label=label, markersize=4)
    views.draw(panel, Poses("robot", [[0, 0, 0]]))
views.legend(panels[0], loc="upper left")
views.show(fig, "Left, two scans lie on each other; right, both are mirrored and do not agree.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** one mirrored scan looks like a room, only another one: nobody notices. After a turn the
# two disagree by 80°, twice the turn, because the map turns the wrong way. Test a driver with a
# robot that turns.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Noise
#
# A lidar is wrong in three ways: its range errs by a share of the range, its beam flies a little
# beside the direction reported, and some beams return nothing. Here is a **first guess** of an
# RPLIDAR A2; the last part of the lesson holds it against the real one.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
guess = Scanner(beams=400, range_error=0.004, bearing_sigma=np.radians(0.1), dropouts=0.03)
print(f"range  σ = {100 * guess.range_error:.2f} % of r")
print(f"bearing σ = {np.degrees(guess.bearing_sigma):.2f}°")
print(f"dropouts {100 * guess.dropouts:.0f} %, {guess.beams} beams a turn")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Question.** A tenth of a degree sounds like nothing. What does it do to the *range* of a wall
# that is seen at a slant? The range of a straight wall at distance δ, seen ι away from square on:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
delta, iota = sp.symbols("delta iota", positive=True)
r_wall = delta / sp.cos(iota)
sp.Eq(sp.Symbol("dr/dβ"), sp.diff(r_wall, iota))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.simplify(sp.diff(r_wall, iota) / r_wall)

# %% [markdown] slideshow={"slide_type": "fragment"}
# So dr = r tan ι dβ: at a grazing angle, a beam a little off meets the wall much farther out. The
# two errors are independent, their variances add: σ² = (e r)² + (r tan ι σ_β)².
#
# **Predict** from that the spread at ι = 80° (tan 80° ≈ 5.7), as a share of r. Then let the sensor
# look down a corridor 400 times without moving.

# %% slideshow={"slide_type": "fragment"}
rng, hall = np.random.default_rng(2), worlds.corridor()
far = replace(guess, range_max=20.0)
at_rest = np.array([far.scan(hall, np.zeros(3), rng).ranges for _ in range(400)])
r_true = hall.cast((0, 0), far.angles)
beside = hall.cast((0, 0), far.angles + 1e-6)
slant = np.arctan(abs(beside - r_true) / 1e-6 / r_true)
shares = np.nanstd(at_rest, axis=0) / r_true
grid = np.radians(np.linspace(0, 84, 100))
law = np.hypot(guess.range_error, np.tan(grid) * guess.bearing_sigma)

# %% slideshow={"slide_type": "fragment"}
predicted = {"predicted": 100 * law}
labels = "angle of incidence ι [degrees]", "σ / r [%]", "400 readings of each beam"
fig, ax = views.curves(np.degrees(grid), predicted, *labels)
ax.plot(np.degrees(slant), 100 * shares, ".", color=views.COLOURS["scan"], label="simulated")
ax.set(ylim=(0, 2), xlim=(0, 85))
views.legend(ax)
views.show(fig, "The spread of each beam lies on the predicted curve, which rises at a slant.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the marks lie on the curve: 0.4 % square on, more than twice that beyond 80°. The few far
# above it are beams that pass close to an edge: they meet now the near surface, now the one behind
# it. No Gaussian describes those.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is why a filter that trusts "σ = 1 % of r" everywhere is fooled by
# corridors: nearly all it sees there is seen at a slant. Ask what the picture would look like for a
# wall at 8 m instead of 2 (the same: all is in shares of r).

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What a beam cannot see
#
# Even without noise most of a building is out of sight: behind something (*occlusion*), or beyond
# the range. Smolec's situation 1: four rooms off a corridor, their doors face each other.
#
# **Predict:** how much of all the walls does a robot see from the middle of one room? And where
# does it see most?

# %% slideshow={"slide_type": "fragment"}
flat = worlds.situation_1()
steps = np.linspace(0, 1, 60)[:, None, None]
samples = ((1 - steps) * flat.walls[:, :2] + steps * flat.walls[:, 2:]).reshape(-1, 2)
metres = np.tile(np.hypot(*(flat.walls[:, 2:] - flat.walls[:, :2]).T) / 60, 60)


def in_sight(x, y):
    """The places on the walls that a sensor at (x, y) sees, with the share they are of all."""
    way = samples - [x, y]
    distance = np.hypot(*way.T)
    free = flat.cast((x, y), np.arctan2(way[:, 1], way[:, 0])) > distance - 1e-6
    fig, ax = views.axes(f"{metres[free].sum() / metres.sum():.0%} of the walls in sight")
    views.draw(ax, Segments("walls", flat.outline()))
    views.draw(ax, Points("in sight", samples[free]), markersize=6)
    views.draw(ax, Poses("robot", [[x, y, 0]]))
    return fig


views.explore(
    in_sight,
    "From the middle of a room one sees its own walls and a strip through each door.",
    x=(-1.9, 7.9, 0.1),
    y=(-1.9, 7.4, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** orange is in sight: the room itself, and through its door a strip of the corridor, the
# door across, and the far wall of the room behind. Move into the door (x = 0, y = 2) and on through
# the corridor: nowhere does one place show everything. That is what a *map* is for, and why it
# needs poses.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## An infrared sensor: the voltage tells
#
# The robot of the MAK thesis carries a GP2D120 on a servo. It sends infrared light and looks under
# which angle the spot on the wall appears (*triangulation*): its voltage is about V = k / r.
#
# **Predict:** the voltage is noisy by the same σ_V always. How does the error of r grow with r?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
k, V, r, s_V = sp.symbols("k V r sigma_V", positive=True)
slope = sp.diff(k / V, V)
sp.Eq(sp.Symbol("sigma_r"), sp.Abs(slope.subs(V, k / r)) * s_V)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the **square** of the range. For k = 0.12 V·m and 15 mV of noise:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for distance in (0.05, 0.10, 0.20, 0.28):
    derived, preset = distance**2 * 0.015 / 0.12, GP2D120.model.sigma(distance)
    print(f"{distance:.2f} m: derived {1000 * derived:5.2f} mm, GP2D120 {1000 * preset:5.2f} mm")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Three sensors, one place
#
# An **ultrasonic** sensor hears the first echo, whatever the direction: a cone of 25°, and the
# nearest surface in it wins. Now all three look at the MAK thesis' arena of cardboard boxes, from
# the same place.
#
# **Predict** each picture: which sensor sees most, which nothing but its own neighbourhood, and
# what becomes of the corners in the third?

# %% slideshow={"slide_type": "fragment"}
arena, stands = worlds.arena(), np.array([-0.12, -0.2, np.radians(100)])
devices = {"lidar": RPLIDAR_A2, "infrared": GP2D120, "ultrasonic": ULTRASONIC}
layers = {}
for title, device in devices.items():
    points = device.scan(arena, stands, np.random.default_rng(1)).points()
    title = f"{title}: {len(points)} of {device.beams} readings"
    hits = Points("scan", transform(stands, points))
    layers[title] = [Segments("walls", arena.outline()), hits, Poses("robot", [stands])]
fig, panels = views.side_by_side(layers, size=(11, 3.8))
for panel in panels:
    panel.lines[0].set_markersize(6)
views.show(fig, "The lidar sees most walls sharply, infrared only the near ones, sound round arcs.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the lidar draws what is in sight, but nothing nearer than 0.2 m. The infrared sensor sees
# only what is nearer than 0.28 m, sharply at 10 cm, fraying farther out. The ultrasonic sensor
# draws arcs: a whole fan of directions reports the same nearest place, so corners come out round
# and notches are filled.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The door that sound does not see
#
# A room as in situation 1, an ultrasonic sensor in front of its door, which is 1 m wide.
#
# **Predict:** how wide may the cone be, for the door to be seen from 2 m away? (The cone of 25° is
# 2 · 2 m · tan 12.5° ≈ 0.9 m wide there.) Then move the slider.


# %% slideshow={"slide_type": "fragment"}
ROOM_WITH_DOOR = World(
    [
        *[(-2, -1, 3, -1), (3, -1, 3, 2), (-2, 2, -2, -1), (-2, 3.5, 3, 3.5)],
        *[(3, 2, 0.5, 2), (-0.5, 2, -2, 2)],  # between these two: the door
    ]
)


def by_sound(cone_in_degrees):
    """What an ultrasonic scanner with that cone draws in front of a door."""
    device = replace(ULTRASONIC, cone=np.radians(cone_in_degrees), beams=91)
    before_door = np.array([0.2, 0.0, np.pi / 2])
    echoes = device.scan(ROOM_WITH_DOOR, before_door, np.random.default_rng(0)).points()
    heard = Points("scan", transform(before_door, echoes))
    layers = [Segments("walls", ROOM_WITH_DOOR.walls), heard, Poses("robot", [before_door])]
    fig, (ax,) = views.side_by_side({f"cone {cone_in_degrees:.0f}°": layers}, size=(6, 4.2))
    ax.lines[0].set_markersize(7)
    return fig


views.explore(
    by_sound,
    lambda cone_in_degrees: (
        f"A wall with a door as a cone of {cone_in_degrees:.0f} degrees hears it: the wider the "
        "cone, the narrower the door."
    ),
    cone_in_degrees=(0, 40, 25),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** at 25° the door posts close the door but for a direction or two, and the wall is bent. At
# 0° it is a lidar and the door stands wide open; at 30° it is gone. A robot that maps by sound
# walls itself in. The EKF note has such a sensor; it must know that the *bearing* of an echo is
# good to the cone only.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The real thing
#
# Three recordings of a real RPLIDAR A2 that stood still in a room: 8, 22 and 19 turns. They are
# other people's and not part of the course. Where they are missing, the next cell says so and goes
# on with a simulated log; the text below is about the real ones.

# %% slideshow={"slide_type": "fragment"}
try:
    paths = [sources.recording(f"rplidar-a2-{number}") for number in (1, 2, 3)]
    logs = [[reading.scan for reading in sources.open(path)] for path in paths]
    device_name = "real A2"
except sources.SourceError as missing:
    print(f"{missing}\n\nGoing on with a SIMULATED log instead: RPLIDAR_A2 in a corridor.")
    rng = np.random.default_rng(5)
    logs = [[RPLIDAR_A2.scan(worlds.corridor(), np.zeros(3), rng) for _ in range(20)]]
    device_name = "SIMULATED log"
print(device_name, [len(log) for log in logs], "turns")

# %% slideshow={"slide_type": "fragment"}
simulated = RPLIDAR_A2.scan(worlds.room(), np.zeros(3), np.random.default_rng(3))
fig, _ = views.side_by_side(
    {
        device_name: [Points("first turn", logs[0][0].points())],
        "RPLIDAR_A2 in the simulated room": [Points("one turn", simulated.points())],
    },
    size=(10, 4.5),
    shared=False,
)
views.show(fig, "Left a real room with an open side and a hallway beyond; right the simulated one.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** a room about 5 m wide, open at the top to a hallway that ends 12 m away. At a first look
# the two are of one kind. Look at the far wall: it is *ragged*, and more so than a fixed share of
# the range would make it. So let us measure. (In recordings 2 and 3 people walk about: that is what
# real recordings are like.)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Points a turn
#
# The simulator has 400 beams, 0.9° apart, always in the same directions. **Predict:** does the real
# device look in the same directions in every turn?

# %% slideshow={"slide_type": "fragment"}
for number, log in enumerate(logs, 1):
    sizes = [len(scan.ranges) for scan in log]
    gaps = [np.degrees(np.median(abs(np.diff(scan.angles)))) for scan in (log[0], log[-1])]
    print(
        f"recording {number}: {sizes[0]} points in the first turn, {sizes[-1]} in the last;", end=""
    )
    print(f" {gaps[0]:.2f}° apart, then {gaps[1]:.2f}°")

# %% [markdown] slideshow={"slide_type": "fragment"}
# From 537 down to 356 points, within one recording. The device measures at a steady rate, and its
# motor was still spinning up: fewer measurements fit into a faster turn. So neither the number nor
# the directions are fixed, and whoever compares beam 17 with beam 17 of the next turn compares two
# different places.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Repeated ranges at rest
#
# To see the noise, compare each reading with what the turn **before** says of that direction:
# between two readings that are near each other (not across an edge) a straight line is good enough.
#
# The difference has the noise of three readings in it: its own, and (1 − τ) and τ times those of
# the two neighbours. Dividing by √(1 + τ² + (1 − τ)²) leaves the noise of one.


# %% slideshow={"slide_type": "fragment"}
def surface(turn, angles):
    """What a turn says of other directions: range, NaN where it is not smooth; tan ι; the root."""
    order = np.argsort(turn.angles)
    known, ranges = turn.angles[order], turn.ranges[order]
    right = np.clip(np.searchsorted(known, angles), 1, len(known) - 1)
    width, jump = known[right] - known[right - 1], ranges[right] - ranges[right - 1]
    tau = (angles - known[right - 1]) / width
    r = ranges[right - 1] + tau * jump
    with np.errstate(invalid="ignore"):
        smooth = (abs(jump) < 0.05 * r) & (abs(tau - 0.5) <= 0.5)
    return np.where(smooth, r, np.nan), abs(jump) / width / r, np.sqrt(1 + tau**2 + (1 - tau) ** 2)


def repeats(before, scan):
    """Rows of (range expected from the turn before, error of this reading, tan ι)."""
    expected, slant, root = surface(before, scan.angles)
    rows = np.column_stack([expected, (scan.ranges - expected) / root, slant])
    return rows[~np.isnan(expected)]


def all_repeats(logs):
    """The rows of all pairs of turns that follow one another."""
    pairs = [pair for log in logs for pair in pairwise(log)]
    return np.vstack([repeats(*pair) for pair in pairs])


# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict:** the data sheet allows 0.75 % of the range, Smolec simulates 1 %, our guess is 0.4 %.
# Which is nearest?


# %% slideshow={"slide_type": "fragment"}
def robust(errors):
    """Standard deviation told by the median: a few gross errors do not move it."""
    return 1.4826 * np.nanmedian(abs(errors))


data = all_repeats(logs)
share = data[:, 1] / data[:, 0]
kept = abs(share) < 0.03  # not people who walked through the beam
print(f"{device_name}: {len(share)} pairs, {np.isnan(share).sum()} of them came back empty")
print(f"root mean square {100 * np.sqrt(np.mean(share[kept] ** 2)):.2f} % of r")
print(f"by the median    {100 * robust(share):.2f} % of r")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Two answers. The root mean square says 0.39 %, and that is where our guess comes from. The median
# says 0.25 %: *most* readings are better than that. If the noise were Gaussian and the same share everywhere,
# the two would agree. So it is not.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let them find reasons why the two differ before going on: noise that is not
# the same share at all ranges; slanted walls; edges; people. The next two sections take slant
# and range. Data sheets give one number because one number fits into a table.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## At a slant
#
# The law above, (r tan ι σ_β)², holds for every device whose beam jitters. Take ranges of 2 to 4 m
# only, and sort them by incidence.
#
# **Predict:** will the guess, 0.1° of bearing noise, fit?

# %% slideshow={"slide_type": "fragment"}
middle = data[(data[:, 0] > 2) & (data[:, 0] < 4)]
incidence = np.degrees(np.arctan(middle[:, 2]))
square_on = robust((middle[:, 1] / middle[:, 0])[incidence < 15])
print("ι [degrees]   measured   predicted with σ_β = 0.1°   (σ / r, per cent)")
for low in (0, 15, 30, 45, 60):
    there = middle[(low <= incidence) & (incidence < low + 15)]
    predicted = np.hypot(square_on, np.median(there[:, 2]) * np.radians(0.1))
    told = 100 * robust(there[:, 1] / there[:, 0]), 100 * predicted
    print("{:3} to {:2}       {:.2f}       {:.2f}".format(low, low + 15, *told))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The real device gets worse at a slant, and 0.1° fits up to 60°; beyond, it is worse than predicted.
# (Less light comes back at a slant, too; these data cannot tell the two apart.)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Does σ grow like r?
#
# Now leave the slanted ones out: only readings with tan ι below ½.
#
# **Predict:** plotted over r on doubly logarithmic axes, a σ that is a fixed share of r has slope
# 1. Which slope will the real one have?


# %% slideshow={"slide_type": "fragment"}
def by_range(rows, edges=(2, 2.5, 3, 3.5, 4, 5, 6, 8, 10, 13), least=50):
    """Range and robust σ of the errors, a row for each bin with enough readings."""
    bins = [rows[(low <= rows[:, 0]) & (rows[:, 0] < high)] for low, high in pairwise(edges)]
    return np.array([[b[:, 0].mean(), robust(b[:, 1])] for b in bins if len(b) >= least])


r_bin, sigma_bin = by_range(data[data[:, 2] < 0.5]).T
squares = np.polyfit(r_bin**2, (sigma_bin / r_bin) ** 2, 1, w=(r_bin / sigma_bin) ** 2)
curvature, error = np.sqrt(np.maximum(squares, 0))
print(f"fit: σ² = ({100 * error:.2f} % · r)² + ({1000 * curvature:.2f} mm/m² · r²)²")

# %% slideshow={"slide_type": "fragment"}
claims = {
    "Smolec: 1 %": 0.01 * r_bin,
    "guess: 0.4 %": 0.004 * r_bin,
    "fit: r and r²": np.hypot(error * r_bin, curvature * r_bin**2),
}
measured = {device_name: 1000 * sigma_bin}
in_mm = {name: 1000 * sigma for name, sigma in claims.items()}
fig, ax = views.growth(r_bin.round(1), measured, in_mm, "range r [m]", "σ [mm]", "At rest")
share = [f"{s / r:.1%} of the range at {r:.0f} m" for r, s in zip(r_bin, sigma_bin, strict=True)]
views.show(fig, f"The spread grows with r²: {share[0]}, {share[-1]}.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the marks cross the line of our guess at about 7 m: the real device is more than twice
# as good at 2.4 m (4 mm), and worse by more than half at 11.5 m (7 cm). One share for all ranges
# fits nowhere but in the middle. The data sheet's 0.75 % lies between the two lines and holds, just
# about, everywhere: it is a promise, not a description. The fit adds a part that grows with r².
# Where have we seen that?

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The fingerprint
#
# The infrared sensor measured 1/r. If the A2 does the same, in whole steps of some size q, then r
# comes in steps too: a step of 1/r is a step of q r² in r. Against that stands the unit of the
# log: whole millimetres.
#
# **Predict:** at 3 m and at 11 m, how far apart are neighbouring values of r that ever occur?

# %% slideshow={"slide_type": "fragment"}
ranges = np.concatenate([scan.ranges for log in logs for scan in log])
values = np.unique(np.round(1000 * ranges[np.isfinite(ranges)]))
for low, high in [(3.0, 3.2), (4.5, 4.7), (6.8, 7.2), (11.0, 11.4)]:
    near = values[(1000 * low <= values) & (values < 1000 * high)]
    if len(near) > 5:
        step, r_there = np.median(np.diff(near)), (low + high) / 2
        print(f"{low:4.1f} m: {step:2.0f} mm apart; step / r² is {step / r_there**2:.3f} mm/m²")

# %% [markdown] slideshow={"slide_type": "fragment"}
# At 11 m every range that occurs is 11 or 12 mm from the next; nothing in between ever does. At 7 m
# it is 5 mm, at 4.5 m 2 mm: always about 0.1 mm/m² times r². The device measures **1/r**: it
# triangulates, as the infrared sensor does. That is why its σ grows with r². No data sheet was
# needed: the numbers told it.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The one moment of detective work; give it time. At 3 m and below, the
# whole millimetres of the log are coarser than the device's own steps: nothing can be told there.
# Can the method be trusted? Without the recordings the same cells run on the simulated RPLIDAR_A2:
# they give back its σ, its dropouts, and a step / r² that is no constant.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Empty returns
#
# 2.7 to 3.3 % of all readings are empty, so our guess drops 3 % of its beams, by chance.
#
# **Predict:** are the real ones spread by chance, too?

# %% slideshow={"slide_type": "fragment"}
title = "Each empty return of one recording; in the lowest row, one simulated turn"
fig, ax = views.chart("bearing [degrees]", "turn", title, (8, 3.2))
whole = max(logs, key=len)
for number, scan in enumerate(whole):
    empty = np.degrees(scan.angles[np.isnan(scan.ranges)]) % 360
    ax.plot(empty, np.full(len(empty), number), "|", color=views.COLOURS["naive"])
chance = guess.scan(worlds.corridor(), np.zeros(3), np.random.default_rng(7))
lost = np.degrees(chance.angles[np.isnan(chance.ranges)]) % 360
ax.plot(lost, np.full(len(lost), -3), "|", color=views.COLOURS["corrected"])
ax.set(xlim=(0, 360), yticks=(0, 5, 10, 15, 20))
views.show(fig, "Empty returns stand above each other in a few directions, turn after turn.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** they stand in columns: the same directions are empty turn after turn. The broad one looks
# through the open side at something that the device does not see: too far, too dark, too slanted,
# or glass. The slanted line is the edge of a person who walks by. The single turn at the bottom,
# from the simulator, has its empties anywhere.

# %% slideshow={"slide_type": "fragment"}
empty = np.isnan(data[:, 1])
for low, high in [(0, 2), (2, 3), (3, 5), (5, 8), (8, 13)]:
    there = (low <= data[:, 0]) & (data[:, 0] < high)
    if there.sum() > 100:
        lost = 100 * empty[there].mean()
        print(f"smooth surface at {low} to {high} m: {lost:.1f} % of {there.sum()} empty")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Where the turn before saw a smooth surface, less than one reading in a hundred is lost up to 8 m,
# and four beyond. (Nearer than 2 m there was nearly nothing but people, and they walk on.) So most
# empties are no dropouts at all: they say "nothing here that I can see", and that is knowledge.
#
# A **dropout** is an empty reading where there *is* something. To be sure that it is still there, ask
# the turn after, too. **Predict:** what is left of the 3 %?

# %% slideshow={"slide_type": "fragment"}
lost, triples = [], [log[i : i + 3] for log in logs for i in range(len(log) - 2)]
for before, scan, after in triples:
    one, other = (surface(turn, scan.angles)[0] for turn in (before, after))
    with np.errstate(invalid="ignore"):
        lost += np.isnan(scan.ranges[abs(one - other) < 0.05 * one]).tolist()
print(f"the turn before saw a surface:     {100 * empty.mean():.2f} % empty")
print(f"the turns before and after saw it: {100 * np.mean(lost):.2f} % empty")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first number still has people in it; the second leaves out every spot that is lost more often
# than seen. The device lies between the two, and far below the guess: call it 0.5 %.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What the simulator lacks
#
# The package's preset `RPLIDAR_A2` holds what such a fit gives over all ranges and slants at once:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
e, c = RPLIDAR_A2.range_error, RPLIDAR_A2.range_curvature
print(f"range σ² = ({100 * e:.2f} % · r)² + ({1000 * c:.2f} mm/m² · r²)²")
print(f"bearing σ = {np.degrees(RPLIDAR_A2.bearing_sigma):.2f}°")
print(f"dropouts {100 * RPLIDAR_A2.dropouts:.1f} %")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Set preset and first guess in the middle of square rooms of all sizes, and treat what they say
# like the real device's. **Predict** where the three curves part.


# %% slideshow={"slide_type": "fragment"}
def on_the_bench(device, distance):
    """σ / r of a simulated device at rest, as measured above, with walls at that distance."""
    square = World(worlds.box((0, 0), (2 * distance, 2 * distance)))
    device, rng = replace(device, range_max=20.0), np.random.default_rng(9)
    rows = all_repeats([[device.scan(square, np.zeros(3), rng) for _ in range(20)]])
    rows = rows[rows[:, 2] < 0.5]
    return robust(rows[:, 1] / rows[:, 0])


benches = {
    name: [100 * on_the_bench(device, distance) for distance in r_bin]
    for name, device in {"RPLIDAR_A2": RPLIDAR_A2, "first guess": guess}.items()
}
fig, ax = views.curves(r_bin, benches, "range r [m]", "σ / r [%]", "σ at rest, by the median")
ax.plot(r_bin, 100 * sigma_bin / r_bin, "o", color=views.COLOURS["truth"], label=device_name)
ax.set_ylim(0, 1)
views.legend(ax)
views.show(
    fig, "The preset follows the real device's rise with range; the first guess stays level."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the preset follows the real device within a quarter, the first guess is level.
#
# | of the real device | in the simulator |
# |---|---|
# | σ grows with r²: 0.15 % of r at 2.4 m, 0.65 % at 11.5 m | yes, `range_curvature` |
# | worse at a slant, as 0.1° of bearing noise makes it | yes |
# | steps of 1/r: 12 mm at 11 m | no |
# | few empties on surfaces, more beyond 8 m | by chance, 0.5 % everywhere |
# | empties in fixed directions: past edges, into the open | only beyond the range |
# | errors that are the same in every turn | no; a device at rest cannot tell |
# | number and directions of beams change from turn to turn | fixed |
# | gross errors at edges | only that the beam jitters across them |
# | dark, shiny, transparent surfaces | no; these recordings cannot tell |
#
# A simulator need not have it all. Its user must know what it lacks.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which of the rows would matter for a filter (σ with range: yes, it
# says how much a near reading is worth against a far one; steps: hardly) and which for a grid map
# (empties: a direction that is always empty is not free space).

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Odometry is a sensor, too
#
# An encoder counts *ticks* of a wheel: whole ones, of the wheel's turning, not of the robot's way.
# Three errors: the tick is finite, the wheel slips, and its size is not what one believes.
#
# **Predict:** 300 robots drive 1 m, then 4 m, then 16 m. Which of the three errors stays as it is,
# which grows with the way, which with its root?


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def odometry_errors(robot, way, robots=300):
    """How much longer a way is believed to be than it was [mm]: mean and spread."""
    wrong = []
    for seed in range(robots):
        drive, excess = Simulator(robot, np.random.default_rng(seed)), 0.0
        for _ in range(5 * way):
            before = drive.pose
            believed = drive.step(0.4, 0.0, 0.5 + 1e-5 * seed)
            excess += believed[0] - between(before, drive.pose)[0]
        wrong.append(1000 * excess)
    return np.mean(wrong), np.std(wrong)


perfect = DifferentialDrive(tick=1e-6)
spoilt = {"ticks of 5 mm": {"tick": 0.005}, "slip": {"slip": 0.01}}
spoilt["wheels 1 % larger"] = {"left_scale": 1.01, "right_scale": 1.01}
for name, change in spoilt.items():
    errors = [odometry_errors(replace(perfect, **change), way) for way in (1, 4, 16)]
    told = [f"{round(mean):4} ± {spread:2.0f}" for mean, spread in errors]
    print(f"{name:18}", "  ".join(told), "mm after 1, 4, 16 m")

# %% [markdown] slideshow={"slide_type": "fragment"}
# A tick is lost or won once and stays; slip is chance, four times the way gives twice the error; a
# wrong wheel is a *bias* that grows with the way, and could be calibrated away. A filter that takes
# all three for independent noise is right about one.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A world is a text file
#
# Four numbers are a wall, three a circle, # begins a comment. So measure your own room.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
MY_ROOM = """
-1 -1  3 -1    # four walls and a pillar
 3 -1  3  2
 3  2 -1  2
-1  2 -1 -1
1.5 0.8 0.3
"""
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "my_room.txt"
    path.write_text(MY_ROOM, encoding="utf-8")
    mine = worlds.load(path)
    worlds.save(mine, path)
    again = worlds.load(path)
print(mine.name, len(mine.walls), "walls,", len(mine.circles), "circle")
print("saved and loaded: the same", np.array_equal(mine.walls, again.walls))

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict:** what should a program say to a wall without length, a number that is none, a line
# with five? "The line, and what is wrong with it" is the least.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
    for line in ("1 1 1 1", "0 0 one 2", "0 0 1 1 1", "2 2 -0.1", "0 0 1 nan"):
        Path("broken.txt").write_text(MY_ROOM + line, encoding="utf-8")
        try:
            worlds.load("broken.txt")
        except WorldFileError as refused:
            print(refused)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Move a wall, watch the scan
#
# Below is situation 2, and what a lidar at the origin sees of it. Drag a corner, or choose it by Tab
# and move it by the arrow keys: walls snap to 0.05 m (with Shift to 0.01 m), and the rows follow. Or
# change a row, or add one, and click outside. *Undo* takes it back.
#
# **Predict:** you pull the corner (−2.4, −3.2) to the right: does more of the bay in the lower left
# come into sight, or less? And which points vanish when a pillar of 0.2 m (`-1 -1 0.2`) is put into
# the room?


# %% slideshow={"slide_type": "fragment"}
def seen_from_the_origin(world):
    return RPLIDAR_A2.scan(world, np.zeros(3), np.random.default_rng(2)).points()


editor = edit_world(
    worlds.situation_2(),
    "An irregular room with one slanted wall, and what a lidar near its upper right sees of it.",
    scan=seen_from_the_origin,
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the bay in the lower left is half hidden behind a corner: no point lies there, and pulled
# to the right the corner hides less of it. A pillar hides a strip behind itself that widens with
# distance: drag it towards the robot, and its shadow widens.
# `worlds.save(editor.world, "mine.txt")` keeps what you drew.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What you can do now
#
# Cast a ray, place a scan in the world whatever the device's units, tell σ from recordings, and say
# what a simulator leaves out.
#
# **Next:** every reading is a little wrong, and so is every belief about the robot. How much weight
# does each deserve? [03 · The Kalman filter](03_kalman_filter.ipynb) derives it.
#
# **Exercise:** [cast rays, place a scan, make noise and find its size
# again](../exercises/ex02_sensors_and_worlds.ipynb), about 60 minutes.
