//! Drawings from joints and parts as plain data.

use linkage_runtime::skeleton::Part as Known;
use nalgebra::Vector2;

use super::figure::Figure;
use super::part::Part;
use super::{Animation, Drawing};

/// The length of an arm beyond its farthest block.
const BEYOND: f64 = 1.1;

/// The joints and the parts of a mechanism whose names are known at run time only; those of an emitted one are known by its
/// [`Skeleton`](linkage_runtime::skeleton::Skeleton).
///
/// ```
/// use linkage_report::drawing::Parts;
/// use linkage_runtime::skeleton::Part;
///
/// let crank = Part::Bar { joints: &[0, 1], is_driven: true };
/// let parts = Parts { joints: &["O", "A"], parts: &[Part::Ground(0), crank, Part::Trace(1)], guides: &[] };
/// let turn = (0..=60).map(|step| f64::from(step * 6).to_radians());
/// let film = parts.animation("A crank", turn.map(|angle| [[0.0, 0.0], [angle.cos(), angle.sin()]]), 4.0);
/// assert!(film.to_svg()?.contains("animateTransform"));
/// # Ok::<(), linkage_report::drawing::DrawingError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Parts<'a> {
    /// The names of the joints.
    pub joints: &'a [&'a str],
    /// The parts, by the places of their joints in this list.
    pub parts: &'a [Known<'a>],
    /// x and y along the guide of each slider and the arm of each sleeve, in the order of the parts; needed where these rest.
    pub guides: &'a [[f64; 2]],
}

impl Parts<'_> {
    /// Draws the mechanism with its joints at these places. More can be added.
    pub fn drawing(&self, title: impl Into<String>, joints: impl IntoIterator<Item = [f64; 2]>) -> Drawing {
        Drawing { figure: Figure::at(self, [joints]), ..Drawing::new(title) }
    }

    /// Animates the mechanism through the places of its joints, frame by frame, which take this number of seconds.
    pub fn animation<F>(&self, title: impl Into<String>, frames: F, seconds: f64) -> Animation
    where
        F: IntoIterator<Item: IntoIterator<Item = [f64; 2]>>,
    {
        Animation { figure: Figure::at(self, frames), ..Animation::new(title, seconds) }
    }

    fn name(&self, joint: usize) -> &str {
        self.joints.get(joint).copied().unwrap_or_default()
    }
}

impl Figure {
    /// The joints at these places, frame by frame, and the parts.
    pub(super) fn at(parts: &Parts<'_>, frames: impl IntoIterator<Item: IntoIterator<Item = [f64; 2]>>) -> Self {
        let mut figure = Self::default();
        let named = |frame| parts.joints.iter().map(|&name| name.to_owned()).zip(frame);
        for frame in frames {
            figure.frames.push(named(frame.into_iter().map(Vector2::from)).collect());
        }
        let mut guides = parts.guides.iter();
        for part in parts.parts {
            let guide = matches!(part, Known::Slider(_) | Known::Sleeve { .. }).then(|| guides.next()).flatten();
            match *part {
                Known::Ground(joint) => figure.part(Part::Ground(parts.name(joint).to_owned())),
                Known::Slider(joint) => {
                    let along = guide.copied().map(Vector2::from);
                    figure.part(Part::Slider { point: parts.name(joint).to_owned(), along });
                }
                Known::Trace(joint) => figure.part(Part::Trace(parts.name(joint).to_owned())),
                Known::Bar { joints, is_driven } => {
                    let names: Vec<&str> = joints.iter().map(|&joint| parts.name(joint)).collect();
                    figure.link(&names, is_driven);
                }
                Known::Sleeve { pin, on, towards } => {
                    let [pin, on] = [pin, on].map(|joint| parts.name(joint));
                    match towards {
                        Some(end) => figure.sleeve(pin, [on, parts.name(end)]),
                        None => figure.arm(pin, on),
                    }
                }
                _ => {}
            }
        }
        figure
    }

    /// Adds the arm of a sleeve, whose end is no joint: a little longer than the farthest distance of its block.
    fn arm(&mut self, pin: &str, on: &str) {
        let tip = format!("{on}-{pin}");
        let at = |frame: &[(String, Vector2<f64>)], name: &str| {
            frame.iter().find(|(other, _)| other == name).map(|(_, at)| *at).unwrap_or_default()
        };
        let along = |frame: &[(String, Vector2<f64>)]| at(frame, pin) - at(frame, on);
        let length = BEYOND * self.frames.iter().map(|frame| along(frame).norm()).fold(0.0, f64::max);
        for frame in &mut self.frames {
            let direction = along(frame).try_normalize(0.0).unwrap_or_default();
            frame.push((tip.clone(), at(frame, on) + length * direction));
        }
        self.link(&[on, &tip], false);
        self.sleeve(pin, [on, &tip]);
    }
}
