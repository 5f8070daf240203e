//! Tables of simulations.

use linkage_dynamics::contact::Change;
use linkage_dynamics::integrate::Method;
use linkage_dynamics::simulation::{Loads, Simulation, State, Watch};
use linkage_dynamics::{Accelerations, Coordinates, Energy, Inputs, MotionErrorOf, NameOf, Power, Scene};
use linkage_runtime::{Build, Column, Kinematic, Mechanism, PositionErrorOf};

use super::kink::{may_be_kink, next_to_kink};
use super::motion::{inputs, points_and_outputs, unknowns};
use super::scene::{contact_names, energy_columns, load_columns, numbers, of_energy, of_power, power_columns};
use super::{Cause, Mark, Missing, Quantity, Table};

impl Table {
    /// The rest of a simulation, a row for its state and for each step and each event until its end: the time, of each
    /// coordinate and each output the value, rate and acceleration, of each point x, y, its velocity and its acceleration,
    /// and the loads, energies and powers as in [`Table::over_with_loads`], with the forces of the inputs that the scene drives.
    ///
    /// Events, kinks and changes of frictions and stops are [`marks`](Self::marks) of the column `time`. At an event the
    /// rates are those before it, and accelerations and loads those after it; where the rates jump, points and outputs have
    /// no acceleration. If the simulation ends with an error, the rows before it remain, and the last of
    /// [`missing`](Self::missing) has the error.
    ///
    /// ```
    /// linkage::linkage! {
    ///     /// A pendulum that hits a wall.
    ///     pub mechanism Pendulum {
    ///         param l = 1, m = 2, g = 9.81;
    ///         input phi;
    ///         point Tip = l@phi;
    ///         body bob { mass m; center Tip; }
    ///         scene Swing {
    ///             inertia;
    ///             gravity (0, -g);
    ///             stop phi in -2..4, restitution 0.5;
    ///             reaction at (0, 0);
    ///         }
    ///     }
    /// }
    /// use linkage::Table;
    /// use linkage::chart::Chart;
    /// use linkage::simulation::{Start, simulate};
    ///
    /// let scene = Swing::default();
    /// let start = Start { t: 0.0, q: PendulumCoordinates { phi: 0.0 }, input_rates: 0.0 };
    /// let times = (0..=200).map(|step| f64::from(step) / 100.0);
    /// let table = Table::simulated_at(&mut simulate(&scene, start, 2.0, 1e-9)?, times);
    /// assert_eq!((table.len(), table.marks()[0].name.as_str()), (201, "stop on phi is hit"));
    /// // The events are dashed lines.
    /// let svg = Chart::of(&table, "time", ["phi"])?.to_svg();
    /// assert!(svg.contains("stop on phi is hit"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn simulated<S, M, W>(simulation: &mut Simulation<'_, S, M, W>) -> Self
    where
        S: Scene<Scalar = f64, Mechanism: Kinematic>,
        M: Method,
        W: Watch<S>,
    {
        let mut rows = Rows::of(simulation);
        rows.push(simulation.scene(), simulation.state(), simulation.loads());
        loop {
            match simulation.advance() {
                Ok(Some(state)) => {
                    rows.mark(&state);
                    rows.push(simulation.scene(), &state, simulation.loads());
                }
                Ok(None) => break,
                Err(error) => {
                    let (row, cause) = (rows.table.len(), Cause::of_motion(error));
                    rows.table.missing.push(Missing { row, cause });
                    break;
                }
            }
        }
        rows.table
    }

