"""Grading (autograding) of a class, compared with nbgrader and with a bare fork."""

import contextlib
import ctypes
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from benchmarks.common import Missing, main, row
from classroom.exercises import catalogue
from classroom.grading import notebooks, sandbox
from classroom.grading.forked_workers import modules_to_preload
from classroom.grading.gradebook import Gradebook
from classroom.grading.worker_client import WorkerClient
from classroom.grading.worker_pool import WorkerPool

TITLE = "Grading: a class with five tasks each, CPU and wall time of whole commands in turns"
ROOT = Path(__file__).resolve().parents[1]
NAME = "04_models_and_jacobians"
PEER, OURS = "nbgrader autograde", "slamlab grade"
CONFIG = """
c = get_config()
c.CourseDirectory.course_id = "slam"
c.ExecutePreprocessor.timeout = 300
c.ExecutePreprocessor.startup_timeout = 300
"""
SIZES = {PEER: (2, 6), OURS: (6, 106)}  # two classes: their difference is free of start-up
THOUSAND = 1000
SUBREAPER = 36  # prctl: orphans of children become this process', so that their CPU counts
SHARED_CLASS = 6


def derived(folder):
    """Return the text of the exercise's notebook in a folder of the project."""
    return (ROOT / folder / f"ex{NAME}.ipynb").read_text("utf-8")


def make_submissions(folder, count):
    """Make the submissions of a class: right solutions whose cells all differ."""
    text = derived("solutions")
    for i in range(count):
        place = folder / f"s{i:04}" / NAME
        place.mkdir(parents=True)
        own = text.replace("### BEGIN SOLUTION", f"# by {i}").replace("### END SOLUTION", "")
        (place / f"{NAME}.ipynb").write_text(own, "utf-8")


