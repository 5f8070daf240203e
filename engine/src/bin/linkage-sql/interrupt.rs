//! Interrupts while a file is written.

use std::fs;
use std::process;
use std::sync::mpsc;
use std::thread;

use futures::future::select_all;
use linkage_sweep::remove_unfinished;
use tokio::runtime::Builder;
use tokio::signal::unix::{SignalKind, signal};

/// Removes the part of a file that is written when the process is interrupted, terminated, or loses its terminal, and ends
/// the process with 128 and the number of the signal, as a shell does.
///
/// A thread of its own waits: the threads of the other runtime compute. It is there when this returns; without it, if there
/// are no threads left, an interrupt ends the process as always.
pub fn leave_no_part() {
    let (ready, is_ready) = mpsc::channel::<()>();
    thread::spawn(move || {
        let Ok(runtime) = Builder::new_current_thread().enable_io().build() else { return };
        runtime.block_on(async {
            let kinds = [SignalKind::interrupt(), SignalKind::terminate(), SignalKind::hangup()];
            let ignored = ignored();
            let heard = |kind: &SignalKind| ignored >> (kind.as_raw_value() - 1) & 1 == 0;
            let signals = kinds.into_iter().filter(heard).filter_map(|kind| Some((kind, signal(kind).ok()?)));
            let signals = signals.map(|(kind, mut signal)| {
                Box::pin(async move {
                    signal.recv().await;
                    kind
                })
            });
            let signals: Vec<_> = signals.collect();
            drop(ready);
            if signals.is_empty() {
                return;
            }
            let (kind, ..) = select_all(signals).await;
            remove_unfinished();
            process::exit(128 + kind.as_raw_value());
        });
    });
    // An error means that the sender is dropped: that is the sign.
    let _ = is_ready.recv();
}

/// The signals that the process was started to ignore, as by `nohup`: a bit for each, where Linux tells them.
fn ignored() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
