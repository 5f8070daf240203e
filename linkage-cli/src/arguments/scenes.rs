//! The arguments of simulations and of positions of equilibrium.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{ListForm, MOST_STEPS, Numbers, Shown};
use crate::values::{Assignment, Value};

/// A scene, with values of its parameters in `--set`.
#[derive(Args)]
pub struct Simulate {
    #[command(flatten)]
    pub numbers: Numbers,
    /// The scene [default: the only one]
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// The value of an input at the start [default: the middle of its declared range, or its only end; else 60deg; of a driven
    /// input: that of its law]
    #[arg(long, value_name = "INPUT=VALUE,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<Assignment>,
    /// The rate of an input at the start, such as 45rpm, or a plain number of radians per second [default: 0, of a driven
    /// input: that of its law]
    #[arg(long, value_name = "INPUT=VALUE,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub rate: Vec<Assignment>,
    /// The time of the start
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true, default_value = "0")]
    pub from: Value,
    /// The time of the end
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub to: Value,
    /// The number of equal steps of time between them
    #[arg(long, value_name = "NUMBER", default_value = "200", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=MOST_STEPS))]
    pub steps: u32,
    /// Print the steps of the integration and the events, instead of equal steps
    #[arg(long, conflicts_with = "steps")]
    pub own_steps: bool,
    /// The relative error of a step
    #[arg(long, value_name = "NUMBER", default_value = "1e-9")]
    pub tolerance: Value,
    /// The most steps of the integration, those included that are repeated
    #[arg(long, value_name = "NUMBER", default_value = "100000", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..))]
    pub most_steps: u32,
    #[command(flatten)]
    pub shown: Shown,
    /// The form of the result [default: by the ending of OUT; else csv, of a summary text]
    #[arg(long, value_enum)]
    pub format: Option<SimulationFormat>,
    /// The file to write, .csv, .json, .txt or .html; `-` for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SimulationFormat {
    /// A line for each row, for spreadsheets
    Csv,
    /// A list of numbers for each column, and the events
    Json,
    /// For readers, with columns below each other
    Text,
    /// A page of charts
    Html,
}

#[derive(Args)]
pub struct Equilibrium {
    #[command(flatten)]
    pub numbers: Numbers,
    /// The scene [default: the only one with `equilibrium;`]
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// The value of an input near which the position is [default: the middle of its declared range, or its only end; else 60deg]
    #[arg(long, value_name = "INPUT=VALUE,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<Assignment>,
    /// The time at which driven inputs have their values
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true, default_value = "0")]
    pub time: Value,
    #[command(flatten)]
    pub form: ListForm,
}
