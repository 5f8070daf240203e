//! The lines of `vectors.tsv` on this machine.
//!
//! `UPDATE=1 cargo test -p linkage-wasm` writes them.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::{env, fs, iter, thread};

#[test]
fn vectors() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/vectors.tsv");
    let next = AtomicUsize::new(0);
    let work = || -> Vec<(usize, String)> {
        let places = iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
        places.map_while(|place| Some((place, linkage_wasm::line(place)?))).collect()
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let mut lines = thread::scope(|scope| {
        let all: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        all.into_iter().flat_map(|one| one.join().expect("no panic")).collect::<Vec<_>>()
    });
    lines.sort();
    let found: String = lines.into_iter().map(|(_, line)| line + "\n").collect();
    if env::var_os("UPDATE").is_some() {
        fs::write(path, &found).expect("a file that can be written");
    }
    let committed = fs::read_to_string(path).expect("the lines");
    let differences: Vec<_> = found.lines().zip(committed.lines()).filter(|(one, other)| one != other).collect();
    assert!(differences.is_empty() && found.len() == committed.len(), "{differences:#?}");
}
