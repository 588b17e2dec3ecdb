"""Setup check: the versions of Python and of all required packages, and how to fix them."""

import importlib.metadata
import sys
from dataclasses import dataclass

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

INSTALL = "run `make lab` in the project's folder (Windows: `python lab.py`) and use its JupyterLab"
COLUMNS, WIDTH = 2, 25  # of what is right [letters]


@dataclass(frozen=True)
class Finding:
    """A finding of the setup check on one requirement.

    Parameters
    ----------
    what : str, such as "numpy"
    found : str, such as "2.4.6", or why it is not right
    remedy : str or None, what to do; None where all is well
    """

    what: str
    found: str
    remedy: str | None = None


def findings(package="slamlab"):
    """Check the versions of Python and of every required package.

    Parameters
    ----------
    package : str, whose requirements count

    Returns
    -------
    list of Finding
    """
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
    """Check the version of Python against those the course supports.

    Parameters
    ----------
    wanted : str, such as ">=3.11,<3.14"
    version : str, such as "3.12.1"

    Returns
    -------
    Finding
    """
    if version in SpecifierSet(wanted):
        return Finding("Python", version)
    remedy = f"install a Python {wanted}, delete the folder .venv, then {INSTALL}"
    return Finding("Python", f"{version}, but the course needs {wanted}", remedy)


def package_finding(requirement):
    """Check that a required package is installed in a suitable version.

    Parameters
    ----------
    requirement : packaging.requirements.Requirement

    Returns
    -------
    Finding
    """
    name = requirement.name
    try:
        version = importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return Finding(name, "missing", INSTALL)
    if version in requirement.specifier:
        return Finding(name, version)
    return Finding(name, f"{version}, but the course needs {requirement.specifier}", INSTALL)


def report():
    """Print the setup check, each problem with its remedy; never raises for one."""
    found = findings()
    right = [f"✓ {finding.what:12} {finding.found}" for finding in found if not finding.remedy]
    wrong = [finding for finding in found if finding.remedy]
    for i in range(0, len(right), COLUMNS):  # side by side: a slide has room for some twenty lines
        print("".join(f"{text:{WIDTH}} " for text in right[i : i + COLUMNS]).rstrip())
    for finding in wrong:
        print(f"✗ {finding.what:12} {finding.found}\n    {finding.remedy}")
    print(f"\n{len(wrong)} to mend: see above" if wrong else "\nAll is well. Go on.")
