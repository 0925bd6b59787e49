"""Workbooks as other people lay out the report's sheet: each function is one engineer's habits.

They were written before the program that reads them and share nothing with it: cells, formulas and
heads as somebody would type them, and where what stands. Rows are numbered as in the report: row 0
is the impact, row 1 the first step. `faults.py` spoils them, `writers.py` makes files of them.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field

from replication.models.impact import Impact
from replication.models.sheet import run

Place = tuple[str, int, int]
"""Sheet, row and column, both counted from 1."""

TIME, START, DEPTH, BRAKE, END = (
    "time",
    "velocity_initial",
    "depth",
    "deceleration",
    "velocity_final",
)


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
        return run(self.impact).steps

    def put(self, sheet: str, address: str, content: str | float) -> None:
        self.cells[place(sheet, address)] = content

    def at(self, role: str, row: int) -> str | float:
        return self.cells[self.where[role, row]]

    def table(self, sheet: str, row: int, columns: dict[str, str]) -> None:
        """Say that the table's row 0 stands in that row, and its columns under these letters."""
        for role, letter in columns.items():
            for k in range(self.steps + 1):
                if place(sheet, f"{letter}{row + k}") in self.cells:
                    self.where[role, k] = place(sheet, f"{letter}{row + k}")


def place(sheet: str, address: str) -> Place:
    letters = address.rstrip("0123456789")
    return sheet, int(address[len(letters) :]), column(letters)


def column(letters: str) -> int:
    number = 0
    for letter in letters:
        number = number * 26 + ord(letter) - ord("A") + 1
    return number


def letters(number: int) -> str:
    text = ""
    while number:
        number, rest = divmod(number - 1, 26)
        text = chr(ord("A") + rest) + text
    return text


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
    s = "Sheet1"
    heads = [
        ("R =", impact.radius), ("Density =", impact.particle_density),
        ("M =", "=B2*4/3*PI()*B1*B1*B1"), ("D =", "=2*B1"), ("Initial vel =", impact.velocity),
        ("Rt =", impact.target_resistance),
    ]  # fmt: skip
    for row, (label, content) in enumerate(heads, 1):
        f.put(s, f"A{row}", label)
        f.put(s, f"B{row}", content)
    for letter, head in zip(
        "ACDEF", ["Time", "dx/dt initial", "x", "d²x/dt²", "dx/dt final"], strict=True
    ):
        f.put(s, f"{letter}7", head)
    for letter, content in zip("ACDE", [0, "=B5", 0, 0], strict=True):
        f.put(s, f"{letter}8", content)
    for k in range(1, f.steps + 1):
        r = 8 + k
        f.put(s, f"A{r}", f"={k}*0.0000000002" if k == 1 else f"=A{r - 1}+0.0000000002")
        f.put(s, f"C{r}", f"=C{r - 1}" if k == 1 else f"=F{r - 1}")
        f.put(s, f"D{r}", f"=C{r}*0.0000000001" if k == 1 else f"=D{r - 1}+C{r}*0.0000000002")
        f.put(s, f"E{r}", f"=(0.5*7850*C{r}^2+$B$6)*PI()*($B$4*D{r}-D{r}^2)/$B$3")
        f.put(s, f"F{r}", f"=C{r}-E{r}*0.0000000002")
    f.table(s, 8, {TIME: "A", START: "C", DEPTH: "D", BRAKE: "E", END: "F"})
    f.inputs = {
        "radius": (s, 1, 2), "particle_density": (s, 2, 2), "velocity": (s, 5, 2),
        "resistance": (s, 6, 2),
    }  # fmt: skip
    return f


def german(impact: Impact) -> Foreign:
    """Eingaben links in handlichen Einheiten, SI daneben; Tabelle darunter in µm und ns."""
    f = Foreign("german", impact, si=False)
    s = "Rechnung"
    f.put(s, "A1", "Eindringen einer starren Kupferkugel in Edelstahl")
    given = [
        ("Partikelradius R", 11, "µm", "=B4*0.000001", "radius"),
        ("Dichte Partikel", 8.9, "g/cm³", "=B5*1000", "particle_density"),
        ("Dichte Ziel", 7.85, "g/cm³", "=B6*1000", "target_density"),
        ("Fließspannung", 700, "MPa", "=B7*1000000", "flow_stress"),
        ("Faktor beta", impact.beta, "-", "=B8", "beta"),
        ("Auftreffgeschwindigkeit", 500, "m/s", "=B9", "velocity"),
        ("Zeitschritt", 0.2, "ns", "=B10*0.000000001", "step"),
        ("Abbruchgeschwindigkeit", 1, "m/s", "=B11", "stop_velocity"),
    ]
    f.put(s, "B3", "Wert")
    f.put(s, "C3", "Einheit")
    f.put(s, "D3", "SI")
    for r, (label, value, unit, si, name) in enumerate(given, 4):
        for letter, content in zip("ABCD", [label, value, unit, si], strict=True):
            f.put(s, f"{letter}{r}", content)
        f.inputs[name] = (s, r, 2)
    f.put(s, "A12", "Durchmesser D")
    f.put(s, "D12", "=2*D4")
    f.put(s, "A13", "Masse M [kg]")
    f.put(s, "D13", "=4/3*PI()*D4^3*D5")
    f.put(s, "A14", "Zielwiderstand R_t [Pa]")
    f.put(s, "D14", "=D8*D7")
    heads = [
        "Schritt", "Zeit [ns]", "v Anfang [m/s]", "Eindringtiefe [µm]", "Kontaktfläche [µm²]",
        "Verzögerung [m/s²]", "v Ende [m/s]",
    ]  # fmt: skip
    for letter, head in zip("ABCDEFG", heads, strict=True):
        f.put(s, f"{letter}17", head)
    for letter, content in zip("ABCDEF", [0, 0, "=D9", 0, 0, 0], strict=True):
        f.put(s, f"{letter}18", content)
    for k in range(1, f.steps + 1):
        r = 18 + k
        f.put(s, f"A{r}", f"=A{r - 1}+1")
        f.put(s, f"B{r}", f"=A{r}*$B$10")
        f.put(s, f"C{r}", "=C18" if k == 1 else f"=G{r - 1}")
        half = f"=C{r}*$D$10/2*1000000" if k == 1 else f"=D{r - 1}+C{r}*$D$10*1000000"
        f.put(s, f"D{r}", half)
        f.put(s, f"E{r}", f"=PI()*($D$12*1000000*D{r}-D{r}^2)")
        f.put(s, f"F{r}", f"=(0.5*$D$6*C{r}^2+$D$14)*E{r}*0.000000000001/$D$13")
        f.put(s, f"G{r}", f"=C{r}-F{r}*$D$10")
    f.table(s, 18, {TIME: "B", START: "C", DEPTH: "D", BRAKE: "F", END: "G"})
    f.put(s, "F4", "Endtiefe [µm]")
    f.put(s, "G4", f"=D{18 + f.steps}")
    f.put(s, "F5", "X/R")
    f.put(s, "G5", "=G4/B4")
    return f


