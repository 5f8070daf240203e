"""Functions of numbers of 106 bits in 60-digit arithmetic: name, arguments and value, each the sum of doubles.

    python3 linkage-double/tests/functions.py > linkage-double/tests/functions.txt
"""

import random

from mpmath import (acos, acosh, asin, asinh, atan2, atanh, cbrt, cos, cosh, exp, expm1, hypot, ln, log1p, mp, mpf, pi,
                    sin, sinh, sqrt, tan, tanh)

mp.dps = 60
random.seed(31)


def parts(x, count):
    doubles = []
    for _ in range(count):
        doubles.append(float(x))
        x -= mpf(doubles[-1])
    return doubles


def evenly(low, high):
    return lambda: mpf(random.uniform(low, high)) + mpf(random.uniform(-1, 1)) * mpf(2) ** -56


def sized(low, high, signs=(-1, 1)):
    return lambda: mpf(random.choice(signs)) * mpf(10) ** mpf(random.uniform(low, high))


def near_quarters():
    return random.randint(-40, 40) * pi / 2 + mpf(10) ** mpf(random.uniform(-12, -3))


CASES = [
    ("sqrt", sqrt, [sized(-200, 200, (1,))]), ("cbrt", cbrt, [sized(-200, 200, (1,))]),
    ("sin", sin, [evenly(-7, 7)]), ("cos", cos, [evenly(-7, 7)]), ("tan", tan, [evenly(-7, 7)]),
    ("sin", sin, [near_quarters]), ("cos", cos, [near_quarters]), ("sin", sin, [sized(-30, -1)]),
    ("sin", sin, [evenly(-1e5, 1e5)]), ("cos", cos, [evenly(-1e5, 1e5)]),
    ("asin", asin, [evenly(-1, 1)]), ("acos", acos, [evenly(-1, 1)]),
    ("atan2", atan2, [evenly(-3, 3), evenly(-3, 3)]), ("atan2", atan2, [sized(-100, 100), sized(-100, 100)]),
    ("hypot", hypot, [sized(-3, 3), sized(-3, 3)]), ("hypot", hypot, [sized(199, 201), sized(199, 201)]),
    ("exp", exp, [evenly(-20, 20)]), ("exp_m1", expm1, [sized(-20, 1)]),
    ("ln", ln, [sized(-50, 50, (1,))]), ("ln", ln, [evenly(0.5, 2)]), ("ln_1p", log1p, [sized(-20, -1)]),
    ("sinh", sinh, [sized(-9, 1)]), ("cosh", cosh, [sized(-9, 1)]), ("tanh", tanh, [sized(-9, 1)]),
    ("asinh", asinh, [sized(-9, 9)]), ("acosh", acosh, [sized(0, 3, (1,))]), ("atanh", atanh, [evenly(-0.99, 0.99)]),
    ("add", lambda x, y: x + y, [evenly(-9, 9), evenly(-9, 9)]), ("mul", lambda x, y: x * y, [evenly(-9, 9)] * 2),
    ("div", lambda x, y: x / y, [evenly(-9, 9)] * 2), ("powf", lambda x, y: x ** y, [evenly(1, 9), evenly(-4, 4)]),
]

for name, function, arguments in CASES:
    for _ in range(12):
        given = [parts(make(), 2) for make in arguments]
        value = function(*[mpf(high) + mpf(low) for high, low in given])
        print(name, *[repr(part) for pair in given for part in pair], *[repr(part) for part in parts(value, 3)])
