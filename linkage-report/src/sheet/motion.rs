//! The numbers of a motion at one position.

use std::fmt::Display;

use linkage_runtime::kinematic::MotionOf;
use linkage_runtime::{Dim, Kinematic, OutputMotion, PointMotion, PositionErrorOf};

use super::{Caption, Table, Values};

/// A coordinate of a motion at one position.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingCoordinate {
    /// The name in the `linkage!` language.
    pub name: String,
    /// True for an angle, which a sheet has in degrees as well.
    pub is_angle: bool,
    /// The value, the rate and the acceleration.
    pub motion: [f64; 3],
}

/// The numbers of a motion at one position, by name: a sheet shows them with the formulas and as tables.
///
/// ```
/// use linkage::linkage;
/// use linkage::sheet::{Language, MotionNumbers, Sheet};
///
/// linkage! {
///     mechanism Crank {
///         param r = 2;
///         input phi;
///         unknown x, y;
///         loop r@phi = (x, y);
///     }
/// }
/// let crank = Crank::default();
/// let q = CrankCoordinates { phi: 0.0, x: 2.0, y: 0.0 };
/// let motion = crank.motion(&q, 3.0, 0.0)?;
/// let mut sheet = Sheet::new(Crank::<f64>::DERIVATION);
/// sheet.given("r", 2.0).motion(&MotionNumbers::of(&crank, &motion)?).language(Language::Italian);
/// let text = sheet.to_text();
/// assert!(text.contains("Velocità\n    phi_rate  3\n"), "{text}");
/// # Ok::<(), linkage::PositionError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MotionNumbers {
    /// The inputs.
    pub inputs: Vec<MovingCoordinate>,
    /// The unknowns.
    pub unknowns: Vec<MovingCoordinate>,
    /// The points by name.
    pub points: Vec<(String, PointMotion<f64>)>,
    /// The outputs by name.
    pub outputs: Vec<(String, OutputMotion<f64>)>,
    /// The velocity ratios of each unknown by all inputs.
    pub ratios: Vec<Vec<f64>>,
    /// True if rates and accelerations are shown.
    pub has_rates: bool,
}

impl MotionNumbers {
    /// The numbers of a motion of a mechanism, with its rates and accelerations.
    ///
    /// # Errors
    /// [`PositionError`](linkage_runtime::PositionError) if J is singular at the position.
    pub fn of<M: Kinematic<Scalar = f64>>(mechanism: &M, motion: &MotionOf<M>) -> Result<Self, PositionErrorOf<M>> {
        let ratios = mechanism.velocity_ratios(&mechanism.pose_at(&motion.position))?;
        let (unknowns, inputs) = M::parts(&motion.position);
        let (unknown_rates, input_rates) = M::rate_parts(&motion.rates);
        let (unknown_accelerations, input_accelerations) = M::acceleration_parts(&motion.accelerations);
        let of_unknowns = [unknowns.as_slice(), unknown_rates.as_slice(), unknown_accelerations.as_slice()];
        let of_inputs = [inputs.as_slice(), input_rates.as_slice(), input_accelerations.as_slice()];
        let points = M::each_point(motion.points).into_iter().enumerate();
        let outputs = M::each_output(motion.outputs).into_iter().enumerate();
        Ok(Self {
            inputs: coordinates(|place| mechanism.input_name(place), mechanism.input_angles(), of_inputs),
            unknowns: coordinates(|place| mechanism.unknown_name(place), mechanism.unknown_angles(), of_unknowns),
            points: points.map(|(place, point)| (mechanism.point_name(place).to_string(), point)).collect(),
            outputs: outputs.map(|(place, output)| (mechanism.output_name(place).to_string(), output)).collect(),
            ratios: (0..mechanism.dims().0.count())
                .map(|of| ratios.columns().into_iter().map(|column| column.part(of)).collect())
                .collect(),
            has_rates: true,
        })
    }

    /// The numbers of all names in formulas, with these parameters.
    pub(super) fn values(&self, parameters: &[(String, f64)]) -> Values {
        let mut values = Values::default();
        for (name, value) in parameters {
            values.set(name, 0, *value);
        }
        let orders = if self.has_rates { 3 } else { 1 };
        for MovingCoordinate { name, motion, .. } in self.inputs.iter().chain(&self.unknowns) {
            for (order, value) in motion.iter().enumerate().take(orders) {
                values.set(name, order, *value);
            }
        }
        for (of, ratios) in self.unknowns.iter().zip(&self.ratios) {
            for (by, ratio) in self.inputs.iter().zip(ratios) {
                values.set_ratio(&of.name, &by.name, *ratio);
            }
        }
        values
    }

    /// The numbers that no equation has: coordinates, and with rates of the inputs all rates and accelerations.
    pub(super) fn tables(&self) -> Vec<Table> {
        let coordinates = || self.inputs.iter().chain(&self.unknowns);
        let values = coordinates().map(|of| (of.name.clone(), of.motion[0]));
        let angles = coordinates().filter(|of| of.is_angle).map(|of| (of.name.clone(), of.motion[0].to_degrees()));
        let mut tables = vec![(Caption::Position, values.collect()), (Caption::Degrees, angles.collect())];
        if self.has_rates {
            tables.push((Caption::Velocities, self.derivatives(1)));
            tables.push((Caption::Accelerations, self.derivatives(2)));
        }
        let tables = tables.into_iter().filter(|(_, rows): &(_, Vec<_>)| !rows.is_empty());
        tables.map(|(caption, rows)| Table { caption, rows }).collect()
    }

    /// The rates of all, or the accelerations; an input at a constant rate has none of these.
    fn derivatives(&self, order: usize) -> Vec<(String, f64)> {
        let end = ["", "_rate", "_acceleration"][order];
        let inputs = self.inputs.iter().filter(|input| order == 1 || input.motion[order] != 0.0);
        let coordinates = inputs.chain(&self.unknowns).map(|of| (format!("{}{end}", of.name), of.motion[order]));
        let points = self.points.iter().flat_map(|(name, of)| {
            let vector = if order == 1 { of.velocity } else { of.acceleration };
            [("x", vector.x), ("y", vector.y)].map(|(axis, value)| (format!("{axis}_{name}{end}"), value))
        });
        let outputs = self.outputs.iter().map(|(name, of)| {
            let value = if order == 1 { of.rate } else { of.acceleration };
            (format!("{name}{end}"), value)
        });
        coordinates.chain(points).chain(outputs).collect()
    }
}

/// Coordinates by their names, with their values, rates and accelerations.
fn coordinates<N: Display>(
    name: impl Fn(usize) -> N,
    are_angles: &[bool],
    [values, rates, accelerations]: [&[f64]; 3],
) -> Vec<MovingCoordinate> {
    let numbers = values.iter().zip(rates).zip(accelerations);
    let each = numbers.zip(are_angles).enumerate().map(|(place, (((value, rate), acceleration), is_angle))| {
        let motion = [*value, *rate, *acceleration];
        MovingCoordinate { name: name(place).to_string(), is_angle: *is_angle, motion }
    });
    each.collect()
}
