//! Reports: what they say of links, circuits, classes, transmission angles, strokes and dwells, against theorems and other
//! ways to the same numbers.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use approx::assert_relative_eq;
use linkage::circuits::{CircuitOptions, Circuits};
use linkage::continuation::Options;
use linkage::range_of_motion::{MotionEnd, RangeOfMotion, RangeOptions};
use linkage::report::{
    DwellOptions, DyadKind, GrashofClass, LinksAndJoints, Mobility, Report, ReportOptions, ReportedModes,
};
use linkage::{Elbow, PathError, Slider, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    #[derive(Debug, Clone, Copy)]
    mechanism FourBar {
        param ground = 80, crank = 20, coupler = 50, rocker = 70;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        output swing = psi;
    }
    /// The ground last, and the rocker drives.
    mechanism GroundLast {
        param ground = 80, crank = 20, coupler = 50, rocker = 70;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = rocker@psi + ground@0;
    }
    /// The rocker is named first.
    mechanism RockerFirst {
        param ground = 80, crank = 20, coupler = 50, rocker = 70;
        input theta;
        unknown psi, phi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
    }
    /// The angle of the coupler is measured from the rocker, and that of the rocker clockwise.
    mechanism Relative {
        param ground = 80, crank = 20, coupler = 50, rocker = 70;
        input theta;
        unknown bend, psi;
        loop crank@theta + coupler@(bend - psi) = ground@0 + rocker@(-psi);
    }
    mechanism SliderCrank {
        param r = 20, l = 60, e = 15;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, e);
        output stroke = s;
    }
    mechanism Shaper {
        param crank = 50, offset = 120;
        input theta;
        unknown psi, s;
        loop crank@theta = (0, -offset) + s@psi;
        output swing = psi - 90deg;
    }
    /// A slotted arm whose slot passes its pivot at a distance.
    mechanism OffsetSlot {
        param a = 40, c = 20, d = 100;
        input theta;
        unknown psi, s;
        loop a@theta = d@0 + c@psi + s@(psi + 90deg);
    }
    mechanism Points {
        param a = 20, b = 55, c = 45, d = 60;
        input theta;
        unknown x, y;
        equation norm((x, y) - a@theta) = b;
        equation norm((x, y) - (d, 0)) = c;
    }
    /// A third crank supports the coupler.
    mechanism ThreeCranks {
        param a = 2, b = 5;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = b@0 + a@psi;
        implied loop a@theta + (2*b)@phi = (2*b)@0 + a@psi;
    }
    mechanism Geared {
        param a = 1, b = 2.5, c = 2.2, d = 0.8, e = 2, ratio = -2;
        input theta1;
        unknown theta2, theta3, theta4;
        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;
        equation theta4 = ratio * theta1;
    }
    mechanism FiveBar {
        param a = 1, b = 2, c = 2, d = 1, e = 1.5;
        input one, other;
        unknown phi, psi;
        loop a@one + b@phi = e@0 + d@other + c@psi;
    }
    mechanism Cubed {
        input theta;
        unknown x;
        equation x = sin(theta)^3;
        output lift = x;
    }
    mechanism Kepler {
        param e = 0.3;
        input mean;
        unknown anomaly;
        equation anomaly - e * sin(anomaly) = mean;
        point Mean = 1@mean;
    }
}

fn left() -> FourBarBranch {
    FourBarBranch::new(Elbow::Left)
}

fn of_four_bar(m: &FourBar) -> Report {
    Report::on_branch(m, FourBar::DERIVATION, left(), [1.0], &ReportOptions::default()).unwrap()
}

fn chain_of(mobility: &Mobility) -> &LinksAndJoints {
    mobility.chain.as_ref().expect("links and joints")
}

