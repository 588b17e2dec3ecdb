# %% [markdown]
# # Exercise 14 · The eMIR system
#
# **You will be able to** read a lidar's bytes, and those of a lidar that nobody has shown you; send a robot
# commands that it does not drop; add up how far it went although its counter overflows; and choose trials that
# find the faults of programs that you have not written.
#
# **60 minutes. Before:** lesson [14 · The eMIR system](../notebooks/14_the_emir_system.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below it, as often
# as you like. A check sends bytes that nobody has seen before. Where a law is broken it shows a small input that
# breaks it, and `hint("14-nodes")` in a cell of your own leads on. No function may change the arrays that it is
# given, because whoever called it still needs them.

# %%
import numpy as np

from slamlab import views, worlds
from slamlab.checks import ask, attempt, check
from slamlab.layers import Points, Segments

# %% [markdown]
# ## 1 · A lidar's bytes
#
# After SCAN an RPLIDAR sends **nodes** of five bytes without end:
#
# | byte | bits | meaning |
# | --- | --- | --- |
# | 0 | 0 | S, a turn begins here |
# | | 1 | the contrary of S |
# | | 2–7 | quality, 0 to 63 |
# | 1, 2 | 0 | C, always 1 |
# | | 1–15 | angle [1/64 degree] |
# | 3, 4 | 0–15 | distance [1/4 mm], 0 where nothing came back |
#
# Numbers of two bytes send the low byte first, as (14.1) says. Some nodes are damaged: S and its contrary are the
# same, or C is
# 0. Leave those out, and no others. (No byte is lost here: every node begins where the one before it ended.)

# %%
ask(
    "ex14-half",
    "Read this node with pencil and paper: `3e 01 2d a0 0f`. You should find S = 0, quality 15, 90° "
    "and 1000 mm. **Which byte must change, and to what, for 90.5°?**",
    {
        "the second byte, to 21": "half a degree is 32 steps of 1/64°, but bit 0 is C: the angle begins one bit higher.",
        "the second byte, to 41": "32 steps of 1/64°, shifted by the one bit of C, are 64, or 40 in hexadecimal digits.",
        "the third byte, to 41": "the low byte comes first.",
        "the third byte, to 2e": "one more in the high byte is 256, so 128 steps of 1/64°, or 2°.",
    },
    right="the second byte, to 41",
)


# %% name="nodes"
def nodes(data):
    """The nodes in a packet of bytes.

    data : bytes, five for each node, perhaps none; data[0] is a number from 0 to 255
    returns (n, 4), one row for each good node, in their order: S (0 or 1), quality,
        angle [degree], distance [mm]; an empty array or list where there is none
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
# One more function turns these rows into a map. Here it is, for a lidar that counts its degrees **clockwise**,
# seen from above, and whose 0° is the robot's front. It is (14.4):


# %% name="points"
def points(degrees, millimetres):
    """(k, 2) points of a turn in the robot's frame [m], without those that did not come back."""
    back = millimetres > 0
    angle, r = np.radians(-degrees[back]), millimetres[back] / 1000
    return np.column_stack([r * np.cos(angle), r * np.sin(angle)])


# %% name="heard"
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


# %% [markdown]
# A lidar in Tuček's polygon sends for two tenths of a second. It sends about 2000 nodes a second and makes ten
# turns a second, so you know how many nodes to expect. If the map were mirrored, its points would lie beside the
# walls.


# %% name="polygon"
@attempt
def _():
    world = worlds.polygon()
    turn = nodes(heard(world, 0.2))
    begin, end = np.flatnonzero(turn[:, 0])[:2]
    print(f"{end - begin} nodes from one S to the next, {np.sum(turn[:, 3] == 0)} came back empty")
    fig, ax = views.axes("the polygon by your decoder", size=(5, 4))
    views.draw(ax, Segments("walls", world.outline()))
    views.draw(ax, Points("scan", points(*turn[:, 2:].T)))
    views.legend(ax, loc="lower right")
    views.show(fig, alt="Points of a scan on the walls of the polygon.")


# %% [markdown]
# If the points lie on the walls, your decoder has turned bytes into a map.

# %% [markdown]
# ## 2 · A lidar that the lesson has not seen
#
# For another lidar you have no example, only what its maker's data sheet says. It sends **packets**
# of $n$ points, with $n$ from 1 to 255. While it takes them it turns on, by less than a full turn:
#
# | byte | meaning |
# | --- | --- |
# | 0 | 0x54, here a packet begins |
# | 1 | $n$, how many points it holds |
# | 2, 3 | $\psi_0$, angle of the first point [1/100 degree], 0 to 35 999 |
# | then three for each point | distance [mm] in two bytes, 0 where nothing came back; strength |
# | two more | $\psi_{n-1}$, angle of the last point [1/100 degree], 0 to 35 999 |
# | the last one | sum of all bytes before it, modulo 256 |
#
# Numbers of two bytes send the low byte first and have no sign. The lidar turns **clockwise**, and its 0° is the
# robot's front. The strength is of no interest here.

