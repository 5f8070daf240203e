//! The turns of angles: wheels, racks, screws and belts behind groups whose angles turn without end.
//!
//! A group in closed form gives a direction, which does not contain the number of turns of a wheel. A wheel that it
//! drives must not jump where the arc tangent does.

use std::f64::consts::{PI, TAU};

use linkage::continuation::{Direction, Path};
use linkage::simulation::{Start, simulate};
use linkage::{Assembly, D, Elbow, InputError, Mechanism, PositionError, Slider, Slope, linkage};

use linkage_gallery::drag_link_drive::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::geared_five_bar::*;
use linkage_gallery::pin_and_slot::*;

linkage! {
    /// A rack behind an angle group, half an angle in a loop, and a law of the user in a number.
    pub mechanism Halves {
        param a = 2, b = 3, r = 0.5, lift = 0.2;
        input phi;
        unknown psi, half, q, x, y, cam;
        extern fn rise(angle, lift) -> (law, slope, bend, change);
        // An angle: psi turns with phi.
        equation a * sin(psi) = a * sin(phi + 0.1 * sin(phi));
        // Half of it, and a length of it, in loops.
        loop 2@half = (x, y) + 1@(psi / 2) + (r * psi / 10)@0.3;
        equation x = 0.4;
        equation q = b * psi;
        equation cam = law(psi, lift);
    }
    /// A dyad on a wheel behind a slot: how far the pin can go is a matter of the wheel's turns.
    pub mechanism Limited {
        param pin = 9.6, ecc = 1.1, arm = 2, long = 2.2, short = 1.8, d = 3;
        input month;
        unknown slot, s, out, p, q;
        loop pin@month = ecc@0 + s@slot;
        equation 2 * out = -slot;
        loop arm@out + long@p = (0, -d) + short@q;
        derive limits;
    }
    /// Pin and slot on a wheel that turns itself, with a wheel that rolls about the slotted one.
    pub mechanism Epicycle {
        param pin = 9.6, ecc = 1.1;
        input month;
        unknown year, slot, s, out, rolled;
        equation 223 * year = 25 * month;
        loop pin@month = ecc@year + s@slot;
        equation 3 * (out - year) = -2 * (slot - year);
        equation rolled = year + 7 * slot / 5;
        point Pointer = 10@out + 1@rolled;
    }
    /// A point at half an angle whose number nothing else needs.
    pub mechanism Halved {
        param pin = 9.6, ecc = 1.1;
        input month;
        unknown slot, s;
        loop pin@month = ecc@0 + s@slot;
        point Half = 2@(slot / 2 + 1);
    }
    /// Directions alone.
    pub mechanism Bare {
        param a = 3, b = 2, c = 2.5, d = 1;
        input theta;
        unknown phi, psi;
        loop a@theta + b@(phi + 0.3) + 0.1@phi = d@0 + c@(psi - 0.3) + 0.2@psi;
        point P = a@theta + 2@(2 * phi);
    }
    /// A double crank that may turn less than three times, as its range says.
    pub mechanism Reeled {
        param a = 3, b = 2.5, c = 3, d = 1;
        input t;
        unknown p, q in -30deg..1000deg;
        loop a@t + b@p = d@0 + c@q;
    }
    /// A slider on a turning guide, whose turns a spring counts.
    #[derive(Clone)]
    pub mechanism Wound {
        param a = 3, d = 1, k = 0.4, m = 1;
        input phi;
        unknown psi, s;
        loop a@phi = d@0 + s@(psi + 0.2) + 0.1@psi;
        point P = s@psi;
        body slide { mass m; center P; }
        scene Spring { inertia; spring k on psi; energy; }
    }
}

/// A rise that goes on from turn to turn.
fn rise<T: linkage::Real>(angle: T, lift: T) -> (T, T, T, T) {
    (lift * angle + angle.sin(), lift + angle.cos(), -angle.sin(), -angle.cos())
}

/// The largest difference of coordinates; those of which a pose knows the direction alone are compared as directions.
fn difference<M: Mechanism<Scalar = f64, V = D<1>>>(a: &M::Coordinates, b: &M::Coordinates, bare: &[&str]) -> f64 {
    let off = M::unknowns(a) - M::unknowns(b);
    let of_unknowns = off.iter().zip(M::UNKNOWNS).map(|(&off, name)| {
        let turns = if bare.contains(name) { (off / TAU).round() } else { 0.0 };
        (off - turns * TAU).abs()
    });
    of_unknowns.fold((M::inputs(a) - M::inputs(b)).largest(), f64::max)
}

