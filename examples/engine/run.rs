//! Simulates the engine and its energy balance.

use linkage::Error;
use linkage::integrate::Crossing;
use linkage::simulation::{Start, State, Then, simulate};

use super::machine::{EngineInputs, KINKS, Running, START};
use crate::quadrature::nodes;

pub type Moment = State<Running>;

/// The relative tolerance of a step.
const TOLERANCE: f64 = 1e-13;

/// The energy balance since the start, in joules.
#[derive(Debug, Clone, Copy, Default)]
pub struct Account {
    pub t: f64,
    /// The gain of kinetic and potential energy.
    pub gained: f64,
    /// The work of the gas.
    pub applied: f64,
    /// The heat of rings and brake.
    pub dissipated: f64,
}

impl Account {
    /// The error of the balance.
    pub fn gap(&self) -> f64 {
        self.gained - (self.applied - self.dissipated)
    }
}

/// A simulation that starts at a firing.
pub struct Run {
    pub scene: Running<f64>,
    /// The states in order, several in each step.
    pub moments: Vec<Moment>,
    /// The balance at the end of each step, by Gauss quadrature of the power.
    pub accounts: Vec<Account>,
}

impl Run {
    /// Simulates from this speed until `end` or until the crank is at `angle`.
    ///
    /// # Errors
    /// Those of the simulation.
    pub fn new(scene: Running<f64>, speed: f64, (end, angle): (f64, f64)) -> Result<Self, Error> {
        // Steps end at the kinks of the laws: sin((phi - kink) / 2) rises through zero once a cycle.
        let kinks = KINKS.map(f64::to_radians);
        let mut motion = simulate(&scene, Start { t: 0.0, q: START, input_rates: speed }, end, TOLERANCE)?.events(
            [Crossing::Rising; KINKS.len() + 1],
            |state: &Moment| {
                let mut values = [state.q.phi - angle; KINKS.len() + 1];
                for (value, kink) in values.iter_mut().zip(kinks) {
                    *value = ((state.q.phi - kink) / 2.0).sin();
                }
                Ok(values)
            },
            |event, state| {
                let rates = EngineInputs { phi: state.rates.phi };
                Ok(if event < KINKS.len() { Then::Restart(rates) } else { Then::Stop })
            },
        )?;
        let energy = |state: &Moment| -> Result<f64, Error> {
            let energy = scene.energy(&state.q, state.rates.phi)?;
            Ok(energy.kinetic + energy.potential)
        };
        let mut last = *motion.state();
        let start = energy(&last)?;
        let mut account = Account::default();
        let (mut moments, mut accounts) = (vec![last], vec![account]);
        while let Some(state) = motion.advance()? {
            if state.t == last.t {
                continue;
            }
            let nodes = nodes([last.t, state.t]);
            for (state, [_, weight]) in motion.at(nodes.map(|[t, _]| t)).zip(nodes) {
                let state = state?;
                let power = scene.power(state.t, &state.q, state.rates.phi)?;
                account.applied += weight * power.applied;
                account.dissipated += weight * power.dissipated;
                moments.push(state);
            }
            moments.push(state);
            (account.t, account.gained) = (state.t, energy(&state)? - start);
            accounts.push(account);
            last = state;
        }
        Ok(Self { scene, moments, accounts })
    }

    /// The ends of the steps, among them the reversals of the rings.
    pub fn ends(&self) -> impl Iterator<Item = &Moment> {
        self.moments.iter().step_by(9)
    }

    /// The time integral of a quantity over the whole run, by the same quadrature.
    ///
    /// # Errors
    /// Those of the quantity.
    pub fn integral(&self, mut quantity: impl FnMut(&Moment) -> Result<f64, Error>) -> Result<f64, Error> {
        let mut sum = 0.0;
        for (step, ends) in self.moments[1..].chunks(9).zip(self.accounts.windows(2)) {
            for (state, [_, weight]) in step.iter().zip(nodes([ends[0].t, ends[1].t])) {
                sum += weight * quantity(state)?;
            }
        }
        Ok(sum)
    }

    /// The states of the last `count` cycles.
    pub fn last_cycles(&self, count: f64) -> &[Moment] {
        let from = self.moments[self.moments.len() - 1].q.phi - count * super::machine::CYCLE;
        &self.moments[self.moments.partition_point(|state| state.q.phi < from)..]
    }
}
