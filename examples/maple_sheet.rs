//! The four-bar of the Maple sheet (La Sapienza, Meccanica applicata alle macchine, 2009-2010, "Analisi cinematica
//! mediante il metodo delle equazioni di vincolo"), step by step: loop equations, Jacobians, determinant, velocity
//! ratios, Newton's iterates, velocities, accelerations by both methods, and the picture. Each number is printed next
//! to the value of the sheet, which has ten digits.
//!
//! `cargo run --example maple_sheet`

use std::error::Error;

use linkage::drawing::Drawing;
use linkage::nalgebra::{SMatrix, SVector, Vector2};
use linkage::{Mechanism, PositionError, linkage, position};

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
        point G2 = (l2/2)@theta2;
        point G3 = B + (l3/2)@theta3;
        point G4 = C + (l4/2)@theta4;
    }
}

/// The relative accuracy of the sheet's values, and the tolerance of the comparison.
const SHEET: f64 = 1e-8;

fn beside(what: &str, ours: f64, sheet: f64) {
    let error = (ours - sheet).abs() / sheet.abs();
    println!("  {what:<12} {ours:>22.15} {sheet:>22} {error:>9.1e}");
    assert!(error <= SHEET, "{what}: {ours} differs from the sheet's {sheet}");
}

fn heading(text: &str) {
    println!("\n{text}");
}

fn table() {
    println!("  {:<12} {:>22} {:>22} {:>9}", "", "here", "sheet", "relative");
}

fn main() -> Result<(), Box<dyn Error>> {
    let four_bar = FourBar::default();
    let guess =
        FourBarCoordinates { theta2: 20_f64.to_radians(), theta3: 70_f64.to_radians(), theta4: (-50_f64).to_radians() };

    println!("Four-bar l1 = 80, l2 = 20, l3 = 50, l4 = 70 at theta2 = 20 deg, q = (theta3, theta4 | theta2)");
    let pose = four_bar.pose_at(&guess);
    heading("Psi at the start (70 deg, -50 deg)");
    println!("{:.9}", SVector::from(four_bar.residual(&pose)));
    heading("Psi_q");
    println!("{:.9}", four_bar.jacobian(&pose));
    heading("Psi_u = J and Psi_v = A");
    let (j, a) = (SMatrix::from(four_bar.jacobian_unknowns(&pose)), SMatrix::from(four_bar.jacobian_inputs(&pose)));
    println!("{j:.9}{a:.9}");
    heading("det J = -l3 l4 sin(theta3 - theta4)");
    println!("  {:.12}", four_bar.determinant(&pose));

    heading("Newton-Raphson: u <- u - J^-1 Psi");
    table();
    let sheet = [
        [1.231_369_779_827_999_9, -0.880_815_834_226],
        [1.231_343_147_259_939_9, -0.880_796_908_817_59],
        [1.231_343_147_588_470_9, -0.880_796_908_715_914_2],
        [1.231_343_146_814_298_8, -0.880_796_908_651_079_8],
    ];
    let mut q = guess;
    for (step, printed) in sheet.into_iter().enumerate() {
        q = position::newton_step(&four_bar, &q)?;
        beside(&format!("theta3, u_{}", step + 1), q.theta3, printed[0]);
        beside(&format!("theta4, u_{}", step + 1), q.theta4, printed[1]);
    }
    let solution = four_bar.solve(&guess)?;
    let q = solution.coordinates;
    println!("  solve: {} iterations, relative residual {:.1e}", solution.iterations, solution.residual);
    beside("theta3 deg", q.theta3.to_degrees(), 70.550_765_45);
    beside("theta4 deg", q.theta4.to_degrees(), -50.465_945_47);
    let pose = four_bar.pose_at(&q);
    let residual = four_bar.residual(&pose);
    println!("  residuals    {:.1e}, {:.1e} (the sheet's: 1e-8, -1e-8)", residual[0], residual[1]);
    assert!(residual.largest() < 1e-13);

    let omega2 = 400.0 * std::f64::consts::TAU / 60.0;
    heading("Velocity ratios W = -J^-1 A (the sheet's Rap is -W), and q' = (W omega2, omega2)");
    let ratios = four_bar.velocity_ratios(&pose)?;
    println!("  W = ({:.15}, {:.15})", ratios[0], ratios[1]);
    table();
    let velocity = four_bar.velocity(&pose, omega2)?;
    beside("omega3", velocity.theta3, -18.425_284_25);
    beside("omega4", velocity.theta4, -10.783_359_24);

    heading("gamma = (Psi_q q')_q q'");
    let gamma = four_bar.gamma(&pose, &velocity);
    println!("  ({:.9}, {:.9})", gamma[0], gamma[1]);

    heading("Accelerations");
    table();
    let acceleration = four_bar.acceleration(&pose, &velocity, 0.0)?;
    beside("alpha3", acceleration.theta3, -259.655_463_7);
    beside("alpha4", acceleration.theta4, 584.710_757_2);
    let other = by_derivatives_of_the_jacobian(&four_bar, &q, &velocity, 0.0)?;
    let second = SVector::from([acceleration.theta3, acceleration.theta4]);
    let difference = second - other;
    println!("  the sheet's first method, -J^-1 (A v'' + J' u' + A' v'): ({:.12}, {:.12})", other.x, other.y);
    println!("  difference of the two methods: ({:.1e}, {:.1e}); it must be zero", difference.x, difference.y);
    assert!(difference.amax() <= 1e-13 * second.amax());

    heading("Velocities and accelerations of G2, G3, G4 and C, by the fused kernel");
    table();
    let motion = four_bar.motion(&q, omega2, 0.0)?;
    let points = motion.points;
    let rows = [
        (
            "G2",
            points.g2,
            [-143.265_062_582_571_63, 393.617_524_561_588_5],
            [-16_487.812_310_063_113, -6_001.072_907_213_23],
        ),
        (
            "G3",
            points.g3,
            [147.816_876_851_324_48, 633.857_674_241_152_4],
            [-29_680.678_516_457_79, -22_166.559_682_784_482],
        ),
        (
            "G4",
            points.g4,
            [291.081_939_585_819_6, 240.240_150_048_553_77],
            [-13_192.866_189_499_306, -16_165.486_750_680_546],
        ),
        (
            "C",
            points.c,
            [582.163_878_867_792_2, 480.480_299_359_127_86],
            [-26_385.732_412_789_34, -32_330.973_551_142_5],
        ),
    ];
    for (name, point, velocity, acceleration) in rows {
        for (axis, index) in [("x", 0), ("y", 1)] {
            beside(&format!("V{name}.{axis}"), point.velocity[index], velocity[index]);
            beside(&format!("A{name}.{axis}"), point.acceleration[index], acceleration[index]);
        }
    }

    let path = std::env::args().nth(1).unwrap_or_else(|| "target/maple_sheet.svg".to_owned());
    let path = output::write(path, &picture(&four_bar, &points)?)?;
    println!("\nPicture: {path}");
    Ok(())
}

