"""Words of strangers for inputs and columns: such as most people use, of other languages, and none.

`FOREIGN` has languages that the program is not told about; they are written as people write them.
"""

import random

KNOWN = {
    "radius": ("R", "particle radius", "Radius", "rayon", "R_p", "Partikelradius"),
    "diameter": ("D", "particle diameter", "Durchmesser", "diamètre", "D_p"),
    "particle_density": ("density of particle", "rho_p", "Dichte Partikel", "ρp"),
    "target_density": ("density of target", "rho_t", "Dichte Ziel", "masse volumique cible", "ρt"),
    "velocity": ("V", "impact velocity", "Auftreffgeschwindigkeit", "vitesse d'impact", "v0"),
    "resistance": ("R_t", "target resistance", "Zielwiderstand", "résistance de la cible", "Rt"),
    "beta": ("beta", "β", "Faktor beta", "bêta"),
    "flow_stress": ("flow stress", "Y_t", "Fließspannung", "contrainte d'écoulement", "Yt"),
    "step": ("dt", "time step", "Zeitschritt", "pas de temps", "Δt"),
    "stop_velocity": ("v_stop", "stop velocity", "Abbruchgeschwindigkeit", "vitesse d'arrêt"),
    "mass": ("M", "mass", "Masse", "masse"),
    "time": ("t", "Time", "Zeit", "temps"),
    "velocity_initial": ("v_i", "dx/dt initial", "initial velocity", "Anfangsgeschwindigkeit"),
    "velocity_final": ("v_f", "dx/dt final", "final velocity", "Endgeschwindigkeit"),
    "depth": ("x", "depth", "Eindringtiefe", "profondeur", "penetration"),
    "deceleration": ("a", "d²x/dt²", "deceleration", "Verzögerung", "décélération"),
    "area": ("A(x)", "contact area", "Kontaktfläche"),
    "pressure": ("pressure", "Druck", "p"),
    "force": ("force", "Kraft", "F"),
    "change": ("dv", "Δv"),
    "ratio": ("x/R",),
    "energy": ("E_kin", "kinetic energy"),
    "count": ("n", "#", "step no."),
    "pi": ("pi", "π"),
    "note": ("checked by hand", "see the notebook, p. 12", "Stand: 3. Mai"),
    "title": ("Impact of one particle", "Eindringen einer Kugel"),
}

FOREIGN = {
    "radius": ("poloměr", "säde", "yarıçap", "sugár", "半径", "радиус", "promień", "ακτίνα"),
    "diameter": ("průměr", "halkaisija", "çap", "átmérő", "直径", "диаметр", "średnica"),
    "particle_density": ("hustota částice", "hiukkasen tiheys", "parçacık yoğunluğu", "粒子密度"),
    "target_density": ("hustota terče", "kohteen tiheys", "hedef yoğunluğu", "плотность мишени"),
    "velocity": ("rychlost dopadu", "törmäysnopeus", "çarpma hızı", "скорость удара", "衝突速度"),
    "resistance": ("odpor", "vastus", "direnç", "сопротивление", "抵抗", "opór"),
    "beta": ("součinitel", "kerroin", "katsayı", "коэффициент"),
    "flow_stress": ("mez kluzu", "myötölujuus", "akma gerilmesi", "предел текучести"),
    "step": ("krok", "aika-askel", "zaman adımı", "шаг", "刻み", "időlépés"),
    "stop_velocity": ("konec", "pysäytys", "durma hızı", "停止"),
    "mass": ("hmotnost", "massa", "kütle", "tömeg", "質量", "масса"),
    "time": ("čas", "aika", "zaman", "idő", "時間", "время"),
    "velocity_initial": ("rychlost na začátku", "alkunopeus", "ilk hız", "kezdősebesség", "初速"),
    "velocity_final": ("rychlost na konci", "loppunopeus", "son hız", "végsebesség", "終速"),
    "depth": ("hloubka", "syvyys", "derinlik", "mélység", "深さ", "глубина"),
    "deceleration": ("zpomalení", "hidastuvuus", "yavaşlama", "lassulás", "減速度"),
    "area": ("plocha", "pinta-ala", "alan", "面積"),
    "pressure": ("tlak", "paine", "basınç", "圧力"),
    "force": ("síla", "voima", "kuvvet", "力"),
    "change": ("změna", "muutos", "değişim"),
    "ratio": ("poměr", "suhde", "oran"),
    "energy": ("energie", "energia", "enerji"),
    "count": ("č.", "nro", "sıra", "№"),
    "pi": ("π",),
    "note": ("ověřeno", "tarkistettu", "kontrol edildi"),
    "title": ("Průnik kuličky", "Kuulan tunkeuma", "Bir parçacığın girişi"),
}


def syllables(r: random.Random) -> str:
    """A word of random letters, of one to four syllables."""
    return "".join(r.choice("bdfgjklmnpqrstvwxz") + r.choice("aeiouy")
                   for _ in range(r.randrange(1, 5)))  # fmt: skip
