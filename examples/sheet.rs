//! The derivation of the four-bar of the Maple sheet as one HTML file: formulas, numbers of a pose and a picture.
//!
//! `cargo run --example sheet` writes `target/sheet.html`, for any browser, without network.

use std::error::Error;

use linkage::drawing::Drawing;
use linkage::sheet::Sheet;
use linkage::{Document, Mechanism, linkage};

mod output;

linkage! {
    /// The sheet's four-bar A-B-C-D: crank l2, coupler l3, l4 from C to D, frame l1.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;

        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;

        point B = l2@theta2;
        point C = B + l3@theta3;
        point G3 = B + (l3/2)@theta3;
        /// The transmission angle.
        output mu = theta3 - theta4;
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let four_bar = FourBar::default();
    let guess = FourBarCoordinates { theta2: 20_f64.to_radians(), theta3: 1.2, theta4: -0.9 };
    let q = four_bar.solve(&guess)?.coordinates;
    let pose = four_bar.pose_at(&q);
    let omega2 = 400.0 * std::f64::consts::TAU / 60.0;
    let motion = four_bar.motion(&q, omega2, 0.0)?;

    let mut drawing = Drawing::new("Four-bar at 20 deg, 400 rpm");
    drawing
        .units("mm", "s")
        .ground("A", [0.0, 0.0])
        .joint("B", motion.points.b.position)
        .joint("C", motion.points.c.position)
        .ground("D", [four_bar.l1, 0.0])
        .bar("A", "D")
        .bar("A", "B")
        .bar("B", "C")
        .bar("C", "D")
        .velocity_scale(0.02)
        .velocity("B", motion.points.b.velocity)
        .velocity("C", motion.points.c.velocity)
        .point("G3", motion.points.g3.position)
        .velocity("G3", motion.points.g3.velocity);

    let ratios = four_bar.velocity_ratios(&pose)?;
    let mut sheet = Sheet::new(FourBar::DERIVATION);
    sheet
        .title("A four-bar linkage from loop equation to acceleration")
        .numbers("Given, mm", FourBar::<f64>::PARAMETERS.into_iter().zip(<[f64; 4]>::from(four_bar.clone())))
        .numbers("Position, rad", [("theta2", q.theta2), ("theta3", q.theta3), ("theta4", q.theta4)])
        .numbers("Jacobian, mm²", [("det J", four_bar.determinant(&pose))])
        .numbers("Velocity ratios", [("theta3/theta2", ratios[0]), ("theta4/theta2", ratios[1])])
        .numbers(
            "Velocity at 400 rpm, rad/s",
            [("theta2_rate", omega2), ("theta3_rate", motion.rates.theta3), ("theta4_rate", motion.rates.theta4)],
        )
        .numbers(
            "Acceleration, rad/s²",
            [
                ("theta3_acceleration", motion.accelerations.theta3),
                ("theta4_acceleration", motion.accelerations.theta4),
            ],
        )
        .picture(
            drawing.to_svg()?,
            "The linkage at this position, with velocities of B, C and the middle of the coupler",
        );

    let html = sheet.to_html();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/sheet.html".to_owned());
    let path = output::write(path, &html)?;
    println!("{}", FourBar::DERIVATION.to_text());
    println!("Sheet: {path}, {} kB", html.len() / 1000);

    // The formula and the value for theta3' / theta2' are those of the Maple sheet.
    assert_eq!(FourBar::DERIVATION.ratios[0].to_string(), "∂θ₃/∂θ₂ = −l₂·sin(θ₂ − θ₄)/(l₃·sin(θ₃ − θ₄))");
    assert!((ratios[0] + 0.439_871_260_155_996).abs() < 1e-14);
    Ok(())
}
