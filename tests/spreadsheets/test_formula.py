"""Formulas as trees: operators group as spreadsheets group them, and what is unknown is refused."""

import pytest

from spreadsheets.formula import Area, Call, Name, Number, Text, Tree, UnsupportedError, parse


def spelled(tree: Tree) -> str:
    """A tree with every pair of parentheses written."""
    match tree:
        case Number(text):
            return text
        case Text(text):
            return f'"{text}"'
        case Name(name):
            return name
        case Area(sheet, first, last):
            return f"{sheet}!{first}{last}"
        case Call(function, (one, other)) if not function.isalpha():
            return f"({spelled(one)}{function}{spelled(other)})"
        case Call(function, arguments):
            return f"{function}[{';'.join(map(spelled, arguments))}]"


@pytest.mark.parametrize(
    ("formula", "meaning"),
    [
        ("=1-2-3", "((1-2)-3)"),
        ("=1/2*3", "((1/2)*3)"),
        ("=2^3^2", "((2^3)^2)"),
        ("=-2^2", "(-[2]^2)"),
        ("=1+2*3^4", "(1+(2*(3^4)))"),
        ("=(1 + 2) * 3", "((1+2)*3)"),
        ("=1&2+3=4", "((1&(2+3))=4)"),
        ("=a<=b", "(a<=b)"),
        ("=IF(rho_p<1E-3,PI(),-k_1)", "IF[(rho_p<1E-3);PI[];-[k_1]]"),
        ('="say ""no"""', '"say "no""'),
    ],
)
def test_operators_group(formula: str, meaning: str) -> None:
    assert spelled(parse(formula)) == meaning


@pytest.mark.parametrize(
    ("formula", "area"),
    [
        ("=B7", Area("", (7, 2), (7, 2))),
        ("=$AB$7:AC9", Area("", (7, 28), (9, 29))),
        ("=Inputs!C6", Area("Inputs", (6, 3), (6, 3))),
        ("='It''s β = 3'!A1:A$4", Area("It's β = 3", (1, 1), (4, 1))),
    ],
)
def test_areas(formula: str, area: Area) -> None:
    assert parse(formula) == area


@pytest.mark.parametrize(
    "formula", ["={1,2}", "=1%", "=A1 A2", "=(1", "=1+", "=SIN(1", "=#N/A", "="]
)
def test_what_is_not_known_is_refused(formula: str) -> None:
    with pytest.raises(UnsupportedError):
        parse(formula)
