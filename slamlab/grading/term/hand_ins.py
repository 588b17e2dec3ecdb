"""What was handed in: a folder, a zip or a download, with students' own zips opened."""

from dataclasses import replace

from slamlab.grading.notebooks import SubmissionError
from slamlab.grading.submissions import Submission, find_submissions, in_order
from slamlab.grading.term import archives


def find_hand_ins(place, scratch, out=None):
    """Find all submissions of a folder or a zip; zips in it are opened, too.

    Parameters
    ----------
    place : Path, of a folder or a zip
    scratch : Path, an empty folder in which zips are unpacked
    out : Path or None, a folder that is not looked into

    Returns
    -------
    list of Submission, sorted by name; what was refused is one with a problem

    Raises
    ------
    SubmissionError : the place is neither, or its zip is none
    """
    if not archives.is_archive(place):
        return _with_zips_opened(find_submissions(place, out, zips=True), scratch)
    try:
        refused = archives.unpack(place, scratch / "download")
    except SubmissionError as error:
        raise SubmissionError(f"{place}: {error}") from None
    listed = find_submissions(scratch / "download", zips=True)
    # a file of a zip tells no time; nbgrader's note does
    listed = [s if s.has_trusted_time else replace(s, when="") for s in listed]
    found = _with_zips_opened(listed, scratch)
    return found + [_refused(scratch, name, why) for name, why in refused]


def _with_zips_opened(listed, scratch):
    found = []
    for number, submission in enumerate(listed):
        opens = archives.is_archive(submission.path)
        found += _opened(submission, scratch / str(number)) if opens else [submission]
    return in_order(found)


def _opened(zipped, folder):
    """The submissions of a student's zip."""
    try:
        refused = archives.unpack(zipped.path, folder, archives.OF_A_STUDENT)
    except SubmissionError as error:
        return [replace(zipped, problem=str(error))]
    if any(archives.is_archive(path) for path in archives.unpacked_places(folder)):
        refused.append(("a zip in it", "zips in zips are not opened"))
    found = [
        replace(zipped, name=f"{zipped.name}/{path.relative_to(folder).as_posix()}", path=path,
                problem=None, when=zipped.handed_in or "")
        for path in archives.unpacked_places(folder) if path.suffix.lower() == ".ipynb"
    ]  # fmt: skip
    said = [f"{name}: {why}" for name, why in refused] or ["a zip without a notebook"]
    if refused or not found:
        found.append(replace(zipped, problem="refused: " + "; ".join(said)[:300]))
    return found


def _refused(scratch, name, why):
    whose = name.replace("\\", "/").lstrip("/").split("/")[0]
    return Submission(name, whose, scratch, f"refused: {why}", when="")
