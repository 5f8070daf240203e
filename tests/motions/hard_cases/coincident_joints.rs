//! Joints that coincide: a dyad whose outer joints are one point can stand anywhere, and the usual formulas divide zero
//! by zero. Known to fail: cells of two mirrored dyads that carry a third, at the end of their range and wherever both
//! dyads are on the same side; guides that are parallel; pins that pass through a pivot.

use std::fmt::Debug;

use linkage::limits::{Limit, Limits};
use linkage::{Elbow, InputValues, PositionError, Slider, Slope, linkage};

linkage! {
    /// Peaucellier's cell, whose rhombus closes at the ends of the range.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Cell {
        param crank = 2, long = 5, short = 2;
        input theta;
        unknown up, up1, down, down1, up2, down2;
        let inner = crank@0 + crank@theta;
        loop long@up = inner + short@up1;
        loop long@down = inner + short@down1;
        loop long@up + short@up2 = long@down + short@down2;
        derive limits;
    }

    /// Peaucellier's cell with the lower dyad in the opposite order, which rounds differently.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Mirrored {
        param crank = 2, long = 5, short = 2;
        input theta;
        unknown up, up1, down, down1, up2, down2;
        let inner = crank@0 + crank@theta;
        loop long@up = inner + short@up1;
        loop inner = long@down - short@down1;
        loop long@up + short@up2 = inner + short@down1 + short@down2;
        derive limits;
    }

    /// Two dyads on one slide carry a third.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Symmetric {
        param l = 2, m = 1.5, n = 2, k = 2;
        input s;
        unknown a, b, c, d, e, f;
        loop l@a + m@b = s@0;
        loop l@c + m@d = s@0;
        loop l@a + n@e = l@c + k@f;
        derive limits;
    }

    /// A kite or a parallelogram, whose rocker carries a second dyad.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Kite {
        param ground = 20, crank = 20, coupler = 50, rocker = 50, arm = 25, rod = 22, lever = 30, base = 40;
        input theta;
        unknown alpha, beta, gamma, delta;
        loop crank@theta + coupler@alpha = ground@0 + rocker@beta;
        loop arm@beta + rod@gamma = base@90deg + lever@delta;
        derive limits;
    }

    /// A pin on a crank in the slot of an arm.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Slot {
        param crank = 50, offset = 0, ground = 50;
        input theta;
        unknown arm, along;
        loop crank@theta = ground@0 + offset@(arm + 90deg) + along@arm;
        derive limits;
    }

    /// A rod on a guide.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Rod {
        param crank = 1, rod = 3, tilt = 0.3;
        input theta;
        unknown phi, s;
        loop crank@theta + rod@phi = s@tilt;
        derive limits;
    }

    /// Two guides from joints `(0, 0)` and `(a, b)`.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Guides {
        param a = 4, b = 1, alpha = 0.5;
        input x;
        unknown s, u;
        loop s@alpha = u@x + (a, b);
        derive limits;
    }

    /// A wheel turned by a factor, and an angle whose factor is an input.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Factors {
        param ratio = 2, height = 1;
        input v, w;
        unknown wheel, phi;
        equation ratio * wheel = v;
        equation w * cos(phi) = height;
        derive limits;
    }
}

const SCALES: [i32; 3] = [-60, 0, 60];

/// A result that must be equal at lengths 2^-60, 1 and 2^60 times as long.
#[track_caller]
fn at_all_scales<V: PartialEq + Debug>(value: impl Fn(f64) -> V) -> V {
    let [small, plain, large] = SCALES.map(|exponent| value(2_f64.powi(exponent)));
    assert_eq!(small, plain);
    assert_eq!(large, plain);
    plain
}

/// The error without the inputs, which may be lengths.
fn without_inputs(error: PositionError) -> PositionError {
    match error {
        PositionError::Unbuildable { mechanism, group, gap, .. } => {
            PositionError::Unbuildable { mechanism, group, gap, inputs: InputValues::default() }
        }
        other => other,
    }
}

/// A limit in a unit of length.
fn in_unit(limits: Limits<f64>, unit: f64) -> Limits<f64> {
    let Limits { lower, upper, .. } = limits;
    let [lower, upper] = [lower, upper].map(|limit| match limit {
        Limit::Unlimited => Limit::Unlimited,
        Limit::Exact { input, group } => Limit::Exact { input: input / unit, group },
        Limit::Bracketed { assembled, unbuildable, group } => {
            Limit::Bracketed { assembled: assembled / unit, unbuildable: unbuildable / unit, group }
        }
        Limit::JointRange { input, of, end } => Limit::JointRange { input: input / unit, of, end },
    });
    Limits { lower, upper, ..limits }
}

