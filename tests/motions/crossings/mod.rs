//! Change points at which several groups are singular at once: the end of the range of dyads that are flat together, of
//! inversors, of chains of parallelograms, of a dyad and a parallelogram.
//!
//! The crossing is one event with all groups and all tangents. The tangents follow from closed forms of the motions;
//! following each confirms that a motion exists along it.

mod forms;

use std::f64::consts::{PI, TAU};
use std::fmt::Debug;

use linkage::continuation::{AtChangePoint, Direction, Event, Groups, Options, Path, Tangents};
use linkage::simulation::{Start, simulate};
use linkage::{D, Mechanism, PathError, PerUnknown, linkage, singularity};

use linkage_gallery::coupled_wheels::*;
use linkage_gallery::hart::*;
use linkage_gallery::peaucellier::*;
use linkage_gallery::two_windows::*;

linkage! {
    /// Two dyads that push one slider.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TwoDyads {
        param l = 2, m = 1.5, n = 1.5, w = 1;
        input s;
        unknown a, b, c, d;
        loop l@a + m@b = s@0;
        loop l@c + n@d = s@0;
        body one { mass w; inertia w * l^2 / 12; center (l/2)@a; angle a; }
        body two { mass w; inertia w * l^2 / 12; center (l/2)@c; angle c; }
        body slider { mass w; center s@0; }
        scene Pushing { inertia; energy; }
    }
}

linkage! {
    /// Three different dyads with the same reach.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ThreeDyads {
        param l = 2, m = 1.5, k = 1.25, n = 2.25, r = 3, h = 0.5;
        input s;
        unknown a, b, c, d, e, f;
        loop l@a + m@b = s@0;
        loop k@c + n@d = s@0;
        loop r@e + h@f = s@0;
    }
}

linkage! {
    /// A dyad that drives a parallelogram: both are flat at the same position.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism DyadAndParallelogram {
        param l = 2, m = 1.5, r = 1, k = 3;
        input s;
        unknown a, b, p, q;
        loop l@a + m@b = s@0;
        loop r@a + k@p = k@0 + r@q;
    }
}

linkage! {
    /// Ten windows: at their change points eleven motions cross.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TenWindows {
        param l = 1;
        input phi0;
        unknown psi1, phi1, psi2, phi2, psi3, phi3, psi4, phi4, psi5, phi5, psi6, phi6, psi7, phi7, psi8, phi8, psi9, phi9, psi10, phi10;
        loop ((1 - 1) * l, 0) + l@phi0 + l@psi1 = (1 * l, 0) + l@phi1;
        loop ((2 - 1) * l, 0) + l@phi1 + l@psi2 = (2 * l, 0) + l@phi2;
        loop ((3 - 1) * l, 0) + l@phi2 + l@psi3 = (3 * l, 0) + l@phi3;
        loop ((4 - 1) * l, 0) + l@phi3 + l@psi4 = (4 * l, 0) + l@phi4;
        loop ((5 - 1) * l, 0) + l@phi4 + l@psi5 = (5 * l, 0) + l@phi5;
        loop ((6 - 1) * l, 0) + l@phi5 + l@psi6 = (6 * l, 0) + l@phi6;
        loop ((7 - 1) * l, 0) + l@phi6 + l@psi7 = (7 * l, 0) + l@phi7;
        loop ((8 - 1) * l, 0) + l@phi7 + l@psi8 = (8 * l, 0) + l@phi8;
        loop ((9 - 1) * l, 0) + l@phi8 + l@psi9 = (9 * l, 0) + l@phi9;
        loop ((10 - 1) * l, 0) + l@phi9 + l@psi10 = (10 * l, 0) + l@phi10;
    }
}

fn options(at_change_point: AtChangePoint) -> Options {
    Options { at_change_point, ..Options::default() }
}

