//! Tables of motions.

use std::f64::consts::TAU;
use std::fmt::Display;

use linkage_runtime::kinematic::MotionOf;
use linkage_runtime::range_of_motion::{Driven, MotionEnd, RangeOfMotion, RangeOptions};
use linkage_runtime::{Assembly, BorrowedName, Dim, Kinematic, Mechanism, PathError, PathErrorOf};

use super::kink::{may_be_kink, next_to_kink};
use super::{Cause, Mark, Quantity, Table};

impl Table {
    /// One motion over a turn of the input, in equal steps from 0 to 2 pi, both included, at a constant input rate. It
    /// passes change points smoothly. Each row is a position of the motion that begins on this branch at the first input
    /// that has one; inputs that this motion does not reach have a row without a position. See [`Table::over`].
    ///
    /// # Errors
    /// [`PathError::Position`] if no input has a position on the branch, and those of [`RangeOfMotion::of`];
    /// [`PathError::NoDirection`] without steps.
    pub fn turn<M>(mechanism: &M, branch: M::Branch, steps: u32, rate: f64) -> Result<Self, PathErrorOf<M>>
    where
        M: Driven<Scalar = f64, Of: Assembly>,
    {
        Self::at(mechanism, branch, &turn(steps), rate)
    }

    /// One motion at these inputs; see [`Table::turn`].
    ///
    /// # Errors
    /// Those of [`Table::turn`].
    pub fn at<M>(mechanism: &M, branch: M::Branch, inputs: &[f64], rate: f64) -> Result<Self, PathErrorOf<M>>
    where
        M: Driven<Scalar = f64, Of: Assembly>,
    {
        Ok(Self::over(&on_branch(mechanism, branch, inputs)?, inputs.iter().copied(), rate))
    }

    /// One motion at these inputs, in any order, at a constant input rate: the input, the time since the first input if the
    /// rate is not zero, then of each unknown the value, rate and acceleration, of each point x, y, its velocity and its
    /// acceleration, and of each output the value, rate and acceleration. Inputs that the motion does not reach, and ends
    /// at which a rate does not exist, have no more than the input and the time. Change points and the ends of the motion
    /// between the inputs are [`marks`](Self::marks).
    #[must_use]
    pub fn over<M>(range: &RangeOfMotion<'_, M>, inputs: impl IntoIterator<Item = f64>, rate: f64) -> Self
    where
        M: Driven<Scalar = f64>,
    {
        let mut table = Self::of_columns(columns(range.mechanism(), rate));
        let mut clock = Clock::new(rate);
        for input in inputs {
            let (row, motion) = row(range, input, &mut clock);
            match motion {
                Err(PathError::Position(error)) if may_be_kink(&error) && row.len() == table.columns.len() => {
                    table.push_kink(&row);
                }
                motion => table.push_partial(&row, motion.err().map(Cause::Path)),
            }
        }
        table.mark_motion(range);
        table
    }

    /// Marks the change points and the ends of a motion between the inputs of the table.
    pub(super) fn mark_motion<M: Driven<Scalar = f64>>(&mut self, range: &RangeOfMotion<'_, M>) {
        let Some(inputs) = self.columns.first() else { return };
        let wide = |[low, high]: [f64; 2], value: &f64| [low.min(*value), high.max(*value)];
        let [least, most] = inputs.values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], wide);
        let ends = range.ends().into_iter().zip(range.inputs()).filter_map(|(end, at)| Some((name_of(end)?, at)));
        let crossings = range.crossings().map(|crossing| ("change point".to_owned(), crossing.input));
        let turn = if range.mechanism().input_angles()[0] { TAU } else { 0.0 };
        let column = inputs.name.clone();
        for (name, at) in crossings.chain(ends) {
            for at in [at - turn, at, at + turn].into_iter().filter(|at| (least..=most).contains(at)) {
                let mark = Mark { column: column.clone(), at, name: name.clone() };
                if !self.marks.contains(&mark) {
                    self.marks.push(mark);
                }
            }
        }
    }
}

