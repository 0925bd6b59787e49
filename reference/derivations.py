"""The derivations: the conditions under which each printed equation follows from its premises.

Premises are geometry (a plane cuts a sphere), Newton's and Bernoulli's laws, and earlier equations
of the report where it says that it uses them. A condition compares a printed side with what must
follow. Both are quotients of polynomials, and they are equal for all values of the symbols or they
are not. An integration is checked by differentiating the printed solution.

One function derives one equation: it yields a `Check` for each condition. `eq` has the printed
equations, and `s` the report's symbols as its attributes.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import msgspec

from reference.arithmetic import Dual, Duals, Floats, RationalFunction, RationalFunctions
from reference.equations import Sides, evaluate

Symbols = Any
"""A namespace: `s.rho_t` is the symbol rho_t, a rational function."""


class Check(msgspec.Struct, frozen=True):
    """The outcome of one condition of a derivation: what must hold, and whether it does.

    `factor` is the printed over the derived side where they differ by a constant number. With
    `quotes` the condition is the law itself that the equation quotes: it tells a misprint, and
    derives nothing.
    """

    says: str
    holds: bool
    factor: Fraction | None = None
    quotes: bool = False


def equal(
    says: str, printed: RationalFunction, derived: RationalFunction | int, *, quotes: bool = False
) -> Check:
    """Check that a printed side equals a derived one for all values of the symbols."""
    holds = bool(printed == derived)
    factor = None if holds or derived == 0 else RationalFunctions.constant(printed / derived)
    return Check(says, holds, factor, quotes)


class SymbolicEquations:
    """The printed equations over rational functions of the report's symbols."""

    def __init__(self, sides: Sides, names: frozenset[str]) -> None:
        self.ar, self._sides = RationalFunctions(sorted(names - {"pi"})), sides
        self.symbols: Symbols = SimpleNamespace(**self.ar.symbols, pi=self.ar.pi)

    def left(self, equation: str, **put: RationalFunction | int) -> RationalFunction:
        """Return the first side of an equation, in which `put` replaces symbols."""
        return self.side(equation, 0, **put)

    def right(self, equation: str, **put: RationalFunction | int) -> RationalFunction:
        """Return the last side of an equation, in which `put` replaces symbols."""
        return self.side(equation, -1, **put)

    def side(self, equation: str, index: int, **put: RationalFunction | int) -> RationalFunction:
        """Return a side of an equation, in which `put` replaces symbols."""
        side = self._sides[equation][index]
        result: RationalFunction = evaluate(side, self.ar, {**self.ar.symbols, **put})
        return result

    def slope(
        self, equation: str, by: str, index: int = -1, **put: RationalFunction
    ) -> RationalFunction:
        """Return the derivative of a side by a symbol, after `put` replaces others in it."""
        duals, values = Duals(self.ar), {**self.ar.symbols, **put}
        numbers = {name: Dual(value) for name, value in values.items()}
        numbers[by] = duals.variable(values[by], by)
        side = evaluate(self._sides[equation][index], duals, numbers)
        result: RationalFunction = side.slopes.get(by, self.ar.number(0))
        return result

    def tried(self, equation: str, **put: float) -> float:
        """Return the last side in doubles, with every symbol at 1 that is not put in."""
        values = {**dict.fromkeys(self.ar.symbols, 1.0), **put}
        return float(evaluate(self._sides[equation][-1], Floats(), values))


Conditions = Callable[[SymbolicEquations, Symbols], Iterator[Check]]


@dataclass(frozen=True)
class Derivation:
    """The conditions on an equation, and the ids of the other equations that it follows from."""

    conditions: Conditions
    premises: tuple[str, ...]


DERIVATIONS: dict[str, Derivation] = {}
"""The derivations by the id of their equation. Of Eq. 8 only the dimensions can be checked."""


def derivation(equation: str, *premises: str) -> Callable[[Conditions], Conditions]:
    """Enter a function into DERIVATIONS, under the id of its equation and with its premises."""

    def enter(conditions: Conditions) -> Conditions:
        DERIVATIONS[equation] = Derivation(conditions, premises)
        return conditions

    return enter


def derive(equation: str, sides: Sides, written: Mapping[str, str]) -> Iterator[Check]:
    """Yield the outcome of every condition on an equation, given the sides of all equations.

    `written` maps the texts of the report's symbols to their names. Raises ZeroDivisionError,
    ValueError or EquationError if a printed side is no quotient of polynomials.
    """
    if equation in DERIVATIONS:
        printed = SymbolicEquations(sides, frozenset(written.values()))
        yield from DERIVATIONS[equation].conditions(printed, printed.symbols)


