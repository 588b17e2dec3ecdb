# %% [markdown] slideshow={"slide_type": "slide"}
# # Notation
#
# This appendix lists the symbols of the lessons, exercises and docstrings, the letters that have several meanings, and
# the functions of the library that compute them. You need not memorise this appendix: every lesson
# explains its symbols at their first use.
#
# Overview of the course: [Start here](00_start_here.ipynb). Terms: [Glossary](glossary.ipynb).

# %% [markdown] slideshow={"slide_type": "skip"} name="letters"
# ## Letters
#
# Capital letters are matrices, unless the table states something else. A roman subscript $\mathrm{r}$ refers to the
# robot: $P_{\mathrm{rr}}$ is the block of the robot's pose in a covariance $P$. A hat, as in $\hat{x}$, marks an
# estimate.
#
# | Letter | What it means |
# | --- | --- |
# | $x$ | the state: the robot's pose $x$, $y$, $\theta$, and from lesson 06 on also the map |
# | $a$, $b$ | any two poses |
# | $u$ | control input: distance $d$ and turn $\Delta\theta$; of a steered robot the speed $V$ and the angle $\gamma$ |
# | $s$ | distance that a wheel rolls |
# | $o$ | odometry increment, a pose in the robot frame |
# | $B$ | distance between wheels, or axles [m] |
# | $T$ | duration of a step [s] |
# | $\mathrm{Rot}$ | $\mathrm{Rot}(\theta)$ rotates by the angle $\theta$ |
# | $p$ | a point or landmark in the world frame; $p_{\mathrm{r}}$ in the robot frame |
# | $t$ | translation from one frame to another |
# | $l$ | a wall's line, $(\rho, \alpha)$ |
# | $\rho$, $\alpha$ | distance of a line from the origin, direction of its normal |
# | $z$ | a measurement: of a landmark, range $r$ and bearing $\beta$ |
# | $r$ | range |
# | $f$ | motion model: the next pose |
# | $h$ | measurement model: the expected measurement |
# | $g$ | inverse measurement model: the position of a measured landmark |
# | $A$ | Jacobian of the motion model with respect to the pose; $A_k$ belongs to the step from $k-1$ to $k$, and products are $A_k \cdots A_1$ |
# | $W$ | Jacobian of the motion model with respect to the control input |
# | $H$ | Jacobian of the measurement model |
# | $J$ | any other Jacobian, named by its subscript: $J_{\mathrm{r}}$ of $g$ with respect to the robot, $J_z$ with respect to the measurement |
# | $F$ | matrix of a linear motion |
# | $P$ | covariance of the state estimate |
# | $C$ | covariance of the noise of the control input |
# | $E$ | $E[\cdot]$ is the expectation |
# | $q$ | process noise, with covariance $Q$ |
# | $Q$ | covariance of the process noise: $W C W^\top$ |
# | $\varepsilon$ | measurement noise, with covariance $R$ |
# | $R$ | covariance of the measurement noise |
# | $v$ | innovation: measured minus predicted |
# | $S$ | covariance of the innovation: $H P H^\top + R$ |
# | $K$ | Kalman gain: $P H^\top S^{-1}$ |
# | $\Lambda$ | information: the inverse of a covariance |
# | $\sigma$ | standard deviation |
# | $w$ | weight, for instance of a particle |
# | $e$ | residual, for instance of a correspondence, or of an edge between two poses |
# | $\chi^2$ | sum of the squared residuals, weighted by their information; also the distribution of such a sum |
# | $k$ | number of a step; $i$, $j$ number landmarks or poses |
# | $n$, $m$, $N$ | numbers of elements; $N$ of landmarks or particles |
# | $d$ | distance that the odometry measures |
# | $c$, $\kappa$ | constants, named where they are used |
# | $\tau$ | share of the distance between two points |
# | $\iota$ | angle of incidence of a beam on a wall |
# | $U$ | voltage of an infrared sensor |
# | $\Phi$ | scale of a robust kernel |
# | $\Pr$ | probability, or its density; $\mathrm{Bel}$ is the posterior of a pose, given all measurements so far |
# | $\ell$ | logarithm of a weight before normalisation |
# | $\delta$ | a small step, such as one of Gauss–Newton |
# | $\psi$ | angle of a lidar, which increases clockwise |
#
# Some lessons use further letters in one derivation only, and define these letters in that derivation.

