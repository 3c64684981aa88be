"""Paired differences between filters on the same trials."""


def decided(difference: float, mcse: float, tolerance: float) -> str:
    """Whether a difference of errors is `better`, `worse`, or `not decided` beyond its error."""
    if difference == 0.0 or not abs(difference) > tolerance * mcse:
        return "not decided"
    return "better" if difference < 0 else "worse"
