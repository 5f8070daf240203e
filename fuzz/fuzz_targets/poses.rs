//! Calls of the public functions of mechanisms and scenes: no `Ok` contains a number that is not finite, no call takes
//! more than a stated number of evaluations, none panics.
#![no_main]

use std::sync::LazyLock;

use harness::{Source, Subject, Tally, listen};
use libfuzzer_sys::fuzz_target;
use linkage_fuzz::Bytes;

// `harness`, the calls and `subjects`, which the build script writes.
include!(concat!(env!("OUT_DIR"), "/subjects.rs"));

static SUBJECTS: LazyLock<Vec<(String, Subject)>> = LazyLock::new(subjects);

fuzz_target!(
    // The fuzzer's hook ends the process before the function is printed.
    init: listen(),
    |data: &[u8]| {
        let Some((&first, data)) = data.split_first() else { return };
        let (name, subject) = &SUBJECTS[usize::from(first) % SUBJECTS.len()];
        let mut tally = Tally::default();
        subject.try_out(&mut tally, &mut Source::new(Box::new(Bytes::new(data)), 0));
        if !tally.is_clean() {
            tally.tell(name);
            std::process::abort();
        }
    }
);
