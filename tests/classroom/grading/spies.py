"""Attacks that read what is secret: files of the judge, answers, other submissions."""

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
"""Name to cells that raise what they find, after LEAKED."""
