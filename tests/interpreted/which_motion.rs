//! The motion that an answer is about: the first row that has the position asked for chooses it, and each row is at its own turn.

use std::f64::consts::TAU;

use linkage::circuits::{CircuitOptions, Circuits, CurveEnd};
use linkage::continuation::{Direction, Path};
use linkage::range_of_motion::{MotionEnd, RangeOfMotion, RangeOptions};
use linkage::{Branches, Column, D, InputError, PathError, RangeEnd};
use linkage_interpreter::{AtRunTime, CoordinatesAtRunTime, Data, Design, Program};

type OneInput<'p> = AtRunTime<'p, D<1>>;
type At = CoordinatesAtRunTime<D<1>>;

/// The only mechanism of a text, with other values of some parameters.
fn design(text: &str, values: &[(&str, f64)]) -> Design {
    let program = Program::compile(text).unwrap_or_else(|messages| panic!("{messages:?}"));
    let mechanism = program.mechanisms()[0].clone();
    let design = mechanism.design();
    let names: Vec<String> = mechanism.parameters().map(ToString::to_string).collect();
    let own: Vec<f64> = names
        .iter()
        .zip(design.parameters())
        .map(|(name, own)| values.iter().find(|(of, _)| of == name).map_or(*own, |(_, value)| *value))
        .collect();
    design.with_parameters(&own)
}

/// The mechanism with its one input.
fn moving<R>(text: &str, values: &[(&str, f64)], f: impl FnOnce(OneInput<'_>) -> R) -> R {
    let design = design(text, values);
    let prepared = design.prepared().expect("within the capacities");
    let found = f(prepared.with_inputs().expect("one input"));
    assert_eq!(prepared.failure(), None);
    found
}

/// The position of this place in the list at an input.
fn listed(m: &OneInput<'_>, input: f64, place: usize) -> Option<At> {
    m.all_positions(Column::from([input])).ok()?.nth(place).map(|(_, q)| q)
}

/// A six-bar whose loops have four unknowns together.
const SIX_BAR: &str = "mechanism SixBar {
    param a = 2.11, bx = -0.03, by = 0.18, p = 3.92, q = 3.44, cd = 2.46, ex = -0.8, ey = -1.94, r = 3.87,
        gx = 3.25, gy = -1.33;
    input theta;
    unknown alpha, beta, tau, rho;
    let first = a@theta + p@alpha;
    loop first + cd@tau = (bx, by)@theta + q@beta;
    loop first + (ex, ey)@tau = (gx, gy) + r@rho;
}";

/// A motion to and fro of more than a turn has other positions a turn later: rows beyond its ends have none. Small steps of the
/// input connect all that it has.
#[test]
fn more_than_a_turn_to_and_fro() {
    moving(SIX_BAR, &[], |m| {
        for (place, width) in [(0, 378.758_156_493_9_f64), (1, 650.850_992_035_2)] {
            let start = listed(&m, 1.0, place).unwrap();
            let range = RangeOfMotion::of(m, &start, RangeOptions::through_change_points()).unwrap();
            let [least, most] = range.inputs();
            assert!((most - least - width.to_radians()).abs() < 1e-10, "{}", (most - least).to_degrees());
            assert!(range.ends().iter().all(|end| matches!(end, MotionEnd::DeadPoint { .. })));
            let mut last = range.at(least).unwrap();
            for step in 1..=250 {
                let at = range.at(if step == 250 { most } else { least + (most - least) * f64::from(step) / 250.0 });
                let at = at.unwrap();
                let off = (at.unknowns - last.unknowns).iter().fold(0.0, |off: f64, by| off.max(by.abs()));
                assert!(off < 1.2, "{step} {off}");
                last = at;
            }
            for beyond in [least - 0.01, most + 0.01, least - 1.0, most + TAU] {
                assert!(matches!(range.at(beyond), Err(PathError::DeadPoint { .. })), "{beyond}");
            }
        }
    });
}

/// A motion of less than a turn has the same positions a turn later.
#[test]
fn less_than_a_turn_to_and_fro() {
    let text =
        "mechanism FourBar { param ground = 4, crank = 3, coupler = 2, rocker = 2.5; input theta; unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi; }";
    moving(text, &[], |m| {
        let start = listed(&m, 0.5, 0).unwrap();
        let range = RangeOfMotion::of(m, &start, RangeOptions::default()).unwrap();
        let [here, later] = [0.3, 0.3 + TAU].map(|input| range.at(input).unwrap());
        assert!((here.unknowns - later.unknowns).iter().all(|off| off.abs() < 1e-14));
    });
}

