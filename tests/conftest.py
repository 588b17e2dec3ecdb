"""Hypothesis without deadlines and without randomness; order of long test files; signals."""

import contextlib
import signal

import pytest

# files that take minutes: a worker that begins with them is not left alone with one at the end
FIRST = (
    "tests/classroom/grading/test_mistakes.py",
    "tests/course/browser/test_walk",
    "tests/classroom/lecturing/",
    "tests/course/browser/",
    "tests/course/setup/",
    "tests/classroom/grading/",
)

with contextlib.suppress(ModuleNotFoundError):  # not beside the library alone
    from hypothesis import settings

    settings.register_profile("slamlab", deadline=None, derandomize=True, max_examples=60)
    settings.load_profile("slamlab")

# what is started in the background, or by nohup, ignores these; so would programs under test
for name in ("SIGINT", "SIGHUP"):
    number = getattr(signal, name, None)
    if number and signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, signal.SIG_DFL if name == "SIGHUP" else signal.default_int_handler)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    items.sort(key=lambda item: [not item.nodeid.startswith(path) for path in FIRST])
