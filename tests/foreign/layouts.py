"""Workbooks as other people lay out the report's sheet: each function is one engineer's habits.

They were written before the program that reads them and share nothing with it: cells, formulas and
heads as somebody would type them, and where what stands. Rows are numbered as in the report: row 0
is the impact, row 1 the first step. `faults.py` spoils them, `writers.py` makes files of them.
"""

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

from openpyxl.utils.cell import column_index_from_string, get_column_letter

from replication.models.impact import Impact
from replication.models.sheet import run

Place = tuple[str, int, int]
"""Sheet, row and column, both counted from 1."""
Content = str | float | None
"""What a cell holds; None leaves it blank."""

TIME = "time"
START = "velocity_initial"
DEPTH = "depth"
BRAKE = "deceleration"
END = "velocity_final"

letters = get_column_letter


def place(sheet: str, address: str) -> Place:
    letters = address.rstrip("0123456789")
    return sheet, int(address[len(letters) :]), column_index_from_string(letters)


@dataclass(frozen=True)
class Column:
    """A column of a table: its role, "" for one beside the scheme, its head, and what it holds.

    In the formulas {r} is their own row, {p} the row before, {k} the number of the step. `first` is
    that of row 1, where it is another than in the rows that follow.
    """

    role: str
    letter: str
    head: str
    zero: Content
    rest: str
    first: str | None = None

    def content(self, k: int, row: int | str, before: int | str) -> Content:
        text = self.zero if k == 0 else self.first if k == 1 and self.first else self.rest
        if not isinstance(text, str):
            return text
        if text == "{k}":
            return k
        return text.format(r=row, p=before, k=k)


@dataclass
class Foreign:
    """A workbook before it is a file: contents by place, and what is where."""

    name: str
    impact: Impact
    cells: dict[Place, str | float] = field(default_factory=dict)
    where: dict[tuple[str, int], Place] = field(default_factory=dict)
    inputs: dict[str, Place] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)
    si: bool = True
    """Whether every cell is in SI, so that its last digits can be judged."""

    @property
    def steps(self) -> int:
        return _steps(self.impact)

    def put(self, sheet: str, address: str, content: str | float) -> None:
        self.cells[place(sheet, address)] = content

    def line(self, sheet: str, address: str, *contents: Content) -> None:
        """Cells beside each other."""
        _, row, column = place(sheet, address)
        for i, content in enumerate(contents):
            if content is not None:
                self.cells[sheet, row, column + i] = content

    def given(self, sheet: str, address: str, *lines: tuple[Content, ...]) -> None:
        """Lines below each other: the input that each is, or "", its label, its number and so on.

        The input is in the first cell of its line that holds a number; behind a label alone stands
        what the impact has, in SI.
        """
        _, row, column = place(sheet, address)
        for r, (role, *contents) in enumerate(lines, row):
            if role and len(contents) == 1 and isinstance(contents[0], str):
                name = "target_resistance" if role == "resistance" else str(role)
                contents.append(getattr(self.impact, name))
            self.line(sheet, f"{letters(column)}{r}", *contents)
            if role:
                at = next(i for i, c in enumerate(contents) if isinstance(c, int | float))
                self.inputs[str(role)] = (sheet, r, column + at)

    def table(
        self, sheet: str, zero: int, columns: Sequence[Column], heads: int | None = None,
        steps: int | None = None,
    ) -> None:  # fmt: skip
        """A table whose row 0 stands in row `zero`, its heads above or in row `heads`."""
        steps = self.steps if steps is None else steps
        for column in columns:
            if column.head:
                self.put(sheet, f"{column.letter}{heads or zero - 1}", column.head)
            for k in range(steps + 1):
                content = column.content(k, zero + k, zero + k - 1)
                if content is not None:
                    here = place(sheet, f"{column.letter}{zero + k}")
                    self.cells[here] = content
                    if column.role and k <= self.steps:
                        self.where[column.role, k] = here


@cache
def _steps(impact: Impact) -> int:
    return run(impact).steps


def moved(f: Foreign, rows: Callable[[int], int], columns: Callable[[int], int]) -> None:
    """Move every cell of a lone sheet as a spreadsheet does when rows or columns are inserted."""

    def address(match: re.Match[str]) -> str:
        _, row, column = place("", f"{match[2]}{match[4]}")
        return f"{match[1]}{letters(columns(column))}{match[3]}{rows(row)}"

    def content(c: str | float) -> str | float:
        if isinstance(c, str) and c.startswith("="):
            return re.sub(r"(\$?)\b([A-Z]{1,2})(\$?)(\d+)\b(?!\()", address, c)
        return c

    f.cells = {(s, rows(r), columns(c)): content(v) for (s, r, c), v in f.cells.items()}


