//! The balancing masses with the least shaking force.
//!
//! The shaking force is linear in the masses, so that its greatest magnitude over a turn is a convex function of them:
//! golden sections in one mass within those in the other find its minimum.

use linkage::Error;

use crate::loads::Loads;
use crate::machine::Running;

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A scene with these balancing masses.
pub fn balanced(scene: &Running<f64>, [counterweight, balance]: [f64; 2]) -> Running<f64> {
    Running { counterweight, balance, ..scene.clone() }
}

/// The greatest shaking force over a turn.
///
/// # Errors
/// Those of [`Loads::at`].
pub fn shaking(scene: &Running<f64>, count: u32) -> Result<f64, Error> {
    let loads = Loads::turn(scene, count)?;
    Ok(loads.iter().map(|loads| loads.shaking.norm()).fold(0.0, f64::max))
}

/// The place of the minimum of a convex function between 0 and `most`, to a share of 1e-5 of it.
fn minimum(most: f64, mut of: impl FnMut(f64) -> Result<f64, Error>) -> Result<[f64; 2], Error> {
    let [mut low, mut high] = [0.0, most];
    let [mut left, mut right] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut at_left, mut at_right] = [of(left)?, of(right)?];
    while high - low > 1e-5 * most {
        if at_left < at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - GOLDEN * (high - low);
            at_left = of(left)?;
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + GOLDEN * (high - low);
            at_right = of(right)?;
        }
    }
    Ok(if at_left < at_right { [left, at_left] } else { [right, at_right] })
}

/// The counterweight with the least shaking force, without a balance shaft.
///
/// # Errors
/// Those of [`Loads::at`].
pub fn by_counterweight(scene: &Running<f64>, count: u32) -> Result<[f64; 2], Error> {
    let [mass, _] = minimum(2.0, |mass| shaking(&balanced(scene, [mass, 0.0]), count))?;
    Ok([mass, 0.0])
}

/// The counterweight and the mass on the balance shaft with the least shaking force.
///
/// # Errors
/// Those of [`Loads::at`].
pub fn by_both(scene: &Running<f64>, count: u32) -> Result<[f64; 2], Error> {
    let best = |balance: f64| minimum(2.0, |mass| shaking(&balanced(scene, [mass, balance]), count));
    let [balance, _] = minimum(2.0, |balance| Ok(best(balance)?[1]))?;
    Ok([best(balance)?[0], balance])
}
