"""Summary of the benchmarks: the chief ratios in one table, which the README quotes.

``python -m benchmarks.summary FILE …`` writes the table of results (``--json``) into the README.
"""

import json
import os
import platform
import sys
from pathlib import Path

import numpy as np
import scipy

from benchmarks import montecarlo
from benchmarks.common import row

README = Path(__file__).resolve().parents[1] / "README.md"
BEGIN, END = "<!-- benchmarks: python -m benchmarks -->\n", "<!-- end of benchmarks -->\n"
CHIEF = (  # what is shown, the peer, and the row's name and reference
    ("EKF-SLAM, one step, 200 landmarks", "filterpy", "N = 200: slamlab", "filterpy EKF"),
    ("EKF-SLAM, one step, 1000 landmarks", "textbook", "N = 1000: slamlab", "textbook dense EKF"),
    (
        "compressed EKF, one step, 2000 landmarks",
        "a copy of P",
        "N = 2000: slamlab, compressed",
        "np.copyto(P)",
    ),
    ("scan matching, one match", "the thesis' ICP", "a match: match", "thesis' ICP"),
    ("scan matching, one match", "small_gicp", "a match: match", "small_gicp ICP"),
    (
        "ray casting, 400 beams, 1000 walls",
        "a Python loop",
        "400 beams, 1000 walls: slamlab",
        "Python loop",
    ),
    (
        "particle filter, 10 000 particles",
        "a Python loop",
        f"{montecarlo.SIZES[-1]} particles: slamlab",
        "plain Python loop",
    ),
    ("reading the pose graph city10000", "GTSAM", "city10000: reading: slamlab", "GTSAM"),
    ("optimising the pose graph city10000", "GTSAM", "city10000: optimising: slamlab", "GTSAM"),
    ("optimising the pose graph manhattan", "GTSAM", "manhattan: optimising: slamlab", "GTSAM"),
    ("optimising the pose graph intel", "GTSAM", "intel: optimising: slamlab", "GTSAM"),
    (
        "intel with 10 to 1000 random false loops",
        "GTSAM's GNC",
        "intel, random false loops: slamlab",
        "GTSAM's GNC",
    ),
)


def machine():
    """Describe the machine and the versions in one line."""
    model = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.is_file():
        names = [line for line in info.read_text("utf-8").splitlines() if "model name" in line]
        model = names[0].partition(":")[2].strip() if names else model
    versions = f"NumPy {np.__version__}, SciPy {scipy.__version__}"
    python = f"{platform.system()}, Python {platform.python_version()}"
    return f"{model}, {os.cpu_count()} cores, {python}, {versions}"


def chief_rows(rows):
    """Select the chief rows, as rows named for the reader; those that were not measured are left
    out, and named on stderr."""
    found = {(one["name"], one["reference"]): one for one in rows}
    chief = []
    for what, peer, name, to in CHIEF:
        if one := found.get((name, to)):
            chief.append(row(what, one["value"], one["unit"], peer, one["ratio"]))
        else:
            print(f"not measured: {what}, compared with {peer}", file=sys.stderr)
    return chief


def markdown(rows):
    """Return the table of some rows as Markdown, with the machine named."""
    heads = "what", "compared with", "time", "times as fast (below 1: slower)"
    lines = [f"| {' | '.join(heads)} |", "|" + " --- |" * len(heads)]
    for one in chief_rows(rows):
        value, ratio = (float(f"{one[key]:.2g}") for key in ("value", "ratio"))
        lines.append(
            f"| {one['name']} | {one['reference']} | {value:g} {one['unit']} | {ratio:g} |"
        )
    return "\n".join([*lines, "", f"Machine: {machine()}.", ""])


def write(rows, readme=README):
    """Replace the table in the README. Raises ValueError if it has no marks."""
    text = readme.read_text("utf-8")
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not (begin and end):
        raise ValueError(f"{readme} has no line {BEGIN.strip()!r} before {END.strip()!r}")
    readme.write_text(before + BEGIN + "\n" + markdown(rows) + "\n" + END + after, "utf-8")


if __name__ == "__main__":
    write([one for name in sys.argv[1:] for one in json.loads(Path(name).read_text("utf-8"))])
