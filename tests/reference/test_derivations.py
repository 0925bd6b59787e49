"""The conditions on the printed equations hold, except that of Eq. 16; a misprint breaks them."""

from fractions import Fraction as F

import pytest

from reference.derivations import DERIVATIONS, Check, SymbolicEquations, derive, equal, premises_of
from reference.equations import Node
from reference.ledger import Ledger, load

LEDGER = load()


def checks_of(ledger: Ledger, equation: str) -> list[Check]:
    return [*derive(equation, ledger.sides, ledger.written)]


@pytest.mark.parametrize("equation", LEDGER.equations)
def test_a_printed_equation_follows_from_its_premises(equation: str) -> None:
    holds = all(check.holds for check in checks_of(LEDGER, equation))
    assert holds == (equation != "eq16")


def test_equation_16_is_half_of_what_equations_14_and_15_demand() -> None:
    slope, at_rest = checks_of(LEDGER, "eq16")
    assert (slope.holds, slope.factor) == (False, F(1, 2))
    assert (at_rest.holds, at_rest.factor) == (True, None)


def test_only_the_literature_may_stay_without_a_condition() -> None:
    without = [name for name in LEDGER.equations if name not in DERIVATIONS]
    assert [LEDGER.equations[name].kind for name in without] == ["taken over"]
    assert all(checks_of(LEDGER, name) for name in DERIVATIONS)
    assert LEDGER.equations.keys() >= DERIVATIONS.keys()


@pytest.mark.parametrize("equation", DERIVATIONS)
def test_a_derivation_uses_the_equations_that_it_names(equation: str) -> None:
    asked = set()

    class Asked(dict[str, tuple[Node, ...]]):
        def __getitem__(self, name: str) -> tuple[Node, ...]:
            asked.add(name)
            return LEDGER.sides[name]

    assert [*derive(equation, Asked(), LEDGER.written)]
    assert asked == {equation, *premises_of(equation)}


@pytest.mark.parametrize(
    ("constant", "text", "factor"),
    [
        pytest.param("eq2-factor", "2/3", F(2), id="twice the crater"),
        pytest.param("eq3-factor", "2/3", F(1, 2), id="half the sphere"),
        pytest.param("eq16-denominator", "1", None, id="Eq. 16 without its 2 is right"),
        pytest.param("eq11-power", "1/2", None, id="a square root for a cube root"),
    ],
)
def test_a_misprint_breaks_a_condition(constant: str, text: str, factor: F | None) -> None:
    equation = LEDGER.equation_of(constant)
    assert equation is not None
    checks = checks_of(LEDGER.misprint(constant, text), equation)
    assert all(check.holds for check in checks) == (constant == "eq16-denominator")
    assert [check.factor for check in checks if check.factor is not None] == [factor] * bool(factor)


@pytest.fixture
def symbolic() -> SymbolicEquations:
    return SymbolicEquations(LEDGER.sides, frozenset(LEDGER.written.values()))


def test_sides_slopes_and_numbers_of_an_equation(symbolic: SymbolicEquations) -> None:
    s = symbolic.symbols
    assert symbolic.left("eq6") == s.Sigma
    assert symbolic.right("eq6", v=0) == s.R_t
    assert symbolic.side("eq5", 1, u=s.v) == s.Y_p
    assert symbolic.slope("eq6", "v") == s.rho_t * s.v
    assert symbolic.slope("eq6", "Y_p") == 0
    assert symbolic.tried("eq1", m=4.0) == 0.5


def test_two_sides_may_differ_by_a_constant_factor(
    symbolic: SymbolicEquations,
) -> None:
    s = symbolic.symbols
    assert equal("equal", s.x + s.x, 2 * s.x) == Check("equal", holds=True)
    assert equal("three times", 3 * s.x, s.x) == Check("three times", holds=False, factor=F(3))
    assert equal("x times", s.x * s.R, s.R) == Check("x times", holds=False)
    assert equal("not zero", s.x, 0) == Check("not zero", holds=False)
