//! Each construct of the language is in a block of the manual that rustdoc compiles and runs.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use linkage_compiler::diagnostics::Diagnostics;
use linkage_compiler::graph::written;
use linkage_compiler::model::{Request, VECTOR_FUNCTIONS};
use linkage_compiler::syntax::{
    self, Attachment, EFFECTS, EffectKind, Expression, Expressions, Joint, KEYWORDS, Mechanism, Operator, PROPERTIES,
    Range, StatementKind, Unit,
};
use proc_macro2::{TokenStream, TokenTree};

/// Constructs that no list of the compiler has: forms of statements, effects and expressions, and attributes.
const FORMS: [&str; 53] = [
    "attribute of a mechanism",
    "attribute of `param`",
    "attribute of `drive`",
    "attribute of `scene`",
    "doc comment of a mechanism",
    "doc comment of `param`",
    "doc comment of `input`",
    "doc comment of `point`",
    "doc comment of `output`",
    "doc comment of `scene`",
    "`pub mechanism`",
    "two mechanisms",
    "`param a;`",
    "`param a = 1;`",
    "`loop … = 0;`",
    "`implied loop`",
    "`implied equation`",
    "`let _name`",
    "`s in 0..1`",
    "`s in 0..`",
    "`s in ..1`",
    "`extern fn` of one argument",
    "`extern fn` of two arguments",
    "`scene NAME of DRIVER`",
    "`inertia;`",
    "`inertia crank;`",
    "`gravity g;`",
    "`gravity g on rod;`",
    "`spring k between P and Q;`",
    "`spring k, s0 between P and Q;`",
    "`spring k, s0 on s;`",
    "`damper c between P and Q;`",
    "`damper c on s;`",
    "`friction mu, n on s;`",
    "`friction mu, r, n on s;`",
    "`friction mu, reaction on s;`",
    "`friction mu, r, reaction on phi;`",
    "`friction mu, r, reaction at P on phi;`",
    "`stop s in 0..1, restitution e;`",
    "`stop s, restitution e;`",
    "`reaction at P;`",
    "`reaction on s;`",
    "`r@phi`",
    "`(x, y)`",
    "`(x, y)@phi`",
    "`a + b`",
    "`a - b`",
    "`a * b`",
    "`a / b`",
    "`-a`",
    "`x^n`",
    "`x.sqrt()`",
    "`pi`",
];

/// The words of laws.
const LAWS: [&str; 2] = ["`rate(x)`", "`t`"];

/// The code blocks of a page that are compiled and run, without the `# ` of hidden lines.
fn tested_blocks(page: &str) -> Vec<String> {
    let mut blocks: Vec<String> = Vec::new();
    let (mut is_inside, mut is_tested) = (false, false);
    for line in page.lines() {
        match line.strip_prefix("```") {
            Some(info) => {
                is_inside = !is_inside;
                is_tested = is_inside && ["", "rust"].contains(&info);
                blocks.extend(is_tested.then(String::new));
            }
            None if is_tested => {
                let line = if line == "#" { "" } else { line.strip_prefix("# ").unwrap_or(line) };
                let block = blocks.last_mut().expect("a block has begun");
                block.push_str(line);
                block.push('\n');
            }
            None => {}
        }
    }
    blocks
}

/// The bodies of all `linkage! { … }`.
fn invocations(tokens: TokenStream) -> Vec<TokenStream> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut found = Vec::new();
    for (place, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let is_body = matches!(&tokens[..place], [.., TokenTree::Ident(name), TokenTree::Punct(sign)]
            if name == "linkage" && sign.as_char() == '!');
        found.extend(if is_body { vec![group.stream()] } else { invocations(group.stream()) });
    }
    found
}

/// True if a method is called: `.sqrt()`.
fn has_method(tokens: TokenStream) -> bool {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let is_method = |three: &[TokenTree]| match three {
        [TokenTree::Punct(dot), TokenTree::Ident(_), TokenTree::Group(_)] => dot.as_char() == '.',
        _ => false,
    };
    tokens.windows(3).any(is_method)
        || tokens.iter().any(|token| matches!(token, TokenTree::Group(group) if has_method(group.stream())))
}

/// The constructs found so far.
#[derive(Default)]
struct Found(BTreeSet<String>);

impl Found {
    fn add(&mut self, construct: impl Into<String>) {
        self.0.insert(construct.into());
    }

    fn one_of(&mut self, is_first: bool, [first, second]: [&str; 2]) {
        self.add(if is_first { first } else { second });
    }

    fn attributes(&mut self, attributes: &[syn::Attribute], of: &str) {
        for attribute in attributes {
            let kind = if attribute.path().is_ident("doc") { "doc comment" } else { "attribute" };
            self.add(format!("{kind} of {of}"));
        }
    }

