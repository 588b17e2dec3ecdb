# %% [markdown]
# # Exercise 14 · Devices and live SLAM: RPLIDAR and eMIR
#
# **You will be able to** decode the bytes of two lidars, one of them only from its data sheet; deskew a scan that was
# measured while the robot moved; unwrap a counter that overflows; and write test cases that detect the faults of
# drivers whose code you cannot see.
#
# **60 minutes. Before:** lesson [14 · Devices and live SLAM: RPLIDAR and eMIR](../notebooks/14_devices_and_live_slam.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below it, as often
# as you like. A check calls your function with random inputs and with special cases that the text allows. If your
# answer breaks a law, the check shows a small input that breaks it. `hint("14-nodes")` in a cell of your own asks a
# guiding question. A function must not change the arrays that it is given.

# %%
import numpy as np

from classroom.checks import ask, attempt, check
from slamlab import views
from slamlab.layers import Points, Segments
from slamlab.simulation import worlds

# %% [markdown]
# ## 1 · Decode measurement nodes
#
# After the request SCAN, an RPLIDAR sends **measurement nodes** of five bytes until it is stopped:
#
# | byte | bits | meaning |
# | --- | --- | --- |
# | 0 | 0 | S: a revolution of the lidar begins here |
# | | 1 | the complement of S |
# | | 2–7 | quality, 0 to 63 |
# | 1, 2 | 0 | C, always 1 |
# | | 1–15 | angle [1/64 degree] |
# | 3, 4 | 0–15 | distance [1/4 mm], 0 if there was no echo |
#
# The low byte of a number of two bytes comes first (14.1). A node is corrupted if S equals bit 1, which should be its
# complement, or if C is 0.
#
# **Your task.** Decode all valid nodes, and leave out the corrupted ones. (No byte is lost in this task: every node
# begins where the previous one ends.)

# %%
ask(
    "ex14-half",
    "Decode this node with pencil and paper: `3e 01 2d a0 0f`. The result is S = 0, quality 15, 90° "
    "and 1000 mm. **Which byte must change, and to what, for 90.5°?**",
    {
        "the second byte, to 21": "half a degree is 32 steps of 1/64°. But bit 0 is C, and the angle begins at bit 1.",
        "the second byte, to 41": "32 steps of 1/64° add 64 to the word, because C takes bit 0. 64 is 40 in hexadecimal digits.",
        "the third byte, to 41": "the low byte comes first, and this is the high byte.",
        "the third byte, to 2e": "adding 1 to the high byte adds 256 to the word. These are 128 steps of 1/64°, or 2°.",
    },
    right="the second byte, to 41",
)


