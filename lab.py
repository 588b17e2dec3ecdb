"""Set up the course in a separate environment and open it in JupyterLab.

    python lab.py                        set up if necessary, then open the course
    python lab.py --no-browser           other arguments go to JupyterLab
    python lab.py --lecture              also install packages to rehearse and print lessons
    python lab.py --install-only         set up, open nothing

This file uses only the standard library and syntax that every Python since 2.7 can parse.
Therefore, an old Python reports its version instead of a syntax error.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import time

OLDEST, NEWEST = (3, 11), (3, 13)
ROOT = os.path.dirname(os.path.abspath(__file__))
START = "notebooks/00_start_here.ipynb"
STAMP = "slamlab-stamp.json"
LECTURE_LOCK = "requirements-test.lock"  # in no student's pack
LECTURE = ("greenlet", "playwright")  # and what they need besides: nothing
NEWS = "@jupyterlab/apputils-extension:announcements"
# what differs from JupyterLab's own settings: the width of the side bar is for whole names
SETTINGS = {"@jupyterlab/filebrowser-extension:browser": {"showLastModifiedColumn": False}}
PROJECT = (
    "pyproject.toml",
    "slamlab/pyproject.toml",
    "labextension",
)  # what is copied into the environment, not linked
SPACE = 1.2e9  # bytes

# Signs in pip's output, and the message for the reader: the first match counts.
FULL = "the disk is full; make room (about 1 GB) and start again"
OFFLINE = "the package index cannot be reached; connect to a network and start again"
TROUBLES = (
    (("No space left", "Errno 28"), FULL),
    (("DO NOT MATCH THE HASHES",), "a download does not match the lock file; start again"),
    (("Retrying (", "Max retries", "ConnectionError", "Timeout"), OFFLINE),
    (("No matching distribution",), "no network, or no package for this computer and Python"),
)


class Trouble(SystemExit):
    """An error that ends the program with one line: what is wrong and what to do."""

    def __init__(self, text):
        SystemExit.__init__(self, "lab.py: " + text)
        self.text = text


def say(text):
    sys.stderr.write("lab.py: %s\n" % text)
    sys.stderr.flush()


def supported():
    return OLDEST <= sys.version_info[:2] <= NEWEST


def check_python():
    """Refuse a Python that cannot run the course."""
    version = "%d.%d" % sys.version_info[:2]
    if not supported():
        age = "older" if sys.version_info[:2] < OLDEST else "newer"
        found = other_python()
        raise Trouble(
            "Python %s is %s than the course supports, which is %d.%d to %d.%d; "
            % ((version, age) + OLDEST + NEWEST)
            + ("run: %s lab.py" % found if found else "install one of these")
        )
    try:
        import ensurepip  # noqa: F401
        import venv  # noqa: F401
    except ImportError:
        raise Trouble(
            "this Python cannot make virtual environments (venv or ensurepip is missing); "
            "on Debian or Ubuntu: sudo apt install python%s-venv" % version
        )


def other_python():
    """Return the command of a suitable Python on this computer, or None."""
    for minor in range(NEWEST[1], OLDEST[1] - 1, -1):
        for command in (["python3.%d" % minor], ["py", "-3.%d" % minor]):
            try:
                subprocess.check_output(command + ["--version"], stderr=subprocess.STDOUT)
                return " ".join(command)
            except (OSError, subprocess.CalledProcessError):
                continue
    return None


def python_of(venv):
    where = ("Scripts", "python.exe") if os.name == "nt" else ("bin", "python")
    return os.path.join(venv, *where)


def log_of(venv):
    return os.path.join(venv, "install.log")


def environment():
    """Return the variables for child processes, without those that add foreign packages (ROS sets
    some)."""
    leaks = ("PYTHONPATH", "PYTHONHOME", "PIP_TARGET", "PIP_PREFIX", "PIP_CONSTRAINT")
    kept = {name: value for name, value in os.environ.items() if name not in leaks}
    return dict(kept, PIP_USER="0", PIP_DISABLE_PIP_VERSION_CHECK="1", PYTHONUNBUFFERED="1")


def run(venv, *arguments):
    """Run a module of the environment, write its output to the log, and return its exit code."""
    command = [python_of(venv), "-m"] + list(arguments)
    began = time.time()
    with open(log_of(venv), "ab") as log:
        process = subprocess.Popen(
            command, cwd=ROOT, env=environment(), stdin=subprocess.DEVNULL, stdout=log, stderr=log
        )
        try:
            while process.poll() is None:
                time.sleep(0.1)
                if sys.stderr.isatty():
                    sys.stderr.write("\r  %d s \r" % (time.time() - began))
        except KeyboardInterrupt:
            process.kill()
            process.wait()
            raise
    return process.returncode


def install(venv, *arguments):
    """Run ``pip install`` for exactly the named packages; raise Trouble with cause and remedy."""
    log = log_of(venv)
    size = os.path.getsize(log) if os.path.exists(log) else 0
    if run(venv, "pip", "install", "--no-deps", "--no-compile", *arguments) == 0:
        return
    with open(log, errors="replace") as file:
        file.seek(size)
        lines = file.read().splitlines()
    output = "\n".join(lines)
    fitting = [why for signs, why in TROUBLES if any(sign in output for sign in signs)]
    why = fitting[0] if fitting else "pip failed; its output is in " + log
    errors = [line for line in lines if line.startswith("ERROR")] or lines[-1:]
    raise Trouble(why + " (%s)" % "".join(errors[:1])[:160])


def install_all(venv, lock, lecture):
    """Install the locked packages, a browser driver if requested, and the project; compile them;
    disable news."""
    locked = ("--require-hashes", "--only-binary", ":all:", "-r")
    say("downloading and unpacking packages")
    install(venv, *(locked + (os.path.join(ROOT, lock),)))
    if lecture:
        driver = os.path.join(venv, "lecture.lock")
        with open(driver, "w") as file:
            file.write(entries(LECTURE_LOCK, LECTURE))
        install(venv, *(locked + (driver,)))
    library = os.path.join(ROOT, "slamlab")
    install(venv, "--no-index", "--no-build-isolation", "-e", library, "-e", ROOT)
    say("compiling, so that notebooks start fast")
    # On all cores, which pip does not do; some packages carry templates that no Python compiles.
    packages = os.path.join(venv, "Lib" if os.name == "nt" else "lib")
    run(venv, "compileall", "-q", "-j", "0", packages)
    if run(venv, "jupyterlab.labextensions", "disable", NEWS):
        raise Trouble("JupyterLab does not start; see the end of " + log_of(venv))
    settings = os.path.join(venv, "share", "jupyter", "lab", "settings")
    os.makedirs(settings, exist_ok=True)
    with open(os.path.join(settings, "overrides.json"), "w") as file:
        json.dump(SETTINGS, file, indent=1)


def entries(lock, names):
    """Return the text of the named packages' entries in a lock file."""
    with open(os.path.join(ROOT, lock)) as file:
        blocks = file.read().replace("\n ", "\0").splitlines(True)
    return "".join(b for b in blocks if b.split("==")[0] in names).replace("\0", "\n ")


