"""Contents of files with some of their bytes, words or lines changed, doubled, moved or lost."""

from hypothesis import strategies as st


@st.composite
def mutated(draw, content, scraps=(b"\0", b"nan")):
    """Strategy of contents (bytes) with one to six changes; ``scraps`` may be put anywhere."""
    out = bytearray(content)
    scrap = st.sampled_from(scraps) | st.binary(max_size=8)
    for _ in range(draw(st.integers(1, 6))):
        at = draw(st.integers(0, len(out)))
        end = min(len(out), at + draw(st.sampled_from([0, 1, 2, 8, 60, 5000, 10**6])))
        what = draw(st.sampled_from(["cut", "put", "copy", "word", "flip"]))
        if what == "cut":
            del out[at:end]
        elif what == "put":
            out[at:at] = draw(scrap)
        elif what == "copy":
            to = draw(st.integers(0, len(out)))
            out[to:to] = out[at : min(end, at + 5000)]
        elif what == "word":  # a number becomes a wild one
            start = out.rfind(b" ", 0, at) + 1
            stop = out.find(b" ", at)
            out[start : len(out) if stop < 0 else stop] = draw(scrap)
        elif at < len(out):
            out[at] ^= draw(st.integers(1, 255))
    return bytes(out)
