# %% [markdown] slideshow={"slide_type": "slide"}
# # 01 · Why SLAM
#
# **Afterwards you will be able to** say why a robot that only counts wheel turns cannot draw a map,
# foretell how fast its error grows, and tell what SLAM adds.
#
# 40 min. You need [00 · Start here](00_start_here.ipynb) before.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* one idea carries this hour: *a map is as good as the poses it is drawn from*.
# Have everybody write down a number for the gap before you run it; most say centimetres. If time is
# short, leave out the section on growth: the exercise does it again.

# %% name="imports"
from itertools import accumulate

import numpy as np

from slamlab import estimators, sources, views
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.estimators import run

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A robot that counts the turns of its wheels
#
# A robot drives one lap through a corridor, 2 m wide, round a rectangular block. It has two wheels
# with encoders and a lidar. Every half second it takes a *reading*: how far the wheels say it went
# since the last one, as seen from where it was then (its **odometry**), and one turn of the lidar
# (its **scan**).

# %% name="one-reading"
robot = sources.open("sim:corridor", np.random.default_rng(3))
readings = list(robot)
forward, left, turn = readings[100].odometry
print(f"{len(readings)} readings; number 100 says:")
print(f"  {100 * forward:.1f} cm ahead, {100 * left:.1f} cm left, turned {np.degrees(turn):.2f}°")
print(f"  {readings[100].scan.valid.sum()} of {len(readings[100].scan.ranges)} beams came back")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Dead reckoning
#
# Chain the steps: each begins where the one before ended (a ⊕ b in the
# [notation](00_start_here.ipynb)). Sailors call that dead reckoning.
#
# The wheels of this robot differ by 0.3 %, the distance between them is misjudged by 1 %, and they
# slip a little: a good robot. The lap is 42 m long and ends exactly where it began.
#
# **Predict:** by how much will dead reckoning miss the start? (a) about 10 cm, (b) about half a
# metre, (c) more than 2 m. Write it down.


# %% name="dead-reckoning" tags=["nbval-check-output"]
def chain(steps):
    """All poses of a drive that begins at the origin: (n, 3) relative steps to (n + 1, 3)."""
    return np.array(list(accumulate(steps, compose, initial=np.zeros(3))))


truth = robot.truth.poses
naive = chain([reading.odometry for reading in readings[1:]])
gap = between(truth[-1], naive[-1])
print(f"misses by {np.hypot(*gap[:2]):.1f} m and {round(np.degrees(gap[2]))}°")

# %% name="dead-reckoning-picture"
fig, ax = views.axes("One lap of the corridor", size=(7, 5.5))
views.draw(ax, Segments("walls", robot.world.outline()))
views.draw(ax, Poses("truth", truth))
views.draw(ax, Poses("naive", naive), label="odometry")
views.legend(ax, loc="center")
views.show(fig, alt="The true lap closes; the odometry's turns away and ends off the corridor.")

# %% [markdown]
# The true lap (black) closes. The odometry's lap leans over more and more from the first side on,
# cuts through walls and ends metres away. Three tenths of a per cent of 42 m would be 13 cm. The
# gap is thirty times as large: what hurts is not the length of the steps but their **direction**.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A map is as good as its poses
#
# The scans themselves are good: at 4 m a lidar of this kind errs by a centimetre. A map is all
# scans laid on the table, each turned and moved to the pose it was taken from.
#
# **Predict:** the same scans are laid out twice, from the true poses and from the odometry's. What
# will the wall look like at the lower left, which the robot saw when it set out **and** when it
# came back?


# %% name="two-maps"
def map_from(poses, readings):
    """The points (n, 2) of all scans, each placed at the pose it was taken from."""
    pairs = zip(poses, readings, strict=True)
    return np.vstack([transform(pose, reading.scan.points()) for pose, reading in pairs])


fig, _ = views.side_by_side(
    {
        "from the true poses": [Points("map", map_from(truth, readings))],
        "from the odometry": [Points("naive", map_from(naive, readings))],
    }
)
views.show(fig, alt="Left a sharp rectangular corridor; right the same scans, smeared.")

# %% [markdown]
# Left, 231 scans fall on the same walls. Right, every wall that was seen for long is a smear, and
# at the lower left there are two corridors where there is one: **the ends do not meet**. A robot
# that trusted this map would look for a door where there is a wall.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## How good must the wheels be?
#
# Take perfect odometry and spoil it on purpose: with every metre the heading drifts a little,
# always to the same side, as with a worn tyre. The slider sets how much.
#
# **Predict:** the corridor is 2 m wide. At how many degrees a metre does the lap end outside it,
# beyond a wall?

