"""Rows that end early or late, last digits, numbers without formulas."""

from foreign.edits import case, fill, put
from foreign.truth import CLEAN, EITHER, fault

CASES = (
    # plain sheet: the stop
    case("rows 3", CLEAN, steps=3),
    case("rows 4", CLEAN, steps=4),
    case("rows 20", CLEAN, steps=20),
    case("rows 44", fault("other scheme", "F52"), steps=44),
    case("rows 51", CLEAN, steps=51),
    case("rows 52", CLEAN, steps=52),
    case("rows 53", fault("other scheme", "F61"), steps=53),
    case("rows 54", fault("other scheme", "F61"), steps=54),
    case("rows 60", fault("other scheme", "F61"), steps=60),
    case("a hair beyond the radius", fault(EITHER, "E60"), velocity=712.0),
    case("60 rows of 4 ps", CLEAN, step=4e-12, steps=60),
    case("step 4e-11", CLEAN, step=4e-11),
    case("step 6e-12 | rows 30", CLEAN, step=6e-12, steps=30),
    case("403 m/s in rows for 500", fault("other scheme", "F60"), put("B5", 403)),
    case("521 m/s in rows for 500", CLEAN, put("B5", 521)),
    case("beyond the radius, the area shrinks", fault(EITHER, "E47"), velocity=800.0),
    case(
        "beyond the radius, as it should be",
        CLEAN,
        fill("E9:E68", "=(0.5*$E$1*C9^2+$B$6)*PI()*(IF(D9<$B$1,$B$4*D9-D9^2,$B$1^2))/$B$3"),
        velocity=800.0,
    ),
    case(
        "beyond the radius, drag without 1/2",
        fault("other scheme", "E9", "E10"),
        fill("E9:E68", "=($E$1*C9^2+$B$6)*PI()*(IF(D9<$B$1,$B$4*D9-D9^2,$B$1^2))/$B$3"),
        velocity=800.0,
    ),
    # last digits
    case(
        "of every deceleration, and a wrong depth later",
        fault("typed number", "D30"),
        fill("E9:E139", "=PI()*(0.5*7850*C9^2+$B$6)/$B$3*($B$4*D9-D9^2)"),
        put("D30", 3e-06),
        layout="table-a1",
    ),
    case(
        "of the depth",
        CLEAN,
        fill("Calcul pas à pas!G23:G152", "=(G22/delta_t+F23)*delta_t"),
        layout="french",
    ),
    case(
        "of the velocity",
        CLEAN,
        fill("Calcul pas à pas!I23:I152", "=F23*(1-H23*delta_t/F23)"),
        layout="french",
    ),
    case(
        "of the deceleration",
        CLEAN,
        fill(
            "Calcul pas à pas!H23:H152",
            "=(0.5*rho_c*F23*F23+R_cible)*(PI()*1)*(2*rayon*G23-G23*G23)/masse",
        ),
        layout="french",
    ),
    case(
        "of the mass",
        CLEAN,
        put("Données!C13", "=rayon*rayon*rayon*PI()*4/3*rho_p"),
        layout="french",
    ),
    # numbers without formulas
    case(
        "a deceleration",
        fault("typed number", "E11"),
        put("E11", 1550000000.0),
        layout="printed-digits",
    ),
    case("a velocity", fault("typed number", "F9"), put("F9", 497), layout="printed-digits"),
    case("a depth", fault("typed number", "D12"), put("D12", 3.94e-07), layout="printed-digits"),
    case(
        "a deceleration of a velocity's size",
        fault("typed number", "E11"),
        put("E11", 700),
        layout="printed-digits",
    ),
    case(
        "a time",
        fault(("typed number", "printed number"), "A10"),
        put("A10", 5e-10),
        layout="printed-digits",
    ),
    case(
        "a depth of six digits", fault("typed number", "C62"), put("C62", 5.5), layout="six-digits"
    ),
    case(
        "a velocity of six digits",
        fault("typed number", "B133"),
        put("B133", 1.2),
        layout="six-digits",
    ),
    case("a pasted depth", fault("typed number", "D62"), put("D62", 5.5e-06), layout="pasted"),
    case("a pasted velocity", fault("typed number", "F102"), put("F102", 7), layout="pasted"),
    case("beta 4.2", CLEAN, layout="pasted", beta=4.2),
    case("beta 4.2 in six digits", CLEAN, layout="six-digits", beta=4.2),
    case("430 m/s", CLEAN, layout="pasted", velocity=430.0),
    case("430 m/s in six digits", CLEAN, layout="six-digits", velocity=430.0),
    case("8 um", CLEAN, layout="pasted", radius=8e-06),
    case("0.5 ns", CLEAN, layout="pasted", step=5e-10),
    case("0.5 ns in six digits", CLEAN, layout="six-digits", step=5e-10),
)
