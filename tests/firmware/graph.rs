//! The call graph of machine code: the nodes are sections of object files, each a function or a table, the edges their
//! relocations.

use std::collections::{BTreeSet, HashMap, VecDeque};
use std::path::Path;

use object::read::archive::ArchiveFile;
use object::{Object, ObjectSection, ObjectSymbol, RelocationTarget, SymbolSection};

/// A function or a table.
#[derive(Default)]
struct Node {
    name: String,
    to: Vec<To>,
}

/// The end of an edge.
#[derive(Clone)]
enum To {
    Node(usize),
    /// By the name of a symbol of another object file.
    Symbol(String),
}

/// The object files of some libraries.
#[derive(Default)]
pub struct Graph {
    nodes: Vec<Node>,
    /// The nodes of the symbols that other object files may name.
    symbols: HashMap<String, usize>,
    /// All functions, by the names that Rust gives them.
    functions: Vec<(String, usize)>,
}

/// Functions that no library has: the compiler requires every program to have them.
const OF_EVERY_TARGET: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "bcmp"];

impl Graph {
    /// Adds the object files of a library.
    pub fn add(&mut self, library: &Path) {
        let data = std::fs::read(library).unwrap_or_else(|error| panic!("{}: {error}", library.display()));
        for member in ArchiveFile::parse(&*data).unwrap().members() {
            let member = member.unwrap();
            // A library of Rust's has a file of metadata, too.
            if member.name().ends_with(b".o") {
                self.add_object(&object::File::parse(member.data(&*data).unwrap()).unwrap());
            }
        }
    }

    fn add_object(&mut self, file: &object::File) {
        let mut places = HashMap::new();
        for section in file.sections() {
            places.insert(section.index(), self.nodes.len());
            self.nodes.push(Node { name: section.name().unwrap_or_default().to_owned(), to: Vec::new() });
        }
        for symbol in file.symbols() {
            let SymbolSection::Section(section) = symbol.section() else { continue };
            let (Ok(name), Some(&place)) = (symbol.name(), places.get(&section)) else { continue };
            if name.is_empty() || symbol.kind() == object::SymbolKind::Section {
                continue;
            }
            let readable = format!("{:#}", rustc_demangle::demangle(name));
            if symbol.kind() == object::SymbolKind::Text {
                self.functions.push((readable.clone(), place));
            }
            self.nodes[place].name = readable;
            if symbol.is_global() {
                self.symbols.entry(name.to_owned()).or_insert(place);
            }
        }
        for section in file.sections() {
            let to = section.relocations().filter_map(|(_, relocation)| match relocation.target() {
                RelocationTarget::Symbol(index) => {
                    let symbol = file.symbol_by_index(index).unwrap();
                    Some(match symbol.section() {
                        SymbolSection::Section(section) => To::Node(*places.get(&section)?),
                        _ => To::Symbol(symbol.name().unwrap().to_owned()),
                    })
                }
                RelocationTarget::Section(section) => Some(To::Node(*places.get(&section)?)),
                _ => None,
            });
            self.nodes[places[&section.index()]].to = to.collect();
        }
    }

    /// The node itself, or the one of the symbol.
    fn resolved(&self, to: &To) -> Option<usize> {
        match to {
            To::Node(node) => Some(*node),
            To::Symbol(name) => self.symbols.get(name).copied(),
        }
    }

    /// The functions whose names these are, each with the shortest way from it to a function that panics, if there is one.
    pub fn panics(&self, is_meant: impl Fn(&str) -> bool) -> Vec<(&str, Option<Vec<&str>>)> {
        self.ways(is_meant, is_panic)
    }

    /// The functions whose names these are, each with the shortest way from it to one of the ends, if there is one.
    pub fn ways(
        &self,
        is_meant: impl Fn(&str) -> bool,
        is_end: impl Fn(&str) -> bool,
    ) -> Vec<(&str, Option<Vec<&str>>)> {
        let mut from = vec![Vec::new(); self.nodes.len()];
        for (node, Node { to, .. }) in self.nodes.iter().enumerate() {
            for to in to.iter().filter_map(|to| self.resolved(to)) {
                from[to].push(node);
            }
        }
        // From the ends back: each node's next on its way.
        let ends: BTreeSet<usize> =
            self.functions.iter().filter(|(name, _)| is_end(name)).map(|(_, node)| *node).collect();
        assert!(!ends.is_empty(), "no such end is in the libraries: they are not all there");
        let mut next: Vec<Option<usize>> = vec![None; self.nodes.len()];
        let mut queue: VecDeque<usize> = ends.iter().copied().collect();
        while let Some(node) = queue.pop_front() {
            for &before in &from[node] {
                if next[before].is_none() && !ends.contains(&before) {
                    next[before] = Some(node);
                    queue.push_back(before);
                }
            }
        }
        let way = |start: usize| {
            next[start]?;
            let nodes = std::iter::successors(Some(start), |&node| next[node]);
            Some(nodes.map(|node| self.nodes[node].name.as_str()).collect())
        };
        let meant = self.functions.iter().filter(|(name, _)| is_meant(name));
        meant.map(|(name, node)| (name.as_str(), way(*node))).collect()
    }

    /// Returns the symbols that these functions can reach and that no library has: they might panic.
    pub fn missing(&self, is_meant: impl Fn(&str) -> bool) -> BTreeSet<&str> {
        let mut missing = BTreeSet::new();
        let mut is_seen = vec![false; self.nodes.len()];
        let meant = self.functions.iter().filter(|(name, _)| is_meant(name));
        let mut stack: Vec<usize> = meant.map(|(_, node)| *node).collect();
        while let Some(node) = stack.pop() {
            if std::mem::replace(&mut is_seen[node], true) || is_panic(&self.nodes[node].name) {
                continue;
            }
            for to in &self.nodes[node].to {
                match (self.resolved(to), to) {
                    (Some(node), _) => stack.push(node),
                    (None, To::Symbol(name)) if !OF_EVERY_TARGET.contains(&name.as_str()) => {
                        missing.insert(name.as_str());
                    }
                    _ => {}
                }
            }
        }
        missing
    }
}

/// All panics come to one of these, those of `core`, of nalgebra and of arithmetic, too.
fn is_panic(function: &str) -> bool {
    function.starts_with("core::panicking::")
}
