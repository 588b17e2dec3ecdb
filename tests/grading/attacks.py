"""Submissions that try to earn what they do not know, to read what is not theirs, or to do harm.

Each is bounded: it starts a few processes, takes a few gigabytes or some seconds at most, so that
it may be run where the walls fail. CANARY is a file of the judge's, OUT the folder of results.
"""

import json

WRONG = """
import numpy as np
def double(a):
    return -a
def turn(v, angle):
    return v
def total(a):
    return a.sum()
"""
"""Earns nothing: not even the sign is kept."""

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
    "the drives": """
import slamlab.checks.drives as d
d.numbers = lambda value, function: np.ones(2)
d.StudentError = KeyError
d.Drive.__call__ = lambda self, names, inputs: {'result': np.zeros(20), 'full': np.ones(1)}
""",
    "the wire": """
import slamlab.grading.wire as w
packed = w.pack
w.pack = lambda head, arrays=None: packed(head | {'points': 99, 'full': True}, arrays)
""",
    "the worker": """
import slamlab.grading.worker as w
w._drive = lambda *a: ({'full': True, 'points': 99}, {})
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
        head = json.dumps({'head': {'turn': turn}, 'arrays': [['result', 'f8', [20]]]}).encode()
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
    "exit code 0": "import atexit, os; atexit.register(os._exit, 0)\ndef double(a): os._exit(0)\n",
    "silence": "def double(a): raise SystemExit(0)\ndef turn(v, angle): raise SystemExit(0)\n",
}
"""Name to cells behind WRONG: every point they earn is forged."""

SPIES = {
    "a file of the judge's": "tell(lambda: open(CANARY).read())\n",
    "its folder": "import os; tell(lambda: os.listdir(os.path.dirname(CANARY)))\n",
    "the results": "import os; tell(lambda: os.listdir(OUT))\n",
    "the secret": "tell(lambda: open(OUT + '/secret').read())\n",
    "the gradebook": "tell(lambda: open(OUT + '/grades.db', 'rb').read(16))\n",
    "other submissions": "import glob; tell(lambda: glob.glob(CLASS + '/*.ipynb')[0])\n",
    "the solutions": "tell(lambda: open(ROOT + '/slamlab/checks/task.py').read(80))\n",
    "the answers as modules": """
import sys; sys.path.insert(0, ROOT)
for name in list(sys.modules):
    if name.startswith('slamlab'): del sys.modules[name]
def act():
    import slamlab.checks.task as t
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
"""Name to cells; what they find they raise, with LEAKED before it."""

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
"""Name to what becomes of an honest notebook's text, as bytes; None for a folder of that name."""

GRADED = {"latin-1", "a wrong kernel", "no metadata", "duplicated cells"}
"""The damaged that still say all that the honest one says."""


def _changed(text, **changes):
    return json.dumps({k: v for k, v in (json.loads(text) | changes).items() if v}).encode()
