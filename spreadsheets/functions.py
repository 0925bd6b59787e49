"""The functions that formulas may call: of bounded cost, and reaching nothing outside the book.

Each takes compiled arguments and returns a compiled call. Numbers in ranges count only if they are
numbers; a number given directly may also be a text of digits or a truth value.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence

from reference.units import is_known, same_dimension, to_si
from spreadsheets.scalars import (
    Area,
    CellError,
    Error,
    NotComputedError,
    One,
    Run,
    Scalar,
    Site,
    as_number,
    compared,
    finite,
    power,
    scalar,
)

Arguments = Sequence[Run | None]
Scalars = list[Scalar]


def area_of(value: object) -> Area | None:
    """The area of a reference; None for a value."""
    if isinstance(value, One):
        return Area(value.sheet, value.row, value.column, value.row, value.column)
    return value if isinstance(value, Area) else None


def cells_of(area: Area, at: Site) -> Iterator[Scalar]:
    """The values in the used part of an area, row by row."""
    used = at.evaluator.used(area)
    at.spend(used.cells)
    return (at.value(place) for place in used.places())


def count_arguments(name: str, arguments: Arguments, least: int, most: int) -> None:
    """Raise NotComputedError unless there are so many arguments."""
    if not least <= len(arguments) <= most:
        raise NotComputedError(f"it gives {name} {len(arguments)} arguments")


# ---- functions of numbers


def _excel_log(x: float, base: float = 10.0) -> float:
    if x <= 0 or base <= 0:
        raise CellError("#NUM!")
    if base == 10:
        return math.log10(x)
    return math.log(x) / math.log(base)


def _ln(x: float) -> float:
    return math.log(x) if x > 0 else _fail("#NUM!")


def _fail(error: str) -> float:
    raise CellError(error)


def _mod(x: float, y: float) -> float:
    if y == 0:
        raise CellError("#DIV/0!")
    rest = x - y * math.floor(x / y)
    # Programs store 0 where x is a multiple of y to fourteen digits.
    return 0.0 if min(abs(rest), abs(y - rest)) <= 1e-14 * abs(x) else rest


def _to_fifteen_digits(x: float) -> float:
    """The number as programs show it: what is whole, or half, to fifteen digits counts as such."""
    return float(f"{x:.15g}") if abs(x) < 1e15 else x


def _away(x: float) -> float:
    """Round half away from zero."""
    size = _to_fifteen_digits(abs(x))
    whole = math.floor(size)
    return math.copysign(whole + (size - whole >= 0.5), x)


def _rounded(x: float, digits: float = 0.0) -> float:
    places = max(-300, min(300, int(digits)))
    scaled = x * 10.0**places
    if x == 0 or abs(scaled) >= 2.0**53:  # no such double has a fraction
        return x
    return float(f"{_away(scaled):.0f}e{-places}")


def _truncated(x: float, digits: float = 0.0) -> float:
    scale = 10.0 ** max(-300, min(300, int(digits)))
    return math.trunc(_to_fifteen_digits(x * scale)) / scale


def _rounded_up(x: float, digits: float = 0.0) -> float:
    scale = 10.0 ** max(-300, min(300, int(digits)))
    return math.copysign(math.ceil(_to_fifteen_digits(abs(x) * scale)), x) / scale


def _ceiling(x: float, step: float = 1.0) -> float:
    return math.ceil(_to_fifteen_digits(x / step)) * step if step else 0.0


def _floor(x: float, step: float = 1.0) -> float:
    if step == 0:
        raise CellError("#DIV/0!")
    return math.floor(_to_fifteen_digits(x / step)) * step


def _sign(x: float) -> float:
    return float((x > 0) - (x < 0))


def _sqrt(x: float) -> float:
    return math.sqrt(x) if x >= 0 else _fail("#NUM!")


def _pi() -> float:
    return math.pi


def _int(x: float) -> float:
    return float(math.floor(_to_fifteen_digits(x)))


def _atan2(x: float, y: float) -> float:
    return math.atan2(y, x) if x or y else _fail("#DIV/0!")


NUMERIC: dict[str, tuple[Callable[..., float], int, int]] = {
    "ABS": (abs, 1, 1), "ACOS": (math.acos, 1, 1), "ASIN": (math.asin, 1, 1),
    "ATAN": (math.atan, 1, 1), "ATAN2": (_atan2, 2, 2), "CEILING": (_ceiling, 1, 2),
    "COS": (math.cos, 1, 1), "COSH": (math.cosh, 1, 1), "DEGREES": (math.degrees, 1, 1),
    "EXP": (math.exp, 1, 1), "FLOOR": (_floor, 1, 2), "INT": (_int, 1, 1), "LN": (_ln, 1, 1),
    "LOG": (_excel_log, 1, 2), "LOG10": (_excel_log, 1, 1), "MOD": (_mod, 2, 2), "PI": (_pi, 0, 0),
    "POWER": (power, 2, 2), "RADIANS": (math.radians, 1, 1), "ROUND": (_rounded, 1, 2),
    "ROUNDDOWN": (_truncated, 1, 2), "ROUNDUP": (_rounded_up, 1, 2), "SIGN": (_sign, 1, 1),
    "SIN": (math.sin, 1, 1), "SINH": (math.sinh, 1, 1), "SQRT": (_sqrt, 1, 1),
    "TAN": (math.tan, 1, 1), "TANH": (math.tanh, 1, 1), "TRUNC": (_truncated, 1, 2),
}  # fmt: skip
"""Functions of numbers alone: what computes them, and how many arguments they take."""


def _numeric(name: str, arguments: Arguments) -> Run:
    function, least, most = NUMERIC[name]
    count_arguments(name, arguments, least, most)
    if not arguments:
        constant = function()
        return lambda _: constant

    def run(at: Site) -> object:
        numbers = (0.0 if a is None else as_number(a(at), at)
                   for a in arguments)  # fmt: skip
        return finite(float(function(*numbers)))

    return run


# ---- functions of many values


def _numbers_among(name: str, arguments: Arguments, at: Site) -> list[float]:
    """All numbers among the arguments and in their ranges."""
    numbers: list[float] = []
    for argument in arguments:
        value = 0.0 if argument is None else argument(at)
        area = area_of(value)
        if area is None:
            numbers.append(as_number(value, at))
            continue
        numbers += _numbers_in(name, cells_of(area, at))
    return numbers


def _numbers_in(name: str, cells: Iterable[Scalar]) -> list[float]:
    """The numbers among the values of cells; an error there is the result, but not of COUNT."""
    numbers: list[float] = []
    for cell in cells:
        if type(cell) is float:
            numbers.append(cell)
        elif type(cell) is Error and name != "COUNT":
            raise CellError(cell)
    return numbers


def _average(numbers: list[float]) -> float:
    return math.fsum(numbers) / len(numbers) if numbers else _fail("#DIV/0!")


def _sum(numbers: list[float]) -> float:
    """The sum from left to right, which Python's own `sum` compensates from version 3.12 on."""
    total = 0.0
    for x in numbers:
        total += x
    return total


