//! The example `simulation_cost` against other ways: its references against 31 digits and two methods, its formulations
//! against the figures of another program, and its methods against their orders.

use linkage::integrate::{Dop853, Dopri5, Method};
use linkage::simulation::{RealTime, Start, simulate};
use linkage::{D, Scene, StateParts};
use linkage_double::DoubleDouble;

use linkage_examples::simulation_cost::formulations::{Hold, Multipliers};
use linkage_examples::simulation_cost::four_bars::{self, Turning};
use linkage_examples::simulation_cost::problem::{Emitted, Problem, State};

/// The coordinates at the end of the same problem by numbers of 31 digits.
fn end<M: Method, S, L>(problem: &Problem<S>, scene: &L, tolerance: f64) -> State<S>
where
    S: Emitted,
    L: Scene<Scalar = DoubleDouble, State = S::State>,
{
    let StateParts { q, input_rates } = L::parts(&problem.start.map(DoubleDouble::from));
    let end = DoubleDouble::from(problem.end);
    let motion = simulate(scene, Start { t: DoubleDouble::from(0.0), q, input_rates }, end, tolerance).unwrap();
    let mut motion = motion.method::<M>().unwrap().most_steps(1_000_000);
    motion.finish(|_, _| true).unwrap();
    L::state(&motion.state().q, &input_rates).map(DoubleDouble::high)
}

fn bars() -> four_bars::Bars<DoubleDouble> {
    let four_bars::Bars { a, b, c, d } = four_bars::Bars::default();
    [a, b, c, d].map(DoubleDouble::from).into()
}

fn apart(found: State<Turning>, expected: State<Turning>) -> f64 {
    println!("{found:?}");
    (found - expected).largest()
}

/// The sprung four-bar at the end, by numbers of 31 digits and a method, and its reference.
fn sprung_end<M: Method>(tolerance: f64) -> [State<four_bars::Sprung>; 2] {
    let problem = four_bars::sprung();
    let four_bars::Sprung { m, g, k, l0, xp, yp, .. } = problem.scene;
    let scene = four_bars::Sprung::from((bars(), [m, g, k, l0, xp, yp].map(DoubleDouble::from)));
    [end::<M, _, _>(&problem, &scene, tolerance), problem.expected]
}

#[test]
fn the_reference_of_the_sprung_four_bar() {
    let [found, expected] = sprung_end::<Dop853>(1e-16);
    assert!(apart(found, expected) < 2e-13);
}

#[test]
fn the_reference_of_the_sprung_four_bar_by_two_methods() {
    let [found, expected] = sprung_end::<Dop853>(1e-18);
    assert!(apart(found, expected) < 2e-14);
    let [found, expected] = sprung_end::<Dopri5>(1e-14);
    assert!(apart(found, expected) < 5e-13);
}

#[test]
fn the_reference_of_44_turns() {
    let problem = four_bars::turning();
    let four_bars::Turning { m, g, .. } = problem.scene;
    let scene = four_bars::Turning::from((bars(), [m, g].map(DoubleDouble::from)));
    // 2e-12 at 1e-16, and some of a hundredth of it here; an angle of 275 rad is itself rounded to 6e-14.
    assert!(apart(end::<Dop853, _, _>(&problem, &scene, 1e-18), problem.expected) < 1e-13);
}

/// The motion with multipliers by steps of this number, and the widest gap on the way.
fn with_multipliers<S>(problem: &Problem<S>, hold: Hold, steps: u32) -> (State<S>, f64)
where
    S: Emitted<U = D<2>, V = D<1>>,
{
    let mut motion = Multipliers::<S, 2, 5>::new(problem, hold).unwrap();
    let h = problem.end / f64::from(steps);
    let mut gap = 0.0_f64;
    for step in 0..steps {
        motion.step(f64::from(step) * h, h).unwrap();
        gap = gap.max(problem.gap(&motion.y()));
    }
    (motion.y(), gap)
}

/// Steps, theta at the end and the widest gap by another program, written in another language for the same equations.
type Rows = [(u32, f64, f64); 2];

const FORMULATIONS: [(Hold, Rows); 4] = [
    (Hold::Accelerations, ACCELERATIONS),
    (Hold::Baumgarte(5.0), WEAKLY),
    (Hold::Baumgarte(50.0), STRONGLY),
    (Hold::Projection, PROJECTED),
];

const ACCELERATIONS: Rows =
    [(5000, 275.063_206_182_975_6, 5.915_420_5e-3), (20_000, 274.967_904_587_985_46, 2.332_102_6e-5)];
const WEAKLY: Rows = [(5000, 274.974_741_823_660_34, 1.415_255_8e-6), (20_000, 274.967_532_238_091_9, 5.535_610_4e-9)];
const STRONGLY: Rows =
    [(5000, 274.975_866_395_133_9, 1.116_225_7e-6), (20_000, 274.967_550_437_505_74, 3.880_448_7e-9)];
const PROJECTED: Rows = [(5000, 274.964_844_557_934_1, 0.0), (20_000, 274.967_494_473_272_04, 0.0)];

/// One row of every formulation.
fn are_those_of_another_program(row: usize) {
    let problem = four_bars::turning();
    let theta = |y: &State<Turning>| Turning::parts(y).q.theta;
    for (hold, expected) in FORMULATIONS {
        let (steps, end, widest) = expected[row];
        let (y, gap) = with_multipliers(&problem, hold, steps);
        println!("{hold:?} {steps}: {:e} {gap:e} {:e}", theta(&y) - end, gap / widest - 1.0);
        assert!((theta(&y) - end).abs() < 2e-9, "{hold:?} {steps}");
        assert!((gap - widest).abs() < 1e-3 * widest + 1e-14, "{hold:?} {steps}: {gap:e}");
    }
    // Its reference, in double precision.
    assert!((theta(&problem.expected) - 274.967_493_169_763_77).abs() < 5e-9);
}

#[test]
fn the_formulations_by_5000_steps() {
    are_those_of_another_program(0);
}

#[test]
fn the_formulations_by_20_000_steps() {
    are_those_of_another_program(1);
}

/// Half the step is a sixteenth of the error, by Kutta's method in every formulation.
#[test]
fn every_formulation_is_of_order_four() {
    let problem = four_bars::sprung();
    let order = |error: &dyn Fn(u32) -> f64| (error(2500) / error(5000)).log2();
    for hold in [Hold::Accelerations, Hold::Baumgarte(5.0), Hold::Baumgarte(50.0), Hold::Projection] {
        let order = order(&|steps| problem.error(&with_multipliers(&problem, hold, steps).0));
        println!("{hold:?} {order}");
        assert!((order - 4.0).abs() < 0.25, "{hold:?} {order}");
    }
    let in_the_inputs = |steps: u32| {
        let StateParts { q, input_rates } = four_bars::Sprung::parts(&problem.start);
        let mut clock =
            RealTime::new(&problem.scene, Start { t: 0.0, q, input_rates }, problem.end / f64::from(steps)).unwrap();
        (0..steps).for_each(|_| clock.step().unwrap());
        problem.error(&four_bars::Sprung::state(&clock.state().unwrap().q, &input_rates))
    };
    let order = order(&in_the_inputs);
    println!("{order}");
    assert!((order - 4.0).abs() < 0.25, "{order}");
}
