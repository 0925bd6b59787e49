"""The layouts: workbooks of the report's sheet, each with one engineer's habits.

They were written before the program that reads them, and share nothing with it: cells, formulas and
heads as somebody would type them. Formulas are those of the first row that has them; they move as a
spreadsheet fills them.
"""

from collections.abc import Callable

from foreign.layouts import (
    BRAKE,
    DEPTH,
    END,
    START,
    TIME,
    Foreign,
    Input,
    Own,
    Page,
    decimal,
    printed,
)

from replication.models.impact import Impact


def table_a1(f: Foreign) -> None:
    """The report's own table: blank column B, step and target density typed into the formulas."""
    page = Page(f, "Sheet1")
    dt, rho_t = decimal(f.impact.step), decimal(f.impact.target_density)
    page.row("A1", "R =", Input("radius"))
    page.row("A2", "Density =", Input("particle_density"))
    page.row("A3", "M =", "=B2*4/3*PI()*B1*B1*B1")
    page.row("A4", "D =", "=2*B1")
    page.row("A5", "Initial vel =", Input("velocity"))
    page.row("A6", "Rt =", Input("resistance"))
    table = page.table(8)
    table.column("A", "Time", TIME, 0, f"=A9+{dt}", first=f"=1*{dt}")
    table.column("C", "dx/dt initial", START, "=B5", "=F9", first="=C8")
    table.column("D", "x", DEPTH, 0, f"=D9+C10*{dt}", first=f"=C9*{decimal(f.impact.step / 2)}")
    table.column("E", "d²x/dt²", BRAKE, 0, f"=(0.5*{rho_t}*C9^2+$B$6)*PI()*($B$4*D9-D9^2)/$B$3")
    table.column("F", "dx/dt final", END, None, f"=C9-E9*{dt}")


def german(f: Foreign) -> None:
    """Eingaben links in handlichen Einheiten, SI daneben; Tabelle darunter in µm und ns."""
    f.si = False
    page = Page(f, "Rechnung")
    page.row("A1", "Eindringen einer starren Kupferkugel in Edelstahl")
    page.row("B3", "Wert", "Einheit", "SI")
    page.row("A4", "Partikelradius R", Input("radius", 1e6), "µm", "=B4*0.000001")
    page.row("A5", "Dichte Partikel", Input("particle_density", 1e-3), "g/cm³", "=B5*1000")
    page.row("A6", "Dichte Ziel", Input("target_density", 1e-3), "g/cm³", "=B6*1000")
    page.row("A7", "Fließspannung", Input("flow_stress", 1e-6), "MPa", "=B7*1000000")
    page.row("A8", "Faktor beta", Input("beta"), "-", "=B8")
    page.row("A9", "Auftreffgeschwindigkeit", Input("velocity"), "m/s", "=B9")
    page.row("A10", "Zeitschritt", Input("step", 1e9), "ns", "=B10*0.000000001")
    page.row("A11", "Abbruchgeschwindigkeit", Input("stop_velocity"), "m/s", "=B11")
    page.row("A12", "Durchmesser D", None, None, "=2*D4")
    page.row("A13", "Masse M [kg]", None, None, "=4/3*PI()*D4^3*D5")
    page.row("A14", "Zielwiderstand R_t [Pa]", None, None, "=D8*D7")
    table = page.table(18)
    table.column("A", "Schritt", "", 0, "=A18+1")
    table.column("B", "Zeit [ns]", TIME, 0, "=A19*$B$10")
    table.column("C", "v Anfang [m/s]", START, "=D9", "=G19", first="=C18")
    table.column(
        "D", "Eindringtiefe [µm]", DEPTH, 0, "=D19+C20*$D$10*1000000", first="=C19*$D$10/2*1000000"
    )
    table.column("E", "Kontaktfläche [µm²]", "", 0, "=PI()*($D$12*1000000*D19-D19^2)")
    table.column(
        "F", "Verzögerung [m/s²]", BRAKE, 0, "=(0.5*$D$6*C19^2+$D$14)*E19*0.000000000001/$D$13"
    )
    table.column("G", "v Ende [m/s]", END, None, "=C19-F19*$D$10")
    page.row("F4", "Endtiefe [µm]", f"=D{table.last}")
    page.row("F5", "X/R", "=G4/B4")


