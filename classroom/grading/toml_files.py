"""Read TOML files that a lecturer writes, with error messages that name the file."""

import tomllib


def read(path, refusal):
    """Return the content of a TOML file; raise ``refusal`` with a message if it is invalid."""
    try:
        return tomllib.loads(path.read_text("utf-8-sig"))
    except OSError as error:
        raise refusal(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise refusal(f"{path} is not UTF-8; save it as plain text in UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        how = 'write times as 2026-12-01T23:59:00 and texts as "…"'
        raise refusal(f"{path}: {error}; {how}") from None