# %% [markdown]
# The points lie evenly between the first and the last. That is almost the lesson's (14.3), but only almost: there
# the second angle was that of the *next* capsule. Derive the new formula.
#
# A packet is damaged if its first byte is another one, if it is longer or shorter than its $n$ asks for, or if
# its sum is wrong. For such a packet return `None`, and not an empty list.
#
# The rest of the course wants **rays** of a scan: an angle counter-clockwise from the robot's front, in radians
# (a full turn more or less does not matter), and a range in metres. Leave out the points that did not come back.
# But do not forget that they were there.
#
# To try your formula, take a packet of four points that begins at 350° and ends at 20°, and whose second point
# did not come back. Work out the angles of the other three with pencil and paper.


# %% name="sweep"
def sweep(data):
    """The rays in a packet of the other lidar.

    data : bytes, seven or more, perhaps damaged
    returns (k, 2), one row for each point that came back, in their order: angle [rad], range [m];
        an empty array or list where none did; None where the packet is damaged
    """
    ### BEGIN SOLUTION
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (last - first) % 36000 / max(n - 1, 1)
    found = []
    for k in range(n):
        low, high, _ = data[4 + 3 * k : 7 + 3 * k]
        if low or high:
            found.append([-np.radians((first + k * step) / 100), (low | high << 8) / 1000])
    return found
    ### END SOLUTION


# %%
check("14-sweep")

# %% [markdown]
# ## 3 · A command
#
# eMIR hears frames of text, `#OOVVTTCC/`: four bytes as two hexadecimal digits each. To drive, the opcode OO is
# 01. VV is the speed and TT the turn, in percent. A joystick may send any whole number, so cut it off at ±100. A
# negative number goes as its two's complement, −50 as 256 − 50. The checksum CC makes all four bytes add up to 0
# modulo 256, as in (14.6).
#
# Work out the checksum of a speed of −40 and a turn of 39 with pencil and paper, and also that of a speed and a
# turn of −1. Does the rule "256 less the other three bytes" give it?


# %% name="command"
def command(speed, turn):
    """The frame that makes eMIR drive.

    speed, turn : int, any whole numbers [%];  returns str, such as "#013200CD/"
    """
    ### BEGIN SOLUTION
    data = [1] + [max(-100, min(100, each)) % 256 for each in (speed, turn)]
    return "#" + "".join(f"{byte:02X}" for byte in [*data, -sum(data) % 256]) + "/"
    ### END SOLUTION


# %%
check("14-command")

# %% [markdown]
# Does the robot understand you? Its own framer judges all 40 401 commands. (A printed driver, in the lesson's
# last sections, gets about half of them through.)


# %% name="all-commands"
@attempt
def _():
    from slamlab.devices.emir.frames import COMMAND, Framer
    from slamlab.displays import grouped

    every = range(-100, 101)
    sent = "".join(command(speed, turn) for speed in every for turn in every)
    understood = Framer(COMMAND).feed(sent.encode())
    print(grouped(len(understood)), "of 40 401 commands are understood")


# %% [markdown]
# ## 4 · A counter that overflows
#
# The robot answers with its path counter, a signed byte: after 127 comes −128. It is read often enough. Between
# two readings the robot goes at most 127 counts, ahead or back, or none. How far is it, at each reading, from
# where it was at the first? The steps are those of (14.7), and you have to find a way to compute them.


# %% name="unwrap"
def unwrap(values):
    """Counts since the first reading.

    values : (n,) signed bytes, −128 to 127, n at least 1;  returns (n,), the first is 0
    """
    ### BEGIN SOLUTION
    steps = (np.diff(values) + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])
    ### END SOLUTION


# %%
check("14-unwrap")

# %%
ask(
    "ex14-raw",
    "Ten times a second eMIR sends a status: a `*`, 17 bytes as hexadecimal digits, and a `/`. The "
    "path counter is byte 14. An emulated eMIR drives along a corridor by your `command`, 4 m ahead "
    "at 40 cm/s and then 2 m back at 20 cm/s. **What does the raw counter look like over time?**",
    {
        "it rises to 127 and stays there": "a byte does not stop at its largest value. One more is −128.",
        "it rises to about 400 and falls to about 200": "so does the way. But a byte ends at 127.",
        "a saw-tooth: it rises, jumps down, rises again, and on the way back it falls and jumps up": "every time it passes 127 it goes on at −128, and the other way round.",
        "a saw-tooth that only rises: a counter counts": "it is signed, and counts down when the robot backs.",
    },
    right="a saw-tooth: it rises, jumps down, rises again, and on the way back it falls and jumps up",
)


