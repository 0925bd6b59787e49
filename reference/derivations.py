"""What each printed equation follows from, carried out exactly.

A check compares two quotients of polynomials, made from the equation as it is printed and from what
it must follow from: they are equal for all values of the symbols or they are not. To integrate, a
printed solution is differentiated and put in. Premises are geometry (a plane cuts a sphere),
Newton's law, Bernoulli's, and earlier equations of the report where it says that it uses them.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from reference.arithmetic import Dual, Duals, Ratio, Ratios, Reals
from reference.equations import Node, evaluate, symbols_in

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


class _Algebra:
    """Expressions of the report as quotients of polynomials in all their symbols."""

    def __init__(self, sides: Sides, names: tuple[str, ...]) -> None:
        self.sides = sides
        self.field = Ratios(names)

    def __getitem__(self, name: str) -> Ratio:
        return self.field.symbols[name]

    @property
    def pi(self) -> Ratio:
        return self.field.pi

    @cached_property
    def _duals(self) -> dict[str, Dual]:
        return {name: Dual(ratio) for name, ratio in self.field.symbols.items()}

    def value(self, node: Node, **put: Ratio | int) -> Ratio:
        """An expression, with something else put in the place of some of its symbols."""
        given = {name: self.field.number(0) + ratio for name, ratio in put.items()}
        value: Ratio = evaluate(node, self.field, {**self.field.symbols, **given})
        return value

    def slope(self, node: Node, by: str, **put: Ratio | int) -> Ratio:
        """The derivative of an expression by one of its symbols."""
        zero, duals = self.field.number(0), Duals(self.field)
        values = self._duals | {name: Dual(zero + ratio) for name, ratio in put.items()}
        values[by] = duals.variable(values[by].value, by)
        slope: Ratio = evaluate(node, duals, values).slopes.get(by, zero)
        return slope


def _equal(says: str, printed: Ratio, derived: Ratio | int) -> Check:
    if printed == derived:
        return Check(says, True)
    if derived == 0:
        return Check(says, False)
    return Check(says, False, (printed / derived).constant)


def _section(of: _Algebra, x: Ratio) -> Ratio:
    """Area of the circle in which a plane at depth x cuts a sphere: a^2 = R^2 - (R - x)^2."""
    radius = of["R"]
    return of.pi * (radius**2 - (radius - x) ** 2)


def _velocity_of_mass(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq1"]
    yield _equal("the left side is the velocity of the particle", of.value(left), of["V_p"])
    mean = of.value(right, m=of["m_o"])
    yield _equal("a particle of average mass has the average velocity", mean, of["V"])
    reals = Reals(15)
    numbers = {"V": reals.number(1), "m_o": reals.number(1), "m": reals.number(2)}
    heavy = evaluate(right, reals, numbers)
    yield Check("a heavier particle is slower, as the report says", bool(heavy < 1))


def _cap(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq2"]
    yield _equal("the left side is the volume of the crater", of.value(left), of["CV"])
    yield _equal("no depth, no volume", of.value(right, X=0), 0)
    says = "one more unit of depth adds the area of the section at that depth"
    yield _equal(says, of.slope(right, "X"), _section(of, of["X"]))


def _sphere(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq3"]
    yield _equal("the left side is the volume of the particle", of.value(left), of["PV"])
    # The integral of the sections pi (2 R x - x^2) from 0 to 2 R.
    whole = of.pi * (of["R"] * (2 * of["R"]) ** 2 - (2 * of["R"]) ** 3 / 3)
    yield _equal("the sections of the sphere add up to it", of.value(right), whole)


def _bernoulli(of: _Algebra) -> Iterator[Check]:
    stress, particle, target = of.sides["eq5"]
    v, u = of["v"], of["u"]
    yield _equal("the left side is the stress", of.value(stress), of["Sigma"])
    yield _equal("a rigid particle, u = v, exerts its strength", of.value(particle, u=v), of["Y_p"])
    says = "in the particle the stress rises by density times relative velocity"
    yield _equal(says, of.slope(particle, "v"), of["rho_p"] * (v - u))
    yield _equal("a target at rest exerts its resistance", of.value(target, u=0), of["R_t"])
    says = "in the target the stress rises by density times velocity"
    yield _equal(says, of.slope(target, "u"), of["rho_t"] * u)


def _rigid(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq6"]
    yield _equal("the left side is the stress", of.value(left), of["Sigma"])
    target = of.value(of.sides["eq5"][-1], u=of["v"])
    yield _equal("the right side is that of Eq. 5 at u = v", of.value(right), target)


def _product_of_strength(number: str) -> Callable[[_Algebra], Iterator[Check]]:
    def checks(of: _Algebra) -> Iterator[Check]:
        left, right = of.sides[number]
        yield _equal("it defines the target resistance", of.value(left), of["R_t"])
        yield _equal("as beta times the flow stress", of.value(right), of["beta"] * of["Y_t"])

    return checks


def _force_of_contact(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq9"]
    yield _equal("the left side is the force", of.value(left), of["F_r"])
    circle = of.pi * of["a"] ** 2
    says = "the force is the resistance times the area of a circle of radius a"
    yield _equal(says, of.value(right), of["R_t"] * circle)


def _plastic_zone_pressure(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq10"]
    yield _equal("the left side is beta", of.value(left), of["beta"])
    reals = Reals(15)
    none, wide = (evaluate(right, reals, {"alpha": reals.number(n)}) for n in (1, 2))
    yield Check("no plastic zone, alpha = 1, no pressure", bool(none == 0))
    yield Check("a wider plastic zone presses harder", bool(wide > 0))


def _plastic_zone(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq11"]
    yield _equal("the left side is the extent of the plastic zone", of.value(left), of["alpha"])
    # Hill's spherical cavity, incompressible: the elastic displacement at the edge c of the plastic
    # zone is Y_t c / (2 E_t), and the volume pushed out, 3 c^2 times that, is the cavity's a^3.
    modulus, stress = of["E_t"], of["Y_t"]
    cubed = Node("power", (right, Node("number", value=Fraction(3))))
    shift = stress / (2 * modulus)
    says = "its cube is c^3/a^3 of a spherical cavity in an incompressible target"
    yield _equal(says, of.value(cubed), 1 / (3 * shift))


def _contact_area(number: str) -> Callable[[_Algebra], Iterator[Check]]:
    def checks(of: _Algebra) -> Iterator[Check]:
        left, right = of.sides[number]
        circle = of.pi * of["a"] ** 2
        yield _equal("the left side is the area of the contact circle", of.value(left), circle)
        printed = of.value(right, D=2 * of["R"])
        says = "the right side is the section of the sphere at depth x, by Pythagoras"
        yield _equal(says, printed, _section(of, of["x"]))

    return checks


def _diameter(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["diameter"]
    yield _equal("the left side is the diameter", of.value(left), of["D"])
    yield _equal("a diameter is two radii", of.value(right), 2 * of["R"])


def _newton_shallow(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq13-shallow"]
    yield _equal("mass times acceleration", of.value(left), of["m"] * of["dv/dt"])
    stress, area = of.value(of.sides["eq6"][1]), of.value(of.sides["eq12"][1])
    yield _equal("is minus the stress of Eq. 6 times the area of Eq. 12",
                 of.value(right), -(stress * area))  # fmt: skip


def _newton_deep(of: _Algebra) -> Iterator[Check]:
    (right,) = of.sides["eq13-deep"]
    area = _section(of, of["R"])
    yield _equal("is minus the stress of Eq. 6 times the section at x = R",
                 of.value(right), -(of.value(of.sides["eq6"][1]) * area))  # fmt: skip


def _frank_zook_stress(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq14"]
    yield _equal("the left side is the strength, Eq. 5's at u = v", of.value(left), of["Y_p"])
    target = of.value(of.sides["eq5"][-1], u=of["v"])
    half = of.field.number(Fraction(1, 2))
    steady = of.value(right, k_t=half, k_1=0)
    yield _equal("with k_t = 1/2 and k_1 = 0 the right side is that of Eq. 5", steady, target)
    slope = of.slope(right, "k_1") / of["dv/dt"]
    says = "the unsteady term adds the inertia of a column of target"
    yield _equal(says, slope, of["rho_t"] * of["D"])


def _rod(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq15"]
    yield _equal("the left side is the acceleration", of.value(left), of["dv/dt"])
    area = of.pi * of["D"] ** 2 / 4
    newton = -(of["Y_p"] * area) / (of["rho_p"] * area * of["L"])
    yield _equal("strength times section over the mass of a rod", of.value(right), newton)


def _frank_zook_depth(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eq16"]
    strength, rod = of.sides["eq14"][1], of.sides["eq15"][1]
    put: dict[str, Ratio | int] = {"v": of["V"], "D": 2 * of["R"]}
    # Both equations are linear: strength = steady + inertia dv/dt, dv/dt = -rod strength.
    steady = of.value(strength, **{**put, "dv/dt": 0})
    inertia, per_strength = of.slope(strength, "dv/dt", **put), of.value(rod, **put, Y_p=1)
    acceleration = per_strength * steady / (1 - per_strength * inertia)
    # By dx/dt = v an impact that is faster by dV goes deeper by dX = -V dV / acceleration.
    scale = of.value(left, **put) / of["X"]
    says = "the depth grows with the impact velocity as Eqs. 14 and 15 demand"
    yield _equal(says, of.slope(right, "V", **put), -(of["V"] / acceleration * scale))
    reals = Reals(15)
    ones = {name: reals.number(name != "V") for name in symbols_in(right)}
    yield Check("no impact, no depth", bool(evaluate(right, reals, ones) == 0))


def _force_law(of: _Algebra) -> Iterator[Check]:
    left, right = of.sides["eqA-1"]
    circle = of.pi * of["a"] ** 2
    yield _equal("stress times contact area", of.value(left), of["Sigma"] * circle)
    stress = of.value(of.sides["eq6"][1], v=of["u"])
    yield _equal("is that of Eq. 6 times the same area", of.value(right), stress * circle)


DERIVATIONS: Mapping[str, Callable[[_Algebra], Iterator[Check]]] = {
    "eq1": _velocity_of_mass,
    "eq2": _cap,
    "eq3": _sphere,
    "eq5": _bernoulli,
    "eq6": _rigid,
    "eq7": _product_of_strength("eq7"),
    "eq9": _force_of_contact,
    "eq10": _plastic_zone_pressure,
    "eq11": _plastic_zone,
    "eq12": _contact_area("eq12"),
    "diameter": _diameter,
    "eq13-shallow": _newton_shallow,
    "eq13-deep": _newton_deep,
    "eq14": _frank_zook_stress,
    "eq15": _rod,
    "eq16": _frank_zook_depth,
    "eqA-1": _force_law,
    "eqA-2": _product_of_strength("eqA-2"),
    "eqA-3": _contact_area("eqA-3"),
}
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

    Raises ZeroDivisionError or EquationError where what is printed makes no sense there.
    """
    if number in DERIVATIONS:
        yield from DERIVATIONS[number](_Algebra(sides, tuple(s for s in symbols if s != "pi")))
