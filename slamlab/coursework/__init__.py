"""A student's own folder: how far one is, and notebooks given back as they were handed out.

Read in this order:

- ``folder``: where the course stands, and whether progress is kept in this process
- ``file_writing``: files whole or not at all; ``progress_file``: ``progress.json``, written by
  several kernels; ``progress_records``: what goes into it
- ``overview``: how far one is, as ``slamlab progress`` and lesson 00 show it
- ``originals``: notebooks as they were handed out; ``notebook_reset``: giving them back;
  ``notebook_update``: a new edition in place of the old one, with the answers kept
"""

from slamlab.coursework.folder import course_folder, is_progress_kept


def show_progress():
    """Show how far one is: lessons, tasks, points, what is next."""
    from slamlab.coursework import overview, progress_file

    place = course_folder() if is_progress_kept() else None
    done = progress_file.EMPTY if place is None else progress_file.read(place)
    print(overview.overview(place, done))
