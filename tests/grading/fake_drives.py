"""The worker's side of the fake exercise."""

import numpy as np

from slamlab.exercises.drives import Drive, numbers, rows


def _sums(functions, inputs):
    total = functions["total"]
    return {"sums": np.array([numbers(total(*row), "total") for row in rows(inputs)])}


DRIVES = {
    "99-double": Drive(("double",), seconds=3.0),
    "99-turn": Drive(("turn",), seconds=3.0),
    "99-total": Drive(("total", "double"), _sums, seconds=3.0),
}
