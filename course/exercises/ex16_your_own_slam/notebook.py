# %% [markdown]
# # Exercise 16 · Your own SLAM: benchmarks and evaluation
#
# **You will be able to** write a complete SLAM program, run it in simulated buildings that it was not tuned for, and
# decide by measurements whether a change has improved it.
#
# **180 minutes for the three milestones, and more time if you like. Before:** lesson
# [16 · Your own SLAM: benchmarks and evaluation](../notebooks/16_your_own_slam.ipynb).
#
# The class `MySlam` below already runs, but it uses odometry alone. Therefore its score is 0. Improve it. You may change
# all of it, and write as many functions and cells as you need. The class must keep its name and these members:
#
# | name | meaning |
# | --- | --- |
# | `step(reading)` | is called for each reading, about every 0.4 m. `reading.odometry` is the odometry increment since the previous reading, `[x, y, θ]` in the frame of the previous pose. `reading.scan` is a lidar scan. Its `points()` are (n, 2) in the robot frame, and its `ranges` and `angles`, (n,), are those of the beams. If a scan is lost, no beam has a range. The odometry does not measure when the robot is carried to another position |
# | `pose` | the current estimate of the pose, `[x, y, θ]`. You may choose the frame |
# | `trajectory()` | the *current* estimates of all poses, (n, 3). It is called at the end |
# | `map()` | points on the walls, (n, 2), in the frame of `trajectory()` |
# | `covariance` | the covariance (3, 3) of the error of `pose`, `[x, y, θ]`, along the axes of the frame of `pose`, not of the robot frame; or `None` if you do not estimate it |
#
# You may import numpy, scipy, and from the course `slamlab.geometry`, `slamlab.layers`, `slamlab.readings` and
# `slamlab.simulation.worlds.ray_casting`. The filters, scan matchers and pose graphs of the library are not available
# when your SLAM is judged. You may use what you wrote in the exercises.
#
# In a contest there are limits of CPU time: 50 s for all worlds together and 1 s for a single reading. Before each world
# all your cells are run again, which may take at most 5 s of the 50 s. So put experiments of your own under `@attempt`,
# as below: such cells are not run in a contest. All lengths are in metres, all angles in radians.

# %%
from classroom.checks import ask, attempt, check

# %% name="my-slam" solved="project/solution.py" given="project/template.py"
# course/project/solution.py, handed out as course/project/template.py

# %% [markdown]
# ## Run it in a practice world

# %%
ask(
    "ex16-blue",
    "The next cell runs your SLAM in a practice world: a furnished building that was generated at "
    "random, with doors, corridors and loops. The true trajectory is black, that of odometry red, and "
    "that of your SLAM blue. **Before you change anything in `MySlam`, where is the blue trajectory?**",
    {
        "close to the black one": "for this, `step` would have to use the scan. Read what `step` does with the scan.",
        "on the red one": "so far, `MySlam` composes the odometry increments, and so does the red trajectory.",
        "between the two": "for this, `step` would have to use the scan. Read what `step` does with the scan.",
    },
    right="on the red one",
)


# %% name="drive"
@attempt
def _():
    from classroom.project.practice import practise, table
    from slamlab import views

    trials = practise(MySlam, ["plain"], seed=1)
    fig, _ = views.side_by_side({"a plain world": trials[0].layers()}, size=(8, 6))
    points = trials[0].result.points
    views.show(
        fig,
        alt=f"A floor plan with true, odometry and estimated trajectories: {points:.0f} points.",
    )
    print(table(trials))


# %% [markdown]
# The table shows the mean relative pose errors over 1 m, 5 m and 20 m of travel (lesson 16). The points compare your
# errors with those of other estimators on the same run: you get 0 points for the errors of odometry, 55 for those of
# the library's `icp`, 85 for those of its `graph`, and 100 for errors that are a fifth below those of `graph`. The
# trajectory accounts for 80 % of the points, and the map for 20 %. Other values of `seed` give other worlds. The
# families of worlds are `plain`, `symmetric`, `corridor`, `kidnapped`, `range-bias`, `people` and `dropouts`.
#
# The lidar has 180 beams and a maximum range of 8 m. A range has two independent errors, with standard deviations of
# 0.8 % of the range and 5 mm. A bearing has a standard deviation of 0.3°. One beam in a hundred has no return. The slip
# of each wheel has a standard deviation of 1.2 cm over 1 m of travel, and the scale error of each wheel has a
# standard deviation of 0.6 %. In some of the families one of these errors is larger.

