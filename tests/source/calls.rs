//! The text of a program that calls what is emitted: each mechanism, and a call of each of its functions.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use quote::ToTokens;
use syn::{FnArg, GenericParam, ImplItem, Item, ItemImpl, ItemStruct, Pat, ReturnType, Signature, Visibility};

use crate::every::{self, Expansion};

/// The files of the program by name: of all mechanisms, or of those in the files with these names.
pub fn files(root: &Path, chosen: Option<&[&str]>) -> Vec<(String, String)> {
    let mut files = Vec::new();
    let mut modules = String::new();
    let mut subjects = String::new();
    for Expansion { module, functions, emitted } in every::expansions(root, chosen) {
        let mut text = functions + &prettyplease::unparse(&emitted);
        let calls = Calls::of(&emitted);
        write!(
            text,
            "\npub mod calls {{ use super::*; use crate::harness as h; use linkage::Mechanism as _;\n{}}}\n",
            calls.text
        )
        .unwrap();
        // The generated calls are not written for reading. This test looks at numbers; the warnings of emitted code are
        // those of the test `emitted_source`.
        writeln!(modules, "#[allow(warnings, reason = \"`emitted_source` looks at them\")] mod {module};").unwrap();
        for subject in calls.subjects {
            writeln!(subjects, "(\"{subject}\", {module}::calls::{}),", snake(&subject)).unwrap();
        }
        files.push((format!("{module}.rs"), text));
    }
    let harness = root.join("tests/input/invalid_numbers/harness/mod.rs");
    let laws = root.join("dev/gallery/src/cam_laws.rs");
    files.push((
        "subjects.rs".to_owned(),
        format!(
            "#[path = {harness:?}] mod harness;\n#[path = {laws:?}] mod laws;\n{COUNTED}\n{modules}\n\
             const SUBJECTS: &[(&str, harness::Subject)] =\n\
             &[{subjects}(\"integrate\", harness::integrations)];\n"
        ),
    ));
    files
}

/// The functions that cams call, counted.
const COUNTED: &str = "
mod cam_laws {
    use linkage::Real;
    pub fn cycloidal_strokes<T: Real>(angle: T, height: T, rise: T) -> (T, T, T) {
        crate::harness::evaluated();
        crate::laws::cycloidal_strokes(angle, height, rise)
    }
    pub fn polynomial_strokes<T: Real>(angle: T, height: T, rise: T) -> (T, T, T, T) {
        crate::harness::evaluated();
        crate::laws::polynomial_strokes(angle, height, rise)
    }
}
";

/// `FourBar` as `four_bar`.
fn snake(name: &str) -> String {
    let mut text = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !text.is_empty() {
            text.push('_');
        }
        text.extend(letter.to_lowercase());
    }
    text
}

/// A type or a pattern without spaces, and types of the runtime without their path.
fn plain(tokens: impl ToTokens) -> String {
    tokens.to_token_stream().to_string().replace(' ', "").replace("__rt::", "")
}

#[derive(Default)]
struct Calls {
    text: String,
    /// The types whose functions are called.
    subjects: Vec<String>,
}

/// The emitted items, by their types.
#[derive(Default)]
struct Emitted<'a> {
    structs: BTreeMap<String, &'a ItemStruct>,
    /// The functions with a receiver, by type.
    functions: BTreeMap<String, Vec<&'a Signature>>,
    defaults: Vec<String>,
    /// The scenes with a trait.
    scenes: Vec<String>,
}

impl<'a> Emitted<'a> {
    fn gather(&mut self, items: &'a [Item]) {
        for item in every::items(items) {
            match item {
                Item::Struct(item) => {
                    self.structs.insert(item.ident.to_string(), item);
                }
                Item::Impl(item) => self.implementation(item),
                _ => {}
            }
        }
    }

    fn implementation(&mut self, item: &'a ItemImpl) {
        let of = plain(&item.self_ty);
        let of = of.split('<').next().unwrap_or_default().to_owned();
        if let Some((path, _)) = item.trait_.as_ref().map(|(path, of)| (plain(path), of)) {
            if path.ends_with("Default") {
                self.defaults.push(of);
            } else if path == "Scene" {
                self.scenes.push(of);
            } else if path == "Mechanism" {
                self.equations(&of, item);
            }
            return;
        }
        for item in &item.items {
            let ImplItem::Fn(function) = item else { continue };
            let is_called = matches!(function.vis, Visibility::Public(_))
                && function
                    .sig
                    .receiver()
                    .is_some_and(|receiver| matches!(receiver.kind, syn::ReceiverKind::Reference(..)));
            if is_called {
                self.functions.entry(of.clone()).or_default().push(&function.sig);
            }
        }
    }
}

