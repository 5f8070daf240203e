//! Animated pictures: each frame against the positions, and the errors for invalid input.

use linkage::Elbow::Left;
use linkage::Slider::Far;
use linkage::drawing::{Animation, DrawingError};
use linkage::nalgebra::{Point2, Rotation2, Vector2, point, vector};
use roxmltree::{Document, Node};

use linkage_gallery::four_bar::*;
use linkage_gallery::offset_slider_crank::*;

const STEPS: u32 = 72;

/// Half a tenth of a pixel, to which numbers of the picture are written, and half a hundredth of a degree, the digits
/// of angles, at the end of a link of 400 pixels.
const WRITTEN: f64 = 0.05 + 0.005 * 400.0 * std::f64::consts::PI / 180.0 + 0.05;

type Frame = Vec<(&'static str, Point2<f64>)>;

/// A full turn of the four-bar, its lengths divided by `unit`.
fn four_bar(scale: f64) -> Vec<Frame> {
    let m = FourBar::<f64>::default().map(|length| length * scale);
    let frame = |step: u32| {
        let theta2 = f64::from(step * 360 / STEPS).to_radians();
        let points = m.points(&m.assemble(theta2, FourBarBranch::new(Left)).unwrap()).unwrap();
        vec![("A", point![0.0, 0.0]), ("B", points.b), ("C", points.c), ("D", point![m.l1, 0.0]), ("G3", points.g3)]
    };
    (0..=STEPS).map(frame).collect()
}

fn animation(title: &str, frames: &[Frame]) -> Animation {
    let mut picture = Animation::new(title, 6.0);
    for frame in frames {
        picture.frame(frame.iter().copied());
    }
    picture
}

fn picture_of_the_four_bar(scale: f64) -> Animation {
    let mut picture = animation("Four-bar", &four_bar(scale));
    picture.crank(&["A", "B"]).link(&["B", "C", "G3"]).link(&["D", "C"]).ground("A").ground("D").trace("G3");
    picture
}

fn numbers(text: &str) -> Vec<f64> {
    text.split([' ', ',']).map(|number| number.parse().unwrap_or_else(|_| panic!("{number} in {text}"))).collect()
}

/// The arguments of `transform="kind(…)"`.
fn transform(node: Node, kind: &str) -> Vec<f64> {
    let text = node.attribute("transform").unwrap();
    numbers(text.strip_prefix(kind).and_then(|rest| rest.strip_prefix('(')?.strip_suffix(')')).unwrap())
}

/// The values of one kind of animation of a group itself; none at rest.
fn values(group: Node, kind: &str) -> Option<Vec<Vec<f64>>> {
    let animation = group
        .children()
        .find(|child| child.has_tag_name(tag("animateTransform")) && child.attribute("type") == Some(kind))?;
    assert_eq!(animation.attribute("dur"), Some("6s"));
    assert_eq!(animation.attribute("repeatCount"), Some("indefinite"));
    // Turns are added to the place.
    assert_eq!(animation.attribute("additive"), (kind == "rotate").then_some("sum"));
    Some(animation.attribute("values").unwrap().split(';').map(numbers).collect())
}

fn tag(name: &str) -> (&'static str, &str) {
    ("http://www.w3.org/2000/svg", name)
}

/// Places and turns, in degrees from the first frame on, of a group.
fn motion(group: Node, frames: usize) -> Vec<(Point2<f64>, f64)> {
    let first = transform(group, "translate");
    let places = values(group, "translate").unwrap_or_else(|| vec![first.clone(); frames]);
    let turns = values(group, "rotate").unwrap_or_else(|| vec![vec![0.0]; frames]);
    assert_eq!((places.len(), turns.len()), (frames, frames));
    // The still picture is the first frame.
    assert_eq!(places[0], first);
    assert_eq!(turns[0], [0.0]);
    places.into_iter().zip(turns).map(|(place, turn)| (point![place[0], place[1]], turn[0])).collect()
}

fn layer<'a>(document: &'a Document, class: &str) -> Vec<Node<'a, 'a>> {
    let layer = document.descendants().find(|node| node.attribute("class") == Some(class)).unwrap();
    layer.children().filter(Node::is_element).collect()
}