/// With one coordinate for each moving link, n = N + 1 and j = N + L: the count of links is that of coordinates.
#[test]
fn links_and_joints() {
    for (mobility, loops) in [
        (Mobility::of(FourBar::<f64>::DERIVATION), 1),
        (Mobility::of(GroundLast::<f64>::DERIVATION), 1),
        (Mobility::of(Relative::<f64>::DERIVATION), 1),
        (Mobility::of(SliderCrank::<f64>::DERIVATION), 1),
        (Mobility::of(Shaper::<f64>::DERIVATION), 1),
        (Mobility::of(OffsetSlot::<f64>::DERIVATION), 1),
        (Mobility::of(Geared::<f64>::DERIVATION), 1),
        (Mobility::of(FiveBar::<f64>::DERIVATION), 1),
    ] {
        let chain = chain_of(&mobility);
        assert_eq!((chain.links.len(), chain.loops), (mobility.coordinates + 1, loops), "{mobility:?}");
        assert_eq!(chain.turning + chain.sliding, mobility.coordinates + loops);
        assert_eq!((chain.count, chain.redundant), (mobility.degrees_of_freedom as i64, 0));
    }
    let of = Mobility::of(SliderCrank::<f64>::DERIVATION);
    assert_eq!((chain_of(&of).turning, chain_of(&of).sliding), (3, 1));
    assert_eq!(chain_of(&Mobility::of(Geared::<f64>::DERIVATION)).conditions, 1);
    // Two distances have no vectors.
    assert_eq!(Mobility::of(Points::<f64>::DERIVATION).chain, None);
}

/// A third crank adds a link and two joints: one constraint is redundant in a parallelogram.
#[test]
fn a_redundant_constraint() {
    let mobility = Mobility::of(ThreeCranks::<f64>::DERIVATION);
    let chain = chain_of(&mobility);
    assert_eq!((chain.links.len(), chain.turning, chain.loops), (5, 6, 2));
    assert_eq!((chain.count, chain.redundant, mobility.degrees_of_freedom, mobility.implied), (0, 1, 1, 2));
    let m = ThreeCranks::default();
    let start = ThreeCranksCoordinates { theta: 0.5, phi: 0.0, psi: 0.5 };
    let report = Report::of(&m, ThreeCranks::DERIVATION, &start, &ReportOptions::default()).unwrap();
    assert!(report.to_string().contains("1 constraint is redundant"), "{report}");
}

/// Grashof's law, which knows lengths only, against circuits, which know positions only: a link that turns fully has two
/// circuits, and the driving link turns fully if it or the ground is the shortest.
#[test]
fn classes_against_circuits() {
    let random = &mut SmallRng::seed_from_u64(1883);
    let mut seen = [0; 5];
    for _ in 0..linkage_trials::count("GRASHOF", 30, 60) {
        let [ground, crank, coupler, rocker] = [0; 4].map(|_| random.random_range(1.0..5.0));
        let m = FourBar { ground, crank, coupler, rocker };
        let (class, margin) = GrashofClass::of([ground, crank, coupler, rocker]);
        let start = (0..360).map(|step| f64::from(step).to_radians()).find(|&theta| m.assemble(theta, left()).is_ok());
        // Longer than all others together.
        let Some(theta) = start else { continue };
        let position = m.assemble(theta + 1e-3, left());
        let Ok(position) = position else { continue };
        let input = position.coordinates().theta;
        let circuits = Circuits::of(&m, input, CircuitOptions::default()).unwrap();
        let turns = circuits.full_turns() > 0;
        let expected = match class {
            GrashofClass::DoubleCrank | GrashofClass::CrankRocker => (2, true),
            GrashofClass::RockerCrank | GrashofClass::DoubleRocker => (2, false),
            GrashofClass::TripleRocker => (1, false),
            GrashofClass::ChangePoint => panic!("random lengths"),
        };
        let report = Report::of(&m, FourBar::DERIVATION, &position.coordinates(), &ReportOptions::default()).unwrap();
        let motion = report.motion.as_ref().unwrap();
        let four_bar = &motion.four_bars[0];
        assert_eq!(four_bar.class, class);
        assert_relative_eq!(four_bar.margin, margin, epsilon = 1e-15);
        for (found, length) in four_bar.lengths.iter().zip([ground, crank, coupler, rocker]) {
            assert_relative_eq!(*found, length, max_relative = 1e-14);
        }
        // A driving link that swings about both sides of the frame has a range for each circuit, found at its own inputs.
        assert_eq!(turns, expected.1, "{m:?} {class}");
        assert_eq!(motion.is_closed(), turns);
        if turns || class == GrashofClass::TripleRocker {
            assert_eq!(circuits.circuits.len(), expected.0, "{m:?} {class}");
        }
        seen[class as usize] += 1;
    }
    assert!(seen.iter().all(|&count| count > 1), "{seen:?}");
}

