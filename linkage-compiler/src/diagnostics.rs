//! Error messages, collected for each stage, each on the tokens of the mistake.

use std::collections::BTreeSet;

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};

/// The tokens from `first` to `last`.
#[derive(Debug, Clone, Copy)]
pub struct Region {
    pub first: Span,
    pub last: Span,
}

impl From<Span> for Region {
    fn from(span: Span) -> Self {
        Self { first: span, last: span }
    }
}

impl Region {
    #[must_use]
    pub fn to(self, end: Self) -> Self {
        Self { first: self.first, last: end.last }
    }
}

// `syn::Error::new_spanned` underlines from the first token to the last.
impl ToTokens for Region {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        for span in [self.first, self.last] {
            let mut mark = TokenTree::Punct(proc_macro2::Punct::new(';', proc_macro2::Spacing::Alone));
            mark.set_span(span);
            tokens.extend([mark]);
        }
    }
}

/// The messages of one stage.
#[derive(Debug, Default)]
pub struct Diagnostics {
    errors: Vec<syn::Error>,
}

impl Diagnostics {
    pub fn error(&mut self, at: impl Into<Region>, message: impl std::fmt::Display) {
        self.errors.push(syn::Error::new_spanned(at.into(), message));
    }

    pub fn push(&mut self, error: syn::Error) {
        self.errors.push(error);
    }

    pub fn extend(&mut self, errors: impl IntoIterator<Item = syn::Error>) {
        self.errors.extend(errors);
    }

    pub fn append(&mut self, mut other: Self) {
        self.errors.append(&mut other.errors);
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.errors.is_empty()
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.errors.len()
    }

    /// Replaces a message, at another place.
    pub fn replace(&mut self, index: usize, at: impl Into<Region>, message: impl std::fmt::Display) {
        if let Some(error) = self.errors.get_mut(index) {
            *error = syn::Error::new_spanned(at.into(), message);
        }
    }

    /// Removes the messages with these indices.
    pub fn remove(&mut self, indices: &BTreeSet<usize>) {
        let mut index = 0;
        self.errors.retain(|_| {
            index += 1;
            !indices.contains(&(index - 1))
        });
    }

    /// Keeps the first of several equal messages that satisfy a condition.
    pub fn keep_first(&mut self, is_it: impl Fn(&str) -> bool) {
        let mut known = BTreeSet::new();
        self.errors.retain(|error| {
            let text = error.to_string();
            !is_it(&text) || known.insert(text)
        });
    }

    /// Keeps the first `length` messages.
    pub fn truncate(&mut self, length: usize) {
        self.errors.truncate(length);
    }

    /// The messages as text, in order.
    #[must_use]
    pub fn messages(&self) -> Vec<String> {
        self.errors.iter().map(ToString::to_string).collect()
    }

    /// The messages with their tokens, in order.
    #[cfg(feature = "text")]
    pub(crate) fn errors(&self) -> &[syn::Error] {
        &self.errors
    }

    /// One `compile_error!` for each message.
    #[must_use]
    pub fn to_tokens(&self) -> TokenStream {
        let errors = self.errors.iter().map(syn::Error::to_compile_error);
        quote! { #(#errors)* }
    }
}

/// Returns ", did you mean `…`?" if a candidate resembles `name`, else nothing.
pub fn suggestion<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, candidates).map_or_else(String::new, did_you_mean)
}

/// The advice to write a similar name.
pub fn did_you_mean(candidate: &str) -> String {
    format!(", did you mean `{candidate}`?")
}

/// The longest name that is compared with others letter by letter, in letters.
const LONGEST_COMPARED: usize = 64;

/// Returns the candidate with the smallest edit distance to `name`, up to half of its letters and 3; equal but for case
/// comes first. One letter resembles nothing else, and a numbered name no other number.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let (length, lower) = (name.chars().count(), name.to_lowercase());
    // Half the letters may differ, at most three.
    let limit = (length / 2).min(3);
    let stem = stem(name);
    let distance = |candidate: &str| match lower == candidate.to_lowercase() {
        true => 0,
        false if candidate.chars().count() == 1 => usize::MAX,
        // `theta3` is meant when it is written, and so is `l3`.
        false if stem == self::stem(candidate) && stem.len() < name.len() => usize::MAX,
        false if stem.chars().count() <= 1 => usize::MAX,
        false if length > LONGEST_COMPARED => usize::MAX,
        false => strsim::osa_distance(name, candidate),
    };
    // Each letter more or less is an edit.
    let may_be_near = |candidate: &&str| candidate.chars().take(length + limit + 1).count().abs_diff(length) <= limit;
    let candidates = candidates.into_iter().filter(may_be_near);
    let distances = candidates.map(|candidate| (distance(candidate), candidate));
    let near = distances.filter(|(distance, _)| *distance <= limit);
    near.min_by_key(|(distance, _)| *distance).map(|(_, candidate)| candidate)
}

/// True if two names differ by one letter at most.
pub fn is_near(name: &str, other: &str) -> bool {
    let [length, of_other] = [name, other].map(|text| text.chars().count());
    length.abs_diff(of_other) <= 1
        && (name == other || length.max(of_other) <= LONGEST_COMPARED && strsim::osa_distance(name, other) <= 1)
}

/// A name without the number at its end.
fn stem(name: &str) -> &str {
    name.trim_end_matches(|letter: char| letter.is_ascii_digit())
}