/// The inputs of a turn, in equal steps.
pub(super) fn turn(steps: u32) -> Vec<f64> {
    (0..=steps).filter(|_| steps > 0).map(|step| TAU * f64::from(step) / f64::from(steps)).collect()
}

/// The motion through change points that begins on a branch.
pub(super) fn on_branch<'a, M>(
    mechanism: &'a M,
    branch: M::Branch,
    inputs: &[f64],
) -> Result<RangeOfMotion<'a, M>, PathErrorOf<M>>
where
    M: Driven<Scalar = f64, Of: Assembly>,
{
    RangeOfMotion::on_branch(mechanism, branch, inputs.iter().copied(), RangeOptions::through_change_points())
}

/// The time at each input of a motion with a constant rate.
pub(super) struct Clock {
    rate: f64,
    first: Option<f64>,
}

impl Clock {
    pub(super) fn new(rate: f64) -> Self {
        Self { rate, first: None }
    }

    /// The time since the first input; none at rest.
    pub(super) fn at(&mut self, input: f64) -> Option<f64> {
        let first = *self.first.get_or_insert(input);
        (self.rate != 0.0).then(|| (input - first) / self.rate)
    }
}

/// The motion at a row. The error owns its names, since a table does.
type AtRow<M> = Result<MotionOf<M>, PathError<String>>;

/// The cells of a row as far as they exist, at a kink NaN for those that do not, and the motion.
pub(super) fn row<M: Driven<Scalar = f64>>(
    range: &RangeOfMotion<'_, M>,
    input: f64,
    clock: &mut Clock,
) -> (Vec<f64>, AtRow<M::Of>) {
    let mut row: Vec<f64> = [input].into_iter().chain(clock.at(input)).collect();
    let motion = range.motion(input, clock.rate, 0.0);
    let motion = motion.map_err(|error| error.map_names(|name| name.to_string()));
    match &motion {
        Ok(motion) => row.extend(numbers(range.mechanism(), motion)),
        Err(PathError::Position(error)) if may_be_kink(error) => {
            let [least, largest] = range.inputs();
            let unit = f64::EPSILON * input.abs().max(largest - least);
            let next = |distance| {
                let motion = range.motion(input + distance * unit, clock.rate, 0.0).ok()?;
                Some(numbers(range.mechanism(), &motion))
            };
            let columns = columns(range.mechanism(), clock.rate);
            let names: Vec<&str> = columns.iter().skip(row.len()).map(|(name, _)| name.as_str()).collect();
            row.extend(next_to_kink(&names, next).into_iter().flatten());
        }
        Err(_) => {}
    }
    (row, motion)
}

/// The reason of an end as the name of a mark.
fn name_of<N: BorrowedName>(end: MotionEnd<N>) -> Option<String> {
    match end {
        MotionEnd::DeadPoint { .. } => Some("dead point".to_owned()),
        MotionEnd::ChangePoint { .. } => Some("change point".to_owned()),
        MotionEnd::JointRange { of, .. } => Some(format!("end of {of}")),
        MotionEnd::Range | MotionEnd::Closed { .. } | MotionEnd::Open => None,
    }
}

/// The columns of a motion.
pub(super) fn columns<M: Driven>(mechanism: &M, rate: f64) -> Vec<(String, Quantity)> {
    let is_own = is_the_input(mechanism);
    let parameter = match (is_own, mechanism.input_angles().first()) {
        (true, Some(&is_angle)) => of_coordinate(is_angle, 0),
        _ => Quantity::Plain,
    };
    let parameter = [(mechanism.input_name(0).to_string(), parameter)].into_iter();
    let time = (rate != 0.0).then(|| ("time".to_owned(), Quantity::Time));
    let of = mechanism.driven();
    let inputs = if is_own { Vec::new() } else { inputs(of) };
    parameter.chain(time).chain(inputs).chain(unknowns(of)).chain(points_and_outputs(of)).collect()
}

