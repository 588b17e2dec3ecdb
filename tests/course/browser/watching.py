"""What goes wrong on a page, what it asks of other hosts, and its faults of accessibility."""

from axe_playwright_python.sync_playwright import Axe

from tests.timeouts import PATIENCE

SERIOUS = ("serious", "critical")


def watch(page, hosts, errors, foreign_requests, console=True):
    """Give a page its patience and record what goes wrong on it.

    Parameters
    ----------
    page : Page of Playwright
    hosts : tuple of str, how the addresses begin that it may ask for
    errors, foreign_requests : list of str, which grow
    console : bool, whether errors of the console are among them
    """
    local = (*hosts, "data:", "blob:")
    page.set_default_timeout(1000 * PATIENCE)
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on(
        "request",
        lambda asked: asked.url.startswith(local) or foreign_requests.append(asked.url),
    )
    if console:
        page.on("console", lambda note: note.type == "error" and errors.append(note.text))


def faults(page, within="html", impacts=("minor", "moderate", *SERIOUS), but=None):
    """Faults of accessibility by axe-core, each the rule and where it is broken.

    Parameters
    ----------
    page : Page of Playwright
    within : str or dict, the context that axe-core looks at
    impacts : tuple of str
    but : str or None, what stands in elements whose faults do not count

    Returns
    -------
    list of str
    """
    found = Axe().run(page, within, options={"resultTypes": ["violations"], "preload": False})
    return [
        f"{page.url}: {broken['id']}: {node['html'][:200]}"
        for broken in found.response["violations"]
        if broken["impact"] in impacts
        for node in broken["nodes"]
        if not (but and but in node["html"])
    ]


def fits(page):
    """Whether nothing on a page is wider than it."""
    return page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
