"""TOML files that a lecturer writes: read, or told with their name why not."""

import tomllib


def read(path, refusal):
    """Read a TOML file.

    Parameters
    ----------
    path : Path
    refusal : Exception's class, raised with a text that names the file

    Returns
    -------
    dict
    """
    try:
        return tomllib.loads(path.read_text("utf-8-sig"))
    except OSError as error:
        raise refusal(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise refusal(f"{path}: not UTF-8; save it as plain text in UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        how = 'a time stands as 2026-12-01T23:59:00, a text as "…"'
        raise refusal(f"{path}: {error}; {how}") from None
