//! The algorithms for all mechanisms, scenes or systems, called with types that count their evaluations.

use std::fmt::Debug;

use linkage::accuracy::{Newton, PositionMethod, Reached, Table};
use linkage::continuation::{AtChangePoint, Direction, Options, Path};
use linkage::integrate::{Action, Crossing, FixedStep, Interpolant, Tolerance, dop853, dopri5, watched};
use linkage::nalgebra::{SMatrix, SVector};
use linkage::position::{newton, newton_any_branch, newton_step};
use linkage::simulation::{Start, simulate};
use linkage::singularity::{accuracy, report, sigma_min};
use linkage::Kink;
use linkage::{
    Bearing, Column, Contact, D, Dim, Equations, Group, Matrix, Mechanism, MotionError, PathError, PerInput, PerUnknown,
    PositionError, Ranged, Prescribed, Scene, StateParts, Unreduced,
};

use super::draw::{coordinates, rates};
use super::tally::evaluated;
use super::{Draw, Pool, Source, Tally};
use crate::called::Numbers;

/// A mechanism whose positions are counted.
struct Counted<'a, M>(&'a M);

impl<M: Mechanism<Scalar = f64>> Mechanism for Counted<'_, M> {
    type Scalar = f64;
    type Name = M::Name;
    type U = M::U;
    type V = M::V;
    type G = M::G;
    type Coordinates = M::Coordinates;
    type Rates = M::Rates;
    type Inputs = M::Inputs;
    type Pose = M::Pose;
    type Branch = M::Branch;

    const NAME: &'static str = M::NAME;
    const UNKNOWNS: &'static [&'static str] = M::UNKNOWNS;
    const INPUTS: &'static [&'static str] = M::INPUTS;
    const UNKNOWN_ANGLES: &'static [bool] = M::UNKNOWN_ANGLES;
    const INPUT_ANGLES: &'static [bool] = M::INPUT_ANGLES;
    const GROUPS: &'static [Group<'static>] = M::GROUPS;
    const RANGES: &'static [&'static str] = M::RANGES;

    fn coordinates(unknowns: PerUnknown<M>, inputs: PerInput<M>) -> M::Coordinates {
        M::coordinates(unknowns, inputs)
    }
    fn parts(q: &M::Coordinates) -> (PerUnknown<M>, PerInput<M>) {
        M::parts(q)
    }
    fn rates(unknowns: PerUnknown<M>, inputs: PerInput<M>) -> M::Rates {
        M::rates(unknowns, inputs)
    }
    fn rate_parts(rates: &M::Rates) -> (PerUnknown<M>, PerInput<M>) {
        M::rate_parts(rates)
    }
    fn pose_at(&self, q: &M::Coordinates) -> M::Pose {
        evaluated();
        self.0.pose_at(q)
    }
    fn is_finite(pose: &M::Pose) -> bool {
        M::is_finite(pose)
    }
    fn branch_of(&self, pose: &M::Pose) -> M::Branch {
        self.0.branch_of(pose)
    }
    fn residual(&self, pose: &M::Pose) -> PerUnknown<M> {
        self.0.residual(pose)
    }
    fn residual_scales(&self, pose: &M::Pose) -> PerUnknown<M> {
        self.0.residual_scales(pose)
    }
    fn jacobian_unknowns(&self, pose: &M::Pose) -> Matrix<f64, M::U, M::U> {
        self.0.jacobian_unknowns(pose)
    }
    fn jacobian_inputs(&self, pose: &M::Pose) -> Matrix<f64, M::U, M::V> {
        self.0.jacobian_inputs(pose)
    }
    fn jacobian_unknowns_scales(&self, pose: &M::Pose) -> Matrix<f64, M::U, M::U> {
        self.0.jacobian_unknowns_scales(pose)
    }
    fn jacobian_inputs_scales(&self, pose: &M::Pose) -> Matrix<f64, M::U, M::V> {
        self.0.jacobian_inputs_scales(pose)
    }
    fn determinant(&self, pose: &M::Pose) -> f64 {
        self.0.determinant(pose)
    }
    fn block_determinants(&self, pose: &M::Pose) -> Column<f64, M::G> {
        self.0.block_determinants(pose)
    }
    fn gamma(&self, pose: &M::Pose, rates: &M::Rates) -> PerUnknown<M> {
        self.0.gamma(pose, rates)
    }
    fn solve_jacobian(&self, pose: &M::Pose, right: &PerUnknown<M>) -> Result<PerUnknown<M>, PositionError<M::Name>> {
        self.0.solve_jacobian(pose, right)
    }
    fn length_scale(&self, pose: &M::Pose) -> f64 {
        self.0.length_scale(pose)
    }
    fn ranged(&self, place: usize, q: &M::Coordinates) -> Option<Ranged<f64>> {
        self.0.ranged(place, q)
    }
}

