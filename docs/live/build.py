"""Build the page that proves the audit again in its reader's browser.

    python docs/live/build.py FOLDER

FOLDER becomes a folder of files that any web server can give out, with nothing to run there. The
parts that are not of this project (`parts.toml`) are fetched by npm and pip and checked by their
hashes. What cannot be had is said in one line, with exit status 2, and nothing is left behind.
"""

import argparse
import html
import json
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import tomllib
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]

OWN = ("page.js", "files.js", "python.js", "prove.js", "model.js", "worker.js", "answers.py")
"""Files of this folder that are given out as they are."""

LOADED = (".mjs", ".wasm", ".zip", ".whl", ".py")
"""What the worker loads when Python starts, by the end of the name."""

PYTHON_OF_WHEELS = (
    "--platform=pyemscripten_2026_0_wasm32", "--python-version=3.14", "--implementation=cp",
    "--abi=cp314",
)  # fmt: skip
"""Options of pip for wheels that fit this Pyodide."""

Parts = Mapping[str, Mapping[str, Any]]


class BuildError(Exception):
    """What cannot be had, in one line."""


def build(folder: Path) -> None:
    """Build the page in a new folder. Raises BuildError."""
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise BuildError(f"{folder} exists and is not empty: give a new folder, or remove it")
    if not folder.parent.is_dir():
        raise BuildError(f"{folder.parent} is not a folder: make it first")
    parts = tomllib.loads((HERE / "parts.toml").read_text("utf-8"))
    # Beside the folder, so that the finished one is only renamed; it goes if anything fails.
    with tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent) as scratch:
        made, fetched = Path(scratch) / "made", Path(scratch) / "fetched"
        made.mkdir()
        fetched.mkdir()
        lock = _take_parts(parts, fetched, made)
        wheel = _wheel_of_project(Path(scratch) / "source", made)
        _stored_audit(wheel, Path(scratch) / "program", made)
        _pages(parts, made)
        shutil.copytree(HERE / "licences", made / "licences")
        (made / "files.json").write_text(_list_of_files(made, lock), "utf-8")
        made.chmod(0o755)
        if folder.exists():
            folder.rmdir()
        made.rename(folder)


def _take_parts(parts: Parts, fetched: Path, made: Path) -> dict[str, Any]:
    """Fetch all parts, check them, and put their files into `made`; return Pyodide's lock file.

    It has no packages: the worker unpacks the wheels itself.
    """
    lock = {}
    for name, part in parts.items():
        archive = fetched / part["archive"]
        if part["registry"] == "npm":
            _run(["npm", "pack", "--silent", f"{name}@{part['version']}"], fetched)
        else:
            options = ["--no-deps", "--only-binary=:all:", *PYTHON_OF_WHEELS, "--quiet"]
            pip = [sys.executable, "-m", "pip", "download", "--disable-pip-version-check"]
            _run([*pip, *options, f"{name}=={part['version']}"], fetched)
        if not archive.is_file():
            raise BuildError(f"{part['registry']} gave no {archive.name} for {name}")
        if (digest := sha256(archive.read_bytes()).hexdigest()) != part["sha256"]:
            raise BuildError(f"{archive.name} has SHA-256 {digest}, not that of parts.toml")
        if "files" not in part:
            shutil.copy(archive, made)
            continue
        with tarfile.open(archive) as package:
            for file in (*part["files"], "pyodide-lock.json"):
                content = package.extractfile(f"package/{file}")
                assert content is not None
                if file == "pyodide-lock.json":
                    lock = {"info": json.load(content)["info"], "packages": {}}
                else:
                    (made / file).write_bytes(content.read())
    return lock


