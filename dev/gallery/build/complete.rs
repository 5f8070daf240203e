//! The general tests need a point, an output and the default of each parameter of a mechanism.

use std::path::Path;

/// A message for each thing that a mechanism of a folder lacks.
pub fn of_folder(folder: &Path) -> Vec<String> {
    let files = std::fs::read_dir(folder).expect("the folder of the mechanisms");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file of the folder").path()).collect();
    paths.sort();
    let of_file = |path: &Path| {
        let text = std::fs::read_to_string(path).expect("a text");
        missing(&format!("dev/gallery/{}", path.display()), &text)
    };
    paths.iter().flat_map(|path| of_file(path)).collect()
}

/// A message for each thing that the mechanism of a source file lacks. Its mistakes are not named here: `linkage!` reports them on their tokens.
pub fn missing(file: &str, text: &str) -> Vec<String> {
    let Ok(parsed) = syn::parse_file(text) else { return Vec::new() };
    let mechanisms = parsed.items.into_iter().filter_map(|item| match item {
        syn::Item::Macro(item) if item.mac.path.is_ident("linkage") => linkage_compiler::read(item.mac.tokens).ok(),
        _ => None,
    });
    let of_mechanism = |mechanism: linkage_compiler::model::Mechanism| {
        let without_default =
            mechanism.parameters.iter().filter(|parameter| parameter.default.is_none()).map(|parameter| {
                format!("no default for the parameter `{}`: write `param {0} = 1`", parameter.name.field)
            });
        let point = mechanism.points.is_empty().then(|| "no point: write `point P = ..;`".to_owned());
        let output = mechanism.outputs.is_empty().then(|| "no output: write `output o = ..;`".to_owned());
        let name = mechanism.name.to_string();
        let lacks = point.into_iter().chain(output).chain(without_default);
        lacks.map(|what| format!("{file}: mechanism {name} has {what}; the tests of all mechanisms need it")).collect()
    };
    mechanisms.flatten().flat_map(|mechanism| -> Vec<String> { of_mechanism(mechanism) }).collect()
}