/// Follows a mechanism to its next event, which must be a crossing.
fn crossing<M: Mechanism<Scalar = f64, V = D<1>>>(
    m: &M,
    start: &M::Coordinates,
    direction: Direction<M::Rates>,
) -> (M::Coordinates, Groups<M::Name>, Tangents<M::Rates>)
where
    M::Coordinates: Debug,
{
    let mut path = Path::with(m, start, direction, options(AtChangePoint::Stop)).unwrap();
    let step = path.find_map(|step| step.map(|step| step.event.map(|event| (step.position, event))).transpose());
    match step {
        Some(Ok((q, Event::ChangePoint { groups, tangents }))) => {
            assert!(path.next().is_none());
            let error = path.advance().unwrap_err();
            assert!(matches!(error, PathError::ChangePoint { group, .. } if group == groups.first()), "{error}");
            (q, groups, tangents)
        }
        other => panic!("{other:?}"),
    }
}

fn vector<M: Mechanism<Scalar = f64, V = D<1>>>(rates: &M::Rates) -> (PerUnknown<M>, f64) {
    let (unknowns, inputs) = M::rate_parts(rates);
    (unknowns, inputs[0])
}

/// The sine of the angle between two directions of coordinates that all are angles, or of a length that rests.
fn apart<M: Mechanism<Scalar = f64, V = D<1>>>(one: &M::Rates, two: &M::Rates) -> f64 {
    let [(u, v), (w, x)] = [one, two].map(vector::<M>);
    let (norm, other) = (u.norm().hypot(v), w.norm().hypot(x));
    let sign = if u.dot(&w) + v * x < 0.0 { -1.0 } else { 1.0 };
    (u * norm.recip() - w * (sign / other)).norm().hypot(v / norm - sign * x / other)
}

/// The tangents are these, in any order and either way.
#[track_caller]
fn are<M: Mechanism<Scalar = f64, V = D<1>>>(found: &Tangents<M::Rates>, expected: &[M::Rates])
where
    M::Coordinates: Debug,
{
    assert_eq!(found.len(), expected.len(), "{found:?}");
    assert!(found.is_complete() && !found.is_empty());
    for expected in expected {
        let nearest = found.iter().map(|tangent| apart::<M>(tangent, expected)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-12, "{expected:?} is {nearest:e} off {found:?}");
    }
}

/// Along each tangent a motion leaves, both ways: a position on it lies in that direction, to the square of its
/// distance.
fn lead_on<M: Mechanism<Scalar = f64, V = D<1>>>(m: &M, at: &M::Coordinates, tangents: &Tangents<M::Rates>) -> usize
where
    M::Coordinates: Debug,
{
    let short = Options { longest_step: 1e-3, ..options(AtChangePoint::Stop) };
    let mut count = 0;
    for tangent in tangents.iter() {
        for sign in [1.0, -1.0] {
            let (u, v) = vector::<M>(tangent);
            let way = M::rates(u * sign, [sign * v].into());
            let mut path = Path::with(m, at, Direction::Along(way), short).unwrap();
            let step = (0..4).map(|_| path.advance().unwrap()).last().unwrap();
            assert!(step.event.is_none(), "{step:?}");
            let pose = m.pose_at(&step.position);
            assert!(m.residual(&pose).zip_map(&m.residual_scales(&pose), |psi, size| psi / size).largest() < 1e-14);
            let ((u, v), (w, x)) = (M::parts(&step.position), M::parts(at));
            let gone = M::rates(u - w, v - x);
            assert!(apart::<M>(&gone, &way) < 10.0 * step.length, "{gone:?} is not along {way:?}");
            assert!((u - w).dot(&M::rate_parts(&way).0) > 0.0);
            count += 1;
        }
    }
    count
}

