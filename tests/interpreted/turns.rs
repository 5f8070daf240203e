//! The turns of angles at run time: a pose has the coordinates that it is made of, and one that a function finds solves the
//! equations with its numbers, not with its directions alone.

use linkage::certify::{Certify, CertifyError};
use linkage::circuits::{CircuitOptions, Circuits};
use linkage::continuation::{Direction, Path};
use linkage::position::newton;
use linkage::{Assembly as _, Branches as _, Build as _, D, Kinematic as _, Mechanism as _};
use linkage_interpreter::{AtRunTime, CoordinatesAtRunTime, Data, Design, Program};

/// A wheel between two dyads, one that turns three times as fast before two loops together, and an angle whose range is
/// longer than a turn.
const WHEELS: &str = "
    mechanism Between {
        param a = 1, c = 3;
        input t;
        unknown p, q, u, r, s;
        loop a@t + c@p = 3.5@0 + 2.5@q;
        equation u = 2*p - t;
        loop a@u + c@r = 3.5@0 + 2.5@s;
        output turned = u;
    }
    mechanism Before {
        param a = 1.318787, b = 0.694, c = 0.75474, d = 1.037, e = 0.926, f = 1.655198, h = 1.143275, k = 1.26;
        input z;
        unknown w, t, p, s, u;
        equation w = 3*z;
        loop a@t + b@p - c@s - d@0 = 0;
        loop a@t + e@(p - 1.263) + f@u - h@w - k@0 = 0;
        derive intervals;
    }
    mechanism Doubled {
        input z;
        unknown a, b, w, p, q, r, s;
        loop 0.798@z + 3.288@a = 3.777@0 + 1.319@b;
        equation w = 2*b;
        loop 2.64@p + 1.168@(q - 0.835) = 3.45@0 + 3.442@r;
        loop 2.64@p + 1.685@(q + 1.389) = 3.987@0.084 + 0.565@w + 2.53@s;
    }
    mechanism Reeled {
        param a = 3, b = 2.5, c = 3, d = 1;
        input t;
        unknown p, q in -30deg..1000deg;
        loop a@t + b@p = d@0 + c@q;
    }";

type Wheel<'p> = AtRunTime<'p, D<1>>;
type Coordinates = CoordinatesAtRunTime<D<1>>;

fn design(name: &str) -> Design {
    let program = Program::compile(WHEELS).expect("it compiles");
    program.mechanism(name).expect("the mechanism").design()
}

