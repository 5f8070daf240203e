//! The pictures of the manual are those that the library draws. `UPDATE=1` writes them.

use std::path::Path;
use std::{env, fs};

use linkage::drawing::{Animation, Drawing};
use linkage::{Elbow, linkage};

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
}

/// In a page of rustdoc an empty line would end the picture.
fn compare(name: &str, svg: &str) {
    let lines: Vec<&str> = svg.lines().filter(|line| !line.trim().is_empty()).collect();
    let text = format!("<div style=\"max-width: 30em\">\n{}\n</div>\n", lines.join("\n"));
    let path = Path::new(linkage_tests::ROOT).join("src/manual").join(name);
    if env::var_os("UPDATE").is_some() {
        fs::write(&path, &text).unwrap();
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