def table_a1(impact: Impact) -> Foreign:
    """The report's own table: blank column B, step and target density typed into the formulas."""
    f = Foreign("table-a1", impact)
    f.given(
        "Sheet1", "A1",
        ("radius", "R ="), ("particle_density", "Density ="), ("", "M =", "=B2*4/3*PI()*B1*B1*B1"),
        ("", "D =", "=2*B1"), ("velocity", "Initial vel ="), ("resistance", "Rt ="),
    )  # fmt: skip
    force = "=(0.5*7850*C{r}^2+$B$6)*PI()*($B$4*D{r}-D{r}^2)/$B$3"
    f.table("Sheet1", 8, [
        Column(TIME, "A", "Time", 0, "=A{p}+0.0000000002", "=1*0.0000000002"),
        Column(START, "C", "dx/dt initial", "=B5", "=F{p}", "=C{p}"),
        Column(DEPTH, "D", "x", 0, "=D{p}+C{r}*0.0000000002", "=C{r}*0.0000000001"),
        Column(BRAKE, "E", "d²x/dt²", 0, force),
        Column(END, "F", "dx/dt final", None, "=C{r}-E{r}*0.0000000002"),
    ])  # fmt: skip
    return f


def german(impact: Impact) -> Foreign:
    """Eingaben links in handlichen Einheiten, SI daneben; Tabelle darunter in µm und ns."""
    f = Foreign("german", impact, si=False)
    s = "Rechnung"
    f.put(s, "A1", "Eindringen einer starren Kupferkugel in Edelstahl")
    f.line(s, "B3", "Wert", "Einheit", "SI")
    f.given(
        s, "A4",
        ("radius", "Partikelradius R", 11, "µm", "=B4*0.000001"),
        ("particle_density", "Dichte Partikel", 8.9, "g/cm³", "=B5*1000"),
        ("target_density", "Dichte Ziel", 7.85, "g/cm³", "=B6*1000"),
        ("flow_stress", "Fließspannung", 700, "MPa", "=B7*1000000"),
        ("beta", "Faktor beta", impact.beta, "-", "=B8"),
        ("velocity", "Auftreffgeschwindigkeit", 500, "m/s", "=B9"),
        ("step", "Zeitschritt", 0.2, "ns", "=B10*0.000000001"),
        ("stop_velocity", "Abbruchgeschwindigkeit", 1, "m/s", "=B11"),
        ("", "Durchmesser D", None, None, "=2*D4"),
        ("", "Masse M [kg]", None, None, "=4/3*PI()*D4^3*D5"),
        ("", "Zielwiderstand R_t [Pa]", None, None, "=D8*D7"),
    )  # fmt: skip
    half = "=C{r}*$D$10/2*1000000"
    f.table(s, 18, [
        Column("", "A", "Schritt", 0, "=A{p}+1"),
        Column(TIME, "B", "Zeit [ns]", 0, "=A{r}*$B$10"),
        Column(START, "C", "v Anfang [m/s]", "=D9", "=G{p}", "=C18"),
        Column(DEPTH, "D", "Eindringtiefe [µm]", 0, "=D{p}+C{r}*$D$10*1000000", half),
        Column("", "E", "Kontaktfläche [µm²]", 0, "=PI()*($D$12*1000000*D{r}-D{r}^2)"),
        Column(BRAKE, "F", "Verzögerung [m/s²]", 0,
               "=(0.5*$D$6*C{r}^2+$D$14)*E{r}*0.000000000001/$D$13"),
        Column(END, "G", "v Ende [m/s]", None, "=C{r}-F{r}*$D$10"),
    ])  # fmt: skip
    f.line(s, "F4", "Endtiefe [µm]", f"=D{18 + f.steps}")
    f.line(s, "F5", "X/R", "=G4/B4")
    return f


def french(impact: Impact) -> Foreign:
    """Données sur une feuille, noms définis, calcul sur une autre, commencé loin du coin."""
    f = Foreign("french", impact)
    f.given(
        "Données", "B3",
        ("radius", "rayon de la particule (m)"),
        ("particle_density", "masse volumique du cuivre (kg/m3)"),
        ("target_density", "masse volumique de la cible (kg/m3)"),
        ("flow_stress", "contrainte d'écoulement (Pa)", 700000000),
        ("beta", "bêta"), ("velocity", "vitesse d'impact (m/s)"), ("step", "pas de temps (s)"),
        ("stop_velocity", "vitesse d'arrêt (m/s)"),
    )  # fmt: skip
    f.line("Données", "B12", "résistance de la cible (Pa)", "=beta*Y_c")
    f.line("Données", "B13", "masse (kg)", "=rho_p*4/3*PI()*rayon*rayon*rayon")
    names = ["rayon", "rho_p", "rho_c", "Y_c", "beta", "V_0", "delta_t", "v_arret", "", "R_cible",
             "masse"]  # fmt: skip
    f.names = {name: f"'Données'!$C${r}" for r, name in enumerate(names, 3) if r != 11}
    area = "(2*rayon*G{r}-G{r}*G{r})"
    f.table("Calcul pas à pas", 21, [
        Column(TIME, "E", "temps (s)", 0, "=E{p}+delta_t"),
        Column(START, "F", "vitesse initiale", "=V_0", "=I{p}", "=V_0"),
        Column(DEPTH, "G", "profondeur (m)", 0, "=G{p}+F{r}*delta_t", "=F{r}*(delta_t/2)"),
        Column(BRAKE, "H", "décélération", 0,
               f"=(0.5*rho_c*F{{r}}*F{{r}}+R_cible)*PI()*{area}/masse"),
        Column(END, "I", "vitesse finale", None, "=F{r}-H{r}*delta_t"),
    ])  # fmt: skip
    return f