    /// A simulation at these times, in its direction: as [`Table::simulated`], with the events between them as marks. Times
    /// that it does not reach have a row without numbers.
    pub fn simulated_at<S, M, W>(simulation: &mut Simulation<'_, S, M, W>, times: impl IntoIterator<Item = f64>) -> Self
    where
        S: Scene<Scalar = f64, Mechanism: Kinematic>,
        M: Method,
        W: Watch<S>,
    {
        let mut rows = Rows::of(simulation);
        let start = simulation.t();
        let mut is_over = false;
        for t in times {
            let is_ahead = |reached: f64| if t >= start { reached < t } else { reached > t };
            while !is_over && is_ahead(simulation.t()) {
                match simulation.advance() {
                    Ok(Some(state)) => rows.mark(&state),
                    Ok(None) => is_over = true,
                    Err(error) => {
                        is_over = true;
                        rows.error = Some(Cause::of_motion(error));
                    }
                }
            }
            let state = simulation.at([t]).next();
            match state {
                Some(Ok(state)) => rows.push(simulation.scene(), &state, simulation.loads()),
                Some(Err(error)) => {
                    let cause = rows.error.clone().unwrap_or_else(|| Cause::of_motion(error));
                    rows.push_missing(t, cause);
                }
                None => rows.push_missing(t, rows.error.clone().unwrap_or(Cause::Ended)),
            }
        }
        rows.table
    }
}

/// The rows of a simulation.
struct Rows<S: Scene> {
    table: Table,
    /// True for each input that the scene drives.
    is_driven: Column<bool, S::V>,
    /// The error with which the simulation has ended.
    error: Option<Cause>,
}

impl<S: Scene<Scalar = f64, Mechanism: Kinematic>> Rows<S> {
    fn of<M: Method, W: Watch<S>>(simulation: &Simulation<'_, S, M, W>) -> Self {
        let (scene, state) = (simulation.scene(), simulation.state());
        let is_driven = scene.prescribed(state.t).map(|law| law.is_some());
        let contacts = contact_names(scene, state.t, &state.q, &state.rates);
        let time = [("time".to_owned(), Quantity::Time)].into_iter();
        let has_energy = matches!(energy(scene, state), Ok(Some(_)));
        let has_power = matches!(power(scene, state), Ok(Some(_)));
        let loads = load_columns(scene, contacts.as_deref(), |input| is_driven[input]);
        let loads = loads.into_iter().chain(energy_columns(has_energy)).chain(power_columns(has_power));
        let m = scene.mechanism();
        let motion = time.chain(inputs(m)).chain(unknowns(m)).chain(points_and_outputs(m));
        Self { table: Table::of_columns(motion.chain(loads)), is_driven, error: None }
    }

    fn push(&mut self, scene: &S, state: &State<S>, loads: Result<Loads<S>, MotionErrorOf<S>>) {
        let accelerations = loads.as_ref().ok().map(|loads| loads.accelerations);
        let (mut row, error) = moving(scene, state, accelerations);
        let cause = match loads.and_then(|loads| Ok((loads, energy(scene, state)?, power(scene, state)?))) {
            Ok((loads, energy, power)) => {
                row.extend(numbers(scene, &loads, |input| self.is_driven[input]));
                row.extend(of_energy(energy).chain(of_power(power)));
                error
            }
            Err(error) => Some(Cause::of_motion(error)),
        };
        self.table.push_partial(&row, cause);
    }

    fn push_missing(&mut self, t: f64, cause: Cause) {
        self.table.push_partial(&[t], Some(cause));
    }

    /// Marks the events at a state.
    fn mark(&mut self, state: &State<S>) {
        let own = state.event.map(|event| format!("event {event}"));
        let kink = state.kink.map(|effect| format!("kink of {effect}"));
        let changes = state.changes().map(|(contact, change)| format!("{contact} {}", in_words(change)));
        let marks = own.into_iter().chain(kink).chain(changes);
        self.table.marks.extend(marks.map(|name| Mark { column: "time".to_owned(), at: state.t, name }));
    }
}

fn in_words(change: Change) -> &'static str {
    match change {
        Change::Sticks => "sticks",
        Change::Slips => "slips",
        Change::Impact => "is hit",
        Change::Rests => "holds",
        Change::LetsGo => "lets go",
    }
}

/// The energy at a state.
fn energy<S: Scene<Scalar = f64>>(scene: &S, state: &State<S>) -> Result<Option<Energy<f64>>, MotionErrorOf<S>> {
    let (_, rates) = S::Mechanism::rate_parts(&state.rates);
    scene.kinetic_and_potential(&state.q, &Inputs::<S>::from(rates))
}

/// The power at a state.
fn power<S: Scene<Scalar = f64>>(scene: &S, state: &State<S>) -> Result<Option<Power<f64>>, MotionErrorOf<S>> {
    let (_, rates) = S::Mechanism::rate_parts(&state.rates);
    scene.applied_and_dissipated(state.t, &state.q, &Inputs::<S>::from(rates))
}

