"""A term: a course file, who is enrolled, downloads from Moodle and Canvas, releases.

Read in this order:

- ``lms_names``: what Moodle and Canvas write into the names of a download
"""