def french(f: Foreign) -> None:
    """Données sur une feuille, noms définis, calcul sur une autre, commencé loin du coin."""
    page = Page(f, "Données")
    page.row("B3", "rayon de la particule (m)", Input("radius"))
    page.row("B4", "masse volumique du cuivre (kg/m3)", Input("particle_density"))
    page.row("B5", "masse volumique de la cible (kg/m3)", Input("target_density"))
    page.row("B6", "contrainte d'écoulement (Pa)", Input("flow_stress"))
    page.row("B7", "bêta", Input("beta"))
    page.row("B8", "vitesse d'impact (m/s)", Input("velocity"))
    page.row("B9", "pas de temps (s)", Input("step"))
    page.row("B10", "vitesse d'arrêt (m/s)", Input("stop_velocity"))
    page.row("B12", "résistance de la cible (Pa)", "=beta*Y_c")
    page.row("B13", "masse (kg)", "=rho_p*4/3*PI()*rayon*rayon*rayon")
    f.names["rayon"] = "'Données'!$C$3"
    f.names["rho_p"] = "'Données'!$C$4"
    f.names["rho_c"] = "'Données'!$C$5"
    f.names["Y_c"] = "'Données'!$C$6"
    f.names["beta"] = "'Données'!$C$7"
    f.names["V_0"] = "'Données'!$C$8"
    f.names["delta_t"] = "'Données'!$C$9"
    f.names["v_arret"] = "'Données'!$C$10"
    f.names["R_cible"] = "'Données'!$C$12"
    f.names["masse"] = "'Données'!$C$13"
    page = Page(f, "Calcul pas à pas")
    table = page.table(21)
    table.column("E", "temps (s)", TIME, 0, "=E21+delta_t")
    table.column("F", "vitesse initiale", START, "=V_0", "=I22", first="=V_0")
    table.column("G", "profondeur (m)", DEPTH, 0, "=G22+F23*delta_t", first="=F22*(delta_t/2)")
    table.column(
        "H",
        "décélération",
        BRAKE,
        0,
        "=(0.5*rho_c*F22*F22+R_cible)*PI()*(2*rayon*G22-G22*G22)/masse",
    )
    table.column("I", "vitesse finale", END, None, "=F22-H22*delta_t")


def sideways(f: Foreign) -> None:
    """Time runs to the right; labels at the left, with units in the next cell."""
    page = Page(f, "Sheet 1")
    page.row("B2", "V", Input("velocity"), "m/s")
    page.row("B3", "R", Input("radius"), "m")
    page.row("B4", "rho_p", Input("particle_density"), "kg/m^3")
    page.row("B5", "rho_t", Input("target_density"), "kg/m^3")
    page.row("B6", "R_t", Input("resistance"), "Pa")
    page.row("B7", "dt", Input("step"), "s")
    page.row("B8", "M", "=C4*4/3*PI()*C3*C3*C3", "kg")
    page.row("B11", "t", "s")
    page.row("B12", "v_i", "m/s")
    page.row("B13", "x", "m")
    page.row("B14", "a", "m/s^2")
    page.row("B15", "v_f", "m/s")
    table = page.table(4, across=True)
    table.column("11", "", TIME, 0, "=D11+$C$7")
    table.column("12", "", START, "=C2", "=E15", first="=D12")
    table.column("13", "", DEPTH, 0, "=E13+F12*$C$7", first="=E12*$C$7/2")
    table.column("14", "", BRAKE, 0, "=(0.5*$C$5*E12^2+$C$6)*PI()*(2*$C$3*E13-E13^2)/$C$8")
    table.column("15", "", END, None, "=E12-E14*$C$7")


