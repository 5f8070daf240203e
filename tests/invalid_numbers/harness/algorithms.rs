//! The algorithms that take any mechanism, any scene or any system, called with what counts their evaluations.

use std::fmt::Debug;

use linkage::accuracy::{Method, Newton, Reached, Table};
use linkage::continuation::{AtChangePoint, Direction, Options, Path};
use linkage::integrate::{Action, Crossing, FixedStep, Tolerance, dop853, dopri5, watched};
use linkage::nalgebra::{SMatrix, SVector};
use linkage::position::newton_step;
use linkage::simulation::simulate;
use linkage::singularity::{accuracy, report, sigma_min};
use linkage::{Contact, Equations, Error, Group, Mechanism, Scene, Unreduced, position};

use super::tally::evaluated;
use super::{Draw, Finite, Pool, Source, Tally};

/// A mechanism whose positions are counted.
struct Counted<'a, M>(&'a M);

impl<M: Mechanism<f64, U, V>, const U: usize, const V: usize> Mechanism<f64, U, V> for Counted<'_, M> {
    const NAME: &'static str = M::NAME;
    const UNKNOWNS: [&'static str; U] = M::UNKNOWNS;
    const INPUTS: [&'static str; V] = M::INPUTS;
    const GROUPS: &'static [Group] = M::GROUPS;
    const UNKNOWN_ANGLES: [bool; U] = M::UNKNOWN_ANGLES;
    const INPUT_ANGLES: [bool; V] = M::INPUT_ANGLES;
    type Coordinates = M::Coordinates;
    type Inputs = M::Inputs;
    type Unknowns = M::Unknowns;
    type Pose = M::Pose;
    type BlockDeterminants = M::BlockDeterminants;

    fn unknowns(q: &M::Coordinates) -> SVector<f64, U> {
        M::unknowns(q)
    }
    fn inputs(q: &M::Coordinates) -> SVector<f64, V> {
        M::inputs(q)
    }
    fn with_inputs(q: &M::Coordinates, inputs: SVector<f64, V>) -> M::Coordinates {
        M::with_inputs(q, inputs)
    }
    fn with_unknowns(q: &M::Coordinates, unknowns: SVector<f64, U>) -> M::Coordinates {
        M::with_unknowns(q, unknowns)
    }
    fn pose_at(&self, q: &M::Coordinates) -> M::Pose {
        evaluated();
        self.0.pose_at(q)
    }
    fn is_finite(pose: &M::Pose) -> bool {
        M::is_finite(pose)
    }
    fn residual(&self, pose: &M::Pose) -> SVector<f64, U> {
        self.0.residual(pose)
    }
    fn closure_sizes(&self, pose: &M::Pose) -> SVector<f64, U> {
        self.0.closure_sizes(pose)
    }
    fn jacobian_unknowns(&self, pose: &M::Pose) -> SMatrix<f64, U, U> {
        self.0.jacobian_unknowns(pose)
    }
    fn jacobian_inputs(&self, pose: &M::Pose) -> SMatrix<f64, U, V> {
        self.0.jacobian_inputs(pose)
    }
    fn jacobian_sizes(&self, pose: &M::Pose) -> (SMatrix<f64, U, U>, SMatrix<f64, U, V>) {
        self.0.jacobian_sizes(pose)
    }
    fn determinant(&self, pose: &M::Pose) -> f64 {
        self.0.determinant(pose)
    }
    fn block_determinants(&self, pose: &M::Pose) -> M::BlockDeterminants {
        self.0.block_determinants(pose)
    }
    fn gamma(&self, pose: &M::Pose, rate: &M::Coordinates) -> SVector<f64, U> {
        self.0.gamma(pose, rate)
    }
    fn solve_jacobian(&self, pose: &M::Pose, right: &SVector<f64, U>) -> Result<SVector<f64, U>, Error> {
        self.0.solve_jacobian(pose, right)
    }
}

/// A scene whose positions and equations are counted.
struct CountedScene<'a, S, M> {
    scene: &'a S,
    mechanism: Counted<'a, M>,
}

impl<'a, S, M, const U: usize, const V: usize, const N: usize, const C: usize> Scene<f64, U, V, N, C>
    for CountedScene<'a, S, M>
