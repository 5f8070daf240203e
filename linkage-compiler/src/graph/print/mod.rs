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

use rustc_hash::FxHashMap;

pub use name::Name;

use super::{Graph, NodeId, SymbolId};
use layout::Reading;
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
        self.prepare(root);
        self.body(root, notation)
    }

    /// The expression in every notation.
    pub fn formula(&mut self, root: NodeId) -> Formula {
        self.prepare(root);
        Formula {
            unicode: self.body(root, Notation::Unicode),
            latex: self.body(root, Notation::Latex),
            mathml: self.body(root, Notation::MathMl),
        }
    }

    fn body(&self, root: NodeId, notation: Notation) -> String {
        let pieces = match notation {
            Notation::Unicode => &self.unicode,
            Notation::Latex => &self.latex,
            Notation::MathMl => &self.mathml,
        };
        pieces.get(&root).map(|piece| piece.body.clone()).unwrap_or_default()
    }

    /// Writes every part that is not written yet; the length of the Unicode decides what is hidden in
    /// all notations.
    fn prepare(&mut self, root: NodeId) {
        for id in self.graph.sweep(&[root], |id| self.unicode.contains_key(&id), |_| false) {
            let reading = Reading { graph: self.graph, names: Some(self.names), measured: &self.unicode };
            let layout = reading.layout(id);
            let spell = |style: &dyn Style, pieces: &Pieces| layout.spell(&reading, style, pieces);
            let (body, binding) = spell(&unicode::Unicode, &self.unicode);
            let fits = body.len() <= self.longest || body.chars().count() <= self.longest;
            let others = [(&latex::Latex as &dyn Style, &mut self.latex), (&mathml::MathMl, &mut self.mathml)];
            for (style, pieces) in others {
                let piece = if fits {
                    let (body, binding) = spell(style, pieces);
                    Piece { body, binding, hidden: false }
                } else {
                    Piece::ellipsis(style)
                };
                pieces.insert(id, piece);
            }
            self.unicode.insert(id, Piece::new(body, binding, fits, &unicode::Unicode));
        }
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
        for id in graph.sweep(&[root], |id| pieces.contains_key(&id), |_| false) {
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
