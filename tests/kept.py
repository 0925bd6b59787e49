r"""Questions with kept answers, in texts that a person reads: `question -> answer`, a line each.

They stand beside the tests in sections, headed `# What`; many are what Python says to a line of it,
which knows the names that the test gives. `⟨5000 x⟩` is an x five thousand times,
and `⟨\x1b⟩` a character that no text shows.
Whoever changes an answer of the program changes it there.
"""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest


def pairs(text: str, section: str) -> list[tuple[str, str]]:
    """The questions of a section, such as of `reference/kept.txt`, each with its answer."""
    content = (Path(__file__).parent / text).read_text("utf-8")
    lines = content.partition(f"\n# {section}\n")[2].partition("\n# ")[0].splitlines()
    asked = [line.partition(" -> ") for line in lines if " -> " in line]
    assert asked, f"{text} has no section {section!r}"
    return [(spelled(question.strip()), answer) for question, _, answer in asked]


def kept(text: str, section: str) -> pytest.MarkDecorator:
    """Give a test each question of a section, and its answer."""
    cases = [pytest.param(*pair, id=pair[0][:40]) for pair in pairs(text, section)]
    return pytest.mark.parametrize(("question", "answer"), cases)


def calls(text: str, section: str, names: Mapping[str, Any]) -> Callable[[str, str], None]:
    """A test that Python says the answers of a section, in which it knows these names."""

    @kept(text, section)
    def test(question: str, answer: str) -> None:
        assert said(lambda: eval(question, dict(names))) == answer

    return test


def spelled(text: str) -> str:
    """A text with what stands in it many times, and no quotes around what begins with a blank."""

    def written_out(many: re.Match[str]) -> str:
        plain = many[2].encode("ascii", "backslashreplace").decode("unicode_escape")
        return int(many[1] or 1) * plain

    text = re.sub(r"⟨(?:(\d+) )?(.*?)⟩", written_out, text)
    return text[1:-1] if re.fullmatch('".*"', text) else text


def said(answer: Callable[[], object]) -> str:
    """An answer as text; or the one line that refuses to give it."""
    try:
        return str(answer())
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:
        return f"refused: {error}"
