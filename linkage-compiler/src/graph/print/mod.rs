//! Expressions as plain text in the notation of the `linkage!` language, for doc comments and messages.

mod layout;
#[cfg(test)]
mod tests;

use crate::graph::arena::Graph;
use crate::graph::node::NodeId;
use layout::{Binding, Layout, Piece, Pieces};

/// The largest length of a text in bytes; an ellipsis replaces a longer part. The text of a graph with shared nodes can
/// be exponentially long.
const LONGEST: usize = 400;

/// A cache of printed subexpressions of one graph.
#[derive(Debug, Default)]
pub struct Texts(Pieces);

impl Texts {
    /// The expression as text.
    pub fn of(&mut self, graph: &Graph, root: NodeId) -> &str {
        let pieces = &mut self.0;
        // Children have smaller ids than their parents.
        if pieces.0.len() <= root.index() {
            pieces.0.resize_with(root.index() + 1, || None);
        }
        for id in graph.sweep(&[root], |id| pieces.get(id).is_some(), |_| false) {
            let mut body = String::new();
            let mut binding = Layout { graph, pieces }.write(&mut body, id);
            if body.len() > LONGEST {
                (body, binding) = ("…".to_owned(), Binding::Atom);
            }
            pieces.0[id.index()] = Some(Piece { body, binding });
        }
        pieces.get(root).map_or("", |piece| &piece.body)
    }
}

impl Graph {
    /// The expression as text; for several expressions use [`Texts`], which prints shared subexpressions once.
    #[must_use]
    pub fn text(&self, root: NodeId) -> String {
        Texts::default().of(self, root).to_owned()
    }
}