def no_time(f: Foreign) -> None:
    """Rows numbered behind, no time; area, force and energy beside; inputs under the table."""
    page = Page(f, "impact")
    page.row("H200", "impact velocity (m/s)", None, Input("velocity"))
    page.row("H201", "particle radius (m)", None, Input("radius"))
    page.row("H202", "particle density (kg/m3)", None, Input("particle_density"))
    page.row("H203", "target density (kg/m3)", None, Input("target_density"))
    page.row("H204", "target strength (Pa)", None, Input("flow_stress"))
    page.row("H205", "beta", None, Input("beta"))
    page.row("H206", "time step (s)", None, Input("step"))
    page.row("H208", "mass (kg)", None, "=4*PI()/3*$J$201^3*$J$202")
    table = page.table(5)
    table.column("C", "v start", START, "=$J$200", "=H6", first="=C5")
    table.column("D", "depth x", DEPTH, 0, "=D6+C7*$J$206", first="=C6*$J$206/2")
    table.column("E", "A(x)", "", None, "=PI()*(2*$J$201*D6-D6^2)")
    table.column("F", "force", "", None, "=(0.5*$J$203*C6^2+$J$205*$J$204)*E6")
    table.column("G", "acceleration", BRAKE, None, "=F6/$J$208")
    table.column("H", "v end", END, None, "=C6-G6*$J$206")
    table.column("I", "kinetic energy", "", "=0.5*$J$208*C5^2", "=0.5*$J$208*C6^2")
    table.column("J", "n", "", 0, float)


def one_velocity(f: Foreign) -> None:
    """One velocity a row, at its beginning; the next row takes it on. Acceleration negative."""
    page = Page(f, "Tabelle1")
    page.row(
        "A1",
        "V0 [m/s]",
        Input("velocity"),
        "D [m]",
        Input("diameter"),
        "rho Ziel [kg/m3]",
        Input("target_density"),
    )
    page.row(
        "A2",
        "dt [s]",
        Input("step"),
        "Rt [Pa]",
        Input("resistance"),
        "rho Kugel [kg/m3]",
        Input("particle_density"),
    )
    page.row("A3", "m [kg]", "=PI()/6*D1^3*F2")
    table = page.table(6)
    table.column("A", "t in s", TIME, 0, lambda k: f"={k}*$B$2")
    table.column("B", "x in m", DEPTH, 0, "=B7+C8*$B$2", first="=C7*$B$2/2")
    table.column("C", "v in m/s", START, "=B1", "=C6+D6*$B$2")
    table.column(
        "D", "Beschleunigung in m/s²", BRAKE, 0, "=-(0.5*$F$1*C7^2+$D$2)*PI()*($D$1*B7-B7^2)/$B$3"
    )


def side_by_side(f: Foreign) -> None:
    """Both betas on one sheet, each with its own table; the impact's is the left one."""
    page = Page(f, "beta 3 and 5")
    page.row("A1", "R (m)", Input("radius"))
    page.row("A2", "D (m)", "=2*B1")
    page.row("A3", "density of copper", Input("particle_density"))
    page.row("A4", "density of steel", Input("target_density"))
    page.row("A5", "M (kg)", "=B3*4/3*PI()*B1*B1*B1")
    page.row("A6", "Y (Pa)", Input("flow_stress"))
    page.row("A7", "V (m/s)", Input("velocity"))
    page.row("A8", "dt (s)", Input("step"))
    page.row("H11", "beta", f.another.beta, "Rt", "=I11*B6")
    table = page.table(14, another=True)
    table.column("H", "#", "", 0, float)
    table.column("I", "time / s", "", "=H14*$B$8", "=H15*$B$8")
    table.column("J", "v1 / (m/s)", "", "=$B$7", "=M15", first="=$B$7")
    table.column("K", "x / m", "", 0, "=K15+J16*$B$8", first="=J15*$B$8/2")
    table.column("L", "a / (m/s2)", "", 0, "=(0.5*$B$4*J15*J15+$K$11)*PI()*($B$2*K15-K15*K15)/$B$5")
    table.column("M", "v2 / (m/s)", "", None, "=J15-L15*$B$8")
    page.row("A11", "beta", Input("beta"), "Rt", "=B11*B6")
    table = page.table(14)
    table.column("A", "#", "", 0, float)
    table.column("B", "time / s", TIME, "=A14*$B$8", "=A15*$B$8")
    table.column("C", "v1 / (m/s)", START, "=$B$7", "=F15", first="=$B$7")
    table.column("D", "x / m", DEPTH, 0, "=D15+C16*$B$8", first="=C15*$B$8/2")
    table.column(
        "E", "a / (m/s2)", BRAKE, 0, "=(0.5*$B$4*C15*C15+$D$11)*PI()*($B$2*D15-D15*D15)/$B$5"
    )
    table.column("F", "v2 / (m/s)", END, None, "=C15-E15*$B$8")


