//! All numbers of the formulas of a mechanism in one list, over any kind of number and as nodes of its derivation.

use std::marker::PhantomData;

use linkage::certify::Certify;
use linkage::enclose::{EncloseError, PoseBox};
use linkage::{Certifiable, Column, Dim, Formulas, Interval, Number};
use linkage_compiler::derivation::{Derivation, Row};
use linkage_compiler::graph::{Node, NodeId};
use linkage_compiler::ids::Id;
use linkage_gallery::listed::Named;
use linkage_gallery::{Fixture, all_mechanisms};
use linkage_oracle::{Oracle, Sample};
use num_dual::{Dual2_64, Dual64};

/// A mechanism with what is compiled of it over intervals and dual numbers.
pub trait Enclosable: Named {
    /// All numbers of the formulas.
    fn in_doubles(&self, at: &At<f64>) -> Vec<f64>;
    /// All numbers of the formulas.
    fn in_intervals(&self, at: &At<Interval>) -> Vec<Interval>;
    /// Psi with first derivatives.
    fn residual_once(&self, at: &At<Dual64>) -> Vec<Dual64>;
    /// Psi with second derivatives.
    fn residual_twice(&self, at: &At<Dual2_64>) -> Vec<Dual2_64>;
    /// The name of the first user function in the equations of each group.
    fn user_functions(&self) -> &'static [Option<&'static str>];
    /// True if Psi of the mechanism with default parameters is the same after these turns of the unknowns and the inputs.
    fn repeats(&self, turns: &[i64]) -> bool;
    /// Encloses all rates over intervals, with these accelerations of the inputs; `parameters` are in the intervals.
    fn enclosed(&self, parameters: &[f64], wide: &At<Interval>, given: &[Interval]) -> Result<Enclosed, EncloseError>;
}

/// All that is enclosed: the velocity ratios, the sensitivities, the velocity, the acceleration.
pub struct Enclosed {
    pub all: Vec<Interval>,
    /// The numbers of the ratios and sensitivities, and of all but the acceleration.
    pub ends: [usize; 2],
}

/// All mechanisms of the gallery.
pub fn all() -> Vec<&'static dyn Enclosable> {
    macro_rules! entries {
        ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
            vec![$($(&Of::<linkage_gallery::$file::$Mechanism>(PhantomData)),+),*]
        };
    }
    all_mechanisms!(entries)
}

/// A type of the gallery, as an object.
struct Of<M>(PhantomData<fn() -> M>);

impl<M: Fixture> Named for Of<M> {
    fn file(&self) -> &'static str {
        M::FILE
    }
    fn name(&self) -> &'static str {
        M::NAME
    }
}

impl<M: Fixture<Scalar = f64> + Certifiable + Default> Enclosable for Of<M> {
    fn in_doubles(&self, at: &At<f64>) -> Vec<f64> {
        values::<M, f64>(at)
    }
    fn in_intervals(&self, at: &At<Interval>) -> Vec<Interval> {
        values::<M, Interval>(at)
    }
    fn residual_once(&self, at: &At<Dual64>) -> Vec<Dual64> {
        residual::<M, Dual64>(at)
    }
    fn residual_twice(&self, at: &At<Dual2_64>) -> Vec<Dual2_64> {
        residual::<M, Dual2_64>(at)
    }
    fn user_functions(&self) -> &'static [Option<&'static str>] {
        assert_eq!(M::USER_FUNCTIONS.len(), M::GROUPS.len());
        M::USER_FUNCTIONS
    }
    fn repeats(&self, turns: &[i64]) -> bool {
        let (unknowns, inputs) = turns.split_at(M::U::CAPACITY);
        let (unknowns, inputs) = (Column::from_slice(unknowns).unwrap(), Column::from_slice(inputs).unwrap());
        Certify::new(&M::default()).repeats(&unknowns, &inputs)
    }
    fn enclosed(&self, parameters: &[f64], wide: &At<Interval>, given: &[Interval]) -> Result<Enclosed, EncloseError> {
        let mechanism = <M as Fixture>::with_parameters(parameters);
        let (unknowns, inputs) = (column(&wide.unknowns), column(&wide.inputs));
        let pose = PoseBox::with_parameters(&mechanism, column(&wide.parameters), unknowns, inputs)?;
        assert!(pose.norms().iter().all(|norm| (0.0..1.0).contains(norm)));
        let input_rates = column(&wide.input_rates);
        let mut all: Vec<Interval> = pose.velocity_ratios()?.iter().flatten().copied().collect();
        all.extend(pose.sensitivity()?.iter().flatten());
        let matrices = all.len();
        all.extend(pose.velocity(&input_rates)?);
        let velocities = all.len();
        all.extend(pose.acceleration(&column(&wide.unknown_rates), &input_rates, &column(given))?);
        Ok(Enclosed { all, ends: [matrices, velocities] })
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

/// Psi.
fn residual<M: Certifiable + Default, T: Number>(at: &At<T>) -> Vec<T> {
    let over = M::default().over::<T>(column(&at.parameters));
    over.residual(&column(&at.unknowns), &column(&at.inputs)).into_iter().collect()
}

/// Psi, the columns of J, the columns of A, gamma, the quantities.
pub fn values<M: Certifiable + Default, T: Number>(at: &At<T>) -> Vec<T> {
    let over = M::default().over::<T>(column(&at.parameters));
    let (unknowns, inputs) = (column(&at.unknowns), column(&at.inputs));
    let mut all: Vec<T> = over.residual(&unknowns, &inputs).into_iter().collect();
    all.extend(over.jacobian_unknowns(&unknowns, &inputs).iter().flatten());
    all.extend(over.jacobian_inputs(&unknowns, &inputs).iter().flatten());
    all.extend(over.gamma(&unknowns, &inputs, &column(&at.unknown_rates), &column(&at.input_rates)));
    all.extend(over.quantities(&unknowns, &inputs));
    all
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
