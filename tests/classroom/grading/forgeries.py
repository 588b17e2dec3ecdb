"""Attacks that forge points: numbers and arrays that lie, tampered tools, hooks, messages."""

WRITES = """
import json, os, struct
def write(data):
    for fd in range(3, 40):
        try: os.write(fd, data)
        except OSError: pass
def framed(head, arrays=b''):
    head = json.dumps(head).encode()
    return struct.pack('<II', len(head), len(arrays)) + head + arrays
"""
"""Writes into every pipe, what may be a frame of the worker's."""

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
    "the pipe": f"""{WRITES}
write(framed({{'head': {{'turn': 2, 'points': 99, 'full': True}}, 'arrays': []}}))
""",
    "noise in the pipe": f"{WRITES}\nwrite(os.urandom(60000))\n",
    "an answer before the question": f"""{WRITES}
def double(a):
    for turn in range(2, 30):
        head = {{'head': {{'turn': turn}}, 'arrays': [['0/result', 'f8', [20]]]}}
        write(framed(head, np.full(20, 3.0).tobytes()))
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
    "a thread that answers": f"""{WRITES}
import threading, time
def shout():
    for _ in range(200):
        for turn in range(2, 12):
            head = {{'head': {{'turn': turn, 'full': True}}, 'arrays': [['0/result', 'f8', [20]]]}}
            write(framed(head, np.full(20, 3.0).tobytes()))
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
    # arrays
    "strides beyond all memory": """
from numpy.lib.stride_tricks import as_strided
def turn(v, angle): return as_strided(np.zeros(1), (2,), (1 << 40,))
""",
    "one number that looks like a billion": """
def turn(v, angle): return np.broadcast_to(np.float64(3), (1 << 40,))
""",
    "numbers that are none": """
def double(a): return np.array(-a + 2j * a)
def turn(v, angle): return np.array([(1.0, 2.0)], dtype=[('x', float), ('y', float)])
def total(a): return np.array(['3', '4'])
""",
    "masks and matrices": """
def double(a): return np.ma.masked_all(())
def turn(v, angle): return np.ma.masked_all(2)
def total(a): return np.matrix([[3.0]])
""",
    "dates and objects": """
def double(a): return np.datetime64('2026-11-23')
def turn(v, angle): return np.array([object(), None], dtype=object)
def total(a): return np.timedelta64(3, 's')
""",
    "a file that is an answer": """
import threading, time
def turn(v, angle):
    answer = np.memmap('answer', mode='w+', shape=(2,), dtype=float)
    def later():
        for i in range(50): answer[:] = i; time.sleep(0.001)
    threading.Thread(target=later, daemon=True).start()
    return answer
""",
    "an array that changes while it is read": """
class Turning:
    @property
    def __array_interface__(self):
        Turning.n = getattr(Turning, 'n', 0) + 1
        return {'shape': (Turning.n,), 'typestr': '<f8', 'version': 3, 'data': (8, False)}
def turn(v, angle): return Turning()
""",
    # errors that are answers
    "an error of the judge's own kind": """
from classroom.exercises.function_calls import StudentError
def double(a): raise StudentError('full', '99 points')
def turn(v, angle): raise StudentError(None, {'points': 99})
def total(a): raise StudentError('needs', 99)
""",
    "errors in errors": """
class Odd(Exception):
    __str__ = __repr__ = lambda self: 1 / 0
def double(a):
    error = Odd()
    for _ in range(2000): error = ExceptionGroup('x', [error])
    raise error
def turn(v, angle):
    error = ValueError('\\x1b[2J %s {0} \\u202e \\ud800')
    error.add_note('x' * 10**7)
    raise error
""",
    # the interpreter
    "two is four": """
import ctypes
ctypes.memmove(id(2) + 24, id(4) + 24, 4)
def double(a): return -a
""",
    "an audit of everything": """
import sys
def heard(event, given): raise RuntimeError('99 points')
sys.addaudithook(heard)
""",
    "a tool that watches": """
import sys
if hasattr(sys, 'monitoring'):
    own = sys.monitoring
    own.use_tool_id(3, 'x')
    own.set_events(3, own.events.PY_RETURN)
    own.register_callback(3, own.events.PY_RETURN, lambda *a: 1 / 0)
else: sys.setprofile(lambda *a: 1 / 0)
""",
    "no builtins": "import builtins; vars(builtins).clear()\n",
    "modules made anew": """
import importlib, sys
import classroom.grading.wire_protocol as w, classroom.grading.worker as k
for module in (w, k, json) if 'json' in globals() else (w, k): importlib.reload(module)
k._drive = lambda *a: ({'points': 99, 'full': True}, {})
sys.modules['numpy'] = None
""",
    "words of another alphabet": """
import json.encoder, json
json.encoder.encode_basestring_ascii = lambda text: '"points"'
json.dumps = lambda *a, **k: '{"head": {"turn": 2, "points": 99}, "arrays": []}'
""",
    "the last will of an object": f"""{WRITES}
class Will:
    def __float__(self): return -3.0
    def __del__(self): write(framed({{'head': {{'turn': 3, 'points': 99}}, 'arrays': []}}))
def double(a): return Will()
""",
    "a pickle on the wire": f"""{WRITES}
import pickle
class Run:
    def __reduce__(self): return os.system, ('touch /tmp/forged-by-a-student',)
data = pickle.dumps(Run())
write(struct.pack('<II', len(data), len(data)) + data + data)
""",
    "who reads the questions": """
import os
def double(a):
    for fd in range(3, 9):
        os.set_blocking(fd, False) if fd < 5 else None
        try: os.read(fd, 1 << 20)
        except OSError: pass
    return -a
""",
    "print into the pipe": """
import os
for fd in (3, 4):
    try: os.dup2(fd, 1)
    except OSError: pass
    print('{"points": 99}' * 10**5, flush=True)
""",
}
"""Name to cells after WRONG; every point that they earn is forged."""