/// The group of a joint, by its name.
fn joint<'a>(document: &'a Document, name: &str) -> Node<'a, 'a> {
    let named = |group: &Node| group.children().any(|child| child.text().map(str::trim) == Some(name));
    layer(document, "moving").into_iter().find(named).unwrap_or_else(|| panic!("no joint {name}"))
}

/// The map from points to pixels, from two pivots of the picture.
fn pixels(document: &Document, first: &Frame, [from, to]: [&str; 2]) -> impl Fn(Point2<f64>) -> Point2<f64> {
    let at = |name: &str| first.iter().find(|(other, _)| *other == name).unwrap().1;
    let pixel = |name: &str| Point2::from_slice(&transform(joint(document, name), "translate"));
    let (origin, start) = (at(from), pixel(from));
    let scale = (pixel(to) - start).norm() / (at(to) - origin).norm();
    move |point: Point2<f64>| start + vector![point.x - origin.x, origin.y - point.y] * scale
}

#[track_caller]
fn near(found: Point2<f64>, expected: Point2<f64>) {
    assert!((found - expected).amax() <= WRITTEN, "{found} is not {expected}");
}

#[test]
fn joints_are_where_the_frames_say() {
    let frames = four_bar(1.0);
    let svg = picture_of_the_four_bar(1.0).to_svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let pixel = pixels(&document, &frames[0], ["A", "D"]);
    for (index, (name, _)) in frames[0].iter().enumerate() {
        let motion = motion(joint(&document, name), frames.len());
        for (frame, (place, turn)) in frames.iter().zip(motion) {
            near(place, pixel(frame[index].1));
            assert_eq!(turn, 0.0);
        }
    }
}

/// A link moved with its first point and turned by the angles of the picture has its other points where they belong.
#[test]
fn links_are_carried_rigidly() {
    let frames = four_bar(1.0);
    let svg = picture_of_the_four_bar(1.0).to_svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let pixel = pixels(&document, &frames[0], ["A", "D"]);
    let moving = layer(&document, "moving");
    for (group, [from, to]) in moving.iter().zip([[0, 1], [1, 2], [3, 2]]) {
        let body = motion(*group, frames.len());
        let arm = pixel(frames[0][to].1) - pixel(frames[0][from].1);
        for (frame, (place, turn)) in frames.iter().zip(&body) {
            near(*place, pixel(frame[from].1));
            near(place + Rotation2::new(turn.to_radians()) * arm, pixel(frame[to].1));
        }
        // Between frames nothing spins: an angle changes by less than a few steps of the crank.
        for pair in body.windows(2) {
            assert!((pair[1].1 - pair[0].1).abs() < 30.0, "{} to {}", pair[0].1, pair[1].1);
        }
    }
    // One turn of the crank, clockwise: on the screen angles grow in the other sense.
    assert_eq!(motion(moving[0], frames.len())[frames.len() - 1].1, -360.0);
}

#[test]
fn springs_reach_from_point_to_point() {
    let frames = four_bar(1.0);
    let mut picture = animation("Spring", &frames);
    picture.ground("A").ground("D").link(&["D", "C"]).crank(&["A", "B"]).spring("G3", "D");
    let svg = picture.to_svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let pixel = pixels(&document, &frames[0], ["A", "D"]);
    let spring = layer(&document, "moving")[2];
    let lying = spring.descendants().find(|node| node.attribute("transform").is_some_and(|t| t.starts_with("rotate")));
    let lying = lying.unwrap();
    let angle = transform(lying, "rotate")[0];
    let stretched = lying.first_element_child().unwrap();
    let scales = values(stretched, "scale").unwrap();
    let length = (pixel(frames[0][4].1) - pixel(frames[0][3].1)).norm();
    for ((frame, (place, turn)), scale) in frames.iter().zip(motion(spring, frames.len())).zip(scales) {
        let end = Rotation2::new((turn + angle).to_radians()) * vector![length * scale[0], 0.0];
        near(place, pixel(frame[4].1));
        // The scale is written to a thousandth.
        assert!((place + end - pixel(frame[3].1)).amax() <= WRITTEN + 0.0005 * length, "{frame:?}");
    }
}

