# %% [markdown] slideshow={"slide_type": "slide"}
# # 14 · The eMIR system
#
# **You will be able to** turn a lidar's bytes into points with pencil and paper, find a wrong sign
# without knowing the room, add up a robot's way from counters that overflow, test a program you did
# not write, calibrate a robot with a tape, record a drive and play it again, and drive a robot
# through a room while its map grows before you.
#
# **110 minutes** (30 for bytes and signs, 30 for eMIR, 20 for the bugs, 30 live). **Before:**
# lesson [01](01_why_slam.ipynb) for poses, lesson [13](13_scan_matching.ipynb) for scan matching.
#
# Source: Tuček, chapters 2, 4 and 5 with the listings; Slamtec's protocol.
#
# *Key:* between the world and the mathematics there are bytes. A shift, a sign or an overflow there,
# and the best filter maps a room that does not exist.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* No device is needed: what is emulated here sends the bytes of the real ones.
# With an RPLIDAR and an eMIR on the desk, name their ports in one cell (section "Your robot") and
# all that follows it runs on them. The live part stands alone as a demonstration. Let the class
# type the first decoder themselves, before they see it.

# %% slideshow={"slide_type": "skip"}
import tempfile
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
import sympy as sp
from scipy.spatial import cKDTree

from slamlab import estimators, sources, views, worlds
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Calibration, commands
from slamlab.devices.emir.frames import COMMAND, Framer, checksum, frame
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.emir.status import Status
from slamlab.devices.emulator.robot_body import RobotBody
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.synthetic_recording import record_synthetic_drive
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.sources.emulated_devices import EmulatedDevices
from slamlab.devices.recording.decoding import statuses, turns
from slamlab.devices.recording.recording_file import RX, parse
from slamlab.devices.rplidar.capsules import ExpressDecoder
from slamlab.devices.rplidar.measurement_nodes import ScanDecoder
from slamlab.devices.rplidar.requests import Command, express, request
from slamlab.devices.rplidar.revolutions import robot_frame
from slamlab.sources.live_devices import devices
from slamlab.geometry import between, matrix, transform
from slamlab.layers import Points, Poses, Segments

# %% [markdown] slideshow={"slide_type": "slide"}
# # From bytes to points
#
# The RPLIDAR A2 is a serial port with a motor. One writes a request of two bytes, `A5 20`, SCAN;
# it answers with seven bytes that say what follows, and then sends **without end**.
#
# Here is an emulated one, in Tuček's polygon. It is a machine that takes bytes and the time and
# gives bytes: no port, no thread, no waiting.


# %% slideshow={"slide_type": "fragment"}
def lidar_on(body, seed=1):
    """An emulated lidar that a robot carries."""
    rng = np.random.default_rng(seed)
    return RPLidarEmulator(MovingLidar(body, rng), rng=rng)


def heard(device, asked, begin, seconds):
    """What a device sends within so many seconds of being asked."""
    moments = begin + 0.01 * np.arange(1, round(100 * seconds) + 1)
    return device.feed(asked, begin) + b"".join(device.feed(b"", now) for now in moments)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
polygon = worlds.polygon()
standing = RobotBody(polygon, np.random.default_rng(0))
scan = heard(lidar_on(standing), request(Command.SCAN), 0.0, 1.0)
print("asked: ", request(Command.SCAN).hex(" "))
print("answer:", scan[:7].hex(" "))
for at in range(7, 27, 5):
    print("       ", scan[at : at + 5].hex(" "))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The answer says: `A5 5A`, packets of 05 bytes, 40 = without end, 81 = nodes. Then five bytes a
# point, a **node**:
#
# | byte | bits | meaning |
# | --- | --- | --- |
# | 0 | 0 | S, a turn begins here |
# | | 1 | not S |
# | | 2–7 | quality, 0 to 63 |
# | 1, 2 | 0 | C, always 1 |
# | | 1–15 | angle in 1/64 degree |
# | 3, 4 | 0–15 | distance in 1/4 mm; 0: nothing came back |
#
# **Little endian**: of two bytes the first is the low one. **Predict** with pencil and paper: which
# angle and which distance has the first node above?


# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Give the class three minutes. Collect the answers on the board before the next
# cell; the classics are no shift by one, big endian, and 1/64 forgotten. The exercise names each.


