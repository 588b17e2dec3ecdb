# %% [markdown]
# # Exercise 09 · SLAM with walls
#
# **You will be able to** run EKF-SLAM on walls: place one, see it again, keep count of its life,
# say where it ends and how sure that is, and draw a room without the things that only looked like
# walls.
#
# **60 minutes. Before:** lesson [09 · SLAM with walls](../notebooks/09_slam_with_walls.ipynb), and exercise 06 for the
# filter on points.
#
# Replace each `raise NotImplementedError(...)` by your code and run the cell. Then run the check below
# it, as often as you like. A check tries random inputs, and others that are as special as the text
# allows. Where your function breaks a law, the check shows a small input that breaks it, and
# `hint("09-place")` in a cell of your own leads on. No function may change what it is given, since
# whoever called it still needs it.
#
# A wall is the line of all points $(a, b)$ with $a \cos\alpha + b \sin\alpha = \rho$. The robot at
# $x, y, \theta$ sees it at $z = (\rho', \alpha')$: how far it is from the robot, and where its normal
# points, counted from the heading. In the code the state is `x = [x, y, θ, ρ_0, α_0, ρ_1, α_1, …]`. We
# use metres and radians throughout, and `wrap` brings an angle into $(-\pi, \pi]$.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import ask, attempt, check
from slamlab.geometry import wrap
from slamlab.layers import Ellipses, Poses, Segments

# %% [markdown]
# ## 1 · Place a wall
#
# The robot's pose `x` errs with covariance `P` (3, 3). It sees a wall at `z`, which errs with `R`
# (2, 2). By (09.2) of the lesson,
#
# $$ \alpha = \theta + \alpha', \qquad \rho = \rho' + x \cos\alpha + y \sin\alpha. $$
#
# **Your task.** Return the line $(\rho, \alpha)$ in the world, its covariance
# $C = J_{\mathrm r} P J_{\mathrm r}^{\mathsf T} + J_z R J_z^{\mathsf T}$, and
# $X = J_{\mathrm r} P$, the covariance of the line's error with the pose's. The Jacobians of the line
# with respect to the pose, $J_{\mathrm r}$ (2, 3), and with respect to $z$, $J_z$ (2, 2), are yours to
# derive. Mind that $\alpha$ stands inside the cosine, too. Where $\rho$ comes out negative, leave it
# so: the normal goes on pointing away from the robot.


# %%
def place(x, P, z, R):
    """A wall was seen at z; returns line (2,), C (2, 2), X (2, 3).

    x : (3,) pose;  P : (3, 3);  z : (2,) ρ' [m], α' [rad];  R : (2, 2)
    """
    ### BEGIN SOLUTION
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    lever = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, lever], [0, 0, 1]])
    J_z = np.array([[1, lever], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, alpha])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
    ### END SOLUTION


# %%
check("09-place")

# %% [markdown]
# Here is your function at work. A robot that is unsure of its heading by 2° sees a wall 2 m ahead,
# first from the origin and then from 5 m to the side of it. Compare how sure $\rho$ is.


# %%
@attempt
def _():
    P, R = np.diag([0.02, 0.02, np.radians(2)]) ** 2, np.diag([0.01, 0.005]) ** 2
    for name, pose in (("at the origin", [0.0, 0, 0]), ("5 m to the side", [0.0, 5, 0])):
        line, C, _ = place(np.array(pose), P, np.array([2.0, 0.0]), R)
        sigma = 100 * np.sqrt(C[0, 0])
        print(f"{name:16} ρ = {line[0]:.2f} m, σ of ρ: {sigma:.1f} cm")


# %% [markdown]
# ## 2 · See it again
#
# Wall `j` is seen again, at `z`. By (09.1) of the lesson the robot expects it at
#
# $$ \rho' = \rho - x \cos\alpha - y \sin\alpha, \qquad \alpha' = \alpha - \theta. $$
#
# **Your task.** Return $x$ and $P$ after the update of the whole state: $v = z - h$,
# $S = H P H^{\mathsf T} + R$, $K = P H^{\mathsf T} S^{-1}$, $x \leftarrow x + K v$,
# $P \leftarrow P - K S K^{\mathsf T}$. The map holds one wall or more. The wall may be behind the robot,
# and the robot may head for $-x$, where $\theta$ and $\alpha$ jump from $\pi$ to $-\pi$. A wall may be
# so near that the estimate has the robot beyond it; then the expected $\rho'$ is negative, and stays
# so. The angles in the new $x$ need not lie within $\pm\pi$.


