"""docs/server.md on a machine of its own: a real hub, a lecture, and an exercise there and back.

The machine is this one with other accounts and homes (bubblewrap). ``make hub`` installs the course
for it, which takes minutes; the variable SLAMLAB_HUB names an installation to use instead."""

import contextlib
import os
import pwd
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import urllib.error
import urllib.request
from pathlib import Path

import nbformat
import pytest

from classroom.exercises import catalogue
from classroom.lecturing import headless
from tests.course.browser.jupyter import Visit
from tests.course.browser.lecture import Lecture
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
STUDENTS = ("ada", "alan", "lecturer")
EXERCISE = catalogue.exercise("04").file

# an answer of the kernel, without a cell
ASK = """async (code) => {
    let text = "";
    const { kernel } = window.jupyterapp.shell.currentWidget.sessionContext.session;
    const asked = kernel.requestExecute({ code });
    asked.onIOPub = ({ content }) => { text += content.text ?? content.evalue ?? ""; };
    await asked.done;
    return text;
}"""
LIVE = """import subprocess
live = subprocess.Popen("slamlab live sim:situation-2 --estimator walls".split(),
                        stdout=subprocess.PIPE, stdin=subprocess.PIPE, text=True)
print(live.stdout.readline())"""


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


@pytest.fixture(scope="module")
def installation():
    """The folder in which ``make hub`` has installed the course."""
    missing = [name for name in ("bwrap", "npm", "newusers") if not shutil.which(name)]
    if missing or os.geteuid() != 0:
        pytest.skip(f"needs root and {', '.join(missing) or 'no other user'}")
    if "SLAMLAB_HUB" in os.environ:
        yield Path(os.environ["SLAMLAB_HUB"])
        return
    with tempfile.TemporaryDirectory(dir="/var/tmp") as folder:  # the machine has its own /tmp
        os.chmod(folder, 0o755)
        target = Path(folder, "slam-course")
        command = ["make", "hub", f"HUB={target}", f"PYTHON={sys.executable}"]
        made = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        if "cannot be reached" in made.stderr:
            pytest.skip("the packages of the hub cannot be reached")
        assert made.returncode == 0, made.stderr[-2000:]
        yield target


class Machine:
    """Other accounts and homes, and the installation read-only."""

    def __init__(self, installation, folder):
        self.installation, self.home, self._etc = installation, folder / "home", folder / "etc"
        self.home.mkdir()
        shutil.copytree("/etc", self._etc, symlinks=True)
        (folder / "students.txt").write_text(
            "".join(f"{who}:pw-{who}:::{who.title()}:/home/{who}:/bin/bash\n" for who in STUDENTS)
        )
        self._students = folder / "students.txt"

    def start(self, script, **variables):
        """Start a shell script on the machine as root."""
        python = Path(sys.base_prefix)
        command = ["bwrap", "--die-with-parent", "--unshare-pid", "--cap-add", "ALL"]
        command += ["--ro-bind", "/", "/", "--dev-bind", "/dev", "/dev", "--proc", "/proc"]
        command += ["--tmpfs", ADMIN, "--tmpfs", "/tmp", "--tmpfs", "/var/lib"]
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


@pytest.fixture(scope="module")
def machine(installation, tmp_path_factory):
    made = Machine(installation, tmp_path_factory.mktemp("machine"))
    made.run("\n".join(filter(is_run, block("apt-get"))).replace("shred -u", ": shred -u"))
    return made


@pytest.fixture(scope="module")
def hub(machine):
    """The address of a running hub, started as the unit of the guide does."""
    public, inner, proxy = free_ports(3)
    unit = (ROOT / "classroom" / "hub" / "slam-hub.service").read_text("utf-8")
    command = re.search(r"^ExecStart=(.+)$", unit, re.M)[1]
    command += f" --JupyterHub.hub_port={inner}"
    command += f" --ConfigurableHTTPProxy.api_url=http://127.0.0.1:{proxy}"
    command += " --Spawner.args=--LabApp.expose_app_in_browser=True --Spawner.http_timeout=300"
    command += " --Spawner.start_timeout=300"
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


@pytest.fixture(scope="module")
def chromium():
    try:
        with headless.chromium() as browser:
            yield browser
    except headless.Unavailable as why:
        pytest.skip(str(why))


def log_in(browser, hub, who):
    """A page of JupyterLab of a user of the hub."""
    page = browser.new_context(viewport={"width": 1280, "height": 720}).new_page()
    visit = Visit(page, f"{hub}/user/{who}/lab/tree/slam-course/{{}}")
    page.goto(f"{hub}/hub/login?next=%2Fhub%2Fspawn")
    page.get_by_label("Username").fill(who)
    page.get_by_label("Password").fill(f"pw-{who}")
    page.get_by_role("button", name="Sign in").click()
    page.wait_for_selector(".jp-NotebookPanel .jp-Cell, .error")
    assert not page.locator(".error").count(), page.locator(".error").inner_text()
    return visit


