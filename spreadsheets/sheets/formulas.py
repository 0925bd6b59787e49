"""Formulas that several sheets have in common. Each argument is a cell: its name or address."""


def log1p(x: str) -> str:
    """ln(1 + x) for x >= 0, right to the last digits however slow the impact is.

    If 1 + x is rounded to u, then ln(u) x/(u - 1) corrects for the rounding. Below `series_below`,
    a constant of the sheet Inputs, a series of two terms suffices: its third term would be less
    than the last digit of the first.

    >>> log1p("z")
    '=IF(z<series_below,z-z*z/2,z*LN(1+z)/((1+z)-1))'
    """
    return f"=IF({x}<series_below,{x}-{x}*{x}/2,{x}*LN(1+{x})/((1+{x})-1))"


def expm1(x: str, exp_x: str) -> str:
    """e^x - 1 for x >= 0, right to the last digits however small x is; e^x is in a cell of its own.

    If e^x is rounded to u, then u - 1 is off, but x/ln(u) corrects for that. Below `series_below` a
    series of two terms suffices: its third term would be less than the last digit of the first.

    >>> expm1("L_meas", "exp_L")
    '=IF(L_meas<series_below,L_meas+L_meas*L_meas/2,(exp_L-1)*L_meas/LN(exp_L))'
    """
    return f"=IF({x}<series_below,{x}+{x}*{x}/2,({exp_x}-1)*{x}/LN({exp_x}))"


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