#[test]
fn two_dyads_flat_together() {
    let m = TwoDyads::default();
    for start in TwoDyadsBranch::all() {
        let q = m.assemble(2.0, start).unwrap().coordinates();
        for (direction, end, ratio) in
            [(Direction::Increasing, 3.5, -2.0 / 1.5), (Direction::Decreasing, 0.5, 2.0 / 1.5)]
        {
            let (at, groups, tangents) = crossing(&m, &q, direction);
            assert!((at.s - end).abs() < 1e-15, "{at:?}");
            assert!([at.a, at.c].iter().all(|angle| angle.sin().abs() < 1e-15), "{at:?}");
            assert!(groups.iter().eq(["a, b", "c, d"]), "{groups:?}");
            // l sin a + m sin b = 0, and s = l cos a + m cos b is as even in a as in c.
            let along = |c: f64| TwoDyadsRates { a: 1.0, b: ratio, c, d: c * ratio, s: 0.0 };
            are::<TwoDyads>(&tangents, &[along(1.0), along(-1.0)]);
            assert_eq!(lead_on(&m, &at, &tangents), 4);

            // Straight on, both elbows change; on the other motion one does.
            let beyond = end + 0.1 * (end - 2.0).signum();
            for (policy, changed) in [(AtChangePoint::Keep, [true, true]), (AtChangePoint::Switch, [true, false])] {
                let mut path = Path::with(&m, &q, direction, options(policy)).unwrap();
                let error = path.advance_to(beyond).unwrap_err();
                assert!(matches!(error, PathError::DeadPoint { group: "a, b", .. }), "{error}");
                let back = m.branch_of(&m.pose_at(&path.advance_to(2.0).unwrap().position));
                let mut elbows = [back.a_b != start.a_b, back.c_d != start.c_d];
                elbows.sort_unstable();
                let mut expected = changed;
                expected.sort_unstable();
                assert_eq!(elbows, expected, "{start:?} {policy:?}");
            }
            let mut path = Path::with(&m, &q, direction, options(AtChangePoint::Stop)).unwrap();
            let error = PathError::ChangePoint { mechanism: "TwoDyads", group: "a, b" };
            assert_eq!(path.advance_to(beyond), Err(error));
            assert!((path.position().s - end).abs() < 1e-15);

            // From a start at the crossing, all four assemblies can be reached.
            let reached = [along(1.0), along(-1.0)].map(|way| {
                [1.0, -1.0].map(|sign| {
                    let way =
                        TwoDyadsRates { a: sign * way.a, b: sign * way.b, c: sign * way.c, d: sign * way.d, s: 0.0 };
                    let mut path = Path::new(&m, &at, Direction::Along(way)).unwrap();
                    m.branch_of(&m.pose_at(&path.advance_to(2.0).unwrap().position))
                })
            });
            let reached: Vec<_> = reached.into_iter().flatten().collect();
            assert!(TwoDyadsBranch::all().all(|branch| reached.contains(&branch)), "{reached:?}");
            for direction in [Direction::Increasing, Direction::Decreasing] {
                assert_eq!(Path::new(&m, &at, direction).err(), Some(error));
            }
            // The report of the place says the same: no input can move, and both groups are singular.
            let report = singularity::report(&m, &m.pose_at(&at)).unwrap();
            assert_eq!((report.rank(), report.rank_with_inputs(), report.admissible().count()), (2, 3, 0));
            assert!(report.groups().all(|group| !group.is_regular));
        }
    }
}

/// Another unit of length changes exponents only.
#[test]
fn scale_free() {
    let m = TwoDyads::default();
    let start = m.assemble(2.0, TwoDyadsBranch::all().next().unwrap()).unwrap().coordinates();
    let (at, groups, tangents) = crossing(&m, &start, Direction::Increasing);
    for scale in [2.0_f64.powi(-300), 2.0_f64.powi(300)] {
        let TwoDyads { l, m: n, n: o } = m;
        let scaled = TwoDyads { l: l * scale, m: n * scale, n: o * scale };
        let start = TwoDyadsCoordinates { s: start.s * scale, ..start };
        let (found, in_groups, along) = crossing(&scaled, &start, Direction::Increasing);
        assert_eq!((found.s, found.a, found.d), (at.s * scale, at.a, at.d));
        assert_eq!((in_groups, along.len()), (groups, 2));
        for (found, expected) in along.iter().zip(tangents.iter()) {
            assert_eq!((found.a, found.b, found.c, found.d), (expected.a, expected.b, expected.c, expected.d));
        }
    }
}