def sideways(impact: Impact) -> Foreign:
    """Time runs to the right; labels at the left, with units in the next cell."""
    f = Foreign("sideways", impact)
    s = "Sheet 1"
    f.given(
        s, "B2",
        ("velocity", "V", impact.velocity, "m/s"),
        ("radius", "R", impact.radius, "m"),
        ("particle_density", "rho_p", impact.particle_density, "kg/m^3"),
        ("target_density", "rho_t", impact.target_density, "kg/m^3"),
        ("resistance", "R_t", impact.target_resistance, "Pa"),
        ("step", "dt", impact.step, "s"),
        ("", "M", "=C4*4/3*PI()*C3*C3*C3", "kg"),
    )  # fmt: skip
    force = "=(0.5*$C$5*{r}12^2+$C$6)*PI()*(2*$C$3*{r}13-{r}13^2)/$C$8"
    for row, unit, line in (
        (11, "s", Column(TIME, "", "t", 0, "={p}11+$C$7")),
        (12, "m/s", Column(START, "", "v_i", "=C2", "={p}15", "={p}12")),
        (13, "m", Column(DEPTH, "", "x", 0, "={p}13+{r}12*$C$7", "={r}12*$C$7/2")),
        (14, "m/s^2", Column(BRAKE, "", "a", 0, force)),
        (15, "m/s", Column(END, "", "v_f", None, "={r}12-{r}14*$C$7")),
    ):
        f.line(s, f"B{row}", line.head, unit)
        for k in range(f.steps + 1):
            content = line.content(k, letters(4 + k), letters(3 + k))
            if content is not None:
                f.where[line.role, k] = (s, row, 4 + k)
                f.cells[s, row, 4 + k] = content
    return f


def no_time(impact: Impact) -> Foreign:
    """Rows numbered behind, no time; area, force and energy beside; inputs under the table."""
    f = Foreign("no-time", impact)
    s = "impact"
    base = 9 + f.steps
    f.given(
        s, f"H{base}",
        ("velocity", "impact velocity (m/s)", None, impact.velocity),
        ("radius", "particle radius (m)", None, impact.radius),
        ("particle_density", "particle density (kg/m3)", None, impact.particle_density),
        ("target_density", "target density (kg/m3)", None, impact.target_density),
        ("flow_stress", "target strength (Pa)", None, 700e6),
        ("beta", "beta", None, impact.beta),
        ("step", "time step (s)", None, impact.step),
    )  # fmt: skip
    v, radius, rho_p, rho_t, stress, beta, dt = (f"$J${base + i}" for i in range(7))
    mass = f"$J${base + 8}"
    f.line(s, f"H{base + 8}", "mass (kg)", None, f"=4*PI()/3*{radius}^3*{rho_p}")
    r, p = "{r}", "{p}"
    f.table(s, 5, [
        Column(START, "C", "v start", f"={v}", "=H{p}", "=C{p}"),
        Column(DEPTH, "D", "depth x", 0, f"=D{p}+C{r}*{dt}", f"=C{r}*{dt}/2"),
        Column("", "E", "A(x)", None, f"=PI()*(2*{radius}*D{r}-D{r}^2)"),
        Column("", "F", "force", None, f"=(0.5*{rho_t}*C{r}^2+{beta}*{stress})*E{r}"),
        Column(BRAKE, "G", "acceleration", None, f"=F{r}/{mass}"),
        Column(END, "H", "v end", None, f"=C{r}-G{r}*{dt}"),
        Column("", "I", "kinetic energy", f"=0.5*{mass}*C5^2", f"=0.5*{mass}*C{r}^2"),
        Column("", "J", "n", 0, "{k}"),
    ])  # fmt: skip
    return f


