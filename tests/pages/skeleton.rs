//! Drawings from the mechanism itself: the joints and parts that the macro finds in loops and points.

use linkage::drawing::{Animation, Drawing, DrawingError};
use linkage::skeleton::{Part, Skeleton};
use linkage::{Elbow, Slider, linkage};

linkage! {
    /// A four-bar with a point off its coupler, and one on it.
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point B = l2@theta2;
        point C = B + l3@theta3;
        point P = B + (l3 / 2, 20)@theta3;
        point G = C - (l3 / 2)@theta3;
        derive drawing;
    }
    /// A double rocker: its input has limits.
    pub mechanism Rocker {
        param l1 = 80, l2 = 60, l3 = 50, l4 = 40;
        input theta2;
        unknown theta3, theta4;
        let arm = l3@theta3 + l4@theta4;
        loop arm = l1@0 - l2@theta2;
        point D = (l1, 0);
        derive drawing;
    }
    /// A shaper: a block on a lever, a rod, and a ram on a guide. The lever is written from the pivot.
    pub mechanism Shaper {
        param crank = 1, lever = 4, rod = 1.2, p = 2, height = 1.9;
        input theta;
        unknown psi, s, phi, x;
        point Pivot = (0, -p);
        loop crank@theta = Pivot + s@psi;
        loop Pivot + lever@psi + rod@phi = (x, height);
        point A = crank@theta;
        point Tip = Pivot + lever@psi;
        point Ram = (x, height);
        derive drawing;
    }
    /// A four-bar with the frame on the side of its links.
    pub mechanism Closed {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 - l1@0 = 0;
        derive drawing;
    }
    /// An arm through a block on a crank: the arm has no other joint.
    pub mechanism Inverted {
        param a = 1, d = 2.5;
        input theta;
        unknown phi, b;
        loop a@theta = d@0 + b@phi;
        derive drawing;
    }
    /// An arm whose end is a point too.
    pub mechanism Arm {
        param h = 2, tilt = 10deg;
        input theta;
        unknown s, t;
        loop s@theta = (0, h) + t@tilt;
        point Block = s@theta;
        derive drawing;
    }
    /// Two inputs.
    pub mechanism FiveBar {
        param a = 3, b = 4, d = 5;
        input left, right;
        unknown phi, psi;
        loop a@left + b@phi = d@0 + a@right + b@psi;
        derive drawing;
    }
}

/// The parts with the names of their joints.
fn parts<M: Skeleton>() -> Vec<String> {
    let name = |joint: usize| M::JOINTS[joint];
    let parts = M::PARTS.iter().map(|part| match *part {
        Part::Ground(joint) => format!("ground {}", name(joint)),
        Part::Slider(joint) => format!("slider {}", name(joint)),
        Part::Trace(joint) => format!("trace {}", name(joint)),
        Part::Bar { joints, is_driven } => {
            let names: Vec<&str> = joints.iter().map(|&joint| name(joint)).collect();
            format!("{} {}", if is_driven { "crank" } else { "bar" }, names.join("-"))
        }
        Part::Sleeve { pin, on, towards } => {
            format!(
                "sleeve {} on {}{}",
                name(pin),
                name(on),
                towards.map_or_else(String::new, |end| format!("-{}", name(end)))
            )
        }
        _ => unreachable!(),
    });
    parts.collect()
}

#[test]
fn loops_and_points_become_parts() {
    let mut found = parts::<FourBar>();
    found.sort_unstable();
    assert_eq!(found, ["bar 1-C", "bar B-C-P-G", "crank O-B", "ground 1", "ground O", "trace G", "trace P"]);
    let mut found = parts::<Rocker>();
    found.sort_unstable();
    assert_eq!(found, ["bar 1-2", "bar O-1", "crank D-2", "ground D", "ground O"]);
    let mut found = parts::<Closed>();
    found.sort_unstable();
    assert_eq!(found, ["bar 1-2", "bar 3-2", "crank O-1", "ground 3", "ground O"]);
    let mut found = parts::<Shaper>();
    found.sort_unstable();
    assert_eq!(
        found,
        [
            "bar Pivot-Tip",
            "bar Tip-Ram",
            "crank O-A",
            "ground O",
            "ground Pivot",
            "sleeve A on Pivot-Tip",
            "slider Ram"
        ]
    );
    let mut found = parts::<Inverted>();
    found.sort_unstable();
    assert_eq!(found, ["crank O-1", "ground 2", "ground O", "sleeve 1 on 2"]);
    let mut found = parts::<FiveBar>();
    found.sort_unstable();
    assert_eq!(found, ["bar 1-2", "bar 2-4", "crank 3-4", "crank O-1", "ground 3", "ground O"]);
}

