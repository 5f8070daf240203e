//! The two directions of a dyad, whose angle is its transmission angle.
//!
//! J of a group has a column for each unknown. The column of an angle is the normal of its link, that of a length the
//! direction of its line, so that the angle between the columns is that between two links, between a link and the normal
//! of a guide, or between an arm and its slot. Of a point at two distances the rows are the directions of the links.

use linkage_runtime::derivation::GroupForm;
use linkage_runtime::{OutputMotion, Real};

use super::local::{Local, Vector};
use super::output_angles::has_name;

/// The kind of a dyad, with R for a joint that turns and P for one that slides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum DyadKind {
    /// Two links between three turning joints.
    Rrr,
    /// A link and a slider on a guide.
    Rrp,
    /// A slider on a guide that turns with its arm.
    Rpr,
    /// Two sliders.
    Sliders,
}

/// A group of two unknowns that is a dyad.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dyad {
    pub(super) kind: DyadKind,
    pub(super) rows: [usize; 2],
    pub(super) unknowns: [usize; 2],
    directions: Directions,
}

#[derive(Debug, Clone, Copy)]
enum Directions {
    /// The columns of J: the second less a multiple of the first, or the first less one of the second, if one angle is
    /// measured from the other link. A column is reversed where the sign is negative, as of a mirrored angle.
    Columns { multiples: [f64; 2], signs: [f64; 2] },
    /// The rows of J.
    Rows,
}

impl Dyad {
    /// The dyad of a group, if it is one.
    fn of(local: &Local<'_, '_>, group: usize) -> Option<Self> {
        let form = local.form(group)?;
        let (&[first, second], &[one, other]) = (local.equations(group), local.unknowns(group)) else { return None };
        let (rows, unknowns) = ([first, second], [one, other]);
        let of = |kind, directions| Self { kind, rows, unknowns, directions };
        let plain = Directions::Columns { multiples: [0.0; 2], signs: [1.0; 2] };
        match form {
            GroupForm::TwoAngles => Some(of(DyadKind::Rrr, of_angles(local, rows, unknowns))),
            GroupForm::TwoDistances => Some(of(DyadKind::Rrr, Directions::Rows)),
            GroupForm::AngleAndLength => Some(of(DyadKind::Rrp, plain)),
            GroupForm::AngleAndTurningLength => Some(of(DyadKind::Rpr, plain)),
            GroupForm::TwoLengths => Some(of(DyadKind::Sliders, plain)),
            _ => None,
        }
    }

    /// All dyads, each with its groups, in the order in which these are solved. A link and a slider whose guide is along an
    /// axis are two groups: the angle of the link follows from one coordinate, the slider from the other.
    pub(super) fn all(local: &Local<'_, '_>) -> Vec<(Vec<usize>, Self)> {
        let groups = 0..local.derivation.groups.len();
        let sliders = |link: usize| {
            let mut found = groups.clone().filter_map(move |slider| {
                let dyad = Self::of_slider(local, [link, slider])?;
                Some((vec![link, slider], dyad))
            });
            found.next()
        };
        let of_group = |group: usize| {
            if Self::is_cylinder(local, group) {
                return None;
            }
            let dyad = Self::of(local, group).map(|dyad| (vec![group], dyad));
            dyad.or_else(|| sliders(group))
        };
        groups.clone().filter_map(of_group).collect()
    }

    /// True for a length along a line through a pivot, whose angle is in no other equation and in no output: a cylinder. Its
    /// angle with the normal of its own line is 90 degrees everywhere, and no force is transmitted across it.
    pub(super) fn is_cylinder(local: &Local<'_, '_>, group: usize) -> bool {
        let (&[first, second], &[one, other]) = (local.equations(group), local.unknowns(group)) else { return false };
        if local.form(group) != Some(GroupForm::AngleAndTurningLength) {
            return false;
        }
        let (angle, length) = if local.is_angle(one) { (one, other) } else { (other, one) };
        let [arm, line] = [angle, length].map(|unknown| local.column(unknown, [first, second]));
        // The sum of the two products of the scalar one has an error of some ulps.
        let is_through_pivot = dot(arm, line).abs() <= 8.0 * f64::EPSILON * (dot(arm, arm) * dot(line, line)).sqrt();
        let derivation = local.derivation;
        let Some(symbol) = derivation.unknowns.get(angle) else { return false };
        let mut entries = derivation.jacobian_unknowns.entries.iter();
        let is_used = entries.any(|entry| entry.column == angle && entry.row != first && entry.row != second)
            || derivation.outputs.iter().flat_map(|output| output.value).any(|of| has_name(of.right, symbol.name));
        is_through_pivot && !is_used
    }