/// A plate with one corner at the point that it turns with, and another to its left.
#[test]
fn plates_turn_with_their_points() {
    let (frames, m) = (four_bar(1.0), FourBar::<f64>::default());
    let mut picture = animation("Plate", &frames);
    picture.ground("A").ground("D").link(&["D", "C"]).crank(&["A", "B"]);
    picture.plate("D", "C", [vector![m.l4, 0.0], vector![0.0, m.l2]]);
    let svg = picture.to_svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let pixel = pixels(&document, &frames[0], ["A", "D"]);
    let plate = layer(&document, "moving")[2];
    let outline = plate.first_element_child().unwrap().attribute("d").unwrap();
    let (first, step) = outline.strip_prefix('M').and_then(|rest| rest.strip_suffix('z')?.split_once('l')).unwrap();
    let pair = |text: &str| Vector2::from_vec(numbers(&text.replace('-', " -").trim_start().replace("  ", " ")));
    let corners = [pair(first), pair(first) + pair(step)];
    for (frame, (place, turn)) in frames.iter().zip(motion(plate, frames.len())) {
        let (centre, point) = (frame[3].1, frame[2].1);
        let left = vector![centre.y - point.y, point.x - centre.x] * (m.l2 / m.l4);
        for (corner, expected) in corners.iter().zip([point, centre + left]) {
            near(place + Rotation2::new(turn.to_radians()) * corner, pixel(expected));
        }
    }
}

#[test]
fn sliders_stay_on_their_guides() {
    let m = OffsetSliderCrank::default();
    let frames: Vec<Frame> = (0..=STEPS)
        .map(|step| {
            let theta2 = f64::from(step * 360 / STEPS).to_radians();
            let pose = m.assemble(theta2, OffsetSliderCrankBranch::new(Far)).unwrap();
            let points = m.points(&pose).unwrap();
            vec![("O", points.o), ("A", points.a), ("B", points.b), ("Foot", point![0.0, m.c])]
        })
        .collect();
    let mut picture = animation("Slider", &frames);
    picture.crank(&["O", "A"]).link(&["A", "B"]).slider("B").ground("O").ground("Foot").spring("Foot", "B");
    let svg = picture.to_svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let pixel = pixels(&document, &frames[0], ["O", "Foot"]);
    let block = motion(layer(&document, "moving")[2], frames.len());
    for (frame, (place, turn)) in frames.iter().zip(&block) {
        // The scale from two pivots this near each other is coarse; distances along the guide are not.
        assert_eq!((place.y, *turn), (block[0].0.y, 0.0));
        assert!((place.y - pixel(frame[2].1).y).abs() <= WRITTEN);
    }
    // A slider does not turn round.
    picture.slider("A");
    assert_eq!(picture.to_svg(), Err(DrawingError::NotStraight("A".to_owned())));
}

/// In other units the picture is the same to the last character.
#[test]
fn scale_free() {
    let picture = picture_of_the_four_bar(1.0).to_svg();
    assert!(picture.is_ok());
    for exponent in [-160, -30, 1, 30, 160] {
        assert_eq!(picture_of_the_four_bar(2_f64.powi(exponent)).to_svg(), picture, "2^{exponent}");
    }
}

#[test]
fn the_picture_stands_alone_and_is_small() {
    let svg = picture_of_the_four_bar(1.0).to_svg().unwrap();
    for foreign in ["<script", "https:", "@import", "url(", "href", " onload", "NaN", "inf"] {
        assert!(!svg.contains(foreign), "{foreign}");
    }
    assert!(svg.len() < 13_000, "{}", svg.len());
    assert_eq!(picture_of_the_four_bar(1.0).to_svg(), Ok(svg));
}

