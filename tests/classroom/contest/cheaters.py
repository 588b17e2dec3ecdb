"""Submissions that cheat, or harm, as cells of a notebook: what a worker has to keep from them."""

from pathlib import Path

import course.project

TEMPLATE = (Path(course.project.__file__).parent / "template.py").read_text("utf-8")
SOLUTION = (Path(course.project.__file__).parent / "solution.py").read_text("utf-8")


def acting(body, at=5):
    """Cells of the template, whose step does something more at a reading."""
    lines = "\n".join(f"        {line}" for line in body.strip().splitlines())
    mine = f"""
class MySlam(MySlam):
    def step(self, reading):
        super().step(reading)
        if len(self._poses) == {at}:
            self.act(reading)

    def act(self, reading):
{lines}
"""
    return [(1, TEMPLATE), (2, mine)]


TRUTH_READER = acting("""
import gc, importlib, sys
found = []
for name in ("world_generation", "hidden_worlds", "scores", "point_scale", "estimate_errors",
             "world_parameters", "baselines"):
    try:
        importlib.import_module("classroom.project." + name)
        found.append(name)
    except ImportError:
        pass
kinds = "HiddenWorld", "PreparedWorld", "World", "Trajectory", "EstimatorRun"
for thing in gc.get_objects():
    if type(thing).__name__ in kinds:
        found.append(type(thing).__name__)
frame = sys._getframe()
while frame:
    hidden = "world", "truth", "prepared_world", "seed", "readings"
    found += [n for n in frame.f_locals if n in hidden]
    frame = frame.f_back
if found:
    raise RuntimeError(f"found {found}")
""")
"""Imports what draws worlds, looks through all objects and all frames."""

SEED_GUESSER = acting("""
try:
    from classroom.project.world_generation import generate_worlds
    from classroom.project.world_parameters import WORLD_FAMILIES
except ImportError:
    return
raise RuntimeError("worlds can be drawn here, one seed after the other")
""")
"""Would draw worlds until one fits the readings."""

LOOKS_AHEAD = acting("""
import os, select, stat
waiting = []
for fd in range(64):
    try:
        mode = os.fstat(fd).st_mode
    except OSError:
        continue
    if stat.S_ISFIFO(mode) and select.select([fd], [], [], 0)[0]:
        waiting.append(fd)
if waiting:
    raise RuntimeError(f"what comes next waits in {waiting}")
""")
"""Looks into every pipe for the next reading."""

REMEMBERS = [
    (1, TEMPLATE),
    (
        2,
        """
import builtins, os, pathlib
notes = pathlib.Path(os.environ["HOME"], "notes")
class MySlam(MySlam):
    def __init__(self):
        super().__init__()
        if notes.exists() or hasattr(builtins, "notes"):
            raise RuntimeError("remembers another world")
    def step(self, reading):
        super().step(reading)
        notes.write_text("seen")
        builtins.notes = "seen"
""",
    ),
]
"""Carries notes from one world to the next."""

HANGS = acting("while True: pass")
LIES_ABOUT_TIME = [
    (
        1,
        TEMPLATE
        + """
import time
burnt = time.process_time
time.process_time = time.monotonic = time.thread_time = lambda: 0.0
class MySlam(MySlam):
    def step(self, reading):
        super().step(reading)
        end = burnt() + 0.2
        while burnt() < end:
            pass
""",
    )
]
"""Burns CPU, and stops every clock that it can reach."""

SLEEPS = acting("import time\ntime.sleep(0.6)")
HARM = {
    "exits": acting("import os\nos._exit(0)"),
    "leaks": acting("self.leak = [bytearray(1 << 26) for _ in range(100)]"),
    "raises": acting("raise ValueError('lost')"),
    "quits": acting("raise SystemExit"),
    "recurses": acting("self.act(reading)"),
}
"""What ends a world, and that world only."""
FLOODS = [
    (
        1,
        TEMPLATE
        + """
import numpy as np, sys
class MySlam(MySlam):
    def step(self, reading):
        super().step(reading)
        print("x" * 100_000)
        sys.stderr.write("y" * 100_000)
    def map(self):
        return np.zeros((3_000_000, 2))
""",
    )
]
"""Prints without end, and answers with a map that no pipe should carry."""
