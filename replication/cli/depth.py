"""`coldspray depth`: print the final depth of a case, by one model of the report or by all."""

import argparse
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict
from fractions import Fraction
from typing import Any

from reference.units import to_si
from replication.cases import BETA_5, DEPTH_MODELS, OWN_INPUTS, inputs_of, modelled, option
from replication.cli.case import (
    add_inputs,
    case_of,
    doubt,
    given_inputs,
    in_words,
    inputs_in_words,
    shown_in,
)
from replication.cli.options import add_json, add_quiet, one_of
from replication.cli.output import paragraph, put, width
from replication.models.estimates import penetration_threshold
from replication.models.impact import Impact, check_magnitudes, check_positive
from replication.text import aligned, columns, number, with_unit
from replication.user_input import place, read_number

HELP = "print the exact final depth of a case, or that by another model"
EXAMPLE = "coldspray depth --velocity '450 m/s' --radius '5 um' --models"

MODELS_IN_WORDS = {
    "rigid": "a rigid particle, drag and resistance: Eqs. 12 and 13 without time steps",
    "constant-pressure": "the pressure is R_t throughout: no inertia of the target",
    "frank-zook": "Frank and Zook, as Eqs. 14 and 15 give it: a fitted model",
    "frank-zook-printed": "Frank and Zook, by Eq. 16 as printed: half of what Eqs. 14 and 15 give",
}
"""What each model is, in a line."""

DEFAULT_MODEL = "rigid"
"""The model by which a depth is computed if none is named."""

OPTIONS = {
    "resistance": "--frank-zook-resistance",
    "length_ratio": "--length-ratio",
    "k_1": "--k-1",
    "k_t": "--k-t",
}
"""The options for inputs whose defaults are not the case's."""

SYMBOLS = {"resistance": "R_t", "length_ratio": "L/D", "k_1": "k_1", "k_t": "k_t"}
"""The symbols of these inputs in the report."""

RESISTANCE = {"resistance", "beta", "flow_stress"}
"""The inputs of a case that give its resistance."""


def add_options(parser: argparse.ArgumentParser) -> None:
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        # Without a default of its own: argparse would accept that beside --models.
        "--model", metavar="NAME", type=one_of("model", DEPTH_MODELS),
        help=f"by which model: {', '.join(DEPTH_MODELS)} (default: {DEFAULT_MODEL})",
    )  # fmt: skip
    which.add_argument("--models", action="store_true", help="by all of them, side by side")
    parser.add_argument(
        "--particle-strength", metavar="Y",
        help="also print the velocity above which a particle of this strength Y_p [Pa] penetrates "
        "at all (Eq. 5)",
    )  # fmt: skip
    add_json(parser)
    add_quiet(parser)
    add_inputs(parser, with_sheet=False)
    own = parser.add_argument_group(
        "Frank and Zook",
        "Inputs of their models alone. The defaults are printed in section 3 of the report. Their "
        "resistance is fitted to their model: that of the case has no say in it.",
    )
    report = modelled("frank-zook", BETA_5)
    for name, flag in OPTIONS.items():
        value = _shown(name, getattr(report.model, name))
        own.add_argument(
            flag, metavar="X", dest=f"own_{name}",
            help=f"{SYMBOLS[name]} ({value}, {report.sources[name]})",
        )  # fmt: skip


def run(options: argparse.Namespace) -> int:
    """Print the depth X [um and m], X/R, and whether X exceeds R, of one model or of each."""
    case, warnings = case_of(options)
    typed = given_inputs(options)
    names = list(DEPTH_MODELS) if options.models else [options.model or DEFAULT_MODEL]
    _refuse_without_say(options, typed, names)
    own = _own_inputs(options, names)
    results = [_result(name, case, own, typed) for name in names]
    strength, threshold, typed_strength = None, None, options.particle_strength
    if typed_strength is not None:
        strength = _read_input("--particle-strength", "particle_strength", typed_strength, "Pa")
        threshold = penetration_threshold(strength, case.target_resistance, case.particle_density)
        if strength > 0:  # a particle without any is a jet
            warnings += doubt("flow_stress", strength, "--particle-strength")
    if "resistance" in own:
        warnings += doubt("resistance", own["resistance"], OPTIONS["resistance"])
    answer: dict[str, Any]
    if options.models:
        answer = {"inputs": inputs_of(case), "models": results}
    elif names == ["rigid"]:  # with beta and flow stress, as the case has them
        answer = {**results[0], "inputs": inputs_of(case)}
    else:
        answer = results[0]
    record = {**answer, "penetration_threshold": threshold, "warnings": warnings}

    def text() -> str:
        depths = _all(case, results) if options.models else _depth_in_words(case, results[0])
        return "\n".join([depths, *_about_threshold(case, strength, threshold)])

    return put(options, record, text, warnings=warnings)


def _refuse_without_say(
    options: argparse.Namespace, typed: Collection[str], names: Sequence[str]
) -> None:
    """Raise ValueError if an option gives a resistance of the case, and nothing asked for uses it.

    `typed` are the inputs of the case that options gave. The threshold uses it whatever the models.
    """
    if options.particle_strength is None and all(DEPTH_MODELS[name].own for name in names):
        for name in ("beta", "flow_stress", "resistance"):
            if name in typed:
                raise ValueError(
                    f"{option(name)} has no say in the model {names[0]}, whose resistance is its "
                    f"own: give {OPTIONS['resistance']}"
                )


