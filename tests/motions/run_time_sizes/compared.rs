//! Certificates of mechanisms at run time against those of emitted code.

use linkage::{Branches, Certifiable, Column, D, Dim, Formulas, Mechanism, Number, Ranged, UpTo, linkage};

use super::certificates::certificates;
use super::wrapped::{AtRunTime, Most, Texts, column};

linkage! {
    /// A crank-rocker.
    #[derive(Debug, Clone, Copy)]
    mechanism CrankRocker {
        param ground = 80, crank = 20, coupler = 50, rocker = 70;
        input theta;
        unknown phi, psi in 60deg..115deg;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        point A = crank@theta;
        point C = crank@theta + coupler@phi;
        output swing = psi;
        output height = rocker * sin(psi);
        derive intervals;
    }

    /// A double rocker: the input turns back at dead points.
    #[derive(Debug, Clone, Copy)]
    mechanism Rocker {
        param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        derive intervals;
    }

    /// An oscillating block.
    #[derive(Debug, Clone, Copy)]
    mechanism Block {
        param ground = 3, crank = 1;
        input theta;
        unknown s, psi;
        loop crank@theta = ground@0 + s@psi;
        point Pin = crank@theta;
        output turned = psi - theta;
        derive intervals;
    }
}

/// The formulas of a mechanism at run time.
pub struct FormulasAtRunTime<F>(F);

impl<F: Formulas<V = D<1>>> Formulas for FormulasAtRunTime<F> {
    type Number = F::Number;
    type U = Most;
    type V = D<1>;
    type Q = UpTo<40>;

    fn residual(&self, u: &Column<F::Number, Most>, v: &Column<F::Number, D<1>>) -> Column<F::Number, Most> {
        column(&self.0.residual(&column(u), v))
    }
    fn jacobian_unknowns(
        &self,
        u: &Column<F::Number, Most>,
        v: &Column<F::Number, D<1>>,
    ) -> Column<Column<F::Number, Most>, Most> {
        column(&self.0.jacobian_unknowns(&column(u), v).map(|own| column(&own)))
    }
    fn jacobian_inputs(
        &self,
        u: &Column<F::Number, Most>,
        v: &Column<F::Number, D<1>>,
    ) -> Column<Column<F::Number, Most>, D<1>> {
        self.0.jacobian_inputs(&column(u), v).map(|own| column(&own))
    }
    fn gamma(
        &self,
        u: &Column<F::Number, Most>,
        v: &Column<F::Number, D<1>>,
        unknown_rates: &Column<F::Number, Most>,
        input_rates: &Column<F::Number, D<1>>,
    ) -> Column<F::Number, Most> {
        column(&self.0.gamma(&column(u), v, &column(unknown_rates), input_rates))
    }
    fn quantities(&self, u: &Column<F::Number, Most>, v: &Column<F::Number, D<1>>) -> Column<F::Number, UpTo<40>> {
        column(&self.0.quantities(&column(u), v))
    }
    fn ranged(
        &self,
        place: usize,
        u: &Column<F::Number, Most>,
        v: &Column<F::Number, D<1>>,
    ) -> Option<Ranged<F::Number>> {
        self.0.ranged(place, &column(u), v)
    }
}

impl<'n, M> Certifiable for AtRunTime<'n, M>
where
    M: Mechanism<Scalar = f64, Name = &'static str, V = D<1>> + Certifiable,
{
    type P = Most;
    type Q = UpTo<40>;
    type Over<N: Number> = FormulasAtRunTime<M::Over<N>>;

    const PARAMETERS: &'static [&'static str] = panic!("names of a value");
    const QUANTITIES: &'static [&'static str] = panic!("names of a value");
    const USER_FUNCTIONS: &'static [Option<&'static str>] = panic!("functions of a value");

    fn parameter_name(&self, place: usize) -> &'n str {
        self.of.parameter_name(place)
    }
    fn quantity_name(&self, place: usize) -> &'n str {
        self.of.quantity_name(place)
    }
    fn user_function(&self, group: usize) -> Option<&'n str> {
        self.of.user_function(group)
    }
    fn quantity_count(&self) -> UpTo<40> {
        UpTo::new(self.of.quantity_count().count()).expect("few quantities")
    }
    fn parameters(&self) -> Column<f64, Most> {
        column(&self.of.parameters())
    }
    fn with(&self, parameters: Column<f64, Most>) -> Self {
        let Self { texts, inputs, groups, .. } = *self;
        Self { of: self.of.with(column(&parameters)), texts, inputs, groups }
    }
    fn over<N: Number>(&self, parameters: Column<N, Most>) -> Self::Over<N> {
        FormulasAtRunTime(self.of.over(column(&parameters)))
    }
}

/// Calls a function with the mechanism at run time, whose names have a mark.
fn wrapped<M, R>(m: &M, mark: &str, call: impl FnOnce(&AtRunTime<'_, M>) -> R) -> R
where
    M: Mechanism<Scalar = f64, Name = &'static str, V = D<1>> + Clone,
{
    let texts = Texts::marked_by::<M>(mark);
    let (inputs, groups) = (texts.inputs(), texts.groups::<M>());
    call(&AtRunTime { of: m.clone(), texts: &texts, inputs: &inputs, groups: &groups })
}

/// The first positions at an input, with their branches.
fn positions<M: Mechanism<Scalar = f64, V = D<1>> + Branches>(m: &M, input: f64) -> Vec<(M::Branch, M::Coordinates)> {
    let inputs: linkage::PerInput<M> = [input].into();
    m.all_positions(inputs.into()).unwrap().collect()
}

/// Compares texts, line by line.
#[track_caller]
fn same(emitted: &[String], at_run_time: &[String]) {
    for (emitted, at_run_time) in emitted.iter().zip(at_run_time) {
        for (one, other) in emitted.lines().zip(at_run_time.lines()) {
            assert_eq!(one, other);
        }
        assert_eq!(emitted, at_run_time);
    }
    assert_eq!(emitted.len(), at_run_time.len());
}

fn certified<M>(m: &M, input: f64)
where
    M: Mechanism<Scalar = f64, Name = &'static str, V = D<1>> + Certifiable + Branches + Clone,
{
    for (_, q) in positions(m, input) {
        let split = AtRunTime::<M>::split(&q);
        let at_run_time = wrapped(m, " at run time", |m| certificates(m, &split));
        assert!(at_run_time.iter().any(|text| text.contains(" at run time")));
        let unmarked: Vec<String> = at_run_time.iter().map(|text| text.replace(" at run time", "")).collect();
        same(&certificates(m, &q), &unmarked);
    }
}

#[test]
fn proofs() {
    certified(&CrankRocker::default(), 1.0);
    certified(&Rocker::default(), 0.4);
    certified(&Block::default(), 0.9);
}
