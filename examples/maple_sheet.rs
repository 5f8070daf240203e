//! The four-bar of the Maple sheet (La Sapienza, Meccanica applicata alle macchine, 2009-2010, "Analisi cinematica
//! mediante il metodo delle equazioni di vincolo"), line by line: counts, loop equations, Jacobians, determinant, velocity
//! ratios, Newton's iterates, velocities, the derivatives of the Jacobian, accelerations by both methods, the matrices of
//! the links, the points on them, and the picture. Each number is printed next to the value of the sheet, which has ten
//! digits; each formula is printed with its number.
//!
//! `cargo run --example maple_sheet` writes `target/maple_sheet.svg` and `target/maple_sheet.html`.

use std::error::Error;

use linkage::analysis::{Analysis, AnalysisOf, Turning};
use linkage::drawing::Drawing;
use linkage::nalgebra::{SMatrix, SVector};
use linkage::sheet::{Sheet, Values, ratio_properties, text_at};
use linkage::{Mechanism, PointMotion, linkage, position};

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

        derive sheet;
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

    println!("Four-bar, {}", FourBar::DERIVATION.counts());
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

    let at = Analysis::of(&four_bar, &pose, omega2, 0.0)?;
    heading("The derivatives of Psi_u and Psi_v with respect to time, and ([Psi_u] u')_u, which is the first of them");
    println!("{:.9}{:.9}", SMatrix::from(at.jacobian_rates.unknowns), SMatrix::from(at.jacobian_rates.inputs));
    println!("{:.9}", SMatrix::from(at.jacobians_of_rates.unknowns));
    let largest = at.jacobian_rates.unknowns.largest();
    assert!((at.jacobian_rates.unknowns - at.jacobians_of_rates.unknowns).largest() <= 1e-13 * largest);

    heading("H1, H2, H3, H0; gamma1 by u', gamma2 by v', and gamma0");
    for (name, column) in ["H1", "H2", "H3", "H0"].into_iter().zip(at.terms) {
        println!("  {name:<7} ({:.9}, {:.9})", column[0], column[1]);
    }
    let [by_unknowns, by_inputs, mixed] = at.gamma_parts;
    for (name, column) in [("gamma1", by_unknowns), ("gamma2", by_inputs), ("gamma0", at.gamma)] {
        println!("  {name:<7} ({:.9}, {:.9})", column[0], column[1]);
    }
    assert!(mixed.largest() <= 1e-13 * at.gamma.largest());

    heading("Accelerations by both methods, -J^-1 H0 and W v'' - J^-1 gamma");
    table();
    let [first, second] = at.accelerations;
    for (place, (name, sheet)) in [("alpha3", -259.655_463_7), ("alpha4", 584.710_757_2)].into_iter().enumerate() {
        beside(name, first[place], sheet);
        beside(name, second[place], sheet);
    }
    let difference = second - first;
    println!("  difference of the two methods: ({:.1e}, {:.1e}); it must be zero", difference[0], difference[1]);
    assert!(difference.largest() <= 1e-13 * second.largest());

    let links = links(&at);
    heading("Omega and Alpha of the links 2, 3, 4");
    for (number, link) in (2..).zip(&links) {
        println!("  link {number}{:.9}{:.9}", link.rate_matrix(), link.acceleration_matrix());
    }

    heading("Velocities and accelerations of G2, G3, G4 and C, by the fused kernel");
    table();
    let motion = four_bar.motion(&q, omega2, 0.0)?;
    let points = motion.points;
    on_links(&links, &points);
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

    heading("The properties of the velocity ratios: by W, and without it");
    let properties = ratio_properties(&four_bar, FourBar::DERIVATION, &q, omega2)?;
    for (number, property) in (1..).zip(&properties) {
        print!("{number}. {property}");
    }

    heading("The formulas, line by line, with their numbers");
    let parameters = FourBar::<f64>::PARAMETERS.into_iter().zip(<[f64; 4]>::from(four_bar.clone()));
    let values = Values::of::<FourBar>(FourBar::DERIVATION, parameters, &q, &at);
    println!("{}", text_at(FourBar::SHEET, &values));

    let svg = picture(&four_bar, &points)?;
    let mut sheet = Sheet::new(FourBar::DERIVATION);
    sheet
        .title("The four-bar of the sheet, line by line")
        .by_hand(FourBar::SHEET)
        .at(values)
        .properties(properties)
        .picture(
            svg.clone(),
            "The linkage at 20 degrees, with velocities and accelerations of the middles of its links",
        );
    let mut paths = std::env::args().skip(1);
    let mut path = |default: &str| paths.next().unwrap_or_else(|| default.to_owned());
    let picture = output::write(path("target/maple_sheet.svg"), &svg)?;
    let page = output::write(path("target/maple_sheet.html"), &sheet.to_html())?;
    println!("\nPicture: {picture}, page: {page}");
    Ok(())
}

/// The links 2, 3 and 4 with their rates and accelerations.
fn links(at: &AnalysisOf<FourBar>) -> [Turning; 3] {
    let crank = Turning { rate: at.input_rates[0], acceleration: at.input_accelerations[0] };
    let [_, accelerations] = at.accelerations;
    let of = |place: usize| Turning { rate: at.unknown_rates[place], acceleration: accelerations[place] };
    [crank, of(0), of(1)]
}

/// The motions of points from other points of the same link, by its matrices: PB and PG2 from A, BG3, CG4 and DG4.
fn on_links([crank, coupler, rocker]: &[Turning; 3], points: &FourBarPoints<PointMotion>) {
    let at_rest = PointMotion { position: [0.0; 2].into(), velocity: [0.0; 2].into(), acceleration: [0.0; 2].into() };
    let end = PointMotion { position: [80.0, 0.0].into(), ..at_rest };
    for (name, link, from, to) in [
        ("PB", crank, &at_rest, &points.b),
        ("PG2", crank, &at_rest, &points.g2),
        ("BG3", coupler, &points.b, &points.g3),
        ("BC", coupler, &points.b, &points.c),
        ("CG4", rocker, &points.c, &points.g4),
        ("DG4", rocker, &end, &points.g4),
    ] {
        let arm = to.position - from.position;
        let found = link.point(from, arm);
        let [velocity, acceleration] = [link.relative_velocity(arm), link.relative_acceleration(arm)];
        println!(
            "  {name:<4} r = ({:.9}, {:.9}), Omega r = ({:.9}, {:.9}), (Omega^2 + Alpha) r = ({:.6}, {:.6})",
            arm.x, arm.y, velocity.x, velocity.y, acceleration.x, acceleration.y
        );
        assert!((found.velocity - to.velocity).norm() <= 1e-12 * to.velocity.norm(), "{name}");
        assert!((found.acceleration - to.acceleration).norm() <= 1e-12 * to.acceleration.norm(), "{name}");
    }
}

/// The sheet's picture: velocities green at 0.02, accelerations red at 0.0005.
fn picture(four_bar: &FourBar, points: &FourBarPoints<PointMotion>) -> Result<String, linkage::drawing::DrawingError> {
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
