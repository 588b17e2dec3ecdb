"""Sanitising of slides: text, formulas and pictures are kept; scripts and addresses are removed."""

import base64
import io
import re
from html.parser import HTMLParser

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from classroom.audience.sanitising import ATTRIBUTES, ELEMENTS, clean


def data(kind="PNG", size=(3, 2)):
    """A picture as a data address."""
    written = io.BytesIO()
    Image.new("RGB", size, "red").save(written, kind)
    return f"data:image/{kind.lower()};base64,{base64.b64encode(written.getvalue()).decode()}"


class Found(HTMLParser):
    """The elements and attributes of HTML."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.attributes = [], []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes += [(tag, name, value) for name, value in attributes]

    def handle_comment(self, _):
        self.tags.append("comment")

    handle_decl = handle_pi = unknown_decl = handle_comment


def assert_harmless(html):
    """Only listed elements and attributes; no address but of an own picture."""
    found = Found(html)
    assert set(found.tags) <= ELEMENTS
    for tag, name, value in found.attributes:
        assert name in ATTRIBUTES.get(tag, ()), (tag, name)
        assert not name.startswith("on")
        if name == "src":
            assert re.fullmatch(r"picture/[0-9a-f]{32}", value)


WORDS = """
    script style img math mtext mglyph malignmark annotation-xml svg foreignObject template
    iframe a form input base link meta object embed table td p noscript textarea title select
    option xmp plaintext frameset marquee video audio source picture use animate set desc mi mo
    details isindex
"""
NAMES = """
    src href xlink:href onerror onload onclick ontoggle style srcdoc srcset action formaction
    background poster ping class id name alt encoding data content http-equiv dynsrc lowsrc
    definitionURL altimg actiontype display
"""
VALUES = """
    javascript:alert(1) &#106;avascript:alert(1) http://evil.example/x.png //evil.example
    data:text/html,<script>alert(1)</script> data:image/png;base64,AAAA picture/../x text/html
    blob:x url(http://evil.example)
"""
ODD_VALUES = [
    "data:image/svg+xml,<svg onload=alert(1)>",
    "JaVa\tScRiPt:alert(1)",
    "'\"><img src=x onerror=alert(1)>",
    data(),
    "\x00",
]
attribute = st.builds(
    lambda name, quote, value: f" {name}={quote}{value}{quote}",
    st.sampled_from(NAMES.split()),
    st.sampled_from(['"', "'", ""]),
    st.sampled_from([*VALUES.split(), *ODD_VALUES]),
)
piece = st.one_of(
    st.builds(
        lambda word, given, end: f"<{word}{''.join(given)}{end}",
        st.sampled_from(WORDS.split()),
        st.lists(attribute, max_size=3),
        st.sampled_from([">", "/>", " >", "", "\n>"]),
    ),
    st.sampled_from(WORDS.split()).map("</{}>".format),
    st.sampled_from(["<!--", "-->", "--!>", "<![CDATA[", "]]>", "&lt;script&gt;", "\x00"]),
    st.sampled_from(["<!doctype html>", "<?x ?>"]),
    st.text(max_size=8),
)
slides = st.lists(piece, max_size=25).map("".join)


@given(slides)
def test_no_script_event_or_external_address_remains(html):
    kept, pictures = clean(html)
    assert_harmless(kept)
    assert {src[8:] for _, name, src in Found(kept).attributes if name == "src"} <= set(pictures)


@given(slides)
def test_sanitising_twice_changes_nothing(html):
    """The sanitised HTML is parsed again as it was checked."""
    kept = re.sub(r'src="[^"]*"', "", clean(html)[0])
    assert re.sub(r'src="[^"]*"', "", clean(kept)[0]) == kept


@pytest.mark.parametrize(
    "word", ["script", "style", "iframe", "object", "template", "noscript", "annotation"]
)
def test_forbidden_elements_are_removed_with_their_content(word):
    assert "inside" not in clean(f"<p>a</p><{word}>inside</{word}><p>b</p>")[0].replace("\n", "")


def test_text_formulas_tables_and_code_stay():
    html = (
        "<h2>Odometry</h2>"
        "<p>Angle <math><msub><mi>θ</mi><mi>t</mi></msub><mo>+</mo><mn>1</mn></math></p>"
        "<ul><li>one</li></ul><table><tbody><tr><td>2</td></tr></tbody></table>"
        "<pre><code>x &lt; 1</code></pre>"
    )
    assert clean(html) == (html, {})


@pytest.mark.parametrize(
    ("kind", "media"), [("PNG", "image/png"), ("JPEG", "image/jpeg"), ("GIF", "image/gif")]
)
def test_a_picture_gets_an_address_on_the_server(kind, media):
    kept, pictures = clean(f'<img alt="A map." src="{data(kind)}">')
    ((name, (found, content)),) = pictures.items()
    assert (found, Image.open(io.BytesIO(content)).size) == (media, (3, 2))
    assert Found(kept).attributes == [("img", "alt", "A map."), ("img", "src", f"picture/{name}")]


BAD = [
    "data:image/png;base64,AAAA",
    "data:image/svg+xml;base64,PHN2Zy8+",
    data("BMP").replace("bmp", "png"),
    data()[:-30],
    "data:image/png;base64,",
    "picture/" + "0" * 32,
    "data:image/png;base64," + "A" * 4_000_000,
    data(size=(5000, 5000)),
]


@pytest.mark.parametrize("address", BAD, ids=lambda address: address[:30])
def test_an_invalid_picture_is_removed(address):
    kept, pictures = clean(f'<p>a<img alt="x" src="{address}"></p>')
    assert pictures == {}
    assert "src" not in kept
    assert_harmless(kept)