def _largest(numbers: list[float]) -> float:
    return max(numbers, default=0.0)


def _smallest(numbers: list[float]) -> float:
    return min(numbers, default=0.0)


def _count(numbers: list[float]) -> float:
    return float(len(numbers))


def _product(numbers: list[float]) -> float:
    return math.prod(numbers) if numbers else 0.0


def _squares(numbers: list[float]) -> float:
    return _sum([x * x for x in numbers])


def _median(numbers: list[float]) -> float:
    ordered, middle = sorted(numbers), len(numbers) // 2
    if not ordered:
        raise CellError("#NUM!")
    return ordered[middle] if len(ordered) % 2 else (ordered[middle - 1] + ordered[middle]) / 2


def _deviation(numbers: list[float]) -> float:
    if len(numbers) < 2:
        raise CellError("#DIV/0!")
    mean = math.fsum(numbers) / len(numbers)
    return math.sqrt(math.fsum((x - mean) ** 2 for x in numbers) / (len(numbers) - 1))


AGGREGATES: dict[str, Callable[[list[float]], float]] = {
    "AVERAGE": _average, "COUNT": _count, "MAX": _largest, "MEDIAN": _median, "MIN": _smallest,
    "PRODUCT": _product, "STDEV": _deviation, "SUM": _sum, "SUMSQ": _squares,
}  # fmt: skip
"""Functions of all numbers in their arguments."""


