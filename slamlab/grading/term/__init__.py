"""A term: a course file, who is enrolled, downloads from Moodle and Canvas, releases.

Read in this order:

- ``course_file``, ``roster``: what a lecturer says once
- ``lms_names``, ``worksheet``: what Moodle and Canvas say of a download
- ``archives``, ``hand_ins``, ``enrolment``: what was handed in, and whose it is
- ``standings``, ``term_tables``, ``releases``, ``released_scores``: which attempt counts, and
  what goes back
- ``term``: all of it together, for the command line
"""
