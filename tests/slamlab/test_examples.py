"""The Python examples of the guides run as they stand on the page, and write the stated output."""

import re
import warnings
from pathlib import Path

import pytest

from slamlab.cli import main

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("docs/library.md", "slamlab/README.md")
LIBRARY = (ROOT / "docs" / "library.md").read_text(encoding="utf-8")
EXAMPLE = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
EXAMPLES = [
    pytest.param(code, id=f"{page}-{number}")
    for page in PAGES
    for number, code in enumerate(EXAMPLE.findall((ROOT / page).read_text("utf-8")), 1)
]
PNG = b"\x89PNG"


@pytest.fixture(scope="session")
def log(tmp_path_factory):
    """The log that the examples read, made as docs/library.md describes."""
    words = re.search(r"slamlab (convert \S+) (robot\.readings)\n", LIBRARY)
    path = tmp_path_factory.mktemp("log") / words[2]
    assert main([*words[1].split(), str(path)]) == 0
    return path


@pytest.mark.parametrize("code", EXAMPLES)
def test_an_example_runs_as_it_stands_and_writes_what_it_names(
    code, log, tmp_path, monkeypatch, capsys
):
    (tmp_path / log.name).write_bytes(log.read_bytes())
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        exec(code, {"__name__": "__main__"})
    output, errors = capsys.readouterr()
    assert errors == ""
    for name in re.findall(r'(?:save_tum\(.*|savefig\()"(.+?)"\)', code):
        written = (tmp_path / name).read_bytes()
        assert written.startswith(PNG) if name.endswith(".png") else len(written.split()) > 8
    for line in output.splitlines() if "absolute_error" in code else ():
        assert f"`{line}`" in LIBRARY, "the output that the page states"


def test_the_examples_of_the_library_s_page_are_short():
    lengths = [
        len([line for line in code.splitlines() if line]) for code in EXAMPLE.findall(LIBRARY)
    ]
    assert len(lengths) >= 3 and max(lengths) <= 16


def test_the_page_has_a_line_for_every_extra():
    project = (ROOT / "slamlab" / "pyproject.toml").read_text(encoding="utf-8")
    extras = re.search(r"optional-dependencies\]\n(.*?)\n\n", project, re.DOTALL)[1]
    rows = " ".join(re.findall(r"^\| (`.*?) \|", LIBRARY, re.MULTILINE))
    assert {*re.findall(r"^(\w+) =", extras, re.MULTILINE)} <= set(re.findall(r"`(\w+)`", rows))


def test_the_guides_show_every_command_of_the_library():
    from slamlab.cli.groups import OWN

    guides = "".join(path.read_text("utf-8") for path in sorted((ROOT / "docs").glob("*.md")))
    commands = {module.rpartition(".")[2] for group in OWN for module in group.modules}
    assert commands <= set(re.findall(r"slamlab (\w+) ", guides))
