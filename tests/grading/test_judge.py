"""A score is earned by evidence that crossed to the judge; nothing a submission does ends it."""

import re
import time

import pytest

from slamlab.grading import forked_workers, judge, staging, submissions, worker_client
from slamlab.grading.submissions import Submission
from slamlab.grading.worker_pool import WorkerPool, WorkerStartError
from tests.grading import fake
from tests.grading.conftest import notebook, workers

WRONG = """
def double(a):
    return a
def turn(v, angle):
    return v
def total(a):
    return a.sum()
"""
FULL = [3.5, 2.5, 2]


def judged(*cells, exercise=fake.EXERCISE, by=None):
    return judge.judge_notebook(exercise, list(enumerate(cells, 1)), b"seed", by or workers())


def scores(*cells):
    return [verdict.points for verdict in judged(*cells)["verdicts"]]


def changed(function, body):
    return f"{fake.SOLUTION}\ndef {function}(*args):\n    {body}\n"


def test_the_solution_earns_everything_and_an_empty_notebook_nothing():
    result = judged(fake.SOLUTION)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert result["cells"] == {}
    assert {verdict.kind for verdict in judged()["verdicts"]} == {"missing", "needs"}


def test_a_missing_function_loses_its_task_and_those_that_need_it_and_is_named():
    result = judged(fake.SOLUTION, "del double")["verdicts"]
    assert [verdict.points for verdict in result] == [0, 2.5, 0]
    assert result[0].problem == "double is not defined"
    assert result[2].problem == "needs 99-double, solved and run first"


def test_the_mistake_is_recognised():
    result = judged(changed("double", "return args[0] ** 2"))["verdicts"]
    assert (result[0].points, result[0].diagnosis) == (1.5, "square")


def test_the_same_seed_gives_the_same_verdicts_and_secrets_differ():
    assert judged(WRONG)["verdicts"] == judged(WRONG)["verdicts"]
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
    ("body", "kind", "said"),
    [
        ("while True: pass", "time", "still running after 3 s"),
        ("import time; time.sleep(60)", "time", "still running"),
        ("import os; os._exit(0)", "died", "ended the whole Python process"),
        ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "died", "ended the whole"),
        ("import os; os.closerange(3, 50)", "died", "ended the whole"),
        ("import sys; sys.exit(0)", "raised", "raised an exception"),
        ("raise KeyboardInterrupt", "raised", "raised an exception"),
        ("return turn(*args)", "raised", "raised an exception"),
        ("import sys; sys.setrecursionlimit(10**9); return turn(*args)", None, ""),
        ("return np.zeros(10**7)", "malformed", "returned … numbers: at most"),
        ("return np.ones(10**10)", "raised", "raised an exception"),
        ("return [0.0] * 10**6", "malformed", "at most"),
        ("return bytearray(10**10)", "raised", "raised an exception"),
        ("return 'x' * 10**8", "malformed", "no array of real numbers"),
        ("raise ValueError('x' * 10**8)", "raised", "raised an exception;"),
        ("return {'x': 1}", "malformed", "no array of real numbers"),
        ("return np.array([1, 2], dtype='datetime64[s]')", "malformed", "no array of real numbers"),
        ("return np.float64('nan') * args[0]", "malformed", "NaN"),
        ("raise type('<script>', (Exception,), {})('<b>')", "raised", "raised an exception"),
    ],
)  # fmt: skip
def test_what_one_function_does_loses_that_task_only(body, kind, said):
    result = judged(changed("turn", body))["verdicts"]
    assert [verdict.points for verdict in result] == [3.5, 0, 2]
    assert kind in (None, result[1].kind)
    assert said in result[1].problem
    assert len(result[1].problem) <= 500


