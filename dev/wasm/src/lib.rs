//! The numbers of the gallery as lines of text, to be compared bit for bit between targets: `vectors.tsv` has those of x86-64.
//!
//! A line is a name, the number of results, how many of them are no errors, and a checksum of their texts. Numbers in a text
//! have all digits and the signs of zeros; that of NaN is left open, as Rust leaves it. That emitted code and the interpreter
//! have the same bits on one target is a test in `tests/interpreted`.

mod at_run_time;
mod checksum;
// Random arguments, as the tests of the interpreter have them.
#[path = "../../../tests/interpreted/drawn.rs"]
mod drawn;
mod elementary;
mod emitted;
mod export;
// The mechanisms of the gallery, as the tests of the interpreter have them.
#[path = "../../../tests/at_run_time.rs"]
pub mod gallery;
mod simulated;

use checksum::Checksum;
use linkage_gallery::FILES;

/// Computes a part of the lines, by its place among others of its kind; returns its name.
type Kind = fn(usize, &mut Checksum) -> String;

fn kinds() -> [(usize, Kind); 4] {
    [
        (emitted::count(), emitted::computed),
        (FILES.len(), at_run_time::computed),
        (elementary::COUNT, elementary::computed),
        (simulated::COUNT, simulated::computed),
    ]
}

/// The number of lines.
#[must_use]
pub fn count() -> usize {
    kinds().iter().map(|(count, _)| count).sum()
}

/// A line by its place; none beyond the last.
#[must_use]
pub fn line(mut place: usize) -> Option<String> {
    for (count, computed) in kinds() {
        if place < count {
            let mut sum = Checksum::default();
            let name = computed(place, &mut sum);
            return Some(format!("{name}\t{sum}"));
        }
        place -= count;
    }
    None
}
