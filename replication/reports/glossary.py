"""The words and symbols that the audit uses, for its readers."""

__all__ = ["CAPTIONS", "KINDS", "SYMBOLS", "VERDICTS"]

VERDICTS = {
    "reproduced": "the value computed from the inputs as printed is one that prints like the "
    "report's, for every admitted value of an input that it does not print",
    "reproduced within input rounding": "the inputs as printed do not give it, or not for every "
    "admitted value of an input that is not printed, but some that print like the report's do",
    "not reproduced": "no inputs that print like the report's give one, which is proven (the "
    "remark on 0.5 ns is judged with the inputs exactly as printed)",
    "undecided": "neither could be proven",
    "not checkable": "it rests on data, a choice or a code that the report does not give",
}
"""The verdicts of `replication.audit.verdict.Verdict`, and what they say."""

KINDS = {
    "computed": "calculated anew from other numbers of the report",
    "restated": "it repeats or counts what stands elsewhere in the report",
    "blank cells": "cells that the report's table and our copy of it leave empty",
}
"""What reproduced claims amount to."""

SYMBOLS = {
    "R, D, L": "radius and diameter of the particle; length of the cylinder that it is taken for",
    "M": "mass of the particle",
    "x, X": "depth of penetration in the course of the impact, and at its end",
    "v, V": "velocity of the particle in the course of the impact, and at its start",
    "rho_p, rho_t": "densities of particle and target",
    "Y_t": "flow stress of the target",
    "R_t": "resistance of the target",
    "beta": "the constant in R_t = beta Y_t, 3 to 5 in the report",
    "alpha": "extent of the plastic zone in the target (Eqs. 10 and 11)",
    "Sigma": "axial stress along the centerline of the particle (Eqs. 5 and 6)",
    "k_1, k_t": "fitting parameters of Frank and Zook's model: k_t of the drag, in place of "
    "1/2, and k_1 of the target's inertia (Eqs. 14 to 17)",
    "z": "k_t rho_t V^2, the drag's pressure at the impact by Frank and Zook",
    "CV/PV": "volume of the crater over that of the particle",
    "ulp": "unit in the last place: the distance of a double from the next",
}
"""Symbols of the report and of this audit."""

CAPTIONS = {
    "sensitivity": "Final depth for beta = 5 as each input goes through a range, the others as "
    "printed. Above all by ±10 %, to compare the inputs; below each by what the report or its "
    "evidence states, as the table gives it. At the right the change of the depth in µm. The "
    "report's range of beta, 3 to 5, ends at the case's own 5, so its bar has one side.",
    "convergence": "The published scheme takes a row's drag at the velocity at its start, which "
    "makes it first order; taken at the middle velocity it is second order. The hollow marks "
    "scatter about the lines because the whole error has two more parts, of either sign, that do "
    "not shrink steadily with the step: the stop rule, and the half step by which the depth "
    "trails the velocity.",
}
"""What must be said under a figure."""
