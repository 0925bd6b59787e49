"""The templates of a package, filled; and what the head of every page has."""

from base64 import b64encode
from collections.abc import Mapping
from hashlib import sha256
from importlib import resources
from typing import Any


def filled(package: str, name: str, parts: Mapping[str, Any], filters: Mapping[str, Any]) -> str:
    """A template that stands beside a package's modules, filled with parts.

    All that an HTML template shows is escaped, unless it is Markup.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader(package, ""),
        autoescape=lambda name: str(name).endswith(".html.j2"),  # noqa: S701  (all HTML there is)
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        optimized=False,  # the templates hold no constant expressions that this could compute
    )
    environment.filters |= filters
    return environment.get_template(name).render(parts)


def head(*packages: str) -> str:
    """How a page's head begins, as Markup: with the style sheets of these packages.

    The content policy forbids scripts and all from outside, and names the style by its hash.
    """
    from markupsafe import Markup

    style = "".join((resources.files(name) / "page.css").read_text("utf-8") for name in packages)
    digest = b64encode(sha256(style.encode()).digest()).decode()
    return Markup(  # noqa: S704  (our own files)
        f"""\
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; \
style-src 'sha256-{digest}'; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<style>{style}</style>"""
    )