# %% [markdown] slideshow={"slide_type": "skip"} name="overloaded"
# ## Letters with several meanings
#
# As in the literature, some letters have further meanings. The context shows which meaning applies.
#
# | Letter | Usually | Also |
# | --- | --- | --- |
# | $x$ | the state, or the pose | the first coordinate of a pose or a point, even in the same formula (04.4) |
# | $a$, $b$ | any two poses | in lesson 03 two variances, in lesson 07 two parts of a map, in lesson 13 corresponding points $a_i$ and $b_i$; in exercise 04 the position of a camera on the robot; in exercise 05 an antenna $a$ and a beacon $b_i$ |
# | $p$ | a point or landmark | $p(x)$ is a density |
# | $f$, $g$ | motion model, inverse measurement model | in lesson 15 $g$ is half the gradient of the cost |
# | $q$ | process noise | in lesson 11 the proposal density, with the target density $\pi$ |
# | $u$ | control input | in exercise 04 a column of pixels |
# | $F$ | matrix of a linear motion | in exercise 04 a focal length |
# | $T$ | duration of a step | with a pose as its subscript, $T_a$, the homogeneous matrix of the pose; as a superscript, $A^{\mathsf T}$, the transpose |
# | $B$ | distance between wheels, or axles | in lesson 07 a matrix |
# | $d$ | distance that the odometry measures | in lesson 01 the length of a step; with a subscript, such as $d_{\mathrm{abs}}$, a bound on an error; $d^2$ is the squared Mahalanobis distance |
# | $s$ | distance that a wheel rolls | in lesson 03 a share of the gain |
# | $n$ | number of elements | in lessons 02 and 05 a direction |
# | $t$ | translation | in lesson 02 a time of flight, in lesson 08 a position along a line; as a subscript the number of a step |
# | $E$ | expectation | in lesson 13 the cost function |
# | $e$ | residual | in lesson 01 the heading error of a step; in lessons 09 and 12 the error of an estimate |
# | $\rho$ | distance of a line from the origin | with an argument, such as $\rho(\chi^2)$, a robust kernel |
# | $o$ | odometry increment | in lesson 15 the event that a cell is occupied |
# | $\ell$ | logarithm of a weight | in lesson 02 the distance to the instantaneous centre of rotation; in lesson 15 the log-odds of a cell |
# | $\delta$ | a small step | in lesson 14 the offset of an angle |
# | $\psi$ | angle of a lidar | in lesson 07 a sum of the compressed EKF, in lesson 09 the correction by a reading |
# | $v$ | innovation | in lesson 02 a speed |

