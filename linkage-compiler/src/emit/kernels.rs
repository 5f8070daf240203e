//! The public functions of a program as a list, with what they cost and compute.

use linkage_ir::code::Code;

use super::fpcore::Straight;
use crate::document::{Kernel, KernelCode, Table};
use crate::program::{Functions, Operations};

/// The public functions with their operation counts, without those that compute nothing, and with their formulas if
/// these are requested.
pub(super) fn kernels(functions: &Functions<Code>, straight: Option<&Straight>, table: &mut Table) -> Vec<Kernel> {
    let public = functions.iter().filter(|function| function.access.is_public());
    let counted =
        public.filter_map(|function| Some((function.name.clone(), function.body.as_ref()?.readable.operations)));
    let counted = counted.filter(|(_, operations)| *operations != Operations::default());
    let kernels = counted.map(|(function, operations)| {
        let code = straight.map_or_else(KernelCode::default, |straight| straight.code(&function, table));
        Kernel { function, operations, code }
    });
    kernels.collect()
}
