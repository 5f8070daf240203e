//! Expressions as text in the notation of the `linkage!` language: as the graph holds them, and laid out
//! as mathematics, which is the source that the runtime spells as Unicode, LaTeX and MathML.

mod layout;
mod name;
#[cfg(test)]
mod tests;

pub use name::Name;

use super::{Graph, NodeId, SymbolId};
use layout::{Binding, Layout};

/// A text longer than this is of no use to a reader, and a shared graph can unfold
/// without bound: from here on a part is shown as an ellipsis.
const LONGEST: usize = 400;

/// The limit for the source of a formula, of which a reader sees two thirds: θ₃ for `theta3`.
const LONGEST_SOURCE: usize = LONGEST + LONGEST / 2;

/// A part that is written.
#[derive(Debug, Clone)]
struct Piece {
    body: String,
    binding: Binding,
    /// True if an ellipsis is written in its place.
    hidden: bool,
}

/// The parts by the index of their node.
#[derive(Debug, Default)]
struct Pieces(Vec<Option<Piece>>);

impl Pieces {
    fn get(&self, id: NodeId) -> Option<&Piece> {
        match self.0.as_slice().get(id.index()) {
            Some(Some(piece)) => Some(piece),
            _ => None,
        }
    }
}

/// Writes the sources of formulas of one graph; parts that they share are written once.
pub struct Printer<'a> {
    graph: &'a Graph,
    names: &'a dyn Fn(SymbolId) -> Name<'a>,
    longest: usize,
    pieces: Pieces,
}

impl<'a> Printer<'a> {
    /// A printer that shows each symbol as `names` says.
    #[must_use]
    pub fn new(graph: &'a Graph, names: &'a dyn Fn(SymbolId) -> Name<'a>) -> Self {
        Self { graph, names, longest: LONGEST_SOURCE, pieces: Pieces::default() }
    }

    /// The length in bytes from which on a part is shown as an ellipsis.
    #[must_use]
    pub fn longest(mut self, bytes: usize) -> Self {
        self.longest = bytes;
        self
    }

    /// The expression as the runtime reads it.
    pub fn source(&mut self, root: NodeId) -> &str {
        write(self.graph, Some(self.names), &mut self.pieces, root, self.longest)
    }
}

/// Texts of one graph; what they share is written once.
#[derive(Debug, Default)]
pub struct Texts(Pieces);

impl Texts {
    /// The expression as text.
    pub fn of(&mut self, graph: &Graph, root: NodeId) -> &str {
        write(graph, None, &mut self.0, root, LONGEST)
    }
}

/// Writes every part that is not written yet.
fn write<'a, 'p>(
    graph: &Graph,
    names: Option<&dyn Fn(SymbolId) -> Name<'a>>,
    pieces: &'p mut Pieces,
    root: NodeId,
    longest: usize,
) -> &'p str {
    // Parts have smaller numbers than what is made of them.
    if pieces.0.len() <= root.index() {
        pieces.0.resize_with(root.index() + 1, || None);
    }
    for id in graph.sweep(&[root], |id| pieces.get(id).is_some(), |_| false) {
        let mut body = String::new();
        let binding = Layout { graph, names, pieces }.write(&mut body, id);
        let fits = body.len() <= longest;
        let piece = if fits {
            Piece { body, binding, hidden: false }
        } else {
            Piece { body: "…".to_owned(), binding: Binding::Atom, hidden: true }
        };
        pieces.0[id.index()] = Some(piece);
    }
    pieces.get(root).map_or("", |piece| &piece.body)
}

impl Graph {
    /// The expression as text; of many, [`Texts`] write what they share once.
    #[must_use]
    pub fn text(&self, root: NodeId) -> String {
        Texts::default().of(self, root).to_owned()
    }
}
