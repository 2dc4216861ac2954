"""Levenberg-Marquardt in b1, b2, b3, written by hand and compiled by numba: the best one does in Python."""
import numba
import numpy as np

from turns import take

MOST_PASSES = 60


@numba.njit
def discretise(b2, b3, h):
    """Coefficients of the exact recursion of (g, g', z, z') for straight input, by the exponential's series."""
    generator = np.zeros((6, 6))
    generator[0, 1] = generator[2, 3] = h
    generator[1, 0] = generator[3, 2] = -b2 * h
    generator[1, 1] = generator[3, 3] = -b3 * h
    generator[1, 4] = generator[3, 0] = h
    generator[4, 5] = 1.0
    step = np.eye(6)
    term = np.eye(6)
    for order in range(1, 13):
        term = generator @ term / order
        step += term
    return step


@numba.njit(fastmath=True)
def linearise(b, torque, angle, h):
    """Curvature, gradient and sum of squares of the residual angle - b1 g, in one pass."""
    s = discretise(b[1], b[2], h)
    b1 = b[0]
    g = dg = z = dz = 0.0
    gg = gz = gd = zz = zd = dd = rg = rz = rd = rr = 0.0
    for j in range(len(torque)):
        r = angle[j] - b1 * g
        gg += g * g
        gz += g * z
        gd += g * dz
        zz += z * z
        zd += z * dz
        dd += dz * dz
        rg += r * g
        rz += r * z
        rd += r * dz
        rr += r * r
        u = torque[j]
        du = torque[j + 1] - u if j + 1 < len(torque) else 0.0
        new_g = s[0, 0] * g + s[0, 1] * dg + s[0, 4] * u + s[0, 5] * du
        new_dg = s[1, 0] * g + s[1, 1] * dg + s[1, 4] * u + s[1, 5] * du
        new_z = s[2, 0] * g + s[2, 1] * dg + s[0, 0] * z + s[0, 1] * dz + s[2, 4] * u + s[2, 5] * du
        dz = s[3, 0] * g + s[3, 1] * dg + s[1, 0] * z + s[1, 1] * dz + s[3, 4] * u + s[3, 5] * du
        g, dg, z = new_g, new_dg, new_z
    # The angle's derivatives by b1, b2, b3 are g, -b1 z, -b1 z'.
    curvature = np.array([[gg, -b1 * gz, -b1 * gd], [-b1 * gz, b1**2 * zz, b1**2 * zd], [-b1 * gd, b1**2 * zd, b1**2 * dd]])
    return curvature, np.array([rg, -b1 * rz, -b1 * rd]), rr


@numba.njit
def solve(torque, angle, h, b):
    curvature, gradient, squares = linearise(b, torque, angle, h)
    damping = 1e-3
    for _ in range(MOST_PASSES):
        step = np.linalg.solve(curvature + damping * np.diag(np.diag(curvature)), gradient)
        is_small = np.max(np.abs(step / b)) < 1e-9
        trial = b + step
        if trial.min() > 0.0:
            there = linearise(trial, torque, angle, h)
            if there[2] <= squares:
                b = trial
                curvature, gradient, squares = there
                damping *= 0.02
                if is_small:
                    break
                continue
        if is_small:
            break
        damping = max(damping, 1e-6) * 8
    return b


def make_fit(problem):
    def fit(number):
        start = problem.normalised(number, problem.start)
        return problem.parameters(number, solve(problem.torque[number], problem.angle[number], problem.interval, start))

    return fit


take(make_fit)
