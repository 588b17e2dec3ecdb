"""Right ways and slips of 02-to-points."""

from course.tasks import Slip, Stumble

TASK = "02-to-points"

WAYS = {
    "complex numbers": """
def to_points(degrees, millimetres, mount, pose):
    z = millimetres * 1e-3 * np.exp(-1j * np.deg2rad(degrees))
    z = z[millimetres != 0]
    for frame in (mount, pose):
        z = z * np.exp(1j * frame[2]) + complex(frame[0], frame[1])
    return np.column_stack([z.real, z.imag])
""",
    "the package's poses": """
from slamlab.geometry import compose, transform

def to_points(degrees, millimetres, mount, pose):
    r, b = millimetres / 1000, np.radians(360 - degrees)
    xy = np.column_stack([r * np.cos(b), r * np.sin(b)])[r > 0]
    return transform(compose(pose, mount), xy)
""",
    "lists and matrices": """
def to_points(degrees, millimetres, mount, pose):
    def T(f):
        return np.array([[np.cos(f[2]), -np.sin(f[2]), f[0]], [np.sin(f[2]), np.cos(f[2]), f[1]],
                         [0, 0, 1]])
    out = []
    for a, mm in zip(degrees, millimetres):
        if mm == 0:
            continue
        q = [mm / 1000 * np.cos(np.radians(a)), -mm / 1000 * np.sin(np.radians(a)), 1]
        x, y, _ = T(pose) @ T(mount) @ q
        out.append([x, y])
    return out
""",
    "angles added up": """
def to_points(degrees, millimetres, mount, pose):
    heading = pose[2] + mount[2]
    x = pose[0] + np.cos(pose[2]) * mount[0] - np.sin(pose[2]) * mount[1]
    y = pose[1] + np.sin(pose[2]) * mount[0] + np.cos(pose[2]) * mount[1]
    points = np.empty((len(degrees), 2))
    points[:, 0] = x + millimetres / 1000 * np.cos(heading - np.pi / 180 * degrees)
    points[:, 1] = y + millimetres / 1000 * np.sin(heading - np.pi / 180 * degrees)
    return np.delete(points, np.flatnonzero(millimetres <= 0), axis=0)
""",
    "columns": """
def to_points(degrees, millimetres, mount, pose):
    turn = lambda a: np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
    seen = np.nonzero(millimetres)
    r, a = millimetres[seen].copy(), np.copy(degrees)[seen]
    r /= 1e3
    a *= np.pi / 180
    q = np.vstack((r * np.cos(a), -r * np.sin(a)))
    q = turn(mount[2]) @ q + mount[:2, None]
    return (turn(pose[2]) @ q + pose[:2].reshape(2, 1)).T
""",
}

BACK = "back = millimetres > 0"
BETA = "-np.radians(degrees[back])"
R = "millimetres[back] / 1000"
Q = "np.column_stack([r * np.cos(beta), r * np.sin(beta)])"
RESULT = "return carry(pose, carry(mount, in_sensor))"
MATRIX = "np.array([[c, s], [-s, c]])"
CS = "c, s = np.cos(frame[2]), np.sin(frame[2])"