/// A scene whose positions and equations are counted.
struct CountedScene<'a, S: Scene> {
    scene: &'a S,
    mechanism: Counted<'a, S::Mechanism>,
}

/// Coordinates, rates and inputs of a mechanism by name.
type Q<S> = <<S as Scene>::Mechanism as Mechanism>::Coordinates;
type Rates<S> = <<S as Scene>::Mechanism as Mechanism>::Rates;
type Inputs<S> = <<S as Scene>::Mechanism as Mechanism>::Inputs;

impl<'a, S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>> Scene for CountedScene<'a, S> {
    type Scalar = f64;
    type U = S::U;
    type V = S::V;
    type State = S::State;
    type Contacts = S::Contacts;
    type Mechanism = Counted<'a, S::Mechanism>;
    type Reactions = S::Reactions;

    const NAME: &'static str = S::NAME;
    const BEARINGS: bool = S::BEARINGS;

    fn mechanism(&self) -> &Counted<'a, S::Mechanism> {
        &self.mechanism
    }
    fn state(q: &Q<S>, input_rates: &Inputs<S>) -> Column<f64, S::State> {
        S::state(q, input_rates)
    }
    fn parts(state: &Column<f64, S::State>) -> StateParts<Q<S>, Inputs<S>> {
        S::parts(state)
    }
    fn check(&self) -> Result<(), MotionError> {
        self.scene.check()
    }
    fn derivative(&self, t: f64, state: &Column<f64, S::State>) -> Result<Column<f64, S::State>, MotionError> {
        evaluated();
        self.scene.derivative(t, state)
    }
    fn equations(&self, t: f64, state: &Column<f64, S::State>) -> Result<Equations<f64, S::U, S::V>, MotionError> {
        evaluated();
        self.scene.equations(t, state)
    }
    fn contacts(
        &self,
        t: f64,
        q: &Q<S>,
        rates: &Rates<S>,
    ) -> Result<Column<Contact<f64, S::U, S::V>, S::Contacts>, MotionError> {
        self.scene.contacts(t, q, rates)
    }
    fn bearings(
        &self,
        t: f64,
        q: &Q<S>,
        rates: &Rates<S>,
    ) -> Result<Column<Option<Bearing<f64, S::U, S::V, S::Contacts>>, S::Contacts>, MotionError> {
        self.scene.bearings(t, q, rates)
    }
    fn reactions(
        &self,
        t: f64,
        q: &Q<S>,
        rates: &Rates<S>,
        accelerations: &linkage::Accelerations<S>,
        contact_forces: &Column<f64, S::Contacts>,
    ) -> Result<S::Reactions, MotionError> {
        self.scene.reactions(t, q, rates, accelerations, contact_forces)
    }
    fn unreduced(&self, t: f64, q: &Q<S>, rates: &Rates<S>) -> Result<Unreduced<f64, S::U, S::V>, MotionError> {
        self.scene.unreduced(t, q, rates)
    }
    const KINKS: &'static [Kink] = S::KINKS;

    fn kink(&self, place: usize, t: f64, q: &Q<S>, rates: &Rates<S>) -> f64 {
        self.scene.kink(place, t, q, rates)
    }
    fn gap_changes(&self, q: &Q<S>, moves: &Rates<S>) -> Column<Option<f64>, S::Contacts> {
        self.scene.gap_changes(q, moves)
    }
    fn prescribed(&self, t: f64) -> Column<Option<Prescribed<f64>>, S::V> {
        self.scene.prescribed(t)
    }
}

