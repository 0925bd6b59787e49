"""Findings on the target's resistance and on the strengths that it comes from (section 3)."""

from fractions import Fraction
from math import cbrt, expm1, log, sqrt

from reference.units import to_si
from replication.audit.findings.evidence import calculated, concerning, conclude, prints, proves
from replication.audit.inference import DENSITY
from replication.audit.record import Finding
from replication.audit.results import Results, case, constant_pressure_ratio, exact_ratio
from replication.text import number


def resistances(results: Results) -> dict[int, Fraction]:
    """R_t = beta Y_t [Pa] for the two beta of the report's model (Eq. 7)."""
    Y_t = results.exact("flow-stress")
    return {beta: results.exact(f"depth-beta-{beta}-beta") * Y_t for beta in (3, 5)}


def impact_pressure(results: Results) -> Fraction:
    """rho_t V^2/2 [Pa] at the impact."""
    return results.exact(DENSITY) * results.exact("a1-initial-velocity") ** 2 / 2


@concerning(
    "walker-anderson-beta",
    "walker-anderson-alpha",
    "yield-strength",
    "flow-stress",
    "beta-range-greatest",
    "depth-beta-5-beta",
)
def beta_and_flow_stress(results: Results) -> Finding:
    """Beta was computed for one flow stress and multiplied by another."""
    text, Y_t = results.text, results.exact("flow-stress")
    grains = text("flow-stress")
    cube_at_grains = 2 * results.exact("elastic-modulus") / (3 * Y_t)
    alpha_at_grains = cbrt(cube_at_grains)
    beta_at_grains = 7 / 3 * log(alpha_at_grains)
    resistance_at_grains = beta_at_grains * Y_t
    alpha = prints("alpha", "5.75", alpha_at_grains, "1", f"alpha at {grains} MPa")
    beta = prints("beta", "4.08", beta_at_grains, "1", f"beta at {grains} MPa")
    resistance = prints(
        "resistance", "2.86", resistance_at_grains, "GPa", f"R_t with that beta at {grains} MPa"
    )
    ratio = prints(
        "ratio", "0.776", exact_ratio(case(results, 5, resistance=float(resistance_at_grains))),
        "1", "exact X/R with that R_t",
    )  # fmt: skip
    cavity_bulk = prints(
        "cavity_bulk", "4.95", 2 / 3 + 2 * log(results.computed("walker-anderson-alpha")), "1",
        f"pressure of Hill's spherical cavity over flow stress, {text('yield-strength')} MPa",
    )  # fmt: skip
    cavity = prints(
        "cavity", "4.17", 2 / 3 + 2 * log(alpha_at_grains), "1", f"the same at {grains} MPa"
    )
    cube = prints("cube", "190.5", cube_at_grains, "1", f"alpha^3 at {grains} MPa")
    steps = (calculated("190.5", cube_at_grains), calculated("4.08", 7 / 9 * log(190.48)))
    return conclude(
        "beta-and-flow-stress",
        "inconsistent pair",
        title=f"The beta of {text('walker-anderson-beta')} was computed for "
        f"{text('yield-strength')} MPa; the calculation takes {text('flow-stress')} MPa",
        statement="Eqs. 10 and 11 make beta depend on the flow stress. The report evaluates them "
        f"at Y_t = {text('yield-strength')} MPa and gets alpha = {text('walker-anderson-alpha')}, "
        f"beta = {text('walker-anderson-beta')}; the calculation takes "
        f"{text('depth-beta-5-beta')}, the upper end of its range, times Y_t = "
        f"{text('flow-stress')} MPa. At {text('flow-stress')} MPa the same equations give alpha = "
        f"{alpha}, beta = {beta}. With that beta R_t is {resistance} GPa and X/R {ratio}, not "
        f"{text('ratio-beta-5')}: the gap to the observed {text('observed-ratio')} would be wider. "
        f"The range of {text('beta-range-least')} to {text('beta-range-greatest')} holds both "
        "values, so no printed number is wrong on that account. Eq. 11 itself is right for a "
        "spherical cavity in an incompressible target, whose pressure, 2/3 + 2 ln alpha, is "
        f"{cavity_bulk} and {cavity} times the flow stress.",
        by_hand=f"alpha^3 = 2 * {text('elastic-modulus', 'GPa')}/(3 * "
        f"{text('flow-stress', 'GPa')}) = {steps[0]}; beta = 7/9 * ln(190.48) = {steps[1]}.",
        settle="Whether beta = 5 was meant for the bulk strength or for that of a grain.",
        status="open",
        evidence=(alpha, beta, resistance, ratio, cavity_bulk, cavity, cube),
        steps=steps,
    )  # fmt: skip


