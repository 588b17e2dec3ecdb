"""Help, examples, errors, exit codes and completion of every command."""

import argparse
import itertools
import json
import re
import shlex
import subprocess
import sys

import pytest

from slamlab import estimators
from slamlab.cli import command_parsers, listings, main, parse
from slamlab.estimators.options import OPTIONS, TAKES
from slamlab.sources.simulated_robot import NAMES
from tests.timeouts import PATIENCE

PARSER, COMMANDS = command_parsers()
MAX_LINES, MAX_COLUMNS = 24, 80  # of a help without the rows of its tables


@pytest.fixture(autouse=True)
def _narrow(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")


def examples(text):
    """The commands below "Examples:" of a help text."""
    return [line.strip() for line in text.rpartition("Examples:\n")[2].splitlines()]


def arguments_of(example):
    """The arguments that an example passes to slamlab, without what its shell takes."""
    words = itertools.takewhile(lambda word: word not in ("|", ">"), shlex.split(example))
    assert next(words) == "slamlab"
    return list(words)


def printed(capsys, *words):
    """What a command that ends by itself prints: exit code, stdout, stderr."""
    try:
        code = main(list(words))
    except SystemExit as ended:
        code = ended.code
    return code, *capsys.readouterr()


@pytest.mark.parametrize("name", COMMANDS)
def test_a_help_is_one_screen_with_a_sentence_and_two_examples(name, capsys):
    code, text, _ = printed(capsys, *name.split(), "--help")
    assert code == 0
    lines = text.splitlines()
    assert max(map(len, lines)) <= MAX_COLUMNS
    usage, empty, sentence = lines[:3]
    assert usage.startswith(f"usage: slamlab {name} [OPTIONS]") and empty == ""
    assert re.fullmatch(r"[A-Z][^.:;]*(?:\.\w[^.:;]*)*\.", sentence) and lines[3] == ""
    headings = [k for k, line in enumerate(lines) if line.endswith(":") and line[0] != " "]
    tables = [k for k in headings if lines[k] != "Examples:"]
    rows = sum(lines.index("", k) - k - 1 for k in tables)
    assert len(lines) - rows <= MAX_LINES
    found = examples(text)
    assert len(found) == 2 and all(line.startswith(f"slamlab {name}") for line in found)


@pytest.mark.parametrize("name", ["", *COMMANDS])
def test_every_example_of_a_help_is_accepted(name):
    text = (COMMANDS[name] if name else PARSER).epilog
    for example in examples(text.partition("\n\nExit codes")[0]):
        words = arguments_of(example)
        if "--list-estimators" not in words:
            assert f"{parse(words).command} ".startswith(f"{name} " if name else "")


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_of_an_option_is_a_phrase_that_states_its_default(name):
    for action in COMMANDS[name]._actions:
        if isinstance(action, argparse._HelpAction) or action.help == argparse.SUPPRESS:
            continue
        assert action.help and action.help[0].isupper(), action
        assert not action.help.endswith("."), action
        if action.default not in (None, False, argparse.SUPPRESS, []) and action.option_strings:
            assert "(default: " in action.help, action


def test_the_help_of_slamlab_lists_every_command_and_the_exit_codes(capsys):
    _, text, _ = printed(capsys, "--help")
    for name, parser in COMMANDS.items():
        if " " not in name:
            assert re.search(rf"^  {name} +{re.escape(parser.description)}$", text, re.M)
    assert max(map(len, text.splitlines())) <= MAX_COLUMNS
    assert all(f"{code} " in text.partition("Exit codes:")[2] for code in (0, 1, 2, 130))
    assert len(examples(text.partition("\n\nExit codes")[0])) == 2


def test_the_help_of_grade_lists_its_commands(capsys):
    pytest.importorskip("classroom")
    _, text, _ = printed(capsys, "grade", "--help")
    for name in COMMANDS:
        if name.startswith("grade "):
            assert re.search(rf"^  {name.removeprefix('grade ')} ", text, re.M)


def test_estimators_are_listed_with_their_parameters(capsys):
    assert set(listings.ESTIMATORS) == set(estimators.NAMES)
    code, text, _ = printed(capsys, "run", "--list-estimators")
    assert code == 0 and max(map(len, text.splitlines())) <= 100
    for name in estimators.NAMES:
        shown = re.search(rf"^  {name} .*\n(?:    .*\n)*", text + "\n", re.M)[0]
        for parameter in TAKES.get(name, ()):
            assert f"    {parameter}: " in shown
            assert f"{OPTIONS[parameter].range} (default: {OPTIONS[parameter].default})" in shown


def test_sources_are_listed_with_their_worlds(capsys):
    code, text, _ = printed(capsys, "live", "--list-sources")
    assert code == 0 and all(name in text for name in NAMES)


@pytest.mark.parametrize(
    ("words", "code", "expected"),
    [
        ("run sim:polygon", 0, ""),
        ("run sim:rom", 2, "no simulated run 'rom'. Did you mean 'room'? 'slamlab run --list-s"),
        ("run emulated:rom", 2, "no world 'rom'. Did you mean 'room'?"),
        ("emulate --world rom", 2, "Did you mean 'room'? 'slamlab run --list-sources' lists all."),
        ("run itel", 2, "no file or recording 'itel'. Did you mean 'intel'?"),
        ("live sim:rom --no-open", 2, "Did you mean 'room'?"),
        ("run sim:room --estimator grap", 2, "Did you mean 'graph'? 'slamlab run --list-est"),
        ("run sim:landmarks --estimator bor -p bound=tuned", 2, "(it takes bounds, association)"),
        ("run sim:landmarks --estimator icp -p bounds=tuned", 2, "it takes none"),
        ("run sim:landmarks --estimator bor -p bounds", 2, "--param needs NAME=VALUE"),
        ("run sim:polygon --estmator icp", 2, "Did you mean '--estimator'?"),
        ("rum sim:polygon", 2, "no command 'rum'. Did you mean 'run'?"),
        ("run --help", 0, ""),
        ("run", 2, "SOURCE"),
    ],
)
def test_exit_codes_and_suggestions(words, code, expected, capsys):
    got, _, err = printed(capsys, *words.split())
    assert got == code and expected in err
    assert err.count("\n") == (code != 0)


def test_a_misspelled_command_of_grade_suggests_the_right_one(capsys):
    pytest.importorskip("classroom")
    got, _, err = printed(capsys, "grade", "relase", "04")
    assert got == 2 and "Did you mean 'grade release'?" in err


def test_json_is_the_summary_and_nothing_else(capsys, tmp_path):
    words = ["run", "sim:polygon", "--json", "--out", str(tmp_path)]
    code, out, err = printed(capsys, *words)
    assert code == 0 and "written to" in err
    assert json.loads(out) == json.loads((tmp_path / "summary.json").read_text("utf-8"))
    assert printed(capsys, *words, "--quiet")[2] == ""


def test_quiet_prints_nothing_and_verbose_more(capsys):
    words = ["run", "sim:landmarks", "--estimator", "mak", "-p", "smoothing=0.5"]
    plain = printed(capsys, *words)[1].splitlines()
    assert printed(capsys, *words, "-q") == (0, "", "")
    more = printed(capsys, *words, "-v")[1].splitlines()
    assert len(more) > len(plain) and "parameter smoothing: 0.5" in more
    assert any(line.startswith("time per reading: ") for line in more)


def test_a_reader_that_ends_early_is_no_error():
    code = "import sys; from slamlab.cli import main; sys.exit(main(['run', '--list-sources']))"
    ran = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    ran.stdout.close()
    output = ran.stderr.read()
    assert (ran.wait(PATIENCE), output) == (0, "")


COMPLETING = """
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_shtab_slamlab
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.fixture(scope="module")
def script(tmp_path_factory):
    pytest.importorskip("shtab")
    path = tmp_path_factory.mktemp("completion") / "slamlab.bash"
    words = [sys.executable, "-m", "slamlab", "completion", "bash"]
    with path.open("w") as file:
        subprocess.run(words, stdout=file, check=True, timeout=PATIENCE)
    return path


@pytest.mark.skipif(sys.platform == "win32", reason="there is no bash")
@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["r"], {"run", "record", "replay"}),
        (["run", "--est"], {"--estimator"}),
        (["run", "sim:room", "--estimator", "gr"], {"graph"}),
        (["run", "sim:room", "--param", "bou"], {"bounds=conservative", "bounds=tuned"}),
        (["emulate", "--wa"], {"--watchdog"}),
        (["completion", ""], {"bash", "zsh", "fish"}),
        (["data", "g"], {"get"}),
        (["grade", "re"], {"release", "rejudge", "review"}),
        (["grade", "verify", "--he"], {"--head", "--help"}),
        (["grade", "--sched"], {"--scheduler"}),
    ],
)
def test_bash_completes_commands_options_and_names(script, words, expected):
    if words[0] in ("grade", "r"):
        pytest.importorskip("classroom")
    ran = subprocess.run(
        ["bash", "-c", COMPLETING, "bash", str(script), "slamlab", *words],
        capture_output=True, text=True, timeout=PATIENCE,
    )  # fmt: skip
    found = set(ran.stdout.split())
    assert found - {"reset", "rehearse"} == expected, ran.stderr


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_get_a_script(shell, capsys):
    pytest.importorskip("shtab")
    code, text, _ = printed(capsys, "completion", shell)
    assert code == 0 and "slamlab" in text
    assert "--estimator" in text.replace("-l estimator", "--estimator")
