//! Balance of energy and power.

use linkage::{Build, Mechanism, PerInput};
use num_dual::Dual64;

use super::machines::*;
use super::virtual_work::{agrees, at_random, constant};

/// Coordinates that move at these rates.
fn moving<M, W>(_of: &M, _as: &W, q: &M::Coordinates, rates: &M::Rates) -> W::Coordinates
where
    M: Mechanism<Scalar = f64>,
    W: Mechanism<Scalar = Dual64, U = M::U, V = M::V>,
{
    let ((u, v), (du, dv)) = (M::parts(q), M::rate_parts(rates));
    W::coordinates(
        u.dim().column(|index| Dual64::new(u[index], du[index])),
        v.dim().column(|index| Dual64::new(v[index], dv[index])),
    )
}

/// Rates of the inputs that change at these accelerations.
fn changing<M, W>(_of: &M, _as: &W, rates: M::Inputs, accelerations: M::Inputs) -> W::Inputs
where
    M: Mechanism<Scalar = f64>,
    W: Mechanism<Scalar = Dual64, V = M::V>,
{
    let [rates, accelerations]: [PerInput<M>; 2] = [rates.into(), accelerations.into()];
    rates.dim().column(|index| Dual64::new(rates[index], accelerations[index])).into()
}

/// Compares dE/dt along the motion of a scene, by dual numbers, with the power of what drives and brakes.
macro_rules! balance {
    ($scene:expr, $q:expr, $rates:expr, $t:expr) => {{
        let (scene, q, rates) = (&$scene, $q, $rates);
        let derivative = scene.rates($t, &q, rates).unwrap();
        let dual = scene.clone().map(constant::<Dual64>);
        let position = moving(&scene.mechanism, &dual.mechanism, &q, &derivative.rates);
        let moved = changing(&scene.mechanism, &dual.mechanism, rates, derivative.input_accelerations);
        let energy = dual.energy(&position, moved).unwrap();
        let (power, now) = (scene.power($t, &q, rates).unwrap(), scene.energy(&q, rates).unwrap());
        agrees("kinetic energy", energy.kinetic.re, now.kinetic, 0.0);
        agrees("potential energy", energy.potential.re, now.potential, 0.0);
        let scale =
            energy.kinetic.eps.abs() + energy.potential.eps.abs() + power.applied.abs() + power.dissipated.abs();
        agrees("power", power.applied - power.dissipated, energy.kinetic.eps + energy.potential.eps, scale);
    }};
}

#[test]
fn energy_balances() {
    let (loaded, driven, free, half) = (Loaded::default(), Driven::default(), Free::default(), Half::default());
    let (turning, pushed) = (Turning::default(), Pushed::default());
    at_random(|v: [f64; 2], rate: [f64; 2], t| {
        let q = four_bar_at([v[0]]).unwrap();
        let rates = LoadedFourBarInputs { theta2: rate[0] };
        balance!(loaded, q, rates, t);
        balance!(driven, q, rates, t);
        let q = turning.mechanism.assemble(v[0], CrankBranch { psi_z: linkage::Slider::Far }).unwrap().coordinates();
        let rates = CrankInputs { phi: rate[0] };
        balance!(turning, q, rates, t);
        let rates = PistonInputs { z: rate[0] };
        balance!(pushed, q, rates, t);
        let Ok(pose) = free.mechanism.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR) else { return };
        let (q, rates) = (pose.coordinates(), PairInputs { theta1: rate[0], theta4: rate[1] });
        balance!(free, q, rates, t);
        balance!(half, q, rates, t);
    });
}
