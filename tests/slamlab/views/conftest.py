"""What a notebook stores of a figure; coroutines are run as in the tests of the console."""

import pytest

from tests.slamlab.console.conftest import pytest_pyfunc_call  # noqa: F401
from tests.slamlab.views.outputs import Displays


@pytest.fixture
def stored(monkeypatch):
    """What the cells of a notebook store."""
    pytest.importorskip("IPython")
    from slamlab.views import sliders  # late: it needs the widgets of a notebook

    return Displays(monkeypatch, sliders)