def french(impact: Impact) -> Foreign:
    """Données sur une feuille, noms définis, calcul sur une autre, commencé loin du coin."""
    f = Foreign("french", impact)
    d, c = "Données", "Calcul pas à pas"
    given = [
        ("rayon de la particule (m)", "rayon", impact.radius, "radius"),
        ("masse volumique du cuivre (kg/m3)", "rho_p", impact.particle_density, "particle_density"),
        ("masse volumique de la cible (kg/m3)", "rho_c", impact.target_density, "target_density"),
        ("contrainte d'écoulement (Pa)", "Y_c", 700000000, "flow_stress"),
        ("bêta", "beta", impact.beta, "beta"),
        ("vitesse d'impact (m/s)", "V_0", impact.velocity, "velocity"),
        ("pas de temps (s)", "delta_t", impact.step, "step"),
        ("vitesse d'arrêt (m/s)", "v_arret", impact.stop_velocity, "stop_velocity"),
    ]
    for r, (label, name, value, key) in enumerate(given, 3):
        f.put(d, f"B{r}", label)
        f.put(d, f"C{r}", value)
        f.names[name] = f"'{d}'!$C${r}"
        f.inputs[key] = (d, r, 3)
    f.put(d, "B12", "résistance de la cible (Pa)")
    f.put(d, "C12", "=beta*Y_c")
    f.names["R_cible"] = f"'{d}'!$C$12"
    f.put(d, "B13", "masse (kg)")
    f.put(d, "C13", "=rho_p*4/3*PI()*rayon*rayon*rayon")
    f.names["masse"] = f"'{d}'!$C$13"
    heads = ["temps (s)", "vitesse initiale", "profondeur (m)", "décélération", "vitesse finale"]
    for letter, head in zip("EFGHI", heads, strict=True):
        f.put(c, f"{letter}20", head)
    for letter, content in zip("EFGH", [0, "=V_0", 0, 0], strict=True):
        f.put(c, f"{letter}21", content)
    for k in range(1, f.steps + 1):
        r = 21 + k
        f.put(c, f"E{r}", f"=E{r - 1}+delta_t")
        f.put(c, f"F{r}", "=V_0" if k == 1 else f"=I{r - 1}")
        f.put(c, f"G{r}", f"=F{r}*(delta_t/2)" if k == 1 else f"=G{r - 1}+F{r}*delta_t")
        area = f"(2*rayon*G{r}-G{r}*G{r})"
        f.put(c, f"H{r}", f"=(0.5*rho_c*F{r}*F{r}+R_cible)*PI()*{area}/masse")
        f.put(c, f"I{r}", f"=F{r}-H{r}*delta_t")
    f.table(c, 21, {TIME: "E", START: "F", DEPTH: "G", BRAKE: "H", END: "I"})
    return f


