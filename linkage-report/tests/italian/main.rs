//! Italian sheets of the whole gallery have no English word: what they have in common with the English ones are formulas,
//! names, and a few words that both languages have.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use linkage_report::lend::Lender;
use linkage_report::sheet::{Language, Sheet};
use proc_macro2::{TokenStream, TokenTree};

/// Words of both languages.
const COMMON: [&str; 12] =
    ["in", "In", "formula", "cos", "pivoting", "Newton", "bias", "RRR", "RRP", "RPR", "PRP", "RPP"];

/// Words of the `linkage!` language that are also those of a sheet.
const KEYWORDS: [&str; 14] = [
    "body",
    "spring",
    "damper",
    "torque",
    "force",
    "potential",
    "friction",
    "stop",
    "on",
    "at",
    "between",
    "point",
    "output",
    "inertia",
];

/// The bodies of the invocations of `linkage!` in the gallery, by file.
fn gallery() -> Vec<(String, TokenStream)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dev/gallery/src/mechanisms");
    let mut all = Vec::new();
    for entry in folder.read_dir().unwrap() {
        let path = entry.unwrap().path();
        let file = syn::parse_file(&fs::read_to_string(&path).unwrap()).unwrap();
        for item in file.items {
            if let syn::Item::Macro(of) = item
                && of.mac.path.segments.last().unwrap().ident == "linkage"
            {
                all.push((path.display().to_string(), of.mac.tokens));
            }
        }
    }
    assert!(all.len() > 50);
    all
}

/// The identifiers of a text of mechanisms, each also as the parts of a formula that show it.
fn names(tokens: TokenStream, found: &mut BTreeSet<String>) {
    for token in tokens {
        match token {
            TokenTree::Ident(name) if !KEYWORDS.contains(&name.to_string().as_str()) => {
                found.extend(words(&name.to_string()));
            }
            TokenTree::Group(group) => names(group.stream(), found),
            _ => {}
        }
    }
}

/// The words of a text of more than one letter.
fn words(text: &str) -> BTreeSet<String> {
    let words = text.split(|letter: char| !letter.is_alphabetic()).filter(|word| word.chars().count() > 1);
    words.map(str::to_owned).collect()
}

/// A page without its formulas, code and tags: these have names alone.
fn without_elements(html: &str) -> String {
    let elements = [["<math", "</math>"], ["<code>", "</code>"], ["<style>", "</style>"], ["<", ">"]];
    elements.into_iter().fold(html.to_owned(), |text, [open, close]| {
        let mut pieces = text.split(open);
        let first = pieces.next().unwrap_or_default().to_owned();
        pieces.fold(first, |outside, piece| outside + piece.split_once(close).map_or("", |(_, after)| after))
    })
}

/// A file for LaTeX without its formulas and functions.
fn without_formulas(latex: &str) -> String {
    let mut text = String::new();
    let lines = latex.split("\\begin{pmatrix}").enumerate().map(|(index, part)| match index {
        0 => part,
        _ => part.split_once("\\end{pmatrix}").map_or(part, |(_, rest)| rest),
    });
    for line in lines.collect::<String>().lines() {
        let is_formula = line.starts_with("\\[") || line.starts_with("\\begin{equation*}");
        if !is_formula {
            text.extend(line.split('$').step_by(2));
        }
        text.push('\n');
    }
    for command in
        ["section*", "subsection*", "paragraph", "par", "texttt", "begin{tabular}{lrrrr}", "end{tabular}", "hline"]
    {
        text = text.replace(&format!("\\{command}"), " ");
    }
    text
}

/// A text without its formulas.
fn without_lines(text: &str) -> String {
    let is_formula = |line: &str| line.starts_with("      ") || line.starts_with("  (");
    text.lines().map(|line| if is_formula(line) { "" } else { line }).collect::<Vec<_>>().join("\n")
}

/// The words that lines of both sheets share and that are no names.
fn shared(english: &str, italian: &str, names: &BTreeSet<String>) -> BTreeSet<String> {
    assert_eq!(english.lines().count(), italian.lines().count());
    let pairs = english.lines().zip(italian.lines());
    let both = pairs.flat_map(|(english, italian)| &words(english) & &words(italian));
    both.filter(|word| !names.contains(word) && !COMMON.contains(&word.as_str())).collect()
}

#[test]
fn no_english_word_is_left() {
    let (mut all_words, mut missed) = (0, BTreeSet::new());
    for (file, tokens) in gallery() {
        let mut known = BTreeSet::new();
        names(tokens.clone(), &mut known);
        for mechanism in linkage_compiler::read(tokens).unwrap() {
            let (drivers, scenes) = linkage_compiler::documents(&mechanism).unwrap();
            let sheets = linkage_compiler::sheets(&mechanism).unwrap_or_default();
            let lender = Lender::default();
            let scenes: Vec<_> = scenes.iter().map(|scene| lender.scene(scene).unwrap()).collect();
            let sheets: Vec<_> = sheets.iter().map(|sheet| lender.sheet(sheet).unwrap()).collect();
            for derivation in drivers.iter().map(|driver| lender.derivation(driver).unwrap()) {
                let mut known = known.clone();
                let of_scenes = scenes.iter().flat_map(|scene| scene.parameters);
                let symbols = derivation.parameters.iter().chain(derivation.inputs).chain(derivation.unknowns);
                for symbol in symbols.chain(of_scenes) {
                    known.extend(&words(symbol.name) | &words(&symbol.formula.to_string()));
                }
                let quantities = derivation.points.iter().chain(derivation.outputs);
                quantities.for_each(|quantity| known.extend(words(quantity.name)));
                let kernels = scenes.iter().flat_map(|scene| scene.kernels).chain(derivation.kernels);
                kernels.for_each(|kernel| known.extend(words(kernel.function)));
                let roots = derivation.groups.iter().filter_map(|group| group.root);
                roots.for_each(|root| known.extend(root.branches.map(str::to_owned)));
                let mut sheet = Sheet::new(&derivation);
                scenes
                    .iter()
                    .filter(|scene| scene.mechanism == derivation.mechanism)
                    .for_each(|scene| _ = sheet.scene(scene));
                if let Some(by_hand) = sheets.iter().find(|sheet| sheet.mechanism == derivation.mechanism) {
                    sheet.by_hand(by_hand);
                }
                let mut italian = sheet.clone();
                italian.language(Language::Italian);
                for (english, italian) in [
                    (without_lines(&sheet.to_text()), without_lines(&italian.to_text())),
                    (without_formulas(&sheet.to_latex()), without_formulas(&italian.to_latex())),
                    (without_elements(&sheet.to_html()), without_elements(&italian.to_html())),
                ] {
                    let left = shared(&english, &italian, &known);
                    missed.extend(left.into_iter().map(|word| format!("{word} in {}, {file}", derivation.mechanism)));
                    all_words += words(&italian).len();
                }
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
    assert!(all_words > 1000);
}