# %% name="nodes"
def nodes(data):
    """Decode measurement nodes.

    data : bytes, five for each node, possibly empty; data[0] is an int from 0 to 255
    returns (n, 4), one row for each valid node, in the order of the bytes: S (0 or 1),
        quality, angle [degree], distance [mm]; an empty array or list without valid nodes
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
# One more function, given here, turns these rows into points of the robot frame. It applies (14.4), for a lidar whose
# angle is 0° at the robot's front and grows **clockwise**, seen from above:


# %% name="points"
def points(degrees, millimetres):
    """The (k, 2) points of a scan in the robot frame [m], without those that have no echo."""
    back = millimetres > 0
    angle, r = np.radians(-degrees[back]), millimetres[back] / 1000
    return np.column_stack([r * np.cos(angle), r * np.sin(angle)])


# %% name="received"
def received(world, seconds):
    """The nodes that an emulated lidar at the world's origin sends after SCAN, without the answer's header."""
    from slamlab.devices.emulator.motion_distortion import MovingLidar
    from slamlab.devices.emulator.emulated_robot import EmulatedRobot
    from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
    from slamlab.devices.rplidar.requests import Command, request

    rng = np.random.default_rng(1)
    lidar = RPLidarEmulator(MovingLidar(EmulatedRobot(world, rng), rng), rng=rng)
    sent = lidar.feed(request(Command.SCAN), 0.0)
    sent += b"".join(lidar.feed(b"", 0.01 * k) for k in range(1, round(100 * seconds)))
    return sent[7 : 7 + (len(sent) - 7) // 5 * 5]


# %% [markdown]
# The next cell decodes what a lidar in Tuček's polygon sends in 0.2 s. It sends about 2000 nodes a second and makes
# ten revolutions a second. How many nodes do you expect from one S to the next? With a wrong sign of the angle, the
# points would be mirrored and would not lie on the walls.


# %% name="polygon"
@attempt
def _():
    world = worlds.polygon()
    turn = nodes(received(world, 0.2))
    begin, end = np.flatnonzero(turn[:, 0])[:2]
    print(
        f"{end - begin} nodes from one S to the next, {np.sum(turn[:, 3] == 0)} nodes without an echo"
    )
    fig, ax = views.axes("the polygon, decoded by your function", size=(5, 4))
    views.draw(ax, Segments("walls", world.outline()))
    views.draw(ax, Points("scan", points(*turn[:, 2:].T)))
    views.legend(ax, loc="lower right")
    views.show(fig, alt="Points of a scan on the walls of the polygon.")


# %% [markdown]
# If the points lie on the walls, your decoder is right for this scan.

# %% [markdown]
# ## 2 · Decode the packets of another lidar
#
# For another lidar you have no example, only its data sheet. It sends **packets** of $n$ points, with $n$ from 1 to
# 255. While it measures them, it turns by less than a full revolution:
#
# | byte | meaning |
# | --- | --- |
# | 0 | 0x54, the start of a packet |
# | 1 | $n$, the number of points |
# | 2, 3 | $\psi_0$, angle of the first point [1/100 degree], 0 to 35 999 |
# | three bytes for each point | distance [mm] in two bytes, 0 if there was no echo; then signal strength |
# | the next two | $\psi_{n-1}$, angle of the last point [1/100 degree], 0 to 35 999 |
# | the last one | checksum: the sum of all bytes before it, modulo 256 |
#
# The low byte of a number of two bytes comes first, and these numbers have no sign. The lidar turns **clockwise**, and
# its angle is 0° at the robot's front. The signal strength is not needed.

# %% [markdown]
# The angles of the points are evenly spaced between the first and the last one. This is similar to (14.3), with one
# difference: the second angle of (14.3) was the first angle of the *next* capsule. Derive the new formula.
#
# A packet is corrupted if its byte 0 is not 0x54, if its length does not fit its $n$, or if its checksum is wrong.
# For a corrupted packet, return `None`, not an empty list. (No packet of the check has $n = 0$, not even a corrupted
# one.)
#
# **Your task.** Return the angle and the range of each point with an echo. The angle is in radians and
# counter-clockwise from the robot's front, as in the rest of the course, and a multiple of $2\pi$ may be added to it.
# The range is in metres. Leave out the points without an echo. They still count for the spacing of the angles.
#
# To test your formula, take a packet of four points that begins at 350° and ends at 20°, and whose second point has no
# echo. Compute the angles of the other three with pencil and paper.


# %% name="sweep"
def sweep(data):
    """Decode a packet of the other lidar.

    data : bytes, seven or more, possibly corrupted
    returns (k, 2), one row for each point with an echo, in the order of the bytes: angle [rad],
        range [m]; an empty array or list without echoes; None for a corrupted packet
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
# ## 3 · Deskew a scan
#
# A lidar needs a tenth of a second or more for a scan, and the robot drives and turns in this time. So each beam was
# measured from another pose. **Deskewing** transforms all points into one frame, here that of the robot *at the time
# of the last beam*.
#
# The lidar is at the robot's origin. It turns **clockwise** with constant speed, one revolution in `period` seconds.
# It measured the first beam at the time `begin`. A scan is less than one revolution. It may begin at any bearing, and
# its beams are not evenly spaced. The first and the last beam count even if they have no return.
#
# Odometry states the pose at a few times, which begin before the scan and end after it. Between two of them, assume
# that $x$, $y$ and $\theta$ change uniformly, and that $\theta$ turns by less than π. The robot may change its speed
# from one odometry pose to the next.
#
# The bearings of three beams are −160°, 170° and 100°, in this order, and `period` is 0.1 s. At which times after
# `begin` were the last two measured? And which heading is half way between the headings 179° and −179°?
#
# **Your task.** Return the points of all beams with a return, in the order of the beams. The check accepts an error of
# $10^{-6}$, relative to the largest coordinate of the scan.
#
# | law | what must be right | points |
# | --- | --- | --- |
# | counted | the number of points (only together with other laws) | 0.5 |
# | turning | the points, if the robot turns on the spot with a constant turn rate, and the scan begins behind it | 1 |
# | driving | the points, if it drives straight ahead with a constant speed, and the scan begins behind it | 1 |
# | both | the points, if it drives, turns and changes its speed, with any first bearing and heading | 1.5 |


# %% name="deskew"
def deskew(bearings, ranges, begin, period, times, poses):
    """The points of a scan of a moving robot, in the robot frame at the time of the last beam.

    bearings : (n,) [rad], −π to π, counter-clockwise from the front, in the order of measurement
    ranges : (n,) [m], NaN for no return;  begin : time of the first beam [s];  period : [s]
    times : (k,) ascending [s], poses : (k, 3) odometry [m, m, rad], headings −π to π
    returns (m, 2) [m], one row for each beam with a return; an empty array or list without any
    """
    ### BEGIN SOLUTION
    turned = (bearings[0] - bearings) % (2 * np.pi)
    t = begin + period * turned / (2 * np.pi)
    heading = np.unwrap(poses[:, 2])
    x, y, theta = (np.interp(t, times, each) for each in (*poses[:, :2].T, heading))
    px = x + ranges * np.cos(theta + bearings)
    py = y + ranges * np.sin(theta + bearings)
    dx, dy = px - x[-1], py - y[-1]
    c, s = np.cos(theta[-1]), np.sin(theta[-1])
    points = np.column_stack([c * dx + s * dy, c * dy - s * dx])
    return points[~np.isnan(ranges)]
    ### END SOLUTION


