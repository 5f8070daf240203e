//! The chart: its lines are the motions, its marks the modes and the dead points, and each dead point has a drawing.

use linkage::circuits::{CircuitOptions, Circuits};
use linkage::drawing::{CircuitChart, DrawingError};
use linkage::linkage;
use roxmltree::{Document, Node};

linkage! {
    /// A four-bar that is drawn.
    pub mechanism Drawn {
        param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        derive drawing;
    }
}

fn of_class<'a>(svg: &'a Document<'a>, class: &str) -> Vec<Node<'a, 'a>> {
    let has = |node: &Node| node.attribute("class").is_some_and(|classes| classes.split(' ').any(|one| one == class));
    svg.descendants().filter(has).collect()
}

fn number(node: &Node, name: &str) -> f64 {
    node.attribute(name).unwrap().parse().unwrap()
}

#[test]
fn modes_and_dead_points_are_at_their_coordinates() {
    let m = Drawn::default();
    let found = Circuits::of(&m, 0.5, CircuitOptions::default()).unwrap();
    let svg = CircuitChart::of(&m, &found, "psi").unwrap().title("a < b").to_svg();
    assert!(svg.contains("a &lt; b") && !svg.contains("NaN"));
    let svg = Document::parse(&svg).unwrap();
    let frame = of_class(&svg, "frame")[0];
    let [x, y, width, height] = ["x", "y", "width", "height"].map(|name| number(&frame, name));
    let pixel = |theta: f64, psi: f64| {
        let [across, up] =
            [theta, psi + std::f64::consts::PI].map(|angle| angle.to_degrees().rem_euclid(360.0) / 360.0);
        [x + across * width, y + (1.0 - up) * height]
    };
    let near = |node: &Node, at: [f64; 2]| {
        [("cx", at[0]), ("cy", at[1])].iter().all(|(name, at)| (number(node, name) - at).abs() < 0.06)
    };
    let modes = of_class(&svg, "mode");
    assert_eq!(modes.len(), 2);
    for (node, mode) in modes.iter().zip(&found.modes) {
        assert!(near(node, pixel(mode.position.theta, mode.position.psi)), "{node:?}");
    }
    // Each dead point in the chart, and above its drawing.
    let places = of_class(&svg, "place");
    assert_eq!((places.len(), of_class(&svg, "driven").len(), of_class(&svg, "letter").len()), (4, 2, 4));
    for (node, at) in places.iter().zip(found.motions[0].dead_points()) {
        assert!(near(node, pixel(at.point.position.theta, at.point.position.psi)), "{node:?}");
    }
    // The curve leaves the chart above and below, and left and right: it is cut, and stays in the frame.
    let lines = of_class(&svg, "line");
    assert!(lines.len() > 3, "{}", lines.len());
    let texts: Vec<&str> = svg.descendants().filter_map(|node| node.text()).map(str::trim).collect();
    assert!(texts.contains(&"circuit 0: modes 0, 1, 2 dead points") && texts.contains(&"one circuit of 2 modes"));
}

#[test]
fn mistakes_are_named() {
    let m = Drawn::default();
    let found = Circuits::of(&m, 0.5, CircuitOptions::default()).unwrap();
    let unknown = CircuitChart::of(&m, &found, "theta").map(|chart| chart.to_svg());
    assert_eq!(unknown, Err(DrawingError::UnknownCoordinate("theta".to_owned())));
    let none = Circuits::of(&m, 3.0, CircuitOptions::default()).unwrap();
    assert_eq!(CircuitChart::of(&m, &none, "psi").map(|chart| chart.to_svg()), Err(DrawingError::Empty));
}
