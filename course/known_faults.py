"""Faults of the lessons' figures, found as they are drawn, held against those that are known.

    python -m course.known_faults FILE

FILE is what ``SLAMLAB_FIGURE_FAULTS`` named while the notebooks ran; ``known_faults.txt`` lists
what is still to be mended. A fault that it does not list fails; one that is no longer there is told
(a figure of measured times may have it or not).
"""

import sys
from pathlib import Path

KNOWN = Path(__file__).with_name("known_faults.txt")


def compare(found, known):
    """Compare the faults found with those known.

    Parameters
    ----------
    found, known : iterables of str

    Returns
    -------
    list of str, what differs, in words
    """
    found, known = set(found), set(known)
    new = [f"new: {fault}" for fault in sorted(found - known)]
    return new + [f"not found this time: {fault}" for fault in sorted(known - found)]


def main(argv=None):
    """Run the command line; returns its exit code."""
    (path,) = sys.argv[1:] if argv is None else argv
    found = Path(path).read_text(encoding="utf-8").splitlines() if Path(path).exists() else []
    differs = compare(found, KNOWN.read_text(encoding="utf-8").splitlines())
    print(*differs, sep="\n", end="\n" if differs else "")
    return 1 if any(line.startswith("new: ") for line in differs) else 0


if __name__ == "__main__":
    sys.exit(main())