@concerning("ratio-beta-3", "ratio-beta-5", "observed-ratio")
def inertia_term(results: Results) -> Finding:
    """What the drag of Eq. 13 does to the depth."""
    text = results.text
    energy = results.exact("a1-density") * results.exact("a1-initial-velocity") ** 2 / 2
    without = {beta: constant_pressure_ratio(case(results, beta)) for beta in (3, 5)}
    with_drag = {beta: exact_ratio(case(results, beta)) for beta in (3, 5)}
    pressed_5 = prints(
        "pressed_5", "0.752", without[5], "1", "X/R at the constant pressure R_t, beta = 5"
    )
    pressed_3 = prints("pressed_3", "1.040", without[3], "1", "the same, beta = 3")
    exact_5 = prints("exact_5", "0.698", with_drag[5], "1", "exact X/R, beta = 5")
    exact_3 = prints("exact_3", "0.913", with_drag[3], "1", "exact X/R, beta = 3")
    price_5 = prints(
        "price_5", "7", 1 - with_drag[5] / without[5], "percent",
        "by how much the term lowers X/R, beta = 5",
    )  # fmt: skip
    price_3 = prints(
        "price_3", "12", 1 - with_drag[3] / without[3], "percent", "the same, beta = 3"
    )
    work = prints(
        "work", "0.318", energy / resistances(results)[5], "1",
        "CV/PV at the constant pressure R_t, beta = 5",
    )  # fmt: skip
    steps = (
        calculated("0.3179", Fraction(8900 * 500**2, 2) / Fraction("3.5e9")),
        calculated("0.318", 0.7521**2 * (3 - 0.7521) / 4),
    )
    return conclude(
        "inertia-term",
        "method",
        title=f"The target's inertia takes {price_5} to {price_3} % off the depth and does not "
        "close the gap",
        statement="Without the term rho_t v^2/2 of Eq. 13 the crater is pressed at the constant "
        "R_t, and its volume times R_t is the kinetic energy. That gives X/R = "
        f"{pressed_5} for beta = 5 and {pressed_3} for beta = 3, against {exact_5} and {exact_3} "
        f"with the term. So the term lowers the depth by {price_5} and {price_3} %; the observed "
        f"{text('observed-ratio')} is much lower still.",
        by_hand=f"CV/PV = rho_p V^2/(2 R_t) = 8900 * 500^2/2/(3.5 * 10^9) = {steps[0]}, and y^2 (3 "
        f"- y)/4 has this value at y = {pressed_5}: 0.7521^2 * (3 - 0.7521)/4 = {steps[1]}.",
        settle="Nothing is open.",
        status="explained",
        evidence=(pressed_5, pressed_3, exact_5, exact_3, price_5, price_3, work),
        steps=steps,
    )