    /// The dyad of a link and a slider, each solved alone from one row of a loop.
    fn of_slider(local: &Local<'_, '_>, groups: [usize; 2]) -> Option<Self> {
        let forms = groups.map(|group| local.form(group));
        let [link, slider] = groups;
        let (&[row], &[angle]) = (local.equations(link), local.unknowns(link)) else { return None };
        let (&[other], &[length]) = (local.equations(slider), local.unknowns(slider)) else { return None };
        let is_pair = forms == [Some(GroupForm::OneAngle), Some(GroupForm::OneLinear)]
            && row.abs_diff(other) == 1
            && !local.is_angle(length)
            && local.derivation.jacobian_unknowns.entry(other, angle).is_some();
        let rows = [row, other];
        let column = local.column(angle, rows);
        let turning = local.unit(angle);
        let bend = local.mixed(&turning, &turning, rows);
        // The column of the angle of a link is i a, and Psi_aa = -a.
        let off = [less(bend, turned(column)), less(bend, scaled(turned(column), -1.0))].map(|off| dot(off, off));
        let is_link = off[0].min(off[1]) <= 1e-18 * dot(column, column);
        let directions = Directions::Columns { multiples: [0.0; 2], signs: [1.0; 2] };
        (is_pair && is_link).then_some(Self { kind: DyadKind::Rrp, rows, unknowns: [angle, length], directions })
    }

    /// True if the sides of the angle are known, so that it has a meaning up to 180 degrees: else only the acute one has.
    pub(super) fn has_sides(&self) -> bool {
        self.kind == DyadKind::Rrr && matches!(self.directions, Directions::Columns { .. })
    }

    /// The angle between 0 and pi, with its first derivative at these rates of unknowns and inputs; the second is not known.
    pub(super) fn angle(&self, local: &Local<'_, '_>, rates: &[f64]) -> OutputMotion {
        let column = |unknown: usize| local.column(unknown, self.rows);
        let moved = |unknown: usize| local.mixed(&local.unit(unknown), rates, self.rows);
        let [columns, derivatives] = [self.unknowns.map(column), self.unknowns.map(moved)];
        let sides = |[one, other]: [Vector; 2]| match self.directions {
            Directions::Rows => [[one[0], other[0]], [one[1], other[1]]],
            Directions::Columns { multiples: [of_second, of_first], signs } => [
                scaled(less(one, scaled(other, of_second)), signs[0]),
                scaled(less(other, scaled(one, of_first)), signs[1]),
            ],
        };
        let ([p, q], [p_rate, q_rate]) = (sides(columns), sides(derivatives));
        let (sine, cosine) = (cross(p, q), dot(p, q));
        let turning = cross(q, q_rate) / dot(q, q) - cross(p, p_rate) / dot(p, p);
        let (angle, rate) = (sine.abs().arctangent2(cosine), turning * sine.signum());
        let acceleration = f64::NAN;
        // Of a normals' angle the links have the supplement where they meet: one ends there, the other begins.
        match self.has_sides() {
            true => OutputMotion { value: std::f64::consts::PI - angle, rate: -rate, acceleration },
            false => OutputMotion { value: angle, rate, acceleration },
        }
    }
}

/// The directions of two angles: the links are a and b with the angles alpha + k beta and beta.
fn of_angles(local: &Local<'_, '_>, rows: [usize; 2], unknowns: [usize; 2]) -> Directions {
    let [one, other] = unknowns.map(|unknown| local.column(unknown, rows));
    let units = unknowns.map(|unknown| local.unit(unknown));
    let second = |a: usize, b: usize| local.mixed(&units[a], &units[b], rows);
    // Psi_ab = -k a, and the column of alpha is i a.
    let between = second(0, 1);
    let multiple = |column: Vector| {
        let normal = turned(column);
        let multiple = (dot(between, normal) / dot(normal, normal)).round();
        let rest = less(between, scaled(normal, multiple));
        (dot(rest, rest) <= 1e-18 * dot(normal, normal)).then_some(multiple)
    };
    let (of_second, of_first) = match (multiple(one), multiple(other)) {
        (Some(of_first), _) => (0.0, of_first),
        (None, Some(of_second)) => (of_second, 0.0),
        (None, None) => (0.0, 0.0),
    };
    let columns = [less(one, scaled(other, of_second)), less(other, scaled(one, of_first))];
    // a = -Psi_aa, where its angle alone is a.
    let straight = [second(0, 0), second(1, 1)].map(|bend| scaled(bend, -1.0));
    let links = [
        less(straight[0], scaled(straight[1], of_second * of_second)),
        less(straight[1], scaled(straight[0], of_first * of_first)),
    ];
    let signs = [0, 1].map(|side| if dot(turned(links[side]), columns[side]) < 0.0 { -1.0 } else { 1.0 });
    Directions::Columns { multiples: [of_second, of_first], signs }
}

/// A vector a quarter turn further.
pub(super) fn turned([x, y]: Vector) -> Vector {
    [-y, x]
}

pub(super) fn dot([a, b]: Vector, [c, d]: Vector) -> f64 {
    a * c + b * d
}

fn cross([a, b]: Vector, [c, d]: Vector) -> f64 {
    a * d - b * c
}

pub(super) fn scaled(vector: Vector, factor: f64) -> Vector {
    vector.map(|part| part * factor)
}

pub(super) fn less([a, b]: Vector, [c, d]: Vector) -> Vector {
    [a - c, b - d]
}
