//! One mistake is one message, on its token: four programs, each with a mistake planted in its mechanism, give the
//! message of the macro and nothing of rustc, because types and functions stand there for the rest of the program.
//!
//! Each mistake has a snapshot: the text between `«` and `»` is the token. `text` compares all of them with the messages of the
//! library; one in ten, other ones for each commit, and those with a message of rustc itself go through rustc, all in the
//! outer ring.

mod mistakes;
mod text;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::iter::successors;
use std::path::Path;

use linkage_tests::programs::written;
use linkage_tests::turn;
use linkage_trials::is_outer;
use mistakes::{ENGINE, FOUR_BAR, Mistake, PENDULUM, PRESS};
pub use text::insides;

use super::checked::{self, compare};

/// A line and a column, from one.
type Place = (usize, usize);

/// A message of rustc or of the macro.
#[derive(Debug)]
struct Message {
    level: String,
    code: Option<String>,
    text: String,
    from: Place,
    to: Place,
}

/// The first program of the README, as a module.
fn readme() -> String {
    let readme = include_str!("../../../README.md");
    let program = readme.split("```rust,no_run\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    with(program, "fn main()", "pub fn main()")
}

/// A text with one replacement of what occurs once.
fn with(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "`{from}` in\n{text}");
    text.replacen(from, to, 1)
}

/// A program without the marks, and the places between each pair.
fn unmarked(text: &str) -> (String, Vec<(Place, Place)>) {
    let (mut plain, mut marks) = (String::new(), Vec::new());
    let (mut here, mut from) = ((1, 1), (1, 1));
    for letter in text.chars() {
        match letter {
            '«' => from = here,
            '»' => marks.push((from, here)),
            _ => {
                plain.push(letter);
                here = if letter == '\n' { (here.0 + 1, 1) } else { (here.0, here.1 + 1) };
            }
        }
    }
    (plain, marks)
}

/// The messages of rustc for each file.
fn messages(folder: &Path) -> BTreeMap<String, Vec<Message>> {
    let mut messages: BTreeMap<String, Vec<Message>> = BTreeMap::new();
    for message in checked::messages(folder, "src/lib.rs", "lib") {
        let (Some(level), Some(text)) = (message["level"].as_str(), message["message"].as_str()) else { continue };
        let spans = message["spans"].as_array().unwrap();
        let primary = spans.iter().find(|span| span["is_primary"] == true).unwrap_or_else(|| panic!("{message}"));
        // A span in the macro itself is that of its call.
        let mut calls = successors(Some(primary), |span| span["expansion"].get("span"));
        let found = calls.find_map(|span| {
            Some((span, span["file_name"].as_str()?.strip_prefix("src/")?.strip_suffix(".rs")?.to_owned()))
        });
        let (span, file) = found.unwrap_or_else(|| panic!("{message}"));
        let place = |line: &str, column: &str| [line, column].map(|key| span[key].as_u64().unwrap() as usize).into();
        messages.entry(file).or_default().push(Message {
            level: level.to_owned(),
            code: message["code"]["code"].as_str().map(str::to_owned),
            text: text.to_owned(),
            from: place("line_start", "column_start"),
            to: place("line_end", "column_end"),
        });
    }
    messages
}

/// The text between two places.
fn between(text: &str, from: Place, to: Place) -> String {
    let lines = text.lines().enumerate().skip(from.0 - 1).take(to.0 + 1 - from.0);
    let parts = lines.map(|(line, text)| {
        let start = if line + 1 == from.0 { from.1 } else { 1 };
        let end = if line + 1 == to.0 { to.1 } else { usize::MAX };
        text.chars().skip(start - 1).take(end - start).collect::<String>()
    });
    parts.collect::<Vec<_>>().join("\n")
}

/// A mistake as it is listed, and its messages.
fn entry((name, from, to): &Mistake, program: &str, messages: &[Message]) -> String {
    let line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut entry = format!("{name}: {}  ->  {}\n", line(from), line(to));
    for Message { level, code, text, from, to } in messages {
        let code = code.as_ref().map_or_else(String::new, |code| format!("[{code}]"));
        let token = line(&between(program, *from, *to));
        writeln!(entry, "  {}:{} `{token}` {level}{code}: {}", from.0, from.1, text.replace('\n', "\n    ")).unwrap();
    }
    entry
}