@concerning("observed-ratio", "beta-range-greatest", "depth-beta-5-beta", "flow-stress")
def observed_beta(results: Results) -> Finding:
    """Which beta the observed depth would need."""
    text, exact = results.text, results.exact
    observed, y = exact("observed-ratio"), text("observed-ratio")
    least_ratio, greatest_ratio = results.ledger.claims["observed-ratio"].target().ends
    Y_t, V = exact("flow-stress"), exact("a1-initial-velocity")

    def pressure_ratio(y: Fraction) -> float:
        """Return p = rho_t V^2/2R_t [1] at which the exact X/R is y, by Eq. 13 integrated."""
        return expm1(y**2 * (3 - y) / 4 * exact(DENSITY) / exact("a1-density"))

    def beta_for(y: Fraction) -> float:
        return float(impact_pressure(results) / Y_t) / pressure_ratio(y)

    beta = prints("beta", "25", beta_for(observed), "1", f"beta at which the exact X/R is {y}")
    resistance = prints(
        "resistance", "18", beta_for(observed) * Y_t, "GPa", f"R_t at which the exact X/R is {y}"
    )
    beta_least = prints(
        "beta_least", "19", beta_for(greatest_ratio), "1",
        f"beta at which the exact X/R is {number(greatest_ratio)}",
    )  # fmt: skip
    beta_greatest = prints(
        "beta_greatest", "36", beta_for(least_ratio), "1",
        f"beta at which the exact X/R is {number(least_ratio)}",
    )  # fmt: skip
    velocity = prints(
        "velocity", "222", V * sqrt(exact("depth-beta-5-beta") / beta_for(observed)), "m/s",
        f"impact velocity at which the exact X/R is {y}, beta = 5",
    )  # fmt: skip
    p = prints(
        "p", "0.0550", pressure_ratio(observed), "1",
        f"rho_t V^2 / 2 R_t at which the exact X/R is {y}",
    )  # fmt: skip
    left = prints("left", "0.081", observed**2 - observed**3 / 3, "1", f"y^2 - y^3/3 at y = {y}")
    density = exact("carbon-steel-density")
    steps = (
        calculated("0.081", observed**2 - observed**3 / 3),
        calculated("0.081", 4 * 8900 / (3 * density) * log(1 + 0.0550)),
        calculated("18", 0.98125 / 0.0550),
    )
    return conclude(
        "observed-beta",
        "method",
        title=f"The observed {y} would need beta near {beta}; the report considers "
        f"{text('beta-range-least')} to {text('beta-range-greatest')}",
        statement=f"Solved for beta, with everything else as printed, X/R = {y} needs beta = "
        f"{beta} at {text('flow-stress')} MPa, R_t = {resistance} GPa. With any X/R that prints "
        f"{y} it is {beta_least} to {beta_greatest}. At beta = 5 the model gives {y} at {velocity} "
        f"m/s, far below the {text('velocity-403')} m/s at which no particle stuck.",
        by_hand="Eq. 13 integrates to y^2 - y^3/3 = (4 rho_p/3 rho_t) ln(1 + p), y = X/R, p = "
        f"rho_t V^2/2R_t. At y = {y} the left side is {y}^2 - {y}^3/3 = {steps[0]}; p = {p} gives "
        f"4 * 8900/(3 * {text('carbon-steel-density')}) * ln(1 + {p}) = {steps[1]}, and R_t is "
        f"0.98125/{p} = {steps[2]} GPa.",
        settle="Nothing is open; the report names possible causes in section 4.",
        status="explained",
        evidence=(beta, resistance, beta_least, beta_greatest, velocity, p, left),
        steps=steps,
    )


def johnson_cook_copper(results: Results) -> float:
    """Johnson and Cook's flow stress of copper [Pa] at a strain of one, unheated.

    The strain rate is that which the report estimates, 10^7 per second, far beyond the law's fit.
    """
    at_strain_1 = results["copper-johnson-cook"] + results["copper-johnson-cook-hardening"]
    return at_strain_1 * (1 + results["copper-johnson-cook-rate"] * log(results["strain-rate"]))


@concerning("copper-yield", "copper-yield-bound", "a1-resistance", "eq6")
def rigid_strength(results: Results) -> Finding:
    """A rigid particle needs far more strength than the copper has."""
    text, exact = results.text, results.exact
    Y_p, V = exact("copper-yield"), text("a1-initial-velocity")
    stress = {beta: impact_pressure(results) + R_t for beta, R_t in resistances(results).items()}
    johnson_cook = johnson_cook_copper(results)
    rate = results.ledger.claims["strain-rate"].text
    sigma_5 = prints("sigma_5", "4.48", stress[5], "GPa", f"Sigma at {V} m/s, beta = 5")
    sigma_3 = prints("sigma_3", "3.08", stress[3], "GPa", f"Sigma at {V} m/s, beta = 3")
    multiple_5 = prints(
        "multiple_5", "50", stress[5] / Y_p, "1", "Sigma over the copper's yield strength, beta = 5"
    )
    multiple_3 = prints(
        "multiple_3", "34", stress[3] / Y_p, "1", "Sigma over the copper's yield strength, beta = 3"
    )
    pressure = prints(
        "pressure", "0.981", impact_pressure(results), "GPa", f"rho_t V^2/2 at {V} m/s"
    )
    fast = prints(
        "fast", "536", johnson_cook, "MPa",
        f"Johnson-Cook flow stress of copper at strain 1 and {rate} per second",
    )  # fmt: skip
    short_5 = prints("short_5", "8", stress[5] / johnson_cook, "1", "Sigma over that, beta = 5")
    short_3 = prints("short_3", "6", stress[3] / johnson_cook, "1", "Sigma over that, beta = 3")
    steps = (
        calculated("0.981", exact("carbon-steel-density") * 500**2 / 2 / 10**9),
        calculated("536", (Y_p / 10**6 + 292) * (1 + 0.025 * log(10**7))),
    )
    return conclude(
        "rigid-strength",
        "method",
        title=f"By Eqs. 5 and 6 a rigid particle needs {multiple_3} to {multiple_5} times the "
        "yield strength quoted for copper",
        statement="By Eqs. 5 and 6 a particle that moves as a rigid body carries Sigma = rho_t "
        f"V^2/2 + R_t: at the impact {sigma_5} GPa for beta = 5 and {sigma_3} GPa for beta = 3. "
        f"The yield strength that the report quotes for copper is {text('copper-yield')} MPa, so "
        f"Sigma is {multiple_5} and {multiple_3} times as much. The Johnson-Cook model with that "
        f"value, without heating, gives {fast} MPa at a strain of one and {text('strain-rate')} "
        f"per second, far beyond its fit: still {short_5} and {short_3} times too little. The "
        "report assumes copper stronger than the target resistance, which is less than Sigma, and "
        "says why a small particle in a crater may be, or seem, stronger.",
        by_hand=f"{text('carbon-steel-density')} * 500^2/2/10^9 = {steps[0]} GPa; add "
        f"{text('a1-resistance', 'GPa')} GPa. Johnson-Cook: ({text('copper-yield')} + 292) * (1 + "
        f"0.025 * ln(10^7)) = {steps[1]} MPa.",
        settle="The strength of a copper particle at such strain rates.",
        status="open",
        evidence=(
            sigma_5, sigma_3, multiple_5, multiple_3, pressure, fast, short_5, short_3,
        ),
        steps=steps,
    )  # fmt: skip


