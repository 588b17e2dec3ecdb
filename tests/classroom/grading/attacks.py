"""Attacking submissions, which try to forge points, to read secrets, or to do harm.

Each starts only a few processes and takes at most a few gigabytes and seconds, so that it may run
even if the sandbox fails. CANARY is a file of the judge, OUT the folder of results.
"""

import json

from tests.classroom.grading import further_attacks as more

WRONG = """
import numpy as np
def double(a):
    return -a
def turn(v, angle):
    return v
def total(a):
    return a.sum()
"""
"""Earns nothing, because even the sign is wrong."""

LEAK = (
    "def tell(act):\n    try:\n        found = act()\n    except BaseException:\n        return\n"
)
LEAK += "    raise ValueError('LEAKED ' + str(found)[:300])\n"
HARM = "def harm(act):\n    try:\n        act()\n    except BaseException:\n        pass\n"

FORGERIES = {
    # numbers and arrays that lie
    "equal to everything": """
class Any(float):
    def __eq__(self, other): return True
    def __ne__(self, other): return False
def double(a): return Any(-a)
""",
    "an array that lies": """
class Lie(np.ndarray):
    def __array_function__(self, *a, **k): return np.True_
    def __array_ufunc__(self, *a, **k): return np.True_
    def __eq__(self, other): return np.True_
def turn(v, angle): return np.asarray(v).view(Lie)
""",
    "a shape that lies": """
class Odd(np.ndarray):
    shape = property(lambda self: (2,))
def turn(v, angle): return np.zeros(0).view(Odd)
""",
    "not a number for an answer": "def double(a): return float('nan')\n",
    "infinity for an answer": "def turn(v, angle): return np.array([np.inf, np.inf])\n",
    # the tools of judging
    "numpy's comparisons": "np.isclose = np.allclose = np.array_equal = lambda *a, **k: np.True_\n",
    "numpy.testing": "import numpy.testing as t\nt.assert_allclose = lambda *a, **k: None\n",
    "builtins": "import builtins; builtins.all = builtins.any = builtins.len = lambda *a: True\n",
    "assertions switched off": "import sys; sys.flags.__class__; __debug__ and None\n",
    "a syntax transformer": """
get_ipython().ast_transformers.append(None)
import ast; ast.parse = lambda *a, **k: None
""",
    "the kernel's methods": "get_ipython().kernel.do_execute = lambda *a, **k: {'status': 'ok'}\n",
    # the worker's own machinery
    "the function calls": """
import classroom.exercises.function_calls as d
d.to_array = lambda value, function: np.ones(2)
d.StudentError = KeyError
d.FunctionCall.__call__ = lambda self, names, inputs: {'result': np.zeros(20), 'full': np.ones(1)}
""",
    "the wire": """
import classroom.grading.wire_protocol as w
packed = w.pack
w.pack = lambda head, arrays=None: packed(head | {'points': 99, 'full': True}, arrays)
""",
    "the worker": """
import classroom.grading.worker as w
w._call_task = lambda *a: ({'full': True, 'points': 99}, {})
""",
    "the sets of inputs": """
import classroom.exercises.function_calls.run_and_pack as i
names = [f'{k}/{name}' for k in (0, 1, '', '0/0') for name in ('result', 'sums', '', '0/x')]
i.pack_sets = lambda sets: {name: np.full(20, 3.0) for name in names}
""",
    "the probes that failed": """
import classroom.grading.worker as w
drive = w._call_task
w._call_task = lambda *a: ({'failed': {'': None, 'full': ['full', 99], 'x': {}}}, drive(*a)[1])
""",
    "the arguments": """
import classroom.exercises.function_calls as d
d.WatchedFunction = lambda function: function
double.changed = turn.changed = total.changed = ()
""",
    "frames of the caller": """
import sys
frame = sys._getframe()
while frame:
    for name in list(frame.f_locals):
        if name in ('answer', 'result', 'verdict', 'points'):
            frame.f_locals[name] = 99
    frame = frame.f_back
""",
    "every object there is": """
import gc
for thing in gc.get_objects():
    if type(thing).__name__ in ('Law', 'LawResult', 'Verdict', 'Task'):
        for name in ('points', 'max_points', 'holds'):
            try: object.__setattr__(thing, name, 99)
            except Exception: pass
""",
    "the pipe": """
import os, struct
head = b'{"head": {"turn": 2, "points": 99, "full": true}, "arrays": []}'
for fd in range(3, 40):
    try: os.write(fd, struct.pack('<II', len(head), 0) + head)
    except OSError: pass
""",
    "noise in the pipe": """
import os
for fd in range(3, 40):
    try: os.write(fd, os.urandom(60000))
    except OSError: pass
""",
    "an answer before the question": """
import os, struct, json
def double(a):
    for turn in range(2, 30):
        arrays = [['0/result', 'f8', [20]]]
        head = json.dumps({'head': {'turn': turn}, 'arrays': arrays}).encode()
        frame = struct.pack('<II', len(head), 160) + head + np.full(20, 3.0).tobytes()
        for fd in range(3, 40):
            try: os.write(fd, frame)
            except OSError: pass
    return -a
""",
    # what belongs to the notebook
    "check and attempt": "check = attempt = lambda *a, **k: 99\n",
    "points printed": "print(99); 99\n",
    "a class instead of a function": """
class double:
    def __new__(cls, a): return -a
    points = 99
""",
    "an attribute for an answer": "double.score = double.points = double.full = 99\n",
    "numbers beyond all rounding": """
def double(a): return -1e300
def turn(v, angle): return np.array([1e300, -1e300])
""",
    "an integer without end": "def double(a): return 10 ** 5000\n",
    "an array for whoever asks": """
class Later:
    asked = 0
    def __array__(self, *a, **k):
        Later.asked += 1
        return np.array([3.0] * Later.asked)
    __float__ = __index__ = __len__ = lambda self: 3
def double(a): return Later()
def turn(v, angle): return Later()
""",
    "what unpickles to points": """
class Points(float):
    def __reduce__(self): return print, (99,)
def double(a): return Points(-a)
def turn(v, angle): return (x for x in (1, 2))
""",
    "numpy in the worker": """
import json, math, struct
real = np.asarray
np.asarray = np.array = np.ascontiguousarray = lambda *a, **k: real([3.0])
np.isfinite = np.frombuffer = json.dumps = math.prod = struct.pack = lambda *a, **k: True
""",
    "a trace of the function calls": """
import sys
def watch(frame, event, arg):
    for name in ('results', 'outputs', 'arrays', 'verdict'):
        if name in frame.f_locals: frame.f_locals[name] = [3.0] * 20
    return watch
sys.settrace(watch); sys.setprofile(watch)
""",
    "a thread that answers": """
import json, os, struct, threading, time
def shout():
    for _ in range(200):
        for turn in range(2, 12):
            head = {'head': {'turn': turn, 'full': True}, 'arrays': [['0/result', 'f8', [20]]]}
            head = json.dumps(head).encode()
            frame = struct.pack('<II', len(head), 160) + head + np.full(20, 3.0).tobytes()
            for fd in range(3, 10):
                try: os.write(fd, frame)
                except OSError: pass
        time.sleep(0.005)
threading.Thread(target=shout, daemon=True).start()
""",
    "the last moment": """
import time
def double(a):
    if not hasattr(double, 'end'): double.end = time.monotonic() + 2.99
    time.sleep(max(0, double.end - time.monotonic()))
    return -a
""",
    "exit code 0": "import atexit, os; atexit.register(os._exit, 0)\ndef double(a): os._exit(0)\n",
    "silence": "def double(a): raise SystemExit(0)\ndef turn(v, angle): raise SystemExit(0)\n",
}
"""Name to cells after WRONG; every point that they earn is forged."""