def _aggregate(name: str, arguments: Arguments) -> Run:
    function = AGGREGATES[name]
    count_arguments(name, arguments, 1, 255)

    def run(at: Site) -> object:
        first = arguments[0]
        if len(arguments) == 1 and first is not None and at.affected is None:
            area = first(at)
            if isinstance(area, Area):  # often the same range in every row
                known = at.evaluator.aggregates
                if (name, area) not in known:
                    known[name, area] = finite(function(_numbers_among(name, arguments, at)))
                return known[name, area]
        return finite(function(_numbers_among(name, arguments, at)))

    return run


_SUBTOTALS = {
    1: "AVERAGE", 2: "COUNT", 3: "COUNTA", 4: "MAX", 5: "MIN", 6: "PRODUCT", 7: "STDEV", 9: "SUM",
}  # fmt: skip
"""What SUBTOTAL computes by its first argument; STDEVP, 8, is not among them."""
_WITHOUT_HIDDEN = 100
"""By so much the first argument is larger if rows that somebody hid are to be left out."""


def _subtotal(name: str, arguments: Arguments) -> Run:
    """SUBTOTAL, which leaves out other subtotals and, from 101 on, hidden rows.

    Below 101 it leaves out the rows that a filter hides, and those only: which do, a file does not
    say.
    """
    count_arguments(name, arguments, 2, 255)

    def run(at: Site) -> object:
        code = _whole(arguments[0], at)
        without_hidden = code > _WITHOUT_HIDDEN
        aggregate = _SUBTOTALS.get(code - _WITHOUT_HIDDEN if without_hidden else code)
        if aggregate is None:
            raise NotComputedError(f"it uses SUBTOTAL({code}, ...)")
        areas = [area_of(argument(at)) if argument else None for argument in arguments[1:]]
        cells = [
            cell for area in areas for cell in _shown_cells(area, at, without_hidden=without_hidden)
        ]
        if aggregate == "COUNTA":
            return float(sum(cell is not None for cell in cells))
        return finite(AGGREGATES[aggregate](_numbers_in(aggregate, cells)))

    return run


def _shown_cells(area: Area | None, at: Site, *, without_hidden: bool) -> Scalars:
    """The values of a range without those of other subtotals, and without hidden rows."""
    if area is None:
        raise NotComputedError("it uses SUBTOTAL of more than ranges")
    evaluator = at.evaluator
    used = evaluator.used(area)
    hidden = evaluator.book.hidden.get(area.sheet, frozenset())
    if hidden and not without_hidden and not hidden.isdisjoint(range(used.top, used.bottom + 1)):
        raise NotComputedError("it uses SUBTOTAL of hidden rows, which a filter may leave out")
    at.spend(used.cells)
    return [
        at.value(place)
        for place in used.places()
        if place[1] not in hidden and not evaluator.has_subtotal(place)
    ]


def _counting(name: str, arguments: Arguments) -> Run:
    """COUNTA and COUNTBLANK."""

    def run(at: Site) -> object:
        total = 0
        for argument in arguments:
            value = None if argument is None else argument(at)
            area = area_of(value)
            if area is None:
                total += name == "COUNTA"
                continue
            cells = list(cells_of(area, at))
            filled = sum(c is not None for c in cells)
            empty = sum(c is None or c == "" for c in cells)
            beyond = area.cells - len(cells)
            total += filled if name == "COUNTA" else empty + beyond
        return float(total)

    return run


# ---- logic


def truth(value: Scalar) -> bool:
    """A condition as IF takes it."""
    if isinstance(value, str):
        if value.upper() in ("TRUE", "FALSE"):
            return value.upper() == "TRUE"
        raise CellError("#VALUE!")
    return bool(value)


def _if(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 2, 3)
    test, then, *rest = arguments
    otherwise = rest[0] if rest else None
    if test is None:
        raise NotComputedError("it has an IF without a condition")

    def run(at: Site) -> object:
        if truth(scalar(test(at), at)):
            return 0.0 if then is None else then(at)
        if otherwise is None:
            return 0.0 if rest else False
        return otherwise(at)

    return run