impl<'a> Emitted<'a> {
    /// The functions that a mechanism has in its trait alone: they name its types, and those that call another name the
    /// types of the trait.
    fn equations(&mut self, of: &str, item: &'a ItemImpl) {
        let functions = item.items.iter().filter_map(|item| match item {
            ImplItem::Fn(function) => Some(&function.sig),
            _ => None,
        });
        let own = functions
            .filter(|function| function.receiver().is_some() && !plain(&function.inputs).contains("Self::"))
            .collect::<Vec<_>>();
        self.functions.entry(of.to_owned()).or_default().extend(own);
    }
}

impl Calls {
    fn of(file: &syn::File) -> Self {
        let mut emitted = Emitted::default();
        emitted.gather(&file.items);
        let mut calls = Self::default();
        // Columns hold what a caller puts there: `tests/lanes` draws those.
        for (name, item) in emitted.structs.iter().filter(|(name, _)| !name.ends_with("Columns")) {
            calls.taken_apart(name, item);
            calls.drawn(name, item, emitted.defaults.contains(name));
        }
        for (name, functions) in &emitted.functions {
            // The functions of a pose are called with those of its mechanism.
            if !name.ends_with("Pose") {
                calls.subject(name, functions, &emitted);
            }
        }
        calls
    }

    /// Every number of a type, field by field.
    fn taken_apart(&mut self, name: &str, item: &ItemStruct) {
        let fields: Vec<String> =
            item.fields.iter().filter_map(|field| Some(field.ident.as_ref()?.to_string())).collect();
        let of_quantity = item.generics.params.iter().any(|parameter| match parameter {
            GenericParam::Type(parameter) => parameter.ident == "Q",
            _ => false,
        });
        let (generics, of) = match (of_quantity, item.generics.params.is_empty()) {
            (true, _) => ("<Q: h::Finite>", "<Q>"),
            (false, false) => ("", "<f64>"),
            (false, true) => ("", ""),
        };
        let list = fields.join(", ");
        let all: String = fields.iter().map(|field| format!(" && h::Finite::all_finite({field})")).collect();
        let _ = writeln!(
            self.text,
            "impl{generics} h::Finite for {name}{of} {{ fn all_finite(&self) -> bool {{ let {name} {{ {list} }} = self; true{all} }} }}"
        );
    }

    /// A value of a type that can be an argument.
    fn drawn(&mut self, name: &str, item: &ItemStruct, has_default: bool) {
        let of = if item.generics.params.is_empty() { "" } else { "<f64>" };
        if ["Points", "Outputs", "Motion", "Kinematics", "Reactions", "Drives"]
            .iter()
            .any(|ending| name.ends_with(ending))
        {
            return;
        }
        let fields: String = item
            .fields
            .iter()
            .filter_map(|field| Some((field.ident.as_ref()?.to_string(), plain(&field.ty))))
            .map(|(field, of)| match of.as_str() {
                "T" if has_default => format!("{field}: s.parameter(default.{field}), "),
                _ => format!("{field}: h::Draw::draw(s), "),
            })
            .collect();
        let default =
            if has_default { format!("let default = <{name} as Default>::default();") } else { String::new() };
        let _ = writeln!(
            self.text,
            "impl h::Draw for {name}{of} {{ fn draw(s: &mut h::Source) -> Self {{ {default} {name} {{ {fields} }} }} }}"
        );
    }

    /// One call of each function of a mechanism or a scene.
    fn subject(&mut self, name: &str, functions: &[&Signature], emitted: &Emitted) {
        let Some(of_inputs) = functions.iter().find_map(|function| inputs_of(function, emitted)) else {
            panic!("{name}: no function has the inputs among its arguments")
        };
        let of_arguments =
            functions.iter().flat_map(|function| &function.inputs).filter_map(|argument| match argument {
                FnArg::Typed(argument) => Some(plain(&argument.ty).trim_start_matches('&').to_owned()),
                FnArg::Receiver(_) => None,
            });
        let of_results = functions.iter().filter_map(|function| Some(success(&result_of(function)?)?.to_owned()));
        let types = of_arguments.chain(of_results);
        let pools: BTreeMap<_, _> = types.filter_map(|of| Some((pool_of(&of)?, of.replace("<T>", "")))).collect();
        let pools = pools.iter().map(|(pool, of)| format!("let mut {pool} = h::Pool::<{of}>::default();\n"));
        let inner = emitted.structs[name].fields.iter().find_map(|field| {
            let of = plain(&field.ty);
            let of = of.strip_suffix("<T>")?;
            emitted.functions.contains_key(of).then(|| field.ident.as_ref().map(ToString::to_string))?
        });
        let mut text = format!("pub fn {}(t: &mut h::Tally, s: &mut h::Source) {{\n", snake(name));
        let _ = writeln!(text, "let m: {name} = h::Draw::draw(s);\n{}", pools.collect::<String>());
        match &inner {
            Some(field) => {
                let _ = writeln!(text, "h::positions(&m.{field}, s, &mut positions);");
                if emitted.scenes.iter().any(|scene| scene == name) {
                    let _ = writeln!(text, "h::scene(t, s, &m, &mut positions);");
                }
            }
            None => {
                let _ = writeln!(text, "h::mechanism(t, s, &m, &mut positions, &mut poses);");
                if emitted.structs[&of_inputs].fields.len() == 1 {
                    let _ = writeln!(text, "h::driven(t, s, &m, &mut positions);");
                }
                let pose = format!("{name}Pose");
                for function in emitted.functions.get(&pose).into_iter().flatten() {
                    let _ = writeln!(
                        text,
                        "{{ let pose: {pose} = poses.take(s); t.total(s, \"{pose}::{0}\", || pose.{0}()); }}",
                        function.ident
                    );
                }
            }
        }
        for function in functions {
            text += &call(name, function);
        }
        text += "}\n";
        self.text += &text;
        self.subjects.push(name.to_owned());
    }
}