@pytest.fixture(scope="module")
def students(chromium, hub):
    return {who: log_in(chromium, hub, who) for who in ("ada", "alan")}


pytestmark = [pytest.mark.slow, pytest.mark.walk]


def test_the_guide_has_ten_commands_and_each_is_run_or_has_a_reason():
    commands = block("apt-get")
    assert len(commands) == 10
    everything = [*commands, *block("make -C"), *block("docker")]
    assert all(any(c.startswith(words) for c in everything) for words in NOT_RUN)


def test_two_students_work_at_once_and_reach_nothing_of_each_other(students, hub, machine):
    verdicts = {}
    for who, visit in students.items():
        own = machine.home / who / "slam-course" / "exercises" / EXERCISE
        if who == "ada":
            owner = own.stat()
            shutil.copy(ROOT / "solutions" / EXERCISE, own)
            os.chown(own, owner.st_uid, owner.st_gid)
        visit.turn_to(f"slam-course/exercises/{EXERCISE}")
        visit.run_all_and_wait()
        visit.save()
        cells = nbformat.read(own, 4).cells
        outputs = [output for cell in cells for output in cell.get("outputs", ())]
        verdicts[who] = str(outputs)
        assert outputs and all(output.output_type != "error" for output in outputs)
    assert verdicts["ada"] != verdicts["alan"]
    alan, ada = students["alan"], students["ada"]
    for path in ("/home/ada", "/home/ada/slam-course/progress.json", str(machine.installation)):
        code = f"import os; print(os.access({path!r}, os.W_OK), os.access({path!r}, os.R_OK))"
        readable = path.startswith(str(machine.installation))
        assert alan.page.evaluate(ASK, code).split() == ["False", str(readable)], path
    for path in ("lab", "api/contents", "proxy/1/", "files/slam-course/progress.json"):
        answered = alan.page.request.get(f"{hub}/user/ada/{path}", max_redirects=0)
        assert answered.status in (302, 403), path
        assert answered.status == 403 or "/oauth2/" in answered.headers["location"]
    assert [] == ada.foreign_requests == alan.foreign_requests


def test_a_live_view_is_below_the_students_own_server(students, hub):
    ada, alan = students["ada"].page, students["alan"].page
    address = ada.evaluate(ASK, LIVE).split()[1]
    assert address.startswith(f"{hub}/user/ada/proxy/")
    view = ada.context.new_page()
    view.goto(address)
    view.get_by_text("connected").wait_for()
    view.locator("#view canvas").wait_for()
    other = alan.context.new_page()
    assert other.goto(address).status in (403, 404) or "/hub/" in other.url
    assert not other.locator("#view").count()
    ada.evaluate(ASK, 'live.communicate("exit\\n")')


def test_phones_follow_a_lecture_without_an_account_and_reach_nothing_else(chromium, hub):
    lecturer = log_in(chromium, hub, "lecturer")
    lecturer.open("notebooks/00_start_here.ipynb")
    shown = Lecture(lecturer)
    shown.start()
    shown.press("a")
    lecturer.page.get_by_role("button", name="open to phones").click()
    code = lecturer.page.locator(".slamlab-class-code").inner_text()
    address = lecturer.page.locator(".slamlab-class-address").inner_text()
    assert address == f"{hub}/user/lecturer/class"
    for _ in range(3):
        phone = chromium.new_context(viewport={"width": 390, "height": 780}).new_page()
        phone.goto(address)
        phone.get_by_label("Code on the lecturer's screen").fill(code)
        phone.keyboard.press("Enter")
        phone.get_by_text("Current slide: 1").wait_for()
        for path in ("lab", "api/contents", "api/kernels", "proxy/1/", "class/../api/contents"):
            answered = phone.request.get(f"{hub}/user/lecturer/{path}", max_redirects=0)
            assert answered.status in (302, 403, 404), path
    lecturer.page.get_by_text("3 phones connected").wait_for()
    lecturer.page.get_by_role("button", name="end it for the class").click()
    phone.get_by_text("The lecture has ended").wait_for()


def test_an_exercise_is_collected_graded_and_returned(students, machine):
    commands = block("mkdir -m 700 ~/term")
    roster = "printf 'id,name\\nada,Ada L\\nalan,Alan T\\n' > roster.csv"
    commands.insert(commands.index("slamlab grade init") + 1, roster)
    output = machine.run("\n".join(commands))
    assert "2 new or changed notebooks" in output and "2 feedback pages are in the homes" in output
    points = catalogue.exercise("04").points
    for who in ("ada", "alan"):
        page = machine.home / who / "slam-course" / "feedback" / "exercise-04.html"
        assert page.stat().st_uid == (machine.home / who).stat().st_uid
        assert (f"{points:g} of {points:g}" in page.read_text("utf-8")) == (who == "ada")
