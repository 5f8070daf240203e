//! Groups of two and three loops of links: which are found, and that their formulas are the loop equations.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use linkage_compiler::derivation::Derivation;
use linkage_compiler::graph::{NodeId, SymbolId};
use linkage_compiler::structure::{Group, Loops};
use linkage_compiler::{derive, read};
use proc_macro2::{TokenStream, TokenTree};

/// The derivation of a mechanism of the gallery.
fn gallery(file: &str) -> Derivation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../dev/gallery/src/mechanisms/{file}.rs"));
    let tokens: Vec<TokenTree> =
        fs::read_to_string(path).unwrap().parse::<TokenStream>().unwrap().into_iter().collect();
    let Some(TokenTree::Group(group)) = tokens.last() else { panic!("{file} has no `linkage!`") };
    derive(&read(group.stream()).unwrap()[0]).remove(0)
}

/// The derivation of a mechanism with the parameters a to f, the input v and these unknowns.
fn written(unknowns: &str, statements: &str) -> Derivation {
    let source = format!("mechanism M {{ param a, b, c, d, e, f; input v; unknown {unknowns}; {statements} }}");
    derive(&read(source.parse().unwrap()).unwrap_or_else(|errors| panic!("{source}: {errors:?}"))[0]).remove(0)
}

fn groups(derivation: &Derivation) -> Vec<Group> {
    derivation.blocks.iter().map(|block| block.group).collect()
}

/// A generator of angles and lengths (xorshift).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * 6.0 - 3.0
    }
}

/// At any angles the magnitudes of the loops are those of the rows, so that both vanish together: the sum of the squares
/// of all rows. Returns the number of coefficients that are not zero, by block.
fn checked(derivation: &mut Derivation) -> Vec<usize> {
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut counts = Vec::new();
    for block in derivation.blocks.clone().iter().filter(|block| matches!(block.group, Group::Loops(_))) {
        let rows = derivation.residual.at(&block.equations);
        let coordinate = |unknown| derivation.coordinates[derivation.unknowns[unknown]].value;
        let unknowns: Vec<SymbolId> = block.unknowns.iter().map(|&unknown| coordinate(unknown)).collect();
        let loops = Loops::of(&mut derivation.graph, &rows, &unknowns).unwrap();
        assert_eq!(block.group, Group::Loops(loops.constants.len()));
        assert_eq!((2 * loops.constants.len(), loops.directions.len()), (rows.len(), unknowns.len()));
        for _ in 0..20 {
            let symbols = derivation.graph.symbols_of(&[rows.clone(), loops.nodes()].concat());
            let values: BTreeMap<SymbolId, f64> = symbols.into_iter().map(|symbol| (symbol, numbers.next())).collect();
            let value = |node: NodeId| derivation.graph.evaluate(&[node], |symbol| values[&symbol])[0];
            let angles: Vec<f64> = unknowns.iter().map(|unknown| values[unknown]).collect();
            let combined = |factors: &[i64], of: &[f64]| -> f64 {
                factors.iter().zip(of).map(|(factor, angle)| *factor as f64 * angle).sum()
            };
            let directions: Vec<f64> = loops.directions.iter().map(|factors| combined(factors, &angles)).collect();
            for (factors, angle) in loops.unknowns.iter().zip(&angles) {
                assert!((combined(factors, &directions) - angle).abs() < 1e-13);
            }
            let closures = loops.constants.iter().zip(&loops.factors).map(|(constant, factors)| {
                let mut sum = constant.map(value);
                for ([real, imaginary], angle) in factors.iter().map(|part| part.map(value)).zip(&directions) {
                    sum[0] += real * angle.cos() - imaginary * angle.sin();
                    sum[1] += real * angle.sin() + imaginary * angle.cos();
                }
                sum[0].powi(2) + sum[1].powi(2)
            });
            let (of_loops, of_rows) = (closures.sum::<f64>(), rows.iter().map(|&row| value(row).powi(2)).sum::<f64>());
            assert!((of_loops - of_rows).abs() < 1e-12 * of_rows, "{of_loops} {of_rows}");
        }
        let is_there = |factor: &&[NodeId; 2]| factor.iter().any(|&part| !derivation.graph.is_zero(part));
        counts.push(loops.constants.iter().chain(loops.factors.iter().flatten()).filter(is_there).count());
    }
    counts
}

#[test]
fn of_the_gallery() {
    let mut double_butterfly = gallery("double_butterfly");
    assert_eq!(groups(&double_butterfly), [Group::Loops(3)]);
    // Three constants, and 3 + 4 + 3 links.
    assert_eq!(checked(&mut double_butterfly), [3 + 3 + 4 + 3]);
    let mut stephenson = gallery("stephenson_far");
    assert_eq!(groups(&stephenson), [Group::Loops(2), Group::Rrr]);
    assert_eq!(checked(&mut stephenson), [2 + 3 + 3]);
    let mut robot = gallery("three_rrr");
    assert_eq!(groups(&robot), [Group::Loops(2), Group::Linear, Group::Linear]);
    assert_eq!(checked(&mut robot), [2 + 3 + 3]);
    let mut triads = gallery("two_triads");
    assert_eq!(groups(&triads), [Group::Rrr, Group::Loops(2), Group::Loops(2)]);
    assert_eq!(checked(&mut triads).len(), 2);
}
