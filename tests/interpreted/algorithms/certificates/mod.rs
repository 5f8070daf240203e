//! Certificates and enclosures of mechanisms at run time: the bits and the words of those of emitted code.

pub mod formulas;
mod operations;
mod refused;
mod texts;

use linkage::certify::Certify;
use linkage::{Branches, Certifiable, Column, D, Mechanism};
use linkage_gallery::Fixture;
use linkage_gallery::gate::Gate;
use linkage_gallery::geared_five_bar::GearedFiveBar;
use linkage_gallery::tilted_parallelogram::TiltedParallelogram;
use linkage_gallery::watt_i::WattI;
use linkage_interpreter::{CertifiableAtRunTime, Mechanism as Compiled, Program};

use super::one_loop::{self, CrankRocker, Rocker};
use super::{Numbers, compiled, coordinates, equal};
use texts::{certificates, turn};

/// Calls a function with a mechanism that is ready for certificates.
fn ready<const V: usize, R>(of: &Compiled, call: impl FnOnce(&CertifiableAtRunTime<'_, D<V>>) -> R) -> R {
    let design = of.design();
    let prepared = design.prepared().expect("a mechanism within the capacities");
    let result = call(&prepared.certifiable::<D<V>>().expect("formulas over intervals"));
    assert_eq!(prepared.failure(), None, "{}", of.name());
    result
}

/// Calls a function with a mechanism of the gallery at run time.
fn certifiable<const V: usize, M: Fixture, R>(call: impl FnOnce(&CertifiableAtRunTime<'_, D<V>>) -> R) -> R {
    ready(&compiled::<M>(), call)
}

/// The positions at an input.
fn positions<M: Branches<Scalar = f64, V = D<1>>>(m: &M, input: f64) -> Vec<Numbers> {
    let inputs: linkage::PerInput<M> = [input].into();
    let all = m.all_positions(inputs.into()).unwrap_or_else(|error| panic!("{error}"));
    all.map(|(_, q)| {
        let (unknowns, inputs) = M::parts(&q);
        [unknowns.as_slice().to_vec(), inputs.as_slice().to_vec()]
    })
    .collect()
}

/// Compares all certificates of the first position at an input.
pub fn compare<M>(m: &M, of: &Compiled, input: f64)
where
    M: Certifiable<Name = &'static str, V = D<1>> + Branches,
{
    let start = positions(m, input).swap_remove(0);
    let emitted = certificates(m, &coordinates::<M>(&start));
    let at_run_time = ready::<1, _>(of, |own| certificates(own, &coordinates::<CertifiableAtRunTime<'_, _>>(&start)));
    equal(M::NAME, &emitted, &at_run_time);
}

/// Those of a mechanism of the gallery.
pub fn compare_fixture<M: Fixture<Scalar = f64, V = D<1>> + Certifiable + Branches>(input: f64) {
    compare(&M::with_parameters(&M::defaults()), &compiled::<M>(), input);
}

/// The turn from the first position.
pub fn compare_turn<M: Fixture<Scalar = f64, V = D<1>> + Certifiable + Branches>(input: f64) {
    let m = M::with_parameters(&M::defaults());
    let start = positions(&m, input).swap_remove(0);
    let emitted = turn(&m, &coordinates::<M>(&start));
    let at_run_time = certifiable::<1, M, _>(|own| turn(own, &coordinates::<CertifiableAtRunTime<'_, _>>(&start)));
    equal(M::NAME, &emitted, &at_run_time);
}

fn only(text: &str) -> Compiled {
    Program::compile(text).expect("it compiles").mechanisms()[0].clone()
}

#[test]
fn certificates_of_one_loop() {
    compare(&Rocker::default(), &one_loop::compiled("Rocker"), 0.4);
    // Ranges.
    compare_fixture::<Gate>(0.3);
}

#[test]
fn certificates_of_turns() {
    compare_turn::<GearedFiveBar>(0.3);
    compare_turn::<WattI>(1.0);
    // Change points.
    compare_turn::<TiltedParallelogram>(0.7);
}

/// Wheels are at their start again after turns of all together.
#[test]
fn turns_that_repeat() {
    let (m, of) = (GearedFiveBar::default(), compiled::<GearedFiveBar>());
    let repeats = |wheel: i64| {
        let (unknowns, inputs) = ([0, 0, wheel], [1]);
        let emitted = Certify::new(&m).repeats(&Column::from(unknowns), &Column::from(inputs));
        let column = Column::from_slice(&unknowns).expect("three unknowns");
        let at_run_time = ready::<1, _>(&of, |own| Certify::new(own).repeats(&column, &Column::from(inputs)));
        assert_eq!(emitted, at_run_time, "{wheel}");
        emitted
    };
    assert_eq!([-2, -1].map(repeats), [true, false]);
}

/// Other values of the parameters are those of all functions, not of the formulas alone.
#[test]
fn other_parameters() {
    let start = positions(&CrankRocker::default(), 1.0).swap_remove(0);
    let longer = [81.0, 21.0, 51.0, 71.0];
    let emitted = CrankRocker::default().with(longer.into());
    ready::<1, _>(&one_loop::compiled("CrankRocker"), |own| {
        let other = own.with(Column::from_slice(&longer).expect("four parameters"));
        let at = coordinates::<CertifiableAtRunTime<'_, _>>(&start);
        assert_eq!(Certifiable::parameters(&other).as_slice(), longer);
        let [here, there] = [own, &other].map(|m| m.residual(&m.pose_at(&at)));
        let expected = emitted.residual(&emitted.pose_at(&coordinates::<CrankRocker>(&start)));
        assert_eq!(there.as_slice(), expected.as_slice());
        assert_ne!(here.as_slice(), there.as_slice());
    });
}
