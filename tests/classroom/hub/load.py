"""``python -m tests.classroom.hub.load 60``: a class opens, runs and checks an exercise at once.

Needs root and the folder of an installed hub in the variable SLAMLAB_HUB (``make hub HUB=…``)."""

import json
import os
import statistics
import sys
import tempfile
import threading
import time
import uuid
from pathlib import Path

import nbformat
import requests
import websocket

from classroom.exercises import catalogue
from tests.classroom.hub.machine import Machine, running_hub
from tests.course.setup import ROOT

EXERCISE = catalogue.exercise("04").file
TASKS = catalogue.exercise("04").tasks
PATIENCE = 900  # [s]
SOLVED = nbformat.read(ROOT / "solutions" / EXERCISE, 4)
# the processor time of a check, in the kernel and in its children [s]
TIMED = "import os; _cpu = sum(os.times()[:4])\n{}\nprint('cpu', sum(os.times()[:4]) - _cpu)"


class Student(threading.Thread):
    """A student's browser: logs in, opens the exercise, runs each cell, saves.

    ``checks``: list of (duration, processor time) of each check [s]. ``lost``: what went wrong."""

    def __init__(self, hub, name, begin):
        super().__init__()
        self.hub, self.who, self._begin = hub, name, begin
        self.checks, self.lost, self.opened, self.ended = [], [], None, None
        self._path = f"slam-course/exercises/{EXERCISE}"
        self._session = requests.Session()
        # the hub's proxy closes a connection that is idle for 5 s; a browser then asks again
        self._session.headers["Connection"] = "close"

    def run(self):
        try:
            self._begin.wait()
            self._begun = begin = time.monotonic()
            self._log_in()
            kernel = self._kernel()
            self.opened = time.monotonic() - begin
            self._run_cells(kernel)
            self._save()
            self.ended = time.monotonic() - begin
        except Exception as error:
            self.lost.append(f"{self.who}: {error!r}")

    def _log_in(self):
        page = self._session.get(f"{self.hub}/hub/login")
        form = {"username": self.who, "password": f"pw-{self.who}"}
        token = {"_xsrf": self._session.cookies.get("_xsrf", path="/hub/")}
        page = self._session.post(f"{self.hub}/hub/login", form | token, params=token)
        assert page.ok, page.status_code
        self._session.get(f"{self.hub}/hub/spawn")
        self._own = f"{self.hub}/user/{self.who}"

        def is_open():
            page = self._session.get(f"{self._own}/lab/tree/{self._path}")
            time.sleep(5.0)  # the hub's page waits, too
            return page.ok and page.url.startswith(self._own)

        while not is_open():
            assert time.monotonic() < self._begun + PATIENCE, "the server did not start"

    def _asked(self, method, path, content=None):
        token = self._session.cookies.get("_xsrf", path=f"/user/{self.who}/")
        headers = {"X-XSRFToken": token, "Referer": f"{self._own}/lab"}
        answer = self._session.request(
            method, f"{self._own}/api/{path}", json=content, headers=headers, timeout=PATIENCE
        )
        assert answer.ok, f"{path}: {answer.status_code}"
        return answer.json()

    def _kernel(self):
        self._asked("GET", f"contents/{self._path}")
        name = {"path": self._path, "type": "notebook", "name": EXERCISE}
        made = self._asked("POST", "sessions", name | {"kernel": {"name": "python3"}})
        jar = self._session.cookies
        cookies = "; ".join(f"{one.name}={one.value}" for one in jar if self.who in one.path)
        address = f"{self._own}/api/kernels/{made['kernel']['id']}/channels"
        return websocket.create_connection(
            address.replace("http", "ws", 1), cookie=cookies, origin=self.hub, timeout=PATIENCE
        )

    def _run_cells(self, kernel):
        for cell in SOLVED.cells:
            is_check = cell.source.startswith("check(")
            if cell.cell_type != "code" or "validate()" in cell.source:
                continue
            begin = time.monotonic()
            text = execute(kernel, TIMED.format(cell.source) if is_check else cell.source)
            if is_check:
                self.checks.append((time.monotonic() - begin, float(text.split()[-1])))
        kernel.close()

    def _save(self):
        content = {"type": "notebook", "format": "json"}
        content["content"] = json.loads(nbformat.writes(SOLVED))
        self._asked("PUT", f"contents/{self._path}", content)
        kept = self._asked("GET", f"contents/{self._path}")["content"]["cells"]
        sources = ["".join(cell["source"]) for cell in kept]
        if sources != [cell.source for cell in SOLVED.cells]:
            self.lost.append(f"{self.who}: the saved notebook is another one")


