"""The worker's side of the fake exercise."""

import numpy as np

from slamlab.exercises.drives import Drive, call_each, numbers, rows


def _sums(functions, inputs):
    total = functions["total"]
    return {"sums": np.array([numbers(total(*row), "total") for row in rows(inputs)])}


def _doubled(functions, inputs):
    return call_each(functions, {"a": inputs["a"][:, 0]})


DRIVES = {
    "99-double": Drive(("double",), _doubled, seconds=3.0),
    "99-turn": Drive(("turn",), seconds=3.0),
    "99-total": Drive(("total", "double"), _sums, seconds=3.0),
}
