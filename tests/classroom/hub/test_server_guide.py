"""docs/server.md on a machine of its own: a real hub, a lecture, and an exercise there and back.

The machine is this one with other accounts and homes (bubblewrap). ``make hub`` installs the course
for it, which takes minutes; the variable SLAMLAB_HUB names an installation to use instead."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat
import pytest

from classroom.exercises import catalogue
from classroom.lecturing import headless
from tests.classroom.hub.machine import NOT_RUN, Machine, block, running_hub
from tests.course.browser.jupyter import Visit
from tests.course.browser.lecture import Lecture
from tests.course.setup import ROOT

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


@pytest.fixture(scope="module")
def machine(installation, tmp_path_factory):
    made = Machine(installation, tmp_path_factory.mktemp("machine"), STUDENTS)
    made.set_up()
    return made


@pytest.fixture(scope="module")
def hub(machine):
    """The address of a running hub."""
    with running_hub(machine) as address:
        yield address


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
    code = "from ipykernel.kernelapp import IPKernelApp; print(IPKernelApp.instance().transport)"
    assert alan.page.evaluate(ASK, code).strip() == "ipc"  # no port that others can reach
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