# %%
check("14-deskew")

# %% [markdown]
# The wall to the right of this robot was measured by the first and by the last beams. Why has it a kink before
# deskewing, and why a gap after it? (The robot turns to the left, the lidar to the right.)


# %% name="moving-robot"
@attempt
def _():
    turned = np.arange(0, 2 * np.pi, np.radians(1))
    bearings = (-1.6 - turned + np.pi) % (2 * np.pi) - np.pi
    times, poses = np.array([0.0, 0.2]), np.array([[0.0, 0.0, 3.0], [0.1, 0.05, 3.3]])
    x, y, theta = (np.interp(0.1 + 0.1 * turned / 2 / np.pi, times, each) for each in poses.T)
    beams = zip(x, y, theta + bearings, strict=True)
    ranges = np.array([worlds.room().cast(np.array([a, b]), [c])[0] for a, b, c in beams])
    clouds = {
        "before": ranges[:, None] * np.column_stack([np.cos(bearings), np.sin(bearings)]),
        "deskewed": deskew(bearings, ranges, 0.1, 0.1, times, poses),
    }
    fig, _ = views.side_by_side({k: [Points("scan", v)] for k, v in clouds.items()}, size=(9, 4.6))
    views.show(fig, alt="A scan of a room; only after deskewing all walls are straight.")


# %% [markdown]
# ## 4 · Unwrap a counter
#
# The robot sends its path counter as a signed byte: after 127 it wraps around to −128. Between two readings the
# counter changes by at most 127 counts, forwards or backwards, or not at all.
#
# **Your task.** Return, for each reading, the number of counts since the first reading. It is the sum of the steps
# $\Delta_k$ up to this reading. (14.7) determines a step only implicitly, by a congruence and an interval. Here the
# value −128 of this interval does not occur. Find an expression that computes $\Delta_k$ from two readings.