# %% [markdown]
# ## 1 · Milestone: correct the odometry drift in a corridor
#
# The world of the first milestone is a corridor, 9 m long, with a few niches. The lidar has only 120 beams, and a
# reading arrives every 0.5 m. The check runs a new `MySlam()` on each of two runs. In each run one scan is lost.
# At the end, the error of odometry is at least 0.5 m. The check judges the mean position error of the last five poses
# of `trajectory()`, relative to the first pose. In both runs
#
# * it must be less than half of the error of odometry (1 point), and
# * it must be less than 0.3 m (1.5 more points).
#
# Together with 0.5 points for unchanged arguments, which you get with the first other points, these are the 3 points
# of this milestone. The check of a milestone stops after 20 s.
#
# The methods of lesson 13 are sufficient: match each scan with the previous ones, with odometry as the initial guess.
# If you have solved exercise 13, you have all parts that you need.

# %%
check("16-corridor")

# %% [markdown]
# ## 2 · Milestone: close a loop
#
# Now the robot drives once round a block and 3 m farther, so that it observes the start again. Its lidar has a
# maximum range of 5 m. At a corner ten consecutive scans are lost, and there the odometry has an additional heading
# error of about 0.1 rad. The scans before and after this gap hardly overlap, so scan matching alone cannot detect
# this error. All poses are compared relative to the first pose, as in milestone 1. In both of two runs,
#
# * back at the start, the mean position error of the last five poses must be less than 0.1 m (2 points), and
# * the root mean square position error of all poses of `trajectory()` must be less than 0.12 m (2 points). A loop
#   closure also corrects the poses before it.
#
# Lesson 15 shows a method: find an old pose near the current one, match the current scan with the scans near this old
# pose, and let a pose graph distribute the error over the loop. Another method may also pass: match each scan with a
# map of the whole run. With the 0.5 points for unchanged arguments, this milestone has 4.5 points.

# %%
check("16-loop")

# %% [markdown]
# ## 3 · Milestone: report a consistent covariance
#
# The world is a corridor again, 16.5 m long, and now the check reads `pose` and `covariance` after each reading. There
# are twelve runs of 34 readings, and in each run the scans of readings 10 to 29 (counted from 0) are lost. Two of them
# are repeated with all scans. The odometry increment of each reading has independent errors with standard deviations of
# 8 mm in $x$, 4 mm in $y$ and 0.035 rad in $\theta$. The check places the true trajectory so that it begins at your
# first pose, and computes the errors of `pose` along the axes of your frame. From the second reading on, each covariance
# must be positive definite.
#
# | required | points |
# | --- | --- |
# | in each of the twelve runs, the standard deviation of the position, $\sqrt{P_{xx} + P_{yy}}$, grows by a factor of at least 2 from reading 10 to reading 29; there it is at least 1.5 times that of the same run with all scans | 1, only together with the next row |
# | the mean NEES of the twelve runs lies between 0.25 and 8 in readings 1 to 9, and also in readings 27 to 29; and in readings 1 to 9 the mean position error is less than 0.95 times that of odometry | 2, only together with the row above |
#
# The expected NEES of a consistent covariance is 3. The interval is wide because there are only twelve runs, and the
# errors of neighbouring readings are correlated. A constant covariance earns nothing, and a consistent covariance of
# odometry alone is not enough either. With the 0.5 points for unchanged arguments, this milestone has 3.5 points. In a
# contest an inconsistent covariance costs up to 20 points, and a missing covariance costs none.

# %%
check("16-sure")

# %% [markdown]
# ## Measure your score
#
# The milestones judge only whether an error is below a limit. The score is a finer measure. The next cell runs your
# SLAM in one world of each of three families. Before you conclude that a change is an improvement, run both versions
# in several worlds, and use the *same* worlds for both (lesson 16). A contest uses five worlds (`worlds=5`) of each
# of the seven families.


# %% name="families"
@attempt
def _():
    from classroom.project.practice import practise, table

    print(table(practise(MySlam, ["corridor", "people", "dropouts"], seed=2)))


# %% [markdown]
# These ideas often help, in no particular order:
#
# * Estimate the normal of the wall at each point, and match point to line.
# * Reject correspondences that are too far apart, and reduce the limit in each iteration.
# * Match with keyframes, one every 0.8 m, instead of with every scan.
# * Reject a match in which too few points have a correspondence.
# * Reduce the weight of a loop closure that contradicts the rest of the graph (robust kernel).
# * If the robot may have been carried to another position, match the scan with the whole map (relocalisation).
# * Measure the computing time of each part. If it grows with every reading, the time limit ends your last worlds.
#
# To submit your SLAM, save this notebook and submit this file alone. Other files of this folder are not submitted.
