"""Build tool: ``python -m course.build`` derives the notebooks from their text sources."""

import argparse
import sys
from pathlib import Path

import nbformat

from course import computed_values, question_cells
from course.derive import FOLDERS, derive
from course.execute import ExecutionError, carry_outputs, execute, executed, same_code
from course.source import KINDS, ROOT, CourseError, file_name, kind_folder, sources, topic
from slamlab.sources.public_datasets import data_folder


def build(path, force=False, root=ROOT):
    """Build the notebooks of one source: derive them, execute them if they changed, and store them.

    Parameters
    ----------
    path : Path, the source
    force : bool, run them even if they did not change
    root : Path, the project's folder

    Returns
    -------
    list of str : what was done, one entry per notebook

    Raises
    ------
    CourseError : the source violates the standards or a cell fails
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
            question_cells.reword(notebook, derived.source)
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
    """Compare the stored notebooks of a source with the source, ignoring outputs.

    Parameters
    ----------
    path : Path, the source
    root : Path, the project's folder

    Returns
    -------
    list of str, each "file: what differs"

    Raises
    ------
    CourseError : the source violates the course's standards
    """
    found, all_derived = [], derive(path, root)
    asked, kept = all_derived[0].source, question_cells.file(all_derived[0].source, root)
    if question_cells.text(asked) != _text(kept):
        found.append(f"{kept.relative_to(root).as_posix()}: its questions differ from the source")
    for derived in all_derived:
        name, stored = derived.path.relative_to(root).as_posix(), _stored(derived.path)
        if stored is None:
            found.append(f"{name}: is missing")
            continue
        if derived.runs and not executed(stored):
            found.append(f"{name}: was not run")
        filled = (
            computed_values.carry(derived.notebook, stored) if derived.runs else derived.notebook
        )
        want, have = _without_outputs(filled or derived.notebook), _without_outputs(stored)
        if [c.id for c in want.cells] != [c.id for c in have.cells]:
            found.append(f"{name}: its cells differ from the source")
        elif want != have:
            cells = [w.id for w, h in zip(want.cells, have.cells, strict=True) if w != h]
            found.append(f"{name}: differs in {', '.join(cells) or 'its metadata'}")
        elif not derived.runs and nbformat.writes(derived.notebook) != nbformat.writes(stored):
            found.append(f"{name}: contains outputs")
    return found


def orphans(root=ROOT):
    """Find orphans (derived notebooks without a source), and return their paths relative to the
    root."""
    sourced = {
        (folder, file_name(path))
        for path in sources(root)
        for folder in FOLDERS[KINDS[kind_folder(path).name]]
    }
    return [
        path.relative_to(root).as_posix()
        for folder in sorted({name for folders in FOLDERS.values() for name in folders})
        for path in sorted((root / folder).glob("*.ipynb"))
        if (folder, path.name) not in sourced
    ]


def main(argv=None):
    """Run the command line and return its exit code."""
    parser = argparse.ArgumentParser(prog="python -m course.build", description=__doc__)
    parser.add_argument("names", nargs="*", help="sources: a path, a name or a number such as 04")
    parser.add_argument("--force", action="store_true", help="run unchanged notebooks, too")
    parser.add_argument(
        "--check", action="store_true", help="only report differences; write nothing"
    )
    options = parser.parse_args(argv)
    paths, problems = _select_sources(options.names)
    if not options.check and not data_folder().exists():
        print("note: lessons run on simulated logs; slamlab data get --all fetches the recordings")
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
    print(*problems, sep="\n", end="\n" if problems else "", file=sys.stderr)
    return 1 if problems else 0


def _select_sources(names):
    """Select sources by name; return the sources and the problems with invalid names."""
    known, chosen, problems = sources(), [], []
    for name in names:
        stem = Path(name).stem
        same = [p for p in known if Path(name).resolve() == p]
        hits = same or [p for p in known if stem in _names(p)]
        chosen += [p for p in hits if p not in chosen]
        if not hits:
            problems.append(f"{name}: no such source in course/lessons or course/exercises")
    return (chosen if names else known), problems


def _names(path):
    return topic(path), topic(path).split("_")[0], Path(file_name(path)).stem


def _keep_questions(source, root):
    """Store the questions of a source if they changed."""
    file, text = question_cells.file(source, root), question_cells.text(source)
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
        f"{derived.source.at(source)}: is tagged nbval-check-output but has no output to compare"
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
        return None  # a broken file counts as missing and is written again


def _without_outputs(notebook):
    bare = nbformat.from_dict(notebook)
    for cell in bare.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    return bare


if __name__ == "__main__":
    sys.exit(main())
