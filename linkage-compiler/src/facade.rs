//! The crate that emitted code calls, and what its features allow.

use proc_macro2::TokenStream;

use crate::diagnostics::Diagnostics;
use crate::model::{Mechanism, Request};

/// The `linkage` crate that emitted code calls.
#[derive(Debug, Clone)]
pub struct Facade {
    /// Its path.
    pub path: TokenStream,
    /// True if its feature `dynamics` is on: scenes need it.
    pub has_dynamics: bool,
    /// True if its feature `serde` is on: `derive serde` needs it.
    pub has_serde: bool,
    /// True if its feature `interval` is on: `derive intervals` needs it.
    pub has_intervals: bool,
}

impl Facade {
    /// The crate at this path with all features on.
    #[must_use]
    pub fn complete(path: &TokenStream) -> Self {
        Self { path: path.clone(), has_dynamics: true, has_serde: true, has_intervals: true }
    }

    /// Reports and removes what needs a feature that is off.
    pub(crate) fn check(&self, mechanism: &mut Mechanism, diagnostics: &mut Diagnostics) {
        if !self.has_dynamics {
            // The types that the stubs of scenes name do not exist.
            for scene in std::mem::take(&mut mechanism.scenes).iter() {
                let message = "a scene needs the feature `dynamics` of `linkage`: enable it in Cargo.toml";
                diagnostics.error(scene.name.span(), message);
            }
        }
        let needed = [
            (Request::Serde, self.has_serde, "`derive serde` needs the feature `serde`"),
            (Request::Intervals, self.has_intervals, "`derive intervals` needs the feature `interval`"),
        ];
        for (request, is_on, message) in needed {
            if !is_on && let Some(span) = mechanism.requests_at.remove(&request) {
                mechanism.requests.remove(&request);
                diagnostics.error(span, format_args!("{message} of `linkage`: enable it in Cargo.toml"));
            }
        }
    }
}