def sideways(impact: Impact) -> Foreign:
    """Time runs to the right; labels at the left, with units in the next cell."""
    f = Foreign("sideways", impact)
    s = "Sheet 1"
    given = [
        ("V", impact.velocity, "m/s", "velocity"), ("R", impact.radius, "m", "radius"),
        ("rho_p", impact.particle_density, "kg/m^3", "particle_density"),
        ("rho_t", impact.target_density, "kg/m^3", "target_density"),
        ("R_t", impact.target_resistance, "Pa", "resistance"), ("dt", impact.step, "s", "step"),
    ]  # fmt: skip
    for r, (label, value, unit, key) in enumerate(given, 2):
        f.put(s, f"B{r}", label)
        f.put(s, f"C{r}", value)
        f.put(s, f"D{r}", unit)
        f.inputs[key] = (s, r, 3)
    f.put(s, "B8", "M")
    f.put(s, "C8", "=C4*4/3*PI()*C3*C3*C3")
    f.put(s, "D8", "kg")
    labels = {11: ("t", "s"), 12: ("v_i", "m/s"), 13: ("x", "m"), 14: ("a", "m/s^2"), 15: ("v_f", "m/s")}  # fmt: skip  # noqa: E501
    for r, (label, unit) in labels.items():
        f.put(s, f"B{r}", label)
        f.put(s, f"C{r}", unit)
    roles = dict(zip(labels, [TIME, START, DEPTH, BRAKE, END], strict=True))
    for k in range(f.steps + 1):
        c, p = letters(4 + k), letters(3 + k)
        if k == 0:
            contents: list[str | float] = [0, "=C2", 0, 0]
        else:
            contents = [
                f"={p}11+$C$7",
                f"={p}12" if k == 1 else f"={p}15",
                f"={c}12*$C$7/2" if k == 1 else f"={p}13+{c}12*$C$7",
                f"=(0.5*$C$5*{c}12^2+$C$6)*PI()*(2*$C$3*{c}13-{c}13^2)/$C$8",
                f"={c}12-{c}14*$C$7",
            ]
        for r, content in zip(labels, contents, strict=False):
            f.put(s, f"{c}{r}", content)
            f.where[roles[r], k] = place(s, f"{c}{r}")
    return f


def no_time(impact: Impact) -> Foreign:
    """Rows numbered behind, no time; area, force and energy beside; inputs under the table."""
    f = Foreign("no-time", impact)
    s = "impact"
    last = 5 + f.steps
    base = last + 4
    given = [
        ("impact velocity (m/s)", impact.velocity, "velocity"),
        ("particle radius (m)", impact.radius, "radius"),
        ("particle density (kg/m3)", impact.particle_density, "particle_density"),
        ("target density (kg/m3)", impact.target_density, "target_density"),
        ("target strength (Pa)", 700e6, "flow_stress"), ("beta", impact.beta, "beta"),
        ("time step (s)", impact.step, "step"),
    ]  # fmt: skip
    cell = {}
    for r, (label, value, key) in enumerate(given, base):
        f.put(s, f"H{r}", label)
        f.put(s, f"J{r}", value)
        f.inputs[key] = (s, r, 10)
        cell[key] = f"$J${r}"
    f.put(s, f"H{base + 8}", "mass (kg)")
    f.put(s, f"J{base + 8}", f"=4*PI()/3*{cell['radius']}^3*{cell['particle_density']}")
    mass = f"$J${base + 8}"
    heads = ["v start", "depth x", "A(x)", "force", "acceleration", "v end", "kinetic energy", "n"]
    for letter, head in zip("CDEFGHIJ", heads, strict=True):
        f.put(s, f"{letter}4", head)
    for k in range(f.steps + 1):
        r = 5 + k
        dt = cell["step"]
        f.put(s, f"J{r}", k)
        f.put(s, f"I{r}", f"=0.5*{mass}*C{r}^2")
        if k == 0:
            f.put(s, f"C{r}", f"={cell['velocity']}")
            f.put(s, f"D{r}", 0)
            continue
        f.put(s, f"C{r}", f"=C{r - 1}" if k == 1 else f"=H{r - 1}")
        f.put(s, f"D{r}", f"=C{r}*{dt}/2" if k == 1 else f"=D{r - 1}+C{r}*{dt}")
        f.put(s, f"E{r}", f"=PI()*(2*{cell['radius']}*D{r}-D{r}^2)")
        stress = f"(0.5*{cell['target_density']}*C{r}^2+{cell['beta']}*{cell['flow_stress']})"
        f.put(s, f"F{r}", f"={stress}*E{r}")
        f.put(s, f"G{r}", f"=F{r}/{mass}")
        f.put(s, f"H{r}", f"=C{r}-G{r}*{dt}")
    f.table(s, 5, {START: "C", DEPTH: "D", BRAKE: "G", END: "H"})
    return f


def one_velocity(impact: Impact) -> Foreign:
    """One velocity a row, at its beginning; the next row takes it on. Acceleration negative."""
    f = Foreign("one-velocity", impact)
    s = "Tabelle1"
    f.put(s, "A1", "V0 [m/s]")
    f.put(s, "B1", impact.velocity)
    f.put(s, "C1", "D [m]")
    f.put(s, "D1", 2 * impact.radius)
    f.put(s, "E1", "rho Ziel [kg/m3]")
    f.put(s, "F1", impact.target_density)
    f.put(s, "A2", "dt [s]")
    f.put(s, "B2", impact.step)
    f.put(s, "C2", "Rt [Pa]")
    f.put(s, "D2", impact.target_resistance)
    f.put(s, "E2", "rho Kugel [kg/m3]")
    f.put(s, "F2", impact.particle_density)
    f.put(s, "A3", "m [kg]")
    f.put(s, "B3", "=PI()/6*D1^3*F2")
    f.inputs = {
        "velocity": (s, 1, 2), "diameter": (s, 1, 4), "target_density": (s, 1, 6),
        "step": (s, 2, 2), "resistance": (s, 2, 4), "particle_density": (s, 2, 6),
    }  # fmt: skip
    for letter, head in zip(
        "ABCD", ["t in s", "x in m", "v in m/s", "Beschleunigung in m/s²"], strict=True
    ):
        f.put(s, f"{letter}5", head)
    for k in range(f.steps + 1):
        r = 6 + k
        f.put(s, f"A{r}", f"={k}*$B$2" if k else 0)
        if k == 0:
            f.put(s, "B6", 0)
            f.put(s, "C6", "=B1")
            f.put(s, "D6", 0)
            continue
        f.put(s, f"C{r}", f"=C{r - 1}+D{r - 1}*$B$2")
        f.put(s, f"B{r}", f"=C{r}*$B$2/2" if k == 1 else f"=B{r - 1}+C{r}*$B$2")
        f.put(s, f"D{r}", f"=-(0.5*$F$1*C{r}^2+$D$2)*PI()*($D$1*B{r}-B{r}^2)/$B$3")
    f.table(s, 6, {TIME: "A", START: "C", DEPTH: "B", BRAKE: "D"})
    return f


