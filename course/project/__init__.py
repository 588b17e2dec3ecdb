"""The final project: the students' template, a solution, and reference estimators.

They import only numpy, scipy and ``slamlab.geometry``, as a student's estimator must.
"""