/// Expensive functions are called in one trial of this many.
const SELDOM: usize = 40;

/// Positions of a mechanism, if there are any.
fn found<M>(m: &M, s: &mut Source, positions: &mut Pool<M::Coordinates>)
where
    M: Mechanism<Scalar = f64, Name = &'static str, U: Default, V: Default>,
{
    for _ in 0..2 {
        if let Ok(found) = newton_any_branch(m, &coordinates::<M>(s)) {
            positions.keep(found.coordinates);
        }
    }
}

/// The algorithms for any mechanism, whose poses `pose` makes.
pub fn mechanism<M>(
    t: &mut Tally,
    s: &mut Source,
    m: &M,
    positions: &mut Pool<M::Coordinates>,
    pose: fn(&mut dyn Numbers, &M) -> M::Pose,
) where
    M: Mechanism<Scalar = f64, Name = &'static str, U: Default, V: Default, Pose: Debug + Copy>,
{
    let (new, mut poses) = (coordinates::<M>, Pool::default());
    let counted = &Counted(m);
    for _ in 0..2 {
        let guess = positions.take(s, new);
        if let Some(found) = t.fallible(s, "newton_any_branch", || newton_any_branch(counted, &guess)) {
            positions.keep(found.coordinates);
            poses.keep(m.pose_at(&found.coordinates));
        }
    }
    let guess = positions.take(s, new);
    if let Some(found) = t.fallible(s, "newton", || newton(counted, &guess)) {
        positions.keep(found.coordinates);
    }
    let q = positions.take(s, new);
    if let Some(q) = t.fallible(s, "newton_step", || newton_step(counted, &q)) {
        positions.keep(q);
    }
    let (q, there) = (positions.take(s, new), PerInput::<M>::draw(s));
    t.fallible(s, "accuracy::Newton", || Newton::<2>::position(counted, &Reached::at(counted, q), there));
    let (q, input_rates) = (positions.take(s, new), PerInput::<M>::draw(s));
    let (mass, forces) = (Matrix::<f64, M::V, M::V>::draw(s), PerInput::<M>::draw(s));
    t.fallible(s, "Equations::at", || Equations::at(counted, &q, input_rates, mass, forces));
    if s.below(4) == 0 {
        let pose = poses.take(s, |s| pose(s, m));
        t.fallible(s, "singularity::report", || {
            let of = report(counted, &pose)?;
            let groups: Vec<_> = of.groups().map(|of| [of.determinant, of.regularity, of.sigma_min]).collect();
            let (free, admissible): (Vec<_>, Vec<_>) = (of.free().collect(), of.admissible().collect());
            Ok::<_, PositionError>(([of.determinant(), of.sigma_min()], groups, free, admissible, of.drivers().collect::<Vec<_>>()))
        });
        t.fallible(s, "singularity::sigma_min", || sigma_min(counted, &pose));
        t.fallible(s, "singularity::accuracy", || {
            // Where a position is singular, its attainable error may be infinite.
            accuracy(counted, &pose).map(|of| {
                (of.residual, of.sigma_min, (of.sigma_min >= f64::MIN_POSITIVE).then(|| of.attainable()))
            })
        });
    }
}

