//! Where energy and power go.

use num_dual::Dual64;

use super::machines::*;
use super::virtual_work::{agrees, at_random, constant};

/// dE/dt along the motion that a scene gives, by dual numbers, against the power of what drives and brakes.
macro_rules! balance {
    ($scene:expr, $v:expr, $rate:expr, $t:expr, $Inputs:ident { $($input:ident),* }, $Coordinates:ident { $($coordinate:ident),* }) => {{
        let (scene, rates) = ($scene, $rate);
        let (velocity, acceleration) = scene.rates($t, &$v, rates).unwrap();
        let dual = scene.clone().map(constant::<Dual64>);
        let q = $Coordinates { $($coordinate: Dual64::new($v.$coordinate, velocity.$coordinate)),* };
        let moved = $Inputs { $($input: Dual64::new(rates.$input, acceleration.$input)),* };
        let energy = dual.energy(&q, moved).unwrap();
        let (power, now) = (scene.power($t, &$v, rates).unwrap(), scene.energy(&$v, rates).unwrap());
        agrees("kinetic energy", energy.kinetic.re, now.kinetic, 0.0);
        agrees("potential energy", energy.potential.re, now.potential, 0.0);
        let scale = energy.kinetic.eps.abs() + energy.potential.eps.abs() + power.applied.abs() + power.dissipated.abs();
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
        balance!(
            &loaded,
            q,
            rates,
            t,
            LoadedFourBarInputs { theta2 },
            LoadedFourBarCoordinates { theta2, theta3, theta4 }
        );
        balance!(
            &driven,
            q,
            rates,
            t,
            LoadedFourBarInputs { theta2 },
            LoadedFourBarCoordinates { theta2, theta3, theta4 }
        );
        let q = turning.mechanism.assemble(v[0], CrankBranch { psi: linkage::Slope::Rising }).unwrap().coordinates();
        let rates = CrankInputs { phi: rate[0] };
        balance!(&turning, q, rates, t, CrankInputs { phi }, MachineCoordinates { phi, psi, z });
        let rates = PistonInputs { z: rate[0] };
        balance!(&pushed, q, rates, t, PistonInputs { z }, MachineCoordinates { phi, psi, z });
        let Ok(pose) = free.mechanism.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR) else { return };
        let (q, rates) = (pose.coordinates(), PairInputs { theta1: rate[0], theta4: rate[1] });
        balance!(&free, q, rates, t, PairInputs { theta1, theta4 }, PairCoordinates { theta1, theta2, theta3, theta4 });
        balance!(&half, q, rates, t, PairInputs { theta1, theta4 }, PairCoordinates { theta1, theta2, theta3, theta4 });
    });
}