/// Checks an exact limit: its group, and its input to an ulp.
#[track_caller]
fn exact(limit: Limit<f64>, expected: f64, of: &str) {
    let Limit::Exact { input, group } = limit else { panic!("{limit:?}") };
    assert_eq!(group, of);
    assert!((input - expected).abs() <= f64::EPSILON * expected.abs(), "{input:?}, {expected:?}");
}

/// |inner| = 2 crank cos(theta / 2) = long - short; there the rhombus is closed, and the third dyad can stand anywhere.
macro_rules! cell {
    ($M:ident, $Branch:ident, $NAME:literal) => {
        // 2 acos(3/4): 82.819244 degrees.
        let end = 1.445_468_495_626_831;
        let undetermined = PositionError::Undetermined { mechanism: $NAME, group: "up2, down2" };
        let at = |scale: f64| $M::default().map(|length: f64| length * scale);
        for start in [-1.4, -0.2, 0.3, 1.1] {
            let mut determined = Vec::new();
            for branch in $Branch::all() {
                if branch.up_up1 == branch.down_down1 {
                    let found = at_all_scales(|scale| at(scale).assemble(start, branch).map(|pose| pose.coordinates()));
                    assert_eq!(found, Err(undetermined));
                    assert_eq!(at(1.0).limits(start, branch), Err(undetermined));
                    continue;
                }
                determined.push(branch);
                let found = at_all_scales(|scale| at(scale).limits(start, branch)).unwrap();
                exact(found.lower, -end, "up, up1");
                exact(found.upper, end, "up, up1");
                for limit in [found.lower, found.upper] {
                    let input = limit.input().unwrap();
                    let there = at_all_scales(|scale| at(scale).assemble(input, branch).map(|pose| pose.coordinates()));
                    assert_eq!(there, Err(undetermined), "{input}");
                    // Before it the cell is determined, beyond it it cannot be assembled.
                    assert!(at(1.0).assemble(input * (1.0 - 1e-12), branch).is_ok());
                    let beyond = at(1.0).assemble(input * (1.0 + 1e-12), branch);
                    assert!(matches!(beyond, Err(PositionError::Unbuildable { group: "up, up1", .. })), "{beyond:?}");
                }
            }
            let found: Vec<_> = at(1.0).branches(start).unwrap().map(|found| found.branch).collect();
            assert_eq!(found, determined);
        }
    };
}

#[test]
fn a_cell_at_the_ends_of_its_range() {
    cell!(Cell, CellBranch, "Cell");
    assert_eq!(
        PositionError::Undetermined { mechanism: "Cell", group: "up2, down2" }.to_string(),
        "Cell is undetermined at this input: group up2, down2 has infinitely many positions"
    );
}

/// Joints that coincide to rounding error are treated as coincident.
#[test]
fn a_cell_that_rounds_otherwise() {
    cell!(Mirrored, MirroredBranch, "Mirrored");
}

#[test]
fn two_dyads_carry_a_third() {
    let at = |scale: f64| Symmetric::default().map(|length: f64| length * scale);
    for branch in SymmetricBranch::all().filter(|branch| branch.a_b != branch.c_d) {
        for start in [0.6, 2.0, 3.3] {
            let found =
                at_all_scales(|scale| at(scale).limits(start * scale, branch).map(|found| in_unit(found, scale)));
            let found = found.unwrap();
            exact(found.lower, 0.5, "a, b");
            exact(found.upper, 3.5, "a, b");
        }
        for end in [0.5, 3.5] {
            let found = at_all_scales(|scale| at(scale).assemble(end * scale, branch).map(|pose| pose.e));
            assert_eq!(found, Err(PositionError::Undetermined { mechanism: "Symmetric", group: "e, f" }));
        }
        // Links of different lengths do not reach a joint that coincides, exactly or nearly.
        let unequal = |scale: f64| Symmetric { k: 1.9 * scale, ..at(scale) };
        let found = unequal(1.0).limits(2.0, branch).unwrap();
        let (Limit::Bracketed { assembled, group, .. }, Limit::Bracketed { assembled: lower, .. }) =
            (found.upper, found.lower)
        else {
            panic!("{found:?}")
        };
        assert!(group == "e, f" && lower > 0.5 && assembled < 3.5 && assembled > 3.4, "{found:?}");
        let found = at_all_scales(|scale| {
            unequal(scale).assemble(3.5 * scale, branch).map(|pose| pose.e).map_err(without_inputs)
        });
        let Err(PositionError::Unbuildable { group: "e, f", gap, .. }) = found else { panic!("{found:?}") };
        assert!((gap - (0.1_f64 / 3.9).powi(2)).abs() < 1e-15, "{gap}");
        // The end of the first dyads is rounded inward or outward, and the third ends before either.
        for l in (1..200).map(|part| 1.9 + 0.001 * f64::from(part)) {
            let m = Symmetric { l, ..unequal(1.0) };
            let found = m.limits(2.0, branch).unwrap();
            for limit in [found.lower, found.upper] {
                let Limit::Bracketed { assembled, unbuildable, group: "e, f" } = limit else {
                    panic!("{l}: {limit:?}")
                };
                assert!(m.assemble(assembled, branch).is_ok() && m.assemble(unbuildable, branch).is_err());
            }
        }
    }
}

