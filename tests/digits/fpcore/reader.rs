//! A reader of FPCore 2.0 and an evaluator in any arithmetic. Both panic on a text that the standard does not allow.

use std::collections::BTreeMap;

/// An S-expression.
#[derive(Debug, Clone, PartialEq)]
pub enum Tree {
    Word(String),
    Text(String),
    List(Vec<Tree>),
}

/// A text that begins with `(FPCore`.
pub struct Core {
    pub name: String,
    pub arguments: Vec<String>,
    pub precondition: Option<Tree>,
    pub body: Tree,
}

/// The numbers of an evaluation.
pub trait Arithmetic: Clone {
    fn decimal(digits: &str) -> Self;
    fn pi() -> Self;
    /// An operation on one or two numbers; `None` if there is none with this name.
    fn call(name: &str, operands: &[Self]) -> Option<Self>;
    fn is_less(&self, other: &Self) -> bool;
}

/// The value of an expression.
#[derive(Clone)]
pub enum Value<T> {
    Number(T),
    Truth(bool),
}

impl Core {
    pub fn read(text: &str) -> Self {
        let mut words = words(text).into_iter().peekable();
        let tree = tree(&mut words);
        assert_eq!(words.next(), None, "after the end:\n{text}");
        let Tree::List(parts) = tree else { panic!("no list:\n{text}") };
        let mut parts = parts.into_iter();
        assert_eq!(parts.next(), Some(Tree::Word("FPCore".to_owned())), "{text}");
        let Some(Tree::List(arguments)) = parts.next() else { panic!("no arguments:\n{text}") };
        let arguments: Vec<String> = arguments.iter().map(|argument| symbol(argument).to_owned()).collect();
        let (mut name, mut precondition, mut body) = (None, None, None);
        while let Some(part) = parts.next() {
            match (&part, body.is_some()) {
                (Tree::Word(word), false) if word.starts_with(':') => {
                    let value = parts.next().unwrap_or_else(|| panic!("{word} without a value:\n{text}"));
                    match (word.as_str(), value) {
                        (":name", Tree::Text(text)) => name = Some(text),
                        (":precision", value) => assert_eq!(value, Tree::Word("binary64".to_owned())),
                        (":pre", value) => precondition = Some(value),
                        other => panic!("{other:?} in\n{text}"),
                    }
                }
                (_, false) => body = Some(part),
                (_, true) => panic!("{part:?} after the body:\n{text}"),
            }
        }
        let mut once = arguments.clone();
        once.sort();
        once.dedup();
        assert_eq!(once.len(), arguments.len(), "an argument twice:\n{text}");
        Self { name: name.expect("a name"), arguments, precondition, body: body.expect("a body") }
    }

    pub fn value<T: Arithmetic>(&self, arguments: &BTreeMap<String, T>) -> T {
        number(&evaluated(&self.body, &scope(&self.arguments, arguments)))
    }

    /// True if the precondition holds.
    pub fn is_valid<T: Arithmetic>(&self, arguments: &BTreeMap<String, T>) -> bool {
        self.precondition
            .as_ref()
            .is_none_or(|condition| truth(&evaluated(condition, &scope(&self.arguments, arguments))))
    }
}

type Scope<T> = BTreeMap<String, Value<T>>;

/// The arguments alone: a text that uses another name is wrong.
fn scope<T: Arithmetic>(names: &[String], values: &BTreeMap<String, T>) -> Scope<T> {
    let value = |name: &String| values.get(name).unwrap_or_else(|| panic!("no value for {name}")).clone();
    names.iter().map(|name| (name.clone(), Value::Number(value(name)))).collect()
}

fn words(text: &str) -> Vec<String> {
    assert!(text.is_ascii(), "{text}");
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '(' | ')' | '[' | ']' => 1,
            '"' => 2 + rest[1..].find('"').expect("the end of a string"),
            _ if first.is_whitespace() => {
                rest = rest.trim_start();
                continue;
            }
            _ => rest.find(|c: char| c.is_whitespace() || "()[]\"".contains(c)).unwrap_or(rest.len()),
        };
        words.push(rest[..length].to_owned());
        rest = &rest[length..];
    }
    words
}