def one_velocity(impact: Impact) -> Foreign:
    """One velocity a row, at its beginning; the next row takes it on. Acceleration negative."""
    f = Foreign("one-velocity", impact)
    s = "Tabelle1"
    f.given(s, "A1", ("velocity", "V0 [m/s]", impact.velocity), ("step", "dt [s]", impact.step))
    f.given(s, "C1", ("diameter", "D [m]", 2 * impact.radius),
            ("resistance", "Rt [Pa]", impact.target_resistance))  # fmt: skip
    f.given(s, "E1", ("target_density", "rho Ziel [kg/m3]"),
            ("particle_density", "rho Kugel [kg/m3]", impact.particle_density))  # fmt: skip
    f.line(s, "A3", "m [kg]", "=PI()/6*D1^3*F2")
    f.table(s, 6, [
        Column(TIME, "A", "t in s", 0, "={k}*$B$2"),
        Column(DEPTH, "B", "x in m", 0, "=B{p}+C{r}*$B$2", "=C{r}*$B$2/2"),
        Column(START, "C", "v in m/s", "=B1", "=C{p}+D{p}*$B$2"),
        Column(BRAKE, "D", "Beschleunigung in m/s²", 0,
               "=-(0.5*$F$1*C{r}^2+$D$2)*PI()*($D$1*B{r}-B{r}^2)/$B$3"),
    ])  # fmt: skip
    return f


def side_by_side(impact: Impact) -> Foreign:
    """Both betas on one sheet, each with its own table and resistance; `impact` is the left one."""
    f = Foreign("side-by-side", impact)
    s = "beta 3 and 5"
    f.given(
        s, "A1",
        ("radius", "R (m)"), ("", "D (m)", "=2*B1"), ("particle_density", "density of copper"),
        ("target_density", "density of steel"), ("", "M (kg)", "=B3*4/3*PI()*B1*B1*B1"),
        ("flow_stress", "Y (Pa)", 700e6),
        ("velocity", "V (m/s)"), ("step", "dt (s)"),
    )  # fmt: skip
    another = 3.0 if impact.beta == 5 else 5.0
    for (n, t, v, x, a, end), beta in (("HIJKLM", another), ("ABCDEF", impact.beta)):
        f.given(s, f"{n}11", ("beta", "beta", beta, "Rt", f"={t}11*B6"))
        vr, xr = f"{v}{{r}}", f"{x}{{r}}"
        force = f"=(0.5*$B$4*{vr}*{vr}+${x}$11)*PI()*($B$2*{xr}-{xr}*{xr})/$B$5"
        f.where.clear()  # those of the left one, which comes last
        f.table(s, 14, [
            Column("", n, "#", 0, "{k}"),
            Column(TIME, t, "time / s", f"={n}14*$B$8", f"={n}{{r}}*$B$8"),
            Column(START, v, "v1 / (m/s)", "=$B$7", f"={end}{{p}}", "=$B$7"),
            Column(DEPTH, x, "x / m", 0, f"={x}{{p}}+{vr}*$B$8", f"={vr}*$B$8/2"),
            Column(BRAKE, a, "a / (m/s2)", 0, force),
            Column(END, end, "v2 / (m/s)", None, f"={vr}-{a}{{r}}*$B$8"),
        ], steps=run(replace(impact, beta=beta)).steps)  # fmt: skip
    return f


def guarded(impact: Impact) -> Foreign:
    """Filled down to row 400, blank below the stop; two rows of heads, the second with units."""
    f = Foreign("guarded", impact)
    s = "Model"
    f.given(
        s, "J3",
        ("radius", "Particle radius", impact.radius, "m"),
        ("particle_density", "Particle density", impact.particle_density, "kg/m³"),
        ("target_density", "Target density", impact.target_density, "kg/m³"),
        ("velocity", "Impact speed", impact.velocity, "m/s"),
        ("resistance", "Target resistance", impact.target_resistance, "Pa"),
        ("step", "Time increment", impact.step, "s"),
        ("stop_velocity", "Stop below", impact.stop_velocity, "m/s"),
        ("", "Particle mass", "=K4*4/3*PI()*K3*K3*K3", "kg"),
    )  # fmt: skip

    def live(text: str) -> str:
        return f'=IF(ISNUMBER(B{{r}}),{text},"")'

    area = "IF(E{r}<$K$3,2*$K$3*E{r}-E{r}*E{r},$K$3*$K$3)"
    f.table(s, 5, [
        Column("", "B", "Step", 0, '=IF(N(G{p})<$K$9,"",B{p}+1)', "=B{p}+1"),
        Column(TIME, "C", "Time", 0, live("B{r}*$K$8")),
        Column(START, "D", "Initial speed", "=K6", live("G{p}"), live("$K$6")),
        Column(DEPTH, "E", "Penetration", 0, live("E{p}+D{r}*$K$8"), live("D{r}*$K$8/2")),
        Column(BRAKE, "F", "Deceleration", 0,
               live(f"(0.5*$K$5*D{{r}}*D{{r}}+$K$7)*PI()*{area}/$K$10")),
        Column(END, "G", "Final speed", None, live("D{r}-F{r}*$K$8")),
    ], heads=3, steps=395)  # fmt: skip
    f.line(s, "B4", "", "s", "m/s", "m", "m/s²", "m/s")
    f.line(s, "J12", "Final depth", "=MAX(E5:E400)", "m")
    f.line(s, "J13", "Depth / radius", "=K12/K3")
    return f


