"""Parallel runs: the same results in the same order everywhere, failures named by their seed."""

import os
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest

from slamlab.parallel import THREAD_VARIABLES, RunError, map_runs
from tests.timeouts import PATIENCE

SEEDS = [5, 3, 8, 1]


def draw(seed):
    return np.random.default_rng(seed).normal(size=3)


def fails_at_three(seed):
    if seed == 3:
        raise ZeroDivisionError("no such luck")
    return seed


def surroundings(seed):
    return os.getpid(), {name: os.environ.get(name) for name in THREAD_VARIABLES}


@pytest.mark.parametrize("jobs", [1, 2])
def test_results_stand_in_the_order_of_the_seeds(jobs):
    results = map_runs(draw, SEEDS, jobs=jobs)
    np.testing.assert_array_equal(results, [draw(seed) for seed in SEEDS])


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_failure_names_its_seed_and_what_went_wrong(jobs):
    with pytest.raises(RunError, match="seed 3: ZeroDivisionError: no such luck"):
        map_runs(fails_at_three, SEEDS, jobs=jobs)


def test_runs_are_in_processes_of_their_own_with_one_thread_each(monkeypatch):
    monkeypatch.setenv(THREAD_VARIABLES[0], "7")
    monkeypatch.delenv(THREAD_VARIABLES[1], raising=False)
    for process, threads in map_runs(surroundings, SEEDS, jobs=2):
        assert process != os.getpid()
        assert set(threads.values()) == {"1"}
    assert os.environ[THREAD_VARIABLES[0]] == "7"
    assert THREAD_VARIABLES[1] not in os.environ


@pytest.fixture(scope="module")
def cluster():
    from distributed import LocalCluster

    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        yield cluster.scheduler_address


@pytest.mark.slow
def test_a_cluster_gives_what_processes_give_and_names_failures_too(cluster):
    np.testing.assert_array_equal(map_runs(draw, SEEDS, scheduler=cluster), map_runs(draw, SEEDS))
    with pytest.raises(RunError, match="seed 3: ZeroDivisionError: no such luck"):
        map_runs(fails_at_three, SEEDS, scheduler=cluster)


def test_a_scheduler_that_is_none_is_refused_in_one_line():
    with pytest.raises(RunError, match="the Dask scheduler at nonsense does not answer"):
        map_runs(draw, SEEDS, scheduler="nonsense")


def test_without_dask_a_scheduler_is_refused_with_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(RunError, match=r"slam-course-lab\[cluster\]"):
        map_runs(draw, SEEDS, scheduler="tcp://localhost:1")


def test_no_seeds_are_no_runs_and_no_jobs_are_refused():
    assert map_runs(draw, []) == []
    with pytest.raises(ValueError, match="at least 1"):
        map_runs(draw, SEEDS, jobs=0)


@pytest.mark.skipif(os.name != "posix", reason="a terminal's interrupt is sent the POSIX way")
def test_an_interrupt_ends_it_at_once_and_leaves_no_process(tmp_path):
    (tmp_path / "sleeps.py").write_text(
        textwrap.dedent("""
            import os, sys, time
            from pathlib import Path
            from slamlab.parallel import map_runs

            def sleep(seed):
                Path(f"{os.getpid()}.started").touch()
                time.sleep(0.5)

            if __name__ == "__main__":
                try:
                    map_runs(sleep, range(500), jobs=2)
                except KeyboardInterrupt:
                    sys.exit(130)
        """)
    )
    study = subprocess.Popen(
        [sys.executable, "sleeps.py"],
        cwd=tmp_path,
        start_new_session=True,
        stderr=subprocess.PIPE,
        text=True,
    )
    deadline = time.monotonic() + PATIENCE
    while not list(tmp_path.glob("*.started")) and time.monotonic() < deadline:
        time.sleep(0.1)
    os.killpg(study.pid, signal.SIGINT)  # what a terminal's Ctrl-C does: all of them get it
    try:
        _, output = study.communicate(timeout=PATIENCE)
    finally:
        study.kill()
    assert study.returncode == 130
    assert "Traceback" not in output
    for started in tmp_path.glob("*.started"):
        with pytest.raises(ProcessLookupError):
            os.kill(int(started.stem), 0)
