//! The order conditions: one for each rooted tree (Hairer, Norsett and Wanner, section II.2).

use linkage_dynamics::integrate::{Dop853, Dopri5, Method, Tableau, Weights};

/// A rooted tree: the subtrees at its root, in order. Nodes and density gamma follow.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Tree(Vec<Tree>);

impl Tree {
    fn nodes(&self) -> usize {
        1 + self.0.iter().map(Tree::nodes).sum::<usize>()
    }

    /// gamma: the nodes times the densities of the subtrees.
    fn density(&self) -> f64 {
        self.nodes() as f64 * self.0.iter().map(Tree::density).product::<f64>()
    }

    /// For each slope the product over the subtrees of sum `a_ij` (theirs)_j; 1 for the single node.
    fn weights(&self, a: &[Vec<f64>]) -> Vec<f64> {
        let below: Vec<Vec<f64>> = self.0.iter().map(|tree| tree.weights(a)).collect();
        a.iter().map(|row| below.iter().map(|w| row.iter().zip(w).map(|(a, w)| a * w).sum::<f64>()).product()).collect()
    }
}

/// The trees of up to `most` nodes, built by adding a leaf at every node.
fn trees(most: usize) -> Vec<Tree> {
    fn grown(tree: &Tree) -> Vec<Tree> {
        let mut all = vec![];
        let mut with = |index: Option<usize>, subtree: Tree| {
            let mut subtrees = tree.0.clone();
            match index {
                Some(index) => subtrees[index] = subtree,
                None => subtrees.push(subtree),
            }
            subtrees.sort();
            all.push(Tree(subtrees));
        };
        with(None, Tree(vec![]));
        for (index, subtree) in tree.0.iter().enumerate() {
            for subtree in grown(subtree) {
                with(Some(index), subtree);
            }
        }
        all
    }
    let mut all = vec![Tree(vec![])];
    let mut last = all.clone();
    for _ in 1..most {
        last = last.iter().flat_map(grown).collect();
        last.sort();
        last.dedup();
        all.extend(last.clone());
    }
    all
}

fn dense(weights: Weights) -> Vec<f64> {
    let mut row = vec![0.0; 16];
    for &(j, weight) in weights {
        assert_eq!(row[j], 0.0, "slope {j} twice");
        row[j] = weight;
    }
    row
}

/// The matrix of all slopes and their nodes.
fn matrix(tableau: &Tableau) -> (Vec<Vec<f64>>, Vec<f64>) {
    let mut rows = vec![(dense(&[]), 0.0)];
    rows.extend(tableau.stages.iter().map(|stage| (dense(stage.weights), stage.node)));
    assert_eq!(rows.len(), tableau.end);
    rows.push((dense(tableau.solution), 1.0));
    rows.extend(tableau.dense_stages.iter().map(|stage| (dense(stage.weights), stage.node)));
    for (i, (row, _)) in rows.iter().enumerate() {
        assert!(row[i..].iter().all(|&a| a == 0.0), "slope {i} is not explicit");
    }
    rows.into_iter().unzip()
}

/// The largest error of the conditions of this many nodes at fraction s of the step.
fn missed(a: &[Vec<f64>], b: &[f64], s: f64, nodes: usize) -> f64 {
    let all = trees(nodes);
    all.iter().filter(|tree| tree.nodes() == nodes).fold(0.0, |most: f64, tree| {
        let sum: f64 = tree.weights(a).iter().zip(b).map(|(w, b)| w * b).sum();
        most.max((sum - s.powi(nodes as i32) / tree.density()).abs())
    })
}

/// Tests for exact order p: all conditions of up to p nodes hold to rounding error, those of p + 1 do not.
fn assert_order(name: &str, a: &[Vec<f64>], b: &[f64], s: f64, order: usize) {
    for nodes in 1..=order {
        let missed = missed(a, b, s, nodes);
        assert!(missed < 1e-13, "{name} at {s}, {nodes} nodes: {missed:e}");
    }
    let missed = missed(a, b, s, order + 1);
    assert!(missed > 1e-7, "{name} at {s} is of higher order than {order}: {missed:e}");
}

/// The weights of dense output at fraction s, from the documented polynomial.
fn dense_weights(tableau: &Tableau, s: f64) -> Vec<f64> {
    let b = dense(tableau.solution);
    let unit = |j: usize| -> Vec<f64> { (0..16).map(|i| f64::from(u8::from(i == j))).collect() };
    let minus = |x: &[f64], y: &[f64]| -> Vec<f64> { x.iter().zip(y).map(|(x, y)| x - y).collect() };
    let c2 = minus(&unit(0), &b);
    let c3 = minus(&minus(&b, &unit(tableau.end)), &c2);
    let mut coefficients = vec![b, c2, c3];
    coefficients.extend(tableau.dense.iter().map(|&weights| dense(weights)));
    let mut sum = vec![0.0; 16];
    for (i, c) in coefficients.iter().enumerate().rev() {
        let factor = if i % 2 == 0 { 1.0 - s } else { s };
        sum = c.iter().zip(&sum).map(|(c, sum)| c + factor * sum).collect();
    }
    sum.iter().map(|w| s * w).collect()
}

fn check(name: &str, tableau: &Tableau, dense_order: usize, lower: &[usize]) {
    let (a, nodes) = matrix(tableau);
    for (i, (row, node)) in a.iter().zip(nodes).enumerate() {
        let sum: f64 = row.iter().sum();
        assert!((sum - node).abs() < 2e-14, "{name}, slope {i}: {sum} and {node}");
    }
    let b = dense(tableau.solution);
    assert_order(name, &a, &b, 1.0, tableau.order as usize);
    for (&weights, &order) in tableau.errors.iter().zip(lower) {
        let embedded: Vec<f64> = b.iter().zip(dense(weights)).map(|(b, e)| b - e).collect();
        assert_order(name, &a, &embedded, 1.0, order);
    }
    for s in [0.1, 0.3, 0.5, 0.77, 0.95] {
        let weights = dense_weights(tableau, s);
        for nodes in 1..=dense_order {
            let missed = missed(&a, &weights, s, nodes);
            assert!(missed < 1e-13, "{name}, dense at {s}, {nodes} nodes: {missed:e}");
        }
        assert!(missed(&a, &weights, s, dense_order + 1) > 1e-8, "{name}, dense at {s}");
    }
}

#[test]
fn there_are_as_many_trees_as_there_should_be() {
    let all = trees(8);
    let counts: Vec<usize> = (1..=8).map(|nodes| all.iter().filter(|tree| tree.nodes() == nodes).count()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115]);
}

#[test]
fn the_method_of_order_5_meets_its_conditions() {
    check("DOPRI5", &Dopri5::TABLEAU, 4, &[4]);
}

#[test]
fn the_method_of_order_8_meets_its_conditions() {
    check("DOP853", &Dop853::TABLEAU, 7, &[5, 3]);
}