where
    M: Mechanism<f64, U, V>,
    S: Scene<f64, U, V, N, C, Mechanism = M>,
{
    const NAME: &'static str = S::NAME;
    type Mechanism = Counted<'a, M>;

    fn mechanism(&self) -> &Counted<'a, M> {
        &self.mechanism
    }
    fn state(q: &M::Coordinates, rates: &M::Inputs) -> SVector<f64, N> {
        S::state(q, rates)
    }
    fn parts(state: &SVector<f64, N>) -> (M::Coordinates, M::Inputs) {
        S::parts(state)
    }
    fn check(&self) -> Result<(), Error> {
        self.scene.check()
    }
    fn derivative(&self, t: f64, state: &SVector<f64, N>) -> Result<SVector<f64, N>, Error> {
        evaluated();
        self.scene.derivative(t, state)
    }
    fn equations(&self, t: f64, state: &SVector<f64, N>) -> Result<Equations<f64, U, V>, Error> {
        evaluated();
        self.scene.equations(t, state)
    }
    fn contacts(
        &self,
        t: f64,
        q: &M::Coordinates,
        velocity: &M::Coordinates,
    ) -> Result<[Contact<f64, U, V>; C], Error> {
        self.scene.contacts(t, q, velocity)
    }
    fn unreduced(&self, t: f64, q: &M::Coordinates, rate: &M::Coordinates) -> Result<Unreduced<f64, U, V>, Error> {
        self.scene.unreduced(t, q, rate)
    }
    fn prescribed(&self, t: f64) -> [Option<[f64; 3]>; V] {
        self.scene.prescribed(t)
    }
    fn inputs(state: &SVector<f64, N>) -> [(&'static str, f64, f64); V] {
        S::inputs(state)
    }
}

/// Of what takes long one trial in so many.
const SELDOM: usize = 40;

/// Positions of a mechanism, where there are some.
pub fn positions<M, const U: usize, const V: usize>(m: &M, s: &mut Source, positions: &mut Pool<M::Coordinates>)
where
    M: Mechanism<f64, U, V>,
    M::Coordinates: Draw,
{
    for _ in 0..2 {
        let guess = Draw::draw(s);
        if let Ok(found) = position::newton(m, &guess) {
            positions.keep(found.coordinates);
        }
    }
}

/// What takes any mechanism.
pub fn mechanism<M, const U: usize, const V: usize>(
    t: &mut Tally,
    s: &mut Source,
    m: &M,
    positions: &mut Pool<M::Coordinates>,
    poses: &mut Pool<M::Pose>,
) where
    M: Mechanism<f64, U, V>,
    M::Coordinates: Draw + Finite + Debug,
    M::Pose: Draw + Finite + Debug + Copy,
{
    let m = &Counted(m);
    for _ in 0..2 {
        let guess = positions.take(s);
        if let Some(found) = t.fallible(s, "newton", || position::newton(m, &guess)) {
            positions.keep(found.coordinates);
            poses.keep(m.pose_at(&found.coordinates));
        }
    }
    let q = positions.take(s);
    if let Some(q) = t.fallible(s, "newton_step", || newton_step(m, &q)) {
        positions.keep(q);
    }
    let (q, there) = (positions.take(s), SVector::<f64, V>::draw(s));
    t.fallible(s, "accuracy::Newton", || Newton::<2>::position(m, &Reached::at(m, q), M::Inputs::from(there)));
    let (q, rates) = (positions.take(s), SVector::draw(s));
    let (mass, forces) = (SMatrix::draw(s), SVector::draw(s));
    t.fallible(s, "Equations::at", || Equations::at(m, &q, &rates, mass, forces));
    if s.below(4) == 0 {
        let pose = poses.take(s);
        t.fallible(s, "singularity::report", || report(m, &pose));
        t.fallible(s, "singularity::sigma_min", || sigma_min(m, &pose));
        t.fallible(s, "singularity::accuracy", || accuracy(m, &pose));
    }
}

