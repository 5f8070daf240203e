//! The pictures of the manual are those that the library draws. `UPDATE=1` writes them.

use std::f64::consts::TAU;
use std::path::Path;
use std::{env, fs};

use linkage::drawing::{Animation, Drawing};
use linkage::nalgebra::{Point2, Vector2};
use linkage::{Elbow, Slider, linkage};

linkage! {
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point A = (0, 0);
        point B = l2@theta2;
        point C = B + l3@theta3;
        point D = l1@0;
        derive drawing;
    }
    pub mechanism Coupler {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point B = l2@theta2;
        point C = B + l3@theta3;
        point P = B + (l3 / 2, 20)@theta3;
        derive drawing;
    }
    pub mechanism Parallelogram {
        param a = 2, b = 5;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = b@0 + a@psi;
        point A = (0, 0);
        point B = a@theta;
        point C = B + b@phi;
        point D = b@0;
        derive drawing;
    }
    pub mechanism Stretched {
        param l2 = 20, l3 = 50, l4 = 70;
        input theta2, l1;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point A = (0, 0);
        point B = l2@theta2;
        point C = l2@theta2 + l3@theta3;
        point D = l1@0;
    }
    pub mechanism FiveBar {
        param a = 3, b = 4, d = 5;
        input left, right;
        unknown phi, psi;
        loop a@left + b@phi = d@0 + a@right + b@psi;
        point A = (0, 0);
        point B = a@left;
        point P = a@left + b@phi;
        point C = d@0 + a@right;
        point D = d@0;
    }
    pub mechanism Rrr {
        param r = 1, a = 3.2, b = 2.4, d = 3;
        input theta;
        unknown phi, psi;
        loop r@theta + a@phi = d@0 + b@psi;
        point A = r@theta;
        point C = A + a@phi;
        point B = d@0;
        derive drawing;
    }
    pub mechanism Rrp {
        param r = 1, a = 3, tilt = 15deg;
        input theta;
        unknown phi, s;
        loop r@theta + a@phi = s@tilt;
        point A = r@theta;
        point C = A + a@phi;
        derive drawing;
    }
    pub mechanism Rpr {
        param r = 1, d = 2.2;
        input theta;
        unknown phi, s;
        loop r@theta = (0, -d) + s@phi;
        point A = (0, -d);
        point B = r@theta;
        derive drawing;
    }
    pub mechanism Prp {
        param h = 2, tilt = 10deg;
        input theta;
        unknown s, t;
        loop s@theta = (0, h) + t@tilt;
        point C = s@theta;
        derive drawing;
    }
    pub mechanism Rpp {
        param r = 1, slot = 70deg;
        input theta;
        unknown s, t;
        loop r@theta + s@slot = t@0;
        point A = r@theta;
        point Foot = t@0;
    }
}

/// A picture of a page; in rustdoc an empty line would end it.
fn compare(name: &str, svg: &str) {
    compare_text(name, &format!("<div style=\"max-width: 30em\">\n{}\n</div>\n", without_empty_lines(svg)));
}

fn without_empty_lines(svg: &str) -> String {
    svg.lines().filter(|line| !line.trim().is_empty()).collect::<Vec<_>>().join("\n")
}

