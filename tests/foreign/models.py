"""Tables of other models, with depths, velocities, masses of their own: none is the scheme.

To each of them the right answer is status 2: another model, or no table of depth and velocity.
"""

from collections.abc import Callable

from foreign.layouts import Foreign, Page, filled

from replication.cases import BETA_5


def _book(name: str, sheet: str = "Sheet1") -> tuple[Foreign, Page]:
    f = Foreign(name, BETA_5)  # the impact says nothing here
    return f, Page(f, sheet)


def _inputs(page: Page, *lines: tuple[str, float | str]) -> None:
    for i, (label, value) in enumerate(lines, 1):
        page.row(f"A{i}", label, value)


def ball_with_drag() -> Foreign:
    """A ball thrown level, slowed by the air: drag with the square of the velocity."""
    f, page = _book("ball with drag")
    _inputs(page, ("mass (kg)", 0.145), ("radius (m)", 0.0366), ("air density", 1.2),
            ("C_d", 0.35), ("V0 (m/s)", 40.0), ("dt (s)", 0.05), ("A", "=PI()*B2^2"))  # fmt: skip
    t = page.table(10, steps=60)
    t.column("A", "t", "", 0.0, "=A10+$B$6")
    t.column("B", "v", "", "=B5", "=B10-D10*$B$6")
    t.column("C", "x", "", 0.0, "=C10+B10*$B$6")
    t.column("D", "a", "", "=0.5*$B$3*$B$4*$B$7*B10^2/$B$1", "=0.5*$B$3*$B$4*$B$7*B11^2/$B$1")
    return f


def thrown_ball() -> Foreign:
    """A ball thrown at an angle, in two dimensions, with drag."""
    f, page = _book("thrown ball", "throw")
    _inputs(page, ("m", 5.0), ("R [m]", 0.11), ("rho air", 1.225), ("V", 25.0), ("angle", 40.0),
            ("dt", 0.02), ("g", 9.81), ("k", "=0.5*B3*0.47*PI()*B2^2/B1"))  # fmt: skip
    t = page.table(12, steps=90)
    t.column("A", "time", "", 0.0, "=A12+$B$6")
    t.column("B", "v_x", "", "=B4*COS(RADIANS(B5))", "=B12-$B$8*F12*B12*$B$6")
    t.column("C", "v_y", "", "=B4*SIN(RADIANS(B5))", "=C12-($B$7+$B$8*F12*C12)*$B$6")
    t.column("D", "x", "", 0.0, "=D12+B13*$B$6")
    t.column("E", "y", "", 2.0, "=E12+C13*$B$6")
    t.column("F", "speed", "", "=SQRT(B12^2+C12^2)", "=SQRT(B13^2+C13^2)")
    return f


def falling_ball() -> Foreign:
    """A ball that falls from rest to its terminal velocity."""
    f, page = _book("falling ball")
    _inputs(page, ("radius [m]", 0.02), ("density of ball", 7850.0), ("density of fluid", 1000.0),
            ("mass", "=4/3*PI()*B1^3*B2"), ("dt", 0.002), ("g", 9.81), ("Cd", 0.44))  # fmt: skip
    t = page.table(11, steps=120)
    t.column("A", "t [s]", "", 0.0, "=A11+$B$5")
    t.column("B", "v start", "", 0.0, "=E11", first="=B11")
    t.column("C", "depth", "", 0.0, "=C12+B13*$B$5", first="=B12*$B$5/2")
    t.column("D", "a", "", 0.0, "=$B$6*(1-$B$3/$B$2)-0.5*$B$3*$B$7*PI()*$B$1^2*B12^2/$B$4")
    t.column("E", "v end", "", 0.0, "=B12+D12*$B$5")
    return f


def stokes() -> Foreign:
    """A small sphere in oil: drag in proportion to the velocity."""
    f, page = _book("sphere in oil")
    _inputs(page, ("R (m)", 0.001), ("rho_p", 2500.0), ("rho_f", 900.0), ("eta", 0.2),
            ("M", "=4/3*PI()*B1^3*B2"), ("step", 0.0005), ("V0", 1.0))  # fmt: skip
    t = page.table(10, steps=80)
    t.column("A", "t", "", 0.0, "=A10+$B$6")
    t.column("B", "v_i", "", "=B7", "=E10", first="=B10")
    t.column("C", "x", "", 0.0, "=C11+B12*$B$6", first="=B11*$B$6/2")
    t.column("D", "a", "", 0.0, "=6*PI()*$B$4*$B$1*B11/$B$5")
    t.column("E", "v_f", "", "=B7", "=B11-D11*$B$6")
    return f