def guarded(f: Foreign) -> None:
    """Filled down to row 400, blank below the stop; two rows of heads, the second with units."""
    page = Page(f, "Model")
    page.row("J3", "Particle radius", Input("radius"), "m")
    page.row("J4", "Particle density", Input("particle_density"), "kg/m³")
    page.row("J5", "Target density", Input("target_density"), "kg/m³")
    page.row("J6", "Impact speed", Input("velocity"), "m/s")
    page.row("J7", "Target resistance", Input("resistance"), "Pa")
    page.row("J8", "Time increment", Input("step"), "s")
    page.row("J9", "Stop below", Input("stop_velocity"), "m/s")
    page.row("J10", "Particle mass", "=K4*4/3*PI()*K3*K3*K3", "kg")
    table = page.table(5, heads=3, steps=395)
    table.column("B", "Step", "", 0, '=IF(N(G6)<$K$9,"",B6+1)', first="=B5+1")
    table.column("C", "Time", TIME, 0, '=IF(ISNUMBER(B6),B6*$K$8,"")')
    table.column(
        "D",
        "Initial speed",
        START,
        "=K6",
        '=IF(ISNUMBER(B7),G6,"")',
        first='=IF(ISNUMBER(B6),$K$6,"")',
    )
    table.column(
        "E",
        "Penetration",
        DEPTH,
        0,
        '=IF(ISNUMBER(B7),E6+D7*$K$8,"")',
        first='=IF(ISNUMBER(B6),D6*$K$8/2,"")',
    )
    table.column(
        "F",
        "Deceleration",
        BRAKE,
        0,
        '=IF(ISNUMBER(B6),(0.5*$K$5*D6*D6+$K$7)*PI()*IF(E6<$K$3,2*$K$3*E6-E6*E6,$K$3*$K$3)/$K$10,"")',
    )
    table.column("G", "Final speed", END, None, '=IF(ISNUMBER(B6),D6-F6*$K$8,"")')
    page.row("C4", "s", "m/s", "m", "m/s²", "m/s")
    page.row("J12", "Final depth", "=MAX(E5:E400)", "m")
    page.row("J13", "Depth / radius", "=K12/K3")


def pasted(f: Foreign) -> None:
    """Values only, as a script wrote them: a data frame with its index, no inputs at all."""
    page = Page(f, "Sheet1")
    table = page.table(2)
    table.column("A", "", "", 0.0, float)
    table.column("B", "t", TIME, 0.0, Own(TIME))
    table.column("C", "v0", START, Own(START), Own(START))
    table.column("D", "x", DEPTH, 0.0, Own(DEPTH))
    table.column("E", "a", BRAKE, 0.0, Own(BRAKE))
    table.column("F", "v1", END, None, Own(END))


def natural_units(f: Foreign) -> None:
    """Micrometres, nanoseconds and km/s = µm/ns throughout, so that formulas need no factors.

    With the mass in pg = 1e-15 kg pg/(µm ns²) = 1e9 Pa, so GPa fit, too, and densities in pg/µm³
    are those in g/cm³.
    """
    f.si = False
    page = Page(f, "µm-ns")
    page.row("A1", "R [µm]", Input("radius", 1e6))
    page.row("A2", "ρp [g/cm³]", Input("particle_density", 1e-3))
    page.row("A3", "ρt [g/cm³]", Input("target_density", 1e-3))
    page.row("A4", "Rt [GPa]", Input("resistance", 1e-9))
    page.row("A5", "V [km/s]", Input("velocity", 1e-3))
    page.row("A6", "Δt [ns]", Input("step", 1e9))
    page.row("A7", "M [ng/1000]", "=4/3*PI()*B1^3*B2")
    table = page.table(2)
    table.column("D", "t [ns]", TIME, 0, "=D2+$B$6")
    table.column("E", "v1 [km/s]", START, "=B5", "=H3", first="=E2")
    table.column("F", "x [µm]", DEPTH, 0, "=F3+E4*$B$6", first="=E3*$B$6/2")
    table.column("G", "a [µm/ns²]", BRAKE, 0, "=(0.5*$B$3*E3^2+$B$4)*PI()*(2*$B$1*F3-F3^2)/$B$7")
    table.column("H", "v2 [km/s]", END, None, "=E3-G3*$B$6")


