//! All numbers of the formulas of a mechanism in one list, over any kind of number and as nodes of its derivation.

use std::sync::LazyLock;

use linkage::certify::Certify;
use linkage::enclose::{EncloseError, PoseBox};
use linkage::{Certifiable, Column, Dim, Formulas, Interval, Mechanism as _, Number, UpTo};
use linkage_compiler::derivation::{Derivation, Row};
use linkage_compiler::graph::{Node, NodeId};
use linkage_compiler::ids::Id;
use linkage_gallery::listed::{self, Listed, Named};
use linkage_interpreter::{CertifiableAtRunTime, Design, Mechanism};
use linkage_oracle::{Oracle, Sample};

use crate::at_run_time;

/// The number of inputs, at most six as in every mechanism at run time.
type Inputs = UpTo<6>;

/// A mechanism of the gallery at run time. Its formulas are those of the emitted code, operation for operation: see
/// `interpreted/algorithms/certificates/formulas`.
pub struct Enclosable {
    file: &'static str,
    name: &'static str,
    compiled: Mechanism,
}

/// All that is enclosed: the velocity ratios, the sensitivities, the velocity, the acceleration.
pub struct Enclosed {
    pub all: Vec<Interval>,
    /// The numbers of the ratios and sensitivities, and of all but the acceleration.
    pub ends: [usize; 2],
}

/// The reason why nothing is enclosed.
pub enum Unproved {
    NotRegular { norm: f64 },
    UserFunction,
    Other(String),
}

impl From<EncloseError<&str>> for Unproved {
    fn from(error: EncloseError<&str>) -> Self {
        match error {
            EncloseError::NotRegular { norm, .. } => Self::NotRegular { norm },
            EncloseError::UserFunction { .. } => Self::UserFunction,
            other => Self::Other(other.to_string()),
        }
    }
}

/// All mechanisms of the gallery.
pub fn all() -> Vec<&'static Enclosable> {
    static ALL: LazyLock<Vec<Enclosable>> = LazyLock::new(|| {
        let of = |listed: &&'static dyn Listed<f64>| Enclosable {
            file: listed.file(),
            name: listed.name(),
            compiled: at_run_time::of(listed.file(), listed.name()),
        };
        listed::all().iter().map(of).collect()
    });
    ALL.iter().collect()
}

impl Named for Enclosable {
    fn file(&self) -> &'static str {
        self.file
    }
    fn name(&self) -> &'static str {
        self.name
    }
}