def _run(command: list[str], folder: Path, **environment: str) -> None:
    """Run a program in a folder. Raises BuildError with the last line that it wrote."""
    if shutil.which(command[0]) is None:
        raise BuildError(f"{command[0]} is not installed: it fetches a part of the page")
    ended = subprocess.run(
        command, cwd=folder, env={**os.environ, **environment}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    if ended.returncode:
        last = (ended.stderr.strip() or ended.stdout.strip() or "no message").splitlines()[-1]
        raise BuildError(f"{' '.join(command)} failed: {last}")


def _wheel_of_project(source: Path, made: Path) -> Path:
    """Make the project's wheel from a copy: what an earlier build left does not get into it."""
    source.mkdir()
    for name in ("pyproject.toml", "README.md", "LICENSE", "coldspray.py"):
        shutil.copy(ROOT / name, source)
    for name in ("reference", "replication", "spreadsheets"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / name, source / name, ignore=ignored)
    pip = [sys.executable, "-m", "pip", "wheel", "--disable-pip-version-check", "--quiet"]
    # A fixed date makes the wheel the same bytes each time: 1980 is the first that a zip can have.
    _run([*pip, "--no-deps", "--wheel-dir", str(made), "."], source, SOURCE_DATE_EPOCH="315619200")
    (wheel,) = made.glob("coldspray-*.whl")
    return wheel


def _stored_audit(wheel: Path, program: Path, made: Path) -> None:
    """Write `audit.html` and `audit.json`, by the program in the wheel.

    So the stored audit is that of the program that the page has, and names its version, whatever
    version is installed here; only the libraries are the installed ones.
    """
    shutil.unpack_archive(wheel, program, "zip")
    sys.path.insert(0, str(program))
    try:
        from replication.audit.audit import audit
        from replication.report import contents
    except ModuleNotFoundError as error:
        raise BuildError(f"{error.name} is not installed: python -m pip install .") from error
    files = contents(audit(), {})
    for name in ("audit.html", "audit.json"):
        (made / name).write_bytes(files[name])


def _pages(parts: Parts, made: Path) -> None:
    """Write `index.html` around the stored audit, the style sheet, and the page of the parts."""
    stored = (made / "audit.html").read_text("utf-8")
    body = stored.partition("<body>\n")[2].partition("</body>")[0]
    head, end_of_head, rest = body.partition("</header>\n")
    title = stored.partition("<title>")[2].partition("</title>")[0]
    contents = {
        "<!-- build.py puts the head of the stored audit here -->\n": head + end_of_head,
        "<!-- build.py puts the rest of the stored audit here -->\n": rest,
        "An audit that proves itself again": title,
    }
    page = _filled((HERE / "index.html").read_text("utf-8"), contents)
    (made / "index.html").write_text(page, "utf-8")
    style = (ROOT / "replication/report/page.css", HERE / "live.css")
    (made / "style.css").write_text("".join(path.read_text("utf-8") for path in style), "utf-8")
    for name in OWN:
        shutil.copy(HERE / name, made)
    (made / "parts.html").write_text(_page_of_parts(parts), "utf-8")


def _page_of_parts(parts: Parts) -> str:
    """Say of each part, and of what it contains, its licence, and where its source is."""
    items = ""
    for name, part in parts.items():
        items += (
            f"<li>{_named(name, part, part['registry'])} "
            f"SHA-256 of {html.escape(part['archive'])}: <code>{part['sha256']}</code></li>\n"
        )
        for contained in part.get("contains", ()):
            items += f"<li>{_named(contained['name'], contained, part['archive'])}</li>\n"
    page = (HERE / "parts.html").read_text("utf-8")
    return _filled(page, {"<!-- build.py puts the parts here -->": items})


def _named(name: str, part: Mapping[str, Any], origin: str) -> str:
    """Return the name, origin, licence and source of a part as HTML."""
    return (
        f"<strong>{html.escape(name)} {html.escape(part['version'])}</strong>, from "
        f"{html.escape(origin)}: {html.escape(part['licence'])}. "
        f'<a href="{html.escape(part["source"])}" rel="noreferrer">Source</a>.'
    )


def _filled(page: str, contents: Mapping[str, str]) -> str:
    """Put each content into the page, at its place: a text that the page has once."""
    for place, content in contents.items():
        before, here, after = page.partition(place)
        assert here, place
        page = before + content + after
    return page


def _list_of_files(made: Path, lock: dict[str, Any]) -> str:
    """Return `files.json`: all files with sizes and hashes, and what Python needs to start."""
    paths = sorted(path for path in made.rglob("*") if path.is_file())
    files = {
        path.relative_to(made).as_posix(): {
            "bytes": path.stat().st_size,
            "sha256": sha256(path.read_bytes()).hexdigest(),
        }
        for path in paths
    }
    loads = [name for name in files if name.endswith(LOADED)]
    return json.dumps({"files": files, "loads": loads, "lock": lock}, indent=1) + "\n"


def main() -> int:
    """Read the command line, build, and say what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="a new folder")
    folder = parser.parse_args().folder.absolute()
    try:
        build(folder)
    except (BuildError, OSError) as error:
        print(f"build.py: {error}", file=sys.stderr)
        return 2
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    print(
        f"{folder}: {size / 1e6:.1f} MB. To look at it on this machine: python -m http.server -d "
        f"{folder} (then http://localhost:8000); other machines need a host with https"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
