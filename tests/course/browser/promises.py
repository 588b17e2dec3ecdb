"""JavaScript promises of a page are awaited with a timeout, which ``evaluate`` does not have."""

from playwright.sync_api import TimeoutError as TooLate

from tests.timeouts import PATIENCE


def promised(page, what, script, arg=None, polling="raf", patience=PATIENCE):
    """Wait for a value or promise of a script; without a value, call it again.

    Parameters
    ----------
    page : Page of Playwright
    what : str, what is awaited, for the error message
    script : str, a function of ``arg`` in JavaScript
    polling : "raf" or float, when it is asked again, at every frame or after so long [ms]
    patience : float [s]

    Returns
    -------
    What JSON holds
    """
    try:
        timeout = 1000 * patience  # counted outside the page, which may have stopped
        given = page.wait_for_function(script, arg=arg, polling=polling, timeout=timeout)
        return given.json_value()
    except TooLate:
        raise AssertionError(f"waited in vain for {what}") from None
