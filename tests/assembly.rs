//! Position in closed form: what cannot be assembled, what must not matter, and what a branch is.

use linkage::{Error, Side, linkage};

include!("mechanisms/four_bar.rs");
include!("mechanisms/six_bar.rs");
include!("mechanisms/jansen.rs");
include!("mechanisms/offset_slider_crank.rs");
include!("mechanisms/introductory.rs");
include!("mechanisms/inverted_slider_crank.rs");
include!("mechanisms/v_twin.rs");

fn branch(theta3_theta4: Side) -> FourBarBranch {
    FourBarBranch { theta3_theta4 }
}

/// Both assemblies close, mirrored in the line between the outer joints; all that there are is two.
#[test]
fn both_branches_of_a_four_bar() {
    let m = FourBar::default();
    assert_eq!(FourBarBranch::all().collect::<Vec<_>>(), [branch(Side::Left), branch(Side::Right)]);
    for degrees in 0..360 {
        let theta2 = f64::from(degrees).to_radians();
        let [left, right] = [Side::Left, Side::Right].map(|side| m.assemble(theta2, branch(side)).unwrap());
        assert_eq!(m.branch_of(&left), branch(Side::Left));
        assert_eq!(m.branch_of(&right), branch(Side::Right));
        assert_eq!(left.determinant.to_bits(), (-right.determinant).to_bits());
        for pose in [left, right] {
            assert!(m.residual(&pose).amax() <= 8.0 * f64::EPSILON * m.closure_sizes(&pose).sum());
        }
        // C lies as far left of the line from B to D in one as right of it in the other.
        let [b, d] = [m.points(&left).unwrap().b, nalgebra::vector![m.l1, 0.0]];
        let across = |pose| (m.points(pose).unwrap().c - b).perp(&(d - b));
        assert!((across(&left) + across(&right)).abs() <= 1e-11);
    }
}

/// What `Side` says of each kind of group, which no test of one position against another would notice.
#[test]
fn sides_mean_what_they_say() {
    let both = [Side::Left, Side::Right];
    for degrees in (0..360).step_by(7) {
        let angle = f64::from(degrees).to_radians();
        // RRR: l3 x l4 is positive where l4 turns left from l3.
        let m = FourBar::default();
        let crosses = both.map(|side| {
            let pose = m.assemble(angle, branch(side)).unwrap();
            let (l3, l4) = (pose.theta3.complex() * m.l3, pose.theta4.complex() * m.l4);
            l3.re * l4.im - l3.im * l4.re
        });
        assert!(crosses[0] > 0.0 && crosses[1] < 0.0, "{crosses:?}");
        // RPR: the larger modulus.
        let m = InvertedSliderCrank::default();
        let lengths = both.map(|theta4_b| m.assemble(angle, InvertedSliderCrankBranch { theta4_b }).unwrap().b);
        assert!(lengths[0] > lengths[1], "{lengths:?}");
        // RRP: the scalar product of the rod and the derivative of the closure by the slider.
        let m = VTwin::default();
        let products = both.map(|side| {
            let branch = VTwinBranch { phi_front_s_front: side, phi_rear_s_rear: Side::Left };
            let pose = m.assemble(angle, branch).unwrap();
            let j = m.jacobian_unknowns(&pose);
            // The first column is i times the rod.
            let [turned, line] = [j.fixed_view::<2, 1>(0, 0), j.fixed_view::<2, 1>(0, 1)];
            turned[1] * line[0] - turned[0] * line[1]
        });
        assert!(products[0] > 0.0 && products[1] < 0.0, "{products:?}");
        // One angle: its equation, the second row, grows with it.
        let m = OffsetSliderCrank::default();
        let slopes = both.map(|theta3| {
            let pose = m.assemble(angle, OffsetSliderCrankBranch { theta3 }).unwrap();
            m.jacobian_unknowns(&pose)[(1, 0)]
        });
        assert!(slopes[0] > 0.0 && slopes[1] < 0.0, "{slopes:?}");
    }
}

/// A link that stands on the guide at an angle of its own, with a part along the guide and a part across.
#[test]
fn a_guide_with_an_offset_link() {
    for delta in [-2.0, -0.7, 0.3, 1.0, 2.4] {
        let m = Introductory { delta, ..Introductory::default() };
        for degrees in (0..360).step_by(5) {
            for phi2_z2 in [Side::Left, Side::Right] {
                let pose = m.assemble(f64::from(degrees).to_radians(), IntroductoryBranch { phi2_z2 }).unwrap();
                let size = m.closure_sizes(&pose).sum();
                assert!(m.residual(&pose).amax() <= 8.0 * f64::EPSILON * size, "{delta}, {degrees} deg");
                let other = m.pose_at(&pose.coordinates());
                assert!((pose.determinant - other.determinant).abs() <= 8.0 * f64::EPSILON * size);
            }
        }
    }
}

