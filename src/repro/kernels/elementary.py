"""Elementary functions whose bits do not depend on the machine.

Built from + - * / sqrt and bit operations alone, which IEEE 754 fixes: the result is the same on
every CPU, with every C library, whatever the width of the vectors. Without branches, so that a
loop over them is vectorised. Within 2 ulp, tested against mpmath. A NaN gives a NaN.

The reductions are those of fdlibm (Sun, 1993); the polynomials interpolate at Chebyshev's nodes
of the reduced argument, computed with 60 digits, and are mostly summed in pairs (Estrin), as a
chain of sums waits for each of them. These are scalar functions, for kernels;
`repro.kernels.arrays` has them for arrays.
"""

import numpy as np

from repro.kernels.compiled import scalar

LN2, LN2_HIGH, LN2_LOW = 0.6931471805599453, 6.93147180369123816490e-01, 1.90821492927058770002e-10
LOG2_E, LOG10_E = 1.4426950408889634, 0.4342944819032518
HALF_PI, QUARTER_PI = 1.5707963267948966, 0.7853981633974483
HALF_PI_REST, QUARTER_PI_REST = 6.123233995736766e-17, 3.061616997868383e-17
# pi / 2 in pieces of 33 bits: a piece times an integer below 2^20 is exact
HALF_PI_1, HALF_PI_2 = 1.57079632673412561417e00, 6.07710050630396597660e-11
HALF_PI_3, HALF_PI_4 = 2.02226624871116645580e-21, 8.47842766036889956997e-32
TRIGONOMETRIC_RANGE = 1e6  # radians; beyond it sine and cosine are NaN
# Added to |x| < 2^51 it leaves the nearest integer in the lowest bits.
SHIFT = 6755399441055744.0
EXP_UNDERFLOWS, EXP_OVERFLOWS = -708.3964185322641, 709.782712893384
LEAST_NORMAL = 2.2250738585072014e-308
MANTISSA = 0x000FFFFFFFFFFFFF
ROOT_HALF = 0x3FE6A09E667F3BCD  # the bits of sqrt(1/2)
ONE = 0x3FF0000000000000  # of 1
TWO_52 = 0x4330000000000000  # of 2^52
SIGN = -0x8000000000000000
UPPER_26, UPPER_21 = -0x8000000, -0x100000000  # all but the lowest 27 or 32 bits


@scalar
def bits_of(x):
    """The bits of a float64, as an int64."""
    return np.float64(x).view(np.int64)


@scalar
def with_bits(bits):
    """The float64 of these bits."""
    return np.int64(bits).view(np.float64)


@scalar
def with_sign(x, of):
    """|x| with the sign of the other number, also of a zero."""
    return with_bits((bits_of(x) & ~SIGN) | (bits_of(of) & SIGN))


@scalar
def _exp_rest(r):
    """e^r - 1 - r for |r| <= log(2) / 2."""
    r2 = r * r
    r4 = r2 * r2
    first = (0.5000000000000001 + r * 0.16666666666666669) + r2 * (
        0.04166666666662413 + r * 0.008333333333330062
    )
    second = (0.0013888888917213717 + r * 0.00019841269863053618) + r2 * (
        2.4801521295954376e-05 + r * 2.7557268459997064e-06
    )
    third = 2.7620088445409746e-07 + r * 2.510038549551032e-08
    return r2 * (first + r4 * (second + r4 * third))


@scalar
def exp_of_negative(x):
    """e^x of an x that is not positive; zero where it would be subnormal."""
    shifted = x * LOG2_E + SHIFT
    k = shifted - SHIFT
    r = (x - k * LN2_HIGH) - k * LN2_LOW
    fraction = 1.0 + (r + _exp_rest(r))
    y = with_bits(bits_of(fraction) + (bits_of(shifted) << 52))
    return 0.0 if x < EXP_UNDERFLOWS else y


@scalar
def exp(x):
    """e^x; zero where it would be subnormal."""
    return np.inf if x > EXP_OVERFLOWS else exp_of_negative(x)


