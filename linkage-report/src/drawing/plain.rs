//! Styles for programs that draw SVG and know neither variables nor media of CSS, such as those that make PNG of it.

/// A style with its variables replaced by their values in light mode, and without the rules for media.
pub(super) fn plain(style: &str) -> String {
    let rules = style.lines().filter(|line| !line.starts_with("@media"));
    let (variables, rules): (Vec<&str>, Vec<&str>) = rules.partition(|line| line.contains("{--"));
    let inside = variables.iter().filter_map(|line| line.split(['{', '}']).nth(1));
    let values = inside.flat_map(|inside| inside.split(';')).filter_map(|variable| variable.split_once(':'));
    values.fold(rules.join("\n"), |style, (name, value)| style.replace(&format!("var({name})"), value))
}
