"""Pack the students' zip (``make student``): lessons, exercises, package, no solutions."""

import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("notebooks", "exercises", "slamlab", "labextension", "docs")
FILES = ("README.md", "LICENSE", "Makefile", "lab.py", "pyproject.toml", "environment.yml",
         "requirements.lock")  # fmt: skip
EXCLUDED = ("__pycache__", ".ipynb_checkpoints")
TOP = "slam-course"
TIMESTAMP = (1980, 1, 1, 0, 0, 0)  # no time in a zip: the same files give the same bytes


def contents(root=ROOT):
    """List the files that students get.

    Parameters
    ----------
    root : Path, of the project

    Returns
    -------
    list of Path, sorted
    """
    found = [root / name for name in FILES]
    for folder in FOLDERS:
        found += [path for path in (root / folder).rglob("*") if path.is_file()]
    return sorted(path for path in found if not set(EXCLUDED) & set(path.parts))


def pack(target, root=ROOT):
    """Write the zip file.

    Parameters
    ----------
    target : Path, ending in .zip
    root : Path, of the project
    """
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in contents(root):
            name = f"{TOP}/{path.relative_to(root).as_posix()}"
            info = zipfile.ZipInfo(name, TIMESTAMP)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = (path.stat().st_mode & 0o777) << 16
            packed.writestr(info, path.read_bytes())


if __name__ == "__main__":
    to = Path(sys.argv[1] if len(sys.argv) > 1 else f"{TOP}.zip")
    pack(to)
    print(f"{to}: {to.stat().st_size / 2**20:.1f} MB, without solutions")
