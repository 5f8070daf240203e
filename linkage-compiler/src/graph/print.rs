//! Expressions as text, for doc comments and messages.

use super::{Graph, Node, NodeId, Number};

/// A text longer than this is of no use to a reader, and a shared graph can unfold without
/// bound: from here on a part is shown as an ellipsis.
const LONGEST: usize = 400;

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

impl Graph {
    /// The expression in the notation of the `linkage!` language.
    #[must_use]
    pub fn text(&self, root: NodeId) -> String {
        let mut texts: Vec<(String, Binding)> = vec![(String::new(), Binding::Atom); root.index() + 1];
        for id in self.reachable(&[root]) {
            let (text, binding) = self.node_text(id, &texts);
            let fits = text.len() <= LONGEST;
            texts[id.index()] = if fits { (text, binding) } else { ("…".to_owned(), Binding::Atom) };
        }
        texts.swap_remove(root.index()).0
    }

    fn node_text(&self, id: NodeId, texts: &[(String, Binding)]) -> (String, Binding) {
        let part = |id: NodeId, at_least: Binding| {
            let (text, binding) = &texts[id.index()];
            if *binding < at_least { format!("({text})") } else { text.clone() }
        };
        match self.node(id) {
            Node::Constant(value) => {
                let plain = value.as_integer().is_some_and(|value| value >= 0);
                (value.to_string(), if plain { Binding::Atom } else { Binding::Sum })
            }
            Node::Pi => ("pi".to_owned(), Binding::Atom),
            Node::Symbol(symbol) => (self.symbol_name(*symbol).to_owned(), Binding::Atom),
            Node::Sum { constant, terms } => {
                let mut text = String::new();
                // A leading positive term reads better than a leading minus.
                let (plus, minus): (Vec<_>, Vec<_>) = terms.iter().partition(|(k, _)| !k.is_negative());
                for &(factor, term) in plus.into_iter().chain(minus) {
                    let body = if factor.absolute().is_one() {
                        part(term, Binding::Product)
                    } else {
                        scaled(factor.absolute(), &part(term, Binding::Product))
                    };
                    join(&mut text, factor.is_negative(), &body);
                }
                if !constant.is_zero() {
                    join(&mut text, constant.is_negative(), &constant.absolute().to_string());
                }
                (text, Binding::Sum)
            }
            Node::Product { coefficient, factors } => {
                let side = |sign: i32| -> Vec<String> {
                    let of_sign = factors.iter().filter(|(_, n)| n.signum() == sign);
                    let power = |(base, n): &(NodeId, i32)| match n.unsigned_abs() {
                        1 => part(*base, Binding::Power),
                        n => format!("{}^{n}", part(*base, Binding::Atom)),
                    };
                    of_sign.map(power).collect()
                };
                let (above, below) = (side(1).join("*"), side(-1));
                let mut text = match (coefficient.absolute().is_one(), above.is_empty()) {
                    (true, true) => "1".to_owned(),
                    (true, false) => above,
                    (false, true) => coefficient.absolute().to_string(),
                    (false, false) => scaled(coefficient.absolute(), &above),
                };
                if coefficient.is_negative() {
                    text.insert(0, '-');
                }
                match below.as_slice() {
                    [] => {}
                    [one] => text = format!("{text}/{one}"),
                    many => text = format!("{text}/({})", many.join("*")),
                }
                let single = below.is_empty() && coefficient.is_one() && factors.len() == 1;
                let loose = coefficient.is_negative();
                let binding = match (loose, single) {
                    (true, _) => Binding::Sum,
                    (false, true) => Binding::Power,
                    (false, false) => Binding::Product,
                };
                (text, binding)
            }
            Node::Call(function, arguments) => {
                let arguments: Vec<_> = arguments.iter().map(|id| part(*id, Binding::Sum)).collect();
                (format!("{}({})", function.operation().name, arguments.join(", ")), Binding::Atom)
            }
        }
    }
}

fn scaled(factor: Number, body: &str) -> String {
    match factor {
        Number::Ratio(_, 1) | Number::Float(_) => format!("{factor}*{body}"),
        Number::Ratio(1, d) => format!("{body}/{d}"),
        Number::Ratio(n, d) => format!("{n}*{body}/{d}"),
    }
}

fn join(text: &mut String, negative: bool, body: &str) {
    text.push_str(match (text.is_empty(), negative) {
        (true, false) => "",
        (true, true) => "-",
        (false, false) => " + ",
        (false, true) => " - ",
    });
    text.push_str(body);
}
