//! Expressions as plain text in the notation of the `linkage!` language, as the graph holds them: doc comments of
//! emitted functions and messages show it.

mod layout;
#[cfg(test)]
mod tests;

use crate::graph::arena::Graph;
use crate::graph::node::NodeId;
use layout::{Binding, Layout, Piece, Pieces};

/// The largest length of a text in bytes. A longer one is of no use to a reader, and a shared graph can unfold
/// without bound: an ellipsis replaces a part that is longer.
const LONGEST: usize = 400;

/// Texts of one graph; parts that they share are written once.
#[derive(Debug, Default)]
pub struct Texts(Pieces);

impl Texts {
    /// The expression as text.
    pub fn of(&mut self, graph: &Graph, root: NodeId) -> &str {
        let pieces = &mut self.0;
        // Parts have smaller numbers than the nodes that hold them.
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
    /// The expression as text; of many, [`Texts`] write what they share once.
    #[must_use]
    pub fn text(&self, root: NodeId) -> String {
        Texts::default().of(self, root).to_owned()
    }
}