@pytest.mark.parametrize(
    "cell",
    [
        "1 / 0",
        "def (",
        "import sys; sys.exit()",
        "raise KeyboardInterrupt",
        "import os; os._exit(1)",
        "import nowhere_to_be_found",
        "(" * 100_000,
        "x = " + "-" * 100_000 + "1",
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


def test_what_is_said_of_a_failure_tells_nothing_of_the_inputs():
    result = judged(
        fake.SOLUTION,
        "def double(a):\n    raise ValueError(f'the input was {a}')",
        "def turn(v, angle):\n    return type(f'x{angle}', (), {})()",
        "def total(a):\n    raise type('I' + str(a[0]).replace('.', '_'), (Exception,), {})",
    )["verdicts"]
    said = " ".join(verdict.problem for verdict in result)
    assert "raised an exception; check(…) in the notebook shows which, and where" in said
    assert "input" not in said
    assert not re.search(r"\d[._]\d", said)


LETTERS = """
letters = lambda *values: 'leak' + ''.join(chr(ord(c) + 49) for c in str(values) if c.isdigit())
"""


@pytest.mark.parametrize(
    "body",
    [
        "return type(letters(*args), (), {})()",
        "raise type(letters(*args), (Exception,), {})('x')",
        "exec(compile(f'def {letters(*args)}(): 1 / 0', '<cell 2>', 'exec')); locals()"
        "[letters(*args)]()",
        "import slamlab.exercises.drives as d; raise d.StudentError('malformed', letters(*args))",
        "import slamlab.exercises.drives as d; raise d.StudentError('missing', letters(*args)"
        " + ' is not defined')",
        "import slamlab.exercises.drives as d; raise d.StudentError('not attempted', letters(*args)"
        " + ' is not attempted yet')",
        "import slamlab.exercises.drives as d; raise d.StudentError('malformed',"
        " f'turn is of type {letters(*args)}, not a function')",
    ],
)
def test_not_even_as_letters_do_inputs_come_out(body):
    result = judged(LETTERS, changed("turn", body))["verdicts"][1]
    assert result.points == 0
    assert "leak" not in result.problem


def test_a_cell_that_hangs_is_left_out(monkeypatch):
    monkeypatch.setattr(worker_client, "CELL_TIMEOUT", 1.0)
    result = judged("x = 1", "while True: pass", fake.SOLUTION)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert result["cells"] == {2: "still running after 1 s"}


def test_time_runs_out_for_a_notebook_as_a_whole(monkeypatch):
    monkeypatch.setattr(worker_client, "NOTEBOOK_TIMEOUT", 0.0)
    result = judged(fake.SOLUTION)["verdicts"]
    assert [verdict.kind for verdict in result] == ["time", "time", "needs"]


@pytest.mark.parametrize(
    "cell",
    [
        "%matplotlib inline\n!ls\nfiles = !ls\nnp?\n%timeit 1\ncd /\nget_ipython().magic('x')",
        "%%bash\nexit 1",
        "get_ipython().user_ns['x'] = 1; get_ipython().system('true')",
        "print('x' * 10**7)",
        "import os, sys\nfor fd in (1, 2): os.write(fd, b'x' * 10**6)\nprint('x', file=sys.stderr)",
        "from slamlab.checks import check, attempt\ncheck('99-double')\nattempt(lambda: 1 / 0)",
    ],
)
def test_magics_shell_lines_prints_and_checks_do_nothing(cell):
    result = judged("import numpy as np", cell, fake.SOLUTION)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert set(result["cells"]) <= {2}


def test_a_function_under_a_timing_magic_counts():
    assert scores("%%time\n" + fake.SOLUTION) == FULL


@pytest.mark.slow
@pytest.mark.parametrize(
    "attack",
    [
        # numbers that claim to be equal to everything, arrays that lie
        "class Any:\n    def __eq__(self, o): return True\n    def __float__(self): return 1.0\n"
        "def double(a): return Any()\n",
        "class Lie(np.ndarray):\n    def __array_function__(self, *a, **k): return True\n"
        "    def __eq__(self, o): return np.True_\n"
        "def turn(v, angle): return v.view(Lie)\n",
        # the tools the judge would use
        "np.isclose = np.allclose = np.array_equal = lambda *a, **k: np.True_\n",
        "import builtins; builtins.all = builtins.any = lambda *a: True\n",
        # the machinery in the worker
        "import slamlab.exercises.drives as d\nd.numbers = lambda v, f: np.ones(2)\n"
        "d.StudentError = KeyError\n",
        "import sys\nfor m in list(sys.modules):\n    if 'slamlab' in m: del sys.modules[m]\n",
        "import slamlab.grading.wire_protocol as w\nw.pack = lambda *a: b''\n",
        "import slamlab.grading.wire_protocol as w\nold = w.pack\n"
        "w.pack = lambda h, a=None: old(h | {'points': 99, 'full': True, 'problem': None}, a)\n",
        # the pipe itself
        "import os, struct\n"
        "head = b'{\"head\": {\"turn\": 2, \"points\": 99}, \"arrays\": []}'\n"
        "for fd in range(3, 30):\n    try: os.write(fd, struct.pack('<II', len(head), 0) + head)\n"
        "    except OSError: pass\n",
        "import os\nfor fd in range(3, 30):\n    try: os.write(fd, b'\\xff' * 60000)\n"
        "    except OSError: pass\n",
        # what is on the way out
        "import atexit, os; atexit.register(print, 100); os.environ['NBGRADER_EXECUTION'] = ''\n",
        "import threading\nthreading.Thread(target=lambda: [0 for _ in iter(int, 1)]).start()\n",
        # names
        "float = int = print = open = range = None; check = attempt = 5\n",
        "__name__ = None; __builtins__ = {}\n",
    ],
)  # fmt: skip
def test_wrong_functions_earn_no_more_whatever_else_a_submission_does(attack, monkeypatch):
    monkeypatch.setattr(worker_client, "CELL_TIMEOUT", 3.0)
    # "double" keeps the sign, which is worth a point, and its argument, which is worth a half
    assert sum(scores(fake.SOLUTION + WRONG + attack)) <= 1.5


@pytest.mark.parametrize(
    "module",
    ["slamlab.geometry", "slamlab.exercises.task", "slamlab.exercises.tasks",
     "slamlab.grading.judge",
     "slamlab.models.symbolic", "tests.grading.fake", "tests.grading.conftest"],
)  # fmt: skip
def test_answers_and_the_judge_cannot_be_imported(module):
    result = judged(f"from {module} import *", "import slamlab.models.noise")
    assert "ModuleNotFoundError" in result["cells"].pop(1)
    assert result["cells"] == {}


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
    said = judged(spy)["cells"][1]
    assert said.startswith("ValueError: True")
    assert "TOKEN" not in said
    assert "PYTHONPATH" not in said


@pytest.mark.slow
def test_nothing_a_submission_started_outlives_it(tmp_path):
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


def test_where_none_can_be_forked_each_worker_is_a_fresh_interpreter(monkeypatch, tmp_path):
    monkeypatch.setattr("slamlab.grading.worker_pool.CAN_FORK", False)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with WorkerPool() as fresh:
        result = judged(fake.SOLUTION, "import os; os._exit(0)", "print('x' * 10**6)", by=fresh)
    assert [verdict.points for verdict in result["verdicts"]] == FULL
    assert result["cells"] == {2: "ended the whole Python process"}
    assert list(tmp_path.iterdir()) == []


def test_temporary_files_are_gone_afterwards(monkeypatch, tmp_path):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with WorkerPool(workers().level, warm=False) as own:
        cells = "open('here', 'w').write('x')", fake.SOLUTION, "import os; os._exit(0)"
        assert 1 not in judged(*cells, by=own)["cells"]
    assert list(tmp_path.iterdir()) == []


def test_a_worker_that_does_not_start_is_the_graders_problem_and_not_a_score(monkeypatch, tmp_path):
    monkeypatch.setattr(forked_workers, "BOOTSTRAP", "raise ImportError('no numpy here')")
    file = tmp_path / "anna.ipynb"
    file.write_text(notebook(fake.SOLUTION))
    with WorkerPool() as broken:
        with pytest.raises(WorkerStartError, match="no numpy here"):
            judged(fake.SOLUTION, by=broken)
        record = judge.grade_submission(Submission(file.name, "anna", file), b"s" * 16, broken)
    assert record.score is None
    assert "no numpy here" in record.reason


def test_a_fault_of_the_graders_own_is_no_score_either(monkeypatch, tmp_path):
    monkeypatch.setattr(submissions, "parse", lambda data: 1 / 0)
    file = tmp_path / "anna.ipynb"
    file.write_text(notebook(fake.SOLUTION))
    record = judge.grade_submission(Submission(file.name, "anna", file), b"s" * 16, workers())
    assert record.reason == "the grader failed: ZeroDivisionError: division by zero"


def test_where_the_package_is_installed_beside_other_libraries_the_worker_sees_only_those(
    monkeypatch, tmp_path
):
    site = tmp_path / "site-packages"
    (site / "slamlab").mkdir(parents=True)
    (site / "slamlab-0.1.0.dist-info").mkdir()
    (site / "other.py").write_text("")
    monkeypatch.setattr("sys.path", [str(site), str(tmp_path / "absent" / "site-packages")])
    (view,), readable = staging.stage_libraries(tmp_path)
    assert [entry.name for entry in view.iterdir()] == ["other.py"]
    assert readable == [view, site / "other.py"]


def test_a_class_forks_with_what_its_notebooks_name():
    plain = notebook("import numpy as np\nx = np.zeros(3)").encode()
    both = notebook("from scipy import stats\nimport sympy", "%matplotlib inline").encode()
    assert forked_workers.named_modules([plain]) == ("numpy",)
    assert set(forked_workers.named_modules([plain, both, b""])) == {
        "numpy", "scipy.stats", "sympy", forked_workers.MAGICS_MODULE,
    }  # fmt: skip
    assert forked_workers.named_modules([]) == ()