def execute(kernel, code):
    """Run code in a kernel, and return what it prints; raise RuntimeError at an error."""
    number = uuid.uuid4().hex
    content = {"code": code, "silent": False, "store_history": True, "user_expressions": {},
               "allow_stdin": False, "stop_on_error": True}  # fmt: skip
    header = {"msg_id": number, "msg_type": "execute_request", "username": "", "session": number,
              "version": "5.3", "date": ""}  # fmt: skip
    kernel.send(json.dumps({"header": header, "parent_header": {}, "metadata": {},
                            "content": content, "channel": "shell", "buffers": []}))  # fmt: skip
    text = ""
    while True:
        answer = json.loads(kernel.recv())
        if answer["parent_header"].get("msg_id") != number:
            continue
        kind, content = answer["header"]["msg_type"], answer["content"]
        if kind == "error":
            raise RuntimeError(f"{content['ename']}: {content['evalue']}")
        if kind == "stream":
            text += content["text"]
        if kind == "status" and content["execution_state"] == "idle":
            return text


def used(uid):
    """The memory of a user's processes [MB], shared pages by parts, and their CPU time [s]."""
    memory = ticks = 0
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if process.stat().st_uid == uid:
                rollup = (process / "smaps_rollup").read_text()
                memory += int(rollup.partition("\nPss:")[2].split()[0])
                numbers = (process / "stat").read_text().rpartition(")")[2].split()
                ticks += sum(map(int, numbers[11:15]))
        except (OSError, IndexError, ValueError):
            continue
    return memory / 1024, ticks / os.sysconf("SC_CLK_TCK")


def main(count):
    names = [f"student{number:03}" for number in range(count)]
    with tempfile.TemporaryDirectory(dir="/var/tmp") as folder:
        os.chmod(folder, 0o755)
        machine = Machine(Path(os.environ["SLAMLAB_HUB"]), Path(folder), names)
        machine.set_up()
        with running_hub(machine) as hub:
            begin = threading.Event()
            students = [Student(hub, name, begin) for name in names]
            for student in students:
                student.start()
            load = os.getloadavg()[0]
            begin.set()
            for student in students:
                student.join()
            usage = [used((machine.home / name).stat().st_uid) for name in names]
            highest = os.getloadavg()[0]
            lost = [line for student in students for line in student.lost]
            for name in names:
                progress = machine.home / name / "slam-course" / "progress.json"
                done = json.loads(progress.read_text())["tasks"] if progress.is_file() else {}
                missing = [task.id for task in TASKS if task.id not in done]
                lost += [f"{name}: no progress of {task}" for task in missing]
    report(students, usage, lost)
    print(f"load of the machine: {load:.0f} before, {highest:.0f} at the end")


def report(students, usage, lost):
    print(*lost, sep="\n")
    durations, cpu = zip(*(check for student in students for check in student.checks), strict=True)
    for name, values, unit in (
        ("opened", [student.opened for student in students if student.opened], "s"),
        ("everything run and saved", [student.ended for student in students if student.ended], "s"),
        ("check", durations, "s"),
        ("processor time of a check", cpu, "s"),
        ("memory of a student", [memory for memory, _ in usage], "MB"),
        ("processor time of a student", [seconds for _, seconds in usage], "s"),
    ):
        edges = statistics.quantiles(values, n=20)
        print(f"{name}: median {statistics.median(values):.2f} {unit}, "
              f"95 % at most {edges[-1]:.2f} {unit}, maximum {max(values):.2f} {unit}")  # fmt: skip
    print(f"{len(students)} students, {len(durations)} checks, {len(lost)} lost")


if __name__ == "__main__":
    main(int(sys.argv[1]))
