//! The results as text and as files.

use std::error::Error;
use std::rc::Rc;

use super::list::{ACCELERATIONS, List, METHODS, PROJECTED, REAL_TIME, Setting, WEAKLY, Work};
use super::problem::Problem;
use super::{fixed_steps, four_bars, integrators, page, problems, reading};
use crate::output;

/// The squeezer, the windows, the four-bar with a spring and the turning one.
pub struct Problems {
    pub squeezer: Rc<Problem<problems::Squeezing>>,
    pub windows: Rc<Problem<problems::TwoFalling>>,
    pub sprung: Rc<Problem<four_bars::Sprung>>,
    pub turning: Rc<Problem<four_bars::Turning>>,
}

impl Problems {
    pub fn all() -> Self {
        Self {
            squeezer: Rc::new(problems::squeezer()),
            windows: Rc::new(problems::windows()),
            sprung: Rc::new(four_bars::sprung()),
            turning: Rc::new(four_bars::turning()),
        }
    }

    /// All runs, in the order of the tables: by adaptive steps of this library, then of others, then by fixed steps.
    pub fn works(&self, others: [Vec<Work>; 4]) -> [Vec<Work>; 4] {
        let Self { squeezer, windows, sprung, turning } = self;
        let mut works = [
            integrators::works(squeezer),
            integrators::works(windows),
            integrators::works(sprung),
            integrators::works(turning),
        ];
        works.iter_mut().zip(others).for_each(|(works, others)| works.extend(others));
        works[0].extend(fixed_steps::works::<13, _, _>(squeezer, 250, [1e3, 1e4]));
        works[1].extend(fixed_steps::works::<9, _, _>(windows, 2500, [5.0, 50.0]));
        works[2].extend(fixed_steps::works::<5, _, _>(sprung, 1250, [5.0, 50.0]));
        works[3].extend(fixed_steps::works::<5, _, _>(turning, 5000, [5.0, 50.0]));
        works
    }
}

/// Times all runs, prints the results and writes the files.
pub fn write(works: [Vec<Work>; 4]) -> Result<(), Box<dyn Error>> {
    let is_patient = std::env::args().any(|argument| argument == "--patient");
    let rounds = match (cfg!(debug_assertions), is_patient) {
        (true, _) => 1,
        (false, false) => 9,
        (false, true) => 31,
    };
    let [squeezer, windows, sprung, turning] = works;
    let lists = [
        List::open(
            "Andrews' squeezing mechanism",
            "Seven bodies, 0.03 s. Baumgarte's alpha = beta = 1000/s and 10 000/s.",
            squeezer,
            rounds,
        ),
        List::open(
            "Two windows",
            "The N-four-bar, N = 2, 10 s: all bars are in line ten times, at change points, where the constraints alone do \
             not determine the motion. The right-hand sides of the steps of simulate over them are not counted. \
             Baumgarte's alpha = beta = 5/s and 50/s.",
            windows,
            rounds,
        ),
        List::open(
            "Four-bar with a spring",
            "Three bars and a spring, 5 s. Baumgarte's alpha = beta = 5/s and 50/s.",
            sprung,
            rounds,
        ),
        List::open(
            "Four-bar turning",
            "Three bars under their weight, 20 s, 44 turns. Baumgarte's alpha = beta = 5/s and 50/s.",
            turning,
            rounds,
        ),
    ];
    lists.iter().for_each(print);
    check(&lists);
    let reading = reading::paragraphs(&lists);
    for paragraph in &reading {
        println!("{}:", paragraph.question);
        paragraph.answers.iter().for_each(|answer| println!("- {answer}"));
        println!("{}\n", paragraph.remark);
    }
    if cfg!(debug_assertions) {
        println!("The times are for unoptimised code: run with --release.");
    }
    let html = page::html(&lists, &reading);
    let path = output::write("target/simulation_cost.html", &html)?;
    println!("Tables: {path}, {} kB", html.len() / 1000);
    Ok(())
}

fn print(list: &List) {
    println!("{}\n  {}", list.title, list.about);
    println!("    {:<32} {:>10} {:>9} {:>12} {:>10} {:>9}", "", "setting", "error", "right sides", "ms", "gap");
    let front = list.front();
    for (index, row) in list.rows.iter().enumerate() {
        let mark = if front.contains(&index) { '*' } else { ' ' };
        let (name, setting) = (METHODS[row.method].name, setting(row.method, row.setting));
        match &row.outcome {
            Ok((outcome, price)) => println!(
                "  {mark} {name:<32} {setting:>10} {:9.1e} {:12} {:10.3} {:9.1e}",
                price.error,
                outcome.evaluations,
                1e3 * price.time,
                outcome.gap
            ),
            Err(error) => println!("    {name:<32} {setting:>10} {}", error.lines().next().unwrap_or_default()),
        }
    }
    println!();
}

/// Checks relations that hold on every machine.
fn check([squeezer, _, sprung, turning]: &[List; 4]) {
    for list in [squeezer, sprung] {
        let costs = list.costs();
        let errors: Vec<f64> = list.front().iter().filter_map(|&index| costs[index]).map(|price| price.error).collect();
        assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "errors fall along the front");
        for row in list.rows.iter().filter(|row| row.method < REAL_TIME && row.setting < 2e-7) {
            let (name, error) = (METHODS[row.method].name, row.outcome.as_ref().map(|(_, price)| price.error));
            assert!(matches!(error, Ok(error) if error < 2e4 * row.setting), "{name} at {:e}: {error:?}", row.setting);
        }
    }
    let [open, held, projected] = [ACCELERATIONS, WEAKLY, PROJECTED].map(|method| {
        let (outcome, _) = turning.at(method, reading::STEP).expect("an end");
        (outcome.gap, outcome.error)
    });
    assert!(held.0 < 1e-2 * open.0 && held.1 < open.1, "Baumgarte stabilises: {held:?} {open:?}");
    assert!(
        projected.0 < 1e-2 * held.0 && projected.1 < held.1,
        "projection satisfies the constraints: {projected:?} {held:?}"
    );
}

/// A tolerance as a number, a step with its unit.
pub fn setting(method: usize, setting: f64) -> String {
    match METHODS[method].setting {
        Setting::Tolerance => format!("{setting:.0e}"),
        Setting::Step if setting < 1e-4 => format!("{:.3} µs", 1e6 * setting),
        Setting::Step => format!("{:.3} ms", 1e3 * setting),
    }
}
