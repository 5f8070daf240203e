//! Mechanisms by name.

use std::collections::BTreeMap;
use std::sync::Arc;

use linkage_runtime::lanes::Lanes;
use linkage_sweep_arrow::Scalar;

use crate::chunked::Chunked;
use crate::family::AnyFamily;
use crate::nearest::nearest;
use crate::{EngineError, Family, TableSpec};

/// The mechanisms that queries name.
///
/// ```
/// use linkage::{Elbow, linkage};
/// use linkage_engine::{Family, Mechanisms, session};
///
/// linkage! {
///     /// Slider-crank with an offset.
///     pub mechanism Press {
///         param crank = 1, rod = 3, offset = 0.25;
///         input theta;
///         unknown phi, s;
///         loop crank@theta + rod@phi = (s, offset);
///         derive lanes;
///     }
/// }
///
/// let mut mechanisms = Mechanisms::default();
/// mechanisms.register("press", Family::new(Press::<f64>::default(), PressBranch::all().next().expect("two branches")))?;
/// let context = session(mechanisms);
/// # Ok::<(), linkage_engine::EngineError>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Mechanisms {
    families: BTreeMap<String, Arc<dyn AnyFamily>>,
}

impl Mechanisms {
    /// Adds a mechanism.
    ///
    /// # Errors
    /// [`EngineError::Registered`] if the name is taken, or a branch or a column is named twice;
    /// [`EngineError::Sweep`] if a case column needs a column that the mechanism does not have.
    pub fn register<M>(&mut self, name: impl Into<String>, family: Family<M>) -> Result<&mut Self, EngineError>
    where
        M: Lanes + Send + Sync + 'static,
        M::Scalar: Scalar,
        M::Branch: Send + Sync,
    {
        let name = name.into();
        if self.families.contains_key(&name) {
            return Err(EngineError::Registered { kind: "mechanism", name });
        }
        family.check()?;
        self.families.insert(name, Arc::new(family));
        Ok(self)
    }

    /// The names, in alphabetical order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.families.keys().map(String::as_str)
    }

    /// Opens a table.
    pub(crate) fn open(&self, spec: &TableSpec) -> Result<Arc<dyn Chunked>, EngineError> {
        let TableSpec { kind, mechanism, request } = spec;
        let family = self.families.get(mechanism).ok_or_else(|| EngineError::UnknownMechanism {
            name: mechanism.clone(),
            nearest: nearest(mechanism, self.names()).map(str::to_owned),
            known: self.names().map(str::to_owned).collect(),
        })?;
        family.open(mechanism, *kind, request).map_err(|error| error.of(kind.function(), mechanism))
    }
}