def _ifs(_name: str, arguments: Arguments) -> Run:
    def run(at: Site) -> object:
        for test, then in zip(arguments[::2], arguments[1::2], strict=False):
            if test is not None and truth(scalar(test(at), at)):
                return 0.0 if then is None else then(at)
        raise CellError("#N/A")

    return run


def _iferror(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 1, 2)
    first, second = (*arguments, None)[:2]

    def run(at: Site) -> object:
        try:
            return None if first is None else scalar(first(at), at)
        except (CellError, OverflowError, ValueError, ZeroDivisionError) as fault:
            if name == "IFNA" and getattr(fault, "error", "") != "#N/A":
                raise
            return 0.0 if second is None else second(at)

    return run


def _and_or(name: str, arguments: Arguments) -> Run:
    def run(at: Site) -> object:
        truths = []
        for argument in arguments:
            value = None if argument is None else argument(at)
            area = area_of(value)
            if area is not None and area.cells > 1:
                for cell in cells_of(area, at):
                    if type(cell) is Error:
                        raise CellError(cell)
                    if isinstance(cell, bool | float):
                        truths.append(bool(cell))
            else:
                truths.append(truth(scalar(value, at)))
        if not truths:
            raise CellError("#VALUE!")
        return all(truths) if name == "AND" else any(truths)

    return run


def _not(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 1, 1)
    (test,) = arguments

    def run(at: Site) -> object:
        return not (test is not None and truth(scalar(test(at), at)))

    return run


def _is(name: str, arguments: Arguments) -> Run:
    """ISNUMBER, ISBLANK and so on, of one cell."""
    count_arguments(name, arguments, 1, 1)
    (argument,) = arguments

    def run(at: Site) -> object:
        try:
            value = None if argument is None else scalar(argument(at), at)
        except CellError as fault:
            return (name == "ISERROR" or (name == "ISNA" and fault.error == "#N/A")
                    or (name == "ISERR" and fault.error != "#N/A"))  # fmt: skip
        except (OverflowError, ValueError, ZeroDivisionError):
            return name in ("ISERROR", "ISERR")
        if name == "ISBLANK":
            return value is None
        if name == "ISTEXT":
            return isinstance(value, str)
        if name == "ISLOGICAL":
            return isinstance(value, bool)
        return name == "ISNUMBER" and type(value) is float

    return run


def _to_number(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 1, 1)
    (argument,) = arguments

    def run(at: Site) -> object:
        value = None if argument is None else scalar(argument(at), at)
        return float(value) if isinstance(value, bool | float) else 0.0

    return run


def _na(_name: str, _arguments: Arguments) -> Run:
    def run(_at: Site) -> object:
        raise CellError("#N/A")

    return run


def _truth_value(name: str, _arguments: Arguments) -> Run:
    return lambda _: name == "TRUE"


def _choose(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 2, 255)
    index, *choices = arguments

    def run(at: Site) -> object:
        n = int(as_number(index(at) if index else 0.0, at))
        if not 1 <= n <= len(choices):
            raise CellError("#VALUE!")
        choice = choices[n - 1]
        return 0.0 if choice is None else choice(at)

    return run


# ---- references


def _row_or_column(name: str, arguments: Arguments) -> Run:
    """ROW, COLUMN, ROWS and COLUMNS."""
    count_arguments(name, arguments, 0 if name in ("ROW", "COLUMN") else 1, 1)

    def run(at: Site) -> object:
        argument = arguments[0] if arguments else None
        area = area_of(argument(at)) if argument else Area("", at.row, at.column, at.row, at.column)
        if area is None:
            raise CellError("#VALUE!")
        match name:
            case "ROW":
                return float(area.top)
            case "COLUMN":
                return float(area.left)
            case "ROWS":
                return float(area.bottom - area.top + 1)
        return float(area.right - area.left + 1)

    return run


def _area_argument(argument: Run | None, at: Site) -> Area:
    area = area_of(argument(at)) if argument else None
    if area is None:
        raise CellError("#VALUE!")
    return area


