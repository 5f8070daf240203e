//! Position in closed form: inputs without a position, data that must not matter, and the meaning of a branch.

use linkage::{Assembled, Elbow, Mechanism, PositionError, Slider, Slope};

use linkage_gallery::four_bar::*;
use linkage_gallery::introductory::*;
use linkage_gallery::inverted_slider_crank::*;
use linkage_gallery::jansen::*;
use linkage_gallery::offset_slider_crank::*;
use linkage_gallery::six_bar::*;
use linkage_gallery::v_twin::*;

fn branch(theta3_theta4: Elbow) -> FourBarBranch {
    FourBarBranch::new(theta3_theta4)
}

/// Both assemblies of a dyad close, mirrored in the line between the outer joints, and there are no others.
#[test]
fn both_branches_of_a_four_bar() {
    let m = FourBar::default();
    assert_eq!(FourBarBranch::all().collect::<Vec<_>>(), [branch(Elbow::Left), branch(Elbow::Right)]);
    for degrees in 0..360 {
        let theta2 = f64::from(degrees).to_radians();
        let [left, right] = [Elbow::Left, Elbow::Right].map(|side| m.assemble(theta2, branch(side)).unwrap());
        assert_eq!(m.branch_of(&left), branch(Elbow::Left));
        assert_eq!(m.branch_of(&right), branch(Elbow::Right));
        assert_eq!(left.determinant.to_bits(), (-right.determinant).to_bits());
        // A rough position, of the middles of intervals of 20 degrees, finds the branch.
        for (pose, side) in [(&left, Elbow::Left), (&right, Elbow::Right)] {
            let rough = |angle: f64| (angle.to_degrees() / 20.0).round() * 20.0_f64.to_radians();
            let FourBarCoordinates { theta3, theta4, .. } = pose.coordinates();
            let rough = FourBarCoordinates { theta2, theta3: rough(theta3), theta4: rough(theta4) };
            assert_eq!(m.branch_near(&rough), branch(side), "{rough:?}");
        }
        for pose in [left, right] {
            assert!(m.residual(&pose).largest() <= 8.0 * f64::EPSILON * m.residual_scales(&pose).sum());
        }
        // C lies as far left of the line from B to D in one as right of it in the other.
        let [b, d] = [m.points(&left).unwrap().b, nalgebra::point![m.l1, 0.0]];
        let across = |pose| (m.points(pose).unwrap().c - b).perp(&(d - b));
        assert!((across(&left) + across(&right)).abs() <= 1e-11);
    }
}

/// A knee whose second angle is measured from the first link, the unknowns named in the other order: the line
/// then runs from D to B.
mod relative {
    use linkage::linkage;

    linkage! {
        #[derive(Debug, Clone, PartialEq)]
        pub mechanism Knee {
            param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
            input theta2;
            unknown bend, theta3;
            loop l2@theta2 + l3@theta3 + l4@(theta3 + bend) = l1@0;
            point B = l2@theta2;
            point C = B + l3@theta3;
            point D = (l1, 0);
        }
    }
}

/// The names of the branches of each kind of group, which a comparison of positions would not check.
#[test]
fn branches_mean_what_they_say() {
    let elbows = [Elbow::Left, Elbow::Right];
    let sliders = [Slider::Far, Slider::Near];
    for degrees in (0..360).step_by(7) {
        let angle = f64::from(degrees).to_radians();
        // RRR: C is left or right of the line from B, where the link of theta3 starts, to D.
        let m = FourBar::default();
        let left = elbows.map(|elbow| {
            let points = m.points(&m.assemble(angle, branch(elbow)).unwrap()).unwrap();
            (nalgebra::point![m.l1, 0.0] - points.b).perp(&(points.c - points.b))
        });
        assert!(left[0] > 0.0 && left[1] < 0.0, "{left:?}");
        let m = relative::Knee::default();
        let left = elbows.map(|bend_theta3| {
            let points = m.points(&m.assemble(angle, relative::KneeBranch::new(bend_theta3)).unwrap()).unwrap();
            (points.b - points.d).perp(&(points.c - points.d))
        });
        assert!(left[0] > 0.0 && left[1] < 0.0, "{left:?}");
        // RPR and RRP: the modulus of the slider.
        let m = InvertedSliderCrank::default();
        let lengths = sliders.map(|theta4_b| m.assemble(angle, InvertedSliderCrankBranch::new(theta4_b)).unwrap().b);
        assert!(lengths[0] > lengths[1], "{lengths:?}");
        let m = VTwin::default();
        let lengths = sliders.map(|phi_front_s_front| {
            m.assemble(angle, VTwinBranch { phi_front_s_front, phi_rear_s_rear: Slider::Far }).unwrap().s_front
        });
        assert!(lengths[0] > lengths[1], "{lengths:?}");
        // One angle: the left side of its equation minus the right increases with it.
        let m = guides::Lever::default();
        let slopes = [Slope::Rising, Slope::Falling].map(|slope| {
            let pose = m.assemble(angle / 4.0, guides::LeverBranch::new(slope)).unwrap();
            m.jacobian_unknowns(&pose)[(0, 0)]
        });
        assert!(slopes[0] > 0.0 && slopes[1] < 0.0, "{slopes:?}");
    }
}

