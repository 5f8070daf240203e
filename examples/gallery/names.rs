//! Checks that no name of a picture covers a joint or another name, from the picture alone.

use roxmltree::{Document, Node};

use crate::figure::STEPS;

/// Half the height of a name, half the width of a letter, and the radius of a joint, in pixels.
const HALF_HEIGHT: f64 = 4.5;
const HALF_LETTER: f64 = 3.7;
const JOINT: f64 = 4.5;

struct Named {
    text: String,
    joint: Track,
    /// The middle of the name relative to the joint, at the start.
    offset: [f64; 2],
    walk: Track,
}

/// Places at times from 0 to 1.
struct Track(Vec<(f64, [f64; 2])>);

impl Track {
    /// The animated translation of an element, else that of its attribute.
    fn of(node: Node) -> Self {
        let is_place =
            |node: &Node| node.tag_name().name() == "animateTransform" && node.attribute("type") == Some("translate");
        let Some(animation) = node.children().find(is_place) else {
            let transform = node.attribute("transform").and_then(|text| text.strip_prefix("translate("));
            return Self(vec![(0.0, transform.map_or([0.0; 2], |text| pair(text.trim_end_matches(')'))))]);
        };
        let values: Vec<[f64; 2]> = animation.attribute("values").unwrap_or_default().split(';').map(pair).collect();
        let even = |place: usize| place as f64 / (values.len() - 1) as f64;
        let times: Vec<f64> = match animation.attribute("keyTimes") {
            Some(times) => times.split(';').map(number).collect(),
            None => (0..values.len()).map(even).collect(),
        };
        assert_eq!(times.len(), values.len());
        Self(times.into_iter().zip(values).collect())
    }

    fn at(&self, time: f64) -> [f64; 2] {
        let Some(pair) = self.0.windows(2).find(|pair| time <= pair[1].0) else { return self.0[self.0.len() - 1].1 };
        let [(before, from), (after, to)] = [pair[0], pair[1]];
        let part = (time - before) / (after - before);
        [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * part)
    }
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text} is not a number"))
}

fn pair(text: &str) -> [f64; 2] {
    let mut numbers = text.split(' ').map(number);
    [(); 2].map(|()| numbers.next().unwrap_or_default())
}

impl Named {
    fn of(group: Node) -> Option<Self> {
        let text = group.children().find(|child| child.tag_name().name() == "text")?;
        let [x, y] = ["x", "y"].map(|axis| number(text.attribute(axis).unwrap_or_default()));
        Some(Self {
            text: text.text().unwrap_or_default().trim().to_owned(),
            joint: Track::of(group),
            // The baseline is below the middle.
            offset: [x, y - HALF_HEIGHT],
            walk: Track::of(text),
        })
    }

    fn half_width(&self) -> f64 {
        HALF_LETTER * self.text.chars().count() as f64
    }

    fn place(&self, time: f64) -> [f64; 2] {
        let [joint, walk] = [self.joint.at(time), self.walk.at(time)];
        [0, 1].map(|axis| joint[axis] + self.offset[axis] + walk[axis])
    }

    fn covers_joint(&self, other: &Self, time: f64) -> bool {
        let (place, joint) = (self.place(time), other.joint.at(time));
        let beyond = |axis: usize, half: f64| ((joint[axis] - place[axis]).abs() - half).max(0.0);
        beyond(0, self.half_width()).hypot(beyond(1, HALF_HEIGHT)) < JOINT
    }

    fn covers_name(&self, other: &Self, time: f64) -> bool {
        let (one, two) = (self.place(time), other.place(time));
        (one[0] - two[0]).abs() < self.half_width() + other.half_width() && (one[1] - two[1]).abs() < 2.0 * HALF_HEIGHT
    }
}

/// Panics if in some frame a name covers a joint or another name.
pub fn check(title: &str, svg: &str) {
    let document = Document::parse(svg).unwrap_or_else(|error| panic!("{title}: {error}"));
    let moving = document.descendants().find(|node| node.attribute("class") == Some("moving"));
    let names: Vec<Named> = moving.into_iter().flat_map(|layer| layer.children()).filter_map(Named::of).collect();
    assert!(names.len() > 1, "{title} has names");
    for time in (0..=STEPS).map(|frame| f64::from(frame) / f64::from(STEPS)) {
        for (place, name) in names.iter().enumerate() {
            let joint = names.iter().find(|other| name.covers_joint(other, time));
            assert!(
                joint.is_none(),
                "{title} at {time}: {} covers the joint {}",
                name.text,
                joint.map_or("", |other| &other.text)
            );
            let other = names[..place].iter().find(|other| name.covers_name(other, time));
            assert!(
                other.is_none(),
                "{title} at {time}: {} covers {}",
                name.text,
                other.map_or("", |other| &other.text)
            );
        }
    }
}
