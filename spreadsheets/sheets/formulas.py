"""Formulas that several sheets have in common. Each argument is a cell: its name or address."""


def log1p(x: str) -> str:
    """ln(1 + x) for x >= 0, right to the last digits however slow the impact is.

    If 1 + x is rounded to u, then ln(u) x/(u - 1) corrects for the rounding. Below 1e-8 a series of
    two terms suffices: its third term would be less than the last digit of the first.

    >>> log1p("z")
    '=IF(z<0.00000001,z-z*z/2,z*LN(1+z)/((1+z)-1))'
    """
    return f"=IF({x}<0.00000001,{x}-{x}*{x}/2,{x}*LN(1+{x})/((1+{x})-1))"


def cap_angle(c: str) -> str:
    """The angle h = asin(sqrt(3c)/2)/3 of the root of y^2 - y^3/3 = c, for c up to 2/3.

    >>> cap_angle("c_rest")
    '=ASIN(SQRT(3*MIN(c_rest,2/3))/2)/3'
    """
    return f"=ASIN(SQRT(3*MIN({c},2/3))/2)/3"


def depth(c: str, h: str) -> str:
    """The normalized depth y = X/R: the root of y^2 - y^3/3 = c for c <= 2/3, and 1/3 + c beyond.

    >>> depth("c_rest", "h_rest")
    '=IF(c_rest<=2/3,4*SIN(h_rest)*SIN(h_rest+pi_/3),1/3+c_rest)'
    """
    return f"=IF({c}<=2/3,4*SIN({h})*SIN({h}+pi_/3),1/3+{c})"