fn of_coordinate(is_angle: bool, order: u8) -> Quantity {
    if is_angle { Quantity::Angle(order) } else { Quantity::Length(order) }
}

/// The columns of the inputs.
pub(super) fn inputs<M: Mechanism>(mechanism: &M) -> Vec<(String, Quantity)> {
    coordinates((0..).map(|place| mechanism.input_name(place)), mechanism.input_angles())
}

/// The columns of the unknowns.
pub(super) fn unknowns<M: Mechanism>(mechanism: &M) -> Vec<(String, Quantity)> {
    coordinates((0..).map(|place| mechanism.unknown_name(place)), mechanism.unknown_angles())
}

/// The columns of coordinates: value, rate and acceleration of each.
fn coordinates(names: impl Iterator<Item: Display>, are_angles: &[bool]) -> Vec<(String, Quantity)> {
    let each = names.zip(are_angles).flat_map(|(name, &is_angle)| {
        let ends = [(0, ""), (1, "_rate"), (2, "_acceleration")];
        ends.map(|(order, end)| (format!("{name}{end}"), of_coordinate(is_angle, order)))
    });
    each.collect()
}

/// The columns of points and outputs.
pub(super) fn points_and_outputs<M: Kinematic>(mechanism: &M) -> impl Iterator<Item = (String, Quantity)> {
    let points = names(|place| mechanism.point_name(place)).flat_map(|point| {
        let columns = [
            (0, "x"),
            (0, "y"),
            (1, "velocity_x"),
            (1, "velocity_y"),
            (1, "speed"),
            (2, "acceleration_x"),
            (2, "acceleration_y"),
        ];
        columns.map(|(order, of)| (format!("{point}_{of}"), Quantity::Length(order)))
    });
    let outputs = names(|place| mechanism.output_name(place))
        .flat_map(|output| ["", "_rate", "_acceleration"].map(|end| (format!("{output}{end}"), Quantity::Plain)));
    points.chain(outputs)
}

/// The names by place, up to the first empty one, which is that beyond the last.
pub(crate) fn names<N: Display>(name: impl Fn(usize) -> N) -> impl Iterator<Item = String> {
    (0..).map(move |place| name(place).to_string()).take_while(|name| !name.is_empty())
}

/// True if the parameter is the input of the mechanism itself.
fn is_the_input<M: Driven>(mechanism: &M) -> bool {
    let of = mechanism.driven();
    of.dims().1.count() == 1 && of.input_name(0) == mechanism.input_name(0)
}

/// The numbers of a motion in the order of their columns.
fn numbers<M: Driven<Scalar = f64>>(mechanism: &M, motion: &MotionOf<M::Of>) -> Vec<f64> {
    let (of_unknowns, of_inputs) = M::Of::parts(&motion.position);
    let (unknown_rates, input_rates) = M::Of::rate_parts(&motion.rates);
    let (unknown_accelerations, input_accelerations) = M::Of::acceleration_parts(&motion.accelerations);
    let mut row = Vec::new();
    if !is_the_input(mechanism) {
        let moving = of_inputs.iter().zip(&input_rates).zip(&input_accelerations);
        row.extend(moving.flat_map(|((value, rate), acceleration)| [value, rate, acceleration]));
    }
    let moving = of_unknowns.iter().zip(&unknown_rates).zip(&unknown_accelerations);
    row.extend(moving.flat_map(|((value, rate), acceleration)| [value, rate, acceleration]));
    for point in M::Of::each_point(motion.points) {
        let (at, velocity, acceleration) = (point.position, point.velocity, point.acceleration);
        row.extend([at.x, at.y, velocity.x, velocity.y, velocity.norm(), acceleration.x, acceleration.y]);
    }
    for output in M::Of::each_output(motion.outputs) {
        row.extend([output.value, output.rate, output.acceleration]);
    }
    row
}
