"""Units in exact rational arithmetic: those that are listed, and no others."""

from kept import kept, said

from reference.units import to_si, unit_dimension


@kept("reference/kept.txt", "Units: the factor to SI, and what they measure")
def test_factors_and_dimensions(question: str, answer: str) -> None:
    assert said(lambda: f"{to_si(question)}, {unit_dimension(question)}") == answer
