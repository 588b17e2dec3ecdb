"""Every ``slamlab`` command of the guides and the lessons is parsed; the guides' quick ones run."""

import re
import shlex
import shutil

import numpy as np
import pytest

from classroom.grading import isolation, sandbox
from slamlab.cli import command_parsers, main, parse
from slamlab.devices.emulator.synthetic_recording import record_synthetic_run
from slamlab.simulation import worlds
from tests.course.setup import ROOT

GUIDES = ["README.md", "slamlab/README.md", "course/handout/README.md", "CONTRIBUTING.md"]
GUIDES += [f"docs/{path.name}" for path in sorted((ROOT / "docs").glob("*.md"))]
LESSONS = ["course/lessons/*.py", "course/appendices/*.py", "course/exercises/*/notebook.py"]
LESSONS = [str(path.relative_to(ROOT)) for each in LESSONS for path in sorted(ROOT.glob(each))]
# not "slamlab run: ...", which is a message
BLOCK = re.compile(r"^(?: {4,}|# )?(?:\.venv/bin/)?slamlab ((?!\w+:).+)$", re.MULTILINE)
INLINE = re.compile(r"`(?:\.venv/bin/)?slamlab\s+([^`]+)`")
PLACEHOLDER = re.compile(r"\b[A-Z]{3,}\d?\b(?!\.)|…")
# commands that are only parsed: how they begin or what they contain, and why
ONLY_PARSED = {
    r"live\b|emulate\b|grade review\b|replay (?!.*--info)": "runs until it is stopped",
    r".*\bdevices:": "needs a device",
    r"film (?!.*--no-open)": "opens a browser",
    r"rehearse\b|handout\b": "needs a browser",
    r"(check|progress|reset|update)\b": "changes the course's folder; tests/classroom/coursework",
    r"contest submissions\b|.*--log\b": "takes minutes, or needs a recording",
    r"run sim:flat-carried\b": "takes half a minute; tests/slamlab/test_handheld_lidar.py",
    r".*\bdrive\.bag\b": "needs a ROS bag; tests/slamlab/formats/test_ros_scans.py",
    r"grade (lti|export)\b|.*--(scheduler|db|shard|head)\b": "needs a server or another gradebook",
    r"completion\b": "needs an extra",
    r"collect\b|.*--homes\b": "uses the homes of a hub; tests/classroom/hub",
    r"data (get|mirror|check)\b": "needs a network; tests/slamlab/recordings/test_data_command.py",
    r"run intel\b": "needs a recording",
}
ROSTER = "id,name,email,section\ns123,Ada L,a@x.org,A\ns124,Alan T,t@x.org,A\n"


def blocks(guide):
    """The commands of a guide on lines of their own, without comments, redirections and pipes."""
    text = (ROOT / guide).read_text("utf-8")
    return [re.sub(r"\s+[#>|] .*", "", found).strip() for found in BLOCK.findall(text)]


def inline(guide):
    """The commands of a guide that stand within a sentence or a table."""
    text = (ROOT / guide).read_text("utf-8")
    return [" ".join(found.split()).replace("\\|", "|") for found in INLINE.findall(text)]


def reason_not_to_run(command):
    """Why a command is only parsed; None: it is run."""
    if PLACEHOLDER.search(command):
        return "has a placeholder"
    found = (why for words, why in ONLY_PARSED.items() if re.match(words, command))
    return next(found, None)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A folder with the files that the guides name: logs, a recording, a film, submissions."""
    folder = tmp_path_factory.mktemp("files")
    for name in ("robot.readings", "robot.log.gz"):
        assert main(["convert", "sim:room", str(folder / name)]) == 0
    for name in ("drive.rec.gz", "flat.rec.gz"):
        rng = np.random.default_rng(1)
        record_synthetic_run(folder / name, worlds.polygon(), rng, [(2, 30, 10)])
    assert main(["run", "sim:room", "--film", str(folder / "drive.film")]) == 0
    notebook = next((ROOT / "solutions").glob("ex04_*.ipynb"))
    for student in ("s123", "s124"):
        (folder / "submissions" / student).mkdir(parents=True)
        shutil.copy(notebook, folder / "submissions" / student)
    shutil.make_archive(folder / "submissions", "zip", folder / "submissions")
    shutil.copy(notebook, folder / "ex04.ipynb.txt")
    (folder / "roster.csv").write_text(ROSTER, "utf-8")
    return folder


@pytest.mark.parametrize("guide", [*GUIDES, *LESSONS])
def test_each_command_of_a_guide_or_a_lesson_is_one_of_slamlab(guide, capsys):
    _, known = command_parsers()
    for command in [*blocks(guide), *inline(guide)]:
        words = shlex.split(command, comments=True)
        if words[0] == "COMMAND" or command in known or words[0].startswith("-"):
            continue  # named within a sentence
        try:
            parse(words)
        except SystemExit as end:
            assert not end.code, f"slamlab {command}: {capsys.readouterr().err}"


@pytest.mark.parametrize("guide", [guide for guide in GUIDES if blocks(guide)])
def test_each_quick_command_of_a_guide_runs(guide, files, tmp_path, monkeypatch, capsys):
    folder = tmp_path / "here"
    shutil.copytree(files, folder)
    monkeypatch.chdir(folder)
    everything = ""
    for command in blocks(guide):
        if reason_not_to_run(command):
            continue
        if command.startswith("grade") and isolation.missing_requirement(sandbox.STRICT):
            pytest.skip("the sandbox is not available")
        if command.startswith("convert"):
            (folder / command.split()[-1]).unlink(missing_ok=True)
        code = main(shlex.split(command))
        output = "".join(capsys.readouterr())
        everything += output
        assert code == 0, f"slamlab {command}: {output[-800:]}"
        if command == "grade init":  # as the guide's step 3, whose row has a placeholder
            assert main(["grade", "submissions.zip", "--exercise", "04"]) == 0
    for warning in re.findall(r'warns that "([^"]+)"', (ROOT / guide).read_text("utf-8")):
        assert warning in " ".join(everything.split())


def test_what_is_only_parsed_has_a_reason_and_the_rest_is_run():
    commands = [command for guide in GUIDES for command in blocks(guide)]
    assert len(commands) > 50
    assert sum(reason_not_to_run(command) is None for command in commands) > 20
    for words in ONLY_PARSED:
        everything = commands + [command for guide in GUIDES for command in inline(guide)]
        assert any(re.match(words, command) for command in everything), words
    for test in re.findall(r"tests/[\w/.]+", " ".join(ONLY_PARSED.values())):
        assert (ROOT / test).exists(), test