@scalar
def expm1(x):
    """e^x - 1, to its last digits where x is small."""
    shifted = x * LOG2_E + SHIFT
    k = shifted - SHIFT
    high, low = x - k * LN2_HIGH, k * LN2_LOW
    r = high - low
    rest = ((high - r) - low) + _exp_rest(r)
    half = with_bits(0x3FE0000000000000 + (bits_of(shifted) << 52))  # 2^(k-1), finite up to 2^1024
    y = 2.0 * (((half - 0.5) + half * r) + half * rest)
    y = -1.0 if x < -40.0 else y
    return np.inf if x > EXP_OVERFLOWS else y


@scalar
def _parts(x):
    """k and f with x = 2^k (1 + f), 1 + f between sqrt(1/2) and sqrt(2); x positive and normal."""
    bits = bits_of(x) + (ONE - ROOT_HALF)
    k = with_bits(((bits >> 52) & 0x7FF) + TWO_52) - 4503599627371519.0  # 2^52 + 1023
    return k, with_bits((bits & MANTISSA) + ROOT_HALF) - 1.0


@scalar
def _log_rest(f):
    """f - log(1 + f)."""
    s = f / (2.0 + f)
    z = s * s
    z2 = z * z
    rest = (0.666666666666667 + z * 0.3999999999989938) + z2 * (
        0.28571428626031065 + z * 0.22222211125723262
    )
    rest += (z2 * z2) * ((0.1818288978615799 + z * 0.15331699634642276) + z2 * 0.146167211662876)
    half_square = 0.5 * f * f
    return half_square, s * (half_square + z * rest)


@scalar
def _log_domain(x, y):
    """y, a logarithm of x, but what it is for an x that is not positive, normal and finite."""
    y = y if x < np.inf else x
    y = -np.inf if x < LEAST_NORMAL else y
    return np.nan if x < 0.0 else y


@scalar
def log_of_normal(x):
    """Natural logarithm of a number known to be positive, normal and finite."""
    k, f = _parts(x)
    half_square, rest = _log_rest(f)
    return k * LN2_HIGH - ((half_square - (rest + k * LN2_LOW)) - f)


@scalar
def log(x):
    """Natural logarithm; -inf for zero and subnormal numbers, NaN below."""
    return _log_domain(x, log_of_normal(x))


@scalar
def log10(x):
    """Decimal logarithm; -inf for zero and subnormal numbers, NaN below."""
    k, f = _parts(x)
    half_square, rest = _log_rest(f)
    # log(1 + f) in two parts; that of 21 bits times a constant of 32 is exact
    high = with_bits(bits_of(f - half_square) & UPPER_21)
    low = ((f - high) - half_square) + rest
    leading = k * 3.01029995663611771306e-01
    of_high = high * 4.34294481878168880939e-01
    lowest = k * 3.69423907715893078616e-13 + (
        (low + high) * 2.50829467116452752298e-11 + low * 4.34294481878168880939e-01
    )
    total = leading + of_high
    lowest += (leading - total) + of_high
    return _log_domain(x, total + lowest)


@scalar
def log1p(x):
    """log(1 + x), to its last digits where x is small."""
    u = 1.0 + x
    k, f = _parts(u)
    half_square, rest = _log_rest(f)
    lost = (1.0 - (u - x)) if k > 0.0 else (x - (u - 1.0))  # by the rounding of 1 + x
    correction = lost / u
    y = k * LN2_HIGH - ((half_square - (rest + (k * LN2_LOW + correction))) - f)
    y = x if u == 1.0 else y
    return _log_domain(u, y)


@scalar
def logaddexp(x, y):
    """log(e^x + e^y), to an ulp or two of the larger of x, y and the result."""
    largest = x if x > y else y
    least = y if x > y else x
    gap = 0.0 if least == largest else least - largest  # inf - inf would be NaN
    return largest + log1p(exp(gap))


