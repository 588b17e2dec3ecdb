# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 14 · The eMIR system
#
# **You will be able to** read a lidar's bytes, find a wrong sign without knowing the room, send commands that a
# robot does not drop, add up its way from counters that overflow, calibrate it with a tape, record a drive and
# play it again, and drive a robot through a room while its map grows before your eyes.
#
# **100 minutes**, in two parts: from bytes to points and commands (47), and from counters to a live map (53).
# **Before:** lesson [01](01_why_slam.ipynb) for poses, lesson [13](13_scan_matching.ipynb) for scan matching.
#
# eMIR is a small wheeled robot in Zagreb. Tuček's thesis puts a lidar on it, drives it by typed
# commands, and draws two maps while it drives. We build this system again, starting from its bytes.
#
# *Key:* between the world and the mathematics there are bytes. One wrong shift, sign or overflow there, and the
# best filter maps a room that does not exist.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* No device is needed, for the emulators here send the bytes of the real ones. If you have an
# RPLIDAR and an eMIR on the desk, name their ports in "Your robot", and all that follows runs on them. The last
# section, "Live", stands alone as a demonstration. If time is short, leave out "More points in fewer bytes" and
# "Record it, play it again". For a poll: the questions on the capsule, the experiment, the checksum, and the map.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import tempfile
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np

from slamlab import estimators, sources, views, worlds
from slamlab.checks import ask
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Calibration, commands
from slamlab.devices.emir.calibration_drive import calibration_drive
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emir.wheel_odometry import CounterUnwrapper
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.robot_body import COUNT_SIZE, TOP_SPEEDS, RobotBody
from slamlab.devices.emulator.synthetic_recording import record_synthetic_drive
from slamlab.devices.recording.decoding import turns
from slamlab.devices.recording.recording_file import RX, parse
from slamlab.devices.rplidar.capsules import ExpressDecoder
from slamlab.devices.rplidar.measurement_nodes import ScanDecoder
from slamlab.devices.rplidar.requests import Command, express, request
from slamlab.devices.rplidar.revolutions import robot_frame
from slamlab.geometry import between, matrix, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.sources.emulated_devices import EmulatedDevices
from slamlab.sources.live_devices import devices
from slamlab.studies import emir_trials as trials
from slamlab.studies import printed_drivers as printed

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## A lidar is a stream of bytes
#
# The RPLIDAR A2 is a motor with a laser, at the end of a serial port. We send it a request of two bytes, `a5 20`,
# which means *scan*. It answers with seven bytes that say what will follow. Then it sends points, without end.
#
# The lidar below is emulated: it is a small program that is given bytes and the time, and returns
# bytes. It needs no port, and we do not have to wait for it. It stands in Tuček's polygon of
# cardboard, which you know from lesson 13.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
polygon = worlds.polygon()
lidar = trials.lidar_on(RobotBody(polygon, np.random.default_rng(0)))
scan = trials.heard(lidar, request(Command.SCAN), begin=0.0, seconds=1.0)
print("asked: ", request(Command.SCAN).hex(" "))
print("answer:", scan[:7].hex(" "))
for at in range(7, 22, 5):
    print("       ", scan[at : at + 5].hex(" "))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The answer begins with `a5 5a`, as all answers do. The rest announces packets of `05` bytes,
# without end (`40`), of the kind `81`. A packet of five bytes is one point, and is called a
# **node**.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Reading a node
#
# What do five bytes mean? Only the maker's data sheet knows:
#
# | byte | bits | meaning |
# | --- | --- | --- |
# | 0 | 0 | S: a turn of the lidar begins here |
# | | 1 | the contrary of S |
# | | 2–7 | quality, 0 to 63 |
# | 1, 2 | 0 | C, always 1 |
# | | 1–15 | angle, in units of 1/64 degree |
# | 3, 4 | 0–15 | distance, in units of 1/4 mm; 0 if nothing came back |

# %% [markdown] slideshow={"slide_type": "subslide"}
# A number that does not fit into one byte takes two. The RPLIDAR sends the **low byte first** (this is called
# *little endian*), so
#
# $$\text{word} = \text{low} + 256 \cdot \text{high}. \tag{14.1}$$
#
# Bit 0 of the first word is C and does not belong to the angle. To drop it, we halve the word and forget the
# rest. With $\psi$ for the angle that the lidar counts, and $r$ for the distance,
#
# $$\psi = \frac{1}{64} \left\lfloor \frac{\text{word}_{1,2}}{2} \right\rfloor \text{degrees}, \qquad
# r = \frac{\text{word}_{3,4}}{4} \text{ mm}. \tag{14.2}$$

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-node",
    "With pencil and paper: the first node above is `be 75 93 3d 11`. **What is its angle?**",
    right=294.9,
    tolerance=0.2,
    unit="degrees",
    reason="the word is 75 + 256 · 93 in hexadecimal digits, that is 37 749. Half of it is 18 874, and a 64th of that 294.9.",
    wrong={
        589.8: "bit 0 is C and not part of the angle: halve the word first.",
        235.1: "you took the high byte first. Low comes first: 75 is the low byte, 93 the high one.",
        18874: "that is the angle in units of 1/64 degree.",
    },
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="14-node"
low, high = scan[8], scan[9]
word = low + 256 * high
half = word // 2
print(f"word {views.grouped(word)}, half of it {views.grouped(half)}, angle {half / 64:.2f}°")
nodes = ScanDecoder().feed(scan[7:])
print(f"the package's decoder: {nodes['angle_q6'][0] / 64:.2f}°, {len(nodes)} nodes a second")

# %% slideshow={"slide_type": "fragment"} answers="14-node"
FIELDS = {
    "check bits": [(0, 0), (0, 1), (1, 0)],
    "quality": [(0, bit) for bit in range(2, 8)],
    "angle": [(1, bit) for bit in range(1, 8)] + [(2, bit) for bit in range(8)],
    "distance": [(byte, bit) for byte in (3, 4) for bit in range(8)],
}


def read(node):
    found = ScanDecoder().feed(bytes(node))
    told = [f"{one['angle_q6'] / 64:.1f}°, {one['distance_q2'] / 4:.0f} mm" for one in found]
    return told[0] if told else "no node"


