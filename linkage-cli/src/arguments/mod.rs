//! The arguments of the program, with its help.

mod certify;
mod motions;
mod scenes;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use linkage_report::sheet;

use crate::values::{Assignment, Choice, Value};
pub use certify::Certify;
pub use motions::{Circuits, CircuitsFormat, Limits, ListForm, ListFormat};
pub use scenes::{Equilibrium, Simulate, SimulationFormat};

/// Planar linkages from their loop equations: formulas, checks and code of a mechanism in a file.
///
/// A file has mechanisms in the language of the macro `linkage!`, without the macro around them. `-` is standard input.
#[derive(Parser)]
#[command(name = "linkage", version, after_help = EXIT_CODES, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    a mistake in a text, no position, a file that cannot be read or written
  2    wrong arguments, or a name that the text does not have
  130  interrupted; files are as they were

Begin with:
  linkage new wiper.linkage
  linkage sheet wiper.linkage";

#[derive(Subcommand)]
pub enum Command {
    /// Write a first file to edit: a four-bar linkage that every command takes
    #[command(after_help = "Example:\n  linkage new wiper.linkage")]
    New(New),
    /// Find the mistakes of files, each with its line and its place in the line
    #[command(after_help = "Examples:\n  linkage check wiper.linkage\n  linkage check --format json *.linkage")]
    Check(Check),
    /// List the names of a mechanism: parameters, inputs, choices of --branch, points, outputs, columns of a table
    #[command(after_help = "Example:\n  linkage names wiper.linkage")]
    Names(Names),
    /// Write the derivation: equations, Jacobians, velocity ratios, accelerations, all as formulas
    #[command(
        after_help = "Examples:\n  linkage sheet wiper.linkage\n  linkage sheet wiper.linkage --at theta2=60deg -o wiper.tex"
    )]
    Sheet(Sheet),
    /// Print a motion as a table: coordinates, points and outputs with their velocities and accelerations
    #[command(after_help = "\
The first row that has the position asked for, by --branch or --guess, chooses the motion. It passes
change points smoothly, though links change their sides there; a message says at which inputs. All
rows are of this motion: those beyond its ends are empty, and a message says where it ends and why.

Examples:
  linkage table wiper.linkage --degrees --columns theta2,C_x,C_y > wiper.csv
  linkage table wiper.linkage --set l2=25 --branch theta3_theta4=right --rate 45rpm --format json")]
    Table(Table),
    /// Draw the mechanism at one position, as SVG or PNG
    #[command(after_help = "Example:\n  linkage draw wiper.linkage --at theta2=60deg -o wiper.png")]
    Draw(Draw),
    /// Draw a motion of the mechanism, as SVG that moves or as GIF
    #[command(after_help = "Example:\n  linkage animate wiper.linkage --set l2=25 --rate 45rpm -o wiper.gif")]
    Animate(Animate),
    /// Find the limits of an input: the motion through each position, its ends and why it ends there
    #[command(after_help = "\
Examples:
  linkage limits wiper.linkage
  linkage limits wiper.linkage --set l2=45 --at theta2=20deg --branch theta3_theta4=left")]
    Limits(Limits),
    /// Find the circuits: which positions are connected by motion, through dead points and change points
    #[command(after_help = "\
With --branch or --guess, only the circuit of that position at the first value is listed.

Examples:
  linkage circuits wiper.linkage
  linkage circuits wiper.linkage --set l2=45 --at theta2=20deg --format json
  linkage circuits wiper.linkage --set l2=45 -o circuits.html")]
    Circuits(Circuits),
    /// Simulate a scene: its motion in time, with loads and events, as a table or as a page of charts
    #[command(after_help = "\
Driven inputs have the value and the rate of their laws. Messages say when frictions stick, stops are hit
and the motion ends.

Examples:
  linkage simulate pendulum.linkage --at phi=30deg --to 10
  linkage simulate pendulum.linkage --at phi=30deg --rate phi=2 --to 10 --set c=0.1 -o swing.html")]
    Simulate(Simulate),
    /// Find the position at which the forces of a scene are in equilibrium, near the values of its inputs
    #[command(after_help = "Example:\n  linkage equilibrium lamp.linkage --at phi=30deg --set m=2")]
    Equilibrium(Equilibrium),
    /// Prove a motion: that it turns fully or goes through dead points, with bounds of all outputs, by interval arithmetic
    #[command(after_help = "\
The motion begins at --at or --from, at the position by --branch or --guess. Each printed number is proved
for all values of the input, rounding errors included. If there is no proof, the error says why.

