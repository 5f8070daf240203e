//! The properties of the velocity ratios, with the numbers of a mechanism.

use std::fmt;

use linkage_runtime::derivation::Derivation;
use linkage_runtime::jacobian::Scales;
use linkage_runtime::{Build, Kinematic, PerInput, PerUnknown, PositionErrorOf, position};

use super::{Language, number};

/// A property of the velocity ratios, with numbers that show it.
#[derive(Debug, Clone, PartialEq)]
pub struct RatioProperty {
    /// The property as a sentence in English, which a sheet in another language translates.
    pub statement: &'static str,
    /// The numbers.
    pub numbers: Vec<RatioNumber>,
}

/// A number in two ways: by the velocity ratios, and without them.
#[derive(Debug, Clone, PartialEq)]
pub struct RatioNumber {
    /// Its name, such as `theta3/theta2`.
    pub name: String,
    /// The number by the velocity ratios.
    pub by_ratios: f64,
    /// The number without them.
    pub otherwise: f64,
}

/// The part of a scale by which inputs are moved to find differences: the error of a difference quotient with the fourth
/// power of the step, about 1e-13, is then about that of rounding.
const STEP: f64 = 1.0 / 1024.0;

/// The six properties of the velocity ratios W at a position, with u' = W v' at these rates of the inputs:
///
/// 1. an entry is the rate of an unknown if one input has the rate 1 and the others rest;
/// 2. it is the derivative of the unknown by the input, here the difference quotient of positions;
/// 3. it does not depend on the rates: at twice the rates of the inputs the unknowns are twice as fast;
/// 4. W dv is the small displacement of the unknowns at one of the inputs, up to terms of second order;
/// 5. points and outputs have ratios as well;
/// 6. with one input they are transmission ratios, the quotients of two rates. It has no numbers for several inputs.
///
/// # Errors
/// [`PositionError`](linkage_runtime::PositionError) if J is singular here, or a position next to this one does not exist.
pub fn ratio_properties<M: Kinematic<Scalar = f64>>(
    mechanism: &M,
    derivation: &Derivation<'_>,
    q: &M::Coordinates,
    input_rates: impl Into<M::Inputs>,
) -> Result<[RatioProperty; 6], PositionErrorOf<M>> {
    let input_rates: PerInput<M> = input_rates.into().into();
    let pose = mechanism.pose_at(q);
    let ratios = mechanism.velocity_ratios(&pose)?;
    let velocity = |rates: PerInput<M>| mechanism.velocity(&pose, rates.into());
    let unknown_rates = |rates: PerInput<M>| Ok::<_, PositionErrorOf<M>>(M::rate_parts(&velocity(rates)?).0);
    let steps = Scales::of(mechanism, &pose).coordinates.inputs * STEP;
    let (unknowns, inputs) = M::parts(q);
    let moved = |by: PerInput<M>| -> Result<PerUnknown<M>, PositionErrorOf<M>> {
        let guess = M::coordinates(unknowns + ratios * by, inputs + by);
        let found = position::newton(mechanism, &guess)?.coordinates;
        Ok(M::unknowns(&found) - unknowns)
    };
    let names = |of: &dyn Fn(&str, &str) -> String| -> Vec<Vec<String>> {
        let of_input = |input: &linkage_runtime::derivation::Symbol<'_>| {
            derivation.unknowns.iter().map(|unknown| of(unknown.name, input.name)).collect()
        };
        derivation.inputs.iter().map(of_input).collect()
    };
    let quotients = names(&|of, by| format!("{of}/{by}"));

    let (mut single, mut derivatives, mut displacements) = (Vec::new(), Vec::new(), Vec::new());
    for (input, of_input) in quotients.iter().enumerate() {
        let unit = ratios.dims().1.unit(input);
        let column = ratios.column(input);
        single.extend(numbers(of_input, column, unknown_rates(unit)?));
        let step = steps.part(input);
        let quotient = |step: f64| {
            let [after, before] = [moved(unit * step)?, moved(unit * -step)?];
            Ok::<_, PositionErrorOf<M>>((after - before) / (2.0 * step))
        };
        let [far, near] = [quotient(2.0 * step)?, quotient(step)?];
        derivatives.extend(numbers(of_input, column, near + (near - far) / 3.0));
        let small = unit * step;
        let of_displacements = derivation.unknowns.iter().map(|unknown| format!("d {}", unknown.formula));
        let of_displacements: Vec<String> = of_displacements.collect();
        displacements.extend(numbers(&of_displacements, ratios * small, moved(small)?));
    }
    let rates: Vec<String> = derivation.unknowns.iter().map(|unknown| format!("{}_rate", unknown.name)).collect();
    let twice = unknown_rates(input_rates * 2.0)? * 0.5;
    let independent = numbers(&rates, ratios * input_rates, twice);

    let all_rates = velocity(input_rates)?;
    let (mut quantities, mut transmission) = (Vec::new(), Vec::new());
    let velocities = M::each_point(mechanism.point_velocities(&pose, &all_rates)?);
    let by_points = M::each_point(mechanism.point_ratios(&pose)?);
    for (point, (by_inputs, velocity)) in derivation.points.iter().zip(by_points.iter().zip(&velocities)) {
        let by_ratios = *by_inputs * input_rates;
        for (axis, name) in ["x", "y"].into_iter().enumerate() {
            let name = format!("{name}_{}", point.name);
            quantities.push(RatioNumber {
                name: format!("{name}_rate"),
                by_ratios: by_ratios.part(axis),
                otherwise: velocity[axis],
            });
            transmission.push((name, by_inputs.part(axis, 0), velocity[axis]));
        }
    }
    let rates = M::each_output(mechanism.output_rates(&pose, &all_rates)?);
    let by_outputs = M::each_output(mechanism.output_ratios(&pose)?);
    for (output, (by_inputs, rate)) in derivation.outputs.iter().zip(by_outputs.iter().zip(&rates)) {
        quantities.push(RatioNumber {
            name: format!("{}_rate", output.name),
            by_ratios: (*by_inputs * input_rates).part(0),
            otherwise: *rate,
        });
        transmission.push((output.name.to_owned(), by_inputs.part(0, 0), *rate));
    }
    let transmission = match (derivation.inputs, input_rates.as_slice()) {
        ([input], &[rate]) if rate != 0.0 => {
            let of_unknowns = derivation.unknowns.iter().zip(ratios.column(0)).zip(M::rate_parts(&all_rates).0);
            let of_unknowns =
                of_unknowns.map(|((unknown, ratio), velocity)| (unknown.name.to_owned(), ratio, velocity));
            let all = of_unknowns.chain(transmission).map(|(name, by_ratios, velocity)| RatioNumber {
                name: format!("{name}/{}", input.name),
                by_ratios,
                otherwise: velocity / rate,
            });
            all.collect()
        }
        _ => Vec::new(),
    };
    let statements = Language::English.words().statements;
    let all = [single, derivatives, independent, displacements, quantities, transmission];
    let mut all = all.into_iter();
    Ok(statements.map(|statement| RatioProperty { statement, numbers: all.next().unwrap_or_default() }))
}

/// Numbers by name, in two ways.
fn numbers(
    names: &[String],
    by_ratios: impl IntoIterator<Item = f64>,
    otherwise: impl IntoIterator<Item = f64>,
) -> Vec<RatioNumber> {
    let pairs = names.iter().cloned().zip(by_ratios).zip(otherwise);
    pairs.map(|((name, by_ratios), otherwise)| RatioNumber { name, by_ratios, otherwise }).collect()
}

/// The statement, and a line for each number.
impl fmt::Display for RatioProperty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.statement)?;
        for RatioNumber { name, by_ratios, otherwise } in &self.numbers {
            writeln!(f, "  {name:<16} {:>16} {:>16}", number(*by_ratios), number(*otherwise))?;
        }
        Ok(())
    }
}
