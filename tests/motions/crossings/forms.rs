//! Change points whose tangents are the common zeros of quadratic forms, with directions drawn at random.

use linkage::continuation::Direction;
use linkage::{Mechanism, linkage};
use nalgebra::{SMatrix, SVector, Vector3};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use super::{apart, crossing};

linkage! {
    /// Two quadratic forms of three coordinates.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TwoForms {
        param a = 1, b = 1, c = 1, d = 1, e = 1, f = 1, g = 1, h = 1, i = 1, j = 1, k = 1, l = 1, size = 1, reach = 1;
        input v;
        unknown x, y, z;
        equation size + a * x^2 + b * y^2 + c * z^2 + d * x * y + e * x * z + f * y * z = reach;
        equation size + g * x^2 + h * y^2 + i * z^2 + j * x * y + k * x * z + l * y * z = reach;
        equation z = v;
    }
}

linkage! {
    /// Three quadratic forms of four coordinates.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ThreeForms {
        param a0 = 1, a1 = 1, a2 = 1, a3 = 1, a4 = 1, a5 = 1, a6 = 1, a7 = 1, a8 = 1, a9 = 1,
            b0 = 1, b1 = 1, b2 = 1, b3 = 1, b4 = 1, b5 = 1, b6 = 1, b7 = 1, b8 = 1, b9 = 1,
            c0 = 1, c1 = 1, c2 = 1, c3 = 1, c4 = 1, c5 = 1, c6 = 1, c7 = 1, c8 = 1, c9 = 1, size = 1, reach = 1;
        input v;
        unknown w, x, y, z;
        equation size + a0 * w^2 + a1 * x^2 + a2 * y^2 + a3 * z^2 + a4 * w * x + a5 * w * y + a6 * w * z + a7 * x * y
            + a8 * x * z + a9 * y * z = reach;
        equation size + b0 * w^2 + b1 * x^2 + b2 * y^2 + b3 * z^2 + b4 * w * x + b5 * w * y + b6 * w * z + b7 * x * y
            + b8 * x * z + b9 * y * z = reach;
        equation size + c0 * w^2 + c1 * x^2 + c2 * y^2 + c3 * z^2 + c4 * w * x + c5 * w * y + c6 * w * z + c7 * x * y
            + c8 * x * z + c9 * y * z = reach;
        equation z = v;
    }
}

/// The product of two linear forms of three coordinates, by the coefficients of xx, yy, zz, xy, xz, yz.
fn product(one: &Vector3<f64>, two: &Vector3<f64>) -> SVector<f64, 6> {
    let pair = |i: usize, j: usize| one[i] * two[j] + one[j] * two[i];
    SVector::from([one[0] * two[0], one[1] * two[1], one[2] * two[2], pair(0, 1), pair(0, 2), pair(1, 2)])
}

fn random_direction<const N: usize>(random: &mut SmallRng) -> SVector<f64, N> {
    loop {
        let direction = SVector::<f64, N>::from_fn(|_, _| random.random_range(-1.0..1.0));
        // Not across the input, and not so that the coordinates differ in size.
        if direction.amin() > 0.1 {
            return direction.normalize();
        }
    }
}

/// Two forms that vanish on four directions drawn at random: the tangents are these. No given combination of the two
/// is a product, so that the degenerate ones must be found.
#[test]
fn two_forms_through_four_directions() {
    let random = &mut SmallRng::seed_from_u64(5);
    let (mut count, mut worst) = (0, 0.0_f64);
    while count < 200 {
        let p: [Vector3<f64>; 4] = std::array::from_fn(|_| random_direction(random));
        let volumes = [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)].map(|(i, j, k)| p[i].cross(&p[j]).dot(&p[k]).abs());
        if volumes.iter().any(|&volume| volume < 0.1) {
            continue;
        }
        let line = |i: usize, j: usize| p[i].cross(&p[j]).normalize();
        let (one, two) = (product(&line(0, 1), &line(2, 3)), product(&line(0, 2), &line(1, 3)));
        let mix = random.random_range(0.2..1.0);
        let (first, second) = (one + two * mix, two - one * mix);
        let coefficients: [f64; 12] = std::array::from_fn(|k| if k < 6 { first[k] } else { second[k - 6] });
        let [a, b, c, d, e, f, g, h, i, j, k, l] = coefficients;
        let m = TwoForms { a, b, c, d, e, f, g, h, i, j, k, l, size: 1.0, reach: 1.0 };
        let at = |p: &Vector3<f64>| TwoFormsCoordinates { x: p[0], y: p[1], z: p[2], v: p[2] };
        let along = |p: &Vector3<f64>| TwoFormsRates { x: p[0], y: p[1], z: p[2], v: p[2] };
        let direction = if p[0][2] < 0.0 { Direction::Increasing } else { Direction::Decreasing };
        let (q, _, tangents) = crossing(&m, &at(&(p[0] * 0.3)), direction);
        assert!([q.x, q.y, q.z, q.v].iter().all(|place| place.abs() < 1e-12), "{q:?}");
        assert!(tangents.is_complete() && tangents.len() == 4, "{m:?} {tangents:?}");
        for p in &p {
            let off =
                tangents.iter().map(|tangent| apart::<TwoForms>(tangent, &along(p))).fold(f64::INFINITY, f64::min);
            worst = worst.max(off);
            assert!(off < 1e-9, "{off:e}");
        }
        assert!(apart::<TwoForms>(&tangents[0], &along(&p[0])) < 1e-9);
        count += 1;
    }
    println!("{count} crossings, tangents off by {worst:.1e}");
}

/// Three forms that vanish on eight directions, seven of them drawn: no combination is a product. The report has the
/// tangent that is followed, and says that there are more.
#[test]
fn three_forms_through_eight_directions() {
    let random = &mut SmallRng::seed_from_u64(6);
    let mut count = 0;
    while count < 50 {
        let p: [SVector<f64, 4>; 7] = std::array::from_fn(|_| random_direction(random));
        let pairs = [(0, 0), (1, 1), (2, 2), (3, 3), (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
        let conditions = SMatrix::<f64, 10, 10>::from_fn(|row, column| {
            let (i, j) = pairs[column];
            p.get(row).map_or(0.0, |p| p[i] * p[j])
        });
        let svd = conditions.svd(false, true);
        let Some(forms) = svd.v_t.filter(|_| svd.singular_values[6] > 0.02) else { continue };
        let mix = SMatrix::<f64, 3, 3>::from_fn(|_, _| random.random_range(-1.0..1.0));
        if mix.determinant().abs() < 0.2 {
            continue;
        }
        let forms = mix * forms.fixed_rows::<3>(7);
        let m = ThreeForms::from(std::array::from_fn(|k| if k < 30 { forms[(k / 10, k % 10)] } else { 1.0 }));
        let at = |p: &SVector<f64, 4>| ThreeFormsCoordinates { w: p[0], x: p[1], y: p[2], z: p[3], v: p[3] };
        let Ok(start) = m.solve(&at(&(p[0] * 0.3))) else { continue };
        let direction = if p[0][3] < 0.0 { Direction::Increasing } else { Direction::Decreasing };
        let (q, _, tangents) = crossing(&m, &start.coordinates, direction);
        let along = ThreeFormsRates { w: p[0][0], x: p[0][1], y: p[0][2], z: p[0][3], v: p[0][3] };
        assert!(ThreeForms::unknowns(&q).largest() < 1e-12, "{q:?}");
        assert!(!tangents.is_complete());
        assert!(apart::<ThreeForms>(&tangents[0], &along) < 1e-9);
        count += 1;
    }
}
