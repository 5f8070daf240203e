//! Nanoseconds for position, velocity and acceleration: emitted code and the same mechanism at run time, one position by its
//! name, rows of numbers, and columns of many; medians of alternating rounds. Milliseconds from the text to the mechanism.
//!
//! `cargo bench --bench interpreted`

use std::hint::black_box;
use std::time::Instant;

use linkage_gallery::{four_bar, jansen, source};
use linkage_interpreter::{Data, Design, Program, Values};

const ROUNDS: usize = 21;
/// The positions of a column, and those that are computed by name.
const COUNT: usize = 20_000;
const BY_NAME: usize = 1000;

/// The nanoseconds for each of some calls.
fn time(count: usize, work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e9 / count as f64
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// A mechanism at run time, with the first solution of each group.
struct AtRunTime {
    text: String,
    design: Design,
    branch: Data,
    input: String,
    /// The columns of positions, rates and accelerations.
    found: Vec<String>,
}

impl AtRunTime {
    fn of(file: &str) -> Self {
        let text = source::text_of(file);
        let from = text.find("linkage! {").expect("one `linkage!`") + "linkage! {".len();
        let text = text[from..text.rfind('}').expect("its end")].to_owned();
        let program = Program::compile(&text).expect("it compiles");
        let design = program.mechanisms()[0].design();
        let [sides, ..] = design.mechanism().branch_fields();
        let branch = Data::fields(sides.iter().map(|(name, solutions)| (*name, Data::from(solutions[0]))));
        let input = design.given_columns().expect("columns")[design.parameters().len()].clone();
        let is_of_coordinates = |name: &&String| {
            ["cos_", "sin_"].iter().any(|start| name.starts_with(start))
                || ["_rate", "_acceleration"].iter().any(|end| name.ends_with(end))
        };
        let found = design.found_columns().expect("columns").iter().filter(is_of_coordinates).cloned().collect();
        Self { text, design, branch, input, found }
    }

    fn by_name(&self, inputs: &[f64]) {
        for input in inputs {
            let arguments = [Data::Number(*input), self.branch.clone(), Data::Number(1.0), Data::Number(0.5)];
            let _ = black_box(self.design.call("kinematics", &arguments));
        }
    }

    fn rows(&self, inputs: &[f64]) {
        let found: Vec<&str> = self.found.iter().map(String::as_str).collect();
        let rate = [format!("{}_rate", self.input), format!("{}_acceleration", self.input)];
        let given = [self.input.as_str(), &rate[0], &rate[1]];
        let mut row = self.design.row(&given, &self.branch, &found).expect("a row");
        let mut numbers = vec![0.0; found.len()];
        for input in inputs {
            let _ = black_box(row.find(&[*input, 1.0, 0.5], black_box(&mut numbers)));
        }
    }

    fn columns(&self, inputs: &[f64]) {
        let found: Vec<&str> = self.found.iter().map(String::as_str).collect();
        let rate = [format!("{}_rate", self.input), format!("{}_acceleration", self.input)];
        let given = [
            (self.input.as_str(), Values::Each(inputs)),
            (rate[0].as_str(), Values::Same(1.0)),
            (rate[1].as_str(), Values::Same(0.5)),
        ];
        black_box(self.design.columns(&given, &self.branch, &found).expect("columns"));
    }
}

/// The rows of a mechanism: `emitted` computes positions at these inputs.
fn rows(title: &str, file: &str, emitted: impl Fn(&[f64])) {
    let own = AtRunTime::of(file);
    let inputs: Vec<f64> = (0..COUNT).map(|place| place as f64 * 0.001).collect();
    let (mut emitted_times, mut by_name, mut in_rows, mut columns, mut compiled) =
        (vec![], vec![], vec![], vec![], vec![]);
    for _ in 0..ROUNDS {
        emitted_times.push(time(COUNT, || emitted(&inputs)));
        by_name.push(time(BY_NAME, || own.by_name(&inputs[..BY_NAME])));
        in_rows.push(time(COUNT, || own.rows(&inputs)));
        columns.push(time(COUNT, || own.columns(&inputs)));
        compiled.push(time(1, || {
            let _ = black_box(Program::compile(&own.text));
        }));
    }
    let [emitted, by_name, in_rows, columns, compiled] =
        [emitted_times, by_name, in_rows, columns, compiled].map(median);
    println!("{title}");
    println!("  emitted, one position     {emitted:8.1} ns");
    println!("  at run time, by its name  {by_name:8.1} ns, {:.1} times", by_name / emitted);
    println!("  at run time, as a row     {in_rows:8.1} ns, {:.1} times", in_rows / emitted);
    println!("  at run time, in a column  {columns:8.1} ns, {:.1} times", columns / emitted);
    println!("  from text                 {:8.1} ms", compiled / 1e6);
}

fn main() {
    rows("four-bar", "four_bar", |inputs| {
        let (m, branch) = (four_bar::FourBar::default(), four_bar::FourBarBranch::all().next().expect("a branch"));
        for input in inputs {
            let _ = black_box(m.kinematics(black_box(*input), branch, 1.0, 0.5));
        }
    });
    rows("Jansen's leg", "jansen", |inputs| {
        let (m, branch) = (jansen::Jansen::default(), jansen::JansenBranch::all().next().expect("a branch"));
        for input in inputs {
            let _ = black_box(m.kinematics(black_box(*input), branch, 1.0, 0.5));
        }
    });
}