def pasted(impact: Impact) -> Foreign:
    """Values only, as a script wrote them: a data frame with its index, no inputs at all."""
    f = Foreign("pasted", impact)
    f.line("Sheet1", "B1", "t", "v0", "x", "a", "v1")
    for k in range(f.steps + 1):
        f.put("Sheet1", f"A{k + 2}", k)
    _values(f, "Sheet1", 2, "BCDEF", impact)
    return f


def natural_units(impact: Impact) -> Foreign:
    """Micrometres, nanoseconds and km/s = µm/ns throughout, so that formulas need no factors."""
    f = Foreign("natural-units", impact, si=False)
    s = "µm-ns"
    # mass in pg = 1e-15 kg: then pg/(µm ns²) = 1e-15/(1e-6 1e-18) = 1e9 Pa, so GPa fit, too,
    # and densities in pg/µm³ are those in g/cm³.
    f.given(
        s, "A1",
        ("radius", "R [µm]", 11),
        ("particle_density", "ρp [g/cm³]", 8.9),
        ("target_density", "ρt [g/cm³]", 7.85),
        ("resistance", "Rt [GPa]", 0.7 * (impact.beta or 0)),
        ("velocity", "V [km/s]", 0.5),
        ("step", "Δt [ns]", 0.2),
        ("", "M [ng/1000]", "=4/3*PI()*B1^3*B2"),
    )  # fmt: skip
    force = "=(0.5*$B$3*E{r}^2+$B$4)*PI()*(2*$B$1*F{r}-F{r}^2)/$B$7"
    f.table(s, 2, [
        Column(TIME, "D", "t [ns]", 0, "=D{p}+$B$6"),
        Column(START, "E", "v1 [km/s]", "=B5", "=H{p}", "=E2"),
        Column(DEPTH, "F", "x [µm]", 0, "=F{p}+E{r}*$B$6", "=E{r}*$B$6/2"),
        Column(BRAKE, "G", "a [µm/ns²]", 0, force),
        Column(END, "H", "v2 [km/s]", None, "=E{r}-G{r}*$B$6"),
    ])  # fmt: skip
    return f


def named_everything(impact: Impact) -> Foreign:
    """Symbols as in the paper, greek letters, blank columns between, notes above and below."""
    f = Foreign("named-everything", impact)
    s = "de Rosset (2006)"
    f.put(s, "B2", "Appendix, Table A-1")
    f.put(s, "B3", "rigid sphere; 0.2 ns steps; stop when dx/dt < 1 m/s")
    given = [
        ("B", "R", "Rp", impact.radius, "radius"),
        ("D", "ρₚ", "rhop", impact.particle_density, "particle_density"),
        ("F", "ρₜ", "rhot", impact.target_density, "target_density"),
        ("H", "β", "bet", impact.beta, "beta"),
        ("J", "Yₜ", "Yt", 700000000, "flow_stress"),
        ("L", "V", "Vimp", impact.velocity, "velocity"),
        ("N", "Δt", "dt_", impact.step, "step"),
    ]
    for letter, label, name, value, role in given:
        f.put(s, f"{letter}5", label)
        f.given(s, f"{letter}6", (role, value))
        f.names[name] = f"'{s}'!${letter}$6"
    f.put(s, "B8", "M")
    f.put(s, "B9", "=rhop*4/3*PI()*Rp*Rp*Rp")
    f.names["Mass"] = f"'{s}'!$B$9"
    f.table(s, 13, [
        Column(TIME, "B", "t", 0, "=B{p}+dt_"),
        Column(START, "D", "ẋ", "=Vimp", "=J{p}", "=D13"),
        Column(DEPTH, "F", "x(t)", 0, "=F{p}+D{r}*dt_", "=D{r}*dt_/2"),
        Column(BRAKE, "H", "−ẍ", 0, "=(rhot*D{r}^2/2+bet*Yt)*PI()*(2*Rp*F{r}-F{r}^2)/Mass"),
        Column(END, "J", "ẋ new", None, "=D{r}-H{r}*dt_"),
    ])  # fmt: skip
    f.put(s, f"B{16 + f.steps}", "checked 3/14, agrees with Fig. 3")
    return f


