//! The limits of self-locking.

use linkage::simulation::{Start, simulate};
use linkage::{Error, Mode, Slider};

use crate::machine::{Closed, Released, ToggleBranch, ToggleCoordinates, Wedge, WedgeCoordinates};

/// The branch of the toggle: the jaw is beyond the knee.
pub const BRANCH: ToggleBranch = ToggleBranch { psi_s: Slider::Far };

/// A wedge of this angle, and its position.
///
/// # Errors
/// If it cannot be assembled.
pub fn wedge(alpha: f64) -> Result<(Released<f64>, WedgeCoordinates<f64>), Error> {
    let scene = Released { mechanism: Wedge { alpha, ..Wedge::default() }, ..Released::default() };
    let q = WedgeCoordinates { x: 0.5, y: 0.2 * alpha.tan(), s: 0.2 / alpha.cos() };
    let y = scene.start_at(&q)?;
    Ok((scene, y))
}

impl Released<f64> {
    fn start_at(&self, q: &WedgeCoordinates<f64>) -> Result<WedgeCoordinates<f64>, Error> {
        let simulation = simulate(self, Start { t: 0.0, q: *q, input_rates: 0.0 }, 1.0, 1e-9)?;
        Ok(simulation.state().q)
    }
}

/// The way of the wedge in this time after its release.
///
/// # Errors
/// Those of the simulation.
pub fn way(alpha: f64, time: f64) -> Result<f64, Error> {
    let (scene, q) = wedge(alpha)?;
    let mut simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, time, 1e-9)?;
    simulation.finish(|_, _| true)?;
    Ok((simulation.state().q.x - q.x).abs())
}

/// The toggle with this angle of its lever.
///
/// # Errors
/// If it cannot be assembled.
pub fn toggle(theta: f64) -> Result<(Closed<f64>, ToggleCoordinates<f64>), Error> {
    let scene = Closed::default();
    let q = scene.mechanism.assemble(theta, BRANCH)?.coordinates();
    Ok((scene, q))
}

/// True if the toggle stays at this angle with this torque of the hand.
///
/// # Errors
/// Those of the simulation.
pub fn stays(theta: f64, hand: f64) -> Result<bool, Error> {
    let (scene, q) = toggle(theta)?;
    let scene = Closed { hand, ..scene };
    let simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 1.0, 1e-9)?;
    Ok(simulation.state().contacts.iter().all(|contact| contact.mode == Mode::Stick))
}

/// The torque of the hand without friction, and the torques below which the toggle closes and above which it opens.
///
/// # Errors
/// Those of the simulation.
pub fn torques(theta: f64) -> Result<[f64; 3], Error> {
    let (scene, q) = toggle(theta)?;
    let smooth = Closed { mu: 0.0, ..scene };
    // Without friction the torque that holds the position.
    let [push] = smooth.forces(0.0, &q, 0.0)?.data.0[0];
    let free = -push;
    let ends = [-1.0, 1.0].map(|sign| -> Result<f64, Error> {
        let [mut low, mut high] = [0.0, 1.0];
        while stays(theta, free + sign * high)? {
            high *= 2.0;
        }
        for _ in 0..40 {
            let middle = (low + high) / 2.0;
            if stays(theta, free + sign * middle)? { low = middle } else { high = middle }
        }
        Ok(free + sign * (low + high) / 2.0)
    });
    let [less, more] = ends;
    Ok([free, less?, more?])
}
