//! The arguments of certificates.

use std::str::FromStr;

use clap::Args;

use super::{ListForm, Numbers, Place};
use crate::values::Value;

#[derive(Args)]
pub struct Certify {
    #[command(flatten)]
    pub numbers: Numbers,
    #[command(flatten)]
    pub place: Place,
    /// The input that moves [default: the first]
    #[arg(long, value_name = "INPUT")]
    pub along: Option<String>,
    /// The value at which the motion begins [default: that of --at, or the least one of a declared range]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub from: Option<Value>,
    /// The value at which the motion ends [default: the largest one of a declared range; of another angle after a full turn]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub to: Option<Value>,
    /// The number of full turns [default: 1]; wheels are at their start again after several
    #[arg(long, value_name = "NUMBER", conflicts_with = "to", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub turns: Option<u32>,
    /// Certify the motion as a closed curve, through dead points where the input turns back
    #[arg(long, conflicts_with_all = ["to", "turns"])]
    pub curve: bool,
    /// Certify all mechanisms whose parameters differ by at most this part of each, such as 0.1%
    #[arg(long, value_name = "PART")]
    pub tolerance: Option<Part>,
    #[command(flatten)]
    pub form: ListForm,
}

/// A part of a number: `0.1%` or `0.001`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part(pub f64);

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (number, of) = text.strip_suffix('%').map_or((text, 1.0), |number| (number, 100.0));
        let part = number.trim().parse::<f64>().ok().map(|number| number / of);
        let part = part.filter(|part| (0.0..1.0).contains(part));
        part.map(Self).ok_or_else(|| "write a part from 0 to less than 1, such as `0.1%` or `0.001`".to_owned())
    }
}
