//! Files that are no texts, and files that cannot be written: one message each, and nothing is lost.

use std::fs::{self, File};
use std::process::Stdio;

use super::folder::{Folder, SLIDER_CRANK};

#[test]
fn files_that_are_no_texts() {
    let folder = Folder::new();
    folder.write("empty.linkage", "");
    folder.write("notes.linkage", "// Nothing yet.\n");
    folder.write("latin.linkage", b"mechanism M {\n    // \xc3\xa9 \xe9\n}\n");
    folder.write("wide.linkage", b"\xff\xfem\0e\0");
    folder.write("zeros.linkage", [0; 64]);
    File::create(folder.path("huge.linkage")).unwrap().set_len(1 << 40).unwrap();
    fs::create_dir(folder.path("folder")).unwrap();
    let mut all = String::new();
    for name in ["empty", "notes", "latin", "wide", "zeros", "huge", "empt"] {
        let ran = folder.run(&format!("check {name}.linkage"));
        assert_eq!((ran.code, ran.output.as_str()), (Some(1), ""), "{name}");
        assert_eq!(ran.messages.matches(".linkage:").count(), 1, "{}", ran.messages);
        all += &ran.messages;
    }
    all += &folder.run("check folder").messages;
    all += &folder.run("sheet folder").messages;
    insta::assert_snapshot!("files_that_are_no_texts", all);
}

#[test]
fn a_mark_at_the_beginning_and_other_ends_of_lines() {
    let folder = Folder::new();
    folder.write("windows.linkage", format!("\u{feff}{}", SLIDER_CRANK.replace('\n', "\r\n")));
    folder.run("check windows.linkage").works("");
}

#[test]
fn wrong_arguments() {
    let folder = Folder::new();
    for arguments in ["", "check", "shet a", "sheet a --format pdf", "completions basic", "check --fromat json a"] {
        let ran = folder.run(arguments);
        assert_eq!((ran.code, ran.output.as_str()), (Some(2), ""), "{arguments}");
    }
    assert!(folder.run("shet a").messages.contains("'sheet'"));
}

/// The tip of a wrong argument is what to write instead, or where it belongs.
#[test]
fn tips_of_wrong_arguments() {
    let folder = Folder::new();
    folder.write("a.linkage", SLIDER_CRANK);
    for (arguments, tip) in [
        ("shet a.linkage", "a similar subcommand exists: 'sheet'"),
        ("a.linkage", "a command comes before the file, as in `linkage check a.linkage`"),
        ("table a.linkage --deg", "write `--degrees`"),
        ("draw a.linkage --branhc x=1", "write `--branch`"),
        ("draw a.linkage -at phi=1", "write `--at`"),
        ("draw a.linkage --degrees", "`--degrees` is an argument of `linkage table`, `linkage simulate`"),
        ("rust a.linkage --columns x", "`--columns` is an argument of `linkage table`, `linkage simulate`"),
        ("table a.linkage -90deg", "a value follows its argument, as in `--from -90deg`"),
        ("draw a.linkage --set r 2", "write `--set r=2`"),
        ("draw a.linkage r=2", "the value of a parameter is written `--set r=2`, that of an input `--at r=2`"),
        ("draw a.linkage --r 2", "the value of a parameter is written `--set r=2`, that of an input `--at r=2`"),
        ("draw a.linkage --r=2", "the value of a parameter is written `--set r=2`, that of an input `--at r=2`"),
        ("draw a.linkage a.linkage", "`linkage draw` takes one file"),
        ("table a.linkage --steps 1.5", "write a whole number, such as `120`"),
        ("animate a.linkage --png", ""),
    ] {
        let ran = folder.run(arguments);
        assert_eq!((ran.code, ran.output.as_str()), (Some(2), ""), "{arguments}");
        let tips: Vec<&str> = ran.messages.lines().filter_map(|line| line.strip_prefix("  tip: ")).collect();
        assert_eq!(tips.concat(), tip, "{arguments}: {}", ran.messages);
    }
}

#[test]
fn outputs_that_cannot_be_written() {
    let folder = Folder::new();
    folder.write("slider.linkage", SLIDER_CRANK);
    fs::create_dir(folder.path("folder")).unwrap();
    folder.write("kept.rs", "old");
    let mut locked = fs::metadata(folder.path("kept.rs")).unwrap().permissions();
    locked.set_readonly(true);
    fs::set_permissions(folder.path("kept.rs"), locked).unwrap();
    for (place, why) in [
        ("there/a.rs", "its folder does not exist"),
        ("slider.linkage/a.rs", "its folder does not exist"),
        ("folder", "it is a folder"),
        ("kept.rs", "you may not write there"),
    ] {
        let message = format!("error: {place} is not written: {why}\n");
        folder.run(&format!("rust slider.linkage -o {place}")).fails(1, &message);
    }
    assert_eq!(folder.read("kept.rs"), "old");
    assert_eq!(folder.names(), ["folder", "kept.rs", "slider.linkage"]);
    assert_eq!(fs::read_dir(folder.path("folder")).unwrap().count(), 0);
    folder.run("new there/wiper").fails(1, "error: there/wiper.linkage is not written: its folder does not exist\n");
}

