# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 14 · Devices and live SLAM: RPLIDAR and eMIR
#
# **You will be able to** map a flat with a hand-held lidar, decode its bytes, detect a wrong sign in an
# unknown room, and send commands with a valid checksum. You will be able to unwrap counters that
# overflow, calibrate the odometry with a tape, explain the effect of latency on a map, and drive a
# robot while you watch its live map.
#
# **115 minutes**, in two parts: bytes of scans and commands (57), and counters, odometry and live SLAM
# (58). **Before:** lesson [01](01_why_slam.ipynb) for poses, lesson [13](13_scan_matching.ipynb) for
# scan matching.
#
# eMIR is a small wheeled robot in Zagreb. In his thesis, Tuček mounts a lidar on this robot, drives it
# by typed commands, and draws two maps during the run. In this lesson we build the same system,
# beginning with the bytes of the devices.
#
# *Key:* all measurements reach the estimator as bytes. If the program decodes these bytes with a wrong
# shift or sign, or ignores an overflow, even the best filter draws a wrong map.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* You need no device, because the emulators in this lesson send the same bytes as
# the real devices. If you have an RPLIDAR and an eMIR, enter their ports in "Drivers"; then all later
# sections use these devices. With an RPLIDAR alone, start `slamlab live devices: --estimator graph` and
# carry the lidar slowly through the lecture room. You can also show the section "Live SLAM" alone as a
# demonstration. If time is short, leave out "Capsules" and "Recording and
# replay". The questions on the capsule, the experiment, the checksum, and the map are suitable for a
# poll.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import tempfile
from functools import partial
from itertools import islice, pairwise
from pathlib import Path

import numpy as np

from classroom.checks import ask, compare
from course.studies import emir_trials as trials
from slamlab import estimators, live, sources, views
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Calibration, commands
from slamlab.devices.emir.emir_calibration import calibration_run
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.emir.wheel_odometry import CounterUnwrapper
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import COUNT_SIZE, TOP_SPEEDS, EmulatedRobot
from slamlab.devices.emulator.synthetic_recording import record_synthetic_run
from slamlab.devices.recording.decoding import revolutions
from slamlab.devices.recording.recording_file import RX, parse
from slamlab.devices.rplidar.capsules import ExpressDecoder
from slamlab.devices.rplidar.measurement_nodes import ScanDecoder
from slamlab.devices.rplidar.requests import Command, express, request
from slamlab.devices.rplidar.revolutions import robot_frame
from slamlab.geometry import between, matrix, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import worlds
from slamlab.sources.emulated_devices import EmulatedDevices
from slamlab.sources.live_devices import devices

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Laser odometry and motion distortion
#
# We begin without the robot. A person carries an RPLIDAR through a flat. A hand-held lidar has **no
# wheel odometry**. Scan matching alone must estimate the motion; this is called **laser odometry**.
# Each match needs an initial guess. A **constant-velocity model** supplies this guess: it assumes that
# the lidar moves as it did between the last two scans.
#
# A scan takes a tenth of a second, and the lidar moves during this time. Therefore, the lidar measures
# the beams of one scan from different poses. The resulting error of the scan is called **motion
# distortion**.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Turn slowly with a stretched arm while you count the beams: the arm points
# elsewhere at the last beam than at the first. In the two maps, let the class find a blurred wall
# before you name the door. With a lidar, start the command before the lecture.

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-distortion",
    "A lidar makes ten revolutions per second, and you rotate it by 60° per second. **By how many centimetres does a point of a "
    "wall 4 m away move in the lidar's frame between the first and the last beam of a scan?**",
    right=42,
    tolerance=1,
    unit="cm",
    reason="in a tenth of a second the lidar turns by 6°, which is 0.105 rad, and 0.105 · 4 m = 42 cm.",
    wrong={
        419: "the point moves so far in a whole second, but a scan takes a tenth of a second.",
        24: "an angle times a distance is an arc length only if the angle is in radians.",
        6: "this is the angle of the rotation in degrees, not the distance in centimetres.",
    },
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-distortion"
# **Deskewing** (also *motion compensation*) transforms each point into the lidar's frame at the end of
# the scan. Deskewing needs the motion during the scan, and the match estimates this motion. So the
# library deskews a scan by the predicted motion, matches it, and repeats both steps with the motion
# that the match estimated.
#
# We map the first 15 seconds of a simulated walk twice: with the scans as measured, and with deskewed scans. **Before
# you run the cells:** in which parts of the flat will the two maps differ?

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Deskew one point. At the start of a scan the lidar was at pose `begin` and measured a point 4 m
# ahead, at `[4, 0]` in its frame. At the end of the scan it was at pose `end`. Compute the point in the frame of
# `end`, with `transform` and `between` of lesson 01.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
begin, end = np.zeros(3), np.array([0.05, 0.0, np.radians(6)])
deskewed = ...  # [x, y] in metres
compare(deskewed, np.linalg.solve(matrix(end), [4.0, 0.0, 1.0])[:2])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# begin, end = np.zeros(3), np.array([0.05, 0.0, np.radians(6)])
# deskewed = transform(between(end, begin), np.array([4.0, 0.0]))
# ```
#
# The point is 41 cm farther to the right, nearly as much as in the question above.
#
# </details>

# %% slideshow={"slide_type": "fragment"} answers="14-distortion"
# the first 15 s of a walk, with and without the times of the beams
from dataclasses import replace

walk = sources.open("sim:flat-carried")
carried = list(islice(walk, 150))
distorted = [replace(each, scan=replace(each.scan, times=None)) for each in carried]


def mapped(scans):
    slam = estimators.make("icp", walk)
    for reading in scans:
        slam.step(reading)
    return slam


