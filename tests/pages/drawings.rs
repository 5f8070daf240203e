//! Still pictures and films of whole machines: one style, the names and paths that the user chooses, vectors and forces to
//! scale. `PICTURES=folder` writes them.

use std::{env, fs};

use linkage::drawing::{Animation, Drawing, DrawingError};
use linkage::nalgebra::Vector2;
use linkage::skeleton::{Part, Skeleton};
use linkage::{Elbow, JointForces, Slider, linkage};
use roxmltree::{Document, Node};

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism FourBar {
        param l1 = 0.08, l2 = 0.02, l3 = 0.05, l4 = 0.07, m2 = 0.1, j2 = 1e-5, m3 = 0.3, j3 = 1e-4, m4 = 0.4, j4 = 2e-4,
            load = 0.5;
        input theta;
        unknown phi, psi;
        loop l2@theta + l3@phi + l4@psi = l1@0;
        point A = (0, 0);
        point B = l2@theta;
        // From the other side of the loop.
        point C = l1@0 - l4@psi;
        point D = l1@0;
        point P = B + (l3 / 2, 0.02)@phi;
        body crank { mass m2; inertia j2; center (0, 0); angle theta; }
        body coupler { mass m3; inertia j3; center P; angle phi; }
        body rocker { mass m4; inertia j4; center D; angle psi; }
        scene Loaded {
            inertia;
            torque load on psi;
            reactions;
        }
        scene Free {
            inertia;
        }
        derive drawing;
    }
    #[derive(Debug, Clone)]
    pub mechanism Wiper {
        param crank = 40, link = 148.5, arm = 50, base = 151.5, span = 400, tilt = 10deg, blade = 450, lead = 20deg,
            from = 150;
        input theta;
        unknown phi, first, rod, second;
        loop crank@theta + link@phi = base@0 + arm@first;
        let pivot = base@0;
        loop pivot + arm@first + span@rod = pivot + span@tilt + arm@second;
        point Motor = (0, 0);
        point First = pivot;
        point Second = First + span@tilt;
        point FirstPin = First + arm@first;
        point FirstTip = First + blade@(first - lead);
        point SecondTip = Second + blade@(second - lead);
        point Inner = Second + from@(second - lead);
        derive drawing;
    }
    /// A slotted lever that drives a ram, with forces in both kinds of guides.
    #[derive(Debug, Clone)]
    pub mechanism Shaper {
        param crank = 0.1, lever = 0.4, rod = 0.12, p = 0.2, height = 0.19, m = 2, j = 0.05, ram = 4, cut = 300;
        input theta;
        unknown psi, s, phi, x;
        let pivot = (0, -p);
        loop crank@theta = pivot + s@psi;
        loop pivot + lever@psi + rod@phi = (x, height);
        point A = crank@theta;
        point Pivot = pivot;
        point Tip = pivot + lever@psi;
        point Ram = (x, height);
        body wheel { mass m; inertia j; center (0, 0); angle theta; }
        body slide { mass ram; center Ram; }
        scene Cutting {
            inertia;
            force (cut, 0) at Ram;
            reactions;
        }
        derive drawing;
    }
    #[derive(Debug, Clone)]
    pub mechanism Jansen {
        param a = 38, b = 41.5, c = 39.3, d = 40.1, e = 55.8, f = 39.4, g = 36.7, h = 65.7, i = 49, j = 50, k = 61.9,
            l = 7.8, m = 15;
        input crank;
        unknown angle_b, angle_j, angle_d, angle_e, angle_c, angle_k, angle_f, angle_g, angle_h, angle_i;
        let pivot = (-a, -l);
        loop m@crank + j@angle_j = pivot + b@angle_b;
        loop pivot + b@angle_b + e@angle_e = pivot + d@angle_d;
        loop m@crank + k@angle_k = pivot + c@angle_c;
        let knee = pivot + c@angle_c;
        loop pivot + d@angle_d + f@angle_f = knee + g@angle_g;
        loop knee + g@angle_g + h@angle_h = knee + i@angle_i;
        point Pivot = pivot;
        point Knee = knee;
        point Foot = knee + i@angle_i;
        derive drawing;
    }
    /// Boom, stick and bucket of an excavator on two cylinders.
    #[derive(Debug, Clone)]
    pub mechanism Excavator {
        param boom = 5.2, stick = 2.6, bucket = 1.4, lug = 2.4, back = 0.9, foot = 0.8, seat = 2.8;
        input lift, crowd;
        unknown alpha, beta, ram, push;
        loop (foot, -0.4) + lift@ram = lug@alpha;
        loop (seat, 0.9)@alpha + crowd@push = boom@alpha - back@(alpha + beta);
        point Elbow = boom@alpha;
        point Wrist = Elbow + stick@(alpha + beta);
        point Teeth = Wrist + bucket@(alpha + beta - 60deg);
        derive drawing;
    }
}