/// A program with a mistake planted in it.
struct Planted {
    /// The name of the program.
    list: &'static str,
    mistake: &'static Mistake,
    program: String,
    /// The tokens of its messages.
    marks: Vec<(Place, Place)>,
}

impl Planted {
    /// The name of its file.
    fn file(&self) -> String {
        format!("{}_{}", self.list, self.mistake.0)
    }
}

/// The programs by their names, with their mistakes.
fn lists() -> [(&'static str, String, &'static [Mistake]); 4] {
    [
        ("four_bar", readme(), FOUR_BAR),
        ("press", include_str!("programs/press.rs").to_owned(), PRESS),
        ("engine", include_str!("programs/engine.rs").to_owned(), ENGINE),
        ("pendulum", include_str!("programs/pendulum.rs").to_owned(), PENDULUM),
    ]
}

/// All mistakes, each planted in its program.
fn planted() -> Vec<Planted> {
    let of_list = |(list, program, mistakes): (&'static str, String, &'static [Mistake])| {
        let of_mistake = move |mistake: &'static Mistake| {
            let (program, marks) = unmarked(&with(&program, mistake.1, mistake.2));
            Planted { list, mistake, program, marks }
        };
        mistakes.iter().map(of_mistake)
    };
    lists().into_iter().flat_map(of_list).collect()
}

/// The programs are modules of one crate, so that one run of rustc checks them all; a mistake in `main` shows that
/// rustc goes on after the messages of the macro.
#[test]
fn one_mistake_is_one_message() {
    let mut files = Vec::new();
    let mut library = String::new();
    let mut write = |name: &str, text: &str| {
        files.push((format!("src/{name}.rs"), text.to_owned()));
        library += &format!("pub mod {name};\n");
    };
    let readme = readme();
    let also_in_main = with(&readme, "l3@theta3 + l4@", "l3@thta3 + l4@");
    write("also_in_main", &with(&also_in_main, "four_bar.velocity_ratios", "four_bar.velocity_rations"));
    let (lists, planted) = (lists(), planted());
    let turned = turn::of(planted.len(), if is_outer() { 1 } else { 10 });
    let is_checked = |(place, one): &(usize, &Planted)| turned(*place) || text::has_one_of_rust(one);
    let checked: Vec<&Planted> = planted.iter().enumerate().filter(is_checked).map(|(_, one)| one).collect();
    println!("{} of {} programs through rustc", checked.len(), planted.len());
    for (list, program, _) in &lists {
        write(list, program);
    }
    for one in &checked {
        write(&one.file(), &one.program);
    }
    files.push(("src/lib.rs".to_owned(), library));
    let found = messages(&written("one_message", files));
    let none = Vec::new();
    let of = |name: &str| found.get(name).unwrap_or(&none).as_slice();
    for (list, ..) in &lists {
        assert!(of(list).is_empty(), "{:?}", of(list));
    }
    let [first, second] = of("also_in_main") else { panic!("{:?}", of("also_in_main")) };
    assert!(first.text.starts_with("unknown name"), "{first:?}");
    assert_eq!(second.code.as_deref(), Some("E0599"), "{second:?}");
    let (mut entries, mut wrong) = (BTreeMap::<&str, Vec<(String, String)>>::new(), Vec::new());
    for one in &checked {
        let file = one.file();
        let entry = entry(one.mistake, &one.program, of(&file));
        let mut places: Vec<_> = of(&file).iter().map(|message| (message.from, message.to)).collect();
        places.sort_unstable();
        if places != one.marks {
            wrong.push(entry.clone());
        }
        entries.entry(one.list).or_default().push((one.mistake.0.to_owned(), entry));
    }
    for (list, entries) in &entries {
        let names = planted.iter().filter(|one| one.list == *list).map(|one| one.mistake.0);
        compare(list, entries, names);
    }
    assert!(
        wrong.is_empty(),
        "{} of {} have another number of messages or another token\n{}",
        wrong.len(),
        checked.len(),
        wrong.concat()
    );
}