fn each(names: &[&str], test: impl Fn(&Wheel<'_>)) {
    for name in names {
        let design = design(name);
        let prepared = design.prepared().expect("within the capacities");
        test(&prepared.with_inputs().expect("one input"));
        assert_eq!(prepared.failure(), None, "{name}");
    }
}

/// All numbers, the unknowns first.
fn numbers(q: &Coordinates) -> Vec<f64> {
    q.unknowns.iter().chain(&q.inputs).copied().collect()
}

/// The largest residual, relative to its scale.
fn off(m: &Wheel<'_>, q: &Coordinates) -> f64 {
    let pose = m.pose_at(q);
    let (residual, scales) = (m.residual(&pose), m.residual_scales(&pose));
    residual.iter().zip(&scales).fold(0.0, |most: f64, (one, scale)| most.max((one / scale).abs()))
}

#[test]
fn a_pose_has_the_coordinates_that_it_is_made_of() {
    each(&["Between", "Before", "Reeled"], |m| {
        for step in -20..=20 {
            let at = 1.7 * f64::from(step);
            let unknowns = m.dims().0.column(|place| at + 0.3 * place as f64);
            let q = Wheel::coordinates(unknowns, [at].into());
            // The same bits.
            assert_eq!(numbers(&Wheel::coordinates_of(&m.pose_at(&q))), numbers(&q));
        }
    });
}

/// Newton's method begins at the position that a function has found, and stays there.
#[test]
fn positions_that_are_found_solve_the_equations() {
    each(&["Between", "Before", "Reeled"], |m| {
        let mut count = 0;
        for degrees in (0..360).step_by(15).chain([1000, -2000]) {
            for (branch, q) in m.all_positions([f64::from(degrees).to_radians()].into()).expect("a list") {
                assert!(off(m, &q) < 1e-13, "{}: {q:?}", m.name());
                let solved = newton(m, &q).expect("a position").coordinates;
                let far = numbers(&solved).iter().zip(numbers(&q)).fold(0.0, |far: f64, (x, y)| far.max((x - y).abs()));
                assert!(far < 1e-6, "{} {branch} at {degrees}: {q:?} {solved:?}", m.name());
                count += 1;
            }
        }
        assert!(count > 20, "{count}");
    });
}

/// A path comes back after a turn, from any turn at which it begins: the values of the cases were computed apart.
#[test]
fn paths_keep_the_turns() {
    each(&["Between"], |m| {
        for turn in [-3.0, 0.0, 2.0] {
            let t = f64::to_radians(100.0 + 360.0 * turn);
            let found = m.all_positions([t].into()).expect("a list").map(|(_, q)| q);
            let q =
                found.min_by(|one, other| (one.unknowns[3] + 0.7).abs().total_cmp(&(other.unknowns[3] + 0.7).abs()));
            let q = q.expect("four positions");
            assert!((q.unknowns[3].to_degrees() + 40.388_062_265_324_54).abs() < 1e-9, "{q:?}");
            let mut path = Path::new(m, &q, Direction::Increasing).expect("it moves");
            let there = path.advance_to(t + 40_f64.to_radians()).expect("it turns").position;
            assert!((there.unknowns[3].to_degrees() + 44.912_752_346_746_66).abs() < 1e-9, "{there:?}");
            let again = path.advance_to(t + 360_f64.to_radians()).expect("it turns").position;
            assert!((again.unknowns[3] - q.unknowns[3]).abs() < 1e-12, "{again:?}");
            assert!((again.unknowns[2] - q.unknowns[2] + std::f64::consts::TAU).abs() < 1e-12, "{again:?}");
        }
    });
}

/// The coordinates of data with a pose are those of the pose, and solve the equations.
#[test]
fn data_of_a_pose_has_coordinates() {
    let design = design("Between");
    let branch = Data::fields([("p_q", "right".into()), ("r_s", "right".into())]);
    let of = |pose: &Data, name: &str| {
        let all = design.coordinates(pose).expect("coordinates");
        all.get(name).and_then(Data::number).expect("a number")
    };
    for degrees in [-1000.0, 100.0, 5000.0_f64] {
        let t = degrees.to_radians();
        let pose = design.call("assemble", &[t.into(), branch.clone()]).expect("a pose");
        let moving = design.call("full_kinematics", &[t.into(), branch.clone(), 1.0.into(), 0.0.into()]);
        let moving = moving.expect("a motion");
        for pose in [&pose, moving.get("pose").expect("a pose")] {
            assert_eq!(of(pose, "t"), t);
            assert!((of(pose, "u") - (2.0 * of(pose, "p") - t)).abs() < 1e-13 * (1.0 + t.abs()));
        }
        let all = design.call("branches", &[t.into()]).expect("all");
        assert_eq!(all.list().len(), 4);
        for found in all.list() {
            let pose = found.get("pose").expect("a pose");
            assert!((of(pose, "u") - (2.0 * of(pose, "p") - t)).abs() < 1e-13 * (1.0 + t.abs()));
        }
    }
    assert!(design.coordinates(&Data::Nothing).is_err());
}

/// A start off an equation that determines its unknown is no dead point of that unknown.
#[test]
fn a_wheel_is_never_singular() {
    let design = design("Before");
    let prepared = design.prepared().expect("within the capacities");
    let m = prepared.certifiable::<D<1>>().expect("formulas over intervals");
    let plain: Wheel<'_> = prepared.with_inputs().expect("one input");
    let (_, q) = plain.all_positions([4.359].into()).expect("a list").next().expect("a position");
    assert!(Certify::new(&m).range(&q, 4.4).is_ok());
    let off = CoordinatesAtRunTime {
        unknowns: plain
            .dims()
            .0
            .column(|place| q.unknowns[place] - if place == 0 { 4.0 * std::f64::consts::PI } else { 0.0 }),
        ..q
    };
    match Certify::new(&m).range(&off, 4.4) {
        Err(CertifyError::NoPosition { group, .. }) => assert_eq!(group, "t, p, s, u"),
        Err(error) => panic!("{error}"),
        Ok(_) => {}
    }
}

/// The branch of a group whose positions are listed has no turns, whatever angle before it is counted.
#[test]
fn listed_positions_have_their_own_turns() {
    each(&["Doubled"], |m| {
        let all: Vec<_> = m.all_positions([1.092].into()).expect("a list").collect();
        assert!(all.len() > 4, "{}", all.len());
        for (branch, q) in &all {
            assert!(off(m, q) < 1e-14, "{branch}");
            let found = m.assemble_near(q, *branch).expect("the position");
            assert!(off(m, &Wheel::coordinates_of(&found)) < 1e-14, "{branch}");
        }
        let found = Circuits::over(m, [1.092], CircuitOptions::default()).expect("circuits");
        assert_eq!(found.modes.len(), all.len());
    });
}
