//! A start that is moved a little, within the same contacts.

use super::enumeration::{Laws, Modes};
use super::event_loop::{Point, TOUCH, gap};
use super::model::{Law, Model, R, Vector};

/// A change of a start: of coordinates, of rates and of time, each relative to its size.
///
/// The motion is moved again at each time asked for, and its rates after each impact, relative to the rate of the contact: a
/// motion that sticks forgets its start, but not the errors made afterwards.
#[derive(Debug, Clone, Copy)]
pub struct Kick {
    pub size: f64,
    pub x: Vector,
    pub v: Vector,
    pub t: f64,
}

/// Moves a point by a kick. Links hold, closed stops stay closed, and what is at rest stays at rest.
pub fn moved<M: Model>(laws: &Laws<M>, point: &Point, modes: &Modes, kick: &Kick, speed: f64) -> Point {
    let scales = laws.model.scales();
    let Point { t, mut x, mut v } = *point;
    let before = laws.model.rows(t, &x, &v);
    let (mut closed, mut still): (Vec<usize>, Vec<usize>) = ((0..M::LINKS).collect(), (0..M::LINKS).collect());
    for (place, law) in laws.laws.iter().enumerate() {
        let row = M::LINKS + place;
        let rests = before[row].rate(&v).abs() <= TOUCH * speed;
        match law {
            Law::Friction { .. } if rests && modes[place].is_held() => still.push(row),
            Law::Friction { .. } => {}
            Law::Stop { .. } => {
                if gap(law, before[row].value).1 <= TOUCH * scales.length {
                    closed.push(row);
                    if rests {
                        still.push(row);
                    }
                }
            }
        }
    }
    let t = t + kick.size * kick.t * scales.time;
    for (x, kick_x) in x.iter_mut().zip(&kick.x).take(M::COUNT) {
        *x += kick.size * kick_x * scales.length;
    }
    independent(laws, point, &mut closed);
    independent(laws, point, &mut still);
    for _ in 0..4 {
        let rows = laws.model.rows(t, &x, &v);
        let mut wanted = [0.0; R];
        for (wanted, &row) in wanted.iter_mut().zip(&closed) {
            *wanted = before[row].value - rows[row].value;
        }
        let change = laws.change(&rows, &closed, &wanted).expect("the rows are independent");
        for (x, change) in x.iter_mut().zip(change) {
            *x += change;
        }
    }
    for (v, kick_v) in v.iter_mut().zip(&kick.v).take(M::COUNT) {
        *v += kick.size * kick_v * speed;
    }
    let rows = laws.model.rows(t, &x, &v);
    let mut wanted = [0.0; R];
    for (wanted, &row) in wanted.iter_mut().zip(&still) {
        *wanted = -rows[row].rate(&v);
    }
    let change = laws.change(&rows, &still, &wanted).expect("the rows are independent");
    for (v, change) in v.iter_mut().zip(change) {
        *v += change;
    }
    Point { t, x, v }
}

/// Moves a point in the middle of a motion, unless an open stop would be passed.
pub fn moved_on<M: Model>(laws: &Laws<M>, point: &Point, modes: &Modes, kick: &Kick, speed: f64) -> Point {
    let on = moved(laws, point, modes, &Kick { t: 0.0, ..*kick }, speed);
    let rows = laws.model.rows(on.t, &on.x, &on.v);
    let length = laws.model.scales().length;
    let is_within = laws.laws.iter().zip(&rows[M::LINKS..]).all(|(law, row)| gap(law, row.value).1 >= -TOUCH * length);
    if is_within { on } else { *point }
}

/// Leaves out each row that depends on those before it.
fn independent<M: Model>(laws: &Laws<M>, point: &Point, taken: &mut Vec<usize>) {
    let rows = laws.model.rows(point.t, &point.x, &point.v);
    let mut kept: Vec<usize> = Vec::new();
    for &row in taken.iter() {
        kept.push(row);
        if laws.change(&rows, &kept, &[0.0; R]).is_none() {
            kept.pop();
        }
    }
    *taken = kept;
}
