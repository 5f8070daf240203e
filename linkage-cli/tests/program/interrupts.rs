//! An interrupt ends the program with code 130, and the old file is as it was.
#![cfg(unix)]

use std::io::Write;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::folder::Folder;

/// A chain of links, whose derivation takes longer than the pauses of these tests.
fn long() -> String {
    let numbers = 1..60;
    let list = |name: &str| numbers.clone().map(|of| format!("{name}{of}")).collect::<Vec<_>>().join(", ");
    let mut text = format!("mechanism Long {{ param {}; input {};", list("l"), list("phi"));
    for of in numbers.clone() {
        let sum = (1..=of).map(|of| format!("l{of}@phi{of}")).collect::<Vec<_>>().join(" + ");
        text += &format!("point P{of} = {sum};");
    }
    text + "derive velocity_ratio_derivatives, sensitivity, jerk; }"
}

fn interrupt(program: &Child) {
    let signal = Command::new("kill").args(["-INT", &program.id().to_string()]).status().unwrap();
    assert!(signal.success());
}

#[test]
fn while_it_waits_for_input() {
    let folder = Folder::new();
    let mut command = folder.command("check -");
    let mut program = command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let mut input = program.stdin.take().unwrap();
    input.write_all(b"mechanism").unwrap();
    sleep(Duration::from_millis(300));
    interrupt(&program);
    assert_eq!(program.wait().unwrap().code(), Some(130));
}

#[test]
fn while_it_derives() {
    let folder = Folder::new();
    folder.write("long.linkage", long());
    folder.write("long.txt", "old");
    let mut command = folder.command("sheet long.linkage --format text");
    let mut program = command.stdin(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    sleep(Duration::from_millis(300));
    interrupt(&program);
    assert_eq!(program.wait().unwrap().code(), Some(130));
    assert_eq!((folder.read("long.txt"), folder.names().len()), ("old".to_owned(), 2));
}
