//! The integrator: the modified midpoint rule, extrapolated to order 12 (W. B. Gragg; R. Bulirsch and J. Stoer, 1966).

use super::model::N;

/// Coordinates and rates.
pub type State = [f64; 2 * N];

/// The numbers of substeps.
const SUBSTEPS: [usize; 6] = [2, 4, 6, 8, 10, 12];

/// Returns the state after a step, and the difference of the last two extrapolations.
pub fn step(rate: &impl Fn(f64, &State) -> State, (t, y): (f64, &State), h: f64) -> (State, State) {
    let first = rate(t, y);
    let mut table = [[0.0; 2 * N]; SUBSTEPS.len()];
    let mut error = [0.0; 2 * N];
    for (k, &count) in SUBSTEPS.iter().enumerate() {
        let little = h / count as f64;
        let (mut before, mut now) = (*y, added(y, &first, little));
        for i in 1..count {
            let next = added(&before, &rate(t + little * i as f64, &now), 2.0 * little);
            (before, now) = (now, next);
        }
        let last = rate(t + h, &now);
        let mut entry = [0.0; 2 * N];
        for i in 0..2 * N {
            entry[i] = 0.5 * (now[i] + before[i] + little * last[i]);
        }
        // Neville's scheme in h^2, upwards in the table of the previous row.
        for j in 0..k {
            let ratio = SUBSTEPS[k] as f64 / SUBSTEPS[k - 1 - j] as f64;
            let factor = 1.0 / (ratio * ratio - 1.0);
            for i in 0..2 * N {
                let better = entry[i] + (entry[i] - table[j][i]) * factor;
                table[j][i] = entry[i];
                error[i] = better - entry[i];
                entry[i] = better;
            }
        }
        table[k] = entry;
    }
    (table[SUBSTEPS.len() - 1], error)
}

fn added(y: &State, slope: &State, h: f64) -> State {
    let mut sum = *y;
    for (sum, slope) in sum.iter_mut().zip(slope) {
        *sum += h * slope;
    }
    sum
}