def side_by_side(impact: Impact) -> Foreign:
    """Both betas on one sheet, each with its own table and resistance; `impact` is the left one."""
    f = Foreign("side-by-side", impact)
    s = "beta 3 and 5"
    shared = [
        ("R (m)", impact.radius, "radius"), ("D (m)", "=2*B1", ""),
        ("density of copper", impact.particle_density, "particle_density"),
        ("density of steel", impact.target_density, "target_density"),
        ("M (kg)", "=B3*4/3*PI()*B1*B1*B1", ""), ("Y (Pa)", 700e6, "flow_stress"),
        ("V (m/s)", impact.velocity, "velocity"), ("dt (s)", impact.step, "step"),
    ]  # fmt: skip
    for r, (label, content, key) in enumerate(shared, 1):
        f.put(s, f"A{r}", label)
        f.put(s, f"B{r}", content)
        if key:
            f.inputs[key] = (s, r, 2)
    other = 3.0 if impact.beta == 5 else 5.0
    for first, beta in ((1, impact.beta), (8, other)):
        c = [letters(first + i) for i in range(6)]
        steps = run(_with_beta(impact, beta)).steps
        f.put(s, f"{c[0]}11", "beta")
        f.put(s, f"{c[1]}11", beta)
        f.put(s, f"{c[2]}11", "Rt")
        f.put(s, f"{c[3]}11", f"={c[1]}11*B6")
        if first == 1:
            f.inputs["beta"] = place(s, f"{c[1]}11")
        for letter, head in zip(
            c, ["#", "time / s", "v1 / (m/s)", "x / m", "a / (m/s2)", "v2 / (m/s)"], strict=True
        ):
            f.put(s, f"{letter}13", head)
        for k in range(steps + 1):
            r = 14 + k
            f.put(s, f"{c[0]}{r}", k)
            f.put(s, f"{c[1]}{r}", f"={c[0]}{r}*$B$8")
            if k == 0:
                for letter, content in zip(c[2:5], ["=$B$7", 0, 0], strict=True):
                    f.put(s, f"{letter}{r}", content)
                continue
            v, x, a = f"{c[2]}{r}", f"{c[3]}{r}", f"{c[4]}{r}"
            f.put(s, v, "=$B$7" if k == 1 else f"={c[5]}{r - 1}")
            f.put(s, x, f"={v}*$B$8/2" if k == 1 else f"={c[3]}{r - 1}+{v}*$B$8")
            f.put(s, a, f"=(0.5*$B$4*{v}*{v}+${c[3]}$11)*PI()*($B$2*{x}-{x}*{x})/$B$5")
            f.put(s, f"{c[5]}{r}", f"={v}-{a}*$B$8")
    f.table(s, 14, {TIME: "B", START: "C", DEPTH: "D", BRAKE: "E", END: "F"})
    return f


def _with_beta(impact: Impact, beta: float | None) -> Impact:
    from dataclasses import replace

    return replace(impact, beta=beta)


def guarded(impact: Impact) -> Foreign:
    """Filled down to row 400, blank below the stop; two rows of heads, the second with units."""
    f = Foreign("guarded", impact)
    s = "Model"
    given = [
        ("Particle radius", impact.radius, "m", "radius"),
        ("Particle density", impact.particle_density, "kg/m³", "particle_density"),
        ("Target density", impact.target_density, "kg/m³", "target_density"),
        ("Impact speed", impact.velocity, "m/s", "velocity"),
        ("Target resistance", impact.target_resistance, "Pa", "resistance"),
        ("Time increment", impact.step, "s", "step"),
        ("Stop below", impact.stop_velocity, "m/s", "stop_velocity"),
    ]
    for r, (label, value, unit, key) in enumerate(given, 3):
        f.put(s, f"J{r}", label)
        f.put(s, f"K{r}", value)
        f.put(s, f"L{r}", unit)
        f.inputs[key] = (s, r, 11)
    f.put(s, "J10", "Particle mass")
    f.put(s, "K10", "=K4*4/3*PI()*K3*K3*K3")
    f.put(s, "L10", "kg")
    heads = [("Step", ""), ("Time", "s"), ("Initial speed", "m/s"), ("Penetration", "m"),
             ("Deceleration", "m/s²"), ("Final speed", "m/s")]  # fmt: skip
    for letter, (head, unit) in zip("BCDEFG", heads, strict=True):
        f.put(s, f"{letter}3", head)
        f.put(s, f"{letter}4", unit)
    for letter, content in zip("BCDEF", [0, 0, "=K6", 0, 0], strict=True):
        f.put(s, f"{letter}5", content)
    for r in range(6, 401):
        more = "" if r == 6 else f'IF(N(G{r - 1})<$K$9,"",'
        end = ")" if more else ""
        f.put(s, f"B{r}", f"={more}B{r - 1}+1{end}")

        def live(text: str, r: int = r) -> str:
            return f'=IF(ISNUMBER(B{r}),{text},"")'

        f.put(s, f"C{r}", live(f"B{r}*$K$8"))
        f.put(s, f"D{r}", live("$K$6" if r == 6 else f"G{r - 1}"))
        f.put(s, f"E{r}", live(f"D{r}*$K$8/2" if r == 6 else f"E{r - 1}+D{r}*$K$8"))
        stress = f"(0.5*$K$5*D{r}*D{r}+$K$7)"
        area = f"IF(E{r}<$K$3,2*$K$3*E{r}-E{r}*E{r},$K$3*$K$3)"
        f.put(s, f"F{r}", live(f"{stress}*PI()*{area}/$K$10"))
        f.put(s, f"G{r}", live(f"D{r}-F{r}*$K$8"))
    f.table(s, 5, {TIME: "C", START: "D", DEPTH: "E", BRAKE: "F", END: "G"})
    f.put(s, "J12", "Final depth")
    f.put(s, "K12", "=MAX(E5:E400)")
    f.put(s, "L12", "m")
    f.put(s, "J13", "Depth / radius")
    f.put(s, "K13", "=K12/K3")
    return f


