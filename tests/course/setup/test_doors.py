"""All that one can start is on a list: the test that runs it, a small run here, or why neither."""

import re
import runpy
import subprocess
import sys
from functools import cache

import pytest

from slamlab.cli import command_parsers
from tests.course.setup import ROOT

MAKEFILE = (ROOT / "Makefile").read_text("utf-8")
PACKAGES = ("slamlab", "classroom", "course", "benchmarks")
# run by a test, which names the door: whole, or small by an option or by sizes
TRIED = {
    "classroom/audience/test_server.py": "python -m classroom: .audience",
    "classroom/grading/test_mistakes.py": "python -m course: .fingerprints",
    "classroom/hub/test_server_guide.py": "make: hub",
    "course/benchmarks/test_corrected_logs.py": "python -m benchmarks: .corrected_logs",
    "course/benchmarks/test_films_benchmark.py": "python -m benchmarks: .films",
    "course/benchmarks/test_project_benchmark.py": "python -m benchmarks: .project",
    "course/benchmarks/test_quick.py": "python -m benchmarks: .accuracy, .bor, .devices, "
    ".false_loops, .growth, .handheld_lidar, .icp, .lines, .mak, .montecarlo, .pose_graphs",
    "course/benchmarks/test_raycast_benchmark.py": "python -m benchmarks: .raycast",
    "course/benchmarks/test_summary.py": "python -m benchmarks: .summary",
    "course/browser/test_live.py": "python -m benchmarks: .live",
    "course/browser/test_site.py": "python -m course: .site",
    "course/notebooks/test_glossary.py": "python -m course: .glossary",
    "course/setup/test_lab_opens.py": "python: lab.py",
    "course/site/test_pages.py": "python -m course: .site.rendering",
    "course/test_architecture.py": "python -m course: .architecture",
    "course/test_filter_comparison.py": "python -m course.studies: .arena_logs",
    "course/test_intel_maps.py": "python -m course.studies: .intel_maps",
    "course/test_rplidar_a2_noise.py": "python -m course.studies: .rplidar_a2_noise",
    "course/test_study_commands.py": "python -m course.studies: .box_containment, .consistency, "
    ".filter_comparison, .filter_consistency, .foot_point_ablation, .particle_filters, "
    ".ultrasound_walls, .wall_slam_faults, .wall_slam_variants",
    "course/test_task_command.py": "python -m course.task: new, try",
    "course/test_victoria_park.py": "python -m course.studies: .victoria_park",
    "slamlab/devices/test_port_watchdog.py": "python -m slamlab: .devices.port_watchdog",
}
# run here: arguments, and what is printed
SMALL = {
    "python -m slamlab": (["run", "sim:polygon"], "4 scans mapped"),
    "python -m classroom.lecturing.headless": ([], "found Chromium, version"),
    "python -m course.build": (["--check", "glossary"], ""),
    "python -m course.known_figure_faults": (["FILE"], ""),
    "python -m course.lesson_statistics": (["04"], r"(?m)^\| 04 \| .*\|$"),
    "python -m course.pack": (["--folder", "FOLDER"], ""),
    "python -m course.task lacks": (["01"], r"^\s*$"),
    "python docs/make_pictures.py": (["library", "--out", "FOLDER"], r"library\.png: \d+ kB"),
}
# not run by tests, and why: a part of each is
LONG = {
    "an hour; tests/course/benchmarks run each small": "python -m benchmarks",
    "an hour: python -m benchmarks": "make: bench",
    "an hour; tests/course/notebooks compare the files with their sources": "make: notebooks",
    "an hour; tests/classroom/grading/test_mistakes.py": "python -m course: .mutation_testing",
    "an hour of an idle machine": "make: soak",
    "minutes; tests/classroom/grading/test_nbgrader.py": "python -m benchmarks: .grading",
    "minutes; tests/course/browser/test_site.py, films of one lesson": "make: site, student",
    "minutes; tests/course/setup/test_pack.py without the pages": "make: lecturer",
    "needs a hub; tests/classroom/hub": "python -m classroom: .hub.student_server",
    "needs a network; tests/course/setup/test_environment.py compares": "make: lock",
    "needs a network; tests/course/setup/test_lab.py": "make: clients, env, hub-env, lab",
    "this test is a part of it, or it of make test": "make: lint, test, test-all",
    "changes or removes files that the tests use": "make: clean, format",
}


def doors_of(listed):
    """The doors of each line of TRIED or LONG."""
    for words in listed.values():
        start, _, names = words.partition(": ")
        for name in names.split(", "):
            yield f"{start}{'' if name.startswith('.') else ' '}{name}".strip()


LISTED = [*doors_of(TRIED), *SMALL, *doors_of(LONG)]
# a module in small letters, not NAME or {name}; and its arguments
MODULE = re.compile(
    rf"\bpython -m ((?:{'|'.join(PACKAGES)})(?:\.[a-z_]\w*)*)(?!\w|\.[\w{{])( [^`\"\n]*)?"
)
TARGET = re.compile(r"(?:^ *|`)make (?!-)([\w-]+)(?= |`|$)([^`\n]*)", re.MULTILINE)
SCRIPT = re.compile(r"\bpython3? (\w+/\w+\.py)\b")
PARSES = re.compile(r"ArgumentParser\(|= parser\(|study_command\.main\(|main\(.*python -m")