/// The coupler follows from the joints, not from the order of names: a sum of vectors has none.
#[test]
fn the_coupler_is_between_the_other_links() {
    let m = RockerFirst { ground: 4.0, crank: 3.0, coupler: 1.5, rocker: 3.2 };
    let branch = m.branches(1.0).unwrap().next().unwrap().branch;
    let report = Report::on_branch(&m, RockerFirst::DERIVATION, branch, [1.0], &ReportOptions::default()).unwrap();
    let four_bar = &report.motion.as_ref().unwrap().four_bars[0];
    assert_eq!(four_bar.links, ["theta", "phi", "psi"]);
    assert_eq!(four_bar.class, GrashofClass::DoubleRocker);
    assert_relative_eq!(four_bar.lengths[2], m.coupler, max_relative = 1e-14);
}

/// Equal sums: a parallelogram, a kite.
#[test]
fn change_point_linkages() {
    for lengths in [[5.0, 2.0, 5.0, 2.0], [3.0, 3.0, 1.7, 1.7], [0.1, 0.2, 0.3, 0.2], [1.0, 1.0, 1.0, 1.0]] {
        assert_eq!(GrashofClass::of(lengths).0, GrashofClass::ChangePoint, "{lengths:?}");
    }
    let near = GrashofClass::of([5.0, 2.0, 5.0, 2.0 * (1.0 + 1e-13)]);
    assert_ne!(near.0, GrashofClass::ChangePoint);
}

/// The angle between coupler and rocker is extreme where the crank is in line with the ground, by the law of cosines,
/// however the angles are measured.
#[test]
fn transmission_angles_of_four_bars() {
    let random = &mut SmallRng::seed_from_u64(1932);
    for _ in 0..8 {
        let crank = random.random_range(0.5..1.0);
        let [coupler, rocker] = [0; 2].map(|_| random.random_range(2.0..4.0));
        let ground = random.random_range(3.0..3.9_f64).min(coupler + rocker - crank - 0.05);
        if GrashofClass::of([ground, crank, coupler, rocker]).0 != GrashofClass::CrankRocker {
            continue;
        }
        let options = &ReportOptions::default();
        let plain = FourBar { ground, crank, coupler, rocker };
        let plain = Report::on_branch(&plain, FourBar::DERIVATION, left(), [1.0], options).unwrap();
        let relative = Relative { ground, crank, coupler, rocker };
        let branch = relative.branches(1.0).unwrap().next().unwrap().branch;
        let relative = Report::on_branch(&relative, Relative::DERIVATION, branch, [1.0], options).unwrap();
        let angle = |diagonal: f64| {
            ((coupler * coupler + rocker * rocker - diagonal * diagonal) / (2.0 * coupler * rocker)).acos()
        };
        let [least, largest] = [angle(ground - crank), angle(ground + crank)];
        for report in [plain, relative] {
            let transmission = &report.motion.as_ref().unwrap().transmission[0];
            let between = transmission.between.unwrap();
            assert_relative_eq!(between.least.value, least, max_relative = 1e-13);
            assert_relative_eq!(between.largest.value, largest, max_relative = 1e-13);
            let worst = least.min(PI - largest);
            assert_relative_eq!(transmission.least.value, worst, max_relative = 1e-13);
            let at = transmission.least.input;
            assert!(at.sin().abs() < 1e-7, "{at}");
            assert_eq!(transmission.kind, DyadKind::Rrr);
        }
    }
}