/// One slider-crank, with its guide along several lines, and its terms on either side of the equation.
mod guides {
    use linkage::linkage;

    macro_rules! slider_cranks {
        ($($name:ident { $($closure:tt)* })*) => {
            linkage! {$(
                pub mechanism $name {
                    param r = 20, l = 50, e = 3, phi = 30deg;
                    input theta;
                    unknown psi, s;
                    loop $($closure)*;
                    output _phi = phi;
                }
            )*}
        };
    }

    slider_cranks! {
        East { r@theta + l@psi = (s, e) }
        West { r@(theta + 180deg) + l@psi = s@180deg + e@(-90deg) }
        North { (0, 0) = r@(theta + 90deg) + l@psi - s@90deg - e@180deg }
        South { s@(-90deg) - (-e, 0) = r@(theta - 90deg) - l@(psi + 180deg) }
        Double { r@theta + l@psi = 2 * (s, e / 2) }
        Slanted { r@(theta + phi) + l@psi = s@phi + e@(phi + 90deg) }
    }

    linkage! {
        /// A lever that lifts its end to a height.
        pub mechanism Lever {
            param l = 2;
            input height;
            unknown psi;
            equation l * sin(psi) = height;
        }
    }
}

/// A slider-crank has one branch type however its guide lies: far is the larger of its two lengths.
#[test]
fn a_slider_is_far_or_near_along_any_guide() {
    let lengths = |angle: f64| {
        let m = guides::East::default();
        let root = (m.l.powi(2) - (m.e - m.r * angle.sin()).powi(2)).sqrt();
        [root, -root].map(|along| m.r * angle.cos() + along)
    };
    macro_rules! check {
        ($($Name:ident $Branch:ident $factor:literal;)*) => {
            for angle in (0..360).step_by(7).map(|degrees| f64::from(degrees).to_radians()) {
                for (psi_s, length) in [Slider::Far, Slider::Near].into_iter().zip(lengths(angle)) {
                    $(
                        let (m, branch) = (guides::$Name::default(), guides::$Branch { psi_s });
                        let pose = m.assemble(angle, branch).unwrap();
                        approx::assert_relative_eq!($factor * pose.s, length, max_relative = 1e-14);
                        assert_eq!(m.branch_of(&pose), branch, stringify!($Name));
                        assert_eq!(m.branch_of(&m.pose_at(&pose.coordinates())), branch, stringify!($Name));
                    )*
                }
            }
        };
    }
    check! {
        East EastBranch 1.0;
        West WestBranch 1.0;
        North NorthBranch 1.0;
        South SouthBranch 1.0;
        Double DoubleBranch 2.0;
        Slanted SlantedBranch 1.0;
    }
}

/// `branches` gives the branches that exist and no others, and an error for a number that is not finite.
#[test]
fn branches_that_exist() {
    let m = SixBar::default();
    let found: Vec<_> = m.branches(1.0).unwrap().collect();
    assert_eq!(found.len(), SixBarBranch::all().filter(|&branch| m.assemble(1.0, branch).is_ok()).count());
    for Assembled { branch, pose } in &found {
        assert_eq!(m.branch_of(pose), *branch);
        assert_eq!(m.branch_near(&pose.coordinates()), *branch);
        let other = m.assemble(1.0, *branch).unwrap();
        assert_eq!((other.theta2, other.theta5), (pose.theta2, pose.theta5));
    }
    // The second group reaches from one elbow of the first alone.
    let short = SixBar { f: 3.0, g: 11.0, ..m };
    let first: Vec<_> = short.branches(1.0).unwrap().map(|found| found.branch.theta2_theta3).collect();
    assert_eq!(first, [Elbow::Right, Elbow::Right]);
    assert!(FourBar::new(80.0, 20.0, 10.0, 10.0).branches(0.3).unwrap().next().is_none());
    assert!(matches!(FourBar::default().branches(f64::NAN).err(), Some(PositionError::NotFinite { .. })));
}