SLIPS = (
    Slip(
        "degrees-not-read",
        "The angles were made up, as if a reading stood at every degree from 0 on. A scan may begin "
        "anywhere, and has its own degrees.",
        (BETA, "-np.radians(np.arange(len(degrees))[back])"),
        (BETA, "-np.radians(np.linspace(0, 360, len(degrees), endpoint=False)[back])"),
    ),
    Slip(
        "counter-clockwise",
        "Your map is mirrored: the device counts its degrees clockwise, everything else here is "
        "counter-clockwise.",
        (BETA, "np.radians(degrees[back])"),
    ),
    Slip(
        "millimetres",
        "The device speaks in millimetres, and the map is in metres: your points are too far away, or "
        "too near, by a power of ten.",
        (R, "millimetres[back]"),
        (R, "millimetres[back] / 100"),
        (R, "millimetres[back] / 10"),
        (R, "millimetres[back] / 1e6"),
    ),
    Slip(
        "whole-metres",
        "The ranges were rounded to whole metres or centimetres on the way: the device knows more than "
        "that.",
        (R, "millimetres[back] // 1000"),
        (R, "np.round(millimetres[back] / 1000, 2)"),
        (R, "millimetres[back].astype(int) / 1000"),
    ),
    Slip(
        "degrees",
        "np.cos and np.sin take radians: the device's degrees must be converted.",
        (BETA, "-degrees[back]"),
        (BETA, "degrees[back]"),
        (BETA, "-np.degrees(degrees[back])"),
    ),
    Slip(
        "angles-of-frames-converted",
        "mount and pose are in radians already: only what the device says is in degrees.",
        (CS, "c, s = np.cos(np.radians(frame[2])), np.sin(np.radians(frame[2]))"),
        (CS, "c, s = np.cos(np.degrees(frame[2])), np.sin(np.degrees(frame[2]))"),
    ),
    Slip(
        "front-along-y",
        "You take the device's front for +y (as some devices do). Here it looks along its +x: at 0° a point "
        "lies at (r, 0).",
        (Q, "np.column_stack([-r * np.sin(beta), r * np.cos(beta)])"),
        (Q, "np.column_stack([r * np.sin(beta), r * np.cos(beta)])"),
        (BETA, "np.pi / 2 - np.radians(degrees[back])"),
    ),
    Slip(
        "mount-forgotten",
        "The sensor does not sit in the robot's middle: first carry the points into the robot's frame by "
        "the mount.",
        (RESULT, "return carry(pose, in_sensor)"),
    ),
    Slip(
        "pose-forgotten",
        "The points are in the robot's frame: the robot's pose in the world is missing.",
        (RESULT, "return carry(mount, in_sensor)"),
    ),
    Slip(
        "both-forgotten",
        "The points are in the sensor's own frame. Where is the sensor on the robot, and the robot in "
        "the world?",
        (RESULT, "return in_sensor"),
    ),
    Slip(
        "wrong-order",
        "Mount and pose have changed places. From the inside out: the mount brings sensor to robot, "
        "then the pose brings robot to world.",
        (RESULT, "return carry(mount, carry(pose, in_sensor))"),
    ),
    Slip(
        "mount-added-as-it-is",
        "The mount's offset is added along the world's axes. It is given in the robot's frame: it turns "
        "with the robot.",
        (RESULT, "return carry(pose + mount, in_sensor)"),
    ),
    Slip(
        "mount-not-turned",
        "The sensor's offset is there, its direction on the robot is not: the mount's angle is missing.",
        (RESULT, "return carry(pose, in_sensor + mount[:2])"),
    ),
    Slip(
        "mount-not-shifted",
        "The sensor's direction on the robot is there, its offset is not.",
        (RESULT, "return carry(pose + np.array([0, 0, mount[2]]), in_sensor)"),
    ),
    Slip(
        "pose-not-turned",
        "The robot's place is there, its heading is not: what is ahead of a robot that looks along +y "
        "lies farther along y.",
        (RESULT, "return carry(mount, in_sensor) + pose[:2]"),
    ),
    Slip(
        "pose-not-shifted",
        "The points are turned by the robot's heading, but its place is not added.",
        (RESULT, "return carry(np.array([0, 0, pose[2]]), carry(mount, in_sensor))"),
    ),
    Slip(
        "turned-the-wrong-way",
        "Frames turn clockwise with their angles: a sign of the sines is wrong, or the rotation matrix "
        "is transposed (it stands on the right of points in rows).",
        (MATRIX, "np.array([[c, -s], [s, c]])"),
    ),
    Slip(
        "no-rotation",
        "This matrix is no rotation: it bends or mirrors what it turns. Where does it take (1, 0), and "
        "where (0, 1)?",
        (MATRIX, "np.array([[c, s], [s, c]])"),
        (MATRIX, "np.array([[c, s], [s, -c]])"),
        (MATRIX, "np.array([[s, c], [-c, s]])"),
    ),
    Slip(
        "shifted-first",
        "You shift first and turn afterwards, so that the offset is turned as well. A frame's own place "
        "is added last.",
        (
            "return points @ np.array([[c, s], [-s, c]]) + frame[:2]",
            "return (points + frame[:2]) @ np.array([[c, s], [-s, c]])",
        ),
    ),
    Slip(
        "into-the-frame",
        "You go the other way round: from the world into the frame. Known in the sensor's frame, wanted "
        "in the world's.",
        (
            "return points @ np.array([[c, s], [-s, c]]) + frame[:2]",
            "return (points - frame[:2]) @ np.array([[c, -s], [s, c]])",
        ),
    ),
    Slip(
        "minus-for-plus",
        "The frame's place is subtracted: what lies at the sensor's origin lies at its place in the "
        "robot's frame.",
        ("]]) + frame[:2]", "]]) - frame[:2]"),
    ),
    Slip(
        "empties-kept",
        "Readings of 0 mm are in your map, as points at the sensor's own place: they did not come back "
        "and are no points.",
        (BACK, "back = millimetres >= 0"),
        (BACK, "back = ~np.isnan(millimetres)"),
    ),
    Slip(
        "empties-only",
        "You keep what did not come back and drop the rest: the condition is turned.",
        (BACK, "back = millimetres == 0"),
    ),
    Slip(
        "near-ones-dropped",
        "Only 0 means that nothing came back. Readings of some millimetres, or of many metres, are "
        "readings.",
        (BACK, "back = millimetres > 1"),
        (BACK, "back = millimetres >= 200"),
        (BACK, "back = (millimetres > 0) & (millimetres < 12000)"),
    ),
    Slip(
        "degree-0-dropped",
        "A reading at 0° is a reading: it is the range that is 0 where nothing came back.",
        (BACK, "back = degrees * millimetres > 0"),
    ),
    Slip(
        "bearings-not-chosen",
        "The ranges that came back meet the bearings of other readings: leave out the same rows of both.",
        (BETA, "-np.radians(degrees[: back.sum()])"),
    ),
    Slip(
        "x-and-y-swapped",
        "x and y have changed places in the result.",
        (RESULT, RESULT + "[:, ::-1]"),
    ),
    Slip(
        "another-order",
        "The points are all there, but not in the order of the readings.",
        (RESULT, RESULT + "[::-1]"),
        (RESULT, f"found = {RESULT[7:]}\n    return found[np.argsort(found[:, 0])]"),
    ),
    Slip(
        "one-left-out",
        "The first or the last reading that came back is missing.",
        (RESULT, RESULT + "[:-1]"),
        (RESULT, RESULT + "[1:]"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        [
            (BACK, "back = degrees >= 0"),
            (R, "np.where(millimetres > 0, millimetres, np.nan) / 1000"),
        ],
        (RESULT, RESULT + ".T"),
        (RESULT, "carry(pose, carry(mount, in_sensor))"),
        (Q, "np.column_stack([r * np.cos(beta), r * np.sin(beta)]) + 0j"),
    ),
    Stumble(
        "raised",
        (MATRIX + " + frame[:2]", MATRIX + " + frame"),
        (BETA, "-np.radians(degrees)"),
    ),
)

EQUIVALENT = {}
