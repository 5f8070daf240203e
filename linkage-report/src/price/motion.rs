//! The price of accuracy of one mechanism along one motion.

use linkage_double::DoubleDouble;
use linkage_runtime::derivation::Derivation;
use linkage_runtime::range_of_motion::{MotionEnd, RangeOfMotion};
use linkage_runtime::{Assembly, D, InputError, Kinematic};

use super::PriceError;
use super::data::{MethodPrice, QUANTITIES};
use super::frontier::{Cost, cheapest, frontier};
use super::methods::{Methods, Sample, Work};
use super::prediction::Counts;
use super::reference::{Reference, check_digits, in_scalar};
use super::timing::{Timed, in_turn};
use crate::report::{ReportedCoordinate, SingularInput};

/// The options of a [`MotionPrice`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PriceOptions {
    /// The least and the largest input, by default those of the motion.
    pub inputs: Option<[f64; 2]>,
    /// The number of inputs, by default 180, in the middle of as many equal parts.
    pub samples: usize,
    /// The distance from which Newton's method starts, in radians or in the unit of the lengths, by default a 360th of a
    /// turn, and of the inputs where these are lengths; a quarter of the inputs at most.
    pub step: Option<f64>,
    /// The number of rounds that are timed, by default 15.
    pub rounds: usize,
    /// The seconds of one method in a round, by default 1e-4.
    pub span: f64,
    /// The errors for which the fastest method is named, by default 1e-3, 1e-6, 1e-9 and 1e-12.
    pub wanted: Vec<f64>,
}

impl Default for PriceOptions {
    fn default() -> Self {
        Self { inputs: None, samples: 180, step: None, rounds: 15, span: 1e-4, wanted: vec![1e-3, 1e-6, 1e-9, 1e-12] }
    }
}

/// A mechanism in two more scalars: `m.clone().map(|x| x as f32)` and `m.clone().map(DoubleDouble::from)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InOtherScalars<S, T> {
    /// In `f32`.
    pub single: S,
    /// In `DoubleDouble`.
    pub double_double: T,
}

/// Errors and times of the methods for one mechanism along one motion.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotionPrice {
    /// The mechanism.
    pub mechanism: String,
    /// Its input.
    pub input: ReportedCoordinate,
    /// The inputs that were asked for.
    pub asked: [f64; 2],
    /// The inputs at which the errors are.
    pub inputs: Vec<f64>,
    /// The parts of the inputs that were asked for without a position.
    pub gaps: Vec<Gap>,
    /// The inputs without a reference, as at a change point; they have no errors.
    pub left_out: Vec<LeftOut>,
    /// The change points that the motion passes.
    pub change_points: Vec<SingularInput>,
    /// The methods, the first of which is that of the ratios.
    pub methods: Vec<MethodPrice>,
    /// The largest correction in the last step to the reference: the error of the positions before it.
    pub reference: f64,
    /// The errors for which the fastest method is named.
    pub wanted: Vec<f64>,
    /// True if the times are those of optimised code.
    pub is_optimised: bool,
}

/// Inputs without a position.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Gap {
    /// The end of the motion.
    pub from: f64,
    /// The end of the inputs that were asked for.
    pub to: f64,
    /// Why the motion ends.
    pub reason: MotionEnd,
}

/// An input without a reference.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LeftOut {
    /// The input.
    pub input: f64,
    /// Why it has none.
    pub error: PriceError,
}

impl MotionPrice {
    /// The price of a mechanism with a closed form along one motion. `derivation` is its constant `DERIVATION`.
    ///
    /// # Errors
    /// [`PriceError::Input`] for an option that is invalid and for a motion that has none of the inputs;
    /// [`PriceError::OtherParameters`] and [`PriceError::FewDigits`] if the mechanism in double-double is not the same one
    /// or has fewer digits; [`PriceError::Path`] and [`PriceError::Reference`] if no input has a reference.
    pub fn of<M, S, T>(
        range: &RangeOfMotion<'_, M>,
        derivation: &Derivation<'static>,
        others: &InOtherScalars<S, T>,
        options: &PriceOptions,
    ) -> Result<Self, PriceError>
    where
        M: Assembly + Kinematic<Scalar = f64, Name = &'static str, V = D<1>>,
        S: Assembly + Kinematic<Scalar = f32, Name = &'static str, U = M::U, V = D<1>, Branch = M::Branch>,
        T: Assembly + Kinematic<Scalar = DoubleDouble, Name = &'static str, U = M::U, V = D<1>, Branch = M::Branch>,
    {
        let (m, InOtherScalars { single, double_double }) = (range.mechanism(), others);
        let inputs = Inputs::of(range, derivation, double_double, options)?;
        let mut methods = Methods::new(&inputs.samples, Counts::of(derivation));
        methods.closed(m, single, double_double);
        methods.steps(m);
        methods.until_converged(m);
        methods.tables(m, inputs.are_a_turn);
        Ok(Self::measured(range, &inputs, methods.works, options))
    }

