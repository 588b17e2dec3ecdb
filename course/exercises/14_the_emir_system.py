# %% [markdown]
# # Exercise 14 · The eMIR system
#
# **You will be able to** read a lidar's bytes and lay its points where they belong, send a robot
# commands that it does not drop, read what it answers, and add up how far it went although its
# counter overflows.
#
# **60 minutes. Before:** lesson [14 · The eMIR system](../notebooks/14_the_emir_system.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check sends bytes that nobody has seen before and says which law is
# broken, and what the mistake is where it knows it.

# %%
import numpy as np

from slamlab import views, worlds
from slamlab.checks import attempt, check
from slamlab.layers import Points, Segments

# %% [markdown]
# ## 1 · A lidar's bytes
#
# After SCAN an RPLIDAR sends **nodes** of five bytes without end:
#
# | byte | bits | meaning |
# | --- | --- | --- |
# | 0 | 0 | S, a turn begins here |
# | | 1 | not S |
# | | 2–7 | quality |
# | 1, 2 | 0 | C, always 1 |
# | | 1–15 | angle [1/64 degree] |
# | 3, 4 | 0–15 | distance [1/4 mm] |
#
# Words of two bytes are little endian. Some nodes are damaged: S and not S are the same, or C is 0.
# Leave those out. (The step is never lost here: every node begins where the one before ended.)
#
# Try one with pencil and paper: `3e 01 2d a0 0f` has S = 0, quality 15, 90°, 1000 mm.


# %% name="nodes"
def nodes(data):
    """The nodes in a packet of bytes.

    data : bytes, five for each node; data[0] is a number from 0 to 255
    returns (n, 4), one row for each good node: S (0 or 1), quality, angle [degree], distance [mm]
    """
    ### BEGIN SOLUTION
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word, distance = a | b << 8, c | d << 8
        if flags & 1 != flags >> 1 & 1 and word & 1:
            found.append([flags & 1, flags >> 2, (word >> 1) / 64, distance / 4])
    return np.array(found)
    ### END SOLUTION


# %%
check("14-nodes")

# %% [markdown]
# A lidar in Tuček's polygon sends one turn. **Before you run it:** about 2000 nodes a second, ten
# turns a second: how many nodes will it be?


