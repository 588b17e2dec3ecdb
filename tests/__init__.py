"""The laws the package, the course and the grader obey."""
