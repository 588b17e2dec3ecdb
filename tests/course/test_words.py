"""Names, help, messages, guides and docstrings use the field's terms (``docs/terms.md``)."""

import ast
import re
import subprocess
from pathlib import Path

import pytest

from course.source import ROOT

# a retired word, which its plural is, too: the terms that take its place
RETIRED = {
    "abroad": "foreign, outside",
    "anew": "again",
    "doubt": "uncertainty, variance",
    "feet": "foot points",
    "ghost": "outlier, false measurement",
    "heard": "received, inferred",
    "hearsay": "correlated information",
    "honest": "consistent, conservative, guaranteed",
    "honestly": "consistently",
    "kinship": "correlation",
    "liar": "outlier, false loop",
    "likeness": "similarity",
    "mend": "correct, fix",
    "mended": "corrected, fixed",
    "said": "stated, reported",
    "sight": "observation, view",
    "sighted": "observed",
    "sighting": "observation, measurement",
    "spoiled": "corrupted",
    "spoilt": "corrupted",
    "stranger": "random particle, unknown person",
    "surer": "more certain",
    "tells": "states, reports, shows",
    "tickets": "systematic resampling",
    "told": "given, measured, reported",
    "unsure": "uncertain",
}
# words that are retired in names only: in a sentence they may have their everyday meaning
RETIRED_NAMES = {
    "bell": "Gaussian",
    "comb": "systematic resampling",
    "crowd": "clients",
    "desk": "control panel",
    "drives": "runs, trajectories, function calls",
    "hill": "mode",
    "home": "converged",
    "pushes": "control inputs",
    "rounds": "iterations",
    "says": "states, reports",
    "slopes": "derivatives, gradients",
    "valley": "local minimum",
}
ALLOWED = {  # a name that holds a retired word: the reason
    "_home_exceeds_quota": "the home folder of a sandboxed worker",
    "comb": "the number of combinations, in the library's module math",
    "home": "the home folder of a sandboxed worker; the dock where a lap ends",
    "says": "a law's statement; gradebooks store it under this key",
}
# the tasks' inputs, laws and mistakes, of which no name is shown, and the lists above
NOT_SHOWN = re.compile(r"course/exercises/.*/(?!notebook\.py)|tests/course/test_words\.py")
GUIDES = ("README.md", "CONTRIBUTING.md", "docs/*.md")


def tracked(*patterns):
    """Paths of the project's files that match, without those whose names nobody is shown."""
    done = subprocess.run(
        ["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if done.returncode:
        pytest.skip("no git here")
    found = [ROOT / name for name in done.stdout.splitlines() if not NOT_SHOWN.match(name)]
    return [path for path in found if path.exists()]


def names_of(path, tree):
    """Every name that a module defines or uses, and the parts of its own path."""
    names = set(path.relative_to(ROOT).with_suffix("").parts)
    for node in ast.walk(tree):
        for field in ("name", "id", "arg", "attr"):
            value = getattr(node, field, None)
            if isinstance(value, str):
                names.update(value.split("."))
    return names


def words_of(name):
    """Words of an identifier: ``nearest_timestamps``, ``GraphSLAM``."""
    return [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)]


def sentences_of(tree):
    """Docstrings, help and messages: string constants of three words and more."""
    for node in ast.walk(tree):
        text = getattr(node, "value", None) if isinstance(node, ast.Constant) else None
        if isinstance(text, str) and len(text.split()) >= 3:
            yield node.lineno, text


def replaced(words, retired):
    """Those of some words that are retired, each with its replacement."""
    better = {word: retired.get(word) or retired.get(word.removesuffix("s")) for word in words}
    return [f"{word} ({terms})" for word, terms in better.items() if terms]


def retired_in(text):
    """Retired words in a text; names in code font are not read, and a line of sight is a term."""
    plain = re.sub(r"`[^`]*`|line of\s+sight", " ", text)
    found = {word.lower() for word in re.findall(r"(?<![\w-])[A-Za-z]+(?![\w-])", plain)}
    return replaced(sorted(found), RETIRED)


def test_no_name_holds_a_retired_word():
    wrong, used = [], set()
    for path in tracked("*.py"):
        for name in names_of(path, ast.parse(path.read_text(encoding="utf-8"))):
            found = replaced(words_of(name), RETIRED | RETIRED_NAMES)
            if found and name in ALLOWED:
                used.add(name)
            elif found:
                wrong.append(f"{path.relative_to(ROOT)}: {name}: {found[0]}")
    assert not wrong, "\n".join(sorted(wrong))
    assert used == ALLOWED.keys(), "an allowed name that nothing bears"


@pytest.mark.parametrize("package", ["slamlab", "classroom", "course", "benchmarks", "lab.py"])
def test_no_docstring_help_or_message_holds_a_retired_word(package):
    wrong = []
    for path in tracked(package if package.endswith(".py") else f"{package}/*.py"):
        for line, text in sentences_of(ast.parse(path.read_text(encoding="utf-8"))):
            wrong += [f"{path.relative_to(ROOT)}:{line}: {word}" for word in retired_in(text)]
    assert not wrong, "\n".join(wrong)


def test_no_guide_holds_a_retired_word():
    for path in tracked(*GUIDES):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            assert retired_in(line) == [], f"{path.relative_to(ROOT)}:{number}"


def test_a_retired_word_would_be_found():
    tree = ast.parse('def told(x):\n    """A cloud of sights, told anew."""\n')
    assert "told" in names_of(Path(ROOT / "x.py"), tree)
    (_, text), *_ = sentences_of(tree)
    assert [word.split()[0] for word in retired_in(text)] == ["anew", "sights", "told"]
