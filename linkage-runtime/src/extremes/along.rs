//! The extremes along one motion, from one end to the other.
//!
//! At a dead point the derivative by the input is infinite, and at a change point that of the mechanism is ambiguous; the
//! derivative by the arc length of the motion is neither. So the motion is searched between its ends and its change
//! points in a parameter s, input = low + (high - low) sin^2(pi s / 2), by which a quantity has a finite derivative up to
//! a dead point. Next to an end, the sign of the derivative at the end itself is that along the tangent of the motion.

use core::cmp::Ordering::Equal;
use std::vec;
use std::vec::Vec;

use super::at_input::Search;
use super::course::Course;
use super::piece::{Piece, next_to};
use super::{Extreme, Extremes, constant, rests};
use crate::kinematic::MotionOf;
use crate::range_of_motion::{Driven, RangeOfMotion};
use crate::scalar::arithmetic::*;
use crate::scalar::larger;
use crate::{OutputMotion, PathErrorOf, real};

/// The distance of two inputs that are neighbours, as a part of a step: a motion is hardly seen, and rounding errors are others.
const NEIGHBOUR: f64 = 1.0 / 1024.0;

/// The places at each end of a part that have several neighbours, and how many: next to a singular position the errors of few
/// places are much larger than those of all others, and two of these errors may be equal by chance.
const NEXT_TO_END: usize = 8;
const NEIGHBOURS: u32 = 4;

/// The places of a part at which rounding errors are measured.
const PLACES: u32 = 12;

/// The extremes of a quantity along a motion, ends included, each input to an ulp.
///
/// `quantity` takes the motion at an input with the rate 1 and the acceleration 0, as [`RangeOfMotion::motion`] returns
/// it, so that rates are derivatives by the input. Change points between the ends may be extremes too. Where the second
/// derivative is not known it may be NaN: then of two extremes within a step both are missed. There are 360 steps, shorter
/// towards the ends, in each part between change points, and in each turn of a longer part; limitations are those of
/// [`over_range`](super::over_range).
///
/// ```
/// linkage::linkage! {
///     pub mechanism FourBar {
///         param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
///         input theta;
///         unknown phi, psi;
///         loop crank@theta + coupler@phi = ground@0 + rocker@psi;
///         output swing = psi;
///     }
/// }
/// use linkage::extremes;
/// use linkage::range_of_motion::{RangeOfMotion, RangeOptions};
///
/// // This crank goes to and fro between two dead points.
/// let (m, branch) = (FourBar::default(), FourBarBranch::new(linkage::Elbow::Left));
/// let range = RangeOfMotion::on_branch(&m, branch, [0.5], RangeOptions::default())?;
/// let swing = extremes::over(&range, |motion| motion.outputs.swing)?;
/// assert!([swing.least.input, swing.largest.input].iter().any(|input| range.inputs().contains(input)));
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// # Errors
/// The reason why the motion has no position, or no velocity, at an input between its ends.
pub fn over<M>(
    range: &RangeOfMotion<'_, M>,
    mut quantity: impl FnMut(&MotionOf<M::Of>) -> OutputMotion<M::Scalar>,
) -> Result<Extremes<M::Scalar>, PathErrorOf<M>>
where
    M: Driven,
{
    let found = courses(range, |motion| [quantity(motion)])?;
    // There is one quantity.
    Ok(found.first().map_or(Extremes::only(M::Scalar::zero(), M::Scalar::zero()), |course| course.extremes))
}

/// Several quantities along a motion, which is followed once for all of them; see [`over`]. `quantities` returns as
/// many at each input.
///
/// # Panics
/// If it does not.
///
/// # Errors
/// Those of [`over`].
pub fn courses<M, Q>(
    range: &RangeOfMotion<'_, M>,
    quantities: impl FnMut(&MotionOf<M::Of>) -> Q,
) -> Result<Vec<Course<M::Scalar>>, PathErrorOf<M>>
where
    M: Driven,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    courses_on_turns(range, [], quantities)
}

