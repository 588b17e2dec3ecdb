"""The content of the course, and the tools that build its notebooks and pages.

exercises   a folder for each exercise: notebook, function calls, and tasks with their mistakes
studies     tables of many runs, which lessons read; a command writes each table
questions   the stored questions of lessons and exercises
lessons     the text sources of the lessons
project     solutions of the final project; never shipped
builder     all other modules here: ``python -m course.build`` derives the notebooks
site        the course as web pages, and the code that renders them
pack        the packs for students and for lecturers
"""
