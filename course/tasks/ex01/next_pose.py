"""Right ways and slips of 01-next-pose."""

from course.tasks import Edit, Slip, Stumble

TASK = "01-next-pose"

WAYS = {
    "complex numbers": """
def next_pose(pose, step):
    z = complex(*pose[:2]) + complex(*step[:2]) * np.exp(1j * pose[2])
    return [z.real, z.imag, np.angle(np.exp(1j * (pose[2] + step[2])))]
""",
    "homogeneous matrices": """
def next_pose(pose, step):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    M = T(pose) @ T(step)
    return np.array([M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])])
""",
    "the math module, wrapped by ifs": """
def next_pose(pose, step):
    import math

    x, y, t = (float(value) for value in pose)
    side = t + math.pi / 2
    heading = t + step[2]
    if heading > math.pi:
        heading -= 2 * math.pi
    elif heading < -math.pi:
        heading += 2 * math.pi
    return (
        x + step[0] * math.cos(t) + step[1] * math.cos(side),
        y + step[0] * math.sin(t) + step[1] * math.sin(side),
        heading,
    )
""",
    "a copy that is changed": """
def next_pose(pose, step):
    new = pose.copy()
    c, s = np.cos(pose[2]), np.sin(pose[2])
    new[:2] += np.array([[c, -s], [s, c]]) @ step[:2]
    new[2] = (pose[2] + step[2] + np.pi) % (2 * np.pi) - np.pi
    return new
""",
    "distance and direction": """
def next_pose(pose, step):
    far, way = np.hypot(step[0], step[1]), np.arctan2(step[1], step[0]) + pose[2]
    heading = np.remainder(pose[2] + step[2] + np.pi, 2 * np.pi) - np.pi
    return np.array([pose[0] + far * np.cos(way), pose[1] + far * np.sin(way), heading])
""",
    "by the package": """
def next_pose(pose, step):
    from slamlab.geometry import compose
    return compose(pose, step)
""",
}

CS = "c, s = np.cos(theta), np.sin(theta)"
X, Y = "x + c * forward - s * left", "y + s * forward + c * left"
TURN = "np.arctan2(np.sin(heading), np.cos(heading))"


def _moved(x, y):
    return [(X, x), (Y, y)]


def _looking(cosine, sine):
    return (CS, f"c, s = {cosine}, {sine}")


ADDED = "def next_pose(pose, step):\n    return pose + step\n"

