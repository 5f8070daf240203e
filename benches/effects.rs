//! The cost of each effect: scenes of one mechanism with inertia alone, with one more effect, and with all effects.
//!
//! `cargo bench --bench effects`
//!
//! Operations: functions, divisions, multiplications and additions of one evaluation, as the emitted functions document
//! them. Nanoseconds: the median of many rounds with alternating scenes, and the difference to the bare scene. Bytes:
//! the size of the scene. Smooth scenes are timed in `derivative`; those with frictions and stops as an integrator
//! does: `equations`, `contacts`, and the solution for the acceleration in given modes.

use std::hint::black_box;
use std::time::Instant;

use linkage::contact::{Contacts, ReducedEquations};
use linkage::{Column, D, Mechanism, Mode, MotionError, PerInput, Scene, StateParts};
use linkage_compiler::program::Operations;
use linkage_tests::work::{Work, work};

use linkage_gallery::four_bar_effects::*;

/// q, v'.
type State = Column<f64, D<4>>;

type Evaluate = Box<dyn Fn(&[State])>;

const COUNT: usize = 5_000;
const ROUNDS: usize = 61;

/// A row of the table, with a function that evaluates the scene at all states.
struct Row {
    title: &'static str,
    scene: &'static str,
    functions: &'static [&'static str],
    bytes: usize,
    evaluate: Evaluate,
    times: Vec<f64>,
}

impl Row {
    fn new<S: 'static>(
        title: &'static str,
        (name, functions): (&'static str, &'static [&'static str]),
        scene: S,
        evaluate: impl Fn(&S, &State) -> Result<State, MotionError> + 'static,
    ) -> Self {
        let evaluate = move |states: &[State]| {
            for state in states {
                let _ = black_box(evaluate(black_box(&scene), black_box(state)));
            }
        };
        Self { title, scene: name, functions, bytes: size_of::<S>(), evaluate: Box::new(evaluate), times: Vec::new() }
    }

    fn smooth<S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>, State = D<4>> + 'static>(
        title: &'static str,
        scene: S,
    ) -> Self {
        Self::new(title, (S::NAME, &["rates"]), scene, |scene, y| scene.derivative(black_box(0.5), y))
    }

    /// A row with contacts in these modes.
    fn in_contact<S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>, State = D<4>> + 'static>(
        title: &'static str,
        scene: S,
        modes: impl Into<Column<Mode, S::Contacts>>,
    ) -> Self {
        let start = State::from([1.2, -1.0, 0.5, 12.0]);
        let rates = S::parts(&start).input_rates;
        // The accelerations in given modes do not depend on how the modes were reached.
        let rates: PerInput<S::Mechanism> = rates.into();
        let begun = Contacts::begin(0.0, &rates, |_| ReducedEquations::of(&scene, 0.0, &start));
        let (mut contacts, _) = begun.expect("modes at the start");
        contacts.modes = modes.into();
        Self::new(title, (S::NAME, &["equations", "contacts"]), scene, move |scene, y| {
            let equations = ReducedEquations::of(scene, black_box(0.5), y)?;
            let acceleration = contacts.acceleration(&equations)?;
            Ok(State::from([0.0, 0.0, equations.rates[0], acceleration[0]]))
        })
    }

    fn operations(&self, work: &Work) -> Operations {
        let of = |function: &&str| work.get(&(self.scene.to_owned(), (*function).to_owned())).copied();
        self.functions.iter().filter_map(of).fold(Operations::default(), Operations::plus)
    }

    fn median(&self) -> f64 {
        let mut times = self.times.clone();
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    }
}

fn main() {
    let work = work(linkage_gallery::source::tokens_of("four_bar_effects"));
    let mut rows = [
        Row::smooth("bare: inertia", Bare::default()),
        Row::smooth("+ gravity", Weighed::default()),
        Row::smooth("+ spring between points", Sprung::default()),
        Row::smooth("+ torsional spring", Twisted::default()),
        Row::smooth("+ damper", Damped::default()),
        Row::smooth("+ force at a point", Pushed::default()),
        Row::smooth("+ torque, a law", Turned::default()),
        Row::smooth("+ gravity, spring, damper", Mounted::default()),
        Row::smooth("+ all of these", Smooth::default()),
        Row::smooth("+ drive", Driven::default()),
        Row::new("  drive forces", ("Driven", &["drive_forces"]), Driven::default(), |scene, y| {
            let StateParts { q, input_rates } = Driven::parts(y);
            Ok(State::from([0.0, 0.0, 0.0, scene.drive_forces(black_box(0.5), &q, input_rates)?.theta2]))
        }),
        Row::in_contact("+ stop, open", Stopped::default(), [Mode::Open]),
        Row::in_contact("+ friction, slips", Rough::default(), [Mode::SlipForward]),
        Row::in_contact("+ friction, sticks", Rough::default(), [Mode::Stick]),
        Row::in_contact("+ friction by reaction, slips", Worn::default(), [Mode::SlipForward]),
        Row::in_contact("+ friction by reaction, sticks", Worn::default(), [Mode::Stick]),
        Row::new("  reaction at a pin", ("Measured", &["reactions"]), Measured::default(), |scene, y| {
            let StateParts { q, input_rates } = Measured::parts(y);
            let force = scene.reactions(black_box(0.5), &q, input_rates)?.c_on_rocker;
            Ok(State::from([0.0, 0.0, force.x, force.y]))
        }),
        Row::new("  all reactions", ("Loaded", &["reactions"]), Loaded::default(), |scene, y| {
            let StateParts { q, input_rates } = Loaded::parts(y);
            let all = scene.reactions(black_box(0.5), &q, input_rates)?;
            Ok(State::from([all.c_on_rocker.x, all.origin_on_crank.y, all.multipliers[0], all.multipliers[1]]))
        }),
        Row::in_contact("all but the drive", Everything::default(), [Mode::SlipForward, Mode::Open]),
    ];
    let mechanism = FourBar::default();
    let states = (0..COUNT).map(|index| {
        let theta2 = 0.3 + 1e-4 * index as f64;
        let branch = FourBarBranch::new(linkage::Elbow::Left);
        let q = mechanism.assemble(theta2, branch).expect("a position").coordinates();
        State::from([q.theta3, q.theta4, q.theta2, 12.0])
    });
    let states: Vec<State> = states.collect();
    for _ in 0..ROUNDS {
        for row in &mut rows {
            let start = Instant::now();
            (row.evaluate)(&states);
            row.times.push(start.elapsed().as_secs_f64() * 1e9 / COUNT as f64);
        }
    }
    let bare = rows[0].median();
    println!("scene                         f   /   *   +       ns   difference  bytes");
    for row in &rows {
        let Operations { functions, divisions, multiplications, additions } = row.operations(&work);
        let (time, title) = (row.median(), row.title);
        println!(
            "{title:26} {functions:4}{divisions:4}{multiplications:4}{additions:4} {time:8.1} {:12.1} {:6}",
            time - bare,
            row.bytes
        );
    }
}