    fn mechanism(&mut self, mechanism: &Mechanism) {
        self.attributes(&mechanism.attributes, "a mechanism");
        if matches!(mechanism.visibility, syn::Visibility::Public(_)) {
            self.add("`pub mechanism`");
        }
        for statement in &mechanism.statements {
            let keyword = self.statement(&statement.kind, &mechanism.expressions);
            self.add(format!("statement `{keyword}`"));
            self.attributes(&statement.attributes, &format!("`{keyword}`"));
        }
        for (expression, _) in mechanism.expressions.from(0) {
            self.expression(expression, &mechanism.expressions);
        }
    }

    /// Returns the keyword.
    fn statement(&mut self, kind: &StatementKind, expressions: &Expressions) -> &'static str {
        let is_zero = |side| matches!(expressions.get(side), Expression::Number { digits, .. } if digits == "0");
        match kind {
            StatementKind::Parameters(parameters) => {
                for (_, default) in parameters {
                    self.one_of(default.is_some(), ["`param a = 1;`", "`param a;`"]);
                }
                "param"
            }
            StatementKind::Inputs(all) | StatementKind::Unknowns(all) | StatementKind::Coordinates(all) => {
                all.iter().for_each(|one| self.range(one.range.as_ref()));
                match kind {
                    StatementKind::Inputs(_) => "input",
                    StatementKind::Unknowns(_) => "unknown",
                    _ => "coordinate",
                }
            }
            StatementKind::Drive { .. } => "drive",
            StatementKind::Loop { is_implied: true, .. } => {
                self.add("`implied loop`");
                "implied"
            }
            StatementKind::Equation { is_implied: true, .. } => {
                self.add("`implied equation`");
                "implied"
            }
            StatementKind::Loop { right, .. } => {
                if is_zero(*right) {
                    self.add("`loop … = 0;`");
                }
                "loop"
            }
            StatementKind::Equation { .. } => "equation",
            StatementKind::Let { name, .. } => {
                if name.to_string().starts_with('_') {
                    self.add("`let _name`");
                }
                "let"
            }
            StatementKind::Point { .. } => "point",
            StatementKind::Output { range, .. } => {
                self.range(range.as_ref());
                "output"
            }
            StatementKind::External { arguments, .. } => {
                self.one_of(arguments.len() == 1, ["`extern fn` of one argument", "`extern fn` of two arguments"]);
                "extern"
            }
            StatementKind::Derive(words) => {
                words.iter().for_each(|word| self.add(format!("`derive {word}`")));
                "derive"
            }
            StatementKind::Body(body) => {
                body.properties.iter().for_each(|(word, _)| self.add(format!("property `{word}`")));
                "body"
            }
            StatementKind::Scene(scene) => {
                if scene.of.is_some() {
                    self.add("`scene NAME of DRIVER`");
                }
                for effect in &scene.effects {
                    self.add(format!("effect `{}`", effect.keyword));
                    self.effect(&effect.kind);
                }
                "scene"
            }
            StatementKind::Quantity { .. } | StatementKind::Unread { .. } => panic!("a mistake in the manual"),
        }
    }

    fn range(&mut self, range: Option<&Range>) {
        let Some(Range { ends: [least, most], .. }) = range else { return };
        self.add(match (least, most) {
            (Some(_), Some(_)) => "`s in 0..1`",
            (Some(_), None) => "`s in 0..`",
            _ => "`s in ..1`",
        });
    }

    fn effect(&mut self, kind: &EffectKind) {
        match kind {
            EffectKind::Inertia(bodies) => self.one_of(bodies.is_empty(), ["`inertia;`", "`inertia crank;`"]),
            EffectKind::Gravity { bodies, .. } => {
                self.one_of(bodies.is_empty(), ["`gravity g;`", "`gravity g on rod;`"]);
            }
            EffectKind::Spring { free, attachment, .. } => match attachment {
                Attachment::On(_) => self.add("`spring k, s0 on s;`"),
                Attachment::Between(..) => {
                    self.one_of(free.is_none(), ["`spring k between P and Q;`", "`spring k, s0 between P and Q;`"]);
                }
            },
            EffectKind::Damper { attachment, .. } => {
                let is_between = matches!(attachment, Attachment::Between(..));
                self.one_of(is_between, ["`damper c between P and Q;`", "`damper c on s;`"]);
            }
            EffectKind::Friction { factors, reaction: None, .. } => {
                self.one_of(factors.len() == 2, ["`friction mu, n on s;`", "`friction mu, r, n on s;`"]);
            }
            EffectKind::Friction { reaction: Some(Some(_)), .. } => {
                self.add("`friction mu, r, reaction at P on phi;`");
            }
            EffectKind::Friction { factors, reaction: Some(None), .. } => {
                let forms = ["`friction mu, reaction on s;`", "`friction mu, r, reaction on phi;`"];
                self.one_of(factors.len() == 1, forms);
            }
            EffectKind::Reaction(joint) => {
                self.one_of(matches!(joint, Joint::At(_)), ["`reaction at P;`", "`reaction on s;`"]);
            }
            EffectKind::Stop { range, .. } => {
                self.one_of(range.is_some(), ["`stop s in 0..1, restitution e;`", "`stop s, restitution e;`"]);
            }
            EffectKind::Torque { .. }
            | EffectKind::Force { .. }
            | EffectKind::Potential(_)
            | EffectKind::Drive { .. }
            | EffectKind::Request => {}
            EffectKind::Unread(_) => panic!("a mistake in the manual"),
        }
    }

    fn expression(&mut self, expression: &Expression, expressions: &Expressions) {
        let inverse = |operands: &[(Operator, _)]| operands.iter().any(|(sign, _)| *sign == Operator::Inverse);
        let direct = |operands: &[(Operator, _)]| operands[1..].iter().any(|(sign, _)| *sign == Operator::Direct);
        match expression {
            Expression::Number { unit, .. } => {
                let named = Unit::ALL.iter().find(|(_, other)| other == unit);
                named.into_iter().for_each(|(name, _)| self.add(format!("unit `{name}`")));
            }
            Expression::Name(name) => self.add(format!("`{name}`")),
            Expression::Vector(..) => self.add("`(x, y)`"),
            Expression::At(modulus, _) => {
                let is_local = matches!(expressions.get(*modulus), Expression::Vector(..));
                self.one_of(is_local, ["`(x, y)@phi`", "`r@phi`"]);
            }
            Expression::Sum(terms) => {
                if direct(terms) {
                    self.add("`a + b`");
                }
                if inverse(terms) {
                    self.add("`a - b`");
                }
            }
            Expression::Product(factors) => {
                if direct(factors) {
                    self.add("`a * b`");
                }
                if inverse(factors) {
                    self.add("`a / b`");
                }
            }
            Expression::Negate(_) => self.add("`-a`"),
            Expression::Power(..) => self.add("`x^n`"),
            Expression::Call(name, _) if name == "rate" => self.add("`rate(x)`"),
            Expression::Call(name, _) => self.add(format!("function `{name}`")),
            Expression::Adjacent(..) | Expression::Broken | Expression::Unread(_) => panic!("a mistake in the manual"),
        }
    }
}

