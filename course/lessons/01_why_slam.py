# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 01 · Why SLAM
#
# **Afterwards you will be able to** explain why a robot that only counts the turns of its wheels
# cannot draw a map, predict how fast its error grows, and say what SLAM adds.
#
# **45 minutes.** **Before:** [00 · Start here](00_start_here.ipynb); sine, cosine and the standard
# deviation, as you know them from school.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* one idea carries this lesson: a map is only as good as the poses it is drawn
# from. Poll the class on the first question before you run anything. If time is short, leave out
# "How errors grow": the exercise comes back to it.

# %% slideshow={"slide_type": "skip"} name="imports" tags=["folded"]
from itertools import accumulate

import numpy as np

from slamlab import estimators, sources, views
from slamlab.checks import ask
from slamlab.estimators import run
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.studies import intel_maps

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## A robot that counts the turns of its wheels
#
# A robot drives one lap through a corridor, 2 m wide, round a rectangular block. It has two driven
# wheels, each with a counter (an *encoder*), and a lidar that measures the distance to the walls in
# 400 directions. The robot is simulated, so that we know where it really was.
#
# At short intervals it delivers a **reading**, which has two parts:
#
# - the **odometry**: how far the robot has moved and turned since the last reading, as its wheels
#   tell it, in the frame of the pose that it had then;
# - the **scan**: one turn of the lidar.

# %% name="one-reading" tags=["code"]
robot = sources.open("sim:corridor", np.random.default_rng(3))
readings = list(robot)
forward, left, turn = readings[100].odometry
scan = readings[100].scan
print(f"{len(readings)} readings; number 100 says:")
print(f"  {100 * forward:.1f} cm ahead, {100 * left:.1f} cm to the left")
print(f"  turned by {np.degrees(turn):.2f}°")
print(f"  {scan.valid.sum()} of {len(scan.ranges)} beams came back")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Dead reckoning
#
# Where is the robot? It can chain its steps, so that each begins where the one before ended.
# Sailors out of sight of land called this **dead reckoning**. If the robot stands at pose $a$ and
# makes a step $b$, measured in its own frame, the new pose is
#
# $$ a \oplus b = \left( \begin{pmatrix} x_a \\ y_a \end{pmatrix} + \mathrm{Rot}(\theta_a)
# \begin{pmatrix} x_b \\ y_b \end{pmatrix},\; \theta_a + \theta_b \right), \tag{01.1} $$
#
# where $\mathrm{Rot}(\theta)$ rotates a vector by the angle $\theta$: "ahead" means something else
# in the world after every turn. In the package this is `compose(a, b)`.

# %% slideshow={"slide_type": "subslide"} name="ask-gap"
ask(
    "01-gap",
    "This is a good robot: its wheels differ in size by 0.3 %, the distance between them is "
    "misjudged by 1 %, and they slip a little. The lap is 42 m long and ends exactly where it began. "
    "**By how much does dead reckoning miss the start?**",
    {
        "by about 10 cm": "this would be 0.3 % of the distance, as if only lengths were wrong.",
        "by about half a metre": "it is right to expect more than 0.3 % of the distance, but the "
        "miss is far larger than this.",
        "by more than 2 m": "wheels that differ also turn the robot, and a turn bends all that "
        "follows.",
    },
    right="by more than 2 m",
)


# %% slideshow={"slide_type": "fragment"} name="dead-reckoning" answers="01-gap" tags=["nbval-check-output"]
def chain(steps):
    """All poses of a drive that begins at the origin: (n, 3) relative steps to (n + 1, 3)."""
    return np.array(list(accumulate(steps, compose, initial=np.zeros(3))))


truth = robot.truth.poses
naive = chain([reading.odometry for reading in readings[1:]])
gap = between(truth[-1], naive[-1])
print(f"misses the start by {np.hypot(*gap[:2]):.1f} m, turned by {np.degrees(gap[2]):.0f}°")

