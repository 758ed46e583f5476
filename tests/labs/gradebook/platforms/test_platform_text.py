"""A student's own words in Markdown and in plain text: they are shown, and do nothing."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from made_platform_grades import HOSTILE
from markdown_it import MarkdownIt
from markdown_it.token import Token

from labs.gradebook.platforms.lines import Paragraph
from labs.gradebook.platforms.text import markdown, unmarked
from labs.grading.safe_text import one_line

RENDERER = MarkdownIt("gfm-like", {"linkify": False})


def rendered(text: str) -> list[Token]:
    return RENDERER.parse(text)


@given(st.text() | st.text("`~#>-+*=1.)|[]()!<&$\\ \t\n"))
@pytest.mark.slow
def test_markdown_shows_a_students_words_in_a_block_and_nowhere_else(words):
    tokens = rendered(markdown([Paragraph("Before 1."), Paragraph(words, True), Paragraph("3. After")]))
    kinds = [token.type for token in tokens if not token.type.startswith("paragraph")]
    assert kinds == (["inline", "code_block", "inline"] if one_line(words) else ["inline", "inline"])


@given(st.text("`~#>-+*=1.)|[]()!<&$\\ a_", max_size=30).map(one_line))
def test_markdown_shows_our_own_words_as_they_are(words):
    texts = [each for token in rendered(markdown([Paragraph(words)])) for each in token.children or ()]
    assert {each.type for each in texts} <= {"text", "text_special"}
    assert "".join(each.content for each in texts) == words


@pytest.mark.parametrize("shown", [markdown, unmarked])
def test_no_hidden_character_is_left(shown):
    text = shown([Paragraph(HOSTILE, True), Paragraph(HOSTILE)])
    assert all(each.isprintable() for each in text.split("\n"))
    assert "␛[31m \\u202e" in text
