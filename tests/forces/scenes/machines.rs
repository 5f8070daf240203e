//! The mechanisms, and their positions.

use linkage::Real;

use super::virtual_work::{Placed, Positions, constant};

pub use linkage_gallery::five_bar_scenes::*;
pub use linkage_gallery::four_bar_scenes::*;
pub use linkage_gallery::slider_crank_scenes::*;

pub(super) const FOUR_BAR: LoadedFourBarBranch = LoadedFourBarBranch::new(linkage::Elbow::Left);

pub(super) fn four_bar_at<T: Real>(v: [T; 1]) -> Option<LoadedFourBarCoordinates<T>> {
    let four_bar = LoadedFourBar::default().map(constant);
    Some(four_bar.assemble(v[0], FOUR_BAR).ok()?.coordinates())
}

pub(super) struct FourBarPositions;

impl Positions<1> for FourBarPositions {
    fn bodies<T: Real>(&self, v: [T; 1]) -> Vec<Placed<T>> {
        let (m, scene) = (LoadedFourBar::default().map(constant::<T>), Idle::default());
        let pose = m.assemble(v[0], FOUR_BAR).unwrap();
        let (points, q) = (m.points(&pose).unwrap(), pose.coordinates());
        vec![
            (scene.m2, scene.j2, points.g2.into(), q.theta2),
            (scene.m3, scene.j3, points.g3.into(), q.theta3),
            (scene.m4, scene.j4, points.g4.into(), q.theta4),
        ]
    }

    fn scalars<T: Real>(&self, v: [T; 1]) -> Vec<T> {
        let (m, scene) = (LoadedFourBar::default().map(constant::<T>), Loaded::default());
        let pose = m.assemble(v[0], FOUR_BAR).unwrap();
        let (c, q) = (m.points(&pose).unwrap().c, pose.coordinates());
        let (x, y) = (c.x - constant::<T>(scene.xp), c.y - constant::<T>(scene.yp));
        let length = (x * x + y * y).sqrt();
        let turn = q.theta3 - v[0];
        let v = constant::<T>(2.0) * q.theta4.sin() * turn * turn;
        vec![length, q.theta4, v, c.y]
    }
}

pub(super) const PAIR: PairBranch = PairBranch::new(linkage::Elbow::Right);

pub(super) struct PairPositions;

impl Positions<2> for PairPositions {
    fn bodies<T: Real>(&self, v: [T; 2]) -> Vec<Placed<T>> {
        let (m, scene) = (Pair::default().map(constant::<T>), Free::default());
        let pose = m.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR).unwrap();
        let (points, q) = (m.points(&pose).unwrap(), pose.coordinates());
        vec![
            (scene.m1, scene.j1, points.g1.into(), q.theta1),
            (scene.m2, scene.j2, points.g2.into(), q.theta2),
            (scene.m3, scene.j3, points.g3.into(), q.theta3),
            (scene.m4, scene.j4, points.g4.into(), q.theta4),
        ]
    }

    fn scalars<T: Real>(&self, v: [T; 2]) -> Vec<T> {
        let m = Pair::default().map(constant::<T>);
        let pose = m.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR).unwrap();
        vec![m.outputs(&pose).unwrap().opening]
    }
}