/// A dyad, then Kepler's equation, which has no closed form, then an angle that follows from it.
mod kepler {
    use linkage::linkage;

    linkage! {
        #[derive(Debug, Clone, PartialEq)]
        pub mechanism Kepler {
            param l1 = 80, l2 = 20, l3 = 50, l4 = 70, e = 0.3;
            input theta2;
            unknown theta3, theta4, psi, s;
            loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
            equation psi - e * sin(psi + theta3) = theta4;
            equation s = l4 * cos(psi - theta4);
        }
    }
}

/// Groups with a closed form follow the branch, those without one the guess.
#[test]
fn a_group_without_closed_form() {
    use kepler::{Kepler, KeplerBranch, KeplerCoordinates};

    let m = Kepler::default();
    for degrees in (0..360).step_by(3) {
        let theta2 = f64::from(degrees).to_radians();
        for theta3_theta4 in [Elbow::Left, Elbow::Right] {
            // Of the guess only psi matters, and the turn of theta4, whose number is in the equation of psi.
            let guess = KeplerCoordinates { theta2, psi: 0.5, theta3: f64::NAN, theta4: 0.0, s: f64::NAN };
            let branch = KeplerBranch { theta3_theta4 };
            let pose = m.assemble_near(&guess, branch).unwrap();
            assert_eq!(m.branch_of(&pose), branch);
            assert!(m.residual(&pose).largest() <= 8.0 * f64::EPSILON * m.residual_scales(&pose).largest());
            let solved = m.solve(&pose.coordinates()).unwrap();
            let (found, whole) = (pose.coordinates(), solved.coordinates);
            assert!(
                (found.psi - whole.psi).abs() <= 1e-14 && (found.s - whole.s).abs() <= 1e-12,
                "{found:?} {whole:?}"
            );
            // The determinant of the group is that of its formula.
            let [_, psi, _] = m.block_determinants(&pose).into();
            assert!((psi - (1.0 - m.e * (whole.psi + whole.theta3).cos())).abs() <= 1e-14);
        }
    }
    // Beyond a dead point of psi there is no position.
    let left = KeplerBranch { theta3_theta4: Elbow::Left };
    let steep = Kepler { e: 3.0, ..Kepler::default() };
    let at = |psi| KeplerCoordinates { theta2: 0.35, psi, theta3: 0.0, theta4: 0.0, s: 0.0 };
    let (mut others, mut lost) = (0, 0);
    for step in -300..300 {
        let guess = at(f64::from(step) / 100.0);
        let before = steep.pose_at(&KeplerCoordinates { theta3: 1.230_926_1, ..guess });
        match steep.assemble_near(&guess, left) {
            Ok(pose) => {
                let [before, after] = [&before, &pose].map(|pose| steep.block_determinants(pose)[1]);
                assert!(before * after > 0.0, "{guess:?}");
            }
            Err(PositionError::OtherBranch { group: "psi", .. }) => others += 1,
            Err(PositionError::NotConverged { group: Some("psi"), .. }) => lost += 1,
            Err(error) => panic!("{error}"),
        }
    }
    assert!((1..100).contains(&others) && (1..100).contains(&lost), "{others}, {lost}");
    let error = steep.assemble_near(&at(f64::INFINITY), left).unwrap_err();
    assert_eq!(error, PositionError::NotFinite { mechanism: "Kepler", quantity: "the residual" });
    let short = Kepler { l3: 1.0, l4: 1.0, ..Kepler::default() };
    assert!(matches!(
        short.assemble_near(&at(0.0), left),
        Err(PositionError::Unbuildable { group: "theta3, theta4", .. })
    ));
}

/// The two branches meet where the links are in line; each keeps its name.
#[test]
fn a_dead_point_keeps_its_branch() {
    let m = FourBar::new(80.0, 20.0, 33.0, 67.0);
    for elbow in [Elbow::Left, Elbow::Right] {
        let pose = m.assemble(std::f64::consts::PI, branch(elbow)).unwrap();
        assert_eq!(pose.determinant, 0.0);
        assert_eq!(m.branch_of(&pose), branch(elbow));
    }
}