def _whole(argument: Run | None, at: Site, missing: int = 0) -> int:
    return missing if argument is None else int(as_number(argument(at), at))


def _index(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 2, 3)

    def run(at: Site) -> object:
        area = _area_argument(arguments[0], at)
        r = _whole(arguments[1], at)
        c = _whole(arguments[2], at) if len(arguments) > 2 else -1
        if c < 0:
            r, c = (1, r) if area.top == area.bottom else (r, 1 if area.left == area.right else 0)
        height, width = area.bottom - area.top + 1, area.right - area.left + 1
        if not (0 <= r <= height and 0 <= c <= width):
            raise CellError("#REF!")
        top, bottom = (area.top + r - 1,) * 2 if r else (area.top, area.bottom)
        left, right = (area.left + c - 1,) * 2 if c else (area.left, area.right)
        if (top, left) == (bottom, right):
            return One(area.sheet, top, left)
        return Area(area.sheet, top, left, bottom, right)

    return run


def _offset(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 3, 5)

    def run(at: Site) -> object:
        area = _area_argument(arguments[0], at)
        down, right = (_whole(a, at) for a in arguments[1:3])
        height, width = area.bottom - area.top + 1, area.right - area.left + 1
        if len(arguments) > 3:
            height = _whole(arguments[3], at, height)
        if len(arguments) > 4:
            width = _whole(arguments[4], at, width)
        top, left = area.top + down, area.left + right
        if top < 1 or left < 1 or height < 1 or width < 1:
            raise CellError("#REF!")
        moved = Area(area.sheet, top, left, top + height - 1, left + width - 1)
        if at.affected is None and any(p in at.evaluator.pending for p in _some(moved, at)):
            raise NotComputedError("it uses OFFSET to read formulas that come later")
        return One(area.sheet, top, left) if moved.cells == 1 else moved

    return run


def _some(area: Area, at: Site) -> Iterator[tuple[str, int, int]]:
    used = at.evaluator.used(area)
    at.spend(used.cells)
    return used.places()


def _line_values(area: Area, at: Site) -> Scalars:
    """The values of one row or column, as far as the sheet uses it."""
    if area.top != area.bottom and area.left != area.right:
        raise CellError("#N/A")
    return list(cells_of(area, at))


def _at(area: Area, index: int) -> One:
    """The cell of a row or column with a number that counts from 0."""
    if area.left == area.right:
        return One(area.sheet, area.top + index, area.left)
    return One(area.sheet, area.top, area.left + index)


def _searched(arguments: Arguments, at: Site) -> tuple[Scalar, Area]:
    """What a function looks for, and where: its first two arguments."""
    wanted = scalar(arguments[0](at) if arguments[0] else 0.0, at)
    return wanted, _area_argument(arguments[1], at)


def _found(wanted: Scalar, values: Scalars, kind: int) -> int:
    """Where a value stands: exactly (0), the last not above it (1), the last not below it (-1)."""
    if kind == 0:
        for index, value in enumerate(values):
            same_kind = isinstance(value, str) == isinstance(wanted, str)
            none = value is None or type(value) is Error
            if same_kind and not none and compared("=", value, wanted):
                return index
        raise CellError("#N/A")
    best, sign = -1, "<=" if kind > 0 else ">="
    for index, value in enumerate(values):
        if value is None or isinstance(value, Error) or type(value) is not type(wanted):
            continue
        if compared(sign, value, wanted):
            best = index
        else:
            break
    if best < 0:
        raise CellError("#N/A")
    return best


def _match(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 2, 3)

    def run(at: Site) -> object:
        wanted, area = _searched(arguments, at)
        kind = _whole(arguments[2], at) if len(arguments) > 2 else 1
        return float(_found(wanted, _line_values(area, at), kind) + 1)

    return run


def _lookup(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 2, 3)

    def run(at: Site) -> object:
        wanted, area = _searched(arguments, at)
        result = _area_argument(arguments[2], at) if len(arguments) > 2 else area
        values = _line_values(area, at)
        if isinstance(wanted, float):  # sorted or not, the last number not above it
            best = [i for i, v in enumerate(values) if type(v) is float and v <= wanted]
            if not best:
                raise CellError("#N/A")
            return _at(result, best[-1])
        return _at(result, _found(wanted, values, 1))

    return run


