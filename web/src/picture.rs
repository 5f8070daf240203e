//! Pictures of a position, and its numbers.

use linkage_report::drawing::{Animation, Drawing};
use linkage_runtime::kinematic::MotionOf;
use linkage_runtime::skeleton::Skeleton as _;
use linkage_runtime::{Kinematic as _, Mechanism as _};
use serde::Serialize;

use crate::Refusal;
use crate::about::{About, Quantity};
use crate::at::{Coordinates, Moving, rates};
use crate::limit::Stop;
use crate::question::{At, Show};

/// A picture, and the place of the plane in it: x is `origin[0] + scale x`, y is `origin[1] - scale y`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Picture {
    svg: String,
    origin: [f64; 2],
    scale: f64,
    joints: Vec<Joint>,
}

/// A joint or a point by name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Joint {
    pub name: String,
    pub x: f64,
    pub y: f64,
}

/// A coordinate or an output with its rate and acceleration, which are NaN at a dead point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Numbers {
    name: String,
    is_angle: bool,
    value: f64,
    rate: f64,
    acceleration: f64,
}

/// A position with its picture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Moved {
    #[serde(flatten)]
    pub at: At,
    picture: Picture,
    numbers: Vec<Numbers>,
    /// The limit at which the motion stopped here.
    pub stopped: Option<Stop>,
}

impl Moved {
    /// The picture at a position, in the room of a film.
    pub fn of(
        (about, mechanism): (&About, &Moving<'_>),
        at: At,
        q: &Coordinates,
        show: Show,
        film: Option<Film<'_>>,
    ) -> Result<Self, Refusal> {
        let zero = rates(mechanism, show.along, 0.0);
        let motion = mechanism.motion(q, rates(mechanism, show.along, show.rate), zero).ok();
        let picture = picture(mechanism, q, motion.as_ref(), show, film)?;
        let numbers = numbers(about, mechanism, q, motion.as_ref());
        Ok(Self { at, picture, numbers, stopped: None })
    }
}

/// The motion that was followed last.
#[derive(Debug, Clone, Copy)]
pub struct Film<'f> {
    pub frames: &'f Animation,
    /// True if it is the motion of these values of parameters, so that its paths are those of the points.
    pub is_current: bool,
}

/// The joints of a position by name.
pub fn joints(mechanism: &Moving<'_>, q: &Coordinates) -> Vec<Joint> {
    let places = mechanism.joints(&mechanism.pose_at(q));
    let names = mechanism.joint_names();
    names
        .zip(places.as_slice().chunks_exact(2))
        .map(|(name, at)| Joint { name: name.to_owned(), x: at[0], y: at[1] })
        .collect()
}

/// A drawing of a position.
pub fn drawing(mechanism: &Moving<'_>, q: &Coordinates) -> Result<Drawing, Refusal> {
    mechanism.check_drawing().map_err(Refusal::new)?;
    Ok(Drawing::of(mechanism, &mechanism.pose_at(q)))
}

fn picture(
    mechanism: &Moving<'_>,
    q: &Coordinates,
    motion: Option<&MotionOf<Moving<'_>>>,
    show: Show,
    film: Option<Film<'_>>,
) -> Result<Picture, Refusal> {
    let mut drawing = drawing(mechanism, q)?;
    drawing.language(show.language.of_sheet());
    if let Some(Film { frames, is_current }) = film {
        drawing.room(frames);
        if show.traces && is_current {
            drawing.paths(frames);
        }
    }
    if let Some(motion) = motion {
        if show.velocities {
            drawing.velocities(mechanism, &motion.points);
        }
        if show.accelerations {
            drawing.accelerations(mechanism, &motion.points);
        }
    }
    let (svg, placement) = drawing.to_placed_svg().map_err(Refusal::new)?;
    Ok(Picture { svg, origin: placement.origin, scale: placement.scale, joints: joints(mechanism, q) })
}

/// The inputs, the unknowns and the outputs.
fn numbers(
    about: &About,
    mechanism: &Moving<'_>,
    q: &Coordinates,
    motion: Option<&MotionOf<Moving<'_>>>,
) -> Vec<Numbers> {
    let of = |quantity: &Quantity, [value, rate, acceleration]: [f64; 3]| Numbers {
        name: quantity.name.clone(),
        is_angle: quantity.is_angle,
        value,
        rate,
        acceleration,
    };
    let nothing = |values: &[f64]| vec![f64::NAN; values.len()];
    let each = |named: &[Quantity], values: &[f64], rates: Vec<f64>, accelerations: Vec<f64>| -> Vec<Numbers> {
        let all = named.iter().zip(values).zip(rates).zip(accelerations);
        all.map(|(((quantity, value), rate), acceleration)| of(quantity, [*value, rate, acceleration])).collect()
    };
    let list = |column: &[f64]| column.to_vec();
    let (inputs, unknowns) = (q.inputs.as_slice(), q.unknowns.as_slice());
    let of_inputs = motion.map_or_else(
        || [nothing(inputs), nothing(inputs)],
        |motion| [list(motion.rates.inputs.as_slice()), list(motion.accelerations.inputs.as_slice())],
    );
    let of_unknowns = motion.map_or_else(
        || [nothing(unknowns), nothing(unknowns)],
        |motion| [list(motion.rates.unknowns.as_slice()), list(motion.accelerations.unknowns.as_slice())],
    );
    let outputs: Vec<[f64; 3]> = match motion {
        Some(motion) => {
            Moving::each_output(motion.outputs).iter().map(|one| [one.value, one.rate, one.acceleration]).collect()
        }
        None => {
            let still = mechanism.outputs(&mechanism.pose_at(q)).ok().map(Moving::each_output);
            still.iter().flatten().map(|value| [*value, f64::NAN, f64::NAN]).collect()
        }
    };
    let ([rates, accelerations], [of_rates, of_accelerations]) = (of_inputs, of_unknowns);
    let mut all = each(&about.inputs, inputs, rates, accelerations);
    all.extend(each(&about.unknowns, unknowns, of_rates, of_accelerations));
    all.extend(about.outputs.iter().zip(outputs).map(|(quantity, numbers)| of(quantity, numbers)));
    all
}