# %% name="corridor" answers="ex14-raw"
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
    bytes_14 = [int(text[29:31], 16) for text in said if len(text) == 36]
    path = np.array([byte - 256 if byte > 127 else byte for byte in bytes_14])
    counts = {"unwrapped": unwrap(path), "as sent": path}
    time = 0.1 * np.arange(len(path))
    fig, _ = views.curves(time, counts, "t [s]", "path [counts]", "ahead, then back")
    between = f"A saw-tooth between {path.min()} and {path.max()}"
    views.show(fig, alt=f"{between}, and the way that rises and then falls.")


# %% [markdown] answers="ex14-raw"
# The saw-tooth is what the robot sends, and the other line is where it was. One count is about 1 cm, so it went
# some 4 m ahead and half of that back.

# %% [markdown]
# ## 5 · Drivers that others wrote
#
# A check has told you that your `unwrap` is right. Most drivers are written by others and come
# without a check. You do not see their code. All you can do is to hand such a driver readings and
# to compare what it returns with what it should return. But which readings? A drive ahead and back,
# as above, finds no more than a third of what can be wrong.
#
# This is what a **right driver** promises:
#
# - it takes a way, the readings of a counter (signed bytes), and returns for each reading the counts since the
#   first one, as your `unwrap` does;
# - a way may have any number of readings, one, or none at all, and then nothing comes back;
# - it may begin at any byte;
# - between two readings there are at most 127 counts, ahead or back, or none;
# - it may be as long as it likes, for a robot drives all day;
# - the same driver is called with one way after the other, and each way begins anew.

# %% [markdown]
# Write `trials`: ways, each with the counts that a right driver returns. One hundred faulty drivers, each with
# one fault, are called with your ways in their order. A driver is found if, for at least one way, it returns
# something else than you expect, or fails. Right drivers must pass. In all your ways together there may be **1000
# readings at most, and 20 ways at most**: a robot sends ten readings a second, and nobody wants to wait longer.
#
# The faults are those that programmers make: an edge off by one, one side forgotten, a case that "cannot happen",
# a number too large for its variable, something kept that should be forgotten. Each promise above is one that
# somebody has broken. Any method is allowed. You earn points when 40, 70, 88 and 97 of the hundred are found.
#
# This makes a way of its steps:


# %% name="way"
def way(begin, steps):
    """A way from a byte on, by its steps: the values of its readings, and the counts."""
    counts = np.concatenate([[0], np.cumsum(np.array(steps, dtype=int))])
    return (begin + counts + 128) % 256 - 128, counts


# %%
ask(
    "ex14-found",
    "The next cell has three such drivers and two ways. **How many of the three drivers do the two "
    "ways find together?**",
    {
        "none": "one of them mends nothing at all, and 300 counts do not fit into a byte.",
        "one": "the way ahead finds one. The way back finds that one and another.",
        "two": "the one that mends nothing, and on the way back also the one that forgets the sign.",
        "all three": "the third one remembers the last hundred readings. Neither way has as many.",
    },
    right="two",
)


# %% name="three-drivers" answers="ex14-found"
@attempt
def _():
    drivers = {
        "nothing mended": lambda values: values - values[0],
        "size of the way": lambda values: np.abs(unwrap(values)),
        "short memory": lambda values: unwrap(values)[-100:],
    }
    for name, (values, counts) in {"ahead": way(0, [50] * 6), "back": way(0, [-50] * 6)}.items():
        found = [driver for driver, f in drivers.items() if not np.array_equal(f(values), counts)]
        print(f"{name:>5} finds:", ", ".join(found))


# %% [markdown] answers="ex14-found"
# The way ahead finds one driver, the way back finds two, and no way of seven readings will ever find the third.


# %% name="trials"
def trials():
    """Ways that tell wrong drivers from right ones.

    returns a list of pairs (values, counts), each (n,): the bytes that a driver is handed, and the
        counts that it must return
    """
    ### BEGIN SOLUTION
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()  # each step once, ahead and back by turns
    return [
        ([], []),
        way(7, []),
        way(5, [0, *every]),
        way(3, [127] * 270),
        way(3, [-127] * 270),
    ]
    ### END SOLUTION


# %%
check("14-trials")

# %% [markdown]
# Which of your ways is worth the most? Guess, then leave out one after the other and ask the check again.
#
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader sends other bytes.
#
# **Next:** bytes have become points and ways, and you know what trials can find.
# [Lesson 13](../notebooks/13_scan_matching.ipynb) matched such scans, and
# [lesson 15 · Closing the loop](../notebooks/15_closing_the_loop.ipynb) makes a map of them that closes.
