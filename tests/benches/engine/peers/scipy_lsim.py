"""SciPy's least_squares on a simulation by lsim, as one writes it in an afternoon."""
import numpy as np
from scipy.optimize import least_squares
from scipy.signal import lsim

from turns import take


def make_fit(problem):
    time = problem.interval * np.arange(problem.torque.shape[1])

    def fit(number):
        def residual(parameters):
            b1, b2, b3 = problem.normalised(number, parameters)
            # lsim takes the input to be straight between samples, as we do.
            _, angle, _ = lsim(([b1], [1, b3, b2]), problem.torque[number], time)
            return angle - problem.angle[number]

        # Central differences: one-sided ones are too coarse for an optimum to 1e-6.
        result = least_squares(
            residual, problem.start, jac="3-point", x_scale=problem.start, ftol=1e-12, xtol=1e-10, gtol=1e-12
        )
        return result.x

    return fit


take(make_fit)
