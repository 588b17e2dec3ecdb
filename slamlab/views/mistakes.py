"""Mistakes made while a reader uses a widget: there is no cell for them to fail in."""


def sentence(error):
    """A mistake in one line, without a traceback.

    Parameters
    ----------
    error : Exception

    Returns
    -------
    str
    """
    text = " ".join(str(error).split()) or "no more is known"
    # what the course raises on purpose says all there is to say
    return text if isinstance(error, ValueError) else f"{type(error).__name__}: {text}"