/// Follows a mechanism over ten turns either way and assembles each position again from its branch; the coordinates
/// are the numbers of the pose.
fn comes_back<M>(
    m: &M,
    start: &M::Coordinates,
    bare: &[&str],
    coordinates: impl Fn(&M::Pose) -> M::Coordinates,
) -> [M::Coordinates; 2]
where
    M: Assembly<Scalar = f64, V = D<1>>,
{
    [Direction::Increasing, Direction::Decreasing].map(|direction| {
        let mut path = Path::new(m, start, direction).unwrap();
        let sign = if matches!(direction, Direction::Increasing) { 1.0 } else { -1.0 };
        let begin = M::inputs(start)[0];
        for step in 1..=800 {
            // Steps that come to every multiple of a quarter turn.
            let input = begin + sign * 20.0 * PI * f64::from(step) / 800.0;
            let here = path.advance_to(input).unwrap().position;
            for q in [here, M::with_inputs(&here, [input].into())] {
                let pose = m.pose_at(&q);
                let branch = m.branch_of(&pose);
                let [again, near] =
                    [m.assemble(M::inputs(&q).into(), branch), m.assemble_near(&q, branch)].map(Result::unwrap);
                for found in [&again, &near] {
                    let off = difference::<M>(&coordinates(found), &q, bare);
                    assert!(off < 3e-13, "{off:e} at {input}: {branch:?}, {q:?}, {:?}", coordinates(found));
                }
                assert!(m.same_branch(&pose, &again));
                assert_eq!(M::inputs(&coordinates(&again)), M::inputs(&q));
            }
        }
        path.position()
    })
}

#[test]
fn a_pointer_does_not_jump_where_the_slot_goes_through_pi() {
    let m = PinAndSlot::default();
    let branch = PinAndSlotBranch::new(Slider::Far);
    let [before, after] = [3.10, 3.15].map(|month| m.assemble(month, branch).unwrap().coordinates());
    assert!((before.out + 1.552).abs() < 1e-3, "{before:?}");
    // Without a turn the slot is at its principal value; a turn further on the pointer goes on.
    assert!((after.out - 1.567).abs() < 1e-3, "{after:?}");
    let on = PinAndSlotBranch { slot_turn: 1, ..branch };
    let after = m.assemble(3.15, on).unwrap().coordinates();
    assert!((after.out + PI - 1.567).abs() < 1e-3, "{after:?}");
    assert_eq!(after.month, 3.15);
    // From the last position, the number of turns need not be known.
    let near = PinAndSlotCoordinates { month: 3.15, ..before };
    assert_eq!(m.assemble_near(&near, branch).unwrap().coordinates(), after);
    assert_eq!(m.branch_of(&m.pose_at(&m.solve(&near).unwrap().coordinates)), on);
}