def read_stamp(venv):
    try:
        with open(os.path.join(venv, STAMP)) as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def write_stamp(venv, stamp):
    with open(os.path.join(venv, STAMP), "w") as file:
        json.dump(stamp, file, indent=1)


def digest(*paths):
    """Return a digest of files and of all files in folders."""
    found = []
    for path in [os.path.join(ROOT, path) for path in paths]:
        found.append(path)
        for folder, _, names in os.walk(path):
            found += [os.path.join(folder, name) for name in names]
    whole = hashlib.sha256()
    for path in sorted(filter(os.path.isfile, found)):
        with open(path, "rb") as file:
            whole.update(file.read().replace(b"\r\n", b"\n"))
    return whole.hexdigest()


def make_venv(venv):
    """Create an empty environment; replace one that is unfinished, moved or of another Python."""
    import venv as builder

    if os.path.isdir(venv) and os.listdir(venv):
        if not any(os.path.exists(os.path.join(venv, mark)) for mark in (STAMP, "pyvenv.cfg")):
            raise Trouble("%s exists but is not a virtual environment; move it" % venv)
        write_stamp(venv, {})  # first written, last removed: the mark of a folder that is ours
        for entry in os.scandir(venv):
            if entry.name != STAMP:
                real = entry.is_dir(follow_symlinks=False)
                (shutil.rmtree if real else os.remove)(entry.path)
    if shutil.disk_usage(ROOT).free < SPACE:
        raise Trouble(FULL)
    os.makedirs(venv, exist_ok=True)
    write_stamp(venv, {})
    builder.EnvBuilder(with_pip=True, symlinks=os.name != "nt", prompt="slamlab").create(venv)