def printed_digits(impact: Impact) -> Foreign:
    """The printed table typed off the page: five rows, three digits, no formula anywhere."""
    f = Foreign("printed-digits", impact)
    s = "Table A-1"
    labels = ["R =", "Density =", "M =", "D =", "Initial vel =", "Rt ="]
    values = [impact.radius, impact.particle_density, impact.mass, impact.diameter,
              impact.velocity, impact.target_resistance]  # fmt: skip
    for r, (label, value) in enumerate(zip(labels, values, strict=True), 1):
        f.line(s, f"A{r}", label, float(f"{value:.2e}"))
    f.line(s, "A7", "Time", None, "dx/dt initial", "x", "d2x/dt2", "dx/dt final")
    _values(f, s, 8, "ACDEF", impact, rows=5, digits=3)
    return f


def italian(impact: Impact) -> Foreign:
    """Words that the program does not know, no row 0, no cell for the mass."""
    f = Foreign("italian", impact)
    f.given(
        "calcolo", "A1",
        ("radius", "raggio"), ("particle_density", "densità rame"),
        ("target_density", "densità acciaio"), ("resistance", "Rt"), ("velocity", "velocità"),
        ("step", "passo"),
    )  # fmt: skip
    force = "=(0.5*$B$3*B{r}^2+$B$4)*PI()*(2*$B$1*C{r}-C{r}^2)/(4/3*PI()*$B$1^3*$B$2)"
    f.table("calcolo", 9, [
        Column(TIME, "A", "tempo", None, "={k}*$B$6"),
        Column(START, "B", "velocità iniziale", None, "=E{p}", "=$B$5"),
        Column(DEPTH, "C", "profondità", None, "=C{p}+B{r}*$B$6", "=B{r}*$B$6/2"),
        Column(BRAKE, "D", "decelerazione", None, force),
        Column(END, "E", "velocità finale", None, "=B{r}-D{r}*$B$6"),
    ], heads=9)  # fmt: skip
    return f


def no_words(impact: Impact) -> Foreign:
    """Not one word: numbers at row 500, the table in columns AA to AE."""
    f = Foreign("no-words", impact)
    s = "Sheet1"
    f.given(
        s, "T500",
        ("velocity", impact.velocity),
        ("radius", impact.radius),
        ("particle_density", impact.particle_density),
        ("target_density", impact.target_density),
        ("resistance", impact.target_resistance),
        ("step", impact.step),
        ("", "=T502*4/3*PI()*T501*T501*T501"),
    )  # fmt: skip
    force = "=(0.5*$T$503*AB{r}^2+$T$504)*PI()*(2*$T$501*AC{r}-AC{r}^2)/$T$506"
    f.table(s, 510, [
        Column(TIME, "AA", "", 0, "=AA{p}+$T$505"),
        Column(START, "AB", "", "=T500", "=AE{p}", "=AB{p}"),
        Column(DEPTH, "AC", "", 0, "=AC{p}+AB{r}*$T$505", "=AB{r}*$T$505/2"),
        Column(BRAKE, "AD", "", None, force),
        Column(END, "AE", "", None, "=AB{r}-AD{r}*$T$505"),
    ])  # fmt: skip
    return f


def centimetres(impact: Impact) -> Foreign:
    """Centimetres, grams and dynes."""
    f = Foreign("centimetres", impact, si=False)
    f.given(
        "cgs", "A1",
        ("radius", "R [cm]", 1.1e-3),
        ("particle_density", "rho_p [g/cm3]", 8.9),
        ("target_density", "rho_t [g/cm3]", 7.85),
        ("resistance", "R_t [dyn/cm2]", impact.target_resistance * 10),
        ("velocity", "V [cm/s]", 5e4),
        ("step", "dt [s]", 2e-10),
        ("", "M [g]", "=4/3*PI()*B1^3*B2"),
    )  # fmt: skip
    force = "=(0.5*$B$3*B{r}^2+$B$4)*PI()*(2*$B$1*C{r}-C{r}^2)/$B$7"
    f.table("cgs", 10, [
        Column(TIME, "A", "t [s]", 0, "=A{p}+$B$6"),
        Column(START, "B", "v0 [cm/s]", "=B5", "=E{p}", "=$B$5"),
        Column(DEPTH, "C", "x [cm]", 0, "=C{p}+B{r}*$B$6", "=B{r}*$B$6/2"),
        Column(BRAKE, "D", "a [cm/s2]", 0, force),
        Column(END, "E", "v1 [cm/s]", None, "=B{r}-D{r}*$B$6"),
    ])  # fmt: skip
    return f


