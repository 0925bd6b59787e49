"""The audit as one page: `audit.html`, from its record and its figures."""

import re
from base64 import b64encode
from collections.abc import Sequence
from hashlib import sha256
from importlib import resources
from itertools import groupby
from typing import TYPE_CHECKING, Any

from reference.findings import STATUSES
from replication.reports import shown
from replication.reports.comparison import shown_range
from replication.reports.failing import failing
from replication.reports.figures.drawing import Drawing
from replication.reports.gauge import Gauge, gauge
from replication.reports.glossary import CAPTIONS, KINDS, SYMBOLS, VERDICTS
from replication.text import number
from spreadsheets.sheets.audit import UNITS

if TYPE_CHECKING:
    from markupsafe import Markup

__all__ = ["page"]


def page(record: dict[str, Any], drawings: Sequence[Drawing]) -> str:
    """The page: no script, nothing from outside, its style named in its content policy by hash.

    `record` is the document of `audit.json`.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined
    from markupsafe import Markup

    style = (resources.files("replication.reports") / "page" / "page.css").read_text("utf-8")
    environment = Environment(
        loader=PackageLoader("replication.reports", "page"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "number": number, "plain": shown.plain, "prose": _prose, "slug": _slug, "unit": _unit,
    }  # fmt: skip
    return environment.get_template("page.html.j2").render(
        record,
        style=Markup(style),  # noqa: S704  (our own file)
        style_hash=b64encode(sha256(style.encode()).digest()).decode(),
        figures={
            one.name: Markup(one.svg)  # noqa: S704  (our own drawing)
            for one in drawings
        },
        sections=_sections(record["claims"]),
        by_id={claim["id"]: claim for claim in record["claims"]},
        touched_by=_touched_by(record["findings"]),
        picture=_picture,
        quoted=_quoted,
        captions=CAPTIONS,
        failing=failing(record),
        kinds=KINDS,
        shown=shown,
        shown_range=shown_range,
        statuses=STATUSES,
        symbols=SYMBOLS,
        verdicts=VERDICTS,
    )


def _sections(claims: list[dict[str, Any]]) -> list[tuple[str, list[dict[str, Any]]]]:
    """The claims by section of the report, in its order; those of the table by themselves."""
    return [(name, list(group)) for name, group in groupby(claims, shown.section)]


def _touched_by(findings: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """The findings that name a claim, by its id."""
    touched: dict[str, list[dict[str, Any]]] = {}
    for finding in findings:
        for claim in finding["claims"]:
            touched.setdefault(claim, []).append(finding)
    return touched


def _picture(claim: dict[str, Any]) -> Gauge | None:
    if claim["computed"] is None or claim["interval"] is None:
        return None
    return gauge(claim["interval"], claim["computed"], claim["enclosure"])


def _quoted(claim: dict[str, Any]) -> tuple[str, str, str]:
    """The quote before the printed text, that text, and the quote after it."""
    before, _, rest = claim["quote"].partition("⟦")
    inside, _, after = rest.partition("⟧")
    return before, inside, after


def _unit(unit: str) -> str:
    """A unit as it is written after a number; nothing for a pure number."""
    return "" if unit == "1" else f"\N{NO-BREAK SPACE}{UNITS.get(unit, unit)}"


_NAMES = "|".join(re.escape(name) for name in sorted(UNITS, key=len, reverse=True) if name != "1")


def _prose(text: str) -> "Markup":
    r"""Sentences with the units after numbers as they are written, and *emphasis*.

    >>> print(_prose("2 um deep, *at most* 7863.3 kg/m^3").replace("\xa0", "~"))
    2~µm deep, <em>at most</em> 7863.3~kg/m³
    """
    from markupsafe import Markup, escape

    units = re.sub(rf"(?<=[\d\])]) ({_NAMES})(?!\w)", lambda found: _unit(found[1]), text)
    escaped = str(escape(shown.plain(units)))
    return Markup(re.sub(r"\*(\w[\w ]*)\*", r"<em>\1</em>", escaped))  # noqa: S704  (escaped)


def _slug(text: str) -> str:
    return text.lower().replace(" ", "-").replace(".", "-")
