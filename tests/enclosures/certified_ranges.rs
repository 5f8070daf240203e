//! Certified motions that keep declared ranges, or leave them.

use linkage::certify::{self, CertifiedRange, Certify, RangeProof};
use linkage::{Column, Interval, RangeEnd, Slider, linkage};

linkage! {
    /// The pin of a crank in the slot of a lever: s^2 = 13 - 12 cos theta.
    #[derive(Debug, Clone)]
    pub mechanism Lever {
        param crank = 2, frame = 3, inner = 1.5, slot = 3;
        input theta in 0deg..180deg;
        unknown phi, s in inner..inner + slot;
        loop crank@theta = frame@0 + s@phi;
        output rest in 0.. = inner + slot - s;
        derive intervals;
    }
}

fn start(m: &Lever<f64>, theta: f64) -> LeverCoordinates<f64> {
    m.assemble(theta, LeverBranch { phi_s: Slider::Far }).unwrap().coordinates()
}

fn proofs(all: Vec<CertifiedRange>) -> [RangeProof; 3] {
    assert_eq!(all.iter().map(|one| one.of).collect::<Vec<_>>(), ["theta", "s", "rest"]);
    [0, 1, 2].map(|place| all[place].proof)
}

#[test]
fn a_motion_keeps_its_ranges_or_leaves_one() {
    const KEPT: RangeProof = RangeProof::Within;
    const PAST: RangeProof = RangeProof::Beyond(RangeEnd::Most);
    const BEFORE: RangeProof = RangeProof::Beyond(RangeEnd::Least);
    let m = Lever::default();
    let [inner, outer] = [43.0_f64 / 48.0, -29.0 / 48.0].map(f64::acos);
    let over = |from: f64, to: f64| proofs(certify::range(&m, &start(&m, from), to).unwrap().joint_ranges());
    for little in [1e-3, 1e-9, 1e-13] {
        assert_eq!(over(inner + little, outer - little), [KEPT; 3], "{little}");
        assert_eq!(over(1.0, outer + little), [KEPT, PAST, BEFORE], "{little}");
        assert_eq!(over(1.0, inner - little), [KEPT, BEFORE, KEPT], "{little}");
    }
    assert_eq!(over(1.0, -0.1), [BEFORE, BEFORE, KEPT]);
    // At an end itself neither is proved.
    assert_eq!(over(1.0, outer), [KEPT, RangeProof::Undecided, RangeProof::Undecided]);
    // A turn leaves all of them, that of s at both ends; and the input is the same a turn later.
    assert_eq!(proofs(certify::turn(&m, &start(&m, 1.0)).unwrap().joint_ranges()), [PAST, BEFORE, BEFORE]);
    let turn = std::f64::consts::TAU;
    assert_eq!(over(1.0 + turn, 1.5 + turn), [KEPT; 3]);
    let curve = certify::curve(&m, &start(&m, 1.0)).unwrap();
    assert_eq!(proofs(curve.joint_ranges()), [PAST, BEFORE, BEFORE]);
}

/// With tolerances the proof holds for each of them: next to the nominal end nothing is proved.
#[test]
fn tolerances_widen_the_ends() {
    let m = Lever::default();
    let outer = (-29.0_f64 / 48.0).acos();
    let all = Column::from([2.0, 3.0, 1.5, 3.0].map(|value| Interval::around(value, 1e-4).unwrap()));
    let to = |to: f64| {
        let certificate = Certify::new(&m).parameters(all).range(&start(&m, 1.0), to).unwrap();
        proofs(certificate.joint_ranges())[1]
    };
    assert_eq!(to(outer - 1e-3), RangeProof::Within);
    assert_eq!(to(outer), RangeProof::Undecided);
    assert_eq!(to(outer + 1e-3), RangeProof::Beyond(RangeEnd::Most));
}
