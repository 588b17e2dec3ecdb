"""What README and CONTRIBUTING promise is there."""

import re

import pytest

from tests.setup import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
MAP = re.findall(r"\]\(notebooks/(\w+)\.ipynb\) \| (\d+) \|", README)


@pytest.mark.parametrize("text", [README, CONTRIBUTING], ids=["README", "CONTRIBUTING"])
def test_links_lead_somewhere(text):
    links = [link for link in re.findall(r"\]\(([^)]+)\)", text) if "://" not in link]
    assert not [link for link in links if not (ROOT / link).exists()]


@pytest.mark.parametrize("text", [README, CONTRIBUTING], ids=["README", "CONTRIBUTING"])
def test_the_make_targets_that_are_named_exist(text):
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^(\w+):", makefile, re.M))
    named = set(re.findall(r"`make (\w+)", text))
    assert named and named <= targets


def test_the_map_lists_every_lesson():
    assert sorted(name for name, _ in MAP) == sorted(
        path.stem for path in (ROOT / "course" / "lessons").glob("*.py")
    )


@pytest.mark.parametrize(("name", "minutes"), MAP)
def test_the_map_gives_the_minutes_that_the_lesson_gives(name, minutes):
    source = (ROOT / "course" / "lessons" / f"{name}.py").read_text(encoding="utf-8")
    assert re.search(r"(\d+) min", source)[1] == minutes
