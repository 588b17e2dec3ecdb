"""Judges in processes of their own: the same records; whatever ends one of them loses nothing."""

import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from slamlab.grading import batch, judges, sandbox
from slamlab.grading.gradebook import Gradebook
from slamlab.grading.judges import Judges
from slamlab.grading.submissions import Submission
from slamlab.grading.worker_pool import CAN_FORK, WorkerPool
from slamlab.parallel import RunError
from tests.grading import fake
from tests.grading.conftest import notebook, workers
from tests.patience import until

SECRET = b"0123456789abcdef"
HANGS = "while True: pass"
COMMAND = [sys.executable, "-c", "import sys; from slamlab.cli import main; sys.exit(main())"]
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
    return Judges(2, SECRET, WorkerPool(workers().level, warm=False), "99")


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


def test_their_records_are_those_of_one_judge_in_this_process(tmp_path):
    found = class_of(
        tmp_path / "class", *(notebook(fake.SOLUTION, f"x = {k}") for k in range(4)), "", "{"
    )

    def records(judging):
        with judging:
            made = batch.grade_locally(found, judging)
            return sorted((replace(r, seconds={}) for r in made), key=lambda r: r.submission)

    alone = Judges(1, SECRET, WorkerPool(workers().level, warm=False), "99")
    assert records(two()) == records(alone)


def test_what_is_known_is_not_graded_again(tmp_path):
    found = class_of(tmp_path / "class", *(notebook(fake.SOLUTION, f"x = {k}") for k in range(3)))
    with two() as judging:
        first = list(batch.grade_locally(found, judging))
    known = {f"{k}": replace(r, seconds={"marked": 1.0}) for k, r in enumerate(first)}
    keys = [judges.judge.attempt_key(r.submission, r.sha256, r.seed) for r in first]
    known = dict(zip(keys, known.values(), strict=True))
    with two() as judging:
        again = list(batch.grade_locally(found, judging, known))
    assert [r.seconds for r in again] == [{"marked": 1.0}] * 3


def test_a_judge_that_is_killed_ends_the_run_in_a_line(tmp_path):
    found = class_of(tmp_path / "class", *[notebook(fake.SOLUTION)] * 4)
    with two() as judging:
        for process in judging._processes:
            os.kill(process._process.pid, signal.SIGKILL)
        with pytest.raises(RunError, match="ended from outside"):
            list(batch.grade_locally(found, judging))


def running(folder):
    """A command that grades by two judges, one of them a notebook that hangs; its processes."""
    words = ["--out", folder / "out", "--exercise", "04", "--jobs", "2"]
    grading = subprocess.Popen(
        [*COMMAND, "grade", folder / "class", *words, "--isolation", workers().level],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=os.environ | {"TMPDIR": str(folder)},
    )
    forked = 4 if workers().level == sandbox.STRICT else 2  # bubblewrap twice, zygote, worker
    until(lambda: any(len(below(judge)) == forked for judge in judges_of(grading)))
    return grading, below(grading.pid)


def judges_of(grading):
    """The judges of a running command: processes that are called as itself."""
    called = Path(f"/proc/{grading.pid}/cmdline").read_bytes()
    return [p for p in children(grading.pid) if Path(f"/proc/{p}/cmdline").read_bytes() == called]


@pytest.mark.parametrize("sent", ["SIGKILL", "SIGTERM", "SIGINT"])
def test_nothing_outlives_a_grader_that_is_ended(tmp_path, sent):
    class_of(tmp_path / "class", *[notebook(HANGS, exercise="04")] * 3)
    grading, processes = running(tmp_path)
    grading.send_signal(getattr(signal, sent))
    _, said = grading.communicate()
    assert grading.returncode != 0
    assert b"Traceback" not in said
    until(lambda: all(map(gone, processes)))


def test_a_grader_goes_on_after_one_of_its_judges_was_killed(tmp_path):
    texts = [notebook("x = 1", exercise="04"), *[notebook(HANGS, exercise="04")] * 2]
    class_of(tmp_path / "class", *texts)
    grading, _ = running(tmp_path)
    for process in judges_of(grading):
        os.kill(process, signal.SIGKILL)
    _, said = grading.communicate()
    assert grading.returncode == 2
    assert b"goes on from there" in said
    assert b"Traceback" not in said
    for path in (tmp_path / "class").iterdir():
        path.write_text(texts[0], "utf-8")
    again = subprocess.run([*COMMAND, "grade", tmp_path / "class", "--out", tmp_path / "out",
                            "--isolation", workers().level], capture_output=True)  # fmt: skip
    assert again.returncode == 0
    with Gradebook(f"sqlite:///{tmp_path / 'out' / 'grades.db'}") as book:
        assert len(book.latest_attempts()) == 3
