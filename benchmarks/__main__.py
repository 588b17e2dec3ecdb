"""Run every benchmark of this folder: ``python -m benchmarks [--quick] [--json FILE]``. The last
table has the chief ratios."""

import importlib
import pkgutil
import sys

import benchmarks
from benchmarks.common import main, table
from benchmarks.summary import chief_rows, machine

SHARED = {"common", "icp_peers", "live_measures", "odometry_peers", "summary", "__main__"}
OF_A_FOLDER = {"corrected_logs"}  # needs one, of logs


def found():
    """Return {title: run} of every benchmark module, by name."""
    names = sorted(m.name for m in pkgutil.iter_modules(benchmarks.__path__))
    left_out = SHARED | OF_A_FOLDER
    modules = [importlib.import_module(f"benchmarks.{n}") for n in names if n not in left_out]
    return {module.TITLE: module.run for module in modules}


def show_chief(rows):
    """Print the table of the chief ratios."""
    table(f"Chief ratios on {machine()}", chief_rows(rows))


if __name__ == "__main__":
    sys.exit(main(found(), "python -m benchmarks", last=show_chief))