/// A position depends on its input and branch alone: bit for bit the same whichever way it was reached.
#[test]
fn steps_leave_no_trace() {
    let m = Jansen::default();
    let branch = JansenBranch {
        angle_b_angle_j: Side::Left,
        angle_d_angle_e: Side::Left,
        angle_c_angle_k: Side::Right,
        angle_f_angle_g: Side::Right,
        angle_h_angle_i: Side::Left,
    };
    let mut found = 0;
    for degrees in 0..360_u32 {
        let crank = f64::from(degrees).to_radians();
        let Ok(pose) = m.assemble(crank, branch) else { continue };
        found += 1;
        assert_eq!(m.branch_of(&pose), branch);
        assert!(m.residual(&pose).amax() <= 8.0 * f64::EPSILON * m.closure_sizes(&pose).sum());
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
fn what_does_not_reach_is_named() {
    let short = FourBar::new(80.0, 20.0, 10.0, 10.0);
    match short.assemble(0.3, branch(Side::Left)) {
        Err(Error::Unbuildable { mechanism: "FourBar", group: "theta3, theta4", gap }) => assert!(gap > 1.0),
        other => panic!("{other:?}"),
    }
    // Of two groups the second: its links are too short, the first assembles.
    let m = SixBar { f: 0.1, g: 0.1, ..SixBar::default() };
    let branch = SixBarBranch { theta2_theta3: Side::Left, theta4_theta5: Side::Left };
    match m.assemble(1.0, branch) {
        Err(Error::Unbuildable { group: "theta4, theta5", .. }) => {}
        other => panic!("{other:?}"),
    }
    // A rod shorter than the offset.
    let m = OffsetSliderCrank { b: 1.0, ..OffsetSliderCrank::default() };
    assert!(matches!(
        m.assemble(0.0, OffsetSliderCrankBranch { theta3: Side::Left }),
        Err(Error::Unbuildable { group: "theta3", .. })
    ));
}

/// Links that just touch: the chord is zero to rounding, whatever the rounding says.
#[test]
fn links_in_line_assemble() {
    for (l3, l4) in [(50.0, 50.0), (33.3, 66.7), (0.1, 99.9)] {
        let m = FourBar::new(80.0, 20.0, l3, l4);
        let pose = m.assemble(std::f64::consts::PI, branch(Side::Left)).unwrap();
        assert!(m.residual(&pose).amax() <= 1e-6, "{}", m.residual(&pose).amax());
        assert!(m.velocity_ratios(&pose).is_err());
    }
}

/// The unit of length changes nothing but the exponents.
#[test]
fn scale_free() {
    let m = FourBar::default();
    let pose = m.assemble(0.35, branch(Side::Right)).unwrap();
    for exponent in [-200, -60, 60, 200] {
        let scale = 2_f64.powi(exponent);
        let scaled = m.clone().map(|length| length * scale).assemble(0.35, branch(Side::Right)).unwrap();
        assert_eq!(scaled.theta3, pose.theta3);
        assert_eq!(scaled.theta4, pose.theta4);
        assert_eq!(scaled.determinant, pose.determinant * scale * scale);
    }
}

#[test]
fn nonsense_is_an_error_and_never_a_number() {
    let left = branch(Side::Left);
    for m in [
        FourBar::new(80.0, 20.0, f64::NAN, 70.0),
        FourBar::new(f64::INFINITY, 20.0, 50.0, 70.0),
        FourBar::new(80.0, 20.0, 0.0, 70.0),
        FourBar::new(20.0, 20.0, 50.0, 50.0),
    ] {
        // The last has its outer joints in one point at 0: every position of the links closes it.
        let found = m.assemble(0.0, left);
        assert!(found.is_err(), "{m:?}: {found:?}");
    }
    assert!(FourBar::default().assemble(f64::NAN, left).is_err());
    // A negative length is a link that points the other way.
    let (m, turned) = (FourBar::default(), FourBar::new(80.0, 20.0, -50.0, 70.0));
    let (pose, other) = (m.assemble(0.35, left).unwrap(), turned.assemble(0.35, left).unwrap());
    assert!((m.points(&pose).unwrap().c - turned.points(&other).unwrap().c).amax() <= 1e-13);
}
