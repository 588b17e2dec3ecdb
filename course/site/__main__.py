"""Command ``python -m course.site``: build the site, then check it."""

import argparse
import sys
from pathlib import Path

from course.site import building, site_checks
from course.source import ROOT


def main(argv=None):
    """Run the command line and return its exit code."""
    parser = argparse.ArgumentParser(prog="python -m course.site", description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "site", help="where to (site/)")
    parser.add_argument("--lessons", nargs="*", help="whose films and sliders to render (all)")
    options = parser.parse_args(argv)
    print("building the site, which takes several minutes at first", file=sys.stderr)
    try:
        failed = building.build(options.out, rendered=options.lessons)
    except building.SiteError as error:
        print(error, file=sys.stderr)
        return 1
    problems = failed + site_checks.problems(options.out)
    print(*problems, sep="\n", end="\n" if problems else "", file=sys.stderr)
    print(f"{options.out}: {site_checks.size(options.out) / 1e6:.1f} MB, start at index.html")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