def premises_of(equation: str) -> tuple[str, ...]:
    """Return the ids of the other equations that an equation is derived from.

    >>> premises_of("eq16"), premises_of("eq8")
    (('eq14', 'eq15'), ())
    """
    return DERIVATIONS[equation].premises if equation in DERIVATIONS else ()


def derived_from(equation: str) -> set[str]:
    """Return the ids of the equations that are checked with an equation: it and those it is for.

    A derivation reads its premises as printed, so what they in turn follow from has no part in it.

    >>> sorted(derived_from("eq14"))
    ['eq14', 'eq16']
    """
    return {equation, *(name for name in DERIVATIONS if equation in premises_of(name))}


# The derivations, in the order of the report


@derivation("eq1")
def velocity_by_mass(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """It is taken over: only its limits and signs can be checked."""
    yield equal("the left side is the velocity of the particle", eq.left("eq1"), s.V_p)
    says = "a particle of average mass has the average velocity"
    yield equal(says, eq.right("eq1", m=s.m_o), s.V)
    says = "a heavier particle is slower, as the report says"
    yield Check(says, eq.tried("eq1", m=2.0) < 1)


@derivation("eq2")
def crater_volume(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """The sections of a sphere add up to the volume, from its surface to the depth X."""
    yield equal("the left side is the volume of the crater", eq.left("eq2"), s.CV)
    yield equal("no depth, no volume", eq.right("eq2", X=0), 0)
    says = "one more unit of depth adds the area of the section at that depth"
    yield equal(says, eq.slope("eq2", "X"), s.pi * (s.R**2 - (s.R - s.X) ** 2))


@derivation("eq3")
def particle_volume(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """The sections pi (2 R x - x^2) are integrated from 0 to 2 R."""
    yield equal("the left side is the volume of the particle", eq.left("eq3"), s.PV)
    says = "the sections of the sphere add up to it"
    yield equal(says, eq.right("eq3"), s.pi * (s.R * (2 * s.R) ** 2 - (2 * s.R) ** 3 / 3))


@derivation("eq5")
def stress_on_the_centerline(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Bernoulli's law as Tate modified it, in the particle (in the middle) and in the target."""
    yield equal("the left side is the stress", eq.left("eq5"), s.Sigma)
    yield equal("a rigid particle, u = v, exerts its strength", eq.side("eq5", 1, u=s.v), s.Y_p)
    says = (
        "in the particle the slope of the stress over v is the density times the relative velocity"
    )
    yield equal(says, eq.slope("eq5", "v", 1), s.rho_p * (s.v - s.u), quotes=True)
    yield equal("a target at rest exerts its resistance", eq.right("eq5", u=0), s.R_t)
    says = "in the target its slope over u is the density times the velocity"
    yield equal(says, eq.slope("eq5", "u"), s.rho_t * s.u, quotes=True)


@derivation("eq6", "eq5")
def stress_on_a_rigid_particle(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """It is Eq. 5 where the particle does not shorten."""
    yield equal("the left side is the stress", eq.left("eq6"), s.Sigma)
    says = "the right side is that of Eq. 5 at u = v"
    yield equal(says, eq.right("eq6"), eq.right("eq5", u=s.v))


@derivation("eq7")
def definition_of_beta(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """It defines beta."""
    yield from _target_resistance("eq7", eq, s)


def _target_resistance(equation: str, eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """The report prints this equation twice."""
    yield equal("it defines the target resistance", eq.left(equation), s.R_t)
    yield equal("as beta times the flow stress", eq.right(equation), s.beta * s.Y_t)


@derivation("eq9")
def retarding_force(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Stress times contact area."""
    yield equal("the left side is the force", eq.left("eq9"), s.F_r)
    says = "the force is the resistance times the area of a circle of radius a"
    yield equal(says, eq.right("eq9"), s.R_t * s.pi * s.a**2)


@derivation("eq10")
def beta_by_walker_and_anderson(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """It is taken over: only its limits and signs can be checked."""
    yield equal("the left side is beta", eq.left("eq10"), s.beta)
    yield equal("no plastic zone, alpha = 1, no pressure", eq.right("eq10", alpha=1), 0)
    yield Check("a wider plastic zone presses harder", eq.tried("eq10", alpha=2.0) > 0)


@derivation("eq11")
def extent_of_the_plastic_zone(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """A spherical cavity of radius a has a plastic zone that reaches to the radius c (Hill)."""
    yield equal("the left side is the extent of the plastic zone", eq.left("eq11"), s.alpha)
    # The elastic displacement at the edge c of the plastic zone is Y_t c / (2 E_t), and the volume
    # pushed out, 3 c^2 times that, is the cavity's a^3.
    a_over_c_cubed = 3 * s.Y_t / (2 * s.E_t)
    says = "its cube is c^3/a^3 of a spherical cavity in an incompressible target"
    yield equal(says, eq.right("eq11"), eq.ar.power(1 / a_over_c_cubed, Fraction(1, 3)))


@derivation("eq12")
def contact_area(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Pythagoras, in the section of a sphere at depth x."""
    yield from _contact_area("eq12", eq, s)


def _contact_area(equation: str, eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """The report prints this equation twice."""
    says = "the left side is the area of the contact circle"
    yield equal(says, eq.left(equation), s.pi * s.a**2)
    says = "the right side is the section of the sphere at depth x, by Pythagoras"
    yield equal(says, eq.right(equation, D=2 * s.R), s.pi * (s.R**2 - (s.R - s.x) ** 2))


@derivation("diameter")
def diameter(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Geometry."""
    yield equal("the left side is the diameter", eq.left("diameter"), s.D)
    yield equal("a diameter is two radii", eq.right("diameter"), 2 * s.R)


@derivation("eq13-shallow", "eq6", "eq12")
def motion_in_the_shallow_part(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Newton's law, as long as x < R."""
    yield equal("mass times acceleration", eq.left("eq13-shallow"), s.m * s.dv_dt)
    says = "is minus the stress of Eq. 6 times the area of Eq. 12"
    yield equal(says, eq.right("eq13-shallow"), -eq.right("eq6") * eq.right("eq12"))


@derivation("eq13-deep", "eq6")
def motion_in_the_deep_part(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Newton's law, once x > R; the report omits the left side."""
    says = "is minus the stress of Eq. 6 times the section at x = R"
    yield equal(says, eq.right("eq13-deep"), -eq.right("eq6") * s.pi * s.R**2)


@derivation("eq14", "eq5")
def stress_by_frank_and_zook(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """It is taken over: its limit is Eq. 5, its unsteady term an inertia."""
    says = "the left side is the strength, Eq. 5's at u = v"
    yield equal(says, eq.left("eq14"), s.Y_p)
    says = "with k_t = 1/2 and k_1 = 0 the right side is that of Eq. 5"
    half = eq.ar.number(Fraction(1, 2))
    yield equal(says, eq.right("eq14", k_t=half, k_1=0), eq.right("eq5", u=s.v))
    says = "the unsteady term adds the inertia of a column of target"
    yield equal(says, eq.slope("eq14", "k_1"), s.rho_t * s.D * s.dv_dt)


@derivation("eq15")
def deceleration_of_a_rod(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Newton's law for a rod of length L; its section cancels."""
    yield equal("the left side is the acceleration", eq.left("eq15"), s.dv_dt)
    says = "strength times section over the mass of a rod"
    yield equal(says, eq.right("eq15"), -s.Y_p / (s.rho_p * s.L))


@derivation("eq16", "eq14", "eq15")
def depth_by_frank_and_zook(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Eqs. 14 and 15 are linear: strength = steady + inertia dv/dt, and dv/dt = rod strength.

    By dx/dt = v an impact that is faster by dV goes deeper by dX = -V dV / acceleration.
    """
    at_impact = {"v": s.V, "D": 2 * s.R}
    steady = eq.right("eq14", **at_impact, dv_dt=0)
    inertia = eq.slope("eq14", "dv_dt", **at_impact)
    rod = eq.right("eq15", **at_impact, Y_p=1)
    acceleration = rod * steady / (1 - rod * inertia)
    depth_over_x = eq.left("eq16", D=2 * s.R) / s.X  # 1/R, for the printed left side X/R
    says = "the depth grows with the impact velocity as Eqs. 14 and 15 demand"
    yield equal(says, eq.slope("eq16", "V", **at_impact), -s.V / acceleration * depth_over_x)
    yield equal("no impact, no depth", eq.right("eq16", V=0), 0)


@derivation("eqA-1", "eq6")
def force_law(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Eq. 6 times the contact area."""
    yield equal("stress times contact area", eq.left("eqA-1"), s.Sigma * s.pi * s.a**2)
    says = "is that of Eq. 6 times the same area"
    yield equal(says, eq.right("eqA-1"), eq.right("eq6", v=s.u) * s.pi * s.a**2)


@derivation("eqA-2")
def target_resistance_again(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Eq. 7, printed again."""
    yield from _target_resistance("eqA-2", eq, s)


@derivation("eqA-3")
def contact_area_again(eq: SymbolicEquations, s: Symbols) -> Iterator[Check]:
    """Eq. 12, printed again."""
    yield from _contact_area("eqA-3", eq, s)
