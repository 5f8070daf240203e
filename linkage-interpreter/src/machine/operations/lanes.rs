//! The forms of operations over lanes, which are recorded on a tape.

use linkage_ir::Intrinsic;
use linkage_ir::Name;

use super::arguments::{Arguments, side};
use crate::machine::defect::Defect;
use crate::machine::failure::Evaluated;
use crate::machine::scalar::Scalar as _;
use crate::machine::value::Value;
use crate::tape::{Chord, Flag, Test, Traced};

/// The forms over lanes; `None` for an operation that has none of its own.
pub(super) fn in_lanes(of: Intrinsic, arguments: &Arguments) -> Evaluated<Option<Value>> {
    let number = |place| arguments.number::<Traced>(place);
    let flag = |flag: Flag| match flag {
        Flag::Constant(flag) => Value::Flag(flag),
        register => Value::TracedFlag(register),
    };
    let none = Traced::Constant(0.0);
    let test = |of: Test| Ok::<_, Defect>(flag(number(0)?.test(of, &none)));
    let test_of_two = |of: Test| Ok::<_, Defect>(flag(number(0)?.test(of, &number(1)?)));
    let chord = |of: Chord, place: usize, numbers: Vec<Traced>| {
        let (chord, is_right) = Traced::chord(of, side(arguments.at(place)?)?, &numbers);
        Ok::<_, Defect>(Value::list([chord.into_value(), flag(is_right)]))
    };
    Ok(Some(match of {
        Intrinsic::SineInLane => number(0)?.sine().into_value(),
        Intrinsic::CosineInLane => number(0)?.cosine().into_value(),
        Intrinsic::SineCosineInLane => Value::list(number(0)?.sine_cosine().map(Traced::into_value)),
        Intrinsic::Arctangent2InLane => number(0)?.arctangent2(&number(1)?).into_value(),
        Intrinsic::HypotenuseInLane => number(0)?.hypotenuse(&number(1)?).into_value(),
        Intrinsic::InRange => number(0)?.in_range(&number(1)?, &number(2)?).into_value(),
        Intrinsic::IsModerateInLane => test(Test::IsModerate)?,
        Intrinsic::IsSolvableInLane => test(Test::IsSolvable)?,
        Intrinsic::IsReachableInLane => test(Test::IsReachable)?,
        Intrinsic::HasArctangent2InLane => test_of_two(Test::HasArctangent2)?,
        Intrinsic::HasHypotenuseInLane => test_of_two(Test::HasHypotenuse)?,
        Intrinsic::IsNonzero => test_of_two(Test::IsNonzero)?,
        Intrinsic::Closes => test_of_two(Test::Closes)?,
        Intrinsic::IsFinite => {
            let mut are_finite = Flag::Constant(true);
            arguments.at(0)?.each_leaf(&mut |leaf| {
                if let Some(number) = Traced::of(leaf) {
                    are_finite = are_finite.and(&number.test(Test::IsFinite, &none));
                }
            });
            flag(are_finite)
        }
        Intrinsic::ElbowChordInLane => {
            let of = arguments.at(0)?;
            let mut numbers = Vec::new();
            for name in
                [Name::LINKS, Name::LINE, Name::SCALE, Name::REACH_SQUARED, Name::DISTANCE_SQUARED, Name::FACTORS]
            {
                of.field(name)?.each_leaf(&mut |leaf| numbers.extend(Traced::of(leaf)));
            }
            chord(Chord::Elbow, 1, numbers)?
        }
        Intrinsic::ChordInLane => chord(Chord::Factors, 1, traced(arguments.at(0)?))?,
        Intrinsic::ReachChordInLane => {
            let mut numbers = traced(arguments.at(0)?);
            numbers.extend([number(1)?, number(2)?]);
            chord(Chord::Reach, 3, numbers)?
        }
        _ => return Ok(None),
    }))
}

/// The numbers of a list.
fn traced(value: &Value) -> Vec<Traced> {
    let mut all = Vec::new();
    value.each_leaf(&mut |leaf| all.extend(Traced::of(leaf)));
    all
}