# %%
def update(x, P, z, j, R):
    """Wall j was seen at z; returns x (n,), P (n, n).

    x : (n,) state;  P : (n, n);  z : (2,) ρ' [m], α' [rad];  j : int, from 0;  R : (2, 2)
    """
    ### BEGIN SOLUTION
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = z - np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])
    v[1] = wrap(v[1])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
    ### END SOLUTION


# %%
check("09-update")

# %% [markdown]
# ## 3 · Sightings and lives
#
# A book says of each wall how often it was seen and how many lives it has left:
# `book[id] = (sightings, lives left)`. Each scan gives `seen`, a list of ids. These are the rules:
#
# - A new id comes into the book with one sighting and all `lives`.
# - A wall that is seen gets one more sighting, and all its lives back. It may stand in a scan more than
#   once; one look is one sighting.
# - A wall that is not seen loses a life. At 0 it leaves the book, and if it comes back, it is new.
# - `used` are the walls of *this scan* that have been seen `N` times or more, this time included.

# %%
ask(
    "ex09-lives",
    "With `lives = 3`, a wall is seen once, missed in the next three scans, and then seen again. "
    "**What does the book say of it after that?**",
    {
        "(2, 3): it was seen twice": "so it would be after two scans missed. With the third its last life is gone.",
        "(1, 3): it is new": "with the third miss it left the book, and the book does not remember who has left.",
        "(1, 1): it has used up two lives": "a wall that is seen has all its lives.",
    },
    right="(1, 3): it is new",
)

# %% [markdown]
# **Your task.** Return the book after the scan, and the list of the ids used, in any order. Book and
# scan may be empty, ids are whole numbers from 0 on, and `N` and `lives` are 1 or more. The check begins
# with an empty book and hands yours on from scan to scan. It shows its scans as rows of a table that is
# filled up with −1, and what your book says as a row for each scan with a column for each id.


# %%
def keep_book(book, seen, N, lives):
    """One scan; returns book, used.

    book : dict, id to (sightings, lives left);  seen : list of ids;  N, lives : int
    """
    ### BEGIN SOLUTION
    after = {}
    for i, (count, left) in book.items():
        if i not in seen and left > 1:
            after[i] = (count, left - 1)
    for i in set(seen):
        count = book[i][0] if i in book else 0
        after[i] = (count + 1, lives)
    used = [i for i in sorted(set(seen)) if after[i][0] >= N]
    return after, used
    ### END SOLUTION


# %%
check("09-life")

# %% [markdown]
# ## Through a corridor
#
# Here is the rest of the filter, as in exercise 06. A new wall shares errors with *everything* that the
# pose is correlated with. `place` gives $X = J_{\mathrm r} P$ for the pose alone, and $X P^{-1}$ is
# $J_{\mathrm r}$ again.


# %%
def predict(x, P, u, C):
    """The robot drives u = [d, Δθ], which errs with covariance C; returns x, P."""
    d, (c, s) = u[0], (np.cos(x[2]), np.sin(x[2]))
    F, W = np.eye(len(x)), np.zeros((len(x), 2))
    F[:2, 2] = -d * s, d * c
    W[:3] = [[c, 0], [s, 0], [0, 1]]
    x = x.copy()
    x[:3] += [d * c, d * s, u[1]]
    return x, F @ P @ F.T + W @ C @ W.T


def add(x, P, z, R):
    """A wall that was seen at z joins the state, as the last one; returns x, P."""
    line, C, X = place(x[:3], P[:3, :3], z, R)
    rows = X @ np.linalg.inv(P[:3, :3]) @ P[:3]
    return np.append(x, line), np.block([[P, rows.T], [rows, C]])


