"""Error messages of widget callbacks (exceptions): there is no cell for them to fail in."""


def error_line(error):
    """Error message of an exception in one line, without a traceback.

    Parameters
    ----------
    error : Exception

    Returns
    -------
    str
    """
    text = " ".join(str(error).split()) or "no message"
    # what the course raises on purpose says all there is to say
    return text if isinstance(error, ValueError) else f"{type(error).__name__}: {text}"
