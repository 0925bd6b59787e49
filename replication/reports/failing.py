"""The claims not plainly reproduced, each in a line: what is printed, what follows, and why."""

from dataclasses import dataclass
from typing import Any

from replication.reports.shown import digits_of, is_open, plain
from replication.text import with_unit

__all__ = ["Failing", "failing"]


@dataclass(frozen=True, slots=True)
class Failing:
    """A claim not plainly reproduced: its record, what is printed, what follows from the report.

    `finding` is the record of the weightiest finding on it, if there is one.
    """

    claim: dict[str, Any]
    printed: str
    follows: str
    finding: dict[str, Any] | None


def failing(record: dict[str, Any]) -> list[Failing]:
    """Those of an audit's record, in the report's order; blank cells have no number to tell."""
    claims = {claim["id"]: claim for claim in record["claims"]}
    return [
        Failing(claim, *_numbers(claim, claims), _finding(claim, record["findings"]))
        for claim in claims.values()
        if is_open(claim) and claim["computed"] is not None
    ]


def _numbers(claim: dict[str, Any], claims: dict[str, Any]) -> tuple[str, str]:
    """The printed number, and the computed ones with as many digits."""
    text, unit = claim["printed"], claim["unit"]
    if claim["like"] is not None:
        model = claims[claim["like"]]
        text = model["printed"]
        printed = f"{with_unit(text, unit)} {_changed(claim, model, claims)}"
    else:
        printed = with_unit(plain(text), unit)
    digits = digits_of(text)
    others = (
        f"; {one['name']}: {_rounded(one['computed'], digits)}, {one['verdict']}"
        for one in claim["readings"]
    )
    return printed, with_unit(_rounded(claim["computed"], digits), unit) + "".join(others)


def _rounded(value: float, digits: int) -> str:
    return f"{value:#.{digits}g}".rstrip(".")


def _changed(claim: dict[str, Any], model: dict[str, Any], claims: dict[str, Any]) -> str:
    """The inputs in which a comparison differs from its model, as "at 0.5 ns as at 0.2 ns"."""
    inputs, others = claim["rests_on"], model["rests_on"]
    changed = [key for key in inputs if inputs[key] != others[key]]
    new, old = (
        ", ".join(
            with_unit(claims[name]["printed"], claims[name]["unit"])
            for key in changed
            for name in rests_on[key]
        )
        for rests_on in (inputs, others)
    )
    return f"at {new} as at {old}"


def _finding(claim: dict[str, Any], findings: list[dict[str, Any]]) -> dict[str, Any] | None:
    return next((finding for finding in findings if claim["id"] in finding["claims"]), None)