@cache
def modules():
    """The source of each module, or script, that runs as a program, by the words that start it."""
    found = {}
    for path in [*ROOT.glob("*.py"), *ROOT.glob("docs/*.py"), *of_packages("*.py")]:
        text = path.read_text("utf-8")
        if 'if __name__ == "__main__":' in text:
            parts = path.relative_to(ROOT).with_suffix("").parts
            name = ".".join(parts).removesuffix(".__main__")
            packaged = parts[0] in PACKAGES
            found[f"python -m {name}" if packaged else f"python {path.relative_to(ROOT)}"] = text
    return found


def of_packages(pattern):
    return [path for name in PACKAGES for path in sorted((ROOT / name).rglob(pattern))]


def offered():
    """All doors but slamlab's commands: Make's targets, Python's modules and scripts."""
    doors = {f"make {name}" for name in re.findall(r"^([\w-]+):(?!=)", MAKEFILE, re.MULTILINE)}
    for door, text in modules().items():
        commands = re.findall(r'commands\.add_parser\("(\w+)"', text)
        doors |= {f"{door} {command}" for command in commands} or {door}
    return doors


def texts():
    """What names doors: guides, lessons, exercises, help texts, and files that start them."""
    guides = [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), ROOT / "Dockerfile", ROOT / "Makefile"]
    return {
        path.relative_to(ROOT).as_posix(): path.read_text("utf-8")
        for path in [*guides, *of_packages("*.md"), *of_packages("*.py")]
    }


def test_every_door_is_on_one_list_and_no_list_names_another():
    assert len(set(LISTED)) == len(LISTED)
    assert set(LISTED) == offered()


@pytest.mark.parametrize("test", TRIED)
def test_a_test_names_the_doors_that_it_opens(test):
    text = (ROOT / "tests" / test).read_text("utf-8")
    for door in doors_of({test: TRIED[test]}):
        assert re.search(rf"\b{re.split('[ .]', door.removesuffix('.py'))[-1]}\b", text), door


@pytest.mark.parametrize("command", command_parsers()[1])
def test_a_test_calls_each_command_of_slamlab(command):
    words = ", ".join(f'"{word}"' for word in command.split())
    called = re.compile(rf"[(\[]{words}[,\])]")
    assert any(called.search(path.read_text("utf-8")) for path in (ROOT / "tests").rglob("*.py"))


def test_where_a_door_is_not_run_whole_the_tests_named_exist():
    for named in re.findall(r"tests/[\w/.]+", " ".join(LONG)):
        assert (ROOT / named).exists(), named


def test_what_texts_start_is_a_door():
    doors = {door for door in offered() if door.startswith("make ")} | set(modules())
    variables = set(re.findall(r"\b[A-Z]{2,}(?:_[A-Z]+)*\b", MAKEFILE))
    for place, text in texts().items():
        targets = TARGET.findall(text)
        named = {f"python -m {name}" for name, _ in MODULE.findall(text)}
        named |= {f"make {name}" for name, _ in targets}
        named |= {f"python {name}" for name in SCRIPT.findall(text)}
        assert named <= doors, place
        assert set(re.findall(r"\b([A-Z_]+)=", " ".join(rest for _, rest in targets))) <= variables


@cache
def options_in_texts():
    """The options that texts give to each module, also through a variable of Make."""
    found, passed = {}, re.findall(r"\$\(RUN\) ([\w.]+) \$\((\w+)\)", MAKEFILE)
    for text in texts().values():
        through = [
            (name, rest) for _, rest in TARGET.findall(text) for name, v in passed if v in rest
        ]
        for name, rest in MODULE.findall(text) + through:
            found.setdefault(f"python -m {name}", set()).update(re.findall(r"--[\w-]+", rest))
    return found


@pytest.mark.filterwarnings("ignore:.*found in sys.modules:RuntimeWarning")
@pytest.mark.parametrize("door", [door for door, text in modules().items() if PARSES.search(text)])
def test_a_programs_help_names_itself_and_the_options_that_texts_give(door, monkeypatch, capsys):
    _, *module, name = door.split()
    monkeypatch.setattr(sys, "argv", [name, "--help"])
    with pytest.raises(SystemExit) as end:
        if module:
            runpy.run_module(name, run_name="__main__", alter_sys=False)
        else:
            runpy.run_path(str(ROOT / name), run_name="__main__")
    shown = capsys.readouterr().out
    assert end.value.code == 0
    assert name.rpartition("/")[2] in shown
    assert options_in_texts().get(door, set()) <= set(re.findall(r"--[\w-]+", shown))


@pytest.mark.slow
@pytest.mark.parametrize("door", SMALL)
def test_a_small_run_ends_well_and_prints_what_it_promises(door, tmp_path):
    given, printed = SMALL[door]
    words = [{"FILE": f"{tmp_path}/file", "FOLDER": str(tmp_path)}.get(w, w) for w in given]
    command = [sys.executable, *door.split()[1:], *words]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode and "Chromium" in done.stderr:
        pytest.skip(done.stderr)
    assert done.returncode == 0, done.stderr
    assert re.search(printed, done.stdout), done.stdout
    assert "FOLDER" not in given or list(tmp_path.rglob("*.*"))
