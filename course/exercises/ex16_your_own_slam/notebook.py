# %% [markdown]
# # Exercise 16 · Your own SLAM: benchmarks and evaluation
#
# **You will be able to** write a complete SLAM program, run it in simulated buildings that it was not tuned for, and
# decide by measurements whether a change has improved it.
#
# **180 minutes for the three milestones and the comparison, and more time if you like. Before:** lesson
# [16 · Your own SLAM: benchmarks and evaluation](../notebooks/16_your_own_slam.ipynb).
#
# The class `MySlam` below already runs, but it uses odometry alone. Therefore its score is 0. Improve it. You may change
# all of it, and write as many functions and cells as you need. The class must keep its name and these members:
#
# | name | meaning |
# | --- | --- |
# | `step(reading)` | is called for each reading, about every 0.4 m. `reading.odometry` is the odometry increment since the previous reading, `[x, y, θ]` in the frame of the previous pose. `reading.scan` is a lidar scan. Its `points()` are (n, 2) in the robot frame, and its `ranges` and `angles`, (n,), are those of the beams. If a scan is lost, all `ranges` are NaN. The odometry does not measure when the robot is carried to another position |
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
import numpy as np

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


# %% name="drive" answers="ex16-blue"
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
# The world of the first milestone is a corridor with a few niches and a bend of 60° to 80°; the robot drives 12 m. The
# lidar has only 120 beams, and a reading arrives every 0.5 m. The check runs a new `MySlam()` on each of two runs. In
# each run one scan is lost. The odometry has a scale error of 5 %, so a correct heading alone is not enough. At the
# end, its error is at least 0.9 m. The check judges the mean position error of the last five poses
# of `trajectory()`, relative to the first pose. In both runs
#
# * it must be less than half of the error of odometry (1 point), and
# * it must be less than 0.4 m (1 more point).
#
# The remaining 0.5 points of each task are for unchanged arguments; you get them with the first other points. The check
# of a milestone stops after 20 s.
#
# The methods of lesson 13 are sufficient: match each scan with the previous ones, with odometry as the initial guess.
# If you have solved exercise 13, you have all parts that you need.

# %%
check("16-corridor")

# %% [markdown]
# ## 2 · Milestone: close a loop
#
# Now the robot drives once round a block and 4 m farther, so that it observes the start again. Its lidar has a
# maximum range of 4 m. At a corner twelve consecutive scans are lost, and there the odometry has an additional heading
# error of about 0.1 rad. The scans before and after this gap do not overlap, so scan matching alone cannot detect
# this error. All poses are compared relative to the first pose, as in milestone 1. In both of two runs,
#
# * back at the start, the mean position error of the last five poses must be less than 0.1 m (1.5 points), and
# * the root mean square position error of all poses of `trajectory()` must be less than 0.16 m (1.5 points). A loop
#   closure also corrects the poses before it.
#
# Lesson 15 shows a method: find an old pose near the current one, match the current scan with the scans near this old
# pose, and let a pose graph distribute the error over the loop.

# %%
check("16-loop")

# %% [markdown]
# ## 3 · Milestone: report a consistent covariance
#
# The world is a corridor with a bend again; the robot drives 16.5 m, and now the check reads `pose` and `covariance`
# after each reading. There are twelve runs of 34 readings, and in each run the scans of readings 10 to 29 (counted
# from 0) are lost. Four of them are repeated with all scans. The odometry increment of each reading has independent
# errors with standard deviations of 30 mm in $x$, 4 mm in $y$ and 0.035 rad in $\theta$. The check places the true
# trajectory so that it begins at your first pose, and computes the errors of `pose` along the axes of your frame.
# From the second reading on, each covariance must be positive definite; that of the first reading is not judged, and
# may be `None`.
#
# | required | points |
# | --- | --- |
# | in each of the twelve runs, the standard deviation of the position, $\sqrt{P_{xx} + P_{yy}}$, grows by a factor of at least 2 from reading 10 to reading 29; there it is at least 1.5 times that of the same run with all scans | 0.5, only together with the next row |
# | each number of the next table is within its limits | 1.5, only together with the row above |
#
# | number | limits |
# | --- | --- |
# | mean NEES in readings 1 to 9 of the twelve runs | 0.2 to 8 |
# | mean NEES in reading 10, the first one without a scan | 0.2 to 12 |
# | mean NEES in readings 27 to 29 of the twelve runs | 0.2 to 12 |
# | mean NEES in readings 27 to 33 of the four runs with all scans | 0.2 to 30 |
# | mean standard deviation in the direction of travel in readings 27 to 29 of the twelve runs | at most 0.4 m |
# | mean correlation there of two errors: of the heading, and of the position to the left of this direction | at least 0.5 |
# | mean position error in readings 1 to 9, relative to that of odometry | at most 0.95 |
#
# The expected NEES of a consistent covariance is 3. The intervals are wide because there are few runs, and the errors
# of neighbouring readings are correlated: each scan is matched with scans whose poses have errors, too, so the error
# of the pose grows even if all scans match. A constant covariance earns nothing, and a consistent covariance of
# odometry alone is not enough either. In a contest an inconsistent covariance costs up to 20 points, and a missing
# covariance costs none.

