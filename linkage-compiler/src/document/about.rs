//! Doc comments in plain words.

/// The paragraphs of a doc comment before its first heading or code, with the words of links instead of the links.
pub(crate) fn paragraphs(lines: &[String]) -> Vec<String> {
    let is_prose = |line: &&String| !line.starts_with("```") && !line.starts_with('#');
    let prose: Vec<&str> = lines.iter().take_while(is_prose).map(String::as_str).collect();
    let paragraphs = prose.split(|line| line.is_empty()).map(|lines| without_links(&lines.join(" ")));
    paragraphs.filter(|paragraph| !paragraph.is_empty()).collect()
}

/// A text with the words of `[words](target)` and `[words]`, and without backticks.
fn without_links(text: &str) -> String {
    let mut words = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('[') {
        words += before;
        let Some((inside, after)) = after.split_once(']') else {
            words.push('[');
            rest = after;
            continue;
        };
        words += inside;
        rest = match after.strip_prefix('(').and_then(|target| target.split_once(')')) {
            Some((_, after)) => after,
            None => after,
        };
    }
    (words + rest).replace('`', "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_their_words() {
        let lines =
            ["A [four-bar](crate::manual::first) of `l1`,", "as in [`Wiper`].", "", "More [0, 1.", "# Errors", "None."];
        let lines = lines.map(str::to_owned);
        assert_eq!(paragraphs(&lines), ["A four-bar of l1, as in Wiper.", "More [0, 1."]);
        assert!(paragraphs(&[]).is_empty());
    }
}
