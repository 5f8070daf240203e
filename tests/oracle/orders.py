"""Jerks, second derivatives by the inputs and sensitivities by finite differences in 90-digit arithmetic.

Nothing is differentiated by formula: the closures, written here by hand as complex numbers, are solved by
Newton's method beside the pose. Central differences with a step of 1e-18 are right to more than 25 digits.

    python3 tests/oracle/orders.py > tests/oracle/orders.json
"""

import json

from mpmath import (acos, asin, atan, atan2, cos, exp, hypot, im, log, lu_solve, matrix, mp, mpc, mpf, nstr, pi, re,
                    sin, sqrt, tan)

mp.dps = 90
STEP = mpf(10) ** -18


def at(modulus, angle):
    return modulus * mpc(cos(angle), sin(angle))


def split(*loops):
    return [part for loop in loops for part in (re(loop), im(loop))]


def norton_four_bar(p, u, v):
    a, b, c, d = p
    tip = at(a, v[0]) + at(b, u[0])
    return split(tip - at(c, u[1]) - d), [at(a, v[0]) + at(mpc(b / 2, 30), u[0])], [u[1] - u[0]]


def components(p, u, v):
    l1, l2, l3, l4 = p
    return split(at(l2, v[0]) + at(l3, u[0]) + at(l4, u[1]) - l1), [l1 - at(l4, u[1])], [u[0] - u[1]]


def offset_slider_crank(p, u, v):
    a, b, c = p
    pin = at(a, v[0])
    return split(pin - at(b, u[0]) - mpc(u[1], c)), [mpc(0), pin, mpc(u[1], c)], [pi - u[0]]


def five_bar(p, u, v):
    a, b, c, d, e = p
    tip = at(a, v[0]) + at(b, u[0])
    pen = tip + at(mpc("0.3", "-0.2"), u[0])
    return split(tip - e - at(d, v[1]) - at(c, u[1])), [tip, pen], [abs(tip)]


def geared_five_bar(p, u, v):
    a, b, c, d, e, ratio, phase = p
    tip = at(a, v[0]) + at(b, u[0])
    rows = split(tip - e - at(d, u[2]) - at(c, u[1])) + [u[2] - ratio * v[0] - phase]
    return rows, [tip], [u[2] / v[0]]


def elliptic_trammel(p, u, v):
    rod, reach = p
    pen = u[0] + at(reach, v[0])
    return split(u[0] + at(rod, v[0]) - mpc(0, u[1])), [mpc(0), mpc(u[0]), mpc(0, u[1]), pen], [abs(pen)]


def jansen(p, u, v):
    a, b, c, d, e, f, g, h, i, j, k, l, m = p
    to_b, to_j, to_d, to_e, to_c, to_k, to_f, to_g, to_h, to_i = u
    pivot, pin = mpc(-a, -l), at(m, v[0])
    rows = split(pin + at(j, to_j) - pivot - at(b, to_b), at(b, to_b) + at(e, to_e) - at(d, to_d),
                 pin + at(k, to_k) - pivot - at(c, to_c), at(d, to_d) + at(f, to_f) - at(c, to_c) - at(g, to_g),
                 at(g, to_g) + at(h, to_h) - at(i, to_i))
    knee = pivot + at(c, to_c)
    points = [mpc(0), pivot, pin, pivot + at(b, to_b), pivot + at(d, to_d), knee, knee + at(g, to_g),
              knee + at(i, to_i)]
    return rows, points, [to_h - to_d]


def double_butterfly(p, u, v):
    ab, ac, dx, dy, ce, ef, gx, gy, bf, jx, jy, dh, ix, iy, gh, ij = p
    coupler, upper, rocker, lower, link, strut = u
    c, d, b = at(ac, v[0]), at(mpc(dx, dy), v[0]), mpc(ab)
    e = c + at(ce, coupler)
    f, g, h = b + at(bf, rocker), e + at(mpc(gx, gy), upper), d + at(dh, lower)
    i, j = d + at(mpc(ix, iy), lower), b + at(mpc(jx, jy), rocker)
    rows = split(e + at(ef, upper) - f, g - h - at(gh, link), i + at(ij, strut) - j)
    return rows, [mpc(0), b, c, d, e, f, g, h, i, j], [rocker]


def every_function(p, u, v):
    (a, b), u, v = p, u[0], v[0]
    w = mpf("0.3") + mpf("0.1") * sin(u + v)
    point = at(mpc(hypot(u, v), w * cos(u) ** 3), u - 2 * v)
    x, y = re(point), im(point)
    outputs = [sin(u * v), cos(u - v / 3), tan(w), asin(w), acos(w), atan(u * v), atan2(u + 2, v - 5),
               sqrt(1 + u ** 2), abs(v - 7) * u, exp(u / (1 + w)), log(w * (2 + cos(v))), hypot(u + 3, v),
               u ** 3 / w ** 2 + 1 / (u + v), x + 2 * y + x * v - y * u + abs(point) + atan2(y, x + 40) + x * y + pi / 7]
    return [a * u + b * sin(v) - exp(-v) / 2], [point], outputs


def degrees(angle):
    return mpf(angle) * pi / 180