/// The sine of the pressure angle of a slider is (r + e) / l at most; a slot through its pivot has an angle of 90 degrees.
#[test]
fn transmission_angles_of_sliders() {
    let m = SliderCrank::default();
    let branch = SliderCrankBranch { psi_s: Slider::Far };
    let report = Report::on_branch(&m, SliderCrank::DERIVATION, branch, [1.0], &ReportOptions::default()).unwrap();
    let transmission = &report.motion.as_ref().unwrap().transmission[0];
    assert_eq!((transmission.kind, transmission.between), (DyadKind::Rrp, None));
    assert_relative_eq!(transmission.least.value, ((m.r + m.e) / m.l).acos(), max_relative = 1e-14);
    assert_relative_eq!(transmission.largest.value, FRAC_PI_2, max_relative = 1e-14);

    let m = Shaper::default();
    let branch = m.branches(1.0).unwrap().next().unwrap().branch;
    let report = Report::on_branch(&m, Shaper::DERIVATION, branch, [1.0], &ReportOptions::default()).unwrap();
    let transmission = &report.motion.as_ref().unwrap().transmission[0];
    assert_eq!(transmission.kind, DyadKind::Rpr);
    assert_relative_eq!(transmission.least.value, FRAC_PI_2, max_relative = 1e-14);

    // The arm to the pin is at atan(s / c) to the foot of the slot; s^2 = D^2 - c^2 is extreme with the crank in line.
    let m = OffsetSlot::default();
    let branch = m.branches(1.0).unwrap().next().unwrap().branch;
    let report = Report::on_branch(&m, OffsetSlot::DERIVATION, branch, [1.0], &ReportOptions::default()).unwrap();
    let least = report.motion.as_ref().unwrap().transmission[0].least.value;
    let nearest = m.d - m.a;
    assert_relative_eq!(least, ((nearest * nearest - m.c * m.c).sqrt() / m.c).atan(), max_relative = 1e-13);
}

/// A joint by its distances has the angle of the same links by vectors.
#[test]
fn a_point_at_two_distances() {
    let m = Points::default();
    let branch = m.branches(1.0).unwrap().next().unwrap().branch;
    let report = Report::on_branch(&m, Points::DERIVATION, branch, [1.0], &ReportOptions::default()).unwrap();
    let found = &report.motion.as_ref().unwrap().transmission[0];
    let same = of_four_bar(&FourBar { ground: m.d, crank: m.a, coupler: m.b, rocker: m.c });
    let expected = &same.motion.as_ref().unwrap().transmission[0];
    assert_relative_eq!(found.least.value, expected.least.value, max_relative = 1e-13);
    assert!(report.motion.as_ref().unwrap().four_bars.is_empty());
}

/// (180 + alpha) / (180 - alpha), where alpha is the angle between the coupler at both ends of the swing.
#[test]
fn time_ratios_of_crank_rockers() {
    for (ground, crank, coupler, rocker) in [(80.0, 20.0, 50.0, 70.0), (4.0, 1.0, 3.5, 2.5), (3.0, 0.8, 2.6, 1.7)] {
        let m = FourBar { ground, crank, coupler, rocker };
        let report = of_four_bar(&m);
        let swing = &report.motion.as_ref().unwrap().quantities[0];
        // The angle between ground and the line of crank and coupler, where these are in line.
        let towards =
            |length: f64| ((ground * ground + length * length - rocker * rocker) / (2.0 * ground * length)).acos();
        let alpha = (towards(coupler + crank) - towards(coupler - crank)).abs();
        let ratio = (PI + alpha) / (PI - alpha);
        assert_relative_eq!(swing.time_ratio.unwrap(), ratio, max_relative = 1e-12);
        assert_eq!(swing.strokes.len(), 2);
        assert_relative_eq!(swing.strokes.iter().map(|stroke| stroke.share).sum::<f64>(), 1.0, max_relative = 1e-15);
    }
    // Of a slotted lever sin(swing / 2) = crank / offset, and alpha is the swing.
    let m = Shaper::default();
    let branch = m.branches(1.0).unwrap().next().unwrap().branch;
    let report = Report::on_branch(&m, Shaper::DERIVATION, branch, [1.0], &ReportOptions::default()).unwrap();
    let alpha = 2.0 * (m.crank / m.offset).asin();
    let swing = &report.motion.as_ref().unwrap().quantities[0];
    assert_relative_eq!(swing.time_ratio.unwrap(), (PI + alpha) / (PI - alpha), max_relative = 1e-12);
    assert_relative_eq!(swing.extremes.largest.value - swing.extremes.least.value, alpha, max_relative = 1e-14);
}

