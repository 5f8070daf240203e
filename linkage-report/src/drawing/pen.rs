//! Compact SVG paths.

use std::fmt::Write;

use nalgebra::Vector2;

/// A number rounded to `decimals` decimals, without superfluous zeros: `.5` for 0.50.
pub(super) fn short(value: f64, decimals: usize) -> String {
    let mut text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    match text.as_str() {
        "-0" => "0".to_owned(),
        text => text.strip_prefix("0.").map_or_else(
            || text.strip_prefix("-0.").map_or_else(|| text.to_owned(), |part| format!("-.{part}")),
            |part| format!(".{part}"),
        ),
    }
}

/// A writer of path commands with relative coordinates. Each is relative to the rounded end of the last, so that
/// rounding errors do not accumulate.
#[derive(Default)]
pub(super) struct Pen {
    path: String,
    /// The end of the last command, as written.
    at: Vector2<f64>,
    /// The last command, which need not be repeated.
    command: Option<char>,
}

impl Pen {
    /// Writes a command to a point, rounded to tenths of a pixel, with other numbers before the point.
    fn step(&mut self, command: char, before: &[f64], to: Vector2<f64>) -> &mut Self {
        let to = to.map(|value| (value * 10.0).round() / 10.0);
        let (mut separate, steps) = (self.command == Some(command), to - self.at);
        if !separate {
            self.path.push(command);
        }
        for number in before.iter().chain(steps.iter()) {
            let text = short(*number, 1);
            if separate && !text.starts_with('-') {
                self.path.push(' ');
            }
            self.path.push_str(&text);
            separate = true;
        }
        (self.at, self.command) = (to, Some(command));
        self
    }

    pub(super) fn move_to(&mut self, to: Vector2<f64>) -> &mut Self {
        // A second pair after `m` would be a line, so every path begins with its own command.
        let first = self.path.is_empty();
        self.command = None;
        self.step(if first { 'M' } else { 'm' }, &[], to)
    }

    pub(super) fn line_to(&mut self, to: Vector2<f64>) -> &mut Self {
        self.step('l', &[], to)
    }

    /// An arc of at most half a turn, clockwise on the screen or not.
    pub(super) fn arc_to(&mut self, radius: f64, clockwise: bool, to: Vector2<f64>) -> &mut Self {
        self.step('a', &[radius, radius, 0.0, 0.0, f64::from(u8::from(clockwise))], to)
    }

    pub(super) fn lines(&mut self, points: &[Vector2<f64>]) -> &mut Self {
        for (index, point) in points.iter().enumerate() {
            if index == 0 {
                self.move_to(*point)
            } else {
                self.line_to(*point)
            };
        }
        self
    }

    /// A smooth curve through points at equal time steps: the tangent at each has the direction from the previous to
    /// the next point (Catmull and Rom, 1974).
    pub(super) fn curve(&mut self, points: &[Vector2<f64>]) -> &mut Self {
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return self };
        let closed = (first - last).amax() < 0.05;
        let steps = points.len() - 1;
        // The points counted from 1, with a neighbour before the first and after the last.
        let at = |place: usize| match place {
            0 if closed && steps > 0 => points[steps - 1],
            0 => *first,
            place if place <= points.len() => points[place - 1],
            _ if closed && steps > 0 => points[1],
            _ => *last,
        };
        self.move_to(*first);
        for place in 1..points.len() {
            // A cubic curve from `place` to the next; the command `s` continues the tangent of the previous one.
            let [before, from, to, after] = [-1_isize, 0, 1, 2].map(|offset| at(place.wrapping_add_signed(offset)));
            let [leave, arrive] =
                [from + (to - before) / 6.0, to - (after - from) / 6.0].map(|handle| handle - self.at);
            if place == 1 {
                self.step('c', &[leave.x, leave.y, arrive.x, arrive.y], to);
            } else {
                self.step('s', &[arrive.x, arrive.y], to);
            }
        }
        self
    }

    pub(super) fn circle(&mut self, centre: Vector2<f64>, radius: f64) -> &mut Self {
        let [left, right] = [-radius, radius].map(|x| centre + Vector2::new(x, 0.0));
        // After a closed path the pen is at its start.
        self.move_to(left).arc_to(radius, true, right).arc_to(radius, true, left)
    }

    pub(super) fn close(&mut self) -> &mut Self {
        // Writing to a string does not fail.
        let _ = self.path.write_char('z');
        self.command = None;
        self
    }

    /// The value of the attribute `d`.
    pub(super) fn path(&mut self) -> String {
        std::mem::take(self).path
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, -0.04, 0.25, -0.5, 12.0, 12.34, -100.0, 1e6];
        assert_eq!(numbers.map(|value| short(value, 1)), ["0", "0", ".2", "-.5", "12", "12.3", "-100", "1000000"]);
    }

    /// Quarters of a circle: the handles are a sixth of the chord between the neighbours, 0.333 radii; exact circles
    /// have 0.552.
    #[test]
    fn curves_pass_through_their_points() {
        let point = |x: f64, y: f64| Vector2::new(x, y);
        let circle = [point(9.0, 0.0), point(0.0, 9.0), point(-9.0, 0.0), point(0.0, -9.0), point(9.0, 0.0)];
        assert_eq!(Pen::default().curve(&circle).path(), "M9 0c0 3-6 9-9 9s-9-6-9-9 6-9 9-9 9 6 9 9");
        // An open curve ends straight.
        assert_eq!(Pen::default().curve(&circle[..2]).path(), "M9 0c-1.5 1.5-7.5 7.5-9 9");
        assert_eq!(Pen::default().curve(&circle[..1]).path(), "M9 0");
        assert_eq!(Pen::default().curve(&[]).path(), "");
    }

    #[test]
    fn steps_do_not_add_up_their_rounding() {
        let points: Vec<_> = (0..=300_u32).map(|step| Vector2::new(0.033 * f64::from(step), 0.0)).collect();
        let path = Pen::default().lines(&points).path();
        let steps = path.trim_start_matches("M0 0l").split(' ').map(|step| step.parse::<f64>().unwrap_or(f64::NAN));
        assert!((steps.sum::<f64>() - 9.9).abs() < 1e-9, "{path}");
    }
}