def _vlookup(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 3, 4)

    def run(at: Site) -> object:
        wanted, area = _searched(arguments, at)
        number_of = _whole(arguments[2], at)
        near = True
        if len(arguments) > 3:
            last = arguments[3]
            near = last is not None and truth(scalar(last(at), at))
        down = name == "VLOOKUP"
        searched = area._replace(right=area.left) if down else area._replace(bottom=area.top)
        index = _found(wanted, _line_values(searched, at), int(near))
        if number_of < 1:
            raise CellError("#VALUE!")
        if number_of > (area.right - area.left if down else area.bottom - area.top) + 1:
            raise CellError("#REF!")
        if down:
            return One(area.sheet, area.top + index, area.left + number_of - 1)
        return One(area.sheet, area.top + number_of - 1, area.left + index)

    return run


# ---- conditions on ranges


def _meets(value: Scalar, criterion: Scalar) -> bool:
    """Whether a cell meets a criterion such as 5, "x" or ">=5"."""
    if not isinstance(criterion, str):
        return type(value) is type(criterion) and compared("=", value, criterion)
    for sign in ("<=", ">=", "<>", "<", ">", "="):
        if criterion.startswith(sign):
            rest = criterion[len(sign) :]
            break
    else:
        sign, rest = "=", criterion
    try:
        wanted: Scalar = float(rest)
    except ValueError:
        wanted = rest
        if "*" in rest or "?" in rest:
            raise NotComputedError("it searches with wildcards") from None
    if isinstance(wanted, float):
        return compared(sign, value, wanted) if type(value) is float else sign == "<>"
    if rest == "":
        return (value in (None, "")) == (sign == "=")
    return compared(sign, value, wanted) if isinstance(value, str) else sign == "<>"


def _conditional(name: str, arguments: Arguments) -> Run:
    """COUNTIF(S), SUMIF(S), AVERAGEIF, MAXIFS and MINIFS."""
    result, pairs = _ranges_with_criteria(name, arguments)
    if not pairs:
        raise NotComputedError(f"it gives {name} {len(arguments)} arguments")

    def run(at: Site) -> object:
        areas = [_area_argument(area, at) for area, _ in pairs]
        wanted = [scalar(criterion(at) if criterion else "", at) for _, criterion in pairs]
        source = areas[0] if result is None else _area_argument(result[0], at)
        values = _meeting(areas, wanted, source, at)
        if name.startswith("COUNT"):
            return float(len(values))
        return _total(name, [value for value in values if type(value) is float])

    return run


def _ranges_with_criteria(
    name: str, arguments: Arguments
) -> tuple[Arguments | None, list[tuple[Run | None, Run | None]]]:
    """The range that is counted, if it is given by itself, and all ranges with their criteria."""
    rest, result = list(arguments), None
    if name.endswith("IFS") and not name.startswith("COUNT"):
        result, rest = rest[:1], rest[1:]
    elif not name.endswith("IFS") and not name.startswith("COUNT") and len(rest) == 3:
        result, rest = rest[2:], rest[:2]
    return result, list(zip(rest[::2], rest[1::2], strict=False))


def _meeting(areas: Sequence[Area], wanted: Scalars, source: Area, at: Site) -> Scalars:
    """The values of a range in whose places all ranges meet their criteria."""
    used = at.evaluator.used(areas[0])
    height, width = used.bottom - used.top + 1, used.right - used.left + 1
    at.spend(used.cells * (len(areas) + 1))

    def met(i: int, j: int) -> bool:
        cells = ((area.sheet, area.top + i, area.left + j) for area in areas)
        return all(_meets(at.value(cell), w) for cell, w in zip(cells, wanted, strict=True))

    return [
        at.value((source.sheet, source.top + i, source.left + j))
        for i in range(height)
        for j in range(width)
        if met(i, j)
    ]


def _total(name: str, numbers: list[float]) -> float:
    """The sum, mean, largest or smallest of some numbers."""
    if name.startswith("SUM"):
        return _sum(numbers)
    if name.startswith("AVERAGE"):
        return _average(numbers)
    return _largest(numbers) if name.startswith("MAX") else _smallest(numbers)


