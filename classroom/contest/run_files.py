"""Save each run in a file, so that an interrupted contest can be resumed."""

import json
import os
import zipfile

import numpy as np

from classroom.grading.records import private_folder
from classroom.project.estimator_runs import EstimatorRun

ARRAYS = ("online", "covariances", "trajectory", "points")


def write_run(file, run):
    """Write an EstimatorRun atomically."""
    private_folder(file.parent)
    record = json.dumps({"mistakes": run.mistakes, "seconds": run.seconds, "late": run.late})
    partial = file.with_name(f".{file.name}.part")
    with open(partial, "wb") as opened:
        arrays = {name: getattr(run, name) for name in ARRAYS}
        np.savez_compressed(opened, **arrays, **{"told": np.array(record)})
    os.replace(partial, file)


def read_run(file):
    """Read an EstimatorRun, or return None if the file is missing or damaged."""
    try:
        with np.load(file, allow_pickle=False) as found:
            record = json.loads(str(found["told"]))
            arrays = {name: found[name] for name in ARRAYS}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    return EstimatorRun(**arrays, mistakes=tuple(record["mistakes"]), seconds=record["seconds"],
                 late=record["late"])  # fmt: skip


def run_ended_by_time_limit(count):
    """Return a run stopped by a time limit in an earlier judging; only its points are known."""
    nothing = np.full((count, 3), np.nan)
    ended = ("a time limit ended this run in the first judging; its points are reused",)
    unknown = np.full((count, 3, 3), np.nan)
    return EstimatorRun(nothing, unknown, nothing, np.empty((0, 2)), ended, 0.0, late=True)