# %% name="one-turn"
def heard(world, seconds):
    """What an emulated lidar at a world's origin sends after SCAN, without the answer's head."""
    from slamlab.devices.emulator.robot_body import RobotBody
    from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
    from slamlab.devices.emulator.motion_distortion import MovingLidar
    from slamlab.devices.rplidar.requests import Command, request

    rng = np.random.default_rng(1)
    lidar = RPLidarEmulator(MovingLidar(RobotBody(world, rng), rng), rng=rng)
    sent = lidar.feed(request(Command.SCAN), 0.0)
    sent += b"".join(lidar.feed(b"", 0.01 * k) for k in range(1, round(100 * seconds)))
    return sent[7 : 7 + (len(sent) - 7) // 5 * 5]


@attempt
def _():
    turn = nodes(heard(worlds.polygon(), 0.2))
    begin, end = np.flatnonzero(turn[:, 0])[:2]
    print(f"{end - begin} nodes from one S to the next, {np.sum(turn[:, 3] == 0)} came back empty")
    print("the first ones:", *(f"{a:.2f}° {d:.0f} mm" for _, _, a, d in turn[begin : begin + 3]))


# %% [markdown]
# ## 2 · Points
#
# The lidar counts its degrees **clockwise**, seen from above. It may be mounted any way round: the
# robot's front lies at `front` degrees of the lidar's. Give points in the robot's frame: x ahead, y
# to the left, in metres. A distance of 0 says that nothing came back.


# %% name="points"
def points(degrees, millimetres, front):
    """The points of a turn, in the robot's frame.

    degrees : (n,) clockwise;  millimetres : (n,) 0 where nothing came back
    front : float, where the robot's front lies for the lidar [degree]
    returns (k, 2) [m], in the order of the readings
    """
    ### BEGIN SOLUTION
    back = millimetres > 0
    angle, r = np.radians(front - degrees[back]), millimetres[back] / 1000
    return np.column_stack([r * np.cos(angle), r * np.sin(angle)])
    ### END SOLUTION


# %%
check("14-points")

# %% [markdown]
# The same turn, drawn with your `nodes` and `points`. **Before you run it:** how would a mirrored
# map show here?


# %% name="polygon"
@attempt
def _():
    world = worlds.polygon()
    _, _, degrees, millimetres = nodes(heard(world, 0.2)).T
    fig, ax = views.axes("the polygon by your decoder", size=(5, 4))
    views.draw(ax, Segments("walls", world.outline()))
    views.draw(ax, Points("scan", points(degrees, millimetres, 0.0)))
    views.legend(ax, loc="lower right")
    views.show(fig, alt="Points of a scan on the walls of the polygon.")


# %% [markdown]
# The points lie on the walls: bytes have become a map.

# %% [markdown]
# ## 3 · A command
#
# eMIR hears frames of text, `#OOTTRRCC/`: four bytes as two hexadecimal digits each. To drive, the
# opcode OO is 01; TT is the speed and RR the turn, whole numbers in percent. Cut them off at ±100.
# Negative ones go as two's complement: −50 as 256 − 50. CC makes **all four bytes add up to 0
# modulo 256**.


# %% name="command"
def command(speed, turn):
    """The frame that makes eMIR drive.

    speed, turn : int [%];  returns str, such as "#013200CD/"
    """
    ### BEGIN SOLUTION
    data = [1] + [max(-100, min(100, each)) % 256 for each in (speed, turn)]
    return "#" + "".join(f"{byte:02X}" for byte in [*data, -sum(data) % 256]) + "/"
    ### END SOLUTION


# %%
check("14-command")

# %% [markdown]
# The robot's own framer judges all 40 401 commands. The thesis' rule gets 20 301 through.


# %% name="all-commands"
@attempt
def _():
    from slamlab.devices.emir.frames import COMMAND, Framer

    every = range(-100, 101)
    sent = "".join(command(speed, turn) for speed in every for turn in every)
    print(len(Framer(COMMAND).feed(sent.encode())), "of 40401 commands are understood")


# %% [markdown]
# ## 4 · A status
#
# Ten times a second eMIR says how it is: `*`, 17 bytes as hexadecimal digits, `/`. All 17 bytes add
# up to 0 modulo 256; a frame that does not is damaged: return `None`. Bytes are counted from 0:
#
# | byte | meaning | sign |
# | --- | --- | --- |
# | 2 | distance of the infrared sensor in front [cm] | no |
# | 7 | speed [%] | yes |
# | 13 | compass [2 degrees] | no |
# | 14 | path counter | yes |
# | 15 | angle counter | yes |
#
# A signed byte above 127 is negative: take 256 off.


# %% name="status"
def status(text):
    """What eMIR says in a frame.

    text : str of 36 characters
    returns distance [cm], speed [%], compass [degree], path [counts], angle [counts]; or None
    """
    ### BEGIN SOLUTION
    data = bytes.fromhex(text[1:-1])
    if sum(data) % 256:
        return None
    distance, speed, compass, path, angle = (data[k] for k in (2, 7, 13, 14, 15))
    speed, path, angle = (byte - 256 if byte > 127 else byte for byte in (speed, path, angle))
    return distance, speed, 2 * compass, path, angle
    ### END SOLUTION


# %%
check("14-status")

# %% [markdown]
# ## 5 · A counter that overflows
#
# The path counter is a signed byte: after 127 comes −128. It is read often enough: between two
# readings the robot goes fewer than 128 counts, ahead or back. How far is it, at each reading, from
# where it was at the first?


# %% name="unwrap"
def unwrap(values):
    """Counts since the first reading.

    values : (n,) signed bytes, −128 to 127;  returns (n,), the first is 0
    """
    ### BEGIN SOLUTION
    steps = (np.diff(values) + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])
    ### END SOLUTION


# %%
check("14-unwrap")

# %% [markdown]
# An emulated eMIR drives along a corridor, ahead at 40 cm/s and then back at 20 cm/s, by your
# `command`, read by your `status`. **Before you run it:** what will the raw counter look like?


# %% name="corridor"
@attempt
def _():
    from slamlab.devices.emir.commands import info
    from slamlab.devices.emulator.robot_body import RobotBody
    from slamlab.devices.emulator.emir_emulator import EmirEmulator

    emir = EmirEmulator(RobotBody(worlds.corridor(), np.random.default_rng(1)))
    emir.feed(info(True), 0.0)
    said = []
    for begin, speed, seconds in ((0, 100, 10), (10, -50, 10)):
        emir.feed(command(speed, 0).encode(), begin)
        said += [emir.feed(b"", begin + 0.1 * k) for k in range(1, 10 * seconds + 1)]
    frames = [text.decode() for text in said if len(text) == 36]
    path = np.array([status(frame)[3] for frame in frames])
    counts = {"as sent": path, "unwrapped": unwrap(path)}
    time = 0.1 * np.arange(len(path))
    fig, _ = views.curves(time, counts, "t [s]", "path [counts]", "ahead, then back")
    views.show(fig, alt="A saw-tooth between −128 and 127, and the way that rises and then falls.")


# %% [markdown]
# The saw-tooth is what the robot sends, the other line is where it was. One count is about 1 cm: it
# went some 4 m ahead and half of that back.
#
# **Next:** the points are where they belong, the way is known as well as wheels know it. Lesson 13
# matched such scans, lesson 15 makes a map of them that closes.