def rolling() -> Foreign:
    """A ball that rolls out on a lawn."""
    f, page = _book("rolling ball", "lawn")
    _inputs(page, ("V0", 6.0), ("mu", 0.08), ("g", 9.81), ("dt", 0.1))
    t = page.table(8, steps=70)
    t.column("A", "t", "", 0.0, "=A8+$B$4")
    t.column("B", "v before", "", "=B1", "=E8", first="=B8")
    t.column("C", "way", "", 0.0, "=C9+B10*$B$4", first="=B9*$B$4/2")
    t.column("D", "deceleration", "", 0.0, "=$B$2*$B$3")
    t.column("E", "v after", "", "=B1", "=B9-D9*$B$4")
    return f


def braking() -> Foreign:
    """A car that brakes, in km/h."""
    f, page = _book("braking car")
    _inputs(page, ("speed km/h", 100.0), ("deceleration", 7.5), ("dt", 0.1))
    t = page.table(7, steps=37)
    t.column("A", "s", "", 0.0, "=A7+$B$3")
    t.column("B", "km/h", "", "=B1", "=B7-$B$2*$B$3*3.6")
    t.column("C", "m", "", 0.0, "=C7+(B7+B8)/2/3.6*$B$3")
    return f


def ship() -> Foreign:
    """A ship whose engine stops: the velocity decays."""
    f, page = _book("ship")
    _inputs(page, ("v0", 8.0), ("tau", 120.0), ("dt", 5.0))
    t = page.table(6, steps=80)
    t.column("A", "t", "", 0.0, "=A6+$B$3")
    t.column("B", "v", "", "=B1", "=B6*(1-$B$3/$B$2)")
    t.column("C", "x", "", 0.0, "=C6+B6*$B$3")
    return f


def bullet() -> Foreign:
    """A bullet in air: drag at full cross-section from the start, no resistance."""
    f, page = _book("bullet")
    _inputs(page, ("calibre (m)", 0.00782), ("mass (kg)", 0.0095), ("muzzle velocity", 830.0),
            ("rho", 1.225), ("c_w", 0.3), ("dt", 0.01))  # fmt: skip
    t = page.table(9, steps=150)
    t.column("A", "time", "", 0.0, "=A9+$B$6")
    t.column("B", "velocity", "", "=B3", "=B9-D9*$B$6")
    t.column("C", "range", "", 0.0, "=C9+B10*$B$6")
    drag = "=$B$4*$B$5*PI()*$B$1^2/8*B9^2/$B$2"
    t.column("D", "decel", "", drag, filled(drag, 1))
    return f


def spring() -> Foreign:
    """A mass at a spring, first quarter of its swing."""
    f, page = _book("spring")
    _inputs(page, ("k", 50.0), ("M", 0.5), ("v0", 2.0), ("dt", 0.002))
    t = page.table(7, steps=75)
    t.column("A", "t", "", 0.0, "=A7+$B$4")
    t.column("B", "v1", "", "=B3", "=E7", first="=B7")
    t.column("C", "x", "", 0.0, "=C8+B9*$B$4", first="=B8*$B$4/2")
    t.column("D", "a", "", 0.0, "=$B$1*C8/$B$2")
    t.column("E", "v2", "", "=B3", "=B8-D8*$B$4")
    return f


def decay() -> Foreign:
    """Two nuclides, one the daughter of the other."""
    f, page = _book("decay")
    _inputs(page, ("half-life 1 [h]", 6.0), ("half-life 2 [h]", 20.0), ("step [h]", 0.5),
            ("N0", 1e6), ("l1", "=LN(2)/B1"), ("l2", "=LN(2)/B2"))  # fmt: skip
    t = page.table(10, steps=100)
    t.column("A", "t", "", 0.0, "=A10+$B$3")
    t.column("B", "N1", "", "=B4", "=B10-$B$5*B10*$B$3")
    t.column("C", "N2", "", 0.0, "=C10+($B$5*B10-$B$6*C10)*$B$3")
    t.column("D", "decayed", "", 0.0, "=D10+B10*$B$3")
    return f


def loan() -> Foreign:
    """A loan that is paid back in equal rates."""
    f, page = _book("loan", "Kredit")
    _inputs(page, ("sum", 240000.0), ("rate p.a.", 0.036), ("months", 120.0),
            ("payment", "=B1*B2/12/(1-(1+B2/12)^-B3)"))  # fmt: skip
    t = page.table(8, steps=120)
    t.column("A", "month", "", 0.0, float)
    t.column("B", "debt before", "", "=B1", "=F8", first="=B1")
    t.column("C", "interest", "", None, "=B9*$B$2/12")
    t.column("D", "principal", "", None, "=$B$4-C9")
    t.column("E", "paid in all", "", 0.0, "=E8+D9")
    t.column("F", "debt after", "", "=B1", "=B9-D9")
    return f


