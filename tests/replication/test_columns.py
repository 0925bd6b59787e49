"""Columns of numbers from text files: heads with units, and what is wrong with which row."""

import re
from pathlib import Path

import pytest

from replication.columns import column_of, name_and_unit, read_columns


@pytest.mark.parametrize(
    ("head", "name", "unit"),
    [
        ("velocity", "velocity", ""),
        ("Impact Velocity [m/s]", "impact velocity", "m/s"),
        ("depth (um)", "depth", "um"),
        ("depth, um", "depth", "um"),
        ("depth/um", "depth", "um"),
        ("v/(m/s)", "v", "m/s"),
        ("v / m/s", "v", "m/s"),
        ("penetration_depth_um", "penetration depth", "um"),
        ("particle density kg/m^3", "particle density", "kg/m^3"),
        ("particle density [kg/m³]", "particle density", "kg/m³"),
        ("time ns", "time", "ns"),
        ("x/R [-]", "x/r", "1"),
        ("dx/dt initial", "dx/dt initial", ""),
        ("m", "m", ""),
        ("depth in um", "depth", "um"),
        ("Tiefe in [µm]", "tiefe", "µm"),
        ("depth in", "depth", "in"),
        ("", "", ""),
    ],
)
def test_the_name_and_the_unit_in_a_head(head: str, name: str, unit: str) -> None:
    assert name_and_unit(head) == (name, unit)


