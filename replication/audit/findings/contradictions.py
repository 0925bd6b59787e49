"""Findings on sentences of the report that contradict each other, or name the wrong thing."""

from replication.audit.assessment import Verdict
from replication.audit.findings.evidence import concerning, conclude, equals, proves, refutes
from replication.audit.record import Evidence, Finding
from replication.audit.results import Results


def says_once(results: Results, name: str, words: str, means: str) -> Evidence:
    """Return how often the report has these words: once."""
    return equals(name, "1", " ".join(results.ledger.text.split()).count(words), "1", means)


@concerning("minimum-velocity-greatest", "stream-velocity-521")
def minimum_velocity(results: Results) -> Finding:
    """Two sections disagree on the least velocity at which particles stick."""
    text = results.text
    section_2 = says_once(
        results, "section_2", "be higher than 403 m/s, but less than 521 m/s",
        "places where the text says 'be higher than 403 m/s, but less than 521 m/s'",
    )  # fmt: skip
    section_4 = says_once(
        results, "section_4", "suggesting that only faster-than-average particles were",
        "places where it says 'suggesting that only faster-than-average particles were'",
    )  # fmt: skip
    return conclude(
        "minimum-velocity",
        "wording",
        title=f"Section 2 and section 4 disagree on whether {text('velocity-521')} m/s is above "
        "the minimum velocity",
        statement='Section 2 says that the minimum velocity for sticking "would certainly be '
        f"higher than {text('minimum-velocity-least')} m/s, but less than "
        f'{text("minimum-velocity-greatest")} m/s". Section 4 takes the low deposition efficiency '
        f'at an average of {text("stream-velocity-521")} m/s as "suggesting that only '
        'faster-than-average particles were adhering". If only those adhere, the minimum is '
        f"{text('velocity-521')} m/s or more.",
        settle="The deposition efficiency at that velocity, or the velocities of the particles "
        "that stuck.",
        status="open",
        evidence=(section_2, section_4),
    )


@concerning("eq6", "eq5")
def wrong_reference(results: Results) -> Finding:
    """The report refers to Eq. 1 where it means Eq. 5, and has a few slips of wording."""
    text = results.text
    stress = refutes(
        "stress", "Sigma" in results.ledger.printed_text("eq1"), "Eq. 1 contains Sigma"
    )
    follows = proves(
        "follows",
        results.verdict("eq6") is Verdict.REPRODUCED,
        "Eq. 6 follows from Eq. 5 with u = v",
    )
    times = says_once(results, "times", "equation 1 reduces", "places where the text says so")
    caption = says_once(
        results, "caption", "500-m/s steel", "places where the text says '500-m/s steel'"
    )
    ratio = text("volume-ratio")
    return conclude(
        "wrong-reference",
        "misprint",
        title='"Equation 1 reduces to" should say equation 5; other slips of wording',
        statement='Before Eq. 6 the report says that the assumption dictates v = u, "and equation '
        "1 reduces to\" it. Eq. 1 relates a particle's velocity to its mass and has no stress in "
        "it. Eq. 5 with u = v is Eq. 6 exactly. All other references to equations lead where they "
        f'should. {ratio} "(see figure 1)" may be Figure 1\'s {text("volume-ratio-line")}, '
        f"rounded, or the bound of the data at {text('velocity-606')} m/s, which the figure does "
        "not show. Besides, F_r of Eq. 8, a force, is called target resistance, a stress; the "
        'caption of Figure 3 has "500-m/s steel"; "Dykhuzen" and "Brinnell" are misspelled. Of all '
        f"these only that {ratio} is a number in use; its digits are a finding of their own. "
        "References to the literature cannot be checked: the text at hand has no list of them.",
        by_hand="Put u = v in Eq. 5: the first term vanishes, the right side is Eq. 6.",
        settle="Nothing is open.",
        status="explained",
        evidence=(stress, follows, times, caption),
    )
