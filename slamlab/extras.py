"""Extras: optional dependencies that are not always installed."""

from contextlib import contextmanager

DISTRIBUTION = "slam-course-lab"


class ExtraMissing(ImportError):
    """A package of an extra is not installed; the message contains the installation command."""


@contextmanager
def needs(extra, distribution=DISTRIBUTION):
    """Context for the import of optional dependencies: ``with needs("live"): import tornado``.
    Raises ExtraMissing if one of the packages is not installed.

    Parameters
    ----------
    extra : str, name of the extra in ``pyproject.toml``
    distribution : str, distribution that has the extra
    """
    try:
        yield
    except ModuleNotFoundError as error:
        install = f'pip install "{distribution}[{extra}]"'
        raise ExtraMissing(f"{error.name} is not installed: {install}", name=error.name) from None
