"""What the workbook says about its inputs and its runs."""

# About all inputs.
UNUSABLE = "CHECK THE INPUTS: column E shows which number cannot be used, and why."
IGNORED = "In use: the report’s inputs. What you typed is ignored."
CHANGED = "In use: your inputs. Column E shows which of them are not the report’s."
UNCHANGED = "In use: the report’s inputs."
NO_CHOICE = "C4 must be yours or report: yours is used."

INPUTS_SAY = {
    "unusable": UNUSABLE,
    "changed": CHANGED,
    "ignored": IGNORED,
    "unchanged": UNCHANGED,
}
"""What is said of all inputs, by the part of a defined name: `is_changed`, `says_changed`."""

# About a run. `Overview` has room for 60 letters, of which β takes some.
COMPLETE = "Complete: the velocity is below v_stop."
EARLY = "Complete, but v_stop ends it before rest."
REVERSED = "Complete; the last step reverses the velocity."
STEP_TOO_LONG = "DO NOT TRUST IT: the time step is too long."
DOUBTFUL = "DO NOT TRUST IT: its depth is off the exact one."
ONE_STEP = "DO NOT TRUST IT: a single step ends the run."
NO_STEPS = "NO STEPS: the impact velocity is below v_stop."
OUT_OF_ROWS = "OUT OF ROWS: the rows end before the stop."
OUT_OF_BOTH = "OUT OF ROWS, and the time step is too long."
NO_RUN = "NOT COMPUTED: see Inputs, column E."

RUN_SAYS = {
    "both": OUT_OF_BOTH,
    "rows": OUT_OF_ROWS,
    "no_steps": NO_STEPS,
    "one_step": ONE_STEP,
    "coarse": STEP_TOO_LONG,
    "off": DOUBTFUL,
    "reversed": REVERSED,
    "early": EARLY,
    "done": COMPLETE,
}
"""What is said of a run, by the part of a defined name: `is_early`, `says_early`."""

# About the name of a sheet.
AS_GIVEN = "R_t as given"
AS_REPORTED = "R_t as in the report"
NO_BETA = "β = not computed"
KEEPS_NAME = "The sheet keeps the name with which it was written."
NOT_COARSER = "Its time step is not longer than dt_s."

# About the depth on the sheet Solve.
BY_DEPTH = "Solved for the measured depth X."
BY_RATIO = "Solved for the measured X/R; the depth above it is not used."
TOO_DEEP = "TOO DEEP: a target resistance that gives this depth is below 1E-240 Pa."
NOT_SOLVED = "NOT SOLVED: what is typed is not within G to H, or an input cannot be used."

# About Figure 5, and about the runs of the sheet Convergence.
ALL_POINTS = "All points of the chart are computed."
POINTS_MISSING = "POINTS ARE MISSING: see the sheet Inputs."
CURRENT = "The inputs in use are those of these runs."
STALE = "THE INPUTS IN USE ARE NOT THOSE OF THESE RUNS: write the workbook again to renew the runs."