/// A lever in a slot, and as high as it may be. Without its ranges s^2 = 13 - 12 cos(theta).
const LEVER: &str = "mechanism Lever {
    param crank = 2, frame = 3, least = 1.5, most = 4.5, high = 1.9;
    input theta;
    unknown phi, s in least..most;
    loop crank@theta = frame@0 + s@phi;
    output lift in ..high = crank*sin(theta);
}";

/// The words of an error, which is that of the first row.
#[derive(Debug, PartialEq)]
struct Words(String);

impl From<PathError<&str>> for Words {
    fn from(error: PathError<&str>) -> Self {
        Self(error.to_string())
    }
}

fn chosen<'p>(
    m: OneInput<'p>,
    rows: impl IntoIterator<Item = f64>,
    place: usize,
) -> Result<RangeOfMotion<'p, OneInput<'p>>, Words> {
    let at = |input: f64| listed(&m, input, place).ok_or_else(|| Words(format!("none at {input}")));
    RangeOfMotion::chosen(m, rows, at, RangeOptions::through_change_points())
}

/// However many rows are outside of the ranges, the first within them chooses, and not a later one.
#[test]
fn rows_outside_of_ranges_do_not_end_the_search() {
    moving(LEVER, &[], |m| {
        let ends = [(43.0_f64 / 48.0).acos(), 0.95_f64.asin()];
        for steps in [14, 120, 3600] {
            let rows = || (0..=steps).map(|step| TAU * f64::from(step) / f64::from(steps));
            let range = chosen(m, rows(), 0).unwrap();
            for (found, expected) in range.inputs().into_iter().zip(ends) {
                assert!((found - expected).abs() < 1e-14, "{steps}: {found} {expected}");
            }
            // From the other end the first is beyond 180 degrees, where the lever is low.
            let range = chosen(m, rows().collect::<Vec<_>>().into_iter().rev(), 0).unwrap();
            assert!((range.inputs()[1] - (TAU - ends[0])).abs() < 1e-14, "{:?}", range.inputs());
        }
    });
    // If there is none, the reason is that of the first.
    moving(LEVER, &[("least", 9.0), ("most", 10.0)], |m| {
        let error = chosen(m, [0.5, 1.0], 0).err().unwrap();
        let s = (13.0 - 12.0 * 0.5_f64.cos()).sqrt();
        assert!(error.0.contains(&format!("s of Lever is {s}")[..20]), "{error:?}");
    });
}

/// At a change point, and at a dead point, the motion is the one on which the branch is next to it.
#[test]
fn singular_first_rows() {
    let text = "mechanism Parallel { param ground = 4, crank = 2; input theta; unknown phi, psi;
        loop crank@theta + ground@phi = ground@0 + crank@psi; }";
    moving(text, &[], |m| {
        for rows in [vec![0.0, 3.0], vec![0.0], vec![std::f64::consts::PI, 0.1]] {
            let branch = m.all_positions(Column::from([1.0])).unwrap().map(|(branch, _)| branch).next().unwrap();
            let options = RangeOptions::through_change_points();
            let range = RangeOfMotion::on_branch(m, branch, rows.iter().copied(), options).unwrap();
            let psi = range.at(2.5).unwrap().unknowns[1];
            assert!((psi - 2.5).abs() < 1e-12, "{rows:?}: {psi}");
        }
    });
    let text = "mechanism Slider { param r = 1, l = 3; input s; unknown phi, psi; loop r@phi + l@psi = (s, 0); }";
    moving(text, &[], |m| {
        // The row after the dead point is beyond.
        for (dead, next) in [(4.0, 4.5), (2.0, 1.5), (4.0, 3.9)] {
            let branch = m.all_positions(Column::from([3.0])).unwrap().map(|(branch, _)| branch).next().unwrap();
            let range = RangeOfMotion::on_branch(m, branch, [dead, next], RangeOptions::default()).unwrap();
            assert!(range.inputs().into_iter().zip([2.0, 4.0]).all(|(one, other)| (one - other).abs() < 1e-13));
        }
    });
}

/// No declared range, and an option: both errors are those of the start.
#[test]
fn without_rows_there_is_no_direction() {
    moving(LEVER, &[], |m| {
        assert!(chosen(m, [], 0).err().unwrap().0.contains("Lever"));
        let start = listed(&m, 0.1, 0).unwrap();
        let error = RangeOfMotion::of(m, &start, RangeOptions::default()).err().unwrap();
        assert!(matches!(error, PathError::Input(InputError::OutOfRange { .. })), "{error:?}");
    });
}

