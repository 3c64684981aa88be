import numpy as np

from repro.kernels.resampling import multinomial


def test_children_are_multinomial():
    weights = np.array([[0.1, 0.2, 0.0, 0.7], [0.25, 0.25, 0.25, 0.25]])
    repeated = np.repeat(weights, 20000, axis=0)
    parents = multinomial(repeated, np.random.default_rng(0).random(repeated.shape))
    children = np.stack([(parents == i).sum(axis=1) for i in range(4)], axis=-1)
    of_first, of_second = children[:20000], children[20000:]
    np.testing.assert_allclose(of_first.mean(axis=0), 4 * weights[0], atol=0.03)
    np.testing.assert_allclose(of_first.var(axis=0), 4 * weights[0] * (1 - weights[0]), atol=0.03)
    np.testing.assert_allclose(of_second.mean(axis=0), 1.0, atol=0.03)
    assert (of_first[:, 2] == 0).all()


def test_each_uniform_falls_to_its_own_parent():
    weights, uniforms = np.array([[0.5, 0.3, 0.2]]), np.array([[0.95, 0.1, 0.6]])
    np.testing.assert_array_equal(multinomial(weights, uniforms), [[0, 1, 2]])