def named_everything(f: Foreign) -> None:
    """Symbols as in the paper, greek letters, blank columns between, notes above and below."""
    page = Page(f, "de Rosset (2006)")
    page.row("B2", "Appendix, Table A-1")
    page.row("B3", "rigid sphere; 0.2 ns steps; stop when dx/dt < 1 m/s")
    page.row("B5", "R", None, "ρₚ", None, "ρₜ", None, "β", None, "Yₜ", None, "V", None, "Δt")
    page.row(
        "B6",
        Input("radius"),
        None,
        Input("particle_density"),
        None,
        Input("target_density"),
        None,
        Input("beta"),
        None,
        Input("flow_stress"),
        None,
        Input("velocity"),
        None,
        Input("step"),
    )
    f.names["Rp"] = "'de Rosset (2006)'!$B$6"
    f.names["rhop"] = "'de Rosset (2006)'!$D$6"
    f.names["rhot"] = "'de Rosset (2006)'!$F$6"
    f.names["bet"] = "'de Rosset (2006)'!$H$6"
    f.names["Yt"] = "'de Rosset (2006)'!$J$6"
    f.names["Vimp"] = "'de Rosset (2006)'!$L$6"
    f.names["dt_"] = "'de Rosset (2006)'!$N$6"
    page.row("B8", "M")
    page.row("B9", "=rhop*4/3*PI()*Rp*Rp*Rp")
    f.names["Mass"] = "'de Rosset (2006)'!$B$9"
    table = page.table(13)
    table.column("B", "t", TIME, 0, "=B13+dt_")
    table.column("D", "ẋ", START, "=Vimp", "=J14", first="=D13")
    table.column("F", "x(t)", DEPTH, 0, "=F14+D15*dt_", first="=D14*dt_/2")
    table.column("H", "−ẍ", BRAKE, 0, "=(rhot*D14^2/2+bet*Yt)*PI()*(2*Rp*F14-F14^2)/Mass")
    table.column("J", "ẋ new", END, None, "=D14-H14*dt_")
    page.row("B200", "checked 3/14, agrees with Fig. 3")


def printed_digits(f: Foreign) -> None:
    """The printed table typed off the page: five rows, three digits, no formula anywhere."""
    page = Page(f, "Table A-1")
    page.row("A1", "R =", printed(f.impact.radius))
    page.row("A2", "Density =", printed(f.impact.particle_density))
    page.row("A3", "M =", printed(f.impact.mass))
    page.row("A4", "D =", printed(f.impact.diameter))
    page.row("A5", "Initial vel =", printed(f.impact.velocity))
    page.row("A6", "Rt =", printed(f.impact.target_resistance))
    table = page.table(8, steps=4)
    table.column("A", "Time", TIME, 0.0, Own(TIME, form=".2e"))
    table.column("C", "dx/dt initial", START, Own(START, form=".2e"), Own(START, form=".2e"))
    table.column("D", "x", DEPTH, 0.0, Own(DEPTH, form=".2e"))
    table.column("E", "d2x/dt2", BRAKE, 0.0, Own(BRAKE, form=".2e"))
    table.column("F", "dx/dt final", END, None, Own(END, form=".2e"))


def italian(f: Foreign) -> None:
    """Words that the program does not know, no row 0, no cell for the mass."""
    page = Page(f, "calcolo")
    page.row("A1", "raggio", Input("radius"))
    page.row("A2", "densità rame", Input("particle_density"))
    page.row("A3", "densità acciaio", Input("target_density"))
    page.row("A4", "Rt", Input("resistance"))
    page.row("A5", "velocità", Input("velocity"))
    page.row("A6", "passo", Input("step"))
    table = page.table(9, heads=9)
    table.column("A", "tempo", TIME, None, lambda k: f"={k}*$B$6")
    table.column("B", "velocità iniziale", START, None, "=E10", first="=$B$5")
    table.column("C", "profondità", DEPTH, None, "=C10+B11*$B$6", first="=B10*$B$6/2")
    table.column(
        "D",
        "decelerazione",
        BRAKE,
        None,
        "=(0.5*$B$3*B10^2+$B$4)*PI()*(2*$B$1*C10-C10^2)/(4/3*PI()*$B$1^3*$B$2)",
    )
    table.column("E", "velocità finale", END, None, "=B10-D10*$B$6")