SPIES = {
    "a file of the judge": "tell(lambda: open(CANARY).read())\n",
    "its folder": "import os; tell(lambda: os.listdir(os.path.dirname(CANARY)))\n",
    "the results": "import os; tell(lambda: os.listdir(OUT))\n",
    "the secret": "tell(lambda: open(OUT + '/secret').read())\n",
    "the gradebook": "tell(lambda: open(OUT + '/grades.db', 'rb').read(16))\n",
    "other submissions": "import glob; tell(lambda: glob.glob(CLASS + '/*.ipynb')[0])\n",
    "the solutions": "tell(lambda: open(ROOT + '/classroom/exercises/task.py').read(80))\n",
    "the answers as modules": """
import sys; sys.path.insert(0, ROOT)
for name in list(sys.modules):
    if name.startswith('slamlab'): del sys.modules[name]
def act():
    import classroom.exercises.task as t
    return t.__file__
tell(act)
""",
    "users of the machine": "tell(lambda: open('/etc/passwd').read())\n",
    "the judge's environment": "tell(lambda: open(f'/proc/{JUDGE}/environ').read())\n",
    "the judge's memory": "tell(lambda: open(f'/proc/{JUDGE}/mem', 'rb').read(1))\n",
    "other processes": "import os; tell(lambda: [p for p in os.listdir('/proc') if p.isdigit()])\n",
    "another's home": "import os; tell(lambda: os.listdir('..'))\n",
    "a link out": "import os; tell(lambda: (os.symlink(CANARY, 'l'), open('l').read())[1])\n",
    "a shell line": "found = !cat $CANARY\nif found: raise ValueError('LEAKED ' + str(found))\n",
    "inherited files": """
import os
def act():
    found = []
    for fd in range(256):
        try: found.append((fd, os.fstat(fd)))
        except OSError: pass
    if len(found) <= 5: raise OSError  # the pipe's two ends, and three that lead nowhere
    return found
tell(act)
""",
    "inherited memory": """
import gc, os, sys
def act():
    told = [str(x) for x in gc.get_objects() if isinstance(x, (list, dict, tuple)) and len(x) < 99]
    told += [str(sys.argv), str(sys.orig_argv), str(os.environ), *map(str, sys.modules)]
    OWN = 'CANARY = ' + repr(CANARY)
    return [t for t in told if OUT in t and OWN not in t and 'CANARY' not in t][0]
tell(act)
""",
    "a hard link": "import os; tell(lambda: (os.link(CANARY, 'hard'), open('hard').read())[1])\n",
    "folders by their handles": """
import os
def act():
    fd = os.open('/', os.O_RDONLY)
    return os.listdir(fd)
tell(act)
""",
    "its own process": "tell(lambda: open('/proc/self/maps').read())\n",
    "the first process": "tell(lambda: open('/proc/1/cmdline').read())\n",
    "every call of the kernel": """
import ctypes, errno, platform
from classroom.grading import seccomp
def act():
    column = list(seccomp.ARCHITECTURES).index(platform.machine())
    calls = [*seccomp.ALLOWED.values(), seccomp.CLONE, seccomp.KILL, seccomp.TGKILL, seccomp.PRCTL,
             seccomp.IOCTL, seccomp.PRLIMIT, seccomp.FCNTL]
    allowed = {numbers[column] for numbers in calls}
    libc, open_ = ctypes.CDLL(None, use_errno=True), []
    for number in [*range(1100), *(0x40000000 + n for n in range(600))]:
        if number not in allowed:
            libc.syscall(number, 0, 0, 0, 0, 0, 0)
            if ctypes.get_errno() not in (errno.EPERM, errno.ENOSYS): open_.append(number)
    if not open_: raise OSError
    return open_
tell(act)
""",
    "C itself": """
import ctypes
def act():
    libc = ctypes.CDLL(None, use_errno=True)
    fd = libc.open(CANARY.encode(), 0)
    if fd < 0: raise OSError
    buffer = ctypes.create_string_buffer(100)
    libc.read(fd, buffer, 100)
    return buffer.value
tell(act)
""",
}
"""Name to cells that raise what they find, after LEAKED."""

