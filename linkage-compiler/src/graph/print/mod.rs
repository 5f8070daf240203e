//! Expressions as text: in the notation of the `linkage!` language, as Unicode, LaTeX and MathML.
//!
//! [`layout`] decides once what is a sum, a fraction or a power, which signs are written and what
//! needs brackets; a [`Style`] a notation spells the pieces. Every part is written once a printer.

mod language;
mod latex;
mod layout;
mod mathml;
mod name;
mod style;
#[cfg(test)]
mod tests;
mod unicode;

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

pub use name::Name;

use super::{Graph, NodeId, SymbolId};
use layout::{Layout, Reading};
use style::{Binding, Style};

/// A text longer than this is of no use to a reader, and a shared graph can unfold
/// without bound: from here on a part is shown as an ellipsis.
const LONGEST: usize = 400;

/// A mathematical notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Notation {
    /// One line of plain text: `−l₃·l₄·sin(θ₃ − θ₄)`.
    Unicode,
    /// For LaTeX's mathematical mode: `-l_3 l_4 \sin(\theta_3 - \theta_4)`.
    Latex,
    /// Presentation MathML (Core): one element, without the `math` element around it.
    MathMl,
}

/// An expression in every [`Notation`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Formula {
    pub unicode: String,
    pub latex: String,
    pub mathml: String,
}

/// A part that is written.
#[derive(Debug, Clone)]
struct Piece {
    body: String,
    binding: Binding,
    /// Whether an ellipsis stands for it.
    hidden: bool,
}

type Pieces = FxHashMap<NodeId, Piece>;

/// Writes formulas of one graph; parts that they share are written once.
pub struct Printer<'a> {
    graph: &'a Graph,
    names: &'a dyn Fn(SymbolId) -> Name<'a>,
    longest: usize,
    unicode: Pieces,
    latex: Pieces,
    mathml: Pieces,
}

impl<'a> Printer<'a> {
    /// A printer that shows each symbol as `names` says.
    #[must_use]
    pub fn new(graph: &'a Graph, names: &'a dyn Fn(SymbolId) -> Name<'a>) -> Self {
        let (unicode, latex, mathml) = (Pieces::default(), Pieces::default(), Pieces::default());
        Self { graph, names, longest: LONGEST, unicode, latex, mathml }
    }

    /// The number of characters, as Unicode text, from which on a part is shown as an ellipsis in
    /// all notations.
    #[must_use]
    pub fn longest(mut self, characters: usize) -> Self {
        self.longest = characters;
        self
    }

    /// The expression in one notation.
    pub fn write(&mut self, root: NodeId, notation: Notation) -> String {
        self.measure(root);
        match notation {
            Notation::Unicode => {}
            Notation::Latex | Notation::MathMl => self.spell(root, notation),
        }
        self.pieces(notation).get(&root).map(|piece| piece.body.clone()).unwrap_or_default()
    }

    /// The expression in every notation.
    pub fn formula(&mut self, root: NodeId) -> Formula {
        Formula {
            unicode: self.write(root, Notation::Unicode),
            latex: self.write(root, Notation::Latex),
            mathml: self.write(root, Notation::MathMl),
        }
    }

    fn pieces(&mut self, notation: Notation) -> &mut Pieces {
        match notation {
            Notation::Unicode => &mut self.unicode,
            Notation::Latex => &mut self.latex,
            Notation::MathMl => &mut self.mathml,
        }
    }

    /// Writes Unicode, whose length decides what is hidden in all notations.
    fn measure(&mut self, root: NodeId) {
        for id in self.graph.sweep([root], |id| self.unicode.contains_key(&id)) {
            let reading = Reading { graph: self.graph, names: Some(self.names), measured: &self.unicode };
            let (body, binding) = reading.layout(id).spell(&reading, &unicode::Unicode, &self.unicode);
            let fits = body.chars().count() <= self.longest;
            self.unicode.insert(id, Piece::new(body, binding, fits, &unicode::Unicode));
        }
    }

    /// Writes what can be seen of a measured expression.
    fn spell(&mut self, root: NodeId, notation: Notation) {
        let style: &dyn Style = match notation {
            Notation::Unicode => return,
            Notation::Latex => &latex::Latex,
            Notation::MathMl => &mathml::MathMl,
        };
        let mut pieces = std::mem::take(self.pieces(notation));
        let reading = Reading { graph: self.graph, names: Some(self.names), measured: &self.unicode };
        let mut seen: Vec<(NodeId, Option<Layout>)> = Vec::new();
        let mut open = BTreeSet::from([root]);
        while let Some(id) = open.pop_last() {
            if pieces.contains_key(&id) {
                continue;
            }
            let layout = (!is_hidden(&self.unicode, id)).then(|| reading.layout(id));
            open.extend(layout.iter().flat_map(Layout::parts));
            seen.push((id, layout));
        }
        for (id, layout) in seen.into_iter().rev() {
            let piece = match layout {
                Some(layout) => {
                    let (body, binding) = layout.spell(&reading, style, &pieces);
                    Piece { body, binding, hidden: false }
                }
                None => Piece::ellipsis(style),
            };
            pieces.insert(id, piece);
        }
        *self.pieces(notation) = pieces;
    }
}

impl Piece {
    fn new(body: String, binding: Binding, fits: bool, style: &dyn Style) -> Self {
        if fits { Self { body, binding, hidden: false } } else { Self::ellipsis(style) }
    }

    fn ellipsis(style: &dyn Style) -> Self {
        Self { body: style.ellipsis().to_owned(), binding: Binding::Atom, hidden: true }
    }
}

fn is_hidden(pieces: &Pieces, id: NodeId) -> bool {
    pieces.get(&id).is_some_and(|piece| piece.hidden)
}

/// Texts of one graph in the notation of the `linkage!` language; what they share is written once.
#[derive(Debug, Default)]
pub struct Texts(Pieces);

impl Texts {
    /// The expression as text.
    pub fn of(&mut self, graph: &Graph, root: NodeId) -> String {
        let pieces = &mut self.0;
        for id in graph.sweep([root], |id| pieces.contains_key(&id)) {
            let reading = Reading { graph, names: None, measured: pieces };
            let (body, binding) = reading.layout(id).spell(&reading, &language::Language, pieces);
            let fits = body.len() <= LONGEST;
            pieces.insert(id, Piece::new(body, binding, fits, &language::Language));
        }
        pieces.get(&root).map(|piece| piece.body.clone()).unwrap_or_default()
    }
}

impl Graph {
    /// The expression in the notation of the `linkage!` language; of many, [`Texts`] write what they
    /// share once.
    #[must_use]
    pub fn text(&self, root: NodeId) -> String {
        Texts::default().of(self, root)
    }

    /// The expression in a mathematical notation, each symbol as `names` says; of many formulas a
    /// [`Printer`] writes what they share once.
    #[must_use]
    pub fn write<'a>(&'a self, root: NodeId, names: &'a dyn Fn(SymbolId) -> Name<'a>, notation: Notation) -> String {
        Printer::new(self, names).write(root, notation)
    }
}