/// An even function, whose crests are between the samples of a path. Alone it has no group.
const WAVE: &str = "mechanism Wave {
    param l = 1, k = 50, level = 0.9;
    input t;
    unknown p;
    equation p = t;
    point P = l@p;
    point Q = l@t;
    output o in -9..level = t/5*sin(k*t);
    derive limits;
}";

/// The first input from which t/5 sin(k t) is above the level, by small steps and halvings.
fn first_crest(k: f64, level: f64) -> f64 {
    let room = |t: f64| level - t / 5.0 * (k * t).sin();
    let step = 1e-3 / k;
    let first = (1..).map(|count| f64::from(count) * step).find(|t| room(*t) < 0.0).unwrap();
    let [mut low, mut high] = [first - step, first];
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if room(middle) < 0.0 { high = middle } else { low = middle }
    }
    low
}

/// Paths, motions and limits find the first crest that is above the range.
#[test]
fn crests_between_samples() {
    let count = linkage_trials::count("CRESTS", 4_u32, 200);
    for case in 0..count {
        let k = 20.0 + 31.7 * f64::from(case % 23);
        let level = 0.3 + 0.1 * f64::from(case % 7);
        let values = [("k", if case == 0 { 50.0 } else { k }), ("level", if case == 0 { 0.9 } else { level })];
        let expected = first_crest(values[0].1, values[1].1);
        assert!(case > 0 || (expected - 4.5523).abs() < 1e-4, "{expected}");
        let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-11;
        moving(WAVE, &values, |m| {
            let start =
                CoordinatesAtRunTime { unknowns: Column::from_slice(&[0.1]).unwrap(), inputs: Column::from([0.1]) };
            let range = RangeOfMotion::of(m, &start, RangeOptions::default()).unwrap();
            let end = MotionEnd::JointRange { of: "o", end: RangeEnd::Most };
            assert_eq!(range.ends(), [end; 2]);
            let [least, most] = range.inputs();
            assert!(close(most, expected) && close(least, -expected), "{values:?}: {least} {most} {expected}");
            let mut path = Path::new(m, &start, Direction::Increasing).unwrap();
            assert!(matches!(path.advance_to(100.0), Err(PathError::JointRange { of: "o", .. })));
            assert!(close(path.position().inputs[0], expected));
        });
        let design = design(WAVE, &values);
        let arguments = design.arguments("limits").unwrap();
        let given: Vec<Data> =
            std::iter::once(Data::from(0.1)).chain(arguments.iter().skip(1).map(|_| Data::Nothing)).collect();
        let found = design.call("limits", &given).unwrap();
        for (side, expected) in [("lower", -expected), ("upper", expected)] {
            let end = |part: &str| found.get(&format!("{side}.JointRange.{part}"));
            let input = end("input").and_then(Data::number);
            assert!(input.is_some_and(|input| close(input, expected)), "{values:?}: {found:?} {expected}");
            assert_eq!(end("of"), Some(&Data::from("o")));
        }
    }
}

/// A range of the input of more than a turn ends the motions of circuits, as it ends limits.
#[test]
fn ranges_of_more_than_a_turn() {
    let text = "mechanism Cranks { param a = 3, b = 2.5, c = 3, d = 1; input t in 10deg..1000deg; unknown p, q;
        loop a@t + b@p = d@0 + c@q; }";
    let of = |text: &str, at: f64| {
        moving(text, &[], |m| {
            Circuits::of(&m, at, CircuitOptions::default())
                .map(|found| {
                    found.motions.iter().map(|motion| (motion.end, motion.range().unwrap())).collect::<Vec<_>>()
                })
                .unwrap()
        })
    };
    for at in [60.0_f64, 500.0, 999.0] {
        let all = of(text, at.to_radians());
        assert_eq!(all.len(), 2);
        for (end, [least, most]) in all {
            assert_eq!(end, CurveEnd::Limits);
            assert!((least - 10.0_f64.to_radians()).abs() < 1e-13 && (most - 1000.0_f64.to_radians()).abs() < 1e-13);
        }
    }
    // None, and a range of an unknown that counts turns.
    let closed = of(&text.replace("10deg..1000deg", "-180deg..180deg").replace("in -180deg..180deg", ""), 1.0);
    assert!(closed.iter().all(|(end, _)| matches!(end, CurveEnd::Closed { turns: 1 })));
    let geared = "mechanism Geared { input t; unknown w in ..1000deg; equation w = 3*t; point P = 1@w; }";
    let geared = of(geared, 1.0);
    assert!((geared[0].1[1] - 1000.0_f64.to_radians() / 3.0).abs() < 1e-13, "{geared:?}");
}
