//! Samples: numbers that stay the same, with the moments of their distributions.

use crate::common::{Crank, crank};
use linkage_sweep::{Distribution, Plan, Sequence, Sweep, given};

const UNIFORM: Distribution = Distribution::Uniform { from: 0.0, to: 1.0 };
const NORMAL: Distribution = Distribution::Normal { mean: 0.0, deviation: 1.0 };

/// The numbers of r and l.
fn numbers(distribution: Distribution, sequence: Sequence, count: u64, seed: u64) -> [Vec<f64>; 2] {
    let plan = Plan::new().sample([("r", distribution), ("l", distribution)], count, sequence).constant("theta", 0.0);
    let sweep: Sweep<Crank<f64>> = Sweep::new(&crank(), (), plan.seed(seed)).unwrap();
    let sweep = sweep.with_rows_per_chunk(usize::MAX).unwrap();
    let chunk = sweep.chunk(0, &[given("r"), given("l")]).unwrap();
    let mut columns = chunk.columns().map(|(_, _, values)| values.to_vec());
    [columns.next().unwrap(), columns.next().unwrap()]
}

#[test]
fn numbers_stay_the_same() {
    let [r, l] = numbers(UNIFORM, Sequence::Random, 3, 7);
    assert_eq!(r, [0.764109042047738, 0.4659376151199609, 0.005674514325306634]);
    assert_eq!(l, [0.010922764364190707, 0.1943919988985855, 0.9000449852272792]);
    let [r, l] = numbers(UNIFORM, Sequence::QuasiRandom, 3, 7);
    assert_eq!(r, [0.934366023437627, 0.6892436896843197, 0.44412135593101254]);
    assert_eq!(l, [0.6629217734268726, 0.23276206442492597, 0.8026023554229792]);
    // The logarithm of a tail is that of the machine.
    let [r, _] = numbers(NORMAL, Sequence::Random, 3, 7);
    let expected = [0.7195827826625908, -0.08548574196491614, -2.531764189042577];
    assert!(
        r.iter().zip(expected).all(|(value, expected)| (value / expected - 1.0).abs() < 4.0 * f64::EPSILON),
        "{r:?}"
    );
}

#[test]
fn a_number_depends_on_seed_column_and_point_only() {
    for sequence in [Sequence::Random, Sequence::QuasiRandom] {
        let [r, l] = numbers(UNIFORM, sequence, 1000, 7);
        let [few, _] = numbers(UNIFORM, sequence, 10, 7);
        let [others, _] = numbers(UNIFORM, sequence, 1000, 8);
        assert_eq!(few, r[..10]);
        let equal = |a: &[f64], b: &[f64]| a.iter().zip(b).filter(|(a, b)| a == b).count();
        assert_eq!((equal(&r, &others), equal(&r, &l)), (0, 0));
    }
    // Another factor before or after, and another order of columns.
    let columns = [("l", UNIFORM), ("r", UNIFORM)];
    let plan = Plan::new().grid("e", 0.0, 1.0, 3).sample(columns, 1000, Sequence::Random).turn("theta", 5).seed(7);
    let sweep: Sweep<Crank<f64>> = Sweep::new(&crank(), (), plan).unwrap();
    let [r, l] = numbers(UNIFORM, Sequence::Random, 1000, 7);
    for (row, point) in [(0, 0), (4, 0), (5, 1), (4999, 999), (5000, 0), (12_345, 469)] {
        let numbers = sweep.row(row).unwrap();
        assert_eq!((numbers[0].1, numbers[1].1), (r[point], l[point]), "{row}");
    }
}

/// The mean, and the mean of the squares.
fn moments(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    (values.iter().sum::<f64>() / count, values.iter().map(|value| value * value).sum::<f64>() / count)
}

#[test]
fn random_numbers_have_the_moments_of_their_distribution() {
    let count = 100_000;
    // Five standard deviations of a mean: exceeded once in a million seeds.
    let bound = |variance: f64| 5.0 * (variance / count as f64).sqrt();
    let [r, l] = numbers(UNIFORM, Sequence::Random, count, 1);
    for values in [&r, &l] {
        let (mean, square) = moments(values);
        assert!((mean - 0.5).abs() < bound(1.0 / 12.0), "{mean}");
        assert!((square - 1.0 / 3.0).abs() < bound(1.0 / 5.0 - 1.0 / 9.0), "{square}");
        assert!(values.iter().all(|value| (0.0..1.0).contains(value)));
    }
    // Independent: the mean of the products.
    let product = r.iter().zip(&l).map(|(r, l)| (r - 0.5) * (l - 0.5)).sum::<f64>() / count as f64;
    assert!(product.abs() < bound(1.0 / 144.0), "{product}");
    let [r, _] = numbers(NORMAL, Sequence::Random, count, 1);
    let (mean, square) = moments(&r);
    assert!(mean.abs() < bound(1.0) && (square - 1.0).abs() < bound(2.0), "{mean} {square}");
    // A fraction of 0.0455 is farther than two deviations away.
    let outside = r.iter().filter(|value| value.abs() > 2.0).count() as f64 / count as f64;
    assert!((outside - 0.045_500_263_896_358_4).abs() < bound(0.0455 * 0.9545), "{outside}");
}

#[test]
fn a_distribution_has_its_ends_its_mean_and_its_deviation() {
    let [r, _] = numbers(Distribution::Uniform { from: 3.0, to: -1.0 }, Sequence::Random, 1000, 1);
    let [unit, _] = numbers(UNIFORM, Sequence::Random, 1000, 1);
    assert!(r.iter().zip(&unit).all(|(value, unit)| *value == 3.0 - 4.0 * unit));
    let [r, _] = numbers(Distribution::Normal { mean: 10.0, deviation: 2.0 }, Sequence::Random, 1000, 1);
    let [standard, _] = numbers(NORMAL, Sequence::Random, 1000, 1);
    assert!(r.iter().zip(&standard).all(|(value, standard)| *value == 10.0 + 2.0 * standard));
    let [r, _] = numbers(Distribution::Normal { mean: 10.0, deviation: 0.0 }, Sequence::QuasiRandom, 10, 1);
    assert_eq!(r, [10.0; 10]);
}

#[test]
fn quasi_random_points_integrate_better_than_random_ones() {
    // The integral of r * l over the unit square is a quarter.
    let error = |sequence, seed| {
        let [r, l] = numbers(UNIFORM, sequence, 4096, seed);
        let sum: f64 = r.iter().zip(&l).map(|(r, l)| r * l).sum();
        (sum / 4096.0 - 0.25).powi(2)
    };
    let mean = |sequence| ((0..32).map(|seed| error(sequence, seed)).sum::<f64>() / 32.0).sqrt();
    let (random, quasi) = (mean(Sequence::Random), mean(Sequence::QuasiRandom));
    // Random: the deviation of r * l, sqrt(1 / 9 - 1 / 16), divided by 64.
    assert!((random / (0.2205 / 64.0) - 1.0).abs() < 0.5 && quasi < 0.1 * random, "{random} {quasi}");
}