/// x = sin^3 theta rests where 3 pi sin^2 theta |cos theta| is less than a tenth: about 0 and 180 degrees, and too
/// shortly at both ends of its stroke.
#[test]
fn dwells_of_a_cube() {
    let m = Cubed::default();
    let start = CubedCoordinates { theta: 1.0, x: 1.0_f64.sin().powi(3) };
    let range = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
    let with = |shortest| {
        let options =
            ReportOptions { dwell: DwellOptions { shortest, ..DwellOptions::default() }, ..Default::default() };
        let report = Report::of_motion(&range, Cubed::DERIVATION, &options).unwrap();
        report.motion.unwrap().quantities[0].dwells.clone()
    };
    let dwells = with(1.0 / 36.0);
    assert_eq!(dwells.len(), 2, "{dwells:?}");
    // By bisection.
    let (mut low, mut high) = (0.0_f64, 0.5_f64);
    while high - low > 1e-15 {
        let middle = 0.5 * (low + high);
        let rate = 3.0 * PI * middle.sin().powi(2) * middle.cos();
        *(if rate < 0.1 { &mut low } else { &mut high }) = middle;
    }
    for dwell in &dwells {
        assert_relative_eq!(dwell.to - dwell.from, 2.0 * low, max_relative = 1e-11);
        assert!((0.5 * (dwell.from + dwell.to)).sin().abs() < 1e-11, "{dwell:?}");
        assert_relative_eq!(dwell.share, 2.0 * low / TAU, max_relative = 1e-11);
        assert!(dwell.values[1] <= low.sin().powi(3) * 1.001 && dwell.values[0] < 0.0, "{dwell:?}");
    }
    assert!(with(1.0 / 24.0).is_empty());
    assert_eq!(with(1e-4).len(), 4);
}

/// The dwell at which the motion begins is one.
#[test]
fn a_dwell_over_the_start() {
    let m = Cubed::default();
    let range = RangeOfMotion::of(&m, &CubedCoordinates { theta: 0.01, x: 1e-6 }, RangeOptions::default()).unwrap();
    let options =
        ReportOptions { dwell: DwellOptions { shortest: 1.0 / 36.0, slowest: 0.1 }, ..ReportOptions::default() };
    let report = Report::of_motion(&range, Cubed::DERIVATION, &options).unwrap();
    assert_eq!(report.motion.unwrap().quantities[0].dwells.len(), 2);
}

/// Modes, circuits, limits and dead points are those of `Circuits`.
#[test]
fn modes_and_dead_points() {
    let m = FourBar { ground: 4.0, crank: 3.0, coupler: 2.0, rocker: 2.5 };
    let report = Report::on_branch(&m, FourBar::DERIVATION, left(), [0.5], &ReportOptions::default()).unwrap();
    let ReportedModes::Listed(modes) = &report.modes else { panic!("{:?}", report.modes) };
    assert_eq!((modes.modes.len(), modes.motions.len(), modes.circuits.len()), (2, 1, 1));
    assert_eq!((modes.motions[0].full_turns, modes.motions[0].dead_points.len()), (0, 2));
    let limit = ((9.0 + 16.0 - 4.5_f64.powi(2)) / 24.0).acos();
    let motion = report.motion.as_ref().unwrap();
    for input in motion.range.iter().chain(modes.motions[0].dead_points.iter().map(|at| &at.input)) {
        assert_relative_eq!(input.abs(), limit, max_relative = 1e-14);
    }
    assert!(motion.ends.iter().all(|end| matches!(end, MotionEnd::DeadPoint { group: "phi, psi" })));
    assert_eq!(modes.followed.map(|mode| modes.modes[mode].branch.clone()), Some(format!("{:?}", left())));
    assert!(motion.transmission[0].least.value < 1e-7);
    assert_eq!(motion.quantities[0].time_ratio, None);
}