@scalar
def _sine_cosine(r, quadrant):
    """Sine and cosine of r + quadrant pi / 2, |r| <= pi / 4; quadrant an int64."""
    z = r * r
    z2 = z * z
    sine = (-0.16666666666666666 + z * 0.008333333333330946) + z2 * (
        (-0.0001984126983675497 + z * 2.755731610068312e-06)
        + z2 * (-2.5051131455447428e-08 + z * 1.591810123167728e-10)
    )
    sine = r + r * z * sine
    cosine = (0.041666666666666664 + z * -0.0013888888888887395) + z2 * (
        (2.4801587298763433e-05 + z * -2.7557317270560385e-07)
        + z2 * (2.087614602470193e-09 + z * -1.1382614869434128e-11)
    )
    half_square = 0.5 * z
    whole = 1.0 - half_square
    cosine = whole + (((1.0 - whole) - half_square) + z2 * cosine)
    odd = quadrant & 1
    first, second = (cosine if odd else sine), (sine if odd else cosine)
    sign, next_sign = (quadrant & 2) << 62, ((quadrant + 1) & 2) << 62
    return with_bits(bits_of(first) ^ sign), with_bits(bits_of(second) ^ next_sign)


@scalar
def sine_cosine(x):
    """Sine and cosine of an angle in radians, of at most a million."""
    shifted = x * (1.0 / HALF_PI) + SHIFT
    k = shifted - SHIFT
    first, second = x - k * HALF_PI_1, k * HALF_PI_2
    r = first - second
    rounded = (first - r) - second
    r = (r - (k * HALF_PI_3 - rounded)) - k * HALF_PI_4
    sine, cosine = _sine_cosine(r, bits_of(shifted))
    inside = -TRIGONOMETRIC_RANGE <= x <= TRIGONOMETRIC_RANGE
    return (sine if inside else np.nan), (cosine if inside else np.nan)


@scalar
def sine_cosine_of_turns(u):
    """Sine and cosine of 2 pi u."""
    shifted = u * 4.0 + SHIFT
    return _sine_cosine((u * 4.0 - (shifted - SHIFT)) * HALF_PI, bits_of(shifted))


@scalar
def sin(x):
    """Sine of an angle in radians, of at most a million."""
    return sine_cosine(x)[0]


@scalar
def cos(x):
    """Cosine of an angle in radians, of at most a million."""
    return sine_cosine(x)[1]


@scalar
def arctan2(y, x):
    """The angle of (x, y) in (-pi, pi], as atan2 of the C library also for zeros and infinities."""
    a, b = abs(x), abs(y)
    steep = b > a
    larger, smaller = (b if steep else a), (a if steep else b)
    diagonal = smaller == np.inf
    larger, smaller = (1.0 if diagonal else larger), (1.0 if diagonal else smaller)
    # arctan t = pi/4 + arctan((t - 1) / (t + 1)); from a half on t - 1 is exact
    turned = smaller > 0.5 * larger
    above = smaller - larger if turned else smaller
    below = smaller + larger if turned else larger
    t = above / below
    t = 0.0 if below == 0.0 else t
    z = t * t
    z2 = z * z
    z4 = z2 * z2
    rest = (-0.33333333333333326 + z * 0.19999999999991583) + z2 * (
        -0.14285714284103448 + z * 0.1111111098995003
    )
    rest += z4 * (
        (-0.09090904363850932 + z * 0.07692198323260296)
        + z2 * (-0.06665051281172327 + z * 0.058664843309910474)
    )
    rest += (z4 * z4) * (
        (-0.05157453524161038 + z * 0.04283382607864687)
        + z2 * (-0.028950063176008352 + z * 0.011150280142631823)
    )
    angle = t + t * z * rest
    # The angle is angle + base, negated and moved by the octant; the small parts are summed first.
    base, base_rest = (QUARTER_PI, QUARTER_PI_REST) if turned else (0.0, 0.0)
    base, base_rest = (HALF_PI - base, HALF_PI_REST - base_rest) if steep else (base, base_rest)
    angle = -angle if steep else angle
    back = bits_of(x) < 0
    base, base_rest = (
        (2.0 * HALF_PI - base, 2.0 * HALF_PI_REST - base_rest) if back else (base, base_rest)
    )
    angle = -angle if back else angle
    angle = base + (angle + base_rest)
    angle = angle if x == x and y == y else np.nan
    return with_sign(angle, y)


@scalar
def hypot(x, y):
    """sqrt(x^2 + y^2), for sides whose squares neither overflow nor underflow."""
    return np.sqrt(x * x + y * y)