def no_deceleration(impact: Impact) -> Foreign:
    """The velocity in one formula with its deceleration, which has no column."""
    f = Foreign("no-deceleration", impact)
    f.given(
        "Daten", "I1",
        ("radius", "Radius"), ("particle_density", "Dichte Cu"), ("target_density", "Dichte Stahl"),
        ("resistance", "Widerstand"), ("velocity", "V0"), ("step", "dt"),
        ("", "Masse", "=4/3*PI()*J1^3*J2"),
    )  # fmt: skip
    force = "(0.5*$J$3*C{r}^2+$J$4)*PI()*(2*$J$1*D{r}-D{r}^2)"
    f.table("Daten", 1, [
        Column("", "A", "n", None, "{k}"),
        Column(TIME, "B", "t", None, "=A{r}*$J$6"),
        Column(START, "C", "v alt", None, "=E{p}", "=$J$5"),
        Column(DEPTH, "D", "x", None, "=D{p}+C{r}*$J$6", "=C{r}*$J$6/2"),
        Column(END, "E", "v neu", None, f"=C{{r}}-{force}/$J$7*$J$6"),
    ], heads=1)  # fmt: skip
    return f


def merged_heads(impact: Impact) -> Foreign:
    """Heads in three rows, "velocity" over "start" and "end"; every factor in the formulas."""
    f = Foreign("merged-heads", impact, si=False)
    s = "Sheet"
    f.given(
        s, "A3",
        ("velocity", "Impact velocity", 500, "m/s"),
        ("diameter", "Particle diameter", 22, "µm"),
        ("particle_density", "Copper density", 8.9, "g/cm3"),
        ("target_density", "Steel density", 7.85, "g/cm3"),
        ("flow_stress", "Steel flow stress", 700, "MPa"),
        ("beta", "beta", impact.beta or 0),
        ("step", "Time step", 0.2, "ns"),
    )  # fmt: skip
    f.line(s, "B13", "Velocity", None, "Penetration", "Decel.")
    f.line(s, "A15", "ns", "m/s", "m/s", "µm", "m/s²")
    force = "(0.5*$B$6*1000*B{r}^2+$B$8*$B$7*1000000)*PI()*($B$4*D{r}-D{r}^2)/1000000000000"
    f.table(s, 16, [
        Column(TIME, "A", "time", 0, "={k}*$B$9"),
        Column(START, "B", "start", "=B3", "=C{p}", "=B16"),
        Column(DEPTH, "D", "", 0, "=D{p}+B{r}*$B$9/1000", "=B{r}*$B$9/1000/2"),
        Column(BRAKE, "E", "", 0, f"={force}/(PI()/6*($B$4/1000000)^3*$B$5*1000)"),
        Column(END, "C", "end", None, "=B{r}-E{r}*$B$9/1000000000"),
    ], heads=14)  # fmt: skip
    return f


def velocity_at_end(impact: Impact) -> Foreign:
    """Each row shows the velocity at its end; inputs on a sheet of their own."""
    f = Foreign("velocity-at-end", impact)
    f.given(
        "Input", "A1",
        ("velocity", "V"), ("radius", "R"), ("particle_density", "rho particle"),
        ("target_density", "rho target"), ("flow_stress", "Yield strength target"),
        ("beta", "beta"), ("step", "dt"), ("stop_velocity", "v_stop"),
        ("",),
        ("", "m", "=4/3*PI()*B2^3*B3"), ("", "Rt", "=B5*B6"),
    )  # fmt: skip
    step = "Input!$B$7"
    force = "(0.5*Input!$B$4*C{p}^2+Input!$B$11)*PI()*(2*Input!$B$2*D{r}-D{r}^2)"
    f.table("run 1", 4, [
        Column("", "A", "step", 0, "{k}"),
        Column(TIME, "B", "time", 0, f"=A{{r}}*{step}"),
        Column(END, "C", "v", "=Input!$B$1", f"=C{{p}}-E{{r}}*{step}"),
        Column(DEPTH, "D", "x", 0, f"=D{{p}}+C{{p}}*{step}", f"=C{{p}}*{step}/2"),
        Column(BRAKE, "E", "a", 0, f"={force}/Input!$B$10"),
    ])  # fmt: skip
    return f


def named_constants(impact: Impact) -> Foreign:
    """Inputs are names that stand for numbers; filled down too far, #N/A below the stop."""
    f = Foreign("named-constants", impact)
    f.names = {
        "dt": "0.0000000002", "rho_t": "7850", "rho_p": "8900", "Rad": "0.000011", "V_imp": "500",
        "Rt": f"{impact.target_resistance:.0f}",
    }  # fmt: skip
    area, mass = "(2*Rad*E{r}-E{r}*E{r})", "(rho_p*4/3*PI()*Rad*Rad*Rad)"
    f.table("Sheet", 3, [
        Column("", "B", "n", 0, "{k}"),
        Column(TIME, "C", "t", "=B3*dt", "=B{r}*dt"),
        Column(START, "D", "v_i", "=V_imp", "=IF(N(G{p})<1,NA(),G{p})", "=V_imp"),
        Column(DEPTH, "E", "x", 0, "=E{p}+D{r}*dt", "=D{r}*dt/2"),
        Column(BRAKE, "F", "a", 0, f"=(0.5*rho_t*D{{r}}*D{{r}}+Rt)*PI()*{area}/{mass}"),
        Column(END, "G", "v_f", "=V_imp", "=D{r}-F{r}*dt"),
    ], steps=199)  # fmt: skip
    return f