def no_words(f: Foreign) -> None:
    """Not one word: numbers at row 500, the table in columns AA to AE."""
    page = Page(f, "Sheet1")
    page.row("T500", Input("velocity"))
    page.row("T501", Input("radius"))
    page.row("T502", Input("particle_density"))
    page.row("T503", Input("target_density"))
    page.row("T504", Input("resistance"))
    page.row("T505", Input("step"))
    page.row("T506", "=T502*4/3*PI()*T501*T501*T501")
    table = page.table(510)
    table.column("AA", "", TIME, 0, "=AA510+$T$505")
    table.column("AB", "", START, "=T500", "=AE511", first="=AB510")
    table.column("AC", "", DEPTH, 0, "=AC511+AB512*$T$505", first="=AB511*$T$505/2")
    table.column(
        "AD", "", BRAKE, None, "=(0.5*$T$503*AB511^2+$T$504)*PI()*(2*$T$501*AC511-AC511^2)/$T$506"
    )
    table.column("AE", "", END, None, "=AB511-AD511*$T$505")


def centimetres(f: Foreign) -> None:
    """Centimetres, grams and dynes."""
    f.si = False
    page = Page(f, "cgs")
    page.row("A1", "R [cm]", Input("radius", 100))
    page.row("A2", "rho_p [g/cm3]", Input("particle_density", 1e-3))
    page.row("A3", "rho_t [g/cm3]", Input("target_density", 1e-3))
    page.row("A4", "R_t [dyn/cm2]", Input("resistance", 10))
    page.row("A5", "V [cm/s]", Input("velocity", 100))
    page.row("A6", "dt [s]", Input("step"))
    page.row("A7", "M [g]", "=4/3*PI()*B1^3*B2")
    table = page.table(10)
    table.column("A", "t [s]", TIME, 0, "=A10+$B$6")
    table.column("B", "v0 [cm/s]", START, "=B5", "=E11", first="=$B$5")
    table.column("C", "x [cm]", DEPTH, 0, "=C11+B12*$B$6", first="=B11*$B$6/2")
    table.column("D", "a [cm/s2]", BRAKE, 0, "=(0.5*$B$3*B11^2+$B$4)*PI()*(2*$B$1*C11-C11^2)/$B$7")
    table.column("E", "v1 [cm/s]", END, None, "=B11-D11*$B$6")


def no_deceleration(f: Foreign) -> None:
    """The velocity in one formula with its deceleration, which has no column."""
    page = Page(f, "Daten")
    page.row("I1", "Radius", Input("radius"))
    page.row("I2", "Dichte Cu", Input("particle_density"))
    page.row("I3", "Dichte Stahl", Input("target_density"))
    page.row("I4", "Widerstand", Input("resistance"))
    page.row("I5", "V0", Input("velocity"))
    page.row("I6", "dt", Input("step"))
    page.row("I7", "Masse", "=4/3*PI()*J1^3*J2")
    table = page.table(1, heads=1)
    table.column("A", "n", "", None, float)
    table.column("B", "t", TIME, None, "=A2*$J$6")
    table.column("C", "v alt", START, None, "=E2", first="=$J$5")
    table.column("D", "x", DEPTH, None, "=D2+C3*$J$6", first="=C2*$J$6/2")
    table.column(
        "E", "v neu", END, None, "=C2-(0.5*$J$3*C2^2+$J$4)*PI()*(2*$J$1*D2-D2^2)/$J$7*$J$6"
    )