#[test]
fn ten_turns_both_ways() {
    let m = PinAndSlot::default();
    let start = m.assemble(0.4, PinAndSlotBranch::new(Slider::Far)).unwrap().coordinates();
    let [up, down] = comes_back(&m, &start, &[], PinAndSlotPose::coordinates);
    // Ten turns of the slot are five of the pointer.
    for (end, turns) in [(up, 10.0), (down, -10.0)] {
        let ends = [end.slot - start.slot, -2.0 * (end.out - start.out), 2.0 * (end.small - start.small)];
        assert!(ends.iter().all(|end| (end - turns * TAU).abs() < 1e-12), "{ends:?}");
    }

    let m = DragLinkDrive::default();
    let branch = DragLinkDriveBranch::new(Elbow::Left, Elbow::Left);
    let start = m.assemble(0.4, branch).unwrap().coordinates();
    let [up, down] = comes_back(&m, &start, &["theta3", "rod_angle"], DragLinkDrivePose::coordinates);
    for (end, turns) in [(up, 10.0), (down, -10.0)] {
        assert!((end.nut - start.nut - turns * m.lead).abs() < 1e-12);
        assert!((end.rack - start.rack - turns * m.r * TAU).abs() < 1e-11);
    }

    let m = Epicycle::default();
    let start = m.assemble(0.4, EpicycleBranch::new(Slider::Far)).unwrap().coordinates();
    let [up, down] = comes_back(&m, &start, &[], EpicyclePose::coordinates);
    assert!(up.rolled - down.rolled > 28.0 * TAU);

    let m = Halved::default();
    let start = m.assemble(0.4, HalvedBranch::new(Slider::Far)).unwrap().coordinates();
    comes_back(&m, &start, &[], HalvedPose::coordinates);
    let turned = HalvedBranch { slot_turn: 1, ..HalvedBranch::new(Slider::Far) };
    let [here, turned] = [HalvedBranch::new(Slider::Far), turned]
        .map(|branch| m.points(&m.assemble(0.4, branch).unwrap()).unwrap().half);
    assert!((here.coords + turned.coords).amax() < 1e-14, "{here} {turned}");

    let m = Halves::default();
    let branch = HalvesBranch::new(Slope::Rising, Slider::Near);
    let [start, turned] =
        [0, 1].map(|psi_turn| m.assemble(0.3, HalvesBranch { psi_turn, ..branch }).unwrap().coordinates());
    assert!((turned.cam - start.cam - m.lift * TAU).abs() < 1e-14 && (turned.q - start.q - m.b * TAU).abs() < 1e-14);
    // The vector at half the angle points the other way.
    let residual = m.residual(&m.pose_at(&turned));
    assert!(residual.largest() < 1e-14 && (turned.y - start.y).abs() > 0.1, "{turned:?} {start:?}");
}

#[test]
fn geared_wheels_at_a_lever() {
    let m = GearedFiveBar::default();
    for branch in GearedFiveBarBranch::all() {
        let start = m.assemble(0.4, branch).unwrap().coordinates();
        comes_back(&m, &start, &["theta2", "theta3"], GearedFiveBarPose::coordinates);
    }
}

/// Even if a rounding error puts an angle on the other side of the cut, the coordinates are reproduced.
#[test]
fn at_the_cut_itself() {
    let m = PinAndSlot::default();
    let far = PinAndSlotBranch::new(Slider::Far);
    for turn in -3..=3 {
        for ulps in -40_i64..=40 {
            let month = PI + TAU * f64::from(turn);
            let month = f64::from_bits(month.to_bits().wrapping_add_signed(ulps));
            let start = m.assemble(month - 0.2, far).unwrap().coordinates();
            let guess = PinAndSlotCoordinates { month, slot: start.slot + 0.2 + TAU * f64::from(turn), ..start };
            let near = m.assemble_near(&guess, far).unwrap();
            let q = near.coordinates();
            assert!((q.slot - month).abs() < 1e-13, "{q:?}");
            assert_eq!(m.assemble(month, m.branch_of(&near)).unwrap().coordinates(), q);
            let solved = m.solve(&q).unwrap().coordinates;
            let again = m.assemble(month, m.branch_of(&m.pose_at(&solved))).unwrap().coordinates();
            assert!(difference::<PinAndSlot>(&again, &solved, &[]) < 1e-13, "{again:?} {solved:?}");
        }
    }
}

#[test]
fn a_spring_counts_turns() {
    let m = Wound::default();
    let start = m.assemble(0.4, WoundBranch::new(Slider::Far)).unwrap().coordinates();
    comes_back(&m, &start, &[], WoundPose::coordinates);
    let spring = Spring { mechanism: m.clone(), k: 0.4, m: 1.0 };
    let turned = WoundBranch { psi_turn: 2, ..WoundBranch::new(Slider::Far) };
    let q = m.assemble(0.4, turned).unwrap().coordinates();
    assert_eq!(q.psi, start.psi + 2.0 * TAU);
    let [loose, wound] = [start, q].map(|q| spring.energy(&q, 0.0).unwrap().potential);
    assert!((wound - 0.2 * q.psi * q.psi).abs() < 1e-12 && wound > loose + 10.0);
}