# %% [markdown] slideshow={"slide_type": "skip"} name="notation"
# ## Functions and arguments
#
# The code uses the same letters as the formulas. A row without a function describes an argument of the
# functions. Units are metres and radians, and their squares in covariances.
#
# | Symbol | In the code | Shape | Unit | What it is |
# | --- | --- | --- | --- | --- |
# | $x$ | `x` | (3,) | m, m, rad | pose of the robot: $x$, $y$, $\theta$ |
# | $u$ | `u` | (2,) | m, rad | control input: distance and turn; of a steered robot speed [m/s] and angle |
# | $p$ | `p` | (2,) | m | a landmark's position |
# | $z$ | `z` | (2,) | m, rad | one measurement: range and bearing |
# | $a$, $b$ | `a`, `b` | (3,) | m, m, rad | any two poses |
# | $l$ | `line` | (2,) | m, rad | a wall's line |
# | $f$ | `models.f_odometry(x, u)` | (3,) | m, m, rad | the pose after driving a distance and turning |
# | $f$ | `models.f_steered(x, u, B, T)` | (3,) | m, m, rad | the pose of a steered robot with wheel base $B$ after time $T$ |
# | $h$ | `models.h(x, p)` | (2,) | m, rad | range and bearing of a landmark |
# | $g$ | `models.g(x, z)` | (2,) | m | the position of the measured landmark |
# | $A$ | `jacobians.A_odometry(x, u)` | (3, 3) | | $\partial f/\partial x$ |
# | $A$ | `jacobians.A_steered(x, u, B, T)` | (3, 3) | | the same of the steered robot |
# | $W$ | `jacobians.W_odometry(x, u)` | (3, 2) | | $\partial f/\partial u$ |
# | $W$ | `jacobians.W_steered(x, u, B, T)` | (3, 2) | | the same of the steered robot |
# | $H$ | `jacobians.H_robot(x, p)` | (2, 3) | | $\partial h/\partial x$, the block of $H$ for the robot |
# | $H$ | `jacobians.H_landmark(x, p)` | (2, 2) | | $\partial h/\partial p$, the block of $H$ for the landmark |
# | $J_{\mathrm{r}}$ | `jacobians.J_xr(x, z)` | (2, 3) | | $\partial g/\partial x$ |
# | $J_z$ | `jacobians.J_z(x, z)` | (2, 2) | | $\partial g/\partial z$ |
# | $h$ | `models.h_line(x, line)` | (2,) | m, rad | distance and direction of a wall's line, relative to a pose |
# | $g$ | `models.g_line(x, z)` | (2,) | m, rad | the measured line |
# | $H$ | `jacobians.H_robot_line(x, line)` | (2, 3) | | $\partial h/\partial x$ of a line |
# | $H$ | `jacobians.H_line(x, line)` | (2, 2) | | $\partial h/\partial l$ of a line |
# | $J_{\mathrm{r}}$ | `jacobians.J_xr_line(x, z)` | (2, 3) | | $\partial g/\partial x$ of a line |
# | $J_z$ | `jacobians.J_z_line(x, z)` | (2, 2) | | $\partial g/\partial z$ of a line |
# | $C$ | `noise.C_odometry(u, distance_error, turn_error)` | (2, 2) | m², rad² | covariance of the control noise |
# | $C$ | `noise.C_wheels(u, slip, base)` | (2, 2) | m², rad² | the same of two wheels that slip at random |
# | $Q$ | `noise.Q(W, C)` | (3, 3) | m², rad² | covariance of the process noise |
# | $R$ | `noise.R(r, range_error, bearing_sigma)` | (2, 2) | m², rad² | covariance of the measurement noise |
# | | `geometry.wrap(angle)` | () | rad | the same angle between −π and π |
# | $a \oplus b$ | `geometry.compose(a, b)` | (3,) | m, m, rad | pose $b$, which is given relative to $a$, in the frame in which $a$ is given |
# | $\ominus a$ | `geometry.inverse(a)` | (3,) | m, m, rad | the inverse of pose $a$ |
# | $\ominus a \oplus b$ | `geometry.between(a, b)` | (3,) | m, m, rad | pose $b$ relative to pose $a$ |
# | $T_a$ | `geometry.matrix(a)` | (3, 3) | | homogeneous matrix of a pose |
# | | `geometry.from_matrix(T)` | (3,) | m, m, rad | the pose of a homogeneous matrix |
# | | `geometry.transform(a, points)` | (n, 2) | m | points (n, 2) of the frame of $a$ in the frame in which $a$ is given |
#
# A Kalman filter has a belief about $n$ quantities, `b` in the code, and receives $m$ measured
# quantities. Its update returns a new belief and a `step` with the quantities of the update:
#
# | Symbol | In the code | Shape | What it is |
# | --- | --- | --- | --- |
# | $x$ | `b.x` | (n,) | the mean, which is the estimate |
# | $P$ | `b.P` | (n, n) | its covariance |
# | $F$, $Q$ | `linear.predict(b, F, Q)` | (n, n) | prediction: $x$ becomes $F x$, and process noise of covariance $Q$ is added |
# | $H$, $R$ | `linear.update(b, z, H, R)` | (m, n), (m, m) | update with a measurement $z$ of $H x$, with noise of covariance $R$ |
# | $v$ | `step.innovation` | (m,) | innovation, measured minus predicted: $z - H x$ |
# | $S$ | `step.S` | (m, m) | covariance of $v$ |
# | $K$ | `step.K` | (n, m) | the Kalman gain; $K v$ is added to $x$ |
# | | `step.nis` | () | $v^\top S^{-1} v$: on average $m$ if $S$ is right, less if the filter is conservative, more if it is overconfident |
#
# A pose graph (lesson 15) contains edges: an edge $z$ is a measured pose of $j$ relative to pose $i$.
#
# | Symbol | In the code | Shape | What it is |
# | --- | --- | --- | --- |
# | $e$ | `edge_error.error(x_i, x_j, z)` | (3,) | difference between pose $j$ and the pose predicted from pose $i$ and $z$ |
# | $J_i$ | `edge_jacobians.J_i(x_i, x_j, z)` | (3, 3) | $\partial e/\partial x_i$ |
# | $J_j$ | `edge_jacobians.J_j(x_i, x_j, z)` | (3, 3) | $\partial e/\partial x_j$ |
