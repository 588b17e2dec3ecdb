"""Formats of trajectory files, recognised by a header's column names or the number of columns."""

from slamlab.evaluation.text_table import named_columns
from slamlab.files import SourceError

TUM = ("t", "x", "y", "z", "qx", "qy", "qz", "qw")
EUROC = ("t", "x", "y", "z", "qw", "qx", "qy", "qz")
# 3 × 4, row by row
MATRIX = ("r00", "r01", "r02", "x", "r10", "r11", "r12", "y", "r20", "r21", "r22", "z")
FORMATS = (
    "a row of TUM has 8 numbers (timestamp tx ty tz qx qy qz qw), a row of KITTI 12 (a 3 × 4 "
    "matrix), a row of EuRoC 8 or more with commas (timestamp in nanoseconds, x, y, z, qw, qx, qy, "
    "qz); other columns need names in the first line, such as time,x,y,theta"
)
LATEST = 4.3e9  # largest timestamp in seconds since 1970 (2106)
BY_WIDTH = {
    8: ("TUM", TUM),
    12: ("KITTI", MATRIX),
    13: ("stamps and matrices of KITTI", ("t", *MATRIX)),
    16: ("4 × 4 matrices", MATRIX),
    17: ("stamps and 4 × 4 matrices", ("t", *MATRIX)),
}
_AXIS = (r"[tp]?{0}|pos{0}", r"(?:.*_)?(?:pos|position|pose|translation|trans|p|t)_(?:rs_r_)?{0}")
_QUATERNION = r"(?:.*_)?(?:q|quat|quaternion|orientation|rotation|rot)_?(?:rs_)?{0}"
NAMES = {
    "t": (r"(?:.*_)?header_stamp", r"t|times?|(?:.*_)?(?:timestamps?|time_stamps?|stamps?)"),
    "sec": (r"(?:.*_)?(?:secs?|seconds)",),
    "nsec": (r"(?:.*_)?(?:nsecs?|nanosecs?|nanoseconds)",),
    **{axis: tuple(e.format(axis) for e in _AXIS) for axis in "xyz"},
    **{f"q{part}": (_QUATERNION.format(part),) for part in "xyzw"},
    "theta": (r"(?:(?:pose|orientation|rotation|rpy|euler)_)?(?:theta|yaw|heading|psi|th)",),
}


def columns_of(table):
    """Return a TextTable's format in words, and {name: (column, factor to SI units or None)}."""
    for header in table.headers:
        found = named_columns(header, NAMES)
        if len(header.names) == table.width and _suffices(found):
            if any(name.startswith("field_") for name in header.names):  # as rostopic prints
                found["t"] = found["t"][0], 1e-9
            return f"a table whose columns are named in line {header.line}", found
    for header in table.headers:
        if not header.commented:
            raise SourceError(
                f"{table.path}, line {header.line}, read as the names of {table.width} columns: "
                f"{', '.join(header.names)[:200]}; the columns must be time, x, y and theta, or "
                "time, x, y, z, qx, qy, qz and qw; begin comments with #"
            )
    if table.commas and table.width >= 8 and table.start > LATEST:
        kind, names = "EuRoC", EUROC
    elif table.width in BY_WIDTH:
        kind, names = BY_WIDTH[table.width]
    else:
        raise SourceError(
            f"{table.path} has {table.width} numbers in a row, unlike any trajectory: {FORMATS}"
        )
    factors = {"t": 1e-9} if kind == "EuRoC" else {}
    return kind, {name: (i, factors.get(name)) for i, name in enumerate(names)}


def _suffices(found):
    """Whether the named columns define planar or 3-D poses with timestamps."""
    turned = "theta" in found or {"qx", "qy", "qz", "qw"} <= set(found)
    return turned and {"x", "y"} <= set(found) and bool({"t", "sec", "nsec"} & set(found))
