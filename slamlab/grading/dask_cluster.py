"""Distributed grading on a Dask cluster: a submission's bytes go out, its record comes back.

The cluster's machines run student code in their own sandbox and see the secret: use TLS, and
workers you trust.
"""

import functools
import tempfile
from dataclasses import replace
from pathlib import Path

from slamlab.grading import judge
from slamlab.grading.batch import attempts_of_each
from slamlab.grading.submissions import MAX_NOTEBOOK_BYTES
from slamlab.grading.worker_pool import WorkerPool
from slamlab.parallel import map_runs

CHUNK = 64  # jobs sent at a time: what is back is written before more go out


def grade_on_cluster(scheduler, found, secret, level, default=None, known=None):
    """Grade submissions on a Dask cluster and yield records as they come back.

    Parameters
    ----------
    scheduler : str, such as tls://host:8786
    found : list of Submission
    secret : bytes
    level : str, of isolation, tested on every machine
    default : str or None, the exercise that all are to be of
    known : attempt's key to Record

    Yields
    ------
    Record

    Raises
    ------
    RunError : no scheduler answers, or a machine of the cluster was lost
    """
    mine = attempts_of_each(known)
    for start in range(0, len(found), CHUNK):
        chunk = found[start : start + CHUNK]
        jobs = [_Job(s, secret, level, default, mine.get(s.name)) for s in chunk]
        yield from map_runs(_Job.run, jobs, scheduler=scheduler)


class _Job:
    """A job: one submission; its ``repr`` does not show the secret."""

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
        """The record of the submission, made on a machine of the cluster."""
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
    """This machine's worker pool; the sandbox is tested once."""
    from slamlab.grading import isolation

    isolation.ensure_level(level)
    return WorkerPool(level)