def discharge() -> Foreign:
    """A capacitor that loses its charge."""
    f, page = _book("capacitor")
    _inputs(page, ("U0", 12.0), ("R", 10000.0), ("C", 0.0001), ("dt", 0.02))
    t = page.table(7, steps=90)
    t.column("A", "t", "", 0.0, "=A7+$B$4")
    t.column("B", "U", "", "=B1", "=B7-C7/$B$3*$B$4")
    t.column("C", "I", "", "=B7/$B$2", "=B8/$B$2")
    t.column("D", "Q", "", 0.0, "=D7+C7*$B$4")
    return f


def cooling() -> Foreign:
    """A cup of tea."""
    f, page = _book("cooling")
    _inputs(page, ("T0", 90.0), ("T room", 20.0), ("k", 0.05), ("dt", 1.0))
    t = page.table(7, steps=60)
    t.column("A", "min", "", 0.0, "=A7+$B$4")
    t.column("B", "T", "", "=B1", "=B7-$B$3*(B7-$B$2)*$B$4")
    t.column("C", "heat lost", "", 0.0, "=C7+(B7-$B$2)*$B$4")
    return f


def growth() -> Foreign:
    """Growth up to a limit."""
    f, page = _book("growth")
    _inputs(page, ("N0", 10.0), ("r", 0.4), ("K", 500.0), ("dt", 0.25))
    t = page.table(7, steps=80)
    t.column("A", "t", "", 0.0, "=A7+$B$4")
    t.column("B", "N", "", "=B1", "=B7+C7*$B$4")
    t.column("C", "dN/dt", "", "=$B$2*B7*(1-B7/$B$3)", "=$B$2*B8*(1-B8/$B$3)")
    return f


def pendulum() -> Foreign:
    """A pendulum that swings through."""
    f, page = _book("pendulum")
    _inputs(page, ("L", 1.5), ("omega0", 2.0), ("dt", 0.01), ("g", 9.81))
    t = page.table(7, steps=60)
    t.column("A", "t", "", 0.0, "=A7+$B$3")
    t.column("B", "omega", "", "=B2", "=B7-$B$4/$B$1*SIN(C7)*$B$3")
    t.column("C", "phi", "", 0.0, "=C7+B8*$B$3")
    return f


def rocket() -> Foreign:
    """A rocket that loses mass."""
    f, page = _book("rocket")
    _inputs(page, ("m0", 1000.0), ("burn", 5.0), ("v gas", 2500.0), ("dt", 1.0))
    t = page.table(7, steps=100)
    t.column("A", "t", "", 0.0, "=A7+$B$4")
    t.column("B", "mass", "", "=B1", "=B7-$B$2*$B$4")
    t.column("C", "v", "", 0.0, "=C7+($B$2*$B$3/B7-9.81)*$B$4")
    t.column("D", "height", "", 0.0, "=D7+C8*$B$4")
    return f


def closed_form() -> Foreign:
    """Depths for some velocities by another equation of the report, without steps."""
    f, page = _book("depths by velocity")
    _inputs(page, ("rho_p", 8900.0), ("rho_t", 7850.0), ("R_t", 3.5e9), ("R", 11e-6))
    t = page.table(8, steps=40)
    t.column("A", "V", "", 300.0, "=A8+10")
    depth = "=$B$4*$B$1/$B$2*LN(1+$B$2*A8^2/2/$B$3)"
    t.column("B", "X", "", depth, filled(depth, 1))
    t.column("C", "X/R", "", "=B8/$B$4", "=B9/$B$4")
    return f


def measured() -> Foreign:
    """Measured crater depths, typed."""
    f, page = _book("measured")
    page.row("A1", "shot", "velocity (m/s)", "depth (µm)")
    shots = ((412, 5.6), (455, 6.9), (478, 7.1), (503, 7.9), (520, 8.0), (551, 8.8), (580, 9.9))
    for i, (velocity, depth) in enumerate(shots, 2):
        page.row(f"A{i}", float(i - 1), float(velocity), depth)
    return f


def journey() -> Foreign:
    """A timetable."""
    f, page = _book("journey")
    page.row("A1", "km", "h", "km/h")
    for i in range(2, 14):
        page.row(f"A{i}", float(17 * i), 0.25 * i, f"=A{i}/B{i}")
    return f


def nothing() -> Foreign:
    """A sheet of texts."""
    f, page = _book("nothing")
    for i in range(1, 30):
        page.row(f"A{i}", f"item {i}", "x")
    return f


MODELS: tuple[Callable[[], Foreign], ...] = (
    ball_with_drag, thrown_ball, falling_ball, stokes, rolling, braking, ship, bullet, spring,
    decay, loan, discharge, cooling, growth, pendulum, rocket, closed_form, measured, journey,
    nothing,
)  # fmt: skip
