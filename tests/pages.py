"""Check what must hold for every HTML page that the program writes."""

import re
from base64 import b64encode
from collections import Counter
from hashlib import sha256
from xml.etree import ElementTree as ET

import html5lib

HTML, SVG = "{http://www.w3.org/1999/xhtml}", "{http://www.w3.org/2000/svg}"


def sound(text: str) -> ET.Element:
    """Check that a page is valid HTML, runs and loads nothing, and that every link has a target."""
    root: ET.Element = html5lib.HTMLParser(strict=True).parse(text)
    assert not list(root.iter(f"{HTML}script"))
    attributes = {name for element in root.iter() for name in element.attrib}
    assert not {name for name in attributes if name in ("style", "src") or name.startswith("on")}
    (style,) = root.iter(f"{HTML}style")
    (policy,) = (m.get("content", "") for m in root.iter(f"{HTML}meta") if m.get("http-equiv"))
    digest = b64encode(sha256((style.text or "").encode()).digest()).decode()
    assert policy.split("; ")[:2] == ["default-src 'none'", f"style-src 'sha256-{digest}'"]
    assert not re.search(r"@import|url\((?!#)", text)
    for element in root.iter():
        target = element.get("href", "#")
        if not target.startswith("#"):  # the address of a public source: followed, not loaded
            assert (element.tag, element.get("rel")) == (f"{HTML}a", "noreferrer")
    ids = Counter(e.get("id") for e in root.iter() if e.get("id"))
    assert not [name for name, count in ids.items() if count > 1]
    wanted = {h[1:] for e in root.iter() if (h := e.get("href", "")).startswith("#")}
    wanted |= {name for e in root.iter() for name in e.get("aria-labelledby", "").split()}
    assert wanted | set(re.findall(r"url\(#([^)]+)\)", text)) <= set(ids)
    return root
