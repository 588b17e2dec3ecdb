"""Many independent runs: on processes of this machine, or the same function on a Dask cluster."""

import multiprocessing
import os
import signal
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial

# one run a core: threads inside a run would only fight for it
THREADS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)


class RunError(RuntimeError):
    """A run failed; the text names its seed and what went wrong."""


def map_runs(function, seeds, jobs=None, scheduler=None):
    """What a function gives for each seed, in the order of the seeds.

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
    named = partial(_named, function)
    if scheduler is not None:
        return _on_cluster(named, seeds, scheduler)
    jobs = min(jobs or os.cpu_count() or 1, len(seeds))
    if jobs <= 1:
        return [named(seed) for seed in seeds]
    return _on_processes(named, seeds, jobs)


def _named(function, seed):
    """Run; a failure says of which seed."""
    try:
        return function(seed)
    except Exception as error:
        raise RunError(f"run with seed {seed}: {type(error).__name__}: {error}") from error


def _on_processes(function, seeds, jobs):
    # spawned, not forked: the same on every system, and BLAS reads its threads at its start
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context, initializer=_die_quietly) as pool:
        try:
            with _one_thread(), _interrupts_held():
                futures = [pool.submit(function, seed) for seed in seeds]
            return [future.result() for future in futures]
        except BaseException:  # an interrupt too: what has not begun is not begun
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _die_quietly():
    """Ctrl-C reaches every process: one that works for another just ends, without a traceback."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])


@contextmanager
def _interrupts_held():
    """Ctrl-C waits until the processes are on their way, and in them until they can take it.

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
def _one_thread():
    """Processes started meanwhile compute on one thread each."""
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update(dict.fromkeys(THREADS, "1"))
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