/// A search passes an input at which the kite is folded, and finds the limit beyond it.
#[test]
fn a_kite_that_folds() {
    let at = |scale: f64| Kite::default().map(|length: f64| length * scale);
    for branch in KiteBranch::all() {
        let folded = at_all_scales(|scale| at(scale).assemble(0.0, branch).map(|pose| pose.coordinates()));
        assert_eq!(folded, Err(PositionError::Undetermined { mechanism: "Kite", group: "alpha, beta" }));
        assert_eq!(at(1.0).branches(0.0).unwrap().count(), 0);
        // Links of 0.1 + 0.2 and 0.3 are equally long.
        let decimal = Kite { coupler: 0.1 + 0.2, rocker: 0.3, ground: 0.7, crank: 0.7, ..at(1.0) };
        let found = decimal.assemble(0.0, branch).map(|pose| pose.coordinates());
        assert_eq!(found, Err(PositionError::Undetermined { mechanism: "Kite", group: "alpha, beta" }));
        let unequal = at_all_scales(|scale| {
            Kite { rocker: 51.0 * scale, ..at(scale) }.assemble(0.0, branch).map(|pose| pose.alpha)
        });
        assert!(matches!(unequal, Err(PositionError::Unbuildable { group: "alpha, beta", .. })), "{unequal:?}");
    }
    // The steps from here are of a degree, and one of them is at the fold.
    let mut passed = 0;
    for branch in KiteBranch::all() {
        for degrees in [-40, -20, 20, 40] {
            let start = f64::from(degrees) * std::f64::consts::TAU / 360.0;
            let Ok(found) = at_all_scales(|scale| at(scale).limits(start, branch)) else { continue };
            for limit in [found.lower, found.upper] {
                let Some(end) = limit.input() else { continue };
                passed += usize::from(end * start < 0.0);
                let beyond = |part: f64| at(1.0).assemble(start + (end - start) * part, branch);
                assert!((1..1000).all(|part| beyond(f64::from(part) / 1000.0).is_ok()), "{start} {limit:?}");
                let beyond = beyond(1.0 + 1e-9);
                assert!(matches!(beyond, Err(PositionError::Unbuildable { .. })), "{start} {limit:?} {beyond:?}");
            }
        }
    }
    assert!(passed > 0);
}

/// Flat, but not coincident: every joint is determined, on both branches.
#[test]
fn a_parallelogram_is_flat_but_determined() {
    let at = |scale: f64| {
        Kite { ground: 40.0, crank: 20.0, coupler: 40.0, rocker: 20.0, ..Kite::default() }
            .map(|length: f64| length * scale)
    };
    for branch in KiteBranch::all() {
        let Ok(flat) = at_all_scales(|scale| at(scale).assemble(0.0, branch).map(|pose| pose.coordinates())) else {
            panic!("{branch:?}")
        };
        assert_eq!([flat.alpha, flat.beta], [0.0; 2]);
    }
    // The links are also in line without folding.
    assert_eq!(at(1.0).branches(0.0).unwrap().count(), 4);
}

