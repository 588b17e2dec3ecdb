"""Stub of :mod:`slamlab.checks` in a worker, where nothing is checked or shown."""


def check(task_id=None):
    """Do nothing: the judge does the checking."""


def hint(task_id=None):
    """Do nothing: nothing is given away to a grader."""


def ask(id, *_, **__):
    """Do nothing: questions are for who learns."""


def validate():
    """Do nothing: the notebook is being graded."""


def attempt(function):
    """Do nothing: no one looks at pictures in a worker."""
