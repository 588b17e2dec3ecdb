"""Tools for a class that uses the library ``slamlab``: exercises, checks, lectures, grading.

Each component imports only components that are listed above it:

installed_course  discovery of the installed course by its entry point
derivation        derivations whose lines are checked by computer algebra: ``derive``
exercises         tasks, calls of a student's functions, laws that judge the outputs, hints
project           a student's own SLAM on hidden simulated worlds, and its score
coursework        a student's course folder: progress, reset, update
grading           judge, sandbox, gradebook, late policy, similarity of submissions
contest           students' SLAM programs on the same hidden worlds: leaderboard, student pages
checks            functions that notebooks call: ``check``, ``hint``, ``ask``, ``validate``
lecturing         rehearsal and printing of a lesson's slides in a headless browser
reviewing         review of a class's marks in a browser: ``slamlab grade review``
audience          slides and polls on the phones of a lecture's audience: ``audience.start``
hub               the course on a JupyterHub: student servers, phones, collecting, returning
cli               ``slamlab`` commands for students, lecturers and graders
"""
