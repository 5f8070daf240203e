//! What a mechanism asks for beyond what every mechanism has.

use std::collections::BTreeSet;

use crate::diagnostics::{Diagnostics, suggestion};
use crate::syntax::{Statement, StatementKind};

/// A word of the statement `derive`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Request {
    /// The interval of each input.
    Limits,
    /// q''', and that of points and outputs.
    Jerk,
    /// d2u/dv dv, and that of points and outputs.
    VelocityRatioDerivatives,
    /// du/dp, and that of points and outputs.
    Sensitivity,
}

impl Request {
    const ALL: [(&str, Self); 4] = [
        ("limits", Self::Limits),
        ("jerk", Self::Jerk),
        ("velocity_ratio_derivatives", Self::VelocityRatioDerivatives),
        ("sensitivity", Self::Sensitivity),
    ];
}

/// Everything that the `derive` statements of a mechanism name.
pub(super) fn resolve(
    statements: &[Statement],
    has_parameters: bool,
    diagnostics: &mut Diagnostics,
) -> BTreeSet<Request> {
    let mut requests = BTreeSet::new();
    let words = statements.iter().flat_map(|statement| match &statement.kind {
        StatementKind::Derive(words) => words.as_slice(),
        _ => &[],
    });
    for word in words {
        let text = word.to_string();
        let known = Request::ALL.iter().find(|(name, _)| text == *name);
        let Some(&(_, request)) = known else {
            let names = Request::ALL.map(|(name, _)| name);
            let (hint, all) = (suggestion(&text, names), names.join(", "));
            diagnostics
                .error(word.span(), format_args!("nothing to derive is called `{text}`{hint}\nthere are: {all}"));
            continue;
        };
        if !requests.insert(request) {
            diagnostics.error(word.span(), format_args!("`{text}` is derived already; name it once"));
        }
        if request == Request::Sensitivity && !has_parameters {
            let advice = "nothing to be sensitive to: this mechanism has no `param`";
            diagnostics.error(word.span(), advice);
        }
    }
    requests
}
