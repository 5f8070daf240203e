//! Pictures of mechanisms at run time against those of emitted code.

use linkage::skeleton::{Part, Skeleton};
use linkage::{Branches, Column, D, Kinematic, UpTo, linkage};
use linkage_gallery::tilted_parallelogram::TiltedParallelogram;

use super::pictures::{drawings, reports, tables};
use super::wrapped::{AtRunTime, Texts, column};

linkage! {
    /// A crank-rocker.
    #[derive(Debug, Clone, Copy)]
    mechanism CrankRocker {
        param ground = 80, crank = 20, coupler = 50, rocker = 70;
        input theta;
        unknown phi, psi in 60deg..115deg;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        point A = crank@theta;
        point C = crank@theta + coupler@phi;
        output swing = psi;
        output height = rocker * sin(psi);
        derive drawing;
    }

    /// A double rocker: the input turns back at dead points.
    #[derive(Debug, Clone, Copy)]
    mechanism Rocker {
        param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        derive drawing;
    }

    /// An oscillating block.
    #[derive(Debug, Clone, Copy)]
    mechanism Block {
        param ground = 3, crank = 1;
        input theta;
        unknown s, psi;
        loop crank@theta = ground@0 + s@psi;
        point Pin = crank@theta;
        output turned = psi - theta;
        derive drawing;
    }
}

impl<'n, M> Skeleton for AtRunTime<'n, M>
where
    M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>> + Skeleton,
{
    type Parts = UpTo<40>;
    const JOINTS: &'static [&'static str] = panic!("joints of a value");
    const PARTS: &'static [Part<'static>] = panic!("parts of a value");

    fn joint_name(&self, place: usize) -> Option<&'n str> {
        self.of.joint_name(place)
    }
    fn drawn_parts(&self) -> &[Part<'_>] {
        self.of.drawn_parts()
    }
    fn joints(&self, pose: &M::Pose) -> Column<f64, UpTo<40>> {
        column(&self.of.joints(pose))
    }
    fn guide(&self, pose: &M::Pose, place: usize) -> Option<[f64; 2]> {
        self.of.guide(pose, place)
    }
    fn force_place(&self, pose: &M::Pose, place: usize) -> Option<[f64; 4]> {
        self.of.force_place(pose, place)
    }
}

/// Calls a function with the mechanism at run time, whose names have a mark.
fn wrapped<M, R>(m: &M, mark: &str, call: impl FnOnce(&AtRunTime<'_, M>) -> R) -> R
where
    M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>> + Clone,
{
    let texts = Texts::marked_by::<M>(mark);
    let (inputs, groups) = (texts.inputs(), texts.groups::<M>());
    call(&AtRunTime { of: m.clone(), texts: &texts, inputs: &inputs, groups: &groups })
}

/// The first positions at an input, with their branches.
fn positions<M: Kinematic<Scalar = f64, V = D<1>> + Branches>(m: &M, input: f64) -> Vec<(M::Branch, M::Coordinates)> {
    let inputs: linkage::PerInput<M> = [input].into();
    m.all_positions(inputs.into()).unwrap().collect()
}

/// Compares texts, line by line.
#[track_caller]
fn same(emitted: &[String], at_run_time: &[String]) {
    for (emitted, at_run_time) in emitted.iter().zip(at_run_time) {
        for (one, other) in emitted.lines().zip(at_run_time.lines()) {
            assert_eq!(one, other);
        }
        assert_eq!(emitted, at_run_time);
    }
    assert_eq!(emitted.len(), at_run_time.len());
}

/// Pictures have no marks: their layout depends on the width of names.
macro_rules! pictured {
    ($Mechanism:ty, $input:expr) => {{
        let m = <$Mechanism>::default();
        let derivation = <$Mechanism>::DERIVATION;
        for (branch, q) in positions(&m, $input) {
            let split = AtRunTime::<$Mechanism>::split(&q);
            same(&drawings(&m, &q, branch), &wrapped(&m, "", |m| drawings(m, &split, branch)));
            same(&tables(&m, branch), &wrapped(&m, "", |m| tables(m, branch)));
            let at_run_time = wrapped(&m, "", |m| reports(m, derivation, &split, branch));
            same(&reports(&m, derivation, &q, branch), &at_run_time);
        }
    }};
}

#[test]
fn pictures() {
    pictured!(CrankRocker, 1.0);
    pictured!(Rocker, 0.4);
    pictured!(Block, 0.9);
    pictured!(TiltedParallelogram, 0.7);
}
