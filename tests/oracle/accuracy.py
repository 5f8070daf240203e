"""Position, velocity ratios and accelerations (input rate 1, no input acceleration) in 120-digit arithmetic, at benign
poses and near singular ones; each number as the sum of three doubles.

Nothing is differentiated by formula: the closures, written here by hand as complex numbers, are differentiated by
differences whose errors are below 1e-45. Inputs and angles are doubles, exactly those that a program is given.

"inputs": an input, the position there, and a position before it. "angles": any angles, closed or not, and what the
formulas give there. "turn": evenly over a turn of the crank; "range": denser towards the dead points at its ends,
which are listed. Near singular, sin of the angle between the first two links of the four-bar's and the leg's first
dyad is 1e-3, 1e-6 and 1e-9; of the butterfly, whose crank turns all the way, |det J| beside the product of the sizes of
its columns.

    python3 tests/oracle/accuracy.py > tests/oracle/accuracy.json
"""

import json
import random

from mpmath import acos, arg, asin, cos, findroot, im, lu_solve, matrix, mp, mpc, mpf, norm, pi, re, sin
from mpmath import det as determinant

mp.dps = 120
random.seed(4)


def at(modulus, angle):
    return modulus * mpc(cos(angle), sin(angle))


def split(*loops):
    return [part for loop in loops for part in (re(loop), im(loop))]


def four_bar(p, u, v):
    l1, l2, l3, l4 = p
    return split(at(l2, v) + at(l3, u[0]) + at(l4, u[1]) - l1)


def jansen(p, u, v):
    a, b, c, d, e, f, g, h, i, j, k, l, m = p
    to_b, to_j, to_d, to_e, to_c, to_k, to_f, to_g, to_h, to_i = u
    pivot, pin = mpc(-a, -l), at(m, v)
    return split(pin + at(j, to_j) - pivot - at(b, to_b), at(b, to_b) + at(e, to_e) - at(d, to_d),
                 pin + at(k, to_k) - pivot - at(c, to_c), at(d, to_d) + at(f, to_f) - at(c, to_c) - at(g, to_g),
                 at(g, to_g) + at(h, to_h) - at(i, to_i))


def double_butterfly(p, u, v):
    ab, ac, dx, dy, ce, ef, gx, gy, bf, jx, jy, dh, ix, iy, gh, ij = p
    coupler, upper, rocker, lower, link, strut = u
    c, d, b = at(ac, v), at(mpc(dx, dy), v), mpc(ab)
    e = c + at(ce, coupler)
    return split(e + at(ef, upper) - b - at(bf, rocker),
                 e + at(mpc(gx, gy), upper) - d - at(dh, lower) - at(gh, link),
                 d + at(mpc(ix, iy), lower) + at(ij, strut) - b - at(mpc(jx, jy), rocker))


def jacobian(closures, p, u, v):
    tiny = mpf(10) ** -55
    rows = closures(p, u, v)
    moved = [closures(p, [x + tiny * (i == place) for i, x in enumerate(u)], v) for place in range(len(u))]
    by_input = closures(p, u, v + tiny)
    columns = [[(new - old) / tiny for new, old in zip(column, rows)] for column in moved + [by_input]]
    return matrix(rows), matrix(columns[:-1]).T, matrix(columns[-1])


def solve(closures, p, u, v):
    for _ in range(60):
        rows, j, _ = jacobian(closures, p, u, v)
        step = lu_solve(j, rows)
        u = [x - dx for x, dx in zip(u, step)]
        if max(abs(dx) for dx in step) < mpf(10) ** -75:
            return u
    raise ArithmeticError(closures.__name__)


def motion(closures, p, u, v):
    _, j, a = jacobian(closures, p, u, v)
    rates = list(lu_solve(j, -a))
    t = mpf(10) ** -28
    rows = [closures(p, [x + s * t * r for x, r in zip(u, rates)], v + s * t) for s in (-1, 0, 1)]
    gamma = matrix([(low - 2 * middle + high) / t ** 2 for low, middle, high in zip(*rows)])
    return rates, list(lu_solve(j, -gamma))


def parts(x):
    doubles = []
    for _ in range(3):
        doubles.append(float(x))
        x = x - mpf(doubles[-1])
    return doubles


def listed(values):
    return [parts(x) for x in values]


def follow(closures, p, u, v, end, steps):
    for step in range(1, steps + 1):
        u = solve(closures, p, u, v + (end - v) * step / steps)
    return u