fn four_bar() -> (FourBar, FourBarBranch) {
    (FourBar::default(), FourBarBranch::new(Elbow::Left))
}

fn shaper() -> ShaperBranch {
    ShaperBranch::new(Slider::Far, Slider::Far)
}

/// Writes the picture if asked.
fn show(name: &str, svg: &str) {
    if let Some(folder) = env::var_os("PICTURES") {
        fs::write(std::path::Path::new(&folder).join(name).with_extension("svg"), svg).unwrap();
    }
}

fn elements<'a>(svg: &'a Document, class: &str) -> Vec<Node<'a, 'a>> {
    svg.descendants().filter(|node| node.attribute("class") == Some(class)).collect()
}

fn number(node: Node, name: &str) -> f64 {
    node.attribute(name).unwrap().parse().unwrap()
}

fn ends(line: Node) -> [Vector2<f64>; 2] {
    [["x1", "y1"], ["x2", "y2"]].map(|names| Vector2::from(names.map(|name| number(line, name))))
}

/// The arrows of a kind, without those of the legend.
fn arrows(svg: &Document, kind: &str) -> Vec<[Vector2<f64>; 2]> {
    let groups = elements(svg, kind);
    groups
        .into_iter()
        .filter_map(|group| group.children().find(|child| child.attribute("class") == Some("vector")))
        .map(ends)
        .collect()
}

/// The place of a joint or point by its name.
fn place(svg: &Document, name: &str) -> Vector2<f64> {
    let named = |node: &Node| node.children().any(|child| child.text().map(str::trim) == Some(name));
    let group = svg.descendants().filter(|node| node.attribute("transform").is_some()).find(named).unwrap();
    let text = group.attribute("transform").unwrap().trim_start_matches("translate(").trim_end_matches(')');
    Vector2::from_iterator(text.split(' ').map(|number| number.parse().unwrap()))
}

/// The classes of all shapes in order; those of a frame that is at rest, in a film.
fn classes(svg: &str) -> Vec<String> {
    let svg = Document::parse(svg).unwrap();
    let skipped = |node: &Node| node.ancestors().any(|node| node.attribute("class") == Some("moving"));
    let of_plot = ["grid", "frame", "tick", "title", "curve", "arrow", "head", "paper"];
    let all = svg.descendants().filter(|node| !skipped(node)).filter_map(|node| node.attribute("class"));
    all.filter(|class| !of_plot.contains(class)).map(str::to_owned).collect()
}

/// Still and film agree in shapes, their order, their colours, and the style sheet.
fn one_style<M: Skeleton<Scalar = f64, Name = &'static str>>(m: &M, poses: &[M::Pose]) {
    let (still, film) = (Drawing::of(m, &poses[0]).to_svg().unwrap(), Animation::of(m, poses, 4.0).to_svg().unwrap());
    assert_eq!(
        classes(&still),
        classes(&film).into_iter().filter(|class| class != "still").collect::<Vec<_>>(),
        "{}",
        M::NAME
    );
    let style = |svg: &str| {
        let svg = Document::parse(svg).unwrap();
        svg.descendants()
            .find(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "style")))
            .unwrap()
            .text()
            .unwrap()
            .to_owned()
    };
    assert!(style(&still).trim().starts_with(style(&film).trim()), "{}", M::NAME);
    show(&format!("{}_still", M::NAME), &still);
    show(&format!("{}_film", M::NAME), &film);
}

fn turn<M, P>(position: impl Fn(f64) -> P, _: &M) -> Vec<P> {
    (0..=72).map(|step| position(f64::from(step * 5).to_radians())).collect()
}

