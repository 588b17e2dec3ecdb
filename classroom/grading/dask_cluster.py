"""Distributed grading on a Dask cluster. Each machine runs student code in its own sandbox and
receives the secret. Use TLS and trusted machines only.
"""

import functools
import tempfile
from dataclasses import replace
from pathlib import Path

from classroom.grading import judge
from classroom.grading.batch import attempts_by_submission
from classroom.grading.submissions import MAX_NOTEBOOK_BYTES
from classroom.grading.worker_pool import WorkerPool
from slamlab.parallel import map_runs

CHUNK = 64  # jobs sent at a time; their results are stored before further jobs are sent


def grade_on_cluster(scheduler, found, secret, level, default=None, known=None):
    """Yield records as they arrive; each machine tests the isolation level. Raises RunError."""
    mine = attempts_by_submission(known)
    for start in range(0, len(found), CHUNK):
        chunk = found[start : start + CHUNK]
        jobs = [_Job(s, secret, level, default, mine.get(s.name)) for s in chunk]
        yield from map_runs(_Job.run, jobs, scheduler=scheduler)


class _Job:
    """A job that grades one submission; its ``repr`` does not show the secret."""

    def __init__(self, submission, secret, level, default, known):
        self.submission, self.secret = submission, secret
        self.level, self.default, self.known = level, default, known
        self.handed_in, self.content = submission.handed_in, None
        if submission.problem is None and submission.path.is_file():
            with open(submission.path, "rb") as file:
                self.content = file.read(MAX_NOTEBOOK_BYTES + 1)

    def __repr__(self):
        return self.submission.name

    def run(self):
        workers = _workers(self.level)
        with tempfile.TemporaryDirectory(prefix="slamlab-job-") as folder:
            path = Path(folder, "submission.ipynb")
            if self.content is not None:
                path.write_bytes(self.content)
            here = replace(self.submission, path=path)
            record = judge.grade_submission(here, self.secret, workers, self.default, self.known)
        return replace(record, handed_in=self.handed_in)


@functools.cache
def _workers(level):
    """Return this machine's worker pool; the first call creates it and tests the sandbox."""
    from classroom.grading import isolation

    isolation.ensure_level(level)
    return WorkerPool(level)
