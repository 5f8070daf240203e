//! Third order: `Psi''' = Psi_q q''' + eta` with `eta = 3 (Psi_q q')_q q'' + ((Psi_q q')_q q')_q q'`, in terms
//! of q, `q'` and `q''`.

use super::data::Derivation;
use super::jacobian::along_rates;
use crate::graph::NodeId;
use crate::ids::{RowId, Table};

impl Derivation {
    pub(super) fn derive_jerk(&mut self) {
        // d/dt: q -> q', q' -> q'', q'' -> 0.
        let mut seeds = along_rates(&mut self.graph, &self.coordinates);
        let first = self.graph.differentiate(&self.residual, &seeds);
        for coordinate in &self.coordinates {
            seeds.insert(coordinate.rate, self.graph.variable(coordinate.acceleration));
        }
        let second = self.graph.differentiate(&first, &seeds);
        let eta = self.graph.differentiate(&second, &seeds);
        for coordinate in &self.coordinates {
            seeds.insert(coordinate.acceleration, self.graph.variable(coordinate.jerk));
        }
        for quantity in self.points.iter_mut().chain(&mut self.outputs) {
            quantity.jerk = self.graph.differentiate(&quantity.acceleration, &seeds);
        }
        self.eta = Some(eta.into());
    }

    /// `-(A v''' + eta)`: the right side of `J u''' = -(A v''' + eta)`.
    pub fn jerk_side(&mut self) -> Table<RowId, NodeId> {
        let eta = self.eta.clone().unwrap_or_default();
        eta.ids().map(|row| self.minus_inputs(row, |c| c.jerk, Some(eta[row]))).collect()
    }
}
