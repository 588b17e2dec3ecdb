"""Coroutines are run as in the tests of the console."""

from tests.slamlab.console.conftest import pytest_pyfunc_call  # noqa: F401