# %%
ask(
    "ex09-across",
    "With your `place` and `update` a robot drives ten metres down a corridor, of which it sees only "
    "the two walls, in every scan. **Which of these three $\\sigma$ grow on the way?** That of its "
    "place along the corridor (in the world), that of its place across it (in the world), and that of "
    "its distance from the left wall.",
    {
        "none: it sees walls all the time": "no wall says how far along it the robot has come.",
        "that along the corridor": "it does, but another one grows as well: where do the walls themselves run?",
        "those along and across the corridor": "the distance from the wall is seen. But the direction of the whole corridor comes from a heading "
        "that was a little wrong, and matters more, the longer the way.",
        "all three": "the distance from the wall is measured in every scan.",
    },
    right="those along and across the corridor",
)


# %% answers="ex09-across"
@attempt
def _():
    C, R = np.diag([0.02, 0.01]) ** 2, np.diag([0.02, 0.01]) ** 2
    rng, walls = np.random.default_rng(9), np.array([[1.5, np.pi / 2], [1.2, -np.pi / 2]])
    x, P, sigmas = np.zeros(3), np.diag([0.01, 0.01, 0.005]) ** 2, []
    for _ in range(50):
        x, P = predict(x, P, rng.multivariate_normal([0.2, 0], C), C)
        for j, seen in enumerate(walls + rng.multivariate_normal([0, 0], R, 2)):
            x, P = update(x, P, seen, j, R) if len(x) == 7 else add(x, P, seen, R)
        some = rng.multivariate_normal(x[:5], P[:5, :5], 4000).T
        off = some[3] - some[0] * np.cos(some[4]) - some[1] * np.sin(some[4])
        sigmas.append([100 * np.sqrt(P[0, 0]), 100 * np.sqrt(P[1, 1]), 100 * off.std()])
    names = ("along", "across", "from the left wall")
    curves = dict(zip(names, np.transpose(sigmas), strict=True))
    fig, _ = views.curves(0.2 * np.arange(1, 51), curves, "driven [m]", "σ [cm]")
    views.show(fig, alt="What the filter believes of its place along and across a corridor.")


# %% [markdown] answers="ex09-across"
# **See:** along the corridor $\sigma$ should grow as the noise of the wheels adds up, since nothing
# measures it. The distance from the wall should stay known to a centimetre. And yet the place *across*
# is less and less certain: the direction of the whole corridor comes from the heading with which its
# walls were placed, and an error of that direction matters more, the farther the robot has come.

# %% [markdown]
# ## 4 · Where a wall ends
#
# A line has no ends, but a wall has: a door-post, a corner. The robot sees the end of wall `j` as the
# last beam that still meets it, in the direction $\beta$ from its heading. The range of that single beam
# is a poor reading. The filter knows far better where the beam meets the line. So the end is
#
# $$ p = \begin{bmatrix} x \\ y \end{bmatrix} + r
# \begin{bmatrix} \cos(\theta + \beta) \\ \sin(\theta + \beta) \end{bmatrix},
# \qquad \text{with } r \text{ such that } p \text{ lies on the wall.} $$
#
# The beam's direction errs by $\sigma$, since the wall ends somewhere between this beam and the next.
# That error has nothing to do with those of the state, while the errors of the state depend on each
# other. The lesson draws its walls from end to end and never asks how sure these ends are. What you need
# is the recipe of `place`: an estimate is a function of things that err.
#
# Two cases to think of: a beam that meets the wall at a slant, and a robot that errs by 10 cm along a wall
# that is known exactly. In which direction is the end unsure in each of them, and by how much?
#
# **Your task.** Return the end $p$, its covariance $C$, and $X$, the covariance of its error with that of
# the whole state. Beam and normal are less than 80° apart, and $r$ is positive. The state holds one wall
# or more, $P$ is the covariance of all of it, and `sigma` may be 0.


# %%
def end_point(x, P, j, beta, sigma):
    """Where a beam meets wall j; returns p (2,), C (2, 2), X (2, n).

    x : (n,) state;  P : (n, n);  j : int, from 0;  beta, sigma : the beam's direction, its σ [rad]
    """
    ### BEGIN SOLUTION
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    phi = x[2] + beta
    normal, beam = np.array([np.cos([alpha, phi]), np.sin([alpha, phi])]).T
    turned = np.array([-normal[1], normal[0]])
    across = np.array([-beam[1], beam[0]])
    r = (rho - normal @ x[:2]) / (normal @ beam)
    p = x[:2] + r * beam
    # normal·p = ρ and across·p = across·(x, y), differentiated: N dp = B dx + b dβ
    N, b = np.array([normal, across]), np.array([0, r])
    B = np.zeros((2, len(x)))
    B[0, at : at + 2] = 1, -turned @ p
    B[1, :2], B[1, 2] = across, r
    J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)
    return p, J @ P @ J.T + sigma**2 * np.outer(J_beta, J_beta), J @ P
    ### END SOLUTION


