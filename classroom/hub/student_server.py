"""``python -m classroom.hub.student_server``: a student's Jupyter server on a JupyterHub.

The course is installed once for all students, read-only. A student's home contains only the
notebooks. Each start of the server updates the notebooks that have changed in the installation, and
keeps the student's answers."""

import os
import sys
import tempfile
from datetime import datetime
from pathlib import Path

from classroom.coursework import originals
from classroom.coursework.file_writing import write
from classroom.coursework.notebook_update import UpdateError, update_notebooks

INSTALLATION = Path(__file__).resolve().parents[2]
FOLDER = "slam-course"  # in the home
# kernels of a whole class that start at once would choose the same ports
SOCKETS = "--KernelManager.transport=ipc"
PHONES = "--ServerApp.jpserver_extensions={'classroom.hub.phones': True}"
EMPTY_ZIP = b"PK\x05\x06" + bytes(18)


def hand_out(folder: Path, installation: Path, now: datetime) -> list[str]:
    """Write the course's notebooks into a student's folder, or update them; return messages.

    Raises UpdateError, OSError."""
    archive = installation / originals.ARCHIVE
    if not archive.is_file():
        raise UpdateError(f"{installation} is not a students' pack: {archive} is missing")
    own = folder / originals.ARCHIVE
    if not own.is_file():
        write(own, EMPTY_ZIP)  # nothing has been handed out
    lines = update_notebooks(folder, installation, now)
    write(own, archive.read_bytes())
    for guide in sorted(installation.glob("docs/*")):  # to which the notebooks link
        write(folder / "docs" / guide.name, guide.read_bytes())
    return lines


def main():
    """Hand out the notebooks, then replace this process with the student's server."""
    os.umask(0o077)
    os.chdir(Path.home())
    try:
        lines = hand_out(Path.home() / FOLDER, INSTALLATION, datetime.now())
    except (UpdateError, OSError) as error:  # the student can still work
        lines = [f"the notebooks were not updated: {error}"]
    print(*lines, sep="\n", flush=True)
    # the path of a socket has at most 107 letters
    os.environ["JUPYTER_RUNTIME_DIR"] = tempfile.mkdtemp(prefix="jupyter-")
    server = [sys.executable, "-m", "jupyterhub.singleuser", SOCKETS, PHONES, *sys.argv[1:]]
    os.execv(sys.executable, server)


if __name__ == "__main__":
    main()