/// If the second dyad reaches a little further, there is no crossing but a dead point of the first.
#[test]
fn a_near_crossing_is_a_dead_point() {
    for longer in [1e-3, 1e-6, 1e-9, 1e-12] {
        let m = TwoDyads { n: 1.5 + longer, ..TwoDyads::default() };
        for start in TwoDyadsBranch::all() {
            let q = m.assemble(2.0, start).unwrap().coordinates();
            let mut path = Path::with(&m, &q, Direction::Increasing, options(AtChangePoint::Stop)).unwrap();
            let error = path.advance_to(3.6).unwrap_err();
            assert!(matches!(error, PathError::DeadPoint { group: "a, b", .. }), "{longer:e}: {error}");
            let back = m.branch_of(&m.pose_at(&path.advance_to(2.0).unwrap().position));
            assert!(back.a_b != start.a_b && back.c_d == start.c_d, "{longer:e}: {back:?}");
        }
    }
}

/// Three groups: their angles take each sign by itself, which are four lines; a' : c' from s'' = -l a'^2 (1 + l/m).
#[test]
fn three_dyads_flat_together() {
    let m = ThreeDyads::default();
    let ThreeDyads { l, m: n, k, n: o, r, h } = m;
    let bend = |one: f64, two: f64| (one * (1.0 + one / two)).sqrt().recip();
    let [a, c, e] = [bend(l, n), bend(k, o), bend(r, h)];
    let along = |second: f64, third: f64| ThreeDyadsRates {
        a,
        b: -a * l / n,
        c: second * c,
        d: -second * c * k / o,
        e: third * e,
        f: -third * e * r / h,
        s: 0.0,
    };
    let expected = [along(1.0, 1.0), along(1.0, -1.0), along(-1.0, 1.0), along(-1.0, -1.0)];
    for start in ThreeDyadsBranch::all() {
        let q = m.assemble(3.0, start).unwrap().coordinates();
        let (at, groups, tangents) = crossing(&m, &q, Direction::Increasing);
        assert!((at.s - 3.5).abs() < 1e-15);
        assert!(groups.iter().eq(["a, b", "c, d", "e, f"]), "{groups:?}");
        are::<ThreeDyads>(&tangents, &expected);
        assert_eq!(lead_on(&m, &at, &tangents), 8);
        // Straight on, all elbows change.
        let mut path = Path::new(&m, &q, Direction::Increasing).unwrap();
        assert!(matches!(path.advance_to(3.6), Err(PathError::DeadPoint { .. })));
        let back = m.branch_of(&m.pose_at(&path.advance_to(3.0).unwrap().position));
        assert!(back.a_b != start.a_b && back.c_d != start.c_d && back.e_f != start.e_f, "{back:?}");
        // There is more than one other motion: the path returns an error instead of taking one.
        let mut path = Path::with(&m, &q, Direction::Increasing, options(AtChangePoint::Switch)).unwrap();
        assert!(matches!(path.advance_to(3.6), Err(PathError::ChangePoint { .. })));
        path.choose(&expected[1]).unwrap();
        path.advance().unwrap();
    }
}

/// A dead point of one group at a change point of the next: q = p k/r + a, and 2 a p + (k/r - 1) p^2 = 0.
#[test]
fn a_dyad_flat_where_a_parallelogram_is() {
    let m = DyadAndParallelogram::default();
    let DyadAndParallelogram { l, m: n, r, k } = m;
    for sign in [1.0, -1.0] {
        let a = sign * 0.3_f64;
        let b = -(l * a.sin() / n).asin();
        let q = DyadAndParallelogramCoordinates { s: l * a.cos() + n * b.cos(), a, b, p: 0.0, q: a };
        let (at, groups, tangents) = crossing(&m, &q, Direction::Increasing);
        assert!((at.s - 3.5).abs() < 1e-15 && at.a.abs() < 1e-12);
        assert!(groups.iter().eq(["a, b", "p, q"]), "{groups:?}");
        let along = |p: f64| DyadAndParallelogramRates { a: 1.0, b: -l / n, p, q: 1.0 + p * k / r, s: 0.0 };
        are::<DyadAndParallelogram>(&tangents, &[along(0.0), along(-2.0 / (k / r - 1.0))]);
        assert!(apart::<DyadAndParallelogram>(&tangents[0], &along(0.0)) < 1e-12);
        assert_eq!(lead_on(&m, &at, &tangents), 4);
    }
}