#[test]
fn each_construct_is_in_a_tested_block_of_the_manual() {
    let folder = Path::new(linkage_tests::ROOT).join("src/manual");
    let modules =
        fs::read_to_string(folder.join("mod.rs")).unwrap() + &fs::read_to_string(folder.join("../lib.rs")).unwrap();
    let mut found = Found::default();
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "md") {
            continue;
        }
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        assert!(modules.contains(&format!("{name}\")")), "{name} is no page of the manual");
        for block in tested_blocks(&fs::read_to_string(&path).unwrap()) {
            for body in invocations(block.parse().unwrap()) {
                if has_method(body.clone()) {
                    found.add("`x.sqrt()`");
                }
                let mut diagnostics = Diagnostics::default();
                let mechanisms = syntax::parse(body, &mut diagnostics);
                assert!(diagnostics.is_empty(), "{name}: {:?}", diagnostics.messages());
                if mechanisms.len() > 1 {
                    found.add("two mechanisms");
                }
                mechanisms.iter().for_each(|mechanism| found.mechanism(mechanism));
            }
        }
    }
    let functions = written().map(|row| row.function.name()).chain(VECTOR_FUNCTIONS.iter().map(|(name, _)| *name));
    let constructs = (KEYWORDS.iter().map(|word| format!("statement `{word}`")))
        .chain(EFFECTS.iter().map(|word| format!("effect `{word}`")))
        .chain(PROPERTIES.iter().map(|word| format!("property `{word}`")))
        .chain(Request::ALL.iter().map(|(word, _)| format!("`derive {word}`")))
        .chain(Unit::ALL.iter().map(|(word, _)| format!("unit `{word}`")))
        .chain(functions.map(|name| format!("function `{name}`")))
        .chain(FORMS.iter().chain(&LAWS).map(|form| (*form).to_owned()));
    let missing: Vec<String> = constructs.filter(|construct| !found.0.contains(construct)).collect();
    assert!(missing.is_empty(), "no tested block of the manual has: {}", missing.join(", "));
}