#[test]
fn still_and_film_have_one_style() {
    let (m, branch) = four_bar();
    one_style(&m, &turn(|theta| m.assemble(theta, branch).unwrap(), &m));
    let m = Shaper::default();
    one_style(&m, &turn(|theta| m.assemble(theta, shaper()).unwrap(), &m));
    let m = Wiper::default();
    let branch = WiperBranch::new(Elbow::Right, Elbow::Left);
    one_style(&m, &turn(|theta| m.assemble(theta, branch).unwrap(), &m));
    let m = Jansen::default();
    let [left, right] = [Elbow::Left, Elbow::Right];
    let branch = JansenBranch::new(left, left, right, right, right);
    one_style(&m, &turn(|crank| m.assemble(crank, branch).unwrap(), &m));
    let m = Excavator::default();
    let branch =
        m.branch_near(&ExcavatorCoordinates { lift: 2.0, crowd: 2.2, alpha: 0.5, beta: -1.4, ram: 0.9, push: 0.5 });
    let pose = |step: u32| {
        let along = (f64::from(step) * 5.0).to_radians().sin();
        m.assemble(ExcavatorInputs { lift: 2.0 + 0.2 * along, crowd: 2.2 + 0.2 * along }, branch).unwrap()
    };
    one_style(&m, &(0..=72).map(pose).collect::<Vec<_>>());
}

/// The rigid triangles of Jansen's leg are plates: so are links with a point off their line.
#[test]
fn links_of_three_joints_are_plates() {
    let plates = |parts: &[Part]| {
        parts.iter().filter(|part| matches!(part, Part::Bar { joints, .. } if joints.len() > 2)).count()
    };
    assert_eq!(plates(Jansen::<f64>::PARTS), 2);
    assert_eq!(plates(FourBar::<f64>::PARTS), 1);
    assert_eq!(plates(Wiper::<f64>::PARTS), 2);
}

