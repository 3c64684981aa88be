"""The normal distribution function and its logarithm, whose bits do not depend on the machine.

Within 5 ulp, tested against mpmath; as the functions of `elementary` they are for kernels.
"""

from repro.kernels.compiled import scalar
from repro.kernels.elementary import UPPER_26, bits_of, exp, log, log1p, with_bits


@scalar
def _tail(a):
    """e^(a^2 / 2) times the normal probability beyond a >= 0."""
    # (1 + a) times it is smooth in t, after Shepherd and Laframboise (1981).
    t = (a - 5.0) / (a + 5.0)
    p = -3.9886338590692045e-10
    p = p * t - 2.8233272215141205e-10
    p = p * t + 4.500725392479864e-09
    p = p * t + 3.6280682399194867e-09
    p = p * t - 3.120147211147667e-08
    p = p * t - 2.6287875968778985e-08
    p = p * t + 1.9663442631364518e-07
    p = p * t + 1.278804945396261e-07
    p = p * t - 1.3077682743993349e-06
    p = p * t - 7.034836922558877e-08
    p = p * t + 9.060011716331426e-06
    p = p * t - 9.896096712884405e-06
    p = p * t - 5.3607652870422455e-05
    p = p * t + 0.00018233414474988366
    p = p * t + 7.79161509574746e-06
    p = p * t - 0.0016760723444742157
    p = p * t + 0.006522000665119207
    p = p * t - 0.015170415402525146
    p = p * t + 0.02453696324390185
    p = p * t - 0.02640104296630763
    p = p * t + 0.010002352385220747
    p = p * t + 0.03103036842596369
    p = p * t - 0.09155228183400893
    p = p * t + 0.46151582985003775
    whole = 1.0 + a
    q = p / whole
    return q - q * (((1.0 - whole) + a) / whole if a < 1.0 else ((a - whole) + 1.0) / whole)


@scalar
def _central_cdf(x):
    """Standard normal probability below x, |x| < 1."""
    z = x * x
    z2 = z * z
    slope = (0.39894228040143265 + z * -0.06649038006690386) + z2 * (
        0.009973557009983383 + z * -0.0011873282148079404
    )
    slope += (z2 * z2) * (
        (0.00011543468323083616 + z * -9.444639808676774e-06)
        + z2 * (6.659316904081042e-07 + z * -4.117308931965184e-08)
        + (z2 * z2) * (2.2270765391721188e-09 + z * -9.026109904565583e-11)
    )
    return 0.5 + x * slope


@scalar
def normal_cdf(x):
    """Standard normal probability below x; zero where it would be subnormal."""
    a = abs(x)
    a = 40.0 if a > 40.0 else a  # beyond, the result is zero
    # a^2 / 2 in two parts, the first exact, for the exponential magnifies its error by a^2
    high = with_bits(bits_of(a) & UPPER_26)
    rest = -0.5 * (a + high) * (a - high)
    density = exp(-0.5 * high * high)
    density += density * (rest + rest * rest * (0.5 + rest * (1.0 / 6.0)))
    beyond = density * _tail(a)
    outside = 1.0 - beyond if x > 0.0 else beyond
    return _central_cdf(x) if a < 1.0 else outside


@scalar
def log_normal_cdf(x):
    """Logarithm of the standard normal probability below x."""
    a = abs(x)
    if x > 0.0:
        return log1p(-normal_cdf(-a))
    if x > -1.0:
        return log(normal_cdf(x))
    return log(_tail(min(a, 1e300))) - 0.5 * a * a
