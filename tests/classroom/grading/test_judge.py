"""The judge scores only answers that it received; no submission can end it."""

import time

import pytest

from classroom.grading import forked_workers, judge, staging, submissions, worker_client
from classroom.grading.submissions import Submission
from classroom.grading.worker_pool import WorkerPool, WorkerStartError
from tests.classroom.grading import attacks, fake
from tests.classroom.grading.conftest import notebook, workers

FULL = [3.5, 2.5, 2]


def judged(*cells, exercise=fake.EXERCISE, by=None):
    return judge.judge_notebook(exercise, list(enumerate(cells, 1)), b"seed", by or workers())


def scores(*cells):
    return [verdict.points for verdict in judged(*cells)["verdicts"]]


def changed(function, body):
    return f"{fake.SOLUTION}\ndef {function}(*args):\n    {body}\n"


def test_the_solution_earns_all_points_and_an_empty_notebook_none():
    result = judged(fake.SOLUTION)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert result["cells"] == {}
    assert {verdict.kind for verdict in judged()["verdicts"]} == {"missing"}


def test_a_missing_function_loses_its_task_alone_and_is_named():
    result = judged(fake.SOLUTION, "del double")["verdicts"]
    assert [verdict.points for verdict in result] == [0, 2.5, 2]
    assert result[0].problem == "double is not defined"
    assert result[2].replaced == ("double",)


def test_the_mistake_is_recognised():
    result = judged(changed("double", "return args[0] ** 2"))["verdicts"]
    assert (result[0].points, result[0].diagnosis) == (1.5, "square")


def test_the_same_seed_gives_the_same_verdicts_and_secrets_differ():
    assert judged(attacks.WRONG)["verdicts"] == judged(attacks.WRONG)["verdicts"]
    one, other = (judge.seed_for(secret, "99", "abc") for secret in (b"a" * 16, b"b" * 16))
    assert one != other
    assert one == judge.seed_for(b"a" * 16, "99", "abc") != judge.seed_for(b"a" * 16, "99", "abd")


def test_cells_run_in_their_order_however_many_are_sent_at_once(monkeypatch):
    cells = [f"x = {k} if {k} == 0 else x * 2 + {k}" for k in range(40)] + ["assert x < 0, x"]
    x = 0
    for k in range(1, 40):
        x = x * 2 + k
    for most in (1, 100, 50_000):
        monkeypatch.setattr(worker_client, "BATCH_CHARACTERS", most)
        found = judge.judge_notebook(fake.EXERCISE, list(enumerate(cells)), b"seed", workers())
        assert list(found["cells"]) == [40]
        assert str(x) in found["cells"][40]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "kind", "message"),
    [
        ("while True: pass", "time", "still running after 3 s"),
        ("import time; time.sleep(60)", "time", "still running"),
        ("import os; os._exit(0)", "died", "ended the whole Python process"),
        ("import os; os.closerange(3, 50)", "died", "ended the whole"),
        ("import sys; sys.exit(0)", "raised", "raised an exception"),
        ("return turn(*args)", "raised", "raised an exception"),
        ("import sys; sys.setrecursionlimit(10**9); return turn(*args)", None, ""),
        ("return np.zeros(10**7)", "malformed", "returned … numbers: at most"),
        ("return np.ones(10**10)", "raised", "raised an exception"),
        ("return 'x' * 10**8", "malformed", "not an array of real numbers"),
        ("raise ValueError('x' * 10**8)", "raised", "raised an exception;"),
        ("return np.array([1, 2], dtype='datetime64[s]')", "malformed", "not an array of real"),
        ("return np.nan * args[0]", "malformed", "NaN"),
        ("raise type('<script>', (Exception,), {})('<b>')", "raised", "raised an exception"),
    ],
)  # fmt: skip
def test_a_failing_function_costs_only_its_task(body, kind, message):
    result = judged(changed("turn", body))["verdicts"]
    assert [verdict.points for verdict in result] == [3.5, 0, 2]
    assert kind in (None, result[1].kind)
    assert message in result[1].problem
    assert len(result[1].problem) <= 500


@pytest.mark.parametrize(
    "cell",
    [
        "1 / 0",
        "def (",
        "raise KeyboardInterrupt",
        "import os; os._exit(1)",
        "import nowhere_to_be_found",
        "(" * 100_000,
        "x = " + "1 + " * 300_000 + "1",
        "y" * 2_000_000,
        "input()",
        "def f(): return f()\nf()",
    ],
    ids=lambda cell: cell[:30],
)
def test_a_cell_that_fails_is_noted_and_the_others_run(cell):
    result = judged("import math", cell, fake.SOLUTION)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert list(result["cells"]) == [2]
    assert 0 < len(result["cells"][2]) <= 500