/// `C` is written from the other side of the loop: it names the joint of coupler and rocker.
#[test]
fn a_point_names_the_joint_with_which_it_coincides() {
    assert_eq!(FourBar::<f64>::JOINTS, ["A", "B", "C", "D", "P"]);
    let tips = |parts: &[Part], joints: &[&'static str]| -> Vec<&'static str> {
        parts
            .iter()
            .filter_map(|part| if let Part::Trace(joint) = part { Some(joints[*joint]) } else { None })
            .collect()
    };
    assert_eq!(tips(FourBar::<f64>::PARTS, FourBar::<f64>::JOINTS), ["P"]);
    assert_eq!(tips(Wiper::<f64>::PARTS, Wiper::<f64>::JOINTS), ["FirstTip", "SecondTip", "Inner"]);
    assert_eq!(tips(Excavator::<f64>::PARTS, Excavator::<f64>::JOINTS), ["Wrist", "Teeth"]);
    assert!(tips(Shaper::<f64>::PARTS, Shaper::<f64>::JOINTS).is_empty());
}

#[test]
fn pivots_have_the_names_that_the_user_gives() {
    let (m, branch) = four_bar();
    let pose = m.assemble(0.9, branch).unwrap();
    let motion = m.full_kinematics(0.9, branch, 10.0, 0.0).unwrap();
    let mut drawing = Drawing::of(&m, &pose);
    // The arrows before and after a change of the name are at one point.
    drawing.velocity("B", [1.0, 0.0]).rename("B", "Pin").velocities(&m, &motion.points).without(&["B"]);
    assert_eq!(drawing.to_svg(), Err(DrawingError::UnknownJoint { name: "B".to_owned(), nearest: None }));
    let mut drawing = Drawing::of(&m, &pose);
    drawing.velocity("B", [1.0, 0.0]).rename("B", "Pin").rename("A", "B").velocities(&m, &motion.points);
    let svg = drawing.to_svg().unwrap();
    let svg = Document::parse(&svg).unwrap();
    let at = |ends: &[Vector2<f64>; 2]| (ends[0] - place(&svg, "Pin")).norm() < 0.2;
    assert_eq!(arrows(&svg, "velocity").iter().filter(|ends| at(ends)).count(), 2);
    let mut film = Animation::turn(&m, branch).unwrap();
    film.rename("D", "Rocker pivot").paths(&["P", "C"]);
    let svg = film.to_svg().unwrap();
    assert!(svg.contains("Rocker pivot") && svg.contains("with the path of P and of C"));
}

/// By default the tips, in a still those of a film.
#[test]
fn tips_leave_paths() {
    let m = Wiper::default();
    let branch = WiperBranch::new(Elbow::Right, Elbow::Left);
    let mut film = Animation::turn(&m, branch).unwrap();
    let curves = |svg: &str| svg.matches("class=\"curve\"").count();
    assert_eq!(curves(&film.to_svg().unwrap()), 3);
    film.paths(&["SecondTip", "Inner"]);
    assert_eq!(curves(&film.to_svg().unwrap()), 2);
    let mut drawing = Drawing::of(&m, &m.assemble(0.7, branch).unwrap());
    assert_eq!(curves(&drawing.to_svg().unwrap()), 0);
    let svg = drawing.paths(&film).to_svg().unwrap();
    assert_eq!(curves(&svg), 2);
    show("wiper_paths", &svg);
    assert_eq!(curves(&film.paths(&[]).to_svg().unwrap()), 0);
}

/// The scale is round, and the longest arrow between an eighth and a half of the linkage.
#[test]
fn all_velocities_and_accelerations_in_one_call() {
    let (m, branch) = four_bar();
    let motion = m.full_kinematics(0.9, branch, 20.0, 5.0).unwrap();
    let mut drawing = Drawing::of(&m, &motion.pose);
    drawing.velocities(&m, &motion.points).accelerations(&m, &motion.points).units("m", "s");
    let text = drawing.to_svg().unwrap();
    show("vectors", &text);
    let svg = Document::parse(&text).unwrap();
    let pixels = (place(&svg, "D") - place(&svg, "A")).norm() / m.l1;
    for (kind, vectors) in [
        ("velocity", [motion.points.b.velocity, motion.points.c.velocity, motion.points.p.velocity]),
        ("acceleration", [motion.points.b.acceleration, motion.points.c.acceleration, motion.points.p.acceleration]),
    ] {
        let arrows = arrows(&svg, kind);
        assert_eq!(arrows.len(), 3, "not of pivots at rest: {text}");
        let drawn = arrows.iter().map(|[from, to]| to - from).collect::<Vec<_>>();
        let scale = drawn[0].norm() / vectors[0].norm();
        let legend =
            elements(&svg, "tick").into_iter().filter_map(|node| node.text()).find(|text| text.contains(kind)).unwrap();
        let written: f64 = legend.split_whitespace().nth(2).unwrap().parse().unwrap();
        assert!((written * pixels / scale - 1.0).abs() < 0.01, "{legend} {scale} {pixels}");
        for (drawn, vector) in drawn.iter().zip(vectors) {
            // To a tenth of a pixel.
            assert!((drawn - Vector2::new(vector.x, -vector.y) * written * pixels).norm() < 0.01 * drawn.norm() + 0.1);
        }
        let longest = drawn.iter().map(Vector2::norm).fold(0.0, f64::max) / (pixels * m.l1);
        assert!((0.125..0.5).contains(&longest), "{longest}");
    }
}

/// The arrows are the forces of the scene, at the pins and guides.
#[test]
fn forces_in_joints() {
    let (m, branch) = four_bar();
    let scene = Loaded { mechanism: m.clone(), ..Loaded::default() };
    let pose = m.assemble(0.9, branch).unwrap();
    let joints = scene.reactions(0.0, &pose.coordinates(), 30.0).unwrap();
    let mut drawing = Drawing::of(&m, &pose);
    let text = drawing.forces(&m, &pose, &joints).units("m", "s").force_unit("N").to_svg().unwrap();
    show("forces", &text);
    let svg = Document::parse(&text).unwrap();
    let found = arrows(&svg, "force");
    // Two pins on the ground, and two between links without a load.
    assert_eq!(found.len(), 4, "{text}");
    let pixels = (place(&svg, "D") - place(&svg, "A")).norm() / m.l1;
    let legend =
        elements(&svg, "tick").into_iter().filter_map(|node| node.text()).find(|text| text.contains("force")).unwrap();
    assert!(legend.trim().ends_with("m/N"), "{legend}");
    let scale: f64 = legend.split_whitespace().nth(2).unwrap().parse().unwrap();
    for (name, force) in
        [("A", joints.a_on_crank), ("B", joints.b_on_crank), ("C", joints.c_on_coupler), ("D", joints.d_on_rocker)]
    {
        let at = place(&svg, name);
        let near =
            found.iter().find(|ends| (ends[0] - at).norm() < 0.2).unwrap_or_else(|| panic!("no force at {name}"));
        let drawn = (near[1] - near[0]) / (scale * pixels);
        let drawn = Vector2::new(drawn.x, -drawn.y);
        // Of two opposite forces in a pin either is drawn.
        let error = (drawn - force).norm().min((drawn + force).norm());
        assert!(error < 0.02 * force.norm() + 0.1 / (scale * pixels), "{name}: {drawn} {force}");
    }
    assert!(!LoadedReactions::<f64>::JOINTS.is_empty());

    let m = Shaper::default();
    let scene = Cutting { mechanism: m.clone(), ..Cutting::default() };
    let pose = m.assemble(0.8, shaper()).unwrap();
    let joints = scene.reactions(0.0, &pose.coordinates(), 5.0).unwrap();
    let mut drawing = Drawing::of(&m, &pose);
    let text = drawing.forces(&m, &pose, &joints).to_svg().unwrap();
    show("forces_shaper", &text);
    let svg = Document::parse(&text).unwrap();
    let across = place(&svg, "A") - place(&svg, "Pivot");
    let at = |name: &str| {
        let at = place(&svg, name);
        arrows(&svg, "force")
            .into_iter()
            .filter(|ends| (ends[0] - at).norm() < 0.2)
            .map(|[from, to]| to - from)
            .collect::<Vec<_>>()
    };
    // The lever pushes the block across itself; the guide pushes the ram up or down.
    assert!(at("A").iter().any(|force| force.dot(&across).abs() < 0.01 * force.norm() * across.norm()), "{text}");
    assert!(at("Ram").iter().any(|force| force.x.abs() < 0.01 * force.norm()), "{text}");
}

#[test]
fn mistakes_are_named() {
    let (m, branch) = four_bar();
    let pose = m.assemble(0.9, branch).unwrap();
    let unknown = |name: &str, nearest: &str| {
        Err(DrawingError::UnknownJoint { name: name.to_owned(), nearest: Some(nearest.to_owned()) })
    };
    let film = || Animation::turn(&m, branch).unwrap();
    assert_eq!(Drawing::of(&m, &pose).rename("b", "O2").to_svg(), unknown("b", "B"));
    assert_eq!(film().rename("b", "O2").to_svg(), unknown("b", "B"));
    assert_eq!(film().paths(&["P1"]).to_svg(), unknown("P1", "P"));
    assert_eq!(film().without(&["A", "C"]).to_svg(), Err(DrawingError::NoPart(vec!["A".to_owned(), "C".to_owned()])));
    assert_eq!(film().without(&[]).to_svg(), Err(DrawingError::NoPart(Vec::new())));
    // A name that is near to none has no guess.
    let nothing_near = Err(DrawingError::UnknownJoint { name: "Q".to_owned(), nearest: None });
    assert_eq!(Drawing::of(&m, &pose).without(&["A", "Q"]).to_svg(), nothing_near);
    // The first mistake is reported.
    assert_eq!(film().rename("b", "c").without(&["Q"]).to_svg(), unknown("b", "B"));
    assert_eq!(Drawing::of(&m, &pose).rename("A", "B").to_svg(), Err(DrawingError::DuplicatePoint("B".to_owned())));
    let error = unknown("b", "B").unwrap_err().to_string();
    assert_eq!(error, "the drawing has no joint or point `b`: is it `B`?");
    let error = DrawingError::NoPart(vec!["A".to_owned(), "C".to_owned()]).to_string();
    assert_eq!(error, "no part connects exactly the points `A`, `C`: name all points of a part");
    let error = Drawing::of(&m, &pose).force("A", [f64::NAN, 0.0]).to_svg();
    assert_eq!(error, Err(DrawingError::NotFinite("a vector at `A`".to_owned())));
    assert_eq!(Drawing::of(&m, &pose).force("X", [1.0, 0.0]).to_svg(), Err(DrawingError::UnknownPoint("X".to_owned())));
}
