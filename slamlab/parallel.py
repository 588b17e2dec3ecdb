"""Parallel Monte Carlo trials (runs) in a process pool on this machine or on a Dask cluster."""

import multiprocessing
import os
import signal
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial

from slamlab.extras import ExtraMissing, needs

# environment variables of BLAS and OpenMP: each run uses one core and one thread
THREAD_VARIABLES = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)


class RunError(RuntimeError):
    """A parallel run failed; the message contains the seed and the error."""


def map_runs(function, seeds, jobs=None, scheduler=None):
    """Map a function over seeds in parallel and return the results in the order of the seeds.

    function : importable by name; jobs : number of processes, by default one per core (1: only this
    process); scheduler : Dask scheduler, such as tcp://host:8786. Raises RunError, ValueError.
    """
    seeds = list(seeds)
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs, the number of processes, must be at least 1, not {jobs}")
    named = partial(_run_seed, function)
    if scheduler is not None:
        return _on_cluster(named, seeds, scheduler)
    jobs = min(jobs or os.cpu_count() or 1, len(seeds))
    if jobs <= 1:
        return [named(seed) for seed in seeds]
    return _on_processes(named, seeds, jobs)


def _run_seed(function, seed):
    try:
        return function(seed)
    except Exception as error:
        raise RunError(f"run with seed {seed}: {type(error).__name__}: {error}") from error


def _on_processes(function, seeds, jobs):
    # spawn, not fork: the same on every system, and BLAS reads the number of threads at its start
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context, initializer=_default_sigint) as pool:
        try:
            with _single_threaded(), _sigint_blocked():
                futures = [pool.submit(function, seed) for seed in seeds]
            return [future.result() for future in futures]
        except BaseException:  # also after an interrupt, pending runs are cancelled
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _default_sigint():
    """Initialise a worker process so that Ctrl-C ends the process without a traceback."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])


@contextmanager
def _sigint_blocked():
    """Block SIGINT until the processes run. Windows cannot block SIGINT."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _single_threaded():
    """Limit each process that is started in this context to one BLAS thread."""
    before = {name: os.environ.get(name) for name in THREAD_VARIABLES}
    os.environ.update(dict.fromkeys(THREAD_VARIABLES, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _on_cluster(function, seeds, scheduler):
    try:
        with needs("cluster"):
            from distributed import Client
    except ExtraMissing as error:
        raise RunError(str(error)) from None
    try:
        client = Client(scheduler, timeout="10s")
    except (OSError, ValueError) as error:
        raise RunError(f"the Dask scheduler at {scheduler} does not answer: {error}") from None
    with client:
        futures = client.map(function, seeds, pure=False)
        try:
            return client.gather(futures)
        except BaseException:
            client.cancel(futures)
            raise