def merged_heads(f: Foreign) -> None:
    """Heads in three rows, "velocity" over "start" and "end"; every factor in the formulas."""
    f.si = False
    page = Page(f, "Sheet")
    page.row("A3", "Impact velocity", Input("velocity"), "m/s")
    page.row("A4", "Particle diameter", Input("diameter", 1e6), "µm")
    page.row("A5", "Copper density", Input("particle_density", 1e-3), "g/cm3")
    page.row("A6", "Steel density", Input("target_density", 1e-3), "g/cm3")
    page.row("A7", "Steel flow stress", Input("flow_stress", 1e-6), "MPa")
    page.row("A8", "beta", Input("beta"))
    page.row("A9", "Time step", Input("step", 1e9), "ns")
    page.row("B13", "Velocity", None, "Penetration", "Decel.")
    page.row("A15", "ns", "m/s", "m/s", "µm", "m/s²")
    table = page.table(16, heads=14)
    table.column("A", "time", TIME, 0, lambda k: f"={k}*$B$9")
    table.column("B", "start", START, "=B3", "=C17", first="=B16")
    table.column("D", "", DEPTH, 0, "=D17+B18*$B$9/1000", first="=B17*$B$9/1000/2")
    table.column(
        "E",
        "",
        BRAKE,
        0,
        "=(0.5*$B$6*1000*B17^2+$B$8*$B$7*1000000)*PI()*($B$4*D17-D17^2)/1000000000000/(PI()/6*($B$4/1000000)^3*$B$5*1000)",
    )
    table.column("C", "end", END, None, "=B17-E17*$B$9/1000000000")


def velocity_at_end(f: Foreign) -> None:
    """Each row shows the velocity at its end; inputs on a sheet of their own."""
    page = Page(f, "Input")
    page.row("A1", "V", Input("velocity"))
    page.row("A2", "R", Input("radius"))
    page.row("A3", "rho particle", Input("particle_density"))
    page.row("A4", "rho target", Input("target_density"))
    page.row("A5", "Yield strength target", Input("flow_stress"))
    page.row("A6", "beta", Input("beta"))
    page.row("A7", "dt", Input("step"))
    page.row("A8", "v_stop", Input("stop_velocity"))
    page.row("A10", "m", "=4/3*PI()*B2^3*B3")
    page.row("A11", "Rt", "=B5*B6")
    page = Page(f, "run 1")
    table = page.table(4)
    table.column("A", "step", "", 0, float)
    table.column("B", "time", TIME, 0, "=A5*Input!$B$7")
    table.column("C", "v", END, "=Input!$B$1", "=C4-E5*Input!$B$7")
    table.column("D", "x", DEPTH, 0, "=D5+C5*Input!$B$7", first="=C4*Input!$B$7/2")
    table.column(
        "E",
        "a",
        BRAKE,
        0,
        "=(0.5*Input!$B$4*C4^2+Input!$B$11)*PI()*(2*Input!$B$2*D5-D5^2)/Input!$B$10",
    )


def named_constants(f: Foreign) -> None:
    """Inputs are names that stand for numbers; filled down too far, #N/A below the stop."""
    f.names["dt"] = decimal(f.impact.step)
    f.names["rho_t"] = decimal(f.impact.target_density)
    f.names["rho_p"] = decimal(f.impact.particle_density)
    f.names["Rad"] = decimal(f.impact.radius)
    f.names["V_imp"] = decimal(f.impact.velocity)
    f.names["Rt"] = decimal(f.impact.target_resistance)
    page = Page(f, "Sheet")
    table = page.table(3, steps=199)
    table.column("B", "n", "", 0, float)
    table.column("C", "t", TIME, "=B3*dt", "=B4*dt")
    table.column("D", "v_i", START, "=V_imp", "=IF(N(G4)<1,NA(),G4)", first="=V_imp")
    table.column("E", "x", DEPTH, 0, "=E4+D5*dt", first="=D4*dt/2")
    table.column(
        "F",
        "a",
        BRAKE,
        0,
        "=(0.5*rho_t*D4*D4+Rt)*PI()*(2*Rad*E4-E4*E4)/(rho_p*4/3*PI()*Rad*Rad*Rad)",
    )
    table.column("G", "v_f", END, "=V_imp", "=D4-F4*dt")