fn compare_text(name: &str, text: &str) {
    let path = Path::new(linkage_tests::ROOT).join("src/manual").join(name);
    if env::var_os("UPDATE").is_some() {
        fs::write(&path, text).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    assert!(found == text, "{name} is another picture than the library draws: run with UPDATE=1 and look at it");
}

#[test]
fn pictures() {
    let left = FourBarBranch::new(Elbow::Left);
    let m = FourBar::default();
    compare("four_bar.svg", &Drawing::of(&m, &m.assemble(0.9, left).unwrap()).to_svg().unwrap());
    let film = Animation::turn(&Coupler::default(), CouplerBranch::new(Elbow::Left)).unwrap();
    compare("coupler_curve.svg", &film.to_svg().unwrap());

    // The same crank angle beyond the change point: on the branch of the start, and along the motion.
    let m = Parallelogram::default();
    let start = ParallelogramCoordinates { theta: 0.6, phi: 0.0, psi: 0.6 };
    let on_branch = m.assemble(-0.6, m.branch_near(&start)).unwrap();
    let along = m.pose_at(&ParallelogramCoordinates { theta: -0.6, phi: 0.0, psi: -0.6 });
    let mut drawing = Drawing::new("Beyond the change point: on the branch, and along the motion");
    for (offset, end, pose) in [(0.0, "", on_branch), (9.0, "′", along)] {
        let points = m.points(&pose).unwrap();
        let names = ["A", "B", "C", "D"].map(|name| format!("{name}{end}"));
        let at = [points.a, points.b, points.c, points.d].map(|at| [at.x + offset, at.y]);
        drawing.ground(&names[0], at[0]).joint(&names[1], at[1]).joint(&names[2], at[2]).ground(&names[3], at[3]);
        drawing.bar(&names[0], &names[1]).bar(&names[1], &names[2]).bar(&names[2], &names[3]);
    }
    compare("parallelogram.svg", &drawing.to_svg().unwrap());
}

/// The columns of the matrix of a point, and their sum.
#[test]
fn columns_of_a_point() {
    let m = Stretched::default();
    let left = StretchedBranch::new(Elbow::Left);
    let pose = m.assemble(StretchedInputs { theta2: 20_f64.to_radians(), l1: 80.0 }, left).unwrap();
    let (points, of_c) = (m.points(&pose).unwrap(), m.point_ratios(&pose).unwrap().c);
    let mut drawing = Drawing::new("The velocity of C by the crank at 2 rad/s, by the frame at 60 mm/s, and by both");
    drawing.ground("A", points.a).joint("B", points.b).joint("C", points.c).ground("D", points.d);
    drawing.bar("A", "B").bar("B", "C").bar("C", "D").units("mm", "s");
    let columns = [of_c.column(0) * 2.0, of_c.column(1) * 60.0];
    for velocity in [columns[0], columns[1], columns[0] + columns[1]] {
        drawing.velocity("C", velocity);
    }
    compare("velocity_ratios.svg", &drawing.velocity_scale(0.5).to_svg().unwrap());

    let m = FiveBar::default();
    let pose = m.assemble(FiveBarInputs { left: 2.0, right: 1.2 }, FiveBarBranch::new(Elbow::Left)).unwrap();
    let (points, of_p) = (m.points(&pose).unwrap(), m.point_ratios(&pose).unwrap().p);
    let mut drawing = Drawing::new("The velocity of P by the left crank, by the right one, and by both");
    drawing.ground("A", points.a).joint("B", points.b).joint("P", points.p).joint("C", points.c).ground("D", points.d);
    drawing.bar("A", "B").bar("B", "P").bar("P", "C").bar("C", "D");
    for rates in [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        drawing.velocity("P", of_p * Vector2::from(rates));
    }
    compare("two_inputs.svg", &drawing.velocity_scale(0.5).to_svg().unwrap());
}

/// A scotch yoke: its slot is no vector of the loop, so that the drawing cannot know it.
fn yoke() -> Animation {
    let (m, reach) = (Rpp::default(), 1.6);
    let mut film = Animation::new("Rpp", 4.0);
    for step in 0..=120 {
        let pose = m.assemble(TAU * f64::from(step) / 120.0, RppBranch::new()).unwrap();
        let points = m.points(&pose).unwrap();
        let along = Vector2::new(m.slot.cos(), m.slot.sin()) * reach;
        let [below, above] = [points.foot - along, points.foot + along];
        film.frame([
            ("O", Point2::origin()),
            ("A", points.a),
            ("Foot", points.foot),
            ("Below", below),
            ("Above", above),
        ]);
    }
    film.ground("O")
        .crank(&["O", "A"])
        .link(&["Below", "Foot", "Above"])
        .sleeve("A", ["Below", "Above"])
        .slider("Foot");
    film
}

/// A mechanism for each dyad.
#[test]
fn dyads() {
    let far = Slider::Far;
    let films = [
        ("RRR", Animation::turn(&Rrr::default(), RrrBranch::new(Elbow::Left))),
        ("RRP", Animation::turn(&Rrp::default(), RrpBranch::new(far))),
        ("RPR", Animation::turn(&Rpr::default(), RprBranch::new(far))),
        ("PRP", Animation::between(&Prp::default(), PrpBranch::new(), [50_f64, 130.0].map(f64::to_radians))),
        ("RPP", Ok(yoke())),
    ];
    let mut text = String::from("<div style=\"display: flex; flex-wrap: wrap; gap: 1em\">\n");
    for (name, film) in films {
        let svg = without_empty_lines(&film.unwrap().to_svg().unwrap());
        text +=
            &format!("<figure style=\"margin: 0; width: 15em\">\n{svg}\n<figcaption>{name}</figcaption>\n</figure>\n");
    }
    compare_text("assur_groups.svg", &(text + "</div>\n"));
}
