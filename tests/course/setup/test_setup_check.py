"""The set-up check of lesson 00 reports what is wrong and what to do."""

import pytest
from packaging.requirements import Requirement

from classroom.checks import setup_check


def test_this_machine_meets_the_requirements_and_one_slide_lists_every_package(capsys):
    setup_check.report()
    output = capsys.readouterr().out
    assert "Everything is installed" in output
    for finding in setup_check.findings():
        assert f"✓ {finding.what:12} {finding.found}" in output
    assert len(output.splitlines()) <= 20


@pytest.mark.parametrize("version", ["3.10.14", "3.14.0"])
def test_an_untested_python_version_is_reported_with_the_remedy(version):
    finding = setup_check.python_finding(">=3.11,<3.14", version)
    assert version in finding.found and ">=3.11" in finding.remedy


@pytest.mark.parametrize(
    ("requirement", "found"),
    [("no-such-package>=1", "missing"), ("numpy<1", "but the course needs <1")],
)
def test_an_unsuitable_package_is_reported_with_the_remedy(requirement, found):
    finding = setup_check.package_finding(Requirement(requirement))
    assert found in finding.found and "make lab" in finding.remedy


def test_what_is_wrong_is_counted_at_the_end(monkeypatch, capsys):
    wrong = setup_check.Finding("numpy", "missing", "install it")
    monkeypatch.setattr(setup_check, "findings", lambda: [wrong])
    setup_check.report()
    lines = capsys.readouterr().out.splitlines()
    assert lines[:2] == ["✗ numpy        missing", "    install it"]
    assert lines[-1].startswith("1 problem found")
