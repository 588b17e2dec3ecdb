"""Grading submissions: a judge that runs no student code, a worker that holds no answer."""
