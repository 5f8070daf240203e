//! Conclusions from the numbers.

use super::list::{
    ACCELERATIONS, INTEGRATE_8, List, METHODS, ODE_SOLVERS_8, PROJECTED, REAL_TIME, Row, SIMULATE_5, SIMULATE_8,
    STRONGLY, WEAKLY,
};
use super::report::setting;

/// Typical accuracy requirements in radians: for a picture, and for a design.
const WANTED: [f64; 2] = [1e-4, 1e-8];

/// The tolerance for the comparison with and without projection.
const TOLERANCE: f64 = 1e-10;

/// An angle with this error, in radians, belongs to another motion.
const LOST: f64 = 1.0;

/// The limit for tight tolerances.
const TIGHT: f64 = 1.01e-11;

/// The step for the comparison of formulations, in seconds.
pub const STEP: f64 = if cfg!(debug_assertions) { 4e-3 } else { 1e-3 };

/// A question with its answers and a remark.
pub struct Paragraph {
    pub question: String,
    pub answers: Vec<String>,
    pub remark: &'static str,
}

/// A paragraph for each question.
pub fn paragraphs(lists: &[List; 4]) -> [Paragraph; 4] {
    let [squeezer, windows, sprung, turning] = lists;
    [digits(&[squeezer, sprung, turning]), holding(&[squeezer, sprung, turning]), lost(windows), formulations(turning)]
}

fn digits(lists: &[&List]) -> Paragraph {
    let ours = [SIMULATE_8, SIMULATE_5];
    let others: Vec<usize> = (ODE_SOLVERS_8..REAL_TIME).collect();
    let said = |list: &List, methods: &[usize], wanted: f64| {
        let Some((row, outcome, price)) = list.cheapest(methods, wanted) else { return "no run".to_owned() };
        let (name, setting, time) =
            (METHODS[row.method].name, setting(row.method, row.setting), milliseconds(price.time));
        format!("{name} at {setting}, {time} and {} right-hand sides", outcome.evaluations)
    };
    let both = |list: &&List, wanted: f64| {
        let (ours, others) = (said(list, &ours, wanted), said(list, &others, wanted));
        format!("{}, {wanted:.0e} rad: {ours}; other crates: {others}.", list.title)
    };
    Paragraph {
        question: "Fastest run with a given error: simulate, and other crates on the right-hand side alone".to_owned(),
        answers: lists.iter().flat_map(|list| WANTED.map(|wanted| both(list, wanted))).collect(),
        remark: "Right-hand sides take most of the time with every integrator. The error at the end is partly chance: it may pass \
                 through zero.",
    }
}

fn holding(lists: &[&List]) -> Paragraph {
    let of_list = |list: &&List| {
        let (held, with) = list.at(SIMULATE_8, TOLERANCE)?;
        let (open, without) = list.at(INTEGRATE_8, TOLERANCE)?;
        let (ratio, held, open) = (with.time / without.time, metres(held.gap), metres(open.gap));
        Some(format!(
            "{}: {ratio:.2} times the time; residual {held}, without {open}; error {:.0e} rad, without {:.0e}.",
            list.title, with.error, without.error
        ))
    };
    Paragraph {
        question: format!(
            "The cost of projection onto the constraints: simulate compared with integrate, order 8 at {TOLERANCE:.0e}"
        ),
        answers: lists.iter().filter_map(of_list).collect(),
        remark: "The error depends on the tolerance, not on the projection, which makes positions satisfy the constraints, and \
                 detects singularities.",
    }
}

fn lost(list: &List) -> Paragraph {
    let told = |who: &str, of: &dyn Fn(&Row) -> bool| {
        let rows: Vec<&Row> = list.rows.iter().filter(|row| of(row)).collect();
        let errors: Vec<f64> =
            rows.iter().filter_map(|row| row.outcome.as_ref().ok()).map(|(_, price)| price.error).collect();
        let lost = errors.iter().filter(|&&error| error > LOST).count();
        format!(
            "{who}: of {} runs {} end there, {lost} elsewhere without an error, {} with an error.",
            rows.len(),
            errors.len() - lost,
            rows.len() - errors.len()
        )
    };
    let is_bare = |row: &Row| (INTEGRATE_8..REAL_TIME).contains(&row.method);
    Paragraph {
        question: format!("{}, through change points: runs that end within {LOST} rad", list.title),
        answers: vec![
            told("simulate", &|row| row.method <= SIMULATE_5),
            told("Integrators on the right-hand side alone, integrate included", &is_bare),
            told("The same, at 1e-11 and below", &|row| is_bare(row) && row.setting < TIGHT),
            told("RealTime", &|row| row.method == REAL_TIME),
            told("Multipliers, alone or weakly stabilised", &|row| [ACCELERATIONS, WEAKLY].contains(&row.method)),
            told("Multipliers, strongly stabilised or projected", &|row| [STRONGLY, PROJECTED].contains(&row.method)),
        ],
        remark: "Fixed steps with satisfied constraints pass a change point straight on as long as no step ends exactly \
                 there; they do not detect it.",
    }
}

fn formulations(list: &List) -> Paragraph {
    let of_method = |method: usize| {
        let (outcome, price) = list.at(method, STEP)?;
        let (name, time, gap) = (METHODS[method].name, milliseconds(price.time), metres(outcome.gap));
        Some(format!("{name}: {:.1e} rad in {time}, residual {gap}.", price.error))
    };
    let methods = [REAL_TIME, ACCELERATIONS, WEAKLY, STRONGLY, PROJECTED];
    let mut answers: Vec<String> = methods.into_iter().filter_map(of_method).collect();
    let at_the_error = list.at(REAL_TIME, STEP).and_then(|(_, price)| list.cheapest(&[SIMULATE_8], price.error));
    if let Some((row, _, price)) = at_the_error {
        let (setting, time) = (setting(row.method, row.setting), milliseconds(price.time));
        answers.push(format!("simulate reaches the error of RealTime at {setting}, in {time}."));
    }
    Paragraph {
        question: format!("{}, formulations at steps of {:.0} ms", list.title, 1e3 * STEP),
        answers,
        remark: "The multipliers are computed by one general elimination of the whole matrix in each right-hand side; code \
                 specialised for each mechanism would be faster.",
    }
}

fn milliseconds(seconds: f64) -> String {
    format!("{:.2} ms", 1e3 * seconds)
}

fn metres(gap: f64) -> String {
    if gap == 0.0 { "0 m".to_owned() } else { format!("{gap:.0e} m") }
}