/// The algorithms for any mechanism with one input.
pub fn driven<M>(t: &mut Tally, s: &mut Source, m: &M, positions: &mut Pool<M::Coordinates>)
where
    M: Mechanism<Scalar = f64, Name = &'static str, U: Default, V = D<1>, Pose: Debug>,
{
    if s.below(SELDOM) > 0 {
        return;
    }
    let (new, m) = (coordinates::<M>, &Counted(m));
    let (start, end) = (positions.take(s, new), s.number());
    let (is_turn, mut table) = (s.below(2) == 0, None);
    // A table by its error; its entries show in the positions that it gives.
    t.fallible(s, if is_turn { "Table::turn" } else { "Table::between" }, || {
        let found = if is_turn { Table::<_, 9>::turn(m, &start) } else { Table::<_, 9>::between(m, &start, end) }?;
        let error = found.error();
        table = Some(found);
        Ok::<_, PathError>(error)
    });
    if let Some(table) = table {
        for _ in 0..4 {
            let input = PerInput::<M>::draw(s);
            t.fallible(s, "Table::position", || Table::position(m, &table, input));
        }
    }
    let direction = match s.below(3) {
        0 => Direction::Increasing,
        1 => Direction::Decreasing,
        _ => Direction::Along(rates::<M>(s)),
    };
    let at_change_point = [AtChangePoint::Keep, AtChangePoint::Switch, AtChangePoint::Stop][s.below(3)];
    let range = (s.below(4) == 0).then(|| [s.number(), s.number()]);
    let mut options = Options { most_steps: 20, at_change_point, range, ..Options::default() };
    if s.below(4) == 0 {
        (options.longest_step, options.largest_turn) = (s.number(), s.number());
    }
    let mut path = None;
    t.fallible(s, "Path::with", || {
        let begun = Path::with(m, &start, direction, options)?;
        let found = (begun.position(), begun.rates());
        path = Some(begun);
        Ok::<_, PathError>(found)
    });
    let Some(mut path) = path else { return };
    for _ in 0..8 {
        match s.below(8) {
            0..=3 => t.fallible(s, "Path::advance", || path.advance()).is_some(),
            4 => {
                t.fallible(s, "Path::advance_watching", || path.advance_watching(|q, _| M::unknowns(q).sum())).is_some()
            }
            5 => {
                let input = s.number();
                t.fallible(s, "Path::advance_to", || path.advance_to(input)).is_some()
            }
            6 => {
                let rates = rates::<M>(s);
                t.fallible(s, "Path::choose", || path.choose(&rates)).is_some()
            }
            _ => t.total(s, "Path::turn_back", || path.turn_back()).is_some(),
        };
        t.fallible(s, "Path::position", || Ok::<_, PathError>((path.position(), path.rates())));
    }
}

/// The algorithms for any scene.
pub fn scene<S, M>(t: &mut Tally, s: &mut Source, scene: &S)
where
    S: Scene<Scalar = f64, Mechanism = M, U: Default, V: Default, State: Default, Contacts: Default>,
    M: Mechanism<Scalar = f64, Name = &'static str, U = S::U, V = S::V>,
{
    let (new, mut positions) = (coordinates::<M>, Pool::default());
    found(scene.mechanism(), s, &mut positions);
    let scene = &CountedScene { scene, mechanism: Counted(scene.mechanism()) };
    let input_rates = M::Inputs::from(PerInput::<M>::draw(s));
    let (q, time) = (positions.take(s, new), s.number());
    let rates = rates::<M>(s);
    let y = t.fallible(s, "Scene::start", || scene.start(time, &q, &input_rates)).unwrap_or_else(|| Draw::draw(s));
    t.fallible(s, "Scene::project", || scene.project(&y));
    t.fallible(s, "Scene::derivative", || scene.derivative(time, &y));
    t.fallible(s, "Scene::equations", || scene.equations(time, &y));
    t.fallible(s, "Scene::contacts", || scene.contacts(time, &q, &rates));
    t.fallible(s, "Scene::unreduced", || scene.unreduced(time, &q, &rates));
    if s.below(SELDOM) > 0 {
        return;
    }
    let (end, tolerance) = (s.number(), [1e-3, 1e-6, 1e-9, s.number()][s.below(4)]);
    let mut simulation = None;
    t.fallible(s, "simulate", || {
        let begun = simulate(scene, Start { t: time, q, input_rates }, end, tolerance)?.most_steps(60);
        let state = *begun.state();
        simulation = Some(begun);
        Ok::<_, MotionError>(state)
    });
    let Some(mut simulation) = simulation else { return };
    t.fallible(s, "Simulation::loads", || simulation.loads());
    let between = |part: f64| time + part * (end - time);
    let times = [between(0.25), between(0.5), between(1.0), s.number()];
    t.each(s, "Simulation::at", || simulation.at(times).take(times.len()).collect());
    for _ in 0..20 {
        match t.fallible(s, "Simulation::advance", || simulation.advance()) {
            Some(Some(_)) => {}
            _ => break,
        }
        t.fallible(s, "Simulation::loads", || simulation.loads());
    }
    t.fallible(s, "Simulation::state", || Ok::<_, MotionError>((*simulation.state(), simulation.progress())));
}