def six_digits(impact: Impact) -> Foreign:
    """A table exported with six digits: no formulas, no inputs, units in the heads."""
    f = Foreign("six-digits", impact, si=False)
    f.line("export", "A1", "t_ns", "v_m_per_s", "x_um", "a_m_per_s2")
    _values(f, "export", 2, "ABCD", impact, digits=6, factors=(1e9, 1, 1e6, 1))
    return f


def _values(
    f: Foreign, sheet: str, zero: int, columns: str, impact: Impact, rows: int | None = None,
    digits: int = 17, factors: Sequence[float] = (1, 1, 1, 1, 1),
) -> None:  # fmt: skip
    """The numbers of a run, without formulas."""
    for k, row in enumerate(run(impact).rows[:rows]):
        for role, letter, value, factor in zip(
            (TIME, START, DEPTH, BRAKE, END), columns, row, factors, strict=False
        ):
            if value is not None:
                here = place(sheet, f"{letter}{zero + k}")
                f.cells[here] = float(f"{value * factor:.{digits}g}")
                f.where[role, k] = here


def plain(impact: Impact, rows: int | None = None) -> Foreign:
    """A sheet in which everything has its cell, to be changed: so many rows of it."""
    f, s = Foreign("plain", impact), "Sheet1"
    f.given(
        s, "A1",
        ("radius", "R ="), ("particle_density", "Density ="), ("", "M =", "=4/3*PI()*B1^3*B2"),
        ("", "D =", "=2*B1"), ("velocity", "Initial vel ="), ("", "Rt =", "=H1*H2"),
    )  # fmt: skip
    f.given(s, "D1", ("target_density", "target density"), ("step", "dt"))
    f.given(s, "G1", ("beta", "beta"), ("flow_stress", "Yt"))
    f.table(s, 8, [
        Column(TIME, "A", "Time", 0.0, "=A{p}+$E$2"),
        Column(START, "C", "dx/dt initial", "=B5", "=F{p}", "=C8"),
        Column(DEPTH, "D", "x", 0.0, "=D{p}+C{r}*$E$2", "=D8+C9*$E$2/2"),
        Column(BRAKE, "E", "d²x/dt²", 0.0,
               "=(0.5*$E$1*C{r}^2+$B$6)*PI()*($B$4*D{r}-D{r}^2)/$B$3"),
        Column(END, "F", "dx/dt final", None, "=C{r}-E{r}*$E$2"),
    ], steps=rows)  # fmt: skip
    return f


def empty(impact: Impact) -> Foreign:
    return Foreign("empty", impact)


def changed(f: Foreign, cells: Mapping[str, Content]) -> Foreign:
    """A workbook with other contents; None and an empty text clear a cell."""
    for address, content in cells.items():
        for here, filled in contents(f, address, content):
            if filled is None:
                f.cells.pop(here, None)
            else:
                f.cells[here] = filled
    return f


def contents(f: Foreign, address: str, content: Content) -> Iterator[tuple[Place, Content]]:
    """What an address of `cases.txt` stands for, and what each of its cells is to hold."""
    sheet, _, cells = address.rpartition("!")
    sheet = sheet or next((at[0] for at in f.cells), "Sheet1")
    first, *until = cells.split(":")
    _, row, column = place(sheet, first)
    last = int(until[0]) if until and until[0] else row if not until else max(
        at[1] for at in f.cells if at[0] == sheet)  # fmt: skip
    for r in range(row, last + 1, int(until[1]) if until[1:] else 1):
        parts = content.split(" / ") if isinstance(content, str) else [content]
        for c, part in enumerate(parts, column):
            yield (sheet, r, c), _filled(part, r) if isinstance(part, str) else part


def _filled(text: str, row: int) -> Content:
    """A content with its row in it; a number, a truth value or a quoted text is written as JSON."""
    k = row - 8
    text = text.format(r=row, p=row - 1, k=k, t=k * 5e-10)
    try:
        return json.loads(text or "null")
    except ValueError:
        return text


BY_HAND: tuple[Callable[[Impact], Foreign], ...] = (
    table_a1, german, french, sideways, no_time, one_velocity, side_by_side, guarded, pasted,
    natural_units, named_everything, printed_digits, italian, no_words, centimetres,
    no_deceleration, merged_heads, velocity_at_end, named_constants, six_digits,
)  # fmt: skip


def by_hand(impact: Impact) -> list[Foreign]:
    """Every layout, filled with that impact."""
    return [layout(impact) for layout in BY_HAND]