@concerning(
    "flow-stress",
    "strength-feathery",
    "strength-clear",
    "strength-bulk",
    "strength-multiple",
    "yield-strength",
)
def strengths(results: Results) -> Finding:
    """Y_t stands for different kinds of strength."""
    text, exact = results.text, results.exact
    Y_t, S_clear, S_feathery = (
        exact(name) for name in ("flow-stress", "strength-clear", "strength-feathery")
    )
    least_tensile, S_bulk = exact("a240-tensile"), exact("strength-bulk")
    feathery = prints("feathery", "758", S_feathery, "MPa", "strength of the feathery grains")
    clear = prints("clear", "676", S_clear, "MPa", "strength of the clear grains")
    choice = prints("choice", "101.5", Y_t, "ksi", "the flow stress of the calculation")
    between = proves(
        "between", S_clear < Y_t < S_feathery, "it lies between the two hardness values"
    )
    like = prints(
        "like", "1.3", S_clear / least_tensile, "1",
        "clear grains over the least tensile strength that A240 admits",
    )  # fmt: skip
    like_most = prints(
        "like_most", "1.5", S_feathery / least_tensile, "1",
        "feathery grains over the least tensile strength that A240 admits",
    )  # fmt: skip
    unlike = prints(
        "unlike", "3.3", S_clear / S_bulk, "1",
        "clear grains over the bulk strength that the report names",
    )  # fmt: skip
    ksi = prints("ksi", "6.894757", to_si("ksi"), "MPa", "1 ksi")
    bulk = prints("bulk", "207", S_bulk, "MPa", "bulk strength that the report names")
    steps = (
        calculated("1.3", S_clear / least_tensile),
        calculated("1.5", S_feathery / least_tensile),
        calculated("676", S_clear / to_si("ksi") * Fraction("6.894757")),
    )
    tensile = text("a240-tensile")
    return conclude(
        "strengths",
        "wording",
        title="Y_t mixes flow, yield and tensile strength; tensile to tensile, the grains have "
        f"{like} to {like_most} times the least strength of 304",
        statement="Y_t is the target's flow stress in section 3 and its yield strength in the "
        "appendix; beta = 3 comes from a tensile strength, beta = 5 from a yield strength. The "
        f"grains' {text('strength-clear')} and {text('strength-feathery')} ksi are tensile "
        f"strengths, converted from hardness. The bulk's {text('strength-bulk')} ksi equals the "
        "least yield strength that ASTM A240 admits for 304, and is near the report's "
        f"{text('yield-strength')} MPa, so it is probably a yield strength; the least tensile "
        f"strength of that standard is {tensile} ksi. If so, \"several times that of the bulk\" "
        f"({unlike}) divides a tensile by a yield strength. Tensile to tensile, it is {like} to "
        f"{like_most} times the least, and less for a stronger bulk. {text('flow-stress')} MPa "
        f"lies between the two converted strengths, {clear} and {feathery} MPa.",
        by_hand=f"{text('strength-clear')}/{tensile} = {steps[0]}, "
        f"{text('strength-feathery')}/{tensile} = {steps[1]}; a ksi is {ksi} MPa, so "
        f"{text('strength-clear')} * {ksi} = {steps[2]} MPa.",
        settle="Which strength the bulk value is.",
        status="open",
        evidence=(feathery, clear, choice, between, like, like_most, unlike, ksi, bulk),
        steps=steps,
    )  # fmt: skip
