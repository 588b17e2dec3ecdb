"""Parallel Monte Carlo runs: on a process pool of this machine, or on a Dask cluster."""

import multiprocessing
import os
import signal
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial

# environment variables of BLAS and OpenMP; one run a core: its threads would only fight for it
THREAD_VARIABLES = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)


class RunError(RuntimeError):
    """A parallel run failed; the text names its seed and what went wrong."""


def map_runs(function, seeds, jobs=None, scheduler=None):
    """Map a function over seeds in parallel; results in the order of the seeds.

    Parameters
    ----------
    function : callable(seed), importable by name: other processes have to find it
    seeds : iterable of int
    jobs : int, processes to use, every core by default; 1 runs them here, one after the other
    scheduler : str, address of a Dask scheduler, such as tcp://host:8786, in place of processes

    Returns
    -------
    list

    Raises
    ------
    RunError : a run failed, or the cluster cannot be used
    ValueError : jobs below 1
    """
    seeds = list(seeds)
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs is the number of processes, at least 1, not {jobs}")
    named = partial(_run_seed, function)
    if scheduler is not None:
        return _on_cluster(named, seeds, scheduler)
    jobs = min(jobs or os.cpu_count() or 1, len(seeds))
    if jobs <= 1:
        return [named(seed) for seed in seeds]
    return _on_processes(named, seeds, jobs)


def _run_seed(function, seed):
    """Run one seed; an error names it."""
    try:
        return function(seed)
    except Exception as error:
        raise RunError(f"run with seed {seed}: {type(error).__name__}: {error}") from error


def _on_processes(function, seeds, jobs):
    # spawned, not forked: the same on every system, and BLAS reads its threads at its start
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context, initializer=_default_sigint) as pool:
        try:
            with _single_threaded(), _sigint_blocked():
                futures = [pool.submit(function, seed) for seed in seeds]
            return [future.result() for future in futures]
        except BaseException:  # an interrupt too: what has not begun is not begun
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _default_sigint():
    """Worker initialiser: Ctrl-C reaches every process; a worker just ends, without a traceback."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])


@contextmanager
def _sigint_blocked():
    """Block SIGINT (Ctrl-C) until the processes are started, and in them until they can take it.

    Where signals cannot be held (Windows), one in that moment shows a traceback more.
    """
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
    """Single-threaded BLAS: processes started meanwhile compute on one thread each."""
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
        from distributed import Client
    except ImportError:
        raise RunError(
            'a scheduler needs Dask, which is not installed: pip install "slamlab[dask]"'
        ) from None
    try:
        client = Client(scheduler, timeout="10s")
    except (OSError, ValueError) as error:
        raise RunError(f"no Dask scheduler answers at {scheduler}: {error}") from None
    with client:
        futures = client.map(function, seeds, pure=False)
        try:
            return client.gather(futures)
        except BaseException:
            client.cancel(futures)
            raise
