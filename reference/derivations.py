"""What each printed equation follows from, carried out exactly.

A check compares two quotients of polynomials, made from the equation as it is printed and from what
it must follow from: they are equal for all values of the symbols or they are not. To integrate, a
printed solution is differentiated and put in. Premises are geometry (a plane cuts a sphere),
Newton's law, Bernoulli's, and earlier equations of the report where it says that it uses them.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from reference.arithmetic import Dual, Duals, Floats, Number, Ratio, Ratios
from reference.equations import Node, evaluate

Sides = Mapping[str, tuple[Node, ...]]
"""The sides of every printed equation, by the equation's id."""


@dataclass(frozen=True, slots=True)
class Check:
    """One step of a derivation: what must hold, and whether it does.

    `factor` is the number by which the printed side differs from the derived one, where it is
    nothing but a number.
    """

    says: str
    holds: bool
    factor: Fraction | None = None


@dataclass(frozen=True, slots=True)
class _Printed:
    """A printed equation, its sides as quotients of polynomials in all symbols of the report."""

    number: str
    sides: Sides
    field: Ratios

    def __getitem__(self, symbol: str) -> Number:
        return self.field.symbols[symbol]

    def equation(self, number: str) -> "_Printed":
        return replace(self, number=number)

    def side(self, index: int = -1, **put: Number) -> Number:
        """A side, the last if no other is named, with something put in the place of symbols."""
        return evaluate(self.sides[self.number][index], self.field, self._with(put))

    def cubed(self) -> Number:
        """The last side to the third power, in which no third root is left."""
        power = Node("power", (self.sides[self.number][-1], Node("number", value=Fraction(3))))
        return evaluate(power, self.field, self.field.symbols)

    def slope(self, by: str, index: int = -1, **put: Number) -> Number:
        """The derivative of a side by one of its symbols."""
        duals = Duals(self.field)
        values = {name: Dual(ratio) for name, ratio in self._with(put).items()}
        values[by] = duals.variable(values[by].value, by)
        side = evaluate(self.sides[self.number][index], duals, values)
        return side.slopes.get(by, self.field.number(0))

    def _with(self, put: Mapping[str, Number]) -> dict[str, Ratio]:
        number = self.field.number
        known = {name: x if isinstance(x, Ratio) else number(x) for name, x in put.items()}
        return {**self.field.symbols, **known}

    def at(self, **numbers: float) -> float:
        """The last side as a number, its other symbols at 1."""
        values = {**dict.fromkeys(self.field.symbols, 1.0), **numbers}
        return float(evaluate(self.sides[self.number][-1], Floats(), values))

    def section(self, x: Ratio) -> Number:
        """Area of the circle in which a plane at depth x cuts a sphere: a^2 = R^2 - (R - x)^2."""
        return self.field.pi * (self["R"] ** 2 - (self["R"] - x) ** 2)

    @property
    def circle(self) -> Number:
        """Area of the contact circle."""
        return self.field.pi * self["a"] ** 2


def _whole_sphere(of: _Printed) -> Number:
    """The integral of the sections pi (2 R x - x^2) from 0 to 2 R."""
    return of.field.pi * (of["R"] * (2 * of["R"]) ** 2 - (2 * of["R"]) ** 3 / 3)


def _cavity(of: _Printed) -> Number:
    """c^3/a^3 of Hill's spherical cavity in an incompressible target.

    The elastic displacement at the edge c of the plastic zone is Y_t c / (2 E_t), and the volume
    pushed out, 3 c^2 times that, is the cavity's a^3.
    """
    return 1 / (3 * of["Y_t"] / (2 * of["E_t"]))


def _frank_zook_slope(of: _Printed) -> Number:
    """How the left side of Eq. 16 grows with the impact velocity by Eqs. 14 and 15.

    Both are linear: strength = steady + inertia dv/dt, dv/dt = -rod strength. By dx/dt = v an
    impact that is faster by dV goes deeper by dX = -V dV / acceleration.
    """
    strength, rod = of.equation("eq14"), of.equation("eq15")
    put: dict[str, Any] = {"v": of["V"], "D": 2 * of["R"]}
    steady = strength.side(**{**put, "dv/dt": 0})
    inertia, per_strength = strength.slope("dv/dt", **put), rod.side(**put, Y_p=1)
    acceleration = per_strength * steady / (1 - per_strength * inertia)
    return -(of["V"] / acceleration * of.side(0, **put) / of["X"])


Derivation = Sequence[tuple[str, Callable[[_Printed], bool | tuple[Number, Number]]]]
"""What is said, and whether it holds, or a printed and a derived expression that must be equal."""