# %% slideshow={"slide_type": "fragment"} answers="14-node"
def one_bit_flipped(byte, bit):
    node = bytearray(scan[7:12])
    before = read(node)
    node[byte] ^= 1 << bit
    fig, _ = views.bits(node, FIELDS, (byte, bit), f"sent: {before}    read: {read(node)}")
    return fig


# %% slideshow={"slide_type": "subslide"} answers="14-node"
views.explore(
    one_bit_flipped,
    lambda byte, bit: (
        f"Five rows of eight bits, coloured by field; bit {bit} of byte {byte} is framed and flipped, "
        "so that another angle, another distance or no node is read."
    ),
    byte=(0, 4, 2),
    bit=(0, 7, 7),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-node"
# One bit was flipped on its way, and the point has jumped to the other side of the robot. The
# lowest bit of the angle would hardly have mattered. A flipped check bit is noticed, and so is an
# angle beyond 360°. Any other flipped bit of the angle or the distance puts a wrong point into the
# map.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Give the class three minutes with the first node. Then let somebody choose the bit that does
# the most harm, and the one that does the least.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## When a byte is lost
#
# Worse than a flipped bit is a lost byte. From then on every node is read one byte too early, and
# all of them are wrong. The three check bits are there to notice this: S must differ from its
# contrary, and C must be 1. How often do random bytes pass this test?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
combinations = [(S, contrary, C) for S in (0, 1) for contrary in (0, 1) for C in (0, 1)]
passing = [bits for bits in combinations if bits[0] != bits[1] and bits[2] == 1]
print(f"{len(passing)} of {len(combinations)} combinations pass")

# %% [markdown] slideshow={"slide_type": "fragment"}
# A quarter of all random bytes look like a node. So one good node proves nothing. A decoder that
# has lost its step should trust only several nodes in a row whose angles advance. The package's
# waits for four. We lose one byte in a thousand:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
lost = np.random.default_rng(3).random(len(scan)) < 0.001
torn = bytes(np.frombuffer(scan, np.uint8)[~lost])[7:]
decoder = ScanDecoder()
good = decoder.feed(torn)
print(f"{lost.sum()} bytes lost, {decoder.damage['resyncs']} times out of step")
print(f"{len(good)} of {len(nodes)} nodes are left, and no exception was raised")

# %% [markdown] slideshow={"slide_type": "fragment"}
# {= lost.sum() =} bytes cost {= len(nodes) - len(good) =} nodes of {= len(nodes) =}. Damaged
# streams are common, so a decoder counts the damage and goes on. An exception would end the map
# because of a single byte.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## More points in fewer bytes
#
# The line carries 115 200 bits a second. With its start bit and its stop bit a byte takes ten of
# them, so at most 2304 nodes fit into a second. But the lidar can measure a point every 254 µs,
# that is 3937 times a second. They do not fit.
#
# So there is another format, the **capsule**. It packs 32 points into 84 bytes:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, size, points in (("nodes", 5, 1), ("capsules", 84, 32)):
    most = 115200 / 10 / size * points
    print(f"{name:>8}: {size / points:.2f} bytes a point, at most {most:.0f} points a second")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The capsule saves room on the angles: a capsule holds 32 distances, and *one* angle $\psi$, that
# of its beginning. Each point brings only a small offset $\delta_k$, up to 8°, for the optics look
# a little behind the place where the motor stands.

# %% slideshow={"slide_type": "subslide"}
ask(
    "14-capsule",
    "A capsule says at which angle it begins, and nothing else about the motor. **Where do the angles "
    "of its other 31 points "
    "come from?**",
    {
        "from the motor's speed, ten turns a second": "ten is what the motor is told. It really makes 5 to 15 turns a second, "
        "and never exactly ten: the error would grow from point to point.",
        "from the angle of the next capsule": "the lidar measures at a steady pace, so the points lie evenly between two "
        "beginnings.",
        "all 32 share one angle": "at ten turns a second and 3937 points, 32 points cover some 29 degrees.",
    },
    right="from the angle of the next capsule",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-capsule"
# The next capsule tells how far the lidar has turned meanwhile. The points are taken at a steady pace, so they
# lie evenly between the two beginnings, $\psi$ and $\psi'$. Point $k$ is
#
# $$\psi_k = \psi + \frac{k}{32}\,\bigl((\psi' - \psi) \bmod 360^\circ\bigr) - \delta_k \tag{14.3}$$
#
# for $k$ from 0 to 31. The remainder keeps the difference positive where the lidar passes 360°. The price is a
# delay: the last capsule cannot be read before the next one has come.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="14-capsule"
lidar = trials.lidar_on(RobotBody(polygon, np.random.default_rng(0)))
stream = trials.heard(lidar, express(1), begin=0.0, seconds=1.0)[7:]
capsules = [stream[at : at + 84] for at in range(0, len(stream) - 83, 84)]
for count in (1, 2, 3):
    found = ExpressDecoder().feed(b"".join(capsules[:count]))
    print(f"{count} capsules received: {len(found)} points known")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-capsule"
# A capsule carries a checksum, too: the exclusive or of bytes 2 to 83. Random bytes pass it once in
# 256 times, not once in four. (Slamtec's document and Slamtec's program disagree about (14.3). A
# *Deeper* section at the end settles it.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Clockwise
#
# An angle and a distance are not yet a point. The RPLIDAR counts its angles **clockwise**, seen from above, from
# its front. Our poses count counter-clockwise. So a lidar whose front is the robot's front sees its point at
#
# $$x = r \cos\psi, \qquad y = -r \sin\psi. \tag{14.4}$$
#
# What if somebody forgets the minus?

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
looks = {
    "an arc": trials.two_looks(speed=25, turn=25),
    "straight ahead": trials.two_looks(speed=25, turn=0),
}
pictures = {}
for clockwise in (True, False):
    first, _ = looks["an arc"].overlaid(clockwise)
    pictures[f"read as {'clockwise' if clockwise else 'counter-clockwise'}"] = [
        Points("scan", first)
    ]
fig, _ = views.side_by_side(pictures, size=(9, 4.2))
views.show(
    fig, "Two maps of one turn of the lidar; the right one is the mirror image of the left one."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Both rooms have sharp walls, and both could exist. If we do not know the room, *one* scan cannot
# tell us which of them is real. And yet a robot that believes in the mirror image cannot lay a
# second scan over the first, as we shall see.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## The experiment that finds a wrong sign
#
# You do not know the room. But you may move the robot, and its wheels tell how it moved. So let it
# look, move it, let it look again, and lay the second look over the first as the wheels say. If the
# sign is right, the walls coincide.

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-experiment",
    "**Which motion shows that a sign is wrong, in any room?**",
    {
        "none: look at one scan more closely": "a mirrored room is a possible room. One scan holds nothing that contradicts it.",
        "drive straight ahead": "the mirror image slides backwards past the robot just as the room does. Both signs fit.",
        "turn": "if the robot turns to the left, the room turns to the right around it. Its mirror image turns to the left.",
        "stand still for longer": "that lowers the noise, and a sign is no noise.",
    },
    right="turn",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-experiment"
# ### Why a turn tells
#
# A wall's point that is at $p'$ for the second look was at $p = \mathrm{Rot}(\theta)\, p' + t$ for
# the first one, where the wheels tell us $\theta$ and $t$. Without the minus we see $M p$ and
# $M p'$, where $M$ is the mirror that changes the sign of $y$. How are these two related? A mirror
# reverses a rotation:
#
# $$M\,\mathrm{Rot}(\theta) = \mathrm{Rot}(-\theta)\,M, \qquad \text{so} \quad M p = \mathrm{Rot}(-\theta)\,M p' + M t. \tag{14.5}$$

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-experiment"
# The wheels say $\mathrm{Rot}(\theta)$ where $\mathrm{Rot}(-\theta)$ would be needed: the second look comes out
# turned by $2\theta$. If the robot drives straight ahead, $\theta$ is 0, and $t$ lies on the $x$ axis, which the
# mirror leaves alone. Then everything fits.
#
# Conversely, a turn on the spot tells nothing about where the lidar's front is, but a drive does.
# So we drive an **arc**, which is a turn and a drive in one.


# %% slideshow={"slide_type": "fragment"} answers="14-experiment"
def laid_over(angles_read_as, drive, front):
    clockwise = angles_read_as == "clockwise"
    first, second = looks[drive].overlaid(clockwise, front)
    misfit = looks[drive].misfit(clockwise, front)
    fig, _ = views.overlay(first, second, title=f"misfit {misfit:.1f} cm", size=(8, 5))
    return fig


# %% slideshow={"slide_type": "subslide"} answers="14-experiment"
views.explore(
    laid_over,
    lambda angles_read_as, drive, front: (
        f"Two looks laid over each other by the wheels, after {drive}, angles read as {angles_read_as}, front at {front:.0f}°: "
        f"the walls are {looks[drive].misfit(angles_read_as == 'clockwise', front):.1f} cm apart in the median."
    ),
    angles_read_as=["counter-clockwise", "clockwise"],
    drive=["an arc", "straight ahead"],
    front=(-180, 180, 0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-experiment"
# Read counter-clockwise, the second look lies turned across the first one. Choose *clockwise*, and the walls
# coincide. Choose *straight ahead*, and both signs fit. Then move the front, and see that no front can make up
# for the wrong sign.

# %% slideshow={"slide_type": "subslide"} answers="14-experiment"
fronts, arc = np.arange(-180, 181, 5), looks["an arc"]
misfits = {
    "clockwise": [arc.misfit(True, front) for front in fronts],
    "counter-clockwise": [arc.misfit(False, front) for front in fronts],
}
best = {name: min(each) for name, each in misfits.items()}
notch = fronts[np.argmin(misfits["clockwise"])]
assert notch == 0 and best["clockwise"] < 1 < 10 < best["counter-clockwise"]

# %% slideshow={"slide_type": "subslide"} answers="14-experiment"
fig, _ = views.curves(fronts, misfits, "front of the lidar at [°]", "misfit [cm]", size=(8, 3.6))
views.show(
    fig,
    f"Read as clockwise, the misfit falls to {best['clockwise']:.1f} cm at {notch}°; "
    f"read as counter-clockwise it never falls below {best['counter-clockwise']:.0f} cm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-experiment"
# One sign and one front fit, to {= best["clockwise"]:.1f =} cm; with the wrong sign the best is {=
# best["counter-clockwise"]:.0f =} cm. Nobody had to know the room. As an `assert`, this is a test for any robot
# that can drive an arc.
#
# **One trap is left.** If the wheels counted the wrong way round as well, the mirrored scan would
# fit, and the whole map would be a mirror image. So check one sign by eye: turn the robot to the
# left by hand, and see whether its count of the angle grows.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class vote before the picture, and let each side defend its answer. A volunteer can
# play the robot in front of the class, and say what the room does while moving.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## A command, and its checksum
#
# eMIR, the robot, speaks text: a `#`, then four bytes as two hexadecimal digits each, then a `/`. The four are an
# opcode, two arguments, and a checksum. A negative argument goes as its *two's complement*, which is the number
# plus 256. Here are three frames that work:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for what, text in (("send", "#100100EF/"), ("halt", "#010000FF/"), ("reset", "#150000EB/")):
    print(f"{what:>5}  {text}  bytes", list(bytes.fromhex(text[1:-1])))

# %% [markdown] slideshow={"slide_type": "fragment"}
# In each of them the four bytes add up to 256. Is the checksum therefore 256 less the other three?

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-checksum",
    "To drive is opcode 01. Slowly back, with a little turn to the right, speed −1 and turn −1, are the bytes `01 FF FF`. **Which checksum "
    "belongs to them?**",
    {
        "FF": "1 + 255 + 255 + 255 = 766, and that is not a multiple of 256.",
        "01": "1 + 255 + 255 + 1 = 512 = 2 · 256.",
        "none: 256 − 511 is negative": "256 less the rest is negative here, and cannot be sent. But a sum in one byte wraps around: "
        "any multiple of 256 counts as 0.",
        "00": "the three bytes add up to 511, one short of 512.",
    },
    right="01",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-checksum"
# A robot that adds bytes in a byte knows their sum only up to multiples of 256. So the rule that all frames share
# is
#
# $$(\text{opcode} + \text{speed} + \text{turn} + \text{checksum}) \bmod 256 = 0. \tag{14.6}$$
#
# With two positive arguments the rule "256 less the rest" gives the same byte, and so the mistake
# survives: tests that only drive ahead and to the left never find it. There are no more than 201 ·
# 201 commands to drive. So we test all of them with the robot's own framer:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="14-checksum"
print("speed −1, turn −1:", commands.move(-1, -1).decode())
every = [(v, omega) for v in range(-100, 101) for omega in range(-100, 101)]
robot_ear = Framer(COMMAND)
understood = robot_ear.feed(b"".join(commands.move(v, omega) for v, omega in every))
print(f"{views.grouped(len(understood))} of {views.grouped(len(every))} commands are understood")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-checksum"
# A robot drops a frame whose checksum is wrong, and says nothing. It goes on with the *previous*
# command. (The section *In print* counts the commands that a printed driver loses in this way.
# *This is a good place for a break.*)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Part two: a counter that overflows
#
# eMIR answers with a status. Ours sends one ten times a second: a `*`, 17 bytes as hexadecimal
# digits, and a `/`. Byte 14 counts the path, about a centimetre a count, and byte 15 counts the
# turn, about 2° a count. Both are **signed bytes**. We drive along a corridor at half speed, and
# look once a second:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
half_speed, _ = trials.statuses_of([(16, 50, 0)], worlds.corridor())
path = [status.path for status in half_speed]
print("path:", *path[::10])

# %% slideshow={"slide_type": "subslide"}
ask(
    "14-ring",
    "The robot drives. One status says 120, and the next one says −116. **How many counts has it gone between the two?**",
    right=20,
    tolerance=0.5,
    unit="counts",
    reason="seven to 127, one more to −128, and twelve from there to −116.",
    wrong={
        -236: "that is the plain difference. In a tenth of a second the robot would have gone back more than two metres.",
        236: "the size of the plain difference is as impossible as the difference itself.",
        19: "a byte has 256 values, not 255: from 127 to −128 is one count, too.",
        -20: "the size is right. From 120 the robot went on over 127.",
    },
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-ring"
# ### The shorter way round
#
# The counter lives on a ring of 256 values. From two readings $n_k$ and $n_{k+1}$ nobody can know how many *whole
# rounds* lie between them. So the step $\Delta_k$ is known up to multiples of 256. Exactly one of the possible
# steps lies in a byte's own range, and it is the shorter way round the ring:
#
# $$\Delta_k \equiv n_{k+1} - n_k \pmod{256}, \qquad -128 \le \Delta_k \le 127. \tag{14.7}$$
#
# The way since the start is the sum of the steps. It needs more room than a byte.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="14-ring"
def way(values):
    """Counts since the first reading, by the package's unwrapper."""
    counter = CounterUnwrapper()
    return np.cumsum([counter.advance(value) for value in values])


print("way:", *way(path)[::10])
print("from 120 to −116:", way([120, -116])[-1])

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-ring"
# The overflow is gone. The same rule works backwards, because "shorter" has no preferred direction.
# It requires one thing only: that the robot goes less than half a ring between two readings.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Draw the ring of 256 values on the board, with 127 and −128 side by side. Collect rules for
# the step, and try each of them on a robot that drives back.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## How seldom may one look?
#
# Half a ring is 128 counts. So the pause between two looks is limited:
#
# $$\text{pause} < \frac{128 \cdot \text{size of a count}}{\text{speed}}. \tag{14.8}$$
#
# Our emulated robot counts 1.03 cm of path and 2.14° of turn. At full speed it drives 40 cm/s, or turns by 100° a
# second.

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-pause",
    "The robot drives at full speed. **How many seconds may pass between two looks at the path, at most?**",
    right=3.3,
    tolerance=0.06,
    unit="s",
    reason="128 counts of 1.03 cm are 132 cm, and 132 cm at 40 cm/s take 3.3 s.",
    wrong={
        6.6: "that is a whole ring. Beyond half a ring the *other* way round is the shorter one.",
        3.2: "that would be so with counts of exactly 1 cm.",
        0.31: "speed over way: turn the fraction round.",
    },
)

# %% slideshow={"slide_type": "subslide"} answers="14-pause" tags=["folded"]
full_speed, _ = trials.statuses_of([(16, 100, 0)], worlds.corridor())
PATHS = {"100 %": [status.path for status in full_speed], "50 %": path}


def seldom(pause, speed):
    tenths = max(round(10 * pause), 1)
    sent = PATHS[speed][::tenths]
    seen = {"unwrapped": way(sent), "as sent": sent, "truth": way(PATHS[speed])[::tenths]}
    time = 0.1 * tenths * np.arange(len(sent))
    fig, ax = views.curves(time, seen, "time [s]", "path [counts]", size=(8, 4))
    ax.lines[2].set_color(views.COLOURS["truth"])
    views.legend(ax, loc="upper left")
    return fig


# %% slideshow={"slide_type": "subslide"} answers="14-pause"
views.explore(
    seldom,
    lambda pause, speed: (
        f"The path over time at {speed} of the speed, looked at every {pause:.1f} s: what is sent stays within a byte, "
        f"and unwrapped it ends at {way(PATHS[speed][:: max(round(10 * pause), 1)])[-1]} counts."
    ),
    pause=(0.1, 5.0, 3.5),
    speed=["100 %", "50 %"],
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-pause"
# With a look every 3.5 s a robot that drives ahead seems to drive back, and no reading looks suspicious. Find the
# longest pause that works, first at full and then at half speed. For the turn, too, a machine can find it:

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="14-pause"
spinning, _ = trials.statuses_of([(16, 0, 100)], worlds.room())
readings = {"path": PATHS["100 %"], "turn": [status.angle for status in spinning]}
limits = dict(zip(readings, 128 * np.array(COUNT_SIZE) / TOP_SPEEDS, strict=True))
for name, values in readings.items():
    fine = [k for k in range(10, 50) if way(values[::k])[-1] == way(values)[::k][-1]]
    assert fine[-1] / 10 < limits[name] < fine[-1] / 10 + 0.1
    print(f"{name}: right up to a look every {fine[-1] / 10} s; by (14.8) {limits[name]:.2f} s")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-pause"
# So the path allows {= limits["path"]:.1f =} s, and the turn {= limits["turn"]:.1f =} s: the
# counter that needs to be read more often sets the pace. With eMIR's ten statuses a second, some of
# them may be lost without harm.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## What is a count?
#
# How long is a count? Tuček's thesis takes 1 cm and 2°. Another program for robots of the same kind
# takes 1.03 cm and 2.14°. Neither says where its numbers come from. Our emulated robot is built to
# the second pair, so with the first pair we are off by 3 % in the path and by 7 % in the turn.

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-harm",
    "The robot drives 11 m round a table, four sides and four corners, back to its start. **Which wrong scale does more harm to its last position?**",
    {
        "the path: 3 % of 11 m are 33 cm": "they would be, on a straight line. On a round the error ahead and the error back cancel: the whole "
        "round just comes out a little too small.",
        "the turn": "each corner comes out 6° short, and an error of the heading is multiplied by all the way that follows.",
        "both the same": "a wrong path changes the size of the round, a wrong turn changes its shape.",
    },
    right="the turn",
)

# %% slideshow={"slide_type": "subslide"} answers="14-harm" tags=["folded"]
trip, room = trials.round_trip(seed=5), worlds.room()


def by_the_counters(path_cm, turn_degrees):
    track = trip.track(path_cm, turn_degrees)
    off = trip.error(path_cm, turn_degrees)
    fig, ax = views.axes(f"at the end {off:.0f} cm off", size=(8, 5.4))
    views.draw(ax, Segments("walls", room.outline()))
    views.draw(ax, Poses("truth", trip.true))
    views.draw(ax, Poses("naive", track), label="by the counters")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"} answers="14-harm"
views.explore(
    by_the_counters,
    lambda path_cm, turn_degrees: (
        f"A room with a table and the true track round it; by counts of {path_cm:.2f} cm and {turn_degrees:.2f}° the track "
        f"ends {trip.error(path_cm, turn_degrees):.0f} cm off."
    ),
    path_cm=(0.95, 1.10, 1.0),
    turn_degrees=(1.9, 2.3, 2.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-harm"
# With the thesis' numbers each corner is 6° short, and the round does not close. Move `path_cm`: the track grows,
# and its end hardly comes nearer. Move `turn_degrees` to 2.14, and the round closes. Is that so for other drives,
# too? The wheels slip at random, so we take ten:

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="14-harm"
PAIRS = {"thesis": (1, 2), "path mended": (1.03, 2), "turn mended": (1, 2.14), "both": (1.03, 2.14)}
trips = [trials.round_trip(seed) for seed in range(10)]
off = {name: np.array([each.error(*pair) for each in trips]) for name, pair in PAIRS.items()}
nearer = {name: np.sum(each < off["thesis"]) for name, each in off.items()}
for name, each in off.items():
    print(f"{name:>12}: {np.median(each):4.0f} cm off in the median")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-harm"
# The mended turn brings the robot nearer in {= nearer["turn mended"] =} of the ten drives, the
# mended path in {= nearer["path mended"] =}. The {= np.median(off["both"]):.0f =} cm that are left
# when both are right come from slip, and no scale factor mends slip. (A path of the wrong scale is
# not harmless: it draws the whole map in the wrong size. A round trip cannot show that.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which drive would show the wrong path best, and which the wrong turn. That is how one
# calibrates; "Calibrate it" does both.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Your robot
#
# From here on we use drivers. A driver has a thread that listens to a device all the time, so that
# nothing piles up while your program computes. The two names in the next cell decide which robot
# the rest of the lesson runs on.
#
# As they stand, each cell starts its own emulators and talks to them through the package's drivers.
# Their time is *simulated*: it passes only while somebody waits for a reading. So nothing gets lost
# on a busy machine.

# %% slideshow={"slide_type": "fragment"}
LIDAR_PORT = None  # such as "/dev/ttyUSB0" or "COM3"
EMIR_PORT = None  # such as "/dev/rfcomm0" or "COM12"


# %% slideshow={"slide_type": "fragment"}
def robot(rng, calibration=None):
    """Lidar and eMIR as a source of readings: yours, or emulated ones in a room."""
    if EMIR_PORT is None:
        return EmulatedDevices(worlds.room(), rng, calibration, SimulatedClock())
    return devices(f"{LIDAR_PORT or ''},{EMIR_PORT}", calibration)


# %% [markdown] slideshow={"slide_type": "fragment"}
# If a port cannot be opened, a sentence says so, with its likely cause and the next step. (If the notch of your
# own lidar is not at 0°, hand its place as `front=` to `devices`.)

# %% slideshow={"slide_type": "subslide"}
try:
    devices("socket://localhost:1,socket://localhost:2")
except sources.SourceError as trouble:
    print(trouble)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### And when the program ends?
#
# A robot obeys its last command until the next one comes. So what does it do when your program has ended, perhaps
# by an exception?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
body = RobotBody(worlds.corridor(), np.random.default_rng(1))
emir = EmirEmulator(body)
emir.feed(commands.move(50, 0), 0.0)
emir.feed(b"", 1.0)  # here the program ends
ended_at = body.pose[0]
emir.feed(b"", 6.0)
print(f"five seconds later the robot is {body.pose[0] - ended_at:.1f} m further")

# %% [markdown] slideshow={"slide_type": "fragment"}
# It drives on, until it meets a wall. The package's drivers therefore stop robot and motor when
# they are closed, also when the program ends by an error. And a watchdog stops a motion if the
# program has not asked for it again within two seconds. Only a program that is killed can no longer
# do this.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Calibrate it
#
# 1. Mark where the robot stands, and run the next cell. It drives what it takes for one metre, and then makes
#    four quarter turns, all by *its* count.
# 2. Measure the way with a tape. With a protractor, measure by how much the four quarters make more
#   than a full turn (or, with a minus, less).
# 3. Write both into the cell after it, and run that cell. (With `None`, the emulator gives the true
#   values.)

# %% slideshow={"slide_type": "fragment"}
with robot(np.random.default_rng(7)) as source:
    bench, marks = getattr(source, "bench", None), []
    counts = calibration_drive(source.emir, lambda: marks.append(bench and bench.body.pose))

# %% slideshow={"slide_type": "subslide"} tags=["code"]
TAPE, PROTRACTOR = None, None  # [m], [degrees] beyond a full turn

if bench is not None:
    steps = between(np.array(marks[:-1]), np.array(marks[1:]))
    measured = np.hypot(*steps[0, :2]), np.degrees(steps[1:, 2].sum())
else:
    assert TAPE and PROTRACTOR is not None, (
        "measure, write both numbers above, and run this cell again"
    )
    measured = TAPE, 360 + PROTRACTOR
metres, degrees = measured / counts
calibrated = Calibration(path=metres, angle=np.radians(degrees))
print(
    f"{measured[0]:.2f} m, {measured[1]:.0f}°: a count is {100 * metres:.2f} cm and {degrees:.2f}°"
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The simulated robot was built with 1.03 cm and 2.14°. One count more or less is 1 % of a metre, so a longer
# drive gives a better number. If the turn comes out negative, your robot counts clockwise: keep the sign.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Record it, play it again
#
# A robot's day cannot be repeated, but its bytes can. A recording keeps every piece that was read or written,
# with its time and a checksum, and nothing that was derived from it. We record a simulated drive round the table:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
folder = tempfile.TemporaryDirectory()
drive = Path(folder.name) / "table.rec"
COURSE = [(0.5, 0, 0), *trials.ROUND, (0.5, 0, 0)]
true = record_synthetic_drive(drive, room, np.random.default_rng(6), COURSE)
raw = drive.read_bytes()
recording = parse(raw, "table.rec")
received = [record.kind for record in recording.records].count(RX)
whole = list(turns(recording))
print(f"{recording.seconds:.0f} s, {received} pieces received, {len(whole)} turns of the lidar")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What a recording must survive
#
# A battery can die in the middle of a message, so the file may be cut off anywhere. The *pieces* in
# which bytes arrive differ from machine to machine, so they must not matter either.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
left = list(turns(parse(raw[: len(raw) * 3 // 5 + 1], "table.rec")))
same = all(np.array_equal(a.range_mm, b.range_mm) for a, b in zip(left, whole, strict=False))
print(f"cut at 60 %: {len(left)} of {len(whole)} turns are left, the same to the last bit: {same}")
at_once, rng, differ = ExpressDecoder().feed(stream), np.random.default_rng(6), 0
for _ in range(20):
    cuts = np.sort(rng.integers(0, len(stream), 100))
    decoder, pieces = ExpressDecoder(), np.split(np.frombuffer(stream, np.uint8), cuts)
    differ += not np.array_equal(np.concatenate([decoder.feed(bytes(p)) for p in pieces]), at_once)
print(f"of 20 ways to cut the bytes into pieces, {differ} gave other points")

# %% [markdown] slideshow={"slide_type": "subslide"}
# In a shell:
#
# ```
# slamlab emulate --world room                   # two ports, until Ctrl-C
# slamlab record devices:LIDAR,EMIR --out my.rec # every byte; type V,OMEGA to drive
# slamlab replay my.rec                          # the devices again, behind two ports
# slamlab run my.rec                             # or straight into a SLAM
# ```
#
# So a class of forty needs one robot and one drive. For every estimator of this course, `sources.open("my.rec")`
# is a source like any other.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Record your own drive with the class in the room; next year it is played again. With the two
# ports of `slamlab replay` in LIDAR_PORT and EMIR_PORT, the cells below run on that drive through the real
# drivers. The robot of a replay goes its recorded way, whatever it is told.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=12
# ## Live
#
# Now all of it together, as in Tuček's program: two maps grow side by side. One believes **odometry
# alone**; the thesis calls it naive. The other, the **estimate**, lays each scan over the earlier
# ones by the scan matching of lesson 13. Both take a count as 1 cm and as 2°, as the thesis does.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Who waits, and what may be dropped

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
Box, step, kept = views.Box, partial(views.Box, "step"), partial(views.Box, "kept")
boxes = {
    "lidar": Box("device", "lidar", 0.65, 3.0, 1.1),
    "eMIR": Box("device", "eMIR", 0.65, 1.75, 1.1),
    "lidar's": step("RPLidar\n(a thread)", 2.65, 3.0, 1.4),
    "eMIR's": step("Emir\n(a thread)", 2.65, 1.2, 1.4, 1.8),
    "turns": kept("the two\nnewest turns", 4.6, 3.0, 1.5, 0.75),
    "way": kept("the way by\nthe wheels", 4.6, 1.75, 1.5),
    "source": step("devices", 6.45, 2.375, 1.1, 1.95),
    "icp": step("icp", 8.4, 2.375, 0.9, 0.9),
    "view": step("views.live", 10.3, 1.5, 1.3, 2.5),
    "drive": step("drive", 6.45, 0.65, 1.1),
    "map": kept("pose, map,\nlast scan", 8.4, 4.05, 1.4, 0.8),
    "older": Box("lost", "older turns", 4.6, 4.2, 1.5, 0.6),
}

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
flows = [
    *(("lidar", "lidar's", "bytes"), ("=eMIR", "eMIR's", "bytes"), ("lidar's", "turns", "")),
    *(
        ("eMIR's", "way", ""),
        ("turns", "older", ""),
        ("turns", "source", ""),
        ("way", "source", ""),
    ),
    *(("source", "icp", "reading"), ("=icp", "map", ""), ("icp", "view", "maps")),
    *(("view", "drive", "your commands"), ("drive", "eMIR's", "speed, turn rate")),
]
views.show(
    views.process(boxes, flows, (11, 4.7)),
    "Bytes of lidar and eMIR go to a thread each. One keeps the two newest turns and drops older ones, "
    "the other the way by the wheels. A source makes readings of both, icp maps, views.live shows the "
    "maps and sends commands back to the eMIR's thread.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Devices do not wait, so each has a thread that listens. The matcher takes its time, and asks for the
# next reading when it is ready. Turns that nobody fetched meanwhile are dropped, and counted; the way
# is not. The source asks where the robot was at the end of each turn that it hands on, so after a
# pause the odometry of one reading is longer, and still complete. In Tuček's program these parts are
# the classes *Lidar*, *App*, *Slam* and *ICP*.

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-live",
    "The heading by odometry alone slowly goes wrong. **Where do the walls of its map smear first?**",
    {
        "near the robot, where most points fall": "points near the robot are many, but a wrong heading moves them little.",
        "far from the robot": "a wrong heading turns the scan about the robot: a point is displaced by the angle times its distance.",
        "everywhere alike": "that is what a wrong position would do. A wrong heading turns, and does not shift.",
    },
    right="far from the robot",
)

# %% slideshow={"slide_type": "subslide"} answers="14-live"
played = {
    "A recording": lambda rng: sources.open(drive),
    "A robot": robot,
    "A robot, calibrated": partial(robot, calibration=calibrated),
}

# %% slideshow={"slide_type": "slide"} answers="14-live" tags=["folded"]
seen_live = views.live(
    played,
    views.apart(partial(estimators.make, "icp"), naive=(-8.5, 0)),
    "Left the map by odometry alone, its walls fanned out; right the estimate, one sharp room.",
    steps=350,
    note=trials.errors_now,
    truth=False,
    title="eMIR: odometry alone on the left, the estimate on the right",
    speed=10,
    tops=(0.3, 0.6),
    size=(860, 400),
)
naive_off, corrected_off = trials.errors(seen_live.pair.estimator, true.poses[-1])

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-live"
# After one round of the table the map by odometry alone shows each wall several times, fanned out like cards, and
# most of all the far ones. In the estimated map every wall is one line. Both maps come from the same bytes. At the
# end of this simulated drive odometry alone was {= naive_off:.0f =} cm off, and the estimate {= corrected_off:.0f
# =} cm.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-live"
# ### Drive it yourself
#
# - **A recording** needs no robot: press *reset* and *run*.
# - **A robot**: press this button, then *run*. Drive with the buttons, or click the picture and use
#   the arrow keys (space stops). Or type as in the thesis: `distance, angle`, `reset`, `exit`.
#   Typing `0.5, 30` makes the robot turn by 30° and then drive half a metre, both by the estimated
#   pose.
# - **A robot, calibrated** is the same with your own scale factors. Odometry alone gets better, too, but the
#   wheels still slip.
#
# `naive=None` instead of `naive=(-8.5, 0)` in the cell above draws the estimate alone. In the page of
# `slamlab live` a tick box does the same.
#
# *pause*, *exit*, running the cell again, or ending the kernel stops the robot.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Pull the plug while it runs: on a real robot the USB cable, on the emulated one by
# `seen_live.pair.source.bench["lidar"].faults.unplugged = True` in a new cell. Soon a sentence stands below the
# picture; *reset* begins again. A class without robots opens your drive: `lambda rng: sources.open("my.rec")`
# behind the first button.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# Tuček, master's thesis, Zagreb, 2022: the system that this lesson follows, from the bytes to the live map, with
# its listing.
#
# Slamtec, *RPLIDAR Interface Protocol and Application Notes*: nodes, capsules, requests.
#
# J. Borenstein and L. Feng, "Measurement and correction of systematic odometry errors in mobile robots", *IEEE
# Transactions on Robotics and Automation* 12(6), 1996: scale factors of wheels, found by driving a square both
# ways round.
#
# T. C. Maxino and P. J. Koopman, "The effectiveness of checksums for embedded control networks", *IEEE
# Transactions on Dependable and Secure Computing* 6(1), 2009: what a sum or an exclusive or misses.
#
# **Read next:** Borenstein and Feng. You can drive their square on any floor.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can read a device's bytes, test for a wrong sign, send commands that arrive, unwrap counters, calibrate,
# record and replay, and drive a robot through a growing map.
#
# **What comes next:** the estimated map is sharp after one round. In a larger building small errors add up, and
# where the robot comes back, walls stand twice. Lesson [15](15_closing_the_loop.ipynb) recognises places and
# closes the loop.
#
# The sections below this one are optional.
#
# **Exercise:** [14 · The eMIR system](../exercises/ex14_the_emir_system.ipynb). You decode this lidar and one
# that you have never seen, write commands, unwrap counters, and find the faults of drivers that others wrote.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the document or the program?
#
# Slamtec's *document* reads a capsule differently from Slamtec's *program*. In the document the top
# bit of an offset is a sign, and $k$ runs from 1 to 32:
#
# $$\psi_k = \psi + \frac{k}{32}\,\bigl((\psi' - \psi) \bmod 360^\circ\bigr) - \delta_k \tag{14.9}$$
#
# for $k$ from 1 to 32. Here $\delta_k$ is what the five lower bits say, with a minus if the top bit
# is set. Offsets are nearly always above 4°, where the top bit is set. So the wrong one of the two
# readings turns nearly every point of the room.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
pairs = list(pairwise(capsules[16:31]))
as_document = np.vstack([printed.as_documented(*two) for two in pairs])
nodes = ExpressDecoder().feed(b"".join(capsules[16:31]))
as_program = np.column_stack([nodes["angle_q6"] / 64, nodes["distance_q2"] / 4])
pictures, turned = {}, np.median((as_document[:, 0] - as_program[:, 0] + 180) % 360 - 180)
for name, rows in {"program": as_program, "document": as_document}.items():
    beta, r = robot_frame(*rows.T)
    points = np.column_stack([r * np.cos(beta), r * np.sin(beta)])
    pictures[f"as the {name} has it"] = [
        Segments("walls", polygon.outline()),
        Points("scan", points),
    ]
fig, _ = views.side_by_side(pictures, size=(9, 4.4))
views.show(
    fig,
    f"Left, the points lie on the walls; right, they are turned by {turned:.0f}° in the median.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# As the document has it, the room is turned clockwise by {= turned:.0f =}°. Our emulator sends what
# the *program* expects, so this picture shows how much the two differ, and not who is right. On a
# real A2 the arc decides: the right reading is the one that puts the notch where the front really
# is.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print: the listing
#
# Optional: what stands in the listing and the pseudo-code of Tuček's thesis, and the small test that finds it.
#
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | `move` | checksum 256 − 1 − speed − turn, of bytes | (14.6) | half of all commands are malformed |
# | odometry | read the counters, then reset them | differences, (14.7) | the way between the two is lost |
# | every write | `flushOutput()` right after it | leave it out | throws away what has not yet left |
# | `main` | neither `start()` nor `robot_control()` is called | call both | nothing happens |
# | `exit` | never sends a stop | stop first | the robot drives on, as in "Your robot" |

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
for pair in ((50, 0), (30, -20), (-10, 10), (-1, -1)):
    print(f"{pair!s:>9}  printed {printed.move(*pair):12}  right {commands.move(*pair).decode()}")
dropped = [pair for pair in every if not Framer(COMMAND).feed(printed.move(*pair).encode())]
print(f"{views.grouped(len(dropped))} of {views.grouped(len(every))} commands are dropped")
both = sum(v < 0 and omega < 0 for v, omega in dropped)
print(f"both negative: {views.grouped(both)}; one negative: {views.grouped(len(dropped) - both)}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Ahead and to the left all commands arrive. With two negative arguments no command arrives, and
# with one of them about half do: those in which the positive argument is smaller than the size of
# the negative one.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
body = RobotBody(worlds.corridor(), np.random.default_rng(1))
emir, framer, total = EmirEmulator(body), Framer(), 0
emir.feed(commands.info(True) + commands.move(50, 0), 0.0)
for now in 0.95 + np.arange(14):
    total += Status.unpack(framer.feed(emir.feed(b"", now))[-1]).path
    emir.feed(commands.reset_counters(), now)
print(f"read, then reset: {total} counts; the wheels made {body.counters()[0]}")
for milliseconds in (0.1, 1, 2):
    sent = printed.bytes_sent(milliseconds / 1000)
    print(f"flushed {milliseconds} ms after the write: {sent:2} of 10 bytes have left")
print("called by main:", printed.main().called)

# %% [markdown] slideshow={"slide_type": "fragment"}
# `flushOutput` sounds like "send it now", but it *discards* what waits to be sent. At 57 600 bits a
# second a byte takes 174 µs, so a flush that follows at once can throw away the whole command. How
# much of it survives depends on the buffers of the system and on timing, so the fault may show on
# one computer and not on another.

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | `transformation_is_zero` | the entries of `T` add to 0 | `T` is the identity | standing still is never noticed |
# | sensors | number `> 0` | `>= 0` | sensor 0 is never returned |
# | sensors | all 17 bytes are signed | six of them | a compass at 300° says −212° |
# | bad frame | returns an empty list | skip it and count | unpacking fails in the caller |
# | `slam_routine` | ends at the first empty scan | skip it and count | the map ends without a word |
# | `App` | the map is made in the class's body | in `__init__` | two programs share one map |
# | lidar | `next(iter_scans())` for each turn | keep one generator | a reading of every turn is lost |

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
print("standing still is zero:", printed.transformation_is_zero(np.eye(3)))
text = Status(proximity=(35, 80, 80, 80, 62, 41), azimuth=150, path=-3, angle=7).pack().decode()
print("sensors 0, 14, 15:", printed.values_for_sensors(text, [0, 14, 15]))
print("compass:", 2 * printed.values_for_sensors(text, [13])[0], "degrees")

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(5)
scans = [[] if rng.random() < 0.02 else [1] for _ in range(1000)]
empty = sum(not points for points in scans)
print(f"scans used: {printed.slam_routine(scans)} of {len(scans)}, of which {empty} are empty")
printed.App().points.append("a scan of robot one")
print("robot two has:", printed.App().points)
readings = iter([(k % 5 == 0, k) for k in range(20)])  # turns of five readings
print("turns:", *printed.turns_asked_for(readings, 3))

# %% [markdown] slideshow={"slide_type": "fragment"}
# "No motion" is the identity, whose entries add up to 3. Sensor 0 is missing. The first empty scan
# ends the map. Of the turns, the readings 5 and 10 are lost: each generator has taken the one that
# begins the next turn, and dies with it. Each of these faults is found by a test of one line that
# states what the code *claims* to do.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print: the pseudo-code
#
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | ARRAY_TO_HOMOGENEOUS | the third coordinate is never set | set it to 1 | no point is ever shifted |
# | DotProduct(points, T) | `T` on the right | on the left of columns | shapes do not fit |
# | SLAM_ROUTINE | `while is_running is not True` | `while is_running` | the loop never begins |
# | START | `is not None` | `is None` | opens a lidar just when scans are handed in |
# | SLAM_ROUTINE | asks the lidar for a method of the app | ask the app | fails at once |
# | 4.2.5 | naive points moved by one *step* | by the whole way | the naive map heaps up at its origin |

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
points, T = np.array([[1.0, 2.0], [3.0, 4.0]]), matrix([5, 0, 0])
print("moved by 5 m:", (T @ printed.to_homogeneous(points))[:2].T.tolist())
print("right:       ", transform([5, 0, 0], points).tolist())
print("DotProduct:   shapes", points.shape, "and", T.shape)
print("SLAM_ROUTINE:", printed.slam_routine_rounds(), "rounds")

# %% [markdown] slideshow={"slide_type": "subslide"}
# The rest of the list has no test of its own here:
#
# | place | printed | right |
# | --- | --- | --- |
# | listing | the second scan is only remembered, its motion lost | lesson [13](13_scan_matching.ipynb) |
# | listing | two poor scans in a row: ICP on fewer than 3 points | count the points first |
# | `get_coordinates` | calls `scan()`: endless loop, two readers of a port | wait, with a time limit |
# | 4.2.5 | "after a gap no overlay is possible" | odometry goes on: match with it |

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | right |
# | --- | --- | --- |
# | recorded script | true steps are called "simulated error", and the wrong ones run | name them |
# | chapter 3 | "loop closure" for two scans in a row | it is scan matching; see lesson [15](15_closing_the_loop.ipynb) |
# | prompt | "distance, angle" are sent as speeds in percent | see "Live" |
