//! tmp
use linkage::linkage;
mod m { use super::linkage; include!("mechanisms/four_bar.rs"); }
mod s { use super::linkage; include!("mechanisms/six_bar.rs"); }
#[test]
fn go() {
    let fb = m::FourBar::default();
    let q = m::FourBarCoordinates { theta2: 20f64.to_radians(), theta3: 70f64.to_radians(), theta4: -50f64.to_radians() };
    let sol = fb.solve(&q).unwrap();
    println!("{sol:?}");
    let mo = fb.motion(&sol.coordinates, 41.887_902_047_863_91, 0.0).unwrap();
    println!("{mo:#?}");
    let sb = s::SixBar::default();
    let q = s::SixBarCoordinates { theta1: 1.0, theta2: 0.5, theta3: 1.4, theta4: 0.5, theta5: 1.5 };
    println!("{:?}", sb.solve(&q));
}