_STRENGTH: Derivation = (
    ("it defines the target resistance", lambda of: (of.side(0), of["R_t"])),
    ("as beta times the flow stress", lambda of: (of.side(), of["beta"] * of["Y_t"])),
)
_CONTACT: Derivation = (
    ("the left side is the area of the contact circle", lambda of: (of.side(0), of.circle)),
    ("the right side is the section of the sphere at depth x, by Pythagoras",
     lambda of: (of.side(D=2 * of["R"]), of.section(of["x"]))),
)  # fmt: skip
DERIVATIONS: Mapping[str, Derivation] = {
    "eq1": (
        ("the left side is the velocity of the particle", lambda of: (of.side(0), of["V_p"])),
        ("a particle of average mass has the average velocity",
         lambda of: (of.side(m=of["m_o"]), of["V"])),
        ("a heavier particle is slower, as the report says", lambda of: of.at(m=2) < 1),
    ),
    "eq2": (
        ("the left side is the volume of the crater", lambda of: (of.side(0), of["CV"])),
        ("no depth, no volume", lambda of: (of.side(X=0), 0)),
        ("one more unit of depth adds the area of the section at that depth",
         lambda of: (of.slope("X"), of.section(of["X"]))),
    ),
    "eq3": (
        ("the left side is the volume of the particle", lambda of: (of.side(0), of["PV"])),
        ("the sections of the sphere add up to it", lambda of: (of.side(), _whole_sphere(of))),
    ),
    "eq5": (
        ("the left side is the stress", lambda of: (of.side(0), of["Sigma"])),
        ("a rigid particle, u = v, exerts its strength",
         lambda of: (of.side(1, u=of["v"]), of["Y_p"])),
        ("in the particle the stress rises by density times relative velocity",
         lambda of: (of.slope("v", 1), of["rho_p"] * (of["v"] - of["u"]))),
        ("a target at rest exerts its resistance", lambda of: (of.side(u=0), of["R_t"])),
        ("in the target the stress rises by density times velocity",
         lambda of: (of.slope("u"), of["rho_t"] * of["u"])),
    ),
    "eq6": (
        ("the left side is the stress", lambda of: (of.side(0), of["Sigma"])),
        ("the right side is that of Eq. 5 at u = v",
         lambda of: (of.side(), of.equation("eq5").side(u=of["v"]))),
    ),
    "eq7": _STRENGTH,
    "eq9": (
        ("the left side is the force", lambda of: (of.side(0), of["F_r"])),
        ("the force is the resistance times the area of a circle of radius a",
         lambda of: (of.side(), of["R_t"] * of.circle)),
    ),
    "eq10": (
        ("the left side is beta", lambda of: (of.side(0), of["beta"])),
        ("no plastic zone, alpha = 1, no pressure", lambda of: of.at() == 0),
        ("a wider plastic zone presses harder", lambda of: of.at(alpha=2) > 0),
    ),
    "eq11": (
        ("the left side is the extent of the plastic zone", lambda of: (of.side(0), of["alpha"])),
        ("its cube is c^3/a^3 of a spherical cavity in an incompressible target",
         lambda of: (of.cubed(), _cavity(of))),
    ),
    "eq12": _CONTACT,
    "diameter": (
        ("the left side is the diameter", lambda of: (of.side(0), of["D"])),
        ("a diameter is two radii", lambda of: (of.side(), 2 * of["R"])),
    ),
    "eq13-shallow": (
        ("mass times acceleration", lambda of: (of.side(0), of["m"] * of["dv/dt"])),
        ("is minus the stress of Eq. 6 times the area of Eq. 12",
         lambda of: (of.side(), -(of.equation("eq6").side() * of.equation("eq12").side()))),
    ),
    "eq13-deep": (
        ("is minus the stress of Eq. 6 times the section at x = R",
         lambda of: (of.side(), -(of.equation("eq6").side() * of.section(of["R"])))),
    ),
    "eq14": (
        ("the left side is the strength, Eq. 5's at u = v", lambda of: (of.side(0), of["Y_p"])),
        ("with k_t = 1/2 and k_1 = 0 the right side is that of Eq. 5",
         lambda of: (of.side(k_t=Fraction(1, 2), k_1=0), of.equation("eq5").side(u=of["v"]))),
        ("the unsteady term adds the inertia of a column of target",
         lambda of: (of.slope("k_1") / of["dv/dt"], of["rho_t"] * of["D"])),
    ),
    "eq15": (
        ("the left side is the acceleration", lambda of: (of.side(0), of["dv/dt"])),
        ("strength times section over the mass of a rod",
         lambda of: (of.side(), -of["Y_p"] / (of["rho_p"] * of["L"]))),  # the section cancels
    ),
    "eq16": (
        ("the depth grows with the impact velocity as Eqs. 14 and 15 demand",
         lambda of: (of.slope("V", v=of["V"], D=2 * of["R"]), _frank_zook_slope(of))),
        ("no impact, no depth", lambda of: of.at(V=0) == 0),
    ),
    "eqA-1": (
        ("stress times contact area", lambda of: (of.side(0), of["Sigma"] * of.circle)),
        ("is that of Eq. 6 times the same area",
         lambda of: (of.side(), of.equation("eq6").side(v=of["u"]) * of.circle)),
    ),
    "eqA-2": _STRENGTH,
    "eqA-3": _CONTACT,
}  # fmt: skip
"""The checks of each equation, by its id; Eq. 8 has none but that of its dimensions."""

PREMISES: Mapping[str, tuple[str, ...]] = {
    "eq6": ("eq5",),
    "eq13-shallow": ("eq6", "eq12"),
    "eq13-deep": ("eq6",),
    "eq14": ("eq5",),
    "eq16": ("eq14", "eq15"),
    "eqA-1": ("eq6",),
}
"""The printed equations that others are derived from."""


def derive(number: str, sides: Sides, symbols: Iterable[str]) -> Iterator[Check]:
    """Every check of one equation, given the sides of all and the symbols in them, one by one.

    Raises ZeroDivisionError, ValueError or EquationError where what is printed makes no sense
    there.
    """
    expected = {"eq5": 3, "eq13-deep": 1}.get(number, 2)
    if number in DERIVATIONS and len(sides[number]) != expected:
        raise ValueError(f"it has {len(sides[number])} sides, not {expected}")
    of = _Printed(number, sides, Ratios([symbol for symbol in symbols if symbol != "pi"]))
    for says, compare in DERIVATIONS.get(number, ()):
        compared = compare(of)
        if isinstance(compared, bool):
            yield Check(says, compared)
            continue
        printed, derived = compared
        holds = printed == derived
        factor = None if holds or derived == 0 else (printed / derived).constant
        yield Check(says, holds, factor)
