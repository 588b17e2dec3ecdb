"""What a page promises is awaited with the one patience: ``evaluate`` waits for ever."""

from playwright.sync_api import TimeoutError as TooLate

from tests.patience import PATIENCE


def promised(page, what, script, arg=None, polling="raf", patience=PATIENCE):
    """Wait for what a script gives, or promises to give; where it is nothing, it is asked again.

    Parameters
    ----------
    page : Page of Playwright
    what : str, what is waited for, to be told where it does not come
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