LETTERS = """
def letters(*values, start="leak", first=97):
    return start + ''.join(chr(first + int(c)) for c in str(values) if c.isdigit())
"""
ERROR = "from classroom.exercises import function_calls as d; raise d.StudentError"
LEAKS = {
    "message": "raise ValueError(f'leak {args}')",
    "type": "return type(letters(*args), (), {})()",
    "exception": "raise type(letters(*args), (Exception,), {})('x')",
    "function": "exec(compile(f'def {letters(*args)}(): 1 / 0', '<cell 2>', 'exec')); locals()"
    "[letters(*args)]()",
    "malformed": ERROR + "('malformed', letters(*args))",
    "missing": ERROR + "('missing', letters(*args) + ' is not defined')",
    "not attempted": ERROR + "('not attempted', letters(*args) + ' is not attempted yet')",
    "of a type": ERROR + "('malformed', f'turn is of type {letters(*args)}, not a function')",
    "signs": ERROR + "('malformed', f'turn is of type {letters(*args, first=0x2800)}, not a f')",
    "line": "if args[1] < 0.6: raise ValueError('x')\n    raise ValueError('x')",
    "size": "return np.zeros(int(1000 * args[1]))",
    "one of some exceptions": "raise [KeyError, EOFError, OSError][int(9 * args[1]) % 3]('x')",
    "one of some types": "return ['x', {}, object(), b''][int(9 * args[1]) % 4]",
}


@pytest.mark.parametrize("way", LEAKS)
def test_the_report_of_a_failure_does_not_depend_on_the_inputs(way):
    cells = list(enumerate((fake.SOLUTION, LETTERS, changed("turn", LEAKS[way])), 1))
    messages = set()
    for seed in range(6):
        found = judge.judge_notebook(fake.EXERCISE, cells, bytes([seed]), workers())
        verdict = found["verdicts"][1]
        assert verdict.points == 0
        messages.add(verdict.problem)
    assert len(messages) == 1 and "leak" not in messages.pop()


def test_a_cell_that_hangs_is_skipped(monkeypatch):
    monkeypatch.setattr(worker_client, "CELL_TIMEOUT", 1.0)
    result = judged("x = 1", "while True: pass", fake.SOLUTION)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert result["cells"] == {
        2: "still running after 1 s, so it was stopped. Shorten or delete this cell"
    }


def test_a_notebook_has_a_total_timeout(monkeypatch):
    monkeypatch.setattr(worker_client, "NOTEBOOK_TIMEOUT", 0.0)
    result = judged(fake.SOLUTION)["verdicts"]
    assert [verdict.kind for verdict in result] == ["time"] * 3


@pytest.mark.parametrize(
    "cell",
    [
        "%matplotlib inline\n!ls\nfiles = !ls\nnp?\n%timeit 1\ncd /\nget_ipython().magic('x')",
        "%%bash\nexit 1",
        "get_ipython().user_ns['x'] = 1; get_ipython().system('true')",
        "print('x' * 10**7)",
        "import os, sys\nfor fd in (1, 2): os.write(fd, b'x' * 10**6)\nprint('x', file=sys.stderr)",
        "from classroom.checks import check, attempt\ncheck('99-double')\nattempt(lambda: 1 / 0)",
    ],
)
def test_magics_shell_lines_prints_and_checks_do_nothing(cell):
    result = judged("import numpy as np", cell, "%%time\n" + fake.SOLUTION)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert set(result["cells"]) <= {2}


FORGERIES = [
    "equal to everything", "an array that lies", "numpy's comparisons", "builtins",
    "the function calls", "the wire", "the pipe", "noise in the pipe", "a thread that answers",
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    "attack",
    [
        *(attacks.FORGERIES[name] for name in FORGERIES),
        "import sys\nfor m in list(sys.modules):\n    if 'slamlab' in m: del sys.modules[m]\n",
        "import classroom.grading.wire_protocol as w\nw.pack = lambda *a: b''\n",
        "import atexit, os; atexit.register(print, 100); os.environ['NBGRADER_EXECUTION'] = ''\n",
        "float = int = print = open = range = None; check = attempt = 5\n",
        "__name__ = None; __builtins__ = {}\n",
    ],
)
def test_attacks_do_not_raise_the_score_of_wrong_functions(attack, monkeypatch):
    """At the isolation level of this machine; the attack suite needs a sandbox."""
    monkeypatch.setattr(worker_client, "CELL_TIMEOUT", 3.0)
    assert sum(scores(fake.SOLUTION + attacks.WRONG + attack)) == 0