# %% slideshow={"slide_type": "fragment"}
def node(five):
    """Start of a turn?, quality, angle [degree] and distance [mm]; None where it is no node."""
    flags, angle, distance = five[0], five[1] | five[2] << 8, five[3] | five[4] << 8
    start, not_start, check = flags & 1, flags >> 1 & 1, angle & 1
    if start == not_start or not check:
        return None
    return bool(start), flags >> 2, (angle >> 1) / 64, distance / 4


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
by_hand = [node(scan[at : at + 5]) for at in range(7, len(scan) - 4, 5)]
start, quality, angle, distance = by_hand[0]
print(f"start {start}, quality {quality}, {angle:.3f}°, {distance} mm")
nodes = ScanDecoder().feed(scan[7:])
ours = np.array(by_hand)
same = ours[:, 2] * 64 == nodes["angle_q6"], ours[:, 3] * 4 == nodes["distance_q2"]
print(len(nodes), "nodes; the package's decoder reads the same:", np.all(same))

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Why a bit and its contrary?
#
# A byte gets lost on the line, and from then on every node is read one byte off. S, not S and C are
# there to notice.
#
# **Question.** How many random byte pairs would pass for the begin of a node? **Predict**, then
# count all 65 536.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
passing = sum(node([a, b, 0, 0, 0]) is not None for a in range(256) for b in range(256))
print(f"{passing} of 65536 pass: one in {65536 // passing}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# One in four: one good node proves nothing. The package's decoder trusts a step again only after
# four nodes in a row whose angles advance. Lose one byte in a thousand and see:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
lost = np.random.default_rng(3).random(len(scan)) < 0.001
torn = bytes(np.frombuffer(scan, np.uint8)[~lost])[7:]
decoder = ScanDecoder()
good = decoder.feed(torn)
print(f"{lost.sum()} bytes lost, {decoder.damage['resyncs']} times out of step")
print(f"{len(good)} of {len(nodes)} nodes are left, no exception")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A capsule: more points in fewer bytes
#
# The line carries 115 200 bit/s, ten bits a byte. **Predict:** how many nodes of five bytes is that
# a second, and how many in a turn of 0.1 s? Is that enough?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, size, points in (("nodes", 5, 1), ("capsules", 84, 32)):
    most = 115200 / 10 / size * points
    print(f"{name:>8}: {size / points:.2f} bytes a point, at most {most:.0f} points a second")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The A2 measures 4000 points a second: only half of them fit through the line as nodes. A
# **capsule** holds 32 points and *one* angle:
#
# | bytes | meaning |
# | --- | --- |
# | 0, 1 | high nibbles A and 5; low nibbles: XOR of bytes 2 to 83, its low half first |
# | 2, 3 | bits 0–14 the angle at its begin in 1/64 degree, bit 15: measuring began anew |
# | 4 to 83 | 16 cabins of 5 bytes, two points each |
#
# A cabin: two words of 16 bits, each a distance in mm (bits 2–15) and the top two bits of an angle
# offset (bits 0–1); a fifth byte with the low four bits of both offsets. Offsets are in 1/8 degree.


# %% slideshow={"slide_type": "subslide"}
def begin_of(capsule):
    """The angle at which a capsule begins [degree], or None where its checksum is wrong."""
    if np.bitwise_xor.reduce(list(capsule[2:])) != capsule[0] & 15 | (capsule[1] & 15) << 4:
        return None
    return ((capsule[2] | capsule[3] << 8) & 0x7FFF) / 64


def cabins(capsule):
    """(32, 2) distances [mm] and offsets [1/8 degree]."""
    points = []
    for at in range(4, 84, 5):
        a, b, c, d, low = capsule[at : at + 5]
        for word, nibble in ((a | b << 8, low & 15), (c | d << 8, low >> 4)):
            points.append((word >> 2, (word & 3) << 4 | nibble))
    return np.array(points)


# %% [markdown] slideshow={"slide_type": "fragment"}
# **Question.** One angle for 32 points: where do the others come from? From the **next** capsule's.
# The points lie evenly between, each less its offset, for the optics see a little behind where the
# motor stands:
#
# $$\alpha_k = \alpha + \frac{k}{32}\,(\alpha_{\text{next}} - \alpha) - \delta_k,
# \qquad k = 0 \dots 31$$


# %% slideshow={"slide_type": "fragment"}
def capsule_points(capsule, following):
    """Angles [degree] and distances [mm] of a capsule's 32 points."""
    alpha, turned = begin_of(capsule), (begin_of(following) - begin_of(capsule)) % 360
    mm, offset = cabins(capsule).T
    return (alpha + np.arange(32) / 32 * turned - offset / 8) % 360, mm


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
standing = RobotBody(polygon, np.random.default_rng(0))
stream = heard(lidar_on(standing), express(1), 0.0, 1.0)[7:]
capsules = [stream[at : at + 84] for at in range(0, len(stream) - 83, 84)]
angles, mm = np.hstack([capsule_points(*two) for two in pairwise(capsules)])
nodes = ExpressDecoder().feed(b"".join(capsules))
apart = (angles - nodes["angle_q6"] / 64 + 180) % 360 - 180
print(f"{len(capsules)} capsules, {len(angles)} points")
print("same distances as the package's decoder:", np.array_equal(4 * mm, nodes["distance_q2"]))
print("angles nearer than 1/64°:", np.abs(apart).max() < 1 / 64)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The whole difference is that the device counts in whole 1/64 degrees. Slamtec's *document* says
# something else than Slamtec's *program*: that the offset's top bit is a sign, and that k runs from
# 1. Both cannot be right. **How would you find out** without asking Slamtec? Keep that question:
# first we need points.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Two widely used Python drivers follow the document, Slamtec's own program does
# not. It is a good example of "the specification is what the other side does".

# %% [markdown] slideshow={"slide_type": "slide"}
# # Frames and signs
#
# The lidar counts its angle **clockwise**, seen from above, from its front. Mathematics, our poses
# and eMIR's odometry count counter-clockwise. Tuček draws the front along +y:
#
# $$x = d \sin\alpha, \qquad y = d \cos\alpha$$
#
# **Question.** Is that a wrong sign? Here the front is +x and $x = d\cos\alpha,\ y = -d\sin\alpha$.
# **Predict:** mirrored, turned, or the same?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
alpha, d = sp.symbols("alpha d", positive=True)
his = sp.Matrix([d * sp.sin(alpha), d * sp.cos(alpha)])
here = sp.Matrix([d * sp.cos(alpha), -d * sp.sin(alpha)])
quarter = sp.Matrix([[0, -1], [1, 0]])
sp.simplify(his - quarter * here).T

# %% [markdown] slideshow={"slide_type": "fragment"}
# His points are ours turned by 90°: both are right, each in its own frame. A **mirror** would be
# wrong, and nobody sees it in one picture:

# %% slideshow={"slide_type": "subslide"}
turn = slice(500, 900)
pictures = {}
for name, sign in {"clockwise": -1, "counter-clockwise": 1}.items():
    at = sign * np.radians(angles[turn])
    xy = mm[turn, None] / 1000 * np.column_stack([np.cos(at), np.sin(at)])
    pictures[f"angles read as {name}"] = [Points("scan", xy[mm[turn] > 0])]
fig, _ = views.side_by_side(pictures, size=(7, 3.6))
views.show(fig, "The same turn of the lidar twice, the right picture the mirror image of the left.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** two rooms that could both exist, walls equally sharp. Without a plan of the room no look
# at *one* scan tells which is real. Yet a robot that uses the wrong one will never build a map.
#
# **Question.** You may move the robot. Which experiment finds the wrong sign, in any room?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The answer is: turn it. If the robot turns left, the room must turn right
# around it. In the mirrored picture the room turns left. Driving straight ahead finds a wrongly
# mounted front. So: drive an arc, look before and after, and let odometry carry the second look
# over the first.

# %% [markdown] slideshow={"slide_type": "fragment"}
# Let it drive an arc. Then, for each sign and for each direction in which its front may be mounted,
# lay the second look over the first by odometry, and measure how badly they fit.


# %% slideshow={"slide_type": "fragment"}
def look(body, begin):
    """(n, 2) clockwise angles [degree] and distances [mm] of a second of looking."""
    heard_then = heard(lidar_on(body), express(1), begin, 1.0)
    nodes = ExpressDecoder().feed(heard_then[7:])
    nodes = nodes[nodes["distance_q2"] > 0]
    return np.column_stack([nodes["angle_q6"] / 64, nodes["distance_q2"] / 4])


driven = RobotBody(polygon, np.random.default_rng(0))
before = look(driven, 0.0)
driven.advance(25, 25, 4.0)  # 0.1 m/s and 25°/s until t = 4 s
driven.advance(0, 0, 4.0)
after, arc = look(driven, 4.0), driven.pose


# %% slideshow={"slide_type": "fragment"}
def misfit(sign, front):
    """Median distance of the second look's points from the first look's, by odometry [cm]."""
    first, second = (
        np.column_stack([r * np.cos(at), r * np.sin(at)])
        for at, r in ((np.radians(sign * (a - front)), r / 10) for a, r in (before.T, after.T))
    )
    moved = transform(arc * [100, 100, 1], second)
    return np.median(cKDTree(first).query(moved)[0])


# %% slideshow={"slide_type": "subslide"}
fronts = np.arange(-180, 181, 5)
fits = {
    name: [misfit(sign, front) for front in fronts]
    for name, sign in {"clockwise": -1, "counter-clockwise": 1}.items()
}
title = "the second look over the first, by odometry"
fig, ax = views.curves(fronts, fits, "front mounted at [°]", "misfit [cm]", title, (5.5, 3.2))
notch = fronts[np.argmin(fits["clockwise"])]
views.show(fig, f"One curve has a deep notch at {notch}°; the other stays high everywhere.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** one sign and one front fit, all else does not. The notch says "clockwise, front at 0°",
# and nobody had to know the room. Written as a test, it runs on any robot that can drive an arc:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
smallest = {name: min(each) for name, each in fits.items()}
for name, centimetres in smallest.items():
    print(f"{name:>17}: {'fits' if centimetres < 2 else 'never fits'}")
assert min(smallest, key=smallest.get) == "clockwise"
assert fronts[np.argmin(fits["clockwise"])] == 0

# %% [markdown] slideshow={"slide_type": "fragment"}
# **A trap.** Were eMIR's counter to grow to the *right*, the mirrored scan would fit: two wrong signs
# agree with each other, and the whole map is a mirror image. So settle one sign by eye: turn the
# robot to the left by hand, and see whether byte 15 grows. (If not, the scale of a count is
# negative; nothing else changes.)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Document or program?
#
# The same idea settles Slamtec's contradiction. Offsets are nearly always above 4°, where the top
# bit is set, so one of the two readings turns nearly every point. **Predict** which way the room
# will seem to turn when 7° are not taken off but a little is added.


# %% slideshow={"slide_type": "fragment"}
def as_documented(capsule, following):
    """A capsule's points as the document has them: the offset's top bit a sign, k from 1."""
    alpha, turned = begin_of(capsule), (begin_of(following) - begin_of(capsule)) % 360
    mm, offset = cabins(capsule).T
    offset = np.where(offset & 32, -(offset & 31), offset)
    return (alpha + np.arange(1, 33) / 32 * turned - offset / 8) % 360, mm


# %% slideshow={"slide_type": "fragment"}
pictures = {}
for name, read in {"program": capsule_points, "document": as_documented}.items():
    at, r = robot_frame(*np.hstack([read(*two) for two in pairwise(capsules[16:30])]))
    xy = np.column_stack([r * np.cos(at), r * np.sin(at)])
    pictures[f"as the {name} reads it"] = [Segments("walls", polygon.outline()), Points("scan", xy)]
fig, _ = views.side_by_side(pictures, size=(7, 3.7))
views.show(fig, "Left, the points lie on the walls; right, all are turned by some ten degrees.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** as the document has it, the whole room is turned clockwise by some ten degrees. Our
# emulator sends what the *program* expects, so this shows how they differ, not who is right. On a
# real A2 the arc test decides: right is the reading whose notch lies where the front really is.

# %% [markdown] slideshow={"slide_type": "slide"}
# # eMIR, and a checksum
#
# eMIR speaks text: `#`, four bytes as hexadecimal digits, `/`. Opcode, two arguments, checksum.
# Tuček prints three:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for text in ("#100100EF/", "#010000FF/", "#150000EB/"):
    values = bytes.fromhex(text[1:-1])
    print(text, "→", " + ".join(f"{value:3d}" for value in values), "=", sum(values))

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict** the rule. All four bytes add up to 256: to **0 modulo 256**. So the checksum is
# $(-(\text{opcode} + T + R)) \bmod 256$.
#
# For `move` (opcode 01) the listing computes it so, with T and R as bytes (negative ones plus 256):


# %% slideshow={"slide_type": "fragment"}
def as_printed(T, R):
    """The listing's move: the frame it sends for speeds in percent."""
    T, R = T % 256, R % 256
    return f"#01{T:02x}{R:02x}{256 - 1 - T - R:02x}/".upper()


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for T, R in ((50, 0), (-50, 0), (30, -20), (-10, 10), (-1, -1)):
    print(f"({T:3d}, {R:3d})  printed {as_printed(T, R):12}  right {commands.move(T, R).decode()}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Question.** Which commands go wrong, and how many of the 201 · 201? **Predict:** a handful, a
# quarter, a half? Then let the robot's own framer judge all of them.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
speeds = range(-100, 101)
understood = np.array(
    [[len(Framer(COMMAND).feed(as_printed(T, R).encode())) for R in speeds] for T in speeds]
)
print(f"{understood.size - understood.sum()} of {understood.size} commands are malformed")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Half of them. Why exactly 20 100? The difference goes below zero when the two *bytes* add to more
# than 255. Both negative: always, 100 · 100 pairs. One negative, −r: when the other is at least r.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
r = sp.symbols("r", integer=True)
both, mixed = 100 * 100, 2 * sp.summation(101 - r, (r, 1, 100))
print(both, "+", mixed, "=", both + mixed)

# %% slideshow={"slide_type": "subslide"}
T, R = np.meshgrid(np.arange(-100, 101, 5), np.arange(-100, 101, 5), indexing="ij")
plane, good = np.dstack([R, T]), understood[::5, ::5] > 0
fig, ax = views.chart("turn R [%]", "speed T [%]", "what becomes of a command", size=(4.8, 4.2))
views.draw(ax, Points("corrected", plane[good]), label="understood", markersize=5)
views.draw(ax, Points("naive", plane[~good]), label="dropped", marker="x", mew=1, markersize=4)
views.legend(ax, loc="upper right")
views.show(fig, "Speeds and turns: the quarter with both negative and two triangles are dropped.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** forwards with a turn to the left, everything is well: who tests only that never notices.
# Backwards with a turn to the right never works, and of the other two quarters half: a robot that
# drops the frame goes on with the *former* command. The right rule is one line, `-sum % 256`.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
mended = [frame(bytes([1, T % 256, R % 256])) for T in speeds for R in speeds]
print("understood:", len(Framer(COMMAND).feed(b"".join(mended))), "of", len(mended))
print("checksum of 01 CE 00:", f"{checksum(bytes([0x01, 0xCE, 0x00])):02X}")

# %% [markdown] slideshow={"slide_type": "slide"}
# # Odometry from counters
#
# eMIR answers, ours ten times a second, with `*`, 17 bytes, `/`. Byte 14 is the path in
# centimetres, byte 15 the turn in units of 2°, both **signed bytes**. Drive ahead at half speed,
# 20 cm/s:


# %% slideshow={"slide_type": "fragment"}
def driven_by(course, world=polygon, seed=1):
    """Statuses of an emulated eMIR on a course of (seconds, speed, turn) [s, %, %]; its body."""
    body = RobotBody(world, np.random.default_rng(seed))
    emir, framer, now, found = EmirEmulator(body), Framer(), 0.0, []
    emir.feed(commands.info(True), now)
    for seconds, v, omega in course:
        said = heard(emir, commands.move(v, omega), now, seconds)
        now += seconds
        found += [Status.unpack(content) for content in framer.feed(said)]
    return found, body


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
hall = worlds.corridor()
ahead, body = driven_by([(16, 50, 0)], hall)
path = np.array([status.path for status in ahead])
print("path, once a second:", *path[::10])

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Question.** After 127 comes −128: a byte has no more. How far has the robot gone? **Predict** a
# line of code that finds out, from two readings a and b that follow each other.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Offers will be: add 256 when it is negative (fails backwards), add 256 when the
# difference is below −128 (right). The remainder does both ways at once. Draw the ring of 256 values.

# %% [markdown] slideshow={"slide_type": "fragment"}
# The counter lives on a ring of 256 values. The difference b − a is known **modulo 256** only; the
# one between −128 and 127 is the shorter way round. Take that, then add up:
#
# $$\Delta = \bigl((b - a + 128) \bmod 256\bigr) - 128$$


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def unwrapped(values):
    """(n,) counts since the first of n signed bytes."""
    steps = (np.diff(values) + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])


print("unwrapped:", *unwrapped(path)[::10])
print("the package's odometry agrees:", end=" ")
odometry = Odometry(Calibration(path=1.0))
poses = [odometry.advance(status.path, 0, k / 10) for k, status in enumerate(ahead)]
print(np.array_equal(np.array(poses)[:, 0], unwrapped(path)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Question.** How seldom may one look? The thesis does so once a second. **Predict** the longest
# pause at full speed, 40 cm/s.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
fast = np.array([status.path for status in driven_by([(24, 100, 0)], hall)[0]])
for tenths in (10, 20, 30, 32, 35, 40):
    seldom, always = unwrapped(fast[::tenths])[-1], unwrapped(fast)[::tenths][-1]
    print(f"every {tenths / 10:3.1f} s: {seldom:4d} counts where there were {always}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# At 40 cm/s, 128 counts are over in 3.3 s; then the *other* way round is the shorter one, and the
# robot seems to back. For the turn, 100° a second, the limit is 2.6 s.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Read, then reset
#
# The thesis goes another way: read the counters, then send `reset`, so that they never overflow.
# **Predict:** what happens to the way between the reading and the reset?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
body = RobotBody(hall, np.random.default_rng(1))
emir, framer, total = EmirEmulator(body), Framer(), 0
emir.feed(commands.info(True) + commands.move(50, 0), 0.0)
for now in 0.95 + np.arange(14):
    last = framer.feed(emir.feed(b"", now))[-1]
    total += Status.unpack(last).path
    emir.feed(commands.reset_counters(), now)
print(f"read, then reset: {total} counts; the wheels made {body.counters()[0]}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# What is read was sent up to a tenth of a second ago, and what was rolled since is thrown away, once
# a second. Differences of successive readings lose nothing: whatever one misses, the next one has.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What is a count?
#
# The thesis multiplies by 10 mm and 2°. Another program for the same robots has 10.3 mm and 2.14°.
# Neither says where from. Our emulated robot is built to the second.
#
# Let it drive round a table, 11 m, and record every byte. **Predict:** 3 % of the way or 7 % of the
# turn, which does more harm?

# %% slideshow={"slide_type": "fragment"}
ROUND = [leg for way in (10.6, 6.8, 10.8, 6.6) for leg in ((way, 80, 0), (1.8, 0, 50))]
folder = tempfile.TemporaryDirectory()
drive = Path(folder.name) / "table.rec"
room = worlds.room()
true = record_synthetic_drive(
    drive, room, np.random.default_rng(6), [(0.5, 0, 0), *ROUND, (0.5, 0, 0)]
)
raw = drive.read_bytes()
recording = parse(raw, "table.rec")


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def way(path, angle):
    """(n, 3) poses of the drive when a count is so much [cm, degree]."""
    odometry = Odometry(Calibration(path / 100, np.radians(angle)))
    return np.array([odometry.advance(s.path, s.angle, time) for time, s in statuses(recording)])


def off(pose):
    """How far a last pose is from the truth, in words."""
    dx, dy, turned = between(true.poses[-1], pose)
    return f"{100 * np.hypot(dx, dy):.0f} cm, {abs(np.degrees(turned)):.0f}°"


guesses = {
    "thesis": (1, 2),
    "way mended": (1.03, 2),
    "turn mended": (1, 2.14),
    "both": (1.03, 2.14),
}
for name, counts in guesses.items():
    print(f"{name:>12}: {off(way(*counts)[-1])} off")


# %% slideshow={"slide_type": "subslide"}
def drawn(path_cm, turn_degrees):
    track = way(path_cm, turn_degrees)
    fig, ax = views.axes(f"by the counters: {off(track[-1])} off", size=(6, 4.2))
    views.draw(ax, Segments("walls", room.outline()))
    views.draw(ax, Poses("truth", true.poses[::10]))
    views.draw(ax, Poses("naive", track))
    views.legend(ax, loc="upper right")
    return fig


views.explore(
    drawn,
    "A room with a table; the true track closes round it, the naive one ends far from its start.",
    path_cm=(0.95, 1.10, 1.0),
    turn_degrees=(1.9, 2.3, 2.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** with the thesis' numbers each corner is 6° short, so the round does not close. Move
# `path_cm`: the track only grows, and a round trip even hides that. Move `turn_degrees` to 2.14: it
# ends where the robot is, to 3 cm. A wrong way is a wrong size, a wrong turn a wrong shape. The
# degrees that are left are slip: no number mends them.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Other drives end 3 to 40 cm and up to 10° off with both numbers right: the
# wheels slip at random. Ask why the turn is so much worse than the way: its error is multiplied by
# every metre that follows.

# %% [markdown] slideshow={"slide_type": "slide"}
# # The listing's other bugs
#
# The checksum was found by a test of all inputs. Most bugs need less: one small test each, for what
# the code *claims*. Read the function, say what it should do, **predict** whether it does, run.
#
# **1. Is the transform zero?** The listing asks, so that a robot that stands still adds no scan.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def transformation_is_zero(T):
    return T.sum() == 0


angle, x, y = sp.symbols("alpha x y", real=True)
c, s = sp.cos(angle), sp.sin(angle)
T = sp.Matrix([[c, -s, x], [s, c, y], [0, 0, 1]])
print("standing still:", transformation_is_zero(np.eye(3)), "| the sum is", sum(T))

# %% [markdown] slideshow={"slide_type": "fragment"}
# "No motion" is the identity, whose entries add to 3. A test of one line finds it: *standing still
# must count as standing still*. Right is to compare with the identity.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **2. The sensors asked for.** Sensors are numbered from 0, and all bytes are taken as signed.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def values_for_sensors(text, wanted):
    """In the listing's logic."""
    values = [int(text[i : i + 2], 16) for i in range(1, 35, 2)]
    values = [v - 256 if v > 127 else v for v in values]
    return [values[i] for i in wanted if i > 0 and i < len(values)]


said = Status(proximity=(35, 80, 80, 80, 62, 41), azimuth=150, path=-3, angle=7)
text = said.pack().decode()
print("sensors 0, 14, 15:", values_for_sensors(text, [0, 14, 15]))
print("compass, in 2°:   ", values_for_sensors(text, [13]), "for", said.azimuth)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Three were asked for, two came: `> 0` leaves out sensor 0. And a compass that points to 300° says
# −212°: only speed, rotation, the two motors, path and angle have a sign. *Ask for everything once*
# is the test.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **3. A bad frame.** The listing returns an empty list, the caller unpacks two numbers, and the main
# loop returns for good at the first scan that is empty.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def slam_routine(readings):
    """How many readings are used, in the listing's logic."""
    used = 0
    for points, odometry in readings:
        if len(points) == 0 or len(odometry) == 0:
            return used
        used += 1
    return used


rng = np.random.default_rng(5)
day = [([] if rng.random() < 0.02 else [1], [0, 0]) for _ in range(1000)]
print("used", slam_routine(day), "of 1000; empty were", sum(not points for points, _ in day))
try:
    translation, rotation = []
except ValueError as error:
    print("a bad frame:", error)

# %% [markdown] slideshow={"slide_type": "fragment"}
# One scan in fifty is empty, and at one scan a second the map ends after half a minute, without a
# word. Skip and count what is bad; end only when told to.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **4. Two robots, one map.** The listing makes its `Slam` in the body of the class. **5. A reading
# less.** It asks for `next(lidar.iter_scans())`, a new generator for each turn. **Predict** what is
# lost between two of them.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
class Slam:
    def __init__(self):
        self.points = []


class App:
    slam_instance = Slam()


def iter_scans(measured):
    scan = []
    for new_turn, reading in measured:
        if new_turn and scan:
            yield scan
            scan = []
        scan.append(reading)


a, b = App(), App()
a.slam_instance.points.append("scan of robot a")
print("robot b has:", b.slam_instance.points)
measured = iter([(k % 5 == 0, k) for k in range(20)])  # turns of five readings
print("turns:", *[next(iter_scans(measured)) for _ in range(3)])

# %% [markdown] slideshow={"slide_type": "fragment"}
# Test 4: *make two, use one, look at the other*. Test 5: *count what goes in and what comes out*: 5
# and 10 are missing. Each generator has taken the reading that begins the next turn, and dies with
# it. Right is to keep one generator.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **6. `exit`.** It ends the program. **Predict:** what does the robot do?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
body = RobotBody(hall, np.random.default_rng(1))
emir = EmirEmulator(body)
heard(emir, commands.move(50, 0), 0.0, 1.0)
at_exit = body.pose[0]
emir.feed(b"", 6.0)  # nobody is there any more
print(f"five seconds after exit it is {body.pose[0] - at_exit:.1f} m further")

# %% [markdown] slideshow={"slide_type": "fragment"}
# It drives on. `slamlab`'s drivers stop robot and motor when they are closed, also when the program
# ends by an error. (Only a killed process cannot.)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **7. The pseudo-code** has bugs that the listing has not. Take it at its word:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
points, T = np.array([[1.0, 2.0], [3.0, 4.0]]), matrix([5, 0, 0])
homogeneous = np.zeros((3, 2))
homogeneous[:2] = points.T  # ARRAY_TO_HOMOGENEOUS: the third coordinate is never set
print("moved by 5 m:", (T @ homogeneous)[:2].T.tolist())
try:
    np.dot(points, T)  # DotProduct(points, T)
except ValueError:
    print("DotProduct:   shapes", points.shape, "and", T.shape, "do not fit")
is_running, rounds = True, 0
while is_running is not True:  # SLAM_ROUTINE
    rounds += 1
print("SLAM_ROUTINE:", rounds, "rounds")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Nothing moves, for with a third coordinate of 0 a shift has nothing to act on; T stands on the left
# of a column, not on the right; and a loop "while not running" never begins. START, too, says the
# contrary: it opens a lidar just when somebody else brings the scans. And SLAM_ROUTINE asks the
# lidar for `get_lidar_data_method`, which the app has.
#
# The rest of the list:
#
# | in the listing | what follows | right |
# | --- | --- | --- |
# | second scan only remembered | first motion lost | lesson [13](13_scan_matching.ipynb) |
# | two poor scans in a row | ICP on fewer than 3 points | count the points first |
# | `get_coordinates` calls `scan()` | endless loop, two readers on a port | wait, with a time limit |
# | "after a gap no overlay is possible" | the map breaks in two | odometry goes on, match with it |
# | pseudo-code: naive points moved by one *step* | naive map heaps up at the origin | by the whole way |
# | "simulated error" in the recorded script | true steps are labelled so, the wrong ones run | name them |
# | "loop closure" for two scans in a row | it is scan matching | lesson 15 |
# | prompt "distance, angle" | they are sent as speeds in percent | see "Live" |

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A good exercise for pairs: one reads a function of the listing aloud, the other
# says the test. Ask which of these bugs can show in a picture made from four recorded scans.

# %% [markdown] slideshow={"slide_type": "slide"}
# # Your robot
#
# From here on there are drivers: a thread a device, ports that can vanish, real seconds. **Two names
# decide on which robot all that follows runs.** As they stand, each cell starts its own emulators
# and opens them through pseudo-terminals (TCP on Windows), as if cables hung there. (Is the notch
# of your lidar not at 0°? Hand `front=` to `devices`.)

# %% slideshow={"slide_type": "fragment"}
LIDAR_PORT = None  # such as "/dev/ttyUSB0" or "COM3"
EMIR_PORT = None  # such as "/dev/rfcomm0" or "COM12"


def robot(rng, calibration=None, clock=None):
    """Lidar and eMIR as a source of readings: yours, or emulated ones in the room."""
    if EMIR_PORT is None:
        return EmulatedDevices(worlds.room(), rng, calibration, clock)
    return devices(f"{LIDAR_PORT or ''},{EMIR_PORT}", calibration)


# %% [markdown] slideshow={"slide_type": "fragment"}
# What does not work says so in a sentence, with the likely cause and the next step:

# %% slideshow={"slide_type": "fragment"}
try:
    devices("socket://localhost:1,socket://localhost:2")
except sources.SourceError as error:
    print(error)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Calibrate it
#
# Guided, four steps:
#
# 1. Mark where the robot stands. **Run** the next cell: it drives 1 m by *its* count, then turns by
#    four quarters, by its count.
# 2. Measure the way with a tape and the turn with a protractor (the quarters together; 0° is a full
#    turn).
# 3. Write both into the cell after it: `TAPE` in metres, `PROTRACTOR` in degrees. With `None` the
#    emulator says what it knows.
# 4. Run that cell: it gives the scale factors.


# %% slideshow={"slide_type": "fragment"}
def counts_of(emir, order, *argument):
    """Counts of path and angle that an order takes, until the robot stands."""
    seen, quiet = [(emir.status.path, emir.status.angle)], 0
    order(*argument)
    while quiet < 5:
        status = emir.wait()
        seen.append((status.path, status.angle))
        quiet = quiet + 1 if seen[-1] == seen[-2] else 0
    return np.array([unwrapped(column)[-1] for column in np.transpose(seen)])


# emulators need not keep you waiting: for them it is simulated time that passes
with robot(np.random.default_rng(7), clock=SimulatedClock()) as source:
    emulated = getattr(source, "bench", None)
    marks = [emulated and emulated.body.pose]
    counts = [counts_of(source.emir, source.emir.translate, 1.0, 100)]
    marks.append(emulated and emulated.body.pose)
    for _ in range(4):
        counts.append(counts_of(source.emir, source.emir.rotate, 90, 50))
        marks.append(emulated and emulated.body.pose)

# %% slideshow={"slide_type": "fragment"}
TAPE = None  # [m]
PROTRACTOR = None  # [degree] beyond a full turn

if emulated is None:
    assert TAPE and PROTRACTOR is not None, "measure, write both numbers above, run this cell again"
    tape, turned = TAPE, 360 + PROTRACTOR
else:
    steps = between(np.array(marks[:-1]), np.array(marks[1:]))
    tape, turned = np.hypot(*steps[0, :2]), np.degrees(steps[1:, 2].sum())
path_count, turn_count = tape / counts[0][0], turned / sum(angle for _, angle in counts[1:])
calibrated = Calibration(path=path_count, angle=np.radians(turn_count))
print(f"{tape:.2f} m and {turned:.0f}°: a count is {100 * path_count:.2f} cm and {turn_count:.2f}°")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** near 1.03 cm and 2.14°, as it was built. One count more or less is 1 % of a metre: drive
# longer for a better number. A negative turn says that your robot counts clockwise; keep the sign.

# %% [markdown] slideshow={"slide_type": "slide"}
# # Record it, play it again
#
# A robot's day cannot be repeated, its bytes can. The recording above holds each piece that was read
# or written, with its time and a checksum:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
whole = list(turns(recording))
kinds = [record.kind for record in recording.records]
print(f"{recording.seconds:.0f} s, {len(kinds)} records, {kinds.count(RX)} of them received")
print(f"{len(whole)} turns, all complete: {all(turn.complete for turn in whole)}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The battery dies in mid-sentence: cut the file anywhere. **Predict:** how much is lost?


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def the_same(turns, others):
    """Whether turns are the same to the last bit, as far as both go."""
    pairs = zip(turns, others, strict=False)
    return all(np.array_equal(a.range_mm, b.range_mm) for a, b in pairs)


torn = parse(raw[: len(raw) * 3 // 5 + 1], "table.rec")
left = list(turns(torn))
print(f"{len(left)} of {len(whole)} turns, the same: {the_same(left, whole)}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Of what comes before the cut, only the torn record is lost. And does it matter in which **pieces** bytes come, which differs from
# machine to machine? Cut the lidar's bytes at random, many times:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
received = recording.received("lidar")
begin = received.index(bytes.fromhex("a5 5a 54 00 00 40 82")) + 7  # the answer to EXPRESS
received = received[begin : begin + 60_000]
at_once = ExpressDecoder().feed(received)
rng, differ = np.random.default_rng(6), 0
for _ in range(20):
    cuts = np.sort(rng.integers(0, len(received), 300))
    decoder = ExpressDecoder()
    pieces = np.split(np.frombuffer(received, np.uint8), cuts)
    differ += not np.array_equal(np.concatenate([decoder.feed(bytes(p)) for p in pieces]), at_once)
print(f"{len(at_once)} nodes; of 20 ways to cut, {differ} gave others")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In a shell:
#
# ```
# slamlab emulate --world room                   # two ports, until Ctrl-C
# slamlab record devices:LIDAR,EMIR --out my.rec # every byte; type V,OMEGA to drive
# slamlab replay my.rec                          # the devices again, behind two ports
# slamlab run my.rec                             # or straight into a SLAM
# ```
#
# So a class of forty needs one robot and one drive. `sources.open("my.rec")` is a source like any
# other, for every estimator of this course; and with the two ports of `slamlab replay` in
# LIDAR_PORT and EMIR_PORT, all that follows runs on that drive through the real drivers.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Record your own drive once, with the class in the room; next year it is played
# again. The robot of a replay goes its recorded way, whatever it is told.

# %% [markdown] slideshow={"slide_type": "slide"}
# # Live
#
# Tuček's program: two maps grow, the **naive** one by odometry alone and the **corrected** one by
# ICP. Here they stand side by side; odometry is the thesis', 1 cm and 2° a count.
#
# - **A recording** needs no robot: press *run* to see the drive round the table again.
# - **A robot**: press it, then *run*. Drive by the buttons, or click the picture and use the arrow
#   keys (space stops), or type as in the thesis: `distance, angle`, `reset`, `exit`. A way of
#   `0.5, 30` is a turn by 30° and then half a metre, by the corrected pose.
# - **A robot, calibrated**: the same with your own scale factors.
#
# *exit*, running the cell again or ending the kernel stops the robot and lets go of both ports;
# *pause* stops it, too.
#
# **Predict:** where will the two maps differ first, at the walls near by or at those far away?


# %% slideshow={"slide_type": "fragment"}
def told(pair):
    """How far both are off, where somebody knows the truth."""
    if not getattr(pair.source, "bench", None) or not len(pair.source.truth):
        return ""
    now = pair.source.truth.poses[: pair.count][-1]
    errors = [between(now, pose) for pose in (pair.estimator.naive_pose, pair.estimator.pose)]
    return "naive {:.0f} cm, corrected {:.0f} cm off".format(
        *(100 * np.hypot(*error[:2]) for error in errors)
    )


played = {
    "A recording": lambda rng: sources.open(drive),
    "A robot": robot,
    "A robot, calibrated": partial(robot, calibration=calibrated),
}

# %% slideshow={"slide_type": "slide"}
seen_live = views.live(
    played,
    views.apart(partial(estimators.make, "icp"), naive=(-8.5, 0)),
    "Left the naive map, its walls fanned out; right the corrected map, one sharp room.",
    steps=420,
    note=told,
    truth=False,
    title="eMIR: naive map on the left, corrected map on the right",
    speed=20,
    tops=(0.3, 0.6),
    size=(860, 400),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** after one round of the table the naive room has each wall several times, fanned out like
# cards; in the corrected one every wall is one line. Both come from the same bytes. The far walls
# smear first: a wrong heading is multiplied by the distance.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Pull the plug while it runs: on a real robot the USB cable, on the emulated one
# `seen_live.pair.source.bench["lidar"].faults.unplugged = True` in a new cell. Within a second a
# sentence stands below the picture, not a traceback; *reset* begins again. A class without robots
# opens your drive: `lambda rng: sources.open("my.rec")` behind the first button.

# %% [markdown] slideshow={"slide_type": "fragment"}
# How much better is it? The recording's truth is known, so count:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
slam = estimators.make("icp", sources.open(drive))
for reading in sources.open(drive):
    slam.step(reading)
distances = [np.hypot(*between(true.poses[-1], pose)[:2]) for pose in (slam.naive_pose, slam.pose)]
print("corrected pose at the end within 5 cm:", distances[1] < 0.05)
print("naive pose at least ten times worse:", distances[0] > 10 * distances[1])

# %% [markdown] slideshow={"slide_type": "fragment"}
# Calibrate the wheels, and the naive map gets better too; it never gets good. That is the point of
# SLAM on a cheap robot: the lidar pays for what the wheels do not know.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What you can do now
#
# Read a device's bytes, test for a wrong sign, unwrap counters, find bugs by small tests, calibrate,
# record, replay, and drive a robot through a growing map.
#
# **Next:** the corrected map is sharp after one round. In a larger building small errors add up, and
# where the robot comes back walls stand twice: lesson [15](15_closing_the_loop.ipynb) recognises
# places and closes the loop.
#
# **Exercise:** [decode nodes, frames and counters](../exercises/ex14_the_emir_system.ipynb), judged
# with bytes that no one has seen before.
