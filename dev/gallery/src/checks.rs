//! Checks of all mechanisms in one test: a failure names its mechanism and hides no other.

use std::any::Any;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use crate::listed::{self, Named};

/// Runs a check of each mechanism of a list, on all cores. `MECHANISM=four_bar`, a file or the name of a mechanism, in the
/// environment runs that one alone.
///
/// # Panics
/// If the check of a mechanism panics, with the messages of all that do; if `MECHANISM` is no mechanism.
pub fn each<'a, N: Named + ?Sized>(list: &[&'a N], check: impl Fn(&'a N) + Sync) {
    let chosen = chosen(list);
    let next = AtomicUsize::new(0);
    let failures = Mutex::new(Vec::new());
    let work = || {
        while let Some(one) = chosen.get(next.fetch_add(1, Ordering::Relaxed)) {
            if let Err(message) = outcome(*one, || check(one)) {
                failures.lock().expect("no panic while it is held").push(message);
            }
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from).min(chosen.len());
    thread::scope(|scope| (0..cores).for_each(|_| drop(scope.spawn(work))));
    report(failures.into_inner().expect("no panic while it is held"), chosen.len());
}

/// Runs a part of a check. If it panics, its message begins with the place.
///
/// # Panics
/// If the part does.
pub fn at<R>(place: impl Display, part: impl FnOnce() -> R) -> R {
    catch_unwind(AssertUnwindSafe(part))
        .unwrap_or_else(|payload| resume_unwind(Box::new(format!("{place}: {}", message(&*payload)))))
}

/// The mechanisms that the environment asks for.
fn chosen<'a, N: Named + ?Sized>(list: &[&'a N]) -> Vec<&'a N> {
    let Ok(asked) = std::env::var("MECHANISM") else { return list.to_vec() };
    let is_meant = |one: (&str, &str)| one.0 == asked || one.1 == asked;
    assert!(
        listed::all().iter().any(|one| is_meant((one.file(), one.name()))),
        "no mechanism `{asked}` in the gallery"
    );
    let chosen: Vec<_> = list.iter().copied().filter(|one| is_meant((one.file(), one.name()))).collect();
    if chosen.is_empty() {
        println!("`{asked}` is not in the list of this test");
    }
    chosen
}

/// The message of a check that panics, after the names of the mechanism.
fn outcome(of: &(impl Named + ?Sized), check: impl FnOnce()) -> Result<(), String> {
    let outcome = catch_unwind(AssertUnwindSafe(check));
    outcome.map_err(|payload| format!("{} of {}: {}", of.name(), of.file(), message(&*payload)))
}

/// The text that a panic carries.
fn message(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("a panic without a text")
}

/// Fails with the messages, if there are any.
fn report(failures: Vec<String>, of: usize) {
    assert!(failures.is_empty(), "{} of {of} mechanisms fail:\n{}", failures.len(), failures.join("\n"));
}