HARMS = {
    "write beside the results": "harm(lambda: open(OUT + '/forged', 'w').write('x'))\n",
    "overwrite the gradebook": "harm(lambda: open(OUT + '/grades.db', 'wb').write(b''))\n",
    "delete a file": "import os; harm(lambda: os.remove(CANARY))\n",
    "change rights": "import os; harm(lambda: os.chmod(CANARY, 0o777))\n",
    "write into the system": "harm(lambda: open('/tmp/forged-by-a-student', 'w').write('x'))\n",
    "kill the judge": "import os; harm(lambda: os.kill(JUDGE, 9))\n",
    "kill the parent": "import os; harm(lambda: os.kill(os.getppid(), 9))\n",
    "kill everybody": "import os; harm(lambda: os.kill(-1, 15))\n",
    "starve the parent": """
import resource, os
harm(lambda: resource.prlimit(os.getppid(), resource.RLIMIT_CPU, (0, 0)))
""",
    "fifty processes": """
import os
def act():
    for _ in range(50):
        if os.fork() == 0:
            import time; time.sleep(20); os._exit(0)
harm(act)
""",
    "a process that stays": """
import os, time
def act():
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            for _ in range(100):
                time.sleep(0.1)
                try: open(CANARY + '-alive', 'w').close()
                except OSError: pass
        os._exit(0)
harm(act)
""",
    "a program": """
import subprocess
harm(lambda: subprocess.run(['touch', CANARY + '-touched']))
""",
    "a connection": """
import socket
harm(lambda: socket.create_connection(('127.0.0.1', PORT), 2).sendall(b'hello'))
""",
    "a server": """
import socket
def act():
    s = socket.socket(); s.bind(('', PORT + 1)); s.listen()
harm(act)
""",
    "a signal by a file's owner": """
import fcntl, os, signal
def act(judge):
    reading, writing = os.pipe()
    fcntl.fcntl(reading, fcntl.F_SETOWN, judge)
    fcntl.fcntl(reading, 10, signal.SIGKILL)  # F_SETSIG
    fcntl.fcntl(reading, fcntl.F_SETFL, os.O_ASYNC | os.O_NONBLOCK)
    os.write(writing, b'x')
for pid in (JUDGE, os.getppid()): harm(lambda: act(pid))
""",
    "small threads without number": """
import threading, time
def act():
    threading.stack_size(32768)
    for _ in range(3000): threading.Thread(target=time.sleep, args=(30,), daemon=True).start()
harm(act)
""",
    "small files without number": """
import time
def act():
    end, i = time.monotonic() + 2, 0
    while time.monotonic() < end:
        i += 1
        open(f'f{i}', 'w').close()
harm(act)
""",
    "large pipes": """
import fcntl, os
def act():
    for _ in range(50): fcntl.fcntl(os.pipe()[1], 1031, 1 << 20)  # F_SETPIPE_SZ
harm(act)
""",
    "a name that no folder knows": """
import socket
def act():
    s = socket.socket(socket.AF_UNIX); s.bind(chr(0) + 'forged'); s.listen()
harm(act)
harm(lambda: socket.socketpair())
""",
    "a traceback that ends all": """
import faulthandler
faulthandler.dump_traceback_later(1, exit=True)
""",
    "an alarm": "import signal; signal.alarm(1); signal.setitimer(signal.ITIMER_REAL, 0.5, 0.1)\n",
    "an abort": "import os; os.abort()\n",
    "a process that stands": "import os, signal; os.kill(os.getpid(), signal.SIGSTOP)\n",
    "a frame that never ends": """
import os, struct
for number in range(3, 20):
    try:
        os.write(number, struct.pack("<II", 1000, 0))
    except OSError:
        pass
""",
    "streams closed": """
import os, sys
for stream in (sys.stdin, sys.stdout, sys.stderr): harm(stream.close)
sys.stdout = sys.stderr = None
for number in (0, 1, 2): harm(lambda: os.close(number))
""",
    "everything raises": """
import warnings
warnings.simplefilter('error')
np.seterr(all='raise')
""",
    "a notebook's own words": """
%load_ext autoreload
%matplotlib widget
%run nothing.py
!rm -rf / ; touch $CANARY-by-shell
get_ipython().run_cell('1 / 0')
""",
    "JavaScript": "%%javascript\nalert(1)\n",
    "a question": "name = input('your name? ')\n",
    "an exit": "exit()\n",
    "awaiting": "import asyncio\nawait asyncio.sleep(30)\n",
    "rubbish kept": "import gc; gc.set_debug(gc.DEBUG_SAVEALL); gc.disable(); gc.freeze()\n",
    "eight gigabytes": "harm(lambda: bytearray(8 << 30).append(1))\n",
    "a long file": """
def act():
    with open('long', 'wb') as file:
        for _ in range(200): file.write(bytes(1 << 20))
harm(act)
""",
    "many files": """
import os
def act():
    for i in range(3000): open(f'f{i}', 'w').close()
harm(act)
""",
    "deep folders": """
import os
def act():
    for _ in range(300): os.mkdir('d'); os.chdir('d')
harm(act)
""",
    "much output": "import sys\nfor _ in range(50): sys.stdout.write('x' * 10**6)\n",
    "a long message": "raise ValueError('<script>' + 'x' * 10**8)\n",
    "threads": """
import threading, time
def act():
    for _ in range(200): threading.Thread(target=time.sleep, args=(30,), daemon=True).start()
harm(act)
""",
    "a loop that nothing interrupts": """
while True:
    try:
        while True: pass
    except BaseException: pass
""",
    "a signal handler": """
import signal
for number in range(1, 32):
    harm(lambda: signal.signal(number, signal.SIG_IGN))
harm(lambda: signal.raise_signal(signal.SIGSTOP))
""",
    "a crash": "import ctypes; ctypes.string_at(0)\n",
    "the recursion limit": "import sys; sys.setrecursionlimit(10**7)\ndef f(): return f()\nf()\n",
}
"""Name to cells that try to change something outside or to outlive their grading."""

