"""Compare the layout faults found in the lessons' figures with the known ones.

    python -m course.known_figure_faults FILE

FILE is the file to which the notebooks wrote their faults (``SLAMLAB_FIGURE_FAULTS=FILE``).
``known_figure_faults.txt`` lists the known faults. A fault that this file does not list is an
error. A known fault that was not found is only reported, because it may depend on measured times.
"""

import sys
from pathlib import Path

KNOWN = Path(__file__).with_name("known_figure_faults.txt")


def compare(found, known):
    """Compare the faults found with the known faults.

    Parameters
    ----------
    found, known : iterables of str

    Returns
    -------
    list of str, the differences
    """
    found, known = set(found), set(known)
    new = [f"new: {fault}" for fault in sorted(found - known)]
    return new + [f"not found this time: {fault}" for fault in sorted(known - found)]


def main(argv=None):
    """Run the command line and return its exit code."""
    (path,) = sys.argv[1:] if argv is None else argv
    found = Path(path).read_text(encoding="utf-8").splitlines() if Path(path).exists() else []
    differs = compare(found, KNOWN.read_text(encoding="utf-8").splitlines())
    print(*differs, sep="\n", end="\n" if differs else "")
    return 1 if any(line.startswith("new: ") for line in differs) else 0


if __name__ == "__main__":
    sys.exit(main())
