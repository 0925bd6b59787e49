r"""Read kept questions and answers: lines `question -> answer` in texts that a person can read.

Each folder of tests has such a text, in sections headed `# Title`. In many sections a question is a
line of Python, which uses the names that the test provides, and the answer is its result.
`⟨5000 x⟩` stands for 5000 letters x, and `⟨\x1b⟩` for an invisible character.
If the program's answer changes on purpose, change it there.
"""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest


def pairs(text: str, section: str) -> list[tuple[str, str]]:
    """Return the questions of a section, each with its answer; `text` is a path in `tests/`."""
    content = (Path(__file__).parent / text).read_text("utf-8")
    lines = content.partition(f"\n# {section}\n")[2].partition("\n# ")[0].splitlines()
    parts = [line.partition(" -> ") for line in lines if " -> " in line]
    assert parts, f"{text} has no section {section!r}"
    return [(spelled(question.strip()), answer) for question, _, answer in parts]


def kept(text: str, section: str) -> pytest.MarkDecorator:
    """Parametrize a test with the questions of a section and their answers."""
    cases = [pytest.param(*pair, id=pair[0][:40]) for pair in pairs(text, section)]
    return pytest.mark.parametrize(("question", "answer"), cases)


def calls(text: str, section: str, names: Mapping[str, Any]) -> Callable[[str, str], None]:
    """Return a test that evaluates each question of a section as Python, with these names."""

    @kept(text, section)
    def test(question: str, answer: str) -> None:
        assert said(lambda: eval(question, dict(names))) == answer

    return test


def spelled(text: str) -> str:
    """Expand ⟨5000 x⟩ and ⟨\\x1b⟩, and remove the quotes that protect blanks at the ends."""

    def written_out(many: re.Match[str]) -> str:
        plain = many[2].encode("ascii", "backslashreplace").decode("unicode_escape")
        return int(many[1] or 1) * plain

    text = re.sub(r"⟨(?:(\d+) )?(.*?)⟩", written_out, text)
    return text[1:-1] if re.fullmatch('".*"', text) else text


def said(answer: Callable[[], object]) -> str:
    """Return an answer as text, or "refused" with the message of the error that it raises."""
    try:
        return str(answer())
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:
        return f"refused: {error}"
