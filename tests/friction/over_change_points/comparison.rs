//! The comparison of motions with references.

use linkage::MotionError;
use rand::SeedableRng;
use rand::rngs::SmallRng;

/// The tolerances.
pub const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-9, 1e-12];

/// The largest error, divided by the change of the reference when its start is moved by the tolerance, or by a thirtieth
/// of the change when it is moved by thirty tolerances.
const MOST: f64 = 1000.0;

/// The result of one motion: coordinates at its end and numbers of events, or the error that ended it.
pub type Outcome = Result<(Vec<f64>, usize), MotionError>;

/// A motion with its reference.
pub struct Case {
    /// The motion at a tolerance.
    pub motion: Box<dyn Fn(f64) -> Outcome>,
    /// The reference with its start moved by these fractions of the scales of position and rate.
    pub reference: Box<dyn Fn(f64, f64) -> Vec<f64>>,
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

/// Draws so many cases in the outer ring, or `STARTS`, and compares them at each tolerance; at most `errors` of a thousand may
/// end in a typed error.
pub fn compare(name: &str, all: usize, errors: usize, mut draw: impl FnMut(&mut SmallRng) -> Case) {
    let count = linkage_trials::count("STARTS", all.div_ceil(4), all);
    for tolerance in TOLERANCES {
        let random = &mut SmallRng::seed_from_u64(73);
        let (mut ratios, mut failures, mut passed) = (Vec::new(), Vec::new(), 0);
        for number in 0..count {
            let Case { motion, reference } = draw(random);
            let right = reference(0.0, 0.0);
            let moves = [(tolerance, 0.0), (-tolerance, 0.0), (0.0, tolerance), (0.0, -tolerance)];
            let change = moves
                .iter()
                .fold(tolerance, |most: f64, &(position, rate)| most.max(distance(&reference(position, rate), &right)));
            match motion(tolerance) {
                Ok((found, passages)) => {
                    passed += passages;
                    ratios.push((distance(&found, &right) / change, number));
                }
                Err(error) => failures.push((number, error)),
            }
        }
        ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (most, at) = ratios.last().copied().unwrap_or_default();
        let median = ratios.get(ratios.len() / 2).map_or(0.0, |ratio| ratio.0);
        println!(
            "{name} at {tolerance:e}: {count} motions, {passed} passages, {} errors; error / change: median {median:.1e}, \
             most {most:.1e} in {at}",
            failures.len()
        );
        for (number, error) in failures.iter().take(3) {
            println!("  {number}: {error}");
        }
        assert!(most <= MOST, "{name} at {tolerance:e}: {most:e} in {at}");
        assert!(1000 * failures.len() <= errors * count, "{name} at {tolerance:e}: {failures:?}");
    }
}
