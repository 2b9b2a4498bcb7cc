"""Light from bounce to bounce."""

import numpy as np
import pytest

import heightlight as hl


def test_rows_sum_to_one(brick_operator):
    ones = np.ones(brick_operator.shape)
    np.testing.assert_allclose(brick_operator @ ones + brick_operator.direct, 1, atol=1e-12)


def test_bounces_and_what_follows_sum_to_one(brick_operator):
    bounces = brick_operator.bounces(30)
    assert bounces.shape == (31, *brick_operator.shape)
    np.testing.assert_array_equal(bounces[0], brick_operator.direct)
    rest = 1 - bounces.sum(axis=0)
    assert -1e-9 <= rest.min() and rest.max() < 0.1
    np.testing.assert_allclose(brick_operator.solve(1.0), 1, atol=1e-6)  # walks gather in single precision


def test_a_stack_is_gathered_one_by_one(brick_operator):
    stack = np.random.default_rng(1).random((3, *brick_operator.shape))
    gathered = brick_operator @ stack
    for one, found in zip(stack, gathered):
        np.testing.assert_array_equal(found, brick_operator @ one)
    np.testing.assert_allclose(brick_operator @ (2 * stack[0] + stack[1]), 2 * gathered[0] + gathered[1], atol=1e-6)
    assert (brick_operator @ np.empty((0, *brick_operator.shape))).shape == (0, *brick_operator.shape)


@pytest.mark.parametrize("options", [{"error": 0, "azimuths": 64}, {"rays": 128}, {"error": 5e-4}])
def test_gmres_finds_the_same(brick, options):
    scipy_linalg = pytest.importorskip("scipy.sparse.linalg")
    op = hl.operator(brick, **options)
    equation = op.as_linear_operator(0.7)
    walks = options.get("error", 0) > 0
    # Walks gather in single precision, and solve with finer azimuths than a single product has.
    solved, failed = scipy_linalg.gmres(equation, op.direct.ravel(), tol=1e-6 if walks else 1e-10, atol=0, maxiter=50)
    assert failed == 0
    difference = solved.reshape(op.shape) - op.solve(0.7)
    assert np.sqrt(np.mean(difference**2)) < (3e-3 if walks else 1e-7)
    plain = op.as_linear_operator()
    np.testing.assert_array_equal(plain @ op.direct.ravel(), (op @ op.direct).ravel())


def test_colour_is_three_greys(brick_operator):
    colour = brick_operator.solve([0.2, 0.5, 0.8])
    assert colour.shape == (*brick_operator.shape, 3)
    for channel, albedo in enumerate([0.2, 0.5, 0.8]):
        np.testing.assert_array_equal(colour[:, :, channel], brick_operator.solve(albedo))
    textured = brick_operator.solve(np.full((*brick_operator.shape, 3), 0.5))
    np.testing.assert_allclose(textured[:, :, 1], brick_operator.solve(0.5), atol=4e-3)  # refined otherwise


def test_light_of_ones_own(brick_operator):
    direct = brick_operator.direct
    difference = brick_operator.solve(0.5, 3 * direct) / 3 - brick_operator.solve(0.5)
    assert np.sqrt(np.mean(difference**2)) < 2e-3  # one of them may have been refined
    dark = brick_operator.solve(0.5, np.zeros(brick_operator.shape))
    np.testing.assert_array_equal(dark, 0)


def test_missing_texels(holed):
    op = hl.operator(holed)
    missing = np.isnan(holed.height)
    for values in (op.direct, op.solve(0.5), op @ np.ones(op.shape), op.bounces(2)[1]):
        np.testing.assert_array_equal(np.isnan(values), missing)
    with_holes = np.where(missing, np.nan, 1.0)
    np.testing.assert_array_equal(op @ with_holes, op @ np.where(missing, 0, 1.0))


def test_curves_are_columns(brick_operator):
    curves = brick_operator.curves(bins=20, bounces=3)
    assert len({len(column) for column in curves.values()}) == 1 and curves.bins == 20
    for kind in ("ambient_occlusion", "sky_view_factor"):
        assert set(curves.over(kind)["bounce"]) == {-1, 0, 1, 2, 3}
        ao, mean = curves.bounce(0, kind)
        assert np.all(np.diff(ao) > 0) and len(ao) == len(mean)
        sums = np.zeros(len(ao))
        for bounce in (0, 1, 2, 3, -1):
            sums += curves.bounce(bounce, kind)[1]
        np.testing.assert_allclose(sums, 1, atol=1e-9)
    pandas = pytest.importorskip("pandas")
    assert isinstance(curves.to_pandas(), pandas.DataFrame)


def test_n_gives_the_total_back(brick_operator):
    n = brick_operator.seen
    total = hl.forms.seen_stored(brick_operator.sky_view_factor, n, 0.5)
    error = total - brick_operator.solve(0.5)
    assert np.sqrt(np.mean(error**2)) < 0.01
