"""Run every benchmark of this folder: ``python -m benchmarks [--quick] [--json FILE]``."""

import importlib
import pkgutil
import sys

import benchmarks
from benchmarks.common import main

SHARED = {"common", "corrected_logs", "icp_peers", "__main__"}  # and what needs a folder


def found():
    """{title: run} of every benchmark module, by name."""
    names = sorted(m.name for m in pkgutil.iter_modules(benchmarks.__path__))
    modules = [importlib.import_module(f"benchmarks.{n}") for n in names if n not in SHARED]
    return {module.TITLE: module.run for module in modules}


if __name__ == "__main__":
    sys.exit(main(found(), "python -m benchmarks"))