# %% slideshow={"slide_type": "subslide"} name="dead-reckoning-picture" answers="01-gap" tags=["folded"]
fig, ax = views.axes("One lap of the corridor", size=(8, 5.6))
views.draw(ax, Segments("walls", robot.world.outline()))
views.draw(ax, Poses("truth", truth))
views.draw(ax, Poses("naive", naive), label="odometry")
views.legend(ax, loc="center")
views.show(
    fig,
    alt="The true lap closes; that of the odometry leans over from the first side on, crosses "
    f"walls and ends {np.hypot(*gap[:2]):.1f} m from its start.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-gap"
# The true lap, in black, closes. The lap of the odometry leans over more and more, cuts through
# walls and ends {= np.hypot(*gap[:2]):.1f =} m away from its start. Compare: 0.3 % of 42 m is only
# {= 100 * 0.003 * 42:.0f =} cm. The gap is {= np.hypot(*gap[:2]) / (0.003 * 42):.0f =} times as
# large, so it is not the length of the steps that does the harm. It is their **direction**.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## From unequal wheels to a wrong heading
#
# While the robot moves, its left wheel rolls a distance $s_{\mathrm{left}}$ and its
# right one $s_{\mathrm{right}}$, on two circles about one centre whose radii differ by the distance $B$
# between the wheels. The heading therefore changes by
#
# $$ \Delta\theta = \frac{s_{\mathrm{right}} - s_{\mathrm{left}}}{B}. \tag{01.2} $$
#
# If one wheel is a little larger than the robot believes, the difference is wrong, and it is divided
# by a $B$ of only 30 cm.

# %% name="ask-turn"
ask(
    "01-turn",
    "The wheels differ by 0.3 %, and they stand 0.3 m apart. **By how many degrees is the heading "
    "wrong after 42 m?** Use (01.2).",
    right=24.0,
    tolerance=1.0,
    unit="°",
    reason="0.003 · 42 m / 0.3 m is 0.42 rad, which is 24°.",
    wrong={
        0.42: "this is the angle in radians.",
        0.57: "this is what one metre does, and the robot drives 42 of them.",
        0.126: "this is the difference of the two distances in metres; divide it by B.",
        1.08: "this is 0.3 % of a full turn, but the angle depends on the distance and on B.",
    },
)

# %% slideshow={"slide_type": "fragment"} name="turn" answers="01-turn" tags=["nbval-check-output"]
turned = np.degrees(robot.robot.turn_per_metre)
print(f"{turned:.2f}° a metre make {42 * turned:.0f}° in 42 m")
print(f"in the run above the lap ended turned by {np.degrees(gap[2]):.0f}°")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-turn"
# The unequal wheels explain {= 42 * turned:.0f =} of the {= abs(np.degrees(gap[2])):.0f =} degrees;
# the misjudged distance between the wheels and their slip made the rest. An error of length is
# added once, when it is made. An error of heading **stays**, and from then on every step goes the
# wrong way.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## A map is only as good as its poses
#
# The scans are good: at 4 m this lidar errs by about
# {= 100 * np.hypot(0.001 * 4, robot.sensor.range_curvature * 4**2):.0f =} cm. To draw a map we lay
# all scans on one table, each moved and turned to the pose $x$ it was taken from. A point
# $p_{\mathrm{r}}$ of the scan, given in the robot's frame, comes to lie at
#
# $$ p = \begin{pmatrix} x \\ y \end{pmatrix} + \mathrm{Rot}(\theta)\, p_{\mathrm{r}}, \tag{01.3} $$
#
# which is the position part of (01.1). The package calls it `transform`. It trusts the pose that it
# is given.

# %% slideshow={"slide_type": "subslide"} name="ask-smear"
ask(
    "01-smear",
    "We lay the same scans out twice: from the true poses, and from those of the odometry. The robot "
    "saw the corner at the lower left when it set out **and** when it came back. **What will the "
    "second map show?**",
    {
        "one corridor with thicker walls": "this is what noise of the lidar would do; the poses are "
        "metres off.",
        "two corridors, one across the other": "each pass draws the corridor where the robot "
        "believed it was.",
        "points all over the place": "neighbouring poses agree well with each other, so each pass "
        "by itself looks tidy.",
    },
    right="two corridors, one across the other",
)


# %% slideshow={"slide_type": "fragment"} name="two-maps" answers="01-smear"
def map_from(poses, readings):
    """The points (n, 2) of all scans, each placed by its pose."""
    pairs = zip(poses, readings, strict=True)
    return np.vstack([transform(pose, reading.scan.points()) for pose, reading in pairs])


# %% slideshow={"slide_type": "fragment"} name="two-maps-picture" answers="01-smear" tags=["folded"]
fig, _ = views.side_by_side(
    {
        "from the true poses": [Points("map", map_from(truth, readings))],
        "from the odometry": [Points("naive", map_from(naive, readings))],
    }
)
views.show(
    fig,
    alt="Left a sharp rectangular corridor; right the same scans, smeared, and at the lower left a "
    "second corridor across the first.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-smear"
# Left, {= len(readings) =} scans fall on the same walls. Right, walls that were seen for a while
# are smeared, and at the lower left two corridors cross where there is one: **the ends do not
# meet**. The lidar is as good in this map as in the other. The poses are not, and a map is only as
# good as the poses it is drawn from.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## How good must the wheels be?
#
# Let us take perfect odometry and spoil it on purpose, in one of two ways:
#
# - *Ada's* robot reports every step **2 % too long**;
# - the wheels of *Ben's* robot **differ by 0.1 %**, so that by (01.2) its heading drifts a little
#   with every metre, always to the same side.

# %% slideshow={"slide_type": "subslide"} name="ask-closes"
ask(
    "01-closes",
    "**Whose lap does not close?**",
    {
        "Ada's": "all four sides come out too long by the same share, so the lap grows and closes.",
        "Ben's": "the sides keep their lengths, but each points a little further aside than the "
        "one before.",
        "both": "a lap that is larger by 2 % on all sides still ends where it began.",
        "neither": "0.1 % is little, but B is small and the drift adds up over 42 m.",
    },
    right="Ben's",
)

# %% slideshow={"slide_type": "subslide"} name="wheels-slider"
perfect = between(truth[:-1], truth[1:])
sparse = slice(None, None, 3)


def spoiled(differ, long):
    """The poses of perfect odometry, spoiled by wheels that differ and steps too long, in %."""
    way = np.hypot(perfect[:, 0], perfect[:, 1])
    drift = np.outer(way, [0, 0, differ / 100 / robot.robot.base])
    return chain(perfect * [1 + long / 100, 1 + long / 100, 1] + drift)


def missed(differ, long=0.0):
    """How far from its start a spoiled lap ends [m]."""
    return np.hypot(*(spoiled(differ, long)[-1] - truth[-1])[:2])


# %% name="wheels-needed"
tried = np.linspace(0, 0.1, 51)
needed = np.interp(0.1, [missed(differ) for differ in tried], tried)  # to come home within 10 cm


# %% name="wheels-slider-picture"
def spoiled_map(wheels_differ_by_percent, steps_too_long_by_percent):
    """The map of a robot whose odometry is spoiled."""
    poses = spoiled(wheels_differ_by_percent, steps_too_long_by_percent)
    layers = [Points("map", map_from(poses[sparse], readings[sparse])), Poses("naive", poses)]
    miss = missed(wheels_differ_by_percent, steps_too_long_by_percent)
    return views.side_by_side({f"misses its start by {miss:.2f} m": layers}, size=(8, 5.6))[0]


# %% slideshow={"slide_type": "subslide"} name="wheels-explore"
views.explore(
    spoiled_map,
    alt=f"Ben's map: the lap misses its start by {missed(0.1):.1f} m, and the corridor's ends "
    "do not meet.",
    wheels_differ_by_percent=(-0.3, 0.3, 0.1),
    steps_too_long_by_percent=(-5.0, 5.0, 0.0),
)

# %% [markdown]
# At first you see Ben's map: the lap misses its start by {= missed(0.1):.1f =} m, and the corridor
# is torn open. Move the first slider to 0 and the second to 2 and you see Ada's: it closes, though
# it is too large. To bring Ben home within 10 cm his wheels would have to agree to
# {= needed:.3f =} %. On a wheel of 10 cm this is {= 1000 * needed:.0f =} thousandths of a millimetre.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## How errors grow
#
# A constant error can be measured and corrected, which is called calibration. A random error
# cannot. Let 2000 robots drive straight ahead in steps of half a metre. Each step goes wrong at
# random, in one of two ways:
#
# - its **length** is wrong by 2 %, which is 1 cm;
# - after it, the **heading** is wrong by 1°, and the robot keeps looking there.
#
# Such numbers are standard deviations, here and in all lessons.

# %% slideshow={"slide_type": "subslide"} name="ask-growth"
ask(
    "01-growth",
    "The robots drive 5 m, and then 20 m: four times as far. Wrong lengths cause an error along "
    "the line, wrong headings an error across it. **By which factors do these errors grow?**",
    {
        "along 4, across 4": "errors would add up like this if all of them went to the same side.",
        "along 2, across 2": "right for lengths; but an early error of heading has more steps to "
        "lead astray.",
        "along 2, across 8": "variances of independent errors add, and each error of heading "
        "bends all that follows.",
        "along 4, across 16": "random errors partly cancel: they do not all go to the same side.",
    },
    right="along 2, across 8",
)


# %% slideshow={"slide_type": "fragment"} name="spread" answers="01-growth"
def straight_drives(way, length_error, heading_error, rng, robots=2000, step=0.5):
    """Where robots end that mean to drive straight ahead: (robots, 2) along and across [m]."""
    n = round(way / step)
    lengths = step * (1 + length_error * rng.standard_normal((robots, n)))
    errors = heading_error * rng.standard_normal((robots, n))
    headings = np.cumsum(errors, axis=1) - errors  # a step is driven before its error is made
    steps = lengths * [np.cos(headings), np.sin(headings)]
    return steps.sum(axis=2).T


# %% slideshow={"slide_type": "fragment"} name="spread-table" answers="01-growth" tags=["nbval-check-output"]
rng = np.random.default_rng(2)
for way in (5, 20, 80):
    along, _ = straight_drives(way, 0.02, 0.0, rng).std(axis=0)
    _, across = straight_drives(way, 0.0, np.radians(1), rng).std(axis=0)
    print(f"{way:3d} m   length: {100 * along:4.0f} cm   heading: {100 * across:5.0f} cm")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Why a heading is worse than a length
#
# Errors of **length** partly cancel. If they are independent, their variances add, and after $n$
# steps, each too long or too short by a random length of variance $\sigma_d^2$,
#
# $$ \operatorname{Var}(\text{along}) = n\, \sigma_d^2. \tag{01.4} $$
#
# Its root, the error, grows as $\sqrt{n}$: twice as large over four times the distance.
#
# For the **heading**, look at a single error first. Think of the rest of the track as cut from
# cardboard: the error turns it about the place where it is made.

# %% slideshow={"slide_type": "subslide"} name="ask-bends"
ask(
    "01-bends",
    "A robot drives three steps of length $d$. After each of them, the last one included, its "
    "heading errs by an independent small angle of variance $\\sigma^2$. **What is the variance "
    "of its final place, across the line that it meant to drive, in units of $\\sigma^2 d^2$?**",
    {
        "3": "one each would be right if every error moved the end by the same length.",
        "5": "the first error bends two steps, the second one, the last none: 4 + 1 + 0.",
        "9": "this is (2 + 1 + 0)²: amounts add up only if all errors go to the same side.",
        "14": "9 + 4 + 1 lets the last error bend a step, but that error is made when all steps "
        "have been driven.",
    },
    right="5",
)

# %% slideshow={"slide_type": "fragment"} name="bends" answers="01-bends" tags=["nbval-check-output"]
across = straight_drives(3 * 0.5, 0.0, 0.01, rng, robots=200_000)[:, 1]
print(f"200 000 robots: {across.var() / (0.01 * 0.5) ** 2:.1f} σ² d²")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The sum of all errors
#
# Of $n$ steps, $n - k$ are still to come when the $k$-th error $e_k$ is made. It turns them all, and
# while all angles are small it moves the end sideways by their length times the angle:
#
# $$ \text{across} = d \sum_{k=1}^{n} (n - k)\, e_k. \tag{01.5} $$
#
# The errors are independent, so the variances of the terms add. A sum of squares up to $n$ grows
# like the area under a parabola, and for many steps
#
# $$ \operatorname{Var}(\text{across}) = \sigma^2 d^2 \sum_{k=1}^{n} (n-k)^2
# \approx \tfrac{1}{3}\, \sigma^2 d^2\, n^3. \tag{01.6} $$
#
# The error grows as $n\sqrt{n}$: eightfold over four times the distance.

# %% slideshow={"slide_type": "subslide"} name="growth"
ways = np.array([2.5, 5, 10, 20, 40, 80])
n = ways / 0.5
length = [straight_drives(way, 0.02, 0.0, rng)[:, 0].std() for way in ways]
heading = [straight_drives(way, 0.0, np.radians(1), rng)[:, 1].std() for way in ways]
slow, fast = (np.polyfit(np.log(ways), np.log(errors), 1)[0] for errors in (length, heading))

# %% slideshow={"slide_type": "-"} name="growth-picture" tags=["folded"]
fig, _ = views.growth(
    ways,
    {"length error 2 %": length, "heading error 1°": heading},
    {"(01.4)": 0.02 * 0.5 * n**0.5, "(01.6)": np.radians(1) * 0.5 * (n**3 / 3) ** 0.5},
    "way driven [m]",
    "error [m]",
    "Error of 2000 robots",
    size=(8, 5),
)
views.show(fig, f"Length errors rise with slope {slow:.1f} on the axes, heading's with {fast:.1f}.")

# %% [markdown]
# On doubly logarithmic axes a power is a straight line, and its exponent is the slope:
# {= slow:.1f =} for lengths, {= fast:.1f =} for headings. After 5 m both errors seem bearable.
# After 80 m the error that headings cause is {= heading[-1] / length[-1]:.0f =} times the other.
# **Errors that only ever add up run away.**

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## See the cloud
#
# Here is where 800 such robots end. First you see errors of heading alone. Make the drive longer:
# the cloud bends round the start, because every robot drives the same distance, wherever it heads.
# Then set the heading error to 0 and raise the length error.


# %% name="cloud" tags=["folded"]
def cloud(way_in_metres, heading_error_in_degrees, length_error_in_percent):
    """The ends of 800 drives that were to lead straight ahead."""
    errors = length_error_in_percent / 100, np.radians(heading_error_in_degrees)
    ends = straight_drives(way_in_metres, *errors, np.random.default_rng(1), robots=800)
    along, across = ends.std(axis=0)
    title = f"σ along the way: {along:.2f} m, across it: {across:.2f} m"
    fig, ax = views.axes(title, size=(8, 5.2))
    views.draw(ax, Poses("truth", [[0, 0, 0], [way_in_metres, 0, 0]]), label="meant")
    views.draw(ax, Points("naive", ends), label="ends", markersize=4)
    views.legend(ax, loc="upper left")
    return fig


# %% name="cloud-picture"
views.explore(
    cloud,
    alt="Ends of robots that meant to drive straight: an arc across the way, bent towards the "
    "start.",
    way_in_metres=(5, 80, 30),
    heading_error_in_degrees=(0.0, 3.0, 1.5),
    length_error_in_percent=(0.0, 20.0, 0.0),
)

# %% [markdown]
# Over 30 m, errors of 1.5° a step make the cloud
# {= straight_drives(30, 0, np.radians(1.5), rng)[:, 1].std():.1f =} m wide (one standard deviation).
# Lengths that are wrong by a whole 20 % make it only
# {= straight_drives(30, 0.2, 0, rng)[:, 0].std():.1f =} m long. And no ellipse fits an arc well:
# lessons 04 and 11 come back to this shape.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## A first look at the cure
#
# The odometry says how the robot moved. The scans say it too: between two readings the walls stood
# still, so whatever motion lays the new scan over the old one **is** the motion of the robot.
#
# An *estimator* is a program that turns readings into poses and a map. The one called `icp` does
# just this: it starts from the odometry's guess and corrects it until the walls match. Lesson
# [13](13_scan_matching.ipynb) takes it to pieces. It reads the same readings as before.

# %% slideshow={"slide_type": "subslide"} name="ask-cure"
ask(
    "01-cure",
    "**Do the ends of the corridor meet now?**",
    {
        "exactly": "each match errs by a little, and errors that only ever add up run away.",
        "to about ten centimetres": "the walls tell the heading far better than the wheels do.",
        "no better than before: it starts from the odometry": "it starts there, but the walls "
        "correct each step before the next begins.",
    },
    right="to about ten centimetres",
)

# %% slideshow={"slide_type": "fragment"} name="cure" answers="01-cure"
matched = run(robot, estimators.make("icp", robot))
corrected = matched.trajectory.poses
for name, poses in {"odometry": naive, "icp": corrected}.items():
    ahead, left, turn = between(truth[-1], poses[-1])
    print(f"{name:8}  misses by {100 * np.hypot(ahead, left):5.1f} cm and {np.degrees(turn):5.1f}°")

# %% slideshow={"slide_type": "fragment"} name="cure-picture" answers="01-cure" tags=["folded"]
miss = 100 * np.hypot(*between(truth[-1], corrected[-1])[:2])
fig, _ = views.side_by_side(
    {
        "odometry alone": [Points("naive", map_from(naive, readings))],
        "odometry and scans": [Points("corrected", map_from(corrected, readings))],
    }
)
views.show(
    fig, alt=f"Left the smeared corridor; right the matched one, sharp, closed to {miss:.0f} cm."
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-cure"
# The robot, its wheels and its scans are the same. On the right the walls are sharp, and the lap
# misses its start by {= miss:.0f =} cm where odometry misses it by
# {= 100 * np.hypot(*gap[:2]):.0f =}. Was this luck? We drive three more laps, and look at single
# steps as well.


# %% slideshow={"slide_type": "subslide"} name="more-laps" tags=["code"]
def step_errors(poses, truth):
    """How far the steps of a track are off, in the median: length [mm] and turn [°]."""
    off = between(between(truth[:-1], truth[1:]), between(poses[:-1], poses[1:]))
    return 1e3 * np.median(np.hypot(*off[:, :2].T)), np.degrees(np.median(np.abs(off[:, 2])))


laps = [(robot.truth.poses, matched)]
for seed in (0, 1, 2):
    lap = sources.open("sim:corridor", np.random.default_rng(seed))
    laps.append((lap.truth.poses, run(lap, estimators.make("icp", lap))))

# %% slideshow={"slide_type": "-"} name="more-laps-table"
ends, steps = [], []  # of each lap: by odometry, by icp
for true, found in laps:
    tracks = found.naive.poses, found.trajectory.poses
    ends.append([np.hypot(*between(true[-1], poses[-1])[:2]) for poses in tracks])
    steps.append([step_errors(poses, true) for poses in tracks])
    print("misses by {:.2f} m with odometry, by {:.2f} m with icp".format(*ends[-1]))
per_step = np.mean(steps, axis=0)
for name, (far, turned) in zip(("odometry", "icp"), per_step, strict=True):
    print(f"{name:8}  a step is off by {far:.1f} mm and {turned:.3f}°")

# %% [markdown]
# In {= sum(by_icp < by_wheels for by_wheels, by_icp in ends) =} of {= len(ends) =} laps the matcher
# ends nearer to the start than the odometry of the same drive. Now look at the steps: it measures
# their *length* hardly better than the wheels do, but their *turn*
# {= per_step[0, 1] / per_step[1, 1]:.0f =} times better. The cure works where
# the harm was done. It is not a full cure: its errors add up too, but they are smaller.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The same on a real robot
#
# A simulator shows only what its author believes. So here is a log that made history: a robot drove
# for {= intel_maps.stored().minutes:.0f =} minutes through the Intel Research Lab in Seattle, along
# the same corridors several times. Dirk Hähnel recorded {= intel_maps.stored().readings =} scans of
# 180 beams, and what the wheels said. The log is not ours to give away, but you get the points of
# two maps that we made from it: by odometry, and by `icp` with the settings from above.

# %% slideshow={"slide_type": "subslide"} name="ask-again"
ask(
    "01-again",
    "`icp` compares each scan only with what it has just seen. **The robot comes back to a corridor "
    "after ten minutes. How will this corridor look in its map?**",
    {
        "once, and sharper": "more scans would sharpen it, if the robot knew that it is the same "
        "corridor.",
        "twice, side by side or crossing": "the small errors of ten minutes lie between the two "
        "visits, and nothing takes them away.",
        "not at all": "all scans are drawn; none is thrown away because it contradicts another.",
    },
    right="twice, side by side or crossing",
)

# %% slideshow={"slide_type": "fragment"} name="intel-maps" answers="01-again" tags=["nbval-check-output"]
intel = intel_maps.stored()
long, across = (np.ptp(intel.points[name], axis=0).max() for name in ("odometry", "icp"))
print(f"a way of {intel.way:.0f} m, in {intel.readings} readings")
print(f"maps {long:.0f} m long (odometry) and {across:.0f} m (icp)")

# %% slideshow={"slide_type": "subslide"} name="intel-picture" answers="01-again" tags=["folded"]
fig, _ = views.side_by_side(
    {
        "Intel Research Lab: odometry alone": [Points("naive", intel.points["odometry"])],
        "Intel Research Lab: odometry and scans": [Points("corrected", intel.points["icp"])],
    },
    size=(11, 5.5),
    shared=False,
)
views.show(
    fig,
    f"Left a tangle {long:.0f} m long; right rooms round a ring, {across:.0f} m across, many of "
    "whose walls stand twice.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="01-again"
# Mind the scales: the left map is {= long:.0f =} m long, the right one {= across:.0f =} m. With the
# wheels alone, the laps are turned against each other and overlap until nothing can be made out. On
# the right stands a building. Compared with trusted measurements of where one place lies as seen
# from another (Kümmerle and others, 2009), odometry is off by {= intel.off["odometry"]:.1f =} m on
# average and `icp` by {= intel.off["icp"]:.2f =} m.
#
# But look closely: many walls stand twice. The matcher **does not know that it has been here
# before**. Recognising a place, and mending the past, is called *closing the loop*.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## What SLAM is
#
# - To place a scan on the map, the robot needs its **pose**.
# - To correct its pose, it needs a **map**.
# - It has neither. It must estimate both from the same readings, at the same time: *simultaneous
#   localisation and mapping*.
#
# It must also know **how sure it is**. A wall that was seen from a doubtful pose is a doubtful wall.
# And when the robot recognises one wall, this corrects its pose, the poses on the way there, and all
# the walls that it drew from them. The coming lessons put this into equations.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* ask which parts of the maps on the right the class would trust, and why. Keep
# the double walls of the real map on the projector: lesson 15 mends them.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## Who had the idea
#
# - Randall Smith, Matthew Self and Peter Cheeseman, *Estimating uncertain spatial relationships in
#   robotics*, 1990: robot and landmarks in one estimate, with what their errors have in common.
# - John Leonard and Hugh Durrant-Whyte, *Simultaneous map building and localization for an
#   autonomous mobile robot*, IROS 1991.
# - Johann Borenstein and Liqiang Feng, *Measurement and correction of systematic odometry errors in
#   mobile robots*, IEEE Transactions on Robotics and Automation, 1996: how to calibrate wheels.
# - Rainer Kümmerle and others, *On measuring the accuracy of SLAM algorithms*, Autonomous Robots,
#   2009: the trusted measurements of the Intel log.
#
# **Read next:** Hugh Durrant-Whyte and Tim Bailey, *Simultaneous localization and mapping: part I*,
# IEEE Robotics & Automation Magazine, 2006.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What comes next
#
# Now draw such maps with functions of your own:
# [exercise 01](../exercises/ex01_why_slam.ipynb), 60 min. It asks how the error grows on a drive of
# any shape, and what a robot that comes home now and then can mend.
#
# After that, [02 · Sensors and worlds](02_sensors_and_worlds.ipynb) looks at the scans: what a
# sensor sees of a room, and how it errs.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: your own copy of the real log
#
# The log is published; `sources.recording("intel")` says where to look for it and where to put it.
# Then this line, in a terminal, makes both maps from its readings:
#
#     slamlab run intel --estimator icp --out intel-map
#
# With `--estimator graph` in its place you meet the estimator of lesson 15, which recognises places.