# %%
check("09-end")

# %% [markdown]
# Three beams of one robot meet one wall, which is known to 2 cm and half a degree.


# %%
@attempt
def _():
    x, betas = np.array([0, 0, 0, 2, np.pi / 2]), np.radians([90, 45, 22])
    P = np.diag([0.03, 0.03, np.radians(0.5), 0.02, np.radians(0.5)]) ** 2
    found = [end_point(x, P, 0, beta, np.radians(0.5)) for beta in betas]
    fig, ax = views.axes("Ends of a wall", size=(8, 3.4))
    views.draw(ax, Segments("walls", [[-0.5, 2, 5.5, 2]]))
    views.draw(ax, Segments("scan", [[0, 0, *p] for p, _, _ in found]), label="beams")
    views.draw(
        ax, Ellipses("landmark", [p for p, _, _ in found], [C for _, C, _ in found]), label="ends"
    )
    views.draw(ax, Poses("robot", [x[:3]]))
    views.legend(ax, loc="lower right")
    views.show(fig, alt="Three beams that meet a wall, and an ellipse where each of them ends.")


# %% [markdown]
# **See:** across the wall, all ends are known as well as the wall is. Along it they are less certain, the
# flatter the beam meets the wall: half a degree of a grazing beam is a long way on the wall.

# %% [markdown]
# ## 5 · Make it better: a map without ghosts
#
# A robot goes once round a room with eight straight walls, and nobody tells it which wall is which.
# A wall is *in view* while the robot is in front of it and within `far`; then four scans of five find
# it. But not everything that looks like a wall is one:
#
# - In each scan, up to two lines are nothing at all, and never come back.
# - Three things in the room, say a cart, a screen and a row of chairs, are found as walls are, but they
#   stand there for 12 to 15 scans only. In a dozen other scans or more, before or after, their places
#   are in view and nothing is there.
#
# Some walls are in view for longer than others. The one that is in view for the shortest time is found no
# more often than a thing is. The wheels alone drift by a quarter of a radian on the way round.

# %%
ask(
    "ex09-often",
    "The lesson's rule takes in what is sighted `N` times. **Which `N` lets in all walls, and neither "
    "kind of ghost?**",
    {
        "3, as in the lesson": "it keeps out the lines that are nothing. But a thing that stands there for a dozen scans is "
        "sighted more often than that.",
        "5": "a thing is found in four scans of five while it stands there, so in ten or so.",
        "10 or more": "that begins to keep out the things, and with them the wall that is in view for the shortest time.",
        "none": "that wall is found no more often than a thing is. How often is not enough to go by.",
    },
    right="none",
)

# %% [markdown]
# And what does a book of lives do to the walls that the robot has left behind?
#
# **Your task.** Return the walls of the room, as good a list as you can make of the whole drive. The
# first scan is taken at the start, before the first drive. A wall is right if it is off by less than
# 50 cm, as seen from the middle of the way, and 0.2 rad. Each counts once. Points come in four steps, and
# the lesson's rule reaches the lowest. You may use all the functions above. The check stops after 10 s.