def timed(words, cwd):
    """Measure the CPU and wall time [s] of a command and its child processes."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    ctypes.CDLL(None).prctl(SUBREAPER, 1, 0, 0, 0)
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run(
        words, cwd=cwd, env=os.environ | {"PATH": path}, capture_output=True, text=True
    )
    wall = time.monotonic() - begin
    with contextlib.suppress(ChildProcessError):  # bubblewrap does not wait for what it started
        while True:
            os.wait()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise Missing(f"{' '.join(words[:4])} failed: {done.stderr.strip()[-300:]}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, wall


def nbgrader(count):
    """Grade one class by nbgrader; the time to create its course does not count."""
    try:
        import nbgrader  # noqa: F401
    except ImportError:
        raise Missing(
            "nbgrader, the peer, is not installed: python -m pip install nbgrader"
        ) from None
    with tempfile.TemporaryDirectory() as folder:
        course = Path(folder)
        (course / "nbgrader_config.py").write_text(CONFIG)
        source = course / "source" / NAME
        source.mkdir(parents=True)
        (source / f"{NAME}.ipynb").write_text(derived("exercises"), "utf-8")
        command = [sys.executable, "-m", "nbgrader"]
        timed([*command, "generate_assignment", NAME], course)
        make_submissions(course / "submitted", count)
        return timed([*command, "autograde", NAME], course)


def slamlab(count, jobs=1):
    """Grade one class by ``slamlab grade``, at the strictest isolation level available."""
    with tempfile.TemporaryDirectory() as folder:
        make_submissions(Path(folder, "class"), count)
        words = [sys.executable, "-c", "import sys; from slamlab.cli import main; sys.exit(main())"]
        words += ["grade", "class", "--out", "out", "--jobs", str(jobs)]
        words += ["--isolation", isolation_level()]
        spent = timed(words, folder)
        with Gradebook(f"sqlite:///{Path(folder, 'out', 'grades.db')}") as book:
            records = book.latest_attempts()
    full = catalogue.exercise("04").points
    if len(records) != count or any(record.score != full for record in records):
        raise Missing("a right solution did not get full marks, so there is nothing to compare")
    return spent, [record.seconds for record in records]


def isolation_level():
    """Return the strictest isolation level available on this system."""
    from classroom.grading import isolation

    return sandbox.STRICT if isolation.missing_requirement(sandbox.STRICT) is None else sandbox.NONE


def fork_floor(count):
    """Measure a lower bound: Measure the CPU time of a forked worker that only runs the cells
    [s]."""
    data = derived("solutions").encode()
    content, named = notebooks.parse(data), modules_to_preload([data])
    exercise, spent = catalogue.exercise("04"), []
    with WorkerPool(isolation_level(), preload=named) as workers:
        for _ in range(count):
            with WorkerClient(exercise, content.cells, workers.start) as client:
                client.load()
            spent.append(client.cpu)
    return statistics.median(spent)


def memory_of(process, stop, found):
    """Record the memory of a process and its descendants [bytes]; shared pages count once."""
    while not stop.wait(0.25):
        children = {}
        for path in Path("/proc").glob("[0-9]*/stat"):
            try:
                fields = path.read_text().rsplit(")", 1)[1].split()
            except OSError:
                continue
            children.setdefault(int(fields[1]), []).append(int(path.parent.name))
        waiting, total = [process], 0
        while waiting:
            pid = waiting.pop()
            waiting += children.get(pid, [])
            try:
                text = Path(f"/proc/{pid}/smaps_rollup").read_text()
            except OSError:
                continue
            total += sum(int(s.split()[1]) << 10 for s in text.splitlines() if s.startswith("Pss:"))
        found.append(total)


def thousand():
    """Measure wall time [s] and memory [bytes] of a thousand submissions on two cores."""
    stop, found = threading.Event(), []
    watcher = threading.Thread(target=memory_of, args=(os.getpid(), stop, found))
    watcher.start()
    try:
        (_, wall), _ = slamlab(THOUSAND, jobs=2)
    finally:
        stop.set()
        watcher.join()
    return wall, max(found, default=0)


def run(quick):
    """Make rows for CPU and wall time, stages and the lower bound."""
    turns = 1 if quick else 3
    spent = {name: {size: [] for size in sizes} for name, sizes in SIZES.items()}
    shared, stages = [], []
    for _ in range(turns):
        for size in SIZES[PEER]:
            spent[PEER][size].append(nbgrader(size))
        for size in SIZES[OURS]:
            both, seconds = slamlab(size)
            spent[OURS][size].append(both)
            stages += seconds
        shared.append((spent[PEER][SHARED_CLASS][-1], spent[OURS][SHARED_CLASS][-1]))
    rows = []
    for k, kind in enumerate(("CPU", "wall")):
        theirs, ours = (
            statistics.median(s[who][k] for s in shared) / SHARED_CLASS for who in (0, 1)
        )
        label = f"{kind}, class of {SHARED_CLASS}, a submission"
        rows.append(row(f"{label}: {PEER}", theirs, "s", PEER, 1))
        rows.append(row(f"{label}: {OURS}", ours, "s", PEER, theirs / ours))
        each = {}
        for name, (small, large) in SIZES.items():
            two = (statistics.median(t[k] for t in spent[name][size]) for size in (small, large))
            each[name] = -(next(two) - next(two)) / (large - small)
        for name in SIZES:
            label = f"{kind}, each further submission: {name}"
            rows.append(row(label, each[name], "s", PEER, each[PEER] / each[name]))
    least = fork_floor(5 if quick else 30)
    for stage in ("worker_cpu", "judge_cpu"):
        value = statistics.median(s[stage] for s in stages)
        rows.append(
            row(f"CPU of a submission: {stage[:-4]}", value, "s", "fork and cells", least / value)
        )
    rows.append(row("CPU of a submission: fork and cells", least, "s", "fork and cells", 1))
    if not quick:
        wall, memory = thousand()
        rows.append(row("1000 submissions, 2 jobs", wall, "s", "30 s", 30 / wall))
        rows.append(row("their memory", memory / 2**20, "MiB", "500 MiB", 500 * 2**20 / memory))
    return rows


if __name__ == "__main__":
    if not shutil.which("bwrap"):
        print("bubblewrap is not installed: grading without the strict sandbox", file=sys.stderr)
    sys.exit(main({TITLE: run}, "python -m benchmarks.grading"))