def six_digits(f: Foreign) -> None:
    """A table exported with six digits: no formulas, no inputs, units in the heads."""
    f.si = False
    page = Page(f, "export")
    table = page.table(2)
    table.column("A", "t_ns", TIME, 0.0, Own(TIME, 1e9, form=".6g"))
    table.column("B", "v_m_per_s", START, Own(START, form=".6g"), Own(START, form=".6g"))
    table.column("C", "x_um", DEPTH, 0.0, Own(DEPTH, 1e6, form=".6g"))
    table.column("D", "a_m_per_s2", BRAKE, 0.0, Own(BRAKE, form=".6g"))


def plain(f: Foreign) -> None:
    """A sheet in which everything has its cell, to be changed."""
    page = Page(f, "Sheet1")
    page.row(
        "A1",
        "R =",
        Input("radius"),
        None,
        "target density",
        Input("target_density"),
        None,
        "beta",
        Input("beta"),
    )
    page.row(
        "A2",
        "Density =",
        Input("particle_density"),
        None,
        "dt",
        Input("step"),
        None,
        "Yt",
        Input("flow_stress"),
    )
    page.row("A3", "M =", "=4/3*PI()*B1^3*B2")
    page.row("A4", "D =", "=2*B1")
    page.row("A5", "Initial vel =", Input("velocity"))
    page.row("A6", "Rt =", "=H1*H2")
    table = page.table(8)
    table.column("A", "Time", TIME, 0.0, "=A8+$E$2")
    table.column("C", "dx/dt initial", START, "=B5", "=F9", first="=C8")
    table.column("D", "x", DEPTH, 0.0, "=D9+C10*$E$2", first="=D8+C9*$E$2/2")
    table.column("E", "d²x/dt²", BRAKE, 0.0, "=(0.5*$E$1*C9^2+$B$6)*PI()*($B$4*D9-D9^2)/$B$3")
    table.column("F", "dx/dt final", END, None, "=C9-E9*$E$2")


def middle(f: Foreign) -> None:
    """A velocity in the middle of each row, at which the drag is taken."""
    page = Page(f, "run")
    page.row("A1", "V0", "R", "rho_p", "rho_t", "Rt", "dt", "m")
    page.row(
        "A2",
        Input("velocity"),
        Input("radius"),
        Input("particle_density"),
        Input("target_density"),
        Input("resistance"),
        Input("step"),
        "=C2*4/3*PI()*B2^3",
    )
    table = page.table(6)
    table.column("A", "t", TIME, 0, "=A6+F$2")
    table.column("B", "v", START, "=A2", "=B7-E7*F$2", first="=B6")
    table.column("C", "x", DEPTH, 0, "=C7+B8*F$2", first="=B7*F$2/2")
    table.column("D", "v_half", "", None, "=B7-(0.5*D$2*B7^2+E$2)*PI()*(2*B$2*C7-C7^2)/G$2*F$2/2")
    table.column("E", "a", BRAKE, None, "=(0.5*D$2*D7^2+E$2)*PI()*(2*B$2*C7-C7^2)/G$2")


def empty(f: Foreign) -> None:
    """Nothing."""


LAYOUTS: dict[str, Callable[[Foreign], None]] = {
    "table-a1": table_a1,
    "german": german,
    "french": french,
    "sideways": sideways,
    "no-time": no_time,
    "one-velocity": one_velocity,
    "side-by-side": side_by_side,
    "guarded": guarded,
    "pasted": pasted,
    "natural-units": natural_units,
    "named-everything": named_everything,
    "printed-digits": printed_digits,
    "italian": italian,
    "no-words": no_words,
    "centimetres": centimetres,
    "no-deceleration": no_deceleration,
    "merged-heads": merged_heads,
    "velocity-at-end": velocity_at_end,
    "named-constants": named_constants,
    "six-digits": six_digits,
    "plain": plain,
    "middle": middle,
    "empty": empty,
}

BY_HAND = tuple(name for name in LAYOUTS if name not in ("plain", "middle", "empty"))
"""The right layouts; the others are to be changed."""


def made(layout: str, impact: Impact, rows: int | None = None) -> Foreign:
    """Fill a layout with an impact, in as many rows as that needs, or in a given number."""
    f = Foreign(layout, impact, rows=rows)
    LAYOUTS[layout](f)
    return f
