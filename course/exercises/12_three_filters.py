# %% [markdown]
# # Exercise 12 · Three filters, one robot
#
# **You will be able to** turn the ticks of two encoders into a motion, say since when a run is lost
# and how sure a share of lost runs is, compare two filters drive by drive, and write a filter that
# notices that it is lost and finds itself again.
#
# **60 minutes. Before:** lesson [12 · Three filters, one robot](../notebooks/12_three_filters.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs, and inputs at the edges of what the text
# promises. Where a law is broken it shows a small input that breaks it, and `hint("12-odometry")` in a
# cell of your own leads on.
#
# All lengths are in metres, all angles in radians. A motion is `[x, y, θ]` in the frame of the pose
# before it. No function may change its arguments, because whoever called it still needs them.

# %%
from itertools import pairwise
from math import comb

import numpy as np

from slamlab import views
from slamlab.checks import ask, attempt, check
from slamlab.geometry import compose, wrap
from slamlab.layers import Points, Poses

# %% [markdown]
# ## 1 · From ticks to a motion
#
# The robot has two driven wheels, `base` metres apart, each with an encoder. Both wheels roll
# evenly, by `left` and `right` ticks of `tick` metres each. So they roll the distances
# $s_{\mathrm{left}}$ and $s_{\mathrm{right}}$, and the middle of the robot drives an arc of length
# $d = (s_{\mathrm{left}} + s_{\mathrm{right}})/2$ while the robot turns evenly by
# $\Delta\theta = (s_{\mathrm{right}} - s_{\mathrm{left}})/\text{base}$.
#
# The lesson derives how long the straight line from start to end of that arc is, and where it
# points.
#
# A robot may also drive straight on. What would your formula ask of your computer then?
#
# **Your task.** Return where the robot is at the end, and by how much it has turned. Ticks are whole
# numbers, negative for a wheel that rolls backwards, and any of them may be zero. Even one tick more
# on one side counts. The robot may turn by more than a full turn; whether you wrap $\theta$ is up
# to you.


# %% name="odometry"
def odometry(left, right, tick, base):
    """The motion that two encoders tell of.

    left, right : ticks of the wheels, negative when rolling back;  tick : way of one [m]
    base : distance of the wheels [m];  returns (3,) x, y, θ in the frame of the pose before
    """
    ### BEGIN SOLUTION
    l, r = left * tick, right * tick
    turn = (r - l) / base
    chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
    ### END SOLUTION


# %%
check("12-odometry")

# %% [markdown]
# The next cell drives a robot whose right wheel rolls a little farther with every step.


# %% name="spiral"
@attempt
def _():
    poses = [np.zeros(3)]
    for k in range(60):
        poses.append(compose(poses[-1], odometry(200, 200 + 4 * k, 0.0002, 0.1)))
    fig, ax = views.axes("A right wheel that rolls farther and farther", size=(5.5, 4))
    views.draw(ax, Poses("naive", poses), label="by your odometry")
    views.legend(ax)
    views.show(fig, alt="The track of a robot that turns left more and more.")


# %% [markdown]
# Its track winds itself up to the left, because each step turns a little more than the one before.

# %% [markdown]
# ## 2 · Lost, and since when
#
# You know how far a filter's position was off at each reading. A run **strays** where this error is
# beyond a limit; an error that equals the limit is not beyond it. A run is **lost** if it is beyond
# the limit at its end, and it has been lost since *the first reading from which on it never came
# back*.
#
# **Your task.** Return the number of that reading, counted from 0, or −1 if the run is not lost. A
# run has at least one reading.


# %% name="lost-since"
def lost_since(errors, limit):
    """The first reading from which the error stays beyond the limit to the end, or -1.

    errors : (n,) [m];  limit : [m];  returns a whole number
    """
    ### BEGIN SOLUTION
    near = np.flatnonzero(errors <= limit)
    if len(near) == 0:
        return 0
    return near[-1] + 1 if near[-1] < len(errors) - 1 else -1
    ### END SOLUTION


# %%
check("12-lost")

# %% [markdown]
# Here are three made-up runs. The legend says since when each is lost, or −1.