Examples:
  linkage certify wiper.linkage
  linkage certify wiper.linkage --tolerance 0.1% --from 20deg --to 90deg
  linkage certify wiper.linkage --set l2=45 --curve")]
    Certify(Certify),
    /// Report mobility, all positions at one choice of inputs, circuits, and a motion with its extremes
    #[command(after_help = "\
--branch or --guess chooses the position whose motion is followed; without them it is the first.

Examples:
  linkage report wiper.linkage --at theta2=20deg
  linkage report wiper.linkage --set l2=25 -o wiper_report.html")]
    Report(Report),
    /// Print the Rust code that the macro `linkage!` makes of a file
    #[command(after_help = "Example:\n  linkage rust wiper.linkage -o wiper.rs")]
    Rust(Code),
    /// Open the page on a file in a browser: text, picture, sheet, charts and simulation, which follow the changes of the file
    #[command(after_help = "\
The address is printed. The page is for this machine only, and has this file only.

Example:
  linkage serve wiper.linkage")]
    Serve(Serve),
    /// Print the computed formulas as FPCore, for tools that say how many digits a formula loses
    #[command(after_help = "Example:\n  linkage fpcore wiper.linkage --mechanism Wiper")]
    Fpcore(Code),
    /// Print the completions of a shell
    #[command(after_help = "Example:\n  linkage completions bash > ~/.local/share/bash-completion/completions/linkage")]
    Completions {
        /// The shell
        shell: Shell,
    },
}

#[derive(Args)]
pub struct New {
    /// The name of the mechanism, or of the file; a file that exists is never replaced
    #[arg(value_name = "NAME|FILE")]
    pub name: PathBuf,
}