/// [`courses`] of quantities of which some jump: for each in order the jump of its formula, such as a whole turn of `atan2`,
/// or none. They go on where their formula jumps, so that an angle that turns counts its turns.
///
/// # Panics
/// If `quantities` does not return as many at each input.
///
/// # Errors
/// Those of [`over`].
pub fn courses_on_turns<M, Q>(
    range: &RangeOfMotion<'_, M>,
    jumps: impl IntoIterator<Item = Option<M::Scalar>>,
    quantities: impl FnMut(&MotionOf<M::Of>) -> Q,
) -> Result<Vec<Course<M::Scalar>>, PathErrorOf<M>>
where
    M: Driven,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    let mut search = Search::new(range, quantities, jumps.into_iter().collect());
    let mut courses: Vec<Course<M::Scalar>> = Vec::new();
    // The signs of the derivatives next to the ends of each piece, and whether they change in between.
    let mut signs: Vec<Vec<[M::Scalar; 2]>> = Vec::new();
    let pieces = Piece::all(range);
    for piece in &pieces {
        let begin = search.begin(piece.low)?;
        let mut samples = Vec::new();
        for s in piece.places() {
            samples.push((s, search.next(piece.input(s))?));
        }
        let ends = [(piece.low, begin), (piece.high, search.by_length(piece.high, false)?)];
        let are_constant = are_constant(piece, &samples, &mut search)?;
        let resolution = resolution(range, piece, &ends, &mut search)?;
        let mut of_piece = Vec::new();
        for place in 0..ends[0].1.len() {
            let at_ends = ends.each_ref().map(|(input, all)| Extreme { input: *input, value: all[place].value });
            if courses.len() == place {
                courses.push(Course::only(at_ends[0]));
            }
            let course = &mut courses[place];
            course.ends[1] = at_ends[1];
            let is_constant = are_constant.get(place) == Some(&true);
            course.is_constant &= is_constant;
            course.samples.extend(samples.iter().map(|(s, all)| (piece.input(*s), all[place])));
            if let Some((between, at_ends)) = resolution.get(place) {
                course.resolution.0 = course.resolution.0.max(*between);
                course.resolution.1.extend([piece.low, piece.high].into_iter().zip(*at_ends));
            }
            let mut next_to = [M::Scalar::zero(); 2];
            if is_constant {
                of_piece.push(next_to);
                continue;
            }
            for (at, inside) in [samples.first(), samples.last()].into_iter().enumerate() {
                let ((end, at_end), Some((s, all))) = (&ends[at], inside) else { continue };
                let rates = [at_end[place].rate, all[place].rate];
                let turning = search.next_to_end(place, [*end, piece.input(*s)], rates)?;
                next_to[at] = if turning.is_some() { -rates[1] } else { rates[1] };
                course.turning_points.extend(turning);
            }
            let of_place: Vec<_> = samples.iter().map(|(s, all)| (*s, all[place])).collect();
            let between = resolution.get(place).map_or(M::Scalar::zero(), |(between, _)| *between);
            let rests = rests::runs(&of_place, between);
            for (at, pair) in of_place.windows(2).enumerate() {
                // In a rest the sign of the derivative is that of rounding errors.
                if rests.iter().any(|[first, last]| (*first..*last).contains(&at)) {
                    continue;
                }
                let [from, to] = [pair[0], pair[1]].map(|(s, motion)| piece.slope_at(s, &motion));
                search.within_step(piece, place, [from, to], &mut course.turning_points)?;
            }
            of_piece.push(next_to);
        }
        signs.push(of_piece);
    }
    for (place, course) in courses.iter_mut().enumerate() {
        // Where two pieces meet, and where a closed motion begins again.
        let next = |at: usize| if at + 1 < pieces.len() { Some(at + 1) } else { range.is_closed().then_some(0) };
        for (at, piece) in pieces.iter().enumerate() {
            let Some(next) = next(at) else { continue };
            if signs[at][place][1] * signs[next][place][0] < M::Scalar::zero() {
                let input = if next == 0 { pieces[0].low } else { piece.high };
                let value = search.by_length(input, true)?[place].value;
                course.turning_points.push(Extreme { input, value });
            }
        }
        if !course.is_constant {
            rests::add(range, &mut search, place, course)?;
        }
        course.turning_points.sort_by(|one, other| one.input.partial_cmp(&other.input).unwrap_or(Equal));
        course.find_extremes();
    }
    Ok(courses)
}