def pasted(impact: Impact) -> Foreign:
    """Values only, as a script wrote them: a data frame with its index, no inputs at all."""
    f = Foreign("pasted", impact)
    s = "Sheet1"
    for letter, head in zip("BCDEF", ["t", "v0", "x", "a", "v1"], strict=True):
        f.put(s, f"{letter}1", head)
    for k, row in enumerate(run(impact).rows):
        f.put(s, f"A{k + 2}", k)
        for letter, value in zip("BCDEF", row, strict=True):
            if value is not None:
                f.put(s, f"{letter}{k + 2}", value)
    f.table(s, 2, {TIME: "B", START: "C", DEPTH: "D", BRAKE: "E", END: "F"})
    return f


def natural_units(impact: Impact) -> Foreign:
    """Micrometres, nanoseconds and km/s = µm/ns throughout, so that formulas need no factors."""
    f = Foreign("natural-units", impact, si=False)
    s = "µm-ns"
    # mass in pg = 1e-15 kg: then pg/(µm ns²) = 1e-15/(1e-6 1e-18) = 1e9 Pa, so GPa fit, too,
    # and densities in pg/µm³ are those in g/cm³.
    given = [
        ("R [µm]", 11, "radius"), ("ρp [g/cm³]", 8.9, "particle_density"),
        ("ρt [g/cm³]", 7.85, "target_density"),
        ("Rt [GPa]", 0.7 * (impact.beta or 0), "resistance"),
        ("V [km/s]", 0.5, "velocity"), ("Δt [ns]", 0.2, "step"),
    ]  # fmt: skip
    for r, (label, value, key) in enumerate(given, 1):
        f.put(s, f"A{r}", label)
        f.put(s, f"B{r}", value)
        f.inputs[key] = (s, r, 2)
    f.put(s, "A7", "M [ng/1000]")
    f.put(s, "B7", "=4/3*PI()*B1^3*B2")
    for letter, head in zip(
        "DEFGH", ["t [ns]", "v1 [km/s]", "x [µm]", "a [µm/ns²]", "v2 [km/s]"], strict=True
    ):
        f.put(s, f"{letter}1", head)
    for letter, content in zip("DEFG", [0, "=B5", 0, 0], strict=True):
        f.put(s, f"{letter}2", content)
    for k in range(1, f.steps + 1):
        r = 2 + k
        f.put(s, f"D{r}", f"=D{r - 1}+$B$6")
        f.put(s, f"E{r}", "=E2" if k == 1 else f"=H{r - 1}")
        f.put(s, f"F{r}", f"=E{r}*$B$6/2" if k == 1 else f"=F{r - 1}+E{r}*$B$6")
        f.put(s, f"G{r}", f"=(0.5*$B$3*E{r}^2+$B$4)*PI()*(2*$B$1*F{r}-F{r}^2)/$B$7")
        f.put(s, f"H{r}", f"=E{r}-G{r}*$B$6")
    f.table(s, 2, {TIME: "D", START: "E", DEPTH: "F", BRAKE: "G", END: "H"})
    return f


