"""Further attacks for ``attacks``: unusual arrays, hooks of the interpreter, rare system calls, and
invalid notebooks that are valid JSON.
"""

import json

FORGERIES = {
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
    "the last will of an object": """
import os, struct
class Will:
    def __float__(self): return -3.0
    def __del__(self):
        head = b'{"head": {"turn": 3, "points": 99}, "arrays": []}'
        for fd in range(3, 9):
            try: os.write(fd, struct.pack('<II', len(head), 0) + head)
            except OSError: pass
def double(a): return Will()
""",
    "a pickle on the wire": """
import os, pickle, struct
class Run:
    def __reduce__(self): return os.system, ('touch /tmp/forged-by-a-student',)
data = pickle.dumps(Run())
for fd in range(3, 9):
    try: os.write(fd, struct.pack('<II', len(data), len(data)) + data + data)
    except OSError: pass
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

SPIES = {
    "files by other doors": """
import ctypes, linecache, mmap, os, sqlite3, zipimport
def by_map():
    with open(CANARY, 'rb') as file: return mmap.mmap(file.fileno(), 0, prot=1)[:]
doors = (
    lambda: bytes(np.fromfile(CANARY, dtype='u1')), lambda: bytes(np.memmap(CANARY, mode='r')),
    lambda: np.genfromtxt(CANARY, dtype=str), lambda: linecache.getlines(CANARY)[0],
    lambda: __loader__.get_data(CANARY), lambda: zipimport.zipimporter(CANARY),
    lambda: ctypes.CDLL(CANARY), by_map, lambda: os.statvfs(CANARY).f_bavail,
    lambda: os.readlink('/proc/self/root/' + CANARY),
    lambda: open('/proc/self/root' + CANARY).read(),
    lambda: open('/proc/thread-self/cwd/../../..' + CANARY).read(),
    lambda: os.getxattr(CANARY, 'user.x'), lambda: os.pread(os.open(CANARY, os.O_PATH), 9, 0),
    lambda: sqlite3.connect(f'file:{OUT}/grades.db?mode=ro', uri=True).execute(
        'select * from ledger').fetchone(),
)
for door in doors:
    try: found = door()
    except BaseException: continue
    if CANARY.encode() not in repr(found).encode(): raise ValueError(f'LEAKED {found}')
""",
    "rare doors of the kernel": """
import ctypes
def act():
    libc, done = ctypes.CDLL(None, use_errno=True), []
    calls = {
        'ptrace': (101, 16, JUDGE), 'io_uring': (425, 8, ctypes.create_string_buffer(120)),
        'userfaultfd': (323, 0), 'memfd': (319, b'x', 0), 'mq_open': (240, b'x', 66, 384, 0),
        'shmget': (29, 0, 4096, 0o1666), 'msgget': (68, 0, 0o1666), 'semget': (64, 0, 1, 0o1666),
        'inotify': (253,), 'fanotify': (300, 0, 0), 'pidfd': (434, JUDGE, 0),
        'tkill': (200, JUDGE, 0), 'process_vm_readv': (310, JUDGE, 0, 0, 0, 0, 0),
        'unshare': (272, 0x10000000), 'setns': (308, 0, 0), 'mount': (165, 0, 0, 0, 0, 0),
        'chroot': (161, b'.'), 'keyctl': (250, 0, -3, 1), 'bpf': (321, 0, 0, 0),
        'perf': (298, 0, 0, -1, -1, 0), 'nice': (141, 0, 0, -20), 'ioprio': (251, 1, 0, 0),
        'scheduler': (144, 0, 1, 0), 'affinity': (203, 0, 8, b'x' * 8), 'vfork': (58,),
        'execveat': (322, 0, b'/bin/true', 0, 0, 0), 'subreaper': (157, 36, 1, 0, 0, 0),
        'dumpable': (157, 4, 1, 0, 0, 0), 'clone3': (435, 0, 0), 'timer': (222, 0, 0, 0),
    }
    for name, words in calls.items():
        if libc.syscall(*words) >= 0: done.append(name)
    if not done: raise OSError
    return done
import platform
if platform.machine() == 'x86_64': tell(act)
""",
    "memory that others share": """
import os
from multiprocessing import shared_memory
def written():
    path = '/dev/shm/slamlab-forged'
    open(path, 'w').write('x')
    return path
tell(written)
tell(lambda: shared_memory.SharedMemory('slamlab', create=True, size=99).name)
tell(lambda: os.listdir('/dev/shm'))
""",
}

HARMS = {
    "another way to start a program": """
import os
harm(lambda: os.posix_spawn('/bin/true', ['true'], {}))
harm(lambda: os.execv('/bin/true', ['true']))
harm(lambda: os.system('true'))
""",
    "more for itself": """
import os, resource
for what in (resource.RLIMIT_CORE, resource.RLIMIT_AS, resource.RLIMIT_FSIZE, resource.RLIMIT_CPU):
    harm(lambda: resource.setrlimit(what, (-1, -1)))
harm(lambda: os.nice(-10))
harm(lambda: os.sched_setaffinity(0, [0]))
""",
    "another place and language": """
import locale, os, time
os.umask(0o777); os.environ.clear(); os.environ['TZ'] = 'Mars'; harm(time.tzset)
harm(lambda: os.chdir('/')); harm(lambda: locale.setlocale(locale.LC_ALL, 'tr_TR.UTF-8'))
""",
    "names that no list can show": """
import os
def act():
    for name in ('a\\nb', '\\u202egnp', 'x' * 255, '-rf', '\\udcff', ' ', '*', "'"):
        open(name, 'w').close()
    os.mkfifo('pipe'); os.symlink('loop', 'loop'); os.mkdir('shut'); open('shut/x', 'w').close()
    os.chmod('shut', 0); os.chmod('.', 0)
harm(act)
""",
    "threads that stay": """
import threading, time
def on():
    while True: time.sleep(0.01)
for _ in range(10): threading.Thread(target=on).start()
""",
    "hooks that fail": """
import gc, sys, threading, warnings, weakref
def fail(*a, **k): raise RuntimeError('no')
gc.callbacks.append(fail)
sys.excepthook = sys.unraisablehook = sys.displayhook = threading.excepthook = fail
warnings.showwarning = fail
kept = weakref.ref(type('T', (), {})(), fail)
import atexit; atexit.register(fail)
""",
    "an error that takes its time": """
import time
class Slow(Exception):
    def __str__(self): time.sleep(60)
raise Slow
""",
    "half a letter": "raise ValueError('\\ud800' * 9)\n",
    "a text with a zero in it": "x = 'a\\0b'\nraise ValueError(x)\n",
    "a hundred thousand causes": """
def act():
    error = ValueError()
    for _ in range(100_000):
        error, error.__context__ = ValueError(), error
    raise error
act()
""",
    "a list in itself": "loop = []; loop.append(loop); loop = {'a': loop}; print(loop); loop\n",
    "other numbers everywhere": """
import decimal, random
np.set_printoptions(threshold=10**9); np.seterr(all='ignore'); np.random.seed(0)
random.seed(0); decimal.getcontext().prec = 10**6
""",
}


def _ordinary(text, **changes):
    return json.dumps(json.loads(text) | changes).encode()


def _cells(text, **changes):
    cells = json.loads(text)["cells"]
    return _ordinary(text, cells=[cell | changes for cell in cells])


def _named(text, exercise):
    return _ordinary(text, metadata={"slamlab": {"exercise": exercise}})


DAMAGED = {
    "an integer of 5000 digits": lambda text: _with(text, "9" * 5000),
    "a number that is none": lambda text: _with(text, "[NaN, -Infinity, 1e999]"),
    "folders of lists": lambda text: _with(text, "[" * 900 + "]" * 900),
    "half a letter": lambda text: _with(text, '"\\ud800\\udfff"'),
    "a key twice": lambda text: text.replace('{"cells"', '{"cells": [], "cells"', 1).encode(),
    "ids that are none": lambda text: _cells(text, id=["x" * 10**5, {"a": None}]),
    "attachments": lambda text: _cells(text, attachments={"../x.png": {"image/png": "A" * 10**6}}),
    "metadata of another type": lambda text: _ordinary(text, metadata=[1, "x"]),
    "cells of other types": lambda text: _cells(text, metadata=None, outputs=5, execution_count=""),
    "words behind its end": lambda text: text.encode() + b" {}",
    "32 bits a letter": lambda text: text.encode("utf-32"),
    "an exercise of another alphabet": lambda text: _named(text, "\uff19\uff19"),
    "an exercise that is a path": lambda text: _named(text, "../../99"),
    "an exercise that is a list": lambda text: _named(text, ["99"]),
    "cells without end": lambda text: _ordinary(text, cells=json.loads(text)["cells"] * 600),
}
GRADED = {
    "a number that is none", "folders of lists", "half a letter", "a key twice",
    "ids that are none", "attachments", "metadata of another type", "cells of other types",
    "an exercise that is a list",
}  # fmt: skip


def _with(text, value):
    """The notebook with a value in its metadata, as it is written."""
    return text.replace('"metadata": {"slamlab"', f'"metadata": {{"x": {value}, "slamlab"').encode()
