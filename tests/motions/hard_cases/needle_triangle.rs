//! Needles: W. Kahan, "Miscalculating Area and Angles of a Needle-like Triangle" (2014), table of page 5. Heron's
//! formula sqrt(s (s - a) (s - b) (s - c)) loses all digits of some of them. The triangles are those of the table whose
//! sides are needles in doubles.

use linkage::Elbow;

use super::relative;
use super::triangle::{Triangle, TriangleBranch, TriangleInputs};
use linkage_oracle::precise::{Scalar, big};

/// Sides, and the least relative error of Heron's formula.
const NEEDLES: [([f64; 3], f64); 6] = [
    ([10.0, 10.0, 10.0], 0.0),
    ([100_000.0, 99_999.999_79, 0.000_29], 1e-8),
    ([100_000.0, 100_000.0, 1.000_05], 1e-12),
    ([99_999.999_96, 99_999.999_94, 0.000_03], 1e-7),
    ([99_999.999_96, 0.000_03, 99_999.999_94], 1e-7),
    ([31_622.776_62, 0.000_023, 31_622.776_61], 1e-8),
];

#[test]
fn areas() {
    for (sides, least) in NEEDLES {
        let [a, b, c] = sides.map(big);
        let square = (&a + (&b + &c)) * (&c - (&a - &b)) * (&c + (&a - &b)) * (&a + (&b - &c));
        let expected = square.sqrt() / big(4.0);
        let [a, b, c] = sides;
        let s = (a + b + c) / 2.0;
        let heron = relative((s * (s - a) * (s - b) * (s - c)).sqrt(), &expected);
        assert!(heron >= least, "{sides:?}: Heron {heron:e}");
        // Each side in turn is the one between the joints.
        for [p, q, d] in [[a, b, c], [b, c, a], [c, a, b]] {
            let m = Triangle { p, q };
            let branch = TriangleBranch { alpha_beta: Elbow::Left };
            let pose = m.assemble(TriangleInputs { x: d, y: 0.0 }, branch).unwrap();
            let ours = relative(pose.determinant.abs() / 2.0, &expected);
            println!("{p} {q} {d}: Heron {heron:.1e}, emitted {ours:.1e}");
            assert!(ours <= 4.0 * f64::EPSILON, "{sides:?}: {ours:e}");
        }
        assert!(expected.double() > 0.0);
    }
}

/// Sides that are no triangle give an error. Sides that are flat to one ulp are flat: links of 33.3 and 66.7 are in
/// line over 100. Kahan's formula takes the doubles as exact, and of 5278.64055, 94721.35941 and 99999.99996, which are
/// flat as decimals, finds an area of 9.54.
#[test]
fn no_triangle() {
    let branch = TriangleBranch { alpha_beta: Elbow::Right };
    let none = Triangle { p: 1.0, q: 2.0 }.assemble(TriangleInputs { x: 3.0 + 1e-13, y: 0.0 }, branch);
    assert!(matches!(none, Err(linkage::PositionError::Unbuildable { .. })), "{none:?}");
    for (p, q, d) in
        [(100_002.0, 100_002.0, 200_004.0), (33.3, 66.7, 100.0), (5_278.640_55, 94_721.359_41, 99_999.999_96)]
    {
        let flat = Triangle { p, q }.assemble(TriangleInputs { x: d, y: 0.0 }, branch).unwrap();
        assert_eq!(flat.determinant, 0.0);
    }
    // Off by two ulps, they are no longer flat.
    let nearly = Triangle { p: 33.3, q: 66.7 }.assemble(TriangleInputs { x: 100.0 - 3e-14, y: 0.0 }, branch).unwrap();
    assert!(nearly.determinant != 0.0);
}

/// NaN, zero lengths and coincident joints give errors, for flat triangles too.
#[test]
fn bad_input() {
    let branch = TriangleBranch { alpha_beta: Elbow::Left };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (p, x, y) in [(bad, 3.0, 0.0), (1.0, bad, 0.0), (1.0, 3.0, bad), (bad, bad, bad)] {
            let found = Triangle { p, q: 2.0 }.assemble(TriangleInputs { x, y }, branch);
            assert!(matches!(found, Err(linkage::PositionError::NotFinite { .. })), "{p} {x} {y}: {found:?}");
        }
    }
    for (p, q, x) in [(0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 1.0, 0.0), (0.0, 1.0, 1.0)] {
        let found = Triangle { p, q }.assemble(TriangleInputs { x, y: 0.0 }, branch);
        assert!(found.is_err(), "{p} {q} {x}: {found:?}");
    }
}
