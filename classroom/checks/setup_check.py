"""Setup check: versions of Python and of the required packages, with remedies for problems."""

import importlib.metadata
import sys
from dataclasses import dataclass

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

INSTALL = "run `make lab` in the project folder (Windows: `python lab.py`) to start JupyterLab"
COLUMNS, WIDTH = 2, 25  # of the packages without a problem [characters]


@dataclass(frozen=True)
class Finding:
    """The result of checking one requirement."""

    what: str  # such as "numpy"
    found: str  # such as "2.4.6", or the problem
    remedy: str | None = None  # what to do; None if there is no problem


def findings(package="slam-course"):
    """Check Python and every package that ``package`` requires."""
    metadata = importlib.metadata.metadata(package)
    return [
        python_finding(metadata["Requires-Python"], ".".join(map(str, sys.version_info[:3]))),
        *(
            package_finding(Requirement(text))
            for text in importlib.metadata.requires(package) or []
            if "extra ==" not in text
        ),
    ]


def python_finding(wanted, version):
    """Check a Python version such as "3.12.1" against a specifier such as ">=3.11,<3.14"."""
    if version in SpecifierSet(wanted):
        return Finding("Python", version)
    remedy = f"install Python {wanted}, delete the folder .venv, then {INSTALL}"
    return Finding("Python", f"{version}, but the course needs {wanted}", remedy)


def package_finding(requirement):
    name = requirement.name
    try:
        version = importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return Finding(name, "missing", INSTALL)
    if version in requirement.specifier:
        return Finding(name, version)
    return Finding(name, f"{version}, but the course needs {requirement.specifier}", INSTALL)


def report():
    """Print the setup check with a remedy for each problem; a problem raises no exception."""
    found = findings()
    right = [f"✓ {finding.what:12} {finding.found}" for finding in found if not finding.remedy]
    wrong = [finding for finding in found if finding.remedy]
    for i in range(0, len(right), COLUMNS):  # in columns: a slide has about twenty lines
        print("".join(f"{text:{WIDTH}} " for text in right[i : i + COLUMNS]).rstrip())
    for finding in wrong:
        print(f"✗ {finding.what:12} {finding.found}\n    {finding.remedy}")
    problems = "1 problem" if len(wrong) == 1 else f"{len(wrong)} problems"
    print(f"\n{problems} found: see above." if wrong else "\nEverything is installed.")
