"""What a worker holds in the place of :mod:`slamlab.checks`: nothing is checked or shown there."""


def check(task_id):
    """Nothing: the judge does the checking."""


def validate():
    """Nothing: it is being graded."""


def attempt(function):
    """Nothing: no one looks at pictures in a worker."""
