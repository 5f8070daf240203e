//! Samples that turn with the commit: in as many commits as it leaves out of one, each place is once in the sample.

/// True for one in so many of `count` places; for all of them, if they are few.
pub fn of(count: usize, every: usize) -> impl Fn(usize) -> bool {
    let every = every.clamp(1, count.max(1));
    let first = usize::try_from(linkage_trials::seed(0) % every as u64).unwrap_or_default();
    move |place| place % every == first
}
