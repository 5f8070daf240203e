//! Disc cams with user-defined laws of motion.

use std::error::Error;
use std::f64::consts::TAU;

use linkage::Elbow::Left;
use linkage::PositionError;
use linkage::nalgebra::{Vector2, vector};

use crate::figure::{Course, Figure, at, polar};

use linkage_gallery::cam_follower::*;
use linkage_gallery::cam_rocker::*;

pub fn figures() -> Result<Vec<Figure>, Box<dyn Error>> {
    Ok(vec![cam_follower()?, cam_rocker()?])
}

/// The angles of a turn, in steps of 1.5 degrees.
fn turn() -> impl Iterator<Item = f64> {
    (0..240).map(|step| TAU * f64::from(step) / 240.0)
}

fn cam_follower() -> Result<Figure, Box<dyn Error>> {
    let m = CamFollower::default();
    let mut figure = assembled!("Cam follower", CamFollower, m on CamFollowerBranch::new(), from 30.0, |pose, points| {
        let stem = points.roller + vector![0.0, 2.0 * m.height];
        [("O", at(0.0, 0.0)), ("Nose", polar(m.prime, pose.theta.angle()).into()), ("Stem", stem)]
    });
    let profile: Result<Vec<_>, PositionError> =
        turn().map(|theta| Ok(m.points(&m.assemble(theta, CamFollowerBranch {})?)?.profile.coords)).collect();
    figure.picture.plate("O", "Nose", profile?).ground("O").wheel("Roller", "Contact", m.roller);
    figure.picture.link(&["Roller", "Stem"]).slider("Stem");
    Ok(figure.words(
        "Rise and return by the 3-4-5 polynomial, a user function; the profile is the envelope of the roller.",
        "R. L. Norton, Design of Machinery",
    ))
}

fn cam_rocker() -> Result<Figure, Box<dyn Error>> {
    let m = CamRocker::default();
    let roller = 0.2 * m.lever;
    let axis = at(-m.distance, 0.0);
    let mut figure = assembled!("Cam and rocker", CamRocker, m on CamRockerBranch::new(Left), from 30.0,
    |pose, points| {
        let nose = axis + polar(m.lever, pose.theta.angle());
        [("O", at(0.0, 0.0)), ("Axis", axis), ("Nose", nose), ("Rim", points.roller + vector![roller, 0.0])]
    });
    let pitch: Result<Vec<Vector2<f64>>, PositionError> =
        turn().map(|theta| Ok(m.points(&m.assemble(theta, CamRockerBranch::new(Left))?)?.pitch.coords)).collect();
    let pitch = pitch?;
    // The profile is offset inward from the pitch curve, which runs clockwise, by the radius of the roller.
    let inside = (0..pitch.len()).map(|index| {
        let along = (pitch[(index + 1) % pitch.len()] - pitch[(index + pitch.len() - 1) % pitch.len()]).normalize();
        pitch[index] + roller * vector![along.y, -along.x]
    });
    figure.picture.plate("Axis", "Nose", inside).ground("Axis").wheel("Roller", "Rim", roller);
    figure.picture.link(&["O", "A", "Roller"]).link(&["A", "B"]).link(&["C", "B"]);
    figure.picture.ground("O").ground("C").trace("B");
    Ok(figure.words(
        "An oscillating follower with cycloidal motion drives a rocker: a cam and a dyad, both in closed form.",
        "H. A. Rothbart, Cams (1956)",
    ))
}
