"""Build tool: derives the notebooks from their text sources by ``python -m course.build``."""

import argparse
import os
import sys
from pathlib import Path

import nbformat

from course import appendix, asking, values
from course.derive import FOLDERS, derive
from course.execute import ExecutionError, carry_outputs, execute, executed, same_code
from course.source import ROOT, CourseError, file_name, sources


def build(path, force=False, root=ROOT):
    """Build the notebooks of one source: derive, execute where they changed, store.

    Parameters
    ----------
    path : Path, the source
    force : bool, run them even where they did not change
    root : Path, the project's folder

    Returns
    -------
    list of str : what was done, one a notebook

    Raises
    ------
    CourseError : where the source breaks the standards or a cell fails
    """
    done, all_derived = [], derive(path, root)
    _keep_questions(all_derived[0].source, root)  # notebooks ask by the id when they are run
    for derived in all_derived:
        stored, notebook = _stored(derived.path), derived.notebook
        ran = False
        if derived.runs:
            fresh = stored and executed(stored) and same_code(notebook, stored)
            ran = force or not fresh
            notebook = _run(derived) if ran else carry_outputs(notebook, stored)
            asking.reword(notebook, derived.source)
        text = nbformat.writes(notebook)
        name = derived.path.relative_to(root).as_posix()
        if derived.path.exists() and derived.path.read_text(encoding="utf-8") == text:
            done.append(f"{name} {'ran, ' if ran else ''}unchanged")
            continue
        derived.path.parent.mkdir(exist_ok=True)
        derived.path.write_text(text, encoding="utf-8", newline="\n")
        done.append(f"{name} {'ran and ' if ran else ''}written")
    return done


def differences(path, root=ROOT):
    """Check the stored notebooks of one source: how they differ from it, outputs aside.

    Parameters
    ----------
    path : Path, the source
    root : Path, the project's folder

    Returns
    -------
    list of str, each "file: what differs"

    Raises
    ------
    CourseError : where the source breaks the course's standards
    """
    found, all_derived = [], derive(path, root)
    asked, kept = all_derived[0].source, asking.file(all_derived[0].source, root)
    if asking.text(asked) != _text(kept):
        found.append(f"{kept.relative_to(root).as_posix()}: holds other questions")
    for derived in all_derived:
        name, stored = derived.path.relative_to(root).as_posix(), _stored(derived.path)
        if stored is None:
            found.append(f"{name}: is missing")
            continue
        if derived.runs and not executed(stored):
            found.append(f"{name}: was not run")
        filled = values.carry(derived.notebook, stored) if derived.runs else derived.notebook
        want, have = _without_outputs(filled or derived.notebook), _without_outputs(stored)
        if [c.id for c in want.cells] != [c.id for c in have.cells]:
            found.append(f"{name}: other cells than its source has")
        elif want != have:
            cells = [w.id for w, h in zip(want.cells, have.cells, strict=True) if w != h]
            found.append(f"{name}: differs in {', '.join(cells) or 'its metadata'}")
        elif not derived.runs and nbformat.writes(derived.notebook) != nbformat.writes(stored):
            found.append(f"{name}: holds outputs")
    return found


def orphans(root=ROOT):
    """Find orphans: notebooks in the derived folders without a source, as paths from the root."""
    sourced = {(p.parent.name, file_name(p)) for p in sources(root)}
    kinds = {folder: f"{kind}s" for kind, folders in FOLDERS.items() for folder in folders}
    return [
        path.relative_to(root).as_posix()
        for folder in kinds
        for path in sorted((root / folder).glob("*.ipynb"))
        if (kinds[folder], path.name) not in sourced and path != root / appendix.FILE
    ]


def main(argv=None):
    """Run the command line; returns its exit code."""
    parser = argparse.ArgumentParser(prog="python -m course.build", description=__doc__)
    parser.add_argument("names", nargs="*", help="sources: a path, a name or a number such as 04")
    parser.add_argument("--force", action="store_true", help="run notebooks that did not change")
    parser.add_argument(
        "--check", action="store_true", help="only tell what differs; write nothing"
    )
    options = parser.parse_args(argv)
    paths, problems = _select_sources(options.names)
    if not options.check and not (os.environ.get("SLAMLAB_DATA") or (ROOT / "data").exists()):
        print("note: no recordings here (data/ or SLAMLAB_DATA): lessons run on simulated logs")
    for path in paths:
        try:
            if options.check:
                problems += differences(path)
            else:
                print(*build(path, options.force), sep="\n", flush=True)
        except CourseError as error:
            problems += error.problems
    if not options.names:
        problems += [f"{name}: has no source" for name in orphans()]
    if not options.check:
        print(appendix.store())
    elif not appendix.is_stored():
        problems.append(f"{appendix.FILE}: says something else than the lessons: build it again")
    print(*problems, sep="\n", end="\n" if problems else "", file=sys.stderr)
    return 1 if problems else 0


def _select_sources(names):
    """Select the sources by name; also the problems with the names."""
    known, chosen, problems = sources(), [], []
    for name in names:
        stem = Path(name).stem
        same = [p for p in known if Path(name).resolve() == p]
        hits = same or [p for p in known if stem in (p.stem, p.stem.split("_")[0])]
        chosen += [p for p in hits if p not in chosen]
        if not hits:
            problems.append(f"{name}: no such source in course/lessons or course/exercises")
    return (chosen if names else known), problems


def _keep_questions(source, root):
    """Store what a source asks, if that is new."""
    file, text = asking.file(source, root), asking.text(source)
    if text == _text(file):
        return
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8", newline="\n")


def _text(file):
    return file.read_text(encoding="utf-8") if file.exists() else ""


def _run(derived):
    try:
        notebook = execute(derived.notebook, derived.path.parent)
    except ExecutionError as error:
        cell = derived.source.cells[error.cell]
        raise CourseError([f"{derived.source.at(cell)}: {cell.id} failed\n    {error}"]) from None
    silent = [
        f"{derived.source.at(source)}: is tagged nbval-check-output but shows nothing to compare"
        for source, cell in zip(derived.source.cells, notebook.cells, strict=True)
        if "nbval-check-output" in source.tags and not cell.outputs
    ]
    if silent:
        raise CourseError(silent)
    return notebook


def _stored(path):
    try:
        return nbformat.read(path, as_version=4)
    except FileNotFoundError:
        return None
    except (ValueError, nbformat.reader.NotJSONError):
        return None  # a broken file counts as none and is written again


def _without_outputs(notebook):
    bare = nbformat.from_dict(notebook)
    for cell in bare.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    return bare


if __name__ == "__main__":
    sys.exit(main())