/// Positions of a simulation, ten turns either way.
#[test]
fn a_simulation_comes_back() {
    let spring = Spring { mechanism: Wound::default(), k: 1e-3, m: 1.0 };
    let m = &spring.mechanism;
    let start = m.assemble(0.4, WoundBranch::new(Slider::Far)).unwrap().coordinates();
    for speed in [7.0, -7.0] {
        let mut motion = simulate(&spring, Start { t: 0.0, q: start, input_rates: speed }, 20.0, 1e-9).unwrap();
        let mut last = start;
        for step in 1..=1000 {
            let q = motion.at([0.02 * f64::from(step)]).next().unwrap().unwrap().q;
            let pose = m.pose_at(&q);
            let again = m.assemble(q.phi, m.branch_of(&pose)).unwrap().coordinates();
            assert!(difference::<Wound>(&again, &q, &[]) < 1e-12, "{again:?} {q:?}");
            let near = m.assemble_near(&WoundCoordinates { phi: q.phi, ..last }, WoundBranch::new(Slider::Far));
            assert_eq!(near.unwrap().coordinates(), again);
            last = q;
        }
        assert!((last.psi - start.psi).abs() > 10.0 * TAU && (last.psi - start.psi) * speed > 0.0);
    }
}

#[test]
fn turns_that_cannot_be_counted() {
    let m = PinAndSlot::default();
    let far = PinAndSlotBranch::new(Slider::Far);
    let q = m.assemble(0.4, far).unwrap().coordinates();
    let error = m.assemble_near(&PinAndSlotCoordinates { slot: f64::NAN, ..q }, far).unwrap_err();
    assert!(matches!(error, PositionError::NotFinite { .. }), "{error}");
    let error = m.assemble_near(&PinAndSlotCoordinates { slot: 1e300, ..q }, far).unwrap_err();
    assert!(matches!(error, PositionError::Input(InputError::OutOfRange { .. })), "{error}");
    // A pose with an angle beyond the countable turns still has a turn.
    let pose = m.pose_at(&PinAndSlotCoordinates { slot: 1e300, ..q });
    assert!(m.assemble(0.4, m.branch_of(&pose)).is_ok());
}

/// A range of more than a turn counts turns: a pose has the number of its angle, and motions end where it does.
#[test]
fn a_range_counts_turns() {
    let m = Reeled::default();
    let branch = ReeledBranch::new(Elbow::Left);
    let start = m.assemble(1.0, branch).unwrap().coordinates();
    for turn in -3..=3 {
        let q = m.assemble(1.0, ReeledBranch { q_turn: turn, ..branch }).unwrap().coordinates();
        assert_eq!(q.q, start.q + f64::from(turn) * TAU);
        assert_eq!(m.pose_at(&q).coordinates().q, q.q);
        assert_eq!(m.branch_of(&m.pose_at(&q)), ReeledBranch { q_turn: turn, ..branch });
        let ranged = m.ranged(0, &q).unwrap();
        assert_eq!((ranged.value, ranged.is_within()), (q.q, (0..=2).contains(&turn)));
    }
    let mut path = Path::new(&m, &start, Direction::Increasing).unwrap();
    let error = path.advance_to(30.0).unwrap_err();
    assert!(matches!(error, linkage::PathError::JointRange { of: "q", .. }), "{error}");
}

/// A branch has no turn if no angle's number is needed.
#[test]
fn branches_without_turns() {
    let FourBarBranch { theta3_theta4: _, theta3_turn, theta4_turn } = FourBarBranch::new(Elbow::Left);
    assert_eq!([theta3_turn, theta4_turn], [0, 0]);
    let BareBranch { phi_psi: _ } = BareBranch::all().next().unwrap();
}

/// The search for a limit continues over the cut of the slot's angle.
#[test]
fn limits_beyond_a_turn() {
    let m = Limited::default();
    for side in [Elbow::Left, Elbow::Right] {
        let found = m.limits(3.0, LimitedBranch::new(Slider::Far, side)).unwrap();
        // The dyad is stretched where arm^2 + d^2 + 2 arm d sin(out) = (long + short)^2.
        let out = ((4.0_f64 * 4.0 - 4.0 - 9.0) / 12.0).asin();
        let month = |out: f64| -2.0 * out - (m.ecc * (-2.0 * out).sin() / m.pin).asin();
        let [lower, upper] = [found.lower, found.upper].map(|limit| limit.input().unwrap());
        assert!((lower - month(out)).abs() < 1e-12, "{lower} is not {}", month(out));
        assert!((upper - month(-PI - out)).abs() < 1e-12, "{upper} is not {}", month(-PI - out));
    }
}
