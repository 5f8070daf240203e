//! The `derive` statements of a mechanism.

use std::collections::BTreeSet;

use crate::diagnostics::{Diagnostics, suggestion};
use crate::syntax::{Statement, StatementKind};

/// A keyword of the statement `derive`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Request {
    /// The limits of each input.
    Limits,
    /// q''', and the third derivatives of points and outputs.
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
}

impl Request {
    const ALL: [(&str, Self); 7] = [
        ("limits", Self::Limits),
        ("jerk", Self::Jerk),
        ("velocity_ratio_derivatives", Self::VelocityRatioDerivatives),
        ("sensitivity", Self::Sensitivity),
        ("lanes", Self::Lanes),
        ("drawing", Self::Drawing),
        ("serde", Self::Serde),
    ];
}

/// Collects the keywords of the `derive` statements of a mechanism.
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
                .error(word.span(), format_args!("unknown keyword `{text}` after `derive`{hint}\nkeywords: {all}"));
            continue;
        };
        if !requests.insert(request) {
            diagnostics.error(word.span(), format_args!("`{text}` is named twice after `derive`; remove one"));
        }
        if request == Request::Sensitivity && !has_parameters {
            let advice = "`sensitivity` needs parameters, but this mechanism has no `param`";
            diagnostics.error(word.span(), advice);
        }
    }
    requests
}
