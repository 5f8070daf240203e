//! The arguments of limits and circuits.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Numbers, Place};
use crate::values::{Assignment, Value};

/// At each of so many values all positions are listed and followed.
const MOST_STARTS: i64 = 1000;

#[derive(Args)]
pub struct Limits {
    #[command(flatten)]
    pub numbers: Numbers,
    #[command(flatten)]
    pub place: Place,
    /// The input that moves [default: the first]
    #[arg(long, value_name = "INPUT")]
    pub along: Option<String>,
    #[command(flatten)]
    pub form: ListForm,
}

#[derive(Args)]
pub struct Circuits {
    #[command(flatten)]
    pub numbers: Numbers,
    /// The value of an input that is held, or of the one that moves: its positions there are listed [default: the
    /// middle of its declared range, or its only end; else 60deg. Positions are listed over the range]
    #[arg(long, value_name = "INPUT=VALUE,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<Assignment>,
    /// The input that moves [default: the first]
    #[arg(long, value_name = "INPUT")]
    pub along: Option<String>,
    /// The least value at which positions are listed [default: the least of its declared range; of an angle: 0]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub from: Option<Value>,
    /// The largest value at which positions are listed [default: the largest of its declared range; of an angle: 360deg]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub to: Option<Value>,
    /// The number of values between them at which positions are listed
    #[arg(long, value_name = "NUMBER", default_value = "12", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=MOST_STARTS))]
    pub starts: u32,
    /// The unknowns that charts have, one in each [default: all; in a picture alone, the first]
    #[arg(long, value_name = "UNKNOWN,…", value_delimiter = ',')]
    pub chart: Vec<String>,
    /// The form of the list [default: by the ending of OUT; else text]
    #[arg(long, value_enum)]
    pub format: Option<CircuitsFormat>,
    /// The file to write, .txt or .json, .html with charts or .svg with one; `-` for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum CircuitsFormat {
    /// For readers, angles in degrees
    Text,
    /// Objects, angles in radians
    Json,
    /// A page with charts
    Html,
    /// A chart
    Svg,
}

/// The form of a list, and its place.
#[derive(Args)]
pub struct ListForm {
    /// The form of the list [default: by the ending of OUT; else text]
    #[arg(long, value_enum)]
    pub format: Option<ListFormat>,
    /// The file to write, .txt or .json; `-` for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ListFormat {
    /// For readers, angles in degrees
    Text,
    /// Objects, angles in radians
    Json,
}
