"""Pack the course: for students (``make student``), without solutions, or for lecturers."""

import argparse
import io
import json
import re
import sys
import zipfile
from pathlib import Path

from slamlab.coursework import originals
from slamlab.coursework.file_writing import json_bytes

ROOT = Path(__file__).resolve().parents[1]
HANDOUT = Path(__file__).parent / "handout"  # files that students get in place of the project's
FOLDERS = ("notebooks", "exercises", "slamlab", "labextension")
FILES = ("LICENSE", "lab.py", "pyproject.toml", "environment.yml", "requirements.lock",
         "docs/live.md", "docs/robots.md")  # fmt: skip
LECTURERS_FOLDERS = (*FOLDERS, "solutions", "docs", "course")
LECTURERS_FILES = (*FILES[:-1], "README.md", "Makefile", "CONTRIBUTING.md",
                   "requirements-test.lock")  # fmt: skip
LARGEST = 25e6  # [bytes] of what students get
EXCLUDED = ("__pycache__", ".ipynb_checkpoints")
INK = ".ink"  # in the name of what was drawn in a lecture: the lecturer's own
TOP = "slam-course"
TIMESTAMP = (1980, 1, 1, 0, 0, 0)  # of every file in a zip, the earliest it can hold
LECTURER = {"notes", "lecturer"}  # slide type or tag of cells that students do not get
_PICTURE = re.compile(r"!\[[^]]*\]\(([^)]+)\)")


def contents(root=ROOT, pages=None):
    """List what students get.

    Parameters
    ----------
    root : Path, of the project
    pages : dict or None, name to bytes of the lessons as pages (:mod:`course.site.in_pack`)

    Returns
    -------
    dict, name in the pack to bytes, sorted
    """
    found = _files(root, FOLDERS, FILES)
    found |= {path.name: path.read_bytes() for path in sorted(HANDOUT.iterdir())}
    robots = found["docs/robots.md"].decode()
    for picture in _PICTURE.findall(robots):
        found[f"docs/{picture}"] = (root / "docs" / picture).read_bytes()
    for name in found:
        if name.startswith("notebooks/"):
            found[name] = without_notes(found[name])
    notebooks = {name: data for name, data in found.items() if name.endswith(".ipynb")}
    archive = io.BytesIO()
    write_zip(archive, notebooks)
    found |= pages or {}
    return dict(sorted((found | {originals.ARCHIVE: archive.getvalue()}).items()))


def lecturers_contents(root=ROOT):
    """List what lecturers get: notes, solutions and the texts' sources as well.

    Parameters
    ----------
    root : Path, of the project

    Returns
    -------
    dict, name in the pack to bytes, sorted
    """
    return dict(sorted(_files(root, LECTURERS_FOLDERS, LECTURERS_FILES).items()))


def without_notes(data):
    """A notebook without what speaks to the lecturer.

    Parameters
    ----------
    data : bytes, of a notebook's file

    Returns
    -------
    bytes
    """
    notebook = json.loads(data)
    notebook["cells"] = [cell for cell in notebook["cells"] if not LECTURER & marks(cell)]
    return json_bytes(notebook)


def pack(target, files):
    """Write a pack: a zip file that unpacks into one folder.

    Parameters
    ----------
    target : Path, ending in .zip
    files : dict, name in the pack to bytes
    """
    write_zip(target, {f"{TOP}/{name}": data for name, data in files.items()})


def write_zip(target, files):
    """Write a zip file; the same files give the same bytes.

    Parameters
    ----------
    target : Path or file to write
    files : dict, name to bytes
    """
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, data in files.items():
            info = zipfile.ZipInfo(name, TIMESTAMP)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            packed.writestr(info, data)


def _files(root, folders, names):
    paths = [root / name for name in names]
    for folder in folders:
        paths += [path for path in (root / folder).rglob("*") if path.is_file()]
    return {
        path.relative_to(root).as_posix(): path.read_bytes()
        for path in paths
        if not set(EXCLUDED) & set(path.parts) and INK not in path.suffixes
    }


def marks(cell):
    """What a cell is marked as: its slide type and its tags, a set."""
    metadata = cell["metadata"]
    return {metadata.get("slideshow", {}).get("slide_type"), *metadata.get("tags", [])}


def main(argv=None):
    """Run the command line; returns its exit code."""
    parser = argparse.ArgumentParser(prog="python -m course.pack", description=__doc__)
    parser.add_argument("--lecturer", action="store_true", help="with solutions and notes")
    parser.add_argument("--no-pages", action="store_true", help="without the lessons as pages")
    options = parser.parse_args(argv)
    target = Path(f"{TOP}-lecturer.zip" if options.lecturer else f"{TOP}.zip")
    if options.lecturer:
        files, said = lecturers_contents(), "with solutions and notes: not for students"
    else:
        from course.site import building, in_pack  # which need what packing alone does not

        try:
            pages = {} if options.no_pages else in_pack.pages()
        except building.SiteError as error:
            print(f"{error}\n--no-pages packs without the lessons' pages", file=sys.stderr)
            return 1
        files, said = contents(pages=pages), "without solutions"
    pack(target, files)
    size = target.stat().st_size
    print(f"{target}: {size / 1e6:.1f} MB, {said}")
    if not options.lecturer and size > LARGEST:
        print(f"more than {LARGEST / 1e6:.0f} MB: too much to hand out", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