# %% name="drift-slider"
perfect = between(truth[:-1], truth[1:])
sparse = slice(None, None, 3)


def smear(degrees_per_metre):
    """The map of a robot whose heading drifts."""
    steps = perfect.copy()
    steps[:, 2] += np.radians(degrees_per_metre) * np.hypot(steps[:, 0], steps[:, 1])
    poses = chain(steps)
    layers = [Points("map", map_from(poses[sparse], readings[sparse])), Poses("naive", poses)]
    miss = np.hypot(*(poses[-1] - truth[-1])[:2])
    title = f"{degrees_per_metre:.2f}° a metre: misses by {miss:.2f} m"
    return views.side_by_side({title: layers}, size=(7, 5.5))[0]


views.explore(
    smear,
    alt="With a third of a degree a metre the corridor's ends miss each other by over a metre.",
    degrees_per_metre=(-1.0, 1.0, 0.3),
)

# %% [markdown]
# A third of a degree a metre, and the lap ends beyond the wall: the corridor is torn open. Move the
# slider to zero: it closes. To come home within 10 cm the drift must stay below about 0.02° a
# metre; nobody builds such wheels, and a carpet would undo them. Better wheels only move the day of
# reckoning: drive two laps, and you are where you were.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## How errors grow
#
# A constant drift could be calibrated away. Chance cannot. Let 2000 robots drive straight ahead in
# steps of half a metre. Each step is wrong at random in one of two ways:
#
# - **length:** by 2 % of the step (1 cm), or
# - **heading:** after each step the robot looks 1° aside, a random way (and keeps looking there).
#
# **Predict:** they drive 5 m, then 20 m, four times as far. By which factor does the error along
# the way grow in the first case? By which factor does the error across it grow in the second?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* let them vote: 2, 4, 8 or 16. The reasoning comes after the numbers.


# %% name="spread" tags=["nbval-check-output"]
def spread(way, length_error, heading_error, rng, robots=2000, step=0.5):
    """Error along and across a straight way [m], one standard deviation over many robots."""
    n = round(way / step)
    lengths = step * (1 + length_error * rng.standard_normal((robots, n)))
    errors = heading_error * rng.standard_normal((robots, n))
    headings = np.cumsum(errors, axis=1) - errors  # a step is driven before its error is made
    along, across = lengths * np.cos(headings), lengths * np.sin(headings)
    return along.sum(axis=1).std(), across.sum(axis=1).std()


rng = np.random.default_rng(2)
for way in (5, 20, 80):
    along, _ = spread(way, 0.02, 0.0, rng)
    _, across = spread(way, 0.0, np.radians(1), rng)
    print(f"{way:3d} m   length: {100 * along:4.0f} cm   heading: {100 * across:5.0f} cm")

# %% [markdown] slideshow={"slide_type": "subslide"}
# Four times the way: the error of **length** doubles. Independent errors partly cancel; their
# *variances* add, so n steps give √n times the error of one.
#
# The error of **heading** grows eightfold. A heading error made early bends every step that
# follows: the k-th error before the end leads k steps astray. The variance is a sum of k² over all
# steps, which grows as n³: the error grows as n·√n. **Predict** the slopes of both lines on doubly
# logarithmic paper before you run the next cell.

# %% name="growth"
ways = np.array([2.5, 5, 10, 20, 40, 80])
length = [spread(way, 0.02, 0.0, rng)[0] for way in ways]
heading = [spread(way, 0.0, np.radians(1), rng)[1] for way in ways]
fig, _ = views.growth(
    ways,
    {"length error 2 %": length, "heading error 1°": heading},
    {
        "predicted: √n": length[0] * (ways / ways[0]) ** 0.5,
        "predicted: n √n": heading[1] * (ways / ways[1]) ** 1.5,
    },
    "way driven [m]",
    "error [m]",
    "Error of 2000 robots",
)
slow, fast = (np.polyfit(np.log(ways), np.log(errors), 1)[0] for errors in (length, heading))
views.show(fig, f"Length errors rise with slope {slow:.1f} on the axes, heading's with {fast:.1f}.")

# %% [markdown]
# The marks follow the lines: slope ½ for length, 1½ for heading. At 5 m both errors seem bearable;
# at 80 m the heading error is eighty times the other. **Whatever is only added up runs away.** In
# the [exercise](../exercises/ex01_why_slam.ipynb) you work out the formula and hold it against
# robots.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A first look at the cure
#
# The odometry says how the robot moved, and so do the scans: between two readings the walls stood
# still, so whatever shift lays the new scan over the old one **is** the motion. An *estimator*
# named `icp` does that: it starts from the odometry's guess and corrects it until the walls match
# (lesson [13](13_scan_matching.ipynb) takes it to pieces). It reads the very same readings.
#
# **Predict:** will the ends meet now? Exactly?