# %% slideshow={"slide_type": "fragment"} answers="14-distortion" tags=["folded"]
flats = {"without deskewing": mapped(distorted), "with deskewing": mapped(carried)}
true_end = walk.truth.poses[len(carried) - 1]
end_errors = between(true_end, np.array([slam.pose for slam in flats.values()]))
skewed_cm, deskewed_cm = 100 * np.hypot(*end_errors[:, :2].T)
assert 20 * deskewed_cm < skewed_cm < 20  # it is near 12 cm: how near depends on rounding
fig, _ = views.side_by_side({name: slam.layers() for name, slam in flats.items()}, size=(9, 4.5))
views.show(
    fig,
    "Two maps of one flat, a corridor with rooms on both sides. In the left map many walls are blurred and the last "
    f"position error is about a decimetre; in the right map the walls are thin and the error is {deskewed_cm:.1f} cm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-distortion"
# The maps differ where the lidar turned: at the door of the corridor and in the room behind this door.
# They differ most at the far walls. At the end of this walk the position error is about a decimetre
# without deskewing, and {= deskewed_cm:.1f =} cm with deskewing. (The row of arcs in the corridor shows
# a walking person.)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-distortion"
# If you have an RPLIDAR, the first of these commands maps your flat while you walk. The second command
# needs no lidar, and shows the rest of the simulated walk:
#
# ```
# slamlab live devices: --estimator graph
# slamlab live sim:flat-carried --estimator graph
# ```
#
# The guide [Your flat in ten minutes](../docs/your_flat.md) describes how to walk. But how does a
# program receive a scan from the lidar?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The serial protocol of a lidar
#
# The RPLIDAR A2 is a motor with a laser, connected to a serial port. The part of a program that communicates with a
# device is called its **driver**. The rules for the order and the meaning of all messages are called
# the **protocol**. The driver sends a request of two bytes, `a5 20`, which means *scan*. The lidar
# answers with seven bytes that describe the data that follow. Then the lidar sends points until the
# driver stops it.
#
# In the next cell, a small program *emulates* the lidar: it receives bytes and the time, and returns
# bytes. The emulator needs no port, and runs faster than real time. Its simulated room is Tuček's
# cardboard polygon from lesson 13.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students expect a library call that returns points. Show the raw bytes of the
# output first, and ask where a point begins; nobody can know without the protocol.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# request a scan from the emulated lidar, and print the answer
polygon = worlds.polygon()
lidar = trials.carried_lidar(EmulatedRobot(polygon, np.random.default_rng(0)))
scan = trials.received(lidar, request(Command.SCAN), begin=0.0, seconds=1.0)
print("request:", request(Command.SCAN).hex(" "))
print("answer: ", scan[:7].hex(" "))
for at in range(7, 22, 5):
    print("        ", scan[at : at + 5].hex(" "))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The answer begins with `a5 5a`, as all answers do. The other bytes announce packets of `05` bytes and
# of type `81`, which the lidar sends until it is stopped (`40`). A packet of five bytes describes one
# point, and is called a **measurement node**.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Decoding a measurement node
#
# What do the five bytes mean? The manufacturer's description of the protocol defines their meaning:
#
# | byte | bits | meaning |
# | --- | --- | --- |
# | 0 | 0 | S: a revolution of the lidar begins here |
# | | 1 | the complement of S |
# | | 2–7 | quality, 0 to 63 |
# | 1, 2 | 0 | C, always 1 |
# | | 1–15 | angle, in units of 1/64 degree |
# | 3, 4 | 0–15 | distance, in units of 1/4 mm; 0 if nothing came back |

# %% [markdown] slideshow={"slide_type": "subslide"}
# A number that does not fit into one byte needs two bytes. The RPLIDAR sends the **low byte first**
# (this is called *little endian*), so
#
# $$\text{word} = \text{low} + 256 \cdot \text{high}. \tag{14.1}$$
#
# Bit 0 of the first word is C and does not belong to the angle. To remove this bit, we halve the word
# and round down. Let $\psi$ be the angle that the lidar sends, and $r$ the distance. Then
#
# $$\psi = \frac{1}{64} \left\lfloor \frac{\text{word}_{1,2}}{2} \right\rfloor \text{degrees}, \qquad
# r = \frac{\text{word}_{3,4}}{4} \text{ mm}. \tag{14.2}$$

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-node",
    "The first node in the output above is `be 75 93 3d 11`. Use pencil and paper. **What is the angle of this node?**",
    right=294.9,
    tolerance=0.2,
    unit="degrees",
    reason="with the hexadecimal bytes 75 and 93, the word is 117 + 256 · 147 = 37 749. Half of this number is 18 874, and 18 874 / 64 = 294.9.",
    wrong={
        589.8: "bit 0 is C and is not part of the angle, so halve the word first.",
        235.1: "you used the first byte as the high byte, but the low byte comes first: 75 is the low byte, and 93 is the high byte.",
        18874: "this is the angle in units of 1/64 degree, not in degrees.",
    },
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="14-node"
low, high = scan[8], scan[9]
word = low + 256 * high
half = word // 2
print(f"word {views.grouped(word)}, half of it {views.grouped(half)}, angle {half / 64:.2f}°")
nodes = ScanDecoder().feed(scan[7:])
print(f"the library's decoder: {nodes['angle_q6'][0] / 64:.2f}°, {len(nodes)} nodes per second")

# %% slideshow={"slide_type": "fragment"} answers="14-node" tags=["folded"]
FIELDS = {
    "check bits": [(0, 0), (0, 1), (1, 0)],
    "quality": [(0, bit) for bit in range(2, 8)],
    "angle": [(1, bit) for bit in range(1, 8)] + [(2, bit) for bit in range(8)],
    "distance": [(byte, bit) for byte in (3, 4) for bit in range(8)],
}


def decoded(node):
    found = ScanDecoder().feed(bytes(node))
    values = [f"{one['angle_q6'] / 64:.1f}°, {one['distance_q2'] / 4:.0f} mm" for one in found]
    return values[0] if values else "no node"


def one_bit_flipped(byte, bit):
    node = bytearray(scan[7:12])
    before = decoded(node)
    node[byte] ^= 1 << bit
    title = f"sent: {before}    decoded: {decoded(node)}"
    return views.bits(node, FIELDS, (byte, bit), title)[0]


# %% slideshow={"slide_type": "subslide"} answers="14-node"
views.explore(
    one_bit_flipped,
    lambda byte, bit: (
        f"Five rows of eight bits, coloured by field; bit {bit} of byte {byte} has a frame and is flipped, so the decoder "
        "returns another angle, another distance or no node."
    ),
    byte=(0, 4, 2),
    bit=(0, 7, 7),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-node"
# One bit was flipped during transmission, and the decoded point lies on the other side of the robot. A
# flip of the lowest bit of the angle would hardly change the point. The decoder detects a flipped check
# bit, and an angle beyond 360°. It does not detect any other flipped bit of the angle or the distance,
# and a flipped high bit adds a wrong point to the map.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Give the class three minutes to decode the first node. Then let a student choose
# the bit whose flip causes the largest error, and the bit whose flip causes the smallest error.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Framing and resynchronisation
#
# A serial line transmits bytes without any mark at the beginning of a packet. Finding the packets in a
# stream of bytes is called **framing**. A lost byte is therefore worse than a flipped bit: every later
# group of five bytes begins one byte too late in its node, and is decoded wrongly. The three check bits
# help to detect such groups: S must differ from its complement, and C must be 1. How often do random
# bytes pass this test?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Cover the first column of a printed stream and let the class guess where the
# nodes begin. Students propose an exception for a damaged packet: ask what then happens to a map
# after an hour.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
random = np.random.default_rng(5).integers(0, 256, (100_000, 5))
S, complement, C = random[:, 0] & 1, random[:, 0] >> 1 & 1, random[:, 1] & 1
passes = (complement != S) & (C == 1)
print(f"{100 * passes.mean():.0f} % of all random groups pass")
angle = random[:, 1] + 256 * random[:, 2] >> 1  # [1/64 degree]
accepted = np.mean(passes & (angle < 360 * 64))

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The library's decoder also rejects a node whose angle is 360° or more. The angle has 15
# bits and a unit of 1/64°. What share of random nodes passes both tests? (Two digits are enough.)

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
share = ...  # between 0 and 1
compare(share, accepted, tolerance=0.03)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# share = 1 / 4 * (360 * 64) / 2**15
# ```
#
# This share is 0.18. The experiment with 100 000 random nodes gave nearly the same share.
#
# </details>

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
# the transmission loses one byte in a thousand
lost = np.random.default_rng(3).random(len(scan)) < 0.001
torn = bytes(np.frombuffer(scan, np.uint8)[~lost])[7:]
decoder = ScanDecoder()
good = decoder.feed(torn)
print(f"{lost.sum()} bytes lost, {decoder.damage['resyncs']} resynchronisations")
print(f"{len(good)} of {len(nodes)} nodes are left, and no exception was raised")

# %% [markdown] slideshow={"slide_type": "fragment"}
# One group that passes the tests may be random. A decoder that has lost the beginning of the packets
# must find it again, which is called *resynchronisation*. The library's decoder waits for four
# consecutive nodes whose angles increase. So {= lost.sum() =} lost bytes cause the loss of only
# {= len(nodes) - len(good) =} of {= len(nodes) =} nodes. Transmission errors are common: a decoder
# should count the errors and continue. An exception would end the mapping because of a single byte.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Capsules: sample rate and baud rate
#
# The lidar can measure one point every 254 µs, that is 3937 points per second. This number is its
# **sample rate**. (The *scan rate*, about ten revolutions per second, is a different quantity.) Can the
# line transmit all these points? Its **baud rate** is 115 200 bits per second. A byte takes ten bits,
# since a start bit precedes its eight bits and a stop bit follows them (*8N1*). So the line transmits
# at most 11 520 bytes, or 2304 nodes, per second. This is less than the sample rate.
#
# Therefore, the protocol has a second format, the *capsule*, with 32 points in 84 bytes.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* If you show this section, let the class compute the line's limit in points per
# second. The price of the dense format, that a capsule waits for the next one, is the point to keep;
# latency returns in part two.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, size, count in (("nodes", 5, 1), ("capsules", 84, 32)):
    most = 115200 / 10 / size * count
    print(f"{name:>8}: {size / count:.2f} bytes per point, at most {most:.0f} points per second")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The capsule needs fewer bytes for the angles: it contains 32 distances, but only *one* angle $\psi$,
# at which the capsule begins. For each point it contains only a small offset $\delta_k$, up to 8°, by
# which the direction of the point lags behind that of the motor.

# %% slideshow={"slide_type": "subslide"}
ask(
    "14-capsule",
    "A capsule contains the angle at which it begins, and no other information about the motor. **How does the "
    "decoder find the angles of the other 31 points?**",
    {
        "from the motor's speed, ten revolutions per second": "ten is only the nominal speed of the motor. The true speed "
        "differs, and the error would grow from point to point.",
        "from the angle of the next capsule": "the sample rate is constant, so the points are evenly spaced between "
        "two of these angles.",
        "all 32 points have the same angle": "at ten revolutions and 3937 points per second, 32 points cover about 29 degrees.",
    },
    right="from the angle of the next capsule",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-capsule"
# The angle of the next capsule shows how far the lidar has turned in the meantime. The sample rate is
# constant, so the points are evenly spaced between the two angles, $\psi$ and $\psi'$. Point $k$ is at
# the angle
#
# $$\psi_k = \psi + \frac{k}{32}\,\bigl((\psi' - \psi) \bmod 360^\circ\bigr) - \delta_k \tag{14.3}$$
#
# for $k$ from 0 to 31. The remainder keeps the difference positive where the lidar passes 360°.
#
# The disadvantage of capsules is latency. The **latency** of a value is the time from its measurement
# until the program receives it. A capsule can be decoded only after the next capsule has arrived, and
# 32 points take {= 32 * 0.254:.0f =} ms. (Slamtec's document and Slamtec's program differ in (14.3). A
# *Deeper* section at the end shows the difference.)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="14-capsule"
lidar = trials.carried_lidar(EmulatedRobot(polygon, np.random.default_rng(0)))
stream = trials.received(lidar, express(1), begin=0.0, seconds=1.0)[7:]
capsules = [stream[at : at + 84] for at in range(0, len(stream) - 83, 84)]
for count in (1, 2, 3):
    found = ExpressDecoder().feed(b"".join(capsules[:count]))
    print(f"{count} capsules received: {len(found)} points known")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## From angles to points of the robot frame
#
# From an angle and a distance we compute a point. Seen from above, the angles of the RPLIDAR increase
# **clockwise** from its front, but the angles of our poses increase counter-clockwise. Let the lidar be
# mounted over the origin of the robot frame, facing forwards. Then the coordinates of the point are
#
# $$x = r \cos\psi, \qquad y = -r \sin\psi. \tag{14.4}$$

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Do not show the sign in advance. Let the class vote which of the two maps is the
# real room: it cannot be decided, and this is the reason for the next section.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** A node contains the angle 90° and the distance 2000 mm. Compute the coordinates of its
# point in the robot frame.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
point = ...  # [x, y] in metres
compare(point, transform([0, 0, robot_frame(90, 0)[0]], np.array([2.0, 0.0])))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# point = [2 * np.cos(np.pi / 2), -2 * np.sin(np.pi / 2)]
# ```
#
# The point is at (0, −2), to the right of the robot, because the angles of the lidar increase
# clockwise.
#
# </details>

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
SECONDS = {"an arc of 40°": 2.1, "an arc of 90°": 4.1}  # of driving and turning at a quarter speed
scan_pairs = {name: trials.two_scans(25, 25, seconds) for name, seconds in SECONDS.items()}
scan_pairs["straight ahead"] = trials.two_scans(25, 0)
pictures = {}
for clockwise in (True, False):
    first, _ = scan_pairs["an arc of 40°"].overlaid(clockwise)
    pictures[f"decoded as {'clockwise' if clockwise else 'counter-clockwise'}"] = [
        Points("scan", first)
    ]
fig, _ = views.side_by_side(pictures, size=(9, 4.2))
views.show(fig, "Two maps of one scan; the right map is the mirror image of the left map.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In the right figure, the minus sign is missing. Both maps have sharp walls, and rooms of both shapes
# are possible. If we do not know the room, *one* scan cannot show which map is correct. A
# second scan can: with the wrong sign it does not fit the first after most turns, as the next section shows.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## Extrinsic calibration: an experiment that detects a wrong sign
#
# A program must know the position of a sensor on the robot and the direction of the sensor's front.
# Determining both is called *extrinsic calibration*. Our lidar is mounted over the origin of the robot
# frame. We determine the direction of its front, and at the same time the sign of its angles.
#
# You do not know the room. But you can move the robot, and its odometry measures the motion. So record
# a scan, move the robot, record a second scan, and transform the second scan into the frame of the
# first by the odometry. If the sign is right, the walls coincide.

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-experiment",
    "The front of the lidar has the same direction as the front of the robot. **Which motion can show that the sign is wrong?**",
    {
        "none: one scan is enough": "a mirrored room is also a possible room, so one scan cannot contradict it.",
        "a straight line": "in the robot frame, the room and its mirror image both move backwards. Both signs fit.",
        "a turn": "if the robot turns to the left, the room turns to the right in the robot frame, but its mirror image turns to the left.",
        "none: more scans at rest are needed": "more scans reduce the noise, but a wrong sign is a systematic error.",
    },
    right="a turn",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-experiment"
# ### The effect of a wrong sign on two scans
#
# A point of a wall is at $p'$ in the second scan. In the first scan it was at
# $p = \mathrm{Rot}(\theta)\, p' + t$, where the odometry gives $\theta$ and $t$. Without the minus sign
# the program decodes $M p$ and $M p'$, where $M$ is the reflection that changes the sign of $y$. How
# are these two points related? A reflection reverses a rotation:
#
# $$M\,\mathrm{Rot}(\theta) = \mathrm{Rot}(-\theta)\,M, \qquad \text{so} \quad M p = \mathrm{Rot}(-\theta)\,M p' + M t. \tag{14.5}$$
#
# We apply $\mathrm{Rot}(\theta)$ instead of $\mathrm{Rot}(-\theta)$, and $t$ instead of $M t$.
# So the second scan appears rotated by $2\theta$, and shifted. If the robot drives straight ahead, $\theta$ is 0, and
# $t$ lies on the $x$ axis, which the reflection does not change. Then the scans coincide.
#
# Conversely, a turn on the spot contains no information about the direction of the lidar's front, but a
# straight line does. So the robot drives an **arc**, which combines both motions.


# %% slideshow={"slide_type": "fragment"} answers="14-experiment"
def overlay(angles_decoded_as, motion, front):
    clockwise = angles_decoded_as == "clockwise"
    first, second = scan_pairs[motion].overlaid(clockwise, front)
    misfit = scan_pairs[motion].misfit(clockwise, front)
    title = f"median distance of the scans {misfit:.1f} cm"
    return views.overlay(first, second, title=title, size=(8, 5))[0]


# %% slideshow={"slide_type": "subslide"} answers="14-experiment"
views.explore(
    overlay,
    lambda angles_decoded_as, motion, front: (
        f"Two scans aligned by odometry, after {motion}, angles decoded as {angles_decoded_as}, front at {front:.0f}°: "
        f"the median distance is {scan_pairs[motion].misfit(angles_decoded_as == 'clockwise', front):.1f} cm."
    ),
    angles_decoded_as=["counter-clockwise", "clockwise"],
    motion=[*scan_pairs],
    front=(-180, 180, 0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-experiment"
# If the angles are decoded as counter-clockwise, the second scan is rotated relative to the first scan.
# With *clockwise*, the walls coincide. With *straight ahead*, both signs fit. Then choose an arc again
# and change the front: on this arc no direction of the front can compensate for the wrong sign.

# %% slideshow={"slide_type": "subslide"} answers="14-experiment" tags=["folded"]
fronts, arc = np.arange(-180, 181, 5), scan_pairs["an arc of 40°"]
misfits = {
    "clockwise": [arc.misfit(True, front) for front in fronts],
    "counter-clockwise": [arc.misfit(False, front) for front in fronts],
}
best = {name: min(each) for name, each in misfits.items()}
best_front = fronts[np.argmin(misfits["clockwise"])]
assert best_front == 0 and best["clockwise"] < 1 < 10 < best["counter-clockwise"]
fig, _ = views.curves(
    fronts, misfits, "assumed front of the lidar [°]", "median distance [cm]", size=(8, 3.6)
)
views.show(
    fig,
    f"With angles decoded as clockwise, the distance falls to {best['clockwise']:.1f} cm at {best_front}°; "
    f"with angles decoded as counter-clockwise, it never falls below {best['counter-clockwise']:.0f} cm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-experiment"
# Only one sign and one direction of the front fit: their median distance is {= best["clockwise"]:.1f =}
# cm. With the wrong sign the smallest median is {= best["counter-clockwise"]:.0f =} cm. The experiment
# does not require a known room. But does *every* arc show the error, in every room? By (14.5) a wrong
# sign rotates the second scan by $2\theta$. After an arc of 90° this rotation is 180°:

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="14-experiment"
# both signs, after arcs of 40° and 90°, in three rooms
rectangle = worlds.World(worlds.box((0, 0), (6, 4)), name="rectangle")
bare = worlds.World(worlds.box((0, 0), (40, 2)), name="bare corridor")
print("right sign: median [cm]; wrong sign: median and 90th percentile [cm]")
for world in (polygon, rectangle, bare):
    for name, seconds in SECONDS.items():
        pair = trials.two_scans(25, 25, seconds, world=world)
        right, *wrong = pair.misfit(), pair.misfit(False), pair.misfit(False, percentile=90)
        print(f"{world.name:>13}, {name}: {right:.1f};", "{:4.1f}, {:5.1f}".format(*wrong))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-experiment"
# In the middle of a bare corridor, the walls coincide after a rotation by 180°, so an arc of 90° does
# not show the error. In the rectangle the *median* does not show it: the scan is also shifted, but most
# of its points lie on the two long walls, and the shift is parallel to these walls. The 90th percentile
# shows the error at the short walls. (After a turn on the spot by 180°, $2\theta$ is 360°, and *no*
# room shows the error.) So choose an arc of 30° to 60°, compute other percentiles as well as the
# median, and repeat the experiment at a second place.
#
# **The experiment cannot detect one fault.** If the odometry also has the wrong sign, the mirrored
# scans fit, and the whole map is a mirror image. So check the sign of the odometry directly: command a
# turn to the left, watch the robot, and check that its angle count grows.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class vote before you show the figure, and ask for reasons for each
# answer. A student can act as the robot in front of the class, and describe how the room moves relative
# to the student.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Commands and checksums
#
# The robot eMIR uses a text protocol. A frame begins with `#` and ends with `/`. Between these
# characters it contains four bytes, each as two hexadecimal digits: an opcode, two arguments, and a
# checksum. A **checksum** is a number that is computed from the other bytes of a packet, so that the
# receiver can detect damage. A negative argument is sent as its *two's complement*, which is the number
# plus 256. The next cell prints three valid frames:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let everybody compute the checksum of (−1, −1). The wrong rule works for all
# positive arguments, so ask which tests a program needs.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for what, text in (("send", "#100100EF/"), ("halt", "#010000FF/"), ("reset", "#150000EB/")):
    print(f"{what:>5}  {text}  bytes", list(bytes.fromhex(text[1:-1])))

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-checksum",
    "In each of these frames the four bytes add up to 256. The opcode for driving is 01. The command for speed −1 and "
    "turn −1 has the bytes `01 FF FF`. **Which checksum belongs to these bytes?**",
    {
        "FF": "1 + 255 + 255 + 255 = 766, and this is not a multiple of 256.",
        "01": "1 + 255 + 255 + 1 = 512 = 2 · 256.",
        "none: 256 − 511 is negative": "a sum stored in one byte wraps around, so a sum of 512 is as valid as a sum of 256.",
        "00": "the three bytes add up to 511, which is not a multiple of 256.",
    },
    right="01",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-checksum"
# The robot stores the sum in one byte, so the sum is known only up to multiples of 256. The rule for
# all frames is therefore
#
# $$(\text{opcode} + \text{speed} + \text{turn} + \text{checksum}) \bmod 256 = 0. \tag{14.6}$$
#
# For two positive arguments the rule "256 minus the sum of the other bytes" gives the same checksum. So
# tests that only drive ahead and to the left never detect this mistake. But only 201 · 201 drive
# commands exist, and we can test all of them with the robot's own decoder:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="14-checksum"
print("speed −1, turn −1:", commands.move(-1, -1).decode())
every = [(v, omega) for v in range(-100, 101) for omega in range(-100, 101)]
framer = Framer(COMMAND)
accepted_frames = framer.feed(b"".join(commands.move(v, omega) for v, omega in every))
print(f"{views.grouped(len(accepted_frames))} of {views.grouped(len(every))} commands are accepted")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-checksum"
# A receiver rejects a frame with a wrong checksum. Our emulated robot sends no error message, and
# continues with the *previous* command. (The appendix [In print](in_print.ipynb) counts the commands
# that a published driver loses in this way.)
#
# The lidar's capsules have a checksum, too: the *exclusive or* of bytes 2 to 83. They also begin with two *sync nibbles*
# (half bytes), `a` and `5`. Random bytes pass both tests with a probability of 1 in
# {= views.grouped(256 * 256) =}, so the framing of capsules is far more reliable than that of nodes.
# (*This is a good place for a break.*)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Part two: counters that wrap around
#
# eMIR answers with status messages. Our emulated robot sends ten of them per second: a `*`, 17 bytes as
# hexadecimal digits, and a `/`. Byte 14 counts the path (about a centimetre per count), and byte 15
# counts the turn (about 2° per count). Both are **signed bytes**, from −128 to 127. The robot drives
# along a corridor at half speed, and we read the path counter once a second:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
half_speed, _ = trials.statuses_of([(16, 50, 0)], worlds.corridor())
path = [status.path for status in half_speed]
print("path:", *path[::10])

# %% slideshow={"slide_type": "subslide"}
ask(
    "14-ring",
    "A robot whose top speed is 40 cm/s sends a status every second. Its path counter is 120 in one status and −116 in the next. "
    "**How many counts, of 1 cm each, has it driven between the two?**",
    right=20,
    tolerance=0.5,
    unit="counts",
    reason="the counter makes 7 counts to 127, one count to −128, and 12 counts to −116.",
    wrong={
        -236: "this is the difference of the two values. The robot cannot drive back more than two metres in a second.",
        236: "the robot cannot drive more than two metres ahead in a second.",
        19: "a byte has 256 values, not 255: the step from 127 to −128 is one count, too.",
        -20: "the absolute value is right, but the counter increased from 120 past 127, so the sign is positive.",
    },
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-ring"
# ### Unwrapping modulo 256
#
# After 127 the counter *wraps around* to −128, so its 256 values form a ring. Two readings $n_k$ and
# $n_{k+1}$ do not show how many *full revolutions* of the ring the counter made between them. So the
# step $\Delta_k$ is known only up to multiples of 256. Exactly one of the possible steps lies in the
# range of a signed byte, and this step is the shortest:
#
# $$\Delta_k \equiv n_{k+1} - n_k \pmod{256}, \qquad -128 \le \Delta_k \le 127. \tag{14.7}$$
#
# The distance since the start is the sum of the steps, stored in a wider integer. Computing this sum is
# called *unwrapping*.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="14-ring"
# the path, unwrapped by the library
def unwrapped(values):
    """Counts since the first reading, by the library's unwrapper."""
    counter = CounterUnwrapper()
    return np.cumsum([counter.advance(value) for value in values])


print("unwrapped:", *unwrapped(path)[::10])
print("from 120 to −116:", unwrapped([120, -116])[-1])

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-ring"
# The unwrapped values contain no overflow. The same rule works for backward motion, because (14.7)
# allows positive and negative steps. The rule has three conditions: fewer than 128 counts between two
# readings, no reset of the counter between them, and a counter that wraps around (some counters stop at
# 127, which is called *saturation*).

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Draw the ring of 256 values on the board, with 127 and −128 side by side. Ask the
# students for rules for the step, and test each rule on a robot that drives back.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The longest interval between two readings
#
# How long may the interval between two readings be? Half a ring is 128 counts. So the interval is
# limited:
#
# $$\text{interval} < \frac{128 \cdot \text{size of a count}}{\text{speed}}. \tag{14.8}$$
#
# One count of our emulated robot is 1.03 cm of path or 2.14° of turn. At full speed it drives at 40 cm/s, or turns by
# 100° a second.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Increase the interval in the figure slowly past the limit of (14.8). The robot
# seems to drive backwards: ask for the same effect in films (the wheels of a coach).

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-pause",
    "The robot drives at full speed. **How many seconds may pass between two readings of the path, at most?**",
    right=3.3,
    tolerance=0.06,
    unit="s",
    reason="128 counts of 1.03 cm are 132 cm, and 132 cm at 40 cm/s take 3.3 s.",
    wrong={
        6.6: "in this time the counter makes a full revolution. For steps of more than half a ring, (14.7) gives a wrong step.",
        3.2: "this is the interval for counts of exactly 1 cm, but a count is 1.03 cm.",
        0.31: "this is the speed divided by the distance: invert the fraction.",
    },
)

# %% slideshow={"slide_type": "subslide"} answers="14-pause" tags=["folded"]
full_speed, _ = trials.statuses_of([(16, 100, 0)], worlds.corridor())
PATHS = {"100 %": [status.path for status in full_speed], "50 %": path}
limits = dict(zip(("path", "turn"), 128 * np.array(COUNT_SIZE) / TOP_SPEEDS, strict=True))


def read_every(interval, speed):
    tenths = max(round(10 * interval), 1)
    sent = PATHS[speed][::tenths]
    shown = {
        "unwrapped": unwrapped(sent),
        "as sent": sent,
        "truth": unwrapped(PATHS[speed])[::tenths],
    }
    time = 0.1 * tenths * np.arange(len(sent))
    fig, ax = views.curves(time, shown, "time [s]", "path [counts]", size=(8, 4))
    ax.lines[2].set_color(views.COLOURS["truth"])
    views.legend(ax, loc="upper left")
    return fig


# %% slideshow={"slide_type": "subslide"} answers="14-pause"
views.explore(
    read_every,
    lambda interval, speed: (
        f"The path over time at {speed} of the speed, read every {interval:.1f} s: the values sent stay within a byte, "
        f"and the unwrapped values end at {unwrapped(PATHS[speed][:: max(round(10 * interval), 1)])[-1]} counts."
    ),
    interval=(0.1, 5.0, 3.5),
    speed=["100 %", "50 %"],
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-pause"
# With a reading every 3.5 s the unwrapped path of a robot that drives forwards decreases, and no single
# reading shows the error. This effect is called *aliasing*: the sample rate of the counter is too low.
# Find the longest interval that gives the true path, first at full speed and then at half speed.
# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-pause"
# **Your turn.** The robot turns on the spot at full speed, 100° per second, and a count is 2.14°. How
# many seconds may pass between two readings of the turn?

# %% slideshow={"slide_type": "fragment"} answers="14-pause" tags=["your-turn"]
longest_interval = ...  # (14.8), in seconds
compare(longest_interval, limits["turn"])

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-pause"
# <details><summary>Answer</summary>
#
# ```python
# longest_interval = 128 * 2.14 / 100
# ```
#
# </details>

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="14-pause"
# are the limits of (14.8) correct? We test all intervals from 1 to 5 seconds
spinning, _ = trials.statuses_of([(16, 0, 100)], worlds.room())
counters = {"path": PATHS["100 %"], "turn": [status.angle for status in spinning]}
for name, values in counters.items():
    right = [k for k in range(10, 50) if unwrapped(values[::k])[-1] == unwrapped(values)[::k][-1]]
    assert right[-1] / 10 < limits[name] < right[-1] / 10 + 0.1
    print(f"{name}: right up to {right[-1] / 10} s; by (14.8) up to {limits[name]:.2f} s")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-pause"
# So the path counter allows {= limits["path"]:.1f =} s, and the turn counter {= limits["turn"]:.1f =}
# s. The shorter of the two intervals is the limit. With ten status messages per second, even the loss
# of twenty consecutive messages causes no error.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Scale factors of the odometry
#
# How large is a count? Tuček's thesis uses 1 cm and 2°. Another program for robots of the same kind uses 1.03 cm and
# 2.14°. Neither source states the origin of its numbers. Our emulated robot uses the second pair. So
# with the first pair the measured path is {= 100 - 100 / 1.03:.0f =} % too short, and every measured
# turn is {= 100 - 200 / 2.14:.1f =} % too small. Such constant relative errors are *systematic odometry
# errors*.

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-harm",
    "The robot drives 11 m round a table, past four sides and four corners, back to its start. **Which wrong scale causes the larger error of the last position?**",
    {
        "the path: 3 % of 11 m are 33 cm": "on a straight line the error would be 33 cm. On a closed path the errors of opposite sides cancel: the whole "
        "path is only a little too small.",
        "the turn": "the measured turn at each corner is 6° too small, and the heading error is multiplied by the length of the rest of the path.",
        "both the same": "a wrong path scale changes the size of the loop, but a wrong turn scale changes its shape.",
    },
    right="the turn",
)

# %% slideshow={"slide_type": "subslide"} answers="14-harm" tags=["folded"]
trip, room = trials.round_trip(seed=5), worlds.room()


def by_odometry(path_cm, turn_degrees):
    track = trip.track(path_cm, turn_degrees)
    off = trip.error(path_cm, turn_degrees)
    fig, ax = views.axes(f"position error at the end {off:.0f} cm", size=(8, 5.4))
    views.draw(ax, Segments("walls", room.outline()))
    views.draw(ax, Poses("truth", trip.true), label="ground truth")
    views.draw(ax, Poses("naive", track), label="wheel odometry")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"} answers="14-harm"
views.explore(
    by_odometry,
    lambda path_cm, turn_degrees: (
        f"A room with a table and the true trajectory round it; with counts of {path_cm:.2f} cm and {turn_degrees:.2f}° the last "
        f"position error of the odometry is {trip.error(path_cm, turn_degrees):.0f} cm."
    ),
    path_cm=(0.95, 1.10, 1.0),
    turn_degrees=(1.9, 2.3, 2.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-harm"
# With the numbers of the thesis each measured turn is 6° too small, and the estimated loop does not
# close. Increase `path_cm`: the trajectory becomes larger, but its end does not come nearer to the
# start. Set `turn_degrees` to 2.14: the loop closes. Do other runs give the same result? The wheels
# slip at random, so we simulate thirty runs:

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="14-harm"
# thirty round trips, with each pair of scale factors
PAIRS = {
    "thesis": (1, 2),
    "path correct": (1.03, 2),
    "turn correct": (1, 2.14),
    "both": (1.03, 2.14),
}
trips = [trials.round_trip(seed) for seed in range(30)]
off = {name: np.array([each.error(*pair) for each in trips]) for name, pair in PAIRS.items()}
nearer = {name: np.sum(each < off["thesis"]) for name, each in off.items()}
for name, each in off.items():
    print(f"{name:>12}: median position error {np.median(each):3.0f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="14-harm"
# The correct scale of the turn reduces the last position error in {= nearer["turn correct"] =} of the
# {= len(trips) =} runs, and the correct scale of the path in {= nearer["path correct"] =} of them. If
# both scales are correct, a median error of {= np.median(off["both"]):.0f =} cm remains. Its cause is
# slip, which no scale factor removes. (A wrong scale of the path also causes an error: the whole map
# has the wrong size. A closed path cannot show this error.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which motion best shows a wrong path scale, and which motion best shows a
# wrong turn scale. The section "Odometry calibration" uses both motions.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Drivers
#
# From here on we use the library's drivers. Each driver has a thread that continuously receives the
# bytes of its device, so that no bytes accumulate while your program computes. The two names in the
# next cell determine which robot the rest of the lesson uses.
#
# With the value `None`, each cell starts its own emulators, and the library's drivers communicate with
# these emulators. The time of the emulators is *simulated*: it advances only while a program waits for
# a reading. So no data are lost on a busy computer.
#
# If a port cannot be opened, a message states the likely cause and the next step. (If the front of the
# robot is not at 0° of your lidar, pass the angle of the front as `front=` to `devices`. A notch in the
# housing marks 0°.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This slide decides which robot the rest uses, so enter the ports before the
# lecture. Ask where the watchdog should be, and let the class find the failures against which the one
# on the computer does not help.

# %% slideshow={"slide_type": "fragment"}
# the ports of your devices; None: emulators
LIDAR_PORT = None  # such as "/dev/ttyUSB0" or "COM3"
EMIR_PORT = None  # such as "/dev/rfcomm0" or "COM12"


def robot(rng, calibration=None):
    """Lidar and eMIR as a source of readings: yours, or emulated ones in a room."""
    if EMIR_PORT is None:
        return EmulatedDevices(worlds.room(), rng, calibration, SimulatedClock())
    return devices(f"{LIDAR_PORT or ''},{EMIR_PORT}", calibration)


# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Watchdog and emergency stop
#
# A robot executes its last command until the next command arrives. What does the robot do after your
# program has ended, for example by an exception?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the program ends while the robot drives
body = EmulatedRobot(worlds.corridor(), np.random.default_rng(1))
emir = EmirEmulator(body)
emir.feed(commands.move(50, 0), 0.0)
emir.feed(b"", 1.0)  # here the program ends
ended_at = body.pose[0]
emir.feed(b"", 6.0)
print(f"five seconds later the robot is {body.pose[0] - ended_at:.1f} m farther")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The robot drives on until it hits a wall. Therefore, the library's drivers stop the robot and the
# lidar's motor when they are closed, also when the program ends with an error. Besides, a **watchdog**
# stops a motion if the program has not repeated the command within two seconds.
#
# **This is not a safety device.** The watchdog is part of the driver, so it runs on the computer and not on the robot.
# If the program is killed, the computer fails, the adapter is unplugged or the radio link is lost, no
# stop command arrives, and the robot drives on. So always stay within reach of the robot's switch. A
# robot that must be safe has its own watchdog, which stops the motors if a regular message (a
# *heartbeat*) does not arrive.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Odometry calibration
#
# **Calibration** determines the parameters of a device by measurements: here, the number of metres or
# radians per count.
#
# 1. Mark the position of the robot on the floor, and run the next cell. The robot drives one metre and
#    then four quarter turns, as measured by *its own* counters.
# 2. Measure the distance with a tape. With a protractor, measure the angle by which the four quarter
#    turns exceed 360° (negative if their sum is less).
# 3. Enter both values in the cell after the next cell, and run it. (With `None`, the emulator supplies
#    the true values.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* With a robot, mark the floor with tape before the lecture; the run takes about a
# metre of free space and four quarter turns. Let two students measure, and compare their values with
# the resolution of one count.

# %% slideshow={"slide_type": "fragment"}
with robot(np.random.default_rng(7)) as source:
    bench, marks = getattr(source, "bench", None), []
    counts = calibration_run(source.emir, lambda: marks.append(bench and bench.body.pose))

# %% slideshow={"slide_type": "subslide"} tags=["code"]
TAPE, PROTRACTOR = None, None  # [m], [degrees] beyond a full turn

if bench is not None:
    steps = between(np.array(marks[:-1]), np.array(marks[1:]))
    measured = np.hypot(*steps[0, :2]), np.degrees(steps[1:, 2].sum())
else:
    assert TAPE and PROTRACTOR is not None, (
        "measure both values, enter them in this cell, and run it again"
    )
    measured = TAPE, 360 + PROTRACTOR
metres, degrees = measured / counts
calibrated = Calibration(path=metres, angle=np.radians(degrees))
print(
    f"{measured[0]:.2f} m, {measured[1]:.0f}°: a count is {100 * metres:.2f} cm and {degrees:.2f}°"
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The true values of the simulated robot are 1.03 cm and 2.14°. An error of one count is 1 % of a metre,
# so a longer distance gives a more accurate value. If the degrees per count are negative, your robot
# counts clockwise turns as positive: keep the sign.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Recording and replay
#
# A run of a robot cannot be repeated exactly, but its bytes can be replayed. A **raw recording**
# contains all bytes that were read or written, with their times and checksums, and no derived data. We
# record a simulated run round the table:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# record a simulated run round the table, and read the file
folder = tempfile.TemporaryDirectory()
drive = Path(folder.name) / "table.rec"
COURSE = [(0.5, 0, 0), *trials.ROUND, (0.5, 0, 0)]
true = record_synthetic_run(drive, room, np.random.default_rng(6), COURSE)
raw = drive.read_bytes()
recording = parse(raw, "table.rec")
received = [record.kind for record in recording.records].count(RX)
whole = list(revolutions(recording))
print(f"{recording.seconds:.0f} s, {received} pieces received, {len(whole)} revolutions")

# %% [markdown] slideshow={"slide_type": "subslide"}
# These commands record and replay a run in a shell:
#
# ```
# slamlab emulate --world room                   # two ports, until Ctrl-C
# slamlab record devices:LIDAR,EMIR --out my.rec # type V,OMEGA to drive
# slamlab replay my.rec                          # the devices, at two ports
# slamlab run my.rec                             # or map it directly
# ```
#
# (The two ports of `emulate` and `replay` are **pseudo-terminals**: programs use them like serial
# ports.) So a class of forty students needs only one robot and one recording. Every estimator of this
# course can use the source `sources.open("my.rec")`.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Record a run in the lecture, and replay it next year. If you enter the two ports
# of `slamlab replay` in LIDAR_PORT and EMIR_PORT, the cells below use this recording through the real
# drivers. The robot of a replay follows its recorded trajectory, and ignores all commands.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Latency and time synchronisation
#
# To deskew a scan, the driver needs the robot's pose at the time of each *beam*. But when was a beam
# measured? The lidar and the eMIR send bytes without timestamps, and these bytes arrive late. The
# measurement of a capsule takes {= 32 * 0.254:.0f =} ms and its transmission {= 84 * 10 / 115.2:.0f =}
# ms, and a USB adapter delays bytes by 1 to 16 ms. Relating the times of all devices to one clock, here
# that of the computer, is called **time synchronisation**.
#
# The library's driver subtracts the known delays of the capsule and of the line. For the unknown delay
# it uses two facts: the sample rate is constant, and bytes may arrive late but never early. So the
# driver fits a straight line, arrival time over point number, to the *earliest* arrivals. (This method
# cannot find a delay that is equal for all bytes.) Does this accuracy matter?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students think of latency as a delay of the picture. Ask what a constant delay
# of the odometry does to a robot that drives straight ahead (little), and to one that turns (much,
# far away).

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** A robot turns by 50° per second, and its odometry reaches the program with an
# uncorrected latency of 0.1 s. How large is the error of a map point at a distance of 4 m?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
displacement = ...  # in metres
compare(displacement, abs(4 * np.exp(1j * np.radians(5)) - 4), tolerance=0.01)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# displacement = np.radians(50 * 0.1) * 4
# ```
#
# In 0.1 s the robot turns by 5°, and at 4 m this is an arc of 35 cm.
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# The recorded robot drives at up to 40 cm/s and turns at up to 50° per second, so it moves by up to 4 cm
# or turns by up to 5° during
# one revolution of its lidar. We map the recording with `icp` three times: with the library's method,
# without deskewing, and with odometry that is 0.1 s late. **Before you run the cell:** how large will
# the error of the last position be?

# %% slideshow={"slide_type": "fragment"}
# the error at the end of the recording, mapped in three ways
MAPPED = {
    "by the library": {},
    "without deskewing": {"deskewed": False},
    "odometry 0.1 s late": {"latency": 0.1},
}
end_errors = trials.mapping_errors(drive, true, MAPPED)
for name, error in end_errors.items():
    print(f"{name:>22}: position error at the end {error:.1f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In this run the error of the last position was {= end_errors["without deskewing"]:.1f =} cm with motion distortion
# instead of {= end_errors["by the library"]:.1f =} cm, and with an uncorrected latency it
# was {= end_errors["odometry 0.1 s late"]:.1f =} cm. In three further runs (seeds 1 to 3) the errors
# were 3 to 4 cm with the library's method. They were 6 to 14 cm without deskewing, and 4 to 7 cm with
# the latency. So the error with the library's method was the smallest in each run, but not by a
# constant factor.
#
# Why is this error smaller than the 35 cm of *Your turn*? The 35 cm is the displacement of one point
# while the robot turns, and scan matching aligns the displaced scan with the map again. But without
# time synchronisation even a perfect lidar and perfect odometry produce a wrong map if the robot moves.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## Live SLAM
#
# Now we combine all the parts, as in Tuček's program, which draws two maps side by side. The first map
# uses **odometry alone**; the thesis calls this map naive. For the second map, the **estimate**, the
# program aligns each scan with the earlier scans by the scan matching of lesson 13. Both maps use 1 cm
# for a count of the path and 2° for a count of the turn, as in the thesis.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Threads, queues and back-pressure
#
# The matcher may be slower than the lidar. Which of the two must wait then, and which data may be
# dropped?
#
# If a consumer is slower than its producer, either the producer must wait, or data must be dropped. If
# the consumer makes the producer wait, this is called **back-pressure** (also *flow control*). The live
# view uses back-pressure: it sends the next image only after the browser has drawn the last image.
# Without back-pressure the number of waiting images would grow, and so would the delay of the display.
# But a lidar cannot wait. Therefore, its driver has a *bounded queue*, which stores the two
# newest revolutions, drops older revolutions, and counts the dropped revolutions.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
Box, step, kept = views.Box, partial(views.Box, "step"), partial(views.Box, "kept")
boxes = {
    "lidar": Box("device", "lidar", 0.5, 3.0, 0.8),
    "eMIR": Box("device", "eMIR", 0.5, 1.75, 0.8),
    "lidar's": step("RPLidar\n(a thread)", 2.1, 3.0, 1.2),
    "eMIR's": step("Emir\n(a thread)", 2.1, 1.2, 1.2, 1.8),
    "revolutions": kept("two newest\nrevolutions", 3.75, 3.0, 1.3, 0.75),
    "odometry": kept("odometry", 3.75, 1.75, 1.3),
    "source": step("devices", 5.25, 2.375, 0.9, 1.95),
    "icp": step("icp", 6.9, 2.375, 0.7, 0.9),
    "view": step("live.watch", 8.6, 1.5, 1.2, 2.5),
    "drive": step("drive", 5.25, 0.65, 0.9),
    "map": kept("pose, map,\nlast scan", 6.9, 4.05, 1.3, 0.8),
    "older": Box("lost", "older ones", 3.75, 4.2, 1.3, 0.6),
}
flows = [
    *(("lidar", "lidar's", "bytes"), ("=eMIR", "eMIR's", "bytes"), ("lidar's", "revolutions", "")),
    *(("eMIR's", "odometry", ""), ("revolutions", "older", ""), ("revolutions", "source", "")),
    *(("odometry", "source", ""), ("source", "icp", "reading"), ("=icp", "map", "")),
    *(("icp", "view", "maps"), ("view", "drive", "commands")),
    ("drive", "eMIR's", "speed, turn rate"),
]
views.show(
    views.process(boxes, flows, (9.3, 4.7)),
    "One thread receives the bytes of the lidar, keeps the two newest revolutions and drops older ones. Another "
    "thread receives the bytes of the eMIR and keeps the odometry. A source combines both into readings, icp maps "
    "them, and live.watch shows the maps and sends commands back to the eMIR's thread.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The program never drops odometry. The source requests the robot's pose at the end of each revolution
# that it passes on. After a pause the odometry increment of one reading is larger, but still complete.
# In Tuček's program these parts are the classes *Lidar*, *App*, *Slam* and *ICP*.

# %% slideshow={"slide_type": "fragment"}
ask(
    "14-live",
    "The heading estimated by odometry alone drifts slowly. **Where do the walls of its map blur first?**",
    {
        "near the robot, where most points lie": "a heading error displaces points near the robot only a little.",
        "far from the robot": "a heading error rotates the scan about the robot, so a point is displaced by the angle times its distance.",
        "everywhere by the same amount": "a position error displaces all points by the same amount, but a heading error rotates the scan.",
    },
    right="far from the robot",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-live"
# ### Drive the robot yourself
#
# The figure below has three buttons:
#
# - **A recording** needs no robot: press *reset* and *run*.
# - **A robot**: press this button, then *run*. Drive with the buttons, or click the figure and use the
#   arrow keys (the space bar stops the robot). You can also type the commands of the thesis:
#   `distance, angle`, `reset`, `exit`. With `0.5, 30` the robot turns by 30° and then drives half a
#   metre; the estimated pose controls both motions.
# - **A robot, calibrated** uses your own scale factors. They also improve the map by odometry alone,
#   but the wheels still slip.
#
# To draw the estimate alone, write `naive=None` instead of `naive=(-8.5, 0)` in the cell below. The
# page of `slamlab live` has a checkbox for this purpose.
#
# The robot stops if you press *pause* or *exit*, run the cell again, or end the kernel, as long as the
# link works.

# %% slideshow={"slide_type": "skip"} answers="14-live"
played = {
    "A recording": lambda rng: sources.open(drive),
    "A robot": robot,
    "A robot, calibrated": partial(robot, calibration=calibrated),
}

# %% slideshow={"slide_type": "slide"} answers="14-live" tags=["folded"]
seen_live = live.watch(
    played,
    live.shift_layers(partial(estimators.make, "icp"), naive=(-8.5, 0)),
    "Left: the map by odometry alone, with every wall drawn several times. Right: the estimate, one sharp room.",
    steps=350,
    note=trials.errors_now,
    truth=False,
    title="eMIR: odometry alone on the left, the estimate on the right",
    speed=10,
    tops=(0.3, 0.6),
    size=(760, 400),
)
naive_off, corrected_off = trials.errors(seen_live.pair.estimator, true.poses[-1])

# %% [markdown] slideshow={"slide_type": "subslide"} answers="14-live"
# After one lap round the table, the map by odometry alone shows each wall several times, at different
# angles. The far walls differ most. In the estimated map every wall is one line. Both maps are computed
# from the same bytes. At the end of this simulated run the position error of odometry alone was
# {= naive_off:.0f =} cm, and that of the estimate {= corrected_off:.0f =} cm.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Show a lost connection while the cell runs: unplug the USB cable of the *lidar* of
# a real robot, or run `seen_live.pair.source.bench["lidar"].faults.unplugged = True` for the emulated
# robot, in a cell that you add below before the lecture (slides have no new cells). A message appears below the figure after a short time; *reset* starts the run
# again. For a class without robots, use your recording: write `lambda rng: sources.open("my.rec")` for
# the first button.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# Tuček, master's thesis, Zagreb, 2022: the system that this lesson follows, from the bytes to the live map, with
# its listing.
#
# I. Vizzo et al., "KISS-ICP: in defense of point-to-point ICP", *IEEE Robotics and Automation Letters* 8(2), 2023:
# laser odometry by a constant-velocity model, deskewing, and ICP with an adaptive threshold.
#
# Slamtec, *RPLIDAR Interface Protocol and Application Notes*: nodes, capsules, requests.
#
# J. Borenstein and L. Feng, "Measurement and correction of systematic odometry errors in mobile robots", *IEEE
# Transactions on Robotics and Automation* 12(6), 1996 (the method is called *UMBmark*): the ratio of the two wheels and
# the effective wheelbase, found by driving a square in both directions. The common scale is measured with a tape.
#
# T. C. Maxino and P. J. Koopman, "The effectiveness of checksums for embedded control networks", *IEEE
# Transactions on Dependable and Secure Computing* 6(1), 2009: which errors a sum or an exclusive or does not detect.
#
# **Read next:** Borenstein and Feng. You can repeat their square test with your own robot.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can estimate the motion of a lidar from its scans alone, decode the bytes of a device, detect a
# wrong sign, and send commands with a valid checksum. You can unwrap counters, calibrate the odometry,
# record and replay a run, estimate the error caused by latency, and drive a robot while you watch its
# live map.
#
# **What comes next:** the estimated map is sharp after one lap. In a larger building small errors
# accumulate, and walls appear twice in the map when the robot returns to a place. Lesson
# [15](15_pose_graph_slam.ipynb) recognises such places and closes the loop.
#
# The sections below this one are optional.
#
# **Exercise:**
# [14 · Devices and live SLAM: RPLIDAR and eMIR](../exercises/ex14_devices_and_live_slam.ipynb). You
# decode the bytes of this lidar and of an unknown lidar, deskew a scan, unwrap counters, and find
# faults in given drivers.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: two decodings of a capsule
#
# Slamtec's *document* and Slamtec's *program* decode a capsule differently. In the document the top bit
# of an offset is a sign, and $k$ runs from 1 to 32:
#
# $$\psi_k = \psi + \frac{k}{32}\,\bigl((\psi' - \psi) \bmod 360^\circ\bigr) - \delta_k \tag{14.9}$$
#
# for $k$ from 1 to 32. Here $\delta_k$ is the number in the five lower bits, negative if the top bit
# is set. In the program the top bit counts 4°. The offsets of our capsules are nearly always above 4°,
# so their top bit is nearly always set, and the two decodings differ for nearly every point.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A good example of two documents of one maker that disagree. Ask for the
# experiment that decides; part one has it.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
from course.studies import published_drivers as printed

pairs = list(pairwise(capsules[16:31]))
as_document = np.vstack([printed.as_documented(*two) for two in pairs])
nodes = ExpressDecoder().feed(b"".join(capsules[16:31]))
as_program = np.column_stack([nodes["angle_q6"] / 64, nodes["distance_q2"] / 4])
pictures, turned = {}, np.median((as_document[:, 0] - as_program[:, 0] + 180) % 360 - 180)
for name, rows in {"program": as_program, "document": as_document}.items():
    beta, r = robot_frame(*rows.T)
    points = np.column_stack([r * np.cos(beta), r * np.sin(beta)])
    pictures[f"decoded by the {name}"] = [
        Segments("walls", polygon.outline()),
        Points("scan", points),
    ]
fig, _ = views.side_by_side(pictures, size=(9, 4.4))
views.show(
    fig,
    f"In the left figure the points lie on the walls; in the right figure they are rotated by {turned:.0f}° (median).",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the decoding of the document, the room is rotated clockwise by {= turned:.0f =}°. Our emulator
# encodes capsules for the *program*, so this figure shows the difference of the two decodings, but not
# which decoding is right. The experiment with the arc on a real A2 can decide: with the right decoding
# the walls coincide if the assumed front is the notch that marks 0° of the lidar.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: truncated recordings
#
# If the computer loses power during a recording, the file may end in the middle of a message. Besides,
# the *pieces* in which bytes arrive differ between computers, so the result must not depend on these
# pieces.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what a program should do with the last, incomplete message, and how to test
# that the result does not depend on the pieces.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# a truncated file, and a stream cut into pieces in 20 ways
left = list(revolutions(parse(raw[: len(raw) * 3 // 5 + 1], "table.rec")))
same = all(np.array_equal(a.range_mm, b.range_mm) for a, b in zip(left, whole, strict=False))
print(
    f"cut at 60 %: {len(left)} of {len(whole)} revolutions are left, equal to the last bit: {same}"
)
at_once, rng, differ = ExpressDecoder().feed(stream), np.random.default_rng(6), 0
for _ in range(20):
    cuts = np.sort(rng.integers(0, len(stream), 100))
    decoder, pieces = ExpressDecoder(), np.split(np.frombuffer(stream, np.uint8), cuts)
    differ += not np.array_equal(np.concatenate([decoder.feed(bytes(p)) for p in pieces]), at_once)
print(f"the bytes cut into pieces in 20 ways: {differ} gave other points")
