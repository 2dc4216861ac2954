"""SciPy's least_squares (MINPACK) with exact sensitivities, every recursion in lfilter."""
import numpy as np
from scipy.linalg import expm
from scipy.optimize import least_squares
from scipy.signal import lfilter

from turns import take


def discretise(b2, b3, interval):
    """x[k+1] = A x[k] + held u[k] + ramp (u[k+1] - u[k]) for x = (g, g', z, z'), exact for straight input.

    g'' + b3 g' + b2 g = u and z'' + b3 z' + b2 z = g.
    """
    generator = np.zeros((6, 6))
    generator[[0, 2], [1, 3]] = 1
    generator[1, [0, 1, 4]] = -b2, -b3, 1
    generator[3, [0, 2, 3]] = 1, -b2, -b3
    generator[4, 5] = 1 / interval
    step = expm(generator * interval)
    return step[:4, :4], step[:4, 4], step[:4, 5]


def recursion(a, drive):
    """Both rows of x[k+1] = a x[k] + drive[k] from rest, a being 2 x 2."""
    poles = [1, -np.trace(a), np.linalg.det(a)]
    first = lfilter([0, 1, -a[1, 1]], poles, drive[0]) + lfilter([0, 0, a[0, 1]], poles, drive[1])
    second = lfilter([0, 0, a[1, 0]], poles, drive[0]) + lfilter([0, 1, -a[0, 0]], poles, drive[1])
    return np.array([first, second])


def make_fit(problem):
    def motion(number, parameters, with_sensitivities):
        b1, b2, b3 = problem.normalised(number, parameters)
        a, held, ramp = discretise(b2, b3, problem.interval)
        torque = problem.torque[number]
        drive = np.outer(held, torque) + np.outer(ramp, np.append(np.diff(torque), 0.0))
        g = recursion(a[:2, :2], drive[:2])
        if not with_sensitivities:
            return b1 * g[0]
        z = recursion(a[:2, :2], drive[2:] + a[2:, :2] @ g)
        by = np.array([g[0], -b1 * z[0], -b1 * z[1]])
        # b1 = 1/I, b2 = K/I, b3 = C/I with I = I_n + m l^2, C = c l^2, K = k l^2.
        by_m = -b1 * (b1 * by[0] + b2 * by[1] + b3 * by[2])
        return problem.square * np.column_stack([by_m, b1 * by[2], b1 * by[1]])

    def fit(number):
        result = least_squares(
            lambda p: motion(number, p, False) - problem.angle[number],
            problem.start,
            jac=lambda p: motion(number, p, True),
            method="lm",
            x_scale=problem.start,
            ftol=1e-12,
            xtol=1e-10,
            gtol=1e-12,
        )
        return result.x

    return fit


take(make_fit)
