"""What --map says; names, sheets, and stored values that are false."""

from foreign.edits import case, clear, copied, name, put
from foreign.truth import CLEAN, fault, refused

ZEROS = {
    **dict.fromkeys(("B3", "B4", "B6"), 0.0),
    **{f"{column}{row}": 0.0 for column in "ACDEF" for row in range(8 + (column in "ADE"), 61)},
}
"""Zeros where formulas stand."""

CASES = (
    # what is where, as the user says
    case(
        "--map of what it is",
        CLEAN,
        layout="no-words",
        given={"depth": "Sheet1!AC510:AC641", "velocity": "AB510:AB641", "target_density": "T503"},
    ),
    case(
        "--map of the velocity at the end, no heads",
        CLEAN,
        clear("A7", "C7", "D7", "E7", "F7"),
        given={"velocity": "F9:F60"},
    ),
    case(
        "--map of a column whose head has the unit of something else",
        refused(),
        put("C7", "v [um]"),
        given={"velocity": "Sheet1!C8:C60"},
    ),
    case("map radius=B1", CLEAN, given={"radius": "B1"}),
    case("map depth=D8:D61", CLEAN, given={"depth": "D8:D61"}),
    case("map velocity_initial=C8:C61", CLEAN, given={"velocity_initial": "C8:C61"}),
    case("map velocity=F9:F61", CLEAN, given={"velocity": "F9:F61"}),
    case("map deceleration=E9:E61", CLEAN, given={"deceleration": "E9:E61"}),
    case("map radius=C8:C61", refused("one cell"), given={"radius": "C8:C61"}),
    case("map depth=B1", refused("--map depth=B1"), given={"depth": "B1"}),
    case("map step=A1", refused("A1", "no number"), given={"step": "A1"}),
    case("map deep=D8:D61", refused("deep", "mean depth"), given={"deep": "D8:D61"}),
    case("map depth=D8:D10", refused(), given={"depth": "D8:D10"}),
    case("map time=Nowhere!A1", refused("Nowhere", "Sheet1"), given={"time": "Nowhere!A1"}),
    case("map velocity=A8:C61", refused(), given={"velocity": "A8:C61"}),
    case("map depth=B1:B6", refused(), given={"depth": "B1:B6"}),
    case("map depth=D:D", CLEAN, given={"depth": "D:D"}),
    case("map depth=D8:D900", CLEAN, given={"depth": "D8:D900"}),
    case("map radius=B4:B5", refused(), given={"radius": "B4:B5"}),
    case("map velocity=B5", CLEAN, given={"velocity": "B5"}),
    case("map depth=A9:F9", refused(), given={"depth": "A9:F9"}),
    case(
        "map depth=DDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDD",
        refused("--map depth=DDD"),
        given={"depth": "DDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDDD"},
    ),
    # names, and several sheets
    case(
        "--map of one of two sheets",
        refused(),
        copied("Second"),
        layout="no-words",
        step=5e-10,
        given={"depth": "AC510:AC561"},
    ),
    case(
        "names beside",
        CLEAN,
        name("far", "1E999"),
        name("tau", "0.0000000002"),
        name("half", "0.5"),
        name("Rt_", "3.6E9"),
        layout="named-constants",
    ),
    # stored values
    case(
        "numbers of a block",
        fault("stale value", "D20"),
        stored={
            "D20": 1e-06,
            "D21": 1e-06,
            "D22": 1e-06,
            "D23": 1e-06,
            "D24": 1e-06,
            "D25": 1e-06,
            "D26": 1e-06,
            "D27": 1e-06,
            "D28": 1e-06,
            "D29": 1e-06,
        },
    ),
    case("a number, two apart", fault("stale value", "D20"), stored={"D20": 1e-06, "D22": 1e-06}),
    case(
        "a text, a truth value, an error",
        fault("stale value", "D20", "D30", "D40"),
        stored={"D20": "abc", "D30": True, "D40": "#N/A"},
    ),
    case(
        "other truth values, texts, errors",
        fault("stale value", "J1", "J2"),
        put("J1", "=B1>0"),
        put("J2", '="a"&"b"'),
        put("J4", "=1/0"),
        stored={"J1": False, "J2": "ac", "J4": 3.0},
    ),
    case("a result beside", fault("stale value", "J3"), put("J3", "=D60*2"), stored={"J3": 1e-05}),
    case("an input that follows", fault("stale value", "B3"), stored={"B3": 5e-11}),
    case("last digits of a depth", CLEAN, stored={"D30": 4.840317124906935e-06}),
    case(
        "more than the last digits of a depth",
        fault("stale value", "D60"),
        stored={"D60": 7.660299301158559e-06},
    ),
    case(
        "a final depth of seven digits", fault("stale value", "D60"), stored={"D60": 7.660297e-06}
    ),
    case("what rounding leaves of a velocity", CLEAN, stored={"F60": 0.9703721912500904}),
    case(
        "more than rounding leaves of a velocity",
        fault("stale value", "F60"),
        stored={"F60": 0.9703721912680905},
    ),
    case("zeros, as by a program that calculates nothing", CLEAN, stored=ZEROS),
    case(
        "rounding in what reads a column",
        fault("stale value", "J3"),
        put("J3", "=D60*2"),
        stored={"J3": 1.532059860231727e-05},
    ),
)
