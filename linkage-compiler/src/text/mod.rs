//! Mechanisms from text at run time: the inside of one `linkage! { … }`, with the macro's own messages as data.
//!
//! [`read`] makes the checks that need no derivatives, [`compile`] runs all stages. Both take any text, also that of a
//! stranger: it has at most [`LONGEST`] bytes, [`MOST_TOKENS`] tokens, [`LONGEST_WORD`](syntax::LONGEST_WORD) letters in a
//! name or a number, and [`DEEPEST_NESTING`](syntax::DEEPEST_NESTING) levels of brackets. All further work is counted by a
//! [`Budget`]; one of a few million steps ends a text after seconds. An optimised build needs 256 KiB of stack. Nothing is
//! kept between texts.
//!
//! What is addressed to Rust has no effect: `pub`, attributes such as `#[derive(Clone)]`, `derive serde`. `#[cfg(…)]` is a
//! mistake, since a text has no configuration. An `extern fn` is declared and has no value here.
//!
//! The places of tokens are those of `proc-macro2`, which keeps them for each thread. They are cleared after a text, so that
//! spans made earlier on the same thread, those of a returned [`Mechanism`] among them, have no places any more: to ask one
//! for its line may panic in `proc-macro2`. Messages are made before. Neither function works within a procedural macro.

mod lexing;
mod message;
mod spans;

use proc_macro2::TokenStream;

pub use message::Message;

use crate::budget::Budget;
use crate::model::{Mechanism, Request};
use crate::{Checked, Facade, Invocation, Lowered, syntax};
use message::Places;
use spans::Spans;

/// The largest number of bytes of a text, comments among them.
pub const LONGEST: usize = 1 << 18;

/// The largest number of tokens of a text: seventy of Jansen's legs. The macro takes five times as many from those who pay for
/// the time; where each token is a mistake of its own, time and memory grow as their square.
pub const MOST_TOKENS: usize = 20_000;

/// A mechanism of a text.
pub struct Compiled<R> {
    pub mechanism: Mechanism,
    /// The results for its drivers, in their order.
    pub drivers: Vec<R>,
}

/// Reads the mechanisms of a text, and makes the checks that need no derivatives.
///
/// # Errors
/// The messages of all mistakes that these checks find, in the order of their places. A text that is too long, that is no
/// tokens, or that spends the budget has one message.
pub fn read(text: &str, budget: &Budget) -> Result<Vec<Mechanism>, Vec<Message>> {
    let mechanisms = within(text, budget, |_| Some(()))?;
    Ok(mechanisms.into_iter().map(|(mechanism, ())| mechanism).collect())
}

/// Compiles the mechanisms of a text, and applies a function to each driver, one after the other to limit memory.
///
/// The function is also called for drivers without mistakes in a text with some. It may compile another text.
///
/// # Errors
/// The messages that the macro gives for this text, in the order of their places.
pub fn compile<R>(text: &str, budget: &Budget, f: impl FnMut(Lowered) -> R) -> Result<Vec<Compiled<R>>, Vec<Message>> {
    compile_with(text, budget, &[], f)
}

/// Compiles the mechanisms of a text as [`compile`], as if each had these `derive` statements besides its own.
///
/// # Errors
/// Those of [`compile`].
pub fn compile_with<R>(
    text: &str,
    budget: &Budget,
    requests: &[Request],
    mut f: impl FnMut(Lowered) -> R,
) -> Result<Vec<Compiled<R>>, Vec<Message>> {
    let compiled = within(text, budget, |checked| {
        checked.mechanism.requests.extend(requests);
        checked.drivers(&mut f)
    })?;
    Ok(compiled.into_iter().map(|(mechanism, drivers)| Compiled { mechanism, drivers }).collect())
}

/// Applies a function, which may find mistakes, to each mechanism of a text; `None` after mistakes.
fn within<R>(
    text: &str,
    budget: &Budget,
    mut f: impl FnMut(&mut Checked) -> Option<R>,
) -> Result<Vec<(Mechanism, R)>, Vec<Message>> {
    // Editors of one system begin a file with it.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.len() > LONGEST {
        let message = format!("the text has {} bytes, more than {LONGEST}: split it", text.len());
        return Err(vec![Message::new((1, 1), 0, &message)]);
    }
    let _spans = Spans::begin();
    let tokens = lexing::tokens(text).map_err(|message| vec![message])?;
    let Some(places) = Places::new(text, &tokens) else {
        return Err(vec![Message::new((1, 1), 0, "the text has no mechanism: write `mechanism NAME { … }`")]);
    };
    if let Some((at, message)) = syntax::excess(&tokens, MOST_TOKENS) {
        return Err(vec![places.message(at, &message)]);
    }
    let Invocation { outside, mechanisms } = Invocation::read(tokens, &Facade::complete(&TokenStream::new()), budget);
    let mut messages = places.messages(&outside);
    let mut results = Vec::new();
    for mut checked in mechanisms {
        report_configuration(&mut checked);
        let result = if checked.is_clashing { None } else { f(&mut checked) };
        messages.extend(places.messages(&checked.diagnostics));
        results.extend(result.map(|result| (checked.mechanism, result)));
    }
    if messages.is_empty() {
        return Ok(results);
    }
    messages.sort();
    // As rustc does with equal messages at one place.
    messages.dedup();
    Err(messages)
}

/// Reports `#[cfg(…)]` before a mechanism.
fn report_configuration(checked: &mut Checked) {
    let configures = checked.mechanism.everywhere.iter().find(|attribute| attribute.path().is_ident("cfg"));
    if let Some(attribute) = configures {
        let message = "`cfg` has no meaning in a text, which is compiled for one machine: remove it";
        checked.diagnostics.error(syn::spanned::Spanned::span(attribute.path()), message);
    }
}