def from_input(closures, p, u, before, v):
    """`u` is near the position at `before`, which is near `v`."""
    before, v = mpf(float(before)), mpf(float(v))
    u_before = solve(closures, p, u, before)
    u = solve(closures, p, u_before, v)
    rates, accelerations = motion(closures, p, u, v)
    return {"parameters": [float(x) for x in p], "before": float(before), "near": [float(x) for x in u_before],
            "input": float(v), "position": listed(u), "velocity": listed(rates), "acceleration": listed(accelerations)}


def at_angles(closures, p, u, v):
    u, v = [mpf(float(x)) for x in u], mpf(float(v))
    rates, accelerations = motion(closures, p, u, v)
    return {"parameters": [float(x) for x in p], "input": float(v), "unknowns": [float(x) for x in u],
            "velocity": listed(rates), "acceleration": listed(accelerations)}


def numbers(text):
    return [mpf(float(x)) for x in text.split()]


MECHANISMS = {
    four_bar: (numbers("80 20 50 70"), "1.2 -0.9", "0.35", (0, 1)),
    jansen: (numbers("38 41.5 39.3 40.1 55.8 39.4 36.7 65.7 49 50 61.9 7.8 15"),
             "1.23 2.47 2.73 -2.71 -1.29 -2.32 -1.17 2.65 -1.32 -1.91", "0.125", (0, 1)),
    double_butterfly: (numbers("6 1 0.2 -1 6 3.5 5 -3 4 0.4 1.5 2 2 -4 3.5 3.5"),
                       "1 -0.595 1.408 0.508 -0.004 1.591", "1.036", None),
}


def dyad(to, first, second, side):
    """The angles of first@a + second@b = to."""
    angle = side * acos((abs(to) ** 2 + first ** 2 - second ** 2) / (2 * first * abs(to)))
    a = arg(to) + angle
    return a, arg(to - at(first, a))


def assemble_four_bar(p, v):
    l1, l2, l3, l4 = p
    return list(dyad(l1 - at(l2, v), l3, l4, 1))


def assemble_jansen(p, v):
    a, b, c, d, e, f, g, h, i, j, k, l, m = p
    arm = at(m, v) - mpc(-a, -l)
    to_b, to_j = dyad(arm, b, j, 1)
    to_d, to_e = dyad(at(b, to_b), d, e, 1)
    to_c, to_k = dyad(arm, c, k, -1)
    to_g, to_f = dyad(at(d, to_d) - at(c, to_c), g, f, 1)
    to_i, to_h = dyad(at(g, to_g), i, h, 1)
    # Links that close a triangle point the other way.
    return [to_b, to_j - pi, to_d, to_e - pi, to_c, to_k - pi, to_f - pi, to_g, to_h - pi, to_i]


# Their first dyad is folded or stretched where the input is 0.
FOLDED = {
    four_bar: (numbers("80 20 50 110"), assemble_four_bar),
    jansen: (numbers("38 41.5 39.3 40.1 55.8 45 36.7 65.7 49 11.5 61.9 0 15"), assemble_jansen),
}
SINES = ["1e-3", "1e-6", "1e-9"]
DEGREE = pi / 180


def benign(closures, count):
    p, guess, v, _ = MECHANISMS[closures]
    v, u = mpf(v), [mpf(x) for x in guess.split()]
    cases = []
    for _ in range(count):
        u = follow(closures, p, solve(closures, p, u, v), v, v + 2 * pi / count - DEGREE, 6)
        v += 2 * pi / count - DEGREE
        cases.append(from_input(closures, p, u, v, v + DEGREE))
        v += DEGREE
    return cases


def folded(closures, sine):
    """Twice as far from the dead point, then there; on both sides of it."""
    p, assemble = FOLDED[closures]
    cases = []
    for side in (1, -1):
        v = mpf("1e-3") * side
        u = assemble(p, v)
        # The sine is proportional to the input.
        while abs(sin(u[0] - u[1])) > 4 * sine:
            v /= 2
            u = assemble(p, v)
        for share in ("1", "1.1", "1.3"):
            there = v * sine * mpf(share) / abs(sin(u[0] - u[1]))
            cases.append(from_input(closures, p, assemble(p, 2 * there), 2 * there, there))
    return cases


