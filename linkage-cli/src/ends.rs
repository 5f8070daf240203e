//! Ends and events of motions in words.

use linkage_runtime::RangeEnd;
use linkage_runtime::range_of_motion::MotionEnd;
use serde::Serialize;

/// The reason of an end.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case", tag = "reason")]
pub enum Reason {
    /// The input reverses.
    DeadPoint { group: String },
    /// Other motions cross.
    ChangePoint { group: String },
    /// The end of a declared range.
    Range { of: String, end: &'static str },
    /// The motion goes on too far to be followed, or is only asked for up to here.
    GoesOn,
}

impl Reason {
    /// The reason why a motion ends; none if it is closed.
    pub fn of(end: MotionEnd<&str>) -> Option<Self> {
        match end {
            MotionEnd::DeadPoint { group } => Some(Self::DeadPoint { group: group.to_owned() }),
            MotionEnd::ChangePoint { groups } => Some(Self::ChangePoint { group: groups.first().to_owned() }),
            MotionEnd::JointRange { of, end } => Some(Self::range(of, end)),
            MotionEnd::Range | MotionEnd::Open => Some(Self::GoesOn),
            MotionEnd::Closed { .. } => None,
        }
    }

    /// The reason where these groups are singular. Several of them at once are a change point of all: rounding errors decide which of
    /// them is met first, and at the mirrored end it may be another.
    pub fn where_singular(self, groups: &[String]) -> Self {
        match (self, groups) {
            (Self::DeadPoint { .. } | Self::ChangePoint { .. }, [others @ .., last]) if !others.is_empty() => {
                Self::ChangePoint { group: format!("{} and {last}", others.join("; ")) }
            }
            (reason, _) => reason,
        }
    }

    /// The reason of an end of a declared range.
    pub fn range(of: &str, end: RangeEnd) -> Self {
        let end = if end == RangeEnd::Least { "least" } else { "largest" };
        Self::Range { of: of.to_owned(), end }
    }

    pub fn in_words(&self) -> String {
        match self {
            Self::DeadPoint { group } => format!("dead point of {group}"),
            Self::ChangePoint { group } => format!("change point of {group}"),
            Self::Range { of, end } => format!("the {end} value of {of}"),
            Self::GoesOn => "it goes on".to_owned(),
        }
    }
}

/// A number for readers, an angle in degrees.
pub fn shown(value: f64, is_angle: bool) -> String {
    let (value, unit) = if is_angle { (value.to_degrees(), "°") } else { (value, "") };
    let digits = 7 - (value.abs().max(1e-3).log10().floor() as i32) - 1;
    let text = format!("{value:.*}", digits.clamp(0, 9) as usize);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{}{unit}", if text == "-0" { "0" } else { text })
}