/// What takes any mechanism with one input.
pub fn driven<M, const U: usize>(t: &mut Tally, s: &mut Source, m: &M, positions: &mut Pool<M::Coordinates>)
where
    M: Mechanism<f64, U, 1>,
    M::Coordinates: Draw + Finite + Debug + Copy,
    M::Pose: Finite + Debug,
{
    if s.below(SELDOM) > 0 {
        return;
    }
    let m = &Counted(m);
    let (start, end) = (positions.take(s), s.number());
    let table = match s.below(2) {
        0 => t.fallible(s, "Table::turn", || Table::<_, _, U, 9>::turn(m, &start).map(Whole)),
        _ => t.fallible(s, "Table::between", || Table::<_, _, U, 9>::between(m, &start, end).map(Whole)),
    };
    if let Some(Whole(table)) = table {
        for _ in 0..4 {
            let input = SVector::<f64, 1>::draw(s);
            t.fallible(s, "Table::position", || Table::position(m, &table, M::Inputs::from(input)));
        }
    }
    let direction = match s.below(3) {
        0 => Direction::Increasing,
        1 => Direction::Decreasing,
        _ => Direction::Along(Draw::draw(s)),
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
        let found = [begun.position(), begun.rates()];
        path = Some(begun);
        Ok(found)
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
                let rates = Draw::draw(s);
                t.fallible(s, "Path::choose", || path.choose(&rates)).is_some()
            }
            _ => t.total(s, "Path::turn_back", || path.turn_back()).is_some(),
        };
        t.fallible(s, "Path::position", || Ok([path.position(), path.rates()]));
    }
}

/// A table by what it tells of itself; what it holds shows in the positions that it gives.
#[derive(Debug)]
struct Whole<Q, const U: usize>(Table<Q, f64, U, 9>);

impl<Q: Copy, const U: usize> Finite for Whole<Q, U> {
    fn all_finite(&self) -> bool {
        self.0.error().is_finite()
    }
}

/// What takes any scene.
pub fn scene<S, M, const U: usize, const V: usize, const N: usize, const C: usize>(
    t: &mut Tally,
    s: &mut Source,
    scene: &S,
    positions: &mut Pool<M::Coordinates>,
) where
    M: Mechanism<f64, U, V>,
    S: Scene<f64, U, V, N, C, Mechanism = M>,
    M::Coordinates: Draw + Finite + Debug + Copy,
    M::Inputs: Draw + Finite + Debug,
{
    let scene = &CountedScene { scene, mechanism: Counted(scene.mechanism()) };
    let (q, rates, time) = (positions.take(s), M::Inputs::draw(s), s.number());
    let rate = M::with_unknowns(&Draw::draw(s), SVector::draw(s));
    let y = t.fallible(s, "Scene::start", || scene.start(time, &q, &rates)).unwrap_or_else(|| SVector::draw(s));
    t.fallible(s, "Scene::project", || scene.project(&y));
    t.fallible(s, "Scene::derivative", || scene.derivative(time, &y));
    t.fallible(s, "Scene::equations", || scene.equations(time, &y));
    t.fallible(s, "Scene::contacts", || scene.contacts(time, &q, &rate));
    t.fallible(s, "Scene::unreduced", || scene.unreduced(time, &q, &rate));
    if s.below(SELDOM) > 0 {
        return;
    }
    let (end, tolerance) = (s.number(), [1e-3, 1e-6, 1e-9, s.number()][s.below(4)]);
    let mut simulation = None;
    t.fallible(s, "simulate", || {
        let begun = simulate(scene, (time, q, rates), end, tolerance)?.most_steps(60);
        let state = *begun.state();
        simulation = Some(begun);
        Ok(state)
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
    t.fallible(s, "Simulation::state", || Ok((*simulation.state(), simulation.progress())));
}

/// Integrations of systems that are no mechanism.
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
            _ if y[0] > level => Err(Error::NotFinite { mechanism: "the user's", quantity: "rate" }),
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
    let Some(_) = t.fallible(s, "Tolerance::new", || Tolerance::new(relative, scale).map(|_: Tolerance<f64, 2>| ()))
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
                Ok(reached)
            });
            if let Some(mut integration) = integration {
                for _ in 0..10 {
                    let Some(Some(_)) = t.fallible(s, "Integration::advance", || integration.advance()) else { break };
                    t.fallible(s, "Integration::interpolant", || integration.interpolant());
                }
                let times = [integration.t(), end, s.number()];
                t.each(s, "Integration::at", || integration.at(times).take(times.len()).collect());
                t.fallible(s, "Integration::state", || Ok((integration.t(), *integration.state())));
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
        Ok(reached)
    });
    if let Some(mut steps) = steps {
        for _ in 0..3 {
            t.fallible(s, "FixedStep::step", || steps.step().map(|()| (steps.t(), *steps.state())));
        }
    }
}