/// The numbers of a state before its loads, NaN for those that do not exist, and why.
fn moving<S>(scene: &S, state: &State<S>, accelerations: Option<Accelerations<S>>) -> (Vec<f64>, Option<Cause>)
where
    S: Scene<Scalar = f64, Mechanism: Kinematic>,
{
    let (unknowns, inputs) = S::Mechanism::parts(&state.q);
    let nothing =
        || Accelerations::<S> { unknowns: unknowns.dim().repeat(f64::NAN), inputs: inputs.dim().repeat(f64::NAN) };
    let Accelerations::<S> { unknowns: of_unknowns, inputs: of_inputs } = accelerations.unwrap_or_else(nothing);
    let (unknown_rates, input_rates) = S::Mechanism::rate_parts(&state.rates);
    let mut row = vec![state.t];
    let each = inputs.iter().zip(&input_rates).zip(&of_inputs);
    row.extend(each.flat_map(|((value, rate), acceleration)| [value, rate, acceleration]));
    let each = unknowns.iter().zip(&unknown_rates).zip(&of_unknowns);
    row.extend(each.flat_map(|((value, rate), acceleration)| [value, rate, acceleration]));

    let jumps = jumps(state);
    let smooth = accelerations.filter(|_| !jumps).map(|all| S::Mechanism::accelerations(all.unknowns, all.inputs));
    let count = || points_and_outputs(scene.mechanism()).count();
    match quantities(scene.mechanism(), &state.q, &state.rates, smooth) {
        Ok(numbers) => {
            row.extend(numbers);
            (row, (jumps && count() > 0).then_some(Cause::Jump))
        }
        Err(error) => {
            let next = |distance| {
                let q = next_to::<S>(state, distance)?;
                quantities(scene.mechanism(), &q, &state.rates, smooth).ok()
            };
            let columns: Vec<String> = points_and_outputs(scene.mechanism()).map(|(name, _)| name).collect();
            let names: Vec<&str> = columns.iter().map(String::as_str).collect();
            let Some(numbers) = may_be_kink(&error).then(|| next_to_kink(&names, next)).flatten() else {
                row.extend(std::iter::repeat_n(f64::NAN, count()));
                return (row, Some(Cause::of_motion::<NameOf<S>>(error.into())));
            };
            let missing = columns.into_iter().zip(&numbers).filter(|(_, number)| number.is_nan());
            let missing: Vec<String> = missing.map(|(name, _)| name).collect();
            row.extend(numbers);
            let cause = if jumps { Cause::Jump } else { Cause::Kink(missing) };
            (row, Some(cause))
        }
    }
}

/// The position at so many units in the last place along the motion.
fn next_to<S: Scene<Scalar = f64>>(state: &State<S>, distance: f64) -> Option<Coordinates<S>> {
    let ((unknowns, inputs), (of_unknowns, of_inputs)) =
        (S::Mechanism::parts(&state.q), S::Mechanism::rate_parts(&state.rates));
    let largest = |all: &mut dyn Iterator<Item = &f64>| all.fold(0.0_f64, |most, number| most.max(number.abs()));
    let size = largest(&mut unknowns.iter().chain(&inputs));
    let speed = largest(&mut of_unknowns.iter().chain(&of_inputs));
    let time = distance * f64::EPSILON * if size > 0.0 { size / speed } else { state.t.abs() };
    time.is_finite().then(|| S::Mechanism::coordinates(unknowns + of_unknowns * time, inputs + of_inputs * time))
}

/// The numbers of points and outputs, with NaN where there are no accelerations.
fn quantities<M: Kinematic<Scalar = f64>>(
    mechanism: &M,
    q: &M::Coordinates,
    rates: &M::Rates,
    accelerations: Option<M::Accelerations>,
) -> Result<Vec<f64>, PositionErrorOf<M>> {
    let pose = mechanism.pose_at(q);
    let mut row = Vec::new();
    let second = accelerations.map(|second| mechanism.point_accelerations(&pose, rates, &second)).transpose()?;
    let second = second.map(M::each_point);
    let (points, velocities) = (mechanism.points(&pose)?, mechanism.point_velocities(&pose, rates)?);
    for (place, (at, velocity)) in M::each_point(points).iter().zip(&M::each_point(velocities)).enumerate() {
        let [x, y] = second.map_or([f64::NAN; 2], |second| [second[place].x, second[place].y]);
        row.extend([at.x, at.y, velocity.x, velocity.y, velocity.norm(), x, y]);
    }
    let second = accelerations.map(|second| mechanism.output_accelerations(&pose, rates, &second)).transpose()?;
    let second = second.map(M::each_output);
    let (outputs, output_rates) = (mechanism.outputs(&pose)?, mechanism.output_rates(&pose, rates)?);
    for (place, (value, rate)) in M::each_output(outputs).iter().zip(&M::each_output(output_rates)).enumerate() {
        row.extend([*value, *rate, second.map_or(f64::NAN, |second| second[place])]);
    }
    Ok(row)
}

/// True if the rates may jump at this state.
fn jumps<S: Scene>(state: &State<S>) -> bool {
    let mut changes = state.changes();
    state.event.is_some()
        || state.kink.is_some()
        || changes.any(|(_, change)| matches!(change, Change::Impact | Change::Rests))
}
