"""Check a built site: broken links, files from other hosts, content hidden from students, size."""

import re
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

LARGEST = 60e6  # [bytes] of a site
FORBIDDEN = ("For the lecturer", "### BEGIN SOLUTION")
_SET_OTHERWISE = re.compile(r"<(pre|code|script|annotation)\b.*?</\1>", re.DOTALL)
_EMPTY_HEADER = re.compile(r"<th\b[^>]*>\s*(?:<p>\s*</p>)?\s*</th>")
_ASIDE = re.compile(r"<aside\b(?![^>]*\brole=)[^>]*>")
_LATEX = re.compile(r"\$[^$\n]*\\[A-Za-z]+[^$\n]*\$")
_LOADS = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}


class _Page(HTMLParser):
    """Links, anchors and loaded files of a page, and pictures without an alternative text."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loaded, self.anchors, self.nameless = [], [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """Record the links and files of a tag."""
        attributes = dict(attrs)
        self.anchors |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        if tag == "a" and "href" in attributes:
            self.links.append(attributes["href"] or "")
        elif tag in _LOADS and attributes.get(_LOADS[tag]) and attributes.get("rel") != "canonical":
            self.loaded.append(attributes[_LOADS[tag]])
        if tag == "img" and not (attributes.get("alt") or "").strip():
            self.nameless.append((attributes.get("src") or "")[:60])


def problems(site):
    """Return the faults of a site.

    Parameters
    ----------
    site : Path

    Returns
    -------
    list of str, each "page: fault"
    """
    site = site.resolve()
    texts = {path: path.read_text(encoding="utf-8") for path in sorted(site.rglob("*.html"))}
    pages = {path: _Page(text) for path, text in texts.items()}
    found = []
    for path, page in pages.items():
        name = path.relative_to(site).as_posix()
        found += [f"{name}: contains {words!r}" for words in FORBIDDEN if words in texts[path]]
        found += [f"{name}: a formula was not rendered: {latex}" for latex in _unset(texts[path])]
        found += [f"{name}: loads {url} from another host" for url in _foreign(page.loaded)]
        found += [f"{name}: dead link {link}" for link in _dead(site, path, page.links, pages)]
        found += [f"{name}: missing file {link}" for link in _dead(site, path, page.loaded, pages)]
        found += [f"{name}: a picture has no alternative text: {src}" for src in page.nameless]
        found += [f"{name}: a table has an empty header"] * bool(_EMPTY_HEADER.search(texts[path]))
        names = [re.search(r'aria-label="[^"]+"', tag) for tag in _ASIDE.findall(texts[path])]
        if len({each and each[0] for each in names}) < len(names):
            found.append(f"{name}: two sidebars have the same name, or none")
    if size(site) > LARGEST:
        found.append(f"{size(site) / 1e6:.0f} MB: the limit is {LARGEST / 1e6:.0f} MB")
    return found


def size(site):
    """Return the size of a site [bytes]."""
    return sum(path.stat().st_size for path in site.rglob("*") if path.is_file())


def _unset(text):
    """Return LaTeX source that a reader would see."""
    return _LATEX.findall(re.sub(r"<[^>]+>", "", _SET_OTHERWISE.sub("", text)))


def _foreign(urls):
    return [url for url in urls if re.match(r"(https?:)?//", url)]


def _dead(site, path, links, pages):
    """Return dead links within the site; external links are not followed."""
    for link in sorted(set(links)):
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
        anchors = pages[target].anchors if target in pages else ()
        leads = target.is_file() and target.is_relative_to(site)
        if not leads or (parts.fragment and anchors and unquote(parts.fragment) not in anchors):
            yield link
