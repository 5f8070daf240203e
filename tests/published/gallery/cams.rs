//! Cams and their followers: published peaks, pressure angles and profiles.

use approx::assert_abs_diff_eq;
use std::f64::consts::{PI, TAU};

use super::course::{degrees, turn};
use super::exactness::exact;

use linkage_gallery::cam_follower::*;
use linkage_gallery::cam_rocker::*;

/// Peak velocity and acceleration of the 3-4-5 polynomial are 1.875 h / beta and 5.7735 h / beta^2, those of
/// cycloidal motion 2 h / beta and 2 pi h / beta^2: R. L. Norton, *Design of Machinery*, chapter 8, factors for peak
/// velocity and acceleration.
#[test]
fn cams_reach_their_published_peaks() {
    let m = CamFollower::default();
    let course = turn(&m, CamFollowerCoordinates { theta: 0.0, s: 0.0 });
    let velocity = course.range(|q| m.velocity(&m.pose_at(q), 1.0).unwrap().s);
    let acceleration = course.range(|q| m.motion(q, 1.0, 0.0).unwrap().accelerations.s);
    for (sign, velocity, acceleration) in [(-1.0, velocity[0], acceleration[0]), (1.0, velocity[1], acceleration[1])] {
        assert_abs_diff_eq!(velocity * m.rise / m.height, sign * 1.875, epsilon = 1e-14);
        assert_abs_diff_eq!(acceleration * m.rise.powi(2) / m.height, sign * 10.0 / 3.0_f64.sqrt(), epsilon = 1e-12);
        assert_abs_diff_eq!(acceleration * m.rise.powi(2) / m.height, sign * 5.7735, epsilon = 5e-5);
    }
    let m = CamRocker::default();
    let start = CamRockerCoordinates { theta: 0.0, psi: degrees(75.0), phi: 0.2, beta: degrees(100.0) };
    let course = turn(&m, start);
    let velocity = course.range(|q| m.velocity(&m.pose_at(q), 1.0).unwrap().psi);
    let acceleration = course.range(|q| m.motion(q, 1.0, 0.0).unwrap().accelerations.psi);
    for (sign, velocity, acceleration) in [(-1.0, velocity[0], acceleration[0]), (1.0, velocity[1], acceleration[1])] {
        assert_abs_diff_eq!(velocity * m.rise / m.swing, sign * 2.0, epsilon = 1e-14);
        assert_abs_diff_eq!(acceleration * m.rise.powi(2) / m.swing, sign * TAU, epsilon = 1e-12);
    }
}

/// The pressure angle is that between the path of the follower and the line from the contact to the roller's axis;
/// the profile touches the roller where it is, at right angles to that line.
#[test]
fn cam_follower() {
    let m = CamFollower::default();
    let course = turn(&m, CamFollowerCoordinates { theta: 0.0, s: 0.0 });
    course.closed_form();
    course.rigid(CamFollower::points, |p| [(p.roller, p.contact, m.roller), (p.pitch, p.profile, m.roller)]);
    let size = m.prime + m.roller + m.height;
    for q in &course.positions {
        let motion = m.motion(q, 1.0, 0.0).unwrap();
        let points = motion.points;
        exact(points.roller.position.x, m.offset, size);
        exact(points.pitch.position.coords.norm(), points.roller.position.coords.norm(), size);
        let normal = points.roller.position - points.contact.position;
        exact(motion.outputs.pressure.value.tan() * normal.y, -normal.x, size);
        let along = (points.pitch.position - points.profile.position) / m.roller;
        exact(along.dot(&points.profile.velocity), 0.0, size);
        // The point of the cam under the roller moves along the tangent relative to the roller's axis.
        let contact = points.contact.position;
        let sliding = points.roller.velocity - nalgebra::vector![-contact.y, contact.x];
        exact(normal.dot(&sliding) / m.roller, 0.0, size);
    }
    let [least, largest] = course.range(|q| q.s);
    exact(least, 0.0, size);
    exact(largest, m.height, size);
    // In the lower dwell the pitch curve is the prime circle, in the upper one a larger circle.
    let foot = (m.prime.powi(2) - m.offset.powi(2)).sqrt();
    for (theta, radius) in
        [(2.2, m.offset.hypot(foot + m.height)), (3.0, m.offset.hypot(foot + m.height)), (5.9, m.prime)]
    {
        let pose = m.pose_at(&course.at(theta));
        exact(m.points(&pose).unwrap().pitch.coords.norm(), radius, size);
    }
}

#[test]
fn cam_rocker() {
    let m = CamRocker::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let start = CamRockerCoordinates { theta: 0.0, psi: degrees(75.0), phi: 0.2, beta: degrees(100.0) };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(CamRocker::points, |p| [(p.a, p.b, m.rod), (p.b, p.c, m.rocker)]);
    let [least, largest] = course.range(|q| q.psi);
    exact(least, m.rest, PI);
    exact(largest, m.rest + m.swing, PI);
    let size = m.distance + m.lever;
    for q in &course.positions {
        let points = points(q);
        let from_axis = points.roller + nalgebra::vector![m.distance, 0.0];
        exact(points.pitch.coords.norm(), from_axis.coords.norm(), size);
    }
    // The rocker rests while the cam's follower does.
    for theta in [2.2, 3.0, 5.4, 6.0] {
        let velocity = m.velocity(&m.pose_at(&course.at(theta)), 1.0).unwrap();
        assert_eq!([velocity.psi, velocity.phi, velocity.beta], [0.0; 3]);
    }
}