# %% name="unwrap"
def unwrap(values):
    """Unwrap a counter: the counts since the first reading.

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
    "path counter is byte 14. An emulated eMIR drives along a corridor, 4 m forwards "
    "at 40 cm/s and then 2 m backwards at 20 cm/s. **How does the raw counter change over time?**",
    {
        "it rises to 127 and stays there": "a byte does not stop at its largest value. One more is −128.",
        "it rises to about 400 and falls to about 200": "the distance from the start does this. But a signed byte ends at 127.",
        "a sawtooth: it rises and jumps down, and later it falls and jumps up": "after 127 comes −128. On the way back, 127 comes after −128.",
        "a sawtooth that only rises and jumps down": "the counter is signed, and it decreases when the robot drives backwards.",
    },
    right="a sawtooth: it rises and jumps down, and later it falls and jumps up",
)


# %% name="corridor" answers="ex14-raw"
@attempt
def _():
    from slamlab.devices.emir.commands import info, move
    from slamlab.devices.emulator.emir_emulator import EmirEmulator
    from slamlab.devices.emulator.emulated_robot import EmulatedRobot

    emir = EmirEmulator(EmulatedRobot(worlds.corridor(), np.random.default_rng(1)))
    emir.feed(info(True), 0.0)
    replies = []
    for begin, speed, seconds in ((0, 100, 10), (10, -50, 10)):
        emir.feed(move(speed, 0), begin)
        replies += [emir.feed(b"", begin + 0.1 * k) for k in range(1, 10 * seconds + 1)]
    bytes_14 = [int(text[29:31], 16) for text in replies if len(text) == 36]
    path = np.array([byte - 256 if byte > 127 else byte for byte in bytes_14])
    counts = {"unwrapped": unwrap(path), "as sent": path}
    time = 0.1 * np.arange(len(path))
    fig, _ = views.curves(time, counts, "t [s]", "path [counts]", "forwards, then backwards")
    between = f"A sawtooth between {path.min()} and {path.max()}"
    views.show(fig, alt=f"{between}, and the unwrapped count, which rises and then falls.")


# %% [markdown] answers="ex14-raw"
# The sawtooth is the counter as the robot sends it. The other line is the distance from the start. One count is about
# 1 cm, so the robot drove about 4 m forwards and about 2 m backwards.

# %% [markdown]
# ## 5 · Test cases for drivers
#
# The check has tested your `unwrap`. Most drivers are written by others and come without such a check, and often
# you cannot see their code. You can only call a driver with readings and compare its result with the correct one.
# Which readings should you choose? A drive forwards and backwards, as above, detects less than a third of the faulty
# drivers below.
#
# A **correct driver** has this specification:
#
# - its argument is a sequence of readings (signed bytes). It returns the counts since the first reading, one for each
#   reading, as your `unwrap` does;
# - a sequence may have any number of readings. It may have one or none. Without readings, the driver returns no
#   counts (your `unwrap` need not handle this case);
# - the first reading may be any byte;
# - between two readings the counter changes by at most 127 counts, forwards or backwards, or not at all;
# - there is no limit to the total count, because a robot may drive all day;
# - the same driver is called with one sequence after the other, and the counts of each sequence start at 0.

# %% [markdown]
# **Your task.** Write `trials`. It returns test cases: sequences of readings, each with the counts that a correct
# driver returns. A test case is a pair `(values, counts)` of arrays or lists of the same length. For a sequence
# without readings this is the pair `([], [])`. One hundred faulty drivers, each with one fault, are called with your
# sequences in their order. A driver is detected if, for at least one sequence, its counts differ from yours or it
# raises an exception. A correct driver must pass all test cases. All your sequences together may have **at most 1000
# readings, and there may be at most 20 sequences**: a robot sends ten readings a second, so 1000 readings take 100
# s.
#
# The faults are typical programming errors: a limit that is off by one, a forgotten direction, a special case that
# was not considered, a total too large for its variable, a value that should have been reset. Each line of the
# specification is violated by at least one driver. Some drivers are wrong for a single byte or a single step only. Any
# method is allowed. If all your test cases keep to the specification and their counts are right, each row of the table
# that you reach adds its points:
#
# | detected drivers, of 100 | points |
# | --- | --- |
# | at least 40 | 1 |
# | at least 70 | 2 |
# | at least 88 | 2 |
# | at least 97 | 2 |
#
# As in every task, a function that leaves its arguments unchanged gets 0.5 points. `trials` has no arguments, so you get
# these points with the first row. In all, these are the 7.5 points of the task.
#
# This function makes a sequence from its steps:


# %% name="sequence"
def sequence(begin, steps):
    """The readings and the counts of a sequence that starts at the byte begin and has these steps."""
    counts = np.concatenate([[0], np.cumsum(np.array(steps, dtype=int))])
    return (begin + counts + 128) % 256 - 128, counts


# %%
ask(
    "ex14-found",
    "The next cell has three faulty drivers and two sequences. **How many of the three drivers do the "
    "two sequences detect together?**",
    {
        "none": "one driver does not correct overflows at all, and 300 counts do not fit into a byte.",
        "one": "the sequence forwards detects one. The sequence backwards detects this one and another.",
        "two": "both detect the driver without correction. The sequence backwards also detects the one that loses the sign.",
        "all three": "the third one fails only for more than a hundred readings. Each of the two sequences has seven.",
    },
    right="two",
)


# %% name="three-drivers" answers="ex14-found"
@attempt
def _():
    drivers = {
        "no correction": lambda values: values - values[0],
        "sign lost": lambda values: np.abs(unwrap(values)),
        "short memory": lambda values: unwrap(values)[-100:],
    }
    for name, (values, counts) in {
        "forwards": sequence(0, [50] * 6),
        "backwards": sequence(0, [-50] * 6),
    }.items():
        found = [driver for driver, f in drivers.items() if not np.array_equal(f(values), counts)]
        print(f"{name:>9} detects:", ", ".join(found))


# %% [markdown] answers="ex14-found"
# The sequence forwards detects one driver, and the sequence backwards detects two. No sequence of seven readings can
# detect the third one.


# %% name="trials"
def trials():
    """Test cases that detect faulty drivers and that correct drivers pass.

    returns a list of pairs (values, counts), each (n,): the readings that a driver gets, and the
        counts that it must return
    """
    ### BEGIN SOLUTION
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()  # each step once, ahead and back by turns
    return [
        ([], []),
        sequence(7, []),
        sequence(5, [0, *every]),
        sequence(3, [127] * 270),
        sequence(3, [-127] * 270),
    ]
    ### END SOLUTION


# %%
check("14-trials")

# %% [markdown]
# Which of your sequences detects most? Guess first. Then leave out one sequence at a time and run the check again.
#
# ## Done?
#
# Save the notebook. The cell below shows the points that the grader will give. The grader uses other random inputs.
#
# **Next:** you can turn bytes into points and distances, and you know what test cases can detect.
# [Lesson 13](../notebooks/13_scan_matching.ipynb) matched such scans, and
# [lesson 15 · Pose-graph SLAM: closing the loop](../notebooks/15_pose_graph_slam.ipynb) estimates
# a globally consistent map from them.
