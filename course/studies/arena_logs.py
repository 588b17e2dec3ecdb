"""``python -m course.studies.arena_logs FOLDER``: write the six data sets of the MAK thesis,
simulated with fixed seeds, as logs for ``slamlab run``."""

import argparse
import sys
from pathlib import Path

from slamlab import sources
from slamlab.sources.arena_runs import SETS, data_set


def main(argv=None):
    command = argparse.ArgumentParser(prog="python -m course.studies.arena_logs")
    command.add_argument("folder", type=Path, metavar="FOLDER")
    folder = command.parse_args(argv).folder
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for seed, snagged in SETS:
            source = data_set(seed, snagged)
            path = folder / f"arena-{seed}{'-snagged' if snagged else ''}.log.gz"
            print(f"{sources.write(source, path)} readings written to {path}")
    except (OSError, sources.SourceError) as error:
        print(f"{command.prog}: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
