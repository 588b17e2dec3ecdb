"""A trajectory in the formats of other programs."""

import warnings

import numpy as np

from slamlab.evaluation import load_trajectory
from slamlab.readings import Trajectory
from tests.property_testing import assert_same_pose

COUNT = 40
TIMES = 0.1 * np.arange(COUNT) + 3.0
THETA = np.linspace(0.3, 4.5, COUNT)  # past half a turn
X, Y = np.cumsum(0.1 * np.cos(THETA)), np.cumsum(0.1 * np.sin(THETA))
TRUTH = Trajectory(TIMES, np.column_stack([X, Y, THETA]))
EPOCH = 1_403_636_579
S, C, O = np.sin(THETA / 2), np.cos(THETA / 2), np.zeros(COUNT)
TUM = (TIMES, X, Y, O, O, O, S, C)
EUROC = "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], " + (
    "q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1], b_w_RS_S_x [rad s^-1]\n"
)
ROSTOPIC = "%time,field.header.seq,field.header.stamp,field.header.frame_id," + ",".join(
    [f"field.pose.pose.position.{axis}" for axis in "xyz"]
    + [f"field.pose.pose.orientation.{axis}" for axis in "xyzw"]
    + ["field.twist.twist.linear.x"]
)
CAMERA = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])  # its axes in those of a robot


def table(columns, separator=" ", end="\n", number=repr):
    """Rows of numbers, of words or of both."""
    rows = zip(
        *(c if isinstance(c, list) else np.asarray(c).tolist() for c in columns), strict=True
    )
    return "".join(
        separator.join(v if isinstance(v, str) else number(v) for v in row) + end for row in rows
    )


def with_decimal_comma(value):
    return repr(value).replace(".", ",")


def nanoseconds(epoch):
    return [str(epoch * 10**9 + round(t * 1e9)) for t in TIMES]


def matrices(axes=None, scale=1.0):
    """The poses as 3 × 4 matrices, of a robot or of a camera."""
    axes = np.eye(3) if axes is None else axes
    for x, y, theta in TRUTH.poses:
        c, s = np.cos(theta), np.sin(theta)
        R = axes.T @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ axes
        yield np.column_stack([scale * R, axes.T @ [x, y, 0]]).ravel()


def kitti(axes=None, scale=1.0):
    return table(np.array(list(matrices(axes, scale))).T)


def read(tmp_path, content, name="trajectory"):
    """Read the trajectory of a file, and its warnings."""
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = load_trajectory(path)
    return found, " ".join(str(one.message) for one in caught)


def assert_is_the_truth(found, offset=0.0):
    np.testing.assert_allclose(found.times, TIMES + offset, rtol=0, atol=1e-6)
    assert_same_pose(found.poses, TRUTH.poses, 1e-9)


HEADED = {
    "tum": "# timestamp tx ty tz qx qy qz qw\n" + table(TUM),
    "tum without #": "timestamp,tx,ty,tz,qx,qy,qz,qw\n" + table(TUM, ","),
    "several comments": "# ground truth\n# file: 'a, b.bag'\n# timestamp tx ty\n" + table(TUM),
    "comments within": table(TUM).replace("\n3.5", "\n# half\n\n3.5"),
    "comments of other programs": "// by a mapper\n" + table(TUM, ", "),
    "a unit in a row of its own": "time,x,y,z,qx,qy,qz,qw\ns,m,m,m,,,,\n" + table(TUM, ","),
    "quaternion first": "#timestamp,qx,qy,qz,qw,px,py,pz\n"
    + table((TIMES, O, O, S, C, X, Y, O), ","),
    "w first": "t x y z qw qx qy qz\n" + table((TIMES, X, Y, O, C, O, O, S)),
    "a counter first": "num,t,x,y,z,qx,qy,qz,qw\n" + table((np.arange(COUNT), *TUM), ","),
    "seconds and nanoseconds": "#sec,nsec,x,y,z,qx,qy,qz,qw\n"
    + table((np.floor(TIMES), np.round(TIMES % 1 * 1e9), *TUM[1:]), ","),
    "planar": "time,x,y,theta,naive_x,naive_y,naive_theta\n"
    + table((TIMES, X, Y, THETA, O, O, O), ","),
    "degrees and millimetres": "time [s];x [mm];y [mm];yaw [deg]\n"
    + table((TIMES, 1e3 * X, 1e3 * Y, np.degrees(THETA)), ";"),
    "units as suffixes": "time_ms x_cm y_cm heading_deg\n"
    + table((1e3 * TIMES, 1e2 * X, 1e2 * Y, np.degrees(THETA))),
    "roll, pitch, yaw": "# timestamp x y z roll pitch yaw\n" + table((TIMES, X, Y, O, O, O, THETA)),
    "rostopic": ROSTOPIC
    + "\n"
    + table(
        (nanoseconds(5), np.arange(COUNT), nanoseconds(0), ["odom"] * COUNT, *TUM[1:], O + 9), ","
    ),
    "pandas": ",time,x,y,theta\n" + table((np.arange(COUNT), TIMES, X, Y, THETA), ","),
    "quoted": '"time","x","y","theta"\n'
    + table([[f'"{v!r}"' for v in column.tolist()] for column in (TIMES, X, Y, THETA)], ","),
    "euroc": EUROC + table((nanoseconds(0), X, Y, O, C, O, O, S, O + 5, O + 5), ","),
}
SEPARATED = {
    "blanks": table(TUM),
    "tabs": table(TUM, "\t"),
    "commas": table(TUM, ","),
    "semicolons": table(TUM, ";"),
    "decimal commas between blanks": table(TUM, number=with_decimal_comma),
    "decimal commas between semicolons": table(TUM, ";", number=with_decimal_comma),
    "a separator at the end": table(TUM, ",", end=",\n"),
    "a blank at the end": table(TUM, end=" \n"),
    "CRLF": table(TUM, end="\r\n"),
    "exponents": table(TUM, number="{:.17e}".format),
}