#[test]
fn a_source_is_never_replaced() {
    let folder = Folder::new();
    folder.write("slider.txt", SLIDER_CRANK);
    let message = "error: slider.txt would replace what it is made of: write another name with -o\n";
    folder.run("sheet slider.txt --format text").fails(2, message);
    folder.run("rust slider.txt -o ./slider.txt").fails(2, &message.replace("slider.txt", "./slider.txt"));
    assert_eq!(folder.read("slider.txt"), SLIDER_CRANK);
}

/// The reader of the output goes away before it has all.
#[test]
fn a_broken_pipe_ends_quietly() {
    let folder = Folder::new();
    folder.write("slider.linkage", SLIDER_CRANK);
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut command = folder.command("rust slider.linkage");
    let program = command.stdout(writer).stderr(Stdio::piped()).spawn().unwrap();
    let ended = program.wait_with_output().unwrap();
    assert_eq!((ended.status.code(), ended.stderr.as_slice()), (Some(0), &b""[..]));
}

#[cfg(unix)]
#[test]
fn a_link_a_pipe_and_permissions_stay() {
    use std::os::unix::fs::{PermissionsExt, symlink};

    let folder = Folder::new();
    folder.write("slider.linkage", SLIDER_CRANK);
    folder.write("real.rs", "old");
    fs::set_permissions(folder.path("real.rs"), fs::Permissions::from_mode(0o640)).unwrap();
    symlink(folder.path("real.rs"), folder.path("link.rs")).unwrap();
    folder.run("rust slider.linkage -o link.rs").works("wrote link.rs\n");
    assert!(fs::symlink_metadata(folder.path("link.rs")).unwrap().is_symlink());
    assert!(folder.read("real.rs").contains("struct Crank"));
    assert_eq!(fs::metadata(folder.path("real.rs")).unwrap().permissions().mode() & 0o777, 0o640);
    folder.run("rust slider.linkage -o /dev/null").works("wrote /dev/null\n");
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
    // As any new file, not only for its owner.
    folder.run("rust slider.linkage -o new.rs").works("wrote new.rs\n");
    File::create(folder.path("other.rs")).unwrap();
    let mode = |name: &str| fs::metadata(folder.path(name)).unwrap().permissions().mode();
    assert_eq!(mode("new.rs"), mode("other.rs"));
}

/// Names of files and arguments are no commands to a terminal.
#[test]
fn control_characters_are_shown() {
    let folder = Folder::new();
    folder.write("red\u{1b}[31m.linkage", "mechanism M { param a = 1; input t; point P = a@t; oops }");
    let run = |arguments: &[&str]| {
        let output = folder.command("check").args(arguments).output().unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    let mistakes = run(&["red\u{1b}[31m.linkage"]);
    assert!(mistakes.starts_with("red␛[31m.linkage:1:52: unknown statement `oops`"), "{mistakes}");
    assert!(run(&["other\u{1b}[31m.linkage"]).contains("other␛[31m.linkage"));
    assert!(!run(&["--set\u{1b}[31m"]).contains('\u{1b}'));
}

/// Hints that a text without Rust can follow, in one message each.
#[test]
fn hints_are_those_of_a_text() {
    let folder = Folder::new();
    let mistakes = |text: &str| {
        folder.write("m.linkage", text);
        let ran = folder.run("check m.linkage");
        let lines = ran.messages.lines().filter(|line| line.starts_with("m.linkage:"));
        lines.map(|line| line.splitn(4, ':').last().unwrap().trim().to_owned()).collect::<Vec<_>>()
    };
    let scene = |rest: &str| format!("mechanism M {{ param m = 1, k = 0.1; input x; {rest} scene S {{ inertia; }} }}");
    assert_eq!(mistakes("mechanism M { param a = 1; }"), ["this mechanism has no input: declare one with `input`"]);
    assert_eq!(
        mistakes("mechanism M { param A = (0, 0); input t; point P = 1@t + A; }"),
        ["a parameter is a number: write `let A = (x, y);`, perhaps with a parameter for each part"]
    );
    assert_eq!(
        mistakes("mechanism M { param a = 1; input mut t; point P = a@t; }")[0],
        "a name has no `mut`: leave it out"
    );
    assert_eq!(
        mistakes(&scene("point G3 = (x, 0); body b { mass m*k; center G; }")),
        ["unknown name `G`, did you mean `G3`?"]
    );
    assert_eq!(
        mistakes(&scene("body b { mass m - k*t; center (x, 0); }")),
        ["`t` (time) can be used only in the laws of a scene: what a body has depends on its position alone"]
    );
    let functions = "mechanism M { param a = 1; input t; output o = max(a*t, 1); output p = if t { a } else { 0 }; }";
    assert_eq!(
        mistakes(functions),
        ["unknown function `max`: it has no derivative everywhere", "`if` cannot be part of an expression"]
    );
    folder.write("f.linkage", "mechanism F { extern fn f(x) -> (f, df, ddf); input t; output o = f(t); }");
    let note = "f.linkage: note: `F` calls `f`, which a program in Rust has to give it: here it has no numbers\n";
    folder.run("check f.linkage").works(note);
}
