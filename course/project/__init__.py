"""The final project: the template that students begin with, a solution, and other estimators.

They stand on numpy, scipy and ``slamlab.geometry`` alone, as a student's has to.
"""