/// The sheet's first method: u'' = -J^-1 (A v'' + J' u' + A' v') with the time derivatives J' and A', written by hand
/// as in the sheet.
fn by_derivatives_of_the_jacobian(
    four_bar: &FourBar,
    q: &FourBarCoordinates,
    velocity: &FourBarRates,
    alpha2: f64,
) -> Result<Vector2<f64>, PositionError> {
    let FourBar { l2, l3, l4, .. } = *four_bar;
    let column = |l: f64, theta: f64, omega: f64| [-l * theta.cos() * omega, -l * theta.sin() * omega];
    let j_rate =
        SMatrix::<f64, 2, 2>::from([column(l3, q.theta3, velocity.theta3), column(l4, q.theta4, velocity.theta4)]);
    let a_rate = SMatrix::<f64, 2, 1>::from([column(l2, q.theta2, velocity.theta2)]);
    let pose = four_bar.pose_at(q);
    let h1 = SMatrix::from(four_bar.jacobian_inputs(&pose)) * alpha2;
    let h2 = j_rate * Vector2::new(velocity.theta3, velocity.theta4);
    let h3 = a_rate * velocity.theta2;
    Ok(four_bar.solve_jacobian(&pose, &(-(h1 + h2 + h3)).into())?.into())
}

/// The sheet's picture: velocities green at 0.02, accelerations red at 0.0005.
fn picture(
    four_bar: &FourBar,
    points: &FourBarPoints<linkage::PointMotion>,
) -> Result<String, linkage::drawing::DrawingError> {
    let mut drawing = Drawing::new("Four-bar of the sheet at theta2 = 20 deg, 400 rpm");
    drawing
        .units("mm", "s")
        .ground("A", [0.0, 0.0])
        .joint("B", points.b.position)
        .joint("C", points.c.position)
        .ground("D", [four_bar.l1, 0.0])
        .bar("A", "D")
        .bar("A", "B")
        .bar("B", "C")
        .bar("C", "D")
        .velocity_scale(0.02)
        .acceleration_scale(0.0005);
    for (name, point) in [("G2", points.g2), ("G3", points.g3), ("G4", points.g4)] {
        drawing.point(name, point.position).velocity(name, point.velocity).acceleration(name, point.acceleration);
    }
    drawing.to_svg()
}
