"""What the plan of a workbook must know about a case: names and sizes, no physics."""

from dataclasses import dataclass

__all__ = ["MAX_STEPS", "CaseSheet", "prepared_rows"]

SPARE_ROWS = 100
"""At least so many rows stay blank after the stop, for inputs that need more steps."""

MAX_STEPS = 20_000
"""A case of more steps is refused: writing it takes half a minute and gigabytes of memory."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseSheet:
    """One case: its sheet's `name`, and the `slug` under which its keys and defined names stand.

    The slug is "low" or "high" where two cases stand side by side and "case" where one is alone.
    `steps` and `rows` count the rows in use and the prepared ones, after row 0. With
    `resistance_given` the target resistance is an input and not the product of beta and the flow
    stress. `printed` holds the report's final depth [µm] and normalized depth, as printed, where
    the case is the report's own. A `coarse` sheet repeats its case with the step `dt_coarse`.
    """

    name: str
    slug: str
    steps: int
    rows: int
    resistance_given: bool = False
    printed: tuple[str, str] = ("", "")
    coarse: bool = False

    def named(self, symbol: str) -> str:
        """The defined name of this case's `symbol`: R_t_low beside R_t_high, or R_t alone."""
        return symbol if self.slug == "case" else f"{symbol}_{self.slug}"

    @property
    def part(self) -> str:
        """What the keys of its sheet begin with: "low", or "low_coarse"."""
        return f"{self.slug}_coarse" if self.coarse else self.slug

    def result_named(self, what: str) -> str:
        """The defined name of a result of its sheet: depth_um_low, or depth_um_low_coarse."""
        return f"{self.named(what)}_coarse" if self.coarse else self.named(what)

    @property
    def step_named(self) -> str:
        """The defined name of its time step."""
        return "dt_coarse" if self.coarse else "dt_s"


def prepared_rows(steps: int) -> int:
    """Rows for a case of so many steps: twice as many, at least a hundred more, in full hundreds.

    Raises ValueError for more than `MAX_STEPS` steps.

    >>> prepared_rows(178), prepared_rows(3)
    (400, 200)
    """
    if steps > MAX_STEPS:
        raise ValueError(
            f"the workbook would need {steps:,} steps, more than {MAX_STEPS:,}: take a larger step"
        )
    wanted = max(2 * steps, steps + SPARE_ROWS)
    return -(-wanted // 100) * 100
