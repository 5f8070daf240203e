//! The arguments of the program, with its help.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

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
  1    a mistake in a text, a file that cannot be read or written
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
    /// Write the derivation: equations, Jacobians, velocity ratios, accelerations, all as formulas
    #[command(
        after_help = "Examples:\n  linkage sheet wiper.linkage\n  linkage sheet wiper.linkage --format latex -o wiper.tex"
    )]
    Sheet(Sheet),
    /// Print the Rust code that the macro `linkage!` makes of a file
    #[command(after_help = "Example:\n  linkage rust wiper.linkage -o wiper.rs")]
    Rust(Code),
    /// Print the computed formulas as FPCore, for tools that analyse rounding errors
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
pub struct Sheet {
    #[command(flatten)]
    pub source: From,
    /// The form of the sheet
    #[arg(long, value_enum, default_value_t = SheetFormat::Html)]
    pub format: SheetFormat,
    /// The file to write, `-` for standard output [default: as FILE, with the ending of the format]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
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
