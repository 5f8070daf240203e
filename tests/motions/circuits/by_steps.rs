//! The number of circuits by another method: positions listed at small steps of a turn are matched with the nearest ones of
//! the next step; those that remain at a step are pairs that meet at a dead point.

use std::f64::consts::TAU;

use linkage::{Branches, D, Mechanism};

/// Sets of numbers that are merged.
struct Sets(Vec<usize>);

impl Sets {
    fn root(&self, mut of: usize) -> usize {
        while self.0[of] != of {
            of = self.0[of];
        }
        of
    }

    fn merge(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.0[one] = other;
    }
}

/// The distance of two positions; angles modulo whole turns.
fn distance<M: Mechanism<Scalar = f64, V = D<1>>>(one: &M::Coordinates, other: &M::Coordinates) -> f64 {
    let off = M::unknowns(one) - M::unknowns(other);
    let off = off
        .iter()
        .zip(M::UNKNOWN_ANGLES)
        .map(|(&off, &angle)| if angle { off - TAU * (off / TAU).round() } else { off });
    off.map(|off| off * off).sum::<f64>().sqrt()
}

/// Pairs of two lists, the nearest first, and the entries without a partner.
fn matched<Q>(here: &[Q], there: &[Q], distance: impl Fn(&Q, &Q) -> f64) -> (Vec<[usize; 2]>, [Vec<usize>; 2]) {
    let all =
        here.iter().enumerate().flat_map(|(i, one)| there.iter().enumerate().map(move |(j, other)| (i, j, one, other)));
    let mut all: Vec<_> = all.map(|(i, j, one, other)| (distance(one, other), [i, j])).collect();
    all.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut free = [vec![true; here.len()], vec![true; there.len()]];
    let mut pairs = Vec::new();
    for (_, [i, j]) in all {
        if free[0][i] && free[1][j] {
            (free[0][i], free[1][j]) = (false, false);
            pairs.push([i, j]);
        }
    }
    (pairs, free.map(|free| free.iter().enumerate().filter(|(_, free)| **free).map(|(place, _)| place).collect()))
}

/// The circuit of each mode at the start input: modes of one circuit have one number.
pub fn partition<M>(m: &M, start: f64, steps: u32) -> Vec<usize>
where
    M: Branches<Scalar = f64, V = D<1>>,
{
    let list = |step: u32| -> Vec<M::Coordinates> {
        let input = start + TAU * f64::from(step % steps) / f64::from(steps);
        m.all_positions(M::Inputs::from([input].into())).unwrap().map(|(_, q)| q).collect()
    };
    let lists: Vec<Vec<M::Coordinates>> = (0..steps).map(list).collect();
    let firsts: Vec<usize> = lists
        .iter()
        .scan(0, |sum, list| {
            *sum += list.len();
            Some(*sum - list.len())
        })
        .collect();
    let mut sets = Sets((0..lists.iter().map(Vec::len).sum()).collect());
    for here in 0..lists.len() {
        let there = (here + 1) % lists.len();
        let (pairs, lonely) = matched(&lists[here], &lists[there], distance::<M>);
        for [i, j] in pairs {
            sets.merge(firsts[here] + i, firsts[there] + j);
        }
        for (lonely, at) in lonely.into_iter().zip([here, there]) {
            let mut left = lonely;
            while let Some(one) = left.pop() {
                let near = |&&other: &&usize| distance::<M>(&lists[at][one], &lists[at][other]);
                let partner = *left.iter().min_by(|a, b| near(a).total_cmp(&near(b))).expect("dead points join pairs");
                left.retain(|&other| other != partner);
                sets.merge(firsts[at] + one, firsts[at] + partner);
            }
        }
    }
    let mut names = Vec::new();
    let roots = (0..lists[0].len()).map(|mode| sets.root(mode));
    roots
        .map(|root| {
            names.iter().position(|&name| name == root).unwrap_or_else(|| {
                names.push(root);
                names.len() - 1
            })
        })
        .collect()
}
