"""Update the course folder from the pack of a new edition, and keep the student's answers."""

import json
import shutil
import tempfile
import zipfile
from datetime import datetime
from pathlib import Path

from classroom.coursework import originals
from classroom.coursework.file_writing import back_up_beside, json_bytes, write
from classroom.coursework.folder import FOLDERS
from classroom.coursework.originals import OriginalError

PACKAGES = ("slamlab", "classroom", "course")
SWAPPED = (*PACKAGES, "labextension", "docs", "pages")  # folders without a student's files


class UpdateError(Exception):
    """Nothing was updated; the message states the reason and a remedy."""


def update(folder: Path, pack: Path, now: datetime) -> list[str]:
    """Update the course in a folder from a new pack (zip), and return messages. Raises UpdateError.

    An unchanged notebook is replaced. A notebook with answers gets the new text around the answers,
    and a copy of the old notebook is saved. No data are lost if the process is killed: run the
    update again."""
    if (folder / ".git").exists():
        raise UpdateError("this course is a git clone: update it with git pull")
    if not (folder / originals.ARCHIVE).is_file():
        raise UpdateError(f"{folder} is not a students' pack: {originals.ARCHIVE} is missing")
    with tempfile.TemporaryDirectory(prefix=".update-", dir=folder) as staged:
        try:
            with zipfile.ZipFile(pack) as packed:
                packed.extractall(staged)
        except (OSError, zipfile.BadZipFile) as error:
            why = getattr(error, "strerror", None) or error
            raise UpdateError(f"{pack} cannot be read: {why}") from None
        tops = [file.parent.parent for file in Path(staged).rglob(originals.ARCHIVE)]
        if not tops:
            raise UpdateError(f"{pack} is not a students' pack of this course")
        done = update_notebooks(folder, tops[0], now)
        _swap(folder, tops[0], Path(staged))
    return done or ["no notebook has changed"]


def update_notebooks(folder: Path, new: Path, now: datetime) -> list[str]:
    """Update the notebooks in a folder from an unpacked new pack, and return messages.

    Raises UpdateError."""
    try:
        done = [_update_one(folder, new, name, now) for name in originals.names(new)]
    except OriginalError as error:
        raise UpdateError(str(error)) from None
    return [line for line in done if line]


def _update_one(folder, new, name, now):
    path, target = folder / name, originals.original(new, name)
    known = originals.names(folder)
    old = originals.original(folder, name) if name in known else None
    if not path.exists():
        write(path, target)
        return f"{name}: new" if old is None else f"{name}: restored"
    own = path.read_bytes()
    if target in (old, own):
        return None
    if _sources(own) is None:
        backup = back_up_beside(path, now)
        write(path, target)
        return f"{name}: replaced, because it could not be read; the old file is {backup.name}"
    if old is not None and _sources(own) == _sources(old):
        write(path, target)
        return f"{name}: replaced"
    merged = merge_answers(json.loads(own), json.loads(old) if old else None, json.loads(target))
    backup = back_up_beside(path, now)
    write(path, json_bytes(merged))
    return f"{name}: updated the text around your cells; your old version is {backup.name}"


def merge_answers(own, old, new):
    """Merge the text of the new edition with the student's own cells."""
    before = {cell.get("id"): _text(cell) for cell in old["cells"]} if old else {}
    merged = {**new, "cells": list(new["cells"])}
    last = None  # id of the cell after which the student's next own cell is inserted
    for cell in own["cells"]:
        index = {each.get("id"): k for k, each in enumerate(merged["cells"])}
        id = cell.get("id")
        if before.get(id) != _text(cell):  # written or changed by the student
            if id in index:
                merged["cells"][index[id]] = _answered(merged["cells"][index[id]], cell)
            else:
                merged["cells"].insert(index.get(last, -1) + 1, cell)
        if id in index or before.get(id) != _text(cell):
            last = id
    return merged


def _answered(cell, own):
    if cell["metadata"].get("nbgrader", {}).get("grade"):
        return cell  # students do not edit checks
    return {**cell, **{key: own[key] for key in ("source", "outputs") if key in own}}


def _sources(data):
    try:
        return [_text(cell) for cell in json.loads(data)["cells"]]
    except (ValueError, KeyError, TypeError):
        return None


def _text(cell):
    source = cell.get("source", "")
    return source if isinstance(source, str) else "".join(source)


def _swap(folder, new, staged):
    """Replace everything except the notebooks: files one by one, folders by renaming."""
    for name in SWAPPED:
        if (new / name).is_dir():
            if (folder / name).exists():
                (folder / name).rename(staged / f"old-{name}")
            (new / name).rename(folder / name)
    for path in sorted(new.rglob("*")):
        inside = path.relative_to(new)
        if path.is_file() and inside.parts[0] not in FOLDERS:
            write(folder / inside, path.read_bytes())
    for name in PACKAGES:
        shutil.rmtree(folder / name / "__pycache__", ignore_errors=True)