impl Enclosable {
    /// Calls a function with the mechanism.
    fn with<R>(&self, design: Design, call: impl FnOnce(&CertifiableAtRunTime<'_, Inputs>) -> R) -> R {
        let prepared = design.prepared().expect("a mechanism within the capacities");
        let result = call(&prepared.certifiable().expect("formulas over intervals"));
        assert_eq!(prepared.failure(), None, "{}", self.name);
        result
    }

    /// All numbers of the formulas: Psi, the columns of J, the columns of A, gamma, the quantities.
    pub fn values<T: Number>(&self, at: &At<T>) -> Vec<T> {
        self.with(self.compiled.design(), |m| {
            let over = m.over::<T>(column(&at.parameters));
            let (unknowns, inputs) = (column(&at.unknowns), column(&at.inputs));
            let mut all: Vec<T> = over.residual(&unknowns, &inputs).into_iter().collect();
            all.extend(over.jacobian_unknowns(&unknowns, &inputs).iter().flatten());
            all.extend(over.jacobian_inputs(&unknowns, &inputs).iter().flatten());
            all.extend(over.gamma(&unknowns, &inputs, &column(&at.unknown_rates), &column(&at.input_rates)));
            all.extend(over.quantities(&unknowns, &inputs));
            all
        })
    }

    /// Psi.
    pub fn residual<T: Number>(&self, at: &At<T>) -> Vec<T> {
        self.with(self.compiled.design(), |m| {
            let over = m.over::<T>(column(&at.parameters));
            over.residual(&column(&at.unknowns), &column(&at.inputs)).into_iter().collect()
        })
    }

    /// True if an equation calls a user function.
    pub fn has_user_function(&self) -> bool {
        self.with(self.compiled.design(), |m| (0..m.dims().2.count()).any(|group| m.user_function(group).is_some()))
    }

    /// True if Psi of the mechanism with default parameters is the same after these turns of the unknowns and the inputs.
    pub fn repeats(&self, turns: &[i64]) -> bool {
        self.with(self.compiled.design(), |m| {
            let (unknowns, inputs) = turns.split_at(m.dims().0.count());
            let (unknowns, inputs) = (Column::from_slice(unknowns).unwrap(), Column::from_slice(inputs).unwrap());
            Certify::new(m).repeats(&unknowns, &inputs)
        })
    }

    /// Encloses all rates over intervals, with these accelerations of the inputs; `parameters` are in the intervals.
    pub fn enclosed(&self, parameters: &[f64], wide: &At<Interval>, given: &[Interval]) -> Result<Enclosed, Unproved> {
        self.with(self.compiled.design().with_parameters(parameters), |m| {
            let (unknowns, inputs) = (column(&wide.unknowns), column(&wide.inputs));
            let pose = PoseBox::with_parameters(m, column(&wide.parameters), unknowns, inputs)?;
            assert!(pose.norms().iter().all(|norm| (0.0..1.0).contains(norm)));
            let input_rates = column(&wide.input_rates);
            let mut all: Vec<Interval> = pose.velocity_ratios()?.iter().flatten().copied().collect();
            all.extend(pose.sensitivity()?.iter().flatten());
            let matrices = all.len();
            all.extend(pose.velocity(&input_rates)?);
            let velocities = all.len();
            all.extend(pose.acceleration(&column(&wide.unknown_rates), &input_rates, &column(given))?);
            Ok(Enclosed { all, ends: [matrices, velocities] })
        })
    }
}

/// The numbers that formulas are functions of.
pub struct At<T> {
    pub parameters: Vec<T>,
    pub unknowns: Vec<T>,
    pub inputs: Vec<T>,
    pub unknown_rates: Vec<T>,
    pub input_rates: Vec<T>,
}

impl<T: Copy> At<T> {
    pub fn map<S>(&self, mut f: impl FnMut(T) -> S) -> At<S> {
        let mut all = |list: &[T]| list.iter().map(|&value| f(value)).collect();
        At {
            parameters: all(&self.parameters),
            unknowns: all(&self.unknowns),
            inputs: all(&self.inputs),
            unknown_rates: all(&self.unknown_rates),
            input_rates: all(&self.input_rates),
        }
    }
}

impl At<f64> {
    pub fn of(sample: &Sample, derivation: &Derivation) -> Self {
        let pick = |from: &[f64], columns: &mut dyn Iterator<Item = usize>| columns.map(|place| from[place]).collect();
        let unknowns = || derivation.unknowns.iter().map(|column| column.index());
        let inputs = || derivation.inputs.iter().map(|column| column.index());
        Self {
            parameters: sample.parameters.clone(),
            unknowns: pick(&sample.q, &mut unknowns()),
            inputs: pick(&sample.q, &mut inputs()),
            unknown_rates: pick(&sample.rates, &mut unknowns()),
            input_rates: pick(&sample.rates, &mut inputs()),
        }
    }
}

/// A column of these numbers.
pub fn column<T: Number, R: Dim>(entries: &[T]) -> Column<T, R> {
    Column::from_slice(entries).expect("as many entries")
}

/// The nodes of the derivation in the order of `values`.
pub fn nodes(oracle: &mut Oracle) -> Vec<NodeId> {
    let derivation = &mut oracle.derivation;
    let zero = derivation.graph.zero();
    let mut all = derivation.residual.to_vec();
    let (j, a) = (derivation.jacobian_unknowns(), derivation.jacobian_inputs());
    all.extend(derivation.unknowns.ids().flat_map(|id| entries(&j, id, zero)));
    all.extend(derivation.inputs.ids().flat_map(|id| entries(&a, id, zero)));
    all.extend(&derivation.gamma);
    all.extend(derivation.points.iter().chain(&derivation.outputs).flat_map(|quantity| &quantity.value));
    all
}

fn entries<C: Id + Ord>(rows: &[Row<C>], column: C, zero: NodeId) -> Vec<NodeId> {
    rows.iter().map(|row| row.get(&column).copied().unwrap_or(zero)).collect()
}

/// For each node, true if it depends on no user function, of which nothing is known.
pub fn is_known(oracle: &Oracle, nodes: &[NodeId]) -> Vec<bool> {
    let graph = &oracle.derivation.graph;
    let is_user = |id: NodeId| matches!(graph.node(id), Node::External(..));
    nodes.iter().map(|&node| !graph.reachable(&[node]).into_iter().any(is_user)).collect()
}
