//! The `derive` statements of a mechanism.

use std::collections::BTreeMap;

use proc_macro2::Span;

use crate::diagnostics::{Diagnostics, nearest};
use crate::syntax::{NO_DEFAULT, Statement, StatementKind};

/// A keyword of the statement `derive`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Request {
    /// The limits of each input.
    Limits,
    /// `q'''`, and the third derivatives of points and outputs.
    Jerk,
    /// d2u/dv dv, and the second derivatives of points and outputs.
    VelocityRatioDerivatives,
    /// du/dp, and the derivatives of points and outputs.
    Sensitivity,
    /// Many positions at once.
    Lanes,
    /// The joints and parts of a drawing.
    Drawing,
    /// Types that can be written and read.
    Serde,
    /// The formulas of the functions as FPCore.
    Fpcore,
    /// The formulas over numbers without order, such as intervals.
    Intervals,
    /// The formulas of an analysis by hand, line by line.
    Sheet,
}

impl Request {
    /// The keywords.
    pub const ALL: [(&str, Self); 10] = [
        ("limits", Self::Limits),
        ("jerk", Self::Jerk),
        ("velocity_ratio_derivatives", Self::VelocityRatioDerivatives),
        ("sensitivity", Self::Sensitivity),
        ("lanes", Self::Lanes),
        ("drawing", Self::Drawing),
        ("serde", Self::Serde),
        ("fpcore", Self::Fpcore),
        ("intervals", Self::Intervals),
        ("sheet", Self::Sheet),
    ];
}

/// Traits that a user may derive by an attribute before `mechanism`.
const TRAITS: [&str; 8] = ["Clone", "Copy", "Debug", "PartialEq", "Eq", "PartialOrd", "Ord", "Hash"];

/// The words after `unknown keyword`, about what the user may have meant.
fn hint(text: &str, meant: Option<&str>) -> String {
    match (text, meant) {
        ("Default", _) => format!("\n{NO_DEFAULT}"),
        (text, _) if TRAITS.contains(&text) => {
            format!("\n`{text}` is a trait: write `#[derive({text})]` before `mechanism`")
        }
        (_, Some(meant)) => format!(", did you mean `{meant}`?"),
        (_, None) => format!("\nkeywords: {}", Request::ALL.map(|(name, _)| name).join(", ")),
    }
}

/// Collects the keywords of the `derive` statements of a mechanism, with their places.
pub(super) fn resolve(
    statements: &[Statement],
    has_parameters: bool,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<Request, Span> {
    let mut requests = BTreeMap::new();
    let words = statements.iter().flat_map(|statement| match &statement.kind {
        StatementKind::Derive(words) => words.as_slice(),
        _ => &[],
    });
    for word in words {
        let text = word.to_string();
        let named = |word: &str| Request::ALL.iter().find(|(name, _)| word == *name);
        let names = Request::ALL.map(|(name, _)| name);
        let meant = nearest(&text, names);
        if named(&text).is_none() {
            let hint = hint(&text, meant);
            diagnostics.error(word.span(), format_args!("unknown keyword `{text}` after `derive`{hint}"));
        }
        let Some(&(_, request)) = named(&text).or_else(|| named(meant?)) else { continue };
        if requests.insert(request, word.span()).is_some() {
            diagnostics.error(word.span(), format_args!("`{text}` is named twice after `derive`; remove one"));
        }
        if request == Request::Sensitivity && !has_parameters {
            let advice = "`sensitivity` needs parameters, but this mechanism has no `param`";
            diagnostics.error(word.span(), advice);
        }
    }
    requests
}
