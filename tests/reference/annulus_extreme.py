"""Makes annulus_extreme.csv: roots of the Kirchhoff annulus where double precision fails.

The deflection w = (A J_n + B Y_n + C I_n + D K_n)(k r) cos(n theta) solves
D lap lap w = rho h omega^2 w, k^4 = rho h omega^2 / D. Two conditions at each edge give a
4 x 4 determinant whose roots are k b; lambda2 = (k b)^2 = omega b^2 sqrt(rho h / D).
A free edge has no moment and no Kirchhoff shear, a clamped one no deflection and no slope.

    python3 tests/reference/annulus_extreme.py > tests/reference/annulus_extreme.csv

needs mpmath (made with 1.4.1). Fifty digits are carried: at a/b = 0.995 the determinant
loses about twenty.
"""

from mpmath import mp, mpf, besselj, bessely, besseli, besselk, matrix, det, findroot, sqrt

mp.dps = 50


def rows(kind, order, k, r, nu):
    """The two conditions at radius r, for J, Y, I and K."""
    n, x = order, k * r

    def derivative(function, sign):
        # f' from the recurrences of the four functions.
        if function in ("J", "Y"):
            f = besselj if function == "J" else bessely
            return f(n, x), (f(n - 1, x) - f(n + 1, x)) / 2, -1
        if function == "I":
            return besseli(n, x), (besseli(n - 1, x) + besseli(n + 1, x)) / 2, 1
        return besselk(n, x), -(besselk(n - 1, x) + besselk(n + 1, x)) / 2, 1

    first, second = [], []
    for name in ("J", "Y", "I", "K"):
        w, slope, laplacian_sign = derivative(name, n)
        # In units of k: lap w = laplacian_sign * w, its slope likewise.
        if kind == "C":
            first.append(w)
            second.append(slope)
            continue
        # M_r = lap w - (1 - nu) (w' / x - n^2 w / x^2)
        first.append(laplacian_sign * w - (1 - nu) * (slope / x - n**2 * w / x**2))
        # V_r = (lap w)' + (1 - nu) (-n^2) (w' / x^2 - w / x^3)
        second.append(laplacian_sign * slope - (1 - nu) * n**2 * (slope / x**2 - w / x**3))
    return first, second


def determinant(bc, nu, ratio, n, kb):
    inner = rows("F" if bc[0] == "F" else "C", n, kb, ratio, nu)
    outer = rows("F", n, kb, mpf(1), nu)
    m = matrix([list(inner[0]), list(inner[1]), list(outer[0]), list(outer[1])])
    # Columns of one size: the functions grow and fall like exponentials.
    for column in range(4):
        largest = max(abs(m[i, column]) for i in range(4))
        for i in range(4):
            m[i, column] /= largest
    return det(m)


def lowest_root(bc, nu, ratio, n, near, step):
    """First sign change of the determinant from `near` upwards, then refined."""
    f = lambda kb: determinant(bc, nu, ratio, n, kb)
    low, value = mpf(near), f(mpf(near))
    while True:
        high = low + mpf(step)
        after = f(high)
        if value * after < 0:
            return findroot(f, (low, high), solver="anderson", tol=mpf(10) ** -60, verify=False)
        low, value = high, after


# bc, nu, a/b, n, start of the search in k b, step: well below the lowest elastic root, and small in
# comparison with the distance of roots.
CASES = []
# A ring of width 0.005 turns over (n = 0) or bends like a wire: kb = 25.7, 1.63, 2.71, 3.75.
for n, near in ((0, "24"), (2, "1.4"), (3, "2.4"), (4, "3.4")):
    CASES.append(("FF", "0.3", "0.995", n, near, "0.1"))
# Clamped it is a strip of length 0.005: kb = 1.875 / 0.005 = 375.
for n in (0, 2, 3, 4):
    CASES.append(("CF", "0.3", "0.995", n, "360", "4"))
for n, near in ((0, "1.3"), (2, "1.5"), (3, "2.0"), (4, "3.0")):
    for bc in ("FF", "CF"):
        CASES.append((bc, "0.3", "0.001", n, near, "0.1"))
        for nu in ("-0.99", "0", "0.4999"):
            CASES.append((bc, nu, "0.3", n, "0.2", "0.1"))
for n in (8, 16, 24, 32, 48, 64):
    CASES.append(("FF", "0.3", "0.3", n, str(0.9 * n), "0.2"))

if __name__ == "__main__":
    print("# made by annulus_extreme.py; lowest elastic root; columns as in annulus_exact.csv")
    print("bc,nu,ratio,n,s,lambda2")
    for bc, nu, ratio, n, near, step in CASES:
        kb = lowest_root(bc, mpf(nu), mpf(ratio), n, near, step)
        print(f"{bc},{nu},{ratio},{n},0,{mp.nstr(kb**2, 17)}", flush=True)
