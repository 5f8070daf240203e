//! Main passes the commands that the README tells a newcomer.

use std::fs;

fn text_of(file: &str) -> String {
    fs::read_to_string(format!("{}/{file}", linkage_tests::ROOT)).expect("a text")
}

#[test]
fn the_readme_has_the_commands_of_the_whole_run() {
    let (readme, run) = (text_of("README.md"), text_of("dev/ci"));
    assert!(text_of(".ci/run").ends_with("dev/ci\"\n"));
    assert!(readme.contains("\ndev/test ") && run.contains("\"dev/test\""));
    let of_table = readme.lines().filter_map(|line| line.strip_prefix("| `")?.split('|').next());
    // The benchmark of windows has a page of its own and takes minutes.
    let examples: Vec<&str> = of_table
        .flat_map(|cell| cell.split('`').step_by(2))
        .filter_map(|name| name.split_whitespace().next())
        .filter(|name| *name != "windows")
        .collect();
    assert!(examples.len() > 10, "{examples:?}");
    for example in examples {
        assert!(run.split_whitespace().any(|word| word.trim_end_matches(';') == example), "{example}");
    }
}
