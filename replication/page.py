"""Fill the templates of a package, and write the head that every HTML page shares."""

from base64 import b64encode
from collections.abc import Mapping
from hashlib import sha256
from importlib import resources
from typing import Any


def from_template(
    package: str, name: str, parts: Mapping[str, Any], filters: Mapping[str, Any]
) -> str:
    """Fill a template from a package's folder with `parts`.

    HTML templates escape every value that is not Markup.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader(package, ""),
        autoescape=lambda name: str(name).endswith(".html.j2"),  # noqa: S701  (only HTML needs it)
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        optimized=False,  # there are no constant expressions to compute beforehand
    )
    environment.filters |= filters
    return environment.get_template(name).render(parts)


def head(*packages: str) -> str:
    """Write the start of a page's <head>, with the style sheets of these packages, as Markup.

    The content security policy forbids scripts and everything loaded from outside. It allows the
    style sheet by its hash.
    """
    from markupsafe import Markup

    style = "".join((resources.files(name) / "page.css").read_text("utf-8") for name in packages)
    digest = b64encode(sha256(style.encode()).digest()).decode()
    return Markup(  # noqa: S704  (the files are part of this program)
        f"""\
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; \
style-src 'sha256-{digest}'; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<style>{style}</style>"""
    )
