"""The elementary functions against mpmath."""

import mpmath
import numba
import numpy as np
import pytest

from repro.kernels import arrays, elementary, normal_probability
from repro.kernels.compiled import kernel

RNG = np.random.default_rng(1)
COUNT = 1500
WIDE = np.exp(RNG.uniform(-700, 700, COUNT))
SMALL = np.concatenate([np.exp(RNG.uniform(-40, 0, COUNT)), [2.0**-53, 2.0**-54, 1e-300]])
NEAR_ONE = np.concatenate([RNG.uniform(0.5, 2, COUNT), 1 + RNG.uniform(-1e-5, 1e-5, COUNT), [1.0]])
ANGLES = np.concatenate(
    [
        RNG.uniform(-10, 10, COUNT),
        RNG.uniform(-1e6, 1e6, COUNT),
        np.arange(1, 640) * (np.pi / 2),
        np.arange(635_000, 636_000) * (np.pi / 2),
        SMALL,
        -SMALL,
    ]
)
POSITIVE = np.concatenate([WIDE, NEAR_ONE])
SIDES = np.concatenate([RNG.uniform(-1, 1, COUNT), np.exp(RNG.uniform(-10, 10, COUNT))])
OTHERS = np.concatenate([RNG.uniform(-1, 1, COUNT), -np.exp(RNG.uniform(-10, 10, COUNT))])
NORMAL = np.concatenate([RNG.uniform(-37, 8, COUNT), RNG.uniform(-2, 2, COUNT)])


def log_ncdf(x):
    return mpmath.log(mpmath.ncdf(x)) if x < 0 else mpmath.log1p(-mpmath.ncdf(-x))


CASES = {
    "exp": (mpmath.exp, 2, np.concatenate([RNG.uniform(-708, 709.7, COUNT), SMALL, -SMALL])),
    "expm1": (mpmath.expm1, 2, np.concatenate([RNG.uniform(-45, 709, COUNT), SMALL, -SMALL])),
    "log": (mpmath.log, 2, POSITIVE),
    "log10": (mpmath.log10, 2, POSITIVE),
    "log1p": (mpmath.log1p, 2, np.concatenate([WIDE, SMALL, -SMALL, RNG.uniform(-1, 3, COUNT)])),
    "sin": (mpmath.sin, 2, ANGLES),
    "cos": (mpmath.cos, 2, ANGLES),
    "arctan2": (mpmath.atan2, 2, OTHERS, SIDES),
    "hypot": (mpmath.hypot, 2, OTHERS, SIDES),
    "normal_cdf": (mpmath.ncdf, 5, NORMAL),
    "log_normal_cdf": (log_ncdf, 5, np.concatenate([NORMAL, RNG.uniform(-300, -30, COUNT)])),
}


def largest_error(values, reference, *arguments):
    """In ulp, where the exact value is a normal number."""
    largest = 0.0
    with mpmath.workprec(200):
        for value, *of in zip(values.tolist(), *(a.tolist() for a in arguments), strict=True):
            exact = reference(*(mpmath.mpf(argument) for argument in of))
            if abs(exact) > 2.3e-308:
                error = (mpmath.mpf(value) - exact) / float(np.spacing(abs(float(exact))))
                largest = max(largest, float(abs(error)))
    return largest


@pytest.mark.parametrize("name", CASES)
def test_within_some_ulp(name):
    reference, ulp, *arguments = CASES[name]
    assert largest_error(getattr(arrays, name)(*arguments), reference, *arguments) <= ulp


@kernel
def of_turns(u, sine, cosine):
    for i in range(u.size):
        sine[i], cosine[i] = elementary.sine_cosine_of_turns(u[i])


def test_turns():
    turns = np.concatenate([RNG.uniform(-1, 1, COUNT), np.arange(-64, 65) / 64, SMALL])
    sine, cosine = np.empty_like(turns), np.empty_like(turns)
    of_turns(turns, sine, cosine)
    assert largest_error(sine, lambda u: mpmath.sinpi(2 * u), turns) <= 2
    assert largest_error(cosine, lambda u: mpmath.cospi(2 * u), turns) <= 2
    quarters = np.isin(turns, np.arange(-4, 5) / 4)
    assert set(np.abs(sine[quarters])) == {0.0, 1.0}


def test_log_of_a_sum_of_exponentials():
    x, y = RNG.uniform(-50, 50, (2, 4 * COUNT))
    wanted = np.logaddexp(x, y)
    error = np.abs(arrays.logaddexp(x, y) - wanted)
    assert np.all(error <= 3 * np.spacing(np.maximum(np.abs(np.maximum(x, y)), 1.0)))


def test_special_values():
    inf, nan = np.inf, np.nan
    special = np.array([0.0, -0.0, inf, -inf, nan, 1.0, -1.0])
    with np.errstate(all="ignore"):
        for name in ("exp", "expm1", "log", "log10", "log1p"):
            wanted = getattr(np, name)(special)
            np.testing.assert_allclose(getattr(arrays, name)(special), wanted, rtol=1e-15)
        y, x = (grid.ravel() for grid in np.meshgrid(special, special))
        angles = arrays.arctan2(y, x)
        np.testing.assert_allclose(angles, np.arctan2(y, x), rtol=1e-15)
        some = ~np.isnan(angles)
        np.testing.assert_array_equal(np.signbit(angles)[some], np.signbit(np.arctan2(y, x))[some])
        np.testing.assert_allclose(arrays.logaddexp(x, y), np.logaddexp(x, y), rtol=1e-15)
    for function in (arrays.sin, arrays.cos):
        assert np.isnan(function(np.array([inf, -inf, nan, 1.1e6]))).all()
    np.testing.assert_array_equal(arrays.exp([-750.0, 710.0]), [0.0, inf])
    np.testing.assert_array_equal(arrays.log([1e-310, -1e-310]), [-inf, nan])
    np.testing.assert_array_equal(arrays.normal_cdf([-inf, 0.0, inf, nan]), [0, 0.5, 1, nan])
    np.testing.assert_array_equal(arrays.log_normal_cdf([-inf, inf, nan]), [-inf, 0.0, nan])


def test_arrays_of_any_shape():
    x = RNG.random((3, 4, 5))
    np.testing.assert_array_equal(arrays.exp(x.T), arrays.exp(x).T)
    strided = np.zeros((5, 6))
    arrays.log(x[0].T[:, :3], out=strided[:, ::2])
    np.testing.assert_array_equal(strided[:, ::2], arrays.log(x[0].T[:, :3]))
    assert arrays.hypot(3.0, 4.0) == 5.0 and isinstance(arrays.log(2.0), float)
    assert arrays.hypot(x, x[0]).shape == x.shape
    with pytest.raises(ValueError, match="shape"):
        arrays.exp(x, out=strided)


def of_all(x, y, out):
    for i in range(x.size):
        out[i] = normal_probability.log_normal_cdf(elementary.arctan2(x[i], y[i]))
    for i in range(x.size):
        sine, cosine = elementary.sine_cosine(x[i])
        out[i] += sine * cosine + elementary.logaddexp(x[i], y[i])


def test_no_contraction_and_no_library_calls():
    compiled = numba.njit(error_model="numpy")(of_all)
    compiled(*np.ones((3, 4)))
    (assembly,) = compiled.inspect_asm().values()
    assert "of_all" in assembly
    for forbidden in ("fmadd", "fmsub", "fnmadd", "fmla"):
        assert forbidden not in assembly
    called = {line.split()[-1] for line in assembly.splitlines() if "\tcall" in line}
    assert not {name for name in ("exp", "log", "sin", "cos", "atan2") if name in called}
