//! The numbers and the picture of a sheet at one position.

use linkage_compiler::document::Documents;
use linkage_report::sheet::{MotionNumbers, MovingCoordinate, Sheet};
use linkage_runtime::{OutputMotion, PointMotion};

use crate::about::About;
use crate::arguments;
use crate::commands::svg_or_message;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::machine::{Coordinate, Machine, Motion};
use crate::motion::held;
use crate::terminal::say;

pub struct Position {
    given: Vec<(String, f64)>,
    /// None of parameters with values alone, at whose usual inputs there is no position.
    numbers: Option<Numbers>,
}

struct Numbers {
    motion: MotionNumbers,
    picture: Option<String>,
    caption: String,
}

impl Position {
    /// The position that arguments ask for, and the documents of its mechanism; none if they ask for no numbers.
    pub fn of(arguments: &arguments::Sheet, has_picture: bool) -> Result<Option<(Self, Documents)>, Failure> {
        let arguments::Sheet { numbers, place, rate, live, .. } = arguments;
        let is_chosen = !numbers.branch.is_empty() || !numbers.guess.is_empty();
        let is_asked = is_chosen || !place.at.is_empty() || rate.is_some() || *live;
        if numbers.set.is_empty() && !is_asked {
            return Ok(None);
        }
        let (machine, documents) = Machine::with(numbers, |lowered| lowered.documents())?;
        let numbers = match Numbers::of(&machine, arguments, has_picture) {
            Err(Failure::Outside(why) | Failure::Argument(why)) if !is_asked => {
                say!("the sheet has no numbers of a position: {why}");
                None
            }
            numbers => Some(numbers?),
        };
        Ok(Some((Self { given: machine.parameters().to_vec(), numbers }, documents)))
    }

    pub fn add_to(&self, sheet: &mut Sheet<'_>) {
        for (name, value) in &self.given {
            sheet.given(name, *value);
        }
        if let Some(Numbers { motion, picture, caption }) = &self.numbers {
            sheet.motion(motion);
            if let Some(picture) = picture {
                sheet.picture(picture, caption);
            }
        }
    }
}

impl Numbers {
    fn of(machine: &Machine, arguments: &arguments::Sheet, has_picture: bool) -> Result<Self, Failure> {
        let arguments::Sheet { place, rate, .. } = arguments;
        let inputs = held(machine, &place.at, None)?;
        let mut rates = vec![0.0; inputs.len()];
        if let (Some(first), Some(rate)) = (rates.first_mut(), rate) {
            *first = rate.number;
        }
        let motion = machine.motion(&inputs, &rates).map_err(Failure::Outside)?;
        // Only a page has pictures.
        let picture = match has_picture {
            true => svg_or_message(machine, &Figure::of(machine)?, &motion, "the sheet")?,
            false => None,
        };
        Ok(Self {
            motion: numbers(machine, &motion, &rates, rate.is_some())?,
            picture,
            caption: arguments.language.of_sheet().position_at(&machine.at(&inputs)),
        })
    }
}

/// The numbers of all names, by their paths in the motion.
fn numbers(machine: &Machine, motion: &Motion, rates: &[f64], has_rates: bool) -> Result<MotionNumbers, Failure> {
    let About { inputs, unknowns, points, outputs, .. } = &machine.about;
    let coordinate = |of: &Coordinate, motion: [f64; 3]| {
        let (name, is_angle) = (of.name.text.clone(), of.is_angle);
        MovingCoordinate { name, is_angle, motion }
    };
    let of_inputs = inputs.iter().zip(&motion.inputs).zip(rates);
    let of_unknowns = unknowns.iter().zip(&motion.unknowns).map(|(unknown, value)| {
        let of = |kind: &str| motion.number(&format!("{kind}.{}", unknown.name.field));
        Ok(coordinate(unknown, [*value, of("rates")?, of("accelerations")?]))
    });
    let of_points = points.iter().map(|point| {
        let vector = |kind: &str| motion.numbers(&format!("points.{}.{kind}", point.field), ["x", "y"]);
        let (velocity, acceleration) = (vector("velocity")?.into(), vector("acceleration")?.into());
        Ok((point.text.clone(), PointMotion { position: vector("position")?.into(), velocity, acceleration }))
    });
    let of_outputs = outputs.iter().map(|output| {
        let of = format!("outputs.{}", output.field);
        let [value, rate, acceleration] = motion.numbers(&of, ["value", "rate", "acceleration"])?;
        Ok((output.text.clone(), OutputMotion { value, rate, acceleration }))
    });
    Ok(MotionNumbers {
        inputs: of_inputs.map(|((input, value), rate)| coordinate(input, [*value, *rate, 0.0])).collect(),
        unknowns: of_unknowns.collect::<Result<_, Failure>>()?,
        points: of_points.collect::<Result<_, Failure>>()?,
        outputs: of_outputs.collect::<Result<_, Failure>>()?,
        ratios: machine.ratios(motion).chunks(inputs.len().max(1)).map(<[f64]>::to_vec).collect(),
        has_rates,
    })
}