/// The copy for readers who prefer reduced motion has all parts, and none of them moves.
#[test]
fn the_still_picture_is_the_first_frame() {
    let svg = picture_of_the_four_bar(1.0).to_svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let (moving, still) = (layer(&document, "moving"), layer(&document, "still"));
    assert_eq!(moving.len(), still.len());
    for (moving, still) in moving.iter().zip(&still) {
        assert_eq!(moving.attribute("transform"), still.attribute("transform"));
        let shapes = |group: &Node| -> Vec<String> {
            group.descendants().filter_map(|node| node.attribute("d").map(str::to_owned)).collect()
        };
        assert_eq!(shapes(moving), shapes(still));
        assert!(still.descendants().all(|node| !node.has_tag_name(tag("animateTransform"))));
    }
    assert!(svg.contains("@media (prefers-reduced-motion:reduce)"));
}

#[test]
fn names_are_escaped() {
    let mut picture = Animation::new("a < b & \"c\"", 6.0);
    let name = "P<&\"'>";
    for step in 0..=STEPS {
        let angle = f64::from(step * 360 / STEPS).to_radians();
        picture.frame([("O", point![0.0, 0.0]), (name, point![angle.cos(), angle.sin()])]);
    }
    picture.ground("O").crank(&["O", name]).trace(name);
    let svg = picture.to_svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let text = |kind: &str| document.descendants().find(|node| node.has_tag_name(tag(kind))).unwrap().text().unwrap();
    assert_eq!(text("title"), "a < b & \"c\"");
    assert!(text("desc").ends_with(name));
    joint(&document, name);
}

type Draw = dyn Fn(&mut Animation) -> &mut Animation;

#[test]
fn contradictions_are_named() {
    let frames = four_bar(1.0);
    let error = |draw: &Draw| {
        let mut picture = animation("Wrong", &frames);
        draw(&mut picture);
        picture.to_svg().unwrap_err()
    };
    let name = |name: &str| name.to_owned();
    assert_eq!(error(&|picture| picture), DrawingError::Empty);
    assert_eq!(Animation::new("Nothing", 6.0).ground("A").to_svg(), Err(DrawingError::Empty));
    assert_eq!(error(&|picture| picture.link(&[]).ground("A")), DrawingError::Empty);
    assert_eq!(error(&|picture| picture.link(&["A", "E"])), DrawingError::UnknownPoint(name("E")));
    assert_eq!(error(&|picture| picture.link(&["A", "C"])), DrawingError::NotRigid(name("A-C")));
    assert_eq!(error(&|picture| picture.bent(&["A", "B", "C"])), DrawingError::NotRigid(name("A-B-C")));
    assert_eq!(error(&|picture| picture.ground("C")), DrawingError::Moves(name("C")));
    assert_eq!(error(&|picture| picture.slider("G3")), DrawingError::NotStraight(name("G3")));
    assert_eq!(error(&|picture| picture.slider("A")), DrawingError::NotStraight(name("A")));
    let other: &Draw = &|picture| picture.ground("A").frame([("A", point![0.0, 0.0])]);
    assert_eq!(error(other), DrawingError::OtherPoints(frames.len()));
    let twice = Animation::new("Twice", 6.0).frame([("A", point![0.0, 0.0]), ("A", point![1.0, 0.0])]).to_svg();
    assert_eq!(twice, Err(DrawingError::DuplicatePoint(name("A"))));
    let wrong: [&Draw; 6] = [
        &|picture| picture.wheel("A", "B", f64::NAN),
        &|picture| picture.wheel("A", "B", 0.0),
        &|picture| picture.plate("A", "B", [vector![0.0, 1.0], vector![f64::INFINITY, 0.0]]),
        &|picture| picture.plate("A", "B", []),
        &|picture| picture.ground("A").ground_line([point![0.0, 0.0], point![f64::NAN, 0.0]]),
        &|picture| picture.spring("A", "A").ground("A").ground("D"),
    ];
    for draw in wrong {
        assert!(matches!(error(draw), DrawingError::NotFinite(_)));
    }
    for seconds in [0.0, -1.0, f64::NAN] {
        let mut picture = Animation::new("Time", seconds);
        picture.frame([("A", point![0.0, 0.0])]).ground("A");
        assert!(matches!(picture.to_svg(), Err(DrawingError::NotFinite(_))));
    }
    let mut picture = Animation::new("NaN", 6.0);
    picture.frame([("A", point![f64::NAN, 0.0])]).ground("A");
    assert!(matches!(picture.to_svg(), Err(DrawingError::NotFinite(_))));
}
