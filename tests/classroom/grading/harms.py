"""Attacks that change something outside, use up the machine, or outlive their grading."""

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
"""Name to cells that try to change something outside or to outlive their grading."""