def set_up(venv, lock, lecture):
    """Install the packages that the lock and the project require, unless they are installed
    already.

    The stamp records what was installed. It is empty during the installation, so an interrupted
    installation is detected and repeated at the next start.
    """
    stamp = read_stamp(venv)
    here = {"place": venv, "python": "%d.%d" % sys.version_info[:2]}
    usable = all(stamp.get(key) == here[key] for key in here) and os.path.exists(python_of(venv))
    wanted = dict(here, lock=digest(lock), project=digest(*PROJECT))
    wanted["lecture"] = lecture or (usable and stamp["lecture"])
    if usable and stamp == wanted:
        return
    began = time.time()
    say("setting up %s (only once; it takes a few minutes)" % os.path.relpath(venv, ROOT))
    if not usable:
        make_venv(venv)
        stamp = {}
    write_stamp(venv, {})
    try:
        install_all(venv, lock, wanted["lecture"])
    except Trouble as trouble:
        if trouble.text.startswith(OFFLINE):  # nothing has been changed
            write_stamp(venv, stamp)
        raise
    write_stamp(venv, wanted)
    say("set up in %.0f s" % (time.time() - began))


def look_for_browser(venv):
    """Report whether a browser is installed, which only rehearsals and handouts need."""
    command = [python_of(venv), "-m", "classroom.lecturing.headless"]
    process = subprocess.Popen(
        command, cwd=ROOT, env=environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    found = process.communicate()[0].decode("utf-8", "replace").strip()
    say("for slamlab rehearse and slamlab handout: " + (found or "no browser was found"))


def open_lab(venv, arguments):
    """Replace this process with JupyterLab, which opens the first notebook."""
    command = [python_of(venv), "-m", "jupyterlab", "--ServerApp.root_dir=" + ROOT]
    command.append("--LabApp.default_url=/lab/tree/" + START)
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        say("you are root: JupyterLab is started with --allow-root")
        command.append("--allow-root")
    command += arguments
    os.chdir(ROOT)
    # so that slamlab is found in JupyterLab's terminals
    known = environment()
    # the course's matrices are small: their products gain nothing by more threads, and cost more
    known.setdefault("OPENBLAS_NUM_THREADS", "1")
    known["PATH"] = os.pathsep.join([os.path.dirname(command[0]), known.get("PATH", os.defpath)])
    if os.name != "nt":
        os.execve(command[0], command, known)
    process = subprocess.Popen(command, env=known)
    while True:
        try:
            return process.wait()
        except KeyboardInterrupt:  # JupyterLab has it too, and asks what is meant
            continue


def main(arguments):
    check_python()
    parser = argparse.ArgumentParser(
        prog="lab.py",
        description="Set up the course and open it in JupyterLab, which gets the other arguments.",
        allow_abbrev=False,
    )
    parser.add_argument(
        "--lecture",
        action="store_true",
        help="install the packages for slamlab rehearse and slamlab handout",
    )
    parser.add_argument("--install-only", action="store_true", help="set up, open nothing")
    parser.add_argument("--venv", default=".venv", help="where to install (.venv)")
    parser.add_argument(
        "--lock", default="requirements.lock", help="lock file of the packages (requirements.lock)"
    )
    options, rest = parser.parse_known_args(arguments)
    if options.lecture and not os.path.exists(os.path.join(ROOT, LECTURE_LOCK)):
        raise Trouble("--lecture needs the whole project or the lecturers' pack; omit --lecture")
    venv = os.path.realpath(os.path.join(ROOT, options.venv))
    try:
        set_up(venv, options.lock, options.lecture)
        if options.lecture:
            look_for_browser(venv)
    except KeyboardInterrupt:
        raise Trouble("stopped; start again to finish")
    except (OSError, subprocess.CalledProcessError) as error:
        raise Trouble(FULL if getattr(error, "errno", 0) == 28 else str(error))
    return 0 if options.install_only else open_lab(venv, rest)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
