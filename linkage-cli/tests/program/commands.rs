//! Each command and its results.

use super::folder::{Folder, SLIDER_CRANK, WRONG};

/// The first file is right for every command, and is never replaced.
#[test]
fn the_first_file_works_with_every_command() {
    let folder = Folder::new();
    assert_eq!(folder.run("new wind-screen_wiper").works("wrote wind-screen_wiper.linkage\n"), "");
    let first = folder.read("wind-screen_wiper.linkage");
    assert!(first.contains("mechanism WindScreenWiper {") && first.contains("linkage check wind-screen_wiper.linkage"));
    folder
        .run("new wind-screen_wiper.linkage")
        .fails(1, "error: wind-screen_wiper.linkage is not written: it exists; write another name\n");
    let checked = folder.run("check wind-screen_wiper.linkage").works("");
    let line = "WindScreenWiper: no mistakes; 1 degree of freedom, 3 points, 1 output\n";
    assert_eq!(checked, format!("wind-screen_wiper.linkage: {line}"));
    folder.run("sheet wind-screen_wiper.linkage").works("wrote wind-screen_wiper.html\n");
    assert!(folder.read("wind-screen_wiper.html").starts_with("<!DOCTYPE html>"));
    assert!(folder.run("rust wind-screen_wiper.linkage").works("").contains("struct WindScreenWiper<"));
    assert!(folder.run("fpcore wind-screen_wiper.linkage").works("").starts_with("(FPCore ("));
    assert_eq!(folder.read("wind-screen_wiper.linkage"), first);
    assert_eq!(folder.names(), ["wind-screen_wiper.html", "wind-screen_wiper.linkage"]);
}

#[test]
fn a_name_that_is_no_name_of_a_mechanism() {
    let folder = Folder::new();
    for (name, why) in [("4bar", "4Bar"), ("self", "Self"), ("-.linkage", "")] {
        let ran = folder.run(&format!("new -- {name}"));
        assert_eq!((ran.code, folder.names()), (Some(2), Vec::new()), "{name} {why} {ran:?}");
        assert!(ran.messages.contains("does not name a mechanism"), "{}", ran.messages);
    }
}

#[test]
fn mistakes_for_readers() {
    let folder = Folder::new();
    folder.write("wrong.linkage", WRONG);
    folder.write("right.linkage", SLIDER_CRANK);
    let ran = folder.run("check wrong.linkage right.linkage");
    assert_eq!(ran.code, Some(1));
    assert_eq!(ran.output, "right.linkage: Crank, Piston: no mistakes; 1 degree of freedom, 1 point, 0 outputs\n");
    insta::assert_snapshot!("mistakes_for_readers", ran.messages);
}

#[test]
fn mistakes_for_editors() {
    let folder = Folder::new();
    folder.write("wrong.linkage", WRONG);
    let ran = folder.run("check --format json wrong.linkage there.linkage");
    assert_eq!((ran.code, ran.messages.as_str()), (Some(1), ""));
    insta::assert_snapshot!("mistakes_for_editors", ran.output);
    folder.write("right.linkage", SLIDER_CRANK);
    assert_eq!(folder.run("check --format json right.linkage").works(""), "[]\n");
}

/// Every command but `check` prints the mistakes of its file and writes nothing.
#[test]
fn mistakes_are_those_of_check() {
    let folder = Folder::new();
    folder.write("wrong.linkage", WRONG);
    folder.write("wrong.html", "old");
    let messages = folder.run("check wrong.linkage").messages;
    for command in ["sheet", "rust", "fpcore"] {
        folder.run(&format!("{command} wrong.linkage")).fails(1, &messages);
    }
    assert_eq!((folder.read("wrong.html"), folder.names().len()), ("old".to_owned(), 2));
}

#[test]
fn sheets() {
    let folder = Folder::new();
    folder.write("slider.linkage", SLIDER_CRANK);
    let text = folder.run("sheet slider.linkage --format text -o -").works("");
    assert!(text.contains("Crank\n") && text.contains("Piston\n") && text.contains("det J"), "{text}");
    folder.run("sheet slider.linkage --format latex").works("wrote slider.tex\n");
    let latex = folder.read("slider.tex");
    assert!(latex.starts_with("\\documentclass") && latex.ends_with("\\end{document}\n"));
    let choose = "error: a page has one mechanism, and the file has `Crank` and `Piston`: write --mechanism NAME\n";
    folder.run("sheet slider.linkage").fails(2, choose);
    folder.run("sheet slider.linkage --mechanism Piston -o p.html").works("wrote p.html\n");
    assert!(folder.read("p.html").contains("<title>Piston</title>"));
    let meant = "error: slider.linkage has no mechanism `Pston`, did you mean `Piston`?\n";
    folder.run("sheet slider.linkage --mechanism Pston").fails(2, meant);
    let other = "error: slider.linkage has no mechanism `FourBar`: it has `Crank` and `Piston`\n";
    folder.run("fpcore slider.linkage --mechanism FourBar").fails(2, other);
}

#[test]
fn standard_input_and_output() {
    let folder = Folder::new();
    assert!(folder.run_with("sheet -", SLIDER_CRANK).messages.contains("--mechanism"));
    assert!(folder.run_with("sheet - --mechanism Crank", SLIDER_CRANK).works("").starts_with("<!DOCTYPE html>"));
    assert!(folder.run_with("check -", WRONG).messages.starts_with("<stdin>:5:37: "));
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn the_expansion_is_that_of_the_macro() {
    let folder = Folder::new();
    folder.write("slider.linkage", SLIDER_CRANK);
    folder.run("rust slider.linkage -o slider.rs").works("wrote slider.rs\n");
    let expanded = linkage_compiler::expand(SLIDER_CRANK.parse().unwrap(), &quote::quote!(::linkage));
    assert_eq!(folder.read("slider.rs"), prettyplease::unparse(&syn::parse2(expanded).unwrap()));
    folder.run("rust slider.linkage --mechanism SliderCrank -o one.rs").works("wrote one.rs\n");
    assert_eq!(folder.read("one.rs"), folder.read("slider.rs"));
}

#[test]
fn help_has_an_example_of_each_command() {
    let folder = Folder::new();
    let help = folder.run("--help").works("");
    assert!(help.contains("Exit codes:") && help.contains("130  interrupted"), "{help}");
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let names: Vec<&str> = commands
        .filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .collect();
    assert!(names.len() >= 6, "{names:?}");
    for name in names {
        let help = folder.run(&format!("{name} --help")).works("");
        let example = format!("  linkage {name} ");
        assert!(help.contains("\nExample") && help.contains(&example), "{help}");
        assert!(folder.run("completions bash").works("").contains(&format!("linkage__subcmd__{name}")), "{name}");
    }
}