#[test]
fn a_pin_in_the_pivot_of_its_slot() {
    let at = |scale: f64| Slot::default().map(|length: f64| length * scale);
    for along in [Slider::Far, Slider::Near] {
        let branch = SlotBranch { arm_along: along };
        // A turn later the pin is off by a rounding error.
        for theta in [0.0, std::f64::consts::TAU] {
            let found = at_all_scales(|scale| at(scale).assemble(theta, branch).map(|pose| pose.arm));
            assert_eq!(found, Err(PositionError::Undetermined { mechanism: "Slot", group: "arm, along" }));
            let offset = |scale: f64| Slot { offset: 20.0 * scale, ..at(scale) };
            let found = at_all_scales(|scale| offset(scale).assemble(theta, branch).map(|pose| pose.arm));
            assert!(matches!(found, Err(PositionError::Unbuildable { group: "arm, along", .. })), "{found:?}");
        }
        assert!(at(1.0).assemble(1e-9, branch).is_ok());
    }
}

#[test]
fn a_link_without_length() {
    for s in [Slider::Far, Slider::Near] {
        let branch = RodBranch { phi_s: s };
        let at = |scale: f64| Rod { crank: scale, rod: 0.0, tilt: 0.3 };
        let found = at_all_scales(|scale| at(scale).assemble(0.3, branch).map(|pose| pose.phi));
        assert_eq!(found, Err(PositionError::Undetermined { mechanism: "Rod", group: "phi, s" }));
        let found = at_all_scales(|scale| at(scale).assemble(0.4, branch).map(|pose| pose.phi));
        assert!(matches!(found, Err(PositionError::Unbuildable { .. })), "{found:?}");
    }
    // One link of a dyad, or both.
    let branch = CellBranch { up_up1: Elbow::Left, down_down1: Elbow::Right, up2_down2: Elbow::Left };
    let found = at_all_scales(|scale| {
        Cell { crank: scale, long: 2.0 * scale, short: 0.0 }.assemble(0.0, branch).map(|pose| pose.up)
    });
    assert_eq!(found, Err(PositionError::Undetermined { mechanism: "Cell", group: "up, up1" }));
    let found = at_all_scales(|_| Cell { crank: 0.0, long: 0.0, short: 0.0 }.assemble(0.0, branch).map(|pose| pose.up));
    assert_eq!(found, Err(PositionError::Undetermined { mechanism: "Cell", group: "up, up1" }));
}

#[test]
fn parallel_guides() {
    let at = |scale: f64| Guides { a: 4.0 * scale, b: scale, alpha: 0.5 };
    let branch = GuidesBranch {};
    let apart = at_all_scales(|scale| at(scale).assemble(0.5, branch).map(|pose| pose.s));
    let Err(PositionError::Unbuildable { mechanism: "Guides", group: "s, u", gap, .. }) = apart else {
        panic!("{apart:?}")
    };
    // Their distance, relative to its terms.
    assert!(gap > 0.01 && gap < 1.0, "{gap}");
    // On one line.
    let one = |scale: f64| Guides { a: 4.0 * 0.5_f64.cos() * scale, b: 4.0 * 0.5_f64.sin() * scale, alpha: 0.5 };
    let found = at_all_scales(|scale| one(scale).assemble(0.5, branch).map(|pose| pose.s));
    assert_eq!(found, Err(PositionError::Undetermined { mechanism: "Guides", group: "s, u" }));
    assert_eq!(one(1.0).branches(0.5).unwrap().count(), 0);
    assert_eq!(one(1.0).branches(0.6).unwrap().count(), 1);
}

#[test]
fn factors_that_vanish() {
    let branch = FactorsBranch { phi: Slope::Rising };
    let at = |ratio: f64, height: f64, v: f64, w: f64| {
        at_all_scales(|scale| {
            let m = Factors { ratio: ratio * scale, height: height * scale };
            m.assemble(FactorsInputs { v: v * scale, w: w * scale }, branch)
                .map(|pose| pose.phi)
                .map_err(without_inputs)
        })
    };
    assert!(at(2.0, 1.0, 3.0, 4.0).is_ok());
    assert_eq!(at(0.0, 1.0, 0.0, 4.0), Err(PositionError::Undetermined { mechanism: "Factors", group: "wheel" }));
    assert!(matches!(at(0.0, 1.0, 3.0, 4.0), Err(PositionError::Unbuildable { group: "wheel", .. })));
    assert_eq!(at(2.0, 0.0, 3.0, 0.0), Err(PositionError::Undetermined { mechanism: "Factors", group: "phi" }));
    assert!(matches!(at(2.0, 1.0, 3.0, 0.0), Err(PositionError::Unbuildable { group: "phi", .. })));
}
