"""Pack the course for students (``make student``, without solutions) or for lecturers."""

import argparse
import io
import re
import shutil
import sys
import tomllib
import zipfile
from pathlib import Path, PurePath

from classroom.coursework import originals
from course.lecturer_cells import without_notes

ROOT = Path(__file__).resolve().parents[1]
HANDOUT = Path(__file__).parent / "handout"  # replaces the project's files for students
# the parts of the course that its distribution ships: no solutions, no known mistakes
_BUILD = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["hatch"]["build"]
SHIPPED, NEVER_SHIPPED = _BUILD["targets"]["wheel"]["only-include"], _BUILD["exclude"]
FOLDERS = ("notebooks", "exercises", "slamlab", *SHIPPED, "labextension")
FILES = ("LICENSE", "lab.py", "pyproject.toml", "environment.yml", "requirements.lock",
         "docs/live.md", "docs/robots.md", "docs/your_flat.md")  # fmt: skip
LECTURERS_FOLDERS = ("notebooks", "exercises", "slamlab", "classroom", "course", "labextension",
                     "solutions", "docs")  # fmt: skip
LECTURERS_FILES = (*FILES[:-1], "README.md", "Makefile", "CONTRIBUTING.md",
                   "requirements-test.lock")  # fmt: skip
LARGEST = 25e6  # of the students' pack [bytes]
EXCLUDED = ("__pycache__", ".ipynb_checkpoints")
INK = ".ink"  # in the name of a file with drawings from a lecture; they stay with the lecturer
TOP = "slam-course"
TIMESTAMP = (1980, 1, 1, 0, 0, 0)  # of every file in a zip, the earliest it can hold
_PICTURE = re.compile(r"!\[[^]]*\]\(([^)]+)\)")


def contents(root=ROOT, pages=None):
    """Return the files of the students' pack.

    Parameters
    ----------
    root : Path, of the project
    pages : dict or None, name to bytes of HTML pages (:mod:`course.site.student_pack_pages`)

    Returns
    -------
    dict, name in the pack to bytes, sorted
    """
    found = {
        name: data
        for name, data in _files(root, FOLDERS, FILES).items()
        if not any(PurePath(name).match(pattern) for pattern in NEVER_SHIPPED)
    }
    found |= {path.name: path.read_bytes() for path in sorted(HANDOUT.iterdir())}
    guides = [data.decode() for name, data in found.items() if name.startswith("docs/")]
    for picture in _PICTURE.findall("\n".join(guides)):
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
    """Return the files of the lecturers' pack, with notes, solutions and sources.

    Parameters
    ----------
    root : Path, of the project

    Returns
    -------
    dict, name in the pack to bytes, sorted
    """
    return dict(sorted(_files(root, LECTURERS_FOLDERS, LECTURERS_FILES).items()))


def pack(target, files):
    """Write a pack: a zip file that unpacks into one folder.

    Parameters
    ----------
    target : Path, ending in .zip
    files : dict, name in the pack to bytes
    """
    write_zip(target, {f"{TOP}/{name}": data for name, data in files.items()})


def write_zip(target, files):
    """Write a reproducible zip file: the same files give the same bytes.

    Parameters
    ----------
    target : Path or writable file
    files : dict, name to bytes
    """
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, data in files.items():
            info = zipfile.ZipInfo(name, TIMESTAMP)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            packed.writestr(info, data)


def _write_folder(folder, files):
    for name in FOLDERS:  # an earlier edition may have left files that this one lacks
        shutil.rmtree(folder / name, ignore_errors=True)
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)


def _files(root, folders, names):
    paths = [root / name for name in names]
    for folder in folders:
        path = root / folder
        paths += [path] if path.is_file() else [p for p in path.rglob("*") if p.is_file()]
    return {
        path.relative_to(root).as_posix(): path.read_bytes()
        for path in paths
        if not set(EXCLUDED) & set(path.parts) and INK not in path.suffixes
    }


def main(argv=None):
    """Run the command line and return its exit code."""
    parser = argparse.ArgumentParser(prog="python -m course.pack", description=__doc__)
    parser.add_argument("--lecturer", action="store_true", help="include solutions and notes")
    parser.add_argument("--no-pages", action="store_true", help="omit the lessons' HTML pages")
    parser.add_argument("--folder", type=Path, help="write into this folder, without pages")
    options = parser.parse_args(argv)
    if options.folder:
        if (options.folder / ".git").exists():
            parser.error(f"{options.folder} is a checkout; give a folder that the pack may replace")
        _write_folder(options.folder, contents())
        return 0
    target = Path(f"{TOP}-lecturer.zip" if options.lecturer else f"{TOP}.zip")
    if options.lecturer:
        files, contains = lecturers_contents(), "with solutions and notes, not for students"
    else:
        from course.site import (  # they need packages that packing alone does not
            building,
            student_pack_pages,
        )

        try:
            pages = {} if options.no_pages else student_pack_pages.pages()
        except building.SiteError as error:
            print(f"{error}\nAdd --no-pages to pack without the lessons' pages.", file=sys.stderr)
            return 1
        files, contains = contents(pages=pages), "without solutions"
    pack(target, files)
    size = target.stat().st_size
    print(f"{target}: {size / 1e6:.1f} MB, {contains}")
    if not options.lecturer and size > LARGEST:
        print(f"The pack is larger than {LARGEST / 1e6:.0f} MB.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