/// A link at a constant angle to its guide, with one part along the guide and one across.
#[test]
fn a_guide_with_an_offset_link() {
    for delta in [-2.0, -0.7, 0.3, 1.0, 2.4] {
        let m = Introductory { delta, ..Introductory::default() };
        for degrees in (0..360).step_by(5) {
            for phi2_z2 in [Slider::Far, Slider::Near] {
                let pose = m.assemble(f64::from(degrees).to_radians(), IntroductoryBranch::new(phi2_z2)).unwrap();
                let size = m.residual_scales(&pose).sum();
                assert!(m.residual(&pose).largest() <= 8.0 * f64::EPSILON * size, "{delta}, {degrees} deg");
                let other = m.pose_at(&pose.coordinates());
                assert!((pose.determinant - other.determinant).abs() <= 8.0 * f64::EPSILON * size);
            }
        }
    }
}

/// A position depends on its input and branch alone, to the last bit, and not on the calls before.
#[test]
fn steps_leave_no_trace() {
    let m = Jansen::default();
    let branch = JansenBranch::new(Elbow::Right, Elbow::Right, Elbow::Left, Elbow::Left, Elbow::Right);
    let mut found = 0;
    for degrees in 0..360_u32 {
        let crank = f64::from(degrees).to_radians();
        let Ok(pose) = m.assemble(crank, branch) else { continue };
        found += 1;
        assert_eq!(m.branch_of(&pose), branch);
        assert!(m.residual(&pose).largest() <= 8.0 * f64::EPSILON * m.residual_scales(&pose).sum());
        for step in [36, 170] {
            let mut at = degrees;
            for _ in 0..18 {
                at = (at + step) % 360;
            }
            let back = m.assemble(f64::from(at).to_radians(), branch).map(|_| m.assemble(crank, branch).unwrap());
            assert!(back.is_err() || back.unwrap().block_bits(&m) == pose.block_bits(&m));
        }
    }
    assert!(found > 300, "{found}");
}

trait Bits {
    fn block_bits(&self, m: &Jansen) -> Vec<u64>;
}

impl Bits for JansenPose<f64> {
    fn block_bits(&self, m: &Jansen) -> Vec<u64> {
        let points = m.points(self).unwrap();
        let numbers = [points.foot.x, points.foot.y].into_iter().chain(m.block_determinants(self));
        numbers.map(f64::to_bits).collect()
    }
}

#[test]
fn links_that_do_not_reach_are_named() {
    let short = FourBar::new(80.0, 20.0, 10.0, 10.0);
    match short.assemble(0.3, branch(Elbow::Right)) {
        Err(PositionError::Unbuildable { mechanism: "FourBar", group: "theta3, theta4", gap, .. }) => {
            assert!(gap > 1.0)
        }
        other => panic!("{other:?}"),
    }
    // The second of two groups: its links are too short, the first assembles.
    let m = SixBar { f: 0.1, g: 0.1, ..SixBar::default() };
    let branch = SixBarBranch::new(Elbow::Right, Elbow::Right);
    match m.assemble(1.0, branch) {
        Err(PositionError::Unbuildable { group: "theta4, theta5", .. }) => {}
        other => panic!("{other:?}"),
    }
    // A rod shorter than the offset.
    let m = OffsetSliderCrank { b: 1.0, ..OffsetSliderCrank::default() };
    match m.assemble(0.0, OffsetSliderCrankBranch::new(Slider::Far)) {
        Err(PositionError::Unbuildable { group: "theta3", gap, .. }) => approx::assert_relative_eq!(gap, 19.0),
        other => panic!("{other:?}"),
    }
    // A sum that overflows is no gap.
    let m = OffsetSliderCrank { b: f64::MAX / 2.0, c: f64::MAX, ..OffsetSliderCrank::default() };
    let found = m.assemble(0.0, OffsetSliderCrankBranch::new(Slider::Far));
    assert!(matches!(found, Err(PositionError::NotFinite { .. })), "{found:?}");
}

