"""Update: a new edition's pack in place of the old one; the answers stay."""

import json
import shutil
import tempfile
import zipfile
from datetime import datetime
from pathlib import Path

from slamlab.coursework import originals
from slamlab.coursework.file_writing import json_bytes, keep_beside, write
from slamlab.coursework.folder import FOLDERS
from slamlab.coursework.originals import OriginalError

SWAPPED = ("slamlab", "labextension", "docs", "pages")  # folders that nobody writes in


class UpdateError(Exception):
    """Nothing was updated; the text says why and what to do."""


def update(folder: Path, pack: Path, now: datetime) -> list[str]:
    """Update the course in a folder from a new students' pack.

    A notebook as it was handed out is replaced. One with answers gets the new text around them, and
    the old file is kept beside it. Killed at any moment it loses nothing, and can be run again.

    Parameters
    ----------
    folder : Path, of the course, from a pack
    pack : Path, the new zip
    now : datetime, for the names of what is kept

    Returns
    -------
    list of str, what was done

    Raises
    ------
    UpdateError
    """
    if (folder / ".git").exists():
        raise UpdateError("this course is a clone: git pull brings the new edition")
    if not (folder / originals.ARCHIVE).is_file():
        raise UpdateError(f"{folder} is no students' pack: {originals.ARCHIVE} is missing")
    with tempfile.TemporaryDirectory(prefix=".update-", dir=folder) as staged:
        try:
            with zipfile.ZipFile(pack) as packed:
                packed.extractall(staged)
        except (OSError, zipfile.BadZipFile) as error:
            why = getattr(error, "strerror", None) or error
            raise UpdateError(f"{pack} cannot be read: {why}") from None
        tops = [place.parent.parent.parent for place in Path(staged).rglob(originals.ARCHIVE)]
        if not tops:
            raise UpdateError(f"{pack} is no students' pack of this course")
        try:
            told = [_bring(folder, tops[0], name, now) for name in originals.names(tops[0])]
        except OriginalError as error:
            raise UpdateError(str(error)) from None
        _swap(folder, tops[0], Path(staged))
    return [line for line in told if line] or ["no notebook has changed"]


def _bring(folder, new, name, now):
    """Bring one notebook to its new form; what was done, or None."""
    path, target = folder / name, originals.original(new, name)
    known = originals.names(folder)
    old = originals.original(folder, name) if name in known else None
    if not path.exists():
        write(path, target)
        return f"{name}: new" if old is None else f"{name}: is back"
    own = path.read_bytes()
    if target in (old, own):
        return None
    if _sources(own) is None:
        kept = keep_beside(path, now)
        write(path, target)
        return f"{name}: replaced; it could not be read, the old one is {kept.name}"
    if old is not None and _sources(own) == _sources(old):
        write(path, target)
        return f"{name}: replaced"
    merged = merge_answers(json.loads(own), json.loads(old) if old else None, json.loads(target))
    kept = keep_beside(path, now)
    write(path, json_bytes(merged))
    return f"{name}: new text around your cells; the old one is {kept.name}"


def merge_answers(own, old, new):
    """Merge a student's notebook with its new edition: the new text, the student's own cells.

    Parameters
    ----------
    own, old, new : dict, notebooks: as it stands, as it was handed out (or None), as it is now

    Returns
    -------
    dict, a notebook
    """
    before = {cell.get("id"): _text(cell) for cell in old["cells"]} if old else {}
    merged = {**new, "cells": list(new["cells"])}
    last = None  # the cell behind which a cell of the student's own belongs
    for cell in own["cells"]:
        places = {each.get("id"): place for place, each in enumerate(merged["cells"])}
        id = cell.get("id")
        if before.get(id) != _text(cell):  # written or changed by the student
            if id in places:
                merged["cells"][places[id]] = _answered(merged["cells"][places[id]], cell)
            else:
                merged["cells"].insert(places.get(last, -1) + 1, cell)
        if id in places or before.get(id) != _text(cell):
            last = id
    return merged


def _answered(cell, own):
    if cell["metadata"].get("nbgrader", {}).get("grade"):
        return cell  # a check is the course's own
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
    """Put all but the notebooks in place: files one by one, folders by renaming."""
    for name in SWAPPED:
        if (new / name).is_dir():
            if (folder / name).exists():
                (folder / name).rename(staged / f"old-{name}")
            (new / name).rename(folder / name)
    for path in sorted(new.rglob("*")):
        inside = path.relative_to(new)
        if path.is_file() and inside.parts[0] not in FOLDERS:
            write(folder / inside, path.read_bytes())
    for path in (folder / "labextension", folder / "slamlab"):
        shutil.rmtree(path / "__pycache__", ignore_errors=True)
