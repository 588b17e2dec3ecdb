"""Collect the submissions of a folder, zip file or LMS download, with students' zips unpacked."""

from dataclasses import replace

from classroom.grading.notebooks import SubmissionError
from classroom.grading.submissions import (
    Submission,
    find_submissions,
    in_order,
    problem_of,
    visible_files,
)
from classroom.grading.term import archives
from classroom.grading.term.lms_names import lms_name


def collect_submissions(source, scratch, out=None):
    """Return all submissions of a folder or zip file; zip files inside are unpacked in ``scratch``.
    A refused file becomes a submission with a problem. Raises SubmissionError.
    """
    if not archives.is_archive(source):
        return _unpack_zips(find_submissions(source, out, zips=True), scratch)
    try:
        refused = archives.unpack(source, scratch / "download")
    except SubmissionError as error:
        raise SubmissionError(f"{source}: {error}") from None
    listed = find_submissions(scratch / "download", zips=True)
    # files in a zip have no reliable time, but nbgrader's timestamp is reliable
    listed = [s if s.has_trusted_time else replace(s, when="") for s in listed]
    refused = [_refused(scratch, name, why) for name, why in refused]
    given = {submission.name.split("/")[0] for submission in refused}
    # a folder whose only file was refused is listed once
    found = [s for s in _unpack_zips(listed, scratch) if s.path.is_file() or s.name not in given]
    return found + refused


def _unpack_zips(listed, scratch):
    found = []
    for number, submission in enumerate(listed):
        is_zip = archives.is_archive(submission.path)
        found += _unpacked(submission, scratch / str(number)) if is_zip else [submission]
    return in_order(found)


def _unpacked(zipped, folder):
    """Return the notebooks in a student's zip; without one, the zip itself with a problem."""
    try:
        refused = archives.unpack(zipped.path, folder, archives.OF_A_STUDENT)
    except SubmissionError as error:
        return [replace(zipped, problem=f"{error}. Submit the notebook itself")]
    files = visible_files(folder)
    reasons = "; ".join(f"{name}: {why}" for name, why in refused)[:300]
    note = f"files in the zip were refused: {reasons}" if refused else ""
    if any(archives.is_archive(path) for path in files):
        note = "; ".join(filter(None, [note, "zip files in the zip were not opened"]))
    found = [
        replace(zipped, name=f"{zipped.name}/{path.relative_to(folder).as_posix()}", path=path,
                problem=None, when=zipped.handed_in or "", note=note)
        for path in files if path.suffix.lower() == ".ipynb"
    ]  # fmt: skip
    if not found and refused:
        problem = f"files in your zip were refused: {reasons}. Submit the notebook itself"
        return [replace(zipped, problem=problem)]
    return found or [replace(zipped, problem=f"in your zip, {problem_of(files)}")]


def _refused(scratch, name, why):
    of_lms, path = lms_name(name), name.replace("\\", "/").lstrip("/")
    whose, number = (of_lms.student, of_lms.number) if of_lms else (path.split("/")[0], None)
    return Submission(path, whose, scratch, f"the file was refused: {why}", number, when="")
