"""Look through a built site: dead links, other machines, what students must not see, its size."""

import re
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

LARGEST = 60e6  # [bytes] of a site
FORBIDDEN = ("For the lecturer", "### BEGIN SOLUTION")
_SET_OTHERWISE = re.compile(r"<(pre|code|script|annotation)\b.*?</\1>", re.DOTALL)
_LATEX = re.compile(r"\$[^$\n]*\\[A-Za-z]+[^$\n]*\$")
_LOADS = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}


class _Page(HTMLParser):
    """Links, anchors and loaded files of a page; pictures without a text."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loaded, self.anchors, self.nameless = [], [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """Note what a tag leads to."""
        told = dict(attrs)
        self.anchors |= {told[name] for name in ("id", "name") if told.get(name)}
        if tag == "a" and "href" in told:
            self.links.append(told["href"] or "")
        elif tag in _LOADS and told.get(_LOADS[tag]) and told.get("rel") != "canonical":
            self.loaded.append(told[_LOADS[tag]])
        if tag == "img" and not (told.get("alt") or "").strip():
            self.nameless.append((told.get("src") or "")[:60])


def problems(site):
    """Find what is wrong with a site.

    Parameters
    ----------
    site : Path

    Returns
    -------
    list of str, each "page: what is wrong"
    """
    site = site.resolve()
    texts = {path: path.read_text(encoding="utf-8") for path in sorted(site.rglob("*.html"))}
    pages = {path: _Page(text) for path, text in texts.items()}
    found = []
    for path, page in pages.items():
        name = path.relative_to(site).as_posix()
        found += [f"{name}: says {words!r}" for words in FORBIDDEN if words in texts[path]]
        found += [f"{name}: a formula that is not set: {latex}" for latex in _unset(texts[path])]
        found += [f"{name}: loads {url} of another machine" for url in _foreign(page.loaded)]
        found += [f"{name}: dead link {link}" for link in _dead(site, path, page.links, pages)]
        found += [f"{name}: dead file {link}" for link in _dead(site, path, page.loaded, pages)]
        found += [f"{name}: a picture without a text: {src}" for src in page.nameless]
    if size(site) > LARGEST:
        found.append(f"{size(site) / 1e6:.0f} MB: more than {LARGEST / 1e6:.0f}")
    return found


def size(site):
    """How large a site is [bytes]."""
    return sum(path.stat().st_size for path in site.rglob("*") if path.is_file())


def _unset(text):
    """LaTeX that a reader would see as such."""
    return _LATEX.findall(re.sub(r"<[^>]+>", "", _SET_OTHERWISE.sub("", text)))


def _foreign(urls):
    return [url for url in urls if re.match(r"(https?:)?//", url)]


def _dead(site, path, links, pages):
    """The links that lead nowhere within the site; others are not followed."""
    for link in sorted(set(links)):
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
        anchors = pages[target].anchors if target in pages else ()
        leads = target.is_file() and target.is_relative_to(site)
        if not leads or (parts.fragment and anchors and unquote(parts.fragment) not in anchors):
            yield link
