"""How the velocity of a particle depends on its size, in one stream, by two laws."""

from enum import StrEnum
from fractions import Fraction

from replication.audit.results import Results


class Law(StrEnum):
    """A law of a particle's velocity by its size, by its name in texts."""

    EQ_1 = "Eq. 1"
    DRAG = "drag on a sphere"


def diameter_power(results: Results, law: Law) -> Fraction:
    """Return the power p [1] of a law by which the velocity is proportional to 1/diameter^p.

    Eq. 1 prints a power of 1/mass, and a mass grows with the cube of the diameter. A constant drag
    coefficient gives particles that are much slower than the gas V^2 in proportion to area/mass, so
    to 1/diameter.

    >>> from reference.ledger import load
    >>> [str(diameter_power(Results(load()), law)) for law in Law]
    ['3/2', '1/2']
    """
    if law is Law.EQ_1:
        return 3 * results.exact("eq1-power")
    return Fraction(1, 2)


def velocity_by_size(results: Results, average: float, diameter: float, law: Law) -> float:
    """Return the velocity V (D/d)^p [m/s] of a particle of diameter d [m] in a stream.

    V [m/s] is the average velocity of the stream, which a particle of the mean diameter D has, and
    p the law's power (`diameter_power`).

    >>> from reference.ledger import load
    >>> f"{velocity_by_size(Results(load()), 521.0, 10e-6, Law.DRAG):.0f}"  # 22 um fly at 521 m/s
    '773'
    """
    power = float(diameter_power(results, law))
    faster: float = (results["mean-diameter"] / diameter) ** power
    return average * faster