/// Results that become arguments, by the ends of their types, and the pools that keep them.
const POOLS: [(&str, &str); 5] = [
    ("Coordinates", "positions"),
    ("Rates", "rates"),
    ("Accelerations", "accelerations"),
    ("Jerks", "jerks"),
    ("Pose", "poses"),
];

/// The type that a function gives.
fn result_of(function: &Signature) -> Option<String> {
    match &function.output {
        ReturnType::Type(_, of) => Some(plain(of)),
        ReturnType::Default => None,
    }
}

/// The type of a result without its error.
fn success(of: &str) -> Option<&str> {
    Some(of.strip_prefix("Result<")?.rsplit_once(',')?.0)
}

/// The pool for values of a type.
fn pool_of(of: &str) -> Option<&'static str> {
    let name = of.strip_suffix("<T>")?;
    let is_plain = name.chars().all(char::is_alphanumeric);
    POOLS.into_iter().find_map(|(ending, pool)| (is_plain && name.ends_with(ending)).then_some(pool))
}

/// The type of the inputs among the arguments of a function.
fn inputs_of(function: &Signature, emitted: &Emitted) -> Option<String> {
    function.inputs.iter().find_map(|argument| {
        let FnArg::Typed(argument) = argument else { return None };
        let of = plain(&argument.ty);
        let of = of.strip_prefix("implInto<")?.strip_suffix("<T>>")?;
        emitted.structs.contains_key(of).then(|| of.to_owned())
    })
}

/// The call of one function.
fn call(name: &str, function: &Signature) -> String {
    let mut text = String::from("{ ");
    let mut arguments = Vec::new();
    for (place, argument) in function.inputs.iter().enumerate() {
        let FnArg::Typed(argument) = argument else { continue };
        let of = plain(&argument.ty);
        let wish = match &*argument.pat {
            Pat::Ident(pattern) => pattern.ident.to_string(),
            _ => String::new(),
        };
        let (value, passed) = match of.as_str() {
            "T" => ("s.number()".to_owned(), ""),
            _ if let Some(pool) = pool_of(of.trim_start_matches('&')) => (format!("{pool}.take(s)"), "&"),
            _ if of.starts_with("implInto<") || of.ends_with("Branch") => {
                let of = of.trim_start_matches("implInto<").trim_end_matches('>').trim_end_matches("<T");
                (format!("<{of} as h::Draw>::draw(s)"), "")
            }
            _ if of.starts_with("&SVector<T,") => {
                (format!("<{} as h::Draw>::draw(s)", of[1..].replace("SVector<T,", "h::SVector<f64,")), "&")
            }
            _ if of.starts_with("&Column<T,") => {
                let of = of[1..].replace("Column<T,D<", "linkage::Column<f64,linkage::D<");
                (format!("<{of} as h::Draw>::draw(s)"), "&")
            }
            _ if of.starts_with("&[T;") => (format!("<{} as h::Draw>::draw(s)", of[1..].replace('T', "f64")), "&"),
            _ => panic!("{name}::{}: no rule makes `{wish}: {of}`", function.ident),
        };
        let _ = write!(text, "let a{place} = {value}; ");
        arguments.push(format!("{passed}a{place}"));
    }
    let arguments = arguments.join(", ");
    let called = format!("m.{}({arguments})", function.ident);
    let Some(of) = result_of(function) else {
        return String::new();
    };
    let row = format!("\"{name}::{}\"", function.ident);
    let kept = match success(&of) {
        Some(of) if of.starts_with("Solution<") || of.starts_with("AnyBranch<") => {
            "positions.keep(r.coordinates)".to_owned()
        }
        Some(of) => pool_of(of).map_or("()".to_owned(), |pool| format!("{pool}.keep(r)")),
        // Functions without `Result` document their results for invalid numbers.
        None => String::new(),
    };
    let called = match of.starts_with("Result<implIterator<") {
        true => format!("{called}.map(|found| found.collect::<Vec<_>>())"),
        false => called,
    };
    let _ = if kept.is_empty() {
        write!(text, "t.total(s, {row}, || {called});")
    } else {
        write!(text, "if let Some(r) = t.fallible(s, {row}, || {called}) {{ {kept}; }}")
    };
    text += " }\n";
    text
}
