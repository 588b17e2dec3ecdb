# %% [markdown]
# # Exercise 16 · Your own SLAM
#
# **You will be able to** write a SLAM that is yours from the first line to the last, drive it through
# buildings that it has never seen, and say by numbers whether a change has made it better.
#
# **180 minutes for the three milestones, and as much more as you like. Before:** lesson
# [16 · Your own SLAM](../notebooks/16_your_own_slam.ipynb).
#
# Below stands a class `MySlam`. It drives already, but it believes the wheels, and so it scores 0.
# Make it better. You may change all of it, and write as many functions and cells as you need; the
# class has to keep its name and what it offers:
#
# | name | what it is |
# | --- | --- |
# | `step(reading)` | is called for each reading, about every 0.4 m. `reading.odometry` is the motion since the last one as the wheels tell it, `[x, y, θ]` in the frame of the pose before; `reading.scan` is a lidar scan, whose `points()` are (n, 2) in the robot's frame; `reading.scan.ranges` and `.angles`, (n,), are its beams. In a scan that was lost no beam has a range. The odometry says nothing of being carried away |
# | `pose` | where it believes it is now, `[x, y, θ]`, in a frame of its choice |
# | `trajectory()` | all poses as it believes them *now*, (n, 3). It is asked for at the end |
# | `map()` | points on the walls, (n, 2), in the same frame as `trajectory()` |
# | `covariance` | how sure it is of `pose`: the covariance (3, 3) of the errors of its `[x, y, θ]`, along the axes of the same frame as `pose`, not of the robot; or `None` for no claim |
#
# You may import numpy, scipy, and of the course `slamlab.geometry`, `slamlab.layers`,
# `slamlab.readings` and `slamlab.worlds.ray_casting`. The course's filters, matchers and graphs are
# not there when your SLAM is judged; what you wrote in the exercises is yours to use. All worlds of
# a contest together may take 50 s of CPU, a single reading 1 s. All your cells are run anew before
# each world, in 5 s of these at most: what you only want to look at, such as an experiment of your
# own, goes under `@attempt`, as below, and is left out there. Lengths are in metres and angles in
# radians.

# %%
from slamlab.checks import ask, attempt, check

# %% name="my-slam" solved="project/solution.py" given="project/template.py"
# course/project/solution.py, handed out as course/project/template.py

# %% [markdown]
# ## Drive it

# %%
ask(
    "ex16-blue",
    "The next cell drives your SLAM through a practice world: a furnished floor that nobody has "
    "drawn, with doors, corridors and loops. Black is where the robot drove, red is what the "
    "wheels alone say, blue what your SLAM says. **Before you change anything in `MySlam`, where does "
    "the blue track lie?**",
    {
        "on the black one, nearly": "it would have to use the scan. Read what its step does with it.",
        "on the red one": "so far it adds up what the wheels tell, and that is what the red track does.",
        "between the two": "that would take some use of what was scanned. Read what its step does.",
    },
    right="on the red one",
)


# %% name="drive"
@attempt
def _():
    from slamlab import views
    from slamlab.project.practice import practise, table

    trials = practise(MySlam, ["plain"], seed=1)
    fig, _ = views.side_by_side({"a plain world": trials[0].layers()}, size=(8, 6))
    points = trials[0].result.points
    views.show(
        fig,
        alt=f"A floor plan, the true track, odometry's and the estimate's: {points:.0f} points.",
    )
    print(table(trials))


# %% [markdown]
# The errors are those of pieces of the drive, 1 m, 5 m and 20 m long, as lesson 16 explains. You
# get 0 points for errors as large as those of the wheels alone, 55 for errors as large as those of
# the package's `icp` on the same drive, 85 for those of its `graph`, and 100 for errors a fifth
# smaller still. Other values of `seed` give other worlds, and other families are `symmetric`,
# `corridor`, `kidnapped`, `range-bias`, `people` and `dropouts`.
#
# The lidar has 180 beams and sees 8 m far. Its ranges err by 0.8 % and by 5 mm more, its bearings
# by 0.3°, and one beam in a hundred comes back empty. Each wheel slips at random, by 1.2 cm in a
# metre, and is larger or smaller than believed by some 0.6 %. In single families one of these is
# worse.

# %% [markdown]
# ## 1 · It survives a corridor
#
# The first milestone is a corridor, 9 m long, with a few niches and a cheap lidar of 120 beams. The
# wheels go astray by half a metre and more. At the end your poses have to be at most half as far
# off as those of the wheels; more points are for being off by less than 0.3 m. Two drives are
# tried, each with a new `MySlam()`, and in each of them a scan is lost on the way.
#
# What lesson 13 teaches is enough: match each scan with what was seen lately, beginning where the
# wheels say. If you have solved exercise 13, you hold all the pieces.

# %%
check("16-corridor")

# %% [markdown]
# ## 2 · It closes a loop
#
# Now the robot drives once round a block and 3 m farther, so that it sees its beginning again. Its
# lidar sees 5 m far. On the way, round a corner, ten scans are lost, and the wheels turn a tenth of a
# radian too much there. What is seen before this gap and what is seen after it have next to nothing in
# common, so whoever only matches with the scans before will not notice. Back at the start, the poses have to be off by less
# than 0.1 m. `trajectory()` is asked for at the end, and all its poses together have to be off by less
# than 0.12 m: closing a loop tells something about the poses before it, too.
#
# Lesson 15 shows how: look for an old pose near the present one, match with the scans round it, and
# let a graph share out the error. A map of the whole drive against which each scan is matched may
# do as well.

# %%
check("16-loop")

# %% [markdown]
# ## 3 · It says how sure it is
#
# The corridor again, and this time `covariance` is asked for after each reading. The milestone counts
# once the first one is passed, because what the wheels alone know is not asked here. For six readings
# no scan arrives. Meanwhile σ of the place has to grow, by a factor of 1.3 at least, and the mean
# NEES of the poses that you give on the way has to lie between 0.05 and 20. It is 3 where the
# claims are true; the band is wide, because few drives are tried and neighbouring readings share
# much of their errors. In a contest it is narrower, and a false claim costs up to 20 points, while
# no claim costs nothing.

# %%
check("16-sure")

# %% [markdown]
# ## How good is it?
#
# Milestones are passed or not; a SLAM is more or less good. This cell drives through one world of three
# families. Before you believe that a change has helped, try it in more worlds than one, the *same* ones
# for both versions, as lesson 16 shows. `worlds=5` and all seven families are what a contest drives.


# %% name="families"
@attempt
def _():
    from slamlab.project.practice import practise, table

    print(table(practise(MySlam, ["corridor", "people", "dropouts"], seed=2)))


# %% [markdown]
# Ideas that have helped others, in no order: give each point the normal of its wall; throw out pairs that
# lie too far apart, and tighten that round by round; keep a keyframe every 0.8 m instead of every
# scan; do not believe a match that fits too few points; weigh down a loop that contradicts the rest;
# after the robot has been carried to another place, look for it in the whole map. And measure where the time
# goes: what grows with every reading will cost you the last worlds.
#
# To hand in, save this notebook and hand it in as it is. Nothing else from this folder goes with
# it.