# %% name="three-runs"
@attempt
def _():
    k, limit = np.arange(60), 0.12
    runs = {
        "it wobbles": 0.05 + 0.03 * np.sin(k / 4),
        "it comes back": 0.03 + 0.3 * np.exp(-(((k - 25) / 6) ** 2)),
        "it drifts away": 0.045 + 0.0001 * k**2 + 0.05 * np.sin(k / 3),
    }
    dated = {f"{name}: {lost_since(run, limit):.0f}": run for name, run in runs.items()}
    fig, ax = views.curves(k, dated, "reading", "error of the position [m]", "Lost since when?")
    ax.axhline(limit, color=views.COLOURS["limit"], linestyle="dashdot")
    views.show(fig, alt=f"Errors of three runs over time, and the limit of {limit} m.")


# %% [markdown]
# Only the last one is lost. It strays, comes back for some readings, and has been lost since it
# crossed the limit for the last time.

# %% [markdown]
# ## 3 · How sure is a share?
#
# Of $n$ runs, $k$ were lost. The share $k/n$ is only an estimate of the true share $p$. We want an
# interval that holds $p$ in about 95 % of all studies.
#
# If $p$ is the true share, then $k/n$ scatters about it with the standard deviation
# $\sqrt{p\,(1-p)/n}$. So we call every $p$ possible from which $k/n$ is at most 1.96 such
# deviations away. Squared, this is the lesson's (12.6), with $k$ lost runs in place of its $m$:
#
# $$\left(\frac kn - p\right)^2 \le 1.96^2\,\frac{p\,(1-p)}{n}$$
#
# The inequality is quadratic in $p$, and it holds between two ends.

# %%
ask(
    "ex12-none",
    "None of six runs was lost. **What is the largest true share that this leaves possible**, in the "
    "sense above?",
    right=39,
    tolerance=5,
    unit="%",
    reason="if every fourth run is lost, six runs without a loss are nothing unusual.",
    wrong={
        0: "so says the estimate. But a filter that loses one run in ten will often bring six home.",
        17: "that is one in six, the least share that six runs can show at all.",
    },
)

# %% [markdown]
# **Your task.** Return these two ends, the lower one first. There is at least one run, and there may
# be hundreds of thousands; none of them may be lost, or all. (Another interval will do as well, if it
# is as honest.)