/// The quantities at a place.
type Quantities<T> = (T, Vec<OutputMotion<T>>);

/// True for each quantity that does not move in a part.
fn are_constant<M, F, Q>(
    piece: &Piece<M::Scalar>,
    samples: &[Quantities<M::Scalar>],
    search: &mut Search<'_, '_, M, F>,
) -> Result<Vec<bool>, PathErrorOf<M>>
where
    M: Driven,
    F: FnMut(&MotionOf<M::Of>) -> Q,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    let count = samples.first().map_or(0, |(_, all)| all.len());
    let may_be = |place: usize| {
        let slopes = samples.iter().map(|(s, all)| (all[place].value, piece.slope_at(*s, &all[place])));
        !constant::moves(&slopes.collect::<Vec<_>>())
    };
    let may_be: Vec<bool> = (0..count).map(may_be).collect();
    if !may_be.contains(&true) {
        return Ok(may_be);
    }
    let mut pairs = vec![Vec::new(); count];
    let step: M::Scalar = real(1.0 / f64::from(piece.steps));
    for (at, (s, all)) in samples.iter().enumerate() {
        let is_next_to_end = at.min(samples.len() - 1 - at) < NEXT_TO_END;
        for neighbour in 1..=if is_next_to_end { NEIGHBOURS } else { 1 } {
            let next = search.by_input(piece.input(*s + step * real(f64::from(neighbour) * NEIGHBOUR)))?;
            for (pairs, (one, next)) in pairs.iter_mut().zip(all.iter().zip(&next)) {
                pairs.push([one.value, next.value]);
            }
        }
    }
    Ok(may_be.into_iter().zip(&pairs).map(|(may_be, pairs)| may_be && constant::is_constant(pairs)).collect())
}

/// The change of a quantity by an ulp of the input and by rounding errors, between the ends of a part and at both.
type Resolution<T> = (T, [T; 2]);

/// The resolution of each quantity in a part.
fn resolution<M, F, Q>(
    range: &RangeOfMotion<'_, M>,
    piece: &Piece<M::Scalar>,
    ends: &[Quantities<M::Scalar>; 2],
    search: &mut Search<'_, '_, M, F>,
) -> Result<Vec<Resolution<M::Scalar>>, PathErrorOf<M>>
where
    M: Driven,
    F: FnMut(&MotionOf<M::Of>) -> Q,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    let mut found = vec![(M::Scalar::zero(), [M::Scalar::zero(); 2]); ends[0].1.len()];
    let change = |one: &OutputMotion<M::Scalar>, other: &OutputMotion<M::Scalar>| {
        let digit = larger(one.value.abs(), other.value.abs()) * M::Scalar::default_epsilon();
        larger((one.value - other.value).abs(), digit)
    };
    for place in 0..PLACES {
        let input = piece.input(real((f64::from(place) + 0.5) / f64::from(PLACES)));
        let [before, after] = next_to(range, input);
        let (before, after) = (search.by_input(before)?, search.by_input(after)?);
        for ((between, _), (before, after)) in found.iter_mut().zip(before.iter().zip(&after)) {
            *between = between.max(change(before, after));
        }
    }
    for (at, (end, values)) in ends.iter().enumerate() {
        let [before, after] = next_to(range, *end);
        let inside = search.by_length(if at == 0 { after } else { before }, at == 0)?;
        for ((_, at_ends), (value, inside)) in found.iter_mut().zip(values.iter().zip(&inside)) {
            at_ends[at] = change(value, inside);
        }
    }
    Ok(found)
}
