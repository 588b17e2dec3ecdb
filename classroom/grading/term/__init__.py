"""A term: course file, roster, Moodle and Canvas downloads, released grades. Read in this order:

- ``course_file``, ``roster``: settings and enrolled students
- ``lms_names``, ``worksheet``: data of Moodle and Canvas about a download
- ``archives``, ``zipped_submissions``, ``student_matching``: submissions and their students
- ``exercise_results``, ``term_tables``, ``releases``: the attempt that counts; tables and releases
- ``term``: all of these together, for the command line
"""