/// A range that was asked for ends the motion; its ends are extremes.
#[test]
fn a_range_of_the_input() {
    let m = FourBar::default();
    let path = Options { range: Some([1.2, 2.0]), ..RangeOptions::through_change_points().path };
    let range = RangeOptions { path, ..RangeOptions::through_change_points() };
    let options = ReportOptions { range, ..ReportOptions::default() };
    let report = Report::on_branch(&m, FourBar::DERIVATION, left(), [1.5], &options).unwrap();
    let motion = report.motion.as_ref().unwrap();
    assert_eq!((motion.ends, motion.range), ([MotionEnd::Range; 2], [1.2, 2.0]));
    let swing = &motion.quantities[0];
    let mut inputs = [swing.extremes.least.input, swing.extremes.largest.input];
    inputs.sort_by(f64::total_cmp);
    assert_eq!(inputs, [1.2, 2.0]);
}

/// Several inputs have modes and links, and no motion; the prose says why.
#[test]
fn several_inputs() {
    let m = FiveBar::default();
    let (one, other) = (1.0, 2.0);
    let position = m.branches(FiveBarInputs { one, other }).unwrap().next().unwrap().pose.coordinates();
    let report = Report::at(&m, FiveBar::DERIVATION, &position);
    assert_eq!((report.motion.clone(), report.mobility.degrees_of_freedom), (None, 2));
    let ReportedModes::Listed(modes) = &report.modes else { panic!("{:?}", report.modes) };
    assert_eq!((modes.modes.len(), modes.inputs.clone(), modes.followed), (2, vec![1.0, 2.0], Some(0)));
    let text = report.to_string();
    assert!(text.contains("one, other drive them") && text.contains("With 2 inputs"), "{text}");
}

/// A mechanism whose positions cannot be listed has a motion and no modes; a group without a closed form is no dyad.
#[test]
fn positions_by_newtons_method() {
    let m = Kepler::default();
    let range = RangeOfMotion::of(&m, &KeplerCoordinates { mean: 0.5, anomaly: 0.7 }, RangeOptions::default()).unwrap();
    let report = Report::of_motion(&range, Kepler::DERIVATION, &ReportOptions::default()).unwrap();
    assert_eq!(report.modes, ReportedModes::NotListed);
    let motion = report.motion.as_ref().unwrap();
    assert_eq!((motion.transmission.len(), motion.without_transmission.len()), (0, 1));
    let anomaly = &motion.quantities[0];
    // It moves on by a turn in a turn.
    assert!(anomaly.strokes.is_empty() && anomaly.time_ratio.is_none(), "{anomaly:?}");
    assert_relative_eq!(anomaly.extremes.largest.value - anomaly.extremes.least.value, TAU, max_relative = 1e-14);
    assert!(report.to_string().contains("there is no Grashof class"), "{report}");
}

/// From a dead point no motion can be followed.
#[test]
fn a_start_at_a_dead_point() {
    let m = FourBar { ground: 4.0, crank: 3.0, coupler: 2.0, rocker: 2.5 };
    let limit = ((9.0 + 16.0 - 4.5_f64.powi(2)) / 24.0).acos();
    let q = m.assemble(limit * (1.0 - 1e-15), left()).unwrap().coordinates();
    let report = Report::of(&m, FourBar::DERIVATION, &q, &ReportOptions::default());
    assert!(matches!(report, Err(PathError::NoDirection { .. })), "{report:?}");
    let none = Report::on_branch(&m, FourBar::DERIVATION, left(), [3.0, f64::NAN], &ReportOptions::default());
    assert!(none.is_err());
}

/// Lengths in another unit change no angle and no share, and lengths by the unit.
#[test]
fn another_unit() {
    let small = FourBar::default();
    let unit = 2.0_f64.powi(-40);
    let [ground, crank, coupler, rocker] = [small.ground, small.crank, small.coupler, small.rocker].map(|l| l * unit);
    let [one, other] = [small, FourBar { ground, crank, coupler, rocker }].map(|m| of_four_bar(&m).motion.unwrap());
    assert_eq!(one.quantities, other.quantities);
    assert_eq!(one.transmission, other.transmission);
    assert_eq!(one.four_bars[0].class, other.four_bars[0].class);
    assert_eq!(one.four_bars[0].lengths.map(|length| length * unit), other.four_bars[0].lengths);
}