    /// The price of any mechanism with one input, by methods that need no closed form.
    ///
    /// # Errors
    /// Those of [`of`](Self::of).
    pub fn by_newton<M, S, T>(
        range: &RangeOfMotion<'_, M>,
        derivation: &Derivation<'static>,
        others: &InOtherScalars<S, T>,
        options: &PriceOptions,
    ) -> Result<Self, PriceError>
    where
        M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>,
        S: Kinematic<Scalar = f32, Name = &'static str, U = M::U, V = D<1>>,
        T: Kinematic<Scalar = DoubleDouble, Name = &'static str, U = M::U, V = D<1>>,
    {
        let (m, InOtherScalars { single, double_double }) = (range.mechanism(), others);
        let inputs = Inputs::of(range, derivation, double_double, options)?;
        let mut methods = Methods::new(&inputs.samples, Counts::of(derivation));
        methods.by_number(m, single, double_double);
        methods.steps(m);
        methods.tables(m, inputs.are_a_turn);
        Ok(Self::measured(range, &inputs, methods.works, options))
    }

    fn measured<M>(
        range: &RangeOfMotion<'_, M>,
        inputs: &Inputs<M>,
        works: Vec<Work<'_>>,
        options: &PriceOptions,
    ) -> Self
    where
        M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>,
    {
        let Inputs { asked, within, ref samples, .. } = *inputs;
        let timed = works.iter().flat_map(|work| {
            let evaluations = work.evaluations;
            let passes = work.passes.iter().enumerate();
            passes.map(move |(order, pass)| Timed { pass: &**pass, evaluations, base: order })
        });
        let times = in_turn(&timed.collect::<Vec<_>>(), options.rounds, options.span);
        let mut methods: Vec<MethodPrice> = works.into_iter().map(|work| work.price).collect();
        for (method, times) in methods.iter_mut().zip(times.chunks(QUANTITIES.len())) {
            for (quantity, time) in method.quantities.iter_mut().zip(times) {
                quantity.time = *time;
            }
        }
        Self {
            mechanism: M::NAME.to_owned(),
            input: ReportedCoordinate { name: M::INPUTS[0].to_owned(), is_angle: M::INPUT_ANGLES[0] },
            asked,
            gaps: gaps(range, asked, within),
            left_out: inputs.left_out.clone(),
            change_points: change_points(range, within),
            methods,
            reference: samples.iter().map(|sample| sample.reference.correction).fold(0.0, f64::max),
            inputs: samples.iter().map(|sample| sample.input).collect(),
            wanted: options.wanted.clone(),
            is_optimised: !cfg!(debug_assertions),
        }
    }

    /// A method by its name.
    #[must_use]
    pub fn method(&self, name: &str) -> Option<&MethodPrice> {
        self.methods.iter().find(|method| method.name == name)
    }

    /// The largest error and the median time of each method for a quantity, by its order of derivative; none for a method
    /// that fails at an input.
    #[must_use]
    pub fn costs(&self, order: usize) -> Vec<Option<Cost>> {
        let cost = |method: &MethodPrice| {
            let quantity = method.quantities.get(order)?;
            Some(Cost { error: quantity.largest().ok()?, time: quantity.time?.median })
        };
        self.methods.iter().map(cost).collect()
    }

    /// The methods that are clearly more accurate than every faster one.
    #[must_use]
    pub fn front(&self, order: usize) -> Vec<usize> {
        frontier(&self.costs(order))
    }

    /// The fastest method with at most this error, and the next faster one.
    #[must_use]
    pub fn fastest(&self, order: usize, error: f64) -> Option<(&MethodPrice, Option<&MethodPrice>)> {
        let (fastest, faster) = cheapest(&self.costs(order), error)?;
        Some((&self.methods[fastest], faster.map(|place| &self.methods[place])))
    }
}

/// The inputs of a price.
struct Inputs<M: Kinematic> {
    /// The ends that are asked for.
    asked: [f64; 2],
    /// The ends of those that the motion has.
    within: [f64; 2],
    samples: Vec<Sample<M>>,
    left_out: Vec<LeftOut>,
    /// True if they are a turn after which the motion closes.
    are_a_turn: bool,
}

impl<M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>> Inputs<M> {
    fn of<T>(
        range: &RangeOfMotion<'_, M>,
        derivation: &Derivation<'static>,
        twice: &T,
        options: &PriceOptions,
    ) -> Result<Self, PriceError>
    where
        T: Kinematic<Scalar = DoubleDouble, Name = &'static str, U = M::U, V = D<1>>,
    {
        let [asked, within] = ends(range, options)?;
        let (samples, left_out) = samples(range, twice, within, options)?;
        for sample in &samples {
            check_digits(twice, derivation, &in_scalar::<M, T>(&sample.position))?;
        }
        let is_turn = matches!(range.ends()[1], MotionEnd::Closed { turns: 1 });
        Ok(Self { asked, within, samples, left_out, are_a_turn: is_turn && asked == range.inputs() })
    }
}