/// At its ends an inversor has one event of all its groups, at 2 crank cos(theta / 2) = long - short. The outer joints
/// of the dyad of the tips coincide there and it turns freely: a family of motions begins.
#[test]
fn ends_of_inversors() {
    for m in [Peaucellier::default(), Peaucellier::new(2.0, 5.0, 2.0), Peaucellier::new(1.6, 5.0, 2.0)] {
        let end = 2.0 * ((m.long - m.short) / (2.0 * m.crank)).acos();
        let mut reached = 0;
        for start in PeaucellierBranch::all().filter_map(|branch| m.assemble(0.2, branch).ok()) {
            for (direction, theta) in [(Direction::Increasing, end), (Direction::Decreasing, -end)] {
                let q = start.coordinates();
                let (at, groups, tangents) = crossing(&m, &q, direction);
                assert!((at.theta - theta).abs() < 1e-14, "{at:?}");
                assert!(groups.iter().eq([
                    "upper, upper_side (O-Upper-P)",
                    "lower, lower_side (O-Lower-P)",
                    "upper_tip, lower_tip (Upper-Q-Lower)"
                ]));
                assert!(!tangents.is_complete());
                // The motion that came: the dyads against each other, and the tips along.
                let followed = tangents[0];
                assert!(followed.theta.abs() < 1e-12 && (followed.upper + followed.lower).abs() < 1e-12);
                assert!((followed.upper_tip + followed.lower_tip).abs() < 1e-12 && followed.upper.abs() > 0.1);
                // On the way through it is one event.
                let mut path = Path::new(&m, &q, direction).unwrap();
                let first = path.by_ref().map(Result::unwrap).find(|step| step.event.is_some()).unwrap();
                assert!(matches!(first.event, Some(Event::ChangePoint { .. })));
                let after = path.map(Result::unwrap).take_while(|step| step.length < first.length + 1.0);
                assert_eq!(after.filter(|step| step.event.is_some()).count(), 0);
                reached += 1;
            }
        }
        assert!(reached >= 4, "{reached}");
    }
    let m = Hart::default();
    for branch in HartBranch::all() {
        let q = m.assemble(0.2, branch).unwrap().coordinates();
        let (at, groups, tangents) = crossing(&m, &q, Direction::Increasing);
        assert!(groups.iter().eq(["alpha, beta", "gamma, delta (B-C-D)"]));
        assert!(tangents.len() == 2 && tangents.is_complete());
        assert_eq!(lead_on(&m, &at, &tangents), 4);
    }
}

/// N windows in line: the uprights before one rest, those from it on turn, N + 1 motions; laid to the other side, the
/// uprights up to one turn. Some cross the others at second order only along themselves, and are reported too.
#[test]
fn a_chain_of_parallelograms() {
    let m = TwoWindows::default();
    let up = |angle| TwoWindowsCoordinates { phi0: angle, phi1: angle, phi2: angle, psi1: 0.0, psi2: 0.0 };
    let rates = |phi: [f64; 3], side: f64| TwoWindowsRates {
        phi0: phi[0],
        phi1: phi[1],
        phi2: phi[2],
        psi1: side * (phi[1] - phi[0]),
        psi2: side * (phi[2] - phi[1]),
    };
    for direction in [Direction::Increasing, Direction::Decreasing] {
        for start in [1.0, 4.0] {
            let (at, groups, tangents) = crossing(&m, &up(start), direction);
            assert!((at.phi0 - PI).abs() < 1e-15 || at.phi0.abs() < 1e-15 || (at.phi0 - TAU).abs() < 1e-15);
            assert!(groups.iter().eq(["psi1, phi1", "psi2, phi2"]), "{groups:?}");
            // At 0, l@phi + l@psi = l@0 + l@phi' gives phi' = phi + psi and phi psi = 0; at pi -phi + psi = -phi' and
            // phi psi = psi^2.
            let at_pi = at.phi0.cos() < 0.0;
            let expected = if at_pi {
                [rates([1.0, 1.0, 1.0], -1.0), rates([1.0, 1.0, 0.0], -1.0), rates([1.0, 0.0, 0.0], -1.0)]
            } else {
                [rates([1.0, 1.0, 1.0], 1.0), rates([0.0, 1.0, 1.0], 1.0), rates([0.0, 0.0, 1.0], 1.0)]
            };
            are::<TwoWindows>(&tangents, &expected);
            assert!(apart::<TwoWindows>(&tangents[0], &expected[0]) < 1e-12);
        }
    }
    // The motion goes straight on over ten crossings and reports each once.
    let mut path = Path::new(&m, &up(1.0), Direction::Increasing).unwrap();
    let mut passed = 0;
    while path.position().phi0 < 1.0 + 5.0 * TAU {
        let step = path.advance().unwrap();
        let q = step.position;
        assert!((q.phi1 - q.phi0).abs() < 1e-12 && (q.phi2 - q.phi0).abs() < 1e-12 && q.psi1.abs() < 1e-12);
        match step.event {
            None => {}
            Some(Event::ChangePoint { .. }) => passed += 1,
            Some(event) => panic!("{event:?}"),
        }
    }
    assert_eq!(passed, 10);
}