def _sumproduct(name: str, arguments: Arguments) -> Run:
    count_arguments(name, arguments, 1, 30)

    def run(at: Site) -> object:
        areas = [area_of(a(at)) if a else None for a in arguments]
        if None in areas:
            raise NotComputedError("it uses SUMPRODUCT of more than ranges")
        columns = [list(cells_of(a, at)) for a in areas if a is not None]
        if len({len(c) for c in columns}) != 1:
            raise CellError("#VALUE!")
        total = 0.0
        for values in zip(*columns, strict=True):
            for value in values:
                if type(value) is Error:
                    raise CellError(value)
            total += math.prod(v if type(v) is float else 0.0 for v in values)
        return finite(total)

    return run


_OTHER_NAMES = {"lbm": "lb", "sec": "s", "p": "Pa"}
"""Units that spreadsheets call otherwise than `reference.units` does."""


def _convert(name: str, arguments: Arguments) -> Run:
    """CONVERT, between units that `reference.units` knows."""
    count_arguments(name, arguments, 3, 3)

    def run(at: Site) -> object:
        x, *units = (0.0 if a is None else scalar(a(at), at) for a in arguments)
        own, wanted = (_OTHER_NAMES.get(str(unit), str(unit)) for unit in units)
        if not (is_known(own) and is_known(wanted)):
            raise NotComputedError(f"it converts {own[:20]} to {wanted[:20]}")
        if not same_dimension(own, wanted):
            raise CellError("#N/A")
        return finite(as_number(x, at) * float(to_si(own) / to_si(wanted)))

    return run


def _ranked(name: str, arguments: Arguments) -> Run:
    """LARGE and SMALL."""
    count_arguments(name, arguments, 2, 2)

    def run(at: Site) -> object:
        numbers = sorted(_numbers_among(name, arguments[:1], at), reverse=name == "LARGE")
        k = _whole(arguments[1], at)
        if not 1 <= k <= len(numbers):
            raise CellError("#NUM!")
        return numbers[k - 1]

    return run


FUNCTIONS: dict[str, Callable[[str, Arguments], Run]] = {
    **dict.fromkeys(NUMERIC, _numeric),
    **dict.fromkeys(AGGREGATES, _aggregate),
    **dict.fromkeys(("COUNTA", "COUNTBLANK"), _counting),
    **dict.fromkeys(("AND", "OR"), _and_or),
    **dict.fromkeys(
        ("ISBLANK", "ISERR", "ISERROR", "ISLOGICAL", "ISNA", "ISNUMBER", "ISTEXT"), _is
    ),
    **dict.fromkeys(("IFERROR", "IFNA"), _iferror),
    **dict.fromkeys(("TRUE", "FALSE"), _truth_value),
    **dict.fromkeys(("ROW", "COLUMN", "ROWS", "COLUMNS"), _row_or_column),
    **dict.fromkeys(("VLOOKUP", "HLOOKUP"), _vlookup),
    **dict.fromkeys(("LARGE", "SMALL"), _ranked),
    **dict.fromkeys(
        ("AVERAGEIF", "COUNTIF", "COUNTIFS", "MAXIFS", "MINIFS", "SUMIF", "SUMIFS"), _conditional
    ),
    "CHOOSE": _choose, "IF": _if, "IFS": _ifs, "INDEX": _index, "LOOKUP": _lookup,
    "MATCH": _match, "N": _to_number, "NA": _na, "NOT": _not, "OFFSET": _offset,
    "CONVERT": _convert, "SUBTOTAL": _subtotal, "SUMPRODUCT": _sumproduct,
}  # fmt: skip
"""Every function that is computed here, by its name."""

OF_SINGLE_VALUES = frozenset(NUMERIC) | {
    "CHOOSE", "IF", "IFERROR", "IFNA", "ISBLANK", "ISERR", "ISERROR", "ISLOGICAL", "ISNA",
    "ISNUMBER", "ISTEXT", "N", "NOT",
}  # fmt: skip
"""Functions that take a range for its cell in the formula's own row or column."""
