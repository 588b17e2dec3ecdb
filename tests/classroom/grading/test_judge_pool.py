"""Judge processes make the same records as one judge; killing one of them loses nothing."""

import os
import signal
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from classroom.grading import batch, judge_pool, sandbox
from classroom.grading.gradebook import Gradebook
from classroom.grading.judge_pool import JudgePool
from classroom.grading.submissions import Submission
from classroom.grading.worker_pool import CAN_FORK, WorkerPool
from slamlab.parallel import RunError
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, slamlab, workers
from tests.timeouts import until

SECRET = b"0123456789abcdef"
HANGS = "while True:\n    try:\n        while True: pass\n    except BaseException: pass"
pytestmark = pytest.mark.skipif(not CAN_FORK, reason="judges are forked on Linux only")


def class_of(folder, *texts):
    folder.mkdir(parents=True)
    found = []
    for k, text in enumerate(texts):
        path = folder / f"{k}.ipynb"
        path.write_text(text, "utf-8")
        found.append(Submission(path.name, f"{k}", path))
    return found


def two():
    return JudgePool(2, SECRET, WorkerPool(workers().level, warm=False), "99")


def children(pid):
    try:
        return [
            int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
        ]
    except OSError:  # it is gone meanwhile
        return []


def below(pid):
    """All processes below one."""
    return [each for child in children(pid) for each in (child, *below(child))]


def gone(pid):
    """Whether a process has ended, be it waited for or not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def records(judging, found, known=None):
    with judging:
        made = list(batch.grade_locally(found, judging, known or {}))
    return sorted(made, key=lambda record: record.submission)


def test_several_judges_make_the_same_records_as_one_and_known_attempts_are_kept(tmp_path):
    texts = [notebook(fake.SOLUTION, f"x = {k}") for k in range(3)]
    found = class_of(tmp_path / "class", *texts, "", "{")
    alone = JudgePool(1, SECRET, WorkerPool(workers().level, warm=False), "99")
    first, other = records(two(), found), records(alone, found)
    assert [replace(r, seconds={}) for r in first] == [replace(r, seconds={}) for r in other]
    known = {
        judge_pool.judge.attempt_key(r.submission, r.sha256, r.seed): replace(
            r, seconds={"marked": 1.0}
        )
        for r in first[:3]
    }
    again = records(two(), found[:3], known)
    assert [r.seconds for r in again] == [{"marked": 1.0}] * 3


def test_a_judge_that_is_killed_ends_the_run_in_a_line(tmp_path):
    found = class_of(tmp_path / "class", *[notebook(fake.SOLUTION)] * 4)
    with two() as judging:
        for process in judging._processes:
            os.kill(process._process.pid, signal.SIGKILL)
        with pytest.raises(RunError, match="was killed"):
            list(batch.grade_locally(found, judging))


def grade(folder, *words, level=None, **more):
    words = "--out", folder / "out", "--isolation", level or workers().level, *words
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return slamlab("grade", folder / "class", *words, **pipes, **more)


def running(folder, level=None):
    """A command that grades by two judges, one of them a notebook that hangs; its processes."""
    words = "--exercise", "04", "--jobs", "2"
    grading = grade(folder, *words, level=level, env=os.environ | {"TMPDIR": str(folder)})
    level = level or workers().level
    forked = 4 if level == sandbox.STRICT else 2  # bubblewrap twice, zygote, worker
    until(lambda: any(len(below(judge)) == forked for judge in judges_of(grading)))
    return grading, below(grading.pid)


def judges_of(grading):
    """The judges of a running command: processes that are called as itself."""
    called = Path(f"/proc/{grading.pid}/cmdline").read_bytes()
    return [p for p in children(grading.pid) if Path(f"/proc/{p}/cmdline").read_bytes() == called]


SLOW = [pytest.param(sent, marks=pytest.mark.slow) for sent in ("SIGHUP", "SIGINT")]


@pytest.mark.parametrize("level", [None, pytest.param(sandbox.NONE, marks=pytest.mark.slow)])
@pytest.mark.parametrize("sent", ["SIGKILL", "SIGTERM", *SLOW])
def test_no_process_outlives_a_killed_grader(tmp_path, sent, level):
    class_of(tmp_path / "class", *[notebook(HANGS, exercise="04")] * 3)
    grading, processes = running(tmp_path, level)
    grading.send_signal(getattr(signal, sent))
    _, output = grading.communicate()
    assert grading.returncode == (-signal.SIGKILL if sent == "SIGKILL" else 130)
    assert b"Traceback" not in output
    until(lambda: all(map(gone, processes)))


def test_a_grader_goes_on_after_one_of_its_judges_was_killed(tmp_path):
    texts = [notebook("x = 1", exercise="04"), *[notebook(HANGS, exercise="04")] * 2]
    class_of(tmp_path / "class", *texts)
    grading, _ = running(tmp_path)
    for process in judges_of(grading):
        os.kill(process, signal.SIGKILL)
    _, output = grading.communicate()
    assert grading.returncode == 2
    assert b"same command again" in output
    assert b"Traceback" not in output
    for path in (tmp_path / "class").iterdir():
        path.write_text(texts[0], "utf-8")
    again = grade(tmp_path)
    again.communicate()
    assert again.returncode == 0
    with Gradebook(f"sqlite:///{tmp_path / 'out' / 'grades.db'}") as book:
        assert len(book.latest_attempts()) == 3
