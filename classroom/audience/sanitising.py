"""Sanitising a slide's HTML: scripts, styles and external addresses are removed.

nh3 keeps the elements and attributes listed here. Each picture is embedded as a ``data:`` URL,
which becomes ``picture/NAME``; NAME is the hash of the picture's content."""

import base64
import binascii
import hashlib
import io
import re
import warnings

import nh3
from PIL import Image

TEXT = """
    a abbr b blockquote br caption cite code col colgroup dd del div dl dt em figcaption figure
    h1 h2 h3 h4 h5 h6 hr i img ins kbd li mark ol p pre q s samp section small span strong sub
    sup table tbody td tfoot th thead tr u ul var
"""
# not annotation: it holds the source of the formula a second time
FORMULA = """
    math menclose merror mfrac mi mmultiscripts mn mo mover mpadded mphantom mprescripts mroot
    mrow ms mspace msqrt mstyle msub msubsup msup mtable mtd mtext mtr munder munderover
"""
ELEMENTS = frozenset(TEXT.split() + FORMULA.split())
ATTRIBUTES = {
    "img": {"src", "alt", "width", "height"},
    "ol": {"start"},
    "td": {"colspan", "rowspan"},
    "th": {"colspan", "rowspan", "scope"},
    "math": {"display"},
    "mstyle": {"displaystyle", "scriptlevel"},
    "mo": {"stretchy", "fence", "separator", "accent", "movablelimits", "minsize", "maxsize"},
    "mi": {"mathvariant"},
    "mover": {"accent"},
    "munder": {"accentunder"},
    "mtable": {"columnalign", "rowspacing", "columnspacing", "columnlines", "rowlines"},
    "mtd": {"columnalign", "columnspan", "rowspan"},
    "mspace": {"width"},
    "mfrac": {"linethickness"},
}
REMOVED = {
    "script",
    "style",
    "annotation",
    "annotation-xml",
    "iframe",
    "object",
    "template",
    "noscript",
}
PICTURE = re.compile(r"data:image/(?:png|jpeg|webp|gif);base64,([A-Za-z0-9+/=\s]+)")
KINDS = {"PNG": "image/png", "JPEG": "image/jpeg", "WEBP": "image/webp", "GIF": "image/gif"}
MAX_BYTES, MAX_PIXELS = 2_000_000, 16_000_000


def clean(html):
    """Sanitise a slide's HTML; return it and a dict of pictures, name to (media type, bytes)."""
    pictures = {}

    def keep(tag, attribute, value):
        if attribute != "src":
            return value
        found = _picture(value)
        if found is None:
            return None
        name = hashlib.sha256(found[1]).hexdigest()[:32]
        pictures[name] = found
        return f"picture/{name}"

    kept = nh3.clean(
        html,
        tags=ELEMENTS,
        clean_content_tags=REMOVED,
        attributes=ATTRIBUTES,
        attribute_filter=keep,
        url_schemes={"data"},
        link_rel=None,
    )
    return kept, pictures


def _picture(address):
    """Return the media type and bytes of a picture, or None if the address is not a picture."""
    found = PICTURE.fullmatch(address.strip())
    if found is None or len(found[1]) > MAX_BYTES * 4 / 3:
        return None
    try:
        content = base64.b64decode(found[1], validate=False)
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(io.BytesIO(content), formats=list(KINDS)) as picture:
                width, height = picture.size
                kind = KINDS[picture.format]
                picture.verify()
    except (binascii.Error, OSError, ValueError, SyntaxError, Image.DecompressionBombWarning,
            Image.DecompressionBombError):  # fmt: skip
        return None
    return (kind, content) if width * height <= MAX_PIXELS else None
