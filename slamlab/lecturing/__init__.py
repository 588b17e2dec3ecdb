"""A lesson's slides without a lecturer: rehearsed beforehand, printed afterwards.

Read in this order:

- ``headless``: a browser without a window, and a JupyterLab with a home of its own
- ``shown_lesson``: a copy of a lesson, shown by the lecture mode in there
- ``needs``: what a lesson's code needs besides itself: devices, a network, recordings
- ``planning``: the minutes planned for a lesson's sections
- ``rehearsal``, ``rehearsal_report``: the lesson run and stepped through, and what is told of it
- ``handout``: the slides as a PDF
"""
