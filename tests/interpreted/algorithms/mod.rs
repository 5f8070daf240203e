//! Algorithms of the runtime on mechanisms at run time: the bits and the words of those on emitted mechanisms.
//!
//! An algorithm that reads a constant of a type, where it must read the value, does not compile here. Each mechanism and each
//! scene costs a copy of all algorithms: these are few, and the program `interpreted_gallery` asks the same of the whole gallery.

/// Mechanisms by the macro, and their text, which has a name or is that of the file.
macro_rules! with_text {
    ($TEXT:ident: $($tokens:tt)*) => {
        linkage! { $($tokens)* }

        /// The text of these mechanisms.
        pub const $TEXT: &str = stringify!($($tokens)*);
    };
    ($($tokens:tt)*) => {
        with_text! { OF_THIS_FILE: $($tokens)* }
    };
}

/// Calls a function for mechanisms with branches: a closed form, several groups, change points, ranges, turns that are counted,
/// two inputs.
macro_rules! closed {
    ($compare:ident) => {
        $compare::<_, linkage_gallery::offset_slider_crank::OffsetSliderCrank>();
        $compare::<_, linkage_gallery::watt_i::WattI>();
        $compare::<_, linkage_gallery::tilted_parallelogram::TiltedParallelogram>();
        $compare::<_, linkage_gallery::gate::Gate>();
        $compare::<_, linkage_gallery::geared_five_bar::GearedFiveBar>();
        $compare::<_, linkage_gallery::five_bar::FiveBar>();
    };
}

/// Calls a function for these, for one whose positions Newton's method finds, and for an open chain.
macro_rules! eight {
    ($compare:ident) => {
        closed!($compare);
        $compare::<_, linkage_gallery::double_butterfly::DoubleButterfly>();
        $compare::<_, linkage_gallery::cart_pendulum::CartPendulum>();
    };
}

pub mod bad_input;
pub mod certificates;
pub mod functions;
pub mod motions;
pub mod one_loop;
pub mod pictures;
pub mod scenes;

use linkage::{Column, D, Dim, Mechanism};
use linkage_gallery::Fixture;
use linkage_interpreter::{AtRunTime, Mechanism as Compiled, Program};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// The unknowns and the inputs of a position.
pub type Numbers = [Vec<f64>; 2];

/// A number by its bits, which Rust leaves open for NaN.
pub fn bit(number: f64) -> String {
    if number.is_nan() { "NaN".to_owned() } else { format!("{:x}", number.to_bits()) }
}

/// All numbers of a list.
pub fn bits<'n>(numbers: impl IntoIterator<Item = &'n f64>) -> String {
    numbers.into_iter().map(|number| bit(*number)).collect::<Vec<_>>().join(" ")
}

/// All numbers of a position.
pub fn position<M: Mechanism<Scalar = f64>>(q: &M::Coordinates) -> String {
    let (unknowns, inputs) = M::parts(q);
    bits(unknowns.iter().chain(&inputs))
}

/// The coordinates with these numbers.
pub fn coordinates<M: Mechanism<Scalar = f64>>([unknowns, inputs]: &Numbers) -> M::Coordinates {
    let column = Column::from_slice;
    M::coordinates(column(unknowns).expect("as many unknowns"), Column::from_slice(inputs).expect("as many inputs"))
}

/// The mechanism of the gallery as it is compiled at run time.
pub fn compiled<M: Fixture>() -> Compiled {
    crate::at_run_time::of(M::FILE, M::NAME)
}

/// A mechanism of a text.
pub fn of_text(text: &str, name: &str) -> Compiled {
    let program = Program::compile(text).expect("it compiles");
    program.mechanism(name).expect("the mechanism").clone()
}

/// Random positions and positions on branches, of a mechanism with the default parameters.
pub struct Positions<M> {
    pub mechanism: M,
    pub guesses: Vec<Numbers>,
    pub starts: Vec<Numbers>,
}

impl<M: Fixture<Scalar = f64>> Positions<M> {
    pub fn drawn(count: usize) -> Self {
        let mechanism = M::with_parameters(&M::defaults());
        let mut random = SmallRng::seed_from_u64(52);
        let mut numbers = |count: usize| (0..count).map(|_| random.random_range(-3.0..3.0)).collect::<Vec<f64>>();
        let guesses: Vec<Numbers> =
            (0..count).map(|_| [numbers(M::UNKNOWNS.len()), numbers(M::INPUTS.len())]).collect();
        let branches = M::branches();
        let near = |(place, guess): (usize, &Numbers)| {
            let guess = coordinates::<M>(guess);
            let found = match branches.len() {
                0 => linkage::position::newton(&mechanism, &guess).ok()?.coordinates,
                count => M::coordinates_of(&mechanism.assembled(&guess, branches[place % count]).ok()?),
            };
            let (unknowns, inputs) = M::parts(&found);
            Some([unknowns.as_slice().to_vec(), inputs.as_slice().to_vec()])
        };
        let starts = guesses.iter().enumerate().filter_map(near).take(4).collect();
        Self { mechanism, guesses, starts }
    }
}

/// Compares what an algorithm finds on a mechanism of the gallery and at run time.
#[track_caller]
pub fn same<M: Fixture>(emitted: &[String], at_run_time: &[String]) {
    equal(&format!("{} of {}", M::NAME, M::FILE), emitted, at_run_time);
}

/// Compares what an algorithm finds on a mechanism with this name, and at run time.
#[track_caller]
pub fn equal(of: &str, emitted: &[String], at_run_time: &[String]) {
    for (one, other) in emitted.iter().zip(at_run_time) {
        assert_eq!(one, other, "{of}");
    }
    assert_eq!(emitted.len(), at_run_time.len(), "{of}");
}

/// Calls a function with the mechanism at run time.
pub fn at_run_time<const V: usize, M: Fixture<V = D<V>>, R>(call: impl FnOnce(&AtRunTime<'_, D<V>>) -> R) -> R {
    let design = compiled::<M>().design();
    let prepared = design.prepared().expect("a mechanism within the capacities");
    let mechanism = prepared.with_inputs::<D<V>>().expect("as many inputs");
    let result = call(&mechanism);
    assert_eq!(prepared.failure(), None, "{}", M::NAME);
    assert_eq!(mechanism.dims().0.count(), M::UNKNOWNS.len());
    result
}
