"""``python -m slamlab.studies.arena_logs FOLDER``: the six data sets, as log files (readings).

They are drives of fixed seeds, so whoever writes them writes the same; ``slamlab run`` reads them.
"""

import argparse
import sys
from pathlib import Path

from slamlab import sources
from slamlab.sources.arena_runs import SETS, data_set


def main(argv=None):
    """The command: write the data sets; 0 when written, 2 when the folder cannot be had."""
    command = argparse.ArgumentParser(prog="python -m slamlab.studies.arena_logs")
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