#[derive(Args)]
pub struct Check {
    /// The files; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// The form of the messages
    #[arg(long, value_enum, default_value_t = MessageFormat::Text)]
    pub format: MessageFormat,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MessageFormat {
    /// For readers, with the marked line
    Text,
    /// One array, for editors: file, line, column, length, text, help
    Json,
}

#[derive(Args)]
pub struct Names {
    #[command(flatten)]
    pub source: From,
    /// The form of the list
    #[arg(long, value_enum, default_value_t = NamesFormat::Text)]
    pub format: NamesFormat,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum NamesFormat {
    /// For readers
    Text,
    /// A list with an object for each mechanism
    Json,
}

#[derive(Args)]
pub struct Sheet {
    #[command(flatten)]
    pub numbers: Numbers,
    #[command(flatten)]
    pub place: Place,
    /// The rate of the first input, such as 45rpm: velocities and accelerations have numbers too
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub rate: Option<Value>,
    /// Numbers and picture follow sliders, in a browser and without network: for a page
    #[arg(long)]
    pub live: bool,
    /// The folder of the built page, for --live [default: web/dist of the project]
    #[arg(long, value_name = "DIR", requires = "live")]
    pub page: Option<PathBuf>,
    /// The form of the sheet [default: that of the ending of OUT, else html]
    #[arg(long, value_enum)]
    pub format: Option<SheetFormat>,
    /// The language of the sheet; names and doc comments are those of FILE
    #[arg(long, value_enum, default_value_t = Language::En)]
    pub language: Language,
    /// The file to write, .html, .tex or .txt; `-` for standard output [default: as FILE, with the ending of the form]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
}

#[derive(Args)]
pub struct Serve {
    /// The file that the page follows
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// The port of this machine; 0 for any that is free
    #[arg(long, default_value_t = 0)]
    pub port: u16,
    /// The folder of the built page [default: web/dist of the project]
    #[arg(long, value_name = "DIR")]
    pub page: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// English
    En,
    /// Italian
    It,
}

impl Language {
    /// The language of a sheet.
    pub fn of_sheet(self) -> sheet::Language {
        match self {
            Self::En => sheet::Language::English,
            Self::It => sheet::Language::Italian,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SheetFormat {
    /// A page for a browser
    Html,
    /// A document to typeset
    Latex,
    /// Plain text
    Text,
}

#[derive(Args)]
pub struct Report {
    #[command(flatten)]
    pub numbers: Numbers,
    #[command(flatten)]
    pub place: Place,
    /// The file to write, .html with pictures or .txt; `-` for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
}

#[derive(Args)]
pub struct Code {
    #[command(flatten)]
    pub source: From,
    /// The file to write, `-` for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
}

/// A file, and the mechanism that is meant.
#[derive(Args)]
pub struct From {
    /// The file; `-` is standard input
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// The mechanism, or the driver of one, if the file has several
    #[arg(long, value_name = "NAME")]
    pub mechanism: Option<String>,
}

/// A mechanism with numbers.
#[derive(Args)]
pub struct Numbers {
    #[command(flatten)]
    pub source: From,
    /// The value of a parameter, instead of its default
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub set: Vec<Assignment>,
    /// The position of a group that has several: a word such as left, or a number [default: the first]
    #[arg(long, value_name = "GROUP=SIDE,…", value_delimiter = ',')]
    pub branch: Vec<Choice>,
    /// The value near which an unknown is at the first position; of positions in closed form the nearest one is taken
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub guess: Vec<Assignment>,
}

impl Numbers {
    /// True if a branch or a guess chooses a position.
    pub fn choose(&self) -> bool {
        !self.branch.is_empty() || !self.guess.is_empty()
    }
}

/// One position.
#[derive(Args)]
pub struct Place {
    /// The value of an input [default: the middle of its declared range, or its only end; else 60deg]
    #[arg(long, value_name = "INPUT=VALUE,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<Assignment>,
}

/// The size of a picture.
#[derive(Args)]
pub struct Size {
    /// The width of the picture in pixels; its height follows
    #[arg(long, value_name = "PIXELS", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub width: Option<u32>,
}

/// A table of so many rows has a gigabyte.
const MOST_STEPS: i64 = 1_000_000;

/// One input moves, others are held.
#[derive(Args)]
pub struct Along {
    /// The value of an input that is held [default: the middle of its declared range, or its only end; else 60deg]
    #[arg(long, value_name = "INPUT=VALUE,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<Assignment>,
    /// The input that moves [default: the first that is not held]
    #[arg(long, value_name = "INPUT")]
    pub along: Option<String>,
    /// Its first value [default: the least of its declared range; of an angle: 0]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub from: Option<Value>,
    /// Its last value [default: the largest of its declared range; of an angle: 360deg]
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub to: Option<Value>,
    /// The number of equal steps between them
    #[arg(long, value_name = "NUMBER", default_value = "120", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=MOST_STEPS))]
    pub steps: u32,
}

/// The part of a table that is printed.
#[derive(Args)]
pub struct Shown {
    /// The columns to print, by name and in this order
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub columns: Vec<String>,
    /// Print the least and the largest value of each column, where they are, and their difference
    #[arg(long)]
    pub summary: bool,
    /// Print angles in degrees
    #[arg(long)]
    pub degrees: bool,
    /// Print at most so many digits [default: all, of text: 6]
    #[arg(long, value_name = "NUMBER")]
    pub digits: Option<usize>,
}

#[derive(Args)]
pub struct Table {
    #[command(flatten)]
    pub numbers: Numbers,
    #[command(flatten)]
    pub along: Along,
    /// The rate of the moving input, such as 45rpm, or a plain number of radians per second; time is then a column
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub rate: Option<Value>,
    #[command(flatten)]
    pub shown: Shown,
    /// The form of the table [default: by the ending of OUT; else csv, of a summary text]
    #[arg(long, value_enum)]
    pub format: Option<TableFormat>,
    /// The file to write, .csv, .json or .txt; `-` for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TableFormat {
    /// A line for each row, for spreadsheets
    Csv,
    /// A list of numbers for each column
    Json,
    /// For readers, with columns below each other
    Text,
}

#[derive(Args)]
pub struct Draw {
    #[command(flatten)]
    pub numbers: Numbers,
    #[command(flatten)]
    pub place: Place,
    #[command(flatten)]
    pub size: Size,
    /// The file to write, .svg or .png; `-` for standard output [default: as FILE, with .svg]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
}

#[derive(Args)]
pub struct Animate {
    #[command(flatten)]
    pub numbers: Numbers,
    #[command(flatten)]
    pub along: Along,
    /// The seconds that the film takes [default: 4]
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub seconds: Option<Value>,
    /// The rate of the moving input, such as 45rpm, instead of the seconds; forth and back, the mean one
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true, conflicts_with = "seconds")]
    pub rate: Option<Value>,
    /// Go from the first value to the last and back, as a film does that cannot go on from its end
    #[arg(long)]
    pub back_and_forth: bool,
    #[command(flatten)]
    pub size: Size,
    /// The file to write, .svg or .gif; `-` for standard output [default: as FILE, with .svg]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
}