# %%
def clean_map(x, P, drives, C, scans, R, far):
    """The walls of a room; returns (k, 2): ρ, α of each in the world, in any order.

    x : (3,) pose at the start;  P : (3, 3)
    drives : (t - 1, 2) d, Δθ, each of covariance C (2, 2)
    scans : list of t arrays (m, 2), m = 0, 1, …: ρ', α' of what was found, of covariance R (2, 2)
    far : float, how far the sensor sees [m]
    """
    ### BEGIN SOLUTION
    found, way = np.zeros(0), []  # how many scans found each wall; the poses so far
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            alpha = x[4::2]
            expected = x[3::2] - x[0] * np.cos(alpha) - x[1] * np.sin(alpha)
            off = np.hypot((z[0] - expected) / 0.45, wrap(z[1] - alpha + x[2]) / 0.14)
            if len(off) == 0 or off.min() > 1:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
                continue
            j = int(np.argmin(off))
            found[j] += 1
            if found[j] > 2:  # what was found but once may be nothing: it is not to move the robot
                x, P = update(x, P, z, j, R)
        way.append(x[:2])
        ahead = x[3::2] - way @ np.array([np.cos(x[4::2]), np.sin(x[4::2])])
        due = np.sum((ahead > 0) & (ahead < far - 0.3), axis=0)  # in how many scans it was in view
        stays = (due < 6) | (found >= 0.6 * due)
        at = np.append([0, 1, 2], 3 + np.flatnonzero(np.repeat(stays, 2)))
        x, P, found = x[at], P[np.ix_(at, at)], found[stays]
    return x[3:].reshape(-1, 2)[found >= 5]
    ### END SOLUTION


# %%
check("09-ghosts")

# %% [markdown]
# Here is a drive to look at, in a plain room with four walls and one cart that stands across it for
# twelve scans.


# %%
def plain_drive(rng, C, R, far):
    """A drive round a room: drives, scans, the true way, and the lines of four walls and a cart."""
    lines = np.array([[5, 0], [4, np.pi / 2], [4.5, np.pi], [4, -np.pi / 2], [1, np.pi / 2]])
    way, drives, scans = [np.array([3, 0, np.pi / 2])], [], []
    for t in range(40):
        gap = lines[:, 0] - way[-1][:2] @ [np.cos(lines[:, 1]), np.sin(lines[:, 1])]
        stands = np.arange(5) < (5 if 20 < t < 33 else 4)
        there = stands & (gap > 0) & (gap < far) & (rng.random(5) < 0.8)
        walls = np.column_stack([gap, lines[:, 1] - way[-1][2]])[there]
        z = np.vstack([walls, rng.uniform([0.3, -np.pi], [far, np.pi], (rng.integers(3), 2))])
        scans.append(z + rng.multivariate_normal([0, 0], R, len(z)))
        drives.append(np.array([0.35 + 0.1 * abs(np.sin(t * np.pi / 20)), np.pi / 20]))
        way.append(predict(way[-1], np.eye(3), drives[-1], C)[0])
    return np.array(drives[:-1]) + rng.multivariate_normal([0, 0], C, 39), scans, way[:-1], lines


# %%
@attempt
def _():
    rng, C, R = np.random.default_rng(5), np.diag([0.03, 0.035]) ** 2, np.diag([0.03, 0.015]) ** 2
    drives, scans, way, lines = plain_drive(rng, C, R, 3.8)
    P = np.diag([0.01, 0.01, 0.005]) ** 2
    found = clean_map(way[0], P, drives, C, scans, R, 3.8)
    fig, ax = views.axes("Your map", size=(7, 5))
    for layer, label, rows in (("walls", "walls", lines[:4]), ("landmark", "your map", found)):
        ends = [
            (rho * np.array([c, s]) + np.outer([-4.3, 4.3], [-s, c])).ravel()
            for rho, c, s in zip(rows[:, 0], np.cos(rows[:, 1]), np.sin(rows[:, 1]), strict=True)
        ]
        views.draw(ax, Segments(layer, ends), label=label)
    views.draw(ax, Segments("naive", [[-2, 1, 2, 1]]), label="where the cart stood")
    views.draw(ax, Poses("truth", way))
    views.legend(ax, loc="upper left", bbox_to_anchor=(1, 1))
    views.show(
        fig,
        alt="Four walls of a room, the lines of the map near them, the robot's way, and where the cart stood.",
    )


# %% [markdown]
# **See:** there should be four lines near four walls, and none where the cart stood. The error that is
# left turns the map as a whole. It comes from the heading with which its first walls were placed.

# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it, but the grader draws
# other inputs. Then drive the robot yourself: lesson 09 has the buttons. **Next:** lesson
# [10 · Boxes](../notebooks/10_boxes.ipynb) asks for a filter that promises never to lose the truth.
