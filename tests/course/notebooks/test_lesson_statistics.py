"""Statistics of the lessons count what a reader sees."""

from course import lesson_statistics
from course.source import read

LESSON = """# %% [markdown] minutes=7
# # 01 · A lesson
#
# Two words, then $a = \\\\frac{b}{c}$ and `code` and {= value:.1f =} more.

# %% [markdown] slideshow={"slide_type": "notes"}
# The lecturer's words are not counted.

# %%
ask("01-why", "Why?", right=1, tolerance=0.1, unit="m", reason="so", wrong={})

# %%
a = 1

views.explore(draw, "alt", play="k", k=(0, 3, 1), wide=True)
live.watch(source, make, "alt")

# %% [markdown] minutes=5
# ## Deeper: for who wants more
#
# These words are optional, and so are these minutes.
"""


def test_a_row_counts_minutes_words_code_controls_and_questions(tmp_path):
    folder = tmp_path / "lessons"
    folder.mkdir()
    path = folder / "01_a_lesson.py"
    path.write_text(LESSON, encoding="utf-8")
    # "lesson"; two, words, then, and, and, more; controls: k, wide and the live view
    assert lesson_statistics.row(read(path), 12.34) == ("01", 7, 7, 3, 3, 1, "12.3")