# %% name="interval"
def interval(k, n):
    """The 95 % interval of a share of which k in n were counted.

    k, n : whole numbers, 0 ≤ k ≤ n, 1 ≤ n;  returns low, high
    """
    ### BEGIN SOLUTION
    z = 1.96
    middle = (k / n + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(k / n * (1 - k / n) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return max(middle - half, 0.0), min(middle + half, 1.0)
    ### END SOLUTION


# %%
check("12-interval")

# %% [markdown]
# The thesis lost one run in six. Here is what this says, what none in six says, and what 13 in 80 would
# say.


# %% name="one-in-six" answers="ex12-none"
@attempt
def _():
    for k, n in ((1, 6), (0, 6), (13, 80)):
        low, high = interval(k, n)
        print(
            f"{k:2} of {n:2}: {100 * k / n:3.0f} %, truly {100 * low:.0f} % to {100 * high:.0f} %"
        )


# %% [markdown] answers="ex12-none"
# "Once in six" may be anything from one in thirty to more than half. That is why the thesis' author
# himself calls six sets too few, and why the lesson drives eighty times.

# %% [markdown]
# ## 4 · Two filters on the same drives
#
# Which of two filters is nearer to the truth? The lesson compares them on the *same* drives and takes
# differences. You have some drives, not all, so the median of these differences is uncertain, just as a
# share is. How uncertain?
#
# The idea of task 3 helps again. Suppose that the true median is $\mu$. Then on each drive the
# difference lies below $\mu$ as a coin lands heads: with probability ½, whatever the differences
# look like. Of $n$ coins, the number $K$ of heads is distributed as
#
# $$\Pr(K = k) = \binom nk \frac 1{2^n}$$
#
# Now count how many of your $n$ differences lie below $\mu$. We call $\mu$ possible, unless a count
# as small as this or smaller happens in at most 2.5 % of all studies, or a count as large as this or
# larger does.
#
# Try it with six differences. If none of them lies below $\mu$, is such a $\mu$ possible? And if one does?
# As $\mu$ grows from the smallest difference to the largest, where can the answer change at all?
#
# **Your task.** Return the ends of the interval of all $\mu$ that are possible, the lower one first.
#
# 1. On each drive, compare both filters up to the reading *before* the first one at which either of
#    them is beyond the limit (an error that equals it is not). What comes later does not count, even
#    if they come back.
# 2. The difference of a drive is the root mean square (RMS) of A's errors in these readings, less that
#    of B's.
# 3. A drive on which one of them is beyond the limit at the first reading says nothing, so leave it
#    out.
#
# A drive has at least one reading, and at least six drives are left. No two differences are equal.


# %% name="compare"
def compare(errors_a, errors_b, limit):
    """The 95 % interval of the median difference of two filters on the same drives.

    errors_a, errors_b : (drives, readings) [m];  limit : [m];  returns low, high [m]
    """
    ### BEGIN SOLUTION
    differences = []
    for a, b in zip(errors_a, errors_b, strict=True):
        strayed = np.flatnonzero((a > limit) | (b > limit))
        end = strayed[0] if len(strayed) else len(a)
        if end > 0:
            differences.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(differences), len(differences)
    chances = np.cumsum([comb(n, k) / 2**n for k in range(n + 1)])
    few = np.sum(chances <= 0.025)  # so many numbers of heads, from 0 on, are too few
    return d[few - 1], d[n - few]
    ### END SOLUTION


# %%
check("12-paired")

# %%
ask(
    "ex12-drives",
    "Two made-up filters run on the same drives, some of which are hard for both. On a typical drive "
    "B is better by 1 cm, and this difference varies by some 2 cm. **How many drives does it take "
    "until your interval says that B is better?**",
    {
        "6": "with six drives the interval reaches from the smallest difference to the largest.",
        "20": "the median of 20 differences is still unsure by about a centimetre, and that is what we want to see.",
        "80": "of the numbers tried in the picture it is the first whose interval does not hold zero.",
        "no number will do: from drive to drive the errors vary by 10 cm": "each drive is hard for both, or easy for both, so this drops out of the differences.",
    },
    right="80",
)


# %% name="how-many-drives" answers="ex12-drives"
@attempt
def _():
    rng, counts, ends = np.random.default_rng(7), [6, 10, 20, 40, 80, 160], []
    hard = rng.uniform(0.02, 0.12, (160, 1))
    errors_b = hard * rng.uniform(0.5, 1.5, (160, 50))
    errors_a = errors_b + 0.01 + rng.normal(0, 0.025, (160, 1)).clip(-0.015)
    for n in counts:
        ends.append([100 * end for end in compare(errors_a[:n], errors_b[:n], 1.0)])
    low, high = np.transpose(ends)
    shown = {"upper end": high, "lower end": low, "zero": np.zeros(len(counts))}
    fig, ax = views.curves(counts, shown, "drives", "A less B [cm]", "Your interval of the median")
    ax.set_xscale("log")
    views.show(fig, alt="The interval narrows as drives are added; its lower end rises above zero.")


# %% [markdown] answers="ex12-drives"
# Both errors vary by ten centimetres from drive to drive. This has dropped out of the differences,
# since each drive was hard for both filters, or easy for both.

# %% [markdown]
# ## 5 · Make it better: lost, and found again
#
# A robot drives through a hall of three bays, 4 m by 4 m each, side by side, so the hall is 12 m long
# and 4 m wide. Each bay has six posts. Five of them stand in the same places in every bay, and they look
# the same from behind, turned by half a turn. The sixth is the bay's own. The robot has a map of all 18.
# It sees posts within 2 m all round, but misses one in five. A sight is a range and a bearing, with
# $\sigma$ = 0.03 m and 0.02 rad, and it has **no name**: it does not say which post it is of. Besides, a
# scan holds 0.7 *phantoms* on average, which are no posts at all. A scan may also be empty.
#
# At some time somebody lifts the robot and sets it down elsewhere in the hall, turned by any angle. The
# wheels notice nothing of it.
#
# These tools are ready for use. They take many poses at once, `(n, 3)`, because a robot that is lost has
# to consider more than one.

# %% name="tools"
HALL = np.array([12.0, 4.0])  # [m]


def offsets(poses, sights, posts):
    """From each pose to where each sight lies, and from there to the nearest post: (2, n, k) both."""
    turned = poses[:, 2:] + sights[:, 1]
    arm = np.stack([sights[:, 0] * np.cos(turned), sights[:, 0] * np.sin(turned)])
    place = arm + poses.T[:2, :, None]
    dx, dy = posts.T[:, None, None] - place[..., None]
    nearest = np.argmin(dx * dx + dy * dy, axis=2)
    return arm, posts.T[:, nearest] - place


def fit(poses, sights, posts):
    """How well a scan fits each pose (n,): the logarithm of its likelihood, 0 at the best.

    A sight counts 0 where it hits a post, and −4.6 where it is far from any, as a phantom is.
    """
    _, (dx, dy) = offsets(poses, sights, posts)
    return np.log(0.01 + np.exp(-(dx * dx + dy * dy) / 2 / 0.08**2)).sum(axis=1)


def corrected(poses, sights, posts):
    """Each pose (n, 3) after an update with those sights that are within 0.3 m of a post."""
    (ax, ay), (dx, dy) = offsets(poses, sights, posts)
    w = 400.0 * (dx * dx + dy * dy < 0.3**2)
    L, b = np.zeros((len(poses), 3, 3)), np.zeros((len(poses), 3, 1))
    L[:, 0, 0] = L[:, 1, 1] = 400 + w.sum(axis=1)
    L[:, 0, 2] = L[:, 2, 0] = -(w * ay).sum(axis=1)
    L[:, 1, 2] = L[:, 2, 1] = (w * ax).sum(axis=1)
    L[:, 2, 2] = 900 + (w * (ax * ax + ay * ay)).sum(axis=1)
    b[:, 0, 0], b[:, 1, 0] = (w * dx).sum(axis=1), (w * dy).sum(axis=1)
    b[:, 2, 0] = (w * (ax * dy - ay * dx)).sum(axis=1)
    return poses + np.linalg.solve(L, b)[:, :, 0]


def guesses(sights, posts):
    """All poses in the hall (n, 3) from which some two of the sights would be two posts."""
    x, y = sights[:, 0] * np.cos(sights[:, 1]), sights[:, 0] * np.sin(sights[:, 1])
    i, j = np.triu_indices(len(sights), 1)
    a, b = np.nonzero(~np.eye(len(posts), dtype=bool))
    (sx, sy), (px, py) = (x[j] - x[i], y[j] - y[i]), (posts[b] - posts[a]).T
    seen, real = np.nonzero(np.abs(np.hypot(sx, sy)[:, None] - np.hypot(px, py)) < 0.1)
    theta = wrap(np.arctan2(py[real], px[real]) - np.arctan2(sy[seen], sx[seen]))
    c, s = np.cos(theta), np.sin(theta)
    mx, my = (x[i] + x[j])[seen] / 2, (y[i] + y[j])[seen] / 2
    middle = (posts[a] + posts[b])[real] / 2
    at = middle - np.column_stack([c * mx - s * my, s * mx + c * my])
    return np.column_stack([at, theta])[((at > 0) & (at < HALL)).all(axis=1)]


def track(start, motions, sights, posts):
    """The usual filter: it believes each sight to be the nearest post, if one is near."""
    pose, found = start[None], []
    for told, seen in zip(motions, sights, strict=True):
        pose = corrected(compose(pose, told), seen, posts)
        found.append(pose[0])
    return np.array(found)


# %%
ask(
    "ex12-alike",
    "After the lift, one scan fits a place in the left bay, and it holds no bay's own post. **In how "
    "many other places of the hall does it fit as well?**",
    right=5,
    tolerance=0.4,
    reason="there are three bays, and in each of them two places, with headings half a turn apart.",
    wrong={
        2: "that is one in each other bay. But a bay looks the same from behind, turned by half a turn.",
        6: "six places fit, and one of them is the place you began with.",
        1: "the same bay from behind is one of them. There are two bays more.",
    },
)

# %% [markdown]
# What tells these places apart, and when?
#
# **Your task.** Write a filter that notices the lift and finds itself again. It is given the pose
# at the start, which is exact, the motions that the wheels tell, and the scans, one after each
# motion. Any method is allowed: try again from many poses, follow several at once, weigh samples,
# look back. All scans are given, so a pose may also be told by what was seen later.
#
# The check lets your filter follow 24 drives of 30 readings in six halls. A reading strays if the
# position is off by more than 0.3 m. As long as nobody lifts the robot, hardly any reading may stray.
# After the lift, readings count from the third sight of a bay's own post, since nobody can know the bay
# before; the fewer of them stray, the more points there are. The numbers of this hall hold in all
# drives. The check stops after 10 s, so each drive may take 0.4 s.


# %% name="relocalise"
def relocalise(start, motions, sights, posts):
    """The poses of a drive in which the robot is lifted and set down elsewhere.

    start : (3,);  motions : (steps, 3);  sights : list of (k, 2) ranges and bearings, k may be 0
    posts : (n, 2);  returns (steps, 3), the pose after each motion and its scan
    """

    ### BEGIN SOLUTION
    def distinct(poses, scores):
        """Which poses are best, one of each place: some may have become one."""
        order = np.argsort(-scores)
        cells = np.round(5 * poses[order])
        return order[np.sort(np.unique(cells, axis=0, return_index=True)[1])][:20]

    poses, scores, found = start[None], np.zeros(1), []  # the best one first
    for motion, z in zip(motions, sights, strict=True):
        poses = corrected(compose(poses, motion), z, posts)
        fits = fit(poses, z, posts)
        if fits[0] < -len(z):  # some phantoms, or elsewhere: other places may be as good
            others = guesses(z, posts)
            others = corrected(others[distinct(others, fit(others, z, posts))], z, posts)
            poses = np.concatenate([poses, others])
            scores = np.append(scores, np.full(len(others), scores[0] - 12))  # lifts are rare
            fits = np.append(fits, fit(others, z, posts))
        scores = scores + fits
        best = distinct(poses, scores)
        poses, scores = poses[best], scores[best]
        found.append(poses[0])
    return np.array(found)
    ### END SOLUTION


# %%
check("12-relocalise")

# %% [markdown]
# Here is one drive through such a hall, in which the robot is lifted out of the left bay, and what the ready
# filter `track` and yours make of it.


# %% name="lifted"
@attempt
def _():
    rng = np.random.default_rng(3)
    alike = np.array([[2.0, 2.0], [0.7, 0.6], [3.3, 3.4], [1.1, 2.9], [2.9, 1.1]])
    own = [[0.5, 1.9], [6.0, 3.5], [11.6, 1.2]]
    posts = np.concatenate([*(alike + np.array([x, 0]) for x in (0, 4, 8)), own])
    angle = np.linspace(np.pi, -np.pi / 2, 31)
    place = np.column_stack([6 + 5 * np.cos(angle), 2 + 1.2 * np.sin(angle)])
    ahead = np.diff(place, axis=0)
    truth = np.column_stack([place[:-1], np.arctan2(*ahead.T[::-1])])
    truth = np.concatenate([truth[:8], truth[15:]])
    motions, scans = [], []
    for before, pose in pairwise(truth):
        c, s = np.cos(before[2]), np.sin(before[2])
        x, y = (pose - before)[:2]
        usual = len(motions) != 7  # in that step it was carried, and its wheels rolled on
        told = [c * x + s * y, c * y - s * x, wrap(pose[2] - before[2])] if usual else [0.4, 0, 0]
        motions.append(told + rng.normal(0, [0.02, 0.01, 0.02]))
        off = posts - pose[:2]
        z = np.column_stack([np.hypot(*off.T), np.arctan2(off[:, 1], off[:, 0]) - pose[2]])
        z = z[(z[:, 0] < 2) & (rng.random(len(z)) < 0.8)]
        phantoms = rng.uniform([0.5, -3], [2, 3], (rng.poisson(0.7), 2))
        scans.append(np.concatenate([z + rng.normal(0, [0.03, 0.02], z.shape), phantoms]))
    given = truth[0], np.array(motions), scans, posts
    fig, ax = views.axes("Lifted out of the left bay", size=(9, 3.8))
    views.draw(ax, Points("landmark", posts), label="posts")
    views.draw(ax, Poses("truth", truth[:8]), label="truth")
    views.draw(ax, Poses("truth", truth[8:]), label="_later")
    views.draw(ax, Poses("naive", track(*given)), label="track")
    views.draw(ax, Poses("corrected", relocalise(*given)), label="yours")
    views.legend(ax)
    views.show(fig, alt="Posts of three bays, the true way in two pieces, both filters' ways.")


# %% [markdown]
# `track` goes on where nobody is. Yours has to jump once, and then stay. The lesson's `walls` cured slips
# in a similar way, with walls that are in sight and samples that are weighed over many scans.

# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other inputs.
# **Next:** lesson [13 · Scan matching](../notebooks/13_scan_matching.ipynb) uses scans as they are, without any
# landmark.