/// A vector of a loop and of a point is drawn once.
#[test]
fn a_vector_is_one_part() {
    assert_eq!(parts::<Arm>(), ["ground O", "sleeve Block on O", "slider Block"]);
    Animation::between(&Arm::default(), ArmBranch::new(), [1.0, 2.0]).unwrap().to_svg().unwrap();
}

#[test]
fn joints_are_where_the_points_are() {
    let m = FourBar::default();
    for degrees in (0..360).step_by(20) {
        let pose = m.assemble(f64::from(degrees).to_radians(), FourBarBranch::new(Elbow::Left)).unwrap();
        let (points, joints) = (m.points(&pose).unwrap(), Skeleton::joints(&m, &pose));
        let named = [("B", points.b), ("C", points.c), ("P", points.p), ("G", points.g)];
        for (name, at) in named {
            let place = FourBar::<f64>::JOINTS.iter().position(|joint| *joint == name).unwrap();
            assert_eq!([joints[2 * place], joints[2 * place + 1]].map(f64::to_bits), [at.x, at.y].map(f64::to_bits));
        }
    }
}

/// The frames are checked by the picture: a link that changed its shape, a pivot that moved or a block that left its
/// guide would be an error.
#[test]
fn a_turn_in_one_call() {
    let branch = FourBarBranch::new(Elbow::Left);
    let svg = Animation::turn(&FourBar::default(), branch).unwrap().to_svg().unwrap();
    assert_eq!(svg.matches("class=\"curve\"").count(), 2, "the paths of P and G");
    Animation::turn(&Shaper::default(), ShaperBranch::new(Slider::Far, Slider::Far)).unwrap().to_svg().unwrap();
    Animation::turn(&Inverted::default(), InvertedBranch::new(Slider::Far)).unwrap().to_svg().unwrap();
    // The rocker turns between its limits and back: |B D| = l3 + l4 there, and C is on the line.
    let m = Rocker::default();
    let svg = Animation::turn(&m, RockerBranch::new(Elbow::Left)).unwrap().to_svg().unwrap();
    assert!(svg.contains("animateTransform"));
    Animation::between(&m, RockerBranch::new(Elbow::Left), [1.0, 1.3]).unwrap().to_svg().unwrap();
}

#[test]
fn parts_can_be_drawn_otherwise() {
    let branch = FourBarBranch::new(Elbow::Left);
    let mut film = Animation::turn(&FourBar::default(), branch).unwrap();
    let whole = film.to_svg().unwrap();
    film.without(&["G"]).without(&["C", "1"]).spring("C", "1");
    let other = film.to_svg().unwrap();
    assert_eq!(other.matches("class=\"curve\"").count(), whole.matches("class=\"curve\"").count() - 1);
    assert_eq!(other.matches("class=\"link\"").count() + 2, whole.matches("class=\"link\"").count());
    let m = FourBar::default();
    let pose = m.assemble(0.6, branch).unwrap();
    let mut drawing = Drawing::of(&m, &pose);
    let svg = drawing.velocity("C", [1.0, 2.0]).to_svg().unwrap();
    let svg = roxmltree::Document::parse(&svg).unwrap();
    let texts: Vec<&str> = svg.descendants().filter_map(|node| node.text().map(str::trim)).collect();
    assert!(["FourBar", "B", "C", "P", "G", "O", "1"].iter().all(|name| texts.contains(name)), "{texts:?}");
}

#[test]
fn what_cannot_be_drawn() {
    // Not even the longest stretch exists.
    let m = FourBar { l1: 500.0, ..FourBar::default() };
    let error = Animation::turn(&m, FourBarBranch::new(Elbow::Left)).unwrap_err();
    assert!(matches!(&error, DrawingError::NoPosition(why) if why.contains("theta3, theta4")), "{error}");
    let error = Animation::between(&Rocker::default(), RockerBranch::new(Elbow::Left), [1.0, 3.0]).unwrap_err();
    assert!(matches!(error, DrawingError::NoPosition(_)), "{error}");
    let error = Animation::between(&Rocker::default(), RockerBranch::new(Elbow::Left), [1.0, 1.0]).unwrap_err();
    assert!(matches!(error, DrawingError::NoPosition(_)), "{error}");
    let m = FourBar { l2: f64::NAN, ..FourBar::default() };
    assert!(Animation::turn(&m, FourBarBranch::new(Elbow::Left)).is_err());
}