def named_everything(impact: Impact) -> Foreign:
    """Symbols as in the paper, greek letters, blank columns between, notes above and below."""
    f = Foreign("named-everything", impact)
    s = "de Rosset (2006)"
    f.put(s, "B2", "Appendix, Table A-1")
    f.put(s, "B3", "rigid sphere; 0.2 ns steps; stop when dx/dt < 1 m/s")
    given = [
        ("R", "Rp", impact.radius, "radius"),
        ("ρₚ", "rhop", impact.particle_density, "particle_density"),
        ("ρₜ", "rhot", impact.target_density, "target_density"), ("β", "bet", impact.beta, "beta"),
        ("Yₜ", "Yt", 700000000, "flow_stress"), ("V", "Vimp", impact.velocity, "velocity"),
        ("Δt", "dt_", impact.step, "step"),
    ]  # fmt: skip
    for i, (label, name, value, key) in enumerate(given):
        c = letters(2 + 2 * i)
        f.put(s, f"{c}5", label)
        f.put(s, f"{c}6", value)
        f.names[name] = f"'{s}'!${c}$6"
        f.inputs[key] = place(s, f"{c}6")
    f.put(s, "B8", "M")
    f.put(s, "B9", "=rhop*4/3*PI()*Rp*Rp*Rp")
    f.names["Mass"] = f"'{s}'!$B$9"
    columns = dict(zip("BDFHJ", [TIME, START, DEPTH, BRAKE, END], strict=True))
    for letter, head in zip(columns, ["t", "ẋ", "x(t)", "−ẍ", "ẋ new"], strict=True):
        f.put(s, f"{letter}12", head)
    for letter, content in zip("BDFH", [0, "=Vimp", 0, 0], strict=True):
        f.put(s, f"{letter}13", content)
    for k in range(1, f.steps + 1):
        r = 13 + k
        f.put(s, f"B{r}", f"=B{r - 1}+dt_")
        f.put(s, f"D{r}", "=D13" if k == 1 else f"=J{r - 1}")
        f.put(s, f"F{r}", f"=D{r}*dt_/2" if k == 1 else f"=F{r - 1}+D{r}*dt_")
        f.put(s, f"H{r}", f"=(rhot*D{r}^2/2+bet*Yt)*PI()*(2*Rp*F{r}-F{r}^2)/Mass")
        f.put(s, f"J{r}", f"=D{r}-H{r}*dt_")
    f.table(s, 13, {role: letter for letter, role in columns.items()})
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
        f.put(s, f"A{r}", label)
        f.put(s, f"B{r}", float(f"{value:.2e}"))
    for letter, head in zip(
        "ACDEF", ["Time", "dx/dt initial", "x", "d2x/dt2", "dx/dt final"], strict=True
    ):
        f.put(s, f"{letter}7", head)
    for k, row in enumerate(run(impact).rows[:5]):
        for letter, value in zip("ACDEF", row, strict=True):
            if value is not None:
                f.put(s, f"{letter}{8 + k}", float(f"{value:.2e}"))
    f.table(s, 8, {TIME: "A", START: "C", DEPTH: "D", BRAKE: "E", END: "F"})
    return f


def italian(impact: Impact) -> Foreign:
    """Words that the program does not know, no row 0, no cell for the mass."""
    f = Foreign("italian", impact)
    s = "calcolo"
    _labelled(f, s, [("raggio", "radius"), ("densità rame", "particle_density"),
                     ("densità acciaio", "target_density"), ("Rt", "resistance"),
                     ("velocità", "velocity"), ("passo", "step")])  # fmt: skip
    heads = ["tempo", "velocità iniziale", "profondità", "decelerazione", "velocità finale"]
    for letter, head in zip("ABCDE", heads, strict=True):
        f.put(s, f"{letter}9", head)
    for k in range(1, f.steps + 1):
        r = 9 + k
        f.put(s, f"A{r}", f"={k}*$B$6")
        f.put(s, f"B{r}", "=$B$5" if k == 1 else f"=E{r - 1}")
        f.put(s, f"C{r}", f"=B{r}*$B$6/2" if k == 1 else f"=C{r - 1}+B{r}*$B$6")
        mass = "(4/3*PI()*$B$1^3*$B$2)"
        f.put(s, f"D{r}", f"=(0.5*$B$3*B{r}^2+$B$4)*PI()*(2*$B$1*C{r}-C{r}^2)/{mass}")
        f.put(s, f"E{r}", f"=B{r}-D{r}*$B$6")
    f.table(s, 9, {TIME: "A", START: "B", DEPTH: "C", BRAKE: "D", END: "E"})
    return f


def no_words(impact: Impact) -> Foreign:
    """Not one word: numbers at row 500, the table in columns AA to AE."""
    f = Foreign("no-words", impact)
    s = "Sheet1"
    roles = ("velocity", "radius", "particle_density", "target_density", "resistance", "step")
    for r, role in enumerate(roles, 500):
        f.put(s, f"T{r}", _value(impact, role))
        f.inputs[role] = place(s, f"T{r}")
    f.put(s, "T506", "=T502*4/3*PI()*T501*T501*T501")
    f.put(s, "AA510", 0)
    f.put(s, "AB510", "=T500")
    f.put(s, "AC510", 0)
    for k in range(1, f.steps + 1):
        r = 510 + k
        f.put(s, f"AA{r}", f"=AA{r - 1}+$T$505")
        f.put(s, f"AB{r}", f"=AB{r - 1}" if k == 1 else f"=AE{r - 1}")
        f.put(s, f"AC{r}", f"=AB{r}*$T$505/2" if k == 1 else f"=AC{r - 1}+AB{r}*$T$505")
        f.put(s, f"AD{r}", f"=(0.5*$T$503*AB{r}^2+$T$504)*PI()*(2*$T$501*AC{r}-AC{r}^2)/$T$506")
        f.put(s, f"AE{r}", f"=AB{r}-AD{r}*$T$505")
    f.table(s, 510, {TIME: "AA", START: "AB", DEPTH: "AC", BRAKE: "AD", END: "AE"})
    return f