fn tree(words: &mut std::iter::Peekable<impl Iterator<Item = String>>) -> Tree {
    let word = words.next().expect("an expression");
    let end = match word.as_str() {
        "(" => ")",
        "[" => "]",
        ")" | "]" => panic!("{word} without a beginning"),
        _ if word.starts_with('"') => return Tree::Text(word.trim_matches('"').to_owned()),
        _ => return Tree::Word(word),
    };
    let mut parts = Vec::new();
    while words.peek().expect("the end of a list") != end {
        parts.push(tree(words));
    }
    words.next();
    Tree::List(parts)
}

/// A name as the standard allows it, which is no constant.
fn symbol(tree: &Tree) -> &str {
    const SIGNS: &str = "~!@$%^&*_-+=<>.?/:";
    let Tree::Word(name) = tree else { panic!("{tree:?} is no name") };
    let first = name.chars().next().expect("a letter");
    assert!(first.is_ascii_alphabetic() || SIGNS.contains(first), "{name}");
    assert!(name.chars().all(|letter| letter.is_ascii_alphanumeric() || SIGNS.contains(letter)), "{name}");
    let is_constant = ["E", "PI", "LN2", "LN10", "NAN", "INFINITY", "TRUE", "FALSE"].contains(&name.as_str());
    assert!(!is_constant, "{name} is a constant");
    name
}

fn evaluated<T: Arithmetic>(tree: &Tree, scope: &Scope<T>) -> Value<T> {
    match tree {
        Tree::Text(text) => panic!("the string {text}"),
        Tree::Word(word) if word == "PI" => Value::Number(T::pi()),
        Tree::Word(word) if word.parse::<f64>().is_ok() => Value::Number(T::decimal(word)),
        Tree::Word(word) => scope.get(word).unwrap_or_else(|| panic!("{word} is not bound")).clone(),
        Tree::List(parts) => {
            let [Tree::Word(operator), operands @ ..] = parts.as_slice() else { panic!("{parts:?}") };
            if operator == "let*" {
                let [Tree::List(bindings), body] = operands else { panic!("{operands:?}") };
                let mut inner = scope.clone();
                for binding in bindings {
                    let Tree::List(pair) = binding else { panic!("{binding:?}") };
                    let [name, value] = pair.as_slice() else { panic!("{pair:?}") };
                    let value = evaluated(value, &inner);
                    assert!(inner.insert(symbol(name).to_owned(), value).is_none(), "{name:?} twice");
                }
                return evaluated(body, &inner);
            }
            let operands: Vec<Value<T>> = operands.iter().map(|operand| evaluated(operand, scope)).collect();
            if operator == "and" {
                return Value::Truth(operands.iter().all(|operand| truth(operand)));
            }
            let numbers: Vec<T> = operands.iter().map(number).collect();
            let ordered = |test: &dyn Fn(&T, &T) -> bool| {
                assert!(numbers.len() > 1, "{parts:?}");
                Value::Truth(numbers.windows(2).all(|pair| test(&pair[0], &pair[1])))
            };
            match operator.as_str() {
                "<" => ordered(&|a, b| a.is_less(b)),
                ">" => ordered(&|a, b| b.is_less(a)),
                "<=" => ordered(&|a, b| !b.is_less(a)),
                ">=" => ordered(&|a, b| !a.is_less(b)),
                "!=" => ordered(&|a, b| a.is_less(b) || b.is_less(a)),
                _ => Value::Number(T::call(operator, &numbers).unwrap_or_else(|| panic!("no operation {parts:?}"))),
            }
        }
    }
}

fn number<T: Clone>(value: &Value<T>) -> T {
    match value {
        Value::Number(number) => number.clone(),
        Value::Truth(_) => panic!("a truth value as a number"),
    }
}

fn truth<T>(value: &Value<T>) -> bool {
    match value {
        Value::Truth(truth) => *truth,
        Value::Number(_) => panic!("a number as a truth value"),
    }
}