def near_singular(closures, sine, count):
    p, guess, v, pair = MECHANISMS[closures]
    cases = []
    while len(cases) < count:
        u = [mpf(x) + mpf(random.uniform(-0.5, 0.5)) for x in guess.split()]
        v_here = mpf(random.uniform(-3, 3))
        if pair:
            first, second = pair
            u[first] = mpf(float(u[second])) + asin(sine * random.choice([-1, 1]) * mpf(random.uniform(1, 1.3)))
        else:
            def regular(angle):
                j = jacobian(closures, p, u[:2] + [angle] + u[3:], v_here)[1]
                return determinant(j) / mp.fprod(norm(j[:, i]) for i in range(6))
            try:
                root = findroot(regular, (u[2], u[2] + mpf("0.01")), tol=mpf(10) ** -60, maxsteps=40)
            except (ValueError, ZeroDivisionError):
                continue
            slope = (regular(root + mpf(10) ** -20) - regular(root)) * mpf(10) ** 20
            u[2] = root + sine / slope
        cases.append(at_angles(closures, p, u, v_here))
    return cases


def given_angles(case):
    """The same formulas at the nearest doubles of a closed position."""
    closures, case = case
    u = [sum(mpf(part) for part in parts) for parts in case["position"]]
    return at_angles(closures, [mpf(x) for x in case["parameters"]], u, mpf(case["input"]))


def over_a_turn(closures, count):
    p, guess, v, _ = MECHANISMS[closures]
    v, u = mpf(v), [mpf(x) for x in guess.split()]
    cases = []
    for place in range(count):
        there = 2 * pi * place / (count - 1)
        before = there - DEGREE
        u, v = follow(closures, p, u, v, before, max(2, int(abs(before - v) * 10))), before
        cases.append(from_input(closures, p, u, before, there))
    return cases


# A rocker drives the four-bar between the positions where coupler and crank are in line; the butterfly is on a branch
# whose crank does not turn. With each, the position in the middle, and positions near the dead points.
RANGES = {
    four_bar: (numbers("80 70 50 20"), "-0.645 -2.406 0.67", ("-1.03 2.13 0.3804", "-0.95 -0.99 0.9624")),
    double_butterfly: (MECHANISMS[double_butterfly][0], "-0.21163 -2.40725 -2.01856 1.54648 -1.31196 -0.57797 0",
                       ("0.023487 -2.37031 -2.182203 1.028434 -1.445191 -0.122147 -1.353964",
                        "0.076544 -2.364323 -2.299399 0.968955 -1.556556 -0.182221 4.560977")),
}


def dead_point(closures, p, near):
    """The input at which J is singular."""
    def singular(*q):
        rows, j, _ = jacobian(closures, p, list(q[:-1]), q[-1])
        return list(rows) + [determinant(j)]
    return findroot(singular, near, tol=mpf(10) ** -60, maxsteps=100)[len(near) - 1]


def between_dead_points(closures, count):
    p, middle, ends = RANGES[closures]
    low, high = [dead_point(closures, p, numbers(end)) for end in ends]
    places = [(low + high - (high - low) * cos(pi * (place + mpf("0.5")) / count)) / 2 for place in range(count)]
    *start, input = numbers(middle)
    cases = []
    for side in (-1, 1):
        u, v = solve(closures, p, start, input), input
        for there in sorted((place for place in places if side * (place - input) >= 0), key=lambda place: side * place):
            # A degree nearer to the middle.
            before = there - side * DEGREE
            u, v = follow(closures, p, u, v, before, 6), before
            cases.append(from_input(closures, p, u, before, there))
    return [float(low), float(high)], sorted(cases, key=lambda case: case["input"])


rows = []
for closures, count in ((four_bar, 24), (jansen, 12), (double_butterfly, 12)):
    name = closures.__name__
    cases = benign(closures, count)
    rows.append({"mechanism": name, "pose": "benign", "given": "input", "cases": cases})
    angles = [given_angles((closures, case)) for case in cases]
    rows.append({"mechanism": name, "pose": "benign", "given": "angles", "cases": angles})
    for sine in SINES:
        if closures in FOLDED:
            rows.append({"mechanism": name, "pose": sine, "given": "input", "cases": folded(closures, mpf(sine))})
        cases = near_singular(closures, mpf(sine), 6)
        rows.append({"mechanism": name, "pose": sine, "given": "angles", "cases": cases})
    rows.append({"mechanism": name, "pose": "turn", "given": "input", "dead": [], "cases": over_a_turn(closures, 37)})
    if closures in RANGES:
        dead, cases = between_dead_points(closures, 36)
        rows.append({"mechanism": name, "pose": "range", "given": "input", "dead": dead, "cases": cases})
print("[\n" + ",\n".join(json.dumps(row) for row in rows) + "\n]")