def centimetres(impact: Impact) -> Foreign:
    """Centimetres, grams and dynes."""
    f = Foreign("centimetres", impact, si=False)
    s = "cgs"
    given = [
        ("R [cm]", 1.1e-3, "radius"), ("rho_p [g/cm3]", 8.9, "particle_density"),
        ("rho_t [g/cm3]", 7.85, "target_density"),
        ("R_t [dyn/cm2]", impact.target_resistance * 10, "resistance"),
        ("V [cm/s]", 5e4, "velocity"), ("dt [s]", 2e-10, "step"),
    ]  # fmt: skip
    for r, (label, value, role) in enumerate(given, 1):
        f.put(s, f"A{r}", label)
        f.put(s, f"B{r}", value)
        f.inputs[role] = (s, r, 2)
    f.put(s, "A7", "M [g]")
    f.put(s, "B7", "=4/3*PI()*B1^3*B2")
    for letter, head in zip(
        "ABCDE", ["t [s]", "v0 [cm/s]", "x [cm]", "a [cm/s2]", "v1 [cm/s]"], strict=True
    ):
        f.put(s, f"{letter}9", head)
    for letter, content in zip("ABCD", [0, "=B5", 0, 0], strict=True):
        f.put(s, f"{letter}10", content)
    for k in range(1, f.steps + 1):
        r = 10 + k
        f.put(s, f"A{r}", f"=A{r - 1}+$B$6")
        f.put(s, f"B{r}", "=$B$5" if k == 1 else f"=E{r - 1}")
        f.put(s, f"C{r}", f"=B{r}*$B$6/2" if k == 1 else f"=C{r - 1}+B{r}*$B$6")
        f.put(s, f"D{r}", f"=(0.5*$B$3*B{r}^2+$B$4)*PI()*(2*$B$1*C{r}-C{r}^2)/$B$7")
        f.put(s, f"E{r}", f"=B{r}-D{r}*$B$6")
    f.table(s, 10, {TIME: "A", START: "B", DEPTH: "C", BRAKE: "D", END: "E"})
    return f


def no_deceleration(impact: Impact) -> Foreign:
    """The velocity in one formula with its deceleration, which has no column."""
    f = Foreign("no-deceleration", impact)
    s = "Daten"
    _labelled(f, s, [("Radius", "radius"), ("Dichte Cu", "particle_density"),
                     ("Dichte Stahl", "target_density"), ("Widerstand", "resistance"),
                     ("V0", "velocity"), ("dt", "step")], letters="IJ")  # fmt: skip
    f.put(s, "I7", "Masse")
    f.put(s, "J7", "=4/3*PI()*J1^3*J2")
    for letter, head in zip("ABCDE", ["n", "t", "v alt", "x", "v neu"], strict=True):
        f.put(s, f"{letter}1", head)
    for k in range(1, f.steps + 1):
        r = 1 + k
        f.put(s, f"A{r}", k)
        f.put(s, f"B{r}", f"=A{r}*$J$6")
        f.put(s, f"C{r}", "=$J$5" if k == 1 else f"=E{r - 1}")
        f.put(s, f"D{r}", f"=C{r}*$J$6/2" if k == 1 else f"=D{r - 1}+C{r}*$J$6")
        force = f"(0.5*$J$3*C{r}^2+$J$4)*PI()*(2*$J$1*D{r}-D{r}^2)"
        f.put(s, f"E{r}", f"=C{r}-{force}/$J$7*$J$6")
    f.table(s, 1, {TIME: "B", START: "C", DEPTH: "D", END: "E"})
    return f


def merged_heads(impact: Impact) -> Foreign:
    """Heads in three rows, "velocity" over "start" and "end"; every factor in the formulas."""
    f = Foreign("merged-heads", impact, si=False)
    s = "Sheet"
    given = [
        ("Impact velocity", "m/s", 500, "velocity"), ("Particle diameter", "µm", 22, "diameter"),
        ("Copper density", "g/cm3", 8.9, "particle_density"),
        ("Steel density", "g/cm3", 7.85, "target_density"),
        ("Steel flow stress", "MPa", 700, "flow_stress"), ("beta", "", impact.beta or 0, "beta"),
        ("Time step", "ns", 0.2, "step"),
    ]  # fmt: skip
    for r, (label, unit, value, role) in enumerate(given, 3):
        f.put(s, f"A{r}", label)
        f.put(s, f"B{r}", value)
        if unit:
            f.put(s, f"C{r}", unit)
        f.inputs[role] = (s, r, 2)
    f.put(s, "B13", "Velocity")
    f.put(s, "D13", "Penetration")
    f.put(s, "E13", "Decel.")
    for letter, head, unit in zip(
        "ABCDE", ["time", "start", "end", "", ""], ["ns", "m/s", "m/s", "µm", "m/s²"], strict=True
    ):
        if head:
            f.put(s, f"{letter}14", head)
        f.put(s, f"{letter}15", unit)
    for letter, content in zip("ABDE", [0, "=B3", 0, 0], strict=True):
        f.put(s, f"{letter}16", content)
    for k in range(1, f.steps + 1):
        r = 16 + k
        f.put(s, f"A{r}", f"={k}*$B$9")
        f.put(s, f"B{r}", "=B16" if k == 1 else f"=C{r - 1}")
        f.put(s, f"D{r}", f"=B{r}*$B$9/1000/2" if k == 1 else f"=D{r - 1}+B{r}*$B$9/1000")
        force = f"(0.5*$B$6*1000*B{r}^2+$B$8*$B$7*1000000)*PI()*($B$4*D{r}-D{r}^2)/1000000000000"
        f.put(s, f"E{r}", f"={force}/(PI()/6*($B$4/1000000)^3*$B$5*1000)")
        f.put(s, f"C{r}", f"=B{r}-E{r}*$B$9/1000000000")
    f.table(s, 16, {TIME: "A", START: "B", DEPTH: "D", BRAKE: "E", END: "C"})
    return f


