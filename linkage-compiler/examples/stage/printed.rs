//! The stages that the compiler and its reports print: documents, code, Rust and FPCore.

use linkage_compiler::model::Mechanism;
use linkage_compiler::program::{Code, Function};
use linkage_compiler::{documents, emit};
use linkage_report::lend::{Lender, Unsound};
use linkage_report::{Document, FpCore};
use quote::{ToTokens, quote};
use syn::{Expr, File, ImplItem, ImplItemFn, Item, ItemFn, ItemImpl, Stmt, parse_quote};

use super::{Part, each_function, lowered};

/// The derivation for readers, with those of scenes.
pub fn document(mechanism: &Mechanism) -> Result<String, String> {
    let (drivers, scenes) = documents(mechanism).map_err(|messages| messages.join("\n"))?;
    let lender = Lender::default();
    let drivers = drivers.iter().map(|document| Ok(lender.derivation(document)?.to_text()));
    let scenes = scenes.iter().map(|document| Ok(lender.scene(document)?.to_text()));
    drivers.chain(scenes).collect::<Result<_, Unsound>>().map_err(|error| error.to_string())
}

/// The lowered functions as text.
pub fn code(mechanism: &Mechanism) -> Result<Vec<Part>, String> {
    let mut parts = Vec::new();
    for driver in mechanism.drivers.iter() {
        let program = lowered(mechanism, driver)?;
        let mut add = |of: &str, function: &Function<Code>| {
            let text = emit::function_as_text(function, &program.names);
            parts.push(Part { of: of.to_owned(), name: function.name.clone(), text });
        };
        each_function(&program, &mut add);
    }
    Ok(parts)
}

/// The items that are emitted: functions one by one, other items under their own names.
pub fn rust(mechanism: &Mechanism) -> Result<Vec<Part>, String> {
    let expansion = linkage_compiler::compile(mechanism, &quote!(::linkage)).map_err(|messages| messages.join("\n"))?;
    let file: File = syn::parse2(expansion.tokens).map_err(text_of)?;
    let mut parts = Vec::new();
    for item in file.items {
        add(item, &mut parts)?;
    }
    Ok(parts)
}

/// Adds an item, or those of an anonymous constant.
fn add(item: Item, parts: &mut Vec<Part>) -> Result<(), String> {
    match item {
        Item::Const(constant) if constant.ident == "_" => {
            let Expr::Block(block) = *constant.expr else { return Ok(()) };
            for statement in block.block.stmts {
                if let Stmt::Item(item) = statement {
                    add(item, parts)?;
                }
            }
        }
        Item::Impl(of) => {
            let header = pretty(Item::Impl(ItemImpl { attrs: Vec::new(), items: Vec::new(), ..of.clone() }));
            let title = header.trim_end().trim_end_matches("{}").trim_end().to_owned();
            for item in of.items {
                let (name, item) = match item {
                    ImplItem::Fn(ImplItemFn { attrs, vis, modifiers, sig, block }) => {
                        (sig.ident.to_string(), Item::Fn(ItemFn { attrs, vis, modifiers, sig, block: Box::new(block) }))
                    }
                    // A constant or a type of a trait.
                    other => (String::new(), syn::parse2(other.into_token_stream()).map_err(text_of)?),
                };
                parts.push(Part { of: title.clone(), name, text: pretty(item) });
            }
        }
        item => {
            let name = match &item {
                Item::Struct(of) => of.ident.to_string(),
                Item::Enum(of) => of.ident.to_string(),
                Item::Const(of) => of.ident.to_string(),
                Item::Type(of) => of.ident.to_string(),
                _ => String::new(),
            };
            parts.push(Part { of: "items".to_owned(), name, text: pretty(item) });
        }
    }
    Ok(())
}

fn text_of(error: syn::Error) -> String {
    error.to_string()
}

fn pretty(item: Item) -> String {
    prettyplease::unparse(&File { items: vec![item], ..parse_quote!() })
}

/// The formulas of functions, as far as they have some.
pub fn fpcore(mechanism: &Mechanism) -> Result<Vec<Part>, String> {
    let (drivers, scenes) = documents(mechanism).map_err(|messages| messages.join("\n"))?;
    let mut parts = Vec::new();
    let mut add = |all: Vec<FpCore<'_>>| {
        parts.extend(all.into_iter().map(|core| {
            let (of, rest) = core.name().split_once("::").unwrap_or_default();
            let name = rest.split(['.', '[']).next().unwrap_or_default().to_owned();
            Part { of: of.to_owned(), name, text: core.to_string() }
        }));
    };
    let (lender, unsound) = (Lender::default(), |error: Unsound| error.to_string());
    for document in &drivers {
        add(lender.derivation(document).map_err(unsound)?.fpcore());
    }
    for document in &scenes {
        add(lender.scene(document).map_err(unsound)?.fpcore());
    }
    Ok(parts)
}