# %% name="cure"
matched = run(robot, estimators.make("icp", robot))
corrected = matched.trajectory.poses
for name, poses in {"odometry": naive, "icp": corrected}.items():
    ahead, left, turn = between(truth[-1], poses[-1])
    print(f"{name:8}  misses by {100 * np.hypot(ahead, left):5.1f} cm and {np.degrees(turn):5.1f}°")

# %% name="cure-picture"
fig, _ = views.side_by_side(
    {
        "odometry alone": [Points("naive", map_from(naive, readings))],
        "odometry and scans": [Points("corrected", map_from(corrected, readings))],
    }
)
views.show(fig, alt="Left the smeared corridor; right the matched one, sharp, all but closed.")

# %% [markdown]
# Same robot, same wheels, same scans. On the right the walls are sharp and the ends meet, to within
# a hand's breadth or two. Not exactly: each match errs by a millimetre or two and some hundredths
# of a degree, and what is only added up runs away, if more slowly. Try other seeds in the second
# cell of the lesson (run all cells again): the odometry misses by metres each time, the matcher by
# centimetres.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The same on a real robot
#
# A simulator shows what its author believes. So take a log that made history: a robot that drove
# for 44 minutes through the Intel Research Lab in Seattle, 910 scans of 180 beams, with the
# odometry its wheels gave (recorded by Dirk Hähnel). Only the source changes; the estimator is the
# same, its settings too.
#
# **Predict:** the robot drives several laps through the same corridors. What will odometry make of
# them?
#
# The log is not part of the course: it is not ours to give away. Where it is missing, the next cell
# says what to do and goes on with a simulated log.

# %% name="intel"
try:
    log, name = sources.open(sources.recording("intel")), "Intel Research Lab"
except sources.SourceError as missing:
    print(f"{missing}\n\nGoing on with a SIMULATED log instead: a tour of a room.")
    log, name = sources.open("sim:room", np.random.default_rng(4)), "SIMULATED room"

seen = list(log)
real = run(log, estimators.make("icp", log))
minutes = np.ptp(real.trajectory.times) / 60
print(f"{name}: {real.frames} readings in {minutes:.1f} min")

# %% name="intel-picture"
wheels, scans = map_from(real.naive.poses, seen), map_from(real.trajectory.poses, seen)
fig, _ = views.side_by_side(
    {
        f"{name}: odometry alone": [Points("naive", wheels)],
        f"{name}: odometry and scans": [Points("corrected", scans[::2])],
    },
    size=(11, 5.5),
    shared=False,
)
long, across = (np.ptp(points, axis=0).max() for points in (wheels, scans))
views.show(
    fig, f"Left a tangle {long:.0f} m long; right rooms round a ring, {across:.0f} m across."
)

# %% [markdown]
# From the real log, and mind the scales: the left map is twice as large as the right one. From the
# wheels alone the laps lie over each other, turned, until nothing can be made out, and then a whole
# wing of the building runs away. On the right, from the same file, stands a building, 30 m across:
# a ring of corridors with rooms on both sides.
#
# Look closely, though: many walls stand twice, side by side or crossing. The robot came back after
# a long way, and the matcher, which compares a scan with the one before it, **does not know that it
# has been here before**. Recognising a place and mending the past is called closing the loop.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What SLAM is
#
# - To place a scan, the robot needs its **pose**.
# - To correct its pose, it needs a **map**.
# - It has neither. Both must be estimated from the same readings, at the same time:
#   *simultaneous localisation and mapping*.
#
# And it must know **how sure it is**: a wall seen from a doubtful pose is a doubtful wall, and when
# one wall is seen again, all that were drawn on the way there move with it. The lessons that follow
# put that into equations.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* ask at the end which of the pictures on the right they would trust, and where
# not. The double walls of the Intel map are the hook for loop closure; keep them on the projector.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What comes next
#
# Now draw such maps with your own functions: [exercise 01](../exercises/ex01_why_slam.ipynb), 60 min.
#
# After that, [04 · Models and Jacobians](04_models_and_jacobians.ipynb) writes motion and
# observation as functions and derives how errors pass through them; [13 · Scan
# matching](13_scan_matching.ipynb) opens the box called `icp`.
