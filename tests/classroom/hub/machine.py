"""A machine with other accounts and homes (bubblewrap), set up as docs/server.md describes."""

import contextlib
import os
import pwd
import re
import shutil
import socket
import subprocess
import sys
import threading
import urllib.error
import urllib.request
from pathlib import Path

from tests.course.setup import ROOT
from tests.timeouts import PATIENCE, until

GUIDE = (ROOT / "docs" / "server.md").read_text("utf-8")
INSTALLED = "/opt/slam-course"  # in the guide
ADMIN = pwd.getpwuid(0).pw_dir
# commands of the guide that cannot run here, and why
NOT_RUN = {
    "apt-get": "these packages are part of the machine",
    "chmod 700 /srv/slam": "the folder of these tests",
    "make -C": "run outside the machine, by the fixture",
    "systemctl": "there is no systemd; the command of the unit is run",
    "printf 'slam.example.edu": "the hub is reached without a certificate",
    "docker": "needs a daemon; test_dockerfile.py",
}


def block(first):
    """The commands of the guide's block that begins with a word."""
    blocks = re.findall(r"(?:^    .+\n)+", GUIDE, re.M)
    (found,) = (one for one in blocks if one.strip().startswith(first))
    return [line.strip() for line in found.splitlines()]


def is_run(command):
    return not any(command.startswith(words) for words in NOT_RUN)


def free_ports(count):
    with contextlib.ExitStack() as held:
        sockets = [held.enter_context(socket.create_server(("127.0.0.1", 0))) for _ in range(count)]
        return [one.getsockname()[1] for one in sockets]


class Machine:
    """Other accounts and homes, and the installation read-only."""

    def __init__(self, installation, folder, students):
        self.installation, self.home, self._etc = installation, folder / "home", folder / "etc"
        self.home.mkdir()
        shutil.copytree("/etc", self._etc, symlinks=True)
        (folder / "students.txt").write_text(
            "".join(f"{who}:pw-{who}:::{who.title()}:/home/{who}:/bin/bash\n" for who in students)
        )
        self._students = folder / "students.txt"

    def start(self, script, **variables):
        """Start a shell script on the machine as root."""
        python = Path(sys.base_prefix)
        command = ["bwrap", "--die-with-parent", "--unshare-pid", "--cap-add", "ALL"]
        command += ["--ro-bind", "/", "/", "--dev-bind", "/dev", "/dev", "--proc", "/proc"]
        command += ["--tmpfs", ADMIN, "--perms", "1777", "--tmpfs", "/tmp", "--tmpfs", "/var/lib"]
        command += ["--bind", self._etc, "/etc", "--bind", self.home, "/home"]
        for path in (python, self.installation):  # all may enter the folders around them
            for folder in reversed(path.parents[:-1]):
                command += ["--perms", "0755", "--dir", folder]
            command += ["--ro-bind", path, path]
        command += ["--bind", self._students, f"{ADMIN}/students.txt", "--chdir", ADMIN]
        script = script.replace(INSTALLED, str(self.installation))
        return subprocess.Popen(
            [*command, "sh", "-ec", script],
            env={"PATH": os.environ["PATH"], "HOME": ADMIN, **variables},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def run(self, script):
        """Run a shell script on the machine as root, and return what it prints."""
        running = self.start(script)
        output = running.communicate(timeout=PATIENCE)[0]
        assert running.returncode == 0, output
        return output

    def set_up(self):
        """Run the commands of the guide that can run here."""
        self.run("\n".join(filter(is_run, block("apt-get"))).replace("shred -u", ": shred -u"))


@contextlib.contextmanager
def running_hub(machine):
    """The address of a running hub, started as the unit of the guide does."""
    public, inner, proxy = free_ports(3)
    unit = (ROOT / "classroom" / "hub" / "slam-hub.service").read_text("utf-8")
    command = re.search(r"^ExecStart=(.+)$", unit, re.M)[1]
    command += f" --JupyterHub.hub_port={inner}"
    command += f" --ConfigurableHTTPProxy.api_url=http://127.0.0.1:{proxy}"
    command += " --Spawner.args=--LabApp.expose_app_in_browser=True"
    address = f"http://127.0.0.1:{public}"
    variables = {"SLAM_HUB": f"{address}/", "SLAM_HUB_BIND": f"{address}/"}
    running = machine.start(f"mkdir /var/lib/slam-hub && cd /var/lib/slam-hub; exec {command}",
                            **variables)  # fmt: skip
    printed = []
    reading = threading.Thread(target=lambda: printed.extend(running.stdout))
    reading.start()

    def answers():
        assert running.poll() is None, "".join(printed[-40:])
        with contextlib.suppress(urllib.error.URLError, ConnectionError):
            return urllib.request.urlopen(f"{address}/hub/login").status == 200

    until(answers)
    yield address
    running.terminate()
    reading.join()
    running.wait()