# %%
check("16-sure")

# %% [markdown]
# ## 4 · Compare two versions in the same worlds
#
# The milestones judge only whether an error is below a limit. The score is a finer measure. But is a better score an
# improvement, or chance? Two versions of a SLAM, A and B, have run in practice worlds, which have numbers. In a world, both
# get the same readings. For each version, you have the numbers of its worlds and its error in each of them, in the order
# in which its runs ended. Either version may have run in worlds in which the other one has not.
#
# As in the lesson, errors differ by factors. Let $d$ be the logarithm of the factor in a world, $\ln(e_A / e_B)$ with the
# errors $e_A$ and $e_B$. We want a 95 % **t interval** of the mean of $d$, converted back to a factor. In which worlds do
# you know $d$? Most errors differ because their worlds differ: does this difference make the interval wider? And the
# standard deviation of $d$ is an estimate from a few numbers: does this make the interval wider or narrower?
#
# **Your task.** Return the four values of the table. The versions have at least two worlds in common. All errors are
# positive, and the ratio of the errors is not the same in all worlds. A *t* quantile with three decimals is accurate enough.
# If you import a module, import it inside the function, so that a contest does not import it before each world.
#
# | value | meaning | points |
# | --- | --- | --- |
# | `low`, `high` | the ends of the interval of the factor, which is below 1 if A has the smaller errors | 1 |
# | `better` | the version with the smaller errors, `"A"` or `"B"`, if the interval does not contain 1; otherwise `"cannot tell"` | 0.5 |
# | `needed` | the smallest number of common worlds, at least 2, with which the interval would not contain 1, if $d$ had the same mean and the same standard deviation in these worlds; 1000 if it is larger than that | 0.5 |


# %% name="compare-versions"
def compare_versions(worlds_a, errors_a, worlds_b, errors_b):
    """A paired comparison of two versions of a SLAM.

    worlds_a : (n,) integers, the worlds of version A, each one once;  errors_a : (n,) its errors there [m]
    worlds_b, errors_b : (m,) the same of version B;  returns low, high, better, needed
    """
    ### BEGIN SOLUTION
    from scipy import stats

    _, a, b = np.intersect1d(worlds_a, worlds_b, return_indices=True)
    d = np.log(errors_a[a]) - np.log(errors_b[b])
    mean, s = d.mean(), d.std(ddof=1)

    def half_width(n):
        return stats.t.ppf(0.975, n - 1) * s / np.sqrt(n)

    half = half_width(len(d))
    low, high = np.exp(mean - half), np.exp(mean + half)
    better = "A" if high < 1 else "B" if low > 1 else "cannot tell"
    too_few = half_width(np.arange(2, 1000)) >= abs(mean)
    needed = 2 + np.sum(too_few)
    return low, high, better, needed
    ### END SOLUTION


# %%
check("16-versions")

# %% [markdown]
# The next cell runs your SLAM in two worlds of each of three families, and compares its errors over 20 m of travel with
# those of the library's `icp` and `graph` in the same worlds. To compare it with an older version of your own, store the
# errors of this version in the same way. A contest uses five worlds (`worlds=5`) of each of the seven families.


# %% name="families"
@attempt
def _():
    from classroom.project.practice import practise, table

    trials = practise(MySlam, ["corridor", "people", "dropouts"], worlds=2, seed=2)
    print(table(trials))
    worlds, errors = np.arange(len(trials)), {"MySlam": [t.result for t in trials]}
    for name in ("icp", "graph"):
        errors[name] = [t.prepared_world.judge(t.prepared_world.runs[name]) for t in trials]
    errors = {name: np.array([r.measures.errors[-1] for r in own]) for name, own in errors.items()}
    for name in ("icp", "graph"):
        low, high, better, needed = compare_versions(worlds, errors["MySlam"], worlds, errors[name])
        print(
            f"A: MySlam, B: {name}: factor {low:.2f} to {high:.2f}, {better}; {needed} worlds needed"
        )


# %%
ask(
    "ex16-needed",
    "In a few worlds A is better, but the interval contains 1, and `needed` is 12. You run both versions in **12 new worlds**. "
    "**With which probability does the interval of these worlds show that A is better**, if the mean and the standard deviation "
    "were estimated correctly?",
    {
        "95 %": "95 % is the probability that an interval contains the true factor.",
        "about 50 %": "with 12 worlds, the mean is about as large as the half-width of its interval. In about half of all "
        "studies the new mean is smaller. So plan more worlds than `needed`: 24 worlds would give about 85 %. And do not stop "
        "as soon as an interval excludes 1.",
        "100 %": "the new worlds have another mean and another standard deviation, because they are other worlds.",
    },
    right="about 50 %",
)

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