/// If there are more motions than the report holds, it has the one that is followed and says that it is incomplete.
#[test]
fn ten_windows() {
    let m = TenWindows::default();
    let up = |angle: f64| {
        let unknowns = PerUnknown::<TenWindows>::from_fn(|place| if place % 2 == 1 { angle } else { 0.0 });
        TenWindows::coordinates(unknowns, [angle].into())
    };
    let (at, groups, tangents) = crossing(&m, &up(1.0), Direction::Increasing);
    assert!((at.phi0 - PI).abs() < 1e-15 && groups.iter().count() == 10);
    assert!(!tangents.is_complete());
    let (unknowns, inputs) = TenWindows::parts(&up(1.0));
    assert!(apart::<TenWindows>(&tangents[0], &TenWindows::rates(unknowns, inputs)) < 1e-12);
    let mut path = Path::new(&m, &up(1.0), Direction::Increasing).unwrap();
    let mut passed = 0;
    while path.position().phi0 < 1.0 + 2.0 * TAU {
        let step = path.advance().unwrap();
        assert!((step.position.phi10 - step.position.phi0).abs() < 1e-12 && step.position.psi5.abs() < 1e-12);
        passed += usize::from(matches!(step.event, Some(Event::ChangePoint { .. })));
        assert!(matches!(step.event, None | Some(Event::ChangePoint { .. })), "{:?}", step.event);
    }
    assert_eq!(passed, 4);
}

/// All four bars of one length: folded, the crank rests while the others turn.
#[test]
fn a_rhombus() {
    let m = CoupledWheels::new(1.0, 1.0);
    let at = |theta| CoupledWheelsCoordinates { theta, rod: 0.0, follower: theta };
    let (q, groups, tangents) = crossing(&m, &at(-1.0), Direction::Increasing);
    assert!(q.theta.abs() < 1e-15 && groups.iter().eq(["rod, follower (B-C-D)"]));
    // rod = follower - theta, and theta (follower - theta) = 0.
    let together = CoupledWheelsRates { theta: 1.0, rod: 0.0, follower: 1.0 };
    let folded = CoupledWheelsRates { theta: 0.0, rod: 1.0, follower: 1.0 };
    are::<CoupledWheels>(&tangents, &[together, folded]);
}

/// A motion of the dyads by their inertia goes straight on through both ends, both elbows at once.
#[test]
fn simulated_straight_on() {
    let scene = Pushing::default();
    for branch in TwoDyadsBranch::all() {
        let q = scene.mechanism.assemble(2.0, branch).unwrap().coordinates();
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 2.0 }, 20.0, tolerance).unwrap();
            let same = if (q.a - q.c).abs() < 1e-9 { 1.0 } else { -1.0 };
            let turned = motion.finish(|state, _| {
                assert!((state.q.a - same * state.q.c).sin().abs() < 1e-6, "{branch:?} {tolerance:e}: {state:?}");
                true
            });
            println!("{branch:?} {tolerance:e} {:?} {:?}", motion.passages(), motion.t());
            turned.unwrap();
            assert!(motion.passages().change_points > 2);
        }
    }
}