/// An interpolant at the ends of its step and between them.
fn ends<N: Dim>(of: &Interpolant<f64, N>) -> ([f64; 2], [Column<f64, N>; 3]) {
    let (from, to) = of.interval();
    ([from, to], [from, 0.5 * from + 0.5 * to, to].map(|t| of.at(t)))
}

/// Integrations of systems that are not mechanisms.
pub fn integrations(t: &mut Tally, s: &mut Source) {
    let (matrix, constant) = (SMatrix::<f64, 2, 2>::draw(s), SVector::<f64, 2>::draw(s));
    let (start, end, y) = (s.number(), s.number(), SVector::<f64, 2>::draw(s));
    let (relative, scale) = ([1e-3, 1e-6, 1e-9, s.number()][s.below(4)], [s.number().abs(), 1.0]);
    let (kind, level) = (s.below(4), s.number());
    let rate = move |t: f64, y: &SVector<f64, 2>| {
        evaluated();
        match kind {
            0 => Ok(matrix * y + constant),
            1 => Ok(SVector::from([y[1], -y[0] - level * y[0].powi(3)])),
            2 => Ok(SVector::from([y[1].sqrt(), t.ln()])),
            _ if y[0] > level => Err(MotionError::NotFinite { quantity: "the user's rate", t }),
            _ => Ok(SVector::from([y[1], matrix[0]])),
        }
    };
    let restart = SVector::draw(s);
    let system = watched(
        rate,
        [Crossing::Either, Crossing::Rising],
        move |t, y| Ok([y[0] - level, if kind == 2 { f64::NAN } else { t - y[1] }]),
        move |event, _, _| Ok(if event == 0 { Action::Record } else { Action::Restart(restart) }),
    );
    let Some(_) = t.fallible(s, "Tolerance::new", || Tolerance::<f64, D<2>>::new(relative, scale).map(|_| ()))
    else {
        return;
    };
    macro_rules! run {
        ($method:ident $name:literal $system:expr) => {
            let mut integration = None;
            t.fallible(s, $name, || {
                let begun = $method($system, (start, y), end, Tolerance::new(relative, scale)?)?.most_steps(60);
                let reached = (begun.t(), *begun.state());
                integration = Some(begun);
                Ok::<_, MotionError>(reached)
            });
            if let Some(mut integration) = integration {
                for _ in 0..10 {
                    let Some(Some(_)) = t.fallible(s, "Integration::advance", || integration.advance()) else { break };
                    t.fallible(s, "Integration::interpolant", || integration.interpolant().map(|of| ends(&of)));
                }
                let times = [integration.t(), end, s.number()];
                t.each(s, "Integration::at", || integration.at(times).take(times.len()).collect());
                t.fallible(s, "Integration::state", || Ok::<_, MotionError>((integration.t(), *integration.state())));
            }
        };
    }
    if s.below(2) == 0 {
        run!(dop853 "dop853" system);
    } else {
        run!(dopri5 "dopri5" system);
    }
    let length = s.number();
    let mut steps = None;
    t.fallible(s, "FixedStep::new", || {
        let begun = FixedStep::new(rate, (start, y), length)?;
        let reached = (begun.t(), *begun.state());
        steps = Some(begun);
        Ok::<_, MotionError>(reached)
    });
    if let Some(mut steps) = steps {
        for _ in 0..3 {
            t.fallible(s, "FixedStep::step", || steps.step().map(|()| (steps.t(), *steps.state())));
        }
    }
}