JANSEN = "38 41.5 39.3 40.1 55.8 39.4 36.7 65.7 49 50 61.9 7.8 15"
BUTTERFLY = "6 1 0.2 -1 6 3.5 5 -3 4 0.4 1.5 2 2 -4 3.5 3.5"
# Closures, parameters, inputs with their rates, accelerations and jerks, and unknowns to start from.
CASES = [
    (norton_four_bar, "40 120 80 100", [(degrees(40), 25, 15, -40)], "0.35 1"),
    (offset_slider_crank, "40 120 -20", [(degrees(60), -30, 7, 500)], "2.7 127"),
    (five_bar, "1 2.5 2.2 0.8 2", [("1.1", "0.7", "-0.4", "1.3"), ("2.3", "-1.2", "0.9", "0.6")], "0.2 1.4"),
    (geared_five_bar, ["1", "2.5", "2.2", "0.8", "2", "-2", degrees(40)], [("0.9", "1.4", "-0.3", "2.5")],
     "0.3 1.2 -1.1"),
    (elliptic_trammel, "2 3.5", [("0.8", "1.5", "0.25", "-0.75")], "-1.4 1.4"),
    (jansen, JANSEN, [("0.125", "3", "0.5", "-2")], "1.23 2.47 2.73 -2.71 -1.29 -2.32 -1.17 2.65 -1.32 -1.91"),
    (double_butterfly, BUTTERFLY, [("1.036", "1.25", "-0.5", "0.75")], "1 -0.595 1.408 0.508 -0.004 1.591"),
    (every_function, "1.2 0.3", [("0.6", "1.1", "-0.7", "0.4")], "0.1"),
    (components, "80 20 50 70", [("0.35", 40, -3, 12)], "1.2 -0.9"),
]


def listed(values):
    return [float(nstr(value, 25)) for value in values]


def solve(closures, p, v, u):
    """The unknowns by Newton's method, the Jacobian by one-sided differences."""
    tiny, limit = mpf(10) ** -45, mpf(10) ** -84
    for _ in range(40):
        rows = closures(p, u, v)[0]
        columns = []
        for place in range(len(u)):
            moved = closures(p, [x + tiny * (i == place) for i, x in enumerate(u)], v)[0]
            columns.append([(new - old) / tiny for new, old in zip(moved, rows)])
        step = lu_solve(matrix(columns).T, matrix(rows))
        u = [x - dx for x, dx in zip(u, step)]
        if max(abs(dx) for dx in step) < limit:
            return u
    raise ArithmeticError(f"{closures.__name__} is not closed")


def everything(closures, p, v, guess):
    """Unknowns, then points by component, then outputs."""
    u = solve(closures, p, v, guess)
    _, points, outputs = closures(p, u, v)
    return u + [part for point in points for part in (re(point), im(point))] + list(outputs)


def combine(weights, rows, over):
    return [sum(weight * value for weight, value in zip(weights, column)) / over for column in zip(*rows)]


def case(closures, parameters, inputs, guess):
    p = [mpf(x) for x in (parameters.split() if isinstance(parameters, str) else parameters)]
    v, *motion = [[mpf(x) for x in order] for order in zip(*inputs)]
    u = solve(closures, p, v, [mpf(x) for x in guess.split()])

    def at_inputs(steps):
        return everything(closures, p, [x + STEP * step for x, step in zip(v, steps)], u)

    def at_time(step):
        t = STEP * step
        moved = [x + r * t + a * t ** 2 / 2 + j * t ** 3 / 6 for x, r, a, j in zip(v, *motion)]
        return everything(closures, p, moved, u)

    def at_parameter(place, step):
        moved = [x + STEP * step * (index == place) for index, x in enumerate(p)]
        return everything(closures, moved, v, u)

    times = [at_time(step) for step in (-2, -1, 0, 1, 2)]
    rates = combine([-1, 1], [times[1], times[3]], 2 * STEP)
    accelerations = combine([1, -2, 1], times[1:4], STEP ** 2)
    jerks = combine([-1, 2, -2, 1], times[:2] + times[3:], 2 * STEP ** 3)
    places = range(len(v))
    second = []
    for j in places:
        for k in places:
            corners = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
            rows = [at_inputs([a * (i == j) + b * (i == k) for i in places]) for a, b in corners]
            second.append(combine([1, -1, -1, 1], rows, 4 * STEP ** 2))
    by_parameters = [combine([-1, 1], [at_parameter(i, -1), at_parameter(i, 1)], 2 * STEP) for i in range(len(p))]
    return {
        "mechanism": closures.__name__, "parameters": listed(p), "unknowns": listed(u), "inputs": listed(v),
        "input_rates": listed(motion[0]), "input_accelerations": listed(motion[1]), "input_jerks": listed(motion[2]),
        "rates": listed(rates[:len(u)]), "accelerations": listed(accelerations[:len(u)]), "jerks": listed(jerks),
        "by_inputs": [listed(row) for row in second], "by_parameters": [listed(row) for row in by_parameters],
    }


print("[\n" + ",\n".join(json.dumps(case(*one)) for one in CASES) + "\n]")