ANSWERS = "slamlab.geometry slamlab.models.symbolic course.exercises.ex01_why_slam.exercise"
JUDGES = "classroom.exercises.task classroom.grading.judge tests.classroom.grading.fake"


def test_answers_and_the_judge_cannot_be_imported():
    hidden = f"{ANSWERS} {JUDGES} tests.classroom.grading.conftest".split()
    cells = [f"from {module} import *" for module in hidden]
    found = judged(*cells, "import slamlab.models.noise")["cells"]
    assert list(found) == [*range(1, len(cells) + 1)]
    assert all("ModuleNotFoundError" in problem for problem in found.values())


def test_a_worker_knows_neither_the_project_nor_the_grader_by_its_paths_and_environment(
    monkeypatch,
):
    monkeypatch.setenv("SLAMLAB_TOKEN", "known to the grader only")
    monkeypatch.setenv("PYTHONPATH", str(staging.__file__))
    spy = """
import os, sys, slamlab
here = os.path.dirname(slamlab.__path__[0])
found = [p for p in sys.path if os.path.exists(os.path.join(p, "slamlab"))]
raise ValueError(f"{found == [here] == sys.path[:1]} {sorted(os.environ)}")
"""
    message = judged(spy)["cells"][1]
    assert message.startswith("ValueError: True")
    assert "TOKEN" not in message
    assert "PYTHONPATH" not in message


@pytest.mark.slow
def test_processes_and_threads_of_a_submission_end_with_it(tmp_path):
    mark = tmp_path / "alive"
    cell = (
        "import os, time\nif os.fork() == 0:\n"
        f"    while True:\n        open({str(mark)!r}, 'w').close(); time.sleep(0.02)\n"
        f"while not os.path.exists({str(mark)!r}):\n    time.sleep(0.02)\n"
    )
    with WorkerPool() as unbounded:
        result = judged(cell, fake.SOLUTION, by=unbounded)["verdicts"]
        assert [verdict.points for verdict in result] == FULL
        assert mark.exists()
        mark.unlink()
        time.sleep(0.2)
        assert not mark.exists()


def test_without_fork_each_worker_is_a_spawned_interpreter(monkeypatch, tmp_path):
    monkeypatch.setattr("classroom.grading.worker_pool.CAN_FORK", False)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with WorkerPool() as fresh:
        result = judged(fake.SOLUTION, "import os; os._exit(0)", "print('x' * 10**6)", by=fresh)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert result["cells"][2].startswith("ended the whole Python process; possible causes")
    assert list(tmp_path.iterdir()) == []


def test_a_fault_of_the_grader_is_not_a_score(monkeypatch, tmp_path):
    file = tmp_path / "anna.ipynb"
    file.write_text(notebook(fake.SOLUTION))
    submission = Submission(file.name, "anna", file)
    with monkeypatch.context() as patch, WorkerPool() as broken:
        patch.setattr(forked_workers, "BOOTSTRAP", "raise ImportError('no numpy here')")
        with pytest.raises(WorkerStartError, match="no numpy here"):
            judged(fake.SOLUTION, by=broken)
        record = judge.grade_submission(submission, b"s" * 16, broken)
    assert record.score is None
    assert "no numpy here" in record.reason
    monkeypatch.setattr(submissions, "parse", lambda data: 1 / 0)
    record = judge.grade_submission(submission, b"s" * 16, workers())
    assert record.reason == "the grader failed: ZeroDivisionError: division by zero"


def test_a_worker_sees_other_libraries_but_not_the_installed_course(monkeypatch, tmp_path):
    site = tmp_path / "site-packages"
    (site / "slamlab").mkdir(parents=True)
    (site / "slamlab-0.1.0.dist-info").mkdir()
    (site / "other.py").write_text("")
    monkeypatch.setattr("sys.path", [str(site), str(tmp_path / "absent" / "site-packages")])
    (view,), readable = staging.stage_libraries(tmp_path)
    assert [entry.name for entry in view.iterdir()] == ["other.py"]
    assert readable == [view, site / "other.py"]


def test_modules_used_by_the_notebooks_are_preloaded():
    plain = notebook("import numpy as np\nx = np.zeros(3)").encode()
    both = notebook("from scipy import stats\nimport sympy", "%matplotlib inline").encode()
    assert forked_workers.modules_to_preload([plain]) == ("numpy",)
    assert set(forked_workers.modules_to_preload([plain, both, b""])) == {
        "numpy", "scipy.stats", "sympy", forked_workers.MAGICS_MODULE,
    }  # fmt: skip
    assert forked_workers.modules_to_preload([]) == ()