SLIPS = (
    Slip(
        "added without turning",
        "You add forward and left to x and y as they are. They are measured in the robot's frame: turn "
        "them by the heading first.",
        _moved("x + forward", "y + left"),
        ADDED,
    ),
    Slip(
        "turned before moving",
        "You move along the new heading. The step was measured in the frame of the pose before it: use "
        "the old heading, then turn.",
        _looking("np.cos(theta + turn)", "np.sin(theta + turn)"),
        [_looking("np.cos(theta + turn)", "np.sin(theta + turn)"), (TURN, "heading")],
        _looking("np.cos(turn)", "np.sin(turn)"),
    ),
    Slip(
        "half turned",
        "You move along the heading half way between old and new, as on an arc. But forward and left are "
        "told as seen along the old heading.",
        _looking("np.cos(theta + turn / 2)", "np.sin(theta + turn / 2)"),
    ),
    Slip(
        "turned the wrong way",
        "The step is turned clockwise: the signs of the sines are wrong, or the rotation matrix is "
        "transposed. Try heading π/2: forward must lead along +y.",
        _moved("x + c * forward + s * left", "y - s * forward + c * left"),
    ),
    Slip(
        "degrees",
        "Angles are in radians everywhere: cosine and sine take them as they are, and nothing is "
        "converted.",
        _looking("np.cos(np.degrees(theta))", "np.sin(np.degrees(theta))"),
        _looking("np.cos(np.radians(theta))", "np.sin(np.radians(theta))"),
        (TURN, "np.degrees(np.arctan2(np.sin(heading), np.cos(heading)))"),
    ),
    Slip(
        "sine and cosine swapped",
        "Sine and cosine have changed places. A robot with heading 0 looks along +x, so that x goes with "
        "the cosine of the heading.",
        _looking("np.sin(theta)", "np.cos(theta)"),
    ),
    Slip(
        "left forgotten",
        "Only the forward part of the step is used. A step has a part to the left as well: a wheel that "
        "slips pushes the robot sideways.",
        _moved("x + c * forward", "y + s * forward"),
    ),
    Slip(
        "left taken for right",
        "The part to the left goes to the right. Left of the heading is a quarter turn "
        "counter-clockwise from it.",
        _moved("x + c * forward + s * left", "y + s * forward - c * left"),
    ),
    Slip(
        "forward and left swapped",
        "Forward and left have changed places: a step says first how far the robot went forward.",
        ("forward, left, turn = step", "left, forward, turn = step"),
    ),
    Slip(
        "the whole length forward",
        "The robot moves as far as the step is long, but straight ahead. A part of it may lead to the "
        "left: turn that part along with the other.",
        _moved("x + c * np.hypot(forward, left)", "y + s * np.hypot(forward, left)"),
    ),
    Slip(
        "the wrong way round",
        "You place the pose in the frame of the step. Which of the two is given in the frame of the "
        "other?",
        [
            _looking("np.cos(turn)", "np.sin(turn)"),
            (X, "forward + c * x - s * y"),
            (Y, "left + s * x + c * y"),
        ],
    ),
    Slip(
        "one sign",
        "One of the two places has a wrong sign at its sine. In a rotation both sines stand there with "
        "opposite signs, so that the length of the step stays what it was.",
        (X, "x + c * forward + s * left"),
        (Y, "y - s * forward + c * left"),
    ),
    Slip(
        "from the origin",
        "The step is turned as it should be, but nothing was added to it: the robot does not begin at "
        "the origin.",
        _moved("c * forward - s * left", "s * forward + c * left"),
    ),
    Slip(
        "everything turned",
        "The robot's own place was turned as well. Only the step is given in the robot's frame: turn the "
        "step, then add it.",
        _moved("c * (x + forward) - s * (y + left)", "s * (x + forward) + c * (y + left)"),
    ),
    Slip(
        "forward used when changed",
        "forward was turned before y was computed of it: both places need the numbers of the step as they "
        "were told.",
        [(X, "x + forward"), (CS, CS + "\n    forward = c * forward - s * left")],
    ),
    Slip(
        "turn forgotten",
        "The heading stays as it was: add the turn.",
        ("heading = theta + turn", "heading = theta"),
    ),
    Slip(
        "turn subtracted",
        "The turn is subtracted. A positive turn is counter-clockwise, as the heading is.",
        ("heading = theta + turn", "heading = theta - turn"),
    ),
    Slip(
        "only the turn",
        "The new heading is the turn alone. The turn is what is added to the old heading.",
        ("heading = theta + turn", "heading = turn"),
    ),
    Slip(
        "turned twice",
        "The turn was added twice, or the old heading counts twice.",
        ("heading = theta + turn", "heading = theta + 2 * turn"),
        ("heading = theta + turn", "heading = 2 * theta + turn"),
    ),
    Slip(
        "not wrapped",
        "The heading leaves the range from −π to π. The same direction has many angles: bring it back, "
        "for instance by np.arctan2 of its sine and cosine.",
        (TURN, "heading"),
        (TURN, "(heading) % (2 * np.pi)"),
        (TURN, "(theta + np.pi) % (2 * np.pi) - np.pi + turn"),
        (TURN, "np.abs(np.arctan2(np.sin(heading), np.cos(heading)))"),
    ),
    Slip(
        "wrapped on one side",
        "Headings beyond π come back, but not those below −π, or the other way round.",
        Edit(
            "the math module, wrapped by ifs", (("elif heading < -math.pi", "elif heading < -9"),)
        ),
        Edit("the math module, wrapped by ifs", (("if heading > math.pi", "if heading > 9"),)),
    ),
    Slip(
        "half the directions",
        "A heading comes back that points the opposite way: the arcus tangent of one number, or a "
        "remainder of π, knows half the directions only. A full turn is 2π.",
        (TURN, "np.arctan(np.tan(heading))"),
        (TURN, "(heading + np.pi / 2) % np.pi - np.pi / 2"),
        (TURN, "heading - np.pi * np.sign(heading) * (abs(heading) > np.pi)"),
        (TURN, "np.arcsin(np.sin(heading))"),
        (TURN, "np.fmod(heading, np.pi)"),
    ),
    Slip(
        "clipped",
        "A heading beyond π was cut off at π. 190° is not 180° but −170°.",
        (TURN, "np.clip(heading, -np.pi, np.pi)"),
    ),
    Slip(
        "arctan2 turned",
        "np.arctan2 takes the sine first and the cosine second.",
        (TURN, "np.arctan2(np.cos(heading), np.sin(heading))"),
    ),
    Slip(
        "place wrapped",
        "Metres were wrapped as if they were angles. Only the third number of a pose is an angle.",
        """
def next_pose(pose, step):
    from slamlab.geometry import compose, wrap
    return wrap(compose(pose, step))
""",
    ),
    Slip(
        "order",
        "The numbers have changed places: a pose is x, y and then the heading.",
        Edit("complex numbers", (("[z.real, z.imag", "[z.imag, z.real"),)),
        Edit("a copy that is changed", (("return new", "return new[[2, 0, 1]]"),)),
    ),
    Slip(
        "rounded",
        "The numbers were rounded, or made whole: half a metre is half a metre.",
        [(X, "round(x + c * forward - s * left, 2)"), (Y, "round(y + s * forward + c * left, 2)")],
        [(X, "int(x + c * forward - s * left)"), (Y, "int(y + s * forward + c * left)")],
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        "def next_pose(pose, step):\n    return (pose + step, )\n",
        "def next_pose(pose, step):\n    new = pose + step\n",
        (TURN, "np.nan"),
        "def next_pose(pose, step):\n    return pose[:2] + step[:2]\n",
    ),
    Stumble("raised", ("x, y, theta = pose", "x, y = pose")),
    Stumble("not attempted", "def next_pose(pose, step):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