@pytest.mark.parametrize(
    "content",
    [
        pytest.param("velocity [m/s],depth [um]\n400,6.1\n500,7.6\n", id="commas"),
        pytest.param("velocity [m/s];depth [um]\n400;6.1\n500;7.6\n", id="semicolons"),
        pytest.param("velocity [m/s]\tdepth [um]\n400\t6.1\n500\t7.6", id="tabs, no last line end"),
        pytest.param('"velocity, m/s","depth, um"\r\n"400","6.1"\r\n500, 7.6 \r\n', id="quoted"),
        pytest.param("# mine\n\nvelocity_m/s,depth_um,\n400,6.1,\n\n,,\n#\n500,7.6\n",
                     id="comments, empty rows and cells"),
        pytest.param("\ufeffvelocity,depth\n400 m/s,0.0061 mm\n500,7.6e-6\n",
                     id="a byte order mark, units in cells"),
        pytest.param("velocity [m/s];depth [um]\n400;6,1\n500;7,6\n", id="decimal commas"),
        pytest.param("velocity [m/s]\tdepth [um]\n400\t6,1\n500\t7,6\n", id="commas after tabs"),
        pytest.param("sep=;\r\nvelocity [m/s];depth [um]\r\n400;6,1\r\n500;7,6\r\n",
                     id="a stated separator"),
        pytest.param("velocity[m/s]   depth[um]\n 400  6.1\n 500  7.6\n", id="blanks"),
        pytest.param("velocity [m/s] | depth [um]\n400 | 6.1\n500 | 7.6D+00\n", id="bars, Fortran"),
        pytest.param("# my own\n# velocity [m/s],depth [um]\n400,6.1\n500,7.6\n",
                     id="heads in a comment"),
        pytest.param("# velocity [m/s],depth [um]\n# of my own\n400,6.1\n500,7.6\n",
                     id="heads in the first of two comments"),
        pytest.param("velocity,depth\nm/s,[um]\n400,6.1\n500,7.6\n", id="units below the heads"),
        pytest.param('"velocity, m/s";"depth, um"\n"400,0";"6,1"\n500;"7,6 um"\n',
                     id="more commas than semicolons"),
        pytest.param("velocity [m/s],depth [um],remark\n400,6.1,ok\n500,7.6,best of all\n",
                     id="texts beside the numbers"),
    ],
)  # fmt: skip
def test_columns_are_read_in_si_units_whatever_separates_them(content: str, tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(content, "utf-8")
    velocity, depth, *_ = read_columns(file)
    assert (velocity.name, depth.name) == ("velocity", "depth")
    assert velocity.numbers("m/s") == [400.0, 500.0]
    assert depth.numbers("m") == [6.1e-6, 7.6e-6]


@pytest.mark.parametrize("encoding", ["cp1252", "utf-8", "utf-8-sig", "utf-16"])
def test_a_file_is_read_however_it_is_encoded(encoding: str, tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_bytes("Aufprallgeschwindigkeit in m/s;Tiefe in µm\r\n500;7,6\r\n".encode(encoding))
    velocity, depth = read_columns(file)
    assert (velocity.unit, depth.unit) == ("m/s", "µm")
    assert depth.numbers("m") == [7.6e-6]


def test_cells_keep_their_text_and_their_line(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("v,x\n\n5.00E+02,3.10\n# no\n499,4\n", "utf-8")
    velocity, depth = read_columns(file)
    assert velocity.texts == ("5.00E+02", "499")
    assert (depth.texts, depth.lines) == (("3.10", "4"), (3, 5))
    assert column_of([velocity, depth], ["depth", "x"]) is depth
    assert column_of([velocity, depth], ["time", "t"]) is None


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "FILE: has no row of numbers below a row of heads"),
        (b"v,x\n", "FILE: has no row of numbers below a row of heads"),
        (b"v,v\n1,2\n", "FILE, line 1: two columns have the head 'v'"),
        (b"v,,x\n1,2,3\n", "FILE, line 1: column 2 has no head"),
        (b"v,x\n1,2\n1,2,3\n", "FILE, line 3: has more cells than there are heads"),
        (b"\xff\xfev,x", "FILE: is not text: give rows of numbers as CSV in UTF-8"),
        (b"PK\x03\x04\0", "FILE: is not text: give rows of numbers as CSV"),
        (b"500,7.6\n400,6.1\n", "FILE: line 1 has numbers, but no row of heads above it: give each "
         "column a head, such as 'velocity [m/s]'"),
        (b"v;x\n1.300;14,46\n", "FILE, line 2: '1.300' has a point, and '14,46' in line 2 a comma: "
         "write all decimal marks alike, and no marks of thousands"),
        (b"sep=;\nv;x\n1;2\n1;2;3\n", "FILE, line 4: has more cells than there are heads"),
        (b'v,x\n1,"2\n' + 200_000 * b"3", "FILE: line 3 is not CSV: field larger than field limit "
         "(131072)"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_file(content: bytes, message: str, tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_bytes(content)
    with pytest.raises(ValueError, match=f"^{re.escape(message.replace('FILE', str(file)))}$"):
        read_columns(file)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("v [m/s]\n500\nfast\n", "FILE, line 3, column 'v [m/s]': 'fast' is not a finite "
         "number with or without a unit, such as '1 m/s'"),
        ("v,x\n500,1\n,2\nnan,3\n,4\n", "FILE, line 3, column 'v': the cell is empty (line 4, "
         "line 5, too)"),
        ("v\n" + "x\n" * 8, "FILE, line 2, column 'v': 'x' is not a finite number with or without "
         "a unit, such as '1 m/s' (line 3, line 4, line 5, line 6, line 7, 2 more, too)"),
        ("v [um]\n500\n", "FILE, column 'v [um]': um does not measure what m/s does"),
        ("v [knots]\n500\n", "FILE, column 'v [knots]': unknown unit 'knots': convert it to m/s"),
        ("v [cubits]\n500\n", "FILE, column 'v [cubits]': unknown unit 'cubits': take one such as "
         "um, ns, m/s, kg/m^3, MPa or ksi"),
        ('v [m/s],x\n"5,5",1\n', "FILE, line 2, column 'v [m/s]': '5,5': write a decimal comma as "
         "a point, and thousands without a comma"),
        ("v [m/s],x\n5 km/s,1\n", "FILE, line 2, column 'v [m/s]': '5 km/s' has another unit than "
         "the head of its column"),
        ("v [m/s],x\n5 um,1\n", "FILE, line 2, column 'v [m/s]': '5 um' has another unit than the "
         "head of its column"),
    ],
)  # fmt: skip
def test_cells_that_are_no_numbers_are_named_by_line(
    content: str, message: str, tmp_path: Path
) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(content, "utf-8")
    velocity = read_columns(file)[0]
    with pytest.raises(ValueError, match=f"^{re.escape(message.replace('FILE', str(file)))}$"):
        velocity.numbers("m/s")


def test_a_file_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        read_columns(tmp_path / "none.csv")
    with pytest.raises(ValueError, match=r"^/dev/null is a device, not a file$"):
        read_columns(Path("/dev/null"))


def test_two_columns_for_one_quantity(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("v,impact velocity\n1,2\n", "utf-8")
    message = f"{file}: 'v' and 'impact velocity' both may be the velocity: rename one of them"
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        column_of(read_columns(file), ["velocity", "impact velocity", "v"])