def _own_inputs(options: argparse.Namespace, names: Sequence[str]) -> dict[str, float]:
    """Return the inputs given that are not the case's; ValueError if no model has them."""
    texts = {name: getattr(options, f"own_{name}") for name in OPTIONS}
    texts = {name: text for name, text in texts.items() if text is not None}
    if texts and not any(DEPTH_MODELS[name].own for name in names):
        raise ValueError(
            f"{OPTIONS[next(iter(texts))]} is no input of the model {names[0]}: add --model "
            "frank-zook or --models"
        )
    return {
        name: _read_input(OPTIONS[name], name, text, OWN_INPUTS[name])
        for name, text in texts.items()
    }


def _read_input(flag: str, name: str, text: str, unit: str) -> float:
    """Read a number for an input, which no case has, that the models can compute with."""
    with place(flag):
        value = read_number(text, unit)
        check_positive({name: value})
        check_magnitudes(**{name: value})
        return value


def _result(
    name: str, case: Impact, own: Mapping[str, float], typed: Collection[str]
) -> dict[str, Any]:
    """Return what a model gives for a case, with its inputs and where each is from."""
    takes = DEPTH_MODELS[name].own
    modelled_case = modelled(name, case, {key: x for key, x in own.items() if key in takes})
    model, sources = modelled_case.model, dict(modelled_case.sources)
    for key, source in sources.items():
        names = RESISTANCE if key == "resistance" else {key}
        if source == "case" and names & set(typed):
            sources[key] = "given"
    return {
        "inputs": asdict(model),
        "model": name,
        "sources": sources,
        "depth": model.final_depth,
        "normalized_depth": model.normalized_depth,
        "beyond_radius": model.normalized_depth > 1,
    }


def _depth_in_words(case: Impact, result: Mapping[str, Any]) -> str:
    """Return the depth by one model; the report's is said without its name, which all else is."""
    name, depth, ratio = result["model"], result["depth"], result["normalized_depth"]
    if name == "rigid":
        head = [paragraph(in_words(case))]
    else:
        inputs = {
            key: x for key, x in result["inputs"].items() if key not in DEPTH_MODELS[name].own
        }
        head = [paragraph(f"{name}: {MODELS_IN_WORDS[name]}"), paragraph(inputs_in_words(inputs))]
    return "\n".join(
        [
            *head,
            *_own_table([result]),
            "",
            f"final depth       {number(depth * 1e6, 8)} um ({depth!r} m)",
            f"normalized depth  {number(ratio, 8)}",
            f"beyond radius     {'yes' if ratio > 1 else 'no'}",
        ]
    )


def _all(case: Impact, results: Sequence[Mapping[str, Any]]) -> str:
    """Return the depths by all models as a table, and what each of the models is."""
    rows = [("model", "x [um]", "X/R", "R_t [GPa]")]
    for result in results:
        depth, ratio = number(result["depth"] * 1e6, 8), number(result["normalized_depth"], 8)
        resistance = number(result["inputs"]["resistance"] / 1e9)
        rows.append((result["model"], depth, ratio, resistance))
    about = [
        paragraph(f"{name}: {MODELS_IN_WORDS[name]}", hanging="  ") for name in MODELS_IN_WORDS
    ]
    table = aligned(rows, right=True)
    return "\n".join([paragraph(in_words(case)), "", *table, *_own_table(results), "", *about])


def _own_table(results: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return a table of the inputs that are not the case's and where they are from, if any."""
    for result in results:
        if own := DEPTH_MODELS[result["model"]].own:
            rows = [("input", "value", "from")]
            rows += [
                (SYMBOLS[key], _shown(key, result["inputs"][key]), result["sources"][key])
                for key in own
            ]
            return ["", *columns(rows, min(width(), 100)).splitlines()]
    return []


def _shown(name: str, value: float) -> str:
    if OWN_INPUTS[name] == "1":
        return number(value)
    unit = shown_in(name)
    return with_unit(number(Fraction(value) / to_si(unit)), unit)


def _about_threshold(case: Impact, strength: float | None, threshold: float | None) -> list[str]:
    """Return what the threshold [m/s] of a particle's strength [Pa] means: it is no depth."""
    if strength is None or threshold is None:
        return []
    particle = f"a particle of strength Y_p {number(strength / 1e9)} GPa"
    resistance = f"the case's resistance R_t {number(case.target_resistance / 1e9)} GPa"
    if threshold == 0:
        shown_threshold = "none: every velocity penetrates"
        meaning = f"By Eq. 5 {particle} penetrates at any, as Y_p is not below {resistance}."
    else:
        shown_threshold = f"{number(threshold, 8)} m/s ({threshold!r} m/s)"
        reached = "is above it" if case.velocity > threshold else "is not above it"
        meaning = (
            f"By Eq. 5 {particle} penetrates a target of {resistance} only above this velocity; "
            f"{number(case.velocity)} m/s {reached}."
        )
    rigid = "The depth is that of a rigid particle."
    return ["", f"threshold         {shown_threshold}", paragraph(f"{meaning} {rigid}")]
