"""Claims that two numbers are equal, close or comparable: two one-sided tests (Schuirmann 1987)."""

from repro.verdicts.claims import Part


def equivalent(name: str, difference: float, mcse: float, margin: float) -> list[Part]:
    """The difference is within the margin: below it, and above minus it.

    A claim of these parts holds if the difference is inside by the tolerance on both sides, fails
    if it is outside by it, and is undecided else: a large error is no equality. For a factor, give
    the logarithms of a ratio and of the factor. The names state the smallest margin that would have
    held, with t for the tolerance in standard errors.
    """
    smallest = f"{abs(difference):.3g} + {mcse:.2g} t would hold"
    return [
        Part(f"{name}: below {margin:.3g} ({smallest})", difference - margin, mcse),
        Part(f"{name}: above {-margin:.3g} ({smallest})", -difference - margin, mcse),
    ]
