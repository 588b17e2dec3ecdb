"""A student's course folder: progress, reset of notebooks, update to a new edition.

Read in this order: ``folder``, ``file_writing`` (atomic), ``progress_file``, ``progress_records``,
``progress_overview``; ``originals`` (as handed out), ``notebook_reset``, ``notebook_update``."""

from classroom.coursework.folder import course_folder, is_progress_kept


def show_progress():
    """Print the progress: lessons, tasks, points, next step."""
    from classroom.coursework import progress_file, progress_overview

    folder = course_folder() if is_progress_kept() else None
    progress = progress_file.EMPTY if folder is None else progress_file.read(folder)
    print(progress_overview.overview(folder, progress))
