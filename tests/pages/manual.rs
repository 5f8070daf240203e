//! The pictures of the manual are those that the library draws. `UPDATE=1` writes them.

use std::f64::consts::TAU;
use std::path::Path;
use std::{env, fs};

use linkage::chart::{Chart, Polar};
use linkage::circuits::{CircuitOptions, Circuits};
use linkage::drawing::{Animation, CircuitChart, Drawing};
use linkage::nalgebra::{Point2, Vector2};
use linkage::table::Units;
use linkage::{Elbow, Slider, Table, linkage};

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
    pub mechanism Engine {
        param crank = 1, rod = 3;
        input phi;
        unknown psi, stroke;
        loop crank@phi + rod@psi = stroke@0;
        derive drawing;
    }
    pub mechanism DoubleRocker {
        param ground = 4, crank = 3, coupler = 1, rocker = 3.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        derive drawing;
    }
    pub mechanism Swing {
        param l1 = 0.8, l2 = 0.2, l3 = 0.5, l4 = 0.7;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 = l1@0 + l4@theta4;
        point G3 = l2@theta2 + (l3/2)@theta3;
        point G4 = l1@0 + (l4/2)@theta4;
        derive drawing;
    }
    pub mechanism SlottedLever {
        param crank = 50, offset = 120, lever = 300, rod = 100, height = 166;
        input theta;
        unknown psi, s, phi, x;
        loop crank@theta = (0, -offset) + s@psi;
        loop (0, -offset) + lever@psi + rod@phi = (x, height);
        derive drawing;
    }
    pub mechanism Suspension {
        param lower = 0.36, upper = 0.25, upright = 0.25, inward = 0.07, height = 0.2;
        param out = 0.12, down = 0.11;
        input alpha;
        unknown gamma, beta;
        loop lower@alpha + upright@gamma = (inward, height) + upper@beta;
        point Inner = (inward, height);
        point Ball = lower@alpha;
        point Top = Ball + upright@gamma;
        point Contact = Ball + (-down, -out)@gamma;
        derive drawing;
    }
    pub mechanism Gripper {
        param pivot = 30, lever = 25, rod = 32, finger = 60;
        input s;
        unknown phi, psi;
        loop (s, 0) + rod@phi = (0, pivot) + lever@psi;
        point Pin = (s, 0) + rod@phi;
        point Pivot = (0, pivot);
        point Tip = Pivot + finger@(psi + 90deg);
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
    pub mechanism Wiper {
        param crank = 0.05, rod = 0.24, rocker = 0.07, frame = 0.25;
        param lean = -17deg, inner = 0.25, outer = 0.65;
        param j2 = 2e-4, m3 = 0.12, j3 = 6e-4, m4 = 0.55, j4 = 0.025, c4 = 0.36;
        param mu = 0.12, pin = 0.006, wet = 0.4, load = 7, g = 8;
        input theta;
        unknown phi, psi;
        loop crank@theta + rod@phi = frame@0 + rocker@psi;
        point Motor = (0, 0);
        point A = crank@theta;
        point B = A + rod@phi;
        point Pivot = (frame, 0);
        point Inner = Pivot + inner@(psi + lean);
        point Outer = Pivot + outer@(psi + lean);
        output arm = psi + lean;

        body wheel { inertia j2; angle theta; }
        body link { mass m3; inertia j3; center A + (rod / 2)@phi; angle phi; }
        body blade { mass m4; inertia j4; center Pivot + c4@(psi + lean); angle psi; }
        scene Wiping {
            inertia;
            gravity (0, -g);
            friction mu, pin, reaction on theta;
            friction mu, pin, reaction on theta - phi;
            friction mu, pin, reaction on phi - psi;
            friction mu, pin, reaction on psi;
            friction wet, (inner + outer) / 2, load on psi;
            reactions;
        }
        derive drawing;
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

/// The mechanisms that pages of the manual speak of, each as its page defines it.
#[test]
fn mechanisms_of_pages() {
    let film = Animation::turn(&Engine::default(), EngineBranch::new(Slider::Far)).unwrap();
    compare("dead_points.svg", &film.to_svg().unwrap());

    let m = DoubleRocker::default();
    let both = Circuits::over(&m, [0.8, -0.8], CircuitOptions::default()).unwrap();
    compare("circuits.svg", &CircuitChart::of(&m, &both, "psi").unwrap().to_svg());

    let m = Swing::default();
    compare(
        "first_simulation.svg",
        &Drawing::of(&m, &m.assemble(1.0, SwingBranch::new(Elbow::Left)).unwrap()).to_svg().unwrap(),
    );

    let m = SlottedLever::default();
    let branch = m.branches(1.0).unwrap().next().unwrap().branch;
    compare("first_report.svg", &Animation::turn(&m, branch).unwrap().to_svg().unwrap());

    let m = Suspension::default();
    let branch = SuspensionBranch::new(Elbow::Right);
    let suspension = Animation::between(&m, branch, [-0.2, 0.2]);
    let gripper = Animation::between(&Gripper::default(), GripperBranch::new(Elbow::Left), [-26.0, -14.0]);
    let films = [("A suspension", suspension), ("A finger of a gripper", gripper)];
    compare_text("recipes.svg", &row_of_figures(films.map(|(name, film)| (name, film.unwrap().to_svg().unwrap()))));
}

/// The wiper of the page on torque: its film, the torque of its motor over a turn, and the load of a pin.
#[test]
fn torque_over_a_turn() {
    let (scene, left) = (Wiping::default(), WiperBranch::new(Elbow::Left));
    let film = Animation::turn(&scene.mechanism, left).unwrap().paths(&["Inner", "Outer"]).to_svg().unwrap();
    let table = Table::turn_with_loads(&scene, left, 360, TAU).unwrap().degrees().units(Units::SI);
    let torque = Chart::of(&table, "theta", ["theta_torque"]).unwrap().to_svg();
    let pin = Polar::of(&table, "a_on_link_x", "a_on_link_y").unwrap().to_svg();
    let figures =
        [("The wiper", film), ("The torque of the motor", torque), ("The force in the pin A on the rod", pin)];
    compare_text("torque.svg", &row_of_figures(figures));
}

/// The pitch curve of the cam of the page on laws, and its follower.
#[test]
fn cam() {
    let (radius, height, rise) = (40.0, 20.0, 2.0 * TAU / 3.0);
    let mut film = Animation::new("Cam", 4.0);
    // The rise of the page, a return like it, and a dwell in between.
    let cycloid = |part: f64| part - (TAU * part).sin() / TAU;
    let lift = |phi: f64| {
        let phi = phi.rem_euclid(TAU);
        let part = if phi < TAU / 2.0 { phi / (rise / 2.0) } else { (TAU - phi) / (rise / 2.0) };
        radius + height * cycloid(part.min(1.0))
    };
    for step in 0..=120 {
        let phi = TAU * f64::from(step) / 120.0;
        let mark = Point2::new(10.0 * phi.cos(), 10.0 * phi.sin());
        film.frame([("O", Point2::origin()), ("Mark", mark), ("Pitch", Point2::new(0.0, lift(phi)))]);
    }
    let outline = (0..120).map(|step| {
        let angle = TAU * f64::from(step) / 120.0;
        // In the axes of the cam, which turns by phi: the follower is above its centre.
        Vector2::new(angle.cos(), angle.sin()) * lift(TAU / 4.0 - angle)
    });
    film.ground("O").plate("O", "Mark", outline).slider("Pitch");
    compare("cam_laws.svg", &film.to_svg().unwrap());
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
    let figures = films.map(|(name, film)| (name, film.unwrap().to_svg().unwrap()));
    compare_text("assur_groups.svg", &row_of_figures(figures));
}

/// Pictures side by side, each with its name below.
fn row_of_figures<const N: usize>(figures: [(&str, String); N]) -> String {
    let mut text = String::from("<div style=\"display: flex; flex-wrap: wrap; gap: 1em\">\n");
    for (name, svg) in figures {
        let svg = without_empty_lines(&svg);
        text +=
            &format!("<figure style=\"margin: 0; width: 15em\">\n{svg}\n<figcaption>{name}</figcaption>\n</figure>\n");
    }
    text + "</div>\n"
}