def velocity_at_end(impact: Impact) -> Foreign:
    """Each row shows the velocity at its end; inputs on a sheet of their own."""
    f = Foreign("velocity-at-end", impact)
    s, t = "Input", "run 1"
    _labelled(f, s, [("V", "velocity"), ("R", "radius"), ("rho particle", "particle_density"),
                     ("rho target", "target_density"), ("Yield strength target", "flow_stress"),
                     ("beta", "beta"), ("dt", "step"), ("v_stop", "stop_velocity")])  # fmt: skip
    f.put(s, "A10", "m")
    f.put(s, "B10", "=4/3*PI()*B2^3*B3")
    f.put(s, "A11", "Rt")
    f.put(s, "B11", "=B5*B6")
    for letter, head in zip("ABCDE", ["step", "time", "v", "x", "a"], strict=True):
        f.put(t, f"{letter}3", head)
    for letter, content in zip("ABCDE", [0, 0, "=Input!$B$1", 0, 0], strict=True):
        f.put(t, f"{letter}4", content)
    for k in range(1, f.steps + 1):
        r = 4 + k
        f.put(t, f"A{r}", k)
        f.put(t, f"B{r}", f"=A{r}*Input!$B$7")
        step = "Input!$B$7"
        f.put(t, f"D{r}", f"=C{r - 1}*{step}/2" if k == 1 else f"=D{r - 1}+C{r - 1}*{step}")
        force = f"(0.5*Input!$B$4*C{r - 1}^2+Input!$B$11)*PI()*(2*Input!$B$2*D{r}-D{r}^2)"
        f.put(t, f"E{r}", f"={force}/Input!$B$10")
        f.put(t, f"C{r}", f"=C{r - 1}-E{r}*{step}")
    f.table(t, 4, {TIME: "B", END: "C", DEPTH: "D", BRAKE: "E"})
    return f


def named_constants(impact: Impact) -> Foreign:
    """Inputs are names that stand for numbers; filled down too far, #N/A below the stop."""
    f = Foreign("named-constants", impact)
    s = "Sheet"
    f.names = {
        "dt": "0.0000000002", "rho_t": "7850", "rho_p": "8900", "Rad": "0.000011", "V_imp": "500",
        "Rt": f"{impact.target_resistance:.0f}",
    }  # fmt: skip
    for letter, head in zip("BCDEFG", ["n", "t", "v_i", "x", "a", "v_f"], strict=True):
        f.put(s, f"{letter}2", head)
    for letter, content in zip("BCDEFG", [0, "=B3*dt", "=V_imp", 0, 0, "=V_imp"], strict=True):
        f.put(s, f"{letter}3", content)
    for r in range(4, 203):
        f.put(s, f"B{r}", r - 3)
        f.put(s, f"C{r}", f"=B{r}*dt")
        f.put(s, f"D{r}", "=V_imp" if r == 4 else f"=IF(N(G{r - 1})<1,NA(),G{r - 1})")
        f.put(s, f"E{r}", f"=D{r}*dt/2" if r == 4 else f"=E{r - 1}+D{r}*dt")
        area, mass = f"(2*Rad*E{r}-E{r}*E{r})", "(rho_p*4/3*PI()*Rad*Rad*Rad)"
        f.put(s, f"F{r}", f"=(0.5*rho_t*D{r}*D{r}+Rt)*PI()*{area}/{mass}")
        f.put(s, f"G{r}", f"=D{r}-F{r}*dt")
    f.table(s, 3, {TIME: "C", START: "D", DEPTH: "E", BRAKE: "F", END: "G"})
    return f


def six_digits(impact: Impact) -> Foreign:
    """A table exported with six digits: no formulas, no inputs, units in the heads."""
    f = Foreign("six-digits", impact, si=False)
    s = "export"
    for letter, head in zip("ABCD", ["t_ns", "v_m_per_s", "x_um", "a_m_per_s2"], strict=True):
        f.put(s, f"{letter}1", head)
    for k, row in enumerate(run(impact).rows):
        for letter, value, factor in zip("ABCD", row, (1e9, 1, 1e6, 1), strict=False):
            f.put(s, f"{letter}{2 + k}", float(f"{(value or 0) * factor:.6g}"))
    f.table(s, 2, {TIME: "A", START: "B", DEPTH: "C", BRAKE: "D"})
    return f


def _labelled(f: Foreign, sheet: str, labels: list[tuple[str, str]], letters: str = "AB") -> None:
    """Inputs in SI below each other, from row 1."""
    for r, (label, role) in enumerate(labels, 1):
        f.put(sheet, f"{letters[0]}{r}", label)
        f.put(sheet, f"{letters[1]}{r}", _value(f.impact, role))
        f.inputs[role] = place(sheet, f"{letters[1]}{r}")


def _value(impact: Impact, role: str) -> float:
    value = impact.target_resistance if role == "resistance" else getattr(impact, role)
    assert isinstance(value, float)
    return value


BY_HAND: tuple[Callable[[Impact], Foreign], ...] = (
    table_a1, german, french, sideways, no_time, one_velocity, side_by_side, guarded, pasted,
    natural_units, named_everything, printed_digits, italian, no_words, centimetres,
    no_deceleration, merged_heads, velocity_at_end, named_constants, six_digits,
)  # fmt: skip


def by_hand(impact: Impact) -> list[Foreign]:
    """Every layout, filled with that impact."""
    return [layout(impact) for layout in BY_HAND]