DAMAGED = {
    "truncated": lambda text: text[: len(text) // 2].encode(),
    "empty": lambda text: b"",
    "bytes of zero": lambda text: bytes(1000),
    "latin-1": lambda text: text.replace("import", "# é\\nimport", 1).encode("latin-1"),
    "nested": lambda text: b'{"cells": ' + b"[" * 100_000 + b"]" * 100_000 + b"}",
    "no cells": lambda text: b'{"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}',
    "a list": lambda text: b"[1, 2, 3]",
    "version 3": lambda text: b'{"worksheets": [{"cells": []}], "metadata": {}, "nbformat": 3}',
    "not JSON": lambda text: b"PK\x03\x04 a zip",
    "a wrong kernel": lambda text: text.replace(
        '"metadata": {"slamlab"', '"metadata": {"kernelspec": {"name": "nowhere"}, "slamlab"'
    ).encode(),
    "a hundred megabytes": lambda text: text.encode() + b" " * (100 << 20),
    "no metadata": lambda text: _changed(text, metadata=None),
    "deleted cells": lambda text: _changed(text, cells=json.loads(text)["cells"][:1]),
    "duplicated cells": lambda text: _changed(text, cells=json.loads(text)["cells"] * 3),
    "a folder": lambda text: None,
}
"""Name to a function that damages an ordinary notebook's text; None for a folder."""

GRADED = {"latin-1", "a wrong kernel", "no metadata", "duplicated cells"}
"""Damaged notebooks that still contain all code of the ordinary one."""


def _changed(text, **changes):
    return json.dumps({k: v for k, v in (json.loads(text) | changes).items() if v}).encode()


for own, others in [
    (FORGERIES, more.FORGERIES),
    (SPIES, more.SPIES),
    (HARMS, more.HARMS),
    (DAMAGED, more.DAMAGED),
]:
    own |= others
GRADED |= more.GRADED