/// For links that just touch, the chord is zero even if its rounding error is negative.
#[test]
fn links_in_line_assemble() {
    for (l3, l4) in [(50.0, 50.0), (33.3, 66.7), (0.1, 99.9)] {
        let m = FourBar::new(80.0, 20.0, l3, l4);
        let pose = m.assemble(std::f64::consts::PI, branch(Elbow::Right)).unwrap();
        assert!(m.residual(&pose).largest() <= 1e-6, "{}", m.residual(&pose).largest());
        assert!(m.velocity_ratios(&pose).is_err());
    }
    // Folded back: the difference of two long links, as rounded as they are, spans 0.3 - 0.2.
    for (l3, l4) in [(100.2, 100.1), (100.1, 100.2), (33.4, 33.3)] {
        let m = FourBar::new(0.3, 0.2, l3, l4);
        let pose = m.assemble(0.0, branch(Elbow::Right)).unwrap();
        assert!(m.residual(&pose).largest() <= 1e-13, "{}", m.residual(&pose).largest());
        assert!(m.velocity_ratios(&pose).is_err());
    }
}

/// Another unit of length changes exponents only.
#[test]
fn scale_free() {
    let m = FourBar::default();
    let pose = m.assemble(0.35, branch(Elbow::Left)).unwrap();
    for exponent in [-300, -200, -60, 60, 200, 300] {
        let scale = 2_f64.powi(exponent);
        let scaled = m.clone().map(|length| length * scale).assemble(0.35, branch(Elbow::Left)).unwrap();
        assert_eq!(scaled.theta3, pose.theta3);
        assert_eq!(scaled.theta4, pose.theta4);
        assert_eq!(scaled.determinant, pose.determinant * scale * scale);
    }
}

#[test]
fn invalid_numbers_are_errors_and_never_nan() {
    let branch = branch(Elbow::Right);
    for m in [
        FourBar::new(80.0, 20.0, f64::NAN, 70.0),
        FourBar::new(f64::INFINITY, 20.0, 50.0, 70.0),
        FourBar::new(80.0, 20.0, 0.0, 70.0),
        FourBar::new(20.0, 20.0, 50.0, 50.0),
    ] {
        // The outer joints of the last are one point at 0: every position of its links closes the loop.
        let found = m.assemble(0.0, branch);
        assert!(found.is_err(), "{m:?}: {found:?}");
    }
    assert!(FourBar::default().assemble(f64::NAN, branch).is_err());
}

/// A negative length is a link in the opposite direction, in any unit of length and however flat the triangle.
#[test]
fn a_negative_length_points_the_other_way() {
    for scale in [-200, -60, 0, 60, 200].map(|exponent| 2_f64.powi(exponent)) {
        // The second is flat at 0.
        for (m, theta2) in [(FourBar::default(), 0.35), (FourBar::new(140.0, 20.0, 50.0, 70.0), 0.0)] {
            let m = m.map(|length| length * scale);
            for (elbow, signs) in [Elbow::Left, Elbow::Right]
                .into_iter()
                .flat_map(|elbow| [[-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].map(|signs| (elbow, signs)))
            {
                let turned = FourBar { l3: signs[0] * m.l3, l4: signs[1] * m.l4, ..m.clone() };
                let [pose, other] = [&m, &turned].map(|m| m.assemble(theta2, branch(elbow)).unwrap());
                let off = [(pose.theta3, other.theta3), (pose.theta4, other.theta4)]
                    .into_iter()
                    .zip(signs)
                    .map(|((one, other), sign)| (one.into_inner() - other.into_inner() * sign).norm());
                assert!(off.fold(0.0, f64::max) <= 4.0 * f64::EPSILON, "{turned:?}: {pose:?} {other:?}");
                assert_eq!(turned.branch_of(&other), branch(elbow));
                assert!((pose.determinant - other.determinant).abs() <= 4.0 * f64::EPSILON * m.l3 * m.l4);
            }
        }
    }
}

/// A mechanism without closed form has an `assemble` that says why: a warning at the call, and an error.
#[test]
fn assemble_without_closed_form() {
    use kepler::{Kepler, KeplerBranch};

    let m = Kepler::default();
    #[expect(deprecated, reason = "the warning is what is tested")]
    let found = m.assemble(1.0, KeplerBranch { theta3_theta4: Elbow::Left });
    let error = found.unwrap_err();
    assert_eq!(error, PositionError::NoClosedForm { mechanism: "Kepler", group: "psi" });
    assert_eq!(
        error.to_string(),
        "group psi of Kepler has no closed form: use `assemble_near` with a guess, or `solve`"
    );
}