/// The ends of the inputs that are asked for, and of those of them that the motion has.
fn ends<M>(range: &RangeOfMotion<'_, M>, options: &PriceOptions) -> Result<[[f64; 2]; 2], PriceError>
where
    M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>,
{
    let invalid = |quantity, value, [least, most]: [f64; 2]| {
        PriceError::Input(InputError::OutOfRange { of: Some(M::NAME), quantity, value, least, most })
    };
    let has = range.inputs();
    let asked = options.inputs.unwrap_or(has);
    if options.samples == 0 || options.rounds == 0 {
        let quantity = if options.samples == 0 { "the number of samples" } else { "the number of rounds" };
        return Err(invalid(quantity, 0.0, [1.0, f64::INFINITY]));
    }
    if !(asked[0].is_finite() && asked[1].is_finite() && asked[0] < asked[1]) {
        return Err(invalid("the largest input of a price", asked[1], [asked[0], f64::INFINITY]));
    }
    if !(options.span.is_finite() && options.span >= 0.0) {
        return Err(invalid("the span of a price", options.span, [0.0, f64::INFINITY]));
    }
    if let Some(step) = options.step.filter(|step| !(step.is_finite() && *step > 0.0)) {
        return Err(invalid("the step of a price", step, [0.0, f64::INFINITY]));
    }
    let within = if range.is_closed() { asked } else { [asked[0].max(has[0]), asked[1].min(has[1])] };
    if within[0] < within[1] {
        return Ok([asked, within]);
    }
    let missed = if asked[0] >= has[1] { asked[0] } else { asked[1] };
    Err(invalid("the inputs of a price", missed, has))
}

/// The positions in the middle of equal parts, each with one nearby and its reference.
fn samples<M, T>(
    range: &RangeOfMotion<'_, M>,
    twice: &T,
    [low, high]: [f64; 2],
    options: &PriceOptions,
) -> Result<(Vec<Sample<M>>, Vec<LeftOut>), PriceError>
where
    M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>,
    T: Kinematic<Scalar = DoubleDouble, Name = &'static str, U = M::U, V = D<1>>,
{
    let whole = if M::INPUT_ANGLES[0] { std::f64::consts::TAU } else { high - low };
    let step = options.step.unwrap_or(whole / 360.0).min(0.25 * (high - low));
    let part = (high - low) / options.samples as f64;
    let sample = |input: f64| {
        let position = range.at(input)?;
        let near = if input - step > low { input - step } else { input + step };
        Ok(Sample {
            input,
            position,
            before: range.at(near)?,
            reference: Reference::at(range.mechanism(), twice, &position)?,
        })
    };
    let (mut samples, mut left_out) = (Vec::with_capacity(options.samples), Vec::new());
    for place in 0..options.samples {
        let input = low + (place as f64 + 0.5) * part;
        match sample(input) {
            Ok(sample) => samples.push(sample),
            Err(error @ (PriceError::Path(_) | PriceError::Reference { .. })) => {
                left_out.push(LeftOut { input, error })
            }
            Err(error) => return Err(error),
        }
    }
    match (samples.is_empty(), left_out.first()) {
        (true, Some(first)) => Err(first.error.clone()),
        _ => Ok((samples, left_out)),
    }
}

/// The change points between these inputs; a closed motion passes its own ones in each cycle.
fn change_points<M>(range: &RangeOfMotion<'_, M>, [low, high]: [f64; 2]) -> Vec<SingularInput>
where
    M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>,
{
    let [first, last] = range.inputs();
    let cycle = last - first;
    let cycles =
        if range.is_closed() { [((low - last) / cycle).floor(), ((high - first) / cycle).ceil()] } else { [0.0; 2] };
    let cycles = (0..).map(|count| cycles[0] + f64::from(count)).take_while(|cycle| *cycle <= cycles[1]);
    let points = cycles.flat_map(|count| {
        range.crossings().map(move |crossing| SingularInput {
            input: crossing.input + count * cycle,
            groups: crossing.groups.iter().map(str::to_owned).collect(),
        })
    });
    points.filter(|point| low < point.input && point.input < high).collect()
}

/// The parts of the inputs that were asked for beyond the ends of the motion.
fn gaps<M>(range: &RangeOfMotion<'_, M>, asked: [f64; 2], within: [f64; 2]) -> Vec<Gap>
where
    M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>,
{
    let ends = range.ends().into_iter().zip(asked.into_iter().zip(within));
    ends.filter(|(_, (to, from))| to != from).map(|(reason, (to, from))| Gap { from, to, reason }).collect()
}
